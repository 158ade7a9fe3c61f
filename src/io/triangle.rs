//! Reads the files of Shewchuk's Triangle: `.poly`, `.node`, `.ele`, `.edge`.
//!
//! Layout (Triangle's documentation of its file formats): rows of fields, `#` starts a comment.
//!
//! - `.node`: `vertices 2 attributes markers(0|1)`, then `index x y attributes... [marker]`.
//! - `.poly`: the same (0 vertices: they stand in the `.node` file of the same name), then `segments markers(0|1)` and
//!   `index end end [marker]`, `holes` and `index x y`, perhaps `regions` and `index x y attribute [max_area]`.
//! - `.ele`: `triangles 3 attributes`, then `index corner corner corner attributes...`.
//! - `.edge`: `edges markers(0|1)`, then `index end end [marker]`.
//!
//! Choice 1: the vertices are numbered in sequence from 0 or 1, as the first says; another number is an error, since segments refer to
//! them. Segments, triangles, holes and regions are not referred to; their numbers must be whole and are otherwise ignored.
//! Choice 2: a field too many in a row is an error, not ignored: it means that a header misstates the columns.
//! Choice 3: a region whose area is missing or negative has no bound of its own. (Triangle lets a missing one take the attribute's value.)

use super::foreign::{ForeignEdge, ForeignMesh};
use super::rows::{Element, Row, Rows};
use super::{Input, Note, NoteKind, ReadError};
use crate::model::{Point2, Point3, Pslg, Region, Segment, VertexId};

/// Attributes a vertex or triangle may carry at most; a header that asks for more is taken for damaged.
pub(super) const MOST_ATTRIBUTES: i64 = 1000;

/// Vertices as they stand in a `.node` or `.poly` file.
#[derive(Default)]
pub(super) struct Nodes<P> {
    pub(super) points: Vec<P>,
    pub(super) markers: Vec<i32>,
    pub(super) attributes: Vec<f64>,
    pub(super) attributes_per_point: usize,
    pub(super) lines: Vec<u32>,
    /// Line of the header.
    pub(super) header: u32,
    /// Number of the first vertex: 0 or 1. Without vertices nothing tells, nor does it matter.
    pub(super) first: i64,
}

/// A point of the plane or of space, as a row gives it.
pub(super) trait Place: Sized + Default {
    /// How many coordinates it has.
    const DIMENSION: i64;
    /// The fix for a file of another dimension.
    const ONLY: &'static str;
    /// Takes its coordinates from a row.
    fn read(row: &mut Row) -> Result<Self, ReadError>;
}

impl Place for Point2 {
    const DIMENSION: i64 = 2;
    const ONLY: &'static str = "only planar files (dimension 2) are read here";
    fn read(row: &mut Row) -> Result<Point2, ReadError> {
        point(row)
    }
}

impl Place for Point3 {
    const DIMENSION: i64 = 3;
    const ONLY: &'static str = "only files of space (dimension 3) are read here";
    fn read(row: &mut Row) -> Result<Point3, ReadError> {
        Ok(Point3::new(row.float("x")?, row.float("y")?, row.float("z")?))
    }
}

impl<P: Place> Nodes<P> {
    fn read(rows: &mut Rows) -> Result<Nodes<P>, ReadError> {
        let mut head = rows.expect(Element::The("header of the vertices"))?;
        let line = head.line;
        // `1 0 0` and a line end.
        let count = head.count("the number of vertices", 6, rows)?;
        // A planar file may leave it out.
        if head.has_more() || P::DIMENSION != 2 {
            let mut probe = head;
            let dimension = probe.integer("the dimension")?;
            if dimension != P::DIMENSION {
                let fix = if matches!(dimension, 2 | 3) { P::ONLY } else { "it must be 2 or 3" };
                return Err(head.fault(format!("the dimension is {dimension}"), fix));
            }
            head = probe;
        }
        let per_point =
            if head.has_more() { head.ranged("the number of attributes", 0, MOST_ATTRIBUTES)? as usize } else { 0 };
        let marked = head.has_more() && head.ranged("the number of boundary markers", 0, 1)? == 1;
        head.end()?;
        let mut nodes = Nodes { attributes_per_point: per_point, header: line, ..Nodes::default() };
        nodes.points.reserve(count);
        for k in 0..count as i64 {
            let mut row = rows.expect(Element::Nth("vertex", (k + nodes.first) as u64))?;
            nodes.vertex(&mut row, k, marked)?;
            row.end()?;
        }
        Ok(nodes)
    }

