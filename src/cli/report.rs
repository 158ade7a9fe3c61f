//! What is told about a mesh. Floating point numbers here are for people; they decide nothing.

use crate::model::words::counted;
use crate::model::{DiskChoice, GcdrParameters, Level, Mesh2, Point2};
use crate::refine::{Run, Unmet};
use crate::trace::{Cause, Outcome, SkipReason};
use serde_json::{Value, json};

/// Angles of a mesh, in degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Smallest and largest angle of any triangle; 0 and 0 without triangles.
    pub extremes: [f64; 2],
    /// Smallest angle among the triangles that are not excused by an input angle.
    pub unexcused: f64,
    /// Triangles by their smallest angle: below 5, 10, ... 60 degrees.
    pub histogram: [u64; 12],
}

impl Quality {
    /// The angles of a mesh, `unmet` being the triangles left bad.
    pub fn of(mesh: &Mesh2, unmet: &[Unmet]) -> Self {
        let is_excused = |u: &&Unmet| matches!(u.reason, SkipReason::InputAngle { .. });
        let mut excused: Vec<_> = unmet.iter().filter(is_excused).map(|u| u.triangle).collect();
        excused.sort_unstable();
        let mut quality = Quality { extremes: [180.0, 0.0], unexcused: 60.0, histogram: [0; 12] };
        for t in &mesh.triangles {
            let angles = angles(mesh.corners(*t));
            let least = angles[0].min(angles[1]).min(angles[2]);
            let most = angles[0].max(angles[1]).max(angles[2]);
            quality.extremes = [quality.extremes[0].min(least), quality.extremes[1].max(most)];
            quality.histogram[((least / 5.0) as usize).min(11)] += 1;
            if excused.binary_search(t).is_err() {
                quality.unexcused = quality.unexcused.min(least);
            }
        }
        if mesh.triangles.is_empty() { Quality::default() } else { quality }
    }

    /// For programs.
    pub fn json(&self) -> Value {
        json!({
            "min_angle": self.extremes[0], "max_angle": self.extremes[1], "min_angle_unexcused": self.unexcused,
            "min_angle_histogram_5_degrees": self.histogram,
        })
    }

    /// For people: a bar a line.
    pub fn bars(&self) -> Vec<String> {
        let most = self.histogram.iter().copied().max().unwrap_or(0).max(1);
        let rows = self.histogram.iter().enumerate().filter(|(_, n)| **n > 0);
        rows.map(|(i, n)| {
            // At least a dot, so that a single bad triangle is seen.
            let eighths = (n * 240).div_ceil(most) as usize;
            let bar = "█".repeat(eighths / 8) + ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"][eighths % 8];
            format!("  {:>2}-{:<2} {n:>9} {bar}", 5 * i, 5 * i + 5)
        })
        .collect()
    }
}

fn angles([a, b, c]: [Point2; 3]) -> [f64; 3] {
    // Halving keeps differences of huge coordinates finite, the common factor keeps products in range.
    let size = [a, b, c].iter().fold(0.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs())).max(f64::MIN_POSITIVE);
    let [a, b, c] = [a, b, c].map(|p| p * 0.5 / size);
    let longest = (b - a).abs().max_element().max((c - a).abs().max_element()).max(f64::MIN_POSITIVE);
    let at = |p: Point2, q: Point2, r: Point2| {
        let (u, v) = ((q - p) / longest, (r - p) / longest);
        u.perp_dot(v).abs().atan2(u.dot(v)).to_degrees()
    };
    [at(a, b, c), at(b, c, a), at(c, a, b)]
}

/// Figures of an audit for programs: whole numbers as such, and dihedral angles in steps of 10 degrees as one list.
pub fn figures<'a>(figures: impl IntoIterator<Item = &'a (&'static str, f64)>) -> Value {
    // The cast saturates; a fraction or a larger number does not survive it.
    let whole = |x: f64| Some(x as i64).filter(|&n| n as f64 == x && n.abs() < 1 << 53);
    let number = |x: f64| whole(x).map_or_else(|| json!(x), |n| json!(n));
    let mut object = serde_json::Map::new();
    let mut steps = Vec::new();
    for &(name, x) in figures {
        if name.starts_with("dihedral_from_") {
            steps.push(number(x));
        } else {
            object.insert(name.into(), number(x));
        }
    }
    if !steps.is_empty() {
        object.insert("dihedral_histogram_10_degrees".into(), steps.into());
    }
    object.into()
}

/// The name of an outcome.
pub fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Complete => "complete",
        Outcome::Holey => "holey",
        Outcome::Stopped => "stopped",
    }
}

/// The name of a level.
pub fn level(level: Level) -> &'static str {
    match level {
        Level::Outside => "outside",
        Level::Admissible => "admissible",
        Level::Graded => "graded",
    }
}

