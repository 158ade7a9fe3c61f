//! Refinement with a user's functions: choices and sizes that may be anything.

use super::refinement::{GcdrCase, spacing_of};
use crate::arith::scale::by_power_of_two;
use crate::arith::{ExactKernel, FastKernel, Kernel};
use crate::check::{self, Verdict, verify};
use crate::domain::prepare;
use crate::generators::{Bytes, Draw};
use crate::model::{Choice, DiskChoice, GcdrParameters, Lines, Point2, Pslg, VertexOfTriangle};
use crate::refine::{Chooser, DiskRequest, IntervalRequest, Options, RunError, gcdr};
use crate::trace::{Record, Recorder};
use arbitrary::{Arbitrary, Result, Unstructured};

/// A run, and what its user's functions answer.
#[derive(Clone, Debug, PartialEq)]
pub struct UserCase {
    /// What the functions draw from, over and over.
    pub answers: [u8; ANSWER_BYTES],
    /// The run; at least one of its choices or its sizes are the user's.
    pub origin: GcdrCase,
}

/// Bytes that decide on the answers.
const ANSWER_BYTES: usize = 40;

impl<'a> Arbitrary<'a> for UserCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let answers: [u8; ANSWER_BYTES] = u.arbitrary()?;
        let mut origin = GcdrCase::arbitrary(u)?;
        origin.steps = origin.steps.min(60);
        let p = &mut origin.parameters;
        // One of fifteen sets of functions.
        let which = 1 + answers[0] % 15;
        if which & 1 != 0 {
            p.choice_a = DiskChoice::User;
            p.kappa = None;
        }
        if which & 2 != 0 {
            p.choice_b = Choice::User;
        }
        if which & 4 != 0 {
            p.choice_c = Choice::User;
        }
        p.size_function = which & 8 != 0;
        tidy(p);
        Ok(UserCase { answers, origin })
    }
}

/// Takes out what no choice uses any more.
fn tidy(p: &mut GcdrParameters) {
    let on_segments = |c| p.choice_b == c || p.choice_c == c;
    if p.choice_a != DiskChoice::Extreme && !on_segments(Choice::Extreme) {
        p.extreme = None;
    }
    let draws = p.choice_a == DiskChoice::Random || on_segments(Choice::Random);
    if !draws && p.extreme != Some(VertexOfTriangle::Seeded) {
        p.seed = None;
    }
}

/// How a run ended.
type Ended = std::result::Result<Vec<Record>, RunError>;

impl UserCase {
    /// Asserts that whatever the functions answer both kernels end alike: refused by name, for an answer that is to be refused, or with a
    /// trace that the strict checker accepts.
    pub fn run(&self) {
        let prepared = prepare::<FastKernel>(&self.origin.pslg, &Lines::default());
        if prepared.has_errors() {
            return;
        }
        let (fast, given) = self.ended::<FastKernel>(&prepared.pslg);
        let (exact, again) = self.ended::<ExactKernel>(&prepared.pslg);
        assert_eq!(format!("{given:?}"), format!("{again:?}"), "the last answers of {self:?}");
        let trace = match (fast, exact) {
            (Ok(fast), Ok(exact)) => {
                assert_eq!(fast, exact, "{self:?}");
                fast
            }
            (Err(fast), Err(exact)) => {
                assert_eq!(format!("{fast:?}"), format!("{exact:?}"), "{self:?}");
                return given.justifies(&fast, self);
            }
            (fast, exact) => panic!("{fast:?} and {exact:?} of {self:?}"),
        };
        for strict in [false, true] {
            let verdict = verify(&trace, check::Options { strict, digests: true });
            assert!(matches!(verdict, Verdict::Accepted { .. }), "{verdict:?} (strict: {strict}) of {self:?}");
        }
        if let Some(violation) = spacing_of(&trace) {
            panic!("{violation:?} of {self:?}");
        }
    }

    /// Runs it with one kernel; also what the functions answered last.
    fn ended<K: Kernel>(&self, pslg: &Pslg) -> (Ended, Given) {
        let mut recorder = Recorder::default();
        let mut points = Hostile { draws: Cycle { bytes: &self.answers, at: 1 }, last: Point2::ZERO };
        let mut sizes = Cycle { bytes: &self.answers, at: 7 };
        let extent = extent(pslg);
        let mut value = 1.0;
        let mut size = |at: Point2| {
            value = sizes.size(extent, at);
            value
        };
        let mut options = Options {
            chooser: Some(&mut points),
            size: Some(&mut size),
            max_steps: self.origin.steps,
            ..Options::default()
        };
        let ended = gcdr::run::<K>(pslg, &self.origin.parameters, &mut options, &mut recorder);
        (ended.map(|_| recorder.0), Given { point: points.last, size: value })
    }
}

/// What the functions answered last.
#[derive(Clone, Copy, Debug)]
struct Given {
    point: Point2,
    size: f64,
}

impl Given {
    /// Asserts that an error tells of an answer, and of one that is to be refused.
    fn justifies(&self, error: &RunError, case: &UserCase) {
        match error {
            RunError::RegionViolation { point, .. } => {
                assert_eq!(format!("{point:?}"), format!("{:?}", self.point), "{case:?}");
            }
            RunError::Size { value, .. } => {
                assert_eq!(value.to_bits(), self.size.to_bits(), "{case:?}");
                let extent = extent(&case.origin.pslg);
                assert!(value.is_nan() || *value < extent * by_power_of_two(1.0, -398), "{error} of {case:?}");
            }
            // The graph or a parameter, as without functions.
            RunError::Carve(_) | RunError::Build(_) | RunError::Range(_) | RunError::Parameter { .. } => {}
            RunError::Io(_) | RunError::MissingFunction => panic!("{error} of {case:?}"),
        }
    }
}

