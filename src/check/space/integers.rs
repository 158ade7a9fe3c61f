//! Between doubles and rationals: integers of fixed width, without allocation.
//!
//! Problem: points of one sphere or plane, rounded or not, leave a filter undecided by the million, and a rational takes microseconds. Idea: in units of
//! the lowest bit set in them, coordinates are integers, and so is a determinant of their differences. Cells are small and coordinates alike in size:
//! differences fit a machine word. Where one does not, there is no answer.
//!
//! The widths: differences are below 2^62, hence minors below 2 2^124 and lifts, with weights below 2^125, below 3 2^124 + 2^125 < 2^127: 128 bits. A triple product is
//! below 3 2^125 2^62 < 2^189: 192 bits. The depth, four products of the two, is below 4 2^189 2^127 = 2^318: 320 bits.

use super::predicates::Corners;
use crate::model::{Point3, Sign, WeightedPoint};
use std::ops::{Add, Mul, Sub};

/// Limbs of a triple product, and of a depth.
const TRIPLE: usize = 3;
const DEPTH: usize = 5;

/// Differences of coordinates are below 2 to this power, those of weights below 2^125.
const BITS: u32 = 62;

/// Most places that an odd mantissa of 53 bits is shifted within 128 bits.
const MOST_SHIFT: i32 = 73;

/// An integer in two's complement, least limb first: right modulo 2^(64 N).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Wide<N> {
    fn of(x: i128) -> Self {
        Wide(std::array::from_fn(|i| if i < 2 { (x >> (64 * i)) as u64 } else { (x >> 127) as u64 }))
    }

    fn widened<const M: usize>(self) -> Wide<M> {
        let fill = ((self.0[N - 1] as i64) >> 63) as u64;
        Wide(std::array::from_fn(|i| if i < N { self.0[i] } else { fill }))
    }

    fn sign(self) -> Sign {
        if (self.0[N - 1] as i64) < 0 {
            Sign::Negative
        } else if self.0 == [0; N] {
            Sign::Zero
        } else {
            Sign::Positive
        }
    }
}

impl<const N: usize> Add for Wide<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: Self) -> Self {
        let mut carry = 0;
        for (x, y) in self.0.iter_mut().zip(other.0) {
            let sum = u128::from(*x) + u128::from(y) + carry;
            (*x, carry) = (sum as u64, sum >> 64);
        }
        self
    }
}

impl<const N: usize> Sub for Wide<N> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        let mut one = [0; N];
        one[0] = 1;
        self + Wide(other.0.map(|x| !x)) + Wide(one)
    }
}

impl<const N: usize> Mul for Wide<N> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let mut product = [0u64; N];
        for i in 0..N {
            let mut carry = 0;
            for j in 0..N - i {
                // At most (2^64 - 1)^2 + 2 (2^64 - 1) = 2^128 - 1.
                let sum = u128::from(self.0[i]) * u128::from(other.0[j]) + u128::from(product[i + j]) + carry;
                (product[i + j], carry) = (sum as u64, sum >> 64);
            }
        }
        Wide(product)
    }
}

/// A finite number as m 2^k with m odd, or m = 0 and the largest k.
#[inline]
fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let biased = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    if biased == 0 && fraction == 0 {
        return (0, i32::MAX);
    }
    let (m, k) = if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    let zeros = m.trailing_zeros();
    let m = m >> zeros;
    (if x < 0.0 { -m } else { m }, k + zeros as i32)
}

/// x - y in units of 2^e, which are at most the lowest bits of both; nothing if it is not below 2^`bits`.
#[inline]
fn difference((m, k): (i64, i32), (n, l): (i64, i32), e: i32, bits: u32) -> Option<i128> {
    let shift = |m: i64, k: i32| i128::from(m) << (k.saturating_sub(e)).min(MOST_SHIFT);
    let fits = |m: i64, k: i32| m == 0 || k.saturating_sub(e) <= MOST_SHIFT;
    // Each is below 2^126.
    let difference = shift(m, k) - shift(n, l);
    (fits(m, k) && fits(n, l) && difference.unsigned_abs() >> bits == 0).then_some(difference)
}

type Vector = [i64; 3];

