//! The mesh as a complex: cells turned positive, linked across facets; what of `valid` is local.

use super::Subject;
use super::report::{Claim, ClaimReport};
use crate::audit::report::Verdict;
use crate::check::space::glue::{self, Fan, Fringe, MOST_CELLS, MOST_VERTICES};
use crate::check::space::predicates::{Corners, orient};
use crate::model::{Point3, Sign, VertexId, WeightedPoint};

/// Whether the orientations of cells are known to be as the file has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Orientations {
    /// Each is tested, and negative cells are turned.
    Tested,
    /// All are said to be positive; who relies on it has to test it.
    Granted,
}

/// Cells whose corners are fetched together, since memory answers many questions in the time of one.
const BATCH: usize = 16;

/// Most cells: twelve numbers for each, one for every edge of every facet, must fit 32 bits.
const MOST: usize = MOST_CELLS / 3;

/// The usable cells of a mesh. A slot is `4 t + k`: the facet of cell t across from corner k.
pub(super) struct Complex<'a> {
    pub subject: &'a Subject<'a>,
    /// The points, scaled by a power of two so that neither a coordinate nor a weight exceeds 1. Those that are not finite are at 0.
    pub sites: Vec<WeightedPoint>,
    /// Positive.
    pub cells: Vec<[u32; 4]>,
    /// Position of each in the file.
    pub in_file: Vec<u32>,
    /// Positions in the file of cells that are negative there.
    pub negative: Vec<u32>,
    /// Positions in the file of cells that have no orientation: flat, or not of four points.
    pub improper: Vec<u32>,
    /// Whether all points are finite.
    all_finite: bool,
    /// A scaled coordinate of 1 stands for 2 to this power.
    exponent: i32,
    /// A vertex whose coordinates or weight scaling cannot keep.
    pub unscalable: Option<u32>,
}

impl<'a> Complex<'a> {
    /// Builds it, and answers what single cells say of `valid`.
    pub fn new(subject: &'a Subject<'a>, orientations: Orientations) -> (Self, ClaimReport) {
        let mut report = ClaimReport::new(Claim::Valid);
        let (sites, exponent, unscalable) = scaled(subject);
        let mut complex = Complex {
            subject,
            all_finite: (0..sites.len()).all(|v| is_finite(subject, v as u32)),
            sites,
            cells: Vec::with_capacity(subject.cells.len()),
            in_file: Vec::with_capacity(subject.cells.len()),
            negative: Vec::new(),
            improper: Vec::new(),
            exponent,
            unscalable,
        };
        if subject.cells.len() > MOST || subject.points.len() > MOST_VERTICES {
            return (
                complex,
                ClaimReport::unchecked(Claim::Valid, "there are more cells or points than can be numbered"),
            );
        }
        let mut places = Vec::new();
        for (k, batch) in (0u32..).zip(subject.cells.chunks(BATCH)) {
            complex.take(BATCH as u32 * k, batch, orientations, &mut places, &mut report);
        }
        if complex.cells.is_empty() && report.verdict == Verdict::Holds {
            report = ClaimReport::unchecked(Claim::Valid, "there is no cell");
        }
        (complex, report)
    }

    /// Whether a cell has each vertex.
    pub fn used(&self) -> Vec<bool> {
        let mut used = vec![false; self.sites.len()];
        self.cells.iter().flatten().for_each(|&v| used[v as usize] = true);
        used
    }

    /// What a scaled coordinate of 1 stands for, for display.
    pub fn unit(&self) -> f64 {
        halves(self.exponent).iter().product()
    }

    /// The place of a vertex, scaled.
    pub fn at(&self, v: u32) -> Point3 {
        self.sites[v as usize].at
    }

    pub fn corners(&self, t: u32) -> Corners {
        self.cells[t as usize].map(|v| self.sites[v as usize])
    }

    /// The corners of a facet, counterclockwise as seen from its cell.
    pub fn facet(&self, slot: u32) -> [u32; 3] {
        glue::facet(&self.cells, slot)
    }

    /// The corner across from a facet, in its cell.
    pub fn apex(&self, slot: u32) -> u32 {
        self.cells[(slot / 4) as usize][(slot % 4) as usize]
    }

