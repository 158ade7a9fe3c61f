//! Bad input, reader by reader: each fault has its exit code, one sentence that names its place, and leaves no file behind.
//!
//! A table per reader over: empty, truncated, NaN, 1e400, negative counts, counts larger than the file, wrong indices, repeated points,
//! zero-length segments, crossings, segments outside any closed boundary, coordinates of 1e-300 and 1e300. What a reader can express only.
//! A program that panics, exits 0, talks of another line, or leaves half a file fails. (`.poly` in `tests/cli.rs`, too: the list of `doctor`.)

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The fault, the text of the file, and what the sentence has to say.
type Case = (&'static str, String, &'static [&'static str]);

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bad_input").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_orthoball")).args(arguments).current_dir(folder).output().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Runs a command on files and asserts its exit code, that `says` stands in one line, and that the folder is as it was.
#[track_caller]
fn expect(case: &str, files: &[(&str, &[u8])], arguments: &[&str], code: i32, says: &[&str]) {
    let f = folder(&case.replace([' ', '/'], "_"));
    for (name, content) in files {
        fs::write(f.join(name), content).unwrap();
    }
    let before = names(&f);
    let output = run(&f, arguments);
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{case}: {said}");
    assert!(!said.contains("panicked"), "{case}: {said}");
    assert!(said.lines().any(|line| says.iter().all(|s| line.contains(s))), "{case}: no line says {says:?}: {said}");
    assert_eq!(names(&f), before, "{case}: files were left");
}

/// Inputs of `mesh` in one format: refused.
fn refused(extension: &str, cases: &[Case]) {
    for (case, text, says) in cases {
        let name = format!("in.{extension}");
        let says = [&[name.as_str(), "error: "], *says].concat();
        expect(
            &format!("{extension} {case}"),
            &[(&name, text.as_bytes())],
            &["mesh", &name, "-o", "out.vtu", "-o", "out.off", "--trace", "out.obt"],
            2,
            &says,
        );
    }
}

/// Inputs of `mesh` that are repaired or noted: meshed, and the trace verified.
fn meshed(extension: &str, cases: &[Case]) {
    for (case, text, says) in cases {
        let f = folder(&format!("{extension} {case}").replace(' ', "_"));
        let name = format!("in.{extension}");
        fs::write(f.join(&name), text).unwrap();
        let told = run(&f, &["doctor", &name]);
        let told = String::from_utf8_lossy(&told.stdout).into_owned();
        assert!(told.lines().any(|line| says.iter().all(|s| line.contains(s))), "{extension} {case}: {told}");
        let mesh = run(&f, &["mesh", &name, "-o", "out.off", "--trace", "out.obt"]);
        assert_eq!(mesh.status.code(), Some(0), "{extension} {case}");
        let verify = run(&f, &["verify", "out.obt", "--strict"]);
        assert_eq!(verify.status.code(), Some(0), "{extension} {case}");
    }
}

/// Vertices (x y) and segments of a `.poly` file, with the counts given.
fn poly_with(points: &[&str], segments: &[&str], counts: [&str; 2]) -> String {
    let number = |lines: &[&str]| -> String {
        let lines = lines.iter().enumerate();
        lines.map(|(i, line)| format!("{} {line}\n", i + 1)).collect()
    };
    format!("{} 2 0 0\n{}{} 0\n{}0\n", counts[0], number(points), counts[1], number(segments))
}

fn poly(points: &[&str], segments: &[&str]) -> String {
    let [p, s] = [points.len(), segments.len()].map(|n| n.to_string());
    poly_with(points, segments, [&p, &s])
}

const SQUARE: &[&str] = &["0 0", "1 0", "1 1", "0 1"];
const SIDES: &[&str] = &["1 2", "2 3", "3 4", "4 1"];

