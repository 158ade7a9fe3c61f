//! Exact decisions and correctly rounded constructions of space. `kernel3` is the contract; the plan of the files is that of `arith`.

mod kernel3;
pub mod perturb3;

pub use kernel3::{ConstructionError, Corners3, Kernel3, WeightedCorners};
