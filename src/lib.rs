//! Verified, traced Delaunay refinement.
#![forbid(unsafe_code)]

pub mod arith;
#[cfg(all(feature = "exact", feature = "generators"))]
pub mod attack;
pub mod audit;
pub mod check;
pub mod cli;
pub mod doctor;
pub mod domain;
#[cfg(any(test, feature = "generators"))]
pub mod generators;
pub mod io;
pub mod model;
pub mod refine;
pub mod reproduce;
pub mod trace;
pub mod triangulation;
