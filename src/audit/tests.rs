//! Meshes that must pass and meshes that must not, each with the fault that it stands for.

// Rows of tables are tuples of what a row says.
#![allow(clippy::type_complexity)]

use super::*;
use crate::model::{Fill, Segment};

type Triangles = Vec<[u32; 3]>;

fn points(list: &[(f64, f64)]) -> Vec<Point2> {
    list.iter().map(|&(x, y)| Point2::new(x, y)).collect()
}

fn ids(triangles: &[[u32; 3]]) -> Vec<[VertexId; 3]> {
    triangles.iter().map(|t| t.map(VertexId)).collect()
}

fn run(p: &[(f64, f64)], triangles: &[[u32; 3]], claim: Claim) -> ClaimReport {
    let (p, t) = (points(p), ids(triangles));
    let subject = Subject { points: &p, triangles: &t, ..Subject::default() };
    let report = audit(&subject, &Options { claims: &[claim], ..Options::default() });
    report.claims.into_iter().next().expect("one claim was asked for")
}

fn shifted(triangles: &[[u32; 3]], by: u32) -> Triangles {
    triangles.iter().map(|t| t.map(|v| v + by)).collect()
}

const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];

/// A square ring: outer corners 0-3, inner corners 4-7.
fn ring() -> (Vec<(f64, f64)>, Triangles) {
    let p = [&SQUARE[..], &[(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)]].concat();
    let t = (0..4).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, i + 4], [j, j + 4, i + 4]]
    });
    (p, t.collect())
}

/// A fan of n triangles around vertex 0, the last one closing the circle, spread over `turns` turns.
fn fan(n: u32, turns: f64) -> (Vec<(f64, f64)>, Triangles) {
    let mut p = vec![(0.0, 0.0)];
    for i in 0..n {
        let a = f64::from(i) / f64::from(n) * turns * std::f64::consts::TAU;
        // Radii differ so that no two vertices coincide.
        let r = 1.0 + 0.01 * f64::from(i);
        p.push((r * a.cos(), r * a.sin()));
    }
    (p, (1..=n).map(|i| [0, i, i % n + 1]).collect())
}

