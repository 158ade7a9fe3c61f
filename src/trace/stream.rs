//! Traces as streams: `Writer` and `Reader` of both forms, neither of which holds a trace in memory.

use super::grammar::{State, is_digest};
use super::record::{Record, Sink};
use super::{binary, text};
use std::io::{self, BufRead, Read, Write};
use thiserror::Error;

/// Bytes hashed and written at a time: large enough for blake3 to run at full width, small enough for a cache.
const CHUNK: usize = 1 << 16;

/// The two forms of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// JSON lines.
    Text,
    /// Compact.
    Binary,
}

/// The binary form of the records so far, hashed in large chunks.
#[derive(Default)]
pub(super) struct Ledger {
    pub(super) state: State,
    /// Bytes not hashed yet.
    pub(super) pending: Vec<u8>,
    hasher: blake3::Hasher,
}

impl Ledger {
    /// Appends the binary form of a record, of an end all but the digest of the trace, and says where in `pending` it starts.
    pub(super) fn enter(&mut self, record: &Record) -> Result<usize, &'static str> {
        self.state.check(record)?;
        let start = self.pending.len();
        binary::encode(record, &self.state, &mut self.pending);
        self.state.advance(record);
        Ok(start)
    }

    /// Hashes and forgets what is pending.
    pub(super) fn settle(&mut self) {
        self.hasher.update(&self.pending);
        self.pending.clear();
    }

    /// blake3 of all bytes entered, in hexadecimal.
    pub(super) fn digest(&self) -> String {
        self.hasher.clone().update(&self.pending).finalize().to_hex().to_string()
    }
}

/// Writes a trace in either form. The digest of the trace is computed on the way and put into the end record; the one given there is
/// ignored. Buffers on its own.
///
/// Errors: those of `W`; `InvalidInput` for a record out of order, naming an unknown id, or with a number that is not finite.
pub struct Writer<W: Write> {
    out: W,
    format: Format,
    ledger: Ledger,
    line: String,
    digest: Option<String>,
}

impl<W: Write> Writer<W> {
    /// A writer at the head of a trace.
    pub fn new(out: W, format: Format) -> Self {
        Writer { out, format, ledger: Ledger::default(), line: String::new(), digest: None }
    }

    /// The digest of the trace, in hexadecimal, once the end was written.
    pub fn digest(&self) -> Option<&str> {
        self.digest.as_deref()
    }

    /// Flushes and gives back what was written to. Errors: `UnexpectedEof` if the end was not written.
    pub fn finish(mut self) -> io::Result<W> {
        if self.digest.is_none() {
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, "the trace has no end"));
        }
        self.out.flush()?;
        Ok(self.out)
    }

    fn pass_on(&mut self) -> io::Result<()> {
        match self.format {
            Format::Binary => self.out.write_all(&self.ledger.pending)?,
            Format::Text => {
                self.out.write_all(self.line.as_bytes())?;
                self.line.clear();
            }
        }
        self.ledger.settle();
        Ok(())
    }
}

impl<W: Write> Sink for Writer<W> {
    fn record(&mut self, record: &Record) -> io::Result<()> {
        let refuse = |why| io::Error::new(io::ErrorKind::InvalidInput, why);
        if record.trace_digest().is_some() {
            self.ledger.state.check(record).map_err(refuse)?;
            let before = self.ledger.state.clone();
            self.ledger.enter(record).map_err(refuse)?;
            let digest = self.ledger.digest();
            if self.format == Format::Text {
                text::encode(&record.clone().with_trace_digest(&digest), &before, &mut self.line);
            }
            binary::put_digest(&mut self.ledger.pending, &digest);
            self.digest = Some(digest);
            return self.pass_on();
        }
        if self.format == Format::Text {
            self.ledger.state.check(record).map_err(refuse)?;
            text::encode(record, &self.ledger.state, &mut self.line);
        }
        self.ledger.enter(record).map_err(refuse)?;
        if self.ledger.pending.len() >= CHUNK { self.pass_on() } else { Ok(()) }
    }
}

/// Where in a trace something is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the binary form, bytes from the start of the file.
    Byte(u64),
    /// In the text form, lines from 1.
    Line(u64),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Place::Byte(n) => write!(f, "byte {n}"),
            Place::Line(n) => write!(f, "line {n}"),
        }
    }
}

/// Why a trace could not be read on.
#[derive(Debug, Error)]
pub enum DecodeError {
    /// The file could not be read.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// The trace ends before its end record does.
    #[error("{0}: the trace is truncated")]
    Truncated(Place),
    /// What stands there is no record, or not one that may stand there.
    #[error("{0}: {1}")]
    Malformed(Place, String),
    /// A record that could be understood but is not spelled as the format demands.
    #[error("{0}: not in canonical form")]
    NotCanonical(Place),
}

/// Reads a trace of either form, recognized by its first byte, record by record.
///
/// Accepts exactly the bytes that `Writer` produces, except that the digest in the end record is not compared: see `Reader::digest`.
/// Memory: the larger of a buffer and the largest record, at most twice the file's size. After an error or the end record: `None`.
pub struct Reader<R: BufRead> {
    input: R,
    format: Option<Format>,
    ledger: Ledger,
    buffer: Vec<u8>,
    at: usize,
    /// Bytes of the file before `buffer`, or lines read.
    passed: u64,
    line: String,
    finished: bool,
}

