//! Sinks that write no file.

use super::record::{Record, Sink};

/// Keeps the records.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorder(
    /// The records so far.
    pub Vec<Record>,
);

impl Sink for Recorder {
    fn record(&mut self, record: &Record) -> std::io::Result<()> {
        self.0.push(record.clone());
        Ok(())
    }
}

/// Forgets the records.
#[derive(Clone, Copy, Debug, Default)]
pub struct Discard;

impl Sink for Discard {
    fn record(&mut self, _: &Record) -> std::io::Result<()> {
        Ok(())
    }
}
