//! Floor 3: files. Readers of planar straight line graphs and of meshes, writers of meshes.
//!
//! Readers work on bytes and touch no file. Each is bounded by the length of what it is given, answers any bytes with a value or one
//! located `ReadError`, and repairs nothing that the format itself does not repeat. Numbers are decimal and finite; whether their range suits the
//! mesher is for `domain` to say.

mod angle;
mod block;
mod chains;
mod cursor;
mod error;
mod flat;
mod foreign;
mod foreign3;
mod format;
mod geojson;
mod grid;
mod input;
mod medit;
mod msh;
mod msh_binary;
mod number;
mod off;
mod points;
mod rows;
mod scalar;
mod tetgen;
mod triangle;
mod vtk;
mod vtu;
mod wkt;
pub mod write;
mod xml;

#[cfg(test)]
mod tests;

pub use error::ReadError;
pub use foreign::{ForeignEdge, ForeignMesh, MeshLines};
pub use foreign3::{ForeignMesh3, ForeignTriangle, MeshLines3};
pub use format::{
    AnyMesh, Format, point_dimension, read_any_mesh, read_mesh, read_mesh3, read_points3, read_pslg, write_mesh,
    write_mesh3, write_points3, write_triangulation3,
};
pub use geojson::parse_geojson;
pub use input::{Input, Note, NoteKind};
pub use medit::parse_medit;
pub use msh::{parse_msh, parse_msh3};
pub use off::parse_off;
pub use points::{Column, ColumnName, Input3, parse_csv, parse_node3, parse_npy, parse_off3, parse_ply, parse_xyz};
pub use tetgen::{TetgenFiles, parse_tetgen};
pub use triangle::{TriangleFiles, parse_node, parse_node_ele, parse_poly, poly_wants_node};
pub use vtk::parse_vtk;
pub use vtu::{parse_vtu, parse_vtu3};
pub use wkt::parse_wkt;
