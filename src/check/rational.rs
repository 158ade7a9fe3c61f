//! The checker's own rational numbers: GMP's, or those of dashu where the feature `exact` is off.
//!
//! Only what the checker needs is here. Nothing of `arith` is used.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[cfg(not(feature = "exact"))]
use dashu_ratio::RBig as Repr;
#[cfg(feature = "exact")]
use rug::Rational as Repr;

/// Bits of a square root that is not rational.
const ROOT_BITS: u32 = 160;

/// A rational number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rational(Repr);

impl Rational {
    /// The exact value of a finite number.
    ///
    /// Panics on infinities and NaN: the readers of the checker refuse them.
    pub fn of(x: f64) -> Self {
        assert!(x.is_finite(), "a number of the trace is not finite");
        #[cfg(feature = "exact")]
        let exact = Repr::from_f64(x);
        #[cfg(not(feature = "exact"))]
        let exact = Repr::try_from(x).ok();
        // every finite f64 is rational
        Self(exact.unwrap())
    }

    /// A quotient of small integers; the denominator is not 0.
    pub fn ratio(numerator: i32, denominator: u32) -> Self {
        Self::of(f64::from(numerator)) / Self::of(f64::from(denominator))
    }

    /// Order against zero.
    pub fn sign(&self) -> Ordering {
        #[cfg(feature = "exact")]
        return self.0.cmp0();
        #[cfg(not(feature = "exact"))]
        self.0.cmp(&Repr::ZERO)
    }

    /// A nearby f64, for display.
    pub fn to_f64(&self) -> f64 {
        #[cfg(feature = "exact")]
        return self.0.to_f64();
        #[cfg(not(feature = "exact"))]
        self.0.to_f64_fast()
    }

    /// The square, never negative.
    #[must_use]
    pub fn squared(&self) -> Self {
        self * self
    }

    /// Bounds `low <= sqrt(self) <= high`: equal if the root is rational, else within 2^-160 of each other, relatively.
    ///
    /// `None` for a negative number. With self = n/d in lowest terms, sqrt(self) = sqrt(n d)/d, and n d is a square of an
    /// integer exactly if the root is rational.
    pub fn root(&self) -> Option<(Self, Self)> {
        match self.sign() {
            Ordering::Less => None,
            Ordering::Equal => Some((self.clone(), self.clone())),
            Ordering::Greater => Some(self.positive_root()),
        }
    }

    #[cfg(feature = "exact")]
    fn positive_root(&self) -> (Self, Self) {
        use rug::{Complete, Integer};
        let product = (self.0.numer() * self.0.denom()).complete();
        let shift = ROOT_BITS.saturating_sub(product.significant_bits() / 2);
        let (root, rest) = (product << (2 * shift)).sqrt_rem(Integer::new());
        let exact = rest == 0;
        let denominator = Integer::from(self.0.denom() << shift);
        let over = |n: Integer| Self(Repr::from((n, denominator.clone())));
        let high = if exact { root.clone() } else { Integer::from(&root + 1) };
        (over(root), over(high))
    }

    #[cfg(not(feature = "exact"))]
    fn positive_root(&self) -> (Self, Self) {
        use dashu_int::ops::{BitTest, SquareRootRem, UnsignedAbs};
        use dashu_int::{IBig, UBig};
        let product = self.0.numerator().clone().unsigned_abs() * self.0.denominator();
        let bits = u32::try_from(product.bit_len() / 2).unwrap_or(u32::MAX);
        let shift = ROOT_BITS.saturating_sub(bits) as usize;
        let (root, rest) = (product << (2 * shift)).sqrt_rem();
        let denominator = self.0.denominator() << shift;
        let over = |n: UBig| Self(Repr::from_parts(IBig::from(n), denominator.clone()));
        let high = if rest == UBig::ZERO { root.clone() } else { &root + UBig::ONE };
        (over(root), over(high))
    }
}

/// The four operations, by value and by reference.
macro_rules! operation {
    ($name:ident, $method:ident) => {
        impl $name for Rational {
            type Output = Rational;
            fn $method(self, other: Rational) -> Rational {
                Rational(self.0.$method(other.0))
            }
        }
        impl $name for &Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                Rational(Repr::from((&self.0).$method(&other.0)))
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);

impl Neg for Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        Rational(-self.0)
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.to_f64(), f)
    }
}
