//! Points of space.

use super::{data, refuses, survives};
use crate::io::*;
use crate::model::{Point3, PointSet3};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

const FORMATS: [Format; 6] = [Format::Node, Format::Xyz, Format::Csv, Format::Npy, Format::Ply, Format::Off];

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
            (b"1 2 3 -1", ".xyz line 1: point 0: the radius is -1.0, which is negative"),
            (b"1 2 3 1e155", ".xyz line 1: point 0: the radius is 1e155, the square of which is out of range"),
            (
                b"1 2 3 1\n1 2 3\n",
                ".xyz line 2: point 1: it has 3 columns, but the first point has 4; give every point the same columns",
            ),
            (
                b"2\n1.0 2.0 3.0 4.0\n",
                ".xyz line 2: point 1: the file ends before it; the file is truncated or declares too many elements",
            ),
            (
                b"1\n1 2 3 4\n1 2 3 4\n",
                ".xyz line 3: end of file: `1 2 3 4` after the last point; remove it, or correct the count that the file declares",
            ),
            (
                b"C 1 2 x\n",
                ".xyz line 1 column 1: point 0: x: `C` is not a number; write a decimal number such as -1.5e3",
            ),
        ],
    );
}

/// Files of chemistry: a count, a comment, a symbol ahead of the coordinates. What only looks like one is refused.
#[test]
fn molecules() {
    for (text, told) in [
        (
            "2\nwater, -76.4 hartree\nO 0 0 1 -.5\nH 1 2 3 .25\n",
            vec!["a line of comment is left out", "columns 1, 5 are left out"],
        ),
        ("2\n\nO 0 0 1 -.5\nH 1 2 3 .25\n", vec!["columns 1, 5 are left out"]),
        ("O 0 0 1 -.5\nH 1 2 3 .25\n", vec!["columns 1, 5 are left out"]),
        ("2\nx y z q\n0 0 1\n1 2 3\n", vec!["a line of comment is left out"]),
    ] {
        let read = parse_xyz(text.as_bytes(), None).unwrap();
        assert_eq!((points(&read), notes(&read)), (vec![[0., 0., 1.], [1., 2., 3.]], told), "{text}");
        survives(|b| parse_xyz(b, None), text.as_bytes());
    }
    let read = parse_xyz(b"2\n\nO 0 0 1 -.5\nH 1 2 3 .25\n", Some(&weight("5"))).unwrap();
    assert_eq!((&read.set.weights[..], notes(&read)), (&[-0.5, 0.25][..], vec!["column 1 is left out"]));
    let fault = |text: &str| parse_xyz(text.as_bytes(), None).unwrap_err().to_string();
    for (text, sentence) in [
        (
            "1\ncarbon\n6 0 0 1\n",
            "after a line of comment it has numbers only, of which the first may stand for an element or be x",
        ),
        ("2\nnan 0 0\n1 0 0\n", "x: `nan` is not a finite number"),
        ("nan 0 0 1\n", "x: `nan` is not a finite number"),
        ("2\nC 0 0 0\nH 1 0 0\nH 0 1 0\n", "`H 0 1 0` after the last point"),
        ("1,0,0\n", "name the file .csv"),
    ] {
        assert!(fault(text).contains(sentence), "{text}: {}", fault(text));
    }
}

/// Line ends of old Macintoshes.
#[test]
fn carriage_returns() {
    for format in FORMATS.into_iter().filter(|&f| !matches!(f, Format::Npy | Format::Ply)) {
        let set =
            PointSet3 { points: vec![Point3::new(0.0, 1.0, 2.0), Point3::new(3.0, 4.0, 5.0)], ..PointSet3::default() };
        let text = String::from_utf8(write_points3(&set, format).unwrap()).unwrap();
        for end in ["\r", "\r\n"] {
            let read = read_points3(format, text.replace('\n', end).as_bytes(), None).unwrap().unwrap();
            assert_eq!((read.set.points, read.notes.len()), (set.points.clone(), 0), "{format:?} {end:?}");
        }
    }
}

