//! `verify`: the verdict of the checker on a trace, and the digests.

use super::args::VerifyArgs;
use super::files::open;
use super::input::load;
use super::{Answer, Failure, Status, data, space, talk};
use crate::check::spacing::{Count, Kind, Row, Spacing, Violation};
use crate::check::{Checker, Options, Verdict};
use crate::model::words::counted;
use crate::model::{Fill, Pslg, Segment, WeightedPoint};
use crate::trace::{DecodeError, Header, Reader, Record, Record3};
use serde_json::json;
use std::time::Instant;

/// Why a trace is rejected.
struct Rejection {
    event: String,
    rule: String,
    expected: String,
    found: String,
}

/// Verifies a trace. Exit code 1 if it is rejected, or under `--strict` a fact is left unchecked.
pub fn run(args: &VerifyArgs) -> Answer {
    let begun = Instant::now();
    let input = match &args.input {
        None => None,
        Some(path) if space::is_spatial(path)? => match space::points(path, &args.column, args.json)? {
            Some(points) => Some(Input::Space(points)),
            None => return Ok(Status::Refused),
        },
        Some(path) => {
            let loaded = load(path, None)?;
            if loaded.refused() {
                loaded.tell_refusal(path, args.json)?;
                return Ok(Status::Refused);
            }
            Some(Input::Plane(Box::new(loaded.prepared.pslg)))
        }
    };
    let mut reader = Reader::new(open(&args.trace)?);
    let mut judge = Judge {
        checker: Checker::new(Options { strict: args.strict, digests: !args.no_digest }),
        spacing: args.spacing.then(Spacing::new),
        input,
        stated: Pslg::default(),
        stated3: Vec::new(),
        points: 0,
        simplices: 0,
    };
    let mut rejection = None;
    while let Some(record) = reader.next() {
        let judged = match record {
            Ok(record) => judge.record(&record).and_then(|()| match &record {
                record if !args.no_digest && record.trace_digest().is_some_and(|d| d != reader.digest()) => {
                    Err(Rejection {
                        event: "end".into(),
                        rule: "Digest".into(),
                        expected: reader.digest(),
                        found: record.trace_digest().unwrap_or_default().to_string(),
                    })
                }
                _ => Ok(()),
            }),
            Err(DecodeError::Io(e)) => return Err(Failure::at(&args.trace, e)),
            Err(e) => {
                let event = reader.part().map_or_else(|| format!("event {}", reader.events()), str::to_string);
                Err(undecodable(event, &e))
            }
        };
        if let Err(r) = judged {
            rejection = Some(r);
            break;
        }
    }
    match rejection {
        Some(r) => reject(args, &r, begun.elapsed().as_secs_f64()),
        None => judge.finish(args, begun),
    }
}

/// What looks at each record.
struct Judge {
    checker: Checker,
    spacing: Option<Spacing>,
    input: Option<Input>,
    /// The domain that the trace states, kept only to be compared with an input.
    stated: Pslg,
    /// Points of space as the trace states them, with their places in the input.
    stated3: Vec<(u32, WeightedPoint)>,
    /// Points of space and simplices of the start, to be told.
    points: u64,
    simplices: u64,
}

/// What a trace is to be of.
enum Input {
    Plane(Box<Pslg>),
    Space(Vec<WeightedPoint>),
}

impl Judge {
    fn record(&mut self, record: &Record) -> Result<(), Rejection> {
        if self.input.is_some() {
            self.compare(record)?;
        }
        match record {
            Record::Space(Record3::Vertex { .. }) => self.points += 1,
            Record::Space(Record3::Simplex(_)) => self.simplices += 1,
            Record::Space(Record3::Header(_)) if self.spacing.take().is_some() => {
                talk("note: --spacing has nothing to prove of points in space");
            }
            _ => {}
        }
        self.checker.push(record).map_err(|r| Rejection {
            event: r.event.to_string(),
            rule: r.rule.to_string(),
            expected: r.expected.clone(),
            found: r.found.clone(),
        })?;
        match &mut self.spacing {
            Some(spacing) => spacing.record(record).map_err(|v| violation(v, place(record))),
            None => Ok(()),
        }
    }

