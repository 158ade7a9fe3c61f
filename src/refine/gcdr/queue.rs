//! Queues of bad triangles: exact orders on correctly rounded keys.
//!
//! A key is the rounded value of the ordering quantity, so unequal keys are in the exact order; equal ones are told
//! apart by the kernel's exact comparison, then by sorted ids. Entries carry ids and birth, so a stale one is known.
//! Entries wait unsorted in buckets by the leading bits of their keys; only the first bucket is a heap. Most entries
//! come later than the current one and go stale before their turn, so they cost one append.

use crate::arith::Kernel;
use crate::model::{Point2, QueueOrder, Triangle, canonical_triangle};
use crate::trace::Cause;
use crate::triangulation::cdt2::{Cdt2, TriId};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A bad triangle in a queue.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bad {
    /// Smaller is earlier.
    key: u64,
    /// The area bound or h in normalised units.
    bound: f64,
    /// Its slot, valid while `birth` is that of the slot's triangle.
    pub t: TriId,
    /// Its birth.
    pub birth: u32,
    /// Its vertices, canonical.
    pub ids: Triangle,
    badness: Badness,
}

/// Kinds of badness in the order in which they are treated within one queue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Badness {
    Skinny,
    Area,
    Size,
}

impl Bad {
    /// Why it is bad; h in normalised units.
    pub(super) fn cause(&self) -> Cause {
        match self.badness {
            Badness::Skinny => Cause::Skinny,
            Badness::Area => Cause::Area,
            Badness::Size => Cause::Size { h: self.bound },
        }
    }
}

/// Trailing bits of a key that do not tell its bucket: 12 bits for sign and exponent and 7 of the mantissa do.
const FLOAT_SHIFT: u32 = 64 - 19;

/// The same for births, which are shifted by `BIRTH_SHIFT` themselves: the triangles of 64 events share a bucket.
const BUCKET_OF_BIRTH_SHIFT: u32 = BIRTH_SHIFT + 6;
const BIRTH_SHIFT: u32 = 32;

/// A priority queue of bad triangles under one order.
#[derive(Debug)]
pub(super) struct Queue {
    order: QueueOrder,
    /// Bucket of the heap.
    first: (Badness, u64),
    /// A binary heap: the entries of the first bucket.
    heap: Vec<Bad>,
    /// The entries of later buckets.
    later: BTreeMap<(Badness, u64), Vec<Bad>>,
}

impl Queue {
    pub(super) fn new(order: QueueOrder) -> Queue {
        Queue { order, first: (Badness::Skinny, 0), heap: Vec::new(), later: BTreeMap::new() }
    }

    /// Adds triangle t; `bound` is the area bound or h (unused for skinny triangles).
    pub(super) fn push<K: Kernel>(&mut self, cdt: &Cdt2<K>, t: TriId, badness: Badness, bound: f64) {
        let (corners, birth) = (cdt.corners(t), cdt.birth(t));
        let key = match (self.order, badness) {
            (QueueOrder::ShortestEdge, Badness::Skinny) => {
                let [a, b] = shortest_edge::<K>(cdt.vertices(t), corners).map(|k| corners[k]);
                K::length2(a, b).to_bits()
            }
            // positive floats: the order of the bits is the order of the values
            (QueueOrder::WorstFirst, Badness::Skinny) => !K::ratio2(corners).to_bits(),
            (QueueOrder::WorstFirst, Badness::Area) => !K::area_ratio(corners, bound).to_bits(),
            (QueueOrder::WorstFirst, Badness::Size) => !K::radius_ratio2(corners, bound).to_bits(),
            // by birth, oversized ones also under `shortest-edge`: neighbours in time are neighbours in place, which halves
            // the time of a large mesh for some 3% more triangles than largest first
            (QueueOrder::Fifo | QueueOrder::ShortestEdge, _) => u64::from(birth) << BIRTH_SHIFT,
        };
        let ids = canonical_triangle(cdt.vertices(t));
        let bad = Bad { key, bound, t, birth, ids, badness };
        let shift = match (self.order, badness) {
            (QueueOrder::WorstFirst, _) | (QueueOrder::ShortestEdge, Badness::Skinny) => FLOAT_SHIFT,
            (QueueOrder::Fifo | QueueOrder::ShortestEdge, _) => BUCKET_OF_BIRTH_SHIFT,
        };
        let bucket = (badness, key >> shift);
        if !self.heap.is_empty() && bucket < self.first {
            self.later.insert(self.first, std::mem::take(&mut self.heap));
        }
        if self.heap.is_empty() && self.later.keys().next().is_none_or(|&next| bucket < next) {
            self.first = bucket;
        }
        if bucket == self.first {
            self.heap.push(bad);
            self.sift_up(cdt);
        } else {
            self.later.entry(bucket).or_default().push(bad);
        }
    }

