//! Meshes of space.

use super::{refuses, survives};
use crate::io::*;
use crate::model::{Point3, PointState, Triangulation3, VertexId, WeightedPoint};
use proptest::prelude::*;

const FORMATS: [Format; 5] = [Format::Medit, Format::Msh, Format::Msh2, Format::Vtu, Format::Vtk];

/// Two tetrahedra with all that a mesh may carry.
pub(super) fn sample3() -> ForeignMesh3 {
    let triangle = |t: [u32; 3], marker| ForeignTriangle { corners: t.map(VertexId), marker };
    ForeignMesh3 {
        points: vec![
            Point3::new(0.0, 0.0, 0.0),
            Point3::new(1.0, 0.1, 0.0),
            Point3::new(0.0, 1.0, 1e-17),
            Point3::new(1.0 / 3.0, 0.0, 1.0),
            Point3::new(1e300, -1.0, 5e-324),
            Point3::new(7.0, 7.0, 7.0),
        ],
        weights: vec![0.0, 0.1, -2.5, 1e-300, 4.0, 0.0],
        point_markers: vec![1, 0, -3, i32::MAX, 0, 9],
        tetrahedra: vec![[0, 1, 2, 3].map(VertexId), [4, 1, 3, 2].map(VertexId)],
        tetrahedron_attributes: vec![2.0, -7.0],
        triangles: vec![triangle([0, 1, 2], 5), triangle([3, 1, 0], 0), triangle([4, 3, 2], -8)],
        edges: vec![ForeignEdge { ends: [VertexId(3), VertexId(0)], marker: 4 }],
        ..ForeignMesh3::default()
    }
}

/// A mesh without lines and notes, for comparison.
fn plain(m: ForeignMesh3) -> ForeignMesh3 {
    ForeignMesh3 { lines: MeshLines3::default(), notes: Vec::new(), ..m }
}

/// What a format carries of a mesh.
fn held(mesh: &ForeignMesh3, format: Format) -> ForeignMesh3 {
    let mut mesh = mesh.clone();
    match format {
        Format::Medit => mesh.weights.clear(),
        Format::Msh | Format::Msh2 => mesh.point_markers.clear(),
        _ => {}
    }
    mesh
}

fn alone(_: Format) -> Option<Vec<u8>> {
    None
}

fn read(format: Format, bytes: &[u8]) -> ForeignMesh3 {
    read_mesh3(format, bytes, None, alone).unwrap().unwrap_or_else(|e| panic!("{format:?}: {e}"))
}

/// All files of a mesh of TetGen, and what is read from them.
fn through_tetgen(mesh: &ForeignMesh3, column: Option<&Column>) -> ForeignMesh3 {
    let files: Vec<(Format, Vec<u8>)> =
        Format::Node.files_of_mesh3(mesh).into_iter().map(|f| (f, write_mesh3(mesh, f).unwrap())).collect();
    let companion = |f: Format| files.iter().find(|(g, _)| *g == f).map(|(_, bytes)| bytes.clone());
    read_mesh3(Format::Node, &files[0].1, column, companion).unwrap().unwrap()
}

#[test]
fn round_trips() {
    let mesh = sample3();
    for format in FORMATS {
        let bytes = write_mesh3(&mesh, format).unwrap();
        let again = read(format, &bytes);
        assert_eq!(again.lines.points.len(), 6, "{format:?}");
        assert!(again.lines.tetrahedra.iter().all(|&l| l > 0), "{format:?}");
        assert_eq!(plain(again), held(&mesh, format), "{format:?}");
        survives(|b| read_mesh3(format, b, None, alone).unwrap(), &bytes);
        let any = read_any_mesh(format, &bytes, None, alone).unwrap().unwrap();
        assert!(matches!(any, AnyMesh::Space(_)), "{format:?}");
    }
    let weights = Column::Weight(ColumnName::Number(5));
    assert_eq!(plain(through_tetgen(&mesh, Some(&weights))), mesh);
}

/// Regions that are no whole numbers survive where a format has floats or names.
#[test]
fn odd_regions() {
    let mesh = ForeignMesh3 { tetrahedron_attributes: vec![0.25, -1e300], ..sample3() };
    for format in [Format::Msh, Format::Msh2, Format::Vtu, Format::Vtk] {
        let again = read(format, &write_mesh3(&mesh, format).unwrap());
        assert_eq!(again.tetrahedron_attributes, mesh.tetrahedron_attributes, "{format:?}");
    }
    let again = read(Format::Medit, &write_mesh3(&mesh, Format::Medit).unwrap());
    assert_eq!(again.tetrahedron_attributes, [2.0, 1.0]);
}

