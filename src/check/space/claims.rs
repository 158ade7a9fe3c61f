//! The end: counts, the digest, and the triangulation as data.

use super::complex::{FIRST, INFINITE, NONE, id};
use super::hidden::State;
use super::replay::Replay;
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::{PointState, Tetrahedron, Triangulation3, VertexId, WeightedPoint, canonical_tetrahedron};
use crate::trace::{Counts3, TriangulationDigest};

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

/// Counts, of so many simplices.
pub fn counts(replay: &Replay, simplices: usize) -> Counts3 {
    let mut counts = Counts3 { simplices: simplices as u32, ..Counts3::default() };
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

/// A replayed triangulation as the input names it. Of points of the same place and weight the first of the input stands for all.
pub struct Named<'r> {
    replay: &'r Replay,
    /// Where points stood in the input; empty if ids say so.
    inputs: &'r [u32],
    /// What each number is called. Apexes have the largest names.
    name: Vec<u32>,
    /// The slots of simplices by their smallest name, and where those of each name end.
    slots: Vec<u32>,
    ends: Vec<u32>,
}

/// Names whose simplices are fetched together: memory answers many questions in the time of one, and the digest takes much at once.
const BLOCK: usize = 512;

impl<'r> Named<'r> {
    /// `inputs` has each place once, or is empty.
    pub fn new(replay: &'r Replay, inputs: &'r [u32]) -> Named<'r> {
        let mut named = Named { replay, inputs, name: Vec::new(), slots: Vec::new(), ends: Vec::new() };
        let apexes = (0..FIRST).map(|v| u32::MAX - (INFINITE - v));
        let mut name: Vec<u32> = apexes.chain((FIRST..replay.mesh.vertex_count()).map(|v| named.place(v))).collect();
        for (&of, list) in &replay.points.duplicates {
            name[of as usize] = list.iter().map(|&v| named.place(v)).fold(named.place(of), u32::min);
        }
        named.name = name;
        named.sort_slots();
        named
    }

    fn place(&self, v: u32) -> u32 {
        self.inputs.get((v - FIRST) as usize).copied().unwrap_or(v - FIRST)
    }

    /// Sorts slots by counting. The cells, which are large, are read once.
    fn sort_slots(&mut self) {
        let none = self.replay.points.len();
        let smallest = |[a, b, c, d]: [u32; 4]| a.min(b).min(c.min(d));
        let of = |v: Option<[u32; 4]>| v.map_or(none as u32, |v| smallest(v.map(|v| self.name[v as usize])));
        let mut first = Vec::with_capacity(self.replay.mesh.slot_count() as usize);
        first.extend(self.replay.mesh.corner_lists().map(of));
        let mut ends = vec![0; none + 1];
        first.iter().for_each(|&a| ends[a as usize] += 1);
        let mut sum = 0;
        for end in &mut ends {
            sum += std::mem::replace(end, sum);
        }
        // Filling moves each start to its end. Slots without a simplex come last.
        let mut slots = vec![0; first.len()];
        for (c, &a) in (0..).zip(&first) {
            let end = &mut ends[a as usize];
            slots[*end as usize] = c;
            *end += 1;
        }
        ends.truncate(none);
        slots.truncate(ends.last().map_or(0, |&end| end as usize));
        (self.slots, self.ends) = (slots, ends);
    }

    /// How many simplices there are.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Shows the simplices, canonical and ascending, many at a time: as many ids each as their dimension has.
    fn visit(&self, mut see: impl FnMut(&[VertexId])) {
        let size = 4 - self.replay.apexes as usize;
        let (mut fetched, mut run, mut flat, mut from) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for ends in self.ends.chunks(BLOCK) {
            let to = ends.last().map_or(from, |&end| end as usize);
            fetched.clear();
            fetched.extend(self.slots[from..to].iter().map(|&c| self.replay.mesh.cell(c).v));
            run.clear();
            run.extend(fetched.iter().map(|&v| self.simplex(v)));
            let mut begin = 0;
            for end in ends.iter().map(|&end| end as usize - from) {
                // Of equal first ids. One number is compared sooner than three.
                run[begin..end].sort_unstable_by_key(|[_, b, c, d]| {
                    u128::from(b.0) << 64 | u128::from(c.0) << 32 | u128::from(d.0)
                });
                begin = end;
            }
            from = to;
            if size == 4 {
                see(run.as_flattened());
            } else {
                flat.clear();
                flat.extend(run.iter().flat_map(|t| &t[..size]));
                see(&flat);
            }
        }
    }

    /// The canonical tuple of some corners; where apexes fill it up, ascending.
    fn simplex(&self, v: [u32; 4]) -> Tetrahedron {
        let mut named = v.map(|v| VertexId(self.name[v as usize]));
        if self.replay.apexes == 0 {
            return canonical_tetrahedron(named);
        }
        named.sort_unstable();
        named
    }

    /// The number of the point at each place.
    fn numbers(&self) -> Vec<u32> {
        let mut numbers = vec![NONE; self.replay.points.len()];
        self.replay.points.iter().for_each(|(v, _)| numbers[self.place(v) as usize] = v);
        numbers
    }

    /// What became of a point.
    fn state(&self, v: u32) -> PointState {
        let all = &self.replay.points;
        let stands = if let State::Duplicate(of) = all.state(v) { of } else { v };
        let first = self.name[stands as usize];
        match all.state(stands) {
            _ if first != self.place(v) => PointState::Duplicate { of: VertexId(first) },
            State::Vertex => PointState::Vertex,
            State::Hidden => PointState::Hidden,
            _ => PointState::Removed,
        }
    }

    fn dimension(&self) -> Option<u8> {
        (!self.replay.is_empty()).then_some(3 - self.replay.apexes as u8)
    }

    /// The triangulation as data.
    pub fn triangulation(&self, unscaled: impl Fn(WeightedPoint) -> WeightedPoint) -> Triangulation3 {
        let numbers = self.numbers();
        let points = numbers.iter().map(|&v| unscaled(self.replay.mesh.point(v))).collect();
        let states = numbers.iter().map(|&v| self.state(v)).collect();
        let mut simplices = Vec::new();
        self.visit(|ids| simplices.extend_from_slice(ids));
        Triangulation3 { points, states, dimension: self.dimension(), simplices }
    }

    /// Its digest, without having it.
    pub fn digest(&self, unscaled: impl Fn(WeightedPoint) -> WeightedPoint) -> String {
        let numbers = self.numbers();
        let points = numbers.iter().map(|&v| unscaled(self.replay.mesh.point(v)));
        let states = numbers.iter().map(|&v| self.state(v));
        let mut digest = TriangulationDigest::new(points, states, self.dimension(), self.len());
        self.visit(|ids| digest.simplices(ids));
        digest.finish()
    }
}
