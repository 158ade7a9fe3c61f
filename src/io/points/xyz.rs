//! Reads `.xyz`: a point a row, `x y z` and perhaps further columns, with white space between; `#` starts a comment.
//!
//! There is no header. A first row of a single field is the number of points, as some programs write it. Every row has as many columns
//! as that of the first point; those after the coordinates are normals or colours mostly.

use super::{Builder, Column, Input3, others};
use crate::io::ReadError;
use crate::io::rows::{Element, Row, Rows};

/// Reads an `.xyz` file as points of space.
///
/// Errors: the first fault; a file without a point is one, unless it starts with the number 0.
pub fn parse_xyz(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    let mut rows = Rows::new(".xyz", bytes)?;
    let mut first = rows.expect(Element::Nth("point", 0))?;
    let mut declared = None;
    if first.fields() == 1 {
        // `0 0 0` with a line end.
        declared = Some(first.count("the number of points", 6, &rows)?);
        if declared == Some(0) {
            rows.end("point")?;
            return Ok(Input3::default());
        }
        first = rows.expect(Element::Nth("point", 0))?;
    }
    let fields = first.fields();
    let at_line = |e: ReadError| ReadError { line: first.line, ..e };
    let wanted = column.map(|c| c.find(".xyz", fields, &[""; 0], &[0, 1, 2]).map_err(at_line)).transpose()?;
    let mut set = Builder::new(column, declared.unwrap_or(0));
    set.leaves_out(first.line, &others(fields, &[0, 1, 2], wanted), &[""; 0]);
    let what = column.map_or("", Column::what);
    point(&mut set, first, fields, wanted, what)?;
    loop {
        let element = Element::Nth("point", set.len() as u64);
        let row = match declared {
            Some(n) if set.len() == n => {
                rows.end("point")?;
                break;
            }
            Some(_) => rows.expect(element)?,
            None => match rows.next(element) {
                Some(row) => row,
                None => break,
            },
        };
        point(&mut set, row, fields, wanted, what)?;
    }
    Ok(set.finish())
}

fn point(set: &mut Builder, mut row: Row, fields: usize, wanted: Option<usize>, what: &str) -> Result<(), ReadError> {
    let at = [row.float("x")?, row.float("y")?, row.float("z")?];
    let mut number = None;
    let mut seen = 3;
    while row.has_more() {
        if Some(seen) == wanted {
            number = Some(row.float(what)?);
        } else {
            row.field();
        }
        seen += 1;
    }
    if seen != fields {
        return Err(row.fault(
            format!("it has {seen} columns, but the first point has {fields}"),
            "give every point the same columns",
        ));
    }
    set.push_row(at, number, &row)
}
