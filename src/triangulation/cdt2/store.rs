//! Triangles, their links, and the marks of constraints. Knows no coordinates beyond handing them out.
//!
//! Half-edge `4 t + k` is the edge of triangle t from corner k to corner k + 1. A link is the half-edge on the other side,
//! with the top bit set if the edge is constrained; the label of a constrained edge stands in an array of its own, which
//! unconstrained edges never touch. All writes go through the methods at the end, which keep the journal.

use super::journal::{Journal, Undo};
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

impl Change {
    /// Empties both lists, keeping their memory.
    pub fn clear(&mut self) {
        self.destroyed.clear();
        self.created.clear();
    }
}

/// No vertex, no half-edge, no label.
pub(super) const NONE: u32 = u32::MAX;

/// The region of triangles that `carve` left out. They stay as filler, so that the triangles around a vertex are one
/// run also where the region touches itself there; nothing of them is seen from without, nor are they Delaunay.
pub(super) const OUTSIDE: u32 = u32::MAX;

/// What a half-edge is glued to: a half-edge or nothing, and whether the edge is constrained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Link(u32);

impl Link {
    const CONSTRAINED: u32 = 1 << 31;
    const OPEN: u32 = Self::CONSTRAINED - 1;

    /// An unconstrained edge with nothing on the other side.
    pub(super) const BORDER: Link = Link(Self::OPEN);

    /// An unconstrained edge with half-edge e on the other side.
    #[inline]
    pub(super) fn to(e: u32) -> Link {
        Link(e)
    }

    /// The half-edge on the other side.
    #[inline]
    pub(super) fn twin(self) -> Option<u32> {
        let e = self.0 & Self::OPEN;
        (e != Self::OPEN).then_some(e)
    }

    /// The half-edge on the other side, if a flood may cross to it.
    #[inline]
    pub(super) fn passage(self) -> Option<u32> {
        (self.0 < Self::OPEN).then_some(self.0)
    }

    #[inline]
    pub(super) fn is_constrained(self) -> bool {
        self.0 & Self::CONSTRAINED != 0
    }

    #[inline]
    pub(super) fn constrained(self) -> Link {
        Link(self.0 | Self::CONSTRAINED)
    }

    /// The same mark, another (or no) half-edge.
    #[inline]
    pub(super) fn redirected(self, e: Option<u32>) -> Link {
        Link(self.0 & Self::CONSTRAINED | e.unwrap_or(Self::OPEN))
    }
}

/// A triangle. A free slot has no vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Slot {
    /// Vertices, counterclockwise.
    pub(super) v: [u32; 3],
    pub(super) birth: u32,
    /// Links of the three edges.
    pub(super) link: [Link; 3],
    pub(super) region: u32,
}

impl Slot {
    pub(super) const FREE: Slot = Slot { v: [NONE; 3], birth: 0, link: [Link::BORDER; 3], region: 0 };

    #[inline]
    pub(super) fn is_free(&self) -> bool {
        self.v[0] == NONE
    }

    /// Whether the slot holds a triangle of the region.
    #[inline]
    pub(super) fn is_inside(&self) -> bool {
        self.v[0] != NONE && self.region != OUTSIDE
    }

    /// The vertices, the smallest first.
    pub(super) fn canonical(&self) -> Triangle {
        crate::model::canonical_triangle(self.v.map(VertexId))
    }
}

/// k + 1 modulo 3.
pub(super) const SUCC: [u32; 4] = [1, 2, 0, 0];
/// k + 2 modulo 3.
pub(super) const PRED: [u32; 4] = [2, 0, 1, 0];

/// The half-edge after e, counterclockwise in its triangle.
#[inline]
pub(super) fn next(e: u32) -> u32 {
    (e & !3) | SUCC[(e & 3) as usize]
}

/// The half-edge before e, counterclockwise in its triangle.
#[inline]
pub(super) fn prev(e: u32) -> u32 {
    (e & !3) | PRED[(e & 3) as usize]
}

/// A constrained Delaunay triangulation, of a convex hull or of what `carve` left of it.
///
/// Limits: fewer than 2^29 triangles. Coordinates obey the rules of `arith::Kernel`.
#[derive(Clone)]
pub struct Cdt2<K: Kernel> {
    pub(super) points: Vec<Point2>,
    /// Per vertex, some live half-edge from it, or `NONE`.
    pub(super) hints: Vec<u32>,
    pub(super) slots: Vec<Slot>,
    /// Labels of the three edges of each slot; meaningful where the link is constrained.
    pub(super) labels: Vec<[u32; 3]>,
    pub(super) free: Vec<u32>,
    /// How many triangles are `OUTSIDE`.
    pub(super) outside: usize,
    pub(super) clock: u32,
    pub(super) journal: Journal,
    pub(super) scratch: super::insert::Scratch,
    pub(super) kernel: PhantomData<K>,
}

