//! Families of point sets.

use super::draw::{Draw, two_to};
use super::planar::turn;
use crate::model::Point2;

/// A way of being nasty for a point set. "Uniform" means multiples of 2^-53; every draw is independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, arbitrary::Arbitrary)]
pub enum PointFamily {
    /// Uniform in the unit square.
    Random,
    /// Integers of a k x k grid, k between half and twice the square root of n: many cocircular quadruples and collinear triples.
    Grid,
    /// A grid, a line or a circle whose points are moved by noise of 2^-10 to 2^-55 of their size (one exponent per set).
    NearDegenerate,
    /// Lattice points of up to three concentric circles of squared radius 25, 325, 1105, 5525, 27625, 138125 or 1185665, sometimes with the
    /// common center: exactly cocircular.
    Cocircular,
    /// Runs of equally spaced integer points on up to five lines, and a few points beside them.
    Collinear,
    /// Up to six centers in the unit square; each point lies beside one of them, at most 2^-4 to 2^-36 away.
    Clusters,
    /// 10^6 + 10^-3 U in both coordinates: six digits lost to the offset.
    Offset,
    /// U 2^e for each coordinate, e uniform in -40..=40, either sign: features of all sizes.
    WildScales,
}

impl PointFamily {
    /// All families.
    pub const ALL: [PointFamily; 8] = [
        PointFamily::Random,
        PointFamily::Grid,
        PointFamily::NearDegenerate,
        PointFamily::Cocircular,
        PointFamily::Collinear,
        PointFamily::Clusters,
        PointFamily::Offset,
        PointFamily::WildScales,
    ];
}

/// About `n` points of a family: distinct, at least three, not all on one line, in the order drawn. Fewer than `n` where draws repeat, up to
/// three more where they are all on one line.
pub fn points(family: PointFamily, n: usize, draw: &mut impl Draw) -> Vec<Point2> {
    let n = n.max(3);
    let drawn = match family {
        PointFamily::Random => (0..n).map(|_| Point2::new(draw.unit(), draw.unit())).collect(),
        PointFamily::Grid => grid(n, draw),
        PointFamily::NearDegenerate => near_degenerate(n, draw),
        PointFamily::Cocircular => cocircular(n, draw),
        PointFamily::Collinear => collinear(n, draw),
        PointFamily::Clusters => clusters(n, draw),
        PointFamily::Offset => {
            (0..n).map(|_| Point2::new(1e6 + 1e-3 * draw.unit(), 1e6 + 1e-3 * draw.unit())).collect()
        }
        PointFamily::WildScales => (0..n).map(|_| Point2::new(wild(draw), wild(draw))).collect(),
    };
    spread(distinct(drawn))
}

/// Drops repetitions, keeping the first of equal points; -0 becomes +0.
fn distinct(points: Vec<Point2>) -> Vec<Point2> {
    let mut seen = std::collections::BTreeSet::new();
    let plain = |x: f64| if x == 0.0 { 0.0 } else { x };
    points
        .into_iter()
        .map(|p| Point2::new(plain(p.x), plain(p.y)))
        .filter(|p| seen.insert((p.x.to_bits(), p.y.to_bits())))
        .collect()
}

/// Adds corners around the set until three points span the plane.
fn spread(mut points: Vec<Point2>) -> Vec<Point2> {
    let flat = |points: &[Point2]| match points {
        [a, b, rest @ ..] => rest.iter().all(|&c| turn(*a, *b, c) == 0),
        _ => true,
    };
    let far = points.iter().fold(1.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs()));
    for corner in [Point2::new(-2.0 * far, 0.0), Point2::new(far, 3.0 * far), Point2::new(far, -4.0 * far)] {
        if flat(&points) {
            points.push(corner);
        }
    }
    points
}

fn grid(n: usize, draw: &mut impl Draw) -> Vec<Point2> {
    let root = (1..).find(|k| k * k >= n).unwrap_or(1) as i32;
    let side = draw.integer((root / 2).max(1), 2 * root);
    (0..n).map(|_| Point2::new(f64::from(draw.integer(0, side)), f64::from(draw.integer(0, side)))).collect()
}

fn near_degenerate(n: usize, draw: &mut impl Draw) -> Vec<Point2> {
    let base = match draw.below(3) {
        0 => grid(n, draw),
        1 => collinear(n, draw),
        _ => cocircular(n, draw),
    };
    let size = base.iter().fold(1.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs()));
    let noise = size * two_to(-draw.integer(10, 55));
    base.into_iter().map(|p| p + noise * Point2::new(draw.signed_unit(), draw.signed_unit())).collect()
}

