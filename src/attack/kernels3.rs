//! The law of two kernels in space: the same answer to every call, bit for bit.

use super::answer::{Answers, assert_equal};
use super::kernels::{fitted, moved};
use crate::arith::space::{ConstructionError, Kernel3, WeightedCorners};
use crate::arith::{ExactKernel, FastKernel, scale};
use crate::generators::{Bytes, Draw};
use crate::model::{Point3, Sign, WeightedPoint};
use arbitrary::{Arbitrary, Result, Unstructured};

/// Eight weighted points and the parameters of the kernel's methods, all within its contract.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelCase3 {
    /// The points; the first four are coplanar or a positively oriented tetrahedron.
    pub points: [WeightedPoint; 8],
    /// Square of the quality bound.
    pub rho2: f64,
    /// Bound on a squared radius.
    pub bound: f64,
    /// Place on an edge, in [0, 1].
    pub fraction: f64,
    /// Radius of a sphere.
    pub radius: f64,
    /// Factor of short radii.
    pub scale: f64,
    /// Normal of a plane.
    pub normal: Point3,
}

fn bare<const N: usize>(t: [WeightedPoint; N]) -> [Point3; N] {
    t.map(|p| p.at)
}

impl KernelCase3 {
    /// Asserts that the fast kernel answers as the exact one.
    pub fn run(&self) {
        assert_equal(&self.answers::<FastKernel>(), &self.answers::<ExactKernel>(), self);
    }

    /// All answers of a kernel.
    fn answers<K: Kernel3>(&self) -> Answers {
        let mut all = Answers::new();
        self.of_points::<K>(&mut all);
        self.of_triangles::<K>(&mut all);
        let [p, q, r, s, rest @ ..] = self.points;
        if let Some(t) = oriented::<K>([p, q, r, s]) {
            self.of_tetrahedra::<K>(t, oriented::<K>(rest).unwrap_or([q, r, p, s]), &mut all);
        }
        all
    }

    /// Methods that take any points.
    fn of_points<K: Kernel3>(&self, all: &mut Answers) {
        let [p, q, r, ..] = self.points;
        let [a, b, c, d, e, ..] = bare(self.points);
        let between = K::at_fraction3(a, b, self.fraction);
        all.extend([
            ("orient3d", K::orient3d(b, d, c, a).into()),
            ("orient3d of others", K::orient3d(b, e, c, d).into()),
            ("in_diametral_ball", K::in_diametral_ball(a, b, d).into()),
            ("compare_lengths3", K::compare_lengths3(a, b, c, d).into()),
            ("compare_power_distances", K::compare_power_distances(d, p, q).into()),
            ("midpoint3", K::midpoint3(a, d).into()),
            ("at_fraction3", between.into()),
            ("orient3d of a point on an edge", K::orient3d(a, b, c, between).into()),
            ("in_diametral_ball of it", K::in_diametral_ball(a, b, between).into()),
            ("distance", K::distance(a, d).into()),
        ]);
        if a != b {
            all.extend([
                ("power_side_of_edge", K::power_side_of_edge(p, q, r).into()),
                ("short_radius_below", K::short_radius_below(a, b, self.scale).into()),
                ("short_radius_above", K::short_radius_above(a, b, self.scale).into()),
                ("sphere_meets_segment", K::sphere_meets_segment(e, self.radius, a, b).into()),
            ]);
        }
    }

    /// Methods that take triangles.
    fn of_triangles<K: Kernel3>(&self, all: &mut Answers) {
        let [p, q, r, s, ..] = self.points;
        let [a, b, c, d, e, ..] = bare(self.points);
        let t = [p, q, r];
        let center = K::orthocenter_of_triangle(t);
        all.extend([
            ("orthocenter_of_triangle", center.into()),
            ("dual_line_meets_plane", K::dual_line_meets_plane(t, d, self.normal).into()),
            ("normal_side", K::normal_side([a, b, c], [b, d, e]).into()),
        ]);
        if center != Err(ConstructionError::Degenerate) {
            all.extend([
                ("power_side_of_triangle", K::power_side_of_triangle(t, s).into()),
                ("in_equatorial_ball", K::in_equatorial_ball(a, b, c, e).into()),
                ("compare_radius_edge_of_triangle", K::compare_radius_edge_of_triangle([a, b, c], self.rho2).into()),
            ]);
        }
    }

