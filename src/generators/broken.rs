//! Graphs with one planted defect.

use super::draw::{Draw, two_to};
use super::graphs::{PslgFamily, pslg};
use super::point_sets::PointFamily;
use crate::model::{Fill, Point2, Pslg, Region, Segment, VertexId};

/// What is wrong with a graph. Severity as in the reference of `doctor`: `Overlap`, `Doubled` and `OnSegment` are repairs, the rest errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, arbitrary::Arbitrary)]
pub enum Defect {
    /// Two segments cross.
    Crossing,
    /// Two vertices have the same coordinates.
    Duplicate,
    /// A segment from a vertex to itself.
    ZeroLength,
    /// A segment that overlaps another on a part of its length.
    Overlap,
    /// A segment given twice, once reversed.
    Doubled,
    /// A vertex exactly inside a segment.
    OnSegment,
    /// A coordinate that is not a number.
    NotANumber,
    /// An infinite coordinate.
    Infinite,
    /// A coordinate beyond 2^870, the largest scale accepted.
    TooLarge,
    /// A nonzero coordinate below 2^-142 of the largest.
    TooSmall,
    /// A segment with an end that is no vertex.
    WrongIndex,
    /// Segments that enclose nothing.
    Open,
    /// A hole seed exactly on a segment.
    HoleOnSegment,
    /// A hole seed outside all regions.
    HoleOutside,
    /// Two region seeds in one face.
    TwoRegions,
    /// No vertex at all.
    Empty,
    /// Vertices all on one line.
    Flat,
    /// Under `Fill::Parity`, toggling segments that do not close up.
    OpenCycle,
}

impl Defect {
    /// All defects.
    pub const ALL: [Defect; 18] = {
        use Defect::*;
        [
            Crossing,
            Duplicate,
            ZeroLength,
            Overlap,
            Doubled,
            OnSegment,
            NotANumber,
            Infinite,
            TooLarge,
            TooSmall,
            WrongIndex,
            Open,
            HoleOnSegment,
            HoleOutside,
            TwoRegions,
            Empty,
            Flat,
            OpenCycle,
        ]
    };
}

/// The square with corners (0, 0) and (64, 64), counterclockwise, ids 0 to 3: what each defect is planted into.
fn square() -> Pslg {
    let points = [(0.0, 0.0), (64.0, 0.0), (64.0, 64.0), (0.0, 64.0)].map(Point2::from).to_vec();
    let segments = (0..4).map(|i| segment(i, (i + 1) % 4)).collect();
    Pslg { points, segments, ..Pslg::default() }
}

fn segment(u: u32, v: u32) -> Segment {
    Segment { ends: [VertexId(u), VertexId(v)], marker: 0, toggles: true }
}

/// Appends a segment between new vertices.
fn append(g: &mut Pslg, a: Point2, b: Point2) {
    let first = g.points.len() as u32;
    g.points.extend([a, b]);
    g.segments.push(segment(first, first + 1));
}

