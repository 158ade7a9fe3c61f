//! Small numbers for the vertices of a boundary, given on the spot.
//!
//! Tables over pairs of vertices, and keys of facets, want small numbers; a hash is slower and a field of each vertex wants
//! clearing. Here the field may hold anything: it counts only if the vertex is at home at that number (Briggs and Torczon, 1993).

use super::store::{FIRST, NONE};

/// How many vertices can have numbers: one for each byte.
pub(super) const MOST: usize = 256;

/// Numbers of at most 256 vertices, in the order of their first mention.
#[derive(Clone, Debug)]
pub(super) struct Numbers {
    /// Per place a number, which is that of the vertex only if the vertex is at home there.
    number: Vec<u8>,
    home: [u32; MOST],
    count: usize,
}

impl Default for Numbers {
    fn default() -> Self {
        Numbers { number: vec![0; FIRST as usize], home: [NONE; MOST], count: 0 }
    }
}

impl Numbers {
    /// Makes room for the places below `end`.
    pub(super) fn reserve(&mut self, end: usize) {
        self.number.resize(end, 0);
    }

    /// Takes all numbers back.
    pub(super) fn clear(&mut self) {
        self.home[..self.count].fill(NONE);
        self.count = 0;
    }

    /// The vertices that have numbers, by number.
    pub(super) fn vertices(&self) -> &[u32] {
        &self.home[..self.count]
    }

    /// Whether the vertex has a number.
    #[inline(always)]
    pub(super) fn has(&self, v: u32) -> bool {
        self.home[usize::from(self.number[v as usize])] == v
    }

    /// The number of the vertex, given now if it has none; `None` when there are too many.
    #[inline(always)]
    pub(super) fn of(&mut self, v: u32) -> Option<usize> {
        let known = usize::from(self.number[v as usize]);
        if self.home[known] == v {
            return Some(known);
        }
        let fresh = self.count;
        *self.home.get_mut(fresh)? = v;
        self.number[v as usize] = fresh as u8;
        self.count += 1;
        Some(fresh)
    }
}
