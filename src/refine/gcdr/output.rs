//! What a run leaves behind: the head of its trace, and the mesh.

use super::choose::ordered;
use crate::arith::Kernel;
use crate::domain::Scale;
use crate::model::{
    GcdrParameters, Level, Mesh2, MeshEdge, Pslg, Segment, Triangle, VertexId, VertexKind, canonical_triangle,
};
use crate::refine::RunError;
use crate::trace::{Algorithm, Header, Record, Sink};
use crate::triangulation::cdt2::Cdt2;

/// The mesh in input units, and the dense id of each id the run gave; `kinds` tells where each vertex came from.
///
/// Input vertices are kept also where no triangle has them.
pub(in crate::refine) fn mesh_of<K: Kernel>(
    cdt: &Cdt2<K>,
    scale: Scale,
    kinds: &[VertexKind],
    pslg: &Pslg,
) -> (Mesh2, Vec<u32>) {
    let mut mesh = Mesh2 { attributes_per_point: pslg.attributes_per_point, ..Mesh2::default() };
    let mut dense = vec![u32::MAX; kinds.len()];
    for (k, &kind) in kinds.iter().enumerate() {
        let v = VertexId(k as u32);
        if kind == VertexKind::Free && cdt.edge_from(v).is_none() {
            continue;
        }
        dense[k] = mesh.points.len() as u32;
        mesh.points.push(scale.to_input(cdt.point(v)));
        mesh.point_markers.push(match kind {
            VertexKind::Input => pslg.point_markers.get(k).copied().unwrap_or(0),
            VertexKind::Free => 0,
            VertexKind::Segment(segment) => pslg.segments[segment.index()].marker,
        });
        mesh.kinds.push(kind);
        match attributes_of(pslg, k) {
            Some(own) => mesh.attributes.extend_from_slice(own),
            None => mesh.attributes.extend(std::iter::repeat_n(0.0, pslg.attributes_per_point)),
        }
    }
    let to_dense = |v: VertexId| VertexId(dense[v.index()]);
    let mut triangles: Vec<(Triangle, u32)> = Vec::new();
    for t in cdt.triangles() {
        triangles.push((canonical_triangle(cdt.vertices(t).map(to_dense)), cdt.region(t)));
        for e in cdt.edges(t) {
            let (u, v) = (cdt.origin(e), cdt.destination(e));
            if let Some(segment) = cdt.segment(e)
                && (u < v || cdt.twin(e).is_none())
            {
                let marker = pslg.segments[segment.0 as usize].marker;
                mesh.edges.push(MeshEdge { ends: ordered(to_dense(u), to_dense(v)), marker, segment });
            }
        }
    }
    triangles.sort_unstable();
    mesh.edges.sort_unstable_by_key(|e| e.ends);
    mesh.triangles = triangles.iter().map(|(t, _)| *t).collect();
    if !pslg.regions.is_empty() {
        let attribute = |label: u32| match label {
            0 => 0.0,
            k => pslg.regions[k as usize - 1].attribute,
        };
        mesh.triangle_attributes = triangles.iter().map(|&(_, label)| attribute(label)).collect();
    }
    (mesh, dense)
}

/// The attributes of an input vertex; `None` for a Steiner point.
fn attributes_of(pslg: &Pslg, k: usize) -> Option<&[f64]> {
    let per_point = pslg.attributes_per_point;
    pslg.attributes.get(k * per_point..(k + 1) * per_point)
}

/// The triangles, canonical, ascending.
pub(in crate::refine) fn canonical_triangles<K: Kernel>(cdt: &Cdt2<K>) -> Vec<Triangle> {
    let mut all: Vec<Triangle> = cdt.triangles().map(|t| canonical_triangle(cdt.vertices(t))).collect();
    all.sort_unstable();
    all
}

/// Makes the edges of the convex hull segments (marker 1), in ascending order of their ends.
pub(super) fn add_hull<K: Kernel>(cdt: &Cdt2<K>, pslg: &mut Pslg) {
    let mut known: Vec<[VertexId; 2]> = pslg.segments.iter().map(|s| ordered(s.ends[0], s.ends[1])).collect();
    known.sort_unstable();
    let mut hull: Vec<[VertexId; 2]> = Vec::new();
    for e in cdt.triangles().flat_map(|t| cdt.edges(t)) {
        let ends = ordered(cdt.origin(e), cdt.destination(e));
        if cdt.twin(e).is_none() && known.binary_search(&ends).is_err() {
            hull.push(ends);
        }
    }
    hull.sort_unstable();
    pslg.segments.extend(hull.into_iter().map(|ends| Segment { ends, marker: 1, toggles: false }));
}

/// Header, domain and initial triangulation.
pub(super) fn write_head(
    pslg: &Pslg,
    params: &GcdrParameters,
    level: Level,
    start: &[Triangle],
    sink: &mut dyn Sink,
) -> Result<(), RunError> {
    let algorithm = Algorithm::Gcdr(params.clone());
    sink.record(&Record::Header(Header { algorithm, level: Some(level), fill: pslg.fill }))?;
    write_domain(pslg, start, sink)?;
    Ok(())
}

/// The records of the domain and of the initial triangulation.
pub(crate) fn write_domain(pslg: &Pslg, start: &[Triangle], sink: &mut dyn Sink) -> std::io::Result<()> {
    for (k, &at) in pslg.points.iter().enumerate() {
        let marker = pslg.point_markers.get(k).copied();
        let attributes = attributes_of(pslg, k).unwrap_or_default().to_vec();
        sink.record(&Record::Vertex { at, marker, attributes })?;
    }
    for &segment in &pslg.segments {
        sink.record(&Record::Segment(segment))?;
    }
    for &hole in &pslg.holes {
        sink.record(&Record::Hole(hole))?;
    }
    for &region in &pslg.regions {
        sink.record(&Record::Region(region))?;
    }
    sink.record(&Record::Start { triangles: start.len() as u32 })?;
    for &t in start {
        sink.record(&Record::Triangle(t))?;
    }
    Ok(())
}
