//! The negative control in space: exact decisions, constructions in plain f64 arithmetic. See `arith::plain`.

use super::kernel3::{ConstructionError, Corners3, Kernel3, WeightedCorners};
use crate::arith::fast::FastKernel;
use crate::arith::plain::PlainKernel;
use crate::arith::round;
use crate::model::{Point3, Sign, WeightedPoint};
use std::cmp::Ordering;

/// The range rule, so that the control fails by its roundings alone; what is not a number is degenerate.
fn in_range(p: Point3) -> Result<Point3, ConstructionError> {
    if p.is_nan() {
        return Err(ConstructionError::Degenerate);
    }
    Ok(Point3::new(round::coordinate(p.x)?, round::coordinate(p.y)?, round::coordinate(p.z)?))
}

/// v = p - base and |v|^2 + w_base - w_p.
fn edge(base: WeightedPoint, p: WeightedPoint) -> (Point3, f64) {
    let v = p.at - base.at;
    (v, v.length_squared() + base.weight - p.weight)
}

fn center(t: WeightedCorners) -> Point3 {
    let [(u, hu), (v, hv), (w, hw)] = [edge(t[0], t[1]), edge(t[0], t[2]), edge(t[0], t[3])];
    t[0].at + (v.cross(w) * hu + w.cross(u) * hv + u.cross(v) * hw) / (2.0 * u.dot(v.cross(w)))
}

/// The orthocenter of a triangle and its normal.
fn axis(t: [WeightedPoint; 3]) -> (Point3, Point3) {
    let [(u, hu), (v, hv)] = [edge(t[0], t[1]), edge(t[0], t[2])];
    let n = u.cross(v);
    (t[0].at + (v.cross(n) * hu + n.cross(u) * hv) / (2.0 * n.length_squared()), n)
}

impl Kernel3 for PlainKernel {
    fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
        FastKernel::orient3d(a, b, c, d)
    }
    fn in_sphere(t: Corners3, q: Point3) -> Sign {
        FastKernel::in_sphere(t, q)
    }
    fn power_side(t: WeightedCorners, q: WeightedPoint) -> Sign {
        FastKernel::power_side(t, q)
    }
    fn power_side_of_triangle(t: [WeightedPoint; 3], q: WeightedPoint) -> Sign {
        FastKernel::power_side_of_triangle(t, q)
    }
    fn power_side_of_edge(a: WeightedPoint, b: WeightedPoint, q: WeightedPoint) -> Sign {
        FastKernel::power_side_of_edge(a, b, q)
    }
    fn in_diametral_ball(u: Point3, v: Point3, w: Point3) -> Sign {
        FastKernel::in_diametral_ball(u, v, w)
    }
    fn in_equatorial_ball(a: Point3, b: Point3, c: Point3, w: Point3) -> Sign {
        FastKernel::in_equatorial_ball(a, b, c, w)
    }
    fn compare_lengths3(a: Point3, b: Point3, c: Point3, d: Point3) -> Ordering {
        FastKernel::compare_lengths3(a, b, c, d)
    }
    fn compare_power_distances(x: Point3, p: WeightedPoint, q: WeightedPoint) -> Ordering {
        FastKernel::compare_power_distances(x, p, q)
    }
    fn compare_orthoradius2(t: WeightedCorners, bound: f64) -> Ordering {
        FastKernel::compare_orthoradius2(t, bound)
    }
    fn compare_orthoradii(t1: WeightedCorners, t2: WeightedCorners) -> Ordering {
        FastKernel::compare_orthoradii(t1, t2)
    }
    fn compare_radius_edge(t: Corners3, rho2: f64) -> Ordering {
        FastKernel::compare_radius_edge(t, rho2)
    }
    fn compare_radius_edge_of_triangle(t: [Point3; 3], rho2: f64) -> Ordering {
        FastKernel::compare_radius_edge_of_triangle(t, rho2)
    }
    fn orthocenter_side(t: WeightedCorners, plane: [Point3; 3]) -> Sign {
        FastKernel::orthocenter_side(t, plane)
    }
    fn normal_side(t: [Point3; 3], plane: [Point3; 3]) -> Sign {
        FastKernel::normal_side(t, plane)
    }

    fn midpoint3(a: Point3, b: Point3) -> Point3 {
        // a + (b - a)/2 rounds twice; (a + b)/2 would be right.
        a + 0.5 * (b - a)
    }

    fn at_fraction3(a: Point3, b: Point3, t: f64) -> Point3 {
        a + t * (b - a)
    }

    fn orthocenter(t: WeightedCorners) -> Result<Point3, ConstructionError> {
        in_range(center(t))
    }

    fn orthocenter_of_triangle(t: [WeightedPoint; 3]) -> Result<Point3, ConstructionError> {
        in_range(axis(t).0)
    }

    fn dual_line_meets_plane(t: [WeightedPoint; 3], u: Point3, m: Point3) -> Result<Point3, ConstructionError> {
        let (o, n) = axis(t);
        in_range(o + n * ((u - o).dot(m) / n.dot(m)))
    }

    fn sphere_meets_segment(c: Point3, r: f64, a: Point3, b: Point3) -> [Option<Point3>; 2] {
        let (d, f) = (b - a, a - c);
        let (square, half, rest) = (d.length_squared(), d.dot(f), f.length_squared() - r * r);
        let root = (half * half - square * rest).sqrt();
        let at = |s: f64| (0.0..=1.0).contains(&s).then(|| a + s * d);
        match (at((-half - root) / square), at((-half + root) / square)) {
            (None, later) => [later, None],
            (first, later) => [first, later],
        }
    }

    fn distance(a: Point3, b: Point3) -> f64 {
        (b - a).length()
    }

    fn circumradius(t: Corners3) -> Result<f64, ConstructionError> {
        let o = in_range(center(t.map(WeightedPoint::unweighted)))?;
        Ok((t[0] - o).length())
    }

    fn short_radius_below(a: Point3, b: Point3, s: f64) -> f64 {
        f64::from_bits(((b - a).length() * s).to_bits() >> 27 << 27)
    }

    fn short_radius_above(a: Point3, b: Point3, s: f64) -> f64 {
        f64::from_bits((((b - a).length() * s).to_bits() >> 27 << 27) + (1 << 27))
    }
}
