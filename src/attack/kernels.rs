//! The law of two kernels: the same answer to every call, bit for bit.

use super::answer::{Answers, assert_equal};
use crate::arith::{Corners, ExactKernel, FastKernel, Kernel, angle, scale};
use crate::domain::{GREATEST_COORDINATE, LEAST_COORDINATE};
use crate::generators::{Bytes, Draw};
use crate::model::Point2;
use arbitrary::{Arbitrary, Result, Unstructured};

/// Six points and the parameters of the kernel's methods, all within its contract.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelCase {
    /// The points; the first three do not turn clockwise.
    pub points: [Point2; 6],
    /// Square of the quality bound.
    pub rho2: f64,
    /// delta1, delta2 or mu.
    pub delta: f64,
    /// Place in an interval or a disk, each in [-1, 1].
    pub place: [f64; 2],
    /// Height of the off-center over its edge.
    pub kappa: f64,
    /// Bounds on area or radius.
    pub bounds: [f64; 2],
    /// Bound on a squared cosine.
    pub cos2: f64,
}

impl KernelCase {
    /// Asserts that the fast kernel answers as the exact one.
    pub fn run(&self) {
        assert_equal(&self.answers::<FastKernel>(), &self.answers::<ExactKernel>(), self);
    }

    /// All answers of a kernel.
    fn answers<K: Kernel>(&self) -> Answers {
        let mut all = Answers::new();
        self.of_points::<K>(&mut all);
        let [a, b, c, d, e, f] = self.points;
        if K::orient2d(a, b, c).is_positive() {
            let other = if K::orient2d(d, e, f).is_positive() { [d, e, f] } else { [c, a, b] };
            self.of_triangles::<K>([a, b, c], other, &mut all);
        }
        all
    }

    /// Methods that take any points.
    fn of_points<K: Kernel>(&self, all: &mut Answers) {
        let [a, b, c, d, e, _] = self.points;
        let delta = self.delta;
        all.extend([
            ("orient2d", K::orient2d(b, d, c).into()),
            ("in_diametral_circle", K::in_diametral_circle(a, b, d).into()),
            ("walk_side", K::walk_side([a, b, c], d, e).into()),
            ("edge_meets_diametral_disk", K::edge_meets_diametral_disk(a, b, c, d).into()),
            ("compare_lengths", K::compare_lengths(a, b, c, d).into()),
            ("compare_cos2", K::compare_cos2(a, b, c, self.cos2).into()),
            ("in_selection_interval", K::in_selection_interval(a, b, delta, d).into()),
            ("length2", K::length2(a, d).into()),
            ("midpoint", K::midpoint(a, d).into()),
            ("in_interval", K::in_interval(a, d, delta, self.place[0]).into()),
        ]);
        if a != b {
            let k = K::shell_exponent(a, b);
            let p = K::in_interval(a, b, delta, self.place[0]);
            all.extend([
                ("shell_exponent", k.into()),
                ("at_distance", K::at_distance(a, b, k).into()),
                ("in_selection_interval of its point", K::in_selection_interval(a, b, delta, p).into()),
                ("orient2d of a point on an edge", K::orient2d(a, b, p).into()),
            ]);
        }
    }

    /// Methods that take counterclockwise triangles.
    fn of_triangles<K: Kernel>(&self, t: Corners, u: Corners, all: &mut Answers) {
        let [.., d, e, _] = self.points;
        let [bound, other] = self.bounds;
        let (delta, [x, y]) = (self.delta, self.place);
        all.extend([
            ("in_circle", K::in_circle(t, d).into()),
            ("compare_ratio", K::compare_ratio(t, u).into()),
            ("compare_area_ratio", K::compare_area_ratio(t, bound, u, other).into()),
            ("compare_radius_ratio", K::compare_radius_ratio(t, bound, u, other).into()),
            ("is_skinny", K::is_skinny(t, self.rho2).into()),
            ("exceeds_area", K::exceeds_area(t, bound).into()),
            ("exceeds_radius", K::exceeds_radius(t, bound).into()),
            ("in_selection_disk", K::in_selection_disk(t, delta, d).into()),
            ("ratio2", K::ratio2(t).into()),
            ("area_ratio", K::area_ratio(t, bound).into()),
            ("radius_ratio2", K::radius_ratio2(t, bound).into()),
        ]);
        if !t.contains(&d) {
            all.push(("in_conflict", K::in_conflict(t, d).into()));
        }
        let shortest = shortest_first::<K>(t);
        for (name, made) in [
            ("circumcenter", K::circumcenter(t)),
            ("in_disk", K::in_disk(t, delta, x, y)),
            ("offcenter", K::offcenter(shortest, self.kappa)),
            ("clamped_offcenter", K::clamped_offcenter(shortest, self.kappa, delta)),
        ] {
            all.push((name, made.into()));
            // What a construction gives is what decisions are taken on.
            if let Ok(p) = made {
                all.extend([
                    ("in_circle of it", K::in_circle(t, p).into()),
                    ("in_selection_disk of it", K::in_selection_disk(t, delta, p).into()),
                    ("walk_side to it", K::walk_side(t, p, e).into()),
                    ("orient2d with it", K::orient2d(t[0], t[1], p).into()),
                ]);
            }
        }
    }
}

/// The triangle turned so that its shortest edge comes first.
fn shortest_first<K: Kernel>(t: Corners) -> Corners {
    let mut best = t;
    for turned in [[t[1], t[2], t[0]], [t[2], t[0], t[1]]] {
        if K::compare_lengths(turned[0], turned[1], best[0], best[1]).is_lt() {
            best = turned;
        }
    }
    best
}

