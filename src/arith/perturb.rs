//! The one tie-break: lexicographic symbolic perturbation, the published rule of the CGAL triangulations.
//!
//! The lift of a point is raised by an infinitesimal, the lexicographically largest point by the most. Then the
//! triangulation of a point set is unique and depends on neither order nor threads.

use super::Kernel;
use super::kernel::Corners;
use crate::model::{Point2, Sign};
use std::cmp::Ordering;

/// Lexicographic order of points by (x, y), exact.
pub fn lexicographic(a: Point2, b: Point2) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

/// Whether q, exactly on the circle of the counterclockwise triangle t, is in conflict with it under the perturbation.
///
/// From the largest of the four points down: if it is q, q is raised most and lies outside; if it is a corner, the
/// orientation with q in its place decides unless it is zero. At most two turns, since q differs from the corners.
pub fn cocircular_in_conflict<K: Kernel>(t: Corners, q: Point2) -> bool {
    let mut by_rank = [(t[0], 0), (t[1], 1), (t[2], 2), (q, 3)];
    by_rank.sort_by(|a, b| lexicographic(b.0, a.0));
    for (_, k) in by_rank {
        if k == 3 {
            return false;
        }
        let mut replaced = t;
        replaced[k] = q;
        match K::orient2d(replaced[0], replaced[1], replaced[2]) {
            Sign::Positive => return true,
            Sign::Negative => return false,
            Sign::Zero => {}
        }
    }
    false
}
