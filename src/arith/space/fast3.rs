//! The fast kernel in space: the stages of `arith::fast`, and for the hottest predicates integers of fixed width before double-double.

use super::filter3;
use super::fixed3;
use super::kernel3::{ConstructionError, Corners3, Kernel3, WeightedCorners};
use super::poly3::{self, Center3, Rooted3};
use crate::arith::double_double::DoubleDouble;
use crate::arith::fast::{FastKernel, order};
use crate::arith::poly::Ring;
use crate::arith::stages::{by_fixed_width, rarely, sign_of, sign_without_filter};
use crate::arith::{Dyadic, round};
use crate::model::{Point3, Sign, WeightedPoint};
use std::cmp::Ordering;

/// A point of the form base + offset/den, by the first stage that can tell, after the range rule.
macro_rules! rounded_center {
    ($base:expr, $center:ident($($argument:expr),*)) => {
        match center_in_double_double($base, &poly3::$center::<DoubleDouble>($($argument),*)) {
            Some(p) => in_range(p),
            None => rarely(|| center_exactly($base, &poly3::$center::<Dyadic>($($argument),*))),
        }
    };
}

#[inline]
fn center_in_double_double(base: Point3, c: &Center3<DoubleDouble>) -> Option<Point3> {
    let rounded = |base: f64, n: DoubleDouble| n.over(&c.den).plus(&DoubleDouble::of(base)).rounded();
    Some(Point3::new(rounded(base.x, c.offset.x)?, rounded(base.y, c.offset.y)?, rounded(base.z, c.offset.z)?))
}

fn center_exactly(base: Point3, c: &Center3<Dyadic>) -> Result<Point3, ConstructionError> {
    if c.den.sign() == Sign::Zero {
        return Err(ConstructionError::Degenerate);
    }
    let rounded = |base: f64, n: &Dyadic| round::ratio(&(&(&Dyadic::of(base) * &c.den) + n), &c.den);
    in_range(Point3::new(rounded(base.x, &c.offset.x), rounded(base.y, &c.offset.y), rounded(base.z, &c.offset.z)))
}

fn root_in_double_double(base: Point3, r: &Rooted3<DoubleDouble>) -> Option<Point3> {
    let offset = r.q.scaled(&r.radicand.sqrt()).plus(&r.p);
    center_in_double_double(base, &Center3 { offset, den: r.den })
}

fn root_exactly(base: Point3, r: &Rooted3<Dyadic>) -> Point3 {
    let rounded = |base: f64, p: &Dyadic, q: &Dyadic| {
        let p = &(&Dyadic::of(base) * &r.den) + p;
        round::root(&p, q, &r.radicand, &r.den)
    };
    Point3::new(rounded(base.x, &r.p.x, &r.q.x), rounded(base.y, &r.p.y, &r.q.y), rounded(base.z, &r.p.z, &r.q.z))
}

/// The range rule on all coordinates.
#[inline]
fn in_range(p: Point3) -> Result<Point3, ConstructionError> {
    Ok(Point3::new(round::coordinate(p.x)?, round::coordinate(p.y)?, round::coordinate(p.z)?))
}

/// The range rule where the result lies between points in range.
#[inline]
fn flushed(p: Point3) -> Point3 {
    Point3::new(round::flushed(p.x), round::flushed(p.y), round::flushed(p.z))
}

/// The point, coordinate by coordinate: what goes by reference to the slow stages is a copy made on the way to them, and the filters find their
/// arguments in registers. (Otherwise the compiler keeps these in memory, and the filters wait for stores to be forwarded: 15 ns.)
#[inline(always)]
fn copied(p: Point3) -> Point3 {
    Point3::new(p.x, p.y, p.z)
}

#[inline(always)]
fn copied_with_weight(p: WeightedPoint) -> WeightedPoint {
    WeightedPoint { at: copied(p.at), weight: p.weight }
}

