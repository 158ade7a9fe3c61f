//! The triangulation of many points, all at once.
//!
//! Points are inserted one by one in a spatial order (`spatial`), searched from the last one, and get their places in that order, for locality.
//! A point that is hidden or becomes so is looked at again only at the end, when it finds the cell that contains it: later points can only hide
//! more. Nothing of what is destroyed on the way is reported.

use super::insert::Meeting;
use super::store::{FIRST, NONE, Regular3, Status};
use crate::arith::space::Kernel3;
use crate::model::{Point2, Point3, WeightedPoint};

impl<K: Kernel3> Regular3<K> {
    /// The triangulation of the points; ids are their positions. Any number of threads gives the same one.
    pub fn build(points: &[WeightedPoint], threads: usize) -> Self {
        Self::build_together(points, threads).unwrap_or_else(|| Self::build_alone(points))
    }

    /// The order in which `build` inserts the points: affinely independent ones first, as many as there are up to four, then samples of
    /// growing size, each along a space-filling curve.
    pub fn insertion_order(points: &[WeightedPoint]) -> Vec<u32> {
        assert!(points.len() < (u32::MAX - 8) as usize, "a triangulation holds fewer than 2^32 - 8 points");
        let mut order = crate::triangulation::spatial::insertion_order(points);
        let basis = affine_basis::<K>(points, &order);
        for (to, from) in basis.into_iter().enumerate() {
            order[to..=from].rotate_right(1);
        }
        order
    }

    pub(super) fn build_alone(points: &[WeightedPoint]) -> Self {
        let mut t = Self::build_unsettled(points, points.len());
        t.settle();
        t
    }

    /// All cells; but hints are not set, and of the hidden points nothing is known. There is room for so many points.
    pub(super) fn build_unsettled(points: &[WeightedPoint], room: usize) -> Self {
        let order = Self::insertion_order(points);
        let mut t = Self::with_capacity(room);
        t.places.resize(points.len(), NONE);
        for (place, &id) in (FIRST..).zip(&order) {
            t.add_site(points[id as usize], id);
            t.places[id as usize] = place;
        }
        drop(order);
        t.insert_all();
        t
    }

    /// Inserts all places in their order; the first ones are affinely independent.
    fn insert_all(&mut self) {
        let end = self.sites.len() as u32;
        if end == FIRST {
            return;
        }
        self.raise_from_nothing(FIRST);
        let mut next = FIRST + 1;
        while next < end
            && let Some((apex, side)) = self.off_hull(self.site(next).at)
        {
            self.raise(next, apex, side);
            next += 1;
        }
        let mut s = self.scratch.take().unwrap_or_default();
        self.reserve_numbers(&mut s);
        for place in next..end {
            let q = self.site(place);
            match self.meet(q, self.last) {
                Meeting::Conflict(root) => {
                    self.flood(root, q, &mut s);
                    self.last = self.star(place, &mut s);
                }
                Meeting::Twin(of) => self.make_twin(place, of),
                Meeting::Hidden(_) => {}
            }
        }
        self.scratch = Some(s);
    }

    /// Sets all hints and lets the hidden points lodge.
    fn settle(&mut self) {
        for (hint, &status) in self.hints.iter_mut().zip(&self.status) {
            if status == Status::Vertex {
                *hint = NONE;
            }
        }
        self.set_hints_from(0);
        let hidden = self.homeless();
        let cells = self.cells_of(&hidden);
        self.lodge_together(&hidden, &cells);
    }

    /// Lets the vertices of all cells from this slot on refer to them.
    pub(super) fn set_hints_from(&mut self, start: u32) {
        for (i, cell) in (start..).zip(&self.cells[start as usize..]) {
            if !cell.is_free() {
                for v in cell.v {
                    self.hints[v as usize] = i;
                }
            }
        }
    }
}

/// Positions in the order of the first point, the first one elsewhere, the first one off their line, the first one off their plane.
fn affine_basis<K: Kernel3>(points: &[WeightedPoint], order: &[u32]) -> Vec<usize> {
    let at = |i: usize| points[order[i] as usize].at;
    let first = |from: usize, fits: &dyn Fn(Point3) -> bool| (from..order.len()).find(|&i| fits(at(i)));
    let mut basis = Vec::new();
    basis.extend(first(0, &|_| true));
    if let [a] = basis[..] {
        basis.extend(first(a + 1, &|p| p != at(a)));
    }
    if let [a, b] = basis[..] {
        basis.extend(first(b + 1, &|p| !collinear::<K>(at(a), at(b), p)));
    }
    if let [a, b, c] = basis[..] {
        basis.extend(first(c + 1, &|p| K::orient3d(at(a), at(b), at(c), p) != crate::model::Sign::Zero));
    }
    basis
}

/// Whether three points lie on a line: their shadows on the three planes of coordinates do.
fn collinear<K: Kernel3>(a: Point3, b: Point3, c: Point3) -> bool {
    let shadows: [fn(Point3) -> Point2; 3] =
        [|p| Point2::new(p.x, p.y), |p| Point2::new(p.y, p.z), |p| Point2::new(p.z, p.x)];
    shadows.into_iter().all(|s| K::orient2d(s(a), s(b), s(c)) == crate::model::Sign::Zero)
}
