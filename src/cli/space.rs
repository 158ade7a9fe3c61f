//! Points of space: `triangulate` and `doctor` for them.
//!
//! A triangulation runs on a thread of its own, so that an interrupt or a budget ends the command at any time. A run that was stopped has no answer that is
//! worth a file: outcome `stopped`, nothing is written.

use super::args::{ColumnArgs, KernelName, OutArgs, TriangulateArgs};
use super::convert::trace_format;
use super::files::{Staged, open, read};
use super::input::{Entry, finding, note, syntax, tell_refusal};
use super::outputs::{spare_input3, stage3};
use super::report::figures;
use super::watch::{Limit, catch_interrupts};
use super::{Answer, Failure, Status, data, talk};
#[cfg(feature = "exact")]
use crate::arith::ExactKernel;
use crate::arith::FastKernel;
use crate::audit::space::{Claim, Options, Subject, audit};
use crate::domain::{Element, Severity, normalise3};
use crate::io::{self, Column, ForeignMesh3, Format, point_dimension};
use crate::model::words::{counted, listed};
use crate::model::{PointSet3, PointState, Triangulation3, VertexId, WeightedPoint};
use crate::refine::RunError;
use crate::refine::regular::{Certificate, triangulate3};
use crate::trace::{self, Comparing, Reader, Record, Sink, Writer, triangulation_digest};
use crate::triangulation::regular3::Regular3;
use serde_json::{Value, json};
use std::fs::File;
use std::io::{BufRead, BufWriter};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// How many notes are told before a run, so that its answer stays in sight.
const TOLD: usize = 5;

/// Whether a file holds points of space. Errors: the header of a `.node` file cannot be read.
pub fn is_spatial(path: &Path) -> Result<bool, Failure> {
    let Some(format) = Format::of(path) else {
        return Ok(false);
    };
    let head = if format == Format::Node { read(path)? } else { Vec::new() };
    Ok(point_dimension(format, &head) == Some(3))
}

impl ColumnArgs {
    /// The column that was asked for.
    pub fn column(&self) -> Option<Column> {
        let weights = self.weights.as_deref().map(|name| Column::Weight(name.into()));
        weights.or_else(|| self.radii.as_deref().map(|name| Column::Radius(name.into())))
    }
}

/// Points with what was found in them.
struct Loaded {
    set: PointSet3,
    entries: Vec<Entry>,
}

/// Reads and examines points, errors first. Errors: the file cannot be opened.
fn load(path: &Path, column: Option<&Column>) -> Result<Loaded, Failure> {
    let known = || Failure::at(path, "points of space are .node, .xyz, .off, .ply, .csv, .npy");
    let format = Format::of(path).ok_or_else(known)?;
    let input = match io::read_points3(format, &read(path)?, column).ok_or_else(known)? {
        Ok(input) => input,
        Err(e) => return Ok(Loaded { set: PointSet3::default(), entries: vec![syntax(&e)] }),
    };
    let mut entries: Vec<Entry> = input.notes.iter().map(note).collect();
    if let Err(findings) = normalise3(&input.set) {
        entries.extend(findings.iter().map(finding));
    }
    entries.sort_by_key(|e| e.severity);
    Ok(Loaded { set: input.set, entries })
}

/// The points of a file, to compare a trace with; `None` if they are refused, which is told.
pub fn points(path: &Path, column: &ColumnArgs, json: bool) -> Result<Option<Vec<WeightedPoint>>, Failure> {
    let Loaded { set, entries } = load(path, column.column().as_ref())?;
    if refused(&entries) {
        tell_refusal(&entries, path, json)?;
        return Ok(None);
    }
    Ok(Some(set.weighted().collect()))
}

fn refused(entries: &[Entry]) -> bool {
    entries.iter().any(|e| e.severity == Severity::Error)
}

