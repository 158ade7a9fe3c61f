//! Top floor: the command line. Arguments, files, exit codes, and the choice of kernel; no geometry.
//!
//! Stdout is data, stderr is talk. Exit codes: 0 all well; 1 the answer is no; 2 wrong usage, unreadable or refused input, I/O; 3 a budget
//! or an interrupt stopped the run; 101 a bug. Files are written whole or not at all (`files`).

mod args;
mod check;
mod convert;
mod diff;
mod doctor;
mod files;
mod input;
mod mesh;
mod outputs;
mod parameters;
mod replay;
mod report;
mod reproduce;
mod space;
mod verify;
mod watch;

use args::{Arguments, Command};
use clap::Parser;
use serde_json::json;
use std::ffi::OsString;
use std::fmt;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// How a command that could do its work ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Status {
    /// All well.
    Well = 0,
    /// The answer is no.
    No = 1,
    /// The input was refused; what is wrong with it has been told.
    Refused = 2,
    /// A budget or an interrupt ended the run.
    Stopped = 3,
}

/// Why a command could not do its work: one sentence. Exit code 2.
#[derive(Debug)]
struct Failure(String);

impl Failure {
    fn new(sentence: impl fmt::Display) -> Self {
        Failure(sentence.to_string())
    }

    /// A failure about a file.
    fn at(path: &std::path::Path, problem: impl fmt::Display) -> Self {
        Failure(format!("{}: {problem}", path.display()))
    }
}

type Answer = Result<Status, Failure>;

/// Runs the program with the given arguments, the first being its name, and says with what code to exit.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(args) {
        Ok(arguments) => arguments,
        Err(e) => {
            // Help and version are data and well; what clap cannot print it cannot print.
            let _ = e.print();
            return ExitCode::from(if e.use_stderr() { 2 } else { 0 });
        }
    };
    match dispatch(&arguments.command) {
        Ok(status) => ExitCode::from(status as u8),
        Err(Failure(sentence)) => {
            talk(format_args!("orthoball: {sentence}"));
            if wants_json(&arguments.command) {
                let finding = json!({
                    "severity": "error", "kind": "failure", "elements": [], "coordinates": [], "line": null, "lines": [],
                    "message": sentence, "fix": null,
                });
                // A stdout that takes nothing is the failure, maybe.
                let _ = data(json!({"outcome": "refused", "findings": [finding]}));
            }
            ExitCode::from(2)
        }
    }
}

fn dispatch(command: &Command) -> Answer {
    match command {
        Command::Mesh(args) => mesh::run(args),
        Command::Triangulate(args) => mesh::triangulate(args),
        Command::Verify(args) => verify::run(args),
        Command::Replay(args) => replay::run(args),
        Command::Check(args) => check::run(args),
        Command::Doctor(args) => doctor::run(args),
        Command::Diff(args) => diff::run(args),
        Command::Convert(args) => convert::run(args),
        Command::Reproduce(args) => reproduce::run(args),
    }
}

fn wants_json(command: &Command) -> bool {
    match command {
        Command::Mesh(args) => args.out.json,
        Command::Triangulate(args) => args.out.json,
        Command::Verify(args) => args.json,
        Command::Check(args) => args.json,
        Command::Doctor(args) => args.json,
        Command::Diff(args) => args.json,
        Command::Reproduce(args) => args.json,
        Command::Replay(_) | Command::Convert(_) => false,
    }
}

/// A line on stderr. A closed stderr is no reason to fail.
fn talk(line: impl fmt::Display) {
    let _ = writeln!(std::io::stderr(), "{}", printable(line));
}

/// A line on stdout. Who has closed it has read enough, as `head` does.
fn data(line: impl fmt::Display) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", printable(line)).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::new(format_args!("stdout: {e}"))),
        _ => Ok(()),
    }
}

/// A text without characters that a terminal would obey, which files may hold and errors quote. They become escapes that JSON reads, too.
fn printable(text: impl fmt::Display) -> String {
    let obeyed = |c: char| c.is_control() && c != '\n' && c != '\t';
    let text = text.to_string();
    if !text.contains(obeyed) {
        return text;
    }
    // All control characters are below U+00A0.
    text.chars().map(|c| if obeyed(c) { format!("\\u{:04x}", u32::from(c)) } else { c.into() }).collect()
}
