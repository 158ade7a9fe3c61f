//! Writes meshes of space as VTK's unstructured grids: XML (`.vtu`) and legacy (`.vtk`), all ASCII. Cells are the tetrahedra, the triangles, the edges, in this order.
//!
//! Arrays: `weight` and `marker` of points, `region` of tetrahedra, `marker` of triangles and edges, each where the mesh has it. Cells of the other
//! kinds have 0, since an array has a number for every cell.

use super::points::place;
use super::vtu::array;
use super::{end, field, float, text};
use crate::io::ForeignMesh3;
use crate::model::VertexId;

/// The cells of a mesh: corners, and VTK's number of their type.
fn cells(mesh: &ForeignMesh3) -> impl Iterator<Item = (&[VertexId], u8)> {
    let tetrahedra = mesh.tetrahedra.iter().map(|t| (&t[..], 10));
    let triangles = mesh.triangles.iter().map(|t| (&t.corners[..], 5));
    tetrahedra.chain(triangles).chain(mesh.edges.iter().map(|e| (&e.ends[..], 3)))
}

fn count(mesh: &ForeignMesh3) -> usize {
    mesh.tetrahedra.len() + mesh.triangles.len() + mesh.edges.len()
}

/// The region of every cell; nothing if there are no regions.
fn regions(mesh: &ForeignMesh3) -> Option<impl Iterator<Item = f64>> {
    let others = count(mesh) - mesh.tetrahedra.len();
    let all = mesh.tetrahedron_attributes.iter().copied().chain(std::iter::repeat_n(0.0, others));
    (!mesh.tetrahedron_attributes.is_empty()).then_some(all)
}

/// The marker of every cell; nothing if there are tetrahedra only.
fn markers(mesh: &ForeignMesh3) -> Option<impl Iterator<Item = i32>> {
    let triangles = mesh.triangles.iter().map(|t| t.marker);
    let all = std::iter::repeat_n(0, mesh.tetrahedra.len()).chain(triangles).chain(mesh.edges.iter().map(|e| e.marker));
    (count(mesh) > mesh.tetrahedra.len()).then_some(all)
}

/// The mesh as a `.vtu` file.
pub fn vtu3(mesh: &ForeignMesh3) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * mesh.points.len() + 50 * mesh.tetrahedra.len());
    text(
        &mut out,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n",
    );
    let (points, n) = (mesh.points.len(), count(mesh));
    text(&mut out, &format!("<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{n}\">\n<PointData>\n"));
    if !mesh.weights.is_empty() {
        array(&mut out, "Float64", "weight", mesh.weights.iter(), |out, &w| {
            float(out, w);
        });
    }
    if !mesh.point_markers.is_empty() {
        array(&mut out, "Int32", "marker", mesh.point_markers.iter(), |out, m| {
            field(out, m);
        });
    }
    text(&mut out, "</PointData>\n<CellData>\n");
    if let Some(regions) = regions(mesh) {
        array(&mut out, "Float64", "region", regions, |out, a| {
            float(out, a);
        });
    }
    if let Some(markers) = markers(mesh) {
        array(&mut out, "Int32", "marker", markers, |out, m| {
            field(out, m);
        });
    }
    text(&mut out, "</CellData>\n<Points>\n");
    array(&mut out, "Float64", "Points\" NumberOfComponents=\"3", mesh.points.iter(), |out, p| {
        place(out, p);
    });
    text(&mut out, "</Points>\n<Cells>\n");
    array(&mut out, "Int64", "connectivity", cells(mesh), |out, (ids, _)| {
        for VertexId(v) in ids {
            field(out, v);
        }
    });
    let ends = cells(mesh).scan(0, |sum, (ids, _)| {
        *sum += ids.len();
        Some(*sum)
    });
    array(&mut out, "Int64", "offsets", ends, |out, o| {
        field(out, o);
    });
    array(&mut out, "UInt8", "types", cells(mesh), |out, (_, kind)| {
        field(out, kind);
    });
    text(&mut out, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    out
}

/// The mesh as a legacy `.vtk` file, version 3.0.
pub fn vtk(mesh: &ForeignMesh3) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * mesh.points.len() + 50 * mesh.tetrahedra.len());
    text(&mut out, "# vtk DataFile Version 3.0\northoball\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    let (points, n) = (mesh.points.len(), count(mesh));
    text(&mut out, &format!("POINTS {points} double\n"));
    for p in &mesh.points {
        end(place(&mut out, p));
    }
    let size: usize = cells(mesh).map(|(ids, _)| ids.len() + 1).sum();
    text(&mut out, &format!("CELLS {n} {size}\n"));
    for (ids, _) in cells(mesh) {
        field(&mut out, ids.len());
        for VertexId(v) in ids {
            field(&mut out, v);
        }
        end(&mut out);
    }
    text(&mut out, &format!("CELL_TYPES {n}\n"));
    for (_, kind) in cells(mesh) {
        end(field(&mut out, kind));
    }
    if !(mesh.weights.is_empty() && mesh.point_markers.is_empty()) {
        text(&mut out, &format!("POINT_DATA {points}\n"));
    }
    if !mesh.weights.is_empty() {
        scalars(&mut out, "weight double", mesh.weights.iter(), |out, &w| float(out, w));
    }
    if !mesh.point_markers.is_empty() {
        scalars(&mut out, "marker int", mesh.point_markers.iter(), |out, m| field(out, m));
    }
    let (regions, markers) = (regions(mesh), markers(mesh));
    if regions.is_some() || markers.is_some() {
        text(&mut out, &format!("CELL_DATA {n}\n"));
    }
    if let Some(regions) = regions {
        scalars(&mut out, "region double", regions, |out, a| float(out, a));
    }
    if let Some(markers) = markers {
        scalars(&mut out, "marker int", markers, |out, m| field(out, m));
    }
    out
}

fn scalars<T>(
    out: &mut Vec<u8>,
    name_and_type: &str,
    items: impl Iterator<Item = T>,
    put: impl Fn(&mut Vec<u8>, T) -> &mut Vec<u8>,
) {
    text(out, &format!("SCALARS {name_and_type} 1\nLOOKUP_TABLE default\n"));
    for item in items {
        end(put(out, item));
    }
}