/// All that can be said about points, for `doctor`: what stands for what, what is hidden, and their dimension.
pub fn examined(path: &Path, column: Option<&Column>) -> Result<Vec<Entry>, Failure> {
    let Loaded { set, mut entries } = load(path, column)?;
    let Some((points, _)) = normalise3(&set).ok().filter(|_| !refused(&entries)) else {
        return Ok(entries);
    };
    let t = Regular3::<FastKernel>::build(&points, 1);
    let line = |v: VertexId| set.lines.get(v.index()).copied().filter(|&l| l > 0);
    let entry = |severity: Severity, kind: &str, elements: &[VertexId], message: String, fix: &str| {
        let coordinates: Vec<[f64; 3]> = elements.iter().map(|v| set.points[v.index()].to_array()).collect();
        let lines: Vec<u32> = elements.iter().filter_map(|&v| line(v)).collect();
        let name = if severity == Severity::Repair { "repair" } else { "note" };
        let place = if lines.is_empty() { String::new() } else { format!(" ({})", listed("line", &lines, 8)) };
        let elements: Vec<Element> = elements.iter().map(|&v| Element::Vertex(v)).collect();
        Entry {
            severity,
            text: format!("{name}: {message}{place}"),
            json: json!({
                "severity": name, "kind": kind, "elements": elements, "coordinates": coordinates,
                "line": lines.first(), "lines": lines, "message": message, "fix": fix,
            }),
        }
    };
    for v in (0..points.len() as u32).map(VertexId) {
        entries.extend(match t.state(v) {
            PointState::Duplicate { of } => {
                let message = format!("point {} repeats point {}, which stands for both", v.0, of.0);
                Some(entry(Severity::Repair, "duplicate", &[v, of], message, "none needed"))
            }
            PointState::Hidden => {
                let message = format!("point {} is hidden: its weight is too small for it to be a vertex", v.0);
                Some(entry(Severity::Note, "hidden", &[v], message, "give it a larger weight if it is to be a vertex"))
            }
            PointState::Vertex | PointState::Removed => None,
        });
    }
    if let Some(what) = flatness(t.dimension()) {
        entries.push(entry(Severity::Note, "flat", &[], what.into(), "none needed"));
    }
    entries.sort_by_key(|e| e.severity);
    Ok(entries)
}

/// What is to be said about points that do not span space.
fn flatness(dimension: Option<u8>) -> Option<&'static str> {
    match dimension {
        None => Some("there are no points"),
        Some(0) => Some("all points are at one place, which is the triangulation"),
        Some(1) => Some("all points lie on one line, and so does the triangulation"),
        Some(2) => Some("all points lie in one plane, and so does the triangulation"),
        Some(_) => None,
    }
}

/// Where a trace goes.
enum Target {
    File(Box<Writer<BufWriter<File>>>),
    Memory(Box<Writer<Vec<u8>>>),
    Nowhere,
}

/// Passes records on and counts events.
struct Counting<'a> {
    target: &'a mut Target,
    events: u64,
}

impl Sink for Counting<'_> {
    fn record(&mut self, record: &Record) -> std::io::Result<()> {
        self.events += u64::from(record.is_event());
        match self.target {
            Target::File(writer) => writer.record(record),
            Target::Memory(writer) => writer.record(record),
            Target::Nowhere => Ok(()),
        }
    }
}

/// What is to be done, for a thread to take along.
#[derive(Clone)]
struct Job {
    set: Arc<PointSet3>,
    certificate: Certificate,
    threads: usize,
}

impl Job {
    fn run(&self, kernel: KernelName, sink: &mut dyn Sink) -> Result<Triangulation3, Broken> {
        match kernel {
            KernelName::Fast => Ok(triangulate3::<FastKernel>(&self.set, self.certificate, self.threads, sink)?),
            #[cfg(feature = "exact")]
            KernelName::Exact => Ok(triangulate3::<ExactKernel>(&self.set, self.certificate, self.threads, sink)?),
            #[cfg(not(feature = "exact"))]
            KernelName::Exact => Err(Broken::NoKernel),
        }
    }
}

/// Why a run has no triangulation.
enum Broken {
    Run(RunError),
    #[cfg(not(feature = "exact"))]
    NoKernel,
}

impl From<RunError> for Broken {
    fn from(e: RunError) -> Self {
        Broken::Run(e)
    }
}

impl std::fmt::Display for Broken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Broken::Run(e) => e.fmt(f),
            #[cfg(not(feature = "exact"))]
            Broken::NoKernel => f.write_str("this program was built without the exact kernel (feature `exact`)"),
        }
    }
}

/// Does work on a thread of its own until it is done or a limit says why not.
fn until<T: Send + 'static>(limit: &mut Limit, work: impl FnOnce() -> T + Send + 'static) -> Result<T, String> {
    let (sender, receiver) = sync_channel(1);
    let worker = thread::spawn(move || drop(sender.send(work())));
    loop {
        match receiver.recv_timeout(Duration::from_millis(20)) {
            Ok(done) => return Ok(done),
            Err(RecvTimeoutError::Timeout) => {
                if let Some(reason) = limit.ask() {
                    return Err(reason);
                }
            }
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(bug) => std::panic::resume_unwind(bug),
                // A worker ends by sending, or by a panic.
                Ok(()) => unreachable!("the worker sent nothing"),
            },
        }
    }
}

