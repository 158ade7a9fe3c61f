//! A finished planar mesh, as written to files and as hashed by traces.

use super::{Edge, Point2, SegmentId, Triangle, VertexId};
use serde::{Deserialize, Serialize};

/// Where a vertex came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VertexKind {
    /// A vertex of the input.
    Input,
    /// A Steiner point inside the region (Type-A).
    Free,
    /// A Steiner point on an input segment (Type-B or Type-C).
    Segment(SegmentId),
}

/// A planar mesh in input units. Ids of deleted vertices are gone: `points` is dense, in ascending order of the ids the run gave.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh2 {
    /// Coordinates.
    pub points: Vec<Point2>,
    /// Origin of each vertex.
    pub kinds: Vec<VertexKind>,
    /// Boundary marker of each vertex, as in Triangle: the input's, else that of its segment, else 0.
    pub point_markers: Vec<i32>,
    /// Attributes, `attributes_per_point` numbers a vertex; Steiner points carry zeros.
    pub attributes: Vec<f64>,
    /// How many attributes a vertex carries.
    pub attributes_per_point: usize,
    /// Triangles in canonical form (`canonical_triangle`), in ascending order.
    pub triangles: Vec<Triangle>,
    /// Region attribute of each triangle; empty if the input had no region.
    pub triangle_attributes: Vec<f64>,
    /// Subsegments of the input in the mesh, in ascending order of ends.
    pub edges: Vec<MeshEdge>,
}

/// A subsegment of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshEdge {
    /// Its ends, the smaller first (indices into `Mesh2::points`).
    pub ends: Edge,
    /// The marker of its input segment.
    pub marker: i32,
    /// Its input segment.
    pub segment: SegmentId,
}

impl Mesh2 {
    /// The corners of a triangle.
    pub fn corners(&self, t: Triangle) -> [Point2; 3] {
        t.map(|VertexId(v)| self.points[v as usize])
    }
}
