//! The fast kernel: three stages, each of which may decline, the last never.
//!
//! Decisions: an f64 with an error bound (`filter`), double-double (`double_double`), exact dyadic integers (`dyadic`), all
//! on the same polynomials (`poly`). `robust` decides what the filters of orient2d leave open.
//! Constructions start with double-double: an f64 error bound never certifies a rounding, except far from the origin.

use super::construct;
use super::double_double::DoubleDouble;
use super::dyadic::Dyadic;
use super::filter;
use super::kernel::{Corners, Kernel, OutOfRange};
use super::poly::{self, Center, Ring, Rooted};
use super::stages::{rarely, rounded_fraction, sign_of, sign_without_filter};
use super::{round, scale};
use crate::model::{Point2, Sign};
use std::cmp::Ordering;

/// Filters first, exact integers last; the same answers as every other kernel.
#[derive(Clone, Copy, Debug, Default)]
pub struct FastKernel;

/// A point of the form base + offset/den, by the first stage that can tell.
macro_rules! rounded_center {
    ($base:expr, $center:ident($($argument:expr),*)) => {
        center_in_double_double($base, &poly::$center::<DoubleDouble>($($argument),*))
            .unwrap_or_else(|| rarely(|| center_exactly($base, &poly::$center::<Dyadic>($($argument),*))))
    };
}

/// A point of which the polynomial is twice, by the first stage that can tell.
///
/// Halving commutes with rounding, save for subnormal results, which become 0 either way.
macro_rules! rounded_half {
    ($twice:ident($($argument:expr),*)) => {{
        let v = poly::$twice::<DoubleDouble>($($argument),*);
        let twice = both(v.x.rounded(), v.y.rounded()).unwrap_or_else(|| {
            rarely(|| {
                let (v, one) = (poly::$twice::<Dyadic>($($argument),*), Dyadic::integer(1));
                Point2::new(round::ratio(&v.x, &one), round::ratio(&v.y, &one))
            })
        });
        Point2::new(0.5 * twice.x, 0.5 * twice.y)
    }};
}

/// A point of the form base + (p + q sqrt(radicand))/den, by the first stage that can tell.
macro_rules! rounded_root {
    ($base:expr, $rooted:ident($($argument:expr),*)) => {
        root_in_double_double($base, &poly::$rooted::<DoubleDouble>($($argument),*))
            .unwrap_or_else(|| rarely(|| root_exactly($base, &poly::$rooted::<Dyadic>($($argument),*))))
    };
}

#[inline]
fn both(x: Option<f64>, y: Option<f64>) -> Option<Point2> {
    Some(Point2::new(x?, y?))
}

#[inline]
fn center_in_double_double(base: Point2, c: &Center<DoubleDouble>) -> Option<Point2> {
    let rounded = |base: f64, n: DoubleDouble| n.over(&c.den).plus(&DoubleDouble::of(base)).rounded();
    both(rounded(base.x, c.offset.x), rounded(base.y, c.offset.y))
}

fn center_exactly(base: Point2, c: &Center<Dyadic>) -> Point2 {
    let rounded = |base: f64, n: &Dyadic| round::ratio(&(&(&Dyadic::of(base) * &c.den) + n), &c.den);
    Point2::new(rounded(base.x, &c.offset.x), rounded(base.y, &c.offset.y))
}

#[inline]
fn root_in_double_double(base: Point2, r: &Rooted<DoubleDouble>) -> Option<Point2> {
    let s = r.radicand.sqrt();
    let offset = r.q.scaled(&s).plus(&r.p);
    center_in_double_double(base, &Center { offset, den: r.den })
}

fn root_exactly(base: Point2, r: &Rooted<Dyadic>) -> Point2 {
    let rounded = |base: f64, p: &Dyadic, q: &Dyadic| {
        let p = &(&Dyadic::of(base) * &r.den) + p;
        round::root(&p, q, &r.radicand, &r.den)
    };
    Point2::new(rounded(base.x, &r.p.x, &r.q.x), rounded(base.y, &r.p.y, &r.q.y))
}

/// The range rule on both coordinates.
#[inline]
fn in_range(p: Point2) -> Result<Point2, OutOfRange> {
    Ok(Point2::new(round::coordinate(p.x)?, round::coordinate(p.y)?))
}

