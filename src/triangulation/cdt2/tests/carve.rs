//! Regions carved out, and points located in what is left.

use super::*;

#[test]
fn carving_keeps_what_it_says() {
    let p = |x: f64, y: f64| Point2::new(x, y) / 16.0;
    let (points, segments) = squares();
    let fresh = || built(&points, &segments).unwrap();
    let (inner, ring, outside) = (p(4.5, 4.0), p(1.0, 4.0), p(9.0, 4.0));

    let mut m = fresh();
    assert_eq!(m.triangle_count(), 11);
    m.carve(Fill::Seeds, &[], &[], &[ring]).unwrap();
    validate(&m);
    assert_eq!(m.triangle_count(), 10);
    assert_eq!(m.edge_from(VertexId(8)), None);
    let inside = |m: &Cdt, t: TriId| m.vertices(t).iter().all(|v| (4..8).contains(&v.0));
    for t in m.triangles() {
        assert_eq!(m.region(t), u32::from(!inside(&m, t)));
    }
    assert_eq!(labelled(&m).len(), 8);
    assert_eq!(m.triangles().flat_map(|t| m.edges(t)).filter(|&e| m.twin(e).is_none()).count(), 4);

    let mut m = fresh();
    m.carve(Fill::Seeds, &[], &[inner], &[]).unwrap();
    assert_eq!(m.triangle_count(), 8);
    assert!(m.triangles().all(|t| !inside(&m, t)));
    assert_eq!(m.triangles().flat_map(|t| m.edges(t)).filter(|&e| m.twin(e).is_none()).count(), 8);

    let mut m = fresh();
    m.carve(Fill::Parity, &[true; 8], &[], &[]).unwrap();
    assert_eq!(m.triangle_count(), 8);
    let mut m = fresh();
    m.carve(Fill::Parity, &[true, true, true, true, false, false, false, false], &[], &[]).unwrap();
    assert_eq!(m.triangle_count(), 10);

    // One side of the inner square toggles nothing, then one of the outer, on the hull: what they bound is both inside and outside.
    for loose in [4, 3] {
        let toggles: Vec<bool> = (0..8).map(|s| s != loose).collect();
        let open = segments[loose].map(CarveError::OpenCycle);
        let mut expected = open.to_vec();
        expected.sort_by_key(|e| e.to_string());
        assert_eq!(fresh().carve_findings(Fill::Parity, &toggles, &[], &[]), expected);
    }

    let mut m = fresh();
    m.carve(Fill::Convex, &[], &[], &[inner, ring]).unwrap();
    assert_eq!(m.triangle_count(), 11);
    assert_eq!(m.triangles().filter(|&t| m.region(t) == 1).count(), 2);

    let before = image(&fresh());
    let refused = |holes: &[Point2], regions: &[Point2], expected: &[CarveError]| {
        let mut m = fresh();
        assert_eq!(m.carve_findings(Fill::Seeds, &[], holes, regions), expected);
        assert_eq!(m.carve(Fill::Seeds, &[], holes, regions).err().as_ref(), expected.first());
        assert_eq!(image(&m), before);
    };
    refused(&[outside], &[p(100.0, 0.0)], &[CarveError::Outside(Seed::Hole(0)), CarveError::Outside(Seed::Region(0))]);
    refused(&[p(4.0, 2.0)], &[], &[CarveError::OnSegment(Seed::Hole(0))]);
    refused(&[], &[p(2.0, 2.0)], &[CarveError::OnSegment(Seed::Region(0))]);
    refused(&[inner], &[ring, inner], &[CarveError::Outside(Seed::Region(1))]);
    refused(&[], &[ring, inner, p(7.0, 7.0)], &[CarveError::OneFace(0, 2)]);
    let mut all_holes = fresh();
    all_holes.carve(Fill::Seeds, &[], &[ring, inner], &[]).unwrap();
    assert_eq!(all_holes.triangle_count(), 0);
    let mut open = built(&points, &segments[..3]).unwrap();
    assert_eq!(open.carve(Fill::Seeds, &[], &[], &[]), Err(CarveError::Nothing));
}

#[test]
fn points_are_located() {
    let p = |x: f64, y: f64| Point2::new(x, y) / 16.0;
    let (points, segments) = squares();
    let mut m = built(&points, &segments).unwrap();
    let out = p(9.0, 4.0);
    let from = m.triangles().next().unwrap();
    let t = match m.locate(from, out) {
        Location::Triangle(t) => t,
        other => panic!("{other:?}"),
    };
    assert!(m.vertices(t).contains(&VertexId(8)));
    m.carve(Fill::Seeds, &[], &[p(4.5, 4.0)], &[]).unwrap();
    for t in m.triangles() {
        assert_eq!(m.locate(t, out), Location::Outside);
        assert_eq!(m.locate(t, p(4.5, 4.0)), Location::Outside);
        assert_eq!(m.locate(t, p(99.0, 4.0)), Location::Outside);
        assert_eq!(m.locate(t, p(6.0, 6.0)), Location::Vertex(VertexId(6)));
        let border = m.find_edge(VertexId(1), VertexId(2)).unwrap();
        assert_eq!(m.locate(t, p(8.0, 3.0)), Location::Edge(border));
        let center = m.corners(t).iter().sum::<Point2>() / 3.0;
        assert_eq!(m.locate(from, center), Location::Triangle(t));
    }
}
