//! The triangulation under a sequence of operations, against a fresh build and against its definition.

use super::kernels::point;
use crate::arith::{FastKernel as K, Kernel};
use crate::domain::normalise;
use crate::generators::{Bytes, Draw, PointFamily, points};
use crate::model::{Fill, Lines, Point2, SegmentId, Sign, Triangle, VertexId, canonical_triangle};
use crate::triangulation::cdt2::{BuildError, CarveError, Cdt2, Change, HalfEdge, Location, TriId, Walk};
use arbitrary::{Arbitrary, Result, Unstructured};
use rug::Rational;

type Cdt = Cdt2<K>;

/// Most points at the start, segments asked for, and steps.
const MOST: [u32; 3] = [28, 12, 20];

/// A triangulation to build, and what to do to it.
#[derive(Clone, Debug, PartialEq)]
pub struct CdtCase {
    /// Normalised.
    pub points: Vec<Point2>,
    /// No two cross, none holds a vertex inside.
    pub segments: Vec<[VertexId; 2]>,
    /// `None`: the convex hull stays. Else its edges become segments, and what holds the seed of a hole is left out.
    pub carved: Option<Vec<Point2>>,
    /// What is done.
    pub steps: Vec<Step>,
}

/// A step. Numbers choose among what there is to choose from, modulo their count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Insert a point (or split, if it lies on a segment), from some triangle that it may be inserted from.
    Insert(Point2, u32),
    /// Split a constrained edge at this place of it, in [-1, 1].
    Split(u32, f64),
    /// Delete a free vertex.
    Remove(u32),
    /// Journal from here on.
    Checkpoint,
    /// Take back what was done since.
    Rollback,
    /// Keep it.
    Commit,
}

impl<'a> Arbitrary<'a> for CdtCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let family: PointFamily = u.arbitrary()?;
        let draw = &mut Bytes(u.bytes(u.len())?);
        let [most_points, most_segments, most_steps] = MOST;
        let n = 3 + draw.below(most_points - 2) as usize;
        let mut points = match draw.below(3) {
            0 => (0..n).fold(Vec::new(), |mut list, _| {
                list.push(point(draw, &list));
                list
            }),
            _ => points(family, n, draw),
        };
        // The families keep their range.
        points = normalise(&points, &Lines::default()).map_or(Vec::new(), |(points, _)| points);
        let mut distinct: Vec<Point2> = Vec::new();
        for p in points {
            if !distinct.contains(&p) {
                distinct.push(p);
            }
        }
        let wanted = draw.below(most_segments);
        let segments = segments_among(&distinct, wanted, draw);
        let carved = match draw.below(3) {
            0 => None,
            k => Some((1..k).map(|_| point(draw, &distinct)).collect()),
        };
        let mut steps = Vec::new();
        for _ in 0..draw.below(most_steps) {
            steps.push(match draw.below(11) {
                0..=4 => Step::Insert(point(draw, &distinct), draw.below(64)),
                5..=6 => Step::Split(
                    draw.below(64),
                    match draw.coin() {
                        true => 0.0,
                        false => draw.signed_unit(),
                    },
                ),
                7 => Step::Remove(draw.below(64)),
                8 => Step::Checkpoint,
                9 => Step::Rollback,
                _ => Step::Commit,
            });
        }
        Ok(CdtCase { points: distinct, segments, carved, steps })
    }
}

/// Segments between the points that cross nothing and hold no vertex.
fn segments_among(points: &[Point2], wanted: u32, draw: &mut impl Draw) -> Vec<[VertexId; 2]> {
    let mut segments: Vec<[VertexId; 2]> = Vec::new();
    for _ in 0..wanted {
        let [a, b] = [(); 2].map(|()| VertexId(draw.below(points.len().max(1) as u32)));
        let fits = a != b
            && points.iter().all(|&q| !lies_inside(q, points[a.index()], points[b.index()]))
            && segments.iter().all(|s| {
                let ends = [s[0], s[1], a, b].map(|v| points[v.index()]);
                !cross(ends) && *s != [a, b] && *s != [b, a]
            });
        if fits {
            segments.push([a, b]);
        }
    }
    segments
}

