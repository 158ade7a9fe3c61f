//! The third coordinate of formats that have one: a planar mesh lies in one plane z = constant.

use super::rows::Row;
use super::{Note, NoteKind, ReadError};

/// The common z of the vertices read so far.
#[derive(Default)]
pub(super) struct Flat {
    height: Option<f64>,
    line: u32,
}

impl Flat {
    /// Takes the z of one more vertex.
    ///
    /// Errors: it differs from the others'.
    pub(super) fn z(&mut self, row: &mut Row) -> Result<(), ReadError> {
        let z = row.float("z")?;
        self.check(z, row.line).map_err(|problem| row.fault(problem, FIX))
    }

    /// The same for a number without a row; the error is a phrase.
    pub(super) fn check(&mut self, z: f64, line: u32) -> Result<(), String> {
        let height = *self.height.get_or_insert(z);
        if self.line == 0 {
            self.line = line;
        }
        // No minus zero is left by the reader of numbers.
        if height.to_bits() == z.to_bits() { Ok(()) } else { Err(format!("z is {z:?}, but {height:?} before")) }
    }

    /// A note if the plane is not z = 0.
    pub(super) fn note(&self) -> Option<Note> {
        let z = self.height.filter(|z| z.to_bits() != 0)?;
        Some(Note {
            kind: NoteKind::Note,
            line: self.line,
            text: format!("all vertices have z = {z:?}, which is left out"),
        })
    }
}

/// What to do about a mesh in space.
pub(super) const FIX: &str = "only planar meshes are read here";
