//! `check`: the audit of a mesh made by anyone.

use super::args::CheckArgs;
use super::files::read_any_mesh;
use super::input::{load, tell_notes};
use super::report::figures;
use super::{Answer, Failure, Status, data, talk};
use crate::arith::angle::rho2_from_min_angle;
use crate::audit::{Claim, ClaimReport, Named, Options, Subject, Verdict, audit, space};
use crate::io::{AnyMesh, ForeignMesh, ForeignMesh3};
use crate::model::Fill;
use serde::Serialize;
use serde_json::{Value, json};
use std::time::Instant;

/// What is checked unless claims are named. A refined mesh is Delaunay only as far as its constraints allow, and a mesh of another program may
/// break ties differently; `delaunay` and `canonical` are for those who claim more.
const EVERYDAY: [Claim; 6] =
    [Claim::Valid, Claim::Orientation, Claim::Constrained, Claim::Conforming, Claim::Quality, Claim::Topology];

/// The same in space; of points with weights, orthospheres take the place of circumspheres.
const EVERYDAY_IN_SPACE: [space::Claim; 5] = {
    use space::Claim::*;
    [Valid, Orientation, Delaunay, Quality, Topology]
};

/// Audits a mesh. Exit code 1 if a claim is violated, or if one that the file could prove is unchecked.
pub fn run(args: &CheckArgs) -> Answer {
    match read_any_mesh(&args.mesh, args.column.column().as_ref())? {
        AnyMesh::Plane(mesh) => {
            tell_notes(&mesh.notes);
            plane(args, &mesh)
        }
        AnyMesh::Space(mesh) => {
            tell_notes(&mesh.notes);
            in_space(args, &mesh)
        }
    }
}

/// Refuses options that are for meshes of the other dimension.
fn not_for(args: &CheckArgs, what: &str, options: &[(&str, bool)]) -> Result<(), Failure> {
    match options.iter().find(|o| o.1) {
        Some((name, _)) => Err(Failure::at(&args.mesh, format_args!("{name} is not for meshes of {what}"))),
        None => Ok(()),
    }
}

fn in_space(args: &CheckArgs, mesh: &ForeignMesh3) -> Answer {
    let options = [args.input.is_some(), args.min_angle.is_some(), args.within.is_some()];
    not_for(args, "space", &["--input", "--min-angle", "--within"].into_iter().zip(options).collect::<Vec<_>>())?;
    let mut everyday = EVERYDAY_IN_SPACE;
    if mesh.weights.iter().any(|&w| w != 0.0) {
        everyday[2] = space::Claim::Regular;
    }
    let claims = claims(&args.claims, &everyday, &space::Claim::ALL)?;
    if args.radius_edge.is_some_and(|rho| !(rho > 0.0 && rho.is_finite())) {
        return Err(Failure::new("--radius-edge: must be a positive number"));
    }
    needs(&claims, space::Claim::Quality, "--radius-edge", args.radius_edge.is_some())?;
    let subject = space::Subject {
        points: &mesh.points,
        weights: &mesh.weights,
        cells: &mesh.tetrahedra,
        point_lines: &mesh.lines.points,
        cell_lines: &mesh.lines.tetrahedra,
    };
    let begun = Instant::now();
    let report = space::audit(&subject, &space::Options { claims: &claims, radius_edge: args.radius_edge });
    let (verdict, seconds) = (report.verdict(|_| true), begun.elapsed().as_secs_f64());
    if args.json {
        data(json!({
            "verdict": verdict,
            "vertices": mesh.points.len(), "cells": mesh.tetrahedra.len(),
            "claims": claims_json(&report.claims), "seconds": seconds,
        }))?;
    } else {
        data(report.to_string().trim_end())?;
        talk(format_args!("time      {seconds:.3} s, reading apart"));
    }
    Ok(if verdict == Verdict::Holds { Status::Well } else { Status::No })
}

fn plane(args: &CheckArgs, mesh: &ForeignMesh) -> Answer {
    let column = args.column.column().is_some();
    not_for(args, "the plane", &[("--weights or --radii", column), ("--radius-edge", args.radius_edge.is_some())])?;
    let claims = claims(&args.claims, &EVERYDAY, &Claim::ALL)?;
    let within = args.within.unwrap_or(2.0);
    if !(within >= 0.0 && within.is_finite()) {
        return Err(Failure::new(format_args!("--within {within}: must be a number of ulps, 0 or more")));
    }
    needs(&claims, Claim::Quality, "--min-angle", args.min_angle.is_some())?;
    needs(&claims, Claim::Conforming, "--within", args.within.is_some())?;
    let rho2 = args.min_angle.map(rho2_from_min_angle).transpose();
    let rho2 = rho2.map_err(|e| Failure::new(format_args!("--min-angle: {e}")))?;
    let fill = args.convex.then_some(Fill::Convex);
    let loaded = args.input.as_ref().map(|path| load(path, fill)).transpose()?;
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
    let report = audit(&subject, &Options { claims: &claims, input, within, rho2 });
    // These two need an input, and are asked for unless others are named.
    let optional = [Claim::Constrained, Claim::Conforming];
    let verdict = report.verdict(|c| !args.claims.is_empty() || !optional.contains(c));
    if args.json {
        data(json!({
            "verdict": verdict,
            "vertices": mesh.points.len(), "triangles": mesh.triangles.len(),
            "claims": claims_json(&report.claims),
        }))?;
    } else {
        data(report.to_string().trim_end())?;
    }
    Ok(if verdict == Verdict::Holds { Status::Well } else { Status::No })
}

/// Refuses an option that makes a claim which is not among those to be checked.
fn needs<C: Named + PartialEq>(claims: &[C], claim: C, option: &str, given: bool) -> Result<(), Failure> {
    if !given || claims.contains(&claim) {
        return Ok(());
    }
    let name = claim.name();
    Err(Failure::new(format_args!("{option} is a bound of the claim `{name}`; add it: --claims ...,{name}")))
}

/// The answers for programs.
fn claims_json<C: Serialize, W: Serialize>(claims: &[ClaimReport<C, W>]) -> Value {
    let one = |c: &ClaimReport<C, W>| {
        // Plain data has a JSON form.
        let mut value = serde_json::to_value(c).expect("plain data");
        value["figures"] = figures(&c.figures);
        value
    };
    claims.iter().map(one).collect()
}

/// The claims of these names among all; the everyday ones if none is named.
fn claims<C: Named + PartialEq>(names: &[String], everyday: &[C], all: &[C]) -> Result<Vec<C>, Failure> {
    if names.is_empty() {
        return Ok(everyday.to_vec());
    }
    let mut claims = Vec::new();
    for name in names {
        let claim = all.iter().copied().find(|c| c.name() == name.trim()).ok_or_else(|| {
            let known: Vec<&str> = all.iter().map(|c| c.name()).collect();
            Failure::new(format_args!("--claims {name}: the claims are {}", known.join(", ")))
        })?;
        if !claims.contains(&claim) {
            claims.push(claim);
        }
    }
    Ok(claims)
}
