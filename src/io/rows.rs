//! Text files as rows of fields, each knowing its place: the common ground of the line-oriented formats.
//!
//! A row is a line with at least one field once the comment (`#` to the end of the line) is gone. Every access names what is
//! wanted, so that an error can say it.

use super::ReadError;
use super::error::shown;
use super::number;
use crate::model::words::counted;

/// No format here holds more elements of one kind: ids are 32 bits wide and some are reserved.
pub(super) const MOST_ELEMENTS: u64 = i32::MAX as u64;

/// The bytes of a text file as text. A byte order mark is dropped.
///
/// Errors: bytes that are not UTF-8, NUL bytes; both with their line.
pub(super) fn text<'a>(part: &'static str, bytes: &'a [u8]) -> Result<&'a str, ReadError> {
    let bad = |at: usize, problem: &str, fix: &str| {
        let line = 1 + bytes[..at].iter().filter(|&&b| b == b'\n').count();
        let column = 1 + bytes[..at].iter().rev().take_while(|&&b| b != b'\n').count();
        Err(ReadError {
            part,
            line: clipped(line),
            column: clipped(column),
            problem: problem.into(),
            fix: fix.into(),
            ..ReadError::default()
        })
    };
    // `contains` is fast, `position` is not.
    if bytes.contains(&0) {
        let at = bytes.iter().take_while(|&&b| b != 0).count();
        return bad(at, "a NUL byte", "this is no text file, or it is damaged");
    }
    let body = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(body) {
        Ok(text) => Ok(text),
        Err(e) => bad(
            e.valid_up_to() + bytes.len() - body.len(),
            "a byte that is not UTF-8",
            "save the file as plain text in UTF-8",
        ),
    }
}

/// A place as it is stored: lines beyond 2^32 - 1 all get that number.
pub(super) fn clipped(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// The rows of a text file, in order. Lines end in LF or CR LF; in a file without LF, as old Macintoshes made them, in CR.
pub(super) struct Rows<'a> {
    part: &'static str,
    lines: std::str::SplitTerminator<'a, char>,
    line: u32,
    /// 0 where lines are no places of the file.
    step: u32,
    size: usize,
    /// What starts a comment.
    comment: Option<char>,
}

impl<'a> Rows<'a> {
    /// Rows of a file whose comments start with `#`.
    pub(super) fn new(part: &'static str, bytes: &'a [u8]) -> Result<Rows<'a>, ReadError> {
        let text = text(part, bytes)?;
        let lines = text.split_terminator(if text.contains('\n') { '\n' } else { '\r' });
        Ok(Rows { part, lines, line: 0, step: 1, size: bytes.len(), comment: Some('#') })
    }

    /// The same rows where nothing starts a comment.
    pub(super) fn without_comments(self) -> Rows<'a> {
        Rows { comment: None, ..self }
    }

    /// The same rows of a text that starts after so many lines of its file.
    pub(super) fn after(self, line: u32) -> Rows<'a> {
        Rows { line, ..self }
    }

    /// The same rows of a text that is not the file itself: faults have no line.
    pub(super) fn without_places(self) -> Rows<'a> {
        Rows { line: 0, step: 0, ..self }
    }

    /// The next row, or nothing at the end of the file.
    pub(super) fn next(&mut self, element: Element) -> Option<Row<'a>> {
        loop {
            let whole = self.lines.next()?;
            let whole = whole.strip_suffix('\r').unwrap_or(whole);
            self.line = self.line.saturating_add(self.step);
            let body = match self.comment.and_then(|c| whole.find(c)) {
                Some(at) => &whole[..at],
                None => whole,
            };
            if !body.trim_ascii().is_empty() {
                return Some(Row { part: self.part, line: self.line, element, whole: body, rest: body });
            }
        }
    }

    /// The next row; its absence is an error that says what is missing.
    pub(super) fn expect(&mut self, element: Element) -> Result<Row<'a>, ReadError> {
        let fix = "the file is truncated or declares too many elements";
        self.next(element).ok_or_else(|| self.fault(element, "the file ends before it", fix))
    }

    /// An error about what stands up to the row read last.
    pub(super) fn fault(&self, element: Element, problem: &str, fix: &str) -> ReadError {
        ReadError {
            part: self.part,
            line: self.line,
            element: element.to_string(),
            problem: problem.into(),
            fix: fix.into(),
            ..ReadError::default()
        }
    }

    /// That nothing but comments follows.
    pub(super) fn end(&mut self, after: &'static str) -> Result<(), ReadError> {
        match self.next(Element::The("end of file")) {
            None => Ok(()),
            Some(row) => Err(row.fault(
                format!("`{}` after the last {after}", shown(row.whole.trim_ascii())),
                "remove it, or correct the count that the file declares",
            )),
        }
    }
}