impl<K: Kernel> Cdt2<K> {
    /// Coordinates of a vertex, also of a deleted one.
    #[inline]
    pub fn point(&self, v: VertexId) -> Point2 {
        self.points[v.index()]
    }

    /// How many vertex ids were given out; deleted vertices count.
    pub fn vertex_count(&self) -> usize {
        self.points.len()
    }

    /// How many triangles there are.
    pub fn triangle_count(&self) -> usize {
        self.slots.len() - self.free.len() - self.outside
    }

    /// The triangles, by slot.
    pub fn triangles(&self) -> impl Iterator<Item = TriId> + '_ {
        let live = self.slots.iter().enumerate().filter(|(_, s)| s.is_inside());
        // Slots number fewer than 2^29 (checked where they are added).
        live.map(|(i, _)| TriId(i as u32))
    }

    /// Whether the slot holds a triangle.
    pub fn is_live(&self, t: TriId) -> bool {
        self.slots.get(t.0 as usize).is_some_and(Slot::is_inside)
    }

    /// The vertices of a triangle, counterclockwise.
    #[inline]
    pub fn vertices(&self, t: TriId) -> [VertexId; 3] {
        self.slots[t.0 as usize].v.map(VertexId)
    }

    /// The corners of a triangle, counterclockwise.
    #[inline]
    pub fn corners(&self, t: TriId) -> Corners {
        self.corners_of(&self.slots[t.0 as usize].v)
    }

    /// The clock when the triangle was created.
    #[inline]
    pub fn birth(&self, t: TriId) -> u32 {
        self.slots[t.0 as usize].birth
    }

    /// The region of a triangle: 0 for none, else 1 + the position of its seed.
    #[inline]
    pub fn region(&self, t: TriId) -> u32 {
        self.slots[t.0 as usize].region
    }

    /// The edges of a triangle, from corner 0, 1 and 2.
    #[inline]
    pub fn edges(&self, t: TriId) -> [HalfEdge; 3] {
        [0, 1, 2].map(|k| HalfEdge(4 * t.0 + k))
    }

    /// The triangle left of an edge.
    #[inline]
    pub fn triangle_of(&self, e: HalfEdge) -> TriId {
        TriId(e.0 >> 2)
    }

    /// The edge after e, counterclockwise in its triangle.
    #[inline]
    pub fn next(&self, e: HalfEdge) -> HalfEdge {
        HalfEdge(next(e.0))
    }

    /// The edge before e, counterclockwise in its triangle.
    #[inline]
    pub fn prev(&self, e: HalfEdge) -> HalfEdge {
        HalfEdge(prev(e.0))
    }

    /// The vertex an edge starts from.
    #[inline]
    pub fn origin(&self, e: HalfEdge) -> VertexId {
        VertexId(self.origin_of(e.0))
    }

    /// The vertex an edge leads to.
    #[inline]
    pub fn destination(&self, e: HalfEdge) -> VertexId {
        VertexId(self.origin_of(next(e.0)))
    }

    /// The third vertex of the triangle left of an edge.
    #[inline]
    pub fn apex(&self, e: HalfEdge) -> VertexId {
        VertexId(self.origin_of(prev(e.0)))
    }

    /// The same edge seen from the other side; `None` where there is no triangle.
    #[inline]
    pub fn twin(&self, e: HalfEdge) -> Option<HalfEdge> {
        let f = self.link(e.0).twin()?;
        self.slots[(f >> 2) as usize].is_inside().then_some(HalfEdge(f))
    }

    /// Whether the edge is part of an input segment.
    #[inline]
    pub fn is_constrained(&self, e: HalfEdge) -> bool {
        self.link(e.0).is_constrained()
    }

    /// The input segment that the edge is part of.
    #[inline]
    pub fn segment(&self, e: HalfEdge) -> Option<SegmentId> {
        self.link(e.0).is_constrained().then(|| SegmentId(self.label(e.0)))
    }

    /// Some half-edge of the region with origin v; `None` for a deleted vertex or one in no kept triangle.
    pub fn edge_from(&self, v: VertexId) -> Option<HalfEdge> {
        self.edges_around(v).next()
    }

    /// The half-edge from u to v, if it exists on a triangle of the region (then its left side), found by turning around u.
    pub fn find_edge(&self, u: VertexId, v: VertexId) -> Option<HalfEdge> {
        self.edges_around(u).find(|&e| self.destination(e) == v)
    }

    /// The half-edges of the region with origin v: counterclockwise from some first one, then, if v is on the hull,
    /// clockwise from there.
    pub fn edges_around(&self, v: VertexId) -> impl Iterator<Item = HalfEdge> + '_ {
        let start = self.hints.get(v.index()).copied().filter(|&e| e != NONE);
        let mut last = start;
        let mut counterclockwise = true;
        let turn = move || {
            let e = last?;
            if counterclockwise {
                last = self.link(prev(e)).twin();
                if last.is_none() {
                    counterclockwise = false;
                    last = start;
                } else if last == start {
                    last = None;
                    return Some(e);
                } else {
                    return Some(e);
                }
            }
            last = last.and_then(|f| self.link(f).twin()).map(next);
            Some(e)
        };
        std::iter::from_fn(turn).filter(|&e| self.slots[(e >> 2) as usize].is_inside()).map(HalfEdge)
    }

    /// Birth that triangles created from now on carry.
    pub fn set_clock(&mut self, now: u32) {
        self.clock = now;
    }

    // Within the triangulation: raw reading.

    #[inline]
    pub(super) fn corners_of(&self, v: &[u32; 3]) -> Corners {
        v.map(|v| self.points[v as usize])
    }

    #[inline]
    pub(super) fn origin_of(&self, e: u32) -> u32 {
        // The low bits of a half-edge are 0, 1 or 2; the minimum tells the compiler so.
        self.slots[(e >> 2) as usize].v[((e & 3) as usize).min(2)]
    }

    #[inline]
    pub(super) fn link(&self, e: u32) -> Link {
        self.slots[(e >> 2) as usize].link[((e & 3) as usize).min(2)]
    }

    #[inline]
    pub(super) fn label(&self, e: u32) -> u32 {
        self.labels[(e >> 2) as usize][((e & 3) as usize).min(2)]
    }

    // Within the triangulation: writing. Everything that changes after construction passes here.

    /// Adds a vertex; its hint is not yet set.
    pub(super) fn add_point(&mut self, p: Point2) -> u32 {
        // Ids reach neither NONE nor the top bit: there are fewer vertices than triangles allowed.
        let v = self.points.len() as u32;
        self.points.push(p);
        self.hints.push(NONE);
        v
    }

    /// A slot to write to.
    pub(super) fn take_slot(&mut self) -> u32 {
        match self.free.pop() {
            Some(t) => {
                self.journal.record(|| Undo::Taken(t));
                t
            }
            None => {
                let t = self.slots.len() as u32;
                assert!(t < 1 << 29, "a triangulation holds fewer than 2^29 triangles");
                self.slots.push(Slot::FREE);
                self.labels.push([NONE; 3]);
                t
            }
        }
    }

    /// Frees the slot of a triangle.
    pub(super) fn release_slot(&mut self, t: u32) {
        self.write_slot(t, Slot::FREE);
        self.free.push(t);
        self.journal.record(|| Undo::Released);
    }

    #[inline]
    pub(super) fn write_slot(&mut self, t: u32, slot: Slot) {
        let i = t as usize;
        if self.journal.is_on() {
            self.journal.record(|| Undo::Slot(t, self.slots[i], self.labels[i]));
        }
        self.slots[i] = slot;
    }

    #[inline]
    pub(super) fn write_link(&mut self, e: u32, link: Link) {
        let place = &mut self.slots[(e >> 2) as usize].link[((e & 3) as usize).min(2)];
        self.journal.record(|| Undo::Link(e, *place));
        *place = link;
    }

    #[inline]
    pub(super) fn write_label(&mut self, e: u32, label: u32) {
        let place = &mut self.labels[(e >> 2) as usize][((e & 3) as usize).min(2)];
        self.journal.record(|| Undo::Label(e, *place));
        *place = label;
    }

    #[inline]
    pub(super) fn write_hint(&mut self, v: u32, e: u32) {
        let place = &mut self.hints[v as usize];
        self.journal.record(|| Undo::Hint(v, *place));
        *place = e;
    }

    /// Links e to what is outside both ways, with the mark and label that this link carries.
    #[inline]
    pub(super) fn glue(&mut self, e: u32, outer: Link, label: u32) {
        self.write_link(e, outer);
        self.glue_back(e, outer, label);
    }

    /// The other half of `glue`, for an edge whose own link is already written.
    #[inline]
    pub(super) fn glue_back(&mut self, e: u32, outer: Link, label: u32) {
        if outer.is_constrained() {
            self.write_label(e, label);
        }
        if let Some(f) = outer.twin() {
            self.write_link(f, outer.redirected(Some(e)));
        }
    }
}
