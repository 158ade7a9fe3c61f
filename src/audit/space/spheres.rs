//! Empty spheres: circumspheres, orthospheres, orthospheres under the tie-break.
//!
//! A vertex q is in conflict with a cell if it is below the plane through the cell's lifted corners. Across each facet the far corner of
//! the neighbor is tested. **Lemma.** Let no such test fail. If q is in conflict with a cell c, then also with a cell c' at the border and strictly beyond a border facet
//! of c'. Proof: walk straight from a point inside c to q, off all edges. Passing a facet, the plane of the next cell is above that of the last on
//! the far side, where q is: the conflict is inherited. The walk ends at a border facet, or in a cell with corner q, which is in no conflict with it.
//!
//! So in a convex region the tests across facets suffice; elsewhere the vertices in the sphere of each cell at the border are looked up. Ties: with the lifts
//! raised by infinitesimals the same holds.
//!
//! Facets are tested fan by fan, as they are matched: all with one smallest vertex, from which their corners are seen.

use super::border::{Border, budget};
use super::complex::Complex;
use super::isolated::Isolated;
use super::report::{Claim, ClaimReport};
use crate::audit::report::Verdict;
use crate::audit::tree::Tree;
use crate::check::scalar::{Bounded, Scalar};
use crate::check::space::ball::{Ball as Orthoball, Row, near_side};
use crate::check::space::glue::{BORDER, Fan};
use crate::check::space::predicates::{Corners, orient, side, tie_in_conflict};
use crate::model::{Point3, Sign, WeightedPoint};
use std::borrow::Cow;

/// One of the three claims, under test.
pub(super) struct Spheres<'a> {
    complex: &'a Complex<'a>,
    claim: Claim,
    /// The points, for `Delaunay` without their weights.
    sites: Cow<'a, [WeightedPoint]>,
    /// Whether the cells seen are positive.
    all_positive: bool,
    /// Cells and vertices in conflict, across a facet.
    found: Vec<(u32, u32)>,
    /// The corners of a fan, facet by facet, as seen from its vertex.
    rows: Vec<Row>,
    /// The orthoballs of its first cells.
    balls: Vec<Orthoball>,
    /// Pairs of facets for which doubles do not show that there is no conflict.
    near: Vec<[u32; 2]>,
}

impl<'a> Spheres<'a> {
    /// Whether a claim is one of the three.
    pub fn is_about(claim: Claim) -> bool {
        matches!(claim, Claim::Delaunay | Claim::Regular | Claim::Canonical)
    }

    /// The test of a claim, if it is one of the three; all fans are to be shown to it.
    pub fn new(complex: &'a Complex<'a>, claim: Claim) -> Option<Self> {
        if !Self::is_about(claim) {
            return None;
        }
        let weighted = claim != Claim::Delaunay || complex.sites.iter().all(|p| p.weight == 0.0);
        let sites = if weighted {
            Cow::Borrowed(&complex.sites[..])
        } else {
            complex.sites.iter().map(|p| WeightedPoint::unweighted(p.at)).collect()
        };
        let (found, rows, balls, near) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Some(Spheres { complex, claim, sites, all_positive: true, found, rows, balls, near })
    }

    /// The report; nothing if a cell is not positive.
    pub fn empty(mut self, border: Option<&Border<'_>>, isolated: &Isolated) -> Option<ClaimReport> {
        let mut report = ClaimReport::new(self.claim);
        self.found.sort_unstable();
        for &(t, v) in &self.found {
            self.witness(t, v, &mut report);
        }
        if !self.all_positive {
            return None;
        }
        // Without a border the mesh is no complex, and one conflict is as good as another.
        if let Some(border) = border.filter(|b| !b.is_convex && report.verdict == Verdict::Holds)
            && !self.beyond_border(border, &mut report)
        {
            return Some(ClaimReport::unchecked(
                self.claim,
                "too many vertices are close to the spheres at the border",
            ));
        }
        self.left_out(isolated, &mut report);
        Some(report.conclude(match self.claim {
            Claim::Delaunay => "no vertex inside a circumsphere",
            Claim::Regular => "no vertex inside an orthosphere",
            _ => "no conflict under the one tie-break",
        }))
    }

