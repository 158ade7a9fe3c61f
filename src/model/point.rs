//! Points of the plane and of space.

/// A point with finite coordinates, in input units at the borders of the library and scaled by a power of two below them.
///
/// glam carries the coordinates; its arithmetic decides nothing below the viewer.
pub type Point2 = glam::DVec2;

/// A point of space; as `Point2` otherwise.
pub type Point3 = glam::DVec3;

/// A point of space with a weight, which is a squared radius (input units squared) and may be zero or negative.
///
/// The power distance of two weighted points is |p - q|^2 - w_p - w_q. With all weights equal a regular triangulation is the Delaunay
/// triangulation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WeightedPoint {
    /// Coordinates.
    pub at: Point3,
    /// Weight.
    pub weight: f64,
}

impl WeightedPoint {
    /// A point of weight zero.
    pub fn unweighted(at: Point3) -> Self {
        WeightedPoint { at, weight: 0.0 }
    }
}
