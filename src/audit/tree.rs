//! A balanced tree of bounding boxes, for searches.

use crate::model::Point2;

/// Boxes of items, halved along their longer side down to a few.
pub(super) struct Tree {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

struct Node {
    low: Point2,
    high: Point2,
    /// Range of items below.
    items: (u32, u32),
    /// The second child; the first follows its parent. `None` for a leaf.
    second: Option<u32>,
}

/// Items in a leaf: a few tests cost as much as a node.
const LEAF: usize = 6;

impl Tree {
    /// A tree over `count` items with the boxes spanned by two points each.
    pub fn new(count: usize, corners: impl Fn(usize) -> [Point2; 2]) -> Self {
        let boxes: Vec<[Point2; 2]> = (0..count).map(&corners).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        let mut items: Vec<u32> = (0..count as u32).collect();
        let mut tree = Tree { nodes: Vec::new(), items: Vec::new() };
        if count > 0 {
            tree.build(&boxes, &mut items, 0);
        }
        tree.items = items;
        tree
    }

    /// Depth is logarithmic: each child takes half of the items.
    fn build(&mut self, boxes: &[[Point2; 2]], items: &mut [u32], from: u32) {
        let (low, high) = items.iter().fold((Point2::INFINITY, Point2::NEG_INFINITY), |(low, high), &i| {
            let [a, b] = boxes[i as usize];
            (low.min(a), high.max(b))
        });
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, items: (from, from + items.len() as u32), second: None });
        if items.len() <= LEAF {
            return;
        }
        let extent = high - low;
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |&i, &j| {
            let key = |i: u32| {
                let [a, b] = boxes[i as usize];
                if extent.x >= extent.y { 0.5 * a.x + 0.5 * b.x } else { 0.5 * a.y + 0.5 * b.y }
            };
            key(i).total_cmp(&key(j))
        });
        let (first, second) = items.split_at_mut(half);
        self.build(boxes, first, from);
        self.nodes[node].second = Some(self.nodes.len() as u32);
        self.build(boxes, second, from + half as u32);
    }

    /// Visits the items of leaves all of whose boxes `enter` admits, until `item` says stop.
    pub fn visit(&self, enter: impl Fn(Point2, Point2) -> bool, mut item: impl FnMut(u32) -> bool) {
        let mut stack = if self.nodes.is_empty() { vec![] } else { vec![0u32] };
        while let Some(i) = stack.pop() {
            let node = &self.nodes[i as usize];
            if !enter(node.low, node.high) {
                continue;
            }
            match node.second {
                Some(second) => stack.extend([second, i + 1]),
                None => {
                    let (from, to) = node.items;
                    if !self.items[from as usize..to as usize].iter().all(|&i| item(i)) {
                        return;
                    }
                }
            }
        }
    }
}
