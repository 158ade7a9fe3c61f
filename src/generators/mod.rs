//! Generators of pathological inputs: the point sets of plane and space and the straight line graphs on which geometric code breaks.
//!
//! Problem: uniformly random coordinates meet no tie, no near-tie and no change of scale. Idea: each *family* is one way of being nasty,
//! described by its distribution and written once over a source of draws (`Draw`), which is either a seeded generator (proptest,
//! benchmarks) or the bytes of a fuzzer. Small draws give small, round coordinates, so that what a fuzzer or a shrinker leaves is readable.
//!
//! - `points`, `PointFamily`: distinct points, never all on one line.
//! - `pslg`, `PslgFamily`: graphs that can be meshed: segments meet only in common ends (but for `PslgFamily::OnSegments`, whose vertices
//!   on segments are to be repaired), at least one closed region, seeds strictly inside their faces.
//! - `broken`, `Defect`: graphs with one planted defect.
//! - `weighted_points`, `SpaceFamily`, `WeightFamily`: points of space with weights, of any dimension, places repeated or not; `edits`, `Edit`:
//!   insertions, removals and changes of weight.
//! - `PointCase`, `PslgCase`, `BrokenCase`, `SpaceCase`, `EditCase`: the same, decodable from bytes (`arbitrary`) and as proptest strategies (`strategies`).
//!
//! Validity is decided by exact predicates on the stored coordinates, by brute force; sizes are meant to be small (to some 2,000 points).

mod broken;
mod cases;
mod draw;
mod graphs;
mod planar;
mod point_sets;
mod space;
pub mod strategies;

pub use broken::{Defect, broken};
pub use cases::{BrokenCase, PointCase, PslgCase};
pub use draw::{Bytes, Draw, SplitMix64};
pub use graphs::{PslgFamily, pslg};
pub use planar::Planar;
pub use point_sets::{PointFamily, points};
pub use space::{Edit, EditCase, SpaceCase, SpaceFamily, WeightFamily, edits, space_points, weighted_points};
