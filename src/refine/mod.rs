//! Floor 5: the refiners. The only writers of events.

pub mod gcdr;
mod level;
pub mod regular;
mod run;
mod triangulate;

pub use gcdr::everyday;
pub use level::least_d2;
pub use run::{Chooser, DiskRequest, IntervalRequest, Options, Run, RunError, Unmet};
pub use triangulate::triangulate;
