//! Small traces made by hand: those that must be accepted, and what must be rejected of each.

use super::{Options, Place, Rule, Verdict, verify};
use crate::model::{Fill, GcdrParameters, Level, Point2, Segment, VertexId};
use crate::trace::{Algorithm, Cause, Counts, End, Event, Header, Outcome, Record, SplitKind, Why};

const NO_DIGESTS: Options = Options { strict: false, digests: false };

fn parameters(max_area: Option<f64>) -> GcdrParameters {
    GcdrParameters { max_area, ..GcdrParameters::chew(2.0) }
}

fn t(a: u32, b: u32, c: u32) -> [VertexId; 3] {
    [VertexId(a), VertexId(b), VertexId(c)]
}

/// A rectangle from the origin with its border as segments; its diagonal is the one of the tie-break.
fn rectangle(width: f64, height: f64, algorithm: Algorithm) -> Vec<Record> {
    let level = matches!(algorithm, Algorithm::Gcdr(_)).then_some(Level::Graded);
    let mut records = vec![Record::Header(Header { algorithm, level, fill: Fill::Seeds })];
    for (x, y) in [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)] {
        records.push(Record::Vertex { at: Point2::new(x, y), marker: None, attributes: vec![] });
    }
    for k in 0..4 {
        let ends = [VertexId(k), VertexId((k + 1) % 4)];
        records.push(Record::Segment(Segment { ends, marker: 0, toggles: true }));
    }
    records.extend([Record::Start { triangles: 2 }, Record::Triangle(t(0, 1, 3)), Record::Triangle(t(1, 2, 3))]);
    records
}

fn end(counts: Counts, level: Option<Level>) -> Record {
    Record::End(End {
        outcome: Outcome::Complete,
        stop_reason: None,
        level_effective: level,
        counts,
        mesh: "0".repeat(64),
        trace: "0".repeat(64),
    })
}

/// The unit square, refined once by area.
fn square() -> Vec<Record> {
    let mut records = rectangle(1.0, 1.0, Algorithm::Gcdr(parameters(Some(0.3))));
    records.push(Record::Event(Event::Insert {
        p: Point2::new(0.5, 0.5),
        why: Why::Free { cause: Cause::Area },
        destroyed: vec![t(0, 1, 3), t(1, 2, 3)],
    }));
    let counts = Counts { vertices: 5, triangles: 4, type_a: 1, ..Counts::default() };
    records.push(end(counts, Some(Level::Graded)));
    records
}

/// A long rectangle: its center is inserted, encroaches from a triangle on the lower side, and is deleted for a split of it.
fn bar() -> Vec<Record> {
    let mut records = rectangle(4.0, 1.0, Algorithm::Gcdr(parameters(None)));
    let split = |p: Point2, s: (u32, u32), triangle, a: Point2, destroyed| {
        Record::Event(Event::Insert {
            p,
            why: Why::Split {
                kind: SplitKind::B,
                s: [VertexId(s.0), VertexId(s.1)],
                t: triangle,
                cause: Cause::Skinny,
                a,
                shell: None,
            },
            destroyed,
        })
    };
    let both = vec![t(0, 1, 3), t(1, 2, 3)];
    records.push(Record::Event(Event::Insert {
        p: Point2::new(2.0, 0.5),
        why: Why::Free { cause: Cause::Skinny },
        destroyed: both.clone(),
    }));
    records.push(Record::Event(Event::Remove { id: VertexId(4), created: both.clone() }));
    records.push(split(Point2::new(2.0, 0.0), (0, 1), t(0, 1, 4), Point2::new(2.0, -3.75), both));
    // (0,5,3), (5,1,2), (5,2,3): the lower corners have r^2 = 5/4, l = 1; the upper one r^2 = (5/2)^2/4... none skinny but for r^2/l^2 >= 2.
    let counts = Counts { vertices: 5, triangles: 3, type_a: 1, type_b: 1, removed: 1, ..Counts::default() };
    records.push(end(counts, Some(Level::Graded)));
    records
}

fn verdict(records: &[Record]) -> Verdict {
    verify(records, NO_DIGESTS)
}

fn rejected_by(records: &[Record]) -> (Place, Rule) {
    match verdict(records) {
        Verdict::Rejected(r) => (r.event, r.rule),
        accepted => panic!("accepted: {accepted:?}"),
    }
}

#[test]
fn a_plain_triangulation() {
    let counts = Counts { vertices: 4, triangles: 2, ..Counts::default() };
    let mut records = rectangle(1.0, 1.0, Algorithm::Delaunay);
    records.push(end(counts, None));
    assert_eq!(verdict(&records), Verdict::Accepted { events: 0, unchecked: vec![] });
    // The other diagonal passes the raw test and fails the tie-break.
    records[10] = Record::Triangle(t(0, 1, 2));
    records[11] = Record::Triangle(t(0, 2, 3));
    assert_eq!(rejected_by(&records), (Place::Start, Rule::Delaunay));
    records.truncate(11);
    assert_eq!(rejected_by(&records), (Place::End, Rule::Stream));
}

