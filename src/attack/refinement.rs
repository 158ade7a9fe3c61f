//! Refinement end to end: two kernels, one trace, one verdict.

use crate::arith::angle::{kappa, rho2_from_min_angle};
use crate::arith::{ExactKernel, FastKernel, Kernel, scale};
use crate::check::spacing::{Spacing, Violation};
use crate::check::{self, Checker, Verdict, verify};
use crate::domain::prepare;
use crate::generators::{Bytes, Draw, PslgFamily, pslg};
use crate::model::{
    Choice, DeletionPolicy, DiskChoice, Fill, GcdrParameters, Lines, Pslg, QueueOrder, SmallAngles, VertexOfTriangle,
};
use crate::refine::{self, gcdr};
use crate::trace::{Format, Reader, Record, Recorder, Sink, Writer};
use arbitrary::{Arbitrary, Result, Unstructured};

/// Most vertices asked of a graph: twice this with frames.
const MOST_VERTICES: u32 = 24;

/// A graph, parameters and a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct GcdrCase {
    /// Where the graph came from.
    pub family: PslgFamily,
    /// The graph, as a user would give it.
    pub pslg: Pslg,
    /// The parameters.
    pub parameters: GcdrParameters,
    /// Most events.
    pub steps: u64,
}

impl<'a> Arbitrary<'a> for GcdrCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let family = u.arbitrary()?;
        let draw = &mut Bytes(u.bytes(u.len())?);
        let mut parameters = parameters(draw);
        let steps = [200, 20, 60, 4][draw.below(4) as usize];
        let fill = [Fill::Seeds, Fill::Seeds, Fill::Convex, Fill::Parity][draw.below(4) as usize];
        let area = draw.below(8);
        let n = 3 + draw.below(MOST_VERTICES - 2) as usize;
        let pslg = Pslg { fill, ..pslg(family, n, draw) };
        if area >= 5 {
            // From some dozen to some thousand triangles over the bounding box.
            parameters.max_area = Some(box_area(&pslg) * scale::by_power_of_two(0.75, 2 - 3 * (area as i32 - 4)))
                .filter(|a| a.is_normal());
        }
        Ok(GcdrCase { family, pslg, parameters, steps })
    }
}

fn box_area(pslg: &Pslg) -> f64 {
    let first = pslg.points.first().copied().unwrap_or_default();
    let (mut low, mut high) = (first, first);
    for &p in &pslg.points {
        (low, high) = (low.min(p), high.max(p));
    }
    (high - low).x * (high - low).y
}

/// Parameters of all kinds, those present that are used, and no others.
pub(super) fn parameters(draw: &mut impl Draw) -> GcdrParameters {
    let degrees = match draw.below(8) {
        k @ 0..=5 => [25.0, 20.0, 30.0, 28.0, 5.0, 33.0][k as usize],
        _ => 1.0 + 33.0 * draw.unit(),
    };
    // Every angle between 1 and 45 degrees has a bound.
    let rho2 = rho2_from_min_angle(degrees).unwrap_or(1.0);
    let mut shrink = || match draw.below(4) {
        0 => 1.0,
        1 => 0.5,
        2 => 0.9,
        _ => 1.0 - draw.unit() * 0.999,
    };
    let [d1, d2, mu] = [shrink(), shrink(), shrink()];
    use DiskChoice::*;
    let choice_a = [Offcenter, Center, Extreme, Random, ClampedOffcenter][draw.below(5) as usize];
    let mut choice = || [Choice::Center, Choice::Extreme, Choice::Random][draw.below(3) as usize];
    let [choice_b, choice_c] = [choice(), choice()];
    let on_segments = |c| choice_b == c || choice_c == c;
    let vertex = [VertexOfTriangle::First, VertexOfTriangle::Newest, VertexOfTriangle::Seeded][draw.below(3) as usize];
    let extreme = (choice_a == Extreme || on_segments(Choice::Extreme)).then_some(vertex);
    let draws = choice_a == Random || on_segments(Choice::Random) || extreme == Some(VertexOfTriangle::Seeded);
    GcdrParameters {
        rho2,
        d1,
        d2,
        mu,
        choice_a,
        choice_b,
        choice_c,
        kappa: matches!(choice_a, Offcenter | ClampedOffcenter).then(|| match draw.below(4) {
            0 => 0.25 + 3.0 * draw.unit(),
            _ => kappa(rho2),
        }),
        extreme,
        seed: draws.then(|| draw.take(2)),
        order: [QueueOrder::ShortestEdge, QueueOrder::WorstFirst, QueueOrder::Fifo][draw.below(3) as usize],
        deletion: [DeletionPolicy::Segment, DeletionPolicy::Point, DeletionPolicy::Disk][draw.below(3) as usize],
        small_angles: [SmallAngles::Shells, SmallAngles::Off][draw.below(2) as usize],
        max_area: None,
        size_function: false,
        max_splits: (draw.below(4) == 3).then(|| draw.below(6)),
    }
}