/// A triangulation of each dimension in every format; no coordinate, weight or simplex is lost.
#[test]
fn triangulations() {
    let simplices: [&[u32]; 4] = [&[0], &[0, 1, 1, 2], &[0, 1, 2, 1, 2, 3], &[0, 1, 2, 3, 1, 2, 4, 3]];
    for (dimension, ids) in (0..4).zip(simplices) {
        let points: Vec<WeightedPoint> = sample3()
            .point_set()
            .weighted()
            .map(|p| WeightedPoint { weight: if dimension == 3 { p.weight } else { 0.0 }, ..p })
            .collect();
        let t = Triangulation3 {
            states: vec![PointState::Vertex; points.len()],
            points,
            dimension: Some(dimension),
            simplices: ids.iter().map(|&v| VertexId(v)).collect(),
        };
        let mesh = ForeignMesh3::from(&t);
        assert_eq!(
            mesh.tetrahedra.len() + mesh.triangles.len() + mesh.edges.len(),
            [0, 2, 2, 2][usize::from(dimension)]
        );
        for format in FORMATS {
            let again = plain(read(format, &write_triangulation3(&t, format).unwrap()));
            assert_eq!(again, held(&mesh, format), "{format:?} in dimension {dimension}");
        }
        let files = Format::Node.files_of_mesh3(&mesh);
        let last = [Format::Ele, Format::Edge, Format::Face, Format::Ele][usize::from(dimension)];
        assert_eq!(files, [Format::Node, last]);
        let weights = Column::Weight(ColumnName::Number(5));
        assert_eq!(plain(through_tetgen(&mesh, (dimension == 3).then_some(&weights))), mesh);
    }
}

/// The hull of two tetrahedra, counterclockwise from outside.
#[test]
fn off_shows_the_hull() {
    let mesh = ForeignMesh3 { triangles: Vec::new(), ..sample3() };
    let text = String::from_utf8(write_mesh3(&mesh, Format::Off).unwrap()).unwrap();
    assert!(text.starts_with("OFF\n6 6 0\n0 0 0\n"), "{text}");
    assert!(text.contains("\n3 0 2 1\n") && !text.contains("\n3 1 2 3\n"), "{text}");
    let back = parse_off3(text.as_bytes(), None).unwrap();
    assert_eq!(back.set.points, mesh.points);
}

/// Elements of second order as Gmsh, TetGen, VTK and Medit write them: the corners, and no node between them.
#[test]
fn second_order() {
    let corners = [[0., 0., 0.], [2., 0., 0.], [0., 2., 0.], [0., 0., 2.]];
    // A node between two corners stands first, so that ids move.
    let places = ["1 0 0", "0 0 0", "2 0 0", "0 2 0", "0 0 2", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1"];
    let numbered = || places.iter().enumerate().map(|(i, p)| format!("{} {p}\n", i + 1)).collect::<String>();
    let plain_places: String = places.iter().map(|p| format!("{p}\n")).collect();
    let node = format!("10 3 0 0\n{}", numbered());
    let msh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n{}$EndNodes\n$Elements\n2\n1 11 2 0 1 2 3 4 5 1 6 7 8 9 10\n2 9 2 4 1 2 3 4 1 6 7\n$EndElements\n",
        numbered()
    );
    let medit = format!(
        "MeshVersionFormatted 2 Dimension 3 Vertices 10 {} TrianglesP2 1 2 3 4 1 6 7 4\nTetrahedraP2\n1 2 3 4 5 1 6 7 8 9 10 0 End",
        places.iter().map(|p| format!("{p} 0\n")).collect::<String>()
    );
    let vtk = format!(
        "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 float\n{plain_places}CELLS 2 18\n10 1 2 3 4 0 5 6 7 8 9\n6 1 2 3 0 5 6\nCELL_TYPES 2\n24 22\n"
    );
    let tetgen = TetgenFiles {
        node: node.as_bytes(),
        ele: Some(b"1 10 0\n1 2 3 4 5 1 6 7 8 9 10\n"),
        face: Some(b"1 1\n1 2 3 4 1 6 7 4\n"),
        edge: None,
    };
    let read = [
        parse_msh3(msh.as_bytes(), None),
        parse_medit(medit.as_bytes()),
        parse_vtk(vtk.as_bytes(), None),
        parse_tetgen(tetgen, None),
    ];
    for mesh in read {
        let mesh = mesh.unwrap();
        assert_eq!(mesh.points, corners.map(Point3::from_array));
        assert_eq!(mesh.tetrahedra, [[0, 1, 2, 3].map(VertexId)]);
        assert_eq!(mesh.triangles[0].corners, [0, 1, 2].map(VertexId));
        assert_eq!(mesh.lines.points.len(), 4);
        assert_eq!(mesh.notes[0].text, "the elements are of second order; 6 nodes between corners are left out");
    }
    assert!(matches!(read_any_mesh(Format::Msh, msh.as_bytes(), None, alone), Some(Ok(AnyMesh::Space(_)))));
}

