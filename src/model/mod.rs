//! Floor 0: plain data. No arithmetic and no decision lives here. (`words` turns numbers into sentences, for the messages of all floors.)

mod ids;
mod mesh;
mod mesh3;
mod parameters;
mod point;
mod pslg;
mod sign;
mod simplex;
pub mod words;

pub use ids::{SegmentId, VertexId};
pub use mesh::{Mesh2, MeshEdge, VertexKind};
pub use mesh3::{PointSet3, PointState, Triangulation3};
pub use parameters::{
    Choice, DeletionPolicy, DiskChoice, GcdrParameters, Level, QueueOrder, SmallAngles, VertexOfTriangle,
};
pub use point::{Point2, Point3, WeightedPoint};
pub use pslg::{Fill, Lines, Pslg, Region, Segment};
pub use sign::Sign;
pub use simplex::{Edge, Facet, Tetrahedron, Triangle, canonical_tetrahedron, canonical_triangle};
