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
    // Writing to a vector cannot fail.
    write!(out, "{x:?}").expect("a vector takes every byte");
    if out[start..].ends_with(b".0") {
        out.truncate(out.len() - 2);
    }
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
}
