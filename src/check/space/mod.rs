//! Space: what the checker of traces and the audit of meshes both state about tetrahedra.
//!
//! | file | says |
//! |---|---|
//! | `predicates` | orientation, orthosphere, the one tie-break |
//! | `glue` | which cells share a facet |

pub mod glue;
pub mod predicates;
