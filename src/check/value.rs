//! Numbers of the checker: a value with a proven error bound first, a rational when that cannot decide.
//!
//! Problem: every condition is the sign of a polynomial in stored f64s, almost always far from zero. Idea: each formula is
//! written once over [`Number`]; [`Approx`] carries a running bound of its absolute error and answers `None` when zero is
//! within it; [`Exact`] always answers. Error terms: one rounding is at most 2^-53 of the result; sums and products of
//! bounds follow the usual rules (Higham, running error analysis). The bounds are themselves rounded, which loses at most a
//! factor 1 + 2^-20 over any formula here; `sign` pays for it. Underflow costs at most `TINY` a product.

pub use super::exact::{Exact, exact_sign};
use super::scale::power_of_two;
use crate::model::Sign;
use std::ops::{Add, Mul, Sub};

/// A number that formulas can be written over.
pub trait Number: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The exact value of a finite f64 times 2^`exponent`.
    fn scaled(x: f64, exponent: i32) -> Self;

    /// The sign of the value, if it is certain.
    fn sign(&self) -> Option<Sign>;

    /// The exact value of a finite f64.
    fn of(x: f64) -> Self {
        Self::scaled(x, 0)
    }

    /// The square.
    fn square(&self) -> Self {
        self.clone() * self.clone()
    }
}

/// Evaluates a formula with error bounds, and over the rationals if its sign stays open.
macro_rules! sign_of {
    ($formula:ident($($argument:expr),*)) => {{
        use $crate::check::value::{Approx, Exact, Number};
        match $formula::<Approx>($($argument),*).sign() {
            Some(sign) => sign,
            None => $crate::check::value::exact_sign(&$formula::<Exact>($($argument),*)),
        }
    }};
}
pub(crate) use sign_of;

/// A value and a bound of its absolute error; 0 means that the value is exact.
#[derive(Clone, Copy, Debug)]
pub struct Approx {
    value: f64,
    error: f64,
}

/// 2^-53: one rounding to nearest, relative to the result.
const UNIT: f64 = f64::EPSILON / 2.0;
/// Covers everything that underflow can lose in one product.
const TINY: f64 = 1e-300;
/// Low bits that are zero in a f64 of at most 26 significant bits: a product of two such values is exact.
const LONG: u64 = (1 << 27) - 1;
/// Range in which a product of exact values neither under- nor overflows.
const SAFE: std::ops::Range<f64> = 1e-280..1e280;

impl Approx {
    /// An enclosure of the value: lower and upper bound.
    pub fn bounds(self) -> (f64, f64) {
        let e = self.error * (1.0 + 1e-6);
        ((self.value - e).next_down(), (self.value + e).next_up())
    }

    /// The value without its error, for choices that do not decide anything.
    pub fn value(self) -> f64 {
        self.value
    }

    fn is_short(self) -> bool {
        self.value.to_bits() & LONG == 0
    }
}

impl Add for Approx {
    type Output = Approx;
    #[inline]
    fn add(self, other: Approx) -> Approx {
        let value = self.value + other.value;
        let inherited = self.error + other.error;
        // Exact operands: the error of a floating sum is itself a f64 (two-sum, Knuth).
        let error = if inherited == 0.0 {
            let part = value - self.value;
            ((self.value - (value - part)) + (other.value - part)).abs()
        } else {
            inherited + UNIT * value.abs()
        };
        Approx { value, error }
    }
}

impl Sub for Approx {
    type Output = Approx;
    #[inline]
    fn sub(self, other: Approx) -> Approx {
        self + Approx { value: -other.value, error: other.error }
    }
}

impl Mul for Approx {
    type Output = Approx;
    #[inline]
    fn mul(self, other: Approx) -> Approx {
        let value = self.value * other.value;
        if self.error + other.error == 0.0 {
            let exact_zero = self.value == 0.0 || other.value == 0.0;
            if exact_zero || (self.is_short() && other.is_short() && SAFE.contains(&value.abs())) {
                return Approx { value, error: 0.0 };
            }
        }
        let inherited = self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Approx { value, error: inherited + UNIT * value.abs() + TINY }
    }
}

impl Number for Approx {
    fn scaled(x: f64, exponent: i32) -> Approx {
        if exponent == 0 {
            return Approx { value: x, error: 0.0 };
        }
        let value = x * power_of_two(exponent);
        // Outside the range of f64 the rational decides.
        let exact = SAFE.contains(&value.abs()) || x == 0.0;
        Approx { value, error: if exact { 0.0 } else { f64::INFINITY } }
    }

    #[inline]
    fn sign(&self) -> Option<Sign> {
        // Any NaN or infinity fails all three comparisons, and so leaves the answer open.
        let margin = self.error * (1.0 + 1e-6);
        if self.value > margin {
            Some(Sign::Positive)
        } else if self.value < -margin {
            Some(Sign::Negative)
        } else if self.error == 0.0 && self.value == 0.0 {
            Some(Sign::Zero)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests;
