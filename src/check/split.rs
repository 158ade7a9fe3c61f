//! What justifies a split: the way from the bad triangle meets the subsegment (S1), the removals are those its policy asks for (S2), and the type
//! and the parent follow from the vertices that see it (S3).

use super::condition::{
    compare_lengths, in_diametral_disk, in_selection_disk, in_selection_interval, is_at_distance, is_near_line,
};
use super::predicates::{Corners, in_circle};
use super::replay::Replay;
use super::rows::{self, Deltas};
use super::scale::power_of_two;
use super::sight::{Aim, Arrival, Crossing, walk};
use super::verdict::{Checked, Rule, broken, ensure};
use crate::model::{Choice, DeletionPolicy, DiskChoice, Point2, Triangle};
use crate::trace::{Cause, Shell, SplitKind};

/// A split as the trace states it, places scaled.
#[derive(Clone, Copy, Debug)]
pub struct Split {
    /// The new vertex.
    pub p: Point2,
    /// Type.
    pub kind: SplitKind,
    /// The ends of the subsegment, the smaller first.
    pub ends: [u32; 2],
    /// The half-edge of the subsegment, seen from inside the region.
    pub s: u32,
    /// The bad triangle.
    pub t: u32,
    /// Why it is bad.
    pub cause: Cause,
    /// The rejected point.
    pub a: Point2,
    /// The parameters whose selection disk holds a.
    pub deltas: Option<Deltas>,
}

impl Replay {
    /// Reads a split and proves what does not depend on the removals: t, a, the way from t to s, p in its interval.
    pub(super) fn split_of(
        &mut self,
        p: Point2,
        kind: SplitKind,
        ends: [u32; 2],
        t: Triangle,
        cause: Cause,
        a: Point2,
    ) -> Checked<Split> {
        let (p, a) = (self.scale.place(p)?, self.scale.place(a)?);
        let t = self.triangle(t)?;
        self.check_cause(t, cause)?;
        let corners = self.mesh.places(t);
        ensure(in_circle(corners, a).is_positive(), Rule::A1, || {
            ("a rejected point strictly inside the circle of its triangle", format!("{a:?}"))
        })?;
        self.check_users_disk(corners, a)?;
        let deltas = self.ledger.regions.disk_of_rejected(corners, a);
        let s = match walk(&self.mesh, t, a) {
            Arrival::Edge(s) => s,
            other => {
                return broken(Rule::S1, "a way that meets a constrained edge", format!("{other:?}"));
            }
        };
        let met = [self.mesh.origin(s), self.mesh.target(s)];
        ensure([met[0].min(met[1]), met[0].max(met[1])] == ends, Rule::S1, || {
            (format!("the first constrained edge met, {met:?}"), format!("{ends:?}"))
        })?;
        Ok(Split { p, kind, ends, s, t, cause, a, deltas })
    }

