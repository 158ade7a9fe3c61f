//! What strict verification without digests must refuse of a trace of space: every changed field of every event, simplices and events dropped,
//! doubled, swapped or cut off. Points and weights are input: a changed one is refused by the digest of the triangulation.
#![cfg(feature = "generators")]

use orthoball::arith::FastKernel;
use orthoball::audit::space::{Claim, Subject, audit};
use orthoball::check::{Checker, Options, Verdict};
use orthoball::generators::{Draw, Edit, SpaceFamily, SplitMix64, WeightFamily, edits, weighted_points};
use orthoball::model::{Point3, PointSet3, PointState, Triangulation3, VertexId, WeightedPoint};
use orthoball::refine::regular::{Certificate, Session, triangulate3};
use orthoball::trace::{Apex, Bits, Event3, INFINITE, Record, Record3, Recorder, apex_id};
use std::collections::BTreeMap;

const STRICT: Options = Options { strict: true, digests: false };

fn traces(points: &[WeightedPoint]) -> Vec<Vec<Record>> {
    let weights = points.iter().map(|p| p.weight).collect();
    let set = PointSet3 { points: points.iter().map(|p| p.at).collect(), weights, ..PointSet3::default() };
    let mut all = Vec::new();
    for certificate in [Certificate::Final, Certificate::Steps] {
        let mut recorder = Recorder::default();
        if triangulate3::<FastKernel>(&set, certificate, 1, &mut recorder).is_ok() {
            all.push(recorder.0);
        }
    }
    let mut recorder = Recorder::default();
    let mut session = Session::<FastKernel>::new(6, &mut recorder).expect("a recorder takes all");
    if points.iter().all(|p| session.insert(*p).is_ok()) && session.finish().is_ok() {
        all.push(recorder.0);
    }
    all
}

/// A session of insertions, removals and changes of weight; what is refused is left out.
fn edited(edits: &[Edit]) -> Vec<Record> {
    let mut recorder = Recorder::default();
    let mut session = Session::<FastKernel>::new(3, &mut recorder).expect("a recorder takes all");
    for edit in edits {
        let points = session.triangulation().point_count() as u32;
        match *edit {
            Edit::Insert(p) => drop(session.insert(p)),
            Edit::Remove(v) if v < points => session.remove(VertexId(v)).expect("a recorder takes all"),
            Edit::SetWeight(v, w) if v < points => drop(session.set_weight(VertexId(v), w)),
            Edit::Remove(_) | Edit::SetWeight(..) => {}
        }
    }
    session.finish().expect("a recorder takes all");
    recorder.0
}

/// True traces of every kind.
fn samples() -> Vec<Vec<Record>> {
    let mut samples = Vec::new();
    for (k, family) in SpaceFamily::ALL.into_iter().enumerate() {
        for (l, weights) in WeightFamily::ALL.into_iter().enumerate() {
            let n = [5, 9, 16, 24][(k + l) % 4];
            samples.extend(traces(&weighted_points(family, weights, n, &mut SplitMix64((31 * k + l) as u64))));
        }
    }
    for seed in 0..120u64 {
        let mut family = SpaceFamily::ALL[seed as usize % SpaceFamily::ALL.len()];
        let mut weights = WeightFamily::ALL[seed as usize / 2 % WeightFamily::ALL.len()];
        if seed >= 60 {
            (family, weights) = (SpaceFamily::Duplicates, WeightFamily::Zero);
        }
        let points = weighted_points(family, weights, 14, &mut SplitMix64(seed));
        let edits = edits(&points, 8, seed % 2 == 0, &mut SplitMix64(seed + 99));
        samples.push(edited(&edits));
    }
    samples.iter().for_each(|s| assert!(!refused(s, STRICT), "a sample is refused as it is"));
    samples
}

/// Whether the rest of a trace is refused by a checker that has accepted what precedes it.
fn refused_after(mut checker: Checker, rest: &[Record]) -> bool {
    rest.iter().any(|record| checker.push(record).is_err()) || matches!(checker.finish(), Verdict::Rejected(_))
}

/// What the caller gave.
fn is_input(record: &Record) -> bool {
    let Record::Space(record) = record else { return false };
    matches!(record, Record3::Header(_) | Record3::Vertex { .. } | Record3::Weight { .. } | Record3::Remove { .. })
}

fn refused(trace: &[Record], options: Options) -> bool {
    refused_after(Checker::new(options), trace)
}

