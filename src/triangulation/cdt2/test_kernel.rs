//! A kernel for this folder's tests: the two predicates that a triangulation needs, on `robust`.

use crate::arith::{Corners, Kernel, OutOfRange};
use crate::model::{Point2, Sign};
use robust::Coord;
use std::cmp::Ordering;

/// Orientation and circle; nothing else.
#[derive(Clone, Copy, Debug, Default)]
pub struct TestKernel;

#[inline]
fn sign(x: f64) -> Sign {
    if x > 0.0 {
        Sign::Positive
    } else if x < 0.0 {
        Sign::Negative
    } else {
        Sign::Zero
    }
}

#[inline]
fn coord(p: Point2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

#[cold]
#[inline(never)]
fn exact_orient(a: Point2, b: Point2, c: Point2) -> Sign {
    sign(robust::orient2d(coord(a), coord(b), coord(c)))
}

#[cold]
#[inline(never)]
fn exact_circle([a, b, c]: Corners, q: Point2) -> Sign {
    sign(robust::incircle(coord(a), coord(b), coord(c), coord(q)))
}

#[allow(unused_variables)]
impl Kernel for TestKernel {
    #[inline]
    fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
        let l = (a.x - c.x) * (b.y - c.y);
        let r = (a.y - c.y) * (b.x - c.x);
        let det = l - r;
        let bound = (l.abs() + r.abs()) * 4e-16;
        if det > bound {
            Sign::Positive
        } else if -det > bound {
            Sign::Negative
        } else {
            exact_orient(a, b, c)
        }
    }
    #[inline]
    fn in_circle(t: Corners, q: Point2) -> Sign {
        let [a, b, c] = t;
        let (ax, ay) = (a.x - q.x, a.y - q.y);
        let (bx, by) = (b.x - q.x, b.y - q.y);
        let (cx, cy) = (c.x - q.x, c.y - q.y);
        let (bc1, bc2) = (bx * cy, by * cx);
        let (ca1, ca2) = (cx * ay, cy * ax);
        let (ab1, ab2) = (ax * by, ay * bx);
        let (al, bl, cl) = (ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy);
        let det = al * (bc1 - bc2) + bl * (ca1 - ca2) + cl * (ab1 - ab2);
        let permanent = al * (bc1.abs() + bc2.abs())
            + bl * (ca1.abs() + ca2.abs())
            + cl * (ab1.abs() + ab2.abs());
        let bound = permanent * 1.2e-15;
        if det > bound {
            Sign::Positive
        } else if -det > bound {
            Sign::Negative
        } else {
            exact_circle(t, q)
        }
    }
    fn in_diametral_circle(u: Point2, v: Point2, w: Point2) -> Sign {
        unimplemented!()
    }
    fn walk_side(t: Corners, q: Point2, w: Point2) -> Sign {
        unimplemented!()
    }
    fn edge_meets_diametral_disk(u: Point2, v: Point2, a: Point2, b: Point2) -> bool {
        unimplemented!()
    }
    fn compare_lengths(a: Point2, b: Point2, c: Point2, d: Point2) -> Ordering {
        unimplemented!()
    }
    fn compare_ratio(t1: Corners, t2: Corners) -> Ordering {
        unimplemented!()
    }
    fn compare_area_ratio(t1: Corners, bound1: f64, t2: Corners, bound2: f64) -> Ordering {
        unimplemented!()
    }
    fn compare_radius_ratio(t1: Corners, h1: f64, t2: Corners, h2: f64) -> Ordering {
        unimplemented!()
    }
    fn is_skinny(t: Corners, rho2: f64) -> bool {
        unimplemented!()
    }
    fn exceeds_area(t: Corners, bound: f64) -> bool {
        unimplemented!()
    }
    fn exceeds_radius(t: Corners, h: f64) -> bool {
        unimplemented!()
    }
    fn in_selection_disk(t: Corners, d2: f64, a: Point2) -> bool {
        unimplemented!()
    }
    fn in_selection_interval(u: Point2, v: Point2, delta: f64, p: Point2) -> bool {
        unimplemented!()
    }
    fn compare_cos2(apex: Point2, p: Point2, q: Point2, bound: f64) -> Ordering {
        unimplemented!()
    }
    fn shell_exponent(u: Point2, v: Point2) -> i32 {
        unimplemented!()
    }
    fn length2(a: Point2, b: Point2) -> f64 {
        unimplemented!()
    }
    fn ratio2(t: Corners) -> f64 {
        unimplemented!()
    }
    fn area_ratio(t: Corners, bound: f64) -> f64 {
        unimplemented!()
    }
    fn radius_ratio2(t: Corners, h: f64) -> f64 {
        unimplemented!()
    }
    fn midpoint(a: Point2, b: Point2) -> Point2 {
        unimplemented!()
    }
    fn in_interval(a: Point2, b: Point2, delta: f64, x: f64) -> Point2 {
        unimplemented!()
    }
    fn at_distance(a: Point2, b: Point2, k: i32) -> Point2 {
        unimplemented!()
    }
    fn circumcenter(t: Corners) -> Result<Point2, OutOfRange> {
        unimplemented!()
    }
    fn in_disk(t: Corners, d2: f64, x: f64, y: f64) -> Result<Point2, OutOfRange> {
        unimplemented!()
    }
    fn offcenter(t: Corners, kappa: f64) -> Result<Point2, OutOfRange> {
        unimplemented!()
    }
    fn clamped_offcenter(t: Corners, kappa: f64, d2: f64) -> Result<Point2, OutOfRange> {
        unimplemented!()
    }
}
