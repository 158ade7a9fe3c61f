//! The digest of a triangulation of space.

use crate::model::{PointState, Triangulation3};

/// blake3 of the canonical form of a triangulation, in hexadecimal. Source: `docs/trace-format.md`, "Digest of a triangulation".
pub fn triangulation_digest(t: &Triangulation3) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut bytes = Vec::with_capacity(1 << 16);
    let mut put = |part: &[u8]| {
        bytes.extend_from_slice(part);
        if bytes.len() >= (1 << 16) - 8 || part.is_empty() {
            hasher.update(&bytes);
            bytes.clear();
        }
    };
    put(&(t.points.len() as u64).to_le_bytes());
    for p in &t.points {
        [p.at.x, p.at.y, p.at.z, p.weight].iter().for_each(|x| put(&x.to_bits().to_le_bytes()));
    }
    for state in &t.states {
        let code = match state {
            PointState::Vertex => u32::MAX,
            PointState::Hidden => u32::MAX - 1,
            PointState::Removed => u32::MAX - 2,
            PointState::Duplicate { of } => of.0,
        };
        put(&code.to_le_bytes());
    }
    put(&[t.dimension.unwrap_or(u8::MAX)]);
    put(&(t.simplices().len() as u64).to_le_bytes());
    // An empty part hashes what is left.
    put(&[]);
    for ids in t.simplices.chunks(1 << 14) {
        bytes.resize(4 * ids.len(), 0);
        bytes.as_chunks_mut().0.iter_mut().zip(ids).for_each(|(b, v)| *b = v.0.to_le_bytes());
        hasher.update(&bytes);
    }
    hasher.finalize().to_hex().to_string()
}
