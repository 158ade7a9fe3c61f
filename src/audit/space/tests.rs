//! Meshes that must pass and meshes that must not, each with the fault that it stands for.

use super::*;
use crate::check::space::predicates::{in_conflict, orient};
use crate::model::{Sign, WeightedPoint};
use std::collections::BTreeMap;

type Cells = Vec<[u32; 4]>;
type Places = Vec<[f64; 3]>;

fn run_all(p: &[[f64; 3]], weights: &[f64], cells: &[[u32; 4]], claims: &[Claim]) -> Report {
    let points: Vec<Point3> = p.iter().map(|&p| Point3::from_array(p)).collect();
    let cells: Vec<[VertexId; 4]> = cells.iter().map(|t| t.map(VertexId)).collect();
    let lines: Vec<u32> = (10..10 + cells.len() as u32).collect();
    let subject = Subject { points: &points, weights, cells: &cells, cell_lines: &lines, ..Subject::default() };
    audit(&subject, &Options { claims, ..Options::default() })
}

fn run(p: &[[f64; 3]], cells: &[[u32; 4]], claim: Claim) -> ClaimReport {
    run_all(p, &[], cells, &[claim]).claims.into_iter().next().expect("one claim was asked for")
}

/// Cubes of a grid, each cut into six cells around its diagonal: neighbors fit. Vertices of one cube each, if `apart`.
fn cubes(places: &[[i32; 3]]) -> (Places, Cells) {
    let mut ids: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let mut cells = Vec::new();
    for place in places {
        for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            let mut at = *place;
            let mut path = vec![at];
            for axis in order {
                at[axis] += 1;
                path.push(at);
            }
            let mut cell = [0; 4];
            for (k, at) in path.into_iter().enumerate() {
                let next = ids.len() as u32;
                cell[k] = *ids.entry(at).or_insert(next);
            }
            cells.push(cell);
        }
    }
    let mut p = vec![[0.0; 3]; ids.len()];
    for (at, id) in ids {
        p[id as usize] = at.map(f64::from);
    }
    (p, cells)
}

/// All cubes of a box but those that `leave` names.
fn block(n: [i32; 3], leave: &[[i32; 3]]) -> (Places, Cells) {
    let all = (0..n[0]).flat_map(|x| (0..n[1]).flat_map(move |y| (0..n[2]).map(move |z| [x, y, z])));
    cubes(&all.filter(|c| !leave.contains(c)).collect::<Vec<_>>())
}

/// Two meshes side by side, the second moved and scaled.
fn beside((p, t): (Places, Cells), (q, u): (Places, Cells), scale: f64, by: [f64; 3]) -> (Places, Cells) {
    let shift = p.len() as u32;
    let moved = q.iter().map(|x| [0, 1, 2].map(|k| x[k] * scale + by[k]));
    (p.iter().copied().chain(moved).collect(), t.into_iter().chain(u.iter().map(|c| c.map(|v| v + shift))).collect())
}

/// n cells around the edge 0-1, the last closing the circle, spread over so many turns.
fn fan(n: u32, turns: f64) -> (Places, Cells) {
    let mut p = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    for i in 0..n {
        let a = f64::from(i) / f64::from(n) * turns * std::f64::consts::TAU;
        // Radii differ so that no two vertices coincide.
        let r = 1.0 + 0.01 * f64::from(i);
        p.push([r * a.cos(), r * a.sin(), 0.0]);
    }
    (p, (0..n).map(|i| [0, 1, i + 2, (i + 1) % n + 2]).collect())
}

const CORNER: [[f64; 3]; 4] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];

fn corner_and(more: &[[f64; 3]]) -> Places {
    [&CORNER[..], more].concat()
}

