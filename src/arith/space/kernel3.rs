//! The contract of a kernel in space. The law and the range rule are those of `arith::kernel`.
//!
//! A nonzero weight has a magnitude of 2^-284 to 2^400 (the squares of the bounds of coordinates). `power(x, p) = |x - p|^2 - w_p`.

use crate::arith::{Kernel, OutOfRange};
use crate::model::{Point3, Sign, WeightedPoint};
use std::cmp::Ordering;

/// The corners of a positively oriented tetrahedron.
pub type Corners3 = [Point3; 4];

/// The weighted corners of a positively oriented tetrahedron.
pub type WeightedCorners = [WeightedPoint; 4];

/// A construction has no answer in range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConstructionError {
    /// The arguments do not determine a point (coplanar, collinear or parallel where they may not be).
    #[error("the construction is degenerate")]
    Degenerate,
    /// A constructed coordinate exceeds the range in which predicates are exact.
    #[error("a constructed coordinate is out of range")]
    OutOfRange,
}

impl From<OutOfRange> for ConstructionError {
    fn from(_: OutOfRange) -> Self {
        ConstructionError::OutOfRange
    }
}

/// Exact predicates and correctly rounded constructions of space.
///
/// `det(u, v, w)` is the triple product u . (v x w). The orthocenter of weighted points is the point of equal power to them, in their affine
/// hull; the common power is the squared radius R^2 of their orthoball (negative for weights large enough). l^2 is the squared length of the
/// shortest edge of the bare points.
pub trait Kernel3: Kernel {
    // Decisions.

    /// Sign of det(b - a, c - a, d - a): positive if d lies on the side of plane abc from which a, b, c turn counterclockwise.
    fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign;

    /// Position of q against the sphere through the corners of t: positive strictly inside, zero on it.
    fn in_sphere(t: Corners3, q: Point3) -> Sign;

    /// Position of q against the orthoball of t: the sign of w_q + R^2 - |q - o|^2, o the orthocenter. Positive: q is in conflict.
    fn power_side(t: WeightedCorners, q: WeightedPoint) -> Sign;

    /// Position of q against the smallest orthoball of a, b, c (its center in their plane), a, b, c not collinear: sign as for `power_side`.
    fn power_side_of_triangle(t: [WeightedPoint; 3], q: WeightedPoint) -> Sign;

    /// Position of q against the smallest orthoball of a and b, a != b: sign as for `power_side`. For weights 0: the diametral ball.
    fn power_side_of_edge(a: WeightedPoint, b: WeightedPoint, q: WeightedPoint) -> Sign;

    /// Position of w against the ball with diameter uv: positive strictly inside. The sign of -(u-w).(v-w).
    fn in_diametral_ball(u: Point3, v: Point3, w: Point3) -> Sign;

    /// Position of w against the ball with center on plane abc through a, b, c (the diametral ball of a subfacet): positive strictly inside.
    fn in_equatorial_ball(a: Point3, b: Point3, c: Point3, w: Point3) -> Sign;

    /// Order of |ab| against |cd|.
    fn compare_lengths3(a: Point3, b: Point3, c: Point3, d: Point3) -> Ordering;

    /// Order of power(x, p) against power(x, q).
    fn compare_power_distances(x: Point3, p: WeightedPoint, q: WeightedPoint) -> Ordering;

    /// Order of R^2 of t against bound.
    fn compare_orthoradius2(t: WeightedCorners, bound: f64) -> Ordering;

    /// Order of R^2 of t1 against R^2 of t2.
    fn compare_orthoradii(t1: WeightedCorners, t2: WeightedCorners) -> Ordering;

    /// Order of R^2 (circumradius) against rho2 l^2 of a tetrahedron.
    fn compare_radius_edge(t: Corners3, rho2: f64) -> Ordering;

    /// Order of R^2 (circumradius) against rho2 l^2 of a triangle.
    fn compare_radius_edge_of_triangle(t: [Point3; 3], rho2: f64) -> Ordering;