/// The differences of points from a base, in units of 2^e, the lowest bit that is set in any, but at most `e`; and that.
#[inline]
fn differences<const K: usize>(base: Point3, others: [Point3; K], e: i32) -> Option<([Vector; K], i32)> {
    let base = base.to_array().map(parts);
    let others = others.map(|p| p.to_array().map(parts));
    let e = others.iter().fold(e, |e, p| p.iter().fold(e, |e, x| e.min(x.1)));
    let e = base.iter().fold(e, |e, x| e.min(x.1));
    let mut vectors = [[0; 3]; K];
    for (vector, other) in vectors.iter_mut().zip(others) {
        for k in 0..3 {
            vector[k] = difference(other[k], base[k], e, BITS)? as i64;
        }
    }
    Some((vectors, e))
}

#[inline]
fn product(x: i64, y: i64) -> i128 {
    i128::from(x) * i128::from(y)
}

#[inline]
fn cross(u: &Vector, v: &Vector) -> [i128; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| product(u[i], v[j]) - product(u[j], v[i]))
}

#[inline]
fn triple<const N: usize>(m: &[i128; 3], x: &Vector) -> Wide<N> {
    let along = |k: usize| Wide::of(m[k]) * Wide::of(i128::from(x[k]));
    along(0) + along(1) + along(2)
}

