//! The exact kernel in space: naive rationals, no filter, and other formulas than the fast kernel's wherever there are any.
//!
//! Absolute coordinates, and each definition as it is written: an orthocenter is the solution of the linear system of its radical planes
//! (and of its own plane, or of any plane), a point is in conflict if its power to the center is smaller, an orientation is a determinant of
//! homogeneous coordinates, a sphere meets a line at half a chord from the foot of its center.

use super::kernel3::{ConstructionError, Corners3, Kernel3, WeightedCorners};
use crate::arith::exact::{ExactKernel, coordinate, dyadic_parts, rational, round, round_root, sign};
use crate::arith::round::LARGEST;
use crate::model::{Point3, Sign, WeightedPoint};
use rug::{Complete, Integer, Rational};
use std::cmp::Ordering;

/// A point with rational coordinates.
#[derive(Clone)]
struct Exact3([Rational; 3]);

impl From<Point3> for Exact3 {
    fn from(p: Point3) -> Exact3 {
        Exact3([rational(p.x), rational(p.y), rational(p.z)])
    }
}

/// u . v
fn dot([a, b, c]: &[Rational; 3], [d, e, f]: &[Rational; 3]) -> Rational {
    (a * d).complete() + (b * e).complete() + (c * f).complete()
}

/// u x v
fn cross([a, b, c]: &[Rational; 3], [d, e, f]: &[Rational; 3]) -> [Rational; 3] {
    let minor = |p: &Rational, q: &Rational, r: &Rational, s: &Rational| (p * s).complete() - (q * r).complete();
    [minor(b, c, e, f), minor(c, a, f, d), minor(a, b, d, e)]
}

impl Exact3 {
    fn norm2(&self) -> Rational {
        dot(&self.0, &self.0)
    }
    fn minus(&self, other: &Exact3) -> Exact3 {
        Exact3(std::array::from_fn(|k| (&self.0[k] - &other.0[k]).complete()))
    }
    fn dist2(&self, other: &Exact3) -> Rational {
        self.minus(other).norm2()
    }
    /// (1 - s) self + s other.
    fn between(&self, other: &Exact3, s: &Rational) -> Exact3 {
        let rest: Rational = 1 - s.clone();
        Exact3(std::array::from_fn(|k| (&rest * &self.0[k]).complete() + (s * &other.0[k]).complete()))
    }
    fn rounded(&self) -> Result<Point3, ConstructionError> {
        let [x, y, z] = &self.0;
        Ok(Point3::new(coordinate(round(x))?, coordinate(round(y))?, coordinate(round(z))?))
    }
}

/// A point with a rational place and weight.
struct Weighted {
    at: Exact3,
    weight: Rational,
}

impl From<WeightedPoint> for Weighted {
    fn from(p: WeightedPoint) -> Weighted {
        Weighted { at: p.at.into(), weight: rational(p.weight) }
    }
}

impl From<Point3> for Weighted {
    fn from(p: Point3) -> Weighted {
        Weighted { at: p.into(), weight: Rational::new() }
    }
}

impl Weighted {
    /// |x - p|^2 - w.
    fn power(&self, x: &Exact3) -> Rational {
        self.at.dist2(x) - &self.weight
    }
}

/// The plane normal . x = level.
struct Plane {
    normal: [Rational; 3],
    level: Rational,
}

impl Plane {
    /// The points of equal power to p and q: 2 (q - p).x = |q|^2 - w_q - |p|^2 + w_p.
    fn radical(p: &Weighted, q: &Weighted) -> Plane {
        let normal = q.at.minus(&p.at).0.map(|d| d * 2u32);
        let origin = Exact3::from(Point3::ZERO);
        Plane { normal, level: q.power(&origin) - p.power(&origin) }
    }
    /// The plane through u with the given normal.
    fn through(u: &Exact3, normal: [Rational; 3]) -> Plane {
        let level = dot(&normal, &u.0);
        Plane { normal, level }
    }
    /// The plane of three points; its normal is 0 if they are collinear.
    fn of(t: [&Exact3; 3]) -> Plane {
        Plane::through(t[0], cross(&t[1].minus(t[0]).0, &t[2].minus(t[0]).0))
    }
}

/// The point common to three planes; `None` if there is none or more than one.
fn meet([p, q, r]: [&Plane; 3]) -> Option<Exact3> {
    // Cramer's rule on columns.
    let column = |k: usize| [p.normal[k].clone(), q.normal[k].clone(), r.normal[k].clone()];
    let levels = [p.level.clone(), q.level.clone(), r.level.clone()];
    let determinant = |a: &[Rational; 3], b: &[Rational; 3], c: &[Rational; 3]| dot(a, &cross(b, c));
    let (x, y, z) = (column(0), column(1), column(2));
    let den = determinant(&x, &y, &z);
    if den.cmp0() == Ordering::Equal {
        return None;
    }
    Some(Exact3([
        determinant(&levels, &y, &z) / &den,
        determinant(&x, &levels, &z) / &den,
        determinant(&x, &y, &levels) / &den,
    ]))
}

