//! The initial triangulation: that it is the constrained Delaunay triangulation of the hull, and what of it is kept.
//!
//! Covering: triangles are positively oriented, each half-edge has at most one twin, and the border is one locally convex
//! closed polygon that turns once. Then the number of triangles over a point is constant off the border: 1 inside, 0 outside.

use super::complex::{Complex, Facts, NONE, next, previous, triangle_of};
use super::condition::compare_lengths;
use super::predicates::{in_conflict, orient};
use super::sight::Search;
use super::verdict::{Checked, Rule, broken, ensure};
use crate::model::words::counted;
use crate::model::{Fill, Point2, Region, Segment, VertexId};

/// The input as the trace states it; places are scaled.
#[derive(Clone, Debug, Default)]
pub struct Domain {
    /// Input segments.
    pub segments: Vec<Segment>,
    /// Hole seeds.
    pub holes: Vec<Point2>,
    /// Region seeds.
    pub regions: Vec<Region>,
    /// Which faces are kept.
    pub fill: Fill,
}

/// Adds a triangle of the initial triangulation: canonical, ascending, positive.
pub fn add_triangle(mesh: &mut Complex, corner: [u32; 3], before: Option<[u32; 3]>) -> Checked {
    let known = corner.iter().all(|&v| (v as usize) < mesh.vertices.len());
    ensure(known, Rule::Triangulation, || ("ids of input vertices", format!("{corner:?}")))?;
    ensure(corner[0] < corner[1] && corner[0] < corner[2], Rule::Canonical, || {
        ("the smallest id first", format!("{corner:?}"))
    })?;
    ensure(before.is_none_or(|b| b < corner), Rule::Canonical, || {
        ("ascending order", format!("{corner:?} after {before:?}"))
    })?;
    let [a, b, c] = corner.map(|v| mesh.at(v));
    ensure(orient(a, b, c).is_positive(), Rule::Triangulation, || {
        ("a counterclockwise triangle", format!("{corner:?}"))
    })?;
    mesh.add(corner, Facts { birth: 0, region: NONE, outside: false, skipped_skinny: false, skipped_oversized: false });
    Ok(())
}

/// Links the triangles and proves that they are the constrained Delaunay triangulation of the convex hull.
pub fn check_start(mesh: &mut Complex, segments: &[Segment]) -> Checked {
    link(mesh)?;
    check_border(mesh)?;
    for v in 0..mesh.vertices.len() as u32 {
        ensure(mesh.first_from(v) != NONE, Rule::Triangulation, || {
            ("every vertex in a triangle", format!("vertex {v} in none"))
        })?;
    }
    constrain(mesh, segments)?;
    check_delaunay(mesh)
}

/// Pairs the half-edges.
fn link(mesh: &mut Complex) -> Checked {
    let mut by_ends = Vec::with_capacity(3 * mesh.slot_count());
    for t in 0..mesh.slot_count() as u32 {
        for e in 4 * t..4 * t + 3 {
            let (u, v) = (u64::from(mesh.origin(e)), u64::from(mesh.target(e)));
            by_ends.push((u.min(v) << 32 | u.max(v), u > v, e));
        }
    }
    by_ends.sort_unstable();
    for group in by_ends.chunk_by(|a, b| a.0 == b.0) {
        match group {
            [_] => {}
            [(_, false, e), (_, true, other)] => mesh.join(*e, *other, NONE),
            _ => {
                let (u, v) = (mesh.origin(group[0].2), mesh.target(group[0].2));
                return broken(
                    Rule::Triangulation,
                    "an edge between two triangles, one on each side",
                    format!("edge ({u}, {v}) in {} half-edges", group.len()),
                );
            }
        }
    }
    Ok(())
}

