//! The checker's own complex of tetrahedra: flat arrays, links by index, no maps.
//!
//! A facet is `4 * cell + k`, the one opposite corner k. Every cell has four neighbors: beyond the hull lie cells with the infinite vertex in place of
//! a corner. Cells are 32 bytes; slots of destroyed ones are used again. Vertices are numbered from 4: below stand the three apexes, last one
//! first, and the infinite vertex.

use super::glue::FACETS;
use super::predicates::{Corners, orient};
use super::view::grain;
use crate::model::{Point3, Tetrahedron, VertexId, WeightedPoint, canonical_tetrahedron};

/// The infinite vertex.
pub const INFINITE: u32 = 3;
/// What number the first point has.
pub const FIRST: u32 = 4;
/// No cell, no vertex, no facet. As first corner: nothing is in this slot.
pub const NONE: u32 = u32::MAX;
/// Marks the first corner of a cell that is destroyed: its number and this.
const MARK: u32 = 1 << 31;

/// The number of a vertex named in a trace.
pub fn number(v: VertexId) -> u32 {
    v.0.wrapping_add(FIRST)
}

/// The name of a vertex.
pub fn id(v: u32) -> VertexId {
    VertexId(v.wrapping_sub(FIRST))
}

/// A cell: corners, positively oriented (the infinite vertex being beyond the facet opposite it), and the facets on the other side.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// Corners.
    pub v: [u32; 4],
    /// The facet beyond the one opposite each corner.
    pub beyond: [u32; 4],
}

impl Cell {
    /// Where a vertex stands among the corners.
    #[inline]
    pub fn find(&self, v: u32) -> Option<usize> {
        self.v.iter().position(|&w| w == v)
    }

    /// Whether the infinite vertex is no corner.
    #[inline]
    pub fn is_finite(&self) -> bool {
        !self.v.contains(&INFINITE)
    }

    /// The facet opposite corner k, turned such that (facet, corner) is positive.
    #[inline]
    pub fn facet(&self, k: usize) -> [u32; 3] {
        FACETS[k].map(|i| self.v[i])
    }

    /// Its canonical tuple.
    pub fn tuple(&self) -> Tetrahedron {
        canonical_tetrahedron(self.v.map(id))
    }
}

/// What the complex knows of a vertex besides its place.
#[derive(Clone, Copy, Debug)]
struct Near {
    /// A cell at it, or `NONE`.
    cell: u32,
    /// Scratch: its position in a list of vertices in hand.
    local: u32,
}

/// Points and cells.
#[derive(Clone, Debug)]
pub struct Complex {
    points: Vec<WeightedPoint>,
    near: Vec<Near>,
    cells: Vec<Cell>,
    free: Vec<u32>,
    /// Scratch of searches: what was seen, a stamp for each cell.
    seen: Vec<u32>,
    stamp: u32,
    stack: Vec<u32>,
    grain: i32,
}

impl Default for Complex {
    fn default() -> Complex {
        let far = WeightedPoint::default();
        Complex {
            points: vec![far; FIRST as usize],
            near: vec![Near { cell: NONE, local: 0 }; FIRST as usize],
            cells: Vec::new(),
            free: Vec::new(),
            seen: Vec::new(),
            stamp: 0,
            stack: Vec::new(),
            grain: grain(far),
        }
    }
}

impl Complex {
    /// Adds a point and says its number.
    pub fn add_point(&mut self, p: WeightedPoint) -> u32 {
        self.grain = self.grain.min(grain(p));
        self.points.push(p);
        self.near.push(Near { cell: NONE, local: 0 });
        self.points.len() as u32 - 1
    }

    /// One more than the largest number of a vertex.
    pub fn vertex_count(&self) -> u32 {
        self.points.len() as u32
    }

    /// A vertex with its weight; not the infinite one.
    #[inline]
    pub fn point(&self, v: u32) -> WeightedPoint {
        self.points[v as usize]
    }

    /// Its place.
    #[inline]
    pub fn at(&self, v: u32) -> Point3 {
        self.points[v as usize].at
    }

    /// Puts an apex in its place.
    pub fn set_apex(&mut self, v: u32, at: Point3) {
        self.points[v as usize] = WeightedPoint::unweighted(at);
        self.grain = self.grain.min(grain(self.points[v as usize]));
    }

    /// All points so far are multiples of 2 to this power, weights of its square.
    pub fn grain(&self) -> i32 {
        self.grain
    }

    /// Gives a point another weight.
    pub fn set_weight(&mut self, v: u32, weight: f64) {
        self.points[v as usize].weight = weight;
        self.grain = self.grain.min(grain(self.points[v as usize]));
    }

    /// A cell.
    #[inline]
    pub fn cell(&self, c: u32) -> &Cell {
        &self.cells[c as usize]
    }

