//! Which cells share a facet: by bucketing facets on their smallest vertex.
//!
//! A facet is a slot, 4 t + k: that of cell t across from its corner k. Cells are positively oriented, so that two of them on different sides of
//! a facet see it turn in different directions. A bucket holds the facets of one smallest vertex a, as many as there are triangles around it, each as the
//! edge b, c such that a, b, c turn counterclockwise as seen from the cell: what is across has the edge c, b. Its corners are numbered, and facets are matched in
//! a table of pairs of numbers, or by sorting if there are many. A cell has two entries in buckets: one for the three facets around its smallest corner,
//! one for the fourth.

/// The slot across from a facet of the border.
pub const BORDER: u32 = u32::MAX;

/// The corners of the facet across from each corner of a positively oriented cell, counterclockwise as seen from that corner.
pub const FACETS: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// Most cells that slots can name.
pub const MOST_CELLS: usize = (BORDER / 4) as usize;

/// Most vertices.
pub const MOST_VERTICES: usize = BORDER as usize;

/// Corners of a bucket that are numbered: with more, and real ones have fewer, facets are matched by sorting.
const NUMBERS: u32 = 64;

/// Fans that are told apart; few in tests, so that they are forgotten there, too.
const STAMPS: u64 = if cfg!(test) { 5 } else { (1 << 32) / NUMBERS as u64 - 1 };

/// Vertices whose cells are fetched together.
const BLOCK: usize = 32;

/// The links of a set of cells.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Glue {
    /// For each slot the one across, or `BORDER`.
    pub across: Vec<u32>,
    /// Facets of three or more cells, or of two on the same side: their slots, which are `BORDER` above.
    pub clashes: Vec<Vec<u32>>,
}

/// The corners of a facet, counterclockwise as seen from the corner that is not in it.
#[inline]
pub fn facet(cells: &[[u32; 4]], slot: u32) -> [u32; 3] {
    let cell = &cells[(slot / 4) as usize];
    FACETS[(slot % 4) as usize].map(|k| cell[k])
}

/// Links positively oriented cells, each with four different corners below `vertices`. At most `MOST_CELLS`, and `MOST_VERTICES`.
pub fn glue(cells: &[[u32; 4]], vertices: usize) -> Glue {
    let mut across = vec![BORDER; 4 * cells.len()];
    let fringe = visit(cells, vertices, |fan| {
        for &[f, g] in &fan.pairs {
            let (s, t) = (fan.slots[f as usize], fan.slots[g as usize]);
            (across[s as usize], across[t as usize]) = (t, s);
        }
    });
    Glue { across, clashes: fringe.clashes }
}

/// The cells of which a vertex is the smallest corner or the second smallest, and their facets of which it is the smallest.
///
/// Facets count from 0: three for each of the former cells, then one for each of the latter.
#[derive(Clone, Debug, Default)]
pub struct Fan {
    /// The vertex.
    pub a: u32,
    /// The cells of which it is the smallest corner, each with `4 t + k`, k being the place of that.
    pub first: Vec<(u32, [u32; 4])>,
    /// The cells of which it is the second smallest corner, with k the place of the smallest.
    pub second: Vec<(u32, [u32; 4])>,
    /// The slot of each facet.
    pub slots: Vec<u32>,
    /// The corner across from each facet in its cell.
    pub corners: Vec<u32>,
    /// Facets that are one, the smaller number first, ascending.
    pub pairs: Vec<[u32; 2]>,
}

/// Facets without a mate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fringe {
    /// The slots of facets of one cell alone, ascending.
    pub border: Vec<u32>,
    /// As in `Glue`.
    pub clashes: Vec<Vec<u32>>,
    /// Whether a cell has each vertex.
    pub is_used: Vec<bool>,
}

