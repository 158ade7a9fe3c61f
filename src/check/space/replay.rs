//! The replay: one function per kind of event. Each proves the facts of its event and then changes the complex.

use super::ball::{apexes_of, independent};
use super::certificate::{Ties, conflict, prove};
use super::complex::{Complex, FIRST, INFINITE, NONE, id, number};
use super::fill::{fill, take_star};
use super::hidden::{Points, State};
use super::insert::Cavity;
use super::predicates::orient;
use crate::check::verdict::{Checked, Rule, broken, ensure};
use crate::model::{Point3, Sign, Tetrahedron, VertexId, WeightedPoint};
use crate::trace::{Apex, Bits, Event3};
use std::collections::{BTreeMap, BTreeSet};

/// The state of a replay.
#[derive(Clone, Debug)]
pub struct Replay {
    /// Points and cells.
    pub mesh: Complex,
    /// What became of the points.
    pub points: Points,
    /// How many apexes there are: 3 less the dimension.
    pub apexes: u32,
    /// Whether points have weights of their own.
    pub weighted: bool,
    /// A point that waits for the event that takes it out, and its new weight if it is to come back.
    pub pending: Option<(u32, Option<f64>)>,
    /// Strict: who has, or had, this place and weight.
    alike: BTreeMap<[u64; 4], Vec<u32>>,
    ties: Ties,
    cavity: Cavity,
}

impl Replay {
    /// A replay without points. Strict: ties and all choices are proved.
    pub fn new(strict: bool) -> Replay {
        Replay {
            mesh: Complex::default(),
            points: Points::default(),
            apexes: 0,
            weighted: false,
            pending: None,
            alike: BTreeMap::new(),
            ties: if strict { Ties::Broken } else { Ties::Free },
            cavity: Cavity::default(),
        }
    }

    fn strict(&self) -> bool {
        self.ties == Ties::Broken
    }

    /// Whether there is no simplex.
    pub fn is_empty(&self) -> bool {
        self.mesh.slot_count() == 0
    }

    // Points.

    /// Adds a point that no event has placed.
    pub fn add_point(&mut self, p: WeightedPoint) {
        let v = self.mesh.add_point(p);
        self.points.add();
        self.note_alike(v);
    }

    fn set_weight(&mut self, v: u32, weight: f64) {
        self.mesh.set_weight(v, weight);
        self.note_alike(v);
    }

    fn note_alike(&mut self, v: u32) {
        if self.strict() {
            self.alike.entry(bits(self.mesh.point(v))).or_default().push(v);
        }
    }

    /// Strict: that no hidden point has the place and weight of p, which would be its duplicate.
    fn check_alone(&self, p: u32) -> Checked {
        let at = self.mesh.point(p);
        let alike = self.alike.get(&bits(at)).into_iter().flatten().copied();
        let twin =
            alike.filter(|&v| v != p && self.mesh.point(v) == at).find(|&v| self.points.state(v) == State::Hidden);
        twin.map_or(Ok(()), |v| {
            broken(Rule::Duplicate, format!("a duplicate of {:?}", id(v)), format!("{:?} hidden", id(p)))
        })
    }

    // The start.

    /// Adds a simplex, filled up with apexes. Its points become vertices.
    pub fn add_simplex(&mut self, t: Tetrahedron) -> Checked {
        let v = t.map(number);
        for &w in v.iter().filter(|w| **w >= FIRST) {
            ensure(w < self.mesh.vertex_count(), Rule::Domain, || ("ids of points", format!("{t:?}")))?;
            if self.points.state(w) != State::Vertex {
                self.points.set(w, State::Vertex);
            }
        }
        let turned = self.turned(v);
        self.mesh.add(turned);
        Ok(())
    }

    /// Of lower dimension simplices have no orientation: their tetrahedra take the positive one.
    fn turned(&self, v: [u32; 4]) -> [u32; 4] {
        let [a, b, c, d] = v.map(|w| self.mesh.at(w));
        let turn = v.iter().any(|&w| w < FIRST) && orient(a, b, c, d).is_negative();
        if turn { [v[1], v[0], v[2], v[3]] } else { v }
    }