/// TetGen's files under -o2: triangles with three nodes unless -p is given, markers and tetrahedra beside them or not, and twice the number of edges in the header.
#[test]
fn tetgen_of_second_order() {
    let node: String = (1..=10).map(|i| format!("{i} {i} {} {}\n", i * i, i * i * i)).collect();
    let node = format!("10 3 0 0\n{node}");
    let ele: &[u8] = b"1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n";
    let read = |face: &str, edge: &str| {
        let files = TetgenFiles {
            node: node.as_bytes(),
            ele: Some(ele),
            face: Some(face.as_bytes()),
            edge: Some(edge.as_bytes()),
        };
        parse_tetgen(files, None)
    };
    for face in [
        "1 0\n1 1 2 3\n",
        "1 1\n1 1 2 3 9\n",
        "1 0\n1 1 2 3 1 -1\n",
        "1 1\n1 1 2 3 9 1 -1\n",
        "1 0\n1 1 2 3 5 6 7\n",
        "1 1\n1 1 2 3 5 6 7 9\n",
        "1 1\n1 1 2 3 5 6 7 9 1 -1\n",
    ] {
        for edge in ["1 0\n1 1 2 7\n", "2 1\n1 1 2 7 3\n"] {
            let mesh = read(face, edge).unwrap();
            assert_eq!((mesh.points.len(), mesh.triangles.len(), mesh.edges.len()), (4, 1, 1), "{face}{edge}");
            assert_eq!(mesh.triangles[0].marker, if face.starts_with("1 1") { 9 } else { 0 }, "{face}");
            assert_eq!(mesh.edges[0].marker, if edge.starts_with("2 1") { 3 } else { 0 }, "{edge}");
        }
    }
    // Half of the rows and no more may be missing.
    assert!(read("0 0\n", "4 1\n1 1 2 7 3\n").is_err() && read("2 0\n1 1 2 3\n", "0 0\n").is_err());
}

/// A mesh without tetrahedra is planar, in the formats that hold both.
#[test]
fn the_file_tells_the_dimension() {
    for format in [Format::Vtu, Format::Msh, Format::Msh2] {
        let bytes = write_mesh(&super::sample(), format, None).unwrap();
        assert!(matches!(read_any_mesh(format, &bytes, None, alone), Some(Ok(AnyMesh::Plane(_)))), "{format:?}");
    }
    let node = |d: &str| format!("3 {d} 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n");
    assert_eq!(point_dimension(Format::Node, node("3").as_bytes()), Some(3));
    assert_eq!(point_dimension(Format::Node, b"3 2 0 0\n"), Some(2));
    assert_eq!(point_dimension(Format::Node, b""), Some(2));
    assert_eq!((point_dimension(Format::Wkt, b""), point_dimension(Format::Csv, b"")), (Some(2), Some(3)));
    assert_eq!((point_dimension(Format::Svg, b""), point_dimension(Format::Vtk, b"")), (None, None));
}

