//! The bulk build on several threads. The triangulation is unique, so that any number of them gives the same one.
//!
//! Idea: the points are cut into boxes, one for each thread. A thread triangulates the points of its box and those of a *halo* around it. A cell whose
//! orthoball, within the bounding box of all points, keeps inside box and halo is in conflict with no other point: it is a cell of the
//! whole. Where that is not sure, the points around are called *torn*. What the sure cells leave open is filled from the triangulation of
//! the torn points (`fill`), which has every cell that is missing: a missing cell is sure to none of the threads in whose boxes its corners lie, so each of
//! them either has the cell and is not sure of it, or has something else there, which is no cell of the whole and of which it cannot be sure.
//!
//! ```text
//!      +--------:-------+            box | halo of the left thread ends at :
//!      |   o    : |  o  |            cell abc: its circle keeps left of :, the left thread is sure of it
//!      | a----b : |     |            cell bde: sure to one of the two threads or to both
//!      |  \  /  d |   o |
//!      |   c   /:e|     |
//!      +--------:-------+
//! ```
//!
//! Whether an orthoball keeps inside is estimated in plain floating point; a misjudgement cannot pass. The facets where cells of different origin meet are
//! tested, and the hidden points: a closed complex that is regular across every facet, with no hidden point in conflict, is the triangulation.
//! Should a test fail, or too many points be torn (all of them are on the hull, say), one thread does it all.

use super::fill::{Key, cells_within, key};
use super::star::Rim;
use super::store::{Cell, FACET, FIRST, NONE, Regular3, Status};
use crate::arith::space::Kernel3;
use crate::model::{Point3, VertexId, WeightedPoint, canonical_tetrahedron};
use rayon::prelude::*;

/// Fewer points than this a thread are not worth its start.
const POINTS_PER_THREAD: usize = 10_000;
/// Layers of points in a halo: of uniform points all but one cell in some millions are smaller.
const LAYERS: usize = 4;

/// A box of space, closed below and open above, infinite where nothing was cut, with the points in it.
#[derive(Clone, Debug)]
struct Part {
    low: Point3,
    high: Point3,
    /// Ids, ascending.
    own: Vec<u32>,
}

/// What a thread has found.
#[derive(Debug, Default)]
struct Piece {
    /// The ids of the points of the box, in the order of their places.
    order: Vec<u32>,
    /// Pairs of a duplicate and the id that stands for it.
    twins: Vec<[u32; 2]>,
    /// Sure cells that have all corners in the box: corners by their ranks in `order`, links among these cells or `NONE`.
    inner: Vec<Cell>,
    /// Other sure cells with a corner in the box: positively oriented ids.
    mixed: Vec<[u32; 4]>,
    /// Ids of corners of cells that are not sure.
    torn: Vec<u32>,
}

impl<K: Kernel3> Regular3<K> {
    /// The triangulation by several threads; `None` where one of them does better.
    pub(super) fn build_together(points: &[WeightedPoint], threads: usize) -> Option<Self> {
        let parts = threads.min(points.len() / POINTS_PER_THREAD);
        if parts < 2 {
            return None;
        }
        let (low, high) = bounds(points);
        let whole = Part {
            low: Point3::splat(f64::NEG_INFINITY),
            high: Point3::splat(f64::INFINITY),
            own: (0..points.len() as u32).collect(),
        };
        let mut all = Vec::new();
        cut(points, whole, parts, &mut all);
        let heaviest = points.iter().map(|p| p.weight).fold(f64::NEG_INFINITY, f64::max);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()?;
        let pieces: Vec<Piece> = pool.install(|| {
            let piece = |part: &Part| piece::<K>(points, part, &Surroundings { low, high, heaviest });
            all.par_iter().map(piece).collect()
        });
        let torn: usize = pieces.iter().map(|p| p.torn.len()).sum();
        if torn > points.len() / 2 { None } else { Self::assemble(points, pieces) }
    }

