//! Conformity to an input, and the constraints that follow from it.
//!
//! With an input (a repaired one: segments meet at common ends only), a mesh conforms if
//! - every input vertex is a vertex of the mesh, at exactly its coordinates;
//! - every input segment ab is a chain of mesh edges from a to b, each vertex farther along ab than the one before, none
//!   farther from the line ab than `within` units in the last place of the mesh's largest coordinate;
//! - chains meet where segments do, at their ends: no vertex between a and b is an input vertex, or in another chain;
//! - every border edge is in such a chain; where the convex hull is to be meshed, its edges are segments too (`hull`);
//! - no hole seed is covered, and there are at least as many uncovered hole seeds as bounded faces left out.
//!
//! Vertices and segments outside of the mesh are exempt and counted: an input may have parts outside of what it encloses.
//! The last condition is what keeps a mesh from leaving out whatever it likes. It is applied to inputs whose region is
//! what segments enclose; for parity inputs the faces left out depend on nesting, which is not tested here.
//!
//! Without an input, every edge that the file names must be an edge of the mesh, and these, else the interfaces of
//! triangle attributes, are the constraints.

use super::complex::Complex;
use super::exact::{along, distance_from_line, is_near_line, orient};
use super::figures::{Classes, Counts};
use super::hull;
use super::report::{Claim, ClaimReport, Verdict};
use super::tree::Tree;
use super::{Options, Subject};
use crate::model::words::counted;
use crate::model::{Fill, Point2, Pslg, SegmentId, VertexId};
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// The report, and for each half-edge whether it is constrained.
pub(super) struct Conformity {
    pub report: ClaimReport,
    pub constraints: Vec<bool>,
}

/// Tests conformity and finds the constraints.
pub(super) fn conforming(complex: &Complex<'_>, options: &Options<'_>) -> Conformity {
    match options.input {
        Some((input, lines)) => Search::new(complex, input, options.within).run(&lines.segments),
        None => named_edges(complex),
    }
}

/// The constraints that the file itself tells.
fn named_edges(complex: &Complex<'_>) -> Conformity {
    let Subject { edges, triangle_attributes, .. } = *complex.subject;
    let mut constraints = vec![false; complex.twin.len()];
    let mut report = ClaimReport::new(Claim::Conforming);
    for (i, &[u, v]) in edges.iter().enumerate() {
        let mut found = false;
        for h in complex.edge(u.0, v.0) {
            constraints[h as usize] = true;
            found = true;
        }
        if !found {
            report.violated(complex.subject, &[u.0, v.0], &[], || {
                format!("edge {i} ({}, {}) of the file is no edge of a triangle", u.0, v.0)
            });
        }
    }
    if !edges.is_empty() {
        let report = report.conclude("every edge that the file names is there; no input was given");
        return Conformity { report, constraints };
    }
    if !triangle_attributes.is_empty() {
        let attribute = |t: u32| triangle_attributes.get(complex.in_file[t as usize] as usize).map(|a| a.to_bits());
        for (h, twin) in complex.twin.iter().enumerate() {
            constraints[h] = twin.is_some_and(|twin| attribute(h as u32 / 3) != attribute(twin / 3));
        }
    }
    let report = ClaimReport::unchecked(Claim::Conforming, "no input was given, and the file names no edges");
    Conformity { report, constraints }
}

struct Search<'a> {
    complex: &'a Complex<'a>,
    input: &'a Pslg,
    tolerance: f64,
    ulp: f64,
    /// Mesh vertices joined to each by an edge: offsets and list.
    neighbors: (Vec<u32>, Vec<u32>),
    /// Edges that the file names, the smaller end first, sorted.
    named: Vec<[u32; 2]>,
    /// Vertices that no further chain may pass: those of the input, and those inside of chains.
    taken: Vec<bool>,
    border: Vec<u32>,
    border_tree: Tree<Point2>,
    report: ClaimReport,
    constraints: Vec<bool>,
    deviation: f64,
}

