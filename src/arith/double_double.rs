//! Stage two: double-double numbers with a running bound of their error and exactness tracking.
//!
//! A value is hi + lo, hi = RN(hi + lo), within `err` of the exact one. Each operation's relative error is the published
//! one, rounded up: Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic" (2017). `err == 0` certifies the value: an operation whose every rounding was exact adds nothing to it.
//! Without that, ties on grids and results that are exactly 0 could never be decided here.
//!
//! Bounds are computed with rounding; each step loses a relative u = 2^-53, and `SLACK` at the end covers them.
//! Overflow makes a NaN of hi or an infinity of err, and every certificate then fails its comparison.

use super::poly::Ring;
use crate::model::Sign;

/// u^2 = 2^-106.
const U2: f64 = f64::EPSILON * f64::EPSILON / 4.0;
/// More than the underflow of all products that go into one product and its bound.
const TINY: f64 = 1e-300;
/// A product above this has no part below 2^-1074: 1e-280 2^-106 is above it.
const SAFE_PRODUCT: f64 = 1e-280;
/// Covers the rounding of the bounds themselves, and |lo| <= u |hi|.
const SLACK: f64 = 1.0 + 1e-6;

/// hi + lo, within `err` of the exact value.
#[derive(Clone, Copy, Debug)]
pub(super) struct DoubleDouble {
    hi: f64,
    lo: f64,
    err: f64,
}

/// a + b = s + e exactly.
#[inline]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// a + b = s + e exactly, for |a| >= |b| or a = 0.
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// a = high + low, 26 bits each (Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0;
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

/// a b = p + e exactly, unless something under- or overflows (Dekker).
#[inline]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (p, al * bl - (((p - ah * bh) - al * bh) - ah * bl))
}

impl DoubleDouble {
    const UNKNOWN: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0, err: f64::INFINITY };

    /// The sign, if the bound allows to tell it.
    #[inline]
    pub fn sign(self) -> Option<Sign> {
        let bound = self.err * SLACK;
        if self.hi > bound {
            Some(Sign::Positive)
        } else if self.hi < -bound {
            Some(Sign::Negative)
        } else if self.err == 0.0 && self.hi == 0.0 {
            Some(Sign::Zero)
        } else {
            None
        }
    }

    /// The exact value rounded once to nearest, if the bound allows to tell it.
    ///
    /// Rounding is monotone: if both ends of an enclosure round to hi, so does all between them, ties included.
    #[inline]
    pub fn rounded(self) -> Option<f64> {
        if self.err == 0.0 {
            return self.hi.is_finite().then_some(self.hi);
        }
        let e = self.err * SLACK + 4.0 * f64::EPSILON * self.lo.abs() + TINY;
        let certain = self.hi + (self.lo + e) == self.hi && self.hi + (self.lo - e) == self.hi;
        (certain && self.hi.is_finite()).then_some(self.hi)
    }

    /// The quotient; nothing is known of it where the divisor may be 0 or an intermediate result under- or overflow.
    ///
    /// Division of double-words with one correction (algorithm 17 of the source): relative error 15 u^2.
    #[inline]
    pub fn over(self, d: &DoubleDouble) -> DoubleDouble {
        let safe = |x: f64| (1e-270..1e290).contains(&x.abs());
        if self.hi == 0.0 && self.err == 0.0 && d.hi.abs() > d.err * SLACK {
            return DoubleDouble { hi: 0.0, lo: 0.0, err: 0.0 };
        }
        let q = self.hi / d.hi;
        if !(safe(self.hi) && safe(d.hi) && safe(q) && q.abs() > 1e-250 && d.err < d.hi.abs() / 4.0) {
            return DoubleDouble::UNKNOWN;
        }
        let (ch, cl) = two_product(d.hi, q);
        let (th, tl) = fast_two_sum(ch, d.lo * q);
        let (rh, rl) = fast_two_sum(th, tl + cl);
        let residual = (self.hi - rh) + (self.lo - rl);
        let (hi, lo) = fast_two_sum(q, residual / d.hi);
        let exact = d.lo == 0.0 && self.hi == ch && self.lo == cl;
        let own = if exact { 0.0 } else { 20.0 * U2 * q.abs() };
        DoubleDouble { hi, lo, err: own + (self.err + q.abs() * d.err) / (d.hi.abs() - d.err) }
    }

    /// The square root of a value that is not negative; nothing is known of it near 0.
    ///
    /// One Newton step on the rounded root: below 16 u^2 relative; the derivative is 1/(2 s), at most 1/(1.7 s) over an
    /// enclosure of a quarter's width.
    #[inline]
    pub fn sqrt(self) -> DoubleDouble {
        if self.hi == 0.0 && self.err == 0.0 {
            return self;
        }
        if !((1e-270..1e290).contains(&self.hi) && self.err < self.hi / 4.0) {
            return DoubleDouble::UNKNOWN;
        }
        let s = self.hi.sqrt();
        let (ph, pl) = two_product(s, s);
        let residual = (self.hi - ph) + (self.lo - pl);
        let (hi, lo) = fast_two_sum(s, residual / (2.0 * s));
        let exact = self.hi == ph && self.lo == pl;
        let own = if exact { 0.0 } else { 16.0 * U2 * s };
        DoubleDouble { hi, lo, err: own + self.err / (1.7 * s) }
    }

    #[inline]
    fn negated(self) -> DoubleDouble {
        DoubleDouble { hi: -self.hi, lo: -self.lo, err: self.err }
    }
}