/// Why a run with these parameters claims no theorem. The level was decided exactly elsewhere; only the reason is looked for here.
pub fn why_outside(p: &GcdrParameters) -> &'static str {
    if p.choice_a == DiskChoice::Offcenter {
        return "off-centers are not clamped to the selection disk (fewest triangles; --promise graded buys the theorem)";
    }
    let (d1, d2) = (p.d1 * p.d1, p.d2 * p.d2);
    if p.rho2 < 1.0 {
        return "the angle bound exceeds 30 degrees";
    }
    if p.rho2 * d2 * d1 < 1.0 {
        return "d1 and d2 are too small for the angle bound";
    }
    "an angle of the input is below what mu allows (60 degrees for mu = 1)"
}

/// Whether every triangle left bad is excused by an angle of the input.
pub fn all_excused(unmet: &[Unmet]) -> bool {
    unmet.iter().all(|u| matches!(u.reason, SkipReason::InputAngle { .. }))
}

/// The reason for which a triangle was left, and the element it names.
fn reason(u: &Unmet) -> (&'static str, Option<(&'static str, u32)>) {
    match u.reason {
        SkipReason::Resolution => ("resolution", None),
        SkipReason::InputAngle { apex } => ("input-angle", Some(("vertex", apex.0))),
        SkipReason::SplitLimit { segment } => ("split-limit", Some(("segment", segment.0))),
    }
}

fn cause(u: &Unmet) -> &'static str {
    match u.cause {
        Cause::Skinny => "skinny",
        Cause::Area => "area",
        Cause::Size { .. } => "size",
    }
}

/// The middle of a triangle.
fn place(u: &Unmet) -> Point2 {
    u.corners.iter().fold(Point2::ZERO, |sum, p| sum + *p / 3.0)
}

/// The triangles left bad, for programs.
pub fn unmet_json(unmet: &[Unmet]) -> Value {
    let one = |u: &Unmet| {
        let (reason, element) = reason(u);
        let mut value = json!({
            "triangle": u.triangle, "place": place(u).to_array(), "corners": u.corners.map(|p| p.to_array()),
            "cause": cause(u), "reason": reason,
        });
        if let Some((kind, id)) = element {
            value[kind] = id.into();
        }
        value
    };
    unmet.iter().map(one).collect()
}

/// The triangles left bad, for people: by reason, the first three of each with their place.
pub fn unmet_lines(unmet: &[Unmet]) -> Vec<String> {
    let mut lines = Vec::new();
    for name in ["input-angle", "resolution", "split-limit"] {
        let of_reason: Vec<&Unmet> = unmet.iter().filter(|u| reason(u).0 == name).collect();
        if of_reason.is_empty() {
            continue;
        }
        let explained = match name {
            "input-angle" => "excused: an angle of the input makes them so",
            "resolution" => "coordinates have no room for a better point",
            _ => "their segment was split as often as allowed",
        };
        lines.push(format!("unmet     {} {name} ({explained})", of_reason.len()));
        for u in of_reason.iter().take(3) {
            let p = place(u);
            let element = reason(u).1.map_or(String::new(), |(kind, id)| format!(", {kind} {id}"));
            lines.push(format!("            {} at ({:.6}, {:.6}){element}", cause(u), p.x, p.y));
        }
        if of_reason.len() > 3 {
            lines.push(format!("            and {} more", of_reason.len() - 3));
        }
    }
    lines
}

/// What a run came to, for people.
pub fn lines(run: &Run, quality: &Quality) -> Vec<String> {
    let c = &run.counts;
    let reason = run.stop_reason.as_ref().map_or(String::new(), |r| format!(": {r}"));
    let mut lines = vec![
        format!("outcome   {}{reason}", outcome(run.outcome)),
        format!(
            "mesh      {}, {}, {}",
            counted(c.vertices, "vertex"),
            counted(c.triangles, "triangle"),
            counted(run.mesh.edges.len(), "subsegment")
        ),
    ];
    if c.type_a + c.type_b + c.type_c > 0 {
        lines.push(format!(
            "steps     {}, {} on segments ({} type B, {} type C), {} deleted",
            counted(c.type_a, "free point"),
            c.type_b + c.type_c,
            c.type_b,
            c.type_c,
            c.removed
        ));
    }
    lines.push(format!("angles    {:.2} to {:.2} degrees", quality.extremes[0], quality.extremes[1]));
    if quality.unexcused > quality.extremes[0] {
        lines.push(format!("          {:.2} where no input angle is in the way", quality.unexcused));
    }
    lines.extend(quality.bars());
    lines.extend(unmet_lines(&run.unmet));
    lines
}
