//! The bulk build on several threads. The triangulation is unique, so that any number of them gives the same one.
//!
//! Idea: space is cut into boxes, one for each thread (`cut`). A thread triangulates the points of its box and those of a *halo* around it
//! (`piece`). A cell whose orthoball, within the bounding box of all points, keeps inside box and halo is in conflict with no other point: it is a
//! cell of the whole. Where that is not sure, the points around are called *torn*. The sure cells are put together, and what they leave open is
//! filled from the triangulation of the torn points (`assemble`), which has every cell that is missing: a missing cell is sure to none of the
//! threads in whose boxes its corners lie, so each of them either has the cell and is not sure of it, or has something else there, which is no
//! cell of the whole and of which it cannot be sure.
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
//! Whether an orthoball keeps inside is estimated in plain floating point; a misjudgement cannot pass. Where cells of different origin meet, the
//! threads must agree on it, facets that none of them knows are tested, and the hidden points: a closed complex that covers space once and is regular
//! across every facet, with no hidden point in conflict, is the triangulation. Should a test fail, one thread does it all. So it does where most points would
//! be torn (all of them are on the hull, say), which is tried on a sample first.

mod assemble;
mod cut;
mod piece;

use super::store::Regular3;
use crate::arith::space::Kernel3;
use crate::model::{Point3, WeightedPoint};
use piece::Piece;
use rayon::prelude::*;

/// Fewer points than this a thread are not worth its start.
const POINTS_PER_THREAD: usize = 10_000;
/// How many points tell whether most would be torn. Of so many uniform ones some 10% are on the hull.
const REHEARSAL: usize = 1 << 11;

/// What a thread knows of all points.
#[derive(Clone, Copy, Debug)]
struct Surroundings {
    /// The box of all points.
    low: Point3,
    high: Point3,
    /// The largest weight.
    heaviest: f64,
}

impl Surroundings {
    fn of(points: &[WeightedPoint]) -> Self {
        let none = Surroundings {
            low: Point3::splat(f64::INFINITY),
            high: Point3::splat(f64::NEG_INFINITY),
            heaviest: f64::NEG_INFINITY,
        };
        let one = |p: &WeightedPoint| Surroundings { low: p.at, high: p.at, heaviest: p.weight };
        let both = |a: Self, b: Self| Surroundings {
            low: a.low.min(b.low),
            high: a.high.max(b.high),
            heaviest: a.heaviest.max(b.heaviest),
        };
        points.par_iter().map(one).reduce(|| none, both)
    }
}

impl<K: Kernel3> Regular3<K> {
    /// The triangulation by several threads; `None` where one of them does better.
    pub(super) fn build_together(points: &[WeightedPoint], threads: usize) -> Option<Self> {
        let parts = threads.min(points.len() / POINTS_PER_THREAD);
        if parts < 2 {
            return None;
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()?;
        pool.install(|| {
            let few: Vec<WeightedPoint> = cut::sample(points, REHEARSAL).collect();
            let torn: usize = pieces::<K>(&few, parts).iter().map(|p| p.torn.len()).sum();
            if torn > few.len() / 2 { None } else { Self::assemble(points, pieces::<K>(points, parts)) }
        })
    }
}

/// What the threads find, each in its part.
fn pieces<K: Kernel3>(points: &[WeightedPoint], parts: usize) -> Vec<Piece> {
    let all = Surroundings::of(points);
    // The first piece takes the others up, with the slots of their halos.
    let room = |k: usize| if k == 0 { points.len() / 4 * 5 } else { 0 };
    let piece = |(k, part)| piece::piece::<K>(points, part, &all, room(k));
    cut::parts(points, parts).par_iter().enumerate().map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::super::store::Cell;
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
        let mut together = Regular3::<FastKernel>::build_together(&points, 2).expect("uniform points are shared");
        assert!(together.validate().is_ok());
        assert_eq!(together.simplices(), Regular3::<FastKernel>::build_alone(&points).simplices());
        // A second sheet is closed and regular, too.
        let sheet = 4 * together.cells.len() as u32;
        let second: Vec<Cell> =
            together.cells.iter().map(|c| Cell { v: c.v, n: c.n.map(|link| link.wrapping_add(sheet)) }).collect();
        let inner = together.cells.iter().position(|c| !c.is_free()).map_or(0, |first| first + 1);
        assert!(together.covers_once(inner));
        together.cells.extend(second);
        assert!(!together.covers_once(inner));
        let on_a_sphere: Vec<WeightedPoint> =
            points.iter().map(|p| WeightedPoint::unweighted((p.at - Point3::splat(0.5)).normalize())).collect();
        assert!(Regular3::<FastKernel>::build_together(&on_a_sphere, 2).is_none());
    }
}
