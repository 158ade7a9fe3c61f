//! Reads the vertices of a Stanford polygon file (`.ply`): ASCII, and binary of both byte orders (Greg Turk's description of the format).
//!
//! The header lists elements with their counts and properties, each a number or a list of numbers. Points are the properties `x`, `y`, `z` of the
//! element `vertex`; the other elements are passed over, which finds a truncated file out. Places in binary files are rows, counted from 1.

use super::{Builder, Column, Input3, others};
use crate::io::rows::{Element as Name, MOST_ELEMENTS, Row, Rows, clipped};
use crate::io::scalar::{Scalar, index};
use crate::io::{Note, NoteKind, ReadError, error::shown};

/// Reads a `.ply` file as points of space.
///
/// A column is a property of the vertices, by name or by number. Errors: the first fault.
pub fn parse_ply(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    // Some editors put a byte order mark before a header.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let header = Header::parse(bytes)?;
    let vertex = header.vertex()?;
    let plan = Plan::new(&header, vertex, column)?;
    let body = &bytes[header.end..];
    // Checked by `fits` before anything of that size is asked for.
    let mut set = Builder::new(column, 0);
    set.leaves_out(vertex.line, &plan.left, &vertex.names());
    let others: Vec<String> = header
        .elements
        .iter()
        .filter(|e| e.name != "vertex" && e.count > 0)
        .map(|e| format!("{} {}", e.count, shown(e.name)))
        .collect();
    if !others.is_empty() {
        let text = format!("elements other than vertices are left out: {}", others.join(", "));
        set.notes.push(Note { kind: NoteKind::Note, line: vertex.line, text });
    }
    match header.format {
        Format::Ascii => ascii(&header, body, &plan, &mut set)?,
        Format::Binary { big_endian } => binary(&header, body, big_endian, &plan, &mut set)?,
    }
    Ok(set.finish())
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Ascii,
    Binary { big_endian: bool },
}

struct Header<'a> {
    format: Format,
    elements: Vec<Element<'a>>,
    /// Where the data starts, and the line before it.
    end: usize,
    lines: u32,
}

struct Element<'a> {
    name: &'a str,
    count: usize,
    properties: Vec<(&'a str, Kind)>,
    line: u32,
}

#[derive(Clone, Copy)]
enum Kind {
    Number(Scalar),
    List { count: Scalar, item: Scalar },
}

impl Element<'_> {
    fn names(&self) -> Vec<&str> {
        self.properties.iter().map(|(name, _)| *name).collect()
    }

    /// The least bytes one of these takes.
    fn least(&self, format: Format) -> usize {
        let of = |&(_, kind): &(&str, Kind)| match (format, kind) {
            // A digit and what separates it.
            (Format::Ascii, _) => 2,
            (_, Kind::Number(scalar) | Kind::List { count: scalar, .. }) => scalar.size(),
        };
        self.properties.iter().map(of).sum()
    }
}

