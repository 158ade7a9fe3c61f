//! Blocks of binary numbers in VTK's XML files ("VTK file formats", section XML): raw or in base64, plain or compressed by zlib.
//!
//! A plain block is its length in bytes, then the bytes. A compressed one is a head of numbers — of chunks, of bytes in a chunk, of bytes in the last
//! chunk (0: it is full), of bytes that each chunk takes compressed — and the chunks. In base64 the head of a compressed block is encoded by itself.

use super::ReadError;
use super::error::shown;
use super::scalar::whole;
use super::xml::Tag;
use flate2::{Decompress, FlushDecompress, Status};
use std::borrow::Cow;

/// Deflate makes at most so many bytes of one (its longest match, 258 bytes, takes two bits).
const MOST_OF_A_BYTE: usize = 1032;

/// How the blocks of a file are written.
pub(super) struct Blocks {
    pub(super) big_endian: bool,
    /// Bytes of a number of a head.
    width: usize,
    compressed: bool,
}

impl Blocks {
    /// What the tag `VTKFile` says of them.
    ///
    /// Errors: a compressor other than zlib.
    pub(super) fn of(root: &Tag) -> Result<Blocks, ReadError> {
        let compressed = match root.get("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let problem = format!("the arrays are compressed by {}", shown(other));
                return Err(root.fault(problem, "save the file uncompressed or compressed by zlib"));
            }
        };
        Ok(Blocks {
            big_endian: root.get("byte_order") == Some("BigEndian"),
            width: if root.get("header_type") == Some("UInt64") { 8 } else { 4 },
            compressed,
        })
    }

    /// The most bytes that so many bytes of a file can hold.
    pub(super) fn most(&self, bytes: usize) -> usize {
        if self.compressed { bytes.saturating_mul(MOST_OF_A_BYTE) } else { bytes }
    }

    /// The bytes of the block at the start of `data`.
    pub(super) fn raw<'a>(&self, tag: &Tag, data: &'a [u8]) -> Result<Cow<'a, [u8]>, ReadError> {
        let truncated = || tag.fault("its data ends early", "the file is truncated");
        if !self.compressed {
            let (head, data) = data.split_at_checked(self.width).ok_or_else(truncated)?;
            return data.get(..self.number(head)).map(Cow::Borrowed).ok_or_else(truncated);
        }
        let head = self.head(data).ok_or_else(truncated)?;
        let (head, data) = data.split_at_checked(head).ok_or_else(truncated)?;
        self.inflated(tag, head, data).map(Cow::Owned)
    }

    /// The bytes of the block at the start of base64 text; white space may stand before it.
    pub(super) fn in_base64(&self, tag: &Tag, text: &[u8]) -> Result<Vec<u8>, ReadError> {
        let text = text.trim_ascii_start();
        let bad = || tag.fault("its base64 data is damaged or ends early", "the file is truncated");
        let first = base64(text, self.width).ok_or_else(bad)?;
        if !self.compressed {
            let length = self.number(&first).saturating_add(self.width);
            return Ok(base64(text, length).ok_or_else(bad)?.split_off(self.width));
        }
        let head = self.head(&first).and_then(|n| base64(text, n)).ok_or_else(bad)?;
        // Three bytes make four characters, the last of them filled up.
        let chunks = text.get(head.len().div_ceil(3) * 4..).ok_or_else(bad)?;
        let sizes = head.chunks_exact(self.width).skip(3);
        let length = sizes.fold(0usize, |sum, size| sum.saturating_add(self.number(size)));
        self.inflated(tag, &head, &base64(chunks, length).ok_or_else(bad)?)
    }

    /// A number of a head; what no memory can hold becomes the largest.
    fn number(&self, bytes: &[u8]) -> usize {
        usize::try_from(whole(bytes, self.big_endian)).unwrap_or(usize::MAX)
    }

    /// Bytes of the head of a compressed block, from its first number.
    fn head(&self, data: &[u8]) -> Option<usize> {
        match self.number(data.get(..self.width)?) {
            // VTK writes no more for an empty array.
            0 => Some(self.width),
            chunks => chunks.checked_add(3)?.checked_mul(self.width),
        }
    }

    fn inflated(&self, tag: &Tag, head: &[u8], mut data: &[u8]) -> Result<Vec<u8>, ReadError> {
        let bad = || tag.fault("its compressed data is damaged", "save the file again, or uncompressed");
        let numbers: Vec<usize> = head.chunks_exact(self.width).map(|n| self.number(n)).collect();
        let [_, full, last, sizes @ ..] = &numbers[..] else {
            return Ok(Vec::new());
        };
        let mut out = Vec::new();
        for (k, &size) in sizes.iter().enumerate() {
            let due = if k + 1 == sizes.len() && *last > 0 { *last } else { *full };
            let (chunk, rest) = data.split_at_checked(size).ok_or_else(bad)?;
            if due > self.most(size) {
                return Err(bad());
            }
            let mut bytes = Vec::with_capacity(due);
            let end = Decompress::new(true).decompress_vec(chunk, &mut bytes, FlushDecompress::Finish);
            if !matches!(end, Ok(Status::StreamEnd)) || bytes.len() != due {
                return Err(bad());
            }
            out.append(&mut bytes);
            data = rest;
        }
        Ok(out)
    }
}

/// The first bytes of base64 text; nothing if it holds fewer.
fn base64(text: &[u8], bytes: usize) -> Option<Vec<u8>> {
    // Four characters hold three bytes, so that a longer block cannot be here.
    if bytes > text.len() {
        return None;
    }
    let mut out = Vec::with_capacity(bytes);
    let (mut bits, mut filled) = (0u32, 0);
    for &c in text {
        if out.len() == bytes {
            break;
        }
        let six = match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        bits = bits << 6 | u32::from(six);
        filled += 6;
        if filled >= 8 {
            filled -= 8;
            // The lowest byte above the bits that are left.
            out.push((bits >> filled) as u8);
        }
    }
    (out.len() == bytes).then_some(out)
}
