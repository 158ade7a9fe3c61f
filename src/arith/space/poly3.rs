//! The polynomials of space, each written once over a ring, for every stage of the fast kernel.
//!
//! As in the plane, all are written in differences to one corner. With v_i = p_i - p_0, h_i = |v_i|^2 + w_0 - w_i:
//! orthocenter of a tetrahedron p_0 + (h_1 v_2 x v_3 + h_2 v_3 x v_1 + h_3 v_1 x v_2) / (2 v_1.(v_2 x v_3)) by Cramer's rule;
//! of a triangle, with n = v_1 x v_2, p_0 + C/(2 |n|^2), C = h_1 (v_2 x n) + h_2 (n x v_1). A power test against either follows from
//! w_q + R^2 - |q - o|^2 = w_q - w_0 - |r|^2 + 2 r.(o - p_0), r = q - p_0.

use super::kernel3::{Corners3, WeightedCorners};
use crate::arith::poly::{Fraction, Ring};
use crate::model::{Point3, WeightedPoint};

/// A vector of space.
pub(super) struct Vector3<R> {
    pub x: R,
    pub y: R,
    pub z: R,
}

impl<R: Ring> Vector3<R> {
    /// The vector from a to b.
    #[inline]
    pub fn between(a: Point3, b: Point3) -> Self {
        Vector3 { x: R::difference(b.x, a.x), y: R::difference(b.y, a.y), z: R::difference(b.z, a.z) }
    }
    #[inline]
    fn of(v: Point3) -> Self {
        Vector3 { x: R::of(v.x), y: R::of(v.y), z: R::of(v.z) }
    }
    #[inline]
    pub fn dot(&self, other: &Self) -> R {
        self.x.times(&other.x).plus(&self.y.times(&other.y)).plus(&self.z.times(&other.z))
    }
    #[inline]
    pub fn cross(&self, other: &Self) -> Self {
        Vector3 {
            x: self.y.times(&other.z).minus(&self.z.times(&other.y)),
            y: self.z.times(&other.x).minus(&self.x.times(&other.z)),
            z: self.x.times(&other.y).minus(&self.y.times(&other.x)),
        }
    }
    #[inline]
    pub fn length2(&self) -> R {
        self.x.squared().plus(&self.y.squared()).plus(&self.z.squared())
    }
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Vector3 { x: self.x.plus(&other.x), y: self.y.plus(&other.y), z: self.z.plus(&other.z) }
    }
    #[inline]
    pub fn scaled(&self, factor: &R) -> Self {
        Vector3 { x: self.x.times(factor), y: self.y.times(factor), z: self.z.times(factor) }
    }
}

/// A point `base` + offset/den.
pub(super) struct Center3<R> {
    pub offset: Vector3<R>,
    pub den: R,
}

/// A point `base` + (p + q sqrt(radicand))/den.
pub(super) struct Rooted3<R> {
    pub p: Vector3<R>,
    pub q: Vector3<R>,
    pub radicand: R,
    pub den: R,
}

/// Points without weights.
#[inline]
pub(super) fn unweighted<const N: usize>(t: [Point3; N]) -> [WeightedPoint; N] {
    t.map(WeightedPoint::unweighted)
}

/// det(b - a, c - a, d - a).
#[inline]
pub(super) fn orient3d<R: Ring>(a: Point3, b: Point3, c: Point3, d: Point3) -> R {
    let (b, c, d) = (Vector3::<R>::between(a, b), Vector3::between(a, c), Vector3::between(a, d));
    b.dot(&c.cross(&d))
}

/// Positive if q is in conflict with the positively oriented t: the lifted determinant about q.
#[inline]
pub(super) fn power_side<R: Ring>(t: WeightedCorners, q: WeightedPoint) -> R {
    let v = t.map(|p| Vector3::<R>::between(q.at, p.at));
    let lift = |k: usize| v[k].length2().plus(&R::difference(q.weight, t[k].weight));
    let minor = |i: usize, j: usize| v[i].x.times(&v[j].y).minus(&v[i].y.times(&v[j].x));
    let (ab, bc, cd, ac, bd, ad) = (minor(0, 1), minor(1, 2), minor(2, 3), minor(0, 2), minor(1, 3), minor(0, 3));
    let z = |k: usize| &v[k].z;
    let bcd = z(1).times(&cd).minus(&z(2).times(&bd)).plus(&z(3).times(&bc));
    let acd = z(0).times(&cd).minus(&z(2).times(&ad)).plus(&z(3).times(&ac));
    let abd = z(0).times(&bd).minus(&z(1).times(&ad)).plus(&z(3).times(&ab));
    let abc = z(0).times(&bc).minus(&z(1).times(&ac)).plus(&z(2).times(&ab));
    let even = lift(0).times(&bcd).plus(&lift(2).times(&abd));
    even.minus(&lift(1).times(&acd).plus(&lift(3).times(&abc)))
}

