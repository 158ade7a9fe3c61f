//! What a run may promise. Source: \[GCDR\] Definitions 3.1-3.3 and Theorem 5.5, as corrected in `docs/errata.md` (E2, E18-E20).

use super::gcdr::shells::convex_sectors;
use crate::arith::{Dyadic, Kernel};
use crate::model::{DiskChoice, GcdrParameters, Level, Point2, VertexId};
use crate::triangulation::cdt2::Cdt2;
use std::cmp::Ordering;

/// An angle of the input inside the region: its apex and a point on each side.
pub(super) type Sector = [Point2; 3];

/// The sectors below a half turn between consecutive segments around their common endpoints.
pub(super) fn sectors_of<K: Kernel>(cdt: &Cdt2<K>) -> Vec<Sector> {
    let apexes = (0..cdt.vertex_count() as u32).map(VertexId);
    apexes
        .flat_map(|v| convex_sectors(cdt, v).into_iter().map(move |pair| (v, pair)))
        .map(|(v, [a, b])| [cdt.point(v), cdt.point(cdt.destination(a)), cdt.point(cdt.origin(b))])
        .collect()
}

/// The level that parameters and angles allow, decided exactly.
pub(super) fn level_of(params: &GcdrParameters, sectors: &[Sector]) -> Level {
    if matches!(params.choice_a, DiskChoice::Offcenter) {
        return Level::Outside;
    }
    let by_parameters = level_of_parameters(params);
    if by_parameters == Level::Outside {
        return Level::Outside;
    }
    let angles = sectors.iter().map(|s| level_of_angle(params.mu, *s)).min().unwrap_or(Level::Graded);
    by_parameters.min(angles)
}

/// The level that rho, delta1 and delta2 allow.
fn level_of_parameters(params: &GcdrParameters) -> Level {
    let [rho2, d1, d2] = [params.rho2, params.d1, params.d2].map(exact);
    let one = exact(1.0);
    let square = |x: &Dyadic| x * x;
    let d12 = &square(&d1) * &square(&d2);
    let graded = rho2 > one && &d12 * &(&rho2 - &exact(0.25)) > one;
    let admissible = rho2 >= one && &rho2 * &square(&d2) >= one && &rho2 * &d12 >= one;
    match (graded, admissible) {
        (true, true) => Level::Graded,
        (false, true) => Level::Admissible,
        (_, false) => Level::Outside,
    }
}

/// The level that one angle allows: graded if mu^2 u^2 v^2 > 4 (u.v)^2, admissible if equal; no condition if u.v <= 0.
fn level_of_angle(mu: f64, [apex, p, q]: Sector) -> Level {
    let coordinates = |p: Point2| [exact(p.x), exact(p.y)];
    let (o, p, q) = (coordinates(apex), coordinates(p), coordinates(q));
    let minus = |a: &[Dyadic; 2]| [&a[0] - &o[0], &a[1] - &o[1]];
    let dot = |a: &[Dyadic; 2], b: &[Dyadic; 2]| &(&a[0] * &b[0]) + &(&a[1] * &b[1]);
    let (u, v) = (minus(&p), minus(&q));
    let uv = dot(&u, &v);
    if uv <= exact(0.0) {
        return Level::Graded;
    }
    let twice = &uv * &exact(2.0);
    let mu = exact(mu);
    let left = &(&mu * &mu) * &(&dot(&u, &u) * &dot(&v, &v));
    match left.cmp(&(&twice * &twice)) {
        Ordering::Greater => Level::Graded,
        Ordering::Equal => Level::Admissible,
        Ordering::Less => Level::Outside,
    }
}

/// The least delta2 with which rho2 and delta1 = 1 reach a level; `None` if none does.
pub fn least_d2(rho2: f64, level: Level) -> Option<f64> {
    let reaches = |d2: f64| {
        let [rho2, d2] = [rho2, d2].map(exact);
        let one = exact(1.0);
        let d22 = &d2 * &d2;
        match level {
            Level::Graded => rho2 > one && &d22 * &(&rho2 - &exact(0.25)) > one,
            Level::Admissible => rho2 >= one && &rho2 * &d22 >= one,
            Level::Outside => true,
        }
    };
    if !reaches(1.0) {
        return None;
    }
    // bisection over the f64s of (0, 1]: positive floats are ordered as their bits
    let (mut low, mut high) = (0u64, 1.0f64.to_bits());
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if reaches(f64::from_bits(middle)) { high = middle } else { low = middle }
    }
    Some(f64::from_bits(high))
}

/// A parameter or coordinate as an exact number; both have been found finite.
fn exact(x: f64) -> Dyadic {
    Dyadic::from_f64(x).unwrap_or_else(|| Dyadic::integer(0))
}