    /// Puts apexes in their places.
    pub fn set_apexes(&mut self, apexes: &[Apex]) {
        for (k, apex) in (0..).zip(apexes) {
            self.mesh.set_apex(apex_number(k), apex.place());
        }
        self.apexes = apexes.len() as u32;
    }

    /// Proves a complex that has tetrahedra only, and that its points span what is left of space by the apexes.
    pub fn prove(&mut self, apexes: &[Apex]) -> Checked {
        prove(&mut self.mesh, self.ties)?;
        if self.apexes == 0 {
            return Ok(());
        }
        let flat = self.base();
        let own = apexes_of(&flat);
        ensure(!self.strict() || own == apexes, Rule::Dimension, || (format!("{own:?}"), format!("{apexes:?}")))?;
        let vertices = (FIRST..self.mesh.vertex_count()).filter(|&v| self.mesh.cell_at(v) != NONE);
        for v in vertices {
            self.check_flat(&flat, v)?;
        }
        Ok(())
    }

    /// The corners of some simplex without the apexes.
    fn base(&self) -> Vec<Point3> {
        let first = self.mesh.tetrahedra().next();
        let corners = first.map(|c| self.mesh.cell(c).v);
        corners.iter().flatten().filter(|v| **v >= FIRST).map(|&v| self.mesh.at(v)).collect()
    }

    /// That a point lies in the hull of some others.
    fn check_flat(&self, base: &[Point3], v: u32) -> Checked {
        let mut all = base.to_vec();
        all.push(self.mesh.at(v));
        ensure(!independent(&all), Rule::Dimension, || {
            (format!("points of dimension {}", 3 - self.apexes), format!("{:?} off it", id(v)))
        })
    }

    // Events.

    /// A point gets another weight: when it is taken out, or at once if it was.
    pub fn reweigh(&mut self, v: u32, weight: f64) {
        if self.points.state(v) == State::Removed {
            self.set_weight(v, weight);
            self.points.set(v, State::Free);
        } else {
            self.pending = Some((v, Some(weight)));
        }
    }

    /// Takes one event.
    pub fn event(&mut self, event: &Event3) -> Checked {
        match event {
            Event3::Insert { id, first, flood } => self.insert(number(*id), *first, flood),
            Event3::Hide { id, cell } => self.hide(number(*id), *cell),
            Event3::Duplicate { id, of } => self.duplicate(number(*id), number(*of)),
            Event3::Remove { id, created } => self.remove(number(*id), created),
            Event3::Succeed { id, by } => self.succeed(number(*id), number(*by)),
            Event3::Raise { id, apexes } => self.raise(number(*id), apexes),
            Event3::Lower { id, apexes } => self.lower(number(*id), apexes),
        }
    }

    /// That no point waits for an event, of those set free and of those stated.
    pub fn check_settled(&mut self) -> Checked {
        if let Some((v, _)) = self.pending {
            return broken(Rule::Order, format!("an event that takes out {:?}", id(v)), "another record");
        }
        let due = self.points.due();
        due.map_or(Ok(()), |v| broken(Rule::Order, format!("an event that places {:?}", id(v)), "another record"))
    }

    /// That a point may be placed now: one that is free or unplaced, strictly the one that is due.
    fn check_due(&mut self, v: u32) -> Checked {
        if let Some((w, _)) = self.pending {
            return broken(Rule::Order, format!("an event that takes out {:?}", id(w)), format!("{:?} placed", id(v)));
        }
        let state = self.points.state(v);
        let due = self.points.due();
        let may = match state {
            State::Free => true,
            State::Unplaced => self.points.free.is_empty(),
            _ => false,
        };
        let chosen = !self.strict() || due == Some(v);
        ensure(may && chosen, Rule::Order, || {
            (format!("{:?} placed next", due.map(id)), format!("{:?}, {state:?}", id(v)))
        })
    }

