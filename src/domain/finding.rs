//! What is found in an input: each finding typed, located and with its remedy.
//!
//! Ids in findings are positions in the input counted from 0, in the order of the file; lines of the file are counted from 1.

use crate::model::words::listed;
use crate::model::{Lines, Point2, Point3, Pslg, SegmentId, VertexId};
use serde::ser::{Serialize, SerializeStruct, Serializer};
use std::fmt;

/// How many findings of one kind are listed; the number of the others is told in one more finding.
pub const LISTED_PER_KIND: usize = 1000;

/// What follows from a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// The input is refused.
    Error,
    /// Resolved without a new coordinate and without loss.
    Repair,
    /// Worth knowing; never refused.
    Note,
}

/// The kinds of findings, by severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Error: a coordinate, attribute or bound is not a finite number.
    NotFinite,
    /// Error: a number is too large or too small to be computed with exactly.
    OutOfRange,
    /// Error: a segment names a vertex that does not exist.
    BadIndex,
    /// Error: two vertices have the same coordinates.
    CoincidentVertices,
    /// Error: two segments cross where no vertex is.
    Crossing,
    /// Error: under `Fill::Parity`, an odd number of toggling segments meet in a vertex: they close no cycle, and inside cannot be told from outside.
    OpenCycle,
    /// Error: segments enclose no face.
    NoClosedRegion,
    /// Error: a hole or region seed lies on a segment.
    SeedOnSegment,
    /// Error: a hole or region seed lies in no face that could be meshed.
    SeedOutside,
    /// Error: two region seeds lie in one face.
    SeedsInOneFace,
    /// Repair: a vertex lies exactly on a segment, which becomes parts.
    VertexOnSegment,
    /// Repair: two segments share a piece of positive length, which is kept once.
    Overlap,
    /// Repair: two segments have the same ends; one is kept.
    DoubledSegment,
    /// Repair: a segment joins a vertex to itself; it is dropped.
    ZeroLength,
    /// Note: two segments meet in an angle below 60 degrees.
    SmallAngle,
    /// Note: no other segment meets an end of a segment.
    DanglingSegment,
    /// Note: a vertex belongs to no segment.
    IsolatedVertex,
    /// Note: a vertex or segment lies in no part that is meshed.
    Outside,
    /// Note: holes take everything that segments enclose; the mesh is empty.
    NothingLeft,
}

impl Kind {
    /// What follows from a finding of this kind.
    pub fn severity(self) -> Severity {
        use Kind::*;
        match self {
            NotFinite | OutOfRange | BadIndex | CoincidentVertices | Crossing | OpenCycle | NoClosedRegion
            | SeedOnSegment | SeedOutside | SeedsInOneFace => Severity::Error,
            VertexOnSegment | Overlap | DoubledSegment | ZeroLength => Severity::Repair,
            SmallAngle | DanglingSegment | IsolatedVertex | Outside | NothingLeft => Severity::Note,
        }
    }

    /// What to do about it: the advice given with every finding of this kind.
    pub fn fix(self) -> &'static str {
        use Kind::*;
        match self {
            NotFinite => "give a finite decimal number",
            OutOfRange => "scale or shift the input; write 0 for a number that is meant to be 0",
            BadIndex => {
                "correct the index; in .poly files the first vertex is numbered 0 or 1 and that numbering holds throughout"
            }
            CoincidentVertices => "keep one of the vertices and let the segments refer to it",
            Crossing => "put a vertex at the crossing and split both segments there",
            OpenCycle => "let every ring of toggling segments close, or let the loose ones not toggle",
            NoClosedRegion => "close the boundary with segments, or mesh the convex hull (--convex)",
            SeedOnSegment => "move the seed off the segment, into the face it stands for",
            SeedOutside => "move the seed into the face it stands for, or remove it",
            SeedsInOneFace => "remove one of the seeds, or close the boundary between them",
            VertexOnSegment => "none needed: the segment is taken as its parts, in order",
            Overlap => "none needed: the common piece is kept once, with the first segment's marker",
            DoubledSegment => "none needed: the segment is kept once, with the first one's marker",
            ZeroLength => "none needed: the segment is dropped",
            SmallAngle => "none needed: triangles that the angle makes skinny are left and listed",
            DanglingSegment => "none needed; if a boundary was meant to close here, connect the end",
            IsolatedVertex => "none needed: it becomes a vertex of the mesh if it lies in the region",
            NothingLeft => "move the hole seeds, close the boundary around them, or mesh the convex hull (--convex)",
            Outside => "none needed: it is left out; if it was meant to be meshed, close the boundary around it",
        }
    }
}

