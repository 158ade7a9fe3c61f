//! The constrained Delaunay triangulation of the plane, unique under the one tie-break.

mod store;

pub use store::{Cdt2, Change, HalfEdge, TriId};

/// Why a triangulation cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// Two vertices have the same coordinates.
    #[error("vertices {} and {} have the same coordinates", .0.0, .1.0)]
    Duplicate(crate::model::VertexId, crate::model::VertexId),
    /// Fewer than three points, or all on one line.
    #[error("the points lie on one line")]
    Collinear,
    /// Two segments cross, or a vertex lies inside a segment: the input was not repaired.
    #[error("segment {} meets segment or vertex {} in its interior", .0.0, .1)]
    Crossing(crate::model::SegmentId, u32),
}
