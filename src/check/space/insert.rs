//! An insertion replayed: the star of the new vertex p on the rim of the cells destroyed, and the proof that the complex is again the triangulation of its vertices.
//!
//! Tested: (1) every facet of the rim makes a positively oriented tetrahedron with p, or a facet of the hull with it; (2) the rim is closed, and of the Euler
//! characteristic of a sphere; (3) p is on or beyond the plane of every facet of the hull that is destroyed; (4) the hull is convex at every edge of the new facets; (5) the
//! orthoball of a new tetrahedron holds neither of the corners opposite its facet of the rim, that of the cell destroyed there and that of the cell which stays;
//! (6) a vertex that is lost is hidden: p is in conflict with, or beyond, all cells at it.
//!
//! They suffice, by induction. Add up the tetrahedra destroyed and made, with signs: since what is made is the cone of p over the rim, the difference has the cones of p over the
//! destroyed facets of the hull for sum, which (3) makes disjoint from the old hull and each other. So with (1) everything is covered once, and by (4) the new body is
//! convex.
//!
//! **Lemma.** By (5) an orthoball of a new tetrahedron holds no vertex at all. *Proof.* Lift all points. Let F be the facet of the rim, a and b the corners opposite it of the old cells
//! on both sides, A and B the hyperplanes of these, and E that of the new tetrahedron. All three contain F. Since a is not below E, E is not above A on a's side of F, and likewise
//! not above B on b's side. No vertex is below A or B. So none is below E. If there is no a, F is a facet of the old hull, and all vertices are on b's side or in F's plane, where E and B are one;
//! likewise without b. ∎
//!
//! The lemma holds with perturbed lifts too. So the lifted complex is convex across the facets of new tetrahedra, and across others as before: it is the lower hull. A
//! vertex of (6) is not on it: from p through it one comes into the old one. Source: the pencil of balls through a facet, as in Joe (1991) and Edelsbrunner and Shah (1996).
//!
//! Under strict verification (5) is the definition itself: no orthoball of a new tetrahedron holds the far corner of any neighbor, old or new.

use super::certificate::{Ties, check_convex};
use super::complex::{Cell, Complex, FIRST, INFINITE, NONE, id};
use super::flood::{Flood, Flooded, Side};
use super::integers::Sight;
use super::predicates::{Corners, in_conflict, orient, side, tie_in_conflict};
use super::view::{Sphere, View};
use crate::check::verdict::{Checked, Rule, ensure};
use crate::model::{Sign, WeightedPoint};

/// An insertion in hand; lists are kept to be used again.
#[derive(Clone, Debug, Default)]
pub struct Cavity {
    /// What is destroyed.
    pub flood: Flood,
    view: View,
    sight: Sight,
    /// The cells made, one on each facet of the rim.
    made: Vec<u32>,
    /// A cell made at each vertex of the flood; `NONE` for those that are not on the rim.
    cell_at: Vec<u32>,
    links: Links,
}

impl Cavity {
    /// Makes the star of p, and proves it.
    pub fn star(&mut self, mesh: &mut Complex, p: u32, ties: Ties) -> Checked {
        self.check_hull_facets(mesh, mesh.point(p))?;
        self.make(mesh, p)?;
        self.check_rim()?;
        self.look(mesh, p);
        for k in 0..self.made.len() {
            let Side { corners, inner, .. } = self.flood.sides[k];
            let sphere = self.view.sphere(corners);
            if ties == Ties::Broken || !self.view.is_clear(&sphere, [inner, self.flood.beyond(k)]) {
                self.check_cell(mesh, p, k, &sphere, ties)?;
            }
        }
        Ok(())
    }

    /// The cells that `star` has made.
    pub fn made(&self) -> &[u32] {
        &self.made
    }

    /// (3).
    fn check_hull_facets(&self, mesh: &Complex, p: WeightedPoint) -> Checked {
        if self.flood.position(mesh, INFINITE) == NONE {
            return Ok(());
        }
        for f in self.flood.cells.taken() {
            let cell = f.cell();
            if let Some(k) = cell.find(INFINITE) {
                let [x, y, z] = cell.facet(k).map(|v| mesh.at(v));
                ensure(!orient(x, y, z, p.at).is_negative(), Rule::Hull, || {
                    ("a vertex beyond the facets of the hull that it destroys", format!("{:?}", cell.tuple()))
                })?;
            }
        }
        Ok(())
    }

