//! Floor 1: the vocabulary of traces, and their two canonical forms.
//!
//! Problem: a trace has to be read by people, diffed, hashed, and written at a million events a second. Idea: one vocabulary (`Record`),
//! two forms of the same content, each canonical, so that equal content is equal bytes and every byte says something.
//! Source: `docs/trace-format.md`, which is normative.

mod binary;
mod compare;
mod digest;
mod grammar;
mod record;
mod sinks;
mod space;
mod stream;
mod text;

pub use compare::{Comparing, Divergence, first_divergence};
pub use digest::mesh_digest;
pub use record::{
    Algorithm, Cause, Counts, End, Event, Header, Outcome, Record, Shell, Sink, SkipReason, SplitKind, Why,
};
pub use sinks::{Discard, Recorder};
pub(crate) use space::TriangulationDigest;
pub use space::{Apex, Bits, Counts3, End3, Event3, Header3, INFINITE, Record3, apex_id, triangulation_digest};
pub use stream::{DecodeError, Format, Place, Reader, Writer};
