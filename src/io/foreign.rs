//! A triangle mesh as some mesher wrote it, with nothing taken for granted but that its indices exist.

use super::Note;
use crate::model::{Edge, Mesh2, MeshEdge, Point2, SegmentId, VertexId, VertexKind};

/// A planar mesh from a file. Coordinates are in the units of the file; triangles stand as given, in any orientation, perhaps degenerate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForeignMesh {
    /// Coordinates.
    pub points: Vec<Point2>,
    /// Boundary marker of each vertex; empty if the file had none.
    pub point_markers: Vec<i32>,
    /// Attributes, `attributes_per_point` numbers a vertex, in one run.
    pub attributes: Vec<f64>,
    /// How many attributes a vertex carries.
    pub attributes_per_point: usize,
    /// Triangles by their corners.
    pub triangles: Vec<[VertexId; 3]>,
    /// Region attribute of each triangle; empty if the file had none.
    pub triangle_attributes: Vec<f64>,
    /// Constrained edges, as far as the format tells them.
    pub edges: Vec<ForeignEdge>,
    /// Where the elements stood.
    pub lines: MeshLines,
    /// What the reader left out.
    pub notes: Vec<Note>,
}

/// An edge with its marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignEdge {
    /// Its ends, as given.
    pub ends: [VertexId; 2],
    /// Its marker; 0 if the file gave none.
    pub marker: i32,
}

/// Lines of the elements of a `ForeignMesh`: one-based, 0 if unknown. Vectors may be empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshLines {
    /// Line of each vertex.
    pub points: Vec<u32>,
    /// Line of each triangle.
    pub triangles: Vec<u32>,
    /// Line of each edge.
    pub edges: Vec<u32>,
}

impl ForeignMesh {
    /// The mesh in the form that writers take: every vertex an input vertex, every edge a segment of its own. Triangles keep their
    /// orientation and order, so that the result need not be canonical.
    #[must_use]
    pub fn into_mesh(self) -> Mesh2 {
        let n = self.points.len();
        let edge = |(i, e): (usize, &ForeignEdge)| {
            let [a, b] = e.ends;
            let ends: Edge = if a <= b { [a, b] } else { [b, a] };
            // Readers hold every count below 2^31.
            MeshEdge { ends, marker: e.marker, segment: SegmentId(i as u32) }
        };
        Mesh2 {
            kinds: vec![VertexKind::Input; n],
            point_markers: if self.point_markers.is_empty() { vec![0; n] } else { self.point_markers },
            edges: self.edges.iter().enumerate().map(edge).collect(),
            points: self.points,
            attributes: self.attributes,
            attributes_per_point: self.attributes_per_point,
            triangles: self.triangles,
            triangle_attributes: self.triangle_attributes,
        }
    }
}

impl From<&Mesh2> for ForeignMesh {
    fn from(mesh: &Mesh2) -> ForeignMesh {
        ForeignMesh {
            points: mesh.points.clone(),
            point_markers: mesh.point_markers.clone(),
            attributes: mesh.attributes.clone(),
            attributes_per_point: mesh.attributes_per_point,
            triangles: mesh.triangles.clone(),
            triangle_attributes: mesh.triangle_attributes.clone(),
            edges: mesh.edges.iter().map(|e| ForeignEdge { ends: e.ends, marker: e.marker }).collect(),
            ..ForeignMesh::default()
        }
    }
}
