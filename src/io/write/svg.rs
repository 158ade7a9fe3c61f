//! Draws a mesh: triangles coloured by their smallest angle, segments strong, Steiner points by kind, a legend with the distribution of the
//! angles. A viewer: floats are used freely and nothing is decided. Output is the same bytes on every machine.
//!
//! The colours run from deep violet (0 degrees) over blue and teal to a pale green (60 degrees) with lightness rising all the way, so that
//! bad triangles stand out in grey print too; points and segments keep away from these hues.

use super::super::angle::smallest_angle;
use super::text;
use crate::model::words;
use crate::model::{Mesh2, Point2, SegmentId, VertexKind};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::mem::discriminant;

/// Width of the drawing in user units.
const WIDTH: f64 = 1000.0;
/// Space around everything.
const MARGIN: f64 = 28.0;
/// Largest height of the mesh; a taller one is drawn narrower.
const TALLEST: f64 = 1100.0;
/// Height of the legend.
const LEGEND: f64 = 112.0;
/// Colours at 0, 10, ..., 60 degrees, linear in sRGB between.
const RAMP: [[f64; 3]; 7] = [
    [52.0, 20.0, 84.0],
    [62.0, 64.0, 138.0],
    [52.0, 112.0, 164.0],
    [70.0, 158.0, 178.0],
    [134.0, 200.0, 190.0],
    [196.0, 228.0, 206.0],
    [240.0, 247.0, 226.0],
];
const INK: &str = "#18212b";
const FREE: &str = "#e4572e";
const ON_SEGMENT: &str = "#f0a202";
/// The mesh as a picture.
pub fn svg(mesh: &Mesh2) -> Vec<u8> {
    let frame = Frame::of(&mesh.points);
    let angles: Vec<f64> = mesh.triangles.iter().map(|&t| smallest_angle(mesh.corners(t))).collect();
    let mut out = Vec::new();
    let height = 2.0 * MARGIN + frame.height + LEGEND;
    text(
        &mut out,
        &format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" ", Short(WIDTH), Short(height)),
    );
    text(&mut out, &format!("width=\"{}\" height=\"{}\">\n", Short(WIDTH), Short(height)));
    text(&mut out, "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    triangles(&mut out, mesh, &frame, &angles);
    segments(&mut out, mesh, &frame);
    points(&mut out, mesh, &frame);
    legend(&mut out, mesh, &angles, MARGIN + frame.height + 26.0);
    text(&mut out, "</svg>\n");
    out
}

/// How the plane is laid on the page.
struct Frame {
    /// Half of the lower left and upper right corner: halves keep the differences of huge numbers finite.
    low: Point2,
    high: Point2,
    scale: f64,
    left: f64,
    height: f64,
}

impl Frame {
    fn of(points: &[Point2]) -> Frame {
        let low = points.iter().copied().reduce(Point2::min).unwrap_or_default() * 0.5;
        let high = points.iter().copied().reduce(Point2::max).unwrap_or_default() * 0.5;
        let extent = high - low;
        let room = WIDTH - 2.0 * MARGIN;
        let fit = |room: f64, extent: f64| {
            if extent > 0.0 { room / extent } else { f64::INFINITY }
        };
        let scale = fit(room, extent.x).min(fit(TALLEST, extent.y));
        let scale = if scale.is_finite() { scale } else { 0.0 };
        Frame { low, high, scale, left: (WIDTH - scale * extent.x) / 2.0, height: scale * extent.y }
    }

    fn place(&self, p: Point2) -> Point2 {
        let half = p * 0.5;
        Point2::new(self.left + (half.x - self.low.x) * self.scale, MARGIN + (self.high.y - half.y) * self.scale)
    }
}

/// A number with at most two decimals.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let hundredths = (self.0 * 100.0).round() as i64;
        let (sign, h) = (if hundredths < 0 { "-" } else { "" }, hundredths.unsigned_abs());
        match h % 100 {
            0 => write!(f, "{sign}{}", h / 100),
            r if r % 10 == 0 => write!(f, "{sign}{}.{}", h / 100, r / 10),
            r => write!(f, "{sign}{}.{r:02}", h / 100),
        }
    }
}

/// The bin of an angle: whole degrees, 0 to 59.
fn bin(angle: f64) -> usize {
    (angle as usize).min(59)
}

