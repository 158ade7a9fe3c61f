//! This project's side of `oracle/bench.sh`: CPU time of one build, without reading and writing of inputs.
//!
//! ```text
//! bench delaunay POINTS
//! bench constrained POINTS SEGMENTS
//! bench refine SHAPE AREA DEGREES [exact]      with the defaults; SHAPE: square or quad
//! bench trace SHAPE AREA DEGREES FILE           the same with a binary trace to FILE
//! ```
//!
//! Files as in `oracle/bench_inputs.py`. Prints seconds, vertices, triangles; `refine` and `trace` also steps, `trace` also bytes.

use orthoball::arith::{ExactKernel, FastKernel, Kernel};
use orthoball::domain::normalise;
use orthoball::model::{GcdrParameters, Lines, Point2, Pslg, Segment, VertexId};
use orthoball::refine::{Options, Run, everyday, gcdr};
use orthoball::trace::{Discard, Format, Sink, Writer};
use orthoball::triangulation::cdt2::Cdt2;
use std::error::Error;
use std::io::Write;

/// CPU time of this thread in seconds, as Linux counts it.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds: f64 = text.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(f64::NAN);
    nanoseconds * 1e-9
}

fn read_points(path: &str) -> Result<Vec<Point2>, Box<dyn Error>> {
    let number = |b: &[u8]| Ok::<f64, Box<dyn Error>>(f64::from_le_bytes(b.try_into()?));
    std::fs::read(path)?.chunks_exact(16).map(|b| Ok(Point2::new(number(&b[..8])?, number(&b[8..])?))).collect()
}

fn read_segments(path: &str) -> Result<Vec<[VertexId; 2]>, Box<dyn Error>> {
    let id = |b: &[u8]| Ok::<VertexId, Box<dyn Error>>(VertexId(u32::from_le_bytes(b.try_into()?)));
    std::fs::read(path)?.chunks_exact(8).map(|b| Ok([id(&b[..4])?, id(&b[4..])?])).collect()
}

fn build(points: Vec<Point2>, segments: &[[VertexId; 2]]) -> Result<(), Box<dyn Error>> {
    let start = cpu_seconds();
    let (points, _) = normalise(&points, &Lines::default()).map_err(|_| "coordinates out of range")?;
    let mut t = Cdt2::<FastKernel>::delaunay(points)?;
    t.constrain(segments)?;
    print!("{:.4} {} {}", cpu_seconds() - start, t.vertex_count(), t.triangle_count());
    Ok(())
}

/// The unit square, or a quadrilateral without right angles and equal sides; the same in all programs of the benchmark.
fn domain(shape: &str) -> Result<Pslg, String> {
    let corners = match shape {
        "square" => [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        "quad" => [(0.0, 0.0), (1.0, 0.125), (0.875, 1.0625), (-0.0625, 0.9375)],
        _ => return Err(format!("no shape {shape}")),
    };
    let segment = |i: u32| Segment { ends: [VertexId(i), VertexId((i + 1) % 4)], marker: 0, toggles: true };
    Ok(Pslg { points: corners.map(Point2::from).to_vec(), segments: (0..4).map(segment).collect(), ..Pslg::default() })
}

fn refine<K: Kernel>(shape: &str, area: f64, degrees: f64, sink: &mut dyn Sink) -> Result<(Run, f64), Box<dyn Error>> {
    let parameters = GcdrParameters { max_area: Some(area), ..everyday(degrees)? };
    let start = cpu_seconds();
    let run = gcdr::run::<K>(&domain(shape)?, &parameters, &mut Options::default(), sink)?;
    Ok((run, cpu_seconds() - start))
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let print = |run: &Run, seconds: f64| {
        print!("{seconds:.4} {} {} {}", run.mesh.points.len(), run.mesh.triangles.len(), run.events);
    };
    match words[..] {
        ["delaunay", points] => build(read_points(points)?, &[])?,
        ["constrained", points, segments] => build(read_points(points)?, &read_segments(segments)?)?,
        ["refine", shape, area, degrees] => {
            let (run, seconds) = refine::<FastKernel>(shape, area.parse()?, degrees.parse()?, &mut Discard)?;
            print(&run, seconds);
        }
        ["refine", shape, area, degrees, "exact"] => {
            let (run, seconds) = refine::<ExactKernel>(shape, area.parse()?, degrees.parse()?, &mut Discard)?;
            print(&run, seconds);
        }
        ["trace", shape, area, degrees, path] => {
            let mut writer = Writer::new(std::io::BufWriter::new(std::fs::File::create(path)?), Format::Binary);
            let (run, seconds) = refine::<FastKernel>(shape, area.parse()?, degrees.parse()?, &mut writer)?;
            writer.finish()?.flush()?;
            print(&run, seconds);
            print!(" {}", std::fs::metadata(path)?.len());
        }
        _ => return Err("see the head of examples/bench.rs".into()),
    }
    println!();
    Ok(())
}
