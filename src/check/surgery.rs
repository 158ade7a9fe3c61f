//! Surgery of the replay: flooding a cavity, filling it with a fan, splitting a subsegment, deleting a vertex. Each proves what it does.
//!
//! The mesh stays constrained Delaunay. An edge of a fan's rim: its outer triangle was tested by the flood. An edge px of a fan: lifted, p lies below the
//! planes of all cavity triangles at x, which are convex there, so px is convex too. A filling: each of its edges is tested.

use super::complex::{Complex, Facts, Kind, NONE, canonical, next, numbers, previous, triangle_of};
use super::predicates::{in_conflict, orient};
use super::replay::{Replay, Rim, Waiting, birth};
use super::split::Split;
use super::verdict::{Checked, Rule, broken, ensure};
use crate::model::words::counted;
use crate::model::{Point2, Triangle};
use crate::trace::SplitKind;

/// A half-edge to be paired: origin, target, and a half-edge of the filling or an edge of the rim.
pub(super) type Link = (u32, u32, u32, u32);

impl Replay {
    ///        c                 c
    ///      /   \             / | \
    ///     x     y    --->   x--p--y     for every edge xy of the cavity's rim
    pub(super) fn fan(&mut self, p: u32, rim: std::ops::Range<usize>, region: u32) {
        let facts =
            Facts { birth: birth(self.event), region, outside: false, skipped_skinny: false, skipped_oversized: false };
        let mut before = NONE;
        for i in rim {
            let Rim { from, to, outer, segment } = self.rim[i];
            let t = self.mesh.add([from, to, p], facts);
            self.mesh.join(4 * t, outer, segment);
            if before != NONE {
                self.mesh.join(4 * before + 1, 4 * t + 2, NONE);
            }
            self.created.push(t);
            before = t;
        }
    }

    pub(super) fn split_edge(&mut self, split: &Split, destroyed: &[Triangle]) -> Checked<u32> {
        let [u, v] = split.ends;
        let find = |mesh: &Complex, a, b| mesh.find_edge(a, b).unwrap_or(NONE);
        let sides = [find(&self.mesh, u, v), find(&self.mesh, v, u)];
        let segment = sides.iter().find(|&&e| e != NONE).map_or(NONE, |&e| self.mesh.segment(e));
        ensure(segment != NONE, Rule::Segment, || ("a subsegment", format!("({u}, {v})")))?;
        self.begin_flood();
        let mut rims = [0..0, 0..0];
        let mut regions = [NONE; 2];
        for (i, &e) in sides.iter().enumerate() {
            if let Some(t) = self.mesh.inside(e) {
                // Else the rounded p is so far off s that the edge from it to the apex is not Delaunay.
                let bulges = in_conflict(self.mesh.places(t), split.p);
                ensure(bulges, Rule::Delaunay, || {
                    ("a point in conflict with the triangles at its subsegment", format!("{:?}", split.p))
                })?;
                let (start, triangles) = (self.rim.len(), self.destroyed.len());
                regions[i] = self.mesh.facts(t).region;
                self.flood_root(t, &[next(e), previous(e)], split.p);
                rims[i] = start..self.rim.len();
                let tree = rims[i].len() == self.destroyed.len() - triangles + 1;
                ensure(tree, Rule::Star, || ("a cavity that encloses no vertex", "one that does"))?;
            }
        }
        self.compare_flood(destroyed)?;
        self.check_positive(split.p)?;
        let kind = match split.kind {
            SplitKind::B => Kind::B(segment),
            SplitKind::C { .. } => Kind::C(segment),
        };
        let p = self.mesh.add_vertex(split.p, kind);
        self.destroyed.iter().for_each(|&t| self.mesh.drop(t));
        // Half-edges at p on each side: from its first end to p, and from p to its other end.
        let mut halves = [[NONE; 2]; 2];
        for i in 0..2 {
            if !rims[i].is_empty() {
                let start = self.created.len();
                self.fan(p, rims[i].clone(), regions[i]);
                halves[i] = [4 * self.created[self.created.len() - 1] + 1, 4 * self.created[start] + 2];
            } else if sides[i] != NONE {
                halves[i] = self.split_outside(sides[i], p)?;
            }
        }
        self.mesh.join(halves[0][0], halves[1][1], segment);
        self.mesh.join(halves[0][1], halves[1][0], segment);
        self.measure(p);
        Ok(p)
    }

    pub(super) fn begin_flood(&mut self) {
        self.search.fresh(&self.mesh);
        self.destroyed.clear();
        self.rim.clear();
    }

    /// Floods from t across the given edges, in the normative order; the rim comes out counterclockwise.
    pub(super) fn flood_root(&mut self, t: u32, edges: &[u32], p: Point2) {
        self.search.mark(t);
        self.destroyed.push(t);
        self.stack.extend(edges.iter().rev());
        while let Some(e) = self.stack.pop() {
            let (outer, segment) = (self.mesh.beyond(e), self.mesh.segment(e));
            if segment == NONE && outer != NONE {
                let other = triangle_of(outer);
                if self.search.is_marked(other) {
                    continue;
                }
                if in_conflict(self.mesh.places(other), p) {
                    self.search.mark(other);
                    self.destroyed.push(other);
                    self.stack.extend([previous(outer), next(outer)]);
                    continue;
                }
            }
            self.rim.push(Rim { from: self.mesh.origin(e), to: self.mesh.target(e), outer, segment });
        }
    }

