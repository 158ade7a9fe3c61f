//! The triangulation against its definition. Here what all tests need; by theme: `build`, `change`, `carve`, `validators`.

mod build;
mod carve;
mod change;
mod validators;

use super::*;
use crate::arith::{FastKernel as K, Kernel};
use crate::model::{Fill, Point2, Sign, Triangle};

type Cdt = Cdt2<K>;

/// A generator of its own, so that a failing case is named by a seed.
struct Draw(u64);

impl Draw {
    fn below(&mut self, n: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(n)) as u32
    }
    fn unit(&mut self) -> f64 {
        f64::from(self.below(1 << 30)) / f64::from(1 << 30)
    }
    fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, self.below(i as u32 + 1) as usize);
        }
    }
}

/// n points of a family, all different, in no order.
fn family(kind: u32, n: usize, draw: &mut Draw) -> Vec<Point2> {
    let mut points: Vec<Point2> = Vec::new();
    let mut tries = 0;
    while points.len() < n && tries < 20 * n {
        tries += 1;
        let p = match kind {
            0 => Point2::new(draw.unit(), draw.unit()),
            1 => Point2::new(f64::from(draw.below(5)), f64::from(draw.below(5))) / 8.0,
            // On the circle of radius 65, and its center.
            2 => {
                let on = [
                    [65, 0],
                    [63, 16],
                    [60, 25],
                    [56, 33],
                    [52, 39],
                    [39, 52],
                    [33, 56],
                    [25, 60],
                    [16, 63],
                    [0, 65],
                    [0, 0],
                ];
                let [x, y] = on[draw.below(11) as usize];
                let (sx, sy) = (draw.below(2), draw.below(2));
                let flip = |v: i32, s: u32| f64::from(if s == 0 { v } else { -v }) / 128.0;
                Point2::new(flip(x, sx), flip(y, sy))
            }
            // Runs of collinear points with a few off them.
            3 => match draw.below(4) {
                0 => Point2::new(draw.unit(), draw.unit()),
                1 => Point2::new(f64::from(draw.below(16)) / 16.0, 0.5),
                2 => Point2::new(0.0, f64::from(draw.below(16)) / 16.0),
                _ => Point2::splat(f64::from(draw.below(16)) / 16.0),
            },
            // Clusters, the smallest below the resolution of the first curve.
            4 => {
                let c = Point2::new(f64::from(draw.below(3)), f64::from(draw.below(2))) / 4.0;
                c + Point2::new(draw.unit(), draw.unit()) * [1e-3, 1e-7, 1e-12][draw.below(3) as usize]
            }
            // Nearly on a line.
            _ => {
                let x = draw.unit();
                Point2::new(x, x / 3.0 + draw.unit() * 1e-16)
            }
        };
        if !points.contains(&p) {
            points.push(p);
        }
    }
    points
}

fn points_of(seed: u64) -> Vec<Point2> {
    let mut draw = Draw(seed);
    let kind = draw.below(6);
    let n = 3 + draw.below(30) as usize;
    family(kind, n, &mut draw)
}

/// The triangles as ids, sorted.
fn triples(m: &Cdt) -> Vec<Triangle> {
    let mut all: Vec<Triangle> = m.triangles().map(|t| crate::model::canonical_triangle(m.vertices(t))).collect();
    all.sort_unstable();
    all
}

fn validate(m: &Cdt) {
    m.validate_links().unwrap();
    m.validate_orientation().unwrap();
    m.validate_delaunay().unwrap();
}

/// Whether the open segments cross, or one holds an end of the other inside.
fn blocks(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    let sides = [K::orient2d(a, b, c), K::orient2d(a, b, d), K::orient2d(c, d, a), K::orient2d(c, d, b)];
    sides[0] == sides[1].reversed() && sides[2] == sides[3].reversed() && sides.iter().all(|&s| s != Sign::Zero)
}

/// The definition without segments: all counterclockwise triples in conflict with no other vertex.
fn definition(points: &[Point2]) -> Vec<Triangle> {
    let n = points.len();
    let mut all = Vec::new();
    for a in 0..n {
        for b in a + 1..n {
            for c in a + 1..n {
                let t = [points[a], points[b], points[c]];
                if b != c && K::orient2d(t[0], t[1], t[2]).is_positive() {
                    let mut others = (0..n).filter(|&q| q != a && q != b && q != c);
                    if !others.any(|q| K::in_conflict(t, points[q])) {
                        all.push([a, b, c].map(|v| VertexId(v as u32)));
                    }
                }
            }
        }
    }
    all.sort_unstable();
    all
}

/// Segments between the points that cross nothing and hold no vertex, up to `wanted`.
fn segments_among(points: &[Point2], wanted: usize, draw: &mut Draw) -> Vec<[VertexId; 2]> {
    let n = points.len() as u32;
    let mut segments: Vec<[VertexId; 2]> = Vec::new();
    for _ in 0..8 * wanted {
        let [a, b] = [draw.below(n), draw.below(n)];
        let [pa, pb] = [a, b].map(|v| points[v as usize]);
        let holds = |q: Point2| {
            let order = crate::arith::perturb::lexicographic;
            K::orient2d(pa, pb, q) == Sign::Zero && order(pa, q) == order(q, pb) && q != pa && q != pb
        };
        let crosses = |s: &[VertexId; 2]| blocks(pa, pb, points[s[0].index()], points[s[1].index()]);
        let new = [VertexId(a), VertexId(b)];
        let repeats = segments.contains(&new) || segments.contains(&[new[1], new[0]]);
        if a != b && !repeats && !points.iter().any(|&q| holds(q)) && !segments.iter().any(crosses) {
            segments.push(new);
        }
        if segments.len() == wanted {
            break;
        }
    }
    segments
}

fn built(points: &[Point2], segments: &[[VertexId; 2]]) -> Option<Cdt> {
    let mut m = Cdt::delaunay(points.to_vec()).ok()?;
    m.constrain(segments).unwrap();
    Some(m)
}

/// The labelled edges, sorted, smaller id first.
fn labelled(m: &Cdt) -> Vec<(VertexId, VertexId, SegmentId)> {
    let edges = m.triangles().flat_map(|t| m.edges(t));
    let mut all: Vec<_> = edges
        .filter_map(|e| {
            let (u, v) = (m.origin(e), m.destination(e));
            Some((u.min(v), u.max(v), m.segment(e)?))
        })
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Everything there is to know: slots, labels, hints, free slots, vertices, clock.
type Image = (Vec<store::Slot>, Vec<[Option<SegmentId>; 3]>, Vec<u32>, Vec<u32>, usize, u32);

fn image(m: &Cdt) -> Image {
    let labels = (0..m.slots.len() as u32).map(|t| m.edges(TriId(t)).map(|e| m.segment(e))).collect();
    (m.slots.clone(), labels, m.hints.clone(), m.free.clone(), m.points.len(), m.clock)
}

/// Two nested squares, the inner one 4..=7.
fn squares() -> (Vec<Point2>, Vec<[VertexId; 2]>) {
    let p = |x: i32, y: i32| Point2::new(f64::from(x), f64::from(y)) / 16.0;
    let points = vec![p(0, 0), p(8, 0), p(8, 8), p(0, 8), p(2, 2), p(6, 2), p(6, 6), p(2, 6), p(12, 4)];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    (points, segments.iter().map(|s| s.map(VertexId)).collect())
}
