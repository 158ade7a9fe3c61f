//! The triangulation against itself in other orders. `attack::EditCase3` has it against its definition.

use super::store::{FACET, INF, NONE, Regular3};
use super::*;
use crate::arith::FastKernel as K;
use crate::arith::space::Kernel3;
use crate::model::{Point3, PointState, VertexId, WeightedPoint, canonical_tetrahedron};

type T = Regular3<K>;

/// A generator of its own, so that a failing case is named by a seed.
pub(super) struct Draw(pub(super) u64);

impl Draw {
    pub(super) fn below(&mut self, n: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % u64::from(n)) as u32
    }
    pub(super) fn unit(&mut self) -> f64 {
        f64::from(self.below(1 << 30)) / f64::from(1 << 30)
    }
    pub(super) fn shuffle<E>(&mut self, list: &mut [E]) {
        for i in (1..list.len()).rev() {
            list.swap(i, self.below(i as u32 + 1) as usize);
        }
    }
    fn lattice(&mut self, n: u32) -> Point3 {
        Point3::new(f64::from(self.below(n)), f64::from(self.below(n)), f64::from(self.below(n))) / 8.0
    }
}

pub(super) const FAMILIES: u32 = 9;

/// n points of a family without weights, in no order; families with few places repeat them.
pub(super) fn family(kind: u32, n: usize, draw: &mut Draw) -> Vec<Point3> {
    let sphere = [[9, 0, 0], [8, 4, 1], [7, 4, 4], [6, 6, 3]];
    let point = |draw: &mut Draw| match kind {
        0 => Point3::new(draw.unit(), draw.unit(), draw.unit()),
        1 => draw.lattice(3),
        2 => {
            // The lattice points at distance 9 from the origin, and the origin.
            let p = if draw.below(12) == 0 { [0; 3] } else { sphere[draw.below(4) as usize] };
            let turn = draw.below(3) as usize;
            let sign = [(); 3].map(|()| 1.0 - 2.0 * f64::from(draw.below(2)));
            let at = |k: usize| f64::from(p[(k + turn) % 3]) * sign[k] / 16.0 + 0.0;
            Point3::new(at(0), at(1), at(2))
        }
        // A plane that no axis is in.
        3 => {
            let p = draw.lattice(4);
            Point3::new(p.x, p.y, (p.x + 2.0 * p.y) / 4.0)
        }
        4 => draw.lattice(4) * Point3::new(1.0, 1.0, 0.0),
        5 => Point3::splat(0.125) + f64::from(draw.below(9)) / 16.0 * Point3::new(1.0, -0.5, 0.75),
        6 => Point3::splat(0.5),
        7 => match draw.below(3) {
            0 => draw.lattice(5) * Point3::X,
            1 => draw.lattice(5) * Point3::new(1.0, 1.0, 0.0),
            _ => draw.lattice(5),
        },
        // A plane but for the last bits.
        _ => {
            let (x, y) = (draw.unit(), draw.unit());
            Point3::new(x, y, (x + y) / 3.0)
        }
    };
    (0..n).map(|_| point(draw)).collect()
}

/// Weights of a kind: none, a few different ones, anything.
pub(super) fn weighted(points: Vec<Point3>, kind: u32, draw: &mut Draw) -> Vec<WeightedPoint> {
    let mut weight = || match kind {
        0 => 0.0,
        1 => f64::from(draw.below(4)) / 64.0,
        _ => draw.unit() * 0.3 - 0.1,
    };
    points.into_iter().map(|at| WeightedPoint { at, weight: weight() }).collect()
}