    pub(super) fn pop<K: Kernel>(&mut self, cdt: &Cdt2<K>) -> Option<Bad> {
        if self.heap.is_empty() {
            (self.first, self.heap) = self.later.pop_first()?;
            for k in (0..self.heap.len() / 2).rev() {
                self.sift_down(cdt, k);
            }
        }
        let last = self.heap.len() - 1;
        self.heap.swap(0, last);
        let first = self.heap.pop();
        self.sift_down(cdt, 0);
        first
    }

    /// Lets the last entry rise to its place.
    fn sift_up<K: Kernel>(&mut self, cdt: &Cdt2<K>) {
        let mut k = self.heap.len() - 1;
        while k > 0 {
            let parent = (k - 1) / 2;
            if !self.earlier(cdt, k, parent) {
                return;
            }
            self.heap.swap(k, parent);
            k = parent;
        }
    }

    /// Lets entry k sink to its place.
    fn sift_down<K: Kernel>(&mut self, cdt: &Cdt2<K>, mut k: usize) {
        loop {
            let mut child = 2 * k + 1;
            if child >= self.heap.len() {
                return;
            }
            if child + 1 < self.heap.len() && self.earlier(cdt, child + 1, child) {
                child += 1;
            }
            if !self.earlier(cdt, child, k) {
                return;
            }
            self.heap.swap(k, child);
            k = child;
        }
    }

    /// The order of two entries of one bucket.
    fn earlier<K: Kernel>(&self, cdt: &Cdt2<K>, a: usize, b: usize) -> bool {
        let (a, b) = (&self.heap[a], &self.heap[b]);
        if a.key != b.key {
            return a.key < b.key;
        }
        self.exact(cdt, a, b).then_with(|| sorted(a.ids).cmp(&sorted(b.ids))).is_lt()
    }

    /// The exact order of two entries with equal keys.
    fn exact<K: Kernel>(&self, cdt: &Cdt2<K>, a: &Bad, b: &Bad) -> Ordering {
        let corners = |bad: &Bad| bad.ids.map(|v| cdt.point(v));
        match (self.order, a.badness) {
            (QueueOrder::ShortestEdge, Badness::Skinny) => {
                let (ca, cb) = (corners(a), corners(b));
                let [p, q] = shortest_edge::<K>(a.ids, ca).map(|k| ca[k]);
                let [r, s] = shortest_edge::<K>(b.ids, cb).map(|k| cb[k]);
                K::compare_lengths(p, q, r, s)
            }
            (QueueOrder::WorstFirst, Badness::Skinny) => K::compare_ratio(corners(b), corners(a)),
            (QueueOrder::WorstFirst, Badness::Area) => K::compare_area_ratio(corners(b), b.bound, corners(a), a.bound),
            (QueueOrder::WorstFirst, Badness::Size) => {
                K::compare_radius_ratio(corners(b), b.bound, corners(a), a.bound)
            }
            (QueueOrder::Fifo | QueueOrder::ShortestEdge, _) => Ordering::Equal,
        }
    }
}

fn sorted(mut t: Triangle) -> Triangle {
    t.sort_unstable();
    t
}

/// The shortest edge of a triangle as two corner indices, counterclockwise; of equal ones that with the smallest ids.
pub(super) fn shortest_edge<K: Kernel>(ids: Triangle, c: [Point2; 3]) -> [usize; 2] {
    let ids_of = |[i, j]: [usize; 2]| {
        if ids[i] < ids[j] { [ids[i], ids[j]] } else { [ids[j], ids[i]] }
    };
    let mut best = [0, 1];
    for edge in [[1, 2], [2, 0]] {
        let order = K::compare_lengths(c[edge[0]], c[edge[1]], c[best[0]], c[best[1]]);
        if order.then_with(|| ids_of(edge).cmp(&ids_of(best))).is_lt() {
            best = edge;
        }
    }
    best
}
