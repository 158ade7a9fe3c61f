//! From records to a verdict.

use super::claims;
use super::complex::{Complex, Kind, NONE, numbers};
use super::ledger::Ledger;
use super::promise::{self, Sector};
use super::replay::Replay;
use super::rows::Regions;
use super::scale::Scale;
use super::scale::power_of_two;
use super::sight::Search;
use super::space::Checker3;
use super::start::{self, Domain};
use super::strict::Strict;
use super::verdict::{Checked, Place, Rejection, Rule, Unchecked, Verdict, broken, ensure, placed};
use crate::model::{Choice, DiskChoice, GcdrParameters, Level, Point2, Region, Segment, Triangulation3};
use crate::trace::{Algorithm, End, Event, Header, Record, SkipReason};

/// What to check.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Also prove the choices: queue order, ties, parents, every constructed coordinate.
    pub strict: bool,
    /// Compare the digest of the mesh.
    pub digests: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options { strict: false, digests: true }
    }
}

/// Verifies a whole trace.
pub fn verify<'a>(records: impl IntoIterator<Item = &'a Record>, options: Options) -> Verdict {
    let mut checker = Checker::new(options);
    for record in records {
        if checker.push(record).is_err() {
            break;
        }
    }
    checker.finish()
}

/// What a checker knows of the mesh at a time.
pub(super) struct State<'a> {
    pub(super) mesh: &'a Complex,
    /// Input units = places times 2^`exponent`.
    pub(super) exponent: i32,
    pub(super) segments: &'a [Segment],
    pub(super) regions: &'a [Region],
}

/// Takes a trace record by record. Memory: the mesh.
#[derive(Clone, Debug)]
pub struct Checker {
    options: Options,
    stage: Stage,
    header: Option<Header>,
    domain: Domain,
    /// Coordinates of the input, input units.
    points: Vec<Point2>,
    mesh: Complex,
    announced: u32,
    last: Option<[u32; 3]>,
    scale: Scale,
    sectors: Vec<Sector>,
    replay: Option<Replay>,
    strict: Option<Strict>,
    events: u64,
    unchecked: Vec<Unchecked>,
    rejection: Option<Rejection>,
    /// Of a trace of space.
    space: Option<Box<Checker3>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    Fresh,
    Vertices,
    Segments,
    Holes,
    Regions,
    Start,
    Events,
    Ended,
}

impl Checker {
    /// A checker that expects a header.
    pub fn new(options: Options) -> Checker {
        Checker {
            options,
            stage: Stage::Fresh,
            header: None,
            domain: Domain::default(),
            points: Vec::new(),
            mesh: Complex::default(),
            announced: 0,
            last: None,
            scale: Scale::default(),
            sectors: Vec::new(),
            replay: None,
            strict: None,
            events: 0,
            unchecked: Vec::new(),
            rejection: None,
            space: None,
        }
    }

    /// Takes the next record. After a rejection nothing more is looked at.
    pub fn push(&mut self, record: &Record) -> Result<(), &Rejection> {
        if let (Record::Space(record), None) = (record, &self.rejection)
            && self.stage == Stage::Fresh
        {
            let space = self.space.get_or_insert_with(|| Box::new(Checker3::new(self.options)));
            self.rejection = space.push(record).err();
        } else if self.rejection.is_none() {
            let place = match record {
                Record::Header(_) => Place::Header,
                Record::Vertex { .. } | Record::Segment(_) | Record::Hole(_) | Record::Region(_) => Place::Domain,
                Record::Start { .. } | Record::Triangle(_) => Place::Start,
                Record::Event(_) => Place::Event(self.events),
                Record::End(_) | Record::Space(_) => Place::End,
            };
            if let Err(b) = self.take(record) {
                // A removal is judged when its split comes; the replay knows its number.
                let place = match (&self.replay, place) {
                    (Some(replay), Place::Event(_)) if self.stage == Stage::Events => Place::Event(replay.event),
                    _ => place,
                };
                self.rejection = Some(placed(b, place));
            }
        }
        self.rejection.as_ref().map_or(Ok(()), Err)
    }

    /// The triangulation after the last record of a trace of space, input units.
    pub fn triangulation(&self) -> Option<Triangulation3> {
        self.space.as_ref().map(|space| space.triangulation())
    }