/// Shows the fan of each vertex, as `glue` would link its cells, and tells what is not linked.
pub fn visit(cells: &[[u32; 4]], vertices: usize, mut see: impl FnMut(&Fan)) -> Fringe {
    let [first, second] = Buckets::both(cells, vertices);
    let mut matching = Matching {
        stamp: 0,
        numbers: vec![0; vertices],
        table: vec![0; (NUMBERS * NUMBERS) as usize],
        turned: Vec::new(),
    };
    let (mut fan, mut fringe) = (Fan::default(), Fringe::default());
    let mut fetched = [Vec::new(), Vec::new()];
    for block in (0..vertices).step_by(BLOCK).map(|a| a..vertices.min(a + BLOCK)) {
        first.fetch(cells, block.clone(), &mut fetched[0]);
        second.fetch(cells, block.clone(), &mut fetched[1]);
        let [mut firsts, mut seconds] = fetched.each_ref().map(|f| f.iter());
        for a in block {
            fan.a = a as u32;
            fan.first.clear();
            fan.first.extend(firsts.by_ref().take(first.count(a)));
            fan.second.clear();
            fan.second.extend(seconds.by_ref().take(second.count(a)));
            if !matching.by_table(&mut fan, &mut fringe) {
                fan.by_sorting(&mut fringe);
            }
            see(&fan);
        }
    }
    fringe.border.sort_unstable();
    // A vertex is numbered, or is the smallest corner.
    fringe.is_used = (0..vertices).map(|v| matching.numbers[v] > 0 || first.count(v) > 0).collect();
    fringe
}

/// Cells by a vertex, `4 t + k` with k the place of the smallest corner: where the bucket of each vertex ends, and the cells.
struct Buckets {
    ends: Vec<u32>,
    entries: Vec<u32>,
}

impl Buckets {
    /// By the smallest corner of each cell, and by the second smallest.
    fn both(cells: &[[u32; 4]], vertices: usize) -> [Self; 2] {
        let mut starts = [vec![0u32; vertices], vec![0u32; vertices]];
        for cell in cells {
            let (k, second) = two_smallest(cell);
            starts[0][cell[k] as usize] += 1;
            starts[1][second as usize] += 1;
        }
        for starts in &mut starts {
            let mut sum = 0;
            for start in starts {
                sum += std::mem::replace(start, sum);
            }
        }
        let mut entries = [vec![0u32; cells.len()], vec![0u32; cells.len()]];
        for (t, cell) in (0u32..).zip(cells) {
            let (k, second) = two_smallest(cell);
            for (i, v) in [(0, cell[k]), (1, second)] {
                let place = &mut starts[i][v as usize];
                entries[i][*place as usize] = 4 * t + k as u32;
                *place += 1;
            }
        }
        // Filling has moved each start to its end.
        let ([ends, second_ends], [first, second]) = (starts, entries);
        [Buckets { ends, entries: first }, Buckets { ends: second_ends, entries: second }]
    }

    /// Where the bucket of a vertex begins.
    fn start(&self, a: usize) -> usize {
        if a == 0 { 0 } else { self.ends[a - 1] as usize }
    }

    /// How many cells are in the bucket of a vertex.
    fn count(&self, a: usize) -> usize {
        self.ends[a] as usize - self.start(a)
    }

    /// Puts the entries of some vertices into a list, with their cells: memory answers many questions in the time of one.
    fn fetch(&self, cells: &[[u32; 4]], vertices: std::ops::Range<usize>, into: &mut Vec<(u32, [u32; 4])>) {
        let entries = &self.entries[self.start(vertices.start)..self.start(vertices.end)];
        into.clear();
        into.extend(entries.iter().map(|&e| (e, cells[(e / 4) as usize])));
    }
}

/// Where the smallest corner is, and the second smallest corner.
#[inline]
fn two_smallest(&[a, b, c, d]: &[u32; 4]) -> (usize, u32) {
    let (i, ab, second_ab) = if a < b { (0, a, b) } else { (1, b, a) };
    let (j, cd, second_cd) = if c < d { (2, c, d) } else { (3, d, c) };
    if ab < cd { (i, second_ab.min(cd)) } else { (j, second_cd.min(ab)) }
}

/// A facet of the bucket of a: its slot, the corner that is not in it, and the edge b, c.
#[derive(Clone, Copy)]
struct Facet {
    slot: u32,
    corner: u32,
    edge: [u32; 2],
}

/// The facets around the smallest corner a of a cell.
///
/// The corners k, 1 ^ k, 2 ^ k, 3 ^ k are an even permutation, for any k: the cell a, p, q, r is positive, too, k being the place of a.
#[inline]
fn around(&(entry, cell): &(u32, [u32; 4])) -> [Facet; 3] {
    let k = entry & 3;
    let [p, q, r] = [1, 2, 3].map(|i| cell[(k ^ i) as usize]);
    let facet = |i: u32, corner: u32, edge: [u32; 2]| Facet { slot: entry ^ i, corner, edge };
    [facet(1, p, [q, r]), facet(2, q, [r, p]), facet(3, r, [p, q])]
}

