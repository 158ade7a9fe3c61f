//! Quality and topology. Figures are computed in doubles and told; only a quality that is claimed is decided, exactly.

use super::complex::Complex;
use super::exact::is_skinny;
use super::report::{Claim, ClaimReport, Verdict, Witness};
use crate::model::words::counted;

/// How many of the worst triangles are shown.
const WORST: usize = 5;

/// Shape of a triangle: least and largest angle in degrees, circumradius over shortest edge, area.
struct Shape {
    least: f64,
    largest: f64,
    ratio: f64,
    area: f64,
}

fn shape(complex: &Complex<'_>, t: u32) -> Shape {
    let p = complex.corners(t);
    let edge = [p[1] - p[0], p[2] - p[1], p[0] - p[2]];
    let cross = edge[0].perp_dot(edge[1]).abs();
    let angle = |k: usize| {
        let (u, v) = (edge[k], -edge[(k + 2) % 3]);
        u.perp_dot(v).abs().atan2(u.dot(v)).to_degrees()
    };
    let angles = [angle(0), angle(1), angle(2)];
    let length = edge.map(|e| e.length());
    let shortest = length[0].min(length[1]).min(length[2]);
    Shape {
        least: angles[0].min(angles[1]).min(angles[2]),
        largest: angles[0].max(angles[1]).max(angles[2]),
        ratio: length[0] / cross * length[1] * length[2] / (2.0 * shortest),
        area: 0.5 * cross,
    }
}

/// Angles, ratios, areas; the triangles of least angle as witnesses.
pub(super) fn quality(complex: &Complex<'_>, rho2: Option<f64>) -> ClaimReport {
    let mut report = ClaimReport { verdict: Verdict::Told, ..ClaimReport::new(Claim::Quality) };
    let count = complex.triangles.len();
    if count == 0 {
        report.message = "there is no triangle".into();
        return report;
    }
    let (mut least, mut largest, mut ratio) = (180.0f64, 0.0f64, 0.0f64);
    let (mut small, mut large) = (f64::INFINITY, 0.0f64);
    let mut by_angle: Vec<(f64, u32)> = Vec::with_capacity(count);
    for t in 0..count as u32 {
        let s = shape(complex, t);
        least = least.min(s.least);
        largest = largest.max(s.largest);
        ratio = ratio.max(s.ratio);
        small = small.min(s.area);
        large = large.max(s.area);
        by_angle.push((s.least, t));
    }
    by_angle.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let below = |degrees: f64| by_angle.partition_point(|a| a.0 < degrees) as f64;
    report.message =
        format!("angles from {least:.4} to {largest:.4} degrees, circumradius at most {ratio:.4} shortest edges");
    report.figures = vec![
        ("triangles", count as f64),
        ("min_angle", least),
        ("max_angle", largest),
        ("max_radius_edge", ratio),
        ("min_area", small),
        ("max_area", large),
        ("below_20_degrees", below(20.0)),
        ("below_25_degrees", below(25.0)),
        ("below_30_degrees", below(30.0)),
    ];
    if let Some(rho2) = rho2 {
        report.verdict = Verdict::Holds;
        for &(angle, t) in by_angle.iter().filter(|a| is_skinny(complex.corners(a.1), rho2)) {
            let (file, vertices) = (complex.in_file[t as usize], complex.triangles[t as usize]);
            report.violated(complex.subject, &vertices, &[file], || {
                format!("triangle {file} {vertices:?} is skinny, with an angle of {angle:.4} degrees")
            });
        }
        return report;
    }
    for &(angle, t) in by_angle.iter().take(WORST) {
        let file = complex.in_file[t as usize];
        let vertices = complex.triangles[t as usize].to_vec();
        report.witnesses.push(Witness {
            message: format!("triangle {file} {vertices:?} has an angle of {angle:.4} degrees"),
            coordinates: complex.corners(t).map(|p| [p.x, p.y]).to_vec(),
            lines: complex.subject.triangle_lines.get(file as usize).copied().filter(|&l| l > 0).into_iter().collect(),
            vertices,
            triangles: vec![file],
            input: Vec::new(),
        });
    }
    report
}