impl<'a> Search<'a> {
    fn new(complex: &'a Complex<'a>, input: &'a Pslg, within: f64) -> Self {
        let largest = complex.vertices.iter().fold(0.0f64, |m, &v| m.max(complex.point(v).abs().max_element()));
        let above = largest.next_up();
        let ulp = if above.is_finite() { above - largest } else { largest - largest.next_down() };
        let key = |e: &[VertexId; 2]| [e[0].0.min(e[1].0), e[0].0.max(e[1].0)];
        let mut named: Vec<[u32; 2]> = complex.subject.edges.iter().map(key).collect();
        named.sort_unstable();
        let border: Vec<u32> = complex.border().collect();
        let border_tree = Tree::new(border.len(), |i| complex.ends(border[i]).map(|v| complex.point(v)));
        Search {
            complex,
            input,
            tolerance: (within * ulp).min(f64::MAX),
            ulp,
            neighbors: neighbors(complex),
            named,
            taken: vec![false; complex.subject.points.len()],
            border,
            border_tree,
            report: ClaimReport::new(Claim::Conforming),
            constraints: vec![false; complex.twin.len()],
            deviation: 0.0,
        }
    }

    fn run(mut self, segment_lines: &[u32]) -> Conformity {
        let place = self.vertices();
        place.iter().flatten().for_each(|&v| self.taken[v as usize] = true);
        let mut missing = Vec::new();
        let hull = if self.input.fill == Fill::Convex { hull::edges(self.input) } else { Vec::new() };
        let segments = self.input.segments.iter().enumerate().map(|(i, s)| (s.ends, Some(i)));
        for (ends, number) in segments.chain(hull.into_iter().map(|ends| (ends, None))) {
            if !self.segment(ends, number, &place, segment_lines) {
                missing.push(ends);
            }
        }
        let outside = place.iter().filter(|v| v.is_none()).count();
        self.border_on_segments();
        self.faces_left_out(&place, &missing);
        self.report.figures = vec![
            ("largest_deviation_ulps", self.deviation / self.ulp.max(f64::MIN_POSITIVE)),
            ("vertices_outside", outside as f64),
            ("segments_outside", missing.len() as f64),
        ];
        let holds = format!(
            "every segment is a chain of edges, off it by at most {:.3} ulp; outside lie {} and {}",
            self.deviation / self.ulp.max(f64::MIN_POSITIVE),
            counted(outside, "vertex"),
            counted(missing.len(), "segment")
        );
        Conformity { report: self.report.conclude(&holds), constraints: self.constraints }
    }

    /// For each input vertex the mesh vertex at its place; one that is missing must not be covered.
    fn vertices(&mut self) -> Vec<Option<u32>> {
        let place: Vec<Option<u32>> =
            self.input.points.iter().map(|&p| self.complex.vertex_at(p).filter(|_| p.is_finite())).collect();
        for (i, _) in place.iter().enumerate().filter(|(_, v)| v.is_none()) {
            let p = self.input.points[i];
            if p.is_finite() && self.covered(p) {
                let subject = self.complex.subject;
                self.report.violated(subject, &[], &[], || {
                    format!("input vertex {i} at ({}, {}) is no vertex of the mesh that covers it", p.x, p.y)
                });
            }
        }
        place
    }

    /// Whether the mesh covers p or has it on its border: the winding number of the border, counted along the ray to +x.
    fn covered(&self, p: Point2) -> bool {
        let (mut winding, mut on_border) = (0, false);
        let enter = |low: Point2, high: Point2| low.y <= p.y && p.y <= high.y && high.x >= p.x;
        self.border_tree.visit(enter, |i| {
            let [a, b] = self.complex.ends(self.border[i as usize]).map(|v| self.complex.point(v));
            if !enter(a.min(b), a.max(b)) {
                return true;
            }
            let side = orient(a, b, p);
            on_border |= side == Ordering::Equal && a.x.min(b.x) <= p.x;
            if a.y <= p.y && p.y < b.y && side == Ordering::Greater {
                winding += 1;
            } else if b.y <= p.y && p.y < a.y && side == Ordering::Less {
                winding -= 1;
            }
            true
        });
        winding != 0 || on_border
    }

