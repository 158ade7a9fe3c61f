//! What became of each point, and which tetrahedron a hidden one is in.
//!
//! While points are only inserted a hidden one stays hidden: the lower hull only goes down. So where it is matters first when a vertex is
//! taken out; from then on each tetrahedron has a list of the hidden points in it, which move with insertions, and which a removal sets free.

use super::complex::{Complex, FIRST, NONE, id};
use crate::check::verdict::{Checked, Rule, broken};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// What became of a point; others are named by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Nothing yet.
    Unplaced,
    /// A vertex.
    Vertex,
    /// Hidden.
    Hidden,
    /// That point stands for it.
    Duplicate(u32),
    /// Taken out.
    Removed,
    /// Set free by a removal: the events that follow place it.
    Free,
}

/// All points.
#[derive(Clone, Debug, Default)]
pub struct Points {
    /// By number less `FIRST`.
    states: Vec<State>,
    /// The duplicates of a point; without empty sets.
    pub duplicates: BTreeMap<u32, BTreeSet<u32>>,
    /// Points that wait for the events that place them, in the order these must have.
    pub free: VecDeque<u32>,
    /// The first point that may still be unplaced.
    next: usize,
    lists: Option<Lists>,
}

/// Hidden points by tetrahedron: linked lists.
#[derive(Clone, Debug, Default)]
struct Lists {
    /// By tetrahedron.
    first: Vec<u32>,
    /// By number less `FIRST`.
    links: Vec<Link>,
}

/// Where a hidden point stands.
#[derive(Clone, Copy, Debug)]
struct Link {
    /// Its tetrahedron.
    cell: u32,
    before: u32,
    next: u32,
}

impl Lists {
    fn attach(&mut self, c: u32, h: u32) {
        let (cell, k) = (c as usize, (h - FIRST) as usize);
        self.first.resize(self.first.len().max(cell + 1), NONE);
        self.links.resize(self.links.len().max(k + 1), Link { cell: NONE, before: NONE, next: NONE });
        let next = std::mem::replace(&mut self.first[cell], h);
        self.links[k] = Link { cell: c, before: NONE, next };
        if next != NONE {
            self.links[(next - FIRST) as usize].before = h;
        }
    }

    /// Takes a point out of its list. Says which tetrahedron that was.
    fn detach(&mut self, h: u32) -> u32 {
        let Link { cell, before, next } = self.links[(h - FIRST) as usize];
        if next != NONE {
            self.links[(next - FIRST) as usize].before = before;
        }
        match before {
            NONE => self.first[cell as usize] = next,
            before => self.links[(before - FIRST) as usize].next = next,
        }
        cell
    }

    fn take(&mut self, c: u32, out: &mut Vec<u32>) {
        let Some(first) = self.first.get_mut(c as usize) else { return };
        let mut h = std::mem::replace(first, NONE);
        while h != NONE {
            out.push(h);
            h = self.links[(h - FIRST) as usize].next;
        }
    }
}

impl Points {
    /// Adds a point that no event has placed.
    pub fn add(&mut self) {
        self.states.push(State::Unplaced);
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// What became of a point. A number of none is as if removed.
    pub fn state(&self, v: u32) -> State {
        let k = v.checked_sub(FIRST).map(|k| k as usize);
        k.and_then(|k| self.states.get(k)).copied().unwrap_or(State::Removed)
    }

    /// Sets what became of a point; one that waited waits no more.
    pub fn set(&mut self, v: u32, state: State) {
        let k = (v - FIRST) as usize;
        if self.states[k] == State::Free {
            if self.free.front() == Some(&v) {
                self.free.pop_front();
            } else {
                self.free.retain(|&w| w != v);
            }
        }
        self.states[k] = state;
        if state == State::Free {
            self.free.push_back(v);
        }
    }

    /// All with their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (u32, State)> + '_ {
        (FIRST..).zip(self.states.iter().copied())
    }

    /// The point that must be placed next: the first that was set free, else the first unplaced one.
    pub fn due(&mut self) -> Option<u32> {
        if let Some(&v) = self.free.front() {
            return Some(v);
        }
        while self.states.get(self.next).is_some_and(|s| *s != State::Unplaced) {
            self.next += 1;
        }
        (self.next < self.states.len()).then_some(self.next as u32 + FIRST)
    }

    /// Begins to keep lists, if there are none.
    pub fn keep_lists(&mut self, mesh: &Complex) -> Checked {
        if self.lists.is_some() {
            return Ok(());
        }
        let mut lists = Lists::default();
        let mut from = mesh.tetrahedra().next();
        for (h, _) in self.iter().filter(|(_, s)| *s == State::Hidden) {
            from = from.and_then(|c| mesh.locate(c, mesh.at(h)));
            let Some(c) = from else {
                return broken(Rule::Hidden, "a tetrahedron that contains the point", format!("none at {:?}", id(h)));
            };
            lists.attach(c, h);
        }
        self.lists = Some(lists);
        Ok(())
    }

    /// The complex was made anew: empty lists, and the hidden points, ascending, that are in none.
    pub fn renew_lists(&mut self) -> Vec<u32> {
        self.lists = Some(Lists::default());
        self.iter().filter(|(_, s)| *s == State::Hidden).map(|(h, _)| h).collect()
    }

    /// Notes that a point is hidden in tetrahedron c.
    pub fn hide(&mut self, h: u32, c: u32) {
        self.set(h, State::Hidden);
        if let Some(lists) = &mut self.lists {
            lists.attach(c, h);
        }
    }

    /// A hidden point is hidden no more, or another takes its place in the list.
    pub fn unhide(&mut self, h: u32, instead: Option<u32>) {
        let Some(lists) = &mut self.lists else { return };
        let c = lists.detach(h);
        instead.into_iter().for_each(|v| lists.attach(c, v));
    }

    /// The hidden points in cells that are no more.
    pub fn loose(&mut self, slots: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut loose = Vec::new();
        if let Some(lists) = &mut self.lists {
            slots.for_each(|c| lists.take(c, &mut loose));
        }
        loose.sort_unstable();
        loose
    }

    /// Hidden points go to the tetrahedra that contain them now, near cell c.
    pub fn settle(&mut self, loose: &[u32], c: u32, mesh: &Complex) -> Checked {
        let Some(lists) = &mut self.lists else { return Ok(()) };
        for &h in loose {
            let Some(c) = mesh.locate(c, mesh.at(h)) else {
                return broken(Rule::Hidden, "a tetrahedron that contains the point", format!("none at {:?}", id(h)));
            };
            lists.attach(c, h);
        }
        Ok(())
    }
}
