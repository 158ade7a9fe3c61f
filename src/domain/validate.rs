//! The conditions on an input that need no triangulation: one function per condition, each reporting all it finds.

use super::crossings::{Crossings, crossings};
use super::finding::{Element, Finding, Findings, Kind};
use super::normalise::{Scale, normalise_all, seed_in_range};
use super::repair::repair;
use super::sweep::{Span, sweep};
use crate::arith::{Kernel, perturb::lexicographic};
use crate::model::words::counted;
use crate::model::{Fill, Lines, Point2, Pslg, Segment, SegmentId, VertexId};

/// An input made ready, with all that was found in it.
#[derive(Clone, Debug, Default)]
pub struct Prepared {
    /// The repaired input, in input units. If an error was found: what could be made of it, not to be meshed.
    pub pslg: Pslg,
    /// All findings, errors first. They name elements of the input, not of the repaired one.
    pub findings: Vec<Finding>,
    /// For each repaired segment the input segment it is a part of (the first, if several).
    pub segment_origin: Vec<SegmentId>,
}

impl Prepared {
    /// Whether the input is to be refused.
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|f| f.severity() == super::Severity::Error)
    }
}

/// Examines and repairs an input: everything that can be told without triangulating it (what concerns regions, seeds
/// and input angles is `doctor`'s). All findings at once; ids of vertices are unchanged. O((n + k) log n) for n elements and k incidences
/// if nothing crosses.
pub fn prepare<K: Kernel>(pslg: &Pslg, lines: &Lines) -> Prepared {
    let mut findings = Findings::default();
    let (vertices, scale) = vertices(pslg, lines, &mut findings);
    numbers(pslg, lines, scale, &mut findings);
    let spans = spans(pslg, lines, &vertices, &mut findings);
    if pslg.fill == Fill::Parity {
        open_cycles(pslg, lines, &vertices, &mut findings);
    }
    let mut contacts = sweep::<K>(&vertices.points, &vertices.order, &spans);
    let crossed = crossings::<K>(&vertices.points, &vertices.order, &spans, &contacts.suspects);
    contacts.incidences.extend(&crossed.incidences);
    contacts.incidences.sort_unstable_by_key(|&(s, v)| (s, vertices.rank[v as usize]));
    contacts.incidences.dedup();
    report_crossings(pslg, lines, &vertices.points, scale, &spans, &crossed, &mut findings);
    let repaired = repair(pslg, lines, &spans, &contacts.incidences, &vertices.rank, &mut findings);
    loose_ends(pslg, lines, &repaired.segments, &repaired.origin, &vertices.order, &mut findings);
    let mut made = Pslg { segments: repaired.segments, ..pslg.clone() };
    for p in &mut made.points {
        *p += Point2::ZERO; // -0 becomes +0
    }
    Prepared { pslg: made, findings: findings.finish(), segment_origin: repaired.origin }
}

/// The usable vertices.
struct Vertices {
    /// Normalised; zero for those that cannot be used.
    points: Vec<Point2>,
    /// One vertex (the first) for each place, in lexicographic order of places.
    order: Vec<u32>,
    /// Place of each vertex in that order; `u32::MAX` for those that cannot be used.
    rank: Vec<u32>,
}

fn vertices(pslg: &Pslg, lines: &Lines, findings: &mut Findings) -> (Vertices, Scale) {
    let (normal, scale) = normalise_all(&pslg.points, lines, findings);
    let mut sorted: Vec<u32> = (0..normal.len() as u32).filter(|&i| normal[i as usize].is_some()).collect();
    let points: Vec<Point2> = normal.into_iter().map(Option::unwrap_or_default).collect();
    sorted.sort_unstable_by(|&i, &j| lexicographic(points[i as usize], points[j as usize]).then(i.cmp(&j)));
    let mut order = Vec::with_capacity(sorted.len());
    let mut rank = vec![u32::MAX; points.len()];
    for equal in sorted.chunk_by(|&i, &j| points[i as usize] == points[j as usize]) {
        for &v in equal {
            rank[v as usize] = order.len() as u32;
        }
        order.push(equal[0]);
        if let [first, second, ..] = *equal {
            findings.add(Kind::CoincidentVertices, || {
                let at = pslg.points[first as usize];
                let message = match equal.len() {
                    2 => format!("vertices {first} and {second} coincide at ({}, {})", at.x, at.y),
                    n => format!("{n} vertices, among them {first} and {second}, coincide at ({}, {})", at.x, at.y),
                };
                let elements = equal.iter().map(|&v| Element::Vertex(VertexId(v))).collect();
                Finding::new(Kind::CoincidentVertices, elements, vec![at], lines, message)
            });
        }
    }
    (Vertices { points, order, rank }, scale)
}

