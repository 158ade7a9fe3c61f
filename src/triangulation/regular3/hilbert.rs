//! The Hilbert curve of space.

use crate::model::{Point3, WeightedPoint};
use crate::triangulation::spatial::OnCurve;

impl OnCurve for WeightedPoint {
    const BITS_PER_ROUND: u32 = 3;
    const FIRST_ROUND: usize = 512;
    const CROWD: usize = 2;

    /// The lower corner of the bounding cube, and how many cells a unit has.
    type Frame = (Point3, f64);

    fn frame(points: impl Iterator<Item = WeightedPoint>) -> Option<(Point3, f64)> {
        let mut places = points.map(|p| p.at);
        let first = places.next()?;
        let (low, high) = places.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        let extent = (high - low).max_element();
        let scale = f64::from(SIDE - 1) / extent;
        // The reciprocal of a tiny extent overflows; such points keep their order.
        (extent > 0.0 && scale.is_finite()).then_some((low, scale))
    }

    fn place(self, (low, scale): (Point3, f64)) -> u32 {
        // Saturating conversions and the mask: no value leaves 0..SIDE, whatever the rounding.
        let cell = (self.at - low) * scale;
        hilbert([cell.x as u32, cell.y as u32, cell.z as u32])
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangulation::spatial::insertion_order;

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