/// What a row is about, for messages.
#[derive(Clone, Copy)]
pub(super) enum Element {
    /// A thing there is one of.
    The(&'static str),
    /// The n-th of its kind, by its number in the file.
    Nth(&'static str, u64),
}

impl std::fmt::Display for Element {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Element::The(name) => f.write_str(name),
            Element::Nth(name, n) => write!(f, "{name} {n}"),
        }
    }
}

/// One row and how far it is read.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    part: &'static str,
    pub(super) line: u32,
    pub(super) element: Element,
    whole: &'a str,
    rest: &'a str,
}

impl<'a> Row<'a> {
    /// An error about the whole row.
    pub(super) fn fault(&self, problem: impl Into<String>, fix: &str) -> ReadError {
        ReadError {
            part: self.part,
            line: self.line,
            column: 0,
            element: self.element.to_string(),
            problem: problem.into(),
            fix: fix.into(),
        }
    }

    /// An error about the field read last.
    pub(super) fn fault_at(&self, field: &str, problem: String, fix: &str) -> ReadError {
        let column = self.whole.len() - self.rest.len() - field.len() + 1;
        ReadError { column: if self.line == 0 { 0 } else { clipped(column) }, ..self.fault(problem, fix) }
    }

    /// The next field, if there is one.
    pub(super) fn field(&mut self) -> Option<&'a str> {
        let rest = self.rest.trim_ascii_start();
        // White space is one byte each, so that the end lies between characters.
        let end = rest.bytes().position(|b| b.is_ascii_whitespace()).unwrap_or(rest.len());
        let (field, rest) = rest.split_at(end);
        self.rest = rest;
        (!field.is_empty()).then_some(field)
    }

    /// The next field as text.
    pub(super) fn word(&mut self, name: &str) -> Result<&'a str, ReadError> {
        self.field().ok_or_else(|| self.fault(format!("{name} is missing"), "add it to the line"))
    }

    /// The next field as a finite number.
    pub(super) fn float(&mut self, name: &str) -> Result<f64, ReadError> {
        let field = self.word(name)?;
        self.number(field, name)
    }

    /// The field read last as a finite number.
    pub(super) fn number(&self, field: &str, name: &str) -> Result<f64, ReadError> {
        number::finite(field).map_err(|problem| {
            self.fault_at(field, format!("{name}: {problem}"), "write a decimal number such as -1.5e3")
        })
    }

    /// The next field as an integer.
    pub(super) fn integer(&mut self, name: &str) -> Result<i64, ReadError> {
        let field = self.word(name)?;
        number::integer(field).map_err(|problem| self.fault_at(field, format!("{name}: {problem}"), ""))
    }

    /// The next field as a marker.
    pub(super) fn marker(&mut self) -> Result<i32, ReadError> {
        let field = self.word("marker")?;
        field.parse::<i32>().map_err(|_| {
            self.fault_at(field, format!("marker: `{}` is not a whole number of 32 bits", shown(field)), "")
        })
    }

    /// The next field as an integer in `low..=high`.
    pub(super) fn ranged(&mut self, name: &str, low: i64, high: i64) -> Result<i64, ReadError> {
        let field = self.word(name)?;
        let n = number::integer(field).map_err(|problem| self.fault_at(field, format!("{name}: {problem}"), ""))?;
        if n < low || n > high {
            let fix =
                if low == high { format!("it must be {low}") } else { format!("it must be from {low} to {high}") };
            return Err(self.fault_at(field, format!("{name} is {n}"), &fix));
        }
        Ok(n)
    }

    /// The next field as a number of rows that follow, each of at least `bytes` bytes with its line end: bounded by the size of the file.
    pub(super) fn count(&mut self, name: &str, bytes: usize, rows: &Rows) -> Result<usize, ReadError> {
        let field = self.word(name)?;
        let n = number::integer(field).map_err(|problem| self.fault_at(field, format!("{name}: {problem}"), ""))?;
        let Ok(count) = u64::try_from(n) else {
            return Err(self.fault_at(field, format!("{name} is {n}"), "a count cannot be negative"));
        };
        if count > MOST_ELEMENTS {
            return Err(self.fault_at(field, format!("{name} is {n}"), &format!("the limit is {MOST_ELEMENTS}")));
        }
        // The last line may lack its end. Counts are below 2^31 here, so nothing overflows.
        if count.saturating_mul(bytes as u64) > rows.size as u64 + 1 {
            return Err(self.fault_at(
                field,
                format!("{name} is {n}, but the file has only {}", counted(rows.size, "byte")),
                "correct the count, or the file is truncated",
            ));
        }
        Ok(count as usize)
    }

    /// How many fields are left.
    pub(super) fn fields(&self) -> usize {
        self.rest.split_ascii_whitespace().count()
    }

    /// The whole row, comment left out.
    pub(super) fn whole(&self) -> &'a str {
        self.whole
    }

    /// All that is left of the row, without white space around it.
    pub(super) fn remainder(&self) -> &'a str {
        self.rest.trim_ascii()
    }

    /// Whether a further field follows.
    pub(super) fn has_more(&self) -> bool {
        !self.rest.trim_ascii_start().is_empty()
    }

    /// That no field follows.
    pub(super) fn end(mut self) -> Result<(), ReadError> {
        match self.field() {
            None => Ok(()),
            Some(field) => Err(self.fault_at(
                field,
                format!("`{}` is one field too many", shown(field)),
                "remove it, or correct what the header declares",
            )),
        }
    }
}

