//! The rows, each written once from its inequality.
//!
//! Effective parameters are those that the stored points give: d2 = 1 - |a - o|/r, and d1 or mu = 2 min(x, 1 - x), x the place
//! of the foot of p on s. `slack` is the sum of the deviations of the points of the row from their segments: a length
//! may exceed its bound by it. Where it is zero the rows are as printed, and those without irrational roots are squared
//! so that equality is decided.

use super::quantities::{Incidence, Measure};
use super::{Count, Kind, Spacing, Split, Violation, distance2, dot};
use crate::check::scalar::{Bounded, Enclosure, Scalar};
use crate::model::{Edge, Point2, Triangle, VertexId};
use std::fmt;

/// A row of the table of inequalities in `docs/gcdr.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Row {
    /// The record itself.
    Record,
    /// Input vertices: R >= lfs.
    I1,
    /// Type-A: distance to the parent, and density.
    A6,
    /// Type-B: distance to the parent, and density.
    B5,
    /// Type-C, parent on no incident segment: (2 - mu) R >= mu lfs.
    C3,
    /// Type-C: distance to the parent, and density.
    C4,
    /// Densities against the grading constants.
    F1,
    /// Edges and radii against the grading constants.
    F2,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Row::Record => "record",
            Row::I1 => "I1",
            Row::A6 => "A6",
            Row::B5 => "B5'",
            Row::C3 => "C3'",
            Row::C4 => "C4'",
            Row::F1 => "F1",
            Row::F2 => "F2",
        })
    }
}

/// A new vertex with what its rows are about.
pub(super) struct Scene {
    /// The vertex.
    pub id: usize,
    /// Its parent, if it has one.
    pub parent: Option<VertexId>,
    /// The bad triangle.
    pub t: Triangle,
    /// Its Type-A point, inserted or rejected.
    pub a: Point2,
}

/// The two sides of an inequality.
struct Sides<N> {
    left: N,
    right: N,
}

/// Whether equality is allowed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Relation {
    AtMost,
    Below,
}

/// Evaluates one inequality in doubles and, where those cannot tell, in rationals.
macro_rules! test {
    ($spacing:ident, $event:expr, $row:expr, $relation:ident, $text:expr, $found:expr, $method:ident($($argument:expr),*)) => {{
        let fast = $spacing.$method::<Bounded>($($argument),*);
        let holds = decide(&fast, Relation::$relation).or_else(|| {
            decide(&$spacing.$method::<Enclosure>($($argument),*), Relation::$relation)
        });
        $spacing.judge($event, $row, holds, $text, &fast, $found)
    }};
}

fn decide<N: Scalar>(sides: &Sides<N>, relation: Relation) -> Option<bool> {
    match relation {
        Relation::AtMost => sides.left.at_most(&sides.right),
        Relation::Below => sides.left.below(&sides.right),
    }
}

fn number<N: Scalar>(x: f64) -> N {
    N::of(x)
}

/// (bound + slack)^2, for a squared bound: exactly the square where the slack is zero.
fn widened<N: Scalar>(bound2: N, slack: N) -> N {
    bound2.clone() + slack.clone() * (N::of(2.0) * bound2.root() + slack)
}

impl Spacing {
    // Tests, in the order of the table.

    pub(super) fn row_i1(&mut self, id: usize) -> Result<(), Violation> {
        if self.vertices[id].nearest.is_none() {
            // it is alone in its triangulation: R is infinite, D is 0
            self.count(Row::I1).held += 1;
            return Ok(());
        }
        test!(self, None, Row::I1, AtMost, "lfs(p)^2 <= R^2", || format!("vertex {id}"), i1(id))
    }

    pub(super) fn rows_a(&mut self, scene: &Scene) -> Result<(), Violation> {
        let event = Some(self.events);
        self.note_d2(scene);
        let Some(parent) = scene.parent else {
            self.count(Row::A6).unclaimed += 1;
            return Ok(());
        };
        let found = self.effective_of(scene, parent);
        let text = "dist(p,p')^2 <= (2 - d2)^2 r^2";
        test!(self, event, Row::A6, AtMost, text, || found.clone(), a6_distance(scene, parent))?;
        let text = "D <= B1 + D'/C1";
        test!(self, event, Row::A6, AtMost, text, || found.clone(), a6_density(scene, parent))
    }

