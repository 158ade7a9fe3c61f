//! The digest of a mesh.

use crate::model::Mesh2;

/// blake3 of the canonical form of a mesh, in hexadecimal. Source: `docs/trace-format.md`, "Mesh digest".
///
/// Markers and attributes are no part of it: it states the complex that a run produced.
pub fn mesh_digest(mesh: &Mesh2) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut bytes = Vec::with_capacity(1 << 16);
    let mut put = |part: &[u8]| {
        bytes.extend_from_slice(part);
        if bytes.len() >= (1 << 16) - 8 || part.is_empty() {
            hasher.update(&bytes);
            bytes.clear();
        }
    };
    put(&(mesh.points.len() as u64).to_le_bytes());
    for p in &mesh.points {
        put(&p.x.to_bits().to_le_bytes());
        put(&p.y.to_bits().to_le_bytes());
    }
    put(&(mesh.triangles.len() as u64).to_le_bytes());
    for t in &mesh.triangles {
        t.iter().for_each(|v| put(&v.0.to_le_bytes()));
    }
    put(&(mesh.edges.len() as u64).to_le_bytes());
    for e in &mesh.edges {
        [e.ends[0].0, e.ends[1].0, e.segment.0].iter().for_each(|n| put(&n.to_le_bytes()));
    }
    // An empty part hashes what is left.
    put(&[]);
    hasher.finalize().to_hex().to_string()
}
