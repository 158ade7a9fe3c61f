//! Typed indices.

use serde::{Deserialize, Serialize};

/// A vertex. Input vertices come first, in the order of the input; then one id per insertion. Ids are never reused.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct VertexId(pub u32);

/// An input segment, by its position among the segments of the (repaired) input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SegmentId(pub u32);

impl VertexId {
    /// The id as an index into a vertex array.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl SegmentId {
    /// The id as an index into a segment array.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
