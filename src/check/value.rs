//! Numbers of the checker: a value with a proven error bound first, a rational when that cannot decide.
//!
//! Problem: every condition is the sign of a polynomial in stored f64s, almost always far from zero. Idea: each formula is
//! written once over [`Number`]; [`Approx`] carries a running bound of its absolute error and answers `None` when zero is
//! within it; [`Exact`] always answers. Error terms: one rounding is at most 2^-53 of the result; sums and products of
//! bounds follow the usual rules (Higham, running error analysis). The bounds are themselves rounded, which loses at most a
//! factor 1 + 2^-20 over any formula here; `sign` pays for it. Underflow costs at most `TINY` a product.

use crate::model::Sign;
use std::ops::{Add, Div, Mul, Sub};

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
        self + Approx {
            value: -other.value,
            error: other.error,
        }
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
        let inherited = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Approx {
            value,
            error: inherited + UNIT * value.abs() + TINY,
        }
    }
}

impl Number for Approx {
    fn scaled(x: f64, exponent: i32) -> Approx {
        if exponent == 0 {
            return Approx {
                value: x,
                error: 0.0,
            };
        }
        let value = x * power_of_two(exponent);
        // Outside the range of f64 the rational decides.
        let exact = SAFE.contains(&value.abs()) || x == 0.0;
        Approx {
            value,
            error: if exact { 0.0 } else { f64::INFINITY },
        }
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

/// 2^`exponent` as a f64; 0 or infinity outside its range.
pub fn power_of_two(exponent: i32) -> f64 {
    match exponent {
        1024.. => f64::INFINITY,
        -1022..=1023 => f64::from_bits(((exponent + 1023) as u64) << 52),
        -1074..=-1023 => f64::from_bits(1 << (exponent + 1074)),
        _ => 0.0,
    }
}

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
        if exponent >= 0 {
            x * factor
        } else {
            x / factor
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn shape<N: Number>(a: f64, b: f64, c: f64, d: f64) -> N {
        N::of(a) * N::of(b) - N::of(c) * N::of(d)
    }

    #[test]
    fn bounds_never_lie() {
        let mut state = 1u64;
        let mut random = move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        let (mut decided, mut open) = (0, 0);
        for n in 0..20_000 {
            let a = random();
            let near = power_of_two(-(n % 60));
            let (b, c) = (random(), random());
            let d = a * b / c + random() * near;
            match shape::<Approx>(a, b, c, d).sign() {
                Some(s) => {
                    assert_eq!(s, exact_sign(&shape::<Exact>(a, b, c, d)));
                    decided += 1;
                }
                None => open += 1,
            }
        }
        assert!(
            decided > 10_000 && open > 1_000,
            "{decided} decided, {open} open"
        );
    }

    #[test]
    fn small_integers_are_exact() {
        let zero = |a: f64, b: f64| {
            (Approx::of(a) - Approx::of(b)).square() - (Approx::of(b) - Approx::of(a)).square()
        };
        assert_eq!(zero(3.0, 8.0).sign(), Some(Sign::Zero));
        assert_eq!(zero(0.1, 0.3).sign(), None);
        assert_eq!(Approx::scaled(1.0, 2000).sign(), None);
        assert_eq!(Exact::scaled(1.0, 2000).sign(), Some(Sign::Positive));
    }
}
