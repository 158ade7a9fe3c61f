//! Sequences of insertions, removals and changes of weight against fresh builds of what is left, and against the definition.
#![cfg(all(feature = "exact", feature = "generators"))]

use orthoball::arith::FastKernel as K;
use orthoball::attack::{EditCase3, Image3, regular_by_definition};
use orthoball::generators::{Draw, Edit, SpaceFamily, SplitMix64, WeightFamily};
use orthoball::model::{Point3, PointState, VertexId, WeightedPoint};
use orthoball::triangulation::regular3::{Change, Regular3};

/// The points that a case inserts.
fn points(case: &EditCase3) -> Vec<WeightedPoint> {
    let inserted = |e: &Edit| match e {
        Edit::Insert(p) => Some(*p),
        _ => None,
    };
    case.0.iter().filter_map(inserted).collect()
}

#[test]
fn edits_end_where_fresh_builds_do() {
    let seeds = std::env::var("ORTHOBALL_CASES").ok().and_then(|s| s.parse().ok()).unwrap_or(2);
    for family in SpaceFamily::ALL {
        for weights in WeightFamily::ALL {
            for seed in 0..seeds {
                let mut draw = SplitMix64(seed);
                // Every other case is so small that the definition is asked all the way.
                let n = 1 + draw.below(if seed % 2 == 0 { 40 } else { 9 }) as usize;
                println!("{family:?} {weights:?} seed {seed}");
                EditCase3::of(family, weights, n, 20, &mut draw).run();
            }
        }
    }
}

/// Bulk builds are what the definition says, in any dimension.
#[test]
fn builds_are_what_the_definition_says() {
    for family in SpaceFamily::ALL {
        for weights in WeightFamily::ALL {
            for seed in 0..4 {
                let mut draw = SplitMix64(1000 + seed);
                let points = points(&EditCase3::of(family, weights, 11, 0, &mut draw));
                let built = Image3::of(&Regular3::<K>::build(&points, 1));
                assert_eq!(built, regular_by_definition(&points), "{family:?} {weights:?} seed {seed}");
            }
        }
    }
}

/// The corners of a cube are cospherical: a weight far below the last bit of their squared distances decides all. Numbers so coarse that
/// determinants of them are exact may not be taken for that after a finer weight has come.
#[test]
fn weights_finer_than_the_grid_are_seen() {
    let corner = |i: u32| Point3::new(f64::from(i >> 2), f64::from(i >> 1 & 1), f64::from(i & 1));
    let insertions = (0..8).map(|i| Edit::Insert(WeightedPoint::unweighted(corner(i))));
    for v in 0..8 {
        for w in [1.0, -1.0] {
            let tiny = w / 2f64.powi(90);
            let edits: Vec<Edit> =
                insertions.clone().chain([Edit::SetWeight(v, tiny), Edit::SetWeight(v, 0.0)]).collect();
            EditCase3::from(edits).run();
        }
    }
}

/// Many vertices around the one removed: the hole is filled from the triangulation of a subset.
#[test]
fn large_stars_are_filled() {
    for (family, seed) in [
        (SpaceFamily::RoundedSphere, 1),
        (SpaceFamily::Cospherical, 2),
        (SpaceFamily::Coplanar, 3),
        (SpaceFamily::Random, 4),
    ] {
        let mut points = points(&EditCase3::of(family, WeightFamily::Zero, 300, 0, &mut SplitMix64(seed)));
        let center = points.iter().map(|p| p.at).sum::<Point3>() / points.len() as f64;
        for offset in [0.0, 0.25] {
            // Beside or above everything, with an orthoball that reaches all.
            let at = center + offset * Point3::new(0.125, 0.25, 1.0);
            let rest = Image3::of(&Regular3::<K>::build(&points, 1));
            points.push(WeightedPoint { at, weight: if family == SpaceFamily::Random { 0.5 } else { 0.0 } });
            let mut t = Regular3::<K>::build(&points, 1);
            t.remove(VertexId(points.len() as u32 - 1), &mut Change::default());
            t.validate().unwrap_or_else(|e| panic!("{family:?}: {e}"));
            let mut left = Image3::of(&t);
            assert_eq!(left.states.pop(), Some(PointState::Removed));
            assert_eq!(left, rest, "{family:?}");
        }
    }
}
