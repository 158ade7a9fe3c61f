//! Where a point lies, by a walk.
//!
//! In a constrained triangulation a walk that always tests edges in the same order can go around in circles; so the order
//! varies, by a generator started anew for each walk. A walk that has taken more steps than there are triangles, as it can only by
//! the worst of luck, is given up for a search of all triangles: the answer never depends on the path.

use super::store::{Cdt2, HalfEdge, NONE, TriId, next, prev};
use crate::arith::Kernel;
use crate::model::{Point2, Sign, VertexId};

/// Where a point lies in a triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// Strictly inside a triangle.
    Triangle(TriId),
    /// Inside an edge, given by the half-edge of the region along it, if two by the one with the smaller number.
    Edge(HalfEdge),
    /// On a vertex.
    Vertex(VertexId),
    /// In no triangle.
    Outside,
}

impl<K: Kernel> Cdt2<K> {
    /// Where p lies, searched from t. `Outside` also for what `carve` left out; the border of the region belongs to it.
    pub fn locate(&self, t: TriId, p: Point2) -> Location {
        let mut random = 0x9e37_79b9_u32;
        let (mut t, mut entry) = (t.0, NONE);
        'walk: for _ in 0..self.slots.len() {
            random ^= random << 13;
            random ^= random >> 17;
            random ^= random << 5;
            let mut e = if entry == NONE { 4 * t } else { next(entry) };
            if random & 1 == 0 {
                e = next(e);
            }
            for _ in 0..3 {
                if e != entry && self.side(e, p).is_negative() {
                    match self.link(e).twin() {
                        Some(f) => (t, entry) = (f >> 2, f),
                        None => return Location::Outside,
                    }
                    continue 'walk;
                }
                e = next(e);
            }
            return self.place_in(t, p).unwrap_or(Location::Outside);
        }
        let mut all = self.triangles();
        all.find_map(|t| self.place_in(t.0, p)).unwrap_or(Location::Outside)
    }

    /// Sign of cross(origin of e, destination of e, p).
    pub(super) fn side(&self, e: u32, p: Point2) -> Sign {
        let [a, b] = [self.origin_of(e), self.origin_of(next(e))];
        K::orient2d(self.points[a as usize], self.points[b as usize], p)
    }

    /// Where p lies in the closed triangle t, if it does.
    fn place_in(&self, t: u32, p: Point2) -> Option<Location> {
        let sides = [0, 1, 2].map(|k| self.side(4 * t + k, p));
        if sides.iter().any(|s| s.is_negative()) {
            return None;
        }
        let mut on = (0..3).filter(|&k| sides[k as usize] == Sign::Zero).map(|k| 4 * t + k);
        let inside = |e: &u32| self.slots[(e >> 2) as usize].is_inside();
        Some(match (on.next(), on.next()) {
            (None, _) if inside(&(4 * t)) => Location::Triangle(TriId(t)),
            (None, _) => Location::Outside,
            (Some(e), None) => {
                let both = [Some(e), self.link(e).twin()].into_iter().flatten();
                let e = both.filter(inside).min();
                e.map_or(Location::Outside, |e| Location::Edge(HalfEdge(e)))
            }
            // Edges k and k + 1 meet at corner k + 1, edges 0 and 2 at corner 0.
            (Some(e), Some(f)) if f == next(e) => Location::Vertex(VertexId(self.origin_of(f))),
            (Some(e), Some(f)) => {
                debug_assert_eq!(f, prev(e));
                Location::Vertex(VertexId(self.origin_of(e)))
            }
        })
    }
}
