//! What one thread does: it triangulates a part with its halo, and sorts the cells.
//!
//! Cells that are not sure are those that some point outside of the box with its halo may be in conflict with. The conflict zone of such a
//! point is connected and has a ghost, as the point lies beyond the hull, and ghosts are connected: a flood from one of them finds all cells that
//! are not sure, and only their neighbors are looked at.

use super::super::store::{Cell, FIRST, NONE, Regular3, Status};
use super::Surroundings;
use super::cut::Part;
use crate::arith::space::Kernel3;
use crate::model::{Point3, VertexId, WeightedPoint, canonical_tetrahedron};

/// What a thread has found.
#[derive(Debug, Default)]
pub(super) struct Piece {
    /// The ids of the points of the box, in the order of their places.
    pub(super) order: Vec<u32>,
    /// Pairs of a duplicate and the id that stands for it.
    pub(super) twins: Vec<[u32; 2]>,
    /// Ids of corners of cells that are not sure, ascending.
    pub(super) torn: Vec<u32>,
    /// The cells of the triangulation of box and halo.
    pub(super) cells: Vec<Cell>,
    /// Per cell what it is: `INNER` and others.
    pub(super) kinds: Vec<u8>,
    /// The slots that hold no inner cell.
    pub(super) free: Vec<u32>,
    /// Sure cells with corners inside and outside of the box.
    pub(super) mixed: Vec<Mixed>,
    /// Links to inner cells from cells that are not sure.
    pub(super) open: Vec<u32>,
    /// Per place of the triangulation the position in `order`, or `NONE`.
    pub(super) rank: Vec<u32>,
    /// Per point of `order` an inner cell that has it, or `NONE`.
    pub(super) hints: Vec<u32>,
    /// What is known of all points: see `Regular3`.
    pub(super) unit: f64,
    pub(super) exact_below: f64,
    pub(super) has_weights: bool,
}

/// A sure cell that other threads may have as well. Its corners are stored in the canonical order of `ids`, so that corner k is the same to all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Mixed {
    pub(super) ids: [u32; 4],
    pub(super) cell: u32,
}

/// A cell that is not sure.
const TORN: u8 = 1;
/// A cell that was looked at and is sure. So are those that were not looked at.
const SURE: u8 = 2;
/// A sure cell that has all corners in the box.
pub(super) const INNER: u8 = 3;

/// Triangulates a part with its halo, and sorts the cells. There is room for the cells of `room` points.
pub(super) fn piece<K: Kernel3>(points: &[WeightedPoint], part: &Part, all: &Surroundings, room: usize) -> Piece {
    let (mut ids, mut halo) = (Vec::new(), Vec::new());
    for (id, p) in (0u32..).zip(points).filter(|(_, p)| part.reaches(p.at)) {
        if part.has(p.at) { ids.push(id) } else { halo.push(id) }
    }
    let own = ids.len() as u32;
    ids.append(&mut halo);
    let local: Vec<WeightedPoint> = ids.iter().map(|&id| points[id as usize]).collect();
    let mut t = Regular3::<K>::build_unsettled(&local, local.len().max(room));
    drop(local);
    t.mark_torn(part, all);
    sort_cells(t, &ids, own)
}

