//! Strict verification: that every choice of the run is the one that `docs/trace-format.md` prescribes.
//!
//! `replay` proves what happened to the mesh, with removals, parents and flood order. Here: which triangle is next, which point is chosen for it,
//! and, for a triangle that is skipped, that nothing else could be done.

mod construct;
mod draw;
mod queue;

use super::complex::{Kind, NONE, canonical, next, numbers, triangle_of};
use super::condition::{is_shell_exponent, is_skinny, shortest_edge};
use super::filler;
use super::predicates::{in_circle, in_conflict, orient};
use super::replay::Replay;
use super::scale::Scale;
use super::sight::{Aim, Arrival, Crossing, walk};
use super::verdict::{Checked, Rule, broken, ensure};
use crate::model::{
    Choice, DeletionPolicy, DiskChoice, Point2, SegmentId, SmallAngles, Triangle, VertexId, VertexOfTriangle,
};
use crate::trace::{Cause, Event, SkipReason, SplitKind, Why};
use queue::{Badness, Entry, Queue};

/// The strict checker's own state: queues and step counter.
#[derive(Clone, Debug)]
pub struct Strict {
    skinny: Queue,
    oversized: Queue,
    current: Option<Entry>,
    step: u32,
}

fn badness(cause: Cause) -> Badness {
    match cause {
        Cause::Skinny => Badness::Skinny,
        Cause::Area => Badness::Area,
        Cause::Size { .. } => Badness::Size,
    }
}

impl Strict {
    /// The state at the start.
    pub fn new(replay: &Replay) -> Strict {
        let order = replay.ledger.parameters.order;
        let mut strict = Strict { skinny: Queue::new(order), oversized: Queue::new(order), current: None, step: 0 };
        for t in replay.mesh.triangles() {
            strict.classify(replay, t);
        }
        strict
    }

    fn classify(&mut self, replay: &Replay, t: u32) {
        if is_skinny(replay.mesh.places(t), replay.ledger.parameters.rho2) {
            self.skinny.push(Entry::new(replay, t, Badness::Skinny));
        }
        if replay.is_too_large(t) {
            self.oversized.push(Entry::new(replay, t, Badness::Area));
        }
    }

    /// Proves the choices of an event before the replay takes it.
    pub fn before(&mut self, replay: &mut Replay, event: &Event) -> Checked {
        let (t, cause) = match event {
            Event::Remove { .. } => return Ok(()),
            Event::Skip { t, cause, .. } => (*t, *cause),
            Event::Insert { why: Why::Split { t, cause, .. }, .. } => (*t, *cause),
            Event::Insert { why: Why::Free { cause }, destroyed, .. } => match destroyed.first() {
                Some(&t) => (t, *cause),
                None => {
                    return broken(Rule::Flood, "the bad triangle first", "no destroyed triangle");
                }
            },
        };
        let slot = self.check_next(replay, t, cause)?;
        let excuse = if cause == Cause::Skinny { excusing_apex(replay, slot) } else { None };
        let reason = match event {
            Event::Skip { reason, .. } => Some(*reason),
            _ => None,
        };
        if excuse.is_some() || matches!(reason, Some(SkipReason::InputAngle { .. })) {
            let expected = excuse.map(|apex| SkipReason::InputAngle { apex: VertexId(apex) });
            return ensure(reason == expected, Rule::Skip, || (format!("{expected:?}"), format!("{reason:?}")));
        }
        let ids = numbers(t);
        match event {
            Event::Skip { reason, .. } => self.check_skip(replay, slot, ids, *reason),
            Event::Insert { p, why: Why::Free { .. }, .. } => self.check_point(replay, self.type_a(replay, ids), *p),
            Event::Insert { p, why: Why::Split { kind, s, a, .. }, .. } => {
                self.check_point(replay, self.type_a(replay, ids), *a)?;
                let ends = s.map(|v| v.0);
                ensure(replay.find_inside(ends).is_some(), Rule::S1, || ("an edge of the mesh", format!("{ends:?}")))?;
                let type_c = matches!(kind, SplitKind::C { .. });
                self.check_point(replay, self.on_segment(replay, ends, type_c), *p)
            }
            Event::Remove { .. } => Ok(()),
        }
    }

