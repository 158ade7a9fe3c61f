//! What the vertices and cells of a triangulation are called in its trace.
//!
//! A trace places the apexes by a rule of its own, since the complex does not depend on where they are but for its orientation.

use crate::arith::space::{Kernel3, WeightedCorners};
use crate::model::{Point3, Sign, Tetrahedron, VertexId, WeightedPoint, canonical_tetrahedron};
use crate::trace::{Apex, apex_id};
use crate::triangulation::regular3::{CellId, Regular3, apex, is_apex};

/// How a trace names the vertices of a triangulation.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    /// The apexes in their places.
    pub(super) apexes: Vec<Apex>,
    /// For each apex of the triangulation that of the trace.
    renamed: [u32; 3],
    /// With the apexes of the trace cells are oriented the other way.
    mirrored: bool,
}

impl Names {
    /// For a triangulation of at least one point.
    pub(super) fn of<K: Kernel3>(t: &Regular3<K>) -> Names {
        let mut names = Names::default();
        let Some(cell) = t.cells().find(|&c| t.is_finite(c)).map(|c| t.vertices(c)) else {
            return names;
        };
        let points: Vec<Point3> = cell.iter().filter(|&&v| !is_apex(v)).map(|&v| t.point(v).at).collect();
        names.apexes = apexes_of::<K>(&points);
        let used = (0..3).filter(|&k| cell.contains(&apex(k)));
        for (own, k) in (0..).zip(used) {
            names.renamed[k as usize] = own;
        }
        let [a, b, c, d] = cell.map(|v| names.place(t, v).at);
        names.mirrored = K::orient3d(a, b, c, d).is_negative();
        names
    }

    /// A vertex in its place, an apex in that of the trace.
    pub(super) fn place<K: Kernel3>(&self, t: &Regular3<K>, v: VertexId) -> WeightedPoint {
        match is_apex(v) {
            true => WeightedPoint::unweighted(self.apexes[self.renamed[apex_number(v)] as usize].place()),
            false => t.point(v),
        }
    }

    /// The corners of a tetrahedron in their places, positively oriented.
    pub(super) fn places<K: Kernel3>(&self, t: &Regular3<K>, c: CellId) -> WeightedCorners {
        let [a, b, c, d] = t.vertices(c).map(|v| self.place(t, v));
        if self.mirrored { [b, a, c, d] } else { [a, b, c, d] }
    }

    /// Whether q lies in the affine hull of the points of a triangulation of less than three dimensions.
    pub(super) fn is_flat<K: Kernel3>(&self, t: &Regular3<K>, q: Point3) -> bool {
        let cell = t.cells().find(|&c| t.is_finite(c)).map(|c| t.vertices(c));
        let points = cell.into_iter().flatten().filter(|&v| !is_apex(v)).map(|v| t.point(v).at);
        !independent::<K>(&mut points.chain([q]).collect())
    }

    /// The corners of a cell by the names of the trace, positively oriented there.
    pub(super) fn corners(&self, v: [VertexId; 4]) -> [VertexId; 4] {
        if self.apexes.is_empty() {
            return v;
        }
        let [a, b, c, d] = v.map(|v| if is_apex(v) { apex_id(self.renamed[apex_number(v)]) } else { v });
        if self.mirrored { [b, a, c, d] } else { [a, b, c, d] }
    }

    /// Of the tetrahedra that contain the hidden point v, one of them given, the last in canonical order: they hang together by facets in whose
    /// planes v is.
    pub(super) fn last_around<K: Kernel3>(&self, t: &Regular3<K>, cell: CellId, v: VertexId) -> Tetrahedron {
        let q = t.point(v).at;
        let tuple = |c: CellId| canonical_tetrahedron(self.corners(t.vertices(c)));
        let on_facet = |v: [VertexId; 4], k: usize| {
            let mut p = v.map(|v| self.place(t, v).at);
            p[k] = q;
            K::orient3d(p[0], p[1], p[2], p[3]) == Sign::Zero
        };
        let mut seen = vec![cell];
        let mut next = 0;
        while let Some(&c) = seen.get(next) {
            next += 1;
            for k in 0..4 {
                let beyond = t.neighbor(c, k);
                if t.is_finite(beyond) && on_facet(t.vertices(c), k) && !seen.contains(&beyond) {
                    seen.push(beyond);
                }
            }
        }
        // `seen` begins with the cell given.
        seen.into_iter().map(tuple).max().unwrap_or_else(|| tuple(cell))
    }
}

fn apex_number(v: VertexId) -> usize {
    (apex(0).0 - v.0) as usize
}

/// The apexes of affinely independent points: each the first of the six that is independent of them and those before.
fn apexes_of<K: Kernel3>(points: &[Point3]) -> Vec<Apex> {
    let mut all = points.to_vec();
    let mut chosen = Vec::new();
    while all.len() < 4 {
        let next = Apex::ALL.into_iter().find(|apex| {
            all.push(apex.place());
            let good = independent::<K>(&mut all);
            all.pop();
            good
        });
        let Some(apex) = next else { break };
        all.push(apex.place());
        chosen.push(apex);
    }
    chosen
}

/// Whether points are affinely independent: whether some of the six apexes, which are in no plane, make a tetrahedron of them.
fn independent<K: Kernel3>(points: &mut Vec<Point3>) -> bool {
    if let [a, b, c, d] = points[..] {
        return K::orient3d(a, b, c, d) != Sign::Zero;
    }
    Apex::ALL.iter().any(|apex| {
        points.push(apex.place());
        let good = independent::<K>(points);
        points.pop();
        good
    })
}
