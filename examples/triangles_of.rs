//! Triangulates the cases of a stream and prints their triangles as sorted sets: this project's side of `oracle/run.sh`.
//!
//! Input (stdin) and output (stdout) are described in `oracle/README.md`.

use orthoball::arith::FastKernel;
use orthoball::domain::{normalise, prepare};
use orthoball::model::{Lines, Point2, Pslg, Segment, VertexId};
use orthoball::triangulation::cdt2::Cdt2;
use std::error::Error;
use std::io::{Read, Write};

/// The constrained Delaunay triangulation of the convex hull of a repaired graph; `None` for what is refused.
fn triangulate(pslg: &Pslg) -> Option<Cdt2<FastKernel>> {
    let prepared = prepare::<FastKernel>(pslg, &Lines::default());
    let (points, _) = normalise(&pslg.points, &Lines::default()).ok()?;
    let mut t = Cdt2::delaunay(points).ok()?;
    // A graph without segments is an error to the mesher alone: what matters here is whether the triangulation accepts the segments.
    let segments: Vec<[VertexId; 2]> = prepared.pslg.segments.iter().map(|s| s.ends).collect();
    t.constrain(&segments).ok()?;
    Some(t)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let mut words = text.split_whitespace();
    let mut out = std::io::BufWriter::new(std::io::stdout());
    while words.next().is_some() {
        let mut word = || words.next().ok_or("the stream ends within a case");
        let name = word()?;
        let [n, m, h] = [word()?.parse::<usize>()?, word()?.parse()?, word()?.parse()?];
        let mut labels: Vec<i64> = Vec::new();
        let mut points = Vec::new();
        for _ in 0..n {
            labels.push(word()?.parse()?);
            points.push(Point2::new(word()?.parse()?, word()?.parse()?));
        }
        let mut segments = Vec::new();
        for _ in 0..m {
            let ends = [VertexId(word()?.parse()?), VertexId(word()?.parse()?)];
            segments.push(Segment { ends, marker: 0, toggles: true });
        }
        for _ in 0..2 * h {
            word()?;
        }
        let pslg = Pslg { points, segments, ..Pslg::default() };
        let Some(t) = triangulate(&pslg) else {
            writeln!(out, "case {name} refused")?;
            continue;
        };
        let mut triangles: Vec<[i64; 3]> = t.triangles().map(|f| t.vertices(f).map(|v| labels[v.index()])).collect();
        triangles.iter_mut().for_each(|t| t.sort_unstable());
        triangles.sort_unstable();
        writeln!(out, "case {name} {}", triangles.len())?;
        for [a, b, c] in triangles {
            writeln!(out, "{a} {b} {c}")?;
        }
    }
    Ok(out.flush()?)
}
