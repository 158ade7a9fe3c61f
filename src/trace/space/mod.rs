//! The records of a triangulation of space, in both forms.
//!
//! Problem: an insertion into a triangulation of space destroys some twenty tetrahedra and makes some thirty; naming them takes ten times the
//! point. Idea: a checker holds the complex anyway, so an event names one tetrahedron and then says, facet by facet in the order of a
//! flood, whether the tetrahedron beyond is destroyed too (`Bits`), some six bytes; a removal names the apexes that fill the hole, in an order
//! that follows from the hole. Both forms carry these codes as they are, so that neither needs a complex to be read.
//!
//! Points and weights are input: they stand in records of their own, bound by digests. Events hold only what follows from them.

pub(super) mod binary;
mod digest;
pub(super) mod grammar;
mod record;
pub(super) mod text;

pub(crate) use digest::TriangulationDigest;
pub use digest::triangulation_digest;
pub use record::{Apex, Bits, Counts3, End3, Event3, Header3, INFINITE, Record3, apex_id};