#[test]
fn valid_meshes_pass() {
    let (ring_points, ring_triangles) = ring();
    let island: Vec<(f64, f64)> = [&ring_points[..], &[(1.5, 1.5), (2.0, 1.5), (2.0, 2.0)]].concat();
    let (fan_points, fan_triangles) = fan(7, 1.0);
    let table: Vec<(&str, Vec<(f64, f64)>, Triangles)> = vec![
        ("a triangle", SQUARE.to_vec(), vec![[0, 1, 2]]),
        ("a clockwise triangle", SQUARE.to_vec(), vec![[0, 2, 1]]),
        ("a square", SQUARE.to_vec(), vec![[0, 1, 2], [2, 3, 0]]),
        ("of mixed orientation", SQUARE.to_vec(), vec![[0, 2, 1], [2, 3, 0]]),
        ("a ring", ring_points, ring_triangles.clone()),
        ("an island in a ring", island, [&ring_triangles[..], &[[8, 9, 10]]].concat()),
        ("a fan", fan_points, fan_triangles),
        (
            "two triangles at a vertex",
            vec![(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (-1.0, 0.0), (-1.0, -1.0)],
            vec![[0, 1, 2], [0, 3, 4]],
        ),
        ("an unused vertex inside", vec![(0.0, 0.0), (4.0, 0.0), (0.0, 4.0), (1.0, 1.0)], vec![[0, 1, 2]]),
    ];
    for (name, p, t) in table {
        let report = run(&p, &t, Claim::Valid);
        assert_eq!(report.verdict, Verdict::Holds, "{name}: {:?}", report.witnesses);
    }
}

#[test]
fn invalid_meshes_do_not() {
    let (ring_points, ring_triangles) = ring();
    let square = vec![[0, 1, 2], [2, 3, 0]];
    let twice = [&SQUARE[..], &SQUARE.map(|(x, y)| (x + 0.5, y + 0.25))].concat();
    let inside = [&SQUARE[..], &SQUARE.map(|(x, y)| (x / 4.0 + 1.0, y / 4.0 + 1.0))].concat();
    let cracked = [&SQUARE[..], &[(0.0, 0.0), (4.0, 4.0)]].concat();
    let (branched, branched_triangles) = fan(9, 2.0);
    let plug = [&ring_triangles[..], &[[0, 1, 2]]].concat();
    // The ring and a square of its own vertices over the whole of it.
    let over_ring = [&ring_points[..], &SQUARE.map(|(x, y)| (2.0 * x - 2.0, 2.0 * y - 2.0))].concat();
    let table: Vec<(&str, Vec<(f64, f64)>, Triangles)> = vec![
        ("an index that does not exist", SQUARE.to_vec(), vec![[0, 1, 9]]),
        ("a repeated corner", SQUARE.to_vec(), vec![[0, 1, 1]]),
        ("a degenerate triangle", vec![(0.0, 0.0), (1.0, 1.0), (3.0, 3.0)], vec![[0, 1, 2]]),
        ("not a number", vec![(0.0, 0.0), (f64::NAN, 1.0), (3.0, 3.0)], vec![[0, 1, 2]]),
        ("a triangle twice", SQUARE.to_vec(), vec![[0, 1, 2], [0, 1, 2]]),
        ("a triangle twice, turned", SQUARE.to_vec(), vec![[0, 1, 2], [2, 1, 0]]),
        ("three triangles at an edge", SQUARE.to_vec(), vec![[0, 1, 2], [2, 3, 0], [0, 1, 3]]),
        ("a fold", vec![(0.0, 0.0), (4.0, 0.0), (0.0, 4.0), (1.0, 5.0)], vec![[0, 1, 2], [0, 1, 3]]),
        ("a double cover", twice, [square.clone(), shifted(&square, 4)].concat()),
        ("a mesh inside another", inside, [square.clone(), shifted(&square, 4)].concat()),
        ("a crack", cracked, vec![[0, 1, 2], [5, 3, 4]]),
        ("a branch point", branched, branched_triangles),
        ("a hole covered by a triangle of the ring's corners", ring_points, plug),
        ("a square around and over a ring", over_ring, [&ring_triangles[..], &shifted(&square, 8)].concat()),
        // The lower square is one edge long where the upper two meet in the middle of it.
        (
            "a hanging vertex",
            vec![(0.0, 0.0), (4.0, 0.0), (2.0, -3.0), (2.0, 0.0), (0.0, 3.0), (4.0, 3.0)],
            vec![[0, 2, 1], [0, 3, 4], [3, 1, 5], [3, 5, 4]],
        ),
        (
            "a triangle touching an edge",
            vec![(0.0, 0.0), (4.0, 0.0), (2.0, -3.0), (2.0, 0.0), (1.0, 1.0), (3.0, 1.0)],
            vec![[0, 2, 1], [3, 5, 4]],
        ),
        (
            "edges that overlap without a common end",
            vec![(0.0, 0.0), (4.0, 0.0), (2.0, -3.0), (1.0, 0.0), (3.0, 0.0), (2.0, 1.0)],
            vec![[0, 2, 1], [3, 4, 5]],
        ),
    ];
    for (name, p, t) in table {
        let report = run(&p, &t, Claim::Valid);
        assert_eq!(report.verdict, Verdict::Violated, "{name} passed");
        assert!(!report.witnesses.is_empty(), "{name} has no witness");
        // Neither the order of the triangles nor the place of the mesh matters.
        let backwards: Triangles = t.iter().rev().map(|&[a, b, c]| [b, c, a]).collect();
        let turned: Vec<_> = p.iter().map(|&(x, y)| (-y + 0.5, x)).collect();
        assert_eq!(run(&turned, &backwards, Claim::Valid).verdict, Verdict::Violated, "{name}, turned, passed");
    }
}

#[test]
fn orientation_names_the_clockwise() {
    assert_eq!(run(&SQUARE, &[[0, 1, 2], [2, 3, 0]], Claim::Orientation).verdict, Verdict::Holds);
    let report = run(&SQUARE, &[[0, 1, 2], [2, 0, 3]], Claim::Orientation);
    assert_eq!((report.violations, &report.witnesses[0].triangles[..]), (1, &[1][..]));
    assert_eq!(run(&SQUARE, &[[0, 2, 1], [2, 0, 3]], Claim::Orientation).violations, 2);
}

#[test]
fn empty_circles() {
    use Verdict::*;
    let kite = [(0.0, 0.0), (4.0, 0.0), (5.0, 4.0), (0.0, 4.0)];
    // Two triangles apart: vertex 3 lies in the circle of the first, behind the border.
    let apart = [(0.0, 0.0), (10.0, 0.0), (5.0, 6.0), (9.0, 4.0), (20.0, 4.0), (20.0, 20.0)];
    let two = [[0, 1, 2], [3, 4, 5]];
    let split = |d| {
        if d == 0 { vec![[0, 1, 2], [2, 3, 0]] } else { vec![[0, 1, 3], [1, 2, 3]] }
    };
    let rows: Vec<(&[(f64, f64)], Triangles, [Verdict; 3])> = vec![
        (&kite, split(1), [Holds, Holds, Holds]),
        (&kite, split(0), [Violated, Violated, Violated]),
        (&apart, two.to_vec(), [Violated, Holds, Holds]),
    ];
    for (p, t, expected) in rows {
        let got = [Claim::Delaunay, Claim::Constrained, Claim::Canonical].map(|c| run(p, &t, c).verdict);
        assert_eq!(got, expected, "{t:?}");
    }
    // Of the two diagonals of a square both are Delaunay and one is canonical.
    let canonical = [0, 1].map(|d| run(&SQUARE, &split(d), Claim::Canonical).verdict);
    assert_eq!([0, 1].map(|d| run(&SQUARE, &split(d), Claim::Delaunay).verdict), [Holds, Holds]);
    assert!(canonical == [Holds, Violated] || canonical == [Violated, Holds]);
}

fn input(p: &[(f64, f64)], segments: &[[u32; 2]], holes: &[(f64, f64)]) -> Pslg {
    let segment = |s: &[u32; 2]| Segment { ends: s.map(VertexId), marker: 0, toggles: false };
    Pslg {
        points: points(p),
        segments: segments.iter().map(segment).collect(),
        holes: points(holes),
        ..Pslg::default()
    }
}

fn conforms(p: &[(f64, f64)], triangles: &[[u32; 3]], to: &Pslg) -> ClaimReport {
    let (p, t) = (points(p), ids(triangles));
    let subject = Subject { points: &p, triangles: &t, ..Subject::default() };
    let lines = Lines::default();
    let options = Options { claims: &[Claim::Conforming], input: Some((to, &lines)), ..Options::default() };
    audit(&subject, &options).claims.remove(0)
}

const SIDES: [[u32; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];

#[test]
fn conforming_accepts_and_rejects() {
    use Verdict::*;
    let (ring_points, ring_triangles) = ring();
    let inner = [[4, 5], [5, 6], [6, 7], [7, 4]];
    let both = [&SIDES[..], &inner[..]].concat();
    let full = [&ring_triangles[..], &[[4, 5, 6], [6, 7, 4]]].concat();
    let square = [[0, 1, 2], [2, 3, 0]];
    let other = [[0, 1, 3], [1, 2, 3]];
    let hole = (2.0, 2.0);
    let outside = |p: &[(f64, f64)], s: &[[u32; 2]]| input(&[&SQUARE[..], p].concat(), &[&SIDES[..], s].concat(), &[]);
    let tail = [(6.0, 5.0), (7.0, 5.0), (6.0, 7.0)];
    let rows: Vec<(&str, &[(f64, f64)], &[[u32; 3]], Pslg, Verdict)> = vec![
        ("a square", &SQUARE, &square, input(&SQUARE, &SIDES, &[]), Holds),
        ("its diagonal", &SQUARE, &square, input(&SQUARE, &[&SIDES[..], &[[2, 0]]].concat(), &[]), Holds),
        ("the other diagonal", &SQUARE, &other, input(&SQUARE, &[&SIDES[..], &[[2, 0]]].concat(), &[]), Violated),
        ("half of it", &SQUARE, &square[..1], input(&SQUARE, &SIDES, &[]), Violated),
        ("a vertex inside is missing", &SQUARE, &square, outside(&[(1.0, 2.0)], &[]), Violated),
        ("a vertex on the border is missing", &SQUARE, &square, outside(&[(4.0, 2.0)], &[]), Violated),
        ("a vertex outside", &SQUARE, &square, outside(&[(6.0, 2.0)], &[]), Holds),
        ("a tail outside", &SQUARE, &square, outside(&tail[..2], &[[2, 4], [4, 5]]), Holds),
        ("a closed part left out", &SQUARE, &square, outside(&tail, &[[2, 4], [4, 5], [5, 6], [6, 4]]), Violated),
        ("a ring and its hole", &ring_points, &ring_triangles, input(&ring_points, &both, &[hole]), Holds),
        ("a hole nobody asked for", &ring_points, &ring_triangles, input(&ring_points, &both, &[]), Violated),
        ("a hole that is covered", &ring_points, &full, input(&ring_points, &both, &[hole]), Violated),
        ("a face inside", &ring_points, &full, input(&ring_points, &both, &[]), Holds),
    ];
    for (name, p, t, to, expected) in rows {
        let report = conforms(p, t, &to);
        assert_eq!(report.verdict, expected, "{name}: {:?}", report.witnesses);
    }
}

#[test]
fn chains_are_monotone_and_near() {
    // The bottom side is split at (2, y); y in ulps of 4.
    let ulp = 4f64.next_up() - 4.0;
    let split = |x: f64, y: f64| {
        let p = [&SQUARE[..], &[(x, y * ulp)]].concat();
        conforms(&p, &[[0, 4, 3], [4, 1, 2], [4, 2, 3]], &input(&SQUARE, &SIDES, &[]))
    };
    for (y, expected) in
        [(0.0, Verdict::Holds), (2.0, Verdict::Holds), (-2.0, Verdict::Holds), (2.5, Verdict::Violated)]
    {
        let report = split(2.0, y);
        assert_eq!(report.verdict, expected, "{y}");
        if expected == Verdict::Holds {
            assert_eq!(report.figures[0], ("largest_deviation_ulps", f64::abs(y)));
        }
    }
    // A vertex beyond the end is on the line, but no chain goes there and back.
    let p = [&SQUARE[..], &[(5.0, 0.0)]].concat();
    let beyond = conforms(&p, &[[0, 4, 3], [4, 1, 3], [1, 2, 3]], &input(&SQUARE, &SIDES, &[]));
    assert_eq!(beyond.verdict, Verdict::Violated);
}

/// A mesh of the hull without a triangle at the hull once conformed.
#[test]
fn a_mesh_of_the_hull_reaches_the_hull() {
    use Verdict::*;
    // A square with two points on its left side, and one inside; the hull has 6 edges.
    let p = [&SQUARE[..], &[(0.0, 1.0), (0.0, 3.0), (2.0, 2.0)]].concat();
    let fan: Triangles = [[0, 1], [1, 2], [2, 3], [3, 5], [5, 4], [4, 0]].iter().map(|&[u, v]| [u, v, 6]).collect();
    let convex =
        |p: &[(f64, f64)], s: &[[u32; 2]], holes: &[(f64, f64)]| Pslg { fill: Fill::Convex, ..input(p, s, holes) };
    let part = convex(&p, &[[0, 6], [6, 1]], &[]);
    assert_eq!(conforms(&p, &fan, &convex(&p, &[], &[])).verdict, Holds);
    assert_eq!(conforms(&p, &fan, &part).verdict, Holds);
    for left_out in 0..6 {
        let rest = [&fan[..left_out], &fan[left_out + 1..]].concat();
        assert_eq!(conforms(&p, &rest, &convex(&p, &[], &[])).verdict, Violated, "without triangle {left_out}");
        // Bounded by segments, but no hole.
        assert_eq!(conforms(&p, &rest, &part).verdict, Violated, "without triangle {left_out}");
    }
    let hole = convex(&p, &[[0, 6], [6, 1]], &[(2.0, 0.5)]);
    assert_eq!(conforms(&p, &fan[1..], &hole).verdict, Holds);
    assert_eq!(conforms(&p, &fan[2..], &hole).verdict, Violated);
    assert_eq!(conforms(&p, &fan, &hole).verdict, Violated);
    // A corner of the hull is no vertex of the mesh.
    let cut = [[0, 1, 3], [1, 2, 3]];
    assert_eq!(conforms(&SQUARE, &cut[..1], &convex(&SQUARE, &[], &[])).verdict, Violated);
    assert_eq!(conforms(&SQUARE, &cut, &convex(&SQUARE, &[], &[])).verdict, Holds);
}

/// Two segments nearer to each other than `within` once shared a chain, and the mesh left out what lies between them.
#[test]
fn chains_meet_at_ends_of_segments_only() {
    // A wedge of three ulps: its long sides 0-1 and 0-2, split at 3 and 4.
    let e = 2f64.powi(-50);
    let p = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0 * e), (2.0, 0.0), (2.5, 1.875 * e)];
    let whole = [[0, 3, 4], [3, 1, 4], [1, 2, 4]];
    let split = input(&p[..3], &[[0, 1], [1, 2], [2, 0]], &[]);
    let given = input(&p, &[[0, 3], [3, 1], [1, 2], [2, 4], [4, 0]], &[]);
    for to in [split, given] {
        assert_eq!(conforms(&p, &whole, &to).verdict, Verdict::Holds);
        for left_out in 0..3 {
            let rest = [&whole[..left_out], &whole[left_out + 1..]].concat();
            assert_eq!(conforms(&p, &rest, &to).verdict, Verdict::Violated, "without triangle {left_out}");
        }
    }
}

