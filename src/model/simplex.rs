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

/// A facet (a triangle in space) or a tetrahedron's side by its vertices; the orientation is the context's.
pub type Facet = [VertexId; 3];

/// A positively oriented tetrahedron by its vertices in ascending order, save that the last two are swapped where ascending order is
/// negative: equal tetrahedra have equal tuples.
pub type Tetrahedron = [VertexId; 4];

/// The even permutation of a positively oriented tetrahedron that is its canonical tuple.
pub fn canonical_tetrahedron(mut t: [VertexId; 4]) -> Tetrahedron {
    let mut odd = false;
    // A network without branches, since no order of ids can be foreseen; every exchange flips the parity.
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        let (x, y) = (t[i], t[j]);
        odd ^= y < x;
        (t[i], t[j]) = (x.min(y), x.max(y));
    }
    let (c, d) = (t[2], t[3]);
    (t[2], t[3]) = if odd { (d, c) } else { (c, d) };
    t
}