/// The sign of `predicates::volume6`.
pub(super) fn volume6(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Sign> {
    let ([u, v, w], _) = differences(a, [b, c, d], i32::MAX)?;
    Some(triple::<TRIPLE>(&cross(&v, &w), &u).sign())
}

/// The sign of `predicates::depth`.
pub(super) fn depth(t: &Corners, q: &WeightedPoint) -> Option<Sign> {
    depth_of::<TRIPLE, DEPTH>(t, q)
}

/// The same with so many limbs.
fn depth_of<const N: usize, const M: usize>(t: &Corners, q: &WeightedPoint) -> Option<Sign> {
    let all = [t[1], t[2], t[3], *q];
    let base = parts(t[0].weight);
    let weights = all.map(|p| parts(p.weight));
    // Weights are multiples of the squared unit.
    let lowest = weights.iter().fold(base.1, |e, w| e.min(w.1));
    let bound = if lowest == i32::MAX { lowest } else { lowest.div_euclid(2) };
    let (vectors, e) = differences(t[0].at, all.map(|p| p.at), bound)?;
    let mut lifts = [0; 4];
    for (k, x) in vectors.iter().enumerate() {
        let weight = difference(weights[k], base, e.saturating_mul(2), 125)?;
        lifts[k] = product(x[0], x[0]) + product(x[1], x[1]) + product(x[2], x[2]) - weight;
    }
    let [u, v, w, x] = vectors;
    let minors = [cross(&v, &w), cross(&w, &u), cross(&u, &v)];
    let raised = |m: &[i128; 3], x: &Vector, lift: i128| triple::<N>(m, x).widened::<M>() * Wide::of(lift);
    let along = |k: usize| raised(&minors[k], &x, lifts[k]);
    Some((along(0) + along(1) + along(2) - raised(&minors[0], &u, lifts[3])).sign())
}

#[cfg(test)]
mod tests {
    use super::super::predicates;
    use super::*;
    use crate::check::scale::power_of_two;
    use crate::check::value::{Exact, exact_sign};

    /// Numbers of a linear congruence (Knuth's MMIX).
    fn draws() -> impl FnMut() -> u64 {
        let mut state = 5u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 11
        }
    }

    fn site(at: [f64; 3], weight: f64) -> WeightedPoint {
        WeightedPoint { at: Point3::from_array(at), weight }
    }

    type Five = [WeightedPoint; 5];

    fn split([a, b, c, d, q]: Five) -> (Corners, WeightedPoint) {
        ([a, b, c, d], q)
    }

    fn truth(five: Five) -> Sign {
        let (t, q) = split(five);
        exact_sign(&predicates::depth::<Exact>(&t, &q))
    }

    /// Five of so many cases, each of numbers that a function draws for a point.
    fn family(
        draw: &mut impl FnMut() -> u64,
        mut point: impl FnMut(&mut dyn FnMut() -> u64) -> WeightedPoint,
    ) -> Vec<Five> {
        (0..1000).map(|_| [(); 5].map(|()| point(draw))).collect()
    }

    /// Corners of boxes, of which some are off by an ulp; the lowest bits of coordinates differ.
    fn boxes(draw: &mut impl FnMut() -> u64, scale: f64) -> Vec<Five> {
        let mut case = || {
            let ends = [0, 1, 2].map(|_| [0, 1].map(|_| (draw() % 55) as f64 / 55.0 * scale));
            let mut five = [(); 5].map(|()| {
                let corner = draw();
                site([0, 1, 2].map(|k| ends[k][(corner >> k & 1) as usize]), 0.0)
            });
            if draw().is_multiple_of(3) {
                five[4].at.x = five[4].at.x.next_up();
            }
            five
        };
        (0..2000).map(|_| case()).collect()
    }

    /// Of each family the cases, and how many of them must be answered.
    fn families() -> Vec<(&'static str, Vec<Five>, std::ops::RangeInclusive<usize>)> {
        let draw = &mut draws();
        let unit = |r: u64| r as f64 / power_of_two(53);
        let sign = |r: u64| if r & 1 == 0 { 1.0 } else { -1.0 };
        vec![
            ("boxes", boxes(draw, 1.0), 1900..=2000),
            ("boxes far up", boxes(draw, power_of_two(1000)), 1900..=2000),
            ("boxes far down", boxes(draw, power_of_two(-1060)), 1900..=2000),
            ("off the origin", family(draw, |d| site([(); 3].map(|()| 1.0 + unit(d())), 0.0)), 1000..=1000),
            ("around the origin", family(draw, |d| site([(); 3].map(|()| unit(d()) - 0.5), 0.0)), 500..=1000),
            (
                "whole words",
                family(draw, |d| {
                    let whole = |d: &mut dyn FnMut() -> u64| match d() % 8 {
                        0 => 1.0,
                        1 => 0.0,
                        2 => sign(d()) * (power_of_two(61) - power_of_two(8)),
                        3 => sign(d()) * power_of_two(61),
                        _ => sign(d()) * (d() << 8) as f64,
                    };
                    let weight = sign(d()) * unit(d()) * power_of_two(126);
                    site([(); 3].map(|()| whole(&mut *d)), if d() & 1 == 0 { 0.0 } else { weight })
                }),
                200..=990,
            ),
            (
                "fine weights on a coarse grid",
                family(draw, |d| site([(); 3].map(|()| (d() % 3) as f64), (1 + d() % 4) as f64 * power_of_two(-57))),
                1000..=1000,
            ),
            (
                "far apart",
                family(draw, |d| site([(); 3].map(|()| power_of_two((d() % 2040) as i32 - 1060) * unit(d())), 0.0)),
                0..=10,
            ),
            ("subnormal", family(draw, |d| site([(); 3].map(|()| f64::from_bits(d() % 4)), 0.0)), 1000..=1000),
            (
                "the largest",
                family(draw, |d| site([(); 3].map(|()| sign(d()) * f64::MAX / (1 + d() % 2) as f64), f64::MAX)),
                0..=1000,
            ),
        ]
    }

    #[test]
    fn what_is_answered_is_right() {
        let mut zeros = 0;
        for (name, cases, answers) in families() {
            let mut answered = 0;
            for &five in &cases {
                let (t, q) = split(five);
                if let Some(sign) = depth(&t, &q) {
                    assert_eq!(sign, truth(five), "{name}: {five:?}");
                    answered += 1;
                    zeros += usize::from(sign == Sign::Zero);
                }
                let [a, b, c, d] = t.map(|p| p.at);
                if let Some(sign) = volume6(a, b, c, d) {
                    assert_eq!(sign, exact_sign(&predicates::volume6::<Exact>(a, b, c, d)), "{name}: {t:?}");
                }
            }
            assert!(answers.contains(&answered), "{name}: {answered}");
        }
        assert!(zeros > 2000, "{zeros}");
    }

    #[test]
    fn a_limb_less_is_wrong() {
        let wrong = |depth: fn(&Corners, &WeightedPoint) -> Option<Sign>| {
            let all = families().into_iter().flat_map(|f| f.1);
            all.filter(|&five| depth(&split(five).0, &five[4]).is_some_and(|sign| sign != truth(five))).count()
        };
        assert_eq!(wrong(depth_of::<3, 5>), 0);
        assert!(wrong(depth_of::<2, 5>) > 0 && wrong(depth_of::<3, 4>) > 0);
    }
}
