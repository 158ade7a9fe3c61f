//! Parameters from angles, exactly: no libm, one defined rounding each.
//!
//! Problem: rho^2 = 1/(4 sin^2 theta) of an angle in degrees must be the same f64 everywhere and never promise more
//! than the angle asked for. Idea: 1/(4 sin^2 theta) = 1/(2 (1 - cos 2 theta)); enclose pi (Machin) and the cosine (Taylor)
//! between integers over 2^p and double p until both ends round down to one f64. By Niven's theorem the value is
//! rational only at 30, 45 and 60 degrees (1, 1/2, 1/3) in the range, and an f64 only at the first two, so this ends.

use super::dyadic::Dyadic;
use super::round;
use crate::model::Sign;
use dashu_int::IBig;

/// An angle that cannot be a bound on the smallest angle of a triangle, or is too small for f64s.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("a minimum angle must be above 0 and below 90 degrees (and rho^2 finite), not {0}")]
pub struct AngleOutOfRange(pub f64);

/// The largest f64 that is at most 1/(4 sin^2 theta), theta = `degrees` degrees: the square of the radius-edge bound rho.
///
/// 30 gives exactly 1. Angles above 60 degrees (which no triangle meets) are computed too; whether to take them is the
/// caller's decision.
///
/// # Errors
/// `AngleOutOfRange` unless 0 < degrees < 90 and the result is finite.
pub fn rho2_from_min_angle(degrees: f64) -> Result<f64, AngleOutOfRange> {
    // Below 1e-150 degrees the result is above 1e301 or infinite.
    if !(1e-150..90.0).contains(&degrees) {
        return Err(AngleOutOfRange(degrees));
    }
    if degrees == 30.0 {
        return Ok(1.0);
    }
    if degrees == 45.0 {
        return Ok(0.5);
    }
    let mut bits = 192;
    loop {
        let (low, high) = versine_of_double(degrees, bits);
        if low > IBig::ZERO {
            // 1/(2 v), v = versine 2^-bits.
            let bound = |versine: IBig| floor_ratio(bits as i64 - 1, versine);
            let (a, b) = (bound(high), bound(low));
            if a == b {
                return Ok(a);
            }
        }
        bits *= 2;
    }
}

/// 0.99 (rho + sqrt(rho^2 - 1/4)), rho = sqrt(rho2), rounded once to nearest: the height of the off-center over the
/// shortest edge, in units of its length.
///
/// 0.99 is the rational 99/100. Source: `docs/gcdr.md`, `offcenter`; the factor 1 is the apex of the triangle over the edge
/// whose ratio is rho, and the 1 % keeps the rounded point on the near side of it.
///
/// # Panics
/// If rho2 is below 1/4 or not finite: no triangle has such a ratio, and parameters are validated before.
pub fn kappa(rho2: f64) -> f64 {
    assert!((0.25..=f64::MAX).contains(&rho2), "rho2 is at least 1/4");
    // The assertion above makes it finite.
    let a = Dyadic::from_f64(rho2).expect("finite");
    let b = &a - &Dyadic::integer(1).scaled(-2);
    let (numerator, hundred) = (Dyadic::integer(99), Dyadic::integer(100));
    let rounded = |sum: &Dyadic| round::ratio(&(&numerator * sum), &hundred);
    // The sum is rational only if both roots are; else it is never a tie and some enclosure rounds to one f64.
    if let (Some(r), Some(s)) = (a.exact_sqrt(), b.exact_sqrt()) {
        return rounded(&(&r + &s));
    }
    let mut bits = 128;
    loop {
        let ((r, r_high), (s, s_high)) = (enclosed_root(&a, bits), enclosed_root(&b, bits));
        let (low, high) = (rounded(&(&r + &s)), rounded(&(&r_high + &s_high)));
        if low == high {
            return low;
        }
        bits *= 2;
    }
}

/// Both ends of an enclosure of the square root; equal if it is exact.
fn enclosed_root(x: &Dyadic, bits: usize) -> (Dyadic, Dyadic) {
    match x.exact_sqrt() {
        Some(root) => (root.clone(), root),
        None => round::enclose_sqrt(x, bits),
    }
}

/// The largest f64 at most 2^exponent/den, den positive.
fn floor_ratio(exponent: i64, den: IBig) -> f64 {
    let (num, den) = (Dyadic::integer(1).scaled(exponent), Dyadic::from_parts(den, 0));
    let nearest = round::ratio(&num, &den);
    match Dyadic::from_f64(nearest) {
        Some(v) if (&(&v * &den) - &num).sign() != Sign::Positive => nearest,
        _ => nearest.next_down(),
    }
}

/// 1 - cos(2 theta) over 2^-bits, enclosed: (at most, at least).
fn versine_of_double(degrees: f64, bits: usize) -> (IBig, IBig) {
    // 2 theta = degrees pi/90, over 2^-fine; the extra bits keep the relative precision of small angles.
    // The caller has checked the range, so that the value is finite.
    let (m, e) = Dyadic::from_f64(degrees).map(|d| (d.parts().0.clone(), d.parts().1)).expect("finite");
    let (pi, pi_error) = pi(bits);
    let scaled = |numerator: IBig| shift_floor(numerator * &m, e) / IBig::from(90);
    let low = scaled(&pi - &pi_error);
    let high = scaled(&pi + &pi_error) + IBig::from(2);
    // 1 - cos is increasing on (0, pi).
    let (v, v_error) = versine(&low, bits);
    let (w, w_error) = versine(&high, bits);
    (v - v_error, w + w_error)
}