/// The colour of a bin.
fn colour(bin: usize) -> String {
    let at = (bin as f64 + 0.5) / 10.0;
    let (from, share) = (at as usize, at - at.floor());
    let [r, g, b] = [0, 1, 2].map(|k| (RAMP[from][k] * (1.0 - share) + RAMP[from + 1][k] * share).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Widths of strokes; each element gets the widest one that suits its size, so that a graded mesh stays legible throughout.
const STROKES: [f64; 6] = [0.08, 0.2, 0.4, 0.8, 1.4, 2.2];

/// The index of the widest stroke up to a width.
fn stroke(width: f64) -> usize {
    STROKES.iter().rposition(|&s| s <= width).unwrap_or(0)
}

fn triangles(out: &mut Vec<u8>, mesh: &Mesh2, frame: &Frame, angles: &[f64]) {
    let mut paths: BTreeMap<(usize, usize), String> = BTreeMap::new();
    for (&t, &angle) in mesh.triangles.iter().zip(angles) {
        let [a, b, c] = mesh.corners(t).map(|p| frame.place(p));
        let shortest = a.distance(b).min(b.distance(c)).min(c.distance(a));
        let path = paths.entry((stroke((0.03 * shortest).min(0.8)), bin(angle))).or_default();
        let corners = [a.x, a.y, b.x, b.y, c.x, c.y].map(|x| Short(x).to_string());
        // Writing to a string cannot fail.
        write!(path, "M{}z", corners.join(" ")).expect("a string takes all text");
    }
    text(out, &format!("<g stroke=\"{INK}\" stroke-opacity=\".5\" stroke-linejoin=\"round\">\n"));
    for ((width, bin), path) in paths {
        text(
            out,
            &format!("<path fill=\"{}\" stroke-width=\"{}\" d=\"{path}\"/>\n", colour(bin), Short(STROKES[width])),
        );
    }
    text(out, "</g>\n");
}

fn segments(out: &mut Vec<u8>, mesh: &Mesh2, frame: &Frame) {
    let mut paths: BTreeMap<usize, String> = BTreeMap::new();
    for e in &mesh.edges {
        let [a, b] = e.ends.map(|v| frame.place(mesh.points[v.index()]));
        let path = paths.entry(stroke((0.2 * a.distance(b)).max(0.8))).or_default();
        // Writing to a string cannot fail.
        write!(path, "M{} {} {} {}", Short(a.x), Short(a.y), Short(b.x), Short(b.y)).expect("a string takes all text");
    }
    text(out, &format!("<g fill=\"none\" stroke=\"{INK}\" stroke-linecap=\"round\">\n"));
    for (width, path) in paths {
        text(out, &format!("<path stroke-width=\"{}\" d=\"{path}\"/>\n", Short(STROKES[width])));
    }
    text(out, "</g>\n");
}

/// Dots as lines of length zero with round ends, which keeps the file small; each on a white one. Where the mesh is fine they shrink
/// in steps, and vanish where they would hide it.
fn points(out: &mut Vec<u8>, mesh: &Mesh2, frame: &Frame) {
    /// Radii are whole multiples of this, up to the largest.
    const STEP: f64 = 0.4;
    const LARGEST: f64 = 3.2;
    let nearest = shortest_edges(mesh, frame);
    let kinds = [
        (FREE, 0.85, VertexKind::Free),
        (ON_SEGMENT, 0.95, VertexKind::Segment(SegmentId(0))),
        (INK, 1.1, VertexKind::Input),
    ];
    for (fill, size, of_kind) in kinds {
        let of_kind = discriminant(&of_kind);
        let mut paths: BTreeMap<u8, String> = BTreeMap::new();
        for (i, &p) in mesh.points.iter().enumerate().filter(|&(i, _)| discriminant(&mesh.kinds[i]) == of_kind) {
            // At most 8.
            let steps = (LARGEST.min(0.17 * nearest[i]) / STEP) as u8;
            let at = frame.place(p);
            // Writing to a string cannot fail.
            write!(paths.entry(steps).or_default(), "M{} {}h0", Short(at.x), Short(at.y))
                .expect("a string takes all text");
        }
        for (steps, path) in paths.iter().filter(|(steps, _)| **steps > 0) {
            let radius = STEP * f64::from(*steps) * size;
            for (stroke, diameter) in [("#fff", 2.6 * radius), (fill, 2.0 * radius)] {
                let diameter = Short(diameter);
                text(
                    out,
                    &format!(
                        "<path fill=\"none\" stroke=\"{stroke}\" stroke-width=\"{diameter}\" stroke-linecap=\"round\" d=\"{path}\"/>\n"
                    ),
                );
            }
        }
    }
}

/// Length of the shortest drawn edge at each vertex; infinite where there is none.
fn shortest_edges(mesh: &Mesh2, frame: &Frame) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; mesh.points.len()];
    for &[a, b, c] in &mesh.triangles {
        for (u, v) in [(a, b), (b, c), (c, a)] {
            let [p, q] = [u, v].map(|v| frame.place(mesh.points[v.index()]));
            for v in [u, v] {
                shortest[v.index()] = shortest[v.index()].min(p.distance(q));
            }
        }
    }
    shortest
}

