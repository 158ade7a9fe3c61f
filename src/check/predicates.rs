//! The tests that make a triangulation: orientation, circle, and the one tie-break; and the polynomials they are the signs of.
//!
//! With a base corner a, the circumcenter of a counterclockwise triangle is o = a + C / (2 D) with D = cross(b - a, c - a) and
//! C = |b-a|^2 rot(c-a) - |c-a|^2 rot(b-a), rot(x, y) = (y, -x) up to sign: the solution of |o-a| = |o-b| = |o-c|.

use super::value::{Number, sign_of};
use crate::model::{Point2, Sign};

/// Corners of a triangle, counterclockwise.
pub type Corners = [Point2; 3];

/// A difference of two points.
pub type Vector<N> = [N; 2];

/// b - a.
#[inline]
pub fn vector<N: Number>(a: Point2, b: Point2) -> Vector<N> {
    [N::of(b.x) - N::of(a.x), N::of(b.y) - N::of(a.y)]
}

#[inline]
pub fn dot<N: Number>(u: &Vector<N>, v: &Vector<N>) -> N {
    u[0].clone() * v[0].clone() + u[1].clone() * v[1].clone()
}

#[inline]
pub fn cross<N: Number>(u: &Vector<N>, v: &Vector<N>) -> N {
    u[0].clone() * v[1].clone() - u[1].clone() * v[0].clone()
}

#[inline]
pub fn norm2<N: Number>(u: &Vector<N>) -> N {
    u[0].square() + u[1].square()
}

/// Twice the signed area of a, b, c.
pub fn area2<N: Number>(a: Point2, b: Point2, c: Point2) -> N {
    cross(&vector(a, b), &vector(a, c))
}

/// C and D of the circumcenter o = t[0] + C / (2 D).
pub fn center<N: Number>([a, b, c]: Corners) -> (Vector<N>, N) {
    let (u, v) = (vector::<N>(a, b), vector::<N>(a, c));
    let (u2, v2) = (norm2(&u), norm2(&v));
    let d = cross(&u, &v);
    let [ux, uy] = u;
    let [vx, vy] = v;
    let x = vy * u2.clone() - uy * v2.clone();
    let y = ux * v2 - vx * u2;
    ([x, y], d)
}

/// r^2 - |q - o|^2, times 2 D... without the factor: (q-a).C - D |q-a|^2, positive strictly inside the circle of t.
fn circle<N: Number>(t: Corners, q: Point2) -> N {
    let (c, d) = center::<N>(t);
    let w = vector::<N>(t[0], q);
    dot(&w, &c) - d * norm2(&w)
}

/// The sign of a polynomial from its value in floating point, if that is certain; `size` is the sum of the magnitudes of its monomials.
///
/// The differences of coordinates count as variables, so each is rounded once. No formula below rounds a monomial, its differences
/// included, more than 14 times. Every rounding is a factor within 1 ± 2^-53, so the value is off by less than 14.1 2^-53 times the exact sum of
/// magnitudes, which is less than 1 + 14.1 2^-53 times `size`: together less than 2^-49 `size`. Nothing underflows: stored coordinates are 0 or
/// within 2^-142..2^200 and of 53 bits, so differences are 0 or at least 2^-194, and what they make 0 or above 2^-900. The last factor alone
/// may be any f64 (the ratio of `is_skinny`, a seed in `orient`), which `TINY` pays for. Overflow gives an infinity or a NaN, and no answer.
#[inline]
pub fn certain(value: f64, size: f64) -> Option<Sign> {
    const TINY: f64 = 1e-300;
    let error = size * (f64::EPSILON * 8.0) + TINY;
    if value > error {
        Some(Sign::Positive)
    } else if value < -error {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// The two products of cross(u, v).
#[inline]
pub fn products([ux, uy]: [f64; 2], [vx, vy]: [f64; 2]) -> [f64; 2] {
    [ux * vy, uy * vx]
}

#[inline]
pub fn minus(b: Point2, a: Point2) -> [f64; 2] {
    [b.x - a.x, b.y - a.y]
}

#[inline]
pub fn square([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

/// Whether a, b, c turn counterclockwise.
#[inline]
pub fn orient(a: Point2, b: Point2, c: Point2) -> Sign {
    let [l, r] = products(minus(b, a), minus(c, a));
    certain(l - r, l.abs() + r.abs()).unwrap_or_else(|| sign_of!(area2(a, b, c)))
}

/// Position of q against the circle through t: positive strictly inside.
#[inline]
pub fn in_circle(t: Corners, q: Point2) -> Sign {
    let [u, v, w] = [t[1], t[2], q].map(|p| minus(p, t[0]));
    let (mut value, mut size) = (0.0, 0.0);
    for ([l, r], lift) in [(products(w, v), square(u)), (products(u, w), square(v)), (products(v, u), square(w))] {
        value += (l - r) * lift;
        size += (l.abs() + r.abs()) * lift;
    }
    certain(value, size).unwrap_or_else(|| sign_of!(circle(t, q)))
}

/// Whether q is in conflict with t under the one tie-break.
///
/// Definition: the lift of each point is raised by an infinitesimal, the lexicographically larger point by infinitely more. On the circle of t,
/// with q = sum l_k t_k, the raised q lies below the raised plane of t iff e_q - sum l_k e_k < 0. The largest e with a nonzero coefficient decides:
/// 1 for q, -l_k for a corner, and l_k has the sign of the orientation of t with q in place of t_k.
pub fn in_conflict(t: Corners, q: Point2) -> bool {
    match in_circle(t, q) {
        Sign::Positive => return true,
        Sign::Negative => return false,
        Sign::Zero => {}
    }
    let mut corners = [0, 1, 2];
    let precedes = |a: Point2, b: Point2| (a.x, a.y) < (b.x, b.y);
    corners.sort_by(|&i, &j| (t[j].x, t[j].y).partial_cmp(&(t[i].x, t[i].y)).unwrap_or(std::cmp::Ordering::Equal));
    for k in corners {
        if precedes(t[k], q) {
            return false;
        }
        let mut replaced = t;
        replaced[k] = q;
        match orient(replaced[0], replaced[1], replaced[2]) {
            Sign::Positive => return true,
            Sign::Negative => return false,
            Sign::Zero => {}
        }
    }
    false
}