/// floor(n 2^e).
fn shift_floor(n: IBig, e: i64) -> IBig {
    if e >= 0 { n << e as usize } else { n >> (-e) as usize }
}

/// pi over 2^-bits and a bound of the error, in units: 16 atan(1/5) - 4 atan(1/239) (Machin).
fn pi(bits: usize) -> (IBig, IBig) {
    let ((a, ea), (b, eb)) = (arctan_inverse(5, bits), arctan_inverse(239, bits));
    (a * IBig::from(16) - b * IBig::from(4), IBig::from(16 * ea + 4 * eb))
}

/// atan(1/n) over 2^-bits and a bound of the error: the alternating series 1/n - 1/(3 n^3) + ...
fn arctan_inverse(n: i64, bits: usize) -> (IBig, i64) {
    let n2 = IBig::from(n * n);
    let mut power = (IBig::ONE << bits) / IBig::from(n);
    let (mut sum, mut k) = (IBig::ZERO, 0i64);
    while power > IBig::ZERO {
        let term = &power / IBig::from(2 * k + 1);
        if k % 2 == 0 {
            sum += term;
        } else {
            sum -= term;
        }
        power /= &n2;
        k += 1;
    }
    // Each term is off by less than 2 (a floored power, at most 1.1 off, and one more floor); the tail is below 1.
    (sum, 2 * k + 1)
}

/// 1 - cos x over 2^-bits for x in (0, pi], and a bound of the error: x^2/2! - x^4/4! + ...
fn versine(x: &IBig, bits: usize) -> (IBig, IBig) {
    let x2 = (x * x) >> bits;
    let mut term = &x2 >> 1usize;
    let (mut sum, mut k) = (IBig::ZERO, 1i64);
    while term > IBig::ZERO {
        if k % 2 == 1 {
            sum += &term;
        } else {
            sum -= &term;
        }
        term = ((&term * &x2) >> bits) / IBig::from((2 * k + 1) * (2 * k + 2));
        k += 1;
    }
    // A term inherits at most 10/12 of the error of the one before, plus t/12 of that of x^2 (t < 5, error < 1), plus 2 of
    // its own floors: below 16 in all. The tail is below 16 as well, the first term left out being below 1.
    (sum, IBig::from(16 * (k + 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of an independent evaluation with 120 decimal digits, rounded down.
    #[test]
    fn bounds_of_angles_are_rounded_down() {
        for (degrees, expected) in [
            (20.7, 0x4000_01d2_111d_a8b3u64),
            (25.0, 0x3ff6_6548_a52e_b4d4),
            (28.6, 0x3ff1_74c4_c8c1_e29b),
            (33.0, 0x3fea_f82f_5f7b_727e),
            (1.0, 0x4089_a647_873c_c127),
            (15.0, 0x400d_db3d_742c_2655),
            (26.565051177077986, 0x3ff4_0000_0000_0001),
            (1e-9, 0x4446_3ec2_e0c9_07d4),
            (1e-100, 0x6a10_c0b9_75a9_661f),
            (29.999999999999996, 0x3ff0_0000_0000_0000),
            (30.000000000000004, 0x3fef_ffff_ffff_fffe),
            (60.0, 0x3fd5_5555_5555_5555),
            (89.99999999, 0x3fd0_0000_0000_0000),
        ] {
            assert_eq!(rho2_from_min_angle(degrees).unwrap().to_bits(), expected, "{degrees}");
        }
        assert_eq!(rho2_from_min_angle(30.0), Ok(1.0));
        assert_eq!(rho2_from_min_angle(45.0), Ok(0.5));
    }

    #[test]
    fn impossible_angles_are_refused() {
        for degrees in [0.0, -0.0, -1.0, 90.0, 1e300, f64::INFINITY, f64::NAN, f64::from_bits(1)] {
            assert!(rho2_from_min_angle(degrees).is_err(), "{degrees}");
        }
    }

    #[test]
    fn kappa_where_both_roots_are_rational() {
        // rho = 5/8: sqrt(25/64 - 16/64) = 3/8.
        assert_eq!(kappa(25.0 / 64.0), 0.99);
        assert_eq!(kappa(0.25), 0.495);
    }

    /// The definition without roots: m < 99/100 (sqrt a + sqrt b) iff s = (100 m/99)^2 - a - b is negative or s^2 < 4 a b.
    #[cfg(feature = "exact")]
    #[test]
    fn kappa_is_the_nearest_f64() {
        use rug::Rational;
        let rational = |x: f64| Rational::from_f64(x).unwrap();
        for rho2 in [1.0, 2.0, 1.3997274830283475, 0.26, 1.25, 820.7849259134717, 1e200, 0.25f64.next_up()] {
            let (a, b) = (rational(rho2), rational(rho2) - rational(0.25));
            let below = |m: Rational| {
                let s: Rational = (m * Rational::from((100, 99))).square() - &a - &b;
                s < 0 || s.square() < Rational::from(&a * &b) * 4u32
            };
            let k = kappa(rho2);
            let middle = |other: f64| (rational(k) + rational(other)) / 2u32;
            assert!(below(middle(k.next_down())) && !below(middle(k.next_up())), "{rho2}");
        }
    }
}
