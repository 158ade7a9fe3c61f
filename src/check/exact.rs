//! The last resort of `value`: rationals of GMP, or of dashu where the feature `exact` is off. A binding only; no formula is here.

use super::value::Number;
use crate::model::Sign;
use std::ops::{Add, Div, Mul, Sub};

#[cfg(feature = "exact")]
mod rational {
    pub use rug::Rational;

    pub fn from_f64(x: f64) -> Rational {
        // Finite by the callers' checks of every coordinate and parameter; a NaN would only be a wrong 0 here.
        Rational::from_f64(x).unwrap_or_default()
    }

    pub fn shift(x: Rational, exponent: i32) -> Rational {
        x << exponent
    }

    pub fn cmp0(x: &Rational) -> std::cmp::Ordering {
        x.cmp0()
    }
}

#[cfg(not(feature = "exact"))]
mod rational {
    use dashu_int::{IBig, UBig};
    pub use dashu_ratio::Relaxed as Rational;

    pub fn from_f64(x: f64) -> Rational {
        // Finite by the callers' checks of every coordinate and parameter; a NaN would only be a wrong 0 here.
        Rational::try_from(x).unwrap_or(Rational::ZERO)
    }

    pub fn shift(x: Rational, exponent: i32) -> Rational {
        let power = UBig::ONE << exponent.unsigned_abs() as usize;
        let factor = IBig::from(power);
        if exponent >= 0 { x * factor } else { x / factor }
    }

    pub fn cmp0(x: &Rational) -> std::cmp::Ordering {
        x.cmp(&Rational::ZERO)
    }
}

/// A rational number.
#[derive(Clone, Debug)]
pub struct Exact(pub(crate) rational::Rational);

impl Add for Exact {
    type Output = Exact;
    fn add(self, other: Exact) -> Exact {
        Exact(self.0 + other.0)
    }
}

impl Sub for Exact {
    type Output = Exact;
    fn sub(self, other: Exact) -> Exact {
        Exact(self.0 - other.0)
    }
}

impl Mul for Exact {
    type Output = Exact;
    fn mul(self, other: Exact) -> Exact {
        Exact(self.0 * other.0)
    }
}

impl Div for Exact {
    type Output = Exact;
    /// The divisor is not 0.
    fn div(self, other: Exact) -> Exact {
        Exact(self.0 / other.0)
    }
}

impl Number for Exact {
    fn scaled(x: f64, exponent: i32) -> Exact {
        Exact(rational::shift(rational::from_f64(x), exponent))
    }

    fn sign(&self) -> Option<Sign> {
        Some(exact_sign(self))
    }
}

/// The sign of a rational.
pub fn exact_sign(x: &Exact) -> Sign {
    match rational::cmp0(&x.0) {
        std::cmp::Ordering::Less => Sign::Negative,
        std::cmp::Ordering::Equal => Sign::Zero,
        std::cmp::Ordering::Greater => Sign::Positive,
    }
}
