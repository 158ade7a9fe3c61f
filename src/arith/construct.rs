//! The hottest rounded values where the edges of the triangle are exact f64s: double-double with bounds derived once.
//!
//! Among the triangles of a mesh most differences of coordinates are exact (Sterbenz), and then half of the operations of
//! a general double-double evaluation are spent on zeros. This evaluation declines where a difference is not exact, and
//! where its bound does not certify the rounding; the staged evaluation of `fast` then takes over.
//!
//! Nothing underflows unless said: edges are multiples of 2^-194, so the products of up to three of them and their tails
//! are exact. What overflows makes a bound or a sum infinite or NaN, and no certificate holds.

use super::double_double::{two_product, two_sum};
use super::kernel::Corners;
use crate::model::Point2;

/// u^2 = 2^-106.
const U2: f64 = f64::EPSILON * f64::EPSILON / 4.0;

/// A value hi + lo; bounds are stated where it is made.
#[derive(Clone, Copy)]
struct Pair {
    hi: f64,
    lo: f64,
}

/// a b + c d, off by at most 3 u^2 (|a b| + |c d|), |lo| at most 2 u of that; and |a b| + |c d|.
///
/// The products and the sum of their heads are exact. Their tails, u each, are added to its tail with two roundings.
#[inline]
fn two_products(a: f64, b: f64, c: f64, d: f64) -> (Pair, f64) {
    let ((p, p_tail), (q, q_tail)) = (two_product(a, b), two_product(c, d));
    let (hi, tail) = two_sum(p, q);
    (Pair { hi, lo: tail + (p_tail + q_tail) }, p.abs() + q.abs())
}

/// a b + c d for squared lengths a, c of `two_products`, off by at most 15 u^2 (|a b| + |c d|), |lo| at most 4 u of that.
///
/// Each product inherits 3 u^2 and rounds twice, by 2 u^2 and 3 u^2; the two roundings of the tails add 3 u^2 and 4 u^2.
#[inline]
fn combine(a: Pair, b: f64, c: Pair, d: f64) -> (Pair, f64) {
    let ((p, p_tail), (q, q_tail)) = (two_product(a.hi, b), two_product(c.hi, d));
    let (hi, tail) = two_sum(p, q);
    let (p_low, q_low) = (p_tail + a.lo * b, q_tail + c.lo * d);
    (Pair { hi, lo: tail + (p_low + q_low) }, p.abs() + q.abs())
}

/// base + n/(2 d) rounded, if certain; `n_size` and `d_size` are the sums of magnitudes that the bounds of n and d refer to.
///
/// With q the first quotient and r = n - q d, the second one is r/d.hi. Off from the exact remainder by: the errors
/// of n and d (15 n_size, 3 q d_size), the roundings of r and of its quotient (14 n_size + 8 q d_size), and
/// d.lo times the second quotient (10 k n_size + 4 k q d_size, k = d_size/|d.hi|), all times u^2: at most
/// 30 (1 + k) (n_size + q d_size) u^2. 32 covers the rounding of the bound.
#[inline]
fn rounded(base: f64, n: (Pair, f64), d: (Pair, f64)) -> Option<f64> {
    let ((n, n_size), (d, d_size)) = (n, d);
    let q = n.hi / d.hi;
    let (p, p_tail) = two_product(q, d.hi);
    let remainder = ((n.hi - p) - p_tail) + (n.lo - q * d.lo);
    let second = remainder / d.hi;
    let inverse = 1.0 / d.hi.abs();
    let bound = 32.0 * U2 * (1.0 + d_size * inverse) * (n_size + q.abs() * d_size) * inverse;
    // Halves: the denominator is 2 d.
    let (sum, tail) = two_sum(base, 0.5 * q);
    let low = tail + 0.5 * second;
    certified(sum, low, bound + f64::EPSILON * low.abs())
}

/// hi + lo rounded to nearest, if every value within `bound` of it rounds alike; 2 u |lo| covers the rounding of lo + bound.
#[inline]
fn certified(hi: f64, lo: f64, bound: f64) -> Option<f64> {
    let (hi, lo) = two_sum(hi, lo);
    let e = bound + 2.0 * f64::EPSILON * lo.abs();
    (hi + (lo + e) == hi && hi + (lo - e) == hi && hi.is_finite()).then_some(hi)
}