    /// Tests the first cells of a fan for orientation, and each pair of its facets for conflict, which is mutual: the cell of one against the corner
    /// across from the other. A cell is among the first ones of one fan.
    pub fn see(&mut self, fan: &Fan) {
        let Spheres { sites, rows, balls, near, .. } = self;
        let base = sites[fan.a as usize];
        rows.clear();
        rows.extend(fan.corners.iter().map(|&v| Row::new(base, sites[v as usize])));
        balls.clear();
        // With a, p, q, r positive so is q, p, r, a.
        balls.extend(rows.as_chunks().0[..fan.first.len()].iter().map(|[p, q, r]| Orthoball::new(q, p, r)));
        let are_positive = balls.iter().all(|ball| ball.orientation() == Some(Sign::Positive));
        near.clear();
        for &[f, g] in &fan.pairs {
            let from_second;
            let ball = match balls.get(f as usize / 3) {
                Some(ball) => ball,
                None => {
                    let corners = fan.corners_of(f).map(|v| Row::new(base, sites[v as usize]));
                    let [_, p, q, r] = corners;
                    from_second = Orthoball::new(&q, &p, &r);
                    &from_second
                }
            };
            if ball.side(&rows[g as usize]) != Some(Sign::Negative) {
                near.push([f, g]);
            }
        }
        if !are_positive || !self.near.is_empty() {
            self.look_closer(fan, are_positive);
        }
    }

    /// Decides what doubles did not.
    #[cold]
    fn look_closer(&mut self, fan: &Fan, are_positive: bool) {
        if !are_positive {
            self.all_positive &= fan.first.iter().all(|(_, cell)| {
                let [a, b, c, d] = cell.map(|v| self.complex.at(v));
                orient(a, b, c, d) == Sign::Positive
            });
        }
        // What is not positive has no sphere.
        if !self.all_positive {
            return;
        }
        for &[f, g] in &self.near {
            let (t, v) = (fan.slots[f as usize] / 4, fan.corners[g as usize]);
            let corners = fan.corners_of(f).map(|v| self.sites[v as usize]);
            let q = &self.sites[v as usize];
            if self.conflicts(near_side(&corners, q), &corners, q) {
                self.found.push((t, v));
            }
        }
    }

    fn corners(&self, t: u32) -> Corners {
        self.complex.cells[t as usize].map(|v| self.sites[v as usize])
    }

    /// Whether a side means conflict, given how to break a tie.
    fn conflicts(&self, side: Sign, t: &Corners, q: &WeightedPoint) -> bool {
        match side {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => self.claim == Claim::Canonical && tie_in_conflict(t, q),
        }
    }

    /// The cells at the border against vertices beyond it; of each cell, one vertex is told. False if there are too many to be looked at.
    fn beyond_border(&self, border: &Border<'_>, report: &mut ClaimReport) -> bool {
        let vertices: Vec<u32> = (0u32..).zip(self.complex.used()).filter(|v| v.1).map(|v| v.0).collect();
        let place = |i: usize| self.sites[vertices[i] as usize];
        let tree = Tree::new(vertices.len(), |i| [place(i).at; 2]);
        let heaviest = vertices.iter().fold(f64::NEG_INFINITY, |m, &v| m.max(self.sites[v as usize].weight));
        let (mut last, mut budget) = (BORDER, budget(border.facets.len() + vertices.len()));
        for (&slot, facet) in border.slots.iter().zip(&border.facets) {
            let i = slot / 4;
            if i == last {
                continue;
            }
            let t = self.corners(i);
            let [a, b, c] = facet.map(|v| self.complex.at(v));
            let ball = Ball::around(&t, heaviest);
            // A box that is beyond the facet has a corner there.
            let is_beyond = |q: Point3| orient(a, b, c, q) == Sign::Negative;
            let reaches_beyond = |low: Point3, high: Point3| {
                let corner = |k: usize| [0, 1, 2].map(|i| if k >> i & 1 == 0 { low[i] } else { high[i] });
                (0..8).any(|k| is_beyond(Point3::from_array(corner(k))))
            };
            let mut found = None;
            tree.visit(
                |low, high| ball.may_meet(low, high) && reaches_beyond(low, high),
                |k| {
                    budget = budget.saturating_sub(1);
                    let q = place(k as usize);
                    if ball.may_meet(q.at, q.at) && is_beyond(q.at) && self.conflicts(side(&t, &q), &t, &q) {
                        found = Some(vertices[k as usize]);
                    }
                    found.is_none() && budget > 0
                },
            );
            if budget == 0 {
                return report.verdict == Verdict::Violated;
            }
            if let Some(v) = found {
                self.witness(i, v, report);
                last = i;
            }
        }
        true
    }

