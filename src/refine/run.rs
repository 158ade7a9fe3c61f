//! What every refinement run has: options, a budget, an outcome.

use crate::domain::Finding;
use crate::model::{Level, Mesh2, Point2, VertexId};
use crate::trace::{Cause, Counts, Outcome, SkipReason};
use crate::triangulation::cdt2::{BuildError, CarveError};

/// What a caller may add to the parameters of a run. `Default` adds nothing and allows 10^7 steps.
pub struct Options<'a> {
    /// Chooses points where a choice is `user`.
    pub chooser: Option<&'a mut dyn Chooser>,
    /// Largest circumradius at a place, input units; infinite for no bound, at least 2^-399 of the largest coordinate.
    pub size: Option<&'a mut dyn FnMut(Point2) -> f64>,
    /// Most events.
    pub max_steps: u64,
    /// Asked now and then; a reason ends the run with `Outcome::Stopped`.
    pub stop: Option<&'a mut dyn FnMut() -> Option<String>>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options { chooser: None, size: None, max_steps: 10_000_000, stop: None }
    }
}

/// A user's choice of Steiner points, in input units. A point outside its region ends the run with `RegionViolation`.
pub trait Chooser {
    /// A point of the selection disk of a triangle (Type-A).
    fn in_disk(&mut self, request: &DiskRequest) -> Point2;
    /// A point of the selection interval of a subsegment (Type-B, Type-C).
    fn in_interval(&mut self, request: &IntervalRequest) -> Point2;
}

/// The closed selection disk of a triangle: center o, radius (1 - d2) r.
#[derive(Clone, Copy, Debug)]
pub struct DiskRequest {
    /// Corners, counterclockwise, input units.
    pub corners: [Point2; 3],
    /// Their ids.
    pub ids: [VertexId; 3],
    /// The circumcenter o, rounded to nearest.
    pub center: Point2,
    /// delta2.
    pub d2: f64,
}

/// The closed selection interval of a subsegment: its midpoint +- (1 - delta)/2 of its length.
#[derive(Clone, Copy, Debug)]
pub struct IntervalRequest {
    /// Ends of the subsegment, input units.
    pub ends: [Point2; 2],
    /// Their ids.
    pub ids: [VertexId; 2],
    /// delta1 or mu.
    pub delta: f64,
}

/// A finished run.
#[derive(Clone, Debug)]
pub struct Run {
    /// The mesh.
    pub mesh: Mesh2,
    /// How it ended.
    pub outcome: Outcome,
    /// What stopped it.
    pub stop_reason: Option<String>,
    /// What was promised before the start.
    pub level: Level,
    /// What the stored points have in effect.
    pub level_effective: Level,
    /// Counts.
    pub counts: Counts,
    /// Bad triangles of the mesh that were left, in the order they were skipped.
    pub unmet: Vec<Unmet>,
    /// Events.
    pub events: u64,
}

/// A bad triangle of the final mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unmet {
    /// Its corners, input units.
    pub corners: [Point2; 3],
    /// Its vertices, dense ids of `Run::mesh`, canonical.
    pub triangle: [VertexId; 3],
    /// Why it is bad.
    pub cause: Cause,
    /// Why it was left; ids are those of the input.
    pub reason: SkipReason,
}

/// Why a run ended without an outcome.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The trace could not be written.
    #[error("the trace could not be written: {0}")]
    Io(#[from] std::io::Error),
    /// Coordinates out of range.
    #[error("{}", .0.first().map_or("coordinates out of range", |f| &f.message))]
    Range(Vec<Finding>),
    /// The input is no repaired planar straight line graph.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The region to mesh is not well defined.
    #[error(transparent)]
    Carve(#[from] CarveError),
    /// A parameter outside its range.
    #[error("{name} = {value} must be {range}")]
    Parameter {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// A choice is `user` and no function was given, or a size function was announced and is missing.
    #[error("the parameters name a user's function, and none was given")]
    MissingFunction,
    /// A user's point lies outside its selection region.
    #[error("the chosen point ({}, {}) lies outside the selection region of {place}", .point.x, .point.y)]
    RegionViolation {
        /// The point returned.
        point: Point2,
        /// Triangle or subsegment, by ids.
        place: String,
    },
    /// A size function returned no number, one that is not positive, or one too small to be computed with.
    #[error("the size function returned {value} at ({}, {}); it must return a positive number, of at least 2^-399 of the input's extent", .at.x, .at.y)]
    Size {
        /// The place.
        at: Point2,
        /// The value.
        value: f64,
    },
}
