//! The replay: one function per kind of event. Each proves the facts of its event and then changes the complex.
//!
//! Removals precede the split that justifies them, so they wait until it comes. An insertion's cavity is flooded anew and compared with
//! the list in the trace. That the new triangles tile the cavity: the cavity is a tree of triangles (edges on its rim = triangles + 2, less one
//! for each side of a split subsegment), and all new triangles are positively oriented, so the rim winds around p; it does so once, because the cavity covers no point twice.

use super::complex::{Complex, Kind, NONE, canonical, next, numbers, previous};
use super::condition::{
    Corners, compare_lengths, exceeds_area, exceeds_radius, in_circle, in_diametral_disk,
    in_selection_disk, in_selection_interval, is_at_distance, is_near_line, is_skinny,
    shortest_edge,
};
use super::rows::{self, Deltas, Regions};
use super::sight::{Aim, Arrival, Crossing, Search, walk};
use super::value::power_of_two;
use super::verdict::{Broken, Checked, Rule, broken, ensure};
use crate::model::{
    Choice, DeletionPolicy, DiskChoice, GcdrParameters, Point2, Segment, SegmentId, SmallAngles,
    Triangle, VertexId,
};
use crate::trace::{Cause, Counts, Event, Shell, SkipReason, SplitKind, Why};

/// The power of two that brings coordinates to [1/2, 1).
#[derive(Clone, Copy, Debug, Default)]
pub struct Scale {
    /// Input units = scaled units times 2^`exponent`.
    pub exponent: i32,
}

impl Scale {
    /// A stored point of an event, scaled: finite, no -0, of full precision, within 2^200.
    pub fn place(self, p: Point2) -> Checked<Point2> {
        let (down, up) = (power_of_two(-self.exponent), power_of_two(self.exponent));
        let scaled = Point2::new(p.x * down, p.y * down);
        for (x, s) in [(p.x, scaled.x), (p.y, scaled.y)] {
            let size = s.abs();
            let in_range = s == 0.0 || (power_of_two(-142)..=power_of_two(200)).contains(&size);
            let stored = x.is_finite() && s * up == x && x.to_bits() != (-0.0f64).to_bits();
            ensure(in_range && stored, Rule::Coordinate, || {
                (
                    "a coordinate within 2^-142..2^200 of the input's size, or +0",
                    format!("{x:?}"),
                )
            })?;
        }
        Ok(scaled)
    }
}

/// An edge of a cavity's rim, seen from the cavity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    pub(super) from: u32,
    pub(super) to: u32,
    /// The half-edge outside.
    pub(super) outer: u32,
    pub(super) segment: u32,
}

/// A removal that waits for its split: the vertex and its triangles in `Replay::filling`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    pub(super) vertex: u32,
    pub(super) event: u64,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// A split as the trace states it, places scaled.
#[derive(Clone, Copy, Debug)]
pub struct Split {
    /// The new vertex.
    pub p: Point2,
    /// Type.
    pub kind: SplitKind,
    /// The ends of the subsegment, the smaller first.
    pub ends: [u32; 2],
    /// The half-edge of the subsegment, seen from inside the region.
    pub s: u32,
    /// The bad triangle.
    pub t: u32,
    /// Why it is bad.
    pub cause: Cause,
    /// The rejected point.
    pub a: Point2,
    /// The parameters whose selection disk holds a.
    pub deltas: Option<Deltas>,
}

/// The state of a replay.
#[derive(Clone, Debug)]
pub struct Replay {
    /// The mesh.
    pub mesh: Complex,
    /// Parameters of the run.
    pub parameters: GcdrParameters,
    /// Selection regions, nominal and with slack.
    pub regions: Regions,
    /// Units.
    pub scale: Scale,
    /// Input segments.
    pub segments: Vec<Segment>,
    /// Area bound of each region seed.
    pub region_bounds: Vec<Option<f64>>,
    /// Input vertices that are an apex of shells.
    pub apexes: Vec<bool>,
    /// Rung of each vertex: its nominal distance, in input units, from the apex at an end of its segment.
    pub rungs: Vec<Option<(u32, f64)>>,
    /// Splits of each input segment.
    pub splits: Vec<u32>,
    /// Insertions by type, deletions.
    pub tally: Counts,
    /// Number of the event in hand.
    pub event: u64,
    /// Triangles created by the step in hand; some may be gone again.
    pub created: Vec<u32>,
    /// Searches.
    pub search: Search,
    pub(super) destroyed: Vec<u32>,
    pub(super) rim: Vec<Rim>,
    pub(super) stack: Vec<u32>,
    waiting: Vec<Waiting>,
    pub(super) filling: Vec<[u32; 3]>,
    expected_removals: Vec<u32>,
    pub(super) links: Vec<super::surgery::Link>,
}

