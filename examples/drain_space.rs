//! Removes all points of large sets in random order: `drain_space [N] [FAMILY [WEIGHTS]]` (default 20000; every family of places without weights, and every
//! family of weights on grids and on uniform places). Sets of quadratic size start with at most 1,000 points.
//!
//! After every hundredth step the triangulation must be valid in all its layers, at ten moments equal to a fresh build of the points that stand, and in the end
//! empty. Prints a line a set with the CPU time of a removal; exit code 1 on any failure.

use orthoball::arith::FastKernel;
use orthoball::arith::scale::{by_power_of_two, exponent_of};
use orthoball::generators::{Draw, SpaceFamily, SplitMix64, WeightFamily, weighted_points};
use orthoball::model::{Point3, PointState, VertexId, WeightedPoint};
use orthoball::triangulation::regular3::{Change, Regular3};
use std::io::Write;
use std::time::{Duration, Instant};

type Triangulation = Regular3<FastKernel>;

/// Coordinates divided by 2^e, weights by 4^e, the largest coordinate in [1/2, 1).
fn normalised(points: Vec<WeightedPoint>) -> Vec<WeightedPoint> {
    let e = exponent_of(points.iter().fold(0.0, |m: f64, p| m.max(p.at.abs().max_element())));
    let normal = |p: WeightedPoint| WeightedPoint {
        at: Point3::from_array(p.at.to_array().map(|x| by_power_of_two(x, -e))),
        weight: by_power_of_two(p.weight, -2 * e),
    };
    points.into_iter().map(normal).collect()
}

/// Whether t is the triangulation of the points that stand.
fn equals_fresh(t: &Triangulation, points: &[WeightedPoint], standing: &[bool]) -> Result<(), String> {
    let ids: Vec<u32> = (0..points.len() as u32).filter(|&id| standing[id as usize]).collect();
    let fresh = Triangulation::build(&ids.iter().map(|&id| points[id as usize]).collect::<Vec<_>>(), 1);
    let name = |v: VertexId| VertexId(ids[v.index()]);
    if (fresh.dimension(), fresh.simplices().into_iter().map(name).collect::<Vec<_>>())
        != (t.dimension(), t.simplices())
    {
        return Err("the simplices are not those of a fresh build".into());
    }
    for (i, &id) in ids.iter().enumerate() {
        let expected = match fresh.state(VertexId(i as u32)) {
            PointState::Duplicate { of } => PointState::Duplicate { of: name(of) },
            state => state,
        };
        if t.state(VertexId(id)) != expected {
            return Err(format!("point {id} is {:?}, in a fresh build {expected:?}", t.state(VertexId(id))));
        }
    }
    Ok(())
}

/// Removes all points; the time of the removals alone.
fn drain(points: &[WeightedPoint], draw: &mut SplitMix64) -> Result<Duration, String> {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, draw.below(i as u32 + 1) as usize);
    }
    let (mut t, mut change) = (Triangulation::build(points, 1), Change::default());
    let (mut standing, mut used) = (vec![true; points.len()], Duration::ZERO);
    let moment = (points.len() / 10).max(1);
    for (step, &id) in order.iter().enumerate() {
        let start = Instant::now();
        t.remove(VertexId(id), &mut change);
        used += start.elapsed();
        standing[id as usize] = false;
        let at = |why: String| format!("after step {} (point {id}): {why}", step + 1);
        if (step + 1) % 100 == 0 {
            t.validate().map_err(|v| at(v.to_string()))?;
        }
        if (step + 1) % moment == 0 {
            equals_fresh(&t, points, &standing).map_err(at)?;
        }
    }
    if t.dimension().is_some() || !t.simplices().is_empty() {
        return Err("the empty set has a dimension or simplices".into());
    }
    Ok(used)
}

fn sets() -> Vec<(SpaceFamily, WeightFamily)> {
    let places = SpaceFamily::ALL.map(|family| (family, WeightFamily::Zero));
    let of = |family| WeightFamily::ALL.map(|weights| (family, weights));
    let weighted = [SpaceFamily::Random, SpaceFamily::Grid].into_iter().flat_map(of);
    let mut all: Vec<_> = places.into_iter().chain(weighted).collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let n: usize = arguments.first().map_or(Ok(20_000), |a| a.parse())?;
    let wanted = |i: usize, name: String| arguments.get(i).is_none_or(|a| *a == name);
    let mut failed = 0;
    for (family, weights) in sets() {
        if !wanted(1, format!("{family:?}")) || !wanted(2, format!("{weights:?}")) {
            continue;
        }
        let mut draw = SplitMix64(11);
        let n = if family.is_quadratic() { n.min(1000) } else { n };
        let points = normalised(weighted_points(family, weights, n, &mut draw));
        let text = match drain(&points, &mut draw) {
            Ok(used) => format!("{:.1} us a removal", used.as_secs_f64() * 1e6 / points.len().max(1) as f64),
            Err(why) => {
                failed += 1;
                format!("FAILED {why}")
            }
        };
        println!("{:32} {:6} points  {text}", format!("{family:?} {weights:?}"), points.len());
        std::io::stdout().flush()?;
    }
    if failed > 0 { Err(format!("{failed} sets failed").into()) } else { Ok(()) }
}