    /// Gathers the domain and compares it with the input where `start` ends it.
    fn compare(&mut self, record: &Record) -> Result<(), Rejection> {
        match record {
            Record::Header(Header { fill, .. }) => self.stated.fill = *fill,
            Record::Vertex { at, marker, attributes } => {
                self.stated.points.push(*at);
                self.stated.point_markers.extend(marker);
                self.stated.attributes.extend(attributes);
            }
            Record::Segment(segment) => self.stated.segments.push(*segment),
            Record::Hole(hole) => self.stated.holes.push(*hole),
            Record::Region(region) => self.stated.regions.push(*region),
            Record::Start { .. } => {
                let what = match self.input.take() {
                    Some(Input::Plane(input)) => difference(&input, &self.stated),
                    Some(Input::Space(_)) => Some("points"),
                    None => None,
                };
                return what.map_or(Ok(()), |what| Err(other_input(what)));
            }
            Record::Space(Record3::Vertex { point, input }) => {
                let place = input.unwrap_or(self.stated3.len() as u32);
                self.stated3.push((place, *point));
            }
            Record::Space(Record3::Weight { .. } | Record3::Remove { .. }) if self.input.is_some() => {
                return Err(other_input("points, one of which the trace changes or removes"));
            }
            Record::Space(Record3::End(_)) => {
                self.stated3.sort_by_key(|s| s.0);
                let same = match &self.input {
                    Some(Input::Space(points)) => points.iter().eq(self.stated3.iter().map(|s| &s.1)),
                    Some(Input::Plane(_)) => false,
                    None => true,
                };
                return if same { Ok(()) } else { Err(other_input("points")) };
            }
            Record::Triangle(_) | Record::Event(_) | Record::End(_) | Record::Space(_) => {}
        }
        Ok(())
    }

    fn finish(mut self, args: &VerifyArgs, begun: Instant) -> Answer {
        if let Some(spacing) = &mut self.spacing
            && let Err(v) = spacing.finish(self.checker.smallest_angle(), self.checker.edges())
        {
            return reject(args, &violation(v, Some("end")), begun.elapsed().as_secs_f64());
        }
        let spacing = self.spacing.as_ref().map(Spacing::report);
        let undecided: u64 = spacing.map_or(0, |r| r.rows.values().map(|c| c.undecided).sum());
        let (events, unchecked) = match self.checker.finish() {
            Verdict::Accepted { events, unchecked } => (events, unchecked),
            Verdict::Rejected(r) => {
                let (event, rule) = (r.event.to_string(), r.rule.to_string());
                return reject(
                    args,
                    &Rejection { event, rule, expected: r.expected, found: r.found },
                    begun.elapsed().as_secs_f64(),
                );
            }
        };
        let seconds = begun.elapsed().as_secs_f64();
        if args.json {
            let unchecked: Vec<_> =
                unchecked.iter().map(|u| json!({"rule": u.rule.to_string(), "reason": u.reason})).collect();
            let mut value =
                json!({"verdict": "accepted", "events": events, "unchecked": unchecked, "seconds": seconds});
            if self.points > 0 {
                value["points"] = self.points.into();
                value["simplices_at_start"] = self.simplices.into();
            }
            if let Some(report) = spacing {
                let row = |(row, c): (&Row, &Count)| {
                    (row.to_string(), json!({"held": c.held, "undecided": c.undecided, "unclaimed": c.unclaimed}))
                };
                let density = |(kind, d): (&Kind, &f64)| (format!("{kind:?}").to_lowercase(), json!(d));
                value["rows"] = report.rows.iter().map(row).collect::<serde_json::Map<_, _>>().into();
                value["densities"] = report.densities.iter().map(density).collect::<serde_json::Map<_, _>>().into();
            }
            data(value)?;
        } else {
            let start = if self.points == 0 {
                String::new()
            } else {
                let (points, simplices) = (counted(self.points, "point"), counted(self.simplices, "simplex"));
                format!(", {points}, {simplices} at the start")
            };
            data(format_args!("accepted: {}{start}", counted(events, "event")))?;
            for u in &unchecked {
                data(format_args!("unchecked: {}: {}", u.rule, u.reason))?;
            }
            for (row, c) in spacing.iter().flat_map(|r| &r.rows) {
                data(format_args!(
                    "row {row:<6} held {:>9}  undecided {:>4}  unclaimed {:>9}",
                    c.held, c.undecided, c.unclaimed
                ))?;
            }
            talk(format_args!("time      {seconds:.3} s"));
        }
        let open = !unchecked.is_empty() || undecided > 0;
        Ok(if args.strict && open { Status::No } else { Status::Well })
    }
}