    /// Writes the new cells, in slots of those destroyed first.
    fn make(&mut self, mesh: &mut Complex, p: u32) -> Checked {
        let Flood { cells, sides, vertices, .. } = &self.flood;
        self.made.clear();
        let cells = cells.taken();
        self.made.extend(cells.iter().map(|f| f.slot).take(sides.len()));
        cells.iter().skip(sides.len()).for_each(|f| mesh.release(f.slot));
        self.made.extend((self.made.len()..sides.len()).map(|_| mesh.reserve()));
        self.links.enter(sides, &self.made, vertices.taken().len())?;
        self.cell_at.clear();
        self.cell_at.resize(vertices.taken().len(), NONE);
        let mut closed = true;
        for (&Side { corners: [x, y, z], outer, .. }, &c) in sides.iter().zip(&self.made) {
            let beyond = [self.links.take(z, y), self.links.take(x, z), self.links.take(y, x), outer];
            closed &= !beyond.contains(&NONE);
            [x, y, z].iter().for_each(|&k| self.cell_at[k as usize] = c);
            let [x, y, z] = [x, y, z].map(|k| vertices.taken()[k as usize]);
            mesh.set(c, Cell { v: [x, y, z, p], beyond });
            mesh.set_beyond(outer, 4 * c + 3);
        }
        self.links.check_closed(closed)?;
        for (&v, &c) in vertices.taken().iter().zip(&self.cell_at) {
            mesh.set_cell_at(v, c);
        }
        // A cavity has a rim.
        mesh.set_cell_at(p, self.made.first().copied().unwrap_or(NONE));
        Ok(())
    }

    /// (2): each edge of the rim is in two facets by `Links`, so there are 3/2 edges a facet.
    fn check_rim(&self) -> Checked {
        let vertices = self.cell_at.iter().filter(|c| **c != NONE).count();
        ensure(2 * vertices == self.made.len() + 4, Rule::Star, || {
            ("a rim of the Euler characteristic 2", format!("{vertices} vertices, {} facets", self.made.len()))
        })
    }

    /// Sees from p what is around it.
    fn look(&mut self, mesh: &Complex, p: u32) {
        self.view.look(mesh.point(p), self.flood.surroundings(mesh), mesh.grain());
        self.sight.close();
    }

    /// (1), (4) and (5) for the new cell on a facet of the rim, and its orthoball.
    fn check_cell(&mut self, mesh: &Complex, p: u32, k: usize, sphere: &Sphere, ties: Ties) -> Checked {
        let Cavity { flood, view, sight, made, .. } = self;
        let (side, c) = (flood.sides[k], made[k]);
        let cell = mesh.cell(c);
        if !cell.is_finite() {
            return check_ghost(mesh, c);
        }
        let positive = view.orientation(sphere).unwrap_or_else(|| {
            let [x, y, z, p] = cell.v.map(|v| mesh.at(v));
            orient(x, y, z, p)
        });
        ensure(positive.is_positive(), Rule::Orientation, || {
            ("a positively oriented tetrahedron", format!("{:?}", cell.tuple()))
        })?;
        let mut ball = None;
        let mut check = |q: u32, position: u32| {
            if q == INFINITE {
                return Ok(());
            }
            let known = view.side(sphere, side.corners, position).or_else(|| {
                let ball = ball.get_or_insert_with(|| {
                    sight.open(mesh.point(p), || flood.surroundings(mesh));
                    sight.ball(side.corners)
                });
                sight.side(ball.as_ref()?, position)
            });
            check_empty(mesh, c, q, known, ties)
        };
        check(side.apex, flood.beyond(k))?;
        match ties {
            Ties::Free => check(flood.vertices.taken()[side.inner as usize], side.inner),
            Ties::Broken => {
                // Each facet within the star from one side.
                let mut inner = cell.beyond.iter().filter(|&&f| f >> 2 > c && f != side.outer);
                inner.try_for_each(|&f| check(mesh.apex(f), flood.position(mesh, mesh.apex(f))))
            }
        }
    }

    /// (6): adds every vertex that is no more to `lost`, having proved that it is hidden.
    pub fn check_lost(&self, mesh: &Complex, p: u32, ties: Ties, lost: &mut Vec<u32>) -> Checked {
        if !self.cell_at.contains(&NONE) {
            return Ok(());
        }
        let at = mesh.point(p);
        let is_lost = |v: &u32| mesh.cell_at(*v) == NONE;
        for f in self.flood.cells.taken() {
            let cell = f.cell();
            if !cell.v.iter().any(is_lost) {
                continue;
            }
            let hidden = match cell.find(INFINITE) {
                None => conflicts(cell.v.map(|v| mesh.point(v)), at, ties),
                Some(k) => self.hides_beyond(mesh, &cell, k, at, ties),
            };
            ensure(hidden, Rule::Hidden, || {
                ("all cells at a vertex that is lost in conflict", format!("{:?}", cell.tuple()))
            })?;
        }
        lost.extend(self.flood.vertices.taken().iter().copied().filter(is_lost));
        for &v in lost.iter() {
            ensure(v >= FIRST, Rule::Hull, || ("a hull, and apexes off it", format!("{:?} lost", id(v))))?;
            ensure(mesh.point(v) != at, Rule::Duplicate, || ("a duplicate", format!("{:?} hidden", id(v))))?;
        }
        Ok(())
    }

