//! Nanoseconds a call of each predicate and construction of space, by family of points: the least of several passes over 4,096 cases.
//!
//! `cargo run --release --example kernel_speed3 [--exact]`; the rationals take a while.

use orthoball::arith::space::Kernel3;
use orthoball::arith::{FastKernel, philox::philox4x32};
use orthoball::model::{Point3, Sign, WeightedPoint};
use std::hint::black_box;
use std::time::Instant;

/// Draws of one family.
struct Draws {
    family: u32,
    next: u32,
}

impl Draws {
    fn word(&mut self) -> u32 {
        self.next += 1;
        philox4x32([self.family, 7], [self.next, 0, 0, 0])[0]
    }
    fn below(&mut self, n: u32) -> f64 {
        f64::from(self.word() % n)
    }
    /// In [-1, 1), 53 bits.
    fn unit(&mut self) -> f64 {
        let bits = u64::from(self.word()) << 21 ^ u64::from(self.word() >> 11);
        bits as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn cube(&mut self) -> Point3 {
        Point3::new(self.unit(), self.unit(), self.unit())
    }
}

const FAMILIES: [&str; 6] = ["random", "neighbours", "grid", "on a sphere", "nearly cospherical", "wild scales"];

/// Six weighted points of a family; the first four a positively oriented tetrahedron.
fn case(d: &mut Draws) -> [WeightedPoint; 6] {
    loop {
        let origin = 0.5 * d.cube();
        let normal = d.cube().normalize();
        let p: [Point3; 6] = std::array::from_fn(|_| match d.family {
            0 => d.cube(),
            1 => origin + 0.01 * d.cube(),
            // Neighbours in a grid of 64^3.
            2 => ((origin * 64.0).floor() + Point3::new(d.below(3), d.below(3), d.below(3))) / 64.0,
            3 => (normal + 0.01 * d.cube()).normalize(),
            4 => origin + 0.01 * d.cube().normalize(),
            _ => {
                let scale = f64::from_bits((1023 - u64::from(d.word() % 40)) << 52);
                scale * d.cube()
            }
        });
        let weight = |d: &mut Draws| match d.family {
            2 => d.below(4) / 16384.0,
            _ => {
                let r = d.below(1 << 20) / f64::from(1 << 28);
                r * r
            }
        };
        let mut p = p.map(|at| WeightedPoint { at, weight: weight(d) });
        match FastKernel::orient3d(p[0].at, p[1].at, p[2].at, p[3].at) {
            Sign::Positive => return p,
            Sign::Negative => {
                p.swap(0, 1);
                return p;
            }
            Sign::Zero => {}
        }
    }
}

type Case = [WeightedPoint; 6];

/// Least nanoseconds a call over some passes.
fn time(cases: &[Case], call: impl Fn(&Case) -> u64) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..9 {
        let start = Instant::now();
        let sum = cases.iter().fold(0u64, |sum, c| sum.wrapping_add(call(c)));
        black_box(sum);
        least = least.min(start.elapsed().as_nanos() as f64 / cases.len() as f64);
    }
    least
}

fn corners(c: &Case) -> [WeightedPoint; 4] {
    [c[0], c[1], c[2], c[3]]
}

fn point<E>(p: Result<Point3, E>) -> u64 {
    p.map_or(1, |p| p.x.to_bits() ^ p.y.to_bits() ^ p.z.to_bits())
}

