//! Traces that are not what the refiner wrote: the checker must find out.

use super::refinement::{GcdrCase, spacing_of, written};
use crate::check::{Options, Verdict, verify};
use crate::generators::{Bytes, Draw};
use crate::model::{Level, Point2, SegmentId, Triangle, VertexId};
use crate::trace::{Cause, Counts, End, Event, Format, Outcome, Reader, Record, Shell, SkipReason, SplitKind, Why};
use arbitrary::{Arbitrary, Result, Unstructured};

/// A run, and the draws that change its trace.
#[derive(Clone, Debug, PartialEq)]
pub struct MutatedTraceCase {
    /// The draws.
    pub edits: [u8; EDIT_BYTES],
    /// The run.
    pub origin: GcdrCase,
}

/// Bytes that decide on the change.
const EDIT_BYTES: usize = 24;

impl<'a> Arbitrary<'a> for MutatedTraceCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let edits = u.arbitrary()?;
        let mut origin = GcdrCase::arbitrary(u)?;
        origin.steps = origin.steps.min(40);
        Ok(MutatedTraceCase { edits, origin })
    }
}

impl MutatedTraceCase {
    /// Asserts that no changed trace is accepted where it must not be. Nothing happens where the input is refused.
    pub fn run(&self) {
        let Some(trace) = self.origin.trace() else {
            return;
        };
        let draw = &mut Bytes(&self.edits);
        match draw.below(4) {
            0 | 1 => {
                let mut changed = trace.clone();
                rearrange(&mut changed, draw, |record, draw| change(record, draw));
                self.assert_found_out(&trace, &changed);
            }
            2 => self.change_bytes(&trace, Format::Binary, draw),
            _ => self.change_bytes(&trace, Format::Text, draw),
        }
    }

    /// Changes some bytes of the written trace. With digests no changed byte passes; without them no changed event does.
    fn change_bytes(&self, trace: &[Record], format: Format, draw: &mut Bytes) {
        let original = written(trace, format);
        let mut bytes = original.clone();
        change_bytes(&mut bytes, draw);
        let mut reader = Reader::new(&bytes[..]);
        let changed: Vec<Record> = reader.by_ref().map_while(std::result::Result::ok).collect();
        let sealed = matches!(changed.last(), Some(Record::End(end)) if end.trace == reader.digest());
        if bytes != original && sealed {
            let plain = verify(&changed, Options::default());
            assert!(matches!(plain, Verdict::Rejected(_)), "digests let pass {changed:?} of {self:?}");
        }
        self.assert_found_out(trace, &changed);
    }

    /// Without digests: what differs in its events, its start or its end is rejected; of the rest nothing is claimed but a verdict.
    fn assert_found_out(&self, original: &[Record], changed: &[Record]) {
        let options = |strict| Options { strict, digests: false };
        let _ = verify(changed, options(false));
        let _ = spacing_of(changed);
        let verdict = verify(changed, options(true));
        // As text: 0 and -0 differ, and a number that is none equals itself.
        let input = |records: &[Record]| -> Vec<String> {
            let inputs = records.iter().take_while(|r| belongs_to_input(r));
            inputs.map(|r| format!("{r:?}")).collect()
        };
        let claims = |records: &[Record]| -> Vec<String> {
            let claims = records.iter().filter(|r| !belongs_to_input(r));
            claims.map(|r| format!("{:?}", unsealed(r))).collect()
        };
        let same_input = input(original) == input(changed);
        if same_input && claims(original) != claims(changed) {
            let text = |r: Option<&Record>| format!("{r:?}");
            let differs = (0..).find(|&k| text(original.get(k)) != text(changed.get(k)));
            assert!(
                matches!(verdict, Verdict::Rejected(_)),
                "accepted: record {differs:?} is {:?}, was {:?}, of {self:?}",
                differs.map(|k| changed.get(k)),
                differs.map(|k| original.get(k))
            );
        } else if same_input {
            assert!(matches!(verdict, Verdict::Accepted { .. }), "a true trace: {verdict:?} of {self:?}");
        }
    }
}

/// Header and domain, which digests alone bind.
fn belongs_to_input(record: &Record) -> bool {
    matches!(
        record,
        Record::Header(_) | Record::Vertex { .. } | Record::Segment(_) | Record::Hole(_) | Record::Region(_)
    )
}

