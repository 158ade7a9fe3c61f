//! The level of a run, decided from its parameters and the angles of its input. Source: `docs/gcdr.md`, section 2.

use super::complex::{Complex, Kind, NONE, previous};
use super::condition::is_below_60;
use super::predicates::{dot, norm2, orient, vector};
use super::rows::Deltas;
use super::value::{Exact, Number, exact_sign, sign_of};
use crate::model::{DiskChoice, GcdrParameters, Level, Point2, Sign};

/// A sector of the region at an input vertex between consecutive segments, narrower than 180 degrees: the vertex, the right and the left neighbor.
pub type Sector = [u32; 3];

/// All sectors of the initial triangulation.
pub fn sectors(mesh: &Complex) -> Vec<Sector> {
    let mut found = Vec::new();
    for v in 0..mesh.vertices.len() as u32 {
        if mesh.vertices[v as usize].kind != Kind::Input {
            continue;
        }
        for e in mesh.star(v).filter(|&e| mesh.segment(e) != NONE && mesh.inside(e).is_some()) {
            let mut turned = e;
            while mesh.segment(previous(turned)) == NONE {
                turned = mesh.beyond(previous(turned));
            }
            let sector = [v, mesh.target(e), mesh.origin(previous(turned))];
            let [at, right, left] = sector.map(|v| mesh.at(v));
            if orient(at, right, left).is_positive() {
                found.push(sector);
            }
        }
    }
    found
}

/// Which vertices have a sector below 60 degrees.
pub fn apexes(mesh: &Complex, sectors: &[Sector]) -> Vec<bool> {
    let mut apexes = vec![false; mesh.vertices.len()];
    for sector in sectors {
        let [at, right, left] = sector.map(|v| mesh.at(v));
        apexes[sector[0] as usize] |= is_below_60(at, right, left);
    }
    apexes
}

/// mu^2 u^2 v^2 - 4 (u.v)^2.
fn angle_excess<N: Number>(mu: f64, at: Point2, right: Point2, left: Point2) -> N {
    let (u, v) = (vector::<N>(at, right), vector::<N>(at, left));
    N::of(mu).square() * norm2(&u) * norm2(&v) - N::of(4.0) * dot(&u, &v).square()
}

fn product<N: Number>(at: Point2, right: Point2, left: Point2) -> N {
    dot(&vector::<N>(at, right), &vector(at, left))
}

/// The level of these parameters on this input.
pub fn level(parameters: &GcdrParameters, deltas: Deltas, mesh: &Complex, sectors: &[Sector]) -> Level {
    let angles = sectors.iter().fold(Level::Graded, |level, sector| {
        let [at, right, left] = sector.map(|v| mesh.at(v));
        if !sign_of!(product(at, right, left)).is_positive() {
            return level;
        }
        level.min(match sign_of!(angle_excess(deltas.mu, at, right, left)) {
            Sign::Positive => Level::Graded,
            Sign::Zero => Level::Admissible,
            Sign::Negative => Level::Outside,
        })
    });
    angles.min(level_of_parameters(parameters, deltas))
}

fn level_of_parameters(parameters: &GcdrParameters, Deltas { d1, d2, mu }: Deltas) -> Level {
    let of = Exact::of;
    let sign = |a: Exact, b: f64| exact_sign(&(a - of(b)));
    let at_least = |a: Exact, b: f64| !sign(a, b).is_negative();
    let in_range = |x: f64| x > 0.0 && x <= 1.0;
    let rho2 = of(parameters.rho2);
    let admissible = parameters.choice_a != DiskChoice::Offcenter
        && [d1, d2, mu].into_iter().all(in_range)
        && at_least(rho2.clone(), 1.0)
        && at_least(rho2.clone() * of(d2).square(), 1.0)
        && at_least(rho2.clone() * of(d1).square() * of(d2).square(), 1.0);
    if !admissible {
        return Level::Outside;
    }
    let cycle = of(d1).square() * of(d2).square() * (rho2.clone() - of(0.25));
    if sign(rho2, 1.0).is_positive() && sign(cycle, 1.0).is_positive() { Level::Graded } else { Level::Admissible }
}
