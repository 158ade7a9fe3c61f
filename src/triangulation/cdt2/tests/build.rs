//! Building: the definition, whatever the order of points and segments; bad input named; large and long ones in time.

use super::*;
use proptest::prelude::*;

#[test]
fn delaunay_is_the_definition() {
    let mut built = 0;
    for seed in 0..2000 {
        let points = points_of(seed);
        match Cdt::delaunay(points.clone()) {
            Ok(m) => {
                validate(&m);
                m.validate_hull().unwrap();
                assert_eq!(triples(&m), definition(&points), "seed {seed}");
                built += 1;
            }
            Err(e) => {
                assert_eq!(e, BuildError::Collinear, "seed {seed}");
                assert!(points.windows(3).all(|w| K::orient2d(w[0], w[1], w[2]) == Sign::Zero));
            }
        }
    }
    assert!(built > 1900);
}

#[test]
fn the_order_of_points_and_segments_does_not_matter() {
    for seed in 0..600 {
        let points = points_of(seed);
        let mut draw = Draw(!seed);
        let wanted = draw.below(15) as usize;
        let segments = segments_among(&points, wanted, &mut draw);
        let Some(m) = built(&points, &segments) else {
            continue;
        };
        validate(&m);
        m.validate_hull().unwrap();
        let mut expected: Vec<_> =
            (0u32..).zip(&segments).map(|(i, s)| (s[0].min(s[1]), s[0].max(s[1]), SegmentId(i))).collect();
        expected.sort_unstable();
        assert_eq!(labelled(&m), expected, "seed {seed}");

        let mut rank: Vec<u32> = (0..points.len() as u32).collect();
        draw.shuffle(&mut rank);
        let mut shuffled = points.clone();
        for (i, &r) in rank.iter().enumerate() {
            shuffled[r as usize] = points[i];
        }
        let renamed: Vec<[VertexId; 2]> =
            segments.iter().rev().map(|s| [s[1], s[0]].map(|v| VertexId(rank[v.index()]))).collect();
        let other = built(&shuffled, &renamed).unwrap();
        let mut back: Vec<Triangle> = triples(&m)
            .into_iter()
            .map(|t| crate::model::canonical_triangle(t.map(|v| VertexId(rank[v.index()]))))
            .collect();
        back.sort_unstable();
        assert_eq!(triples(&other), back, "seed {seed}");
    }
}

#[test]
fn bad_points_and_segments_are_named() {
    let p = |x: i32, y: i32| Point2::new(f64::from(x), f64::from(y)) / 16.0;
    let mut points = vec![p(3, 3), p(0, 0), p(1, 5), p(0, 0), p(3, 3), p(7, 2)];
    assert_eq!(Cdt::delaunay(points.clone()).err(), Some(BuildError::Duplicate(VertexId(0), VertexId(4))));
    points.truncate(4);
    assert_eq!(Cdt::delaunay(points).err(), Some(BuildError::Duplicate(VertexId(1), VertexId(3))));
    assert_eq!(Cdt::delaunay(vec![p(0, 0), p(1, 1), p(2, 2)]).err(), Some(BuildError::Collinear));
    assert_eq!(Cdt::delaunay(vec![p(1, 1), p(1, 1)]).err(), Some(BuildError::Duplicate(VertexId(0), VertexId(1))));
    assert_eq!(Cdt::delaunay(vec![]).err(), Some(BuildError::Collinear));

    let points = vec![p(0, 0), p(4, 0), p(4, 4), p(0, 4), p(2, 2), p(2, 0)];
    let constrain = |segments: &[[u32; 2]]| {
        let segments: Vec<_> = segments.iter().map(|s| s.map(VertexId)).collect();
        Cdt::delaunay(points.clone()).unwrap().constrain(&segments)
    };
    assert_eq!(constrain(&[[0, 2]]), Err(BuildError::VertexOnSegment(SegmentId(0), VertexId(4))));
    assert_eq!(constrain(&[[1, 0]]), Err(BuildError::VertexOnSegment(SegmentId(0), VertexId(5))));
    assert_eq!(constrain(&[[0, 0]]), Err(BuildError::VertexOnSegment(SegmentId(0), VertexId(0))));
    assert_eq!(constrain(&[[0, 4], [4, 0]]), Err(BuildError::Crossing(SegmentId(0), SegmentId(1))));
    assert_eq!(constrain(&[[5, 2], [1, 4]]), Err(BuildError::Crossing(SegmentId(0), SegmentId(1))));
    assert_eq!(constrain(&[[5, 2], [1, 0]]), Err(BuildError::VertexOnSegment(SegmentId(1), VertexId(5))));
    assert_eq!(constrain(&[[5, 2], [1, 2], [3, 0]]), Ok(()));
}