    /// Takes note of what the event changed.
    pub fn after(&mut self, replay: &Replay, event: &Event) {
        if matches!(event, Event::Remove { .. }) {
            return;
        }
        self.step = self.step.wrapping_add(1);
        if matches!(event, Event::Skip { .. }) {
            self.current = None;
        }
        for i in 0..replay.created.len() {
            let t = replay.created[i];
            // A slot created twice in a step stands twice in the list: its last triangle would be queued twice, which changes nothing.
            if replay.mesh.lives(t) {
                self.classify(replay, t);
            }
        }
    }

    /// The end: unless the run was stopped, no bad triangle is due. (`claims` proves that.)
    fn check_next(&mut self, replay: &Replay, t: Triangle, cause: Cause) -> Checked<u32> {
        let slot = replay.triangle(t)?;
        let due = self.current.filter(|e| e.is_due(replay));
        let expected = due.or_else(|| self.skinny.first(replay)).or_else(|| self.oversized.first(replay));
        let matches = match expected {
            Some(e) => e.t == slot && e.badness == badness(cause),
            // Sizes are known to the run alone: which such triangle is first is not checked.
            None => matches!(cause, Cause::Size { .. }),
        };
        ensure(matches, Rule::Queue, || {
            let next = expected.map(|e| (canonical(replay.mesh.corners(e.t)), e.badness));
            (format!("the next bad triangle {next:?}"), format!("{:?} {cause:?}", numbers(t)))
        })?;
        let entry = Entry::new(replay, slot, badness(cause));
        self.current = Some(entry);
        Ok(slot)
    }

    fn check_point(&self, replay: &Replay, chosen: Option<construct::Place>, stored: Point2) -> Checked {
        let stored = replay.scale.place(stored)?;
        // A user's choice is not known here; `Checker` reports it as unchecked.
        let Some(chosen) = chosen else { return Ok(()) };
        ensure(construct::rounds_to(&chosen, stored), Rule::Choice, || {
            let units = |Scale { exponent }: Scale| format!("scaled by 2^{}", -exponent);
            (format!("{:?} ({})", construct::round(&chosen), units(replay.scale)), format!("{stored:?}"))
        })
    }

    /// The Type-A point of a triangle (canonical); `None` for a user's.
    fn type_a(&self, replay: &Replay, ids: [u32; 3]) -> Option<construct::Place> {
        let p = &replay.ledger.parameters;
        let t = ids.map(|v| replay.mesh.at(v));
        let from = |k: usize| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
        let seed = p.seed.unwrap_or(0);
        let kappa = p.kappa.unwrap_or(0.0);
        Some(match p.choice_a {
            DiskChoice::User => return None,
            DiskChoice::Center => construct::circumcenter(t),
            DiskChoice::Extreme => {
                let k = match p.extreme.unwrap_or(VertexOfTriangle::First) {
                    VertexOfTriangle::First => 0,
                    VertexOfTriangle::Newest => (0..3).max_by_key(|&k| ids[k]).unwrap_or(0),
                    VertexOfTriangle::Seeded => draw::words(seed, self.step, 0, 0)[0] as usize % 3,
                };
                construct::in_disk(from(k), p.d2, 1.0, 0.0)
            }
            DiskChoice::Random => {
                let [x, y] = draw::disk(seed, self.step);
                construct::in_disk(t, p.d2, x, y)
            }
            DiskChoice::Offcenter => construct::offcenter(from(shortest_edge(t, ids)), kappa),
            DiskChoice::ClampedOffcenter => construct::clamped_offcenter(from(shortest_edge(t, ids)), kappa, p.d2),
        })
    }

