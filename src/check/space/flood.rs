//! The cells that an insertion destroys, as its flood code names them, and the rim around them.
//!
//! Each facet of the flood is looked at once, and what a bit says cannot be foreseen. So nothing here waits for a bit: a facet is offered to two lists, cells to come and facets of the
//! rim, one of which keeps it, and cells are marked as destroyed, or not, by the same instruction.
//!
//! A cell entered through a facet has the tuple of the cell before, the corner it does not share replaced by its own. Crossing a facet turns the orientation over, so that
//! tuples are positive and negative in turn, the first cell's being positive.

use super::complex::{Cell, Complex, INFINITE, NONE};
use super::glue::FACETS;
use crate::check::verdict::{Checked, Rule, ensure};
use crate::model::{Tetrahedron, WeightedPoint};
use crate::trace::Bits;

/// A list that takes or leaves what it is offered, without a branch.
#[derive(Clone, Debug, Default)]
pub struct Sieve<T> {
    items: Vec<T>,
    count: usize,
}

impl<T: Copy + Default> Sieve<T> {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Makes room for so many offers.
    #[inline]
    pub fn expect(&mut self, offers: usize) {
        if self.items.len() < self.count + offers {
            self.items.resize(2 * (self.count + offers), T::default());
        }
    }

    /// An offer, of those expected.
    #[inline]
    pub fn offer(&mut self, item: T, taken: bool) {
        self.items[self.count] = item;
        self.count += usize::from(taken);
    }

    /// What was taken.
    #[inline]
    pub fn taken(&self) -> &[T] {
        &self.items[..self.count]
    }
}

/// A cell of the cavity.
#[derive(Clone, Copy, Debug, Default)]
pub struct Flooded {
    /// Where it was.
    pub slot: u32,
    /// Whether its tuple is positively oriented.
    positive: bool,
    /// Which member is opposite the facet that it was entered by; 0 for the first cell.
    entry: u8,
    /// Its tuple, in the order of the flood.
    v: [u32; 4],
    /// The facets beyond those opposite the members.
    beyond: [u32; 4],
    /// The positions of the members among the vertices.
    local: [u32; 4],
}

impl Flooded {
    /// What it was.
    pub fn cell(&self) -> Cell {
        let turn = |[a, b, c, d]: [u32; 4]| if self.positive { [a, b, c, d] } else { [b, a, c, d] };
        Cell { v: turn(self.v), beyond: turn(self.beyond) }
    }
}

/// A facet that the flood has met.
#[derive(Clone, Copy, Debug, Default)]
struct Met {
    /// 4 times the number of the cell in the flood, plus which member of its tuple is opposite.
    of: u32,
    /// The facet beyond.
    outer: u32,
}

/// A facet of the rim.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Its corners, as positions among the vertices, turned such that with a point of the cavity they are positive.
    pub corners: [u32; 3],
    /// The corner opposite of the cell destroyed.
    pub inner: u32,
    /// The facet beyond.
    pub outer: u32,
    /// The corner opposite that.
    pub apex: u32,
}

/// A flood. Lists are kept to be used again.
#[derive(Clone, Debug, Default)]
pub struct Flood {
    /// The cells destroyed, in order.
    pub cells: Sieve<Flooded>,
    /// The rim.
    pub sides: Vec<Side>,
    /// All vertices of the cells.
    pub vertices: Sieve<u32>,
    /// Where the flood goes on, one facet for each cell but the first; and where it stops.
    doors: Sieve<Met>,
    walls: Sieve<Met>,
}

impl Flood {
    /// Takes the cells that a flood code names out of the complex. `first` is that of the tuple.
    pub fn run(&mut self, mesh: &mut Complex, first: u32, tuple: [u32; 4], bits: &Bits) -> Checked {
        self.cells.clear();
        self.vertices.clear();
        self.doors.clear();
        self.walls.clear();
        let cell = mesh.destroy(first);
        self.vertices.expect(4);
        let local = tuple.map(|v| self.number(mesh, v));
        let beyond = tuple.map(|v| cell.beyond[place(&cell, v)]);
        self.cells.expect(1);
        self.cells.offer(Flooded { slot: first, positive: true, entry: 0, v: tuple, beyond, local }, true);
        // By rings: where the cells of one are known, nothing waits for one to fetch what is around the next.
        self.doors.expect(1);
        self.walls.expect(1);
        let (mut read, mut ring) = (self.look(mesh, 0, 0, bits.window(0)), 0..1);
        while !ring.is_empty() {
            self.doors.expect(4 * ring.len());
            self.walls.expect(4 * ring.len());
            for here in ring.clone() {
                read = self.look_around(mesh, here, bits, read);
            }
            let doors = ring.end - 1..self.doors.taken().len();
            self.vertices.expect(doors.len());
            self.cells.expect(doors.len());
            for door in doors {
                let cell = self.enter(mesh, self.doors.taken()[door]);
                self.cells.offer(cell, true);
            }
            ring = ring.end..self.cells.taken().len();
        }
        ensure(read == bits.len(), Rule::Flood, || {
            ("a bit for each facet of the flood", format!("{} bits for {read} facets", bits.len()))
        })?;
        self.collect_sides(mesh)
    }

