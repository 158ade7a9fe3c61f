//! The digest of a mesh, and how digests are taken.

use crate::model::{Mesh2, VertexId};

/// Numbers on their way to blake3, little-endian, in parts large enough for it to run at full width.
#[derive(Default)]
pub(super) struct Hash {
    hasher: blake3::Hasher,
    bytes: Vec<u8>,
}

/// The size of a part.
const PART: usize = 1 << 16;

impl Hash {
    /// The next bytes.
    pub(super) fn put(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
        if self.bytes.len() >= PART {
            self.flush();
        }
    }

    /// The next ids, many at once.
    pub(super) fn put_ids(&mut self, ids: &[VertexId]) {
        self.flush();
        for ids in ids.chunks(PART / 4) {
            self.bytes.resize(4 * ids.len(), 0);
            self.bytes.as_chunks_mut().0.iter_mut().zip(ids).for_each(|(b, v)| *b = v.0.to_le_bytes());
            self.flush();
        }
    }

    fn flush(&mut self) {
        self.hasher.update(&self.bytes);
        self.bytes.clear();
    }

    /// In hexadecimal.
    pub(super) fn finish(mut self) -> String {
        self.flush();
        self.hasher.finalize().to_hex().to_string()
    }
}

/// blake3 of the canonical form of a mesh, in hexadecimal. Source: `docs/trace-format.md`, "Mesh digest".
///
/// Markers and attributes are no part of it: it states the complex that a run produced.
pub fn mesh_digest(mesh: &Mesh2) -> String {
    let mut hash = Hash::default();
    hash.put(&(mesh.points.len() as u64).to_le_bytes());
    for p in &mesh.points {
        hash.put(&p.x.to_bits().to_le_bytes());
        hash.put(&p.y.to_bits().to_le_bytes());
    }
    hash.put(&(mesh.triangles.len() as u64).to_le_bytes());
    hash.put_ids(mesh.triangles.as_flattened());
    hash.put(&(mesh.edges.len() as u64).to_le_bytes());
    for e in &mesh.edges {
        [e.ends[0].0, e.ends[1].0, e.segment.0].iter().for_each(|n| hash.put(&n.to_le_bytes()));
    }
    hash.finish()
}