    /// Whether no point of a trace of space waits for the event that places it or takes it out: `triangulation` is that of all points so far.
    pub fn is_settled(&self) -> bool {
        self.space.as_ref().is_none_or(|space| space.is_settled())
    }

    /// What the replay has come to, for `snapshot`.
    pub(super) fn state(&self) -> State<'_> {
        let (mesh, segments) = match &self.replay {
            Some(replay) => (&replay.mesh, &replay.ledger.segments),
            None => (&self.mesh, &self.domain.segments),
        };
        State { mesh, exponent: self.scale.exponent, segments, regions: &self.domain.regions }
    }

    /// The sectors of the input inside the region.
    pub(super) fn sectors(&self) -> &[Sector] {
        &self.sectors
    }

    /// The verdict. A trace without its end is rejected.
    pub fn finish(mut self) -> Verdict {
        if let Some(rejection) = self.rejection {
            return Verdict::Rejected(rejection);
        }
        if let Some(space) = self.space.as_ref().filter(|space| space.ended()) {
            return Verdict::Accepted { events: space.events(), unchecked: Vec::new() };
        }
        if self.stage != Stage::Ended {
            let b = super::verdict::Broken {
                rule: Rule::Stream,
                expected: "an end record".into(),
                found: "a truncated trace".into(),
            };
            return Verdict::Rejected(placed(b, Place::End));
        }
        self.unchecked.sort_unstable_by_key(|u| (u.rule, u.reason));
        self.unchecked.dedup();
        Verdict::Accepted { events: self.events, unchecked: self.unchecked }
    }

    fn take(&mut self, record: &Record) -> Checked {
        match record {
            _ if self.space.is_some() => broken(Rule::Stream, "a record of space", "one of the plane"),
            Record::Header(header) => {
                self.once(Stage::Vertices)?;
                self.advance(Stage::Fresh, Stage::Vertices)?;
                check_header(header)?;
                self.domain.fill = header.fill;
                self.header = Some(header.clone());
                Ok(())
            }
            Record::Vertex { at, .. } => {
                self.advance(Stage::Vertices, Stage::Vertices)?;
                ensure(at.x.is_finite() && at.y.is_finite(), Rule::Coordinate, || {
                    ("a finite point", format!("{at:?}"))
                })?;
                ensure(self.points.len() < NONE as usize - 1, Rule::Domain, || ("fewer than 2^32 vertices", "more"))?;
                self.points.push(*at);
                Ok(())
            }
            Record::Segment(segment) => {
                self.advance(Stage::Vertices, Stage::Segments)?;
                let known = segment.ends.iter().all(|v| v.index() < self.points.len());
                ensure(known && segment.ends[0] != segment.ends[1], Rule::Domain, || {
                    ("two vertices of the input", format!("{:?}", segment.ends))
                })?;
                self.domain.segments.push(*segment);
                Ok(())
            }
            Record::Hole(hole) => {
                self.advance(Stage::Vertices, Stage::Holes)?;
                self.domain.holes.push(*hole);
                Ok(())
            }
            Record::Region(region) => {
                self.advance(Stage::Vertices, Stage::Regions)?;
                let bound = region.max_area.is_none_or(|a| a.is_finite() && a > 0.0);
                ensure(bound, Rule::Domain, || ("a positive area bound", format!("{:?}", region.max_area)))?;
                self.domain.regions.push(*region);
                Ok(())
            }
            Record::Start { triangles } => {
                self.once(Stage::Start)?;
                self.advance(Stage::Vertices, Stage::Start)?;
                self.announced = *triangles;
                self.scale_input()?;
                ensure(*triangles > 0, Rule::Triangulation, || ("a triangle", "none"))
            }
            Record::Triangle(t) => {
                self.advance(Stage::Start, Stage::Start)?;
                let t = numbers(*t);
                start::add_triangle(&mut self.mesh, t, self.last)?;
                self.last = Some(t);
                if self.mesh.slot_count() == self.announced as usize { self.begin() } else { Ok(()) }
            }
            Record::Event(event) => {
                self.advance(Stage::Events, Stage::Events)?;
                self.event(event)?;
                self.events += 1;
                Ok(())
            }
            Record::Space(_) => broken(Rule::Stream, "a record of the plane", "one of space"),
            Record::End(end) => {
                self.once(Stage::Ended)?;
                self.advance(Stage::Events, Stage::Ended)?;
                self.end(end)
            }
        }
    }

    /// Records stand in one order; `from` is the earliest stage in which this one may come. Header, start and end come once.
    fn advance(&mut self, from: Stage, to: Stage) -> Checked {
        ensure(from <= self.stage && self.stage <= to, Rule::Stream, || {
            (
                "header, vertices, segments, holes, regions, start, triangles, events, end",
                format!("{to:?} after {:?}", self.stage),
            )
        })?;
        self.stage = to;
        Ok(())
    }

    /// That the stage a record opens is not yet open.
    fn once(&self, opened: Stage) -> Checked {
        ensure(self.stage < opened, Rule::Stream, || {
            (format!("one record that opens {opened:?}"), "another".to_string())
        })
    }

    /// Finds the power of two, and brings the input to it.
    fn scale_input(&mut self) -> Checked {
        let largest = self.points.iter().flat_map(|p| [p.x.abs(), p.y.abs()]).fold(0.0, f64::max);
        ensure((power_of_two(-870)..power_of_two(870)).contains(&largest), Rule::Domain, || {
            ("a size within 2^-870..2^870", format!("{largest:e}"))
        })?;
        // In [1/2, 1): the exponent of a normal f64, less the bias, plus one.
        self.scale = Scale { exponent: ((largest.to_bits() >> 52) as i32) - 1022 };
        for i in 0..self.points.len() {
            let at = self.scale.place(self.points[i])?;
            self.mesh.add_vertex(at, Kind::Input);
        }
        let down = power_of_two(-self.scale.exponent);
        let scaled = |p: Point2| Point2::new(p.x * down, p.y * down);
        self.domain.holes.iter_mut().for_each(|h| *h = scaled(*h));
        self.domain.regions.iter_mut().for_each(|r| *r = Region { seed: scaled(r.seed), ..*r });
        let seeds = self.domain.holes.iter().chain(self.domain.regions.iter().map(|r| &r.seed));
        let finite = |p: &Point2| p.x.is_finite() && p.y.is_finite();
        ensure({ seeds }.all(finite), Rule::Domain, || ("finite seeds", "one that is not"))
    }

    /// The initial triangulation is complete: proves it, carves it, and decides the level.
    fn begin(&mut self) -> Checked {
        self.stage = Stage::Events;
        start::check_start(&mut self.mesh, &self.domain.segments)?;
        // A plain triangulation keeps the whole hull.
        let Some(Header { algorithm: Algorithm::Gcdr(parameters), level, .. }) = &self.header else {
            return Ok(());
        };
        let mut search = Search::default();
        start::carve(&mut self.mesh, &self.domain, &mut search)?;
        start::check_bounded(&self.mesh)?;
        // `check_header` demands a level of every refinement.
        let level = level.unwrap_or(Level::Outside);
        let regions = Regions::new(parameters, level);
        self.sectors = promise::sectors(&self.mesh);
        let own = promise::level(parameters, regions.nominal, &self.mesh, &self.sectors);
        ensure(level == own, Rule::Level, || (format!("{own:?}"), format!("{level:?}")))?;
        let mesh = std::mem::take(&mut self.mesh);
        let apexes = promise::apexes(&mesh, &self.sectors);
        let segments = std::mem::take(&mut self.domain.segments);
        let bounds = self.domain.regions.iter().map(|r| r.max_area).collect();
        let ledger = Ledger::new(parameters.clone(), regions, segments, apexes, bounds);
        let replay = Replay::new(mesh, self.scale, search, ledger);
        self.strict = self.options.strict.then(|| Strict::new(&replay));
        self.replay = Some(replay);
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Checked {
        let Some(replay) = &mut self.replay else {
            return broken(Rule::Stream, "no events in a plain triangulation", format!("{event:?}"));
        };
        replay.event = self.events;
        if let Event::Skip { reason, .. } = event
            && !self.options.strict
        {
            let left = match reason {
                SkipReason::Resolution => Some("why a point cannot be represented is proved by strict verification"),
                SkipReason::SplitLimit { .. } => {
                    Some("which segment a skipped triangle would split is proved by strict verification")
                }
                SkipReason::InputAngle { .. } => None,
            };
            if let Some(reason) = left.filter(|&l| self.unchecked.iter().all(|u| u.reason != l)) {
                self.unchecked.push(Unchecked { rule: Rule::Skip, reason });
            }
        }
        if let Some(strict) = &mut self.strict {
            strict.before(replay, event)?;
        }
        replay.event(event)?;
        if !matches!(event, Event::Remove { .. }) {
            if let Some(strict) = &mut self.strict {
                strict.after(replay, event);
            }
            replay.created.clear();
        }
        Ok(())
    }

    fn end(&mut self, end: &End) -> Checked {
        let scale = power_of_two(self.scale.exponent);
        let at = |mesh: &Complex, v: u32| {
            let p = mesh.at(v);
            Point2::new(p.x * scale, p.y * scale)
        };
        let mesh = match &self.replay {
            Some(replay) => {
                if self.options.strict {
                    start::check_delaunay(&replay.mesh)?;
                }
                claims::check_end(replay, end)?;
                let level = effective_level(replay, &self.header, &self.sectors);
                ensure(end.level_effective == Some(level), Rule::Level, || {
                    (format!("effective level {level:?}"), format!("{:?}", end.level_effective))
                })?;
                let p = &replay.ledger.parameters;
                if p.size_function {
                    self.unchecked
                        .push(Unchecked { rule: Rule::F3, reason: "closure: sizes are those a function returned" });
                }
                if p.choice_a == DiskChoice::User || p.choice_b == Choice::User || p.choice_c == Choice::User {
                    self.unchecked.push(Unchecked {
                        rule: Rule::Choice,
                        reason: "closure: points are those a function returned",
                    });
                }
                &replay.mesh
            }
            None => {
                claims::check_outcome(end, 0)?;
                claims::check_counts(end, &self.mesh, Default::default())?;
                ensure(end.level_effective.is_none(), Rule::Level, || {
                    ("no level", format!("{:?}", end.level_effective))
                })?;
                claims::check_chains(&self.mesh, |s| self.domain.segments[s as usize].ends.map(|v| v.0), None)?;
                &self.mesh
            }
        };
        if self.options.digests {
            let own = claims::mesh_digest(mesh, |v| at(mesh, v));
            ensure(end.mesh == own, Rule::Digest, || (own.clone(), end.mesh.clone()))?;
        }
        Ok(())
    }
}