/// The single-field changes of a record, with the names of the fields.
fn changes(record: &Record, points: u32) -> Vec<(&'static str, Record)> {
    let mut all = Vec::new();
    let mut add = |name: &'static str, changed: Record3| {
        let changed = Record::Space(changed);
        if changed != *record {
            all.push((name, changed));
        }
    };
    let others = |v: VertexId| [v.0.wrapping_add(1) % points, v.0.wrapping_sub(1).min(points - 1), 0].map(VertexId);
    let Record::Space(record3) = record else { return all };
    let tuples = |t: &[VertexId; 4]| {
        let mut list = Vec::new();
        for k in 0..4 {
            for other in others(t[k]).into_iter().chain([INFINITE, apex_id(0)]) {
                let mut changed = *t;
                changed[k] = other;
                list.push(changed);
            }
            let mut turned = *t;
            turned.swap(k, (k + 1) % 4);
            list.push(turned);
        }
        list
    };
    let apex_lists = |apexes: &Vec<Apex>| {
        let mut list = vec![apexes.iter().copied().chain([Apex::ALL[5]]).collect(), Vec::new()];
        for k in 0..apexes.len() {
            for other in Apex::ALL {
                let mut changed = apexes.clone();
                changed[k] = other;
                list.push(changed);
            }
        }
        list
    };
    match record3 {
        Record3::Start { apexes, simplices } => {
            add("start simplices", Record3::Start { apexes: apexes.clone(), simplices: simplices + 1 });
            add("start simplices", Record3::Start { apexes: apexes.clone(), simplices: simplices.saturating_sub(1) });
            for changed in apex_lists(apexes) {
                add("start apexes", Record3::Start { apexes: changed, simplices: *simplices });
            }
        }
        Record3::Simplex(t) => tuples(t).into_iter().for_each(|t| add("simplex", Record3::Simplex(t))),
        Record3::Event(event) => match event {
            Event3::Insert { id, first, flood } => {
                for id in others(*id) {
                    add("insert id", Record3::Event(Event3::Insert { id, first: *first, flood: flood.clone() }));
                }
                for first in tuples(first) {
                    add("insert first", Record3::Event(Event3::Insert { id: *id, first, flood: flood.clone() }));
                }
                let bits = |change: &dyn Fn(u32, bool) -> bool| -> Bits {
                    (0..flood.len()).map(|k| change(k, flood.get(k) == Some(true))).collect()
                };
                let with = |flood| Record3::Event(Event3::Insert { id: *id, first: *first, flood });
                (0..flood.len()).for_each(|j| add("insert flood", with(bits(&|k, b| b ^ (k == j)))));
                let whole = bits(&|_, b| b);
                let longer = |bit| -> Bits { (0..flood.len()).filter_map(|k| whole.get(k)).chain([bit]).collect() };
                add("insert flood longer", with(longer(false)));
                add("insert flood longer", with(longer(true)));
                let shorter = (1..flood.len()).filter_map(|k| whole.get(k - 1)).collect();
                add("insert flood shorter", with(shorter));
            }
            Event3::Hide { id, cell } => {
                others(*id).into_iter().for_each(|id| add("hide id", Record3::Event(Event3::Hide { id, cell: *cell })));
                tuples(cell)
                    .into_iter()
                    .for_each(|c| add("hide cell", Record3::Event(Event3::Hide { id: *id, cell: c })));
                add("hide instead", Record3::Event(Event3::Duplicate { id: *id, of: cell[0] }));
            }
            Event3::Duplicate { id, of } => {
                for other in others(*id) {
                    add("duplicate id", Record3::Event(Event3::Duplicate { id: other, of: *of }));
                }
                for other in others(*of) {
                    add("duplicate of", Record3::Event(Event3::Duplicate { id: *id, of: other }));
                }
            }
            Event3::Raise { id, apexes } => {
                for other in others(*id) {
                    add("raise id", Record3::Event(Event3::Raise { id: other, apexes: apexes.clone() }));
                }
                for apexes in apex_lists(apexes) {
                    add("raise apexes", Record3::Event(Event3::Raise { id: *id, apexes }));
                }
            }
            Event3::Remove { id, created } => {
                for other in others(*id) {
                    add("remove id", Record3::Event(Event3::Remove { id: other, created: created.clone() }));
                }
                for k in 0..created.len() {
                    for other in others(created[k]) {
                        let mut created = created.clone();
                        created[k] = other;
                        add("remove created", Record3::Event(Event3::Remove { id: *id, created }));
                    }
                    let mut fewer = created.clone();
                    fewer.remove(k);
                    add("remove created fewer", Record3::Event(Event3::Remove { id: *id, created: fewer }));
                }
            }
            Event3::Succeed { id, by } => {
                for other in others(*id) {
                    add("succeed id", Record3::Event(Event3::Succeed { id: other, by: *by }));
                    add("succeed by", Record3::Event(Event3::Succeed { id: *id, by: other }));
                }
            }
            Event3::Lower { id, apexes } => {
                for other in others(*id) {
                    add("lower id", Record3::Event(Event3::Lower { id: other, apexes: apexes.clone() }));
                }
                for apexes in apex_lists(apexes) {
                    add("lower apexes", Record3::Event(Event3::Lower { id: *id, apexes }));
                }
            }
        },
        Record3::End(end) => {
            for k in 0..5 {
                let mut end = end.clone();
                let c = &mut end.counts;
                *[&mut c.vertices, &mut c.hidden, &mut c.duplicates, &mut c.removed, &mut c.simplices][k] += 1;
                add("end counts", Record3::End(end));
            }
        }
        Record3::Header(_) | Record3::Vertex { .. } | Record3::Weight { .. } | Record3::Remove { .. } => {}
    }
    all
}

