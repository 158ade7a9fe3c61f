//! What the rows speak of: radii, effective parameters, deviations, incidence.

use super::rows::Scene;
use super::{Features, Spacing, Split, Vertex, cos2, cross, distance2, distance2_to_segment, dot};
use crate::check::rational::Rational;
use crate::check::scalar::{Bounded, Enclosure, Scalar};
use crate::model::{Point2, VertexId};

/// A number type that can measure local feature size.
pub(super) trait Measure: Scalar {
    fn lfs2(features: &Features, vertex: &Vertex) -> Self;
    fn bound(of: &Enclosure) -> Self;
}

impl Measure for Bounded {
    fn lfs2(_: &Features, vertex: &Vertex) -> Self {
        vertex.local.size2
    }
    fn bound(of: &Enclosure) -> Self {
        of.rounded()
    }
}

impl Measure for Enclosure {
    fn lfs2(features: &Features, vertex: &Vertex) -> Self {
        features.local_exactly(vertex.p).map_or_else(Self::unknown, |f| features.distance2(f, vertex.p))
    }
    fn bound(of: &Enclosure) -> Self {
        of.clone()
    }
}

/// How the input segments of a Type-C point and its parent meet.
pub(super) enum Incidence {
    /// Not at all, or the parent is an input vertex off the segment.
    NonIncident,
    /// At an input vertex, under an angle from 60 to below 90 degrees to the other ends.
    At { apex: VertexId, ends: [VertexId; 2] },
    /// The row makes no claim: another angle, or the same segment.
    Unclaimed,
}

impl Spacing {
    pub(super) fn rho2<N: Scalar>(&self) -> N {
        self.parameters.as_ref().map_or_else(N::unknown, |p| N::of(p.rho2))
    }

    pub(super) fn rho<N: Scalar>(&self) -> N {
        self.rho2::<N>().root()
    }

    pub(super) fn one_over_rho2<N: Scalar>(&self) -> N {
        N::of(1.0) / self.rho2()
    }

    /// |a - o|^2 and r^2 of the bad triangle.
    pub(super) fn circle<N: Scalar>(&self, scene: &Scene) -> (N, N) {
        let [c, p, q] = scene.t.map(|v| self.vertices[v.index()].p);
        let from = |x: Point2| (N::of(x.x) - N::of(c.x), N::of(x.y) - N::of(c.y));
        let ((px, py), (qx, qy), (ax, ay)) = (from(p), from(q), from(scene.a));
        let (p2, q2): (N, N) = (distance2(c, p), distance2(c, q));
        let twice = N::of(2.0) * cross::<N>(c, p, q);
        let x = (qy * p2.clone() - py * q2.clone()) / twice.clone();
        let y = (px * q2 - qx * p2) / twice;
        let from_center2 = (ax - x.clone()).squared() + (ay - y.clone()).squared();
        (from_center2, x.squared() + y.squared())
    }

    /// d2 in effect: 1 - |a - o|/r.
    pub(super) fn d2<N: Scalar>(&self, scene: &Scene) -> N {
        let (from_center2, r2) = self.circle::<N>(scene);
        N::of(1.0) - (from_center2 / r2).root()
    }

    /// |s|^2.
    pub(super) fn length2<N: Scalar>(&self, split: Split) -> N {
        let [u, v] = self.ends(split);
        distance2(u, v)
    }

    pub(super) fn ends(&self, split: Split) -> [Point2; 2] {
        split.ends.map(|v| self.vertices[v.index()].p)
    }

    /// d1 or mu in effect: twice the lesser share of s on a side of the foot of p.
    pub(super) fn share<N: Scalar>(&self, id: usize, split: Split) -> N {
        let [u, v] = self.ends(split);
        let x = dot::<N>([u, self.vertices[id].p], [u, v]) / self.length2(split);
        N::of(2.0) * x.clone().min(N::of(1.0) - x)
    }