/// Binary legacy files, and the cells of version 5.
#[test]
fn vtk_variants() {
    let mut old = b"# vtk DataFile Version 4.2\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n".to_vec();
    let (one, half) = (0x3f80_0000u32, 0x3f00_0000u32);
    for x in [0, 0, 0, one, 0, 0, 0, one, 0, 0, 0, half] {
        old.extend(x.to_be_bytes());
    }
    old.extend(b"\nCELLS 1 5\n");
    [4i32, 0, 1, 2, 3].iter().for_each(|x| old.extend(x.to_be_bytes()));
    old.extend(b"\nCELL_TYPES 1\n\x00\x00\x00\x0a\nCELL_DATA 1\nFIELD FieldData 2\nother 2 1 unsigned_char\n\x01\x02\nregion 1 1 double\n");
    old.extend(2.5f64.to_be_bytes());
    old.extend(b"\nMETADATA\nINFORMATION 0\n\n");
    let mesh = parse_vtk(&old, None).unwrap();
    assert_eq!((mesh.points[3].z, mesh.tetrahedra.len(), &mesh.tetrahedron_attributes[..]), (0.5, 1, &[2.5][..]));
    survives(|b| parse_vtk(b, None), &old);
    let new = b"# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 3 7\n\
        OFFSETS vtktypeint64\n0 4 7\nCONNECTIVITY vtktypeint64\n0 1 2 3\n0 1 2\nCELL_TYPES 2\n10\n5\nCELL_DATA 2\n\
        SCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n3\n8\nPOINT_DATA 4\nVECTORS v float\n0 0 0 0 0 0 0 0 0 0 0 0\n\
        SCALARS w double\nLOOKUP_TABLE default\n1\n2\n3\n4\n";
    let mesh = parse_vtk(new, Some(&Column::Radius("w".into()))).unwrap();
    assert_eq!((&mesh.tetrahedron_attributes[..], mesh.triangles[0].marker), (&[3.0][..], 8));
    assert_eq!(mesh.weights, [1.0, 4.0, 9.0, 16.0]);
    survives(|b| parse_vtk(b, None), new);
}

#[test]
fn bad_meshes() {
    refuses(
        parse_medit,
        &[
            (
                b"",
                ".mesh: header: the file ends before MeshVersionFormatted; the file is truncated or declares too many elements",
            ),
            (
                b"MeshVersionFormatted 2\nDimension 2",
                ".mesh line 2 column 11: keyword: the dimension is 2; it must be 3",
            ),
            (
                b"MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nHexahedra 1\n1 1 1 1 1 1 1 1 0",
                ".mesh line 6: keyword: there are Hexahedra; only edges, triangles and tetrahedra are read here",
            ),
            (
                b"MeshVersionFormatted 2 Dimension 3 Vertices 1 0 0 0 0\nTetrahedra 1\n1 1 1 2 0",
                ".mesh line 3 column 7: tetrahedron 1: a corner is 2; it must be 1",
            ),
        ],
    );
    let vtk = |body: &str| {
        format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\n{body}")
    };
    refuses(
        |b| parse_vtk(b, None),
        &[
            (
                b"",
                ".vtk line 1: the file does not start with `# vtk DataFile Version`; it is empty or no legacy VTK file",
            ),
            (
                b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n",
                ".vtk line 4: `POLYDATA` stands where UNSTRUCTURED_GRID is due; only unstructured grids are read here",
            ),
            (
                vtk("CELLS 1 5\n4 0 0 0 7\nCELL_TYPES 1\n10\n").as_bytes(),
                ".vtk line 8: cell 0: there is no vertex 7; vertices are numbered from 0",
            ),
            (
                vtk("CELLS 1 9\n8 0 0 0 0 0 0 0 0\nCELL_TYPES 1\n12\n").as_bytes(),
                ".vtk line 8: cell 0: it is a hexahedron; only vertices (1), lines (3), triangles (5) and tetrahedra (10) are read here, \
                 and lines (21), triangles (22) and tetrahedra (24) of second order",
            ),
            (
                vtk("CELLS 1 5\n4 0 0 0 0\n").as_bytes(),
                ".vtk line 9: the file ends before CELL_TYPES; the file is truncated or no mesh",
            ),
        ],
    );
    let weights = Column::Weight("w".into());
    let vtu = write_mesh3(&sample3(), Format::Vtu).unwrap();
    refuses(
        |b| parse_vtu3(b, Some(&weights)),
        &[(&vtu, ".vtu: no array of the points is named `w`; give the name of an array")],
    );
}

fn coordinate() -> impl Strategy<Value = f64> {
    // Every finite number but -0, which readers turn into 0.
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()).prop_map(|x| x + 0.0)
}

