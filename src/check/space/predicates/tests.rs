//! Against a determinant over the rationals, and against the published triangulation of a cube's corners.

use super::super::ball::{Ball, Row};
use super::*;
use crate::check::rational::Rational;
use crate::check::scale::power_of_two;

fn site(x: f64, y: f64, z: f64, weight: f64) -> WeightedPoint {
    WeightedPoint { at: Point3::new(x, y, z), weight }
}

fn determinant(rows: &[Vec<Rational>]) -> Rational {
    if rows.is_empty() {
        return Rational::of(1.0);
    }
    let mut sum = Rational::of(0.0);
    for i in 0..rows.len() {
        let minor: Vec<Vec<Rational>> =
            rows.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, row)| row[1..].to_vec()).collect();
        let sign = Rational::of(if i % 2 == 0 { 1.0 } else { -1.0 });
        sum = sum + sign * rows[i][0].clone() * determinant(&minor);
    }
    sum
}

/// det of the rows (1, x, y, z, |p|^2 - w): for a positive cell and q last, its sign is that of q's height above the plane.
fn definition(t: &Corners, q: &WeightedPoint) -> (Ordering, Ordering) {
    let row = |p: &WeightedPoint| {
        let x = [p.at.x, p.at.y, p.at.z].map(Rational::of);
        let square = x.iter().fold(Rational::of(0.0), |sum, x| sum + x.squared());
        let [a, b, c] = x;
        vec![Rational::of(1.0), a, b, c, square - Rational::of(p.weight)]
    };
    let rows: Vec<Vec<Rational>> = t.iter().chain([q]).map(row).collect();
    let bare: Vec<Vec<Rational>> = rows[..4].iter().map(|r| r[..4].to_vec()).collect();
    (determinant(&bare).sign(), determinant(&rows).sign().reverse())
}

fn order(sign: Sign) -> Ordering {
    (sign as i32).cmp(&0)
}

/// Random numbers in [0, 1) of up to 53 bits.
fn draws() -> impl FnMut() -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn signs_are_those_of_the_determinants() {
    let mut draw = draws();
    let (mut zeros, mut open) = (0, 0);
    for case in 0..4000 {
        let points: [WeightedPoint; 5] = std::array::from_fn(|_| {
            let [a, b, c, d] = std::array::from_fn(|_| draw());
            let grid = |x: f64| (x * 4.0).floor() / 4.0;
            let on_sphere = |x: f64| if x < 0.5 { -0.5 } else { 0.5 };
            let near = |x: f64, noise: f64| on_sphere(x) + (noise - 0.5) / power_of_two(20 + case % 35);
            match case % 5 {
                0 => site(a, b, c, 0.0),
                1 => site(grid(a), grid(b), grid(c), 0.0),
                2 => site(grid(a), grid(b), grid(c), grid(d)),
                3 => site(near(a, b), near(b, c), near(c, a), d / power_of_two(50)),
                _ => site(a / power_of_two(case % 300), b, c / power_of_two(case % 1000), d - 0.5),
            }
        });
        let (t, q) = ([points[0], points[1], points[2], points[3]], points[4]);
        let (orientation, below) = definition(&t, &q);
        let [a, b, c, d] = t.map(|p| p.at);
        assert_eq!(order(orient(a, b, c, d)), orientation, "{t:?}");
        if orientation == Ordering::Greater {
            assert_eq!(order(side(&t, &q)), below, "{t:?} {q:?}");
            zeros += usize::from(below == Ordering::Equal);
            let [u, v, w] = [0, 1, 2].map(|k: usize| Row::new(t[3], t[k]));
            open += usize::from(Ball::new(&u, &v, &w).side(&Row::new(t[3], q)).is_none());
            // A cell does not conflict with its own corners.
            assert!(t.iter().all(|p| !in_conflict(&t, p)));
        }
    }
    // The families are hard enough for every stage.
    assert!(zeros > 40 && open > zeros + 100, "{zeros} {open}");
}

#[test]
fn the_tie_break_is_the_published_one() {
    // Corners of a cube, z fastest; the list is that of CGAL.
    let p: Vec<WeightedPoint> = (0..8).map(|i| site((i / 4) as f64, (i / 2 % 2) as f64, (i % 2) as f64, 0.0)).collect();
    let mut cells = Vec::new();
    for i in 0..8u32 {
        for (j, k, l) in (i + 1..8).flat_map(|j| (j + 1..8).flat_map(move |k| (k + 1..8).map(move |l| (j, k, l)))) {
            let mut t = [i, j, k, l].map(|v| p[v as usize]);
            match orient(t[0].at, t[1].at, t[2].at, t[3].at) {
                Sign::Zero => continue,
                Sign::Negative => t.swap(2, 3),
                Sign::Positive => {}
            }
            if !p.iter().any(|q| in_conflict(&t, q)) {
                cells.push([i, j, k, l]);
            }
        }
    }
    assert_eq!(cells, [[0, 1, 2, 4], [1, 2, 3, 4], [1, 3, 4, 5], [2, 3, 4, 6], [3, 4, 5, 6], [3, 5, 6, 7]]);
}
