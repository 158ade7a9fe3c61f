//! What a replay tests again and again, arranged for speed; and what it tests seldom.
//!
//! All new tetrahedra of an insertion share the new vertex. Seen from it (`Row`), an orthoball (`Ball`) is had from three rows, and a test against it is four
//! products. With u, v, w the rows of a positively oriented tetrahedron (.., p) as its first three corners are seen from p, D = det(u, v, w) < 0 and
//! C = L(u) (v x w) + L(v) (w x u) + L(w) (u x v), a point x is nearer than the orthoball iff D L(x) - C.x > 0: `predicates`, with p as base. Roundings are as many as
//! there; instead of sums of magnitudes, products of the largest ones bound them.

use super::predicates::{Corners, Vector, certain, cross, dot, exact_side, orient};
use crate::check::value::{Number, sign_of};
use crate::model::{Point3, Sign, WeightedPoint};
use crate::trace::Apex;

/// A point seen from another.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    to: [f64; 3],
    lift: f64,
    /// The sum of the magnitudes of what makes the lift.
    size: f64,
}

impl Row {
    /// q seen from p.
    #[inline]
    pub fn new(p: WeightedPoint, q: WeightedPoint) -> Row {
        let to = [q.at.x - p.at.x, q.at.y - p.at.y, q.at.z - p.at.z];
        let square = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
        let weight = q.weight - p.weight;
        Row { to, lift: square - weight, size: square + weight.abs() }
    }
}

/// The orthoball of a tetrahedron as seen from its last corner, in floating point.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    c: [f64; 3],
    d: f64,
    /// Bounds of the sums of the magnitudes of the monomials of C and D.
    c_size: [f64; 3],
    d_size: f64,
}