impl<R: BufRead> Reader<R> {
    /// A reader at the head of a trace. Nothing is read yet.
    pub fn new(input: R) -> Self {
        Reader {
            input,
            format: None,
            ledger: Ledger::default(),
            buffer: Vec::new(),
            at: 0,
            passed: 0,
            line: String::new(),
            finished: false,
        }
    }

    /// The form of the trace; `None` before the first record.
    pub fn format(&self) -> Option<Format> {
        self.format
    }

    /// blake3 of the binary form of what was read so far, in hexadecimal. After the end record: of all that precedes the digest in it,
    /// so that a sound trace has `end.trace == reader.digest()`.
    pub fn digest(&self) -> String {
        self.ledger.digest()
    }

    /// How many events were read.
    pub fn events(&self) -> u64 {
        self.ledger.state.events
    }

    /// The part of the trace that the next record belongs to: `header`, `input` or `start`; `end` after the last one; else `None`: the next is an
    /// event, of number `events`, or the end.
    pub fn part(&self) -> Option<&'static str> {
        self.ledger.state.part()
    }

    /// Where the next record starts.
    pub fn place(&self) -> Place {
        match self.format {
            Some(Format::Text) => Place::Line(self.passed + 1),
            _ => Place::Byte(self.passed + self.at as u64),
        }
    }

    fn advance(&mut self) -> Result<Record, DecodeError> {
        let format = match self.format {
            Some(format) => format,
            None => {
                let first = self.input.fill_buf()?.first().copied();
                *self.format.insert(if first == Some(binary::MAGIC[0]) { Format::Binary } else { Format::Text })
            }
        };
        if self.ledger.pending.len() >= CHUNK {
            self.ledger.settle();
        }
        let place = self.place();
        let record = match format {
            Format::Binary => self.advance_binary(place)?,
            Format::Text => self.advance_text(place)?,
        };
        if self.ledger.state.ended() {
            let more = self.at < self.buffer.len() || !self.input.fill_buf()?.is_empty();
            if more {
                return Err(DecodeError::Malformed(self.place(), "more follows the end record".into()));
            }
        }
        Ok(record)
    }

    fn advance_binary(&mut self, place: Place) -> Result<Record, DecodeError> {
        let (record, length) = loop {
            match binary::decode(&self.buffer[self.at..], &self.ledger.state) {
                Ok(decoded) => break decoded,
                Err(binary::Fault::Short) => {
                    if !self.refill()? {
                        return Err(DecodeError::Truncated(Place::Byte(self.passed + self.buffer.len() as u64)));
                    }
                }
                Err(binary::Fault::Bad(inside, why)) => {
                    let at = self.passed + (self.at + inside) as u64;
                    return Err(DecodeError::Malformed(Place::Byte(at), why));
                }
            }
        };
        let mut bytes = &self.buffer[self.at..self.at + length];
        let start = self.ledger.enter(&record).map_err(|why| DecodeError::Malformed(place, why.into()))?;
        if record.trace_digest().is_some() {
            // The 32 bytes of the digest of the trace, which `enter` leaves out; decoding to hexadecimal and back loses nothing.
            bytes = &bytes[..length - 32];
        }
        if self.ledger.pending[start..] != *bytes {
            return Err(DecodeError::NotCanonical(place));
        }
        self.at += length;
        Ok(record)
    }

    /// Reads at least as much again as is at hand, so that a record of any length is decoded in linear time. False at the file's end.
    fn refill(&mut self) -> io::Result<bool> {
        self.passed += self.at as u64;
        self.buffer.drain(..self.at);
        self.at = 0;
        let amount = CHUNK.max(self.buffer.len()) as u64;
        let read = Read::take(&mut self.input, amount).read_to_end(&mut self.buffer)?;
        Ok(read > 0)
    }

    fn advance_text(&mut self, place: Place) -> Result<Record, DecodeError> {
        let malformed = |why: String| DecodeError::Malformed(place, why);
        self.buffer.clear();
        self.input.read_until(b'\n', &mut self.buffer)?;
        let Some((b'\n', line)) = self.buffer.split_last() else {
            return Err(DecodeError::Truncated(place));
        };
        let record = text::decode(line, &self.ledger.state).map_err(malformed)?;
        self.ledger.state.check(&record).map_err(|why| malformed(why.into()))?;
        if record.trace_digest().is_some_and(|digest| !is_digest(digest)) {
            return Err(malformed("the digest of the trace is not 64 lowercase hexadecimal digits".into()));
        }
        self.line.clear();
        text::encode(&record, &self.ledger.state, &mut self.line);
        if self.line.as_bytes() != self.buffer {
            return Err(DecodeError::NotCanonical(place));
        }
        self.ledger.enter(&record).map_err(|why| malformed(why.into()))?;
        self.buffer.clear();
        self.passed += 1;
        Ok(record)
    }
}

impl<R: BufRead> Iterator for Reader<R> {
    type Item = Result<Record, DecodeError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.finished {
            return None;
        }
        let item = self.advance();
        self.finished = item.is_err() || self.ledger.state.ended();
        Some(item)
    }
}
