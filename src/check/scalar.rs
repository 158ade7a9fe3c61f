//! One formula, two number types: a value with a proven running error bound, and an interval of rationals.
//!
//! Problem: an inequality with square roots has to be decided, and most of the time doubles are enough.
//! Idea: formulas are generic over `Scalar`; a comparison answers `None` when the number type cannot tell. `decide` tries
//! `Bounded` first, then `Enclosure`, which is exact where no irrational root occurs and has 160 bits elsewhere. What
//! neither decides is reported as unchecked, never as passed.

use super::rational::Rational;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Sub};

/// A number that knows how well it is known.
pub trait Scalar: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// The exact value of a finite double.
    fn of(x: f64) -> Self;
    /// A number of which nothing is known.
    fn unknown() -> Self;
    /// The square root; of a negative number it is unknown, and of one that may be, the number is taken as not negative.
    fn root(self) -> Self;
    /// The order, if it is known.
    fn compare(&self, other: &Self) -> Option<Ordering>;
    /// The lesser of two: a lower and an upper bound of it are those of the bounds.
    fn min(self, other: Self) -> Self;
    /// The greater of two.
    fn max(self, other: Self) -> Self;
    /// A nearby double, for display.
    fn display(&self) -> f64;

    /// Whether self <= other, if it is known.
    fn at_most(&self, other: &Self) -> Option<bool> {
        self.compare(other).map(Ordering::is_le)
    }

    /// Whether self < other, if it is known.
    fn below(&self, other: &Self) -> Option<bool> {
        self.compare(other).map(Ordering::is_lt)
    }

    /// The square.
    #[must_use]
    fn squared(self) -> Self {
        self.clone() * self
    }
}

/// A double and a bound of its error: |true value - value| <= error (1 + 2^-20).
///
/// Unit roundoff u = 2^-53. Each operation adds its own rounding (u times the magnitude of the result, and an allowance for
/// underflow) to what its arguments hand on. Errors are themselves computed with rounding, which loses a relative u a step;
/// the factor 1 + 2^-20 at the comparison covers 2^30 steps. NaN and infinities fail every comparison, so they decide nothing.
///
/// An error of 0 means that the value is exact, and exactness is kept where it can be seen: on inputs with few digits equality is
/// then decided here. A sum of exact values has a double as its error (two-sum); a product of two values of at most 26
/// significant bits is exact, and a quotient or root is if multiplying it back gives the argument exactly.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    value: f64,
    error: f64,
}

/// Unit roundoff, doubled: covers the rounding of the error itself.
const U: f64 = f64::EPSILON;
/// Covers the rounding of 2^30 errors of relative size u each.
const SLACK: f64 = 1.0 + 1.0 / (1u64 << 20) as f64;
/// Allowance for underflow of one operation.
const TINY: f64 = 1e-300;
/// Range of products in which nothing under- or overflows.
const SAFE: std::ops::Range<f64> = 1e-280..1e280;
/// The low 27 bits: zero in a double of at most 26 significant bits.
const LONG: u64 = (1 << 27) - 1;

impl Bounded {
    fn rounded(value: f64, error: f64) -> Self {
        Bounded { value, error: error + U * value.abs() + TINY }
    }

    /// a b, if it is certain to be a double.
    fn exact_product(a: f64, b: f64) -> Option<f64> {
        let short = |x: f64| x.to_bits() & LONG == 0;
        let product = a * b;
        let exact = a == 0.0 || b == 0.0 || (short(a) && short(b) && SAFE.contains(&product.abs()));
        exact.then_some(product)
    }

    fn is_exact(self) -> bool {
        self.error == 0.0
    }

    /// A number not above the true value.
    pub fn low(&self) -> f64 {
        if self.is_exact() { self.value } else { (self.value - self.error * SLACK).next_down() }
    }

    /// A number not below the true value.
    pub fn high(&self) -> f64 {
        if self.is_exact() { self.value } else { (self.value + self.error * SLACK).next_up() }
    }