    fn vertex(&mut self, row: &mut Row, k: i64, marked: bool) -> Result<(), ReadError> {
        if k == 0 {
            self.first = row.ranged("the number of the first vertex", 0, 1)?;
            // Only now it is known by which number the file calls it.
            row.element = Element::Nth("vertex", self.first as u64);
        } else {
            let due = k + self.first;
            row.ranged("the number of the vertex", due, due)?;
        }
        self.points.push(P::read(row)?);
        for _ in 0..self.attributes_per_point {
            self.attributes.push(row.float("an attribute")?);
        }
        if marked {
            self.markers.push(row.marker()?);
        }
        self.lines.push(row.line);
        Ok(())
    }

    /// The vertex that the next field of a row names.
    pub(super) fn id(&self, row: &mut Row, name: &str) -> Result<VertexId, ReadError> {
        let count = self.points.len() as i64;
        if count == 0 {
            return Err(row.fault(format!("{name} refers to a vertex, but there are none"), ""));
        }
        let n = row.ranged(name, self.first, self.first + count - 1)?;
        // In 0..count, and counts are below 2^31.
        Ok(VertexId((n - self.first) as u32))
    }
}

fn point(row: &mut Row) -> Result<Point2, ReadError> {
    Ok(Point2::new(row.float("x")?, row.float("y")?))
}

/// Whether a `.poly` file leaves its vertices to the `.node` file of the same name. False if the file is too damaged to tell.
pub fn poly_wants_node(poly: &[u8]) -> bool {
    let first = |rows: &mut Rows| rows.next(Element::The("header")).and_then(|mut row| row.integer("count").ok());
    Rows::new(".poly", poly).is_ok_and(|mut rows| first(&mut rows) == Some(0))
}

/// Whether a `.node` file holds points of space, by the dimension of its header. False if the file is too damaged to tell.
pub(super) fn node_is_spatial(node: &[u8]) -> bool {
    let dimension = |rows: &mut Rows| {
        let mut head = rows.next(Element::The("header"))?;
        head.field();
        head.integer("the dimension").ok()
    };
    Rows::new(".node", node).is_ok_and(|mut rows| dimension(&mut rows) == Some(Point3::DIMENSION))
}

/// Reads a `.poly` file, with its `.node` file where its own vertex count is 0.
///
/// Result: `Fill::Seeds`; nothing is merged, dropped or reordered.
/// Errors: the first fault of either file.
pub fn parse_poly(poly: &[u8], node: Option<&[u8]>) -> Result<Input, ReadError> {
    let mut rows = Rows::new(".poly", poly)?;
    let mut nodes = Nodes::read(&mut rows)?;
    if nodes.points.is_empty() {
        let Some(node) = node else {
            return Err(ReadError {
                part: ".poly",
                line: nodes.header,
                element: "header of the vertices".into(),
                problem:
                    "it declares 0 vertices, so they should stand in a .node file of the same name, and there is none"
                        .into(),
                fix: "add that file, or put the vertices here".into(),
                ..ReadError::default()
            });
        };
        nodes = read_node(node)?;
    }
    let mut input = Input::default();
    segments(&mut rows, &nodes, &mut input)?;
    holes(&mut rows, &mut input)?;
    regions(&mut rows, &mut input)?;
    rows.end("section")?;
    input.pslg = Pslg {
        points: nodes.points,
        point_markers: nodes.markers,
        attributes: nodes.attributes,
        attributes_per_point: nodes.attributes_per_point,
        ..input.pslg
    };
    input.lines.points = nodes.lines;
    Ok(input)
}

