//! Reads NumPy's `.npy`, versions 1 to 3: one array of shape (n, 3) or more columns, a point a row (NumPy's documentation, `numpy.lib.format`).
//!
//! Layout: `\x93NUMPY`, two bytes of version, the length of the header (2 bytes, from version 2 on 4, little-endian), the header, a Python literal
//! `{'descr': '<f8', 'fortran_order': False, 'shape': (10, 3), }`, then the numbers. Doubles, singles and integers of both byte orders are
//! read, in C and in Fortran order. The places of findings are rows, counted from 1.

use super::{Builder, Column, Input3, others};
use crate::io::rows::{MOST_ELEMENTS, clipped};
use crate::io::scalar::{Scalar, whole};
use crate::io::{Note, NoteKind, ReadError, error::shown};
use crate::model::words::counted;

/// Reads a `.npy` file as points of space.
///
/// Errors: the first fault; too many bytes are one as well as too few.
pub fn parse_npy(bytes: &[u8], column: Option<&Column>) -> Result<Input3, ReadError> {
    let (header, data) = split(bytes)?;
    let array = Array::parse(header)?;
    let [rows, columns] = array.shape;
    let size = array.scalar.size();
    // At most 2^31 rows, and a header cannot declare more columns than there are bytes.
    let due = rows as u128 * columns as u128 * size as u128;
    if due != data.len() as u128 {
        let problem = format!("the shape is ({rows}, {columns}), which takes {due} bytes, but {} follow", data.len());
        return Err(fault(problem, "the file is truncated or damaged"));
    }
    let wanted = column.map(|c| c.find(".npy", columns, &[""; 0], &[0, 1, 2])).transpose()?;
    let mut set = Builder::new(column, rows);
    set.leaves_out(0, &others(columns, &[0, 1, 2], wanted), &[""; 0]);
    let start = bytes.len() - data.len();
    let mut rounded = 0usize;
    for i in 0..rows {
        let at = |k: usize| if array.fortran { k * rows + i } else { i * columns + k };
        let mut number = |k: usize, name: &str| {
            let from = at(k) * size;
            rounded += usize::from(array.scalar.is_rounded(&data[from..from + size], array.big_endian));
            let x = array.scalar.value(&data[from..from + size], array.big_endian);
            if x.is_finite() {
                return Ok(x);
            }
            let problem = format!("{name} is {x:?}, which is not a finite number (byte {})", start + from);
            Err(ReadError { element: format!("row {}", i + 1), ..fault(problem, "remove the row or correct it") })
        };
        let p = [number(0, "x")?, number(1, "y")?, number(2, "z")?];
        let further = wanted.map(|k| number(k, column.map_or("", Column::what))).transpose()?;
        set.push(p, further, clipped(i + 1))
            .map_err(|problem| ReadError { element: format!("row {}", i + 1), ..fault(problem, "") })?;
    }
    if rounded > 0 {
        let text = format!(
            "of {} beyond 2^53 that no double holds, the nearest doubles are taken",
            counted(rounded, "integer")
        );
        set.notes.push(Note { kind: NoteKind::Note, line: 0, text });
    }
    Ok(set.finish())
}

fn fault(problem: impl Into<String>, fix: &str) -> ReadError {
    ReadError { part: ".npy", problem: problem.into(), fix: fix.into(), ..ReadError::default() }
}

/// The header of a file and the bytes after it.
fn split(bytes: &[u8]) -> Result<(&str, &[u8]), ReadError> {
    let rest = bytes.strip_prefix(b"\x93NUMPY").ok_or_else(|| {
        let empty = if bytes.is_empty() { "the file is empty" } else { "the file does not start with \\x93NUMPY" };
        fault(empty, "write it by numpy.save; .npz archives are not read")
    })?;
    let truncated = || fault("the file ends within its header", "the file is truncated");
    let (&[major, _], rest) = rest.split_first_chunk::<2>().ok_or_else(truncated)?;
    let digits = match major {
        1 => 2,
        2 | 3 => 4,
        _ => return Err(fault(format!("the version is {major}"), "versions 1 to 3 are read here")),
    };
    let (length, rest) = rest.split_at_checked(digits).ok_or_else(truncated)?;
    let length = usize::try_from(whole(length, false)).map_err(|_| truncated())?;
    let (header, data) = rest.split_at_checked(length).ok_or_else(truncated)?;
    match std::str::from_utf8(header) {
        Ok(header) => Ok((header, data)),
        Err(_) => Err(fault("the header is no text", "the file is damaged")),
    }
}

