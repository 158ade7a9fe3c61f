//! Between doubles and rationals: integers of fixed width, without allocation.
//!
//! Problem: points of one sphere or plane, rounded or not, leave a filter undecided by the million, and a rational takes microseconds. Idea: cells are small
//! and coordinates alike in size, so that the differences of coordinates are whole in units of the largest one over 2^62, and a determinant of them is an
//! integer of a few words. Where one is not whole, there is no answer.
//!
//! The widths: differences are below 2^62, hence minors below 2 2^124 and lifts, with weights below 2^125, below 3 2^124 + 2^125 < 2^127: 128 bits. A triple product is
//! below 3 2^125 2^62 < 2^189: 192 bits. The depth, four products of the two, is below 4 2^189 2^127 = 2^318: 320 bits.

use super::predicates::Corners;
use crate::check::scale::power_of_two;
use crate::model::{Point3, Sign, WeightedPoint};
use std::ops::{Add, Sub};

/// Limbs of a triple product, and of a depth.
const TRIPLE: usize = 3;
const DEPTH: usize = 5;

/// Differences of coordinates are below 2 to this power, those of weights below 2^125.
const BITS: i32 = 62;

/// An integer in two's complement, least limb first: right modulo 2^(64 N).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Wide<N> {
    fn is_negative(self) -> bool {
        (self.0[N - 1] as i64) < 0
    }

    fn sign(self) -> Sign {
        if self.is_negative() {
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
    fn sub(mut self, other: Self) -> Self {
        // All borrows are 0 or -1.
        let mut borrow = 0;
        for (x, y) in self.0.iter_mut().zip(other.0) {
            let difference = i128::from(*x) - i128::from(y) + borrow;
            (*x, borrow) = (difference as u64, difference >> 64);
        }
        self
    }
}

/// x y + z + carry as two limbs, the least first.
#[inline]
fn multiplied(x: u64, y: u64, z: u64, carry: u64) -> (u64, u64) {
    let sum = u128::from(x) * u128::from(y) + u128::from(z) + u128::from(carry);
    (sum as u64, (sum >> 64) as u64)
}

impl Wide<TRIPLE> {
    /// Times a lift.
    #[inline]
    fn times(self, lift: i128) -> Wide<DEPTH> {
        let [a, b, c] = self.0;
        let [low, high] = [lift as u64, (lift >> 64) as u64];
        // As if without signs: a negative factor counts 2^192 or 2^128 too much.
        let (p0, carry) = multiplied(a, low, 0, 0);
        let (p1, carry) = multiplied(b, low, 0, carry);
        let (p2, p3) = multiplied(c, low, 0, carry);
        let (p1, carry) = multiplied(a, high, p1, 0);
        let (p2, carry) = multiplied(b, high, p2, carry);
        let (p3, p4) = multiplied(c, high, p3, carry);
        let keep = |x: u64, negative: bool| if negative { x } else { 0 };
        let (f, g) = (self.is_negative(), lift < 0);
        Wide([p0, p1, p2, p3, p4])
            - Wide([0, 0, 0, keep(low, f), keep(high, f)])
            - Wide([0, 0, keep(a, g), keep(b, g), keep(c, g)])
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

/// x - y in units of 2^e; nothing if one of them is not whole, or the difference is not below 2^125.
fn difference(x: f64, y: f64, e: i32) -> Option<i128> {
    let whole = |(m, k): (i64, i32)| match k.saturating_sub(e) {
        _ if m == 0 => Some(0),
        // A result below 2^126.
        shift @ 0.. if shift as u32 <= m.unsigned_abs().leading_zeros() + 62 => Some(i128::from(m) << shift),
        _ => None,
    };
    let difference = whole(parts(x))? - whole(parts(y))?;
    (difference.unsigned_abs() >> 125 == 0).then_some(difference)
}

type Vector = [i64; 3];

/// Differences of coordinates as rounded ones and what these have lost.
type Differences = [[f64; 2]; 3];

/// The coordinates of q less those of p (two-sum, Knuth).
#[inline]
fn differences(p: Point3, q: Point3) -> Differences {
    let (p, q) = (p.to_array(), q.to_array());
    [0, 1, 2].map(|k: usize| {
        let (x, y) = (q[k], p[k]);
        let rounded = x - y;
        let part = x - rounded;
        [rounded, (x - (rounded + part)) + (part - y)]
    })
}

/// The greater one. Faster than what also looks for NaN.
#[inline]
fn greater(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

#[inline]
fn largest(d: &Differences) -> f64 {
    greater(greater(d[0][0].abs(), d[1][0].abs()), d[2][0].abs())
}

/// A power of two whose square is more than an eighth of a difference of weights, and at most half of it: with it, that is below 2^125 squared units.
#[inline]
fn root(weight: f64) -> f64 {
    let exponent = ((weight.to_bits() >> 52) as i32 - 1024).div_euclid(2);
    if weight > 0.0 { power_of_two(exponent) } else { 0.0 }
}

/// e, such that differences up to the largest are below 2^62 units of 2^e, and that is not below 2^61 (unless it is below 2^-961).
#[inline]
fn unit(largest: f64) -> Option<i32> {
    // The biased exponent; with less, the power of two would overflow.
    let exponent = ((largest.to_bits() >> 52) as i32).max(BITS - 1);
    // Beyond, what is small would vanish by underflow.
    (exponent < 1023 + BITS).then_some(exponent - 1023 - (BITS - 1))
}

/// Differences in units of 2^e, `up` being 2^-e; and whether they are whole.
#[inline]
fn whole(d: &Differences, up: f64) -> (Vector, bool) {
    let mut all = true;
    let vector = d.map(|parts| {
        let scaled = parts.map(|x| x * up);
        let [most, rest] = scaled.map(|x| x as i64);
        all &= most as f64 == scaled[0] && rest as f64 == scaled[1];
        most.wrapping_add(rest)
    });
    (vector, all)
}

/// A point seen from another.
#[derive(Clone, Copy, Debug)]
struct Row {
    to: Vector,
    lift: i128,
}

impl Row {
    /// q seen from p, in units of 2^e.
    #[inline]
    fn new(to: Vector, p: &WeightedPoint, q: &WeightedPoint, e: i32) -> Option<Row> {
        let [x, y, z] = to;
        let mut lift = product(x, x) + product(y, y) + product(z, z);
        if q.weight != p.weight {
            lift -= difference(q.weight, p.weight, 2 * e)?;
        }
        Some(Row { to, lift })
    }
}

/// The orthoball of three points and the one they are seen from.
pub(super) struct Ball {
    minors: [[i128; 3]; 3],
    lifts: [i128; 3],
    volume: Wide<TRIPLE>,
}

impl Ball {
    /// Of p, u, v and w, which are positively oriented.
    #[inline]
    fn new(u: &Row, v: &Row, w: &Row) -> Ball {
        let minors = [cross(&v.to, &w.to), cross(&w.to, &u.to), cross(&u.to, &v.to)];
        Ball { minors, lifts: [u.lift, v.lift, w.lift], volume: triple(&minors[0], &u.to) }
    }

    /// S.x - D L(x) of `predicates`.
    #[inline]
    fn depth(&self, x: &Row) -> Wide<DEPTH> {
        let along = |k: usize| triple(&self.minors[k], &x.to).times(self.lifts[k]);
        along(0) + along(1) + along(2) - self.volume.times(x.lift)
    }
}

/// Points seen from one of them, those that are whole in units of the largest difference over 2^62.
#[derive(Clone, Debug, Default)]
pub struct Sight {
    is_open: bool,
    rows: Vec<Option<Row>>,
    differences: Vec<Differences>,
}

impl Sight {
    /// Forgets all.
    pub fn close(&mut self) {
        self.is_open = false;
    }

    /// Looks from p at some points, named by their positions, unless open. Nothing is known of `None`.
    pub fn open<P: Iterator<Item = Option<WeightedPoint>> + Clone>(
        &mut self,
        p: WeightedPoint,
        points: impl Fn() -> P,
    ) {
        if !self.is_open {
            self.is_open = true;
            self.look(p, points());
        }
    }

    fn look(&mut self, p: WeightedPoint, points: impl Iterator<Item = Option<WeightedPoint>> + Clone) {
        self.differences.clear();
        let mut most = 0.0;
        self.differences.extend(points.clone().map(|q| {
            let q = q.unwrap_or(p);
            let d = differences(p.at, q.at);
            most = greater(greater(most, largest(&d)), root((q.weight - p.weight).abs()));
            d
        }));
        self.rows.clear();
        let Some(e) = unit(most) else {
            return self.rows.resize(self.differences.len(), None);
        };
        let up = power_of_two(-e);
        self.rows.extend(self.differences.iter().zip(points).map(|(d, q)| {
            let (to, is_whole) = whole(d, up);
            Row::new(to, &p, &q?, e).filter(|_| is_whole)
        }));
    }

    /// The orthoball of p and three points, if all are whole; (points, p) is positively oriented.
    #[inline]
    pub(super) fn ball(&self, corners: [u32; 3]) -> Option<Ball> {
        let [u, v, w] = corners.map(|k| self.rows[k as usize].as_ref());
        // (p, v, u, w) is an even permutation of (u, v, w, p).
        Some(Ball::new(v?, u?, w?))
    }

    /// The side of a point, if it is whole.
    #[inline]
    pub(super) fn side(&self, ball: &Ball, k: u32) -> Option<Sign> {
        self.rows[k as usize].as_ref().map(|x| ball.depth(x).sign())
    }
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
fn triple(m: &[i128; 3], x: &Vector) -> Wide<TRIPLE> {
    let (mut low, mut high) = (0, 0);
    for k in 0..3 {
        // Below 2^126; the rest of a minor is below 2^61.
        let p = i128::from(m[k] as u64) * i128::from(x[k]);
        low += u128::from(p as u64);
        high += product((m[k] >> 64) as i64, x[k]) + (p >> 64);
    }
    high += (low >> 64) as i128;
    Wide([low as u64, high as u64, (high >> 64) as u64])
}

/// The sign of `predicates::volume6`.
pub(super) fn volume6(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Sign> {
    let all = [b, c, d].map(|p| differences(a, p));
    let up = power_of_two(-unit(all.iter().map(largest).fold(0.0, greater))?);
    let [(u, f), (v, g), (w, h)] = all.map(|d| whole(&d, up));
    (f && g && h).then(|| triple(&cross(&v, &w), &u).sign())
}

/// The sign of `predicates::depth`.
pub(super) fn depth(t: &Corners, q: &WeightedPoint) -> Option<Sign> {
    depth_of(t, q).map(Wide::sign)
}

/// In units of 2^(5 e).
#[inline]
fn depth_of(t: &Corners, q: &WeightedPoint) -> Option<Wide<DEPTH>> {
    let others = [t[1], t[2], t[3], *q];
    let all = others.map(|p| differences(t[0].at, p.at));
    let heaviest = others.iter().fold(0.0, |m, p| greater(m, (p.weight - t[0].weight).abs()));
    let e = unit(all.iter().map(largest).fold(root(heaviest), greater))?;
    let up = power_of_two(-e);
    let vectors = all.map(|d| whole(&d, up));
    if vectors.iter().any(|(_, is_whole)| !is_whole) {
        return None;
    }
    let row = |k: usize| Row::new(vectors[k].0, &t[0], &others[k], e);
    Some(Ball::new(&row(0)?, &row(1)?, &row(2)?).depth(&row(3)?))
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
            ("boxes far up", boxes(draw, power_of_two(61)), 1900..=2000),
            ("boxes too far up", boxes(draw, power_of_two(1000)), 0..=10),
            ("boxes far down", boxes(draw, power_of_two(-950)), 1900..=2000),
            ("boxes too far down", boxes(draw, power_of_two(-1060)), 0..=2000),
            ("off the origin", family(draw, |d| site([(); 3].map(|()| 1.0 + unit(d())), 0.0)), 1000..=1000),
            ("around the origin", family(draw, |d| site([(); 3].map(|()| unit(d()) - 0.5), 0.0)), 500..=1000),
            (
                "whole words",
                family(draw, |d| {
                    let whole = |d: &mut dyn FnMut() -> u64| match d() % 16 {
                        0 => 1.0,
                        1 => 0.0,
                        2..6 => sign(d()) * (power_of_two(61) - power_of_two(8)),
                        6 if d().is_multiple_of(8) => sign(d()) * power_of_two(61),
                        _ => sign(d()) * (d() << 8) as f64,
                    };
                    let weight = sign(d()) * unit(d()) * power_of_two(125);
                    site([(); 3].map(|()| whole(&mut *d)), if d() & 1 == 0 { 0.0 } else { weight })
                }),
                200..=990,
            ),
            (
                "coarse weights on a fine grid",
                family(draw, |d| site([(); 3].map(|()| (d() % (1 << 20)) as f64), (d() % (1 << 20)) as f64)),
                1000..=1000,
            ),
            (
                "round weights anywhere",
                family(draw, |d| site([(); 3].map(|()| unit(d()) + 1.0), (d() % 16) as f64 / 16.0)),
                900..=1000,
            ),
            (
                "fine weights on a coarse grid",
                family(draw, |d| site([(); 3].map(|()| (d() % 3) as f64), (1 + d() % 4) as f64 * power_of_two(-57))),
                1000..=1000,
            ),
            (
                "weights too fine",
                family(draw, |d| site([(); 3].map(|()| (d() % 3) as f64), (1 + d() % 4) as f64 * power_of_two(-121))),
                0..=200,
            ),
            (
                "vanishing beside the largest",
                family(draw, |d| {
                    let sizes = [power_of_two(900), power_of_two(-1000)];
                    site([(); 3].map(|()| sizes[(d() % 2) as usize] * (d() % 4) as f64), 0.0)
                }),
                0..=500,
            ),
            (
                "far apart",
                family(draw, |d| site([(); 3].map(|()| power_of_two((d() % 2040) as i32 - 1060) * unit(d())), 0.0)),
                0..=10,
            ),
            ("subnormal", family(draw, |d| site([(); 3].map(|()| f64::from_bits(d() % 4)), 0.0)), 0..=1000),
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

    /// With a whole crowd in sight, of which some are far, infinite or not whole.
    #[test]
    fn what_is_seen_is_right() {
        let mut sight = Sight::default();
        let (mut answered, mut silent) = (0, 0);
        for (name, cases, _) in families() {
            for pair in cases.windows(2) {
                let ([a, b, c, p, q], [far, ..]) = (pair[0], pair[1]);
                let points = [Some(far), Some(c), None, Some(a), Some(q), Some(b)];
                sight.close();
                sight.open(p, || points.into_iter());
                let ball = sight.ball([3, 5, 1]);
                for (k, x) in [(4, q), (0, far)] {
                    let side = ball.as_ref().and_then(|ball| sight.side(ball, k));
                    assert!(side.is_none_or(|side| side == truth([a, b, c, p, x])), "{name}: {pair:?}");
                    answered += u32::from(side.is_some());
                    silent += u32::from(side.is_none());
                }
                assert!(ball.is_none_or(|ball| sight.side(&ball, 2).is_none()), "infinite");
            }
        }
        assert!(answered > 10_000 && silent > 1000, "{answered} {silent}");
    }

    /// The families reach the widths that the module's head gives, nearly.
    #[test]
    fn all_limbs_are_used() {
        let bits = |x: Wide<DEPTH>| {
            let sign = if x.is_negative() { u64::MAX } else { 0 };
            let top = x.0.iter().rposition(|&limb| limb != sign).unwrap_or(0);
            64 * top as u32 + 64 - (x.0[top] ^ sign).leading_zeros()
        };
        let all = families().into_iter().flat_map(|f| f.1);
        let widest = all.filter_map(|five| depth_of(&split(five).0, &five[4])).map(bits).max();
        assert!(widest > Some(310), "{widest:?}");
    }
}
