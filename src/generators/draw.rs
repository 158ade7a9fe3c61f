//! Sources of draws.

/// A source of numbers; the families are written over it.
pub trait Draw {
    /// The next `bytes` bytes (1 to 8) as a little-endian number.
    fn take(&mut self, bytes: u32) -> u64;

    /// A number below `n` (at least 1). A small draw gives itself; the bias is below n / 2^32 for n up to 2^16 from a seed.
    fn below(&mut self, n: u32) -> u32 {
        let bytes = match n {
            0..=0x40 => 1,
            0x41..=0x4000 => 2,
            _ => 4,
        };
        // The remainder is below n, a u32.
        (self.take(bytes) % u64::from(n.max(1))) as u32
    }

    /// An integer of `low..=high`.
    fn integer(&mut self, low: i32, high: i32) -> i32 {
        low + self.below((high - low + 1).max(1) as u32) as i32
    }

    /// A multiple of 2^-53 in [0, 1), uniform.
    fn unit(&mut self) -> f64 {
        (self.take(8) >> 11) as f64 * two_to(-53)
    }

    /// A multiple of 2^-52 in [-1, 1), uniform.
    fn signed_unit(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// Yes or no.
    fn coin(&mut self) -> bool {
        self.below(2) == 1
    }
}

/// 2^e exactly, for -1022 <= e <= 1023 (0 below that range).
pub(super) fn two_to(e: i32) -> f64 {
    f64::from_bits(((e + 1023).clamp(0, 2046) as u64) << 52)
}

/// The generator SplitMix64 of Steele, Lea and Flood (2014): one 64-bit word of state, full period.
///
/// `oracle/` uses the same generator, so that every program of a benchmark sees the same points.
#[derive(Clone, Debug)]
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    /// The next word.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
}

impl Draw for SplitMix64 {
    /// One word a draw; its low bytes.
    fn take(&mut self, bytes: u32) -> u64 {
        self.word() & (u64::MAX >> (64 - 8 * bytes.clamp(1, 8)))
    }
}

/// Draws from a byte string, zeros when it is used up.
#[derive(Clone, Debug)]
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// Whether all bytes have been drawn.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Draw for Bytes<'_> {
    fn take(&mut self, bytes: u32) -> u64 {
        let n = (bytes.clamp(1, 8) as usize).min(self.0.len());
        let (head, tail) = self.0.split_at(n);
        self.0 = tail;
        head.iter().rev().fold(0, |value, &byte| value << 8 | u64::from(byte))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published first outputs for seed 1234567 pin the generator, which other programs re-implement.
    #[test]
    fn splitmix_matches_the_reference() {
        let mut draw = SplitMix64(1_234_567);
        assert_eq!([draw.word(), draw.word()], [6_457_827_717_110_365_317, 3_203_168_211_198_807_973]);
    }

    #[test]
    fn bytes_are_little_endian_and_end_in_zeros() {
        let mut draw = Bytes(&[1, 2, 3]);
        assert_eq!([draw.take(2), draw.take(4), draw.take(8)], [0x0201, 3, 0]);
        assert!(draw.is_empty());
    }

    #[test]
    fn units_stay_in_range() {
        let mut draw = SplitMix64(0);
        assert!((0..1000).all(|_| (0.0..1.0).contains(&draw.unit()) && (-1.0..1.0).contains(&draw.signed_unit())));
        assert_eq!([two_to(0), two_to(-52), two_to(10)], [1.0, f64::EPSILON, 1024.0]);
    }
}
