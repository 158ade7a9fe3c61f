//! The validators against damaged triangulations.

use super::*;

#[test]
fn validators_reject_what_is_wrong() {
    let mut draw = Draw(7);
    let points = family(0, 40, &mut draw);
    let segments = segments_among(&points, 15, &mut draw);
    let good = built(&points, &segments).unwrap();
    let inner = |m: &Cdt, constrained: bool| {
        let mut edges = m.triangles().flat_map(|t| m.edges(t));
        edges.find(|&e| m.twin(e).is_some() && m.is_constrained(e) == constrained).unwrap()
    };
    let broken = |damage: &dyn Fn(&mut Cdt)| {
        let mut m = good.clone();
        damage(&mut m);
        m
    };
    let links = |m: &Cdt| m.validate_links().unwrap_err();
    let plain = inner(&good, false);
    let fixed = inner(&good, true);
    let slot = |e: HalfEdge| ((e.0 >> 2) as usize, (e.0 & 3) as usize);

    let m = broken(&|m| m.slots[slot(plain).0].link[slot(plain).1] = store::Link::to(plain.0));
    assert!(matches!(links(&m), Violation::Link(..)));
    let m = broken(&|m| m.slots[slot(plain).0].link[slot(plain).1] = m.link(plain.0).constrained());
    assert!(matches!(links(&m), Violation::Link(..)));
    let m = broken(&|m| m.labels[slot(fixed).0][slot(fixed).1] += 1);
    assert!(matches!(links(&m), Violation::Link(..)));
    let m = broken(&|m| m.hints[3] = m.hints[4]);
    assert_eq!(links(&m), Violation::Hint(VertexId(3)));
    let m = broken(&|m| m.slots[0].v[1] = m.slots[0].v[0]);
    assert!(matches!(links(&m), Violation::Vertices(_)));
    let m = broken(&|m| m.free.push(0));
    assert!(matches!(links(&m), Violation::Free(_)));

    let m = broken(&|m| m.points.swap(0, 1));
    m.validate_links().unwrap();
    assert!(matches!(m.validate_orientation(), Err(Violation::Orientation(_))));

    // A segment forgotten shows unless its edge is Delaunay anyway: some is not.
    let mut shown = 0;
    for e in good.triangles().flat_map(|t| good.edges(t)).filter(|&e| good.is_constrained(e)) {
        let Some(f) = good.twin(e) else { continue };
        let m = broken(&|m| {
            m.slots[slot(e).0].link[slot(e).1] = store::Link::to(f.0);
            m.slots[slot(f).0].link[slot(f).1] = store::Link::to(e.0);
        });
        m.validate_links().unwrap();
        shown += usize::from(matches!(m.validate_delaunay(), Err(Violation::Delaunay(..))));
    }
    assert!(shown > 0);

    good.validate_hull().unwrap();
    let mut m = Cdt::delaunay(points.clone()).unwrap();
    let hull = m.triangles().flat_map(|t| m.edges(t)).find(|&e| m.twin(e).is_none()).unwrap();
    let t = m.triangle_of(hull);
    for e in m.edges(t) {
        if let Some(f) = m.twin(e) {
            m.slots[slot(f).0].link[slot(f).1] = store::Link::BORDER;
            let (u, v) = (m.origin(e).index(), m.origin(f).index());
            m.hints[u] = next_of(f);
            m.hints[v] = f.0;
        }
    }
    m.release_slot(t.0);
    assert!(matches!(m.validate_hull(), Err(Violation::Hull(_))));
}

fn next_of(e: HalfEdge) -> u32 {
    store::next(e.0)
}