fn legend(out: &mut Vec<u8>, mesh: &Mesh2, angles: &[f64], top: f64) {
    text(
        out,
        &format!(
            "<g font-family=\"Inter,Helvetica,Arial,sans-serif\" font-size=\"13\" fill=\"{INK}\" transform=\"translate({} {})\">\n",
            Short(MARGIN),
            Short(top)
        ),
    );
    histogram(out, angles);
    let smallest = angles.iter().copied().fold(60.0, f64::min);
    text(out, "<g transform=\"translate(490 16)\">\n");
    text(
        out,
        &format!(
            "<text font-size=\"15\" font-weight=\"600\">{}, {}",
            grouped(mesh.triangles.len(), "triangle"),
            grouped(mesh.points.len(), "vertex")
        ),
    );
    if !angles.is_empty() {
        text(out, &format!(", smallest angle {}°", Short((smallest * 10.0).floor() / 10.0)));
    }
    text(out, "</text>\n");
    let count = |of: fn(VertexKind) -> bool| mesh.kinds.iter().filter(|k| of(**k)).count();
    let keys = [
        (INK, "input vertex", count(|k| k == VertexKind::Input)),
        (ON_SEGMENT, "segment Steiner point", count(|k| matches!(k, VertexKind::Segment(_)))),
        (FREE, "free Steiner point", count(|k| k == VertexKind::Free)),
    ];
    for (k, (fill, name, count)) in keys.into_iter().enumerate() {
        let y = 26 + 20 * k;
        text(
            out,
            &format!(
                "<circle cx=\"5\" cy=\"{}\" r=\"4\" fill=\"{fill}\"/><text x=\"18\" y=\"{y}\">{}</text>\n",
                y - 4,
                grouped(count, name)
            ),
        );
    }
    text(out, &format!("<path stroke=\"{INK}\" stroke-width=\"2.4\" stroke-linecap=\"round\" d=\"M262 22h18\"/>"));
    text(out, &format!("<text x=\"290\" y=\"26\">{}</text>\n</g>\n</g>\n", grouped(mesh.edges.len(), "subsegment")));
}

/// Bars over the colour scale: how many triangles have which smallest angle.
fn histogram(out: &mut Vec<u8>, angles: &[f64]) {
    /// Width of one degree, height of the tallest bar, and where the bars stand.
    const DEGREE: f64 = 7.0;
    const BAR: f64 = 46.0;
    let mut counts = [0usize; 60];
    for &angle in angles {
        counts[bin(angle)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    for (k, &count) in counts.iter().enumerate() {
        let (x, fill) = (Short(DEGREE * k as f64), colour(k));
        if count > 0 {
            // A single triangle among a million must still be seen.
            let h = (BAR * count as f64 / most).max(1.0);
            let (y, h, w) = (Short(BAR - h), Short(h), Short(DEGREE - 1.0));
            text(
                out,
                &format!(
                    "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"{fill}\" stroke=\"{INK}\" stroke-opacity=\".35\" stroke-width=\".5\"/>"
                ),
            );
        }
        text(
            out,
            &format!("<rect x=\"{x}\" y=\"50\" width=\"{}\" height=\"10\" fill=\"{fill}\"/>\n", Short(DEGREE + 0.6)),
        );
    }
    text(out, "<g font-size=\"11\" text-anchor=\"middle\" fill-opacity=\".8\">");
    for degrees in (0..=60).step_by(10) {
        let x = Short(DEGREE * f64::from(degrees));
        text(
            out,
            &format!(
                "<path stroke=\"{INK}\" stroke-width=\".8\" d=\"M{x} 60v4\"/><text x=\"{x}\" y=\"76\">{degrees}°</text>"
            ),
        );
    }
    text(out, &format!("<text x=\"{}\" y=\"92\">smallest angle of a triangle</text></g>\n", Short(30.0 * DEGREE)));
}

/// A count of something, with thin spaces between the thousands.
fn grouped(n: usize, noun: &str) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{2009}');
        }
        out.push(c);
    }
    out + " " + &words::of(&n, noun)
}
