//! The exact kernel: naive rationals on GMP, no filter, and formulas other than the fast kernel's wherever there are any.
//! (Signs and ratios that no scale changes are taken of integers over a common denominator, to save reductions.)
//!
//! Where `poly` works with differences to a corner and cleared denominators, this file takes absolute coordinates and each
//! definition as it is written: a circumcenter is the solution of two bisector equations by Cramer's rule, a point is in
//! a circle if it is nearer to that center, a centroid is a mean, an edge meets a disk if its nearest point does.
//! Source of the rounding: definition of round to nearest, ties to even, on a quotient of integers.

use super::kernel::{Corners, Kernel, OutOfRange};
use super::round::{FLUSH_BELOW, LARGEST};
use crate::model::{Point2, Sign};
use rug::ops::Pow;
use rug::{Complete, Integer, Rational};
use std::cmp::Ordering;

/// Rationals throughout: slow, obvious, and the same answers as every other kernel.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactKernel;

pub(super) fn rational(x: f64) -> Rational {
    // The kernel's arguments are finite by contract.
    Rational::from_f64(x).expect("finite by the kernel's contract")
}

/// A point with rational coordinates.
#[derive(Clone)]
struct Exact2 {
    x: Rational,
    y: Rational,
}

impl From<Point2> for Exact2 {
    fn from(p: Point2) -> Exact2 {
        Exact2 { x: rational(p.x), y: rational(p.y) }
    }
}

impl Exact2 {
    fn norm2(&self) -> Rational {
        self.x.clone().square() + self.y.clone().square()
    }
    fn dist2(&self, other: &Exact2) -> Rational {
        (&self.x - &other.x).complete().square() + (&self.y - &other.y).complete().square()
    }
    fn minus(&self, other: &Exact2) -> Exact2 {
        Exact2 { x: (&self.x - &other.x).complete(), y: (&self.y - &other.y).complete() }
    }
    /// self + s (direction).
    fn moved(&self, s: &Rational, direction: &Exact2) -> Exact2 {
        Exact2 { x: (s * &direction.x).complete() + &self.x, y: (s * &direction.y).complete() + &self.y }
    }
    fn dot(&self, other: &Exact2) -> Rational {
        (&self.x * &other.x).complete() + (&self.y * &other.y).complete()
    }
    /// Turned by 90 degrees counterclockwise.
    fn rot90(&self) -> Exact2 {
        Exact2 { x: (-&self.y).complete(), y: self.x.clone() }
    }
    fn midpoint(&self, other: &Exact2) -> Exact2 {
        Exact2 { x: (&self.x + &other.x).complete() / 2u32, y: (&self.y + &other.y).complete() / 2u32 }
    }
    fn rounded(&self) -> Result<Point2, OutOfRange> {
        Ok(Point2::new(coordinate(round(&self.x))?, coordinate(round(&self.y))?))
    }
}

/// The range rule of a constructed coordinate.
pub(super) fn coordinate(rounded: f64) -> Result<f64, OutOfRange> {
    if rounded.abs() > LARGEST {
        Err(OutOfRange)
    } else if rounded.abs() < FLUSH_BELOW {
        Ok(0.0)
    } else {
        Ok(rounded)
    }
}

fn exact([a, b, c]: Corners) -> [Exact2; 3] {
    [a.into(), b.into(), c.into()]
}

/// Twice the signed area: the determinant of the rows (1, x, y).
fn cross(a: &Exact2, b: &Exact2, c: &Exact2) -> Rational {
    let minor = |p: &Exact2, q: &Exact2| (&p.x * &q.y).complete() - (&q.x * &p.y).complete();
    minor(a, b) + minor(b, c) + minor(c, a)
}

/// The point of equal distance to three; `None` if they are collinear.
fn center([a, b, c]: &[Exact2; 3]) -> Option<Exact2> {
    // 2 (b - a).x = |b|^2 - |a|^2 and the same for c.
    let (n, nb, nc) = (a.norm2(), b.norm2(), c.norm2());
    let (e, f) = (b.minus(a), c.minus(a));
    let (g, h) = ((&nb - &n).complete() / 2u32, (&nc - &n).complete() / 2u32);
    let den = (&e.x * &f.y).complete() - (&e.y * &f.x).complete();
    if den.cmp0() == Ordering::Equal {
        return None;
    }
    let x = ((&g * &f.y).complete() - (&h * &e.y).complete()) / &den;
    let y = ((&e.x * &h).complete() - (&f.x * &g).complete()) / &den;
    Some(Exact2 { x, y })
}

