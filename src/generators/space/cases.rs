//! Cases of space that a fuzzer decodes from bytes.

use super::{Edit, SpaceFamily, WeightFamily, edits, weighted_points};
use crate::generators::Bytes;
use crate::model::WeightedPoint;
use arbitrary::{Arbitrary, Result, Unstructured};

/// How many points a decoded case has at most: as many as its bytes can tell apart, and no more than this.
const LARGEST: usize = 64;

/// Points of space with weights, and the families they came from.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceCase {
    /// Where the places came from.
    pub family: SpaceFamily,
    /// Where the weights came from.
    pub weights: WeightFamily,
    /// The points, perhaps none; places may repeat.
    pub points: Vec<WeightedPoint>,
}

/// Edits of a set of points of space that starts empty.
#[derive(Clone, Debug, PartialEq)]
pub struct EditCase {
    /// Where the places came from.
    pub family: SpaceFamily,
    /// Where the first weights came from.
    pub weights: WeightFamily,
    /// The edits.
    pub edits: Vec<Edit>,
}

/// Size and draws from what is left of the input; four bytes a point and more.
fn rest<'a>(u: &mut Unstructured<'a>) -> Result<(usize, Bytes<'a>)> {
    let n = u.int_in_range(0..=LARGEST)?;
    let bytes = u.bytes(u.len())?;
    Ok((n.min(4 + bytes.len() / 3), Bytes(bytes)))
}

impl<'a> Arbitrary<'a> for SpaceCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let (family, weights) = (u.arbitrary()?, u.arbitrary()?);
        let (n, mut draw) = rest(u)?;
        Ok(SpaceCase { family, weights, points: weighted_points(family, weights, n, &mut draw) })
    }
}

impl<'a> Arbitrary<'a> for EditCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let (family, weights) = (u.arbitrary()?, u.arbitrary()?);
        let (extra, drain) = (u.int_in_range(0..=40)?, u.arbitrary()?);
        let (n, mut draw) = rest(u)?;
        let points = weighted_points(family, weights, n, &mut draw);
        Ok(EditCase { family, weights, edits: edits(&points, extra, drain, &mut draw) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generators::SplitMix64;
    use std::collections::BTreeSet;

    #[test]
    fn bytes_reach_every_family() {
        let mut draw = SplitMix64(7);
        let (mut families, mut pairs) = (BTreeSet::new(), BTreeSet::new());
        for length in 0..4000 {
            let bytes: Vec<u8> = (0..length % 200).map(|_| draw.word() as u8).collect();
            let case = SpaceCase::arbitrary(&mut Unstructured::new(&bytes)).expect("bytes decode");
            families.insert((case.family, case.weights));
            let case = EditCase::arbitrary(&mut Unstructured::new(&bytes)).expect("bytes decode");
            pairs.insert((case.family, case.weights));
        }
        assert_eq!(families.len(), SpaceFamily::ALL.len() * WeightFamily::ALL.len());
        assert_eq!(pairs.len(), families.len());
    }
}
