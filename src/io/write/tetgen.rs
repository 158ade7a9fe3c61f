//! Writes TetGen's elements, numbered from 1: what goes with `points::node3`.

use super::{end, field, float};
use crate::io::ForeignMesh3;
use crate::model::VertexId;

/// The `.ele` file: all tetrahedra, with the region attribute if there is one.
pub fn ele3(mesh: &ForeignMesh3) -> Vec<u8> {
    let mut out = Vec::with_capacity(40 * mesh.tetrahedra.len());
    let attributes = u8::from(!mesh.tetrahedron_attributes.is_empty());
    end(field(field(field(&mut out, mesh.tetrahedra.len()), 4), attributes));
    for (i, t) in mesh.tetrahedra.iter().enumerate() {
        corners(&mut out, i, t);
        if let Some(&a) = mesh.tetrahedron_attributes.get(i) {
            float(&mut out, a);
        }
        end(&mut out);
    }
    out
}

/// The `.face` file: triangles with their markers.
pub fn face(triangles: &[[VertexId; 3]], marker: impl Fn(usize) -> i32) -> Vec<u8> {
    let mut out = Vec::new();
    end(field(field(&mut out, triangles.len()), 1));
    for (i, t) in triangles.iter().enumerate() {
        corners(&mut out, i, t);
        end(field(&mut out, marker(i)));
    }
    out
}

/// The `.edge` file: all edges with their markers.
pub fn edge3(mesh: &ForeignMesh3) -> Vec<u8> {
    let mut out = Vec::new();
    end(field(field(&mut out, mesh.edges.len()), 1));
    for (i, e) in mesh.edges.iter().enumerate() {
        corners(&mut out, i, &e.ends);
        end(field(&mut out, e.marker));
    }
    out
}

fn corners(out: &mut Vec<u8>, i: usize, ids: &[VertexId]) {
    field(out, i + 1);
    for VertexId(v) in ids {
        field(out, v + 1);
    }
}
