//! The global part of `valid`: the border of the complex is embedded and has the cells on one side only.
//!
//! The cells are positive and no oriented facet belongs to two of them. Facets of one cell alone make the *border*, oriented as seen from that
//! cell. The number of cells that cover a point off all facets is the winding number of the border around it, since facets of two cells cancel;
//! and the border is closed: each of its edges is passed as often one way as the other.
//!
//! **Lemma.** If no point is covered by the interiors of two cells, and no point of two border facets lies off their common corners and edges, then any two
//! cells meet in a common face. Proof: let x lie in two cells, inside their faces s and t (as sets of vertices). If all facets around s were
//! shared, the cells around s would fill a neighborhood of x, and so would hold the interior of the other cell near x. So s is in a border facet, t likewise; these
//! meet in x, hence in a common face that holds x inside: s = t. What two cells share is convex and thus one face. (Two vertices at one place
//! are two faces, and so excluded.)
//!
//! **Star-shaped borders**, in linear time. Let a point o lie strictly inside of all border facets' planes. Seen from o, the facets cover each direction the same
//! number of times, since they all turn the same way and the border is closed; one ray counts: k. If k = 1, every point is covered at most once.
//! And facets meet properly: if x lay inside faces s and t of two of them, the facets around each would cover a neighborhood of the direction of x, some of it twice. A
//! convex region passes this test, unless it is so thin that no double is found inside of it.
//!
//! **Other borders.** (1) Facets whose boxes overlap are tested against each other, found by a tree. (2) Around each edge, facets are passed alternately in and
//! out (with two facets they are). Then all facets connected through edges have the same winding numbers on their two sides. (3) For each such component
//! a ray from one facet counts them: 1 inside, 0 outside. As every part of space has a border facet, no point is covered twice.

use super::complex::Complex;
use super::meet::{Triangle, crossing, heads_in, improperly};
use super::report::{Claim, ClaimReport};
use crate::audit::figures::Classes;
use crate::audit::report::{LISTED_WITNESSES, Verdict};
use crate::audit::tree::Tree;
use crate::check::space::predicates::orient;
use crate::model::{Point3, Sign};
use std::cmp::Ordering;

/// How many items a search may look at for so many others; real meshes need about fifteen each. Beyond, a claim is not examined: time stays linear.
pub(super) fn budget(items: usize) -> usize {
    const EACH: usize = 500;
    const AT_LEAST: usize = 10_000_000;
    AT_LEAST + EACH * items
}

/// Violations after which the examination ends.
const ENOUGH: u64 = 10 * LISTED_WITNESSES as u64;

/// The facets of one cell alone.
pub(super) struct Border<'a> {
    complex: &'a Complex<'a>,
    /// Their slots.
    pub slots: Vec<u32>,
    /// Their corners, counterclockwise as seen from their cells.
    pub facets: Vec<[u32; 3]>,
    /// Edges as `3 f + k`, from corner k of facet f to the next, by their ends (smaller first).
    edges: Vec<(u64, u32)>,
    /// Whether `valid` holds.
    pub is_embedded: bool,
    /// Whether it surrounds a convex region; false also where `valid` was not shown.
    pub is_convex: bool,
}

impl<'a> Border<'a> {
    /// Examines the border, of these slots, of a complex that is valid as far as it is local.
    pub fn examine(complex: &'a Complex<'a>, slots: Vec<u32>, valid: &mut ClaimReport) -> Self {
        let facets: Vec<[u32; 3]> = slots.iter().map(|&s| complex.facet(s)).collect();
        let edges = sorted_edges(&facets, complex.sites.len());
        let mut border = Border { complex, slots, facets, edges, is_embedded: false, is_convex: false };
        let is_star_shaped = border.is_star_shaped();
        if !is_star_shaped {
            border.embedded(valid);
        }
        border.is_embedded = valid.verdict == Verdict::Holds;
        // Connected, closed and convex at each edge, hence at each vertex: convex (Tietze, Nakajima). Seen from inside a star-shaped border, a second
        // component, or a second pair of facets at an edge, would cover directions twice.
        let is_one_sheet = || border.edges().all(|edge| edge.len() == 2) && border.components().1 == 1;
        debug_assert!(!is_star_shaped || is_one_sheet(), "directions are covered twice");
        border.is_convex = border.is_embedded && (is_star_shaped || is_one_sheet()) && border.reflex().next().is_none();
        border
    }

