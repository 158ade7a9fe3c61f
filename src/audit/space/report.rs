//! What an audit of a tetrahedral mesh says.

use super::Subject;
use crate::audit::report::{self, Located, Named, known_lines};
use serde::Serialize;

/// What a mesh may claim. The module head of `audit::space` defines each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Claim {
    /// A geometric simplicial complex.
    Valid,
    /// Positive cells.
    Orientation,
    /// Empty circumspheres.
    Delaunay,
    /// Empty orthospheres.
    Regular,
    /// The one regular triangulation of the tie-break.
    Canonical,
    /// The convex hull is filled, no point left out.
    Hull,
    /// Ratios and dihedral angles.
    Quality,
    /// Counts, Euler characteristic, components.
    Topology,
}

impl Claim {
    /// All claims, in the order of reports.
    pub const ALL: [Claim; 8] = [
        Claim::Valid,
        Claim::Orientation,
        Claim::Delaunay,
        Claim::Regular,
        Claim::Canonical,
        Claim::Hull,
        Claim::Quality,
        Claim::Topology,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Claim::Valid => "valid",
            Claim::Orientation => "orientation",
            Claim::Delaunay => "delaunay",
            Claim::Regular => "regular",
            Claim::Canonical => "canonical",
            Claim::Hull => "hull",
            Claim::Quality => "quality",
            Claim::Topology => "topology",
        }
    }

    /// The claim of that name.
    pub fn from_name(name: &str) -> Option<Claim> {
        Claim::ALL.into_iter().find(|c| c.name() == name)
    }
}

impl Named for Claim {
    fn name(self) -> &'static str {
        Claim::name(self)
    }
}

/// Where a claim fails. Ids are positions in the file, counted from 0.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Witness {
    /// One sentence.
    pub message: String,
    /// Vertices concerned.
    pub vertices: Vec<u32>,
    /// Cells concerned.
    pub cells: Vec<u32>,
    /// Coordinates of the vertices.
    pub coordinates: Vec<[f64; 3]>,
    /// Lines of the file of those cells, or else vertices, whose lines are known.
    pub lines: Vec<u32>,
}

impl Located for Witness {
    fn message(&self) -> &str {
        &self.message
    }

    fn lines(&self) -> &[u32] {
        &self.lines
    }
}

impl Witness {
    pub(super) fn new(subject: &Subject<'_>, vertices: &[u32], cells: &[u32], message: String) -> Self {
        let place = |&v: &u32| subject.points.get(v as usize).map(|p| p.to_array());
        Witness {
            message,
            vertices: vertices.to_vec(),
            cells: cells.to_vec(),
            coordinates: vertices.iter().filter_map(place).collect(),
            lines: known_lines(cells, subject.cell_lines, vertices, subject.point_lines),
        }
    }
}

/// The report about one claim.
pub type ClaimReport = report::ClaimReport<Claim, Witness>;

/// The audit of a mesh.
pub type Report = report::Report<Claim, Witness>;

impl ClaimReport {
    /// Counts a violation, and lists it if there is room. Cells are named by their positions in the file.
    pub(super) fn violated(
        &mut self,
        subject: &Subject<'_>,
        vertices: &[u32],
        cells: &[u32],
        message: impl FnOnce() -> String,
    ) {
        self.count(|| Witness::new(subject, vertices, cells, message()));
    }
}
