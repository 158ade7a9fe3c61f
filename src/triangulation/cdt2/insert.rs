//! Insertion of a free vertex and split of a segment: flood the conflict zone, star the cavity.
//!
//! Source: \[GCDR\] Algorithm 1; the order of the flood is that of `docs/trace-format.md`, 'Flood order'.
//!
//! The cavity is star-shaped around p and its triangles form a tree: from a triangle in conflict with p, entered across an
//! edge that p lies strictly on the near side of, p sees the two other edges from inside, because beyond the chord of
//! the entry edge the circle stays between their lines. This holds with ties too, and for a split point off its segment
//! once the triangles with the ends and apexes are positively oriented (section 4.3 of `docs/gcdr.md`).

use super::polygon::Polygon;
use super::store::{Cdt2, Change, HalfEdge, Link, NONE, OUTSIDE, Slot, TriId, next, prev};
use crate::arith::Kernel;
use crate::model::{Point2, VertexId};

/// An edge of the cavity's boundary, seen from inside.
#[derive(Clone, Copy, Debug)]
struct Rim {
    origin: u32,
    outer: Link,
    label: u32,
    region: u32,
}

/// Work lists kept for reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    stack: Vec<u32>,
    /// Triangles of the conflict zone; after starring, the slots of the new triangles.
    zone: Vec<u32>,
    /// Boundary of the cavity, counterclockwise.
    rim: Vec<Rim>,
    /// The star of a vertex to be deleted.
    pub(super) polygon: Polygon,
}

/// What becomes of the two half-edges from the ends of a cavity's boundary to p.
#[derive(Clone, Copy, Debug)]
enum Closing {
    /// The boundary is closed; no edge at p is constrained.
    Free,
    /// The boundary is closed; the edges from p to the two vertices carry the label.
    Through([u32; 2], u32),
    /// The boundary is a path ending at the second vertex; the edges from p to both carry the label and are border.
    Border([u32; 2], u32),
}

impl<K: Kernel> Cdt2<K> {
    /// Inserts p, strictly inside the circle of t and seen from it with no constraint on the way (section 4 of the algorithm).
    ///
    /// t and the triangles in conflict with p that are connected to it across unconstrained edges are replaced by the star of p.
    pub fn insert(&mut self, t: TriId, p: Point2, change: &mut Change) -> VertexId {
        change.clear();
        let v = self.slots[t.0 as usize].v;
        let first = (0..3).min_by_key(|&k| v[k as usize]).unwrap_or(0);
        let mut s = self.begin();
        s.zone.push(t.0);
        let e = 4 * t.0 + first;
        s.stack.extend([prev(e), next(e), e]);
        self.flood(&mut s, p);
        let v = self.star(&mut s, p, Closing::Free, change);
        self.scratch = s;
        VertexId(v)
    }

    /// Whether the constrained edge e = (u, v) can be split at p: with a the apex on a side in the region, (u, p, a) and (p, v, a) are positively
    /// oriented and p is in conflict with (u, v, a); on the other side the filler gives way.
    ///
    /// All of it is true of a point on e. A rounded one can lie further off e than a circle bulges beyond it, or than what lies across a gap.
    pub fn may_split(&self, e: HalfEdge, p: Point2) -> bool {
        [Some(e.0), self.link(e.0).twin()].into_iter().flatten().all(|e| {
            if !self.slots[(e >> 2) as usize].is_inside() {
                return self.filler_gives_way(e, p);
            }
            let [u, v, a] = self.corners_of(&[e, next(e), prev(e)].map(|e| self.origin_of(e)));
            K::orient2d(u, p, a).is_positive() && K::orient2d(p, v, a).is_positive() && K::in_conflict([u, v, a], p)
        })
    }