/// The point of equal power to the corners of a tetrahedron; `None` if they are coplanar.
fn orthocenter([a, b, c, d]: &[Weighted; 4]) -> Option<Exact3> {
    meet([&Plane::radical(a, b), &Plane::radical(a, c), &Plane::radical(a, d)])
}

/// The point of equal power to the corners of a triangle in its plane; `None` if they are collinear.
fn orthocenter_of_triangle([a, b, c]: &[Weighted; 3]) -> Option<Exact3> {
    meet([&Plane::radical(a, b), &Plane::radical(a, c), &Plane::of([&a.at, &b.at, &c.at])])
}

/// R^2; `None` if the corners are coplanar.
fn orthoradius2(t: WeightedCorners) -> Option<Rational> {
    let t = t.map(Weighted::from);
    orthocenter(&t).map(|o| t[0].power(&o))
}

/// The sign of w_q + R^2 - |q - o|^2 for a center o of equal power R^2 to p and others; 0 where there is no center (out of contract).
fn side(center: Option<Exact3>, p: &Weighted, q: &Weighted) -> Sign {
    center.map_or(Sign::Zero, |o| sign(p.power(&o).cmp(&q.power(&o))))
}

/// Order of a value that may be infinite (`None`) against a finite one.
fn compare(value: Option<Rational>, other: &Rational) -> Ordering {
    value.map_or(Ordering::Greater, |value| value.cmp(other))
}

/// The least squared distance of two of the points.
fn shortest2(points: &[Exact3]) -> Rational {
    let mut least = points[0].dist2(&points[1]);
    for (k, p) in points.iter().enumerate() {
        for q in &points[..k] {
            least = least.min(p.dist2(q));
        }
    }
    least
}

/// det(b - a, c - a, d - a) as the determinant of the rows (1, x, y, z), expanded by its first column.
fn orientation([a, b, c, d]: [&Exact3; 4]) -> Rational {
    let volume = |p: &Exact3, q: &Exact3, r: &Exact3| dot(&p.0, &cross(&q.0, &r.0));
    volume(b, c, d) - volume(a, c, d) + volume(a, b, d) - volume(a, b, c)
}

/// Points over a common power of two 2^e and weights over its square: enough for signs that no scale changes, and far cheaper than
/// reducing every intermediate fraction.
fn over_common_power<const N: usize>(points: [WeightedPoint; N]) -> [([Integer; 3], Integer); N] {
    let mut finest = i64::MAX;
    for p in points {
        for (x, per_step) in [(p.at.x, 1), (p.at.y, 1), (p.at.z, 1), (p.weight, 2)] {
            let (m, e) = dyadic_parts(x);
            if m != 0 {
                finest = finest.min(e.div_euclid(per_step));
            }
        }
    }
    let integer = |x: f64, unit: i64| {
        let (m, e) = dyadic_parts(x);
        // Not negative for m != 0, as `finest` is the least exponent.
        Integer::from(m) << if m == 0 { 0 } else { (e - unit) as u32 }
    };
    points.map(|p| ([p.at.x, p.at.y, p.at.z].map(|x| integer(x, finest)), integer(p.weight, finest.saturating_mul(2))))
}

/// p . (q x r)
fn volume([a, b, c]: &[Integer; 3], [d, e, f]: &[Integer; 3], [g, h, i]: &[Integer; 3]) -> Integer {
    let minor = |p: &Integer, q: &Integer, r: &Integer, s: &Integer| (p * s).complete() - (q * r).complete();
    minor(e, f, h, i) * a + minor(f, d, i, g) * b + minor(d, e, g, h) * c
}

