//! Input angles below 60 degrees, between segments consecutive around a common end.

use super::finding::{Element, Finding, Findings, Kind};
use crate::arith::Kernel;
use crate::model::{Lines, Point2, Pslg, SegmentId, VertexId};
use std::cmp::Ordering;

/// An angle below 60 degrees: counterclockwise from the segment to `ends[0]` to the segment to `ends[1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallAngle {
    /// The common end.
    pub apex: VertexId,
    /// The other ends.
    pub ends: [VertexId; 2],
    /// The segments, as they stand in the graph.
    pub segments: [SegmentId; 2],
    /// About how many degrees; for display.
    pub degrees: f64,
}

/// All angles below 60 degrees of a repaired graph, the smallest first. `points`: its vertices, normalised.
pub fn small_angles<K: Kernel>(pslg: &Pslg, points: &[Point2]) -> Vec<SmallAngle> {
    // (apex, other end, segment), grouped by apex
    let mut spokes: Vec<(VertexId, VertexId, SegmentId)> = Vec::with_capacity(2 * pslg.segments.len());
    for (s, segment) in (0u32..).zip(&pslg.segments) {
        let [u, v] = segment.ends;
        spokes.extend([(u, v, SegmentId(s)), (v, u, SegmentId(s))]);
    }
    spokes.sort_unstable();
    let at = |v: VertexId| points[v.index()];
    let mut angles = Vec::new();
    for star in spokes.chunk_by_mut(|a, b| a.0 == b.0).filter(|star| star.len() > 1) {
        let apex = star[0].0;
        star.sort_by(|a, b| around::<K>(at(apex), at(a.1), at(b.1)));
        for (i, from) in star.iter().enumerate() {
            let to = &star[(i + 1) % star.len()];
            let (o, p, q) = (at(apex), at(from.1), at(to.1));
            let below_60 = || K::compare_cos2(o, p, q, 0.25) == Ordering::Greater;
            if K::orient2d(o, p, q).is_positive() && below_60() {
                let (u, v) = (p - o, q - o);
                let degrees = u.perp_dot(v).atan2(u.dot(v)).to_degrees();
                let (ends, segments) = ([from.1, to.1], [from.2, to.2]);
                angles.push(SmallAngle { apex, ends, segments, degrees });
            }
        }
    }
    angles.sort_by(|a, b| a.degrees.total_cmp(&b.degrees).then(a.apex.cmp(&b.apex)).then(a.ends.cmp(&b.ends)));
    angles
}

/// Counterclockwise order of directions from o, beginning with that of +x.
fn around<K: Kernel>(o: Point2, p: Point2, q: Point2) -> Ordering {
    let lower = |p: Point2| p.y < o.y || (p.y == o.y && p.x < o.x);
    lower(p).cmp(&lower(q)).then_with(|| K::orient2d(o, q, p).cmp(&crate::model::Sign::Zero))
}

/// Notes of small angles. `origin`: the input segment of each segment.
pub fn angle_notes(angles: &[SmallAngle], pslg: &Pslg, origin: &[SegmentId], lines: &Lines) -> Vec<Finding> {
    let mut findings = Findings::default();
    for a in angles {
        findings.add(Kind::SmallAngle, || {
            let [s, t] = a.segments.map(|s| origin[s.index()]);
            let at = pslg.points[a.apex.index()];
            let message = format!(
                "segments {} and {} meet in an angle of about {:.4} degrees at vertex {} ({}, {})",
                s.0, t.0, a.degrees, a.apex.0, at.x, at.y
            );
            let elements = vec![Element::Vertex(a.apex), Element::Segment(s), Element::Segment(t)];
            Finding::new(Kind::SmallAngle, elements, vec![at], lines, message)
        });
    }
    findings.finish()
}