/// Attributes, seeds and area bounds that cannot be computed with.
fn numbers(pslg: &Pslg, lines: &Lines, scale: Scale, findings: &mut Findings) {
    let width = pslg.attributes_per_point.max(1);
    for (i, x) in pslg.attributes.iter().enumerate().filter(|(_, x)| !x.is_finite()) {
        findings.add(Kind::NotFinite, || {
            let v = Element::Vertex(VertexId((i / width) as u32));
            let at = pslg.points.get(i / width).copied().into_iter().collect();
            let message = format!("attribute {} of {v} is {x}", i % width);
            Finding::new(Kind::NotFinite, vec![v], at, lines, message)
        });
    }
    let holes = pslg.holes.iter().enumerate().map(|(i, &p)| (Element::Hole(i as u32), p));
    let regions = pslg.regions.iter().enumerate().map(|(i, r)| (Element::Region(i as u32), r.seed));
    for (seed, p) in holes.chain(regions) {
        let kind = match p {
            p if !p.is_finite() => Kind::NotFinite,
            p if !seed_in_range(p, scale) => Kind::OutOfRange,
            _ => continue,
        };
        findings.add(kind, || {
            let message = format!("the seed of {seed} at ({:e}, {:e}) cannot be computed with", p.x, p.y);
            Finding::new(kind, vec![seed], vec![p], lines, message)
        });
    }
    for (i, r) in pslg.regions.iter().enumerate() {
        let e = Element::Region(i as u32);
        if !r.attribute.is_finite() {
            let message = format!("the attribute of {e} is {}", r.attribute);
            findings.add(Kind::NotFinite, || Finding::new(Kind::NotFinite, vec![e], vec![r.seed], lines, message));
        }
        if let Some(area) = r.max_area.filter(|a| !(a.is_finite() && *a > 0.0)) {
            let message = format!("the area bound of {e} is {area}, not a positive number");
            findings.add(Kind::OutOfRange, || Finding::new(Kind::OutOfRange, vec![e], vec![r.seed], lines, message));
        }
    }
}

/// The segments that join two usable vertices at different places.
fn spans(pslg: &Pslg, lines: &Lines, vertices: &Vertices, findings: &mut Findings) -> Vec<Span> {
    let mut spans = Vec::with_capacity(pslg.segments.len());
    for (i, segment) in pslg.segments.iter().enumerate() {
        let e = Element::Segment(SegmentId(i as u32));
        let [u, v] = segment.ends;
        if let Some(w) = segment.ends.into_iter().find(|w| w.index() >= pslg.points.len()) {
            findings.add(Kind::BadIndex, || {
                let count = counted(pslg.points.len(), "vertex");
                let message = format!("{e} refers to vertex {}, but the input has {count}", w.0);
                Finding::new(Kind::BadIndex, vec![e], Vec::new(), lines, message)
            });
            continue;
        }
        let ranks = [u, v].map(|w| vertices.rank[w.index()]);
        if u == v || (ranks[0] == ranks[1] && ranks[0] != u32::MAX) {
            findings.add(Kind::ZeroLength, || {
                let message = match u == v {
                    true => format!("{e} joins vertex {} to itself", u.0),
                    false => format!("{e} joins vertices {} and {}, which coincide", u.0, v.0),
                };
                Finding::new(Kind::ZeroLength, vec![e], vec![pslg.points[u.index()]], lines, message)
            });
            continue;
        }
        if ranks.contains(&u32::MAX) {
            continue; // the vertex has its finding
        }
        let [low, high] = if ranks[0] < ranks[1] { ranks } else { [ranks[1], ranks[0]] };
        let ends = [vertices.order[low as usize], vertices.order[high as usize]];
        spans.push(Span { ends, id: i as u32 });
    }
    spans
}

