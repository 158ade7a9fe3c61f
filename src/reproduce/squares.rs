//! The input of \[GCDR\] section 7 and one measured run on it.

use crate::arith::FastKernel;
use crate::check::grading::Selection;
use crate::check::spacing::{Kind, Report, Spacing, Violation};
use crate::model::{
    Choice, DeletionPolicy, DiskChoice, Edge, GcdrParameters, Point2, Pslg, QueueOrder, Segment, SmallAngles, VertexId,
    VertexOfTriangle,
};
use crate::refine::{Options, Run, RunError, gcdr};
use crate::trace::{Event, Record, Sink};

/// Five concentric squares: the outermost has side 100, the others lie 1, 2, 3, 4 inside it.
///
/// Source: \[GCDR\] Figure 7.1: adjacent squares are one hundredth of the outermost side apart. The core inside the innermost is meshed.
pub fn squares() -> Pslg {
    let mut pslg = Pslg::default();
    for inset in [0.0, 1.0, 2.0, 3.0, 4.0] {
        let first = u32::try_from(pslg.points.len()).unwrap_or(0); // 20 points
        let (low, high) = (inset, 100.0 - inset);
        pslg.points.extend([(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Point2::new(x, y)));
        for k in 0..4 {
            let ends = [VertexId(first + k), VertexId(first + (k + 1) % 4)];
            pslg.segments.push(Segment { ends, marker: 0, toggles: true });
        }
    }
    pslg
}

/// How points are chosen in the selection regions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Experiment {
    /// The centers: Chew's second algorithm where all regions are points.
    Center,
    /// Experiment 1: as near to a vertex of the triangle or an end of the subsegment as the region allows.
    Extreme,
    /// Experiment 2: anywhere, by this seed.
    Random(u64),
}

/// Parameters of a run.
///
/// "An arbitrary vertex" (end) of Experiment 1 is the newest: with it and the order `fifo` each triangle count of Table 7.1 is met within 4%.
/// The other orders and vertices give 0.86 to 1.10 of the published counts.
pub fn parameters(rho2: f64, [d2, d1, mu]: [f64; 3], experiment: Experiment, order: QueueOrder) -> GcdrParameters {
    let (choice_a, choice) = match experiment {
        Experiment::Center => (DiskChoice::Center, Choice::Center),
        Experiment::Extreme => (DiskChoice::Extreme, Choice::Extreme),
        Experiment::Random(_) => (DiskChoice::Random, Choice::Random),
    };
    GcdrParameters {
        rho2,
        d1,
        d2,
        mu,
        choice_a,
        choice_b: choice,
        choice_c: choice,
        kappa: None,
        extreme: (experiment == Experiment::Extreme).then_some(VertexOfTriangle::Newest),
        seed: if let Experiment::Random(seed) = experiment { Some(seed) } else { None },
        order,
        deletion: DeletionPolicy::Segment,
        small_angles: SmallAngles::Off,
        max_area: None,
        size_function: false,
        max_splits: None,
    }
}

/// The selection regions of a run on the squares, whose angles are all 90 degrees.
pub fn selection(parameters: &GcdrParameters) -> Selection {
    Selection::of(parameters.rho2, parameters.d1, parameters.d2, parameters.mu)
}

/// A run whose densities were measured and whose rows of spacing were tested.
pub struct Measured {
    /// The run.
    pub run: Run,
    /// Densities and counts.
    pub report: Report,
    /// The first row that did not hold, if any.
    pub violation: Option<Violation>,
}

impl Measured {
    /// Largest densities of Type-A, B and C vertices; 0 where there are none.
    pub fn densities(&self) -> [f64; 3] {
        [Kind::A, Kind::B, Kind::C].map(|kind| self.report.densities.get(&kind).copied().unwrap_or(0.0))
    }
}

/// Refines the squares and measures.
pub fn measure(parameters: &GcdrParameters) -> Result<Measured, RunError> {
    let mut listener = Listener::default();
    let run = gcdr::run::<FastKernel>(&squares(), parameters, &mut Options::default(), &mut listener)?;
    let edges = listener.edges(&run);
    if listener.violation.is_none() {
        listener.violation = listener.spacing.finish(None, edges).err();
    }
    Ok(Measured { run, report: listener.spacing.report().clone(), violation: listener.violation })
}

/// Hands the records of a run to the checker's spacing.
#[derive(Default)]
struct Listener {
    spacing: Spacing,
    removed: Vec<VertexId>,
    violation: Option<Violation>,
}

impl Listener {
    /// Edges of the mesh, by ids of the run: the mesh lists vertices in ascending order of these, without the deleted ones.
    fn edges(&mut self, run: &Run) -> Vec<Edge> {
        self.removed.sort_unstable();
        let mut ids = Vec::new();
        let mut next = 0;
        while ids.len() < run.mesh.points.len() {
            if self.removed.binary_search(&VertexId(next)).is_err() {
                ids.push(VertexId(next));
            }
            next += 1;
        }
        let corners = run.mesh.triangles.iter().map(|t| t.map(|v| ids[v.index()]));
        let mut edges: Vec<Edge> = corners
            .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| if a < b { [a, b] } else { [b, a] })
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}

impl Sink for Listener {
    fn record(&mut self, record: &Record) -> std::io::Result<()> {
        if let Record::Event(Event::Remove { id, .. }) = record {
            self.removed.push(*id);
        }
        if self.violation.is_none() {
            self.violation = self.spacing.record(record).err();
        }
        Ok(())
    }
}
