//! Top floor, beside the command line: what a fuzzer throws at the library, and what must hold whatever it throws.
//!
//! Problem: the promises of the library are for all inputs, and a test chosen by hand visits those its author thought of. Idea: each promise
//! is a *case*, a value decoded from arbitrary bytes with a method `run` that asserts it; the targets of `fuzz/` are one line each,
//! and the ordinary tests replay their corpora. Cases draw from `generators`, so that mutated bytes stay ties, near-ties and changes of scale.
//!
//! - `KernelCase`: every method of the fast kernel gives the bits of the exact one.
//! - `KernelCase3`: the same in space.
//! - `CdtCase`: a triangulation under insertions, splits, deletions and rollbacks equals a fresh build and the definition.
//! - `EditCase3`: a regular triangulation of space under insertions, removals and changes of weight, likewise; and on both kernels.
//! - `GcdrCase`: both kernels write the same trace, the strict checker accepts it, both forms of it read back.
//! - `MutatedTraceCase`: of a true trace with one record changed, or with bytes changed, the strict checker accepts none.
//! - `MutatedTrace3Case`: the same in space.
//! - `UserCase`: whatever a user's choices and sizes answer, the run refuses it by name or its trace is accepted.
//! - `MutatedMeshCase`: the audit calls a changed mesh right exactly if it is.
//! - `readers`: any bytes are read or refused; what was read, written, and read again is the same.

mod answer;
mod audits;
mod cdt;
mod edits3;
mod kernels;
mod kernels3;
mod mutations;
mod mutations3;
pub mod readers;
mod readers3;
mod refinement;
mod users;

pub use audits::MutatedMeshCase;
pub use cdt::{CdtCase, Step as CdtStep};
pub use edits3::{EditCase3, Image as Image3, by_definition as regular_by_definition};
pub use kernels::KernelCase;
pub use kernels3::KernelCase3;
pub use mutations::MutatedTraceCase;
pub use mutations3::MutatedTrace3Case;
pub use refinement::GcdrCase;
pub use users::UserCase;
