//! Point sets and triangulations of space, as plain data.

use super::{Point3, VertexId, WeightedPoint};

/// Points of space, perhaps with weights, as read from a file. Coordinates in input units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointSet3 {
    /// Coordinates, in the order of the input.
    pub points: Vec<Point3>,
    /// Weight (squared radius) of each point; empty if the input had none, and then all are 0.
    pub weights: Vec<f64>,
    /// Boundary marker of each point; empty if the input had none.
    pub point_markers: Vec<i32>,
    /// Where each point stood in the file: one-based lines (or rows, where the format has no lines); empty if unknown.
    pub lines: Vec<u32>,
}

impl PointSet3 {
    /// The points with their weights.
    pub fn weighted(&self) -> impl ExactSizeIterator<Item = WeightedPoint> + '_ {
        self.points
            .iter()
            .enumerate()
            .map(|(i, &at)| WeightedPoint { at, weight: self.weights.get(i).copied().unwrap_or(0.0) })
    }
}

/// What became of a point in a triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointState {
    /// It is a vertex.
    Vertex,
    /// Its weight is too small for it to be a vertex: it is not in conflict with the cell that contains it.
    Hidden,
    /// A point of the same place and weight with a smaller id stands for it (that one may itself be hidden).
    Duplicate {
        /// The point that stands for it.
        of: VertexId,
    },
    /// It was removed.
    Removed,
}

/// A (weighted) Delaunay triangulation of points in space, in input units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation3 {
    /// The points, with their weights.
    pub points: Vec<WeightedPoint>,
    /// What became of each point.
    pub states: Vec<PointState>,
    /// The dimension of the affine hull of the points: 0 to 3; `None` without points.
    pub dimension: Option<u8>,
    /// The simplices of that dimension, `dimension + 1` ids each, in one run. Each tuple is ascending, save that a tetrahedron has its last two
    /// ids swapped where ascending order is negatively oriented; the tuples stand in ascending order.
    pub simplices: Vec<VertexId>,
}

impl Triangulation3 {
    /// How many ids a simplex has; 0 without points.
    pub fn simplex_size(&self) -> usize {
        self.dimension.map_or(0, |d| usize::from(d) + 1)
    }

    /// The simplices as slices of ids.
    pub fn simplices(&self) -> impl ExactSizeIterator<Item = &[VertexId]> + '_ {
        // Without points there are no ids, so that any size of chunk will do.
        self.simplices.chunks_exact(self.simplex_size().max(1))
    }
}
