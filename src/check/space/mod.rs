//! The checker of triangulations of space.
//!
//! Problem: a trace claims that a complex of tetrahedra is *the* weighted Delaunay triangulation of its points, finished (`start`) or step by
//! step (events). Idea: a finished one is proved at once (`certificate`); each event then changes a part, and what is tested there proves the whole again
//! (`insert`, `fill`). Orthoballs are tested by their definition, from the orthocenter (`predicates`). Under strict verification the one tie-break
//! decides ties, so that there is one triangulation to accept, and what else is a choice is proved too: order, names, apexes.
//!
//! **Lower dimensions.** Where the points span d < 3 dimensions, 3 - d apexes off their hull make a point set of dimension 3. The points' triangulation
//! is the link of the apexes: every tetrahedron must contain all of them, and every point lie in the hull of the first simplex. The power test against a
//! tetrahedron is then that in the points' own hull, ties included: the coefficients of the apexes vanish.
//!
//! | file | says |
//! |---|---|
//! | `predicates` | orientation, orthosphere, the one tie-break |
//! | `integers` | near ties in integers of fixed width |
//! | `double` | numbers of twice the digits, for other near ties |
//! | `ball` | the same seen from one vertex; seldom tests |
//! | `glue` | which cells share a facet |
//! | `complex` | cells and links |
//! | `certificate` | a finished triangulation |
//! | `flood` | which cells an insertion destroys |
//! | `insert`, `fill` | insertion and removal |
//! | `view` | an insertion as the new vertex sees it |
//! | `hidden` | what became of each point |
//! | `replay` | events |
//! | `claims` | counts, the digest, the triangulation as data |
//! | `checker` | records |

//!
//! A row is a point seen from another, a ball the orthoball of three rows and what they are seen from, in three arithmetics: `ball` for one tetrahedron, `view` for all new ones of an
//! insertion with one bound of errors, `integers` for what the two leave undecided.

pub mod ball;
mod certificate;
mod checker;
mod claims;
mod complex;
pub(crate) mod double;
mod fill;
mod flood;
pub mod glue;
mod hidden;
mod insert;
mod integers;
pub mod predicates;
mod replay;
mod view;

#[cfg(test)]
mod tests;

pub(super) use checker::Checker3;