#[test]
fn constraints_hide_vertices() {
    // The wrong diagonal of a kite is constrained Delaunay only if it is a segment.
    let kite = [(0.0, 0.0), (4.0, 0.0), (5.0, 4.0), (0.0, 4.0)];
    let (p, t) = (points(&kite), ids(&[[0, 1, 2], [2, 3, 0]]));
    let edges = [[VertexId(2), VertexId(0)]];
    let verdict = |edges: &[[VertexId; 2]], attributes: &[f64]| {
        let subject =
            Subject { points: &p, triangles: &t, edges, triangle_attributes: attributes, ..Subject::default() };
        audit(&subject, &Options { claims: &[Claim::Constrained], ..Options::default() }).claims[0].verdict
    };
    assert_eq!(verdict(&[], &[]), Verdict::Violated);
    assert_eq!(verdict(&edges, &[]), Verdict::Holds);
    assert_eq!(verdict(&[], &[1.0, 2.0]), Verdict::Holds);
    assert_eq!(verdict(&[], &[1.0, 1.0]), Verdict::Violated);
    // Constraints told by the file stand for all: the interface is then none.
    assert_eq!(verdict(&[[VertexId(0), VertexId(1)]], &[1.0, 2.0]), Verdict::Violated);
    let with_input = |segments: &[[u32; 2]]| {
        let graph = Pslg { fill: Fill::Convex, ..input(&kite, segments, &[]) };
        let subject = Subject { points: &p, triangles: &t, ..Subject::default() };
        let lines = Lines::default();
        let options = Options { claims: &[Claim::Constrained], input: Some((&graph, &lines)), ..Options::default() };
        audit(&subject, &options).claims[0].verdict
    };
    assert_eq!([with_input(&[]), with_input(&[[0, 2]])], [Verdict::Violated, Verdict::Holds]);
}

