//! Any number of threads builds the same triangulation.

use orthoball::arith::FastKernel;
use orthoball::arith::scale::{by_power_of_two, exponent_of};
use orthoball::generators::{SpaceFamily, SplitMix64, WeightFamily, weighted_points};
use orthoball::model::WeightedPoint;
use orthoball::triangulation::regular3::Regular3;

/// Points scaled by a power of two into the range of the kernels.
fn normalised(points: Vec<WeightedPoint>) -> Vec<WeightedPoint> {
    let largest = points.iter().map(|p| p.at.abs().max_element()).fold(0.0, f64::max);
    let e = if largest > 0.0 { exponent_of(largest) } else { 0 };
    let scaled = |p: WeightedPoint| WeightedPoint {
        at: p.at.to_array().map(|x| by_power_of_two(x, -e) + 0.0).into(),
        weight: by_power_of_two(p.weight, -2 * e) + 0.0,
    };
    points.into_iter().map(scaled).collect()
}

/// Also where the threads' parts do not fit together, as on a sphere, or have equal coordinates, as on grids.
#[test]
fn threads_build_the_same() {
    let cases = [
        (SpaceFamily::Random, WeightFamily::Zero),
        (SpaceFamily::Random, WeightFamily::Hidden),
        (SpaceFamily::Random, WeightFamily::SamePlaces),
        (SpaceFamily::Clusters, WeightFamily::Radii),
        (SpaceFamily::Grid, WeightFamily::Integers),
        (SpaceFamily::RoundedSphere, WeightFamily::Zero),
        (SpaceFamily::Coplanar, WeightFamily::Zero),
        (SpaceFamily::WildScales, WeightFamily::Zero),
    ];
    for (family, weights) in cases {
        let points = normalised(weighted_points(family, weights, 41_000, &mut SplitMix64(5)));
        let one = Regular3::<FastKernel>::build(&points, 1);
        for threads in [2, 3, 4] {
            let several = Regular3::<FastKernel>::build(&points, threads);
            several.validate().unwrap_or_else(|e| panic!("{family:?} {weights:?}, {threads} threads: {e}"));
            assert!(several.to_triangulation() == one.to_triangulation(), "{family:?} {weights:?}, {threads} threads");
        }
    }
}
