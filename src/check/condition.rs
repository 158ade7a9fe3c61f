//! Every geometric condition of the rules, stated once from its definition as the sign of a polynomial. (`predicates` has those of a triangulation.)
//!
//! Coordinates are scaled by the checker's own power of two (`Scale`), lengths that the trace states in input units are
//! brought to it exactly. Triangles are counterclockwise; `center` gives their circumcenters.

use super::predicates::{Corners, area2, center, certain, cross, dot, minus, norm2, products, square, vector};
use super::value::{Number, sign_of};
use crate::model::{Point2, Sign};

/// |ab|^2.
pub fn distance2<N: Number>(a: Point2, b: Point2) -> N {
    norm2(&vector(a, b))
}

/// (w - u).(v - w): positive strictly inside the circle with diameter uv.
fn diametral<N: Number>(u: Point2, v: Point2, w: Point2) -> N {
    dot(&vector::<N>(u, w), &vector(w, v))
}

/// cross(x, q, w) times 9, with x the centroid of t.
fn beside_walk<N: Number>(t: Corners, q: Point2, w: Point2) -> N {
    let three = N::of(3.0);
    let from_centroid = |p: Point2| {
        let sum = |a: f64, b: f64, c: f64| N::of(a) + N::of(b) + N::of(c);
        [
            three.clone() * N::of(p.x) - sum(t[0].x, t[1].x, t[2].x),
            three.clone() * N::of(p.y) - sum(t[0].y, t[1].y, t[2].y),
        ]
    };
    cross::<N>(&from_centroid(q), &from_centroid(w))
}

/// |ab|^2 - |cd|^2.
fn longer<N: Number>(a: Point2, b: Point2, c: Point2, d: Point2) -> N {
    distance2::<N>(a, b) - distance2(c, d)
}

/// e2 f2 - 4 rho2 cross^2 for the edges other than `k` to `k + 1`: not negative if r^2 >= rho2 |edge k|^2.
fn excess_ratio<N: Number>(t: Corners, k: usize, rho2: f64) -> N {
    let (p, q, s) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
    let others = distance2::<N>(q, s) * distance2(s, p);
    others - N::of(4.0 * rho2) * area2::<N>(p, q, s).square()
}

/// 2 area - 2 bound; bound = `bound` 2^`exponent`.
fn excess_area<N: Number>(t: Corners, bound: f64, exponent: i32) -> N {
    area2::<N>(t[0], t[1], t[2]) - N::scaled(bound, exponent + 1)
}

/// l2 m2 n2 - 4 cross^2 h^2; h = `h` 2^`exponent`.
fn excess_radius<N: Number>(t: Corners, h: f64, exponent: i32) -> N {
    let product = distance2::<N>(t[0], t[1]) * distance2(t[1], t[2]) * distance2(t[2], t[0]);
    product - N::of(4.0) * (area2::<N>(t[0], t[1], t[2]) * N::scaled(h, exponent)).square()
}

/// (1 - d2)^2 r^2 - |a - o|^2, times 4 D^2: not negative in the closed selection disk. \[GCDR\] Definition 3.1.
fn selection_disk<N: Number>(t: Corners, d2: f64, a: Point2) -> N {
    let (c, d) = center::<N>(t);
    let w = vector::<N>(t[0], a);
    let two_d = d.clone() + d;
    let off = [w[0].clone() * two_d.clone() - c[0].clone(), w[1].clone() * two_d - c[1].clone()];
    (N::of(1.0) - N::of(d2)).square() * norm2(&c) - norm2(&off)
}

/// (1 - delta)^2 |uv|^2 - |2p - u - v|^2. \[GCDR\] Definitions 3.2, 3.3.
fn selection_interval<N: Number>(u: Point2, v: Point2, delta: f64, p: Point2) -> N {
    let to_u = vector::<N>(u, p);
    let to_v = vector::<N>(v, p);
    let off = [to_u[0].clone() + to_v[0].clone(), to_u[1].clone() + to_v[1].clone()];
    (N::of(1.0) - N::of(delta)).square() * distance2::<N>(u, v) - norm2(&off)
}

