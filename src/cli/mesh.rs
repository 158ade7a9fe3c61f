//! `mesh` and `triangulate`: a run, watched, traced, perhaps mirrored; then its files, all at once.

use super::args::{KernelName, MeshArgs, OutArgs, RunArgs, TriangulateArgs};
use super::convert::trace_format;
use super::files::Staged;
use super::input::{Loaded, load, load_examined, require_points};
use super::outputs::{spare_input, stage};
use super::parameters::parameters;
use super::report::{self, Quality};
use super::watch::{Limit, Watched, catch_interrupts};
use super::{Answer, Failure, Status, data, talk};
#[cfg(feature = "exact")]
use crate::arith::ExactKernel;
use crate::arith::{FastKernel, Kernel};
use crate::domain::Severity;
use crate::model::words::counted;
use crate::model::{Fill, GcdrParameters, Pslg};
use crate::refine::{self, Options, Run, RunError};
use crate::trace::{Comparing, Discard, Format, Outcome, Reader, Sink, Writer, mesh_digest};
use serde_json::{Value, json};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::time::Instant;

/// What is to be run on an input.
enum Task<'a> {
    Refine(&'a GcdrParameters),
    Triangulate,
}

/// Meshes an input.
pub fn run(args: &MeshArgs) -> Answer {
    let parameters = parameters(args)?;
    let fill = args.convex.then_some(Fill::Convex);
    perform(&args.input, fill, &Task::Refine(&parameters), &args.run, &args.out)
}

/// Triangulates an input.
pub fn triangulate(args: &TriangulateArgs) -> Answer {
    require_points(&args.points)?;
    if super::space::is_spatial(&args.points)? {
        return super::space::triangulate(args);
    }
    let column = args.column.column().is_some();
    for (name, given) in [("--weights or --radii", column), ("--steps", args.steps)] {
        if given {
            return Err(Failure::at(
                &args.points,
                format_args!("{name} is for points of space; these are of the plane"),
            ));
        }
    }
    perform(&args.points, Some(Fill::Convex), &Task::Triangulate, &args.run, &args.out)
}

fn perform(path: &Path, fill: Option<Fill>, task: &Task, how: &RunArgs, out: &OutArgs) -> Answer {
    spare_input(&out.output, path)?;
    if how.max_seconds.is_some_and(|s| s.is_nan() || s < 0.0) {
        return Err(Failure::new("--max-seconds: must be a number of seconds, 0 or more"));
    }
    let format = match &out.trace {
        None => None,
        Some(trace) => Some(
            trace_format(trace).ok_or_else(|| Failure::at(trace, "traces end in .jsonl (text) or .obt (binary)"))?,
        ),
    };
    let mut loaded = load(path, fill)?;
    if let Task::Triangulate = task {
        // The hull is triangulated whole: that no region is closed, or where seeds lie, is no matter.
        loaded.entries.retain(|e| e.json["kind"] != "no-closed-region");
    }
    if loaded.refused() {
        loaded.tell_refusal(path, out.json)?;
        return Ok(Status::Refused);
    }
    tell_findings(&loaded);
    catch_interrupts();
    let mut staged = Staged::default();
    let begun = Instant::now();
    let mut limit = Limit::new(how.max_seconds);
    let outcome = traced(&loaded.prepared.pslg, task, how, out, format, &mut staged, &mut limit);
    let (run, trace_digest, memory) = match outcome? {
        Ok(done) => done,
        Err(e) => return refused(e, task, &mut loaded, path, out.json),
    };
    let seconds = begun.elapsed().as_secs_f64();
    let mirror = if how.mirror {
        Some(mirrored(&loaded.prepared.pslg, task, how, &limit, first_trace(out, &staged, &memory)?)?)
    } else {
        None
    };
    let quality = Quality::of(&run.mesh, &run.unmet);
    let files = stage(&out.output, &run.mesh, Some(&loaded.prepared.pslg), &mut staged)?;
    staged.commit()?;
    let digests = [Some(mesh_digest(&run.mesh)), trace_digest];
    tell(&run, &quality, &digests, seconds, mirror.as_ref());
    if out.json {
        let mut value = json(&run, &quality, &digests, seconds);
        value["input"] = path.display().to_string().into();
        value["findings"] = loaded.json();
        value["files"] = files.iter().map(|f| f.display().to_string()).collect();
        if let Task::Refine(parameters) = task {
            // Plain data has a JSON form.
            value["parameters"] = serde_json::to_value(parameters).expect("plain data");
        }
        if let Some(mirror) = &mirror {
            value["mirror"] = mirror.json();
        }
        data(value)?;
    }
    let diverged = mirror.is_some_and(|m| m.divergence.is_some());
    Ok(match run.outcome {
        _ if diverged => Status::No,
        Outcome::Complete => Status::Well,
        Outcome::Holey if report::all_excused(&run.unmet) => Status::Well,
        Outcome::Holey => Status::No,
        Outcome::Stopped => Status::Stopped,
    })
}

