//! Forged traces: each is a true run changed by somebody who knows the checker. None may pass, crash or hang it.
#![cfg(feature = "generators")]

use orthoball::arith::FastKernel;
use orthoball::arith::angle::{kappa, rho2_from_min_angle};
use orthoball::check::{Options, Verdict, verify};
use orthoball::domain::prepare;
use orthoball::generators::{PslgFamily, SplitMix64, pslg};
use orthoball::model::{Choice, DiskChoice, Fill, GcdrParameters, Lines, Point2, Pslg, Segment, Triangle, VertexId};
use orthoball::refine::{self, gcdr};
use orthoball::trace::{Event, Record, Recorder, SkipReason, Why};

fn parameters() -> GcdrParameters {
    let rho2 = rho2_from_min_angle(25.0).expect("an angle in range");
    GcdrParameters { choice_a: DiskChoice::Offcenter, kappa: Some(kappa(rho2)), ..GcdrParameters::chew(rho2) }
}

fn run(pslg: &Pslg, params: &GcdrParameters) -> Vec<Record> {
    let mut recorder = Recorder::default();
    gcdr::run::<FastKernel>(pslg, params, &mut refine::Options::default(), &mut recorder).expect("a run");
    recorder.0
}

fn square(points: &[Point2]) -> Pslg {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let segment = |k: u32| Segment { ends: [VertexId(k), VertexId((k + 1) % 4)], marker: 1, toggles: true };
    Pslg {
        points: corners.iter().map(|&[x, y]| Point2::new(x, y)).chain(points.iter().copied()).collect(),
        segments: (0..4).map(segment).collect(),
        ..Pslg::default()
    }
}

/// Plain or strict, digests not compared.
fn judge(records: &[Record], strict: bool) -> Verdict {
    verify(records, Options { strict, digests: false })
}

fn accepted(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Accepted { .. })
}

/// Random graphs that meshing has to skip triangles of and delete vertices in.
fn graphs() -> impl Iterator<Item = Pslg> {
    let families = PslgFamily::all();
    (0..200).filter_map(move |k| {
        let graph = pslg(families[k % families.len()], 4 + k / families.len() % 9, &mut SplitMix64(k as u64));
        let prepared = prepare::<FastKernel>(&graph, &Lines::default());
        (!prepared.has_errors()).then_some(prepared.pslg)
    })
}

