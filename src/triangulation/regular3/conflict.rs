//! The conflict zone of a point: the cells that it destroys.

use super::star::{Rim, Scratch};
use super::store::{Cell, Regular3};
use crate::arith::space::Kernel3;
use crate::arith::space::perturb3::cospherical_in_conflict;
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

    /// Collects the conflict zone of q from a cell of it, and the zone's boundary. Each cell is tested once.
    ///
    /// The flood goes by rings: the neighbors of one ring of the zone are collected, tested all together, and those in conflict are the next
    /// ring. Tests in a row hide each other's latency, and no branch waits for one.
    #[inline(never)]
    pub(super) fn flood(&mut self, root: u32, q: WeightedPoint, s: &mut Scratch) {
        s.zone.clear();
        s.zone.push(root);
        self.marks[root as usize] = INSIDE;
        let mut ring = 0;
        while ring < s.zone.len() {
            let end = s.zone.len();
            self.collect_candidates(&s.zone[ring..], &mut s.candidates);
            self.test_candidates(q, s);
            ring = end;
        }
        self.collect_rim(s);
    }

    /// The cells beyond the facets of a ring that were not met before; marks them as met.
    #[inline]
    fn collect_candidates(&mut self, ring: &[u32], candidates: &mut Vec<u32>) {
        candidates.resize(4 * ring.len(), 0);
        let mut count = 0;
        for &c in ring {
            for link in self.cells[c as usize].n {
                let mark = &mut self.marks[(link >> 2) as usize];
                candidates[count] = link >> 2;
                count += usize::from(*mark == 0);
                // A mark of the zone stays beside this one.
                *mark |= OUTSIDE;
            }
        }
        candidates.truncate(count);
    }

    /// Tests the candidates; those in conflict join the zone.
    #[inline]
    fn test_candidates(&mut self, q: WeightedPoint, s: &mut Scratch) {
        let Scratch { zone, candidates, undecided, .. } = s;
        let exact_below = self.exact_below;
        undecided.clear();
        let mut count = zone.len();
        zone.resize(count + candidates.len(), 0);
        for &c in candidates.iter() {
            let (value, bound) = K::power_side_estimate(self.corners(&self.cells[c as usize]), q, exact_below);
            zone[count] = c;
            let inside = value > bound;
            count += usize::from(inside);
            self.marks[c as usize] |= u8::from(inside);
            // One branch, hardly ever taken; taken for NaN.
            let is_certain = value.abs() > bound;
            if !is_certain {
                undecided.push((c, bound == 0.0));
            }
        }
        zone.truncate(count);
        for &(c, is_tie) in undecided.iter() {
            let cell = &self.cells[c as usize];
            let inside = if is_tie {
                cospherical_in_conflict::<K>(self.corners(cell).map(|p| p.at), q.at)
            } else {
                self.in_conflict(cell, q)
            };
            if inside {
                self.marks[c as usize] |= INSIDE;
                zone.push(c);
            }
        }
    }

    /// The facets between the zone and the cells around it.
    #[inline]
    fn collect_rim(&self, s: &mut Scratch) {
        let Scratch { zone, rim, .. } = s;
        s.has_ghosts = false;
        rim.resize(4 * zone.len(), Rim { v: [0; 3], outer: 0 });
        let mut count = 0;
        for &c in zone.iter() {
            let cell = self.cells[c as usize];
            s.has_ghosts |= cell.is_ghost();
            for i in 0..4 {
                rim[count] = Rim { v: super::store::FACET[i].map(|k| cell.v[k]), outer: cell.n[i] };
                count += usize::from(self.marks[(cell.n[i] >> 2) as usize] & INSIDE == 0);
            }
        }
        rim.truncate(count);
    }
}