/// Counts of a complex.
pub(super) struct Counts {
    pub vertices: i64,
    pub edges: i64,
    pub triangles: i64,
    /// Components connected through vertices.
    pub components: i64,
    /// Components connected through edges.
    pub strong_components: i64,
    pub border_loops: i64,
    pub border_edges: i64,
}

impl Counts {
    pub fn of(complex: &Complex<'_>) -> Self {
        let mut by_vertex = Classes::new(complex.subject.points.len());
        let mut by_edge = Classes::new(complex.triangles.len());
        for (t, &[a, b, c]) in complex.triangles.iter().enumerate() {
            by_vertex.join(a, b);
            by_vertex.join(a, c);
            for twin in (3 * t..3 * t + 3).filter_map(|h| complex.twin[h]) {
                by_edge.join(t as u32, twin / 3);
            }
        }
        let mut seen = vec![false; complex.twin.len()];
        let mut loops = 0;
        for start in complex.border() {
            let mut h = start;
            if !seen[h as usize] {
                loops += 1;
            }
            while !seen[h as usize] {
                seen[h as usize] = true;
                h = complex.next_on_border(h);
            }
        }
        Counts {
            vertices: complex.vertices.len() as i64,
            edges: complex.edges().count() as i64,
            triangles: complex.triangles.len() as i64,
            components: complex.vertices.iter().filter(|&&v| by_vertex.find(v) == v).count() as i64,
            strong_components: (0..complex.triangles.len() as u32).filter(|&t| by_edge.find(t) == t).count() as i64,
            border_loops: loops,
            border_edges: complex.border().count() as i64,
        }
    }

    pub fn euler(&self) -> i64 {
        self.vertices - self.edges + self.triangles
    }

    /// Bounded parts of the plane that a planar complex leaves open.
    pub fn holes(&self) -> i64 {
        self.components - self.euler()
    }
}

/// Components, Euler characteristic, border loops, holes.
pub(super) fn topology(complex: &Complex<'_>) -> ClaimReport {
    let c = Counts::of(complex);
    let mut border_degree = vec![0u32; complex.subject.points.len()];
    for h in complex.border() {
        border_degree[complex.ends(h)[0] as usize] += 1;
    }
    let pinched = border_degree.iter().filter(|&&d| d > 1).count();
    let unused = complex.subject.points.len() as i64 - c.vertices;
    let mut report = ClaimReport { verdict: Verdict::Told, ..ClaimReport::new(Claim::Topology) };
    report.message = format!(
        "{}, {}, Euler characteristic {}",
        counted(c.components, "component"),
        counted(c.holes(), "hole"),
        c.euler()
    );
    let figures = [
        ("vertices", c.vertices),
        ("edges", c.edges),
        ("triangles", c.triangles),
        ("components", c.components),
        ("edge_connected_components", c.strong_components),
        ("euler_characteristic", c.euler()),
        ("holes", c.holes()),
        ("border_loops", c.border_loops),
        ("border_edges", c.border_edges),
        ("pinched_vertices", pinched as i64),
        ("vertices_in_no_triangle", unused),
    ];
    report.figures = figures.map(|(name, n)| (name, n as f64)).to_vec();
    report
}

/// Equivalence classes, each represented by its least member.
pub(super) struct Classes(Vec<u32>);

impl Classes {
    pub fn new(count: usize) -> Self {
        Classes((0..count as u32).collect())
    }

    pub fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let parent = self.0[i as usize];
            self.0[i as usize] = self.0[parent as usize];
            i = parent;
        }
        i
    }

    /// Whether they were in different classes.
    pub fn join(&mut self, i: u32, j: u32) -> bool {
        let (i, j) = (self.find(i), self.find(j));
        self.0[i.max(j) as usize] = i.min(j);
        i != j
    }
}
