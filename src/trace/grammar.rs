//! The order in which records stand, and which ids they may name. Both forms and both directions obey it, so that a record that one of
//! them can express the other can express too. What a record claims about geometry is the checker's to judge.

use super::record::{Algorithm, Cause, End, Event, Record, SkipReason, SplitKind, Why};
use super::space::Record3;
use super::space::grammar::State3;
use crate::model::{Edge, Point2, Triangle, VertexId};

/// Where a trace stands between two records: all that the next record's form depends on.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    stage: Stage,
    /// Of a trace of space.
    pub(super) space: State3,
    /// The id that the next vertex will get; every id named must be below it.
    pub(super) next: u32,
    /// The number that the next event will get.
    pub(super) events: u64,
    /// The last triangle of `start` so far.
    pub(super) previous: Option<Triangle>,
    segments: u32,
    attributes: usize,
    triangles_left: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    #[default]
    Fresh,
    Vertices,
    Segments,
    Holes,
    Regions,
    Started,
    Ended,
}

impl State {
    /// Whether the last record was read or written.
    pub(super) fn ended(&self) -> bool {
        self.stage == Stage::Ended || self.space.ended()
    }

    /// The part of the trace that the next record belongs to: `header`, `input` or `start`; `end` after the last one; else `None`: an event is due, or the end.
    pub(super) fn part(&self) -> Option<&'static str> {
        if !self.space.is_fresh() {
            return self.space.part();
        }
        match self.stage {
            Stage::Fresh => Some("header"),
            Stage::Vertices | Stage::Segments | Stage::Holes | Stage::Regions => Some("input"),
            Stage::Started if self.triangles_left > 0 => Some("start"),
            Stage::Started => None,
            Stage::Ended => Some("end"),
        }
    }

    /// What may not be said now. `Ok` means that both forms can express the record.
    pub(super) fn check(&self, record: &Record) -> Result<(), &'static str> {
        match record {
            Record::Header(header) => {
                holds(self.stage == Stage::Fresh && self.space.is_fresh(), "a second header")?;
                match &header.algorithm {
                    Algorithm::Delaunay => Ok(()),
                    Algorithm::Gcdr(p) => {
                        let numbers = [p.rho2, p.d1, p.d2, p.mu].into_iter().chain(p.kappa).chain(p.max_area);
                        holds(numbers.into_iter().all(f64::is_finite), "a parameter is not finite")
                    }
                }
            }
            Record::Vertex { at, attributes, .. } => {
                self.in_domain(Stage::Vertices)?;
                finite(*at)?;
                holds(attributes.iter().all(|a| a.is_finite()), "an attribute is not finite")?;
                holds(
                    self.next == 0 || attributes.len() == self.attributes,
                    "vertices differ in their number of attributes",
                )?;
                holds(self.next < u32::MAX, "too many vertices")
            }
            Record::Segment(segment) => {
                self.in_domain(Stage::Segments)?;
                holds(self.segments < u32::MAX, "too many segments")?;
                segment.ends.iter().try_for_each(|&v| self.known(v))
            }
            Record::Hole(at) => self.in_domain(Stage::Holes).and_then(|()| finite(*at)),
            Record::Region(region) => {
                self.in_domain(Stage::Regions)?;
                finite(region.seed)?;
                let bound = region.max_area.is_none_or(f64::is_finite);
                holds(region.attribute.is_finite() && bound, "a number of the region is not finite")
            }
            Record::Start { .. } => self.in_domain(Stage::Regions),
            Record::Triangle(t) => {
                holds(
                    self.stage == Stage::Started && self.triangles_left > 0,
                    "a triangle beyond those announced by `start`",
                )?;
                self.triangle(*t)?;
                holds(self.previous.is_none_or(|p| p < *t), "triangles of `start` are not in ascending order")
            }
            Record::Event(event) => {
                self.running()?;
                self.event(event)
            }
            Record::End(end) => {
                self.running()?;
                self.end(end)
            }
            Record::Space(record) => {
                holds(self.stage == Stage::Fresh, "a record of space in a trace of the plane")?;
                self.space.check(record)
            }
        }
    }

    /// Goes past a record that `check` has accepted.
    pub(super) fn advance(&mut self, record: &Record) {
        match record {
            Record::Header(_) => self.stage = Stage::Vertices,
            Record::Vertex { attributes, .. } => {
                self.attributes = attributes.len();
                self.next += 1;
            }
            Record::Segment(_) => {
                self.stage = Stage::Segments;
                self.segments += 1;
            }
            Record::Hole(_) => self.stage = Stage::Holes,
            Record::Region(_) => self.stage = Stage::Regions,
            Record::Start { triangles } => {
                self.stage = Stage::Started;
                self.triangles_left = *triangles;
            }
            Record::Triangle(t) => {
                self.triangles_left -= 1;
                self.previous = Some(*t);
            }
            Record::Event(event) => {
                self.events += 1;
                if matches!(event, Event::Insert { .. }) {
                    self.next += 1;
                }
            }
            Record::End(_) => self.stage = Stage::Ended,
            Record::Space(record) => {
                self.events += u64::from(matches!(record, Record3::Event(_)));
                self.space.advance(record);
            }
        }
    }

    fn in_domain(&self, stage: Stage) -> Result<(), &'static str> {
        holds(self.stage != Stage::Fresh, "the header is missing")?;
        holds(
            self.stage <= stage,
            "records are out of order (header, vertices, segments, holes, regions, start, triangles, events, end)",
        )
    }

    fn running(&self) -> Result<(), &'static str> {
        holds(self.stage != Stage::Fresh, "the header is missing")?;
        holds(self.stage != Stage::Ended, "a record after the end")?;
        holds(self.stage == Stage::Started, "`start` is missing")?;
        holds(self.triangles_left == 0, "fewer triangles than `start` announced")
    }

    fn event(&self, event: &Event) -> Result<(), &'static str> {
        match event {
            Event::Insert { p, why, destroyed } => {
                holds(self.next < u32::MAX, "too many vertices")?;
                finite(*p)?;
                self.why(why)?;
                destroyed.iter().try_for_each(|&t| self.triangle(t))
            }
            Event::Remove { id, created } => {
                self.known(*id)?;
                created.iter().try_for_each(|&t| self.triangle(t))
            }
            Event::Skip { t, cause, reason } => {
                self.triangle(*t)?;
                sized(cause)?;
                match reason {
                    SkipReason::Resolution => Ok(()),
                    SkipReason::InputAngle { apex } => self.known(*apex),
                    SkipReason::SplitLimit { segment } => {
                        holds(segment.0 < self.segments, "no segment has this number")
                    }
                }
            }
        }
    }

    fn why(&self, why: &Why) -> Result<(), &'static str> {
        match why {
            Why::Free { cause } => sized(cause),
            Why::Split { kind, s, t, cause, a, shell } => {
                self.edge(*s)?;
                self.triangle(*t)?;
                sized(cause)?;
                finite(*a)?;
                if let SplitKind::C { parent } = kind {
                    self.known(*parent)?;
                }
                shell.map_or(Ok(()), |shell| self.known(shell.apex))
            }
        }
    }

    fn end(&self, end: &End) -> Result<(), &'static str> {
        holds(is_digest(&end.mesh), "the digest of the mesh is not 64 lowercase hexadecimal digits")
    }

    fn known(&self, id: VertexId) -> Result<(), &'static str> {
        holds(id.0 < self.next, "no vertex has this id yet")
    }

    fn edge(&self, [u, v]: Edge) -> Result<(), &'static str> {
        holds(u < v, "an edge does not name its smaller id first")?;
        self.known(v)
    }

    fn triangle(&self, [a, b, c]: Triangle) -> Result<(), &'static str> {
        holds(a < b && a < c && b != c, "a triangle does not name its smallest id first, or names one twice")?;
        self.known(b)?;
        self.known(c)
    }
}

/// Whether the text is the hexadecimal form of 32 bytes, lower case.
pub(super) fn is_digest(text: &str) -> bool {
    text.len() == 64 && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'))
}

fn sized(cause: &Cause) -> Result<(), &'static str> {
    match cause {
        Cause::Skinny | Cause::Area => Ok(()),
        Cause::Size { h } => holds(h.is_finite(), "the value of the size function is not finite"),
    }
}

/// Whether all are finite.
pub(super) fn finite_numbers(numbers: &[f64]) -> Result<(), &'static str> {
    holds(numbers.iter().all(|x| x.is_finite()), "a number is not finite")
}

fn finite(p: Point2) -> Result<(), &'static str> {
    holds(p.x.is_finite() && p.y.is_finite(), "a coordinate is not finite")
}

pub(super) fn holds(fact: bool, otherwise: &'static str) -> Result<(), &'static str> {
    if fact { Ok(()) } else { Err(otherwise) }
}
