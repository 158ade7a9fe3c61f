//! A removal replayed: the hole that a star leaves, filled cell by cell.
//!
//! The facets of the hole form a queue, at first those opposite the vertex, by ascending tuples of its cells. The trace gives the apex over the first facet still open;
//! of the other three facets of that cell each closes an open one, or joins the queue.
//!
//! Tested: (1) the filling leaves no facet open; (2) its tetrahedra are positively oriented; (3) the vertex is on or beyond the plane of every new facet of the hull; (4) the hull is
//! convex at every edge of those; (5) orthoballs are empty across every facet of a new tetrahedron. They suffice: by (3) putting the vertex back would add to what is
//! covered, so nothing is covered more than once. What remains is connected facet by facet: a part without an old facet of the hull would have the vertex on or beyond the
//! planes of all of its facets, which no body has; and the old facets without the vertex are a disc, connected by edges. It is convex by (4), and all vertices of the star are in it. By (5) it is regular.

use super::certificate::{Ties, check_convex, conflict};
use super::complex::{Cell, Complex, INFINITE, NONE, id, number};
use super::glue::FACETS;
use super::predicates::orient;
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::VertexId;
use std::collections::BTreeMap;

/// A facet of the hole.
struct Open {
    /// Turned such that (corners, apex) is positive.
    corners: [u32; 3],
    outer: u32,
    closed: bool,
}

/// A filling in hand.
struct Filling {
    open: Vec<Open>,
    /// Open facets by their corners in ascending order.
    by_corners: BTreeMap<[u32; 3], usize>,
}

/// The star of a vertex, taken out of the complex: its cells with their slots, by ascending tuples.
pub fn take_star(mesh: &mut Complex, v: u32) -> Vec<(u32, Cell)> {
    let mut star = Vec::new();
    mesh.visit_star(v, |c, _| {
        star.push(c);
        true
    });
    let mut star: Vec<_> = star.into_iter().map(|c| (c, mesh.take(c))).collect();
    star.sort_by_key(|(_, cell)| cell.tuple());
    star
}

/// Fills the star of v, which `take_star` took out, and proves it. Gives the new cells.
pub fn fill(mesh: &mut Complex, v: u32, star: &[(u32, Cell)], apexes: &[VertexId], ties: Ties) -> Checked<Vec<u32>> {
    let mut link: Vec<u32> = star.iter().flat_map(|(_, cell)| cell.v).filter(|&w| w != v).collect();
    link.sort_unstable();
    link.dedup();
    let mut filling = Filling { open: Vec::new(), by_corners: BTreeMap::new() };
    for (_, cell) in star {
        let tuple = cell.tuple().map(number);
        let (Some(k), Some(own)) = (tuple.iter().position(|&w| w == v), cell.find(v)) else { continue };
        filling.open_facet(FACETS[k].map(|i| tuple[i]), cell.beyond[own])?;
    }
    star.iter().rev().for_each(|(slot, _)| mesh.release(*slot));
    let mut made = Vec::new();
    let mut next = 0;
    for &apex in apexes {
        while filling.open.get(next).is_some_and(|o| o.closed) {
            next += 1;
        }
        let Some(Open { corners, outer, .. }) = filling.open.get(next) else {
            return broken(Rule::Star, "as many apexes as the hole takes", "more");
        };
        let ([x, y, z], outer, w) = (*corners, *outer, number(apex));
        let known = link.binary_search(&w).is_ok() && ![x, y, z].contains(&w);
        ensure(known, Rule::Star, || ("another vertex of the star", format!("{apex:?}")))?;
        let c = mesh.add([x, y, z, w]);
        made.push(c);
        mesh.join(4 * c + 3, outer);
        filling.close(next);
        next += 1;
        let cell = *mesh.cell(c);
        for k in 0..3 {
            match filling.closing(cell.facet(k))? {
                Some(other) => mesh.join(4 * c + k as u32, other),
                None => {
                    let [a, b, d] = cell.facet(k);
                    filling.open_facet([b, a, d], 4 * c + k as u32)?;
                }
            }
        }
    }
    let whole = filling.open.iter().all(|o| o.closed);
    ensure(whole, Rule::Star, || ("as many apexes as the hole takes", "fewer"))?;
    made.iter().for_each(|&c| mesh.cell(c).v.into_iter().for_each(|w| mesh.set_cell_at(w, c)));
    mesh.set_cell_at(v, NONE);
    made.iter().try_for_each(|&c| check_cell(mesh, c, v, ties))?;
    Ok(made)
}

impl Filling {
    fn open_facet(&mut self, corners: [u32; 3], outer: u32) -> Checked {
        let before = self.by_corners.insert(ascending(corners), self.open.len());
        ensure(before.is_none(), Rule::Star, || ("a facet of the hole once", format!("{:?} twice", corners.map(id))))?;
        self.open.push(Open { corners, outer, closed: false });
        Ok(())
    }

    fn close(&mut self, k: usize) {
        self.open[k].closed = true;
        self.by_corners.remove(&ascending(self.open[k].corners));
    }

    /// What is beyond an open facet that a new cell has in common with the hole; it is closed.
    fn closing(&mut self, facet: [u32; 3]) -> Checked<Option<u32>> {
        let Some(&k) = self.by_corners.get(&ascending(facet)) else {
            return Ok(None);
        };
        let [a, b, c] = self.open[k].corners;
        let same = [[a, b, c], [b, c, a], [c, a, b]].contains(&facet);
        ensure(same, Rule::Star, || ("cells on the hole's side of its facets", format!("{:?}", facet.map(id))))?;
        self.close(k);
        Ok(Some(self.open[k].outer))
    }
}

fn ascending(mut facet: [u32; 3]) -> [u32; 3] {
    facet.sort_unstable();
    facet
}

/// (2) to (5) for one cell, v having been removed.
fn check_cell(mesh: &Complex, c: u32, v: u32, ties: Ties) -> Checked {
    let cell = mesh.cell(c);
    if let Some(infinite) = cell.find(INFINITE) {
        let [x, y, z] = cell.facet(infinite).map(|w| mesh.at(w));
        ensure(!orient(x, y, z, mesh.at(v)).is_negative(), Rule::Hull, || {
            ("a hull that the vertex was beyond", format!("{:?}", cell.tuple()))
        })?;
        let finite = mesh.cell(cell.beyond[infinite] >> 2).is_finite();
        ensure(finite, Rule::Hull, || ("a tetrahedron at a facet of the hull", format!("{:?}", cell.tuple())))?;
        return (0..4).filter(|&k| k != infinite).try_for_each(|k| check_convex(mesh, c, k));
    }
    let [x, y, z, w] = cell.v.map(|u| mesh.at(u));
    ensure(orient(x, y, z, w).is_positive(), Rule::Orientation, || {
        ("a positively oriented tetrahedron", format!("{:?}", cell.tuple()))
    })?;
    for f in cell.beyond {
        let q = mesh.apex(f);
        ensure(q == INFINITE || !conflict(mesh, c, q, ties), Rule::Regular, || {
            ("an orthoball empty of the next corner", format!("{:?} holds {:?}", cell.tuple(), id(q)))
        })?;
    }
    Ok(())
}
