//! What the rules keep account of besides the mesh.

use super::rows::Regions;
use crate::model::{GcdrParameters, Segment};
use crate::trace::Counts;

/// The run's parameters, and the records that its rules need of the past.
#[derive(Clone, Debug)]
pub struct Ledger {
    /// Parameters of the run.
    pub parameters: GcdrParameters,
    /// Selection regions, nominal and with slack.
    pub regions: Regions,
    /// Input segments.
    pub segments: Vec<Segment>,
    /// Area bound of each region seed.
    pub region_bounds: Vec<Option<f64>>,
    /// Input vertices that are an apex of shells.
    pub apexes: Vec<bool>,
    /// Rung of each vertex: its nominal distance, in input units, from the apex at an end of its segment.
    pub rungs: Vec<Option<(u32, f64)>>,
    /// Splits of each input segment.
    pub splits: Vec<u32>,
    /// Insertions by type, deletions.
    pub tally: Counts,
}

impl Ledger {
    /// The ledger of a run that begins with `apexes.len()` vertices.
    pub fn new(
        parameters: GcdrParameters,
        regions: Regions,
        segments: Vec<Segment>,
        apexes: Vec<bool>,
        region_bounds: Vec<Option<f64>>,
    ) -> Ledger {
        Ledger {
            rungs: vec![None; apexes.len()],
            splits: vec![0; segments.len()],
            parameters,
            regions,
            segments,
            region_bounds,
            apexes,
            tally: Counts::default(),
        }
    }
}