impl Replay {
    /// A replay that begins with a carved initial triangulation.
    pub fn new(
        mesh: Complex,
        parameters: GcdrParameters,
        regions: Regions,
        scale: Scale,
        segments: Vec<Segment>,
    ) -> Replay {
        Replay {
            rungs: vec![None; mesh.vertices.len()],
            apexes: vec![false; mesh.vertices.len()],
            splits: vec![0; segments.len()],
            mesh,
            parameters,
            regions,
            scale,
            segments,
            region_bounds: Vec::new(),
            tally: Counts::default(),
            event: 0,
            created: Vec::new(),
            search: Search::default(),
            destroyed: Vec::new(),
            rim: Vec::new(),
            stack: Vec::new(),
            waiting: Vec::new(),
            filling: Vec::new(),
            expected_removals: Vec::new(),
            links: Vec::new(),
        }
    }

    /// The first removal that still waits for its split.
    pub fn first_waiting(&self) -> Option<u64> {
        self.waiting.first().map(|w| w.event)
    }

    // Facts used by several events.

    /// The triangle of an event; it is in the region.
    pub fn triangle(&self, t: Triangle) -> Checked<u32> {
        let corners = numbers(t);
        ensure(canonical(corners) == corners, Rule::Canonical, || {
            ("the smallest id first", format!("{corners:?}"))
        })?;
        match self
            .mesh
            .find_triangle(corners)
            .filter(|&t| !self.mesh.facts(t).outside)
        {
            Some(t) => Ok(t),
            None => broken(
                Rule::Exists,
                "a triangle of the mesh",
                format!("{corners:?}"),
            ),
        }
    }

