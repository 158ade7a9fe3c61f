//! The order in which records of space stand, and which ids they may name.

use super::record::{Apex, Event3, INFINITE, Record3, apex_id};
use crate::model::{Tetrahedron, VertexId, WeightedPoint};
use crate::trace::grammar::{finite_numbers, holds, is_digest};

/// Where a trace of space stands between two records.
#[derive(Clone, Debug, Default)]
pub(in crate::trace) struct State3 {
    stage: Stage,
    pub(super) weighted: bool,
    pub(super) permuted: bool,
    /// How many vertices were stated.
    pub(super) vertices: u32,
    /// 1 + the largest id that the start or an event has placed: what ids in tuples are counted down from.
    pub(super) cursor: u32,
    /// How many ids a simplex of `start` has.
    pub(in crate::trace) size: usize,
    pub(super) previous: Option<Tetrahedron>,
    simplices_left: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Stage {
    #[default]
    Fresh,
    Domain,
    Started,
    Ended,
}

impl State3 {
    pub(in crate::trace) fn is_fresh(&self) -> bool {
        self.stage == Stage::Fresh
    }

    /// The part of the trace that the next record belongs to, if that is no event.
    pub(in crate::trace) fn part(&self) -> Option<&'static str> {
        match self.stage {
            Stage::Fresh => Some("header"),
            Stage::Domain => Some("input"),
            Stage::Started if self.simplices_left > 0 => Some("start"),
            Stage::Started => None,
            Stage::Ended => Some("end"),
        }
    }

    pub(in crate::trace) fn ended(&self) -> bool {
        self.stage == Stage::Ended
    }

