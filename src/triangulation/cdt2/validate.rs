//! What must hold of a triangulation, in layers: each assumes the ones before it.

use super::store::{Cdt2, NONE, TriId, next, prev};
use crate::arith::Kernel;
use crate::model::VertexId;

/// What does not hold, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Violation {
    /// A free slot is linked to, or listed wrongly.
    #[error("slot {} is free but in use, or in use but listed as free", .0.0)]
    Free(TriId),
    /// A triangle repeats a vertex or names one that does not exist.
    #[error("triangle {:?} does not have three vertices", .0)]
    Vertices([VertexId; 3]),
    /// The two sides of an edge do not agree on its ends, its mark or its label.
    #[error("the sides of edge {}-{} disagree", .0.0, .1.0)]
    Link(VertexId, VertexId),
    /// A vertex's hint is not a half-edge from it.
    #[error("the hint of vertex {} does not start there", .0.0)]
    Hint(VertexId),
    /// A triangle is not counterclockwise.
    #[error("triangle {:?} is not counterclockwise", .0)]
    Orientation([VertexId; 3]),
    /// The vertex is in conflict with the triangle across an unconstrained edge.
    #[error("triangle {:?} is in conflict with vertex {} across an edge", .0, .1.0)]
    Delaunay([VertexId; 3], VertexId),
    /// The border turns right at a vertex, or does not close.
    #[error("the border is not convex at vertex {}", .0.0)]
    Hull(VertexId),
    /// Euler's relation fails: the triangles do not cover the hull once.
    #[error("{triangles} triangles on {vertices} vertices, {border} of them on the hull")]
    Count {
        /// Triangles.
        triangles: usize,
        /// Vertices with triangles.
        vertices: usize,
        /// Border edges.
        border: usize,
    },
}

impl<K: Kernel> Cdt2<K> {
    /// Links are symmetric, agree on ends, marks and labels; hints start at their vertices; free slots are free. Assumes nothing.
    pub fn validate_links(&self) -> Result<(), Violation> {
        let mut used = vec![false; self.points.len()];
        for t in self.triangles() {
            let v = self.vertices(t);
            let [a, b, c] = v;
            if a == b || b == c || c == a || v.iter().any(|v| v.index() >= self.points.len()) {
                return Err(Violation::Vertices(v));
            }
            for e in self.edges(t) {
                used[self.origin(e).index()] = true;
                self.validate_link(e.0)?;
            }
        }
        let free = self.slots.iter().filter(|s| s.is_free()).count();
        if let Some(&t) = self.free.iter().find(|&&t| self.holds(t)) {
            return Err(Violation::Free(TriId(t)));
        }
        if free != self.free.len() || self.labels.len() != self.slots.len() || self.hints.len() != self.points.len() {
            return Err(Violation::Free(TriId(NONE)));
        }
        for (v, (&hint, used)) in (0u32..).zip(self.hints.iter().zip(used)) {
            let good = match hint {
                NONE => !used,
                e => self.holds(e >> 2) && e & 3 < 3 && self.origin_of(e) == v,
            };
            if !good {
                return Err(Violation::Hint(VertexId(v)));
            }
        }
        Ok(())
    }

    /// Whether the slot holds a triangle, of the region or outside.
    fn holds(&self, t: u32) -> bool {
        self.slots.get(t as usize).is_some_and(|s| !s.is_free())
    }

    fn validate_link(&self, e: u32) -> Result<(), Violation> {
        let link = self.link(e);
        let ends = [self.origin_of(e), self.origin_of(next(e))];
        let violation = Violation::Link(VertexId(ends[0]), VertexId(ends[1]));
        let Some(f) = link.twin() else { return Ok(()) };
        if !self.holds(f >> 2) {
            return Err(Violation::Free(TriId(f >> 2)));
        }
        let back = self.link(f);
        let agree = back.twin() == Some(e)
            && [self.origin_of(next(f)), self.origin_of(f)] == ends
            && back.is_constrained() == link.is_constrained()
            && (!link.is_constrained() || self.label(e) == self.label(f));
        if agree { Ok(()) } else { Err(violation) }
    }

    /// Every triangle is counterclockwise.
    pub fn validate_orientation(&self) -> Result<(), Violation> {
        for t in self.triangles() {
            let [a, b, c] = self.corners(t);
            if !K::orient2d(a, b, c).is_positive() {
                return Err(Violation::Orientation(self.vertices(t)));
            }
        }
        Ok(())
    }

    /// Every unconstrained edge is locally Delaunay under the tie-break; with correct links and orientations the whole is then
    /// the constrained Delaunay triangulation.
    pub fn validate_delaunay(&self) -> Result<(), Violation> {
        for t in self.triangles() {
            for e in self.edges(t) {
                let Some(f) = self.link(e.0).passage() else {
                    continue;
                };
                let apex = VertexId(self.origin_of(prev(f)));
                if K::in_conflict(self.corners(t), self.point(apex)) {
                    return Err(Violation::Delaunay(self.vertices(t), apex));
                }
            }
        }
        Ok(())
    }

    /// The border is one convex polygon and the triangles cover it (before `carve`).
    pub fn validate_hull(&self) -> Result<(), Violation> {
        let mut after = vec![NONE; self.points.len()];
        let mut border = 0;
        let mut start = NONE;
        for e in self.triangles().flat_map(|t| self.edges(t)) {
            if self.twin(e).is_none() {
                let u = self.origin(e);
                if after[u.index()] != NONE {
                    return Err(Violation::Hull(u));
                }
                after[u.index()] = self.destination(e).0;
                start = u.0;
                border += 1;
            }
        }
        let mut u = start;
        for _ in 0..border {
            let v = after[u as usize];
            let w = if v == NONE { NONE } else { after[v as usize] };
            if w == NONE {
                return Err(Violation::Hull(VertexId(u)));
            }
            let [pu, pv, pw] = [u, v, w].map(|v| self.points[v as usize]);
            if K::orient2d(pu, pv, pw).is_negative() {
                return Err(Violation::Hull(VertexId(v)));
            }
            u = v;
        }
        let vertices = self.hints.iter().filter(|&&h| h != NONE).count();
        let triangles = self.triangle_count();
        // Euler: t = 2 n - 2 - h.
        if u != start || triangles + 2 + border != 2 * vertices {
            return Err(Violation::Count { triangles, vertices, border });
        }
        Ok(())
    }
}
