//! The end: counts, the digest, and the triangulation as data.

use super::complex::{FIRST, INFINITE, id};
use super::hidden::State;
use super::replay::Replay;
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::{PointState, Triangulation3, VertexId, WeightedPoint, canonical_tetrahedron};
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

/// Counts.
pub fn counts(replay: &Replay) -> Counts3 {
    let mut counts = Counts3 { simplices: replay.mesh.corner_lists().count() as u32, ..Counts3::default() };
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
    let simplices = if size == 4 { tetrahedra(replay, &name).into_flattened() } else { flat(replay, &name, size) };
    Triangulation3 { points, states, dimension, simplices }
}

/// The simplices of a triangulation of fewer dimensions, `size` vertices each, canonical and ascending: ids ascend, and apexes have the largest.
fn flat(replay: &Replay, name: &[u32], size: usize) -> Vec<VertexId> {
    let mut tuples: Vec<[u32; 4]> = replay
        .mesh
        .corner_lists()
        .map(|v| v.map(|v| if v < FIRST { u32::MAX - (INFINITE - v) } else { name[v as usize] }))
        .collect();
    tuples.iter_mut().for_each(|t| t.sort_unstable());
    tuples.sort_unstable();
    tuples.iter().flat_map(|t| t[..size].iter().map(|&v| VertexId(v))).collect()
}

/// The tetrahedra, canonical and ascending: by buckets over the first id.
fn tetrahedra(replay: &Replay, name: &[u32]) -> Vec<[VertexId; 4]> {
    let all = || replay.mesh.corner_lists().map(|t| t.map(|v| VertexId(name[v as usize])));
    // Where the bucket of each id starts; when it is full, where it ends.
    let mut bounds = vec![0u32; replay.points.len() + 1];
    for [a, b, c, d] in all() {
        bounds[a.min(b).min(c.min(d)).index() + 1] += 1;
    }
    for v in 1..bounds.len() {
        bounds[v] += bounds[v - 1];
    }
    let count = bounds.last().copied().unwrap_or(0);
    let mut sorted = vec![[VertexId(0); 4]; count as usize];
    for t in all().map(canonical_tetrahedron) {
        let end = &mut bounds[t[0].index()];
        sorted[*end as usize] = t;
        *end += 1;
    }
    let mut from = 0;
    for &to in &bounds[..replay.points.len()] {
        // Of equal first ids. One number is compared sooner than three.
        sorted[from..to as usize]
            .sort_unstable_by_key(|[_, b, c, d]| u128::from(b.0) << 64 | u128::from(c.0) << 32 | u128::from(d.0));
        from = to as usize;
    }
    sorted
}
