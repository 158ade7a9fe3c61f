//! What must hold at the end: every segment is a chain of its subsegments, no bad triangle is left but those skipped, and counts and digest are
//! the mesh's. That the mesh is a constrained Delaunay triangulation follows from `replay` step by step; a strict check tests it anew besides.

use super::complex::{Complex, Kind, NONE, canonical, triangle_of};
use super::condition::is_skinny;
use super::replay::Replay;
use super::verdict::{Checked, Rule, broken, ensure};
use crate::model::Point2;
use crate::trace::{Counts, End, Outcome};

/// Proves the claims of the end record of a refinement.
pub fn check_end(replay: &Replay, end: &End) -> Checked {
    if let Some(first) = replay.first_waiting() {
        return broken(Rule::Removal, format!("the split that removal {first} is for"), "the end");
    }
    check_chains(&replay.mesh, |s| replay.ledger.segments[s as usize].ends.map(|v| v.0), Some(&replay.ledger.splits))?;
    let mut unmet = 0;
    for t in replay.mesh.triangles() {
        let facts = replay.mesh.facts(t);
        unmet += u32::from(facts.skipped_skinny) + u32::from(facts.skipped_oversized);
        if end.outcome == Outcome::Stopped {
            continue;
        }
        let skinny = !facts.skipped_skinny && is_skinny(replay.mesh.places(t), replay.ledger.parameters.rho2);
        let large = !facts.skipped_oversized && replay.is_too_large(t);
        ensure(!skinny && !large, Rule::F3, || {
            ("no bad triangle left unlisted", format!("{:?}", canonical(replay.mesh.corners(t))))
        })?;
    }
    check_outcome(end, unmet)?;
    check_counts(end, &replay.mesh, Counts { unmet, ..replay.ledger.tally })?;
    Ok(())
}

/// The outcome is the one that the unmet triangles make; a reason stands with `stopped` only.
pub fn check_outcome(end: &End, unmet: u32) -> Checked {
    let expected = match end.outcome {
        Outcome::Stopped => Outcome::Stopped,
        _ if unmet > 0 => Outcome::Holey,
        _ => Outcome::Complete,
    };
    ensure(end.outcome == expected, Rule::Outcome, || (format!("{expected:?}"), format!("{:?}", end.outcome)))?;
    ensure(end.stop_reason.is_some() == (end.outcome == Outcome::Stopped), Rule::Outcome, || {
        ("a stop reason exactly if stopped", format!("{:?} with {:?}", end.outcome, end.stop_reason))
    })
}

/// Counts of the mesh and of the events.
pub fn check_counts(end: &End, mesh: &Complex, tally: Counts) -> Checked {
    let vertices = mesh.vertices.iter().filter(|v| v.kind != Kind::Deleted).count() as u32;
    let expected = Counts { vertices, triangles: mesh.triangles().count() as u32, ..tally };
    ensure(end.counts == expected, Rule::Counts, || (format!("{expected:?}"), format!("{:?}", end.counts)))
}

/// Every constrained edge of the region, once: its ends, the smaller first, and its segment.
pub(super) fn subsegments(mesh: &Complex) -> Vec<[u32; 3]> {
    let mut edges = Vec::new();
    for t in mesh.triangles() {
        for e in 4 * t..4 * t + 3 {
            let (other, segment) = (mesh.beyond(e), mesh.segment(e));
            if segment != NONE && (mesh.inside(other).is_none() || triangle_of(other) > t) {
                let (u, v) = (mesh.origin(e), mesh.target(e));
                edges.push([u.min(v), u.max(v), segment]);
            }
        }
    }
    edges
}

/// Each input segment of the region is one chain of subsegments between its ends, over vertices labelled with it.
pub fn check_chains(mesh: &Complex, ends: impl Fn(u32) -> [u32; 2], splits: Option<&[u32]>) -> Checked {
    let mut directed: Vec<[u32; 3]> = Vec::new();
    for [u, v, s] in subsegments(mesh) {
        directed.extend([[s, u, v], [s, v, u]]);
    }
    directed.sort_unstable();
    for chain in directed.chunk_by(|a, b| a[0] == b[0]) {
        let segment = chain[0][0];
        let [first, last] = ends(segment);
        let (mut before, mut here, mut steps) = (NONE, first, 0);
        while here != last && steps < chain.len() {
            let start = chain.partition_point(|&[_, u, _]| u < here);
            let onward = chain[start..].iter().take_while(|&&[_, u, _]| u == here).find(|&&[_, _, v]| v != before);
            let Some(&[_, _, v]) = onward else { break };
            (before, here) = (here, v);
            steps += 1;
            let labelled = here == last || mesh.vertices[here as usize].segment() == Some(segment);
            ensure(labelled, Rule::Segment, || (format!("vertices of segment {segment}"), format!("vertex {here}")))?;
        }
        let whole = here == last && 2 * steps == chain.len();
        let counted = splits.is_none_or(|s| s[segment as usize] as usize + 1 == steps);
        ensure(whole && counted, Rule::Segment, || {
            (
                format!("segment {segment} as one chain from {first} to {last}"),
                format!("{steps} of {} edges", chain.len() / 2),
            )
        })?;
    }
    Ok(())
}

/// The digest of the mesh, from the definition in `docs/trace-format.md`; `at` gives coordinates in input units.
pub fn mesh_digest(mesh: &Complex, at: impl Fn(u32) -> Point2) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut dense = vec![NONE; mesh.vertices.len()];
    let mut bytes = Vec::new();
    let mut kept = 0u32;
    for (v, _) in mesh.vertices.iter().enumerate().filter(|(_, v)| v.kind != Kind::Deleted) {
        dense[v] = kept;
        kept += 1;
        let p = at(v as u32);
        bytes.extend([p.x, p.y].iter().flat_map(|x| x.to_bits().to_le_bytes()));
    }
    hasher.update(&u64::from(kept).to_le_bytes());
    hasher.update(&bytes);
    let mut triangles: Vec<[u32; 3]> =
        mesh.triangles().map(|t| canonical(mesh.corners(t)).map(|v| dense[v as usize])).collect();
    triangles.sort_unstable();
    let mut edges: Vec<[u32; 3]> =
        subsegments(mesh).into_iter().map(|[u, v, s]| [dense[u as usize], dense[v as usize], s]).collect();
    edges.sort_unstable();
    for list in [triangles, edges] {
        hasher.update(&(list.len() as u64).to_le_bytes());
        bytes.clear();
        bytes.extend(list.iter().flatten().flat_map(|n| n.to_le_bytes()));
        hasher.update(&bytes);
    }
    hasher.finalize().to_hex().to_string()
}