/// Triangulates points of space.
pub fn triangulate(args: &TriangulateArgs) -> Answer {
    let (path, how, out) = (&args.points, &args.run, &args.out);
    spare_input3(&out.output, path)?;
    if how.max_seconds.is_some_and(|s| s.is_nan() || s < 0.0) {
        return Err(Failure::new("--max-seconds: must be a number of seconds, 0 or more"));
    }
    let format = out.trace.as_ref().map(|trace| {
        trace_format(trace).ok_or_else(|| Failure::at(trace, "traces end in .jsonl (text) or .obt (binary)"))
    });
    let format = format.transpose()?;
    let Loaded { set, entries } = load(path, args.column.column().as_ref())?;
    if refused(&entries) {
        tell_refusal(&entries, path, out.json)?;
        return Ok(Status::Refused);
    }
    entries.iter().take(TOLD).for_each(|e| talk(&e.text));
    if entries.len() > TOLD {
        talk(format_args!("and {} (`doctor` lists all)", counted(entries.len() - TOLD, "more note")));
    }
    catch_interrupts();
    let certificate = if args.steps { Certificate::Steps } else { Certificate::Final };
    let all = thread::available_parallelism().map_or(1, usize::from);
    let begun = Instant::now();
    let job = Job { set: Arc::new(set), certificate, threads: args.threads.map_or(all, |n| usize::from(n).min(64)) };
    if job.set.points.len() as u64 > how.max_steps {
        return stopped(format!("--max-steps {}: there are more points", how.max_steps), path, out, begun);
    }
    let mut staged = Staged::default();
    let target = match (&out.trace, format) {
        (Some(trace), Some(format)) => Target::File(Box::new(Writer::new(staged.create(trace)?, format))),
        _ if how.mirror => Target::Memory(Box::new(Writer::new(Vec::new(), trace::Format::Binary))),
        _ => Target::Nowhere,
    };
    let mut limit = Limit::new(how.max_seconds);
    let (first, kernel) = (job.clone(), if how.mirror { KernelName::Fast } else { how.kernel });
    let done = until(&mut limit, move || {
        let mut target = target;
        let mut sink = Counting { target: &mut target, events: 0 };
        let result = first.run(kernel, &mut sink);
        (result, sink.events, target)
    });
    let (result, events, target) = match done {
        Ok(done) => done,
        Err(reason) => return stopped(reason, path, out, begun),
    };
    let t = result.map_err(|e| Failure::at(path, e))?;
    let seconds = begun.elapsed().as_secs_f64();
    let (trace_digest, memory) = ended(target, out)?;
    let mirror = if how.mirror {
        match mirrored(&job, &mut limit, first_trace(out, &staged, memory)?) {
            Ok(mirror) => Some(mirror),
            Err(reason) => return stopped(reason, path, out, begun),
        }
    } else {
        None
    };
    let files = stage3(&out.output, &ForeignMesh3::from(&t), &mut staged)?;
    staged.commit()?;
    let summary = Summary { t: &t, events, digests: [Some(triangulation_digest(&t)), trace_digest], seconds };
    summary.tell(mirror.as_ref());
    if out.json {
        let mut value = summary.json();
        value["input"] = path.display().to_string().into();
        value["findings"] = entries.iter().map(|e| e.json.clone()).collect();
        value["files"] = files.iter().map(|f| f.display().to_string()).collect();
        value["threads"] = job.threads.into();
        if let Some((divergence, seconds)) = &mirror {
            let verdict = if divergence.is_none() { "identical" } else { "diverged" };
            value["mirror"] = json!({"verdict": verdict, "seconds": seconds, "divergence": divergence});
        }
        data(value)?;
    }
    Ok(if mirror.is_some_and(|m| m.0.is_some()) { Status::No } else { Status::Well })
}

/// A run that was stopped: nothing is written.
fn stopped(reason: String, path: &Path, out: &OutArgs, begun: Instant) -> Answer {
    talk(format_args!("outcome   stopped ({reason}); a part of a triangulation is none: nothing is written"));
    if out.json {
        let input = path.display().to_string();
        data(json!({
            "outcome": "stopped", "stop_reason": reason, "level": null, "counts": {}, "quality": {}, "unmet": [],
            "digests": {}, "seconds": begun.elapsed().as_secs_f64(), "input": input, "files": [],
        }))?;
    }
    Ok(Status::Stopped)
}

