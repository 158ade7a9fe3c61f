//! Cells, their links, and the places of points. Knows no coordinates beyond handing them out.

use crate::arith::space::{Kernel3, WeightedCorners};
use crate::model::{PointState, VertexId, WeightedPoint};
use std::collections::BTreeMap;
use std::marker::PhantomData;

/// A cell's slot. Slots are reused: a `CellId` holds until the next mutation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CellId(pub(crate) u32);

/// The infinite vertex, which ghost cells have as their last.
pub const INFINITE: VertexId = VertexId(u32::MAX);

/// The name of apex k (0, 1 or 2): an auxiliary vertex of a triangulation whose points do not span space.
pub const fn apex(k: u32) -> VertexId {
    VertexId(u32::MAX - 1 - k)
}

/// Whether a vertex is an apex.
pub fn is_apex(v: VertexId) -> bool {
    (apex(2).0..=apex(0).0).contains(&v.0)
}

/// What a mutation did. Reused by its caller; every mutator clears it first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Change {
    /// Destroyed cells, positively oriented, ghosts too. Insertions list them in flood order.
    pub destroyed: Vec<[VertexId; 4]>,
    /// Created cells, ghosts too.
    pub created: Vec<CellId>,
    /// Points that were vertices, or are new, and are now hidden; ascending.
    pub hidden: Vec<VertexId>,
    /// Points that were hidden and are now vertices; ascending.
    pub revived: Vec<VertexId>,
}

impl Change {
    /// Empties the lists, keeping their memory.
    pub fn clear(&mut self) {
        self.destroyed.clear();
        self.created.clear();
        self.hidden.clear();
        self.revived.clear();
    }
}

/// No place, no cell.
pub(super) const NONE: u32 = u32::MAX;
/// How many apexes there may be: places 0, 1, 2.
pub(super) const APEXES: u32 = 3;
/// The place of the infinite vertex.
pub(super) const INF: u32 = 3;
/// The place of the first point.
pub(super) const FIRST: u32 = 4;

/// For each corner of a cell the other three, so that they turn counterclockwise seen from it: the orientation of facet and corner is positive.
pub(super) const FACET: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// A cell: vertices and links, see the module head. One half of a line of the processor's cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(32))]
pub(super) struct Cell {
    pub(super) v: [u32; 4],
    pub(super) n: [u32; 4],
}

impl Cell {
    pub(super) const FREE: Cell = Cell { v: [NONE; 4], n: [NONE; 4] };

    #[inline]
    pub(super) fn is_free(&self) -> bool {
        self.v[0] == NONE
    }

    #[inline]
    pub(super) fn is_ghost(&self) -> bool {
        self.v[3] == INF
    }
}

/// A weighted point that does not straddle two lines of the cache.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub(super) struct Site(pub(super) WeightedPoint);

impl Site {
    pub(super) fn of(p: WeightedPoint) -> Site {
        // -0 would not be equal to 0 in the order of points.
        Site(WeightedPoint { at: p.at + crate::model::Point3::ZERO, weight: p.weight + 0.0 })
    }
}

/// What the point of a place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Status {
    Vertex,
    Hidden,
    Duplicate,
    Removed,
}

