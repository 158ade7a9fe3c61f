//! What strict verification without digests must refuse: every changed field of every event, and events dropped, doubled, swapped or cut off.
#![cfg(feature = "generators")]

use orthoball::arith::FastKernel;
use orthoball::arith::angle::{kappa, rho2_from_min_angle};
use orthoball::check::{Checker, Options, Verdict, verify};
use orthoball::domain::prepare;
use orthoball::generators::{Draw, PslgFamily, SplitMix64, pslg};
use orthoball::model::{
    Choice, DeletionPolicy, DiskChoice, GcdrParameters, Level, Lines, Pslg, QueueOrder, SegmentId, SmallAngles,
    VertexId,
};
use orthoball::refine::{self, gcdr};
use orthoball::trace::{Cause, Event, Outcome, Record, Recorder, Shell, SkipReason, SplitKind, Why};

const STRICT: Options = Options { strict: true, digests: false };

fn records(pslg: &Pslg, params: &GcdrParameters, max_steps: u64) -> Option<Vec<Record>> {
    let mut recorder = Recorder::default();
    let mut options = refine::Options { max_steps, ..refine::Options::default() };
    gcdr::run::<FastKernel>(pslg, params, &mut options, &mut recorder).ok().map(|_| recorder.0)
}

fn parameters(k: usize) -> GcdrParameters {
    let rho2 = rho2_from_min_angle([20.0, 25.0, 30.0][k % 3]).expect("angles in range");
    let offcenter = k.is_multiple_of(2);
    GcdrParameters {
        rho2,
        d1: 1.0,
        d2: 1.0,
        mu: 1.0,
        choice_a: if offcenter { DiskChoice::Offcenter } else { DiskChoice::Center },
        choice_b: Choice::Center,
        choice_c: Choice::Center,
        kappa: offcenter.then(|| kappa(rho2)),
        extreme: None,
        seed: None,
        order: [QueueOrder::ShortestEdge, QueueOrder::WorstFirst, QueueOrder::Fifo][k / 2 % 3],
        deletion: DeletionPolicy::Segment,
        small_angles: SmallAngles::Shells,
        max_area: (k % 4 == 1).then_some(0.02),
        size_function: false,
        max_splits: k.is_multiple_of(5).then_some(2),
    }
}

/// True traces with few events of every kind.
fn samples() -> Vec<Vec<Record>> {
    let families = PslgFamily::all();
    let mut samples = Vec::new();
    for k in 0..72 {
        let graph = pslg(families[k % families.len()], 4 + k % 7, &mut SplitMix64(k as u64 + 1000));
        let prepared = prepare::<FastKernel>(&graph, &Lines::default());
        if prepared.has_errors() {
            continue;
        }
        if let Some(trace) = records(&prepared.pslg, &parameters(k), 60) {
            let accepted = matches!(verify(&trace, STRICT), Verdict::Accepted { .. });
            assert!(accepted, "sample {k} is refused as it is");
            samples.push(trace);
        }
    }
    samples
}

/// Whether the rest of a trace is refused by a checker that has accepted what precedes it.
fn refused_after(mut checker: Checker, rest: &[Record]) -> bool {
    for record in rest {
        if checker.push(record).is_err() {
            return true;
        }
    }
    matches!(checker.finish(), Verdict::Rejected(_))
}

/// Whether a trace is refused.
fn refused(trace: &[Record]) -> bool {
    refused_after(Checker::new(STRICT), trace)
}

fn ulp(x: &mut f64, up: bool) {
    *x = if up { x.next_up() } else { x.next_down() };
}

