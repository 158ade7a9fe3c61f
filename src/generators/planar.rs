//! A straight line graph that refuses what would make it invalid, by brute force and exact predicates.

use crate::model::{Fill, Point2, Pslg, Region, Segment, VertexId};

/// A graph whose segments meet only in common ends, with no vertex inside a segment and no two equal vertices.
///
/// Every addition is tested against all that is there: quadratic in all, and obviously right.
#[derive(Clone, Debug, Default)]
pub struct Planar {
    points: Vec<Point2>,
    segments: Vec<[u32; 2]>,
    holes: Vec<Point2>,
    regions: Vec<Region>,
}

/// Whether `a` comes before `b` in the order of x, then y.
fn before(a: Point2, b: Point2) -> bool {
    (a.x, a.y) < (b.x, b.y)
}

/// Sign of the turn a, b, c: 1 if counterclockwise. Exact for coordinates within 2^-142..2^201.
pub(super) fn turn(a: Point2, b: Point2, c: Point2) -> i32 {
    let [a, b, c] = [a, b, c].map(|p| robust::Coord { x: p.x, y: p.y });
    let value = robust::orient2d(a, b, c);
    i32::from(value > 0.0) - i32::from(value < 0.0)
}

/// Whether p lies strictly between a and b on their segment.
pub(super) fn inside_segment(p: Point2, a: Point2, b: Point2) -> bool {
    let (low, high) = if before(a, b) { (a, b) } else { (b, a) };
    before(low, p) && before(p, high) && turn(a, b, p) == 0
}

/// Whether the segments ab and cd cross in a point inside both.
pub(super) fn cross(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0
}

impl Planar {
    /// The vertices so far.
    pub fn points(&self) -> &[Point2] {
        &self.points
    }

    /// The segments so far, by their ends.
    pub fn segments(&self) -> &[[u32; 2]] {
        &self.segments
    }

    fn ends(&self, segment: [u32; 2]) -> [Point2; 2] {
        segment.map(|v| self.points[v as usize])
    }

    /// Adds a vertex; the id of the old one if it is there, `None` (and nothing added) if it lies inside a segment.
    pub fn vertex(&mut self, p: Point2) -> Option<u32> {
        if let Some(old) = self.points.iter().position(|&q| q == p) {
            return u32::try_from(old).ok();
        }
        let blocked = self.segments.iter().any(|&s| {
            let [a, b] = self.ends(s);
            inside_segment(p, a, b)
        });
        if blocked {
            return None;
        }
        self.points.push(p);
        u32::try_from(self.points.len() - 1).ok()
    }

    /// Whether the segment from u to v may join the graph.
    pub fn admits(&self, u: u32, v: u32) -> bool {
        let [a, b] = self.ends([u, v]);
        u != v
            && !self.points.iter().any(|&p| inside_segment(p, a, b))
            && !self.segments.iter().any(|&s| {
                let [c, d] = self.ends(s);
                s == [u, v] || s == [v, u] || cross(a, b, c, d)
            })
    }

    /// Adds the segment from u to v if the graph admits it; tells whether it did.
    pub fn segment(&mut self, u: u32, v: u32) -> bool {
        let admitted = self.admits(u, v);
        if admitted {
            self.segments.push([u, v]);
        }
        admitted
    }

    /// Adds a closed polygon, all of it or nothing; tells whether it did.
    pub fn polygon(&mut self, corners: &[Point2]) -> bool {
        let saved = self.clone();
        let ids: Option<Vec<u32>> = corners.iter().map(|&p| self.vertex(p)).collect();
        let added = ids.is_some_and(|ids| {
            let next = ids.iter().cycle().skip(1);
            ids.iter().zip(next).all(|(&u, &v)| self.segment(u, v))
        });
        if !added {
            *self = saved;
        }
        added
    }

    /// Adds the seed of a hole.
    pub fn hole(&mut self, seed: Point2) {
        self.holes.push(seed);
    }

    /// Adds a region with its number as attribute.
    pub fn region(&mut self, seed: Point2, max_area: Option<f64>) {
        self.regions.push(Region { seed, attribute: self.regions.len() as f64 + 1.0, max_area });
    }

    /// The axis-parallel box around all vertices, wider by its size on every side, as a closed polygon. Its sides are rounded, not exact.
    pub fn frame(&mut self) {
        let low = self.points.iter().copied().reduce(Point2::min).unwrap_or(Point2::ZERO);
        let high = self.points.iter().copied().reduce(Point2::max).unwrap_or(Point2::ONE);
        let size = high - low;
        let margin =
            size.x.max(size.y).max(low.abs().max_element() * super::draw::two_to(-40)).max(super::draw::two_to(-100));
        let (low, high) = (low - margin, high + margin);
        self.polygon(&[low, Point2::new(high.x, low.y), high, Point2::new(low.x, high.y)]);
    }

    /// The graph as plain data; markers of segments are their numbers modulo 7.
    pub fn finish(self) -> Pslg {
        let segments = (0..).zip(&self.segments);
        Pslg {
            segments: segments.map(|(i, s)| Segment { ends: s.map(VertexId), marker: i % 7, toggles: true }).collect(),
            points: self.points,
            holes: self.holes,
            regions: self.regions,
            fill: Fill::Seeds,
            ..Pslg::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Planar {
        let mut g = Planar::default();
        assert!(g.polygon(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(Point2::from)));
        g
    }

    #[test]
    fn refuses_what_meets() {
        let mut g = square();
        assert_eq!(g.vertex(Point2::new(2.0, 0.0)), None, "inside a side");
        assert_eq!(g.vertex(Point2::new(4.0, 4.0)), Some(2), "an old corner");
        let middle = g.vertex(Point2::new(2.0, 2.0)).expect("free place");
        let outside = g.vertex(Point2::new(9.0, 3.0)).expect("free place");
        assert!(!g.segment(0, 2), "through a vertex");
        assert!(!g.segment(middle, outside), "across a side");
        assert!(!g.segment(1, 0), "doubled");
        assert!(!g.segment(1, 1), "of length zero");
        assert!(g.segment(0, middle) && g.segment(middle, 2));
        assert_eq!(g.segments().len(), 6);
    }

    #[test]
    fn polygons_come_whole_or_not_at_all() {
        let mut g = square();
        assert!(!g.polygon(&[(1.0, 1.0), (9.0, 1.0), (1.0, 2.0)].map(Point2::from)));
        assert_eq!((g.points().len(), g.segments().len()), (4, 4));
    }

    #[test]
    fn frames_enclose_a_single_far_point() {
        let mut g = Planar::default();
        g.vertex(Point2::new(1e6, -1e6));
        g.frame();
        assert_eq!(g.segments().len(), 4);
    }
}
