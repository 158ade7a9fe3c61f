//! `.off`, `.vtu`, `.msh`.

use super::{refuses, sample, survives};
use crate::io::write::{self, MshVersion};
use crate::io::{ForeignMesh, MeshLines, parse_msh, parse_off, parse_vtu};
use crate::model::{Mesh2, VertexId};

/// A mesh without lines, for comparison.
fn plain(m: ForeignMesh) -> ForeignMesh {
    ForeignMesh { lines: MeshLines::default(), ..m }
}

/// What `.msh` carries of a mesh.
fn bare_vertices(mesh: &Mesh2) -> ForeignMesh {
    ForeignMesh {
        point_markers: Vec::new(),
        attributes: Vec::new(),
        attributes_per_point: 0,
        ..ForeignMesh::from(mesh)
    }
}

#[test]
fn vtu_round_trip() {
    let mut mesh = sample();
    let bytes = write::vtu(&mesh);
    let read = parse_vtu(&bytes).unwrap();
    assert_eq!((read.lines.points[0], read.lines.triangles.len(), read.lines.edges.len()), (95, 4, 7));
    assert_eq!(plain(read), ForeignMesh::from(&mesh));
    mesh.triangle_attributes.clear();
    assert_eq!(plain(parse_vtu(&write::vtu(&mesh)).unwrap()), ForeignMesh::from(&mesh));
    survives(parse_vtu, &bytes);
}

#[test]
fn msh_round_trip() {
    let mut mesh = sample();
    for version in [MshVersion::V41, MshVersion::V22] {
        let bytes = write::msh(&mesh, version);
        assert_eq!(plain(parse_msh(&bytes).unwrap()), bare_vertices(&mesh), "{version:?}");
        survives(parse_msh, &bytes);
    }
    mesh.triangle_attributes.clear();
    for version in [MshVersion::V41, MshVersion::V22] {
        assert_eq!(plain(parse_msh(&write::msh(&mesh, version)).unwrap()), bare_vertices(&mesh), "{version:?}");
    }
}

/// A whole positive number is the tag of its group, so that other programs see it.
#[test]
fn msh_groups() {
    let text = String::from_utf8(write::msh(&sample(), MshVersion::V22)).unwrap();
    assert!(text.contains("$PhysicalNames\n7\n1 1 \"marker -7\"\n1 2 \"marker 0\"\n1 5 \"marker 5\"\n1 2147483647 \"marker 2147483647\"\n2 1 \"region 1\"\n"));
    assert!(text.contains("\n1 1 2 5 5 1 2\n") && text.contains("\n8 2 2 1 1 1 2 4\n"));
}

#[test]
fn off_round_trip() {
    let mesh = sample();
    let bytes = write::off(&mesh);
    let due = ForeignMesh { points: mesh.points.clone(), triangles: mesh.triangles.clone(), ..ForeignMesh::default() };
    assert_eq!(plain(parse_off(&bytes).unwrap()), due);
    survives(parse_off, &bytes);
    let read = parse_off(b"OFF 3 1 0\n0 0 2.5\n1 0 2.5\n\n0 1 2.5\n3 2 1 0 255 0 0\n").unwrap();
    assert_eq!(read.triangles, [[2, 1, 0].map(VertexId)]);
    assert_eq!((read.notes[0].line, &*read.notes[0].text), (2, "all vertices have z = 2.5, which is left out"));
    assert_eq!((read.lines.points, read.lines.triangles), (vec![2, 3, 5], vec![6]));
}

#[test]
fn bad_off() {
    refuses(
        parse_off,
        &[
            (b"", ".off: header: the file ends before it; the file is truncated or declares too many elements"),
            (
                b"COFF\n1 0 0\n",
                ".off line 1: header: the file starts with `COFF`; it must start with the word OFF; its variants are not read",
            ),
            (b"OFF BINARY\n1", ".off line 1: header: the encoding is BINARY; write the file as text"),
            (
                b"OFF\n-1 0 0\n",
                ".off line 2 column 1: counts: the number of vertices is -1; a count cannot be negative",
            ),
            (
                b"OFF\n3 9 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                ".off line 2 column 3: counts: the number of faces is 9, but the file has only 36 bytes; correct the count, or the file is truncated",
            ),
            (
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n",
                ".off line 5: vertex 2: z is 1.0, but 0.0 before; only planar meshes are read here",
            ),
            (
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                ".off line 6 column 7: face 0: a corner is 3; it must be from 0 to 2",
            ),
            (
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 1\n",
                ".off line 6: face 0: it has 4 corners; only triangles are read here",
            ),
            (
                b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
                ".off line 7: end of file: `3 0 1 2` after the last face; remove it, or correct the count that the file declares",
            ),
        ],
    );
}

