//! Removal of a point, and change of its weight.
//!
//! A vertex leaves a hole, its star, whose other vertices are the only ones that the new cells can have: no other vertex gains or loses a
//! cell outside. Hidden points that lodged in the star have lost what hid them; they are put back one by one. So every mutation consists
//! of two kinds of steps, `take_out` and `put_back`, which a library that records steps calls itself.
//!
//! Where the remaining points span one dimension less, every finite cell has the point; then it becomes an apex (`lower`), the reverse of `raise`.

use super::star::Rim;
use super::store::{APEXES, CellId, Change, FACET, INF, NONE, Regular3, Site, Status};
use crate::arith::space::Kernel3;
use crate::model::{PointState, Sign, VertexId, WeightedPoint};

impl<K: Kernel3> Regular3<K> {
    /// Removes a point. Hidden points and duplicates appear where they now belong. Nothing happens to a point removed before.
    ///
    /// `change` lists the cells destroyed in their order, among them such as this call has made on its way.
    pub fn remove(&mut self, v: VertexId, change: &mut Change) {
        change.clear();
        let homeless = self.take_out(v, change);
        homeless.iter().for_each(|&h| self.put_back(h, change));
        self.sum_up(&homeless, change);
    }

    /// Gives a point another weight (squared radius). A removed point comes back.
    ///
    /// `change` as for `remove`.
    pub fn set_weight(&mut self, v: VertexId, weight: f64, change: &mut Change) {
        change.clear();
        let before = self.state(v);
        let mut homeless = self.take_out(v, change);
        self.assign_weight(v, weight);
        self.put_back(v, change);
        homeless.iter().for_each(|&h| self.put_back(h, change));
        if before == PointState::Vertex {
            change.hidden.push(v)
        } else {
            homeless.push(v)
        }
        self.sum_up(&homeless, change);
    }

    /// The first step of a removal: takes a point out of the triangulation. A duplicate takes its place, if there is one.
    ///
    /// Returns the hidden points that lodged in the cells it leaves, ascending: they belong nowhere until `put_back`.
    pub fn take_out(&mut self, v: VertexId, change: &mut Change) -> Vec<VertexId> {
        let place = self.places[v.index()];
        match self.status[place as usize] {
            Status::Removed => Vec::new(),
            Status::Duplicate => {
                self.leave_twins(place);
                Vec::new()
            }
            status if self.twins.contains_key(&place) => {
                self.hand_over(place, status, change);
                Vec::new()
            }
            Status::Hidden => {
                self.move_out(place);
                self.status[place as usize] = Status::Removed;
                Vec::new()
            }
            Status::Vertex => {
                let homeless = self.uproot(place, change);
                self.status[place as usize] = Status::Removed;
                let mut ids: Vec<_> = homeless.into_iter().map(|h| VertexId(self.ids[h as usize])).collect();
                ids.sort_unstable();
                ids
            }
        }
    }

    /// The other step: inserts a point that `take_out` has removed or left without a cell.
    pub fn put_back(&mut self, v: VertexId, change: &mut Change) {
        let place = self.places[v.index()];
        let belongs = self.status[place as usize] != Status::Removed && self.hints[place as usize] != NONE;
        if !belongs {
            self.put(place, change);
        }
    }

    /// Gives a removed point another weight; it stays removed. Nothing happens to a point that is there.
    pub fn assign_weight(&mut self, v: VertexId, weight: f64) {
        let place = self.places[v.index()] as usize;
        if self.status[place] == Status::Removed {
            // -0 would not be equal to 0 as a key.
            self.sites[place].0.weight = weight + 0.0;
            self.take_note_of(self.sites[place].0);
        }
    }

    /// Brings the lists of a change into their final form; those that turn out otherwise leave them. `homeless` were no vertices before, nor were those revived so far.
    fn sum_up(&self, homeless: &[VertexId], change: &mut Change) {
        change.created.sort_unstable();
        change.created.dedup();
        change.created.retain(|&c| self.is_live(c));
        change.revived.extend(homeless);
        change.revived.sort_unstable();
        change.revived.dedup();
        change.hidden.retain(|v| self.state(*v) == PointState::Hidden && change.revived.binary_search(v).is_err());
        change.hidden.sort_unstable();
        change.hidden.dedup();
        change.revived.retain(|v| self.state(*v) == PointState::Vertex);
    }

    /// A duplicate goes; what stands for it stays.
    fn leave_twins(&mut self, place: u32) {
        let of = self.hints[place as usize];
        if let Some(twins) = self.twins.get_mut(&of) {
            twins.retain(|&t| t != place);
            if twins.is_empty() {
                self.twins.remove(&of);
            }
        }
        self.status[place as usize] = Status::Removed;
        self.hints[place as usize] = NONE;
    }

