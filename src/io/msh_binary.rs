//! Gmsh's binary `.msh`, versions 2.2 and 4.1, written out as ASCII (Gmsh reference manual, section "MSH file format"), so that `msh` alone knows what a mesh is.
//!
//! Heads of sections and names are text in both encodings. Sections whose layout does not matter here stay empty. Numbers are written so that
//! the same ones are read back. A count that lies ends with the bytes, so that the text is no longer than some three times the file.

use super::ReadError;
use super::error::shown;
use super::rows::Rows;
use super::scalar::{Scalar, whole};
use std::borrow::Cow;
use std::fmt::Display;

/// A file as ASCII.
pub(super) struct Text<'a>(Cow<'a, [u8]>);

impl<'a> Text<'a> {
    /// The file itself if it is ASCII or no mesh, else its numbers as text.
    ///
    /// Errors: numbers of other sizes than 8 bytes, a section that ends early, bytes that are no text where text is due.
    pub(super) fn of(bytes: &'a [u8]) -> Result<Text<'a>, ReadError> {
        as_text(bytes).map(Text)
    }

    /// Its rows. Those of a binary file have no places.
    pub(super) fn rows(&self) -> Result<Rows<'_>, ReadError> {
        let rows = Rows::new(".msh", &self.0)?.without_comments();
        Ok(if matches!(self.0, Cow::Owned(_)) { rows.without_places() } else { rows })
    }
}

fn as_text(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ReadError> {
    let mut source = Source { bytes, big_endian: false, section: "MeshFormat".into(), out: String::new() };
    let format: Vec<&str> = match (source.row(), source.row()) {
        (Ok("$MeshFormat"), Ok(format)) => format.split_ascii_whitespace().collect(),
        _ => return Ok(Cow::Borrowed(bytes)),
    };
    let [version, "1", size] = format[..] else {
        return Ok(Cow::Borrowed(bytes));
    };
    if size != "8" {
        return Err(source.fault(format!("the size of numbers is {} bytes", shown(size)), "save it as ASCII"));
    }
    source.big_endian = source.take(4)? == [0, 0, 0, 1];
    source.bytes = source.bytes.trim_ascii_start();
    source.out = format!("$MeshFormat\n{version} 0 8\n");
    let end = source.row()?;
    source.put(end);
    source.end_row();
    while !source.bytes.trim_ascii_start().is_empty() {
        if !source.section(version.starts_with('4'))? {
            break;
        }
    }
    Ok(Cow::Owned(source.out.into_bytes()))
}

/// What is left of a file, and the text so far.
struct Source<'a> {
    bytes: &'a [u8],
    big_endian: bool,
    /// The section being read.
    section: String,
    out: String,
}

impl<'a> Source<'a> {
    fn fault(&self, problem: impl Into<String>, fix: &str) -> ReadError {
        let element = format!("${}", shown(&self.section));
        ReadError { part: ".msh", element, problem: problem.into(), fix: fix.into(), ..ReadError::default() }
    }

    fn truncated(&self) -> ReadError {
        self.fault("the file ends within it", "the file is truncated or declares too many elements")
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], ReadError> {
        let (head, rest) = self.bytes.split_at_checked(count).ok_or_else(|| self.truncated())?;
        self.bytes = rest;
        Ok(head)
    }