fn valid_meshes() -> Vec<(&'static str, Places, Cells)> {
    let mut table: Vec<(&str, Places, Cells)> = vec![
        ("a cell", CORNER.to_vec(), vec![[0, 1, 2, 3]]),
        ("a negative cell", CORNER.to_vec(), vec![[0, 1, 3, 2]]),
        ("of mixed orientation", corner_and(&[[3.0; 3]]), vec![[0, 1, 3, 2], [4, 1, 2, 3]]),
        (
            "two cells at a vertex",
            corner_and(&[[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]),
            vec![[0, 1, 2, 3], [0, 4, 5, 6]],
        ),
        ("two cells at an edge", corner_and(&[[0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]), vec![[0, 1, 2, 3], [0, 1, 4, 5]]),
        ("an unused vertex inside", corner_and(&[[0.5; 3]]), vec![[0, 1, 2, 3]]),
    ];
    let mut add = |name, (p, t)| table.push((name, p, t));
    add("a fan", fan(7, 1.0));
    add("an open fan", {
        let (p, mut t) = fan(7, 1.0);
        t.truncate(5);
        (p, t)
    });
    add("a block", block([2, 3, 2], &[]));
    add("a block with a void", block([3, 3, 3], &[[1, 1, 1]]));
    add("a ring", block([3, 3, 1], &[[1, 1, 0]]));
    add("two cubes at an edge", cubes(&[[0, 0, 0], [1, 1, 0]]));
    add("four cubes at an edge, two voids between", cubes(&[[0, 0, 0], [1, 1, 0], [3, 0, 0], [3, 1, 0]]));
    add("two cubes at a vertex", cubes(&[[0, 0, 0], [1, 1, 1]]));
    add("a checkerboard", {
        let all = (0..27).map(|i| [i / 9, i / 3 % 3, i % 3]);
        cubes(&all.filter(|c| c.iter().sum::<i32>() % 2 == 0).collect::<Vec<_>>())
    });
    let island = beside(block([3, 3, 3], &[[1, 1, 1]]), cubes(&[[0, 0, 0]]), 0.5, [1.25; 3]);
    add("an island in a void", island.clone());
    add("a void in an island in a void", beside(island, block([3, 3, 3], &[[1, 1, 1]]), 1.0 / 8.0, [-3.0, 0.0, 0.0]));
    add("far apart", beside(cubes(&[[0, 0, 0]]), cubes(&[[0, 0, 0]]), 1.0, [9.0, 0.5, 0.25]));
    table
}

fn invalid_meshes() -> Vec<(&'static str, Places, Cells)> {
    let nan = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, f64::NAN, 0.0], [0.0, 0.0, 4.0]];
    let below = |p: &[[f64; 3]]| corner_and(p);
    let mut table: Vec<(&str, Places, Cells)> = vec![
        ("an index that does not exist", CORNER.to_vec(), vec![[0, 1, 2, 9]]),
        ("a repeated corner", CORNER.to_vec(), vec![[0, 1, 2, 2]]),
        ("a flat cell", corner_and(&[[1.0, 1.0, 0.0]]), vec![[0, 1, 2, 4]]),
        ("not a number", nan.to_vec(), vec![[0, 1, 2, 3]]),
        ("a cell twice", CORNER.to_vec(), vec![[0, 1, 2, 3], [0, 1, 2, 3]]),
        ("a cell twice, turned", CORNER.to_vec(), vec![[0, 1, 2, 3], [3, 1, 2, 0]]),
        (
            "three cells at a facet",
            below(&[[1.0, 1.0, -2.0], [1.0, 1.0, -3.0]]),
            vec![[0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]],
        ),
        ("two on the same side", corner_and(&[[1.0, 1.0, 5.0]]), vec![[0, 1, 2, 3], [0, 1, 2, 4]]),
        // The far facet of one is cut by the near one of the other.
        (
            "a vertex in a facet",
            below(&[[1.0, 1.0, 0.0], [1.0, 1.0, -2.0], [2.0, 1.0, -2.0], [1.0, 2.0, -2.0]]),
            vec![[0, 1, 2, 3], [4, 5, 6, 7]],
        ),
        (
            "a vertex in an edge",
            below(&[[2.0, 0.0, 0.0], [2.0, -1.0, -2.0], [3.0, -1.0, -2.0], [2.0, -2.0, -2.0]]),
            vec![[0, 1, 2, 3], [4, 5, 6, 7]],
        ),
        (
            "edges that cross",
            below(&[[2.0, 1.0, 0.0], [2.0, -1.0, 0.0], [2.0, 0.0, -2.0], [3.0, 0.0, -2.0]]),
            vec![[0, 1, 2, 3], [4, 5, 6, 7]],
        ),
        (
            "edges that overlap",
            below(&[[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, -1.0, -2.0], [2.0, -2.0, -1.0]]),
            vec![[0, 1, 2, 3], [4, 5, 6, 7]],
        ),
        (
            "an edge from a common vertex along an edge",
            below(&[[2.0, 0.0, 0.0], [2.0, -1.0, -2.0], [2.0, -2.0, -1.0]]),
            vec![[0, 1, 2, 3], [0, 4, 5, 6]],
        ),
        (
            "an edge from a common vertex in a facet",
            below(&[[1.0, 1.0, 0.0], [2.0, 1.0, -2.0], [1.0, 2.0, -1.0]]),
            vec![[0, 1, 2, 3], [0, 4, 5, 6]],
        ),
        (
            "facets at a common edge that overlap",
            below(&[[1.0, 1.0, 0.0], [1.0, 1.0, -2.0]]),
            vec![[0, 1, 2, 3], [0, 1, 4, 5]],
        ),
        (
            "facets that overlap",
            below(&[[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [1.0, 1.0, -2.0]]),
            vec![[0, 1, 2, 3], [4, 5, 6, 7]],
        ),
        (
            "a double vertex",
            below(&[[0.0; 3], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]),
            vec![[0, 1, 2, 3], [4, 5, 6, 7]],
        ),
    ];
    let mut add = |name, (p, t)| table.push((name, p, t));
    add("two turns around an edge", fan(13, 2.0));
    add("more than a turn around an edge", {
        let (p, mut t) = fan(13, 2.0);
        t.truncate(9);
        (p, t)
    });
    add("a double cover", beside(block([2, 2, 2], &[]), block([2, 2, 2], &[]), 1.0, [0.25, 0.125, 0.0]));
    add("an exact double cover", beside(block([2, 2, 2], &[]), block([2, 2, 2], &[]), 1.0, [0.0; 3]));
    add("a mesh inside another", beside(cubes(&[[0, 0, 0]]), cubes(&[[0, 0, 0]]), 0.25, [0.25; 3]));
    add("a void filled and more", beside(block([3, 3, 3], &[[1, 1, 1]]), cubes(&[[0, 0, 0]]), 1.25, [0.875; 3]));
    add("a crack", beside(cubes(&[[0, 0, 0]]), cubes(&[[0, 0, 0]]), 1.0, [1.0, 0.0, 0.0]));
    add("a crack of an edge", beside(cubes(&[[0, 0, 0]]), cubes(&[[0, 0, 0]]), 1.0, [1.0, 1.0, 0.0]));
    add("a block around a block", {
        let large = block([3, 3, 3], &[]);
        beside(large, block([1, 1, 1], &[]), 7.0, [-2.0; 3])
    });
    add("a block around a ring", beside(block([3, 3, 1], &[[1, 1, 0]]), cubes(&[[0, 0, 0]]), 9.0, [-2.5; 3]));
    add("halves of a cube cut differently", {
        // The neighbor is cut along the other diagonals of their common side.
        let (p, t) = cubes(&[[0, 0, 0]]);
        let mut at: Vec<[f64; 3]> = p.clone();
        let mut other = Vec::new();
        for cell in &t {
            other.push(cell.map(|v| {
                let q = [2.0 - p[v as usize][0], p[v as usize][1], 1.0 - p[v as usize][2]];
                at.iter().position(|x| *x == q).unwrap_or_else(|| {
                    at.push(q);
                    at.len() - 1
                }) as u32
            }));
        }
        (at, [t, other].concat())
    });
    // Cells around an edge that lap over cells that have only the edge in common with them.
    add("two fans that share their edge", {
        let (mut p, t) = fan(12, 1.0);
        p[2..].iter_mut().for_each(|x| *x = x.map(|c| c * 0.5));
        let q = p.len() as u32;
        p.extend([[3.0, 0.5, 0.0], [3.0, 2.0, 0.0], [0.5, 3.0, 0.0]]);
        (p, [&t[..1], &t[4..6], &[[0, 1, q, q + 1], [0, 1, q + 1, q + 2]]].concat())
    });
    table
}

#[test]
fn valid_meshes_pass() {
    for (name, p, t) in valid_meshes() {
        let report = run(&p, &t, Claim::Valid);
        assert_eq!(report.verdict, Verdict::Holds, "{name}: {} {:?}", report.message, report.witnesses);
        // At any scale, negated, and with permuted axes.
        for scale in [-1.0, 1e300, 1e-300, 1e-310] {
            let q: Places = p.iter().map(|x| [x[2] * scale, x[0] * scale, x[1] * scale]).collect();
            let verdict = run(&q, &t, Claim::Valid).verdict;
            // Subnormal coordinates are rounded, which only cubes survive.
            assert!(verdict == Verdict::Holds || scale == 1e-310, "{name} times {scale}");
        }
    }
}

#[test]
fn invalid_meshes_do_not() {
    for (name, p, t) in invalid_meshes() {
        let report = run(&p, &t, Claim::Valid);
        assert_eq!(report.verdict, Verdict::Violated, "{name} passed");
        let witness = report.witnesses.first().expect("a witness");
        assert!(!witness.cells.is_empty() && !witness.lines.is_empty(), "{name}: {witness:?}");
        // Neither the order of the cells nor the place of the mesh matters.
        let backwards: Cells = t.iter().rev().map(|&[a, b, c, d]| [b, a, d, c]).collect();
        let turned: Places = p.iter().map(|&[x, y, z]| [-y + 0.5, z, x]).collect();
        assert_eq!(run(&turned, &backwards, Claim::Valid).verdict, Verdict::Violated, "{name}, turned, passed");
        // What rests on it is not said to hold.
        for claim in [Claim::Delaunay, Claim::Regular, Claim::Canonical, Claim::Hull] {
            assert_ne!(run(&p, &t, claim).verdict, Verdict::Holds, "{name}: {claim:?}");
        }
    }
}

#[test]
fn faults_are_named() {
    let doubled = run(&CORNER, &[[0, 1, 2, 3], [3, 1, 2, 0]], Claim::Valid);
    assert_eq!((doubled.violations, &doubled.witnesses[0].cells[..]), (1, &[0, 1][..]));
    assert!(doubled.witnesses[0].message.contains("same corners"), "{:?}", doubled.witnesses[0]);
    assert_eq!(doubled.witnesses[0].lines, [10, 11]);
    let negative = run(&corner_and(&[[3.0; 3]]), &[[0, 1, 2, 3], [4, 1, 2, 3]], Claim::Orientation);
    assert_eq!((negative.violations, &negative.witnesses[0].cells[..]), (1, &[1][..]));
    assert_eq!(run(&CORNER, &[[0, 1, 3, 2]], Claim::Orientation).message, "every cell is negative");
    let many = run(&CORNER, &[], Claim::Valid);
    assert_eq!(many.verdict, Verdict::Unchecked);
}

#[test]
fn sizes_beyond_scaling_are_unchecked() {
    let p = corner_and(&[[1e-320, 3.0, 1e-320]]);
    let cells = [[0, 1, 2, 3]];
    assert_eq!(run(&p, &cells, Claim::Valid).verdict, Verdict::Holds, "subnormal but representable");
    let p: Places = p.iter().map(|x| [x[0], x[1] * 1e100, x[2]]).collect();
    for claim in [Claim::Valid, Claim::Delaunay, Claim::Hull] {
        assert_eq!(run(&p, &cells, claim).verdict, Verdict::Unchecked);
    }
    let report = run_all(&CORNER, &[1e250, 0.0, 0.0, 1e-200], &cells, &[Claim::Regular]);
    assert_eq!(report.claims[0].verdict, Verdict::Unchecked);
}

/// The regular triangulation by its definition: all positive cells in conflict with no point.
fn definition(p: &[[f64; 3]], weights: &[f64]) -> Cells {
    let site =
        |v: usize| WeightedPoint { at: Point3::from_array(p[v]), weight: weights.get(v).copied().unwrap_or(0.0) };
    let n = p.len();
    let mut cells = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
        for (k, l) in (j + 1..n).flat_map(|k| (k + 1..n).map(move |l| (k, l))) {
            let mut t = [i, j, k, l];
            match orient(site(i).at, site(j).at, site(k).at, site(l).at) {
                Sign::Zero => continue,
                Sign::Negative => t.swap(2, 3),
                Sign::Positive => {}
            }
            if !(0..n).any(|q| in_conflict(&t.map(site), &site(q))) {
                cells.push(t.map(|v| v as u32));
            }
        }
    }
    cells
}