    /// S3, and S2 by comparing the whole set of removals with the own one.
    pub(super) fn check_kind_and_removals(&mut self, split: &Split) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let (mesh, p) = (&self.mesh, split.p);
        let policy = self.ledger.parameters.deletion;
        let crosses = if policy == DeletionPolicy::Disk { Crossing::All } else { Crossing::Unconstrained };
        let mut search = std::mem::take(&mut self.search);
        search.vertices_in(mesh, split.s, &[[u, v], [u, p], [p, v]], crosses);
        let found = std::mem::take(&mut search.found);
        let mut witness = None;
        let mut expected_removals = Vec::new();
        for &w in &found {
            if mesh.vertices[w as usize].is_free() {
                let counts = match policy {
                    DeletionPolicy::Segment => search.sees(mesh, w, split.s, Aim::Interior),
                    DeletionPolicy::Point => search.sees(mesh, w, split.s, Aim::At(p)),
                    DeletionPolicy::Disk => true,
                };
                if counts {
                    expected_removals.push(w);
                }
            } else if witness.is_none()
                && in_diametral_disk(u, v, mesh.at(w))
                && search.sees(mesh, w, split.s, Aim::Interior)
            {
                witness = Some(w);
            }
        }
        search.found = found;
        self.search = search;
        expected_removals.sort_unstable();
        ensure(witness.is_some() == matches!(split.kind, SplitKind::C { .. }), Rule::S3, || {
            (format!("Type-C iff a vertex is seen that stays; seen: {witness:?}"), format!("{:?}", split.kind))
        })?;
        let same = self.waiting.iter().map(|w| &w.vertex).eq(expected_removals.iter());
        ensure(same, Rule::S2, || {
            let found: Vec<u32> = self.waiting.iter().map(|w| w.vertex).collect();
            (format!("removal of {:?}", expected_removals), format!("{found:?}"))
        })
    }

    /// The closest non-free vertex strictly in Diam(s) that sees p; ties by id.
    pub(super) fn check_parent(&mut self, split: &Split, parent: u32) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let Some(s) = self.find_inside(split.ends) else {
            return broken(Rule::Segment, "the subsegment", "none");
        };
        let mut search = std::mem::take(&mut self.search);
        let mesh = &self.mesh;
        search.vertices_in(mesh, s, &[[u, v]], Crossing::Unconstrained);
        let mut found = std::mem::take(&mut search.found);
        found.sort_unstable();
        let mut best: Option<u32> = None;
        for &w in found.iter().filter(|&&w| !mesh.vertices[w as usize].is_free()) {
            let closer = best.is_none_or(|b| compare_lengths(mesh.at(w), split.p, mesh.at(b), split.p).is_negative());
            if closer && search.sees(mesh, w, s, Aim::At(split.p)) {
                best = Some(w);
            }
        }
        search.found = found;
        self.search = search;
        ensure(best == Some(parent), Rule::S3, || {
            (format!("the closest vertex seen as parent, {best:?}"), format!("{parent}"))
        })
    }

    /// The half-edge between two vertices, seen from inside the region.
    pub fn find_inside(&self, [u, v]: [u32; 2]) -> Option<u32> {
        let inside = |e: &u32| self.mesh.inside(*e).is_some();
        self.mesh.find_edge(u, v).filter(inside).or_else(|| self.mesh.find_edge(v, u).filter(inside))
    }

    /// A split: everything that justifies it, before and after the surgery.
    pub(super) fn insert_on_segment(&mut self, split: Split, shell: Option<Shell>, destroyed: &[Triangle]) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let segment = self.mesh.segment(split.s);
        ensure(split.p != u && split.p != v, Rule::S2, || {
            ("a point off the ends of its subsegment", format!("{:?}", split.p))
        })?;
        let within = self.ledger.parameters.max_splits.is_none_or(|limit| self.ledger.splits[segment as usize] < limit);
        ensure(within, Rule::S2, || (format!("at most {:?} splits", self.ledger.parameters.max_splits), "one more"))?;
        self.check_on_segment(&split)?;
        self.check_shell(&split, shell)?;
        let rung = self.rung(&split, shell);
        self.check_rung(&split, rung)?;
        self.check_users_interval(&split, shell)?;
        let slack = self.ledger.regions.interval(split.kind, [u, v], split.p);
        rows::before_split(self, &split)?;
        self.check_kind_and_removals(&split)?;
        let facts_of_t = (self.mesh.places(split.t), self.mesh.corners(split.t));
        self.apply_removals()?;
        if let SplitKind::C { parent } = split.kind {
            self.check_parent(&split, parent.0)?;
        }
        let p = self.split_edge(&split, destroyed)?;
        self.ledger.rungs.push(rung);
        self.ledger.splits[segment as usize] += 1;
        match split.kind {
            SplitKind::B => self.ledger.tally.type_b += 1,
            SplitKind::C { .. } => self.ledger.tally.type_c += 1,
        }
        rows::after_split(self, &split, p, facts_of_t, slack)
    }

    /// The first removal that still waits for its split.
    pub fn first_waiting(&self) -> Option<u64> {
        self.waiting.first().map(|w| w.event)
    }

    /// p is on its subsegment up to rounding: each coordinate within 2^-50 of the larger ones of the ends, half a unit in the last place being
    /// 2^-53 of them at most, so that a user's function may round a few times. 2^-140 covers coordinates that became 0.
    pub(super) fn check_on_segment(&self, split: &Split) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let size = [u.x, u.y, v.x, v.y].map(f64::abs).into_iter().fold(0.0, f64::max);
        let tolerance = size * power_of_two(-50) + power_of_two(-140);
        ensure(is_near_line(u, v, split.p, tolerance), Rule::S2, || {
            ("a point on its subsegment, up to rounding", format!("{:?} off {:?}", split.p, split.ends))
        })
    }

    /// A user's Type-A point lies in its selection disk with slack at every level: the run ends if it does not.
    pub(super) fn check_users_disk(&self, t: Corners, a: Point2) -> Checked {
        let free = self.ledger.parameters.choice_a != DiskChoice::User;
        ensure(free || in_selection_disk(t, self.ledger.regions.slack.d2, a), Rule::A2, || {
            ("a point of the selection disk", format!("{a:?}"))
        })
    }

    /// A user's point on a segment lies in its selection interval with slack at every level.
    pub(super) fn check_users_interval(&self, split: &Split, shell: Option<Shell>) -> Checked {
        let (p, slack) = (&self.ledger.parameters, self.ledger.regions.slack);
        let (choice, delta) = match split.kind {
            SplitKind::B => (p.choice_b, slack.d1),
            SplitKind::C { .. } => (p.choice_c, slack.mu),
        };
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let free = choice != Choice::User || shell.is_some();
        ensure(free || in_selection_interval(u, v, delta, split.p), Rule::S2, || {
            ("a point of the selection interval", format!("{:?}", split.p))
        })
    }

    /// The nominal distance of a rung is the distance, up to the roundings of it and of those it is halfway of: 2^-46 of the input's size.
    pub(super) fn check_rung(&self, split: &Split, rung: Option<(u32, f64)>) -> Checked {
        let Some((apex, distance)) = rung else {
            return Ok(());
        };
        let (at, exponent) = (self.mesh.at(apex), -self.scale.exponent);
        let holds = is_at_distance(at, split.p, distance, exponent, power_of_two(-46));
        ensure(holds, Rule::Shell, || {
            (format!("a point {distance:e} from vertex {apex}"), format!("{:?} (scaled)", split.p))
        })
    }
}