prop_compose! {
    fn mesh()(n in 1usize..12)(
        points in prop::collection::vec([coordinate(), coordinate(), coordinate()], n),
        weights in prop_oneof![Just(Vec::new()), prop::collection::vec(coordinate(), n)],
        tetrahedra in prop::collection::vec([0..n as u32, 0..n as u32, 0..n as u32, 0..n as u32], 0..9),
        triangles in prop::collection::vec(([0..n as u32, 0..n as u32, 0..n as u32], any::<i32>()), 0..9),
        edges in prop::collection::vec(([0..n as u32, 0..n as u32], any::<i32>()), 0..9),
        attributes in prop_oneof![Just(Vec::new()), prop::collection::vec(coordinate(), 9)],
    ) -> ForeignMesh3 {
        let count = tetrahedra.len();
        ForeignMesh3 {
            points: points.into_iter().map(Point3::from_array).collect(),
            weights,
            tetrahedra: tetrahedra.into_iter().map(|t| t.map(VertexId)).collect(),
            tetrahedron_attributes: attributes.into_iter().take(count).collect(),
            triangles: triangles.into_iter().map(|(t, marker)| ForeignTriangle { corners: t.map(VertexId), marker }).collect(),
            edges: edges.into_iter().map(|(e, marker)| ForeignEdge { ends: e.map(VertexId), marker }).collect(),
            ..ForeignMesh3::default()
        }
    }
}

proptest! {
    #[test]
    fn any_mesh_survives(mesh in mesh()) {
        for format in [Format::Msh, Format::Msh2, Format::Vtu, Format::Vtk] {
            let again = plain(read(format, &write_mesh3(&mesh, format).unwrap()));
            prop_assert_eq!(&again, &mesh, "{:?}", format);
        }
        let column = Column::Weight(ColumnName::Number(5));
        let again = through_tetgen(&mesh, (!mesh.weights.is_empty()).then_some(&column));
        prop_assert_eq!(plain(again), mesh);
    }
}

/// Numbers of a binary file in either order of bytes.
struct Bytes {
    bytes: Vec<u8>,
    big_endian: bool,
}

impl Bytes {
    fn text(&mut self, text: &str) {
        self.bytes.extend(text.as_bytes());
    }

