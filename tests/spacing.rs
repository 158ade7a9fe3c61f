//! The rows of spacing: traces that must be accepted, and fabricated ones that must be rejected.

use orthoball::arith::FastKernel;
use orthoball::check::spacing::{Kind, Row, Spacing, Violation};
use orthoball::model::{
    Choice, DiskChoice, GcdrParameters, Level, Point2, Pslg, QueueOrder, Segment, SmallAngles, VertexId,
};
use orthoball::refine::{Options, gcdr};
use orthoball::reproduce::squares::{Experiment, measure, parameters, squares};
use orthoball::trace::{Cause, Event, Record, Recorder, SplitKind, Why};

fn records(pslg: &Pslg, parameters: &GcdrParameters) -> Vec<Record> {
    let mut recorder = Recorder::default();
    gcdr::run::<FastKernel>(pslg, parameters, &mut Options::default(), &mut recorder).expect("a good input");
    recorder.0
}

fn feed<'a>(records: impl IntoIterator<Item = &'a Record>) -> Result<Spacing, Violation> {
    let mut spacing = Spacing::new();
    for record in records {
        spacing.record(record)?;
    }
    spacing.finish(None, [])?;
    Ok(spacing)
}

/// A polygon with the segments of its boundary.
fn polygon(corners: &[(f64, f64)]) -> Pslg {
    let n = corners.len() as u32;
    Pslg {
        points: corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect(),
        segments: (0..n)
            .map(|i| Segment { ends: [VertexId(i), VertexId((i + 1) % n)], marker: 0, toggles: true })
            .collect(),
        ..Pslg::default()
    }
}

#[test]
fn every_choice_on_the_squares_is_accepted_and_decided() {
    for experiment in [Experiment::Center, Experiment::Extreme, Experiment::Random(7)] {
        let measured =
            measure(&parameters(2.0, [0.9, 0.9, 0.4], experiment, QueueOrder::ShortestEdge)).expect("it runs");
        assert_eq!(measured.violation, None);
        let rows = &measured.report.rows;
        for row in [Row::I1, Row::A6, Row::B5, Row::C3, Row::C4, Row::F1, Row::F2] {
            let count = rows.get(&row).copied().unwrap_or_default();
            assert!(count.held > 0, "{row}: {count:?}");
            assert_eq!(count.undecided, 0, "{row}");
        }
    }
}

#[test]
fn an_oblique_graph_with_incident_segments_is_accepted() {
    // angles of 70 degrees and more, nothing on a grid: splits are off their segments
    let mut pslg = polygon(&[(0.1, 0.0), (7.3, 1.1), (9.1, 6.7), (4.4, 9.9), (-1.7, 5.2)]);
    pslg.points.push(Point2::new(3.9, 4.7));
    pslg.points.push(Point2::new(4.1, 4.9));
    let mut p = parameters(2.0, [0.9, 0.9, 0.9], Experiment::Random(3), QueueOrder::WorstFirst);
    for seed in 0..20 {
        p.seed = Some(seed);
        let spacing = feed(&records(&pslg, &p)).unwrap_or_else(|v| panic!("{v:?}"));
        assert!(spacing.report().densities[&Kind::A] > 0.5);
    }
}

#[test]
fn runs_outside_the_theorem_claim_nothing_at_the_end() {
    let mut p = parameters(1.0, [1.0; 3], Experiment::Center, QueueOrder::ShortestEdge);
    p.choice_a = DiskChoice::Offcenter;
    p.kappa = Some(1.8);
    p.choice_b = Choice::Center;
    p.small_angles = SmallAngles::Shells;
    let records = records(&squares(), &p);
    let Some(Record::End(end)) = records.last() else { panic!("a trace ends") };
    assert_ne!(end.level_effective, Some(Level::Graded));
    let spacing = feed(&records).expect("the rows of events hold");
    let f1 = spacing.report().rows[&Row::F1];
    assert_eq!((f1.held, f1.undecided), (0, 0));
    assert!(f1.unclaimed > 0);
}

/// The records up to the end of the start, with the square (0,0)-(8,8), a free-standing inner vertex and parameters rho^2 = 2, others 1.
fn head(pslg: &Pslg) -> Vec<Record> {
    let p = parameters(2.0, [1.0; 3], Experiment::Center, QueueOrder::Fifo);
    records(pslg, &p).into_iter().take_while(|r| !matches!(r, Record::Event(_) | Record::End(_))).collect()
}

