//! The triangulation of a point set, with its trace.

use super::codes::Floods;
use super::names::Names;
use crate::arith::space::Kernel3;
use crate::domain::{Scale, normalise3};
use crate::model::{
    PointSet3, PointState, Tetrahedron, Triangulation3, VertexId, WeightedPoint, canonical_tetrahedron,
};
use crate::refine::RunError;
use crate::trace::{Counts3, End3, Event3, Header3, Record, Record3, Sink, apex_id, triangulation_digest};
use crate::triangulation::regular3::{Change, Regular3};
use std::io;

/// What a trace of a triangulation proves it by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Certificate {
    /// The finished triangulation.
    #[default]
    Final,
    /// Every insertion.
    Steps,
}

/// Triangulates points of space, and writes the trace. Threads are used for a final certificate; the result is the same with any number.
///
/// Errors: `Range` for points that cannot be computed with, `Io` if the trace cannot be written.
pub fn triangulate3<K: Kernel3>(
    set: &PointSet3,
    certificate: Certificate,
    threads: usize,
    sink: &mut dyn Sink,
) -> Result<Triangulation3, RunError> {
    let (points, scale) = normalise3(set).map_err(RunError::Range)?;
    let triangulation = match certificate {
        Certificate::Final => finished::<K>(&points, scale, threads, sink)?,
        Certificate::Steps => stepwise::<K>(&points, scale, sink)?,
    };
    write_end(&triangulation, sink)?;
    Ok(triangulation)
}

fn finished<K: Kernel3>(
    points: &[WeightedPoint],
    scale: Scale,
    threads: usize,
    sink: &mut dyn Sink,
) -> io::Result<Triangulation3> {
    let t = Regular3::<K>::build(points, threads);
    let names = Names::of(&t);
    let mut triangulation = t.to_triangulation();
    write_header(points, false, scale, sink)?;
    triangulation.points.iter_mut().for_each(|p| *p = scale.to_input3(*p));
    for &point in &triangulation.points {
        sink.record(&Record::Space(Record3::Vertex { point, input: None }))?;
    }
    let apexes = names.apexes.clone();
    let simplices = triangulation.simplices().len() as u32;
    sink.record(&Record::Space(Record3::Start { apexes, simplices }))?;
    for simplex in triangulation.simplices() {
        sink.record(&Record::Space(Record3::Simplex(padded(simplex))))?;
    }
    for (id, &state) in (0..).map(VertexId).zip(&triangulation.states) {
        match state {
            PointState::Hidden => write_event(hiding(&t, &names, id), sink)?,
            PointState::Duplicate { of } => write_event(Event3::Duplicate { id, of }, sink)?,
            PointState::Vertex | PointState::Removed => {}
        }
    }
    Ok(triangulation)
}

fn stepwise<K: Kernel3>(points: &[WeightedPoint], scale: Scale, sink: &mut dyn Sink) -> io::Result<Triangulation3> {
    let order = Regular3::<K>::insertion_order(points);
    write_header(points, true, scale, sink)?;
    for &k in &order {
        let point = scale.to_input3(points[k as usize]);
        sink.record(&Record::Space(Record3::Vertex { point, input: Some(k) }))?;
    }
    let (mut t, mut change) = (Regular3::<K>::new(), Change::default());
    // The order begins with affinely independent points, as many as there are.
    let mut inserted = 0;
    let mut rest = order.iter();
    let mut pending = None;
    for &k in rest.by_ref() {
        let before = t.dimension();
        let id = t.insert(points[k as usize], &mut change);
        if t.dimension() == before {
            pending = Some(id);
            break;
        }
        inserted += 1;
    }
    let names = Names::of(&t);
    let apexes = names.apexes.clone();
    let simplices = u32::from(inserted > 0);
    sink.record(&Record::Space(Record3::Start { apexes, simplices }))?;
    if inserted > 0 {
        write_first(&t, &names, pending.map(|_| &change), sink)?;
    }
    let mut floods = Floods::default();
    if let Some(id) = pending {
        write_event(placing(&t, &names, id, &change, &mut floods), sink)?;
    }
    for &k in rest {
        let id = t.insert(points[k as usize], &mut change);
        write_event(placing(&t, &names, id, &change, &mut floods), sink)?;
    }
    let mut triangulation = named_by_input(t.to_triangulation(), &order);
    triangulation.points.iter_mut().for_each(|p| *p = scale.to_input3(*p));
    Ok(triangulation)
}

