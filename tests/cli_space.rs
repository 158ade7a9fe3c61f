//! The commands on points and meshes of space: exit codes, JSON, files; every mutation of a good mesh is refused with its place.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const ATOMS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/atoms.csv");

/// A folder of a test's own, empty.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

#[track_caller]
fn expect(folder: &Path, arguments: &str, expected: i32) -> Output {
    let list = arguments.split_whitespace().map(|a| if a == "ATOMS" { ATOMS } else { a });
    let output = Command::new(env!("CARGO_BIN_EXE_orthoball")).args(list).current_dir(folder).output().unwrap();
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(expected), "{arguments}\n{}{said}", String::from_utf8_lossy(&output.stdout));
    assert!(!said.contains("panicked"), "{said}");
    output
}

#[track_caller]
fn json(folder: &Path, arguments: &str, expected: i32) -> Value {
    serde_json::from_slice(&expect(folder, arguments, expected).stdout).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Random points of few digits, one a line.
fn xyz(count: u32) -> String {
    let mut state = 3u64;
    let mut draw = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 44) as f64 / 1024.0
    };
    (0..count).map(|_| format!("{} {} {}\n", draw(), draw(), draw())).collect()
}

const SPHERES: &str = "valid,orientation,delaunay,canonical,hull";

#[test]
fn the_everyday_run_in_space() {
    let f = folder("space_everyday");
    let done = json(&f, "triangulate ATOMS --radii r -o a.vtu -o a.ele --trace a.obt --json", 0);
    assert_eq!(names(&f), ["a.ele", "a.node", "a.obt", "a.vtu"]);
    let counts = &done["counts"];
    let count = |name: &str| counts[name].as_u64().unwrap();
    assert_eq!(count("points"), count("vertices") + count("hidden") + count("duplicates"));
    assert!(count("hidden") > 0 && count("cells") > count("vertices"));
    assert_eq!((&done["outcome"], &done["dimension"]), (&"complete".into(), &3.into()));
    assert!(done["quality"]["min_dihedral"].as_f64().unwrap() > 0.0);
    assert_eq!(done["files"].as_array().unwrap().len(), 3);
    for key in ["level", "unmet", "digests", "seconds", "findings"] {
        assert!(done.get(key).is_some(), "{key}");
    }
    assert_eq!(json(&f, "verify a.obt --json", 0)["verdict"], "accepted");
    // Every format carries weights, cells and order.
    for mesh in ["a.vtu", "a.ele --weights 5", "a.ele --weights 5 --claims regular,canonical,hull,topology"] {
        let said = json(&f, &format!("check {mesh} --json"), 0);
        assert_eq!((&said["verdict"], &said["cells"]), (&"holds".into(), &counts["cells"]), "{mesh}: {said}");
    }
    // Without the weights it is no Delaunay triangulation.
    expect(&f, "check a.ele", 1);
}

#[test]
fn threads_kernels_and_steps_agree() {
    let f = folder("space_agree");
    fs::write(f.join("p.xyz"), xyz(300)).unwrap();
    let digest = |arguments: &str| {
        let done = json(&f, &format!("triangulate p.xyz --json {arguments}"), 0);
        if arguments.contains("--mirror") {
            assert_eq!(done["mirror"]["verdict"], "identical");
        }
        done["digests"]["mesh"].as_str().unwrap().to_string()
    };
    let first = digest("--threads 1");
    for arguments in
        ["--threads 2", "--steps", "--kernel exact", "--mirror", "--mirror --steps", "--steps --trace s.jsonl"]
    {
        assert_eq!(digest(arguments), first, "{arguments}");
    }
    expect(&f, "verify s.jsonl --strict", 0);
    expect(&f, "convert s.jsonl s.obt", 0);
    expect(&f, "verify s.obt", 0);
}