impl Kernel3 for ExactKernel {
    fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
        let [a, b, c, d] = over_common_power([a, b, c, d].map(WeightedPoint::unweighted)).map(|(p, _)| p);
        sign((volume(&b, &c, &d) - volume(&a, &c, &d) + volume(&a, &b, &d) - volume(&a, &b, &c)).cmp0())
    }

    fn in_sphere(t: Corners3, q: Point3) -> Sign {
        Self::power_side(t.map(WeightedPoint::unweighted), WeightedPoint::unweighted(q))
    }

    fn power_side([a, b, c, d]: WeightedCorners, q: WeightedPoint) -> Sign {
        // The orthocenter x/w solves the linear system of its radical planes; then the powers of a and q to it are compared.
        let [a, b, c, d, q] = over_common_power([a, b, c, d, q]);
        let lift = |(p, w): &([Integer; 3], Integer)| p.iter().map(|x| x.clone().square()).sum::<Integer>() - w;
        let row = |p: &([Integer; 3], Integer)| {
            let normal: [Integer; 3] = std::array::from_fn(|k| (&p.0[k] - &a.0[k]).complete() << 1u32);
            (normal, lift(p) - lift(&a))
        };
        let [(u, hu), (v, hv), (w, hw)] = [row(&b), row(&c), row(&d)];
        let column = |k: usize| [u[k].clone(), v[k].clone(), w[k].clone()];
        let (x, y, z, levels) = (column(0), column(1), column(2), [hu, hv, hw]);
        let den = volume(&x, &y, &z);
        let center = [volume(&levels, &y, &z), volume(&x, &levels, &z), volume(&x, &y, &levels)];
        let power = |(p, weight): &([Integer; 3], Integer)| {
            let away = p.iter().zip(&center).map(|(p, c)| ((p * &den).complete() - c).square());
            away.sum::<Integer>() - den.clone().square() * weight
        };
        sign(power(&a).cmp(&power(&q)))
    }

    fn power_side_of_triangle(t: [WeightedPoint; 3], q: WeightedPoint) -> Sign {
        let t = t.map(Weighted::from);
        side(orthocenter_of_triangle(&t), &t[0], &q.into())
    }

    fn power_side_of_edge(a: WeightedPoint, b: WeightedPoint, q: WeightedPoint) -> Sign {
        let (a, b) = (Weighted::from(a), Weighted::from(b));
        let length2 = a.at.dist2(&b.at);
        let center = (length2.cmp0() != Ordering::Equal).then(|| {
            let s = (length2.clone() + &a.weight - &b.weight) / (length2 * 2u32);
            a.at.between(&b.at, &s)
        });
        side(center, &a, &q.into())
    }

    fn in_diametral_ball(u: Point3, v: Point3, w: Point3) -> Sign {
        let (u, v) = (Exact3::from(u), Exact3::from(v));
        let center = u.between(&v, &Rational::from((1, 2)));
        sign(center.dist2(&u).cmp(&center.dist2(&w.into())))
    }

    fn in_equatorial_ball(a: Point3, b: Point3, c: Point3, w: Point3) -> Sign {
        let t = [a, b, c].map(Weighted::from);
        side(orthocenter_of_triangle(&t), &t[0], &w.into())
    }

    fn compare_lengths3(a: Point3, b: Point3, c: Point3, d: Point3) -> Ordering {
        Exact3::from(a).dist2(&b.into()).cmp(&Exact3::from(c).dist2(&d.into()))
    }

    fn compare_power_distances(x: Point3, p: WeightedPoint, q: WeightedPoint) -> Ordering {
        let x = x.into();
        Weighted::from(p).power(&x).cmp(&Weighted::from(q).power(&x))
    }

    fn compare_orthoradius2(t: WeightedCorners, bound: f64) -> Ordering {
        compare(orthoradius2(t), &rational(bound))
    }

    fn compare_orthoradii(t1: WeightedCorners, t2: WeightedCorners) -> Ordering {
        orthoradius2(t2).map_or(Ordering::Less, |other| compare(orthoradius2(t1), &other))
    }

    fn compare_radius_edge(t: Corners3, rho2: f64) -> Ordering {
        let bound = rational(rho2) * shortest2(&t.map(Exact3::from));
        compare(orthoradius2(t.map(WeightedPoint::unweighted)), &bound)
    }

    fn compare_radius_edge_of_triangle(t: [Point3; 3], rho2: f64) -> Ordering {
        let bound = rational(rho2) * shortest2(&t.map(Exact3::from));
        let t = t.map(Weighted::from);
        compare(orthocenter_of_triangle(&t).map(|o| t[0].power(&o)), &bound)
    }

    fn orthocenter_side(t: WeightedCorners, plane: [Point3; 3]) -> Sign {
        let [a, b, c] = plane.map(Exact3::from);
        orthocenter(&t.map(Weighted::from)).map_or(Sign::Zero, |o| sign(orientation([&a, &b, &c, &o]).cmp0()))
    }

    fn normal_side(t: [Point3; 3], plane: [Point3; 3]) -> Sign {
        // (u x v).(w x z) = (u.w)(v.z) - (u.z)(v.w) (Binet, Cauchy).
        let edges = |[a, b, c]: [Exact3; 3]| [b.minus(&a).0, c.minus(&a).0];
        let ([u, v], [w, z]) = (edges(t.map(Exact3::from)), edges(plane.map(Exact3::from)));
        sign((dot(&u, &w) * dot(&v, &z)).cmp(&(dot(&u, &z) * dot(&v, &w))))
    }

    fn midpoint3(a: Point3, b: Point3) -> Point3 {
        Self::at_fraction3(a, b, 0.5)
    }

    fn at_fraction3(a: Point3, b: Point3, t: f64) -> Point3 {
        // A point between points in range is in range.
        Exact3::from(a).between(&b.into(), &rational(t)).rounded().expect("between its ends")
    }

    fn orthocenter(t: WeightedCorners) -> Result<Point3, ConstructionError> {
        orthocenter(&t.map(Weighted::from)).ok_or(ConstructionError::Degenerate)?.rounded()
    }

    fn orthocenter_of_triangle(t: [WeightedPoint; 3]) -> Result<Point3, ConstructionError> {
        orthocenter_of_triangle(&t.map(Weighted::from)).ok_or(ConstructionError::Degenerate)?.rounded()
    }

    fn dual_line_meets_plane(t: [WeightedPoint; 3], u: Point3, m: Point3) -> Result<Point3, ConstructionError> {
        let [a, b, c] = t.map(Weighted::from);
        let plane = Plane::through(&u.into(), Exact3::from(m).0);
        meet([&Plane::radical(&a, &b), &Plane::radical(&a, &c), &plane]).ok_or(ConstructionError::Degenerate)?.rounded()
    }

    fn sphere_meets_segment(c: Point3, r: f64, a: Point3, b: Point3) -> [Option<Point3>; 2] {
        if a == b {
            return [None, None];
        }
        let (c, a, b) = (Exact3::from(c), Exact3::from(a), Exact3::from(b));
        let d = b.minus(&a);
        let middle = dot(&c.minus(&a).0, &d.0) / d.norm2();
        let foot = a.between(&b, &middle);
        // The square of half the chord, in units of ab.
        let half2 = (rational(r).square() - foot.dist2(&c)) / d.norm2();
        if half2.cmp0() == Ordering::Less {
            return [None, None];
        }
        let mut found = [None, None];
        let mut next = found.iter_mut();
        let tangent = half2.cmp0() == Ordering::Equal;
        for sign in if tangent { &[1][..] } else { &[-1, 1] } {
            // 0 <= middle + sign half <= 1, each as: x + sign half is not negative.
            let not_negative = |x: &Rational, sign: i32| match sign {
                1 => x.cmp0() != Ordering::Less || x.clone().square() <= half2,
                _ => x.cmp0() != Ordering::Less && x.clone().square() >= half2,
            };
            let rest: Rational = 1 - middle.clone();
            if not_negative(&middle, *sign) && not_negative(&rest, -sign) {
                let one = |k: usize| round_root(&foot.0[k], &(&d.0[k] * Rational::from(*sign)), &half2);
                // A point between points in range is in range.
                let one = |k| coordinate(one(k)).expect("between its ends");
                // At most two roots.
                *next.next().expect("two places") = Some(Point3::new(one(0), one(1), one(2)));
            }
        }
        found
    }

    fn distance(a: Point3, b: Point3) -> f64 {
        round_root(&Rational::new(), &Rational::from(1), &Exact3::from(a).dist2(&b.into()))
    }

    fn circumradius(t: Corners3) -> Result<f64, ConstructionError> {
        let radius2 = orthoradius2(t.map(WeightedPoint::unweighted)).ok_or(ConstructionError::Degenerate)?;
        let radius = round_root(&Rational::new(), &Rational::from(1), &radius2);
        if radius <= LARGEST { Ok(radius) } else { Err(ConstructionError::OutOfRange) }
    }

    fn short_radius_below(a: Point3, b: Point3, s: f64) -> f64 {
        short_root(&(Exact3::from(a).dist2(&b.into()) * rational(s).square())).0
    }

    fn short_radius_above(a: Point3, b: Point3, s: f64) -> f64 {
        short_root(&(Exact3::from(a).dist2(&b.into()) * rational(s).square())).1
    }
}

/// The greatest number of 26 bits whose square is at most, and the least whose square is at least the given one.
fn short_root(square: &Rational) -> (f64, f64) {
    if square.cmp0() == Ordering::Equal {
        return (0.0, 0.0);
    }
    // m = floor(sqrt(square / 4^k)), k chosen so that m has 26 bits; the first k tried is not too large.
    let bits = |n: &Integer| i64::from(n.significant_bits());
    let mut k = (bits(square.numer()) - bits(square.denom())).div_euclid(2) - 27;
    loop {
        let by_power = |x: &Rational, e: i64| if e < 0 { x.clone() >> (-e) as u32 } else { x.clone() << e as u32 };
        let scaled = by_power(square, -2 * k);
        let m = Integer::from(scaled.floor_ref()).sqrt();
        if m.significant_bits() <= 26 {
            let exact = m.clone().square() == scaled;
            let value = |m: Integer| round(&by_power(&Rational::from(m), k));
            return (value(m.clone()), value(if exact { m } else { m + 1 }));
        }
        k += 1;
    }
}
