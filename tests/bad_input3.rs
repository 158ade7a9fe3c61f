//! Bad input in space, reader by reader, through the library: each fault is one sentence that names its place.
//!
//! A table per reader over: empty, truncated, NaN, 1e400, negative counts, counts larger than the file, wrong indices, repeated points, 1e-300 and 1e300. What a
//! reader can express only. A reader that panics, takes a fault for a value, or talks of another line fails; so does one that refuses what
//! is not for it to judge: repeated points and extreme coordinates are read as they stand.

use orthoball::io::{AnyMesh, Format, read_any_mesh, read_mesh3, read_points3};

/// The fault, what the file says instead of what, and what the sentence has to say; nothing if the file is still read.
type Case = (&'static str, &'static str, &'static str, Option<&'static [&'static str]>);

/// `text` with one passage changed, which must be there; all of it if the passage is empty.
fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    if from.is_empty() { to.into() } else { text.replacen(from, to, 1) }
}

#[track_caller]
fn judge<T>(format: Format, case: &str, read: Result<T, orthoball::io::ReadError>, says: Option<&[&str]>) {
    match (read, says) {
        (Ok(_), None) => {}
        (Ok(_), Some(_)) => panic!("{format:?} {case}: it was read"),
        (Err(e), None) => panic!("{format:?} {case}: {e}"),
        (Err(e), Some(says)) => {
            let said = e.to_string();
            assert!(says.iter().all(|s| said.contains(s)), "{format:?} {case}: {said}");
            assert!(!said.contains(char::is_control));
        }
    }
}

fn points(format: Format, good: &str, cases: &[Case]) {
    assert_eq!(read_points3(format, good.as_bytes(), None).unwrap().unwrap().set.points.len(), 4, "{format:?}");
    for (case, from, to, says) in cases {
        let text = changed(good, from, to);
        judge(format, case, read_points3(format, text.as_bytes(), None).unwrap(), *says);
    }
}

fn meshes(format: Format, good: &str, cases: &[Case]) {
    let read = |text: &str| read_any_mesh(format, text.as_bytes(), None, |_| None).unwrap();
    assert!(matches!(read(good), Ok(AnyMesh::Space(m)) if m.tetrahedra.len() == 1), "{format:?}");
    for (case, from, to, says) in cases {
        judge(format, case, read(&changed(good, from, to)), *says);
    }
}

#[test]
fn points_in_rows() {
    let xyz = "0 0 0\n7 0 0\n0 7 0\n0 0 7\n";
    points(
        Format::Xyz,
        xyz,
        &[
            ("empty", "", "", Some(&["point 0", "ends before"])),
            ("truncated", "0 7 0\n0 0 7\n", "0 7", Some(&["line 3", "z is missing"])),
            ("NaN", "7 0 0", "nan 0 0", Some(&["line 2", "point 1", "nan"])),
            ("1e400", "7 0 0", "1e400 0 0", Some(&["line 2", "1e400"])),
            ("negative count", "0 0 0\n", "-4\n0 0 0\n", Some(&["line 1", "-4"])),
            ("large count", "0 0 0\n", "1000000\n0 0 0\n", Some(&["line 1", "1000000", "only 32 bytes"])),
            ("one point more", "0 0 0\n", "5\n0 0 0.0000000000\n", Some(&["point 4", "ends before"])),
            ("one point less", "0 0 0\n", "3\n0 0 0\n", Some(&["line 5", "after the last point"])),
            ("repeated point", "7 0 0", "0 0 0", None),
            ("1e-300", "7 0 0", "1e-300 0 0", None),
            ("1e300", "7 0 0", "1e300 0 0", None),
        ],
    );
    let csv = "x,y,z\n0,0,0\n7,0,0\n0,7,0\n0,0,7\n";
    points(
        Format::Csv,
        csv,
        &[
            ("empty", "", "", Some(&["ends before"])),
            ("truncated", "0,7,0\n0,0,7\n", "0,7", Some(&["line 4", "2 columns instead of 3"])),
            ("NaN", "7,0,0", "nan,0,0", Some(&["line 3", "point 1", "nan"])),
            ("1e400", "7,0,0", "1e400,0,0", Some(&["line 3", "1e400"])),
            ("repeated point", "7,0,0", "0,0,0", None),
            ("1e-300", "7,0,0", "1e-300,0,0", None),
            ("1e300", "7,0,0", "1e300,0,0", None),
        ],
    );
}

#[test]
fn points_with_counts() {
    let node = "4 3 0 0\n1 0 0 0\n2 7 0 0\n3 0 7 0\n4 0 0 7\n";
    points(
        Format::Node,
        node,
        &[
            ("empty", "", "", Some(&["ends before"])),
            ("truncated", "3 0 7 0\n4 0 0 7\n", "3 0", Some(&["line 4", "vertex 3", "y is missing"])),
            ("NaN", "2 7 0", "2 nan 0", Some(&["line 3", "vertex 2", "nan"])),
            ("1e400", "2 7 0", "2 1e400 0", Some(&["line 3", "1e400"])),
            ("negative count", "4 3", "-4 3", Some(&["line 1", "-4"])),
            ("large count", "4 3", "1000000 3", Some(&["line 1", "1000000", "bytes"])),
            ("one point more", "4 3", "5 3", Some(&["vertex 5", "ends before"])),
            ("wrong number", "3 0 7", "9 0 7", Some(&["line 4", "9"])),
            ("repeated point", "2 7 0", "2 0 0", None),
            ("1e-300", "2 7 0", "2 1e-300 0", None),
            ("1e300", "2 7 0", "2 1e300 0", None),
        ],
    );
    let off = "OFF\n4 1 0\n0 0 0\n7 0 0\n0 7 0\n0 0 7\n3 0 1 2\n";
    points(
        Format::Off,
        off,
        &[
            ("empty", "", "", Some(&["ends before"])),
            ("truncated", "0 0 7\n3 0 1 2\n", "0", Some(&["line 6", "vertex 3", "y is missing"])),
            ("NaN", "7 0 0", "nan 0 0", Some(&["line 4", "vertex 1", "nan"])),
            ("1e400", "7 0 0", "1e400 0 0", Some(&["line 4", "1e400"])),
            ("negative count", "4 1", "-4 1", Some(&["line 2", "-4"])),
            ("large count", "4 1", "1000000 1", Some(&["line 2", "1000000", "bytes"])),
            ("index", "0 1 2", "0 1 9", Some(&["line 7", "face 0", "9"])),
            ("negative index", "0 1 2", "0 1 -1", Some(&["line 7", "face 0", "-1"])),
            ("repeated point", "7 0 0", "0 0 0", None),
            ("1e300", "7 0 0", "1e300 0 0", None),
        ],
    );
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nend_header\n\
        0 0 0\n7 0 0\n0 7 0\n0 0 7\n";
    points(
        Format::Ply,
        ply,
        &[
            ("empty", "", "", Some(&["line 1", "does not start with `ply`"])),
            ("truncated", "0 7 0\n0 0 7\n", "0 7", Some(&["line 3", "vertex", "only 15 bytes"])),
            ("cut in a row", "0 0 7\n", "0 0.0000000000", Some(&["line 11", "vertex 3", "z is missing"])),
            ("NaN", "7 0 0", "nan 0 0", Some(&["line 9", "vertex 1", "nan"])),
            ("1e400", "7 0 0", "1e400 0 0", Some(&["line 9", "1e400"])),
            ("negative count", "vertex 4", "vertex -4", Some(&["line 3", "-4"])),
            ("large count", "vertex 4", "vertex 1000000", Some(&["line 3", "1000000", "bytes"])),
            ("repeated point", "7 0 0", "0 0 0", None),
            ("1e-300", "7 0 0", "1e-300 0 0", None),
        ],
    );
}

#[test]
fn medit_and_gmsh() {
    let medit = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n7 0 0 0\n0 7 0 0\n0 0 7 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n";
    meshes(
        Format::Medit,
        medit,
        &[
            ("empty", "", "", Some(&["ends before MeshVersionFormatted"])),
            ("NaN", "7 0 0 0", "nan 0 0 0", Some(&["line 6", "vertex 2", "nan"])),
            ("1e400", "7 0 0 0", "1e400 0 0 0", Some(&["line 6", "1e400"])),
            ("negative count", "\n4\n", "\n-4\n", Some(&["line 4", "-4"])),
            ("large count", "\n4\n", "\n1000000\n", Some(&["line 4", "1000000", "bytes"])),
            ("one point less", "\n4\n", "\n3\n", Some(&["line 8", "`0`", "keyword"])),
            ("index", "1 2 3 4 0", "1 2 3 9 0", Some(&["line 11", "tetrahedron 1", "9"])),
            ("index zero", "1 2 3 4 0", "1 2 3 0 0", Some(&["line 11", "tetrahedron 1", "0"])),
            ("repeated point", "7 0 0 0", "0 0 0 0", None),
            ("1e300", "7 0 0 0", "1e300 0 0 0", None),
        ],
    );
    let cut = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n7 0 0 0\n0 7 0 0\n0 0";
    let read = read_mesh3(Format::Medit, cut.as_bytes(), None, |_| None).unwrap();
    judge(Format::Medit, "truncated", read, Some(&["line 8", "vertex 4", "ends before z"]));
    let msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 7 0 0\n3 0 7 0\n4 0 0 7\n$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";
    meshes(
        Format::Msh,
        msh,
        &[
            ("empty", "", "", Some(&["ends before"])),
            (
                "truncated",
                "3 0 7 0\n4 0 0 7\n$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n",
                "3 0",
                Some(&["line 8", "node 3", "y is missing"]),
            ),
            ("NaN", "2 7 0", "2 nan 0", Some(&["line 7", "node 2", "nan"])),
            ("1e400", "2 7 0", "2 1e400 0", Some(&["line 7", "1e400"])),
            ("negative nodes", "\n4\n", "\n-4\n", Some(&["line 5", "-4"])),
            ("many nodes", "\n4\n", "\n1000000\n", Some(&["line 5", "1000000", "bytes"])),
            ("many elements", "\n1\n1 4", "\n1000000\n1 4", Some(&["line 12", "1000000", "bytes"])),
            ("index", "1 2 3 4\n", "1 2 3 9\n", Some(&["line 13", "element 1", "no node 9"])),
            ("a hexahedron", "1 4 2", "1 5 2", Some(&["line 13", "it is a hexahedron"])),
            ("repeated point", "2 7 0", "2 0 0", None),
            ("1e-300", "2 7 0", "2 1e-300 0", None),
        ],
    );
}

#[test]
fn vtk_files() {
    let vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n7 0 0\n0 7 0\n0 0 7\n\
        CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
    meshes(
        Format::Vtk,
        vtk,
        &[
            ("empty", "", "", Some(&["line 1", "does not start with"])),
            ("truncated", "CELL_TYPES 1\n10\n", "", Some(&["ends before CELL_TYPES"])),
            ("NaN", "7 0 0", "nan 0 0", Some(&["line 7", "POINTS", "nan"])),
            ("1e400", "7 0 0", "1e400 0 0", Some(&["line 7", "1e400"])),
            ("negative count", "POINTS 4", "POINTS -4", Some(&["line 5", "-4"])),
            ("large count", "POINTS 4", "POINTS 1000000", Some(&["line 5", "1000000", "bytes"])),
            ("one point less", "POINTS 4", "POINTS 3", Some(&["line 9", "`0`"])),
            ("index", "4 0 1 2 3", "4 0 1 2 9", Some(&["line 11", "cell 0", "9"])),
            ("negative index", "4 0 1 2 3", "4 0 1 2 -1", Some(&["line 11", "cell 0", "-1"])),
            ("repeated point", "7 0 0", "0 0 0", None),
            ("1e300", "7 0 0", "1e300 0 0", None),
        ],
    );
    let array = |kind: &str, name: &str, values: &str| {
        format!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">\n{values}\n</DataArray>\n")
    };
    let vtu = format!(
        "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n\
         </Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
        array("Float64", "Points\" NumberOfComponents=\"3", "0 0 0\n7 0 0\n0 7 0\n0 0 7"),
        array("Int64", "connectivity", "0 1 2 3"),
        array("Int64", "offsets", "4"),
        array("UInt8", "types", "10"),
    );
    meshes(
        Format::Vtu,
        &vtu,
        &[
            ("empty", "", "", Some(&["line 1", "VTKFile"])),
            ("NaN", "7 0 0", "nan 0 0", Some(&["line 7", "Points", "nan"])),
            ("1e400", "7 0 0", "1e400 0 0", Some(&["line 7", "1e400"])),
            ("negative count", "Points=\"4\"", "Points=\"-4\"", Some(&["line 3", "NumberOfPoints"])),
            ("large count", "Points=\"4\"", "Points=\"1000000\"", Some(&["line 5", "12 numbers instead of 3000000"])),
            ("index", "0 1 2 3", "0 1 2 9", Some(&["line 14", "cell 0", "9"])),
            ("negative index", "0 1 2 3", "0 1 2 -1", Some(&["line 14", "cell 0", "-1"])),
            ("repeated point", "7 0 0", "0 0 0", None),
            ("1e300", "7 0 0", "1e300 0 0", None),
        ],
    );
}

