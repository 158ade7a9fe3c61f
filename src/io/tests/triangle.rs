use super::{refuses, sample, survives};
use crate::io::{ForeignMesh, Input, TriangleFiles, parse_node, parse_node_ele, parse_poly, poly_wants_node, write};
use crate::model::{Point2, VertexId};

const SQUARE: &str = "# a square\n4 2 1 1\n 0 0 0 .5 1\n 1 1 0 -1 2 # here\n 2 1 1 0 3\n\n 3 0 1e0 0 4\n4 1\n1 0 1 7\n2 1 2 8\n3 2 3 9\n9 3 0 -1\n1\n1 .5 .5\n2\n1 .1 .1 3 0.01\n2 .9 .9 4 -1\n";

fn poly(bytes: &[u8]) -> Result<Input, crate::io::ReadError> {
    parse_poly(bytes, None)
}

#[test]
fn poly_in_full() {
    let input = poly(SQUARE.as_bytes()).unwrap();
    let graph = &input.pslg;
    assert_eq!(graph.points[3], Point2::new(0.0, 1.0));
    assert_eq!(graph.point_markers, [1, 2, 3, 4]);
    assert_eq!(graph.attributes, [0.5, -1.0, 0.0, 0.0]);
    assert_eq!(graph.segments[3].ends, [VertexId(3), VertexId(0)]);
    assert_eq!(graph.segments.iter().map(|s| s.marker).collect::<Vec<_>>(), [7, 8, 9, -1]);
    assert_eq!(graph.holes, [Point2::new(0.5, 0.5)]);
    assert_eq!(
        graph.regions.iter().map(|r| (r.attribute, r.max_area)).collect::<Vec<_>>(),
        [(3.0, Some(0.01)), (4.0, None)]
    );
    assert_eq!(input.lines.points, [3, 4, 5, 7]);
    assert_eq!(input.lines.segments, [9, 10, 11, 12]);
    assert_eq!((&input.lines.holes[..], &input.lines.regions[..]), (&[14][..], &[16, 17][..]));
    // Writing it and reading it back changes nothing but the lines.
    assert_eq!(poly(&write::triangle::pslg(graph)).unwrap().pslg, *graph);
}

#[test]
fn poly_with_node() {
    let node = b"3 2 0 0\r\n1 0 0\r\n2 1 0\r\n3 0 1\r\n";
    let poly = b"0 2 0 0\r\n1 0\r\n1 1 3\r\n0\r\n";
    assert!(poly_wants_node(poly) && !poly_wants_node(SQUARE.as_bytes()) && !poly_wants_node(b"\xff"));
    let input = parse_poly(poly, Some(node)).unwrap();
    assert_eq!(input.pslg.points.len(), 3);
    assert_eq!(input.pslg.segments[0].ends, [VertexId(0), VertexId(2)]);
    assert_eq!(parse_node(node).unwrap().pslg.points, input.pslg.points);
}

#[test]
fn region_without_area_is_noted() {
    let input = poly(b"3 2\n1 0 0\n2 1 0\n3 0 1\n0\n0\n1\n1 .2 .2 5\n").unwrap();
    assert_eq!(input.pslg.regions[0].max_area, None);
    assert_eq!(input.notes[0].line, 8);
}