/// The facet across from the smallest corner of a cell; its own smallest corner is a.
#[inline]
fn opposite(a: u32, &(entry, cell): &(u32, [u32; 4])) -> Facet {
    let k = entry & 3;
    let [s, p, q, r] = [0, 1, 2, 3].map(|i| cell[(k ^ i) as usize]);
    // Seen from s: p, r, q turn counterclockwise.
    let edge = if a == p {
        [r, q]
    } else if a == r {
        [q, p]
    } else {
        [p, r]
    };
    Facet { slot: entry, corner: s, edge }
}

impl Fan {
    /// The corners of the cell of a facet: a, p, q, r, positive.
    pub fn corners_of(&self, f: u32) -> [u32; 4] {
        let (f, first) = (f as usize, 3 * self.first.len());
        let (_, cell) = if f < first { self.first[f / 3] } else { self.second[f - first] };
        // a is in its cells.
        let k = cell.iter().position(|&v| v == self.a).unwrap_or(0);
        [0, 1, 2, 3].map(|i| cell[k ^ i])
    }

    /// The facets, in their order.
    fn facets(&self) -> impl Iterator<Item = Facet> {
        self.first.iter().flat_map(around).chain(self.second.iter().map(|e| opposite(self.a, e)))
    }

    /// Matches the facets and tells what clashes.
    fn by_sorting(&mut self, fringe: &mut Fringe) {
        let ascending = |[b, c]: [u32; 2]| [b.min(c), b.max(c)];
        let mut all: Vec<([u32; 2], u32, Facet)> =
            (0..).zip(self.facets()).map(|(k, f)| (ascending(f.edge), k, f)).collect();
        all.sort_unstable_by_key(|(edge, _, f)| (*edge, f.edge[0], f.slot));
        self.pairs.clear();
        for same in all.chunk_by(|f, g| f.0 == g.0) {
            match *same {
                [(_, _, f)] => fringe.border.push(f.slot),
                [(_, k, f), (_, l, g)] if f.edge != g.edge => self.pairs.push([k.min(l), k.max(l)]),
                _ => fringe.clashes.push(same.iter().map(|(_, _, f)| f.slot).collect()),
            }
        }
        self.pairs.sort_unstable();
    }
}

/// A table under way.
struct Matching {
    /// The number of the fan at hand, from 1 on; after `STAMPS` anew.
    stamp: u64,
    /// For each vertex the last fan that it was met in times `NUMBERS`, plus its number there; 1 if that fan is forgotten. In 32 bits, since places asked for at
    /// random should be close together.
    numbers: Vec<u32>,
    /// For each edge, by the numbers of its ends, the last fan that it was met in, and its facet.
    table: Vec<u64>,
    /// For each facet the place in the table of its edge turned.
    turned: Vec<u32>,
}

impl Matching {
    /// Matches the facets of a fan; false if some clash or corners are many, and then none are. What cannot be foreseen is not branched on: of
    /// a pair and of the border each is written, and kept if it is one.
    fn by_table(&mut self, fan: &mut Fan, fringe: &mut Fringe) -> bool {
        if self.stamp == STAMPS {
            self.forget();
        }
        self.stamp += 1;
        let (mut count, mut clash) = (0, false);
        self.turned.clear();
        fan.slots.clear();
        fan.corners.clear();
        for entry in &fan.first {
            let facets = around(entry);
            let [p, q, r] = facets.map(|f| self.number(f.corner, &mut count));
            fan.slots.extend(facets.map(|f| f.slot));
            fan.corners.extend(facets.map(|f| f.corner));
            clash |= self.enter([q, r]) | self.enter([r, p]) | self.enter([p, q]);
        }
        for entry in &fan.second {
            let facet = opposite(fan.a, entry);
            let edge = facet.edge.map(|v| self.number(v, &mut count));
            fan.slots.push(facet.slot);
            fan.corners.push(facet.corner);
            clash |= self.enter(edge);
        }
        if clash || count > NUMBERS {
            return false;
        }
        let (mut pairs, mut border) = (0, fringe.border.len());
        fan.pairs.resize(fan.slots.len(), [0; 2]);
        fringe.border.resize(border + fan.slots.len(), 0);
        for ((f, &place), &slot) in (0..).zip(&self.turned).zip(&fan.slots) {
            let across = self.table[place as usize];
            let (alone, mate) = (across >> 32 != self.stamp, across as u32);
            fan.pairs[pairs] = [f, mate];
            pairs += usize::from(!alone & (f < mate));
            fringe.border[border] = slot;
            border += usize::from(alone);
        }
        fan.pairs.truncate(pairs);
        fringe.border.truncate(border);
        true
    }