    fn put<const N: usize>(&mut self, little: [u8; N]) {
        let mut bytes = little;
        if self.big_endian {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
    }

    fn ints(&mut self, ints: &[i32]) {
        ints.iter().for_each(|x| self.put(x.to_le_bytes()));
    }

    fn sizes(&mut self, sizes: &[u64]) {
        sizes.iter().for_each(|x| self.put(x.to_le_bytes()));
    }

    fn doubles(&mut self, p: Point3) {
        p.to_array().iter().for_each(|x| self.put(x.to_le_bytes()));
    }
}

/// Two tetrahedra in regions 7 and 9 and a triangle as Gmsh writes them in binary, with tags that are not their ranks.
fn binary_msh(four: bool, big_endian: bool) -> (Vec<u8>, ForeignMesh3) {
    let mesh = ForeignMesh3 {
        tetrahedron_attributes: vec![7.0, 9.0],
        triangles: vec![ForeignTriangle { corners: [0, 1, 2].map(VertexId), marker: 5 }],
        points: sample3().points,
        tetrahedra: sample3().tetrahedra,
        ..ForeignMesh3::default()
    };
    let tag = |v: VertexId| 10 + 2 * v.index() as i32;
    let mut b = Bytes { bytes: Vec::new(), big_endian };
    b.text(&format!("$MeshFormat\n{} 1 8\n", if four { "4.1" } else { "2.2" }));
    b.ints(&[1]);
    b.text("\n$EndMeshFormat\n$Periodic\n\x01\x02\x03$EndPeriodic\n");
    if four {
        b.text("$Entities\n");
        b.sizes(&[1, 0, 1, 2]);
        b.ints(&[3]);
        b.doubles(Point3::ZERO);
        b.sizes(&[0]);
        for (dimension, tag, group) in [(2, 1, 5), (3, 1, 7), (3, 2, 9)] {
            b.ints(&[tag]);
            b.doubles(Point3::ZERO);
            b.doubles(Point3::ONE);
            b.sizes(&[1]);
            b.ints(&[group]);
            b.sizes(&[dimension - 2]);
            b.ints(if dimension == 3 { &[-1] } else { &[] });
        }
        b.text("\n$EndEntities\n$Nodes\n");
        b.sizes(&[2, 6, 10, 20]);
        for (dimension, points) in [(1, 0..2), (3, 2..6u32)] {
            b.ints(&[dimension, 1, dimension % 3]);
            b.sizes(&[points.len() as u64]);
            points.clone().for_each(|v| b.sizes(&[tag(VertexId(v)) as u64]));
            for v in points {
                b.doubles(mesh.points[v as usize]);
                // The parameter on a curve.
                b.sizes(if dimension == 1 { &[77] } else { &[] });
            }
        }
        b.text("\n$EndNodes\n$Elements\n");
        b.sizes(&[3, 3, 1, 3]);
        let elements: [(i32, i32, i32, &[VertexId]); 3] =
            [(2, 1, 2, &mesh.triangles[0].corners), (3, 1, 4, &mesh.tetrahedra[0]), (3, 2, 4, &mesh.tetrahedra[1])];
        for (k, (dimension, entity, kind, corners)) in elements.into_iter().enumerate() {
            b.ints(&[dimension, entity, kind]);
            b.sizes(&[1, k as u64 + 1]);
            corners.iter().for_each(|&v| b.sizes(&[tag(v) as u64]));
        }
    } else {
        b.text("$Nodes\n6\n");
        for (v, p) in (0..).zip(&mesh.points) {
            b.ints(&[tag(VertexId(v))]);
            b.doubles(*p);
        }
        b.text("\n$EndNodes\n$Elements\n3\n");
        b.ints(&[2, 1, 2, 1, 5, 1]);
        mesh.triangles[0].corners.iter().for_each(|&v| b.ints(&[tag(v)]));
        b.ints(&[4, 2, 1]);
        for (k, cell) in (0..).zip(&mesh.tetrahedra) {
            b.ints(&[2 + k, 7 + 2 * k]);
            cell.iter().for_each(|&v| b.ints(&[tag(v)]));
        }
    }
    b.text("\n$EndElements\n");
    (b.bytes, mesh)
}

#[test]
fn binary_msh_is_read() {
    for (four, big_endian) in [(false, false), (false, true), (true, false), (true, true)] {
        let (bytes, mesh) = binary_msh(four, big_endian);
        let read = parse_msh3(&bytes, None).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(read.lines.points, [0; 6], "lines of a binary file mean nothing");
        assert_eq!(plain(read), mesh, "version four: {four}, big endian: {big_endian}");
        survives(|b| parse_msh3(b, None), &bytes);
    }
    let (bytes, _) = binary_msh(false, false);
    // The type of the block of tetrahedra becomes that of hexahedra, or the count of nodes grows.
    let with = |from: &[u8], to: &[u8]| {
        let at = bytes.windows(from.len()).position(|w| w == from).expect("the bytes are there");
        [&bytes[..at], to, &bytes[at + from.len()..]].concat()
    };
    let hexahedra = with(&[4, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0], &[5, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0]);
    let more = with(b"$Nodes\n6", b"$Nodes\n9");
    let no_node = with(&[14, 0, 0, 0, 16, 0, 0, 0], &[14, 0, 0, 0, 15, 0, 0, 0]);
    refuses(
        |b| parse_msh3(b, None),
        &[
            (
                &hexahedra,
                ".msh: element 2: it is a hexahedron; only points (15), lines (1, 8), triangles (2, 9) and tetrahedra (4, 11) are read here",
            ),
            (
                &more,
                ".msh: $Nodes: bytes that are no text where a line of text is due; the counts of the section are wrong, or the file is damaged",
            ),
            (
                b"$MeshFormat\n2.2 1 \x078\n",
                ".msh: $MeshFormat: the size of numbers is \\u{7}8 bytes; save it as ASCII",
            ),
            (
                b"$MeshFormat\n2.2 1 8\n\x01\0\0\0\n$EndMeshFormat\n$PhysicalNames\n1111111111111111\n",
                ".msh: $PhysicalNames: the file ends within it; the file is truncated or declares too many elements",
            ),
            (&no_node, ".msh: element 2: there is no node 15; correct the element or add the node"),
            (
                &bytes[..200],
                ".msh: $Nodes: the file ends within it; the file is truncated or declares too many elements",
            ),
        ],
    );
}
