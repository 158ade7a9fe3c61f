//! The triangulation against its definition, and against itself after detours.

use super::*;
use crate::arith::{FastKernel as K, Kernel};
use crate::model::{Fill, Point2, Sign, Triangle};
use proptest::prelude::*;

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
type Image = (Vec<super::store::Slot>, Vec<[Option<SegmentId>; 3]>, Vec<u32>, Vec<u32>, usize, u32);

fn image(m: &Cdt) -> Image {
    let labels = (0..m.slots.len() as u32).map(|t| m.edges(TriId(t)).map(|e| m.segment(e))).collect();
    (m.slots.clone(), labels, m.hints.clone(), m.free.clone(), m.points.len(), m.clock)
}

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

/// A triangle in conflict with p that sees it: the one that holds it.
fn holder(m: &Cdt, p: Point2) -> Option<TriId> {
    let first = m.triangles().next()?;
    match m.locate(first, p) {
        Location::Triangle(t) => Some(t),
        _ => None,
    }
}

#[test]
fn insertions_and_removals_equal_a_fresh_build() {
    let mut change = Change::default();
    for seed in 0..600 {
        let points = points_of(seed);
        let mut draw = Draw(!seed);
        let wanted = draw.below(12) as usize;
        let segments = segments_among(&points, wanted, &mut draw);
        let Some(mut m) = built(&points, &segments) else {
            continue;
        };
        let extra = family(draw.below(6), 12, &mut draw);
        let mut now = points.clone();
        let mut free: Vec<VertexId> = Vec::new();
        for (clock, &p) in (1..).zip(&extra) {
            m.set_clock(clock);
            let before = triples(&m);
            let Some(t) = holder(&m, p) else { continue };
            let v = m.insert(t, p, &mut change);
            assert_eq!(v.index(), now.len());
            assert_eq!(change.destroyed.len() + 2, change.created.len());
            assert!(change.destroyed.iter().all(|t| before.binary_search(t).is_ok()));
            assert!(change.created.iter().all(|&t| m.birth(t) == clock && m.vertices(t).contains(&v)));
            now.push(p);
            free.push(v);
            validate(&m);
            assert_eq!(triples(&m), triples(&built(&now, &segments).unwrap()), "seed {seed}");
        }
        draw.shuffle(&mut free);
        for v in free {
            let star = triples(&m).iter().filter(|t| t.contains(&v)).count();
            m.remove(v, &mut change);
            assert_eq!(change.destroyed.len(), star);
            assert_eq!(change.created.len() + 2, star);
            assert_eq!(m.edge_from(v), None);
            validate(&m);
        }
        m.validate_hull().unwrap();
        assert_eq!(triples(&m), triples(&built(&points, &segments).unwrap()), "seed {seed}");
    }
}

#[test]
fn splits_equal_a_fresh_build_where_the_point_is_exact() {
    let mut change = Change::default();
    let mut splits = 0;
    for seed in 0..600 {
        let mut draw = Draw(seed);
        let kind = draw.below(4);
        let points = family(kind, 20, &mut draw);
        let mut segments = segments_among(&points, 10, &mut draw);
        let Some(mut m) = built(&points, &segments) else {
            continue;
        };
        let mut now = points.clone();
        for _ in 0..6 {
            let edges: Vec<HalfEdge> =
                m.triangles().flat_map(|t| m.edges(t)).filter(|&e| m.is_constrained(e)).collect();
            if edges.is_empty() {
                break;
            }
            let e = edges[draw.below(edges.len() as u32) as usize];
            let (u, v) = (m.origin(e), m.destination(e));
            let p = (m.point(u) + m.point(v)) * 0.5;
            if K::orient2d(m.point(u), m.point(v), p) != Sign::Zero {
                continue;
            }
            let label = m.segment(e).unwrap();
            let sides = 1 + usize::from(m.twin(e).is_some());
            let w = m.split(e, p, &mut change);
            splits += 1;
            assert_eq!(change.created.len(), change.destroyed.len() + sides);
            let (low, high) = (u.min(v), u.max(v));
            let first = &change.destroyed[0];
            assert!(first.contains(&low) && first.contains(&high));
            now.push(p);
            let i = segments.iter().position(|s| s.contains(&u) && s.contains(&v)).unwrap();
            segments[i] = [u, w];
            segments.push([w, v]);
            validate(&m);
            m.validate_hull().unwrap();
            assert_eq!(triples(&m), triples(&built(&now, &segments).unwrap()), "seed {seed}");
            let ends = |a: VertexId, b: VertexId| (a.min(b), a.max(b), label);
            let all = labelled(&m);
            assert!(all.contains(&ends(u, w)) && all.contains(&ends(w, v)) && all.len() == segments.len());
        }
    }
    assert!(splits > 1000);
}

