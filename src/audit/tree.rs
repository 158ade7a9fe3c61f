//! A balanced tree of bounding boxes, for searches.

use crate::model::{Point2, Point3};

/// A corner of a box, of the plane or of space.
pub(super) trait Corner: Copy {
    /// The box of no item is from this to its negative.
    const NOWHERE: [Self; 2];
    fn lower(self, other: Self) -> Self;
    fn upper(self, other: Self) -> Self;
    fn axes(&self) -> &[f64];
}

macro_rules! corner {
    ($point:ty, $axes:literal) => {
        impl Corner for $point {
            const NOWHERE: [Self; 2] = [<$point>::INFINITY, <$point>::NEG_INFINITY];
            fn lower(self, other: Self) -> Self {
                self.min(other)
            }
            fn upper(self, other: Self) -> Self {
                self.max(other)
            }
            fn axes(&self) -> &[f64] {
                let axes: &[f64; $axes] = self.as_ref();
                axes
            }
        }
    };
}
corner!(Point2, 2);
corner!(Point3, 3);

/// Boxes of items, halved along their longest side down to a few.
pub(super) struct Tree<P> {
    nodes: Vec<Node<P>>,
    items: Vec<u32>,
}

struct Node<P> {
    low: P,
    high: P,
    /// Range of items below.
    items: (u32, u32),
    /// The second child; the first follows its parent. `None` for a leaf.
    second: Option<u32>,
}

/// Items in a leaf: a few tests cost as much as a node.
const LEAF: usize = 6;

impl<P: Corner> Tree<P> {
    /// A tree over `count` items with the boxes spanned by two points each.
    pub fn new(count: usize, corners: impl Fn(usize) -> [P; 2]) -> Self {
        let boxes: Vec<[P; 2]> = (0..count).map(&corners).map(|[a, b]| [a.lower(b), a.upper(b)]).collect();
        let mut items: Vec<u32> = (0..count as u32).collect();
        let mut tree = Tree { nodes: Vec::new(), items: Vec::new() };
        if count > 0 {
            tree.build(&boxes, &mut items, 0);
        }
        tree.items = items;
        tree
    }

    /// Depth is logarithmic: each child takes half of the items.
    fn build(&mut self, boxes: &[[P; 2]], items: &mut [u32], from: u32) {
        let (low, high) = items.iter().fold((P::NOWHERE[0], P::NOWHERE[1]), |(low, high), &i| {
            let [a, b] = boxes[i as usize];
            (low.lower(a), high.upper(b))
        });
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, items: (from, from + items.len() as u32), second: None });
        if items.len() <= LEAF {
            return;
        }
        let extent = |k: usize| high.axes()[k] - low.axes()[k];
        let longest = (1..low.axes().len()).fold(0, |best, k| if extent(k) > extent(best) { k } else { best });
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |&i, &j| {
            let key = |i: u32| {
                let [a, b] = &boxes[i as usize];
                0.5 * a.axes()[longest] + 0.5 * b.axes()[longest]
            };
            key(i).total_cmp(&key(j))
        });
        let (first, second) = items.split_at_mut(half);
        self.build(boxes, first, from);
        self.nodes[node].second = Some(self.nodes.len() as u32);
        self.build(boxes, second, from + half as u32);
    }

    /// Visits the items of leaves all of whose boxes `enter` admits, until `item` says stop.
    pub fn visit(&self, enter: impl Fn(P, P) -> bool, mut item: impl FnMut(u32) -> bool) {
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
