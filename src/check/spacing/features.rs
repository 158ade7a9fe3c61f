//! Local feature size, from its definition.
//!
//! Problem: lfs(p) is the smallest r such that the closed disk of radius r at p meets two non-incident features of the
//! input. Idea: take the features in order of their distance to p; the first one that is not incident to some earlier one
//! is at distance lfs(p). Pairwise incident features are few or share a vertex: once four are met they have one vertex in common,
//! and a fifth that is incident to those four has it too, so comparing with the first four is enough (two vertices are never
//! incident; of three segments that pairwise share ends without a common one, no fourth feature is incident to all).
//! A tree of boxes yields features in order of lower bounds of their distances. What doubles cannot tell apart is sorted in rationals.
//! Source: \[GCDR\] Definition 2.2, `docs/gcdr.md` (incidence).

use crate::check::scalar::{Bounded, Enclosure, Scalar};
use crate::model::{Point2, SegmentId, VertexId};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A feature of the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    /// An input vertex.
    Vertex(VertexId),
    /// An input segment.
    Segment(SegmentId),
}

/// The features of an input with a tree of boxes over them. Coordinates are normalised: magnitudes are at most 1.
#[derive(Clone, Debug, Default)]
pub struct Features {
    points: Vec<Point2>,
    segments: Vec<[VertexId; 2]>,
    nodes: Vec<Node>,
    leaves: Vec<Feature>,
}

/// The local feature size of a point, squared.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    /// Lower and upper bound.
    pub size2: Bounded,
    /// The feature at that distance, if doubles could tell it from others.
    pub feature: Option<Feature>,
}

#[derive(Clone, Debug)]
struct Node {
    low: [f64; 2],
    high: [f64; 2],
    content: Content,
}

#[derive(Clone, Debug)]
enum Content {
    /// `leaves[first..last]`.
    Leaves { first: usize, last: usize },
    /// Two nodes.
    Inner { left: usize, right: usize },
}

/// Features in a leaf: enough to keep the tree small, few enough to measure each.
const LEAF: usize = 4;
/// Earlier features that have to be compared; see the module's head.
const ENOUGH: usize = 4;
/// More than the relative error of a squared distance to a box: four roundings and one of this product.
const BOX_SLACK: f64 = 1.0 - 8.0 * f64::EPSILON;

impl Features {
    /// The features of a (repaired) input.
    pub fn new(points: Vec<Point2>, segments: Vec<[VertexId; 2]>) -> Self {
        let vertices = (0u32..).zip(&points).map(|(v, _)| Feature::Vertex(VertexId(v)));
        let edges = (0u32..).zip(&segments).map(|(s, _)| Feature::Segment(SegmentId(s)));
        let leaves: Vec<Feature> = vertices.chain(edges).collect();
        let mut features = Features { points, segments, nodes: Vec::new(), leaves };
        if !features.leaves.is_empty() {
            features.build(0, features.leaves.len());
        }
        features
    }

    /// A vertex's coordinates.
    pub fn point(&self, v: VertexId) -> Point2 {
        self.points[v.index()]
    }

    /// A segment's ends.
    pub fn ends(&self, s: SegmentId) -> [VertexId; 2] {
        self.segments[s.index()]
    }

    /// How many vertices the input has.
    pub fn vertex_count(&self) -> usize {
        self.points.len()
    }

    /// Whether two features are incident: a vertex is an end of a segment, or two segments share an end.
    pub fn incident(&self, f: Feature, g: Feature) -> bool {
        match (f, g) {
            (Feature::Vertex(_), Feature::Vertex(_)) => false,
            (Feature::Vertex(v), Feature::Segment(s)) | (Feature::Segment(s), Feature::Vertex(v)) => {
                self.ends(s).contains(&v)
            }
            (Feature::Segment(s), Feature::Segment(t)) => self.ends(s).iter().any(|v| self.ends(t).contains(v)),
        }
    }

    /// Squared distance of p to a feature; unknown to `Bounded` where p is about beside an end of a segment.
    pub fn distance2<N: Scalar>(&self, f: Feature, p: Point2) -> N {
        match f {
            Feature::Vertex(v) => super::distance2(p, self.point(v)),
            Feature::Segment(s) => {
                let [a, b] = self.ends(s).map(|v| self.point(v));
                super::distance2_to_segment(p, a, b)
            }
        }
    }