    fn insert(&mut self, p: u32, first: Tetrahedron, flood: &Bits) -> Checked {
        self.check_due(p)?;
        if self.apexes > 0 {
            self.check_flat(&self.base(), p)?;
        }
        let tuple = first.map(number);
        let Some(c) = self.mesh.find(tuple).filter(|&c| self.mesh.cell(c).tuple() == first) else {
            return broken(Rule::Exists, "a cell of the complex", format!("{first:?}"));
        };
        self.cavity.flood.run(&mut self.mesh, c, tuple, flood)?;
        if self.strict() {
            let last = self.cavity.flood.last();
            ensure(last == Some(first), Rule::Canonical, || (format!("{last:?}"), format!("{first:?}")))?;
        }
        let loose = self.points.loose(self.cavity.flood.cells.taken().iter().map(|f| f.slot));
        self.cavity.star(&mut self.mesh, p, self.ties)?;
        let mut lost = Vec::new();
        self.cavity.check_lost(&self.mesh, p, self.ties, &mut lost)?;
        if self.apexes > 0 {
            self.check_apexes(self.cavity.made().iter().copied())?;
        }
        self.points.set(p, State::Vertex);
        lost.iter().for_each(|&v| self.points.set(v, State::Hidden));
        let near = self.mesh.cell_at(p);
        self.points.settle(&loose, near, &self.mesh)?;
        self.points.settle(&lost, near, &self.mesh)
    }

    /// That new tetrahedra contain all apexes.
    fn check_apexes(&self, mut made: impl Iterator<Item = u32>) -> Checked {
        let all = made.all(|c| {
            let cell = self.mesh.cell(c);
            !cell.is_finite() || (0..self.apexes).all(|k| cell.v.contains(&apex_number(k)))
        });
        ensure(all, Rule::Dimension, || ("tetrahedra with all apexes", "one without"))
    }

    fn hide(&mut self, p: u32, cell: Tetrahedron) -> Checked {
        self.check_due(p)?;
        let found = self.mesh.find(cell.map(number));
        let Some(c) = found.filter(|&c| self.mesh.cell(c).is_finite() && self.mesh.cell(c).tuple() == cell) else {
            return broken(Rule::Exists, "a tetrahedron of the complex", format!("{cell:?}"));
        };
        let at = self.mesh.point(p);
        let contained = (0..4).all(|k| !self.mesh.inside(c, k, at.at).is_negative());
        ensure(contained, Rule::Hidden, || ("a tetrahedron that contains the point", format!("{cell:?}")))?;
        let twin = self.mesh.cell(c).v.into_iter().find(|&v| self.mesh.point(v) == at);
        ensure(twin.is_none(), Rule::Duplicate, || ("a duplicate", format!("{:?} hidden", id(p))))?;
        if self.apexes > 0 {
            self.check_flat(&self.base(), p)?;
        }
        ensure(!conflict(&self.mesh, c, p, self.ties), Rule::Hidden, || {
            ("a point that is in no conflict", format!("{:?} in conflict with {cell:?}", id(p)))
        })?;
        if self.strict() {
            self.check_alone(p)?;
            let last = self.last_around(c, at.at);
            ensure(last == cell, Rule::Canonical, || (format!("{last:?}"), format!("{cell:?}")))?;
        }
        self.points.hide(p, c);
        Ok(())
    }

    /// Of the tetrahedra that contain q, c among them, the last in canonical order: they hang together by facets in whose planes q is.
    fn last_around(&mut self, c: u32, q: Point3) -> Tetrahedron {
        let mesh = &mut self.mesh;
        mesh.fresh();
        mesh.see(c);
        let (mut stack, mut last) = (vec![c], mesh.cell(c).tuple());
        while let Some(c) = stack.pop() {
            last = last.max(mesh.cell(c).tuple());
            for k in 0..4 {
                let next = mesh.cell(c).beyond[k] >> 2;
                if mesh.cell(next).is_finite() && mesh.inside(c, k, q) == Sign::Zero && mesh.see(next) {
                    stack.push(next);
                }
            }
        }
        last
    }

    fn duplicate(&mut self, p: u32, of: u32) -> Checked {
        self.check_due(p)?;
        let stands = matches!(self.points.state(of), State::Vertex | State::Hidden) && of != p;
        ensure(stands && self.mesh.point(p) == self.mesh.point(of), Rule::Duplicate, || {
            ("a vertex or hidden point of the same place and weight", format!("{:?}", id(of)))
        })?;
        let own = self.points.duplicates.remove(&p).unwrap_or_default();
        // The smaller id stands for the other and its duplicates.
        let (stands, mut all, moved) = match p < of {
            true => (p, own, self.take_place(of, p)?),
            false => (of, self.points.duplicates.remove(&of).unwrap_or_default(), own),
        };
        for d in moved.into_iter().chain([p.max(of)]) {
            self.points.set(d, State::Duplicate(stands));
            all.insert(d);
        }
        self.points.duplicates.insert(stands, all);
        Ok(())
    }

