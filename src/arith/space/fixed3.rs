//! Stage two of the hottest predicates of space: integers of fixed width, where they hold the differences exactly.
//!
//! Differences of coordinates become integers below 2^62 over a power of two chosen by the largest of them. All points of a grid, and nearly
//! all neighbours in any set of points, allow that: then ties and near-ties are decided exactly, at the price of some 60 machine
//! multiplications. Where a bit would be lost the answer is `None`, and the next stage decides.

use super::kernel3::{Corners3, WeightedCorners};
use crate::arith::double_double::two_sum;
use crate::arith::scale;
use crate::model::{Point3, Sign, WeightedPoint};

/// Bits of a difference without its sign.
const BITS: i32 = 62;
/// Differences of at most this many bits keep the determinant of in_sphere below 2^127: lifts are at most 3/4 2^50 and with weights
/// 5/4 2^50, triple products at most 6 2^72, the sum of four products at most 30 2^122.
const SMALL: u32 = 24;

/// Vectors as integers over a common power of two: vector = integer / 2^exponent.
struct Fixed<const N: usize> {
    v: [[i64; 3]; N],
    exponent: i32,
}

/// The vectors from `base` to the points; `None` if they are not exact in this form.
#[inline]
fn differences<const N: usize>(points: [Point3; N], base: Point3) -> Option<Fixed<N>> {
    let exact = points.map(|p| [two_sum(p.x, -base.x), two_sum(p.y, -base.y), two_sum(p.z, -base.z)]);
    let mut largest = 0.0f64;
    for (head, _) in exact.as_flattened() {
        largest = if head.abs() > largest { head.abs() } else { largest };
    }
    let exponent = BITS - scale::exponent_of(largest);
    if !(-1000..=1000).contains(&exponent) {
        return None;
    }
    let factor = scale::power_of_two(exponent);
    let mut v = [[0i64; 3]; N];
    for (n, &(head, tail)) in v.as_flattened_mut().iter_mut().zip(exact.as_flattened()) {
        // The head is below 2^62 by the choice of the exponent (2^62 where rounded up to it), the tail below 2^9.
        let head = head * factor;
        *n = head as i64;
        let mut lost = *n as f64 != head;
        if tail != 0.0 {
            let tail = tail * factor;
            *n += tail as i64;
            lost |= (tail as i64) as f64 != tail;
        }
        if lost {
            return None;
        }
    }
    Some(Fixed { v, exponent })
}

impl<const N: usize> Fixed<N> {
    /// The number of low bits that are 0 in all components, if the rest has at most `SMALL` bits.
    #[inline]
    fn small_shift(&self) -> Option<u32> {
        let (mut any, mut magnitude) = (0, 0);
        for &n in self.v.as_flattened() {
            any |= n;
            magnitude |= n.unsigned_abs();
        }
        let zeros = any.trailing_zeros();
        (64 - magnitude.leading_zeros() <= zeros.saturating_add(SMALL)).then_some(zeros.min(63))
    }
}

/// Sign of det(b - a, c - a, d - a), if the differences are exact in 62 bits.
#[inline]
pub(super) fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Sign> {
    let f = differences([b, c, d], a)?;
    let [b, c, d] = f.v;
    Some(triple(b[2], minor(c, d), c[2], minor(d, b), d[2], minor(b, c)).sign())
}

/// Position of q against the sphere of t, if the differences are exact in 62 bits.
pub(super) fn in_sphere(t: Corners3, q: Point3) -> Option<Sign> {
    let f = differences(t, q)?;
    if let Some(shift) = f.small_shift() {
        let v = f.v.map(|v| v.map(|n| n >> shift));
        return Some(sign(small_determinant(v, v.map(small_lift))));
    }
    Some(determinant_sign(f.v, f.v.map(lift)))
}

/// Position of q against the orthoball of t, if the differences are exact in 62 bits and those of the weights in 124.
pub(super) fn power_side(t: WeightedCorners, q: WeightedPoint) -> Option<Sign> {
    let f = differences(t.map(|p| p.at), q.at)?;
    let mut weights = [0i128; 4];
    for (w, p) in weights.iter_mut().zip(t) {
        *w = weight_difference(q.weight, p.weight, 2 * f.exponent)?;
    }
    if let Some(shift) = f.small_shift() {
        let v = f.v.map(|v| v.map(|n| n >> shift));
        let mut lifts = v.map(small_lift);
        // Weights as fine as the grid and as small as its lifts.
        let fits = |w: i128| (w >> (2 * shift)) << (2 * shift) == w && (w >> (2 * shift)).unsigned_abs() < 1 << 49;
        if weights.into_iter().all(fits) {
            for (l, w) in lifts.iter_mut().zip(weights) {
                *l += (w >> (2 * shift)) as i64;
            }
            return Some(sign(small_determinant(v, lifts)));
        }
    }
    let mut lifts = f.v.map(lift);
    for (l, w) in lifts.iter_mut().zip(weights) {
        *l += w;
    }
    Some(determinant_sign(f.v, lifts))
}

