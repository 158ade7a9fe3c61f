//! Sight in a constrained triangulation: the walk from a triangle to a point, and what a vertex sees of a subsegment.
//!
//! Constraints block sight as closed point sets; free and isolated vertices do not. Source: \[GCDR\] section 2 as
//! corrected in `docs/errata.md` (E13, E16).

use super::{Cdt2, HalfEdge, TriId};
use crate::arith::Kernel;
use crate::model::{Point2, Sign, VertexId};

/// Where a walk ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walk {
    /// At the point: no constraint on the way.
    Reached,
    /// At the first constrained edge that is crossed or that holds the point; from the side of the walk.
    Blocked(HalfEdge),
}

/// What of a subsegment is to be seen.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    /// Some interior point.
    Interior,
    /// This point of it.
    Point(Point2),
}

#[cfg(test)]
thread_local! {
    /// Cones sent through a triangle by `sees`: its work.
    pub static CONES: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

/// An open cone of sight at a vertex that has got as far as `edge` (from its near side): all rays strictly between.
struct Cone {
    right: Point2,
    left: Point2,
    edge: HalfEdge,
}

impl<K: Kernel> Cdt2<K> {
    /// The walk from the centroid of t to a, which lies strictly inside the circle of t.
    ///
    /// The walk meets no vertex before it ends (a vertex on it would lie inside that circle and be visible).
    pub fn walk(&self, t: TriId, a: Point2) -> Walk {
        let from = self.corners(t);
        let mut exit = None;
        let beyond = self.edges(t).map(|e| self.side(e.0, a) != Sign::Positive);
        for (k, e) in self.edges(t).into_iter().enumerate() {
            // of two edges with a beyond, the one on the walk's side of their common corner
            let twice = beyond[(k + 1) % 3] || beyond[(k + 2) % 3];
            if beyond[k] && (!twice || self.leaves_through(from, a, e)) {
                exit = Some(e);
                break;
            }
        }
        while let Some(e) = exit {
            if self.segment(e).is_some() {
                return Walk::Blocked(e);
            }
            let Some(entry) = self.twin(e) else {
                return Walk::Blocked(e);
            };
            if self.side(e.0, a) == Sign::Zero {
                return Walk::Reached;
            }
            let (right, left) = (self.next(entry), self.prev(entry));
            exit = match (self.side(right.0, a) != Sign::Positive, self.side(left.0, a) != Sign::Positive) {
                (false, false) => None,
                (true, false) => Some(right),
                (false, true) => Some(left),
                (true, true) if K::walk_side(from, a, self.point(self.apex(entry))).is_positive() => Some(right),
                (true, true) => Some(left),
            };
        }
        Walk::Reached
    }

    /// Whether the ray from the centroid of `from` to a passes between the ends of e.
    fn leaves_through(&self, from: crate::arith::Corners, a: Point2, e: HalfEdge) -> bool {
        K::walk_side(from, a, self.point(self.origin(e))).is_negative()
            && K::walk_side(from, a, self.point(self.destination(e))).is_positive()
    }

    /// Where vertex w sees the target on the subsegment uv: the point itself, or about there; `None` if it does not.
    ///
    /// The open cone from w to uv is sent through the triangles and clipped by every edge it crosses. Of a point only the part that holds it is followed:
    /// one walk. Of the interior all parts are, which takes long where much lies between; w sees the interior wherever it sees a point.
    pub fn sees(&self, w: VertexId, [u, v]: [VertexId; 2], target: Target) -> Option<Point2> {
        let (at, pu, pv) = (self.point(w), self.point(u), self.point(v));
        let (goal, right, left) = match K::orient2d(pu, pv, at) {
            Sign::Positive => (self.find_edge(u, v), pu, pv),
            Sign::Negative => (self.find_edge(v, u), pv, pu),
            Sign::Zero => return None,
        };
        let goal = goal?;
        let mut cones: Vec<Cone> = Vec::new();
        for out in self.edges_around(w) {
            let edge = self.next(out);
            let (a, b) = (self.point(self.origin(edge)), self.point(self.destination(edge)));
            let right = if between::<K>(at, a, right, b) {
                right
            } else if between::<K>(at, right, a, left) {
                a
            } else {
                continue;
            };
            let left = if K::orient2d(at, left, b).is_negative() { b } else { left };
            cones.push(Cone { right, left, edge });
        }
        while let Some(Cone { right, left, edge }) = cones.pop() {
            #[cfg(test)]
            CONES.set(CONES.get() + 1);
            if let Target::Point(p) = target
                && !(K::orient2d(at, right, p).is_positive() && K::orient2d(at, p, left).is_positive())
            {
                continue;
            }
            if edge == goal {
                return Some(match target {
                    Target::Interior => middle(at, [right, left], [pu, pv]),
                    Target::Point(p) => p,
                });
            }
            if self.segment(edge).is_some() {
                continue;
            }
            let Some(entry) = self.twin(edge) else {
                continue;
            };
            let c = self.point(self.apex(entry));
            if K::orient2d(at, right, c).is_positive() {
                let left = if K::orient2d(at, left, c).is_negative() { c } else { left };
                cones.push(Cone { right, left, edge: self.next(entry) });
            }
            if K::orient2d(at, c, left).is_positive() {
                let right = if K::orient2d(at, right, c).is_positive() { c } else { right };
                cones.push(Cone { right, left, edge: self.prev(entry) });
            }
        }
        None
    }
}

/// About where the middle of a cone meets the line of uv.
fn middle(at: Point2, cone: [Point2; 2], [u, v]: [Point2; 2]) -> Point2 {
    let [right, left] = cone.map(|q| (q - at).normalize_or_zero());
    let (way, along) = (right + left, v - u);
    let q = at + way * ((u - at).perp_dot(along) / way.perp_dot(along));
    if q.is_finite() { q.clamp(u.min(v), u.max(v)) } else { u }
}

/// Whether the direction of x from `at` lies in the half-open cone [a, b), narrower than a half turn.
fn between<K: Kernel>(at: Point2, a: Point2, x: Point2, b: Point2) -> bool {
    !K::orient2d(at, a, x).is_negative() && K::orient2d(at, x, b).is_positive()
}