    /// Puts the pieces together and fills what they leave open; `None` if they do not fit.
    fn assemble(points: &[WeightedPoint], pieces: Vec<Piece>) -> Option<Self> {
        let mut t = Self::with_capacity(points.len());
        t.places.resize(points.len(), NONE);
        t.dimension = Some(3);
        for (place, &id) in (FIRST..).zip(pieces.iter().flat_map(|p| &p.order)) {
            t.add_site(points[id as usize], id);
            t.places[id as usize] = place;
        }
        for [twin, of] in pieces.iter().flat_map(|p| &p.twins) {
            let (twin, of) = (t.places[*twin as usize], t.places[*of as usize]);
            t.make_twin(twin, of);
        }
        let mut torn: Vec<u32> = pieces.iter().flat_map(|p| &p.torn).map(|&id| t.places[id as usize]).collect();
        torn.sort_unstable();
        torn.dedup();
        let (mut first, mut mixed) = (FIRST, Vec::new());
        for piece in pieces {
            t.append(piece.inner, first);
            first += piece.order.len() as u32;
            mixed.extend(piece.mixed);
        }
        let facets = t.open_facets(mixed);
        let mut seams = Vec::new();
        let rim = t.glue_facets(facets, &mut seams);
        t.close(&rim, &torn, &mut seams)?;
        t.marks = vec![0; t.cells.len()];
        t.last = seams.first()?[0] >> 2;
        t.settle();
        t.fits(&seams).then_some(t)
    }

    /// Appends the inner cells of a piece whose first own point has place `first`.
    fn append(&mut self, inner: Vec<Cell>, first: u32) {
        let base = 4 * self.cells.len() as u32;
        let moved =
            |c: Cell| Cell { v: c.v.map(|v| v + first), n: c.n.map(|n| if n == NONE { NONE } else { n + base }) };
        self.cells.extend(inner.into_iter().map(moved));
    }

    /// Appends the mixed cells, each once; lists all facets that have no link yet.
    fn open_facets(&mut self, mixed: Vec<[u32; 4]>) -> Vec<(Key, u32)> {
        let mut mixed: Vec<_> = mixed.into_iter().map(|c| canonical_tetrahedron(c.map(VertexId))).collect();
        mixed.sort_unstable();
        mixed.dedup();
        let of_mixed = mixed.iter().map(|c| Cell { v: c.map(|v| self.places[v.index()]), n: [NONE; 4] });
        let of_mixed: Vec<Cell> = of_mixed.collect();
        self.cells.extend(of_mixed);
        let mut facets = Vec::new();
        for (c, cell) in (0u32..).zip(&self.cells) {
            for i in (0..4).filter(|&i| cell.n[i] == NONE) {
                facets.push((key(FACET[i].map(|k| cell.v[k])), 4 * c + i as u32));
            }
        }
        facets
    }

    /// Links facets that occur twice, and lists those links; returns the others, seen from outside of the cells.
    fn glue_facets(&mut self, mut facets: Vec<(Key, u32)>, seams: &mut Vec<[u32; 2]>) -> Vec<Rim> {
        facets.sort_unstable();
        let mut rim = Vec::new();
        for same in facets.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, one), (_, other)] = *same {
                self.link(one, other);
                seams.push([one, other]);
                continue;
            }
            for &(_, link) in same {
                let v = self.cells[(link >> 2) as usize].v;
                let [x, y, z] = FACET[(link & 3) as usize].map(|k| v[k]);
                rim.push(Rim { v: [x, z, y], outer: link });
            }
        }
        rim
    }

    /// Fills what is open from the triangulation of the torn points; `None` if that leaves anything open.
    fn close(&mut self, rim: &[Rim], torn: &[u32], seams: &mut Vec<[u32; 2]>) -> Option<()> {
        let points: Vec<WeightedPoint> = torn.iter().map(|&place| self.site(place)).collect();
        let subset = Self::build_alone(&points);
        if subset.dimension != Some(3) {
            return None;
        }
        let mut facets: Vec<(Key, u32)> = rim.iter().map(|f| (key(f.v), f.outer)).collect();
        for v in cells_within(&subset, torn, rim) {
            let c = self.cells.len() as u32;
            facets.extend((0u32..).zip(FACET).map(|(i, f)| (key(f.map(|k| v[k])), 4 * c + i)));
            self.cells.push(Cell { v, n: [NONE; 4] });
        }
        self.glue_facets(facets, seams).is_empty().then_some(())
    }

    /// Whether the complex is regular across the seams and hidden points are.
    fn fits(&self, seams: &[[u32; 2]]) -> bool {
        let regular = |from: u32, to: u32| {
            let cell = &self.cells[(from >> 2) as usize];
            let opposite = self.cells[(to >> 2) as usize].v[(to & 3) as usize];
            opposite < FIRST || !self.in_conflict(cell, self.site(opposite))
        };
        let hidden = |(&c, places): (&u32, &Vec<u32>)| {
            let cell = &self.cells[c as usize];
            !cell.is_ghost() && places.iter().all(|&place| !self.in_conflict(cell, self.site(place)))
        };
        seams.iter().all(|&[one, other]| regular(one, other) && regular(other, one))
            && self.lodgers.of_cell.iter().all(hidden)
    }
}