    /// The point that splits a subsegment; `None` for a user's.
    fn on_segment(&self, replay: &Replay, [u, v]: [u32; 2], type_c: bool) -> Option<construct::Place> {
        let p = &replay.ledger.parameters;
        let is_apex =
            |v: u32| p.small_angles == SmallAngles::Shells && replay.ledger.apexes.get(v as usize) == Some(&true);
        let [pu, pv] = [u, v].map(|v| replay.mesh.at(v));
        match (is_apex(u), is_apex(v)) {
            (true, true) => return Some(construct::midpoint(pu, pv)),
            (false, false) => {}
            (at_u, _) => {
                let (apex, other) = if at_u { (pu, pv) } else { (pv, pu) };
                let k = (-300..300).find(|&k| is_shell_exponent(pu, pv, k, 0))?;
                return Some(construct::at_distance(apex, other, k));
            }
        }
        let (choice, delta) = if type_c { (p.choice_c, p.mu) } else { (p.choice_b, p.d1) };
        let seed = p.seed.unwrap_or(0);
        Some(match choice {
            Choice::User => return None,
            Choice::Center => construct::midpoint(pu, pv),
            Choice::Extreme => {
                let from_u = match p.extreme.unwrap_or(VertexOfTriangle::First) {
                    VertexOfTriangle::First => true,
                    VertexOfTriangle::Newest => false,
                    VertexOfTriangle::Seeded => draw::words(seed, self.step, 0, 1)[0].is_multiple_of(2),
                };
                let (w, other) = if from_u { (pu, pv) } else { (pv, pu) };
                construct::in_interval(w, other, delta, -1.0)
            }
            Choice::Random => construct::in_interval(pu, pv, delta, draw::interval(seed, self.step)),
        })
    }

    /// That a triangle had to be skipped for this reason.
    fn check_skip(&self, replay: &mut Replay, slot: u32, ids: [u32; 3], reason: SkipReason) -> Checked {
        let own = self.forced_skip(replay, slot, ids);
        match own {
            Forced::Unknown => Ok(()),
            Forced::Skip(own) if own == reason => Ok(()),
            own => broken(Rule::Skip, format!("{own:?}"), format!("{reason:?}")),
        }
    }

    fn forced_skip(&self, replay: &mut Replay, slot: u32, ids: [u32; 3]) -> Forced {
        let Some(a) = self.type_a(replay, ids) else {
            return Forced::Unknown;
        };
        let t = ids.map(|v| replay.mesh.at(v));
        let Some(a) = construct::round(&a).filter(|&a| in_circle(t, a).is_positive()) else {
            return Forced::Skip(SkipReason::Resolution);
        };
        let Arrival::Edge(s) = walk(&replay.mesh, slot, a) else {
            return Forced::Insertion;
        };
        let segment = replay.mesh.segment(s);
        let (u, v) = (replay.mesh.origin(s), replay.mesh.target(s));
        let ends = [u.min(v), u.max(v)];
        let witnesses = seen_witnesses(replay, s);
        if replay.ledger.parameters.max_splits.is_some_and(|limit| replay.ledger.splits[segment as usize] >= limit) {
            return Forced::Skip(SkipReason::SplitLimit { segment: SegmentId(segment) });
        }
        let Some(p) = self.on_segment(replay, ends, !witnesses.is_empty()) else {
            return Forced::Unknown;
        };
        // Points on segments stay within the input's size.
        let Some(p) = construct::round(&p) else {
            return Forced::Skip(SkipReason::Resolution);
        };
        if p == replay.mesh.at(u) || p == replay.mesh.at(v) || !splits_well(replay, s, p, &witnesses) {
            return Forced::Skip(SkipReason::Resolution);
        }
        Forced::Insertion
    }
}

/// What a step must be, by recomputation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Forced {
    Skip(SkipReason),
    Insertion,
    /// A user's point is not known.
    Unknown,
}

/// The apex whose small angle excuses a skinny triangle: that of equal rungs first, then the third corner.
fn excusing_apex(replay: &Replay, t: u32) -> Option<u32> {
    let k = shortest_edge(replay.mesh.places(t), replay.mesh.corners(t)) as u32;
    let e = 4 * t + k;
    let by_rung = replay.ledger.rungs[replay.mesh.origin(e) as usize].map(|r| r.0);
    [by_rung, Some(replay.mesh.apex(e))].into_iter().flatten().find(|&apex| replay.excuses(t, apex))
}

