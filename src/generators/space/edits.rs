//! Sequences of edits of a set of weighted points.

use super::weights::{Scale, WeightFamily, weight};
use crate::generators::draw::Draw;
use crate::model::WeightedPoint;

/// A change of a set of weighted points. Ids count insertions from 0, in their order; the ids that stand were not removed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edit {
    /// The next point.
    Insert(WeightedPoint),
    /// Removal of the point of this id, vertex or not. It stands.
    Remove(u32),
    /// A new weight for the point of this id. It stands.
    SetWeight(u32, f64),
}

/// Edits of a set that starts empty: every point given is inserted in order; between insertions, and after the last, points that stand are
/// removed or given another weight. About `extra` edits beyond the insertions; with `drain` all points are removed in the end, in random order.
pub fn edits(points: &[WeightedPoint], extra: usize, drain: bool, draw: &mut impl Draw) -> Vec<Edit> {
    let scale = Scale::of(points.iter().map(|p| p.at));
    let mut standing: Vec<u32> = Vec::new();
    let mut all = Vec::new();
    let (mut next, mut left) = (0, extra);
    while next < points.len() || left > 0 {
        let insert = next < points.len() && (left == 0 || standing.is_empty() || draw.below(4) != 0);
        if insert {
            standing.push(next as u32);
            all.push(Edit::Insert(points[next]));
            next += 1;
            continue;
        }
        left -= 1;
        if standing.is_empty() {
            break;
        }
        let place = draw.below(standing.len() as u32) as usize;
        if draw.coin() {
            all.push(Edit::Remove(standing.swap_remove(place)));
        } else {
            let family = WeightFamily::ALL[draw.below(WeightFamily::ALL.len() as u32) as usize];
            let weight = weight(family, scale, draw);
            all.push(Edit::SetWeight(standing[place], if weight == 0.0 { 0.0 } else { weight }));
        }
    }
    while drain && !standing.is_empty() {
        let place = draw.below(standing.len() as u32) as usize;
        all.push(Edit::Remove(standing.swap_remove(place)));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generators::{SpaceFamily, SplitMix64, weighted_points};

    /// Ids named by edits stand; all points are inserted, and none is left after draining.
    #[test]
    fn edits_speak_of_points_that_stand() {
        for seed in 0..50 {
            let mut draw = SplitMix64(seed);
            let points = weighted_points(SpaceFamily::Random, WeightFamily::Hidden, seed as usize, &mut draw);
            let (mut standing, mut inserted) = (std::collections::BTreeSet::new(), 0);
            for edit in edits(&points, 30, seed % 2 == 0, &mut draw) {
                match edit {
                    Edit::Insert(p) => {
                        assert_eq!(p, points[inserted]);
                        standing.insert(inserted as u32);
                        inserted += 1;
                    }
                    Edit::Remove(id) => assert!(standing.remove(&id)),
                    Edit::SetWeight(id, w) => assert!(standing.contains(&id) && w.is_finite()),
                }
            }
            assert_eq!(inserted, points.len());
            assert!(seed % 2 == 1 || standing.is_empty());
        }
    }
}
