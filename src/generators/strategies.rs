//! proptest strategies over the families. A case shrinks by its size, then by its seed; point sets also by leaving out points.

use super::{BrokenCase, Defect, PointCase, PointFamily, PslgCase, PslgFamily, SplitMix64, broken, points, pslg};
use super::{EditCase, SpaceCase, SpaceFamily, WeightFamily, edits, weighted_points};
use proptest::prelude::*;
use proptest::sample::{select, subsequence};
use std::ops::RangeInclusive;

/// Point sets of all families, about `sizes` points each (at least 3 are asked for).
pub fn point_cases(sizes: RangeInclusive<usize>) -> impl Strategy<Value = PointCase> {
    (select(&PointFamily::ALL[..]), sizes, any::<u64>())
        .prop_map(|(family, n, seed)| PointCase { family, points: points(family, n, &mut SplitMix64(seed)) })
}

/// Point sets like those of `point_cases`, some points left out: may be on one line. Shrinks to few points.
pub fn point_subsets(sizes: RangeInclusive<usize>) -> impl Strategy<Value = PointCase> {
    point_cases(sizes).prop_flat_map(|case| {
        let (family, n) = (case.family, case.points.len());
        subsequence(case.points, 3.min(n)..=n).prop_map(move |points| PointCase { family, points })
    })
}

/// Graphs of all families, about `sizes` vertices each.
pub fn pslg_cases(sizes: RangeInclusive<usize>) -> impl Strategy<Value = PslgCase> {
    (select(PslgFamily::all()), sizes, any::<u64>())
        .prop_map(|(family, n, seed)| PslgCase { family, pslg: pslg(family, n, &mut SplitMix64(seed)) })
}

/// Graphs of one family.
pub fn pslgs_of(family: PslgFamily, sizes: RangeInclusive<usize>) -> impl Strategy<Value = PslgCase> {
    (sizes, any::<u64>()).prop_map(move |(n, seed)| PslgCase { family, pslg: pslg(family, n, &mut SplitMix64(seed)) })
}

/// Graphs with one defect.
pub fn broken_cases(sizes: RangeInclusive<usize>) -> impl Strategy<Value = BrokenCase> {
    (select(&Defect::ALL[..]), sizes, any::<u64>())
        .prop_map(|(defect, n, seed)| BrokenCase { defect, pslg: broken(defect, n, &mut SplitMix64(seed)) })
}

/// Points of space of all families of places and weights, at most `sizes` points each; some of their points left out. Shrinks to few points.
pub fn space_cases(sizes: RangeInclusive<usize>) -> impl Strategy<Value = SpaceCase> {
    space_cases_with(&WeightFamily::ALL, sizes)
}

/// As `space_cases`, all weights zero.
pub fn unweighted_space_cases(sizes: RangeInclusive<usize>) -> impl Strategy<Value = SpaceCase> {
    space_cases_with(&[WeightFamily::Zero], sizes)
}

fn space_cases_with(
    weights: &'static [WeightFamily],
    sizes: RangeInclusive<usize>,
) -> impl Strategy<Value = SpaceCase> {
    let whole = (select(&SpaceFamily::ALL[..]), select(weights), sizes, any::<u64>());
    whole.prop_flat_map(|(family, weights, n, seed)| {
        let points = weighted_points(family, weights, n, &mut SplitMix64(seed));
        let n = points.len();
        subsequence(points, n / 2..=n).prop_map(move |points| SpaceCase { family, weights, points })
    })
}

/// Sequences of edits of points of space of all families: at most `sizes` points, up to 40 removals and changes of weight beside those that
/// (in half of the cases) empty the set again. Shrinks to few edits of few points.
pub fn edit_cases(sizes: RangeInclusive<usize>) -> impl Strategy<Value = EditCase> {
    (space_cases(sizes), 0..=40_usize, any::<bool>(), any::<u64>()).prop_map(|(case, extra, drain, seed)| EditCase {
        family: case.family,
        weights: case.weights,
        edits: edits(&case.points, extra, drain, &mut SplitMix64(seed)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn sizes_are_kept(case in point_cases(4..=40), graph in pslg_cases(4..=40), space in space_cases(0..=40)) {
            prop_assert!(space.points.len() <= 40);
            prop_assert!((3..=43).contains(&case.points.len()));
            prop_assert!(graph.pslg.points.len() <= 48, "{:?} has {}", graph.family, graph.pslg.points.len());
        }
    }
}
