//! Floor 1: exact decisions and correctly rounded constructions.

mod kernel;
pub mod perturb;

pub use kernel::{Corners, Kernel, OutOfRange};
