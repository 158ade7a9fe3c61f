//! The audit against the triangulation: what one builds the other accepts, and one flipped edge is noticed.

use orthoball::arith::FastKernel;
use orthoball::audit::{Claim, Options, Report, Subject, Verdict, audit};
use orthoball::model::{Point2, VertexId};
use orthoball::triangulation::cdt2::Cdt2;
use proptest::prelude::*;

fn audited(points: &[Point2], triangles: &[[VertexId; 3]], claims: &[Claim]) -> Report {
    let subject = Subject { points, triangles, ..Subject::default() };
    audit(&subject, &Options { claims, ..Options::default() })
}

fn verdicts(report: &Report) -> Vec<Verdict> {
    report.claims.iter().map(|c| c.verdict).collect()
}

/// Points of a small grid (many cocircular), normalised.
fn grid() -> impl Strategy<Value = Vec<Point2>> {
    let all: Vec<Point2> = (0..36).map(|i| Point2::new(f64::from(i % 6) / 8.0, f64::from(i / 6) / 8.0)).collect();
    prop::sample::subsequence(all, 4..20).prop_shuffle()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn delaunay_triangulations_pass_and_flipped_ones_do_not(points in grid(), pick in any::<prop::sample::Index>()) {
        let Ok(cdt) = Cdt2::<FastKernel>::delaunay(points.clone()) else { return Ok(()) };
        let mut triangles: Vec<[VertexId; 3]> = cdt.triangles().map(|t| cdt.vertices(t)).collect();
        let claims = [Claim::Valid, Claim::Orientation, Claim::Delaunay, Claim::Constrained, Claim::Canonical];
        prop_assert_eq!(verdicts(&audited(&points, &triangles, &claims)), [Verdict::Holds; 5]);

        // Flip an inner edge: (a, b, c), (b, a, d) become (a, d, c), (d, b, c).
        let ids: Vec<_> = cdt.triangles().collect();
        let place = |t| ids.iter().position(|&x| x == t);
        let inner: Vec<_> = ids.iter().flat_map(|&t| cdt.edges(t)).filter(|&e| cdt.twin(e).is_some()).collect();
        if inner.is_empty() { return Ok(()); }
        let e = inner[pick.index(inner.len())];
        let Some(f) = cdt.twin(e) else { return Ok(()) };
        let (a, b, c, d) = (cdt.origin(e), cdt.destination(e), cdt.apex(e), cdt.apex(f));
        let (Some(i), Some(j)) = (place(cdt.triangle_of(e)), place(cdt.triangle_of(f))) else { return Ok(()) };
        triangles[i] = [a, d, c];
        triangles[j] = [d, b, c];
        let report = audited(&points, &triangles, &[Claim::Valid, Claim::Canonical]);
        // In a convex quadrilateral the flip is valid and not canonical; else it is not valid.
        let violated = verdicts(&report).iter().filter(|&&v| v == Verdict::Violated).count();
        prop_assert!(violated > 0, "{}", report);
    }
}