    /// The corners of a finite cell.
    #[inline]
    pub fn corners(&self, c: u32) -> Corners {
        self.cells[c as usize].v.map(|v| self.points[v as usize])
    }

    /// How many slots there are.
    pub fn slot_count(&self) -> u32 {
        self.cells.len() as u32
    }

    /// Whether a cell is in this slot.
    #[inline]
    pub fn lives(&self, c: u32) -> bool {
        self.cells[c as usize].v[0] < MARK
    }

    /// All cells.
    pub fn cells(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.slot_count()).filter(|&c| self.lives(c))
    }

    /// All tetrahedra.
    pub fn tetrahedra(&self) -> impl Iterator<Item = u32> + '_ {
        self.cells().filter(|&c| self.cells[c as usize].is_finite())
    }

    /// For each slot the corners of the tetrahedron in it, if there is one.
    pub fn corner_lists(&self) -> impl ExactSizeIterator<Item = Option<[u32; 4]>> + '_ {
        self.cells.iter().map(|cell| (cell.v[0] < MARK && cell.is_finite()).then_some(cell.v))
    }

    /// Makes room for as many cells as points that are spread evenly have: they are not copied while they grow into it, and memory is not touched before it is used.
    pub fn make_room(&mut self) {
        const CELLS_PER_POINT: usize = 7;
        // Where there is not so much, growth by and by must do.
        let _ = self.cells.try_reserve(CELLS_PER_POINT * self.points.len());
    }

    /// Adds a cell without neighbors.
    #[inline]
    pub fn add(&mut self, v: [u32; 4]) -> u32 {
        let cell = Cell { v, beyond: [NONE; 4] };
        match self.free.pop() {
            Some(c) => {
                self.cells[c as usize] = cell;
                c
            }
            None => {
                self.cells.push(cell);
                self.cells.len() as u32 - 1
            }
        }
    }

    /// A slot for a cell that `set` will write.
    #[inline]
    pub fn reserve(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.cells.push(Cell { v: [NONE; 4], beyond: [NONE; 4] });
            self.cells.len() as u32 - 1
        })
    }

    /// Writes a cell. The other sides of its facets are the caller's.
    #[inline]
    pub fn set(&mut self, c: u32, cell: Cell) {
        self.cells[c as usize] = cell;
    }

    /// Says what is on the other side of a facet.
    #[inline]
    pub fn set_beyond(&mut self, f: u32, beyond: u32) {
        self.cells[(f >> 2) as usize].beyond[(f & 3) as usize] = beyond;
    }

    /// Takes a cell out, and says what it was. Its slot is not used again before `release`.
    #[inline]
    pub fn take(&mut self, c: u32) -> Cell {
        let cell = self.cells[c as usize];
        self.cells[c as usize].v[0] = NONE;
        cell
    }

    /// Whether a cell is in this slot. Marks it as destroyed, or does not; its slot is not used again before `release`.
    #[inline]
    pub fn meet(&mut self, c: u32, destroyed: bool) -> bool {
        let first = &mut self.cells[c as usize].v[0];
        let lives = *first < MARK;
        *first |= u32::from(destroyed) << 31;
        lives
    }

    /// The corner opposite a facet of a cell that is marked as destroyed.
    #[inline]
    pub fn apex_marked(&self, f: u32) -> u32 {
        self.apex(f) & !MARK
    }

    /// Marks a cell as destroyed, and says what it was.
    pub fn destroy(&mut self, c: u32) -> Cell {
        let cell = self.cells[c as usize];
        self.cells[c as usize].v[0] |= MARK;
        cell
    }

    /// Lets the slot of a cell that was taken out be used again.
    #[inline]
    pub fn release(&mut self, c: u32) {
        self.free.push(c);
    }

    /// Takes all cells out.
    pub fn clear(&mut self) {
        self.cells.clear();
        self.free.clear();
        self.near.iter_mut().for_each(|n| n.cell = NONE);
    }

    /// Makes two facets the two sides of one.
    #[inline]
    pub fn join(&mut self, f: u32, g: u32) {
        self.cells[(f >> 2) as usize].beyond[(f & 3) as usize] = g;
        self.cells[(g >> 2) as usize].beyond[(g & 3) as usize] = f;
    }

    /// The corner opposite a facet.
    #[inline]
    pub fn apex(&self, f: u32) -> u32 {
        self.cells[(f >> 2) as usize].v[(f & 3) as usize]
    }

    /// Another corner in place of one.
    pub fn relabel(&mut self, c: u32, k: usize, v: u32) {
        self.cells[c as usize].v[k] = v;
    }

    /// A cell at a vertex, or `NONE`.
    #[inline]
    pub fn cell_at(&self, v: u32) -> u32 {
        self.near[v as usize].cell
    }

    /// Whether a vertex is in a cell.
    pub fn holds(&self, v: u32) -> bool {
        let c = self.near[v as usize].cell;
        c != NONE && self.lives(c) && self.cells[c as usize].v.contains(&v)
    }

    /// Notes a cell at a vertex.
    #[inline]
    pub fn set_cell_at(&mut self, v: u32, c: u32) {
        self.near[v as usize].cell = c;
    }

    /// Scratch: the position of a vertex in a list in hand, true only if the list says so too.
    #[inline]
    pub fn local(&self, v: u32) -> u32 {
        self.near[v as usize].local
    }

    /// Sets the scratch of a vertex.
    #[inline]
    pub fn set_local(&mut self, v: u32, local: u32) {
        self.near[v as usize].local = local;
    }

    /// The cell with these corners. Looks around the edges of cells that are at hand, then through the star of the vertex whose cell is known.
    pub fn find(&mut self, corners: [u32; 4]) -> Option<u32> {
        if corners.iter().any(|&v| v >= self.vertex_count()) {
            return None;
        }
        // The youngest first: what is around it was in hand last.
        for from in corners.into_iter().rev() {
            let c = self.near[from as usize].cell;
            if c == NONE {
                return None;
            }
            let cell = &self.cells[c as usize];
            if !cell.v.contains(&from) {
                return None;
            }
            let other = corners.iter().find(|&&v| v != from && cell.v.contains(&v));
            if let Some(&to) = other {
                return self.around(c, from, to, corners);
            }
        }
        let mut found = None;
        self.visit_star(corners[0], |c, cell| {
            if corners.iter().all(|v| cell.v.contains(v)) {
                found = Some(c);
            }
            found.is_none()
        });
        found
    }

    /// Turns around the edge (u, w) from cell c on until it finds a cell with all these corners.
    fn around(&self, c: u32, u: u32, w: u32, corners: [u32; 4]) -> Option<u32> {
        let mut here = c;
        let mut leaving = self.cells[c as usize].v.into_iter().find(|&v| v != u && v != w)?;
        loop {
            let cell = &self.cells[here as usize];
            if corners.iter().all(|v| cell.v.contains(v)) {
                return Some(here);
            }
            // Out through the facet opposite the corner in hand; the next to leave is the other one that is not on the edge.
            let next = cell.v.into_iter().find(|&v| v != u && v != w && v != leaving)?;
            here = cell.beyond[cell.find(leaving)?] >> 2;
            leaving = next;
            if here == c {
                return None;
            }
        }
    }

    /// Calls `visit` with the cells at v until it says no.
    pub fn visit_star(&mut self, v: u32, mut visit: impl FnMut(u32, &Cell) -> bool) {
        let first = self.near[v as usize].cell;
        if first == NONE {
            return;
        }
        let mut stack = std::mem::take(&mut self.stack);
        stack.clear();
        stack.push(first);
        self.fresh();
        self.see(first);
        while let Some(c) = stack.pop() {
            let cell = self.cells[c as usize];
            if !visit(c, &cell) {
                break;
            }
            for k in 0..4 {
                let next = cell.beyond[k] >> 2;
                if cell.v[k] != v && self.see(next) {
                    stack.push(next);
                }
            }
        }
        self.stack = stack;
    }

    /// Forgets what was seen.
    pub fn fresh(&mut self) {
        if self.stamp == u32::MAX {
            self.seen.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.seen.resize(self.cells.len(), 0);
    }

    /// Whether a cell is seen for the first time.
    pub fn see(&mut self, c: u32) -> bool {
        let first = self.seen[c as usize] != self.stamp;
        self.seen[c as usize] = self.stamp;
        first
    }

    /// The sign of the place of q seen from facet k of a finite cell: negative beyond it.
    pub fn inside(&self, c: u32, k: usize, q: Point3) -> crate::model::Sign {
        let [x, y, z] = self.cells[c as usize].facet(k).map(|v| self.at(v));
        orient(x, y, z, q)
    }

    /// A tetrahedron that contains q, by a walk from cell c on; `None` outside the hull. A walk in a regular triangulation does not circle, since it
    /// goes on to cells of larger power along the segment; a bound ends any other.
    pub fn locate(&self, from: u32, q: Point3) -> Option<u32> {
        let mut c = from;
        let infinite = self.cells[c as usize].find(INFINITE);
        if let Some(k) = infinite {
            c = self.cells[c as usize].beyond[k] >> 2;
        }
        for _ in 0..=self.slot_count() {
            let out = (0..4).find(|&k| self.inside(c, k, q).is_negative());
            let Some(k) = out else { return Some(c) };
            c = self.cells[c as usize].beyond[k] >> 2;
            if !self.cells[c as usize].is_finite() {
                return None;
            }
        }
        None
    }
}
