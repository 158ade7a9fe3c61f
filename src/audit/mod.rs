//! Beside the floors: the audit of a planar triangle mesh, whoever made it.
//!
//! A mesh makes claims: to be a valid complex, counterclockwise, Delaunay, conforming to an input. Each is tested here from
//! its definition, exactly, with located witnesses where it fails. Shares plain data with the mesher and nothing else.
//!
//! What each claim means:
//! - `valid`: coordinates are finite, indices exist, no triangle is degenerate, no two vertices of triangles coincide, and
//!   any two triangles meet in a common vertex, a common edge, or not at all. How: triangles turned counterclockwise, no
//!   directed edge belongs to two of them; border edges meet at common ends only; the number of triangles over a point,
//!   which is the winding number of the border around it, is 0 or 1 on either side of each border edge. A double cover, a
//!   fold, a hanging vertex and a second mesh laid over the first each break one of these (`border`).
//! - `orientation`: every triangle is counterclockwise in the file.
//! - `delaunay`: no vertex of the mesh strictly inside the circle of any triangle.
//! - `constrained`: the same for vertices that constraints do not hide: of two triangles at an unconstrained edge, neither
//!   has the other's far corner strictly inside its circle. By the constrained Delaunay lemma this suffices for a valid complex.
//! - `canonical`: as `constrained`, ties decided by the one symbolic perturbation: the mesh is the only one of its kind.
//! - `conforming`: see `conforming`.
//! - `quality`: every triangle has a circumradius below rho times its shortest edge; without a rho, figures are told.
//! - `topology`: figures, told.
//!
//! A vertex of the file that belongs to no triangle violates `delaunay`, `constrained` and `canonical` if it lies in a triangle or on its
//! border (`isolated`); one at the place of a corner, or outside of every triangle, is counted and told.
//!
//! A claim that rests on a violated `valid` is violated if a witness is found, else unchecked.

mod border;
mod complex;
mod conforming;
mod delaunay;
mod exact;
mod figures;
mod hull;
mod isolated;
mod report;
pub mod space;
#[cfg(test)]
mod tests;
mod tree;

pub use report::{Claim, ClaimReport, LISTED_WITNESSES, Located, Named, Report, Verdict, Witness};

use crate::model::{Lines, Point2, Pslg, VertexId};
use complex::Complex;
use isolated::Isolated;

/// A mesh to be audited, as found in a file. Indices may be wrong, coordinates not finite.
#[derive(Clone, Debug, Default)]
pub struct Subject<'a> {
    /// Coordinates in the units of the file.
    pub points: &'a [Point2],
    /// Corners of each triangle.
    pub triangles: &'a [[VertexId; 3]],
    /// Region attribute of each triangle; may be empty.
    pub triangle_attributes: &'a [f64],
    /// Edges that the file names as constrained; may be empty.
    pub edges: &'a [[VertexId; 2]],
    /// Line of each point, one-based; may be empty.
    pub point_lines: &'a [u32],
    /// Line of each triangle, one-based; may be empty.
    pub triangle_lines: &'a [u32],
}

/// What is to be tested.
#[derive(Clone, Debug)]
pub struct Options<'a> {
    /// The claims, each once.
    pub claims: &'a [Claim],
    /// The input that the mesh is to conform to, with its lines.
    pub input: Option<(&'a Pslg, &'a Lines)>,
    /// How far a vertex may be off its segment: in units of the last place of the largest coordinate of the mesh.
    pub within: f64,
    /// The quality claimed, as the square of a ratio: every triangle has a circumradius below rho times its shortest edge.
    pub rho2: Option<f64>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options { claims: &Claim::ALL, input: None, within: 2.0, rho2: None }
    }
}

/// Audits a mesh. Time: sorting, and a search tree for `delaunay` where the region is not convex.
pub fn audit(subject: &Subject<'_>, options: &Options<'_>) -> Report {
    let (complex, valid) = Complex::new(subject);
    let sound = valid.verdict == Verdict::Holds;
    let chains = conforming::conforming(&complex, options);
    let isolated = Isolated::of(&complex);
    let mut claims = Vec::new();
    for &claim in options.claims {
        let mut report = match claim {
            Claim::Valid => valid.clone(),
            Claim::Orientation => complex::orientation(&complex),
            Claim::Delaunay => delaunay::delaunay(&complex, &isolated),
            Claim::Constrained => delaunay::constrained(&complex, &chains.constraints, &isolated),
            Claim::Canonical => delaunay::canonical(&complex, &chains.constraints, &isolated),
            Claim::Conforming => chains.report.clone(),
            Claim::Quality => figures::quality(&complex, options.rho2),
            Claim::Topology => figures::topology(&complex),
        };
        if !sound && report.verdict == Verdict::Holds {
            report.verdict = Verdict::Unchecked;
            report.message = format!("{}; but the mesh is not a valid complex", report.message);
        }
        claims.push(report);
    }
    Report { claims }
}