/// A run with its trace digest, and the trace itself where only memory holds it.
type Traced = (Run, Option<String>, Vec<u8>);

/// The first run. Its trace goes to the file asked for, else to memory where a mirror needs it, else nowhere.
fn traced(
    pslg: &Pslg,
    task: &Task,
    how: &RunArgs,
    out: &OutArgs,
    format: Option<Format>,
    staged: &mut Staged,
    limit: &mut Limit,
) -> Result<Result<Traced, RunError>, Failure> {
    let mut go = |sink: &mut dyn Sink| {
        let mut stop = || limit.ask();
        let mut options = Options { max_steps: how.max_steps, stop: Some(&mut stop), ..Options::default() };
        with_kernel(
            if how.mirror { KernelName::Fast } else { how.kernel },
            pslg,
            task,
            &mut options,
            &mut Watched::new(sink),
        )
    };
    match (&out.trace, format) {
        (Some(path), Some(format)) => {
            let mut writer: Writer<BufWriter<File>> = Writer::new(staged.create(path)?, format);
            let run = match go(&mut writer)? {
                Ok(run) => run,
                Err(e) => return Ok(Err(e)),
            };
            let digest = writer.digest().map(str::to_string);
            writer.finish().map_err(|e| Failure::at(path, e))?;
            Ok(Ok((run, digest, Vec::new())))
        }
        _ if how.mirror => {
            let mut writer = Writer::new(Vec::new(), Format::Binary);
            let run = match go(&mut writer)? {
                Ok(run) => run,
                Err(e) => return Ok(Err(e)),
            };
            let digest = writer.digest().map(str::to_string);
            Ok(Ok((run, digest, writer.finish().map_err(Failure::new)?)))
        }
        _ => Ok(go(&mut Discard)?.map(|run| (run, None, Vec::new()))),
    }
}

fn with_kernel(
    kernel: KernelName,
    pslg: &Pslg,
    task: &Task,
    options: &mut Options,
    sink: &mut dyn Sink,
) -> Result<Result<Run, RunError>, Failure> {
    fn go<K: Kernel>(pslg: &Pslg, task: &Task, options: &mut Options, sink: &mut dyn Sink) -> Result<Run, RunError> {
        match task {
            Task::Refine(parameters) => refine::gcdr::run::<K>(pslg, parameters, options, sink),
            Task::Triangulate => refine::triangulate::<K>(pslg, sink),
        }
    }
    match kernel {
        KernelName::Fast => Ok(go::<FastKernel>(pslg, task, options, sink)),
        #[cfg(feature = "exact")]
        KernelName::Exact => Ok(go::<ExactKernel>(pslg, task, options, sink)),
        #[cfg(not(feature = "exact"))]
        KernelName::Exact => Err(Failure::new("this program was built without the exact kernel (feature `exact`)")),
    }
}

/// A reader of the first run's trace, wherever it is.
fn first_trace<'a>(
    out: &OutArgs,
    staged: &Staged,
    memory: &'a [u8],
) -> Result<Reader<Box<dyn std::io::BufRead + 'a>>, Failure> {
    let present = out.trace.as_ref().and_then(|path| staged.present(path));
    Ok(Reader::new(match present {
        Some(file) => Box::new(super::files::open(file)?),
        None => Box::new(memory),
    }))
}

/// What the comparison of the kernels came to.
struct Mirror {
    records: u64,
    seconds: f64,
    divergence: Option<String>,
}

