//! The global part of `valid`: the border of the complex is embedded and has the mesh on one side only.
//!
//! The triangles are counterclockwise and no directed edge belongs to two of them. So the number of triangles that cover a
//! point off all edges is the winding number of the border around it. Let the border edges meet in common ends only; then
//! that number is constant along either side of a border edge, larger by one on the left. If it is 1 on the left and 0
//! on the right of each, no point is covered twice: a face of the border's arrangement with number 2 or -1 would have a border edge.
//! Interiors being disjoint, two triangles could still meet in a vertex w of one inside an edge e of the other; then e has no
//! triangle beyond and the fan of w is open, so that w is a border vertex on a border edge.
//! (If border edges crossed, the four faces there would have numbers k, k + 1, k + 1, k + 2: some point is covered twice.)
//!
//! A sweep over the border's vertices keeps the border edges under way in order, each with the winding number above it.

use super::complex::Complex;
use super::exact::{lexicographic, orient};
use super::report::{ClaimReport, Verdict};
use crate::model::Point2;
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// A border edge by its ends, the lexicographically smaller first; or a probe just below a point (no half-edge).
#[derive(Clone, Copy)]
struct Strand {
    low: Point2,
    high: Point2,
    half: Option<u32>,
    /// Winding number above it.
    above: i32,
}

impl Strand {
    fn probe(p: Point2) -> Self {
        Strand { low: p, high: p, half: None, above: 0 }
    }

    /// Where it stands relative to p, along the sweep line.
    fn against(&self, p: Point2) -> Ordering {
        orient(self.low, self.high, p).reverse()
    }

    /// Whether the interiors cross in one point.
    fn crosses(&self, other: &Strand) -> bool {
        let split = |s: &Strand, t: &Strand| {
            let side = s.against(t.low);
            side != Ordering::Equal && s.against(t.high) == side.reverse()
        };
        split(self, other) && split(other, self)
    }
}

impl Ord for Strand {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.half, other.half) {
            (None, _) => other.against(self.low).reverse().then(Ordering::Less),
            (_, None) => self.against(other.low).then(Ordering::Greater),
            _ => match lexicographic(self.low, other.low) {
                Ordering::Greater => other.against(self.low).then_with(|| other.against(self.high)).reverse(),
                Ordering::Less => self.against(other.low).then_with(|| self.against(other.high)),
                Ordering::Equal => self.against(other.high),
            }
            .then(self.half.cmp(&other.half)),
        }
    }
}
impl PartialOrd for Strand {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Strand {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Strand {}

/// Reports every place where the border touches itself off a common end, or has the mesh on the wrong number of sides.
pub(super) fn embedded(complex: &Complex<'_>, report: &mut ClaimReport) {
    let mut starts: Vec<(u32, Strand)> = Vec::new();
    let mut is_border = vec![false; complex.subject.points.len()];
    for half in complex.border() {
        let [u, v] = complex.ends(half);
        let (p, q) = (complex.point(u), complex.point(v));
        let upward = lexicographic(p, q).is_lt();
        let (low, high, first) = if upward { (p, q, u) } else { (q, p, v) };
        starts.push((first, Strand { low, high, half: Some(half), above: 0 }));
        is_border[u as usize] = true;
        is_border[v as usize] = true;
    }
    starts.sort_unstable_by(|a, b| lexicographic(a.1.low, b.1.low));
    let mut rest = &starts[..];
    let mut sweep = Sweep { complex, report, status: BTreeSet::new() };
    for &w in complex.vertices.iter().filter(|&&w| is_border[w as usize]) {
        let count = rest.iter().take_while(|s| s.0 == w).count();
        let (starting, later) = rest.split_at(count);
        rest = later;
        sweep.visit(w, starting.iter().map(|s| s.1).collect());
    }
}

struct Sweep<'a, 'b> {
    complex: &'a Complex<'a>,
    report: &'b mut ClaimReport,
    status: BTreeSet<Strand>,
}

impl Sweep<'_, '_> {
    /// Strands that touch others are reported and taken out; from the first on, winding numbers are not told any more.
    fn visit(&mut self, w: u32, mut starting: Vec<Strand>) {
        let p = self.complex.point(w);
        let here: Vec<Strand> =
            self.status.range(Strand::probe(p)..).take_while(|s| s.against(p) == Ordering::Equal).copied().collect();
        for s in here {
            self.status.remove(&s);
            if s.high != p {
                self.touch(&s, None, || format!("vertex {w} lies inside a border edge"), Some(w));
            }
        }
        starting.sort_unstable();
        let mut kept: Vec<Strand> = Vec::new();
        for s in starting {
            match kept.last() {
                Some(last) if last.against(s.high) == Ordering::Equal => {
                    let last = *last;
                    self.touch(&s, Some(&last), || "border edges overlap".into(), None);
                }
                _ => kept.push(s),
            }
        }
        let below = self.status.range(..Strand::probe(p)).next_back().copied();
        let above = self.status.range(Strand::probe(p)..).next().copied();
        let mut winding = below.map_or(0, |s| s.above);
        for s in &mut kept {
            winding = self.wind(s, winding);
            s.above = winding;
        }
        let neighbors = match (kept.first(), kept.last()) {
            (Some(&first), Some(&last)) => vec![below.zip(Some(first)), Some(last).zip(above)],
            _ => vec![below.zip(above)],
        };
        self.status.extend(kept);
        self.separate(neighbors.into_iter().flatten().collect());
    }

    /// The winding number above a strand, from that below it; a border half-edge has its triangle on its left.
    fn wind(&mut self, s: &Strand, below: i32) -> i32 {
        // Strands come from border half-edges.
        let half = s.half.unwrap();
        let [u, v] = self.complex.ends(half);
        let above = if self.complex.point(u) == s.low { below + 1 } else { below - 1 };
        if self.report.verdict == Verdict::Holds && below.min(above) != 0 {
            let t = self.complex.in_file[(half / 3) as usize];
            let covered = below.max(above);
            self.report.violated(self.complex.subject, &[u, v], &[t], || {
                format!("triangles overlap: {covered} of them cover the same points beside edge {u}-{v}")
            });
        }
        above
    }

    /// Tests new neighbors; of two that cross, one is taken out.
    fn separate(&mut self, mut neighbors: Vec<(Strand, Strand)>) {
        while let Some((s, t)) = neighbors.pop() {
            if !self.status.contains(&s) || !self.status.contains(&t) || !s.crosses(&t) {
                continue;
            }
            self.touch(&s, Some(&t), || "border edges cross".into(), None);
            self.status.remove(&t);
            let below = self.status.range(..t).next_back().copied();
            let above = self.status.range(t..).next().copied();
            neighbors.extend(below.zip(above));
        }
    }

    fn touch(&mut self, s: &Strand, t: Option<&Strand>, what: impl FnOnce() -> String, w: Option<u32>) {
        let halves: Vec<u32> = [Some(s), t].into_iter().flatten().filter_map(|s| s.half).collect();
        let mut vertices: Vec<u32> = w.into_iter().collect();
        vertices.extend(halves.iter().flat_map(|&h| self.complex.ends(h)));
        let triangles: Vec<u32> = halves.iter().map(|&h| self.complex.in_file[(h / 3) as usize]).collect();
        self.report.violated(self.complex.subject, &vertices, &triangles, || {
            format!("{}: vertices {vertices:?}, triangles {triangles:?}", what())
        });
    }
}
