//! `convert`: between file formats.

use super::args::ConvertArgs;
use super::files::{Staged, extension, open, read, read_any_mesh};
use super::input::read_input;
use super::outputs::{check_names, spare_input3, stage, stage3};
use super::{Answer, Failure, Status, talk};
use crate::io::{self, AnyMesh, Format, point_dimension, write};
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
        [None, None] if is_points(args)? => points(args, &mut staged)?,
        [None, None] if is_graph(&args.from) => graph(args, &mut staged)?,
        [None, None] => mesh(args, &mut staged)?,
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

/// Whether the file holds points of space and no mesh. An `.off` file is taken so if the other holds points only.
fn is_points(args: &ConvertArgs) -> Result<bool, Failure> {
    let Some(format) = Format::of(&args.from).filter(|f| f.reads_points3()) else {
        return Ok(false);
    };
    Ok(match format {
        Format::Node => {
            let alone = ["ele", "face", "edge"].iter().all(|e| !args.from.with_extension(e).exists());
            alone && point_dimension(format, &read(&args.from)?) == Some(3)
        }
        Format::Off => {
            Format::of(&args.to).is_some_and(|to| to.holds_points3() && to != Format::Off && !to.reads_mesh())
        }
        _ => true,
    })
}

/// Points of space become points of space.
fn points(args: &ConvertArgs, staged: &mut Staged) -> Result<(), Failure> {
    let known = || {
        Failure::at(
            &args.to,
            "points of space convert to .node, .xyz, .off, .ply, .csv, .npy; `triangulate` makes a mesh of them",
        )
    };
    let to = Format::of(&args.to).filter(|f| f.holds_points3()).ok_or_else(known)?;
    // The extension was asked for before.
    let from = Format::of(&args.from).ok_or_else(known)?;
    let column = args.column.column();
    let input = io::read_points3(from, &read(&args.from)?, column.as_ref()).ok_or_else(known)?;
    let input = input.map_err(|e| Failure::at(&args.from, e))?;
    input.notes.iter().for_each(|note| talk(&note.text));
    let bytes = io::write_points3(&input.set, to).ok_or_else(known)?;
    staged.write(&args.to, &bytes)
}

/// A mesh of the plane or of space.
fn mesh(args: &ConvertArgs, staged: &mut Staged) -> Result<(), Failure> {
    let to = std::slice::from_ref(&args.to);
    match read_any_mesh(&args.from, args.column.column().as_ref())? {
        AnyMesh::Plane(mesh) => {
            check_names(to)?;
            stage(to, &mesh.into_mesh(), None, staged)?;
        }
        AnyMesh::Space(mesh) => {
            spare_input3(to, &args.from)?;
            mesh.notes.iter().for_each(|note| talk(&note.text));
            stage3(to, &mesh, staged)?;
        }
    }
    Ok(())
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
