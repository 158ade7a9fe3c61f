//! Readers of points of space.
//!
//! Problem: a point is three numbers in nearly every format, and what stands beside them differs: normals, colours, attributes, weights,
//! radii. Idea: nothing beside the coordinates is taken unless it is asked for by a `Column`; what is left out is noted.
//! A column is called by its name where the format has names, else by its number in the row, counted from 1 over all fields of the row:
//! in `.xyz` and `.npy` the first column after the coordinates is 4, in `.node` it is 5, since a row starts with the number of the vertex.

mod csv;
mod node;
mod npy;
mod off;
mod ply;
mod xyz;

pub use csv::parse_csv;
pub use node::parse_node3;
pub(super) use node::read_node3;
pub use npy::parse_npy;
pub use off::parse_off3;
pub use ply::parse_ply;
pub use xyz::parse_xyz;

use super::rows::{MOST_ELEMENTS, Row, clipped};
use super::{Note, NoteKind, ReadError, error::shown};
use crate::model::words::listed;
use crate::model::{Point3, PointSet3};

/// Points of space as a file states them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input3 {
    /// The points, in the order of the file; nothing is merged or dropped.
    pub set: PointSet3,
    /// What the reader did or left out, for the user to know.
    pub notes: Vec<Note>,
}

/// Which further column of a file gives the weights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// The column holds weights: squared radii, units squared, of any sign.
    Weight(ColumnName),
    /// The column holds radii, which may not be negative. The weight is the double nearest to the square; the reader notes where that is not the square itself.
    Radius(ColumnName),
}

/// A column by number or name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ColumnName {
    /// The number in the row of the file, counted from 1.
    Number(usize),
    /// The name in the file's header.
    Name(String),
}

impl From<&str> for ColumnName {
    /// Digits are a number, everything else a name.
    fn from(text: &str) -> ColumnName {
        let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        match text.parse() {
            Ok(number) if digits => ColumnName::Number(number),
            _ => ColumnName::Name(text.into()),
        }
    }
}

impl Column {
    /// The name or number of the column.
    pub fn name(&self) -> &ColumnName {
        match self {
            Column::Weight(name) | Column::Radius(name) => name,
        }
    }

    /// What its numbers are, for messages.
    pub(super) fn what(&self) -> &'static str {
        match self {
            Column::Weight(_) => "the weight",
            Column::Radius(_) => "the radius",
        }
    }

    /// The same of all.
    fn all(&self) -> &'static str {
        match self {
            Column::Weight(_) => "weights",
            Column::Radius(_) => "radii",
        }
    }

    /// The index of the column in rows of so many fields of which some hold coordinates (or numbers of points); errors have no line.
    ///
    /// `names` is empty in formats without names.
    fn find(
        &self,
        part: &'static str,
        fields: usize,
        names: &[impl AsRef<str>],
        taken: &[usize],
    ) -> Result<usize, ReadError> {
        let wrong = |problem: String, fix: String| {
            Err(ReadError { part, element: "columns".into(), problem, fix, ..ReadError::default() })
        };
        let index = match self.name() {
            ColumnName::Number(n) if (1..=fields).contains(n) => n - 1,
            ColumnName::Number(n) => {
                return wrong(
                    format!("column {n} is to hold {}, but there are {fields}", self.all()),
                    "columns are counted from 1, those of the coordinates included".into(),
                );
            }
            ColumnName::Name(name) if names.is_empty() => {
                return wrong(
                    format!("column `{}` is to hold {}, but columns have no names here", shown(name), self.all()),
                    "give the number of the column, counted from 1".into(),
                );
            }
            ColumnName::Name(name) => {
                let mut found = (0..names.len()).filter(|&i| names[i].as_ref() == name);
                match (found.next(), found.next()) {
                    (Some(i), None) => i,
                    (Some(_), Some(_)) => {
                        return wrong(
                            format!("two columns are named `{}`", shown(name)),
                            "give the number of the column, counted from 1".into(),
                        );
                    }
                    _ => {
                        let all: Vec<&str> = names.iter().map(AsRef::as_ref).take(20).collect();
                        return wrong(
                            format!("no column is named `{}`", shown(name)),
                            format!("the columns are {}", shown_list(&all)),
                        );
                    }
                }
            }
        };
        if taken.contains(&index) {
            return wrong(
                format!("column {} is to hold {}, but it holds a coordinate or a number", index + 1, self.all()),
                "name another column".into(),
            );
        }
        Ok(index)
    }
}

fn shown_list(names: &[&str]) -> String {
    names.iter().map(|name| shown(name)).collect::<Vec<_>>().join(", ")
}

/// Weights from the numbers of a column.
#[derive(Debug)]
pub(super) struct Weights {
    radii: bool,
    pub(super) values: Vec<f64>,
    /// How many squares of radii were rounded, and the line of the first.
    rounded: (usize, u32),
}

