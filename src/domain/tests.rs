//! `prepare` against definitions: tables, integer grids against brute force, the corpus.

use super::*;
use crate::arith::FastKernel;
use crate::model::{Fill, Lines, Point2, Pslg, Region, Segment, VertexId};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn graph(points: &[(i32, i32)], segments: &[(u32, u32)]) -> Pslg {
    let segment = |(i, &(u, v)): (usize, &(u32, u32))| Segment {
        ends: [VertexId(u), VertexId(v)],
        marker: i as i32 + 1,
        toggles: i % 3 != 2,
    };
    Pslg {
        points: points.iter().map(|&(x, y)| Point2::new(x.into(), y.into())).collect(),
        segments: segments.iter().enumerate().map(segment).collect(),
        ..Pslg::default()
    }
}

fn prepared(g: &Pslg) -> Prepared {
    prepare::<FastKernel>(g, &Lines::default())
}

/// Kinds with the elements they name.
fn told(p: &Prepared) -> Vec<(Kind, String)> {
    let name = |f: &Finding| f.elements.iter().map(|e| e.to_string()).collect::<Vec<_>>().join(" ");
    p.findings.iter().map(|f| (f.kind, name(f))).collect()
}

#[test]
fn table_of_findings() {
    use Kind::*;
    let square = [(0, 0), (4, 0), (4, 4), (0, 4)];
    let ring = [(0, 1), (1, 2), (2, 3), (3, 0)];
    let with = |points: &[(i32, i32)], segments: &[(u32, u32)]| {
        graph(&[&square[..], points].concat(), &[&ring[..], segments].concat())
    };
    let table: Vec<(Pslg, Vec<(Kind, &str)>)> = vec![
        (with(&[], &[]), vec![]),
        (with(&[], &[(0, 2), (1, 3)]), vec![(Crossing, "segment 4 segment 5")]),
        // A vertex exactly at the crossing makes four parts of two segments.
        (
            with(&[(2, 2)], &[(0, 2), (1, 3)]),
            vec![(VertexOnSegment, "segment 4 vertex 4"), (VertexOnSegment, "segment 5 vertex 4")],
        ),
        (with(&[(0, 4)], &[]), vec![(CoincidentVertices, "vertex 3 vertex 4")]),
        (with(&[], &[(1, 0)]), vec![(DoubledSegment, "segment 0 segment 4")]),
        (with(&[], &[(2, 2)]), vec![(ZeroLength, "segment 4")]),
        (with(&[], &[(2, 9)]), vec![(BadIndex, "segment 4")]),
        (with(&[(2, 1)], &[]), vec![(IsolatedVertex, "vertex 4")]),
        (with(&[(2, 1)], &[(0, 4)]), vec![(DanglingSegment, "segment 4 vertex 4")]),
        (
            graph(&[(0, 0), (2, 0), (1, 0), (3, 0)], &[(0, 1), (2, 3)]),
            vec![
                (VertexOnSegment, "segment 0 vertex 2"),
                (VertexOnSegment, "segment 1 vertex 1"),
                (Overlap, "segment 0 segment 1"),
                (DanglingSegment, "segment 0 vertex 0"),
                (DanglingSegment, "segment 1 vertex 3"),
            ],
        ),
    ];
    for (g, expected) in table {
        let expected: Vec<_> = expected.into_iter().map(|(k, s)| (k, s.to_string())).collect();
        assert_eq!(told(&prepared(&g)), expected, "{:?}", g.segments);
    }
}