/// cross(uv, up)^2 - tolerance^2 (|x| + |y|)^2, (x, y) = uv: a point of the line moved by at most the tolerance in each coordinate has none.
fn excess_deviation<N: Number>(u: Point2, v: Point2, p: Point2, tolerance: f64) -> N {
    let of = |a: f64, b: f64| N::of(a.max(b)) - N::of(a.min(b));
    let reach = N::of(tolerance) * (of(u.x, v.x) + of(u.y, v.y));
    area2::<N>(u, v, p).square() - reach.square()
}

/// |apex p|^2 - (distance + tolerance)^2.
fn excess_distance<N: Number>(apex: Point2, p: Point2, distance: f64, exponent: i32, tolerance: f64) -> N {
    let reach = N::scaled(distance, exponent) + N::of(tolerance);
    distance2::<N>(apex, p) - reach.square()
}

/// distance - tolerance.
fn longer_than<N: Number>(distance: f64, exponent: i32, tolerance: f64) -> N {
    N::scaled(distance, exponent) - N::of(tolerance)
}

/// cross(uv, uw)^2 times 4 - |uv|^4: negative if the line of ... see `meets_diametral_disk`.
fn line_beyond_disk<N: Number>(u: Point2, v: Point2, a: Point2, b: Point2) -> N {
    // Distance from the midpoint c of uv to the line ab against |uv|/2: cross(ab, 2c - 2a)^2 against |ab|^2 |uv|^2.
    let ab = vector::<N>(a, b);
    let au = vector::<N>(a, u);
    let av = vector::<N>(a, v);
    let twice = [au[0].clone() + av[0].clone(), au[1].clone() + av[1].clone()];
    cross(&ab, &twice).square() - norm2(&ab) * distance2::<N>(u, v)
}

/// ab.(2c - 2a), c the midpoint of uv: positive if the foot of c on the line ab lies beyond a, toward b.
fn foot_beyond<N: Number>(u: Point2, v: Point2, a: Point2, b: Point2) -> N {
    let ab = vector::<N>(a, b);
    dot(&ab, &vector(a, u)) + dot(&ab, &vector(a, v))
}

/// Whether w lies strictly inside the circle with diameter uv.
pub fn in_diametral_disk(u: Point2, v: Point2, w: Point2) -> bool {
    sign_of!(diametral(u, v, w)).is_positive()
}

/// Side of w seen from the centroid of t toward q: positive on the left.
pub fn walk_side(t: Corners, q: Point2, w: Point2) -> Sign {
    sign_of!(beside_walk(t, q, w))
}

/// Sign of |ab| - |cd|.
#[inline]
pub fn compare_lengths(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    let (ab, cd) = (square(minus(b, a)), square(minus(d, c)));
    certain(ab - cd, ab + cd).unwrap_or_else(|| sign_of!(longer(a, b, c, d)))
}

/// Whether t is skinny: r^2 >= rho2 l^2 for its shortest edge, that is for some edge.
pub fn is_skinny(t: Corners, rho2: f64) -> bool {
    let [a, b, c] = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| square(minus(t[j], t[i])));
    let others = (a * b).max(b * c).max(c * a);
    let [l, r] = products(minus(t[1], t[0]), minus(t[2], t[0]));
    let (area, size) = (l - r, l.abs() + r.abs());
    let factor = 4.0 * rho2;
    match certain(others - area * area * factor, others + size * size * factor) {
        Some(sign) => !sign.is_negative(),
        None => (0..3).any(|k| !sign_of!(excess_ratio(t, k, rho2)).is_negative()),
    }
}

/// Whether the area of t exceeds `bound` 2^`exponent`.
pub fn exceeds_area(t: Corners, bound: f64, exponent: i32) -> bool {
    sign_of!(excess_area(t, bound, exponent)).is_positive()
}

/// Whether the circumradius of t exceeds `h` 2^`exponent`.
pub fn exceeds_radius(t: Corners, h: f64, exponent: i32) -> bool {
    sign_of!(excess_radius(t, h, exponent)).is_positive()
}

