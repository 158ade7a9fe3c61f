//! What a reader of planar straight line graphs returns.

use crate::model::{Lines, Pslg};

/// A planar straight line graph as a file states it, with the place of each element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// The graph. Equal points of formats that repeat them (WKT, GeoJSON) are one vertex already; `.poly` is taken as it stands.
    pub pslg: Pslg,
    /// Where its elements stood.
    pub lines: Lines,
    /// What the reader did or left out, for the user to know.
    pub notes: Vec<Note>,
}

/// Something that a reader did without being asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Whether the input was changed or only part of it ignored.
    pub kind: NoteKind,
    /// One-based line of the first place concerned; 0 if there is none.
    pub line: u32,
    /// One sentence.
    pub text: String,
}

/// The weight of a `Note`, as in the report of `doctor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoteKind {
    /// Resolved without a new coordinate and without loss.
    Repair,
    /// Something of the file has no meaning here and was left out.
    Note,
}
