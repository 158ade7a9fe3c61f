//! Input normalisation: one exact division by a power of two.
//!
//! Coordinates are divided by 2^e, e such that the largest magnitude comes to lie in [1/2, 1). Rounding to nearest
//! commutes with that, so a run is the same at every scale, and the way back is exact. Predicates are exact only without
//! underflow: a nonzero normalised coordinate below 2^-142 is refused, and so is an input whose e leaves -870..=870.
//! Source: `docs/notation.md`, range rules.

use super::finding::{Element, Finding, Findings, Kind};
use crate::arith::scale::{by_power_of_two, exponent_of};
use crate::model::{Lines, Point2, VertexId};

/// Largest |e| of an input scale 2^e.
pub const LARGEST_SCALE: i32 = 870;

/// The least magnitude of a nonzero normalised coordinate is 2 to this power.
pub const LEAST_COORDINATE: i32 = -142;

/// The greatest magnitude of a normalised coordinate, of a seed or constructed, is 2 to this power.
pub const GREATEST_COORDINATE: i32 = 200;

/// The power of two between input units and normalised coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scale {
    /// Normalised coordinates are input coordinates divided by 2 to this power.
    pub exponent: i32,
}

impl Scale {
    /// From input units to normalised coordinates; exact for coordinates that `normalise` accepted.
    pub fn to_normal(self, p: Point2) -> Point2 {
        self.times(p, -self.exponent)
    }

    /// From normalised coordinates to input units; exact for magnitudes of at least 2^-142.
    pub fn to_input(self, p: Point2) -> Point2 {
        self.times(p, self.exponent)
    }

    /// A length in input units, normalised; clamped to 2^-300..2^300, which no length between vertices leaves.
    pub fn length_to_normal(self, h: f64) -> f64 {
        by_power_of_two(h, -self.exponent).clamp(power_of_two(-300), power_of_two(300))
    }

    /// An area in input units squared, normalised; clamped to 2^-600..2^600, which no triangle's area leaves: vertices
    /// are multiples of 2^-194 below 2^200.
    pub fn area_to_normal(self, area: f64) -> f64 {
        by_power_of_two(area, -2 * self.exponent).clamp(power_of_two(-600), power_of_two(600))
    }

    fn times(self, p: Point2, exponent: i32) -> Point2 {
        // Adding 0 turns -0 into +0.
        Point2::new(by_power_of_two(p.x, exponent) + 0.0, by_power_of_two(p.y, exponent) + 0.0)
    }
}

/// 2^k.
pub(super) fn power_of_two(k: i32) -> f64 {
    by_power_of_two(1.0, k)
}

/// Normalises points: their coordinates divided by 2^e, and that e. -0 becomes +0; points that are all zero have e = 0.
///
/// Errors: a finding for each vertex that is not finite or out of range.
pub fn normalise(points: &[Point2], lines: &Lines) -> Result<(Vec<Point2>, Scale), Vec<Finding>> {
    let mut findings = Findings::default();
    let (normal, scale) = normalise_all(points, lines, &mut findings);
    let all = normal.into_iter().collect::<Option<Vec<_>>>();
    match all {
        Some(points) if !findings.any_error() => Ok((points, scale)),
        _ => Err(findings.finish()),
    }
}

