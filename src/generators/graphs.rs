//! Families of planar straight line graphs.

use super::draw::{Draw, two_to};
use super::planar::{Planar, inside_segment, turn};
use super::point_sets::{PointFamily, circle, points};
use crate::model::{Point2, Pslg, Segment, VertexId};
use std::cmp::Ordering;

/// A way of being nasty for a straight line graph. Every draw is independent and uniform unless said otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, arbitrary::Arbitrary)]
pub enum PslgFamily {
    /// A simple polygon through points of a `PointFamily`, grown edge by edge; points that found no place stay as isolated vertices or are dropped.
    Polygon(PointFamily),
    /// A polygon star-shaped around the origin: integer directions, radius 1 to 64 of their size.
    Star,
    /// Two to six nested squares, gaps 2^-1 to 2^-12 of the outer side; the innermost face a hole, a region or plain.
    Nested,
    /// Spokes from one apex to integer points of a far line, in a triangle: angles down to 1/n of a radian times 2^-20.
    Fan,
    /// Parallel segments with gaps of 2^-2 to 2^-40 of their length, in a frame.
    NearTouching,
    /// A comb polygon whose n slits are 2^-1 to 2^-30 wide at the mouth.
    Comb,
    /// Random segments between grid points, some sharing ends, in a frame: dangling ends and loose parts.
    Dangling,
    /// A frame around isolated points of a `PointFamily`.
    Isolated(PointFamily),
    /// A square whose sides and dyadic diagonals carry vertices exactly in their interior: to be repaired.
    OnSegments,
    /// A closed polygon of lattice points of a circle, scaled by 1 +- noise of 2^-8 to 2^-50: cocircular up to noise.
    NearCircle,
    /// Points of a small integer grid, short random segments between them where they fit, in a frame: ties everywhere.
    ConstrainedGrid,
    /// Random segments between points of a `PointFamily` where they fit, in a frame.
    Constrained(PointFamily),
}

impl PslgFamily {
    /// All families, those over point sets with each point family.
    pub fn all() -> Vec<PslgFamily> {
        use PslgFamily::*;
        let over = PointFamily::ALL.into_iter().flat_map(|f| [Polygon(f), Isolated(f), Constrained(f)]);
        [Star, Nested, Fan, NearTouching, Comb, Dangling, OnSegments, NearCircle, ConstrainedGrid]
            .into_iter()
            .chain(over)
            .collect()
    }
}

/// A graph of a family with about `n` vertices (at least some 6): can be meshed, has a closed region.
pub fn pslg(family: PslgFamily, n: usize, draw: &mut impl Draw) -> Pslg {
    let n = n.max(3);
    match family {
        PslgFamily::Polygon(family) => simple_polygon(&points(family, n, draw), draw),
        PslgFamily::Star => star(n, draw),
        PslgFamily::Nested => nested(n, draw),
        PslgFamily::Fan => fan(n, draw),
        PslgFamily::NearTouching => near_touching(n, draw),
        PslgFamily::Comb => comb(n, draw),
        PslgFamily::Dangling => dangling(n, draw),
        PslgFamily::Isolated(family) => framed(points(family, n, draw)),
        PslgFamily::OnSegments => on_segments(n, draw),
        PslgFamily::NearCircle => near_circle(n, draw),
        PslgFamily::ConstrainedGrid => constrained(points(PointFamily::Grid, n, draw), 2.0, draw),
        PslgFamily::Constrained(family) => constrained(points(family, n, draw), f64::INFINITY, draw),
    }
}

fn framed(points: Vec<Point2>) -> Pslg {
    let mut graph = Planar::default();
    for p in points {
        graph.vertex(p);
    }
    graph.frame();
    graph.finish()
}

/// A triangle of the points, then for each point the first edge (from a drawn one on) that may be replaced by the two edges to the point.
fn simple_polygon(points: &[Point2], draw: &mut impl Draw) -> Pslg {
    let third = (2..points.len()).find(|&i| turn(points[0], points[1], points[i]) != 0).unwrap_or(2);
    let mut ring: Vec<Point2> = vec![points[0], points[1], points[third]];
    let mut loose = Vec::new();
    let keep = draw.coin();
    for (i, &p) in points.iter().enumerate().skip(2).filter(|&(i, _)| i != third) {
        let start = draw.below(ring.len() as u32) as usize;
        match (0..ring.len()).map(|k| (start + k) % ring.len()).find(|&k| accepts(&ring, k, p)) {
            Some(k) => ring.insert(k + 1, p),
            None if keep && i % 2 == 0 => loose.push(p),
            None => {}
        }
    }
    let mut graph = Planar::default();
    graph.polygon(&ring);
    for p in loose {
        graph.vertex(p);
    }
    graph.finish()
}

