//! The one tie-break in space: lexicographic symbolic perturbation, the published rule of the CGAL triangulations.
//!
//! The lift of a point is raised by an infinitesimal, the lexicographically largest point by the most; weights and ids never enter.

use super::Kernel3;
use super::kernel3::Corners3;
use crate::model::{Point3, Sign};
use std::cmp::Ordering;

/// Lexicographic order of points by (x, y, z), exact.
pub fn lexicographic3(a: Point3, b: Point3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

/// Whether q, exactly on the orthosphere of the positively oriented tetrahedron t, is in conflict with it under the perturbation.
///
/// From the largest of the five points down: if it is q, q is raised most and lies outside; if it is a corner, the orientation with q in its
/// place decides unless it is zero. Those orientations are the barycentric coordinates of q up to sign: at most two vanish (q is no
/// corner), so at most three turns.
#[cold]
pub fn cospherical_in_conflict<K: Kernel3>(t: Corners3, q: Point3) -> bool {
    let mut by_rank = [(t[0], 0), (t[1], 1), (t[2], 2), (t[3], 3), (q, 4)];
    by_rank.sort_by(|a, b| lexicographic3(b.0, a.0));
    for (_, k) in by_rank {
        if k == 4 {
            return false;
        }
        let mut replaced = t;
        replaced[k] = q;
        match K::orient3d(replaced[0], replaced[1], replaced[2], replaced[3]) {
            Sign::Positive => return true,
            Sign::Negative => return false,
            Sign::Zero => {}
        }
    }
    false
}
