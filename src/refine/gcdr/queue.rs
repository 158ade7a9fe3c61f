//! Queues of bad triangles: exact orders on correctly rounded keys.
//!
//! A key is the rounded value of the ordering quantity, so unequal keys are in the exact order; equal ones are told
//! apart by the kernel's exact comparison, then by sorted ids. Entries carry ids and birth, so a stale one is known.

use crate::arith::Kernel;
use crate::model::{Point2, QueueOrder, Triangle, canonical_triangle};
use crate::trace::Cause;
use crate::triangulation::cdt2::{Cdt2, TriId};
use std::cmp::Ordering;

/// A bad triangle in a queue.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bad {
    /// Smaller is earlier.
    key: u64,
    /// Its slot, valid while `birth` is that of the slot's triangle.
    pub t: TriId,
    /// Its birth.
    pub birth: u32,
    /// Its vertices, canonical.
    pub ids: Triangle,
    /// Why it is bad; h in normalised units.
    pub cause: Cause,
    /// The area bound, if that is the cause.
    bound: f64,
}

/// A binary heap of bad triangles under one order.
#[derive(Debug)]
pub(super) struct Queue {
    heap: Vec<Bad>,
    order: QueueOrder,
}

impl Queue {
    pub(super) fn new(order: QueueOrder) -> Queue {
        Queue {
            heap: Vec::new(),
            order,
        }
    }

    /// The entry of triangle t; `bound` is the area bound or h (unused for skinny triangles).
    pub(super) fn entry<K: Kernel>(
        &self,
        cdt: &Cdt2<K>,
        t: TriId,
        cause: Cause,
        bound: f64,
    ) -> Bad {
        let corners = cdt.corners(t);
        let birth = cdt.birth(t);
        let key = match (self.order, cause) {
            (QueueOrder::Fifo, _) => u64::from(birth),
            (QueueOrder::ShortestEdge, Cause::Skinny) => {
                let [a, b] = shortest_edge::<K>(cdt.vertices(t), corners).map(|k| corners[k]);
                K::length2(a, b).to_bits()
            }
            // positive floats: the order of the bits is the order of the values
            (QueueOrder::WorstFirst, Cause::Skinny) => !K::ratio2(corners).to_bits(),
            (_, Cause::Area) => !K::area_ratio(corners, bound).to_bits(),
            (_, Cause::Size { .. }) => !K::radius_ratio2(corners, bound).to_bits(),
        };
        Bad {
            key,
            t,
            birth,
            ids: canonical_triangle(cdt.vertices(t)),
            cause,
            bound,
        }
    }

    pub(super) fn push<K: Kernel>(&mut self, cdt: &Cdt2<K>, bad: Bad) {
        self.heap.push(bad);
        let mut k = self.heap.len() - 1;
        while k > 0 {
            let parent = (k - 1) / 2;
            if !self.earlier(cdt, k, parent) {
                break;
            }
            self.heap.swap(k, parent);
            k = parent;
        }
    }

    pub(super) fn pop<K: Kernel>(&mut self, cdt: &Cdt2<K>) -> Option<Bad> {
        let last = self.heap.len().checked_sub(1)?;
        self.heap.swap(0, last);
        let first = self.heap.pop();
        let mut k = 0;
        loop {
            let mut child = 2 * k + 1;
            if child >= self.heap.len() {
                return first;
            }
            if child + 1 < self.heap.len() && self.earlier(cdt, child + 1, child) {
                child += 1;
            }
            if !self.earlier(cdt, child, k) {
                return first;
            }
            self.heap.swap(k, child);
            k = child;
        }
    }

    fn earlier<K: Kernel>(&self, cdt: &Cdt2<K>, a: usize, b: usize) -> bool {
        let (a, b) = (&self.heap[a], &self.heap[b]);
        let class = |bad: &Bad| matches!(bad.cause, Cause::Size { .. });
        class(a)
            .cmp(&class(b))
            .then(a.key.cmp(&b.key))
            .then_with(|| self.exact(cdt, a, b))
            .then_with(|| sorted(a.ids).cmp(&sorted(b.ids)))
            .is_lt()
    }

    /// The exact order of two entries with equal keys.
    fn exact<K: Kernel>(&self, cdt: &Cdt2<K>, a: &Bad, b: &Bad) -> Ordering {
        let corners = |bad: &Bad| bad.ids.map(|v| cdt.point(v));
        let (ca, cb) = (corners(a), corners(b));
        match (self.order, a.cause) {
            (QueueOrder::Fifo, _) => Ordering::Equal,
            (QueueOrder::ShortestEdge, Cause::Skinny) => {
                let [p, q] = shortest_edge::<K>(a.ids, ca).map(|k| ca[k]);
                let [r, s] = shortest_edge::<K>(b.ids, cb).map(|k| cb[k]);
                K::compare_lengths(p, q, r, s)
            }
            (QueueOrder::WorstFirst, Cause::Skinny) => K::compare_ratio(cb, ca),
            (_, Cause::Area) => K::compare_area_ratio(cb, b.bound, ca, a.bound),
            (_, Cause::Size { .. }) => K::compare_radius_ratio(cb, b.bound, ca, a.bound),
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
        if ids[i] < ids[j] {
            [ids[i], ids[j]]
        } else {
            [ids[j], ids[i]]
        }
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