    /// Whether a segment, or an edge of the hull without a number, was found, or reported; false if it lies outside.
    fn segment(&mut self, s: [VertexId; 2], number: Option<usize>, place: &[Option<u32>], lines: &[u32]) -> bool {
        let end = |k: usize| place.get(s[k].index()).copied().flatten();
        if let (Some(a), Some(b)) = (end(0), end(1)) {
            if a == b {
                return true;
            }
            if let Some(chain) = self.chain(a, b) {
                self.mark(&chain);
                return true;
            }
        }
        let point = |k: usize| self.input.points.get(s[k].index()).copied();
        let (Some(p), Some(q)) = (point(0), point(1)) else {
            return true;
        };
        let inside = end(0).is_some_and(|a| self.enters(a, q)) || end(1).is_some_and(|b| self.enters(b, p));
        if inside {
            let vertices: Vec<u32> = [end(0), end(1)].into_iter().flatten().collect();
            let subject = self.complex.subject;
            self.report.violated(subject, &vertices, &[], || {
                let [u, v] = s.map(|v| v.0);
                let Some(i) = number else {
                    return format!("the edge of the input's hull ({u}, {v}) is no chain of edges");
                };
                let line =
                    lines.get(i).filter(|&&l| l > 0).map(|l| format!(", line {l} of the input")).unwrap_or_default();
                format!("segment {i} of the input ({u}, {v}{line}) is no chain of edges")
            });
            let listed = self.report.violations <= super::LISTED_WITNESSES as u64;
            if let (Some(w), Some(i)) = (self.report.witnesses.last_mut().filter(|_| listed), number) {
                w.input.push(SegmentId(i as u32));
            }
        }
        inside
    }

    /// The chain from a to b: where vertices lie as near to a line as roundings reach there may be several, and the file's own word decides.
    fn chain(&self, a: u32, b: u32) -> Option<Vec<u32>> {
        let named = |v: u32, w: u32| self.named.binary_search(&[v.min(w), v.max(w)]).is_ok();
        if let Some(path) = self.path(a, b, named) {
            return Some(path);
        }
        if self.complex.edge(a, b).next().is_some() {
            return Some(vec![a, b]);
        }
        self.path(a, b, |_, _| true)
    }

    /// A path of admitted edges from a to b, ever farther along ab and near it; of several the one that keeps nearest first.
    fn path(&self, a: u32, b: u32, admitted: impl Fn(u32, u32) -> bool) -> Option<Vec<u32>> {
        let (p, q) = (self.complex.point(a), self.complex.point(b));
        let mut tried = BTreeSet::from([a]);
        let mut path = vec![a];
        while let Some(&v) = path.last() {
            if v == b {
                return Some(path);
            }
            let (offsets, list) = &self.neighbors;
            let at = |w: u32| self.complex.point(w);
            let next = list[offsets[v as usize] as usize..offsets[v as usize + 1] as usize].iter().copied();
            let next = next.filter(|&w| {
                !tried.contains(&w)
                    && admitted(v, w)
                    && (w == b
                        || !self.taken[w as usize]
                            && along(p, q, at(w), at(v)) == Ordering::Greater
                            && along(p, q, at(w), q) == Ordering::Less
                            && is_near_line(p, q, at(w), self.tolerance))
            });
            let nearest = next.min_by(|&w, &x| {
                let d = |w: u32| {
                    if w == b { -1.0 } else { (at(w) - p).perp_dot(q - p).abs() }
                };
                d(w).total_cmp(&d(x)).then(w.cmp(&x))
            });
            match nearest {
                Some(w) => {
                    tried.insert(w);
                    path.push(w);
                }
                None => {
                    path.pop();
                }
            }
        }
        None
    }

