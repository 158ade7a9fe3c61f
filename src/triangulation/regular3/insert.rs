//! Insertion of a point.
//!
//! In this order: the first point; a point that is there already; a point off the affine hull of the others; a point that is hidden; a point
//! with a conflict zone, whose star replaces it and which may hide vertices.

use super::locate::Found;
use super::star::Scratch;
use super::store::{CellId, Change, FIRST, Regular3, Status};
use crate::arith::space::Kernel3;
use crate::model::{VertexId, WeightedPoint};

/// What an insertion met.
pub(super) enum Meeting {
    /// The point at this place is the same one.
    Twin(u32),
    /// The point is hidden in this cell.
    Hidden(u32),
    /// The point destroys this cell.
    Conflict(u32),
}

impl<K: Kernel3> Regular3<K> {
    /// Inserts a point, which gets the next id; `state` tells what became of it. The search starts at the cell made last.
    pub fn insert(&mut self, p: WeightedPoint, change: &mut Change) -> VertexId {
        change.clear();
        let id = self.places.len() as u32;
        assert!(id < u32::MAX - 8, "a triangulation holds fewer than 2^32 - 8 points");
        let place = self.add_site(p, id);
        self.places.push(place);
        self.put(place, change);
        VertexId(id)
    }

    /// Inserts the point of a place that has a site and an id, wherever it lies.
    pub(super) fn put(&mut self, place: u32, change: &mut Change) {
        self.status[place as usize] = Status::Vertex;
        if self.dimension.is_none() {
            self.raise_from_nothing(place);
            change.created.extend(self.cells());
        } else if let Some((apex, side)) = self.off_hull(self.site(place).at) {
            change.destroyed.extend(self.cells().map(|c| self.vertices(c)));
            self.raise(place, apex, side);
            change.created.extend(self.cells());
        } else {
            self.insert_in_hull(place, change);
        }
    }

    /// Inserts the point of a place, which lies in the affine hull of the others. Its status is that of a vertex, its id is set.
    pub(super) fn insert_in_hull(&mut self, place: u32, change: &mut Change) {
        let q = self.site(place);
        match self.meet(q, self.last) {
            Meeting::Twin(of) => self.make_twin(place, of),
            Meeting::Hidden(cell) => match self.lodgers.by_site.get(&super::lodge::key(q)) {
                Some(&of) => self.make_twin(place, of),
                None => {
                    self.lodge(place, cell);
                    change.hidden.push(VertexId(self.ids[place as usize]));
                }
            },
            Meeting::Conflict(root) => self.replace_zone(place, root, change),
        }
    }

    /// Finds out what a point in the affine hull of the others meets.
    #[inline]
    pub(super) fn meet(&self, q: WeightedPoint, start: u32) -> Meeting {
        let Found { cell, touches } = self.walk(start, q.at);
        let found = &self.cells[cell as usize];
        // Beyond a ghost's facet the point is in conflict with the ghost.
        if found.is_ghost() {
            return Meeting::Conflict(cell);
        }
        if touches
            && let Some(v) = self.corner_at(cell, q.at)
            && self.site(v).weight == q.weight
            && v >= FIRST
        {
            return Meeting::Twin(v);
        }
        if K::in_conflict3(self.corners(found), q) { Meeting::Conflict(cell) } else { Meeting::Hidden(cell) }
    }

    /// Replaces the conflict zone of a place by its star. Vertices strictly inside the zone become hidden.
    fn replace_zone(&mut self, place: u32, root: u32, change: &mut Change) {
        let mut s = self.scratch.take().unwrap_or_default();
        self.reserve_numbers(&mut s);
        self.flood(root, self.site(place), &mut s);
        change.destroyed.extend(s.zone.iter().map(|&c| self.named(&self.cells[c as usize])));
        let mut homeless = Vec::new();
        if !self.lodgers.of_cell.is_empty() {
            for &c in &s.zone {
                homeless.extend(self.evict(c));
            }
        }
        let hidden = self.swallowed(&mut s);
        self.last = self.star(place, &mut s);
        self.set_hints(&s);
        change.created.extend(s.zone.iter().map(|&c| CellId(c)));
        self.scratch = Some(s);
        change.hidden.extend(hidden.iter().map(|&v| VertexId(self.ids[v as usize])));
        change.hidden.sort_unstable();
        for v in hidden.into_iter().chain(homeless) {
            self.lodge(v, self.last);
        }
    }

    /// The vertices of the zone that are not on its boundary. Without weights there are none.
    fn swallowed(&self, s: &mut Scratch) -> Vec<u32> {
        if !self.has_weights {
            return Vec::new();
        }
        let on_rim = || s.rim.iter().flat_map(|f| f.v);
        let in_zone = || s.zone.iter().flat_map(|&c| self.cells[c as usize].v);
        // The star takes the numbers over.
        let numbers = &mut s.numbers;
        let mut inner: Vec<u32> = if on_rim().all(|v| numbers.of(v).is_some()) {
            in_zone().filter(|&v| !numbers.has(v)).collect()
        } else {
            let mut on_rim: Vec<u32> = on_rim().collect();
            on_rim.sort_unstable();
            in_zone().filter(|v| on_rim.binary_search(v).is_err()).collect()
        };
        inner.sort_unstable();
        inner.dedup();
        debug_assert!(inner.iter().all(|&v| v >= FIRST && self.status[v as usize] == Status::Vertex));
        inner
    }

    /// Lets the vertices of the new cells refer to them.
    fn set_hints(&mut self, s: &Scratch) {
        for &c in &s.zone {
            for v in self.cells[c as usize].v {
                self.hints[v as usize] = c;
            }
        }
    }
}
