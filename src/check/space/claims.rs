//! The end: counts, the digest, and the triangulation as data.

use super::complex::{FIRST, INFINITE, id};
use super::hidden::State;
use super::replay::Replay;
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::{PointState, Triangulation3, VertexId, WeightedPoint};
use crate::trace::Counts3;

/// Every point is placed, and every vertex is in a cell.
pub fn check_points(replay: &Replay) -> Checked {
    for (v, state) in replay.points.iter() {
        match state {
            State::Unplaced | State::Free => return broken(Rule::Order, "every point placed", format!("{:?}", id(v))),
            State::Vertex => {
                ensure(replay.mesh.holds(v), Rule::Hidden, || {
                    ("every vertex in a cell", format!("{:?} in none", id(v)))
                })?;
            }
            State::Hidden | State::Duplicate(_) | State::Removed => {}
        }
    }
    Ok(())
}

/// Of hidden points no two have the same place and weight: one of them is a duplicate.
pub fn check_hidden_differ(replay: &Replay) -> Checked {
    let key = |p: WeightedPoint| [p.at.x, p.at.y, p.at.z, p.weight].map(f64::to_bits);
    let hidden = replay.points.iter().filter(|(_, s)| *s == State::Hidden);
    let mut all: Vec<_> = hidden.map(|(v, _)| (key(replay.mesh.point(v)), v)).collect();
    all.sort_unstable();
    let twins = all.windows(2).find(|pair| pair[0].0 == pair[1].0);
    twins.map_or(Ok(()), |pair| {
        broken(Rule::Duplicate, "a duplicate", format!("{:?} and {:?} hidden", id(pair[0].1), id(pair[1].1)))
    })
}

/// Counts.
pub fn counts(replay: &Replay) -> Counts3 {
    let mut counts = Counts3 { simplices: replay.mesh.tetrahedra().count() as u32, ..Counts3::default() };
    for (_, state) in replay.points.iter() {
        match state {
            State::Vertex => counts.vertices += 1,
            State::Hidden => counts.hidden += 1,
            State::Duplicate(_) => counts.duplicates += 1,
            State::Removed => counts.removed += 1,
            State::Unplaced | State::Free => {}
        }
    }
    counts
}

/// The triangulation, named by the input: `inputs` says where each point stood, and is empty if ids do. Of points of the same place and weight the first of the
/// input stands for all. `unscaled` gives a point in input units.
pub fn triangulation(
    replay: &Replay,
    inputs: &[u32],
    unscaled: impl Fn(WeightedPoint) -> WeightedPoint,
) -> Triangulation3 {
    let place = |v: u32| inputs.get((v - FIRST) as usize).copied().unwrap_or(v - FIRST);
    // Whom each number is called by.
    let mut name: Vec<u32> = (0..replay.mesh.vertex_count()).map(|v| if v < FIRST { v } else { place(v) }).collect();
    for (&of, list) in &replay.points.duplicates {
        name[of as usize] = list.iter().map(|&v| place(v)).chain([place(of)]).min().unwrap_or(place(of));
    }
    let count = replay.points.len();
    let mut points = vec![WeightedPoint::default(); count];
    let mut states = vec![PointState::Removed; count];
    for (v, state) in replay.points.iter() {
        points[place(v) as usize] = unscaled(replay.mesh.point(v));
        let stands = match state {
            State::Duplicate(of) => of,
            _ => v,
        };
        let own = match replay.points.state(stands) {
            State::Vertex => PointState::Vertex,
            State::Hidden => PointState::Hidden,
            _ => PointState::Removed,
        };
        let first = name[stands as usize];
        let is_first = first == place(v);
        states[place(v) as usize] = if is_first { own } else { PointState::Duplicate { of: VertexId(first) } };
    }
    let dimension = (!replay.is_empty()).then_some(3 - replay.apexes as u8);
    let size = 4 - replay.apexes as usize;
    let mut tuples: Vec<[u32; 4]> = Vec::with_capacity(replay.mesh.slot_count() as usize);
    for c in replay.mesh.tetrahedra() {
        let named = replay.mesh.cell(c).v.map(|v| if v < FIRST { u32::MAX - (INFINITE - v) } else { name[v as usize] });
        tuples.push(canonical(named, size));
    }
    if !tuples.is_sorted() {
        tuples = by_first(tuples, count);
    }
    let simplices = tuples.iter().flat_map(|t| t[..size].iter().map(|&v| VertexId(v))).collect();
    Triangulation3 { points, states, dimension, simplices }
}

/// Ascending order; a tetrahedron's last two ids are exchanged where that is an odd permutation. Apexes have the largest ids.
fn canonical(t: [u32; 4], size: usize) -> [u32; 4] {
    if size == 4 {
        return crate::model::canonical_tetrahedron(t.map(VertexId)).map(|v| v.0);
    }
    let mut t = t;
    t.sort_unstable();
    t
}

/// Ascending order, by buckets over the first id.
fn by_first(tuples: Vec<[u32; 4]>, count: usize) -> Vec<[u32; 4]> {
    let mut start = vec![0u32; count + 1];
    tuples.iter().for_each(|t| start[t[0] as usize + 1] += 1);
    for v in 1..start.len() {
        start[v] += start[v - 1];
    }
    let mut sorted = vec![[0; 4]; tuples.len()];
    for t in tuples {
        let place = &mut start[t[0] as usize];
        sorted[*place as usize] = t;
        *place += 1;
    }
    let mut from = 0;
    for &to in &start[..count] {
        sorted[from..to as usize].sort_unstable();
        from = to as usize;
    }
    sorted
}
