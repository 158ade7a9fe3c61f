//! Space: what the checker of traces and the audit of meshes both state about tetrahedra.
//!
//! | file | says |
//! |---|---|
//! | `predicates` | orientation, orthosphere, the one tie-break |
//! | `double` | numbers of twice the digits, for near ties |
//! | `glue` | which cells share a facet |

pub(crate) mod double;
pub mod glue;
pub mod predicates;
