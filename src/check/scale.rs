//! Units: the checker computes in coordinates scaled by a power of two, exactly.

use super::verdict::{Checked, Rule, ensure};
use crate::model::Point2;

/// The power of two that brings coordinates to [1/2, 1).
#[derive(Clone, Copy, Debug, Default)]
pub struct Scale {
    /// Input units = scaled units times 2^`exponent`.
    pub exponent: i32,
}

impl Scale {
    /// A stored point of an event, scaled: finite, no -0, of full precision, within 2^200.
    pub fn place(self, p: Point2) -> Checked<Point2> {
        let (down, up) = (power_of_two(-self.exponent), power_of_two(self.exponent));
        let scaled = Point2::new(p.x * down, p.y * down);
        for (x, s) in [(p.x, scaled.x), (p.y, scaled.y)] {
            let size = s.abs();
            let in_range = s == 0.0 || (power_of_two(-142)..=power_of_two(200)).contains(&size);
            let stored = x.is_finite() && s * up == x && x.to_bits() != (-0.0f64).to_bits();
            ensure(in_range && stored, Rule::Coordinate, || {
                ("a coordinate within 2^-142..2^200 of the input's size, or +0", format!("{x:?}"))
            })?;
        }
        Ok(scaled)
    }
}

/// 2^`exponent` as a f64; 0 or infinity outside its range.
pub fn power_of_two(exponent: i32) -> f64 {
    match exponent {
        1024.. => f64::INFINITY,
        -1022..=1023 => f64::from_bits(((exponent + 1023) as u64) << 52),
        -1074..=-1023 => f64::from_bits(1 << (exponent + 1074)),
        _ => 0.0,
    }
}