#[test]
fn columns() {
    let csv = b"id,x,y,z,w,r\n1,0,0,0,-5,2\n2,1,1,1,7,0.1\n3,2,2,2,8,3e-162\n";
    let read = parse_csv(csv, Some(&weight("w"))).unwrap();
    assert_eq!((&read.set.weights[..], notes(&read)), (&[-5., 7., 8.][..], vec!["columns id, r are left out"]));
    let read = parse_csv(csv, Some(&radius("6"))).unwrap();
    assert_eq!(read.set.weights, [4.0, 0.1 * 0.1, 3e-162 * 3e-162]);
    let note = &read.notes[1];
    assert_eq!(
        (note.line, &*note.text),
        (3, "2 radii have squares that are no doubles; their weights are the nearest ones")
    );
    refuses(
        |b| parse_csv(b, Some(&weight("v"))),
        &[
            (csv, ".csv line 1: columns: no column is named `v`; the columns are id, x, y, z, w, r"),
            (
                b"v,x,y,z,v\n",
                ".csv line 1: columns: two columns are named `v`; give the number of the column, counted from 1",
            ),
            (
                b"1,2,3\n",
                ".csv line 1: columns: column `v` is to hold weights, but columns have no names here; give the number of the column, counted from 1",
            ),
        ],
    );
    let e = parse_csv(csv, Some(&weight("3"))).unwrap_err();
    assert_eq!(e.problem, "column 3 is to hold weights, but it holds a coordinate or a number");
    let e = parse_off3(b"OFF 0 0 0\n", Some(&weight("4"))).unwrap_err();
    assert_eq!(
        e.to_string(),
        ".off line 1: columns: column 4 is to hold weights, but there are 3; columns are counted from 1, those of the coordinates included"
    );
}

/// Squares of radii of 26 bits are doubles, of the next odd number of 27 bits not.
#[test]
fn exact_squares() {
    let exact = |r: f64| {
        let text = format!("0 0 0 {r:?}\n");
        let read = parse_xyz(text.as_bytes(), Some(&radius("4"))).unwrap();
        assert_eq!(read.set.weights, [r * r]);
        read.notes.is_empty()
    };
    assert!(
        exact(0.0)
            && exact(67_108_863.0)
            && exact(94_906_265.0)
            && exact(0.375)
            && exact(2f64.sqrt().to_bits() as u32 as f64 * 0.0)
    );
    assert!(
        !exact(94_906_267.0)
            && !exact(0.1)
            && !exact(1.0 + f64::EPSILON)
            && !exact(1e-170)
            && !exact(f64::MIN_POSITIVE)
    );
    // 2^-537 squared is the smallest double.
    assert!(exact(f64::from_bits(1 << 52) * f64::from_bits((1023 + 485) << 52)));
    assert!(!exact(f64::from_bits(1 << 52) * f64::from_bits((1023 + 484) << 52)));
}

