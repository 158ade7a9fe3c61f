//! The replay: one function per kind of event. Each proves the facts of its event and then changes the complex.
//!
//! Removals precede the split that justifies them, so they wait until it comes. An insertion's cavity is flooded anew and compared with
//! the list in the trace. That the new triangles tile the cavity: the cavity is a tree of triangles (edges on its rim = triangles + 2, less one
//! for each side of a split subsegment), and all new triangles are positively oriented, so the rim winds around p; it does so once, because the cavity covers no point twice.

use super::complex::{Complex, Kind, NONE, canonical, next, numbers, previous};
use super::ledger::Ledger;
use super::predicates::in_circle;
use super::rows;
use super::scale::Scale;
use super::sight::Search;
use super::verdict::{Checked, Rule, broken, ensure};
use crate::model::{Point2, Triangle, VertexId};
use crate::trace::{Cause, Event, Why};

/// An edge of a cavity's rim, seen from the cavity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    pub(super) from: u32,
    pub(super) to: u32,
    /// The half-edge outside.
    pub(super) outer: u32,
    pub(super) segment: u32,
}

/// A removal that waits for its split: the vertex and its triangles in `Replay::filling`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    pub(super) vertex: u32,
    pub(super) event: u64,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// The state of a replay.
#[derive(Clone, Debug)]
pub struct Replay {
    /// The mesh.
    pub mesh: Complex,
    /// What the rules keep account of.
    pub ledger: Ledger,
    /// Units.
    pub scale: Scale,
    /// Number of the event in hand.
    pub event: u64,
    /// Triangles created by the step in hand; some may be gone again.
    pub created: Vec<u32>,
    /// Searches.
    pub search: Search,
    pub(super) destroyed: Vec<u32>,
    pub(super) rim: Vec<Rim>,
    pub(super) stack: Vec<u32>,
    pub(super) waiting: Vec<Waiting>,
    pub(super) filling: Vec<[u32; 3]>,
    pub(super) links: Vec<super::surgery::Link>,
}

impl Replay {
    /// A replay that begins with a carved initial triangulation.
    pub fn new(mesh: Complex, scale: Scale, search: Search, ledger: Ledger) -> Replay {
        Replay {
            mesh,
            ledger,
            scale,
            event: 0,
            created: Vec::new(),
            search,
            destroyed: Vec::new(),
            rim: Vec::new(),
            stack: Vec::new(),
            waiting: Vec::new(),
            filling: Vec::new(),
            links: Vec::new(),
        }
    }

    // Facts used by several events.

    /// The triangle of an event; it is in the region.
    pub fn triangle(&self, t: Triangle) -> Checked<u32> {
        let corners = numbers(t);
        ensure(canonical(corners) == corners, Rule::Canonical, || ("the smallest id first", format!("{corners:?}")))?;
        match self.mesh.find_triangle(corners).filter(|&t| !self.mesh.facts(t).outside) {
            Some(t) => Ok(t),
            None => broken(Rule::Exists, "a triangle of the mesh", format!("{corners:?}")),
        }
    }

    // Events.

    /// Takes one event. Removals only join the queue of those that wait.
    pub fn event(&mut self, event: &Event) -> Checked {
        if let (Event::Skip { .. } | Event::Insert { why: Why::Free { .. }, .. }, Some(first)) =
            (event, self.first_waiting())
        {
            return broken(Rule::Removal, format!("the split that removal {first} is for"), "another event");
        }
        match event {
            Event::Remove { id, created } => self.wait(*id, created),
            Event::Skip { t, cause, reason } => self.skip(*t, *cause, *reason),
            Event::Insert { p, why: Why::Free { cause }, destroyed } => self.insert_free(*p, *cause, destroyed),
            Event::Insert { p, why: Why::Split { kind, s, t, cause, a, shell }, destroyed } => {
                let split = self.split_of(*p, *kind, s.map(|v| v.0), *t, *cause, *a)?;
                self.insert_on_segment(split, *shell, destroyed)
            }
        }
    }

    fn wait(&mut self, VertexId(vertex): VertexId, created: &[Triangle]) -> Checked {
        let free = self.mesh.vertices.get(vertex as usize).is_some_and(|v| v.is_free());
        ensure(free, Rule::S2, || ("a free vertex of the mesh", format!("vertex {vertex}")))?;
        let ascending = self.waiting.last().is_none_or(|w| w.vertex < vertex);
        ensure(ascending, Rule::S2, || ("removals in ascending order of ids", format!("vertex {vertex}")))?;
        let start = self.filling.len();
        self.filling.extend(created.iter().map(|&t| numbers(t)));
        self.waiting.push(Waiting { vertex, event: self.event, start, end: self.filling.len() });
        Ok(())
    }

    fn insert_free(&mut self, p: Point2, cause: Cause, destroyed: &[Triangle]) -> Checked {
        let Some(&first) = destroyed.first() else {
            return broken(Rule::Flood, "the bad triangle first", "no destroyed triangle");
        };
        let p = self.scale.place(p)?;
        let t = self.triangle(first)?;
        self.check_cause(t, cause)?;
        let corners = self.mesh.places(t);
        ensure(in_circle(corners, p).is_positive(), Rule::A1, || {
            ("a point strictly inside the circle of its triangle", format!("{p:?}"))
        })?;
        self.check_users_disk(corners, p)?;
        let (ids, slack) = (self.mesh.corners(t), self.ledger.regions.disk(corners, p));
        let region = self.mesh.facts(t).region;
        let root = (0..3).find(|&k| ids[k as usize] == first[0].0).unwrap_or(0);
        self.begin_flood();
        self.flood_root(t, &[4 * t + root, next(4 * t + root), previous(4 * t + root)], p);
        self.compare_flood(destroyed)?;
        let tree = self.rim.len() == self.destroyed.len() + 2;
        ensure(tree, Rule::Star, || ("a cavity that encloses no vertex", "one that does"))?;
        self.check_positive(p)?;
        let v = self.mesh.add_vertex(p, Kind::Free);
        self.ledger.rungs.push(None);
        self.destroyed.iter().for_each(|&t| self.mesh.drop(t));
        let count = self.rim.len();
        self.fan(v, 0..count, region);
        let (first, last) = (self.created[self.created.len() - count], self.created[self.created.len() - 1]);
        self.mesh.join(4 * last + 1, 4 * first + 2, NONE);
        self.measure(v);
        self.ledger.tally.type_a += 1;
        rows::type_a(self, v, corners, ids, cause, slack)
    }

    pub(super) fn apply_removals(&mut self) -> Checked {
        let now = self.event;
        for i in 0..self.waiting.len() {
            let w = self.waiting[i];
            self.event = w.event;
            self.remove(w)?;
        }
        self.event = now;
        self.waiting.clear();
        self.filling.clear();
        Ok(())
    }
}

/// The birth mark of what an event creates. Marks of runs beyond 2^32 events coincide, which only a strict check would notice.
pub(super) fn birth(event: u64) -> u32 {
    u32::try_from(event + 1).unwrap_or(u32::MAX)
}
