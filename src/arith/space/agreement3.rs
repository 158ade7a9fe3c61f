//! The law in space, tested: the fast and the exact kernel give the same bits for every method, over the families that hurt.
//!
//! As in `arith::agreement`: `ORTHOBALL_CASES` sets the number of cases a family, `-- --nocapture` shows counts. A case has some thirty answers.

use super::kernel3::{ConstructionError, Kernel3, WeightedCorners};
use super::{filter3, fixed3, poly3};
use crate::arith::agreement::{Answers, Draws, Infinitesimal, Shares, bits, cases, determinant};
use crate::arith::exact::ExactKernel;
use crate::arith::fast::FastKernel;
use crate::arith::plain::PlainKernel;
use crate::arith::{Dyadic, round, stages};
use crate::model::{Point3, Sign, WeightedPoint};
use rug::Rational;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    Random,
    /// Coplanar or cospherical, each coordinate moved by about 2^-10 to 2^-55 of it.
    NearDegenerate,
    SmallGrid,
    /// 26-bit integers: ties are common, products exceed 53 bits.
    FineGrid,
    /// Integer points of one sphere, scaled by a power of two and moved.
    Cospherical,
    Coplanar,
    /// As a mesher meets them: neighbours in the unit cube, full mantissas.
    SmallSimplex,
    BigOffset,
    WildScales,
    /// Among points of a domain, points as far out as constructions may go.
    FarAway,
    /// Down to 2^-142, the least nonzero coordinate.
    Tiny,
    /// From 2^-142 to 2^200 in one case.
    Extremes,
    /// Near ties, all scaled alike: the ends of the range with every bit in use, where a stage would lie by underflow.
    ScaledNearDegenerate,
}

const FAMILIES: [Family; 13] = [
    Family::Random,
    Family::NearDegenerate,
    Family::SmallGrid,
    Family::FineGrid,
    Family::Cospherical,
    Family::Coplanar,
    Family::SmallSimplex,
    Family::BigOffset,
    Family::WildScales,
    Family::FarAway,
    Family::Tiny,
    Family::Extremes,
    Family::ScaledNearDegenerate,
];

/// What the points of one case have in common.
struct Frame {
    family: Family,
    origin: Point3,
    steps: [Point3; 2],
    size: f64,
    noise: f64,
    flat: bool,
    scale: f64,
    weights: i64,
}

impl Frame {
    fn of(d: &mut Draws, family: Family) -> Frame {
        let mut integer = || (d.below(1 << 12) - (1 << 11)) as f64 / 4096.0;
        let mut vector = || Point3::new(integer(), integer(), integer());
        let (origin, steps) = (vector(), [vector(), vector()]);
        Frame {
            family,
            origin,
            steps,
            size: d.power_of_two(-12, -4),
            noise: d.power_of_two(-55, -10),
            flat: matches!(family, Family::NearDegenerate | Family::ScaledNearDegenerate) && d.below(2) == 0,
            scale: if family == Family::ScaledNearDegenerate { d.power_of_two(-140, 197) } else { 1.0 },
            weights: d.below(5),
        }
    }

    fn point(&self, d: &mut Draws) -> Point3 {
        let mut each = |f: &mut dyn FnMut(&mut Draws) -> f64| Point3::new(f(d), f(d), f(d));
        let p = match self.family {
            Family::Random => each(&mut |d| d.unit()),
            Family::SmallGrid => each(&mut |d| d.below(5) as f64 / 8.0),
            Family::FineGrid => each(&mut |d| d.below(1 << 26) as f64 / 67108864.0),
            Family::SmallSimplex => self.origin + self.size * each(&mut |d| d.unit()),
            Family::BigOffset => Point3::new(0.75, -0.6, 0.51) + self.noise * each(&mut |d| d.unit()),
            Family::WildScales => each(&mut |d| d.unit() * d.power_of_two(-40, 40)),
            Family::Extremes => each(&mut |d| d.unit() * d.power_of_two(-141, 199)),
            Family::Tiny => each(&mut |d| d.unit() * d.power_of_two(-141, 0)),
            Family::FarAway => {
                let far = if d.below(3) == 0 { d.power_of_two(0, 199) } else { 1.0 };
                Point3::new(d.unit(), d.unit(), d.unit()) * far
            }
            Family::Cospherical => self.on_sphere(d),
            Family::Coplanar => self.on_plane(d),
            Family::NearDegenerate | Family::ScaledNearDegenerate => {
                let p = if self.flat { self.on_plane(d) } else { self.on_sphere(d) };
                (p + self.noise * Point3::new(d.unit(), d.unit(), d.unit())) * self.scale
            }
        };
        Point3::from_array(p.to_array().map(|x| round::flushed(x) + 0.0))
    }