fn segments(rows: &mut Rows, nodes: &Nodes<Point2>, input: &mut Input) -> Result<(), ReadError> {
    let mut head = rows.expect(Element::The("header of the segments"))?;
    let count = head.count("the number of segments", 6, rows)?;
    let marked = head.has_more() && head.ranged("the number of boundary markers", 0, 1)? == 1;
    head.end()?;
    input.pslg.segments.reserve(count);
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("segment", k + 1))?;
        row.integer("the number of the segment")?;
        let ends = [nodes.id(&mut row, "the first end")?, nodes.id(&mut row, "the second end")?];
        let marker = if marked { row.marker()? } else { 0 };
        input.pslg.segments.push(Segment { ends, marker, toggles: false });
        input.lines.segments.push(row.line);
        row.end()?;
    }
    Ok(())
}

fn holes(rows: &mut Rows, input: &mut Input) -> Result<(), ReadError> {
    let mut head = rows.expect(Element::The("header of the holes"))?;
    let count = head.count("the number of holes", 6, rows)?;
    head.end()?;
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("hole", k + 1))?;
        row.integer("the number of the hole")?;
        input.pslg.holes.push(point(&mut row)?);
        input.lines.holes.push(row.line);
        row.end()?;
    }
    Ok(())
}

fn regions(rows: &mut Rows, input: &mut Input) -> Result<(), ReadError> {
    let Some(mut head) = rows.next(Element::The("header of the regions")) else {
        return Ok(());
    };
    let count = head.count("the number of regions", 8, rows)?;
    head.end()?;
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("region", k + 1))?;
        row.integer("the number of the region")?;
        let seed = point(&mut row)?;
        let attribute = row.float("the attribute")?;
        let area = if row.has_more() { Some(row.float("the largest area")?) } else { None };
        if area.is_none() {
            input.notes.push(Note {
                kind: NoteKind::Note,
                line: row.line,
                text: format!(
                    "region {} bounds no area; Triangle would take its attribute {attribute} for the bound too",
                    k + 1
                ),
            });
        }
        if area == Some(0.0) {
            return Err(row.fault("the largest area is 0", "give a positive area, or a negative one for none"));
        }
        input.pslg.regions.push(Region { seed, attribute, max_area: area.filter(|a| a.is_sign_positive()) });
        input.lines.regions.push(row.line);
        row.end()?;
    }
    Ok(())
}

/// Reads a `.node` file; its dimension must be that of the points.
pub(super) fn read_node<P: Place>(node: &[u8]) -> Result<Nodes<P>, ReadError> {
    let mut rows = Rows::new(".node", node)?;
    let nodes = Nodes::read(&mut rows)?;
    rows.end("vertex")?;
    Ok(nodes)
}

/// Reads a `.node` file as a set of points.
///
/// Errors: its first fault.
pub fn parse_node(node: &[u8]) -> Result<Input, ReadError> {
    let nodes = read_node::<Point2>(node)?;
    let mut input = Input::default();
    input.pslg.points = nodes.points;
    input.pslg.point_markers = nodes.markers;
    input.pslg.attributes = nodes.attributes;
    input.pslg.attributes_per_point = nodes.attributes_per_point;
    input.lines.points = nodes.lines;
    Ok(input)
}

/// The files of one mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct TriangleFiles<'a> {
    /// The vertices.
    pub node: &'a [u8],
    /// The triangles.
    pub ele: &'a [u8],
    /// The subsegments; counts only where it declares 0 vertices, since it is the input of a mesher otherwise.
    pub poly: Option<&'a [u8]>,
    /// All edges; where there are no subsegments, those with a marker other than 0 are taken for constrained.
    pub edge: Option<&'a [u8]>,
}