/// An element of the input, by its position counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Element {
    /// A vertex.
    Vertex(VertexId),
    /// A segment.
    Segment(SegmentId),
    /// A hole seed.
    Hole(u32),
    /// A region seed.
    Region(u32),
}

impl Element {
    /// Its line in the file, if known.
    fn line(self, lines: &Lines) -> Option<u32> {
        let (list, i) = match self {
            Element::Vertex(v) => (&lines.points, v.index()),
            Element::Segment(s) => (&lines.segments, s.index()),
            Element::Hole(i) => (&lines.holes, i as usize),
            Element::Region(i) => (&lines.regions, i as usize),
        };
        list.get(i).copied().filter(|&l| l > 0)
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Element::Vertex(v) => write!(f, "vertex {}", v.0),
            Element::Segment(s) => write!(f, "segment {}", s.0),
            Element::Hole(i) => write!(f, "hole {i}"),
            Element::Region(i) => write!(f, "region {i}"),
        }
    }
}

/// One finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What was found.
    pub kind: Kind,
    /// The elements concerned; empty in the finding that tells how many more of its kind there are.
    pub elements: Vec<Element>,
    /// Where: points in input units; that of a crossing is rounded.
    pub coordinates: Vec<Point2>,
    /// Where in space: points in input units. Of a finding in the plane none.
    pub places: Vec<Point3>,
    /// Lines of the file, one-based, of those elements whose line is known.
    pub lines: Vec<u32>,
    /// One sentence.
    pub message: String,
}

impl Finding {
    /// A finding about some elements at some places; the lines are looked up.
    pub fn new(kind: Kind, elements: Vec<Element>, coordinates: Vec<Point2>, lines: &Lines, message: String) -> Self {
        let lines = elements.iter().filter_map(|e| e.line(lines)).collect();
        Finding { kind, elements, coordinates, places: Vec::new(), lines, message }
    }

    /// A finding about a point of space. Its line is known if it is positive.
    pub fn in_space(kind: Kind, v: VertexId, at: Point3, line: u32, message: String) -> Self {
        let lines = [line].into_iter().filter(|&l| l > 0).collect();
        Finding { kind, elements: vec![Element::Vertex(v)], coordinates: Vec::new(), places: vec![at], lines, message }
    }

    /// What follows from it.
    pub fn severity(&self) -> Severity {
        self.kind.severity()
    }

    /// What to do about it.
    pub fn fix(&self) -> &'static str {
        self.kind.fix()
    }

    /// A vertex in which these toggling segments meet, an odd number.
    pub fn open_cycle(v: VertexId, meeting: &[SegmentId], pslg: &Pslg, lines: &Lines) -> Self {
        let at = pslg.points.get(v.index()).copied().unwrap_or_default();
        let message = format!(
            "the toggling segments do not close up at vertex {} ({}, {}): an odd number of them meet there",
            v.0, at.x, at.y
        );
        let elements = [Element::Vertex(v)].into_iter().chain(meeting.iter().map(|&s| Element::Segment(s))).collect();
        Finding::new(Kind::OpenCycle, elements, vec![at], lines, message)
    }

    /// Segments enclose no face.
    pub fn no_closed_region() -> Self {
        let message = "the segments enclose no region: there is nothing to mesh".into();
        Finding::new(Kind::NoClosedRegion, Vec::new(), Vec::new(), &Lines::default(), message)
    }

    /// Holes take every face that segments enclose.
    pub fn nothing_left(pslg: &Pslg, lines: &Lines) -> Self {
        let message = "the holes take all that the segments enclose: the mesh is empty".into();
        let holes = (0u32..).zip(&pslg.holes).map(|(i, _)| Element::Hole(i)).collect();
        Finding::new(Kind::NothingLeft, holes, pslg.holes.clone(), lines, message)
    }

    /// A seed that lies on a segment or vertex.
    pub fn seed_on_segment(seed: Element, pslg: &Pslg, lines: &Lines) -> Self {
        let message = format!("the seed of {seed} lies on a segment or vertex, so that it names no face");
        Finding::new(Kind::SeedOnSegment, vec![seed], seed_point(seed, pslg), lines, message)
    }

    /// A seed in no face that could be meshed.
    pub fn seed_outside(seed: Element, pslg: &Pslg, lines: &Lines) -> Self {
        let message = format!("the seed of {seed} lies outside of what is meshed");
        Finding::new(Kind::SeedOutside, vec![seed], seed_point(seed, pslg), lines, message)
    }

    /// Two region seeds in one face.
    pub fn seeds_in_one_face(first: u32, second: u32, pslg: &Pslg, lines: &Lines) -> Self {
        let message = format!("the seeds of regions {first} and {second} lie in one face");
        let elements = vec![Element::Region(first), Element::Region(second)];
        let at = elements.iter().flat_map(|&e| seed_point(e, pslg)).collect();
        Finding::new(Kind::SeedsInOneFace, elements, at, lines, message)
    }
}

