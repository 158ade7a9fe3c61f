//! `convert`: between file formats.

use super::args::ConvertArgs;
use super::files::{Staged, companion, extension, open, read, read_any_mesh};
use super::input::{read_input, tell_notes};
use super::outputs::{check_alone, spare_file, spare_input, spare_input3, stage, stage3, tell_lost};
use super::watch::{Limit, catch_interrupts};
use super::{Answer, Failure, Status, talk};
use crate::io::{self, AnyMesh, Format, point_dimension, write};
use crate::model::{Fill, PointSet3};
use crate::trace::{self, Reader, Sink, Writer};
use std::path::Path;

/// Converts a trace, an input or a mesh by the extensions of its two names. A `.poly` or `.node` file with an `.ele` file of the same name
/// is a mesh.
pub fn run(args: &ConvertArgs) -> Answer {
    spare_file(&args.to, &args.from)?;
    let mut staged = Staged::default();
    match [&args.from, &args.to].map(|path| trace_format(path)) {
        [Some(_), Some(to)] => {
            let status = convert_trace(&args.from, &args.to, to, &mut staged)?;
            if status != Status::Well {
                return Ok(status);
            }
        }
        [Some(_), None] => {
            return Err(Failure::at(
                &args.to,
                "a trace converts to .jsonl or .obt; `replay TRACE -o MESH` makes a mesh of it",
            ));
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
    tell_notes(&input.notes);
    write_points(&input.set, args, to, staged)
}

fn write_points(set: &PointSet3, args: &ConvertArgs, to: Format, staged: &mut Staged) -> Result<(), Failure> {
    check_alone(&args.to)?;
    if to.loses_weights() && set.weights.iter().any(|&w| w != 0.0) {
        tell_lost(&args.to, "weights");
    }
    // The caller has seen to the format.
    let bytes = io::write_points3(set, to).ok_or_else(|| Failure::at(&args.to, "no format of points"))?;
    staged.write(&args.to, &bytes)
}

/// The points of a mesh of space.
fn points_of_mesh(args: &ConvertArgs, to: Format, staged: &mut Staged) -> Result<(), Failure> {
    let known = || Failure::at(&args.from, "points of space are taken from .vtu, .vtk, .msh, .mesh, .node, .ele");
    let from = Format::of(&args.from).ok_or_else(known)?;
    let bytes = read(&args.from)?;
    let mesh = io::read_mesh3(from, &bytes, args.column.column().as_ref(), companion(&args.from)).ok_or_else(known)?;
    let mesh = mesh.map_err(|e| Failure::at(&args.from, e))?;
    tell_notes(&mesh.notes);
    let [cells, triangles, edges] = [mesh.tetrahedra.len(), mesh.triangles.len(), mesh.edges.len()];
    if cells + triangles + edges > 0 {
        tell_lost(&args.to, "elements");
    }
    write_points(&mesh.point_set(), args, to, staged)
}

/// A mesh of the plane or of space, or its points where the other file holds no more.
fn mesh(args: &ConvertArgs, staged: &mut Staged) -> Result<(), Failure> {
    if let Some(format @ (Format::Xyz | Format::Csv | Format::Npy | Format::Ply)) = Format::of(&args.to) {
        return points_of_mesh(args, format, staged);
    }
    if Format::of(&args.to).is_none() {
        return Err(Failure::at(&args.to, "its extension names no format that is written here"));
    }
    let to = std::slice::from_ref(&args.to);
    match read_any_mesh(&args.from, args.column.column().as_ref())? {
        AnyMesh::Plane(mesh) => {
            tell_notes(&mesh.notes);
            spare_input(to, &args.from)?;
            stage(to, &mesh.into_mesh(), None, staged)?;
        }
        AnyMesh::Space(mesh) => {
            spare_input3(to, &args.from)?;
            tell_notes(&mesh.notes);
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
    tell_notes(&input.notes);
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
fn convert_trace(from: &Path, to: &Path, format: trace::Format, staged: &mut Staged) -> Answer {
    catch_interrupts();
    let mut limit = Limit::new(None);
    let mut reader = Reader::new(open(from)?);
    let mut writer = Writer::new(staged.create(to)?, format);
    while let Some(record) = reader.next() {
        if limit.ask().is_some() {
            talk("outcome   stopped (interrupted); nothing is written");
            return Ok(Status::Stopped);
        }
        let record = record.map_err(|e| Failure::at(from, e))?;
        if record.trace_digest().is_some_and(|digest| digest != reader.digest()) {
            return Err(Failure::at(from, "the digest of the trace does not fit its content"));
        }
        writer.record(&record).map_err(|e| Failure::at(to, e))?;
    }
    writer.finish().map_err(|e| Failure::at(to, e))?;
    Ok(Status::Well)
}
