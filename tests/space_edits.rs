//! Sequences of insertions, removals and changes of weight against fresh builds of what is left.

use orthoball::arith::FastKernel as K;
use orthoball::arith::scale::{by_power_of_two, exponent_of};
use orthoball::generators::{Draw, Edit, SpaceFamily, SplitMix64, WeightFamily, edits, weighted_points};
use orthoball::model::{PointState, VertexId, WeightedPoint};
use orthoball::triangulation::regular3::{Change, Regular3};

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

/// States and simplices of the points that stand, by a fresh build.
fn fresh(t: &Regular3<K>) -> (Vec<PointState>, Vec<VertexId>) {
    let all = (0..t.point_count() as u32).map(VertexId);
    let standing: Vec<VertexId> = all.clone().filter(|&v| t.state(v) != PointState::Removed).collect();
    let points: Vec<_> = standing.iter().map(|&v| t.point(v)).collect();
    let built = Regular3::<K>::build(&points, 1);
    let id = |v: VertexId| standing[v.index()];
    let mut states = vec![PointState::Removed; t.point_count()];
    for (i, &v) in standing.iter().enumerate() {
        states[v.index()] = match built.state(VertexId(i as u32)) {
            PointState::Duplicate { of } => PointState::Duplicate { of: id(of) },
            state => state,
        };
    }
    // Ids keep their order, so that canonical tuples stay canonical.
    (states, built.simplices().into_iter().map(id).collect())
}

fn states(t: &Regular3<K>) -> Vec<PointState> {
    (0..t.point_count() as u32).map(|v| t.state(VertexId(v))).collect()
}

/// Applies an edit; says what `change` must be consistent with.
fn apply(t: &mut Regular3<K>, edit: Edit, change: &mut Change) {
    let before = states(t);
    match edit {
        Edit::Insert(p) => {
            t.insert(p, change);
        }
        Edit::Remove(v) => t.remove(VertexId(v), change),
        Edit::SetWeight(v, w) => t.set_weight(VertexId(v), w, change),
    }
    let after = states(t);
    let turned = |from: fn(PointState) -> bool, to: PointState| -> Vec<VertexId> {
        let all = 0..before.len() as u32;
        all.filter(|&v| from(before[v as usize]) && after[v as usize] == to).map(VertexId).collect()
    };
    let newly_vertices = turned(|s| s != PointState::Vertex, PointState::Vertex);
    if !matches!(edit, Edit::Insert(_)) {
        assert_eq!(change.revived, newly_vertices, "revived by {edit:?}");
        assert_eq!(change.hidden, turned(|s| s == PointState::Vertex, PointState::Hidden), "hidden by {edit:?}");
    }
}

fn attempt(family: SpaceFamily, weights: WeightFamily, seed: u64) {
    let mut draw = SplitMix64(seed);
    let n = 1 + draw.below(40) as usize;
    let points = normalised(weighted_points(family, weights, n, &mut draw));
    let mut t = Regular3::<K>::new();
    let mut change = Change::default();
    for (i, edit) in edits(&points, 30, draw.coin(), &mut draw).into_iter().enumerate() {
        apply(&mut t, edit, &mut change);
        if let Err(e) = t.validate() {
            panic!("{family:?} {weights:?} seed {seed}, edit {i} {edit:?}: {e}");
        }
        let (states_of_fresh, simplices) = fresh(&t);
        assert_eq!(states(&t), states_of_fresh, "{family:?} {weights:?} seed {seed}, edit {i} {edit:?}");
        assert_eq!(t.simplices(), simplices, "{family:?} {weights:?} seed {seed}, edit {i} {edit:?}");
    }
}

#[test]
fn edits_end_where_fresh_builds_do() {
    let seeds = std::env::var("ORTHOBALL_CASES").ok().and_then(|s| s.parse().ok()).unwrap_or(3);
    for family in SpaceFamily::ALL {
        for weights in WeightFamily::ALL {
            (0..seeds).for_each(|seed| attempt(family, weights, seed));
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
        let mut draw = SplitMix64(seed);
        let mut points = normalised(weighted_points(family, WeightFamily::Zero, 300, &mut draw));
        let center = points.iter().map(|p| p.at).sum::<orthoball::model::Point3>() / 300.0;
        for offset in [0.0, 0.25] {
            // Beside or above everything, with an orthoball that reaches all.
            let at = center + offset * orthoball::model::Point3::new(0.125, 0.25, 1.0);
            points.push(WeightedPoint { at, weight: if family == SpaceFamily::Random { 0.5 } else { 0.0 } });
            let mut t = Regular3::<K>::build(&points, 1);
            let mut change = Change::default();
            t.remove(VertexId(points.len() as u32 - 1), &mut change);
            t.validate().unwrap_or_else(|e| panic!("{family:?}: {e}"));
            assert_eq!((states(&t), t.simplices()), fresh(&t), "{family:?}");
        }
    }
}
