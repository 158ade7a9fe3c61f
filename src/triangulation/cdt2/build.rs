//! The Delaunay triangulation of points, all at once.
//!
//! Points are inserted one by one in a spatial order (`spatial`), found by a walk from the last one. While building, every hull
//! edge carries a ghost triangle with the infinite vertex, so that a point outside is inserted like any other: a ghost is in
//! conflict with the points strictly beyond its edge or strictly inside it. (A point on the hull edge's line outside the edge is
//! outside the circle of the triangle behind, so no tie can occur there.)
//! Points are renumbered along the spatial order while building, for locality.

use super::BuildError;
use super::store::{Cdt2, Link, NONE, PRED, SUCC, Slot};
use crate::arith::Kernel;
use crate::arith::perturb::lexicographic;
use crate::model::{Point2, Sign, VertexId};
use std::cmp::Ordering;
use std::marker::PhantomData;

/// The infinite vertex; always corner 2 of a ghost.
const INFINITE: u32 = NONE;

/// A triangle or ghost under construction, with the half-edges on the other sides.
#[derive(Clone, Copy)]
struct Cell {
    v: [u32; 3],
    twin: [u32; 3],
}

struct Builder<K: Kernel> {
    points: Vec<Point2>,
    cells: Vec<Cell>,
    /// Half-edges that the flood will cross, seen from beyond.
    stack: Vec<u32>,
    /// Cells of the conflict zone.
    zone: Vec<u32>,
    /// Boundary of the cavity, counterclockwise: first vertex of the edge, half-edge outside.
    rim: Vec<(u32, u32)>,
    kernel: PhantomData<K>,
}

/// A point that was there already.
struct Repeated;

impl<K: Kernel> Cdt2<K> {
    /// The Delaunay triangulation of the points; at least 3 not on a line, all distinct (else an error naming ids).
    ///
    /// The triangles fill the convex hull. Births and regions are 0.
    pub fn delaunay(points: Vec<Point2>) -> Result<Self, BuildError> {
        let order = crate::triangulation::spatial::insertion_order(&points);
        let sorted: Vec<Point2> = order.iter().map(|&i| points[i as usize]).collect();
        let collinear = || duplicate(&points).unwrap_or(BuildError::Collinear);
        let mut builder = Builder::<K>::start(sorted).ok_or_else(collinear)?;
        if builder.insert_all().is_err() {
            // The walk met equal points, so the search finds some.
            return Err(duplicate(&points).unwrap_or(BuildError::Collinear));
        }
        let slots = builder.finish(&order);
        let mut hints = vec![NONE; points.len()];
        for (t, slot) in (0u32..).zip(&slots) {
            for k in 0..3 {
                hints[slot.v[k as usize] as usize] = 4 * t + k;
            }
        }
        let labels = vec![[NONE; 3]; slots.len()];
        Ok(Cdt2 {
            points,
            hints,
            slots,
            labels,
            free: Vec::new(),
            outside: 0,
            clock: 0,
            journal: Default::default(),
            scratch: Default::default(),
            kernel: PhantomData,
        })
    }
}

/// The lexicographically smallest pair of ids with equal coordinates.
fn duplicate(points: &[Point2]) -> Option<BuildError> {
    let mut ids: Vec<u32> = (0u32..).zip(points).map(|(i, _)| i).collect();
    ids.sort_by(|&a, &b| lexicographic(points[a as usize], points[b as usize]).then(a.cmp(&b)));
    let equal = ids.windows(2).filter(|w| points[w[0] as usize] == points[w[1] as usize]);
    let (a, b) = equal.map(|w| (w[0], w[1])).min()?;
    Some(BuildError::Duplicate(VertexId(a), VertexId(b)))
}