    /// Methods that take positively oriented tetrahedra.
    fn of_tetrahedra<K: Kernel3>(&self, t: WeightedCorners, u: WeightedCorners, all: &mut Answers) {
        let [.., p, q, _, _] = self.points;
        let [.., d, e, f, _] = bare(self.points);
        let center = K::orthocenter(t);
        all.extend([
            ("in_sphere", K::in_sphere(bare(t), d).into()),
            ("power_side", K::power_side(t, p).into()),
            ("power_side of another", K::power_side(t, q).into()),
            ("compare_orthoradius2", K::compare_orthoradius2(t, self.bound).into()),
            ("compare_orthoradii", K::compare_orthoradii(t, u).into()),
            ("compare_radius_edge", K::compare_radius_edge(bare(t), self.rho2).into()),
            ("orthocenter_side", K::orthocenter_side(t, [d, e, f]).into()),
            ("circumradius", K::circumradius(bare(t)).into()),
            ("orthocenter", center.into()),
        ]);
        if !t.contains(&p) {
            all.push(("in_conflict3", K::in_conflict3(t, p).into()));
        }
        // What a construction gives is what decisions are taken on.
        if let Ok(o) = center {
            all.extend([
                ("power_side of it", K::power_side(t, WeightedPoint::unweighted(o)).into()),
                ("in_sphere of it", K::in_sphere(bare(t), o).into()),
                ("orient3d with it", K::orient3d(t[0].at, t[1].at, t[2].at, o).into()),
            ]);
        }
    }
}

/// The four points in an order that makes them a positively oriented tetrahedron, if there is one.
fn oriented<K: Kernel3>(mut t: WeightedCorners) -> Option<WeightedCorners> {
    let [a, b, c, d] = bare(t);
    match K::orient3d(a, b, c, d) {
        Sign::Zero => None,
        Sign::Positive => Some(t),
        Sign::Negative => {
            t.swap(1, 2);
            Some(t)
        }
    }
}

/// A vector of independent draws.
fn vector<D: Draw>(draw: &mut D, one: impl Fn(&mut D) -> f64) -> Point3 {
    Point3::new(one(draw), one(draw), one(draw))
}

fn sign(draw: &mut impl Draw) -> f64 {
    if draw.coin() { 1.0 } else { -1.0 }
}

fn one_of(draw: &mut impl Draw, before: &[WeightedPoint]) -> WeightedPoint {
    before[draw.below(before.len() as u32) as usize]
}

/// A place in some relation to those before it, which makes for ties and near-ties.
fn place(draw: &mut impl Draw, before: &[WeightedPoint]) -> Point3 {
    let kind = draw.below(if before.len() < 3 { 4 } else { 11 });
    let one = |draw: &mut _| one_of(draw, before).at;
    let p = match kind {
        0 => vector(draw, |d| f64::from(d.integer(-5, 5)) / 8.0),
        1 => vector(draw, Draw::signed_unit),
        2 => vector(draw, |d| {
            let e = d.integer(-141, 200);
            d.signed_unit() * scale::by_power_of_two(1.0, e)
        }),
        // A lattice point of the sphere of radius 9.
        3 => {
            let mut p = [[9.0, 0.0, 0.0], [8.0, 4.0, 1.0], [7.0, 4.0, 4.0], [6.0, 6.0, 3.0]][draw.below(4) as usize];
            p.rotate_left(draw.below(3) as usize);
            Point3::from_array(p) * vector(draw, sign) / 16.0
        }
        // Beside an earlier one.
        4 => {
            let p = one(draw);
            Point3::from_array(p.to_array().map(|x| moved(x, draw.integer(-4, 4))))
        }
        // On the line of two, in the plane of three, up to rounding.
        5 => {
            let (p, q) = (one(draw), one(draw));
            p + (q - p) * (f64::from(draw.integer(-8, 16)) / 8.0)
        }
        6 => {
            let [p, q, r] = [one(draw), one(draw), one(draw)];
            let [s, t] = [draw.integer(-8, 16), draw.integer(-8, 16)].map(|n| f64::from(n) / 8.0);
            p + (q - p) * s + (r - p) * t
        }
        // At the same distance from one as another.
        7 => {
            let (o, p) = (one(draw), one(draw));
            let d = p - o;
            o + Point3::new(d.y, d.z, d.x) * vector(draw, sign)
        }
        // On the sphere of four, up to rounding, or its center; likewise of three.
        8 | 9 => {
            let t = [(); 4].map(|()| one_of(draw, before));
            let center = if kind == 8 {
                FastKernel::orthocenter(t)
            } else {
                FastKernel::orthocenter_of_triangle([t[0], t[1], t[2]])
            };
            let (center, p) = (center.unwrap_or(t[0].at), t[0].at);
            match draw.below(3) {
                0 => center,
                1 => center + (center - p),
                _ => {
                    let d = p - center;
                    center + Point3::new(d.y, d.z, d.x) * vector(draw, sign)
                }
            }
        }
        // A coordinate of each of three.
        _ => Point3::new(one(draw).x, one(draw).y, one(draw).z),
    };
    Point3::from_array(p.to_array().map(|x| fitted(x) + 0.0))
}

