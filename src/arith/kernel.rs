//! The contract of a kernel.
//!
//! The law: two kernels give the same answer to every call, bit for bit. A decision is the sign (or order) of an exact
//! expression in its arguments. A construction is the exact value of one function of its arguments, each coordinate
//! rounded once to nearest, ties to even, then 0 if its magnitude is below `2^-142`, then -0 made +0; `OutOfRange` if
//! the magnitude exceeds `2^200`.
//!
//! Arguments are finite, normalised so that the largest input coordinate lies in [1/2, 1), and every nonzero
//! coordinate is at least `2^-142` in magnitude (`domain::normalise`). Parameters (`rho2`, `d2`, `kappa`, bounds) are
//! positive finite f64s taken exactly.

use crate::model::{Point2, Sign};
use std::cmp::Ordering;

/// The corners of a triangle, counterclockwise.
pub type Corners = [Point2; 3];

/// A constructed coordinate exceeds the range in which predicates are exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a constructed coordinate is out of range")]
pub struct OutOfRange;

/// Exact predicates and correctly rounded constructions of the plane.
///
/// `cross(a, b, c)` below is twice the signed area of the triangle; `l2 <= m2 <= n2` are the squared lengths of its edges;
/// r its circumradius and o its circumcenter, so r^2 = l2 m2 n2 / (4 cross^2).
pub trait Kernel: Copy + Default + Send + Sync + 'static {
    // Decisions.

    /// Sign of cross(a, b, c): positive if the three points turn counterclockwise.
    fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign;

    /// Position of q against the circle through a counterclockwise triangle: positive strictly inside, zero on it.
    fn in_circle(t: Corners, q: Point2) -> Sign;

    /// Position of w against the circle with diameter uv: positive strictly inside. The sign of -(u-w).(v-w).
    fn in_diametral_circle(u: Point2, v: Point2, w: Point2) -> Sign;

    /// Side of w seen on the way from the centroid of t to q: the sign of cross(centroid, q, w).
    fn walk_side(t: Corners, q: Point2, w: Point2) -> Sign;

    /// Whether the closed edge ab meets the open disk with diameter uv.
    fn edge_meets_diametral_disk(u: Point2, v: Point2, a: Point2, b: Point2) -> bool;

    /// Order of |ab| against |cd|.
    fn compare_lengths(a: Point2, b: Point2, c: Point2, d: Point2) -> Ordering;

    /// Order of the ratios r/l of two triangles.
    fn compare_ratio(t1: Corners, t2: Corners) -> Ordering;

    /// Order of area(t1)/bound1 against area(t2)/bound2.
    fn compare_area_ratio(t1: Corners, bound1: f64, t2: Corners, bound2: f64) -> Ordering;

    /// Order of r(t1)/h1 against r(t2)/h2.
    fn compare_radius_ratio(t1: Corners, h1: f64, t2: Corners, h2: f64) -> Ordering;

    /// Whether t is skinny: r^2 >= rho2 l^2, that is m2 n2 >= 4 rho2 cross^2. Ties are skinny.
    fn is_skinny(t: Corners, rho2: f64) -> bool;

    /// Whether area(t) > bound.
    fn exceeds_area(t: Corners, bound: f64) -> bool;

    /// Whether r(t) > h.
    fn exceeds_radius(t: Corners, h: f64) -> bool;

    /// Whether a lies in the closed selection disk of t: |a - o|^2 <= (1 - d2)^2 r^2. Source: \[GCDR\] Definition 3.1.
    fn in_selection_disk(t: Corners, d2: f64, a: Point2) -> bool;

    /// Whether 4 |p - c|^2 <= (1 - delta)^2 |uv|^2, c the midpoint of uv. Source: \[GCDR\] Definitions 3.2, 3.3.
    fn in_selection_interval(u: Point2, v: Point2, delta: f64, p: Point2) -> bool;

    /// Order of cos^2 of the angle at `apex` between p and q against bound: (u.v)^2 against bound u^2 v^2, with
    /// u = p - apex, v = q - apex; `Less` if u.v <= 0. bound = 1/4 asks for 60 degrees: `Greater` means a smaller angle.
    fn compare_cos2(apex: Point2, p: Point2, q: Point2, bound: f64) -> Ordering;

    /// The integer k with |uv|/3 < 2^k <= 2|uv|/3. Source: `docs/gcdr.md`, shells.
    fn shell_exponent(u: Point2, v: Point2) -> i32;

    // Keys: correctly rounded values used to order queues; equal keys are told apart by the exact comparison above.

    /// |ab|^2 rounded to nearest (no flush to zero: a key is not a coordinate).
    fn length2(a: Point2, b: Point2) -> f64;

    /// r^2/l^2 of t rounded to nearest; infinite on overflow.
    fn ratio2(t: Corners) -> f64;

    /// area(t)/bound rounded to nearest.
    fn area_ratio(t: Corners, bound: f64) -> f64;

    /// r^2/h^2 rounded to nearest; infinite on overflow.
    fn radius_ratio2(t: Corners, h: f64) -> f64;

    // Constructions.

    /// Midpoint of ab.
    fn midpoint(a: Point2, b: Point2) -> Point2;

    /// c + x (1 - delta)/2 (b - a), c the midpoint of ab; x in [-1, 1].
    fn in_interval(a: Point2, b: Point2, delta: f64, x: f64) -> Point2;

    /// The point of the ray from a through b at distance 2^k from a (one square root).
    fn at_distance(a: Point2, b: Point2, k: i32) -> Point2;

    /// Circumcenter of t.
    fn circumcenter(t: Corners) -> Result<Point2, OutOfRange>;

    /// o + (1 - d2) (x (w - o) + y rot90(w - o)), w = `t[0]`, rot90(x, y) = (-y, x).
    fn in_disk(t: Corners, d2: f64, x: f64, y: f64) -> Result<Point2, OutOfRange>;

    /// The off-center of t over the edge pq = `t[0]` `t[1]` (the shortest edge): o, if it is at most kappa |pq| from the
    /// midpoint m of pq (on the side of `t[2]`); else m + kappa rot90(q - p).
    fn offcenter(t: Corners, kappa: f64) -> Result<Point2, OutOfRange>;

    /// The off-center, clamped: if the exact point of `offcenter` lies outside the closed selection disk, the point of
    /// the disk on segment mo nearest to it: o + (1 - d2) r (m - o)/|m - o|.
    fn clamped_offcenter(t: Corners, kappa: f64, d2: f64) -> Result<Point2, OutOfRange>;

    /// Whether q is in conflict with the counterclockwise triangle t under the one tie-break: strictly inside its
    /// circle, or on it and inside after the perturbation of `arith::perturb`. q differs from the corners.
    #[inline(always)]
    fn in_conflict(t: Corners, q: Point2) -> bool {
        match Self::in_circle(t, q) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => super::perturb::cocircular_in_conflict::<Self>(t, q),
        }
    }
}
