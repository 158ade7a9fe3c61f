//! `convert`: between file formats.

use super::args::ConvertArgs;
use super::files::{Staged, extension, open, read_mesh};
use super::input::read_input;
use super::outputs::{check_names, stage};
use super::{Answer, Failure, Status, talk};
use crate::io::{Format, write};
use crate::model::Fill;
use crate::trace::{self, Reader, Sink, Writer};
use std::path::Path;

/// Converts a trace, an input or a mesh by the extensions of its two names. A `.poly` or `.node` file with an `.ele` file of the same name
/// is a mesh.
pub fn run(args: &ConvertArgs) -> Answer {
    let mut staged = Staged::default();
    match [&args.from, &args.to].map(|path| trace_format(path)) {
        [Some(_), Some(to)] => convert_trace(&args.from, &args.to, to, &mut staged)?,
        [Some(_), None] => {
            return Err(Failure::at(&args.to, "a trace converts to .jsonl or .obt; `replay` makes a mesh of it"));
        }
        [None, Some(_)] => return Err(Failure::at(&args.from, "only a trace converts to a trace")),
        [None, None] if is_graph(&args.from) => graph(args, &mut staged)?,
        [None, None] => {
            check_names(std::slice::from_ref(&args.to))?;
            let mesh = read_mesh(&args.from)?.into_mesh();
            stage(std::slice::from_ref(&args.to), &mesh, None, &mut staged)?;
        }
    }
    staged.commit()?;
    Ok(Status::Well)
}

fn is_graph(path: &Path) -> bool {
    match Format::of(path) {
        Some(Format::Poly | Format::Node) => !path.with_extension("ele").exists(),
        Some(format) => format.reads_pslg(),
        None => false,
    }
}

/// A graph becomes a `.poly` file. One whose faces alternate loses that, and it is told: only hole seeds could say it there.
fn graph(args: &ConvertArgs, staged: &mut Staged) -> Result<(), Failure> {
    if Format::of(&args.to) != Some(Format::Poly) {
        return Err(Failure::at(&args.to, "a planar straight line graph converts to .poly; `mesh` makes a mesh of it"));
    }
    let input = read_input(&args.from)?.map_err(|e| Failure::at(&args.from, e))?;
    for note in &input.notes {
        talk(&note.text);
    }
    if input.pslg.fill == Fill::Parity && input.pslg.segments.iter().any(|s| s.toggles) {
        talk(
            "note: .poly knows holes by seeds only; faces that the even-odd rule leaves out are filled unless seeds are added",
        );
    }
    staged.write(&args.to, &write::triangle::pslg(&input.pslg))
}

/// The form of a trace by its extension.
pub fn trace_format(path: &Path) -> Option<trace::Format> {
    match extension(path).as_str() {
        "jsonl" => Some(trace::Format::Text),
        "obt" => Some(trace::Format::Binary),
        _ => None,
    }
}

/// Refuses a trace whose stored digest is not its own, which writing it anew would hide.
fn convert_trace(from: &Path, to: &Path, format: trace::Format, staged: &mut Staged) -> Result<(), Failure> {
    let mut reader = Reader::new(open(from)?);
    let mut writer = Writer::new(staged.create(to)?, format);
    while let Some(record) = reader.next() {
        let record = record.map_err(|e| Failure::at(from, e))?;
        if record.trace_digest().is_some_and(|digest| digest != reader.digest()) {
            return Err(Failure::at(from, "the digest of the trace does not fit its content"));
        }
        writer.record(&record).map_err(|e| Failure::at(to, e))?;
    }
    writer.finish().map_err(|e| Failure::at(to, e))?;
    Ok(())
}