fn draws(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Random points, on a coarse grid in every second case; no two at one place.
fn random(case: u64, n: usize) -> (Places, Vec<f64>) {
    let mut draw = draws(case);
    let mut p: Places = Vec::new();
    while p.len() < n {
        let x = [draw(), draw(), draw()].map(|x| if case.is_multiple_of(2) { x } else { (x * 3.0).floor() });
        if !p.contains(&x) {
            p.push(x);
        }
    }
    let weights = (0..n).map(|_| if case.is_multiple_of(2) { draw() * 0.3 } else { (draw() * 4.0).floor() }).collect();
    (p, weights)
}

const SPHERES: [Claim; 5] = [Claim::Valid, Claim::Orientation, Claim::Delaunay, Claim::Canonical, Claim::Hull];

#[test]
fn triangulations_by_definition_pass() {
    for case in 0..30 {
        let (p, weights) = random(case, 11);
        let cells = definition(&p, &[]);
        let report = run_all(&p, &[], &cells, &SPHERES);
        assert!(report.claims.iter().all(|c| c.verdict == Verdict::Holds), "{case}: {report}");
        let cells = definition(&p, &weights);
        let report = run_all(&p, &weights, &cells, &[Claim::Valid, Claim::Regular, Claim::Canonical, Claim::Hull]);
        assert!(report.claims.iter().all(|c| c.verdict == Verdict::Holds), "{case}, weighted: {report}");
    }
}

/// The verdicts of a mutated mesh, and whether each violated claim shows where.
fn verdicts(p: &[[f64; 3]], cells: &[[u32; 4]]) -> Vec<Verdict> {
    let report = run_all(p, &[], cells, &SPHERES);
    for claim in report.claims.iter().filter(|c| c.verdict == Verdict::Violated) {
        let w = claim.witnesses.first().expect("a witness");
        assert!(!w.message.is_empty() && (w.cells.len() + w.vertices.len() > 0), "{w:?}");
        assert_eq!(w.vertices.len(), w.coordinates.len());
    }
    report.claims.iter().map(|c| c.verdict).collect()
}

#[test]
fn mutations_are_found() {
    use Verdict::{Holds, Violated};
    let (mut flips, mut holes) = (0, 0);
    for case in (0..24).step_by(2) {
        let (p, _) = random(case, 12);
        let cells = definition(&p, &[]);
        for i in 0..cells.len() {
            let mut inverted = cells.clone();
            inverted[i].swap(1, 2);
            assert_eq!(verdicts(&p, &inverted), [Holds, Violated, Holds, Holds, Holds]);
            let doubled = [&cells[..], &cells[i..=i]].concat();
            assert_eq!(verdicts(&p, &doubled)[0], Violated);
            let report = run(&p, &doubled, Claim::Valid);
            assert_eq!((report.violations, &report.witnesses[0].cells[..]), (1, &[i as u32, cells.len() as u32][..]));
            let mut missing = cells.clone();
            missing.remove(i);
            let said = verdicts(&p, &missing);
            assert!(said[0] != Violated || said[4] == Violated, "{said:?}");
            assert_eq!(said[4], Violated, "a hole or a dent is not convex, or a vertex is left out: {said:?}");
            holes += 1;
            // Two cells become three around the edge between their far corners, where that edge passes their common facet.
            for j in 0..i {
                let common: Vec<u32> = cells[i].iter().copied().filter(|v| cells[j].contains(v)).collect();
                if common.len() != 3 {
                    continue;
                }
                let far = |t: &[u32; 4]| *t.iter().find(|v| !common.contains(v)).expect("a far corner");
                let (u, v) = (far(&cells[i]), far(&cells[j]));
                let mut flipped: Cells = (0..cells.len()).filter(|&k| k != i && k != j).map(|k| cells[k]).collect();
                flipped.extend([[0, 1], [1, 2], [2, 0]].map(|[a, b]| [u, v, common[a], common[b]]));
                let at = |v: u32| Point3::from_array(p[v as usize]);
                let turns = [[0, 1], [1, 2], [2, 0]].map(|[a, b]| orient(at(u), at(v), at(common[a]), at(common[b])));
                let said = verdicts(&p, &flipped);
                if turns == [turns[0]; 3] {
                    assert_eq!([said[0], said[2], said[3]], [Holds, Violated, Violated], "{flipped:?}");
                    flips += 1;
                } else {
                    assert_eq!(said[0], Violated, "a flip that cannot be: {flipped:?}");
                }
            }
        }
    }
    assert!(flips > 50 && holes > 100, "{flips} {holes}");
}

#[test]
fn an_ulp_across_a_sphere() {
    let (p, cells) = cubes(&[[1, 1, 1]]);
    // Eight points on one sphere: Delaunay however it is cut, canonical in one way only.
    let canonical = definition(&p, &[]);
    let claims = [Claim::Delaunay, Claim::Canonical, Claim::Hull];
    let said = |p: &[[f64; 3]], t: &[[u32; 4]]| {
        run_all(p, &[], t, &claims).claims.iter().map(|c| c.verdict).collect::<Vec<_>>()
    };
    use Verdict::{Holds, Violated};
    assert_eq!(said(&p, &cells), [Holds, Violated, Holds]);
    assert_eq!(said(&p, &canonical), [Holds, Holds, Holds]);
    // The path of a cell's corners: an end of the diagonal is in all cells, the others in two.
    let inner = cells[0][1];
    for axis in 0..3 {
        let mut q = p.clone();
        let x = &mut q[inner as usize][axis];
        // Towards the center at 1.5.
        *x = if *x < 1.5 { x.next_up() } else { x.next_down() };
        let report = run_all(&q, &[], &cells, &[Claim::Valid, Claim::Delaunay]);
        assert_eq!(report.claims[0].verdict, Holds);
        let delaunay = &report.claims[1];
        assert_eq!(delaunay.verdict, Violated, "axis {axis}");
        assert!(delaunay.witnesses.iter().any(|w| w.vertices[4] == inner || w.vertices[..4].contains(&inner)));
    }
}

#[test]
fn spheres_are_empty_beyond_the_border() {
    // Two cells apart: the sphere of the first holds a corner of the second.
    let far = |x: f64| corner_and(&[[x, x, x], [x + 9.0, x, x], [x, x + 9.0, x], [x, x, x + 9.0]]);
    let cells = [[0, 1, 2, 3], [4, 5, 6, 7]];
    assert_eq!(run(&far(2.5), &cells, Claim::Delaunay).verdict, Verdict::Violated);
    assert_eq!(run(&far(2.5), &cells, Claim::Delaunay).witnesses[0].vertices, [0, 1, 2, 3, 4]);
    assert_eq!(run(&far(4.5), &cells, Claim::Delaunay).verdict, Verdict::Holds);
    // On the sphere: a tie, which the tie-break decides.
    assert_eq!(run(&far(4.0), &cells, Claim::Delaunay).verdict, Verdict::Holds);
    // A large weight reaches farther.
    let report = run_all(&far(4.5), &[0.0, 0.0, 0.0, 0.0, 30.0], &cells, &[Claim::Delaunay, Claim::Regular]);
    assert_eq!(report.claims.iter().map(|c| c.verdict).collect::<Vec<_>>(), [Verdict::Holds, Verdict::Violated]);
}

#[test]
fn points_left_out() {
    let claims = [Claim::Valid, Claim::Delaunay, Claim::Regular, Claim::Canonical, Claim::Hull];
    let said = |p: [f64; 3], weight: f64| {
        let report = run_all(&corner_and(&[p]), &[0.0, 0.0, 0.0, 0.0, weight], &[[0, 1, 2, 3]], &claims);
        report.claims.iter().map(|c| c.verdict).collect::<Vec<_>>()
    };
    use Verdict::{Holds, Violated};
    assert_eq!(said([0.5; 3], 0.0), [Holds, Violated, Violated, Violated, Violated]);
    assert_eq!(said([0.5; 3], -9.0), [Holds, Violated, Holds, Holds, Holds], "hidden");
    // |x|^2 - 4 (x + y + z) is -5.25 here: on the orthosphere, strictly inside the cell.
    assert_eq!(said([0.5; 3], -5.25), [Holds, Violated, Holds, Violated, Holds]);
    assert_eq!(said([0.0; 3], 0.0), [Holds, Holds, Holds, Holds, Holds], "a double");
    assert_eq!(said([0.0; 3], -1.0), [Holds, Holds, Holds, Holds, Holds], "hidden by a corner");
    assert_eq!(said([0.0; 3], 1.0), [Holds, Holds, Violated, Violated, Violated], "hides a corner");
    assert_eq!(said([9.0; 3], 0.0), [Holds, Holds, Holds, Holds, Violated], "outside");
}

#[test]
fn hulls() {
    // The radii of the fan grow slowly enough for it to be convex.
    let convex = ["a cell", "a negative cell", "of mixed orientation", "a fan", "a block"];
    for (name, p, t) in valid_meshes() {
        let report = run(&p, &t, Claim::Hull);
        assert_eq!(report.verdict == Verdict::Holds, convex.contains(&name), "{name}: {:?}", report.witnesses);
        assert!(report.verdict != Verdict::Violated || !report.witnesses.is_empty(), "{name}");
    }
}

#[test]
fn figures_of_known_shapes() {
    let figure = |report: &ClaimReport, name: &str| {
        report.figures.iter().find(|f| f.0 == name).unwrap_or_else(|| panic!("{name}")).1
    };
    let regular = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let quality = run(&regular, &[[0, 1, 2, 3]], Claim::Quality);
    assert!((figure(&quality, "min_dihedral") - 70.528_779).abs() < 1e-5);
    assert!((figure(&quality, "max_radius_edge") - (3.0f64 / 8.0).sqrt()).abs() < 1e-12);
    assert!((figure(&quality, "max_volume") - 8.0 / 3.0).abs() < 1e-12);
    assert_eq!(figure(&quality, "dihedral_from_70"), 6.0);
    let sliver = [[1.0, 0.0, 0.02], [-1.0, 0.0, 0.02], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]];
    assert_eq!(figure(&run(&sliver, &[[0, 1, 2, 3]], Claim::Quality), "slivers"), 1.0);

    let (p, t) = block([3, 3, 1], &[[1, 1, 0]]);
    let ring = run(&p, &t, Claim::Topology);
    for (name, expected) in [
        ("vertices", 32.0),
        ("cells", 48.0),
        ("euler_characteristic", 0.0),
        ("components", 1.0),
        ("border_components", 1.0),
        ("border_euler_characteristic", 0.0),
    ] {
        assert_eq!(figure(&ring, name), expected, "{name}");
    }
    let (p, t) = block([3, 3, 3], &[[1, 1, 1]]);
    let shell = run(&p, &t, Claim::Topology);
    assert_eq!(figure(&shell, "euler_characteristic"), 2.0);
    assert_eq!((figure(&shell, "border_components"), figure(&shell, "border_euler_characteristic")), (2.0, 4.0));
    let (p, t) = cubes(&[[0, 0, 0], [1, 1, 1]]);
    assert_eq!(figure(&run(&p, &t, Claim::Topology), "facet_connected_components"), 2.0);
}

