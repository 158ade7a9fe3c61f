//! What a verification ends in.

use std::fmt;

/// The result of a verification.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every fact that could be checked holds.
    Accepted {
        /// Number of events.
        events: u64,
        /// Facts that were not checked.
        unchecked: Vec<Unchecked>,
    },
    /// A fact does not hold.
    Rejected(Rejection),
}

/// A fact left unchecked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unchecked {
    /// The rule.
    pub rule: Rule,
    /// Why it was not checked.
    pub reason: &'static str,
}

/// The first fact that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// Where.
    pub event: Place,
    /// The rule broken.
    pub rule: Rule,
    /// What the rule asks for.
    pub expected: String,
    /// What the trace says.
    pub found: String,
}

/// A place in a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The header.
    Header,
    /// The input's records.
    Domain,
    /// The initial triangulation.
    Start,
    /// An event, by number.
    Event(u64),
    /// The end record.
    End,
}

/// The rules of the checker. Letters and digits are rows of `docs/gcdr.md`; the others are facts about the records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Rule {
    /// The order of records.
    Stream,
    /// Sane parameters.
    Header,
    /// The level promised follows from parameters and input.
    Level,
    /// Sane input: finite, in range, ids in range, seeds inside a face.
    Domain,
    /// `start` is a triangulation of the convex hull that holds every vertex.
    Triangulation,
    /// Every segment is a chain of edges.
    Segment,
    /// Locally Delaunay, under the one tie-break.
    Delaunay,
    /// Canonical form and order.
    Canonical,
    /// A coordinate is finite, in range, and +0 where zero.
    Coordinate,
    /// A triangle named by an event is in the mesh.
    Exists,
    /// The triangle is bad for the cause named.
    Cause,
    /// The destroyed triangles are the flood's.
    Flood,
    /// The star of the new vertex, or the filling of the old one's, is positively oriented and complete.
    Star,
    /// A removal precedes the split that justifies it.
    Removal,
    /// The reason of a skip holds.
    Skip,
    /// A shell label holds.
    Shell,
    A1,
    A2,
    A3,
    A4,
    A5,
    S1,
    S2,
    S3,
    B1,
    B2,
    B3,
    B4,
    B5,
    B6,
    C1,
    C2,
    C4,
    /// No bad triangle is left unlisted.
    F3,
    /// The outcome follows from the events.
    Outcome,
    /// Counts.
    Counts,
    /// Digest of the mesh or of the trace.
    Digest,
    /// Strict: the triangle is the next one.
    Queue,
    /// Strict: the stored point is the correctly rounded one of its choice.
    Choice,
    /// Strict: the set and order of removals.
    Removals,
    /// A row with local feature size or density.
    Spacing,
    /// In space: every tetrahedron is positively oriented.
    Orientation,
    /// In space: every facet has a cell on each side.
    Closed,
    /// In space: the hull is convex, and covered once.
    Hull,
    /// In space: every orthoball is empty.
    Regular,
    /// In space: a hidden point is not in conflict with the tetrahedron that contains it.
    Hidden,
    /// In space: a duplicate has the place and weight of the point that stands for it.
    Duplicate,
    /// In space: points are placed each once, and in order.
    Order,
    /// In space: the points span the dimension that the trace says.
    Dimension,
    /// In space: the Euler characteristic of the closed complex.
    Euler,
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Header => f.write_str("header"),
            Place::Domain => f.write_str("input"),
            Place::Start => f.write_str("start"),
            Place::Event(i) => write!(f, "event {i}"),
            Place::End => f.write_str("end"),
        }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: rule {}: expected {}, found {}", self.event, self.rule, self.expected, self.found)
    }
}

/// A rule's answer before the place is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The rule.
    pub rule: Rule,
    /// What it asks for.
    pub expected: String,
    /// What was there.
    pub found: String,
}

/// The answer of one rule.
pub type Checked<T = ()> = Result<T, Broken>;

/// A refusal.
pub fn broken<T>(rule: Rule, expected: impl Into<String>, found: impl Into<String>) -> Checked<T> {
    Err(Broken { rule, expected: expected.into(), found: found.into() })
}

/// Passes if the fact holds; else the two texts are made.
pub fn ensure<E: Into<String>, F: Into<String>>(holds: bool, rule: Rule, texts: impl FnOnce() -> (E, F)) -> Checked {
    if holds {
        return Ok(());
    }
    let (expected, found) = texts();
    broken(rule, expected, found)
}

/// Gives a broken rule its place.
pub fn placed(broken: Broken, event: Place) -> Rejection {
    Rejection { event, rule: broken.rule, expected: broken.expected, found: broken.found }
}
