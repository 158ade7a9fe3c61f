//! Pictures: what can be tested without eyes.

use super::sample;
use crate::io::write::svg;
use crate::io::xml::Tags;
use crate::model::{Mesh2, Point2, VertexId, VertexKind};

/// Colours of the sample's smallest angles, 47, 12, 8 and 52 whole degrees.
const COLOURS: [&str; 4] = ["#b5ddca", "#3c4c91", "#3d3982", "#cfe9d3"];

/// Each triangle, subsegment and dot is drawn once, in the colour of its angle or kind.
#[test]
fn everything_is_drawn() {
    let mut mesh = sample();
    mesh.points[5].y = 1.0;
    let picture = String::from_utf8(svg(&mesh)).unwrap();
    let of = |attribute: &str, value: &str| -> Vec<String> {
        let mut tags = Tags::new(&picture);
        let mut found = Vec::new();
        while let Some(tag) = tags.next().unwrap() {
            if tag.get(attribute) == Some(value) {
                found.extend(tag.get("d").map(String::from));
            }
        }
        found
    };
    for colour in COLOURS {
        // The legend's bars have the same colours, but no path.
        assert_eq!(of("fill", colour).iter().map(|d| d.matches('z').count()).collect::<Vec<_>>(), [1], "{colour}");
    }
    let dots = |colour: &str| {
        of("stroke", colour).iter().filter(|d| d.ends_with("h0")).map(|d| d.matches('M').count()).sum::<usize>()
    };
    assert_eq!((dots("#18212b"), dots("#f0a202"), dots("#e4572e"), dots("#fff")), (4, 1, 1, 6));
    let lines: usize = of("stroke-width", "2.2").iter().map(|d| d.matches('M').count()).sum();
    assert_eq!(lines, 7);
    assert!(picture.contains(">4 triangles, 6 vertices, smallest angle "));
}

/// Degenerate meshes and huge ones give a picture with ordinary numbers.
#[test]
fn nothing_is_infinite() {
    let mut huge = sample();
    for p in &mut huge.points {
        *p = Point2::new(p.x.min(3.0) * 1e307 * 1.7 - 1.7e308, if p.y > 0.5 { 1.7e308 } else { -1.7e308 });
    }
    let point = Mesh2 {
        points: vec![Point2::new(1.0, 2.0)],
        kinds: vec![VertexKind::Input],
        point_markers: vec![0],
        ..Mesh2::default()
    };
    let flat = Mesh2 {
        points: vec![Point2::new(1.0, 2.0); 3],
        kinds: vec![VertexKind::Input; 3],
        point_markers: vec![0; 3],
        triangles: vec![[0, 1, 2].map(VertexId)],
        ..Mesh2::default()
    };
    for mesh in [huge, point, flat, Mesh2::default()] {
        let picture = String::from_utf8(svg(&mesh)).unwrap();
        assert!(!picture.contains("NaN") && !picture.contains("inf"));
        assert!(picture.len() < 30_000);
        let mut tags = Tags::new(&picture);
        while let Some(tag) = tags.next().unwrap() {
            for name in ["width", "height", "x", "y", "viewBox"] {
                // A saturated number would have nineteen digits.
                assert!(tag.get(name).is_none_or(|value| value.len() < 16), "{name}");
            }
        }
    }
}