#[test]
fn bad_poly() {
    refuses(
        poly,
        &[
            (
                b"",
                ".poly: header of the vertices: the file ends before it; the file is truncated or declares too many elements",
            ),
            (
                b"# only talk\n",
                ".poly line 1: header of the vertices: the file ends before it; the file is truncated or declares too many elements",
            ),
            (
                b"0 2 0 0\n0 0\n0\n",
                ".poly line 1: header of the vertices: it declares 0 vertices, so they should stand in a .node file of the same name, and there is none; add that file, or put the vertices here",
            ),
            (
                b"-3 2 0 0\n",
                ".poly line 1 column 1: header of the vertices: the number of vertices is -3; a count cannot be negative",
            ),
            (
                b"1000000000 2 0 0\n1 0 0\n",
                ".poly line 1 column 1: header of the vertices: the number of vertices is 1000000000, but the file has only 23 bytes; correct the count, or the file is truncated",
            ),
            (
                b"99999999999 2 0 0\n1 0 0\n",
                ".poly line 1 column 1: header of the vertices: the number of vertices is 99999999999; the limit is 2147483647",
            ),
            (
                b"3.5 2 0 0\n",
                ".poly line 1 column 1: header of the vertices: the number of vertices: `3.5` is not a whole number",
            ),
            (
                b"1 3 0 0\n1 0 0 0\n",
                ".poly line 1: header of the vertices: the dimension is 3; only planar files (dimension 2) are read here",
            ),
            (
                b"1 2 0 2\n1 0 0\n",
                ".poly line 1 column 7: header of the vertices: the number of boundary markers is 2; it must be from 0 to 1",
            ),
            (
                b"1 2 0 0 0\n1 0 0\n",
                ".poly line 1 column 9: header of the vertices: `0` is one field too many; remove it, or correct what the header declares",
            ),
            (
                b"1 2\n1 0 NaN\n",
                ".poly line 2 column 5: vertex 1: y: `NaN` is not a finite number; write a decimal number such as -1.5e3",
            ),
            (
                b"2 2\n1 0 0\n2 1e400 0\n",
                ".poly line 3 column 3: vertex 2: x: `1e400` is not a finite number; write a decimal number such as -1.5e3",
            ),
            (
                b"1 2\n1 0 zero\n",
                ".poly line 2 column 5: vertex 1: y: `zero` is not a number; write a decimal number such as -1.5e3",
            ),
            (
                b"1 2\n5 0 0\n",
                ".poly line 2 column 1: vertex 0: the number of the first vertex is 5; it must be from 0 to 1",
            ),
            (b"2 2\n1 0 0\n1 1 0\n", ".poly line 3 column 1: vertex 2: the number of the vertex is 1; it must be 2"),
            (
                b"2 2\n1 0 0\n\n",
                ".poly line 3: vertex 2: the file ends before it; the file is truncated or declares too many elements",
            ),
        ],
    );
    let triangle = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n";
    let then = |rest: &str, sentence: &str| refuses(poly, &[(format!("{triangle}{rest}").as_bytes(), sentence)]);
    let truncated = "the file ends before it; the file is truncated or declares too many elements";
    then("", &format!(".poly line 4: header of the segments: {truncated}"));
    then("1 0\n1 1 2\n", &format!(".poly line 6: header of the holes: {truncated}"));
    then("2 0\n1 1 2\n", &format!(".poly line 6: segment 2: {truncated}"));
    then("1 0\n1 1 4\n0\n", ".poly line 6 column 5: segment 1: the second end is 4; it must be from 1 to 3");
    then("1 0\n1 0 1\n0\n", ".poly line 6 column 3: segment 1: the first end is 0; it must be from 1 to 3");
    then("1 0\n1 1\n0\n", ".poly line 6: segment 1: the second end is missing; add it to the line");
    then("1 1\n1 1 2\n0\n", ".poly line 6: segment 1: marker is missing; add it to the line");
    then(
        "1 1\n1 1 2 2147483648\n0\n",
        ".poly line 6 column 7: segment 1: marker: `2147483648` is not a whole number of 32 bits",
    );
    then(
        "1 0\n1 1 2 3\n0\n",
        ".poly line 6 column 7: segment 1: `3` is one field too many; remove it, or correct what the header declares",
    );
    then(
        "0\n1\n1 inf 0\n",
        ".poly line 7 column 3: hole 1: x: `inf` is not a finite number; write a decimal number such as -1.5e3",
    );
    then(
        "0\n0\n1\n1 0 0 1 0\n",
        ".poly line 8: region 1: the largest area is 0; give a positive area, or a negative one for none",
    );
    then(
        "0\n0\n0\n7 7\n",
        ".poly line 8: end of file: `7 7` after the last section; remove it, or correct the count that the file declares",
    );
    then("0\n0\0\n", ".poly line 6 column 2: a NUL byte; this is no text file, or it is damaged");
    refuses(
        poly,
        &[(
            b"# caf\xe9\n1 2\n",
            ".poly line 1 column 6: a byte that is not UTF-8; save the file as plain text in UTF-8",
        )],
    );
}

