//! Stage one in space: the semi-static filters of the hottest predicates, inlined where they are asked.
//!
//! Nothing underflows: coordinates are multiples of 2^-194 and weights of 2^-336, so that products of their differences are
//! multiples of 2^-970 at least, or 0. Nothing overflows: differences are at most 2^201, and 2^1009 is more than any bound.

use super::kernel3::{Corners3, WeightedCorners};
use crate::arith::filter::sign_beyond;
use crate::model::{Point3, Sign, WeightedPoint};

/// Sign of det(b - a, c - a, d - a) where the filter can tell.
///
/// Each of the six terms has 3 rounded differences, 2 products and 3 sums: 8 factors 1 + delta, |delta| <= u = 2^-53. With X, Y, Z
/// the largest magnitudes of the differences the terms sum to at most 6 XYZ: the error is below 48 (1 + small) u XYZ, 5.33e-15 XYZ.
#[inline(always)]
pub(super) fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Sign> {
    const BOUND: f64 = 5.4e-15;
    let (bx, by, bz) = (b.x - a.x, b.y - a.y, b.z - a.z);
    let (cx, cy, cz) = (c.x - a.x, c.y - a.y, c.z - a.z);
    let (dx, dy, dz) = (d.x - a.x, d.y - a.y, d.z - a.z);
    let det = bx * (cy * dz - cz * dy) + by * (cz * dx - cx * dz) + bz * (cx * dy - cy * dx);
    let x = larger(larger(bx.abs(), cx.abs()), dx.abs());
    let y = larger(larger(by.abs(), cy.abs()), dy.abs());
    let z = larger(larger(bz.abs(), cz.abs()), dz.abs());
    sign_beyond(det, BOUND * (x * y * z))
}

/// Position of q against the sphere of t where the filter can tell.
///
/// The determinant is the sum of four products of a lift and a triple product about q. A term of it has 5 rounded differences, 3 roundings
/// in the lift, 2 products and 3 sums in the triple product, 1 product and 2 sums: 16 factors 1 + delta, |delta| <= u. The terms of a triple
/// product of vectors u, v, w sum in magnitude to the permanent, at most 3!/3^1.5 |u||v||w| (Carlen, Lieb, Loss, "An inequality
/// of Hadamard type for permanents", 2006). With L the largest lift all terms sum to at most 4 * 1.1548 L^2.5, and the error is below
/// 16 (1 + small) u of that: 8.21e-15 L^2.5.
#[inline(always)]
pub(super) fn in_sphere(t: Corners3, q: Point3) -> Option<Sign> {
    const BOUND: f64 = 8.3e-15;
    let (m, l) = minors_and_lifts(t, q);
    let det = (l[0] * m[0] + l[1] * m[1]) + (l[2] * m[2] + l[3] * m[3]);
    let largest = larger(larger(l[0], l[1]), larger(l[2], l[3]));
    sign_beyond(det, BOUND * (largest * largest * largest.sqrt()))
}

/// Position of q against the orthoball of t where the filter can tell.
#[inline(always)]
pub(super) fn power_side(t: WeightedCorners, q: WeightedPoint) -> Option<Sign> {
    let (det, bound) = power_side_estimate(t, q, 0.0);
    sign_beyond(det, bound)
}

/// The determinant of the power test and a bound of its error.
///
/// On a grid of unit u, squared distances and differences of weights adding up to less than (1024 u)^2, lifts are below 2^20 u^2, triple products below
/// 2^30 u^3 (Hadamard) and their partial sums below 2^33 u^3, four products of the two below 2^52 u^5: all integers below 2^53, so that nothing is
/// rounded and the bound is 0.
///
/// As for `in_sphere`, a lift being |p - q|^2 + (w_q - w_p): one more rounded difference and one more sum instead of a difference and a
/// product at least; its terms sum to at most L + W, W the largest difference of weights. 17 factors at most: 8.73e-15 (L + W) L^1.5.
#[inline(always)]
pub(super) fn power_side_estimate(t: WeightedCorners, q: WeightedPoint, exact_below: f64) -> (f64, f64) {
    const BOUND: f64 = 8.8e-15;
    let (m, l) = minors_and_lifts(t.map(|p| p.at), q.at);
    let w = t.map(|p| q.weight - p.weight);
    let det = ((l[0] + w[0]) * m[0] + (l[1] + w[1]) * m[1]) + ((l[2] + w[2]) * m[2] + (l[3] + w[3]) * m[3]);
    let largest = larger(larger(l[0], l[1]), larger(l[2], l[3]));
    let heaviest = larger(larger(w[0].abs(), w[1].abs()), larger(w[2].abs(), w[3].abs()));
    let bound = BOUND * ((largest + heaviest) * largest * largest.sqrt());
    // Nothing is below 0, so that without a grid no bound is.
    (det, if largest + heaviest < exact_below { 0.0 } else { bound })
}

