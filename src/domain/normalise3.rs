//! Normalisation of points of space: coordinates divided by 2^e, weights by 4^e, exactly.
//!
//! As in the plane (`normalise`), e brings the largest coordinate to [1/2, 1), whatever the weights are. A nonzero coordinate below 2^-142, and a
//! nonzero weight outside 2^-284..=2^400, are refused: the squares of what is allowed of coordinates. Equal points are no error: a triangulation
//! says what becomes of them. Source: `docs/notation.md`, range rules.

use super::finding::{Finding, Findings, Kind};
use super::normalise::{LARGEST_SCALE, LEAST_COORDINATE, Scale, power_of_two};
use crate::arith::scale::{by_power_of_two, exponent_of};
use crate::model::{Point3, PointSet3, VertexId, WeightedPoint};

/// The least magnitude of a nonzero normalised weight is 2 to this power.
pub const LEAST_WEIGHT: i32 = -284;

/// The greatest magnitude of a normalised weight is 2 to this power.
pub const GREATEST_WEIGHT: i32 = 400;

impl Scale {
    /// From input units to normalised numbers; exact for points that `normalise3` accepted.
    pub fn to_normal3(self, p: WeightedPoint) -> WeightedPoint {
        self.times3(p, -self.exponent)
    }

    /// From normalised numbers to input units; exact for what came from there.
    pub fn to_input3(self, p: WeightedPoint) -> WeightedPoint {
        self.times3(p, self.exponent)
    }

    fn times3(self, p: WeightedPoint, exponent: i32) -> WeightedPoint {
        // Adding 0 turns -0 into +0.
        let times = |x: f64| by_power_of_two(x, exponent) + 0.0;
        let at = Point3::new(times(p.at.x), times(p.at.y), times(p.at.z));
        WeightedPoint { at, weight: by_power_of_two(p.weight, 2 * exponent) + 0.0 }
    }
}

/// Normalises points and weights; -0 becomes +0; points that are all zero have e = 0.
///
/// Errors: a finding for each point that is not finite or out of range, with its line where the set knows lines.
pub fn normalise3(set: &PointSet3) -> Result<(Vec<WeightedPoint>, Scale), Vec<Finding>> {
    let mut findings = Findings::default();
    let largest = set.points.iter().filter(|p| p.is_finite()).fold(0.0f64, |m, p| m.max(p.abs().max_element()));
    let exponent = exponent_of(largest);
    let scale = Scale { exponent: if exponent.abs() <= LARGEST_SCALE { exponent } else { 0 } };
    let mut normal = Vec::with_capacity(set.points.len());
    let mut scale_told = exponent.abs() <= LARGEST_SCALE;
    for (i, p) in set.weighted().enumerate() {
        let refusal = refusal(p, scale).or_else(|| {
            // The point of largest magnitude speaks for all.
            let speaks = !scale_told && p.at.abs().max_element() == largest;
            scale_told |= speaks;
            speaks.then(|| {
                let message = format!("has the largest coordinate, outside of 2^-{LARGEST_SCALE} to 2^{LARGEST_SCALE}");
                (Kind::OutOfRange, message)
            })
        });
        match refusal {
            Some((kind, why)) => findings.add(kind, || {
                let message = format!("point {i} at ({:?}, {:?}, {:?}) {why}", p.at.x, p.at.y, p.at.z);
                let line = set.lines.get(i).copied().unwrap_or(0);
                Finding::in_space(kind, VertexId(i as u32), p.at, line, message)
            }),
            None => normal.push(scale.to_normal3(p)),
        }
    }
    if findings.any_error() { Err(findings.finish()) } else { Ok((normal, scale)) }
}

/// A single point at a given scale. Errors: a finding if it is not finite or out of range.
pub fn normalise3_at(p: WeightedPoint, id: VertexId, scale: Scale) -> Result<WeightedPoint, Box<Finding>> {
    let beyond = |x: f64| by_power_of_two(x.abs(), -scale.exponent) > power_of_two(super::GREATEST_COORDINATE);
    let far = || {
        let large = p.at.to_array().into_iter().any(beyond);
        large.then(|| (Kind::OutOfRange, format!("has a coordinate far beyond the scale 2^{}", scale.exponent)))
    };
    match refusal(p, scale).or_else(far) {
        None => Ok(scale.to_normal3(p)),
        Some((kind, why)) => {
            let message = format!("point {} at ({:?}, {:?}, {:?}) {why}", id.0, p.at.x, p.at.y, p.at.z);
            Err(Box::new(Finding::in_space(kind, id, p.at, 0, message)))
        }
    }
}

