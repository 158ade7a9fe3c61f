//! The law, tested: the fast and the exact kernel give the same bits for every method, over the families that hurt.
//!
//! `ORTHOBALL_CASES` sets the number of cases a family (default 2,000); `-- --nocapture` shows how many answers each
//! stage of the fast kernel gave. Every case follows from (family, number) alone.

use super::exact::ExactKernel;
use super::fast::FastKernel;
use super::kernel::{Corners, Kernel};
use super::philox::philox4x32;
use super::plain::PlainKernel;
use super::stages::STAGES;
use super::{angle, round, scale, stages};
use crate::model::{Point2, Sign};
use rug::Rational;
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    Random,
    /// Collinear or cocircular, each coordinate moved by about 2^-10 to 2^-55 of it.
    NearDegenerate,
    SmallGrid,
    /// 26-bit integers: ties are common, products exceed 53 bits.
    FineGrid,
    /// Integer points of one circle, scaled by a power of two and moved.
    Cocircular,
    Collinear,
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

const FAMILIES: [Family; 12] = [
    Family::Random,
    Family::NearDegenerate,
    Family::SmallGrid,
    Family::FineGrid,
    Family::Cocircular,
    Family::Collinear,
    Family::BigOffset,
    Family::WildScales,
    Family::FarAway,
    Family::Tiny,
    Family::Extremes,
    Family::ScaledNearDegenerate,
];

/// Draws of one case.
pub(super) struct Draws {
    key: [u32; 2],
    next: u32,
}

impl Draws {
    /// The draws of a case of a family.
    pub fn of(family: u32, number: u64) -> Draws {
        Draws { key: [number as u32, (number >> 32) as u32 ^ family << 24], next: 0 }
    }
    fn word(&mut self) -> u64 {
        self.next += 1;
        let w = philox4x32(self.key, [self.next, 0, 0, 0]);
        u64::from(w[0]) << 32 | u64::from(w[1])
    }
    pub fn below(&mut self, n: u64) -> i64 {
        (self.word() % n) as i64
    }
    /// In [-1, 1), full mantissa.
    pub fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    pub fn one_of<const N: usize>(&mut self, values: [f64; N]) -> f64 {
        values[self.below(N as u64) as usize]
    }
    pub fn power_of_two(&mut self, low: i64, high: i64) -> f64 {
        scale::by_power_of_two(1.0, (low + self.below((high - low + 1) as u64)) as i32)
    }

    fn point(&mut self, family: Family, frame: &Frame) -> Point2 {
        let [x, y] = match family {
            Family::Random => [self.unit(), self.unit()],
            Family::SmallGrid => [self.below(5) as f64 / 8.0, self.below(5) as f64 / 8.0],
            Family::FineGrid => [self.below(1 << 26) as f64 / 67108864.0, self.below(1 << 26) as f64 / 67108864.0],
            Family::Cocircular | Family::NearDegenerate => {
                let [x, y] = self.on_circle(frame);
                let noise = if family == Family::Cocircular { 0.0 } else { frame.noise };
                [x + noise * self.unit(), y + noise * self.unit()]
            }
            Family::Collinear => {
                let s = self.below(9) as f64 - 4.0;
                [frame.origin.x + s * frame.step.x, frame.origin.y + s * frame.step.y]
            }
            Family::BigOffset => [0.75 + frame.noise * self.unit(), -0.6 + frame.noise * self.unit()],
            Family::WildScales => [self.unit() * self.power_of_two(-40, 40), self.unit() * self.power_of_two(-40, 40)],
            Family::Extremes => {
                [self.unit() * self.power_of_two(-141, 200), self.unit() * self.power_of_two(-141, 200)]
            }
            Family::ScaledNearDegenerate => {
                let p = self.point(Family::NearDegenerate, frame);
                [p.x * frame.scale, p.y * frame.scale]
            }
            Family::FarAway => {
                let far = if self.below(3) == 0 { self.power_of_two(0, 200) } else { 1.0 };
                [self.unit() * far, self.unit() * far]
            }
            Family::Tiny => [self.unit() * self.power_of_two(-141, 0), self.unit() * self.power_of_two(-141, 0)],
        };
        Point2::new(round::flushed(x) + 0.0, round::flushed(y) + 0.0)
    }