impl Kernel3 for FastKernel {
    #[inline(always)]
    fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
        match filter3::orient3d(a, b, c, d) {
            Some(sign) => sign,
            None => {
                let [a, b, c, d] = [a, b, c, d].map(copied);
                orient3d_without_filter(a, b, c, d)
            }
        }
    }

    #[inline(always)]
    fn in_sphere(t: Corners3, q: Point3) -> Sign {
        match filter3::in_sphere(t, q) {
            Some(sign) => sign,
            None => in_sphere_without_filter(t.map(copied), copied(q)),
        }
    }

    #[inline(always)]
    fn power_side(t: WeightedCorners, q: WeightedPoint) -> Sign {
        let all = t.iter().fold(q.weight.to_bits(), |all, p| all | p.weight.to_bits());
        if all == 0 {
            return Self::in_sphere(t.map(|p| p.at), q.at);
        }
        match filter3::power_side(t, q) {
            Some(sign) => sign,
            None => power_side_without_filter(t.map(copied_with_weight), copied_with_weight(q)),
        }
    }

    #[inline(always)]
    fn power_side_estimate(t: WeightedCorners, q: WeightedPoint, exact_below: f64) -> (f64, f64) {
        filter3::power_side_estimate(t, q, exact_below)
    }

    #[inline(always)]
    fn orient3d_estimates(t: Corners3, q: Point3) -> ([f64; 4], f64) {
        filter3::orient3d_estimates(t, q)
    }

    fn power_side_of_triangle(t: [WeightedPoint; 3], q: WeightedPoint) -> Sign {
        sign_of!(poly3::power_side_of_triangle(t, q))
    }

    fn power_side_of_edge(a: WeightedPoint, b: WeightedPoint, q: WeightedPoint) -> Sign {
        sign_of!(poly3::power_side_of_edge(a, b, q))
    }

    #[inline]
    fn in_diametral_ball(u: Point3, v: Point3, w: Point3) -> Sign {
        sign_of!(poly3::in_diametral_ball(u, v, w))
    }

    fn in_equatorial_ball(a: Point3, b: Point3, c: Point3, w: Point3) -> Sign {
        Self::power_side_of_triangle(poly3::unweighted([a, b, c]), WeightedPoint::unweighted(w))
    }

    #[inline]
    fn compare_lengths3(a: Point3, b: Point3, c: Point3, d: Point3) -> Ordering {
        order(sign_of!(poly3::lengths(a, b, c, d)))
    }

    fn compare_power_distances(x: Point3, p: WeightedPoint, q: WeightedPoint) -> Ordering {
        order(sign_of!(poly3::power_distances(x, p, q)))
    }

    fn compare_orthoradius2(t: WeightedCorners, bound: f64) -> Ordering {
        order(sign_of!(poly3::orthoradius2_excess(t, bound)))
    }

    fn compare_orthoradii(t1: WeightedCorners, t2: WeightedCorners) -> Ordering {
        order(sign_of!(poly3::orthoradii(t1, t2)))
    }

    fn compare_radius_edge(t: Corners3, rho2: f64) -> Ordering {
        order(sign_of!(poly3::radius_edge(t, rho2)))
    }

    fn compare_radius_edge_of_triangle(t: [Point3; 3], rho2: f64) -> Ordering {
        order(sign_of!(poly3::radius_edge_of_triangle(t, rho2)))
    }

    fn orthocenter_side(t: WeightedCorners, plane: [Point3; 3]) -> Sign {
        sign_of!(poly3::orthocenter_side(t, plane))
    }

    fn normal_side(t: [Point3; 3], plane: [Point3; 3]) -> Sign {
        sign_of!(poly3::normal_side(t, plane))
    }

    #[inline]
    fn midpoint3(a: Point3, b: Point3) -> Point3 {
        // The sum is rounded once and halving is exact.
        flushed(Point3::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)))
    }

    fn at_fraction3(a: Point3, b: Point3, t: f64) -> Point3 {
        // Between a and b: never out of range nor degenerate.
        let one = || DoubleDouble::of(1.0);
        let offset = poly3::at_fraction::<DoubleDouble>(a, b, t);
        flushed(center_in_double_double(a, &Center3 { offset, den: one() }).unwrap_or_else(|| {
            rarely(|| {
                let offset = poly3::at_fraction::<Dyadic>(a, b, t);
                let rounded = |a: f64, n: &Dyadic| round::ratio(&(&Dyadic::of(a) + n), &Dyadic::integer(1));
                Point3::new(rounded(a.x, &offset.x), rounded(a.y, &offset.y), rounded(a.z, &offset.z))
            })
        }))
    }

    fn orthocenter(t: WeightedCorners) -> Result<Point3, ConstructionError> {
        rounded_center!(t[0].at, orthocenter(t))
    }

    fn orthocenter_of_triangle(t: [WeightedPoint; 3]) -> Result<Point3, ConstructionError> {
        rounded_center!(t[0].at, orthocenter_of_triangle(t))
    }

    fn dual_line_meets_plane(t: [WeightedPoint; 3], u: Point3, m: Point3) -> Result<Point3, ConstructionError> {
        rounded_center!(t[0].at, dual_line_meets_plane(t, u, m))
    }

    fn sphere_meets_segment(c: Point3, r: f64, a: Point3, b: Point3) -> [Option<Point3>; 2] {
        let roots = roots_in_segment(c, r, a, b);
        let at = |sign: f64| {
            flushed(
                root_in_double_double(a, &poly3::on_sphere::<DoubleDouble>(c, r, a, b, sign))
                    .unwrap_or_else(|| rarely(|| root_exactly(a, &poly3::on_sphere::<Dyadic>(c, r, a, b, sign)))),
            )
        };
        match roots {
            [true, true] => [Some(at(-1.0)), Some(at(1.0))],
            [true, false] => [Some(at(-1.0)), None],
            [false, true] => [Some(at(1.0)), None],
            [false, false] => [None, None],
        }
    }

    fn distance(a: Point3, b: Point3) -> f64 {
        poly3::length2::<DoubleDouble>(a, b)
            .sqrt()
            .rounded()
            .unwrap_or_else(|| rarely(|| root(&poly3::length2::<Dyadic>(a, b), &Dyadic::integer(1))))
    }

    fn circumradius(t: Corners3) -> Result<f64, ConstructionError> {
        let t = poly3::unweighted(t);
        let Center3 { offset, den } = poly3::orthocenter::<DoubleDouble>(t);
        let radius = offset.length2().sqrt().over(&den).rounded();
        let radius = match radius {
            Some(radius) => radius,
            None => rarely(|| {
                let Center3 { offset, den } = poly3::orthocenter::<Dyadic>(t);
                match den.sign() {
                    Sign::Zero => Err(ConstructionError::Degenerate),
                    _ => Ok(root(&offset.length2(), &den)),
                }
            })?,
        };
        // The denominator has the sign of the orientation.
        if radius.abs() <= round::LARGEST { Ok(radius.abs()) } else { Err(ConstructionError::OutOfRange) }
    }

    fn short_radius_below(a: Point3, b: Point3, s: f64) -> f64 {
        let mut r = short::next(short::truncated(Self::distance(a, b) * s));
        while sign_of!(poly3::scaled_length_less(a, b, s, r)).is_negative() {
            r = short::previous(r);
        }
        r
    }

    fn short_radius_above(a: Point3, b: Point3, s: f64) -> f64 {
        let mut r = short::truncated(Self::distance(a, b) * s);
        while sign_of!(poly3::scaled_length_less(a, b, s, r)).is_positive() {
            r = short::next(r);
        }
        r
    }
}

