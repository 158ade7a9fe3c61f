//! `check`: the audit of a mesh made by anyone.

use super::args::CheckArgs;
use super::files::read_mesh;
use super::input::load;
use super::{Answer, Failure, Status, data};
use crate::arith::angle::rho2_from_min_angle;
use crate::audit::{Claim, Options, Subject, audit};
use serde_json::json;

/// What is checked unless claims are named. A refined mesh is Delaunay only as far as its constraints allow, and a mesh of another program may
/// break ties differently; `delaunay` and `canonical` are for those who claim more.
const EVERYDAY: [Claim; 6] =
    [Claim::Valid, Claim::Orientation, Claim::Constrained, Claim::Conforming, Claim::Quality, Claim::Topology];

/// Audits a mesh. Exit code 1 if a claim is violated.
pub fn run(args: &CheckArgs) -> Answer {
    let claims = claims(&args.claims)?;
    if !(args.within >= 0.0 && args.within.is_finite()) {
        return Err(Failure::new(format_args!("--within {}: must be a number of ulps, 0 or more", args.within)));
    }
    let rho2 = args.min_angle.map(rho2_from_min_angle).transpose();
    let rho2 = rho2.map_err(|e| Failure::new(format_args!("--min-angle: {e}")))?;
    let mesh = read_mesh(&args.mesh)?;
    let loaded = args.input.as_ref().map(|path| load(path, None)).transpose()?;
    if let (Some(loaded), Some(path)) = (&loaded, &args.input)
        && loaded.refused()
    {
        loaded.tell_refusal(path, args.json)?;
        return Ok(Status::Refused);
    }
    let edges: Vec<_> = mesh.edges.iter().map(|e| e.ends).collect();
    let subject = Subject {
        points: &mesh.points,
        triangles: &mesh.triangles,
        triangle_attributes: &mesh.triangle_attributes,
        edges: &edges,
        point_lines: &mesh.lines.points,
        triangle_lines: &mesh.lines.triangles,
    };
    // The lines of the file belong to its own elements, not to the repaired ones.
    let no_lines = crate::model::Lines::default();
    let input = loaded.as_ref().map(|l| (&l.prepared.pslg, &no_lines));
    let report = audit(&subject, &Options { claims: &claims, input, within: args.within, rho2 });
    let passed = report.passed();
    if args.json {
        data(json!({
            "verdict": if passed { "holds" } else { "violated" },
            "vertices": mesh.points.len(), "triangles": mesh.triangles.len(),
            "claims": report.claims,
        }))?;
    } else {
        data(report.to_string().trim_end())?;
    }
    Ok(if passed { Status::Well } else { Status::No })
}

fn claims(names: &[String]) -> Result<Vec<Claim>, Failure> {
    if names.is_empty() {
        return Ok(EVERYDAY.to_vec());
    }
    let mut claims = Vec::new();
    for name in names {
        let claim = Claim::from_name(name.trim()).ok_or_else(|| {
            let known: Vec<&str> = Claim::ALL.iter().map(|c| c.name()).collect();
            Failure::new(format_args!("--claims {name}: the claims are {}", known.join(", ")))
        })?;
        if !claims.contains(&claim) {
            claims.push(claim);
        }
    }
    Ok(claims)
}
