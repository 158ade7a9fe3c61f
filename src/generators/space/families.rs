//! Families of places in space.

use crate::generators::draw::{Draw, two_to};
use crate::generators::point_sets::circle;
use crate::model::Point3;

/// A way of being nasty for points of space. "Uniform" means multiples of 2^-53; every draw is independent. Only `Duplicates` repeats
/// places on purpose, but `Few` may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, arbitrary::Arbitrary)]
pub enum SpaceFamily {
    /// Uniform in the unit cube.
    Random,
    /// Up to six centers in the unit cube; each point lies beside one of them, at most 2^-4 to 2^-36 away.
    Clusters,
    /// `Grid`, `Cospherical`, `Coplanar` or `Collinear` moved by noise of 2^-10 to 2^-55 of their size (one exponent per set).
    NearDegenerate,
    /// Integers of a k x k x k grid, k between half and twice the cube root of n: cospherical, coplanar and collinear tuples.
    Grid,
    /// Lattice points of one or two concentric spheres, sometimes with their center: exactly cospherical.
    Cospherical,
    /// Points of the unit sphere, each coordinate rounded once or a few times: nearly cospherical.
    RoundedSphere,
    /// In one plane (uniform in x = y, uniform in z = 1/2, or a lattice of two small integer vectors), or in a few parallel ones.
    Coplanar,
    /// Equally spaced integer points of one line, or of up to five.
    Collinear,
    /// At most three points, small integers: no point, one, two or three.
    Few,
    /// One of the other families with n / 3 places only, each drawn again and again.
    Duplicates,
    /// 10^6 + 10^-3 U in each coordinate: six digits lost to the offset.
    Offset,
    /// U 2^e for each coordinate, e uniform in -40..=40, either sign: features of all sizes.
    WildScales,
    /// (t, t^2, t^3) for distinct integers t, |t| <= 2 n: every two points are joined, O(n^2) cells.
    MomentCurve,
    /// Integer points of two skew lines: O(n^2) cells and many cospherical quintuples.
    SkewLines,
    /// Lattice points of a circle at integer heights: prisms, each inscribed in a sphere.
    Cylinder,
}

impl SpaceFamily {
    /// All families.
    pub const ALL: [SpaceFamily; 15] = [
        SpaceFamily::Random,
        SpaceFamily::Clusters,
        SpaceFamily::NearDegenerate,
        SpaceFamily::Grid,
        SpaceFamily::Cospherical,
        SpaceFamily::RoundedSphere,
        SpaceFamily::Coplanar,
        SpaceFamily::Collinear,
        SpaceFamily::Few,
        SpaceFamily::Duplicates,
        SpaceFamily::Offset,
        SpaceFamily::WildScales,
        SpaceFamily::MomentCurve,
        SpaceFamily::SkewLines,
        SpaceFamily::Cylinder,
    ];

    /// Whether the triangulation of n points has about n^2 cells, so that n must stay small.
    pub fn is_quadratic(self) -> bool {
        matches!(self, SpaceFamily::MomentCurve | SpaceFamily::SkewLines)
    }
}

/// At most `n` points of a family, in the order drawn: distinct places save in `Few` and `Duplicates`, fewer than `n` where draws repeat.
pub fn space_points(family: SpaceFamily, n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    match family {
        SpaceFamily::Few => few(draw),
        SpaceFamily::Duplicates => duplicates(n, draw),
        _ => distinct(places(family, n, draw)),
    }
}

fn places(family: SpaceFamily, n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    match family {
        SpaceFamily::Random => (0..n).map(|_| unit_cube(draw)).collect(),
        SpaceFamily::Clusters => clusters(n, draw),
        SpaceFamily::NearDegenerate => near_degenerate(n, draw),
        SpaceFamily::Grid => grid(n, draw),
        SpaceFamily::Cospherical => cospherical(n, draw),
        SpaceFamily::RoundedSphere => (0..n).map(|_| rounded_sphere(draw)).collect(),
        SpaceFamily::Coplanar => coplanar(n, draw),
        SpaceFamily::Collinear => collinear(n, draw),
        SpaceFamily::Few => few(draw),
        SpaceFamily::Duplicates => duplicates(n, draw),
        SpaceFamily::Offset => (0..n).map(|_| Point3::splat(1e6) + 1e-3 * unit_cube(draw)).collect(),
        SpaceFamily::WildScales => (0..n).map(|_| Point3::new(wild(draw), wild(draw), wild(draw))).collect(),
        SpaceFamily::MomentCurve => moment_curve(n, draw),
        SpaceFamily::SkewLines => skew_lines(n, draw),
        SpaceFamily::Cylinder => cylinder(n, draw),
    }
}

