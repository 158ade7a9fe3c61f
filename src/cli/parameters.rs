//! From what was typed to the parameters of a run. Parameters that the run will not use are absent.

use super::Failure;
use super::args::{ChoiceArgs, MeshArgs};
use crate::arith::angle::{kappa, rho2_from_min_angle};
use crate::model::{Choice, DiskChoice, GcdrParameters, Level};
use crate::refine::least_d2;

/// The parameters of `mesh`. Errors: an angle or bound that no triangle can meet; a promise that the angle does not allow.
pub fn parameters(args: &MeshArgs) -> Result<GcdrParameters, Failure> {
    let rho2 = rho2(args)?;
    let chosen = choices(args);
    let (choice_a, choice_b, choice_c) = chosen;
    let offcenter = matches!(choice_a, DiskChoice::Offcenter | DiskChoice::ClampedOffcenter);
    let segments = [choice_b, choice_c];
    let extreme = choice_a == DiskChoice::Extreme || segments.contains(&Choice::Extreme);
    let random = choice_a == DiskChoice::Random || segments.contains(&Choice::Random);
    let ChoiceArgs { d1, mu, order, deletion, small_angles, .. } = args.choices;
    let extreme = extreme.then_some(args.choices.extreme);
    let draws = random || extreme == Some(crate::model::VertexOfTriangle::Seeded);
    Ok(GcdrParameters {
        rho2,
        d1,
        d2: d2(args, rho2)?,
        mu,
        choice_a,
        choice_b,
        choice_c,
        kappa: offcenter.then(|| kappa(rho2)),
        extreme,
        seed: draws.then_some(args.choices.seed),
        order,
        deletion,
        small_angles,
        max_area: args.quality.max_area,
        size_function: false,
        max_splits: args.quality.max_splits,
    })
}

fn rho2(args: &MeshArgs) -> Result<f64, Failure> {
    // 1/3 is the squared ratio of the equilateral triangle, 0.34 the least that `gcdr` takes: an angle of some 59 degrees.
    let rho2 = match args.quality.rho2 {
        Some(rho2) => rho2,
        None => {
            rho2_from_min_angle(args.quality.min_angle).map_err(|e| Failure::new(format_args!("--min-angle: {e}")))?
        }
    };
    if !(0.34..=1e30).contains(&rho2) {
        return Err(match args.quality.rho2 {
            Some(rho2) => Failure::new(format_args!("--rho2 {rho2}: must lie in [0.34, 1e30]")),
            None => Failure::new(format_args!(
                "--min-angle {}: must lie between 0 and 59 degrees; above 30 a run may not end by itself",
                args.quality.min_angle
            )),
        });
    }
    Ok(rho2)
}

/// delta2 as typed, else the least that the promise allows, else 1.
fn d2(args: &MeshArgs, rho2: f64) -> Result<f64, Failure> {
    if let Some(d2) = args.choices.d2 {
        return Ok(d2);
    }
    let Some(level) = args.quality.promise else {
        return Ok(1.0);
    };
    least_d2(rho2, level).ok_or_else(|| {
        let (name, least) = match level {
            Level::Graded => ("graded", "rho2 above 1.25, an angle below 26.56 degrees"),
            _ => ("admissible", "rho2 of at least 1, an angle of at most 30 degrees"),
        };
        Failure::new(format_args!("--promise {name} needs {least}"))
    })
}

/// Off-centers inside unless chosen otherwise, clamped where a promise has to be kept; midpoints on segments.
fn choices(args: &MeshArgs) -> (DiskChoice, Choice, Choice) {
    let typed = &args.choices;
    let everyday = if args.quality.promise.is_some() { DiskChoice::ClampedOffcenter } else { DiskChoice::Offcenter };
    let a = typed.choice.or(typed.choice_a).unwrap_or(everyday);
    let on_segments = match typed.choice {
        Some(DiskChoice::Extreme) => Choice::Extreme,
        Some(DiskChoice::Random) => Choice::Random,
        _ => Choice::Center,
    };
    (a, typed.choice_b.unwrap_or(on_segments), typed.choice_c.unwrap_or(on_segments))
}
