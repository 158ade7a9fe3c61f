//! Floor 3: triangulations.

pub mod cdt2;
pub mod regular3;
mod spatial;
