//! What a replay has come to: the mesh, its edges, the smallest input angle. For `replay` and for the rows of spacing.

use super::checker::{Checker, State};
use super::claims::subsegments;
use super::complex::{Kind, NONE, canonical};
use super::predicates::{dot, norm2, vector};
use super::scale::power_of_two;
use super::value::{Number, sign_of};
use crate::model::{Edge, Mesh2, MeshEdge, Point2, SegmentId, VertexId, VertexKind};

impl Checker {
    /// The mesh after the last record, input units. Vertices carry no attributes, and only those inserted on segments a marker: the
    /// checker keeps none of the others. Empty before the first event or the end, since `start` is proved only then.
    pub fn mesh(&self) -> Mesh2 {
        let State { mesh, exponent, segments, regions } = self.state();
        let scale = power_of_two(exponent);
        let mut dense = vec![NONE; mesh.vertices.len()];
        let mut out = Mesh2::default();
        for (v, vertex) in mesh.vertices.iter().enumerate() {
            let (kind, marker) = match vertex.kind {
                Kind::Deleted => continue,
                Kind::Input => (VertexKind::Input, 0),
                Kind::Free => (VertexKind::Free, 0),
                Kind::B(s) | Kind::C(s) => (VertexKind::Segment(SegmentId(s)), segments[s as usize].marker),
            };
            dense[v] = out.points.len() as u32;
            out.points.push(Point2::new(vertex.at.x * scale, vertex.at.y * scale));
            out.kinds.push(kind);
            out.point_markers.push(marker);
        }
        let dense = |v: u32| VertexId(dense[v as usize]);
        let mut triangles: Vec<_> =
            mesh.triangles().map(|t| (canonical(mesh.corners(t)).map(dense), mesh.facts(t).region)).collect();
        triangles.sort_unstable();
        out.triangles = triangles.iter().map(|(t, _)| *t).collect();
        if !regions.is_empty() {
            let attribute = |region: u32| regions.get(region as usize).map_or(0.0, |r| r.attribute);
            out.triangle_attributes = triangles.iter().map(|(_, region)| attribute(*region)).collect();
        }
        let edge = |[u, v, s]: [u32; 3]| MeshEdge {
            ends: [dense(u), dense(v)],
            marker: segments[s as usize].marker,
            segment: SegmentId(s),
        };
        out.edges = subsegments(mesh).into_iter().map(edge).collect();
        out.edges.sort_unstable_by_key(|e| (e.ends, e.segment));
        out
    }

    /// Every edge of the region once, by ids of the run.
    pub fn edges(&self) -> Vec<Edge> {
        let mesh = self.state().mesh;
        let corners = mesh.triangles().map(|t| mesh.corners(t));
        let mut edges: Vec<Edge> = corners
            .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[u, v]| [VertexId(u.min(v)), VertexId(u.max(v))])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The smallest input angle below 90 degrees inside the region: its vertex and a point on each side.
    pub fn smallest_angle(&self) -> Option<[VertexId; 3]> {
        let mesh = self.state().mesh;
        let places = |sector: [u32; 3]| sector.map(|v| mesh.at(v));
        let acute = self.sectors().iter().copied().filter(|s| sign_of!(cosine(places(*s))).is_positive());
        let sharper = |a: [u32; 3], b: [u32; 3]| {
            if sign_of!(difference(places(a), places(b))).is_negative() { b } else { a }
        };
        acute.reduce(sharper).map(|sector| sector.map(VertexId))
    }
}

/// The cosine of an acute angle, times the lengths of its sides.
fn cosine<N: Number>([apex, p, q]: [Point2; 3]) -> N {
    dot(&vector::<N>(apex, p), &vector::<N>(apex, q))
}

/// Positive if the first of two acute angles is smaller: cos^2 a - cos^2 b, times positive factors.
fn difference<N: Number>(a: [Point2; 3], b: [Point2; 3]) -> N {
    let sides2 = |[apex, p, q]: [Point2; 3]| norm2(&vector::<N>(apex, p)) * norm2(&vector::<N>(apex, q));
    let square = |x: N| x.clone() * x;
    square(cosine::<N>(a)) * sides2(b) - square(cosine::<N>(b)) * sides2(a)
}
