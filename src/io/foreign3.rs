//! A tetrahedral mesh as some program wrote it, with nothing taken for granted but that its indices exist.

use super::{ForeignEdge, Note, NoteKind};
use crate::domain::face_one_way;
use crate::model::{Point3, PointSet3, Triangulation3, VertexId};

/// A mesh of space from a file. Coordinates are in the units of the file; elements stand as given, in any orientation, perhaps degenerate.
///
/// Of elements of second order only the corners are kept, and their nodes between corners are not among the points (a note says so).
/// Points that no element names are: in a weighted triangulation they are hidden.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForeignMesh3 {
    /// Coordinates.
    pub points: Vec<Point3>,
    /// Weight (squared radius, units squared) of each point; empty if the file had none.
    pub weights: Vec<f64>,
    /// Boundary marker of each point; empty if the file had none.
    pub point_markers: Vec<i32>,
    /// Tetrahedra by their corners.
    pub tetrahedra: Vec<[VertexId; 4]>,
    /// Region attribute of each tetrahedron; empty if the file had none.
    pub tetrahedron_attributes: Vec<f64>,
    /// Triangles that the file lists as elements: the boundary of most meshes, all of a triangulation of points in one plane.
    pub triangles: Vec<ForeignTriangle>,
    /// Edges that the file lists as elements.
    pub edges: Vec<ForeignEdge>,
    /// Where the elements stood.
    pub lines: MeshLines3,
    /// What the reader left out.
    pub notes: Vec<Note>,
}

/// A triangle in space with its marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignTriangle {
    /// Its corners, as given.
    pub corners: [VertexId; 3],
    /// Its marker; 0 if the file gave none.
    pub marker: i32,
}

/// Lines of the elements of a `ForeignMesh3`: one-based, 0 if unknown (binary data). Vectors may be empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshLines3 {
    /// Line of each point.
    pub points: Vec<u32>,
    /// Line of each tetrahedron.
    pub tetrahedra: Vec<u32>,
    /// Line of each triangle.
    pub triangles: Vec<u32>,
    /// Line of each edge.
    pub edges: Vec<u32>,
}

impl ForeignMesh3 {
    /// The points with weights and markers.
    #[must_use]
    pub fn point_set(&self) -> PointSet3 {
        PointSet3 {
            points: self.points.clone(),
            weights: self.weights.clone(),
            point_markers: self.point_markers.clone(),
            lines: self.lines.points.clone(),
        }
    }

    /// The facets that one tetrahedron has and no other, counterclockwise seen from outside if that tetrahedron is positively oriented, in ascending order of their
    /// sorted corners.
    #[must_use]
    pub fn boundary(&self) -> Vec<[VertexId; 3]> {
        let mut facets = Vec::with_capacity(4 * self.tetrahedra.len());
        for &[a, b, c, d] in &self.tetrahedra {
            for facet in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
                let mut key = facet;
                key.sort_unstable();
                facets.push((key, facet));
            }
        }
        facets.sort_unstable();
        let alone = facets.chunk_by(|f, g| f.0 == g.0).filter(|same| same.len() == 1);
        alone.map(|same| same[0].1).collect()
    }

    /// Leaves out the points that are nodes of second-order elements and corners of none, of which `middle` names each at least once.
    pub(super) fn drop_middle_nodes(&mut self, middle: &[VertexId]) {
        let mut keep = vec![true; self.points.len()];
        middle.iter().for_each(|v| keep[v.index()] = false);
        let corners = self.tetrahedra.iter().flatten();
        let corners = corners.chain(self.triangles.iter().flat_map(|t| &t.corners));
        corners.chain(self.edges.iter().flat_map(|e| &e.ends)).for_each(|v| keep[v.index()] = true);
        let dropped = keep.iter().filter(|&&k| !k).count();
        if dropped == 0 {
            return;
        }
        let mut next = 0;
        let ids: Vec<VertexId> = keep
            .iter()
            .map(|&k| {
                next += u32::from(k);
                // Those left out are never looked up.
                VertexId(next.wrapping_sub(1))
            })
            .collect();
        let corners = self.tetrahedra.iter_mut().flatten();
        let corners = corners.chain(self.triangles.iter_mut().flat_map(|t| &mut t.corners));
        corners.chain(self.edges.iter_mut().flat_map(|e| &mut e.ends)).for_each(|v| *v = ids[v.index()]);
        retain(&mut self.points, &keep);
        retain(&mut self.weights, &keep);
        retain(&mut self.point_markers, &keep);
        retain(&mut self.lines.points, &keep);
        self.notes.push(Note {
            kind: NoteKind::Note,
            line: 0,
            text: format!("the elements are of second order; {dropped} nodes between corners are left out"),
        });
    }
}

/// Keeps the items of a vector that a list of the same length marks; an empty vector stays empty.
fn retain<T>(items: &mut Vec<T>, keep: &[bool]) {
    let mut marks = keep.iter();
    items.retain(|_| marks.next().copied().unwrap_or(true));
}

impl From<&Triangulation3> for ForeignMesh3 {
    /// Simplices become elements of their dimension without markers; in dimension 0 there are points only. Triangles face one way (`domain::face_one_way`). Weights are left out if all are 0.
    fn from(t: &Triangulation3) -> ForeignMesh3 {
        let mut mesh = ForeignMesh3 { points: t.points.iter().map(|p| p.at).collect(), ..ForeignMesh3::default() };
        if t.points.iter().any(|p| p.weight.to_bits() != 0) {
            mesh.weights = t.points.iter().map(|p| p.weight).collect();
        }
        for simplex in t.simplices() {
            match *simplex {
                [a, b, c, d] => mesh.tetrahedra.push([a, b, c, d]),
                [a, b, c] => mesh.triangles.push(ForeignTriangle { corners: [a, b, c], marker: 0 }),
                [a, b] => mesh.edges.push(ForeignEdge { ends: [a, b], marker: 0 }),
                _ => {}
            }
        }
        face_one_way(&mesh.points, mesh.triangles.iter_mut().map(|t| &mut t.corners));
        mesh
    }
}