#[test]
fn tetgen_files() {
    let node = "4 3 0 0\n0 0 0 0\n1 7 0 0\n2 0 7 0\n3 0 0 7\n";
    let (ele, face) = ("1 4 0\n0 0 1 2 3\n", "1 1\n0 0 1 2 -5\n");
    let read = |node: &str, ele: &str, face: &str| {
        let [node, ele, face] = [node, ele, face].map(|text| text.as_bytes().to_vec());
        let companion = |f: Format| match f {
            Format::Node => Some(node.clone()),
            Format::Face => Some(face.clone()),
            _ => None,
        };
        read_mesh3(Format::Ele, &ele, None, companion).unwrap()
    };
    let mesh = read(node, ele, face).unwrap();
    assert_eq!((mesh.tetrahedra.len(), mesh.triangles[0].marker), (1, -5));
    for (case, from, to, says) in [
        ("empty", "", "", Some(&[".ele", "ends before"][..])),
        ("truncated", "1 2 3\n", "1", Some(&[".ele line 2", "tetrahedron 1", "a corner is missing"])),
        ("negative count", "1 4", "-1 4", Some(&[".ele line 1", "-1"])),
        ("large count", "1 4", "1000000 4", Some(&[".ele line 1", "only 22 bytes"])),
        ("hexahedra", "1 4", "1 8", Some(&[".ele line 1", "8"])),
        ("index", "1 2 3\n", "1 2 4\n", Some(&[".ele line 2", "tetrahedron 1", "4"])),
        ("negative index", "1 2 3\n", "1 2 -1\n", Some(&[".ele line 2", "tetrahedron 1", "-1"])),
        ("repeated corner", "1 2 3\n", "1 2 2\n", None),
    ] {
        judge(Format::Ele, case, read(node, &changed(ele, from, to), face), says);
    }
    judge(Format::Face, "index", read(node, ele, &changed(face, "1 2 -5", "1 9 -5")), Some(&[".face line 2", "9"]));
    judge(Format::Node, "NaN", read(&changed(node, "1 7", "1 nan"), ele, face), Some(&[".node line 3", "nan"]));
    let alone = read_mesh3(Format::Ele, ele.as_bytes(), None, |_| None).unwrap();
    judge(Format::Ele, "alone", alone, Some(&[".node", "missing"]));
}

/// The limits of the range are for the mesher to judge; a radius has a limit of its own.
#[test]
fn radii() {
    use orthoball::io::{Column, ColumnName};
    let radius = Column::Radius(ColumnName::Number(4));
    for (case, text, says) in [
        ("negative", "0 0 0 1\n1 0 0 -1\n", Some(&["line 2", "point 1", "negative"][..])),
        ("too large", "0 0 0 1e200\n", Some(&["line 1", "out of range"])),
        ("NaN", "0 0 0 nan\n", Some(&["line 1", "the radius", "nan"])),
        ("none", "0 0 0\n", Some(&["line 1", "column 4"])),
        ("small", "0 0 0 1e-200\n", None),
    ] {
        judge(Format::Xyz, case, read_points3(Format::Xyz, text.as_bytes(), Some(&radius)).unwrap(), says);
    }
}