    /// Side of the orthocenter of t seen from the oriented plane abc: the sign of orient3d(a, b, c, o).
    fn orthocenter_side(t: WeightedCorners, plane: [Point3; 3]) -> Sign;

    /// Side of the oriented plane abc to which the normal of the oriented triangle t points: the sign of
    /// (t1 - t0) x (t2 - t0) . (b - a) x (c - a). Zero if it is parallel to the plane.
    fn normal_side(t: [Point3; 3], plane: [Point3; 3]) -> Sign;

    // Constructions. Each coordinate is the exact value rounded once; then the range rule.

    /// Midpoint of ab.
    fn midpoint3(a: Point3, b: Point3) -> Point3;

    /// a + t (b - a); t in [0, 1].
    fn at_fraction3(a: Point3, b: Point3, t: f64) -> Point3;

    /// Orthocenter of a tetrahedron; of weights 0, its circumcenter.
    fn orthocenter(t: WeightedCorners) -> Result<Point3, ConstructionError>;

    /// Orthocenter of a triangle, in its plane; of weights 0, its circumcenter.
    fn orthocenter_of_triangle(t: [WeightedPoint; 3]) -> Result<Point3, ConstructionError>;

    /// The point where the dual line of a triangle (the points of equal power to its corners) meets the plane through u with normal m.
    fn dual_line_meets_plane(t: [WeightedPoint; 3], u: Point3, m: Point3) -> Result<Point3, ConstructionError>;

    /// The points at parameters s in [0, 1] where |a + s (b - a) - c| = r, in ascending order of s; none, one or two, the first
    /// place filled first. None if a = b.
    fn sphere_meets_segment(c: Point3, r: f64, a: Point3, b: Point3) -> [Option<Point3>; 2];

    /// |ab|, rounded to nearest; a length is no coordinate and is not made 0.
    fn distance(a: Point3, b: Point3) -> f64;

    /// The radius of the circumsphere of a tetrahedron, rounded to nearest; `OutOfRange` beyond 2^200.
    fn circumradius(t: Corners3) -> Result<f64, ConstructionError>;

    /// |ab| times s, rounded towards zero to 26 significant bits, s in 2^-500..2^500: a radius whose square is an f64. Source: design, law 4.
    fn short_radius_below(a: Point3, b: Point3, s: f64) -> f64;

    /// |ab| times s, rounded away from zero to 26 significant bits.
    fn short_radius_above(a: Point3, b: Point3, s: f64) -> f64;

    // Estimates: a value and a bound of its error. Where the value exceeds the bound or falls below its negative, its sign is certain. They
    // serve many tests in a row without a branch, and decide nothing where an argument is NaN.

    /// A number with the sign of `power_side`. Where all coordinates are multiples of some power of two u, and all weights multiples of u^2, the
    /// caller may pass `exact_below` up to (1024 u)^2: then a bound of 0 means that the value is exact, 0 included. Else it passes 0.
    #[inline(always)]
    fn power_side_estimate(t: WeightedCorners, q: WeightedPoint, exact_below: f64) -> (f64, f64) {
        let _ = (t, q, exact_below);
        (0.0, f64::INFINITY)
    }

    /// For each corner of t a number with the sign of `orient3d` with q in place of the corner; one bound for all.
    #[inline(always)]
    fn orient3d_estimates(t: Corners3, q: Point3) -> ([f64; 4], f64) {
        let _ = (t, q);
        ([0.0; 4], f64::INFINITY)
    }

    /// Whether q is in conflict with the positively oriented tetrahedron t under the one tie-break: strictly nearer than its orthoball, or exactly on it
    /// and inside after the perturbation of `perturb3`. The place of q differs from those of the corners, or its weight does.
    #[inline(always)]
    fn in_conflict3(t: WeightedCorners, q: WeightedPoint) -> bool {
        match Self::power_side(t, q) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => {
                // Copies, so that the corners themselves can stay in registers: see `copied` in the fast kernel.
                let copied = |p: WeightedPoint| Point3::new(p.at.x, p.at.y, p.at.z);
                super::perturb3::cospherical_in_conflict::<Self>(t.map(copied), copied(q))
            }
        }
    }
}