    /// Starts anew, but for which vertices have been met.
    #[cold]
    fn forget(&mut self) {
        self.stamp = 0;
        self.table.fill(0);
        self.numbers.iter_mut().for_each(|n| *n = u32::from(*n > 0));
    }

    /// The number of a vertex in the fan at hand, the next one if it has none.
    #[inline]
    fn number(&mut self, v: u32, count: &mut u32) -> u32 {
        let stamp = self.stamp as u32 * NUMBERS;
        let place = &mut self.numbers[v as usize];
        let is_new = *place & !(NUMBERS - 1) != stamp;
        // Where they are more, the table is not used.
        let number = if is_new { *count } else { *place } % NUMBERS;
        *place = stamp | number;
        *count += u32::from(is_new);
        number
    }

    /// Puts the next facet, with an edge from number i to number j, into the table; whether one with that edge is there.
    #[inline]
    fn enter(&mut self, [i, j]: [u32; 2]) -> bool {
        let place = &mut self.table[(i * NUMBERS + j) as usize];
        let clash = *place >> 32 == self.stamp;
        *place = self.stamp << 32 | self.turned.len() as u64;
        self.turned.push(j * NUMBERS + i);
        clash
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_turn_counterclockwise_from_their_corner() {
        for (k, f) in FACETS.iter().enumerate() {
            let order = [f[0], f[1], f[2], k];
            let inversions = (0..4).flat_map(|i| (0..i).map(move |j| (i, j))).filter(|&(i, j)| order[j] > order[i]);
            assert_eq!(inversions.count() % 2, 0, "{order:?}");
        }
    }

    #[test]
    fn two_cells_and_what_clashes() {
        // Seen from 3 the facet 0, 1, 2 turns counterclockwise, seen from 4 clockwise.
        let pair = glue(&[[0, 1, 2, 3], [4, 0, 1, 2]], 5);
        let mut across = vec![BORDER; 8];
        (across[3], across[4]) = (4, 3);
        assert_eq!(pair, Glue { across, clashes: vec![] });
        let mut met = Vec::new();
        let fringe = visit(&[[0, 1, 2, 3], [4, 0, 1, 2]], 5, |fan| {
            met.extend(fan.pairs.iter().map(|pair| pair.map(|f| (fan.slots[f as usize], fan.corners[f as usize]))));
        });
        assert_eq!((met, fringe.border), (vec![[(3, 3), (4, 4)]], vec![0, 1, 2, 5, 6, 7]));
        let same_side = glue(&[[0, 1, 2, 3], [0, 1, 2, 4]], 5);
        assert_eq!(same_side, Glue { across: vec![BORDER; 8], clashes: vec![vec![3, 7]] });
        let three = glue(&[[0, 1, 2, 3], [4, 0, 1, 2], [0, 1, 2, 5]], 6);
        assert_eq!(three.clashes, [vec![3, 11, 4]]);
        assert_eq!(glue(&[[5, 1, 2, 3], [5, 1, 2, 3]], 6).clashes.len(), 4);
    }

    #[test]
    fn large_buckets_match_as_small_ones() {
        // A fan around an edge of vertex 0 or of the last vertex: one large bucket, or many small ones.
        let n = 3 * NUMBERS;
        let fan: Vec<[u32; 4]> = (0..n).map(|i| [0, 1, i + 2, (i + 1) % n + 2]).collect();
        let renamed: Vec<[u32; 4]> = fan.iter().map(|t| t.map(|v| n + 1 - v)).collect();
        let (large, small) = (glue(&fan, n as usize + 2), glue(&renamed, n as usize + 2));
        assert_eq!(large.across, small.across);
        assert_eq!(large.across.iter().filter(|&&s| s != BORDER).count(), 2 * n as usize);
        assert!(large.clashes.is_empty() && small.clashes.is_empty());
    }
}
