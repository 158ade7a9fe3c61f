//! The statement of a planar domain: a planar straight line graph, its holes and its regions.

use super::{Point2, VertexId};
use serde::{Deserialize, Serialize};

/// A planar straight line graph with what is to be meshed of it. Coordinates are in input units.
///
/// A value of this type is only data. `domain::prepare` decides whether it can be meshed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pslg {
    /// Vertices, in the order of the input.
    pub points: Vec<Point2>,
    /// Boundary marker per vertex; empty if the input had none.
    pub point_markers: Vec<i32>,
    /// Attributes, `attributes_per_point` numbers a vertex, in one run.
    pub attributes: Vec<f64>,
    /// How many attributes a vertex carries.
    pub attributes_per_point: usize,
    /// Segments, in the order of the input.
    pub segments: Vec<Segment>,
    /// A point inside each hole.
    pub holes: Vec<Point2>,
    /// Seeds of regions with an attribute and perhaps an area bound.
    pub regions: Vec<Region>,
    /// Which faces are meshed.
    pub fill: Fill,
}

/// An input segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Its end vertices.
    pub ends: [VertexId; 2],
    /// Its boundary marker; 0 if the input gave none.
    pub marker: i32,
    /// Under `Fill::Parity`: whether crossing it changes between inside and outside.
    pub toggles: bool,
}

/// A seed of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// A point strictly inside the region.
    pub seed: Point2,
    /// The attribute its triangles carry.
    pub attribute: f64,
    /// Largest area of a triangle of the region, in input units squared.
    pub max_area: Option<f64>,
}

/// Which faces of the graph are meshed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fill {
    /// All that segments separate from the outside, less the faces that hold a hole seed (`.poly`).
    #[default]
    Seeds,
    /// All faces reached from outside by crossing an odd number of toggling segments, less hole seeds (WKT, GeoJSON).
    Parity,
    /// The whole convex hull, less hole seeds (`--convex`); edges of the hull become segments.
    Convex,
}

/// Where the elements of a `Pslg` stood in the file: one-based lines, 0 if unknown. Vectors may be empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// Line of each vertex.
    pub points: Vec<u32>,
    /// Line of each segment.
    pub segments: Vec<u32>,
    /// Line of each hole seed.
    pub holes: Vec<u32>,
    /// Line of each region seed.
    pub regions: Vec<u32>,
}