    /// A point of the same place and weight takes the place of v, whose duplicates are given back.
    fn take_place(&mut self, v: u32, by: u32) -> Checked<BTreeSet<u32>> {
        ensure(self.mesh.point(v) == self.mesh.point(by), Rule::Duplicate, || {
            ("points of the same place and weight", format!("{:?} and {:?}", id(v), id(by)))
        })?;
        let state = self.points.state(v);
        if state == State::Vertex {
            self.check_held(v)?;
            let mut star = Vec::new();
            self.mesh.visit_star(v, |c, cell| {
                star.extend(cell.find(v).map(|k| (c, k)));
                true
            });
            star.iter().for_each(|&(c, k)| self.mesh.relabel(c, k, by));
            let c = self.mesh.cell_at(v);
            self.mesh.set_cell_at(by, c);
            self.mesh.set_cell_at(v, NONE);
        } else {
            self.points.unhide(v, Some(by));
        }
        self.points.set(by, state);
        Ok(self.points.duplicates.remove(&v).unwrap_or_default())
    }

    /// That a vertex is in a cell.
    fn check_held(&self, v: u32) -> Checked {
        ensure(self.mesh.holds(v), Rule::Hidden, || ("every vertex in a cell", format!("{:?} in none", id(v))))
    }

    /// That a point may be taken out now: the caller said so.
    fn check_removable(&self, v: u32) -> Checked {
        let due = self.pending.map(|(w, _)| w);
        ensure(due == Some(v), Rule::Order, || (format!("{:?} taken out", due.map(id)), format!("{:?}", id(v))))
    }

    /// A point has been taken out: for good, or to be placed again with its new weight, after the points that its removal sets free.
    fn gone(&mut self, v: u32) {
        match self.pending.take().and_then(|(_, weight)| weight) {
            Some(weight) => {
                self.set_weight(v, weight);
                self.points.set(v, State::Free);
            }
            None => self.points.set(v, State::Removed),
        }
    }

    fn remove(&mut self, v: u32, created: &[VertexId]) -> Checked {
        self.check_removable(v)?;
        let alone = !self.points.duplicates.contains_key(&v);
        ensure(alone, Rule::Duplicate, || ("a duplicate to succeed", format!("{:?} removed", id(v))))?;
        let state = self.points.state(v);
        if state != State::Vertex {
            ensure(created.is_empty(), Rule::Star, || {
                ("no apexes for a point that is no vertex", format!("{created:?}"))
            })?;
        }
        match state {
            State::Vertex => return self.remove_vertex(v, created),
            State::Hidden => self.points.unhide(v, None),
            State::Duplicate(of) => self.drop_duplicate(of, v),
            _ => return broken(Rule::Exists, "a point that was placed", format!("{:?}, {state:?}", id(v))),
        }
        self.gone(v);
        Ok(())
    }

    fn drop_duplicate(&mut self, of: u32, v: u32) {
        if let Some(list) = self.points.duplicates.get_mut(&of) {
            list.remove(&v);
            if list.is_empty() {
                self.points.duplicates.remove(&of);
            }
        }
    }

    fn remove_vertex(&mut self, v: u32, created: &[VertexId]) -> Checked {
        self.check_held(v)?;
        self.points.keep_lists(&self.mesh)?;
        let star = take_star(&mut self.mesh, v);
        let loose = self.points.loose(star.iter().map(|(slot, _)| *slot));
        let made = fill(&mut self.mesh, v, &star, created, self.ties)?;
        if self.apexes > 0 {
            self.check_apexes(made.iter().copied())?;
        }
        // A star is filled by some cell.
        let near = made.first().copied().unwrap_or(0);
        loose.iter().for_each(|&h| self.settle_or_free(h, near));
        self.gone(v);
        Ok(())
    }