/// r^2; `None` (infinite) if the corners are collinear.
fn radius2(t: &[Exact2; 3]) -> Option<Rational> {
    center(t).map(|o| o.dist2(&t[0]))
}

/// A point whose coordinates are integers over a common power of two: enough for signs and ratios that no scale changes,
/// and far cheaper than reducing every intermediate fraction.
struct Integer2 {
    x: Integer,
    y: Integer,
}

/// x = m 2^e, by the fields of a finite f64.
pub(super) fn dyadic_parts(x: f64) -> (i64, i64) {
    let field = ((x.to_bits() >> 52) & 0x7ff) as i64;
    let fraction = x.to_bits() & ((1 << 52) - 1);
    let m = if field == 0 { fraction } else { fraction | 1 << 52 } as i64;
    (if x < 0.0 { -m } else { m }, field.max(1) - 1075)
}

/// The points over the finest power of two among their coordinates.
fn over_common_power<const N: usize>(points: [Point2; N]) -> [Integer2; N] {
    let coordinates = points.iter().flat_map(|p| [p.x, p.y]);
    let nonzero = coordinates.map(dyadic_parts).filter(|&(m, _)| m != 0);
    let finest = nonzero.map(|(_, e)| e).min().unwrap_or(0);
    let integer = |x: f64| {
        let (m, e) = dyadic_parts(x);
        Integer::from(m) << e.saturating_sub(finest).max(0) as u32
    };
    points.map(|p| Integer2 { x: integer(p.x), y: integer(p.y) })
}

impl Integer2 {
    fn norm2(&self) -> Integer {
        self.x.clone().square() + self.y.clone().square()
    }
    fn dist2(&self, other: &Integer2) -> Integer {
        (&self.x - &other.x).complete().square() + (&self.y - &other.y).complete().square()
    }
    fn scaled(&self, w: &Integer) -> Integer2 {
        Integer2 { x: (&self.x * w).complete(), y: (&self.y * w).complete() }
    }
}

/// Twice the signed area: the determinant of the rows (1, x, y).
fn integer_cross(a: &Integer2, b: &Integer2, c: &Integer2) -> Integer {
    let minor = |p: &Integer2, q: &Integer2| (&p.x * &q.y).complete() - (&q.x * &p.y).complete();
    minor(a, b) + minor(b, c) + minor(c, a)
}

/// The point of equal distance to three as (x, w), the center being x/w; w is 0 if they are collinear.
fn integer_center([a, b, c]: &[Integer2; 3]) -> (Integer2, Integer) {
    // 2 (b - a).x = |b|^2 - |a|^2 and the same for c; Cramer's rule.
    let (n, nb, nc) = (a.norm2(), b.norm2(), c.norm2());
    let (g, h) = (nb - &n, nc - n);
    let (ex, ey) = ((&b.x - &a.x).complete(), (&b.y - &a.y).complete());
    let (fx, fy) = ((&c.x - &a.x).complete(), (&c.y - &a.y).complete());
    let x = (&g * &fy).complete() - (&h * &ey).complete();
    let y = (&ex * &h).complete() - (&fx * &g).complete();
    (Integer2 { x, y }, (ex * fy - ey * fx) << 1u32)
}

/// r^2/l^2; `None` (infinite) if the corners are collinear.
fn ratio2(t: Corners) -> Option<Rational> {
    let t = over_common_power(t);
    let (o, w) = integer_center(&t);
    if w.cmp0() == Ordering::Equal {
        return None;
    }
    let shortest = t[0].dist2(&t[1]).min(t[1].dist2(&t[2])).min(t[2].dist2(&t[0]));
    Some(Rational::from((t[0].scaled(&w).dist2(&o), shortest * w.square())))
}

/// r^2/h^2; `None` (infinite) if the corners are collinear.
fn radius_ratio2(t: Corners, h: f64) -> Option<Rational> {
    Some(radius2(&exact(t))? / rational(h).square())
}

fn area_ratio(t: Corners, bound: f64) -> Rational {
    let [a, b, c] = exact(t);
    cross(&a, &b, &c) / 2u32 / rational(bound)
}

/// Order of two values, `None` being infinite.
fn compare(a: Option<Rational>, b: Option<Rational>) -> Ordering {
    match (a, b) {
        (None, None) => Ordering::Equal,
        (None, Some(_)) => Ordering::Greater,
        (Some(_), None) => Ordering::Less,
        (Some(a), Some(b)) => a.cmp(&b),
    }
}