impl Ring for DoubleDouble {
    #[inline]
    fn of(x: f64) -> DoubleDouble {
        DoubleDouble { hi: x, lo: 0.0, err: 0.0 }
    }
    #[inline]
    fn difference(a: f64, b: f64) -> DoubleDouble {
        let (hi, lo) = two_sum(a, -b);
        DoubleDouble { hi, lo, err: 0.0 }
    }
    /// Sum of double-words (algorithm 6): relative error 3 u^2. Its only roundings are c and w, and their errors are seen.
    #[inline]
    fn plus(&self, other: &DoubleDouble) -> DoubleDouble {
        let (sh, sl) = two_sum(self.hi, other.hi);
        let (th, tl) = two_sum(self.lo, other.lo);
        let (c, c_error) = two_sum(sl, th);
        let (vh, vl) = fast_two_sum(sh, c);
        let (w, w_error) = two_sum(tl, vl);
        let (hi, lo) = fast_two_sum(vh, w);
        let own = if c_error == 0.0 && w_error == 0.0 { 0.0 } else { 4.0 * U2 * hi.abs() };
        DoubleDouble { hi, lo, err: self.err + other.err + own }
    }
    #[inline]
    fn minus(&self, other: &DoubleDouble) -> DoubleDouble {
        self.plus(&other.negated())
    }
    /// Product of double-words without the product of the low words (algorithm 10): relative error 5 u^2.
    #[inline]
    fn times(&self, other: &DoubleDouble) -> DoubleDouble {
        let (a, b) = (self, other);
        let (ch, cl) = two_product(a.hi, b.hi);
        let (hi, lo) = fast_two_sum(ch, cl + (a.hi * b.lo + a.lo * b.hi));
        let single = a.lo == 0.0 && b.lo == 0.0;
        let own = if single { 0.0 } else { 8.0 * U2 * hi.abs() };
        let certain = a.err == 0.0 && b.err == 0.0;
        let safe = certain && (hi.abs() > SAFE_PRODUCT || a.hi == 0.0 || b.hi == 0.0);
        let underflow = if safe { 0.0 } else { TINY };
        let inherited = a.hi.abs() * b.err + (b.hi.abs() + b.err) * a.err;
        DoubleDouble { hi, lo, err: inherited + own + underflow }
    }
    #[inline]
    fn doubled(&self) -> DoubleDouble {
        DoubleDouble { hi: 2.0 * self.hi, lo: 2.0 * self.lo, err: 2.0 * self.err }
    }
    /// Order statistics move by at most the largest error of the values they are taken of.
    #[inline]
    fn two_largest(v: [DoubleDouble; 3]) -> (DoubleDouble, DoubleDouble) {
        let above = |a: &DoubleDouble, b: &DoubleDouble| a.hi > b.hi || (a.hi == b.hi && a.lo > b.lo);
        let [mut a, mut b, mut c] = v;
        if above(&a, &b) {
            std::mem::swap(&mut a, &mut b);
        }
        if above(&b, &c) {
            std::mem::swap(&mut b, &mut c);
        }
        if above(&a, &b) {
            std::mem::swap(&mut a, &mut b);
        }
        // Zero for finite values, NaN otherwise: a value that overflowed must not be sorted away.
        let overflow = (a.hi + b.hi + c.hi) * 0.0;
        let err = a.err.max(b.err).max(c.err) + overflow;
        (DoubleDouble { err, ..b }, DoubleDouble { err, ..c })
    }
    #[inline]
    fn smaller(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
        let overflow = (a.hi + b.hi) * 0.0;
        let err = a.err.max(b.err) + overflow;
        if a.hi > b.hi || (a.hi == b.hi && a.lo > b.lo) { DoubleDouble { err, ..b } } else { DoubleDouble { err, ..a } }
    }
}
