//! A hole in the complex is filled with the cells of the triangulation that remains.
//!
//! Only vertices on the boundary of the hole can be corners of the new cells. Two ways, by the number of vertices:
//!
//! **Wrapping.** Over a facet of the boundary there stands one cell of the unique triangulation. Of the vertices strictly on its inner side it has
//! the one that no other one is in conflict with: all cells over one facet are nested in that half-space, as their spheres form a pencil, so
//! one pass finds it. If there is no vertex on that side, the facet is on the hull and has a ghost. Each new cell offers its
//! other facets, or closes open ones:
//!
//! ```text
//!     hole            c                   cell over ab with the vertex c that its circle, of all those on the inner side, holds no other of;
//!      ------------ / \ ------            ac and cb are open from now on, unless they were before: then they meet a cell there
//!                  a---b
//! ```
//!
//! **Subset.** A cell of the whole is a cell of the triangulation of any subset that has its corners, so the triangulation of the boundary's vertices has
//! all the cells wanted; they are found by a flood from the boundary's facets (Devillers and Teillaud do this for small degrees as well, 2011).

use super::star::Rim;
use super::store::{Cell, FACET, INF, Regular3};
use crate::arith::space::Kernel3;
use crate::model::{Sign, WeightedPoint};

/// Up to so many vertices a hole is wrapped: quadratic, but the facts are at hand. Where both cost the same.
const WRAPPED: usize = 48;

/// A facet by its vertices in ascending order.
pub(super) type Key = [u32; 3];

pub(super) fn key(mut v: [u32; 3]) -> Key {
    v.sort_unstable();
    v
}

/// Whether the second triple is an even permutation of the first, which has the same vertices.
fn same_turn(a: [u32; 3], b: [u32; 3]) -> bool {
    b == a || b == [a[1], a[2], a[0]] || b == [a[2], a[0], a[1]]
}

/// A facet with a cell on one side as yet.
struct Open {
    key: Key,
    /// Seen from the side that has no cell.
    rim: Rim,
}

impl<K: Kernel3> Regular3<K> {
    /// Fills the hole that `rim` bounds; `hole` are the slots of its former cells. Returns the slots of the new cells.
    pub(super) fn fill(&mut self, rim: &[Rim], hole: Vec<u32>) -> Vec<u32> {
        let mut corners: Vec<u32> = rim.iter().flat_map(|f| f.v).filter(|&v| v != INF).collect();
        corners.sort_unstable();
        corners.dedup();
        let mut slots = Slots { spare: hole, made: Vec::new() };
        if corners.len() <= WRAPPED {
            self.wrap(rim, &corners, &mut slots)
        } else {
            self.fill_from_subset(rim, &corners, &mut slots)
        }
        let Slots { spare, made } = slots;
        spare.into_iter().for_each(|c| self.release_slot(c));
        made
    }

    fn wrap(&mut self, rim: &[Rim], corners: &[u32], slots: &mut Slots) {
        let mut open: Vec<Open> = rim.iter().map(|&rim| Open { key: key(rim.v), rim }).collect();
        // A facet with the infinite vertex is closed from its finite neighbors.
        while let Some(k) = open.iter().rposition(|o| !o.rim.v.contains(&INF)) {
            let Rim { v: [a, b, c], outer } = open.swap_remove(k).rim;
            let w = self.corner_over([a, b, c], corners);
            let t = slots.take(self);
            self.cells[t as usize].v = [a, b, c, w];
            self.link(4 * t + 3, outer);
            for i in 0..3 {
                let [x, y, z] = FACET[i].map(|k| [a, b, c, w][k]);
                let (key, link) = (key([x, y, z]), 4 * t + i as u32);
                match open.iter().position(|o| o.key == key) {
                    Some(k) => {
                        let met = open.swap_remove(k);
                        self.link(link, met.rim.outer);
                    }
                    None => open.push(Open { key, rim: Rim { v: [x, z, y], outer: link } }),
                }
            }
        }
        debug_assert!(open.is_empty(), "a hole whose boundary does not close");
    }

