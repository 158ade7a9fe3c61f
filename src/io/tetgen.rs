//! Reads the meshes of TetGen: `.node` and `.ele`, with `.face` and `.edge` where they are there (TetGen's manual, section on its file formats).
//!
//! - `.node`: `points 3 attributes markers(0|1)`, then `index x y z attributes... [marker]`, from 0 or 1.
//! - `.ele`: `tetrahedra corners(4|10) attributes`, then `index corner corner corner corner [six more] attributes...`.
//! - `.face`: `triangles markers(0|1)`, then `index corner corner corner [three more] [marker]`, perhaps the tetrahedra beside it, which are left out.
//! - `.edge`: `edges markers(0|1)`, then `index end end [one more] [marker]`, perhaps a tetrahedron beside it, which is left out.
//!
//! Choice: whether triangles have nodes between corners is told by the length of their rows, since TetGen writes them with `-p` only; of edges `.ele` tells it.
//! Its header of `.edge` counts twice in second order; then a file of half as many rows is whole.

use super::points::read_node3;
use super::rows::{Element, Row, Rows};
use super::triangle::{MOST_ATTRIBUTES, Nodes};
use super::{Column, ForeignEdge, ForeignMesh3, ForeignTriangle, Note, NoteKind, ReadError};
use crate::model::{Point3, VertexId};

/// The files of one mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct TetgenFiles<'a> {
    /// The points.
    pub node: &'a [u8],
    /// The tetrahedra.
    pub ele: Option<&'a [u8]>,
    /// The triangles.
    pub face: Option<&'a [u8]>,
    /// The edges.
    pub edge: Option<&'a [u8]>,
}

/// Reads a mesh of TetGen; `column` says which column of `.node` holds weights, if there are any (its first attribute is column 5).
///
/// Errors: the first fault of any of the files.
pub fn parse_tetgen(files: TetgenFiles, column: Option<&Column>) -> Result<ForeignMesh3, ReadError> {
    let mut mesh = ForeignMesh3::default();
    let (nodes, weights) = read_node3(files.node, column, &mut mesh.notes)?;
    let mut middle = Vec::new();
    let second_order = match files.ele {
        Some(ele) => tetrahedra(ele, &nodes, &mut mesh, &mut middle)?,
        None => false,
    };
    if let Some(face) = files.face {
        triangles(face, &nodes, &mut mesh, &mut middle)?;
    }
    if let Some(edge) = files.edge {
        edges(edge, &nodes, second_order, &mut mesh, &mut middle)?;
    }
    mesh.points = nodes.points;
    mesh.weights = weights;
    mesh.point_markers = nodes.markers;
    mesh.lines.points = nodes.lines;
    mesh.drop_middle_nodes(&middle);
    Ok(mesh)
}

fn corners<const N: usize>(nodes: &Nodes<Point3>, row: &mut Row) -> Result<[VertexId; N], ReadError> {
    let mut ids = [VertexId(0); N];
    for id in &mut ids {
        *id = nodes.id(row, "a corner")?;
    }
    Ok(ids)
}

/// Reads `.ele` and says whether its elements are of second order.
fn tetrahedra(
    ele: &[u8],
    nodes: &Nodes<Point3>,
    mesh: &mut ForeignMesh3,
    middle: &mut Vec<VertexId>,
) -> Result<bool, ReadError> {
    let mut rows = Rows::new(".ele", ele)?;
    let mut head = rows.expect(Element::The("header of the tetrahedra"))?;
    // `1 1 2 3 4` and a line end.
    let count = head.count("the number of tetrahedra", 10, &rows)?;
    let size = if head.has_more() { head.ranged("the number of corners", 3, 10)? } else { 4 };
    if size != 4 && size != 10 {
        let fix = "tetrahedra have 4 corners, or 10 nodes in second order";
        return Err(head.fault(format!("the number of corners is {size}"), fix));
    }
    let per = if head.has_more() { head.ranged("the number of attributes", 0, MOST_ATTRIBUTES)? } else { 0 };
    if per > 1 {
        let text = format!("of {per} attributes a tetrahedron only the first is kept");
        mesh.notes.push(Note { kind: NoteKind::Note, line: head.line, text });
    }
    head.end()?;
    mesh.tetrahedra.reserve(count);
    mesh.lines.tetrahedra.reserve(count);
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("tetrahedron", k + 1))?;
        row.integer("the number of the tetrahedron")?;
        mesh.tetrahedra.push(corners(nodes, &mut row)?);
        if size == 10 {
            middle.extend(corners::<6>(nodes, &mut row)?);
        }
        for i in 0..per {
            let attribute = row.float("an attribute")?;
            if i == 0 {
                mesh.tetrahedron_attributes.push(attribute);
            }
        }
        mesh.lines.tetrahedra.push(row.line);
        row.end()?;
    }
    rows.end("tetrahedron")?;
    Ok(size == 10)
}

fn triangles(
    face: &[u8],
    nodes: &Nodes<Point3>,
    mesh: &mut ForeignMesh3,
    middle: &mut Vec<VertexId>,
) -> Result<(), ReadError> {
    let mut rows = Rows::new(".face", face)?;
    let (count, marked) = header(&mut rows, "the number of triangles", 8)?;
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("triangle", k + 1))?;
        row.integer("the number of the triangle")?;
        // Three corners, a marker and two tetrahedra are fewer than six nodes and a marker.
        let six = row.fields() > 5 + usize::from(marked);
        let corners = corners(nodes, &mut row)?;
        if six {
            middle.extend(self::corners::<3>(nodes, &mut row)?);
        }
        let marker = if marked { row.marker()? } else { 0 };
        mesh.triangles.push(ForeignTriangle { corners, marker });
        mesh.lines.triangles.push(row.line);
        beside(row, 2)?;
    }
    rows.end("triangle")
}

fn edges(
    edge: &[u8],
    nodes: &Nodes<Point3>,
    second_order: bool,
    mesh: &mut ForeignMesh3,
    middle: &mut Vec<VertexId>,
) -> Result<(), ReadError> {
    let mut rows = Rows::new(".edge", edge)?;
    let (count, marked) = header(&mut rows, "the number of edges", 6)?;
    for k in 0..count as u64 {
        let element = Element::Nth("edge", k + 1);
        let mut row = match rows.next(element) {
            Some(row) => row,
            None if second_order && 2 * k == count as u64 => break,
            None => return rows.expect(element).map(drop),
        };
        row.integer("the number of the edge")?;
        let ends = corners(nodes, &mut row)?;
        if second_order {
            middle.extend(corners::<1>(nodes, &mut row)?);
        }
        let marker = if marked { row.marker()? } else { 0 };
        mesh.edges.push(ForeignEdge { ends, marker });
        mesh.lines.edges.push(row.line);
        beside(row, 1)?;
    }
    rows.end("edge")
}

/// The count of a file, rows of at least so many bytes, and whether they carry markers.
fn header(rows: &mut Rows, name: &'static str, bytes: usize) -> Result<(usize, bool), ReadError> {
    let mut head = rows.expect(Element::The("header"))?;
    let count = head.count(name, bytes, rows)?;
    let marked = head.has_more() && head.ranged("the number of boundary markers", 0, 1)? == 1;
    head.end()?;
    Ok((count, marked))
}

/// That nothing follows but the numbers of at most so many tetrahedra.
fn beside(mut row: Row, most: usize) -> Result<(), ReadError> {
    for _ in 0..most {
        if row.has_more() {
            row.integer("a tetrahedron beside it")?;
        }
    }
    row.end()
}