fn plain(p: Point3) -> Point3 {
    Point3::from_array(p.to_array().map(|x| if x == 0.0 { 0.0 } else { x }))
}

/// Drops repetitions, keeping the first of equal points; -0 becomes +0.
fn distinct(points: Vec<Point3>) -> Vec<Point3> {
    let mut seen = std::collections::BTreeSet::new();
    points.into_iter().map(plain).filter(|p| seen.insert(p.to_array().map(f64::to_bits))).collect()
}

fn unit_cube(draw: &mut impl Draw) -> Point3 {
    Point3::new(draw.unit(), draw.unit(), draw.unit())
}

fn signed_cube(draw: &mut impl Draw) -> Point3 {
    Point3::new(draw.signed_unit(), draw.signed_unit(), draw.signed_unit())
}

fn small(draw: &mut impl Draw, bound: i32) -> Point3 {
    let mut integer = || f64::from(draw.integer(-bound, bound));
    Point3::new(integer(), integer(), integer())
}

/// The least k with k^power >= n.
pub(super) fn root(n: usize, power: u32) -> i32 {
    (1..).find(|&k: &usize| k.saturating_pow(power) >= n).unwrap_or(1) as i32
}

fn grid(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let k = root(n, 3);
    let side = draw.integer((k / 2).max(1), 2 * k);
    let mut integer = || f64::from(draw.integer(0, side));
    (0..n).map(|_| Point3::new(integer(), integer(), integer())).collect()
}

fn near_degenerate(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let bases = [SpaceFamily::Grid, SpaceFamily::Cospherical, SpaceFamily::Coplanar, SpaceFamily::Collinear];
    let base = places(bases[draw.below(4) as usize], n, draw);
    let size = base.iter().fold(1.0, |m: f64, p| m.max(p.abs().max_element()));
    let noise = size * two_to(-draw.integer(10, 55));
    base.into_iter().map(|p| p + noise * signed_cube(draw)).collect()
}

/// Lattice points of the sphere x^2 + y^2 + z^2 = r2 in ascending order.
fn lattice_sphere(r2: i32) -> Vec<Point3> {
    let bound = (1..).find(|k: &i32| k * k > r2).unwrap_or(1);
    let on = |x: i32, y: i32| {
        let z2 = r2 - x * x - y * y;
        // Exact for these numbers: the root of a square below 2^53 is exact.
        let z = f64::from(z2.max(0)).sqrt() as i32;
        let found = if z2 < 0 || z * z != z2 { vec![] } else { vec![-z, z] };
        found.into_iter().skip(usize::from(z == 0)).map(move |z| Point3::new(x.into(), y.into(), z.into()))
    };
    (-bound + 1..bound).flat_map(|x| (-bound + 1..bound).flat_map(move |y| on(x, y))).collect()
}

fn cospherical(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    // These hold 48, 96, 168, 480, 1056, 2496 and 72912 lattice points: about as many as are asked for, or fewer.
    const RADII2: [i32; 7] = [14, 41, 101, 689, 5609, 39_974, 9_999_974];
    let usable = match n {
        0..=400 => &RADII2[..5],
        401..=4000 => &RADII2[3..6],
        _ => &RADII2[6..],
    };
    let spheres: Vec<Vec<Point3>> =
        (0..draw.integer(1, 2)).map(|_| lattice_sphere(usable[draw.below(usable.len() as u32) as usize])).collect();
    let center = draw.coin().then_some(Point3::ZERO);
    let mut pick = || {
        let sphere = &spheres[draw.below(spheres.len() as u32) as usize];
        sphere[draw.below(sphere.len() as u32) as usize]
    };
    center.into_iter().chain((0..n).map(|_| pick())).take(n).collect()
}