    /// The cell of a slot, as the file counts.
    pub fn cell_in_file(&self, slot: u32) -> u32 {
        self.in_file[(slot / 4) as usize]
    }

    /// Takes the cells of the file from `first` on that are proper, turned positive. `places` is space to work in.
    fn take(
        &mut self,
        first: u32,
        batch: &[[VertexId; 4]],
        orientations: Orientations,
        places: &mut Vec<[Point3; 4]>,
        report: &mut ClaimReport,
    ) {
        places.clear();
        if orientations == Orientations::Tested {
            let place = |v: VertexId| self.sites.get(v.index()).map_or(Point3::ZERO, |p| p.at);
            places.extend(batch.iter().map(|cell| cell.map(place)));
        }
        for (i, cell) in (first..).zip(batch) {
            self.take_one(i, cell.map(|v| v.0), places.get((i - first) as usize), report);
        }
    }

    /// Takes cell i of the file, with corners at these places, or else as it is.
    fn take_one(&mut self, i: u32, mut cell: [u32; 4], places: Option<&[Point3; 4]>, report: &mut ClaimReport) {
        let subject = self.subject;
        if let Some(&v) = cell.iter().find(|&&v| v as usize >= self.sites.len()) {
            self.improper.push(i);
            report.violated(subject, &[], &[i], || format!("cell {i} refers to vertex {v}, which does not exist"));
            return;
        }
        let broken = |v: &&u32| !self.all_finite && !is_finite(subject, **v);
        if let Some(&v) = cell.iter().find(broken) {
            self.improper.push(i);
            report.violated(subject, &[v], &[i], || format!("cell {i} has vertex {v}, which is not finite"));
            return;
        }
        // Links are made of cells with four different corners; what is granted otherwise is told by the second audit.
        let orientation = places.map_or(Sign::Positive, |&[a, b, c, d]| orient(a, b, c, d));
        let [a, b, c, d] = cell;
        let repeated = a == b || a == c || a == d || b == c || b == d || c == d;
        match if repeated { Sign::Zero } else { orientation } {
            Sign::Positive => {}
            Sign::Negative => {
                self.negative.push(i);
                cell.swap(2, 3);
            }
            Sign::Zero => {
                self.improper.push(i);
                report.violated(subject, &cell, &[i], || {
                    format!("cell {i} is degenerate: {a}, {b}, {c}, {d} lie in one plane")
                });
                return;
            }
        }
        self.cells.push(cell);
        self.in_file.push(i);
    }

    /// Links cells across their facets, whose fans it shows: both cells at a facet must lie on different sides of it.
    pub fn link(&self, report: &mut ClaimReport, see: impl FnMut(&Fan)) -> Fringe {
        let mut fringe = glue::visit(&self.cells, self.sites.len(), see);
        for slots in std::mem::take(&mut fringe.clashes) {
            let mut apart = slots.clone();
            apart.sort_by_key(|&s| (self.apex(s), self.in_file[(s / 4) as usize]));
            for same in apart.chunk_by(|&s, &t| self.apex(s) == self.apex(t)).filter(|same| same.len() > 1) {
                self.doubled(same, report);
            }
            apart.dedup_by_key(|s| self.apex(*s));
            let turned = |s: u32| self.turns_up(s);
            if let [_] = apart[..] {
                continue;
            }
            if let [s, t] = apart[..]
                && turned(s) != turned(t)
            {
                continue;
            }
            let mut cells: Vec<u32> = apart.iter().map(|&s| self.cell_in_file(s)).collect();
            cells.sort_unstable();
            let facet @ [a, b, c] = self.facet(slots[0]);
            report.violated(self.subject, &facet, &cells, || match cells.len() {
                2 => format!("cells {cells:?} lie on the same side of their common facet {a}, {b}, {c}"),
                n => format!("facet {a}, {b}, {c} belongs to {n} cells: {cells:?}"),
            });
        }
        fringe
    }

    /// Whether a facet, from its smallest corner on, turns to the larger of the others last.
    fn turns_up(&self, slot: u32) -> bool {
        let [a, b, c] = self.facet(slot);
        // Of the three rotations of an ascending triple each descends once.
        usize::from(a > b) + usize::from(b > c) + usize::from(c > a) == 1
    }

