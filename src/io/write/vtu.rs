//! Writes VTK XML unstructured grids (`.vtu`), as ParaView, VisIt and meshio read them. All arrays are ASCII: exact, and legible.
//!
//! Cells are the triangles, then the subsegments as lines. Every cell array needs a value for every cell, so that a line borrows what it
//! has not: `min_angle` is that of the worst triangle beside it and `region` that of its first triangle, which keeps the ranges of colour maps
//! honest; a triangle has `marker` 0. Point arrays: `marker`, `kind` (0 input, 1 free Steiner point, 2 Steiner point on a segment) and
//! `attribute_0`, `attribute_1`, ... Thresholding `cell_type` (0 triangle, 1 subsegment) separates the two in ParaView.

use super::super::angle::smallest_angle;
use super::{end, field, float, text};
use crate::model::{Mesh2, VertexId, VertexKind};

/// The mesh as a `.vtu` file.
pub fn vtu(mesh: &Mesh2) -> Vec<u8> {
    let mut out = Vec::new();
    let (triangles, lines) = (mesh.triangles.len(), mesh.edges.len());
    text(
        &mut out,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n",
    );
    text(&mut out, "<UnstructuredGrid>\n");
    text(
        &mut out,
        &format!("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.points.len(), triangles + lines),
    );
    text(&mut out, "<PointData Scalars=\"kind\">\n");
    point_data(&mut out, mesh);
    text(&mut out, "</PointData>\n<CellData Scalars=\"min_angle\">\n");
    cell_data(&mut out, mesh);
    text(&mut out, "</CellData>\n<Points>\n");
    array(&mut out, "Float64", "Points\" NumberOfComponents=\"3", mesh.points.iter(), |out, p| {
        field(float(float(out, p.x), p.y), 0);
    });
    text(&mut out, "</Points>\n<Cells>\n");
    cells(&mut out, mesh);
    text(&mut out, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    out
}

/// One array, a row for each item.
pub(super) fn array<T>(
    out: &mut Vec<u8>,
    kind: &str,
    name: &str,
    items: impl Iterator<Item = T>,
    mut put: impl FnMut(&mut Vec<u8>, T),
) {
    text(out, &format!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">\n"));
    for item in items {
        put(out, item);
        end(out);
    }
    text(out, "</DataArray>\n");
}

fn point_data(out: &mut Vec<u8>, mesh: &Mesh2) {
    array(out, "UInt8", "kind", mesh.kinds.iter(), |out, kind| {
        let number = match kind {
            VertexKind::Input => 0,
            VertexKind::Free => 1,
            VertexKind::Segment(_) => 2,
        };
        field(out, number);
    });
    array(out, "Int32", "marker", mesh.point_markers.iter(), |out, m| {
        field(out, m);
    });
    for k in 0..mesh.attributes_per_point {
        let column = mesh.attributes.iter().skip(k).step_by(mesh.attributes_per_point);
        array(out, "Float64", &format!("attribute_{k}"), column, |out, &a| {
            float(out, a);
        });
    }
}

fn cell_data(out: &mut Vec<u8>, mesh: &Mesh2) {
    let angles: Vec<f64> = mesh.triangles.iter().map(|&t| smallest_angle(mesh.corners(t))).collect();
    let beside = triangles_beside_edges(mesh);
    let worst = |i: &Vec<usize>| i.iter().map(|&t| angles[t]).fold(60.0, f64::min);
    array(out, "Float64", "min_angle", angles.iter().copied().chain(beside.iter().map(worst)), |out, a| {
        float(out, a);
    });
    if !mesh.triangle_attributes.is_empty() {
        let region = |i: &Vec<usize>| i.first().map_or(0.0, |&t| mesh.triangle_attributes[t]);
        let all = mesh.triangle_attributes.iter().copied().chain(beside.iter().map(region));
        array(out, "Float64", "region", all, |out, a| {
            float(out, a);
        });
    }
    let markers = mesh.triangles.iter().map(|_| 0).chain(mesh.edges.iter().map(|e| e.marker));
    array(out, "Int32", "marker", markers, |out, m| {
        field(out, m);
    });
    let types = mesh.triangles.iter().map(|_| 0).chain(mesh.edges.iter().map(|_| 1));
    array(out, "UInt8", "cell_type", types, |out, t| {
        field(out, t);
    });
}

/// For each subsegment the triangles that have it as an edge, in ascending order.
fn triangles_beside_edges(mesh: &Mesh2) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..mesh.edges.len()).collect();
    order.sort_by_key(|&i| mesh.edges[i].ends);
    let mut beside = vec![Vec::new(); mesh.edges.len()];
    for (t, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            let ends = [p.min(q), p.max(q)];
            let from = order.partition_point(|&i| mesh.edges[i].ends < ends);
            for &i in order[from..].iter().take_while(|&&i| mesh.edges[i].ends == ends) {
                beside[i].push(t);
            }
        }
    }
    beside
}

fn cells(out: &mut Vec<u8>, mesh: &Mesh2) {
    let corners = mesh.triangles.iter().map(|t| &t[..]).chain(mesh.edges.iter().map(|e| &e.ends[..]));
    array(out, "Int64", "connectivity", corners, |out, ids| {
        for VertexId(v) in ids {
            field(out, v);
        }
    });
    let (triangles, lines) = (mesh.triangles.len(), mesh.edges.len());
    let offsets = (1..=triangles).map(|i| 3 * i).chain((1..=lines).map(|i| 3 * triangles + 2 * i));
    array(out, "Int64", "offsets", offsets, |out, o| {
        field(out, o);
    });
    // VTK's numbers of the two cell types.
    let types = (0..triangles).map(|_| 5).chain((0..lines).map(|_| 3));
    array(out, "UInt8", "types", types, |out, t| {
        field(out, t);
    });
}