/// The smallest box around the points.
fn bounds(points: &[WeightedPoint]) -> (Point3, Point3) {
    let none = (Point3::splat(f64::INFINITY), Point3::splat(f64::NEG_INFINITY));
    points.iter().fold(none, |(low, high), p| (low.min(p.at), high.max(p.at)))
}

/// Cuts a part into `count` parts with about equally many points, each cut across the longest extent; fewer where points have equal coordinates.
fn cut(points: &[WeightedPoint], mut part: Part, count: usize, all: &mut Vec<Part>) {
    let at = |id: u32| points[id as usize].at;
    let none = (Point3::splat(f64::INFINITY), Point3::splat(f64::NEG_INFINITY));
    let (low, high) = part.own.iter().fold(none, |(low, high), &id| (low.min(at(id)), high.max(at(id))));
    let axis = (high - low)
        .to_array()
        .iter()
        .enumerate()
        .fold((0, f64::NEG_INFINITY), |best, (i, &x)| if x > best.1 { (i, x) } else { best })
        .0;
    let first = count / 2;
    if first > 0 {
        let middle = part.own.len() * first / count;
        let (_, &mut pivot, _) = part.own.select_nth_unstable_by(middle, |&a, &b| at(a)[axis].total_cmp(&at(b)[axis]));
        let c = at(pivot)[axis];
        let (below, above): (Vec<u32>, Vec<u32>) = part.own.iter().partition(|&&id| at(id)[axis] < c);
        if !below.is_empty() {
            let mut lower = Part { own: below, ..part };
            let mut upper = Part { own: above, low: part.low, high: part.high };
            lower.high[axis] = c;
            upper.low[axis] = c;
            cut(points, lower, first, all);
            cut(points, upper, count - first, all);
            return;
        }
    }
    part.own.sort_unstable();
    all.push(part);
}

/// What a thread knows of all points.
struct Surroundings {
    /// The box of all points.
    low: Point3,
    high: Point3,
    /// The largest weight.
    heaviest: f64,
}

/// How far the halo of a part reaches beyond each of its sides.
fn widths(points: &[WeightedPoint], part: &Part) -> (Point3, Point3) {
    let mut layer = 1;
    // The number of points in a layer: the square of the cube root.
    while (layer + 1) * (layer + 1) * (layer + 1) <= part.own.len() {
        layer += 1;
    }
    let rank = (LAYERS * layer * layer).min(part.own.len() - 1);
    let reach = |side: f64, axis: usize| {
        if side.is_infinite() {
            return f64::INFINITY;
        }
        let mut distances: Vec<f64> = part.own.iter().map(|&id| (points[id as usize].at[axis] - side).abs()).collect();
        *distances.select_nth_unstable_by(rank, f64::total_cmp).1
    };
    let of = |sides: Point3| Point3::from_array([0, 1, 2].map(|axis| reach(sides[axis], axis)));
    (of(part.low), of(part.high))
}

/// Triangulates a part with its halo, and sorts the cells.
fn piece<K: Kernel3>(points: &[WeightedPoint], part: &Part, all: &Surroundings) -> Piece {
    let (below, above) = widths(points, part);
    let (low, high) = (part.low - below, part.high + above);
    let within = |p: Point3, low: Point3, high: Point3| p.cmpge(low).all() && p.cmplt(high).all();
    let mut ids = part.own.clone();
    let halo = |p: Point3| within(p, low, high) && !within(p, part.low, part.high);
    ids.extend((0u32..).zip(points).filter(|(_, p)| halo(p.at)).map(|(id, _)| id));
    let local: Vec<WeightedPoint> = ids.iter().map(|&id| points[id as usize]).collect();
    let t = Regular3::<K>::build_alone(&local);
    sort_cells(t, &ids, part.own.len() as u32, |t, cell| t.keeps_inside(cell, low, high, all))
}