/// The largest coordinate.
fn extent(pslg: &Pslg) -> f64 {
    pslg.points.iter().fold(0.0, |m, p| p.abs().max_element().max(m))
}

/// Draws that begin again at the end.
#[derive(Clone, Copy)]
struct Cycle<'a> {
    bytes: &'a [u8; ANSWER_BYTES],
    at: usize,
}

impl Draw for Cycle<'_> {
    fn take(&mut self, bytes: u32) -> u64 {
        let taken: Vec<u8> = (0..bytes as usize).map(|k| self.bytes[(self.at + k) % ANSWER_BYTES]).collect();
        self.at += bytes as usize;
        Bytes(&taken).take(bytes)
    }
}

impl Cycle<'_> {
    /// A size at a place: constant, graded, drawn anew each time, and sometimes none at all.
    fn size(&mut self, extent: f64, at: Point2) -> f64 {
        let some = extent * by_power_of_two(1.0, -self.integer(0, 6));
        match self.bytes[1] % 4 {
            0 => extent * by_power_of_two(1.0, -i32::from(self.bytes[2] % 5)),
            1 => at.x.abs() / 4.0 + extent / 32.0,
            2 => some,
            _ => match self.below(40) {
                0 => f64::NAN,
                1 => 0.0,
                2 => -some,
                3 => -0.0,
                4 => f64::NEG_INFINITY,
                5 => f64::from_bits(1),
                6..=9 => f64::INFINITY,
                10..=12 => f64::MAX,
                13 => by_power_of_two(extent, -60),
                _ => some,
            },
        }
    }
}

/// Answers with points of all kinds.
struct Hostile<'a> {
    draws: Cycle<'a>,
    last: Point2,
}

impl Hostile<'_> {
    fn answer(&mut self, p: Point2) -> Point2 {
        self.last = p;
        p
    }

    /// Points that have nothing to do with a region, but for the one given.
    fn anywhere(&mut self, near: Point2) -> Point2 {
        match self.draws.below(9) {
            0 => Point2::new(f64::NAN, near.y),
            1 => Point2::new(near.x, f64::INFINITY),
            2 => Point2::new(near.x, f64::MIN_POSITIVE),
            3 => Point2::splat(f64::MAX),
            4 => Point2::new(f64::from_bits(1), -0.0),
            5 => self.last,
            6 => -near,
            7 => near * 2.0,
            _ => Point2::ZERO,
        }
    }

    /// A point near another, by a few units in the last place.
    fn beside(&mut self, p: Point2) -> Point2 {
        let mut moved = p;
        for _ in 0..=self.draws.below(3) {
            match self.draws.below(4) {
                0 => moved.x = moved.x.next_up(),
                1 => moved.x = moved.x.next_down(),
                2 => moved.y = moved.y.next_up(),
                _ => moved.y = moved.y.next_down(),
            }
        }
        moved
    }

    /// Whether a wild answer is due: never, or one in 4 to 64.
    fn is_wild(&mut self) -> bool {
        let rate = self.draws.bytes[3] % 4;
        rate > 0 && self.draws.below(2 << (2 * rate)) == 0
    }
}

impl Chooser for Hostile<'_> {
    fn in_disk(&mut self, r: &DiskRequest) -> Point2 {
        let corner = r.corners[self.draws.below(3) as usize];
        let radius = (corner - r.center) * (1.0 - r.d2);
        if self.is_wild() {
            let wild = match self.draws.below(4) {
                0 => corner,
                1 => corner.midpoint(r.corners[0]),
                2 => self.beside(corner),
                _ => self.anywhere(r.center),
            };
            return self.answer(wild);
        }
        match self.draws.below(6) {
            0 => self.answer(r.center),
            1 => self.answer(r.center + radius),
            2 => {
                let boundary = self.beside(r.center + radius);
                self.answer(boundary)
            }
            3 => {
                let center = self.beside(r.center);
                self.answer(center)
            }
            _ => {
                let p = r.center + radius * (0.99 * self.draws.unit());
                self.answer(p)
            }
        }
    }

    fn in_interval(&mut self, r: &IntervalRequest) -> Point2 {
        let [u, v] = r.ends;
        let middle = u.midpoint(v);
        if self.is_wild() {
            let wild = match self.draws.below(5) {
                0 => u,
                1 => self.beside(v),
                2 => middle + (v - u).perp() * by_power_of_two(1.0, -self.draws.integer(2, 60)),
                3 => u + (v - u) * (3.0 * self.draws.signed_unit()),
                _ => self.anywhere(middle),
            };
            return self.answer(wild);
        }
        let reach = (v - u) * (0.5 * (1.0 - r.delta));
        match self.draws.below(5) {
            0 => self.answer(middle),
            1 => self.answer(middle + reach),
            2 => self.answer(middle - reach),
            3 => {
                let p = self.beside(middle);
                self.answer(p)
            }
            _ => {
                let p = middle + reach * self.draws.signed_unit();
                self.answer(p)
            }
        }
    }
}