#[test]
fn rollback_restores_everything() {
    let mut change = Change::default();
    for seed in 0..400 {
        let points = points_of(seed);
        let mut draw = Draw(!seed);
        let segments = segments_among(&points, 8, &mut draw);
        let Some(mut m) = built(&points, &segments) else {
            continue;
        };
        let mut free: Vec<VertexId> = Vec::new();
        for round in 0..4 {
            let before = image(&m);
            let kept = free.clone();
            m.checkpoint();
            for clock in 0..6 {
                m.set_clock(10 * round + clock + 1);
                if draw.below(3) == 0 && !free.is_empty() {
                    let v = free.swap_remove(draw.below(free.len() as u32) as usize);
                    m.remove(v, &mut change);
                } else {
                    let p = family(draw.below(6), 1, &mut draw)[0];
                    if let Some(t) = holder(&m, p) {
                        free.push(m.insert(t, p, &mut change));
                    }
                }
                let edge = m.triangles().flat_map(|t| m.edges(t)).find(|&e| m.is_constrained(e));
                if let Some(e) = edge.filter(|_| draw.below(3) == 0) {
                    let (u, v) = (m.point(m.origin(e)), m.point(m.destination(e)));
                    let p = (u + v) * 0.5;
                    if K::orient2d(u, v, p) == Sign::Zero {
                        m.split(e, p, &mut change);
                    }
                }
            }
            validate(&m);
            if round % 2 == 0 {
                m.rollback();
                assert_eq!(image(&m), before, "seed {seed}");
                free = kept;
            } else {
                m.commit();
            }
        }
        validate(&m);
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

/// Two nested squares, the inner one 4..=7.
fn squares() -> (Vec<Point2>, Vec<[VertexId; 2]>) {
    let p = |x: i32, y: i32| Point2::new(f64::from(x), f64::from(y)) / 16.0;
    let points = vec![p(0, 0), p(8, 0), p(8, 8), p(0, 8), p(2, 2), p(6, 2), p(6, 6), p(2, 6), p(12, 4)];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    (points, segments.iter().map(|s| s.map(VertexId)).collect())
}

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

#[test]
fn a_flood_stops_at_segments_and_labels_are_inherited() {
    let (points, segments) = squares();
    let mut m = built(&points, &segments).unwrap();
    m.carve(Fill::Seeds, &[], &[], &[Point2::new(0.25, 0.28)]).unwrap();
    let labels = labelled(&m);
    let mut change = Change::default();
    // Close under the inner square's top edge: the triangle beyond is in conflict but hidden.
    let p = Point2::new(4.0, 5.9375) / 16.0;
    let t = m.triangles().find(|&t| m.region(t) == 1 && K::in_circle(m.corners(t), p).is_positive()).unwrap();
    m.insert(t, p, &mut change);
    validate(&m);
    assert_eq!(labelled(&m), labels);
    assert!(change.created.iter().all(|&t| m.region(t) == 1));
    assert_eq!(change.created.len(), 4);
    assert_eq!(m.triangles().filter(|&t| m.region(t) == 0).count(), 8);
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
fn validators_reject_what_is_wrong() {
    let mut draw = Draw(7);
    let points = family(0, 40, &mut draw);
    let segments = segments_among(&points, 15, &mut draw);
    let good = built(&points, &segments).unwrap();
    let inner = |m: &Cdt, constrained: bool| {
        let mut edges = m.triangles().flat_map(|t| m.edges(t));
        edges.find(|&e| m.twin(e).is_some() && m.is_constrained(e) == constrained).unwrap()
    };
    let broken = |damage: &dyn Fn(&mut Cdt)| {
        let mut m = good.clone();
        damage(&mut m);
        m
    };
    let links = |m: &Cdt| m.validate_links().unwrap_err();
    let plain = inner(&good, false);
    let fixed = inner(&good, true);
    let slot = |e: HalfEdge| ((e.0 >> 2) as usize, (e.0 & 3) as usize);

    let m = broken(&|m| m.slots[slot(plain).0].link[slot(plain).1] = super::store::Link::to(plain.0));
    assert!(matches!(links(&m), Violation::Link(..)));
    let m = broken(&|m| m.slots[slot(plain).0].link[slot(plain).1] = m.link(plain.0).constrained());
    assert!(matches!(links(&m), Violation::Link(..)));
    let m = broken(&|m| m.labels[slot(fixed).0][slot(fixed).1] += 1);
    assert!(matches!(links(&m), Violation::Link(..)));
    let m = broken(&|m| m.hints[3] = m.hints[4]);
    assert_eq!(links(&m), Violation::Hint(VertexId(3)));
    let m = broken(&|m| m.slots[0].v[1] = m.slots[0].v[0]);
    assert!(matches!(links(&m), Violation::Vertices(_)));
    let m = broken(&|m| m.free.push(0));
    assert!(matches!(links(&m), Violation::Free(_)));

    let m = broken(&|m| m.points.swap(0, 1));
    m.validate_links().unwrap();
    assert!(matches!(m.validate_orientation(), Err(Violation::Orientation(_))));

    // A segment forgotten shows unless its edge is Delaunay anyway: some is not.
    let mut shown = 0;
    for e in good.triangles().flat_map(|t| good.edges(t)).filter(|&e| good.is_constrained(e)) {
        let Some(f) = good.twin(e) else { continue };
        let m = broken(&|m| {
            m.slots[slot(e).0].link[slot(e).1] = super::store::Link::to(f.0);
            m.slots[slot(f).0].link[slot(f).1] = super::store::Link::to(e.0);
        });
        m.validate_links().unwrap();
        shown += usize::from(matches!(m.validate_delaunay(), Err(Violation::Delaunay(..))));
    }
    assert!(shown > 0);

    good.validate_hull().unwrap();
    let mut m = Cdt::delaunay(points.clone()).unwrap();
    let hull = m.triangles().flat_map(|t| m.edges(t)).find(|&e| m.twin(e).is_none()).unwrap();
    let t = m.triangle_of(hull);
    for e in m.edges(t) {
        if let Some(f) = m.twin(e) {
            m.slots[slot(f).0].link[slot(f).1] = super::store::Link::BORDER;
            let (u, v) = (m.origin(e).index(), m.origin(f).index());
            m.hints[u] = next_of(f);
            m.hints[v] = f.0;
        }
    }
    m.release_slot(t.0);
    assert!(matches!(m.validate_hull(), Err(Violation::Hull(_))));
}

fn next_of(e: HalfEdge) -> u32 {
    super::store::next(e.0)
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
