//! Exact decisions and correctly rounded constructions of space.
//!
//! `kernel3` is the contract; the plan of the files is that of `arith`: `fast3` (filters in `filter3`, integers of fixed width in `fixed3`, then the polynomials
//! of `poly3` in double-double and exact integers), `exact3` (rationals, other formulas), `plain3` (the negative control), `perturb3` (the one tie-break).

#[cfg(all(test, feature = "exact"))]
mod agreement3;
#[cfg(feature = "exact")]
mod exact3;
mod fast3;
mod filter3;
mod fixed3;
mod kernel3;
pub mod perturb3;
mod plain3;
mod poly3;

pub use kernel3::{ConstructionError, Corners3, Kernel3, WeightedCorners};