    /// lfs(p)^2.
    pub fn local(&self, p: Point2) -> Local {
        let mut walk = Walk::new(self, p);
        let mut met: Vec<Met> = Vec::new();
        let mut beyond = f64::INFINITY;
        // first non-incident one: its position in `met`
        let mut first = None;
        while let Some(found) = walk.next_below(beyond) {
            if first.is_none()
                && let Some(other) = met.iter().take(ENOUGH).find(|m| !self.incident(m.feature, found.feature))
            {
                beyond = if other.high > found.high { other.high } else { found.high };
                first = Some(met.len());
            }
            met.push(found);
        }
        let Some(first) = first else {
            // fewer than two features, or all pairwise incident: no disk meets two non-incident ones
            return Local { size2: Bounded::of(f64::INFINITY), feature: None };
        };
        // earlier ones are pairwise incident, so every non-incident pair holds the candidate or one met after it
        let candidate = met[first];
        let alone = met.len() == first + 1 && met[..first].iter().all(|m| m.high < candidate.low);
        Local { size2: Bounded::between(candidate.low, beyond), feature: alone.then_some(candidate.feature) }
    }

    /// The feature at distance lfs(p), in rationals where doubles do not tell; `None` if there is none.
    pub fn local_exactly(&self, p: Point2) -> Option<Feature> {
        let local = self.local(p);
        local.feature.or_else(|| {
            let mut walk = Walk::new(self, p);
            let beyond = local.size2.high();
            let near = std::iter::from_fn(|| walk.next_below(beyond)).map(|m| m.feature);
            self.first_non_incident(p, near)
        })
    }

    /// Sorts features by exact distance and finds the first that is not incident to an earlier one.
    fn first_non_incident(&self, p: Point2, features: impl Iterator<Item = Feature>) -> Option<Feature> {
        let mut sorted: Vec<(Enclosure, Feature)> = features.map(|f| (self.distance2(f, p), f)).collect();
        // squared distances are rational, so the order is known
        sorted.sort_by(|(d, f), (e, g)| d.compare(e).unwrap_or(Ordering::Equal).then(f.cmp(g)));
        (1..sorted.len())
            .map(|i| sorted[i].1)
            .zip(1..)
            .find_map(|(f, i)| sorted[..i].iter().take(ENOUGH).any(|(_, g)| !self.incident(f, *g)).then_some(f))
    }

    /// Bounds of the squared distance, from rationals where doubles cannot tell on which side of an end p lies.
    fn bounds(&self, f: Feature, p: Point2) -> Bounded {
        let fast: Bounded = self.distance2(f, p);
        if fast.is_known() { fast } else { self.distance2::<Enclosure>(f, p).rounded() }
    }

    fn box_of(&self, f: Feature) -> ([f64; 2], [f64; 2]) {
        let (a, b) = match f {
            Feature::Vertex(v) => (self.point(v), self.point(v)),
            Feature::Segment(s) => {
                let [a, b] = self.ends(s).map(|v| self.point(v));
                (a, b)
            }
        };
        ([a.x.min(b.x), a.y.min(b.y)], [a.x.max(b.x), a.y.max(b.y)])
    }

    /// Builds the node over `leaves[first..last]`, halving it by the centers of the boxes along the longer side.
    fn build(&mut self, first: usize, last: usize) -> usize {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for f in &self.leaves[first..last] {
            let (l, h) = self.box_of(*f);
            for k in 0..2 {
                low[k] = low[k].min(l[k]);
                high[k] = high[k].max(h[k]);
            }
        }
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, content: Content::Leaves { first, last } });
        if last - first > LEAF {
            let k = usize::from(high[1] - low[1] > high[0] - low[0]);
            let mut keyed: Vec<(f64, Feature)> = (self.leaves[first..last].iter())
                .map(|f| {
                    let (l, h) = self.box_of(*f);
                    (l[k] + h[k], *f)
                })
                .collect();
            keyed.sort_by(|(x, f), (y, g)| x.total_cmp(y).then(f.cmp(g)));
            for (leaf, (_, f)) in self.leaves[first..last].iter_mut().zip(keyed) {
                *leaf = f;
            }
            let middle = first + (last - first) / 2;
            let left = self.build(first, middle);
            let right = self.build(middle, last);
            self.nodes[node].content = Content::Inner { left, right };
        }
        node
    }
}

/// A feature with bounds of its squared distance.
#[derive(Clone, Copy, Debug)]
struct Met {
    low: f64,
    high: f64,
    feature: Feature,
}

/// Features in ascending order of the lower bounds of their distances to a point.
struct Walk<'a> {
    features: &'a Features,
    p: Point2,
    heap: BinaryHeap<Entry>,
}

/// An entry of the heap: the one of smallest key is the greatest.
struct Entry {
    key: f64,
    item: Item,
}

#[derive(Clone, Copy, Debug)]
enum Item {
    Node(usize),
    Met(Met),
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.key.total_cmp(&self.key)
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Entry {}

impl<'a> Walk<'a> {
    fn new(features: &'a Features, p: Point2) -> Self {
        let mut walk = Walk { features, p, heap: BinaryHeap::new() };
        if !features.nodes.is_empty() {
            walk.push_node(0);
        }
        walk
    }

