//! An insertion's surroundings as the new vertex p sees them: fast tests with one error bound for all.
//!
//! All new tetrahedra share p. With u, v, w the rows of the corners of a facet (u, v, w, p positive), D = det(u, v, w) < 0 and
//! C = L(u) (v x w) + L(v) (w x u) + L(w) (u x v), a point x is nearer than the orthoball of the tetrahedron iff D L(x) - C.x > 0: `predicates`, with p as base.
//!
//! The bound: a value has 24 monomials, each a product of a coordinate along each axis and a lift, so that none exceeds X Y Z S, where X, Y, Z bound the coordinates of
//! the rows and S the parts of their lifts. Roundings are as many as in `predicates`.
//!
//! On grids values are exact, ties included. Let coordinates be multiples of g, a power of two, and weights of g^2; let rows be below 2^9 g and lifts with their parts below
//! 2^20 g^2. Then all numbers on the way are multiples of g, g^2, ... g^5, and no sum exceeds 24 2^47 g^5 < 2^53 g^5.

use super::predicates::certain;
use crate::check::scale::power_of_two;
use crate::model::{Sign, WeightedPoint};

/// x, y, z and lift of a point seen from p, or bounds of those.
type Row = [f64; 4];

/// An orthoball: -C and D.
pub type Sphere = [f64; 4];

/// Points seen from p.
#[derive(Clone, Debug, Default)]
pub struct View {
    from: WeightedPoint,
    rows: Vec<Row>,
    /// Bounds of the rows.
    reach: Row,
    /// 6 Y Z S, 6 Z X S, 6 X Y S, 6 X Y Z.
    factors: Row,
    /// 24 X Y Z S.
    size: f64,
    /// Rows below make exact values.
    exact_below: Row,
}

impl View {
    /// A view from p, of nothing yet. All points are multiples of 2^`grain` (weights of its square).
    pub fn begin(&mut self, p: WeightedPoint, grain: i32) {
        self.from = p;
        self.rows.clear();
        self.reach = [0.0; 4];
        let g = power_of_two(grain);
        self.exact_below = [512.0 * g, 512.0 * g, 512.0 * g, 1_048_576.0 * g * g];
    }

    /// Adds a point. Those added are named by their positions.
    #[inline]
    pub fn add(&mut self, q: WeightedPoint) {
        let (row, reach) = self.see(q);
        self.rows.push(row);
        self.reach = [0, 1, 2, 3].map(|k: usize| if reach[k] > self.reach[k] { reach[k] } else { self.reach[k] });
    }

    /// Adds the infinite vertex, which nothing is asked about.
    pub fn add_nowhere(&mut self) {
        self.rows.push([0.0; 4]);
    }

    /// Bounds what was added.
    pub fn close(&mut self) {
        let [x, y, z, s] = self.reach;
        self.factors = [6.0 * (y * z) * s, 6.0 * (z * x) * s, 6.0 * (x * y) * s, 6.0 * (x * y) * z];
        self.size = 4.0 * self.factors[3] * s;
    }

    /// A point seen from p, and the magnitudes of that.
    #[inline]
    fn see(&self, q: WeightedPoint) -> (Row, Row) {
        let [x, y, z] = [q.at.x - self.from.at.x, q.at.y - self.from.at.y, q.at.z - self.from.at.z];
        let square = x * x + y * y + z * z;
        let weight = q.weight - self.from.weight;
        ([x, y, z, square - weight], [x.abs(), y.abs(), z.abs(), square + weight.abs()])
    }

    /// The orthoball of three of the points and p.
    #[inline]
    pub fn sphere(&self, corners: [u32; 3]) -> Sphere {
        let [u, v, w] = corners.map(|k| self.rows[k as usize]);
        let cross =
            |a: &Row, b: &Row| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let [vw, wu, uv] = [cross(&v, &w), cross(&w, &u), cross(&u, &v)];
        let c = [0, 1, 2].map(|k: usize| u[3] * vw[k] + v[3] * wu[k] + w[3] * uv[k]);
        [-c[0], -c[1], -c[2], u[0] * vw[0] + u[1] * vw[1] + u[2] * vw[2]]
    }

    /// Whether the tetrahedron of an orthoball is positively oriented, if that is certain.
    #[inline]
    pub fn orientation(&self, s: &Sphere) -> Option<Sign> {
        self.sign(-s[3], self.factors[3], [0.0; 4])
    }

    /// The side of a point added: positive strictly nearer than the orthoball; if that is certain.
    #[inline]
    pub fn side_of(&self, s: &Sphere, k: u32) -> Option<Sign> {
        self.sign(dot(s, &self.rows[k as usize]), self.size, [0.0; 4])
    }

    /// The same of any point.
    #[inline]
    pub fn side(&self, s: &Sphere, q: WeightedPoint) -> Option<Sign> {
        let (row, reach) = self.see(q);
        self.sign(dot(s, &row), dot(&self.factors, &reach), reach)
    }

    /// The sign of a value, whose monomials sum up to `size` at most, made from rows within the reach and another one.
    #[inline]
    fn sign(&self, value: f64, size: f64, other: Row) -> Option<Sign> {
        certain(value, size).or_else(|| {
            let exact = |k: usize| self.reach[k].max(other[k]) < self.exact_below[k];
            let all = exact(0) && exact(1) && exact(2) && exact(3);
            all.then_some(if value == 0.0 {
                Sign::Zero
            } else if value > 0.0 {
                Sign::Positive
            } else {
                Sign::Negative
            })
        })
    }
}

#[inline]
fn dot(a: &Row, b: &Row) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}

/// The largest e such that coordinates of p are multiples of 2^e, its weight of 2^2e; at most 200.
pub fn grain(p: WeightedPoint) -> i32 {
    let of = |x: f64| {
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i32 - 1075;
        if x == 0.0 { 400 } else { exponent + (bits | 1 << 52).trailing_zeros() as i32 }
    };
    let [x, y, z] = p.at.to_array().map(of);
    x.min(y).min(z).min(of(p.weight).div_euclid(2)).min(200)
}