    /// One of the integer points of the circle of radius 65 in the frame; every second noisy frame has a line instead.
    fn on_circle(&mut self, frame: &Frame) -> [f64; 2] {
        const QUARTER: [(f64, f64); 5] = [(65.0, 0.0), (63.0, 16.0), (60.0, 25.0), (56.0, 33.0), (52.0, 39.0)];
        let (a, b) = QUARTER[self.below(5) as usize];
        let (a, b) = if self.below(2) == 0 { (a, b) } else { (b, a) };
        let (a, b) = (if self.below(2) == 0 { a } else { -a }, if self.below(2) == 0 { b } else { -b });
        let b = if frame.flat { 0.0 } else { b };
        [frame.origin.x + a * frame.size, frame.origin.y + b * frame.size]
    }
}

/// What the points of one case have in common.
struct Frame {
    origin: Point2,
    step: Point2,
    size: f64,
    noise: f64,
    flat: bool,
    scale: f64,
}

impl Frame {
    fn of(d: &mut Draws, family: Family) -> Frame {
        let integer = |d: &mut Draws| (d.below(1 << 12) - (1 << 11)) as f64 / 4096.0;
        Frame {
            origin: Point2::new(integer(d), integer(d)),
            step: Point2::new(integer(d), integer(d)),
            size: d.power_of_two(-12, -7),
            noise: d.power_of_two(-55, -10),
            flat: matches!(family, Family::NearDegenerate | Family::ScaledNearDegenerate) && d.below(2) == 0,
            scale: d.power_of_two(-140, 199),
        }
    }
}

/// A case: six points, the first three a counterclockwise triangle if `proper`, and parameters.
struct Case {
    p: [Point2; 6],
    proper: bool,
    rho2: f64,
    d2: f64,
    x: f64,
    y: f64,
    kappa: f64,
    bound: f64,
    other_bound: f64,
    cos2: f64,
}

impl Case {
    fn new(family: Family, number: u64) -> Case {
        let mut d = Draws::of(family as u32, number);
        let frame = Frame::of(&mut d, family);
        let mut p = [(); 6].map(|()| d.point(family, &frame));
        match ExactKernel::orient2d(p[0], p[1], p[2]) {
            Sign::Negative => p.swap(1, 2),
            Sign::Zero | Sign::Positive => {}
        }
        let proper = ExactKernel::orient2d(p[0], p[1], p[2]).is_positive();
        let t = [p[0], p[1], p[2]];
        let rho2 = match d.below(4) {
            0 => 1.0,
            1 => 2.0,
            2 => 1.0 + d.unit().abs() * 10.0,
            // A tie where the ratio is an f64.
            _ => (if proper { ExactKernel::ratio2(t) } else { 1.0 }).clamp(0.25, f64::MAX),
        };
        let d2 = match d.below(3) {
            0 => 1.0,
            1 => 0.5,
            _ => (1.0 - d.unit().abs()).max(1e-3),
        };
        let bound = match d.below(3) {
            // A tie where the area is an f64; positive by contract.
            0 => ExactKernel::area_ratio(t, 1.0).clamp(f64::MIN_POSITIVE, f64::MAX),
            1 => d.power_of_two(-400, 400),
            _ => (d.unit().abs() + 1e-9) * d.power_of_two(-30, 4),
        };
        let kappa = if d.below(2) == 0 { angle::kappa(rho2) } else { d.one_of([0.5, 1.0, 0.25, 1.5]) };
        let other_bound = if d.below(2) == 0 { bound } else { d.power_of_two(-20, 20) };
        let (x, y) = match d.below(3) {
            0 => (1.0, 0.0),
            1 => (-1.0, 0.0),
            _ => (d.unit(), d.unit()),
        };
        let cos2 = d.one_of([0.25, 0.75, 1.0, 0.5, 0.1]);
        Case { p, proper, rho2, d2, x, y, kappa, bound, other_bound, cos2 }
    }

    /// All answers of a kernel, named, floats as bits.
    fn answers<K: Kernel>(&self) -> Answers {
        let mut all = Answers::default();
        self.decide::<K>(&mut all);
        if self.proper {
            self.triangle::<K>(&mut all);
        }
        all
    }

