//! A finished triangulation proved at once, in time linear in its cells.
//!
//! Tested: (1) every tetrahedron is positively oriented; (2) every facet has one tetrahedron on each side of it, or one in all: then it is a facet of
//! the hull; (3) every edge of the hull lies in two facets of the hull, one for each direction, and the hull is convex there: the far corner of one is
//! not beyond the other, and if in its plane, then across the edge; (4) the middle o of some tetrahedron is inside of every facet of the hull, and the ray from
//! o through the middle of one facet of the hull meets no other; (5) no facet has the corner beyond it in conflict with the tetrahedron on this side.
//!
//! They suffice. By (2) the boundary of the sum of all tetrahedra is the sum of the hull's facets, H. By (1) each point off the facets is covered as often as H winds around it.
//! Seen from o all of H turns the same way by (4), and by (3) H has no boundary, so each direction is covered equally often: once, by (4). So H is the
//! boundary of a body star-shaped about o, in which all points are covered once, and none outside. Being connected and, by (3), convex
//! at each edge of its boundary it is convex (Tietze), and it holds all vertices: it is their hull. By (5) the lifted complex is convex at every facet, thus convex:
//! the lower hull of the lifted vertices.

use super::ball::{Ball, Row, across, near_side, side_from_middle};
use super::complex::{Complex, INFINITE};
use super::glue::{BORDER, facet, glue};
use super::predicates::{in_conflict, orient, side, tie_in_conflict};
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::Sign;

/// Whether a tie may be decided either way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ties {
    /// Points exactly on an orthosphere are in conflict or not, as the trace has it.
    Free,
    /// The one tie-break decides.
    Broken,
}

/// Links the tetrahedra of a complex that has nothing else, closes it beyond the hull, and proves that it is the triangulation of its vertices.
pub fn prove(mesh: &mut Complex, ties: Ties) -> Checked {
    let hull = link(mesh)?;
    let Some(&first) = hull.first() else {
        return broken(Rule::Hull, "facets on the hull", "none");
    };
    let ghosts = close(mesh, &hull)?;
    check_cells(mesh, ghosts.start, ties)?;
    for c in 0..ghosts.start {
        (0..4).for_each(|k| mesh.set_cell_at(mesh.cell(c).v[k], c));
    }
    mesh.set_cell_at(INFINITE, ghosts.start);
    check_hull(mesh, ghosts, mesh.cell(first >> 2).facet((first & 3) as usize))
}

/// Pairs the facets of all tetrahedra, and gives those without partner.
fn link(mesh: &mut Complex) -> Checked<Vec<u32>> {
    let cells: Vec<[u32; 4]> = (0..mesh.slot_count()).map(|c| mesh.cell(c).v).collect();
    // Tables as long as the greatest corner asks for: most traces start with one simplex.
    let greatest = cells.as_flattened().iter().max().copied().unwrap_or(0);
    let glued = glue(&cells, greatest as usize + 1);
    if let Some(clash) = glued.clashes.first() {
        let corners = facet(&cells, clash[0]).map(super::complex::id);
        return broken(
            Rule::Closed,
            "a facet with one tetrahedron on each side",
            format!("facet {corners:?} of {} tetrahedra", clash.len()),
        );
    }
    let mut hull = Vec::new();
    for (f, &g) in (0..).zip(&glued.across) {
        match g {
            BORDER => hull.push(f),
            g if f < g => mesh.join(f, g),
            _ => {}
        }
    }
    Ok(hull)
}

/// Adds a cell beyond each facet of the hull, and links those along the edges.
fn close(mesh: &mut Complex, hull: &[u32]) -> Checked<std::ops::Range<u32>> {
    let begin = mesh.slot_count();
    let mut edges = Vec::with_capacity(3 * hull.len());
    for &f in hull {
        let [x, y, z] = mesh.cell(f >> 2).facet((f & 3) as usize);
        let c = mesh.add([x, z, y, INFINITE]);
        mesh.join(4 * c + 3, f);
        for (k, [u, w]) in [(0, [z, y]), (1, [y, x]), (2, [x, z])] {
            edges.push((u64::from(u.min(w)) << 32 | u64::from(u.max(w)), u > w, 4 * c + k));
        }
    }
    edges.sort_unstable();
    for same in edges.chunk_by(|e, f| e.0 == f.0) {
        match *same {
            [(_, false, e), (_, true, f)] => mesh.join(e, f),
            _ => {
                return broken(
                    Rule::Hull,
                    "an edge of the hull in two of its facets",
                    format!("edge of {} facets", same.len()),
                );
            }
        }
    }
    Ok(begin..mesh.slot_count())
}

