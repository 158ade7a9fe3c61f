//! Hidden points: which cell contains each, and which of them coincide.
//!
//! A hidden point can become a vertex only when a cell that contains it is destroyed by a removal, so it lodges in a cell and moves on when
//! that is destroyed. Lists exist only for cells with lodgers. Coinciding hidden points (same place, same weight) are found by their
//! coordinates, since a point on a facet may lodge on either side of it.

use super::store::{FIRST, NONE, Regular3, Status};
use crate::arith::space::Kernel3;
use crate::model::WeightedPoint;
use std::collections::BTreeMap;

/// The hidden points.
#[derive(Clone, Debug, Default)]
pub(super) struct Lodgers {
    /// Per cell the places of the hidden points that it contains; never empty.
    pub(super) of_cell: BTreeMap<u32, Vec<u32>>,
    /// Per coordinates and weight of a hidden point its place.
    pub(super) by_site: BTreeMap<[u64; 4], u32>,
}

/// The coordinates and weight as a key: equal keys mean equal points, as -0 does not occur.
pub(super) fn key(p: WeightedPoint) -> [u64; 4] {
    [p.at.x, p.at.y, p.at.z, p.weight].map(f64::to_bits)
}

impl<K: Kernel3> Regular3<K> {
    /// Lets a hidden point lodge in the cell that contains it, searched from `start`. It is a vertex no more.
    pub(super) fn lodge(&mut self, place: u32, start: u32) {
        let found = self.walk(start, self.site(place).at);
        self.status[place as usize] = Status::Hidden;
        self.hints[place as usize] = found.cell;
        self.lodgers.of_cell.entry(found.cell).or_default().push(place);
        self.lodgers.by_site.insert(key(self.site(place)), place);
    }

    /// The places without a hint, which are those of hidden points if vertices have theirs.
    pub(super) fn homeless(&self) -> Vec<u32> {
        (FIRST..self.sites.len() as u32).filter(|&place| self.hints[place as usize] == NONE).collect()
    }

    /// The cells that contain the points of these places, each searched from the one before.
    pub(super) fn cells_of(&self, places: &[u32]) -> Vec<u32> {
        let from = |last: &mut u32, &place: &u32| {
            *last = self.walk(*last, self.site(place).at).cell;
            Some(*last)
        };
        places.iter().scan(self.last, from).collect()
    }

    /// Lets hidden points, the first ones, lodge in the cells that contain them. Of coinciding ones the first lodges and the others are its duplicates.
    pub(super) fn lodge_together(&mut self, places: &[u32], cells: &[u32]) {
        let by_site = places.iter().zip(cells).map(|(&place, &cell)| (key(self.site(place)), place, cell));
        let mut by_site: Vec<_> = by_site.collect();
        by_site.sort_unstable();
        let (mut of_site, mut of_cell) = (Vec::new(), Vec::new());
        for same in by_site.chunk_by(|a, b| a.0 == b.0) {
            let (site, place, cell) = same[0];
            of_site.push((site, place));
            of_cell.push((cell, place));
            self.status[place as usize] = Status::Hidden;
            self.hints[place as usize] = cell;
            same[1..].iter().for_each(|&(_, twin, _)| self.make_twin(twin, place));
        }
        of_cell.sort_unstable();
        let lists = of_cell.chunk_by(|a, b| a.0 == b.0).map(|same| (same[0].0, same.iter().map(|e| e.1).collect()));
        // Collected from ascending keys, a map is built at once.
        self.lodgers = Lodgers { of_cell: lists.collect(), by_site: of_site.into_iter().collect() };
    }

    /// The lodgers of a cell, which leave it.
    pub(super) fn evict(&mut self, cell: u32) -> Vec<u32> {
        let gone = self.lodgers.of_cell.remove(&cell).unwrap_or_default();
        for &place in &gone {
            self.hints[place as usize] = NONE;
            self.lodgers.by_site.remove(&key(self.site(place)));
        }
        gone
    }

    /// A hidden point leaves its cell.
    pub(super) fn move_out(&mut self, place: u32) {
        let cell = self.hints[place as usize];
        if let Some(all) = self.lodgers.of_cell.get_mut(&cell) {
            all.retain(|&p| p != place);
            if all.is_empty() {
                self.lodgers.of_cell.remove(&cell);
            }
        }
        self.hints[place as usize] = NONE;
        self.lodgers.by_site.remove(&key(self.site(place)));
    }

    /// Finds all lodgers new cells.
    pub(super) fn move_all_lodgers(&mut self) {
        let cells: Vec<u32> = self.lodgers.of_cell.keys().copied().collect();
        let moving: Vec<(u32, u32)> =
            cells.into_iter().flat_map(|c| self.evict(c).into_iter().map(move |place| (place, c))).collect();
        for (place, start) in moving {
            self.lodge(place, start);
        }
    }

    /// Makes `place` stand as a duplicate of the place `of`. The smaller id goes to `of`, which stands for both.
    pub(super) fn make_twin(&mut self, place: u32, of: u32) {
        let (i, j) = (place as usize, of as usize);
        if self.ids[i] < self.ids[j] {
            self.ids.swap(i, j);
            self.places.swap(self.ids[i] as usize, self.ids[j] as usize);
        }
        self.status[i] = Status::Duplicate;
        // A hidden point that comes back may bring duplicates of its own.
        let mut moving = self.twins.remove(&place).unwrap_or_default();
        moving.push(place);
        moving.iter().for_each(|&twin| self.hints[twin as usize] = of);
        self.twins.entry(of).or_default().extend(moving);
    }
}
