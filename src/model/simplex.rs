//! Simplices as tuples of vertex ids.

use super::VertexId;

/// A subsegment or edge by its ends, the smaller id first.
pub type Edge = [VertexId; 2];

/// A triangle by its vertices in counterclockwise order, the smallest id first: equal triangles have equal tuples.
pub type Triangle = [VertexId; 3];

/// Rotates a counterclockwise triangle so that its smallest id comes first.
pub fn canonical_triangle(t: [VertexId; 3]) -> Triangle {
    let [a, b, c] = t;
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