#[test]
fn a_vertex_of_no_triangle_in_a_triangle() {
    // Two triangles without a tie between them.
    let kite = [(0.0, 0.0), (4.0, 0.0), (3.5, 3.5), (0.0, 4.0)];
    let (t, diagonal) = (ids(&[[0, 1, 2], [2, 3, 0]]), [[VertexId(0), VertexId(2)]]);
    let verdicts = |extra: (f64, f64), edges: &[[VertexId; 2]]| {
        let p = points(&[&kite[..], &[extra]].concat());
        let subject = Subject { points: &p, triangles: &t, edges, ..Subject::default() };
        let claims = [Claim::Delaunay, Claim::Constrained, Claim::Canonical];
        audit(&subject, &Options { claims: &claims, ..Options::default() }).claims
    };
    // Inside, on the common edge, on the border. A constraint through the vertex does not hide it.
    for (extra, holder) in [((3.0, 1.0), 0), ((2.0, 2.0), 0), ((0.0, 1.0), 1)] {
        for report in verdicts(extra, &[]).into_iter().chain(verdicts(extra, &diagonal)) {
            assert_eq!((report.verdict, report.violations), (Verdict::Violated, 1), "{extra:?} {report:?}");
            let w = &report.witnesses[0];
            assert_eq!((w.vertices[0], w.coordinates[0], &w.triangles[..]), (4, [extra.0, extra.1], &[holder][..]));
            assert!(w.message.contains(&format!("vertex 4 at ({}, {})", extra.0, extra.1)), "{}", w.message);
        }
    }
    // At a corner, outside, in a circle but outside, nowhere.
    for extra in [(3.5, 3.5), (9.0, 9.0), (4.2, 2.0), (f64::NAN, 2.0)] {
        for report in verdicts(extra, &[]) {
            assert_eq!(report.verdict, Verdict::Holds, "{extra:?} {report:?}");
            assert_eq!(report.figures, [("vertices_outside", 1.0)], "{extra:?}");
        }
    }
}

