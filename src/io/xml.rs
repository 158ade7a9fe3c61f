//! As much of XML as VTK's files need: tags with their attributes and the text between them. Comments and declarations are skipped;
//! entities are not resolved, since numbers have none.

use super::ReadError;
use super::error::shown;
use super::rows::clipped;

/// One tag and the text that follows it.
pub(super) struct Tag<'a> {
    /// Its name; a closing tag has none of its own here and is not returned as such.
    pub(super) name: &'a str,
    /// Its attributes, in order.
    attributes: Vec<(&'a str, &'a str)>,
    pub(super) kind: TagKind,
    /// Line where it starts.
    pub(super) line: u32,
    /// The text up to the next tag.
    pub(super) text: &'a str,
    /// Line where that text starts.
    pub(super) text_line: u32,
}

/// Which end of an element a tag is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum TagKind {
    /// `<a>`
    Open,
    /// `</a>`
    Close,
    /// `<a/>`
    Empty,
}

impl<'a> Tag<'a> {
    /// The value of an attribute.
    pub(super) fn get(&self, name: &str) -> Option<&'a str> {
        self.attributes.iter().find(|(n, _)| *n == name).map(|&(_, value)| value)
    }

    /// An error about the tag.
    pub(super) fn fault(&self, problem: impl Into<String>, fix: &str) -> ReadError {
        let element = match self.get("Name") {
            Some(name) => format!("{} \"{}\"", self.name, shown(name)),
            None => self.name.into(),
        };
        ReadError { part: ".vtu", line: self.line, column: 0, element, problem: problem.into(), fix: fix.into() }
    }
}

/// The tags of a text, in order.
pub(super) struct Tags<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Tags<'a> {
    pub(super) fn new(text: &'a str) -> Tags<'a> {
        Tags { rest: text, line: 1 }
    }

    /// Goes forward by a number of bytes that ends between characters.
    fn advance(&mut self, bytes: usize) -> &'a str {
        let (passed, rest) = self.rest.split_at(bytes);
        self.line += passed.bytes().filter(|&b| b == b'\n').count();
        self.rest = rest;
        passed
    }

    fn fault(&self, problem: String) -> ReadError {
        ReadError {
            part: ".vtu",
            line: clipped(self.line),
            problem,
            fix: "this is no well-formed XML".into(),
            ..ReadError::default()
        }
    }

    /// The next tag; nothing at the end of the text.
    pub(super) fn next(&mut self) -> Result<Option<Tag<'a>>, ReadError> {
        loop {
            let Some(start) = self.rest.find('<') else {
                return match self.rest.trim_ascii() {
                    "" => Ok(None),
                    other => Err(self.fault(format!("`{}` after the last tag", shown(other)))),
                };
            };
            self.advance(start);
            let skipped = if self.rest.starts_with("<!--") {
                Some("-->")
            } else {
                ["<?", "<!"].iter().any(|s| self.rest.starts_with(s)).then_some(">")
            };
            let Some(close) = skipped else { break };
            let Some(end) = self.rest.find(close) else {
                return Err(self.fault(format!("the file ends before `{close}`")));
            };
            self.advance(end + close.len());
        }
        let line = clipped(self.line);
        let Some(end) = self.rest.find('>') else {
            return Err(self.fault("the file ends within a tag".into()));
        };
        let inner = &self.rest[1..end];
        let (kind, inner) = match (inner.strip_prefix('/'), inner.strip_suffix('/')) {
            (Some(inner), _) => (TagKind::Close, inner),
            (_, Some(inner)) => (TagKind::Empty, inner),
            _ => (TagKind::Open, inner),
        };
        let name_end = inner.find(|c: char| c.is_ascii_whitespace()).unwrap_or(inner.len());
        let (name, attributes) = inner.split_at(name_end);
        let attributes = self.attributes(attributes)?;
        self.advance(end + 1);
        let text_line = clipped(self.line);
        let text_end = self.rest.find('<').unwrap_or(self.rest.len());
        let text = self.rest[..text_end].trim_ascii_end();
        if text_end < self.rest.len() {
            self.advance(text_end);
        }
        Ok(Some(Tag { name, attributes, kind, line, text, text_line }))
    }

    fn attributes(&self, mut rest: &'a str) -> Result<Vec<(&'a str, &'a str)>, ReadError> {
        let mut all = Vec::new();
        loop {
            rest = rest.trim_ascii_start();
            if rest.is_empty() {
                return Ok(all);
            }
            let parts = rest.split_once('=').and_then(|(name, value)| {
                let value = value.trim_ascii_start();
                let quote = value.chars().next().filter(|&c| c == '"' || c == '\'')?;
                let (value, rest) = value[1..].split_once(quote)?;
                Some((name.trim_ascii(), value, rest))
            });
            let Some((name, value, after)) = parts else {
                return Err(self.fault(format!("`{}` is no attribute", shown(rest))));
            };
            all.push((name, value));
            rest = after;
        }
    }
}