/// The range rule where the result lies between points in range.
#[inline]
fn flushed(p: Point2) -> Point2 {
    Point2::new(round::flushed(p.x), round::flushed(p.y))
}

/// The order of a difference against 0.
#[inline]
pub(super) fn order(difference: Sign) -> Ordering {
    match difference {
        Sign::Negative => Ordering::Less,
        Sign::Zero => Ordering::Equal,
        Sign::Positive => Ordering::Greater,
    }
}

impl Kernel for FastKernel {
    #[inline]
    fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
        filter::orient2d(a, b, c).unwrap_or_else(|| orient2d_adaptively(a, b, c))
    }

    #[inline]
    fn in_circle(t: Corners, q: Point2) -> Sign {
        filter::in_circle(t, q).unwrap_or_else(|| in_circle_without_filter(t, q))
    }

    #[inline]
    fn in_diametral_circle(u: Point2, v: Point2, w: Point2) -> Sign {
        sign_of!(poly::in_diametral_circle(u, v, w))
    }

    #[inline]
    fn walk_side(t: Corners, q: Point2, w: Point2) -> Sign {
        filter::walk_side(t, q, w).unwrap_or_else(|| sign_without_filter!(poly::walk_side(t, q, w)))
    }

    fn edge_meets_diametral_disk(u: Point2, v: Point2, a: Point2, b: Point2) -> bool {
        let end_inside =
            Self::in_diametral_circle(u, v, a).is_positive() || Self::in_diametral_circle(u, v, b).is_positive();
        end_inside
            || (sign_of!(poly::foot_after_start(u, v, a, b)).is_positive()
                && sign_of!(poly::foot_before_end(u, v, a, b)).is_positive()
                && sign_of!(poly::foot_depth(u, v, a, b)).is_positive())
    }

    #[inline]
    fn compare_lengths(a: Point2, b: Point2, c: Point2, d: Point2) -> Ordering {
        order(sign_of!(poly::lengths(a, b, c, d)))
    }

    fn compare_ratio(t1: Corners, t2: Corners) -> Ordering {
        order(sign_of!(poly::ratios(t1, t2)))
    }

    fn compare_area_ratio(t1: Corners, bound1: f64, t2: Corners, bound2: f64) -> Ordering {
        if bound1 == bound2
            && let (Some(a), Some(b)) = (construct::exact_cross(t1), construct::exact_cross(t2))
            && let Some(order) = a.partial_cmp(&b)
        {
            return order;
        }
        order(sign_of!(poly::area_ratios(t1, bound1, t2, bound2)))
    }

    fn compare_radius_ratio(t1: Corners, h1: f64, t2: Corners, h2: f64) -> Ordering {
        order(sign_of!(poly::radius_ratios(t1, h1, t2, h2)))
    }

    #[inline]
    fn is_skinny(t: Corners, rho2: f64) -> bool {
        filter::is_skinny(t, rho2).unwrap_or_else(|| !sign_without_filter!(poly::skinny(t, rho2)).is_negative())
    }

    #[inline]
    fn exceeds_area(t: Corners, bound: f64) -> bool {
        sign_of!(poly::area_excess(t, bound)).is_positive()
    }

    fn exceeds_radius(t: Corners, h: f64) -> bool {
        sign_of!(poly::radius_excess(t, h)).is_positive()
    }

    fn in_selection_disk(t: Corners, d2: f64, a: Point2) -> bool {
        !sign_of!(poly::in_selection_disk(t, d2, a)).is_negative()
    }

    fn in_selection_interval(u: Point2, v: Point2, delta: f64, p: Point2) -> bool {
        !sign_of!(poly::in_selection_interval(u, v, delta, p)).is_negative()
    }

    fn compare_cos2(apex: Point2, p: Point2, q: Point2, bound: f64) -> Ordering {
        if sign_of!(poly::dot(apex, p, q)).is_positive() {
            order(sign_of!(poly::cos2(apex, p, q, bound)))
        } else {
            Ordering::Less
        }
    }

    fn shell_exponent(u: Point2, v: Point2) -> i32 {
        assert!(u != v, "a segment has two ends");
        // The k with 9 4^k <= 4 |uv|^2 < 9 4^(k+1). Against the rounded square both comparisons are right unless equal,
        // since 9 4^k is an f64. With 4 |uv|^2 <= 2^e: 4^k < 2^(e-3), so that the first k tried is not too small.
        let four_l2 = 4.0 * Self::length2(u, v);
        let mut k = (scale::exponent_of(four_l2) - 3).div_euclid(2);
        loop {
            let threshold = 9.0 * scale::by_power_of_two(1.0, 2 * k);
            let reached = match four_l2.total_cmp(&threshold) {
                Ordering::Equal => !sign_of!(poly::length2_less(u, v, threshold / 4.0)).is_negative(),
                other => other.is_gt(),
            };
            if reached {
                return k;
            }
            k -= 1;
        }
    }

    #[inline]
    fn length2(a: Point2, b: Point2) -> f64 {
        construct::length2(a, b)
            .or_else(|| poly::length2::<DoubleDouble>(a, b).rounded())
            .unwrap_or_else(|| rarely(|| round::ratio(&poly::length2::<Dyadic>(a, b), &Dyadic::integer(1))))
    }

    fn ratio2(t: Corners) -> f64 {
        rounded_fraction!(poly::ratio2(t))
    }

    fn area_ratio(t: Corners, bound: f64) -> f64 {
        construct::area_ratio(t, bound).unwrap_or_else(|| rounded_fraction!(poly::area_ratio(t, bound)))
    }

    fn radius_ratio2(t: Corners, h: f64) -> f64 {
        rounded_fraction!(poly::radius_ratio2(t, h))
    }

    #[inline]
    fn midpoint(a: Point2, b: Point2) -> Point2 {
        // The sum is rounded once and halving is exact.
        flushed(Point2::new(0.5 * (a.x + b.x), 0.5 * (a.y + b.y)))
    }

    fn in_interval(a: Point2, b: Point2, delta: f64, x: f64) -> Point2 {
        flushed(rounded_half!(in_interval_twice(a, b, delta, x)))
    }

    fn at_distance(a: Point2, b: Point2, k: i32) -> Point2 {
        let step = scale::by_power_of_two(1.0, k);
        flushed(rounded_root!(a, at_distance(a, b, step)))
    }

    fn circumcenter(t: Corners) -> Result<Point2, OutOfRange> {
        in_range(construct::circumcenter(t).unwrap_or_else(|| rounded_center!(t[0], circumcenter(t))))
    }

    fn in_disk(t: Corners, d2: f64, x: f64, y: f64) -> Result<Point2, OutOfRange> {
        in_range(rounded_center!(t[0], in_disk(t, d2, x, y)))
    }

    fn offcenter(t: Corners, kappa: f64) -> Result<Point2, OutOfRange> {
        if sign_of!(poly::center_beyond(t, kappa)).is_positive() {
            in_range(nearer_offcenter(t, kappa))
        } else {
            Self::circumcenter(t)
        }
    }

    fn clamped_offcenter(t: Corners, kappa: f64, d2: f64) -> Result<Point2, OutOfRange> {
        if !sign_of!(poly::center_beyond(t, kappa)).is_positive() {
            Self::circumcenter(t)
        } else if sign_of!(poly::offcenter_outside_disk(t, kappa, d2)).is_positive() {
            in_range(rounded_root!(t[0], clamped(t, d2)))
        } else {
            in_range(nearer_offcenter(t, kappa))
        }
    }
}

/// m + kappa rot90(q-p), rounded, before the range rule.
#[inline]
fn nearer_offcenter([p, q, _]: Corners, kappa: f64) -> Point2 {
    construct::offcenter(p, q, kappa).unwrap_or_else(|| rounded_half!(offcenter_twice(p, q, kappa)))
}

#[cold]
#[inline(never)]
fn orient2d_adaptively(a: Point2, b: Point2, c: Point2) -> Sign {
    let coord = |p: Point2| robust::Coord { x: p.x, y: p.y };
    let det = robust::orient2d(coord(a), coord(b), coord(c));
    if det > 0.0 {
        Sign::Positive
    } else if det < 0.0 {
        Sign::Negative
    } else {
        Sign::Zero
    }
}

#[inline(never)]
fn in_circle_without_filter(t: Corners, q: Point2) -> Sign {
    filter::in_circle_on_grid(t, q).unwrap_or_else(|| sign_without_filter!(poly::in_circle(t, q)))
}