/// Places where an odd number of toggling segments meet. Crossing segments around such a place leads back to it on the other side. Repairs
/// change nothing of this: a vertex inside a segment meets both parts, equal parts count modulo 2. Segments without two ends have their finding.
fn open_cycles(pslg: &Pslg, lines: &Lines, vertices: &Vertices, findings: &mut Findings) {
    let place = |v: VertexId| match vertices.rank[v.index()] {
        u32::MAX => v.0,
        rank => vertices.order[rank as usize],
    };
    let segments = (0u32..).map(SegmentId).zip(&pslg.segments);
    let toggling = segments.filter(|(_, s)| s.toggles && s.ends.iter().all(|v| v.index() < pslg.points.len()));
    let mut meeting: Vec<(u32, SegmentId)> = toggling.flat_map(|(i, s)| s.ends.map(|v| (place(v), i))).collect();
    meeting.sort_unstable();
    for here in meeting.chunk_by(|a, b| a.0 == b.0).filter(|here| here.len() % 2 == 1) {
        findings.add(Kind::OpenCycle, || {
            let segments: Vec<SegmentId> = here.iter().map(|m| m.1).collect();
            Finding::open_cycle(VertexId(here[0].0), &segments, pslg, lines)
        });
    }
}

fn report_crossings(
    pslg: &Pslg,
    lines: &Lines,
    points: &[Point2],
    scale: Scale,
    spans: &[Span],
    found: &Crossings,
    findings: &mut Findings,
) {
    for &pair in &found.pairs {
        findings.add(Kind::Crossing, || {
            let [s, t] = pair.map(|k| spans[k as usize]);
            let at =
                scale.to_input(meeting_point(s.ends.map(|v| points[v as usize]), t.ends.map(|v| points[v as usize])));
            let message = format!("segments {} and {} cross near ({}, {})", s.id, t.id, at.x, at.y);
            let elements = vec![Element::Segment(SegmentId(s.id)), Element::Segment(SegmentId(t.id))];
            debug_assert!((s.id as usize) < pslg.segments.len());
            Finding::new(Kind::Crossing, elements, vec![at], lines, message)
        });
    }
    if found.at_least {
        findings.uncounted(Kind::Crossing, 0, true);
    }
}

/// About where two crossing segments meet; for display only, it decides nothing.
fn meeting_point([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Point2 {
    let (u, v) = (b - a, d - c);
    let t = (c - a).perp_dot(v) / u.perp_dot(v);
    let p = a + u * t.clamp(0.0, 1.0);
    if p.is_finite() { p } else { a.midpoint(b) }
}

/// Ends of segments that no other segment meets, and vertices of no segment.
fn loose_ends(
    pslg: &Pslg,
    lines: &Lines,
    segments: &[Segment],
    origin: &[SegmentId],
    order: &[u32],
    findings: &mut Findings,
) {
    let mut degree = vec![0u32; pslg.points.len()];
    for v in segments.iter().flat_map(|s| s.ends) {
        degree[v.index()] += 1;
    }
    for (segment, &from) in segments.iter().zip(origin) {
        for v in segment.ends.into_iter().filter(|v| degree[v.index()] == 1) {
            findings.add(Kind::DanglingSegment, || {
                let at = pslg.points[v.index()];
                let message = format!(
                    "segment {} ends at vertex {} ({}, {}), where no other segment does",
                    from.0, v.0, at.x, at.y
                );
                let elements = vec![Element::Segment(from), Element::Vertex(v)];
                Finding::new(Kind::DanglingSegment, elements, vec![at], lines, message)
            });
        }
    }
    let mut isolated: Vec<u32> = order.iter().copied().filter(|&v| degree[v as usize] == 0).collect();
    isolated.sort_unstable();
    for v in isolated {
        findings.add(Kind::IsolatedVertex, || {
            let at = pslg.points[v as usize];
            let message = format!("vertex {v} at ({}, {}) belongs to no segment", at.x, at.y);
            Finding::new(Kind::IsolatedVertex, vec![Element::Vertex(VertexId(v))], vec![at], lines, message)
        });
    }
}
