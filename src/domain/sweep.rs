//! Which vertices lie on which segments, and which segments to suspect of crossings: one sweep of the plane.
//!
//! The vertices are visited in lexicographic order. The *status* holds the segments that the sweep line cuts, in their
//! order along it, which orientation tests of input points decide. At a vertex w the segments through w stand together:
//! those that go on have w in their interior, and start anew at w, in the order of the directions in which they leave.
//! Segments that become neighbors are tested: where two cross, one of them is *suspect* and leaves the status, which
//! thereby always holds segments without crossings ahead, so that its order means something. Every crossing pair has a
//! suspect in it, since two segments are neighbors just before they cross at a point that is no vertex.
//! Cost: O((n + k) log n) for n segments and k incidences, however long the segments are. Two segments that cross
//! exactly at a vertex also make a suspect; whether that is a crossing is not decided here.
//!
//! Source: Shamos and Hoey, Geometric intersection problems (1976); Bentley and Ottmann (1979) for the order at a vertex.

use crate::arith::{Kernel, perturb::lexicographic};
use crate::model::{Point2, Sign};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::marker::PhantomData;

/// A segment by the ids of its ends, the lexicographically smaller point first, and its id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Span {
    pub ends: [u32; 2],
    pub id: u32,
}

/// What the sweep found.
#[derive(Debug, Default)]
pub(super) struct Contacts {
    /// (position in the spans, vertex): the vertex lies in the interior of the segment. Complete for segments that are no suspects.
    pub incidences: Vec<(u32, u32)>,
    /// Positions of suspects, ascending.
    pub suspects: Vec<u32>,
}

/// A segment cut by the sweep line, from where it was last seen to leave a vertex; or a probe just below a vertex.
struct Entry<K> {
    a: Point2,
    b: Point2,
    /// Position in the spans; `None` for a probe, whose place is just below a.
    span: Option<u32>,
    kernel: PhantomData<K>,
}

impl<K> Clone for Entry<K> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<K> Copy for Entry<K> {}

impl<K: Kernel> Entry<K> {
    fn new(a: Point2, b: Point2, span: Option<u32>) -> Self {
        Entry { a, b, span, kernel: PhantomData }
    }

    /// Order of this segment against a point between its ends, along the sweep line.
    fn against(&self, p: Point2) -> Ordering {
        match K::orient2d(self.a, self.b, p) {
            Sign::Positive => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Negative => Ordering::Greater,
        }
    }

    /// Whether the interiors of two segments cross in one point.
    fn crosses(&self, other: &Self) -> bool {
        crosses::<K>([self.a, self.b], [other.a, other.b])
    }
}

/// Whether the interiors of two segments cross in one point.
pub(super) fn crosses<K: Kernel>(s: [Point2; 2], t: [Point2; 2]) -> bool {
    let opposite = |p: Sign, q: Sign| p != Sign::Zero && p == q.reversed();
    let [a, b] = s;
    let [c, d] = t;
    opposite(K::orient2d(a, b, c), K::orient2d(a, b, d)) && opposite(K::orient2d(c, d, a), K::orient2d(c, d, b))
}

impl<K: Kernel> Ord for Entry<K> {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.span, other.span) {
            (None, None) => lexicographic(self.a, other.a),
            (None, Some(_)) => other.against(self.a).reverse().then(Ordering::Less),
            (Some(_), None) => self.against(other.a).then(Ordering::Greater),
            (Some(s), Some(t)) => match lexicographic(self.a, other.a) {
                Ordering::Equal => self.against(other.b),
                Ordering::Less => self.against(other.a).then_with(|| self.against(other.b)),
                Ordering::Greater => other.against(self.a).then_with(|| other.against(self.b)).reverse(),
            }
            .then(s.cmp(&t)),
        }
    }
}
impl<K: Kernel> PartialOrd for Entry<K> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<K: Kernel> PartialEq for Entry<K> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl<K: Kernel> Eq for Entry<K> {}

