//! Traces of space that are not what was written: the checker must find out.

use super::mutations::{change_bytes, rearrange};
use crate::arith::FastKernel;
use crate::check::{Options, Verdict, verify};
use crate::generators::{Bytes, Draw, Edit, EditCase};
use crate::model::{PointSet3, VertexId, WeightedPoint};
use crate::refine::regular::{Certificate, Session, triangulate3};
use crate::trace::{Apex, Bits, Event3, Format, Reader, Record, Record3, Recorder, Sink, Writer};
use arbitrary::{Arbitrary, Result, Unstructured};

/// A triangulation or session, and the draws that change its trace.
#[derive(Clone, Debug, PartialEq)]
pub struct MutatedTrace3Case {
    /// The draws.
    pub edits: [u8; 24],
    /// The session; a triangulation is that of the points it inserts.
    pub origin: EditCase,
}

impl<'a> Arbitrary<'a> for MutatedTrace3Case {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(MutatedTrace3Case { edits: u.arbitrary()?, origin: EditCase::arbitrary(u)? })
    }
}

impl MutatedTrace3Case {
    /// Asserts that no changed trace is accepted where it must not be.
    pub fn run(&self) {
        let draw = &mut Bytes(&self.edits);
        let trace = match draw.below(3) {
            0 => self.session(),
            1 => self.triangulated(Certificate::Final),
            _ => self.triangulated(Certificate::Steps),
        };
        let Some(trace) = trace else { return };
        let mut changed = trace.clone();
        match draw.below(4) {
            0 | 1 => rearrange(&mut changed, draw, change),
            form => {
                let format = if form == 2 { Format::Binary } else { Format::Text };
                let original = written(&trace, format);
                let mut bytes = original.clone();
                change_bytes(&mut bytes, draw);
                let mut reader = Reader::new(&bytes[..]);
                changed = reader.by_ref().map_while(std::result::Result::ok).collect();
                let sealed = changed.last().and_then(Record::trace_digest) == Some(reader.digest().as_str());
                if bytes != original && sealed {
                    let plain = verify(&changed, Options::default());
                    assert!(matches!(plain, Verdict::Rejected(_)), "digests let pass {changed:?} of {self:?}");
                }
            }
        }
        self.assert_found_out(&trace, &changed);
    }

    /// Without digests: what differs in anything but the input and the digests is rejected; a true trace is accepted.
    fn assert_found_out(&self, original: &[Record], changed: &[Record]) {
        let options = |strict| Options { strict, digests: false };
        let _ = verify(changed, options(false));
        let verdict = verify(changed, options(true));
        // As text: 0 and -0 differ, and a number that is none equals itself.
        let all = |records: &[Record], input: bool| -> Vec<String> {
            records.iter().filter(|r| is_input(r) == input).map(unsealed).collect()
        };
        if all(original, true) != all(changed, true) {
            return;
        }
        if all(original, false) != all(changed, false) {
            assert!(matches!(verdict, Verdict::Rejected(_)), "accepted: {changed:?} of {self:?}");
        } else if original.iter().map(unsealed).eq(changed.iter().map(unsealed)) {
            assert!(matches!(verdict, Verdict::Accepted { .. }), "a true trace: {verdict:?} of {self:?}");
        }
    }

    fn triangulated(&self, certificate: Certificate) -> Option<Vec<Record>> {
        let points: Vec<WeightedPoint> = self.origin.edits.iter().filter_map(inserted).collect();
        let weights = points.iter().map(|p| p.weight).collect();
        let set = PointSet3 { points: points.iter().map(|p| p.at).collect(), weights, ..PointSet3::default() };
        let mut recorder = Recorder::default();
        triangulate3::<FastKernel>(&set, certificate, 1, &mut recorder).ok()?;
        Some(recorder.0)
    }

    fn session(&self) -> Option<Vec<Record>> {
        let points = self.origin.edits.iter().filter_map(inserted);
        let largest = points.fold(0.0f64, |m, p| m.max(p.at.abs().max_element()));
        let scale = crate::arith::scale::exponent_of(largest);
        let mut recorder = Recorder::default();
        let mut session = Session::<FastKernel>::new(scale, &mut recorder).ok()?;
        for edit in &self.origin.edits {
            let known = |v: u32| v < session.triangulation().point_count() as u32;
            // What is out of range changes nothing.
            match *edit {
                Edit::Insert(p) => drop(session.insert(p)),
                Edit::Remove(v) if known(v) => drop(session.remove(VertexId(v))),
                Edit::SetWeight(v, w) if known(v) => drop(session.set_weight(VertexId(v), w)),
                Edit::Remove(_) | Edit::SetWeight(..) => {}
            }
        }
        session.finish().ok()?;
        Some(recorder.0)
    }
}

fn inserted(edit: &Edit) -> Option<WeightedPoint> {
    match edit {
        Edit::Insert(p) => Some(*p),
        _ => None,
    }
}

fn written(trace: &[Record], format: Format) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), format);
    // The trace was written to a recorder before, and a vector takes all.
    trace.iter().for_each(|r| writer.record(r).expect("a record in order"));
    writer.finish().expect("a whole trace")
}