/// The border is one closed polygon, locally convex, turning once.
fn check_border(mesh: &Complex) -> Checked {
    let border = |e: u32| mesh.beyond(e) == NONE;
    let half_edges = || mesh.triangles().flat_map(|t| 4 * t..4 * t + 3);
    let total = half_edges().filter(|&e| border(e)).count();
    let Some(first) = half_edges().find(|&e| border(e)) else {
        return broken(Rule::Triangulation, "a convex border", "no border");
    };
    let (mut e, mut walked, mut turns) = (first, 0, 0);
    loop {
        let mut after = next(e);
        while !border(after) {
            after = next(mesh.beyond(after));
        }
        let [a, b, c] = [mesh.origin(e), mesh.target(e), mesh.target(after)].map(|v| mesh.at(v));
        let ahead = (b.x - a.x) * (c.x - b.x) >= 0.0 && (b.y - a.y) * (c.y - b.y) >= 0.0;
        let turn = orient(a, b, c);
        // On one line, "ahead" needs signs of differences only, which floating subtraction gives right.
        ensure(turn.is_positive() || (!turn.is_negative() && ahead), Rule::Triangulation, || {
            ("a convex border", format!("a turn to the right at vertex {}", mesh.target(e)))
        })?;
        let smaller = |p: Point2, q: Point2| (p.x, p.y) < (q.x, q.y);
        turns += usize::from(smaller(b, a) && smaller(b, c));
        walked += 1;
        e = after;
        if e == first {
            break;
        }
        ensure(walked <= total, Rule::Triangulation, || ("one closed border", "a border that does not close"))?;
    }
    ensure(walked == total && turns == 1, Rule::Triangulation, || {
        (
            "one closed border that turns once",
            format!("{walked} of {} in one piece, {}", counted(total, "edge"), counted(turns, "turn")),
        )
    })
}

/// Marks the segments on the edges they must be.
fn constrain(mesh: &mut Complex, segments: &[Segment]) -> Checked {
    for (i, segment) in segments.iter().enumerate() {
        let [VertexId(u), VertexId(v)] = segment.ends;
        let e = mesh.find_edge(u, v).or_else(|| mesh.find_edge(v, u));
        let Some(e) = e else {
            return broken(Rule::Segment, format!("segment {i} as an edge"), format!("no edge ({u}, {v})"));
        };
        ensure(mesh.segment(e) == NONE, Rule::Segment, || {
            ("one segment on an edge", format!("segments {} and {i}", mesh.segment(e)))
        })?;
        mesh.join(e, mesh.beyond(e), i as u32);
    }
    Ok(())
}

/// Every unconstrained edge is locally Delaunay.
pub fn check_delaunay(mesh: &Complex) -> Checked {
    for t in mesh.triangles() {
        for e in 4 * t..4 * t + 3 {
            let other = mesh.beyond(e);
            if other == NONE || other < e || mesh.segment(e) != NONE {
                continue;
            }
            ensure(!in_conflict(mesh.places(t), mesh.at(mesh.apex(other))), Rule::Delaunay, || {
                ("a locally Delaunay edge", format!("edge ({}, {})", mesh.origin(e), mesh.target(e)))
            })?;
        }
    }
    Ok(())
}

/// Drops what the fill rule and the holes exclude, labels the regions, and freezes R of the input vertices.
pub fn carve(mesh: &mut Complex, domain: &Domain, search: &mut Search) -> Checked {
    let mut keep = kept(mesh, domain)?;
    for (i, &hole) in domain.holes.iter().enumerate() {
        if let Some(t) = locate(mesh, hole, "hole", i)? {
            flood_face(mesh, t, search, |t| keep[t as usize] = false);
        }
    }
    for (i, region) in domain.regions.iter().enumerate() {
        let Some(t) = locate(mesh, region.seed, "region", i)? else {
            continue;
        };
        if !keep[t as usize] {
            continue;
        }
        ensure(mesh.facts(t).region == NONE, Rule::Domain, || {
            ("one region seed in a face", format!("seeds {} and {i}", mesh.facts(t).region))
        })?;
        let mut face = Vec::new();
        flood_face(mesh, t, search, |t| face.push(t));
        for t in face {
            mesh.facts_mut(t).region = i as u32;
        }
    }
    for t in 0..mesh.slot_count() as u32 {
        mesh.facts_mut(t).outside = !keep[t as usize];
    }
    measure_input(mesh);
    Ok(())
}

