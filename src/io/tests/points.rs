//! Points of space.

use super::{refuses, survives};
use crate::io::*;

fn points(input: &Input3) -> Vec<[f64; 3]> {
    input.set.points.iter().map(|p| p.to_array()).collect()
}

fn notes(input: &Input3) -> Vec<&str> {
    input.notes.iter().map(|n| &*n.text).collect()
}

fn weight(name: &str) -> Column {
    Column::Weight(name.into())
}

fn radius(name: &str) -> Column {
    Column::Radius(name.into())
}

#[test]
fn xyz() {
    let read = parse_xyz(b"# a comment\n1 2 3\n\n -4 5e0 -0 # more\n", None).unwrap();
    assert_eq!(points(&read), [[1., 2., 3.], [-4., 5., 0.]]);
    assert_eq!(read.set.points[1].z.to_bits(), 0);
    assert_eq!((&read.set.lines[..], read.set.weights.len(), notes(&read).len()), (&[2, 4][..], 0, 0));
    let normals = b"2\n1 2 3 0 0 1\n4 5 6 7 8 9\n";
    let read = parse_xyz(normals, None).unwrap();
    assert_eq!((points(&read), notes(&read)), (vec![[1., 2., 3.], [4., 5., 6.]], vec!["columns 4 to 6 are left out"]));
    let read = parse_xyz(normals, Some(&weight("6"))).unwrap();
    assert_eq!((&read.set.weights[..], notes(&read)), (&[1., 9.][..], vec!["columns 4 to 5 are left out"]));
    assert_eq!(points(&parse_xyz(b"0\n", None).unwrap()), [[0.; 3]; 0]);
    survives(|b| parse_xyz(b, Some(&weight("6"))), normals);
    refuses(
        |b| parse_xyz(b, Some(&radius("4"))),
        &[
            (b"", ".xyz: point 0: the file ends before it; the file is truncated or declares too many elements"),
            (
                b"1 2 3",
                ".xyz line 1: columns: column 4 is to hold radii, but there are 3; columns are counted from 1, those of the coordinates included",
            ),
        ],
    );
}
