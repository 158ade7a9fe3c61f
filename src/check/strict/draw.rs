//! The checker's own Philox4x32-10. Source: Salmon, Moraes, Dror, Shaw (SC 2011); numbers of a step by `docs/trace-format.md`, Draws.

use crate::check::scale::power_of_two;

/// The four words of draw n of a stream in a step.
pub fn words(seed: u64, step: u32, n: u32, stream: u32) -> [u32; 4] {
    let [mut a, mut b, mut c, mut d] = [step, n, stream, 0];
    let (mut low, mut high) = (seed as u32, (seed >> 32) as u32);
    for _ in 0..10 {
        let first = u64::from(a) * 0xD251_1F53;
        let second = u64::from(c) * 0xCD9E_8D57;
        [a, b, c, d] = [(second >> 32) as u32 ^ b ^ low, second as u32, (first >> 32) as u32 ^ d ^ high, first as u32];
        low = low.wrapping_add(0x9E37_79B9);
        high = high.wrapping_add(0xBB67_AE85);
    }
    [a, b, c, d]
}

/// m of 53 bits, as m - 2^52.
fn integer(high: u32, low: u32) -> i64 {
    ((u64::from(high) << 21 | u64::from(low) >> 11) as i64) - (1 << 52)
}

fn unit(m: i64) -> f64 {
    // |m| <= 2^52 is exact as a f64, and so is the product.
    m as f64 * power_of_two(-52)
}

/// x of [-1, 1].
pub fn interval(seed: u64, step: u32) -> f64 {
    let [w0, w1, ..] = words(seed, step, 0, 1);
    unit(integer(w0, w1))
}

/// The first draw of the unit disk.
pub fn disk(seed: u64, step: u32) -> [f64; 2] {
    let mut n = 0;
    loop {
        let [w0, w1, w2, w3] = words(seed, step, n, 0);
        let (x, y) = (integer(w0, w1), integer(w2, w3));
        let square = |m: i64| i128::from(m) * i128::from(m);
        // Each draw is rejected with probability 1 - pi/4: this ends.
        if square(x) + square(y) <= 1 << 104 {
            return [unit(x), unit(y)];
        }
        n += 1;
    }
}

#[cfg(test)]
mod tests {
    /// Known answers of the reference implementation.
    #[test]
    fn known_answers() {
        assert_eq!(super::words(0, 0, 0, 0), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
    }
}
