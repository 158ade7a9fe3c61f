//! Where two traces first differ.

use super::grammar::State;
use super::record::{Record, Sink};
use super::stream::{DecodeError, Ledger, Reader};
use super::{binary, text};
use serde_json::Value;
use std::io::{self, BufRead};

/// The first difference of two traces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Divergence {
    /// Which record, from 0.
    pub record: u64,
    /// The number of the event, if the first trace has one there.
    pub event: Option<u64>,
    /// Which field, as a path in the text form (`why.t[1]`); empty if the records differ as wholes.
    pub field: String,
    /// What the first trace has there, as JSON; `nothing` if it has no such field or record.
    pub first: String,
    /// What the second has there.
    pub second: String,
    /// Both records as lines of the text form, without line feeds; empty for a trace that has ended.
    pub lines: [String; 2],
}

impl Divergence {
    /// What a difference in this field says of the two runs, in words.
    pub fn meaning(&self) -> &'static str {
        let top = self.field.split(['.', '[']).next().unwrap_or("");
        let deep = self.field.strip_prefix("why.").map(|f| f.split(['.', '[']).next().unwrap_or(""));
        match (top, deep) {
            ("", _) => "one run does something else altogether, or has ended",
            (
                "format" | "version" | "algorithm" | "parameters" | "level" | "fill" | "weighted" | "permuted"
                | "scale",
                _,
            ) => "the runs were asked for different things, or promise different things",
            (
                "vertex" | "segment" | "hole" | "region" | "marker" | "attributes" | "attribute" | "toggles"
                | "max_area" | "weight" | "input",
                _,
            ) if self.event.is_none() => "the inputs differ",
            ("start" | "triangle" | "simplex" | "apexes", _) => {
                "the initial triangulations differ: a predicate or a tie was decided differently"
            }
            ("why", Some("t" | "cause")) | ("t" | "cause" | "h", _) => {
                "another triangle was treated: the queues differ, or what is bad"
            }
            ("why", Some("type" | "parent")) => {
                "the same place was reached for another reason: visibility or encroachment differs"
            }
            ("why", Some("s")) => "another subsegment is in the way: the walk differs",
            ("why", Some("a")) | ("p", _) => "the point was constructed differently: a choice, or its rounding",
            ("why", _) => "the reasons of the step differ",
            ("destroyed" | "created" | "id" | "first" | "flood" | "cell" | "of" | "by", _) => {
                "the same step changes other simplices: a predicate or a tie was decided differently"
            }
            ("reason" | "apex", _) => "the same triangle is left for another reason",
            _ => "the ends differ",
        }
    }
}

impl std::fmt::Display for Divergence {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self.event {
            Some(i) => write!(f, "event {i}")?,
            None => write!(f, "record {}", self.record)?,
        }
        if !self.field.is_empty() {
            write!(f, ", `{}`", self.field)?;
        }
        write!(f, ": {} in the first, {} in the second", self.first, self.second)
    }
}

/// Compares the records of a second run, as they come, with the trace of a first one. The first difference ends the run with an error
/// of kind `Other`; `Comparing::divergence` then tells it. Digests of the trace are left out: equal bytes have equal ones.
pub struct Comparing<R: BufRead> {
    first: Reader<R>,
    second: Ledger,
    scratch: Vec<u8>,
    records: u64,
    divergence: Option<Divergence>,
}

impl<R: BufRead> Comparing<R> {
    /// Compares with the trace that `first` reads.
    pub fn new(first: Reader<R>) -> Self {
        Comparing { first, second: Ledger::default(), scratch: Vec::new(), records: 0, divergence: None }
    }

    /// The difference that ended the run.
    pub fn divergence(&self) -> Option<&Divergence> {
        self.divergence.as_ref()
    }

    /// How many records were equal.
    pub fn records(&self) -> u64 {
        self.records
    }
}