/// A uniform direction, by rejection from the cube: divided by a rounded length, so off the sphere by roundings only.
fn rounded_sphere(draw: &mut impl Draw) -> Point3 {
    // Eight attempts miss the ball with probability 0.03%; the corner taken then is a point of the sphere as well.
    let inside = |p: &Point3| (0.01..=1.0).contains(&p.length_squared());
    let direction = (0..8).map(|_| signed_cube(draw)).find(inside).unwrap_or(Point3::ONE);
    direction / direction.length()
}

fn coplanar(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let layers = if draw.coin() { 1 } else { draw.integer(1, 3) };
    let kind = draw.below(3);
    let (o, u, v) = (small(draw, 5), small(draw, 3), small(draw, 3));
    let side = root(n, 2);
    let mut point = || {
        let layer = f64::from(draw.integer(0, layers - 1));
        match kind {
            0 => {
                let x = draw.unit();
                Point3::new(x + layer, x, draw.unit())
            }
            1 => Point3::new(draw.unit(), draw.unit(), 0.5 + layer),
            _ => {
                let (a, b) = (f64::from(draw.integer(-side, side)), f64::from(draw.integer(-side, side)));
                o + a * u + b * v + layer * Point3::new(1.0, 0.0, 0.0)
            }
        }
    };
    (0..n).map(|_| point()).collect()
}

fn collinear(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let count = if draw.coin() { 1 } else { draw.integer(1, 5) };
    let lines: Vec<(Point3, Point3)> = (0..count).map(|_| (small(draw, 7), small(draw, 7))).collect();
    let reach = n as i32;
    let mut point = || {
        let (start, step) = lines[draw.below(count as u32) as usize];
        start + f64::from(draw.integer(-reach, reach)) * step
    };
    (0..n).map(|_| point()).collect()
}

fn few(draw: &mut impl Draw) -> Vec<Point3> {
    (0..draw.below(4)).map(|_| plain(small(draw, 1))).collect()
}

fn duplicates(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let bases = [
        SpaceFamily::Random,
        SpaceFamily::Grid,
        SpaceFamily::Coplanar,
        SpaceFamily::Collinear,
        SpaceFamily::Cospherical,
    ];
    let base = distinct(places(bases[draw.below(5) as usize], n.div_ceil(3), draw));
    (0..n).filter_map(|_| base.get(draw.below(base.len() as u32) as usize).copied()).collect()
}

fn clusters(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let centers: Vec<(Point3, f64)> =
        (0..draw.integer(1, 6)).map(|_| (unit_cube(draw), two_to(-draw.integer(4, 36)))).collect();
    let mut point = || {
        let (center, size) = centers[draw.below(centers.len() as u32) as usize];
        center + size * signed_cube(draw)
    };
    (0..n).map(|_| point()).collect()
}

fn wild(draw: &mut impl Draw) -> f64 {
    let size = draw.unit() * two_to(draw.integer(-40, 40));
    if draw.coin() { -size } else { size }
}

fn moment_curve(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    // |t| < 2^17 keeps t^3 exact.
    let bound = (2 * n).min(1 << 16) as i32;
    let mut parameter = || f64::from(draw.integer(-bound, bound));
    (0..n).map(|_| parameter()).map(|t| Point3::new(t, t * t, t * t * t)).collect()
}

fn skew_lines(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    let (half, height) = (n.div_ceil(2).max(1) as i32, f64::from(draw.integer(1, 4)));
    let mut parameter = || f64::from(draw.integer(-half, half));
    let on =
        |i: usize, t: f64| if i.is_multiple_of(2) { Point3::new(t, 0.0, 0.0) } else { Point3::new(0.0, t, height) };
    (0..n).map(|i| on(i, parameter())).collect()
}

