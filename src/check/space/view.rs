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

use super::predicates::{certain, error};
use crate::check::scale::power_of_two;
use crate::model::{Sign, WeightedPoint};

/// x, y, z and lift of a point seen from p.
///
/// Aligned so that none is in two cache lines.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(32))]
struct Row([f64; 4]);

/// An orthoball: -C and D.
pub type Sphere = [f64; 4];

/// Points seen from p.
#[derive(Clone, Debug, Default)]
pub struct View {
    rows: Vec<Row>,
    /// 6 X Y Z and 24 X Y Z S.
    sizes: [f64; 2],
    /// Values below are certainly negative: an orientation's determinant, a side's value.
    negative_below: [f64; 2],
    /// Whether all values are exact.
    exact: bool,
}

impl View {
    /// Looks from p at some points, named by their positions; `None` is the infinite vertex, of which nothing is certain. All points are multiples of 2^`grain`,
    /// weights of its square.
    pub fn look(&mut self, p: WeightedPoint, points: impl Iterator<Item = Option<WeightedPoint>>, grain: i32) {
        self.rows.clear();
        // X, Y, Z, S.
        let mut reach = [0.0f64; 4];
        points.for_each(|q| {
            let Some(q) = q else { return self.rows.push(Row::default()) };
            let [x, y, z] = [q.at.x - p.at.x, q.at.y - p.at.y, q.at.z - p.at.z];
            let square = x * x + y * y + z * z;
            let weight = q.weight - p.weight;
            self.rows.push(Row([x, y, z, square - weight]));
            let row = [x.abs(), y.abs(), z.abs(), square + weight.abs()];
            reach = [0, 1, 2, 3].map(|k: usize| if row[k] > reach[k] { row[k] } else { reach[k] });
        });
        let [x, y, z, s] = reach;
        let volume = 6.0 * (x * y) * z;
        self.sizes = [volume, 4.0 * volume * s];
        self.negative_below = self.sizes.map(|size| -error(size));
        let g = power_of_two(grain);
        self.exact = x.max(y).max(z) < 512.0 * g && s < 1_048_576.0 * g * g;
    }

    /// The orthoball of three of the points and p.
    #[inline]
    pub fn sphere(&self, corners: [u32; 3]) -> Sphere {
        let [u, v, w] = corners.map(|k| self.rows[k as usize].0);
        let cross = |a: &[f64; 4], b: &[f64; 4]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let [vw, wu, uv] = [cross(&v, &w), cross(&w, &u), cross(&u, &v)];
        let c = [0, 1, 2].map(|k: usize| u[3] * vw[k] + v[3] * wu[k] + w[3] * uv[k]);
        [-c[0], -c[1], -c[2], u[0] * vw[0] + u[1] * vw[1] + u[2] * vw[2]]
    }

    /// Whether an orthoball's tetrahedron is certainly positive, and two points are certainly farther than the orthoball.
    #[inline]
    pub fn is_clear(&self, s: &Sphere, points: [u32; 2]) -> bool {
        let [determinant, value] = self.negative_below;
        s[3] < determinant && points.into_iter().all(|k| self.value(s, k) < value)
    }

    /// Whether the tetrahedron of an orthoball is positively oriented, if that is certain.
    pub fn orientation(&self, s: &Sphere) -> Option<Sign> {
        self.sign(-s[3], self.sizes[0])
    }

    /// The side of a point against the orthoball of three others and p: positive strictly nearer; if that is certain, with the bounds of all points or of these.
    pub fn side(&self, s: &Sphere, corners: [u32; 3], k: u32) -> Option<Sign> {
        let value = self.value(s, k);
        self.sign(value, self.sizes[1]).or_else(|| certain(value, self.size(corners, k)))
    }

    /// 24 X Y Z S of four points alone.
    fn size(&self, [u, v, w]: [u32; 3], q: u32) -> f64 {
        let rows = [u, v, w, q].map(|k| {
            let Row([x, y, z, lift]) = self.rows[k as usize];
            // The last is no less than the square and the weight that make the lift.
            [x.abs(), y.abs(), z.abs(), 2.0 * (x * x + y * y + z * z) + lift.abs()]
        });
        let [x, y, z, s] =
            [0, 1, 2, 3].map(|k: usize| rows.iter().fold(0.0, |most, row| if row[k] > most { row[k] } else { most }));
        24.0 * (x * y) * z * s
    }

    #[inline]
    fn value(&self, s: &Sphere, k: u32) -> f64 {
        let q = &self.rows[k as usize].0;
        // Two sums side by side.
        (s[0] * q[0] + s[2] * q[2]) + (s[1] * q[1] + s[3] * q[3])
    }

    /// The sign of a value whose monomials have magnitudes of sum `size` at most.
    #[inline]
    fn sign(&self, value: f64, size: f64) -> Option<Sign> {
        match value {
            0.0 if self.exact => Some(Sign::Zero),
            value if value > 0.0 && self.exact => Some(Sign::Positive),
            value if value < 0.0 && self.exact => Some(Sign::Negative),
            value => certain(value, size),
        }
    }
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