/// b - a, if exact.
#[inline]
fn exact_edge(a: Point2, b: Point2) -> Option<(f64, f64)> {
    let ((x, x_tail), (y, y_tail)) = (two_sum(b.x, -a.x), two_sum(b.y, -a.y));
    (x_tail == 0.0 && y_tail == 0.0).then_some((x, y))
}

/// |ab|^2 rounded once; `None` if this evaluation cannot tell.
#[inline]
pub(super) fn length2(a: Point2, b: Point2) -> Option<f64> {
    let (x, y) = exact_edge(a, b)?;
    let (l, size) = two_products(x, x, y, y);
    certified(l.hi, l.lo, 4.0 * U2 * size)
}

/// Twice the signed area, if no step of computing it rounds (triangles on a grid, whose areas tie).
#[inline]
pub(super) fn exact_cross([a, b, c]: Corners) -> Option<f64> {
    let ((ex, ey), (fx, fy)) = (exact_edge(a, b)?, exact_edge(a, c)?);
    let ((p, p_tail), (q, q_tail)) = (two_product(ex, fy), two_product(ey, fx));
    let (cross, tail) = two_sum(p, -q);
    (p_tail == 0.0 && q_tail == 0.0 && tail == 0.0).then_some(cross)
}

/// area/bound rounded once; `None` if this evaluation cannot tell.
///
/// The cross product is off by 3 u^2 of its size, the remainder of the quotient rounds by 3 u^2 and its quotient by 3 u^2.
#[inline]
pub(super) fn area_ratio([a, b, c]: Corners, bound: f64) -> Option<f64> {
    let ((ex, ey), (fx, fy)) = (exact_edge(a, b)?, exact_edge(a, c)?);
    let (d, size) = two_products(ex, fy, -ey, fx);
    let divisor = 2.0 * bound;
    // Cross products are in 2^-388..2^403, so that neither the quotient nor its product with the divisor leaves the range.
    if !(1e-150..1e150).contains(&divisor) || d.hi == 0.0 {
        return None;
    }
    let q = d.hi / divisor;
    let (p, p_tail) = two_product(q, divisor);
    let second = (((d.hi - p) - p_tail) + d.lo) / divisor;
    certified(q, second, 12.0 * U2 * size / divisor)
}

/// m + kappa rot90(q-p), m the midpoint of pq, each coordinate rounded once, before the range rule; `None` if this
/// evaluation cannot tell.
///
/// Twice a coordinate is the sum of four exact terms: heads s and t and their tails, u each. The tails are added with
/// two roundings: below 4 u^2 (|s| + |t|). Halving is exact, save for results that the range rule makes 0.
#[inline]
pub(super) fn offcenter(p: Point2, q: Point2, kappa: f64) -> Option<Point2> {
    let (x, y) = exact_edge(p, q)?;
    // Then products with an edge are 0 or far from underflow.
    if !(1e-150..1e150).contains(&kappa) {
        return None;
    }
    let half = |p: f64, q: f64, along: f64| {
        let ((s, s_tail), (t, t_tail)) = (two_sum(p, q), two_product(2.0 * kappa, along));
        let (hi, tail) = two_sum(s, t);
        certified(hi, tail + (s_tail + t_tail), 5.0 * U2 * (s.abs() + t.abs()))
    };
    Some(Point2::new(0.5 * half(p.x, q.x, -y)?, 0.5 * half(p.y, q.y, x)?))
}

/// The circumcenter of t, each coordinate rounded once, before the range rule; `None` if this evaluation cannot tell.
#[inline]
pub(super) fn circumcenter([a, b, c]: Corners) -> Option<Point2> {
    let ((ex, ey), (fx, fy)) = (exact_edge(a, b)?, exact_edge(a, c)?);
    let ((ee, _), (ff, _)) = (two_products(ex, ex, ey, ey), two_products(fx, fx, fy, fy));
    let d = two_products(ex, fy, -ey, fx);
    let x = rounded(a.x, combine(ee, fy, ff, -ey), d)?;
    let y = rounded(a.y, combine(ff, ex, ee, -fx), d)?;
    Some(Point2::new(x, y))
}