    /// The next line of text, without the white space around it.
    fn row(&mut self) -> Result<&'a str, ReadError> {
        if self.bytes.is_empty() {
            return Err(self.truncated());
        }
        let length = self.bytes.iter().position(|&b| b == b'\n').unwrap_or(self.bytes.len());
        let row = std::str::from_utf8(&self.bytes[..length]).ok().filter(|row| !row.contains('\0'));
        let fix = "the counts of the section are wrong, or the file is damaged";
        let row = row.ok_or_else(|| self.fault("bytes that are no text where a line of text is due", fix))?;
        self.bytes = self.bytes.get(length + 1..).unwrap_or_default();
        Ok(row.trim_ascii())
    }

    fn put(&mut self, field: impl Display) {
        self.out.push_str(&field.to_string());
        self.out.push(' ');
    }

    fn end_row(&mut self) {
        self.out.push('\n');
    }

    /// Copies integers of 4 bytes, returns the last; 0 of none.
    fn ints(&mut self, count: usize) -> Result<i32, ReadError> {
        let mut last = 0;
        for _ in 0..count {
            // The cast keeps the 32 bits that are there.
            last = whole(self.take(4)?, self.big_endian) as i32;
            self.put(last);
        }
        Ok(last)
    }

    /// Copies unsigned integers of 8 bytes, returns the last; 0 of none.
    fn sizes(&mut self, count: usize) -> Result<u64, ReadError> {
        let mut last = 0;
        for _ in 0..count {
            last = whole(self.take(8)?, self.big_endian);
            self.put(last);
        }
        Ok(last)
    }

    fn doubles(&mut self, count: usize) -> Result<(), ReadError> {
        for _ in 0..count {
            let x = Scalar::F64.value(self.take(8)?, self.big_endian);
            // With an exponent: the plain form of a large double has 300 digits.
            self.put(format_args!("{x:e}"));
        }
        Ok(())
    }

    /// Copies a line that holds one number.
    fn count(&mut self) -> Result<u64, ReadError> {
        let row = self.row()?;
        self.put(row);
        self.end_row();
        row.parse().map_err(|_| self.fault(format!("a number is due, not `{}`", shown(row)), ""))
    }

    /// Copies a section; says whether what follows makes sense.
    fn section(&mut self, four: bool) -> Result<bool, ReadError> {
        self.bytes = self.bytes.trim_ascii_start();
        let head = self.row()?;
        self.put(head);
        self.end_row();
        self.section = head.trim_start_matches('$').into();
        let due = format!("$End{}", self.section);
        let known = match (head, four) {
            ("$PhysicalNames", _) => {
                for _ in 0..self.count()? {
                    let row = self.row()?;
                    self.put(row);
                    self.end_row();
                }
                true
            }
            ("$Nodes", false) => self.nodes_of_two()?,
            ("$Nodes", true) => self.nodes_of_four()?,
            ("$Elements", false) => self.elements_of_two()?,
            ("$Elements", true) => self.elements_of_four()?,
            ("$Entities", true) => self.entities()?,
            ("$NodeData", _) => self.node_data()?,
            _ => {
                let end = self.bytes.windows(due.len()).position(|w| w == due.as_bytes());
                self.take(end.unwrap_or(self.bytes.len()))?;
                true
            }
        };
        self.bytes = self.bytes.trim_ascii_start();
        if known && !self.bytes.is_empty() {
            let end = self.row()?;
            self.put(end);
            self.end_row();
        }
        Ok(known)
    }

    fn nodes_of_two(&mut self) -> Result<bool, ReadError> {
        for _ in 0..self.count()? {
            self.ints(1)?;
            self.doubles(3)?;
            self.end_row();
        }
        Ok(true)
    }

    fn nodes_of_four(&mut self) -> Result<bool, ReadError> {
        let blocks = self.sizes(1)?;
        self.sizes(3)?;
        self.end_row();
        for _ in 0..blocks {
            let dimension = self.ints(1)?;
            self.ints(1)?;
            let parametric = self.ints(1)?;
            let count = self.sizes(1)?;
            self.end_row();
            for _ in 0..count {
                self.sizes(1)?;
                self.end_row();
            }
            let parameters = if parametric == 0 { 0 } else { dimension.clamp(0, 3) as usize };
            for _ in 0..count {
                self.doubles(3 + parameters)?;
                self.end_row();
            }
        }
        Ok(true)
    }

    fn elements_of_two(&mut self) -> Result<bool, ReadError> {
        let total = self.count()?;
        let mut done = 0;
        while done < total {
            let [kind, count, tags] = [self.int()?, self.int()?, self.int()?];
            for _ in 0..count.max(0) {
                self.ints(1)?;
                self.put(kind);
                let Some(nodes) = nodes_of(kind) else {
                    self.put(0);
                    return Ok(false);
                };
                self.put(tags);
                self.ints(tags.max(0) as usize)?;
                self.ints(nodes)?;
                self.end_row();
            }
            done += count.max(0) as u64;
        }
        Ok(true)
    }

    /// An integer of 4 bytes that is not copied.
    fn int(&mut self) -> Result<i32, ReadError> {
        // The cast keeps the 32 bits that are there.
        Ok(whole(self.take(4)?, self.big_endian) as i32)
    }

    fn elements_of_four(&mut self) -> Result<bool, ReadError> {
        let blocks = self.sizes(1)?;
        self.sizes(3)?;
        self.end_row();
        for _ in 0..blocks {
            self.ints(2)?;
            let kind = self.ints(1)?;
            let count = self.sizes(1)?;
            self.end_row();
            for _ in 0..count {
                self.sizes(1)?;
                let Some(nodes) = nodes_of(kind) else {
                    return Ok(false);
                };
                self.sizes(nodes)?;
                self.end_row();
            }
        }
        Ok(true)
    }

    /// Points, curves, surfaces and volumes: of each its tag, its box, its physical groups and what bounds it.
    fn entities(&mut self) -> Result<bool, ReadError> {
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = self.sizes(1)?;
        }
        self.end_row();
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                self.ints(1)?;
                self.doubles(if dimension == 0 { 3 } else { 6 })?;
                let groups = self.sizes(1)?;
                self.many_ints(groups)?;
                if dimension > 0 {
                    let bounding = self.sizes(1)?;
                    self.many_ints(bounding)?;
                }
                self.end_row();
            }
        }
        Ok(true)
    }

    fn many_ints(&mut self, count: u64) -> Result<(), ReadError> {
        // More than the file has bytes end with it all the same.
        self.ints(usize::try_from(count).unwrap_or(usize::MAX)).map(drop)
    }

    fn node_data(&mut self) -> Result<bool, ReadError> {
        let mut integers = Vec::new();
        for _ in 0..3 {
            integers.clear();
            for _ in 0..self.count()? {
                let row = self.row()?;
                self.put(row);
                self.end_row();
                integers.push(row.parse().unwrap_or(0));
            }
        }
        let [_, components, count, ..] = integers[..] else {
            return Err(self.fault("it has fewer than three integer tags", "save it again"));
        };
        for _ in 0..count {
            self.ints(1)?;
            self.doubles(components)?;
            self.end_row();
        }
        Ok(true)
    }
}

/// Nodes of an element of the types that `msh` reads.
fn nodes_of(kind: i32) -> Option<usize> {
    Some(match kind {
        1 => 2,
        2 | 8 => 3,
        4 => 4,
        9 => 6,
        11 => 10,
        15 => 1,
        _ => return None,
    })
}
