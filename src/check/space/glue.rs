//! Which cells share a facet: by bucketing facets on their smallest vertex.
//!
//! A facet is a slot, 4 t + k: that of cell t across from its corner k. Cells are positively oriented, so that two of them on different sides of
//! a facet see it turn in different directions. A bucket holds the facets of one smallest vertex a, as many as there are triangles around it, each as the
//! edge b, c such that a, b, c turn counterclockwise as seen from the cell: what is across has the edge c, b. They are matched in a small table,
//! or by sorting if the bucket is large. A cell has two entries in buckets: one for the three facets around its smallest corner, one for the fourth.

/// The slot across from a facet of the border.
pub const BORDER: u32 = u32::MAX;

/// The corners of the facet across from each corner of a positively oriented cell, counterclockwise as seen from that corner.
pub const FACETS: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// Most cells that slots can name.
pub const MOST_CELLS: usize = (BORDER / 4) as usize;

/// Most vertices: a place of a table has a bit beside two of them.
pub const MOST_VERTICES: usize = (MARK >> 32) as usize;

/// Buckets up to this size, real ones and more, are matched by a table, whose worst case is quadratic; larger ones by sorting.
const SMALL: usize = 256;

/// Marks a facet in a table that is matched.
const MARK: u64 = 1 << 63;

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
    let (across, clashes) = matched(cells, vertices, |slot, _| slot);
    Glue { across, clashes }
}

/// As `glue`, but for each slot the corner of the cell across that is not in the facet, or `BORDER`; and the clashes.
pub fn far_corners(cells: &[[u32; 4]], vertices: usize) -> (Vec<u32>, Vec<Vec<u32>>) {
    matched(cells, vertices, |_, corner| corner)
}

