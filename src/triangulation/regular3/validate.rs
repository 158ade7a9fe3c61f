//! What must hold of a triangulation, in layers: each assumes the ones before it.

use super::store::{APEXES, CellId, FIRST, INF, NONE, Regular3, Status};
use crate::arith::space::Kernel3;
use crate::model::{Sign, VertexId};

/// What does not hold, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Violation {
    /// A slot is free but in use, or in use but listed as free, or marked.
    #[error("slot {} is free but in use, in use but listed as free, or marked", .0.0)]
    Slot(CellId),
    /// A cell repeats a vertex, names a point that is none, has its infinite vertex in the wrong place, or lacks an apex in use.
    #[error("cell {:?} does not have four vertices of the triangulation", .0)]
    Vertices([VertexId; 4]),
    /// The two sides of a facet do not agree on it.
    #[error("the sides of the facet of cell {:?} opposite vertex {} disagree", .0, .1.0)]
    Link([VertexId; 4], VertexId),
    /// What is stored of a point contradicts the cells.
    #[error("point {} is not what it is stored to be", .0.0)]
    Point(VertexId),
    /// A finite cell is not positively oriented.
    #[error("cell {:?} is not positively oriented", .0)]
    Orientation([VertexId; 4]),
    /// A vertex is in conflict with the cell across a facet.
    #[error("cell {:?} is in conflict with vertex {} across a facet", .0, .1.0)]
    Regular([VertexId; 4], VertexId),
    /// A hidden point is outside its cell or in conflict with it.
    #[error("hidden point {} is not hidden in cell {:?}", .0.0, .1)]
    Hidden(VertexId, [VertexId; 4]),
    /// Euler's relation fails: the cells do not form a sphere of three dimensions.
    #[error("{cells} cells on {vertices} vertices and {edges} edges")]
    Count {
        /// Cells, ghosts included.
        cells: usize,
        /// Vertices, the infinite one and apexes included.
        vertices: usize,
        /// Edges.
        edges: usize,
    },
}

impl<K: Kernel3> Regular3<K> {
    /// All layers.
    pub fn validate(&self) -> Result<(), Violation> {
        self.validate_links()?;
        self.validate_orientation()?;
        self.validate_regular()
    }

