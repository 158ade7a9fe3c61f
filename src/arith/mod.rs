//! Floor 1: exact decisions and correctly rounded constructions.
//!
//! `kernel` is the contract. `fast` (filters over one set of polynomials, `poly`) and `exact` (rationals over other formulas)
//! keep it; `plain` breaks it on purpose. `angle`, `scale` and `philox` make parameters and draws, exactly.

#[cfg(all(test, feature = "exact"))]
mod agreement;
pub mod angle;
mod construct;
mod double_double;
mod dyadic;
#[cfg(feature = "exact")]
mod exact;
mod fast;
mod filter;
mod kernel;
pub mod perturb;
pub mod philox;
mod plain;
mod poly;
mod round;
pub mod scale;
pub mod space;
mod stages;

pub use dyadic::Dyadic;
#[cfg(feature = "exact")]
pub use exact::ExactKernel;
pub use fast::FastKernel;
pub use kernel::{Corners, Kernel, OutOfRange};
pub use plain::PlainKernel;