    fn on_plane(&self, d: &mut Draws) -> Point3 {
        let mut step = || d.below(9) as f64 - 4.0;
        self.origin + step() * self.steps[0] + step() * self.steps[1]
    }

    /// An integer point of the sphere of radius 9 in the frame.
    fn on_sphere(&self, d: &mut Draws) -> Point3 {
        const POINTS: [[f64; 3]; 4] = [[9.0, 0.0, 0.0], [8.0, 4.0, 1.0], [7.0, 4.0, 4.0], [6.0, 6.0, 3.0]];
        let mut p = POINTS[d.below(4) as usize];
        p.rotate_left(d.below(3) as usize);
        if d.below(2) == 0 {
            p.swap(0, 1);
        }
        let p = p.map(|x| if d.below(2) == 0 { x } else { -x });
        self.origin + self.size * Point3::from_array(p)
    }

    /// Weights that hide nothing much: squares of short radii, integers on a grid, or any bits, of the size of squared distances.
    fn weight(&self, d: &mut Draws) -> f64 {
        let w = match (self.family, self.weights) {
            (_, 0) => 0.0,
            (Family::SmallGrid, _) => d.below(4) as f64 / 64.0,
            (Family::FineGrid, _) => (d.below(1 << 20) << 30) as f64 / (1u64 << 52) as f64,
            (_, 1) => self.scale * self.scale / 4.0,
            (Family::Cospherical | Family::Coplanar, 2) => d.below(3) as f64 * self.size * self.size,
            (Family::Extremes, _) => d.unit() * d.power_of_two(-283, 398),
            (Family::FarAway, 2) => d.unit() * d.power_of_two(0, 398),
            (_, 2) => {
                let radius = d.below(1 << 26) as f64 / 67108864.0 * self.size * self.scale;
                radius * radius
            }
            (_, 3) => d.unit() * self.noise * self.scale * self.scale,
            _ => d.unit() * self.size * self.size * self.scale * self.scale,
        };
        if w.abs() < f64::from_bits((1023 - 284) << 52) { 0.0 } else { w }
    }
}

/// A case: eight weighted points, the first four a positively oriented tetrahedron if `proper`, and parameters.
#[derive(Debug)]
struct Case {
    p: [WeightedPoint; 8],
    proper: bool,
    rho2: f64,
    bound: f64,
    fraction: f64,
    radius: f64,
    scale: f64,
    direction: Point3,
}

fn bare<const N: usize>(t: [WeightedPoint; N]) -> [Point3; N] {
    t.map(|p| p.at)
}

/// The four points in an order that makes them a positively oriented tetrahedron, if there is one.
fn oriented(mut t: WeightedCorners) -> Option<WeightedCorners> {
    let [a, b, c, d] = bare(t);
    match ExactKernel::orient3d(a, b, c, d) {
        Sign::Zero => None,
        Sign::Positive => Some(t),
        Sign::Negative => {
            t.swap(1, 2);
            Some(t)
        }
    }
}