/// Whether the ring stays simple when its edge k is replaced by two edges through p.
fn accepts(ring: &[Point2], k: usize, p: Point2) -> bool {
    let n = ring.len();
    let edge = |i: usize| (ring[i % n], ring[(i + 1) % n]);
    let (u, v) = edge(k);
    let clear = |a: Point2, b: Point2| {
        !ring.iter().any(|&q| inside_segment(q, a, b))
            && (0..n).filter(|&i| i != k).all(|i| {
                let (c, d) = edge(i);
                !super::planar::cross(a, b, c, d) && !inside_segment(p, c, d)
            })
    };
    clear(u, p) && clear(p, v)
}

/// Order of direction around the origin, counterclockwise from the positive x axis; exact.
fn by_direction(a: &Point2, b: &Point2) -> Ordering {
    let half = |p: &Point2| (p.y, p.x) < (0.0, 0.0) || (p.y == 0.0 && p.x < 0.0);
    half(a).cmp(&half(b)).then_with(|| turn(Point2::ZERO, *b, *a).cmp(&0))
}

fn star(n: usize, draw: &mut impl Draw) -> Pslg {
    let mut directions: Vec<Point2> =
        [(1, 0), (0, 1), (-1, 0), (0, -1)].map(|(x, y)| Point2::new(f64::from(x), f64::from(y))).into();
    for _ in 4..n {
        directions.push(Point2::new(f64::from(draw.integer(-9, 9)), f64::from(draw.integer(-9, 9))));
    }
    directions.retain(|&p| p != Point2::ZERO);
    directions.sort_by(by_direction);
    directions.dedup_by(|a, b| by_direction(a, b) == Ordering::Equal);
    let corners: Vec<Point2> = directions.into_iter().map(|p| p * f64::from(draw.integer(1, 64))).collect();
    let mut graph = Planar::default();
    graph.polygon(&corners);
    graph.finish()
}

fn nested(n: usize, draw: &mut impl Draw) -> Pslg {
    let mut graph = Planar::default();
    let (mut low, mut high) = (Point2::ZERO, Point2::splat(4096.0));
    for _ in 0..(n / 4).clamp(2, 6) {
        graph.polygon(&[low, Point2::new(high.x, low.y), high, Point2::new(low.x, high.y)]);
        let gap = two_to(draw.integer(0, 10)).min((high.x - low.x) / 8.0);
        let seed = low + gap / 2.0;
        if draw.coin() {
            graph.region(seed, draw.coin().then(|| two_to(draw.integer(10, 20))));
        }
        (low, high) = (low + gap, high - gap);
    }
    let core = (low + high) / 2.0;
    match draw.below(3) {
        0 => graph.hole(core),
        1 => graph.region(core, None),
        _ => {}
    }
    graph.finish()
}

fn fan(n: usize, draw: &mut impl Draw) -> Pslg {
    let far = two_to(draw.integer(0, 20)) * n as f64;
    let mut graph = Planar::default();
    graph.polygon(&[Point2::new(0.0, 0.0), Point2::new(far, -1.0), Point2::new(far, n as f64)]);
    for k in 0..n as i32 - 3 {
        // Spokes end short of the far side, at integer heights.
        let end = Point2::new(far * 0.875 * (1.0 - f64::from(draw.below(4)) / 8.0), 0.75 * f64::from(k));
        if let Some(end) = graph.vertex(end) {
            graph.segment(0, end);
        }
    }
    graph.finish()
}

fn near_touching(n: usize, draw: &mut impl Draw) -> Pslg {
    let mut graph = Planar::default();
    let mut height = 0.0;
    for _ in 0..n / 2 {
        height += two_to(-draw.integer(2, 40));
        let (left, right) = (f64::from(draw.integer(0, 3)) / 8.0, 0.5 + f64::from(draw.integer(0, 4)) / 8.0);
        if let (Some(u), Some(v)) = (graph.vertex(Point2::new(left, height)), graph.vertex(Point2::new(right, height)))
        {
            graph.segment(u, v);
        }
    }
    graph.frame();
    graph.finish()
}

