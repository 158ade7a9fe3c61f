//! Unstructured grids as VTK's files store them: what `.vtu` and `.vtk` have in common.
//!
//! A grid is points, cells (runs of `connectivity` that end at `offsets`, with a number for the type of each) and arrays of both. Corners come
//! before the nodes between them in every type of second order.

use super::number::decimal;
use super::points::Weights;
use super::scalar::index;
use super::{Column, ColumnName, ForeignEdge, ForeignMesh3, ForeignTriangle, ReadError, error::shown};
use crate::model::words::counted;
use crate::model::{Point3, VertexId};

/// A number of an array with its line, 0 in binary arrays.
pub(super) type Value = (f64, u32);

/// Arrays that stand in for markers and regions, as other programs name them.
pub(super) const STAND_INS: [&str; 2] = ["gmsh:physical", "CellEntityIds"];

/// More corners than a cell that is read here has.
const MOST_CORNERS: usize = 10;

/// The cells of a grid.
pub(super) struct Cells {
    pub(super) connectivity: Vec<Value>,
    /// Where each cell ends.
    pub(super) offsets: Vec<Value>,
    pub(super) types: Vec<Value>,
}

/// One cell.
pub(super) struct Cell<'a> {
    pub(super) number: usize,
    pub(super) kind: i64,
    /// At most one more than a cell that is read here has.
    pub(super) nodes: &'a [VertexId],
    pub(super) line: u32,
}

impl Cells {
    /// Whether a cell is a tetrahedron, of first or second order.
    pub(super) fn have_tetrahedra(&self) -> bool {
        self.types.iter().any(|&(kind, _)| matches!(kind as i64, 10 | 24))
    }

    /// Hands every cell on in order.
    ///
    /// Errors: offsets that do not ascend, vertices that do not exist, and a cell that `take` does not want, with the sentence that says what it wants.
    pub(super) fn each(
        &self,
        part: &'static str,
        points: usize,
        wanted: &str,
        mut take: impl FnMut(Cell) -> bool,
    ) -> Result<(), ReadError> {
        let mut from = 0;
        let mut nodes = Vec::with_capacity(MOST_CORNERS + 1);
        for (number, (&(offset, _), &(kind, _))) in self.offsets.iter().zip(&self.types).enumerate() {
            let line = self.connectivity.get(from).map_or(0, |&(_, line)| line);
            let bad = |problem: String, fix: &str| {
                let element = format!("cell {number}");
                ReadError { part, line, element, problem, fix: fix.into(), ..ReadError::default() }
            };
            let end = index(offset, self.connectivity.len() + 1).filter(|&end| end >= from);
            let Some(end) = end else {
                let fix = "offsets ascend up to the length of connectivity";
                return Err(bad(format!("its offset is {}", decimal(offset)), fix));
            };
            nodes.clear();
            for &(x, line) in self.connectivity[from..end].iter().take(MOST_CORNERS + 1) {
                let id = index(x, points);
                let id = id.ok_or_else(|| ReadError {
                    line,
                    ..bad(format!("there is no vertex {}", decimal(x)), "vertices are numbered from 0")
                })?;
                // Counts are below 2^31.
                nodes.push(VertexId(id as u32));
            }
            let kind = kind as i64;
            if !take(Cell { number, kind, nodes: &nodes, line }) {
                let problem = match (kind, end - from) {
                    (7, _) => "it is a polygon".into(),
                    (8, 4) => "it is a pixel".into(),
                    (9, 4) => "it is a quadrilateral".into(),
                    (11, 8) => "it is a voxel".into(),
                    (12, 8) => "it is a hexahedron".into(),
                    (13, 6) => "it is a wedge".into(),
                    (14, 5) => "it is a pyramid".into(),
                    (kind, corners) => format!("its type is {kind} and it has {}", counted(corners, "corner")),
                };
                return Err(bad(problem, wanted));
            }
            from = end;
        }
        Ok(())
    }
}

/// The arrays of a grid that mean something here: one number a point or a cell.
#[derive(Default)]
pub(super) struct Arrays {
    pub(super) point_markers: Option<Vec<Value>>,
    pub(super) weights: Option<Vec<Value>>,
    pub(super) cell_markers: Option<Vec<Value>>,
    pub(super) regions: Option<Vec<Value>>,
}

