//! The one tie-break in space: lexicographic symbolic perturbation, the published rule of the CGAL triangulations.
//!
//! The lift of a point is raised by an infinitesimal, the lexicographically largest point by the most; weights and ids never enter.

use super::Kernel3;
use super::kernel3::Corners3;
use crate::model::{Point3, Sign};

/// Whether q, exactly on the orthosphere of the positively oriented tetrahedron t, is in conflict with it under the perturbation.
///
/// From the largest of the five points down: if it is q, q is raised most and lies outside; if it is a corner, the orientation with q in its
/// place decides unless it is zero. Those orientations are the barycentric coordinates of q up to sign: at most two vanish (q is no
/// corner), so at most three turns.
#[cold]
#[inline(never)]
pub fn cospherical_in_conflict<K: Kernel3>(t: Corners3, q: Point3) -> bool {
    let places = [t[0], t[1], t[2], t[3], q];
    let mut left = [true; 5];
    loop {
        let mut largest = 4;
        for k in 0..4 {
            if left[k] && is_larger(places[k], places[largest]) {
                largest = k;
            }
        }
        if largest == 4 {
            return false;
        }
        left[largest] = false;
        let mut replaced = t;
        replaced[largest] = q;
        match K::orient3d(replaced[0], replaced[1], replaced[2], replaced[3]) {
            Sign::Positive => return true,
            Sign::Negative => return false,
            Sign::Zero => {}
        }
    }
}

/// a > b lexicographically by (x, y, z); -0 equals 0.
#[inline]
fn is_larger(a: Point3, b: Point3) -> bool {
    if a.x != b.x {
        a.x > b.x
    } else if a.y != b.y {
        a.y > b.y
    } else {
        a.z > b.z
    }
}