impl Case {
    fn new(family: Family, number: u64) -> Case {
        let mut d = Draws::of(0x30 + family as u32, number);
        let frame = Frame::of(&mut d, family);
        let mut p = [(); 8].map(|()| WeightedPoint { at: frame.point(&mut d), weight: frame.weight(&mut d) });
        let first = oriented([p[0], p[1], p[2], p[3]]);
        if let Some(t) = first {
            p[..4].copy_from_slice(&t);
        }
        let d = &mut d;
        let radius2 = first.and_then(|t| ExactKernel::circumradius(bare(t)).ok()).unwrap_or(1.0);
        // A tie where the square is an f64.
        let bound = [radius2 * radius2, d.power_of_two(-280, 390), d.unit().abs()][d.below(3) as usize];
        let rho2 = match d.below(3) {
            0 => d.one_of([0.375, 0.5, 1.0, 2.0, 4.0]),
            1 => 1.0 + d.unit().abs() * 10.0,
            _ => bound.clamp(1e-30, 1e30),
        };
        let fraction = [0.0, 1.0, 0.5, 0.25, 0.1, d.unit().abs()][d.below(6) as usize];
        let radius = match d.below(4) {
            0 => ExactKernel::distance(p[4].at, p[0].at),
            1 => radius2,
            2 => d.unit().abs() * frame.size * frame.scale,
            _ => ExactKernel::distance(p[4].at, ExactKernel::midpoint3(p[0].at, p[1].at)),
        };
        let scale = [1.0, 0.5, 1.0 / 3.0, d.unit().abs(), d.power_of_two(-100, 100)][d.below(5) as usize];
        let direction = match d.below(3) {
            0 => Point3::Z,
            1 => frame.point(d),
            _ => Point3::new(d.unit(), d.unit(), d.unit()),
        };
        Case { p, proper: first.is_some(), rho2, bound, fraction, radius, scale, direction }
    }

    /// All answers of a kernel, named, floats as bits.
    fn answers<K: Kernel3>(&self) -> Answers {
        let mut all = Answers::default();
        self.of_points::<K>(&mut all);
        self.of_triangles::<K>(&mut all);
        if self.proper {
            self.of_tetrahedra::<K>(&mut all);
        }
        all
    }

    fn of_points<K: Kernel3>(&self, all: &mut Answers) {
        let [p, q, r, s, x, ..] = self.p;
        let [a, b, c, d, e] = bare([p, q, r, s, x]);
        let mut say = |name, answer| all.push(name, answer);
        say("orient3d", format!("{:?}", K::orient3d(b, d, c, a)));
        say("orient3d of others", format!("{:?}", K::orient3d(b, e, c, a)));
        say("in_diametral_ball", format!("{:?}", K::in_diametral_ball(a, b, c)));
        say("compare_lengths3", format!("{:?}", K::compare_lengths3(a, b, c, d)));
        say("compare_power_distances", format!("{:?}", K::compare_power_distances(a, q, r)));
        say("midpoint3", point(K::midpoint3(a, b)));
        let between = K::at_fraction3(a, b, self.fraction);
        say("at_fraction3", point(between));
        say("distance", bits(K::distance(a, b)));
        say("distance to it", bits(K::distance(a, between)));
        // Ties that are none in double-double: the same squares added in another order.
        let turned = |p: Point3| Point3::new(p.y, p.z, p.x);
        let flat = [Point3::ZERO, Point3::new(a.x, a.y, 0.0), Point3::new(0.0 - a.y, a.x, 0.0)];
        say("compare_lengths3 of equals", format!("{:?}", K::compare_lengths3(a, b, turned(a), turned(b))));
        say("in_diametral_ball of a tie", format!("{:?}", K::in_diametral_ball(a, Point3::ZERO - a, turned(a))));
        if flat[0] != flat[1] {
            let order = K::compare_radius_edge_of_triangle(flat, 0.5);
            say("compare_radius_edge_of_triangle of a tie", format!("{order:?}"));
        }
        if a != b {
            say("power_side_of_edge", format!("{:?}", K::power_side_of_edge(p, q, r)));
            say("short_radius_below", bits(K::short_radius_below(a, b, self.scale)));
            say("short_radius_above", bits(K::short_radius_above(a, b, self.scale)));
            let found = K::sphere_meets_segment(e, self.radius, a, b);
            say("sphere_meets_segment", format!("{:?}", found.map(|p| p.map(point))));
        }
    }

    fn of_triangles<K: Kernel3>(&self, all: &mut Answers) {
        let [p, q, r, s, x, ..] = self.p;
        let t = [p, q, r];
        let [a, b, c, d, e] = bare([p, q, r, s, x]);
        let mut say = |name, answer| all.push(name, answer);
        let center = K::orthocenter_of_triangle(t);
        say("orthocenter_of_triangle", maybe_point(center));
        say("normal_side", format!("{:?}", K::normal_side([a, b, c], [d, b, e])));
        say("dual_line_meets_plane", maybe_point(K::dual_line_meets_plane(t, d, self.direction)));
        if center != Err(ConstructionError::Degenerate) {
            say("power_side_of_triangle", format!("{:?}", K::power_side_of_triangle(t, s)));
            say("in_equatorial_ball", format!("{:?}", K::in_equatorial_ball(a, b, c, e)));
            say(
                "compare_radius_edge_of_triangle",
                format!("{:?}", K::compare_radius_edge_of_triangle(bare(t), self.rho2)),
            );
        }
        if let Ok(o) = center {
            say("orient3d of it", format!("{:?}", K::orient3d(a, b, c, o)));
        }
    }

