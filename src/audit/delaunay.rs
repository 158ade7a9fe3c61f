//! Empty circles: of all vertices, of visible ones, and under the tie-break.

use super::complex::Complex;
use super::exact::{in_circle, in_conflict, orient};
use super::isolated::Isolated;
use super::report::{Claim, ClaimReport, Verdict};
use super::tree::Tree;
use crate::check::scalar::{Bounded, Scalar};
use crate::model::Point2;
use std::cmp::Ordering;

/// Local test at every unconstrained edge: by the constrained Delaunay lemma equivalent to circles empty of visible vertices.
pub(super) fn constrained(complex: &Complex<'_>, constraints: &[bool], isolated: &Isolated) -> ClaimReport {
    let inside = |t, q| in_circle(t, q) == Ordering::Greater;
    let mut report = local(complex, Claim::Constrained, constraints, inside);
    isolated.tell(complex, &mut report);
    report.conclude("no visible vertex inside a circle")
}

/// As `constrained`, ties decided by the perturbation.
pub(super) fn canonical(complex: &Complex<'_>, constraints: &[bool], isolated: &Isolated) -> ClaimReport {
    let mut report = local(complex, Claim::Canonical, constraints, in_conflict);
    isolated.tell(complex, &mut report);
    report.conclude("no conflict under the one tie-break")
}

fn local(
    complex: &Complex<'_>,
    claim: Claim,
    constraints: &[bool],
    inside: impl Fn([Point2; 3], Point2) -> bool,
) -> ClaimReport {
    let mut report = ClaimReport::new(claim);
    for (h, twin) in complex.twin.iter().enumerate() {
        let h = h as u32;
        let Some(twin) = twin.filter(|&twin| h < twin && !constraints[h as usize]) else {
            continue;
        };
        let (t, q) = (h / 3, complex.apex(twin));
        if inside(complex.corners(t), complex.point(q)) {
            witness(&mut report, complex, t, q);
        }
    }
    report
}

fn witness(report: &mut ClaimReport, complex: &Complex<'_>, t: u32, q: u32) {
    let [a, b, c] = complex.triangles[t as usize];
    let t = complex.in_file[t as usize];
    report.violated(complex.subject, &[a, b, c, q], &[t], || {
        format!("vertex {q} is inside the circle of triangle {t} ({a}, {b}, {c})")
    });
}

/// Circles empty of all vertices. In a convex region the local test suffices; else each circle is searched for vertices.
pub(super) fn delaunay(complex: &Complex<'_>, isolated: &Isolated) -> ClaimReport {
    let none = vec![false; complex.twin.len()];
    let inside = |t, q| in_circle(t, q) == Ordering::Greater;
    let mut report = local(complex, Claim::Delaunay, &none, inside);
    if report.verdict == Verdict::Holds && !is_convex(complex) {
        let vertices = &complex.vertices;
        let tree = Tree::new(vertices.len(), |i| [complex.point(vertices[i]); 2]);
        for t in 0..complex.triangles.len() as u32 {
            let corners = complex.corners(t);
            let circle = Circle::around(corners);
            let mut found = None;
            let enter = |low, high| circle.may_meet(low, high);
            tree.visit(enter, |i| {
                let q = vertices[i as usize];
                let p = complex.point(q);
                if circle.may_meet(p, p) && inside(corners, p) {
                    found = Some(q);
                }
                found.is_none()
            });
            if let Some(q) = found {
                witness(&mut report, complex, t, q);
            }
        }
    }
    isolated.tell(complex, &mut report);
    report.conclude("no vertex inside a circle")
}

/// Whether the mesh (a valid complex) has one border loop that never turns right.
fn is_convex(complex: &Complex<'_>) -> bool {
    let Some(start) = complex.border().next() else {
        return false;
    };
    let (mut h, mut length) = (start, 0);
    loop {
        let next = complex.next_on_border(h);
        let ([a, b], [_, c]) = (complex.ends(h), complex.ends(next));
        if orient(complex.point(a), complex.point(b), complex.point(c)) == Ordering::Less {
            return false;
        }
        length += 1;
        h = next;
        if h == start || length > complex.twin.len() {
            break;
        }
    }
    length == complex.border().count()
}

/// A disk that holds the circumscribed disk of a triangle; everything, where rounding leaves it unknown.
struct Circle {
    low: Point2,
    high: Point2,
    radius2: f64,
}

impl Circle {
    fn around([a, b, c]: [Point2; 3]) -> Self {
        let n = Bounded::of;
        let (ux, uy) = (n(b.x) - n(a.x), n(b.y) - n(a.y));
        let (vx, vy) = (n(c.x) - n(a.x), n(c.y) - n(a.y));
        let (u2, v2) = (ux * ux + uy * uy, vx * vx + vy * vy);
        let twice = n(2.0) * (ux * vy - uy * vx);
        let (x, y) = ((u2 * vy - v2 * uy) / twice, (v2 * ux - u2 * vx) / twice);
        let (cx, cy) = (n(a.x) + x, n(a.y) + y);
        Circle {
            low: Point2::new(cx.low(), cy.low()),
            high: Point2::new(cx.high(), cy.high()),
            radius2: (x * x + y * y).high(),
        }
    }

    /// False only if the box is outside of the disk. Comparisons with an unknown center are false, which keeps the box; the
    /// factor covers the rounding of six operations.
    fn may_meet(&self, low: Point2, high: Point2) -> bool {
        let gap = |low: f64, high: f64, from: f64, to: f64| {
            if low > to {
                low - to
            } else if high < from {
                from - high
            } else {
                0.0
            }
        };
        let dx = gap(low.x, high.x, self.low.x, self.high.x);
        let dy = gap(low.y, high.y, self.low.y, self.high.y);
        let outside = (dx * dx + dy * dy) * (1.0 - 1.0 / (1u64 << 40) as f64) > self.radius2;
        !outside
    }
}
