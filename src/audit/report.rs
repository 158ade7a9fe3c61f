//! What an audit says.

use super::Subject;
use crate::model::words::{counted, listed};
use serde::Serialize;
use std::fmt;

/// How many witnesses a claim lists; their total is told.
pub const LISTED_WITNESSES: usize = 100;

/// What a mesh may claim. The module head of `audit` defines each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Claim {
    /// A geometric simplicial complex.
    Valid,
    /// Counterclockwise triangles.
    Orientation,
    /// Empty circles.
    Delaunay,
    /// Circles empty of visible vertices.
    Constrained,
    /// The one constrained Delaunay triangulation of the tie-break.
    Canonical,
    /// Every vertex and segment of the input is there.
    Conforming,
    /// Angles and ratios.
    Quality,
    /// Components, holes, Euler characteristic.
    Topology,
}

impl Claim {
    /// All claims, in the order of reports.
    pub const ALL: [Claim; 8] = [
        Claim::Valid,
        Claim::Orientation,
        Claim::Delaunay,
        Claim::Constrained,
        Claim::Canonical,
        Claim::Conforming,
        Claim::Quality,
        Claim::Topology,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Claim::Valid => "valid",
            Claim::Orientation => "orientation",
            Claim::Delaunay => "delaunay",
            Claim::Constrained => "constrained",
            Claim::Canonical => "canonical",
            Claim::Conforming => "conforming",
            Claim::Quality => "quality",
            Claim::Topology => "topology",
        }
    }

    /// The claim of that name.
    pub fn from_name(name: &str) -> Option<Claim> {
        Claim::ALL.into_iter().find(|c| c.name() == name)
    }
}

/// The answer about one claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Proven.
    Holds,
    /// Disproven; there is a witness.
    Violated,
    /// Could not be tested, for the reason that the message gives.
    Unchecked,
    /// No claim, figures only.
    Told,
}

/// Where a claim fails. Ids are positions in the file, counted from 0.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Witness {
    /// One sentence.
    pub message: String,
    /// Vertices of the mesh concerned.
    pub vertices: Vec<u32>,
    /// Triangles of the mesh concerned.
    pub triangles: Vec<u32>,
    /// Segments or vertices of the input concerned.
    pub input: Vec<crate::model::SegmentId>,
    /// Coordinates of the vertices.
    pub coordinates: Vec<[f64; 2]>,
    /// Lines of the file of those triangles, or else vertices, whose lines are known.
    pub lines: Vec<u32>,
}

/// The report about one claim.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimReport {
    /// The claim.
    pub claim: Claim,
    /// The answer.
    pub verdict: Verdict,
    /// One sentence.
    pub message: String,
    /// The first witnesses.
    pub witnesses: Vec<Witness>,
    /// How many there are.
    pub violations: u64,
    /// Figures by name.
    #[serde(serialize_with = "as_map")]
    pub figures: Vec<(&'static str, f64)>,
}

fn as_map<S: serde::Serializer>(figures: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(figures.iter().copied())
}

impl ClaimReport {
    pub(super) fn new(claim: Claim) -> Self {
        let (verdict, message) = (Verdict::Holds, String::new());
        ClaimReport { claim, verdict, message, witnesses: Vec::new(), violations: 0, figures: Vec::new() }
    }

    /// Counts a violation, and lists it if there is room.
    pub(super) fn violated(
        &mut self,
        subject: &Subject<'_>,
        vertices: &[u32],
        triangles: &[u32],
        message: impl FnOnce() -> String,
    ) {
        self.verdict = Verdict::Violated;
        self.violations += 1;
        if self.witnesses.len() >= LISTED_WITNESSES {
            return;
        }
        let point = |&v: &u32| subject.points.get(v as usize).map(|p| [p.x, p.y]);
        let line = |lines: &[u32], i: &u32| lines.get(*i as usize).copied().filter(|&l| l > 0);
        let mut lines: Vec<u32> = triangles.iter().filter_map(|t| line(subject.triangle_lines, t)).collect();
        if lines.is_empty() {
            lines = vertices.iter().filter_map(|v| line(subject.point_lines, v)).collect();
        }
        self.witnesses.push(Witness {
            message: message(),
            vertices: vertices.to_vec(),
            triangles: triangles.to_vec(),
            input: Vec::new(),
            coordinates: vertices.iter().filter_map(point).collect(),
            lines,
        });
    }

    /// Sets the message of a claim by whether it holds.
    pub(super) fn conclude(mut self, holds: &str) -> Self {
        self.message = match self.verdict {
            Verdict::Violated => counted(self.violations, "violation"),
            _ => holds.into(),
        };
        self
    }

    pub(super) fn unchecked(claim: Claim, message: &str) -> Self {
        ClaimReport { verdict: Verdict::Unchecked, message: message.into(), ..ClaimReport::new(claim) }
    }
}

/// The audit of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// One report for each claim asked for, in that order.
    pub claims: Vec<ClaimReport>,
}

impl Report {
    /// Whether no claim is violated.
    pub fn passed(&self) -> bool {
        self.claims.iter().all(|c| c.verdict != Verdict::Violated)
    }

    /// The report about a claim, if it was asked for.
    pub fn claim(&self, claim: Claim) -> Option<&ClaimReport> {
        self.claims.iter().find(|c| c.claim == claim)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in &self.claims {
            let verdict = match c.verdict {
                Verdict::Holds => "holds",
                Verdict::Violated => "VIOLATED",
                Verdict::Unchecked => "unchecked",
                Verdict::Told => "told",
            };
            writeln!(f, "{:<12} {verdict:<10} {}", c.claim.name(), c.message)?;
            for (name, value) in &c.figures {
                writeln!(f, "{:24}{name} = {value}", "")?;
            }
            for w in &c.witnesses {
                write!(f, "{:24}{}", "", w.message)?;
                if !w.lines.is_empty() {
                    write!(f, " ({})", listed("line", &w.lines, 8))?;
                }
                writeln!(f)?;
            }
            let more = c.violations - (c.witnesses.len() as u64).min(c.violations);
            if more > 0 {
                writeln!(f, "{:24}and {more} more", "")?;
            }
        }
        Ok(())
    }
}