    fn triangle(&self, f: u32) -> Triangle {
        self.facets[f as usize].map(|v| self.complex.at(v))
    }

    /// The edges of facets at each edge.
    fn edges(&self) -> impl Iterator<Item = &[(u64, u32)]> {
        self.edges.chunk_by(|a, b| a.0 == b.0)
    }

    /// From where to where the edge of a facet leads, and the corner across.
    fn ends(&self, edge: u32) -> [u32; 3] {
        let facet = self.facets[(edge / 3) as usize];
        let k = (edge % 3) as usize;
        [facet[k], facet[(k + 1) % 3], facet[(k + 2) % 3]]
    }

    /// Edges of two facets where the region is not convex: those two edges of facets.
    pub fn reflex(&self) -> impl Iterator<Item = [u32; 2]> {
        self.edges().filter_map(|edge| {
            let &[(_, s), (_, t)] = edge else {
                return None;
            };
            let ([a, b, c], [_, _, q]) = (self.ends(s).map(|v| self.complex.at(v)), self.ends(t));
            (orient(a, b, c, self.complex.at(q)) == Sign::Negative).then_some([s, t])
        })
    }

    /// The vertices of a reflex edge and its two facets, and their cells in the file.
    pub fn around(&self, [s, t]: [u32; 2]) -> ([u32; 4], [u32; 2]) {
        let ([u, v, p], [_, _, q]) = (self.ends(s), self.ends(t));
        ([u, v, p, q], [s, t].map(|e| self.cell(e / 3)))
    }

    /// Edges of more than two facets.
    pub fn branching_edges(&self) -> usize {
        self.edges().filter(|edge| edge.len() > 2).count()
    }

    /// Distinct edges.
    pub fn edge_count(&self) -> usize {
        self.edges().count()
    }

    fn cell(&self, f: u32) -> u32 {
        self.complex.cell_in_file(self.slots[f as usize])
    }

    /// Facets connected through edges: classes and their number.
    pub fn components(&self) -> (Classes, usize) {
        let mut classes = Classes::new(self.facets.len());
        let mut count = self.facets.len();
        for edge in self.edges() {
            for pair in edge.windows(2) {
                count -= usize::from(classes.join(pair[0].1 / 3, pair[1].1 / 3));
            }
        }
        (classes, count)
    }

    /// The test for star-shaped borders, from the mean of the border's corners.
    fn is_star_shaped(&self) -> bool {
        let sum = self.facets.iter().flatten().fold(Point3::ZERO, |sum, &v| sum + self.complex.at(v));
        let o = sum / (3 * self.facets.len()).max(1) as f64;
        let mut covers = 0;
        for f in 0..self.facets.len() as u32 {
            let t @ [a, b, c] = self.triangle(f);
            if orient(a, b, c, o) != Sign::Positive {
                return false;
            }
            covers += crossing(&[o; 3], &t);
        }
        covers == 1
    }

    /// The test for other borders.
    fn embedded(&self, report: &mut ClaimReport) {
        let tree = Tree::new(self.facets.len(), |f| {
            let [a, b, c] = self.triangle(f as u32);
            [a.min(b).min(c), a.max(b).max(c)]
        });
        if !self.facets_meet_properly(&tree, report) {
            *report = ClaimReport::unchecked(Claim::Valid, "too many facets of the border are close to each other");
        }
        if report.verdict == Verdict::Holds {
            self.alternates_around_edges(report);
        }
        if report.verdict == Verdict::Holds && !self.has_cells_on_one_side(&tree, report) {
            *report = ClaimReport::unchecked(Claim::Valid, "too many parts of the border stand in one line");
        }
    }

