//! Quality and topology. Figures are computed in doubles and told; only a quality that is claimed is decided, exactly.

use super::border::Border;
use super::complex::Complex;
use super::report::{Claim, ClaimReport, Witness};
use crate::audit::figures::Classes;
use crate::audit::report::Verdict;
use crate::check::space::double::sign_in_space;
use crate::check::space::glue::{BORDER, FACETS, glue};
use crate::check::space::predicates::{Corners, cross, dot, vector};
use crate::check::value::Number;
use crate::model::{Point3, Sign};

/// How many of the worst cells are shown.
const WORST: usize = 5;

/// A sliver has a radius-edge ratio that the usual refinement allows, and yet a dihedral angle (degrees) below this.
const SLIVER: (f64, f64) = (2.0, 5.0);

/// Dihedral angles in steps of 10 degrees; the names of figures, each for the angles from it to the next.
const STEPS: [&str; 18] = [
    "dihedral_from_0",
    "dihedral_from_10",
    "dihedral_from_20",
    "dihedral_from_30",
    "dihedral_from_40",
    "dihedral_from_50",
    "dihedral_from_60",
    "dihedral_from_70",
    "dihedral_from_80",
    "dihedral_from_90",
    "dihedral_from_100",
    "dihedral_from_110",
    "dihedral_from_120",
    "dihedral_from_130",
    "dihedral_from_140",
    "dihedral_from_150",
    "dihedral_from_160",
    "dihedral_from_170",
];

/// Shape of a cell: six dihedral angles in degrees, circumradius over shortest edge, volume in scaled units.
struct Shape {
    dihedral: [f64; 6],
    ratio: f64,
    volume: f64,
}

impl Shape {
    fn of(t: &Corners) -> Self {
        let p = t.map(|p| p.at);
        let (u, v, w) = (p[1] - p[0], p[2] - p[0], p[3] - p[0]);
        let six = u.dot(v.cross(w));
        // Normals that point inward: the angle between two facets is that of one normal and the reverse of the other.
        let normal = FACETS.map(|[i, j, k]| (p[j] - p[i]).cross(p[k] - p[i]));
        let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        let dihedral = pairs.map(|(i, j)| {
            let (m, n) = (normal[i], -normal[j]);
            m.cross(n).length().atan2(m.dot(n)).to_degrees()
        });
        let shortest2 = pairs.iter().fold(f64::INFINITY, |s, &(i, j)| s.min(p[i].distance_squared(p[j])));
        let center =
            u.length_squared() * v.cross(w) + v.length_squared() * w.cross(u) + w.length_squared() * u.cross(v);
        Shape { dihedral, ratio: center.length() / (2.0 * six) / shortest2.sqrt(), volume: six / 6.0 }
    }

    fn least(&self) -> f64 {
        self.dihedral.iter().fold(180.0, |m, &a| m.min(a))
    }
}

/// Ratios, dihedral angles, volumes; the cells of least angle as witnesses.
pub(super) fn quality(complex: &Complex<'_>, radius_edge: Option<f64>) -> ClaimReport {
    let mut report = ClaimReport { verdict: Verdict::Told, ..ClaimReport::new(Claim::Quality) };
    if complex.cells.is_empty() {
        report.message = "there is no cell".into();
        return report;
    }
    let (mut least, mut largest, mut ratio, mut least_ratio) = (180.0f64, 0.0f64, 0.0f64, f64::INFINITY);
    let (mut steps, mut slivers) = ([0u64; 18], 0u64);
    let (mut small, mut large) = (f64::INFINITY, 0.0f64);
    // The worst so far, the least bad last.
    let mut worst: Vec<(f64, u32)> = Vec::with_capacity(WORST + 1);
    for t in 0..complex.cells.len() as u32 {
        let s = Shape::of(&complex.corners(t));
        let least_here = s.least();
        for angle in s.dihedral {
            largest = largest.max(angle);
            steps[((angle / 10.0) as usize).min(17)] += 1;
        }
        least = least.min(least_here);
        (ratio, least_ratio) = (ratio.max(s.ratio), least_ratio.min(s.ratio));
        (small, large) = (small.min(s.volume), large.max(s.volume));
        slivers += u64::from(s.ratio <= SLIVER.0 && least_here < SLIVER.1);
        if worst.len() < WORST || worst[WORST - 1].0 > least_here {
            let place = worst.partition_point(|w| w.0 <= least_here);
            worst.insert(place, (least_here, t));
            worst.truncate(WORST);
        }
    }
    report.message = format!(
        "dihedral angles from {least:.4} to {largest:.4} degrees, circumradius at most {ratio:.4} shortest edges, {slivers} slivers"
    );
    let unit = complex.unit();
    let cube = |volume: f64| volume * unit * unit * unit;
    report.figures = vec![
        ("cells", complex.cells.len() as f64),
        ("min_dihedral", least),
        ("max_dihedral", largest),
        ("min_radius_edge", least_ratio),
        ("max_radius_edge", ratio),
        ("min_volume", cube(small)),
        ("max_volume", cube(large)),
        ("slivers", slivers as f64),
    ];
    report.figures.extend(STEPS.iter().zip(steps).map(|(&name, n)| (name, n as f64)));
    match radius_edge {
        Some(rho) => claimed(complex, rho, &mut report),
        None => {
            for &(angle, t) in &worst {
                let (file, vertices) = (complex.in_file[t as usize], complex.cells[t as usize]);
                let message = format!("cell {file} {vertices:?} has a dihedral angle of {angle:.4} degrees");
                report.witnesses.push(Witness::new(complex.subject, &vertices, &[file], message));
            }
        }
    }
    report
}

