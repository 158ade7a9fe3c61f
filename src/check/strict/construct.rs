//! Constructed coordinates: the exact value of each formula, and whether a stored f64 is its correctly rounded value.
//!
//! A value is P + Q sqrt(D) with rational P, Q, D. It is never rounded in steps: to compare it with a rational m, the sign of (P - m) + Q sqrt(D)
//! follows from the signs of both terms and, where they differ, from their squares. x is the rounded value iff it lies between the middles of x and its neighbors.

use crate::check::predicates::{Corners, center, norm2, vector};
use crate::check::scale::power_of_two;
use crate::check::value::{Exact, Number, exact_sign};
use crate::model::{Point2, Sign};

/// P + Q sqrt(D).
#[derive(Clone, Debug)]
pub struct Value {
    p: Exact,
    q: Exact,
    d: Exact,
}

/// A point by its exact coordinates.
pub type Place = [Value; 2];

fn rational(p: Exact) -> Value {
    Value { p, q: Exact::of(0.0), d: Exact::of(0.0) }
}

impl Value {
    /// The sign of the value less m.
    fn compare(&self, m: f64, other: f64) -> Sign {
        // The middle of two neighbors is exact as a rational.
        let middle = (Exact::of(m) + Exact::of(other)) * Exact::of(0.5);
        let first = self.p.clone() - middle;
        let (a, b) = (exact_sign(&first), exact_sign(&self.q));
        let b = if exact_sign(&self.d) == Sign::Zero { Sign::Zero } else { b };
        if a == Sign::Zero || b == Sign::Zero || a == b {
            return if a == Sign::Zero { b } else { a };
        }
        // Opposite signs: the larger square wins.
        let gap = exact_sign(&(first.square() - self.q.square() * self.d.clone()));
        match gap {
            Sign::Positive => a,
            Sign::Zero => Sign::Zero,
            Sign::Negative => b,
        }
    }

    /// Whether x is the value rounded to nearest, ties to even, and then to 0 below 2^-142; x is in range.
    pub fn rounds_to(&self, x: f64) -> bool {
        let smallest = power_of_two(-142);
        let (below, above, even) = if x == 0.0 {
            // A tie at the border belongs to 2^-142, whose last bit is 0.
            let inner = smallest.next_down();
            return self.compare(-inner, -smallest).is_positive() && self.compare(inner, smallest).is_negative();
        } else {
            (x.next_down(), x.next_up(), x.to_bits() & 1 == 0)
        };
        let (low, high) = (self.compare(below, x), self.compare(x, above));
        (low.is_positive() || (even && low == Sign::Zero)) && (high.is_negative() || (even && high == Sign::Zero))
    }

    /// The rounded value; `None` beyond 2^200.
    pub fn round(&self) -> Option<f64> {
        if self.rounds_to(0.0) {
            return Some(0.0);
        }
        let negative = self.compare(0.0, 0.0).is_negative();
        let place = |bits: u64| {
            if negative { -f64::from_bits(bits) } else { f64::from_bits(bits) }
        };
        // The bits of positive f64s are ordered as their values: bisection for the largest one whose lower middle is not beyond the value.
        let (mut low, mut high) = (power_of_two(-142).to_bits(), power_of_two(201).to_bits());
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            let beyond = self.compare(place(middle - 1), place(middle));
            let reached = if negative { !beyond.is_positive() } else { !beyond.is_negative() };
            if reached { low = middle } else { high = middle }
        }
        // A tie stops on either neighbor; the even one is right.
        [low, low - 1, low + 1]
            .map(place)
            .into_iter()
            .find(|&x| self.rounds_to(x))
            .filter(|x| x.abs() <= power_of_two(200))
    }
}

/// The point rounded; `None` if out of range.
pub fn round([x, y]: &Place) -> Option<Point2> {
    Some(Point2::new(x.round()?, y.round()?))
}

/// Whether p is the point rounded.
pub fn rounds_to([x, y]: &Place, p: Point2) -> bool {
    x.rounds_to(p.x) && y.rounds_to(p.y)
}

fn half() -> Exact {
    Exact::of(0.5)
}

fn each(f: impl Fn(usize) -> Exact) -> Place {
    [rational(f(0)), rational(f(1))]
}

/// (a + b)/2.
pub fn midpoint(a: Point2, b: Point2) -> Place {
    in_interval(a, b, 1.0, 0.0)
}

/// (a + b)/2 + x (1 - delta)/2 (b - a).
pub fn in_interval(a: Point2, b: Point2, delta: f64, x: f64) -> Place {
    let k = Exact::of(x) * (Exact::of(1.0) - Exact::of(delta));
    each(|i| half() * (Exact::of(a[i]) + Exact::of(b[i]) + k.clone() * (Exact::of(b[i]) - Exact::of(a[i]))))
}

