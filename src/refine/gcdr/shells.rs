//! Small input angles: apexes, concentric shells, and the triangles that such an angle makes skinny.
//!
//! Source: `docs/gcdr.md`, small input angles (outside the theorem).

use super::queue::shortest_edge;
use super::{Kind, Refiner, Rung};
use crate::arith::{Kernel, scale};
use crate::model::{Choice, Point2, SegmentId, VertexId};
use crate::trace::{Shell, SplitKind};
use crate::triangulation::cdt2::{Cdt2, HalfEdge, TriId};
use std::cmp::Ordering;

/// cos^2 of 60 degrees.
const COS2_60: f64 = 0.25;

/// Whether the angle at `apex` between p and q is below 60 degrees.
pub(super) fn is_small<K: Kernel>(apex: Point2, p: Point2, q: Point2) -> bool {
    K::compare_cos2(apex, p, q, COS2_60) == Ordering::Greater
}

/// The sectors around v that lie inside the region, between consecutive constrained edges: pairs of edges with origin v,
/// the second counterclockwise of the first, less than a half turn apart.
pub(crate) fn convex_sectors<K: Kernel>(cdt: &Cdt2<K>, v: VertexId) -> Vec<[HalfEdge; 2]> {
    let mut sectors = Vec::new();
    for first in cdt.edges_around(v).filter(|&e| cdt.segment(e).is_some()) {
        // turn counterclockwise through the triangles at v up to the next constrained edge
        let mut e = first;
        let end = loop {
            let far = cdt.prev(e);
            if cdt.segment(far).is_some() {
                break Some(far);
            }
            match cdt.twin(far) {
                Some(next) if next != first => e = next,
                _ => break None,
            }
        };
        if let Some(end) = end {
            let (a, b) = (cdt.point(cdt.destination(first)), cdt.point(cdt.origin(end)));
            if K::orient2d(cdt.point(v), a, b).is_positive() {
                sectors.push([first, end]);
            }
        }
    }
    sectors
}

impl<K: Kernel> Refiner<'_, '_, K> {
    /// Marks the apexes of the initial triangulation.
    pub(super) fn find_apexes(&mut self) {
        let inputs = self.kinds.len() as u32;
        self.apexes = (0..inputs)
            .map(VertexId)
            .map(|v| {
                convex_sectors(&self.cdt, v).into_iter().any(|[a, b]| {
                    let (p, q) = (self.cdt.destination(a), self.cdt.origin(b));
                    is_small::<K>(self.cdt.point(v), self.cdt.point(p), self.cdt.point(q))
                })
            })
            .collect();
    }

    pub(super) fn is_apex(&self, v: VertexId) -> bool {
        self.apexes.get(v.index()).copied().unwrap_or(false)
    }

    /// The apex whose small angle makes the skinny triangle t unavoidable, if there is one.
    pub(super) fn excusing_apex(&self, t: TriId) -> Option<VertexId> {
        let (ids, corners) = (self.cdt.vertices(t), self.cdt.corners(t));
        let [i, j] = shortest_edge::<K>(ids, corners);
        let k = 3 - i - j;
        self.seditious(ids[i], ids[j]).or_else(|| {
            let edges = self.cdt.edges(t);
            let (at_j, at_k) = (self.cdt.segment(edges[j]), self.cdt.segment(edges[k]));
            let small = self.is_apex(ids[k])
                && at_j.is_some()
                && at_k.is_some()
                && at_j != at_k
                && is_small::<K>(corners[k], corners[i], corners[j]);
            small.then_some(ids[k])
        })
    }

    /// The apex from which x and y have equal nominal distances, on different segments below 60 degrees apart.
    fn seditious(&self, x: VertexId, y: VertexId) -> Option<VertexId> {
        let on_segment = |v: VertexId| match self.kinds[v.index()] {
            Kind::Segment { segment, rung } => rung.map(|rung| (segment, rung)),
            _ => None,
        };
        let ((s1, a), (s2, b)) = (on_segment(x)?, on_segment(y)?);
        let small = a == b && s1 != s2 && {
            let far = |s: SegmentId| {
                let [u, v] = self.segments[s.index()];
                self.cdt.point(if u == a.apex { v } else { u })
            };
            is_small::<K>(self.cdt.point(a.apex), far(s1), far(s2))
        };
        small.then_some(a.apex)
    }

    /// The rung of a point that splits uv: 2^k on a shell; halfway between two rungs of one apex for a midpoint.
    pub(super) fn rung(&self, s: [VertexId; 2], kind: SplitKind, shell: Option<Shell>) -> Option<Rung> {
        if let Some(Shell { apex, k }) = shell {
            return Some(Rung { apex, distance: scale::by_power_of_two(1.0, k) });
        }
        let choice = if kind == SplitKind::B { self.params.choice_b } else { self.params.choice_c };
        let rung_of = |v: VertexId| match self.kinds[v.index()] {
            Kind::Segment { rung, .. } => rung,
            _ => None,
        };
        let [a, b] = [rung_of(s[0])?, rung_of(s[1])?];
        let halfway = choice == Choice::Center && a.apex == b.apex;
        halfway.then_some(Rung { apex: a.apex, distance: (a.distance + b.distance) / 2.0 })
    }
}
