//! The checker accepts every trace of the refiner: all families, choices, orders and policies.
#![cfg(feature = "generators")]

use orthoball::arith::FastKernel;
use orthoball::arith::angle::{kappa, rho2_from_min_angle};
use orthoball::check::{Options, Verdict, verify};
use orthoball::domain::prepare;
use orthoball::generators::{PslgFamily, SplitMix64, pslg};
use orthoball::model::{
    Choice, DeletionPolicy, DiskChoice, GcdrParameters, Lines, Pslg, QueueOrder, SmallAngles, VertexOfTriangle,
};
use orthoball::refine::{self, gcdr};
use orthoball::trace::{Record, Recorder};

fn records(pslg: &Pslg, params: &GcdrParameters, max_steps: u64) -> Option<Vec<Record>> {
    let mut recorder = Recorder::default();
    let mut options = refine::Options { max_steps, ..refine::Options::default() };
    gcdr::run::<FastKernel>(pslg, params, &mut options, &mut recorder).ok().map(|_| recorder.0)
}

/// Parameters number k of a walk through all choices, with nothing present that is not used.
fn parameters(k: usize) -> GcdrParameters {
    let rho2 = rho2_from_min_angle([20.0, 25.0, 28.0, 30.0][k % 4]).expect("angles in range");
    let choice_a = [
        DiskChoice::Offcenter,
        DiskChoice::Center,
        DiskChoice::Extreme,
        DiskChoice::Random,
        DiskChoice::ClampedOffcenter,
    ][k % 5];
    let choice = [Choice::Center, Choice::Extreme, Choice::Random][k % 3];
    let shrink = [1.0, 0.9, 0.8][k / 2 % 3];
    let offcenter = matches!(choice_a, DiskChoice::Offcenter | DiskChoice::ClampedOffcenter);
    let vertex = [VertexOfTriangle::First, VertexOfTriangle::Newest, VertexOfTriangle::Seeded][k / 5 % 3];
    let extreme = (choice_a == DiskChoice::Extreme || choice == Choice::Extreme).then_some(vertex);
    let draws = choice_a == DiskChoice::Random || choice == Choice::Random || extreme == Some(VertexOfTriangle::Seeded);
    GcdrParameters {
        rho2,
        d1: shrink,
        d2: if offcenter { 0.9 } else { shrink },
        mu: [1.0, 0.6, 0.4][k / 3 % 3],
        choice_a,
        choice_b: choice,
        choice_c: choice,
        kappa: offcenter.then(|| kappa(rho2)),
        extreme,
        seed: draws.then_some(k as u64),
        order: [QueueOrder::ShortestEdge, QueueOrder::WorstFirst, QueueOrder::Fifo][k / 7 % 3],
        deletion: [DeletionPolicy::Segment, DeletionPolicy::Point, DeletionPolicy::Disk][k / 11 % 3],
        small_angles: if k % 4 == 3 { SmallAngles::Off } else { SmallAngles::Shells },
        max_area: k.is_multiple_of(6).then_some(0.01),
        size_function: false,
        max_splits: k.is_multiple_of(10).then_some(3),
    }
}

/// How many cases; the long runs set the variable.
fn cases() -> usize {
    std::env::var("ORTHOBALL_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(600)
}

fn check_all(options: Options) {
    let families = PslgFamily::all();
    let (mut accepted, mut events, mut wrong) = (0, 0, 0);
    for k in 0..cases() {
        let family = families[k % families.len()];
        let graph = pslg(family, 4 + k / families.len() % 9, &mut SplitMix64(k as u64));
        let prepared = prepare::<FastKernel>(&graph, &Lines::default());
        if prepared.has_errors() {
            continue;
        }
        let Some(trace) = records(&prepared.pslg, &parameters(k), 300) else {
            continue;
        };
        match verify(&trace, options) {
            Verdict::Accepted { events: n, .. } => {
                accepted += 1;
                events += n;
            }
            Verdict::Rejected(rejection) => {
                eprintln!("case {k} {family:?}: {rejection}");
                wrong += 1;
            }
        }
    }
    eprintln!("{accepted} traces accepted, {events} events");
    assert!(wrong == 0, "{wrong} true traces rejected");
    assert!(accepted * 2 > cases(), "only {accepted} traces were made");
}

#[test]
fn true_traces_are_accepted() {
    check_all(Options::default());
}

#[test]
fn true_traces_are_accepted_strictly() {
    check_all(Options { strict: true, ..Options::default() });
}