#[test]
fn bad_msh() {
    let head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n5 1 0 0\n7 0 1 0\n$EndNodes\n$Elements\n";
    let good = format!("{head}2\n9 1 2 4 1 1 5\n3 2 2 6 1 1 5 7\n$EndElements\n");
    let mesh = parse_msh(good.as_bytes()).unwrap();
    assert_eq!(
        (mesh.triangles[0], mesh.edges[0].marker, mesh.triangle_attributes[0]),
        ([0, 1, 2].map(VertexId), 4, 6.0)
    );
    refuses(
        parse_msh,
        &[
            (
                b"point=3\n",
                ".msh line 1: header: the file does not start with $MeshFormat; only Gmsh's .msh is read here; other programs use the same extension",
            ),
            (
                b"$MeshFormat\n4.1 1 4\n\x01\x00\x00\x00\n",
                ".msh: $MeshFormat: the size of numbers is 4 bytes; save it as ASCII",
            ),
            (
                b"$MeshFormat\n3 0 8\n$EndMeshFormat\n",
                ".msh line 2: format: the version is 3; save it as version 4.1 or 2.2",
            ),
            (
                b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                ".msh line 3: $Elements: the file ends before it; the file is truncated or holds no mesh",
            ),
            (
                b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Extra\n1\n",
                ".msh line 5: end of a section: the file ends before it; the file is truncated or declares too many elements",
            ),
            (
                b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n",
                ".msh line 7: node 1: two nodes up to this line have this tag; give every node its own",
            ),
            (
                b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99\n1 0 0 0\n",
                ".msh line 5 column 1: numbers of nodes: the number of nodes is 99, but the file has only 53 bytes; correct the count, or the file is truncated",
            ),
        ],
    );
    let then = |rest: &str, sentence: &str| refuses(parse_msh, &[(format!("{head}{rest}").as_bytes(), sentence)]);
    then(
        "1\n1 2 0 1 5 6\n$EndElements\n",
        ".msh line 12: element 1: there is no node 6; correct the element or add the node",
    );
    then(
        "1\n1 3 0 1 5 7 5\n$EndElements\n",
        ".msh line 12: element 1: it is a quadrilateral; only points (15), lines (1) and triangles (2) are read here",
    );
    then(
        "1\n1 2 0 1 5 7 7\n$EndElements\n",
        ".msh line 12 column 13: element 1: `7` is one field too many; remove it, or correct what the header declares",
    );
    then(
        "1\n1 2 0 1 5 7\n2 2 0 1 5 7\n$EndElements\n",
        ".msh line 13: end of the section: `2 2 0 1 5 7` stands where $EndElements is due; correct the count of the section",
    );
}