impl Weights {
    pub(super) fn new(column: &Column) -> Weights {
        Weights { radii: matches!(column, Column::Radius(_)), values: Vec::new(), rounded: (0, 0) }
    }

    /// Takes the number of one more point; the error is a phrase.
    pub(super) fn push(&mut self, x: f64, line: u32) -> Result<(), String> {
        if !self.radii {
            self.values.push(x);
            return Ok(());
        }
        if x < 0.0 {
            return Err(format!("the radius is {x:?}, which is negative"));
        }
        let weight = x * x;
        if !weight.is_finite() {
            return Err(format!("the radius is {x:?}, the square of which is out of range"));
        }
        if !square_is_exact(x) {
            self.rounded.0 += 1;
            if self.rounded.0 == 1 {
                self.rounded.1 = line;
            }
        }
        self.values.push(weight);
        Ok(())
    }

    /// A note if a square was rounded.
    pub(super) fn note(&self) -> Option<Note> {
        let (count, line) = self.rounded;
        (count > 0).then(|| Note {
            kind: NoteKind::Note,
            line,
            text: match count {
                1 => "1 radius has a square that is no double; its weight is the nearest one".into(),
                _ => format!("{count} radii have squares that are no doubles; their weights are the nearest ones"),
            },
        })
    }
}

/// Whether the square of a finite number is a double: with r = m 2^e, m odd, if m^2 < 2^53 and the last bit, 2^(2e), is at least 2^-1074.
/// (The caller has ruled out overflow.)
fn square_is_exact(r: f64) -> bool {
    let bits = r.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
    if mantissa == 0 {
        return true;
    }
    let zeros = mantissa.trailing_zeros();
    // At most 52, so that the cast keeps it.
    let exponent = field.max(1) - 1075 + zeros as i32;
    let odd = u128::from(mantissa >> zeros);
    odd * odd < 1 << 53 && 2 * exponent >= -1074
}

/// A set of points as it grows.
pub(super) struct Builder {
    set: PointSet3,
    weights: Option<Weights>,
    pub(super) notes: Vec<Note>,
}

impl Builder {
    pub(super) fn new(column: Option<&Column>, points: usize) -> Builder {
        let mut builder = Builder { set: PointSet3::default(), weights: column.map(Weights::new), notes: Vec::new() };
        builder.set.points.reserve(points);
        builder.set.lines.reserve(points);
        builder
    }

    /// Takes one more point, with the number of the column if one was asked for; the error is a phrase.
    pub(super) fn push(&mut self, at: [f64; 3], number: Option<f64>, line: u32) -> Result<(), String> {
        if self.set.points.len() as u64 >= MOST_ELEMENTS {
            return Err(format!("there are more than {MOST_ELEMENTS} points"));
        }
        if let (Some(weights), Some(x)) = (&mut self.weights, number) {
            weights.push(x, line)?;
        }
        self.set.points.push(Point3::from_array(at));
        self.set.lines.push(line);
        Ok(())
    }

    /// The same with the row that an error is about.
    fn push_row(&mut self, at: [f64; 3], number: Option<f64>, row: &Row) -> Result<(), ReadError> {
        self.push(at, number, row.line).map_err(|problem| row.fault(problem, ""))
    }

    pub(super) fn len(&self) -> usize {
        self.set.points.len()
    }

    /// Notes that some columns have no meaning here: by name, or by index if there are no names.
    fn leaves_out(&mut self, line: u32, columns: &[usize], names: &[impl AsRef<str>]) {
        let (Some(first), Some(last)) = (columns.first(), columns.last()) else {
            return;
        };
        let which = if names.is_empty() {
            let numbers: Vec<u32> = columns.iter().map(|&i| clipped(i + 1)).collect();
            if first == last {
                format!("column {} is", first + 1)
            } else if last - first + 1 == columns.len() {
                format!("columns {} to {} are", first + 1, last + 1)
            } else {
                format!("{} are", listed("column", &numbers, 20))
            }
        } else {
            let all: Vec<&str> = columns.iter().map(|&i| names[i].as_ref()).take(20).collect();
            format!(
                "{} {}{} {}",
                if first == last { "column" } else { "columns" },
                shown_list(&all),
                if columns.len() > 20 { ", ..." } else { "" },
                if first == last { "is" } else { "are" }
            )
        };
        self.notes.push(Note { kind: NoteKind::Note, line, text: format!("{which} left out") });
    }

    fn finish(mut self) -> Input3 {
        if let Some(weights) = self.weights {
            self.notes.extend(weights.note());
            self.set.weights = weights.values;
        }
        Input3 { set: self.set, notes: self.notes }
    }
}

/// The fields of rows that hold neither coordinates nor what was asked for.
fn others(fields: usize, taken: &[usize], wanted: Option<usize>) -> Vec<usize> {
    (0..fields).filter(|i| !taken.contains(i) && Some(*i) != wanted).collect()
}
