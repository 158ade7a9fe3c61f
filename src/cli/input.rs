//! Inputs: read by extension, examined, and what is wrong with them told.

use super::files::{companion, read};
use super::{Failure, data, talk};
use crate::arith::FastKernel;
use crate::doctor::examine;
use crate::domain::{Finding, Prepared, Severity, prepare};
use crate::io::{self, Format, Input, Note, NoteKind, ReadError};
use crate::model::{Fill, Lines, Pslg};
use serde_json::{Value, json};
use std::path::Path;

/// One thing found in an input, by the reader or by the examination of what was read.
#[derive(Debug)]
pub struct Entry {
    /// Its weight.
    pub severity: Severity,
    /// For people.
    pub text: String,
    /// For programs: severity, kind, elements, coordinates, line, message, fix.
    pub json: Value,
}

/// An input read and made ready.
#[derive(Debug)]
pub struct Loaded {
    /// What is to be meshed, with the findings of its examination.
    pub prepared: Prepared,
    /// What was found, errors first.
    pub entries: Vec<Entry>,
}

/// Reads and examines an input. A fault of the file is an entry of its own, and the only one. Errors: the file cannot be opened, or its
/// extension says nothing.
pub fn load(path: &Path, fill: Option<Fill>) -> Result<Loaded, Failure> {
    load_with(path, fill, prepare::<FastKernel>)
}

/// As `load`, but examines all that a trial triangulation can tell, too.
pub fn load_examined(path: &Path, fill: Option<Fill>) -> Result<Loaded, Failure> {
    load_with(path, fill, examine::<FastKernel>)
}

fn load_with(path: &Path, fill: Option<Fill>, make: fn(&Pslg, &Lines) -> Prepared) -> Result<Loaded, Failure> {
    let mut input = match read_input(path)? {
        Ok(input) => input,
        Err(e) => {
            let prepared = Prepared::default();
            return Ok(Loaded { prepared, entries: vec![syntax(&e)] });
        }
    };
    if let Some(fill) = fill {
        input.pslg.fill = fill;
    }
    let prepared = make(&input.pslg, &input.lines);
    let notes = input.notes.iter().map(note);
    let mut entries: Vec<Entry> = notes.chain(prepared.findings.iter().map(finding)).collect();
    entries.sort_by_key(|e| e.severity);
    Ok(Loaded { prepared, entries })
}

/// Reads an input by its extension; the inner error is a fault of its content.
pub fn read_input(path: &Path) -> Result<Result<Input, ReadError>, Failure> {
    let known = || {
        let hint = if is_points(path) { "; `triangulate` takes points of space" } else { mesh_hint(path) };
        Failure::at(path, format_args!("inputs are .poly, .node, .wkt, .geojson{hint}"))
    };
    let format = Format::of(path).filter(|f| f.reads_pslg()).ok_or_else(known)?;
    let bytes = read(path)?;
    io::read_pslg(format, &bytes, companion(path)).ok_or_else(known)
}

fn is_points(path: &Path) -> bool {
    Format::of(path).is_some_and(Format::reads_points3)
}

/// What to do with a mesh where points are wanted.
fn mesh_hint(path: &Path) -> &'static str {
    let mesh = Format::of(path).is_some_and(|f| f.reads_mesh() || f.reads_mesh3());
    if mesh { "; of a mesh in space, `convert MESH points.csv` takes the points" } else { "" }
}

/// Refuses a file that holds no points, of the plane or of space. Errors: the formats that do.
pub fn require_points(path: &Path) -> Result<(), Failure> {
    if is_points(path) || Format::of(path).is_some_and(Format::reads_pslg) {
        return Ok(());
    }
    let known =
        "points are .xyz, .csv, .tsv, .npy, .ply, .off, .node in space, and .node, .poly, .wkt, .geojson in the plane";
    Err(Failure::at(path, format_args!("{known}{}", mesh_hint(path))))
}

impl Loaded {
    /// Whether the input is to be refused.
    pub fn refused(&self) -> bool {
        self.entries.iter().any(|e| e.severity == Severity::Error)
    }

    /// Adds findings that only a triangulation could make.
    pub fn add(&mut self, more: &[Finding]) {
        self.entries.extend(more.iter().map(finding));
        self.entries.sort_by_key(|e| e.severity);
    }

    /// Tells that the input is refused, and why: all errors on stderr, all findings on stdout if a program listens.
    pub fn tell_refusal(&self, path: &Path, json: bool) -> Result<(), Failure> {
        tell_refusal(&self.entries, path, json)
    }

    /// All findings for programs.
    pub fn json(&self) -> Value {
        self.entries.iter().map(|e| e.json.clone()).collect()
    }

    /// How many findings have a severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.entries.iter().filter(|e| e.severity == severity).count()
    }
}

/// As `Loaded::tell_refusal`.
pub fn tell_refusal(entries: &[Entry], path: &Path, json: bool) -> Result<(), Failure> {
    for entry in entries.iter().filter(|e| e.severity == Severity::Error) {
        talk(format_args!("{}: {}", path.display(), entry.text));
    }
    if json {
        let findings: Value = entries.iter().map(|e| e.json.clone()).collect();
        data(json!({"outcome": "refused", "input": path.display().to_string(), "findings": findings}))?;
    }
    Ok(())
}

/// A finding as an entry.
pub fn finding(f: &Finding) -> Entry {
    // Plain data has a JSON form.
    let json = serde_json::to_value(f).expect("findings are plain data");
    Entry { severity: f.severity(), text: f.to_string(), json }
}

/// A fault of a file as an entry.
pub fn syntax(e: &ReadError) -> Entry {
    let line = (e.line > 0).then_some(e.line);
    let message = if e.element.is_empty() { e.problem.clone() } else { format!("{}: {}", e.element, e.problem) };
    let column = (e.column > 0).then_some(e.column);
    let json = json!({
        "severity": "error", "kind": "syntax", "part": e.part, "elements": [], "coordinates": [],
        "line": line, "lines": Vec::from_iter(line), "column": column, "message": message, "fix": e.fix,
    });
    Entry { severity: Severity::Error, text: format!("error: {e}"), json }
}

/// Says what a reader did or left out.
pub fn tell_notes(notes: &[Note]) {
    notes.iter().for_each(|n| talk(note(n).text));
}

/// A reader's note as an entry.
pub fn note(n: &Note) -> Entry {
    let (severity, name) = match n.kind {
        NoteKind::Repair => (Severity::Repair, "repair"),
        NoteKind::Note => (Severity::Note, "note"),
    };
    let line = (n.line > 0).then_some(n.line);
    let place = line.map_or(String::new(), |l| format!(" (line {l})"));
    let json = json!({
        "severity": name, "kind": "format", "elements": [], "coordinates": [], "line": line, "lines": Vec::from_iter(line),
        "message": n.text, "fix": "none needed",
    });
    Entry { severity, text: format!("{name}: {}{place}", n.text), json }
}
