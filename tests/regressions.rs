//! What fuzzing found, one minimal case each. The first line of each says what was wrong.
#![cfg(feature = "generators")]

use orthoball::arith::FastKernel;
use orthoball::check::{Options, Rule, Verdict, verify};
use orthoball::io::parse_poly;
use orthoball::model::{Fill, GcdrParameters, Pslg};
use orthoball::refine::{self, gcdr};
use orthoball::trace::{Record, Recorder};

/// Circumcenters and midpoints, 25 degrees.
fn parameters() -> GcdrParameters {
    GcdrParameters::chew(1.4)
}

fn trace(poly: &str, parameters: &GcdrParameters) -> Vec<Record> {
    let input = parse_poly(poly.as_bytes(), None).expect("a good file");
    let mut recorder = Recorder::default();
    gcdr::run::<FastKernel>(&input.pslg, parameters, &mut refine::Options::default(), &mut recorder).expect("a run");
    recorder.0
}

fn rule(records: &[Record]) -> Option<Rule> {
    let strict = Options { strict: true, digests: false };
    match verify(records, strict) {
        Verdict::Accepted { .. } => None,
        Verdict::Rejected(rejection) => Some(rejection.rule),
    }
}

/// The checker turned around a vertex of the hull for ever, out of the complex, where `convex` stood in a header and the hull was no segment.
#[test]
fn a_convex_fill_needs_segments_on_the_hull() {
    let poly = "4 2\n1 0 0\n2 1 0\n3 0 1\n4 2 2\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n";
    let mut records = trace(poly, &parameters());
    assert_eq!(rule(&records), None);
    if let Record::Header(header) = &mut records[0] {
        header.fill = Fill::Convex;
    }
    assert_eq!(rule(&records), Some(Rule::Domain));
}

/// The checker took a second end for one, and a second start for a longer input; `Reader` refuses both, but traces need not come from files.
#[test]
fn header_start_and_end_come_once() {
    let poly = "3 2\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n";
    let records = trace(poly, &parameters());
    for at in 0..records.len() {
        let opens = matches!(records[at], Record::Header(_) | Record::Start { .. } | Record::End(_));
        if opens {
            let mut doubled = records.clone();
            doubled.insert(at, records[at].clone());
            assert_eq!(rule(&doubled), Some(Rule::Stream), "record {at}");
        }
    }
}

/// The checker took the holes of the input out of a plain triangulation, which keeps the whole hull.
#[test]
fn a_triangulation_keeps_holes_and_concavities() {
    let poly = "8 2\n1 0 0\n2 9 1\n3 8 8\n4 0 9\n5 3 3\n6 6 3\n7 6 6\n8 3 6\n\
        7 0\n1 1 2\n2 2 3\n3 4 1\n4 5 6\n5 6 7\n6 7 8\n7 8 5\n1\n1 4 4\n1\n1 5 5 1 1\n";
    let input = parse_poly(poly.as_bytes(), None).expect("a good file");
    for fill in [Fill::Seeds, Fill::Parity, Fill::Convex] {
        let whole = Pslg { fill, ..input.pslg.clone() };
        let mut recorder = Recorder::default();
        let run = refine::triangulate::<FastKernel>(&whole, &mut recorder).expect("a run");
        assert_eq!(run.mesh.triangles.len(), 10);
        assert_eq!(rule(&recorder.0), None, "{fill:?}");
    }
}

/// A size function that asked for nothing at a place, by infinity or a huge number, ended the run as if it had returned no positive number.
#[test]
fn an_infinite_size_is_no_bound() {
    let poly = "4 2\n1 0 0\n2 1 0\n3 0 1\n4 1 1\n4 0\n1 1 2\n2 2 4\n3 4 3\n4 3 1\n0\n";
    let input = parse_poly(poly.as_bytes(), None).expect("a good file");
    let counts = [1e300, f64::MAX, f64::INFINITY, 0.25].map(|h| {
        let mut size = |_| h;
        let mut options = refine::Options { size: Some(&mut size), ..refine::Options::default() };
        let params = GcdrParameters { size_function: true, ..parameters() };
        let mut recorder = Recorder::default();
        let run = gcdr::run::<FastKernel>(&input.pslg, &params, &mut options, &mut recorder).expect("a run");
        assert_eq!(rule(&recorder.0), None, "{h}");
        run.mesh.triangles.len()
    });
    assert_eq!(counts[..3], [2; 3]);
    assert!(counts[3] > 2);
}
