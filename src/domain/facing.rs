//! Which way the triangles of a plane in space face.
//!
//! Problem: a triangulation names its simplices by ascending vertices; a file of triangles is read by programs to which the order of corners is a side.
//! Idea: seen along an axis that a plane is not parallel to, all its triangles keep their turn, or all of them lose it.

use super::normalise3;
use crate::arith::{FastKernel, Kernel};
use crate::model::{Point2, Point3, PointSet3, Sign, VertexId};

/// Turns all triangles of points of one plane to the same side: counterclockwise seen from far up the z axis, or if the plane is parallel to that, the y or
/// else the x axis. Triangles of points out of range stay as they are, and so do flat ones.
pub fn face_one_way<'a>(points: &[Point3], triangles: impl Iterator<Item = &'a mut [VertexId; 3]>) {
    let set = PointSet3 { points: points.to_vec(), ..PointSet3::default() };
    let Ok((normal, _)) = normalise3(&set) else { return };
    for t in triangles {
        let [a, b, c] = t.map(|v| normal[v.index()].at);
        let sights: [fn(Point3) -> Point2; 3] =
            [|p| Point2::new(p.x, p.y), |p| Point2::new(p.z, p.x), |p| Point2::new(p.y, p.z)];
        let mut turns = sights.iter().map(|see| FastKernel::orient2d(see(a), see(b), see(c)));
        if turns.find(|&s| s != Sign::Zero) == Some(Sign::Negative) {
            t.swap(1, 2);
        }
    }
}