    /// Slots of cells with the same corners; told at one of their four facets.
    fn doubled(&self, slots: &[u32], report: &mut ClaimReport) {
        let cell = self.cells[(slots[0] / 4) as usize];
        if cell.iter().min() == Some(&self.apex(slots[0])) {
            let cells: Vec<u32> = slots.iter().map(|&s| self.cell_in_file(s)).collect();
            let [a, b, c, d] = cell;
            report.violated(self.subject, &cell, &cells, || {
                format!("cells {cells:?} have the same corners {a}, {b}, {c}, {d}")
            });
        }
    }
}

/// Whether all cells are positive in the file.
pub(super) fn orientation(complex: &Complex<'_>) -> ClaimReport {
    let mut report = ClaimReport::new(Claim::Orientation);
    for &t in &complex.negative {
        let vertices = complex.subject.cells[t as usize].map(|v| v.0);
        report.violated(complex.subject, &vertices, &[t], || format!("cell {t} {vertices:?} is negative"));
    }
    for &t in &complex.improper {
        let vertices = complex.subject.cells[t as usize].map(|v| v.0);
        let known: Vec<u32> = vertices.into_iter().filter(|&v| (v as usize) < complex.sites.len()).collect();
        report.violated(complex.subject, &known, &[t], || {
            format!("cell {t} {vertices:?} has no orientation: it is flat, or not of four points")
        });
    }
    let all = !complex.negative.is_empty() && complex.negative.len() == complex.subject.cells.len();
    let mut report = report.conclude("every cell is positive");
    if all {
        report.message = "every cell is negative".into();
    }
    report
}

/// Whether all numbers of a point are finite.
pub(super) fn is_finite(subject: &Subject<'_>, v: u32) -> bool {
    subject.points[v as usize].is_finite() && subject.weights.get(v as usize).is_none_or(|w| w.is_finite())
}

/// The points over 2^e and the weights over 4^e, none above 1; e; and a finite point that loses bits by it.
fn scaled(subject: &Subject<'_>) -> (Vec<WeightedPoint>, i32, Option<u32>) {
    let finite = |x: f64| if x.is_finite() { x.abs() } else { 0.0 };
    let largest = subject.points.iter().fold(0.0, |m: f64, p| m.max(finite(p.x)).max(finite(p.y)).max(finite(p.z)));
    let heaviest = subject.weights.iter().fold(0.0, |m: f64, &w| m.max(finite(w)));
    // The least e with 2^e above both the largest coordinate and the root of the largest weight.
    let weight_exponent = if heaviest > 0.0 { (exponent(heaviest) + 1).div_euclid(2) } else { i32::MIN };
    let e = exponent(largest).max(weight_exponent);
    let [one, four] = [halves(-e), halves(-2 * e)];
    let [back_one, back_four] = [halves(e), halves(2 * e)];
    let times = |x: f64, powers: &[f64; 4]| powers.iter().fold(x, |x, power| x * power);
    let mut unscalable = None;
    let mut sites = Vec::with_capacity(subject.points.len());
    for (v, &p) in subject.points.iter().enumerate() {
        let weight = subject.weights.get(v).copied().unwrap_or(0.0);
        if !is_finite(subject, v as u32) {
            sites.push(WeightedPoint::default());
            continue;
        }
        let site = WeightedPoint {
            at: Point3::new(times(p.x, &one), times(p.y, &one), times(p.z, &one)),
            weight: times(weight, &four),
        };
        let back = [times(site.at.x, &back_one), times(site.at.y, &back_one), times(site.at.z, &back_one)];
        if unscalable.is_none() && (back != p.to_array() || times(site.weight, &back_four) != weight) {
            unscalable = Some(v as u32);
        }
        sites.push(site);
    }
    (sites, e, unscalable)
}

/// The least e with x < 2^e, of a finite x >= 0; for 0 and subnormal x, that of the least normal number.
fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) as i32 - 1022).max(-1021)
}

/// 2^e as four factors, each and each partial product with 1 a normal number.
fn halves(e: i32) -> [f64; 4] {
    let part = |k: i32| (e + k).div_euclid(4);
    [part(0), part(1), part(2), part(3)].map(|e| f64::from_bits(((e + 1023) as u64) << 52))
}
