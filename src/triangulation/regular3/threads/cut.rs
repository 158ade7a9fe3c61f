//! Space is cut into boxes with about equally many points.
//!
//! A sample of the points tells where: boxes that differ by some points cost nothing, and no thread waits for a sort of all points.

use crate::model::{Point3, WeightedPoint};
use crate::triangulation::spatial::hash;

/// How many points are looked at: a box of n of them then has the share of the points that it seems to have up to n^(1/2) / n.
const SAMPLE: usize = 1 << 16;
/// Layers of points in a halo: of uniform points all but one cell in some millions are smaller.
const LAYERS: usize = 3;

/// A box of space, closed below and open above, infinite where nothing was cut; and a larger one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) low: Point3,
    pub(super) high: Point3,
    /// The box with its halo.
    pub(super) outer_low: Point3,
    pub(super) outer_high: Point3,
}

impl Part {
    /// Whether a point is in the box.
    pub(super) fn has(&self, p: Point3) -> bool {
        p.cmpge(self.low).all() && p.cmplt(self.high).all()
    }

    /// Whether a point is in the box or its halo.
    pub(super) fn reaches(&self, p: Point3) -> bool {
        p.cmpge(self.outer_low).all() && p.cmplt(self.outer_high).all()
    }
}

/// Some of the points: all, if they are not more than `count`.
pub(super) fn sample(points: &[WeightedPoint], count: usize) -> impl Iterator<Item = WeightedPoint> + '_ {
    let n = points.len();
    (0..count.min(n)).map(move |i| points[if n <= count { i } else { (hash(i as u32) % n as u64) as usize }])
}

/// Cuts space into so many parts for these points; fewer where they have equal coordinates.
pub(super) fn parts(points: &[WeightedPoint], count: usize) -> Vec<Part> {
    let some: Vec<Point3> = sample(points, SAMPLE).map(|p| p.at).collect();
    let whole = (Point3::splat(f64::NEG_INFINITY), Point3::splat(f64::INFINITY));
    let mut boxes = Vec::new();
    cut(some, whole, count, &mut boxes);
    let of_sample = points.len() as f64 / points.len().min(SAMPLE) as f64;
    boxes.into_iter().map(|(own, low, high)| with_halo(own, low, high, of_sample)).collect()
}

/// Cuts a box with its points into `count` boxes, each cut across the longest extent.
fn cut(
    mut own: Vec<Point3>,
    (low, high): (Point3, Point3),
    count: usize,
    all: &mut Vec<(Vec<Point3>, Point3, Point3)>,
) {
    let first = count / 2;
    if first > 0 && own.len() > 1 {
        let none = (Point3::splat(f64::INFINITY), Point3::splat(f64::NEG_INFINITY));
        let (least, most) = own.iter().fold(none, |(least, most), &p| (least.min(p), most.max(p)));
        let axis = (most - least).max_position();
        let middle = own.len() * first / count;
        let (_, &mut pivot, _) = own.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
        let c = pivot[axis];
        let (below, above): (Vec<Point3>, Vec<Point3>) = own.iter().partition(|p| p[axis] < c);
        if !below.is_empty() {
            let (mut end, mut start) = (high, low);
            end[axis] = c;
            start[axis] = c;
            cut(below, (low, end), first, all);
            cut(above, (start, high), count - first, all);
            return;
        }
    }
    all.push((own, low, high));
}

/// A box with a halo: beyond each side that was cut, as far as some layers of its own points reach inwards. Each of these stands for `weight` points.
fn with_halo(own: Vec<Point3>, low: Point3, high: Point3, weight: f64) -> Part {
    let mut layer = 1.0;
    // The number of points in a layer: the square of the cube root.
    while (layer + 1.0) * (layer + 1.0) * (layer + 1.0) <= own.len() as f64 * weight {
        layer += 1.0;
    }
    let rank = ((LAYERS as f64 * layer * layer / weight) as usize).min(own.len() - 1);
    let reach = |side: f64, axis: usize| {
        if side.is_infinite() {
            return f64::INFINITY;
        }
        let mut distances: Vec<f64> = own.iter().map(|p| (p[axis] - side).abs()).collect();
        *distances.select_nth_unstable_by(rank, f64::total_cmp).1
    };
    let of = |sides: Point3| Point3::from_array([0, 1, 2].map(|axis| reach(sides[axis], axis)));
    Part { low, high, outer_low: low - of(low), outer_high: high + of(high) }
}