#[test]
fn the_largest_numbers_have_a_unit_in_the_last_place() {
    // A chain is looked for, with a tolerance that was infinite where the next number is.
    let far = [(0.0, 0.0), (f64::MAX, 0.0), (f64::MAX, f64::MAX), (f64::MAX / 2.0, 0.0)];
    let graph = input(&far[..3], &[[0, 1], [1, 2], [2, 0]], &[]);
    let report = conforms(&far, &[[0, 3, 2], [3, 1, 2]], &graph);
    assert_eq!(report.verdict, Verdict::Holds, "{report:?}");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(2000))]
    /// Of many vertices in no triangle, those in triangles are told by the tree as by trying all.
    #[test]
    fn isolated_vertices_by_definition(extra in proptest::collection::vec((0i32..25, 0i32..25), 0..60)) {
        let (ring, triangles) = ring();
        let places: Vec<(f64, f64)> = extra.iter().map(|&(x, y)| (f64::from(x) / 4.0 - 1.0, f64::from(y) / 4.0 - 1.0)).collect();
        // The ring: in the closed square, not in the open inner one; its corners are no violations.
        let held = |&(x, y): &(f64, f64)| {
            let within = |low: f64, high: f64| x >= low && x <= high && y >= low && y <= high;
            let open = x > 1.0 && x < 3.0 && y > 1.0 && y < 3.0;
            within(0.0, 4.0) && !open && !ring.contains(&(x, y))
        };
        let report = run(&[&ring[..], &places[..]].concat(), &triangles, Claim::Constrained);
        let expected = places.iter().filter(|p| held(p)).count();
        proptest::prop_assert_eq!(report.violations, expected as u64);
        let others = report.figures.first().map_or(0.0, |f| f.1);
        proptest::prop_assert_eq!(others, (places.len() - expected) as f64);
    }
}

