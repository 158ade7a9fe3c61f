//! The regular (weighted Delaunay) triangulation of points of space, unique under the one tie-break.
//!
//! Problem: build it from many points at once, and insert, remove and reweight single points, exactly and fast, for points that may
//! coincide, hide one another or span less than space.
//! Idea: cells in one flat array, linked facet to facet; every operation replaces the cells of a cavity by others with the same
//! boundary. One infinite vertex makes the hull an ordinary part: a *ghost* cell stands on each hull facet. All decisions are the kernel's, so
//! the result depends on the points alone, neither on their order nor on slots.
//! Sources: Bowyer (1981) and Watson (1981) for the insertion; Edelsbrunner and Shah (1996) for hidden points; the tie-break is
//! `arith::space::perturb3`.
//!
//! **Places.** Inside, a point is called by its *place* in `sites`: places 0, 1, 2 are the apexes, 3 the infinite vertex, the points follow, in
//! the order in which they were inserted (a spatial one, where they came together). `ids` and `places` translate to and from the
//! ids that the caller knows.
//!
//! **Apexes.** The structure is three-dimensional also where the points are not: points spanning d < 3 dimensions are accompanied by 3 - d
//! apexes, so that together they span space. Then every finite cell has all apexes among its vertices (the points span only d dimensions), and
//! the cells without them are the regular triangulation of the points: the (power) sphere through a cell meets the affine hull of the points in
//! the sphere of its points, and in a tie the coefficient of an apex in the perturbation vanishes. A point off that hull takes the
//! place of an apex (`raise`).
//!
//! **Invariants** between two calls, of live cells (`v` vertices, `n` links):
//! 1. `n[i] = 4 b + j` says: the cell beyond the facet opposite `v[i]` is b, and its vertex `v[j]` is the one not on that facet; and b says so
//!    of this cell. The two cells share exactly the three other vertices.
//! 2. A finite cell is positively oriented. The infinite vertex is `v[3]` of a ghost and nowhere else; with any point beyond the facet in its
//!    place a ghost is positively oriented.
//! 3. No point is in conflict with a cell: strictly inside its (power) sphere, or on it and inside by the tie-break; for a ghost: strictly
//!    beyond its facet, or on its plane and in conflict with the cell behind.
//! 4. A free slot has `v[0] == NONE` and stands in `free`. Marks are clear.
//! 5. `hints[p]`: of a vertex, some cell (or ghost) that has it; of a hidden point, a finite cell that contains it (then p stands in that cell's
//!    list in `lodgers`); of a duplicate, the place of the point that stands for it. `status[p]` says which.
//! 6. Apexes in use are vertices; the other places below 4 stand for nothing. Without points there are no cells.

mod build;
mod conflict;
mod dual;
mod fill;
mod hilbert;
mod insert;
mod locate;
mod lodge;
mod numbers;
mod raise;
mod remove;
mod report;
mod star;
mod store;
#[cfg(test)]
mod tests;
mod threads;
mod validate;

pub use dual::{DualEdge, Orthocenter};
pub use store::{CellId, Change, INFINITE, Regular3, apex, is_apex};
pub use validate::Violation;
