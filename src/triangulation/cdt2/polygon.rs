//! The constrained Delaunay triangulation of a polygon: what is filled in after a deletion or under a new segment.
//!
//! Idea: clip ears by exact orientation, then flip edges that are not locally Delaunay (Lawson). The work is done on a
//! small triangulation of its own with vertices numbered along the polygon, so that a vertex may occur twice on the
//! boundary, and outer edges are never flipped; the store sees only the result.

use super::store::{Cdt2, Link, NONE, PRED, SUCC, Slot, TriId};
use crate::arith::Kernel;
use crate::model::Point2;

/// One edge of the polygon with what lies outside of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    /// The vertex it starts from.
    pub(super) origin: u32,
    /// The old half-edge along it, inside the polygon; `NONE` if nothing is to be glued.
    pub(super) inner: u32,
}

/// A triangle inside the polygon: corners by position on the boundary, links `4 t + k` inside or `OUTER | position`.
#[derive(Clone, Copy, Debug)]
struct Piece {
    v: [u32; 3],
    link: [u32; 3],
}

const OUTER: u32 = 1 << 31;

/// A polygon, counterclockwise, and its triangulation.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygon {
    pub(super) sides: Vec<Side>,
    points: Vec<Point2>,
    pieces: Vec<Piece>,
    /// Where each polygon side ended up: a half-edge `4 t + k` of `pieces`.
    place: Vec<u32>,
    suspects: Vec<u32>,
}

impl Polygon {
    /// Starts anew with the given sides.
    pub(super) fn reset(&mut self) {
        self.sides.clear();
    }

    /// Triangulates a polygon that is weakly visible from its side 0: every point is seen from some point of that side.
    /// Vertices may occur more than once.
    ///
    /// The vertices from the end of side 0 on are scanned, keeping a chain that turns right everywhere; each new vertex closes
    /// triangles with the chain's end while that turns left. No other vertex lies in such a triangle, since the sight lines to
    /// side 0 do not cross. The chain left at last would turn right all the way on the left of side 0, so it has no inner vertex.
    pub(super) fn triangulate_below<K: Kernel>(&mut self, points: &[Point2]) {
        self.load(points);
        let n = self.sides.len() as u32;
        // (position, link behind the chain's edge that leads to it)
        let mut chain: Vec<(u32, u32)> = Vec::with_capacity(8);
        chain.push((1, OUTER));
        for w in (2..n).chain([0]) {
            let mut link = OUTER | if w == 0 { n - 1 } else { w - 1 };
            while let [.., (a, _), (b, behind)] = chain[..] {
                if !self.turns_left::<K>(a, b, w) {
                    break;
                }
                link = self.clip([a, b, w], behind, link);
                chain.pop();
            }
            chain.push((w, link));
        }
        debug_assert_eq!(chain.len(), 2);
        self.close(chain[1].1, 0);
        self.restore_delaunay::<K>();
    }

    /// Triangulates a polygon that is star-shaped around a point c, strictly inside it.
    ///
    /// A corner is clipped if it turns left and c is left of, or on, the edge that clips it; the rest stays star-shaped. Such
    /// a corner exists: insert c in the Delaunay triangulation of the rest and undo it by flips.
    pub(super) fn triangulate_around<K: Kernel>(&mut self, points: &[Point2], c: Point2) {
        self.load(points);
        let n = self.sides.len();
        let mut next: Vec<u32> = (1..n as u32).chain([0]).collect();
        // Link behind the edge that leads from a position to its next one.
        let mut behind: Vec<u32> = (0..n as u32).map(|i| OUTER | i).collect();
        let (mut a, mut left, mut idle) = (0u32, n, 0);
        while left > 3 {
            let b = next[a as usize];
            let d = next[b as usize];
            let [pa, pd] = [self.points[a as usize], self.points[d as usize]];
            if self.turns_left::<K>(a, b, d) && !K::orient2d(pa, pd, c).is_negative() {
                behind[a as usize] = self.clip([a, b, d], behind[a as usize], behind[b as usize]);
                next[a as usize] = d;
                left -= 1;
                idle = 0;
            } else {
                a = b;
                idle += 1;
                assert!(idle <= left, "the star of a vertex has an ear");
            }
        }
        let b = next[a as usize];
        let d = next[b as usize];
        let link = self.clip([a, b, d], behind[a as usize], behind[b as usize]);
        self.connect(link, behind[d as usize]);
        self.restore_delaunay::<K>();
    }

    fn load(&mut self, points: &[Point2]) {
        self.points.clear();
        self.points
            .extend(self.sides.iter().map(|s| points[s.origin as usize]));
        self.pieces.clear();
        self.place.clear();
        self.place.resize(self.sides.len(), NONE);
    }

    fn turns_left<K: Kernel>(&self, a: u32, b: u32, c: u32) -> bool {
        let p = |i: u32| self.points[i as usize];
        K::orient2d(p(a), p(b), p(c)).is_positive()
    }