/// A graph of about `n` vertices with the given defect and, where possible, no other: the defect sits in a square beside a valid graph.
pub fn broken(defect: Defect, n: usize, draw: &mut impl Draw) -> Pslg {
    let mut g = square();
    let step = f64::from(draw.integer(1, 31));
    let victim = draw.below(4);
    match defect {
        Defect::Crossing => append(&mut g, Point2::new(step, 32.0), Point2::new(64.0 + step, 33.0)),
        Defect::Duplicate => g.points.push(g.points[victim as usize]),
        Defect::ZeroLength => g.segments.push(segment(victim, victim)),
        Defect::Overlap => append(&mut g, Point2::new(step, 0.0), Point2::new(step + 16.0, 0.0)),
        Defect::Doubled => g.segments.push(segment((victim + 1) % 4, victim)),
        Defect::OnSegment => g.points.push(Point2::new(step, 64.0)),
        Defect::NotANumber => g.points[victim as usize].y = f64::NAN,
        Defect::Infinite => g.points[victim as usize].x = f64::NEG_INFINITY,
        Defect::TooLarge => g.points[2] = Point2::splat(two_to(871 + victim as i32)),
        Defect::TooSmall => g.points.push(Point2::new(step, two_to(-143 - victim as i32))),
        Defect::WrongIndex => g.segments.push(segment(victim, u32::MAX - draw.below(9))),
        Defect::Open => drop(g.segments.pop()),
        Defect::HoleOnSegment => g.holes.push(Point2::new(step, 0.0)),
        Defect::HoleOutside => g.holes.push(Point2::new(step, 65.0)),
        Defect::TwoRegions => {
            let region = |x| Region { seed: Point2::splat(x), attribute: x, max_area: None };
            g.regions.extend([region(step), region(step + 1.0)]);
        }
        Defect::Empty => return Pslg::default(),
        Defect::Flat => g.points = (0..4).map(|i| Point2::new(step, 2.0 * step) * f64::from(i)).collect(),
        Defect::OpenCycle => {
            g.fill = Fill::Parity;
            g.segments.push(segment(victim, (victim + 2) % 4));
        }
    }
    if matches!(defect, Defect::Open | Defect::Flat | Defect::TooLarge) || n < 12 {
        return g;
    }
    join(g, pslg(PslgFamily::Polygon(PointFamily::Grid), n - 6, draw))
}

/// Both graphs side by side: the second moved left of the first by an exact shift (its coordinates are small integers).
fn join(mut g: Pslg, beside: Pslg) -> Pslg {
    let first = g.points.len() as u32;
    g.points.extend(beside.points.iter().map(|&p| Point2::new(-8.0 - p.x, p.y)));
    g.segments.extend(beside.segments.iter().map(|s| segment(s.ends[0].0 + first, s.ends[1].0 + first)));
    g
}

#[cfg(test)]
mod tests {
    use super::super::SplitMix64;
    use super::super::planar::{Planar, inside_segment};
    use super::*;

    /// Which of the geometric defects a graph shows, by brute force.
    fn found(g: &Pslg) -> Option<Defect> {
        let mut graph = Planar::default();
        for (i, &p) in g.points.iter().enumerate() {
            if !p.is_finite() {
                return Some(if p.is_nan() { Defect::NotANumber } else { Defect::Infinite });
            }
            if graph.vertex(p) != Some(i as u32) {
                return Some(Defect::Duplicate);
            }
        }
        for s in &g.segments {
            let [u, v] = s.ends.map(|v| v.0);
            if u.max(v) as usize >= g.points.len() {
                return Some(Defect::WrongIndex);
            }
            if u == v {
                return Some(Defect::ZeroLength);
            }
            if !graph.segment(u, v) {
                let [a, b] = [u, v].map(|v| g.points[v as usize]);
                let inside: Vec<Point2> = g.points.iter().copied().filter(|&p| inside_segment(p, a, b)).collect();
                return Some(match inside.len() {
                    0 if graph.segments().iter().any(|t| *t == [v, u] || *t == [u, v]) => Defect::Doubled,
                    0 => Defect::Crossing,
                    1 => Defect::OnSegment,
                    _ => Defect::Overlap,
                });
            }
        }
        None
    }

    #[test]
    fn each_defect_is_there_and_alone() {
        use Defect::*;
        for defect in Defect::ALL {
            let geometric = !matches!(
                defect,
                TooLarge | TooSmall | Open | OpenCycle | HoleOnSegment | HoleOutside | TwoRegions | Empty | Flat
            );
            for seed in 0..30 {
                let g = broken(defect, 3 + seed as usize, &mut SplitMix64(seed));
                match defect {
                    Flat => assert_ne!(found(&g), None),
                    _ => assert_eq!(found(&g), geometric.then_some(defect), "{defect:?} {seed}: {g:?}"),
                }
            }
        }
    }
}