/// The fields of a text file in order, whatever lines they stand on: for formats that care about words only.
pub(super) struct Tokens<'a> {
    rows: Rows<'a>,
    row: Option<Row<'a>>,
    /// What is being read, for messages.
    pub(super) element: Element,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(rows: Rows<'a>) -> Tokens<'a> {
        Tokens { rows, row: None, element: Element::The("header") }
    }

    /// The row of the next field.
    fn here(&mut self, name: &str) -> Result<(&mut Row<'a>, &Rows<'a>), ReadError> {
        if self.at_end() {
            let problem = format!("the file ends before {name}");
            return Err(self.rows.fault(self.element, &problem, "the file is truncated or declares too many elements"));
        }
        match &mut self.row {
            Some(row) => {
                row.element = self.element;
                Ok((row, &self.rows))
            }
            // `at_end` has found one; still, this is what is wrong if it has not.
            None => Err(self.rows.fault(self.element, "the file ends", "")),
        }
    }

    /// Whether no field follows.
    pub(super) fn at_end(&mut self) -> bool {
        if !self.row.is_some_and(|row| row.has_more()) {
            self.row = self.rows.next(self.element);
        }
        self.row.is_none()
    }

    /// The next field, which stays.
    pub(super) fn peek(&mut self) -> Option<&'a str> {
        if self.at_end() { None } else { self.row.and_then(|mut row| row.field()) }
    }

    /// The line of the field read last.
    pub(super) fn line(&self) -> u32 {
        self.rows.line
    }

    /// The next field as text.
    pub(super) fn word(&mut self, name: &str) -> Result<&'a str, ReadError> {
        self.here(name)?.0.word(name)
    }

    /// The next field as a finite number.
    pub(super) fn float(&mut self, name: &str) -> Result<f64, ReadError> {
        self.here(name)?.0.float(name)
    }

    /// The next field as an integer in `low..=high`.
    pub(super) fn ranged(&mut self, name: &str, low: i64, high: i64) -> Result<i64, ReadError> {
        self.here(name)?.0.ranged(name, low, high)
    }

    /// The next field as a marker.
    pub(super) fn marker(&mut self) -> Result<i32, ReadError> {
        self.here("marker")?.0.marker()
    }

    /// The next field as a number of elements, see `Row::count`.
    pub(super) fn count(&mut self, name: &str, bytes: usize) -> Result<usize, ReadError> {
        let (row, rows) = self.here(name)?;
        row.count(name, bytes, rows)
    }

    /// An error about the line of the field read last.
    pub(super) fn fault(&self, problem: &str, fix: &str) -> ReadError {
        self.rows.fault(self.element, problem, fix)
    }
}