/// The same triangle in every encoding that is read: big and little endian, wide and narrow lengths.
#[test]
fn vtu_encodings() {
    let wrap = |attributes: &str, arrays: [&str; 4], tail: &str| {
        let [points, connectivity, offsets, types] = arrays;
        format!(
            "<?xml version='1.0'?><!-- a > b --><VTKFile type=\"UnstructuredGrid\" {attributes}><UnstructuredGrid><Piece NumberOfPoints='3' NumberOfCells='1'>\
             <Points><DataArray type='Float32' NumberOfComponents='3' {points}</Points><Cells><DataArray type='Int32' Name='connectivity' {connectivity}\
             <DataArray type='Int32' Name='offsets' {offsets}<DataArray type='UInt8' Name='types' {types}</Cells></Piece></UnstructuredGrid>{tail}</VTKFile>"
        )
    };
    // Lengths 36, 12, 4 and 1 in 32 bits, little endian.
    let blocks = [
        "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==",
        "DAAAAAAAAAABAAAAAgAAAA==",
        "BAAAAAMAAAA=",
        "AQAAAAU=",
    ];
    let inline = blocks.map(|b| format!("format='binary'>\n {b}\n</DataArray>"));
    let inline = wrap("byte_order='LittleEndian'", inline.each_ref().map(|s| &**s), "");
    let due = plain(parse_off(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").unwrap());
    let read = |bytes: &[u8]| plain(parse_vtu(bytes).unwrap_or_else(|e| panic!("{e}")));
    assert_eq!(read(inline.as_bytes()), due);
    survives(parse_vtu, inline.as_bytes());
    let mut at = 0;
    let offsets = blocks.map(|b| {
        at += b.len();
        format!("format='appended' offset='{}'/>", at - b.len())
    });
    let tail = format!("<AppendedData encoding='base64'>\n_{}\n</AppendedData>", blocks.concat());
    let appended = wrap("", offsets.each_ref().map(|s| &**s), &tail);
    assert_eq!(read(appended.as_bytes()), due);
    // Raw, big endian, lengths of 64 bits.
    let mut raw = Vec::new();
    let mut starts = Vec::new();
    let floats = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let blocks: [Vec<u8>; 4] = [
        floats.iter().flat_map(|x| x.to_be_bytes()).collect(),
        [0i32, 1, 2].iter().flat_map(|x| x.to_be_bytes()).collect(),
        3i32.to_be_bytes().to_vec(),
        vec![5],
    ];
    for block in &blocks {
        starts.push(format!("format='appended' offset='{}'/>", raw.len()));
        raw.extend((block.len() as u64).to_be_bytes());
        raw.extend(block);
    }
    let text = wrap(
        "byte_order='BigEndian' header_type='UInt64'",
        [&starts[0], &starts[1], &starts[2], &starts[3]],
        "<AppendedData encoding='raw'>_@</AppendedData>",
    );
    let (head, tail) = text.split_once('@').unwrap();
    let bytes = [head.as_bytes(), &raw, tail.as_bytes()].concat();
    assert_eq!(read(&bytes), due);
    survives(parse_vtu, &bytes);
    // Compressed by Python's zlib, the points in chunks of 16 bytes, the last of 4.
    let blocks = [
        "AwAAABAAAAAEAAAADQAAAA0AAAAMAAAAeJxjYEAGDfYAAU8AwHicY2BABg32AAFPAMB4nGNgYGAAAAAEAAE=",
        "AQAAAAwAAAAAAAAAEQAAAA==eJxjYGBgYARiJiAGAAAcAAQ=",
        "AQAAAACAAAAEAAAADAAAAA==eJxjZmBgAAAAEAAE",
        "AQAAAACAAAABAAAACQAAAA==eJxjBQAABgAG",
    ];
    let inline = blocks.map(|b| format!("format='binary'>\n {b}\n</DataArray>"));
    let zlib = wrap("compressor='vtkZLibDataCompressor'", inline.each_ref().map(|s| &**s), "");
    assert_eq!(read(zlib.as_bytes()), due);
    survives(parse_vtu, zlib.as_bytes());
    for (from, to) in [("eJxjZm", "eJxjZn"), ("AwAAABAAAAAEAAAA", "AwAAABAAAAAIAAAA")] {
        assert!(
            parse_vtu(zlib.replacen(from, to, 1).as_bytes()).unwrap_err().to_string().contains("damaged"),
            "{from}"
        );
    }
}

#[test]
fn bad_vtu() {
    let text = String::from_utf8(write::vtu(&sample())).unwrap();
    let with = |from: &str, to: &str, sentence: &str| {
        assert!(text.contains(from), "{from}");
        refuses(parse_vtu, &[(text.replacen(from, to, 1).as_bytes(), sentence)]);
    };
    with("<VTKFile", "<vtk", ".vtu line 1: the file does not start with the tag VTKFile");
    with(
        "\"UnstructuredGrid\"",
        "\"PolyData\"",
        ".vtu line 2: VTKFile: the type is PolyData; only UnstructuredGrid is read here",
    );
    with(
        "byte_order",
        "compressor=\"vtkLZ4DataCompressor\" byte_order",
        ".vtu line 2: VTKFile: the arrays are compressed by vtkLZ4DataCompressor; save the file uncompressed or compressed by zlib",
    );
    with(
        "NumberOfPoints=\"6\"",
        "NumberOfPoints=\"7\"",
        ".vtu line 94: DataArray \"Points\": it has 18 numbers instead of 21; the file is damaged",
    );
    with(
        "NumberOfPoints=\"6\"",
        "NumberOfPoints=\"-6\"",
        ".vtu line 4: Piece: NumberOfPoints is -6; it must be a whole number of at most 2147483647",
    );
    with("\n1 0.1 0\n", "\n1 1e400 0\n", ".vtu line 96: DataArray \"Points\": `1e400` is not a finite number");
    with(
        "\n1 0.1 0\n",
        "\n1 0.1 1\n",
        ".vtu line 96: vertex 1: z is 1.0, but 0.0 before; only planar meshes are read here",
    );
    with("\n0 1 3\n", "\n0 1 6\n", ".vtu line 105: cell 0: there is no vertex 6; vertices are numbered from 0");
    with("\n0 1 3\n", "\n0 -1 3\n", ".vtu line 105: cell 0: there is no vertex -1; vertices are numbered from 0");
    with(
        "Name=\"offsets\"",
        "Name=\"ofsets\"",
        ".vtu line 4: Piece: the array Cells offsets is missing; the file is truncated or no mesh",
    );
    with(
        "\n5\n5\n5\n5\n3\n",
        "\n5\n9\n5\n5\n3\n",
        ".vtu line 106: cell 1: its type is 9 and it has 3 corners; only vertices (1), lines (3) and triangles (5) are read here",
    );
    with("</VTKFile>", "</VTKFile", ".vtu line 146: the file ends within a tag; this is no well-formed XML");
}
