//! Writes the Object File Format: coordinates and triangles, nothing else has a place in it.

use super::{end, field, float, text};
use crate::model::{Mesh2, VertexId};

/// The mesh as an `.off` file in the plane z = 0.
pub fn off(mesh: &Mesh2) -> Vec<u8> {
    let mut out = Vec::new();
    text(&mut out, "OFF\n");
    end(field(field(field(&mut out, mesh.points.len()), mesh.triangles.len()), 0));
    for p in &mesh.points {
        end(field(float(float(&mut out, p.x), p.y), 0));
    }
    for t in &mesh.triangles {
        field(&mut out, 3);
        for VertexId(v) in t {
            field(&mut out, v);
        }
        end(&mut out);
    }
    out
}
