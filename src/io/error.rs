//! What readers and writers say when they cannot.

use std::fmt;

/// One fault of a file, told so that its author can mend it.
///
/// Displays as one sentence: part, line, column, element, problem, and what to do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadError {
    /// Which file of those that belong together, by its extension: `.poly`, `.node`, ...
    pub part: &'static str,
    /// One-based line; 0 if the fault has no place.
    pub line: u32,
    /// One-based column in bytes; 0 if the whole line is meant.
    pub column: u32,
    /// The element concerned, such as `vertex 4`; may be empty.
    pub element: String,
    /// What is wrong, with the text found.
    pub problem: String,
    /// What to do about it; may be empty.
    pub fix: String,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.part)?;
        if self.line > 0 {
            write!(f, " line {}", self.line)?;
        }
        if self.column > 0 {
            write!(f, " column {}", self.column)?;
        }
        f.write_str(": ")?;
        if !self.element.is_empty() {
            write!(f, "{}: ", self.element)?;
        }
        f.write_str(&self.problem)?;
        if !self.fix.is_empty() {
            write!(f, "; {}", self.fix)?;
        }
        Ok(())
    }
}

impl std::error::Error for ReadError {}

/// A run of text from a file as it may be shown in a message: control characters escaped, at most 40 characters.
pub(super) fn shown(text: &str) -> String {
    let mut out = String::new();
    for (i, c) in text.chars().enumerate() {
        if i == 40 {
            out.push_str("...");
            break;
        }
        match c {
            '"' | '\'' | '\\' => out.push(c),
            _ => out.extend(c.escape_debug()),
        }
    }
    out
}