    fn of_tetrahedra<K: Kernel3>(&self, all: &mut Answers) {
        let [p, q, r, s, x, f, g, h] = self.p;
        let t = [p, q, r, s];
        let u = oriented([x, f, g, h]).unwrap_or([q, r, p, s]);
        let mut say = |name, answer| all.push(name, answer);
        say("in_sphere", format!("{:?}", K::in_sphere(bare(t), x.at)));
        for (name, q) in [("power_side", x), ("power_side of another", f)] {
            say(name, format!("{:?}", K::power_side(t, q)));
        }
        if !t.contains(&x) {
            say("in_conflict3", format!("{:?}", K::in_conflict3(t, x)));
        }
        say("compare_orthoradius2", format!("{:?}", K::compare_orthoradius2(t, self.bound)));
        say("compare_orthoradii", format!("{:?}", K::compare_orthoradii(t, u)));
        say("compare_orthoradii of itself", format!("{:?}", K::compare_orthoradii(t, [r, p, q, s])));
        say("compare_radius_edge", format!("{:?}", K::compare_radius_edge(bare(t), self.rho2)));
        say("orthocenter_side", format!("{:?}", K::orthocenter_side(t, bare([x, f, g]))));
        say("circumradius", maybe(K::circumradius(bare(t)), bits));
        let center = K::orthocenter(t);
        say("orthocenter", maybe_point(center));
        if let Ok(o) = center {
            // What a construction gives is what decisions are taken on.
            let o = WeightedPoint::unweighted(o);
            say("power_side of it", format!("{:?}", K::power_side(t, o)));
            say("in_sphere of it", format!("{:?}", K::in_sphere(bare(t), o.at)));
            say("orient3d with it", format!("{:?}", K::orient3d(p.at, q.at, r.at, o.at)));
        }
    }
}

fn point(p: Point3) -> String {
    format!("({}, {}, {})", bits(p.x), bits(p.y), bits(p.z))
}

fn maybe<T>(value: Result<T, ConstructionError>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|e| format!("{e:?}"), show)
}

fn maybe_point(p: Result<Point3, ConstructionError>) -> String {
    maybe(p, point)
}

#[test]
fn fast_and_exact_agree_to_the_bit() {
    let one = |family: Family| {
        let (mut compared, mut shares) = (0, Shares::default());
        for number in 0..cases() / 4 {
            let case = Case::new(family, number);
            stages::take();
            let (fast, exact) = (case.answers::<FastKernel>(), case.answers::<ExactKernel>());
            compared += shares.add_equal(fast, exact, || format!("{family:?} {number}: {case:?}"));
        }
        (compared, shares)
    };
    let counts = std::thread::scope(|scope| {
        let running = FAMILIES.map(|family| scope.spawn(move || one(family)));
        running.map(|family| family.join().expect("no disagreement"))
    });
    let (mut compared, mut all) = (0, Shares::default());
    for (family, (n, shares)) in FAMILIES.iter().zip(counts) {
        println!(
            "{family:?}: answers by running filter, by double-double, by exact integers, by integers of fixed width"
        );
        shares.print();
        all.add(&shares);
        compared += n;
    }
    println!("{compared} answers compared");
    every_stage_is_reached(&all);
}

