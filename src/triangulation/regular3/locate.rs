//! Point location: a walk from cell to cell.
//!
//! The walk crosses a facet only if the point lies strictly beyond it. In a regular triangulation, ties broken by one perturbation or not,
//! such a walk visits no cell twice: the power of the point with respect to the orthoball falls from cell to cell (Edelsbrunner 1990).

use super::store::{CellId, FACET, Regular3};
use crate::arith::space::Kernel3;
use crate::model::{Point3, Sign};

/// Where a walk has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// A finite cell that contains the point, or a ghost beyond whose facet it strictly lies.
    pub(super) cell: u32,
    /// Whether the point may lie on the boundary of the cell. Only then it may be one of its vertices.
    pub(super) touches: bool,
}

impl<K: Kernel3> Regular3<K> {
    /// A finite cell that contains q, or a ghost beyond whose facet q strictly lies; `None` without points.
    pub fn locate(&self, q: Point3) -> Option<CellId> {
        (!self.cells.is_empty()).then(|| CellId(self.walk(self.last, q).cell))
    }

    /// The walk to q from cell `start`.
    pub(super) fn walk(&self, start: u32, q: Point3) -> Found {
        let mut at = start;
        let mut cell = &self.cells[at as usize];
        if cell.is_ghost() {
            at = cell.n[3] >> 2;
            cell = &self.cells[at as usize];
        }
        // The facet through which the walk came needs no test; at first there is none.
        let mut entry = 4;
        loop {
            let mut touches = false;
            let mut exit = None;
            for (i, facet) in FACET.iter().enumerate() {
                if i == entry {
                    continue;
                }
                let [a, b, c] = facet.map(|k| self.sites[cell.v[k] as usize].0.at);
                match K::orient3d(a, b, c, q) {
                    Sign::Positive => {}
                    Sign::Zero => touches = true,
                    Sign::Negative => {
                        exit = Some(cell.n[i]);
                        break;
                    }
                }
            }
            let Some(link) = exit else {
                return Found { cell: at, touches };
            };
            at = link >> 2;
            entry = (link & 3) as usize;
            cell = &self.cells[at as usize];
            if cell.is_ghost() {
                return Found { cell: at, touches: false };
            }
        }
    }

    /// The vertex of a finite cell that has the place of q.
    pub(super) fn corner_at(&self, cell: u32, q: Point3) -> Option<u32> {
        self.cells[cell as usize].v.into_iter().find(|&v| self.site(v).at == q)
    }
}
