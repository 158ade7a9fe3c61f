//! The convex hull of an input's points: what bounds a mesh of all that they span. Source: Andrew's monotone chain, with exact turns.

use super::exact::{lexicographic, orient};
use crate::model::{Point2, Pslg, VertexId};
use std::cmp::Ordering;

/// The edges of the hull that are no segments. Points on an edge part it; points on one line have a path from first to last.
pub(super) fn edges(input: &Pslg) -> Vec<[VertexId; 2]> {
    let at = |v: u32| input.points[v as usize];
    let mut order: Vec<u32> = (0..input.points.len() as u32).filter(|&v| at(v).is_finite()).collect();
    order.sort_unstable_by(|&u, &v| lexicographic(at(u), at(v)));
    let lower = chain(order.iter().copied(), &at);
    let upper = chain(order.iter().rev().copied(), &at);
    let key = |[u, v]: [VertexId; 2]| [u.min(v), u.max(v)];
    let mut known: Vec<[VertexId; 2]> = input.segments.iter().map(|s| key(s.ends)).collect();
    known.sort_unstable();
    let pairs = lower.windows(2).chain(upper.windows(2)).map(|w| key([VertexId(w[0]), VertexId(w[1])]));
    let mut edges: Vec<[VertexId; 2]> = pairs.filter(|e| known.binary_search(e).is_err()).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The part of the hull to the right of the way from the first point to the last: it never turns right.
fn chain(points: impl Iterator<Item = u32>, at: &impl Fn(u32) -> Point2) -> Vec<u32> {
    let mut chain: Vec<u32> = Vec::new();
    for v in points {
        while let [.., a, b] = chain[..]
            && orient(at(a), at(b), at(v)) == Ordering::Less
        {
            chain.pop();
        }
        chain.push(v);
    }
    chain
}
