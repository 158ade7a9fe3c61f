//! An order of points in which neighbors in the order are neighbors in the plane, or in space.
//!
//! Rounds of geometrically growing random samples, each along a Hilbert curve (a biased randomised insertion order: Amenta, Choi and Rote,
//! "Incremental constructions con BRIO", 2003). The samples are a hash of the position, so the order depends on the input alone; it decides how
//! fast a triangulation is built, never what it is. That is why plain floating point may serve here.

/// Points that have a curve.
pub(super) trait OnCurve: Copy {
    /// One round holds this many bits' worth fewer points than the next.
    const BITS_PER_ROUND: u32;
    /// The first round holds about this many points or fewer.
    const FIRST_ROUND: usize;
    /// Points in one cell of the curve are left as they are up to this number, else sorted along a curve of their own.
    const CROWD: usize;

    /// What a curve fills: a square, or a cube.
    type Frame: Copy;

    /// The frame around some points; nothing if there is nothing to sort.
    fn frame(points: impl Iterator<Item = Self>) -> Option<Self::Frame>;

    /// Where its cell is on the curve.
    fn place(self, frame: Self::Frame) -> u32;
}

/// Below this size comparison sorting is faster than a radix sort with its tables.
const RADIX_FROM: usize = 4096;

/// Positions of the points in insertion order.
pub(super) fn insertion_order<P: OnCurve>(points: &[P]) -> Vec<u32> {
    let mut rounds = 0;
    while points.len() >> (P::BITS_PER_ROUND * rounds) > P::FIRST_ROUND {
        rounds += 1;
    }
    let round_of = |i: u32| rounds - (hash(i).trailing_zeros() / P::BITS_PER_ROUND).min(rounds);
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

/// Sorts positions (low halves of the entries) along the curve in the frame of their points; crowded cells recursively.
fn sort_along_curve<P: OnCurve>(points: &[P], entries: &mut [u64], spare: &mut Vec<u64>) {
    let at = |entry: u64| points[entry as u32 as usize];
    let Some(frame) = P::frame(entries.iter().map(|&entry| at(entry))) else {
        return;
    };
    for entry in entries.iter_mut() {
        *entry = u64::from(at(*entry).place(frame)) << 32 | (*entry & 0xffff_ffff);
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
        // Each level shrinks the frame 2^10 times or more, so the depth is bounded by the range of coordinates.
        if end - start > P::CROWD && end - start < entries.len() {
            sort_along_curve(points, &mut entries[start..end], spare);
        }
        start = end;
    }
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