/// (a - b) 2^exponent, if an integer below 2^125.
#[inline]
fn weight_difference(a: f64, b: f64, exponent: i32) -> Option<i128> {
    if a == b {
        return Some(0);
    }
    let (head, tail) = two_sum(a, -b);
    integer(head, exponent)?.checked_add(integer(tail, exponent)?)
}

/// x 2^exponent, if an integer below 2^124.
#[inline]
fn integer(x: f64, exponent: i32) -> Option<i128> {
    if x == 0.0 {
        return Some(0);
    }
    // 53 bits of x above its last place.
    let place = scale::exponent_of(x.abs()) - 53;
    let mantissa = scale::by_power_of_two(x, -place) as i64;
    let shift = place + exponent;
    match shift {
        0..=71 => Some(i128::from(mantissa) << shift),
        -62..0 if mantissa.trailing_zeros() >= shift.unsigned_abs() => Some(i128::from(mantissa >> -shift)),
        _ => None,
    }
}

#[inline]
fn sign(n: i128) -> Sign {
    match n.signum() {
        1 => Sign::Positive,
        0 => Sign::Zero,
        _ => Sign::Negative,
    }
}

/// The product of two i64s; one machine instruction.
#[inline]
fn wide(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

/// The cross product of the first two components, below 2^125.
#[inline]
fn minor(u: [i64; 3], v: [i64; 3]) -> i128 {
    wide(u[0], v[1]) - wide(u[1], v[0])
}

/// The squared length, below 2^126.
#[inline]
fn lift(v: [i64; 3]) -> i128 {
    wide(v[0], v[0]) + wide(v[1], v[1]) + wide(v[2], v[2])
}

#[inline]
fn small_lift(v: [i64; 3]) -> i64 {
    v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
}

/// The determinant of in_sphere for components of at most 24 bits and lifts of at most 5/4 2^50.
#[inline]
fn small_determinant([a, b, c, d]: [[i64; 3]; 4], lifts: [i64; 4]) -> i128 {
    let minor = |u: [i64; 3], v: [i64; 3]| u[0] * v[1] - u[1] * v[0];
    let (ab, bc, cd) = (minor(a, b), minor(b, c), minor(c, d));
    let (ac, bd, ad) = (minor(a, c), minor(b, d), minor(a, d));
    let minors = [
        wide(b[2], cd) - wide(c[2], bd) + wide(d[2], bc),
        wide(c[2], ad) - wide(a[2], cd) - wide(d[2], ac),
        wide(a[2], bd) - wide(b[2], ad) + wide(d[2], ab),
        wide(b[2], ac) - wide(a[2], bc) - wide(c[2], ab),
    ];
    (minors[0] * i128::from(lifts[0]) + minors[1] * i128::from(lifts[1]))
        + (minors[2] * i128::from(lifts[2]) + minors[3] * i128::from(lifts[3]))
}

/// The sign of the determinant of in_sphere for components below 2^62 and lifts below 2^127.
#[inline]
fn determinant_sign(v: [[i64; 3]; 4], lifts: [i128; 4]) -> Sign {
    let [a, b, c, d] = v;
    let (ab, bc, cd) = (minor(a, b), minor(b, c), minor(c, d));
    let (ac, bd, ad) = (minor(a, c), minor(b, d), minor(a, d));
    // Each triple product as its three components of z and their minors.
    let terms = [
        [(b[2], cd), (-c[2], bd), (d[2], bc)],
        [(c[2], ad), (-a[2], cd), (-d[2], ac)],
        [(a[2], bd), (-b[2], ad), (d[2], ab)],
        [(b[2], ac), (-a[2], bc), (-c[2], ab)],
    ];
    if let Some(sign) = leading_sign(terms, lifts) {
        return sign;
    }
    let mut sum = Sum::default();
    for ([(i, m), (j, n), (k, o)], lift) in terms.into_iter().zip(lifts) {
        sum.add_product(triple(i, m, j, n, k, o), lift);
    }
    sum.sign()
}

/// The sign of the sum of triple products times lifts by the leading bits of minors, triple products and lifts, where they tell it.
///
/// Cutting a number off at a bit makes it too small by less than one unit of that bit. With minors cut to multiples of 2^63 a triple product is off by less
/// than 3 2^62 2^63 < 2 2^126, and cut to a multiple t 2^126 by less than 3 2^126; |t| < 2^63. Lifts are cut to l 2^65, |l| < 2^62. A product is then off by less
/// than 3 (|l| + 1) + |t| units of 2^191, and all four together by less than 2^67 of them, their sum being below 2^127.
#[inline]
fn leading_sign(terms: [[(i64, i128); 3]; 4], lifts: [i128; 4]) -> Option<Sign> {
    let (mut sum, mut bound) = (0i128, 0i128);
    for (term, lift) in terms.into_iter().zip(lifts) {
        let product: i128 = term.into_iter().map(|(z, minor)| wide(z, (minor >> 63) as i64)).sum();
        let (t, l) = ((product >> 63) as i64, (lift >> 65) as i64);
        sum += wide(t, l);
        bound += 3 * (i128::from(l.unsigned_abs()) + 1) + i128::from(t.unsigned_abs());
    }
    if sum > bound {
        Some(Sign::Positive)
    } else if sum < -bound {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// The integer high 2^64 + low.
#[derive(Clone, Copy)]
struct Triple {
    high: i128,
    low: u64,
}

/// i m + j n + k o for factors below 2^62 and below 2^125: below 2^189.
#[inline]
fn triple(i: i64, m: i128, j: i64, n: i128, k: i64, o: i128) -> Triple {
    // Both halves of each product, the low one of 128 bits and signed.
    let part = |i: i64, m: i128| (wide(i, (m >> 64) as i64), i128::from(i) * i128::from(m as u64));
    let ((mh, ml), (nh, nl), (oh, ol)) = (part(i, m), part(j, n), part(k, o));
    // Each low part is below 2^126, so their sum is below 2^128 and must be carried before it is made.
    let low = i128::from(ml as u64) + i128::from(nl as u64) + i128::from(ol as u64);
    let high = mh + nh + oh + (ml >> 64) + (nl >> 64) + (ol >> 64) + (low >> 64);
    Triple { high, low: low as u64 }
}

impl Triple {
    /// The magnitude, least limb first.
    #[inline]
    fn magnitude(self) -> [u64; 3] {
        let limbs = [self.low, self.high as u64, (self.high >> 64) as u64];
        if self.high >= 0 {
            return limbs;
        }
        let mut carry = 1u128;
        limbs.map(|l| {
            carry += u128::from(!l);
            let limb = carry as u64;
            carry >>= 64;
            limb
        })
    }

    #[inline]
    fn sign(self) -> Sign {
        match self.high.signum() {
            1 => Sign::Positive,
            0 if self.low == 0 => Sign::Zero,
            0 => Sign::Positive,
            _ => Sign::Negative,
        }
    }
}

/// An integer of 320 bits in two's complement, least limb first.
#[derive(Default)]
struct Sum([u64; 5]);

impl Sum {
    /// Adds t n, which is below 2^(189 + 127) in magnitude: four such fit.
    #[inline]
    fn add_product(&mut self, t: Triple, n: i128) {
        let negative = (t.high < 0) != (n < 0);
        let magnitude = t.magnitude();
        let n = n.unsigned_abs();
        let n = [n as u64, (n >> 64) as u64];
        let mut product = [0u64; 5];
        for (i, &a) in n.iter().enumerate() {
            let mut carry = 0u128;
            for (j, &b) in magnitude.iter().enumerate() {
                carry += u128::from(a) * u128::from(b) + u128::from(product[i + j]);
                product[i + j] = carry as u64;
                carry >>= 64;
            }
            product[i + 3] = carry as u64;
        }
        // -x is the complement of x plus 1.
        let mask = if negative { u64::MAX } else { 0 };
        let mut carry = u128::from(negative);
        for (s, p) in self.0.iter_mut().zip(product) {
            carry += u128::from(*s) + u128::from(p ^ mask);
            *s = carry as u64;
            carry >>= 64;
        }
    }

    #[inline]
    fn sign(&self) -> Sign {
        if (self.0[4] as i64) < 0 {
            Sign::Negative
        } else if self.0 == [0; 5] {
            Sign::Zero
        } else {
            Sign::Positive
        }
    }
}