#[test]
fn claimed_ratios_are_decided_exactly() {
    // The circumradius of a corner of a cube is sqrt(3)/2 of its shortest edge; 0.75 = rho^2 has no such rho, so take one that has:
    // edges 2, 2, 1 at a right angle, R = 3/2.
    let p = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]];
    let points = p.map(Point3::from_array);
    let cells = [[0, 1, 2, 3].map(VertexId)];
    let subject = Subject { points: &points, cells: &cells, ..Subject::default() };
    let said = |rho: f64| {
        let options = Options { claims: &[Claim::Quality], radius_edge: Some(rho) };
        audit(&subject, &options).claims[0].verdict
    };
    assert_eq!(said(1.5), Verdict::Violated);
    assert_eq!(said(1.5f64.next_up()), Verdict::Holds);
}

/// Products of five differences underflow long before differences do.
#[test]
fn conflicts_of_any_size_are_found() {
    let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 2.0], [1.0, 1.0, -2.0]];
    let two = [[0, 1, 2, 3], [0, 2, 1, 4]];
    let three = [[3, 4, 0, 1], [3, 4, 1, 2], [3, 4, 2, 0]];
    let big = [[0.5, 0.5, 0.5], [1.0, 0.5, 0.5], [0.5, 1.0, 0.5], [0.5, 0.5, 1.0]];
    let verdict = |cells: &[[u32; 4]], k: i32| {
        let scale = 2f64.powi(-k);
        let p: Places = points.iter().map(|p| p.map(|x| x * scale)).chain(big).collect();
        let cells: Cells = cells.iter().copied().chain([[5, 6, 7, 8]]).collect();
        run(&p, &cells, Claim::Delaunay).verdict
    };
    for k in [10, 100, 199, 200, 201, 215, 216, 220, 300, 340] {
        let verdicts = [verdict(&two, k), verdict(&three, k)];
        assert!(verdicts.contains(&Verdict::Holds) && verdicts.contains(&Verdict::Violated), "2^-{k}: {verdicts:?}");
    }
}