    pub(super) fn rows_b(&mut self, scene: &Scene) -> Result<(), Violation> {
        let event = Some(self.events);
        self.note_d2(scene);
        self.note_share(scene);
        let Some((parent, split)) = scene.parent.zip(self.vertices[scene.id].split) else {
            self.count(Row::B5).unclaimed += 1;
            return Ok(());
        };
        let found = self.effective_of(scene, parent);
        if self.strictly_in_diametral_disk(split, parent) {
            let text = "2 dist(p,p') < (2 - d1)|s|, squared";
            test!(self, event, Row::B5, Below, text, || found.clone(), non_external_distance(scene, split, parent))?;
            // Case (2) needs d2 >= 1/rho
            if self.d2::<Enclosure>(scene).squared().compare(&self.one_over_rho2()).is_none_or(|o| o.is_lt()) {
                self.count(Row::B5).unclaimed += 1;
                return Ok(());
            }
            let text = "D <= B2 + D'/C2, times R";
            test!(self, event, Row::B5, AtMost, text, || found.clone(), b5_density_non_external(scene, split, parent))
        } else {
            let text = "2 dist(p,p') <= (1 + sqrt((2 - d2)/d2) - d1)|s|, squared";
            test!(self, event, Row::B5, AtMost, text, || found.clone(), b5_distance_external(scene, split, parent))?;
            let text = "D <= B3 + D'/C3, times R";
            test!(self, event, Row::B5, AtMost, text, || found.clone(), b5_density_external(scene, split, parent))
        }
    }

    pub(super) fn rows_c(&mut self, scene: &Scene) -> Result<(), Violation> {
        let event = Some(self.events);
        self.note_d2(scene);
        self.note_share(scene);
        let Some((parent, split)) = scene.parent.zip(self.vertices[scene.id].split) else {
            self.count(Row::C4).unclaimed += 1;
            return Ok(());
        };
        let found = self.effective_of(scene, parent);
        let text = "2 dist(p,p') < (2 - mu)|s|, squared";
        test!(self, event, Row::C4, Below, text, || found.clone(), non_external_distance(scene, split, parent))?;
        match self.incidence(split, parent) {
            Incidence::NonIncident => {
                if self.vertices[scene.id].nearest == Some(parent) {
                    let text = "lfs(p) <= R (parent nearest), squared";
                    test!(
                        self,
                        event,
                        Row::C3,
                        AtMost,
                        text,
                        || found.clone(),
                        c3_parent_nearest(scene, split, parent)
                    )?;
                } else {
                    let text = "mu lfs(p) <= (2 - mu) R, squared";
                    test!(self, event, Row::C3, AtMost, text, || found.clone(), c3_end_nearest(scene, split, parent))?;
                }
                // D <= 1/C5 is the second of these, and follows from the first
                self.count(Row::C4).held += 1;
                Ok(())
            }
            Incidence::At { apex, ends } => {
                let text = "D <= B4 + D'/C4, times R";
                test!(
                    self,
                    event,
                    Row::C4,
                    AtMost,
                    text,
                    || found.clone(),
                    c4_density(scene, split, parent, apex, ends)
                )
            }
            Incidence::Unclaimed => {
                self.count(Row::C4).unclaimed += 1;
                Ok(())
            }
        }
    }

    pub(super) fn row_f1(&mut self, id: usize, bound: &Enclosure) -> Result<(), Violation> {
        let kind = self.vertices[id].kind;
        let text = match kind {
            Kind::Input => "D <= 1",
            Kind::A => "D <= D_A, squared",
            Kind::B => "D <= D_B, squared",
            Kind::C => "D <= D_C, squared",
        };
        let found = || format!("vertex {id}, bound {}", bound.display());
        test!(self, None, Row::F1, AtMost, text, found, f1(id, bound))
    }

    pub(super) fn rows_f2(
        &mut self,
        largest: &Enclosure,
        edges: impl IntoIterator<Item = Edge>,
    ) -> Result<(), Violation> {
        for [x, y] in edges {
            for [x, y] in [[x, y], [y, x]] {
                if x.index() >= self.vertices.len() || y.index() >= self.vertices.len() {
                    return Err(self.unreadable("an edge of unknown vertices"));
                }
                let text = "lfs(x) <= (1 + max D) |xy|, squared";
                let found = || format!("edge {} {}", x.0, y.0);
                test!(self, None, Row::F2, AtMost, text, found, f2_edge(x, y, largest))?;
            }
        }
        // a disk that meets two non-incident features has at least half the least distance of two such; that
        // distance is met at an input vertex v, where it is lfs(v)
        let inputs = self.vertices.iter().filter(|v| v.kind == Kind::Input);
        let least = inputs.map(|v| v.local.size2.high()).fold(f64::INFINITY, f64::min);
        for id in 0..self.vertices.len() {
            if self.vertices[id].nearest.is_some() && least.is_finite() {
                let found = || format!("vertex {id}");
                test!(
                    self,
                    None,
                    Row::F2,
                    AtMost,
                    "lfs_min <= max D R, squared",
                    found,
                    f2_radius(id, least, largest)
                )?;
            }
        }
        Ok(())
    }