    fn decide<K: Kernel>(&self, all: &mut Answers) {
        let [a, b, c, d, ..] = self.p;
        let mut say = |name, answer| all.push(name, answer);
        say("orient2d", format!("{:?}", K::orient2d(b, d, c)));
        say("in_diametral_circle", format!("{:?}", K::in_diametral_circle(a, b, c)));
        say("walk_side", format!("{:?}", K::walk_side([a, b, c], d, self.p[4])));
        say("edge_meets_diametral_disk", format!("{:?}", K::edge_meets_diametral_disk(a, b, c, d)));
        say("compare_lengths", format!("{:?}", K::compare_lengths(a, b, c, d)));
        say("compare_cos2", format!("{:?}", K::compare_cos2(a, b, c, self.cos2)));
        say("in_selection_interval", format!("{:?}", K::in_selection_interval(a, b, self.d2, c)));
        say("length2", bits(K::length2(a, b)));
        say("area_ratio", bits(K::area_ratio([a, b, c], self.bound)));
        say("exceeds_area", format!("{:?}", K::exceeds_area([a, b, c], self.bound)));
        say("midpoint", point(K::midpoint(a, b)));
        say("in_interval", point(K::in_interval(a, b, self.d2, self.x)));
        if a != b {
            let k = K::shell_exponent(a, b);
            say("shell_exponent", format!("{k}"));
            say("at_distance", point(K::at_distance(a, b, k)));
        }
    }

    fn triangle<K: Kernel>(&self, all: &mut Answers) {
        let [a, b, c, d, e, f] = self.p;
        let t = [a, b, c];
        let u = if ExactKernel::orient2d(d, e, f).is_positive() { [d, e, f] } else { [b, c, a] };
        let mut say = |name, answer| all.push(name, answer);
        say("in_circle", format!("{:?}", K::in_circle(t, d)));
        if !t.contains(&d) {
            say("in_conflict", format!("{:?}", K::in_conflict(t, d)));
        }
        say("compare_ratio", format!("{:?}", K::compare_ratio(t, u)));
        say("compare_area_ratio", format!("{:?}", K::compare_area_ratio(t, self.bound, u, self.other_bound)));
        say("compare_radius_ratio", format!("{:?}", K::compare_radius_ratio(t, self.bound, u, self.other_bound)));
        say("is_skinny", format!("{:?}", K::is_skinny(t, self.rho2)));
        say("exceeds_radius", format!("{:?}", K::exceeds_radius(t, self.bound)));
        say("in_selection_disk", format!("{:?}", K::in_selection_disk(t, self.d2, d)));
        say("ratio2", bits(K::ratio2(t)));
        say("radius_ratio2", bits(K::radius_ratio2(t, self.bound)));
        say("circumcenter", maybe_point(K::circumcenter(t)));
        say("in_disk", maybe_point(K::in_disk(t, self.d2, self.x, self.y)));
        say("offcenter", maybe_point(K::offcenter(t, self.kappa)));
        say("clamped_offcenter", maybe_point(K::clamped_offcenter(t, self.kappa, self.d2)));
        if let Ok(o) = K::circumcenter(t) {
            say("in_circle of center", format!("{:?}", K::in_circle(t, o)));
            say("in_selection_disk of center", format!("{:?}", K::in_selection_disk(t, self.d2, o)));
            say("walk_side to center", format!("{:?}", K::walk_side(t, o, b)));
        }
    }
}

