//! Segments become edges: remove the triangles that a segment crosses, triangulate both sides.
//!
//! Each side is a polygon weakly visible from the segment (`polygon`). Since the constrained Delaunay triangulation is unique,
//! the order of the segments does not matter; they are taken in the order of the triangles at their ends, for locality.

use super::BuildError;
use super::polygon::{Polygon, Side};
use super::store::{Cdt2, Link, NONE, TriId, next, prev};
use crate::arith::Kernel;
use crate::model::{Point2, SegmentId, Sign, VertexId};

/// How a segment leaves its first vertex.
enum Departure {
    /// It is the edge of this half-edge, in either direction.
    Edge(u32),
    /// It crosses this edge, counterclockwise in the triangle at the vertex.
    Across(u32),
}

/// The triangles a segment crosses and the two polygons they leave.
#[derive(Default)]
struct Crossed {
    triangles: Vec<u32>,
    left: Polygon,
    right: Polygon,
    created: Vec<TriId>,
}

impl<K: Kernel> Cdt2<K> {
    /// Makes each segment (repaired: no crossings, no vertex inside, no duplicates) an edge; ids are positions. Once, before `carve`.
    ///
    /// Errors: `Crossing`, `VertexOnSegment`, each naming one of the places where the input is not as said. The triangulation is then unusable.
    pub fn constrain(&mut self, segments: &[[VertexId; 2]]) -> Result<(), BuildError> {
        let mut order: Vec<(u32, u32)> = Vec::with_capacity(segments.len());
        // Segment ids are u32 by type.
        order.extend((0u32..).zip(segments).map(|(id, s)| (self.hints[s[0].index()], id)));
        order.sort_unstable();
        let mut crossed = Crossed::default();
        for (_, id) in order {
            let [u, v] = segments[id as usize];
            self.constrain_one(u.0, v.0, id, &mut crossed)?;
        }
        Ok(())
    }

    fn constrain_one(&mut self, u: u32, v: u32, id: u32, crossed: &mut Crossed) -> Result<(), BuildError> {
        if u == v {
            return Err(BuildError::VertexOnSegment(SegmentId(id), VertexId(v)));
        }
        let e = match self.departure(u, v, id)? {
            Departure::Edge(e) => {
                if self.link(e).is_constrained() {
                    return Err(crossing(id, self.label(e)));
                }
                e
            }
            Departure::Across(e) => {
                self.collect(u, v, e, id, crossed)?;
                self.retriangulate(crossed)
            }
        };
        let link = self.link(e).constrained();
        self.glue(e, link, id);
        if let Some(f) = link.twin() {
            self.write_label(f, id);
        }
        Ok(())
    }

    /// Turns around u: the edge to v, or else the edge that the segment crosses first.
    fn departure(&self, u: u32, v: u32, id: u32) -> Result<Departure, BuildError> {
        // A vertex of a freshly built triangulation has triangles.
        let start = self.hints[u as usize];
        debug_assert!(start != NONE);
        let mut first = start;
        let mut e = start;
        loop {
            if let Some(found) = self.depart_through(e, v, id)? {
                return Ok(found);
            }
            match self.link(prev(e)).twin() {
                Some(f) if f == first => break,
                Some(f) => e = f,
                None if first == start => {
                    // u lies on the hull: begin again from the first triangle clockwise, and turn once.
                    while let Some(f) = self.link(first).twin() {
                        first = next(f);
                    }
                    e = first;
                    if first == start {
                        break;
                    }
                }
                None => break,
            }
        }
        unreachable!("the triangles at a vertex cover every direction to another vertex of the hull")
    }

