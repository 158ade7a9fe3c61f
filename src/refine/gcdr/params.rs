//! Ranges of parameters and bounds.

use crate::arith::angle::{AngleOutOfRange, kappa, rho2_from_min_angle};
use crate::arith::scale;
use crate::domain::Scale;
use crate::model::{Choice, DiskChoice, GcdrParameters, Pslg};
use crate::refine::{Options, RunError};

/// Parameters for everyday use: all angles above `min_angle` degrees where the input allows it, with few triangles.
///
/// Unclamped off-centers, midpoints on segments, shortest edge first, shells at small input angles; no theorem is claimed
/// (`Level::Outside`). What is to differ is written `GcdrParameters { max_area: Some(0.1), ..everyday(25.0)? }`.
/// Up to 25 degrees every input known ends soon; above 30 a run may end by its budget only.
pub fn everyday(min_angle: f64) -> Result<GcdrParameters, AngleOutOfRange> {
    let rho2 = rho2_from_min_angle(min_angle)?;
    Ok(GcdrParameters { choice_a: DiskChoice::Offcenter, kappa: Some(kappa(rho2)), ..GcdrParameters::chew(rho2) })
}

/// Refuses parameters outside their ranges.
pub(super) fn validate(params: &GcdrParameters, options: &Options) -> Result<(), RunError> {
    let fraction = |name, value: f64| match value > 0.0 && value <= 1.0 {
        true => Ok(()),
        false => Err(RunError::Parameter { name, value, range: "in (0, 1]" }),
    };
    fraction("d1", params.d1)?;
    fraction("d2", params.d2)?;
    fraction("mu", params.mu)?;
    let positive = |name, value: f64, least: f64, range| match value >= least && value <= 1e30 {
        true => Ok(()),
        false => Err(RunError::Parameter { name, value, range }),
    };
    positive("rho2", params.rho2, 0.34, "in [0.34, 1e30] (1/3 is that of an equilateral triangle)")?;
    let offcenter = matches!(params.choice_a, DiskChoice::Offcenter | DiskChoice::ClampedOffcenter);
    if offcenter {
        positive("kappa", params.kappa.unwrap_or(0.0), 1e-3, "in [0.001, 1e30]")?;
    }
    let user = params.choice_a == DiskChoice::User || [params.choice_b, params.choice_c].contains(&Choice::User);
    if user && options.chooser.is_none() || params.size_function && options.size.is_none() {
        return Err(RunError::MissingFunction);
    }
    Ok(())
}

/// The area bound of each region label in normalised units: of no region, then of each seed.
pub(super) fn area_bounds(pslg: &Pslg, params: &GcdrParameters, scale: Scale) -> Result<Vec<Option<f64>>, RunError> {
    let everywhere = area_bound(params.max_area, scale)?;
    let mut bounds = vec![everywhere];
    for region in &pslg.regions {
        bounds.push(match (area_bound(region.max_area, scale)?, everywhere) {
            (Some(a), Some(b)) => Some(if a < b { a } else { b }),
            (a, b) => a.or(b),
        });
    }
    Ok(bounds)
}

/// An area bound in normalised units; no bound if it is too large to matter.
fn area_bound(area: Option<f64>, scale: Scale) -> Result<Option<f64>, RunError> {
    let Some(value) = area else { return Ok(None) };
    if !value.is_finite() || value <= 0.0 {
        return Err(RunError::Parameter { name: "max_area", value, range: "positive and finite" });
    }
    match in_window(value, -2 * scale.exponent) {
        Some(bound) => Ok(Some(bound)),
        // a normalised domain has an area of at most 4
        None if scale::exponent_of(value) - 2 * scale.exponent > 0 => Ok(None),
        None => Err(RunError::Parameter { name: "max_area", value, range: "at least 2^-400 of the squared extent" }),
    }
}

/// value * 2^shift, exact, if it lies in [2^-400, 2^400].
pub(super) fn in_window(value: f64, shift: i32) -> Option<f64> {
    let fits = value.is_finite() && (scale::exponent_of(value) + shift).abs() < 400;
    fits.then(|| scale::by_power_of_two(value, shift))
}