impl<'a> Header<'a> {
    fn parse(bytes: &'a [u8]) -> Result<Header<'a>, ReadError> {
        let mark = b"\nend_header";
        let end = bytes.windows(mark.len()).position(|w| w == mark);
        let end = end.map(|at| at + mark.len()).filter(|_| bytes.starts_with(b"ply"));
        let Some(end) = end else {
            let problem = if !bytes.starts_with(b"ply") {
                "the file does not start with `ply`"
            } else {
                "the file ends within its header"
            };
            return Err(ReadError {
                part: ".ply",
                line: 1,
                problem: problem.into(),
                fix: "the file is truncated or no .ply".into(),
                ..ReadError::default()
            });
        };
        // The line end of the header may be \n or \r\n.
        let length = bytes[end..].iter().take(2).position(|&b| b == b'\n').map_or(0, |at| at + 1);
        let mut rows = Rows::new(".ply", &bytes[..end])?.without_comments();
        rows.expect(Name::The("header"))?;
        let mut format = None;
        let mut elements: Vec<Element> = Vec::new();
        while let Some(mut row) = rows.next(Name::The("header")) {
            match row.word("a keyword")? {
                "comment" | "obj_info" => {}
                "end_header" => break,
                "format" => format = Some(encoding(&mut row)?),
                "element" => {
                    let name = row.word("the name of the element")?;
                    let count = row.ranged("the number of elements", 0, MOST_ELEMENTS as i64)? as usize;
                    elements.push(Element { name, count, properties: Vec::new(), line: row.line });
                }
                "property" => {
                    let Some(element) = elements.last_mut() else {
                        return Err(row.fault("a property stands before the first element", ""));
                    };
                    let first = row.word("the type of the property")?;
                    let kind = if first == "list" {
                        let count = row.word("the type of the count")?;
                        let item = row.word("the type of the items")?;
                        Kind::List { count: scalar(count, &row)?, item: scalar(item, &row)? }
                    } else {
                        Kind::Number(scalar(first, &row)?)
                    };
                    element.properties.push((row.word("the name of the property")?, kind));
                }
                other => return Err(row.fault(format!("`{}` is no keyword of a header", shown(other)), "")),
            }
        }
        let lines = clipped(bytes[..end].iter().filter(|&&b| b == b'\n').count() + 1);
        let missing = || rows.fault(Name::The("header"), "it names no format", "add `format ascii 1.0`");
        let header = Header { format: format.ok_or_else(missing)?, elements, end: end + length, lines };
        header.fits(bytes.len() - header.end)?;
        Ok(header)
    }

    /// That the elements can be in so many bytes.
    fn fits(&self, bytes: usize) -> Result<(), ReadError> {
        for e in &self.elements {
            let (count, least) = (e.count as u128, e.least(self.format) as u128);
            if e.properties.is_empty() && e.count > 0 {
                return Err(self.fault(e, "it has no properties".into(), "add them, or remove the element"));
            }
            if count * least > bytes as u128 + 1 {
                let problem = format!("there are to be {count}, but only {bytes} bytes follow the header");
                return Err(self.fault(e, problem, "correct the count, or the file is truncated"));
            }
        }
        Ok(())
    }

    fn fault(&self, e: &Element, problem: String, fix: &str) -> ReadError {
        ReadError {
            part: ".ply",
            line: e.line,
            element: format!("element {}", shown(e.name)),
            problem,
            fix: fix.into(),
            ..ReadError::default()
        }
    }

    fn vertex(&self) -> Result<&Element<'a>, ReadError> {
        let mut all = self.elements.iter().filter(|e| e.name == "vertex");
        match (all.next(), all.next()) {
            (Some(e), None) => Ok(e),
            (Some(_), Some(second)) => Err(self.fault(second, "it stands twice".into(), "keep one of them")),
            _ => Err(ReadError {
                part: ".ply",
                line: self.lines,
                problem: "the header has no element vertex".into(),
                ..ReadError::default()
            }),
        }
    }
}

fn encoding(row: &mut Row) -> Result<Format, ReadError> {
    match row.word("the format")? {
        "ascii" => Ok(Format::Ascii),
        "binary_little_endian" => Ok(Format::Binary { big_endian: false }),
        "binary_big_endian" => Ok(Format::Binary { big_endian: true }),
        other => Err(row.fault(
            format!("the format is {}", shown(other)),
            "ascii, binary_little_endian and binary_big_endian are read here",
        )),
    }
}

fn scalar(name: &str, row: &Row) -> Result<Scalar, ReadError> {
    Ok(match name {
        "char" | "int8" => Scalar::I8,
        "uchar" | "uint8" => Scalar::U8,
        "short" | "int16" => Scalar::I16,
        "ushort" | "uint16" => Scalar::U16,
        "int" | "int32" => Scalar::I32,
        "uint" | "uint32" => Scalar::U32,
        "float" | "float32" => Scalar::F32,
        "double" | "float64" => Scalar::F64,
        other => return Err(row.fault(format!("`{}` is no type of numbers", shown(other)), "")),
    })
}

/// Which properties of a vertex go where.
struct Plan {
    places: [usize; 3],
    wanted: Option<usize>,
    left: Vec<usize>,
    /// What the wanted one is, for messages.
    what: &'static str,
}

impl Plan {
    fn new(header: &Header, vertex: &Element, column: Option<&Column>) -> Result<Plan, ReadError> {
        let names = vertex.names();
        let mut places = [0; 3];
        for (place, name) in places.iter_mut().zip(["x", "y", "z"]) {
            let found = names.iter().position(|n| *n == name);
            let found = found.or_else(|| names.iter().position(|n| n.eq_ignore_ascii_case(name)));
            *place = found.ok_or_else(|| {
                header.fault(vertex, format!("it has no property {name}"), "points of space have x, y and z")
            })?;
        }
        let at_line = |e: ReadError| ReadError { line: vertex.line, ..e };
        let wanted = column.map(|c| c.find(".ply", names.len(), &names, &places).map_err(at_line)).transpose()?;
        for &i in places.iter().chain(&wanted) {
            if let Kind::List { .. } = vertex.properties[i].1 {
                return Err(header.fault(vertex, format!("{} is a list", shown(names[i])), "it must be a number"));
            }
        }
        let left = others(names.len(), &places, wanted);
        Ok(Plan { places, wanted, left, what: column.map_or("", Column::what) })
    }

