//! The conflict zone of a point: the cells that it destroys.

use super::star::{Rim, Scratch};
use super::store::{Cell, Regular3};
use crate::arith::space::Kernel3;
use crate::model::{Sign, WeightedPoint};

/// The cell belongs to the zone.
const INSIDE: u8 = 1;
/// The cell was tested and does not.
const OUTSIDE: u8 = 2;

impl<K: Kernel3> Regular3<K> {
    /// Whether q destroys the cell. The place of q differs from those of its vertices, or its weight does.
    #[inline(always)]
    pub(super) fn in_conflict(&self, cell: &Cell, q: WeightedPoint) -> bool {
        if cell.is_ghost() { self.in_conflict_with_ghost(cell, q) } else { K::in_conflict3(self.corners(cell), q) }
    }

    /// The same for a ghost: strictly beyond its facet, or on the facet's plane and in conflict with the cell behind, whose sphere meets the
    /// plane in the facet's circle, and whose perturbation is the plane's there.
    #[inline(never)]
    fn in_conflict_with_ghost(&self, cell: &Cell, q: WeightedPoint) -> bool {
        let [a, b, c] = [0, 1, 2].map(|k| self.site(cell.v[k]).at);
        match K::orient3d(a, b, c, q.at) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => {
                let behind = &self.cells[(cell.n[3] >> 2) as usize];
                K::in_conflict3(self.corners(behind), q)
            }
        }
    }

    /// Collects the conflict zone of q from a cell of it, breadth first, and the zone's boundary. Each cell is tested once.
    pub(super) fn flood(&mut self, root: u32, q: WeightedPoint, s: &mut Scratch) {
        s.zone.clear();
        s.rim.clear();
        s.has_ghosts = false;
        s.zone.push(root);
        self.marks[root as usize] = INSIDE;
        let mut next = 0;
        while let Some(&c) = s.zone.get(next) {
            next += 1;
            let cell = self.cells[c as usize];
            s.has_ghosts |= cell.is_ghost();
            for i in 0..4 {
                let link = cell.n[i];
                let beyond = (link >> 2) as usize;
                match self.marks[beyond] {
                    INSIDE => continue,
                    OUTSIDE => {}
                    _ => {
                        if self.in_conflict(&self.cells[beyond], q) {
                            self.marks[beyond] = INSIDE;
                            s.zone.push(link >> 2);
                            continue;
                        }
                        self.marks[beyond] = OUTSIDE;
                    }
                }
                let v = super::store::FACET[i].map(|k| cell.v[k]);
                s.rim.push(Rim { v, outer: link });
            }
        }
    }
}
