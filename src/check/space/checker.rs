//! From records of space to a verdict.

use super::certificate::euler_characteristic;
use super::claims::{self, Named};
use super::complex::number;
use super::replay::Replay;
use crate::check::checker::Options;
use crate::check::scale::power_of_two;
use crate::check::verdict::{Checked, Place, Rejection, Rule, broken, ensure, placed};
use crate::model::{Tetrahedron, Triangulation3, VertexId, WeightedPoint};
use crate::trace::{Apex, End3, Event3, Header3, Record3, apex_id};

/// Takes a trace of space record by record. Memory: the complex.
#[derive(Clone, Debug)]
pub struct Checker3 {
    options: Options,
    stage: Stage,
    permuted: bool,
    /// Input units = scaled units times 2 to this power.
    scale: i32,
    /// Where points stood in the input, if that is told.
    inputs: Vec<u32>,
    replay: Replay,
    apexes: Vec<crate::trace::Apex>,
    simplices_left: u32,
    last: Option<crate::model::Tetrahedron>,
    events: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    Fresh,
    Domain,
    Start,
    Events,
    Ended,
}

impl Checker3 {
    /// A checker that expects a header.
    pub fn new(options: Options) -> Checker3 {
        Checker3 {
            options,
            stage: Stage::Fresh,
            permuted: false,
            scale: 0,
            inputs: Vec::new(),
            replay: Replay::new(options.strict),
            apexes: Vec::new(),
            simplices_left: 0,
            last: None,
            events: 0,
        }
    }

    /// Events so far.
    pub fn events(&self) -> u64 {
        self.events
    }

    /// Whether no point waits for an event.
    pub fn is_settled(&self) -> bool {
        self.replay.pending.is_none() && self.replay.points.free.is_empty()
    }

    /// Whether the end was accepted.
    pub fn ended(&self) -> bool {
        self.stage == Stage::Ended
    }

    /// Takes the next record.
    pub fn push(&mut self, record: &Record3) -> Result<(), Rejection> {
        let place = match record {
            Record3::Header(_) => Place::Header,
            Record3::Vertex { .. } | Record3::Weight { .. } | Record3::Remove { .. } => Place::Domain,
            Record3::Start { .. } | Record3::Simplex(_) => Place::Start,
            Record3::Event(_) => Place::Event(self.events),
            Record3::End(_) => Place::End,
        };
        self.take(record).map_err(|b| placed(b, place))
    }

    /// The triangulation after the last record, input units; proved as far as the records were. Before the start, points are called by their ids.
    pub fn triangulation(&self) -> Triangulation3 {
        let inputs = if self.stage > Stage::Domain { &self.inputs[..] } else { &[] };
        Named::new(&self.replay, inputs).triangulation(|p| self.unscaled(p))
    }

    fn take(&mut self, record: &Record3) -> Checked {
        match record {
            Record3::Header(header) => self.header(header),
            Record3::Vertex { point, input } => self.vertex(*point, *input),
            Record3::Weight { id, weight } => self.weight(*id, *weight),
            Record3::Remove { id } => self.remove(*id),
            Record3::Start { apexes, simplices } => self.start(apexes, *simplices),
            Record3::Simplex(t) => self.simplex(*t),
            Record3::Event(event) => self.event(event),
            Record3::End(end) => self.end(end),
        }
    }

    fn header(&mut self, header: &Header3) -> Checked {
        self.at(Stage::Fresh, Stage::Fresh)?;
        let in_range = header.scale.abs() <= 870;
        ensure(in_range, Rule::Header, || ("a scale within 2^-870..2^870", format!("{}", header.scale)))?;
        (self.scale, self.permuted) = (header.scale, header.permuted);
        self.replay.weighted = header.weighted;
        self.stage = Stage::Domain;
        Ok(())
    }

    fn vertex(&mut self, point: WeightedPoint, input: Option<u32>) -> Checked {
        self.at(Stage::Domain, Stage::Events)?;
        ensure(self.stage != Stage::Start, Rule::Stream, || ("the rest of the simplices", "a vertex"))?;
        if self.stage == Stage::Events {
            self.replay.check_settled()?;
        }
        let sane = input.is_some() == self.permuted && (self.replay.weighted || point.weight == 0.0);
        ensure(sane, Rule::Header, || ("weights and places in the input as the header says", format!("{point:?}")))?;
        let few = self.replay.points.len() < i32::MAX as usize - 4;
        ensure(few, Rule::Domain, || ("fewer than 2^31 points", "more"))?;
        let scaled = self.scaled(point)?;
        // Before the start places come in any order.
        let next = self.replay.points.len() as u32;
        let in_turn = self.stage == Stage::Domain || input.is_none_or(|k| k == next);
        ensure(in_turn, Rule::Domain, || (format!("the next place in the input, {next}"), format!("{input:?}")))?;
        self.inputs.extend(input);
        self.replay.add_point(scaled);
        Ok(())
    }

    fn weight(&mut self, id: VertexId, weight: f64) -> Checked {
        self.at(Stage::Events, Stage::Events)?;
        self.replay.check_settled()?;
        ensure(self.replay.weighted, Rule::Header, || ("weights as the header says", "a weight"))?;
        self.check_known(id)?;
        let v = number(id);
        let point = WeightedPoint { weight, ..self.unscaled(self.replay.mesh.point(v)) };
        self.replay.reweigh(v, self.scaled(point)?.weight);
        Ok(())
    }

    fn remove(&mut self, id: VertexId) -> Checked {
        self.at(Stage::Events, Stage::Events)?;
        self.replay.check_settled()?;
        self.check_known(id)?;
        self.replay.pending = Some((number(id), None));
        Ok(())
    }