/// Lattice points of the circle x^2 + y^2 = r2, in ascending order of x, then y.
pub(super) fn circle(r2: i32) -> Vec<Point2> {
    let bound = (1..).find(|k: &i32| k * k > r2).unwrap_or(1);
    let on = |x: i32| {
        let y2 = r2 - x * x;
        let y = (0..=bound).find(|y| y * y >= y2).filter(|y| y * y == y2);
        y.into_iter().flat_map(move |y| if y == 0 { vec![(x, 0)] } else { vec![(x, -y), (x, y)] })
    };
    (-bound + 1..bound).flat_map(on).map(|(x, y)| Point2::new(f64::from(x), f64::from(y))).collect()
}

fn cocircular(n: usize, draw: &mut impl Draw) -> Vec<Point2> {
    const RADII2: [i32; 7] = [25, 325, 1105, 5525, 27625, 138_125, 1_185_665];
    let rings: Vec<Vec<Point2>> = (0..draw.integer(1, 3)).map(|_| circle(RADII2[draw.below(7) as usize])).collect();
    let center = draw.coin().then_some(Point2::ZERO);
    let pick = |_| {
        let ring = &rings[draw.below(rings.len() as u32) as usize];
        ring[draw.below(ring.len() as u32) as usize]
    };
    center.into_iter().chain((0..n).map(pick)).take(n).collect()
}

fn collinear(n: usize, draw: &mut impl Draw) -> Vec<Point2> {
    let small = |draw: &mut dyn FnMut(i32, i32) -> i32| Point2::new(f64::from(draw(-7, 7)), f64::from(draw(-7, 7)));
    let mut integer = |low, high| draw.integer(low, high);
    let lines: Vec<(Point2, Point2)> = (0..integer(1, 5)).map(|_| (small(&mut integer), small(&mut integer))).collect();
    let mut point = |i: usize| match lines.get(integer(0, 5) as usize) {
        Some(&(start, step)) => start + f64::from(integer(-(i as i32) - 1, i as i32 + 1)) * step,
        None if integer(0, 3) == 0 => small(&mut integer),
        None => lines[0].0 + i as f64 * lines[0].1,
    };
    (0..n).map(&mut point).collect()
}

fn clusters(n: usize, draw: &mut impl Draw) -> Vec<Point2> {
    let centers: Vec<(Point2, f64)> = (0..draw.integer(1, 6))
        .map(|_| (Point2::new(draw.unit(), draw.unit()), two_to(-draw.integer(4, 36))))
        .collect();
    (0..n)
        .map(|_| {
            let (center, size) = centers[draw.below(centers.len() as u32) as usize];
            center + size * Point2::new(draw.signed_unit(), draw.signed_unit())
        })
        .collect()
}

fn wild(draw: &mut impl Draw) -> f64 {
    let size = draw.unit() * two_to(draw.integer(-40, 40));
    if draw.coin() { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::super::SplitMix64;
    use super::*;

    #[test]
    fn every_family_gives_distinct_points_that_span_the_plane() {
        for family in PointFamily::ALL {
            for seed in 0..60 {
                let n = 4 + seed as usize;
                let set = points(family, n, &mut SplitMix64(seed));
                assert!((3..=n + 3).contains(&set.len()), "{family:?} {seed}: {} points for {n}", set.len());
                assert!(set.iter().enumerate().all(|(i, p)| !set[..i].contains(p)), "{family:?} {seed}: repeated");
                assert!(set[2..].iter().any(|&c| turn(set[0], set[1], c) != 0), "{family:?} {seed}: flat");
                assert!(set.iter().all(|p| p.is_finite()));
            }
        }
    }

    /// Without exact ties the families would test nothing.
    #[test]
    fn families_have_the_ties_they_promise() {
        let count = |family, tie: fn(&[Point2]) -> bool| {
            (0..20).filter(|&seed| points(family, 30, &mut SplitMix64(seed)).windows(4).any(tie)).count()
        };
        let cocircular = |w: &[Point2]| {
            let [a, b, c, d] = [w[0], w[1], w[2], w[3]].map(|p| robust::Coord { x: p.x, y: p.y });
            robust::orient2d(a, b, c) != 0.0 && robust::incircle(a, b, c, d) == 0.0
        };
        let collinear = |w: &[Point2]| turn(w[0], w[1], w[2]) == 0;
        assert!(count(PointFamily::Cocircular, cocircular) > 10);
        assert!(count(PointFamily::Collinear, collinear) > 10);
        assert!(count(PointFamily::Grid, collinear) > 5);
        assert_eq!(count(PointFamily::Random, collinear), 0);
    }

    #[test]
    fn circles_hold_all_their_lattice_points() {
        assert_eq!([25, 325, 1105, 1_185_665].map(|r2| circle(r2).len()), [12, 24, 32, 128]);
    }

    /// All-zero draws, as from an exhausted fuzzer, still give a set that can be triangulated.
    #[test]
    fn zeros_are_enough() {
        for family in PointFamily::ALL {
            let set = points(family, 9, &mut super::super::Bytes(&[]));
            assert!(set.len() >= 3, "{family:?}");
        }
    }
}
