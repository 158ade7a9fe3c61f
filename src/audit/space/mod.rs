//! The audit of a tetrahedral mesh, whoever made it.
//!
//! Each claim is tested from its definition, exactly, with located witnesses where it fails; of the checker it takes numbers, predicates and the
//! matching of facets, of the producer nothing. *The points* are those of the file; *sites* are points with weights.
//!
//! - `valid`: coordinates are finite, indices exist, no cell is degenerate, and any two cells meet in a common vertex, edge or facet, or not at
//!   all. How: cells turned positive, no oriented facet belongs to two of them; the border is embedded (`border`, with the proof).
//! - `orientation`: every cell a, b, c, d is positive in the file: d lies where a, b, c turn counterclockwise.
//! - `delaunay`: no vertex of the mesh strictly inside the circumsphere of any cell, and no point of the file that is left out inside a cell.
//! - `regular`: the same for orthospheres. A point that is left out may lie in a cell if it is hidden: not strictly inside the orthosphere.
//! - `canonical`: as `regular`, ties decided by the one symbolic perturbation: the mesh is the only one of its kind.
//! - `hull`: the cells fill the convex hull of the points, and each point is a vertex, at the place of one, or hidden.
//! - `quality`: every cell has a circumradius below rho times its shortest edge; without a rho, figures are told.
//! - `topology`: figures, told.
//!
//! The three claims of empty spheres are tested across every facet (`spheres`), which suffices where the cells fill a convex region; elsewhere
//! the spheres at the border are searched as well, which suffices again (proof there). Points left out that lie in no cell are counted, and
//! violate `hull` alone.
//!
//! A claim that rests on a violated `valid` is violated if a witness is found, else unchecked. Unchecked is also everything about coordinates of
//! sizes so different that no scaling by a power of two holds them all, and the border of a mesh whose facets' boxes overlap beyond all
//! measure (`border::PAIRS`).
//!
//! Time: linear in the cells for all claims of a mesh that fills a star-shaped region (a convex one is) and leaves no point out. Otherwise a
//! tree of boxes over the border, the vertices or the points left out adds a logarithm.

mod border;
mod complex;
mod figures;
mod hull;
mod isolated;
mod meet;
mod report;
mod spheres;
#[cfg(test)]
mod tests;

pub use report::{Claim, ClaimReport, Report, Witness};

use super::report::Verdict;
use crate::check::space::glue::Fringe;
use crate::model::{Point3, VertexId};
use border::Border;
use complex::{Complex, Orientations};
use isolated::Isolated;
use spheres::Spheres;

/// A mesh to be audited, as found in a file. Indices may be wrong, numbers not finite.
#[derive(Clone, Debug, Default)]
pub struct Subject<'a> {
    /// Coordinates in the units of the file.
    pub points: &'a [Point3],
    /// Weight of each point, in squared units; empty: all are 0.
    pub weights: &'a [f64],
    /// Corners of each cell.
    pub cells: &'a [[VertexId; 4]],
    /// Line of each point, one-based; may be empty.
    pub point_lines: &'a [u32],
    /// Line of each cell, one-based; may be empty.
    pub cell_lines: &'a [u32],
}

/// What is to be tested.
#[derive(Clone, Debug)]
pub struct Options<'a> {
    /// The claims, each once.
    pub claims: &'a [Claim],
    /// The quality claimed: every cell has a circumradius below this many times its shortest edge.
    pub radius_edge: Option<f64>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options { claims: &Claim::ALL, radius_edge: None }
    }
}

/// Audits a mesh.
pub fn audit(subject: &Subject<'_>, options: &Options<'_>) -> Report {
    // Where spheres are tested, orientations come with them; that all are positive, as nearly always, is taken for granted until then.
    let granted = options.claims.iter().any(|c| Spheres::is_about(*c));
    let report = granted.then(|| audit_taking(subject, options, Orientations::Granted)).flatten();
    // Tested orientations are never found wrong later.
    report.or_else(|| audit_taking(subject, options, Orientations::Tested)).unwrap_or(Report { claims: Vec::new() })
}

/// Audits a mesh; nothing if an orientation that was granted is not positive.
fn audit_taking(subject: &Subject<'_>, options: &Options<'_>, orientations: Orientations) -> Option<Report> {
    let asked = |claims: &[Claim]| claims.iter().any(|c| options.claims.contains(c));
    // These two ask of single cells.
    let linked = options.claims.iter().any(|c| !matches!(c, Claim::Orientation | Claim::Quality));
    let (complex, mut valid) = Complex::new(subject, orientations);
    let mut spheres: Vec<Spheres<'_>> = options.claims.iter().filter_map(|&c| Spheres::new(&complex, c)).collect();
    let fringe = if linked {
        complex.link(&mut valid, |fan| spheres.iter_mut().for_each(|s| s.see(fan)))
    } else {
        Fringe::default()
    };
    // On a complex with faults the border means nothing.
    let border =
        (linked && valid.verdict == Verdict::Holds).then(|| Border::examine(&complex, fringe.border, &mut valid));
    let mut spheres = spheres.into_iter();
    let sound = valid.verdict == Verdict::Holds;
    let valid = valid.conclude("any two cells meet in a common vertex, edge or facet, or not at all");
    let isolated = if asked(&[Claim::Delaunay, Claim::Regular, Claim::Canonical, Claim::Hull]) {
        Isolated::of(&complex, fringe.is_used)
    } else {
        Isolated::default()
    };
    let mut claims = Vec::new();
    for &claim in options.claims {
        let border = border.as_ref();
        let mut report = match claim {
            Claim::Valid => valid.clone(),
            Claim::Orientation => complex::orientation(&complex),
            // They stand in the order of the claims.
            Claim::Delaunay | Claim::Regular | Claim::Canonical => spheres.next()?.empty(border, &isolated)?,
            Claim::Hull => hull::hull(&complex, border, &isolated),
            Claim::Quality => figures::quality(&complex, options.radius_edge),
            Claim::Topology => figures::topology(&complex, border),
        };
        let rests_on_valid = !matches!(claim, Claim::Valid | Claim::Orientation | Claim::Quality);
        if !sound && rests_on_valid && report.verdict == Verdict::Holds {
            report.verdict = Verdict::Unchecked;
            report.message = format!("{}; but the mesh is not known to be a valid complex", report.message);
        }
        // Of points that belong to no cell only hull says that they are outside; what spheres have found stays found.
        let lacks_points = match claim {
            Claim::Hull => true,
            Claim::Delaunay | Claim::Regular | Claim::Canonical => report.verdict != Verdict::Violated,
            _ => false,
        };
        if isolated.is_partial && lacks_points {
            report = ClaimReport::unchecked(claim, "too many points that belong to no cell are close to cells");
        }
        if let (Some(v), true) = (complex.unscalable, report.verdict != Verdict::Told) {
            report = ClaimReport::unchecked(
                claim,
                &format!("vertex {v} and the largest coordinate or weight are too far apart in size for doubles"),
            );
        }
        claims.push(report);
    }
    Some(Report { claims })
}