/// A coordinate as the contract wants it: 0, or of magnitude 2^-142 to 2^200; no -0.
pub(super) fn fitted(x: f64) -> f64 {
    let greatest = scale::by_power_of_two(1.0, GREATEST_COORDINATE);
    let least = scale::by_power_of_two(1.0, LEAST_COORDINATE);
    match x.abs() {
        m if m >= least => x.clamp(-greatest, greatest),
        _ => 0.0,
    }
}

/// x moved by some units in the last place.
pub(super) fn moved(x: f64, ulps: i32) -> f64 {
    let step = if ulps < 0 { f64::next_down } else { f64::next_up };
    (0..ulps.abs()).fold(x, |x, _| step(x))
}

/// A point in some relation to those before it, which makes for ties and near-ties.
pub(super) fn point(draw: &mut impl Draw, before: &[Point2]) -> Point2 {
    let coarse = |draw: &mut dyn FnMut() -> i32| f64::from(draw()) / 8.0;
    let kind = draw.below(if before.len() < 2 { 4 } else { 9 });
    let one = |draw: &mut _| one_of(draw, before);
    let p = match kind {
        0 => Point2::new(coarse(&mut || draw.integer(-5, 5)), coarse(&mut || draw.integer(-5, 5))),
        1 => Point2::new(draw.signed_unit(), draw.signed_unit()),
        2 => {
            let (e, f) = (draw.integer(-141, 200), draw.integer(-141, 200));
            Point2::new(
                draw.signed_unit() * scale::by_power_of_two(1.0, e),
                draw.signed_unit() * scale::by_power_of_two(1.0, f),
            )
        }
        // A lattice point of the circle of radius 65.
        3 => {
            let [x, y] = [[65, 0], [63, 16], [60, 25], [56, 33], [52, 39]][draw.below(5) as usize];
            let [x, y] = if draw.coin() { [x, y] } else { [y, x] };
            let sign = |s: bool| if s { 1.0 } else { -1.0 };
            Point2::new(sign(draw.coin()) * f64::from(x), sign(draw.coin()) * f64::from(y)) / 128.0
        }
        // Beside an earlier one.
        4 => {
            let p = one(draw);
            Point2::new(moved(p.x, draw.integer(-4, 4)), moved(p.y, draw.integer(-4, 4)))
        }
        // On the line of two, up to rounding.
        5 => {
            let (p, q) = (one(draw), one(draw));
            p + (q - p) * (f64::from(draw.integer(-8, 16)) / 8.0)
        }
        // At the same distance from one as another.
        6 => {
            let (o, p) = (one(draw), one(draw));
            o + (p - o).perp()
        }
        // On the circle of three, up to rounding, or its center.
        7 => {
            let [p, q, r] = [one(draw), one(draw), one(draw)];
            let center = if FastKernel::orient2d(p, q, r).is_positive() {
                FastKernel::circumcenter([p, q, r]).unwrap_or(p)
            } else {
                FastKernel::midpoint(p, q)
            };
            match draw.below(3) {
                0 => center,
                1 => center + (center - p),
                _ => center + (p - center).perp(),
            }
        }
        // A coordinate of one, a coordinate of another.
        _ => Point2::new(one(draw).x, one(draw).y),
    };
    Point2::new(fitted(p.x) + 0.0, fitted(p.y) + 0.0)
}

fn one_of(draw: &mut impl Draw, before: &[Point2]) -> Point2 {
    before[draw.below(before.len() as u32) as usize]
}

impl<'a> Arbitrary<'a> for KernelCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let draw = &mut Bytes(u.bytes(u.len())?);
        let mut list: Vec<Point2> = Vec::new();
        for _ in 0..6 {
            list.push(point(draw, &list));
        }
        if ExactKernel::orient2d(list[0], list[1], list[2]).is_negative() {
            list.swap(1, 2);
        }
        let points: [Point2; 6] = std::array::from_fn(|k| list[k]);
        let t = [points[0], points[1], points[2]];
        let proper = ExactKernel::orient2d(t[0], t[1], t[2]).is_positive();
        let power =
            |draw: &mut Bytes, low, high| scale::by_power_of_two(1.0, draw.integer(low, high)) * (1.0 + draw.unit());
        let rho2 = match draw.below(4) {
            0 => 1.0,
            // A tie, or a rounding beside it.
            1 if proper => ExactKernel::ratio2(t),
            2 => power(draw, -1, 99),
            _ => 1.0 + f64::from(draw.below(16)) / 8.0,
        };
        let mut bound = || match draw.below(4) {
            0 => 1.0,
            1 if proper => ExactKernel::area_ratio(t, 1.0),
            2 if proper => ExactKernel::radius_ratio2(t, 1.0).sqrt(),
            _ => power(draw, -399, 398),
        };
        // What `refine` lets pass: areas and sizes within 2^-400..2^400 in normalised units.
        let window = scale::by_power_of_two(1.0, 400);
        let bounds = [bound(), bound()].map(|b| b.clamp(1.0 / window, window));
        let rho2 = rho2.clamp(0.34, 1e30);
        let mut delta = || match draw.below(3) {
            0 => 1.0,
            1 => f64::from(1 + draw.below(16)) / 16.0,
            _ => power(draw, -60, -1),
        };
        let delta = delta().min(1.0);
        let place = match draw.below(4) {
            0 => [1.0, 0.0],
            1 => [-1.0, 0.0],
            _ => [draw.signed_unit(), draw.signed_unit()],
        };
        let kappa = match draw.below(3) {
            0 => angle::kappa(rho2),
            1 => f64::from(1 + draw.below(32)) / 16.0,
            _ => power(draw, -9, 99).min(1e30),
        };
        let cos2 = [0.25, 0.75, 1.0, 0.5, 0.1][draw.below(5) as usize];
        Ok(KernelCase { points, rho2, delta, place, kappa, bounds, cos2 })
    }
}