/// Each stage of each method answered something; inlined filters and the double-doubles of constructions are not counted.
fn every_stage_is_reached(all: &Shares) {
    for (name, stages) in [
        ("orient3d", &[1, 2, 3][..]),
        ("in_sphere", &[1, 2, 3]),
        ("power_side", &[1, 2, 3]),
        ("power_side_of_triangle", &[0, 1, 2]),
        ("power_side_of_edge", &[0, 1, 2]),
        ("in_diametral_ball", &[0, 1]),
        ("in_diametral_ball of a tie", &[1, 2]),
        ("in_equatorial_ball", &[0, 1, 2]),
        ("compare_lengths3", &[0, 1]),
        ("compare_lengths3 of equals", &[1, 2]),
        ("compare_power_distances", &[0, 1, 2]),
        ("compare_orthoradius2", &[0, 1, 2]),
        ("compare_orthoradii", &[0, 1, 2]),
        ("compare_radius_edge", &[0, 1, 2]),
        ("compare_radius_edge_of_triangle", &[0, 1]),
        ("compare_radius_edge_of_triangle of a tie", &[1, 2]),
        ("orthocenter_side", &[0, 1, 2]),
        ("normal_side", &[0, 1]),
        ("at_fraction3", &[2]),
        ("orthocenter", &[2]),
        ("orthocenter_of_triangle", &[2]),
        ("dual_line_meets_plane", &[2]),
        ("sphere_meets_segment", &[0, 1, 2]),
        ("distance", &[2]),
        ("circumradius", &[2]),
        ("short_radius_below", &[0, 1]),
    ] {
        for &stage in stages {
            assert!(all.0[name][stage] > 0, "{name} never came to stage {stage}: {:?}", all.0[name]);
        }
    }
}

/// The inlined filters answer nearly all of what is random, and nothing that is zero.
#[test]
fn filters_answer() {
    let (mut asked, mut answered) = (0, [0; 3]);
    for number in 0..500 {
        let case = Case::new(Family::Random, number);
        let [p, q, r, s, x, ..] = case.p;
        let t = [p, q, r, s];
        asked += 1;
        answered[0] += u32::from(filter3::orient3d(q.at, r.at, s.at, x.at).is_some());
        answered[1] += u32::from(filter3::in_sphere(bare(t), x.at).is_some());
        answered[2] += u32::from(filter3::power_side(t, x).is_some());
        assert_eq!(filter3::orient3d(p.at, q.at, r.at, p.at), None);
        assert_eq!(filter3::in_sphere(bare(t), q.at), None);
    }
    assert!(answered.into_iter().all(|n| n > asked * 99 / 100), "{answered:?} of {asked}");
}

/// What an estimate is certain of is so; where it calls a value on a grid exact, it is.
#[test]
fn estimates_are_certain_within_their_bounds() {
    let certain = |value: f64, bound: f64| match bound {
        0.0 if value == 0.0 => Some(Sign::Zero),
        _ if value.abs() > bound => Some(if value > 0.0 { Sign::Positive } else { Sign::Negative }),
        _ => None,
    };
    let (mut asked, mut answered, mut ties) = (0, [0; 2], 0);
    for family in FAMILIES {
        for number in 0..cases() / 4 {
            let case = Case::new(family, number);
            let [p, q, r, s, x, ..] = case.p;
            let t = [p, q, r, s];
            // The unit of the small grid is 1/8, and the weights on it are multiples of 1/64.
            let exact_below = if family == Family::SmallGrid { 16384.0 } else { 0.0 };
            let (value, bound) = FastKernel::power_side_estimate(t, x, exact_below);
            asked += 1;
            if let Some(sign) = certain(value, bound).filter(|_| case.proper) {
                answered[0] += 1;
                ties += u32::from(sign == Sign::Zero);
                assert_eq!(sign, ExactKernel::power_side(t, x), "{family:?} {number}: {t:?} {x:?}");
            }
            let (values, bound) = FastKernel::orient3d_estimates(bare(t), x.at);
            for (k, value) in values.into_iter().enumerate() {
                let mut replaced = bare(t);
                replaced[k] = x.at;
                let [a, b, c, d] = replaced;
                if let Some(sign) = certain(value, bound).filter(|_| bound > 0.0) {
                    answered[1] += 1;
                    assert_eq!(sign, ExactKernel::orient3d(a, b, c, d), "{family:?} {number}: {t:?} {x:?}");
                }
            }
        }
    }
    assert!(answered[0] > asked / 4 && answered[1] > asked && ties > 5, "{answered:?} of {asked}, {ties} ties");
}