#[test]
fn lower_dimensions_are_answers() {
    let f = folder("space_flat");
    for (name, points, dimension, cells) in [
        ("plane.xyz", "0 0 1\n1 0 1\n0 1 1\n1 1 1\n", 2, 2),
        ("line.xyz", "0 0 0\n2 2 2\n1 1 1\n", 1, 2),
        ("point.xyz", "5 5 5\n5 5 5\n", 0, 1),
    ] {
        fs::write(f.join(name), points).unwrap();
        let done = json(&f, &format!("triangulate {name} -o {name}.vtu --json"), 0);
        assert_eq!((&done["dimension"], &done["counts"]["cells"]), (&dimension.into(), &cells.into()), "{name}");
        let said = json(&f, &format!("doctor {name} --json"), 0);
        assert!(said["findings"].as_array().unwrap().iter().any(|e| e["kind"] == "flat"), "{said}");
    }
}

#[test]
fn doctor_of_points() {
    let f = folder("space_doctor");
    fs::write(f.join("p.csv"), "x,y,z,w\n0,0,0,0\n4,0,0,0\n0,4,0,0\n0,0,4,0\n1,1,1,-10\n4,0,0,0\n").unwrap();
    let said = json(&f, "doctor p.csv --weights w --json", 0);
    let found: Vec<(&str, u64)> = said["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|e| (e["kind"].as_str().unwrap(), e["line"].as_u64().unwrap_or(0)))
        .collect();
    assert_eq!(found, [("duplicate", 7), ("hidden", 6)]);
    assert_eq!(said["findings"][0]["elements"], serde_json::json!([{"vertex": 5}, {"vertex": 1}]));
    assert_eq!(said["findings"][0]["lines"], serde_json::json!([7, 3]));
    // Errors of syntax and of range, with their lines.
    for (name, text, line) in [("nan.xyz", "0 0 0\n0 nan 0\n", 2), ("huge.xyz", "0 0 0\n1 0 0\n0 1e300 0\n", 3)] {
        fs::write(f.join(name), text).unwrap();
        let said = json(&f, &format!("doctor {name} --json"), 1);
        assert_eq!(said["findings"][0]["severity"], "error");
        let finding = said["findings"][0].to_string();
        assert!(finding.contains(&line.to_string()), "{finding}");
        let refused = json(&f, &format!("triangulate {name} -o x.vtu --trace x.obt --json"), 2);
        assert_eq!(refused["outcome"], "refused");
    }
    assert_eq!(names(&f), ["huge.xyz", "nan.xyz", "p.csv"]);
}

#[test]
fn stops_leave_nothing() {
    let f = folder("space_stops");
    fs::write(f.join("p.xyz"), xyz(20_000)).unwrap();
    for limit in ["--max-steps 100", "--max-seconds 0 --kernel exact"] {
        let said = json(&f, &format!("triangulate p.xyz -o x.vtu --trace x.obt --json {limit}"), 3);
        assert_eq!(said["outcome"], "stopped", "{limit}");
        assert_eq!(names(&f), ["p.xyz"], "{limit}");
    }
}

#[test]
fn wrong_usage_in_space() {
    let f = folder("space_usage");
    fs::write(f.join("p.xyz"), xyz(20)).unwrap();
    fs::write(f.join("q.node"), "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n").unwrap();
    for arguments in [
        "triangulate p.xyz -o p.xyz",
        "triangulate p.xyz -o p.svg",
        "triangulate p.xyz --weights 4 --radii 4",
        "triangulate p.xyz --threads 0",
        "triangulate q.node --weights 4",
        "triangulate q.node --steps",
        "triangulate none.xyz",
        "triangulate p.xyz -o none/x.vtu",
        "convert p.xyz p.vtu",
        "check p.xyz",
    ] {
        expect(&f, arguments, 2);
    }
    assert_eq!(names(&f), ["p.xyz", "q.node"]);
}

/// A triangulation of random points as files of TetGen: the lines of the cells, the first of them a header.
fn good_mesh(f: &Path) -> Vec<String> {
    fs::write(f.join("p.xyz"), xyz(80)).unwrap();
    expect(f, "triangulate p.xyz -o good.ele", 0);
    fs::read_to_string(f.join("good.ele")).unwrap().lines().filter(|l| !l.starts_with('#')).map(Into::into).collect()
}

#[test]
fn mutations_of_a_mesh_are_refused() {
    let f = folder("space_mutations");
    let lines = good_mesh(&f);
    let node = fs::read_to_string(f.join("good.node")).unwrap();
    let check = |name: &str, cells: &[String], expected: i32| {
        let text = format!("{} 4 0\n{}\n", cells.len(), cells.join("\n"));
        fs::write(f.join(format!("{name}.ele")), text).unwrap();
        fs::write(f.join(format!("{name}.node")), &node).unwrap();
        json(&f, &format!("check {name}.ele --claims {SPHERES} --json"), expected)
    };
    let violated = |said: &Value, claim: &str| {
        let claims = said["claims"].as_array().unwrap();
        let c = claims.iter().find(|c| c["claim"] == claim).unwrap();
        assert_eq!(c["verdict"], "violated", "{c}");
        let w = &c["witnesses"][0];
        assert!(!w["message"].as_str().unwrap().is_empty() && !w["lines"].as_array().unwrap().is_empty(), "{w}");
        w.clone()
    };
    let cells = &lines[1..];
    assert_eq!(check("same", cells, 0)["verdict"], "holds");
    let fields = |i: usize| cells[i].split_whitespace().map(String::from).collect::<Vec<_>>();
    let with = |i: usize, fields: &[String]| {
        let mut all = cells.to_vec();
        all[i] = fields.join(" ");
        all
    };
    let mut inverted = fields(7);
    inverted.swap(1, 2);
    assert_eq!(violated(&check("inverted", &with(7, &inverted), 1), "orientation")["cells"], serde_json::json!([7]));
    let mut doubled = cells.to_vec();
    let mut copy = fields(9);
    copy[0] = (cells.len() + usize::from(fields(0)[0] == "1")).to_string();
    doubled.push(copy.join(" "));
    let said = check("doubled", &doubled, 1);
    let w = violated(&said, "valid");
    // What is unchecked says why.
    let open = said["claims"].as_array().unwrap().iter().filter(|c| c["verdict"] == "unchecked");
    assert!(
        open.clone().count() > 0 && open.clone().all(|c| c["message"].as_str().unwrap().contains("complex")),
        "{said}"
    );
    assert_eq!(w["cells"], serde_json::json!([9, cells.len()]));
    let mut missing: Vec<String> = cells.to_vec();
    missing.pop();
    violated(&check("missing", &missing, 1), "hull");
    let mut wrong = fields(5);
    wrong[1] = fields(cells.len() - 1)[4].clone();
    let said = check("wrong", &with(5, &wrong), 1);
    violated(&said, "valid");
}

/// A certificate has no events; its triangulation is the mesh at the end.
#[test]
fn a_certificate_becomes_a_mesh() {
    let f = folder("space_certificate");
    fs::write(f.join("p.xyz"), xyz(60)).unwrap();
    let done = json(&f, "triangulate p.xyz -o m.ele --trace c.obt --json", 0);
    json(&f, "triangulate p.xyz --trace s.obt --steps --json", 0);
    for trace in ["c.obt", "s.obt"] {
        expect(&f, &format!("replay {trace} -o r.ele"), 0);
        for part in ["ele", "node"] {
            let [once, again] = ["m", "r"].map(|name| fs::read(f.join(name).with_extension(part)).unwrap());
            assert_eq!(once, again, "{trace}");
        }
    }
    let said = String::from_utf8(expect(&f, "replay c.obt --to 0 -o n.ele", 2).stderr).unwrap();
    assert!(said.contains("no event; leave --to away"), "{said}");
    let said = String::from_utf8(expect(&f, "convert c.obt c.vtu", 2).stderr).unwrap();
    assert!(said.contains("`replay TRACE -o MESH`"), "{said}");
    // What was verified is told, and only what it was.
    let verified = json(&f, "verify c.obt --json --spacing", 0);
    let told = [&verified["points"], &verified["simplices_at_start"]];
    assert_eq!((told, verified.get("rows")), ([&60.into(), &done["counts"]["cells"]], None));
    let said = String::from_utf8(expect(&f, "verify c.obt", 0).stdout).unwrap();
    assert!(said.starts_with("accepted: 0 events, 60 points, "), "{said}");
}

/// Options that would do nothing are refused, and what a reader left out is told.
#[test]
fn check_ignores_nothing() {
    let f = folder("space_ignores");
    fs::write(f.join("w.xyz"), "0 0 0 1\n2 0 0 1.5\n0 2 0 1\n0 0 2 1\n").unwrap();
    expect(&f, "triangulate w.xyz --weights 4 -o w.ele -o w.vtu", 0);
    let says = |arguments: &str, code: i32, words: &str| {
        let said = String::from_utf8(expect(&f, arguments, code).stderr).unwrap();
        assert!(said.contains(words), "{arguments}: {said}");
    };
    says("check w.ele", 0, "note: column 5, an attribute, is left out (--weights and --radii take a column)");
    says("check w.vtu --radius-edge 2 --claims valid", 2, "add it: --claims ...,quality");
    says("check w.vtu --radius-edge 2 --claims valid,quality", 0, "");
    says("check w.vtu --within 3", 2, "--within is not for meshes of space");
    says("triangulate w.xyz --threads 0", 2, "1..");
    says("check w.meshb", 2, ".meshb is not read here");
    says("convert w.vtu w.stl", 2, "w.stl: its extension names no format");
    // Ten nodes of one tetrahedron of second order.
    let nodes: String = (1..=10).map(|i| format!("{i} {i} {} {}\n", i * i, i * i * i)).collect();
    fs::write(f.join("s.node"), format!("10 3 0 0\n{nodes}")).unwrap();
    fs::write(f.join("s.ele"), "1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n").unwrap();
    says("check s.ele --claims topology", 0, "note: the elements are of second order; 6 nodes");
}

#[test]
fn meshes_and_points_convert() {
    let f = folder("space_convert");
    let cells = good_mesh(&f).len() - 1;
    for name in ["m.vtu", "m.vtk", "m.msh", "m.mesh", "m.node"] {
        expect(&f, &format!("convert good.ele {name}"), 0);
        let said = json(&f, &format!("check {name} --json --claims {SPHERES}"), 0);
        assert_eq!(said["cells"], cells, "{name}");
    }
    for name in ["p.csv", "p.npy", "p.ply", "q.node", "p.off"] {
        expect(&f, &format!("convert p.xyz {name}"), 0);
        let done = json(&f, &format!("triangulate {name} --json"), 0);
        assert_eq!(done["counts"]["cells"], cells, "{name}");
    }
}

/// What could not be tested does not pass: claims that rest on a complex that is none, sizes too far apart, a mesh without tetrahedra.
#[test]
fn unchecked_claims_do_not_pass() {
    let f = folder("space_unchecked");
    let tetrahedra = |points: &str, cells: &str| {
        let (p, c) = (points.lines().count(), cells.lines().count());
        format!("MeshVersionFormatted 2\nDimension 3\nVertices\n{p}\n{points}\nTetrahedra\n{c}\n{cells}\nEnd\n")
    };
    // Two regular tetrahedra of one cube: they overlap, and their spheres are one.
    let cube = "0 0 0 0\n1 1 0 0\n1 0 1 0\n0 1 1 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0";
    fs::write(f.join("overlap.mesh"), tetrahedra(cube, "1 2 4 3 0\n5 6 7 8 0")).unwrap();
    let report = json(&f, "check --claims delaunay --json overlap.mesh", 1);
    assert_eq!((&report["verdict"], &report["claims"][0]["verdict"]), (&"unchecked".into(), &"unchecked".into()));
    assert_eq!(json(&f, "check --json overlap.mesh", 1)["verdict"], "violated");
    let apart = "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 5e-324 1 0";
    fs::write(f.join("apart.mesh"), tetrahedra(apart, "1 2 3 4 0")).unwrap();
    assert_eq!(json(&f, "check --json apart.mesh", 1)["verdict"], "unchecked");
    fs::write(f.join("one.mesh"), tetrahedra("0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0", "1 2 3 4 0")).unwrap();
    assert_eq!(json(&f, "check --json one.mesh", 0)["verdict"], "holds");
    let plane =
        "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles\n1\n1 2 3 0\nEnd\n";
    fs::write(f.join("plane.mesh"), plane).unwrap();
    assert_eq!(json(&f, "check --json plane.mesh", 1)["verdict"], "unchecked");
}

/// A trace that takes a point of the input out again is not of that input.
#[test]
fn an_input_binds_what_happens_to_it() {
    let f = folder("space_bound");
    fs::write(f.join("p.xyz"), "0 0 0\n4 0 0\n0 4 0\n0 0 4\n").unwrap();
    let events = r#"{"format":"orthoball-trace","version":1,"algorithm":"regular","weighted":false,"permuted":false,"scale":0}
{"start":0}
{"vertex":[0.0,0.0,0.0]}
{"i":0,"event":"raise","id":0,"apexes":["+x","+y","+z"]}
{"vertex":[4.0,0.0,0.0]}
{"i":1,"event":"raise","id":1,"apexes":["+y","+z"]}
{"vertex":[0.0,4.0,0.0]}
{"i":2,"event":"raise","id":2,"apexes":["+z"]}
{"vertex":[0.0,0.0,4.0]}
{"i":3,"event":"raise","id":3,"apexes":[]}
{"remove":3}
{"i":4,"event":"lower","id":3,"apexes":["+z"]}
{"event":"end","counts":{"vertices":3,"hidden":0,"duplicates":0,"removed":1,"simplices":1},"mesh":"0000000000000000000000000000000000000000000000000000000000000000","trace":"0000000000000000000000000000000000000000000000000000000000000000"}
"#;
    fs::write(f.join("t.jsonl"), events).unwrap();
    expect(&f, "verify --no-digest --strict t.jsonl", 0);
    let verdict = json(&f, "verify --no-digest --strict --input p.xyz --json t.jsonl", 1);
    assert_eq!((&verdict["verdict"], &verdict["rule"]), (&"rejected".into(), &"Input".into()));
}

/// Points of a plane and of space, with the files that a mesh of either consists of.
const PLANE: &str = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n.5 2 0\n";

#[test]
fn files_of_an_earlier_mesh_do_not_stay() {
    let f = folder("space_stale");
    fs::write(f.join("plane.xyz"), PLANE).unwrap();
    fs::write(f.join("p.xyz"), xyz(30)).unwrap();
    let run = |points: &str, name: &str| json(&f, &format!("triangulate {points} -o {name} --json"), 0);
    let cells = run("p.xyz", "m.ele")["counts"]["cells"].clone();
    let read = |name: &str| json(&f, &format!("check {name} --json --claims topology"), 0)["cells"].clone();
    assert_eq!(read("m.ele"), cells);
    // Of the first mesh only the tetrahedra, of the second only the triangles.
    let done = run("plane.xyz", "m.node");
    assert_eq!(done["files"], serde_json::json!(["m.ele", "m.face", "m.node"]));
    assert_eq!([read("m.ele"), read("m.node")], [0, 0]);
    expect(&f, "convert m.face three.off", 0);
    let off = fs::read_to_string(f.join("three.off")).unwrap();
    assert_eq!(off.lines().nth(1), Some("5 3 0"), "{off}");
    // And back: the triangles are those of the hull, as TetGen writes it.
    run("p.xyz", "m.node");
    expect(&f, "convert m.node hull.off", 0);
    run("p.xyz", "h.off");
    let [hull, same] = ["hull.off", "h.off"].map(|name| fs::read_to_string(f.join(name)).unwrap());
    assert_eq!((read("m.node"), hull), (cells, same));
    // What is named is there, whatever the dimension.
    run("plane.xyz", "t.ele");
    run("p.xyz", "u.face");
    assert!(f.join("t.ele").exists() && f.join("u.face").exists());
    // Points do not go beside a mesh, of which they would be the vertices.
    expect(&f, "convert plane.xyz u.node", 2);
    expect(&f, "convert plane.xyz v.node", 0);
}

#[test]
fn nothing_is_converted_onto_itself() {
    let f = folder("space_itself");
    fs::write(f.join("w.xyz"), "0 0 0 5\n1 0 0 5\n0 1 0 5\n0 0 1 5\n").unwrap();
    fs::write(f.join("g.poly"), "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n").unwrap();
    expect(&f, "triangulate w.xyz --weights 4 -o m.ele -o m.vtu --trace t.obt", 0);
    expect(&f, "mesh g.poly -o plane.vtu -o plane.edge", 0);
    expect(&f, "convert w.xyz v.node --weights 4", 0);
    fs::create_dir(f.join("sub")).unwrap();
    let before: Vec<_> = names(&f).iter().map(|name| fs::read(f.join(name)).ok()).collect();
    for (from, to) in [
        ("w.xyz", "w.xyz"),
        ("w.xyz", "./w.xyz"),
        ("w.xyz", "sub/../w.xyz"),
        ("v.node", "v.node"),
        ("g.poly", "g.poly"),
        ("m.vtu", "m.vtu"),
        ("m.ele", "m.node"),
        ("m.node", "m.ele"),
        ("m.node", "m.face"),
        ("t.obt", "t.obt"),
        ("plane.vtu", "plane.vtu"),
        ("plane.edge", "plane.ele"),
    ] {
        let said = String::from_utf8(expect(&f, &format!("convert {from} {to}"), 2).stderr).unwrap();
        assert!(said.contains("would be written over"), "{from} {to}: {said}");
    }
    assert_eq!(names(&f).iter().map(|name| fs::read(f.join(name)).ok()).collect::<Vec<_>>(), before);
}

#[test]
fn lost_weights_are_told() {
    let f = folder("space_lost");
    fs::write(f.join("w.xyz"), "0 0 0 5\n1 0 0 6\n0 1 0 5\n0 0 1 5\n").unwrap();
    let notes = |arguments: &str| {
        let said = String::from_utf8(expect(&f, arguments, 0).stderr).unwrap();
        said.matches("has no place for weights").count()
    };
    assert_eq!(notes("triangulate w.xyz --weights 4 -o w.mesh -o w.off -o w.vtu"), 2);
    assert_eq!(notes("triangulate w.xyz -o v.mesh -o v.off"), 0);
    assert_eq!(notes("convert w.vtu x.mesh"), 1);
    assert_eq!(notes("convert w.xyz x.off --weights 4"), 1);
    assert_eq!(notes("convert w.vtu x.vtk"), 0);
}

#[test]
fn triangles_of_a_plane_face_one_way() {
    let f = folder("space_facing");
    fs::write(f.join("s.xyz"), PLANE).unwrap();
    for name in ["s.vtu", "s.msh", "s.off"] {
        expect(&f, &format!("triangulate s.xyz -o {name}"), 0);
        expect(&f, &format!("check {name} --claims valid,orientation,delaunay"), 0);
    }
    // A tilted plane, and planes parallel to axes: in space all normals agree.
    for (name, map) in [
        ("tilted", (|x, y| [x, y, x - y]) as fn(f64, f64) -> [f64; 3]),
        ("down", |x, y| [y, x, -3.0]),
        ("upright", |x, y| [x, 2.0 * x, y]),
        ("across", |x, y| [0.0, x, y]),
    ] {
        let points: Vec<[f64; 3]> =
            (0..25).map(|i| map(f64::from(i % 5) * 1.5, f64::from(i / 5 * (1 + i % 3)))).collect();
        let text: String = points.iter().map(|p| format!("{} {} {}\n", p[0], p[1], p[2])).collect();
        fs::write(f.join("p.xyz"), text).unwrap();
        expect(&f, "triangulate p.xyz -o p.off", 0);
        let off = fs::read_to_string(f.join("p.off")).unwrap();
        let normal = |row: &str| {
            let ids: Vec<usize> = row.split(' ').skip(1).map(|id| id.parse().unwrap()).collect();
            let [u, v] = [1, 2].map(|k| [0, 1, 2].map(|j| points[ids[k]][j] - points[ids[0]][j]));
            [2, 1, 0].map(|j| u[(j + 1) % 3] * v[(j + 2) % 3] - u[(j + 2) % 3] * v[(j + 1) % 3])
        };
        let normals: Vec<[f64; 3]> = off.lines().skip(2 + points.len()).map(normal).collect();
        assert!(normals.len() > 8, "{name}: {off}");
        for n in normals {
            // The first coordinate that is not zero, of z, y, x.
            assert!(n.into_iter().find(|&x| x != 0.0).is_some_and(|x| x > 0.0), "{name}: {n:?}");
        }
    }
}

#[test]
fn points_of_a_mesh() {
    let f = folder("space_points_of");
    let weighted = "0 0 0 5\n1 0 0 6\n0 1 0 5\n0 0 1 5\n";
    fs::write(f.join("w.xyz"), weighted).unwrap();
    expect(&f, "triangulate w.xyz --weights 4 -o m.vtu -o m.vtk -o m.msh -o m.mesh -o m.ele", 0);
    for (mesh, options) in
        [("m.vtu", ""), ("m.vtk", ""), ("m.msh", ""), ("m.ele", "--weights 5"), ("m.node", "--radii 5")]
    {
        for points in ["p.xyz", "p.csv", "p.ply", "p.npy"] {
            expect(&f, &format!("convert {mesh} {points} {options}"), 0);
            expect(&f, &format!("convert {points} back.xyz --weights 4"), 0);
            if mesh != "m.node" {
                assert_eq!(fs::read_to_string(f.join("back.xyz")).unwrap(), weighted, "{mesh} {points}");
            }
        }
    }
    expect(&f, "convert m.mesh p.xyz", 0);
    assert_eq!(fs::read_to_string(f.join("p.xyz")).unwrap(), "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    // Points in one plane keep their third coordinate.
    fs::write(f.join("flat.xyz"), "0 0 3\n1 0 3\n0 1 3\n").unwrap();
    expect(&f, "triangulate flat.xyz -o flat.vtu", 0);
    expect(&f, "convert flat.vtu again.xyz", 0);
    assert_eq!(fs::read_to_string(f.join("again.xyz")).unwrap(), "0 0 3\n1 0 3\n0 1 3\n");
    // A mesh is not triangulated; the remedy is told.
    for name in ["m.vtu", "m.msh", "m.mesh", "m.vtk"] {
        for command in ["triangulate", "doctor"] {
            let said = String::from_utf8(expect(&f, &format!("{command} {name}"), 2).stderr).unwrap();
            for word in [".xyz", ".csv", ".npy", ".ply", ".off", ".node", "convert"] {
                assert!(said.contains(word), "{said}");
            }
        }
    }
}

#[test]
fn json_whatever_the_outcome() {
    let f = folder("space_json");
    fs::write(f.join("p.xyz"), xyz(40)).unwrap();
    fs::write(f.join("bad.vtu"), "<VTKFile").unwrap();
    for arguments in [
        "triangulate none.xyz",
        "triangulate bad.vtu",
        "triangulate p.xyz -o p.xyz",
        "mesh none.poly",
        "doctor none.xyz",
        "check none.vtu",
        "check bad.vtu",
        "verify none.obt",
    ] {
        let said = json(&f, &format!("{arguments} --json"), 2);
        let finding = &said["findings"][0];
        assert_eq!((&said["outcome"], &finding["severity"]), (&"refused".into(), &"error".into()), "{arguments}");
        assert!(
            finding["message"].as_str().unwrap().contains("none")
                || arguments.contains("bad")
                || arguments.contains("-o")
        );
    }
    // Numbers of things are whole, and steps are in order.
    let done = json(&f, "triangulate p.xyz -o m.vtu --json", 0);
    let said = json(&f, "check m.vtu --json --claims quality,topology", 0);
    assert_eq!(done["quality"], said["claims"][0]["figures"]);
    let steps = done["quality"]["dihedral_histogram_10_degrees"].as_array().unwrap();
    let angles: u64 = steps.iter().map(|n| n.as_u64().unwrap()).sum();
    assert_eq!((steps.len(), Some(angles)), (18, done["counts"]["cells"].as_u64().map(|n| 6 * n)));
    assert!(said["claims"][1]["figures"].as_object().unwrap().values().all(Value::is_i64), "{said}");
}

#[test]
fn a_closed_stdout_is_no_fault() {
    let f = folder("space_pipe");
    fs::write(f.join("p.xyz"), "1 1 1\n".repeat(20_000)).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_orthoball"))
        .args(["doctor", "p.xyz"])
        .current_dir(&f)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap()), (Some(0), String::new()));
}