#[test]
fn poly_files() {
    let whole = poly(SQUARE, SIDES);
    refused(
        "poly",
        &[
            ("empty", String::new(), &[".poly", "ends before"]),
            ("truncated", whole[..30].into(), &["line 5", "vertex 4"]),
            ("NaN", poly(&["0 0", "nan 0", "1 1"], &["1 2"]), &["line 3", "vertex 2", "nan"]),
            ("1e400", poly(&["0 0", "1 0", "1 1e400"], &["1 2"]), &["line 4", "vertex 3", "1e400"]),
            ("negative vertices", poly_with(SQUARE, SIDES, ["-4", "4"]), &["line 1", "-4"]),
            ("negative segments", poly_with(SQUARE, SIDES, ["4", "-4"]), &["line 6", "-4"]),
            (
                "many vertices",
                poly_with(SQUARE, SIDES, ["2000000000", "4"]),
                &["line 1", "2000000000", "only 71 bytes"],
            ),
            ("one vertex more", poly_with(SQUARE, SIDES, ["5", "4"]), &["line 6", "vertex 5", "4"]),
            ("many segments", poly_with(SQUARE, SIDES, ["4", "2000000000"]), &["line 6", "2000000000", "bytes"]),
            ("one segment more", poly_with(SQUARE, SIDES, ["4", "5"]), &["line 11", "segment 5"]),
            ("count past the limit", poly_with(SQUARE, SIDES, ["4000000000", "4"]), &["line 1", "4000000000"]),
            ("index", poly(SQUARE, &["1 2", "2 9"]), &["line 8", "segment 2", "9"]),
            ("negative index", poly(SQUARE, &["1 2", "2 -1"]), &["line 8", "segment 2", "-1"]),
            (
                "repeated point",
                poly(&["0 0", "1 0", "1 1", "0 1", "1 1"], SIDES),
                &["vertices 2 and 4", "(1, 1)", "lines 4, 6"],
            ),
            (
                "crossing",
                poly(SQUARE, &["1 2", "2 3", "3 4", "4 1", "1 3", "2 4"]),
                &["cross", "(0.5, 0.5)", "lines 11, 12"],
            ),
            ("open", poly(SQUARE, &["1 2", "2 3", "3 4"]), &["no region"]),
            ("1e-300", poly(&["0 0", "1e-300 0", "0 1e-300"], &["1 2", "2 3", "3 1"]), &["1e-300", "line 3", "2^-870"]),
            ("1e300", poly(&["0 0", "1e300 0", "0 1e300"], &["1 2", "2 3", "3 1"]), &["1e300", "line 3", "2^870"]),
        ],
    );
    meshed(
        "poly",
        &[
            ("zero length", poly(SQUARE, &["1 2", "2 3", "3 4", "4 1", "2 2"]), &["repair", "line 11"]),
            (
                "outside",
                poly(&["0 0", "1 0", "1 1", "0 1", "3 3", "4 4"], &["1 2", "2 3", "3 4", "4 1", "5 6"]),
                &["note", "line 13"],
            ),
        ],
    );
}

#[test]
fn node_files() {
    let node = |count: &str, lines: &[&str]| -> String {
        let lines = lines.iter().enumerate();
        let body: String = lines.map(|(i, p)| format!("{} {p}\n", i + 1)).collect();
        format!("{count} 2 0 0\n{body}")
    };
    let three = &["0 0", "1 0", "0 1"];
    refused(
        "node",
        &[
            ("empty", String::new(), &[".node", "ends before"]),
            ("NaN at once", node("3", &["nan 0", "1 0", "0 1"]), &["line 2", "vertex 1", "nan"]),
            ("truncated", "3 2 0 0\n1 0 0\n2 1".into(), &["line 3", "vertex 2", "missing"]),
            ("NaN", node("3", &["0 0", "1 nan", "0 1"]), &["line 3", "vertex 2", "nan"]),
            ("1e400", node("3", &["0 0", "1e400 0", "0 1"]), &["line 3", "vertex 2", "1e400"]),
            ("negative count", node("-3", three), &["line 1", "-3"]),
            ("large count", node("1000000", three), &["line 1", "1000000", "only 32 bytes"]),
            ("count too large by one", node("4", three), &["vertex 4", "ends"]),
            ("wrong number", "3 2 0 0\n1 0 0\n7 1 0\n3 0 1\n".into(), &["line 3", "7"]),
            ("repeated point", node("4", &["0 0", "1 0", "0 1", "1 0"]), &["vertices 1 and 3", "lines 3, 5"]),
            ("1e-300", node("3", &["0 0", "1e-300 0", "0 1e-300"]), &["1e-300", "line 3"]),
            ("1e300", node("3", &["0 0", "1e300 0", "0 1e300"]), &["1e300", "line 3"]),
            ("no segments", node("3", three), &["no region", "--convex"]),
        ],
    );
}

