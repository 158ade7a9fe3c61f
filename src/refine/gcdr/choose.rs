//! Choices of Steiner points in selection disks and intervals. Source: \[GCDR\] Definitions 3.1-3.3, section 7.

use super::queue::shortest_edge;
use crate::arith::philox::philox4x32;
use crate::arith::{Kernel, OutOfRange};
use crate::model::{Choice, DiskChoice, GcdrParameters, Point2, Triangle, VertexId, VertexOfTriangle};

/// Numbers drawn for one step; `docs/trace-format.md`, Draws.
#[derive(Clone, Copy, Debug)]
pub(super) struct Draws {
    pub seed: u64,
    pub step: u32,
}

/// Streams of draws.
const DISK: u32 = 0;
const INTERVAL: u32 = 1;

impl Draws {
    fn words(self, n: u32, stream: u32) -> [u32; 4] {
        philox4x32([self.seed as u32, (self.seed >> 32) as u32], [self.step, n, stream, 0])
    }

    /// A dyadic number of [-1, 1] from two words: m / 2^52 - 1 with m of 53 bits, as the exact integer m - 2^52.
    fn dyadic([high, low]: [u32; 2]) -> i64 {
        (((u64::from(high) << 32) | u64::from(low)) >> 11) as i64 - (1 << 52)
    }

    /// The first draw inside the unit disk.
    fn in_unit_disk(self) -> [f64; 2] {
        for n in 0.. {
            let [a, b, c, d] = self.words(n, DISK);
            let [x, y] = [Self::dyadic([a, b]), Self::dyadic([c, d])];
            let square = |v: i64| i128::from(v) * i128::from(v);
            if square(x) + square(y) <= 1 << 104 {
                return [Self::unit(x), Self::unit(y)];
            }
        }
        [0.0, 0.0]
    }

    /// m / 2^52; exact, since |m| <= 2^52.
    fn unit(m: i64) -> f64 {
        m as f64 / (1u64 << 52) as f64
    }
}

/// The Type-A point of t (canonical); a user's choice is made by the caller.
pub(super) fn type_a<K: Kernel>(
    params: &GcdrParameters,
    ids: Triangle,
    corners: [Point2; 3],
    draws: Draws,
) -> Result<Point2, OutOfRange> {
    let from = |k: usize| [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
    let kappa = params.kappa.unwrap_or(0.0);
    match params.choice_a {
        DiskChoice::Center | DiskChoice::User => K::circumcenter(corners),
        DiskChoice::Extreme => {
            let k = match params.extreme.unwrap_or(VertexOfTriangle::First) {
                VertexOfTriangle::First => 0,
                VertexOfTriangle::Newest => {
                    if ids[1] > ids[2] {
                        1
                    } else {
                        2
                    }
                }
                VertexOfTriangle::Seeded => (draws.words(0, DISK)[0] % 3) as usize,
            };
            K::in_disk(from(k), params.d2, 1.0, 0.0)
        }
        DiskChoice::Random => {
            let [x, y] = draws.in_unit_disk();
            K::in_disk(corners, params.d2, x, y)
        }
        DiskChoice::Offcenter => K::offcenter(from(shortest_edge::<K>(ids, corners)[0]), kappa),
        DiskChoice::ClampedOffcenter => {
            K::clamped_offcenter(from(shortest_edge::<K>(ids, corners)[0]), kappa, params.d2)
        }
    }
}

/// The Type-B (delta = d1) or Type-C (delta = mu) point of the subsegment uv, u the smaller id.
pub(super) fn on_segment<K: Kernel>(
    params: &GcdrParameters,
    choice: Choice,
    delta: f64,
    [u, v]: [Point2; 2],
    draws: Draws,
) -> Point2 {
    match choice {
        Choice::Center | Choice::User => K::midpoint(u, v),
        Choice::Extreme => {
            let from_u = match params.extreme.unwrap_or(VertexOfTriangle::First) {
                VertexOfTriangle::First => true,
                VertexOfTriangle::Newest => false,
                VertexOfTriangle::Seeded => draws.words(0, INTERVAL)[0].is_multiple_of(2),
            };
            let [w, other] = if from_u { [u, v] } else { [v, u] };
            K::in_interval(w, other, delta, -1.0)
        }
        Choice::Random => {
            let [a, b, ..] = draws.words(0, INTERVAL);
            K::in_interval(u, v, delta, Draws::unit(Draws::dyadic([a, b])))
        }
    }
}

/// Subsegment ends, the smaller id first.
pub(super) fn ordered(a: VertexId, b: VertexId) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}
