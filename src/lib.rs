//! Verified, traced Delaunay refinement.
#![forbid(unsafe_code)]

pub mod arith;
#[cfg(any(test, feature = "generators"))]
pub mod generators;
pub mod io;
pub mod model;
pub mod trace;
pub mod triangulation;