/// h = |v|^2 + w_0 - w and v = p - p_0.
#[inline]
fn edge<R: Ring>(base: WeightedPoint, p: WeightedPoint) -> (Vector3<R>, R) {
    let v = Vector3::<R>::between(base.at, p.at);
    let h = v.length2().plus(&R::difference(base.weight, p.weight));
    (v, h)
}

/// w_q - w_0 - |r|^2 and r = q - p_0.
#[inline]
fn depth<R: Ring>(base: WeightedPoint, q: WeightedPoint) -> (Vector3<R>, R) {
    let r = Vector3::<R>::between(base.at, q.at);
    let depth = R::difference(q.weight, base.weight).minus(&r.length2());
    (r, depth)
}

/// Orthocenter of a tetrahedron, about its first corner.
#[inline]
pub(super) fn orthocenter<R: Ring>(t: WeightedCorners) -> Center3<R> {
    let [(u, hu), (v, hv), (w, hw)] = [edge::<R>(t[0], t[1]), edge(t[0], t[2]), edge(t[0], t[3])];
    let (vw, wu, uv) = (v.cross(&w), w.cross(&u), u.cross(&v));
    let offset = vw.scaled(&hu).plus(&wu.scaled(&hv)).plus(&uv.scaled(&hw));
    Center3 { offset, den: u.dot(&vw).doubled() }
}

/// n = v_1 x v_2, 2 |n|^2 and C: the orthocenter of a triangle is p_0 + C/(2 |n|^2).
#[inline]
fn axis<R: Ring>(t: [WeightedPoint; 3]) -> (Vector3<R>, Center3<R>) {
    let [(u, hu), (v, hv)] = [edge::<R>(t[0], t[1]), edge(t[0], t[2])];
    let n = u.cross(&v);
    let offset = v.cross(&n).scaled(&hu).plus(&n.cross(&u).scaled(&hv));
    let den = n.length2().doubled();
    (n, Center3 { offset, den })
}

/// Orthocenter of a triangle in its plane, about its first corner.
#[inline]
pub(super) fn orthocenter_of_triangle<R: Ring>(t: [WeightedPoint; 3]) -> Center3<R> {
    axis(t).1
}

/// Where the dual line of t meets the plane through u with normal m, about the first corner of t:
/// (C (n.m) + n ((u - p_0).m 2|n|^2 - C.m)) / (2|n|^2 (n.m)).
#[inline]
pub(super) fn dual_line_meets_plane<R: Ring>(t: [WeightedPoint; 3], u: Point3, m: Point3) -> Center3<R> {
    let (n, Center3 { offset: c, den }) = axis::<R>(t);
    let m = Vector3::<R>::of(m);
    let slope = n.dot(&m);
    let along = Vector3::<R>::between(t[0].at, u).dot(&m).times(&den).minus(&c.dot(&m));
    Center3 { offset: c.scaled(&slope).plus(&n.scaled(&along)), den: den.times(&slope) }
}

/// Positive if q is in conflict with the smallest orthoball of t, times |n|^2.
#[inline]
pub(super) fn power_side_of_triangle<R: Ring>(t: [WeightedPoint; 3], q: WeightedPoint) -> R {
    let (_, Center3 { offset, den }) = axis::<R>(t);
    let (r, depth) = depth::<R>(t[0], q);
    den.times(&depth).plus(&r.dot(&offset).doubled())
}

/// Positive if q is in conflict with the smallest orthoball of a and b: |d|^2 (w_q - w_a - |r|^2) + h (r.d), d = b - a.
#[inline]
pub(super) fn power_side_of_edge<R: Ring>(a: WeightedPoint, b: WeightedPoint, q: WeightedPoint) -> R {
    let (d, h) = edge::<R>(a, b);
    let (r, depth) = depth::<R>(a, q);
    d.length2().times(&depth).plus(&h.times(&r.dot(&d)))
}

/// Positive if w is strictly inside the ball with diameter uv: -(u-w).(v-w).
#[inline]
pub(super) fn in_diametral_ball<R: Ring>(u: Point3, v: Point3, w: Point3) -> R {
    Vector3::<R>::between(w, u).dot(&Vector3::between(v, w))
}

/// |ab|^2.
#[inline]
pub(super) fn length2<R: Ring>(a: Point3, b: Point3) -> R {
    Vector3::<R>::between(a, b).length2()
}

/// |ab|^2 - |cd|^2.
#[inline]
pub(super) fn lengths<R: Ring>(a: Point3, b: Point3, c: Point3, d: Point3) -> R {
    length2::<R>(a, b).minus(&length2(c, d))
}

/// |x - p|^2 - w_p - |x - q|^2 + w_q.
#[inline]
pub(super) fn power_distances<R: Ring>(x: Point3, p: WeightedPoint, q: WeightedPoint) -> R {
    lengths::<R>(x, p.at, x, q.at).plus(&R::difference(q.weight, p.weight))
}

/// R^2 of a tetrahedron: |o - p_0|^2 - w_0.
#[inline]
fn orthoradius2<R: Ring>(t: WeightedCorners) -> Fraction<R> {
    let Center3 { offset, den } = orthocenter::<R>(t);
    let den = den.squared();
    Fraction { num: offset.length2().minus(&den.times(&R::of(t[0].weight))), den }
}

