//! The independent checker of traces.
//!
//! Problem: a trace claims that every step of a run was justified; the program that wrote it is not trusted. Idea: replay it on an own
//! complex, and state every condition from its definition, over values with error bounds and rationals (`value`). Nothing of the
//! kernels, the triangulation or the refinement is used; only the records themselves (`crate::trace`, `crate::model`) are shared.
//!
//! | file | says |
//! |---|---|
//! | `value`, `condition` | numbers, and each condition as the sign of a polynomial |
//! | `complex`, `sight` | triangles and links; who sees what |
//! | `start` | the initial triangulation and the region |
//! | `replay` | one function per kind of event |
//! | `surgery` | cavities, fans, fillings |
//! | `rows` | the inequalities of the theory, `docs/gcdr.md` |
//! | `strict` | the choices: order, points, skips |
//! | `promise` | the level that parameters and input allow |
//! | `claims` | what must hold at the end |
//! | `spacing` | local feature size, and the rows that speak of it |
//! | `grading`, `scalar`, `rational` | constants of the theory, with square roots |

mod checker;
mod claims;
mod complex;
mod condition;
pub mod grading;
mod promise;
pub mod rational;
mod replay;
mod rows;
pub mod scalar;
mod sight;
mod snapshot;
pub mod spacing;
mod start;
mod strict;
mod surgery;
mod value;
mod verdict;

#[cfg(test)]
mod tests;

pub use checker::{Checker, Options, verify};
pub use verdict::{Place, Rejection, Rule, Unchecked, Verdict};