/// The answers of a kernel, and beside each how many times the stages of the fast kernel were asked for it.
#[derive(Default)]
pub(super) struct Answers {
    pub values: Vec<(&'static str, String)>,
    stages: Vec<[u64; STAGES]>,
}

impl Answers {
    pub fn push(&mut self, name: &'static str, value: String) {
        self.values.push((name, value));
        self.stages.push(stages::take());
    }
}

/// How many answers of each name each stage gave.
#[derive(Default)]
pub(super) struct Shares(pub BTreeMap<&'static str, [u64; STAGES]>);

impl Shares {
    /// Asserts that all answers are equal and counts them; returns their number.
    pub fn add_equal(&mut self, fast: Answers, exact: Answers, case: impl Fn() -> String) -> u64 {
        assert_eq!(fast.values.len(), exact.values.len(), "{}", case());
        for ((f, e), counts) in fast.values.iter().zip(&exact.values).zip(&fast.stages) {
            assert_eq!(f, e, "{}", case());
            for (total, count) in self.0.entry(f.0).or_default().iter_mut().zip(counts) {
                *total += count;
            }
        }
        fast.values.len() as u64
    }

    /// Adds the counts of another family.
    pub fn add(&mut self, other: &Shares) {
        for (name, counts) in &other.0 {
            for (total, count) in self.0.entry(name).or_default().iter_mut().zip(counts) {
                *total += count;
            }
        }
    }

    pub fn print(&self) {
        for (name, counts) in self.0.iter().filter(|(_, counts)| counts[1..].iter().any(|&n| n > 0)) {
            println!("    {name}: {counts:?}");
        }
    }
}

pub(super) fn bits(x: f64) -> String {
    format!("{:016x} {x:e}", x.to_bits())
}

fn point(p: Point2) -> String {
    format!("({}, {})", bits(p.x), bits(p.y))
}

fn maybe_point(p: Result<Point2, super::OutOfRange>) -> String {
    p.map_or_else(|e| format!("{e:?}"), point)
}

pub(super) fn cases() -> u64 {
    std::env::var("ORTHOBALL_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(2_000)
}

#[test]
fn fast_and_exact_agree_to_the_bit() {
    for family in FAMILIES {
        let mut shares = Shares::default();
        for number in 0..cases() {
            let case = Case::new(family, number);
            stages::take();
            let (fast, exact) = (case.answers::<FastKernel>(), case.answers::<ExactKernel>());
            shares.add_equal(fast, exact, || format!("{family:?} {number}: {:?}", case.p));
        }
        println!(
            "{family:?}: answers by running filter, by double-double, by exact integers, by integers of fixed width"
        );
        shares.print();
    }
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

/// A polynomial in an infinitesimal, by ascending powers.
pub(super) type Infinitesimal = Vec<Rational>;

fn product(a: &Infinitesimal, b: &Infinitesimal) -> Infinitesimal {
    let mut c = vec![Rational::new(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            c[i + j] += Rational::from(x * y);
        }
    }
    c
}

pub(super) fn determinant(m: &[Vec<Infinitesimal>]) -> Infinitesimal {
    if m.len() == 1 {
        return m[0][0].clone();
    }
    let mut sum: Infinitesimal = vec![];
    for row in 0..m.len() {
        let minor: Vec<Vec<Infinitesimal>> = (0..m.len()).filter(|&r| r != row).map(|r| m[r][1..].to_vec()).collect();
        let term = product(&m[row][0], &determinant(&minor));
        sum.resize(sum.len().max(term.len()), Rational::new());
        for (s, t) in sum.iter_mut().zip(term) {
            if row % 2 == 0 { *s += t } else { *s -= t }
        }
    }
    sum
}

/// in_conflict by its definition: the sign of the lifted determinant with infinitesimals in it.
fn in_conflict_by_definition(t: Corners, q: Point2) -> bool {
    let points = [t[0], t[1], t[2], q];
    let rows: Vec<Vec<Infinitesimal>> = points
        .iter()
        .map(|p| {
            let above = points.iter().filter(|o| (o.x, o.y) > (p.x, p.y)).count();
            let (x, y) = (Rational::from_f64(p.x).unwrap(), Rational::from_f64(p.y).unwrap());
            let mut lift = vec![Rational::new(); above + 2];
            lift[0] = x.clone().square() + y.clone().square();
            lift[above + 1] = Rational::from(1);
            vec![vec![x], vec![y], lift, vec![Rational::from(1)]]
        })
        .collect();
    let det = determinant(&rows);
    det.into_iter().find(|c| *c != 0).is_some_and(|c| c > 0)
}

#[test]
fn conflicts_are_those_of_the_perturbed_lift() {
    let mut ties = 0;
    for family in FAMILIES {
        for number in 0..cases() / 4 {
            let case = Case::new(family, number);
            let [a, b, c, q, ..] = case.p;
            let t = [a, b, c];
            if case.proper && !t.contains(&q) {
                ties += u32::from(FastKernel::in_circle(t, q) == Sign::Zero);
                assert_eq!(
                    FastKernel::in_conflict(t, q),
                    in_conflict_by_definition(t, q),
                    "{family:?} {number}: {:?}",
                    case.p
                );
            }
        }
    }
    assert!(ties > 100, "only {ties} ties met");
}
