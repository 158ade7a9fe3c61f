//! Seconds that a verification of a trace of steps takes against those of the build: `cargo run --release --example time_verify_space [points] [family]`.
//!
//! Seconds of the processor where the system tells them, on one core; medians of five, taken in turn. Families: uniform, weighted (a tenth hidden or so), sphere, grid. The build is the
//! untraced one of all points at once; the traced one inserts them one by one, and codes, hashes and keeps what it did, and the digest of the result.

use orthoball::arith::FastKernel;
use orthoball::check::{Checker, Options};
use orthoball::generators::{Draw, SplitMix64};
use orthoball::model::{Point3, PointSet3, WeightedPoint};
use orthoball::refine::regular::{Certificate, triangulate3};
use orthoball::trace::{Format, Reader, Writer};
use orthoball::triangulation::regular3::Regular3;
use std::time::Instant;

/// Nanoseconds that this thread has had, as Linux counts them.
fn processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split(' ').next()?.parse().ok()
}

/// Seconds of a run.
fn seconds(run: impl FnOnce()) -> f64 {
    let (start, before) = (Instant::now(), processor());
    run();
    match (before, processor()) {
        (Some(before), Some(after)) => (after - before) * 1e-9,
        _ => start.elapsed().as_secs_f64(),
    }
}

fn family(name: &str, n: usize) -> PointSet3 {
    let mut draw = SplitMix64(5);
    let mut uniform = || Point3::new(draw.unit(), draw.unit(), draw.unit());
    let side = (n as f64).cbrt().round() as usize;
    let points: Vec<Point3> = match name {
        "grid" => {
            (0..side.pow(3)).map(|i| [i / side / side, i / side % side, i % side].map(|x| x as f64).into()).collect()
        }
        "sphere" => (0..n).map(|_| (uniform() - Point3::splat(0.5)).normalize()).collect(),
        _ => (0..n).map(|_| uniform()).collect(),
    };
    let largest = (n as f64).powf(-2.0 / 3.0) * 0.6;
    let weights = if name == "weighted" { (0..n).map(|_| draw.unit() * largest).collect() } else { Vec::new() };
    PointSet3 { points, weights, ..PointSet3::default() }
}

fn verify(trace: &[u8], strict: bool) {
    let mut checker = Checker::new(Options { strict, digests: true });
    let mut reader = Reader::new(trace);
    for record in &mut reader {
        let accepted = record.is_ok_and(|r| checker.push(&r).is_ok());
        assert!(accepted, "rejected");
    }
    drop(reader.digest());
    drop(checker.finish());
}

fn main() {
    let n: usize = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(150_000);
    let chosen = std::env::args().nth(2);
    for name in ["uniform", "weighted", "sphere", "grid"] {
        if chosen.as_ref().is_some_and(|c| c != name) {
            continue;
        }
        let set = family(name, n);
        let (sites, _): (Vec<WeightedPoint>, _) = orthoball::domain::normalise3(&set).expect("points in range");
        let traced = || {
            let mut writer = Writer::new(Vec::new(), Format::Binary);
            triangulate3::<FastKernel>(&set, Certificate::Steps, 1, &mut writer).expect("memory takes all");
            writer.finish().expect("memory takes all")
        };
        let trace = traced();
        let runs = [(); 5].map(|()| {
            [
                seconds(|| drop(Regular3::<FastKernel>::build(&sites, 1))),
                seconds(|| drop(traced())),
                seconds(|| assert!(Reader::new(&trace[..]).all(|r| r.is_ok()))),
                seconds(|| verify(&trace, false)),
                seconds(|| verify(&trace, true)),
            ]
        });
        let [build, traced, read, plain, strict] = [0, 1, 2, 3, 4].map(|what: usize| {
            let mut all = runs.map(|run| run[what]);
            all.sort_by(f64::total_cmp);
            all[2]
        });
        println!(
            "{name}: {} points, {} bytes, built in {build:.3} s, with trace in {traced:.3} s",
            sites.len(),
            trace.len()
        );
        for (what, s) in [("reading", read), ("verify", plain), ("verify --strict", strict)] {
            println!("  {what:<16} {s:.3} s, of the build {:.2}, of the traced build {:.2}", s / build, s / traced);
        }
    }
}
