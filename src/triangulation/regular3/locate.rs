//! Point location: a walk from cell to cell.
//!
//! The walk crosses a facet only if the point lies strictly beyond it. In a regular triangulation, ties broken by one perturbation or not,
//! such a walk visits no cell twice: the power of the point with respect to the orthoball falls from cell to cell (Edelsbrunner 1990).

use super::store::{Cell, CellId, FACET, Regular3};
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

    /// The walk to q from cell `start`. From each cell it goes on beyond the facet that has q behind it and spans the largest tetrahedron with it.
    pub(super) fn walk(&self, start: u32, q: Point3) -> Found {
        let mut at = start;
        let mut cell = &self.cells[at as usize];
        if cell.is_ghost() {
            at = cell.n[3] >> 2;
            cell = &self.cells[at as usize];
        }
        loop {
            let (sides, bound) = K::orient3d_estimates(self.corners(cell).map(|p| p.at), q);
            // The least of the four.
            let (low, i) = if sides[1] < sides[0] { (sides[1], 1) } else { (sides[0], 0) };
            let (high, j) = if sides[3] < sides[2] { (sides[3], 3) } else { (sides[2], 2) };
            let (least, exit) = if high < low { (high, j) } else { (low, i) };
            let link = if least < -bound {
                cell.n[exit]
            } else if least > bound {
                return Found { cell: at, touches: false };
            } else {
                match self.exit_exactly(cell, q) {
                    (Some(exit), _) => cell.n[exit],
                    (None, touches) => return Found { cell: at, touches },
                }
            };
            at = link >> 2;
            cell = &self.cells[at as usize];
            if cell.is_ghost() {
                return Found { cell: at, touches: false };
            }
        }
    }

    /// The first facet of a finite cell beyond which q strictly lies; and whether q lies on the plane of one.
    #[inline(never)]
    fn exit_exactly(&self, cell: &Cell, q: Point3) -> (Option<usize>, bool) {
        let mut touches = false;
        for (i, facet) in FACET.iter().enumerate() {
            let [a, b, c] = facet.map(|k| self.site(cell.v[k]).at);
            match K::orient3d(a, b, c, q) {
                Sign::Positive => {}
                Sign::Zero => touches = true,
                Sign::Negative => return (Some(i), touches),
            }
        }
        (None, touches)
    }

    /// The vertex of a finite cell that has the place of q.
    pub(super) fn corner_at(&self, cell: u32, q: Point3) -> Option<u32> {
        self.cells[cell as usize].v.into_iter().find(|&v| self.site(v).at == q)
    }
}
