//! Whether triangles meet where they should not, and how rays cross them: exact, each case from orientations.

use crate::check::space::double::sign_in_space;
use crate::check::space::predicates::{Vector, cross, dot, orient, vector};
use crate::check::value::Number;
use crate::model::{Point3, Sign};

/// A triangle.
pub(super) type Triangle = [Point3; 3];

/// Whether two triangles have a point in common that is in no common corner or edge; `common` gives the pairs of corners that are one vertex.
pub(super) fn improperly(s: &Triangle, t: &Triangle, common: &[(usize, usize)]) -> bool {
    let edges = [(0, 1), (1, 2), (2, 0)];
    match *common {
        // Without a common corner an edge of one meets the other.
        [] => {
            edges.iter().any(|&(i, j)| segment_meets([s[i], s[j]], t))
                || edges.iter().any(|&(i, j)| segment_meets([t[i], t[j]], s))
        }
        // What they share is convex and holds the common corner; if more, it ends at an edge across from it.
        [(i, j)] => {
            segment_meets([s[(i + 1) % 3], s[(i + 2) % 3]], t) || segment_meets([t[(j + 1) % 3], t[(j + 2) % 3]], s)
        }
        // At a common edge: in one plane, on the same side.
        [(i, j), (k, l)] => {
            let (u, v, p, q) = (s[i], s[k], s[3 - i - k], t[3 - j - l]);
            orient(u, v, p, q) == Sign::Zero && same_side(u, v, p, q)
        }
        // The same corners.
        _ => true,
    }
}

/// Whether a closed segment and a closed triangle meet.
fn segment_meets([p, q]: [Point3; 2], t: &Triangle) -> bool {
    let [a, b, c] = *t;
    let (at_p, at_q) = (orient(a, b, c, p), orient(a, b, c, q));
    if at_p == Sign::Zero && at_q == Sign::Zero {
        return coplanar_segment_meets([p, q], t);
    }
    if at_p == at_q {
        return false;
    }
    let turns = [orient(p, q, a, b), orient(p, q, b, c), orient(p, q, c, a)];
    !(turns.contains(&Sign::Positive) && turns.contains(&Sign::Negative))
}

/// The same in the triangle's plane, seen along an axis from which the triangle is not an edge.
fn coplanar_segment_meets([p, q]: [Point3; 2], &[a, b, c]: &Triangle) -> bool {
    let seen = (0..3).map(|axis| (axis, turn(axis, a, b, c))).find(|s| s.1 != Sign::Zero);
    let Some((axis, sign)) = seen else {
        return false;
    };
    let left = |u, v, x| if sign.is_positive() { turn(axis, u, v, x) } else { turn(axis, u, v, x).reversed() };
    let holds = |x| ![left(a, b, x), left(b, c, x), left(c, a, x)].contains(&Sign::Negative);
    let crosses = |u, v| left(u, v, p) != left(u, v, q) && left(p, q, u) != left(p, q, v);
    holds(p) || holds(q) || crosses(a, b) || crosses(b, c) || crosses(c, a)
}

/// Whether p and q, in one plane with u and v, lie strictly on the same side of line uv.
fn same_side(u: Point3, v: Point3, p: Point3, q: Point3) -> bool {
    (0..3).any(|axis| turn(axis, u, v, p) != Sign::Zero && turn(axis, u, v, p) == turn(axis, u, v, q))
}

/// Which way a, b, c turn as seen against an axis.
fn turn(axis: usize, a: Point3, b: Point3, c: Point3) -> Sign {
    sign_in_space!(turn_in(axis, a, b, c))
}

fn turn_in<N: Number>(axis: usize, a: Point3, b: Point3, c: Point3) -> N {
    minor(axis, &vector(a, b), &vector(a, c))
}

/// A component of u x v.
fn minor<N: Number>(axis: usize, u: &Vector<N>, v: &Vector<N>) -> N {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    u[j].clone() * v[k].clone() - u[k].clone() * v[j].clone()
}

/// How a ray crosses a triangle: 1 from the side where it is seen counterclockwise to the other, -1 the other way, 0 not at all.
///
/// The ray starts at the center of `from` and heads in the direction (1, e, e^2) with an infinitesimal e > 0, which lies in no plane
/// through three points. It crosses if it is in the cone of the corners seen from its start: on the inner side of the cone's three planes.
pub(super) fn crossing(from: &Triangle, t: &Triangle) -> i32 {
    if is_out_of_the_way(from, t) { 0 } else { crossing_of_cone(from, t) }
}

