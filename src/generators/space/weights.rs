//! Families of weights for points of space.

use super::families::{SpaceFamily, root, space_points};
use crate::generators::draw::{Draw, two_to};
use crate::model::{Point3, WeightedPoint};

/// A way of being nasty for weights. h, a power of two, is about the spacing of the points (1 for small sets of small integers).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, arbitrary::Arbitrary)]
pub enum WeightFamily {
    /// All zero: the Delaunay triangulation.
    Zero,
    /// Squares of radii below h / 2, radii of at most 26 bits.
    Radii,
    /// Uniform in [0, 1.13 s^2), s the size of the box over the cube root of n: of uniform points 10% are hidden.
    Hidden,
    /// Integers of -2..=2, times h^2: exact ties of power on grids.
    Integers,
    /// Uniform in (-4 h^2, 0], some exactly 0.
    Negative,
    /// |p|^2, rounded: all lifted points are (nearly) in one hyperplane, exactly so for integer places. The perturbation decides all.
    Lifted,
    /// Weights of +-U 4^e size^2, e in -20..=0: some points hide nearly all others.
    Wild,
    /// Every third point or so takes the place of an earlier one, with an integer weight: equal places, weights equal or not.
    SamePlaces,
}

impl WeightFamily {
    /// All families.
    pub const ALL: [WeightFamily; 8] = [
        WeightFamily::Zero,
        WeightFamily::Radii,
        WeightFamily::Hidden,
        WeightFamily::Integers,
        WeightFamily::Negative,
        WeightFamily::Lifted,
        WeightFamily::Wild,
        WeightFamily::SamePlaces,
    ];
}

/// At most `n` points of a family of places with weights of another; `SamePlaces` repeats places.
pub fn weighted_points(
    family: SpaceFamily,
    weights: WeightFamily,
    n: usize,
    draw: &mut impl Draw,
) -> Vec<WeightedPoint> {
    let mut places = space_points(family, n, draw);
    if weights == WeightFamily::SamePlaces {
        for i in 1..places.len() {
            if draw.below(3) == 0 {
                places[i] = places[draw.below(i as u32) as usize];
            }
        }
    }
    let scale = Scale::of(places.iter().copied());
    places
        .into_iter()
        .map(|at| {
            let weight = match weights {
                WeightFamily::Lifted => at.length_squared(),
                _ => weight(weights, scale, draw),
            };
            WeightedPoint { at, weight: if weight == 0.0 { 0.0 } else { weight } }
        })
        .collect()
}

/// One weight of a family but `Lifted` (there it is 0), for points of a given scale.
pub(super) fn weight(family: WeightFamily, scale: Scale, draw: &mut impl Draw) -> f64 {
    let Scale { size, h, s } = scale;
    match family {
        WeightFamily::Zero | WeightFamily::Lifted => 0.0,
        WeightFamily::Radii => {
            let radius = h * f64::from(draw.below(1 << 25)) * two_to(-26);
            radius * radius
        }
        WeightFamily::Hidden => 1.13 * s * s * draw.unit(),
        WeightFamily::Integers | WeightFamily::SamePlaces => h * h * f64::from(draw.integer(-2, 2)),
        WeightFamily::Negative if draw.below(4) == 0 => 0.0,
        WeightFamily::Negative => -4.0 * h * h * draw.unit(),
        WeightFamily::Wild => size * size * draw.signed_unit() * two_to(2 * draw.integer(-20, 0)),
    }
}

/// How large a set is and how far apart its points are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// The least power of two above every coordinate; 1 where all are 0.
    size: f64,
    /// The spacing as a power of two: the size over about the cube root of the number of points.
    h: f64,
    /// The spacing: the size over the least integer that is no less than that root.
    s: f64,
}

impl Scale {
    pub(super) fn of(places: impl ExactSizeIterator<Item = Point3>) -> Self {
        let n = places.len().max(1);
        let largest = places.fold(0.0, |m: f64, p| m.max(p.abs().max_element()));
        let size = if largest == 0.0 { 1.0 } else { two_to((largest.to_bits() >> 52 & 0x7ff) as i32 - 1022) };
        Scale { size, h: size * two_to(-((n.ilog2() as i32 + 1) / 3)), s: size / f64::from(root(n, 3)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generators::SplitMix64;

    #[test]
    fn weights_are_finite_and_of_their_family() {
        for family in SpaceFamily::ALL {
            for weights in WeightFamily::ALL {
                let set = weighted_points(family, weights, 50, &mut SplitMix64(3));
                assert!(set.iter().all(|p| p.weight.is_finite() && !(p.weight == 0.0 && p.weight.is_sign_negative())));
                let negative = set.iter().any(|p| p.weight < 0.0);
                assert!(negative || weights != WeightFamily::Negative || set.len() < 4, "{family:?}");
                assert!(weights != WeightFamily::Zero || set.iter().all(|p| p.weight == 0.0));
            }
        }
    }

    #[test]
    fn places_are_taken_again() {
        let set = weighted_points(SpaceFamily::Grid, WeightFamily::SamePlaces, 60, &mut SplitMix64(5));
        let same = |i: usize, weights: bool| {
            set[..i].iter().any(|p| p.at == set[i].at && (p.weight == set[i].weight) == weights)
        };
        assert!((0..set.len()).any(|i| same(i, true)) && (0..set.len()).any(|i| same(i, false)));
    }

    #[test]
    fn scales() {
        let scale = |n: usize, x: f64| Scale::of(vec![Point3::new(0.5, -x, 0.0); n].into_iter());
        assert_eq!([0.7, 1.0, 5.0, 8.0].map(|x| scale(1, x).size), [1.0, 2.0, 8.0, 16.0]);
        assert_eq!([0, 1, 2, 7, 8, 64, 1 << 15].map(|n| scale(n, 0.9).h), [1.0, 1.0, 1.0, 0.5, 0.5, 0.25, two_to(-5)]);
        assert_eq!([1, 8, 9, 28].map(|n| scale(n, 0.9).s), [1.0, 0.5, 1.0 / 3.0, 0.25]);
    }
}
