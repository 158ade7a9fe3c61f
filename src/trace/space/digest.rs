//! The digest of a triangulation of space.

use crate::model::{PointState, Triangulation3, VertexId, WeightedPoint};
use crate::trace::digest::Hash;

/// blake3 of the canonical form of a triangulation, in hexadecimal. Source: `docs/trace-format.md`, "Digest of a triangulation".
pub fn triangulation_digest(t: &Triangulation3) -> String {
    let points = t.points.iter().copied();
    let mut digest = TriangulationDigest::new(points, t.states.iter().copied(), t.dimension, t.simplices().len());
    digest.simplices(&t.simplices);
    digest.finish()
}

/// The same under way, for those who have no `Triangulation3` in memory.
pub(crate) struct TriangulationDigest(Hash);

impl TriangulationDigest {
    /// With all but the simplices, of which there will be so many.
    pub fn new(
        points: impl ExactSizeIterator<Item = WeightedPoint>,
        states: impl Iterator<Item = PointState>,
        dimension: Option<u8>,
        simplices: usize,
    ) -> TriangulationDigest {
        let mut hash = Hash::default();
        hash.put(&(points.len() as u64).to_le_bytes());
        for p in points {
            [p.at.x, p.at.y, p.at.z, p.weight].iter().for_each(|x| hash.put(&x.to_bits().to_le_bytes()));
        }
        for state in states {
            let code = match state {
                PointState::Vertex => u32::MAX,
                PointState::Hidden => u32::MAX - 1,
                PointState::Removed => u32::MAX - 2,
                PointState::Duplicate { of } => of.0,
            };
            hash.put(&code.to_le_bytes());
        }
        hash.put(&[dimension.unwrap_or(u8::MAX)]);
        hash.put(&(simplices as u64).to_le_bytes());
        TriangulationDigest(hash)
    }

    /// The next simplices, canonical and ascending.
    pub fn simplices(&mut self, ids: &[VertexId]) {
        self.0.put_ids(ids);
    }

    /// In hexadecimal.
    pub fn finish(self) -> String {
        self.0.finish()
    }
}
