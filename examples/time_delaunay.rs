//! Times of the planar triangulation, in microseconds a point: `cargo run --release --example time_delaunay [points] [repetitions] [family]`.
//!
//! Prints the median of the repetitions of: Delaunay triangulation of uniform, clustered, x-sorted and grid points; uniform points with
//! half as many segments; insertion one by one in random order into a coarse triangulation; removal of those.

use orthoball::arith::FastKernel;
use orthoball::model::{Point2, VertexId};
use orthoball::triangulation::cdt2::{Cdt2, Change, Location};
use std::hint::black_box;
use std::time::Instant;

type Cdt = Cdt2<FastKernel>;

/// Xorshift numbers in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    fn point(&mut self) -> Point2 {
        Point2::new(self.unit(), self.unit())
    }
    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
}

fn uniform(n: usize) -> Vec<Point2> {
    let mut draw = Draw(1);
    (0..n).map(|_| draw.point()).collect()
}

/// A thousand clusters, denser toward their centers: three products of uniform numbers each way.
fn clustered(n: usize) -> Vec<Point2> {
    let mut draw = Draw(2);
    let centers: Vec<Point2> = (0..1000).map(|_| draw.point() * 0.5 + 0.25).collect();
    (0..n)
        .map(|i| {
            let mut offset = || (draw.unit() - 0.5) * draw.unit() * draw.unit() * 0.05;
            centers[i % 1000] + Point2::new(offset(), offset())
        })
        .collect()
}

fn grid(n: usize, step: f64) -> Vec<Point2> {
    let side = n.isqrt();
    let at = |i: usize| i as f64 * step;
    (0..side * side).map(|i| Point2::new(at(i % side), at(i / side))).collect()
}

fn sorted(n: usize) -> Vec<Point2> {
    let mut points = uniform(n);
    points.sort_by(|a, b| a.x.total_cmp(&b.x));
    points
}

/// n/2 edges of the Delaunay triangulation of the first third of the points: none crosses another, most are edges of no other triangulation.
fn segments(points: &[Point2], n: usize) -> Vec<[VertexId; 2]> {
    let m = Cdt::delaunay(points[..n / 3].to_vec()).expect("random points differ");
    let edges = m.triangles().flat_map(|t| m.edges(t).map(|e| [m.origin(e), m.destination(e)]));
    let mut edges: Vec<_> = edges.filter(|[u, v]| u < v).take(n / 2).collect();
    let mut draw = Draw(3);
    for i in (1..edges.len()).rev() {
        edges.swap(i, draw.below(i + 1));
    }
    edges
}

fn report(name: &str, n: usize, repetitions: usize, mut run: impl FnMut() -> f64) {
    let mut seconds: Vec<f64> = (0..repetitions).map(|_| run()).collect();
    seconds.sort_by(f64::total_cmp);
    println!("{name:28} {n:9} {:8.3} us a point", seconds[repetitions / 2] * 1e6 / n as f64);
}

fn time<T>(run: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let value = run();
    (start.elapsed().as_secs_f64(), value)
}

type Family = (&'static str, fn(usize) -> Vec<Point2>);

const FAMILIES: [Family; 5] = [
    ("uniform", uniform),
    ("clustered", clustered),
    ("sorted", sorted),
    ("grid", |n| grid(n, 1.0 / 2048.0)),
    ("rounded-grid", |n| grid(n, 1.0 / 3000.0)),
];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: usize| arguments.next().map_or(default, |a| a.parse().expect("a number"));
    let (n, repetitions) = (number(1_000_000), number(5));
    let only = arguments.next();
    let wanted = |name: &str| only.as_ref().is_none_or(|only| only == name);
    for (name, family) in FAMILIES {
        if wanted(name) {
            let points = family(n);
            report(name, points.len(), repetitions, || {
                let copy = points.clone();
                let (seconds, m) = time(|| Cdt::delaunay(copy).expect("points differ"));
                black_box(m);
                seconds
            });
        }
    }
    if wanted("segments") {
        constrain(n, repetitions);
    }
    if wanted("insert") {
        insert_and_remove(n / 10);
    }
}

fn constrain(n: usize, repetitions: usize) {
    let points = uniform(n);
    let segments = segments(&points, n);
    let mut constrain = Vec::new();
    report("uniform with n/2 segments", n, repetitions, || {
        let copy = points.clone();
        let (build, mut m) = time(|| Cdt::delaunay(copy).expect("points differ"));
        let (second, result) = time(|| m.constrain(&segments));
        result.expect("edges of one triangulation do not cross");
        constrain.push(second);
        build + second
    });
    constrain.sort_by(f64::total_cmp);
    let each = constrain[repetitions / 2] * 1e6 / segments.len() as f64;
    println!("{:28} {:9} {each:8.3} us a segment", "  of which constrain", segments.len());
}

fn insert_and_remove(n: usize) {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Point2::from);
    let mut m = Cdt::delaunay(corners.to_vec()).expect("a square");
    let mut change = Change::default();
    let points = uniform(n);
    let (mut locate, mut insert) = (0.0, 0.0);
    let mut added = Vec::new();
    let mut near = m.triangles().next().expect("two triangles");
    for &p in &points {
        let (seconds, place) = time(|| m.locate(near, p));
        locate += seconds;
        let Location::Triangle(t) = place else {
            continue;
        };
        let (seconds, v) = time(|| m.insert(t, p, &mut change));
        insert += seconds;
        added.push(v);
        near = change.created[0];
    }
    let each = |seconds: f64| seconds * 1e6 / n as f64;
    println!("{:28} {n:9} {:8.3} us a point", "random order: locate", each(locate));
    println!("{:28} {n:9} {:8.3} us a point", "random order: insert", each(insert));
    let (seconds, ()) = time(|| added.iter().for_each(|&v| m.remove(v, &mut change)));
    println!("{:28} {n:9} {:8.3} us a point", "remove", each(seconds));
}
