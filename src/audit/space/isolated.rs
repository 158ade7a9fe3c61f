//! Points of the file that are no vertex of a cell.

use super::border::budget;
use super::complex::{Complex, is_finite};
use crate::audit::tree::Tree;
use crate::check::space::glue::FACETS;
use crate::check::space::predicates::orient;
use crate::model::{Point3, Sign};

/// The points in no cell's corners, sorted out.
#[derive(Default)]
pub(super) struct Isolated {
    /// In the closure of a cell: ascending, each with one such cell.
    pub held: Vec<(u32, u32)>,
    /// In no cell.
    pub outside: Vec<u32>,
    /// Not finite.
    pub broken: Vec<u32>,
    /// Whether the search ended early: some of those outside may be held.
    pub is_partial: bool,
}

impl Isolated {
    /// Finds them, given which vertices proper cells have. Time: linear where there are none; else a search for each cell among them by bounding boxes.
    pub fn of(complex: &Complex<'_>, mut used: Vec<bool>) -> Self {
        // What is in cells that are not proper is not alone.
        if complex.cells.len() < complex.subject.cells.len() {
            used.resize(complex.sites.len(), false);
            for v in complex.subject.cells.iter().flatten() {
                if let Some(used) = used.get_mut(v.index()) {
                    *used = true;
                }
            }
        }
        let alone = (0u32..).zip(&used).filter(|v| !v.1).map(|v| v.0);
        let (usable, broken): (Vec<u32>, Vec<u32>) = alone.partition(|&v| is_finite(complex.subject, v));
        let mut is_partial = false;
        let mut holder: Vec<Option<u32>> = vec![None; usable.len()];
        if !usable.is_empty() {
            let mut budget = budget(complex.cells.len() + usable.len());
            let tree = Tree::new(usable.len(), |i| [complex.at(usable[i]); 2]);
            for t in 0..complex.cells.len() as u32 {
                let corners @ [a, b, c, d] = complex.corners(t).map(|p| p.at);
                let (low, high) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
                let enter = |from: Point3, to: Point3| from.cmple(high).all() && to.cmpge(low).all();
                tree.visit(enter, |i| {
                    let place = &mut holder[i as usize];
                    if place.is_none() && holds(&corners, complex.at(usable[i as usize])) {
                        *place = Some(t);
                    }
                    budget = budget.saturating_sub(1);
                    budget > 0
                });
                is_partial = budget == 0;
                if is_partial {
                    break;
                }
            }
        }
        let mut isolated = Isolated { broken, is_partial, ..Isolated::default() };
        for (&v, holder) in usable.iter().zip(holder) {
            match holder {
                Some(t) => isolated.held.push((v, t)),
                None => isolated.outside.push(v),
            }
        }
        isolated
    }
}

/// Whether p lies in a positive cell or on its border.
fn holds(corners: &[Point3; 4], p: Point3) -> bool {
    FACETS.iter().all(|f| {
        let [a, b, c] = f.map(|k| corners[k]);
        orient(a, b, c, p) != Sign::Negative
    })
}
