//! Numbers of binary files.

/// A number type of a binary format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Scalar {
    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::I64 | Scalar::U64 | Scalar::F64 => 8,
        }
    }

    /// Whether the number in exactly `size` bytes is an integer that is no double.
    pub(super) fn is_rounded(self, bytes: &[u8], big_endian: bool) -> bool {
        let bits = whole(bytes, big_endian);
        match self {
            // Beyond 64 bits the casts back saturate, and no such number is equal to a rounded one but the largest, which is told apart.
            Scalar::I64 => bits as i64 == i64::MAX || (bits as i64 as f64) as i64 != bits as i64,
            Scalar::U64 => bits == u64::MAX || (bits as f64) as u64 != bits,
            _ => false,
        }
    }

    /// The number in exactly `size` bytes as a double: integers beyond 2^53 are rounded to nearest as decimals are. Minus zero becomes zero;
    /// the result may be infinite or no number.
    pub(super) fn value(self, bytes: &[u8], big_endian: bool) -> f64 {
        let bits = whole(bytes, big_endian);
        let x = match self {
            // The casts keep the bits that a value of this size has.
            Scalar::F64 => f64::from_bits(bits),
            Scalar::F32 => f64::from(f32::from_bits(bits as u32)),
            Scalar::I8 => f64::from(bits as i8),
            Scalar::I16 => f64::from(bits as i16),
            Scalar::I32 => f64::from(bits as i32),
            Scalar::I64 => bits as i64 as f64,
            Scalar::U8 | Scalar::U16 | Scalar::U32 | Scalar::U64 => bits as f64,
        };
        x + 0.0
    }
}

/// An unsigned integer of up to 8 bytes.
pub(super) fn whole(bytes: &[u8], big_endian: bool) -> u64 {
    // The sizes that matter, so that they are one instruction each.
    if let Ok(eight) = <[u8; 8]>::try_from(bytes) {
        return if big_endian { u64::from_be_bytes(eight) } else { u64::from_le_bytes(eight) };
    }
    if let Ok(four) = <[u8; 4]>::try_from(bytes) {
        return u64::from(if big_endian { u32::from_be_bytes(four) } else { u32::from_le_bytes(four) });
    }
    let push = |n: u64, &b: &u8| n << 8 | u64::from(b);
    if big_endian { bytes.iter().fold(0, push) } else { bytes.iter().rev().fold(0, push) }
}

/// A float as an index below a bound.
pub(super) fn index(x: f64, bound: usize) -> Option<usize> {
    // The cast saturates; a fraction or a negative number does not survive it.
    let i = x as usize;
    ((i as f64).to_bits() == x.to_bits() && i < bound).then_some(i)
}
