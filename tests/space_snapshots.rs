//! Reviewed traces of small triangulations of space, one for each thing that such a trace can say; see `snapshots.rs`.

use orthoball::arith::FastKernel;
use orthoball::check::{Options, Verdict, verify};
use orthoball::model::{Point3, PointSet3, VertexId, WeightedPoint};
use orthoball::refine::regular::{Certificate, Session, triangulate3};
use orthoball::trace::{Format, Reader, Record, Writer};

/// Compares with the snapshot of that name, and has the trace verified strictly, as read back from its bytes.
fn snapshot(name: &str, writer: Writer<Vec<u8>>) {
    let text = writer.finish().expect("a whole trace");
    let records: Vec<Record> = Reader::new(&text[..]).collect::<Result<_, _>>().expect("what was written is read");
    let verdict = verify(&records, Options { strict: true, digests: true });
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

fn triangulated(name: &str, points: &[[f64; 3]], weights: &[f64], certificate: Certificate) {
    let points = points.iter().map(|p| Point3::from_array(*p)).collect();
    let set = PointSet3 { points, weights: weights.to_vec(), ..PointSet3::default() };
    let mut writer = Writer::new(Vec::new(), Format::Text);
    triangulate3::<FastKernel>(&set, certificate, 1, &mut writer).expect("good points");
    snapshot(name, writer);
}

/// The control of the tie-break: {0124, 1234, 1345, 2346, 3456, 3567}.
#[test]
fn grid() {
    let points: Vec<[f64; 3]> = (0..8).map(|i| [f64::from(i >> 2), f64::from(i >> 1 & 1), f64::from(i & 1)]).collect();
    triangulated("space-grid", &points, &[], Certificate::Final);
    triangulated("space-grid-steps", &points, &[], Certificate::Steps);
}

/// A corner heavy enough to hide the middle, which a duplicate repeats.
#[test]
fn weighted() {
    let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]];
    triangulated("space-weighted", &points, &[4.0, 0.0, 0.0, 0.0, -40.0, -40.0], Certificate::Final);
}

/// A square and its middle in a plane that contains the origin.
#[test]
fn coplanar() {
    let points = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [0.0, 0.0, 1.0], [0.5, 0.5, 0.5]];
    triangulated("space-coplanar", &points, &[], Certificate::Final);
    triangulated("space-coplanar-steps", &points, &[], Certificate::Steps);
}

/// Everything that a session can do.
#[test]
fn session() {
    let mut writer = Writer::new(Vec::new(), Format::Text);
    let mut session = Session::<FastKernel>::new(2, &mut writer).expect("a vector takes all");
    let corners =
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 1.0, 1.0], [0.5, 0.5, 0.25]];
    for p in corners {
        session.insert(WeightedPoint::unweighted(Point3::from_array(p))).expect("in range");
    }
    session.insert(WeightedPoint::unweighted(Point3::from_array([1.0, 1.0, 1.0]))).expect("in range");
    session.set_weight(VertexId(5), -3.0).expect("in range");
    session.set_weight(VertexId(5), 0.25).expect("in range");
    // Its duplicate takes its place, and then goes too; the next leaves a plane.
    for v in [4, 6, 5, 3] {
        session.remove(VertexId(v)).expect("a vector takes all");
    }
    session.finish().expect("a vector takes all");
    snapshot("space-session", writer);
}
