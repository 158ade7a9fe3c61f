//! A kernel that can tell orientations and compare angles, for the tests of this module.
use crate::arith::{Corners, Kernel, OutOfRange};
use crate::model::{Point2, Sign};
use std::cmp::Ordering;

#[derive(Clone, Copy, Default)]
pub(super) struct Orientations;

macro_rules! absent {
    ($($name:ident($($arg:ty),*) -> $out:ty;)*) => {$(#[allow(unused)] fn $name($(_: $arg),*) -> $out { unimplemented!() })*}
}

impl Kernel for Orientations {
    fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
        let c2 = |p: Point2| robust::Coord { x: p.x, y: p.y };
        match robust::orient2d(c2(a), c2(b), c2(c)) {
            d if d > 0.0 => Sign::Positive,
            d if d < 0.0 => Sign::Negative,
            _ => Sign::Zero,
        }
    }
    absent! {
        in_circle(Corners, Point2) -> Sign;
        in_diametral_circle(Point2, Point2, Point2) -> Sign;
        walk_side(Corners, Point2, Point2) -> Sign;
        edge_meets_diametral_disk(Point2, Point2, Point2, Point2) -> bool;
        compare_lengths(Point2, Point2, Point2, Point2) -> Ordering;
        compare_ratio(Corners, Corners) -> Ordering;
        compare_area_ratio(Corners, f64, Corners, f64) -> Ordering;
        compare_radius_ratio(Corners, f64, Corners, f64) -> Ordering;
        is_skinny(Corners, f64) -> bool;
        exceeds_area(Corners, f64) -> bool;
        exceeds_radius(Corners, f64) -> bool;
        in_selection_disk(Corners, f64, Point2) -> bool;
        in_selection_interval(Point2, Point2, f64, Point2) -> bool;
        compare_cos2(Point2, Point2, Point2, f64) -> Ordering;
        shell_exponent(Point2, Point2) -> i32;
        length2(Point2, Point2) -> f64;
        ratio2(Corners) -> f64;
        area_ratio(Corners, f64) -> f64;
        radius_ratio2(Corners, f64) -> f64;
        midpoint(Point2, Point2) -> Point2;
        in_interval(Point2, Point2, f64, f64) -> Point2;
        at_distance(Point2, Point2, i32) -> Point2;
        circumcenter(Corners) -> Result<Point2, OutOfRange>;
        in_disk(Corners, f64, f64, f64) -> Result<Point2, OutOfRange>;
        offcenter(Corners, f64) -> Result<Point2, OutOfRange>;
        clamped_offcenter(Corners, f64, f64) -> Result<Point2, OutOfRange>;
    }
}