/// Decides a claimed ratio.
fn claimed(complex: &Complex<'_>, rho: f64, report: &mut ClaimReport) {
    report.verdict = Verdict::Holds;
    for t in 0..complex.cells.len() as u32 {
        let corners = complex.corners(t);
        if is_skinny(&corners, rho) {
            let (file, vertices) = (complex.in_file[t as usize], complex.cells[t as usize]);
            let ratio = Shape::of(&corners).ratio;
            report.violated(complex.subject, &vertices, &[file], || {
                format!("cell {file} {vertices:?} is skinny, with a circumradius of {ratio:.4} shortest edges")
            });
        }
    }
}

/// Whether the circumradius is at least rho times the shortest edge: |S|^2 >= 4 rho^2 D^2 l^2 with an edge l (the circumcenter is S / 2D from
/// the first corner).
fn is_skinny(t: &Corners, rho: f64) -> bool {
    let p = t.map(|p| p.at);
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    pairs.iter().any(|&(i, j)| sign_in_space!(skinny_in(&p, [p[i], p[j]], rho)) != Sign::Negative)
}

fn skinny_in<N: Number>(p: &[Point3; 4], edge: [Point3; 2], rho: f64) -> N {
    let [u, v, w] = [p[1], p[2], p[3]].map(|x| vector::<N>(p[0], x));
    let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
    let lifts = [dot(&u, &u), dot(&v, &v), dot(&w, &w)];
    let axis = |k: usize| {
        lifts[0].clone() * vw[k].clone() + lifts[1].clone() * wu[k].clone() + lifts[2].clone() * uv[k].clone()
    };
    let center = [axis(0), axis(1), axis(2)];
    let l = vector::<N>(edge[0], edge[1]);
    let bound = N::of(2.0) * N::of(rho) * dot(&u, &vw);
    dot(&center, &center) - bound.square() * dot(&l, &l)
}

/// Distinct edges: each is counted at its smaller vertex, where a stamp tells the larger ones seen.
fn edges(complex: &Complex<'_>) -> usize {
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let mut starts = vec![0u32; complex.sites.len() + 1];
    let ends = |cell: &[u32; 4]| pairs.map(|(i, j)| (cell[i].min(cell[j]), cell[i].max(cell[j])));
    for cell in &complex.cells {
        ends(cell).iter().for_each(|e| starts[e.0 as usize] += 1);
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    let mut larger = vec![0u32; sum as usize];
    for cell in &complex.cells {
        for (u, v) in ends(cell) {
            larger[starts[u as usize] as usize] = v;
            starts[u as usize] += 1;
        }
    }
    let mut stamp = vec![u32::MAX; complex.sites.len()];
    let (mut count, mut from) = (0, 0);
    for (u, &end) in (0u32..).zip(&starts) {
        for &v in &larger[from as usize..end as usize] {
            count += usize::from(stamp[v as usize] != u);
            stamp[v as usize] = u;
        }
        from = end;
    }
    count
}

/// Counts, components, Euler characteristic; the border's components where the border was examined.
pub(super) fn topology(complex: &Complex<'_>, border: Option<&Border<'_>>) -> ClaimReport {
    let mut by_vertex = Classes::new(complex.sites.len());
    let mut by_facet = Classes::new(complex.cells.len());
    let vertices = complex.used().into_iter().filter(|&u| u).count();
    let (mut components, mut strong_components) = (vertices, complex.cells.len());
    let mut shared = 0;
    let across = glue(&complex.cells, complex.sites.len()).across;
    for (t, cell) in (0u32..).zip(&complex.cells) {
        components -= (1..4).filter(|&k| by_vertex.join(cell[0], cell[k])).count();
        for &slot in across[4 * t as usize..4 * t as usize + 4].iter().filter(|&&s| s != BORDER) {
            shared += usize::from(slot / 4 > t);
            strong_components -= usize::from(by_facet.join(t, slot / 4));
        }
    }
    let (cells, edges) = (complex.cells.len(), edges(complex));
    let facets = 4 * cells - shared;
    let euler = vertices as f64 - edges as f64 + facets as f64 - cells as f64;
    let mut report = ClaimReport { verdict: Verdict::Told, ..ClaimReport::new(Claim::Topology) };
    report.message = format!(
        "{components} component{}, {cells} cells, Euler characteristic {euler}",
        if components == 1 { "" } else { "s" }
    );
    report.figures = vec![
        ("vertices", vertices as f64),
        ("edges", edges as f64),
        ("facets", facets as f64),
        ("cells", cells as f64),
        ("components", components as f64),
        ("facet_connected_components", strong_components as f64),
        ("euler_characteristic", euler),
        ("border_facets", (facets - shared) as f64),
        ("points_in_no_cell", (complex.sites.len() - vertices) as f64),
    ];
    if let Some(border) = border {
        let mut on_border = vec![false; complex.sites.len()];
        border.facets.iter().flatten().for_each(|&v| on_border[v as usize] = true);
        let on_border = on_border.iter().filter(|b| **b).count() as f64;
        report.figures.extend([
            ("border_components", border.components().1 as f64),
            ("border_euler_characteristic", on_border - border.edge_count() as f64 + border.facets.len() as f64),
            ("border_vertices", on_border),
            ("border_branching_edges", border.branching_edges() as f64),
        ]);
    }
    report
}
