//! Triangulations of space with their traces: of a point set at once, or step by step; and sessions, in which a caller inserts points, takes them
//! out and changes their weights. The one writer of events of space.
//!
//! What a trace says is in `docs/trace-format.md`: a finished triangulation is its own certificate, events name what they destroy or make by codes
//! (`codes`).

mod codes;
mod names;
mod session;
mod triangulate;

pub use session::Session;
pub use triangulate::{Certificate, triangulate3};