#[test]
fn csv() {
    let due = vec![[1., 2., 3.], [4., -5., 6.]];
    for text in [
        "1,2,3\n4,-5,6",
        "\u{feff}1;2;3\r\n4;-5;6\r\n",
        "1\t2\t3\n4\t-5\t6\n",
        "# made by hand\n x , y , z \n 1, 2 ,3\n\n# more\n4,-5, 6\n",
        "\"x\",\"y\",\"z\"\n\"1\",2,\"3\"\n4 , \"-5\" ,6",
        "z;n;Y;\"a;\"\"b\";X\n3;0;2;;1\n6;0;-5;;4\n",
        "Points:0,Points:1,Points:2\n1,2,3\n4,-5,6",
    ] {
        assert_eq!(points(&parse_csv(text.as_bytes(), None).unwrap()), due, "{text}");
    }
    let read = parse_csv(b"z;n;Y;\"a;\"\"b\";X\n3;0;2;;1\n", None).unwrap();
    assert_eq!((notes(&read), &read.set.lines[..]), (vec!["columns n, a;\"b are left out"], &[2][..]));
    assert_eq!(points(&parse_csv(b"x,y,z\n", None).unwrap()), [[0.; 3]; 0]);
    survives(|b| parse_csv(b, None), b"a,\"x\",y,z\n1,2,\"3\",4\n");
    refuses(
        |b| parse_csv(b, None),
        &[
            (b"", ".csv: point 0: the file ends before it; the file is empty or holds comments only"),
            (
                b"1 2 3\n",
                ".csv line 1: point 0: it has no comma, semicolon or tab; separate columns by one of them; with spaces between it is an .xyz file",
            ),
            (
                b"1,2\n",
                ".csv line 1: point 0: it has 2 columns, which is not enough for x, y, z; put the numbers of a point on one line, with commas between",
            ),
            (
                b"x,y,w\n1,2,3\n",
                ".csv line 1: point 0: the header names no column z; name the columns of the coordinates x, y, z, or give no header",
            ),
            (b"x,y,z,X\n", ".csv line 1: point 0: the header names two columns x; name one of them otherwise"),
            (
                b"x,y,z\n1,2,3\n1,2\n",
                ".csv line 3: point 1: it has 2 columns instead of 3; give every line the same columns",
            ),
            (
                b"1;2,5;3\n",
                ".csv line 1 column 3: point 0: y: `2,5` is not a number; write a decimal number such as -1.5e3, with a point",
            ),
            (
                b"nan,0,0\n",
                ".csv line 1 column 1: point 0: x: `nan` is not a finite number; write a decimal number such as -1.5e3, with a point",
            ),
            (
                b"0,0,1e400\n",
                ".csv line 1 column 5: point 0: z: `1e400` is not a finite number; write a decimal number such as -1.5e3, with a point",
            ),
            (
                b"0,0,\n",
                ".csv line 1 column 5: point 0: z: `` is not a number; write a decimal number such as -1.5e3, with a point",
            ),
            (b"1,2,\"3\n", ".csv line 1 column 5: point 0: a quote is not closed on its line; close it"),
            (b"1,2,\"3\"4\n", ".csv line 1 column 8: point 0: `4` after a quoted field; put a separator between"),
        ],
    );
}

/// A `.npy` file of version 1.
fn npy(header: &str, numbers: &[u8]) -> Vec<u8> {
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), numbers].concat()
}

