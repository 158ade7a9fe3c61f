//! Parameters of a run, as they stand in the header of a trace.

use serde::{Deserialize, Serialize};

/// Parameters of GCDR. Lengths and areas are in input units. Source: \[GCDR\] section 3, `docs/gcdr.md`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GcdrParameters {
    /// Square of the quality bound rho: a triangle is skinny if its circumradius squared is at least `rho2` times its shortest edge squared.
    pub rho2: f64,
    /// delta1, shortens the selection interval of Type-B; in (0, 1].
    pub d1: f64,
    /// delta2, shrinks the selection disk of Type-A; in (0, 1].
    pub d2: f64,
    /// mu, shortens the selection interval of Type-C; in (0, 1].
    pub mu: f64,
    /// Choice of Type-A points.
    pub choice_a: DiskChoice,
    /// Choice of Type-B points.
    pub choice_b: Choice,
    /// Choice of Type-C points.
    pub choice_c: Choice,
    /// kappa of the off-center; present with `choice_a = offcenter` only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kappa: Option<f64>,
    /// Which vertex `extreme` heads for; present with an `extreme` choice only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extreme: Option<VertexOfTriangle>,
    /// Key of the generator; present where a choice draws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Order of the queue.
    pub order: QueueOrder,
    /// Which free vertices a split deletes.
    pub deletion: DeletionPolicy,
    /// Treatment of input angles below 60 degrees.
    pub small_angles: SmallAngles,
    /// Largest area of any triangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_area: Option<f64>,
    /// Whether a size function was given; its values stand in the events.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub size_function: bool,
    /// Limit of splits per input segment.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_splits: Option<u32>,
}

impl GcdrParameters {
    /// Chew's second algorithm: circumcenters and midpoints, delta1 = delta2 = mu = 1; shortest edge first, shells at small
    /// input angles. The base from which other parameters are written: `GcdrParameters { mu: 0.8, ..GcdrParameters::chew(2.0) }`.
    pub fn chew(rho2: f64) -> GcdrParameters {
        GcdrParameters {
            rho2,
            d1: 1.0,
            d2: 1.0,
            mu: 1.0,
            choice_a: DiskChoice::Center,
            choice_b: Choice::Center,
            choice_c: Choice::Center,
            kappa: None,
            extreme: None,
            seed: None,
            order: QueueOrder::ShortestEdge,
            deletion: DeletionPolicy::Segment,
            small_angles: SmallAngles::Shells,
            max_area: None,
            size_function: false,
            max_splits: None,
        }
    }
}

/// How a Type-A point is chosen in the selection disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DiskChoice {
    /// The circumcenter.
    Center,
    /// On the boundary of the disk, toward a vertex (Experiment 1).
    Extreme,
    /// Anywhere in the disk (Experiment 2).
    Random,
    /// On the bisector of the shortest edge, wherever that lies (outside the theorem).
    Offcenter,
    /// The off-center, moved into the selection disk.
    ClampedOffcenter,
    /// A user's function.
    User,
}

/// How a Type-B or Type-C point is chosen in its selection interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Choice {
    /// The midpoint.
    Center,
    /// An end of the interval.
    Extreme,
    /// Anywhere in the interval.
    Random,
    /// A user's function.
    User,
}

/// The vertex that the choice `extreme` heads for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VertexOfTriangle {
    /// Lowest id.
    First,
    /// Highest id.
    Newest,
    /// Drawn from the generator.
    Seeded,
}

/// Order in which bad triangles are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum QueueOrder {
    /// By event number of birth.
    Fifo,
    /// Largest ratio of circumradius to shortest edge first.
    WorstFirst,
    /// Shortest shortest edge first.
    ShortestEdge,
}

/// Which free vertices are deleted before a subsegment is split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DeletionPolicy {
    /// Those visible from the interior of the subsegment.
    Segment,
    /// Those visible from the chosen point.
    Point,
    /// All in the disks.
    Disk,
}

/// Treatment of input angles below 60 degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SmallAngles {
    /// Concentric shells at the apex; triangles that the angle makes skinny are left and listed.
    Shells,
    /// No special treatment.
    Off,
}

/// What a run promises, decided from parameters and input before it starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Level {
    /// No theorem is claimed.
    Outside,
    /// The regions are defined and the per-event bounds hold.
    Admissible,
    /// Termination and the finite grading constants hold.
    Graded,
}
