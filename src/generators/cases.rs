//! Cases that a fuzzer decodes from bytes.

use super::{Bytes, Defect, PointFamily, PslgFamily, broken, points, pslg};
use crate::model::{Point2, Pslg};
use arbitrary::{Arbitrary, Result, Unstructured};

/// How many points a decoded case has at most: as many as its bytes can tell apart, and no more than this.
const LARGEST: usize = 96;

/// A point set and the family it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct PointCase {
    /// Where the points came from.
    pub family: PointFamily,
    /// Distinct points, not all on one line.
    pub points: Vec<Point2>,
}

/// A graph that can be meshed and the family it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct PslgCase {
    /// Where the graph came from.
    pub family: PslgFamily,
    /// The graph.
    pub pslg: Pslg,
}

/// A graph with a defect.
#[derive(Clone, Debug, PartialEq)]
pub struct BrokenCase {
    /// What is wrong with it.
    pub defect: Defect,
    /// The graph.
    pub pslg: Pslg,
}

/// Size and draws from what is left of the input.
fn rest<'a>(u: &mut Unstructured<'a>) -> Result<(usize, Bytes<'a>)> {
    let n = u.int_in_range(3..=LARGEST)?;
    let bytes = u.bytes(u.len())?;
    Ok((n.min(3 + bytes.len() / 2), Bytes(bytes)))
}

impl<'a> Arbitrary<'a> for PointCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let family = u.arbitrary()?;
        let (n, mut draw) = rest(u)?;
        Ok(PointCase { family, points: points(family, n, &mut draw) })
    }
}

impl<'a> Arbitrary<'a> for PslgCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let family = u.arbitrary()?;
        let (n, mut draw) = rest(u)?;
        Ok(PslgCase { family, pslg: pslg(family, n, &mut draw) })
    }
}

impl<'a> Arbitrary<'a> for BrokenCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let defect = u.arbitrary()?;
        let (n, mut draw) = rest(u)?;
        Ok(BrokenCase { defect, pslg: broken(defect, n, &mut draw) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::SplitMix64;
    use super::*;
    use std::collections::BTreeSet;

    /// Any bytes decode, and 4,000 random strings reach every family.
    #[test]
    fn bytes_reach_every_family() {
        let mut draw = SplitMix64(7);
        let (mut sets, mut graphs, mut defects) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        for length in 0..4000 {
            let bytes: Vec<u8> = (0..4 + length % 100).map(|_| draw.word() as u8).collect();
            sets.insert(PointCase::arbitrary(&mut Unstructured::new(&bytes)).expect("bytes decode").family);
            graphs.insert(PslgCase::arbitrary(&mut Unstructured::new(&bytes)).expect("bytes decode").family);
            defects.insert(BrokenCase::arbitrary(&mut Unstructured::new(&bytes)).expect("bytes decode").defect);
        }
        assert_eq!(sets.len(), PointFamily::ALL.len());
        assert_eq!(graphs.len(), PslgFamily::all().len());
        assert_eq!(defects.len(), Defect::ALL.len());
    }
}