/// What a header says.
struct Array {
    scalar: Scalar,
    big_endian: bool,
    fortran: bool,
    shape: [usize; 2],
}

impl Array {
    fn parse(header: &str) -> Result<Array, ReadError> {
        let of = |key: &str| {
            value(header, key).ok_or_else(|| fault(format!("the header has no `{key}`"), "write it by numpy.save"))
        };
        let fortran = match of("fortran_order")? {
            "True" => true,
            "False" => false,
            other => return Err(fault(format!("fortran_order is `{}`", shown(other)), "it is True or False")),
        };
        let (scalar, big_endian) = numbers(of("descr")?)?;
        let shape = of("shape")?;
        let wrong = || {
            fault(
                format!("the shape is {}", shown(shape)),
                "points are rows: save an array of shape (n, 3), or (n, 4) with weights",
            )
        };
        let inner = shape.strip_prefix('(').and_then(|s| s.strip_suffix(')')).ok_or_else(wrong)?;
        let mut sizes = inner.split(',').map(str::trim_ascii);
        let mut size =
            || sizes.next().filter(|s| s.bytes().all(|b| b.is_ascii_digit())).and_then(|s| s.parse::<u64>().ok());
        let (Some(rows), Some(columns)) = (size(), size()) else {
            return Err(wrong());
        };
        if !matches!((sizes.next(), sizes.next()), (None | Some(""), None)) || columns < 3 {
            return Err(wrong());
        }
        if rows > MOST_ELEMENTS || columns > MOST_ELEMENTS {
            return Err(fault(format!("the shape is {}", shown(shape)), &format!("the limit is {MOST_ELEMENTS}")));
        }
        // Both are below 2^31 now.
        Ok(Array { scalar, big_endian, fortran, shape: [rows as usize, columns as usize] })
    }
}

/// The value of a key of a Python dictionary literal without nested dictionaries: up to the next comma outside parentheses and brackets.
fn value<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let key_at = ['\'', '"'].into_iter().find_map(|quote| header.find(&format!("{quote}{key}{quote}")))?;
    let rest = header[key_at + key.len() + 2..].trim_ascii_start().strip_prefix(':')?;
    let mut depth = 0i64;
    let end = rest.bytes().position(|b| {
        depth += i64::from(matches!(b, b'(' | b'['));
        depth -= i64::from(matches!(b, b')' | b']'));
        depth <= 0 && matches!(b, b',' | b'}')
    })?;
    Some(rest[..end].trim_ascii())
}

/// The number type and byte order that a `descr` names.
fn numbers(descr: &str) -> Result<(Scalar, bool), ReadError> {
    let name = descr.trim_matches(['\'', '"']);
    let (order, kind) = name.split_at_checked(1).unwrap_or(("", ""));
    let scalar = match kind {
        "f8" => Scalar::F64,
        "f4" => Scalar::F32,
        "i1" => Scalar::I8,
        "u1" => Scalar::U8,
        "i2" => Scalar::I16,
        "u2" => Scalar::U16,
        "i4" => Scalar::I32,
        "u4" => Scalar::U32,
        "i8" => Scalar::I64,
        "u8" => Scalar::U64,
        _ => {
            let fix = "save doubles (float64), singles (float32) or integers";
            return Err(fault(format!("the numbers are of type {}", shown(descr)), fix));
        }
    };
    match order {
        "<" | "=" => Ok((scalar, false)),
        ">" => Ok((scalar, true)),
        "|" if scalar.size() == 1 => Ok((scalar, false)),
        _ => Err(fault(format!("the byte order of {} is unknown", shown(descr)), "it starts with < or >")),
    }
}
