//! Edits of a set of weighted points of space: after each, two kernels, a fresh build and the definition agree.

use super::kernels::fitted;
use super::kernels3::fitted_weight;
use crate::arith::scale::{by_power_of_two, exponent_of};
use crate::arith::space::{Kernel3, WeightedCorners};
use crate::arith::{ExactKernel, FastKernel};
use crate::generators::{Draw, Edit, EditCase, SpaceFamily, WeightFamily, edits, weighted_points};
use crate::model::{Point3, PointState, Sign, VertexId, WeightedPoint, canonical_tetrahedron};
use crate::triangulation::regular3::{Change, Regular3};
use arbitrary::{Arbitrary, Result, Unstructured};

/// Up to so many points the definition is asked: its time grows with the fifth power.
const DEFINED: usize = 9;

/// Edits of a set that starts empty. Numbers are normalised.
#[derive(Clone, Debug, PartialEq)]
pub struct EditCase3(pub Vec<Edit>);

impl From<Vec<Edit>> for EditCase3 {
    /// Scales all numbers by a power of two so that coordinates are at most 1, and into the range of kernels.
    fn from(edits: Vec<Edit>) -> Self {
        let largest = edits.iter().fold(0.0, |m: f64, e| match e {
            Edit::Insert(p) => m.max(p.at.abs().max_element()),
            _ => m,
        });
        let e = if largest > 0.0 { exponent_of(largest) } else { 0 };
        let scaled = |w: f64| fitted_weight(by_power_of_two(w, -2 * e)) + 0.0;
        let at = |p: Point3| Point3::from_array(p.to_array().map(|x| fitted(by_power_of_two(x, -e)) + 0.0));
        let edit = |edit| match edit {
            Edit::Insert(p) => Edit::Insert(WeightedPoint { at: at(p.at), weight: scaled(p.weight) }),
            Edit::SetWeight(v, w) => Edit::SetWeight(v, scaled(w)),
            Edit::Remove(v) => Edit::Remove(v),
        };
        EditCase3(edits.into_iter().map(edit).collect())
    }
}

impl<'a> Arbitrary<'a> for EditCase3 {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Ok(EditCase::arbitrary(u)?.edits.into())
    }
}

impl EditCase3 {
    /// At most n points of a family, and about `extra` edits beyond their insertions; see `generators::edits`.
    pub fn of(places: SpaceFamily, weights: WeightFamily, n: usize, extra: usize, draw: &mut impl Draw) -> Self {
        let points = weighted_points(places, weights, n, draw);
        let drain = draw.coin();
        edits(&points, extra, drain, draw).into()
    }

    /// Carries the edits out on both kernels. After each: the validators, the reported change, a fresh build, and for few points the definition.
    pub fn run(&self) {
        let mut fast = Subject::<FastKernel>::default();
        let mut exact = Subject::<ExactKernel>::default();
        for &edit in &self.0 {
            fast.apply(edit);
            exact.apply(edit);
            if let Err(e) = fast.mesh.validate() {
                panic!("{e} after {edit:?} of {self:?}");
            }
            let image = Image::of(&fast.mesh);
            assert_eq!(image, Image::of(&exact.mesh), "the kernels differ after {edit:?} of {self:?}");
            let standing = fast.standing();
            let points: Vec<WeightedPoint> = standing.iter().map(|&v| fast.mesh.point(v)).collect();
            let built = Regular3::<FastKernel>::build(&points, 1);
            let (fresh, n) = (Image::of(&built), fast.mesh.point_count());
            assert_eq!(image, fresh.renamed(&standing, n), "a fresh build differs after {edit:?} of {self:?}");
            if points.len() <= DEFINED {
                assert_eq!(fresh, by_definition(&points), "the definition differs after {edit:?} of {self:?}");
            }
        }
    }
}

/// A triangulation under edits.
struct Subject<K: Kernel3> {
    mesh: Regular3<K>,
    change: Change,
}