pub(super) fn sign(order: Ordering) -> Sign {
    match order {
        Ordering::Less => Sign::Negative,
        Ordering::Equal => Sign::Zero,
        Ordering::Greater => Sign::Positive,
    }
}

/// (1 - d)^2.
fn shrunk2(d: f64) -> Rational {
    let rest: Rational = 1 - rational(d);
    rest.square()
}

/// The rational rounded once to nearest, ties to even; infinite beyond the largest f64.
pub(super) fn round(q: &Rational) -> f64 {
    let (n, d) = (q.numer(), q.denom());
    if n.cmp0() == Ordering::Equal {
        return 0.0;
    }
    let magnitude = n.as_abs();
    // 2^e <= |q| < 2^(e+1).
    let mut e = i64::from(magnitude.significant_bits()) - i64::from(d.significant_bits());
    let (shifted_n, shifted_d) =
        if e >= 0 { (Integer::from(&*magnitude), shifted(d, e)) } else { (shifted(&magnitude, -e), d.clone()) };
    if shifted_n < shifted_d {
        e -= 1;
    }
    let value = if e > 1023 {
        f64::INFINITY
    } else if e < -1076 {
        0.0
    } else {
        round_in_binade(&magnitude, d, e)
    };
    if n.cmp0() == Ordering::Less { -value } else { value }
}

fn shifted(n: &Integer, by: i64) -> Integer {
    (n << by as u32).complete()
}

/// n/d rounded, where 2^e <= n/d < 2^(e+1) and e is an exponent of an f64 or just below.
fn round_in_binade(n: &Integer, d: &Integer, e: i64) -> f64 {
    let last_place = (e - 52).max(-1074);
    let (num, den) =
        if last_place >= 0 { (n.clone(), shifted(d, last_place)) } else { (shifted(n, -last_place), d.clone()) };
    let (mut m, rest) = num.div_rem(den.clone());
    match (rest << 1u32).cmp(&den) {
        Ordering::Greater => m += 1,
        Ordering::Equal if m.is_odd() => m += 1,
        _ => {}
    }
    // The quotient is below 2^53 before rounding, so at most 2^53 after.
    let m = m.to_u64().expect("at most 2^53");
    // As the exponent field counts from the subnormals up, a carry into it is right by itself.
    let field = (last_place + 1074) as u64;
    if field == 0 { f64::from_bits(m) } else { f64::from_bits((field << 52) + m) }
}

/// p + q sqrt(radicand) rounded once; the radicand is not negative.
pub(super) fn round_root(p: &Rational, q: &Rational, radicand: &Rational) -> f64 {
    // sqrt(n/d) = sqrt(n d)/d; rational iff n d is a square.
    let (n, d) = (radicand.numer(), radicand.denom());
    let product = (n * d).complete();
    let at = |root: Integer, bits: u32| round(&(Rational::from((root, shifted(d, i64::from(bits)))) * q + p));
    if product.is_perfect_square() {
        return at(product.sqrt(), 0);
    }
    if q.cmp0() == Ordering::Equal {
        return round(p);
    }
    // Irrational, so never a tie: some enclosure rounds to one f64.
    let mut bits = 64;
    loop {
        let root = shifted(&product, 2 * i64::from(bits)).sqrt();
        let (low, high) = (at(root.clone(), bits), at(root + 1, bits));
        if low == high {
            return low;
        }
        bits *= 2;
    }
}

/// p + s v for a vector v and an irrational (or not) s = factor sqrt(radicand), rounded.
fn round_along(p: &Exact2, factor: &Rational, v: &Exact2, radicand: &Rational) -> Result<Point2, OutOfRange> {
    let one = |p: &Rational, v: &Rational| coordinate(round_root(p, &(factor * v).complete(), radicand));
    Ok(Point2::new(one(&p.x, &v.x)?, one(&p.y, &v.y)?))
}

/// What the off-center is.
enum OffCenter {
    Circumcenter(Exact2),
    /// The point at kappa |pq| from the midpoint, and the circumcenter beyond it.
    Nearer {
        point: Exact2,
        middle: Exact2,
        center: Exact2,
    },
}