/// The invariants of the module head, by a plain reading.
pub(super) fn assert_sound(t: &T) {
    let mut vertices = std::collections::BTreeSet::new();
    for (i, cell) in (0u32..).zip(&t.cells).filter(|(_, c)| !c.is_free()) {
        assert_eq!(t.marks[i as usize], 0);
        vertices.extend(cell.v);
        assert!(cell.v[..3].iter().all(|&v| v != INF));
        for (k, facet) in FACET.iter().enumerate() {
            let link = cell.n[k];
            let beyond = t.cells[(link >> 2) as usize];
            assert!(!beyond.is_free(), "{i}");
            let j = (link & 3) as usize;
            assert_eq!(beyond.n[j], 4 * i + k as u32, "links of {i} and {}", link >> 2);
            let shared = facet.map(|m| cell.v[m]);
            assert!(shared.iter().all(|v| beyond.v.contains(v)) && !shared.contains(&beyond.v[j]));
            let opposite = beyond.v[j];
            if opposite != INF && opposite != cell.v[k] {
                assert!(!t.in_conflict(cell, t.site(opposite)), "cell {i} and the vertex beyond its facet {k}");
            }
        }
        if !cell.is_ghost() {
            let [a, b, c, d] = t.corners(cell).map(|p| p.at);
            assert!(K::orient3d(a, b, c, d).is_positive(), "orientation of {i}");
        }
    }
    for place in 4..t.sites.len() {
        let hint = t.hints[place];
        match t.state(VertexId(t.ids[place])) {
            PointState::Vertex => assert!(t.cells[hint as usize].v.contains(&(place as u32))),
            PointState::Hidden => {
                let cell = &t.cells[hint as usize];
                let q = t.sites[place].0;
                assert!(!cell.is_ghost() && !t.in_conflict(cell, q));
                for facet in FACET {
                    let [a, b, c] = facet.map(|k| t.site(cell.v[k]).at);
                    assert!(!K::orient3d(a, b, c, q.at).is_negative());
                }
                assert!(t.lodgers.of_cell[&hint].contains(&(place as u32)));
            }
            PointState::Duplicate { of } => {
                assert!(of.0 < t.ids[place]);
                assert_eq!(t.point(of), t.sites[place].0);
                assert!(t.twins[&hint].contains(&(place as u32)));
            }
            PointState::Removed => assert_eq!(hint, NONE),
        }
        let is_vertex = t.state(VertexId(t.ids[place])) == PointState::Vertex;
        assert_eq!(vertices.contains(&(place as u32)), is_vertex);
        assert_eq!(t.places[t.ids[place] as usize], place as u32);
    }
}

fn inserted(points: &[WeightedPoint]) -> T {
    let mut t = T::new();
    let mut change = Change::default();
    for &p in points {
        t.insert(p, &mut change);
    }
    t
}

/// The control of the published rule: agreeing on it means agreeing on all grids.
#[test]
fn the_cube_is_cut_as_published() {
    let grid = (0..8).map(|i| Point3::new(f64::from(i >> 2), f64::from(i >> 1 & 1), f64::from(i & 1)));
    let points: Vec<_> = grid.map(WeightedPoint::unweighted).collect();
    let expected = [[0, 1, 2, 4], [1, 2, 3, 4], [1, 3, 4, 5], [2, 3, 4, 6], [3, 4, 5, 6], [3, 5, 6, 7]];
    let mut found: Vec<[u32; 4]> = Vec::new();
    for ids in T::build(&points, 1).simplices().chunks(4) {
        let mut ids = [ids[0].0, ids[1].0, ids[2].0, ids[3].0];
        ids.sort_unstable();
        found.push(ids);
    }
    assert_eq!(found, expected);
}