    /// Cells have four vertices of the triangulation, links agree on their facets, points know their cells, and Euler's relation holds. Assumes nothing.
    pub fn validate_links(&self) -> Result<(), Violation> {
        self.validate_slots()?;
        let mut used = vec![false; self.sites.len()];
        let mut edges = Vec::new();
        for c in self.cells() {
            self.validate_cell(c)?;
            let v = self.cells[c.0 as usize].v;
            v.iter().for_each(|&v| used[v as usize] = true);
            for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
                edges.push((v[i].min(v[j]), v[i].max(v[j])));
            }
        }
        self.validate_points(&used)?;
        edges.sort_unstable();
        edges.dedup();
        let (cells, vertices, edges) = (self.cell_count(), used.iter().filter(|&&u| u).count(), edges.len());
        // V - E + F - C = 0 with F = 2 C.
        if vertices + cells != edges { Err(Violation::Count { cells, vertices, edges }) } else { Ok(()) }
    }

    /// The free slots are listed, each once, and no cell is marked.
    fn validate_slots(&self) -> Result<(), Violation> {
        let mut listed = vec![false; self.cells.len()];
        for &c in &self.free {
            match listed.get_mut(c as usize) {
                Some(first @ false) => *first = true,
                _ => return Err(Violation::Slot(CellId(c))),
            }
        }
        let wrong = |&c: &usize| self.marks[c] != 0 || listed[c] != self.cells[c].is_free();
        match (0..self.cells.len()).find(wrong) {
            Some(c) => Err(Violation::Slot(CellId(c as u32))),
            None => Ok(()),
        }
    }

    fn validate_cell(&self, c: CellId) -> Result<(), Violation> {
        let cell = &self.cells[c.0 as usize];
        let apexes = 3 - u32::from(self.dimension.unwrap_or(3));
        let stands = |&v: &u32| {
            (v as usize) < self.sites.len()
                && self.status[v as usize] == Status::Vertex
                && (v < FIRST || self.ids[v as usize] != NONE)
        };
        let repeated = (0..4).any(|i| (0..i).any(|j| cell.v[i] == cell.v[j]));
        let in_use = cell.v.iter().filter(|&&v| v < APEXES).count() as u32;
        if repeated
            || !cell.v.iter().all(stands)
            || cell.v[..3].contains(&INF)
            || (!cell.is_ghost() && in_use != apexes)
        {
            return Err(Violation::Vertices(self.named(cell)));
        }
        for i in 0..4 {
            let (beyond, j) = (cell.n[i] >> 2, (cell.n[i] & 3) as usize);
            let other = self.cells.get(beyond as usize).filter(|b| !b.is_free());
            let agrees = other.is_some_and(|other| {
                let shared = |k: usize| other.v.iter().position(|&v| v == cell.v[k]).is_some_and(|m| m != j);
                other.n[j] == 4 * c.0 + i as u32
                    && beyond != c.0
                    && (0..4).all(|k| k == i || shared(k))
                    && other.v[j] != cell.v[i]
            });
            if !agrees {
                return Err(Violation::Link(self.named(cell), VertexId(self.ids[cell.v[i] as usize])));
            }
        }
        Ok(())
    }

    fn validate_points(&self, used: &[bool]) -> Result<(), Violation> {
        for place in FIRST..self.sites.len() as u32 {
            let i = place as usize;
            let (id, hint) = (VertexId(self.ids[i]), self.hints[i]);
            let live = |c: u32| self.is_live(CellId(c));
            let holds = match self.status[i] {
                Status::Vertex => used[i] && live(hint) && self.cells[hint as usize].v.contains(&place),
                Status::Hidden => {
                    let lodges = self.lodgers.of_cell.get(&hint).is_some_and(|all| all.contains(&place));
                    !used[i] && live(hint) && lodges
                }
                Status::Duplicate => {
                    let status = self.status.get(hint as usize);
                    let stands = matches!(status, Some(Status::Vertex | Status::Hidden));
                    let same = || self.ids[hint as usize] < id.0 && self.site(hint) == self.site(place);
                    !used[i] && stands && same()
                }
                Status::Removed => !used[i],
            };
            if !holds || self.places.get(id.index()) != Some(&place) {
                return Err(Violation::Point(id));
            }
        }
        Ok(())
    }

    /// Finite cells are positively oriented. Assumes good links.
    pub fn validate_orientation(&self) -> Result<(), Violation> {
        let turned = |c: &&super::store::Cell| {
            let [a, b, c, d] = c.v.map(|v| self.site(v).at);
            K::orient3d(a, b, c, d) != Sign::Positive
        };
        match self.cells.iter().filter(|c| !c.is_free() && !c.is_ghost()).find(turned) {
            Some(cell) => Err(Violation::Orientation(self.named(cell))),
            None => Ok(()),
        }
    }

    /// No vertex is in conflict with a cell across a facet, which suffices for all vertices; no hidden point with the cell that contains it. Assumes positive
    /// cells.
    pub fn validate_regular(&self) -> Result<(), Violation> {
        for cell in self.cells.iter().filter(|c| !c.is_free()) {
            for link in cell.n {
                let opposite = self.cells[(link >> 2) as usize].v[(link & 3) as usize];
                if opposite != INF && self.in_conflict(cell, self.site(opposite)) {
                    return Err(Violation::Regular(self.named(cell), VertexId(self.ids[opposite as usize])));
                }
            }
        }
        for (&c, places) in &self.lodgers.of_cell {
            let cell = &self.cells[c as usize];
            for &place in places {
                let q = self.site(place);
                let corners = cell.v.map(|v| self.site(v).at);
                let inside = !cell.is_ghost()
                    && (0..4).all(|i| {
                        let [a, b, c] = super::store::FACET[i].map(|k| corners[k]);
                        K::orient3d(a, b, c, q.at) != Sign::Negative
                    });
                if !inside || self.in_conflict(cell, q) {
                    return Err(Violation::Hidden(VertexId(self.ids[place as usize]), self.named(cell)));
                }
            }
        }
        Ok(())
    }
}
