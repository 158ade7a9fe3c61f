//! GCDR: constrained Delaunay refinement with selection regions. Source: \[GCDR\] Algorithm 2, section 3.
//!
//! While a bad triangle exists, a Steiner point is chosen in its selection disk (Type-A). If a constraint hides it, that
//! subsegment is split instead (Type-B, or Type-C where a vertex that stays is seen in its diametral disk), after the free vertices seen there are
//! deleted.
//!
//! Choice 1 (`shells`): subsegments at a small input angle are split on concentric shells.
//! Choice 2 (`queue`): the order of bad triangles. Choice 3 (`choose`): the points. Choice 4 (`split`): what is deleted.
//! Departure 1: a global budget; on exhaustion the mesh so far is returned as `stopped`.
//! Departure 2: points are rounded once; where that bites, the triangle is skipped, nothing else changes (`Resolution`).
//! Departure 3: triangles above an area or size bound are bad too, after the skinny ones.
//! Known weakness: outside the graded level termination is not proven; budgets stay on.

mod bad;
mod choose;
pub(in crate::refine) mod output;
mod params;
mod queue;
mod region;
pub(crate) mod shells;
mod split;

use super::level::{Sector, level_of, sectors_of};
use super::run::{Options, Run, RunError, Unmet};
use crate::arith::{Kernel, scale};
use crate::domain::{Scale, normalise};
use crate::model::words::counted;
use crate::model::{
    Fill, GcdrParameters, Level, Lines, Point2, Pslg, SegmentId, SmallAngles, Triangle, VertexId, VertexKind,
    canonical_triangle,
};
use crate::trace::{Cause, Counts, End, Event, Outcome, Record, Shell, Sink, SkipReason, SplitKind, Why, mesh_digest};
use crate::triangulation::cdt2::{Cdt2, Change, HalfEdge, TriId, Walk};
use choose::{Draws, ordered, type_a};
use output::{add_hull, canonical_triangles, mesh_of, write_head};
pub use params::everyday;
use params::{area_bounds, validate};
use queue::{Bad, Queue};
use region::{Stray, slackened};
use split::Split;

/// How many events pass between two looks at the clock.
const STOP_INTERVAL: u64 = 64;

/// What the refiner knows of a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Input,
    Free,
    Segment { segment: SegmentId, rung: Option<Rung> },
}

/// The nominal distance of a vertex on a segment from the apex at its end: what it would be without rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rung {
    apex: VertexId,
    distance: f64,
}

/// The state of a run.
struct Refiner<'a, 'o, K: Kernel> {
    cdt: Cdt2<K>,
    scale: Scale,
    params: GcdrParameters,
    /// Area bounds by region label, normalised; `None`: no bound.
    area_bounds: Vec<Option<f64>>,
    /// Sectors of the input, for levels.
    sectors: Vec<Sector>,
    /// Ends of the input segments.
    segments: Vec<[VertexId; 2]>,
    options: &'a mut Options<'o>,
    sink: &'a mut dyn Sink,
    kinds: Vec<Kind>,
    apexes: Vec<bool>,
    splits: Vec<u32>,
    skinny: Queue,
    oversized: Queue,
    current: Option<Bad>,
    skipped: Vec<(Bad, SkipReason)>,
    stray: Stray,
    change: Change,
    fresh: Vec<(TriId, u32)>,
    flood_marks: Vec<u32>,
    flood_number: u32,
    events: u64,
    step: u32,
    counts: Counts,
}