/// Integers of fixed width keep their promise up to the last bit: components, lifts and weights as large as they may be, all signs.
#[test]
fn fixed_widths_suffice() {
    let mut answered = [0; 3];
    for number in 0..cases() {
        let mut d = Draws::of(0x60, number);
        let small = number % 2 == 0;
        // Integers of 24 bits about 0; or about -1 (or 1), so that differences have 62 bits in two pieces, the last one set or not.
        let side = Point3::new(d.one_of([-1.0, 1.0]), d.one_of([-1.0, 1.0]), d.one_of([-1.0, 1.0]));
        let base = if small { Point3::ZERO } else { -side };
        let greatest = if small { ((1 << 24) - 1) as f64 } else { 1.0f64.next_down() };
        let others =
            if small { [1.0, greatest - 1.0, -greatest] } else { [0.5f64.powi(61), greatest.next_down(), -1.0] };
        let coordinate = |d: &mut Draws| match d.below(6) {
            0 => 0.0,
            1..=3 => d.one_of(others),
            _ => greatest,
        };
        let place = |d: &mut Draws| Point3::new(coordinate(d), coordinate(d), coordinate(d)) * side;
        let weight = |d: &mut Draws| d.one_of([0.0, 1.0, -1.0]) * if small { ((1u64 << 48) - 1) as f64 } else { 15.0 };
        let p = [(); 4].map(|()| WeightedPoint { at: place(&mut d), weight: weight(&mut d) });
        let q = WeightedPoint { at: base, weight: 0.0 };
        let t = bare(p);
        let exact = poly3::power_side::<Dyadic>(poly3::unweighted(t), WeightedPoint::unweighted(q.at)).sign();
        for (k, (fixed, exact)) in [
            (fixed3::orient3d(q.at, t[0], t[1], t[2]), poly3::orient3d::<Dyadic>(q.at, t[0], t[1], t[2]).sign()),
            (fixed3::in_sphere(t, q.at), exact),
            (fixed3::power_side(p, q), poly3::power_side::<Dyadic>(p, q).sign()),
        ]
        .into_iter()
        .enumerate()
        {
            if let Some(fixed) = fixed {
                answered[k] += 1;
                assert_eq!(fixed, exact, "{p:?}");
            }
        }
    }
    assert!(answered.into_iter().all(|n| n > cases() / 2), "{answered:?}");
}

/// in_conflict3 by its definition: the sign of the lifted determinant with infinitesimals in it.
fn in_conflict_by_definition(t: WeightedCorners, q: WeightedPoint) -> bool {
    let points = [t[0], t[1], t[2], t[3], q];
    let rows: Vec<Vec<Infinitesimal>> = points
        .iter()
        .map(|p| {
            let above = points.iter().filter(|o| o.at.to_array() > p.at.to_array()).count();
            let place = p.at.to_array().map(|x| Rational::from_f64(x).unwrap());
            let mut lift = vec![Rational::new(); above + 2];
            lift[0] =
                place.iter().map(|x| x.clone().square()).sum::<Rational>() - Rational::from_f64(p.weight).unwrap();
            lift[above + 1] = Rational::from(1);
            let [x, y, z] = place.map(|x| vec![x]);
            vec![x, y, z, lift, vec![Rational::from(1)]]
        })
        .collect();
    determinant(&rows).into_iter().find(|c| *c != 0).is_some_and(|c| c < 0)
}

#[test]
fn conflicts_are_those_of_the_perturbed_lift() {
    let mut ties = 0;
    for family in FAMILIES {
        for number in 0..cases() / 8 {
            let case = Case::new(family, number);
            let [p, q, r, s, x, ..] = case.p;
            let t = [p, q, r, s];
            if case.proper && !t.contains(&x) {
                ties += u32::from(FastKernel::power_side(t, x) == Sign::Zero);
                assert_eq!(
                    FastKernel::in_conflict3(t, x),
                    in_conflict_by_definition(t, x),
                    "{family:?} {number}: {t:?} {x:?}"
                );
            }
        }
    }
    println!("{ties} ties");
    assert!(ties > 50, "only {ties} ties met");
}

/// The comparison can fail: the control's constructions differ in every family that has rounded results.
#[test]
fn the_plain_kernel_is_found_out() {
    for family in [Family::Random, Family::NearDegenerate, Family::BigOffset, Family::WildScales, Family::FarAway] {
        let differs = (0..50).filter(|&n| {
            let case = Case::new(family, n);
            case.answers::<PlainKernel>().values != case.answers::<ExactKernel>().values
        });
        assert!(differs.count() > 20, "{family:?}");
    }
}