fn off_center([p, q, c]: &[Exact2; 3], kappa: f64) -> Result<OffCenter, OutOfRange> {
    let center = center(&[p.clone(), q.clone(), c.clone()]).ok_or(OutOfRange)?;
    let (middle, up) = (p.midpoint(q), q.minus(p).rot90());
    let kappa = rational(kappa);
    let reach2 = kappa.clone().square() * up.norm2();
    let same_side = center.minus(&middle).dot(&up).cmp0() == Ordering::Greater;
    if same_side && center.dist2(&middle) > reach2 {
        Ok(OffCenter::Nearer { point: middle.moved(&kappa, &up), middle, center })
    } else {
        Ok(OffCenter::Circumcenter(center))
    }
}

impl Kernel for ExactKernel {
    fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
        let [a, b, c] = over_common_power([a, b, c]);
        sign(integer_cross(&a, &b, &c).cmp0())
    }

    fn in_circle([a, b, c]: Corners, q: Point2) -> Sign {
        let [a, b, c, q] = over_common_power([a, b, c, q]);
        let t = [a, b, c];
        // Collinear corners have no circle (w = 0, both distances alike); the contract asks for a counterclockwise triangle.
        let (o, w) = integer_center(&t);
        sign(t[0].scaled(&w).dist2(&o).cmp(&q.scaled(&w).dist2(&o)))
    }

    fn in_diametral_circle(u: Point2, v: Point2, w: Point2) -> Sign {
        let [u, v, w] = over_common_power([u, v, w]);
        // Twice the center and twice w, against the diameter.
        let center = Integer2 { x: (&u.x + &v.x).complete(), y: (&u.y + &v.y).complete() };
        sign(u.dist2(&v).cmp(&center.dist2(&w.scaled(&Integer::from(2)))))
    }

    fn walk_side([a, b, c]: Corners, q: Point2, w: Point2) -> Sign {
        let [a, b, c, q, w] = over_common_power([a, b, c, q, w]);
        // Three times the centroid, and everything else three times as large.
        let centroid = Integer2 { x: a.x + b.x + c.x, y: a.y + b.y + c.y };
        let three = Integer::from(3);
        sign(integer_cross(&centroid, &q.scaled(&three), &w.scaled(&three)).cmp0())
    }

    fn edge_meets_diametral_disk(u: Point2, v: Point2, a: Point2, b: Point2) -> bool {
        let (u, v, a, b) = (Exact2::from(u), Exact2::from(v), Exact2::from(a), Exact2::from(b));
        let (center, radius2) = (u.midpoint(&v), u.dist2(&v) / 4u32);
        let d = b.minus(&a);
        let length2 = d.norm2();
        if length2.cmp0() == Ordering::Equal {
            return center.dist2(&a) < radius2;
        }
        let along = (center.minus(&a).dot(&d) / length2).clamp(&0, &1);
        center.dist2(&a.moved(&along, &d)) < radius2
    }

    fn compare_lengths(a: Point2, b: Point2, c: Point2, d: Point2) -> Ordering {
        Exact2::from(a).dist2(&b.into()).cmp(&Exact2::from(c).dist2(&d.into()))
    }

    fn compare_ratio(t1: Corners, t2: Corners) -> Ordering {
        compare(ratio2(t1), ratio2(t2))
    }

    fn compare_area_ratio(t1: Corners, bound1: f64, t2: Corners, bound2: f64) -> Ordering {
        area_ratio(t1, bound1).cmp(&area_ratio(t2, bound2))
    }

    fn compare_radius_ratio(t1: Corners, h1: f64, t2: Corners, h2: f64) -> Ordering {
        compare(radius_ratio2(t1, h1), radius_ratio2(t2, h2))
    }

    fn is_skinny(t: Corners, rho2: f64) -> bool {
        ratio2(t).is_none_or(|ratio| ratio >= rational(rho2))
    }

    fn exceeds_area(t: Corners, bound: f64) -> bool {
        area_ratio(t, bound) > 1
    }

    fn exceeds_radius(t: Corners, h: f64) -> bool {
        radius_ratio2(t, h).is_none_or(|ratio| ratio > 1)
    }

    fn in_selection_disk(t: Corners, d2: f64, a: Point2) -> bool {
        let t = exact(t);
        // Collinear corners have no disk; the contract asks for a counterclockwise triangle.
        center(&t).is_some_and(|o| o.dist2(&a.into()) <= shrunk2(d2) * o.dist2(&t[0]))
    }

    fn in_selection_interval(u: Point2, v: Point2, delta: f64, p: Point2) -> bool {
        let (u, v) = (Exact2::from(u), Exact2::from(v));
        u.midpoint(&v).dist2(&p.into()) * 4u32 <= shrunk2(delta) * u.dist2(&v)
    }

    fn compare_cos2(apex: Point2, p: Point2, q: Point2, bound: f64) -> Ordering {
        let (apex, p, q) = (Exact2::from(apex), Exact2::from(p), Exact2::from(q));
        let (u2, v2) = (apex.dist2(&p), apex.dist2(&q));
        // Law of cosines.
        let dot = ((&u2 + &v2).complete() - p.dist2(&q)) / 2u32;
        if dot.cmp0() == Ordering::Greater { (dot.square() / u2 / v2).cmp(&rational(bound)) } else { Ordering::Less }
    }

    fn shell_exponent(u: Point2, v: Point2) -> i32 {
        assert!(u != v, "a segment has two ends");
        // (|uv|/3)^2 < 4^k <= (2 |uv|/3)^2, an interval of exactly one power of four.
        let low = Exact2::from(u).dist2(&v.into()) / 9u32;
        let high = Rational::from(&low * 4u32);
        let mut k = 0;
        while Rational::from(4).pow(k) > high {
            k -= 1;
        }
        while Rational::from(4).pow(k) <= low {
            k += 1;
        }
        k
    }

    fn length2(a: Point2, b: Point2) -> f64 {
        round(&Exact2::from(a).dist2(&b.into()))
    }

    fn ratio2(t: Corners) -> f64 {
        ratio2(t).map_or(f64::INFINITY, |ratio| round(&ratio))
    }

    fn area_ratio(t: Corners, bound: f64) -> f64 {
        round(&area_ratio(t, bound))
    }

    fn radius_ratio2(t: Corners, h: f64) -> f64 {
        radius_ratio2(t, h).map_or(f64::INFINITY, |ratio| round(&ratio))
    }

    fn midpoint(a: Point2, b: Point2) -> Point2 {
        // A midpoint of points in range is in range.
        Exact2::from(a).midpoint(&b.into()).rounded().expect("between its ends")
    }

    fn in_interval(a: Point2, b: Point2, delta: f64, x: f64) -> Point2 {
        let (a, b) = (Exact2::from(a), Exact2::from(b));
        let s = rational(x) * (1 - rational(delta)) / 2u32;
        // A point between points in range is in range.
        a.midpoint(&b).moved(&s, &b.minus(&a)).rounded().expect("between its ends")
    }

    fn at_distance(a: Point2, b: Point2, k: i32) -> Point2 {
        let (a, b) = (Exact2::from(a), Exact2::from(b));
        let d = b.minus(&a);
        // The step is at most the length of ab, so the point lies between points in range.
        round_along(&a, &Rational::from(2).pow(k), &d, &d.norm2().recip()).expect("between its ends")
    }

    fn circumcenter(t: Corners) -> Result<Point2, OutOfRange> {
        center(&exact(t)).ok_or(OutOfRange)?.rounded()
    }

    fn in_disk(t: Corners, d2: f64, x: f64, y: f64) -> Result<Point2, OutOfRange> {
        let t = exact(t);
        let o = center(&t).ok_or(OutOfRange)?;
        let (shrink, to_corner) = (1 - rational(d2), t[0].minus(&o));
        let direction = Exact2 { x: Rational::new(), y: Rational::new() }
            .moved(&rational(x), &to_corner)
            .moved(&rational(y), &to_corner.rot90());
        o.moved(&shrink, &direction).rounded()
    }

    fn offcenter(t: Corners, kappa: f64) -> Result<Point2, OutOfRange> {
        match off_center(&exact(t), kappa)? {
            OffCenter::Circumcenter(o) => o.rounded(),
            OffCenter::Nearer { point, .. } => point.rounded(),
        }
    }

    fn clamped_offcenter(t: Corners, kappa: f64, d2: f64) -> Result<Point2, OutOfRange> {
        let t = exact(t);
        match off_center(&t, kappa)? {
            OffCenter::Circumcenter(o) => o.rounded(),
            OffCenter::Nearer { point, middle, center } => {
                let radius2 = center.dist2(&t[0]);
                if point.dist2(&center) <= shrunk2(d2) * &radius2 {
                    return point.rounded();
                }
                let inward = middle.minus(&center);
                round_along(&center, &(1 - rational(d2)), &inward, &(radius2 / inward.norm2()))
            }
        }
    }
}