/// Whether q lies on the open segment ab.
fn lies_inside(q: Point2, a: Point2, b: Point2) -> bool {
    K::orient2d(a, b, q) == Sign::Zero && K::in_diametral_circle(a, b, q).is_positive()
}

/// Whether the open segments ab and cd cross in a point inside both.
fn cross([a, b, c, d]: [Point2; 4]) -> bool {
    let [c_of_ab, d_of_ab] = [c, d].map(|p| K::orient2d(a, b, p));
    let [a_of_cd, b_of_cd] = [a, b].map(|p| K::orient2d(c, d, p));
    let apart = |s: Sign, t: Sign| s != Sign::Zero && s == t.reversed();
    apart(c_of_ab, d_of_ab) && apart(a_of_cd, b_of_cd)
}

impl CdtCase {
    /// Carries the steps out; after each the validators, a fresh build and the definition must agree.
    pub fn run(&self) {
        let Some(mut subject) = Subject::build(self) else {
            return;
        };
        subject.validate();
        subject.compare();
        for &step in &self.steps {
            if subject.take(step) {
                subject.validate();
                subject.compare();
            }
        }
        subject.assert_definition();
    }
}

/// The triangulation with what is known of it from the outside.
#[derive(Clone)]
struct Subject {
    mesh: Cdt,
    points: Vec<Point2>,
    /// Which vertices are free, which deleted.
    free: Vec<bool>,
    deleted: Vec<bool>,
    subsegments: Vec<([VertexId; 2], SegmentId)>,
    carved: Option<Vec<Point2>>,
    /// Whether every vertex of a segment lies exactly on it.
    exact: bool,
    clock: u32,
    saved: Option<Box<Saved>>,
    change: Change,
}

/// The state at a checkpoint.
#[derive(Clone)]
struct Saved {
    subject: Subject,
    image: Image,
}

/// All that can be seen of a triangulation.
#[derive(Clone, Debug, PartialEq)]
struct Image {
    vertices: usize,
    triangles: Vec<SeenTriangle>,
    from: Vec<Option<HalfEdge>>,
}

/// A triangle: slot, vertices, birth, region, and of each edge the other side and the segment.
type SeenTriangle = (TriId, [VertexId; 3], u32, u32, [(Option<HalfEdge>, Option<SegmentId>); 3]);

fn image(mesh: &Cdt) -> Image {
    Image {
        vertices: mesh.vertex_count(),
        triangles: mesh
            .triangles()
            .map(|t| {
                let sides = mesh.edges(t).map(|e| (mesh.twin(e), mesh.segment(e)));
                let (v, birth, region) = (mesh.vertices(t), mesh.birth(t), mesh.region(t));
                (t, v, birth, region, sides)
            })
            .collect(),
        from: (0..mesh.vertex_count() as u32).map(|v| mesh.edge_from(VertexId(v))).collect(),
    }
}

/// The canonical triangles with their regions, sorted.
fn triangles(mesh: &Cdt) -> Vec<(Triangle, u32)> {
    let mut all: Vec<(Triangle, u32)> =
        mesh.triangles().map(|t| (canonical_triangle(mesh.vertices(t)), mesh.region(t))).collect();
    all.sort_unstable();
    all
}

