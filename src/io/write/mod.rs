//! Writers of finished meshes: pure functions from a mesh to the bytes of a file. Nothing here touches the file system.
//!
//! Floats are the shortest decimals that read back the same. A mesh whose triangles are not canonical (one read from elsewhere) is
//! written as it stands.

mod grid;
mod medit;
mod msh;
mod off;
pub mod points;
mod svg;
pub mod tetgen;
pub mod triangle;
mod vtu;

pub use grid::{vtk, vtu3};
pub use medit::medit;
pub use msh::{MshVersion, msh, msh3};
pub use off::off;
pub use svg::svg;
pub use vtu::vtu;

use super::number::push_float;
use std::io::Write;

/// Appends a field to the current row.
fn field(out: &mut Vec<u8>, value: impl std::fmt::Display) -> &mut Vec<u8> {
    separate(out);
    // Writing to a vector cannot fail.
    write!(out, "{value}").expect("a vector takes every byte");
    out
}

/// Appends a number to the current row.
fn float(out: &mut Vec<u8>, value: f64) -> &mut Vec<u8> {
    separate(out);
    push_float(out, value);
    out
}

fn separate(out: &mut Vec<u8>) {
    if out.last().is_some_and(|&b| b != b'\n') {
        out.push(b' ');
    }
}

/// Ends the current row.
fn end(out: &mut Vec<u8>) {
    out.push(b'\n');
}

/// Appends text as it is.
fn text(out: &mut Vec<u8>, text: &str) {
    out.extend_from_slice(text.as_bytes());
}
