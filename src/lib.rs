//! Verified, traced Delaunay refinement.
//!
//! A planar straight line graph goes in ([`model::Pslg`]); a mesh without small angles comes out, with a trace of every step
//! that [`check`] verifies with arithmetic and data structures of its own. Decisions are exact, coordinates are rounded once, and two
//! kernels give the same bytes.
//!
//! # The map
//! A module imports only from lower floors; `tests/floors.rs` sees to it, `docs/architecture.md` says more.
//!
//! | floor | module | does |
//! |---|---|---|
//! | top | [`cli`] | arguments, files, exit codes |
//! | | [`reproduce`] | tables and figures of the papers |
//! | 5 | [`refine`] | the algorithms; the only writers of events |
//! | 4 | [`doctor`] | all that is wrong with an input, by a trial triangulation |
//! | 3 | [`triangulation`] | the constrained Delaunay triangulation |
//! | 3 | [`io`] | readers and writers of files |
//! | 2 | [`domain`] | conditions of an input, repairs, scaling |
//! | 1 | [`arith`] | kernels: exact decisions, correctly rounded constructions |
//! | 1 | [`trace`] | records, and their two forms |
//! | 0 | [`model`] | plain data |
//! | beside | [`check`] | verifies traces; of the above it knows `model` and `trace` |
//! | beside | [`audit`] | judges the meshes of any program |
//!
//! # Example
//! A square meshed in memory, and its trace verified:
//! ```
//! use orthoball::arith::FastKernel;
//! use orthoball::check::{self, Verdict};
//! use orthoball::domain::prepare;
//! use orthoball::model::{GcdrParameters, Lines, Point2, Pslg, Segment, VertexId};
//! use orthoball::refine::{Options, everyday, gcdr};
//! use orthoball::trace::{Outcome, Recorder};
//!
//! let side = |i: u32| Segment { ends: [VertexId(i), VertexId((i + 1) % 4)], marker: 1, toggles: true };
//! let square = Pslg {
//!     points: [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)].map(|(x, y)| Point2::new(x, y)).to_vec(),
//!     segments: (0..4).map(side).collect(),
//!     ..Pslg::default()
//! };
//! // No angle of 28 degrees or less, no area above a quarter.
//! let parameters = GcdrParameters { max_area: Some(0.25), ..everyday(28.0)? };
//!
//! let prepared = prepare::<FastKernel>(&square, &Lines::default());
//! assert!(prepared.findings.is_empty());
//! let mut trace = Recorder::default();
//! let run = gcdr::run::<FastKernel>(&prepared.pslg, &parameters, &mut Options::default(), &mut trace)?;
//! assert_eq!(run.outcome, Outcome::Complete);
//! assert!(run.mesh.triangles.len() >= 36);
//!
//! let strict = check::Options { strict: true, ..check::Options::default() };
//! match check::verify(&trace.0, strict) {
//!     Verdict::Accepted { events, unchecked } => {
//!         assert_eq!(events, run.events);
//!         assert!(unchecked.is_empty());
//!     }
//!     Verdict::Rejected(why) => panic!("{why:?}"),
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod arith;
#[cfg(all(feature = "exact", feature = "generators"))]
pub mod attack;
pub mod audit;
pub mod check;
pub mod cli;
pub mod doctor;
pub mod domain;
#[cfg(any(test, feature = "generators"))]
pub mod generators;
pub mod io;
pub mod model;
pub mod refine;
pub mod reproduce;
pub mod trace;
pub mod triangulation;
