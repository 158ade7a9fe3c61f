//! The law in space, tested: the fast and the exact kernel give the same bits for every method, over the families that hurt.
//!
//! As in `arith::agreement`: `ORTHOBALL_CASES` sets the number of cases a family, `-- --nocapture` shows counts. A case has some thirty answers.

use super::kernel3::{ConstructionError, Kernel3, WeightedCorners};
use crate::arith::agreement::{Answers, Draws, Shares, bits, cases};
use crate::arith::exact::ExactKernel;
use crate::arith::fast::FastKernel;
use crate::arith::plain::PlainKernel;
use crate::arith::{round, stages};
use crate::model::{Point3, Sign, WeightedPoint};

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
            scale: if family == Family::ScaledNearDegenerate { d.power_of_two(-140, 199) } else { 1.0 },
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
    let mut compared = 0;
    for family in FAMILIES {
        let mut shares = Shares::default();
        for number in 0..cases() / 4 {
            let case = Case::new(family, number);
            stages::take();
            let (fast, exact) = (case.answers::<FastKernel>(), case.answers::<ExactKernel>());
            compared += shares.add_equal(fast, exact, || format!("{family:?} {number}: {case:?}"));
        }
        println!(
            "{family:?}: answers by running filter, by double-double, by exact integers, by integers of fixed width"
        );
        shares.print();
    }
    println!("{compared} answers compared");
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