impl<K: Kernel3> Default for Subject<K> {
    fn default() -> Self {
        Subject { mesh: Regular3::new(), change: Change::default() }
    }
}

impl<K: Kernel3> Subject<K> {
    fn apply(&mut self, edit: Edit) {
        let (before, cells) = (states(&self.mesh), cells(&self.mesh));
        match edit {
            Edit::Insert(p) => {
                self.mesh.insert(p, &mut self.change);
            }
            Edit::Remove(v) => self.mesh.remove(VertexId(v), &mut self.change),
            Edit::SetWeight(v, w) => self.mesh.set_weight(VertexId(v), w, &mut self.change),
        }
        let after = states(&self.mesh);
        let turned = |from: fn(PointState) -> bool, to: PointState| -> Vec<VertexId> {
            let all = 0..before.len();
            all.filter(|&v| from(before[v]) && after[v] == to).map(|v| VertexId(v as u32)).collect()
        };
        if let Edit::Insert(_) = edit {
            // Each cell that is no more was destroyed, and none twice; each that is new was created.
            let mut expected = cells;
            for c in &self.change.destroyed {
                match expected.binary_search(&canonical_tetrahedron(*c)) {
                    Ok(k) => expected.remove(k),
                    Err(_) => panic!("{c:?}, destroyed by {edit:?}, was no cell"),
                };
            }
            let created = self.change.created.iter().map(|&c| canonical_tetrahedron(self.mesh.vertices(c)));
            expected.extend(created);
            expected.sort_unstable();
            assert_eq!(expected, self::cells(&self.mesh), "cells after {edit:?}");
        } else {
            let now_vertices = turned(|s| s != PointState::Vertex, PointState::Vertex);
            assert_eq!(self.change.revived, now_vertices, "revived by {edit:?}");
            let now_hidden = turned(|s| s == PointState::Vertex, PointState::Hidden);
            assert_eq!(self.change.hidden, now_hidden, "hidden by {edit:?}");
        }
    }

    fn standing(&self) -> Vec<VertexId> {
        let all = (0..self.mesh.point_count() as u32).map(VertexId);
        all.filter(|&v| self.mesh.state(v) != PointState::Removed).collect()
    }
}

fn states<K: Kernel3>(mesh: &Regular3<K>) -> Vec<PointState> {
    (0..mesh.point_count() as u32).map(|v| mesh.state(VertexId(v))).collect()
}

/// The cells, ghosts included, sorted.
fn cells<K: Kernel3>(mesh: &Regular3<K>) -> Vec<[VertexId; 4]> {
    let mut all: Vec<_> = mesh.cells().map(|c| canonical_tetrahedron(mesh.vertices(c))).collect();
    all.sort_unstable();
    all
}

/// What is unique of a triangulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Per id.
    pub states: Vec<PointState>,
    /// Of the affine hull.
    pub dimension: Option<u8>,
    /// In canonical form.
    pub simplices: Vec<VertexId>,
}

impl Image {
    /// That of a triangulation.
    pub fn of<K: Kernel3>(mesh: &Regular3<K>) -> Image {
        Image { states: states(mesh), dimension: mesh.dimension(), simplices: mesh.simplices() }
    }

    /// The same of `n` points of which only the named ones stand. They keep their order, so that canonical tuples stay so.
    fn renamed(&self, standing: &[VertexId], n: usize) -> Image {
        let name = |v: VertexId| standing[v.index()];
        let mut states = vec![PointState::Removed; n];
        for (&v, &state) in standing.iter().zip(&self.states) {
            states[v.index()] = match state {
                PointState::Duplicate { of } => PointState::Duplicate { of: name(of) },
                state => state,
            };
        }
        Image { states, simplices: self.simplices.iter().map(|&v| name(v)).collect(), ..*self }
    }
}