/// Parts side by side are told apart by rays across the row; a block of parts takes a bounded number of steps.
#[test]
fn many_parts_are_examined() {
    let corner = |at: [f64; 3]| {
        [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]].map(|p| [0, 1, 2].map(|k| p[k] + at[k]))
    };
    for axis in 0..3 {
        let place = |i: usize| [0, 1, 2].map(|k| if k == axis { i as f64 } else { 0.0 });
        let p: Places = (0..3000).flat_map(|i| corner(place(i))).collect();
        let cells: Cells = (0..3000).map(|i| [0, 1, 2, 3].map(|k| 4 * i + k)).collect();
        assert_eq!(run(&p, &cells, Claim::Valid).verdict, Verdict::Holds, "axis {axis}");
        // One more inside the first.
        let inner = corner([0.0; 3]).map(|p| p.map(|x| 0.1 + 0.2 * x));
        let p: Places = p.into_iter().chain(inner).collect();
        let cells: Cells = cells.into_iter().chain([[12000, 12001, 12002, 12003]]).collect();
        assert_eq!(run(&p, &cells, Claim::Valid).verdict, Verdict::Violated, "axis {axis}");
    }
}

/// Whichever corner of a pair of cells is the smallest, one of them is tested against the far corner of the other.
#[test]
fn conflicts_are_seen_under_all_names() {
    let mut names = vec![vec![0u32]];
    for next in 1..5 {
        let grown = |name: &Vec<u32>| {
            (0..=next).map(|k| [&name[..k as usize], &[next], &name[k as usize..]].concat()).collect()
        };
        names = names.iter().flat_map(|name| -> Vec<Vec<u32>> { grown(name) }).collect();
    }
    assert_eq!(names.len(), 120);
    for name in names {
        for (height, verdict) in [(0.5, Verdict::Violated), (2.0, Verdict::Holds)] {
            let by_place =
                [[0.0, 0.0, height], [0.0, 0.0, -height], [1.0, 0.0, 0.0], [-0.5, 0.75, 0.0], [-0.5, -0.75, 0.0]];
            let mut points = vec![[0.0; 3]; 5];
            name.iter().zip(by_place).for_each(|(&v, p)| points[v as usize] = p);
            let cells = [[2, 3, 4, 0], [2, 4, 3, 1]].map(|cell| cell.map(|k: usize| name[k]));
            let report = run(&points, &cells, Claim::Delaunay);
            assert_eq!((report.verdict, report.violations), (verdict, u64::from(height < 1.0)), "{name:?} {report:?}");
        }
    }
}

#[test]
fn a_flat_cell_has_no_orientation() {
    let p = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for cells in [vec![[0, 1, 2, 3]], vec![[0, 1, 2, 4], [0, 1, 1, 4]], vec![[0, 1, 2, 4], [0, 1, 2, 9]]] {
        for claims in [&[Claim::Orientation][..], &[Claim::Orientation, Claim::Delaunay]] {
            let report = run_all(&p, &[], &cells, claims);
            let orientation = report.claim(Claim::Orientation).expect("it was asked for");
            assert_eq!((orientation.verdict, orientation.violations), (Verdict::Violated, 1), "{cells:?}");
        }
    }
}