fn comb(n: usize, draw: &mut impl Draw) -> Pslg {
    let slits = (n / 3).clamp(1, 500);
    let depth = f64::from(draw.integer(1, 8)) / 8.0;
    let mut corners = vec![Point2::new(0.0, -1.0), Point2::new(slits as f64 + 1.0, -1.0)];
    corners.push(Point2::new(slits as f64 + 1.0, 1.0));
    for i in (1..=slits).rev() {
        let (x, width) = (i as f64, two_to(-draw.integer(1, 30)));
        corners.extend([(x, 1.0), (x - width / 2.0, 1.0 - depth), (x - width, 1.0)].map(Point2::from));
    }
    // Neighbouring slits never share a mouth: widths are at most a half. The last corner closes the polygon at x = 0.
    corners.push(Point2::new(0.0, 1.0));
    let mut graph = Planar::default();
    graph.polygon(&corners);
    graph.finish()
}

fn dangling(n: usize, draw: &mut impl Draw) -> Pslg {
    let side = 2 + (n as i32) / 2;
    let mut graph = Planar::default();
    let mut last = None;
    for _ in 0..n {
        let p = Point2::new(f64::from(draw.integer(0, side)), f64::from(draw.integer(0, side)));
        let end = graph.vertex(p);
        if let (Some(u), Some(v)) = (last, end) {
            graph.segment(u, v);
        }
        last = if draw.below(3) == 0 { None } else { end };
    }
    graph.frame();
    graph.finish()
}

/// Not by `Planar`, which refuses vertices inside segments.
fn on_segments(n: usize, draw: &mut impl Draw) -> Pslg {
    let side = two_to(draw.integer(-20, 20));
    let corner = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(Point2::from);
    let segment = |u, v, marker| Segment { ends: [VertexId(u), VertexId(v)], marker, toggles: true };
    let mut segments: Vec<Segment> = (0..4).map(|i| segment(i, (i + 1) % 4, 1)).collect();
    if draw.coin() {
        segments.push(segment(0, 2, 2));
    }
    let mut all: Vec<Point2> = corner.to_vec();
    for _ in 4..n {
        let t = f64::from(draw.integer(1, 255)) / 256.0;
        let p = match draw.below(5) {
            4 => Point2::splat(t),
            k => corner[k as usize].lerp(corner[(k as usize + 1) % 4], t),
        };
        if !all.contains(&p) {
            all.push(p);
        }
    }
    let points = all.into_iter().map(|p| p * side).collect();
    Pslg { points, segments, ..Pslg::default() }
}

fn near_circle(n: usize, draw: &mut impl Draw) -> Pslg {
    let mut ring = circle([325, 5525, 1_185_665][draw.below(3) as usize]);
    ring.sort_by(by_direction);
    let noise = two_to(-draw.integer(8, 50));
    let stride = ring.len().div_ceil(n.max(4)).max(1);
    let corners: Vec<Point2> =
        ring.into_iter().step_by(stride).map(|p| p * (1.0 + noise * draw.signed_unit())).collect();
    let mut graph = Planar::default();
    graph.polygon(&corners);
    graph.finish()
}

/// As many random segments as points are tried; those shorter than `reach` that the graph admits are kept.
fn constrained(points: Vec<Point2>, reach: f64, draw: &mut impl Draw) -> Pslg {
    let mut graph = Planar::default();
    for p in points {
        graph.vertex(p);
    }
    let count = graph.points().len() as u32;
    for _ in 0..count {
        let (u, v) = (draw.below(count), draw.below(count));
        let step = (graph.points()[u as usize] - graph.points()[v as usize]).abs();
        if step.max_element() <= reach {
            graph.segment(u, v);
        }
    }
    graph.frame();
    graph.finish()
}

#[cfg(test)]
mod tests {
    use super::super::{Bytes, SplitMix64};
    use super::*;