/// A record without what digests alone bind.
fn unsealed(record: &Record) -> Record {
    match record {
        Record::End(end) => {
            Record::End(End { stop_reason: None, mesh: String::new(), trace: String::new(), ..end.clone() })
        }
        other => other.clone(),
    }
}

/// Changes up to three bytes.
pub(super) fn change_bytes(bytes: &mut Vec<u8>, draw: &mut Bytes) {
    for _ in 0..=draw.below(3) {
        let at = draw.take(4) as usize % bytes.len();
        let value = draw.take(1) as u8;
        match draw.below(8) {
            0 => bytes.insert(at, value),
            1 if bytes.len() > 1 => drop(bytes.remove(at)),
            2 if at > 0 => bytes.truncate(at),
            3 => bytes[at] ^= 1 << (value & 7),
            4 => bytes[at] = bytes[at].wrapping_add(1),
            5 => bytes[at] = bytes[at].wrapping_sub(1),
            _ => bytes[at] = value,
        }
    }
}

/// Changes one record, or the order of records.
pub(super) fn rearrange(records: &mut Vec<Record>, draw: &mut Bytes, change: impl Fn(&mut Record, &mut Bytes)) {
    let any = |draw: &mut dyn FnMut() -> u64, n: usize| draw() as usize % n.max(1);
    let events: Vec<usize> = (0..records.len()).filter(|&k| records[k].is_event()).collect();
    // Mostly events.
    let at = if events.is_empty() || draw.below(8) == 0 {
        any(&mut || draw.take(4), records.len())
    } else {
        events[any(&mut || draw.take(4), events.len())]
    };
    match draw.below(12) {
        0 => drop(records.remove(at)),
        1 => records.insert(at, records[at].clone()),
        2 if at + 1 < records.len() => records.swap(at, at + 1),
        3 => records.truncate(at),
        4 => {
            let moved = records.remove(at);
            let to = any(&mut || draw.take(4), records.len() + 1);
            records.insert(to, moved);
        }
        _ => change(&mut records[at], draw),
    }
}

/// Changes a field of a record. Every field can be reached; a change may leave its value.
fn change(record: &mut Record, draw: &mut impl Draw) {
    match record {
        Record::Header(header) => match draw.below(3) {
            0 => header.level = level(draw),
            _ => {
                if let crate::trace::Algorithm::Gcdr(p) = &mut header.algorithm {
                    match draw.below(6) {
                        0 => number(&mut p.rho2, draw),
                        1 => number(&mut p.d1, draw),
                        2 => number(&mut p.d2, draw),
                        3 => number(&mut p.mu, draw),
                        4 => p.kappa = draw.coin().then(|| draw.signed_unit()),
                        _ => p.max_area = draw.coin().then(|| draw.signed_unit()),
                    }
                }
            }
        },
        Record::Vertex { at, .. } => place(at, draw),
        Record::Segment(segment) => id(&mut segment.ends[draw.below(2) as usize], draw),
        Record::Hole(at) => place(at, draw),
        Record::Region(region) => place(&mut region.seed, draw),
        Record::Start { triangles } => *triangles = draw.below(64),
        // Traces of space are changed by `mutations3`.
        Record::Space(_) => {}
        Record::Triangle(t) => triangle(t, draw),
        Record::Event(event) => change_event(event, draw),
        Record::End(end) => match draw.below(4) {
            0 => end.outcome = [Outcome::Complete, Outcome::Holey, Outcome::Stopped][draw.below(3) as usize],
            1 => end.level_effective = level(draw),
            _ => count(&mut end.counts, draw),
        },
    }
}

fn change_event(event: &mut Event, draw: &mut impl Draw) {
    match event {
        Event::Insert { p, why, destroyed } => match draw.below(3) {
            0 => place(p, draw),
            1 => triangles(destroyed, draw),
            _ => change_why(why, draw),
        },
        Event::Remove { id: v, created } => match draw.coin() {
            true => id(v, draw),
            false => triangles(created, draw),
        },
        Event::Skip { t, cause: why, reason } => match draw.below(3) {
            0 => triangle(t, draw),
            1 => *why = cause(draw),
            _ => {
                *reason = match draw.below(3) {
                    0 => SkipReason::Resolution,
                    1 => SkipReason::InputAngle { apex: small_id(draw) },
                    _ => SkipReason::SplitLimit { segment: SegmentId(draw.below(40)) },
                }
            }
        },
    }
}

