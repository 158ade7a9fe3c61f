//! Between doubles and rationals: pairs of doubles with a proven running error bound, and exact zeros.
//!
//! Problem: points near one sphere or plane leave a filter undecided by the million, and a rational takes microseconds. Idea: the unevaluated sum of two
//! doubles has twice the digits; where no digit is lost, the error stays 0 and even a tie is certain. Sources: Dekker (1971), Knuth; the bounds of
//! sums (3 u^2) and products (5 u^2, without fused operations; u = 2^-53) are those of Joldes, Muller and Popescu (2017), rounded up. Bounds are themselves
//! rounded, which the factor in `sign` pays for. A product may lose up to `TINY` by underflow.

use crate::check::scale::power_of_two;
use crate::check::value::Number;
use crate::model::Sign;
use std::ops::{Add, Mul, Sub};

/// A value within `error` of `high + low`; |low| is at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug)]
pub struct Double {
    high: f64,
    low: f64,
    error: f64,
}

/// u^2 = 2^-106.
const UNIT2: f64 = f64::EPSILON * f64::EPSILON / 4.0;
/// Covers everything that underflow can lose in one product.
const TINY: f64 = 1e-300;
/// Magnitudes of exact products that lose nothing by underflow.
const SAFE: std::ops::Range<f64> = 1e-280..1e280;

/// a + b as a rounded sum and its error.
#[inline]
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let part = sum - a;
    [sum, (a - (sum - part)) + (b - part)]
}

/// The same where |a| >= |b| or a = 0.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    [sum, b - (sum - a)]
}

/// a b as a rounded product and its error.
#[inline]
fn two_product(a: f64, b: f64) -> [f64; 2] {
    // Halves of 26 bits; beyond 2^996 they overflow, and nothing is certain.
    let split = |x: f64| {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        [high, x - high]
    };
    let ([a1, a2], [b1, b2]) = (split(a), split(b));
    let product = a * b;
    [product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2]
}

impl Double {
    /// Whether it is exactly zero.
    #[inline]
    fn is_zero(self) -> bool {
        self.high == 0.0 && self.low == 0.0 && self.error == 0.0
    }
}

impl Add for Double {
    type Output = Double;
    #[inline]
    fn add(self, other: Double) -> Double {
        let [sum, rest] = two_sum(self.high, other.high);
        let inherited = self.error + other.error;
        if self.low == 0.0 && other.low == 0.0 {
            return Double { high: sum, low: rest, error: inherited };
        }
        let [low, lower] = two_sum(self.low, other.low);
        let [sum, rest] = quick_two_sum(sum, rest + low);
        let [high, low] = quick_two_sum(sum, rest + lower);
        Double { high, low, error: inherited + 4.0 * UNIT2 * high.abs() }
    }
}

impl Sub for Double {
    type Output = Double;
    #[inline]
    fn sub(self, other: Double) -> Double {
        self + Double { high: -other.high, low: -other.low, error: other.error }
    }
}

impl Mul for Double {
    type Output = Double;
    #[inline]
    fn mul(self, other: Double) -> Double {
        // What the other stands for is finite: nothing of it is left.
        if self.is_zero() || other.is_zero() {
            return Double { high: 0.0, low: 0.0, error: 0.0 };
        }
        let [product, rest] = two_product(self.high, other.high);
        let inherited = self.high.abs() * other.error + other.high.abs() * self.error + self.error * other.error;
        if self.low == 0.0 && other.low == 0.0 {
            let exact = self.error == 0.0 && other.error == 0.0 && SAFE.contains(&product.abs());
            return Double { high: product, low: rest, error: if exact { 0.0 } else { inherited + TINY } };
        }
        let [high, low] = quick_two_sum(product, rest + (self.high * other.low + self.low * other.high));
        Double { high, low, error: inherited + 8.0 * UNIT2 * high.abs() + TINY }
    }
}

impl Number for Double {
    fn scaled(x: f64, exponent: i32) -> Double {
        let high = if exponent == 0 { x } else { x * power_of_two(exponent) };
        // Outside the range of doubles the rational decides.
        let exact = exponent == 0 || x == 0.0 || SAFE.contains(&high.abs());
        Double { high, low: 0.0, error: if exact { 0.0 } else { f64::INFINITY } }
    }

    #[inline]
    fn sign(&self) -> Option<Sign> {
        // Any NaN or infinity fails all comparisons, and so leaves the answer open.
        let (value, margin) = (self.high + self.low, self.error * (1.0 + 1e-6));
        if value > margin {
            Some(Sign::Positive)
        } else if value < -margin {
            Some(Sign::Negative)
        } else if margin == 0.0 && value == 0.0 {
            Some(Sign::Zero)
        } else {
            None
        }
    }
}

/// Evaluates a formula in pairs of doubles, and over the rationals if its sign stays open.
macro_rules! sign_in_space {
    ($formula:ident($($argument:expr),*)) => {{
        use $crate::check::space::double::Double;
        use $crate::check::value::{Exact, Number, exact_sign};
        match $formula::<Double>($($argument),*).sign() {
            Some(sign) => sign,
            None => exact_sign(&$formula::<Exact>($($argument),*)),
        }
    }};
}
pub(crate) use sign_in_space;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::value::{Exact, exact_sign};

    /// ((a + b)(c - d) - e f) g, twice over; f is free to make it nearly zero.
    fn formula<N: Number>([a, b, c, d, e, f, g]: [f64; 7]) -> N {
        let n = N::of;
        let x = ((n(a) + n(b)) * (n(c) - n(d)) - n(e) * n(f)) * n(g);
        x.clone() * x.clone() - x.square() + x
    }

    #[test]
    fn certain_signs_are_right_and_most_are_certain() {
        let mut state = 7u64;
        let mut draw = |bits: u32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> (64 - bits)) as f64 / power_of_two(bits as i32) - 0.5
        };
        let (mut zeros, mut open) = (0, 0);
        for i in 0..20_000 {
            let bits = [3, 12, 26, 27, 53][i % 5];
            let mut x: [f64; 7] = std::array::from_fn(|_| draw(bits));
            if i % 3 == 0 {
                x[5] = (x[0] + x[1]) * (x[2] - x[3]) / x[4];
            }
            if i % 7 == 0 {
                x = x.map(|x| x * power_of_two(-(i as i32 % 400)));
            }
            if !x[5].is_finite() {
                continue;
            }
            let exact = exact_sign(&formula::<Exact>(x));
            match formula::<Double>(x).sign() {
                Some(sign) => assert_eq!(sign, exact, "{x:?}"),
                None => open += 1,
            }
            zeros += usize::from(exact == Sign::Zero);
        }
        assert!(zeros > 100 && open < 2000, "{zeros} zeros, {open} open");
    }

    /// Zero times a product that was rounded is zero: four points with the same x.
    #[test]
    fn zeros_absorb() {
        let point = |y: f64, z: f64| crate::model::Point3::new(0.1, y, z);
        let third = 1.0 / 3.0;
        let [a, b, c, d] = [point(third, 0.7), point(-0.9, third), point(0.3, 0.1), point(0.77, -third)];
        let volume = crate::check::space::predicates::volume6::<Double>(a, b, c, d);
        assert_eq!(volume.sign(), Some(Sign::Zero));
        let far = crate::model::Point3::new(0.1f64.next_up(), 0.2, 0.3);
        assert_ne!(crate::check::space::predicates::volume6::<Double>(a, b, c, far).sign(), Some(Sign::Zero));
    }
}