    /// Step 1; false if there are too many pairs to be tested.
    fn facets_meet_properly(&self, tree: &Tree<Point3>, report: &mut ClaimReport) -> bool {
        let mut budget = budget(self.facets.len());
        for f in 0..self.facets.len() as u32 {
            let t @ [a, b, c] = self.triangle(f);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let overlap = |from: Point3, to: Point3| from.cmple(high).all() && to.cmpge(low).all();
            tree.visit(overlap, |g| {
                budget = budget.saturating_sub(1);
                if g > f
                    && self.common_corners(f, g).len() < 3
                    && improperly(&t, &self.triangle(g), &self.common_corners(f, g))
                {
                    self.overlap(f, g, report);
                }
                budget > 0 && report.violations < ENOUGH
            });
            if budget == 0 || report.violations >= ENOUGH {
                break;
            }
        }
        budget > 0 || report.verdict == Verdict::Violated
    }

    fn common_corners(&self, f: u32, g: u32) -> Vec<(usize, usize)> {
        let (s, t) = (self.facets[f as usize], self.facets[g as usize]);
        (0..3).filter_map(|i| Some((i, t.iter().position(|&v| v == s[i])?))).collect()
    }

    fn overlap(&self, f: u32, g: u32, report: &mut ClaimReport) {
        let (s, t) = (self.facets[f as usize], self.facets[g as usize]);
        let mut vertices = s.to_vec();
        vertices.extend(t.iter().filter(|v| !s.contains(v)));
        let cells = [self.cell(f), self.cell(g)];
        report.violated(self.complex.subject, &vertices, &cells, || {
            let [c, d] = cells;
            format!("facets {s:?} of cell {c} and {t:?} of cell {d} meet off their common corners and edges")
        });
    }

    /// Step 2.
    fn alternates_around_edges(&self, report: &mut ClaimReport) {
        for edge in self.edges().filter(|edge| edge.len() > 2) {
            let [u, v, first] = self.ends(edge[0].1);
            let at = |w: u32| self.complex.at(w);
            let side = |p: u32, q: u32| orient(at(u), at(v), at(p), at(q));
            // A quarter of the way around, from the first facet; the facets differ in direction.
            let quarter = |p: u32| match side(first, p) {
                _ if p == first => 0,
                Sign::Positive => 1,
                Sign::Zero => 2,
                Sign::Negative => 3,
            };
            let mut around: Vec<[u32; 3]> = edge.iter().map(|e| self.ends(e.1)).collect();
            around.sort_by(|&[.., p], &[.., q]| {
                let turn = match side(p, q) {
                    Sign::Positive => Ordering::Less,
                    Sign::Negative => Ordering::Greater,
                    Sign::Zero => Ordering::Equal,
                };
                quarter(p).cmp(&quarter(q)).then(turn)
            });
            let next = around.iter().skip(1).chain(around.first());
            if around.iter().zip(next).any(|(a, b)| a[0] == b[0]) {
                let mut cells: Vec<u32> = edge.iter().map(|e| self.cell(e.1 / 3)).collect();
                cells.sort_unstable();
                report.violated(self.complex.subject, &[u, v], &cells, || {
                    format!("cells {cells:?} overlap around edge {u}-{v}")
                });
            }
        }
    }

