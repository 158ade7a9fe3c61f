//! The polynomials of the plane, each written once over a ring, for every stage of the fast kernel.
//!
//! All are written in differences to one corner: the differences are exact in each ring, and the polynomials are then
//! small where the triangle is small, whatever its offset. Source of the formulas: the definitions in `kernel.rs`;
//! circumcenter and off-center are derived at their functions.

use super::kernel::Corners;
use crate::model::Point2;

/// What the polynomials need of a number type.
pub(super) trait Ring: Clone {
    /// A finite f64.
    fn of(x: f64) -> Self;
    /// a - b of two f64s.
    fn difference(a: f64, b: f64) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn squared(&self) -> Self {
        self.times(self)
    }
    /// Twice the value.
    fn doubled(&self) -> Self;
    /// The middle and the largest of three values.
    fn two_largest(values: [Self; 3]) -> (Self, Self);
    /// The smaller of two values.
    fn smaller(a: Self, b: Self) -> Self;
}

/// num / den.
pub(super) struct Fraction<R> {
    pub num: R,
    pub den: R,
}

impl<R: Ring> Fraction<R> {
    /// A value of the sign of self - other, both denominators being positive.
    #[inline]
    pub fn against(&self, other: &Fraction<R>) -> R {
        self.num.times(&other.den).minus(&other.num.times(&self.den))
    }
}

/// A vector of the plane.
pub(super) struct Vector<R> {
    pub x: R,
    pub y: R,
}

impl<R: Ring> Vector<R> {
    /// The vector from a to b.
    #[inline]
    pub fn between(a: Point2, b: Point2) -> Self {
        Vector { x: R::difference(b.x, a.x), y: R::difference(b.y, a.y) }
    }
    #[inline]
    pub fn dot(&self, other: &Self) -> R {
        self.x.times(&other.x).plus(&self.y.times(&other.y))
    }
    #[inline]
    pub fn cross(&self, other: &Self) -> R {
        self.x.times(&other.y).minus(&self.y.times(&other.x))
    }
    #[inline]
    pub fn length2(&self) -> R {
        self.x.squared().plus(&self.y.squared())
    }
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Vector { x: self.x.plus(&other.x), y: self.y.plus(&other.y) }
    }
    #[inline]
    pub fn minus(&self, other: &Self) -> Self {
        Vector { x: self.x.minus(&other.x), y: self.y.minus(&other.y) }
    }
    #[inline]
    pub fn scaled(&self, factor: &R) -> Self {
        Vector { x: self.x.times(factor), y: self.y.times(factor) }
    }
}

/// Twice the signed area of a triangle.
#[inline]
pub(super) fn cross<R: Ring>([a, b, c]: Corners) -> R {
    Vector::<R>::between(a, b).cross(&Vector::between(a, c))
}

/// Positive if q is strictly inside the circle of a counterclockwise triangle: the lifted determinant about q.
#[inline]
pub(super) fn in_circle<R: Ring>([a, b, c]: Corners, q: Point2) -> R {
    let (a, b, c) = (Vector::<R>::between(q, a), Vector::between(q, b), Vector::between(q, c));
    let ta = a.length2().times(&b.cross(&c));
    let tb = b.length2().times(&c.cross(&a));
    let tc = c.length2().times(&a.cross(&b));
    ta.plus(&tb).plus(&tc)
}

/// Positive if w is strictly inside the circle with diameter uv: -(u-w).(v-w).
#[inline]
pub(super) fn in_diametral_circle<R: Ring>(u: Point2, v: Point2, w: Point2) -> R {
    Vector::<R>::between(w, u).dot(&Vector::between(v, w))
}

/// 9 cross(centroid, q, w): with s the sum of the corners, (3q - s) x (3w - s).
#[inline]
pub(super) fn walk_side<R: Ring>([a, b, c]: Corners, q: Point2, w: Point2) -> R {
    let from_centroid = |p| Vector::<R>::between(a, p).plus(&Vector::between(b, p)).plus(&Vector::between(c, p));
    from_centroid(q).cross(&from_centroid(w))
}