    /// The same for the one triangle left of e.
    fn depart_through(&self, e: u32, v: u32, id: u32) -> Result<Option<Departure>, BuildError> {
        let [u, x, y] = [e, next(e), prev(e)].map(|e| self.origin_of(e));
        if x == v {
            return Ok(Some(Departure::Edge(e)));
        }
        if y == v {
            return Ok(Some(Departure::Edge(prev(e))));
        }
        let [pu, pv, px, py] = [u, v, x, y].map(|v| self.points[v as usize]);
        let at_x = K::orient2d(pu, px, pv);
        if at_x == Sign::Zero && same_direction(pu, px, pv) {
            return Err(BuildError::VertexOnSegment(SegmentId(id), VertexId(x)));
        }
        if !at_x.is_positive() {
            return Ok(None);
        }
        Ok(match K::orient2d(pu, py, pv) {
            Sign::Positive => None,
            Sign::Negative => Some(Departure::Across(next(e))),
            // The angle at u is below 180 degrees and v is left of ux: so it is in the direction of y.
            Sign::Zero => return Err(BuildError::VertexOnSegment(SegmentId(id), VertexId(y))),
        })
    }

    /// Follows the segment from u across e to v.
    ///
    /// ```text
    ///           left: the chain from v back to u
    ///       u --------------------------------> v
    ///           right: the chain from u to v
    /// ```
    fn collect(&self, u: u32, v: u32, e: u32, id: u32, crossed: &mut Crossed) -> Result<(), BuildError> {
        let [pu, pv] = [u, v].map(|v| self.points[v as usize]);
        let side = |e: u32| Side { origin: self.origin_of(e), inner: e };
        let Crossed { triangles, left, right, created } = crossed;
        triangles.clear();
        created.clear();
        left.reset();
        right.reset();
        triangles.push(e >> 2);
        // Until the end `left` holds its sides from u on, clockwise; each with its own origin.
        left.sides.push(side(next(e)));
        right.sides.push(Side { origin: v, inner: NONE });
        right.sides.push(side(prev(e)));
        let mut e = e;
        loop {
            let link = self.link(e);
            if link.is_constrained() {
                return Err(crossing(id, self.label(e)));
            }
            let Some(f) = link.twin() else { unreachable!("a segment stays inside the convex hull") };
            // f leads from left to right; its triangle's apex decides which of the two other edges is crossed next.
            triangles.push(f >> 2);
            let apex = self.origin_of(prev(f));
            if apex == v {
                left.sides.push(side(prev(f)));
                right.sides.push(side(next(f)));
                break;
            }
            match K::orient2d(pu, pv, self.points[apex as usize]) {
                Sign::Positive => {
                    left.sides.push(side(prev(f)));
                    e = next(f);
                }
                Sign::Negative => {
                    right.sides.push(side(next(f)));
                    e = prev(f);
                }
                Sign::Zero => {
                    return Err(BuildError::VertexOnSegment(SegmentId(id), VertexId(apex)));
                }
            }
        }
        left.sides.push(Side { origin: u, inner: NONE });
        left.sides.reverse();
        Ok(())
    }

    /// Fills both sides and glues them along the segment; returns the half-edge from u to v.
    fn retriangulate(&mut self, crossed: &mut Crossed) -> u32 {
        crossed.left.triangulate_below::<K>(&self.points);
        crossed.right.triangulate_below::<K>(&self.points);
        // Regions are labelled later, by `carve`.
        let left = self.fill(&crossed.left, 0, &mut crossed.created);
        let right = self.fill(&crossed.right, 0, &mut crossed.created);
        self.glue(left, Link::to(right), NONE);
        for &t in &crossed.triangles {
            self.release_slot(t);
        }
        left
    }
}

fn crossing(a: u32, b: u32) -> BuildError {
    BuildError::Crossing(SegmentId(a.min(b)), SegmentId(a.max(b)))
}

/// Whether x and v, collinear with u and different from it, lie on the same side of it.
fn same_direction(u: Point2, x: Point2, v: Point2) -> bool {
    let order = |a: Point2, b: Point2| crate::arith::perturb::lexicographic(a, b);
    order(u, x) == order(u, v)
}
