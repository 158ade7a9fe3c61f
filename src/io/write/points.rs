//! Writes points of space. Floats are exact in all of these formats; weights and markers go where the format has a place for them.

use super::{end, field, float, text};
use crate::model::{Point3, PointSet3, VertexId};
use std::iter::once;

/// A `.node` file of dimension 3, numbered from 1: the weight is the first attribute (column 5 of a row), the marker the last field.
pub fn node3(set: &PointSet3) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * set.points.len());
    let (weights, markers) = (weights(set), &set.point_markers);
    end(field(
        field(field(field(&mut out, set.points.len()), 3), u8::from(weights.is_some())),
        u8::from(!markers.is_empty()),
    ));
    for (i, p) in set.points.iter().enumerate() {
        place(field(&mut out, i + 1), p);
        if let Some(w) = weights {
            float(&mut out, w[i]);
        }
        if let Some(m) = markers.get(i) {
            field(&mut out, m);
        }
        end(&mut out);
    }
    out
}

/// An `.xyz` file, with weights as fourth column. Without points it holds the number 0.
pub fn xyz(set: &PointSet3) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * set.points.len());
    if set.points.is_empty() {
        end(field(&mut out, 0));
    }
    for (i, p) in set.points.iter().enumerate() {
        place(&mut out, p);
        if let Some(w) = weights(set) {
            float(&mut out, w[i]);
        }
        end(&mut out);
    }
    out
}

/// A `.csv` file with commas and the header `x,y,z`, and perhaps `weight` and `marker`.
pub fn csv(set: &PointSet3) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * set.points.len());
    let (weights, markers) = (weights(set), &set.point_markers);
    text(&mut out, "x,y,z");
    text(&mut out, if weights.is_some() { ",weight" } else { "" });
    text(&mut out, if markers.is_empty() { "\n" } else { ",marker\n" });
    for (i, p) in set.points.iter().enumerate() {
        let further = weights.map(|w| w[i]);
        for (k, x) in p.to_array().into_iter().chain(further).enumerate() {
            if k > 0 {
                out.push(b',');
            }
            super::push_float(&mut out, x);
        }
        if let Some(m) = markers.get(i) {
            text(&mut out, &format!(",{m}"));
        }
        end(&mut out);
    }
    out
}

/// A `.npy` file, version 1: doubles of shape (n, 3), or (n, 4) with the weights.
pub fn npy(set: &PointSet3) -> Vec<u8> {
    let weights = weights(set);
    let columns = 3 + usize::from(weights.is_some());
    let mut header =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {columns}), }}", set.points.len());
    // Magic, version, length and header with its line end fill a multiple of 64 bytes.
    let filled = (10 + header.len() + 1).next_multiple_of(64);
    header += &" ".repeat(filled - 11 - header.len());
    let mut out = Vec::with_capacity(filled + 8 * columns * set.points.len());
    out.extend_from_slice(b"\x93NUMPY\x01\x00");
    // 53 bytes and the digits of two numbers.
    out.extend_from_slice(&(header.len() as u16 + 1).to_le_bytes());
    text(&mut out, &header);
    end(&mut out);
    for (i, p) in set.points.iter().enumerate() {
        let further = weights.map(|w| w[i]);
        p.to_array().into_iter().chain(further).for_each(|x| out.extend_from_slice(&x.to_le_bytes()));
    }
    out
}

/// A binary little-endian `.ply` file: doubles `x`, `y`, `z` and perhaps `weight`, and an int `marker`.
pub fn ply(set: &PointSet3) -> Vec<u8> {
    let (weights, markers) = (weights(set), &set.point_markers);
    let mut out = Vec::with_capacity(256 + 36 * set.points.len());
    text(&mut out, "ply\nformat binary_little_endian 1.0\n");
    text(&mut out, &format!("element vertex {}\n", set.points.len()));
    for name in ["x", "y", "z"].into_iter().chain(weights.map(|_| "weight")) {
        text(&mut out, &format!("property double {name}\n"));
    }
    text(&mut out, if markers.is_empty() { "" } else { "property int marker\n" });
    text(&mut out, "end_header\n");
    for (i, p) in set.points.iter().enumerate() {
        let further = weights.map(|w| w[i]);
        p.to_array().into_iter().chain(further).for_each(|x| out.extend_from_slice(&x.to_le_bytes()));
        markers.get(i).into_iter().for_each(|m| out.extend_from_slice(&m.to_le_bytes()));
    }
    out
}

/// An `.off` file of the points, which has no place for weights and markers, and faces.
pub fn off3<'a>(points: &[Point3], faces: impl ExactSizeIterator<Item = &'a [VertexId; 3]>) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * points.len());
    text(&mut out, "OFF\n");
    end(field(field(field(&mut out, points.len()), faces.len()), 0));
    for p in points {
        end(place(&mut out, p));
    }
    for t in faces {
        end(once(&3).chain(t.iter().map(|VertexId(v)| v)).fold(&mut out, |out, v| field(out, v)));
    }
    out
}

/// The weights, if there are any.
fn weights(set: &PointSet3) -> Option<&[f64]> {
    (!set.weights.is_empty()).then_some(&set.weights[..])
}

/// The coordinates of a point.
pub(super) fn place<'a>(out: &'a mut Vec<u8>, p: &Point3) -> &'a mut Vec<u8> {
    float(float(float(out, p.x), p.y), p.z)
}