impl Mirror {
    fn json(&self) -> Value {
        json!({
            "verdict": if self.divergence.is_none() { "identical" } else { "diverged" },
            "records": self.records, "seconds": self.seconds, "divergence": self.divergence,
        })
    }
}

/// The second run, on the exact kernel, compared record by record with the first. It stops where the first did.
fn mirrored<R: std::io::BufRead>(
    pslg: &Pslg,
    task: &Task,
    how: &RunArgs,
    limit: &Limit,
    trace: Reader<R>,
) -> Result<Mirror, Failure> {
    let begun = Instant::now();
    let mut limit = limit.again();
    let mut stop = || limit.ask();
    let mut options = Options { max_steps: how.max_steps, stop: Some(&mut stop), ..Options::default() };
    let mut comparing = Comparing::new(trace);
    let result = with_kernel(KernelName::Exact, pslg, task, &mut options, &mut comparing)?;
    let divergence = match (comparing.divergence(), result) {
        (Some(d), _) => Some(d.to_string()),
        (None, Err(e)) => Some(format!("the exact kernel ends with: {e}")),
        (None, Ok(_)) => None,
    };
    Ok(Mirror { records: comparing.records(), seconds: begun.elapsed().as_secs_f64(), divergence })
}

/// A run that ended without an outcome: what the input has to do with it is a finding like any other.
fn refused(e: RunError, task: &Task, loaded: &mut Loaded, path: &Path, json: bool) -> Answer {
    match (&e, task) {
        (RunError::Range(findings), _) => loaded.add(findings),
        // The same list as `doctor`'s, located in the file.
        (RunError::Carve(_) | RunError::Build(_), Task::Refine(_)) => {
            *loaded = load_examined(path, Some(loaded.prepared.pslg.fill))?;
            if !loaded.refused() {
                return Err(Failure::at(path, e));
            }
        }
        _ => return Err(Failure::at(path, e)),
    }
    loaded.tell_refusal(path, json)?;
    Ok(Status::Refused)
}

/// Repairs one by one, up to a few; of notes the number only, since `doctor` lists them.
fn tell_findings(loaded: &Loaded) {
    let repairs = loaded.entries.iter().filter(|e| e.severity == Severity::Repair);
    repairs.take(5).for_each(|e| talk(&e.text));
    let (repairs, notes) = (loaded.count(Severity::Repair), loaded.count(Severity::Note));
    if repairs > 5 || notes > 0 {
        let (repairs, notes) = (counted(repairs, "repair"), counted(notes, "note"));
        talk(format_args!("input     {repairs}, {notes} (`doctor` lists them)"));
    }
}

fn tell(run: &Run, quality: &Quality, digests: &[Option<String>; 2], seconds: f64, mirror: Option<&Mirror>) {
    report::lines(run, quality).iter().for_each(talk);
    for (name, digest) in ["mesh", "trace"].iter().zip(digests) {
        if let Some(digest) = digest {
            talk(format_args!("blake3    {digest} ({name})"));
        }
    }
    talk(format_args!("time      {seconds:.3} s"));
    match mirror {
        Some(Mirror { divergence: Some(d), .. }) => talk(format_args!("mirror    DIVERGED: {d}")),
        Some(Mirror { records, seconds, .. }) => {
            talk(format_args!("mirror    identical: {}, exact kernel {seconds:.3} s", counted(*records, "record")));
        }
        None => {}
    }
}

fn json(run: &Run, quality: &Quality, digests: &[Option<String>; 2], seconds: f64) -> Value {
    let c = &run.counts;
    json!({
        "outcome": report::outcome(run.outcome),
        "stop_reason": run.stop_reason,
        "level": report::level(run.level),
        "level_effective": report::level(run.level_effective),
        "counts": {
            "vertices": c.vertices, "triangles": c.triangles, "subsegments": run.mesh.edges.len(), "events": run.events,
            "type_a": c.type_a, "type_b": c.type_b, "type_c": c.type_c, "removed": c.removed, "unmet": c.unmet,
        },
        "quality": quality.json(),
        "unmet": report::unmet_json(&run.unmet),
        "digests": {"mesh": digests[0], "trace": digests[1]},
        "seconds": seconds,
    })
}