    /// The area bound of a triangle, input units.
    pub fn area_bound(&self, t: u32) -> Option<f64> {
        let region = self.mesh.facts(t).region;
        let of_region = self.region_bounds.get(region as usize).copied().flatten();
        match (self.parameters.max_area, of_region) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// Whether the area of t exceeds its bound.
    pub fn is_too_large(&self, t: u32) -> bool {
        self.area_bound(t)
            .is_some_and(|b| exceeds_area(self.mesh.places(t), b, -2 * self.scale.exponent))
    }

    /// That t is bad for the cause named, and was not skipped for it.
    pub fn check_cause(&self, t: u32, cause: Cause) -> Checked {
        let corners = self.mesh.places(t);
        let facts = self.mesh.facts(t);
        let (bad, skipped) = match cause {
            Cause::Skinny => (
                is_skinny(corners, self.parameters.rho2),
                facts.skipped_skinny,
            ),
            Cause::Area => (self.is_too_large(t), facts.skipped_oversized),
            Cause::Size { h } => {
                ensure(
                    self.parameters.size_function && h.is_finite() && h > 0.0,
                    Rule::Cause,
                    || {
                        (
                            "a positive size, of a run with a size function",
                            format!("{h:?}"),
                        )
                    },
                )?;
                let bad = exceeds_radius(corners, h, -self.scale.exponent) && !self.is_too_large(t);
                (bad, facts.skipped_oversized)
            }
        };
        ensure(bad && !skipped, Rule::Cause, || {
            let found = if skipped {
                "one that was skipped for it"
            } else {
                "one that is not"
            };
            (
                format!("a triangle bad for {cause:?}"),
                format!("{found}: {:?}", self.mesh.corners(t)),
            )
        })
    }

    // Events.

    /// Takes one event. Removals only join the queue of those that wait.
    pub fn event(&mut self, event: &Event) -> Checked {
        if let (
            Event::Skip { .. }
            | Event::Insert {
                why: Why::Free { .. },
                ..
            },
            Some(first),
        ) = (event, self.first_waiting())
        {
            return broken(
                Rule::Removal,
                format!("the split that removal {first} is for"),
                "another event",
            );
        }
        match event {
            Event::Remove { id, created } => self.wait(*id, created),
            Event::Skip { t, cause, reason } => self.skip(*t, *cause, *reason),
            Event::Insert {
                p,
                why: Why::Free { cause },
                destroyed,
            } => self.insert_free(*p, *cause, destroyed),
            Event::Insert {
                p,
                why:
                    Why::Split {
                        kind,
                        s,
                        t,
                        cause,
                        a,
                        shell,
                    },
                destroyed,
            } => {
                let split = self.split_of(*p, *kind, s.map(|v| v.0), *t, *cause, *a)?;
                self.insert_on_segment(split, *shell, destroyed)
            }
        }
    }

    fn wait(&mut self, VertexId(vertex): VertexId, created: &[Triangle]) -> Checked {
        let free = self
            .mesh
            .vertices
            .get(vertex as usize)
            .is_some_and(|v| v.is_free());
        ensure(free, Rule::S2, || {
            ("a free vertex of the mesh", format!("vertex {vertex}"))
        })?;
        let ascending = self.waiting.last().is_none_or(|w| w.vertex < vertex);
        ensure(ascending, Rule::S2, || {
            (
                "removals in ascending order of ids",
                format!("vertex {vertex}"),
            )
        })?;
        let start = self.filling.len();
        self.filling.extend(created.iter().map(|&t| numbers(t)));
        self.waiting.push(Waiting {
            vertex,
            event: self.event,
            start,
            end: self.filling.len(),
        });
        Ok(())
    }

    fn skip(&mut self, t: Triangle, cause: Cause, reason: SkipReason) -> Checked {
        let t = self.triangle(t)?;
        self.check_cause(t, cause)?;
        match reason {
            SkipReason::Resolution => {}
            SkipReason::InputAngle { apex } => {
                ensure(
                    cause == Cause::Skinny && self.excuses(t, apex.0),
                    Rule::Skip,
                    || {
                        (
                            format!("a triangle made skinny by the angle at {}", apex.0),
                            format!("{:?}", self.mesh.corners(t)),
                        )
                    },
                )?;
            }
            SkipReason::SplitLimit {
                segment: SegmentId(segment),
            } => {
                let used = self.splits.get(segment as usize).copied();
                ensure(
                    used.is_some() && used == self.parameters.max_splits,
                    Rule::Skip,
                    || {
                        (
                            format!("a segment split {:?} times", self.parameters.max_splits),
                            format!("{used:?}"),
                        )
                    },
                )?;
            }
        }
        let facts = self.mesh.facts_mut(t);
        match cause {
            Cause::Skinny => facts.skipped_skinny = true,
            Cause::Area | Cause::Size { .. } => facts.skipped_oversized = true,
        }
        Ok(())
    }

    /// Whether the small angle at `apex` excuses the skinny triangle t. Source: `docs/trace-format.md`, shells.
    pub fn excuses(&self, t: u32, apex: u32) -> bool {
        if self.parameters.small_angles == SmallAngles::Off
            || !self.apexes.get(apex as usize).is_some_and(|&a| a)
        {
            return false;
        }
        let k = shortest_edge(self.mesh.places(t), self.mesh.corners(t)) as u32;
        let e = 4 * t + k;
        let (x, y) = (self.mesh.origin(e), self.mesh.target(e));
        let rung = |v: u32| self.rungs[v as usize].filter(|r| r.0 == apex);
        let on = |v: u32| self.mesh.vertices[v as usize].segment();
        if let (Some(k), Some(l), Some(a), Some(b)) = (rung(x), rung(y), on(x), on(y))
            && k == l
            && a != b
            && self.angle_below_60(apex, a, b)
        {
            return true;
        }
        let sides = [next(e), previous(e)].map(|e| self.mesh.segment(e));
        self.mesh.apex(e) == apex && !sides.contains(&NONE) && sides[0] != sides[1]
    }

    fn angle_below_60(&self, apex: u32, a: u32, b: u32) -> bool {
        let far = |s: u32| {
            let [u, v] = self.segments[s as usize].ends.map(|v| v.0);
            if u == apex { v } else { u }
        };
        let at = |v: u32| self.mesh.at(v);
        super::condition::is_below_60(at(apex), at(far(a)), at(far(b)))
    }

    fn insert_free(&mut self, p: Point2, cause: Cause, destroyed: &[Triangle]) -> Checked {
        let Some(&first) = destroyed.first() else {
            return broken(
                Rule::Flood,
                "the bad triangle first",
                "no destroyed triangle",
            );
        };
        let p = self.scale.place(p)?;
        let t = self.triangle(first)?;
        self.check_cause(t, cause)?;
        let corners = self.mesh.places(t);
        ensure(in_circle(corners, p).is_positive(), Rule::A1, || {
            (
                "a point strictly inside the circle of its triangle",
                format!("{p:?}"),
            )
        })?;
        self.check_users_disk(corners, p)?;
        let (ids, slack) = (self.mesh.corners(t), self.regions.disk(corners, p));
        let region = self.mesh.facts(t).region;
        let root = (0..3).find(|&k| ids[k as usize] == first[0].0).unwrap_or(0);
        self.begin_flood();
        self.flood_root(
            t,
            &[4 * t + root, next(4 * t + root), previous(4 * t + root)],
            p,
        );
        self.compare_flood(destroyed)?;
        self.check_star(p, 2)?;
        let v = self.mesh.add_vertex(p, Kind::Free);
        self.rungs.push(None);
        self.clear_cavity();
        let count = self.rim.len();
        self.fan(v, 0..count, region);
        let (first, last) = (
            self.created[self.created.len() - count],
            self.created[self.created.len() - 1],
        );
        self.mesh.join(4 * last + 1, 4 * first + 2, NONE);
        self.measure(v);
        self.tally.type_a += 1;
        rows::type_a(self, v, corners, ids, cause, slack)
    }

    /// Reads a split and proves what does not depend on the removals: t, a, the way from t to s, p in its interval.
    fn split_of(
        &mut self,
        p: Point2,
        kind: SplitKind,
        ends: [u32; 2],
        t: Triangle,
        cause: Cause,
        a: Point2,
    ) -> Checked<Split> {
        let (p, a) = (self.scale.place(p)?, self.scale.place(a)?);
        let t = self.triangle(t)?;
        self.check_cause(t, cause)?;
        let corners = self.mesh.places(t);
        ensure(in_circle(corners, a).is_positive(), Rule::A1, || {
            (
                "a rejected point strictly inside the circle of its triangle",
                format!("{a:?}"),
            )
        })?;
        self.check_users_disk(corners, a)?;
        let deltas = self.regions.disk_of_rejected(corners, a);
        let s = match walk(&self.mesh, t, a) {
            Arrival::Edge(s) => s,
            other => {
                return broken(
                    Rule::S1,
                    "a way that meets a constrained edge",
                    format!("{other:?}"),
                );
            }
        };
        let met = [self.mesh.origin(s), self.mesh.target(s)];
        ensure(
            [met[0].min(met[1]), met[0].max(met[1])] == ends,
            Rule::S1,
            || {
                (
                    format!("the first constrained edge met, {met:?}"),
                    format!("{ends:?}"),
                )
            },
        )?;
        Ok(Split {
            p,
            kind,
            ends,
            s,
            t,
            cause,
            a,
            deltas,
        })
    }

    fn insert_on_segment(
        &mut self,
        split: Split,
        shell: Option<Shell>,
        destroyed: &[Triangle],
    ) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let segment = self.mesh.segment(split.s);
        ensure(split.p != u && split.p != v, Rule::S2, || {
            (
                "a point off the ends of its subsegment",
                format!("{:?}", split.p),
            )
        })?;
        let within = self
            .parameters
            .max_splits
            .is_none_or(|limit| self.splits[segment as usize] < limit);
        ensure(within, Rule::S2, || {
            (
                format!("at most {:?} splits", self.parameters.max_splits),
                "one more",
            )
        })?;
        self.check_on_segment(&split)?;
        self.check_shell(&split, shell)?;
        let rung = self.rung(&split, shell);
        self.check_rung(&split, rung)?;
        self.check_users_interval(&split, shell)?;
        let slack = self.regions.interval(split.kind, [u, v], split.p);
        rows::before_split(self, &split)?;
        self.check_kind_and_removals(&split)?;
        let facts_of_t = (self.mesh.places(split.t), self.mesh.corners(split.t));
        self.apply_removals()?;
        if let SplitKind::C { parent } = split.kind {
            self.check_parent(&split, parent.0)?;
        }
        let p = self.split_edge(&split, destroyed)?;
        self.rungs.push(rung);
        self.splits[segment as usize] += 1;
        match split.kind {
            SplitKind::B => self.tally.type_b += 1,
            SplitKind::C { .. } => self.tally.type_c += 1,
        }
        rows::after_split(self, &split, p, facts_of_t, slack)
    }

