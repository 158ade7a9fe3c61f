//! Verified, traced Delaunay refinement.
#![forbid(unsafe_code)]

pub mod arith;
pub mod model;
pub mod trace;
pub mod triangulation;