/// sqrt(radicand)/den rounded to nearest.
fn root(radicand: &Dyadic, den: &Dyadic) -> f64 {
    round::root(&Dyadic::integer(0), &Dyadic::integer(1), radicand, den)
}

/// Numbers of 26 significant bits among the positive normal f64s: the bit patterns whose last 27 bits are 0.
mod short {
    const STEP: u64 = 1 << 27;

    /// The greatest that is not above x.
    pub fn truncated(x: f64) -> f64 {
        f64::from_bits(x.to_bits() & !(STEP - 1))
    }
    pub fn next(x: f64) -> f64 {
        f64::from_bits(x.to_bits() + STEP)
    }
    pub fn previous(x: f64) -> f64 {
        f64::from_bits(x.to_bits().saturating_sub(STEP))
    }
}

/// Which of the two roots s of |a + s d - c| = r, d = b - a, lie in [0, 1]; a double root is the smaller one alone.
///
/// With A = |d|^2, B = d.(a - c), K(p) = |p - c|^2 - r^2 they are (-B -+ sqrt(B^2 - A K(a)))/A. Squaring the inequalities leaves signs of
/// B, of A + B = d.(b - c), and of K at both ends.
fn roots_in_segment(c: Point3, r: f64, a: Point3, b: Point3) -> [bool; 2] {
    if a == b {
        return [false, false];
    }
    let discriminant = sign_of!(poly3::discriminant(c, r, a, b));
    if discriminant.is_negative() {
        return [false, false];
    }
    let (at_a, at_b) = (sign_of!(poly3::outside_sphere(c, r, a)), sign_of!(poly3::outside_sphere(c, r, b)));
    let forward = !sign_of!(poly3::along(a, b, c, a)).is_positive();
    let reaches = !sign_of!(poly3::along(a, b, c, b)).is_negative();
    let smaller = forward && !at_a.is_negative() && (reaches || !at_b.is_positive());
    let larger = reaches && !at_b.is_negative() && (forward || !at_a.is_positive());
    [smaller, larger && discriminant.is_positive()]
}

#[inline(never)]
fn orient3d_without_filter(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
    fixed3::orient3d(a, b, c, d)
        .map(by_fixed_width)
        .unwrap_or_else(|| sign_without_filter!(poly3::orient3d(a, b, c, d)))
}

#[inline(never)]
fn in_sphere_without_filter(t: Corners3, q: Point3) -> Sign {
    let (weighted, place) = (poly3::unweighted(t), WeightedPoint::unweighted(q));
    filter3::power_side_by_terms(weighted, place)
        .or_else(|| fixed3::in_sphere(t, q).map(by_fixed_width))
        .unwrap_or_else(|| sign_without_filter!(poly3::power_side(weighted, place)))
}

#[inline(never)]
fn power_side_without_filter(t: WeightedCorners, q: WeightedPoint) -> Sign {
    filter3::power_side_by_terms(t, q)
        .or_else(|| fixed3::power_side(t, q).map(by_fixed_width))
        .unwrap_or_else(|| sign_without_filter!(poly3::power_side(t, q)))
}
