//! proptest strategies over the families. A case shrinks by its size, then by its seed; point sets also by leaving out points.

use super::{BrokenCase, Defect, PointCase, PointFamily, PslgCase, PslgFamily, SplitMix64, broken, points, pslg};
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

#[cfg(test)]
mod tests {
    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn sizes_are_kept(case in point_cases(4..=40), graph in pslg_cases(4..=40)) {
            prop_assert!((3..=43).contains(&case.points.len()));
            prop_assert!(graph.pslg.points.len() <= 48, "{:?} has {}", graph.family, graph.pslg.points.len());
        }
    }
}
