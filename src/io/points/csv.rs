//! Reads `.csv`: a point a line, with commas, semicolons or tabs between the fields, with or without a header.
//!
//! The separator is the first of tab, semicolon and comma that the first line has outside quotes. That line is a header if none of its fields is a
//! number (`nan` and `inf` count as numbers here, so that they are refused and not taken for names). A header names the coordinates `x`, `y`, `z` in
//! either case, or `Points:0`, `Points:1`, `Points:2` as ParaView does; without one they are the first three columns. Every line has as many fields as the first.
//! Quotes around a field are dropped (RFC 4180); a quoted field ends on its line. Empty lines and lines that start with `#` are skipped.

use super::{Builder, Column, Input3, others};
use crate::io::rows::{Element, Row, Rows, clipped};
use crate::io::{ReadError, error::shown, number};
use std::borrow::Cow;

/// What has to be done about a row of too few or too many fields.
const SAME: &str = "give every line the same columns";

/// Reads a `.csv` file as points of space.
///
/// Errors: the first fault; a file without points and without header is one.
pub fn parse_csv(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    let mut rows = Rows::new(".csv", bytes)?.without_comments();
    let first = next(&mut rows, 0).ok_or_else(|| {
        rows.fault(Element::Nth("point", 0), "the file ends before it", "the file is empty or holds comments only")
    })?;
    let separator = separator(&first)?;
    let mut fields = Vec::new();
    split(&first, separator, &mut fields)?;
    let header = fields.iter().all(|f| f.text.parse::<f64>().is_err());
    let names: Vec<Cow<str>> = if header { fields.iter().map(|f| f.text.clone()).collect() } else { Vec::new() };
    let count = fields.len();
    let places = if header { coordinates(&first, &names)? } else { [0, 1, 2] };
    if count < 3 {
        let problem = format!("it has {count} columns, which is not enough for x, y, z");
        return Err(first.fault(problem, "put the numbers of a point on one line, with commas between"));
    }
    let at_line = |e: ReadError| ReadError { line: first.line, ..e };
    let wanted = column.map(|c| c.find(".csv", count, &names, &places).map_err(at_line)).transpose()?;
    let mut set = Builder::new(column, 0);
    set.leaves_out(first.line, &others(count, &places, wanted), &names);
    let what = column.map_or("", Column::what);
    let mut row = if header { next(&mut rows, 0) } else { Some(first) };
    while let Some(r) = row {
        split(&r, separator, &mut fields)?;
        if fields.len() != count {
            return Err(r.fault(format!("it has {} columns instead of {count}", fields.len()), SAME));
        }
        let [x, y, z] = places;
        let at = [fields[x].number(&r, "x")?, fields[y].number(&r, "y")?, fields[z].number(&r, "z")?];
        let number = wanted.map(|w| fields[w].number(&r, what)).transpose()?;
        set.push_row(at, number, &r)?;
        row = next(&mut rows, set.len());
    }
    Ok(set.finish())
}

/// The next line that is no comment.
fn next<'a>(rows: &mut Rows<'a>, point: usize) -> Option<Row<'a>> {
    loop {
        let row = rows.next(Element::Nth("point", point as u64))?;
        if !row.whole().starts_with('#') {
            return Some(row);
        }
    }
}

fn separator(first: &Row) -> Result<u8, ReadError> {
    let mut quoted = false;
    let outside: Vec<u8> = first
        .whole()
        .bytes()
        .filter(|&b| {
            quoted ^= b == b'"';
            !quoted
        })
        .collect();
    let found = [b'\t', b';', b','].into_iter().find(|s| outside.contains(s));
    found.ok_or_else(|| {
        first.fault(
            "it has no comma, semicolon or tab",
            "separate columns by one of them; with spaces between it is an .xyz file",
        )
    })
}

/// The columns that a header names x, y and z.
fn coordinates(row: &Row, names: &[Cow<str>]) -> Result<[usize; 3], ReadError> {
    let mut places = [0; 3];
    for ((place, name), other) in places.iter_mut().zip(["x", "y", "z"]).zip(["Points:0", "Points:1", "Points:2"]) {
        let is = |given: &Cow<str>| given.eq_ignore_ascii_case(name) || *given == other;
        let mut found = (0..names.len()).filter(|&i| is(&names[i]));
        *place = match (found.next(), found.next()) {
            (Some(i), None) => i,
            (None, _) => {
                let fix = "name the columns of the coordinates x, y, z, or give no header";
                return Err(row.fault(format!("the header names no column {name}"), fix));
            }
            _ => return Err(row.fault(format!("the header names two columns {name}"), "name one of them otherwise")),
        };
    }
    Ok(places)
}

/// A field of a line.
struct Field<'a> {
    text: Cow<'a, str>,
    /// Where it starts in the line.
    start: usize,
}

impl Field<'_> {
    fn number(&self, row: &Row, name: &str) -> Result<f64, ReadError> {
        number::finite(&self.text).map_err(|problem| {
            let fix = "write a decimal number such as -1.5e3, with a point";
            ReadError { column: clipped(self.start + 1), ..row.fault(format!("{name}: {problem}"), fix) }
        })
    }
}

/// Splits a line into its fields, without white space around them.
fn split<'a>(row: &Row<'a>, separator: u8, fields: &mut Vec<Field<'a>>) -> Result<(), ReadError> {
    fields.clear();
    let whole = row.whole();
    let mut from = 0;
    loop {
        let rest = &whole[from..];
        // A tab is white space and may be the separator.
        let spaces = rest.bytes().take_while(|&b| b == b' ').count();
        let start = from + spaces;
        let (text, end) = if rest[spaces..].starts_with('"') {
            let (text, length) = unquoted(&whole[start + 1..]).ok_or_else(|| {
                let problem = "a quote is not closed on its line";
                ReadError { column: clipped(start + 1), ..row.fault(problem, "close it") }
            })?;
            let end = start + 1 + length;
            let gap = whole[end..].bytes().take_while(|&b| b != separator).count();
            let between = &whole[end..end + gap];
            if !between.trim_ascii().is_empty() {
                let problem = format!("`{}` after a quoted field", shown(between));
                return Err(ReadError { column: clipped(end + 1), ..row.fault(problem, "put a separator between") });
            }
            (text, end + gap)
        } else {
            let end = start + whole[start..].bytes().take_while(|&b| b != separator).count();
            (Cow::Borrowed(whole[start..end].trim_ascii()), end)
        };
        fields.push(Field { text, start });
        if end == whole.len() {
            return Ok(());
        }
        from = end + 1;
    }
}

/// The text of a quoted field up to its closing quote, and the bytes up to behind that.
fn unquoted(rest: &str) -> Option<(Cow<'_, str>, usize)> {
    let mut text = Cow::Borrowed("");
    let mut from = 0;
    loop {
        let quote = from + rest[from..].find('"')?;
        text += &rest[from..quote];
        if !rest[quote + 1..].starts_with('"') {
            return Some((text, quote + 1));
        }
        text += "\"";
        from = quote + 2;
    }
}