/// Refines the region of a repaired graph (`domain::prepare`) and writes the trace of it.
///
/// The trace is complete whenever `Ok` is returned, also when the run was stopped. Errors: see `RunError`.
pub fn run<K: Kernel>(
    pslg: &Pslg,
    params: &GcdrParameters,
    options: &mut Options<'_>,
    sink: &mut dyn Sink,
) -> Result<Run, RunError> {
    validate(params, options)?;
    let Initial { pslg, scale, cdt, start } = Initial::<K>::of(pslg)?;
    let sectors = sectors_of(&cdt);
    let level = level_of(params, &sectors);
    let area_bounds = area_bounds(&pslg, params, scale)?;
    write_head(&pslg, params, level, &start, sink)?;
    let mut refiner = Refiner {
        kinds: vec![Kind::Input; cdt.vertex_count()],
        splits: vec![0; pslg.segments.len()],
        segments: pslg.segments.iter().map(|s| s.ends).collect(),
        area_bounds,
        cdt,
        scale,
        sectors,
        options,
        sink,
        apexes: Vec::new(),
        skinny: Queue::new(params.order),
        oversized: Queue::new(params.order),
        params: params.clone(),
        current: None,
        skipped: Vec::new(),
        stray: match level {
            Level::Outside => Stray::Outside,
            _ => Stray::Exact,
        },
        change: Change::default(),
        fresh: Vec::new(),
        flood_marks: Vec::new(),
        flood_number: 0,
        events: 0,
        step: 0,
        counts: Counts::default(),
    };
    if params.small_angles == SmallAngles::Shells {
        refiner.find_apexes();
    }
    refiner.fresh = refiner.cdt.triangles().map(|t| (t, 0)).collect();
    refiner.classify_fresh()?;
    let stop_reason = refiner.refine()?;
    refiner.finish(&pslg, level, stop_reason)
}

/// What a run starts from.
struct Initial<K: Kernel> {
    /// The domain; with `Fill::Convex` the edges of the hull are segments.
    pslg: Pslg,
    scale: Scale,
    /// The constrained Delaunay triangulation of the region.
    cdt: Cdt2<K>,
    /// The triangles of that of the hull, canonical, ascending.
    start: Vec<Triangle>,
}

impl<K: Kernel> Initial<K> {
    fn of(pslg: &Pslg) -> Result<Self, RunError> {
        let (points, scale) = normalise(&pslg.points, &Lines::default()).map_err(RunError::Range)?;
        let mut pslg = pslg.clone();
        let mut cdt = Cdt2::<K>::delaunay(points)?;
        if pslg.fill == Fill::Convex {
            add_hull(&cdt, &mut pslg);
        }
        let segments: Vec<[VertexId; 2]> = pslg.segments.iter().map(|s| s.ends).collect();
        cdt.constrain(&segments)?;
        let start = canonical_triangles(&cdt);
        let toggles: Vec<bool> = pslg.segments.iter().map(|s| s.toggles).collect();
        let holes: Vec<Point2> = pslg.holes.iter().map(|&p| scale.to_normal(p)).collect();
        let regions = pslg.regions.iter().map(|r| scale.to_normal(r.seed));
        cdt.carve(pslg.fill, &toggles, &holes, &regions.collect::<Vec<_>>())?;
        Ok(Initial { pslg, scale, cdt, start })
    }
}

impl<K: Kernel> Refiner<'_, '_, K> {
    /// Algorithm 2. Returns what stopped it, `None` when no bad triangle is left to treat.
    fn refine(&mut self) -> Result<Option<String>, RunError> {
        while let Some(bad) = self.next_bad() {
            if self.events >= self.options.max_steps {
                return Ok(Some(format!("the budget of {} is spent", counted(self.options.max_steps, "step"))));
            }
            if self.events.is_multiple_of(STOP_INTERVAL)
                && let Some(stop) = &mut self.options.stop
                && let Some(reason) = stop()
            {
                return Ok(Some(reason));
            }
            match self.treat(&bad)? {
                None => self.current = Some(bad),
                Some(reason) => {
                    self.current = None;
                    self.emit(Event::Skip { t: bad.ids, cause: self.unscaled(bad.cause()), reason })?;
                    self.skipped.push((bad, reason));
                }
            }
            self.step += 1;
        }
        Ok(None)
    }