    /// Reads what becomes of the facets of a cell but the one it was entered by, from a bit on; says which bit is next. Bits beyond the end are 0.
    #[inline]
    fn look_around(&mut self, mesh: &mut Complex, here: usize, bits: &Bits, read: u32) -> u32 {
        const OTHERS: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];
        let next = bits.window(read);
        let entry = usize::from(self.cells.taken()[here].entry & 3);
        OTHERS[entry].into_iter().fold(0, |met, k| met + self.look(mesh, here, k, next >> met)) + read
    }

    /// Reads what becomes of a facet. Says how many bits that took: none, if the cell beyond was destroyed before.
    #[inline(always)]
    fn look(&mut self, mesh: &mut Complex, here: usize, k: usize, bits: u32) -> u32 {
        let met = Met { of: (4 * here + k) as u32, outer: self.cells.taken()[here].beyond[k] };
        let bit = bits & 1 == 1;
        let open = mesh.meet(met.outer >> 2, bit);
        self.doors.offer(met, open & bit);
        self.walls.offer(met, open & !bit);
        u32::from(open)
    }

    #[inline(always)]
    fn enter(&mut self, mesh: &mut Complex, door: Met) -> Flooded {
        let slot = door.outer >> 2;
        let own = mesh.apex_marked(door.outer);
        let number = self.number(mesh, own);
        let from = &self.cells.taken()[(door.of >> 2) as usize];
        let replaced = |old: &[u32; 4], new| [0, 1, 2, 3].map(|k| if k == door.of & 3 { new } else { old[k as usize] });
        let (v, local) = (replaced(&from.v, own), replaced(&from.local, number));
        let cell = mesh.cell(slot);
        let beyond = v.map(|w| cell.beyond[place(cell, w)]);
        Flooded { slot, positive: !from.positive, entry: (door.of & 3) as u8, v, beyond, local }
    }

    /// Turns walls to sides.
    fn collect_sides(&mut self, mesh: &Complex) -> Checked {
        self.sides.clear();
        let mut stops = !self.walls.taken().is_empty();
        for &Met { of, outer } in self.walls.taken() {
            let Flooded { local, positive, .. } = &self.cells.taken()[(of >> 2) as usize];
            let [x, y, z] = FACETS[(of & 3) as usize].map(|i| local[i]);
            let corners = if *positive { [x, y, z] } else { [y, x, z] };
            self.sides.push(Side { corners, inner: local[(of & 3) as usize], outer, apex: mesh.apex(outer) });
            stops &= mesh.lives(outer >> 2);
        }
        // A cell that one facet was to stop at may have been entered through another.
        ensure(stops, Rule::Flood, || ("a flood that stops where it says", "none, or a cell beyond its rim destroyed"))
    }

    /// The position of a vertex, which is added if it is not there: there is room for it.
    #[inline(always)]
    fn number(&mut self, mesh: &mut Complex, v: u32) -> u32 {
        let known = self.position(mesh, v);
        let count = self.vertices.taken().len() as u32;
        let number = if known == NONE { count } else { known };
        mesh.set_local(v, number);
        self.vertices.offer(v, known == NONE);
        number
    }

    /// The position of a vertex, or `NONE`.
    #[inline]
    pub fn position(&self, mesh: &Complex, v: u32) -> u32 {
        let known = mesh.local(v);
        if self.vertices.taken().get(known as usize) == Some(&v) { known } else { NONE }
    }

    /// The vertices, then the corner beyond each facet of the rim; nothing for the infinite vertex.
    pub fn surroundings(&self, mesh: &Complex) -> impl Iterator<Item = Option<WeightedPoint>> + Clone {
        let beyond = self.sides.iter().map(|side| side.apex);
        let all = self.vertices.taken().iter().copied().chain(beyond);
        all.map(|v| (v != INFINITE).then(|| mesh.point(v)))
    }

    /// The position there of the corner beyond the k-th facet of the rim.
    #[inline]
    pub fn beyond(&self, k: usize) -> u32 {
        (self.vertices.taken().len() + k) as u32
    }

    /// Of the cells destroyed the last one in canonical order.
    pub fn last(&self) -> Option<Tetrahedron> {
        self.cells.taken().iter().map(|f| f.cell().tuple()).max()
    }
}

/// Where a corner stands in a cell, which may be marked as destroyed, found without a branch.
#[inline]
fn place(cell: &Cell, v: u32) -> usize {
    // Not above 3, since corners differ.
    (usize::from(cell.v[1] == v) + 2 * usize::from(cell.v[2] == v) + 3 * usize::from(cell.v[3] == v)) & 3
}