#[test]
fn npy_layouts() {
    let head = |descr: &str, fortran: &str, shape: &str| {
        format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}          \n")
    };
    let due = vec![[1., -2., 3.], [4., 5., 6.]];
    let [c, f] = [[1i8, -2, 3, 4, 5, 6], [1, 4, -2, 5, 3, 6]];
    let bytes =
        |numbers: [i8; 6], wide: &dyn Fn(i8) -> Vec<u8>| -> Vec<u8> { numbers.into_iter().flat_map(wide).collect() };
    for (order, numbers) in [("False", c), ("True", f)] {
        let float = |x: i8| f64::from(x);
        let cases: [(&str, Vec<u8>); 6] = [
            ("<f8", bytes(numbers, &|x| float(x).to_le_bytes().to_vec())),
            (">f8", bytes(numbers, &|x| float(x).to_be_bytes().to_vec())),
            ("|i1", bytes(numbers, &|x| x.to_le_bytes().to_vec())),
            (">i2", bytes(numbers, &|x| i16::from(x).to_be_bytes().to_vec())),
            ("<i4", bytes(numbers, &|x| i32::from(x).to_le_bytes().to_vec())),
            (">i8", bytes(numbers, &|x| i64::from(x).to_be_bytes().to_vec())),
        ];
        for (descr, data) in cases {
            let file = npy(&head(descr, order, "(2, 3)"), &data);
            let read = parse_npy(&file, None).unwrap_or_else(|e| panic!("{descr} {order}: {e}"));
            assert_eq!(points(&read), due, "{descr} {order}");
            assert_eq!(read.set.lines, [1, 2]);
            survives(|b| parse_npy(b, None), &file);
        }
    }
    let single = npy(&head("<f4", "False", "(1, 3)"), &[0, 0, 0x80, 0x3f, 0, 0, 0, 0x80, 0, 0, 0, 0x3f]);
    assert_eq!(points(&parse_npy(&single, None).unwrap()), [[1., 0., 0.5]]);
    // Version 2 has four bytes for the length of the header.
    let mut wide = npy(&head("|u1", "False", "(1, 4)"), &[1, 2, 3, 4]);
    wide[6] = 2;
    wide.splice(10..10, [0, 0]);
    let read = parse_npy(&wide, Some(&radius("4"))).unwrap();
    assert_eq!((points(&read), &read.set.weights[..]), (vec![[1., 2., 3.]], &[16.][..]));
    assert_eq!(notes(&parse_npy(&wide, None).unwrap()), ["column 4 is left out"]);
    let eight = |shape: &str| npy(&head("<f8", "False", shape), &[0; 24]);
    let nan = npy(&head("<f8", "False", "(1, 3)"), &[[0u8; 16].as_slice(), &f64::NAN.to_le_bytes()].concat());
    refuses(
        |b| parse_npy(b, None),
        &[
            (b"", ".npy: the file is empty; write it by numpy.save; .npz archives are not read"),
            (
                b"PK\x03\x04",
                ".npy: the file does not start with \\x93NUMPY; write it by numpy.save; .npz archives are not read",
            ),
            (&single[..40], ".npy: the file ends within its header; the file is truncated"),
            (
                &single[..single.len() - 1],
                ".npy: the shape is (1, 3), which takes 12 bytes, but 11 follow; the file is truncated or damaged",
            ),
            (
                &eight("(1000000000, 3)"),
                ".npy: the shape is (1000000000, 3), which takes 24000000000 bytes, but 24 follow; the file is truncated or damaged",
            ),
            (&eight("(99999999999999, 3)"), ".npy: the shape is (99999999999999, 3); the limit is 2147483647"),
            (
                &eight("(3, 1)"),
                ".npy: the shape is (3, 1); points are rows: save an array of shape (n, 3), or (n, 4) with weights",
            ),
            (
                &eight("(3,)"),
                ".npy: the shape is (3,); points are rows: save an array of shape (n, 3), or (n, 4) with weights",
            ),
            (
                &eight("(-1, 3)"),
                ".npy: the shape is (-1, 3); points are rows: save an array of shape (n, 3), or (n, 4) with weights",
            ),
            (
                &npy(&head("<c16", "False", "(1, 3)"), &[]),
                ".npy: the numbers are of type '<c16'; save doubles (float64), singles (float32) or integers",
            ),
            (&nan, ".npy: row 1: z is NaN, which is not a finite number (byte 96); remove the row or correct it"),
        ],
    );
}

