//! Floor 2: the statement of a domain and its conditions.
//!
//! `normalise` brings coordinates into the range in which everything below is exact; `prepare` finds all that is wrong,
//! repairs what can be repaired without a new coordinate, and notes what the user may want to know. What needs a
//! triangulation (regions, seeds) is examined by `doctor`, with the findings this module provides.

mod angles;
mod crossings;
mod facing;
mod finding;
mod normalise;
mod normalise3;
mod repair;
mod sweep;
mod validate;

pub use angles::{SmallAngle, angle_notes, small_angles};
pub use facing::face_one_way;
pub use finding::{Element, Finding, Findings, Kind, LISTED_PER_KIND, Severity, merge_findings};
pub use normalise::{GREATEST_COORDINATE, LARGEST_SCALE, LEAST_COORDINATE, Scale, normalise};
pub use normalise3::{GREATEST_WEIGHT, LEAST_WEIGHT, normalise3, normalise3_at};
pub use validate::{Prepared, prepare};

#[cfg(test)]
mod tests;