#[test]
fn every_changed_field_is_refused() {
    let mut tried = BTreeMap::new();
    for trace in samples() {
        let points = trace.iter().filter(|r| matches!(r, Record::Space(Record3::Vertex { .. }))).count() as u32;
        let mut checker = Checker::new(STRICT);
        for (at, record) in trace.iter().enumerate() {
            for (name, changed) in changes(record, points.max(1)) {
                let mut rest = trace[at..].to_vec();
                rest[0] = changed;
                assert!(refused_after(checker.clone(), &rest), "{name}: record {at} {record:?} as {:?}", rest[0]);
                *tried.entry(name).or_insert(0) += 1;
            }
            checker.push(record).expect("a true trace");
        }
    }
    println!("{tried:#?}");
    for name in [
        "start simplices",
        "start apexes",
        "simplex",
        "insert id",
        "insert first",
        "insert flood",
        "insert flood longer",
        "insert flood shorter",
        "hide id",
        "hide cell",
        "hide instead",
        "duplicate id",
        "duplicate of",
        "raise id",
        "raise apexes",
        "remove id",
        "remove created",
        "remove created fewer",
        "succeed id",
        "succeed by",
        "lower id",
        "lower apexes",
        "end counts",
    ] {
        assert!(tried.get(name).is_some_and(|n| *n >= 20), "{name} is hardly tried");
    }
}

#[test]
fn records_dropped_doubled_swapped_or_cut_off_are_refused() {
    let mut tried = 0;
    for trace in samples() {
        let mut checker = Checker::new(STRICT);
        for at in 0..trace.len() {
            let input = is_input(&trace[at]);
            if !input {
                let rest = &trace[at..];
                let doubled = [&rest[..1], rest].concat();
                let mut variants = vec![("dropped", rest[1..].to_vec()), ("doubled", doubled), ("cut off", Vec::new())];
                // A point may be stated earlier or later than it is placed.
                let next_is_input = rest.get(1).is_some_and(is_input);
                if rest.len() > 1 && !next_is_input {
                    let mut swapped = rest.to_vec();
                    swapped.swap(0, 1);
                    variants.push(("swapped", swapped));
                }
                for (what, rest) in variants {
                    assert!(
                        refused_after(checker.clone(), &rest),
                        "{what}: record {at}, {:#?}",
                        &trace[at.saturating_sub(3)..]
                    );
                    tried += 1;
                }
            }
            checker.push(&trace[at]).expect("a true trace");
        }
    }
    assert!(tried > 5_000, "{tried}");
}

/// One unit in the last place of a coordinate or weight, a place in the input: the digest binds them.
#[test]
fn changed_points_are_refused_by_the_digest() {
    let mut tried = 0;
    // A weight that is changed later is in no final triangulation.
    let final_weights = |t: &Vec<Record>| !t.iter().any(|r| matches!(r, Record::Space(Record3::Weight { .. })));
    for trace in samples().into_iter().filter(final_weights) {
        for at in 0..trace.len() {
            let Record::Space(Record3::Vertex { point, input }) = &trace[at] else { continue };
            let weighted = matches!(trace[0], Record::Space(Record3::Header(h)) if h.weighted);
            for k in 0..4 + usize::from(input.is_some()) {
                let (mut p, mut place) = (*point, *input);
                match k {
                    0 => p.at.x = p.at.x.next_up(),
                    1 => p.at.y = p.at.y.next_down(),
                    2 => p.at.z = p.at.z.next_up(),
                    3 if weighted => p.weight = p.weight.next_up(),
                    3 => continue,
                    _ => place = place.map(|k| k + 1),
                }
                let mut changed = trace.clone();
                changed[at] = Record::Space(Record3::Vertex { point: p, input: place });
                assert!(refused(&changed, Options { strict: false, digests: true }), "{:?}", changed[at]);
                tried += 1;
            }
        }
    }
    assert!(tried > 2_000, "{tried}");
}