/// Ends a trace: its digest, and its bytes where only memory holds it.
fn ended(target: Target, out: &OutArgs) -> Result<(Option<String>, Vec<u8>), Failure> {
    let at = |e: std::io::Error| match &out.trace {
        Some(path) => Failure::at(path, e),
        None => Failure::new(e),
    };
    Ok(match target {
        Target::File(writer) => {
            let digest = writer.digest().map(str::to_string);
            writer.finish().map_err(at)?;
            (digest, Vec::new())
        }
        Target::Memory(writer) => (writer.digest().map(str::to_string), writer.finish().map_err(at)?),
        Target::Nowhere => (None, Vec::new()),
    })
}

type AnyTrace = Reader<Box<dyn BufRead + Send>>;

/// A reader of the first run's trace, wherever it is.
fn first_trace(out: &OutArgs, staged: &Staged, memory: Vec<u8>) -> Result<AnyTrace, Failure> {
    let present = out.trace.as_ref().and_then(|path| staged.present(path));
    Ok(Reader::new(match present {
        Some(file) => Box::new(open(file)?),
        None => Box::new(std::io::Cursor::new(memory)),
    }))
}

/// The second run, on the exact kernel, compared record by record with the first: the first difference, and seconds.
fn mirrored(job: &Job, limit: &mut Limit, trace: AnyTrace) -> Result<(Option<String>, f64), String> {
    let (begun, job) = (Instant::now(), job.clone());
    let divergence = until(limit, move || {
        let mut comparing = Comparing::new(trace);
        let result = job.run(KernelName::Exact, &mut comparing);
        match (comparing.divergence(), result) {
            (Some(d), _) => Some(d.to_string()),
            (None, Err(e)) => Some(format!("the exact kernel ends with: {e}")),
            (None, Ok(_)) => None,
        }
    })?;
    Ok((divergence, begun.elapsed().as_secs_f64()))
}

/// What is told about a triangulation.
struct Summary<'a> {
    t: &'a Triangulation3,
    events: u64,
    digests: [Option<String>; 2],
    seconds: f64,
}

impl Summary<'_> {
    /// Vertices, hidden points, duplicates.
    fn states(&self) -> [usize; 3] {
        let count = |wanted: fn(&PointState) -> bool| self.t.states.iter().filter(|s| wanted(s)).count();
        [
            count(|s| matches!(s, PointState::Vertex)),
            count(|s| matches!(s, PointState::Hidden)),
            count(|s| matches!(s, PointState::Duplicate { .. })),
        ]
    }

    fn tell(&self, mirror: Option<&(Option<String>, f64)>) {
        let [vertices, hidden, duplicates] = self.states();
        let noun = match self.t.dimension {
            Some(3) => "tetrahedron",
            Some(2) => "triangle",
            Some(1) => "edge",
            _ => "point",
        };
        let simplices = counted(self.t.simplices().len(), noun);
        talk("outcome   complete");
        talk(format_args!(
            "points    {}: {}, {hidden} hidden, {}",
            self.t.points.len(),
            counted(vertices, "vertex"),
            counted(duplicates, "duplicate")
        ));
        talk(format_args!("cells     {simplices}"));
        if let Some(what) = flatness(self.t.dimension) {
            talk(format_args!("note: {what}"));
        }
        for (name, digest) in ["mesh", "trace"].iter().zip(&self.digests) {
            if let Some(digest) = digest {
                talk(format_args!("blake3    {digest} ({name})"));
            }
        }
        talk(format_args!("time      {:.3} s", self.seconds));
        match mirror {
            Some((Some(d), _)) => talk(format_args!("mirror    DIVERGED: {d}")),
            Some((None, seconds)) => talk(format_args!("mirror    identical, exact kernel {seconds:.3} s")),
            None => {}
        }
    }

    fn json(&self) -> Value {
        let [vertices, hidden, duplicates] = self.states();
        json!({
            "outcome": "complete",
            "stop_reason": null,
            "level": null,
            "dimension": self.t.dimension,
            "counts": {
                "points": self.t.points.len(), "vertices": vertices, "hidden": hidden, "duplicates": duplicates,
                "cells": self.t.simplices().len(), "events": self.events,
            },
            "quality": self.quality(),
            "unmet": [],
            "digests": {"mesh": self.digests[0], "trace": self.digests[1]},
            "seconds": self.seconds,
        })
    }

    /// Figures of tetrahedra.
    fn quality(&self) -> Value {
        let mesh = ForeignMesh3::from(self.t);
        let subject = Subject { points: &mesh.points, cells: &mesh.tetrahedra, ..Subject::default() };
        let report = audit(&subject, &Options { claims: &[Claim::Quality], ..Options::default() });
        figures(report.claims.iter().flat_map(|c| &c.figures))
    }
}