    /// Whether the filler that p, rounded off the border edge `root`, sweeps over can be starred anew: it ends before the next constrained edge
    /// and encloses no vertex. Filler thus stays a triangulation, and the region never meets itself across it.
    fn filler_gives_way(&self, root: u32, p: Point2) -> bool {
        if self.side(root, p).is_negative() {
            return true;
        }
        let mut zone = std::collections::BTreeSet::from([root >> 2]);
        let mut stack = if self.is_filler(root) { vec![prev(root), next(root)] } else { Vec::new() };
        while let Some(e) = stack.pop() {
            if let Some(f) = self.swept(e, p) {
                if !zone.insert(f >> 2) {
                    return false;
                }
                stack.extend([prev(f), next(f)]);
            } else if self.link(e).is_constrained() && !self.side(e, p).is_positive() {
                return false;
            }
        }
        true
    }

    /// Whether the triangle of e, outside, is positively oriented. One that was turned over stands where p left the hull: nothing lies there.
    fn is_filler(&self, e: u32) -> bool {
        let [a, b, c] = self.corners_of(&self.slots[(e >> 2) as usize].v);
        K::orient2d(a, b, c).is_positive()
    }

    /// The half-edge on the other side of e, an edge of filler, if p lies on or beyond e and filler is there.
    fn swept(&self, e: u32, p: Point2) -> Option<u32> {
        self.link(e).passage().filter(|&f| !self.side(e, p).is_positive() && self.is_filler(f))
    }

    /// Splits the constrained edge e at p: its one or two triangles are destroyed without test, then the flood goes on
    /// from each on its own side (outside, to what p sweeps over). The new edges (u, p), (p, v) carry the segment's id.
    ///
    /// Shape: `may_split` (the caller's test).
    pub fn split(&mut self, e: HalfEdge, p: Point2, change: &mut Change) -> VertexId {
        change.clear();
        debug_assert!(self.is_constrained(e));
        let label = self.label(e.0);
        let twin = self.link(e.0).twin();
        // The side left of u -> v, u < v, comes first.
        let forward = self.origin_of(e.0) < self.origin_of(next(e.0));
        let (first, second) = if forward { (Some(e.0), twin) } else { (twin, Some(e.0)) };
        let mut s = self.begin();
        for root in [first, second].into_iter().flatten() {
            if self.slots[(root >> 2) as usize].is_inside() {
                s.zone.push(root >> 2);
                s.stack.extend([prev(root), next(root)]);
                self.flood(&mut s, p);
            } else {
                self.outside += 1;
                self.flood_filler(&mut s, root, p);
            }
        }
        let [u, v] = [self.origin_of(e.0), self.origin_of(next(e.0))];
        let closing = match twin {
            Some(_) => Closing::Through([u, v], label),
            // The boundary of the left side of u -> v runs from v to u.
            None => Closing::Border([v, u], label),
        };
        let v = self.star(&mut s, p, closing, change);
        self.scratch = s;
        VertexId(v)
    }

    fn begin(&mut self) -> Scratch {
        let mut s = std::mem::take(&mut self.scratch);
        s.stack.clear();
        s.zone.clear();
        s.rim.clear();
        s
    }

    /// Crosses the half-edges on the stack, depth first, into triangles in conflict with p; collects these and the boundary.
    fn flood(&self, s: &mut Scratch, p: Point2) {
        while let Some(e) = s.stack.pop() {
            let inner = &self.slots[(e >> 2) as usize];
            let k = ((e & 3) as usize).min(2);
            let outer = inner.link[k];
            if let Some(f) = outer.passage() {
                let beyond = &self.slots[(f >> 2) as usize];
                if K::in_conflict(self.corners_of(&beyond.v), p) {
                    // The triangles form a tree (module head): more of them than slots means a broken precondition.
                    assert!(s.zone.len() <= self.slots.len(), "the cavity is not star-shaped");
                    s.zone.push(f >> 2);
                    s.stack.extend([prev(f), next(f)]);
                    continue;
                }
            }
            s.rim.push(self.rim(e));
        }
    }

