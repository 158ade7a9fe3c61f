//! Seconds that an audit takes against those of the build that made the mesh: `cargo run --release --example time_audit_space [cells]`.
//!
//! Seconds of the processor where the system tells them. One core; uniform points, points on a sphere and a grid; the mesh in canonical order, as a file would have it. Medians of five.

use orthoball::arith::FastKernel;
use orthoball::audit::space::{Claim, Options, Subject, audit};
use orthoball::model::{Point3, VertexId, WeightedPoint};
use orthoball::triangulation::regular3::Regular3;
use std::time::Instant;

/// Xorshift numbers in [0, 1).
fn draws() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Nanoseconds that this thread has had, as Linux counts them.
fn processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split(' ').next()?.parse().ok()
}

fn median(mut run: impl FnMut()) -> f64 {
    let mut seconds: Vec<f64> = (0..5)
        .map(|_| {
            let (start, before) = (Instant::now(), processor());
            run();
            match (before, processor()) {
                (Some(before), Some(after)) => (after - before) * 1e-9,
                _ => start.elapsed().as_secs_f64(),
            }
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[2]
}

fn main() {
    let cells: usize = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(1_000_000);
    let mut draw = draws();
    let uniform: Vec<Point3> =
        (0..cells * 10 / 67).map(|_| Point3::new(draw(), draw(), draw()) - Point3::splat(0.5)).collect();
    let sphere: Vec<Point3> = uniform.iter().map(|p| p.normalize() * 0.5).collect();
    let side = ((cells / 6) as f64).cbrt() as usize;
    let grid = (0..side.pow(3)).map(|i| [i / side / side, i / side % side, i % side].map(|x| x as f64 / side as f64));
    let grid: Vec<Point3> = grid.map(Point3::from_array).collect();
    for (name, points) in [("uniform", uniform), ("sphere", sphere), ("grid", grid)] {
        let sites: Vec<WeightedPoint> = points.iter().map(|&p| WeightedPoint::unweighted(p)).collect();
        let build = median(|| drop(Regular3::<FastKernel>::build(&sites, 1)));
        let simplices = Regular3::<FastKernel>::build(&sites, 1).simplices();
        let cells: Vec<[VertexId; 4]> = simplices.as_chunks().0.to_vec();
        println!("{name}: {} points, {} cells, built in {build:.3} s", points.len(), cells.len());
        let subject = Subject { points: &points, cells: &cells, ..Subject::default() };
        for claim in Claim::ALL {
            let options = Options { claims: &[claim], ..Options::default() };
            let seconds = median(|| drop(audit(&subject, &options)));
            let verdict = audit(&subject, &options).claims[0].verdict;
            println!("  {:<12} {seconds:.3} s  {:.2}  {verdict:?}", claim.name(), seconds / build);
        }
    }
}