    /// p is on its subsegment up to rounding: each coordinate within 2^-50 of the larger ones of the ends, half a unit in the last place being
    /// 2^-53 of them at most, so that a user's function may round a few times. 2^-140 covers coordinates that became 0.
    fn check_on_segment(&self, split: &Split) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let size = [u.x, u.y, v.x, v.y]
            .map(f64::abs)
            .into_iter()
            .fold(0.0, f64::max);
        let tolerance = size * power_of_two(-50) + power_of_two(-140);
        ensure(is_near_line(u, v, split.p, tolerance), Rule::S2, || {
            (
                "a point on its subsegment, up to rounding",
                format!("{:?} off {:?}", split.p, split.ends),
            )
        })
    }

    /// A user's Type-A point lies in its selection disk with slack at every level: the run ends if it does not.
    fn check_users_disk(&self, t: Corners, a: Point2) -> Checked {
        let free = self.parameters.choice_a != DiskChoice::User;
        ensure(
            free || in_selection_disk(t, self.regions.slack.d2, a),
            Rule::A2,
            || ("a point of the selection disk", format!("{a:?}")),
        )
    }

    /// A user's point on a segment lies in its selection interval with slack at every level.
    fn check_users_interval(&self, split: &Split, shell: Option<Shell>) -> Checked {
        let (p, slack) = (&self.parameters, self.regions.slack);
        let (choice, delta) = match split.kind {
            SplitKind::B => (p.choice_b, slack.d1),
            SplitKind::C { .. } => (p.choice_c, slack.mu),
        };
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let free = choice != Choice::User || shell.is_some();
        ensure(
            free || in_selection_interval(u, v, delta, split.p),
            Rule::S2,
            || {
                (
                    "a point of the selection interval",
                    format!("{:?}", split.p),
                )
            },
        )
    }

    /// The nominal distance of a rung is the distance, up to the roundings of it and of those it is halfway of: 2^-46 of the input's size.
    fn check_rung(&self, split: &Split, rung: Option<(u32, f64)>) -> Checked {
        let Some((apex, distance)) = rung else {
            return Ok(());
        };
        let (at, exponent) = (self.mesh.at(apex), -self.scale.exponent);
        let holds = is_at_distance(at, split.p, distance, exponent, power_of_two(-46));
        ensure(holds, Rule::Shell, || {
            (
                format!("a point {distance:e} from vertex {apex}"),
                format!("{:?} (scaled)", split.p),
            )
        })
    }

    /// The rung of a split point: 2^k on shell k, halfway between rungs of one apex for a midpoint, else none.
    fn rung(&self, split: &Split, shell: Option<Shell>) -> Option<(u32, f64)> {
        if let Some(Shell { apex, k }) = shell {
            // k was checked to be an exponent of lengths in the input, which are normal f64s
            return Some((
                apex.0,
                f64::from_bits(((k + 1023).clamp(1, 2046) as u64) << 52),
            ));
        }
        let choice = match split.kind {
            SplitKind::B => self.parameters.choice_b,
            SplitKind::C { .. } => self.parameters.choice_c,
        };
        let [a, b] = split.ends.map(|v| self.rungs[v as usize]);
        let ((apex, c), (other, d)) = (a?, b?);
        (choice == Choice::Center && apex == other).then_some((apex, (c + d) / 2.0))
    }

    /// A shell names the one end of s that is an apex, and its exponent: |s|/3 < 2^k <= 2|s|/3.
    fn check_shell(&self, split: &Split, shell: Option<Shell>) -> Checked {
        let apexes = split.ends.map(|v| {
            self.parameters.small_angles == SmallAngles::Shells
                && self.apexes.get(v as usize) == Some(&true)
        });
        let apex = match apexes {
            [true, false] => Some(split.ends[0]),
            [false, true] => Some(split.ends[1]),
            _ => None,
        };
        ensure(shell.map(|s| s.apex.0) == apex, Rule::Shell, || {
            (format!("a shell of apex {apex:?}"), format!("{shell:?}"))
        })?;
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let fits = shell
            .is_none_or(|s| super::condition::is_shell_exponent(u, v, s.k, self.scale.exponent));
        ensure(fits, Rule::Shell, || {
            ("k with |s|/3 < 2^k <= 2|s|/3", format!("{shell:?}"))
        })
    }

    /// S3, and S2 by comparing the whole set of removals with the own one.
    fn check_kind_and_removals(&mut self, split: &Split) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let (mesh, p) = (&self.mesh, split.p);
        let policy = self.parameters.deletion;
        let crosses = if policy == DeletionPolicy::Disk {
            Crossing::All
        } else {
            Crossing::Unconstrained
        };
        let mut search = std::mem::take(&mut self.search);
        search.vertices_in(mesh, split.s, &[[u, v], [u, p], [p, v]], crosses);
        let found = std::mem::take(&mut search.found);
        let mut witness = None;
        self.expected_removals.clear();
        for &w in &found {
            if mesh.vertices[w as usize].is_free() {
                let counts = match policy {
                    DeletionPolicy::Segment => search.sees(mesh, w, split.s, Aim::Interior),
                    DeletionPolicy::Point => search.sees(mesh, w, split.s, Aim::At(p)),
                    DeletionPolicy::Disk => true,
                };
                if counts {
                    self.expected_removals.push(w);
                }
            } else if witness.is_none()
                && in_diametral_disk(u, v, mesh.at(w))
                && search.sees(mesh, w, split.s, Aim::Interior)
            {
                witness = Some(w);
            }
        }
        search.found = found;
        self.search = search;
        self.expected_removals.sort_unstable();
        ensure(
            witness.is_some() == matches!(split.kind, SplitKind::C { .. }),
            Rule::S3,
            || {
                (
                    format!("Type-C iff a vertex is seen that stays; seen: {witness:?}"),
                    format!("{:?}", split.kind),
                )
            },
        )?;
        let same = self
            .waiting
            .iter()
            .map(|w| &w.vertex)
            .eq(self.expected_removals.iter());
        ensure(same, Rule::S2, || {
            let found: Vec<u32> = self.waiting.iter().map(|w| w.vertex).collect();
            (
                format!("removal of {:?}", self.expected_removals),
                format!("{found:?}"),
            )
        })
    }

    fn apply_removals(&mut self) -> Checked {
        let now = self.event;
        for i in 0..self.waiting.len() {
            let w = self.waiting[i];
            self.event = w.event;
            self.remove(w)?;
        }
        self.event = now;
        self.waiting.clear();
        self.filling.clear();
        Ok(())
    }

    /// The closest non-free vertex strictly in Diam(s) that sees p; ties by id.
    fn check_parent(&mut self, split: &Split, parent: u32) -> Checked {
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let Some(s) = self.find_inside(split.ends) else {
            return broken(Rule::Segment, "the subsegment", "none");
        };
        let mut search = std::mem::take(&mut self.search);
        let mesh = &self.mesh;
        search.vertices_in(mesh, s, &[[u, v]], Crossing::Unconstrained);
        let mut found = std::mem::take(&mut search.found);
        found.sort_unstable();
        let mut best: Option<u32> = None;
        for &w in found
            .iter()
            .filter(|&&w| !mesh.vertices[w as usize].is_free())
        {
            let closer = best.is_none_or(|b| {
                compare_lengths(mesh.at(w), split.p, mesh.at(b), split.p).is_negative()
            });
            if closer && search.sees(mesh, w, s, Aim::At(split.p)) {
                best = Some(w);
            }
        }
        search.found = found;
        self.search = search;
        ensure(best == Some(parent), Rule::S3, || {
            (
                format!("the closest vertex seen as parent, {best:?}"),
                format!("{parent}"),
            )
        })
    }

    /// The half-edge between two vertices, seen from inside the region.
    pub fn find_inside(&self, [u, v]: [u32; 2]) -> Option<u32> {
        let inside = |e: &u32| self.mesh.inside(*e).is_some();
        self.mesh
            .find_edge(u, v)
            .filter(inside)
            .or_else(|| self.mesh.find_edge(v, u).filter(inside))
    }
}

/// The birth mark of what an event creates. Marks of runs beyond 2^32 events coincide, which only a strict check would notice.
pub(super) fn birth(event: u64) -> u32 {
    u32::try_from(event + 1).unwrap_or(u32::MAX)
}

/// Gives a broken rule its place.
pub fn placed(broken: Broken, event: super::verdict::Place) -> super::verdict::Rejection {
    super::verdict::Rejection {
        event,
        rule: broken.rule,
        expected: broken.expected,
        found: broken.found,
    }
}
