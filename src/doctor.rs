//! Everything that can be said about an input: what `domain` finds, and what only a triangulation can tell.
//!
//! The repaired input is triangulated and carved as for a run. That decides about closed regions and seeds, which angles
//! lie inside the region, and which parts of the input lie outside of it. An input with other errors cannot be
//! triangulated; of it, all small angles are noted, and regions are not examined.

use crate::arith::Kernel;
use crate::domain::{
    Element, Finding, Findings, Kind, Prepared, angle_notes, merge_findings, normalise, prepare, small_angles,
};
use crate::model::{Fill, Lines, Point2, Pslg, SegmentId, VertexId};
use crate::triangulation::cdt2::{BuildError, CarveError, Cdt2, Seed};

/// Repairs an input and finds everything that can be said about it, errors first.
pub fn examine<K: Kernel>(pslg: &Pslg, lines: &Lines) -> Prepared {
    let mut prepared = prepare::<K>(pslg, lines);
    // Angles and regions need coordinates that can be computed with.
    let Ok((points, scale)) = normalise(&prepared.pslg.points, lines) else {
        return prepared;
    };
    let mut angles = small_angles::<K>(&prepared.pslg, &points);
    if !prepared.has_errors() {
        let inside = |p: Point2| scale.to_normal(p);
        match carved::<K>(&prepared.pslg, points, inside) {
            Ok(cdt) => {
                angles.retain(|a| cdt.find_edge(a.apex, a.ends[0]).is_some());
                let notes = if cdt.triangle_count() == 0 {
                    vec![Finding::nothing_left(pslg, lines)]
                } else {
                    outside(&prepared.pslg, &prepared.segment_origin, lines, &cdt)
                };
                merge_findings(&mut prepared.findings, notes);
            }
            Err(errors) => {
                let errors = errors.iter().map(|e| carve_finding(e, pslg, lines)).collect();
                merge_findings(&mut prepared.findings, errors);
            }
        }
    }
    let notes = angle_notes(&angles, &prepared.pslg, &prepared.segment_origin, lines);
    merge_findings(&mut prepared.findings, notes);
    prepared
}

/// The finding for an error of `Cdt2::carve`; `pslg` and `lines` are of the input.
pub fn carve_finding(error: &CarveError, pslg: &Pslg, lines: &Lines) -> Finding {
    // Seeds are counted in u32 wherever they are read.
    let element = |seed: &Seed| match *seed {
        Seed::Hole(i) => Element::Hole(i as u32),
        Seed::Region(i) => Element::Region(i as u32),
    };
    match error {
        CarveError::OnSegment(seed) => Finding::seed_on_segment(element(seed), pslg, lines),
        CarveError::Outside(seed) => Finding::seed_outside(element(seed), pslg, lines),
        CarveError::OpenCycle(v) => Finding::open_cycle(*v, &[], pslg, lines),
        CarveError::OneFace(i, j) => Finding::seeds_in_one_face(*i as u32, *j as u32, pslg, lines),
        CarveError::Nothing => Finding::no_closed_region(),
    }
}

/// The triangulation of the region of a repaired input without errors.
fn carved<K: Kernel>(
    pslg: &Pslg,
    points: Vec<Point2>,
    inside: impl Fn(Point2) -> Point2,
) -> Result<Cdt2<K>, Vec<CarveError>> {
    let mut cdt = match Cdt2::<K>::delaunay(points) {
        Ok(cdt) => cdt,
        Err(BuildError::Collinear) => return Err(vec![CarveError::Nothing]),
        Err(e) => panic!("a repaired input has {e}"),
    };
    let mut segments: Vec<[VertexId; 2]> = pslg.segments.iter().map(|s| s.ends).collect();
    if pslg.fill == Fill::Convex {
        segments.clear(); // the hull is kept whatever segments there are, but holes end at them
        segments.extend(hull_and(pslg, &cdt));
    }
    // Crossings and vertices inside segments are excluded by `prepare`.
    cdt.constrain(&segments).unwrap();
    let toggles: Vec<bool> = pslg.segments.iter().map(|s| s.toggles).collect();
    let holes: Vec<Point2> = pslg.holes.iter().map(|&p| inside(p)).collect();
    let seeds: Vec<Point2> = pslg.regions.iter().map(|r| inside(r.seed)).collect();
    let errors = cdt.carve_findings(pslg.fill, &toggles, &holes, &seeds);
    if !errors.is_empty() {
        return Err(errors);
    }
    // Without findings `carve` does not fail.
    cdt.carve(pslg.fill, &toggles, &holes, &seeds).unwrap();
    Ok(cdt)
}

/// The segments, then the edges of the hull that are none.
fn hull_and<K: Kernel>(pslg: &Pslg, cdt: &Cdt2<K>) -> Vec<[VertexId; 2]> {
    let key = |[u, v]: [VertexId; 2]| [u.min(v), u.max(v)];
    let mut known: Vec<[VertexId; 2]> = pslg.segments.iter().map(|s| key(s.ends)).collect();
    known.sort_unstable();
    let halves = cdt.triangles().flat_map(|t| cdt.edges(t));
    let hull = halves.filter(|&e| cdt.twin(e).is_none()).map(|e| [cdt.origin(e), cdt.destination(e)]);
    let new = hull.filter(|&e| known.binary_search(&key(e)).is_err());
    pslg.segments.iter().map(|s| s.ends).chain(new).collect()
}

/// Notes of the vertices and segments in no triangle of the region.
fn outside<K: Kernel>(pslg: &Pslg, origin: &[SegmentId], lines: &Lines, cdt: &Cdt2<K>) -> Vec<Finding> {
    let mut findings = Findings::default();
    for (v, at) in (0u32..).map(VertexId).zip(&pslg.points).filter(|(v, _)| cdt.edge_from(*v).is_none()) {
        findings.add(Kind::Outside, || {
            let message = format!("vertex {} at ({}, {}) lies outside of what is meshed", v.0, at.x, at.y);
            Finding::new(Kind::Outside, vec![Element::Vertex(v)], vec![*at], lines, message)
        });
    }
    let mut last = None;
    for (segment, &from) in pslg.segments.iter().zip(origin) {
        let [u, v] = segment.ends;
        if cdt.find_edge(u, v).is_some() || cdt.find_edge(v, u).is_some() || last == Some(from) {
            continue;
        }
        last = Some(from); // several parts of a segment, one finding
        findings.add(Kind::Outside, || {
            let at = segment.ends.map(|v| pslg.points[v.index()]).to_vec();
            let message = format!("segment {} lies outside of what is meshed, at least in part", from.0);
            Finding::new(Kind::Outside, vec![Element::Segment(from)], at, lines, message)
        });
    }
    findings.finish()
}
