//! The queues of bad triangles, in the order of `docs/trace-format.md`, decided exactly.

use crate::check::complex::canonical;
use crate::check::condition::{distance2, shortest_edge};
use crate::check::predicates::area2;
use crate::check::replay::Replay;
use crate::check::value::{Number, sign_of};
use crate::model::{Point2, QueueOrder, Sign};
use std::cmp::Ordering;

/// Why a triangle is in a queue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Badness {
    /// Skinny.
    Skinny,
    /// Above its area bound.
    Area,
    /// Above its size; known from events only.
    Size,
}

/// A bad triangle with what its place in the queue depends on.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its slot; the entry is stale if the slot's birth is another.
    pub t: u32,
    /// Its birth.
    pub birth: u32,
    /// Why it is bad.
    pub badness: Badness,
    sorted: [u32; 3],
    /// Corners, the shortest edge first.
    corners: [Point2; 3],
    bound: f64,
}

impl Entry {
    /// The entry of triangle t.
    pub fn new(replay: &Replay, t: u32, badness: Badness) -> Entry {
        let (ids, c) = (replay.mesh.corners(t), replay.mesh.places(t));
        let k = shortest_edge(c, ids);
        let mut sorted = canonical(ids);
        sorted.sort_unstable();
        Entry {
            t,
            birth: replay.mesh.facts(t).birth,
            badness,
            sorted,
            corners: [c[k], c[(k + 1) % 3], c[(k + 2) % 3]],
            bound: replay.area_bound(t).unwrap_or(0.0),
        }
    }

    /// Whether the triangle is still there, and not skipped for this.
    pub fn is_due(&self, replay: &Replay) -> bool {
        let mesh = &replay.mesh;
        mesh.lives(self.t) && {
            let facts = mesh.facts(self.t);
            let skipped = match self.badness {
                Badness::Skinny => facts.skipped_skinny,
                Badness::Area | Badness::Size => facts.skipped_oversized,
            };
            // Slots outside the region keep an old birth when they move.
            !facts.outside && facts.birth == self.birth && !skipped
        }
    }
}

/// |l_a|^2 - |l_b|^2.
fn length<N: Number>(a: &Entry, b: &Entry) -> N {
    distance2::<N>(a.corners[0], a.corners[1]) - distance2(b.corners[0], b.corners[1])
}

/// r^2/l^2 of b less that of a, times positive factors: r^2/l^2 = m2 n2/(4 cross^2).
fn ratio<N: Number>(a: &Entry, b: &Entry) -> N {
    let others = |[p, q, s]: [Point2; 3]| distance2::<N>(q, s) * distance2(s, p);
    let cross2 = |[p, q, s]: [Point2; 3]| area2::<N>(p, q, s).square();
    others(b.corners) * cross2(a.corners) - others(a.corners) * cross2(b.corners)
}

/// area/bound of b less that of a, times positive factors.
fn relative_area<N: Number>(a: &Entry, b: &Entry) -> N {
    let area = |[p, q, s]: [Point2; 3]| area2::<N>(p, q, s);
    area(b.corners) * N::of(a.bound) - area(a.corners) * N::of(b.bound)
}

/// A binary heap under one order.
#[derive(Clone, Debug)]
pub struct Queue {
    order: QueueOrder,
    heap: Vec<Entry>,
}

impl Queue {
    /// An empty queue.
    pub fn new(order: QueueOrder) -> Queue {
        Queue { order, heap: Vec::new() }
    }

    fn precedes(&self, a: &Entry, b: &Entry) -> bool {
        let order = match (self.order, a.badness) {
            (QueueOrder::ShortestEdge, Badness::Skinny) => ordering(sign_of!(length(a, b))),
            (QueueOrder::WorstFirst, Badness::Skinny) => ordering(sign_of!(ratio(a, b))),
            (QueueOrder::WorstFirst, _) => ordering(sign_of!(relative_area(a, b))),
            (QueueOrder::Fifo | QueueOrder::ShortestEdge, _) => a.birth.cmp(&b.birth),
        };
        order.then(a.sorted.cmp(&b.sorted)).is_lt()
    }

    /// Adds an entry.
    pub fn push(&mut self, entry: Entry) {
        self.heap.push(entry);
        let mut child = self.heap.len() - 1;
        while child > 0 {
            let parent = (child - 1) / 2;
            if !self.precedes(&self.heap[child], &self.heap[parent]) {
                break;
            }
            self.heap.swap(child, parent);
            child = parent;
        }
    }

    /// Removes the first.
    fn pop(&mut self) {
        if self.heap.is_empty() {
            return;
        }
        self.heap.swap_remove(0);
        let mut parent = 0;
        loop {
            let mut first = parent;
            for child in [2 * parent + 1, 2 * parent + 2] {
                if child < self.heap.len() && self.precedes(&self.heap[child], &self.heap[first]) {
                    first = child;
                }
            }
            if first == parent {
                return;
            }
            self.heap.swap(first, parent);
            parent = first;
        }
    }

    /// The first entry that is due; stale ones are dropped.
    pub fn first(&mut self, replay: &Replay) -> Option<Entry> {
        while let Some(&entry) = self.heap.first() {
            if entry.is_due(replay) {
                return Some(entry);
            }
            self.pop();
        }
        None
    }
}

fn ordering(sign: Sign) -> Ordering {
    match sign {
        Sign::Negative => Ordering::Less,
        Sign::Zero => Ordering::Equal,
        Sign::Positive => Ordering::Greater,
    }
}
