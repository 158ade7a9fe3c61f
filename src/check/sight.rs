//! Who sees what: the walk from a triangle to its Steiner point, and cones toward a subsegment. \[GCDR\] section 2.
//!
//! Only constrained edges block. Every test is an orientation of stored points.

use super::complex::{Complex, NONE, next, previous, triangle_of};
use super::condition::{in_diametral_disk, meets_diametral_disk, walk_side};
use super::predicates::orient;
use crate::model::{Point2, Sign};

/// Where the walk from the centroid of a triangle to a point ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrival {
    /// In this triangle; no constrained edge was met.
    Triangle(u32),
    /// At this constrained half-edge (seen from inside): the point lies on it or strictly beyond it.
    Edge(u32),
    /// The way meets a vertex or leaves the mesh, which no valid state allows.
    Lost,
}

/// The half-edge of t through which the walk from its centroid to q leaves t, whether or not q lies beyond it.
pub fn exit_edge(mesh: &Complex, t: u32, q: Point2) -> Option<u32> {
    let corners = mesh.places(t);
    let side = corners.map(|w| walk_side(corners, q, w));
    (0..3).find(|&k| side[k].is_negative() && side[(k + 1) % 3].is_positive()).map(|k| 4 * t + k as u32)
}

/// Walks from the centroid of t to q.
pub fn walk(mesh: &Complex, t: u32, q: Point2) -> Arrival {
    let corners = mesh.places(t);
    let Some(mut e) = exit_edge(mesh, t, q) else {
        // Through a corner, or q is the centroid itself: only the latter is fine.
        let inside = (0..3).all(|k| orient(corners[k], corners[(k + 1) % 3], q).is_positive());
        return if inside { Arrival::Triangle(t) } else { Arrival::Lost };
    };
    for _ in 0..=mesh.slot_count() {
        let side = orient(mesh.at(mesh.origin(e)), mesh.at(mesh.target(e)), q);
        if side.is_positive() {
            return Arrival::Triangle(triangle_of(e));
        }
        if mesh.segment(e) != NONE {
            return Arrival::Edge(e);
        }
        if side == Sign::Zero {
            return Arrival::Triangle(triangle_of(e));
        }
        let other = mesh.beyond(e);
        if other == NONE {
            return Arrival::Lost;
        }
        // `other` runs from the left end of the gap to the right one; its apex decides where the way goes on.
        e = match walk_side(corners, q, mesh.at(mesh.apex(other))) {
            Sign::Positive => next(other),
            Sign::Negative => previous(other),
            Sign::Zero => {
                // Fine only if q lies in this triangle, before its apex.
                let (left, right) = (next(other), previous(other));
                let within = |e: u32| orient(mesh.at(mesh.origin(e)), mesh.at(mesh.target(e)), q).is_positive();
                return if within(left) && within(right) {
                    Arrival::Triangle(triangle_of(other))
                } else {
                    Arrival::Lost
                };
            }
        };
    }
    Arrival::Lost
}

/// A cone from a vertex, open, seen through a half-edge: the directions strictly between `right` and `left`.
#[derive(Clone, Copy, Debug)]
struct Gap {
    /// The half-edge crossed, seen from the side of the vertex: its origin is on the right.
    through: u32,
    right: Point2,
    left: Point2,
}

/// Reusable memory of the searches below.
#[derive(Clone, Debug, Default)]
pub struct Search {
    gaps: Vec<Gap>,
    edges: Vec<u32>,
    stamp: Vec<u32>,
    now: u32,
    /// Vertices found by `vertices_in`, each once, in no particular order.
    pub found: Vec<u32>,
    vertex_stamp: Vec<u32>,
    /// Where vertices have seen the subsegment whose disks were searched last, the latest first.
    seen_at: Vec<Point2>,
}

/// How many places seen are asked for again.
const MOST_PLACES: usize = 8;

/// What a vertex must see of a subsegment.
#[derive(Clone, Copy, Debug)]
pub enum Aim {
    /// Some interior point of it.
    Interior,
    /// This point of it.
    At(Point2),
}

/// Which edges a flood of disks may cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// Unconstrained edges.
    Unconstrained,
    /// All edges, also out of the region.
    All,
}

impl Search {
    /// Starts a search: nothing is marked.
    pub fn fresh(&mut self, mesh: &Complex) {
        self.stamp.resize(mesh.slot_count(), 0);
        self.vertex_stamp.resize(mesh.vertices.len(), 0);
        self.now = self.now.wrapping_add(1);
        if self.now == 0 {
            self.stamp.fill(0);
            self.vertex_stamp.fill(0);
            self.now = 1;
        }
    }

    /// Marks a triangle; whether it was unmarked.
    pub fn mark(&mut self, t: u32) -> bool {
        std::mem::replace(&mut self.stamp[t as usize], self.now) != self.now
    }

    /// Whether the triangle is marked.
    pub fn is_marked(&self, t: u32) -> bool {
        self.stamp[t as usize] == self.now
    }

