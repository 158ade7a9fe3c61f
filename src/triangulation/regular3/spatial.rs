//! An order of points in which neighbors in the order are neighbors in space.
//!
//! Rounds of geometrically growing random samples, each along a Hilbert curve (a biased randomised insertion order: Amenta, Choi and Rote,
//! "Incremental constructions con BRIO", 2003). The samples are a hash of the position, so the order depends on the input alone; it decides how
//! fast the triangulation is built, never what it is. That is why plain floating point may serve here.

use crate::model::{Point3, WeightedPoint};

/// One round holds this many bits' worth fewer points than the next: an eighth.
const BITS_PER_ROUND: u32 = 3;
/// The first round holds about this many points or fewer.
const FIRST_ROUND: usize = 512;
/// Groups in one cell of the curve are left as they are up to this size, else sorted along a curve of their own.
const CELL: usize = 2;
/// Below this size comparison sorting is faster than a radix sort with its tables.
const RADIX_FROM: usize = 4096;

/// Positions of the points in insertion order.
pub(super) fn insertion_order(points: &[WeightedPoint]) -> Vec<u32> {
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
pub(super) fn hash(i: u32) -> u64 {
    let mut z = (u64::from(i) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Sorts positions (low halves of the entries) along the Hilbert curve over their bounding cube; crowded cells recursively.
fn sort_along_curve(points: &[WeightedPoint], entries: &mut [u64], spare: &mut Vec<u64>) {
    let at = |entry: u64| points[entry as u32 as usize].at;
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
    let scale = Point3::splat(f64::from(SIDE - 1) / extent);
    // The reciprocal of a tiny extent overflows; such points keep their order.
    if !scale.x.is_finite() {
        return;
    }
    for entry in entries.iter_mut() {
        // Saturating conversions and the mask: no value leaves 0..SIDE, whatever the rounding.
        let cell = (at(*entry) - low) * scale;
        let key = hilbert([cell.x as u32, cell.y as u32, cell.z as u32]);
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
        // Each level shrinks the cube 2^10 times, so the depth is bounded by the range of coordinates.
        if end - start > CELL && end - start < entries.len() {
            sort_along_curve(points, &mut entries[start..end], spare);
        }
        start = end;
    }
}

/// Cells along a side of the cube.
const SIDE: u32 = 1 << 10;

/// The curve in one level of octants, for each of its orientations: octant (bits of x, y, z) to rank along the curve and orientation inside.
///
/// Source: Hamilton and Rau-Chaplin, "Compact Hilbert indices" (2008), section 2: the curve enters an octant at corner e and leaves it along axis d;
/// octants are visited in the order of the Gray code, rotated and reflected by (e, d). Orientation `e + 8 d`.
const LEVEL: [[(u8, u8); 8]; 24] = {
    let mut table = [[(0, 0); 8]; 24];
    let mut state = 0;
    while state < 24 {
        let (e, d) = (state as u32 % 8, state as u32 / 8);
        let mut octant = 0;
        while octant < 8 {
            let gray = rotate_right(octant ^ e, d + 1);
            let w = gray ^ gray >> 1 ^ gray >> 2;
            // The corner where the curve enters the octant of rank w, and the axis along which it leaves it.
            let (entry, axis) = match w {
                0 => (0, 0),
                _ => {
                    let even = 2 * ((w - 1) / 2);
                    (even ^ even >> 1, (if w & 1 == 0 { w - 1 } else { w }).trailing_ones() % 3)
                }
            };
            let inside = (e ^ rotate_right(entry, 3 - (d + 1) % 3)) + 8 * ((d + axis + 1) % 3);
            table[state][octant as usize] = (w as u8, inside as u8);
            octant += 1;
        }
        state += 1;
    }
    table
};

/// Three bits rotated right.
const fn rotate_right(bits: u32, by: u32) -> u32 {
    let by = by % 3;
    (bits >> by | bits << (3 - by)) & 7
}

/// Two levels at once: two bits of x, of y and of z to six bits of rank, and the orientation inside above them.
const LEVELS: [[u16; 64]; 24] = {
    let mut table = [[0; 64]; 24];
    let mut state = 0;
    while state < 24 {
        let mut cell = 0;
        while cell < 64 {
            let (x, y, z) = (cell >> 4, cell >> 2 & 3, cell & 3);
            let (high, between) = LEVEL[state][(x >> 1) << 2 | (y >> 1) << 1 | z >> 1];
            let (low, inside) = LEVEL[between as usize][(x & 1) << 2 | (y & 1) << 1 | z & 1];
            table[state][cell] = (inside as u16) << 6 | (high as u16) << 3 | low as u16;
            cell += 1;
        }
        state += 1;
    }
    table
};

/// Position of a cell on the Hilbert curve of order 10: 30 bits.
fn hilbert([x, y, z]: [u32; 3]) -> u32 {
    let (mut key, mut state) = (0, 0);
    for shift in [8, 6, 4, 2, 0] {
        let entry = LEVELS[state][((x >> shift & 3) << 4 | (y >> shift & 3) << 2 | z >> shift & 3) as usize];
        key = key << 6 | u32::from(entry & 63);
        state = usize::from(entry >> 6) % 24;
    }
    key
}

/// Sorts by the high halves (30 bits), least significant digits first.
fn radix_sort(entries: &mut [u64], spare: &mut Vec<u64>) {
    const BITS: u32 = 10;
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
        for shift in [0, 6] {
            let side = 0..16u32;
            let cells = side.clone().flat_map(|x| side.clone().flat_map(move |y| (0..16).map(move |z| [x, y, z])));
            let mut cells: Vec<_> = cells.map(|c| (hilbert(c.map(|x| x << shift)), c)).collect();
            cells.sort_unstable();
            for pair in cells.windows(2) {
                let steps = (0..3).map(|k| pair[0].1[k].abs_diff(pair[1].1[k])).sum::<u32>();
                assert_eq!(steps, 1, "{pair:?}");
            }
        }
    }

    #[test]
    fn the_order_is_a_permutation_also_of_crowded_points() {
        let at = |i: i32| 1e-12 * Point3::new(f64::from(i % 23), f64::from(i / 23 % 23), f64::from(i / 529));
        let mut points: Vec<_> = (0..10_000).map(|i| WeightedPoint::unweighted(at(i))).collect();
        points.push(WeightedPoint::unweighted(Point3::ONE));
        let mut order = insertion_order(&points);
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..10_001));
    }
}
