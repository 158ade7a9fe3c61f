//! The star of a new point: its cells replace the conflict zone.
//!
//! Every facet of the zone's boundary becomes a cell with the new point p as its apex. The boundary is a sphere of triangles, so
//! each of its edges lies on two facets, which pass it in opposite directions:
//!
//! ```text
//!            c                    the cell over facet abc: (a, b, c, p)
//!          /   \                  its facet opposite a holds the directed edge bc, opposite b the edge ca, opposite c the edge ab
//!        /  abc  \                over edge ab it meets the cell over the facet that passes the edge as ba
//!      a --------- b
//!        \  bad  /                so two sweeps glue the star: the first writes each facet's three directed edges into a
//!          \   /                  table, the second reads the three reversed ones
//!            d
//! ```
//!
//! The table is square over numbers that the boundary's vertices get on the spot (15 on average). A boundary with more vertices than it
//! has rows is glued by a hash table of its edges.

use super::numbers::Numbers;
use super::store::{Cell, INF, NONE, Regular3};
use crate::arith::space::Kernel3;

/// How many vertices the table has rows for.
const ROWS: usize = 64;

/// An empty slot of the hash table: no edge leads from a vertex to itself.
const NO_EDGE: u64 = u64::MAX;

/// A facet of the boundary of a conflict zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// Its vertices; with the new point fourth they are positively oriented.
    pub(super) v: [u32; 3],
    /// The cell outside, as a link.
    pub(super) outer: u32,
}

/// Work lists kept for reuse.
#[derive(Clone, Debug)]
pub(super) struct Scratch {
    /// The conflict zone in the order of its flood; after starring, the slots of the new cells, one for each facet of `rim`.
    pub(super) zone: Vec<u32>,
    /// The boundary of the zone.
    pub(super) rim: Vec<Rim>,
    /// Whether a ghost is in the zone. Only then a facet of the boundary may have the infinite vertex.
    pub(super) has_ghosts: bool,
    /// Cells to be tested.
    pub(super) candidates: Vec<u32>,
    /// Candidates that need a closer look, and whether the point is known to lie exactly on their sphere.
    pub(super) undecided: Vec<(u32, bool)>,
    pub(super) numbers: Numbers,
    /// Per pair of vertex numbers the link of the cell over the edge that leads from one to the other.
    table: Box<[u32; ROWS * ROWS]>,
    /// The numbers of the vertices of each facet.
    corners: Vec<[u8; 3]>,
    /// A hash table of edges, smaller vertex in the upper half, with links.
    edges: Vec<(u64, u32)>,
}

impl Default for Scratch {
    fn default() -> Self {
        Scratch {
            zone: Vec::new(),
            rim: Vec::new(),
            has_ghosts: false,
            candidates: Vec::new(),
            undecided: Vec::new(),
            numbers: Numbers::default(),
            table: Box::new([0; ROWS * ROWS]),
            corners: Vec::new(),
            edges: Vec::new(),
        }
    }
}

/// The turn that brings the infinite vertex of (v, p) to the end: corner k goes to k ^ turn. Such exchanges of two pairs are even.
#[inline(always)]
fn turn_of(v: [u32; 3]) -> u32 {
    (0u32..).zip(v).find(|&(_, x)| x == INF).map_or(0, |(k, _)| 3 ^ k)
}

/// A cell turned.
#[inline(always)]
pub(super) fn turned(cell: Cell, turn: u32) -> Cell {
    let corner = [0, 1, 2, 3].map(|k: u32| ((k ^ turn) & 3) as usize);
    Cell { v: corner.map(|k| cell.v[k]), n: corner.map(|k| cell.n[k]) }
}

impl<K: Kernel3> Regular3<K> {
    /// Makes room for numbers of all places up to now.
    pub(super) fn reserve_numbers(&self, s: &mut Scratch) {
        s.numbers.reserve(self.sites.len());
    }