/// Header, points and what the caller did with them, which digests alone bind.
fn is_input(record: &Record) -> bool {
    let Record::Space(record) = record else { return false };
    matches!(record, Record3::Header(_) | Record3::Vertex { .. } | Record3::Weight { .. } | Record3::Remove { .. })
}

/// A record without what digests alone bind.
fn unsealed(record: &Record) -> String {
    match record {
        Record::Space(Record3::End(end)) => format!("{:?}", end.counts),
        other => format!("{other:?}"),
    }
}

/// Changes a field of a record. Every field can be reached; a change may leave its value.
fn change(record: &mut Record, draw: &mut Bytes) {
    let Record::Space(record) = record else { return };
    match record {
        Record3::Header(h) => match draw.below(3) {
            0 => h.weighted = !h.weighted,
            1 => h.permuted = !h.permuted,
            _ => h.scale = h.scale.wrapping_add(draw.integer(-2, 2)),
        },
        Record3::Vertex { point, input } => match draw.below(6) {
            0 => point.at.x = number(point.at.x, draw),
            1 => point.at.y = number(point.at.y, draw),
            2 => point.at.z = number(point.at.z, draw),
            3 => point.weight = number(point.weight, draw),
            _ => *input = draw.coin().then(|| draw.below(64)),
        },
        Record3::Weight { id: v, weight } => match draw.coin() {
            true => id(v, draw),
            false => *weight = number(*weight, draw),
        },
        Record3::Remove { id: v } => id(v, draw),
        Record3::Start { apexes: list, simplices } => match draw.coin() {
            true => apexes(list, draw),
            false => *simplices = draw.below(64),
        },
        Record3::Simplex(t) => tuple(t, draw),
        Record3::Event(event) => change_event(event, draw),
        Record3::End(end) => {
            let c = &mut end.counts;
            let all = [&mut c.vertices, &mut c.hidden, &mut c.duplicates, &mut c.removed, &mut c.simplices];
            for (k, n) in (0..).zip(all) {
                if k == draw.below(5) {
                    *n = n.wrapping_add(1);
                }
            }
        }
    }
}

fn change_event(event: &mut Event3, draw: &mut Bytes) {
    let v = VertexId(draw.below(64));
    if draw.below(8) == 0 {
        *event = match draw.below(5) {
            0 => Event3::Duplicate { id: v, of: VertexId(0) },
            1 => Event3::Remove { id: v, created: Vec::new() },
            2 => Event3::Raise { id: v, apexes: Vec::new() },
            3 => Event3::Lower { id: v, apexes: vec![Apex::ALL[4]] },
            _ => Event3::Succeed { id: v, by: VertexId(1) },
        };
        return;
    }
    match event {
        Event3::Insert { id: v, first, flood } => match draw.below(4) {
            0 => id(v, draw),
            1 => tuple(first, draw),
            _ => {
                let (at, kind) = (draw.below(64) % (flood.len() + 1), draw.below(4));
                let kept = flood.len().saturating_sub(u32::from(kind == 0));
                let bits = (0..kept).map(|k| (flood.get(k) == Some(true)) ^ (kind > 1 && k == at));
                *flood = bits.chain((kind == 1).then_some(draw.coin())).collect::<Bits>();
            }
        },
        Event3::Hide { id: v, cell } => match draw.coin() {
            true => id(v, draw),
            false => tuple(cell, draw),
        },
        Event3::Duplicate { id: v, of: w } | Event3::Succeed { id: v, by: w } => {
            id(if draw.coin() { v } else { w }, draw);
        }
        Event3::Remove { id: v, created } => match draw.below(4) {
            0 => id(v, draw),
            1 => drop(created.pop()),
            2 => created.push(VertexId(draw.below(64))),
            _ => {
                let at = draw.below(64) as usize % created.len().max(1);
                if let Some(w) = created.get_mut(at) {
                    id(w, draw);
                }
            }
        },
        Event3::Raise { id: v, apexes: list } | Event3::Lower { id: v, apexes: list } => match draw.coin() {
            true => id(v, draw),
            false => apexes(list, draw),
        },
    }
}

fn id(v: &mut VertexId, draw: &mut Bytes) {
    v.0 = match draw.below(6) {
        0 => v.0.wrapping_add(1),
        1 => v.0.wrapping_sub(1),
        2 => u32::MAX - draw.below(5),
        _ => draw.below(64),
    };
}

fn tuple(t: &mut [VertexId; 4], draw: &mut Bytes) {
    match draw.below(4) {
        0 => t.swap(2, 3),
        1 => t.rotate_left(1),
        _ => id(&mut t[draw.below(4) as usize], draw),
    }
}

fn apexes(list: &mut Vec<Apex>, draw: &mut Bytes) {
    let apex = Apex::ALL[draw.below(6) as usize];
    match draw.below(4) {
        0 => drop(list.pop()),
        1 => list.push(apex),
        _ => {
            if let Some(first) = list.first_mut() {
                *first = apex;
            }
        }
    }
}

fn number(x: f64, draw: &mut Bytes) -> f64 {
    match draw.below(7) {
        0 | 1 => x.next_up(),
        2 | 3 => x.next_down(),
        4 => -x,
        5 => [0.0, f64::NAN, f64::INFINITY, -0.0, f64::MAX, f64::MIN_POSITIVE, 1e300, 1.0][draw.below(8) as usize],
        _ => x + draw.signed_unit(),
    }
}