fn canonical([a, b, c]: Triangle) -> Triangle {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The record of a deleted vertex keeps its last half-edge. That once found a triangle of other vertices, or none ever.
#[test]
fn a_deleted_vertex_names_no_triangle() {
    let mut forged = 0;
    for graph in graphs().take(60) {
        for rho2 in [20.0, 30.0] {
            let params = GcdrParameters {
                choice_a: DiskChoice::Center,
                kappa: None,
                rho2: rho2_from_min_angle(rho2).expect("an angle in range"),
                ..parameters()
            };
            let mut recorder = Recorder::default();
            let mut options = refine::Options { max_steps: 120, ..refine::Options::default() };
            if gcdr::run::<FastKernel>(&graph, &params, &mut options, &mut recorder).is_err() {
                continue;
            }
            let records = recorder.0;
            // a removal takes effect with the split that follows
            let (mut deleted, mut waiting): (Vec<VertexId>, Vec<VertexId>) = Default::default();
            for i in 0..records.len() {
                let t = match &records[i] {
                    Record::Event(Event::Remove { id, .. }) => {
                        waiting.push(*id);
                        continue;
                    }
                    Record::Event(Event::Skip { t, .. } | Event::Insert { why: Why::Split { t, .. }, .. }) => *t,
                    _ => continue,
                };
                // only the smallest id is looked up; any corner may have been replaced
                for &w in deleted.iter().rev().take(6) {
                    for k in 0..3 {
                        let mut other = t;
                        other[k] = w;
                        let mut changed = records[..=i].to_vec();
                        let Record::Event(Event::Skip { t, .. } | Event::Insert { why: Why::Split { t, .. }, .. }) =
                            &mut changed[i]
                        else {
                            continue;
                        };
                        *t = canonical(other);
                        forged += 1;
                        let Verdict::Rejected(r) = judge(&changed, false) else {
                            panic!("a prefix was accepted");
                        };
                        assert!(
                            r.rule != orthoball::check::Rule::Stream,
                            "event {i}: {other:?} for a triangle with the deleted {w:?} passed"
                        );
                    }
                }
                deleted.append(&mut waiting);
            }
        }
    }
    assert!(forged > 500, "only {forged} forgeries");
}

/// Under `convex` the hull is bounded by segments. The search for angles once walked off an open hull.
#[test]
fn an_open_hull_is_rejected() {
    let mut graph = square(&[Point2::new(0.3, 0.4)]);
    graph.fill = Fill::Convex;
    let records = run(&graph, &parameters());
    assert!(accepted(&judge(&records, true)));
    for kept in 0..4 {
        let mut n = 0;
        let forged: Vec<Record> = records
            .iter()
            .filter(|r| {
                let segment = matches!(r, Record::Segment(_));
                n += usize::from(segment);
                !segment || n - 1 == kept
            })
            .cloned()
            .collect();
        assert!(!accepted(&judge(&forged, false)), "only segment {kept}");
    }
}

/// A split point is on its subsegment up to rounding: a mesh with a dent in its boundary is no mesh of the input.
#[test]
fn a_split_off_its_segment_is_rejected() {
    let graph = square(&[Point2::new(0.5, 0.02)]);
    let records = run(&graph, &parameters());
    let (at, first) = records
        .iter()
        .enumerate()
        .find_map(|(i, r)| match r {
            Record::Event(Event::Insert { p, why: Why::Split { .. }, .. }) => Some((i, *p)),
            _ => None,
        })
        .expect("a split");
    for off in [1e-15, 1e-9, 1e-3] {
        let mut forged = records[..=at].to_vec();
        let Record::Event(Event::Insert { p, .. }) = &mut forged[at] else { unreachable!("found above") };
        // the bottom edge is on y = 0: any y is off it
        *p = Point2::new(first.x, first.y + off);
        let Verdict::Rejected(r) = judge(&forged, false) else { panic!("a prefix was accepted") };
        assert_eq!(r.rule, orthoball::check::Rule::S2, "{off}: {r}");
    }
}

/// A split point may be off its border by roundings, but not carry the region over a gap onto the border across it.
#[test]
fn a_split_over_a_gap_is_rejected() {
    // A notch 2^-51 wide at the top and closed at (1/2, 1/4): a point off by 2^-50 is on its segment, up to rounding.
    let e = 2f64.powi(-52);
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5 + e, 1.0), (0.5, 0.25), (0.5 - e, 1.0), (0.0, 1.0)];
    let segment = |k: u32| Segment { ends: [VertexId(k), VertexId((k + 1) % 7)], marker: 1, toggles: true };
    let graph = Pslg {
        points: corners.iter().map(|&(x, y)| Point2::new(x, y)).collect(),
        segments: (0..7).map(segment).collect(),
        ..Pslg::default()
    };
    let records = run(&graph, &GcdrParameters { max_area: Some(0.01), ..parameters() });
    assert!(accepted(&judge(&records, true)));
    let (at, split) = records
        .iter()
        .enumerate()
        .find_map(|(i, r)| match r {
            Record::Event(Event::Insert { p, why: Why::Split { .. }, .. }) if 0.5 - e < p.x && p.x < 0.5 => {
                Some((i, *p))
            }
            _ => None,
        })
        .expect("a split of the left side of the notch");
    // In the gap; on the right side; beyond it.
    for (x, refused) in [(0.5, false), (1.0 - split.x, true), (1.0 - split.x + e, true)] {
        let mut forged = records[..=at].to_vec();
        let Record::Event(Event::Insert { p, .. }) = &mut forged[at] else { unreachable!("found above") };
        *p = Point2::new(x, split.y);
        let Verdict::Rejected(r) = judge(&forged, false) else { panic!("a prefix was accepted") };
        let rule = if refused { orthoball::check::Rule::Star } else { orthoball::check::Rule::Stream };
        assert_eq!(r.rule, rule, "{x}: {r}");
        assert_eq!(r.expected.contains("across the outside"), refused, "{x}: {r}");
    }
}