#[test]
fn wkt_files() {
    let ring = |positions: &str| format!("POLYGON (({positions}))");
    refused(
        "wkt",
        &[
            ("empty", String::new(), &["line 1", "ends"]),
            ("truncated", "POLYGON ((0 0, 1 0,\n1".into(), &["line 2", "POLYGON", "ends"]),
            ("NaN", ring("0 0, nan 0, 1 1, 0 0"), &["line 1 column 16", "nan"]),
            ("1e400", ring("0 0, 1e400 0, 1 1, 0 0"), &["line 1 column 16", "1e400"]),
            ("open ring", ring("0 0, 1 0, 1 1"), &["column 25", "not closed"]),
            ("crossing", ring("0 0, 1 1, 1 0, 0 1, 0 0"), &["segments 0 and 2", "(0.5, 0.5)"]),
            ("zero length", ring("0 0, 0 0, 0 0, 0 0"), &["no region"]),
            ("no boundary", "LINESTRING (3 3, 4 4)".into(), &["no region"]),
            ("1e-300", ring("0 0, 1e-300 0, 1e-300 1e-300, 0 0"), &["1e-300", "line 1"]),
            ("1e300", ring("0 0, 1e300 0, 1e300 1e300, 0 0"), &["1e300", "line 1"]),
        ],
    );
    meshed(
        "wkt",
        &[
            ("repeated point", ring("0 0, 1 0, 1 0, 1 1, 0 0"), &["repair", "line 1"]),
            (
                "outside",
                "GEOMETRYCOLLECTION (POLYGON ((0 0, 1 0, 1 1, 0 0)),\nLINESTRING (3 3, 4 4))".into(),
                &["note", "line 2"],
            ),
        ],
    );
}

#[test]
fn geojson_files() {
    let ring = |positions: &str| format!("{{\"type\":\"Polygon\",\n\"coordinates\":[[{positions}]]}}");
    refused(
        "geojson",
        &[
            ("empty", String::new(), &["line 1", "ends"]),
            ("truncated", "{\"type\":\"Polygon\",\n\"coordinates\":[[[0,0],[1,0".into(), &["line 2 column 26"]),
            ("NaN", ring("[0,0],[NaN,0],[1,1],[0,0]"), &["line 2"]),
            ("1e400", ring("[0,0],[1e400,0],[1,1],[0,0]"), &["line 2", "1e400"]),
            ("open ring", ring("[0,0],[1,0],[1,1]"), &["line 2", "not closed"]),
            ("crossing", ring("[0,0],[1,1],[1,0],[0,1],[0,0]"), &["segments 0 and 2", "(0.5, 0.5)"]),
            ("zero length", ring("[0,0],[0,0],[0,0],[0,0]"), &["no region"]),
            ("no boundary", "{\"type\":\"LineString\",\"coordinates\":[[0,0],[1,1]]}".into(), &["no region"]),
            ("unknown type", "{\"type\":\"Sphere\"}".into(), &["line 1", "Sphere"]),
            ("1e-300", ring("[0,0],[1e-300,0],[1e-300,1e-300],[0,0]"), &["1e-300", "line 2"]),
            ("1e300", ring("[0,0],[1e300,0],[1e300,1e300],[0,0]"), &["1e300", "line 2"]),
        ],
    );
    meshed("geojson", &[("repeated point", ring("[0,0],[1,0],[1,0],[1,1],[0,0]"), &["repair", "line 2"])]);
}

/// Meshes for `check` in one format: code 2 and a place, or (without a place) code 1, the answer being no.
fn unreadable(extension: &str, cases: &[Case]) {
    for (case, text, says) in cases {
        let name = format!("in.{extension}");
        expect(
            &format!("check {extension} {case}"),
            &[(&name, text.as_bytes())],
            &["check", &name],
            2,
            &[&["orthoball: ", name.as_str()], *says].concat(),
        );
    }
}

fn violated(extension: &str, cases: &[Case]) {
    for (case, text, says) in cases {
        let name = format!("in.{extension}");
        expect(&format!("check {extension} {case}"), &[(&name, text.as_bytes())], &["check", &name], 1, says);
    }
}

/// `text` with one passage changed, which must be there.
fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