/// R^2 - bound, times a positive number.
#[inline]
pub(super) fn orthoradius2_excess<R: Ring>(t: WeightedCorners, bound: f64) -> R {
    let Center3 { offset, den } = orthocenter::<R>(t);
    offset.length2().minus(&den.squared().times(&R::difference(t[0].weight, -bound)))
}

/// R^2 of t1 - R^2 of t2, times a positive number.
#[inline]
pub(super) fn orthoradii<R: Ring>(t1: WeightedCorners, t2: WeightedCorners) -> R {
    orthoradius2::<R>(t1).against(&orthoradius2(t2))
}

/// R^2 - rho2 l^2 of a tetrahedron, times a positive number.
#[inline]
pub(super) fn radius_edge<R: Ring>(t: Corners3, rho2: f64) -> R {
    let Center3 { offset, den } = orthocenter::<R>(unweighted(t));
    let [a, b, c, d] = t;
    let shortest2 = [(a, c), (a, d), (b, c), (b, d), (c, d)]
        .into_iter()
        .fold(length2::<R>(a, b), |shortest2, (p, q)| R::smaller(shortest2, length2(p, q)));
    offset.length2().minus(&den.squared().times(&shortest2).times(&R::of(rho2)))
}

/// R^2 - rho2 l^2 of a triangle, times a positive number: m^2 n^2 - 4 rho2 |normal|^2, as R = l m n / (2 |normal|).
#[inline]
pub(super) fn radius_edge_of_triangle<R: Ring>([a, b, c]: [Point3; 3], rho2: f64) -> R {
    let (u, v, w) = (Vector3::<R>::between(a, b), Vector3::between(a, c), Vector3::between(b, c));
    let normal2 = u.cross(&v).length2();
    let (middle, longest) = R::two_largest([u.length2(), v.length2(), w.length2()]);
    middle.times(&longest).minus(&normal2.doubled().doubled().times(&R::of(rho2)))
}

/// orient3d(a, b, c, o), times a positive number, o the orthocenter of the positively oriented t.
#[inline]
pub(super) fn orthocenter_side<R: Ring>(t: WeightedCorners, [a, b, c]: [Point3; 3]) -> R {
    let Center3 { offset, den } = orthocenter::<R>(t);
    let normal = Vector3::<R>::between(a, b).cross(&Vector3::between(a, c));
    normal.dot(&Vector3::between(a, t[0].at)).times(&den).plus(&normal.dot(&offset))
}

/// (t1 - t0) x (t2 - t0) . (b - a) x (c - a).
#[inline]
pub(super) fn normal_side<R: Ring>(t: [Point3; 3], plane: [Point3; 3]) -> R {
    let normal = |[a, b, c]: [Point3; 3]| Vector3::<R>::between(a, b).cross(&Vector3::between(a, c));
    normal(t).dot(&normal(plane))
}

/// t (b - a), about a.
#[inline]
pub(super) fn at_fraction<R: Ring>(a: Point3, b: Point3, t: f64) -> Vector3<R> {
    Vector3::<R>::between(a, b).scaled(&R::of(t))
}

/// |p - c|^2 - r^2.
#[inline]
pub(super) fn outside_sphere<R: Ring>(c: Point3, r: f64, p: Point3) -> R {
    length2::<R>(c, p).minus(&R::of(r).squared())
}

/// (b - a).(p - c).
#[inline]
pub(super) fn along<R: Ring>(a: Point3, b: Point3, c: Point3, p: Point3) -> R {
    Vector3::<R>::between(a, b).dot(&Vector3::between(c, p))
}

/// The quarter of the discriminant of |a + s d - c|^2 = r^2 in s, d = b - a: (d.f)^2 - |d|^2 (|f|^2 - r^2), f = a - c.
#[inline]
pub(super) fn discriminant<R: Ring>(c: Point3, r: f64, a: Point3, b: Point3) -> R {
    along::<R>(a, b, c, a).squared().minus(&length2::<R>(a, b).times(&outside_sphere(c, r, a)))
}

/// The point at the larger root s of that equation (the smaller one if `sign` is -1), about a: d (-d.f + sign sqrt(discriminant)) / |d|^2.
#[inline]
pub(super) fn on_sphere<R: Ring>(c: Point3, r: f64, a: Point3, b: Point3, sign: f64) -> Rooted3<R> {
    let d = Vector3::<R>::between(a, b);
    let to_center = d.dot(&Vector3::between(a, c));
    Rooted3 { p: d.scaled(&to_center), q: d.scaled(&R::of(sign)), radicand: discriminant(c, r, a, b), den: d.length2() }
}

/// |ab|^2 s^2 - r^2.
#[inline]
pub(super) fn scaled_length_less<R: Ring>(a: Point3, b: Point3, s: f64, r: f64) -> R {
    length2::<R>(a, b).times(&R::of(s).squared()).minus(&R::of(r).squared())
}