    /// Points that are no vertex, against the cells they lie in.
    fn left_out(&self, isolated: &Isolated, report: &mut ClaimReport) {
        let mut hidden = 0;
        for &(v, t) in &isolated.held {
            let (corners, q) = (self.corners(t), &self.sites[v as usize]);
            if self.conflicts(side(&corners, q), &corners, q) {
                let file = self.complex.in_file[t as usize];
                report.violated(self.complex.subject, &[v], &[file], || {
                    format!("vertex {v} belongs to no cell, lies in cell {file}, and is inside its sphere")
                });
            } else {
                hidden += 1;
            }
        }
        let others = isolated.outside.len() + isolated.broken.len();
        for (name, count) in [("points_hidden_or_doubled", hidden), ("points_in_no_cell", others)] {
            if count > 0 {
                report.figures.push((name, count as f64));
            }
        }
    }

    fn witness(&self, t: u32, v: u32, report: &mut ClaimReport) {
        let [a, b, c, d] = self.complex.cells[t as usize];
        let file = self.complex.in_file[t as usize];
        report.violated(self.complex.subject, &[a, b, c, d, v], &[file], || {
            format!("vertex {v} is inside the sphere of cell {file} ({a}, {b}, {c}, {d})")
        });
    }
}

/// A ball that holds all places of vertices in conflict with a cell; everything, where rounding leaves it unknown.
struct Ball {
    low: Point3,
    high: Point3,
    radius2: f64,
}

impl Ball {
    /// Around the orthocenter o = a + S / 2D (notation of `check::space::predicates`): q is in conflict only if |q - o|^2 < |a - o|^2 - w_a + w_q.
    fn around([a, b, c, d]: &Corners, heaviest: f64) -> Self {
        type Vector = [Bounded; 3];
        let n = Bounded::of;
        let from = |p: &WeightedPoint| [n(p.at.x) - n(a.at.x), n(p.at.y) - n(a.at.y), n(p.at.z) - n(a.at.z)];
        let dot = |u: &Vector, v: &Vector| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let cross = |u: &Vector, v: &Vector| -> Vector {
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        };
        let (u, v, w) = (from(b), from(c), from(d));
        let lift = |u: &Vector, p: &WeightedPoint| dot(u, u) - (n(p.weight) - n(a.weight));
        let (lu, lv, lw) = (lift(&u, b), lift(&v, c), lift(&w, d));
        let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
        let twice = n(2.0) * dot(&u, &vw);
        let o = [0, 1, 2].map(|k| (lu * vw[k] + lv * wu[k] + lw * uv[k]) / twice);
        let center = [n(a.at.x) + o[0], n(a.at.y) + o[1], n(a.at.z) + o[2]];
        Ball {
            low: Point3::from_array(center.map(|x| x.low())),
            high: Point3::from_array(center.map(|x| x.high())),
            radius2: (dot(&o, &o) - n(a.weight) + n(heaviest)).high(),
        }
    }

    /// False only if the box is outside of the ball. Comparisons with an unknown center are false, which keeps the box; the factor covers the
    /// rounding of eight operations.
    fn may_meet(&self, low: Point3, high: Point3) -> bool {
        let gap = |low: f64, high: f64, from: f64, to: f64| {
            if low > to {
                low - to
            } else if high < from {
                from - high
            } else {
                0.0
            }
        };
        let gaps = [0, 1, 2].map(|k| gap(low[k], high[k], self.low[k], self.high[k]));
        let square = gaps[0] * gaps[0] + gaps[1] * gaps[1] + gaps[2] * gaps[2];
        let outside = square * (1.0 - 1.0 / (1u64 << 40) as f64) > self.radius2;
        !outside
    }
}
