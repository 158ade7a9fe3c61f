//! Repairs that need no new coordinate: segments become their parts between the vertices on them, equal parts are kept once.
//!
//! Parts stand in the order of their segments, and along each from its first end. Of equal parts the first is kept, with
//! its marker; the part toggles between inside and outside if an odd number of the equal ones do.

use super::finding::{Element, Finding, Findings, Kind};
use super::sweep::Span;
use crate::model::words::counted;
use crate::model::{Lines, Pslg, Segment, SegmentId, VertexId};

/// The repaired segments, and of each the input segment it is a part of (the first, if several).
pub(super) struct Repaired {
    pub segments: Vec<Segment>,
    pub origin: Vec<SegmentId>,
}

/// Cuts the spans at their incidences and merges equal parts. `rank`: of each vertex, its place in lexicographic order;
/// `incidences` sorted by (span, vertex rank), without repetition.
pub(super) fn repair(
    pslg: &Pslg,
    lines: &Lines,
    spans: &[Span],
    incidences: &[(u32, u32)],
    rank: &[u32],
    findings: &mut Findings,
) -> Repaired {
    let mut parts: Vec<Part> = Vec::with_capacity(spans.len() + incidences.len());
    let mut rest = incidences;
    for (i, span) in spans.iter().enumerate() {
        let count = rest.iter().take_while(|c| c.0 == i as u32).count();
        let (cuts, later) = rest.split_at(count);
        rest = later;
        cut(span, pslg.segments[span.id as usize], cuts, rank, &mut parts);
        if count > 0 {
            findings.add(Kind::VertexOnSegment, || on_segment(pslg, lines, span.id, cuts));
        }
    }
    let kept = merge(&parts, |overlaps| report_overlaps(pslg, lines, overlaps, rank, findings));
    let segments = kept.iter().map(|p| Segment { ends: p.ends.map(VertexId), marker: p.marker, toggles: p.toggles });
    Repaired { segments: segments.collect(), origin: kept.iter().map(|p| SegmentId(p.origin)).collect() }
}

/// A part of a segment, directed as the segment.
#[derive(Clone, Copy)]
struct Part {
    ends: [u32; 2],
    origin: u32,
    marker: i32,
    toggles: bool,
}

impl Part {
    fn key(&self) -> [u32; 2] {
        let [u, v] = self.ends;
        [u.min(v), u.max(v)]
    }
}

fn cut(span: &Span, segment: Segment, cuts: &[(u32, u32)], rank: &[u32], parts: &mut Vec<Part>) {
    let [low, high] = span.ends;
    // The segment's own direction; its ends may be stand-ins for coincident vertices, which have equal ranks.
    let forward = rank[segment.ends[0].index()] == rank[low as usize];
    let part = |u, v| Part { ends: [u, v], origin: span.id, marker: segment.marker, toggles: segment.toggles };
    if forward {
        let last = cuts.iter().fold(low, |from, &(_, w)| {
            parts.push(part(from, w));
            w
        });
        parts.push(part(last, high));
    } else {
        let last = cuts.iter().rev().fold(high, |from, &(_, w)| {
            parts.push(part(from, w));
            w
        });
        parts.push(part(last, low));
    }
}

/// Keeps the first of equal parts, in order; hands over (first origin, other origin, ends) of each part dropped.
fn merge(parts: &[Part], report: impl FnOnce(Vec<(u32, u32, [u32; 2])>)) -> Vec<Part> {
    let mut by_ends: Vec<u32> = (0..parts.len() as u32).collect();
    by_ends.sort_unstable_by_key(|&i| (parts[i as usize].key(), i));
    let mut toggles: Vec<bool> = parts.iter().map(|p| p.toggles).collect();
    let mut dropped = vec![false; parts.len()];
    let mut overlaps = Vec::new();
    for equal in by_ends.chunk_by(|&i, &j| parts[i as usize].key() == parts[j as usize].key()) {
        let first = equal[0] as usize;
        for &other in &equal[1..] {
            let other = other as usize;
            dropped[other] = true;
            toggles[first] ^= toggles[other];
            overlaps.push((parts[first].origin, parts[other].origin, parts[first].key()));
        }
    }
    report(overlaps);
    let kept = (0..parts.len()).filter(|&i| !dropped[i]);
    kept.map(|i| Part { toggles: toggles[i], ..parts[i] }).collect()
}

fn on_segment(pslg: &Pslg, lines: &Lines, segment: u32, cuts: &[(u32, u32)]) -> Finding {
    let vertices: Vec<u32> = cuts.iter().map(|c| c.1).collect();
    let names = match &vertices[..] {
        [v] => format!("vertex {v} lies"),
        [v, w] => format!("vertices {v} and {w} lie"),
        [v, .., w] => format!("{}, from {v} to {w}, lie", counted(vertices.len(), "vertex")),
        [] => String::new(),
    };
    let message = format!("{names} on segment {segment}, which becomes {}", counted(vertices.len() + 1, "part"));
    let mut elements = vec![Element::Segment(SegmentId(segment))];
    elements.extend(vertices.iter().map(|&v| Element::Vertex(VertexId(v))));
    let at = vertices.iter().map(|&v| pslg.points[v as usize]).collect();
    Finding::new(Kind::VertexOnSegment, elements, at, lines, message)
}

/// One finding for each pair of segments that share parts; the parts shared by two segments on a line are consecutive.
fn report_overlaps(
    pslg: &Pslg,
    lines: &Lines,
    mut overlaps: Vec<(u32, u32, [u32; 2])>,
    rank: &[u32],
    findings: &mut Findings,
) {
    overlaps.sort_unstable();
    for shared in overlaps.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (first, other, _) = shared[0];
        let ends = |s: u32| {
            let mut ends = pslg.segments[s as usize].ends.map(|v| rank[v.index()]);
            ends.sort_unstable();
            ends
        };
        let kind = if ends(first) == ends(other) { Kind::DoubledSegment } else { Kind::Overlap };
        findings.add(kind, || {
            let mut along: Vec<u32> = shared.iter().flat_map(|o| o.2).collect();
            along.sort_unstable_by_key(|&v| rank[v as usize]);
            // Each part shared has two ends.
            let (u, v) = (along[0], along[along.len() - 1]);
            let message = match kind {
                Kind::DoubledSegment => {
                    format!("segments {first} and {other} both join vertices {u} and {v}")
                }
                _ => format!("segments {first} and {other} overlap between vertices {u} and {v}"),
            };
            let elements = [first, other].map(|s| Element::Segment(SegmentId(s))).to_vec();
            let at = [u, v].map(|v| pslg.points[v as usize]).to_vec();
            Finding::new(kind, elements, at, lines, message)
        });
    }
}