    fn of(&self, numbers: &[f64]) -> ([f64; 3], Option<f64>) {
        (self.places.map(|i| numbers[i]), self.wanted.map(|i| numbers[i]))
    }

    /// What a property is, for messages; nothing if it is not needed.
    fn name(&self, i: usize) -> Option<&'static str> {
        let place = self.places.iter().position(|&p| p == i);
        place.map(|k| ["x", "y", "z"][k]).or((self.wanted == Some(i)).then_some(self.what))
    }
}

/// Each element on a line of its own.
fn ascii(header: &Header, body: &[u8], plan: &Plan, set: &mut Builder) -> Result<(), ReadError> {
    let mut rows = Rows::new(".ply", body)?.without_comments().after(header.lines);
    let mut numbers = Vec::new();
    for element in &header.elements {
        let vertex = element.name == "vertex";
        for k in 0..element.count as u64 {
            let mut row = rows.expect(Name::Nth(if vertex { "vertex" } else { "element" }, k))?;
            if !vertex {
                continue;
            }
            numbers.clear();
            for (i, &(_, kind)) in element.properties.iter().enumerate() {
                let mut number = 0.0;
                match (kind, plan.name(i)) {
                    (Kind::List { .. }, _) => {
                        for _ in 0..row.ranged("the length of a list", 0, i64::MAX)? {
                            row.word("an item of a list")?;
                        }
                    }
                    (_, Some(name)) => number = row.float(name)?,
                    (_, None) => {
                        row.word("a property")?;
                    }
                }
                numbers.push(number);
            }
            let (at, number) = plan.of(&numbers);
            set.push_row(at, number, &row)?;
            row.end()?;
        }
    }
    rows.end("element")
}

fn binary(header: &Header, body: &[u8], big_endian: bool, plan: &Plan, set: &mut Builder) -> Result<(), ReadError> {
    let mut rest = body;
    let mut numbers = Vec::new();
    for element in &header.elements {
        let vertex = element.name == "vertex";
        for k in 0..element.count {
            let fault = |problem: String, fix: &str, rest: &[u8]| {
                let at = header.end + body.len() - rest.len();
                let element = format!("{} {k}", shown(element.name));
                let problem = format!("{problem} (byte {at})");
                ReadError { part: ".ply", element, problem, fix: fix.into(), ..ReadError::default() }
            };
            numbers.clear();
            for (i, &(_, kind)) in element.properties.iter().enumerate() {
                let truncated = |rest: &[u8]| fault("the file ends within it".into(), "the file is truncated", rest);
                let (Kind::Number(scalar) | Kind::List { count: scalar, .. }) = kind;
                let (number, after) = rest.split_at_checked(scalar.size()).ok_or_else(|| truncated(rest))?;
                let number = scalar.value(number, big_endian);
                match kind {
                    Kind::Number(_) => {
                        if let Some(name) = plan.name(i).filter(|_| vertex && !number.is_finite()) {
                            return Err(fault(format!("{name} is {number:?}, which is not a finite number"), "", rest));
                        }
                        rest = after;
                    }
                    Kind::List { item, .. } => {
                        let length = index(number, usize::MAX);
                        let bad = || fault(format!("the length of a list is {number:?}"), "the file is damaged", rest);
                        let bytes = length.ok_or_else(bad)?.checked_mul(item.size());
                        let items = bytes.and_then(|n| after.get(n..));
                        rest = items.ok_or_else(|| truncated(rest))?;
                    }
                }
                numbers.push(number);
            }
            if vertex {
                let (at, number) = plan.of(&numbers);
                set.push(at, number, clipped(k + 1)).map_err(|problem| fault(problem, "", rest))?;
            }
        }
    }
    if rest.is_empty() {
        return Ok(());
    }
    let problem = format!("{} bytes follow the last element", rest.len());
    Err(ReadError { part: ".ply", problem, fix: "correct the counts of the header".into(), ..ReadError::default() })
}