/// The trace of a run, or the error it ended with.
pub(super) fn records<K: Kernel>(
    pslg: &Pslg,
    parameters: &GcdrParameters,
    max_steps: u64,
) -> std::result::Result<Vec<Record>, String> {
    let mut recorder = Recorder::default();
    let mut options = refine::Options { max_steps, ..refine::Options::default() };
    gcdr::run::<K>(pslg, parameters, &mut options, &mut recorder).map(|_| recorder.0).map_err(|e| e.to_string())
}

impl GcdrCase {
    /// The trace that the fast kernel writes; `None` where the input or a parameter is refused.
    pub fn trace(&self) -> Option<Vec<Record>> {
        let prepared = prepare::<FastKernel>(&self.pslg, &Lines::default());
        if prepared.has_errors() {
            return None;
        }
        records::<FastKernel>(&prepared.pslg, &self.parameters, self.steps).ok()
    }

    /// Asserts that the plain triangulation is the same with both kernels, and accepted.
    fn triangulate(&self, pslg: &Pslg) {
        let whole = Pslg { fill: Fill::Convex, ..pslg.clone() };
        let (mut fast, mut exact) = (Recorder::default(), Recorder::default());
        let ends = [
            refine::triangulate::<FastKernel>(&whole, &mut fast),
            refine::triangulate::<ExactKernel>(&whole, &mut exact),
        ]
        .map(|run| run.err().map(|e| e.to_string()));
        assert_eq!(ends[0], ends[1], "{self:?}");
        assert_eq!(fast.0, exact.0, "{self:?}");
        if ends[0].is_none() {
            let strict = check::Options { strict: true, digests: true };
            let verdict = verify(&fast.0, strict);
            assert!(matches!(verdict, Verdict::Accepted { .. }), "{verdict:?} of {self:?}");
        }
    }

    /// Asserts that both kernels find the same, that the strict checker accepts it whole, and that both forms of the trace give it back.
    pub fn run(&self) {
        let prepared = prepare::<FastKernel>(&self.pslg, &Lines::default());
        let again = prepare::<ExactKernel>(&self.pslg, &Lines::default());
        assert_eq!(prepared.findings, again.findings, "{self:?}");
        assert_eq!(prepared.pslg, again.pslg, "{self:?}");
        if prepared.has_errors() {
            return;
        }
        self.triangulate(&prepared.pslg);
        let fast = records::<FastKernel>(&prepared.pslg, &self.parameters, self.steps);
        let exact = records::<ExactKernel>(&prepared.pslg, &self.parameters, self.steps);
        let (fast, exact) = match (fast, exact) {
            (Ok(fast), Ok(exact)) => (fast, exact),
            (fast, exact) => {
                assert_eq!(fast, exact, "{self:?}");
                return;
            }
        };
        for (k, (f, e)) in fast.iter().zip(&exact).enumerate() {
            assert_eq!(f, e, "record {k} of {self:?}");
        }
        assert_eq!(fast.len(), exact.len(), "{self:?}");
        for strict in [false, true] {
            let options = check::Options { strict, digests: true };
            match verify(&fast, options) {
                Verdict::Accepted { unchecked, .. } => {
                    assert!(unchecked.is_empty() || !strict, "{unchecked:?} of {self:?}");
                }
                Verdict::Rejected(rejection) => {
                    panic!("{rejection} (strict: {strict}) of {self:?}")
                }
            }
        }
        if let Some(violation) = spacing_of(&fast) {
            panic!("{violation:?} of {self:?}");
        }
        for format in [Format::Text, Format::Binary] {
            let bytes = written(&fast, format);
            let back: std::result::Result<Vec<Record>, _> = Reader::new(&bytes[..]).collect();
            let mut back = back.unwrap_or_else(|e| panic!("{e} of {self:?}"));
            // The recorder's end lacks the digest that the writer fills in.
            if let (Some(Record::End(end)), Some(Record::End(original))) = (back.last_mut(), fast.last()) {
                end.trace.clone_from(&original.trace);
            }
            assert_eq!(back, fast, "{format:?} of {self:?}");
        }
    }
}

/// The first row of spacing that does not hold, of what the checker accepts of a trace.
pub(super) fn spacing_of(records: &[Record]) -> Option<Violation> {
    let mut checker = Checker::new(check::Options { strict: false, digests: false });
    let mut spacing = Spacing::new();
    for record in records {
        if checker.push(record).is_err() {
            return None;
        }
        if let Err(violation) = spacing.record(record) {
            return Some(violation);
        }
    }
    let (angle, edges) = (checker.smallest_angle(), checker.edges());
    spacing.finish(angle, edges).err()
}

/// A trace in one of its forms.
pub(super) fn written(records: &[Record], format: Format) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), format);
    for record in records {
        // A vector takes every byte, and the records are those of a run.
        writer.record(record).expect("a true trace can be written");
    }
    writer.finish().expect("a true trace has an end")
}
