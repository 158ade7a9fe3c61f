//! An order of points in which neighbors in the order are neighbors in the plane.
//!
//! Rounds of geometrically growing random samples, each along a Hilbert curve (a biased randomised insertion order: Amenta, Choi
//! and Rote, "Incremental constructions con BRIO"). The samples are a hash of the position, so the order depends on the input alone; it
//! decides how fast the triangulation is built, never what it is. That is why plain floating point may serve here.

use crate::model::Point2;

/// One round holds this many bits' worth fewer points than the next: a quarter.
const BITS_PER_ROUND: u32 = 2;
/// The first round holds about this many points or fewer.
const FIRST_ROUND: usize = 1024;
/// Groups in one cell of the curve are left as they are up to this size, else sorted along a curve of their own.
const CELL: usize = 8;
/// Below this size comparison sorting is faster than a radix sort with its tables.
const RADIX_FROM: usize = 4096;

/// Positions of the points in insertion order.
pub(super) fn insertion_order(points: &[Point2]) -> Vec<u32> {
    let mut rounds = 0;
    while points.len() >> (BITS_PER_ROUND * rounds) > FIRST_ROUND {
        rounds += 1;
    }
    let round_of = |i: u32| rounds - (hash(i).trailing_zeros() / BITS_PER_ROUND).min(rounds);
    let mut starts = vec![0usize; rounds as usize + 2];
    let n = points.len() as u32;
    for i in 0..n {
        starts[round_of(i) as usize + 1] += 1;
    }
    for r in 0..=rounds as usize {
        starts[r + 1] += starts[r];
    }
    let mut order = vec![0u64; points.len()];
    let mut fill = starts.clone();
    for i in 0..n {
        let place = &mut fill[round_of(i) as usize];
        order[*place] = u64::from(i);
        *place += 1;
    }
    let mut spare = Vec::new();
    for r in 0..=rounds as usize {
        sort_along_curve(points, &mut order[starts[r]..starts[r + 1]], &mut spare);
    }
    order.into_iter().map(|entry| entry as u32).collect()
}

/// A mixing function (the finalizer of splitmix64).
fn hash(i: u32) -> u64 {
    let mut z = (u64::from(i) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Sorts positions (low halves of the entries) along the Hilbert curve over their bounding square; crowded cells recursively.
fn sort_along_curve(points: &[Point2], entries: &mut [u64], spare: &mut Vec<u64>) {
    let at = |entry: u64| points[entry as u32 as usize];
    let Some(&first) = entries.first() else {
        return;
    };
    let (mut low, mut high) = (at(first), at(first));
    for &entry in entries.iter() {
        low = low.min(at(entry));
        high = high.max(at(entry));
    }
    let extent = (high - low).max_element();
    if extent <= 0.0 {
        return;
    }
    let scale = 65535.0 / extent;
    for entry in entries.iter_mut() {
        // Saturating conversions: no value leaves 0..=65535, whatever the rounding.
        let cell = (at(*entry) - low) * scale;
        let key = hilbert(cell.x as u16, cell.y as u16);
        *entry = u64::from(key) << 32 | (*entry & 0xffff_ffff);
    }
    if entries.len() < RADIX_FROM {
        entries.sort_unstable();
    } else {
        radix_sort(entries, spare);
    }
    let mut start = 0;
    while start < entries.len() {
        let key = entries[start] >> 32;
        let mut end = start + 1;
        while end < entries.len() && entries[end] >> 32 == key {
            end += 1;
        }
        // Each level shrinks the square 2^16 times, so the depth is below 70 in the range of coordinates.
        if end - start > CELL && end - start < entries.len() {
            sort_along_curve(points, &mut entries[start..end], spare);
        }
        start = end;
    }
}

/// One level of the curve: for each of its four orientations, quadrant (x bit, y bit) to (rank along the curve, orientation inside).
const LEVEL: [[(u8, u8); 4]; 4] = [
    [(0, 1), (1, 0), (3, 3), (2, 0)],
    [(0, 0), (3, 2), (1, 1), (2, 1)],
    [(2, 2), (3, 1), (1, 2), (0, 3)],
    [(2, 3), (1, 3), (3, 0), (0, 2)],
];

/// Four levels at once: 4 bits of x and of y to 8 bits of rank, and the orientation inside above them.
const LEVELS: [[u16; 256]; 4] = {
    let mut table = [[0; 256]; 4];
    let mut start = 0;
    while start < 4 {
        let mut cell = 0;
        while cell < 256 {
            let (x, y) = (cell >> 4, cell & 15);
            let (mut rank, mut state, mut bit) = (0u16, start, 4);
            while bit > 0 {
                bit -= 1;
                let (quarter, inside) = LEVEL[state][(x >> bit & 1) << 1 | (y >> bit & 1)];
                rank = rank << 2 | quarter as u16;
                state = inside as usize;
            }
            table[start][cell] = (state as u16) << 8 | rank;
            cell += 1;
        }
        start += 1;
    }
    table
};

/// Position of a cell on the Hilbert curve of order 16.
fn hilbert(x: u16, y: u16) -> u32 {
    let (mut key, mut state) = (0, 0);
    for shift in [12, 8, 4, 0] {
        let entry = LEVELS[state][usize::from((x >> shift & 15) << 4 | (y >> shift & 15))];
        key = key << 8 | u32::from(entry & 255);
        state = usize::from(entry >> 8) & 3;
    }
    key
}

/// Sorts by the high halves, least significant digits first.
fn radix_sort(entries: &mut [u64], spare: &mut Vec<u64>) {
    const BITS: u32 = 11;
    const MASK: u64 = (1 << BITS) - 1;
    let n = entries.len();
    spare.clear();
    spare.resize(n, 0);
    for pass in 0..3 {
        let shift = 32 + BITS * pass;
        let mut places = [0u32; 1 << BITS];
        for &entry in entries.iter() {
            places[(entry >> shift & MASK) as usize] += 1;
        }
        let mut sum = 0;
        for place in &mut places {
            sum += std::mem::replace(place, sum);
        }
        for &entry in entries.iter() {
            let place = &mut places[(entry >> shift & MASK) as usize];
            spare[*place as usize] = entry;
            *place += 1;
        }
        entries.copy_from_slice(spare);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_visits_neighboring_cells() {
        let mut cells: Vec<(u32, u16, u16)> =
            (0..64).flat_map(|x| (0..64).map(move |y| (hilbert(x << 10, y << 10), x, y))).collect();
        cells.sort_unstable();
        for pair in cells.windows(2) {
            let (_, a, b) = pair[0];
            let (_, c, d) = pair[1];
            assert_eq!(a.abs_diff(c) + b.abs_diff(d), 1, "{pair:?}");
        }
    }

    #[test]
    fn the_order_is_a_permutation_also_of_crowded_points() {
        let points: Vec<Point2> =
            (0..10_000).map(|i| Point2::new(f64::from(i % 97) * 1e-12, f64::from(i / 97) * 1e-12)).collect();
        let far = Point2::new(1.0, 1.0);
        let mut order = insertion_order(&[points, vec![far]].concat());
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..10_001));
    }
}