/// The name of the array of weights: that asked for, else `weight`.
///
/// Errors: a number, since arrays have names.
pub(super) fn weight_array<'a>(part: &'static str, column: Option<&'a Column>) -> Result<&'a str, ReadError> {
    match column.map(Column::name) {
        None => Ok("weight"),
        Some(ColumnName::Name(name)) => Ok(name),
        Some(ColumnName::Number(n)) => Err(ReadError {
            part,
            problem: format!("there is no column {n}"),
            fix: "arrays of points have names here; give the name".into(),
            ..ReadError::default()
        }),
    }
}

/// Takes the weights of a mesh from an array; without an array that was asked for there is an error.
pub(super) fn take_weights(
    part: &'static str,
    array: Option<Vec<Value>>,
    column: Option<&Column>,
    mesh: &mut ForeignMesh3,
) -> Result<(), ReadError> {
    let Some(array) = array else {
        let Some(column) = column else { return Ok(()) };
        let name = shown(weight_array(part, Some(column))?);
        let problem = format!("no array of the points is named `{name}`");
        return Err(ReadError { part, problem, fix: "give the name of an array".into(), ..ReadError::default() });
    };
    let default = Column::Weight(ColumnName::Name(String::new()));
    let mut weights = Weights::new(column.unwrap_or(&default));
    for (k, &(x, line)) in array.iter().enumerate() {
        let element = || format!("vertex {k}");
        weights.push(x, line).map_err(|problem| ReadError {
            part,
            line,
            element: element(),
            problem,
            ..ReadError::default()
        })?;
    }
    mesh.notes.extend(weights.note());
    mesh.weights = weights.values;
    Ok(())
}

/// A grid as a mesh of space. `points` has three numbers a point.
///
/// Errors: cells other than vertices, lines, triangles and tetrahedra.
pub(super) fn mesh_of_space(
    part: &'static str,
    points: &[Value],
    cells: &Cells,
    arrays: Arrays,
    column: Option<&Column>,
) -> Result<ForeignMesh3, ReadError> {
    let mut mesh = ForeignMesh3::default();
    for p in points.chunks_exact(3) {
        mesh.points.push(Point3::new(p[0].0, p[1].0, p[2].0));
        mesh.lines.points.push(p[0].1);
    }
    // The casts saturate; markers have 32 bits.
    let integer = |&(x, _): &Value| x as i32;
    mesh.point_markers = arrays.point_markers.iter().flatten().map(integer).collect();
    take_weights(part, arrays.weights, column, &mut mesh)?;
    let wanted = "only vertices (1), lines (3), triangles (5) and tetrahedra (10) are read here, and lines (21), triangles (22) and tetrahedra (24) of second order";
    let marker = |cell: usize| arrays.cell_markers.as_ref().map_or(0, |all| integer(&all[cell]));
    let mut middle = Vec::new();
    cells.each(part, mesh.points.len(), wanted, |cell| {
        match (cell.kind, cell.nodes) {
            (10, &[a, b, c, d]) | (24, &[a, b, c, d, _, _, _, _, _, _]) => {
                mesh.tetrahedra.push([a, b, c, d]);
                mesh.lines.tetrahedra.push(cell.line);
                mesh.tetrahedron_attributes.extend(arrays.regions.as_ref().map(|all| all[cell.number].0));
                middle.extend_from_slice(&cell.nodes[4..]);
            }
            (5, &[a, b, c]) | (22, &[a, b, c, _, _, _]) => {
                mesh.triangles.push(ForeignTriangle { corners: [a, b, c], marker: marker(cell.number) });
                mesh.lines.triangles.push(cell.line);
                middle.extend_from_slice(&cell.nodes[3..]);
            }
            (3, &[a, b]) | (21, &[a, b, _]) => {
                mesh.edges.push(ForeignEdge { ends: [a, b], marker: marker(cell.number) });
                mesh.lines.edges.push(cell.line);
                middle.extend_from_slice(&cell.nodes[2..]);
            }
            (1, [_]) => {}
            _ => return false,
        }
        true
    })?;
    mesh.drop_middle_nodes(&middle);
    Ok(mesh)
}