    /// One step for a bad triangle: an insertion, or the reason why there is none.
    fn treat(&mut self, bad: &Bad) -> Result<Option<SkipReason>, RunError> {
        let t = bad.t;
        if bad.cause() == Cause::Skinny
            && let Some(apex) = self.excusing_apex(t)
        {
            return Ok(Some(SkipReason::InputAngle { apex }));
        }
        let corners = bad.ids.map(|v| self.cdt.point(v));
        let Ok(a) = type_a::<K>(&self.params, bad.ids, corners, self.draws()) else {
            return Ok(Some(SkipReason::Resolution));
        };
        let a = self.user_disk(bad.ids, corners, a)?;
        if !K::in_circle(corners, a).is_positive() {
            return Ok(Some(SkipReason::Resolution));
        }
        match self.cdt.walk(t, a) {
            Walk::Reached => {
                self.note_disk(corners, a);
                self.insert_free(bad, a)?;
                Ok(None)
            }
            Walk::Blocked(e) => self.split(bad, e, a),
        }
    }

    /// Type-A: inserts a in place of the triangles it destroys.
    fn insert_free(&mut self, bad: &Bad, a: Point2) -> Result<(), RunError> {
        self.tick();
        let mut change = std::mem::take(&mut self.change);
        self.cdt.insert(bad.t, a, &mut change);
        self.kinds.push(Kind::Free);
        self.counts.type_a += 1;
        let why = Why::Free { cause: self.unscaled(bad.cause()) };
        self.record_insertion(a, why, change)?;
        self.classify_fresh()
    }

    /// Type-B or Type-C: splits the subsegment e that hides a from t.
    fn split(&mut self, bad: &Bad, e: HalfEdge, a: Point2) -> Result<Option<SkipReason>, RunError> {
        let s = ordered(self.cdt.origin(e), self.cdt.destination(e));
        // the walk ends at constrained edges only
        let segment = self.cdt.segment(e).unwrap_or_default();
        let near = self.non_free_near(s);
        let type_c = !near.is_empty();
        let (p, shell) = self.split_point(s, type_c)?;
        if self.params.max_splits.is_some_and(|limit| self.splits[segment.0 as usize] >= limit) {
            return Ok(Some(SkipReason::SplitLimit { segment }));
        }
        let ends = s.map(|v| self.cdt.point(v));
        if ends.contains(&p) {
            return Ok(Some(SkipReason::Resolution));
        }
        let doomed = self.doomed_by(s, p);
        let before = (self.events, self.fresh.len());
        let mut removals = Vec::new();
        self.cdt.checkpoint();
        for &w in &doomed {
            removals.push(self.delete(w));
        }
        let kind = match type_c {
            true => self.parent(s, p, near).map(|parent| SplitKind::C { parent }),
            false => Ok(SplitKind::B),
        };
        let (Ok(kind), true) = (kind, self.splits_properly(s, p)) else {
            self.cdt.rollback();
            self.events = before.0;
            self.fresh.truncate(before.1);
            return Ok(Some(SkipReason::Resolution));
        };
        self.cdt.commit();
        for removal in removals {
            self.sink.record(&Record::Event(removal))?;
        }
        self.counts.removed += doomed.len() as u32;
        self.insert_on_segment(bad, &Split { s, segment, kind, p, shell }, a)?;
        Ok(None)
    }

    /// Deletes a free vertex; the event is returned, since the split may yet be given up.
    fn delete(&mut self, w: VertexId) -> Event {
        self.tick();
        let mut change = std::mem::take(&mut self.change);
        self.cdt.remove(w, &mut change);
        let mut created: Vec<Triangle> =
            change.created.iter().map(|&t| canonical_triangle(self.cdt.vertices(t))).collect();
        created.sort_unstable();
        self.note_created(&change);
        self.change = change;
        self.events += 1;
        Event::Remove { id: w, created }
    }

    /// Replaces s by (u, p), (p, v) and the cavity on each side.
    fn insert_on_segment(&mut self, bad: &Bad, split: &Split, a: Point2) -> Result<(), RunError> {
        let &Split { s: [u, v], segment, kind, p, shell } = split;
        self.tick();
        let mut change = std::mem::take(&mut self.change);
        // s is a subsegment of the region: it has a triangle on one side at least
        if let Some(e) = self.cdt.find_edge(u, v).or_else(|| self.cdt.find_edge(v, u)) {
            self.cdt.split(e, p, &mut change);
        }
        self.note_interval([u, v], kind, p);
        let rung = self.rung([u, v], kind, shell);
        self.kinds.push(Kind::Segment { segment, rung });
        self.splits[segment.0 as usize] += 1;
        match kind {
            SplitKind::B => self.counts.type_b += 1,
            SplitKind::C { .. } => self.counts.type_c += 1,
        }
        let why = Why::Split {
            kind,
            s: [u, v],
            t: bad.ids,
            cause: self.unscaled(bad.cause()),
            a: self.scale.to_input(a),
            shell: shell.map(|Shell { apex, k }| Shell { apex, k: k + self.scale.exponent }),
        };
        self.record_insertion(p, why, change)?;
        self.classify_fresh()
    }