    /// Step 3; false if there are too many facets to be looked at.
    fn has_cells_on_one_side(&self, tree: &Tree<Point3>, report: &mut ClaimReport) -> bool {
        let (mut classes, _) = self.components();
        let mut budget = budget(self.facets.len());
        // Rays go along the shortest side of the box around all, where the least is in their way: that axis becomes the first.
        let all = self.facets.iter().flatten().map(|&v| self.complex.at(v));
        let none = (Point3::INFINITY, Point3::NEG_INFINITY);
        let (low, high) = all.fold(none, |(low, high), p| (low.min(p), high.max(p)));
        let axis = (high - low).min_position();
        let turned = |p: Point3| Point3::from_array([0, 1, 2].map(|k| p[(k + axis) % 3]));
        for f in 0..self.facets.len() as u32 {
            if classes.find(f) != f {
                continue;
            }
            let t @ [a, b, c] = self.triangle(f).map(turned);
            // Coordinates are at most 1; the mean is off by less than 2^-50.
            let (mean, slack) = ((a + b + c) / 3.0, 4.0 * f64::EPSILON);
            let ahead = |low: Point3, high: Point3| {
                let (low, high) = (turned(low), turned(high));
                let across = |low: f64, high: f64, x: f64| low <= x + slack && high >= x - slack;
                high.x >= mean.x - slack && across(low.y, high.y, mean.y) && across(low.z, high.z, mean.z)
            };
            let mut winding = 0;
            tree.visit(ahead, |g| {
                winding += if g == f { 0 } else { crossing(&t, &self.triangle(g).map(turned)) };
                budget = budget.saturating_sub(1);
                budget > 0
            });
            if budget == 0 {
                return report.verdict == Verdict::Violated;
            }
            // The ray starts on one side of the facet; behind its cell's side the number is one less.
            let inside = if heads_in(&t) { winding } else { winding + 1 };
            if inside != 1 {
                let (facet, cell) = (self.facets[f as usize], self.cell(f));
                report.violated(self.complex.subject, &facet, &[cell], || match inside {
                    2.. => format!(
                        "cells overlap: {inside} of them cover the same points beside facet {facet:?} of cell {cell}"
                    ),
                    _ => format!(
                        "cells overlap: facet {facet:?} of cell {cell} turns the wrong way in what surrounds it"
                    ),
                });
            }
        }
        true
    }
}

/// The edges of facets as `Border` has them: distributed by their smaller ends, which leaves few of each to be sorted.
fn sorted_edges(facets: &[[u32; 3]], vertices: usize) -> Vec<(u64, u32)> {
    let all = || {
        (0u32..).zip(facets).flat_map(|(f, &[a, b, c])| {
            let edge = |k: u32, u: u32, v: u32| (u64::from(u.min(v)) << 32 | u64::from(u.max(v)), 3 * f + k);
            [edge(0, a, b), edge(1, b, c), edge(2, c, a)]
        })
    };
    let smaller = |edge: &(u64, u32)| (edge.0 >> 32) as usize;
    let mut places = vec![0u32; vertices + 1];
    all().for_each(|edge| places[smaller(&edge) + 1] += 1);
    for v in 0..vertices {
        places[v + 1] += places[v];
    }
    let mut edges = vec![(0, 0); 3 * facets.len()];
    for edge in all() {
        let place = &mut places[smaller(&edge)];
        edges[*place as usize] = edge;
        *place += 1;
    }
    edges.chunk_by_mut(|a, b| smaller(a) == smaller(b)).for_each(|same| same.sort_unstable());
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_sorted() {
        let mut state = 1u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32 % 40
        };
        let facets: Vec<[u32; 3]> = (0..500).map(|_| [draw(), 50 + draw(), 99 - draw() % 5]).collect();
        let facets: Vec<[u32; 3]> =
            facets.iter().map(|&[a, b, c]| if a % 2 == 0 { [c, a, b] } else { [c, b, a] }).collect();
        let mut plain = Vec::new();
        for (f, facet) in (0u32..).zip(&facets) {
            for k in 0..3 {
                let (u, v) = (facet[k], facet[(k + 1) % 3]);
                plain.push((u64::from(u.min(v)) << 32 | u64::from(u.max(v)), 3 * f + k as u32));
            }
        }
        plain.sort_unstable();
        assert_eq!(sorted_edges(&facets, 100), plain);
        assert_eq!(sorted_edges(&[], 0), []);
    }
}
