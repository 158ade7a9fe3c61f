//! Stage one: an f64 with a running bound of its error, and the semi-static filters of the hottest predicates.
//!
//! A filter may decline, never guess. With u = 2^-53, an operation's rounded value r differs from the exact value of its
//! rounded arguments by at most u|r| (plus 2^-1075 for a product that underflows, covered by `TINY`). The bounds are
//! themselves computed with rounding; each step loses a relative u, and `SLACK` at the end covers thousands of them.

use super::double_double::two_sum;
use super::kernel::Corners;
use super::poly::Ring;
use super::scale;
use crate::model::{Point2, Sign};

/// Half an ulp of 1.
const U: f64 = f64::EPSILON / 2.0;
/// More than the underflow of all products that go into one product and its bound.
const TINY: f64 = 1e-300;
/// Covers the rounding of the bounds themselves.
const SLACK: f64 = 1.0 + 1e-6;

/// An f64 within `err` of the exact value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounded {
    value: f64,
    err: f64,
}

impl Bounded {
    /// The sign, if the bound allows to tell it. Overflow makes the bound infinite or NaN, and the comparison false.
    #[inline]
    pub fn sign(self) -> Option<Sign> {
        sign_beyond(self.value, self.err * SLACK)
    }
}

impl Ring for Bounded {
    #[inline]
    fn of(x: f64) -> Bounded {
        Bounded { value: x, err: 0.0 }
    }
    #[inline]
    fn difference(a: f64, b: f64) -> Bounded {
        let value = a - b;
        Bounded { value, err: U * value.abs() }
    }
    #[inline]
    fn plus(&self, other: &Bounded) -> Bounded {
        let value = self.value + other.value;
        Bounded { value, err: self.err + other.err + U * value.abs() }
    }
    #[inline]
    fn minus(&self, other: &Bounded) -> Bounded {
        let value = self.value - other.value;
        Bounded { value, err: self.err + other.err + U * value.abs() }
    }
    #[inline]
    fn times(&self, other: &Bounded) -> Bounded {
        let value = self.value * other.value;
        let inherited = self.value.abs() * other.err + (other.value.abs() + other.err) * self.err;
        Bounded { value, err: inherited + U * value.abs() + TINY }
    }
    #[inline]
    fn doubled(&self) -> Bounded {
        Bounded { value: 2.0 * self.value, err: 2.0 * self.err }
    }
    /// Order statistics move by at most the largest error of the values they are taken of.
    #[inline]
    fn two_largest([a, b, c]: [Bounded; 3]) -> (Bounded, Bounded) {
        // Zero for finite values, NaN otherwise: a value that overflowed must not be sorted away.
        let overflow = (a.value + b.value + c.value) * 0.0;
        let err = a.err.max(b.err).max(c.err) + overflow;
        let (low, high) = (a.value.min(b.value), a.value.max(b.value));
        let (middle, high) = (low.max(high.min(c.value)), high.max(c.value));
        (Bounded { value: middle, err }, Bounded { value: high, err })
    }
    #[inline]
    fn smaller(a: Bounded, b: Bounded) -> Bounded {
        let overflow = (a.value + b.value) * 0.0;
        Bounded { value: a.value.min(b.value), err: a.err.max(b.err) + overflow }
    }
}

/// Sign of cross(a, b, c) where the filter can tell.
///
/// Two products of rounded differences and one subtraction; Shewchuk's bound (3 + 16u) u (|left| + |right|), 1997.
/// No term underflows: coordinates are multiples of 2^-194, so a product is 0 or at least 2^-388.
#[inline]
pub(super) fn orient2d(a: Point2, b: Point2, c: Point2) -> Option<Sign> {
    const BOUND: f64 = (3.0 + 16.0 * U) * U;
    let left = (a.x - c.x) * (b.y - c.y);
    let right = (a.y - c.y) * (b.x - c.x);
    sign_beyond(left - right, BOUND * (left.abs() + right.abs()))
}

/// Position of q against the circle of t where the filter can tell.
///
/// The determinant is the sum of three products of a lift and a cross product. Each is made of terms with at most 11
/// factors 1 + delta, |delta| <= u (4 of the lift, 4 of the cross product, 1, 2 sums). By Cauchy's inequality the terms of
/// b x c sum to at most |b||c| <= (|b|^2 + |c|^2)/2 in magnitude, so all together sum to at most the sum s of the products
/// of two lifts: the error is below 11 (1 + small) u s, 1.2213e-15 s.
/// No term underflows: coordinates are multiples of 2^-194, so the determinant is one of 2^-776.
#[inline]
pub(super) fn in_circle([a, b, c]: Corners, q: Point2) -> Option<Sign> {
    const BOUND: f64 = 1.25e-15;
    let (ax, ay, bx, by, cx, cy) = (a.x - q.x, a.y - q.y, b.x - q.x, b.y - q.y, c.x - q.x, c.y - q.y);
    let (la, lb, lc) = (ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy);
    let det = la * (bx * cy - by * cx) + lb * (cx * ay - cy * ax) + lc * (ax * by - ay * bx);
    sign_beyond(det, BOUND * (la * (lb + lc) + lb * lc))
}

