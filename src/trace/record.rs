//! What a trace says, record by record. `docs/trace-format.md` is the normative text.

use super::space::Record3;
use crate::model::{Edge, Fill, GcdrParameters, Level, Point2, Region, Segment, SegmentId, Triangle, VertexId};

/// One record of a trace. A trace is: header, vertices, segments, holes, regions, start, its triangles, events, end.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// The first record.
    Header(Header),
    /// A vertex of the input, in order of ids.
    Vertex {
        /// Coordinates in input units.
        at: Point2,
        /// Boundary marker, if the input had markers.
        marker: Option<i32>,
        /// Attributes; the same number for all vertices.
        attributes: Vec<f64>,
    },
    /// A segment of the (repaired) input, in order of ids.
    Segment(Segment),
    /// A hole seed.
    Hole(Point2),
    /// A region seed.
    Region(Region),
    /// How many triangles the initial triangulation (of the convex hull) has; they follow.
    Start {
        /// The number of `Triangle` records.
        triangles: u32,
    },
    /// A triangle of the initial triangulation; canonical, in ascending order.
    Triangle(Triangle),
    /// A step. Events are numbered from 0 in the order they stand.
    Event(Event),
    /// The last record.
    End(End),
    /// A record of a triangulation of space; then all are.
    Space(Record3),
}

impl Record {
    /// The digest of the trace, of an end record.
    pub fn trace_digest(&self) -> Option<&str> {
        match self {
            Record::End(end) => Some(&end.trace),
            Record::Space(Record3::End(end)) => Some(&end.trace),
            _ => None,
        }
    }

    /// An end record with this digest of the trace; any other record as it is.
    #[must_use]
    pub fn with_trace_digest(mut self, digest: &str) -> Record {
        if let Record::End(End { trace, .. }) | Record::Space(Record3::End(super::space::End3 { trace, .. })) =
            &mut self
        {
            *trace = digest.to_string();
        }
        self
    }

    /// Whether it is an event.
    pub fn is_event(&self) -> bool {
        matches!(self, Record::Event(_) | Record::Space(Record3::Event(_)))
    }
}

/// The head of a trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// What was run.
    pub algorithm: Algorithm,
    /// What the run promises; `None` for a plain triangulation.
    pub level: Option<Level>,
    /// Which faces are meshed.
    pub fill: Fill,
}

/// The algorithm of a run with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Algorithm {
    /// The constrained Delaunay triangulation of the input; no events follow.
    Delaunay,
    /// Constrained Delaunay refinement with selection regions.
    Gcdr(GcdrParameters),
}

/// A step of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A vertex is inserted; its id is the next one.
    Insert {
        /// Coordinates in input units.
        p: Point2,
        /// The reason.
        why: Why,
        /// The triangles that p destroys, in flood order (`docs/trace-format.md`); the created ones follow from them.
        destroyed: Vec<Triangle>,
    },
    /// A free vertex is deleted ahead of the split that follows.
    Remove {
        /// The vertex.
        id: VertexId,
        /// The triangles that fill its star, in ascending order.
        created: Vec<Triangle>,
    },
    /// A bad triangle is left as it is, for good.
    Skip {
        /// The triangle.
        t: Triangle,
        /// Why it is bad.
        cause: Cause,
        /// Why it stays.
        reason: SkipReason,
    },
}

/// Why a vertex is inserted.
#[derive(Clone, Debug, PartialEq)]
pub enum Why {
    /// Type-A: a point of the selection disk of the first destroyed triangle.
    Free {
        /// Why that triangle is bad.
        cause: Cause,
    },
    /// Type-B or Type-C: the Type-A point `a` of `t` encroaches on `s`.
    Split {
        /// Type-B or Type-C.
        kind: SplitKind,
        /// The subsegment split.
        s: Edge,
        /// The bad triangle.
        t: Triangle,
        /// Why it is bad.
        cause: Cause,
        /// The rejected Type-A point, input units.
        a: Point2,
        /// Set where the split is on a concentric shell of a small input angle.
        shell: Option<Shell>,
    },
}

/// Type-B or Type-C, by whether a non-free vertex is seen in the diametral disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplitKind {
    /// None is seen.
    B,
    /// One is seen; the closest one that the new vertex sees is its parent.
    C {
        /// The parent.
        parent: VertexId,
    },
}

/// Why a triangle is bad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// Its ratio of circumradius to shortest edge reaches rho.
    Skinny,
    /// Its area exceeds its bound.
    Area,
    /// Its circumradius exceeds what the size function returned at its rounded circumcenter (input units).
    Size {
        /// The value returned.
        h: f64,
    },
}

/// A concentric shell: the distance 2^k from an apex, input units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shell {
    /// The input vertex with a small angle.
    pub apex: VertexId,
    /// The exponent.
    pub k: i32,
}

/// Why a bad triangle is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkipReason {
    /// A rounded point cannot do what the exact one would.
    Resolution,
    /// A small input angle at this vertex makes it so.
    InputAngle {
        /// The vertex.
        apex: VertexId,
    },
    /// The input segment it would split has been split as often as allowed.
    SplitLimit {
        /// The segment.
        segment: SegmentId,
    },
}

/// The last record of a trace.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// How the run ended.
    pub outcome: Outcome,
    /// What stopped it; present with `Outcome::Stopped` only.
    pub stop_reason: Option<String>,
    /// The level that the stored points have in effect.
    pub level_effective: Option<Level>,
    /// Counts, each also derivable.
    pub counts: Counts,
    /// blake3 of the canonical mesh, in hexadecimal.
    pub mesh: String,
    /// blake3 of the binary form of all that precedes this digest, the other fields of the end included, in hexadecimal; filled in by
    /// the writer.
    pub trace: String,
}

/// Counts of a finished run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Vertices of the mesh.
    pub vertices: u32,
    /// Triangles of the mesh.
    pub triangles: u32,
    /// Type-A insertions.
    pub type_a: u32,
    /// Type-B insertions.
    pub type_b: u32,
    /// Type-C insertions.
    pub type_c: u32,
    /// Deletions.
    pub removed: u32,
    /// Bad triangles of the mesh that were left; one left for two causes counts twice.
    pub unmet: u32,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Every criterion is met.
    Complete,
    /// Some are not; each element is listed with its reason.
    Holey,
    /// A budget or an interrupt ended it; the mesh is valid.
    Stopped,
}

/// Receives the records of a run in order.
pub trait Sink {
    /// Takes one record. An error ends the run.
    fn record(&mut self, record: &Record) -> std::io::Result<()>;
}