    // Inequalities, left and right.

    fn i1<N: Measure>(&self, id: usize) -> Sides<N> {
        let vertex = &self.vertices[id];
        Sides { left: N::lfs2(&self.features, vertex), right: self.radius2(vertex) }
    }

    /// |pp'| <= |po| + r, squared once: the root is of |po|^2 r^2 and equality is decided.
    fn a6_distance<N: Measure>(&self, scene: &Scene, parent: VertexId) -> Sides<N> {
        let (from_center2, r2) = self.circle::<N>(scene);
        let left = distance2(self.vertices[scene.id].p, self.vertices[parent.index()].p);
        Sides { left, right: from_center2.clone() + r2.clone() + number::<N>(2.0) * (from_center2 * r2).root() }
    }

    fn a6_density<N: Measure>(&self, scene: &Scene, parent: VertexId) -> Sides<N> {
        let d2 = self.d2::<N>(scene);
        let c1 = self.rho::<N>() * d2.clone();
        let right = (number::<N>(2.0) - d2.clone()) / d2 + self.density_of::<N>(parent.index()) / c1;
        Sides { left: self.density_of(scene.id), right }
    }

    /// Type-B with non-external parent and Type-C: 2|pp'| < (2 - d)|s| + 2 slack.
    fn non_external_distance<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId) -> Sides<N> {
        let left = number::<N>(4.0) * distance2(self.vertices[scene.id].p, self.vertices[parent.index()].p);
        let bound2 = (number::<N>(2.0) - self.share(scene.id, split)).squared() * self.length2(split);
        Sides { left, right: widened(bound2, number::<N>(2.0) * self.slack(scene.id, split, parent)) }
    }

    fn b5_distance_external<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId) -> Sides<N> {
        let pp2: N = distance2(self.vertices[scene.id].p, self.vertices[parent.index()].p);
        let d2 = self.d2::<N>(scene);
        let outward = ((number::<N>(2.0) - d2.clone()) / d2).root();
        let factor = number::<N>(1.0) + outward - self.share(scene.id, split);
        let slack = number::<N>(2.0) * self.slack(scene.id, split, parent);
        Sides { left: number::<N>(4.0) * pp2, right: widened(factor.squared() * self.length2(split), slack) }
    }

    fn b5_density_non_external<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId) -> Sides<N> {
        let d1: N = self.share(scene.id, split);
        let b2 = (number::<N>(2.0) - d1.clone()) / d1.clone();
        let cos2_theta = number::<N>(1.0) - number::<N>(0.25) * self.one_over_rho2();
        self.recurrence(scene, split, parent, b2, d1 * cos2_theta.root())
    }

    fn b5_density_external<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId) -> Sides<N> {
        let (d1, d2): (N, N) = (self.share(scene.id, split), self.d2(scene));
        let toward = number::<N>(2.0) - d2.clone();
        let b3 = (number::<N>(1.0) + (toward.clone() / d2.clone()).root() - d1.clone()) / d1.clone();
        let c3 = self.rho::<N>() * d1 * (d2 * toward).root();
        self.recurrence(scene, split, parent, b3, c3)
    }

    fn c3_parent_nearest<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId) -> Sides<N> {
        let vertex = &self.vertices[scene.id];
        let right = widened(self.radius2(vertex), self.slack(scene.id, split, parent));
        Sides { left: N::lfs2(&self.features, vertex), right }
    }

    /// mu lfs <= (2 - mu)(R + slack) + slack.
    fn c3_end_nearest<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId) -> Sides<N> {
        let vertex = &self.vertices[scene.id];
        let mu: N = self.share(scene.id, split);
        let left = mu.clone().squared() * N::lfs2(&self.features, vertex);
        let bound2 = (number::<N>(2.0) - mu.clone()).squared() * self.radius2(vertex);
        let slack = (number::<N>(3.0) - mu) * self.slack(scene.id, split, parent);
        Sides { left, right: widened(bound2, slack) }
    }

    fn c4_density<N: Measure>(
        &self,
        scene: &Scene,
        split: Split,
        parent: VertexId,
        apex: VertexId,
        [v, w]: [VertexId; 2],
    ) -> Sides<N> {
        let mu: N = self.share(scene.id, split);
        let [apex, v, w] = [apex, v, w].map(|x| self.features.point(x));
        let cos: N = dot::<N>([apex, v], [apex, w]) / (distance2::<N>(apex, v) * distance2(apex, w)).root();
        let b4 = (number::<N>(2.0) - mu.clone()) / mu.clone();
        self.recurrence(scene, split, parent, b4, mu / (number::<N>(2.0) * cos))
    }

    /// D <= B + D'/C times R: lfs(p) <= (R + slack)(B + D'/C) + slack (1 + D').
    fn recurrence<N: Measure>(&self, scene: &Scene, split: Split, parent: VertexId, b: N, c: N) -> Sides<N> {
        let vertex = &self.vertices[scene.id];
        let slack: N = self.slack(scene.id, split, parent);
        let theirs: N = self.density_of(parent.index());
        let radius = self.radius2::<N>(vertex).root() + slack.clone();
        let right = radius * (b + theirs.clone() / c) + slack * (number::<N>(1.0) + theirs);
        Sides { left: N::lfs2(&self.features, vertex).root(), right }
    }

    /// lfs <= D_X (R + slack) + slack (1 + D_X).
    fn f1<N: Measure>(&self, id: usize, bound: &Enclosure) -> Sides<N> {
        let vertex = &self.vertices[id];
        let d = N::bound(bound);
        let slack = self.own_slack::<N>(id) * (number::<N>(1.0) + number::<N>(2.0) * d.clone());
        let right = widened(d.squared() * self.radius2(vertex), slack);
        Sides { left: N::lfs2(&self.features, vertex), right }
    }

    fn f2_edge<N: Measure>(&self, x: VertexId, y: VertexId, largest: &Enclosure) -> Sides<N> {
        let (p, q) = (&self.vertices[x.index()], &self.vertices[y.index()]);
        let d = N::bound(largest);
        let slack = (self.own_slack::<N>(x.index()) + self.own_slack(y.index()))
            * (number::<N>(1.0) + number::<N>(2.0) * d.clone());
        let bound2 = (number::<N>(1.0) + d).squared() * distance2(p.p, q.p);
        Sides { left: N::lfs2(&self.features, p), right: widened(bound2, slack) }
    }

    fn f2_radius<N: Measure>(&self, id: usize, least2: f64, largest: &Enclosure) -> Sides<N> {
        let right = N::bound(largest).squared() * self.radius2(&self.vertices[id]);
        Sides { left: number::<N>(0.25) * number(least2), right }
    }

    // Bookkeeping.

    fn note_d2(&mut self, scene: &Scene) {
        let d2 = self.d2::<Bounded>(scene);
        let low = if d2.is_known() { d2.low() } else { self.d2::<Enclosure>(scene).rounded().low() };
        self.least.d2 = self.least.d2.min(low);
    }

    fn note_share(&mut self, scene: &Scene) {
        let vertex = &self.vertices[scene.id];
        let Some(split) = vertex.split else { return };
        let low = self.share::<Bounded>(scene.id, split).low();
        let least = if vertex.kind == Kind::B { &mut self.least.d1 } else { &mut self.least.mu };
        *least = least.min(low);
    }

    fn effective_of(&self, scene: &Scene, parent: VertexId) -> String {
        let d2 = self.d2::<Bounded>(scene).display();
        let vertex = &self.vertices[scene.id];
        let share = vertex.split.map(|split| self.share::<Bounded>(scene.id, split).display());
        match (vertex.kind, share) {
            (Kind::B, Some(d1)) => format!("parent {}, d2 = {d2}, d1 = {d1}", parent.0),
            (Kind::C, Some(mu)) => format!("parent {}, mu = {mu}", parent.0),
            _ => format!("parent {}, d2 = {d2}", parent.0),
        }
    }

    fn judge(
        &mut self,
        event: Option<u64>,
        row: Row,
        holds: Option<bool>,
        text: &str,
        sides: &Sides<Bounded>,
        found: impl Fn() -> String,
    ) -> Result<(), Violation> {
        let Count { held, undecided, .. } = self.count(row);
        match holds {
            Some(true) => *held += 1,
            None => *undecided += 1,
            Some(false) => {
                let found = format!("{} against {}; {}", sides.left.display(), sides.right.display(), found());
                return Err(Violation { event, row, expected: text.to_owned(), found });
            }
        }
        Ok(())
    }
}