/// The regular triangulation of points of space.
///
/// Limits: fewer than 2^30 cells, 2^32 - 8 points. Coordinates and weights obey the rules of `arith::space::Kernel3`.
#[derive(Clone)]
pub struct Regular3<K: Kernel3> {
    pub(super) sites: Vec<Site>,
    /// Per place the id.
    pub(super) ids: Vec<u32>,
    /// Per id the place.
    pub(super) places: Vec<u32>,
    pub(super) status: Vec<Status>,
    pub(super) hints: Vec<u32>,
    pub(super) cells: Vec<Cell>,
    /// Per cell what the flood in progress knows of it.
    pub(super) marks: Vec<u8>,
    pub(super) free: Vec<u32>,
    /// The dimension of the affine hull of the points.
    pub(super) dimension: Option<u8>,
    /// All coordinates are multiples of this power of two, all weights of its square.
    pub(super) unit: f64,
    /// Below this squared distance determinants of such numbers are exact in f64s: (1024 unit)^2.
    pub(super) exact_below: f64,
    /// Whether any point has, or had, a weight other than 0.
    pub(super) has_weights: bool,
    /// Where the next search starts: a live cell, if there is one.
    pub(super) last: u32,
    pub(super) lodgers: super::lodge::Lodgers,
    /// Per place that stands for others, their places.
    pub(super) twins: BTreeMap<u32, Vec<u32>>,
    /// `None` before first use, and while in use.
    pub(super) scratch: Option<Box<super::star::Scratch>>,
    pub(super) kernel: PhantomData<K>,
}

impl<K: Kernel3> Default for Regular3<K> {
    fn default() -> Self {
        Self::new()
    }
}

impl<K: Kernel3> Regular3<K> {
    /// The triangulation of no points.
    pub fn new() -> Self {
        Self::with_capacity(0)
    }

    /// The triangulation of no points, with room for n.
    pub(super) fn with_capacity(n: usize) -> Self {
        let room = n + FIRST as usize;
        // Uniform points have 6.77 cells a vertex.
        let cells = if n < 64 { 0 } else { n / 100 * 680 + 1000 };
        let mut ids = Vec::with_capacity(room);
        ids.extend([apex(0).0, apex(1).0, apex(2).0, INFINITE.0]);
        let mut sites = Vec::with_capacity(room);
        // Nothing can be decided of a cell with these numbers but that it needs a closer look.
        let nowhere = WeightedPoint { at: crate::model::Point3::NAN, weight: f64::NAN };
        sites.resize(FIRST as usize, Site(nowhere));
        Regular3 {
            sites,
            ids,
            places: Vec::with_capacity(n),
            status: vec![Status::Vertex; FIRST as usize],
            hints: vec![NONE; FIRST as usize],
            cells: Vec::with_capacity(cells),
            marks: Vec::with_capacity(cells),
            free: Vec::new(),
            dimension: None,
            unit: 1.0,
            exact_below: 1024.0 * 1024.0,
            has_weights: false,
            last: NONE,
            lodgers: Default::default(),
            twins: BTreeMap::new(),
            scratch: None,
            kernel: PhantomData,
        }
    }

    /// How many ids were given out; removed points count.
    pub fn point_count(&self) -> usize {
        self.places.len()
    }

    /// The point with its weight, also of a removed one.
    #[inline]
    pub fn point(&self, v: VertexId) -> WeightedPoint {
        self.sites[self.places[v.index()] as usize].0
    }

    /// What became of a point.
    pub fn state(&self, v: VertexId) -> PointState {
        let place = self.places[v.index()] as usize;
        match self.status[place] {
            Status::Vertex => PointState::Vertex,
            Status::Hidden => PointState::Hidden,
            Status::Duplicate => PointState::Duplicate { of: VertexId(self.ids[self.hints[place] as usize]) },
            Status::Removed => PointState::Removed,
        }
    }

    /// The dimension of the affine hull of the points; `None` without points.
    pub fn dimension(&self) -> Option<u8> {
        self.dimension
    }

    /// How many cells there are, ghosts and cells with apexes included.
    pub fn cell_count(&self) -> usize {
        self.cells.len() - self.free.len()
    }

