//! The smallest angle of a triangle in degrees, for pictures and cell data. It decides nothing.
//!
//! Only the four operations and the square root are used, so that files are the same bytes on every machine.

use crate::model::Point2;

/// Smallest angle of a triangle in degrees, with a relative error of some 10^-15; 0 for a degenerate triangle.
pub(super) fn smallest_angle(corners: [Point2; 3]) -> f64 {
    let [a, b, c] = corners;
    // A common factor keeps squares in range; halving first keeps differences of huge coordinates finite.
    let half = [b * 0.5 - a * 0.5, c * 0.5 - b * 0.5, a * 0.5 - c * 0.5];
    let size = half.iter().fold(0.0, |m: f64, v| m.max(v.x.abs()).max(v.y.abs()));
    if size == 0.0 {
        return 0.0;
    }
    let side = half.map(|v| v / size);
    let length2 = side.map(|v| v.x * v.x + v.y * v.y);
    // The smallest angle is opposite the shortest side.
    let shortest = (0..3).fold(0, |s, i| if length2[i] < length2[s] { i } else { s });
    let (u, v) = (side[(shortest + 1) % 3], side[(shortest + 2) % 3]);
    let (sine, cosine) = ((u.x * v.y - u.y * v.x).abs(), -(u.x * v.x + u.y * v.y));
    // At most 60 degrees, so that the cosine is not small unless both vanish.
    if cosine <= 0.0 { 0.0 } else { arctangent(sine / cosine).to_degrees() }
}

/// arctan t for 0 <= t <= 2: halves the angle three times, then sums the series.
fn arctangent(t: f64) -> f64 {
    let mut t = t;
    for _ in 0..3 {
        t /= 1.0 + (1.0 + t * t).sqrt();
    }
    // t <= tan(arctan(2) / 8) < 0.14: 0.14^19 / 19 < 10^-17.
    let square = t * t;
    let series = (0..9).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - square * sum);
    8.0 * t * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles() {
        let at = |x: f64, y: f64| Point2::new(x, y);
        for k in 1..=60 {
            let degrees = f64::from(k);
            let apex = degrees.to_radians();
            // Isosceles with the apex angle given, which is the smallest up to 60 degrees.
            let t = [at(3.0, -1.0), at(5.0, -1.0), at(3.0 + 2.0 * apex.cos(), -1.0 + 2.0 * apex.sin())];
            assert!((smallest_angle(t) - degrees).abs() < 1e-12, "{degrees}");
        }
        assert_eq!(smallest_angle([at(0.0, 0.0), at(1.0, 1.0), at(2.0, 2.0)]), 0.0);
        assert_eq!(smallest_angle([at(1.0, 1.0); 3]), 0.0);
        let huge = [at(-1e308, -1e308), at(1e308, -1e308), at(1e308, 1e308)];
        assert!((smallest_angle(huge) - 45.0).abs() < 1e-12);
        assert!((smallest_angle(huge.map(|p| p * 1e-308 * 1e-300)) - 45.0).abs() < 1e-12);
    }
}