fn change_why(why: &mut Why, draw: &mut impl Draw) {
    match why {
        Why::Free { cause: c } => match draw.below(4) {
            0 => {
                *why = Why::Split {
                    kind: SplitKind::B,
                    s: [small_id(draw), small_id(draw)],
                    t: [small_id(draw), small_id(draw), small_id(draw)],
                    cause: *c,
                    a: Point2::new(draw.signed_unit(), draw.signed_unit()),
                    shell: None,
                }
            }
            _ => *c = cause(draw),
        },
        Why::Split { kind, s, t, cause: c, a, shell } => match draw.below(7) {
            0 => {
                *kind = match draw.coin() {
                    true => SplitKind::B,
                    false => SplitKind::C { parent: small_id(draw) },
                }
            }
            1 => id(&mut s[draw.below(2) as usize], draw),
            2 => triangle(t, draw),
            3 => *c = cause(draw),
            4 => place(a, draw),
            5 => {
                *shell = (draw.below(3) > 0)
                    .then(|| Shell { apex: small_id(draw), k: shell.map_or(0, |s| s.k) + draw.integer(-2, 2) })
            }
            _ => *why = Why::Free { cause: *c },
        },
    }
}

fn cause(draw: &mut impl Draw) -> Cause {
    match draw.below(3) {
        0 => Cause::Skinny,
        1 => Cause::Area,
        _ => Cause::Size { h: [1.0, 0.0, -1.0, f64::INFINITY, f64::NAN, 1e-3][draw.below(6) as usize] },
    }
}

fn level(draw: &mut impl Draw) -> Option<Level> {
    [None, Some(Level::Outside), Some(Level::Admissible), Some(Level::Graded)][draw.below(4) as usize]
}

fn small_id(draw: &mut impl Draw) -> VertexId {
    VertexId(draw.below(64))
}

fn id(v: &mut VertexId, draw: &mut impl Draw) {
    v.0 = match draw.below(6) {
        0 => v.0.wrapping_add(1),
        1 => v.0.wrapping_sub(1),
        2 => u32::MAX,
        _ => draw.below(64),
    };
}

fn triangle(t: &mut Triangle, draw: &mut impl Draw) {
    match draw.below(4) {
        0 => t.swap(1, 2),
        1 => t.rotate_left(1),
        _ => id(&mut t[draw.below(3) as usize], draw),
    }
}

fn triangles(list: &mut Vec<Triangle>, draw: &mut impl Draw) {
    let at = draw.take(2) as usize % list.len().max(1);
    match draw.below(6) {
        0 if !list.is_empty() => drop(list.remove(at)),
        1 if !list.is_empty() => list.insert(at, list[at]),
        2 => list.reverse(),
        3 if at + 1 < list.len() => list.swap(at, at + 1),
        4 => list.push([small_id(draw), small_id(draw), small_id(draw)]),
        _ => {
            if let Some(t) = list.get_mut(at) {
                triangle(t, draw);
            }
        }
    }
}

pub(super) fn place(p: &mut Point2, draw: &mut impl Draw) {
    match draw.below(8) {
        0 => *p = -*p,
        1 => *p = Point2::new(p.y, p.x),
        2 | 3 => number(&mut p.x, draw),
        4 | 5 => number(&mut p.y, draw),
        6 => *p *= 2.0,
        _ => *p = Point2::new(draw.signed_unit(), draw.signed_unit()),
    }
}

pub(super) fn number(x: &mut f64, draw: &mut impl Draw) {
    *x = match draw.below(10) {
        0..=2 => x.next_up(),
        3..=5 => x.next_down(),
        6 => -*x,
        7 => [0.0, f64::NAN, f64::INFINITY, -0.0, f64::MAX, f64::MIN_POSITIVE, 1e300, 1.0][draw.below(8) as usize],
        8 => *x * 0.5,
        _ => *x + draw.signed_unit(),
    };
}

fn count(counts: &mut Counts, draw: &mut impl Draw) {
    let field = match draw.below(7) {
        0 => &mut counts.vertices,
        1 => &mut counts.triangles,
        2 => &mut counts.type_a,
        3 => &mut counts.type_b,
        4 => &mut counts.type_c,
        5 => &mut counts.removed,
        _ => &mut counts.unmet,
    };
    *field = match draw.below(3) {
        0 => field.wrapping_add(1),
        1 => field.wrapping_sub(1),
        _ => draw.below(100),
    };
}
