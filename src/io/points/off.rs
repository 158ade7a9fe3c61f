//! Reads the vertices of an `.off` file as points of space. Its faces are read for their faults and left out, and so are the colours, normals and
//! texture coordinates of vertices, which the first word of the file announces (`COFF`, `NOFF`, `STOFF`).

use super::{Builder, Column, Input3, others};
use crate::io::off::{Header, header};
use crate::io::rows::{Element, Rows};
use crate::io::{Note, NoteKind, ReadError};

/// Reads an `.off` file as points of space.
///
/// Errors: the first fault; a column, since the format has none.
pub fn parse_off3(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    let mut rows = Rows::new(".off", bytes)?;
    let words = ["OFF", "COFF", "NOFF", "CNOFF", "STOFF"];
    let fix = "it must start with the word OFF, or COFF, NOFF, CNOFF, STOFF";
    let Header { word, points, faces, line } = header(&mut rows, &words, fix)?;
    if let Some(column) = column {
        column.find(".off", 3, &[""; 0], &[0, 1, 2]).map_err(|e| ReadError { line, ..e })?;
    }
    let mut set = Builder::new(None, points);
    for k in 0..points as u64 {
        let mut row = rows.expect(Element::Nth("vertex", k))?;
        let at = [row.float("x")?, row.float("y")?, row.float("z")?];
        set.push_row(at, None, &row)?;
        if word == "OFF" {
            row.end()?;
        } else if k == 0 {
            set.leaves_out(row.line, &others(3 + row.fields(), &[0, 1, 2], None), &[""; 0]);
        }
    }
    for k in 0..faces as u64 {
        let mut row = rows.expect(Element::Nth("face", k))?;
        for _ in 0..row.ranged("the number of corners", 0, i64::MAX)? {
            row.ranged("a corner", 0, points as i64 - 1)?;
        }
    }
    rows.end("face")?;
    if faces > 0 {
        set.notes.push(Note { kind: NoteKind::Note, line, text: format!("{faces} faces are left out") });
    }
    Ok(set.finish())
}
