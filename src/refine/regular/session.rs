//! A session: a caller inserts points, takes them out and changes their weights, and a trace proves what becomes of them.

use super::codes::{Floods, filling};
use super::names::Names;
use super::triangulate::{placing, write_end, write_event};
use crate::arith::space::Kernel3;
use crate::domain::{Scale, normalise3_at};
use crate::model::{PointState, Triangulation3, VertexId, WeightedPoint};
use crate::refine::RunError;
use crate::trace::{Event3, Header3, Record, Record3, Sink};
use crate::triangulation::regular3::{Change, Regular3};
use std::collections::BTreeMap;

/// A triangulation of space that writes a trace of all that is done to it.
pub struct Session<'a, K: Kernel3> {
    triangulation: Regular3<K>,
    scale: Scale,
    names: Names,
    change: Change,
    floods: Floods,
    /// The duplicates of a point, ascending.
    twins: BTreeMap<VertexId, Vec<VertexId>>,
    sink: &'a mut dyn Sink,
}

impl<'a, K: Kernel3> Session<'a, K> {
    /// A session without points. Coordinates are divided by 2 to the power `scale`, which is best such that none is 1 or larger then.
    ///
    /// Errors: those of the sink.
    pub fn new(scale: i32, sink: &'a mut dyn Sink) -> Result<Self, RunError> {
        sink.record(&Record::Space(Record3::Header(Header3 { weighted: true, permuted: false, scale })))?;
        sink.record(&Record::Space(Record3::Start { apexes: Vec::new(), simplices: 0 }))?;
        Ok(Session {
            triangulation: Regular3::new(),
            scale: Scale { exponent: scale },
            names: Names::default(),
            change: Change::default(),
            floods: Floods::default(),
            twins: BTreeMap::new(),
            sink,
        })
    }

    /// The triangulation, in coordinates divided by 2 to the power of the scale.
    pub fn triangulation(&self) -> &Regular3<K> {
        &self.triangulation
    }

    /// Inserts a point, input units; it gets the next id. Errors: `Range`, with the session as it was; `Io`.
    pub fn insert(&mut self, p: WeightedPoint) -> Result<VertexId, RunError> {
        let next = VertexId(self.triangulation.point_count() as u32);
        let normal = normalise3_at(p, next, self.scale).map_err(|finding| RunError::Range(vec![*finding]))?;
        let point = self.scale.to_input3(normal);
        self.sink.record(&Record::Space(Record3::Vertex { point, input: None }))?;
        let before = self.triangulation.dimension();
        let id = self.triangulation.insert(normal, &mut self.change);
        self.write_placing(id, before)?;
        Ok(id)
    }

    /// Takes a point out; one that was taken out before stays so. Errors: those of the sink.
    pub fn remove(&mut self, v: VertexId) -> Result<(), RunError> {
        if self.triangulation.state(v) != PointState::Removed {
            self.sink.record(&Record::Space(Record3::Remove { id: v }))?;
        }
        self.take_out(v)
    }

    /// Gives a point another weight, input units; one that was taken out comes back. Errors: `Range`, with the session as it was; `Io`.
    pub fn set_weight(&mut self, v: VertexId, weight: f64) -> Result<(), RunError> {
        let at = self.scale.to_input3(self.triangulation.point(v)).at;
        let normal =
            normalise3_at(WeightedPoint { at, weight }, v, self.scale).map_err(|f| RunError::Range(vec![*f]))?;
        let weight = self.scale.to_input3(normal).weight;
        self.sink.record(&Record::Space(Record3::Weight { id: v, weight }))?;
        self.take_out(v)?;
        self.triangulation.assign_weight(v, normal.weight);
        self.put_back(v)
    }

