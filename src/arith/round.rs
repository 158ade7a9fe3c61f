//! Exact values to f64, rounded once to nearest, ties to even.
//!
//! A quotient is taken to at least 55 bits and the remainder kept as a sticky bit, so that one final rounding sees the
//! exact value's position. A root is enclosed between neighbouring integers over growing powers of two until both ends
//! round alike; that ends, since an irrational value is never a tie.

use super::dyadic::{Dyadic, floor_sqrt};
use super::kernel::OutOfRange;
use super::scale;
use crate::model::Sign;
use dashu_int::ops::{BitTest, DivRem};
use dashu_int::{IBig, UBig};

/// Constructed coordinates below this become 0, so that they stay in the window in which predicates are exact.
pub(super) const FLUSH_BELOW: f64 = f64::from_bits((1023 - 142) << 52);
/// Constructed coordinates above this are refused.
pub(super) const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);

/// The range rule of a constructed coordinate: 0 below 2^-142, never -0, `OutOfRange` beyond 2^200.
#[inline]
pub(super) fn coordinate(rounded: f64) -> Result<f64, OutOfRange> {
    if rounded.abs() <= LARGEST { Ok(flushed(rounded)) } else { Err(OutOfRange) }
}

/// 0 below 2^-142, never -0.
#[inline]
pub(super) fn flushed(rounded: f64) -> f64 {
    if rounded.abs() < FLUSH_BELOW { 0.0 } else { rounded }
}

/// num/den to nearest; infinite beyond the largest f64 and where den is 0.
pub(super) fn ratio(num: &Dyadic, den: &Dyadic) -> f64 {
    let ((n, n_exponent), (d, d_exponent)) = (num.parts(), den.parts());
    let negative = num.sign().is_negative() != den.sign().is_negative();
    if num.sign() == Sign::Zero {
        return 0.0;
    }
    if den.sign() == Sign::Zero {
        return if negative { f64::NEG_INFINITY } else { f64::INFINITY };
    }
    let (n, d) = (magnitude(n), magnitude(d));
    let shift = (56 + d.bit_len()).saturating_sub(n.bit_len());
    let (quotient, remainder) = (n << shift).div_rem(d);
    let value = pack(quotient, !remainder.is_zero(), n_exponent - d_exponent - shift as i64);
    if negative { -value } else { value }
}

/// (p + q sqrt(radicand))/den to nearest; the radicand is not negative.
pub(super) fn root(p: &Dyadic, q: &Dyadic, radicand: &Dyadic, den: &Dyadic) -> f64 {
    if let Some(s) = radicand.exact_sqrt() {
        return ratio(&(p + &(q * &s)), den);
    }
    if q.sign() == Sign::Zero {
        return ratio(p, den);
    }
    let mut bits = 128;
    loop {
        let (low, high) = enclose_sqrt(radicand, bits);
        let (a, b) = (ratio(&(p + &(q * &low)), den), ratio(&(p + &(q * &high)), den));
        if a == b {
            return a;
        }
        bits *= 2;
    }
}

/// Two neighbours m 2^e and (m+1) 2^e around the irrational square root of a positive number, m of at least `bits` bits.
pub(super) fn enclose_sqrt(radicand: &Dyadic, bits: usize) -> (Dyadic, Dyadic) {
    let (m, e) = radicand.parts();
    let m = magnitude(m);
    let mut shift = (2 * bits).saturating_sub(m.bit_len()) as i64;
    if (e - shift) % 2 != 0 {
        shift += 1;
    }
    let low = IBig::from(floor_sqrt(&(m << shift as usize)));
    let exponent = (e - shift) / 2;
    (Dyadic::from_parts(low.clone(), exponent), Dyadic::from_parts(low + 1, exponent))
}

fn magnitude(n: &IBig) -> UBig {
    n.clone().into_parts().1
}

