//! Taking mutations back: a list of overwritten values, undone from the end.
//!
//! Off, it costs one predictable branch a write.

use super::store::{Cdt2, Link, NONE, Slot};
use crate::arith::Kernel;

/// One overwritten value.
#[derive(Clone, Debug)]
pub(super) enum Undo {
    /// A slot with its labels.
    Slot(u32, Slot, [u32; 3]),
    /// The link of a half-edge.
    Link(u32, Link),
    /// The label of a half-edge.
    Label(u32, u32),
    /// The hint of a vertex.
    Hint(u32, u32),
    /// A slot came off the free list.
    Taken(u32),
    /// A slot went onto the free list.
    Released,
}

/// The values overwritten since the checkpoint.
#[derive(Clone, Debug, Default)]
pub(super) struct Journal {
    on: bool,
    list: Vec<Undo>,
    points: usize,
    slots: usize,
    clock: u32,
    outside: usize,
}

impl Journal {
    #[inline]
    pub(super) fn is_on(&self) -> bool {
        self.on
    }

    #[inline]
    pub(super) fn record(&mut self, undo: impl FnOnce() -> Undo) {
        if self.on {
            self.list.push(undo());
        }
    }
}

impl<K: Kernel> Cdt2<K> {
    /// From here on mutations are journalled, until `commit` or `rollback`. Checkpoints do not nest: a second one forgets the first.
    pub fn checkpoint(&mut self) {
        self.journal.on = true;
        self.journal.list.clear();
        self.journal.points = self.points.len();
        self.journal.slots = self.slots.len();
        self.journal.clock = self.clock;
        self.journal.outside = self.outside;
    }

    /// Forgets the journal.
    pub fn commit(&mut self) {
        self.journal.on = false;
        self.journal.list.clear();
    }

    /// Restores the state at `checkpoint`: same slots, births, hints, vertex ids and clock. Without a checkpoint: nothing.
    pub fn rollback(&mut self) {
        if !self.journal.on {
            return;
        }
        self.journal.on = false;
        let mut list = std::mem::take(&mut self.journal.list);
        while let Some(undo) = list.pop() {
            match undo {
                Undo::Slot(t, slot, labels) => {
                    self.slots[t as usize] = slot;
                    self.labels[t as usize] = labels;
                }
                Undo::Link(e, link) => self.write_link(e, link),
                Undo::Label(e, label) => self.write_label(e, label),
                Undo::Hint(v, e) => self.hints[v as usize] = e,
                Undo::Taken(t) => self.free.push(t),
                Undo::Released => {
                    let t = self.free.pop();
                    debug_assert!(t.is_some_and(|t| t != NONE));
                }
            }
        }
        self.journal.list = list;
        self.points.truncate(self.journal.points);
        self.hints.truncate(self.journal.points);
        self.slots.truncate(self.journal.slots);
        self.labels.truncate(self.journal.slots);
        self.clock = self.journal.clock;
        self.outside = self.journal.outside;
    }
}