    /// The vertex of the cell over a facet, seen from inside; the infinite one if there is none on that side.
    fn corner_over(&self, facet: [u32; 3], corners: &[u32]) -> u32 {
        let [a, b, c] = facet.map(|v| self.site(v));
        let mut best: Option<(u32, WeightedPoint)> = None;
        for &w in corners {
            let p = self.site(w);
            if facet.contains(&w) || K::orient3d(a.at, b.at, c.at, p.at) != Sign::Positive {
                continue;
            }
            if best.is_none_or(|(_, nearest)| K::in_conflict3([a, b, c, nearest], p)) {
                best = Some((w, p));
            }
        }
        best.map_or(INF, |(w, _)| w)
    }

    fn fill_from_subset(&mut self, rim: &[Rim], corners: &[u32], slots: &mut Slots) {
        let points: Vec<WeightedPoint> = corners.iter().map(|&v| self.site(v)).collect();
        let subset = Regular3::<K>::build(&points, 1);
        let cells = if subset.dimension == Some(3) {
            cells_within(&subset, corners, rim)
        } else {
            // All vertices lie in one plane: there are but ghosts.
            rim.iter().map(|f| f.v).filter(|v| !v.contains(&INF)).map(|[a, b, c]| [a, b, c, INF]).collect()
        };
        let mut facets: Vec<(Key, u32)> = rim.iter().map(|f| (key(f.v), f.outer)).collect();
        for v in cells {
            let t = slots.take(self);
            self.cells[t as usize].v = v;
            facets.extend((0u32..).zip(FACET).map(|(i, f)| (key(f.map(|k| v[k])), 4 * t + i)));
        }
        facets.sort_unstable();
        for pair in facets.chunks_exact(2) {
            debug_assert!(pair[0].0 == pair[1].0, "a hole whose boundary does not close");
            self.link(pair[0].1, pair[1].1);
        }
    }
}

/// The cells of the subset's triangulation within the boundary, by the places that its ids stand for.
pub(super) fn cells_within<K: Kernel3>(subset: &Regular3<K>, places: &[u32], rim: &[Rim]) -> Vec<[u32; 4]> {
    let place = |v: u32| if v == INF { INF } else { places[subset.ids[v as usize] as usize] };
    let by_places = |cell: &Cell| cell.v.map(place);
    let facet = |v: [u32; 4], i: usize| FACET[i].map(|k| v[k]);
    let mut boundary: Vec<(Key, [u32; 3])> = rim.iter().map(|f| (key(f.v), f.v)).collect();
    boundary.sort_unstable();
    let on_boundary = |k: &Key| boundary.binary_search_by(|(b, _)| b.cmp(k)).ok();
    let mut within = vec![false; subset.cells.len()];
    let mut found = Vec::new();
    for (t, cell) in subset.cells.iter().enumerate().filter(|(_, c)| !c.is_free()) {
        let v = by_places(cell);
        let starts = (0..4).any(|i| {
            let f = facet(v, i);
            on_boundary(&key(f)).is_some_and(|k| same_turn(boundary[k].1, f))
        });
        if starts {
            within[t] = true;
            found.push(t);
        }
    }
    let mut next = 0;
    while let Some(&t) = found.get(next) {
        next += 1;
        let cell = &subset.cells[t];
        let v = by_places(cell);
        for i in 0..4 {
            let beyond = (cell.n[i] >> 2) as usize;
            if !within[beyond] && on_boundary(&key(facet(v, i))).is_none() {
                within[beyond] = true;
                found.push(beyond);
            }
        }
    }
    found.into_iter().map(|t| by_places(&subset.cells[t])).collect()
}

/// Slots to write to: first those of the hole.
struct Slots {
    spare: Vec<u32>,
    made: Vec<u32>,
}

impl Slots {
    fn take<K: Kernel3>(&mut self, triangulation: &mut Regular3<K>) -> u32 {
        let slot = self.spare.pop().unwrap_or_else(|| triangulation.take_slot());
        self.made.push(slot);
        slot
    }
}
