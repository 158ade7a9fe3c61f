//! Readers of points and meshes of space on any bytes.

use super::readers::{BETWEEN_FILES, assert_located};
use crate::io::{self, Column, ColumnName, ForeignMesh3, Format, Input3, ReadError};
use crate::model::PointSet3;

/// Columns that are asked for, besides none.
fn columns() -> [Option<Column>; 4] {
    [
        None,
        Some(Column::Weight(ColumnName::Number(4))),
        Some(Column::Radius(ColumnName::Number(5))),
        Some(Column::Weight(ColumnName::Name("w".into()))),
    ]
}

/// Points in one format.
pub(super) fn points(format: Format, bytes: &[u8]) {
    for column in columns() {
        // Only formats of points come here.
        let read = io::read_points3(format, bytes, column.as_ref()).expect("a format of points");
        match read {
            Ok(input) => points_are_sound(bytes, &input, column.is_some()),
            Err(e) => assert_located(&e),
        }
    }
}

/// A point takes three bytes at least. Written in any format and read again they are the same.
fn points_are_sound(bytes: &[u8], input: &Input3, weighted: bool) {
    let set = &input.set;
    assert!(3 * set.points.len() <= bytes.len() && set.lines.len() == set.points.len());
    assert!(set.points.iter().all(|p| p.is_finite()) && set.weights.iter().all(|w| w.is_finite()));
    assert_eq!(set.weights.len(), if weighted { set.points.len() } else { 0 });
    for format in [Format::Node, Format::Xyz, Format::Csv, Format::Npy, Format::Ply, Format::Off] {
        let once = points_written(set, format);
        let number = if format == Format::Node { 5 } else { 4 };
        let has_weights = !set.weights.is_empty() && format != Format::Off;
        let column = has_weights.then_some(Column::Weight(ColumnName::Number(number)));
        let again = match io::read_points3(format, &once, column.as_ref()) {
            Some(Ok(again)) => again.set,
            other => panic!("{format:?} of {set:?}: {other:?}"),
        };
        assert_eq!(again.points, set.points, "{format:?}");
        if has_weights {
            assert_eq!(again.weights, set.weights, "{format:?}");
        }
        // Of these formats only some hold markers.
        let again = PointSet3 { point_markers: set.point_markers.clone(), ..again };
        assert_eq!(points_written(&again, format), once, "{format:?}");
    }
}

fn points_written(set: &PointSet3, format: Format) -> Vec<u8> {
    // Only formats of points come here.
    io::write_points3(set, format).expect("a format of points")
}

/// A mesh in one file.
pub(super) fn mesh(format: Format, bytes: &[u8]) {
    for column in columns() {
        // Only formats of meshes come here.
        let read = io::read_mesh3(format, bytes, column.as_ref(), |_| None).expect("a format of meshes of space");
        mesh_is_sound(bytes, read);
    }
    // Only formats of meshes come here.
    if let Err(e) = io::read_any_mesh(format, bytes, None, |_| None).expect("a format of meshes") {
        assert_located(&e);
    }
}

/// `.node`, `.ele`, `.face`, `.edge`, with zero bytes between; an empty file is none.
pub(super) fn tetgen(bytes: &[u8]) {
    let files: Vec<&[u8]> = bytes.splitn(4, |&b| b == BETWEEN_FILES).collect();
    let part = |k: usize| files.get(k).copied().filter(|file: &&[u8]| !file.is_empty());
    for column in columns() {
        let files = io::TetgenFiles { node: files[0], ele: part(1), face: part(2), edge: part(3) };
        mesh_is_sound(bytes, io::parse_tetgen(files, column.as_ref()));
    }
}

/// Its parts fit the file, its ids exist; written in any format, read and written again it is the same file.
fn mesh_is_sound(bytes: &[u8], read: Result<ForeignMesh3, ReadError>) {
    let mesh = match read {
        Ok(mesh) => mesh,
        Err(e) => return assert_located(&e),
    };
    let count = mesh.points.len();
    assert!(count + mesh.tetrahedra.len() + mesh.triangles.len() + mesh.edges.len() <= 2 * bytes.len());
    assert!(mesh.weights.len() + mesh.point_markers.len() + mesh.tetrahedron_attributes.len() <= 4 * bytes.len());
    assert!(mesh.points.iter().all(|p| p.is_finite()) && mesh.weights.iter().all(|w| w.is_finite()));
    assert!([0, count].contains(&mesh.weights.len()) && [0, count].contains(&mesh.point_markers.len()));
    let corners = mesh.tetrahedra.iter().flatten();
    let corners = corners.chain(mesh.triangles.iter().flat_map(|t| &t.corners));
    assert!(corners.chain(mesh.edges.iter().flat_map(|e| &e.ends)).all(|v| v.index() < count));
    assert_eq!(mesh.lines.tetrahedra.len(), mesh.tetrahedra.len());
    for format in [Format::Medit, Format::Msh, Format::Msh2, Format::Vtu, Format::Vtk] {
        let once = written(&mesh, format);
        let again = io::read_mesh3(format, &once, None, |_| None);
        assert_same(&mesh, format, &once, again);
    }
    let files = Format::Node.files_of_mesh3(&mesh);
    let files: Vec<(Format, Vec<u8>)> = files.into_iter().map(|f| (f, written(&mesh, f))).collect();
    let companion = |f: Format| files.iter().find(|(g, _)| *g == f).map(|(_, bytes)| bytes.clone());
    let column = (!mesh.weights.is_empty()).then_some(Column::Weight(ColumnName::Number(5)));
    for (format, once) in &files {
        let again = io::read_mesh3(*format, once, column.as_ref(), companion);
        assert_same(&mesh, *format, once, again);
    }
    let _ = written(&mesh, Format::Off);
}

fn written(mesh: &ForeignMesh3, format: Format) -> Vec<u8> {
    // Only formats of meshes come here.
    io::write_mesh3(mesh, format).expect("a format of meshes of space")
}

fn assert_same(mesh: &ForeignMesh3, format: Format, once: &[u8], again: Option<Result<ForeignMesh3, ReadError>>) {
    let again = match again {
        Some(Ok(again)) => again,
        other => panic!("{format:?} of {mesh:?}: {other:?}"),
    };
    assert_eq!(again.points, mesh.points, "{format:?}");
    assert_eq!(again.tetrahedra, mesh.tetrahedra, "{format:?}");
    if format != Format::Medit {
        assert_eq!(again.weights, mesh.weights, "{format:?}");
        assert_eq!(again.tetrahedron_attributes, mesh.tetrahedron_attributes, "{format:?}");
    }
    let twice = written(&again, format);
    assert_eq!(twice.escape_ascii().to_string(), once.escape_ascii().to_string(), "{format:?} of {mesh:?}");
}