/// Sign of cross(centroid, q, w) where the filter can tell.
///
/// A coordinate of 3q minus the sum of the corners has error at most 3u (1 + small) times the sum of its magnitudes, a
/// product of two such 7u, the difference of two products 8u. No term underflows, as in `orient2d`.
#[inline]
pub(super) fn walk_side([a, b, c]: Corners, q: Point2, w: Point2) -> Option<Sign> {
    const BOUND: f64 = 9.0 * U;
    let sum = |p: f64, a: f64, b: f64, c: f64| {
        let (a, b, c) = (p - a, p - b, p - c);
        (a + b + c, a.abs() + b.abs() + c.abs())
    };
    let ((qx, qx_size), (qy, qy_size)) = (sum(q.x, a.x, b.x, c.x), sum(q.y, a.y, b.y, c.y));
    let ((wx, wx_size), (wy, wy_size)) = (sum(w.x, a.x, b.x, c.x), sum(w.y, a.y, b.y, c.y));
    sign_beyond(qx * wy - qy * wx, BOUND * (qx_size * wy_size + qy_size * wx_size))
}

/// Position of q against the circle of t by integers of 128 bits, where the differences to q are exact and multiples of
/// 2^-30 of a power of two above the largest: every tie on a grid, and decisions close to one.
///
/// Differences become integers below 2^30, lifts and cross products are below 2^61, the sum of three products below 2^124.
pub(super) fn in_circle_on_grid([a, b, c]: Corners, q: Point2) -> Option<Sign> {
    let exact = [
        two_sum(a.x, -q.x),
        two_sum(a.y, -q.y),
        two_sum(b.x, -q.x),
        two_sum(b.y, -q.y),
        two_sum(c.x, -q.x),
        two_sum(c.y, -q.y),
    ];
    let mut largest = 0.0f64;
    for (difference, tail) in exact {
        if tail != 0.0 {
            return None;
        }
        largest = largest.max(difference.abs());
    }
    let e = 30 - scale::exponent_of(largest);
    if !(-1000..=1000).contains(&e) {
        return None;
    }
    let factor = scale::power_of_two(e);
    let mut integer = [0i64; 6];
    for (n, (difference, _)) in integer.iter_mut().zip(exact) {
        let scaled = difference * factor;
        *n = scaled as i64;
        if *n as f64 != scaled {
            return None;
        }
    }
    let [ax, ay, bx, by, cx, cy] = integer;
    let term = |lift: i64, cross: i64| i128::from(lift) * i128::from(cross);
    let det = term(ax * ax + ay * ay, bx * cy - by * cx)
        + term(bx * bx + by * by, cx * ay - cy * ax)
        + term(cx * cx + cy * cy, ax * by - ay * bx);
    Some(match det.signum() {
        1 => Sign::Positive,
        0 => Sign::Zero,
        _ => Sign::Negative,
    })
}

/// Whether m2 n2 >= 4 rho2 cross^2 where the filter can tell.
///
/// Rounded differences have relative error u. So m2 n2 is within 9u (1 + small) of itself (4u a square length, 1u their
/// product; order statistics move no more than what they are taken of), the cross product within 4u (1 + small) of the sum
/// of its terms' magnitudes, and 4 rho2 times its square within 3u (1 + small) of itself.
/// Nothing underflows but products with rho2: m2 n2 >= cross^2, so where 4 rho2 cross is subnormal m2 n2 is larger by far.
/// What overflows to infinity is larger than m2 n2 <= 2^806.
#[inline]
pub(super) fn is_skinny([a, b, c]: Corners, rho2: f64) -> Option<bool> {
    let (ex, ey, fx, fy, gx, gy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y, c.x - b.x, c.y - b.y);
    let (k, l, m) = (ex * ex + ey * ey, fx * fx + fy * fy, gx * gx + gy * gy);
    let longest2 = (k * l).max(l * m).max(m * k);
    let (left, right) = (ex * fy, ey * fx);
    let cross = (left - right).abs();
    let slip = 5.0 * U * (left.abs() + right.abs());
    let (low, high) = ((cross - slip).max(0.0), cross + slip);
    if longest2 > (1.0 + 20.0 * U) * (4.0 * rho2 * high * high) {
        Some(true)
    } else if longest2 < (1.0 - 20.0 * U) * (4.0 * rho2 * low * low) {
        Some(false)
    } else {
        None
    }
}

/// The sign of a value known to within `bound`; NaN and infinities of both decline. One branch: which sign it is, is for the caller
/// to branch on.
#[inline(always)]
pub(super) fn sign_beyond(value: f64, bound: f64) -> Option<Sign> {
    if value.abs() > bound { Some(if value > 0.0 { Sign::Positive } else { Sign::Negative }) } else { None }
}