#[test]
fn toggling_segments_close_up() {
    let lines = Lines { points: (2..8).collect(), segments: (10..20).collect(), ..Lines::default() };
    let square = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 0), (2, 4)];
    let ring = [(0, 1), (1, 2), (2, 3), (3, 0)];
    let with = |segments: &[(u32, u32)], toggles: &[bool]| {
        let mut g = graph(&square, segments);
        g.fill = Fill::Parity;
        for (i, s) in g.segments.iter_mut().enumerate() {
            s.toggles = toggles.get(i).copied().unwrap_or(true);
        }
        let all = prepare::<FastKernel>(&g, &lines).findings;
        let open: Vec<_> = all.into_iter().filter(|f| f.kind == Kind::OpenCycle).collect();
        assert!(open.iter().all(|f| f.severity() == Severity::Error));
        open.iter().map(|f| (f.to_string(), f.coordinates.clone(), f.lines.clone())).collect::<Vec<_>>()
    };
    assert_eq!(with(&ring, &[]), []);
    // A wall that toggles nothing, a doubled one, and one that joins a vertex to itself, change nothing.
    assert_eq!(with(&[&ring[..], &[(4, 5)]].concat(), &[true, true, true, true, false]), []);
    assert_eq!(with(&[&ring[..], &[(4, 5), (5, 4), (3, 3)]].concat(), &[]), []);
    // The parts of a ring between vertices inside its segments close as it does.
    assert_eq!(with(&[(0, 1), (1, 2), (2, 3), (3, 0), (4, 0), (0, 3), (3, 5), (5, 4)], &[]), []);
    let told = with(&ring, &[true, true, true, false]);
    let places: Vec<_> = told.iter().map(|t| (t.1[0], &t.2[..])).collect();
    assert_eq!(places, [(Point2::new(0.0, 0.0), &[2, 10][..]), (Point2::new(0.0, 4.0), &[5, 12][..])]);
    assert!(told[0].0.starts_with("error: the toggling segments do not close up at vertex 0 (0, 0)"), "{}", told[0].0);
    // A dangling wall to the middle of a side: odd at both its ends, the one on the side included.
    assert_eq!(with(&[&ring[..], &[(4, 2)]].concat(), &[]).iter().map(|t| t.2.len()).collect::<Vec<_>>(), [4, 2]);
    // Under other fills nothing is asked.
    let open = Pslg { fill: Fill::Convex, ..graph(&square, &ring) };
    assert!(prepared(&open).findings.iter().all(|f| f.kind != Kind::OpenCycle));
}

#[test]
fn parts_follow_their_segment() {
    let g = graph(&[(6, 0), (0, 0), (4, 0), (2, 0), (1, 5)], &[(4, 0), (0, 1), (1, 4)]);
    let p = prepared(&g);
    let ends: Vec<_> = p.pslg.segments.iter().map(|s| (s.ends[0].0, s.ends[1].0, s.marker)).collect();
    assert_eq!(ends, [(4, 0, 1), (0, 2, 2), (2, 3, 2), (3, 1, 2), (1, 4, 3)]);
    assert_eq!(p.segment_origin.iter().map(|s| s.0).collect::<Vec<_>>(), [0, 1, 1, 1, 2]);
}

#[test]
fn numbers_that_cannot_be_computed_with() {
    let mut g = graph(&[(0, 0), (4, 0), (0, 4)], &[(0, 1), (1, 2), (2, 0)]);
    g.points[1].x = f64::NAN;
    g.holes = vec![Point2::new(1e300, 0.0), Point2::new(1.0, f64::INFINITY)];
    g.regions = vec![Region { seed: Point2::new(1.0, 1.0), attribute: f64::NAN, max_area: Some(-1.0) }];
    g.attributes = vec![0.0, 1.0, f64::NAN];
    g.attributes_per_point = 1;
    use Kind::*;
    let kinds: Vec<_> = told(&prepared(&g)).into_iter().filter(|f| f.0.severity() == Severity::Error).collect();
    let expected = [
        (NotFinite, "vertex 1"),
        (NotFinite, "vertex 2"),
        (NotFinite, "hole 1"),
        (NotFinite, "region 0"),
        (OutOfRange, "hole 0"),
        (OutOfRange, "region 0"),
    ];
    assert_eq!(kinds, expected.map(|(k, s)| (k, s.to_string())));
}

#[test]
fn lists_are_cut_and_the_total_told() {
    // A thousand horizontal lines across fifty vertical ones.
    let mut points = Vec::new();
    let mut segments = Vec::new();
    for i in 0..1050 {
        let (a, b) =
            if i < 1000 { ((-1, 2 * i), (200, 2 * i)) } else { ((2 * (i - 1000), -1), (2 * (i - 1000), 3000)) };
        segments.push((points.len() as u32, points.len() as u32 + 1));
        points.extend([a, b]);
    }
    let p = prepared(&graph(&points, &segments));
    let crossings: Vec<_> = p.findings.iter().filter(|f| f.kind == Kind::Crossing).collect();
    assert_eq!(crossings.len(), LISTED_PER_KIND + 1);
    assert!(crossings.last().expect("not empty").message.contains("50000 in all"), "{:?}", crossings.last());
}

type Ends = (u32, u32);