    fn start(&mut self, apexes: &[Apex], simplices: u32) -> Checked {
        self.at(Stage::Domain, Stage::Domain)?;
        self.check_inputs()?;
        self.stage = if simplices == 0 { Stage::Events } else { Stage::Start };
        let sane = if simplices == 0 { apexes.is_empty() } else { apexes.len() <= 3 };
        ensure(sane, Rule::Dimension, || {
            ("at most three apexes, and none without simplices", format!("{}", apexes.len()))
        })?;
        self.replay.mesh.make_room();
        self.apexes = apexes.to_vec();
        self.replay.set_apexes(apexes);
        self.simplices_left = simplices;
        Ok(())
    }

    fn simplex(&mut self, t: Tetrahedron) -> Checked {
        self.at(Stage::Start, Stage::Start)?;
        let own = &t[..4 - self.apexes.len()];
        let canonical = match own {
            [a, b, c, d] => a < b && b < c.min(d) && c != d,
            own => own.is_sorted_by(|a, b| a < b),
        };
        let filled = t[own.len()..].iter().zip(0..).all(|(v, k)| *v == apex_id(k))
            && own.iter().all(|v| v.index() < self.replay.points.len());
        ensure(canonical && filled && self.last.is_none_or(|l| l < t), Rule::Canonical, || {
            ("canonical simplices, ascending", format!("{t:?}"))
        })?;
        self.last = Some(t);
        self.replay.add_simplex(t)?;
        self.simplices_left -= 1;
        if self.simplices_left > 0 {
            return Ok(());
        }
        self.stage = Stage::Events;
        self.replay.prove(&self.apexes)
    }

    fn end(&mut self, end: &End3) -> Checked {
        self.at(Stage::Events, Stage::Events)?;
        self.stage = Stage::Ended;
        self.replay.check_settled()?;
        claims::check_points(&self.replay)?;
        let named = Named::new(&self.replay, &self.inputs);
        let own = claims::counts(&self.replay, named.len());
        ensure(end.counts == own, Rule::Counts, || (format!("{own:?}"), format!("{:?}", end.counts)))?;
        if self.options.strict {
            let euler = if self.replay.is_empty() { 0 } else { euler_characteristic(&self.replay.mesh) };
            ensure(euler == 0, Rule::Euler, || ("0", format!("{euler}")))?;
        }
        if self.options.digests {
            let own = named.digest(|p| self.unscaled(p));
            ensure(end.mesh == own, Rule::Digest, || (own.clone(), end.mesh.clone()))?;
        }
        Ok(())
    }

    /// That an id is one of a point, so that its number may be used as it is.
    fn check_known(&self, id: VertexId) -> Checked {
        let known = id.index() < self.replay.points.len();
        ensure(known, Rule::Domain, || ("a point of the trace", format!("{id:?}")))
    }

    fn event(&mut self, event: &Event3) -> Checked {
        self.at(Stage::Events, Stage::Events)?;
        let (id, other) = match event {
            Event3::Insert { id, .. } | Event3::Hide { id, .. } => (*id, *id),
            Event3::Duplicate { id, of } => (*id, *of),
            Event3::Succeed { id, by } => (*id, *by),
            Event3::Remove { id, .. } | Event3::Raise { id, .. } | Event3::Lower { id, .. } => (*id, *id),
        };
        self.check_known(id)?;
        self.check_known(other)?;
        self.replay.event(event)?;
        self.events += 1;
        Ok(())
    }

    /// Records stand in one order.
    fn at(&mut self, from: Stage, to: Stage) -> Checked {
        ensure(from <= self.stage && self.stage <= to, Rule::Stream, || {
            ("header, vertices, start, simplices, events, end", format!("a record of {from:?} at {:?}", self.stage))
        })
    }

    /// The places in the input are those of a permutation.
    fn check_inputs(&self) -> Checked {
        let mut seen = vec![false; self.inputs.len()];
        for &k in &self.inputs {
            match seen.get_mut(k as usize) {
                Some(first @ false) => *first = true,
                _ => return broken(Rule::Domain, "each place in the input once", format!("{k}")),
            }
        }
        Ok(())
    }

    /// A stored point, scaled: no -0, of full precision, in range.
    fn scaled(&self, p: WeightedPoint) -> Checked<WeightedPoint> {
        let (down, up) = (power_of_two(-self.scale), power_of_two(self.scale));
        let scaled = WeightedPoint { at: p.at * down, weight: p.weight * down * down };
        let sane = |x: f64, s: f64, back: f64, least: i32, greatest: i32| {
            let in_range = s == 0.0 || (power_of_two(least)..=power_of_two(greatest)).contains(&s.abs());
            x.is_finite() && in_range && back == x && x.to_bits() != (-0.0f64).to_bits()
        };
        let coordinates = p.at.to_array().into_iter().zip(scaled.at.to_array());
        let good = coordinates.into_iter().all(|(x, s)| sane(x, s, s * up, -142, 200));
        ensure(good && sane(p.weight, scaled.weight, scaled.weight * up * up, -284, 400), Rule::Coordinate, || {
            (
                "coordinates within 2^-142..2^200 of the input's size, weights within the squares of that, or +0",
                format!("{p:?}"),
            )
        })?;
        Ok(scaled)
    }

    /// The way back, exact.
    fn unscaled(&self, p: WeightedPoint) -> WeightedPoint {
        let up = power_of_two(self.scale);
        WeightedPoint { at: p.at * up, weight: p.weight * up * up }
    }
}
