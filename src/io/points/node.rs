//! Reads points of space from `.node` files (TetGen's manual, section on its file formats): `points 3 attributes markers(0|1)`, then
//! `index x y z attributes... [marker]`, counted from 0 or 1.

use super::{Column, Input3, Weights, others};
use crate::io::rows::clipped;
use crate::io::triangle::{Nodes, read_node};
use crate::io::{Note, NoteKind, ReadError};
use crate::model::words::listed;
use crate::model::{Point3, PointSet3};

/// Reads a `.node` file of dimension 3 as points of space.
///
/// A column counts the fields of a row: the first attribute is column 5. Errors: the first fault.
pub fn parse_node3(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    let mut notes = Vec::new();
    let (nodes, weights) = read_node3(bytes, column, &mut notes)?;
    let set = PointSet3 { points: nodes.points, weights, point_markers: nodes.markers, lines: nodes.lines };
    Ok(Input3 { set, notes })
}

/// The vertices of a `.node` file of dimension 3 and their weights; what is left out or rounded is noted.
pub(in crate::io) fn read_node3(
    bytes: &[u8],
    column: Option<&Column>,
    notes: &mut Vec<Note>,
) -> Result<(Nodes<Point3>, Vec<f64>), ReadError> {
    let nodes = read_node::<Point3>(bytes)?;
    let per = nodes.attributes_per_point;
    let taken = [0, 1, 2, 3];
    let at_line = |e: ReadError| ReadError { line: nodes.header, ..e };
    let wanted = column.map(|c| c.find(".node", per + 4, &[""; 0], &taken).map_err(at_line)).transpose()?;
    let left = others(per + 4, &taken, wanted);
    if !left.is_empty() {
        let hint = if column.is_none() { " (--weights and --radii take a column)" } else { "" };
        let columns: Vec<u32> = left.iter().map(|&i| clipped(i + 1)).collect();
        let (text, are) =
            (listed("column", &columns, 8), if left.len() == 1 { "an attribute, is" } else { "attributes, are" });
        let text = format!("{text}, {are} left out{hint}");
        notes.push(Note { kind: NoteKind::Note, line: nodes.header, text });
    }
    let (Some(column), Some(wanted)) = (column, wanted) else {
        return Ok((nodes, Vec::new()));
    };
    let mut weights = Weights::new(column);
    let numbers = nodes.attributes.iter().skip(wanted - 4).step_by(per);
    for (k, (&x, &line)) in numbers.zip(&nodes.lines).enumerate() {
        weights.push(x, line).map_err(|problem| ReadError {
            part: ".node",
            line,
            element: format!("vertex {}", k as i64 + nodes.first),
            problem,
            ..ReadError::default()
        })?;
    }
    notes.extend(weights.note());
    Ok((nodes, weights.values))
}