proptest! {
    #[test]
    fn grids_have_one_triangulation(width in 2u32..7, height in 2u32..7, seed: u64) {
        let mut points: Vec<Point2> = (0..width * height)
            .map(|i| Point2::new(f64::from(i % width), f64::from(i / width)) / 8.0)
            .collect();
        Draw(seed).shuffle(&mut points);
        let m = Cdt::delaunay(points.clone()).unwrap();
        validate(&m);
        m.validate_hull().unwrap();
        prop_assert_eq!(triples(&m), definition(&points));
    }
}

/// No vertex in conflict with a triangle is seen from its centroid. Coordinates are multiples of 3, so the centroid is exact.
#[test]
fn no_vertex_in_conflict_is_seen() {
    let mut hidden = 0;
    for seed in 0..300 {
        let mut draw = Draw(seed);
        let mut points: Vec<Point2> = Vec::new();
        while points.len() < 25 {
            let p = Point2::new(f64::from(draw.below(24)), f64::from(draw.below(24))) * 3.0;
            if !points.contains(&p) {
                points.push(p);
            }
        }
        let segments = segments_among(&points, 12, &mut draw);
        let m = built(&points, &segments).unwrap();
        for t in m.triangles() {
            let corners = m.corners(t);
            let center = (corners[0] + corners[1] + corners[2]) / 3.0;
            for &q in points.iter().filter(|q| !corners.contains(q)) {
                if !K::in_conflict(corners, q) {
                    continue;
                }
                let ends = |s: &[VertexId; 2]| s.map(|v| points[v.index()]);
                let crossed = segments.iter().any(|s| {
                    let [a, b] = ends(s);
                    let apart = K::orient2d(a, b, center) == K::orient2d(a, b, q).reversed();
                    let [at_a, at_b] = [a, b].map(|p| K::orient2d(center, q, p));
                    // Seen past an end is seen; q itself may be an end.
                    apart && K::orient2d(a, b, q) != Sign::Zero && at_a == at_b.reversed() && at_a != Sign::Zero
                });
                let through_vertex = points.iter().any(|&p| p != q && K::orient2d(center, q, p) == Sign::Zero);
                assert!(crossed || through_vertex, "seed {seed}: {corners:?} and {q}");
                hidden += 1;
            }
        }
    }
    assert!(hidden > 500);
}

#[test]
fn large_ones_are_valid() {
    for kind in [0u64, 4] {
        let mut draw = Draw(kind);
        let n = 100_000;
        let spread = |draw: &mut Draw| match kind {
            0 => Point2::new(draw.unit(), draw.unit()),
            _ => {
                let c = Point2::new(f64::from(draw.below(30)), f64::from(draw.below(30))) / 32.0;
                c + Point2::new(draw.unit(), draw.unit()) * draw.unit() * 1e-3
            }
        };
        let points: Vec<Point2> = (0..n).map(|_| spread(&mut draw)).collect();
        let coarse = Cdt::delaunay(points[..n / 3].to_vec()).unwrap();
        let edges = coarse.triangles().flat_map(|t| coarse.edges(t).map(|e| [coarse.origin(e), coarse.destination(e)]));
        let segments: Vec<_> = edges.filter(|[u, v]| u < v).step_by(2).collect();
        let m = built(&points, &segments).unwrap();
        validate(&m);
        m.validate_hull().unwrap();
        assert_eq!(labelled(&m).len(), segments.len());
    }
}

/// A segment through a strip of n triangles, the polygons on its sides convex, concave and ragged. (With ears clipped in
/// a fixed order the first takes minutes.)
#[test]
fn long_segments_do_not_take_quadratic_time() {
    let n = 100_000_u32;
    for shape in 0..4u64 {
        let mut draw = Draw(shape);
        let mut points = vec![Point2::new(-1.0, 0.0), Point2::new(1.0, 0.0)];
        for i in 1..n {
            let x = (2.0 * f64::from(i) / f64::from(n)) - 1.0;
            let y = match shape {
                0 => (1.0 - x * x) / 64.0,
                1 => 1e-3 + x * x / 64.0,
                2 => 1e-4 * (1.0 + draw.unit()),
                _ => (1.0 - x * x).sqrt(),
            };
            points.extend([Point2::new(x, y), Point2::new(x, -y)]);
        }
        let m = built(&points, &[[VertexId(0), VertexId(1)]]).unwrap();
        validate(&m);
        m.validate_hull().unwrap();
    }
}
