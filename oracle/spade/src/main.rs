//! spade as a peer: CPU time of one build, and refinement of cases.
//!
//! ```text
//! spade-peer delaunay POINTS
//! spade-peer constrained POINTS SEGMENTS
//! spade-peer refine SHAPE AREA DEGREES
//! spade-peer mesh DEGREES AREA MAX_VERTICES < CASES
//! ```
//!
//! Files and output as in `oracle/README.md`. Refinement excludes what lies outside by parity of constraints, so hole seeds are not used.

use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, DelaunayTriangulation, Point2, RefinementParameters, Triangulation,
};
use std::collections::HashSet;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// CPU time of this thread in seconds, as Linux counts it.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux");
    text.split_whitespace().next().and_then(|n| n.parse::<f64>().ok()).expect("a number") * 1e-9
}

fn read_points(path: &str) -> Vec<Point2<f64>> {
    let bytes = std::fs::read(path).expect("points");
    let number = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("8 bytes"));
    bytes.chunks_exact(16).map(|b| Point2::new(number(&b[..8]), number(&b[8..]))).collect()
}

fn read_segments(path: &str) -> Vec<[usize; 2]> {
    let bytes = std::fs::read(path).expect("segments");
    let number = |b: &[u8]| u32::from_le_bytes(b.try_into().expect("4 bytes")) as usize;
    bytes.chunks_exact(8).map(|b| [number(&b[..4]), number(&b[4..])]).collect()
}

/// Counts of the faces that are not excluded, their smallest angle in degrees and largest area; displays only.
fn quality(cdt: &Cdt, excluded: &HashSet<spade::handles::FixedFaceHandle<spade::handles::InnerTag>>) -> (usize, f64, f64) {
    let (mut count, mut angle, mut area) = (0, f64::INFINITY, 0.0_f64);
    for face in cdt.inner_faces().filter(|f| !excluded.contains(&f.fix())) {
        let p = face.positions();
        count += 1;
        for i in 0..3 {
            let (a, b, c) = (p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
            let cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            let dot = (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
            angle = angle.min(cross.atan2(dot).to_degrees());
            area = area.max(cross / 2.0);
        }
    }
    (count, angle, area)
}

fn parameters(degrees: f64, area: f64, limit: usize) -> RefinementParameters<f64> {
    let p = RefinementParameters::new()
        .with_angle_limit(AngleLimit::from_deg(degrees))
        .with_max_additional_vertices(limit)
        .exclude_outer_faces(true);
    if area > 0.0 { p.with_max_allowed_area(area) } else { p }
}

fn mesh(degrees: f64, area: f64, limit: usize) {
    let text = std::io::read_to_string(std::io::stdin()).expect("cases");
    let mut words = text.split_whitespace();
    let mut word = || words.next();
    while word().is_some() {
        let name = word().expect("name").to_string();
        let mut count = || word().expect("a count").parse::<usize>().expect("a count");
        let (n, m, h) = (count(), count(), count());
        let mut number = || word().expect("a number").parse::<f64>().expect("a number");
        let mut point = |labelled: bool| {
            if labelled {
                number();
            }
            let x = number();
            Point2::new(x, number())
        };
        let points: Vec<_> = (0..n).map(|_| point(true)).collect();
        let segments: Vec<[usize; 2]> = (0..m).map(|_| point(false)).map(|p| [p.x as usize, p.y as usize]).collect();
        for _ in 0..h {
            point(false);
        }
        let start = cpu_seconds();
        let Ok(mut cdt) = Cdt::try_bulk_load_cdt(points, segments.into_iter().filter(|s| s[0] != s[1]).collect(), |_| ()) else {
            println!("{name} refused");
            continue;
        };
        let result = cdt.refine(parameters(degrees, area, limit));
        let seconds = cpu_seconds() - start;
        let (triangles, angle, largest) = quality(&cdt, &result.excluded_faces.iter().copied().collect());
        let ended = u8::from(result.refinement_complete);
        println!("{name} {ended} {} {triangles} {angle:.4} {largest:.6e} {seconds:.3}", cdt.num_vertices());
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let number = |s: &str| s.parse::<f64>().expect("a number");
    match words[..] {
        ["delaunay", points] => {
            let points = read_points(points);
            let start = cpu_seconds();
            let t = DelaunayTriangulation::<_>::bulk_load(points).expect("points in range");
            println!("{:.4} {} {}", cpu_seconds() - start, t.num_vertices(), t.num_inner_faces());
        }
        ["constrained", points, segments] => {
            let (points, segments) = (read_points(points), read_segments(segments));
            let start = cpu_seconds();
            let t = Cdt::bulk_load_cdt(points, segments).expect("points in range");
            println!("{:.4} {} {}", cpu_seconds() - start, t.num_vertices(), t.num_inner_faces());
        }
        ["refine", shape, area, degrees] => {
            let corners = match shape {
                "square" => [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
                _ => [(0.0, 0.0), (1.0, 0.125), (0.875, 1.0625), (-0.0625, 0.9375)],
            };
            let corners = corners.map(|(x, y)| Point2::new(x, y));
            let start = cpu_seconds();
            let mut t = Cdt::bulk_load_cdt(corners.to_vec(), vec![[0, 1], [1, 2], [2, 3], [3, 0]]).expect("a simple polygon");
            t.refine(parameters(number(degrees), number(area), 100_000_000));
            let seconds = cpu_seconds() - start;
            let (triangles, angle, _) = quality(&t, &HashSet::new());
            println!("{seconds:.4} {} {triangles} {angle:.4}", t.num_vertices());
        }
        ["mesh", degrees, area, limit] => mesh(number(degrees), number(area), number(limit) as usize),
        _ => std::process::exit(2),
    }
}
