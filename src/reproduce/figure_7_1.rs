//! Figure 7.1 of \[GCDR\]: the squares, and their mesh at rho = 1.
//!
//! The paper's caption: rho = 1, 3200 triangles, angles above 30 degrees. The choice of points and the order of the queue are not
//! told; at rho = 1 all selection regions are points, and only the order is open. At this rho neither the paper's proof nor its correction
//! promises an end of the run (`docs/errata.md`, 4): it is `admissible`, and the budget stays on.

use super::published::FIGURE_TRIANGLES;
use super::squares::{Experiment, measure, parameters, squares};
use crate::model::{Mesh2, Point2, QueueOrder, VertexKind};
use crate::refine::RunError;
use crate::trace::Outcome;
use serde::Serialize;
use std::fmt;
use std::fmt::Write as _;

/// The figure, reproduced: one mesh per order of the queue.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// Triangles of the published mesh.
    pub published_triangles: u32,
    /// Our meshes.
    pub meshes: Vec<Panel>,
    /// The input and the meshes side by side, as SVG.
    #[serde(skip)]
    pub svg: String,
}

/// A mesh of the squares.
#[derive(Clone, Debug, Serialize)]
pub struct Panel {
    /// The order of the queue.
    pub order: QueueOrder,
    /// Whether the run met every criterion.
    pub complete: bool,
    /// Triangles.
    pub triangles: u32,
    /// Vertices.
    pub vertices: u32,
    /// Smallest angle in degrees, rounded.
    pub smallest_angle: f64,
    /// Largest densities, Type-A, B, C.
    pub densities: [f64; 3],
}

/// Meshes the squares at rho = 1 in each order of the queue.
///
/// Errors: those of a run.
pub fn figure_7_1() -> Result<Figure, RunError> {
    let mut meshes = Vec::new();
    let mut svg = String::new();
    draw_input(&mut svg);
    for order in [QueueOrder::Fifo, QueueOrder::WorstFirst, QueueOrder::ShortestEdge] {
        let measured = measure(&parameters(1.0, [1.0; 3], Experiment::Center, order))?;
        let run = &measured.run;
        meshes.push(Panel {
            order,
            complete: run.outcome == Outcome::Complete && measured.violation.is_none(),
            triangles: run.counts.triangles,
            vertices: run.counts.vertices,
            smallest_angle: smallest_angle(&run.mesh),
            densities: measured.densities(),
        });
        draw(&mut svg, meshes.len(), &run.mesh);
    }
    let width = 102 * (1 + meshes.len());
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-1 -1 {width} 102\" width=\"{}\" height=\"1020\">\n\
         <style>line{{stroke:#999;stroke-width:.06}}line.s{{stroke:#000;stroke-width:.15}}circle.f{{fill:#27c}}circle.g{{fill:#c30}}</style>\n\
         {svg}</svg>\n",
        10 * width
    );
    Ok(Figure { published_triangles: FIGURE_TRIANGLES, meshes, svg })
}

/// The smallest angle of a mesh in degrees, for display.
fn smallest_angle(mesh: &Mesh2) -> f64 {
    let corner = |a: Point2, b: Point2, c: Point2| (b - a).angle_to(c - a).abs().to_degrees();
    let angles = mesh
        .triangles
        .iter()
        .map(|t| mesh.corners(*t))
        .flat_map(|[a, b, c]| [corner(a, b, c), corner(b, c, a), corner(c, a, b)]);
    angles.fold(180.0, f64::min)
}

/// A line; y grows downward in SVG.
fn line(svg: &mut String, a: Point2, b: Point2, class: &str) {
    // writing to a string does not fail
    let _ = writeln!(
        svg,
        "<line class=\"{class}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>",
        a.x,
        100.0 - a.y,
        b.x,
        100.0 - b.y
    );
}

/// The left panel: the input.
fn draw_input(svg: &mut String) {
    let pslg = squares();
    for s in &pslg.segments {
        let [a, b] = s.ends.map(|v| pslg.points[v.index()]);
        line(svg, a, b, "s");
    }
}

/// Another panel: edges gray, subsegments black, free vertices blue, segment vertices red.
fn draw(svg: &mut String, panel: usize, mesh: &Mesh2) {
    let _ = writeln!(svg, "<g transform=\"translate({} 0)\">", 102 * panel);
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            if a < b {
                line(svg, mesh.points[a.index()], mesh.points[b.index()], "e");
            }
        }
    }
    for e in &mesh.edges {
        let [a, b] = e.ends.map(|v| mesh.points[v.index()]);
        line(svg, a, b, "s");
    }
    for (p, kind) in mesh.points.iter().zip(&mesh.kinds) {
        let class = match kind {
            VertexKind::Input => continue,
            VertexKind::Free => "f",
            VertexKind::Segment(_) => "g",
        };
        let _ = writeln!(svg, "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\".12\"/>", p.x, 100.0 - p.y);
    }
    svg.push_str("</g>\n");
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "[GCDR] Figure 7.1: five concentric squares at rho = 1; published: {} triangles, angles above 30 degrees.",
            self.published_triangles
        )?;
        writeln!(
            f,
            "{:<14} {:>9} {:>9} {:>6}  {:>14}  {:<22} complete",
            "order", "triangles", "vertices", "ratio", "smallest angle", "densities A / B / C"
        )?;
        for m in &self.meshes {
            let [a, b, c] = m.densities;
            let order = match m.order {
                QueueOrder::Fifo => "fifo",
                QueueOrder::WorstFirst => "worst-first",
                QueueOrder::ShortestEdge => "shortest-edge",
            };
            writeln!(
                f,
                "{order:<14} {:>9} {:>9} {:>6.3}  {:>14.4}  {:<22} {}",
                m.triangles,
                m.vertices,
                f64::from(m.triangles) / f64::from(self.published_triangles),
                m.smallest_angle,
                format!("{a:.2} / {b:.2} / {c:.2}"),
                if m.complete { "yes" } else { "NO" },
            )?;
        }
        Ok(())
    }
}
