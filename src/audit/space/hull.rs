//! The claim that a mesh fills the convex hull of the points and leaves none out.

use super::border::Border;
use super::complex::Complex;
use super::isolated::Isolated;
use super::report::{Claim, ClaimReport};
use crate::audit::report::Verdict;
use crate::check::space::predicates::side;
use crate::model::Sign;

/// Convex, and every point is a vertex, at the place of one, or hidden by its weight.
pub(super) fn hull(complex: &Complex<'_>, border: Option<&Border<'_>>, isolated: &Isolated) -> ClaimReport {
    let subject = complex.subject;
    let mut report = ClaimReport::new(Claim::Hull);
    for &v in &isolated.broken {
        report.violated(subject, &[v], &[], || format!("vertex {v} is not finite"));
    }
    for &v in &isolated.outside {
        report.violated(subject, &[v], &[], || format!("vertex {v} lies in no cell"));
    }
    let mut hidden = 0;
    for &(v, t) in &isolated.held {
        if side(&complex.corners(t), &complex.sites[v as usize]) == Sign::Positive {
            let file = complex.in_file[t as usize];
            report.violated(subject, &[v], &[file], || {
                format!("vertex {v} lies in cell {file}, is not hidden there, and belongs to no cell")
            });
        } else {
            hidden += 1;
        }
    }
    let Some(border) = border else {
        if report.verdict == Verdict::Holds {
            report.verdict = Verdict::Unchecked;
            report.message = "the mesh is not known to be a valid complex".into();
        }
        return report.conclude("");
    };
    let mut shown = false;
    for edge in border.reflex() {
        shown = true;
        let (vertices @ [u, v, ..], cells) = border.around(edge);
        report.violated(subject, &vertices, &cells, || {
            let [a, b] = cells;
            format!("the border is not convex at edge {u}-{v}, between cells {a} and {b}")
        });
    }
    if border.is_embedded && !border.is_convex && !shown {
        let (_, parts) = border.components();
        report.violated(subject, &[], &[], || {
            format!("the border has {parts} components, and {} edges of more than two facets", border.branching_edges())
        });
    }
    report.figures =
        vec![("border_facets", border.facets.len() as f64), ("points_hidden_or_doubled", f64::from(hidden))];
    report.conclude("the cells fill the convex hull of all points")
}