/// Crossing pairs and parts by the definitions, over all pairs.
fn by_definition(points: &[(i32, i32)], g: &Pslg) -> (Vec<Ends>, BTreeMap<Ends, (i32, bool)>) {
    let orient = |a: u32, b: u32, c: u32| {
        let [p, q, r] = [a, b, c].map(|v| points[v as usize]);
        ((q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)).signum()
    };
    let between = |a: u32, b: u32, w: u32| {
        let [p, q, r] = [a, b, w].map(|v| points[v as usize]);
        r != p && r != q && (r.0 - p.0) * (r.0 - q.0) <= 0 && (r.1 - p.1) * (r.1 - q.1) <= 0 && orient(a, b, w) == 0
    };
    let inside = |a, b| (0..points.len() as u32).filter(move |&w| between(a, b, w)).collect::<Vec<_>>();
    let segments: Vec<Ends> = g.segments.iter().map(|s| (s.ends[0].0, s.ends[1].0)).collect();
    let mut crossings = Vec::new();
    let mut parts: BTreeMap<Ends, (i32, bool)> = BTreeMap::new();
    for (i, &(a, b)) in segments.iter().enumerate() {
        if a == b {
            continue;
        }
        for (j, &(c, d)) in segments.iter().enumerate().skip(i + 1) {
            let proper = orient(a, b, c) * orient(a, b, d) < 0 && orient(c, d, a) * orient(c, d, b) < 0;
            if proper && !inside(a, b).iter().any(|w| inside(c, d).contains(w)) {
                crossings.push((i as u32, j as u32));
            }
        }
        let mut chain = inside(a, b);
        chain.extend([a, b]);
        chain.sort_by_key(|&v| points[v as usize]);
        for pair in chain.windows(2) {
            let key = (pair[0].min(pair[1]), pair[0].max(pair[1]));
            let s = g.segments[i];
            parts.entry(key).and_modify(|p| p.1 ^= s.toggles).or_insert((s.marker, s.toggles));
        }
    }
    (crossings, parts)
}

fn agrees_with_definition(points: &[(i32, i32)], segments: &[Ends]) {
    let g = graph(points, segments);
    let p = prepared(&g);
    let (crossings, parts) = by_definition(points, &g);
    let told = p.findings.iter().filter(|f| f.kind == Kind::Crossing);
    let told: Vec<Ends> = told
        .map(|f| match f.elements[..] {
            [Element::Segment(s), Element::Segment(t)] => (s.0, t.0),
            _ => panic!("{f:?}"),
        })
        .collect();
    assert_eq!(told, crossings);
    let made: Vec<_> = p.pslg.segments.iter().map(|s| ((s.ends[0].0, s.ends[1].0), (s.marker, s.toggles))).collect();
    let map: BTreeMap<Ends, _> = made.iter().map(|&((u, v), x)| ((u.min(v), u.max(v)), x)).collect();
    assert_eq!(map.len(), made.len(), "a part twice");
    assert_eq!(map, parts);
}

/// Distinct points of a small grid in any order, and segments among them.
fn grids(side: i32, most: usize) -> impl Strategy<Value = (Vec<(i32, i32)>, Vec<Ends>)> {
    let all: Vec<(i32, i32)> = (0..side * side).map(|i| (i % side, i / side)).collect();
    let least = 2usize.min(all.len());
    (proptest::sample::subsequence(all.clone(), least..=all.len().min(most)).prop_shuffle()).prop_flat_map(|points| {
        let n = points.len() as u32;
        (Just(points), prop::collection::vec((0..n, 0..n), 0..24))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]
    #[test]
    fn small_grids((points, segments) in grids(4, 16)) {
        agrees_with_definition(&points, &segments);
    }

    #[test]
    fn larger_grids((points, segments) in grids(9, 24)) {
        agrees_with_definition(&points, &segments);
    }

    #[test]
    fn lines_of_points((points, segments) in grids(9, 40).prop_map(|(p, s)| {
        // Two rows: most segments are vertical, or overlap.
        let mut p: Vec<_> = p.into_iter().map(|(x, y)| (x % 2, x / 2 + 5 * y)).collect();
        p.sort_unstable();
        p.dedup();
        let n = p.len() as u32;
        (p, s.into_iter().map(|(u, v)| (u % n, v % n)).collect::<Vec<_>>())
    })) {
        agrees_with_definition(&points, &segments);
    }
}
