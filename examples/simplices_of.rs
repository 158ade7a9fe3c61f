//! Triangulates the cases of a stream and prints their simplices, hidden points and duplicates: this project's side of `oracle/run3.sh`.
//!
//! `simplices_of [THREADS]`; input (stdin) and output (stdout) as in `oracle/README.md`, "Cases of space". A case without edits is built at once; one
//! with edits step by step.

use orthoball::arith::FastKernel;
use orthoball::arith::scale::{by_power_of_two, exponent_of};
use orthoball::model::{Point3, PointSet3, PointState, VertexId, WeightedPoint};
use orthoball::triangulation::regular3::{Change, Regular3};
use std::error::Error;
use std::io::{Read, Write};

/// What is left of the stream.
struct Stream<'a>(&'a [u8]);

impl Stream<'_> {
    fn bytes(&mut self, n: usize) -> Result<&[u8], Box<dyn Error>> {
        let (head, tail) = self.0.split_at_checked(n).ok_or("the stream ends within a case")?;
        self.0 = tail;
        Ok(head)
    }

    fn number(&mut self) -> Result<u32, Box<dyn Error>> {
        Ok(u32::from_le_bytes(self.bytes(4)?.try_into()?))
    }

    fn float(&mut self) -> Result<f64, Box<dyn Error>> {
        Ok(f64::from_le_bytes(self.bytes(8)?.try_into()?))
    }
}

struct Case {
    name: String,
    points: PointSet3,
    /// Kind (insert the next point, remove, set weight), id, weight.
    edits: Vec<(u32, VertexId, f64)>,
}

fn read_case(stream: &mut Stream) -> Result<Case, Box<dyn Error>> {
    let length = stream.number()? as usize;
    let name = String::from_utf8(stream.bytes(length)?.to_vec())?;
    let mut points = PointSet3::default();
    for _ in 0..stream.number()? {
        points.points.push(Point3::new(stream.float()?, stream.float()?, stream.float()?));
        points.weights.push(stream.float()?);
    }
    let count = stream.number()?;
    let edits = (0..count)
        .map(|_| Ok((stream.number()?, VertexId(stream.number()?), stream.float()?)))
        .collect::<Result<_, Box<dyn Error>>>()?;
    Ok(Case { name, points, edits })
}

/// Coordinates divided by 2^e, weights by 4^e, and that e; -0 becomes +0.
fn normalised(set: &PointSet3) -> (Vec<WeightedPoint>, i32) {
    let exponent = exponent_of(set.points.iter().fold(0.0, |m: f64, p| m.max(p.abs().max_element())));
    let times = |x: f64, e: i32| by_power_of_two(x, e) + 0.0;
    let normal = |p: WeightedPoint| WeightedPoint {
        at: Point3::from_array(p.at.to_array().map(|x| times(x, -exponent))),
        weight: times(p.weight, -2 * exponent),
    };
    (set.weighted().map(normal).collect(), exponent)
}

fn solve(case: &Case, threads: usize) -> Result<Regular3<FastKernel>, Box<dyn Error>> {
    let (points, exponent) = normalised(&case.points);
    if case.edits.is_empty() {
        return Ok(Regular3::build(&points, threads));
    }
    let mut t = Regular3::new();
    let mut change = Change::default();
    for &(kind, id, weight) in &case.edits {
        match kind {
            0 => {
                let inserted = t.insert(points[id.index()], &mut change);
                if inserted != id {
                    return Err(format!("{}: point {id:?} got the id {inserted:?}", case.name).into());
                }
            }
            1 => t.remove(id, &mut change),
            _ => {
                t.set_weight(id, by_power_of_two(weight, -2 * exponent), &mut change);
            }
        }
    }
    Ok(t)
}

fn write_list(out: &mut impl Write, list: &[u32]) -> Result<(), Box<dyn Error>> {
    out.write_all(&u32::try_from(list.len())?.to_le_bytes())?;
    Ok(list.iter().try_for_each(|n| out.write_all(&n.to_le_bytes()))?)
}

fn write_answer(out: &mut impl Write, name: &str, t: &Regular3<FastKernel>) -> Result<(), Box<dyn Error>> {
    let (mut hidden, mut duplicates) = (Vec::new(), Vec::new());
    for id in 0..t.point_count() as u32 {
        match t.state(VertexId(id)) {
            PointState::Hidden => hidden.push(id),
            PointState::Duplicate { of } => duplicates.extend([id, of.0]),
            PointState::Vertex | PointState::Removed => {}
        }
    }
    let size = t.dimension().map_or(1, |d| usize::from(d) + 1);
    // A dimension that does not fit its simplices is a difference, not a panic: the remainder stays.
    let ids: Vec<u32> = t.simplices().iter().map(|v| v.0).collect();
    let mut tuples: Vec<Vec<u32>> = ids.chunks(size).map(<[u32]>::to_vec).collect();
    tuples.iter_mut().for_each(|tuple| tuple.sort_unstable());
    tuples.sort_unstable();
    out.write_all(&u32::try_from(name.len())?.to_le_bytes())?;
    out.write_all(name.as_bytes())?;
    out.write_all(&t.dimension().map_or(-1, i32::from).to_le_bytes())?;
    write_list(out, &tuples.concat())?;
    write_list(out, &hidden)?;
    write_list(out, &duplicates)
}

fn main() -> Result<(), Box<dyn Error>> {
    let threads = std::env::args().nth(1).map_or(Ok(1), |a| a.parse())?;
    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes)?;
    let mut stream = Stream(&bytes);
    let mut out = std::io::BufWriter::new(std::io::stdout());
    while !stream.0.is_empty() {
        let case = read_case(&mut stream)?;
        write_answer(&mut out, &case.name, &solve(&case, threads)?)?;
        // What is answered is kept if a later case fails.
        out.flush()?;
    }
    Ok(())
}