    /// A hidden point that lost its tetrahedron goes to the one that contains it now, or is free where it is off the hull, or in conflict under the tie-break.
    fn settle_or_free(&mut self, h: u32, from: u32) {
        let flat = self.apexes == 0 || self.check_flat(&self.base(), h).is_ok();
        let found = if flat && !self.is_empty() { self.mesh.locate(from, self.mesh.at(h)) } else { None };
        match found.filter(|&c| !conflict(&self.mesh, c, h, Ties::Broken)) {
            Some(c) => self.points.hide(h, c),
            None => self.points.set(h, State::Free),
        }
    }

    fn succeed(&mut self, v: u32, by: u32) -> Checked {
        self.check_removable(v)?;
        let heir = self.points.duplicates.get(&v).and_then(|all| all.first().copied());
        ensure(heir == Some(by), Rule::Duplicate, || {
            (format!("the first duplicate, {:?}", heir.map(id)), format!("{:?}", id(by)))
        })?;
        let mut rest = self.take_place(v, by)?;
        rest.remove(&by);
        rest.iter().for_each(|&d| self.points.set(d, State::Duplicate(by)));
        if !rest.is_empty() {
            self.points.duplicates.insert(by, rest);
        }
        self.gone(v);
        Ok(())
    }

    fn raise(&mut self, p: u32, apexes: &[Apex]) -> Checked {
        self.check_due(p)?;
        let expected = if self.is_empty() { Some(3) } else { self.apexes.checked_sub(1) };
        ensure(expected == Some(apexes.len() as u32), Rule::Dimension, || {
            (format!("{expected:?} apexes"), format!("{}", apexes.len()))
        })?;
        let mut cells: Vec<[u32; 4]> = self.mesh.tetrahedra().map(|c| self.mesh.cell(c).v).collect();
        if self.is_empty() {
            cells.push([p, apex_number(0), apex_number(1), apex_number(2)]);
        } else {
            replace(&mut cells, apex_number(self.apexes - 1), p);
        }
        self.points.set(p, State::Vertex);
        self.renew(cells, apexes)
    }

    fn lower(&mut self, v: u32, apexes: &[Apex]) -> Checked {
        self.check_removable(v)?;
        let alone = !self.points.duplicates.contains_key(&v) && self.points.state(v) == State::Vertex;
        ensure(alone, Rule::Exists, || ("a vertex without duplicates", format!("{:?}", id(v))))?;
        self.check_held(v)?;
        let mut cells: Vec<[u32; 4]> = self.mesh.tetrahedra().map(|c| self.mesh.cell(c).v).collect();
        let last = self.apexes == 3;
        let expected = if last { 0 } else { self.apexes + 1 };
        ensure(expected == apexes.len() as u32 && cells.iter().all(|c| c.contains(&v)), Rule::Dimension, || {
            (format!("{expected} apexes, and a vertex of all simplices"), format!("{} apexes", apexes.len()))
        })?;
        if last {
            cells.clear();
        } else {
            replace(&mut cells, v, apex_number(self.apexes));
        }
        self.mesh.set_cell_at(v, NONE);
        self.renew(cells, apexes)?;
        self.gone(v);
        Ok(())
    }

    /// Proves a complex of these tetrahedra from nothing, in time linear in it.
    fn renew(&mut self, mut cells: Vec<[u32; 4]>, apexes: &[Apex]) -> Checked {
        self.set_apexes(apexes);
        self.mesh.clear();
        let mirrored = cells.first().is_some_and(|v| {
            let [a, b, c, d] = v.map(|w| self.mesh.at(w));
            orient(a, b, c, d).is_negative()
        });
        for v in &mut cells {
            if mirrored {
                v.swap(0, 1);
            }
            self.mesh.add(*v);
        }
        if !cells.is_empty() {
            self.prove(apexes)?;
        }
        let from = self.mesh.tetrahedra().next().unwrap_or(0);
        for h in self.points.renew_lists() {
            self.settle_or_free(h, from);
        }
        Ok(())
    }
}

fn bits(p: WeightedPoint) -> [u64; 4] {
    [p.at.x, p.at.y, p.at.z, p.weight].map(f64::to_bits)
}

/// The number of the k-th apex.
fn apex_number(k: u32) -> u32 {
    INFINITE - 1 - k
}

fn replace(cells: &mut [[u32; 4]], old: u32, new: u32) {
    cells.iter_mut().flatten().filter(|v| **v == old).for_each(|v| *v = new);
}
