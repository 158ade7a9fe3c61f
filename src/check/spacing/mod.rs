//! The rows of `docs/gcdr.md` with local feature size and density: A6, B5', C3', C4', I1, F1, F2.
//!
//! Problem: lfs, insertion radii R, parents and densities D = lfs/R are nowhere in a trace; they follow from it. Idea: read the
//! records one after the other. A new vertex sees exactly the corners of the triangles it destroys, so R is the distance to
//! the nearest of them; the parent is the newest end of the shortest edge of the bad triangle (Type-A, B), or named (Type-C).
//! Everything is frozen at insertion and kept when the vertex is deleted. Whether the destroyed triangles are the right ones is
//! the business of the replay, which must accept a record before it comes here.
//! Numbers: normalised by a power of two. Each row is written once over `Scalar`: doubles with error bounds, then intervals of
//! rationals; what those leave open is counted as undecided, never as held.
//! Source: \[GCDR\] sections 2 and 5; `docs/gcdr.md`; corrections in `docs/errata.md`.

mod features;
mod quantities;
mod rows;

pub use features::{Feature, Features, Local};
pub use rows::Row;

use super::grading::{B2, C2, Constants, Selection};
use super::rational::Rational;
use super::scalar::{Bounded, Enclosure, Scalar};
use crate::model::{Edge, GcdrParameters, Level, Point2, SegmentId, Triangle, VertexId};
use crate::trace::{Algorithm, Cause, Event, Record, SplitKind, Why};
use rows::Scene;
use std::collections::BTreeMap;

/// The type of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A vertex of the input.
    Input,
    /// Type-A.
    A,
    /// Type-B.
    B,
    /// Type-C.
    C,
}

/// A row that does not hold, or a record that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// The event; `None` for the start and the end.
    pub event: Option<u64>,
    /// The row.
    pub row: Row,
    /// The inequality.
    pub expected: String,
    /// Its values, with the effective parameters.
    pub found: String,
}

/// How often a row was tested.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// It held.
    pub held: u64,
    /// Neither doubles nor 160 bits could tell.
    pub undecided: u64,
    /// Its premise is not given: the triangle was not skinny, or an effective parameter is out of range.
    pub unclaimed: u64,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Per row.
    pub rows: BTreeMap<Row, Count>,
    /// Largest density per kind of vertex, rounded.
    pub densities: BTreeMap<Kind, f64>,
}

/// Reads the records of a trace and tests the rows of spacing.
#[derive(Clone, Debug, Default)]
pub struct Spacing {
    parameters: Option<GcdrParameters>,
    points: Vec<Point2>,
    segments: Vec<[VertexId; 2]>,
    /// Input segment by its ends, smaller id first.
    by_ends: BTreeMap<Edge, SegmentId>,
    features: Features,
    /// Coordinates are multiplied by 2^-scale.
    scale: i32,
    started: bool,
    vertices: Vec<Vertex>,
    events: u64,
    least: Effective,
    sized: bool,
    level: Option<Level>,
    report: Report,
}

/// What is frozen at insertion.
#[derive(Clone, Debug)]
struct Vertex {
    p: Point2,
    kind: Kind,
    /// The nearest visible vertex right after insertion: R is the distance to it.
    nearest: Option<VertexId>,
    local: Local,
    split: Option<Split>,
}

/// Where a segment vertex was born.
#[derive(Clone, Copy, Debug)]
struct Split {
    ends: [VertexId; 2],
    segment: SegmentId,
}

/// Lower bounds of the effective parameters of all events so far.
#[derive(Clone, Copy, Debug)]
struct Effective {
    d1: f64,
    d2: f64,
    mu: f64,
}

impl Default for Effective {
    fn default() -> Self {
        Effective { d1: f64::INFINITY, d2: f64::INFINITY, mu: f64::INFINITY }
    }
}

/// |a - b|^2.
fn distance2<N: Scalar>(a: Point2, b: Point2) -> N {
    (N::of(a.x) - N::of(b.x)).squared() + (N::of(a.y) - N::of(b.y)).squared()
}