    /// Any value from low to high.
    pub fn between(low: f64, high: f64) -> Self {
        if low == high {
            return Self::of(low);
        }
        let value = low + (high - low) / 2.0;
        Self::rounded(value, (high - low) * (1.0 + 4.0 * U))
    }

    /// Whether there is an error bound at all.
    pub fn is_known(&self) -> bool {
        self.value.is_finite() && self.error.is_finite()
    }
}

impl Add for Bounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let value = self.value + other.value;
        if self.is_exact() && other.is_exact() {
            let part = value - self.value;
            let error = ((self.value - (value - part)) + (other.value - part)).abs();
            return Bounded { value, error };
        }
        Self::rounded(value, self.error + other.error)
    }
}

impl Sub for Bounded {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Bounded { value: -other.value, error: other.error }
    }
}

impl Mul for Bounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is_exact()
            && other.is_exact()
            && let Some(product) = Self::exact_product(self.value, other.value)
        {
            return Self::of(product);
        }
        let error = self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Self::rounded(self.value * other.value, error)
    }
}

impl Div for Bounded {
    type Output = Self;
    /// With q = a/b rounded: |a'/b' - q| <= (ea + |q| eb)/(|b| - eb), unknown unless eb < |b|/2.
    fn div(self, other: Self) -> Self {
        let q = self.value / other.value;
        if self.is_exact() && other.is_exact() && Self::exact_product(q, other.value) == Some(self.value) {
            return Self::of(q);
        }
        let room = other.value.abs() - other.error;
        let error =
            if other.error < 0.5 * other.value.abs() { (self.error + q.abs() * other.error) / room } else { f64::NAN };
        Self::rounded(q, 2.0 * error)
    }
}

impl Scalar for Bounded {
    fn of(x: f64) -> Self {
        Bounded { value: x, error: 0.0 }
    }

    fn unknown() -> Self {
        Bounded { value: f64::NAN, error: f64::NAN }
    }

    /// |sqrt(x') - sqrt(x)| <= e/sqrt(x). Where e is not small against x: anything from 0 to the root of the upper bound.
    fn root(self) -> Self {
        let high = self.high();
        let s = self.value.sqrt();
        if self.is_exact() && Self::exact_product(s, s) == Some(self.value) {
            return Self::of(s);
        }
        if self.error < 0.5 * self.value {
            Self::rounded(s, 2.0 * self.error / s)
        } else if high >= 0.0 {
            Self::between(0.0, high.sqrt().next_up())
        } else {
            Self::unknown()
        }
    }

    fn compare(&self, other: &Self) -> Option<Ordering> {
        if self.is_exact() && other.is_exact() {
            return self.value.partial_cmp(&other.value);
        }
        let gap = self.value - other.value;
        let error = (self.error + other.error + U * gap.abs()) * SLACK;
        if gap > error {
            Some(Ordering::Greater)
        } else if -gap > error {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    fn min(self, other: Self) -> Self {
        let value = if self.value < other.value { self.value } else { other.value };
        Bounded { value, error: larger_error(self, other) }
    }

    fn max(self, other: Self) -> Self {
        let value = if self.value < other.value { other.value } else { self.value };
        Bounded { value, error: larger_error(self, other) }
    }

    fn display(&self) -> f64 {
        self.value
    }
}

/// The larger of two errors, NaN if one is.
fn larger_error(a: Bounded, b: Bounded) -> f64 {
    if a.error < b.error {
        b.error
    } else if b.error <= a.error {
        a.error
    } else {
        f64::NAN
    }
}

/// Two rationals with the true value between them (closed).
#[derive(Clone, Debug)]
pub struct Enclosure {
    low: Rational,
    high: Rational,
    /// Cleared by a division by an interval that holds 0 and by the root of a negative number.
    known: bool,
}

impl Enclosure {
    /// An exact value.
    pub fn exact(x: Rational) -> Self {
        Enclosure { high: x.clone(), low: x, known: true }
    }

    /// The value, if it is known exactly.
    pub fn rational(&self) -> Option<&Rational> {
        (self.known && self.low == self.high).then_some(&self.low)
    }

    /// A number not above the true value.
    pub fn low(&self) -> &Rational {
        &self.low
    }

    /// The same as a double with an error bound.
    pub fn rounded(&self) -> Bounded {
        if self.known {
            // conversions are off by less than a unit in the last place
            Bounded::between(self.low.to_f64().next_down(), self.high.to_f64().next_up())
        } else {
            Bounded::unknown()
        }
    }

    fn nothing() -> Self {
        Enclosure { low: Rational::of(0.0), high: Rational::of(0.0), known: false }
    }

    fn span(corners: [Rational; 4], known: bool) -> Self {
        // an array of four has a least and a greatest element
        let low = corners.iter().min().unwrap().clone();
        let high = corners.iter().max().unwrap().clone();
        Enclosure { low, high, known }
    }
}

impl Add for Enclosure {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Enclosure { low: self.low + other.low, high: self.high + other.high, known: self.known && other.known }
    }
}

impl Sub for Enclosure {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Enclosure { low: self.low - other.high, high: self.high - other.low, known: self.known && other.known }
    }
}