    /// Replaces the conflict zone by the star of place p; returns a finite cell of it.
    pub(super) fn star(&mut self, p: u32, s: &mut Scratch) -> u32 {
        while s.zone.len() < s.rim.len() {
            s.zone.push(self.take_slot());
        }
        while s.zone.len() > s.rim.len()
            && let Some(c) = s.zone.pop()
        {
            self.release_slot(c);
        }
        let glued = if s.has_ghosts { self.glue::<true>(p, s) } else { self.glue::<false>(p, s) };
        s.numbers.clear();
        if glued.is_none() {
            self.glue_by_hashing(p, s);
        }
        if !s.has_ghosts {
            return s.zone[0];
        }
        // The star of a point has finite cells: the boundary of its zone is not all at infinity.
        s.zone.iter().copied().find(|&c| !self.cells[c as usize].is_ghost()).unwrap_or(s.zone[0])
    }

    /// Writes the new cells, one over each facet of the boundary; `None` if there are too many vertices.
    #[inline(never)]
    fn glue<const GHOSTS: bool>(&mut self, p: u32, s: &mut Scratch) -> Option<()> {
        let Scratch { zone, rim, numbers, table, corners, .. } = s;
        corners.clear();
        for (facet, &t) in rim.iter().zip(zone.iter()) {
            let turn = if GHOSTS { turn_of(facet.v) } else { 0 };
            let [a, b, c] = [numbers.of(facet.v[0])?, numbers.of(facet.v[1])?, numbers.of(facet.v[2])?];
            table[(b * ROWS + c) % (ROWS * ROWS)] = 4 * t + turn;
            table[(c * ROWS + a) % (ROWS * ROWS)] = 4 * t + (1 ^ turn);
            table[(a * ROWS + b) % (ROWS * ROWS)] = 4 * t + (2 ^ turn);
            corners.push([a as u8, b as u8, c as u8]);
            let outer = (facet.outer >> 2) as usize;
            self.cells[outer].n[(facet.outer & 3) as usize] = 4 * t + (3 ^ turn);
            self.marks[outer] = 0;
        }
        if numbers.vertices().len() > ROWS {
            return None;
        }
        for ((facet, &t), corners) in rim.iter().zip(zone.iter()).zip(corners.iter()) {
            let [a, b, c] = corners.map(usize::from);
            let read = |from: usize, to: usize| table[(from * ROWS + to) % (ROWS * ROWS)];
            let [x, y, z] = facet.v;
            let cell = Cell { v: [x, y, z, p], n: [read(c, b), read(a, c), read(b, a), facet.outer] };
            self.cells[t as usize] = if GHOSTS { turned(cell, turn_of(facet.v)) } else { cell };
            self.marks[t as usize] = 0;
        }
        Some(())
    }

    /// The same for any number of vertices.
    #[cold]
    fn glue_by_hashing(&mut self, p: u32, s: &mut Scratch) {
        // Edges with the link of the facet met first. Half of the slots are taken at most: each edge is met twice.
        let size = (3 * s.rim.len()).next_power_of_two();
        s.edges.clear();
        s.edges.resize(size, (NO_EDGE, NONE));
        for (facet, &t) in s.rim.iter().zip(&s.zone) {
            let turn = turn_of(facet.v);
            let [a, b, c] = facet.v;
            let cell = Cell { v: [a, b, c, p], n: [NONE, NONE, NONE, facet.outer] };
            self.cells[t as usize] = turned(cell, turn);
            self.marks[t as usize] = 0;
            let outer = (facet.outer >> 2) as usize;
            self.cells[outer].n[(facet.outer & 3) as usize] = 4 * t + (3 ^ turn);
            self.marks[outer] = 0;
            for (k, (x, y)) in (0u32..).zip([(b, c), (c, a), (a, b)]) {
                let edge = u64::from(x.min(y)) << 32 | u64::from(x.max(y));
                let link = 4 * t + (k ^ turn);
                // Fibonacci hashing: the high bits of the product (Knuth, volume 3, 6.4).
                let mut slot = (edge.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize & (size - 1);
                while s.edges[slot].0 != edge && s.edges[slot].0 != NO_EDGE {
                    slot = (slot + 1) & (size - 1);
                }
                match s.edges[slot] {
                    (NO_EDGE, _) => s.edges[slot] = (edge, link),
                    (_, other) => self.link(link, other),
                }
            }
        }
    }

    /// Glues two facets, each named by its cell and opposite corner.
    pub(super) fn link(&mut self, one: u32, other: u32) {
        self.cells[(one >> 2) as usize].n[(one & 3) as usize] = other;
        self.cells[(other >> 2) as usize].n[(other & 3) as usize] = one;
    }
}