    /// A point that stands for others goes: the smallest of them takes over its place, and nothing moves but the two ids.
    fn hand_over(&mut self, place: u32, status: Status, change: &mut Change) {
        let twins = self.twins.get(&place).map_or(&[][..], Vec::as_slice);
        let Some(&heir) = twins.iter().min_by_key(|&&t| self.ids[t as usize]) else { return };
        let star = if status == Status::Vertex { self.star_of(place) } else { Vec::new() };
        change.destroyed.extend(star.iter().map(|&c| self.named(&self.cells[c as usize])));
        self.leave_twins(heir);
        let (i, j) = (place as usize, heir as usize);
        self.ids.swap(i, j);
        self.places.swap(self.ids[i] as usize, self.ids[j] as usize);
        change.created.extend(star.into_iter().map(CellId));
        if status == Status::Vertex {
            change.revived.push(VertexId(self.ids[i]));
        }
    }

    /// The cells around a vertex, ghosts included.
    pub(super) fn star_of(&mut self, place: u32) -> Vec<u32> {
        let mut star = vec![self.hints[place as usize]];
        self.marks[star[0] as usize] = 1;
        let mut next = 0;
        while let Some(&c) = star.get(next) {
            next += 1;
            let cell = self.cells[c as usize];
            for i in (0..4).filter(|&i| cell.v[i] != place) {
                let beyond = cell.n[i] >> 2;
                if self.marks[beyond as usize] == 0 {
                    self.marks[beyond as usize] = 1;
                    star.push(beyond);
                }
            }
        }
        star.iter().for_each(|&c| self.marks[c as usize] = 0);
        star
    }

    /// Takes a vertex, for which nothing else stands, out of the complex; returns the places that lodged in its star.
    fn uproot(&mut self, place: u32, change: &mut Change) -> Vec<u32> {
        let star = self.star_of(place);
        change.destroyed.extend(star.iter().map(|&c| self.named(&self.cells[c as usize])));
        let mut homeless = Vec::new();
        if !self.lodgers.of_cell.is_empty() {
            star.iter().for_each(|&c| homeless.extend(self.evict(c)));
        }
        self.hints[place as usize] = NONE;
        if self.dimension == Some(0) {
            self.vanish();
        } else if self.is_pinnacle(place, &star) {
            self.lower(place, &star);
            change.created.extend(star.into_iter().map(CellId));
        } else {
            let rim = self.link_of(place, &star);
            let made = self.fill(&rim, star);
            for &c in &made {
                for v in self.cells[c as usize].v {
                    self.hints[v as usize] = c;
                }
                change.created.push(CellId(c));
            }
            self.last = made.first().copied().unwrap_or(NONE);
        }
        homeless
    }

    /// The facets around the star of a place, seen from inside.
    fn link_of(&self, place: u32, star: &[u32]) -> Vec<Rim> {
        let facet = |&c: &u32| {
            let cell = &self.cells[c as usize];
            let i = cell.v.iter().position(|&v| v == place)?;
            Some(Rim { v: FACET[i].map(|k| cell.v[k]), outer: cell.n[i] })
        };
        star.iter().filter_map(facet).collect()
    }

    /// Whether all vertices but this one, apexes included, lie in one plane.
    ///
    /// Then no finite cell lacks it, so that beyond each facet opposite to it there is a ghost; only then the points are looked at.
    fn is_pinnacle(&self, place: u32, star: &[u32]) -> bool {
        let finite = || star.iter().map(|&c| &self.cells[c as usize]).filter(|c| !c.is_ghost());
        let bare = |cell: &super::store::Cell| {
            (0..4).all(|i| cell.v[i] != place || self.cells[(cell.n[i] >> 2) as usize].is_ghost())
        };
        let Some(base) = finite().next() else { return false };
        if !finite().all(bare) {
            return false;
        }
        let mut plane = base.v.into_iter().filter(|&v| v != place).map(|v| self.site(v).at);
        let (Some(a), Some(b), Some(c)) = (plane.next(), plane.next(), plane.next()) else { return false };
        finite().flat_map(|cell| cell.v).all(|v| v == place || K::orient3d(a, b, c, self.site(v).at) == Sign::Zero)
    }

    /// Makes an apex of a vertex without which the points span one dimension less. The cells stay, under another name.
    fn lower(&mut self, place: u32, star: &[u32]) {
        let used = star.iter().map(|&c| &self.cells[c as usize]).find(|c| !c.is_ghost()).map_or([NONE; 4], |c| c.v);
        // A triangulation of dimension d > 0 has 3 - d apexes, so that one of the three is free.
        let apex = (0..APEXES).find(|k| !used.contains(k)).unwrap_or(0);
        self.sites[apex as usize] = Site(WeightedPoint::unweighted(self.site(place).at));
        for &c in star {
            for v in &mut self.cells[c as usize].v {
                if *v == place {
                    *v = apex;
                }
            }
        }
        self.hints[apex as usize] = star[0];
        self.last = star[0];
        self.dimension = self.dimension.map(|d| d - 1);
    }

    /// Leaves no cells: the last vertex has gone.
    fn vanish(&mut self) {
        self.cells.clear();
        self.marks.clear();
        self.free.clear();
        self.hints[..=INF as usize].fill(NONE);
        self.last = NONE;
        self.dimension = None;
    }
}