    /// The same outside the region, for a border edge `root` that may be split at p: what p sweeps over goes. If p was rounded into the region,
    /// that is nothing, and a triangle between the edge and p comes in addition.
    fn flood_filler(&self, s: &mut Scratch, root: u32, p: Point2) {
        if self.side(root, p).is_negative() {
            s.rim.push(Rim { origin: self.origin_of(next(root)), outer: Link::to(root), label: NONE, region: OUTSIDE });
            return;
        }
        s.zone.push(root >> 2);
        s.stack.extend([prev(root), next(root)]);
        let whole = self.is_filler(root);
        while let Some(e) = s.stack.pop() {
            match self.swept(e, p).filter(|_| whole) {
                Some(f) => {
                    s.zone.push(f >> 2);
                    s.stack.extend([prev(f), next(f)]);
                }
                None => s.rim.push(self.rim(e)),
            }
        }
    }

    /// The half-edge e as an edge of the cavity's boundary.
    #[inline]
    fn rim(&self, e: u32) -> Rim {
        let outer = self.link(e);
        let label = if outer.is_constrained() { self.label(e) } else { NONE };
        let region = self.slots[(e >> 2) as usize].region;
        Rim { origin: self.origin_of(e), outer, label, region }
    }

    /// Replaces the conflict zone by the triangles (x, y, p) over the edges xy of its boundary.
    ///
    /// ```text
    ///      x_{i+1} ---- x_i          edge 0 of triangle i: x_i x_{i+1}, glued to what was outside
    ///          \   i   /             edge 1: x_{i+1} p, glued to edge 2 of triangle i + 1
    ///           \     /              edge 2: p x_i, glued to edge 1 of triangle i - 1
    ///            \   /
    ///              p
    /// ```
    fn star(&mut self, s: &mut Scratch, p: Point2, closing: Closing, change: &mut Change) -> u32 {
        let zone = s.zone.iter().map(|&t| &self.slots[t as usize]);
        change.destroyed.extend(zone.filter(|t| t.is_inside()).map(Slot::canonical));
        while s.zone.len() < s.rim.len() {
            s.zone.push(self.take_slot());
        }
        let p_id = self.add_point(p);
        let m = s.rim.len();
        let slots = &s.zone[..m];
        let mut before = slots[m - 1];
        for i in 0..m {
            let rim = s.rim[i];
            let (here, after) = (slots[i], if i + 1 < m { slots[i + 1] } else { slots[0] });
            let end = match closing {
                Closing::Border([_, last], _) if i + 1 == m => last,
                _ => s.rim[if i + 1 < m { i + 1 } else { 0 }].origin,
            };
            let link = [rim.outer, Link::to(4 * after + 2), Link::to(4 * before + 1)];
            let v = [rim.origin, end, p_id];
            debug_assert!(
                rim.region == OUTSIDE || {
                    let [a, b, c] = self.corners_of(&v);
                    K::orient2d(a, b, c).is_positive()
                }
            );
            self.write_slot(here, Slot { v, birth: self.clock, link, region: rim.region });
            self.write_hint(rim.origin, 4 * here);
            self.glue_back(4 * here, rim.outer, rim.label);
            if rim.region != OUTSIDE {
                change.created.push(TriId(here));
            }
            before = here;
        }
        self.write_hint(p_id, 4 * slots[0] + 2);
        self.mark_spokes(s, closing);
        p_id
    }

    /// Labels the edges between p and the ends of a split subsegment.
    fn mark_spokes(&mut self, s: &Scratch, closing: Closing) {
        let m = s.rim.len();
        match closing {
            Closing::Free => {}
            Closing::Through(ends, label) => {
                for i in (0..m).filter(|&i| ends.contains(&s.rim[i].origin)) {
                    let e = 4 * s.zone[i] + 2;
                    self.glue(e, self.link(e).constrained(), label);
                    // The other side's label: `glue` wrote this side's and both links.
                    self.write_label(4 * s.zone[if i == 0 { m - 1 } else { i - 1 }] + 1, label);
                }
            }
            Closing::Border([_, last], label) => {
                let border = Link::BORDER.constrained();
                self.glue(4 * s.zone[0] + 2, border, label);
                self.glue(4 * s.zone[m - 1] + 1, border, label);
                self.write_hint(last, 4 * s.zone[m - 1] + 1);
            }
        }
    }
}
