//! One algorithm, two kernels, the same records; the plain kernel's must differ.
#![cfg(all(feature = "exact", feature = "generators"))]

use orthoball::arith::angle::{kappa, rho2_from_min_angle};
use orthoball::arith::{ExactKernel, FastKernel, Kernel, PlainKernel};
use orthoball::domain::prepare;
use orthoball::generators::{PslgFamily, SplitMix64, pslg};
use orthoball::model::{
    Choice, DeletionPolicy, DiskChoice, GcdrParameters, Lines, Pslg, QueueOrder, SmallAngles, VertexOfTriangle,
};
use orthoball::refine::{Options, gcdr};
use orthoball::trace::{Record, Recorder};

fn records<K: Kernel>(pslg: &Pslg, params: &GcdrParameters, max_steps: u64) -> Result<Vec<Record>, String> {
    let mut recorder = Recorder::default();
    let mut options = Options { max_steps, ..Options::default() };
    match gcdr::run::<K>(pslg, params, &mut options, &mut recorder) {
        Ok(_) => Ok(recorder.0),
        Err(error) => Err(error.to_string()),
    }
}

/// Parameters number k of a walk through orders, choices, policies and angles.
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
    GcdrParameters {
        rho2,
        d1: shrink,
        d2: if offcenter { 0.9 } else { shrink },
        mu: [1.0, 0.6, 0.4][k / 3 % 3],
        choice_a,
        choice_b: choice,
        choice_c: choice,
        kappa: offcenter.then(|| kappa(rho2)),
        extreme: Some([VertexOfTriangle::First, VertexOfTriangle::Newest, VertexOfTriangle::Seeded][k / 5 % 3]),
        seed: Some(k as u64),
        order: [QueueOrder::ShortestEdge, QueueOrder::WorstFirst, QueueOrder::Fifo][k / 7 % 3],
        deletion: [DeletionPolicy::Segment, DeletionPolicy::Point, DeletionPolicy::Disk][k / 11 % 3],
        small_angles: if k % 4 == 3 { SmallAngles::Off } else { SmallAngles::Shells },
        max_area: None,
        size_function: false,
        max_splits: None,
    }
}

/// How many cases; the long runs set the variable.
fn cases() -> usize {
    std::env::var("ORTHOBALL_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(600)
}

#[test]
fn fast_and_exact_agree_and_plain_does_not() {
    let families = PslgFamily::all();
    let (mut compared, mut plain_differs, mut events) = (0, 0, 0);
    for k in 0..cases() {
        let family = families[k % families.len()];
        let mut draw = SplitMix64(k as u64);
        let graph = pslg(family, 4 + k / families.len() % 9, &mut draw);
        let prepared = prepare::<FastKernel>(&graph, &Lines::default());
        if prepared.has_errors() {
            continue;
        }
        let mut params = parameters(k);
        if k % 6 == 0 {
            params.max_area = Some(0.01);
        }
        let fast = records::<FastKernel>(&prepared.pslg, &params, 150);
        let exact = records::<ExactKernel>(&prepared.pslg, &params, 150);
        match (&fast, &exact) {
            (Ok(fast), Ok(exact)) => {
                let at = fast.iter().zip(exact).position(|(a, b)| a != b);
                assert!(
                    at.is_none(),
                    "case {k} {family:?}: records {at:?} differ: {:?} {:?}",
                    at.map(|i| &fast[i]),
                    at.map(|i| &exact[i])
                );
                assert_eq!(fast.len(), exact.len(), "case {k} {family:?}");
                compared += 1;
                events += fast.iter().filter(|r| matches!(r, Record::Event(_))).count();
            }
            (a, b) => assert_eq!(a, b, "case {k} {family:?}"),
        }
        plain_differs += usize::from(records::<PlainKernel>(&prepared.pslg, &params, 150) != fast);
    }
    println!("{compared} cases compared, {events} events, plain differs in {plain_differs}");
    assert!(compared * 2 > cases(), "only {compared} cases were meshed");
    assert!(plain_differs * 4 > compared, "the control differed in {plain_differs} of {compared} cases only");
}