    /// Whether w sees what is aimed at on the subsegment s (a half-edge, seen from inside): the open cone from w to the ends of s,
    /// clipped by every unconstrained edge crossed, is not empty (and holds the point strictly).
    ///
    /// A vertex that sees a point of s sees its interior. One look for a point follows a single way, so the places where others saw s are tried first.
    pub fn sees(&mut self, mesh: &Complex, w: u32, s: u32, aim: Aim) -> bool {
        let Aim::Interior = aim else {
            return self.look(mesh, w, s, aim).is_some();
        };
        for k in 0..self.seen_at.len() {
            if self.look(mesh, w, s, Aim::At(self.seen_at[k])).is_some() {
                self.seen_at[..=k].rotate_right(1);
                return true;
            }
        }
        let Some(gap) = self.look(mesh, w, s, aim) else {
            return false;
        };
        self.seen_at.truncate(MOST_PLACES - 1);
        self.seen_at.insert(0, middle(mesh, w, s, &gap));
        true
    }

    /// The first gap found through which w sees what is aimed at.
    fn look(&mut self, mesh: &Complex, w: u32, s: u32, aim: Aim) -> Option<Gap> {
        let eye = mesh.at(w);
        let (mut right, mut left) = (mesh.at(mesh.origin(s)), mesh.at(mesh.target(s)));
        match orient(eye, right, left) {
            Sign::Positive => {}
            Sign::Negative => std::mem::swap(&mut right, &mut left),
            Sign::Zero => return None,
        }
        let twin = mesh.beyond(s);
        let holds = |gap: &Gap| match aim {
            Aim::Interior => true,
            Aim::At(p) => orient(eye, gap.right, p).is_positive() && orient(eye, p, gap.left).is_positive(),
        };
        self.gaps.clear();
        for e in mesh.star(w).filter(|&e| mesh.inside(e).is_some()) {
            let through = next(e);
            self.gaps.extend(clipped(mesh, eye, Gap { through, right, left }));
        }
        // A ray from the eye meets every triangle at most once, so this ends.
        while let Some(gap) = self.gaps.pop() {
            if !holds(&gap) {
                continue;
            }
            if gap.through == s || gap.through == twin {
                return Some(gap);
            }
            if mesh.segment(gap.through) != NONE {
                continue;
            }
            let other = mesh.beyond(gap.through);
            if other == NONE {
                continue;
            }
            for through in [next(other), previous(other)] {
                self.gaps.extend(clipped(mesh, eye, Gap { through, ..gap }));
            }
        }
        None
    }

    /// Collects in `found` the vertices strictly in one of the disks with the given diameters, reached from s (both sides) across
    /// edges that meet one of the disks and that the flood may cross.
    pub fn vertices_in(&mut self, mesh: &Complex, s: u32, diameters: &[[Point2; 2]], crosses: Crossing) {
        self.fresh(mesh);
        self.found.clear();
        self.seen_at.clear();
        self.edges.clear();
        for e in [s, mesh.beyond(s)] {
            if e != NONE && (crosses == Crossing::All || mesh.inside(e).is_some()) && self.mark(triangle_of(e)) {
                self.edges.push(e);
            }
        }
        while let Some(e) = self.edges.pop() {
            let w = mesh.apex(e);
            if diameters.iter().any(|[u, v]| in_diametral_disk(*u, *v, mesh.at(w)))
                && std::mem::replace(&mut self.vertex_stamp[w as usize], self.now) != self.now
            {
                self.found.push(w);
            }
            for side in [next(e), previous(e)] {
                let other = mesh.beyond(side);
                let blocked = crosses == Crossing::Unconstrained && mesh.segment(side) != NONE;
                if blocked || other == NONE || self.is_marked(triangle_of(other)) {
                    continue;
                }
                let (a, b) = (mesh.at(mesh.origin(side)), mesh.at(mesh.target(side)));
                if diameters.iter().any(|[u, v]| meets_diametral_disk(*u, *v, a, b)) {
                    self.mark(triangle_of(other));
                    self.edges.push(other);
                }
            }
        }
    }
}

/// About where the middle of a gap meets the line of s.
fn middle(mesh: &Complex, w: u32, s: u32, gap: &Gap) -> Point2 {
    let (eye, a, b) = (mesh.at(w), mesh.at(mesh.origin(s)), mesh.at(mesh.target(s)));
    let way = (gap.right - eye).normalize_or_zero() + (gap.left - eye).normalize_or_zero();
    let place = eye + way * ((a - eye).perp_dot(b - a) / way.perp_dot(b - a));
    if place.is_finite() { place.clamp(a.min(b), a.max(b)) } else { a }
}

/// The part of a gap's cone that passes through its edge; `None` if empty. Both cones are narrower than a half-plane.
fn clipped(mesh: &Complex, eye: Point2, gap: Gap) -> Option<Gap> {
    let (right, left) = (mesh.at(mesh.origin(gap.through)), mesh.at(mesh.target(gap.through)));
    // Whether the direction of x lies in the half-open cone from r to l.
    let between = |r: Point2, x: Point2, l: Point2| !orient(eye, r, x).is_negative() && orient(eye, x, l).is_positive();
    let start = if between(gap.right, right, gap.left) {
        right
    } else if between(right, gap.right, left) {
        gap.right
    } else {
        return None;
    };
    let end = if orient(eye, left, gap.left).is_positive() { left } else { gap.left };
    orient(eye, start, end).is_positive().then_some(Gap { right: start, left: end, ..gap })
}