impl Mul for Enclosure {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let known = self.known && other.known;
        if self.low == self.high && other.low == other.high {
            return Enclosure { known, ..Self::exact(self.low * other.low) };
        }
        let (a, b, c, d) = (&self.low, &self.high, &other.low, &other.high);
        Self::span([a * c, a * d, b * c, b * d], known)
    }
}

impl Div for Enclosure {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let known = self.known && other.known;
        if other.low.sign().is_le() && other.high.sign().is_ge() {
            return Self::nothing();
        }
        if self.low == self.high && other.low == other.high {
            return Enclosure { known, ..Self::exact(self.low / other.low) };
        }
        let (a, b, c, d) = (&self.low, &self.high, &other.low, &other.high);
        Self::span([a / c, a / d, b / c, b / d], known)
    }
}

impl Scalar for Enclosure {
    fn of(x: f64) -> Self {
        Self::exact(Rational::of(x))
    }

    fn unknown() -> Self {
        Self::nothing()
    }

    fn root(self) -> Self {
        let low = std::cmp::max(self.low, Rational::of(0.0));
        match (low.root(), self.high.root()) {
            (Some((low, _)), Some((_, high))) => Enclosure { low, high, known: self.known },
            _ => Self::nothing(),
        }
    }

    fn compare(&self, other: &Self) -> Option<Ordering> {
        if !(self.known && other.known) {
            None
        } else if self.high < other.low {
            Some(Ordering::Less)
        } else if self.low > other.high {
            Some(Ordering::Greater)
        } else if self.low == self.high && other.low == other.high {
            Some(Ordering::Equal)
        } else {
            None
        }
    }

    /// Also where intervals touch at one point, which `compare` cannot name.
    fn at_most(&self, other: &Self) -> Option<bool> {
        if self.known && other.known && self.high <= other.low {
            Some(true)
        } else {
            self.compare(other).map(Ordering::is_le)
        }
    }

    fn min(self, other: Self) -> Self {
        let known = self.known && other.known;
        Enclosure { low: std::cmp::min(self.low, other.low), high: std::cmp::min(self.high, other.high), known }
    }

    fn max(self, other: Self) -> Self {
        let known = self.known && other.known;
        Enclosure { low: std::cmp::max(self.low, other.low), high: std::cmp::max(self.high, other.high), known }
    }