#[test]
fn off_meshes() {
    let good = "OFF\n4 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 1 2\n3 0 2 3\n";
    let with = |from: &str, to: &str| changed(good, from, to);
    unreadable(
        "off",
        &[
            ("empty", String::new(), &["ends before"]),
            ("truncated", good[..30].into(), &["line 6", "vertex 3"]),
            ("NaN", with("2 0 0\n", "nan 0 0\n"), &["line 4", "vertex 1", "nan"]),
            ("1e400", with("2 0 0\n", "1e400 0 0\n"), &["line 4", "1e400"]),
            ("negative count", with("4 2 0", "-4 2 0"), &["line 2", "-4"]),
            ("large count", with("4 2 0", "4 1000000 0"), &["line 2", "1000000", "only 56 bytes"]),
            ("one face more", with("4 2 0", "4 3 0"), &["face 2", "ends"]),
            ("index", with("3 0 2 3", "3 0 2 9"), &["line 8", "face 1", "9"]),
            ("quadrangle", with("3 0 2 3", "4 0 1 2 3"), &["line 8", "face 1", "4 corners"]),
            ("not planar", with("2 2 0", "2 2 5"), &["line 5", "z"]),
        ],
    );
    violated(
        "off",
        &[
            ("repeated point", with("0 2 0\n3", "0 0 0\n3"), &["valid", "VIOLATED"]),
            ("zero-length edge", with("3 0 2 3", "3 0 2 2"), &["valid", "VIOLATED"]),
            ("overlap", with("3 0 2 3", "3 0 1 3"), &["valid", "VIOLATED"]),
        ],
    );
    for scale in ["1e-300", "1e300"] {
        // Judged as it is: the audit knows no range.
        let text = format!("OFF\n3 1 0\n0 0 0\n{scale} 0 0\n0 {scale} 0\n3 0 1 2\n");
        expect(
            &format!("check off {scale}"),
            &[("in.off", text.as_bytes())],
            &["check", "in.off"],
            0,
            &["valid", "holds"],
        );
    }
}

#[test]
fn node_and_ele_meshes() {
    let nodes = "4 2 0 0\n1 0 0\n2 2 0\n3 2 2\n4 0 2\n";
    let triangles = "2 3 0\n1 1 2 3\n2 1 3 4\n";
    let cases = [
        ("empty ele", nodes.into(), String::new(), 2, [".ele", "ends before"]),
        ("empty node", String::new(), triangles.into(), 2, [".node", "ends before"]),
        ("truncated", nodes.into(), triangles[..18].into(), 2, [".ele line 3", "triangle 2"]),
        ("NaN", changed(nodes, "2 2 0", "2 nan 0"), triangles.into(), 2, [".node line 3", "vertex 2"]),
        ("1e400", changed(nodes, "2 2 0", "2 1e400 0"), triangles.into(), 2, [".node line 3", "1e400"]),
        ("negative count", nodes.into(), changed(triangles, "2 3", "-2 3"), 2, [".ele line 1", "-2"]),
        ("large count", nodes.into(), changed(triangles, "2 3", "1000000 3"), 2, [".ele line 1", "only 28 bytes"]),
        ("index", nodes.into(), changed(triangles, "1 3 4", "1 3 9"), 2, [".ele line 3", "9"]),
        ("negative index", nodes.into(), changed(triangles, "1 3 4", "1 3 -1"), 2, [".ele line 3", "-1"]),
        ("repeated triangle", nodes.into(), changed(triangles, "1 3 4", "1 2 3"), 1, ["valid", "VIOLATED"]),
        ("repeated point", changed(nodes, "4 0 2", "4 2 0"), triangles.into(), 1, ["valid", "VIOLATED"]),
        (
            "vertex left out",
            changed(nodes, "4 2 0 0", "5 2 0 0") + "5 1.5 0.5\n",
            triangles.into(),
            1,
            ["vertex 4 at (1.5, 0.5) belongs to no triangle", "triangle 0"],
        ),
    ];
    for (case, node, ele, code, says) in cases {
        let files: [(&str, &[u8]); 2] = [("in.node", node.as_bytes()), ("in.ele", ele.as_bytes())];
        expect(&format!("check ele {case}"), &files, &["check", "in.ele"], code, &says);
    }
    let alone: [(&str, &[u8]); 1] = [("in.ele", triangles.as_bytes())];
    expect("check ele alone", &alone, &["check", "in.ele"], 2, &[".node", "missing"]);
}