/// Which triangles the fill rule keeps, holes aside.
fn kept(mesh: &Complex, domain: &Domain) -> Checked<Vec<bool>> {
    const UNSEEN: u8 = 2;
    let inside_if_crossed = |segment: u32| match domain.fill {
        Fill::Convex | Fill::Seeds => segment != NONE,
        Fill::Parity => segment != NONE && domain.segments[segment as usize].toggles,
    };
    if domain.fill == Fill::Convex {
        return Ok(vec![true; mesh.slot_count()]);
    }
    // 0 outside, 1 inside; under `Seeds` nothing is crossed and what is never reached is inside.
    let mut side = vec![UNSEEN; mesh.slot_count()];
    let mut stack = Vec::new();
    for t in mesh.triangles() {
        for e in 4 * t..4 * t + 3 {
            let crossed = inside_if_crossed(mesh.segment(e));
            if mesh.beyond(e) == NONE && (domain.fill == Fill::Parity || !crossed) {
                stack.push((t, u8::from(crossed)));
            }
        }
    }
    while let Some((t, s)) = stack.pop() {
        let known = side[t as usize];
        ensure(known == UNSEEN || known == s, Rule::Domain, || {
            ("toggling segments in closed cycles", format!("triangle {:?} both inside and outside", mesh.corners(t)))
        })?;
        if known != UNSEEN {
            continue;
        }
        side[t as usize] = s;
        for e in 4 * t..4 * t + 3 {
            let (other, segment) = (mesh.beyond(e), mesh.segment(e));
            if other == NONE || (domain.fill == Fill::Seeds && segment != NONE) {
                continue;
            }
            stack.push((triangle_of(other), s ^ u8::from(inside_if_crossed(segment))));
        }
    }
    Ok(side.iter().map(|&s| s != 0).collect())
}

/// The region that is refined is bounded by segments. (Under `convex` the hull is; then its edges are segments of the domain.)
pub fn check_bounded(mesh: &Complex) -> Checked {
    let mut edges = mesh.triangles().flat_map(|t| 4 * t..4 * t + 3);
    let open = edges.find(|&e| mesh.inside(mesh.beyond(e)).is_none() && mesh.segment(e) == NONE);
    open.map_or(Ok(()), |e| {
        broken(Rule::Domain, "a region bounded by segments", format!("edge {:?}", [mesh.origin(e), mesh.target(e)]))
    })
}

/// Calls `visit` for every triangle that no constrained edge separates from t.
fn flood_face(mesh: &Complex, t: u32, search: &mut Search, mut visit: impl FnMut(u32)) {
    search.fresh(mesh);
    search.mark(t);
    let mut stack = vec![t];
    while let Some(t) = stack.pop() {
        visit(t);
        for e in 4 * t..4 * t + 3 {
            let other = mesh.beyond(e);
            if other != NONE && mesh.segment(e) == NONE && search.mark(triangle_of(other)) {
                stack.push(triangle_of(other));
            }
        }
    }
}

/// A triangle whose closure holds q; `None` outside the hull. A seed on a segment is an error.
fn locate(mesh: &Complex, q: Point2, what: &str, number: usize) -> Checked<Option<u32>> {
    let outward = |t: u32, from: u32| {
        (4 * t..4 * t + 3)
            .find(|&e| e != from && orient(mesh.at(mesh.origin(e)), mesh.at(mesh.target(e)), q).is_negative())
    };
    // A visibility walk; in a constrained triangulation it may circle, then every triangle is tried.
    let (mut t, mut from) = (0, NONE);
    let mut found = None;
    for _ in 0..mesh.slot_count() {
        match outward(t, from) {
            None => {
                found = Some(t);
                break;
            }
            Some(e) if mesh.beyond(e) == NONE => break,
            Some(e) => {
                from = mesh.beyond(e);
                t = triangle_of(from);
            }
        }
    }
    let Some(t) = found.or_else(|| mesh.triangles().find(|&t| outward(t, NONE).is_none())) else {
        return Ok(None);
    };
    let on_segment = (4 * t..4 * t + 3).any(|e| {
        let here = orient(mesh.at(mesh.origin(e)), mesh.at(mesh.target(e)), q);
        mesh.segment(e) != NONE && !here.is_positive()
    });
    let on_vertex = mesh.places(t).contains(&q);
    ensure(!on_segment && !on_vertex, Rule::Domain, || {
        ("a seed strictly inside a face", format!("{what} seed {number} on a segment or vertex"))
    })?;
    Ok(Some(t))
}

/// R of an input vertex: the distance to the nearest one it shares a kept edge with.
fn measure_input(mesh: &mut Complex) {
    for v in 0..mesh.vertices.len() as u32 {
        let mut nearest = v;
        for e in mesh.star(v).filter(|&e| mesh.inside(e).is_some()) {
            // The last edge of an open star is incoming only.
            for w in [mesh.target(e), mesh.origin(previous(e))] {
                if nearest == v || compare_lengths(mesh.at(v), mesh.at(w), mesh.at(v), mesh.at(nearest)).is_negative() {
                    nearest = w;
                }
            }
        }
        mesh.vertices[v as usize].nearest = nearest;
    }
}
