//! Points of space, with and without weights, on which triangulation code breaks; and sequences of edits.
//!
//! A case is a family of places (`SpaceFamily`) and, drawn independently, a family of weights (`WeightFamily`). Any dimension from none to
//! three occurs, and repeated places do: every point set is a valid input of a regular triangulation. No coordinate is -0.

mod cases;
mod edits;
mod families;
mod weights;

pub use cases::{EditCase, SpaceCase};
pub use edits::{Edit, edits};
pub use families::{SpaceFamily, space_points};
pub use weights::{WeightFamily, weighted_points};