    fn push_node(&mut self, node: usize) {
        let n = &self.features.nodes[node];
        let gap = |low: f64, high: f64, x: f64| (low - x).max(x - high).max(0.0);
        let (x, y) = (gap(n.low[0], n.high[0], self.p.x), gap(n.low[1], n.high[1], self.p.y));
        self.heap.push(Entry { key: (x * x + y * y) * BOX_SLACK, item: Item::Node(node) });
    }

    /// The next feature whose lower bound does not exceed `bound`.
    fn next_below(&mut self, bound: f64) -> Option<Met> {
        while self.heap.peek()?.key <= bound {
            // the heap is not empty: peek saw this entry
            match self.heap.pop()?.item {
                Item::Met(met) => return Some(met),
                Item::Node(node) => match self.features.nodes[node].content {
                    Content::Inner { left, right } => {
                        self.push_node(left);
                        self.push_node(right);
                    }
                    Content::Leaves { first, last } => {
                        for feature in &self.features.leaves[first..last] {
                            let d = self.features.bounds(*feature, self.p);
                            let met = Met { low: d.low(), high: d.high(), feature: *feature };
                            self.heap.push(Entry { key: met.low, item: Item::Met(met) });
                        }
                    }
                },
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, over all pairs, in rationals.
    fn by_definition(features: &Features, p: Point2) -> Option<Enclosure> {
        let all = &features.leaves;
        let mut best: Option<Enclosure> = None;
        for (i, f) in all.iter().enumerate() {
            for g in &all[..i] {
                if !features.incident(*f, *g) {
                    let (a, b): (Enclosure, Enclosure) = (features.distance2(*f, p), features.distance2(*g, p));
                    let both = a.max(b);
                    best = Some(best.map_or(both.clone(), |x| x.min(both)));
                }
            }
        }
        best
    }

    fn check(features: &Features, p: Point2) {
        let expected = by_definition(features, p);
        let found = features.local_exactly(p).map(|f| features.distance2::<Enclosure>(f, p));
        match (&expected, &found) {
            (None, None) => {}
            (Some(e), Some(f)) => {
                assert_eq!(e.compare(f), Some(Ordering::Equal), "{p}");
                let fast = features.local(p).size2;
                assert!(Enclosure::of(fast.low()).at_most(e) == Some(true), "{p}");
                assert!(e.at_most(&Enclosure::of(fast.high())) == Some(true), "{p}");
            }
            _ => panic!("{p}: {expected:?} {found:?}"),
        }
    }

    fn points(xs: &[(f64, f64)]) -> Vec<Point2> {
        xs.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
    }

    fn ids(segments: &[[u32; 2]]) -> Vec<[VertexId; 2]> {
        segments.iter().map(|s| s.map(VertexId)).collect()
    }

    #[test]
    fn agrees_with_the_definition_on_a_grid_full_of_ties() {
        // two concentric squares and a diagonal spoke; queries on a grid that hits vertices, segments and midlines
        let input = points(&[
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 1.0),
            (0.0, 1.0),
            (0.25, 0.25),
            (0.75, 0.25),
            (0.75, 0.75),
            (0.25, 0.75),
        ]);
        let segments = ids(&[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4]]);
        let features = Features::new(input, segments);
        for i in 0..=16 {
            for j in 0..=16 {
                check(&features, Point2::new(f64::from(i) / 16.0, f64::from(j) / 16.0));
            }
        }
        assert!(features.local(Point2::new(0.5, 0.5)).feature.is_none(), "four sides are equally near");
    }

    #[test]
    fn agrees_with_the_definition_on_stars_and_triangles() {
        let rays = [(0.5, 0.5), (1.0, 0.5), (0.9, 0.9), (0.5, 1.0), (0.1, 0.9), (0.0, 0.5), (0.1, 0.1), (0.5, 0.0)];
        let star: Vec<[u32; 2]> = (1..8).map(|i| [0, i]).collect();
        let star = Features::new(points(&rays), ids(&star));
        let triangle = Features::new(points(&[(0.0, 0.0), (1.0, 0.0), (0.3, 0.8)]), ids(&[[0, 1], [1, 2], [2, 0]]));
        let mut x = 0.7f64;
        for _ in 0..400 {
            let mut coordinate = || {
                x = 3.9 * x * (1.0 - x);
                x
            };
            let p = Point2::new(coordinate(), coordinate());
            check(&star, p);
            check(&star, Point2::new(0.5 + (p.x - 0.5) / 1024.0, 0.5 + (p.y - 0.5) / 1024.0));
            check(&triangle, p);
        }
    }

    #[test]
    fn one_segment_alone_is_measured_by_its_ends() {
        let features = Features::new(points(&[(0.0, 0.0), (1.0, 0.0)]), ids(&[[0, 1]]));
        check(&features, Point2::new(0.25, 0.0));
        let lonely = Features::new(points(&[(0.0, 0.0)]), Vec::new());
        assert_eq!(lonely.local_exactly(Point2::new(1.0, 1.0)), None);
    }
}