/// d = b - a and f = u + v - 2a, twice the way from a to the center of the circle with diameter uv.
#[inline]
fn edge_and_center<R: Ring>(u: Point2, v: Point2, a: Point2, b: Point2) -> (Vector<R>, Vector<R>) {
    (Vector::between(a, b), Vector::between(a, u).plus(&Vector::between(a, v)))
}

/// Positive if the foot of the center of the circle with diameter uv on the line ab is strictly after a: f.d.
#[inline]
pub(super) fn foot_after_start<R: Ring>(u: Point2, v: Point2, a: Point2, b: Point2) -> R {
    let (d, f) = edge_and_center::<R>(u, v, a, b);
    f.dot(&d)
}

/// Positive if that foot is strictly before b: 2 d.d - f.d.
#[inline]
pub(super) fn foot_before_end<R: Ring>(u: Point2, v: Point2, a: Point2, b: Point2) -> R {
    let (d, f) = edge_and_center::<R>(u, v, a, b);
    d.length2().doubled().minus(&f.dot(&d))
}

/// Positive if that foot is strictly inside the circle: |uv|^2 d.d - (d x f)^2.
#[inline]
pub(super) fn foot_depth<R: Ring>(u: Point2, v: Point2, a: Point2, b: Point2) -> R {
    let (d, f) = edge_and_center::<R>(u, v, a, b);
    length2::<R>(u, v).times(&d.length2()).minus(&d.cross(&f).squared())
}

/// |ab|^2.
#[inline]
pub(super) fn length2<R: Ring>(a: Point2, b: Point2) -> R {
    Vector::<R>::between(a, b).length2()
}

/// |ab|^2 - |cd|^2.
#[inline]
pub(super) fn lengths<R: Ring>(a: Point2, b: Point2, c: Point2, d: Point2) -> R {
    length2::<R>(a, b).minus(&length2(c, d))
}

/// |ab|^2 - bound.
#[inline]
pub(super) fn length2_less<R: Ring>(a: Point2, b: Point2, bound: f64) -> R {
    length2::<R>(a, b).minus(&R::of(bound))
}

/// The squared lengths of the edges and four times the squared cross product.
#[inline]
fn edges_and_cross<R: Ring>([a, b, c]: Corners) -> ([R; 3], R) {
    let (e, f, g) = (Vector::<R>::between(a, b), Vector::between(a, c), Vector::between(b, c));
    let cross = e.cross(&f);
    ([e.length2(), f.length2(), g.length2()], cross.doubled().squared())
}

/// r^2/l^2 = m2 n2 / (4 cross^2).
#[inline]
pub(super) fn ratio2<R: Ring>(t: Corners) -> Fraction<R> {
    let (lengths, den) = edges_and_cross::<R>(t);
    let (m2, n2) = R::two_largest(lengths);
    Fraction { num: m2.times(&n2), den }
}

/// r^2/h^2 = l2 m2 n2 / (4 cross^2 h^2).
#[inline]
pub(super) fn radius_ratio2<R: Ring>(t: Corners, h: f64) -> Fraction<R> {
    let ([k, l, m], den) = edges_and_cross::<R>(t);
    Fraction { num: k.times(&l).times(&m), den: den.times(&R::of(h).squared()) }
}

/// area/bound = cross / (2 bound).
#[inline]
pub(super) fn area_ratio<R: Ring>(t: Corners, bound: f64) -> Fraction<R> {
    Fraction { num: cross(t), den: R::of(bound).doubled() }
}

/// m2 n2 - 4 rho2 cross^2.
#[inline]
pub(super) fn skinny<R: Ring>(t: Corners, rho2: f64) -> R {
    let Fraction { num, den } = ratio2::<R>(t);
    num.minus(&den.times(&R::of(rho2)))
}

/// cross - 2 bound.
#[inline]
pub(super) fn area_excess<R: Ring>(t: Corners, bound: f64) -> R {
    cross::<R>(t).minus(&R::of(bound).doubled())
}