/// A weight as the contract wants it: 0, or of magnitude 2^-284 to 2^400; no -0.
pub(super) fn fitted_weight(w: f64) -> f64 {
    let (least, greatest) = (scale::by_power_of_two(1.0, -284), scale::by_power_of_two(1.0, 400));
    if w.abs() >= least { w.clamp(-greatest, greatest) } else { 0.0 }
}

/// A weight for a point at a place: none, round, a squared distance, that of another, any.
fn weight(draw: &mut impl Draw, at: Point3, before: &[WeightedPoint]) -> f64 {
    let kind = draw.below(if before.is_empty() { 3 } else { 6 });
    let w = match kind {
        0 => 0.0,
        1 => f64::from(draw.integer(-8, 8)) / 64.0,
        2 => {
            let e = draw.integer(-283, 399);
            draw.signed_unit() * scale::by_power_of_two(1.0, e)
        }
        3 => one_of(draw, before).weight,
        4 => (one_of(draw, before).at - at).length_squared() / 4.0,
        _ => moved(one_of(draw, before).weight, draw.integer(-2, 2)),
    };
    fitted_weight(w) + 0.0
}

impl<'a> Arbitrary<'a> for KernelCase3 {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let draw = &mut Bytes(u.bytes(u.len())?);
        let weighted = draw.coin();
        let mut list: Vec<WeightedPoint> = Vec::new();
        for _ in 0..8 {
            let at = place(draw, &list);
            let weight = if weighted { weight(draw, at, &list) } else { 0.0 };
            list.push(WeightedPoint { at, weight });
        }
        let mut points: [WeightedPoint; 8] = std::array::from_fn(|k| list[k]);
        if let Some(t) = oriented::<ExactKernel>([points[0], points[1], points[2], points[3]]) {
            points[..4].copy_from_slice(&t);
        }
        let [a, b, c, d, e, ..] = bare(points);
        let radius = ExactKernel::circumradius([a, b, c, d]).unwrap_or(1.0);
        let power =
            |draw: &mut Bytes, low, high| scale::by_power_of_two(1.0, draw.integer(low, high)) * (1.0 + draw.unit());
        let bound = match draw.below(3) {
            // A tie, or a rounding beside it.
            0 => radius * radius,
            1 => f64::from(1 + draw.below(64)) / 64.0,
            _ => power(draw, -280, 390),
        };
        let rho2 = match draw.below(3) {
            0 => bound.clamp(1e-30, 1e30),
            1 => f64::from(1 + draw.below(64)) / 16.0,
            _ => power(draw, -2, 20),
        };
        let fraction = if draw.coin() { f64::from(draw.below(9)) / 8.0 } else { draw.unit() };
        let radius = match draw.below(5) {
            0 => radius,
            // Through an end, or beside it.
            1 => moved(ExactKernel::distance(e, a), draw.integer(-1, 1)).abs(),
            2 => ExactKernel::distance(e, ExactKernel::midpoint3(a, b)),
            3 => f64::from(draw.below(32)) / 16.0,
            _ => power(draw, -141, 199),
        };
        let scale = if draw.coin() { f64::from(1 + draw.below(8)) / 8.0 } else { power(draw, -300, 300) };
        let normal = match draw.below(3) {
            0 => vector(draw, |d| f64::from(d.integer(-2, 2))),
            1 => vector(draw, Draw::signed_unit),
            _ => place(draw, &points),
        };
        let normal = Point3::from_array(normal.to_array().map(|x| fitted(x) + 0.0));
        let radius = if radius.is_finite() { fitted(radius) } else { 1.0 };
        let bound = bound.clamp(f64::MIN_POSITIVE, f64::MAX);
        Ok(KernelCase3 { points, rho2, bound, fraction, radius, scale, normal })
    }
}
