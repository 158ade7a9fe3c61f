//! Points of the plane.

/// A point with finite coordinates, in input units at the borders of the library and scaled by a power of two below them.
///
/// glam carries the coordinates; its arithmetic decides nothing below the viewer.
pub type Point2 = glam::DVec2;
