//! An insertion replayed: the cavity, the star of the new vertex, and the proof that the complex is again the triangulation of its vertices.
//!
//! Tested: (1) every facet of the cavity's rim makes a positively oriented tetrahedron with p, or a facet of the hull with it; (2) the rim is closed, and of the Euler
//! characteristic of a sphere; (3) p is on or beyond the plane of every facet of the hull that is destroyed; (4) the hull is convex at every edge of the new facets; (5) no new
//! tetrahedron has a neighbor's corner in conflict with it; (6) a vertex that is lost is hidden: p is in conflict with, or beyond, all cells at it.
//!
//! They suffice, by induction. Add up the tetrahedra destroyed and made, with signs: since what is made is the cone of p over the rim, the difference has the cones of p over the
//! destroyed facets of the hull for sum, which (3) makes disjoint from the old hull and each other. So with (1) everything is covered once. By (4) the new body is
//! convex, by (5) the lifted complex is. A vertex of (6) is on no lower hull: from p through it one comes into the old one.

use super::ball::{Ball, Row, near_side};
use super::certificate::{Ties, check_convex};
use super::complex::{Cell, Complex, FIRST, INFINITE, NONE, id};
use super::predicates::{Corners, in_conflict, orient, side, tie_in_conflict};
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::{Sign, Tetrahedron, WeightedPoint};
use crate::trace::Bits;

/// A cell of the cavity. Its tuple, in the order of the flood: the first cell's is canonical; a cell entered through a facet has the tuple of the cell before, the corner it
/// does not share replaced by its own.
#[derive(Clone, Copy, Debug)]
pub struct Flooded {
    /// What it was.
    pub cell: Cell,
    /// Where it was.
    pub slot: u32,
    /// Where each member of the tuple stands among the corners.
    order: [u8; 4],
    /// The member opposite the facet it was entered by; 4 for the first.
    entry: u8,
}

/// A vertex of the cavity's rim, seen from the new vertex.
#[derive(Clone, Copy, Debug)]
struct Rim {
    vertex: u32,
    row: Row,
    cell: u32,
}

/// A facet of the cavity's rim.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Its corners, as positions in the rim, turned such that (side, p) is positive.
    local: [u32; 3],
    /// The facet beyond.
    outer: u32,
    /// The cell made on it.
    cell: u32,
}

/// Lists of an event in hand; kept to be used again.
#[derive(Clone, Debug, Default)]
pub struct Cavity {
    /// The cells destroyed, in flood order.
    pub flooded: Vec<Flooded>,
    sides: Vec<Side>,
    rim: Vec<Rim>,
    /// For two positions in a small rim the facet that waits for its other side there.
    table: Vec<u32>,
    /// The same for a large rim: ends, whether it leads from the larger to the smaller, facet.
    edges: Vec<(u32, u32, bool, u32)>,
    /// For each facet of the rim, and each corner of it, the facet across from that corner and the corner it has instead: 4 facet + corner.
    across: Vec<[u32; 3]>,
}

/// Rims of at most so many vertices are linked by a table.
const SMALL: usize = 64;

impl Cavity {
    /// Takes the cells that a flood code names out of the complex.
    pub fn flood(&mut self, mesh: &mut Complex, first: u32, tuple: [u32; 4], bits: &Bits) -> Checked {
        self.flooded.clear();
        self.sides.clear();
        let cell = mesh.take(first);
        let order = tuple.map(|v| cell.find(v).unwrap_or(0) as u8);
        self.flooded.push(Flooded { cell, slot: first, order, entry: 4 });
        let (mut at, mut read) = (0, 0);
        while at < self.flooded.len() {
            let here = self.flooded[at];
            for position in 0..4 {
                let corner = usize::from(here.order[position]);
                let outer = here.cell.beyond[corner];
                if position == usize::from(here.entry) || !mesh.lives(outer >> 2) {
                    continue;
                }
                let Some(destroyed) = bits.get(read) else {
                    return broken(Rule::Flood, "a bit for each facet of the flood", format!("{} bits", bits.len()));
                };
                read += 1;
                if destroyed {
                    self.enter(mesh, &here, position, outer);
                } else {
                    self.sides.push(Side { local: here.cell.facet(corner), outer, cell: here.slot });
                }
            }
            at += 1;
        }
        ensure(read == bits.len(), Rule::Flood, || (format!("{read} bits"), format!("{}", bits.len())))?;
        // A cell that one facet was to stop at may have been entered through another.
        let stops = self.sides.iter().all(|side| mesh.lives(side.outer >> 2));
        ensure(stops, Rule::Flood, || ("a flood that stops where it says", "a cell beyond its rim destroyed"))
    }