/// l2 m2 n2 - 4 cross^2 h^2.
#[inline]
pub(super) fn radius_excess<R: Ring>(t: Corners, h: f64) -> R {
    let Fraction { num, den } = radius_ratio2::<R>(t, h);
    num.minus(&den)
}

/// A point t[0] + offset/den.
pub(super) struct Center<R> {
    pub offset: Vector<R>,
    pub den: R,
}

/// Circumcenter of t: with e, f the edges from t[0], the point x with 2 e.x = e.e and 2 f.x = f.f, by Cramer's rule.
#[inline]
pub(super) fn circumcenter<R: Ring>([a, b, c]: Corners) -> Center<R> {
    let (e, f) = (Vector::<R>::between(a, b), Vector::between(a, c));
    let (e2, f2) = (e.length2(), f.length2());
    let x = e2.times(&f.y).minus(&f2.times(&e.y));
    let y = f2.times(&e.x).minus(&e2.times(&f.x));
    Center { offset: Vector { x, y }, den: e.cross(&f).doubled() }
}

/// The point o + (1 - d2)(x (w - o) + y rot90(w - o)), w = t[0]: with o = w + n/den, w - o = -n/den.
#[inline]
pub(super) fn in_disk<R: Ring>(t: Corners, d2: f64, x: f64, y: f64) -> Center<R> {
    let Center { offset: n, den } = circumcenter::<R>(t);
    let shrink = R::difference(1.0, d2);
    let (x, y) = (R::of(x).times(&shrink), R::of(y).times(&shrink));
    let moved =
        Vector { x: y.times(&n.y).minus(&x.times(&n.x)), y: R::of(0.0).minus(&x.times(&n.y).plus(&y.times(&n.x))) };
    Center { offset: n.plus(&moved), den }
}

/// Not negative if a is in the closed selection disk: (1-d2)^2 |n|^2 - |den (a - t[0]) - n|^2 with o = t[0] + n/den.
#[inline]
pub(super) fn in_selection_disk<R: Ring>(t: Corners, d2: f64, a: Point2) -> R {
    let Center { offset: n, den } = circumcenter::<R>(t);
    let away = Vector::<R>::between(t[0], a).scaled(&den).minus(&n);
    R::difference(1.0, d2).squared().times(&n.length2()).minus(&away.length2())
}

/// Not negative if 4 |p-c|^2 <= (1-delta)^2 |uv|^2.
#[inline]
pub(super) fn in_selection_interval<R: Ring>(u: Point2, v: Point2, delta: f64, p: Point2) -> R {
    let twice = Vector::<R>::between(u, p).plus(&Vector::between(v, p));
    R::difference(1.0, delta).squared().times(&length2(u, v)).minus(&twice.length2())
}

/// u.v for the edges u, v from the apex.
#[inline]
pub(super) fn dot<R: Ring>(apex: Point2, p: Point2, q: Point2) -> R {
    Vector::<R>::between(apex, p).dot(&Vector::between(apex, q))
}

/// (u.v)^2 - bound u^2 v^2.
#[inline]
pub(super) fn cos2<R: Ring>(apex: Point2, p: Point2, q: Point2, bound: f64) -> R {
    let sides = length2::<R>(apex, p).times(&length2(apex, q));
    dot::<R>(apex, p, q).squared().minus(&sides.times(&R::of(bound)))
}

/// Twice the point c + x (1-delta)/2 (b-a), c the midpoint of ab.
#[inline]
pub(super) fn in_interval_twice<R: Ring>(a: Point2, b: Point2, delta: f64, x: f64) -> Vector<R> {
    let factor = R::of(x).times(&R::difference(1.0, delta));
    let way = Vector::<R>::between(a, b).scaled(&factor);
    Vector { x: R::difference(a.x, -b.x).plus(&way.x), y: R::difference(a.y, -b.y).plus(&way.y) }
}