/// Integers that no double holds are counted; those beyond 2^53 that are doubles are not.
#[test]
fn npy_integers() {
    let header = |kind: &str| format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': (2, 3), }}");
    let rounded = |kind: &str, numbers: [u64; 6]| {
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        notes(&parse_npy(&npy(&header(kind), &bytes), None).unwrap()).join("")
    };
    let two = 1u64 << 53;
    assert_eq!(rounded("<i8", [0, 1, two, two + 2, (-(two as i64)) as u64, 1 << 63]), "");
    assert_eq!(rounded("<u8", [0, 1, two, two + 2, 1 << 63, 3 << 62]), "");
    let note = |n: &str| format!("of {n} beyond 2^53 that no double holds, the nearest doubles are taken");
    assert_eq!(rounded("<i8", [0, two + 1, 5, (-(two as i64) - 1) as u64, i64::MAX as u64, 0]), note("3 integers"));
    assert_eq!(rounded("<u8", [0, 0, 0, 0, 0, u64::MAX]), note("1 integer"));
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment c\nelement extra 2\nproperty list uchar int a\nproperty float b\nelement vertex 2\n\
    property list uint8 float skipped\nproperty double x\nproperty float y\nproperty float z\nproperty uchar radius\nelement face 1\n\
    property list uchar int vertex_indices\nend_header\n2 7 8 1.5\n0 1\n1 9 1 2 3 4\n0 5 6 7 8\n3 0 1 0\n";

#[test]
fn ply() {
    let read = parse_ply(PLY.as_bytes(), Some(&radius("radius"))).unwrap();
    assert_eq!((points(&read), &read.set.weights[..]), (vec![[1., 2., 3.], [5., 6., 7.]], &[16., 64.][..]));
    assert_eq!(read.set.lines, [18, 19]);
    assert_eq!(
        notes(&read),
        ["column skipped is left out", "elements other than vertices are left out: 2 extra, 1 face"]
    );
    survives(|b| parse_ply(b, Some(&radius("radius"))), PLY.as_bytes());
    let head = PLY.split_inclusive("end_header\n").next().unwrap();
    for (format, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut file = head.replace("ascii", format).into_bytes();
        let int = |x: i32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
        // 1.5, 1, 9, and the coordinates 2, 3, 6, 7 in single precision.
        let single = |bits: u32| if big { bits.to_be_bytes() } else { bits.to_le_bytes() };
        let double = |x: f64| if big { x.to_be_bytes() } else { x.to_le_bytes() };
        let put = |file: &mut Vec<u8>, parts: &[&[u8]]| parts.iter().for_each(|p| file.extend_from_slice(p));
        put(&mut file, &[&[2], &int(7), &int(8), &single(0x3fc0_0000), &[0], &single(0x3f80_0000)]);
        put(&mut file, &[&[1], &single(0x4110_0000), &double(1.0), &single(0x4000_0000), &single(0x4040_0000), &[4]]);
        put(&mut file, &[&[0], &double(5.0), &single(0x40c0_0000), &single(0x40e0_0000), &[8]]);
        put(&mut file, &[&[3], &int(0), &int(1), &int(0)]);
        let binary = parse_ply(&file, Some(&radius("radius"))).unwrap();
        assert_eq!((&binary.set.points, &binary.set.weights), (&read.set.points, &read.set.weights), "{format}");
        assert_eq!(binary.set.lines, [1, 2]);
        survives(|b| parse_ply(b, None), &file);
        let end = file.len();
        let e = parse_ply(&file[..end - 1], None).unwrap_err().to_string();
        assert_eq!(e, format!(".ply: face 0: the file ends within it (byte {}); the file is truncated", end - 13));
        let e = parse_ply(&[&file[..], b"x"].concat(), None).unwrap_err().to_string();
        assert_eq!(e, ".ply: 1 bytes follow the last element; correct the counts of the header");
    }
    let with = |from: &str, to: &str| PLY.replacen(from, to, 1).into_bytes();
    refuses(
        |b| parse_ply(b, None),
        &[
            (b"", ".ply line 1: the file does not start with `ply`; the file is truncated or no .ply"),
            (&PLY.as_bytes()[..50], ".ply line 1: the file ends within its header; the file is truncated or no .ply"),
            (
                &with("vertex 2", "vertex -2"),
                ".ply line 7 column 16: header: the number of elements is -2; it must be from 0 to 2147483647",
            ),
            (
                &with("vertex 2", "vertex 2000000"),
                ".ply line 7: element vertex: there are to be 2000000, but only 44 bytes follow the header; correct the count, or the file is truncated",
            ),
            (&with("vertex 2", "vertex 4"), ".ply line 20: vertex 2: x is missing; add it to the line"),
            (
                &with("double x", "double u"),
                ".ply line 7: element vertex: it has no property x; points of space have x, y and z",
            ),
            (
                &with("5 6 7", "5 nan 7"),
                ".ply line 19 column 5: vertex 1: y: `nan` is not a finite number; write a decimal number such as -1.5e3",
            ),
            (&with("float b", "half b"), ".ply line 6: header: `half` is no type of numbers"),
            (&with("element vertex", "element vortex"), ".ply line 15: the header has no element vertex"),
        ],
    );
}

/// A byte order mark, and coordinates in capitals; where both are there, the small letters are meant.
#[test]
fn ply_habits() {
    let text = "\u{feff}ply\nformat ascii 1.0\nelement vertex 1\nproperty float X\nproperty float Y\nproperty float Z\nend_header\n1 2 3\n";
    assert_eq!(points(&parse_ply(text.as_bytes(), None).unwrap()), [[1., 2., 3.]]);
    let both = text.replace("float Z\n", "float Z\nproperty float x\n").replace("1 2 3", "1 2 3 4");
    assert_eq!(points(&parse_ply(both.as_bytes(), None).unwrap()), [[4., 2., 3.]]);
}

#[test]
fn node_and_off() {
    let node = "# c\n2 3 2 1\n0 1 2 3 0.5 2 7\n1 4 5 6 0.25 3 -8\n";
    let read = parse_node3(node.as_bytes(), None).unwrap();
    assert_eq!((points(&read), &read.set.point_markers[..]), (vec![[1., 2., 3.], [4., 5., 6.]], &[7, -8][..]));
    assert_eq!(notes(&read), ["columns 5, 6, attributes, are left out (--weights and --radii take a column)"]);
    let read = parse_node3(node.as_bytes(), Some(&radius("6"))).unwrap();
    assert_eq!((&read.set.weights[..], notes(&read)), (&[4., 9.][..], vec!["column 5, an attribute, is left out"]));
    survives(|b| parse_node3(b, Some(&weight("5"))), node.as_bytes());
    refuses(
        |b| parse_node3(b, Some(&weight("5"))),
        &[
            (
                b"1 2 0 0\n",
                ".node line 1: header of the vertices: the dimension is 2; only files of space (dimension 3) are read here",
            ),
            (b"1      \n", ".node line 1: header of the vertices: the dimension is missing; add it to the line"),
            (
                b"0 3 0 0\n",
                ".node line 1: columns: column 5 is to hold weights, but there are 4; columns are counted from 1, those of the coordinates included",
            ),
        ],
    );
    let off = b"OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 2\n3 0 1 2 255 0 0\n4 0 1 2 3\n";
    let read = parse_off3(off, None).unwrap();
    assert_eq!((points(&read)[3], notes(&read)), ([0., 0., 2.], vec!["2 faces are left out"]));
    survives(|b| parse_off3(b, None), off);
    let coloured = b"CNOFF\n1 0 0\n1 2 3 0 0 1 255 255 0 255\n";
    let read = parse_off3(coloured, None).unwrap();
    assert_eq!((points(&read), notes(&read)), (vec![[1., 2., 3.]], vec!["columns 4 to 10 are left out"]));
    let e = parse_off3(b"OFF\n1 0 0\n1 2 3 0 0 1\n", None).unwrap_err().to_string();
    assert_eq!(
        e,
        ".off line 3 column 7: vertex 0: `0` is one field too many; remove it, or correct what the header declares"
    );
    let e = parse_off3(b"4OFF\n1 0 0\n1 2 3 4\n", None).unwrap_err().to_string();
    assert_eq!(
        e,
        ".off line 1: header: the file starts with `4OFF`; it must start with the word OFF, or COFF, NOFF, CNOFF, STOFF"
    );
    let e = parse_off3(&off[..off.len() - 2], None).unwrap_err().to_string();
    assert_eq!(e, ".off line 8: face 1: a corner is missing; add it to the line");
}

fn coordinate() -> impl Strategy<Value = f64> {
    // Every finite number but -0, which readers turn into 0.
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()).prop_map(|x| x + 0.0)
}