/// Whether a lies in the closed selection disk of t.
pub fn in_selection_disk(t: Corners, d2: f64, a: Point2) -> bool {
    !sign_of!(selection_disk(t, d2, a)).is_negative()
}

/// Whether p lies in the disk about the midpoint of uv that has the selection interval as diameter.
pub fn in_selection_interval(u: Point2, v: Point2, delta: f64, p: Point2) -> bool {
    !sign_of!(selection_interval(u, v, delta, p)).is_negative()
}

/// Whether p lies within `tolerance` of the line uv, in each coordinate.
pub fn is_near_line(u: Point2, v: Point2, p: Point2, tolerance: f64) -> bool {
    !sign_of!(excess_deviation(u, v, p, tolerance)).is_positive()
}

/// Whether |apex p| is `distance` 2^`exponent` up to `tolerance`.
pub fn is_at_distance(apex: Point2, p: Point2, distance: f64, exponent: i32, tolerance: f64) -> bool {
    let near = !sign_of!(longer_than(distance, exponent, tolerance)).is_positive();
    !sign_of!(excess_distance(apex, p, distance, exponent, tolerance)).is_positive()
        && (near || !sign_of!(excess_distance(apex, p, distance, exponent, -tolerance)).is_negative())
}

/// Whether the closed edge ab meets the open disk with diameter uv.
pub fn meets_diametral_disk(u: Point2, v: Point2, a: Point2, b: Point2) -> bool {
    if in_diametral_disk(u, v, a) || in_diametral_disk(u, v, b) {
        return true;
    }
    sign_of!(foot_beyond(u, v, a, b)).is_positive()
        && sign_of!(foot_beyond(u, v, b, a)).is_positive()
        && sign_of!(line_beyond_disk(u, v, a, b)).is_negative()
}

/// Which edge of t is the shortest, as the corner it starts from; ties by the smaller pair of `ids`.
pub fn shortest_edge(t: Corners, ids: [u32; 3]) -> usize {
    let pair = |k: usize| {
        let (a, b) = (ids[k], ids[(k + 1) % 3]);
        (a.min(b), a.max(b))
    };
    let mut best = 0;
    for k in 1..3 {
        match compare_lengths(t[k], t[(k + 1) % 3], t[best], t[(best + 1) % 3]) {
            Sign::Negative => best = k,
            Sign::Zero if pair(k) < pair(best) => best = k,
            _ => {}
        }
    }
    best
}

/// 4 (x.y)^2 - x^2 y^2 for the directions x, y from an apex.
fn excess_cosine<N: Number>(apex: Point2, p: Point2, q: Point2) -> N {
    let (x, y) = (vector::<N>(apex, p), vector::<N>(apex, q));
    N::of(4.0) * dot(&x, &y).square() - norm2(&x) * norm2(&y)
}

fn cosine<N: Number>(apex: Point2, p: Point2, q: Point2) -> N {
    dot(&vector::<N>(apex, p), &vector(apex, q))
}

/// Whether the angle at `apex` between p and q is below 60 degrees.
pub fn is_below_60(apex: Point2, p: Point2, q: Point2) -> bool {
    sign_of!(cosine(apex, p, q)).is_positive() && sign_of!(excess_cosine(apex, p, q)).is_positive()
}

/// 9 * 4^k - f |uv|^2.
fn shell_excess<N: Number>(u: Point2, v: Point2, f: f64, k: i32) -> N {
    N::scaled(9.0, k.saturating_mul(2)) - N::of(f) * distance2::<N>(u, v)
}

/// Whether |uv|/3 < 2^k <= 2 |uv|/3; 2^k in units of 2^-`exponent`.
pub fn is_shell_exponent(u: Point2, v: Point2, k: i32, exponent: i32) -> bool {
    let k = k.saturating_sub(exponent);
    // Lengths lie in 2^-200..2^210, so no other exponent fits, and the powers stay small.
    (-300..300).contains(&k)
        && sign_of!(shell_excess(u, v, 1.0, k)).is_positive()
        && !sign_of!(shell_excess(u, v, 4.0, k)).is_positive()
}
