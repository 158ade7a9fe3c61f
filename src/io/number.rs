//! Numbers of text formats: decimal floats by the standard library's correctly rounding parser, and integers.

use super::error::shown;

/// Parses a finite decimal number. Minus zero becomes zero, so that equal coordinates have equal bits.
///
/// Errors: the problem as a phrase, for text that is not a decimal number and for `nan`, `inf` and what lies beyond the range of f64.
pub(super) fn finite(text: &str) -> Result<f64, String> {
    let decimal = text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E'));
    match text.parse::<f64>() {
        // Adding zero turns -0 into +0 and leaves every other number alone.
        Ok(x) if decimal && x.is_finite() => Ok(x + 0.0),
        Ok(_) => Err(format!("`{}` is not a finite number", shown(text))),
        Err(_) => Err(format!("`{}` is not a number", shown(text))),
    }
}

/// Parses an integer in the range of i64.
pub(super) fn integer(text: &str) -> Result<i64, String> {
    text.parse::<i64>().map_err(|_| format!("`{}` is not a whole number", shown(text)))
}

/// Writes the shortest decimal that reads back as the same number, without a trailing `.0`.
pub(super) fn push_float(out: &mut Vec<u8>, x: f64) {
    use std::io::Write;
    let start = out.len();
    if (1e-4..1e16).contains(&x.abs()) {
        // The notation of `{:?}` and as many digits, three times as fast. Writing a finite number to a vector cannot fail.
        serde_json::to_writer(&mut *out, &x).expect("a vector takes every byte");
    } else {
        // Writing to a vector cannot fail.
        write!(out, "{x:?}").expect("a vector takes every byte");
    }
    if out[start..].ends_with(b".0") {
        out.truncate(out.len() - 2);
    }
}

/// A number for a message, in that notation.
pub(super) fn decimal(x: f64) -> String {
    let mut out = Vec::new();
    push_float(&mut out, x);
    String::from_utf8_lossy(&out).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        assert_eq!(finite("-.5E+00"), Ok(-0.5));
        assert_eq!(finite("-0").map(f64::to_bits), Ok(0));
        assert_eq!(finite("1e-300"), Ok(1e-300));
        for bad in ["1e400", "-1e400", "nan", "NaN", "inf", "-infinity"] {
            assert_eq!(finite(bad), Err(format!("`{bad}` is not a finite number")));
        }
        for bad in ["", "x", "1.0D+00", "1,5", "0x10", "--1", "1e"] {
            assert_eq!(finite(bad), Err(format!("`{bad}` is not a number")));
        }
        assert!(integer("3.0").is_err() && integer("99999999999999999999").is_err());
    }

    #[test]
    fn floats_survive_text() {
        for x in [0.1, 1.0, 1e300, 1e-300, 5e-324, -123456789.125, f64::MAX, 0.0] {
            let mut out = Vec::new();
            push_float(&mut out, x);
            assert_eq!(finite(std::str::from_utf8(&out).unwrap()).unwrap().to_bits(), x.to_bits());
            assert!(out.len() < 26);
        }
    }

    /// Both ways to write a number give the same number in the same notation and length; of two nearest decimals they may choose differently.
    #[test]
    fn one_notation() {
        let mut bits = 1u64;
        let mut near = vec![1e-4, 1e16, 0.1, 123456789.0, 9007199254740993.0, 1e15];
        for _ in 0..20_000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            near.push(f64::from_bits(bits));
            // Exponents from 2^-15 to 2^56, where the notation changes.
            near.push(f64::from_bits((bits >> 12) | ((1008 + bits % 72) << 52)));
        }
        for x in near.into_iter().filter(|x| x.is_finite()).flat_map(|x| [x, -x, x.next_up(), x.next_down()]) {
            let mut out = Vec::new();
            push_float(&mut out, x);
            let (text, other) = (String::from_utf8(out).unwrap(), format!("{x:?}"));
            let other = other.strip_suffix(".0").unwrap_or(&other);
            assert_eq!((text.len(), text.find(['.', 'e'])), (other.len(), other.find(['.', 'e'])), "{text} {other}");
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), x.to_bits());
        }
    }
}
