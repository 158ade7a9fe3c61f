//! The tests that make a triangulation of space: orientation, orthosphere, and the one tie-break.
//!
//! With a base corner a and u = b - a, v = c - a, w = d - a, a point x (from a) has the lift L(x) = |x|^2 - (w_x - w_a). The plane through the
//! lifts of a positively oriented cell is S.x / D with D = u.(v x w) and S = L(u) (v x w) + L(v) (w x u) + L(w) (u x v). A point q is strictly
//! inside the orthosphere (with weights 0: the circumsphere) where its lift is below that plane: S.x - D L(x) > 0.
//!
//! First a value in doubles with a proven error bound; then integers of fixed width (`integers`), if differences of coordinates fit a word; then pairs of
//! doubles (`double`); then rationals.
//!
//! The range: either no coordinate and no weight exceeds 1, or products of up to five differences and weights neither under- nor overflow.
//! Differences of coordinates count as variables, so each is rounded once. A monomial of S.x - D L(x) is rounded at most 18 times: u_x twice
//! (it is squared), the square, two sums and the weight's term make 6; a minor 4, their product 1, the sum of three such 2, x_x 1, the
//! product with it 1, three sums 3. Each rounding is a factor within 1 ± 2^-53, in the sum of magnitudes as well, so that the value is off by less than
//! 20 2^-53 `size`. Underflow happens only in the first range, where each loses at most 2^-1074 and is magnified less than 2^12 times: `TINY`
//! pays for a thousand of them. Overflow gives an infinity or a NaN, and no answer.

use super::ball::{near_side, seen_from_last};
use super::double::sign_in_space;
use super::integers;
use crate::check::value::Number;
use crate::model::{Point3, Sign, WeightedPoint};
use std::cmp::Ordering;

/// Corners of a positively oriented tetrahedron.
pub type Corners = [WeightedPoint; 4];

/// A difference of two points.
pub type Vector<N> = [N; 3];

/// b - a.
pub fn vector<N: Number>(a: Point3, b: Point3) -> Vector<N> {
    [N::of(b.x) - N::of(a.x), N::of(b.y) - N::of(a.y), N::of(b.z) - N::of(a.z)]
}

/// u.v
pub fn dot<N: Number>(u: &Vector<N>, v: &Vector<N>) -> N {
    u[0].clone() * v[0].clone() + u[1].clone() * v[1].clone() + u[2].clone() * v[2].clone()
}

