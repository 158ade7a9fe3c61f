//! The power diagram, dual to the triangulation: its vertices and edges as exact objects, never rounded.
//!
//! The points of equal power to the corners of a cell are one, the cell's orthocenter; to those of a triangle they are a line, perpendicular
//! to it. Of that line, the part where no other point is nearer in power is the *dual edge* of the triangle: it joins the orthocenters of
//! the two cells on either side, and where the triangle is on the hull it runs to infinity. Without weights this is the Voronoi diagram.
//!
//! ```text
//!         b                       cells abc and bad, their orthocenters o and p: the dual edge of ab is op; that of ac, if it is on the
//!       / | \                     hull, is the ray from o to the left, along the normal that points out
//!    <- o-|--p
//!     a  \| /  c
//! ```
//!
//! An orthocenter is handed on as the corners that it belongs to: rounded, it would lie on the wrong side of planes. Questions about
//! it are the kernel's (`orthocenter_side`), and a rounded copy is for looking at.
//!
//! Source: Aurenhammer, "Power diagrams", 1987.

use super::store::{CellId, FACET, FIRST, Regular3};
use crate::arith::space::{ConstructionError, Kernel3, WeightedCorners};
use crate::model::{Point3, Sign};

/// The point of equal power to the corners of a cell, exactly: by its corners, positively oriented.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthocenter(pub WeightedCorners);

impl Orthocenter {
    /// The side of an oriented plane it lies on: positive where the three points turn counterclockwise.
    pub fn side<K: Kernel3>(&self, plane: [Point3; 3]) -> Sign {
        K::orthocenter_side(self.0, plane)
    }

    /// Its coordinates, each rounded once.
    pub fn rounded<K: Kernel3>(&self) -> Result<Point3, ConstructionError> {
        K::orthocenter(self.0)
    }
}

/// The points of equal power to the corners of a triangle that are no nearer to any other point. Facets are oriented: their normals point along
/// the edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DualEdge {
    /// Cells on either side of the facet. The ends coincide where the two cells have one orthosphere.
    Segment {
        /// The orthocenter of the cell asked about.
        from: Orthocenter,
        /// That of the cell beyond.
        to: Orthocenter,
    },
    /// The facet is on the hull: the edge leaves its cell's orthocenter along the facet's normal.
    Ray {
        /// The end.
        from: Orthocenter,
        /// The facet, counterclockwise seen from outside of the hull.
        facet: [Point3; 3],
    },
    /// All points lie in the plane of the facet: the line through a point along its normal.
    Line {
        /// A point of the line; one of its corners is an apex.
        through: Orthocenter,
        /// The facet.
        facet: [Point3; 3],
    },
}

impl DualEdge {
    /// On which side of an oriented plane its two ends lie. An end at infinity counts where the edge leads to; along the plane, where it is.
    pub fn sides<K: Kernel3>(&self, plane: [Point3; 3]) -> [Sign; 2] {
        let far = |near: Sign, facet: [Point3; 3]| match K::normal_side(facet, plane) {
            Sign::Zero => near,
            side => side,
        };
        match self {
            DualEdge::Segment { from, to } => [from, to].map(|o| o.side::<K>(plane)),
            DualEdge::Ray { from, facet } => {
                let near = from.side::<K>(plane);
                [near, far(near, *facet)]
            }
            DualEdge::Line { through, facet: [a, b, c] } => {
                let near = through.side::<K>(plane);
                [far(near, [*a, *c, *b]), far(near, [*a, *b, *c])]
            }
        }
    }
}

impl<K: Kernel3> Regular3<K> {
    /// The orthocenter of a cell; `None` of a ghost and of a cell with apexes, which is no cell of the points.
    pub fn orthocenter(&self, c: CellId) -> Option<Orthocenter> {
        let cell = &self.cells[c.0 as usize];
        cell.v.iter().all(|&v| v >= FIRST).then(|| Orthocenter(self.corners(cell)))
    }

