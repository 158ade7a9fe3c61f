//! The constrained Delaunay triangulation of a polygon: what is filled in after a deletion or under a new segment.
//!
//! Idea: clip ears in random order down to one triangle, then put them back, last first, each followed by the flips that a new vertex
//! needs (Lawson). On a convex polygon that is Chew's randomised algorithm, linear in the mean ("Building Voronoi diagrams for
//! convex polygons in linear expected time", 1990); a fixed order of ears would take quadratic time on smooth arcs.
//! The work is done on a small triangulation of its own with vertices numbered along the polygon, so that a vertex may
//! occur twice on the boundary, and sides are never flipped; the store sees only the result. The result is unique, so the random order,
//! which is the same in every run, does not show.

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
    /// Per side of the polygon as clipped so far, by the position it starts from: the half-edge of `pieces` along it.
    place: Vec<u32>,
    suspects: Vec<u32>,
    clipped: Vec<[u32; 3]>,
    /// Neighbors along the polygon as clipped so far: the one before, the one after. Clipped corners are their own.
    around: Vec<[u32; 2]>,
    candidates: Vec<u32>,
}

impl Polygon {
    /// Starts anew, without sides.
    pub(super) fn reset(&mut self) {
        self.sides.clear();
    }

    /// Triangulates a polygon that is weakly visible from its side 0: every vertex has a sight line to some point of that side,
    /// and these do not cross. Vertices may occur more than once.
    ///
    /// An ear is any corner off side 0 that turns left: no other vertex lies in its triangle, whose third edge stays between the
    /// sight lines of its ends; and the rest has the same property. There is an ear, for a chain without one
    /// turns right all the way and cannot lie left of side 0.
    pub(super) fn triangulate_below<K: Kernel>(&mut self, points: &[Point2]) {
        self.load(points);
        self.clip_ears(|polygon, [a, b, c]| b > 1 && polygon.turns_left::<K>(a, b, c));
        self.restore_ears::<K>();
    }

    /// Triangulates a polygon that is star-shaped around a point, strictly inside it.
    ///
    /// An ear is a corner that turns left with the center left of, or on, the edge that clips it; the rest is star-shaped
    /// again. There is one: insert the center in the Delaunay triangulation of the rest and undo it by flips.
    pub(super) fn triangulate_around<K: Kernel>(&mut self, points: &[Point2], center: Point2) {
        self.load(points);
        self.clip_ears(|polygon, [a, b, c]| {
            let [pa, pc] = [a, c].map(|i| polygon.points[i as usize]);
            polygon.turns_left::<K>(a, b, c) && !K::orient2d(pa, pc, center).is_negative()
        });
        self.restore_ears::<K>();
    }

    fn load(&mut self, points: &[Point2]) {
        self.points.clear();
        self.points.extend(self.sides.iter().map(|s| points[s.origin as usize]));
        self.pieces.clear();
        self.clipped.clear();
        self.place.clear();
        self.place.resize(self.sides.len(), NONE);
    }

    /// Takes ears off until a triangle is left, and takes that.
    fn clip_ears(&mut self, is_ear: impl Fn(&Polygon, [u32; 3]) -> bool) {
        // Positions fit: there are fewer sides than half-edges.
        let n = self.sides.len() as u32;
        self.around.clear();
        self.around.extend((0..n).map(|i| [if i == 0 { n - 1 } else { i - 1 }, if i + 1 == n { 0 } else { i + 1 }]));
        self.candidates.clear();
        self.candidates.extend(0..n);
        let mut random = 0x9e37_79b9_u32;
        let mut last = 0;
        let mut left = n;
        while left > 3 {
            random ^= random << 13;
            random ^= random >> 17;
            random ^= random << 5;
            assert!(!self.candidates.is_empty(), "such a polygon has an ear");
            let b = self.candidates.swap_remove(random as usize % self.candidates.len());
            let [a, c] = self.around[b as usize];
            if c == b || !is_ear(self, [a, b, c]) {
                continue;
            }
            self.clipped.push([a, b, c]);
            self.around[a as usize][1] = c;
            self.around[c as usize][0] = a;
            self.around[b as usize] = [b, b];
            self.candidates.extend([a, c]);
            last = a;
            left -= 1;
        }
        let [before, after] = self.around[last as usize];
        self.clipped.push([last, after, before]);
    }

    /// Puts the ears back, last first; after each, flips until all edges are locally Delaunay again.
    fn restore_ears<K: Kernel>(&mut self) {
        let clipped = std::mem::take(&mut self.clipped);
        let mut ears = clipped.iter().rev();
        if let Some(&[a, b, c]) = ears.next() {
            self.pieces.push(Piece { v: [a, b, c], link: [OUTER | a, OUTER | b, OUTER | c] });
            for (k, i) in [(0, a), (1, b), (2, c)] {
                self.place[i as usize] = k;
            }
        }
        for &[a, b, c] in ears {
            let inside = self.place[a as usize];
            let t = 4 * self.pieces.len() as u32;
            self.pieces.push(Piece { v: [a, b, c], link: [NONE; 3] });
            self.connect(t, OUTER | a);
            self.connect(t + 1, OUTER | b);
            self.connect(t + 2, inside);
            self.restore_delaunay::<K>(t + 2, b);
        }
        self.clipped = clipped;
    }

    /// Flips edges opposite to the new vertex b, beginning with e, while its circle test asks for it.
    fn restore_delaunay<K: Kernel>(&mut self, e: u32, b: u32) {
        let p = self.points[b as usize];
        self.suspects.push(e);
        while let Some(e) = self.suspects.pop() {
            let f = self.pieces[(e >> 2) as usize].link[(e & 3) as usize];
            if f & OUTER != 0 {
                continue;
            }
            let beyond = self.pieces[(f >> 2) as usize].v.map(|i| self.points[i as usize]);
            if K::in_conflict(beyond, p) {
                self.flip(e, f);
                // The edges of the flipped pair that are opposite to b.
                self.suspects.extend([(e & !3) + 1, f & !3]);
            }
        }
    }

    fn turns_left<K: Kernel>(&self, a: u32, b: u32, c: u32) -> bool {
        let p = |i: u32| self.points[i as usize];
        K::orient2d(p(a), p(b), p(c)).is_positive()
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
        let at = |p: Piece, k: usize, turn: [u32; 4]| (p.v[turn[k] as usize], p.link[turn[k] as usize]);
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
            let link = piece.link.map(|l| if l & OUTER == 0 { Link::to(slot_of(l)) } else { Link::BORDER });
            debug_assert!({
                let [a, b, c] = self.corners_of(&v);
                K::orient2d(a, b, c).is_positive()
            });
            self.write_slot(t, Slot { v, birth: self.clock, link, region });
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