fn free(p: (f64, f64), destroyed: &[[u32; 3]]) -> Record {
    Record::Event(Event::Insert {
        p: Point2::new(p.0, p.1),
        why: Why::Free { cause: Cause::Skinny },
        destroyed: destroyed.iter().map(|t| t.map(VertexId)).collect(),
    })
}

fn split(p: (f64, f64), a: (f64, f64), kind: SplitKind, s: [u32; 2], t: [u32; 3], destroyed: &[[u32; 3]]) -> Record {
    Record::Event(Event::Insert {
        p: Point2::new(p.0, p.1),
        why: Why::Split {
            kind,
            s: s.map(VertexId),
            t: t.map(VertexId),
            cause: Cause::Skinny,
            a: Point2::new(a.0, a.1),
            shell: None,
        },
        destroyed: destroyed.iter().map(|t| t.map(VertexId)).collect(),
    })
}

fn rejected(head: &[Record], events: &[Record]) -> Row {
    match feed(head.iter().chain(events)) {
        Ok(_) => panic!("accepted"),
        Err(violation) => violation.row,
    }
}

#[test]
fn a6_rejects_a_center_beside_a_vertex_that_its_circle_should_not_hold() {
    // the circle of 0 1 2 is centered at (4, 4); vertex 4 lies beside it
    let mut pslg = polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]);
    pslg.points.push(Point2::new(4.01, 4.0));
    let head = head(&pslg);
    assert_eq!(rejected(&head, &[free((4.0, 4.0), &[[0, 1, 2], [0, 2, 4]])]), Row::A6);
    // without it nothing is wrong with the spacing
    assert!(feed(head.iter().chain(&[free((4.0, 4.0), &[[0, 1, 2], [0, 2, 3]])])).is_ok());
}

#[test]
fn b5_rejects_a_parent_too_far_and_a_free_vertex_left_in_the_disk() {
    let mut pslg = polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]);
    pslg.points.push(Point2::new(4.0, 7.0));
    let head = head(&pslg);
    // (4, 15.5) is the center of 2 3 4, and its parent 4 is 7 away from the middle of s = 0 1, more than |s|/2
    let far = split((4.0, 0.0), (4.0, 15.5), SplitKind::B, [0, 1], [2, 3, 4], &[[0, 1, 4]]);
    assert_eq!(rejected(&head, &[far]), Row::B5);
    let split = |destroyed: &[[u32; 3]]| split((4.0, 0.0), (4.0, 4.0), SplitKind::B, [0, 1], [0, 1, 2], destroyed);
    assert!(feed(head.iter().chain(&[split(&[[0, 1, 4]])])).is_ok());
    let mut spacing = Spacing::new();
    for record in &head {
        spacing.record(record).expect("the start is good");
    }
    // its own rows may fail: it only has to be there
    let _ = spacing.record(&free((4.0, 0.01), &[[0, 1, 4]]));
    let violation = spacing.record(&split(&[[0, 1, 5]])).expect_err("R = 1/100, lfs = 4");
    assert_eq!(violation.row, Row::B5);
}

#[test]
fn c4_rejects_a_parent_outside_the_disk() {
    let mut pslg = polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]);
    pslg.points.push(Point2::new(4.0, 4.5));
    let head = head(&pslg);
    let event = |parent| {
        split((4.0, 0.0), (4.0, -1.0), SplitKind::C { parent: VertexId(parent) }, [0, 1], [0, 1, 4], &[[0, 1, 4]])
    };
    assert_eq!(rejected(&head, &[event(4)]), Row::C4);
    assert_eq!(rejected(&head, &[event(2)]), Row::C4);
    assert_eq!(rejected(&head, &[event(77)]), Row::Record);
}

