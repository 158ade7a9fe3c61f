//! What \[GCDR\] prints: Table 7.1 and the caption of Figure 7.1.

/// A row of Table 7.1: a configuration of the two experiments, at rho = sqrt 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its number in the table.
    pub number: u32,
    /// delta2.
    pub d2: f64,
    /// delta1.
    pub d1: f64,
    /// mu.
    pub mu: f64,
    /// Columns 5-7: the bounds of the densities of Type-A, B, C vertices by (5.23).
    pub bounds: [f64; 3],
    /// Columns 8-10: largest densities of Type-A, B, C vertices, Experiment 1.
    pub extreme: [f64; 3],
    /// Column 11: triangles, Experiment 1.
    pub triangles: u32,
    /// Columns 12-14: largest densities, Experiment 2.
    pub random: [f64; 3],
}

/// Triangles of the mesh of Figure 7.1 (right), rho = 1.
pub const FIGURE_TRIANGLES: u32 = 3200;

/// Table 7.1.
#[rustfmt::skip]
pub const TABLE: [Row; 32] = [
    Row { number: 1, d2: 1.0, d1: 1.0, mu: 1.0, bounds: [3.41, 4.94, 1.0], extreme: [1.93, 0.7, 1.0], triangles: 1583, random: [1.93, 0.7, 1.0] },
    Row { number: 2, d2: 1.0, d1: 1.0, mu: 0.8, bounds: [3.41, 4.94, 1.5], extreme: [1.75, 0.68, 1.0], triangles: 1814, random: [2.21, 0.74, 1.0] },
    Row { number: 3, d2: 1.0, d1: 1.0, mu: 0.6, bounds: [3.41, 4.94, 2.33], extreme: [2.19, 0.7, 1.15], triangles: 2052, random: [2.41, 0.74, 1.2] },
    Row { number: 4, d2: 1.0, d1: 1.0, mu: 0.4, bounds: [3.83, 4.94, 4.0], extreme: [2.2, 1.01, 1.99], triangles: 2557, random: [2.49, 1.09, 2.19] },
    Row { number: 5, d2: 1.0, d1: 0.9, mu: 1.0, bounds: [5.03, 5.7, 1.0], extreme: [1.6, 0.79, 1.0], triangles: 1571, random: [1.99, 0.8, 1.0] },
    Row { number: 6, d2: 1.0, d1: 0.9, mu: 0.8, bounds: [5.03, 5.7, 1.5], extreme: [1.48, 0.76, 1.0], triangles: 1804, random: [2.19, 0.79, 1.0] },
    Row { number: 7, d2: 1.0, d1: 0.9, mu: 0.6, bounds: [5.03, 5.7, 2.33], extreme: [2.02, 0.78, 1.15], triangles: 2047, random: [2.35, 0.8, 1.19] },
    Row { number: 8, d2: 1.0, d1: 0.9, mu: 0.4, bounds: [5.03, 5.7, 4.0], extreme: [2.23, 0.86, 1.66], triangles: 2546, random: [2.5, 1.15, 2.06] },
    Row { number: 9, d2: 1.0, d1: 0.8, mu: 1.0, bounds: [10.13, 12.92, 1.0], extreme: [1.6, 0.87, 1.0], triangles: 1565, random: [1.85, 0.89, 1.0] },
    Row { number: 10, d2: 1.0, d1: 0.8, mu: 0.8, bounds: [10.13, 12.92, 1.5], extreme: [1.95, 0.86, 1.0], triangles: 1818, random: [2.18, 0.91, 1.0] },
    Row { number: 11, d2: 1.0, d1: 0.8, mu: 0.6, bounds: [10.13, 12.92, 2.33], extreme: [2.02, 0.88, 1.15], triangles: 2047, random: [2.64, 0.9, 1.22] },
    Row { number: 12, d2: 1.0, d1: 0.8, mu: 0.4, bounds: [10.13, 12.92, 4.0], extreme: [2.37, 0.97, 1.69], triangles: 2505, random: [2.48, 1.61, 2.11] },
    Row { number: 13, d2: 0.9, d1: 1.0, mu: 1.0, bounds: [5.7, 7.69, 1.0], extreme: [2.26, 0.7, 1.0], triangles: 1586, random: [2.41, 0.7, 1.0] },
    Row { number: 14, d2: 0.9, d1: 1.0, mu: 0.8, bounds: [5.7, 7.69, 1.5], extreme: [1.99, 0.71, 1.0], triangles: 1799, random: [2.57, 0.76, 1.0] },
    Row { number: 15, d2: 0.9, d1: 1.0, mu: 0.6, bounds: [5.7, 7.69, 2.33], extreme: [2.63, 0.7, 1.15], triangles: 2055, random: [2.63, 0.76, 1.24] },
    Row { number: 16, d2: 0.9, d1: 1.0, mu: 0.4, bounds: [5.7, 7.69, 4.0], extreme: [2.61, 1.01, 1.95], triangles: 2595, random: [2.62, 1.02, 2.26] },
    Row { number: 17, d2: 0.9, d1: 0.9, mu: 1.0, bounds: [6.22, 8.66, 1.0], extreme: [2.04, 0.77, 1.0], triangles: 1540, random: [2.7, 0.82, 1.0] },
    Row { number: 18, d2: 0.9, d1: 0.9, mu: 0.8, bounds: [6.22, 8.66, 1.5], extreme: [1.98, 0.76, 1.0], triangles: 1807, random: [2.49, 0.81, 1.0] },
    Row { number: 19, d2: 0.9, d1: 0.9, mu: 0.6, bounds: [6.22, 8.66, 2.33], extreme: [2.79, 0.78, 1.15], triangles: 2083, random: [2.79, 0.83, 1.2] },
    Row { number: 20, d2: 0.9, d1: 0.9, mu: 0.4, bounds: [6.22, 8.66, 4.0], extreme: [2.6, 1.07, 1.93], triangles: 2578, random: [2.84, 1.4, 2.13] },
    Row { number: 21, d2: 0.9, d1: 0.8, mu: 1.0, bounds: [12.7, 14.61, 1.0], extreme: [2.47, 0.87, 1.0], triangles: 1541, random: [2.47, 0.92, 1.0] },
    Row { number: 22, d2: 0.9, d1: 0.8, mu: 0.8, bounds: [12.7, 14.61, 1.5], extreme: [2.53, 0.87, 1.0], triangles: 1811, random: [2.56, 0.92, 1.0] },
    Row { number: 23, d2: 0.9, d1: 0.8, mu: 0.6, bounds: [12.7, 14.61, 2.33], extreme: [2.79, 0.88, 1.15], triangles: 2091, random: [2.57, 0.91, 1.2] },
    Row { number: 24, d2: 0.9, d1: 0.8, mu: 0.4, bounds: [12.7, 14.61, 4.0], extreme: [2.52, 1.21, 1.93], triangles: 2540, random: [2.71, 1.25, 1.94] },
    Row { number: 25, d2: 0.8, d1: 1.0, mu: 1.0, bounds: [12.92, 16.14, 1.0], extreme: [2.71, 0.7, 1.0], triangles: 1615, random: [2.81, 0.7, 1.0] },
    Row { number: 26, d2: 0.8, d1: 1.0, mu: 0.8, bounds: [12.92, 16.14, 1.5], extreme: [4.32, 0.71, 1.0], triangles: 1868, random: [4.32, 0.78, 1.0] },
    Row { number: 27, d2: 0.8, d1: 1.0, mu: 0.6, bounds: [12.92, 16.14, 2.33], extreme: [3.65, 0.7, 1.15], triangles: 2139, random: [3.65, 0.78, 1.2] },
    Row { number: 28, d2: 0.8, d1: 1.0, mu: 0.4, bounds: [12.92, 16.14, 4.0], extreme: [3.73, 0.97, 1.95], triangles: 2628, random: [3.54, 1.35, 2.1] },
    Row { number: 29, d2: 0.8, d1: 0.9, mu: 1.0, bounds: [12.92, 18.05, 1.0], extreme: [2.46, 0.77, 1.0], triangles: 1562, random: [3.15, 0.84, 1.0] },
    Row { number: 30, d2: 0.8, d1: 0.9, mu: 0.8, bounds: [12.92, 18.05, 1.5], extreme: [3.47, 0.76, 1.0], triangles: 1843, random: [2.96, 0.85, 1.0] },
    Row { number: 31, d2: 0.8, d1: 0.9, mu: 0.6, bounds: [12.92, 18.05, 2.33], extreme: [3.53, 0.83, 1.15], triangles: 2118, random: [2.9, 0.83, 1.21] },
    Row { number: 32, d2: 0.8, d1: 0.9, mu: 0.4, bounds: [12.92, 18.05, 4.0], extreme: [3.31, 1.07, 1.93], triangles: 2615, random: [3.26, 1.23, 1.95] },
];
