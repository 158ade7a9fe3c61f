//! The constrained Delaunay triangulation of the plane, unique under the one tie-break.

mod store;

pub use store::{Cdt2, Change, HalfEdge, TriId};
