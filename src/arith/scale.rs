//! Scaling by powers of two, exact.
//!
//! Rounding to nearest commutes with a power of two, so a domain scaled to `[1/2, 1)` gives the scaled run of the
//! unscaled one. The factor itself need not be an f64 (2^1024 is not), hence the exponent as argument.

/// The e with `max_abs / 2^e` in `[1/2, 1)`; 0 for 0.
///
/// `max_abs` is finite and not negative; subnormal numbers are allowed.
pub fn exponent_of(max_abs: f64) -> i32 {
    if max_abs == 0.0 {
        return 0;
    }
    let biased = exponent_field(max_abs);
    if biased == 0 {
        // Subnormal: 2^64 times it is normal.
        return exponent_field(max_abs * TWO_64) - 1022 - 64;
    }
    biased - 1022
}

/// x 2^e, exact when the result is an f64 (which the caller guarantees; otherwise it is rounded or infinite).
pub fn by_power_of_two(x: f64, e: i32) -> f64 {
    // Magnitudes change monotonically towards the result, so every intermediate product is exact when the result is.
    let (mut x, mut e) = (x, e.clamp(-4000, 4000));
    while e > 1000 {
        x *= power_of_two(1000);
        e -= 1000;
    }
    while e < -1000 {
        x *= power_of_two(-1000);
        e += 1000;
    }
    x * power_of_two(e)
}

/// 2^e as an f64, for e in -1022..=1023.
pub(crate) fn power_of_two(e: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&e));
    f64::from_bits(((e + 1023) as u64) << 52)
}

const TWO_64: f64 = 18_446_744_073_709_551_616.0;

fn exponent_field(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_bracket_their_number() {
        for (x, e) in [(1.0, 1), (0.5, 0), (0.75, 0), (3.0, 2), (f64::MAX, 1024), (f64::MIN_POSITIVE, -1021)] {
            assert_eq!(exponent_of(x), e, "{x:e}");
        }
        assert_eq!(exponent_of(f64::from_bits(1)), -1073);
        assert_eq!(exponent_of(0.0), 0);
    }

    #[test]
    fn scaling_there_and_back_is_the_identity() {
        for bits in [1u64, 3, 0xf_ffff_ffff_ffff, 1 << 52, 0x7fef_ffff_ffff_ffff, 0x3ff8_0000_0000_0001] {
            let x = f64::from_bits(bits);
            let e = exponent_of(x);
            let y = by_power_of_two(x, -e);
            assert!((0.5..1.0).contains(&y), "{x:e} {y}");
            assert_eq!(by_power_of_two(y, e).to_bits(), bits);
            assert_eq!(by_power_of_two(-y, e).to_bits(), (-x).to_bits());
        }
    }
}
