//! The digest of a triangulation of space.

use crate::model::{PointState, Triangulation3, VertexId, WeightedPoint};

/// blake3 of the canonical form of a triangulation, in hexadecimal. Source: `docs/trace-format.md`, "Digest of a triangulation".
pub fn triangulation_digest(t: &Triangulation3) -> String {
    let points = t.points.iter().copied();
    let mut digest = TriangulationDigest::new(points, t.states.iter().copied(), t.dimension, t.simplices().len());
    digest.simplices(&t.simplices);
    digest.finish()
}

/// The same under way, for those who have no `Triangulation3` in memory.
pub(crate) struct TriangulationDigest {
    hasher: blake3::Hasher,
    bytes: Vec<u8>,
}

impl TriangulationDigest {
    /// With all but the simplices, of which there will be so many.
    pub fn new(
        points: impl ExactSizeIterator<Item = WeightedPoint>,
        states: impl Iterator<Item = PointState>,
        dimension: Option<u8>,
        simplices: usize,
    ) -> TriangulationDigest {
        let mut hasher = blake3::Hasher::new();
        let mut bytes = Vec::with_capacity(1 << 16);
        let mut put = |part: &[u8]| {
            bytes.extend_from_slice(part);
            if bytes.len() >= (1 << 16) - 8 || part.is_empty() {
                hasher.update(&bytes);
                bytes.clear();
            }
        };
        put(&(points.len() as u64).to_le_bytes());
        for p in points {
            [p.at.x, p.at.y, p.at.z, p.weight].iter().for_each(|x| put(&x.to_bits().to_le_bytes()));
        }
        for state in states {
            let code = match state {
                PointState::Vertex => u32::MAX,
                PointState::Hidden => u32::MAX - 1,
                PointState::Removed => u32::MAX - 2,
                PointState::Duplicate { of } => of.0,
            };
            put(&code.to_le_bytes());
        }
        put(&[dimension.unwrap_or(u8::MAX)]);
        put(&(simplices as u64).to_le_bytes());
        // An empty part hashes what is left.
        put(&[]);
        TriangulationDigest { hasher, bytes }
    }

    /// The next simplices, canonical and ascending.
    pub fn simplices(&mut self, ids: &[VertexId]) {
        for ids in ids.chunks(1 << 14) {
            self.bytes.resize(4 * ids.len(), 0);
            self.bytes.as_chunks_mut().0.iter_mut().zip(ids).for_each(|(b, v)| *b = v.0.to_le_bytes());
            self.hasher.update(&self.bytes);
        }
    }

    /// In hexadecimal.
    pub fn finish(self) -> String {
        self.hasher.finalize().to_hex().to_string()
    }
}
