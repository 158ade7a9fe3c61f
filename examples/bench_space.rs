//! This project's side of `oracle/bench3.sh`: CPU time of one job in space, without reading inputs.
//!
//! ```text
//! bench_space build POINTS [THREADS] [COUNT]   bulk build of the first COUNT points (0: all)
//! bench_space build-wall POINTS THREADS        bulk build, wall seconds
//! bench_space remove POINTS COUNT              build, then removal of COUNT points in random order
//! bench_space insert POINTS                    one by one in the library's order, from the last cell: what a trace of steps records
//! ```
//!
//! POINTS: rows of four little-endian doubles x, y, z, weight; scaled before the clock starts. Prints seconds, vertices, cells, and bytes of memory: the peak while the job
//! ran less what was there before it.

use orthoball::arith::FastKernel;
use orthoball::arith::scale::{by_power_of_two, exponent_of};
use orthoball::generators::{Draw, SplitMix64};
use orthoball::model::{Point3, VertexId, WeightedPoint};
use orthoball::triangulation::regular3::{Change, Regular3};
use std::error::Error;
use std::io::Read;

/// CPU time of this thread in seconds, as Linux counts it.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds: f64 = text.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(f64::NAN);
    nanoseconds * 1e-9
}

/// A line of /proc/self/status, in bytes.
fn memory(key: &str) -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix(key));
    line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok()).map_or(f64::NAN, |kib| kib * 1024.0)
}

fn read_points(path: &str, count: usize) -> Result<Vec<WeightedPoint>, Box<dyn Error>> {
    let mut file = std::io::BufReader::new(std::fs::File::open(path)?);
    let rows = file.get_ref().metadata()?.len() as usize / 32;
    let count = if count == 0 { rows } else { rows.min(count) };
    let mut points = Vec::with_capacity(count);
    let mut row = [0; 32];
    for _ in 0..count {
        file.read_exact(&mut row)?;
        let number = |i: usize| row[8 * i..8 * i + 8].try_into().map(f64::from_le_bytes);
        points.push(WeightedPoint { at: Point3::new(number(0)?, number(1)?, number(2)?), weight: number(3)? });
    }
    let exponent = exponent_of(points.iter().fold(0.0, |m: f64, p| m.max(p.at.abs().max_element())));
    for p in &mut points {
        p.at = Point3::from_array(p.at.to_array().map(|x| by_power_of_two(x, -exponent) + 0.0));
        p.weight = by_power_of_two(p.weight, -2 * exponent) + 0.0;
    }
    Ok(points)
}

/// Runs a job; prints seconds (CPU of this thread, or wall), what the job counted, and memory.
fn measure<T>(wall: bool, job: impl FnOnce() -> T, count: impl FnOnce(&T) -> [usize; 2]) {
    // Resets the peak, so that reading the input does not count; without that file the peak is an upper bound.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let before = memory("VmRSS:");
    let (clock, start) = (std::time::Instant::now(), cpu_seconds());
    let result = job();
    let seconds = if wall { clock.elapsed().as_secs_f64() } else { cpu_seconds() - start };
    let peak = memory("VmHWM:") - before;
    let [vertices, cells] = count(&result);
    println!("{seconds:.4} {vertices} {cells} {peak:.0}");
}

fn sizes(t: &Regular3<FastKernel>) -> [usize; 2] {
    [t.vertex_count(), t.cells().filter(|&c| t.is_finite(c)).count()]
}

/// A random order of 0..n (Fisher and Yates, seed 9), as in `oracle/cgal/space_bench.cpp`.
fn shuffled(n: usize) -> Vec<u32> {
    let mut draw = SplitMix64(9);
    let mut order: Vec<u32> = (0..n as u32).collect();
    for i in (1..n).rev() {
        order.swap(i, (draw.take(8) % (i as u64 + 1)) as usize);
    }
    order
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["build", path, ref rest @ ..] => {
            let threads = rest.first().map_or(Ok(1), |w| w.parse())?;
            let points = read_points(path, rest.get(1).map_or(Ok(0), |w| w.parse())?)?;
            measure(false, || Regular3::<FastKernel>::build(&points, threads), sizes);
        }
        ["build-wall", path, threads] => {
            let (points, threads) = (read_points(path, 0)?, threads.parse()?);
            measure(true, || Regular3::<FastKernel>::build(&points, threads), sizes);
        }
        ["remove", path, count] => {
            let points = read_points(path, 0)?;
            let mut t = Regular3::<FastKernel>::build(&points, 1);
            let order = shuffled(points.len());
            let count = order.len().min(count.parse()?);
            let mut change = Change::default();
            measure(
                false,
                || order[..count].iter().for_each(|&id| t.remove(VertexId(id), &mut change)),
                |()| [count, 0],
            );
        }
        ["insert", path] => {
            let points = read_points(path, 0)?;
            let job = || {
                let (mut t, mut change) = (Regular3::<FastKernel>::new(), Change::default());
                for id in Regular3::<FastKernel>::insertion_order(&points) {
                    t.insert(points[id as usize], &mut change);
                }
                t
            };
            measure(false, job, sizes);
        }
        _ => return Err("see the head of examples/bench_space.rs".into()),
    }
    Ok(())
}