/// The level that the stored points have in effect. Source: `docs/trace-format.md`.
fn effective_level(replay: &Replay, header: &Option<Header>, sectors: &[Sector]) -> Level {
    let nominal = header.as_ref().and_then(|h| h.level).unwrap_or(Level::Outside);
    let regions = &replay.ledger.regions;
    if nominal == Level::Outside || !regions.left_nominal {
        nominal
    } else if !regions.left_slack {
        promise::level(&replay.ledger.parameters, regions.slack, &replay.mesh, sectors)
    } else {
        Level::Outside
    }
}

/// Parameters are finite and in range, and those that are not used are absent.
fn check_header(header: &Header) -> Checked {
    let Algorithm::Gcdr(p) = &header.algorithm else {
        return ensure(header.level.is_none(), Rule::Header, || {
            ("no level for a plain triangulation", format!("{:?}", header.level))
        });
    };
    ensure(header.level.is_some(), Rule::Header, || ("a level", "none"))?;
    let positive = |x: f64| x.is_finite() && x > 0.0;
    let fraction = |x: f64| positive(x) && x <= 1.0;
    let sane = positive(p.rho2)
        && [p.d1, p.d2, p.mu].into_iter().all(fraction)
        && p.kappa.is_none_or(positive)
        && p.max_area.is_none_or(positive);
    ensure(sane, Rule::Header, || ("rho2 > 0, d1, d2, mu in (0, 1], positive bounds", format!("{p:?}")))?;
    check_optional(p)
}

fn check_optional(p: &GcdrParameters) -> Checked {
    let offcenter = matches!(p.choice_a, DiskChoice::Offcenter | DiskChoice::ClampedOffcenter);
    let extreme = p.choice_a == DiskChoice::Extreme || [p.choice_b, p.choice_c].contains(&Choice::Extreme);
    let seeded = extreme && p.extreme == Some(crate::model::VertexOfTriangle::Seeded);
    let random = p.choice_a == DiskChoice::Random || [p.choice_b, p.choice_c].contains(&Choice::Random);
    let expected = [offcenter, extreme, seeded || random];
    let found = [p.kappa.is_some(), p.extreme.is_some(), p.seed.is_some()];
    ensure(expected == found, Rule::Header, || {
        (format!("kappa, extreme, seed present: {expected:?}"), format!("{found:?}"))
    })
}