fn other_input(what: &str) -> Rejection {
    Rejection {
        event: "input".into(),
        rule: "Input".into(),
        expected: format!("the {what} of the input"),
        found: "others".into(),
    }
}

/// What of the input the trace does not state, in one word. Under `convex` edges of the hull may follow the segments; the fill
/// itself is an option of `mesh`, not of the input.
fn difference(input: &Pslg, stated: &Pslg) -> Option<&'static str> {
    let bits = |list: &[crate::model::Point2]| -> Vec<[u64; 2]> {
        list.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
    };
    let convex = stated.fill == Fill::Convex;
    let own: &[Segment] = match stated.segments.get(..input.segments.len()) {
        Some(own) if convex => own,
        _ => &stated.segments,
    };
    // A parity input meshed whole keeps its segments, not what they toggle.
    let plain = |s: &Segment| (s.ends, s.marker, s.toggles && !convex);
    let equal_segments =
        own.len() == input.segments.len() && own.iter().map(plain).eq(input.segments.iter().map(plain));
    let checks = [
        ("vertices", bits(&input.points) == bits(&stated.points)),
        ("markers", input.point_markers == stated.point_markers),
        ("attributes", input.attributes == stated.attributes),
        ("segments", equal_segments),
        ("holes", bits(&input.holes) == bits(&stated.holes)),
        ("regions", input.regions == stated.regions),
        ("fill", convex || input.fill == stated.fill),
    ];
    checks.into_iter().find(|(_, equal)| !equal).map(|(what, _)| what)
}

fn undecodable(event: String, e: &DecodeError) -> Rejection {
    let rule = match e {
        DecodeError::Truncated(_) => "Truncated",
        _ => "Format",
    };
    Rejection { event, rule: rule.into(), expected: "a record in canonical form".into(), found: e.to_string() }
}

/// The part of a trace that a record belongs to, if it is no event.
fn place(record: &Record) -> Option<&'static str> {
    match record {
        Record::Header(_) => Some("header"),
        Record::Vertex { .. } | Record::Segment(_) | Record::Hole(_) | Record::Region(_) => Some("input"),
        Record::Start { .. } | Record::Triangle(_) => Some("start"),
        Record::Event(_) => None,
        Record::End(_) => Some("end"),
        Record::Space(record) => match record {
            Record3::Header(_) => Some("header"),
            Record3::Vertex { .. } | Record3::Weight { .. } | Record3::Remove { .. } => Some("input"),
            Record3::Start { .. } | Record3::Simplex(_) => Some("start"),
            Record3::Event(_) => None,
            Record3::End(_) => Some("end"),
        },
    }
}

fn violation(v: Violation, part: Option<&str>) -> Rejection {
    let event = part.map_or_else(|| v.event.map_or("start".into(), |i| format!("event {i}")), str::to_string);
    Rejection { event, rule: v.row.to_string(), expected: v.expected, found: v.found }
}

fn reject(args: &VerifyArgs, r: &Rejection, seconds: f64) -> Answer {
    if args.json {
        let number = r.event.strip_prefix("event ").and_then(|n| n.parse::<u64>().ok());
        let event = number.map_or(json!(r.event), |n| json!(n));
        data(json!({
            "verdict": "rejected", "event": event, "rule": r.rule, "expected": r.expected, "found": r.found,
            "events": number, "unchecked": [], "seconds": seconds,
        }))?;
    } else {
        data(format_args!("rejected: {}: rule {}: expected {}, found {}", r.event, r.rule, r.expected, r.found))?;
    }
    Ok(Status::No)
}
