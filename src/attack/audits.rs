//! The audit on meshes that were changed: it must call right what is right, and nothing else.
//!
//! Oracle: let the constraints be the edges that the file names, else the interfaces of attributes, and the border edges. A mesh is a valid
//! complex without conflicts exactly if each of its triangles, once, belongs to the one constrained Delaunay triangulation of its
//! vertices, which `Cdt2` builds with the exact kernel and the audit never sees. Against an input: with its points as they were a mesh
//! is right exactly if its triangles are those of before; without a vertex of the input it is not right.

use super::mutations::{number, place};
use super::refinement::GcdrCase;
use crate::arith::{ExactKernel, FastKernel};
use crate::audit::{Claim, Options, Report, Subject, Verdict, audit};
use crate::domain::{normalise, prepare};
use crate::generators::{Bytes, Draw};
use crate::model::{Lines, Mesh2, Point2, Pslg, Triangle, VertexId, VertexKind};
use crate::refine::{self, gcdr};
use crate::trace::Recorder;
use crate::triangulation::cdt2::Cdt2;
use arbitrary::{Arbitrary, Result, Unstructured};
use std::collections::{BTreeMap, BTreeSet};

/// A mesh of ours, and the draws that change it.
#[derive(Clone, Debug, PartialEq)]
pub struct MutatedMeshCase {
    /// The draws.
    pub edits: [u8; EDIT_BYTES],
    /// The run that makes the mesh.
    pub origin: GcdrCase,
}

/// Bytes that decide on the changes.
const EDIT_BYTES: usize = 48;

/// How far a vertex may be off its segment, in ulps: roundings add up along many splits of one segment.
const WITHIN: f64 = 64.0;

impl<'a> Arbitrary<'a> for MutatedMeshCase {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let edits = u.arbitrary()?;
        let mut origin = GcdrCase::arbitrary(u)?;
        origin.steps = origin.steps.min(40);
        Ok(MutatedMeshCase { edits, origin })
    }
}

impl MutatedMeshCase {
    /// Asserts that the mesh is called right before the changes, and after them if it is.
    pub fn run(&self) {
        let prepared = prepare::<FastKernel>(&self.origin.pslg, &Lines::default());
        if prepared.has_errors() {
            return;
        }
        let input = &prepared.pslg;
        let (mut options, mut trace) =
            (refine::Options { max_steps: self.origin.steps, ..refine::Options::default() }, Recorder::default());
        let Ok(run) = gcdr::run::<FastKernel>(input, &self.origin.parameters, &mut options, &mut trace) else {
            return;
        };
        let before = run.mesh;
        self.assert_right(&before, input);
        let mut after = before.clone();
        let draw = &mut Bytes(&self.edits);
        for _ in 0..=draw.below(3) {
            change(&mut after, draw);
        }
        let alone = audited(&after, None);
        if let Some(right) = is_right(&after) {
            let holds = [Claim::Valid, Claim::Canonical].iter().all(|&c| verdict(&alone, c) == Verdict::Holds);
            assert_eq!(holds, right, "{alone} {after:?} of {self:?}");
            let constrained = verdict(&alone, Claim::Constrained) == Verdict::Holds;
            assert!(constrained || !right, "{alone} {after:?} of {self:?}");
        }
        let report = audited(&after, Some(input));
        let claims = [Claim::Valid, Claim::Canonical, Claim::Conforming];
        if claims.iter().all(|&c| verdict(&report, c) == Verdict::Holds) {
            let same = before.points == after.points;
            assert!(!same || keys(&before) == keys(&after), "other triangles: {report} {after:?} of {self:?}");
            let lost = lost_vertex(&before, &after);
            assert!(lost.is_none(), "without vertex {lost:?}: {report} {after:?} of {self:?}");
        }
    }

    fn assert_right(&self, mesh: &Mesh2, input: &Pslg) {
        if mesh.triangles.is_empty() {
            return;
        }
        assert_eq!(is_right(mesh), Some(true), "{mesh:?} of {self:?}");
        for input in [None, Some(input)] {
            let report = audited(mesh, input);
            for claim in [Claim::Valid, Claim::Orientation, Claim::Constrained, Claim::Canonical, Claim::Conforming] {
                let unnamed = claim == Claim::Conforming && input.is_none() && mesh.edges.is_empty();
                assert!(unnamed || verdict(&report, claim) == Verdict::Holds, "{report} of {self:?}");
            }
        }
    }
}

