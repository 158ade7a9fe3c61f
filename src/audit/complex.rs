//! The mesh as a complex: triangles turned counterclockwise, linked across edges by sorting; what of `valid` is local.

use super::Subject;
use super::border;
use super::exact::{lexicographic, orient};
use super::report::{Claim, ClaimReport, Verdict};
use crate::model::Point2;
use std::cmp::Ordering;

/// The usable triangles of a mesh and their links. A half-edge is `3 t + k`: the edge of triangle t from corner k to corner k + 1.
pub(super) struct Complex<'a> {
    pub subject: &'a Subject<'a>,
    /// Counterclockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Position of each in the file.
    pub in_file: Vec<u32>,
    /// Positions in the file of triangles that are clockwise there.
    pub clockwise: Vec<u32>,
    /// The half-edge on the other side; `None` on the border.
    pub twin: Vec<Option<u32>>,
    /// Vertices of triangles, in lexicographic order.
    pub vertices: Vec<u32>,
    /// Half-edges by their ends, smaller first; sorted.
    edges: Vec<([u32; 2], u32)>,
}

impl<'a> Complex<'a> {
    /// Builds it, and answers `valid`.
    pub fn new(subject: &'a Subject<'a>) -> (Self, ClaimReport) {
        let mut report = ClaimReport::new(Claim::Valid);
        let mut complex = Complex {
            subject,
            triangles: Vec::new(),
            in_file: Vec::new(),
            clockwise: Vec::new(),
            twin: Vec::new(),
            vertices: Vec::new(),
            edges: Vec::new(),
        };
        complex.collect(&mut report);
        complex.link(&mut report);
        complex.distinct_vertices(&mut report);
        // On a complex with such faults the border means nothing.
        if report.verdict == Verdict::Holds {
            border::embedded(&complex, &mut report);
        }
        if complex.triangles.is_empty() && report.verdict == Verdict::Holds {
            report.verdict = Verdict::Unchecked;
            report.message = "there is no triangle".into();
        } else {
            report = report.conclude("any two triangles meet in a common vertex, a common edge, or not at all");
        }
        (complex, report)
    }

    pub fn point(&self, v: u32) -> Point2 {
        self.subject.points[v as usize]
    }

    pub fn corners(&self, t: u32) -> [Point2; 3] {
        self.triangles[t as usize].map(|v| self.point(v))
    }

    /// From where to where a half-edge leads.
    pub fn ends(&self, half: u32) -> [u32; 2] {
        let t = &self.triangles[(half / 3) as usize];
        [t[(half % 3) as usize], t[((half + 1) % 3) as usize]]
    }

    /// The corner across from a half-edge.
    pub fn apex(&self, half: u32) -> u32 {
        self.triangles[(half / 3) as usize][((half + 2) % 3) as usize]
    }