    /// D.
    pub(super) fn density_of<N: Measure>(&self, id: usize) -> N {
        let vertex = &self.vertices[id];
        if vertex.nearest.is_none() {
            return N::of(0.0);
        }
        (N::lfs2(&self.features, vertex) / self.radius2(vertex)).root()
    }

    /// Deviations of p, the parent and the ends of s.
    pub(super) fn slack<N: Scalar>(&self, id: usize, split: Split, parent: VertexId) -> N {
        let [u, v] = split.ends.map(|v| self.deviation::<N>(v.index()));
        self.deviation::<N>(id) + self.deviation(parent.index()) + u + v
    }

    /// Deviations of a vertex and the ends of the subsegment it split.
    pub(super) fn own_slack<N: Scalar>(&self, id: usize) -> N {
        match self.vertices[id].split {
            Some(split) => {
                let [u, v] = split.ends.map(|v| self.deviation::<N>(v.index()));
                self.deviation::<N>(id) + u + v
            }
            None => N::of(0.0),
        }
    }

    /// How far a segment vertex lies from the subsegment it split and from its input segment, the larger of both; 0 for others.
    pub(super) fn deviation<N: Scalar>(&self, id: usize) -> N {
        let vertex = &self.vertices[id];
        let Some(split) = vertex.split else {
            return N::of(0.0);
        };
        let [u, v] = self.ends(split);
        let [a, b] = self.features.ends(split.segment).map(|v| self.features.point(v));
        distance_to_segment::<N>(vertex.p, u, v).max(distance_to_segment(vertex.p, a, b))
    }

    pub(super) fn strictly_in_diametral_disk(&self, split: Split, w: VertexId) -> bool {
        fn product<N: Scalar>([u, v]: [Point2; 2], w: Point2) -> Option<bool> {
            dot::<N>([w, u], [w, v]).below(&N::of(0.0))
        }
        let (s, w) = (self.ends(split), self.vertices[w.index()].p);
        // the product is rational, so the second number type always tells
        product::<Bounded>(s, w).or_else(|| product::<Enclosure>(s, w)).unwrap_or(false)
    }

    /// How the input segments of a Type-C point and its parent meet.
    pub(super) fn incidence(&self, split: Split, parent: VertexId) -> Incidence {
        let mine = self.features.ends(split.segment);
        let Some(theirs) = self.vertices[parent.index()].split else {
            let is_end = mine.contains(&parent);
            return if is_end { Incidence::Unclaimed } else { Incidence::NonIncident };
        };
        if theirs.segment == split.segment {
            return Incidence::Unclaimed;
        }
        let theirs: [VertexId; 2] = self.features.ends(theirs.segment);
        let Some(i) = (0..2).find(|i| theirs.contains(&mine[*i])) else {
            return Incidence::NonIncident;
        };
        let (apex, v) = (mine[i], mine[1 - i]);
        let w = if theirs[0] == apex { theirs[1] } else { theirs[0] };
        let points = [apex, v, w].map(|x| self.features.point(x));
        // the case's proof asks for at least 60 degrees, and for less than 90
        match cos2(points[0], points[1], points[2]) {
            Some(cos2) if cos2 <= Rational::ratio(1, 4) => Incidence::At { apex, ends: [v, w] },
            _ => Incidence::Unclaimed,
        }
    }
}

fn magnitude<N: Scalar>(x: N) -> N {
    x.clone().max(N::of(0.0) - x)
}

/// Distance of p to the closed segment ab.
fn distance_to_segment<N: Scalar>(p: Point2, a: Point2, b: Point2) -> N {
    let along: N = dot([a, p], [a, b]);
    let length2: N = distance2(a, b);
    if along.below(&N::of(0.0)) == Some(false) && length2.below(&along) == Some(false) {
        magnitude(cross::<N>(a, b, p)) / length2.root()
    } else {
        distance2_to_segment::<N>(p, a, b).root()
    }
}
