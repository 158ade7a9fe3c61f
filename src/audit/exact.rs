//! The audit's decisions: each formula from its definition, first with a proven error bound, then in rationals.

use crate::check::scalar::{Bounded, Enclosure, Scalar};
use crate::model::Point2;
use std::cmp::Ordering;

/// Decides a comparison: a double with its error bound first, then rationals, which know every answer where no root occurs.
macro_rules! decide {
    ($formula:ident($($argument:expr),*)) => {
        $formula::<Bounded>($($argument),*)
            .or_else(|| $formula::<Enclosure>($($argument),*))
            // formulas here have no roots and no divisions
            .unwrap()
    };
}

/// Which way the path a, b, c turns: `Greater` to the left.
pub(super) fn orient(a: Point2, b: Point2, c: Point2) -> Ordering {
    decide!(orient_in(a, b, c))
}

/// Where d lies against the circle through a counterclockwise triangle: `Greater` strictly inside.
pub(super) fn in_circle(t: [Point2; 3], d: Point2) -> Ordering {
    decide!(in_circle_in(t, d))
}

/// The order of p and q along the direction from a to b: (p - a).(b - a) against (q - a).(b - a).
pub(super) fn along(a: Point2, b: Point2, p: Point2, q: Point2) -> Ordering {
    decide!(along_in(a, b, p, q))
}

/// Whether p is at most `distance` from the line ab.
pub(super) fn is_near_line(a: Point2, b: Point2, p: Point2, distance: f64) -> bool {
    decide!(near_line_in(a, b, p, distance)).is_le()
}

/// Whether the circumradius of a triangle is at least rho times its shortest edge: m^2 n^2 >= 4 rho^2 cross^2, with m and n the
/// longer edges and cross twice the area, since circumradius = l m n / (2 cross).
pub(super) fn is_skinny(t: [Point2; 3], rho2: f64) -> bool {
    decide!(skinny_in(t, rho2)).is_ge()
}

/// About how far p is from the line ab, for display: exactly 0 if it is on it.
pub(super) fn distance_from_line(a: Point2, b: Point2, p: Point2) -> f64 {
    if orient(a, b, p) == Ordering::Equal {
        return 0.0;
    }
    let (u, v) = (difference::<Enclosure>(b, a), difference::<Enclosure>(p, a));
    let length2 = dot(u.clone(), u.clone());
    (cross(u, v).squared() / length2).root().display()
}

/// Whether d is in conflict with t when circles are told apart by raising the lifted points infinitesimally, the
/// lexicographically largest the most: the largest point decides unless raising it changes nothing. Raising d moves it
/// outside. Raising a corner moves d inside or outside as d lies on the corner's side of the opposite edge, or beyond.
pub(super) fn in_conflict(t: [Point2; 3], d: Point2) -> bool {
    match in_circle(t, d) {
        Ordering::Greater => return true,
        Ordering::Less => return false,
        Ordering::Equal => {}
    }
    let mut corners = [0, 1, 2];
    corners.sort_by(|&i, &j| lexicographic(t[j], t[i]));
    for k in corners {
        if lexicographic(d, t[k]).is_gt() {
            return false;
        }
        match orient(d, t[(k + 1) % 3], t[(k + 2) % 3]) {
            Ordering::Greater => return true,
            Ordering::Less => return false,
            Ordering::Equal => {}
        }
    }
    false
}

/// Order by x, then by y; -0 equals 0. Coordinates are finite.
pub(super) fn lexicographic(a: Point2, b: Point2) -> Ordering {
    (a.x + 0.0).total_cmp(&(b.x + 0.0)).then((a.y + 0.0).total_cmp(&(b.y + 0.0)))
}

fn difference<N: Scalar>(a: Point2, b: Point2) -> [N; 2] {
    [N::of(a.x) - N::of(b.x), N::of(a.y) - N::of(b.y)]
}

fn dot<N: Scalar>([a, b]: [N; 2], [c, d]: [N; 2]) -> N {
    a * c + b * d
}