#[test]
fn c4_rejects_a_density_that_an_incident_parent_does_not_allow() {
    // a corner of 65 degrees at vertex 0; vertex 4 splits one side 3 from the corner, inside Diam of the other side
    let (sin, cos) = 65f64.to_radians().sin_cos();
    let pslg = polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0 + 8.0 * cos, 8.0 * sin), (8.0 * cos, 8.0 * sin)]);
    let head = head(&pslg);
    let center = (4.0, 3.0);
    let first = split((3.0 * cos, 3.0 * sin), center, SplitKind::B, [0, 3], [0, 1, 3], &[[0, 1, 3]]);
    let second = |destroyed: &[[u32; 3]]| {
        split((4.0, 0.0), center, SplitKind::C { parent: VertexId(4) }, [0, 1], [0, 1, 4], destroyed)
    };
    let mut spacing = Spacing::new();
    for record in head.iter().chain([&first]) {
        spacing.record(record).unwrap_or_else(|v| panic!("{v:?}"));
    }
    let mut honest = spacing.clone();
    honest.record(&second(&[[0, 1, 4]])).unwrap_or_else(|v| panic!("{v:?}"));
    assert_eq!(honest.report().rows[&Row::C4].held, 2, "distance and density");
    // its own rows may fail: it only has to be there
    let _ = spacing.record(&free((4.0, 0.01), &[[0, 1, 4]]));
    let violation = spacing.record(&second(&[[0, 1, 5]])).expect_err("R = 1/100, lfs = 4");
    assert_eq!((violation.row, violation.expected.as_str()), (Row::C4, "D <= B4 + D'/C4, times R"));
}

#[test]
fn c3_rejects_a_radius_below_local_feature_size() {
    // 4 is inside Diam(0 1) at 3; a free vertex at distance 1/2, which the split should have deleted, makes R too small
    let mut pslg = polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]);
    pslg.points.push(Point2::new(4.0, 3.0));
    let head = head(&pslg);
    let stray = free((4.0, 0.5), &[[0, 1, 4]]);
    let split = |destroyed: &[[u32; 3]]| {
        split((4.0, 0.0), (4.0, -1.0), SplitKind::C { parent: VertexId(4) }, [0, 1], [0, 1, 4], destroyed)
    };
    let mut spacing = Spacing::new();
    for record in head.iter().chain(&[split(&[[0, 1, 4]])]) {
        spacing.record(record).expect("R = 3 = lfs");
    }
    assert_eq!(spacing.density(VertexId(5)), Some(1.0));
    let mut spacing = Spacing::new();
    for record in &head {
        spacing.record(record).expect("the start is good");
    }
    // its own rows may fail: it only has to be there
    let _ = spacing.record(&stray);
    let violation = spacing.record(&split(&[[0, 1, 5]])).expect_err("R = 1/2 < lfs = 3");
    assert_eq!(violation.row, Row::C3);
}

#[test]
fn f1_and_f2_reject_what_the_grading_constants_forbid() {
    // a run that ends graded; then its last vertex is said to have a neighbor at a thousandth of its radius
    let p = parameters(2.0, [1.0; 3], Experiment::Center, QueueOrder::Fifo);
    let honest = records(&squares(), &p);
    let mut spacing = feed(&honest).expect("a graded run");
    // an edge between the two input vertices of least distance is fine, one of length 0 is not
    assert!(spacing.finish(None, [[VertexId(0), VertexId(4)]]).is_ok());
    let violation = spacing.finish(None, [[VertexId(0), VertexId(0)]]).expect_err("a loop");
    assert_eq!(violation.row, Row::F2);
    // with size as the cause no row of the event speaks, and no theorem either
    let mut sized = honest.clone();
    for record in &mut sized {
        if let Record::Event(Event::Insert { why: Why::Free { cause } | Why::Split { cause, .. }, .. }) = record {
            *cause = Cause::Area;
        }
    }
    let rows = feed(&sized).expect("nothing is claimed").report().rows.clone();
    assert_eq!((rows[&Row::F1].held, rows[&Row::A6].held), (0, 0));
    assert!(rows[&Row::F1].unclaimed > 0 && rows[&Row::A6].unclaimed > 0);
}

#[test]
fn records_that_name_nothing_are_refused_without_a_panic() {
    let pslg = polygon(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]);
    let head = head(&pslg);
    let bad = [
        free((4.0, 4.0), &[[0, 1, 99]]),
        free((4.0, 4.0), &[]),
        free((f64::NAN, 4.0), &[[0, 1, 2]]),
        split((4.0, 4.0), (4.0, 4.0), SplitKind::B, [0, 2], [0, 1, 2], &[[0, 1, 2]]),
        split((4.0, 4.0), (4.0, 4.0), SplitKind::B, [0, 99], [0, 1, 2], &[[0, 1, 2]]),
    ];
    for record in bad {
        assert_eq!(rejected(&head, &[record]), Row::Record);
    }
    // events before the start, a second start
    assert!(feed(&[free((4.0, 4.0), &[[0, 1, 2]])]).is_err());
    assert!(feed(head.iter().chain(&[Record::Start { triangles: 0 }])).is_err());
}
