//! A session: a caller inserts points one after another, and a trace proves what becomes of them.

use super::codes::Floods;
use super::names::Names;
use super::triangulate::{placing, write_end, write_event};
use crate::arith::space::Kernel3;
use crate::domain::{Scale, normalise3_at};
use crate::model::{Triangulation3, VertexId, WeightedPoint};
use crate::refine::RunError;
use crate::trace::{Event3, Header3, Record, Record3, Sink};
use crate::triangulation::regular3::{Change, Regular3};

/// A triangulation of space that writes a trace of all that is done to it.
pub struct Session<'a, K: Kernel3> {
    triangulation: Regular3<K>,
    scale: Scale,
    names: Names,
    change: Change,
    floods: Floods,
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
        if self.triangulation.dimension() != before {
            self.names = Names::of(&self.triangulation);
            write_event(Event3::Raise { id, apexes: self.names.apexes.clone() }, self.sink)?;
        } else {
            let event = placing(&self.triangulation, &self.names, id, &self.change, &mut self.floods);
            write_event(event, self.sink)?;
        }
        Ok(id)
    }

    /// Ends the trace. Gives the triangulation in input units. Errors: those of the sink.
    pub fn finish(self) -> Result<Triangulation3, RunError> {
        let mut t = self.triangulation.to_triangulation();
        t.points.iter_mut().for_each(|p| *p = self.scale.to_input3(*p));
        write_end(&t, self.sink)?;
        Ok(t)
    }
}