/// Everything the audit says.
fn audited(mesh: &Mesh2, input: Option<&Pslg>) -> Report {
    let edges: Vec<[VertexId; 2]> = mesh.edges.iter().map(|e| e.ends).collect();
    let subject = Subject {
        points: &mesh.points,
        triangles: &mesh.triangles,
        triangle_attributes: &mesh.triangle_attributes,
        edges: &edges,
        ..Subject::default()
    };
    let lines = Lines::default();
    let options = Options { input: input.map(|g| (g, &lines)), within: WITHIN, rho2: Some(1.0), ..Options::default() };
    let report = audit(&subject, &options);
    // What is told can be written.
    assert!(!report.to_string().is_empty());
    report
}

fn verdict(report: &Report, claim: Claim) -> Verdict {
    // All claims were asked for.
    report.claim(claim).map_or(Verdict::Unchecked, |c| c.verdict)
}

/// Triangles as sets of vertices, sorted.
fn keys(mesh: &Mesh2) -> Vec<[u32; 3]> {
    let mut keys: Vec<[u32; 3]> = mesh.triangles.iter().map(sorted).collect();
    keys.sort_unstable();
    keys
}

fn sorted(t: &Triangle) -> [u32; 3] {
    let mut key = t.map(|v| v.0);
    key.sort_unstable();
    key
}

/// A vertex of the input that the mesh used, whose place no vertex of a triangle has any more.
fn lost_vertex(before: &Mesh2, after: &Mesh2) -> Option<u32> {
    let used = |mesh: &Mesh2| -> BTreeSet<u32> { mesh.triangles.iter().flatten().map(|v| v.0).collect() };
    let places: Vec<Point2> = used(after).into_iter().filter_map(|v| after.points.get(v as usize).copied()).collect();
    used(before)
        .into_iter()
        .find(|&v| before.kinds[v as usize] == VertexKind::Input && !places.contains(&before.points[v as usize]))
}

/// By the oracle: whether the mesh is a valid complex without conflicts. `None` where the oracle's numbers do not reach, or nothing is claimed.
fn is_right(mesh: &Mesh2) -> Option<bool> {
    if mesh.triangles.is_empty() {
        return None;
    }
    let corners = || mesh.triangles.iter().flatten();
    if corners().any(|v| mesh.points.get(v.index()).is_none_or(|p| !p.is_finite())) {
        return Some(false);
    }
    let used: BTreeSet<u32> = corners().map(|v| v.0).collect();
    // Distinct places: of corners, then of others where no corner is.
    let mut points: Vec<Point2> = Vec::new();
    let mut number = vec![u32::MAX; mesh.points.len()];
    let others = (0..mesh.points.len() as u32).filter(|v| !used.contains(v));
    for v in used.iter().copied().chain(others) {
        let p = mesh.points[v as usize];
        if points.contains(&p) || !p.is_finite() {
            if used.contains(&v) {
                return Some(false);
            }
            continue;
        }
        number[v as usize] = points.len() as u32;
        points.push(p);
    }
    let renumbered = |v: u32| VertexId(number[v as usize]);
    let (normal, _) = normalise(&points, &Lines::default()).ok()?;
    let Ok(mut cdt) = Cdt2::<ExactKernel>::delaunay(normal) else {
        return Some(false);
    };
    let constraints: Vec<[VertexId; 2]> = constraints(mesh).into_iter().map(|e| e.map(renumbered)).collect();
    if cdt.constrain(&constraints).is_err() {
        return Some(false);
    }
    let all: BTreeSet<[u32; 3]> = cdt.triangles().map(|t| sorted(&cdt.vertices(t))).collect();
    let mine = mesh.triangles.iter().map(|t| sorted(&t.map(|v| renumbered(v.0))));
    let distinct: BTreeSet<[u32; 3]> = mine.collect();
    Some(distinct.len() == mesh.triangles.len() && distinct.is_subset(&all))
}

