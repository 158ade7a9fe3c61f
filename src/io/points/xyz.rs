//! Reads `.xyz`: a point a row, `x y z` and perhaps further columns, with white space between; `#` starts a comment.
//!
//! There is no header. A first row of a single field is the number of points, as some programs write it. Every row has as many columns
//! as that of the first point; those after the coordinates are normals or colours mostly.
//!
//! The files of chemistry have the same name: the number of atoms, a line of comment (perhaps empty), then `symbol x y z` a row. Choice: the first row of a
//! point tells the two apart, by whether a word stands before three numbers; what stands between the number and the first such row is a comment of one line.

use super::{Builder, Column, Input3, others};
use crate::io::rows::{Element, Row, Rows};
use crate::io::{Note, NoteKind, ReadError};

/// Reads an `.xyz` file as points of space.
///
/// Errors: the first fault; a file without a point is one, unless it starts with the number 0.
pub fn parse_xyz(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    let mut rows = Rows::new(".xyz", bytes)?;
    let mut first = rows.expect(Element::Nth("point", 0))?;
    let mut declared = None;
    let mut comment = None;
    if first.fields() == 1 {
        if first.remainder().contains([',', ';']) {
            return Err(first.fault("columns are separated by commas or semicolons", "name the file .csv"));
        }
        // `0 0 0` with a line end.
        declared = Some(first.count("the number of points", 6, &rows)?);
        if declared == Some(0) {
            rows.end("point")?;
            return Ok(Input3::default());
        }
        first = rows.expect(Element::Nth("point", 0))?;
        if Shape::of(first).is_none() {
            comment = Some(first.line);
            first = rows.expect(Element::Nth("point", 0))?;
        }
    }
    let fields = first.fields();
    // What is no point is taken for a plain one, whose reader tells the fault.
    let shape = Shape::of(first).unwrap_or(Shape::Plain);
    if comment.is_some() && shape == Shape::Plain && fields > 3 {
        let problem =
            "after a line of comment it has numbers only, of which the first may stand for an element or be x";
        return Err(first.fault(problem, "write symbols of elements, or remove the comment"));
    }
    let places = if shape == Shape::Symbol { [1, 2, 3] } else { [0, 1, 2] };
    let at_line = |e: ReadError| ReadError { line: first.line, ..e };
    let wanted = column.map(|c| c.find(".xyz", fields, &[""; 0], &places).map_err(at_line)).transpose()?;
    let mut set = Builder::new(column, declared.unwrap_or(0));
    if let Some(line) = comment {
        set.notes.push(Note { kind: NoteKind::Note, line, text: "a line of comment is left out".into() });
    }
    set.leaves_out(first.line, &others(fields, &places, wanted), &[""; 0]);
    let layout = Layout { fields, shape, wanted, what: column.map_or("", Column::what) };
    layout.point(&mut set, first)?;
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
        layout.point(&mut set, row)?;
    }
    Ok(set.finish())
}

/// What stands before the coordinates of a point.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    Plain,
    /// The symbol of an element, or another word.
    Symbol,
}

impl Shape {
    /// Nothing if it is no row of a point.
    fn of(mut row: Row) -> Option<Shape> {
        // `nan` is a number here, so that it is refused and not taken for a word.
        let is_number = |field: &str| field.parse::<f64>().is_ok();
        let named = row.remainder().starts_with(|c: char| c.is_ascii_alphabetic());
        let mut next = || row.field().map(is_number);
        match [next(), next(), next(), next()] {
            [Some(true), Some(true), Some(true), _] => Some(Shape::Plain),
            [Some(false), Some(true), Some(true), Some(true)] if named => Some(Shape::Symbol),
            _ => None,
        }
    }
}

/// What the columns of all rows are.
struct Layout {
    fields: usize,
    shape: Shape,
    wanted: Option<usize>,
    /// What the wanted one is, for messages.
    what: &'static str,
}

impl Layout {
    fn point(&self, set: &mut Builder, mut row: Row) -> Result<(), ReadError> {
        let mut number = None;
        let mut seen = 3;
        if self.shape == Shape::Symbol {
            let symbol = row.word("the symbol")?;
            if Some(0) == self.wanted {
                number = Some(row.number(symbol, self.what)?);
            }
            seen += 1;
        }
        let at = [row.float("x")?, row.float("y")?, row.float("z")?];
        while row.has_more() {
            if Some(seen) == self.wanted {
                number = Some(row.float(self.what)?);
            } else {
                row.field();
            }
            seen += 1;
        }
        if seen != self.fields {
            return Err(row.fault(
                format!("it has {seen} columns, but the first point has {}", self.fields),
                "give every point the same columns",
            ));
        }
        set.push_row(at, number, &row)
    }
}
