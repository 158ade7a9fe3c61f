//! Reads the Object File Format (`.off`): `OFF`, `vertices faces edges`, `x y z` a vertex, `3 a b c` a face, `#` comments.
//!
//! What follows the corners of a face is a colour and is skipped. Vertices with colours, normals or a fourth coordinate (`COFF`, `NOFF`, `4OFF`,
//! ...) and binary files are refused by name.

use super::flat::Flat;
use super::foreign::ForeignMesh;
use super::rows::{Element, Rows};
use super::{ReadError, error::shown};
use crate::model::{Point2, VertexId};

/// Reads an `.off` file as a planar mesh.
///
/// Errors: the first fault; faces that are no triangles and vertices off one plane z = constant are faults.
pub fn parse_off(bytes: &[u8]) -> Result<ForeignMesh, ReadError> {
    let mut rows = Rows::new(".off", bytes)?;
    let Header { points, faces, .. } =
        header(&mut rows, &["OFF"], "it must start with the word OFF; its variants are not read")?;
    let mut mesh = ForeignMesh::default();
    let mut flat = Flat::default();
    mesh.points.reserve(points);
    for k in 0..points as u64 {
        let mut row = rows.expect(Element::Nth("vertex", k))?;
        mesh.points.push(Point2::new(row.float("x")?, row.float("y")?));
        mesh.lines.points.push(row.line);
        flat.z(&mut row)?;
        row.end()?;
    }
    mesh.triangles.reserve(faces);
    for k in 0..faces as u64 {
        let mut row = rows.expect(Element::Nth("face", k))?;
        let corners = row.integer("the number of corners")?;
        if corners != 3 {
            return Err(row.fault(format!("it has {corners} corners"), "only triangles are read here"));
        }
        let mut t = [VertexId(0); 3];
        for v in &mut t {
            // Counts are below 2^31.
            *v = VertexId(row.ranged("a corner", 0, points as i64 - 1)? as u32);
        }
        mesh.triangles.push(t);
        mesh.lines.triangles.push(row.line);
    }
    rows.end("face")?;
    mesh.notes.extend(flat.note());
    Ok(mesh)
}

/// The counts of an `.off` file, within its size, and their line.
pub(super) struct Header<'a> {
    /// The word that the file starts with.
    pub(super) word: &'a str,
    pub(super) points: usize,
    pub(super) faces: usize,
    pub(super) line: u32,
}

/// Reads what precedes the vertices. `words` are those the file may start with; `fix` says so.
pub(super) fn header<'a>(rows: &mut Rows<'a>, words: &[&str], fix: &str) -> Result<Header<'a>, ReadError> {
    let mut head = rows.expect(Element::The("header"))?;
    let word = head.word("the word OFF")?;
    if !words.contains(&word) {
        return Err(head.fault(format!("the file starts with `{}`", shown(word)), fix));
    }
    if head.remainder() == "BINARY" {
        return Err(head.fault("the encoding is BINARY", "write the file as text"));
    }
    if !head.has_more() {
        head = rows.expect(Element::The("counts"))?;
    }
    // `0 0 0` and `3 0 0 0`, each with a line end.
    let points = head.count("the number of vertices", 6, rows)?;
    let faces = head.count("the number of faces", 8, rows)?;
    if head.has_more() {
        head.integer("the number of edges")?;
    }
    let line = head.line;
    head.end()?;
    Ok(Header { word, points, faces, line })
}
