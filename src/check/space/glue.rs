//! Which cells share a facet: by bucketing facets on their smallest vertex.
//!
//! A facet is a slot, 4 t + k: that of cell t across from its corner k. A bucket holds the slots of one smallest vertex, as many as there are triangles
//! around it, and is matched by the other two in a small table, or by sorting if it is large. Cells are positively oriented, so that two of them on different sides of a facet see it turn
//! in different directions.

/// The slot across from a facet of the border.
pub const BORDER: u32 = u32::MAX;

/// The corners of the facet across from each corner of a positively oriented cell, counterclockwise as seen from that corner.
pub const FACETS: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// Most cells that slots can name.
pub const MOST_CELLS: usize = (BORDER / 4) as usize;

/// The links of a set of cells.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Glue {
    /// For each slot the one across, or `BORDER`.
    pub across: Vec<u32>,
    /// For each slot the corner of the cell across that is not in the facet, or `BORDER`.
    pub far: Vec<u32>,
    /// Facets of three or more cells, or of two on the same side: their slots, which are `BORDER` above.
    pub clashes: Vec<Vec<u32>>,
}

/// The corners of a facet, counterclockwise as seen from the corner that is not in it.
#[inline]
pub fn facet(cells: &[[u32; 4]], slot: u32) -> [u32; 3] {
    let cell = &cells[(slot / 4) as usize];
    FACETS[(slot % 4) as usize].map(|k| cell[k])
}

/// Links positively oriented cells, each with four different corners below `vertices`. At most `MOST_CELLS`.
pub fn glue(cells: &[[u32; 4]], vertices: usize) -> Glue {
    let (ends, slots) = buckets(cells, vertices);
    let mut glue =
        Glue { across: vec![BORDER; 4 * cells.len()], far: vec![BORDER; 4 * cells.len()], clashes: Vec::new() };
    let mut table = Table::default();
    let mut from = 0;
    for end in ends {
        let bucket = &slots[from as usize..end as usize];
        from = end;
        if bucket.len() > SMALL || !glue.match_by_table(cells, bucket, &mut table) {
            glue.match_by_sorting(cells, bucket);
        }
    }
    glue
}

/// Buckets up to this size, real ones and more, are matched by a table, whose worst case is quadratic; larger ones by sorting.
const SMALL: usize = 256;

/// The facets of a bucket by their two larger vertices, in places that a product scatters: of each place the key (0: free) and the slot, with bit
/// 32 as `keyed` gives it and bit 33 for what is matched.
#[derive(Default)]
struct Table(Vec<(u64, u64)>);

impl Glue {
    fn join(&mut self, cells: &[[u32; 4]], s: u32, t: u32) {
        for (s, t) in [(s, t), (t, s)] {
            self.across[s as usize] = t;
            self.far[s as usize] = cells[(t / 4) as usize][(t % 4) as usize];
        }
    }

    /// Matches the facets of a bucket; false if some clash, and then none are.
    fn match_by_table(&mut self, cells: &[[u32; 4]], bucket: &[u32], Table(table): &mut Table) -> bool {
        let size = (2 * bucket.len()).next_power_of_two();
        let shift = 64 - size.trailing_zeros();
        table.clear();
        table.resize(size, (0, 0));
        for &slot in bucket {
            let (key, marked) = keyed(facet(cells, slot), slot);
            // The golden ratio spreads consecutive keys best (Knuth).
            let mut place = (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> shift) as usize;
            while table[place].0 != key && table[place].0 != 0 {
                place = (place + 1) & (size - 1);
            }
            let (found, other) = &mut table[place];
            if *found == 0 {
                (*found, *other) = (key, marked);
            } else if (*other ^ marked) >> 32 == 1 {
                self.join(cells, *other as u32, slot);
                *other |= 2 << 32;
            } else {
                for &slot in bucket {
                    self.across[slot as usize] = BORDER;
                    self.far[slot as usize] = BORDER;
                }
                return false;
            }
        }
        true
    }

    /// Matches the facets of a bucket and reports what clashes.
    fn match_by_sorting(&mut self, cells: &[[u32; 4]], bucket: &[u32]) {
        let mut facets: Vec<(u64, u64)> = bucket.iter().map(|&slot| keyed(facet(cells, slot), slot)).collect();
        facets.sort_unstable();
        for same in facets.chunk_by(|a, b| a.0 == b.0) {
            match *same {
                [_] => {}
                [(_, s), (_, t)] if (s ^ t) >> 32 == 1 => self.join(cells, s as u32, t as u32),
                _ => self.clashes.push(same.iter().map(|s| s.1 as u32).collect()),
            }
        }
    }
}

/// Slots by the smallest vertex of their facets: where each bucket ends, and the slots.
fn buckets(cells: &[[u32; 4]], vertices: usize) -> (Vec<u32>, Vec<u32>) {
    // The smallest corner is in three facets; the fourth has the second smallest.
    let mut starts = vec![0u32; vertices];
    for cell in cells {
        let (k, second) = two_smallest(cell);
        starts[cell[k] as usize] += 3;
        starts[second as usize] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    let mut slots = vec![0u32; sum as usize];
    for (t, cell) in cells.iter().enumerate() {
        let (smallest, second) = two_smallest(cell);
        for k in 0..4 {
            let place = &mut starts[(if k == smallest { second } else { cell[smallest] }) as usize];
            slots[*place as usize] = 4 * t as u32 + k as u32;
            *place += 1;
        }
    }
    // Filling has moved each start to its end.
    (starts, slots)
}

/// Where the smallest corner is, and the second smallest corner.
#[inline]
fn two_smallest(&[a, b, c, d]: &[u32; 4]) -> (usize, u32) {
    let (i, ab, second_ab) = if a < b { (0, a, b) } else { (1, b, a) };
    let (j, cd, second_cd) = if c < d { (2, c, d) } else { (3, d, c) };
    if ab < cd { (i, second_ab.min(cd)) } else { (j, second_cd.min(ab)) }
}

/// The two larger vertices of a facet; its slot, with bit 32 set where the facet turns from the larger to the smaller of them.
#[inline]
fn keyed([a, b, c]: [u32; 3], slot: u32) -> (u64, u64) {
    let (b, c) = if a < b && a < c {
        (b, c)
    } else if b < c {
        (c, a)
    } else {
        (a, b)
    };
    let turned = b > c;
    (u64::from(b.min(c)) << 32 | u64::from(b.max(c)), u64::from(turned) << 32 | u64::from(slot))
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
        let mut far = across.clone();
        (across[3], across[4], far[3], far[4]) = (4, 3, 4, 3);
        assert_eq!(pair, Glue { across, far, clashes: vec![] });
        let same_side = glue(&[[0, 1, 2, 3], [0, 1, 2, 4]], 5);
        let none = vec![BORDER; 8];
        assert_eq!(same_side, Glue { across: none.clone(), far: none, clashes: vec![vec![3, 7]] });
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