    pub(in crate::trace) fn check(&self, record: &Record3) -> Result<(), &'static str> {
        if let Record3::Header(_) = record {
            return holds(self.stage == Stage::Fresh, "a second header");
        }
        holds(self.stage != Stage::Fresh, "the header is missing")?;
        holds(self.stage != Stage::Ended, "a record after the end")?;
        let whole = self.simplices_left == 0;
        match record {
            Record3::Header(_) => Ok(()),
            Record3::Vertex { point, input } => {
                holds(whole, "a vertex among the simplices of `start`")?;
                finite(*point)?;
                holds(
                    self.weighted || point.weight.to_bits() == 0,
                    "a weight where the header says that there is none",
                )?;
                let told = input.is_some() == self.permuted;
                holds(told, "a vertex says where it stood exactly if the header says so")?;
                holds(self.vertices < VERTICES, "too many vertices")
            }
            Record3::Weight { id, weight } => {
                self.running()?;
                holds(self.weighted, "a weight where the header says that there is none")?;
                finite_numbers(&[*weight])?;
                holds(id.0 < self.cursor, "the point was not placed yet")
            }
            Record3::Remove { id } => {
                self.running()?;
                self.placed(*id)
            }
            Record3::Start { apexes, simplices } => {
                holds(self.stage == Stage::Domain, "a second start")?;
                let sane = if *simplices == 0 { apexes.is_empty() } else { apexes.len() <= 3 };
                holds(sane, "at most three apexes, and none without simplices")
            }
            Record3::Simplex(t) => {
                let left = self.stage == Stage::Started && !whole;
                holds(left, "a simplex beyond those announced by `start`")?;
                self.simplex(t)
            }
            Record3::Event(event) => {
                self.running()?;
                self.event(event)
            }
            Record3::End(end) => {
                self.running()?;
                holds(is_digest(&end.mesh), "the digest of the mesh is not 64 lowercase hexadecimal digits")
            }
        }
    }

    /// Goes past a record that `check` has accepted.
    pub(in crate::trace) fn advance(&mut self, record: &Record3) {
        match record {
            Record3::Header(h) => {
                (self.weighted, self.permuted) = (h.weighted, h.permuted);
                self.stage = Stage::Domain;
            }
            Record3::Vertex { .. } => self.vertices += 1,
            Record3::Weight { .. } | Record3::Remove { .. } => {}
            Record3::Start { apexes, simplices } => {
                self.stage = Stage::Started;
                self.simplices_left = *simplices;
                self.size = 4 - apexes.len();
            }
            Record3::Simplex(t) => {
                self.simplices_left -= 1;
                self.previous = Some(*t);
                let last = t[..self.size].iter().map(|v| v.0).max();
                self.cursor = self.cursor.max(last.map_or(0, |v| v + 1));
            }
            Record3::Event(event) => {
                if let Event3::Insert { id, .. }
                | Event3::Hide { id, .. }
                | Event3::Duplicate { id, .. }
                | Event3::Raise { id, .. } = event
                {
                    self.cursor = self.cursor.max(id.0 + 1);
                }
            }
            Record3::End(_) => self.stage = Stage::Ended,
        }
    }

    fn running(&self) -> Result<(), &'static str> {
        holds(self.stage == Stage::Started, "`start` is missing")?;
        holds(self.simplices_left == 0, "`start` has fewer simplices than it announced")
    }

    fn simplex(&self, t: &Tetrahedron) -> Result<(), &'static str> {
        let (own, filler) = t.split_at(self.size);
        let filled = filler.iter().zip(0..).all(|(v, k)| *v == apex_id(k));
        holds(filled, "the apexes do not follow a simplex in order")?;
        let known = own.iter().all(|v| v.0 < self.vertices);
        holds(known, "no vertex has this id yet")?;
        let ascending = match own {
            [a, b, c, d] => a < b && b < c.min(d) && c != d,
            own => own.is_sorted_by(|a, b| a < b),
        };
        holds(ascending, "the ids of a simplex are not in canonical order")?;
        holds(self.previous.is_none_or(|p| p < *t), "simplices of `start` are not in ascending order")
    }

    fn event(&self, event: &Event3) -> Result<(), &'static str> {
        match event {
            Event3::Insert { id, first, .. } => {
                self.placeable(*id)?;
                self.cell(first)
            }
            Event3::Hide { id, cell } => {
                self.placeable(*id)?;
                self.cell(cell)
            }
            Event3::Duplicate { id, of } => {
                self.placeable(*id)?;
                self.placed(*of)
            }
            Event3::Remove { id, created } => {
                self.placed(*id)?;
                created.iter().try_for_each(|&v| if v.0 >= SPECIAL { Ok(()) } else { self.placed(v) })
            }
            Event3::Succeed { id, by } => {
                self.placed(*id)?;
                self.placed(*by)
            }
            Event3::Raise { id, apexes } => {
                self.placeable(*id)?;
                few(apexes)
            }
            Event3::Lower { id, apexes } => {
                self.placed(*id)?;
                few(apexes)
            }
        }
    }

    /// A point that an event may place: the next one, or one placed before.
    fn placeable(&self, id: VertexId) -> Result<(), &'static str> {
        holds(id.0 < self.vertices, "no vertex has this id yet")?;
        // Vertices that `start` leaves out may have any smaller id.
        holds(id.0 <= self.cursor, "an event passes over a vertex")
    }

    fn placed(&self, id: VertexId) -> Result<(), &'static str> {
        holds(id.0 < self.cursor, "the point was not placed yet")
    }

    /// A cell's tuple: canonical, of placed points, apexes and the infinite vertex.
    fn cell(&self, t: &Tetrahedron) -> Result<(), &'static str> {
        let [a, b, c, d] = *t;
        holds(a < b && b < c.min(d) && c != d, "the ids of a cell are not in canonical order")?;
        t.iter().try_for_each(|&v| if v.0 >= SPECIAL { Ok(()) } else { self.placed(v) })
    }
}

/// The smallest id that stands for no point: the third apex.
pub(super) const SPECIAL: u32 = apex_id(2).0;

/// One more than the largest number of points: ids and the numbers of apexes fit a signed 32-bit integer.
const VERTICES: u32 = i32::MAX as u32 - 3;

const _: () = assert!(INFINITE.0 - SPECIAL == 3);

fn few(apexes: &[Apex]) -> Result<(), &'static str> {
    holds(apexes.len() <= 3, "more than three apexes")
}

fn finite(p: WeightedPoint) -> Result<(), &'static str> {
    finite_numbers(&[p.at.x, p.at.y, p.at.z, p.weight])
}