/// For each slot what `tell` says of the one across, given that and its corner.
fn matched(cells: &[[u32; 4]], vertices: usize, tell: impl Fn(u32, u32) -> u32) -> (Vec<u32>, Vec<Vec<u32>>) {
    let [first, second] = Buckets::both(cells, vertices);
    let mut matching = Matching { tell, told: vec![BORDER; 4 * cells.len()], table: Vec::new() };
    let mut bucket = Bucket { a: 0, first: Vec::new(), second: Vec::new() };
    let mut clashes = Vec::new();
    for a in 0..vertices as u32 {
        bucket.a = a;
        first.fetch(cells, a, &mut bucket.first);
        second.fetch(cells, a, &mut bucket.second);
        if bucket.len() > SMALL || !matching.by_table(&bucket) {
            matching.by_sorting(&bucket, &mut clashes);
        }
    }
    (matching.told, clashes)
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

    /// Puts the entries of a vertex into a list, with their cells: memory answers many questions in the time of one.
    fn fetch(&self, cells: &[[u32; 4]], a: u32, into: &mut Vec<(u32, [u32; 4])>) {
        let from = if a == 0 { 0 } else { self.ends[a as usize - 1] };
        let entries = &self.entries[from as usize..self.ends[a as usize] as usize];
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

/// The facets whose smallest corner is a: cells of which it is the smallest, and cells of which it is the second smallest.
struct Bucket {
    a: u32,
    first: Vec<(u32, [u32; 4])>,
    second: Vec<(u32, [u32; 4])>,
}

impl Bucket {
    fn len(&self) -> usize {
        3 * self.first.len() + self.second.len()
    }

    fn facets(&self) -> impl Iterator<Item = Facet> {
        self.first.iter().flat_map(around).chain(self.second.iter().map(|e| opposite(self.a, e)))
    }
}

/// Facets under way to be matched.
struct Matching<T> {
    tell: T,
    told: Vec<u32>,
    /// Facets by edge, in places that a product scatters: the edge, perhaps with `MARK` (0: free), slot and what is told of it.
    table: Vec<(u64, u32, u32)>,
}

impl<T: Fn(u32, u32) -> u32> Matching<T> {
    /// Matches the facets of a bucket; false if some clash, and then none are.
    fn by_table(&mut self, bucket: &Bucket) -> bool {
        // At most one in four places is taken.
        let size = (4 * bucket.len()).next_power_of_two().max(2);
        let shift = 64 - size.trailing_zeros();
        self.table.clear();
        self.table.resize(size, (0, 0, 0));
        let mut clash = false;
        for entry in &bucket.first {
            for f in &around(entry) {
                clash |= self.insert(f, shift);
            }
        }
        for entry in &bucket.second {
            clash |= self.insert(&opposite(bucket.a, entry), shift);
        }
        if clash {
            bucket.facets().for_each(|f| self.told[f.slot as usize] = BORDER);
        }
        !clash
    }

    /// Matches a facet with what is in the table, or puts it there; whether it clashes. That a facet is the first or the second cannot be
    /// foreseen: both write the same, without a branch.
    #[inline]
    fn insert(&mut self, f: &Facet, shift: u32) -> bool {
        let [b, c] = f.edge.map(u64::from);
        let (key, turned) = (b << 32 | c, c << 32 | b);
        // The golden ratio spreads keys well (Knuth).
        let hash = |key: u64| (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> shift) as usize;
        let mut at = hash(key.min(turned));
        let mut held = self.table[at].0 & !MARK;
        while held != 0 && held != key && held != turned {
            at = (at + 1) & (self.table.len() - 1);
            held = self.table[at].0 & !MARK;
        }
        let found = held != 0;
        let place = &mut self.table[at];
        let clash = held == key || place.0 & MARK != 0;
        let told = (self.tell)(f.slot, f.corner);
        let (other, of_other) = if found { (place.1, place.2) } else { (f.slot, BORDER) };
        self.told[other as usize] = if found { told } else { BORDER };
        self.told[f.slot as usize] = of_other;
        *place = (if found { key | MARK } else { key }, f.slot, told);
        clash
    }

    /// Matches the facets of a bucket and reports what clashes.
    fn by_sorting(&mut self, bucket: &Bucket, clashes: &mut Vec<Vec<u32>>) {
        let ascending = |[b, c]: [u32; 2]| [b.min(c), b.max(c)];
        let mut all: Vec<([u32; 2], Facet)> = bucket.facets().map(|f| (ascending(f.edge), f)).collect();
        all.sort_unstable_by_key(|(edge, f)| (*edge, f.edge[0], f.slot));
        for same in all.chunk_by(|f, g| f.0 == g.0) {
            match *same {
                [_] => {}
                [(_, f), (_, g)] if f.edge != g.edge => {
                    self.told[f.slot as usize] = (self.tell)(g.slot, g.corner);
                    self.told[g.slot as usize] = (self.tell)(f.slot, f.corner);
                }
                _ => clashes.push(same.iter().map(|(_, f)| f.slot).collect()),
            }
        }
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
        let (far, _) = far_corners(&[[0, 1, 2, 3], [4, 0, 1, 2]], 5);
        assert_eq!((far[3], far[4], far.iter().filter(|&&v| v == BORDER).count()), (4, 3, 6));
        let same_side = glue(&[[0, 1, 2, 3], [0, 1, 2, 4]], 5);
        assert_eq!(same_side, Glue { across: vec![BORDER; 8], clashes: vec![vec![3, 7]] });
        let three = glue(&[[0, 1, 2, 3], [4, 0, 1, 2], [0, 1, 2, 5]], 6);
        assert_eq!(three.clashes, [vec![3, 11, 4]]);
        assert_eq!(glue(&[[5, 1, 2, 3], [5, 1, 2, 3]], 6).clashes.len(), 4);
    }

    #[test]
    fn large_buckets_match_as_small_ones() {
        // A fan around an edge of vertex 0 or of the last vertex: one large bucket, or many small ones.
        let n = 3 * SMALL as u32;
        let fan: Vec<[u32; 4]> = (0..n).map(|i| [0, 1, i + 2, (i + 1) % n + 2]).collect();
        let renamed: Vec<[u32; 4]> = fan.iter().map(|t| t.map(|v| n + 1 - v)).collect();
        let (large, small) = (glue(&fan, n as usize + 2), glue(&renamed, n as usize + 2));
        assert_eq!(large.across, small.across);
        assert_eq!(large.across.iter().filter(|&&s| s != BORDER).count(), 2 * n as usize);
        assert!(large.clashes.is_empty() && small.clashes.is_empty());
    }
}
