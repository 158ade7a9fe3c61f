//! Filler: the triangles of the hull outside the region. They keep stars together, and they show when a split point, rounded off the
//! border, would carry the region over what lies across a gap. Source: `docs/trace-format.md`, filler.
//!
//! A triangle outside that is not positively oriented stands where a point left the hull: nothing lies there.

use super::complex::{Complex, NONE, next, previous, triangle_of};
use super::predicates::orient;
use super::replay::{Replay, Rim};
use super::verdict::{Checked, Rule, broken};
use crate::model::Point2;
use std::collections::BTreeSet;

/// What a split of the border sweeps over.
#[derive(Clone, Debug, Default)]
pub struct Swept {
    /// The triangles, that at the border first.
    triangles: Vec<u32>,
    /// Their boundary but for the border edge, counterclockwise.
    rim: Vec<Rim>,
}

/// Whether the triangle of e is positively oriented.
fn is_positive(mesh: &Complex, e: u32) -> bool {
    let [a, b, c] = mesh.places(triangle_of(e));
    orient(a, b, c).is_positive()
}

/// The filler that p sweeps over when it splits the border edge e, seen from outside: the triangle at e, and on across every edge that p lies on or beyond.
/// `None` if such an edge is constrained, or the filler encloses a vertex. A point rounded into the region sweeps over nothing: the triangle between e and p
/// comes in addition.
pub fn swept(mesh: &Complex, e: u32, p: Point2) -> Option<Swept> {
    let (from, to) = (mesh.target(e), mesh.origin(e));
    if orient(mesh.at(from), mesh.at(to), p).is_positive() {
        return Some(Swept { triangles: Vec::new(), rim: vec![Rim { from, to, outer: e, segment: NONE }] });
    }
    let whole = is_positive(mesh, e);
    let mut swept = Swept { triangles: vec![triangle_of(e)], rim: Vec::new() };
    let mut known = BTreeSet::from([triangle_of(e)]);
    let mut stack = vec![previous(e), next(e)];
    while let Some(e) = stack.pop() {
        let (from, to, outer, segment) = (mesh.origin(e), mesh.target(e), mesh.beyond(e), mesh.segment(e));
        if whole && !orient(mesh.at(from), mesh.at(to), p).is_positive() {
            if segment != NONE {
                return None;
            }
            if outer != NONE && is_positive(mesh, outer) {
                if !known.insert(triangle_of(outer)) {
                    return None;
                }
                swept.triangles.push(triangle_of(outer));
                stack.extend([previous(outer), next(outer)]);
                continue;
            }
        }
        swept.rim.push(Rim { from, to, outer, segment });
    }
    Some(swept)
}

impl Replay {
    /// Splits the filler at the border edge e, seen from outside, at the vertex p: what p sweeps over becomes its star. Returns the halves of e.
    pub(super) fn split_outside(&mut self, e: u32, p: u32) -> Checked<[u32; 2]> {
        let Some(swept) = swept(&self.mesh, e, self.mesh.at(p)) else {
            return broken(
                Rule::Star,
                "a point on the near side of what lies across the outside",
                format!("vertex {p}"),
            );
        };
        let facts = *self.mesh.facts(triangle_of(e));
        swept.triangles.iter().for_each(|&t| self.mesh.drop(t));
        let mut halves: Option<[u32; 2]> = None;
        for Rim { from, to, outer, segment } in swept.rim {
            let t = self.mesh.add([from, to, p], facts);
            self.mesh.join(4 * t, outer, segment);
            if let Some([before, _]) = halves {
                self.mesh.join(before, 4 * t + 2, NONE);
            }
            halves = Some([4 * t + 1, halves.map_or(4 * t + 2, |h| h[1])]);
        }
        // A rim has an edge.
        Ok(halves.unwrap_or([NONE; 2]))
    }
}