    /// The cells by slot, ghosts and cells with apexes included.
    pub fn cells(&self) -> impl Iterator<Item = CellId> + '_ {
        (0u32..).zip(&self.cells).filter(|(_, c)| !c.is_free()).map(|(i, _)| CellId(i))
    }

    /// Whether the slot holds a cell.
    pub fn is_live(&self, c: CellId) -> bool {
        self.cells.get(c.0 as usize).is_some_and(|cell| !cell.is_free())
    }

    /// The vertices of a cell, positively oriented; the infinite one, if any, is the last.
    #[inline]
    pub fn vertices(&self, c: CellId) -> [VertexId; 4] {
        self.named(&self.cells[c.0 as usize])
    }

    /// Whether the cell has no infinite vertex. It may have apexes.
    #[inline]
    pub fn is_finite(&self, c: CellId) -> bool {
        !self.cells[c.0 as usize].is_ghost()
    }

    /// The cell beyond the facet opposite vertex i (0..4).
    #[inline]
    pub fn neighbor(&self, c: CellId, i: usize) -> CellId {
        CellId(self.cells[c.0 as usize].n[i] >> 2)
    }

    /// Which vertex of `neighbor(c, i)` is not on the common facet.
    #[inline]
    pub fn mirror_index(&self, c: CellId, i: usize) -> usize {
        (self.cells[c.0 as usize].n[i] & 3) as usize
    }

    /// Some cell that has the vertex v (perhaps a ghost); `None` if v is no vertex.
    pub fn cell_of(&self, v: VertexId) -> Option<CellId> {
        let place = self.places[v.index()] as usize;
        (self.status[place] == Status::Vertex).then(|| CellId(self.hints[place]))
    }

    /// A finite cell that contains the hidden point v; `None` if v is not hidden.
    pub fn containing_cell_of_hidden(&self, v: VertexId) -> Option<CellId> {
        let place = self.places[v.index()] as usize;
        (self.status[place] == Status::Hidden).then(|| CellId(self.hints[place]))
    }

    // Within the triangulation.

    #[inline]
    pub(super) fn named(&self, cell: &Cell) -> [VertexId; 4] {
        cell.v.map(|v| VertexId(self.ids[v as usize]))
    }

    #[inline]
    pub(super) fn site(&self, place: u32) -> WeightedPoint {
        self.sites[place as usize].0
    }

    #[inline]
    pub(super) fn corners(&self, cell: &Cell) -> WeightedCorners {
        cell.v.map(|v| self.sites[v as usize].0)
    }

    /// Gives a new point the next place; its id is to be set by the caller.
    pub(super) fn add_site(&mut self, p: WeightedPoint, id: u32) -> u32 {
        let place = self.sites.len() as u32;
        let site = Site::of(p);
        self.take_note_of(site.0);
        self.sites.push(site);
        self.ids.push(id);
        self.status.push(Status::Vertex);
        self.hints.push(NONE);
        place
    }

    /// Keeps true what is said of all points, that is `unit` and `has_weights`: a new point, or one with a new weight.
    ///
    /// The coordinates of p become multiples of the unit, its weight one of the square, unless that takes a unit too small to be of use.
    #[inline]
    pub(super) fn take_note_of(&mut self, p: WeightedPoint) {
        self.has_weights |= p.weight != 0.0;
        const SMALLEST: f64 = 1.0 / (1u64 << 40) as f64;
        let fits = |x: f64, unit: f64| (x / unit) as i64 as f64 == x / unit;
        while self.exact_below > 0.0
            && !(p.at.to_array().into_iter().all(|x| fits(x, self.unit)) && fits(p.weight, self.unit * self.unit))
        {
            self.unit /= 2.0;
            let reach = 1024.0 * self.unit;
            self.exact_below = if self.unit < SMALLEST { 0.0 } else { reach * reach };
        }
    }

    /// A slot to write to.
    #[inline]
    pub(super) fn take_slot(&mut self) -> u32 {
        if let Some(c) = self.free.pop() {
            return c;
        }
        let c = self.cells.len();
        assert!(c < 1 << 30, "a triangulation holds fewer than 2^30 cells");
        self.cells.push(Cell::FREE);
        self.marks.push(0);
        c as u32
    }

    /// Frees a slot.
    pub(super) fn release_slot(&mut self, c: u32) {
        self.cells[c as usize] = Cell::FREE;
        self.marks[c as usize] = 0;
        self.free.push(c);
    }
}
