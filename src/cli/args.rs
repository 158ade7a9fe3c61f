//! What can be typed.

use crate::model::{Choice, DeletionPolicy, DiskChoice, Level, QueueOrder, SmallAngles, VertexOfTriangle};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use serde::de::DeserializeOwned;
use std::path::PathBuf;

/// Verified, traced Delaunay refinement.
#[derive(Debug, Parser)]
#[command(name = "orthoball", version, about, max_term_width = 100)]
#[command(
    after_help = "Exit codes: 0 all well; 1 the answer is no; 2 wrong usage, unreadable or refused input; 3 stopped; 101 a bug."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Mesh a planar straight line graph (.poly, .node, .wkt, .geojson)
    Mesh(Box<MeshArgs>),
    /// Check a trace without trust in the program that wrote it
    Verify(VerifyArgs),
    /// Audit a mesh made by any mesher
    Check(CheckArgs),
    /// List every finding in an input at once
    Doctor(DoctorArgs),
    /// Triangulate points of the plane, with segments if there are any, or of space, with weights; add none
    Triangulate(TriangulateArgs),
    /// Show where two traces first differ
    Diff(DiffArgs),
    /// Write the mesh as it was after an event of a trace, or at its end
    Replay(ReplayArgs),
    /// Compute a table or figure of a paper: published, ours, corrected
    Reproduce(ReproduceArgs),
    /// Convert between file formats; traces between text (.jsonl) and binary (.obt)
    Convert(ConvertArgs),
}

/// Arguments of `mesh`.
#[derive(Args, Debug)]
pub struct MeshArgs {
    /// The input; the format is that of its extension
    pub input: PathBuf,
    /// The algorithm
    #[arg(long, value_parser = ["gcdr"], default_value = "gcdr")]
    pub algorithm: String,
    #[command(flatten)]
    pub quality: QualityArgs,
    #[command(flatten)]
    pub choices: ChoiceArgs,
    /// Mesh the whole convex hull, less holes
    #[arg(long)]
    pub convex: bool,
    #[command(flatten)]
    pub run: RunArgs,
    #[command(flatten)]
    pub out: OutArgs,
}

/// What the mesh has to satisfy.
#[derive(Args, Debug)]
pub struct QualityArgs {
    /// Least angle of a triangle, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 25.0, conflicts_with = "rho2")]
    pub min_angle: f64,
    /// Instead of an angle: the square of the bound rho on circumradius over shortest edge
    #[arg(long, value_name = "X")]
    pub rho2: Option<f64>,
    /// Largest area of a triangle, in squared units of the input
    #[arg(long, value_name = "X")]
    pub max_area: Option<f64>,
    /// Buy a theorem: termination and grading (graded), or only the bounds at each step (admissible). Costs triangles
    #[arg(long, value_name = "LEVEL", value_parser = name::<Level>(&["graded", "admissible"]))]
    pub promise: Option<Level>,
    /// Splits allowed per input segment
    #[arg(long, value_name = "N")]
    pub max_splits: Option<u32>,
}

/// How points are chosen.
#[derive(Args, Debug)]
pub struct ChoiceArgs {
    /// All three choices at once; `offcenter` means `center` on segments
    #[arg(long, value_name = "NAME", value_parser = name::<DiskChoice>(DISK), conflicts_with_all = ["choice_a", "choice_b", "choice_c"])]
    pub choice: Option<DiskChoice>,
    /// Choice of points inside (Type-A)
    #[arg(long, value_name = "NAME", value_parser = name::<DiskChoice>(DISK))]
    pub choice_a: Option<DiskChoice>,
    /// Choice of points on segments (Type-B)
    #[arg(long, value_name = "NAME", value_parser = name::<Choice>(INTERVAL))]
    pub choice_b: Option<Choice>,
    /// Choice of points on segments near others (Type-C)
    #[arg(long, value_name = "NAME", value_parser = name::<Choice>(INTERVAL))]
    pub choice_c: Option<Choice>,
    /// delta1: shortens the selection interval of Type-B; in (0, 1]
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    pub d1: f64,
    /// delta2: shrinks the selection disk of Type-A; in (0, 1]. Default: 1, or what `--promise` needs
    #[arg(long, value_name = "X")]
    pub d2: Option<f64>,
    /// mu: shortens the selection interval of Type-C; in (0, 1]
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    pub mu: f64,
    /// Which vertex an `extreme` choice heads for
    #[arg(long, value_name = "NAME", value_parser = name::<VertexOfTriangle>(&["first", "newest", "seeded"]), default_value = "first")]
    pub extreme: VertexOfTriangle,
    /// Key of the random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Which bad triangle is next
    #[arg(long, value_name = "NAME", value_parser = name::<QueueOrder>(&["fifo", "worst-first", "shortest-edge"]), default_value = "shortest-edge")]
    pub order: QueueOrder,
    /// Which free vertices a split deletes
    #[arg(long, value_name = "NAME", value_parser = name::<DeletionPolicy>(&["segment", "point", "disk"]), default_value = "segment")]
    pub deletion: DeletionPolicy,
    /// What to do at input angles below 60 degrees
    #[arg(long, value_name = "NAME", value_parser = name::<SmallAngles>(&["shells", "off"]), default_value = "shells")]
    pub small_angles: SmallAngles,
}