/// u x v
pub fn cross<N: Number>(u: &Vector<N>, v: &Vector<N>) -> Vector<N> {
    let minor = |i: usize, j: usize| u[i].clone() * v[j].clone() - u[j].clone() * v[i].clone();
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Six times the signed volume of a, b, c, d.
pub fn volume6<N: Number>(a: Point3, b: Point3, c: Point3, d: Point3) -> N {
    dot(&vector(a, b), &cross(&vector(a, c), &vector(a, d)))
}

/// S.x - D L(x) of the module's head.
pub(super) fn depth<N: Number>(t: &Corners, q: &WeightedPoint) -> N {
    let [u, v, w, x] = [t[1], t[2], t[3], *q].map(|p| vector::<N>(t[0].at, p.at));
    let lift = |x: &Vector<N>, p: &WeightedPoint| dot(x, x) - (N::of(p.weight) - N::of(t[0].weight));
    let minors = [cross(&v, &w), cross(&w, &u), cross(&u, &v)];
    let lifts = [lift(&u, &t[1]), lift(&v, &t[2]), lift(&w, &t[3])];
    let volume = dot(&u, &minors[0]);
    let along = |k: usize| dot(&minors[k], &x) * lifts[k].clone();
    along(0) + along(1) + along(2) - volume * lift(&x, q)
}

/// What a value whose monomials have magnitudes of sum `size` is off by at most: 20 2^-53 `size`.
#[inline]
pub(super) fn error(size: f64) -> f64 {
    const TINY: f64 = 1e-300;
    size * (f64::EPSILON * 10.0) + TINY
}

/// The sign of a value that is off by less than 20 2^-53 `size`.
#[inline]
pub(super) fn certain(value: f64, size: f64) -> Option<Sign> {
    let error = error(size);
    if value > error {
        Some(Sign::Positive)
    } else if value < -error {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// A number and the sum of the magnitudes of its monomials.
type Sized = [f64; 2];

/// Minors of two differences.
#[inline]
fn minors(u: Point3, v: Point3) -> [Sized; 3] {
    let minor = |a: f64, b: f64| [a - b, a.abs() + b.abs()];
    [minor(u.y * v.z, u.z * v.y), minor(u.z * v.x, u.x * v.z), minor(u.x * v.y, u.y * v.x)]
}

#[inline]
fn triple(u: Point3, m: &[Sized; 3]) -> Sized {
    let size = u.abs();
    [u.x * m[0][0] + u.y * m[1][0] + u.z * m[2][0], size.x * m[0][1] + size.y * m[1][1] + size.z * m[2][1]]
}

/// Whether d lies on the side of plane abc from which a, b, c turn counterclockwise.
#[inline]
pub fn orient(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
    let [value, size] = triple(b - a, &minors(c - a, d - a));
    certain(value, size).unwrap_or_else(|| exact_orient(a, b, c, d))
}

/// As `orient`, where doubles cannot tell.
#[cold]
fn exact_orient(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
    integers::volume6(a, b, c, d).unwrap_or_else(|| sign_in_space!(volume6(a, b, c, d)))
}

/// Position of q against the orthosphere of t: positive strictly inside (in conflict), zero on it.
#[inline]
pub fn side(t: &Corners, q: &WeightedPoint) -> Sign {
    let (ball, row) = seen_from_last(t, q);
    ball.side(&row).unwrap_or_else(|| near_side(t, q))
}

/// As `side`, where doubles cannot tell.
#[cold]
pub fn exact_side(t: &Corners, q: &WeightedPoint) -> Sign {
    integers::depth(t, q).unwrap_or_else(|| sign_in_space!(depth(t, q)))
}

/// Order of places by x, then y, then z; -0 equals 0. Coordinates are finite.
pub fn lexicographic(a: Point3, b: Point3) -> Ordering {
    let order = |a: f64, b: f64| (a + 0.0).total_cmp(&(b + 0.0));
    order(a.x, b.x).then(order(a.y, b.y)).then(order(a.z, b.z))
}

/// Whether q is in conflict with t under the one tie-break, from `side`, which was zero.
///
/// Definition: the lift of each point is raised by an infinitesimal, the lexicographically larger point by infinitely more. On the orthosphere of
/// t, with q = sum l_k t_k, the raised q lies below the raised plane of t iff e_q - sum l_k e_k < 0. The largest e with a nonzero coefficient
/// decides: 1 for q, -l_k for a corner, and l_k has the sign of the orientation of t with q in place of t_k. A corner of t is in no conflict.
#[cold]
pub fn tie_in_conflict(t: &Corners, q: &WeightedPoint) -> bool {
    let mut corners = [0, 1, 2, 3];
    corners.sort_by(|&i, &j| lexicographic(t[j].at, t[i].at));
    for k in corners {
        if lexicographic(t[k].at, q.at).is_le() {
            return false;
        }
        let mut p = t.map(|p| p.at);
        p[k] = q.at;
        match orient(p[0], p[1], p[2], p[3]) {
            Sign::Positive => return true,
            Sign::Negative => return false,
            Sign::Zero => {}
        }
    }
    false
}

/// Whether q is in conflict with t under the one tie-break.
pub fn in_conflict(t: &Corners, q: &WeightedPoint) -> bool {
    match side(t, q) {
        Sign::Positive => true,
        Sign::Negative => false,
        Sign::Zero => tie_in_conflict(t, q),
    }
}

#[cfg(test)]
mod tests;