/// Reads a mesh of Triangle.
///
/// Errors: the first fault of any of the files.
pub fn parse_node_ele(files: TriangleFiles) -> Result<ForeignMesh, ReadError> {
    let mut nodes = read_node(files.node)?;
    let mut mesh = ForeignMesh::default();
    triangles(files.ele, &nodes, &mut mesh)?;
    match (files.poly.filter(|poly| poly_wants_node(poly)), files.edge) {
        (Some(poly), _) => subsegments(poly, &nodes, &mut mesh)?,
        (None, Some(edge)) => edges(edge, &nodes, &mut mesh)?,
        (None, None) => {}
    }
    mesh.points = std::mem::take(&mut nodes.points);
    mesh.point_markers = nodes.markers;
    mesh.attributes = nodes.attributes;
    mesh.attributes_per_point = nodes.attributes_per_point;
    mesh.lines.points = nodes.lines;
    Ok(mesh)
}

fn triangles(ele: &[u8], nodes: &Nodes<Point2>, mesh: &mut ForeignMesh) -> Result<(), ReadError> {
    let mut rows = Rows::new(".ele", ele)?;
    let mut head = rows.expect(Element::The("header of the triangles"))?;
    // `1 1 2 3` and a line end.
    let count = head.count("the number of triangles", 8, &rows)?;
    if head.has_more() && head.ranged("the number of corners", 3, 6)? != 3 {
        return Err(head.fault("the triangles have more than 3 nodes", "write the mesh with linear elements"));
    }
    let per_triangle = if head.has_more() { head.ranged("the number of attributes", 0, MOST_ATTRIBUTES)? } else { 0 };
    if per_triangle > 1 {
        mesh.notes.push(Note {
            kind: NoteKind::Note,
            line: head.line,
            text: format!("of {per_triangle} attributes a triangle only the first is kept"),
        });
    }
    head.end()?;
    mesh.triangles.reserve(count);
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("triangle", k + 1))?;
        row.integer("the number of the triangle")?;
        let name = "a corner";
        mesh.triangles.push([nodes.id(&mut row, name)?, nodes.id(&mut row, name)?, nodes.id(&mut row, name)?]);
        for i in 0..per_triangle {
            let attribute = row.float("an attribute")?;
            if i == 0 {
                mesh.triangle_attributes.push(attribute);
            }
        }
        mesh.lines.triangles.push(row.line);
        row.end()?;
    }
    rows.end("triangle")
}

/// The segments of the `.poly` file that accompanies a mesh; its holes and regions are read for their faults only.
fn subsegments(poly: &[u8], nodes: &Nodes<Point2>, mesh: &mut ForeignMesh) -> Result<(), ReadError> {
    let mut rows = Rows::new(".poly", poly)?;
    Nodes::<Point2>::read(&mut rows)?;
    let mut input = Input::default();
    segments(&mut rows, nodes, &mut input)?;
    holes(&mut rows, &mut input)?;
    regions(&mut rows, &mut input)?;
    rows.end("section")?;
    mesh.edges = input.pslg.segments.iter().map(|s| ForeignEdge { ends: s.ends, marker: s.marker }).collect();
    mesh.lines.edges = input.lines.segments;
    Ok(())
}

fn edges(edge: &[u8], nodes: &Nodes<Point2>, mesh: &mut ForeignMesh) -> Result<(), ReadError> {
    let mut rows = Rows::new(".edge", edge)?;
    let mut head = rows.expect(Element::The("header of the edges"))?;
    let count = head.count("the number of edges", 6, &rows)?;
    let marked = head.has_more() && head.ranged("the number of boundary markers", 0, 1)? == 1;
    head.end()?;
    for k in 0..count as u64 {
        let mut row = rows.expect(Element::Nth("edge", k + 1))?;
        row.integer("the number of the edge")?;
        let ends = [nodes.id(&mut row, "the first end")?, nodes.id(&mut row, "the second end")?];
        let marker = if marked { row.marker()? } else { 0 };
        if marker != 0 {
            mesh.edges.push(ForeignEdge { ends, marker });
            mesh.lines.edges.push(row.line);
        }
        row.end()?;
    }
    rows.end("edge")
}