    pub(super) fn compare_flood(&self, destroyed: &[Triangle]) -> Checked {
        let own = || self.destroyed.iter().map(|&t| canonical(self.mesh.corners(t)));
        let listed = || destroyed.iter().map(|&t| numbers(t));
        let text = |ids: Vec<[u32; 3]>| format!("{ids:?}");
        ensure(own().eq(listed()), Rule::Flood, || (text(own().collect()), text(listed().collect())))
    }

    pub(super) fn check_positive(&self, p: Point2) -> Checked {
        for rim in &self.rim {
            let positive = orient(self.mesh.at(rim.from), self.mesh.at(rim.to), p).is_positive();
            ensure(positive, Rule::Star, || {
                ("counterclockwise new triangles", format!("({}, {}, {p:?})", rim.from, rim.to))
            })?;
        }
        Ok(())
    }

    /// Deletes a free vertex; the listed triangles fill its star and are locally Delaunay.
    pub(super) fn remove(&mut self, w: Waiting) -> Checked {
        self.rim.clear();
        self.destroyed.clear();
        for e in self.mesh.star(w.vertex) {
            let (outer, segment) = (self.mesh.beyond(next(e)), self.mesh.segment(next(e)));
            let closed = self.mesh.beyond(e) != NONE && self.mesh.segment(e) == NONE;
            ensure(closed, Rule::Star, || ("a star of unconstrained edges", format!("vertex {}", w.vertex)))?;
            self.rim.push(Rim { from: self.mesh.origin(next(e)), to: self.mesh.origin(previous(e)), outer, segment });
            self.destroyed.push(triangle_of(e));
        }
        let Some(&t) = self.destroyed.first() else {
            return broken(Rule::Star, "a star", "none");
        };
        let facts =
            Facts { birth: birth(self.event), skipped_skinny: false, skipped_oversized: false, ..*self.mesh.facts(t) };
        self.check_filling(w)?;
        self.destroyed.iter().for_each(|&t| self.mesh.drop(t));
        self.links.clear();
        for (i, rim) in self.rim.iter().enumerate() {
            // The outside of a rim edge runs the other way; `i` stands for it.
            self.links.push((rim.to, rim.from, i as u32, 0));
        }
        for i in w.start..w.end {
            let t = self.mesh.add(self.filling[i], facts);
            self.created.push(t);
            for e in 4 * t..4 * t + 3 {
                self.links.push((self.mesh.origin(e), self.mesh.target(e), e, 1));
            }
        }
        self.link_filling()?;
        self.mesh.delete_vertex(w.vertex);
        self.ledger.tally.removed += 1;
        let created = self.created.len() - (w.end - w.start);
        for i in created..self.created.len() {
            self.check_locally_delaunay(self.created[i])?;
        }
        Ok(())
    }

    /// The filling: canonical, ascending, positive, of the star's rim, two triangles fewer than it has edges.
    pub(super) fn check_filling(&self, w: Waiting) -> Checked {
        let filling = &self.filling[w.start..w.end];
        ensure(filling.len() + 2 == self.rim.len(), Rule::Star, || {
            (counted(self.rim.len() - 2, "triangle"), format!("{}", filling.len()))
        })?;
        ensure(filling.windows(2).all(|p| p[0] < p[1]), Rule::Canonical, || {
            ("ascending order", format!("{filling:?}"))
        })?;
        for &t in filling {
            let known = t.iter().all(|&v| self.rim.iter().any(|r| r.from == v));
            ensure(known, Rule::Star, || ("vertices of the star's rim", format!("{t:?}")))?;
            ensure(canonical(t) == t, Rule::Canonical, || ("the smallest id first", format!("{t:?}")))?;
            let [a, b, c] = t.map(|v| self.mesh.at(v));
            ensure(orient(a, b, c).is_positive(), Rule::Star, || ("counterclockwise triangles", format!("{t:?}")))?;
        }
        Ok(())
    }

    /// Pairs every half-edge of the filling with another one or with the outside of the rim; none is left over.
    pub(super) fn link_filling(&mut self) -> Checked {
        let key = |l: &Link| (l.0.min(l.1), l.0.max(l.1), l.0 > l.1);
        self.links.sort_unstable_by_key(key);
        for i in (0..self.links.len()).step_by(2) {
            let (a, Some(b)) = (self.links[i], self.links.get(i + 1).copied()) else {
                return broken(Rule::Star, "edges in pairs", "one left over");
            };
            ensure((a.0, a.1) == (b.1, b.0), Rule::Star, || ("edges in pairs", format!("({}, {}) alone", a.0, a.1)))?;
            match ((a.2, a.3), (b.2, b.3)) {
                ((e, 1), (other, 1)) => self.mesh.join(e, other, NONE),
                ((e, 1), (i, _)) | ((i, _), (e, 1)) => {
                    let rim = self.rim[i as usize];
                    self.mesh.join(e, rim.outer, rim.segment);
                }
                _ => {
                    return broken(Rule::Star, "a rim that the filling meets", format!("({}, {}) empty", a.0, a.1));
                }
            }
        }
        Ok(())
    }

    pub(super) fn check_locally_delaunay(&self, t: u32) -> Checked {
        for e in 4 * t..4 * t + 3 {
            let other = self.mesh.beyond(e);
            let holds = self.mesh.segment(e) != NONE
                || other == NONE
                || !in_conflict(self.mesh.places(t), self.mesh.at(self.mesh.apex(other)));
            ensure(holds, Rule::Delaunay, || {
                ("a locally Delaunay edge", format!("edge ({}, {})", self.mesh.origin(e), self.mesh.target(e)))
            })?;
        }
        Ok(())
    }
}
