//! A negative control for tests: exact decisions, but constructions in plain f64 arithmetic.
//!
//! Its points are wrong in the last places, and differ with the formula and the compiler's mood. Its traces must differ from
//! those of the true kernels; a test that cannot tell them apart proves nothing.

use super::fast::FastKernel;
use super::kernel::{Corners, Kernel, OutOfRange};
use super::{round, scale};
use crate::model::{Point2, Sign};
use std::cmp::Ordering;

/// Not a kernel that keeps the law: f64 constructions for comparison in tests. Never offered to users.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlainKernel;

/// The range rule, so that the control fails by its roundings alone.
fn in_range(p: Point2) -> Result<Point2, OutOfRange> {
    Ok(Point2::new(round::coordinate(p.x)?, round::coordinate(p.y)?))
}

fn center([a, b, c]: Corners) -> Point2 {
    let (e, f) = (b - a, c - a);
    let (e2, f2) = (e.x * e.x + e.y * e.y, f.x * f.x + f.y * f.y);
    let den = 2.0 * (e.x * f.y - e.y * f.x);
    Point2::new(a.x + (e2 * f.y - f2 * e.y) / den, a.y + (f2 * e.x - e2 * f.x) / den)
}

impl Kernel for PlainKernel {
    fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
        FastKernel::orient2d(a, b, c)
    }
    fn in_circle(t: Corners, q: Point2) -> Sign {
        FastKernel::in_circle(t, q)
    }
    fn in_diametral_circle(u: Point2, v: Point2, w: Point2) -> Sign {
        FastKernel::in_diametral_circle(u, v, w)
    }
    fn walk_side(t: Corners, q: Point2, w: Point2) -> Sign {
        FastKernel::walk_side(t, q, w)
    }
    fn edge_meets_diametral_disk(u: Point2, v: Point2, a: Point2, b: Point2) -> bool {
        FastKernel::edge_meets_diametral_disk(u, v, a, b)
    }
    fn compare_lengths(a: Point2, b: Point2, c: Point2, d: Point2) -> Ordering {
        FastKernel::compare_lengths(a, b, c, d)
    }
    fn compare_ratio(t1: Corners, t2: Corners) -> Ordering {
        FastKernel::compare_ratio(t1, t2)
    }
    fn compare_area_ratio(t1: Corners, bound1: f64, t2: Corners, bound2: f64) -> Ordering {
        FastKernel::compare_area_ratio(t1, bound1, t2, bound2)
    }
    fn compare_radius_ratio(t1: Corners, h1: f64, t2: Corners, h2: f64) -> Ordering {
        FastKernel::compare_radius_ratio(t1, h1, t2, h2)
    }
    fn is_skinny(t: Corners, rho2: f64) -> bool {
        FastKernel::is_skinny(t, rho2)
    }
    fn exceeds_area(t: Corners, bound: f64) -> bool {
        FastKernel::exceeds_area(t, bound)
    }
    fn exceeds_radius(t: Corners, h: f64) -> bool {
        FastKernel::exceeds_radius(t, h)
    }
    fn in_selection_disk(t: Corners, d2: f64, a: Point2) -> bool {
        FastKernel::in_selection_disk(t, d2, a)
    }
    fn in_selection_interval(u: Point2, v: Point2, delta: f64, p: Point2) -> bool {
        FastKernel::in_selection_interval(u, v, delta, p)
    }
    fn compare_cos2(apex: Point2, p: Point2, q: Point2, bound: f64) -> Ordering {
        FastKernel::compare_cos2(apex, p, q, bound)
    }
    fn shell_exponent(u: Point2, v: Point2) -> i32 {
        FastKernel::shell_exponent(u, v)
    }
    fn length2(a: Point2, b: Point2) -> f64 {
        FastKernel::length2(a, b)
    }
    fn ratio2(t: Corners) -> f64 {
        FastKernel::ratio2(t)
    }
    fn area_ratio(t: Corners, bound: f64) -> f64 {
        FastKernel::area_ratio(t, bound)
    }
    fn radius_ratio2(t: Corners, h: f64) -> f64 {
        FastKernel::radius_ratio2(t, h)
    }

    fn midpoint(a: Point2, b: Point2) -> Point2 {
        // a + (b - a)/2 rounds twice; (a + b)/2 would be right.
        Point2::new(a.x + 0.5 * (b.x - a.x), a.y + 0.5 * (b.y - a.y))
    }

    fn in_interval(a: Point2, b: Point2, delta: f64, x: f64) -> Point2 {
        let s = 0.5 * (1.0 + x * (1.0 - delta));
        Point2::new(a.x + s * (b.x - a.x), a.y + s * (b.y - a.y))
    }

    fn at_distance(a: Point2, b: Point2, k: i32) -> Point2 {
        let d = b - a;
        let s = scale::by_power_of_two(1.0, k) / (d.x * d.x + d.y * d.y).sqrt();
        Point2::new(a.x + s * d.x, a.y + s * d.y)
    }

    fn circumcenter(t: Corners) -> Result<Point2, OutOfRange> {
        in_range(center(t))
    }

    fn in_disk(t: Corners, d2: f64, x: f64, y: f64) -> Result<Point2, OutOfRange> {
        let (o, s) = (center(t), 1.0 - d2);
        let f = t[0] - o;
        in_range(Point2::new(o.x + s * (x * f.x - y * f.y), o.y + s * (x * f.y + y * f.x)))
    }

    fn offcenter(t: Corners, kappa: f64) -> Result<Point2, OutOfRange> {
        let [p, q, c] = t;
        let (f, g) = (c - p, c - q);
        if f.x * g.x + f.y * g.y <= 2.0 * kappa * (f.x * g.y - f.y * g.x) {
            return Self::circumcenter(t);
        }
        in_range(Point2::new(0.5 * (p.x + q.x) - kappa * (q.y - p.y), 0.5 * (p.y + q.y) + kappa * (q.x - p.x)))
    }

    fn clamped_offcenter(t: Corners, kappa: f64, d2: f64) -> Result<Point2, OutOfRange> {
        let a = Self::offcenter(t, kappa)?;
        let o = center(t);
        let (from_o, radius) = (a - o, t[0] - o);
        let (d, r) =
            ((from_o.x * from_o.x + from_o.y * from_o.y).sqrt(), (radius.x * radius.x + radius.y * radius.y).sqrt());
        if d <= (1.0 - d2) * r {
            return Ok(a);
        }
        let s = (1.0 - d2) * r / d;
        in_range(Point2::new(o.x + s * from_o.x, o.y + s * from_o.y))
    }
}