/// (quotient + a fraction iff `sticky`) 2^exponent to nearest even; the quotient has at least 56 bits.
fn pack(quotient: UBig, sticky: bool, exponent: i64) -> f64 {
    // Keep 62 bits and one sticky bit below them: more than the 53 + 2 that rounding needs.
    let excess = quotient.bit_len().saturating_sub(62);
    let sticky = sticky || quotient.trailing_zeros().is_some_and(|zeros| zeros < excess);
    // A number of at most 62 bits fits.
    let kept = u64::try_from(quotient >> excess).expect("at most 62 bits");
    let (m, e) = (kept << 1 | u64::from(sticky), exponent + excess as i64 - 1);
    let top = i64::from(64 - m.leading_zeros()) + e;
    let lsb = (top - 53).max(-1074);
    let drop = lsb - e;
    if drop > 64 {
        return 0.0;
    }
    let (m, half) = (u128::from(m), 1u128 << (drop - 1));
    let (mut integer, rest) = (m >> drop, m & ((half << 1) - 1));
    if rest > half || (rest == half && integer % 2 == 1) {
        integer += 1;
    }
    // At most 2^53, so exact as an f64; the product is exact or infinite.
    scale::by_power_of_two(integer as f64, lsb.min(4000) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn d(x: f64) -> Dyadic {
        Dyadic::from_f64(x).unwrap()
    }

    #[test]
    fn quotients_of_f64s_are_what_the_hardware_says() {
        let values = [1.0, 3.0, 0.1, 1e-160, 7e150, f64::MIN_POSITIVE, f64::from_bits(1), f64::MAX, 1.0 + f64::EPSILON];
        for a in values {
            for b in values {
                assert_eq!(ratio(&d(a), &d(b)).to_bits(), (a / b).to_bits(), "{a:e}/{b:e}");
                assert_eq!(ratio(&d(-a), &d(b)).to_bits(), (-a / b).to_bits(), "-{a:e}/{b:e}");
            }
        }
    }

    #[test]
    fn ties_go_to_even_and_neighbours_do_not() {
        let one = Dyadic::integer(1);
        let ulp = Dyadic::integer(1).scaled(-52);
        let crumb = Dyadic::integer(1).scaled(-300);
        for odd in [0, 1] {
            let below = &one + &(&ulp * &Dyadic::integer(odd));
            let tie = &below + &ulp.scaled(-1);
            let (low, high) = (1.0 + odd as f64 * f64::EPSILON, 1.0 + (odd + 1) as f64 * f64::EPSILON);
            assert_eq!(ratio(&tie, &one), if odd == 0 { low } else { high });
            assert_eq!(ratio(&(&tie - &crumb), &one), low);
            assert_eq!(ratio(&(&tie + &crumb), &one), high);
        }
        let least = f64::from_bits(1);
        assert_eq!(ratio(&d(least), &Dyadic::integer(2)), 0.0);
        assert_eq!(ratio(&d(3.0 * least), &Dyadic::integer(2)), 2.0 * least);
        assert_eq!(ratio(&d(1.5 * f64::MIN_POSITIVE), &d(0.5)), 3.0 * f64::MIN_POSITIVE);
    }

    #[test]
    fn roots_are_what_the_hardware_says() {
        let (zero, one) = (Dyadic::integer(0), Dyadic::integer(1));
        for x in [2.0, 3.0, 4.0, 0.1, 1e-300, 1e300, 2.25, f64::MAX, f64::from_bits(7)] {
            assert_eq!(root(&zero, &one, &d(x), &one), x.sqrt(), "{x:e}");
        }
        assert_eq!(root(&one, &Dyadic::integer(-1), &one, &one), 0.0);
    }

    #[test]
    fn the_range_rule() {
        assert_eq!(coordinate(-0.0).unwrap().to_bits(), 0);
        assert_eq!(coordinate(FLUSH_BELOW), Ok(FLUSH_BELOW));
        assert_eq!(coordinate(-FLUSH_BELOW.next_down()).unwrap().to_bits(), 0);
        assert_eq!(coordinate(-LARGEST), Ok(-LARGEST));
        assert_eq!(coordinate(LARGEST.next_up()), Err(OutOfRange));
        assert_eq!(coordinate(f64::INFINITY), Err(OutOfRange));
    }
}