fn measure<K: Kernel3>(cases: &[Case]) -> Vec<(&'static str, f64)> {
    let bare = |c: &Case| corners(c).map(|p| p.at);
    let none = |c: &Case| corners(c).map(|p| WeightedPoint::unweighted(p.at));
    let m = Point3::new(0.3, -0.5, 0.7);
    macro_rules! rows {
        ($($name:literal: $call:expr),* $(,)?) => { vec![$(($name, time(cases, $call))),*] };
    }
    rows![
        "orient3d": |c| K::orient3d(c[1].at, c[2].at, c[3].at, c[4].at) as u64,
        "in_sphere": |c| K::in_sphere(bare(c), c[4].at) as u64,
        "power_side, no weights": |c| K::power_side(none(c), WeightedPoint::unweighted(c[4].at)) as u64,
        "power_side": |c| K::power_side(corners(c), c[4]) as u64,
        "in_conflict3, no weights": |c| u64::from(K::in_conflict3(none(c), WeightedPoint::unweighted(c[4].at))),
        "in_conflict3": |c| u64::from(K::in_conflict3(corners(c), c[4])),
        "power_side_of_triangle": |c| K::power_side_of_triangle([c[0], c[1], c[2]], c[4]) as u64,
        "power_side_of_edge": |c| K::power_side_of_edge(c[0], c[1], c[4]) as u64,
        "in_diametral_ball": |c| K::in_diametral_ball(c[0].at, c[1].at, c[4].at) as u64,
        "in_equatorial_ball": |c| K::in_equatorial_ball(c[0].at, c[1].at, c[2].at, c[4].at) as u64,
        "compare_lengths3": |c| K::compare_lengths3(c[0].at, c[1].at, c[2].at, c[4].at) as u64,
        "compare_power_distances": |c| K::compare_power_distances(c[0].at, c[1], c[2]) as u64,
        "compare_orthoradius2": |c| K::compare_orthoradius2(corners(c), 1e-4) as u64,
        "compare_orthoradii": |c| K::compare_orthoradii(corners(c), [c[1], c[2], c[3], c[4]]) as u64,
        "compare_radius_edge": |c| K::compare_radius_edge(bare(c), 4.0) as u64,
        "compare_radius_edge_of_triangle": |c| K::compare_radius_edge_of_triangle([c[0].at, c[1].at, c[2].at], 1.0) as u64,
        "orthocenter_side": |c| K::orthocenter_side(corners(c), [c[1].at, c[2].at, c[3].at]) as u64,
        "midpoint3": |c| point::<()>(Ok(K::midpoint3(c[0].at, c[1].at))),
        "at_fraction3": |c| point::<()>(Ok(K::at_fraction3(c[0].at, c[1].at, 0.3))),
        "orthocenter, no weights": |c| point(K::orthocenter(none(c))),
        "orthocenter": |c| point(K::orthocenter(corners(c))),
        "orthocenter_of_triangle": |c| point(K::orthocenter_of_triangle([c[0], c[1], c[2]])),
        "dual_line_meets_plane": |c| point(K::dual_line_meets_plane([c[0], c[1], c[2]], c[4].at, m)),
        "sphere_meets_segment": |c| K::sphere_meets_segment(c[0].at, 0.01, c[0].at, c[1].at)[0].map_or(0, |p| p.x.to_bits()),
        "distance": |c| K::distance(c[0].at, c[1].at).to_bits(),
        "circumradius": |c| K::circumradius(bare(c)).map_or(0, f64::to_bits),
        "short_radius_below": |c| K::short_radius_below(c[0].at, c[1].at, 0.3).to_bits(),
    ]
}

fn main() {
    let exact = std::env::args().any(|a| a == "--exact");
    let mut columns = vec![];
    for family in 0..FAMILIES.len() as u32 {
        let mut d = Draws { family, next: 0 };
        let cases: Vec<Case> = (0..if exact { 64 } else { 4096 }).map(|_| case(&mut d)).collect();
        columns.push(if exact { in_rationals(&cases) } else { measure::<FastKernel>(&cases) });
    }
    print!("{:34}", "ns a call");
    FAMILIES.iter().for_each(|name| print!("{name:>20}"));
    println!();
    for row in 0..columns[0].len() {
        print!("{:34}", columns[0][row].0);
        columns.iter().for_each(|column| print!("{:20.1}", column[row].1));
        println!();
    }
}

#[cfg(feature = "exact")]
fn in_rationals(cases: &[Case]) -> Vec<(&'static str, f64)> {
    measure::<orthoball::arith::ExactKernel>(cases)
}

#[cfg(not(feature = "exact"))]
fn in_rationals(cases: &[Case]) -> Vec<(&'static str, f64)> {
    measure::<FastKernel>(cases)
}