/// Plain verification does not prove that a segment is in the way of a skipped triangle; it says so.
#[test]
fn a_split_limit_is_unchecked_in_plain_verification() {
    let graph = square(&[Point2::new(0.5, 0.02)]);
    let params = GcdrParameters { max_splits: Some(0), ..parameters() };
    let records = run(&graph, &params);
    let mut skips = 0;
    for r in &records {
        if let Record::Event(Event::Skip { reason: SkipReason::SplitLimit { .. }, .. }) = r {
            skips += 1;
        }
    }
    assert!(skips > 0);
    let Verdict::Accepted { unchecked, .. } = judge(&records, false) else { panic!("a true trace was rejected") };
    assert!(!unchecked.is_empty());
    let Verdict::Accepted { unchecked, .. } = judge(&records, true) else { panic!("a true trace was rejected") };
    assert!(unchecked.is_empty());
}

/// Answers with the center or midpoint, moved.
struct Moved([f64; 2], [f64; 2]);

impl refine::Chooser for Moved {
    fn in_disk(&mut self, request: &refine::DiskRequest) -> Point2 {
        let Moved([x, y], _) = *self;
        Point2::new(request.center.x + x, request.center.y + y)
    }

    fn in_interval(&mut self, request: &refine::IntervalRequest) -> Point2 {
        let (Moved(_, [x, y]), [u, v]) = (&*self, request.ends);
        Point2::new((u.x + v.x) / 2.0 + x, (u.y + v.y) / 2.0 + y)
    }
}

/// A user's point that is no number, outside its region, or beside its segment ends the run; one that is -0 is 0.
#[test]
fn a_users_point_outside_its_region_is_refused() {
    let params = GcdrParameters {
        d1: 0.5,
        d2: 0.9,
        mu: 0.5,
        kappa: None,
        choice_a: DiskChoice::User,
        choice_b: Choice::User,
        choice_c: Choice::User,
        ..parameters()
    };
    let graph = square(&[Point2::new(0.5, 0.02), Point2::new(0.0, 0.0625)]);
    let prepared = prepare::<FastKernel>(&graph, &Lines::default()).pslg;
    let run_with = |disk, interval| {
        let mut chooser = Moved(disk, interval);
        let mut options = refine::Options { chooser: Some(&mut chooser), ..refine::Options::default() };
        let mut recorder = Recorder::default();
        gcdr::run::<FastKernel>(&prepared, &params, &mut options, &mut recorder).map(|_| recorder.0)
    };
    let zero = [0.0, 0.0];
    for negative in [zero, [-0.0, -0.0]] {
        let records = run_with(zero, negative).expect("midpoints are in their intervals");
        assert!(accepted(&judge(&records, false)));
        assert!(accepted(&judge(&records, true)));
    }
    let wrong = [f64::NAN, f64::INFINITY, 1e300, 3.0, 1e-9];
    for x in wrong {
        let both = run_with(zero, [x, x]);
        assert!(matches!(both, Err(refine::RunError::RegionViolation { .. })), "{x} beside a segment");
    }
    for x in &wrong[..4] {
        let moved = run_with([*x, 0.0], zero);
        assert!(matches!(moved, Err(refine::RunError::RegionViolation { .. })), "{x} off a center");
    }
}

/// Sizes and area bounds that are no positive finite numbers are refused before anything is written.
#[test]
fn a_bound_that_is_no_positive_number_is_refused() {
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        let params = GcdrParameters { max_area: Some(wrong), ..parameters() };
        let mut recorder = Recorder::default();
        let answer = gcdr::run::<FastKernel>(&square(&[]), &params, &mut refine::Options::default(), &mut recorder);
        assert!(matches!(answer, Err(refine::RunError::Parameter { .. })), "area {wrong}");
        assert!(recorder.0.is_empty(), "area {wrong}");
    }
    for wrong in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY, f64::MIN_POSITIVE] {
        let params = GcdrParameters { size_function: true, ..parameters() };
        let mut size = |_| wrong;
        let mut options = refine::Options { size: Some(&mut size), ..refine::Options::default() };
        let answer = gcdr::run::<FastKernel>(&square(&[]), &params, &mut options, &mut Recorder::default());
        assert!(matches!(answer, Err(refine::RunError::Size { .. })), "size {wrong}");
    }
}