/// Codes with a bit flipped or two, of all lengths nearby: one of them may be that of another cavity.
fn varied(flood: &Bits, draw: &mut SplitMix64) -> Vec<Bits> {
    let mut bits: Vec<bool> = (0..flood.len()).map(|k| flood.get(k) == Some(true)).collect();
    // What the last bits say changes no other facet's.
    let from = if draw.below(2) == 0 { 0 } else { flood.len().saturating_sub(7) };
    let flips: Vec<u32> = (0..=draw.below(2)).map(|_| from + draw.below(flood.len() - from)).collect();
    flips.into_iter().for_each(|k| bits[k as usize] ^= true);
    let lengths = bits.len().saturating_sub(8).max(1)..bits.len() + 9;
    lengths.map(|n| bits.iter().copied().chain(std::iter::repeat(false)).take(n).collect()).collect()
}

/// Whether the audit, which looks at the finished mesh alone, finds the triangulation of the points placed so far to be one.
fn is_sound(t: &Triangulation3) -> bool {
    let placed: Vec<usize> = (0..t.points.len()).filter(|&k| t.states[k] != PointState::Removed).collect();
    let points: Vec<Point3> = placed.iter().map(|&k| t.points[k].at).collect();
    let weights: Vec<f64> = placed.iter().map(|&k| t.points[k].weight).collect();
    // Vertices of cells are placed.
    let renamed = |v: VertexId| VertexId(placed.binary_search(&v.index()).expect("a point placed") as u32);
    let cells: Vec<[VertexId; 4]> = t.simplices().map(|s| [0, 1, 2, 3].map(|k| renamed(s[k]))).collect();
    let claims = [Claim::Valid, Claim::Orientation, Claim::Regular, Claim::Hull];
    let subject = Subject { points: &points, weights: &weights, cells: &cells, ..Subject::default() };
    let report = audit(&subject, &orthoball::audit::space::Options { claims: &claims, radius_edge: None });
    let in_cells = |v: usize| t.simplices.contains(&VertexId(v as u32));
    let states = placed.iter().all(|&k| (t.states[k] == PointState::Vertex) == in_cells(k));
    states && report.claims.iter().all(|c| c.verdict == orthoball::audit::Verdict::Holds)
}

/// Plain verification leaves ties open. Whatever else it accepts of an insertion must be a triangulation.
#[test]
fn what_plain_verification_accepts_is_regular() {
    let plain = Options { strict: false, digests: false };
    let mut draw = SplitMix64(77);
    let (mut tried, mut accepted) = (0, 0);
    for seed in 0..60u64 {
        let mut family = SpaceFamily::ALL[seed as usize / 2 % SpaceFamily::ALL.len()];
        let mut weights = WeightFamily::ALL[seed as usize / 6 % WeightFamily::ALL.len()];
        if seed % 2 == 0 {
            (family, weights) = (SpaceFamily::Grid, WeightFamily::Zero);
        }
        let points = weighted_points(family, weights, 18, &mut SplitMix64(seed));
        for trace in traces(&points) {
            let mut checker = Checker::new(plain);
            for record in &trace {
                if let Record::Space(Record3::Event(Event3::Insert { id, first, flood })) = record {
                    let solid = checker.triangulation().is_some_and(|t| t.dimension == Some(3));
                    for flood in (0..8).flat_map(|_| varied(flood, &mut draw)).filter(|f| solid && f != flood) {
                        let mut other = checker.clone();
                        tried += 1;
                        let event = Record3::Event(Event3::Insert { id: *id, first: *first, flood });
                        if other.push(&Record::Space(event)).is_ok() {
                            accepted += 1;
                            assert!(is_sound(&other.triangulation().expect("of space")), "{record:?}");
                        }
                    }
                }
                checker.push(record).expect("a true trace");
            }
        }
    }
    assert!(tried > 20_000 && accepted > 20, "{accepted} of {tried}");
}