impl<R: BufRead> Sink for Comparing<R> {
    fn record(&mut self, record: &Record) -> io::Result<()> {
        let state = self.second.state.clone();
        self.second.pending.clear();
        self.second.enter(record).map_err(|why| io::Error::new(io::ErrorKind::InvalidInput, why))?;
        let expected = self.first.next().transpose().map_err(|e| io::Error::new(io::ErrorKind::InvalidData, e))?;
        if let Some(expected) = &expected {
            self.scratch.clear();
            binary::encode(expected, &state, &mut self.scratch);
            if self.scratch == self.second.pending {
                self.records += 1;
                return Ok(());
            }
        }
        self.divergence = Some(locate(self.records, expected.as_ref(), Some(record), &state));
        Err(io::Error::other("the runs diverge"))
    }
}

/// The first difference of two traces, `None` if they have the same content (their forms may differ).
///
/// Errors: that of reading the first trace (0) or the second (1).
pub fn first_divergence<R: BufRead, S: BufRead>(
    mut first: Reader<R>,
    mut second: Reader<S>,
) -> Result<Option<Divergence>, (usize, DecodeError)> {
    let mut state = State::default();
    let (mut a_bytes, mut b_bytes) = (Vec::new(), Vec::new());
    let mut number = 0;
    loop {
        let a = first.next().transpose().map_err(|e| (0, e))?;
        let b = second.next().transpose().map_err(|e| (1, e))?;
        let (Some(x), Some(y)) = (&a, &b) else {
            let equal = a.is_none() && b.is_none();
            return Ok((!equal).then(|| locate(number, a.as_ref(), b.as_ref(), &state)));
        };
        a_bytes.clear();
        b_bytes.clear();
        binary::encode(x, &state, &mut a_bytes);
        binary::encode(y, &state, &mut b_bytes);
        let digests_differ = x.trace_digest() != y.trace_digest();
        if a_bytes != b_bytes || digests_differ {
            return Ok(Some(locate(number, a.as_ref(), b.as_ref(), &state)));
        }
        state.advance(x);
        number += 1;
    }
}

fn locate(record: u64, first: Option<&Record>, second: Option<&Record>, state: &State) -> Divergence {
    let lines = [first, second].map(|record| {
        let mut line = String::new();
        record.iter().for_each(|record| text::encode(record, state, &mut line));
        line.trim_end().to_string()
    });
    // Our own encoder writes JSON; an ended trace has no line.
    let [a, b] = [&lines[0], &lines[1]].map(|line| serde_json::from_str::<Value>(line).ok());
    let mut path = String::new();
    let (x, y) = descend(a.as_ref(), b.as_ref(), &mut path);
    let show = |v: Option<&Value>| v.map_or_else(|| "nothing".to_string(), Value::to_string);
    let event = first.is_some_and(Record::is_event).then_some(state.events);
    Divergence { record, event, field: path, first: show(x), second: show(y), lines }
}

/// Walks down to the first field that differs, in the order of keys.
fn descend<'a>(
    mut a: Option<&'a Value>,
    mut b: Option<&'a Value>,
    path: &mut String,
) -> (Option<&'a Value>, Option<&'a Value>) {
    loop {
        match (a, b) {
            (Some(Value::Object(x)), Some(Value::Object(y))) if x.get("event") == y.get("event") => {
                let mut keys: Vec<&String> = x.keys().chain(y.keys()).collect();
                // Seldom-long lists of short keys; a reader wants the cause of a difference first.
                keys.sort_by_key(|k| (k.as_str() != "type", k.as_str() != "why", k.as_str().to_owned()));
                let Some(key) = keys.into_iter().find(|k| x.get(*k) != y.get(*k)) else {
                    return (a, b);
                };
                if !path.is_empty() {
                    path.push('.');
                }
                path.push_str(key);
                (a, b) = (x.get(key), y.get(key));
            }
            (Some(Value::Array(x)), Some(Value::Array(y))) => {
                let Some(i) = (0..x.len().max(y.len())).find(|&i| x.get(i) != y.get(i)) else {
                    return (a, b);
                };
                path.push_str(&format!("[{i}]"));
                (a, b) = (x.get(i), y.get(i));
            }
            _ => return (a, b),
        }
    }
}
