//! Floor 1: the vocabulary of traces, and their two canonical forms.

mod record;

pub use record::{
    Algorithm, Cause, Counts, End, Event, Header, Outcome, Record, Shell, Sink, SkipReason,
    SplitKind, Why,
};
