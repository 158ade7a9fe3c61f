//! Floor 3: triangulations.

pub mod cdt2;