/// The regular triangulation by its definition, on rationals: a simplex is a cell if no point is in conflict with it.
///
/// Where points span less than space, auxiliary points off their hull make tetrahedra of simplices; every cell has them all.
pub fn by_definition(points: &[WeightedPoint]) -> Image {
    let twin = |i: usize| (0..i).find(|&j| points[j] == points[i]);
    let covered = |i: usize| points.iter().any(|p| p.at == points[i].at && p.weight > points[i].weight);
    // At one place only the heaviest point can be a vertex.
    let candidates: Vec<usize> = (0..points.len()).filter(|&i| twin(i).is_none() && !covered(i)).collect();
    let mut all: Vec<WeightedPoint> = candidates.iter().map(|&i| points[i]).collect();
    let count = all.len();
    all.extend(auxiliary(&all));
    let mut simplices: Vec<Vec<VertexId>> = Vec::new();
    for t in quadruples(all.len()) {
        let Some((t, corners)) = oriented(t, &all) else { continue };
        let has_auxiliary = (count..all.len()).all(|k| t.contains(&k));
        let in_conflict = |q: usize| !t.contains(&q) && ExactKernel::in_conflict3(corners, all[q]);
        if has_auxiliary && !(0..count).any(in_conflict) {
            let ids: Vec<VertexId> =
                t.into_iter().filter(|&k| k < count).map(|k| VertexId(candidates[k] as u32)).collect();
            simplices.push(match ids[..] {
                [a, b, c, d] => canonical_tetrahedron([a, b, c, d]).to_vec(),
                _ => sorted(ids),
            });
        }
    }
    let simplices = sorted(simplices).concat();
    let state = |i: usize| match twin(i) {
        Some(j) => PointState::Duplicate { of: VertexId(j as u32) },
        None if simplices.contains(&VertexId(i as u32)) => PointState::Vertex,
        None => PointState::Hidden,
    };
    let dimension = (count > 0).then(|| 3 - (all.len() - count) as u8);
    Image { states: (0..points.len()).map(state).collect(), dimension, simplices }
}

fn sorted<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    list.sort_unstable();
    list
}

fn quadruples(n: usize) -> impl Iterator<Item = [usize; 4]> {
    (0..n).flat_map(move |d| (0..d).flat_map(move |c| (0..c).flat_map(move |b| (0..b).map(move |a| [a, b, c, d]))))
}

/// The quadruple in an order that makes it positive, with its corners; `None` if it is flat.
fn oriented(mut t: [usize; 4], all: &[WeightedPoint]) -> Option<([usize; 4], WeightedCorners)> {
    let [a, b, c, d] = t.map(|k| all[k].at);
    match ExactKernel::orient3d(a, b, c, d) {
        Sign::Zero => return None,
        Sign::Negative => t.swap(2, 3),
        Sign::Positive => {}
    }
    Some((t, t.map(|k| all[k])))
}

fn spans_space(all: &[WeightedPoint]) -> bool {
    quadruples(all.len()).any(|t| oriented(t, all).is_some())
}

/// As few points as make the others span space: one for each dimension that these lack. (One that lies in their hull, where it adds nothing, is found sooner
/// or later: (3.1, 0.3, 0.2) is on the plane y + z = 1/2, rounded as it is.)
fn auxiliary(points: &[WeightedPoint]) -> Vec<WeightedPoint> {
    let places = [[3.1, 0.3, 0.2], [-0.7, 5.3, 0.4], [0.6, -0.9, 7.7], [-2.3, -1.7, -4.9]];
    let chosen = |set: u32| (0..4).filter(move |k| set >> k & 1 == 1).map(move |k| places[k as usize]);
    let mut sets: Vec<u32> = (0..16).collect();
    sets.sort_by_key(|set| set.count_ones());
    let added = |set| chosen(set).map(|p| WeightedPoint::unweighted(Point3::from_array(p))).collect::<Vec<_>>();
    let suffices = |set: &u32| points.is_empty() || spans_space(&[points, &added(*set)[..]].concat());
    sets.into_iter().find(suffices).map(added).unwrap_or_default()
}