/// Sweeps the vertices `order` (distinct points, lexicographically ascending) and the segments among them.
pub(super) fn sweep<K: Kernel>(points: &[Point2], order: &[u32], spans: &[Span]) -> Contacts {
    Sweep::<K> {
        points,
        spans,
        status: BTreeSet::new(),
        suspect: vec![false; spans.len()],
        incidences: Vec::new(),
        neighbors: Vec::new(),
    }
    .run(order)
}

struct Sweep<'a, K> {
    points: &'a [Point2],
    spans: &'a [Span],
    status: BTreeSet<Entry<K>>,
    suspect: Vec<bool>,
    incidences: Vec<(u32, u32)>,
    /// Pairs that have become neighbors and are to be tested.
    neighbors: Vec<(Entry<K>, Entry<K>)>,
}

impl<K: Kernel> Sweep<'_, K> {
    fn run(mut self, order: &[u32]) -> Contacts {
        let starts = starts(self.points.len(), self.spans);
        let mut bundle = Vec::new();
        for &w in order {
            let w = w as usize;
            let starting = &starts.1[starts.0[w] as usize..starts.0[w + 1] as usize];
            self.visit(w as u32, starting, &mut bundle);
        }
        let suspects = (0..self.spans.len() as u32).filter(|&s| self.suspect[s as usize]).collect();
        Contacts { incidences: self.incidences, suspects }
    }

    fn visit(&mut self, w: u32, starting: &[u32], bundle: &mut Vec<Entry<K>>) {
        let p = self.points[w as usize];
        let probe = Entry::new(p, p, None);
        bundle.clear();
        let mut above = None;
        for entry in self.status.range(probe..) {
            if entry.against(p) != Ordering::Equal {
                above = Some(*entry);
                break;
            }
            bundle.push(*entry);
        }
        let below = self.status.range(..probe).next_back().copied();
        for entry in bundle.iter() {
            self.status.remove(entry);
        }
        bundle.retain(|e| e.b != p);
        for entry in bundle.iter_mut() {
            entry.a = p;
            // Only probes have no span, and probes are never in the status.
            let span = entry.span.unwrap();
            self.incidences.push((span, w));
        }
        bundle.extend(starting.iter().map(|&s| {
            let b = self.points[self.spans[s as usize].ends[1] as usize];
            Entry::new(p, b, Some(s))
        }));
        bundle.sort_unstable();
        self.status.extend(bundle.iter().copied());
        match (bundle.first(), bundle.last()) {
            (Some(&first), Some(&last)) => {
                self.neighbors.extend(below.map(|e| (e, first)));
                self.neighbors.extend(above.map(|e| (last, e)));
            }
            _ => self.neighbors.extend(below.zip(above)),
        }
        self.separate();
    }

    /// Tests the new neighbors; of two that cross, the longer leaves the status (one long segment may cross many short ones).
    fn separate(&mut self) {
        while let Some((s, t)) = self.neighbors.pop() {
            // Only segments are ever neighbors.
            let (i, j) = (s.span.unwrap() as usize, t.span.unwrap() as usize);
            if self.suspect[i] || self.suspect[j] || !s.crosses(&t) {
                continue;
            }
            let length2 = |e: &Entry<K>| e.a.distance_squared(e.b);
            let (leaves, k) = if length2(&s) > length2(&t) { (s, i) } else { (t, j) };
            self.suspect[k] = true;
            self.status.remove(&leaves);
            let below = self.status.range(..leaves).next_back().copied();
            let above = self.status.range(leaves..).next().copied();
            self.neighbors.extend(below.zip(above));
        }
    }
}

/// The spans by their first end: offsets per vertex, positions.
fn starts(vertices: usize, spans: &[Span]) -> (Vec<u32>, Vec<u32>) {
    let mut offsets = vec![0u32; vertices + 1];
    for s in spans {
        offsets[s.ends[0] as usize + 1] += 1;
    }
    for v in 0..vertices {
        offsets[v + 1] += offsets[v];
    }
    let mut next = offsets.clone();
    let mut list = vec![0u32; spans.len()];
    for (i, s) in spans.iter().enumerate() {
        let slot = &mut next[s.ends[0] as usize];
        list[*slot as usize] = i as u32;
        *slot += 1;
    }
    (offsets, list)
}
