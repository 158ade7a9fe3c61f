//! Writes the files of Triangle, numbered from 1. Every vertex carries its marker.

use super::{end, field, float};
use crate::model::{Mesh2, Point2, Pslg, Region, VertexId};

/// The `.node` file: all vertices with attributes and markers.
pub fn node(mesh: &Mesh2) -> Vec<u8> {
    let mut out = Vec::new();
    vertices(&mut out, &mesh.points, (&mesh.attributes, mesh.attributes_per_point), Some(&mesh.point_markers));
    out
}

fn vertices(out: &mut Vec<u8>, points: &[Point2], (attributes, per_point): (&[f64], usize), markers: Option<&[i32]>) {
    end(field(field(field(field(out, points.len()), 2), per_point), u8::from(markers.is_some())));
    for (i, p) in points.iter().enumerate() {
        float(float(field(out, i + 1), p.x), p.y);
        for &a in &attributes[i * per_point..(i + 1) * per_point] {
            float(out, a);
        }
        if let Some(markers) = markers {
            field(out, markers[i]);
        }
        end(out);
    }
}

/// The `.ele` file: all triangles, with the region attribute if there is one.
pub fn ele(mesh: &Mesh2) -> Vec<u8> {
    let mut out = Vec::new();
    let attributes = u8::from(!mesh.triangle_attributes.is_empty());
    end(field(field(field(&mut out, mesh.triangles.len()), 3), attributes));
    for (i, t) in mesh.triangles.iter().enumerate() {
        field(&mut out, i + 1);
        for VertexId(v) in t {
            field(&mut out, v + 1);
        }
        if let Some(&a) = mesh.triangle_attributes.get(i) {
            float(&mut out, a);
        }
        end(&mut out);
    }
    out
}

/// The `.poly` file that goes with `.node`: the subsegments with their markers, and the holes and regions of the domain where it is given.
pub fn poly(mesh: &Mesh2, domain: Option<&Pslg>) -> Vec<u8> {
    let mut out = Vec::new();
    end(field(field(field(field(&mut out, 0), 2), mesh.attributes_per_point), 1));
    end(field(field(&mut out, mesh.edges.len()), 1));
    for (i, e) in mesh.edges.iter().enumerate() {
        row(&mut out, i, e.ends, e.marker);
    }
    seeds(&mut out, domain.map_or(&[], |d| &d.holes), domain.map_or(&[], |d| &d.regions));
    out
}

fn row(out: &mut Vec<u8>, i: usize, [VertexId(a), VertexId(b)]: [VertexId; 2], marker: i32) {
    end(field(field(field(field(out, i + 1), a + 1), b + 1), marker));
}

fn seeds(out: &mut Vec<u8>, holes: &[Point2], regions: &[Region]) {
    end(field(out, holes.len()));
    for (i, p) in holes.iter().enumerate() {
        end(float(float(field(out, i + 1), p.x), p.y));
    }
    if regions.is_empty() {
        return;
    }
    end(field(out, regions.len()));
    for (i, r) in regions.iter().enumerate() {
        float(float(float(field(out, i + 1), r.seed.x), r.seed.y), r.attribute);
        end(float(out, r.max_area.unwrap_or(-1.0)));
    }
}

/// A planar straight line graph as one `.poly` file with its vertices inside.
///
/// The layout knows only `Fill::Seeds`: of another graph the holes that no seed marks would be filled, which the caller has to prevent by
/// adding their seeds to `holes`.
pub fn pslg(graph: &Pslg) -> Vec<u8> {
    let mut out = Vec::new();
    let markers = (!graph.point_markers.is_empty()).then_some(&graph.point_markers[..]);
    vertices(&mut out, &graph.points, (&graph.attributes, graph.attributes_per_point), markers);
    end(field(field(&mut out, graph.segments.len()), 1));
    for (i, s) in graph.segments.iter().enumerate() {
        row(&mut out, i, s.ends, s.marker);
    }
    seeds(&mut out, &graph.holes, &graph.regions);
    out
}

/// The `.edge` file: all edges of the triangles and all subsegments, in ascending order of ends; edges that are no subsegment have marker 0.
pub fn edge(mesh: &Mesh2) -> Vec<u8> {
    let mut all: Vec<([VertexId; 2], i32)> = mesh.edges.iter().map(|e| (e.ends, e.marker)).collect();
    for &[a, b, c] in &mesh.triangles {
        all.extend([[a, b], [b, c], [c, a]].map(|[p, q]| ([p.min(q), p.max(q)], 0)));
    }
    // Stable: a subsegment, which carries the marker, stays ahead of the same edge of its triangles.
    all.sort_by_key(|&(ends, _)| ends);
    all.dedup_by_key(|&mut (ends, _)| ends);
    let mut out = Vec::new();
    end(field(field(&mut out, all.len()), 1));
    for (i, (ends, marker)) in all.into_iter().enumerate() {
        row(&mut out, i, ends, marker);
    }
    out
}
