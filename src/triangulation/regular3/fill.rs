//! A hole in the complex is filled with the cells of the triangulation that remains.
//!
//! Only vertices on the boundary of the hole can be corners of the new cells. Two ways, by the number of vertices: wrapping up to 255, where both cost about
//! the same.
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

use super::numbers::{MOST, Numbers};
use super::star::Rim;
use super::store::{Cell, FACET, INF, Regular3};
use crate::arith::space::Kernel3;
use crate::model::WeightedPoint;

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

/// A facet with a cell on one side as yet, its vertices by their numbers.
struct Open {
    /// The numbers in ascending order.
    key: [u8; 3],
    /// Seen from the side that has no cell.
    v: [u8; 3],
    /// The cell on the other side, as a link.
    outer: u32,
}

/// The number of the infinite vertex.
const INFINITE: u8 = 0;

/// What is open of a hole: a sphere of facets, or several.
///
/// A vertex without open facets has all its cells.
struct Hole {
    open: Vec<Open>,
    /// Per number the vertex.
    places: Vec<u32>,
    /// Per number how many open facets the vertex has.
    facets: Vec<u32>,
}

impl Hole {
    /// The hole with the given boundary; `None` if it has too many vertices.
    fn new(rim: &[Rim], numbers: &mut Numbers) -> Option<Hole> {
        let mut hole = Hole { open: Vec::with_capacity(2 * rim.len()), places: Vec::new(), facets: vec![0; MOST] };
        numbers.of(INF)?;
        for facet in rim {
            let [a, b, c] = facet.v.map(|v| numbers.of(v));
            hole.add([a? as u8, b? as u8, c? as u8], facet.outer);
        }
        hole.places.extend(numbers.vertices());
        Some(hole)
    }

    fn add(&mut self, v: [u8; 3], outer: u32) {
        v.iter().for_each(|&v| self.facets[usize::from(v)] += 1);
        let mut key = v;
        key.sort_unstable();
        self.open.push(Open { key, v, outer });
    }

    fn take(&mut self, k: usize) -> Open {
        let facet = self.open.swap_remove(k);
        facet.v.iter().for_each(|&v| self.facets[usize::from(v)] -= 1);
        facet
    }

    /// Takes a facet that is not at infinity. Those that are get their cells from their finite neighbors.
    fn take_finite(&mut self) -> Option<Open> {
        self.open.iter().rposition(|o| o.key[0] != INFINITE).map(|k| self.take(k))
    }

    /// Takes the open facet with these vertices, if there is one.
    fn take_same(&mut self, mut v: [u8; 3]) -> Option<Open> {
        v.sort_unstable();
        self.open.iter().position(|o| o.key == v).map(|k| self.take(k))
    }
}

impl<K: Kernel3> Regular3<K> {
    /// Fills the hole that `rim` bounds; `hole` are the slots of its former cells. Returns the slots of the new cells.
    pub(super) fn fill(&mut self, rim: &[Rim], hole: Vec<u32>) -> Vec<u32> {
        let mut slots = Slots { spare: hole, made: Vec::new() };
        let mut s = self.scratch.take().unwrap_or_default();
        self.reserve_numbers(&mut s);
        match Hole::new(rim, &mut s.numbers) {
            Some(hole) => self.wrap(hole, &mut slots),
            None => self.fill_from_subset(rim, &mut slots),
        }
        s.numbers.clear();
        self.scratch = Some(s);
        let Slots { spare, made } = slots;
        spare.into_iter().for_each(|c| self.release_slot(c));
        made
    }

    fn wrap(&mut self, mut hole: Hole, slots: &mut Slots) {
        while let Some(Open { v: [a, b, c], outer, .. }) = hole.take_finite() {
            let corners = [a, b, c, self.corner_over([a, b, c], &hole)];
            let t = slots.take(self);
            self.cells[t as usize].v = corners.map(|k| hole.places[usize::from(k)]);
            self.link(4 * t + 3, outer);
            for (i, facet) in (0u32..3).zip(FACET) {
                let [x, y, z] = facet.map(|k| corners[k]);
                match hole.take_same([x, y, z]) {
                    Some(met) => self.link(4 * t + i, met.outer),
                    None => hole.add([x, z, y], 4 * t + i),
                }
            }
        }
        assert!(hole.open.is_empty(), "a hole whose boundary does not close");
    }

    /// The vertex of the cell over a facet, seen from inside; the infinite one if there is none on that side.
    fn corner_over(&self, facet: [u8; 3], hole: &Hole) -> u8 {
        let [a, b, c] = facet.map(|k| self.site(hole.places[usize::from(k)]));
        let mut best: Option<(u8, WeightedPoint)> = None;
        for ((k, &place), &facets) in (0u8..).zip(&hole.places).zip(&hole.facets).skip(1) {
            if facets == 0 || facet.contains(&k) {
                continue;
            }
            let p = self.site(place);
            if K::orient3d(a.at, b.at, c.at, p.at).is_positive()
                && best.is_none_or(|(_, nearest)| K::in_conflict3([a, b, c, nearest], p))
            {
                best = Some((k, p));
            }
        }
        best.map_or(INFINITE, |(k, _)| k)
    }

    fn fill_from_subset(&mut self, rim: &[Rim], slots: &mut Slots) {
        let mut corners: Vec<u32> = rim.iter().flat_map(|f| f.v).filter(|&v| v != INF).collect();
        corners.sort_unstable();
        corners.dedup();
        let points: Vec<WeightedPoint> = corners.iter().map(|&v| self.site(v)).collect();
        let subset = Regular3::<K>::build(&points, 1);
        let cells = if subset.dimension == Some(3) {
            cells_within(&subset, &corners, rim)
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
        let (pairs, rest) = facets.as_chunks::<2>();
        assert!(rest.is_empty(), "a hole whose boundary does not close");
        for &[(one, f), (other, g)] in pairs {
            assert!(one == other, "a hole whose boundary does not close");
            self.link(f, g);
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