/// The edges that are constrained: named, or else interfaces; and the border.
fn constraints(mesh: &Mesh2) -> BTreeSet<[u32; 2]> {
    let mut triangles: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (i, t) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = sorted(t);
        for edge in [[a, b], [b, c], [a, c]] {
            triangles.entry(edge).or_default().push(i);
        }
    }
    let named: BTreeSet<[u32; 2]> = mesh
        .edges
        .iter()
        .map(|e| {
            let [u, v] = e.ends.map(|v| v.0);
            [u.min(v), u.max(v)]
        })
        .collect();
    let attribute = |t: usize| mesh.triangle_attributes.get(t).map(|a| a.to_bits());
    let is_constraint = |edge: &[u32; 2], around: &[usize]| match around {
        [s, t] if named.is_empty() => !mesh.triangle_attributes.is_empty() && attribute(*s) != attribute(*t),
        [_, _] => named.contains(edge),
        _ => true,
    };
    triangles.iter().filter(|(edge, around)| is_constraint(edge, around)).map(|(&edge, _)| edge).collect()
}

/// Changes something of a mesh. A change may leave it as it was.
fn change(mesh: &mut Mesh2, draw: &mut impl Draw) {
    let (n, m) = (mesh.points.len() as u32, mesh.triangles.len() as u32);
    if n == 0 || m == 0 {
        return;
    }
    let (v, t) = (draw.below(n) as usize, draw.below(m) as usize);
    let other = mesh.points[draw.below(n) as usize];
    let corners = mesh.triangles[t].map(|v| mesh.points.get(v.index()).copied().unwrap_or_default());
    match draw.below(14) {
        0 | 1 => place(&mut mesh.points[v], draw),
        2 => {
            let p = &mut mesh.points[v];
            number(if draw.coin() { &mut p.x } else { &mut p.y }, draw);
        }
        3 => mesh.points[v] = if draw.coin() { other } else { other.midpoint(mesh.points[v]) },
        4 => drop(mesh.triangles.remove(t)),
        5 => mesh.triangles.push(mesh.triangles[t]),
        6 => mesh.triangles[t].swap(0, 1),
        7 => {
            let w = [n, u32::MAX][draw.below(2) as usize];
            mesh.triangles[t][draw.below(3) as usize] = VertexId(if draw.below(8) == 0 { w } else { draw.below(n) });
        }
        8 => flip(mesh, t, draw),
        9 => mesh.edges.truncate(draw.below(mesh.edges.len() as u32 + 1) as usize),
        10 if !mesh.edges.is_empty() => {
            let e = draw.below(mesh.edges.len() as u32) as usize;
            mesh.edges[e].ends[draw.below(2) as usize] = VertexId(draw.below(n));
        }
        11 => {
            mesh.triangle_attributes.resize(m as usize, 0.0);
            number(&mut mesh.triangle_attributes[t], draw);
        }
        12 => {
            let at = match draw.below(4) {
                0 => corners[0].midpoint(corners[1]),
                1 => (corners[0] + corners[1] + corners[2]) / 3.0,
                2 => corners[0],
                _ => other + (corners[0] - other) * (3.0 * draw.signed_unit()),
            };
            added(mesh, at);
        }
        _ => {
            // A vertex inside, or hanging on an edge.
            let at = if draw.coin() {
                corners[0].midpoint(corners[1])
            } else {
                (corners[0] + corners[1] + corners[2]) / 3.0
            };
            let w = added(mesh, at);
            let [a, b, c] = mesh.triangles[t];
            mesh.triangles[t] = [b, c, w];
            mesh.triangles.push([c, a, w]);
            if draw.below(3) > 0 {
                mesh.triangles.push([a, b, w]);
            }
        }
    }
}

fn added(mesh: &mut Mesh2, at: Point2) -> VertexId {
    mesh.points.push(at);
    mesh.kinds.push(VertexKind::Free);
    VertexId(mesh.points.len() as u32 - 1)
}

/// Exchanges an edge of t with the other diagonal of the two triangles there, whether or not that leaves triangles.
fn flip(mesh: &mut Mesh2, t: usize, draw: &mut impl Draw) {
    let mut ends = mesh.triangles[t];
    ends.rotate_left(draw.below(3) as usize);
    let [a, b, c] = ends;
    let beyond = mesh.triangles.iter().position(|s| (0..3).any(|k| [s[k], s[(k + 1) % 3]] == [b, a]));
    let Some(s) = beyond.filter(|&s| s != t) else { return };
    // The corner that is no end of the edge.
    if let Some(&d) = mesh.triangles[s].iter().find(|v| ![a, b].contains(v)) {
        mesh.triangles[t] = [c, a, d];
        mesh.triangles[s] = [d, b, c];
    }
}