/// The point at distance 2^k from a toward b.
pub fn at_distance(a: Point2, b: Point2, k: i32) -> Place {
    let d = vector::<Exact>(a, b);
    let d2 = norm2(&d);
    [0, 1].map(|i| Value { p: Exact::of(a[i]), q: Exact::scaled(1.0, k) * d[i].clone() / d2.clone(), d: d2.clone() })
}

/// o, exactly.
fn circumcenter_of(t: Corners) -> [Exact; 2] {
    let (c, d) = center::<Exact>(t);
    let two_d = d.clone() + d;
    let [x, y] = c;
    [Exact::of(t[0].x) + x / two_d.clone(), Exact::of(t[0].y) + y / two_d]
}

/// The circumcenter.
pub fn circumcenter(t: Corners) -> Place {
    circumcenter_of(t).map(rational)
}

/// o + (1 - d2)(x (w - o) + y rot90(w - o)), w = t[0].
pub fn in_disk(t: Corners, d2: f64, x: f64, y: f64) -> Place {
    let [ox, oy] = circumcenter_of(t);
    let k = Exact::of(1.0) - Exact::of(d2);
    let (vx, vy) = (Exact::of(t[0].x) - ox.clone(), Exact::of(t[0].y) - oy.clone());
    let (x, y) = (Exact::of(x), Exact::of(y));
    let px = ox + k.clone() * (x.clone() * vx.clone() - y.clone() * vy.clone());
    let py = oy + k * (x * vy + y * vx);
    [px, py].map(rational)
}

/// The off-center over the edge t[0] t[1]: m + min(kappa, tau) rot90(q - p), where o = m + tau rot90(q - p).
fn offcenter_of(t: Corners, kappa: f64) -> [Exact; 2] {
    let o = circumcenter_of(t);
    let m = |i: usize| half() * (Exact::of(t[0][i]) + Exact::of(t[1][i]));
    let [dx, dy] = vector::<Exact>(t[0], t[1]);
    let normal = [Exact::of(0.0) - dy, dx];
    let to_o = [o[0].clone() - m(0), o[1].clone() - m(1)];
    let along = crate::check::predicates::dot(&to_o, &normal);
    let kappa = Exact::of(kappa);
    if exact_sign(&(along - kappa.clone() * norm2(&normal))).is_positive() {
        let [nx, ny] = normal;
        [m(0) + kappa.clone() * nx, m(1) + kappa * ny]
    } else {
        o
    }
}

/// The off-center.
pub fn offcenter(t: Corners, kappa: f64) -> Place {
    offcenter_of(t, kappa).map(rational)
}

/// The off-center, or the point of the selection disk on segment mo nearest to it: o + (1 - d2) sqrt(r^2/|m-o|^2) (m - o).
pub fn clamped_offcenter(t: Corners, kappa: f64, d2: f64) -> Place {
    let a = offcenter_of(t, kappa);
    let o = circumcenter_of(t);
    let away = [a[0].clone() - o[0].clone(), a[1].clone() - o[1].clone()];
    let radius = [Exact::of(t[0].x) - o[0].clone(), Exact::of(t[0].y) - o[1].clone()];
    let k = Exact::of(1.0) - Exact::of(d2);
    let r2 = norm2(&radius);
    if !exact_sign(&(norm2(&away) - k.square() * r2.clone())).is_positive() {
        return a.map(rational);
    }
    // a is on segment mo and off o, so m - o has the direction of a - o and is not zero.
    let away2 = norm2(&away);
    let [ox, oy] = o;
    let [x, y] = away;
    let d = r2 / away2;
    [(ox, x), (oy, y)].map(|(p, q)| Value { p, q: k.clone() * q, d: d.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_to_nearest_even_and_flushes() {
        let of = |p: f64, q: f64, d: f64| Value { p: Exact::of(p), q: Exact::of(q), d: Exact::of(d) };
        assert_eq!(of(0.0, 1.0, 2.0).round(), Some(2f64.sqrt()));
        assert_eq!(of(0.0, -1.0, 2.0).round(), Some(-2f64.sqrt()));
        assert_eq!(of(0.1, 0.0, 0.0).round(), Some(0.1));
        assert_eq!(of(-3.0, 1.0, 9.0).round(), Some(0.0));
        assert_eq!(of(power_of_two(-143), 0.0, 0.0).round(), Some(0.0));
        assert_eq!(of(power_of_two(-142), 0.0, 0.0).round(), Some(power_of_two(-142)));
        assert_eq!(of(power_of_two(201), 0.0, 0.0).round(), None);
        // 1 + 2^-53 is a tie: to the even neighbor 1; 1 + 3 2^-53: to 1 + 2^-51.
        let tie = |n: f64| rational(Exact::of(1.0) + Exact::of(n) * Exact::of(power_of_two(-53)));
        assert_eq!(tie(1.0).round(), Some(1.0));
        assert_eq!(tie(3.0).round(), Some(1.0 + power_of_two(-51)));
        assert!(!tie(1.0).rounds_to(1.0f64.next_up()) && !tie(1.0).rounds_to(1.0f64.next_down()));
    }
}