prop_compose! {
    fn set()(n in 0usize..20)(
        points in prop::collection::vec([coordinate(), coordinate(), coordinate()], n),
        weights in prop_oneof![Just(Vec::new()), prop::collection::vec(coordinate(), n)],
        point_markers in prop_oneof![Just(Vec::new()), prop::collection::vec(any::<i32>(), n)],
    ) -> PointSet3 {
        PointSet3 { points: points.into_iter().map(Point3::from_array).collect(), weights, point_markers, lines: Vec::new() }
    }
}

proptest! {
    #[test]
    fn any_points_survive(set in set()) {
        for format in FORMATS {
            let number = if format == Format::Node { "5" } else { "4" };
            let column = (!set.weights.is_empty() && format != Format::Off).then(|| weight(number));
            let bytes = write_points3(&set, format).unwrap();
            let again = read_points3(format, &bytes, column.as_ref()).unwrap();
            let again = again.unwrap_or_else(|e| panic!("{format:?}: {e}")).set;
            prop_assert_eq!(&again.points, &set.points, "{:?}", format);
            if format != Format::Off {
                prop_assert_eq!(&again.weights, &set.weights, "{:?}", format);
            }
            if format == Format::Node {
                prop_assert_eq!(&again.point_markers, &set.point_markers);
            }
        }
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut all: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    all.sort();
    all.into_iter().flat_map(|p| if p.is_dir() { files(&p) } else { vec![p] }).collect()
}

/// Files of the data set that contradict themselves.
const BROKEN: [(&str, &str); 1] = [(
    "cgal/prim.off",
    ".off line 24: end of file: `3  8 9 10` after the last face; remove it, or correct the count that the file declares",
)];

/// Every file of points or of vertices in the open data set is read, with the number of points that a plain count of its rows gives.
#[test]
fn real_points() {
    let Some(data) = data() else { return };
    let mut seen = std::collections::BTreeMap::<Format, (usize, usize)>::new();
    for path in ["points", "surface", "plc"].iter().flat_map(|folder| files(&data.join(folder))) {
        let Some(format) = Format::of(&path).filter(|f| f.reads_points3()) else { continue };
        let bytes = std::fs::read(&path).unwrap();
        if point_dimension(format, &bytes) != Some(3) {
            continue;
        }
        let read = read_points3(format, &bytes, None).unwrap();
        if let Some((_, due)) = BROKEN.iter().find(|(name, _)| path.ends_with(name)) {
            assert_eq!(&read.unwrap_err().to_string(), due);
            continue;
        }
        let read = read.unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let n = read.set.points.len();
        if format == Format::Xyz {
            let text = String::from_utf8(bytes).unwrap();
            let rows = text.lines().filter(|l| l.split_ascii_whitespace().count() >= 3).count();
            assert_eq!(n, rows, "{}", path.display());
        }
        assert!(n > 3, "{}", path.display());
        let count = seen.entry(format).or_default();
        *count = (count.0 + 1, count.1 + n);
        // As weights of the plane, which some files are: a column too many is told, and another format gives the same points.
        for other in FORMATS {
            let again = read_points3(other, &write_points3(&read.set, other).unwrap(), None).unwrap().unwrap();
            assert_eq!(again.set.points, read.set.points, "{} as {other:?}", path.display());
        }
    }
    println!("{seen:?}");
    for (format, least) in [(Format::Xyz, 9), (Format::Off, 80), (Format::Ply, 6), (Format::Node, 3)] {
        assert!(seen.get(&format).is_some_and(|&(files, _)| files >= least), "{format:?}: {seen:?}");
    }
    // Weighted points of the plane: a comma between, the first line a count. As .csv they are points of space with z for weight.
    let mut weighted = 0;
    for path in files(&data.join("points/weighted")) {
        let text = std::fs::read_to_string(&path).unwrap();
        let n: usize = text.split(',').next().unwrap().parse().unwrap();
        let rows: String = text.lines().skip(1).take(n - 1).map(|l| format!("{l}\n")).collect();
        assert_eq!(parse_csv(rows.as_bytes(), None).unwrap().set.points.len(), n - 1, "{}", path.display());
        weighted += 1;
    }
    assert!(weighted >= 50);
}

/// The meshes of Medit in the data set, with the counts of their own headers.
#[test]
fn real_medit() {
    let Some(data) = data() else { return };
    for (name, due) in [
        ("cube_adja", [152, 60, 300, 373]),
        ("cube_two_materials", [12, 0, 20, 12]),
        ("multi-mat", [3664, 400, 7094, 0]),
        ("torus", [4351, 94, 2954, 20067]),
    ] {
        let bytes = std::fs::read(data.join(format!("surface/mmg/{name}.mesh"))).unwrap();
        let mesh = parse_medit(&bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!([mesh.points.len(), mesh.edges.len(), mesh.triangles.len(), mesh.tetrahedra.len()], due, "{name}");
    }
}