/// Sorts the cells of a part's triangulation; its points have the given ids, the first `own` of them lie in its box.
fn sort_cells<K: Kernel3>(
    mut t: Regular3<K>,
    ids: &[u32],
    own: u32,
    sure: impl Fn(&Regular3<K>, &Cell) -> bool,
) -> Piece {
    let mut piece = Piece::default();
    let mut rank = vec![NONE; t.sites.len()];
    for place in FIRST..t.sites.len() as u32 {
        let i = place as usize;
        if t.ids[i] < own {
            rank[i] = piece.order.len() as u32;
            piece.order.push(ids[t.ids[i] as usize]);
            if t.status[i] == Status::Duplicate {
                piece.twins.push([ids[t.ids[i] as usize], ids[t.ids[t.hints[i] as usize] as usize]]);
            }
        }
    }
    let id = |v: u32| ids[t.ids[v as usize] as usize];
    let spans_space = t.dimension == Some(3);
    if !spans_space {
        piece.torn.extend(&piece.order);
    }
    let mut number = vec![NONE; t.cells.len()];
    let mut inner = 0;
    for (c, cell) in t.cells.iter().enumerate().filter(|(_, c)| spans_space && !c.is_free()) {
        let inside = cell.v.iter().filter(|&&v| rank[v as usize] != NONE).count();
        if inside == 0 {
            continue;
        }
        if cell.is_ghost() || !sure(&t, cell) {
            piece.torn.extend(cell.v.iter().filter(|&&v| v >= FIRST).map(|&v| id(v)));
        } else if inside == 4 {
            number[c] = inner;
            inner += 1;
        } else {
            piece.mixed.push(cell.v.map(id));
        }
    }
    // The inner cells close up in place: memory for a second copy would be the peak of the build.
    for c in 0..t.cells.len() {
        if number[c] != NONE {
            let Cell { v, n } = t.cells[c];
            let link = |link: u32| match number[(link >> 2) as usize] {
                NONE => NONE,
                beyond => 4 * beyond + (link & 3),
            };
            t.cells[number[c] as usize] = Cell { v: v.map(|v| rank[v as usize]), n: n.map(link) };
        }
    }
    t.cells.truncate(inner as usize);
    piece.inner = t.cells;
    piece.torn.sort_unstable();
    piece.torn.dedup();
    piece
}

impl<K: Kernel3> Regular3<K> {
    /// Whether the orthoball of a finite cell, so large that points of the largest weight outside of it are in no conflict, keeps between `low` and
    /// `high` within the box of all points: an estimate, with a small margin.
    fn keeps_inside(&self, cell: &Cell, low: Point3, high: Point3, all: &Surroundings) -> bool {
        let [p0, p1, p2, p3] = self.corners(cell);
        let [a, b, c] = [p1, p2, p3].map(|p| p.at - p0.at);
        let height = |v: Point3, p: WeightedPoint| v.length_squared() + p0.weight - p.weight;
        let offset = (height(a, p1) * b.cross(c) + height(b, p2) * c.cross(a) + height(c, p3) * a.cross(b))
            / (2.0 * a.dot(b.cross(c)));
        let center = p0.at + offset;
        let radius2 = (offset.length_squared() - p0.weight + all.heaviest) * (1.0 + 1e-6);
        if !radius2.is_finite() {
            return false;
        }
        // How far the center is outside the box of all points, along each axis.
        let out = (all.low - center).max(center - all.high).max(Point3::ZERO);
        let out2 = out * out;
        (0..3).all(|i| {
            let half2 = radius2 - (out2.x + out2.y + out2.z - out2[i]);
            half2 <= 0.0 || {
                let half = half2.sqrt();
                center[i] - half > low[i] && center[i] + half < high[i]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Draw, family};
    use super::*;
    use crate::arith::FastKernel;

    /// Threads do the work for uniform points, weighted or not, and leave it to one where all points are on the hull.
    #[test]
    fn threads_share_the_work() {
        let mut draw = Draw(11);
        let points: Vec<WeightedPoint> = family(0, 22_000, &mut draw)
            .into_iter()
            .map(|at| WeightedPoint { at, weight: 1e-4 * draw.unit() })
            .collect();
        let together = Regular3::<FastKernel>::build_together(&points, 2).expect("uniform points are shared");
        assert!(together.validate().is_ok());
        let on_a_sphere: Vec<WeightedPoint> =
            points.iter().map(|p| WeightedPoint::unweighted((p.at - Point3::splat(0.5)).normalize())).collect();
        assert!(Regular3::<FastKernel>::build_together(&on_a_sphere, 2).is_none());
    }
}