/// Sizes that the definition is too slow for: the invariants, and the same from any order.
#[test]
fn the_order_of_insertion_does_not_show() {
    for kind in 0..FAMILIES {
        for weights in 0..3 {
            let mut draw = Draw(u64::from(kind * 10 + weights));
            let points = family(kind, 400, &mut draw);
            let points = weighted(points, weights, &mut draw);
            let built = T::build(&points, 1);
            assert_sound(&built);
            let mut order: Vec<u32> = (0..points.len() as u32).collect();
            draw.shuffle(&mut order);
            let shuffled: Vec<_> = order.iter().map(|&i| points[i as usize]).collect();
            let other = inserted(&shuffled);
            assert_sound(&other);
            // Ids differ, and duplicates may be represented by others: compare by coordinates.
            let places = |t: &T| {
                let tuple = |ids: &[VertexId]| {
                    let mut places: Vec<_> = ids.iter().map(|&v| super::lodge::key(t.point(v))).collect();
                    places.sort_unstable();
                    places
                };
                let mut all: Vec<_> = t.simplices().chunks(t.to_triangulation().simplex_size()).map(tuple).collect();
                all.sort_unstable();
                all
            };
            assert_eq!(places(&built), places(&other), "family {kind}, weights {weights}");
        }
    }
}

/// One algorithm, two kernels, one answer.
#[cfg(feature = "exact")]
#[test]
fn kernels_build_the_same_triangulation() {
    for kind in 0..FAMILIES {
        for weights in 0..3 {
            let mut draw = Draw(u64::from(kind * 10 + weights) + 7);
            let points = family(kind, 50, &mut draw);
            let points = weighted(points, weights, &mut draw);
            let fast = T::build(&points, 1);
            let exact = Regular3::<crate::arith::ExactKernel>::build(&points, 1);
            assert_eq!(fast.to_triangulation(), exact.to_triangulation(), "family {kind}, weights {weights}");
        }
    }
}

/// A center with more neighbors than the table of the star has rows.
#[test]
fn a_vertex_may_have_any_number_of_neighbors() {
    let mut draw = Draw(1);
    let mut points: Vec<_> = (0..500)
        .map(|_| {
            let p = Point3::new(draw.unit() - 0.5, draw.unit() - 0.5, draw.unit() - 0.5);
            WeightedPoint::unweighted(p / p.length())
        })
        .collect();
    points.push(WeightedPoint::unweighted(Point3::ZERO));
    let t = inserted(&points);
    assert_sound(&t);
    assert_eq!(t.simplices(), T::build(&points, 1).simplices());
    let star = t.cells().filter(|&c| t.is_finite(c) && t.vertices(c).contains(&VertexId(500)));
    assert!(star.count() > 128);
}

/// What changes is what `Change` says.
#[test]
fn changes_tell_what_happened() {
    for kind in 0..FAMILIES {
        for weights in 0..3 {
            let mut draw = Draw(u64::from(kind * 10 + weights));
            let points = family(kind, 60, &mut draw);
            let points = weighted(points, weights, &mut draw);
            let mut t = T::new();
            let mut change = Change::default();
            let cells = |t: &T| -> Vec<[VertexId; 4]> {
                let mut all: Vec<_> = t.cells().map(|c| canonical_tetrahedron(t.vertices(c))).collect();
                all.sort_unstable();
                all
            };
            for &p in &points {
                let before = t.clone();
                let id = t.insert(p, &mut change);
                assert_eq!(id.index() + 1, t.point_count());
                let mut expected = cells(&before);
                for cell in &change.destroyed {
                    let at = expected.binary_search(&canonical_tetrahedron(*cell));
                    expected.remove(at.unwrap_or_else(|_| panic!("{cell:?} was no cell")));
                }
                expected.extend(change.created.iter().map(|&c| canonical_tetrahedron(t.vertices(c))));
                expected.sort_unstable();
                assert_eq!(cells(&t), expected);
                assert!(change.revived.is_empty());
                let state = |t: &T, v: u32| (v < t.point_count() as u32).then(|| t.state(VertexId(v)));
                let gone = (0..=id.0).filter(|&v| state(&t, v) == Some(PointState::Hidden));
                let gone: Vec<_> =
                    gone.filter(|&v| state(&before, v) != Some(PointState::Hidden)).map(VertexId).collect();
                assert_eq!(change.hidden, gone);
            }
        }
    }
}