/// Position of q against the orthoball of t, by a bound that sums the magnitudes of all terms instead of estimating them by the largest: out of line, it
/// decides half of what the first filter leaves open among points of a sphere.
///
/// 17 factors as for `power_side_estimate`, and the sum of magnitudes is itself off by as little: 17 (1 + small) u, 1.888e-15.
#[inline]
pub(super) fn power_side_by_terms(t: WeightedCorners, q: WeightedPoint) -> Option<Sign> {
    const BOUND: f64 = 1.9e-15;
    let v = t.map(|p| p.at - q.at);
    let minor = |i: usize, j: usize| {
        let (left, right) = (v[i].x * v[j].y, v[i].y * v[j].x);
        (left - right, left.abs() + right.abs())
    };
    let (ab, bc, cd, ac, bd, ad) = (minor(0, 1), minor(1, 2), minor(2, 3), minor(0, 2), minor(1, 3), minor(0, 3));
    let triple = |[i, j, k]: [usize; 3], [m, n, o]: [(f64, f64); 3]| {
        let (x, y, z) = (v[i].z, v[j].z, v[k].z);
        (x * m.0 - y * n.0 + z * o.0, x.abs() * m.1 + y.abs() * n.1 + z.abs() * o.1)
    };
    let term = |i: usize, (value, size): (f64, f64)| {
        let (lift, weight) = (v[i].x * v[i].x + v[i].y * v[i].y + v[i].z * v[i].z, q.weight - t[i].weight);
        ((lift + weight) * value, (lift + weight.abs()) * size)
    };
    let a = term(0, triple([1, 2, 3], [cd, bd, bc]));
    let b = term(1, triple([0, 2, 3], [cd, ad, ac]));
    let c = term(2, triple([0, 1, 3], [bd, ad, ab]));
    let d = term(3, triple([0, 1, 2], [bc, ac, ab]));
    sign_beyond((a.0 - b.0) + (c.0 - d.0), BOUND * ((a.1 + b.1) + (c.1 + d.1)))
}

/// The orientations of the tetrahedron with q in place of each corner, and a bound of their errors, derived as for `orient3d`.
#[inline(always)]
pub(super) fn orient3d_estimates(t: Corners3, q: Point3) -> ([f64; 4], f64) {
    const BOUND: f64 = 5.4e-15;
    let (m, _) = minors_and_lifts(t, q);
    let [a, b, c, d] = t.map(|p| (p - q).abs());
    let x = larger(larger(a.x, b.x), larger(c.x, d.x));
    let y = larger(larger(a.y, b.y), larger(c.y, d.y));
    let z = larger(larger(a.z, b.z), larger(c.z, d.z));
    (m, BOUND * (x * y * z))
}

/// The signed triple products of the other three corners and the squared distance from q, for each corner: the determinant is the sum of
/// their products.
#[inline(always)]
fn minors_and_lifts([a, b, c, d]: Corners3, q: Point3) -> ([f64; 4], [f64; 4]) {
    let (ax, ay, az) = (a.x - q.x, a.y - q.y, a.z - q.z);
    let (bx, by, bz) = (b.x - q.x, b.y - q.y, b.z - q.z);
    let (cx, cy, cz) = (c.x - q.x, c.y - q.y, c.z - q.z);
    let (dx, dy, dz) = (d.x - q.x, d.y - q.y, d.z - q.z);
    let (ab, cd) = (ax * by - ay * bx, cx * dy - cy * dx);
    let (bc, ad) = (bx * cy - by * cx, ax * dy - ay * dx);
    let (ac, bd) = (ax * cy - ay * cx, bx * dy - by * dx);
    let minors = [
        bz * cd - cz * bd + dz * bc,
        cz * ad - az * cd - dz * ac,
        az * bd - bz * ad + dz * ab,
        bz * ac - az * bc - cz * ab,
    ];
    let lifts = [
        ax * ax + ay * ay + az * az,
        bx * bx + by * by + bz * bz,
        cx * cx + cy * cy + cz * cz,
        dx * dx + dy * dy + dz * dz,
    ];
    (minors, lifts)
}

/// The larger of two numbers of which none is NaN, in one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
