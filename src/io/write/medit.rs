//! Writes Medit's `.mesh`, ASCII, of double precision. Markers and regions are references; the format has no weights.

use super::points::place;
use super::{end, field, text};
use crate::io::ForeignMesh3;
use crate::model::VertexId;
use std::collections::BTreeMap;

/// The mesh as a `.mesh` file. References are whole numbers of 32 bits: where a region attribute is none, all regions are numbered from 1 in ascending order.
pub fn medit(mesh: &ForeignMesh3) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * mesh.points.len() + 40 * mesh.tetrahedra.len());
    text(&mut out, "MeshVersionFormatted 2\nDimension 3\n");
    head(&mut out, "Vertices", mesh.points.len());
    for (i, p) in mesh.points.iter().enumerate() {
        end(field(place(&mut out, p), mesh.point_markers.get(i).unwrap_or(&0)));
    }
    let rows = mesh.edges.iter().map(|e| (&e.ends[..], e.marker));
    section(&mut out, "Edges", rows);
    let rows = mesh.triangles.iter().map(|t| (&t.corners[..], t.marker));
    section(&mut out, "Triangles", rows);
    let references = references(&mesh.tetrahedron_attributes);
    let reference = |i: usize| references.get(i).copied().unwrap_or(0);
    let rows = mesh.tetrahedra.iter().enumerate().map(|(i, t)| (&t[..], reference(i)));
    section(&mut out, "Tetrahedra", rows);
    text(&mut out, "End\n");
    out
}

fn head(out: &mut Vec<u8>, keyword: &str, count: usize) {
    text(out, keyword);
    end(out);
    end(field(out, count));
}

fn section<'a>(out: &mut Vec<u8>, keyword: &str, rows: impl ExactSizeIterator<Item = (&'a [VertexId], i32)>) {
    if rows.len() == 0 {
        return;
    }
    head(out, keyword, rows.len());
    for (corners, reference) in rows {
        for VertexId(v) in corners {
            field(out, v + 1);
        }
        end(field(out, reference));
    }
}

fn references(attributes: &[f64]) -> Vec<i32> {
    // The cast saturates; what is no whole number of 32 bits does not survive it.
    let whole = |&x: &f64| Some(x as i32).filter(|&n| f64::from(n).to_bits() == x.to_bits());
    let all: Option<Vec<i32>> = attributes.iter().map(whole).collect();
    all.unwrap_or_else(|| {
        let mut sorted = attributes.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup_by_key(|x| x.to_bits());
        let numbers: BTreeMap<u64, i32> = sorted.iter().map(|x| x.to_bits()).zip(1..).collect();
        attributes.iter().map(|x| numbers[&x.to_bits()]).collect()
    })
}