    fn mark(&mut self, chain: &[u32]) {
        let ends = [chain[0], chain[chain.len() - 1]].map(|v| self.complex.point(v));
        for pair in chain.windows(2) {
            for h in self.complex.edge(pair[0], pair[1]) {
                self.constraints[h as usize] = true;
            }
        }
        for &v in &chain[1..chain.len() - 1] {
            self.taken[v as usize] = true;
            let d = distance_from_line(ends[0], ends[1], self.complex.point(v));
            self.deviation = self.deviation.max(d);
        }
    }

    /// Whether the direction from mesh vertex v to q leads into a triangle or along an edge of the mesh.
    fn enters(&self, v: u32, q: Point2) -> bool {
        let (offsets, list) = &self.neighbors;
        let p = self.complex.point(v);
        list[offsets[v as usize] as usize..offsets[v as usize + 1] as usize].iter().any(|&w| {
            self.complex.edge(v, w).filter(|&h| self.complex.ends(h) == [v, w]).any(|h| {
                let right = orient(p, self.complex.point(w), q);
                let left = orient(p, self.complex.point(self.complex.apex(h)), q);
                let ahead = along(p, self.complex.point(w), q, p) == Ordering::Greater;
                (right == Ordering::Greater && left == Ordering::Less) || (right == Ordering::Equal && ahead)
            })
        })
    }

    /// Every border edge is in a chain.
    fn border_on_segments(&mut self) {
        for &h in &self.border {
            if !self.constraints[h as usize] {
                let [u, v] = self.complex.ends(h);
                let t = self.complex.in_file[(h / 3) as usize];
                self.report.violated(self.complex.subject, &[u, v], &[t], || {
                    format!("border edge {u}-{v} is part of no input segment")
                });
            }
        }
    }

    /// Hole seeds are not covered; bounded faces left out are at most as many as these.
    ///
    /// The faces: holes of the mesh, and one more for each segment outside that closes a cycle, components of the mesh taken as points.
    fn faces_left_out(&mut self, place: &[Option<u32>], missing: &[[VertexId; 2]]) {
        let subject = self.complex.subject;
        let mut uncovered = 0;
        for (i, &seed) in self.input.holes.iter().enumerate() {
            if seed.is_finite() && self.covered(seed) {
                self.report.violated(subject, &[], &[], || {
                    format!("the mesh covers the seed of hole {i} at ({}, {})", seed.x, seed.y)
                });
            } else {
                uncovered += 1;
            }
        }
        if self.input.fill == Fill::Parity {
            return;
        }
        // Mesh vertices first, then input vertices that are not among them.
        let base = subject.points.len();
        let mut classes = Classes::new(base + self.input.points.len());
        for &[a, b, c] in &self.complex.triangles {
            classes.join(a, b);
            classes.join(a, c);
        }
        let node = |v: usize| place[v].unwrap_or((base + v) as u32);
        let cycles = missing.iter().filter(|[u, v]| !classes.join(node(u.index()), node(v.index()))).count();
        let faces = Counts::of(self.complex).holes() + cycles as i64;
        if faces > uncovered && self.report.verdict == Verdict::Holds {
            self.report.violated(subject, &[], &[], || {
                let (left_out, asked) = (counted(faces, "closed face"), counted(uncovered, "hole seed"));
                format!("the mesh leaves out {left_out}, and the input has {asked} outside of it")
            });
        }
    }
}

fn neighbors(complex: &Complex<'_>) -> (Vec<u32>, Vec<u32>) {
    let mut offsets = vec![0u32; complex.subject.points.len() + 1];
    for v in complex.edges().flatten() {
        offsets[v as usize + 1] += 1;
    }
    for i in 1..offsets.len() {
        offsets[i] += offsets[i - 1];
    }
    let mut next = offsets.clone();
    let mut list = vec![0u32; *offsets.last().unwrap_or(&0) as usize];
    for [u, v] in complex.edges() {
        for (from, to) in [(u, v), (v, u)] {
            list[next[from as usize] as usize] = to;
            next[from as usize] += 1;
        }
    }
    (offsets, list)
}