    /// Whether a destroyed facet of the hull is in conflict: p is beyond it, or in its plane and in conflict with the tetrahedron behind it, whose sphere cuts that plane in
    /// the circle of the facet.
    fn hides_beyond(&self, mesh: &Complex, cell: &Cell, k: usize, p: WeightedPoint, ties: Ties) -> bool {
        let [x, y, z] = cell.facet(k).map(|v| mesh.at(v));
        if orient(x, y, z, p.at) == Sign::Positive {
            return true;
        }
        let behind = cell.beyond[k] >> 2;
        let inner = self.flood.cells.taken().iter().find(|g| g.slot == behind).map(Flooded::cell);
        inner.is_some_and(|g| g.is_finite() && conflicts(g.v.map(|v| mesh.point(v)), p, ties))
    }
}

/// That q is not in conflict with a new tetrahedron; its side, if that is known.
#[inline]
fn check_empty(mesh: &Complex, c: u32, q: u32, known: Option<Sign>, ties: Ties) -> Checked {
    let side = known.unwrap_or_else(|| side(&mesh.corners(c), &mesh.point(q)));
    let conflict = match (side, ties) {
        (Sign::Zero, Ties::Broken) => tie_in_conflict(&mesh.corners(c), &mesh.point(q)),
        (side, _) => side.is_positive(),
    };
    ensure(!conflict, Rule::Regular, || {
        ("an orthoball empty of the next corner", format!("{:?} holds {:?}", mesh.cell(c).tuple(), id(q)))
    })
}

/// (4) for a new cell c beyond the hull: at the edge of the rim, k = 3, across which is an old cell, and at those that end at p, each from the smaller of its two new cells: the
/// hull is convex there seen from one of them iff it is seen from the other.
fn check_ghost(mesh: &Complex, c: u32) -> Checked {
    let cell = mesh.cell(c);
    let infinite = cell.find(INFINITE).unwrap_or(3);
    let finite = mesh.cell(cell.beyond[infinite] >> 2).is_finite();
    ensure(finite, Rule::Hull, || ("a tetrahedron at a facet of the hull", format!("{:?}", cell.tuple())))?;
    let once = |k: usize| k == 3 || cell.beyond[k] >> 2 > c;
    (0..4).filter(|&k| k != infinite && once(k)).try_for_each(|k| check_convex(mesh, c, k))
}

/// Whether a lost vertex's cell is in conflict; ties count if they are free.
fn conflicts(t: Corners, p: WeightedPoint, ties: Ties) -> bool {
    match ties {
        Ties::Free => !side(&t, &p).is_negative(),
        Ties::Broken => in_conflict(&t, &p),
    }
}

/// Rims of at most so many vertices are linked by a table.
const SMALL: usize = 64;

/// Finds what is across each edge of a rim.
#[derive(Clone, Debug)]
struct Links {
    /// For two positions in a small rim the facet, of the cell there, on the edge that leads from one to the other.
    table: Box<[u32; SMALL * SMALL]>,
    /// The same for a large rim, by ends.
    edges: Vec<([u32; 2], u32)>,
    is_small: bool,
}

impl Default for Links {
    fn default() -> Links {
        Links { table: Box::new([NONE; SMALL * SMALL]), edges: Vec::new(), is_small: true }
    }
}

impl Links {
    /// Takes up the edges of a rim of so many vertices, on each of whose facets a cell is made.
    fn enter(&mut self, sides: &[Side], made: &[u32], vertices: usize) -> Checked {
        self.is_small = vertices <= SMALL;
        if self.is_small {
            for (&Side { corners: [x, y, z], .. }, &c) in sides.iter().zip(made) {
                self.table[place(y, z)] = 4 * c;
                self.table[place(z, x)] = 4 * c + 1;
                self.table[place(x, y)] = 4 * c + 2;
            }
            return Ok(());
        }
        self.edges.clear();
        for (&Side { corners: [x, y, z], .. }, &c) in sides.iter().zip(made) {
            self.edges.extend([([y, z], 4 * c), ([z, x], 4 * c + 1), ([x, y], 4 * c + 2)]);
        }
        self.edges.sort_unstable();
        self.check_closed(self.edges.windows(2).all(|e| e[0].0 != e[1].0))
    }

    /// The facet on the edge that leads from one position to another, which is taken out of a table, or `NONE`. Were one entered twice, one would be missing.
    #[inline]
    fn take(&mut self, from: u32, to: u32) -> u32 {
        if self.is_small {
            return std::mem::replace(&mut self.table[place(from, to)], NONE);
        }
        self.edges.binary_search_by_key(&[from, to], |e| e.0).map_or(NONE, |k| self.edges[k].1)
    }

    /// If it was not, the table is made fit for use again.
    fn check_closed(&mut self, closed: bool) -> Checked {
        if !closed {
            self.table.fill(NONE);
        }
        ensure(closed, Rule::Star, || ("a closed rim, each edge in two facets", "an open one"))
    }
}

/// Where a pair of positions stands in the table.
#[inline]
fn place(from: u32, to: u32) -> usize {
    (from as usize * SMALL + to as usize) % (SMALL * SMALL)
}