/// Positive if the circumcenter is farther than kappa |pq| from the midpoint of pq: (c-p).(c-q) - 2 kappa cross.
///
/// o = m + tau rot90(q-p) with tau = (c-p).(c-q)/(2 cross): half the cotangent of the angle at c.
#[inline]
pub(super) fn center_beyond<R: Ring>([p, q, c]: Corners, kappa: f64) -> R {
    let (f, g) = (Vector::<R>::between(p, c), Vector::between(q, c));
    f.dot(&g).minus(&f.cross(&g).doubled().times(&R::of(kappa)))
}

/// Twice the point m + kappa rot90(q-p), m the midpoint of pq.
#[inline]
pub(super) fn offcenter_twice<R: Ring>(p: Point2, q: Point2, kappa: f64) -> Vector<R> {
    let turned = Vector::<R>::between(p, q).scaled(&R::of(kappa).doubled());
    Vector { x: R::difference(p.x, -q.x).minus(&turned.y), y: R::difference(p.y, -q.y).plus(&turned.x) }
}

/// Positive if m + kappa rot90(q-p), not beyond o, is outside the closed selection disk.
///
/// Its distance from o is (tau - kappa)|pq| and r^2 = |pq|^2 |pc|^2 |qc|^2 / (4 cross^2); times 4 cross^2/|pq|^2:
/// ((c-p).(c-q) - 2 kappa cross)^2 - (1-d2)^2 |pc|^2 |qc|^2.
#[inline]
pub(super) fn offcenter_outside_disk<R: Ring>(t: Corners, kappa: f64, d2: f64) -> R {
    let [p, q, c] = t;
    let sides = length2::<R>(p, c).times(&length2(q, c));
    center_beyond::<R>(t, kappa).squared().minus(&R::difference(1.0, d2).squared().times(&sides))
}

/// A point base + (p + q sqrt(radicand))/den.
pub(super) struct Rooted<R> {
    pub p: Vector<R>,
    pub q: Vector<R>,
    pub radicand: R,
    pub den: R,
}

/// The point of the selection disk nearest to m on mo, o beyond m, about t[0]: o - (1-d2) r rot90(e)/|e|, e = t[1]-t[0].
///
/// r/|e| = |pc||qc| / (2 cross), so the root is that of |pc|^2 |qc|^2 over the denominator of o.
#[inline]
pub(super) fn clamped<R: Ring>(t: Corners, d2: f64) -> Rooted<R> {
    let [p, q, c] = t;
    let Center { offset, den } = circumcenter::<R>(t);
    let e = Vector::<R>::between(p, q).scaled(&R::difference(1.0, d2));
    let q_part = Vector { x: e.y.clone(), y: R::of(0.0).minus(&e.x) };
    Rooted { p: offset, q: q_part, radicand: length2::<R>(p, c).times(&length2(q, c)), den }
}

/// The point at distance `step` from a towards b, about a: step (b-a) sqrt(|ab|^2) / |ab|^2.
#[inline]
pub(super) fn at_distance<R: Ring>(a: Point2, b: Point2, step: f64) -> Rooted<R> {
    let d = Vector::<R>::between(a, b);
    let l2 = d.length2();
    let none = || R::of(0.0);
    Rooted { p: Vector { x: none(), y: none() }, q: d.scaled(&R::of(step)), radicand: l2.clone(), den: l2 }
}

/// r1^2/l1^2 - r2^2/l2^2, times a positive number.
#[inline]
pub(super) fn ratios<R: Ring>(t1: Corners, t2: Corners) -> R {
    ratio2::<R>(t1).against(&ratio2(t2))
}

/// area(t1)/bound1 - area(t2)/bound2, times a positive number.
#[inline]
pub(super) fn area_ratios<R: Ring>(t1: Corners, bound1: f64, t2: Corners, bound2: f64) -> R {
    area_ratio::<R>(t1, bound1).against(&area_ratio(t2, bound2))
}

/// r1^2/h1^2 - r2^2/h2^2, times a positive number.
#[inline]
pub(super) fn radius_ratios<R: Ring>(t1: Corners, h1: f64, t2: Corners, h2: f64) -> R {
    radius_ratio2::<R>(t1, h1).against(&radius_ratio2(t2, h2))
}