    /// The half-edges on the border.
    pub fn border(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.twin.len() as u32).filter(|&h| self.twin[h as usize].is_none())
    }

    /// After a border half-edge the next one around the same fan of triangles.
    pub fn next_on_border(&self, half: u32) -> u32 {
        let next = |h: u32| h - h % 3 + (h + 1) % 3;
        let mut h = next(half);
        // A fan has at most as many triangles as the mesh.
        for _ in 0..self.triangles.len() {
            match self.twin[h as usize] {
                Some(twin) => h = next(twin),
                None => break,
            }
        }
        h
    }

    /// The half-edges of an edge.
    pub fn edge(&self, u: u32, v: u32) -> impl Iterator<Item = u32> + '_ {
        let key = [u.min(v), u.max(v)];
        let from = self.edges.partition_point(|e| e.0 < key);
        self.edges[from..].iter().take_while(move |e| e.0 == key).map(|e| e.1)
    }

    /// Distinct edges, by their ends.
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.edges.chunk_by(|a, b| a.0 == b.0).map(|e| e[0].0)
    }

    /// The vertex of a triangle at exactly this place.
    pub fn vertex_at(&self, p: Point2) -> Option<u32> {
        self.vertices.binary_search_by(|&v| lexicographic(self.point(v), p)).ok().map(|i| self.vertices[i])
    }

    /// Takes the triangles that are proper, turned counterclockwise.
    fn collect(&mut self, report: &mut ClaimReport) {
        let subject = self.subject;
        for (i, t) in subject.triangles.iter().enumerate() {
            let i = i as u32;
            let [a, b, c] = t.map(|v| v.0);
            if let Some(v) = [a, b, c].into_iter().find(|&v| v as usize >= subject.points.len()) {
                report.violated(subject, &[], &[i], || {
                    format!("triangle {i} refers to vertex {v}, which does not exist")
                });
                continue;
            }
            if let Some(v) = [a, b, c].into_iter().find(|&v| !self.point(v).is_finite()) {
                report.violated(subject, &[v], &[i], || format!("triangle {i} has vertex {v}, which is not finite"));
                continue;
            }
            let triangle = match orient(self.point(a), self.point(b), self.point(c)) {
                Ordering::Greater => [a, b, c],
                Ordering::Less => [a, c, b],
                Ordering::Equal => {
                    report.violated(subject, &[a, b, c], &[i], || {
                        format!("triangle {i} is degenerate: {a}, {b}, {c} lie on one line")
                    });
                    continue;
                }
            };
            if triangle[1] != b {
                self.clockwise.push(i);
            }
            self.triangles.push(triangle);
            self.in_file.push(i);
        }
    }

    /// Links triangles across their edges. Both triangles at an edge must lie on different sides of it.
    fn link(&mut self, report: &mut ClaimReport) {
        let halves = 3 * self.triangles.len() as u32;
        let mut edges: Vec<([u32; 2], u32)> = (0..halves)
            .map(|h| {
                let [u, v] = self.ends(h);
                ([u.min(v), u.max(v)], h)
            })
            .collect();
        edges.sort_unstable();
        self.twin = vec![None; halves as usize];
        for edge in edges.chunk_by(|a, b| a.0 == b.0) {
            match *edge {
                [_] => {}
                [(_, g), (_, h)] if self.ends(g) != self.ends(h) => {
                    self.twin[g as usize] = Some(h);
                    self.twin[h as usize] = Some(g);
                }
                _ => {
                    let [u, v] = edge[0].0;
                    let triangles: Vec<u32> = edge.iter().map(|e| self.in_file[(e.1 / 3) as usize]).collect();
                    report.violated(self.subject, &[u, v], &triangles, || match edge.len() {
                        2 => format!("triangles {triangles:?} lie on the same side of their common edge {u}-{v}"),
                        n => format!("edge {u}-{v} belongs to {n} triangles: {triangles:?}"),
                    });
                }
            }
        }
        self.edges = edges;
    }

    /// No two vertices of triangles may coincide.
    fn distinct_vertices(&mut self, report: &mut ClaimReport) {
        let mut used = vec![false; self.subject.points.len()];
        for &v in self.triangles.iter().flatten() {
            used[v as usize] = true;
        }
        self.vertices = (0..used.len() as u32).filter(|&v| used[v as usize]).collect();
        let points = self.subject.points;
        self.vertices.sort_unstable_by(|&u, &v| lexicographic(points[u as usize], points[v as usize]).then(u.cmp(&v)));
        for pair in self.vertices.windows(2) {
            let [u, v] = [pair[0], pair[1]];
            if points[u as usize] == points[v as usize] {
                report.violated(self.subject, &[u, v], &[], || format!("vertices {u} and {v} coincide"));
            }
        }
    }
}

/// Whether all triangles are counterclockwise in the file.
pub(super) fn orientation(complex: &Complex<'_>) -> ClaimReport {
    let mut report = ClaimReport::new(Claim::Orientation);
    for &t in &complex.clockwise {
        let vertices = complex.subject.triangles[t as usize].map(|v| v.0);
        report.violated(complex.subject, &vertices, &[t], || format!("triangle {t} is clockwise"));
    }
    let all = !complex.clockwise.is_empty() && complex.clockwise.len() == complex.triangles.len();
    let mut report = report.conclude("every triangle is counterclockwise");
    if all {
        report.message = "every triangle is clockwise".into();
    }
    report
}
