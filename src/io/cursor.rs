//! A place in a text, for the formats made of nested lists: WKT and the coordinates of GeoJSON.

use super::error::shown;
use super::rows::clipped;
use super::{ReadError, number};

/// A text and how far it is read.
pub(super) struct Cursor<'a> {
    part: &'static str,
    text: &'a str,
    at: usize,
    line: usize,
    line_start: usize,
    /// What is being read, for messages.
    pub(super) element: String,
}

impl<'a> Cursor<'a> {
    /// Starts at a byte of a text that is the start of a character.
    pub(super) fn new(part: &'static str, text: &'a str, at: usize) -> Cursor<'a> {
        let before = &text.as_bytes()[..at];
        let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
        let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |p| p + 1);
        Cursor { part, text, at, line, line_start, element: String::new() }
    }

    /// The current line.
    pub(super) fn line(&self) -> u32 {
        clipped(self.line)
    }

    /// An error at the current place.
    pub(super) fn fault(&self, problem: impl Into<String>, fix: &str) -> ReadError {
        ReadError {
            part: self.part,
            line: clipped(self.line),
            column: clipped(self.at - self.line_start + 1),
            element: self.element.clone(),
            problem: problem.into(),
            fix: fix.into(),
        }
    }

    /// An error that says what should stand at the current place.
    pub(super) fn wanted(&self, what: &str) -> ReadError {
        let rest = &self.text[self.at..];
        let found: &str = rest.split(|c: char| c.is_ascii_whitespace()).next().unwrap_or("");
        match found {
            "" => self.fault(format!("the file ends where {what} is due"), "the file is truncated"),
            _ => self.fault(format!("`{}` stands where {what} is due", shown(found)), ""),
        }
    }

    /// Goes past white space.
    pub(super) fn skip_space(&mut self) {
        for &b in &self.text.as_bytes()[self.at..] {
            if !b.is_ascii_whitespace() {
                break;
            }
            self.at += 1;
            if b == b'\n' {
                self.line += 1;
                self.line_start = self.at;
            }
        }
    }

    /// The next byte after white space; nothing at the end.
    pub(super) fn peek(&mut self) -> Option<u8> {
        self.skip_space();
        self.text.as_bytes().get(self.at).copied()
    }

    /// Goes past a punctuation mark if it is next.
    pub(super) fn take(&mut self, mark: u8) -> bool {
        let found = self.peek() == Some(mark);
        // Marks are ASCII, so that the cursor stays between characters.
        self.at += usize::from(found);
        found
    }

    /// Goes past two marks if they are next, with nothing but white space between; else stays.
    pub(super) fn take_both(&mut self, (open, close): (u8, u8)) -> bool {
        let before = (self.at, self.line, self.line_start);
        let found = self.take(open) && self.take(close);
        if !found {
            (self.at, self.line, self.line_start) = before;
        }
        found
    }

    /// Goes past a punctuation mark, which must be next.
    pub(super) fn expect(&mut self, mark: u8, what: &str) -> Result<(), ReadError> {
        if self.take(mark) { Ok(()) } else { Err(self.wanted(what)) }
    }

    /// Goes past a run of bytes of some class and returns it; it may be empty. The class holds no line end.
    pub(super) fn run(&mut self, class: impl Fn(u8) -> bool) -> &'a str {
        self.skip_space();
        let rest = &self.text[self.at..];
        let end = rest.bytes().position(|b| !class(b)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// Goes past a number.
    pub(super) fn number(&mut self) -> Result<f64, ReadError> {
        self.skip_space();
        let before = (self.at, self.line, self.line_start);
        let token = self.run(|b| b.is_ascii_graphic() && !b"()[]{},;\"".contains(&b));
        number::finite(token).map_err(|problem| {
            (self.at, self.line, self.line_start) = before;
            if token.is_empty() {
                self.wanted("a number")
            } else {
                self.fault(problem, "write a decimal number such as -1.5e3")
            }
        })
    }

    /// Goes past `open item separator item ... close`; it has at least one item.
    pub(super) fn list(
        &mut self,
        (open, close): (u8, u8),
        mut item: impl FnMut(&mut Self) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        self.expect(open, &format!("`{}`", open as char))?;
        loop {
            item(self)?;
            if self.take(b',') {
                continue;
            }
            return self.expect(close, &format!("`,` or `{}`", close as char));
        }
    }
}