/// (b - a).(d - c).
fn dot<N: Scalar>([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> N {
    (N::of(b.x) - N::of(a.x)) * (N::of(d.x) - N::of(c.x)) + (N::of(b.y) - N::of(a.y)) * (N::of(d.y) - N::of(c.y))
}

/// Twice the signed area of a triangle.
fn cross<N: Scalar>(a: Point2, b: Point2, c: Point2) -> N {
    (N::of(b.x) - N::of(a.x)) * (N::of(c.y) - N::of(a.y)) - (N::of(b.y) - N::of(a.y)) * (N::of(c.x) - N::of(a.x))
}

/// Squared distance of p to the closed segment ab; unknown if it is unknown beside which end p lies.
fn distance2_to_segment<N: Scalar>(p: Point2, a: Point2, b: Point2) -> N {
    let along: N = dot([a, p], [a, b]);
    let length2: N = distance2(a, b);
    match (along.at_most(&N::of(0.0)), length2.at_most(&along)) {
        (Some(true), _) => distance2(p, a),
        (_, Some(true)) => distance2(p, b),
        (Some(false), Some(false)) => cross::<N>(a, b, p).squared() / length2,
        _ => N::unknown(),
    }
}

impl Spacing {
    /// Nothing read yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the next record of a trace that a replay has accepted so far.
    ///
    /// Errors: the first row that does not hold.
    pub fn record(&mut self, record: &Record) -> Result<(), Violation> {
        match record {
            Record::Header(header) => {
                if let Algorithm::Gcdr(parameters) = &header.algorithm {
                    self.parameters = Some(parameters.clone());
                }
            }
            Record::Vertex { at, .. } => self.points.push(*at),
            Record::Segment(s) => self.segments.push(s.ends),
            Record::Hole(_) | Record::Region(_) | Record::Space(_) => {}
            Record::Start { .. } => self.start()?,
            Record::Triangle(t) => self.neighbors(*t)?,
            Record::Event(event) => {
                if self.events == 0 {
                    self.rows_of_input()?;
                }
                self.event(event)?;
                self.events += 1;
            }
            Record::End(end) => {
                if self.events == 0 {
                    self.rows_of_input()?;
                }
                self.level = end.level_effective;
            }
        }
        Ok(())
    }

    /// What was found so far.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The density of a vertex, rounded; kept after its deletion.
    pub fn density(&self, v: VertexId) -> Option<f64> {
        self.vertices.get(v.index()).map(|vertex| self.density2(vertex).display().sqrt())
    }

    /// Tests the rows of the end, F1 and F2. `smallest` is the smallest input angle below 90 degrees as (apex, p, q); `edges` are
    /// those of the final mesh, by ids of the run (they may be empty: F2 is then tested for vertices only).
    pub fn finish(
        &mut self,
        smallest: Option<[VertexId; 3]>,
        edges: impl IntoIterator<Item = Edge>,
    ) -> Result<(), Violation> {
        let vertices = u64::try_from(self.vertices.len()).unwrap_or(u64::MAX);
        let Some(bounds) = self.constants(smallest).and_then(|c| c.least()) else {
            self.count(Row::F1).unclaimed += vertices;
            self.count(Row::F2).unclaimed += vertices;
            return Ok(());
        };
        for id in 0..self.vertices.len() {
            let bound = match self.vertices[id].kind {
                Kind::Input => continue,
                Kind::A => &bounds.a,
                Kind::B => &bounds.b,
                Kind::C => &bounds.c,
            };
            self.row_f1(id, bound)?;
        }
        let largest = bounds.largest();
        self.rows_f2(&largest, edges)
    }

    /// The grading constants for the effective parameters of the run; `None` if the run is not at the graded level, or has vertices
    /// inserted for size, which the theorem does not know.
    fn constants(&self, smallest: Option<[VertexId; 3]>) -> Option<Constants> {
        if self.level != Some(Level::Graded) || self.sized {
            return None;
        }
        let parameters = self.parameters.as_ref()?;
        let least = |nominal: f64, effective: f64| {
            if effective < nominal { effective } else { nominal }
        };
        let Effective { d1, d2, mu } = self.least;
        let mut selection = Selection::of(
            parameters.rho2,
            least(parameters.d1, d1),
            least(parameters.d2, d2),
            least(parameters.mu, mu),
        );
        if let Some([apex, p, q]) = smallest {
            let [apex, p, q] = [self.point(apex)?, self.point(p)?, self.point(q)?];
            selection.cos2 = cos2(apex, p, q);
        }
        Some(Constants::new(&selection, C2::Sharp, B2::Refined))
    }

    fn point(&self, v: VertexId) -> Option<Point2> {
        self.vertices.get(v.index()).map(|vertex| vertex.p)
    }

    fn count(&mut self, row: Row) -> &mut Count {
        self.report.rows.entry(row).or_default()
    }

    fn unreadable(&self, found: impl Into<String>) -> Violation {
        let expected = "a record that the replay accepts".to_owned();
        Violation { event: Some(self.events), row: Row::Record, expected, found: found.into() }
    }

    /// All features are known: normalises them and measures the input vertices.
    fn start(&mut self) -> Result<(), Violation> {
        let finite = |p: &Point2| p.x.is_finite() && p.y.is_finite();
        let in_range = |s: &[VertexId; 2]| s.iter().all(|v| v.index() < self.points.len());
        if self.started || !self.points.iter().all(finite) || !self.segments.iter().all(in_range) {
            return Err(self.unreadable("coordinates or ids out of range"));
        }
        self.started = true;
        let largest = self.points.iter().fold(0.0f64, |m, p| m.max(p.x.abs()).max(p.y.abs()));
        self.scale = exponent(largest);
        let points: Vec<Point2> = std::mem::take(&mut self.points).into_iter().map(|p| self.normalised(p)).collect();
        self.by_ends = (0u32..).zip(&self.segments).map(|(i, s)| (edge(*s), SegmentId(i))).collect();
        self.features = Features::new(points.clone(), std::mem::take(&mut self.segments));
        let features = &self.features;
        let vertex = |p| Vertex { p, kind: Kind::Input, nearest: None, local: features.local(p), split: None };
        self.vertices = points.into_iter().map(vertex).collect();
        Ok(())
    }

    fn normalised(&self, p: Point2) -> Point2 {
        Point2::new(times_power_of_two(p.x, -self.scale), times_power_of_two(p.y, -self.scale))
    }

    /// A triangle of the initial triangulation: its edges are candidates for the insertion radii of input vertices.
    fn neighbors(&mut self, t: Triangle) -> Result<(), Violation> {
        if t.iter().any(|v| v.index() >= self.vertices.len()) {
            return Err(self.unreadable("a triangle of unknown vertices"));
        }
        for k in 0..3 {
            let (v, w) = (t[k], t[(k + 1) % 3]);
            for (v, w) in [(v, w), (w, v)] {
                let nearest = self.nearer(v, self.vertices[v.index()].nearest, w);
                self.vertices[v.index()].nearest = Some(nearest);
            }
        }
        Ok(())
    }

    /// The nearer to v of two vertices.
    fn nearer(&self, v: VertexId, best: Option<VertexId>, w: VertexId) -> VertexId {
        let p = |v: VertexId| self.vertices[v.index()].p;
        match best {
            Some(best) if !closer(p(v), p(w), p(best)) => best,
            _ => w,
        }
    }

    fn rows_of_input(&mut self) -> Result<(), Violation> {
        for id in 0..self.features.vertex_count().min(self.vertices.len()) {
            self.note_density(id);
            self.row_i1(id)?;
        }
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), Violation> {
        match event {
            Event::Insert { p, why, destroyed } => self.insertion(*p, why, destroyed),
            Event::Remove { .. } | Event::Skip { .. } => Ok(()),
        }
    }

    fn insertion(&mut self, p: Point2, why: &Why, destroyed: &[Triangle]) -> Result<(), Violation> {
        let known = |t: &Triangle| t.iter().all(|v| v.index() < self.vertices.len());
        let (t, cause) = match why {
            Why::Free { cause } => (destroyed.first().copied(), *cause),
            Why::Split { t, cause, .. } => (Some(*t), *cause),
        };
        let Some(t) = t.filter(|t| known(t) && destroyed.iter().all(known) && p.x.is_finite() && p.y.is_finite())
        else {
            return Err(self.unreadable("an insertion with unknown vertices"));
        };
        let split = match why {
            Why::Free { .. } => None,
            Why::Split { s, .. } => Some(Split { ends: *s, segment: self.segment_of(*s)? }),
        };
        let kind = match why {
            Why::Free { .. } => Kind::A,
            Why::Split { kind: SplitKind::B, .. } => Kind::B,
            Why::Split { kind: SplitKind::C { .. }, .. } => Kind::C,
        };
        let p = self.normalised(p);
        let id = self.vertices.len();
        let v = VertexId(u32::try_from(id).map_err(|_| self.unreadable("more than 2^32 vertices"))?);
        self.vertices.push(Vertex { p, kind, nearest: None, local: self.features.local(p), split });
        let mut nearest = None;
        for w in destroyed.iter().flatten() {
            nearest = Some(self.nearer(v, nearest, *w));
        }
        self.vertices[id].nearest = nearest;
        self.note_density(id);
        let skinny = matches!(cause, Cause::Skinny);
        self.sized |= !skinny;
        match why {
            Why::Free { .. } => {
                let scene = Scene { id, parent: skinny.then(|| self.parent_of(t)), t, a: p };
                self.rows_a(&scene)
            }
            Why::Split { kind: SplitKind::B, a, .. } => {
                let scene = Scene { id, parent: skinny.then(|| self.parent_of(t)), t, a: self.normalised(*a) };
                self.rows_b(&scene)
            }
            Why::Split { kind: SplitKind::C { parent }, a, .. } => {
                if parent.index() >= id {
                    return Err(self.unreadable("an unknown parent"));
                }
                let scene = Scene { id, parent: Some(*parent), t, a: self.normalised(*a) };
                self.rows_c(&scene)
            }
        }
    }

    /// The input segment that a subsegment is part of. A segment vertex lies on one only; two input vertices are its ends.
    fn segment_of(&self, s: Edge) -> Result<SegmentId, Violation> {
        let labels = s.iter().map(|v| self.vertices.get(v.index()).and_then(|vertex| vertex.split));
        labels
            .flatten()
            .map(|split| split.segment)
            .next()
            .or_else(|| self.by_ends.get(&edge(s)).copied())
            .ok_or_else(|| self.unreadable("a subsegment of no input segment"))
    }

    /// The parent of a Type-A or Type-B point: the newest end of the shortest edge of t. Equal edges: the least pair of ids.
    fn parent_of(&self, t: Triangle) -> VertexId {
        let p = |v: VertexId| self.vertices[v.index()].p;
        let edges = [edge([t[0], t[1]]), edge([t[1], t[2]]), edge([t[2], t[0]])];
        let mut best = edges[0];
        for e in &edges[1..] {
            let order = compare_lengths([p(e[0]), p(e[1])], [p(best[0]), p(best[1])]);
            if order.then(e.cmp(&best)).is_lt() {
                best = *e;
            }
        }
        // ids ascend with the time of insertion, the larger comes last
        best[1]
    }

    /// R of a vertex, squared.
    fn radius2<N: Scalar>(&self, vertex: &Vertex) -> N {
        match vertex.nearest {
            Some(nearest) => distance2(vertex.p, self.vertices[nearest.index()].p),
            None => N::unknown(),
        }
    }

    /// D of a vertex, squared, 0 where it sees no other.
    fn density2(&self, vertex: &Vertex) -> Bounded {
        if vertex.nearest.is_none() {
            return Bounded::of(0.0);
        }
        vertex.local.size2 / self.radius2(vertex)
    }

    fn note_density(&mut self, id: usize) {
        let vertex = &self.vertices[id];
        let density = self.density2(vertex).display().sqrt();
        let largest = self.report.densities.entry(vertex.kind).or_insert(0.0);
        *largest = largest.max(density);
    }
}

/// cos^2 of the angle at `apex`; `None` from 90 degrees on.
fn cos2(apex: Point2, p: Point2, q: Point2) -> Option<Rational> {
    let product: Enclosure = dot([apex, p], [apex, q]);
    let quotient = product.clone().squared() / (distance2::<Enclosure>(apex, p) * distance2(apex, q));
    (product.at_most(&Enclosure::of(0.0)) == Some(false)).then(|| quotient.rational().cloned()).flatten()
}

/// Whether |p a| < |p b|.
fn closer(p: Point2, a: Point2, b: Point2) -> bool {
    compare_lengths([p, a], [p, b]).is_lt()
}

/// Order of two lengths; squared lengths are rational, so the second number type always tells.
fn compare_lengths(e: [Point2; 2], f: [Point2; 2]) -> std::cmp::Ordering {
    fn order<N: Scalar>([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Option<std::cmp::Ordering> {
        distance2::<N>(a, b).compare(&distance2(c, d))
    }
    order::<Bounded>(e, f).or_else(|| order::<Enclosure>(e, f)).unwrap_or(std::cmp::Ordering::Equal)
}

/// A pair of ids, the smaller first.
fn edge([a, b]: [VertexId; 2]) -> Edge {
    if a < b { [a, b] } else { [b, a] }
}

/// The e with 2^(e-1) <= x < 2^e, of a positive finite number; 0 for 0.
fn exponent(x: f64) -> i32 {
    let biased = |x: f64| ((x.to_bits() >> 52) & 0x7ff) as i32 - 1022;
    match x {
        0.0 => 0,
        // 2^64, exactly
        x if x < f64::MIN_POSITIVE => biased(x * 18_446_744_073_709_551_616.0) - 64,
        x => biased(x),
    }
}

/// x 2^e: exact, unless the result is subnormal, which the range of inputs excludes.
fn times_power_of_two(x: f64, e: i32) -> f64 {
    // two factors, since 2^e alone may be out of range
    let power = |e: i32| f64::from_bits(((e + 1023) as u64) << 52);
    let half = (e / 2).clamp(-1022, 1023);
    let rest = (e - half).clamp(-1022, 1023);
    x * power(half) * power(rest)
}