/// Whether all of `t` is behind the start of the ray from `from`, or off its line, by their boxes: exact, as no number is rounded.
///
/// The start o lies in the box of `from`. No point of the ray has x < o.x; all of its points that are not infinitely far have y and z infinitely
/// close to those of o.
fn is_out_of_the_way(from: &Triangle, t: &Triangle) -> bool {
    let bounds = |[a, b, c]: &Triangle| (a.min(*b).min(*c), a.max(*b).max(*c));
    let ((low, high), (t_low, t_high)) = (bounds(from), bounds(t));
    t_high.x < low.x || t_high.y < low.y || t_high.z < low.z || t_low.y > high.y || t_low.z > high.z
}

/// As `crossing`, whatever the boxes.
fn crossing_of_cone(from: &Triangle, t: &Triangle) -> i32 {
    let outgoing = match sign_in_space!(cone(from, t)) {
        Sign::Zero => return 0,
        Sign::Positive => false,
        Sign::Negative => true,
    };
    let inside = |p, q| if outgoing { heading(from, q, p) } else { heading(from, p, q) };
    let crossed = [(0, 1), (1, 2), (2, 0)].iter().all(|&(i, j)| inside(t[i], t[j]) == Sign::Positive);
    match (crossed, outgoing) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    }
}

/// Whether the ray's direction heads to the side of a triangle where it is seen counterclockwise.
pub(super) fn heads_in(t: &Triangle) -> bool {
    heading(&[t[0]; 3], t[1], t[2]) == Sign::Positive
}

/// The sign of (1, e, e^2) . (p x q), p and q seen from the center of `from`: of the first component that is not zero.
fn heading(from: &Triangle, p: Point3, q: Point3) -> Sign {
    (0..3).map(|axis| sign_in_space!(heading_in(from, p, q, axis))).find(|&s| s != Sign::Zero).unwrap_or(Sign::Zero)
}

fn heading_in<N: Number>(from: &Triangle, p: Point3, q: Point3, axis: usize) -> N {
    minor(axis, &seen(from, p), &seen(from, q))
}

/// The volume that a triangle spans with the center of `from`, up to a positive factor.
fn cone<N: Number>(from: &Triangle, t: &Triangle) -> N {
    dot(&seen(from, t[0]), &cross(&seen(from, t[1]), &seen(from, t[2])))
}

/// Three times p less the center of `from`.
fn seen<N: Number>(from: &Triangle, p: Point3) -> Vector<N> {
    let axis = |x: f64, a: f64, b: f64, c: f64| (N::of(x) - N::of(a)) + (N::of(x) - N::of(b)) + (N::of(x) - N::of(c));
    let [a, b, c] = from;
    [axis(p.x, a.x, b.x, c.x), axis(p.y, a.y, b.y, c.y), axis(p.z, a.z, b.z, c.z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles of few places, so that the ray starts in planes, edges and corners, flat ones too, and of places drawn finely.
    #[test]
    fn boxes_out_of_the_way_are_not_crossed() {
        let mut state = 3u64;
        let mut draw = |places: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % places
        };
        let (mut crossed, mut rejected) = ([0; 3], 0);
        for case in 0..60_000 {
            let places = [3, 4, 7, 1 << 30][case % 4];
            let scale = [1.0, 0.1][case / 4 % 2];
            let mut corner = || Point3::from_array([(); 3].map(|()| draw(places) as f64 * scale));
            let mut triangle = || [(); 3].map(|()| corner());
            let (from, t) = (triangle(), triangle());
            let from = if case % 3 == 0 { [from[0]; 3] } else { from };
            let crossing = crossing_of_cone(&from, &t);
            crossed[(crossing + 1) as usize] += 1;
            if is_out_of_the_way(&from, &t) {
                assert_eq!(crossing, 0, "{from:?} {t:?}");
                rejected += 1;
            }
        }
        assert!(rejected > 5_000 && crossed[0] > 1_000 && crossed[2] > 1_000, "{rejected} {crossed:?}");
    }
}