    /// Takes a point out, and puts back what it has hidden.
    fn take_out(&mut self, v: VertexId) -> Result<(), RunError> {
        let (state, before) = (self.triangulation.state(v), self.triangulation.dimension());
        self.change.clear();
        let homeless = self.triangulation.take_out(v, &mut self.change);
        let heir = self.twins.get(&v).and_then(|twins| twins.first().copied());
        let event = match (state, heir) {
            (PointState::Removed, _) => return Ok(()),
            (PointState::Duplicate { of }, _) => {
                self.drop_twin(of, v);
                Event3::Remove { id: v, created: Vec::new() }
            }
            (_, Some(by)) => {
                let mut twins = self.twins.remove(&v).unwrap_or_default();
                twins.remove(0);
                if !twins.is_empty() {
                    self.twins.insert(by, twins);
                }
                Event3::Succeed { id: v, by }
            }
            (PointState::Hidden, None) => Event3::Remove { id: v, created: Vec::new() },
            (PointState::Vertex, None) if self.triangulation.dimension() != before => {
                self.names = Names::of(&self.triangulation);
                Event3::Lower { id: v, apexes: self.names.apexes.clone() }
            }
            (PointState::Vertex, None) => {
                let star: Vec<_> = self.change.destroyed.iter().map(|c| self.names.corners(*c)).collect();
                let made = self.change.created.iter().map(|&c| self.names.corners(self.triangulation.vertices(c)));
                Event3::Remove { id: v, created: filling(v, &star, &made.collect::<Vec<_>>()) }
            }
        };
        write_event(event, self.sink)?;
        // Those that stay hidden do so without a word, before others come back.
        let free: Vec<_> = homeless.iter().copied().filter(|&h| !self.stays_hidden(h)).collect();
        for &h in homeless.iter().filter(|h| !free.contains(h)) {
            self.triangulation.put_back(h, &mut self.change);
        }
        free.into_iter().try_for_each(|h| self.put_back(h))
    }

    /// Whether a point that lost its cell is hidden as it is: in a tetrahedron, and in no conflict with it.
    fn stays_hidden(&self, h: VertexId) -> bool {
        let (t, p) = (&self.triangulation, self.triangulation.point(h));
        if t.dimension().is_none() || (t.dimension() != Some(3) && !self.names.is_flat(t, p.at)) {
            return false;
        }
        let c = t.locate(p.at).filter(|&c| t.is_finite(c));
        c.is_some_and(|c| !K::in_conflict3(self.names.places(t, c), p))
    }

    /// Puts a point back that was taken out or has lost its cell.
    fn put_back(&mut self, v: VertexId) -> Result<(), RunError> {
        let before = self.triangulation.dimension();
        self.change.clear();
        self.triangulation.put_back(v, &mut self.change);
        if let Some(of) = self.replaced(v, before) {
            let mut twins = self.twins.remove(&of).unwrap_or_default();
            twins.insert(0, of);
            twins.extend(self.twins.remove(&v).unwrap_or_default());
            twins.sort_unstable();
            self.twins.insert(v, twins);
            return Ok(write_event(Event3::Duplicate { id: v, of }, self.sink)?);
        }
        self.write_placing(v, before)
    }

    /// The point of the same place and weight that stood where v does now, having come back with a smaller id.
    fn replaced(&self, v: VertexId, before: Option<u8>) -> Option<VertexId> {
        let t = &self.triangulation;
        let moved = t.dimension() != before || !self.change.destroyed.is_empty();
        if moved || matches!(t.state(v), PointState::Duplicate { .. } | PointState::Removed) {
            return None;
        }
        // Only for points that come back are all others looked at.
        let known = |u: VertexId| self.twins.get(&v).is_some_and(|twins| twins.contains(&u));
        let ids = (v.0 + 1..t.point_count() as u32).map(VertexId);
        ids.into_iter().find(|&u| t.state(u) == PointState::Duplicate { of: v } && !known(u))
    }

    fn drop_twin(&mut self, of: VertexId, v: VertexId) {
        if let Some(twins) = self.twins.get_mut(&of) {
            twins.retain(|&t| t != v);
            if twins.is_empty() {
                self.twins.remove(&of);
            }
        }
    }

    /// Says what became of a point that was just placed.
    fn write_placing(&mut self, id: VertexId, before: Option<u8>) -> Result<(), RunError> {
        if self.triangulation.dimension() != before {
            self.names = Names::of(&self.triangulation);
            write_event(Event3::Raise { id, apexes: self.names.apexes.clone() }, self.sink)?;
            return Ok(());
        }
        if let PointState::Duplicate { of } = self.triangulation.state(id) {
            let twins = self.twins.entry(of).or_default();
            twins.insert(twins.partition_point(|&t| t < id), id);
        }
        let event = placing(&self.triangulation, &self.names, id, &self.change, &mut self.floods);
        Ok(write_event(event, self.sink)?)
    }

    /// Ends the trace. Gives the triangulation in input units. Errors: those of the sink.
    pub fn finish(self) -> Result<Triangulation3, RunError> {
        let mut t = self.triangulation.to_triangulation();
        t.points.iter_mut().for_each(|p| *p = self.scale.to_input3(*p));
        write_end(&t, self.sink)?;
        Ok(t)
    }
}
