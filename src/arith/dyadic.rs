//! Exact dyadic numbers m 2^e: the sums, differences and products of f64s, without rounding and without gcds.
//!
//! The last resort of the fast kernel, and the arithmetic of exact decisions on parameters.

use super::poly::Ring;
use crate::model::Sign;
use dashu_int::{IBig, UBig};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// An exact number m 2^e. Equal values may have different (m, e); comparisons see the value.
#[derive(Clone, Debug)]
pub struct Dyadic {
    mantissa: IBig,
    exponent: i64,
}

impl Dyadic {
    /// The value of a finite f64; `None` for NaN and the infinities.
    pub fn from_f64(x: f64) -> Option<Dyadic> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let field = ((bits >> 52) & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let (m, e) = if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
        if m == 0 {
            return Some(Dyadic::integer(0));
        }
        let zeros = m.trailing_zeros();
        let m = (m >> zeros) as i64;
        Some(Dyadic { mantissa: IBig::from(if x < 0.0 { -m } else { m }), exponent: e + i64::from(zeros) })
    }

    /// A small integer.
    pub fn integer(n: i64) -> Dyadic {
        Dyadic { mantissa: IBig::from(n), exponent: 0 }
    }

    /// The sign of the value.
    pub fn sign(&self) -> Sign {
        match self.mantissa.cmp(&IBig::ZERO) {
            Ordering::Less => Sign::Negative,
            Ordering::Equal => Sign::Zero,
            Ordering::Greater => Sign::Positive,
        }
    }

    /// The value times 2^k.
    #[must_use]
    pub fn scaled(&self, k: i64) -> Dyadic {
        Dyadic { mantissa: self.mantissa.clone(), exponent: self.exponent + k }
    }

    /// The value is m 2^e with the m and e returned.
    pub(super) fn parts(&self) -> (&IBig, i64) {
        (&self.mantissa, self.exponent)
    }

    /// m 2^e.
    pub(super) fn from_parts(mantissa: IBig, exponent: i64) -> Dyadic {
        Dyadic { mantissa, exponent }
    }

    /// The exact square root, if there is one among the dyadic numbers (that is, among the rationals); `None` if negative.
    pub(super) fn exact_sqrt(&self) -> Option<Dyadic> {
        let (m, e) = (&self.mantissa, self.exponent);
        let Some(zeros) = m.trailing_zeros() else {
            return Some(Dyadic::integer(0));
        };
        let odd = UBig::try_from(m >> zeros).ok()?;
        let e = e + zeros as i64;
        if e % 2 != 0 {
            return None;
        }
        let root = floor_sqrt(&odd);
        (&root * &root == odd).then(|| Dyadic { mantissa: IBig::from(root), exponent: e / 2 })
    }
}

/// Floor of the square root.
pub(super) fn floor_sqrt(n: &UBig) -> UBig {
    use dashu_int::ops::SquareRoot;
    n.sqrt()
}

/// Both mantissas brought to the smaller exponent, then combined.
fn aligned(a: &Dyadic, b: &Dyadic, combine: impl FnOnce(&IBig, &IBig) -> IBig) -> Dyadic {
    match a.exponent.cmp(&b.exponent) {
        Ordering::Equal => Dyadic { mantissa: combine(&a.mantissa, &b.mantissa), exponent: a.exponent },
        Ordering::Greater => {
            let shifted = &a.mantissa << (a.exponent - b.exponent) as usize;
            Dyadic { mantissa: combine(&shifted, &b.mantissa), exponent: b.exponent }
        }
        Ordering::Less => {
            let shifted = &b.mantissa << (b.exponent - a.exponent) as usize;
            Dyadic { mantissa: combine(&a.mantissa, &shifted), exponent: a.exponent }
        }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: &Dyadic) -> Dyadic {
        aligned(self, other, |a, b| a + b)
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: &Dyadic) -> Dyadic {
        aligned(self, other, |a, b| a - b)
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic { mantissa: -&self.mantissa, exponent: self.exponent }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Dyadic) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Dyadic) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Dyadic) -> Ordering {
        match (self - other).sign() {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
    }
}

impl Ring for Dyadic {
    fn of(x: f64) -> Dyadic {
        // The kernel's arguments are finite by contract.
        Dyadic::from_f64(x).expect("finite by the kernel's contract")
    }
    fn difference(a: f64, b: f64) -> Dyadic {
        &Dyadic::of(a) - &Dyadic::of(b)
    }
    fn plus(&self, other: &Dyadic) -> Dyadic {
        self + other
    }
    fn minus(&self, other: &Dyadic) -> Dyadic {
        self - other
    }
    fn times(&self, other: &Dyadic) -> Dyadic {
        self * other
    }
    fn doubled(&self) -> Dyadic {
        self.scaled(1)
    }
    fn two_largest(mut v: [Dyadic; 3]) -> (Dyadic, Dyadic) {
        v.sort();
        let [_, middle, largest] = v;
        (middle, largest)
    }
    fn smaller(a: Dyadic, b: Dyadic) -> Dyadic {
        a.min(b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn d(x: f64) -> Dyadic {
        Dyadic::from_f64(x).unwrap()
    }

    #[test]
    fn ring_laws_on_extremes() {
        let tiny = f64::from_bits(1);
        let sum = &d(1e300) + &d(tiny);
        assert_eq!(&sum - &d(1e300), d(tiny));
        assert_eq!(&d(tiny) * &d(tiny), Dyadic::integer(1).scaled(-2148));
        assert!(sum > d(1e300));
        assert_eq!(-&d(0.75), d(-0.75));
        assert_eq!(d(-0.0), d(0.0));
        assert!(Dyadic::from_f64(f64::NAN).is_none() && Dyadic::from_f64(f64::INFINITY).is_none());
    }

    #[test]
    fn square_roots_only_of_squares() {
        assert_eq!(d(2.25).exact_sqrt(), Some(d(1.5)));
        assert_eq!(d(0.0).exact_sqrt(), Some(d(0.0)));
        assert_eq!(d(2.0).exact_sqrt(), None);
        assert_eq!(d(-4.0).exact_sqrt(), None);
        assert_eq!(d(3.0).exact_sqrt(), None);
    }
}