impl<K: Kernel> Builder<K> {
    /// The triangle of the first two points and the first one off their line, with its three ghosts. That point moves to place 2.
    fn start(points: Vec<Point2>) -> Option<Self> {
        let (&a, &b) = (points.first()?, points.get(1)?);
        let off = (2..points.len()).find(|&i| K::orient2d(a, b, points[i]) != Sign::Zero)?;
        let v = match K::orient2d(a, b, points[off]) {
            Sign::Negative => [1, 0, off as u32],
            _ => [0, 1, off as u32],
        };
        let mut cells = Vec::with_capacity(2 * points.len() + 2);
        cells.push(Cell { v, twin: [4, 8, 12] });
        for k in 0..3u32 {
            // Ghost k + 1 over edge k. Its edge 1 leads to the infinite vertex from the start of edge k.
            let [x, y] = [v[k as usize], v[SUCC[k as usize] as usize]];
            let before = 4 * (PRED[k as usize] + 1);
            let after = 4 * (SUCC[k as usize] + 1);
            cells.push(Cell { v: [y, x, INFINITE], twin: [k, before + 2, after + 1] });
        }
        let (stack, zone, rim) = (Vec::new(), Vec::new(), Vec::new());
        Some(Builder { points, cells, stack, zone, rim, kernel: PhantomData })
    }

    fn insert_all(&mut self) -> Result<(), Repeated> {
        let off = self.cells[0].v[2];
        let mut near = 0;
        for i in 2..self.points.len() as u32 {
            if i != off {
                near = self.insert(i, near)?;
            }
        }
        Ok(())
    }

    /// Inserts point number `i`, searched from cell `near`; returns a finite triangle at it.
    fn insert(&mut self, i: u32, near: u32) -> Result<u32, Repeated> {
        let q = self.points[i as usize];
        let root = self.walk(near, q)?;
        self.flood(root, q);
        Ok(self.star(i))
    }

    /// The triangle that holds q, or the ghost beyond whose edge it lies. A walk that always crosses an edge with q beyond it
    /// ends in a Delaunay triangulation, ties broken by one perturbation or not.
    fn walk(&self, near: u32, q: Point2) -> Result<u32, Repeated> {
        let side = |v: &[u32; 3], k: u32| {
            let [a, b] = [v[k as usize], v[SUCC[k as usize] as usize]];
            K::orient2d(self.points[a as usize], self.points[b as usize], q)
        };
        let mut cell = &self.cells[near as usize];
        let mut t = near;
        let mut touched = false;
        let mut e = match [0, 1, 2].map(|k| side(&cell.v, k)) {
            [Sign::Negative, ..] => cell.twin[0],
            [_, Sign::Negative, _] => cell.twin[1],
            [.., Sign::Negative] => cell.twin[2],
            sides => {
                touched = sides.contains(&Sign::Zero);
                NONE
            }
        };
        while e != NONE {
            t = e >> 2;
            cell = &self.cells[t as usize];
            if cell.v[2] == INFINITE {
                return Ok(t);
            }
            let k = e & 3;
            let first = side(&cell.v, SUCC[k as usize]);
            if first == Sign::Negative {
                e = cell.twin[SUCC[k as usize] as usize];
                continue;
            }
            let second = side(&cell.v, PRED[k as usize]);
            if second == Sign::Negative {
                e = cell.twin[PRED[k as usize] as usize];
                continue;
            }
            touched = first == Sign::Zero || second == Sign::Zero;
            break;
        }
        if touched && cell.v.iter().any(|&v| self.points[v as usize] == q) {
            return Err(Repeated);
        }
        Ok(t)
    }

    #[inline]
    fn in_conflict(&self, v: &[u32; 3], q: Point2) -> bool {
        let [a, b] = [self.points[v[0] as usize], self.points[v[1] as usize]];
        if v[2] != INFINITE {
            return K::in_conflict([a, b, self.points[v[2] as usize]], q);
        }
        match K::orient2d(a, b, q) {
            Sign::Positive => true,
            Sign::Negative => false,
            // On the line: strictly between the ends.
            Sign::Zero => {
                let order = lexicographic(a, q);
                order != Ordering::Equal && order == lexicographic(q, b)
            }
        }
    }

    /// Collects the conflict zone of q from a cell of it, and the zone's boundary.
    fn flood(&mut self, root: u32, q: Point2) {
        self.zone.clear();
        self.rim.clear();
        self.zone.push(root);
        let [first, second, third] = self.cells[root as usize].twin;
        self.stack.extend([third, second, first]);
        while let Some(e) = self.stack.pop() {
            let cell = &self.cells[(e >> 2) as usize];
            if self.in_conflict(&cell.v, q) {
                self.zone.push(e >> 2);
                let k = e & 3;
                let (after, before) = (cell.twin[SUCC[k as usize] as usize], cell.twin[PRED[k as usize] as usize]);
                self.stack.extend([before, after]);
            } else {
                self.rim.push((cell.v[SUCC[(e & 3) as usize] as usize], e));
            }
        }
    }