/// Why a point cannot be computed with.
fn refusal(p: WeightedPoint, scale: Scale) -> Option<(Kind, String)> {
    if !p.at.is_finite() {
        return Some((Kind::NotFinite, "has a coordinate that is not finite".into()));
    }
    if !p.weight.is_finite() {
        return Some((Kind::NotFinite, format!("has a weight that is not finite: {:?}", p.weight)));
    }
    let normal = scale.to_normal3(p);
    let least = power_of_two(LEAST_COORDINATE);
    let small = |x: f64, input: f64| input != 0.0 && x.abs() < least;
    let (q, e) = (normal.at, scale.exponent);
    if small(q.x, p.at.x) || small(q.y, p.at.y) || small(q.z, p.at.z) {
        let why = format!(
            "has a nonzero coordinate below 2^{LEAST_COORDINATE} (about 10^-43) of the largest coordinate, which is at most 2^{e}"
        );
        return Some((Kind::OutOfRange, why));
    }
    let weights = power_of_two(LEAST_WEIGHT)..=power_of_two(GREATEST_WEIGHT);
    if p.weight != 0.0 && !weights.contains(&normal.weight.abs()) {
        let why = format!(
            "has a nonzero weight {:?} outside of 2^{LEAST_WEIGHT} to 2^{GREATEST_WEIGHT} of the square of the largest coordinate, which is at most 2^{e}",
            p.weight
        );
        return Some((Kind::OutOfRange, why));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(points: &[[f64; 3]], weights: &[f64]) -> PointSet3 {
        let lines = (0..points.len() as u32).map(|i| i + 5).collect();
        let points = points.iter().map(|&p| Point3::from_array(p)).collect();
        PointSet3 { points, weights: weights.to_vec(), lines, ..PointSet3::default() }
    }

    #[test]
    fn coordinates_and_weights_go_to_their_scale_and_back() {
        for (points, weights) in [
            (vec![[3.0, -4.0, 0.5], [-0.0, 1e-20, 7.9]], vec![1e9, -3.0]),
            (vec![[1e200, 1e190, 0.0]], vec![]),
            (vec![[-1e-260, 3e-261, 0.0], [0.0, 0.0, 1e-261]], vec![]),
            (vec![[0.0, -0.0, 0.0]], vec![-0.0]),
            (vec![[1.0, 1.0, 1.0], [1.0, 1.0, 1.0]], vec![2.0, 2.0]),
            (vec![], vec![]),
        ] {
            let set = set(&points, &weights);
            let (normal, scale) = normalise3(&set).expect("in range");
            let largest = normal.iter().fold(0.0f64, |m, q| m.max(q.at.abs().max_element()));
            assert!(largest == 0.0 || (0.5..1.0).contains(&largest), "{largest}");
            assert_eq!(normal.len(), points.len());
            for (a, b) in set.weighted().zip(&normal) {
                let back = scale.to_input3(*b);
                assert_eq!(back, a);
                let negative_zero = |x: f64| x.to_bits() == (-0.0f64).to_bits();
                assert!(!b.at.to_array().into_iter().chain([b.weight]).any(negative_zero));
            }
        }
    }

    #[test]
    fn extremes_are_refused_with_their_line() {
        let table = [
            (set(&[[0.0; 3], [1e300, 0.0, 0.0]], &[]), Kind::OutOfRange, 6),
            (set(&[[0.0; 3], [1e-300, 0.0, 0.0]], &[]), Kind::OutOfRange, 6),
            (set(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1e-60]], &[]), Kind::OutOfRange, 6),
            (set(&[[0.0, f64::NAN, 1.0], [1.0, 0.0, 0.0]], &[]), Kind::NotFinite, 5),
            (set(&[[0.0, 2.0, 1.0], [1.0, 0.0, 0.0]], &[0.0, f64::INFINITY]), Kind::NotFinite, 6),
            (set(&[[0.0, 2.0, 1.0], [1.0, 0.0, 0.0]], &[1e200, 0.0]), Kind::OutOfRange, 5),
            (set(&[[0.0, 2.0, 1.0], [1.0, 0.0, 0.0]], &[0.0, -1e-200]), Kind::OutOfRange, 6),
        ];
        for (set, kind, line) in table {
            let findings = normalise3(&set).expect_err("refused");
            assert_eq!(findings.len(), 1, "{findings:?}");
            assert_eq!((findings[0].kind, &findings[0].lines[..], findings[0].places.len()), (kind, &[line][..], 1));
        }
        // The windows' ends, exactly: the extent 1/2 has e = 0.
        let edge = |small: f64, weight: f64| normalise3(&set(&[[0.5, small, 0.0]], &[weight])).is_ok();
        let (least, greatest) = (power_of_two(LEAST_WEIGHT), power_of_two(GREATEST_WEIGHT));
        assert!(edge(power_of_two(-142), least) && edge(0.0, -greatest));
        assert!(!edge(power_of_two(-142).next_down(), 0.0) && !edge(0.0, least.next_down()));
        assert!(!edge(0.0, greatest.next_up()));
    }
}