#[test]
fn a_triangulation_must_cover_the_hull_once() {
    let header = Record::Header(Header { algorithm: Algorithm::Delaunay, level: None, fill: Fill::Convex });
    let make = |points: &[(f64, f64)], triangles: &[[VertexId; 3]]| {
        let mut records = vec![header.clone()];
        records.extend(points.iter().map(|&(x, y)| Record::Vertex {
            at: Point2::new(x, y),
            marker: None,
            attributes: vec![],
        }));
        records.push(Record::Start { triangles: triangles.len() as u32 });
        records.extend(triangles.iter().map(|&t| Record::Triangle(t)));
        records.push(end(
            Counts { vertices: points.len() as u32, triangles: triangles.len() as u32, ..Counts::default() },
            None,
        ));
        records
    };
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let with_far = [square[0], square[1], square[2], square[3], (5.0, 5.0)];
    type Case<'a> = (&'a [(f64, f64)], &'a [[VertexId; 3]], Option<Rule>);
    let cases: [Case; 6] = [
        (&square, &[t(0, 1, 3), t(1, 2, 3)], None),
        (&square, &[t(0, 1, 3)], Some(Rule::Triangulation)),
        (&with_far, &[t(0, 1, 3), t(1, 2, 3)], Some(Rule::Triangulation)),
        (&square, &[t(0, 1, 3), t(0, 1, 2)], Some(Rule::Canonical)),
        (&square, &[t(0, 1, 2), t(0, 1, 3)], Some(Rule::Triangulation)),
        (&square, &[t(0, 3, 1), t(1, 2, 3)], Some(Rule::Triangulation)),
    ];
    for (points, triangles, expected) in cases {
        let found = match verdict(&make(points, triangles)) {
            Verdict::Accepted { .. } => None,
            Verdict::Rejected(r) => Some(r.rule),
        };
        assert_eq!(found, expected, "{triangles:?}");
    }
}

#[test]
fn a_square_refined_by_area() {
    assert_eq!(verdict(&square()), Verdict::Accepted { events: 1, unchecked: vec![] });
    let change = |edit: &dyn Fn(&mut Vec<Record>)| {
        let mut records = square();
        edit(&mut records);
        rejected_by(&records)
    };
    let insert = |p: (f64, f64), cause, destroyed| {
        Record::Event(Event::Insert { p: Point2::new(p.0, p.1), why: Why::Free { cause }, destroyed })
    };
    let both = || vec![t(0, 1, 3), t(1, 2, 3)];
    let at = |rule| (Place::Event(0), rule);
    assert_eq!(change(&|r| r[12] = insert((0.5, 0.5), Cause::Skinny, both())), at(Rule::Cause));
    assert_eq!(change(&|r| r[12] = insert((0.5, 0.5), Cause::Size { h: 0.1 }, both())), at(Rule::Cause));
    assert_eq!(change(&|r| r[12] = insert((0.5, 0.5), Cause::Area, vec![t(0, 1, 3)])), at(Rule::Flood));
    assert_eq!(change(&|r| r[12] = insert((0.5, 0.5), Cause::Area, vec![t(0, 1, 2)])), at(Rule::Exists));
    assert_eq!(change(&|r| r[12] = insert((0.5, 1.5), Cause::Area, both())), at(Rule::A1));
    assert_eq!(change(&|r| r[12] = insert((0.5, 1.0), Cause::Area, both())), at(Rule::Star));
    assert_eq!(change(&|r| r[12] = insert((0.5, -0.0), Cause::Area, both())), at(Rule::Coordinate));
    assert_eq!(change(&|r| r[12] = insert((0.5, f64::NAN), Cause::Area, both())), at(Rule::Coordinate));
    // A point off the circumcenter is a fact of the complex, but not of the level promised.
    assert_eq!(change(&|r| r[12] = insert((0.5, 0.4375), Cause::Area, both())), (Place::End, Rule::Level));
    assert_eq!(change(&|r| drop(r.remove(12))), (Place::End, Rule::F3));
    assert_eq!(change(&|r| r.push(r[12].clone())), (Place::Event(1), Rule::Stream));
    assert_eq!(change(&|r| drop(r.pop())), (Place::End, Rule::Stream));
}

#[test]
fn a_split_with_a_deletion() {
    let accepted = verdict(&bar());
    assert!(matches!(accepted, Verdict::Accepted { events: 3, .. }), "{accepted:?}");
    let mut records = bar();
    records.remove(13);
    assert_eq!(rejected_by(&records), (Place::Event(1), Rule::S2));
    let mut records = bar();
    records.remove(14);
    assert_eq!(rejected_by(&records), (Place::End, Rule::Removal));
    let mut records = bar();
    records[13] = Record::Event(Event::Remove { id: VertexId(4), created: vec![t(0, 1, 2), t(0, 2, 3)] });
    assert_eq!(rejected_by(&records), (Place::Event(1), Rule::Delaunay));
    let mut records = bar();
    records[13] = Record::Event(Event::Remove { id: VertexId(4), created: vec![t(0, 1, 3), t(0, 2, 3)] });
    assert_eq!(rejected_by(&records), (Place::Event(1), Rule::Star));
    let split = |edit: &dyn Fn(&mut Point2, &mut Why)| {
        let mut records = bar();
        if let Record::Event(Event::Insert { p, why, .. }) = &mut records[14] {
            edit(p, why);
        }
        rejected_by(&records)
    };
    let at = |rule| (Place::Event(2), rule);
    assert_eq!(split(&|p, _| p.x = 0.0), at(Rule::S2));
    assert_eq!(
        split(&|_, why| if let Why::Split { s, .. } = why {
            s[0] = VertexId(1);
            s[1] = VertexId(2)
        }),
        at(Rule::S1)
    );
    assert_eq!(
        split(&|_, why| if let Why::Split { kind, .. } = why {
            *kind = SplitKind::C { parent: VertexId(2) }
        }),
        at(Rule::S3)
    );
    assert_eq!(
        split(&|_, why| if let Why::Split { a, .. } = why {
            a.y = 0.25
        }),
        at(Rule::S1)
    );
    assert_eq!(
        split(&|_, why| if let Why::Split { a, .. } = why {
            a.y = -9.0
        }),
        at(Rule::A1)
    );
    assert_eq!(
        split(&|_, why| if let Why::Split { t: triangle, .. } = why {
            *triangle = t(1, 2, 4)
        }),
        at(Rule::Cause)
    );
}