/// Sorts the cells of a part's triangulation; its points have the given ids, the first `own` of them lie in its box.
fn sort_cells<K: Kernel3>(mut t: Regular3<K>, ids: &[u32], own: u32) -> Piece {
    let mut piece = Piece { unit: t.unit, exact_below: t.exact_below, has_weights: t.has_weights, ..Piece::default() };
    piece.rank = vec![NONE; t.sites.len()];
    for place in FIRST as usize..t.sites.len() {
        if t.ids[place] < own {
            piece.rank[place] = piece.order.len() as u32;
            piece.order.push(ids[t.ids[place] as usize]);
            if t.status[place] == Status::Duplicate {
                piece.twins.push([ids[t.ids[place] as usize], ids[t.ids[t.hints[place] as usize] as usize]]);
            }
        }
    }
    piece.hints = vec![NONE; piece.order.len()];
    if t.dimension != Some(3) {
        piece.torn.clone_from(&piece.order);
        piece.torn.sort_unstable();
        return piece;
    }
    let id = |v: u32| ids[t.ids[v as usize] as usize];
    let mut torn = Vec::new();
    for (c, (cell, kind)) in (0u32..).zip(t.cells.iter().zip(&mut t.marks)) {
        if cell.is_free() {
            piece.free.push(c);
            continue;
        }
        let ranks = cell.v.map(|v| piece.rank[v as usize]);
        let inside = ranks.iter().filter(|&&rank| rank != NONE).count();
        if inside == 4 && *kind != TORN {
            *kind = INNER;
            ranks.iter().for_each(|&rank| piece.hints[rank as usize] = c);
            continue;
        }
        piece.free.push(c);
        if inside > 0 && *kind == TORN {
            torn.push(c);
        } else if inside > 0 {
            let ids = canonical_tetrahedron(cell.v.map(|v| VertexId(id(v)))).map(|v| v.0);
            piece.mixed.push(Mixed { ids, cell: c });
        }
    }
    for cell in torn.iter().map(|&c| &t.cells[c as usize]) {
        piece.torn.extend(cell.v.iter().filter(|&&v| v >= FIRST).map(|&v| id(v)));
        piece.open.extend(cell.n.iter().filter(|&&link| t.marks[(link >> 2) as usize] == INNER));
    }
    piece.torn.sort_unstable();
    piece.torn.dedup();
    (piece.cells, piece.kinds) = (t.cells, t.marks);
    for &Mixed { ids: order, cell } in &piece.mixed {
        let v = piece.cells[cell as usize].v.map(id);
        reorder(&mut piece.cells, cell, order.map(|x| v.iter().position(|&y| y == x).unwrap_or(0)));
    }
    piece.mixed.sort_unstable();
    piece
}

/// Puts the corners of a cell in another order: corner k is to be the one that is `from[k]` now.
fn reorder(cells: &mut [Cell], c: u32, from: [usize; 4]) {
    let Cell { v, n } = cells[c as usize];
    cells[c as usize] = Cell { v: from.map(|k| v[k]), n: from.map(|k| n[k]) };
    for (k, link) in (0u32..).zip(from.map(|k| n[k])) {
        cells[(link >> 2) as usize].n[(link & 3) as usize] = 4 * c + k;
    }
}

impl<K: Kernel3> Regular3<K> {
    /// Marks the cells that are not sure.
    fn mark_torn(&mut self, part: &Part, all: &Surroundings) {
        let mut next: Vec<u32> = Vec::new();
        if let Some(ghost) = self.cells.iter().position(Cell::is_ghost) {
            self.marks[ghost] = TORN;
            next.push(ghost as u32);
        }
        while let Some(c) = next.pop() {
            for link in self.cells[c as usize].n {
                let beyond = (link >> 2) as usize;
                if self.marks[beyond] != 0 {
                    continue;
                }
                self.marks[beyond] = SURE;
                let cell = &self.cells[beyond];
                if cell.is_ghost() || !self.keeps_inside(cell, part, all) {
                    self.marks[beyond] = TORN;
                    next.push(link >> 2);
                }
            }
        }
    }

    /// Whether the orthoball of a finite cell, so large that points of the largest weight outside of it are in no conflict, keeps inside of the part
    /// within the box of all points: an estimate, with a small margin.
    fn keeps_inside(&self, cell: &Cell, part: &Part, all: &Surroundings) -> bool {
        let [p0, p1, p2, p3] = self.corners(cell);
        let [a, b, c] = [p1, p2, p3].map(|p| p.at - p0.at);
        let height = |v: Point3, p: WeightedPoint| v.length_squared() + p0.weight - p.weight;
        let offset = (height(a, p1) * b.cross(c) + height(b, p2) * c.cross(a) + height(c, p3) * a.cross(b))
            / (2.0 * a.dot(b.cross(c)));
        let center = p0.at + offset;
        let radius2 = (offset.length_squared() - p0.weight + all.heaviest) * (1.0 + 1e-6);
        if !radius2.is_finite() {
            return false;
        }
        // How far the center is outside the box of all points, along each axis.
        let out = (all.low - center).max(center - all.high).max(Point3::ZERO);
        let out2 = out * out;
        (0..3).all(|i| {
            let half2 = radius2 - (out2.x + out2.y + out2.z - out2[i]);
            half2 <= 0.0 || {
                let half = half2.sqrt();
                center[i] - half > part.outer_low[i] && center[i] + half < part.outer_high[i]
            }
        })
    }
}
