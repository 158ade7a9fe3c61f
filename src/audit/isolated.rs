//! Vertices of the file that belong to no triangle.
//!
//! One that lies in a triangle, its border included, lies strictly inside that triangle's circle, and nothing hides it from the triangle: the
//! mesh left it out, and no claim of empty circles holds. One at the place of a corner is a double of it, on the circle and not
//! inside: told. So is one outside of every triangle: inputs may have such, and meshes of carved regions keep them.

use super::complex::Complex;
use super::exact::orient;
use super::report::ClaimReport;
use super::tree::Tree;
use crate::model::Point2;
use std::cmp::Ordering;

/// The vertices in no triangle, sorted out.
pub(super) struct Isolated {
    /// Vertices in the closure of a triangle, off its corners, ascending, each with one such triangle.
    held: Vec<(u32, u32)>,
    /// How many others there are.
    others: usize,
}

impl Isolated {
    /// Finds them. Time: linear where there are none; else a search for each triangle among them by bounding boxes.
    pub fn of(complex: &Complex<'_>) -> Self {
        let mut used = vec![false; complex.subject.points.len()];
        for v in complex.subject.triangles.iter().flatten() {
            if let Some(used) = used.get_mut(v.index()) {
                *used = true;
            }
        }
        let alone: Vec<u32> = (0u32..).zip(&used).filter(|v| !v.1).map(|v| v.0).collect();
        let usable: Vec<u32> = alone.iter().copied().filter(|&v| complex.point(v).is_finite()).collect();
        let tree = Tree::new(usable.len(), |i| [complex.point(usable[i]); 2]);
        let mut holder: Vec<Option<u32>> = vec![None; usable.len()];
        for t in 0..complex.triangles.len() as u32 {
            let corners @ [a, b, c] = complex.corners(t);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let enter = |from: Point2, to: Point2| from.cmple(high).all() && to.cmpge(low).all();
            tree.visit(enter, |i| {
                let place = &mut holder[i as usize];
                if place.is_none() && holds(corners, complex.point(usable[i as usize])) {
                    *place = Some(t);
                }
                true
            });
        }
        let held: Vec<(u32, u32)> = usable.iter().zip(holder).filter_map(|(&v, t)| Some((v, t?))).collect();
        let others = alone.len() - held.len();
        Isolated { held, others }
    }

    /// Adds what they say about a claim of empty circles.
    pub fn tell(&self, complex: &Complex<'_>, report: &mut ClaimReport) {
        for &(v, t) in &self.held {
            let [a, b, c] = complex.triangles[t as usize];
            let (t, at) = (complex.in_file[t as usize], complex.point(v));
            report.violated(complex.subject, &[v, a, b, c], &[t], || {
                format!(
                    "vertex {v} at ({}, {}) belongs to no triangle and lies in triangle {t} ({a}, {b}, {c})",
                    at.x, at.y
                )
            });
        }
        if self.others > 0 {
            report.figures.push(("vertices_outside", self.others as f64));
        }
    }
}

/// Whether p lies in a counterclockwise triangle or on its border, and is no corner.
fn holds([a, b, c]: [Point2; 3], p: Point2) -> bool {
    let beyond = |u, v| orient(u, v, p) == Ordering::Less;
    ![a, b, c].contains(&p) && !beyond(a, b) && !beyond(b, c) && !beyond(c, a)
}