/// The vertices that stay, strictly in Diam(s), that see an interior point of s.
fn seen_witnesses(replay: &mut Replay, s: u32) -> Vec<u32> {
    let mesh = &replay.mesh;
    let ends = [mesh.origin(s), mesh.target(s)].map(|v| mesh.at(v));
    replay.search.vertices_in(mesh, s, &[ends], Crossing::Unconstrained);
    let mut found = std::mem::take(&mut replay.search.found);
    found.retain(|&w| !mesh.vertices[w as usize].is_free() && replay.search.sees(mesh, w, s, Aim::Interior));
    found
}

/// Whether the split of s at p can be done after its deletions: on each side, with the apex that s then has. No vertex is deleted to find out.
fn splits_well(replay: &mut Replay, s: u32, p: Point2, witnesses: &[u32]) -> bool {
    let mesh = &replay.mesh;
    let search = &mut replay.search;
    if !witnesses.is_empty() && !witnesses.iter().any(|&w| search.sees(mesh, w, s, Aim::At(p))) {
        return false;
    }
    let [u, v] = [mesh.origin(s), mesh.target(s)].map(|v| mesh.at(v));
    let policy = replay.ledger.parameters.deletion;
    let crosses = if policy == DeletionPolicy::Disk { Crossing::All } else { Crossing::Unconstrained };
    search.vertices_in(mesh, s, &[[u, v], [u, p], [p, v]], crosses);
    let mut doomed = search.found.clone();
    doomed.retain(|&w| {
        mesh.vertices[w as usize].is_free()
            && match policy {
                DeletionPolicy::Segment => search.sees(mesh, w, s, Aim::Interior),
                DeletionPolicy::Point => search.sees(mesh, w, s, Aim::At(p)),
                DeletionPolicy::Disk => true,
            }
    });
    doomed.sort_unstable();
    [s, mesh.beyond(s)].into_iter().filter(|&e| e != NONE).all(|e| {
        if mesh.inside(e).is_none() {
            return filler::swept(mesh, e, p).is_some();
        }
        let [from, to] = [mesh.origin(e), mesh.target(e)].map(|v| mesh.at(v));
        let Some(apex) = apex_after(replay, e, &doomed) else {
            return false;
        };
        let apex = replay.mesh.at(apex);
        orient(from, p, apex).is_positive() && orient(p, to, apex).is_positive() && in_conflict([from, to, apex], p)
    })
}

/// The apex of the triangle at e once the doomed vertices are gone: of the corners of all triangles that vanish, those that see e, the one whose circle
/// with e holds no other (the circles through both ends of e are ordered by inclusion on its left).
fn apex_after(replay: &Replay, e: u32, doomed: &[u32]) -> Option<u32> {
    let mesh = &replay.mesh;
    let is_doomed = |v: u32| doomed.binary_search(&v).is_ok();
    if !is_doomed(mesh.apex(e)) {
        return Some(mesh.apex(e));
    }
    let mut search = super::sight::Search::default();
    search.fresh(mesh);
    search.mark(triangle_of(e));
    let mut stack = vec![triangle_of(e)];
    let mut corners = Vec::new();
    while let Some(t) = stack.pop() {
        if !mesh.corners(t).into_iter().any(is_doomed) {
            continue;
        }
        corners.extend(mesh.corners(t));
        for e in [4 * t, next(4 * t), next(next(4 * t))] {
            let other = mesh.beyond(e);
            if mesh.segment(e) == NONE && other != NONE && search.mark(triangle_of(other)) {
                stack.push(triangle_of(other));
            }
        }
    }
    corners.sort_unstable();
    corners.dedup();
    let [u, v] = [mesh.origin(e), mesh.target(e)].map(|v| mesh.at(v));
    let mut best = None;
    for w in corners.into_iter().filter(|&w| !is_doomed(w) && mesh.vertices[w as usize].kind != Kind::Deleted) {
        let at = mesh.at(w);
        let closer = best.is_none_or(|b| in_conflict([u, v, mesh.at(b)], at));
        if orient(u, v, at).is_positive() && closer && search.sees(mesh, w, e, Aim::Interior) {
            best = Some(w);
        }
    }
    best
}
