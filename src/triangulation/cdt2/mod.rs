//! The constrained Delaunay triangulation of the plane, unique under the one tie-break.
//!
//! Problem: build it from points and segments, then insert free vertices by visibility, split segments and delete free
//! vertices, with the possibility of taking the last steps back.
//! Idea: triangles in one flat array, linked by half-edges; every operation replaces the triangles of a cavity by others
//! with the same boundary. Insertions star the cavity (`insert`, `split`); deletions and new segments triangulate its
//! boundary polygon (`polygon`). All decisions are the kernel's, so the result depends on the points and segments alone.
//! Sources: \[GCDR\] Algorithm 1 (Bowyer and Watson); the tie-break of `arith::perturb`.

mod build;
mod carve;
mod constrain;
mod hilbert;
mod insert;
mod journal;
mod locate;
mod polygon;
mod remove;
mod store;
#[cfg(test)]
mod tests;
mod validate;
mod visible;

pub use carve::{CarveError, Seed};
pub use locate::Location;
pub use store::{Cdt2, Change, HalfEdge, TriId};
pub use validate::Violation;
#[cfg(test)]
pub use visible::CONES;
pub use visible::{Target, Walk};

use crate::model::{SegmentId, VertexId};

/// Why a triangulation cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// Two vertices have the same coordinates: the lexicographically smallest such pair of ids.
    #[error("vertices {} and {} have the same coordinates", .0.0, .1.0)]
    Duplicate(VertexId, VertexId),
    /// Fewer than three points, or all on one line.
    #[error("the points lie on one line")]
    Collinear,
    /// Two segments cross or coincide: the input was not repaired.
    #[error("segments {} and {} cross or overlap", .0.0, .1.0)]
    Crossing(SegmentId, SegmentId),
    /// A vertex lies inside a segment (or is both its ends): the input was not repaired.
    #[error("vertex {} lies inside segment {}", .1.0, .0.0)]
    VertexOnSegment(SegmentId, VertexId),
}