    /// The dual edge of the facet opposite vertex i (0..4) of a cell; `None` if it has the infinite vertex or an apex. Seen from the other side, the
    /// edge of a facet on the hull is the same, a segment has its ends exchanged.
    pub fn dual_edge(&self, c: CellId, i: usize) -> Option<DualEdge> {
        let cell = &self.cells[c.0 as usize];
        let inner = FACET[i].map(|k| cell.v[k]);
        if inner.iter().any(|&v| v < FIRST) {
            return None;
        }
        let beyond = self.neighbor(c, i);
        let [a, b, d] = inner.map(|v| self.site(v).at);
        Some(match (self.orthocenter(c), self.orthocenter(beyond)) {
            (Some(from), Some(to)) => DualEdge::Segment { from, to },
            // Seen from its cell, a facet turns the other way than from outside.
            (Some(from), None) => DualEdge::Ray { from, facet: [a, d, b] },
            (None, Some(from)) => DualEdge::Ray { from, facet: [a, b, d] },
            // One of the two is a ghost, the other one is finite, with the apex of the plane.
            (None, None) if self.is_finite(c) => DualEdge::Line { through: self.corners_of(c), facet: [a, d, b] },
            (None, None) => DualEdge::Line { through: self.corners_of(beyond), facet: [a, b, d] },
        })
    }

    fn corners_of(&self, c: CellId) -> Orthocenter {
        Orthocenter(self.corners(&self.cells[c.0 as usize]))
    }
}

#[cfg(all(test, feature = "exact"))]
mod tests {
    use super::super::tests::{Draw, FAMILIES, family, weighted};
    use super::*;
    use crate::arith::{ExactKernel, FastKernel};
    use crate::model::WeightedPoint;
    use rug::Rational;

    type Q3 = [Rational; 3];

