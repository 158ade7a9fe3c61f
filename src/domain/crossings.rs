//! The crossings of suspect segments, each pair once, and the vertices inside suspects: a tree of boxes asked for each suspect.

use super::sweep::{Span, crosses};
use crate::arith::Kernel;
use crate::model::{Point2, Sign};

/// Pairs counted before the counting stops and `at_least` is set. An input with more is beyond repair by hand anyway.
pub(super) const MOST_CROSSINGS: usize = 1_000_000;

/// Boxes visited before the counting stops: some seconds. Only inputs with many crossings come near.
const MOST_VISITS: u64 = 300_000_000;

/// What the suspects turned out to be.
#[derive(Debug, Default)]
pub(super) struct Crossings {
    /// Positions of two spans that cross where no vertex is, the smaller first, ascending.
    pub pairs: Vec<[u32; 2]>,
    /// Whether there may be more.
    pub at_least: bool,
    /// (span, vertex): the vertex lies in the interior of the suspect.
    pub incidences: Vec<(u32, u32)>,
}

/// Decides about each suspect. `order`: the vertices in lexicographic order.
pub(super) fn crossings<K: Kernel>(points: &[Point2], order: &[u32], spans: &[Span], suspects: &[u32]) -> Crossings {
    let mut found = Crossings::default();
    if suspects.is_empty() {
        return found;
    }
    let corners = |s: u32| spans[s as usize].ends.map(|v| points[v as usize]);
    let segments = Boxes::new(spans.len(), |i| corners(i as u32));
    let vertices = Boxes::new(order.len(), |i| [points[order[i] as usize]; 2]);
    let mut visits = MOST_VISITS;
    let mut asked = vec![false; spans.len()];
    for &s in suspects {
        let [a, b] = corners(s);
        let ends = spans[s as usize].ends;
        let mut inside: Vec<u32> = Vec::new();
        vertices.visit::<K>([a, b], &mut visits, |i| {
            let v = order[i as usize];
            let p = points[v as usize];
            let within = (p.cmpge(a.min(b)) & p.cmple(a.max(b))).all();
            if within && !ends.contains(&v) && K::orient2d(a, b, p) == Sign::Zero {
                inside.push(i);
            }
        });
        // Positions in the lexicographic order ascend along the segment.
        inside.sort_unstable();
        let cuts: Vec<Point2> = inside.iter().map(|&i| points[order[i as usize] as usize]).collect();
        found.incidences.extend(inside.iter().map(|&i| (s, order[i as usize])));
        segments.visit::<K>([a, b], &mut visits, |t| {
            if asked[t as usize] {
                return; // counted when it was asked for
            }
            let [c, d] = corners(t);
            if found.pairs.len() < MOST_CROSSINGS
                && crosses::<K>([a, b], [c, d])
                && !meets_vertex::<K>(&cuts, a, [c, d])
            {
                found.pairs.push([s.min(t), s.max(t)]);
            }
        });
        asked[s as usize] = true;
        if visits == 0 || found.pairs.len() >= MOST_CROSSINGS {
            found.at_least = true;
            break;
        }
    }
    found.pairs.sort_unstable();
    found
}

/// Whether one of the points in order along a segment from a lies on the line cd, which the segment crosses.
fn meets_vertex<K: Kernel>(along: &[Point2], a: Point2, [c, d]: [Point2; 2]) -> bool {
    let near = K::orient2d(c, d, a);
    let beyond = along.partition_point(|&p| K::orient2d(c, d, p) == near);
    along.get(beyond).is_some_and(|&p| K::orient2d(c, d, p) == Sign::Zero)
}

/// A balanced tree of bounding boxes over items with a box each.
struct Boxes {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

struct Node {
    low: Point2,
    high: Point2,
    /// A range of items (leaf), or the position of the second child; the first follows its parent.
    content: Content,
}

enum Content {
    Items(u32, u32),
    Second(u32),
}

/// Items in a leaf: a few tests cost as much as a node.
const LEAF: usize = 4;

impl Boxes {
    fn new(count: usize, corners: impl Fn(usize) -> [Point2; 2]) -> Self {
        let boxes: Vec<[Point2; 2]> = (0..count)
            .map(|i| {
                let [a, b] = corners(i);
                [a.min(b), a.max(b)]
            })
            .collect();
        let mut tree = Boxes { nodes: Vec::new(), items: (0..count as u32).collect() };
        let mut items = std::mem::take(&mut tree.items);
        if count > 0 {
            tree.build(&boxes, &mut items, 0);
        }
        tree.items = items;
        tree
    }

    /// Depth is logarithmic: each child takes half of the items.
    fn build(&mut self, boxes: &[[Point2; 2]], items: &mut [u32], offset: u32) {
        let (mut low, mut high) = (Point2::INFINITY, Point2::NEG_INFINITY);
        for &i in items.iter() {
            low = low.min(boxes[i as usize][0]);
            high = high.max(boxes[i as usize][1]);
        }
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, content: Content::Items(offset, items.len() as u32) });
        if items.len() <= LEAF {
            return;
        }
        let wide = high.x - low.x >= high.y - low.y;
        let key = |i: u32| {
            let c = boxes[i as usize][0] + boxes[i as usize][1];
            if wide { c.x } else { c.y }
        };
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |&i, &j| key(i).total_cmp(&key(j)).then(i.cmp(&j)));
        let (first, second) = items.split_at_mut(half);
        self.build(boxes, first, offset);
        self.nodes[node].content = Content::Second(self.nodes.len() as u32);
        self.build(boxes, second, offset + half as u32);
    }

    /// Calls `f` for the items of every leaf whose box the segment meets, until `visits` is used up.
    fn visit<K: Kernel>(&self, [a, b]: [Point2; 2], visits: &mut u64, mut f: impl FnMut(u32)) {
        let (low, high) = (a.min(b), a.max(b));
        let mut stack = vec![0u32];
        while let Some(i) = stack.pop() {
            let Some(node) = self.nodes.get(i as usize) else {
                return;
            };
            if *visits == 0 {
                return;
            }
            *visits -= 1;
            if node.low.cmpgt(high).any() || low.cmpgt(node.high).any() || beside::<K>(a, b, node) {
                continue;
            }
            match node.content {
                Content::Items(from, count) => {
                    self.items[from as usize..(from + count) as usize].iter().for_each(|&item| f(item));
                }
                Content::Second(second) => stack.extend([second, i + 1]),
            }
        }
    }
}

/// Whether a box lies strictly on one side of the line ab.
fn beside<K: Kernel>(a: Point2, b: Point2, node: &Node) -> bool {
    let Node { low, high, .. } = *node;
    let first = K::orient2d(a, b, low);
    first != Sign::Zero
        && [high, Point2::new(low.x, high.y), Point2::new(high.x, low.y)].iter().all(|&c| K::orient2d(a, b, c) == first)
}
