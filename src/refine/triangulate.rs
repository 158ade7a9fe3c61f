//! The constrained Delaunay triangulation of an input as a run of its own: nothing is refined, the whole hull is kept.

use super::gcdr::output::{canonical_triangles, mesh_of, write_domain};
use super::{Run, RunError};
use crate::arith::Kernel;
use crate::domain::normalise;
use crate::model::{Level, Lines, Pslg, VertexKind};
use crate::trace::{Algorithm, Counts, End, Header, Outcome, Record, Sink, mesh_digest};
use crate::triangulation::cdt2::Cdt2;

/// Triangulates the convex hull of the points, with the segments of a repaired graph as edges, and writes the trace.
///
/// Holes, regions and `fill` are not looked at. Errors: see `RunError`; fewer than three points, or all on one line, is one.
pub fn triangulate<K: Kernel>(pslg: &Pslg, sink: &mut dyn Sink) -> Result<Run, RunError> {
    let (points, scale) = normalise(&pslg.points, &Lines::default()).map_err(RunError::Range)?;
    let mut cdt = Cdt2::<K>::delaunay(points)?;
    let segments: Vec<_> = pslg.segments.iter().map(|s| s.ends).collect();
    cdt.constrain(&segments)?;
    let start = canonical_triangles(&cdt);
    sink.record(&Record::Header(Header { algorithm: Algorithm::Delaunay, level: None, fill: pslg.fill }))?;
    write_domain(pslg, &start, sink)?;
    let unlabelled = Pslg { regions: Vec::new(), ..pslg.clone() };
    let (mesh, _) = mesh_of(&cdt, scale, &vec![VertexKind::Input; cdt.vertex_count()], &unlabelled);
    let counts =
        Counts { vertices: mesh.points.len() as u32, triangles: mesh.triangles.len() as u32, ..Counts::default() };
    sink.record(&Record::End(End {
        outcome: Outcome::Complete,
        stop_reason: None,
        level_effective: None,
        counts,
        mesh: mesh_digest(&mesh),
        trace: String::new(),
    }))?;
    Ok(Run {
        mesh,
        outcome: Outcome::Complete,
        stop_reason: None,
        level: Level::Outside,
        level_effective: Level::Outside,
        counts,
        unmet: Vec::new(),
        events: 0,
    })
}