/// How to run.
#[derive(Args, Debug)]
pub struct RunArgs {
    /// The arithmetic: both give the same bytes
    #[arg(long, value_enum, default_value_t = KernelName::Fast)]
    pub kernel: KernelName,
    /// Run both kernels and compare every byte of their traces
    #[arg(long)]
    pub mirror: bool,
    /// Most steps; then the run is stopped: with a valid mesh, or in space without a file
    #[arg(long, value_name = "N", default_value_t = 10_000_000)]
    pub max_steps: u64,
    /// Most seconds; then likewise
    #[arg(long, value_name = "S")]
    pub max_seconds: Option<f64>,
}

/// What to write.
#[derive(Args, Debug)]
pub struct OutArgs {
    /// A file to write; the format is that of its extension. May be given more than once
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// The trace: text (.jsonl) or binary (.obt)
    #[arg(long, value_name = "FILE")]
    pub trace: Option<PathBuf>,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// The kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum KernelName {
    /// Filters, exact where they cannot decide
    Fast,
    /// Rationals throughout
    Exact,
}

/// Arguments of `verify`.
#[derive(Args, Debug)]
pub struct VerifyArgs {
    /// The trace, in either form
    pub trace: PathBuf,
    /// Also check that the trace is of this input
    #[arg(long)]
    pub input: Option<PathBuf>,
    /// Columns of the input
    #[command(flatten)]
    pub column: ColumnArgs,
    /// Prove the choices too: order, ties, parents, rounding
    #[arg(long)]
    pub strict: bool,
    /// Also check the inequalities with local feature size and density
    #[arg(long)]
    pub spacing: bool,
    /// Do not look at the digests
    #[arg(long)]
    pub no_digest: bool,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `check`.
#[derive(Args, Debug)]
pub struct CheckArgs {
    /// The mesh; the format is that of its extension
    pub mesh: PathBuf,
    /// The input it was made from; without it, marked edges are the constraints
    #[arg(long)]
    pub input: Option<PathBuf>,
    /// The mesh is one of the whole convex hull, as of `mesh --convex` or `triangulate`
    #[arg(long, requires = "input")]
    pub convex: bool,
    /// What to check, comma-separated
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub claims: Vec<String>,
    /// How far a vertex may be off its segment, in ulps of the bounding box. Default: 2
    #[arg(long, value_name = "ULPS")]
    pub within: Option<f64>,
    /// Least angle claimed, in degrees; without it, quality is only told
    #[arg(long, value_name = "DEG")]
    pub min_angle: Option<f64>,
    /// Of tetrahedra: the circumradius claimed to be below this many times the shortest edge; without it, quality is only told
    #[arg(long, value_name = "RHO")]
    pub radius_edge: Option<f64>,
    #[command(flatten)]
    pub column: ColumnArgs,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `doctor`.
#[derive(Args, Debug)]
pub struct DoctorArgs {
    /// The input
    pub input: PathBuf,
    /// As for `mesh --convex`
    #[arg(long)]
    pub convex: bool,
    #[command(flatten)]
    pub column: ColumnArgs,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `triangulate`.
#[derive(Args, Debug)]
pub struct TriangulateArgs {
    /// Points of the plane, perhaps with segments, or of space
    pub points: PathBuf,
    #[command(flatten)]
    pub column: ColumnArgs,
    /// Threads, in space; any number gives the same triangulation. Default: all cores
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// In space: the trace tells every insertion, not the finished triangulation alone
    #[arg(long)]
    pub steps: bool,
    #[command(flatten)]
    pub run: RunArgs,
    #[command(flatten)]
    pub out: OutArgs,
}

/// Where the weights of points of space stand.
#[derive(Args, Debug)]
pub struct ColumnArgs {
    /// The column of weights (squared radii), by name or number (from 1): points of space only
    #[arg(long, value_name = "COLUMN", conflicts_with = "radii")]
    pub weights: Option<String>,
    /// The column of radii, by name or number (from 1): points of space only
    #[arg(long, value_name = "COLUMN")]
    pub radii: Option<String>,
}

/// Arguments of `diff`.
#[derive(Args, Debug)]
pub struct DiffArgs {
    /// A trace
    pub first: PathBuf,
    /// Another
    pub second: PathBuf,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `replay`.
#[derive(Args, Debug)]
pub struct ReplayArgs {
    /// The trace
    pub trace: PathBuf,
    /// The last event to replay. Default: the end of the trace
    #[arg(long, value_name = "N")]
    pub to: Option<u64>,
    /// A file to write; may be given more than once
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
}

/// Arguments of `reproduce`.
#[derive(Args, Debug)]
pub struct ReproduceArgs {
    /// gcdr-table-7.1 or gcdr-figure-7.1
    pub name: String,
    /// Seeds of Experiment 2 of the table
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub seeds: u64,
    /// Where to draw the figure (.svg)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `convert`.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// What to convert
    pub from: PathBuf,
    /// Where to; the format is that of its extension
    pub to: PathBuf,
    #[command(flatten)]
    pub column: ColumnArgs,
}

const DISK: &[&str] = &["center", "extreme", "random", "offcenter", "clamped-offcenter"];
const INTERVAL: &[&str] = &["center", "extreme", "random"];

/// A parser of names that traces use too.
fn name<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    names: &'static [&'static str],
) -> impl TypedValueParser<Value = T> {
    // The names listed are those of the data's own text form.
    PossibleValuesParser::new(names).map(|s| serde_json::from_value(s.into()).expect("a name of the text form"))
}