#[test]
fn topology_counts() {
    let (p, t) = ring();
    let figures = run(&p, &t, Claim::Topology).figures;
    let figure = |name| figures.iter().find(|f| f.0 == name).map(|f| f.1);
    for (name, value) in
        [("euler_characteristic", 0.0), ("holes", 1.0), ("components", 1.0), ("border_loops", 2.0), ("edges", 16.0)]
    {
        assert_eq!(figure(name), Some(value), "{name}");
    }
    // Three triangles that meet in pairs at vertices enclose a hole, and are three by edges.
    let p = [(0.0, 0.0), (4.0, 0.0), (2.0, 3.0), (2.0, -1.0), (4.0, 3.0), (0.0, 3.0)];
    let figures = run(&p, &[[0, 3, 1], [1, 4, 2], [2, 5, 0]], Claim::Topology).figures;
    let figure = |name| figures.iter().find(|f| f.0 == name).map(|f| f.1);
    for (name, value) in
        [("holes", 1.0), ("components", 1.0), ("edge_connected_components", 3.0), ("pinched_vertices", 3.0)]
    {
        assert_eq!(figure(name), Some(value), "{name}");
    }
}

#[test]
fn quality_of_a_right_triangle() {
    let report = run(&SQUARE, &[[0, 1, 2], [2, 3, 0]], Claim::Quality);
    let figure = |name| report.figures.iter().find(|f| f.0 == name).map_or(f64::NAN, |f| f.1);
    assert!((figure("min_angle") - 45.0).abs() < 1e-9 && (figure("max_angle") - 90.0).abs() < 1e-9);
    assert!((figure("max_radius_edge") - 0.5f64.sqrt()).abs() < 1e-9);
    assert_eq!((figure("min_area"), figure("triangles")), (8.0, 2.0));
}