fn seed_point(seed: Element, pslg: &Pslg) -> Vec<Point2> {
    let at = match seed {
        Element::Hole(i) => pslg.holes.get(i as usize).copied(),
        Element::Region(i) => pslg.regions.get(i as usize).map(|r| r.seed),
        Element::Vertex(_) | Element::Segment(_) => None,
    };
    at.into_iter().collect()
}

impl Serialize for Finding {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut s = serializer.serialize_struct("Finding", 8)?;
        s.serialize_field("severity", &self.severity())?;
        s.serialize_field("kind", &self.kind)?;
        s.serialize_field("elements", &self.elements)?;
        let plane = self.coordinates.iter().map(|p| p.to_array().to_vec());
        let space = self.places.iter().map(|p| p.to_array().to_vec());
        s.serialize_field("coordinates", &plane.chain(space).collect::<Vec<_>>())?;
        s.serialize_field("line", &self.lines.first())?;
        s.serialize_field("lines", &self.lines)?;
        s.serialize_field("message", &self.message)?;
        s.serialize_field("fix", self.fix())?;
        s.end()
    }
}

/// `error: crossing: segments 3 and 7 cross at (1.5, 2) (lines 12, 16); fix: ...`
impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity() {
            Severity::Error => "error",
            Severity::Repair => "repair",
            Severity::Note => "note",
        };
        write!(f, "{severity}: {}", self.message)?;
        if !self.lines.is_empty() {
            write!(f, " ({})", listed("line", &self.lines, 8))?;
        }
        write!(f, "; fix: {}", self.fix())
    }
}

/// Collects findings, at most `LISTED_PER_KIND` of a kind; says of each kind how many were not listed.
#[derive(Debug, Default)]
pub struct Findings {
    listed: Vec<Finding>,
    /// Kind, number found, whether there may be more that nobody counted. Few entries: a kind each.
    counts: Vec<(Kind, u64, bool)>,
}

impl Findings {
    /// Counts a finding and lists it if its kind has room; `make` runs only then.
    pub fn add(&mut self, kind: Kind, make: impl FnOnce() -> Finding) {
        let entry = self.entry(kind);
        entry.1 += 1;
        if entry.1 <= LISTED_PER_KIND as u64 {
            self.listed.push(make());
        }
    }

    /// Counts `more` findings of a kind that are not made; `at_least` says that the counting was cut short.
    pub(super) fn uncounted(&mut self, kind: Kind, more: u64, at_least: bool) {
        let entry = self.entry(kind);
        entry.1 += more;
        entry.2 |= at_least;
    }

    fn entry(&mut self, kind: Kind) -> &mut (Kind, u64, bool) {
        let i = self.counts.iter().position(|e| e.0 == kind).unwrap_or_else(|| {
            self.counts.push((kind, 0, false));
            self.counts.len() - 1
        });
        &mut self.counts[i]
    }

    /// Whether an error was added.
    pub fn any_error(&self) -> bool {
        self.counts.iter().any(|e| e.0.severity() == Severity::Error && e.1 > 0)
    }

    /// All findings, errors first, kinds together, within a kind as added; after a full list the number of the others.
    pub fn finish(mut self) -> Vec<Finding> {
        for (kind, count, at_least) in self.counts {
            let listed = self.listed.iter().filter(|f| f.kind == kind).count() as u64;
            if count > listed || at_least {
                let more = if at_least { "at least " } else { "" };
                self.listed.push(Finding {
                    kind,
                    elements: Vec::new(),
                    coordinates: Vec::new(),
                    places: Vec::new(),
                    lines: Vec::new(),
                    message: format!("{more}{} more of this kind, {more}{count} in all", count - listed),
                });
            }
        }
        self.listed.sort_by_key(|f| f.kind);
        self.listed
    }
}

/// Puts further findings among others, kept in the order of `Findings::finish`.
pub fn merge_findings(findings: &mut Vec<Finding>, more: Vec<Finding>) {
    findings.extend(more);
    findings.sort_by_key(|f| f.kind);
}