fn cross<N: Scalar>([a, b]: [N; 2], [c, d]: [N; 2]) -> N {
    a * d - b * c
}

fn skinny_in<N: Scalar>([a, b, c]: [Point2; 3], rho2: f64) -> Option<Ordering> {
    let edges = [difference::<N>(b, a), difference::<N>(c, b), difference::<N>(a, c)];
    let [l, m, n] = edges.clone().map(|e| dot(e.clone(), e));
    // The product of the two longer squares is the largest of the three products.
    let longer = (l.clone() * m.clone()).max(m * n.clone()).max(n * l);
    let [u, v, _] = edges;
    longer.compare(&(N::of(4.0) * N::of(rho2) * cross(u, v).squared()))
}

fn orient_in<N: Scalar>(a: Point2, b: Point2, c: Point2) -> Option<Ordering> {
    cross(difference::<N>(b, a), difference::<N>(c, a)).compare(&N::of(0.0))
}

fn in_circle_in<N: Scalar>(t: [Point2; 3], d: Point2) -> Option<Ordering> {
    let [u, v, w] = t.map(|p| difference::<N>(p, d));
    let lift = |p: &[N; 2]| dot(p.clone(), p.clone());
    let sum = lift(&u) * cross(v.clone(), w.clone()) + lift(&v) * cross(w.clone(), u.clone()) + lift(&w) * cross(u, v);
    sum.compare(&N::of(0.0))
}

fn along_in<N: Scalar>(a: Point2, b: Point2, p: Point2, q: Point2) -> Option<Ordering> {
    dot(difference::<N>(p, q), difference::<N>(b, a)).compare(&N::of(0.0))
}

fn near_line_in<N: Scalar>(a: Point2, b: Point2, p: Point2, distance: f64) -> Option<Ordering> {
    let (u, v) = (difference::<N>(b, a), difference::<N>(p, a));
    let length2 = dot(u.clone(), u.clone());
    cross(u, v).squared().compare(&(N::of(distance).squared() * length2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    #[test]
    fn nearly_and_exactly_degenerate() {
        let e = 2f64.powi(-60);
        assert_eq!(orient(p(0.0, 0.0), p(1.0, 1.0), p(3.0, 3.0)), Ordering::Equal);
        assert_eq!(orient(p(0.0, e), p(1.0, 1.0), p(3.0, 3.0)), Ordering::Greater);
        assert_eq!(orient(p(1e-300, 0.0), p(0.0, 1e-300), p(-1e-300, 0.0)), Ordering::Greater);
        assert_eq!(orient(p(1e300, 0.0), p(0.0, 1e300), p(-1e300, 0.0)), Ordering::Greater);
        let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0)];
        assert_eq!(in_circle(square, p(0.0, 1.0)), Ordering::Equal);
        assert_eq!(in_circle(square, p(e, 1.0)), Ordering::Greater);
        assert_eq!(in_circle(square, p(-e, 1.0)), Ordering::Less);
    }

    #[test]
    fn one_diagonal_of_a_square_is_canonical() {
        // Of both diagonals exactly one passes, from either side, in any rotation of the tuples.
        let q = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)];
        for shift in [p(0.0, 0.0), p(-5.0, 3.0)] {
            let [a, b, c, d] = q.map(|x| x + shift);
            let ac = [in_conflict([a, b, c], d), in_conflict([b, c, a], d), in_conflict([c, d, a], b)];
            let bd = [in_conflict([a, b, d], c), in_conflict([b, d, a], c), in_conflict([b, c, d], a)];
            assert_eq!(ac, [ac[0]; 3]);
            assert_eq!(bd, [bd[0]; 3]);
            assert_ne!(ac[0], bd[0]);
        }
    }

    #[test]
    fn distance_from_a_line_is_exact() {
        let (a, b) = (p(0.0, 0.0), p(3.0, 4.0));
        assert!(is_near_line(a, b, p(0.0, 5.0), 3.0));
        assert!(!is_near_line(a, b, p(0.0, 5.0), 3f64.next_down()));
    }
}
