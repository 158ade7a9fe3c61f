//! `replay`: the mesh after an event of a trace.

use super::args::ReplayArgs;
use super::files::{Staged, open};
use super::outputs::{check_names, stage, stage3};
use super::{Answer, Failure, Status, talk};
use crate::check::{Checker, Options, Verdict};
use crate::io::ForeignMesh3;
use crate::model::words::counted;
use crate::model::{Mesh2, Pslg, VertexKind};
use crate::trace::{Event, Reader, Record};

/// Replays a trace on the checker's own complex, which proves each event on the way, and writes the mesh after event `--to`, or at the end. Since a
/// deletion only makes room for a split, a replay to a deletion goes on to its split; in space one to a removal goes on until the points it set free are placed. Exit code 1 if an event is not justified.
pub fn run(args: &ReplayArgs) -> Answer {
    let mut checker = Checker::new(Options { strict: false, digests: false });
    let mut domain = Pslg::default();
    let mut reached = false;
    let mut last = None;
    for record in Reader::new(open(&args.trace)?) {
        let record = record.map_err(|e| Failure::at(&args.trace, e))?;
        if let Record::Header(_) = record {
            check_names(&args.output)?;
        }
        note(&record, &mut domain);
        if checker.push(&record).is_err() {
            if let Verdict::Rejected(r) = checker.finish() {
                talk(format_args!("{}: {r}", args.trace.display()));
            }
            return Ok(Status::No);
        }
        if record.is_event() {
            let number = last.map_or(0, |n: u64| n + 1);
            last = Some(number);
            let waits = matches!(record, Record::Event(Event::Remove { .. })) || !checker.is_settled();
            reached = args.to.is_some_and(|to| number >= to) && !waits;
            if reached {
                break;
            }
        }
    }
    if let Some(to) = args.to
        && !reached
    {
        let end = last.map_or("no event; leave --to away".to_string(), |n| format!("events 0 to {n}"));
        return Err(Failure::new(format_args!("--to {to}: the trace has {end}")));
    }
    let mut staged = Staged::default();
    let event = match (last, args.to) {
        (Some(n), Some(to)) if n > to => format!("event {n}, to which event {to} leads"),
        (Some(n), _) => format!("event {n}"),
        (None, _) => "the end, without events".into(),
    };
    if let Some(t) = checker.triangulation() {
        stage3(&args.output, &ForeignMesh3::from(&t), &mut staged)?;
        staged.commit()?;
        talk(format_args!(
            "{event}: {}, {}",
            counted(t.points.len(), "point"),
            counted(t.simplices().len(), "simplex")
        ));
        return Ok(Status::Well);
    }
    let mesh = dressed(checker.mesh(), &domain);
    stage(&args.output, &mesh, Some(&domain), &mut staged)?;
    staged.commit()?;
    talk(format_args!(
        "{event}: {}, {}",
        counted(mesh.points.len(), "vertex"),
        counted(mesh.triangles.len(), "triangle")
    ));
    Ok(Status::Well)
}

/// Keeps what the checker has no use for: markers, attributes, seeds.
fn note(record: &Record, domain: &mut Pslg) {
    match record {
        Record::Vertex { marker, attributes, .. } => {
            domain.point_markers.push(marker.unwrap_or(0));
            domain.attributes.extend(attributes);
            domain.attributes_per_point = attributes.len();
        }
        Record::Hole(hole) => domain.holes.push(*hole),
        Record::Region(region) => domain.regions.push(*region),
        _ => {}
    }
}

/// Gives input vertices their markers and attributes back; input vertices come first, and none is ever deleted.
fn dressed(mut mesh: Mesh2, domain: &Pslg) -> Mesh2 {
    let inputs = mesh.kinds.iter().take_while(|k| **k == VertexKind::Input).count();
    mesh.point_markers[..inputs].copy_from_slice(&domain.point_markers[..inputs]);
    mesh.attributes_per_point = domain.attributes_per_point;
    mesh.attributes.clone_from(&domain.attributes);
    mesh.attributes.resize(mesh.points.len() * mesh.attributes_per_point, 0.0);
    mesh
}
