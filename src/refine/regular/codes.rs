//! The codes by which events name cells. Source: `docs/trace-format.md`, "Floods" and "Fillings".

use crate::model::{Tetrahedron, VertexId, canonical_tetrahedron};
use crate::trace::Bits;
use std::collections::BTreeMap;

/// No cell beyond a facet, among those in hand.
const NONE: u32 = u32::MAX;

/// Work lists, kept for reuse.
#[derive(Clone, Debug, Default)]
pub(super) struct Floods {
    /// Per facet (4 cell + corner) the one on the other side, or `NONE`.
    beyond: Vec<u32>,
    /// Facets by a hash of their corners.
    table: Vec<u32>,
    listed: Vec<bool>,
    /// Cells in flood order: number, where each member of the tuple stands among the corners, and the member opposite the facet it was entered by.
    queue: Vec<(u32, [u8; 4], u8)>,
}

impl Floods {
    /// The last of the destroyed cells in canonical order, and the code of the others.
    pub(super) fn code(&mut self, destroyed: &[[VertexId; 4]]) -> (Tetrahedron, Bits) {
        self.match_facets(destroyed);
        let tuples = destroyed.iter().map(|c| canonical_tetrahedron(*c)).zip(0u32..);
        // An insertion destroys a cell at least.
        let (first, number) = tuples.max().unwrap_or_default();
        let order = first.map(|v| destroyed[number as usize].iter().position(|w| *w == v).unwrap_or(0) as u8);
        self.listed.clear();
        self.listed.resize(destroyed.len(), false);
        self.listed[number as usize] = true;
        self.queue.clear();
        self.queue.push((number, order, 4));
        let mut bits = Bits::default();
        let mut next = 0;
        while let Some(&(cell, order, entry)) = self.queue.get(next) {
            next += 1;
            for position in (0..4).filter(|&p| p != usize::from(entry)) {
                let through = self.beyond[4 * cell as usize + usize::from(order[position])];
                if through == NONE {
                    bits.push(false);
                    continue;
                }
                let other = through >> 2;
                if self.listed[other as usize] {
                    continue;
                }
                bits.push(true);
                self.listed[other as usize] = true;
                let mut own = [(through & 3) as u8; 4];
                for p in (0..4).filter(|&p| p != position) {
                    let v = destroyed[cell as usize][usize::from(order[p])];
                    own[p] = destroyed[other as usize].iter().position(|w| *w == v).unwrap_or(0) as u8;
                }
                self.queue.push((other, own, position as u8));
            }
        }
        (first, bits)
    }

    /// Finds the pairs among the facets of some cells.
    fn match_facets(&mut self, cells: &[[VertexId; 4]]) {
        let size = (8 * cells.len()).next_power_of_two();
        self.table.clear();
        self.table.resize(size, NONE);
        self.beyond.clear();
        self.beyond.resize(4 * cells.len(), NONE);
        for (c, cell) in (0u32..).zip(cells) {
            for k in 0..4 {
                let facet = others(cell, k as usize);
                let mut at = hash(facet) & (size - 1);
                loop {
                    let there = self.table[at];
                    if there == NONE {
                        self.table[at] = 4 * c + k;
                        break;
                    }
                    let other = others(&cells[(there >> 2) as usize], (there & 3) as usize);
                    if facet.iter().all(|v| other.contains(v)) {
                        self.beyond[(4 * c + k) as usize] = there;
                        self.beyond[there as usize] = 4 * c + k;
                        break;
                    }
                    at = (at + 1) & (size - 1);
                }
            }
        }
    }
}

fn others(cell: &[VertexId; 4], k: usize) -> [VertexId; 3] {
    [1, 2, 3].map(|step| cell[(k + step) & 3])
}

/// The same for any order of the corners.
fn hash(facet: [VertexId; 3]) -> usize {
    let spread = |v: VertexId| (u64::from(v.0) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let sum = facet.iter().fold(0u64, |sum, v| sum.wrapping_add(spread(*v).rotate_left(23) ^ spread(*v)));
    (sum >> 32) as usize
}

/// The corners opposite each corner of a positive cell, turned such that (facet, corner) is positive.
const FACETS: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// The apexes of the cells that fill the star of v, in the order of the filling. Both lists are positively oriented cells.
pub(super) fn filling(v: VertexId, star: &[[VertexId; 4]], created: &[[VertexId; 4]]) -> Vec<VertexId> {
    let ascending = |mut f: [VertexId; 3]| {
        f.sort_unstable();
        f
    };
    let mut tuples: Vec<Tetrahedron> = star.iter().map(|c| canonical_tetrahedron(*c)).collect();
    tuples.sort_unstable();
    // Open facets in their order; which are open by their corners.
    let mut queue: Vec<[VertexId; 3]> = Vec::new();
    let mut open: BTreeMap<[VertexId; 3], usize> = BTreeMap::new();
    for t in tuples {
        if let Some(k) = t.iter().position(|w| *w == v) {
            let facet = FACETS[k].map(|i| t[i]);
            open.insert(ascending(facet), queue.len());
            queue.push(facet);
        }
    }
    // Each new cell by its facets, as they turn seen from its corners.
    let mut by_facet: BTreeMap<([VertexId; 3], bool), VertexId> = BTreeMap::new();
    for cell in created {
        for (k, f) in FACETS.iter().enumerate() {
            by_facet.insert(turn(f.map(|i| cell[i])), cell[k]);
        }
    }
    let (mut apexes, mut next) = (Vec::new(), 0);
    while let Some(&facet) = queue.get(next) {
        next += 1;
        if open.get(&ascending(facet)) != Some(&(next - 1)) {
            continue;
        }
        open.remove(&ascending(facet));
        // The created cells fill the hole, so that one stands on each open facet.
        let Some(&apex) = by_facet.get(&turn(facet)) else { break };
        apexes.push(apex);
        let [x, y, z] = facet;
        let cell = [x, y, z, apex];
        for f in &FACETS[..3] {
            let [a, b, c] = f.map(|i| cell[i]);
            if open.remove(&ascending([a, b, c])).is_none() {
                open.insert(ascending([a, b, c]), queue.len());
                queue.push([b, a, c]);
            }
        }
    }
    apexes
}

/// The corners of a facet in ascending order, and whether that is an odd permutation.
fn turn(f: [VertexId; 3]) -> ([VertexId; 3], bool) {
    let inversions = [(0, 1), (0, 2), (1, 2)].into_iter().filter(|&(i, j): &(usize, usize)| f[i] > f[j]).count();
    let mut sorted = f;
    sorted.sort_unstable();
    (sorted, inversions % 2 == 1)
}