/// The constrained edges of a mesh with their segments, smaller id first, sorted.
fn labelled(mesh: &Cdt) -> Vec<([VertexId; 2], SegmentId)> {
    let mut all: Vec<([VertexId; 2], SegmentId)> = mesh
        .triangles()
        .flat_map(|t| mesh.edges(t))
        .filter_map(|e| {
            let (u, v) = (mesh.origin(e), mesh.destination(e));
            Some(([u.min(v), u.max(v)], mesh.segment(e)?))
        })
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

impl Subject {
    /// Builds it; `None` where there is nothing to build, which is checked.
    fn build(case: &CdtCase) -> Option<Subject> {
        let mut mesh = match Cdt::delaunay(case.points.clone()) {
            Ok(mesh) => mesh,
            Err(e) => {
                assert_eq!(e, BuildError::Collinear, "{case:?}");
                let line = case.points.windows(3);
                assert!(line.into_iter().all(|w| K::orient2d(w[0], w[1], w[2]) == Sign::Zero), "{case:?}");
                return None;
            }
        };
        let mut segments = case.segments.clone();
        if case.carved.is_some() {
            let hull: Vec<[VertexId; 2]> = mesh
                .triangles()
                .flat_map(|t| mesh.edges(t))
                .filter(|&e| mesh.twin(e).is_none())
                .map(|e| [mesh.origin(e), mesh.destination(e)])
                .filter(|&[u, v]| !segments.contains(&[u, v]) && !segments.contains(&[v, u]))
                .collect();
            segments.extend(hull);
        }
        mesh.constrain(&segments).unwrap_or_else(|e| panic!("{e} of {case:?}"));
        let mut carved = case.carved.clone();
        if let Some(holes) = &mut carved
            && mesh.carve(Fill::Seeds, &[], holes, &[]).is_err()
        {
            holes.clear();
            // The hull is closed and encloses a triangle.
            mesh.carve(Fill::Seeds, &[], &[], &[]).unwrap_or_else(|e| panic!("{e} of {case:?}"));
        }
        Some(Subject {
            free: vec![false; case.points.len()],
            deleted: vec![false; case.points.len()],
            subsegments: (0..).zip(&segments).map(|(i, &s)| (s, SegmentId(i))).collect(),
            points: case.points.clone(),
            carved,
            exact: true,
            clock: 0,
            saved: None,
            change: Change::default(),
            mesh,
        })
    }

    /// Carries out a step; false if there was nothing to do.
    fn take(&mut self, step: Step) -> bool {
        self.clock += 1;
        self.mesh.set_clock(self.clock);
        match step {
            Step::Insert(p, from) => self.insert(p, from),
            Step::Split(which, at) => {
                let edges: Vec<HalfEdge> = self
                    .mesh
                    .triangles()
                    .flat_map(|t| self.mesh.edges(t))
                    .filter(|&e| self.mesh.is_constrained(e))
                    .collect();
                let Some(&e) = pick(&edges, which) else {
                    return false;
                };
                let [u, v] = [self.mesh.origin(e), self.mesh.destination(e)];
                let p = K::in_interval(self.mesh.point(u), self.mesh.point(v), 0.25, at);
                self.split(e, p)
            }
            Step::Remove(which) => {
                let all: Vec<VertexId> = (0..self.points.len() as u32)
                    .map(VertexId)
                    .filter(|v| self.free[v.index()] && !self.deleted[v.index()])
                    .collect();
                let Some(&v) = pick(&all, which) else {
                    return false;
                };
                self.mesh.remove(v, &mut self.change);
                self.deleted[v.index()] = true;
                assert_eq!(self.mesh.edge_from(v), None);
                assert_eq!(self.change.created.len() + 2, self.change.destroyed.len());
                true
            }
            Step::Checkpoint => {
                let image = image(&self.mesh);
                self.saved = None;
                let subject = self.clone();
                self.saved = Some(Box::new(Saved { subject, image }));
                self.mesh.checkpoint();
                false
            }
            Step::Rollback => {
                let Some(saved) = self.saved.take() else {
                    return false;
                };
                self.mesh.rollback();
                assert_eq!(image(&self.mesh), saved.image);
                let mesh = std::mem::replace(&mut self.mesh, saved.subject.mesh.clone());
                *self = Subject { mesh, ..saved.subject };
                true
            }
            Step::Commit => {
                self.mesh.commit();
                self.saved = None;
                false
            }
        }
    }

    fn insert(&mut self, p: Point2, from: u32) -> bool {
        let Some(first) = self.mesh.triangles().next() else {
            return false;
        };
        let holder = match self.mesh.locate(first, p) {
            Location::Triangle(t) => t,
            Location::Edge(e) if self.mesh.is_constrained(e) => return self.split(e, p),
            // A hull is convex and stays.
            Location::Edge(e) if self.mesh.twin(e).is_none() => return false,
            Location::Edge(e) => self.mesh.triangle_of(e),
            Location::Vertex(v) => {
                assert_eq!(self.mesh.point(v), p);
                return false;
            }
            Location::Outside => return false,
        };
        // As the refiner does it: from any triangle whose circle holds p and that sees it.
        let may: Vec<TriId> = self
            .mesh
            .triangles()
            .filter(|&t| K::in_circle(self.mesh.corners(t), p).is_positive() && self.mesh.walk(t, p) == Walk::Reached)
            .collect();
        assert!(may.contains(&holder), "the triangle that holds {p:?} sees it");
        let corners = pick(&may, from).map(|&t| self.mesh.corners(t));
        assert!(corners.is_some_and(|t| self.is_seen(t, p)));
        let t = *pick(&may, from).unwrap_or(&holder);
        let v = self.mesh.insert(t, p, &mut self.change);
        assert_eq!(v.index(), self.points.len());
        assert_eq!(self.change.destroyed.len() + 2, self.change.created.len());
        self.add(p, true);
        true
    }

    fn add(&mut self, p: Point2, free: bool) {
        self.points.push(p);
        self.free.push(free);
        self.deleted.push(false);
        for &t in &self.change.created {
            assert_eq!(self.mesh.birth(t), self.clock);
        }
    }

    /// Splits a constrained edge where the refiner would.
    fn split(&mut self, e: HalfEdge, p: Point2) -> bool {
        let mesh = &self.mesh;
        let (u, v) = (mesh.origin(e), mesh.destination(e));
        let exact = K::orient2d(mesh.point(u), mesh.point(v), p) == Sign::Zero;
        let ends = [u, v].map(|v| mesh.point(v));
        let sides = 1 + usize::from(mesh.twin(e).is_some());
        // Off a hull that stays, a fresh build would have another hull.
        let on_hull = self.carved.is_none() && sides == 1;
        if ends.contains(&p) || !mesh.may_split(e, p) || on_hull && !exact {
            return false;
        }
        // An edge of the mesh with a label is a subsegment.
        let segment = mesh.segment(e).expect("the edge is constrained");
        let w = self.mesh.split(e, p, &mut self.change);
        assert_eq!(w.index(), self.points.len());
        assert_eq!(self.change.destroyed.len() + sides, self.change.created.len());
        self.subsegments.retain(|(s, _)| !(s.contains(&u) && s.contains(&v)));
        self.subsegments.push(([u, w], segment));
        self.subsegments.push(([w, v], segment));
        self.exact &= exact;
        self.add(p, false);
        true
    }

    fn validate(&self) {
        for layer in [self.mesh.validate_links(), self.mesh.validate_orientation(), self.mesh.validate_delaunay()] {
            layer.unwrap_or_else(|e| panic!("{e}"));
        }
        if self.carved.is_none() {
            self.mesh.validate_hull().unwrap_or_else(|e| panic!("{e}"));
        }
    }

    /// The same triangulation, built from what is there now.
    fn fresh(&self) -> std::result::Result<(Cdt, Vec<VertexId>), String> {
        let alive: Vec<VertexId> =
            (0..self.points.len() as u32).map(VertexId).filter(|v| !self.deleted[v.index()]).collect();
        let dense = |v: VertexId| {
            // Ends of subsegments are never deleted.
            VertexId(alive.partition_point(|&a| a < v) as u32)
        };
        let points = alive.iter().map(|v| self.points[v.index()]).collect();
        let segments: Vec<[VertexId; 2]> = self.subsegments.iter().map(|(s, _)| s.map(dense)).collect();
        let mut mesh = Cdt::delaunay(points).map_err(|e| e.to_string())?;
        mesh.constrain(&segments).map_err(|e| e.to_string())?;
        if let Some(holes) = &self.carved {
            mesh.carve(Fill::Seeds, &[], holes, &[]).map_err(|e: CarveError| e.to_string())?;
        }
        Ok((mesh, alive))
    }

    /// Whether a vertex that was rounded off its segment has swept over the seed of a hole: a fresh build would leave out another face.
    fn swept(&self) -> bool {
        let holds = |t: TriId, q: Point2| {
            let [a, b, c] = self.mesh.corners(t);
            [(a, b), (b, c), (c, a)].iter().all(|&(x, y)| !K::orient2d(x, y, q).is_negative())
        };
        let holes = self.carved.iter().flatten();
        !self.exact && { holes }.any(|&seed| self.mesh.triangles().any(|t| holds(t, seed)))
    }

    fn compare(&self) {
        if self.swept() {
            return;
        }
        let (fresh, alive) = self.fresh().unwrap_or_else(|e| panic!("{e}"));
        let mut expected: Vec<(Triangle, u32)> = triangles(&fresh)
            .into_iter()
            .map(|(t, region)| (canonical_triangle(t.map(|v| alive[v.index()])), region))
            .collect();
        expected.sort_unstable();
        assert_eq!(triangles(&self.mesh), expected);
        let mut edges: Vec<([VertexId; 2], SegmentId)> = labelled(&fresh)
            .into_iter()
            .map(|(s, label)| (s.map(|v| alive[v.index()]), self.subsegments[label.index()].1))
            .collect();
        edges.sort_unstable();
        assert_eq!(labelled(&self.mesh), edges);
    }

    /// No vertex in conflict with a triangle is seen from its centroid.
    fn assert_definition(&self) {
        for t in self.mesh.triangles() {
            let corners = self.mesh.corners(t);
            for v in (0..self.points.len() as u32).map(VertexId) {
                let q = self.points[v.index()];
                if self.mesh.edge_from(v).is_some() && !corners.contains(&q) && K::in_conflict(corners, q) {
                    assert!(!self.is_seen(corners, q), "{corners:?} sees {q:?}");
                }
            }
        }
    }

    /// Whether q is seen from the centroid of t: no subsegment of the mesh, as a closed set, meets the way, but in q.
    fn is_seen(&self, t: [Point2; 3], q: Point2) -> bool {
        let center = centroid(t);
        let q_exact = rational(q);
        !self.subsegments.iter().any(|(s, _)| {
            let [a, b] = s.map(|v| self.points[v.index()]);
            if self.mesh.find_edge(s[0], s[1]).is_none() && self.mesh.find_edge(s[1], s[0]).is_none() {
                return false;
            }
            let [a, b] = [rational(a), rational(b)];
            if a == q_exact || b == q_exact {
                // The centroid lies on no segment: past q there is nothing more to meet, unless the way comes along it.
                let other = if a == q_exact { &b } else { &a };
                return turn(&center, &q_exact, other).is_eq() && between(&center, other, &q_exact);
            }
            let of_segment = [turn(&a, &b, &center), turn(&a, &b, &q_exact)];
            let of_way = [turn(&center, &q_exact, &a), turn(&center, &q_exact, &b)];
            if of_way[0].is_eq() && of_way[1].is_eq() {
                return between(&center, &a, &q_exact) || between(&center, &b, &q_exact);
            }
            // The ends apart or one of them on the way; q beyond or on the segment.
            of_segment[0] != of_segment[1] && of_way[0] != of_way[1]
        })
    }
}

type Exact = [Rational; 2];

fn rational(p: Point2) -> Exact {
    // Coordinates are finite.
    [p.x, p.y].map(|c| Rational::from_f64(c).unwrap_or_default())
}

fn centroid(t: [Point2; 3]) -> Exact {
    let [a, b, c] = t.map(rational);
    std::array::from_fn(|k| (Rational::from(&a[k] + &b[k]) + &c[k]) / 3_u32)
}

/// The sign of the area of abc.
fn turn(a: &Exact, b: &Exact, c: &Exact) -> std::cmp::Ordering {
    let d = |p: &Exact, k: usize| Rational::from(&p[k] - &a[k]);
    let (left, right) = (d(b, 0) * d(c, 1), d(b, 1) * d(c, 0));
    left.cmp(&right)
}

/// Whether p, on the line of a and b, lies strictly between them.
fn between(a: &Exact, p: &Exact, b: &Exact) -> bool {
    let d = |p: &Exact, q: &Exact, k: usize| Rational::from(&p[k] - &q[k]);
    let dot = d(a, p, 0) * d(b, p, 0) + d(a, p, 1) * d(b, p, 1);
    dot < 0
}

fn pick<T>(list: &[T], which: u32) -> Option<&T> {
    list.get(which as usize % list.len().max(1))
}
