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

/// What has a name on the command line.
pub trait Named: Copy {
    /// That name.
    fn name(self) -> &'static str;
}

impl Named for Claim {
    fn name(self) -> &'static str {
        Claim::name(self)
    }
}

/// A place where a claim fails.
pub trait Located {
    /// One sentence.
    fn message(&self) -> &str;

    /// Lines of the file; may be empty.
    fn lines(&self) -> &[u32];
}

impl Located for Witness {
    fn message(&self) -> &str {
        &self.message
    }

    fn lines(&self) -> &[u32] {
        &self.lines
    }
}

/// Lines of the elements, or else of the vertices, whose lines are known.
pub(super) fn known_lines(elements: &[u32], of_elements: &[u32], vertices: &[u32], of_vertices: &[u32]) -> Vec<u32> {
    let line = |lines: &[u32], i: &u32| lines.get(*i as usize).copied().filter(|&l| l > 0);
    let lines: Vec<u32> = elements.iter().filter_map(|t| line(of_elements, t)).collect();
    if lines.is_empty() { vertices.iter().filter_map(|v| line(of_vertices, v)).collect() } else { lines }
}

/// The report about one claim.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimReport<C = Claim, W = Witness> {
    /// The claim.
    pub claim: C,
    /// The answer.
    pub verdict: Verdict,
    /// One sentence.
    pub message: String,
    /// The first witnesses.
    pub witnesses: Vec<W>,
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
    /// Counts a violation, and lists it if there is room.
    pub(super) fn violated(
        &mut self,
        subject: &Subject<'_>,
        vertices: &[u32],
        triangles: &[u32],
        message: impl FnOnce() -> String,
    ) {
        let point = |&v: &u32| subject.points.get(v as usize).map(|p| [p.x, p.y]);
        self.count(|| Witness {
            message: message(),
            vertices: vertices.to_vec(),
            triangles: triangles.to_vec(),
            input: Vec::new(),
            coordinates: vertices.iter().filter_map(point).collect(),
            lines: known_lines(triangles, subject.triangle_lines, vertices, subject.point_lines),
        });
    }
}

impl<C, W> ClaimReport<C, W> {
    pub(super) fn new(claim: C) -> Self {
        let (verdict, message) = (Verdict::Holds, String::new());
        ClaimReport { claim, verdict, message, witnesses: Vec::new(), violations: 0, figures: Vec::new() }
    }

    /// Counts a violation, and lists it if there is room.
    pub(super) fn count(&mut self, witness: impl FnOnce() -> W) {
        self.verdict = Verdict::Violated;
        self.violations += 1;
        if self.witnesses.len() < LISTED_WITNESSES {
            self.witnesses.push(witness());
        }
    }

    /// Sets the message of a claim by whether it holds.
    pub(super) fn conclude(mut self, holds: &str) -> Self {
        self.message = match self.verdict {
            Verdict::Violated => counted(self.violations, "violation"),
            // Says why.
            Verdict::Unchecked => return self,
            _ => holds.into(),
        };
        self
    }

    pub(super) fn unchecked(claim: C, message: &str) -> Self {
        ClaimReport { verdict: Verdict::Unchecked, message: message.into(), ..ClaimReport::new(claim) }
    }
}

/// The audit of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report<C = Claim, W = Witness> {
    /// One report for each claim asked for, in that order.
    pub claims: Vec<ClaimReport<C, W>>,
}

impl<C: PartialEq, W> Report<C, W> {
    /// Whether no claim is violated.
    pub fn passed(&self) -> bool {
        self.claims.iter().all(|c| c.verdict != Verdict::Violated)
    }

    /// Violated if some claim is; else unchecked if one that is `needed` is; else holds.
    pub fn verdict(&self, needed: impl Fn(&C) -> bool) -> Verdict {
        if !self.passed() {
            Verdict::Violated
        } else if self.claims.iter().any(|c| c.verdict == Verdict::Unchecked && needed(&c.claim)) {
            Verdict::Unchecked
        } else {
            Verdict::Holds
        }
    }

    /// The report about a claim, if it was asked for.
    pub fn claim(&self, claim: C) -> Option<&ClaimReport<C, W>> {
        self.claims.iter().find(|c| c.claim == claim)
    }
}

impl<C: Named, W: Located> fmt::Display for Report<C, W> {
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
                write!(f, "{:24}{}", "", w.message())?;
                if !w.lines().is_empty() {
                    write!(f, " ({})", listed("line", w.lines(), 8))?;
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