/// As `normalise`, but goes on: `None` for each vertex that cannot be used, with its finding.
pub(super) fn normalise_all(points: &[Point2], lines: &Lines, findings: &mut Findings) -> (Vec<Option<Point2>>, Scale) {
    let mut largest = 0.0f64;
    for p in points.iter().filter(|p| p.is_finite()) {
        largest = largest.max(p.x.abs()).max(p.y.abs());
    }
    let exponent = if largest > 0.0 { exponent_of(largest) } else { 0 };
    let in_scale = exponent.abs() <= LARGEST_SCALE;
    let scale = Scale { exponent: if in_scale { exponent } else { 0 } };
    let least = if largest > 0.0 && in_scale { power_of_two(LEAST_COORDINATE) } else { 0.0 };
    let mut normal = Vec::with_capacity(points.len());
    let mut at_scale = None;
    for (i, &p) in points.iter().enumerate() {
        let v = Element::Vertex(VertexId(i as u32));
        if !p.is_finite() {
            let message = format!("{v} has a coordinate that is not finite: ({:e}, {:e})", p.x, p.y);
            findings.add(Kind::NotFinite, || Finding::new(Kind::NotFinite, vec![v], vec![p], lines, message));
            normal.push(None);
            continue;
        }
        if !in_scale {
            // The vertex of largest magnitude speaks for all.
            if at_scale.is_none() && p.abs().max_element() == largest {
                at_scale = Some((v, p));
            }
            normal.push(None);
            continue;
        }
        let q = scale.to_normal(p);
        let small = |x: f64, input: f64| input != 0.0 && x.abs() < least;
        if small(q.x, p.x) || small(q.y, p.y) {
            findings.add(Kind::OutOfRange, || {
                let message = format!(
                    "{v} at ({:e}, {:e}) has a nonzero coordinate below 2^{LEAST_COORDINATE} of the input's extent 2^{exponent}",
                    p.x, p.y
                );
                Finding::new(Kind::OutOfRange, vec![v], vec![p], lines, message)
            });
            normal.push(None);
            continue;
        }
        normal.push(Some(q));
    }
    if let Some((v, p)) = at_scale {
        findings.add(Kind::OutOfRange, || {
            let message = format!(
                "the largest coordinate, of {v} at ({:e}, {:e}), is outside of 2^-{LARGEST_SCALE} to 2^{LARGEST_SCALE}",
                p.x, p.y
            );
            Finding::new(Kind::OutOfRange, vec![v], vec![p], lines, message)
        });
    }
    (normal, scale)
}

/// Whether a seed's normalised coordinates can be computed with: nonzero ones within 2^-142..2^200.
pub(super) fn seed_in_range(seed: Point2, scale: Scale) -> bool {
    let in_range = |x: f64| {
        let e = if x == 0.0 {
            return true;
        } else {
            exponent_of(x.abs()) - scale.exponent
        };
        (LEAST_COORDINATE + 1..=GREATEST_COORDINATE).contains(&e)
    };
    in_range(seed.x) && in_range(seed.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    #[test]
    fn largest_comes_to_lie_below_one_and_back() {
        for points in [
            vec![p(3.0, -4.0), p(-0.0, 1e-20)],
            vec![p(1e200, 1e190), p(0.0, 1e199)],
            vec![p(-1e-260, 3e-261), p(1e-270, 0.0)],
            vec![p(0.0, -0.0)],
            vec![],
        ] {
            let (normal, scale) = normalise(&points, &Lines::default()).expect("in range");
            let largest = normal.iter().fold(0.0f64, |m, q| m.max(q.abs().max_element()));
            assert!(largest == 0.0 || (0.5..1.0).contains(&largest), "{largest}");
            for (a, b) in points.iter().zip(&normal) {
                assert_eq!(scale.to_input(*b), *a);
                assert!(b.x.to_bits() != (-0.0f64).to_bits() && b.y.to_bits() != (-0.0f64).to_bits());
            }
        }
    }

    #[test]
    fn extremes_are_refused_with_their_place() {
        let lines = Lines { points: vec![7, 8, 9], ..Lines::default() };
        let table = [
            (vec![p(0.0, 0.0), p(1e300, 0.0), p(0.0, 1.0)], Kind::OutOfRange, 8),
            (vec![p(0.0, 0.0), p(1e-300, 0.0), p(0.0, 1e-301)], Kind::OutOfRange, 8),
            (vec![p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1e-60)], Kind::OutOfRange, 9),
            (vec![p(f64::NAN, 0.0), p(1.0, 0.0), p(0.0, 1.0)], Kind::NotFinite, 7),
            (vec![p(1.0, 0.0), p(1.0, 0.0), p(0.0, f64::INFINITY)], Kind::NotFinite, 9),
        ];
        for (points, kind, line) in table {
            let findings = normalise(&points, &lines).expect_err("refused");
            assert_eq!(findings.len(), 1, "{findings:?}");
            assert_eq!((findings[0].kind, &findings[0].lines[..]), (kind, &[line][..]));
        }
        // The windows' ends, exactly: 2^870 is the first magnitude with e = 871, 2^-142 the least coordinate beside 1/2.
        let edge = |largest: f64, small: f64| normalise(&[p(largest, small)], &Lines::default()).is_ok();
        assert!(!edge(power_of_two(870), 0.0) && edge(power_of_two(869), 0.0));
        assert!(edge(power_of_two(-871), 0.0) && !edge(power_of_two(-872), 0.0));
        assert!(edge(0.5, power_of_two(-142)) && !edge(0.5, power_of_two(-142).next_down()));
    }
}