    fn enter(&mut self, mesh: &mut Complex, from: &Flooded, position: usize, through: u32) {
        let slot = through >> 2;
        let cell = mesh.take(slot);
        let mut order = [(through & 3) as u8; 4];
        for other in (0..4).filter(|&p| p != position) {
            let v = from.cell.v[usize::from(from.order[other])];
            // Neighbors share the corners of their facet.
            order[other] = cell.find(v).unwrap_or(0) as u8;
        }
        self.flooded.push(Flooded { cell, slot, order, entry: position as u8 });
    }

    /// Of the cells destroyed the last one in canonical order.
    pub fn last(&self) -> Option<Tetrahedron> {
        self.flooded.iter().map(|f| f.cell.tuple()).max()
    }

    /// Makes the star of p, and proves it.
    pub fn star(&mut self, mesh: &mut Complex, p: u32, ties: Ties) -> Checked {
        let at = mesh.point(p);
        self.check_hull_facets(mesh, at)?;
        self.make(mesh, p, at)?;
        self.link(mesh, p)?;
        self.check_rim()?;
        self.check_star(mesh, at, ties)
    }

    /// The cells that `star` has made.
    pub fn made(&self) -> impl Iterator<Item = u32> + '_ {
        self.sides.iter().map(|side| side.cell)
    }

    /// (3).
    fn check_hull_facets(&self, mesh: &Complex, p: WeightedPoint) -> Checked {
        for f in &self.flooded {
            if let Some(k) = f.cell.find(INFINITE) {
                let [x, y, z] = f.cell.facet(k).map(|v| mesh.at(v));
                ensure(!orient(x, y, z, p.at).is_negative(), Rule::Hull, || {
                    ("a vertex beyond the facets of the hull that it destroys", format!("{:?}", f.cell.tuple()))
                })?;
            }
        }
        Ok(())
    }

    /// Numbers the rim, and gives each of its facets a slot for the cell on it: those of the cells destroyed first.
    fn make(&mut self, mesh: &mut Complex, p: u32, at: WeightedPoint) -> Checked {
        self.rim.clear();
        // Slots that are not used up stay ready; those next in line come last on the stack.
        self.flooded.iter().rev().for_each(|f| mesh.release(f.slot));
        for side in &mut self.sides {
            side.cell = mesh.reserve();
            for v in &mut side.local {
                let known = mesh.local(*v);
                let held = self.rim.get(known as usize).is_some_and(|r| r.vertex == *v);
                let position = if held { known } else { self.rim.len() as u32 };
                if !held {
                    mesh.set_local(*v, position);
                    let row = if *v == INFINITE { Row::default() } else { Row::new(at, mesh.point(*v)) };
                    self.rim.push(Rim { vertex: *v, row, cell: side.cell });
                }
                *v = position;
            }
        }
        for r in &self.rim {
            mesh.set_cell_at(r.vertex, r.cell);
        }
        let Some(side) = self.sides.first() else {
            return broken(Rule::Flood, "a cavity with a rim", "none");
        };
        mesh.set_cell_at(p, side.cell);
        Ok(())
    }

    /// Finds what is across each edge of the rim, and writes the new cells.
    fn link(&mut self, mesh: &mut Complex, p: u32) -> Checked {
        self.across.clear();
        self.across.resize(self.sides.len(), [NONE; 3]);
        if self.rim.len() <= SMALL {
            self.match_by_table()?
        } else {
            self.match_by_order()?
        }
        for (side, across) in self.sides.iter().zip(&self.across) {
            let [x, y, z] = side.local.map(|r| self.rim[r as usize].vertex);
            let [u, v, w] = across.map(|a| 4 * self.sides[(a >> 2) as usize].cell + (a & 3));
            mesh.set(side.cell, Cell { v: [x, y, z, p], beyond: [u, v, w, side.outer] });
            mesh.set_beyond(side.outer, 4 * side.cell + 3);
        }
        Ok(())
    }

    fn match_by_table(&mut self) -> Checked {
        self.table.resize(SMALL * SMALL, NONE);
        for (i, side) in (0u32..).zip(&self.sides) {
            let [x, y, z] = side.local;
            for (k, u, w) in [(0, y, z), (1, z, x), (2, x, y)] {
                let own = &mut self.table[u as usize * SMALL + w as usize];
                ensure(*own == NONE, Rule::Star, || ("an edge of the rim in two facets", "in more"))?;
                *own = 4 * i + k;
            }
        }
        let mut open = 0;
        for (side, across) in self.sides.iter().zip(&mut self.across) {
            let [x, y, z] = side.local;
            for (across, (u, w)) in across.iter_mut().zip([(y, z), (z, x), (x, y)]) {
                *across = self.table[w as usize * SMALL + u as usize];
                open += u32::from(*across == NONE);
            }
        }
        for side in &self.sides {
            let [x, y, z] = side.local;
            for (u, w) in [(y, z), (z, x), (x, y)] {
                self.table[u as usize * SMALL + w as usize] = NONE;
            }
        }
        ensure(open == 0, Rule::Star, || ("a closed rim", format!("{open} open edges")))
    }

    fn match_by_order(&mut self) -> Checked {
        self.edges.clear();
        for (i, side) in (0u32..).zip(&self.sides) {
            let [x, y, z] = side.local;
            for (k, u, w) in [(0, y, z), (1, z, x), (2, x, y)] {
                self.edges.push((u.min(w), u.max(w), u > w, 4 * i + k));
            }
        }
        self.edges.sort_unstable();
        for same in self.edges.chunk_by(|e, f| (e.0, e.1) == (f.0, f.1)) {
            match *same {
                [(_, _, false, e), (_, _, true, f)] => {
                    self.across[(e >> 2) as usize][(e & 3) as usize] = f;
                    self.across[(f >> 2) as usize][(f & 3) as usize] = e;
                }
                _ => return broken(Rule::Star, "an edge of the rim in two facets", format!("in {}", same.len())),
            }
        }
        Ok(())
    }

    /// (2): each edge of the rim is in two facets by `link`, so there are 3/2 edges a facet.
    fn check_rim(&self) -> Checked {
        ensure(2 * self.rim.len() == self.sides.len() + 4, Rule::Star, || {
            ("a rim of the Euler characteristic 2", format!("{} vertices, {} facets", self.rim.len(), self.sides.len()))
        })
    }

    /// (1), (4), (5).
    fn check_star(&self, mesh: &Complex, p: WeightedPoint, ties: Ties) -> Checked {
        for (i, (side, across)) in (0u32..).zip(self.sides.iter().zip(&self.across)) {
            let corners = side.local.map(|r| &self.rim[r as usize]);
            if corners.iter().any(|r| r.vertex == INFINITE) {
                check_ghost(mesh, side.cell)?;
                continue;
            }
            let ball = Ball::new(&corners[0].row, &corners[1].row, &corners[2].row);
            let positive = ball.orientation().unwrap_or_else(|| {
                let [x, y, z] = corners.map(|r| mesh.at(r.vertex));
                orient(x, y, z, p.at)
            });
            ensure(positive.is_positive(), Rule::Orientation, || {
                ("a positively oriented tetrahedron", format!("{:?}", mesh.cell(side.cell).tuple()))
            })?;
            let empty_of = |q: u32, row: &Row| self.check_empty(mesh, side.cell, &ball, q, row, ties);
            let beyond = mesh.apex(side.outer);
            if beyond != INFINITE {
                empty_of(beyond, &Row::new(p, mesh.point(beyond)))?;
            }
            // Facets within the star are tested from one side.
            for &other in across.iter().filter(|&&a| a >> 2 > i) {
                let apex = &self.rim[self.sides[(other >> 2) as usize].local[(other & 3) as usize] as usize];
                if apex.vertex != INFINITE {
                    empty_of(apex.vertex, &apex.row)?;
                }
            }
        }
        Ok(())
    }

    /// That q, seen as `row`, is not in conflict with a new tetrahedron.
    #[inline]
    fn check_empty(&self, mesh: &Complex, c: u32, ball: &Ball, q: u32, row: &Row, ties: Ties) -> Checked {
        let side = ball.side(row).unwrap_or_else(|| near_side(ball, &mesh.corners(c), &mesh.point(q)));
        let conflict = match (side, ties) {
            (Sign::Zero, Ties::Broken) => tie_in_conflict(&mesh.corners(c), &mesh.point(q)),
            (side, _) => side.is_positive(),
        };
        ensure(!conflict, Rule::Regular, || {
            ("an orthoball empty of the next corner", format!("{:?} holds {:?}", mesh.cell(c).tuple(), id(q)))
        })
    }

    /// (6): calls `lost` with every vertex that is no more, having proved that it is hidden. Not with `p`, should it have been a vertex before.
    pub fn check_lost(&self, mesh: &mut Complex, p: u32, ties: Ties, mut lost: impl FnMut(u32)) -> Checked {
        let at = mesh.point(p);
        for f in &self.flooded {
            if !f.cell.v.iter().any(|&v| v != p && !self.on_rim(mesh, v)) {
                continue;
            }
            let hidden = match f.cell.find(INFINITE) {
                None => conflicts(f.cell.v.map(|v| mesh.point(v)), at, ties),
                Some(k) => self.hides_beyond(mesh, f, k, at, ties),
            };
            ensure(hidden, Rule::Hidden, || {
                ("all cells at a vertex that is lost in conflict", format!("{:?}", f.cell.tuple()))
            })?;
            for v in f.cell.v {
                if v == p || self.on_rim(mesh, v) || mesh.cell_at(v) == NONE {
                    continue;
                }
                ensure(v >= FIRST, Rule::Hull, || ("a hull, and apexes off it", format!("{:?} lost", id(v))))?;
                mesh.set_cell_at(v, NONE);
                lost(v);
            }
        }
        Ok(())
    }

    fn on_rim(&self, mesh: &Complex, v: u32) -> bool {
        self.rim.get(mesh.local(v) as usize).is_some_and(|r| r.vertex == v)
    }

    /// Whether a destroyed facet of the hull is in conflict: p is beyond it, or in its plane and in conflict with the tetrahedron behind it, whose sphere cuts that plane in
    /// the circle of the facet.
    fn hides_beyond(&self, mesh: &Complex, f: &Flooded, k: usize, p: WeightedPoint, ties: Ties) -> bool {
        let [x, y, z] = f.cell.facet(k).map(|v| mesh.at(v));
        if orient(x, y, z, p.at) == Sign::Positive {
            return true;
        }
        let behind = f.cell.beyond[k] >> 2;
        let inner = self.flooded.iter().find(|g| g.slot == behind);
        inner.is_some_and(|g| g.cell.is_finite() && conflicts(g.cell.v.map(|v| mesh.point(v)), p, ties))
    }
}

/// (4) for one cell beyond the hull.
fn check_ghost(mesh: &Complex, c: u32) -> Checked {
    let cell = mesh.cell(c);
    let infinite = cell.find(INFINITE).unwrap_or(3);
    let finite = mesh.cell(cell.beyond[infinite] >> 2).is_finite();
    ensure(finite, Rule::Hull, || ("a tetrahedron at a facet of the hull", format!("{:?}", cell.tuple())))?;
    (0..4).filter(|&k| k != infinite).try_for_each(|k| check_convex(mesh, c, k))
}

/// Whether a lost vertex's cell is in conflict; ties count if they are free.
fn conflicts(t: Corners, p: WeightedPoint, ties: Ties) -> bool {
    match ties {
        Ties::Free => !side(&t, &p).is_negative(),
        Ties::Broken => in_conflict(&t, &p),
    }
}