    fn display(&self) -> f64 {
        if self.known { self.low.to_f64() } else { f64::NAN }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_exact_where_they_can_be() {
        let nine_quarters = Rational::ratio(9, 4);
        assert_eq!(nine_quarters.root(), Some((Rational::ratio(3, 2), Rational::ratio(3, 2))));
        let (low, high) = Rational::of(2.0).root().unwrap();
        assert!(low.squared() < Rational::of(2.0) && Rational::of(2.0) < high.squared());
        assert!((high - low) < Rational::of(2f64.powi(-155)));
        assert_eq!(Rational::of(-1.0).root(), None);
    }

    #[test]
    fn both_types_enclose_the_same_value() {
        // (sqrt(2) + 0.1)^2 / 3 - sqrt(0.7), step by step
        fn formula<N: Scalar>() -> N {
            (N::of(2.0).root() + N::of(0.1)).squared() / N::of(3.0) - N::of(0.7).root()
        }
        let fast = formula::<Bounded>();
        let slow = formula::<Enclosure>();
        assert!(Rational::of(fast.low()) <= slow.low && slow.high <= Rational::of(fast.high()));
        assert!(fast.high() - fast.low() < 1e-14);
    }

    #[test]
    fn equality_is_left_to_the_rationals() {
        let sum = |a: f64, b: f64| Bounded::of(a) + Bounded::of(b);
        assert_eq!(sum(0.1, 0.2).compare(&Bounded::of(0.1 + 0.2)), None);
        assert_eq!(sum(0.5, 0.5).at_most(&Bounded::of(1.0 + 1e-12)), Some(true));
        let exact = Enclosure::of(0.5) + Enclosure::of(0.5);
        assert_eq!(exact.compare(&Enclosure::of(1.0)), Some(Ordering::Equal));
        let root = Enclosure::of(2.0).root();
        assert_eq!(root.clone().squared().compare(&Enclosure::of(2.0)), None);
        assert_eq!(Enclosure::of(-2.0).root().compare(&root), None);
    }

    #[test]
    fn exact_values_stay_exact_and_no_others_are_taken_for_exact() {
        let of = Bounded::of;
        assert_eq!((of(0.5) + of(0.5)).compare(&of(1.0)), Some(Ordering::Equal));
        assert_eq!((of(3.0) * of(5.0) / of(3.0)).compare(&of(5.0)), Some(Ordering::Equal));
        assert_eq!(of(9.0 / 4.0).root().compare(&of(1.5)), Some(Ordering::Equal));
        // each result is rounded: its double is not the value
        let third = of(1.0) / of(3.0);
        let long = of(1.0 + f64::EPSILON);
        let tiny = of(1e-200) * of(1e-200);
        for (inexact, double) in
            [(third, 1.0 / 3.0), (of(2.0).root(), 2f64.sqrt()), (long * long, long.value * long.value), (tiny, 0.0)]
        {
            assert_eq!(inexact.compare(&of(double)), None, "{double}");
            assert!(inexact.low() < double && double < inexact.high());
        }
        // overflow and 0/0 are unknown
        for unknown in
            [of(1e200) * of(1e200), of(f64::MAX) + of(f64::MAX), of(0.0) / of(0.0), of(1.0) / of(0.0), of(-1.0).root()]
        {
            assert_eq!(unknown.compare(&of(1.0)), None, "{unknown:?}");
        }
    }

    #[test]
    fn bounds_hold_over_random_expressions() {
        // (a + b)(c - d)/e against rationals, from digits few and many
        let mut state = 12345u64;
        let mut draw = |bits: u32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let m = (state >> (64 - bits)) as f64 / 2f64.powi(bits as i32);
            m - 0.5
        };
        for i in 0..3000 {
            let bits = [4, 12, 26, 27, 53][i % 5];
            let x: [f64; 5] = std::array::from_fn(|_| draw(bits));
            if x[4] == 0.0 {
                continue;
            }
            fn formula<N: Scalar>([a, b, c, d, e]: [f64; 5]) -> N {
                let v = (N::of(a) + N::of(b)) * (N::of(c) - N::of(d)) / N::of(e);
                v.clone().squared().root() - v.max(N::of(0.0))
            }
            let (fast, slow) = (formula::<Bounded>(x), formula::<Enclosure>(x));
            assert!(Rational::of(fast.low()) <= slow.high && slow.low <= Rational::of(fast.high()), "{x:?}");
        }
    }
}