    /// Adds the triangle (a, b, c) with the given links behind ab and bc; returns the link to its edge ac.
    fn clip(&mut self, v: [u32; 3], ab: u32, bc: u32) -> u32 {
        let t = 4 * self.pieces.len() as u32;
        self.pieces.push(Piece { v, link: [NONE; 3] });
        self.connect(t, ab);
        self.connect(t + 1, bc);
        t + 2
    }

    /// Side `position` of the polygon closes the triangulation at the given link.
    fn close(&mut self, link: u32, position: u32) {
        self.connect(link, OUTER | position);
    }

    /// Glues an inner half-edge to another one or to a side.
    fn connect(&mut self, e: u32, link: u32) {
        self.pieces[(e >> 2) as usize].link[(e & 3) as usize] = link;
        if link & OUTER == 0 {
            self.pieces[(link >> 2) as usize].link[(link & 3) as usize] = e;
        } else {
            self.place[(link & !OUTER) as usize] = e;
        }
    }

    /// Flips inner edges until each is locally Delaunay.
    fn restore_delaunay<K: Kernel>(&mut self) {
        let mut suspects = std::mem::take(&mut self.suspects);
        suspects.clear();
        for t in 0..self.pieces.len() as u32 {
            // Each inner edge once, from its triangle with the greater number.
            suspects.extend((0..3).map(|k| 4 * t + k).filter(|&e| self.link(e) < e));
        }
        while let Some(e) = suspects.pop() {
            let f = self.link(e);
            if f & OUTER != 0 {
                continue;
            }
            let corners = self.pieces[(e >> 2) as usize]
                .v
                .map(|i| self.points[i as usize]);
            let apex = self.pieces[(f >> 2) as usize].v[PRED[(f & 3) as usize] as usize];
            if K::in_conflict(corners, self.points[apex as usize]) {
                self.flip(e, f);
                suspects.extend([e & !3, (e & !3) + 1, f & !3, (f & !3) + 1]);
            }
        }
        self.suspects = suspects;
    }

    fn link(&self, e: u32) -> u32 {
        self.pieces[(e >> 2) as usize].link[(e & 3) as usize]
    }

    /// Replaces the diagonal ab of the quadrilateral a d b c by cd. The new diagonal is edge 2 of both triangles.
    ///
    /// ```text
    ///        c                 c
    ///      / e \             / | \
    ///     a --- b    ->     a  |  b
    ///      \ f /             \ | /
    ///        d                 d
    /// ```
    fn flip(&mut self, e: u32, f: u32) {
        let (t, k) = ((e >> 2) as usize, (e & 3) as usize);
        let (u, l) = ((f >> 2) as usize, (f & 3) as usize);
        let (above, below) = (self.pieces[t], self.pieces[u]);
        let at =
            |p: Piece, k: usize, turn: [u32; 4]| (p.v[turn[k] as usize], p.link[turn[k] as usize]);
        let (b, bc) = at(above, k, SUCC);
        let (c, ca) = at(above, k, PRED);
        let (a, ad) = at(below, l, SUCC);
        let (d, db) = at(below, l, PRED);
        self.pieces[t].v = [c, a, d];
        self.pieces[u].v = [d, b, c];
        let (t, u) = (4 * t as u32, 4 * u as u32);
        self.connect(t, ca);
        self.connect(t + 1, ad);
        self.connect(u, db);
        self.connect(u + 1, bc);
        self.connect(t + 2, u + 2);
    }
}

impl<K: Kernel> Cdt2<K> {
    /// Writes a triangulated polygon to new slots and glues it along its sides to what lies outside. Returns where its side 0
    /// ended up. The old triangles inside must still stand.
    ///
    /// If both sides of an edge are sides of polygons (a dangling edge), the first one glues its new triangle to the old half-edge
    /// of the second, and the second finds that new triangle there.
    pub(super) fn fill(&mut self, polygon: &Polygon, region: u32, created: &mut Vec<TriId>) -> u32 {
        let base = created.len();
        for _ in &polygon.pieces {
            let t = self.take_slot();
            created.push(TriId(t));
        }
        let slot_of = |e: u32| 4 * created[base + (e >> 2) as usize].0 + (e & 3);
        for (i, piece) in polygon.pieces.iter().enumerate() {
            let t = created[base + i].0;
            let v = piece.v.map(|i| polygon.sides[i as usize].origin);
            let link = piece.link.map(|l| {
                if l & OUTER == 0 {
                    Link::to(slot_of(l))
                } else {
                    Link::BORDER
                }
            });
            debug_assert!({
                let [a, b, c] = self.corners_of(&v);
                K::orient2d(a, b, c).is_positive()
            });
            self.write_slot(
                t,
                Slot {
                    v,
                    birth: self.clock,
                    link,
                    region,
                },
            );
            for k in 0..3 {
                self.write_hint(v[k as usize], 4 * t + k);
            }
        }
        for (side, &place) in polygon.sides.iter().zip(&polygon.place) {
            if side.inner != NONE {
                let label = self.label(side.inner);
                self.glue(slot_of(place), self.link(side.inner), label);
            }
        }
        slot_of(polygon.place[0])
    }
}
