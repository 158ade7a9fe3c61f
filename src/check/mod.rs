//! The independent checker of traces.
//!
//! Problem: a trace claims that every step of a run was justified; the program that wrote it is not trusted. Idea: replay it on an own
//! complex, and state every condition from its definition, over values with error bounds and rationals (`value`). Nothing of the
//! kernels, the triangulation or the refinement is used; only the records themselves (`crate::trace`, `crate::model`) are shared.
//!
//! The core rebuilds the mesh and proves it constrained Delaunay after each event. It is to be read in one sitting, in this order, and stays under
//! 1,000 lines, which `tests/core_size.rs` counts:
//!
//! | core | says |
//! |---|---|
//! | `value` | numbers with an error bound (`exact` binds the rationals behind them) |
//! | `predicates` | orientation, circle, the one tie-break |
//! | `complex` | triangles and links |
//! | `surgery` | cavities, fans, fillings |
//! | `replay` | events |
//!
//! Each family of rules that justify the events, and all that precedes and follows them, is a file for itself:
//!
//! | file | says |
//! |---|---|
//! | `condition`, `sight` | each condition as the sign of a polynomial; who sees what |
//! | `cause`, `split`, `filler`, `shells` | why a triangle is bad, what a split needs (on the border too), small input angles |
//! | `rows` | the inequalities of the theory, `docs/gcdr.md` |
//! | `ledger`, `scale` | what the rules keep account of; units |
//! | `start`, `promise`, `claims` | the initial triangulation and its region; the level; the end |
//! | `strict` | the choices: order, points, skips |
//! | `space` | tetrahedra: predicates and links, for traces and for `audit` |
//! | `spacing` | local feature size, and the rows that speak of it |
//! | `grading`, `scalar`, `rational` | constants of the theory, with square roots |

mod cause;
mod checker;
mod claims;
mod complex;
mod condition;
mod exact;
mod filler;
pub mod grading;
mod ledger;
mod predicates;
mod promise;
pub mod rational;
mod replay;
mod rows;
pub mod scalar;
mod scale;
mod shells;
mod sight;
mod snapshot;
pub mod space;
pub mod spacing;
mod split;
mod start;
mod strict;
mod surgery;
pub(crate) mod value;
mod verdict;

#[cfg(test)]
mod tests;

pub use checker::{Checker, Options, verify};
pub use verdict::{Place, Rejection, Rule, Unchecked, Verdict};
