//! `convert`: between file formats.

use super::args::ConvertArgs;
use super::files::{Staged, extension, open};
use super::{Answer, Failure, Status};
use crate::trace::{Format, Reader, Record, Sink, Writer};
use std::path::Path;

/// Converts a trace, an input or a mesh by the extensions of its two names.
pub fn run(args: &ConvertArgs) -> Answer {
    let [from, to] = [&args.from, &args.to].map(|path| trace_format(path));
    let mut staged = Staged::default();
    match (from, to) {
        (Some(_), Some(to)) => trace(&args.from, &args.to, to, &mut staged)?,
        (Some(_), None) => {
            return Err(Failure::at(
                &args.to,
                "a trace converts to .jsonl or .obt; `replay` makes a mesh of it",
            ));
        }
        (None, _) => return Err(Failure::at(&args.from, "this file cannot be converted")),
    }
    staged.commit()?;
    Ok(Status::Well)
}

/// The form of a trace by its extension.
pub fn trace_format(path: &Path) -> Option<Format> {
    match extension(path).as_str() {
        "jsonl" => Some(Format::Text),
        "obt" => Some(Format::Binary),
        _ => None,
    }
}

/// Refuses a trace whose stored digest is not its own, which writing it anew would hide.
fn trace(from: &Path, to: &Path, format: Format, staged: &mut Staged) -> Result<(), Failure> {
    let mut reader = Reader::new(open(from)?);
    let mut writer = Writer::new(staged.create(to)?, format);
    while let Some(record) = reader.next() {
        let record = record.map_err(|e| Failure::at(from, e))?;
        if let Record::End(end) = &record
            && end.trace != reader.digest()
        {
            return Err(Failure::at(
                from,
                "the digest of the trace does not fit its content",
            ));
        }
        writer.record(&record).map_err(|e| Failure::at(to, e))?;
    }
    writer.finish().map_err(|e| Failure::at(to, e))?;
    Ok(())
}