/// (1) and (5).
fn check_cells(mesh: &Complex, count: u32, ties: Ties) -> Checked {
    for c in 0..count {
        let cell = *mesh.cell(c);
        let t = mesh.corners(c);
        let [u, v, w] = [0, 1, 2].map(|k: usize| Row::new(t[3], t[k]));
        let ball = Ball::new(&u, &v, &w);
        let orientation = ball.orientation().unwrap_or_else(|| orient(t[0].at, t[1].at, t[2].at, t[3].at));
        ensure(orientation.is_positive(), Rule::Orientation, || {
            ("a positively oriented tetrahedron", format!("{:?}", cell.tuple()))
        })?;
        for f in cell.beyond {
            let q = mesh.apex(f);
            if f >> 2 < c || q == INFINITE {
                continue;
            }
            let q = mesh.point(q);
            let own = ball.side(&Row::new(t[3], q)).unwrap_or_else(|| near_side(&t, &q));
            let conflict = match (own, ties) {
                (Sign::Zero, Ties::Broken) => tie_in_conflict(&t, &q),
                (own, _) => own.is_positive(),
            };
            ensure(!conflict, Rule::Regular, || {
                ("an orthoball empty of the next corner", format!("{:?} holds {:?}", cell.tuple(), mesh.apex(f)))
            })?;
        }
    }
    Ok(())
}

/// (3) and (4); `facet` is one of the hull, turned inwards.
fn check_hull(mesh: &Complex, ghosts: std::ops::Range<u32>, facet: [u32; 3]) -> Checked {
    let inner = mesh.corners(0).map(|p| p.at);
    let target = facet.map(|v| mesh.at(v));
    let mut met = 0;
    for c in ghosts {
        for k in 0..3 {
            check_convex(mesh, c, k)?;
        }
        let [x, y, z] = [0, 1, 2].map(|k: usize| mesh.at(mesh.cell(c).v[k]));
        let inside = inner.iter().all(|&p| !orient(x, y, z, p).is_positive());
        ensure(inside, Rule::Hull, || ("a convex hull", format!("a corner beyond {:?}", mesh.cell(c).tuple())))?;
        let onward = |u, v| !side_from_middle(inner, target, u, v).is_negative();
        met += u32::from(onward(x, y) && onward(y, z) && onward(z, x));
    }
    ensure(met == 1, Rule::Hull, || ("a hull around its inside once", format!("{met} times")))
}

/// That the hull is convex at the edge opposite corner k of a ghost's facet; k is not the infinite vertex.
pub fn check_convex(mesh: &Complex, ghost: u32, k: usize) -> Checked {
    let cell = mesh.cell(ghost);
    // A positive ghost is (facet turned outwards, infinite vertex).
    let Some(infinite) = cell.find(INFINITE) else {
        return broken(Rule::Hull, "a facet of the hull", format!("{:?}", cell.tuple()));
    };
    let facet = cell.facet(infinite);
    let e = mesh.apex(cell.beyond[k]);
    if e == INFINITE || facet.contains(&e) {
        return broken(Rule::Hull, "two facets at an edge of the hull", format!("{:?}", cell.tuple()));
    }
    let [x, y, z] = facet.map(|v| mesh.at(v));
    let convex = match orient(x, y, z, mesh.at(e)) {
        Sign::Negative => true,
        Sign::Positive => false,
        Sign::Zero => {
            let [u, w] = match facet.iter().position(|&v| v == cell.v[k]) {
                Some(0) => [y, z],
                Some(1) => [z, x],
                _ => [x, y],
            };
            across(u, w, mesh.at(cell.v[k]), mesh.at(e))
        }
    };
    ensure(convex, Rule::Hull, || {
        ("a convex hull", format!("vertex {:?} beyond {:?}", super::complex::id(e), cell.tuple()))
    })
}

/// Whether q is in conflict with a tetrahedron, as far as ties are told.
pub fn conflict(mesh: &Complex, c: u32, q: u32, ties: Ties) -> bool {
    let (t, q) = (mesh.corners(c), mesh.point(q));
    match ties {
        Ties::Free => side(&t, &q).is_positive(),
        Ties::Broken => in_conflict(&t, &q),
    }
}

/// The Euler characteristic of a closed complex: vertices - edges + facets - cells, by counting. 0 for a sphere of dimension three.
pub fn euler_characteristic(mesh: &Complex) -> i64 {
    let vertices = (0..mesh.vertex_count()).filter(|&v| mesh.cell_at(v) != super::complex::NONE).count() as i64;
    let mut start = vec![0u32; mesh.vertex_count() as usize + 1];
    let pairs = |c: u32| {
        let mut v = mesh.cell(c).v;
        v.sort_unstable();
        [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)].map(|(i, j): (usize, usize)| (v[i], v[j]))
    };
    let mut cells = 0;
    for c in mesh.cells() {
        cells += 1;
        pairs(c).iter().for_each(|p| start[p.0 as usize + 1] += 1);
    }
    for v in 1..start.len() {
        start[v] += start[v - 1];
    }
    let mut ends = vec![0u32; 6 * cells as usize];
    for c in mesh.cells() {
        for (u, w) in pairs(c) {
            ends[start[u as usize] as usize] = w;
            start[u as usize] += 1;
        }
    }
    let mut last = vec![super::complex::NONE; mesh.vertex_count() as usize];
    let (mut edges, mut from) = (0i64, 0);
    for (u, &to) in start[..start.len() - 1].iter().enumerate() {
        for &w in &ends[from..to as usize] {
            edges += i64::from(last[w as usize] != u as u32);
            last[w as usize] = u as u32;
        }
        from = to as usize;
    }
    // Each cell has four facets, each facet two cells.
    vertices - edges + 2 * cells - cells
}