/// Every single-field change of an event, with the name of the field.
fn changes(event: &Event, vertices: u32) -> Vec<(&'static str, Event)> {
    let mut all: Vec<(&'static str, Event)> = Vec::new();
    let mut add = |name, edit: &dyn Fn(&mut Event)| {
        let mut changed = event.clone();
        edit(&mut changed);
        if changed != *event {
            all.push((name, changed));
        }
    };
    let other = |v: VertexId| VertexId((v.0 + 1) % vertices);
    let causes = [Cause::Skinny, Cause::Area, Cause::Size { h: 1e-9 }];
    match event {
        Event::Insert { why, destroyed, .. } => {
            for up in [false, true] {
                add("insert p.x", &|e| {
                    if let Event::Insert { p, .. } = e {
                        ulp(&mut p.x, up)
                    }
                });
                add("insert p.y", &|e| {
                    if let Event::Insert { p, .. } = e {
                        ulp(&mut p.y, up)
                    }
                });
            }
            add("insert p zero", &|e| {
                if let Event::Insert { p, .. } = e {
                    *p = -*p
                }
            });
            for i in 0..destroyed.len() {
                for k in 0..3 {
                    add("insert destroyed", &|e| {
                        if let Event::Insert { destroyed, .. } = e {
                            destroyed[i][k] = other(destroyed[i][k])
                        }
                    });
                }
                add("insert destroyed less", &|e| {
                    if let Event::Insert { destroyed, .. } = e {
                        let _ = destroyed.remove(i);
                    }
                });
                add("insert destroyed rotated", &|e| {
                    if let Event::Insert { destroyed, .. } = e {
                        destroyed[i].rotate_left(1)
                    }
                });
                add("insert destroyed order", &|e| {
                    if let Event::Insert { destroyed, .. } = e {
                        destroyed.swap(0, i)
                    }
                });
            }
            add("insert destroyed more", &|e| {
                if let Event::Insert { destroyed, .. } = e {
                    destroyed.extend(destroyed.first().copied())
                }
            });
            for cause in causes {
                add("insert cause", &|e| {
                    if let Event::Insert { why: Why::Free { cause: c } | Why::Split { cause: c, .. }, .. } = e {
                        *c = cause
                    }
                });
            }
            if let Why::Split { .. } = why {
                let mut split = |name, edit: &dyn Fn(&mut Why)| {
                    add(name, &|e| {
                        if let Event::Insert { why, .. } = e {
                            edit(why)
                        }
                    })
                };
                for up in [false, true] {
                    split("split a.x", &|w| {
                        if let Why::Split { a, .. } = w {
                            ulp(&mut a.x, up)
                        }
                    });
                    split("split a.y", &|w| {
                        if let Why::Split { a, .. } = w {
                            ulp(&mut a.y, up)
                        }
                    });
                }
                for k in 0..2 {
                    split("split s", &|w| {
                        if let Why::Split { s, .. } = w {
                            s[k] = other(s[k])
                        }
                    });
                }
                split("split s swapped", &|w| {
                    if let Why::Split { s, .. } = w {
                        s.swap(0, 1)
                    }
                });
                for k in 0..3 {
                    split("split t", &|w| {
                        if let Why::Split { t, .. } = w {
                            t[k] = other(t[k])
                        }
                    });
                }
                split("split kind", &|w| {
                    if let Why::Split { kind, .. } = w {
                        *kind = match *kind {
                            SplitKind::B => SplitKind::C { parent: VertexId(0) },
                            SplitKind::C { .. } => SplitKind::B,
                        }
                    }
                });
                split("split parent", &|w| {
                    if let Why::Split { kind: SplitKind::C { parent }, .. } = w {
                        *parent = other(*parent)
                    }
                });
                split("split shell", &|w| {
                    if let Why::Split { shell, s, .. } = w {
                        *shell = match *shell {
                            None => Some(Shell { apex: s[0], k: 0 }),
                            Some(_) => None,
                        }
                    }
                });
                split("shell k", &|w| {
                    if let Why::Split { shell: Some(shell), .. } = w {
                        shell.k += 1
                    }
                });
                split("shell apex", &|w| {
                    if let Why::Split { shell: Some(shell), .. } = w {
                        shell.apex = other(shell.apex)
                    }
                });
                split("split to free", &|w| {
                    if let Why::Split { cause, .. } = w {
                        *w = Why::Free { cause: *cause }
                    }
                });
            }
        }
        Event::Remove { created, .. } => {
            add("remove id", &|e| {
                if let Event::Remove { id, .. } = e {
                    *id = other(*id)
                }
            });
            for i in 0..created.len() {
                for k in 0..3 {
                    add("remove created", &|e| {
                        if let Event::Remove { created, .. } = e {
                            created[i][k] = other(created[i][k])
                        }
                    });
                }
                add("remove created less", &|e| {
                    if let Event::Remove { created, .. } = e {
                        let _ = created.remove(i);
                    }
                });
                add("remove created order", &|e| {
                    if let Event::Remove { created, .. } = e {
                        created.swap(0, i)
                    }
                });
            }
            add("remove created more", &|e| {
                if let Event::Remove { created, .. } = e {
                    created.extend(created.first().copied())
                }
            });
        }
        Event::Skip { .. } => {
            for k in 0..3 {
                add("skip t", &|e| {
                    if let Event::Skip { t, .. } = e {
                        t[k] = other(t[k])
                    }
                });
            }
            for c in causes {
                add("skip cause", &|e| {
                    if let Event::Skip { cause, .. } = e {
                        *cause = c
                    }
                });
            }
            let reasons = [
                SkipReason::Resolution,
                SkipReason::InputAngle { apex: VertexId(0) },
                SkipReason::InputAngle { apex: VertexId(1) },
                SkipReason::SplitLimit { segment: SegmentId(0) },
                SkipReason::SplitLimit { segment: SegmentId(1) },
            ];
            for r in reasons {
                add("skip reason", &|e| {
                    if let Event::Skip { reason, .. } = e {
                        *reason = r
                    }
                });
            }
        }
    }
    all
}

#[test]
fn every_changed_field_is_refused() {
    let mut seen = std::collections::BTreeMap::<&str, u32>::new();
    for trace in samples() {
        let vertices = trace.iter().filter(|r| matches!(r, Record::Vertex { .. })).count() as u32;
        let mut checker = Checker::new(STRICT);
        for (i, record) in trace.iter().enumerate() {
            if let Record::Event(event) = record {
                for (name, changed) in changes(event, vertices.max(4)) {
                    let mut rest = trace[i..].to_vec();
                    rest[0] = Record::Event(changed);
                    assert!(
                        refused_after(checker.clone(), &rest),
                        "accepted with {name} changed: {event:?} to {:?}",
                        rest[0]
                    );
                    *seen.entry(name).or_default() += 1;
                }
            }
            assert!(checker.push(record).is_ok());
        }
    }
    eprintln!("{seen:?}");
    for name in [
        "insert p.x",
        "split a.y",
        "split parent",
        "shell k",
        "shell apex",
        "remove created",
        "remove id",
        "skip reason",
        "skip cause",
    ] {
        assert!(seen.get(name).is_some_and(|&n| n > 0), "no sample has {name}");
    }
}

#[test]
fn every_changed_end_is_refused() {
    for trace in samples() {
        let last = trace.len() - 1;
        let Record::End(end) = &trace[last] else { panic!("a trace without end") };
        let mut variants = Vec::new();
        for k in 0..7 {
            let mut e = end.clone();
            let c = &mut e.counts;
            *[
                &mut c.vertices,
                &mut c.triangles,
                &mut c.type_a,
                &mut c.type_b,
                &mut c.type_c,
                &mut c.removed,
                &mut c.unmet,
            ][k] += 1;
            variants.push(e);
        }
        for outcome in [Outcome::Complete, Outcome::Holey, Outcome::Stopped] {
            let mut e = end.clone();
            e.outcome = outcome;
            variants.push(e);
        }
        for level in [None, Some(Level::Outside), Some(Level::Admissible), Some(Level::Graded)] {
            let mut e = end.clone();
            e.level_effective = level;
            variants.push(e);
        }
        for e in variants.into_iter().filter(|e| e != end) {
            let mut mutant = trace.clone();
            mutant[last] = Record::End(e);
            assert!(refused(&mutant), "accepted: {:?}", mutant[last]);
        }
    }
}

#[test]
fn events_dropped_doubled_swapped_or_cut_off_are_refused() {
    for trace in samples() {
        let mut checker = Checker::new(STRICT);
        for (i, record) in trace.iter().enumerate() {
            if let Record::Event(_) = record {
                let rest = &trace[i..];
                assert!(refused_after(checker.clone(), &rest[1..]), "accepted without {record:?}");
                let doubled = [&rest[..1], rest].concat();
                assert!(refused_after(checker.clone(), &doubled), "accepted with twice {record:?}");
                assert!(refused_after(checker.clone(), &[]), "accepted cut off at {record:?}");
                if let Record::Event(_) = rest[1] {
                    let mut swapped = rest.to_vec();
                    swapped.swap(0, 1);
                    assert!(refused_after(checker.clone(), &swapped), "accepted with {record:?} after its successor");
                }
            }
            assert!(checker.push(record).is_ok());
        }
    }
}

/// How many random mutations; the long runs set the variable.
fn mutations() -> usize {
    std::env::var("ORTHOBALL_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(2_000)
}

#[test]
fn random_mutations_are_refused() {
    let samples = samples();
    let mut draw = SplitMix64(7);
    let mut below = |n: usize| draw.below(n as u32) as usize;
    let mut done = 0;
    while done < mutations() {
        let mut mutant = samples[below(samples.len())].clone();
        let first = mutant.iter().position(|r| matches!(r, Record::Event(_)));
        let Some(first) = first else { continue };
        let events = mutant.len() - 1 - first;
        let i = first + below(events);
        let original = mutant.clone();
        match below(6) {
            0 => drop(mutant.remove(i)),
            1 => mutant.insert(first + below(events), mutant[i].clone()),
            2 => mutant.swap(i, first + below(events)),
            3 => mutant[i] = samples[below(samples.len())][first.min(9)].clone(),
            _ => {
                // One to three fields of one event.
                for _ in 0..=below(3) {
                    let Record::Event(event) = &mutant[i] else {
                        break;
                    };
                    let all = changes(event, 4 + below(60) as u32);
                    if !all.is_empty() {
                        mutant[i] = Record::Event(all[below(all.len())].1.clone());
                    }
                }
            }
        }
        if mutant != original {
            assert!(refused(&mutant), "accepted: a mutant of event {}", i - first);
            done += 1;
        }
    }
    eprintln!("{done} mutations refused");
}
