//! Triangles, their links, and the marks of constraints. Knows no coordinates beyond handing them out.

use crate::arith::{Corners, Kernel};
use crate::model::{Point2, SegmentId, Triangle, VertexId};
use std::marker::PhantomData;

/// A triangle's slot. Slots are reused: keep a `TriId` across a mutation only with its vertices and birth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TriId(pub(crate) u32);

/// An edge of a triangle, directed counterclockwise: `4 * triangle + k`, k in 0..3, from corner k to corner k+1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HalfEdge(pub(crate) u32);

/// What a mutation did. Reused by its caller; every mutator clears it first.
#[derive(Clone, Debug, Default)]
pub struct Change {
    /// Destroyed triangles, canonical. Insertions list them in flood order.
    pub destroyed: Vec<Triangle>,
    /// Created triangles.
    pub created: Vec<TriId>,
}

/// A constrained Delaunay triangulation, of a convex hull or of what `carve` left of it.
pub struct Cdt2<K: Kernel> {
    kernel: PhantomData<K>,
}

#[allow(unused_variables, missing_docs)]
impl<K: Kernel> Cdt2<K> {
    // reading
    pub fn point(&self, v: VertexId) -> Point2 {
        todo!()
    }
    pub fn vertex_count(&self) -> usize {
        todo!()
    }
    pub fn triangles(&self) -> impl Iterator<Item = TriId> + '_ {
        std::iter::empty()
    }
    pub fn is_live(&self, t: TriId) -> bool {
        todo!()
    }
    pub fn vertices(&self, t: TriId) -> [VertexId; 3] {
        todo!()
    }
    pub fn corners(&self, t: TriId) -> Corners {
        todo!()
    }
    pub fn birth(&self, t: TriId) -> u32 {
        todo!()
    }
    pub fn region(&self, t: TriId) -> u32 {
        todo!()
    }
    pub fn edges(&self, t: TriId) -> [HalfEdge; 3] {
        todo!()
    }
    pub fn triangle_of(&self, e: HalfEdge) -> TriId {
        todo!()
    }
    pub fn next(&self, e: HalfEdge) -> HalfEdge {
        todo!()
    }
    pub fn prev(&self, e: HalfEdge) -> HalfEdge {
        todo!()
    }
    pub fn origin(&self, e: HalfEdge) -> VertexId {
        todo!()
    }
    pub fn destination(&self, e: HalfEdge) -> VertexId {
        todo!()
    }
    pub fn apex(&self, e: HalfEdge) -> VertexId {
        todo!()
    }
    /// The same edge seen from the other side; `None` where there is no triangle.
    pub fn twin(&self, e: HalfEdge) -> Option<HalfEdge> {
        todo!()
    }
    pub fn segment(&self, e: HalfEdge) -> Option<SegmentId> {
        todo!()
    }
    /// Some live half-edge with origin v; `None` for a deleted vertex or one in no kept triangle.
    pub fn edge_from(&self, v: VertexId) -> Option<HalfEdge> {
        todo!()
    }
    /// The half-edge from u to v, if it exists on a live triangle (then its left side), found by turning around u.
    pub fn find_edge(&self, u: VertexId, v: VertexId) -> Option<HalfEdge> {
        todo!()
    }
    // construction
    /// The Delaunay triangulation of the points; at least 3 not on a line, all distinct (else an error naming ids).
    pub fn delaunay(points: Vec<Point2>) -> Result<Self, super::BuildError> {
        todo!()
    }
    /// Makes each segment (repaired: no crossings, no vertex inside, no duplicates) an edge; ids are positions.
    pub fn constrain(&mut self, segments: &[[VertexId; 2]]) -> Result<(), super::BuildError> {
        todo!()
    }
    // mutation
    /// From here on mutations are journalled, until `commit` or `rollback`.
    pub fn checkpoint(&mut self) {
        todo!()
    }
    /// Forgets the journal.
    pub fn commit(&mut self) {
        todo!()
    }
    /// Restores the state at `checkpoint`: same slots, same births.
    pub fn rollback(&mut self) {
        todo!()
    }
    /// Birth that triangles created from now on carry.
    pub fn set_clock(&mut self, now: u32) {
        todo!()
    }
    /// Inserts p, strictly inside the circle of t and seen from it with no constraint on the way (section 4 of the algorithm).
    pub fn insert(&mut self, t: TriId, p: Point2, change: &mut Change) -> VertexId {
        todo!()
    }
    /// Splits the constrained edge e at p.
    pub fn split(&mut self, e: HalfEdge, p: Point2, change: &mut Change) -> VertexId {
        todo!()
    }
    /// Deletes a vertex with no constrained edge, strictly interior.
    pub fn remove(&mut self, v: VertexId, change: &mut Change) {
        todo!()
    }
}