#[test]
fn readers_survive() {
    survives(poly, SQUARE.as_bytes());
    let mesh = sample();
    let (node, ele, edge) = (write::triangle::node(&mesh), write::triangle::ele(&mesh), write::triangle::edge(&mesh));
    let files = TriangleFiles { node: &node, ele: &ele, poly: None, edge: Some(&edge) };
    survives(|node| parse_node_ele(TriangleFiles { node, ..files }), &node);
    survives(|ele| parse_node_ele(TriangleFiles { ele, ..files }), &ele);
    survives(|edge| parse_node_ele(TriangleFiles { edge: Some(edge), ..files }), &edge);
}

#[test]
fn mesh_round_trip() {
    let mesh = sample();
    let (node, ele) = (write::triangle::node(&mesh), write::triangle::ele(&mesh));
    let (poly, edge) = (write::triangle::poly(&mesh, None), write::triangle::edge(&mesh));
    let plain = |m: ForeignMesh| ForeignMesh { lines: Default::default(), ..m };
    let files = TriangleFiles { node: &node, ele: &ele, poly: Some(&poly), edge: None };
    assert_eq!(plain(parse_node_ele(files).unwrap()), ForeignMesh::from(&mesh));
    // An `.edge` file holds all edges; those without a marker are no constraints.
    let mut marked = ForeignMesh::from(&mesh);
    marked.edges.retain(|e| e.marker != 0);
    assert_eq!(plain(parse_node_ele(TriangleFiles { poly: None, edge: Some(&edge), ..files }).unwrap()), marked);
    assert!(edge.starts_with(b"9 1\n1 1 2 5\n2 1 4 5\n3 2 3 -7\n4 2 4 0\n"));
    // The input of a mesher beside the mesh is not its list of subsegments.
    let none = parse_node_ele(TriangleFiles { poly: Some(SQUARE.as_bytes()), ..files }).unwrap();
    assert!(none.edges.is_empty());
}

#[test]
fn bad_ele() {
    let node = b"3 2\n0 0 0\n1 1 0\n2 0 1\n";
    refuses(
        |ele| parse_node_ele(TriangleFiles { node, ele, poly: None, edge: None }),
        &[
            (
                b"1 6 0\n1 0 1 2 3 4 5\n",
                ".ele line 1: header of the triangles: the triangles have more than 3 nodes; write the mesh with linear elements",
            ),
            (b"1 3 0\n0 0 1 3\n", ".ele line 2 column 7: triangle 1: a corner is 3; it must be from 0 to 2"),
            (b"1 3 1\n0 0 1 2\n", ".ele line 2: triangle 1: an attribute is missing; add it to the line"),
        ],
    );
}

/// All of the corpus is read, with the counts that the headers state.
#[test]
fn corpus() {
    let Some(data) = super::data() else { return };
    let mut files = 0;
    for entry in std::fs::read_dir(data.join("pslg/as_poly")).unwrap() {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        let input = poly(&bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let text = String::from_utf8(bytes).unwrap();
        let mut rows = text.lines().filter(|l| !l.starts_with('#') && !l.trim().is_empty());
        let count = |row: &str| row.split_whitespace().next().unwrap().parse::<usize>().unwrap();
        assert_eq!(count(rows.next().unwrap()), input.pslg.points.len());
        assert_eq!(count(rows.nth(input.pslg.points.len()).unwrap()), input.pslg.segments.len());
        assert_eq!(poly(&write::triangle::pslg(&input.pslg)).unwrap().pslg, input.pslg);
        files += 1;
    }
    assert_eq!(files, 158);
}
