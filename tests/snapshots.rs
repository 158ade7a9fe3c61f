//! Reviewed traces of small inputs, one for each thing that a trace can say. Each is what the refiner writes today, byte for byte, and the
//! strict checker accepts it.
//!
//! A changed snapshot is a change of the format or of an algorithm: it is told in the changelog, and looked at before it is accepted.
#![cfg(feature = "generators")]

use orthoball::arith::FastKernel;
use orthoball::arith::angle::{kappa, rho2_from_min_angle};
use orthoball::check::{Options, Verdict, verify};
use orthoball::domain::prepare;
use orthoball::io::parse_poly;
use orthoball::model::{
    Choice, DeletionPolicy, DiskChoice, GcdrParameters, Level, Lines, QueueOrder, VertexOfTriangle,
};
use orthoball::refine::{self, everyday, gcdr, least_d2};
use orthoball::trace::{Format, Reader, Record, Writer};

const SQUARE: &str = "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";

/// Of side 3 with a square hole nearer to one corner than its own size.
const HOLE: &str = "8 2\n1 0 0\n2 3 0\n3 3 3\n4 0 3\n5 0.25 0.5\n6 1.25 0.5\n7 1.25 1.5\n8 0.25 1.5\n\
    8 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n5 5 6 2\n6 6 7 2\n7 7 8 2\n8 8 5 2\n1\n1 0.75 1\n";

/// A triangle with an angle of some 14 degrees, and a vertex that splits one of its long sides.
const WEDGE: &str = "4 2\n1 0 0\n2 4 0\n3 4 1\n4 2.5 0\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n";

/// A bar with an isolated vertex close above its lower side.
const BAR: &str = "5 2\n1 0 0\n2 4 0\n3 4 2\n4 0 2\n5 2.25 0.25\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";

/// Two regions, the right one with an area bound.
const REGIONS: &str = "6 2\n1 0 0\n2 1 0\n3 2 0\n4 2 1\n5 1 1\n6 0 1\n7 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 5 1\n5 5 6 1\n6 6 1 1\n\
    7 2 5 9\n0\n2\n1 0.5 0.5 1 -1\n2 1.5 0.5 2 0.125\n";

/// The defaults of the command line.
fn defaults() -> GcdrParameters {
    everyday(25.0).expect("an angle in range")
}

/// With one kind of choice everywhere.
fn chosen(choice_a: DiskChoice, on_segments: Choice, min_angle: f64) -> GcdrParameters {
    GcdrParameters {
        rho2: rho2_from_min_angle(min_angle).expect("an angle in range"),
        choice_a,
        choice_b: on_segments,
        choice_c: on_segments,
        kappa: None,
        ..defaults()
    }
}

/// Runs, compares with the snapshot of that name, and has the trace verified strictly, as read back from its bytes.
fn snapshot(name: &str, poly: &str, parameters: &GcdrParameters, max_steps: u64) {
    let input = parse_poly(poly.as_bytes(), None).expect("a good file");
    let prepared = prepare::<FastKernel>(&input.pslg, &Lines::default());
    assert!(!prepared.has_errors());
    let mut writer = Writer::new(Vec::new(), Format::Text);
    let mut options = refine::Options { max_steps, ..refine::Options::default() };
    gcdr::run::<FastKernel>(&prepared.pslg, parameters, &mut options, &mut writer).expect("a run");
    let text = writer.finish().expect("a whole trace");
    let mut reader = Reader::new(&text[..]);
    let records: Vec<Record> = reader.by_ref().collect::<Result<_, _>>().expect("what was written is read");
    assert!(matches!(records.last(), Some(Record::End(end)) if end.trace == reader.digest()));
    let strict = Options { strict: true, digests: true };
    let verdict = verify(&records, strict);
    assert!(matches!(&verdict, Verdict::Accepted { unchecked, .. } if unchecked.is_empty()), "{verdict:?}");
    let text = String::from_utf8(text).expect("text");
    insta::with_settings!({
        snapshot_path => "../snapshots",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, {
        insta::assert_snapshot!(name, text);
    });
}

/// The least there is: header, domain, start, end, and in a square nothing to do.
#[test]
fn square_with_defaults() {
    snapshot("square", SQUARE, &defaults(), 1000);
}

/// The defaults at work: off-centers, splits on both borders, triangles of hole and outside in `start` only.
#[test]
fn hole() {
    snapshot("hole", HOLE, &defaults(), 1000);
}

/// Splits on concentric shells at a small input angle, and the triangles it spoils skipped with the reason `input-angle`.
#[test]
fn wedge_with_shells() {
    let parameters = GcdrParameters { max_area: Some(0.5), ..defaults() };
    snapshot("wedge", WEDGE, &parameters, 1000);
}

/// `extreme` choices toward the newest vertex: points on the border of their regions, where rounding puts half of them outside; `fifo` order.
#[test]
fn extreme() {
    let parameters = GcdrParameters {
        d1: 0.9,
        d2: 0.9,
        mu: 0.8,
        extreme: Some(VertexOfTriangle::Newest),
        order: QueueOrder::Fifo,
        ..chosen(DiskChoice::Extreme, Choice::Extreme, 20.0)
    };
    snapshot("extreme", HOLE, &parameters, 1000);
}

/// `random` choices: the draws, by seed and step; worst triangle first, deletion by what the point sees.
#[test]
fn random() {
    let parameters = GcdrParameters {
        d1: 0.8,
        d2: 0.8,
        mu: 0.5,
        seed: Some(7),
        order: QueueOrder::WorstFirst,
        deletion: DeletionPolicy::Point,
        ..chosen(DiskChoice::Random, Choice::Random, 20.0)
    };
    snapshot("random", HOLE, &parameters, 1000);
}

/// Type-C: an input vertex seen in the diametral disk of a side is the parent of its midpoint. Also `remove`: free vertices go first.
#[test]
fn type_c() {
    let parameters = chosen(DiskChoice::Center, Choice::Center, 28.0);
    snapshot("type-c", BAR, &parameters, 1000);
}

/// Area bounds, of a region and of the whole: oversized triangles after skinny ones; markers and attributes in the domain.
#[test]
fn area() {
    let parameters = GcdrParameters { max_area: Some(0.25), ..chosen(DiskChoice::Center, Choice::Center, 25.0) };
    snapshot("area", REGIONS, &parameters, 1000);
}

/// The theorem's own setting: clamped off-centers with the least delta2 of the graded level; stopped by its budget.
#[test]
fn graded_and_stopped() {
    let mut parameters = defaults();
    parameters.choice_a = DiskChoice::ClampedOffcenter;
    parameters.rho2 = rho2_from_min_angle(20.0).expect("an angle in range");
    parameters.kappa = Some(kappa(parameters.rho2));
    parameters.d2 = least_d2(parameters.rho2, Level::Graded).expect("graded below 26.5 degrees");
    snapshot("graded", BAR, &parameters, 9);
}
