//! The Hilbert curve of the plane.

use crate::model::Point2;
use crate::triangulation::spatial::OnCurve;

impl OnCurve for Point2 {
    const BITS_PER_ROUND: u32 = 2;
    const FIRST_ROUND: usize = 1024;
    const CROWD: usize = 8;

    /// The lower corner of the bounding square, and how many cells a unit has.
    type Frame = (Point2, f64);

    fn frame(mut points: impl Iterator<Item = Point2>) -> Option<(Point2, f64)> {
        let first = points.next()?;
        let (low, high) = points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        let extent = (high - low).max_element();
        (extent > 0.0).then_some((low, 65535.0 / extent))
    }

    fn place(self, (low, scale): (Point2, f64)) -> u32 {
        // Saturating conversions: no value leaves 0..=65535, whatever the rounding.
        let cell = (self - low) * scale;
        hilbert(cell.x as u16, cell.y as u16)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangulation::spatial::insertion_order;

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
