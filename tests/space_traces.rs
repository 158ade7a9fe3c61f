//! Traces of triangulations of space: accepted as they are written, the same for both kernels, both forms the same content; and what is
//! no trace of the triangulation is rejected (`tests/space_rejects.rs` has the table).
#![cfg(feature = "generators")]

use orthoball::arith::{ExactKernel, FastKernel, space::Kernel3};
use orthoball::check::{Checker, Options, Verdict, verify};
use orthoball::generators::{
    Edit, SpaceFamily, SplitMix64, WeightFamily,
    strategies::{edit_cases, space_cases},
    weighted_points,
};
use orthoball::model::{PointSet3, Triangulation3, VertexId, WeightedPoint};
use orthoball::refine::regular::{Certificate, Session, triangulate3};
use orthoball::trace::{Format, Reader, Record, Recorder, Sink, Writer};
use proptest::prelude::*;

const PLAIN: Options = Options { strict: false, digests: true };
const STRICT: Options = Options { strict: true, digests: true };

fn set(points: &[WeightedPoint]) -> PointSet3 {
    let weights = points.iter().map(|p| p.weight).collect();
    PointSet3 { points: points.iter().map(|p| p.at).collect(), weights, ..PointSet3::default() }
}

/// The trace and the triangulation; `None` if the points are refused.
fn traced<K: Kernel3>(points: &[WeightedPoint], certificate: Certificate) -> Option<(Vec<Record>, Triangulation3)> {
    let mut recorder = Recorder::default();
    let t = triangulate3::<K>(&set(points), certificate, 1, &mut recorder).ok()?;
    Some((recorder.0, t))
}

fn session<K: Kernel3>(points: &[WeightedPoint]) -> Option<(Vec<Record>, Triangulation3)> {
    let mut recorder = Recorder::default();
    let largest = points.iter().fold(0.5f64, |m, p| m.max(p.at.abs().max_element()));
    let scale = orthoball::arith::scale::exponent_of(largest);
    let mut session = Session::<K>::new(scale, &mut recorder).ok()?;
    for p in points {
        session.insert(*p).ok()?;
    }
    let t = session.finish().ok()?;
    Some((recorder.0, t))
}

fn written(records: &[Record], format: Format) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), format);
    records.iter().try_for_each(|r| writer.record(r)).expect("a vector takes all");
    writer.finish().expect("a whole trace")
}

/// Accepted plainly and strictly; read back from both forms; and the checker comes to the same triangulation.
fn holds(records: &[Record], t: &Triangulation3, what: &str) {
    for options in [PLAIN, STRICT] {
        let mut checker = Checker::new(options);
        for record in records {
            if let Err(r) = checker.push(record) {
                panic!("{what}, strict {}: {r:?} at {record:?}", options.strict);
            }
        }
        assert_eq!(checker.triangulation().as_ref(), Some(t), "{what}");
        let verdict = checker.finish();
        assert!(matches!(&verdict, Verdict::Accepted { unchecked, .. } if unchecked.is_empty()), "{what}: {verdict:?}");
    }
    for format in [Format::Text, Format::Binary] {
        let bytes = written(records, format);
        let mut reader = Reader::new(&bytes[..]);
        let back: Vec<Record> = reader.by_ref().collect::<Result<_, _>>().expect("what was written is read");
        assert_eq!(back.last().and_then(Record::trace_digest), Some(reader.digest().as_str()));
        // All but the digest of the trace, which the writer fills in.
        let n = records.len();
        assert_eq!((back.len(), &back[..n - 1]), (n, &records[..n - 1]), "{what}");
    }
}

fn check(points: &[WeightedPoint], what: &str) -> bool {
    let Some((records, t)) = traced::<FastKernel>(points, Certificate::Final) else {
        return false;
    };
    holds(&records, &t, &format!("{what}, final"));
    let (steps, other) = traced::<FastKernel>(points, Certificate::Steps).expect("the points are good");
    assert_eq!(t, other, "{what}: steps come to the same");
    holds(&steps, &t, &format!("{what}, steps"));
    if let Some((records, own)) = session::<FastKernel>(points) {
        assert_eq!(t, own, "{what}: a session comes to the same");
        holds(&records, &own, &format!("{what}, session"));
    }
    true
}

#[test]
fn traces_of_all_families_are_accepted() {
    let (mut held, mut all) = (0, 0);
    for family in SpaceFamily::ALL {
        for weights in WeightFamily::ALL {
            for (seed, n) in [(1, 6), (2, 14), (3, 40), (4, 120)] {
                let points = weighted_points(family, weights, n, &mut SplitMix64(seed));
                held += usize::from(check(&points, &format!("{family:?} {weights:?} {n}")));
                all += 1;
            }
        }
    }
    assert!(10 * held > 9 * all, "{held} of {all} point sets are good");
}

#[test]
fn traces_of_no_point_and_of_one_are_accepted() {
    assert!(check(&[], "nothing"));
    let p = WeightedPoint { weight: 2.0, ..WeightedPoint::default() };
    assert!(check(&[p], "one point"));
    assert!(check(&[p, p, p], "one point thrice"));
}

fn cases(default: u32) -> ProptestConfig {
    let cases = std::env::var("ORTHOBALL_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(default);
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn kernels_write_the_same_traces(case in space_cases(0..=30)) {
        for certificate in [Certificate::Final, Certificate::Steps] {
            let fast = traced::<FastKernel>(&case.points, certificate);
            let exact = traced::<ExactKernel>(&case.points, certificate);
            prop_assert_eq!(fast, exact);
        }
        prop_assert_eq!(session::<FastKernel>(&case.points), session::<ExactKernel>(&case.points));
    }

    #[test]
    fn traces_are_accepted(case in space_cases(0..=40)) {
        check(&case.points, "a case");
    }
}

/// A session of insertions, removals and changes of weight; what is refused is left out.
fn edited<K: Kernel3>(edits: &[Edit]) -> (Vec<Record>, Triangulation3) {
    let mut recorder = Recorder::default();
    let mut session = Session::<K>::new(3, &mut recorder).expect("a recorder takes all");
    for edit in edits {
        let points = session.triangulation().point_count() as u32;
        match *edit {
            Edit::Insert(p) => drop(session.insert(p)),
            Edit::Remove(v) if v < points => session.remove(VertexId(v)).expect("a recorder takes all"),
            Edit::SetWeight(v, w) if v < points => drop(session.set_weight(VertexId(v), w)),
            Edit::Remove(_) | Edit::SetWeight(..) => {}
        }
    }
    let t = session.finish().expect("a recorder takes all");
    (recorder.0, t)
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn sessions_with_removals_are_accepted(case in edit_cases(0..=40)) {
        let (records, t) = edited::<FastKernel>(&case.edits);
        holds(&records, &t, "a session");
    }

    #[test]
    fn kernels_write_the_same_sessions(case in edit_cases(0..=20)) {
        prop_assert_eq!(edited::<FastKernel>(&case.edits), edited::<ExactKernel>(&case.edits));
    }
}

/// Of equal points of the input the first stands for all, whatever the order of insertion; and the plain checker needs no tie-break.
#[test]
fn a_plain_verdict_needs_no_digest() {
    let points = weighted_points(SpaceFamily::Grid, WeightFamily::Zero, 60, &mut SplitMix64(9));
    let (records, _) = traced::<FastKernel>(&points, Certificate::Steps).expect("good points");
    let verdict = verify(&records, Options { strict: false, digests: false });
    assert!(matches!(verdict, Verdict::Accepted { .. }), "{verdict:?}");
}
