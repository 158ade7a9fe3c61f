//! What stops a run from outside, and what is seen of it meanwhile.

use super::talk;
use crate::model::Level;
use crate::trace::{Algorithm, Header, Record, Sink};
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C asks the run to stop instead of ending the program.
pub fn catch_interrupts() {
    // Fails only if called twice or without signals; then Ctrl-C ends the program, and files still appear whole or not at all.
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed));
}

/// The reason to stop, asked now and then by a run; counts how often it was asked, so that a second run can stop at the same place.
#[derive(Debug)]
pub struct Limit {
    when: When,
    asked: u64,
    given: Option<String>,
}

/// When a limit says stop.
#[derive(Debug)]
enum When {
    /// At an interrupt, or at a time if there is one: the budget of so many seconds.
    Clock(Option<Instant>, f64),
    /// The so-manieth time that it is asked, for this reason.
    Script(u64, String),
    Never,
}

impl Limit {
    /// Stops after so many seconds, if given, and at an interrupt. Seconds beyond what a clock can hold never pass.
    pub fn new(seconds: Option<f64>) -> Self {
        let span = seconds.and_then(|s| Duration::try_from_secs_f64(s.max(0.0)).ok());
        let deadline = span.and_then(|span| Instant::now().checked_add(span));
        Limit { when: When::Clock(deadline, seconds.unwrap_or(0.0)), asked: 0, given: None }
    }

    /// A limit that stops where this one did, for its reason, and nowhere else.
    pub fn again(&self) -> Self {
        let when = self.given.clone().map_or(When::Never, |reason| When::Script(self.asked, reason));
        Limit { when, asked: 0, given: None }
    }

    /// Answers a run.
    pub fn ask(&mut self) -> Option<String> {
        self.asked += 1;
        let reason = match &self.when {
            When::Clock(..) if INTERRUPTED.load(Ordering::Relaxed) => "interrupted".into(),
            When::Clock(Some(deadline), seconds) if Instant::now() >= *deadline => {
                format!("the budget of {seconds} seconds is spent")
            }
            When::Script(at, reason) if self.asked == *at => reason.clone(),
            _ => return None,
        };
        self.given = Some(reason.clone());
        Some(reason)
    }
}

/// Passes records on; tells the promise when the header comes by, and on a terminal how far the run is.
pub struct Watched<'a> {
    inner: &'a mut dyn Sink,
    progress: bool,
    events: u64,
    shown: Instant,
}

impl<'a> Watched<'a> {
    /// Watches what goes into `inner`.
    pub fn new(inner: &'a mut dyn Sink) -> Self {
        Watched { inner, progress: io::stderr().is_terminal(), events: 0, shown: Instant::now() }
    }

    fn show(&mut self) {
        if self.progress && self.shown.elapsed() > Duration::from_millis(200) {
            self.shown = Instant::now();
            let _ = write!(io::stderr(), "\r{:>12} steps", self.events);
        }
    }
}

impl Sink for Watched<'_> {
    fn record(&mut self, record: &Record) -> io::Result<()> {
        match record {
            Record::Header(header) => {
                if let Some(line) = promise(header) {
                    talk(line);
                }
            }
            Record::Event(_) => {
                self.events += 1;
                if self.events.is_multiple_of(1024) {
                    self.show();
                }
            }
            Record::End(_) if self.progress => {
                let _ = write!(io::stderr(), "\r                    \r");
            }
            _ => {}
        }
        self.inner.record(record)
    }
}

/// What a run promises, in words.
fn promise(header: &Header) -> Option<String> {
    let Algorithm::Gcdr(parameters) = &header.algorithm else {
        return None;
    };
    Some(match header.level? {
        Level::Graded => "promise   graded: the run ends by itself, and edge lengths follow the local feature size".into(),
        Level::Admissible => {
            "promise   admissible: the bounds of every step hold; that the run ends is not proven, a budget of steps is set".into()
        }
        Level::Outside => format!("promise   outside the theorem: {}", super::report::why_outside(parameters)),
    })
}