#[test]
fn claimed_quality_is_exact() {
    // Half squares have r^2 / l^2 = 1/2 exactly; a tie is skinny.
    let (p, t) = (points(&SQUARE), ids(&[[0, 1, 2], [2, 3, 0]]));
    let subject = Subject { points: &p, triangles: &t, ..Subject::default() };
    for (rho2, expected) in [(0.5, 2), (0.5f64.next_up(), 0), (0.5f64.next_down(), 2)] {
        let options = Options { claims: &[Claim::Quality], rho2: Some(rho2), ..Options::default() };
        assert_eq!(audit(&subject, &options).claims[0].violations, expected, "{rho2:e}");
    }
}

/// Whether two triangles of grid points meet in a common vertex, a common edge, or not at all: their interiors are separated by the
/// line of an edge of one of them, and no corner of one that is not shared lies in the other.
fn meet_properly(p: &[(i64, i64)], s: [u32; 3], t: [u32; 3]) -> bool {
    let turn = |a: u32, b: u32, c: u32| {
        let [a, b, c] = [a, b, c].map(|v| p[v as usize]);
        ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)).signum()
    };
    let sides = |t: [u32; 3]| [(t[0], t[1], t[2]), (t[1], t[2], t[0]), (t[2], t[0], t[1])];
    let separates = |s: [u32; 3], t: [u32; 3]| {
        sides(s).iter().any(|&(a, b, c)| t.iter().all(|&v| turn(a, b, v) * turn(a, b, c) <= 0))
    };
    let holds = |t: [u32; 3], v: u32| sides(t).iter().all(|&(a, b, c)| turn(a, b, v) * turn(a, b, c) >= 0);
    let apart = |s: [u32; 3], t: [u32; 3]| s.iter().all(|&v| t.contains(&v) || !holds(t, v));
    (separates(s, t) || separates(t, s)) && apart(s, t) && apart(t, s)
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(20_000))]
    #[test]
    fn triangles_of_a_grid_by_definition(
        triangles in proptest::collection::vec(proptest::array::uniform3(0u32..16), 1..6)
    ) {
        let grid: Vec<(i64, i64)> = (0..16).map(|i| (i % 4, i / 4)).collect();
        let area = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(|v| grid[v as usize]);
            (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
        };
        let pairs = |i: usize| (0..i).all(|j| meet_properly(&grid, triangles[i], triangles[j]));
        let expected = triangles.iter().all(|&t| area(t) != 0) && (0..triangles.len()).all(pairs);
        let p: Vec<(f64, f64)> = grid.iter().map(|&(x, y)| (x as f64, y as f64)).collect();
        let report = run(&p, &triangles, Claim::Valid);
        proptest::prop_assert_eq!(report.verdict == Verdict::Holds, expected, "{:?}", report);
    }
}