/// The first simplex: of the points before the pending one.
fn write_first<K: Kernel3>(
    t: &Regular3<K>,
    names: &Names,
    pending: Option<&Change>,
    sink: &mut dyn Sink,
) -> io::Result<()> {
    // If the pending insertion destroyed it, it is among what it destroyed.
    let size = 4 - names.apexes.len();
    let first =
        |v: &[VertexId; 4]| v.iter().filter(|v| v.index() < size).count() == size && v[3] != crate::trace::INFINITE;
    let destroyed = pending.and_then(|change| change.destroyed.iter().copied().find(first));
    let standing = || t.cells().map(|c| t.vertices(c)).find(first);
    // One of both: the simplex was made by the first insertions.
    let corners = destroyed.or_else(standing).unwrap_or_default();
    let mut tuple = canonical_tetrahedron(names.corners(corners));
    if size < 4 {
        tuple.sort_unstable();
    }
    sink.record(&Record::Space(Record3::Simplex(padded(&tuple[..size]))))
}

/// The event that says what became of the point inserted last.
pub(super) fn placing<K: Kernel3>(
    t: &Regular3<K>,
    names: &Names,
    id: VertexId,
    change: &Change,
    floods: &mut Floods,
) -> Event3 {
    match t.state(id) {
        PointState::Hidden => hiding(t, names, id),
        PointState::Duplicate { of } => Event3::Duplicate { id, of },
        PointState::Vertex | PointState::Removed => {
            let destroyed: Vec<_> = change.destroyed.iter().map(|v| names.corners(*v)).collect();
            let (first, flood) = floods.code(&destroyed);
            Event3::Insert { id, first, flood }
        }
    }
}

/// The event that says that a point is hidden.
pub(super) fn hiding<K: Kernel3>(t: &Regular3<K>, names: &Names, id: VertexId) -> Event3 {
    let cell = t.containing_cell_of_hidden(id).map(|c| names.last_around(t, c, id));
    // A hidden point is in a cell.
    Event3::Hide { id, cell: cell.unwrap_or_default() }
}

/// A simplex with its apexes behind it.
fn padded(simplex: &[VertexId]) -> Tetrahedron {
    let mut t = [VertexId(0); 4];
    t[..simplex.len()].copy_from_slice(simplex);
    t[simplex.len()..].iter_mut().zip(0..).for_each(|(v, k)| *v = apex_id(k));
    t
}

/// A triangulation of points in another order, named by the order of the input. Of the same points the first of the input stands for all.
fn named_by_input(t: Triangulation3, order: &[u32]) -> Triangulation3 {
    let mut name: Vec<u32> = order.to_vec();
    for (k, state) in t.states.iter().enumerate() {
        if let PointState::Duplicate { of } = state {
            name[of.index()] = name[of.index()].min(order[k]);
        }
    }
    let mut named = t.clone();
    for (k, (point, state)) in t.points.iter().zip(&t.states).enumerate() {
        let place = order[k] as usize;
        let stands = if let PointState::Duplicate { of } = state { of.index() } else { k };
        let first = name[stands];
        named.points[place] = *point;
        named.states[place] =
            if first == order[k] { t.states[stands] } else { PointState::Duplicate { of: VertexId(first) } };
    }
    let size = t.simplex_size().max(1);
    let mut simplices: Vec<Vec<VertexId>> = Vec::new();
    let mut cells: Vec<Tetrahedron> = Vec::new();
    for simplex in t.simplices() {
        let mut ids: Vec<VertexId> = simplex.iter().map(|v| VertexId(name[v.index()])).collect();
        match ids[..] {
            [a, b, c, d] => cells.push(canonical_tetrahedron([a, b, c, d])),
            _ => {
                ids.sort_unstable();
                simplices.push(ids);
            }
        }
    }
    simplices.sort_unstable();
    cells.sort_unstable();
    named.simplices = if size == 4 { cells.into_flattened() } else { simplices.concat() };
    named
}

fn write_header(points: &[WeightedPoint], permuted: bool, scale: Scale, sink: &mut dyn Sink) -> io::Result<()> {
    let weighted = points.iter().any(|p| p.weight != 0.0);
    sink.record(&Record::Space(Record3::Header(Header3 { weighted, permuted, scale: scale.exponent })))
}

pub(super) fn write_event(event: Event3, sink: &mut dyn Sink) -> io::Result<()> {
    sink.record(&Record::Space(Record3::Event(event)))
}

/// Writes the end of a trace.
pub(super) fn write_end(t: &Triangulation3, sink: &mut dyn Sink) -> io::Result<()> {
    let mut counts = Counts3 { simplices: t.simplices().len() as u32, ..Counts3::default() };
    for state in &t.states {
        match state {
            PointState::Vertex => counts.vertices += 1,
            PointState::Hidden => counts.hidden += 1,
            PointState::Duplicate { .. } => counts.duplicates += 1,
            PointState::Removed => counts.removed += 1,
        }
    }
    let end = End3 { counts, mesh: triangulation_digest(t), trace: String::new() };
    sink.record(&Record::Space(Record3::End(end)))
}