    fn record_insertion(&mut self, p: Point2, why: Why, mut change: Change) -> Result<(), RunError> {
        self.note_created(&change);
        let destroyed = std::mem::take(&mut change.destroyed);
        let event = Record::Event(Event::Insert { p: self.scale.to_input(p), why, destroyed });
        self.sink.record(&event)?;
        self.events += 1;
        if let Record::Event(Event::Insert { destroyed, .. }) = event {
            change.destroyed = destroyed;
        }
        self.change = change;
        Ok(())
    }

    fn emit(&mut self, event: Event) -> Result<(), RunError> {
        self.sink.record(&Record::Event(event))?;
        self.events += 1;
        Ok(())
    }

    /// Triangles created from now on belong to the next event.
    fn tick(&mut self) {
        self.cdt.set_clock(self.events as u32 + 1);
    }

    fn note_created(&mut self, change: &Change) {
        let birth = self.events as u32 + 1;
        self.fresh.extend(change.created.iter().map(|&t| (t, birth)));
    }

    fn draws(&self) -> Draws {
        Draws { seed: self.params.seed.unwrap_or(0), step: self.step }
    }

    fn unscaled(&self, cause: Cause) -> Cause {
        match cause {
            Cause::Size { h } => Cause::Size { h: scale::by_power_of_two(h, self.scale.exponent) },
            other => other,
        }
    }

    // The end.

    fn vertex_kinds(&self) -> Vec<VertexKind> {
        let public = |kind: &Kind| match *kind {
            Kind::Input => VertexKind::Input,
            Kind::Free => VertexKind::Free,
            Kind::Segment { segment, .. } => VertexKind::Segment(segment),
        };
        self.kinds.iter().map(public).collect()
    }

    fn finish(mut self, pslg: &Pslg, level: Level, stop_reason: Option<String>) -> Result<Run, RunError> {
        let level_effective = match self.stray {
            Stray::Exact => level,
            Stray::Rounded => {
                let params = &self.params;
                let [d1, d2, mu] = [params.d1, params.d2, params.mu].map(slackened);
                level.min(level_of(&GcdrParameters { d1, d2, mu, ..params.clone() }, &self.sectors))
            }
            Stray::Outside => Level::Outside,
        };
        let (mesh, dense) = mesh_of(&self.cdt, self.scale, &self.vertex_kinds(), pslg);
        let unmet: Vec<Unmet> = self
            .skipped
            .iter()
            .filter(|(bad, _)| self.lives(bad))
            .map(|(bad, reason)| Unmet {
                corners: bad.ids.map(|v| self.scale.to_input(self.cdt.point(v))),
                triangle: canonical_triangle(bad.ids.map(|v| VertexId(dense[v.index()]))),
                cause: self.unscaled(bad.cause()),
                reason: *reason,
            })
            .collect();
        self.counts.vertices = mesh.points.len() as u32;
        self.counts.triangles = mesh.triangles.len() as u32;
        self.counts.unmet = unmet.len() as u32;
        let outcome = match (&stop_reason, unmet.is_empty()) {
            (Some(_), _) => Outcome::Stopped,
            (None, true) => Outcome::Complete,
            (None, false) => Outcome::Holey,
        };
        self.sink.record(&Record::End(End {
            outcome,
            stop_reason: stop_reason.clone(),
            level_effective: Some(level_effective),
            counts: self.counts,
            mesh: mesh_digest(&mesh),
            trace: String::new(),
        }))?;
        Ok(Run { mesh, outcome, stop_reason, level, level_effective, counts: self.counts, unmet, events: self.events })
    }
}