#[test]
fn vtu_meshes() {
    let good = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n\
        <Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n\
        0 0 0\n7 0 0\n0 7 0\n</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n0 1 2\n</DataArray>\n\
        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n3\n</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n5\n\
        </DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    expect("check vtu good", &[("in.vtu", good.as_bytes())], &["check", "in.vtu"], 0, &["valid", "holds"]);
    let with = |from: &str, to: &str| changed(good, from, to);
    unreadable(
        "vtu",
        &[
            ("empty", String::new(), &["line 1", "VTKFile"]),
            ("truncated", good[..300].into(), &["line", "no well-formed XML"]),
            ("cut in a tag", good[..60].into(), &["line 2", "ends"]),
            ("NaN", with("7 0 0", "nan 0 0"), &["line 8", "Points", "nan"]),
            ("1e400", with("7 0 0", "1e400 0 0"), &["line 8", "Points", "1e400"]),
            ("negative count", with("OfPoints=\"3\"", "OfPoints=\"-3\""), &["line 4", "NumberOfPoints"]),
            ("large count", with("OfPoints=\"3\"", "OfPoints=\"1000000\""), &["line", "Points"]),
            ("many cells", with("OfCells=\"1\"", "OfCells=\"1000000\""), &["line"]),
            ("count past the limit", with("OfCells=\"1\"", "OfCells=\"4000000000\""), &["line 4", "NumberOfCells"]),
            ("index", with("0 1 2\n", "0 1 9\n"), &["line", "9"]),
            ("negative index", with("0 1 2\n", "0 1 -2\n"), &["line", "-2"]),
        ],
    );
    violated("vtu", &[("repeated point", with("7 0 0", "0 0 0"), &["valid", "VIOLATED"])]);
}

#[test]
fn msh_meshes() {
    let old = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 7 0 0\n3 0 7 0\n$EndNodes\n$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";
    let new = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n7 0 0\n0 7 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";
    for (version, good, point, counts, elements) in [
        ("2.2", old, "line 7", ("\n3\n1 0", "\n{}\n1 0"), ("\n1\n1 2", "\n{}\n1 2")),
        ("4.1", new, "line 11", ("1 3 1 3", "1 {} 1 3"), ("1 1 1 1", "1 {} 1 1")),
    ] {
        let case = |name: &str| format!("check msh {version} {name}");
        let check = |name: &str, text: String, code: i32, says: &[&str]| {
            expect(&case(name), &[("in.msh", text.as_bytes())], &["check", "in.msh"], code, says);
        };
        let with = |from: &str, to: &str| changed(good, from, to);
        let count = |(from, to): (&str, &str), n: &str| with(from, &to.replace("{}", n));
        check("good", good.into(), 0, &["valid", "holds"]);
        check("truncated", good[..75].into(), 2, &["in.msh", "line"]);
        check("NaN", with("7 0 0", "nan 0 0"), 2, &[point, "nan"]);
        check("1e400", with("7 0 0", "1e400 0 0"), 2, &[point, "1e400"]);
        check("negative nodes", count(counts, "-3"), 2, &["line 5", "-3"]);
        check("many nodes", count(counts, "1000000"), 2, &["in.msh", "line"]);
        check("negative elements", count(elements, "-1"), 2, &["line", "-1"]);
        check("many elements", count(elements, "1000000"), 2, &["in.msh", "line"]);
        check("index", with("1 2 3\n$EndE", "1 2 9\n$EndE"), 2, &["line", "9"]);
        check("repeated point", with("7 0 0", "0 0 0"), 1, &["valid", "VIOLATED"]);
    }
    expect("check msh empty", &[("in.msh", b"")], &["check", "in.msh"], 2, &["in.msh", "ends before"]);
}