    /// Replaces the conflict zone by cells from point number `i` to the boundary; returns a finite one.
    fn star(&mut self, i: u32) -> u32 {
        for _ in self.zone.len()..self.rim.len() {
            self.zone.push(self.cells.len() as u32);
            self.cells.push(Cell { v: [INFINITE; 3], twin: [0; 3] });
        }
        if self.rim.iter().any(|&(x, _)| x == INFINITE) { self.star_outside(i) } else { self.star_inside(i) }
    }

    /// The same where the infinite vertex is not on the boundary: edge 0 of a cell is the boundary's, edge 1 leads to point `i`.
    fn star_inside(&mut self, i: u32) -> u32 {
        let m = self.rim.len();
        let (first, mut before) = (self.zone[0], self.zone[m - 1]);
        let (first_x, mut outer) = self.rim[0];
        let (mut t, mut x) = (first, first_x);
        for here in 1..=m {
            let (after, (y, next_outer)) =
                if here < m { (self.zone[here], self.rim[here]) } else { (first, (first_x, NONE)) };
            let twin = [outer, 4 * after + 2, 4 * before + 1];
            self.cells[t as usize] = Cell { v: [x, y, i], twin };
            self.cells[(outer >> 2) as usize].twin[((outer & 3) as usize).min(2)] = 4 * t;
            (before, t, x, outer) = (t, after, y, next_outer);
        }
        first
    }

    /// The same where the infinite vertex is on the boundary: two cells are ghosts and turned so that it is corner 2.
    fn star_outside(&mut self, i: u32) -> u32 {
        let m = self.rim.len();
        let vertex = |rim: &[(u32, u32)], here: usize| rim[here % m].0;
        // The corner from which the boundary's edge goes in cell number `here`.
        let turn = |rim: &[(u32, u32)], here: usize| match (vertex(rim, here), vertex(rim, here + 1)) {
            (INFINITE, _) => 2,
            (_, INFINITE) => 1,
            _ => 0,
        };
        let mut finite = 0;
        for here in 0..m {
            let (x, outer) = self.rim[here];
            let y = vertex(&self.rim, here + 1);
            let (t, k) = (self.zone[here], turn(&self.rim, here));
            let after = 4 * self.zone[(here + 1) % m] + (turn(&self.rim, here + 1) + 2) % 3;
            let before = 4 * self.zone[(here + m - 1) % m] + (turn(&self.rim, here + m - 1) + 1) % 3;
            self.cells[t as usize] = match k {
                0 => Cell { v: [x, y, i], twin: [outer, after, before] },
                1 => Cell { v: [i, x, y], twin: [before, outer, after] },
                _ => Cell { v: [y, i, x], twin: [after, before, outer] },
            };
            if k == 0 {
                finite = t;
            }
            self.cells[(outer >> 2) as usize].twin[(outer & 3) as usize] = 4 * t + k;
        }
        finite
    }

    /// The finite triangles with the points' own numbers.
    fn finish(mut self, order: &[u32]) -> Vec<Slot> {
        let ghosts: Vec<u32> = (0u32..).zip(&self.cells).filter(|(_, c)| c.v[2] == INFINITE).map(|(t, _)| t).collect();
        for &ghost in &ghosts {
            let e = self.cells[ghost as usize].twin[0];
            self.cells[(e >> 2) as usize].twin[(e & 3) as usize] = NONE;
        }
        // Ghosts are overwritten by the last triangles, so that few links change.
        for ghost in ghosts {
            while self.cells.last().is_some_and(|c| c.v[2] == INFINITE) {
                self.cells.pop();
            }
            if (ghost as usize) < self.cells.len() {
                self.cells.swap_remove(ghost as usize);
                for (k, e) in (0u32..).zip(self.cells[ghost as usize].twin) {
                    if e != NONE {
                        self.cells[(e >> 2) as usize].twin[(e & 3) as usize] = 4 * ghost + k;
                    }
                }
            }
        }
        let link = |e: u32| if e == NONE { Link::BORDER } else { Link::to(e) };
        let slot =
            |cell: &Cell| Slot { v: cell.v.map(|v| order[v as usize]), birth: 0, link: cell.twin.map(link), region: 0 };
        self.cells.iter().map(slot).collect()
    }
}