    fn exact(p: Point3) -> Q3 {
        p.to_array().map(|x| Rational::from_f64(x).expect("finite"))
    }
    fn minus(a: &Q3, b: &Q3) -> Q3 {
        std::array::from_fn(|k| Rational::from(&a[k] - &b[k]))
    }
    fn dot(a: &Q3, b: &Q3) -> Rational {
        (0..3).map(|k| Rational::from(&a[k] * &b[k])).sum()
    }
    fn cross(a: &Q3, b: &Q3) -> Q3 {
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            Rational::from(&a[i] * &b[j]) - Rational::from(&a[j] * &b[i])
        })
    }
    fn normal([a, b, c]: [Point3; 3]) -> Q3 {
        let [a, b, c] = [a, b, c].map(exact);
        cross(&minus(&b, &a), &minus(&c, &a))
    }
    fn power(x: &Q3, p: WeightedPoint) -> Rational {
        let d = minus(x, &exact(p.at));
        dot(&d, &d) - Rational::from_f64(p.weight).expect("finite")
    }
    fn sign(x: &Rational) -> Sign {
        match x.cmp0() {
            std::cmp::Ordering::Less => Sign::Negative,
            std::cmp::Ordering::Equal => Sign::Zero,
            std::cmp::Ordering::Greater => Sign::Positive,
        }
    }

    /// The orthocenter by elimination of 2 (p_k - p_0).x = |p_k|^2 - w_k - |p_0|^2 + w_0, k = 1..3.
    fn solved(Orthocenter(t): Orthocenter) -> Q3 {
        let zero = exact(Point3::ZERO);
        let mut rows: Vec<Vec<Rational>> = (1..4)
            .map(|k| {
                let mut row: Vec<_> = minus(&exact(t[k].at), &exact(t[0].at)).map(|x| x * 2u32).to_vec();
                row.push(power(&zero, t[k]) - power(&zero, t[0]));
                row
            })
            .collect();
        for k in 0..3 {
            let pivot = (k..3).find(|&i| rows[i][k].cmp0().is_ne()).expect("corners span space");
            rows.swap(k, pivot);
            for i in (0..3).filter(|&i| i != k) {
                let factor = Rational::from(&rows[i][k] / &rows[k][k]);
                let pivot = rows[k].clone();
                rows[i].iter_mut().zip(&pivot).for_each(|(x, y)| *x -= Rational::from(y * &factor));
            }
        }
        std::array::from_fn(|k| Rational::from(&rows[k][3] / &rows[k][k]))
    }

    /// Points of an edge: two, and the direction to infinity at either, if it leads there.
    fn described(edge: DualEdge) -> ([Q3; 2], [Option<Q3>; 2]) {
        match edge {
            DualEdge::Segment { from, to } => ([solved(from), solved(to)], [None, None]),
            DualEdge::Ray { from, facet } => ([solved(from), solved(from)], [None, Some(normal(facet))]),
            DualEdge::Line { through, facet } => {
                let up = normal(facet);
                ([solved(through), solved(through)], [Some(up.clone().map(|x| -x)), Some(up)])
            }
        }
    }

    fn assert_dual(t: &Regular3<FastKernel>, c: CellId, i: usize, planes: &[[Point3; 3]], kinds: &mut [usize; 3]) {
        let Some(edge) = t.dual_edge(c, i) else { return };
        kinds[match edge {
            DualEdge::Segment { .. } => 0,
            DualEdge::Ray { .. } => 1,
            DualEdge::Line { .. } => 2,
        }] += 1;
        let cell = t.vertices(c);
        let facet = FACET[i].map(|k| t.point(cell[k]));
        let (ends, directions) = described(edge);
        let others = || (0..t.point_count() as u32).map(|v| t.point(crate::model::VertexId(v)));
        for (end, direction) in ends.iter().zip(&directions) {
            // Equal power to the corners, and none nearer.
            let least = power(end, facet[0]);
            assert!(facet.iter().all(|&p| power(end, p) == least));
            assert!(others().all(|p| power(end, p) >= least));
            // Far out along u nothing gets nearer: the power of p less that of the facet falls by 2 s u.(p - a).
            if let Some(u) = direction {
                assert!(u.iter().any(|x| x.cmp0().is_ne()));
                assert!(others().all(|p| dot(u, &minus(&exact(p.at), &exact(facet[0].at))).cmp0().is_le()));
            }
        }
        for &plane in planes {
            let n = normal(plane);
            let side = |k: usize| {
                let near = sign(&dot(&n, &minus(&ends[k], &exact(plane[0]))));
                let far = directions[k].as_ref().map_or(Sign::Zero, |u| sign(&dot(&n, u)));
                if far == Sign::Zero { near } else { far }
            };
            let expected = [side(0), side(1)];
            assert_eq!(edge.sides::<FastKernel>(plane), expected, "{edge:?} and {plane:?}");
            assert_eq!(edge.sides::<ExactKernel>(plane), expected, "{edge:?} and {plane:?}");
        }
    }

    /// All edges of small sets, in any dimension, with ties and without, against rationals and the definition.
    #[test]
    fn dual_edges_are_what_the_definition_says() {
        let mut kinds = [0; 3];
        for kind in 0..FAMILIES {
            for weights in 0..3 {
                let mut draw = Draw(u64::from(kind * 10 + weights) + 3);
                let points = weighted(family(kind, 14, &mut draw), weights, &mut draw);
                let t = Regular3::<FastKernel>::build(&points, 1);
                // Planes through points, and through the place of an orthocenter, rounded: ties and near-ties.
                let mut at = |_: usize| points[draw.below(14) as usize].at;
                let mut planes: Vec<[Point3; 3]> = (0..4).map(|_| std::array::from_fn(&mut at)).collect();
                let center = t.cells().find_map(|c| t.orthocenter(c)?.rounded::<FastKernel>().ok());
                planes.extend(center.map(|o| [o, at(0), at(1)]));
                for c in t.cells() {
                    (0..4).for_each(|i| assert_dual(&t, c, i, &planes, &mut kinds));
                }
            }
        }
        assert!(kinds.iter().all(|&n| n > 20), "{kinds:?}");
    }
}