#[test]
fn traces() {
    let f = folder("traces_made");
    fs::write(f.join("s.poly"), poly(SQUARE, SIDES)).unwrap();
    for name in ["s.obt", "s.jsonl"] {
        let made = run(&f, &["mesh", "s.poly", "--max-area", "0.1", "--trace", name]);
        assert_eq!(made.status.code(), Some(0));
    }
    let binary = fs::read(f.join("s.obt")).unwrap();
    let text = fs::read_to_string(f.join("s.jsonl")).unwrap();
    // A trace that is no trace is rejected: the answer is no.
    let rejected = |case: &str, content: &[u8], says: &[&str]| {
        for command in [&["verify", "t"] as &[&str], &["verify", "t", "--strict", "--spacing", "--no-digest"]] {
            let says = [&["rejected"], says].concat();
            expect(&format!("trace {case}"), &[("t", content)], command, 1, &says);
        }
        // Unreadable, or without such an event; a trace that reads well and says what is false is rejected here too.
        let code = if says == ["rule"] { 1 } else { 2 };
        let replay = ["replay", "t", "--to", "100000", "-o", "out.off"];
        expect(&format!("trace {case}"), &[("t", content)], &replay, code, &[": "]);
    };
    rejected("empty", b"", &["header: ", "Truncated"]);
    for part in [1, 10, binary.len() / 2, binary.len() - 1] {
        rejected(&format!("binary of {part} bytes"), &binary[..part], &["Truncated"]);
    }
    rejected("text cut", &text.as_bytes()[..text.len() / 2], &["Truncated", "line"]);
    rejected("other file", b"4 2 0 0\n1 0 0\n", &["header: ", "Format", "line 1"]);
    let with = |from: &str, to: &str| changed(&text, from, to).into_bytes();
    let vertex = "{\"vertex\":[1.0,0.0]";
    rejected("NaN", &with(vertex, "{\"vertex\":[NaN,0.0]"), &["input: ", "Format", "line 3"]);
    rejected("1e400", &with(vertex, "{\"vertex\":[1e400,0.0]"), &["Format", "line 3"]);
    rejected("1e300", &with(vertex, "{\"vertex\":[1e300,0.0]"), &["rule"]);
    rejected("1e-300", &with(vertex, "{\"vertex\":[1e-300,0.0]"), &["rule"]);
    rejected("repeated point", &with(vertex, "{\"vertex\":[0.0,0.0]"), &["rule"]);
    let segment = "{\"segment\":[0,1]";
    rejected("index", &with(segment, "{\"segment\":[0,99]"), &["line 6", "no vertex"]);
    rejected("negative index", &with(segment, "{\"segment\":[0,-1]"), &["Format", "line"]);
    rejected("zero length", &with(segment, "{\"segment\":[1,1]"), &["rule"]);
    rejected("crossing", &with(segment, "{\"segment\":[0,2]"), &["rule"]);
    rejected("more", &[&binary[..], b"x"].concat(), &["end: ", "Format", "more follows"]);
    rejected("start", &with("{\"triangle\":", "{\"triangel\":"), &["start: ", "Format"]);
}

/// What files cannot say and a library user can: every planted defect is found as what it is, with its place, and is refused or repaired.
#[cfg(feature = "generators")]
#[test]
fn planted_defects() {
    use orthoball::arith::FastKernel;
    use orthoball::doctor::examine;
    use orthoball::domain::{Kind, Severity};
    use orthoball::generators::{Defect, SplitMix64, broken};
    use orthoball::model::Lines;
    let expected = |defect| match defect {
        Defect::Crossing => Kind::Crossing,
        Defect::Duplicate => Kind::CoincidentVertices,
        Defect::ZeroLength => Kind::ZeroLength,
        Defect::Overlap => Kind::Overlap,
        Defect::Doubled => Kind::DoubledSegment,
        Defect::OnSegment => Kind::VertexOnSegment,
        Defect::NotANumber | Defect::Infinite => Kind::NotFinite,
        Defect::TooLarge | Defect::TooSmall => Kind::OutOfRange,
        Defect::WrongIndex => Kind::BadIndex,
        Defect::Open | Defect::Empty | Defect::Flat => Kind::NoClosedRegion,
        Defect::HoleOnSegment => Kind::SeedOnSegment,
        Defect::HoleOutside => Kind::SeedOutside,
        Defect::TwoRegions => Kind::SeedsInOneFace,
        Defect::OpenCycle => Kind::OpenCycle,
    };
    let unplaced = [Kind::NoClosedRegion, Kind::BadIndex];
    for defect in Defect::ALL {
        for seed in 0..40 {
            let graph = broken(defect, 3 + seed as usize, &mut SplitMix64(seed));
            let found = examine::<FastKernel>(&graph, &Lines::default());
            let kind = expected(defect);
            let of_kind: Vec<_> = found.findings.iter().filter(|f| f.kind == kind).collect();
            assert!(!of_kind.is_empty(), "{defect:?} {seed}: {:?}", found.findings);
            assert!(unplaced.contains(&kind) || of_kind.iter().all(|f| !f.coordinates.is_empty()), "{of_kind:?}");
            assert_eq!(
                found.has_errors(),
                kind.severity() == Severity::Error,
                "{defect:?} {seed}: {:?}",
                found.findings
            );
        }
    }
}