fn cylinder(n: usize, draw: &mut impl Draw) -> Vec<Point3> {
    const RADII2: [i32; 4] = [25, 325, 1105, 5525];
    let ring = circle(RADII2[draw.below(4) as usize]);
    let height = (2 * n / ring.len()).max(2) as i32;
    let mut point = || {
        let p = ring[draw.below(ring.len() as u32) as usize];
        Point3::new(p.x, p.y, f64::from(draw.integer(0, height)))
    };
    (0..n).map(|_| point()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generators::{Bytes, SplitMix64};

    fn coplanar_quadruple(w: &[Point3]) -> bool {
        let [a, b, c, d] = [w[0], w[1], w[2], w[3]].map(|p| robust::Coord3D { x: p.x, y: p.y, z: p.z });
        robust::orient3d(a, b, c, d) == 0.0
    }

    fn cospherical_quintuple(w: &[Point3]) -> bool {
        let [a, b, c, d, e] = [w[0], w[1], w[2], w[3], w[4]].map(|p| robust::Coord3D { x: p.x, y: p.y, z: p.z });
        robust::orient3d(a, b, c, d) != 0.0 && robust::insphere(a, b, c, d, e) == 0.0
    }

    #[test]
    fn places_are_distinct_and_finite() {
        for family in SpaceFamily::ALL {
            for seed in 0..60 {
                let n = seed as usize;
                let set = space_points(family, n, &mut SplitMix64(seed));
                assert!(set.len() <= n.max(3), "{family:?} {seed}: {} points for {n}", set.len());
                assert!(set.iter().all(|p| p.is_finite()));
                let repeats = matches!(family, SpaceFamily::Few | SpaceFamily::Duplicates);
                assert!(repeats || set.iter().enumerate().all(|(i, p)| !set[..i].contains(p)), "{family:?} {seed}");
                let negative_zero = |x: f64| x == 0.0 && x.is_sign_negative();
                assert!(!set.iter().any(|p| p.to_array().into_iter().any(negative_zero)), "{family:?} {seed}");
            }
        }
    }

    /// Without exact ties the families would test nothing.
    #[test]
    fn families_have_the_ties_they_promise() {
        let count = |family, size, tie: fn(&[Point3]) -> bool| {
            (0..20).filter(|&seed| space_points(family, 40, &mut SplitMix64(seed)).windows(size).any(tie)).count()
        };
        assert!(count(SpaceFamily::Cospherical, 5, cospherical_quintuple) > 10);
        assert!(count(SpaceFamily::Grid, 4, coplanar_quadruple) > 10);
        assert!(count(SpaceFamily::Coplanar, 4, coplanar_quadruple) > 15);
        assert!(count(SpaceFamily::Cylinder, 4, coplanar_quadruple) > 2);
        assert_eq!(count(SpaceFamily::Random, 4, coplanar_quadruple), 0);
    }

    /// Every dimension occurs: sets that do not span space are inputs too.
    #[test]
    fn sets_of_lower_dimension_occur() {
        let flat = |p: &[Point3]| p.len() >= 8 && p.windows(4).all(coplanar_quadruple);
        let flats = |family| (0..40).filter(|&s| flat(&space_points(family, 20, &mut SplitMix64(s)))).count();
        assert!((10..40).contains(&flats(SpaceFamily::Coplanar)));
        assert!((10..40).contains(&flats(SpaceFamily::Collinear)));
        let sizes: std::collections::BTreeSet<usize> =
            (0..40).map(|s| space_points(SpaceFamily::Few, 9, &mut SplitMix64(s)).len()).collect();
        assert_eq!(sizes.into_iter().collect::<Vec<_>>(), [0, 1, 2, 3]);
    }

    #[test]
    fn spheres_hold_all_their_lattice_points() {
        assert_eq!([1, 2, 3, 7, 14, 41, 101].map(|r2| lattice_sphere(r2).len()), [6, 12, 8, 0, 48, 96, 168]);
    }

    #[test]
    fn zeros_are_enough() {
        for family in SpaceFamily::ALL {
            assert!(space_points(family, 9, &mut Bytes(&[])).len() <= 9, "{family:?}");
        }
    }
}