    /// Signs by integers: coordinates times 2^k as i128 where they fit; the predicates of `Planar` are thus not their own witness.
    fn turn_by_integers(a: Point2, b: Point2, c: Point2) -> Option<i128> {
        let whole = |x: f64| {
            let y = x * two_to(20);
            (y.abs() < two_to(50) && y.trunc() == y).then_some(y as i128)
        };
        let [ax, ay, bx, by, cx, cy] = [whole(a.x)?, whole(a.y)?, whole(b.x)?, whole(b.y)?, whole(c.x)?, whole(c.y)?];
        Some(((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).signum())
    }

    fn is_valid(g: &Pslg) -> Result<(), String> {
        let at = |v: VertexId| g.points[v.index()];
        for (i, p) in g.points.iter().enumerate() {
            if g.points[..i].contains(p) || !p.is_finite() {
                return Err(format!("vertex {i} repeated or not finite"));
            }
        }
        for (i, s) in g.segments.iter().enumerate() {
            let [a, b] = s.ends.map(at);
            if let Some(p) = g.points.iter().find(|&&p| inside_segment(p, a, b)) {
                return Err(format!("{p} inside segment {i}"));
            }
            for r in &g.segments[..i] {
                let [c, d] = r.ends.map(at);
                let same = r.ends == s.ends || r.ends == [s.ends[1], s.ends[0]];
                let signs = [turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)];
                if same || (signs[0] * signs[1] < 0 && signs[2] * signs[3] < 0) {
                    return Err(format!("segment {i} meets another"));
                }
                if let Some(sign) = turn_by_integers(a, b, c) {
                    assert_eq!(i32::try_from(sign), Ok(signs[0]));
                }
            }
        }
        Ok(())
    }

    /// Whether segments separate some place from the outside: a graph has more edges than a forest.
    fn has_cycle(g: &Pslg) -> bool {
        let mut root: Vec<usize> = (0..g.points.len()).collect();
        g.segments.iter().any(|s| {
            let find = |mut v: usize| {
                while root[v] != v {
                    v = root[v];
                }
                v
            };
            let [u, v] = s.ends.map(|v| find(v.index()));
            root[u] = v;
            u == v
        })
    }

    #[test]
    fn every_family_is_valid_and_closed() {
        for family in PslgFamily::all() {
            for seed in 0..40 {
                let g = pslg(family, 6 + seed as usize, &mut SplitMix64(seed));
                assert!(has_cycle(&g), "{family:?} {seed}: nothing closed: {g:?}");
                if family != PslgFamily::OnSegments {
                    assert_eq!(is_valid(&g), Ok(()), "{family:?} {seed}");
                }
            }
            assert!(has_cycle(&pslg(family, 8, &mut Bytes(&[]))), "{family:?} from zeros");
        }
    }

    #[test]
    fn families_show_their_features() {
        let with = |family, feature: &dyn Fn(&Pslg) -> bool| {
            (0..40).filter(|&seed| feature(&pslg(family, 24, &mut SplitMix64(seed)))).count()
        };
        let on_segment = |g: &Pslg| {
            g.segments.iter().any(|s| {
                let [a, b] = s.ends.map(|v| g.points[v.index()]);
                g.points.iter().any(|&p| inside_segment(p, a, b))
            })
        };
        let degree = |g: &Pslg, v: usize| g.segments.iter().filter(|s| s.ends.iter().any(|e| e.index() == v)).count();
        let isolated = |g: &Pslg| (0..g.points.len()).any(|v| degree(g, v) == 0);
        let dangling = |g: &Pslg| (0..g.points.len()).any(|v| degree(g, v) == 1);
        assert_eq!(with(PslgFamily::OnSegments, &on_segment), 40);
        assert!(with(PslgFamily::Isolated(PointFamily::Random), &isolated) == 40);
        assert!(with(PslgFamily::Dangling, &dangling) > 30);
        assert!(with(PslgFamily::Fan, &|g| degree(g, 0) > 10) > 30);
        assert!(with(PslgFamily::Nested, &|g| !g.holes.is_empty()) > 5);
        assert!(with(PslgFamily::Nested, &|g| g.regions.iter().any(|r| r.max_area.is_some())) > 5);
        assert!(with(PslgFamily::Polygon(PointFamily::Grid), &|g| g.segments.len() > 8) > 30);
        assert!(with(PslgFamily::ConstrainedGrid, &|g| g.segments.len() > 6) > 30);
    }
}
