//! Tests of readers and writers: tables of what must be read and what must be refused, and round trips.

mod geometry;
mod meshes;
mod picture;
mod points;
mod space;
mod triangle;

use crate::io::ReadError;
use crate::model::{Edge, Mesh2, MeshEdge, Point2, SegmentId, VertexId, VertexKind};
use std::fmt::Debug;
use std::path::PathBuf;

/// Asserts that a reader refuses each of some files with exactly the sentence given.
fn refuses<T: Debug>(read: impl Fn(&[u8]) -> Result<T, ReadError>, cases: &[(&[u8], &str)]) {
    for (bytes, sentence) in cases {
        match read(bytes) {
            Ok(value) => panic!("`{}` was read as {value:?}", bytes.escape_ascii()),
            Err(e) => assert_eq!(&e.to_string(), sentence, "of `{}`", bytes.escape_ascii()),
        }
    }
}

/// Feeds a reader every prefix of a file and the file with each byte changed in some ways: it must return.
fn survives<T>(read: impl Fn(&[u8]) -> Result<T, ReadError>, good: &[u8]) {
    assert!(read(good).is_ok());
    for n in 0..good.len() {
        let _ = read(&good[..n]);
        for byte in [0, b' ', b'9', b'-', b'e', b'\n', b'(', b'<', 0xff] {
            let mut bad = good.to_vec();
            bad[n] = byte;
            let _ = read(&bad);
            bad.insert(n, good[n]);
            let _ = read(&bad);
        }
    }
}

/// The folder of real inputs; says so where it is absent.
fn data() -> Option<PathBuf> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
    let data = std::env::var_os("ORTHOBALL_DATA").map_or_else(|| PathBuf::from(default), PathBuf::from);
    let there = data.join("pslg/as_poly").is_dir();
    if !there {
        println!("skipped: no corpus at {}", data.display());
    }
    there.then_some(data)
}

/// Two regions side by side with all that a mesh may carry.
fn sample() -> Mesh2 {
    let ends = |a, b| -> Edge { [VertexId(a), VertexId(b)] };
    let border = [(0, 1, 5), (0, 3, 5), (1, 2, -7), (1, 4, 0), (2, 5, 5), (3, 4, 5), (4, 5, i32::MAX)];
    Mesh2 {
        points: vec![
            Point2::new(0.0, 0.0),
            Point2::new(1.0, 0.1),
            Point2::new(2.0, 1e-17),
            Point2::new(0.0, 1.0),
            Point2::new(1.0, 1.0 / 3.0),
            Point2::new(2.0, 1e300),
        ],
        kinds: vec![
            VertexKind::Input,
            VertexKind::Segment(SegmentId(0)),
            VertexKind::Input,
            VertexKind::Input,
            VertexKind::Free,
            VertexKind::Input,
        ],
        point_markers: vec![1, 0, -3, 4, 0, 9],
        attributes: (0..12).map(|k| f64::from(k) * 0.1).collect(),
        attributes_per_point: 2,
        triangles: [[0, 1, 3], [1, 2, 4], [1, 4, 3], [2, 5, 4]].map(|t| t.map(VertexId)).to_vec(),
        triangle_attributes: vec![1.0, 2.5, 1.0, -4.0],
        edges: border
            .iter()
            .zip(0..)
            .map(|(&(a, b, marker), i)| MeshEdge { ends: ends(a, b), marker, segment: SegmentId(i) })
            .collect(),
    }
}