impl Ball {
    /// From the other three corners.
    #[inline]
    pub fn new(u: &Row, v: &Row, w: &Row) -> Ball {
        let cross =
            |[ux, uy, uz]: [f64; 3], [vx, vy, vz]: [f64; 3]| [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
        let [vw, wu, uv] = [cross(v.to, w.to), cross(w.to, u.to), cross(u.to, v.to)];
        let c = [0, 1, 2].map(|k: usize| u.lift * vw[k] + v.lift * wu[k] + w.lift * uv[k]);
        let d = u.to[0] * vw[0] + u.to[1] * vw[1] + u.to[2] * vw[2];
        let [x, y, z] = [0, 1, 2].map(|k: usize| u.to[k].abs().max(v.to[k].abs()).max(w.to[k].abs()));
        let lift = u.size.max(v.size).max(w.size) * 6.0;
        Ball { c, d, c_size: [lift * (y * z), lift * (z * x), lift * (x * y)], d_size: 6.0 * x * y * z }
    }

    /// D L(q) - C.q.
    #[inline]
    fn value(&self, q: &Row) -> f64 {
        let [x, y, z] = q.to;
        q.lift * self.d - (x * self.c[0] + y * self.c[1] + z * self.c[2])
    }

    /// Whether the tetrahedron is positively oriented, if that is certain.
    #[inline]
    pub fn orientation(&self) -> Option<Sign> {
        certain(-self.d, self.d_size)
    }

    /// The side of q, if that is certain: positive strictly nearer than the orthoball.
    #[inline]
    pub fn side(&self, q: &Row) -> Option<Sign> {
        let [x, y, z] = q.to;
        let c = &self.c_size;
        certain(self.value(q), q.size * self.d_size + (x.abs() * c[0] + y.abs() * c[1] + z.abs() * c[2]))
    }
}

/// The side of q against the orthoball of t, where a ball of it was uncertain: by the same value where nothing in it is rounded, as on grids, else exactly.
#[cold]
pub fn near_side(t: &Corners, q: &WeightedPoint) -> Sign {
    if !is_unrounded(t, q) {
        return exact_side(t, q);
    }
    let (ball, q) = seen_from_last(t, q);
    match ball.value(&q) {
        value if value > 0.0 => Sign::Positive,
        value if value < 0.0 => Sign::Negative,
        _ => Sign::Zero,
    }
}

/// The ball of t, and q as seen from its last corner.
#[inline]
pub(super) fn seen_from_last(t: &Corners, q: &WeightedPoint) -> (Ball, Row) {
    let [u, v, w] = [0, 1, 2].map(|k: usize| Row::new(t[3], t[k]));
    (Ball::new(&u, &v, &w), Row::new(t[3], *q))
}

/// Whether all numbers seen from the last corner are exact, coordinates multiples of a power of two u below 2^9 u, and weights multiples of u^2 below
/// 2^20 u^2. Then lifts are below 2^21 u^2, no sum in a ball's value exceeds 24 2^48 u^5 < 2^53 u^5, and all are multiples of u^5, u^4 or so: exact.
fn is_unrounded(t: &Corners, q: &WeightedPoint) -> bool {
    let p = t[3];
    let others = [t[0], t[1], t[2], *q];
    let (mut low, mut high, mut exact) = (i32::MAX, i32::MIN, true);
    let mut weights = (i32::MAX, i32::MIN);
    let note = |x: f64, y: f64, exact: &mut bool, (low, high): (&mut i32, &mut i32)| {
        let difference = x - y;
        let part = x - difference;
        // What the subtraction has lost (two-sum, Knuth).
        *exact &= (x - (difference + part)) + (part - y) == 0.0;
        if difference != 0.0 {
            let bits = difference.to_bits();
            let exponent = (bits >> 52 & 0x7ff) as i32;
            *exact &= exponent != 0;
            *low = (*low).min(exponent - 52 + (bits | 1 << 52).trailing_zeros() as i32);
            *high = (*high).max(exponent);
        }
    };
    for o in others {
        note(o.at.x, p.at.x, &mut exact, (&mut low, &mut high));
        note(o.at.y, p.at.y, &mut exact, (&mut low, &mut high));
        note(o.at.z, p.at.z, &mut exact, (&mut low, &mut high));
        note(o.weight, p.weight, &mut exact, (&mut weights.0, &mut weights.1));
        // Most often the first one tells. (Where all differences are 0, low is the largest number.)
        if !exact || high > low.saturating_add(8) {
            return false;
        }
    }
    // Exponents are biased by 1023. The fifth power of u must not underflow, nor 2^53 of them overflow.
    if !(1023 - 200..1023 + 190).contains(&low) {
        return false;
    }
    let unit2 = 2 * (low - 1023) + 1023;
    let light = weights.1 == i32::MIN || (weights.0 >= unit2 && weights.1 - unit2 < 20);
    exact && light
}

/// Whether c and e, in one plane with a and b, lie strictly on different sides of the line ab; a, b, c are not collinear.
pub fn across(a: Point3, b: Point3, c: Point3, e: Point3) -> bool {
    fn area<N: Number>(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> N {
        let minus = |p: f64, q: f64| N::of(p) - N::of(q);
        minus(b[0], a[0]) * minus(c[1], a[1]) - minus(b[1], a[1]) * minus(c[0], a[0])
    }
    // In a projection along an axis that keeps the triangle a triangle.
    for flat in [|p: Point3| [p.x, p.y], |p: Point3| [p.y, p.z], |p: Point3| [p.z, p.x]] {
        let [a, b, c, e] = [a, b, c, e].map(flat);
        let own: Sign = sign_of!(area(a, b, c));
        if own != Sign::Zero {
            return sign_of!(area(a, b, e)) == own.reversed();
        }
    }
    false
}

/// The sign of det(u - o, v - o, g - o), o the centroid of t and g that of the triangle f: on which side of the plane through o, u and v the
/// triangle's middle is.
pub fn side_from_middle(t: [Point3; 4], f: [Point3; 3], u: Point3, v: Point3) -> Sign {
    fn determinant<N: Number>(t: [Point3; 4], f: [Point3; 3], u: Point3, v: Point3) -> N {
        let sum = |points: &[Point3]| -> Vector<N> {
            let add = |x: Vector<N>, y: Vector<N>| {
                let ([a, b, c], [d, e, f]) = (x, y);
                [a + d, b + e, c + f]
            };
            let zero = [0.0, 0.0, 0.0].map(N::of);
            points.iter().map(|p| p.to_array().map(N::of)).fold(zero, add)
        };
        let times = |k: f64, [x, y, z]: Vector<N>| [N::of(k) * x, N::of(k) * y, N::of(k) * z];
        let minus = |[a, b, c]: Vector<N>, [d, e, f]: Vector<N>| [a - d, b - e, c - f];
        // Four times the vectors to u and v, twelve times that to g.
        let o = sum(&t);
        let from = |p: Point3| minus(times(4.0, p.to_array().map(N::of)), o.clone());
        let g = minus(times(4.0, sum(&f)), times(3.0, o.clone()));
        dot(&from(u), &cross(&from(v), &g))
    }
    sign_of!(determinant(t, f, u, v))
}

/// Whether some points are affinely independent: whether apexes make a tetrahedron of them. (The six are in no plane.)
pub fn independent(points: &[Point3]) -> bool {
    match *points {
        [] => true,
        [a, b, c, d] => orient(a, b, c, d) != Sign::Zero,
        _ if points.len() > 4 => false,
        _ => Apex::ALL.iter().any(|apex| {
            let more: Vec<Point3> = points.iter().copied().chain([apex.place()]).collect();
            independent(&more)
        }),
    }
}

/// The apexes of some affinely independent points: each the first of the six that is independent of them and those before.
pub fn apexes_of(points: &[Point3]) -> Vec<Apex> {
    let mut all = points.to_vec();
    let mut chosen = Vec::new();
    while all.len() < 4 {
        let next = Apex::ALL.into_iter().find(|apex| {
            all.push(apex.place());
            let good = independent(&all);
            all.pop();
            good
        });
        let Some(apex) = next else { break };
        all.push(apex.place());
        chosen.push(apex);
    }
    chosen
}
