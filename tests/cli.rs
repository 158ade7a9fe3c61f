//! The program as its users meet it: exit codes, what stands on stdout, which files are there afterwards.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const LAKE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/lake.poly");

/// A folder of a test's own, empty.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn run_in(folder: &Path, arguments: &str) -> Output {
    let arguments = arguments.split_whitespace().map(|a| if a == "LAKE" { LAKE } else { a });
    Command::new(env!("CARGO_BIN_EXE_orthoball")).args(arguments).current_dir(folder).output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[track_caller]
fn expect(folder: &Path, arguments: &str, expected: i32) -> Output {
    let output = run_in(folder, arguments);
    let said = text(&output.stderr);
    assert_eq!(code(&output), expected, "{arguments}\n{}{said}", text(&output.stdout));
    assert!(!said.contains("panicked"), "{said}");
    output
}

#[track_caller]
fn json(folder: &Path, arguments: &str, expected: i32) -> Value {
    let output = expect(folder, arguments, expected);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", text(&output.stdout)))
}

/// The names in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn the_everyday_run() {
    let f = folder("everyday");
    let out = expect(&f, "mesh LAKE -o lake.vtu -o lake.svg -o lake.ele --trace lake.obt", 0);
    assert!(out.stdout.is_empty(), "stdout is for data");
    assert_eq!(names(&f), ["lake.ele", "lake.node", "lake.obt", "lake.svg", "lake.vtu"]);
    assert_eq!(
        text(&expect(&f, "verify lake.obt --strict", 0).stdout).lines().next().unwrap().split(':').next(),
        Some("accepted")
    );
    expect(&f, "verify lake.obt --input LAKE --spacing", 0);
    expect(&f, "check lake.vtu --input LAKE", 0);
    expect(&f, "check lake.ele --input LAKE", 0);
}

#[test]
fn json_of_mesh() {
    let f = folder("json_of_mesh");
    let v = json(&f, "mesh LAKE --json --trace t.jsonl", 0);
    assert_eq!(v["outcome"], "holey");
    assert_eq!(v["level"], "outside");
    let unmet = v["unmet"].as_array().unwrap();
    assert_eq!(v["counts"]["unmet"], unmet.len());
    assert!(unmet.iter().all(|u| u["reason"] == "input-angle" && u["place"].as_array().unwrap().len() == 2));
    assert!(v["quality"]["min_angle_unexcused"].as_f64().unwrap() >= 25.0);
    let histogram = v["quality"]["min_angle_histogram_5_degrees"].as_array().unwrap();
    let sum: u64 = histogram.iter().map(|n| n.as_u64().unwrap()).sum();
    assert_eq!(v["counts"]["triangles"], sum);
    assert!(v["seconds"].as_f64().unwrap() > 0.0);
    let last = fs::read_to_string(f.join("t.jsonl")).unwrap();
    let end: Value = serde_json::from_str(last.lines().last().unwrap()).unwrap();
    assert_eq!(end["mesh"], v["digests"]["mesh"]);
    assert_eq!(end["trace"], v["digests"]["trace"]);
    assert_eq!(end["counts"]["triangles"], v["counts"]["triangles"]);
}

#[test]
fn kernels_mirror_each_other() {
    let f = folder("mirror");
    let v = json(&f, "mesh LAKE --json --mirror --min-angle 20", 0);
    assert_eq!(v["mirror"]["verdict"], "identical");
    // Header, 108 vertices, ...: as many records as the trace has.
    assert!(v["mirror"]["records"].as_u64().unwrap() > 300);
    let v = json(&f, "mesh LAKE --json --mirror --max-steps 40 --trace t.jsonl", 3);
    assert_eq!(v["mirror"]["verdict"], "identical", "stopped runs compare too");
    expect(&f, "mesh LAKE --kernel exact --trace exact.obt", 0);
    expect(&f, "mesh LAKE --kernel fast --trace fast.obt", 0);
    assert_eq!(fs::read(f.join("exact.obt")).unwrap(), fs::read(f.join("fast.obt")).unwrap());
}

#[test]
fn promises_are_kept_or_refused() {
    let f = folder("promises");
    fs::write(f.join("square.poly"), "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
        .unwrap();
    for promise in ["graded", "admissible"] {
        let v = json(&f, &format!("mesh square.poly --max-area 0.01 --promise {promise} --json --trace t.obt"), 0);
        // A least d2 of the graded level is graded whatever was asked for.
        assert_ne!(v["level"], "outside", "{promise}");
        expect(&f, "verify t.obt --strict --spacing", 0);
    }
    expect(&f, "mesh square.poly --promise graded --min-angle 28", 2);
    expect(&f, "mesh square.poly --min-angle 60", 2);
    expect(&f, "mesh square.poly --min-angle nan", 2);
    expect(&f, "mesh square.poly --d1 0", 2);
    expect(&f, "mesh square.poly --max-area -1", 2);
}

#[test]
fn a_stopped_run_is_whole() {
    let f = folder("stopped");
    let v = json(&f, "mesh LAKE --max-steps 30 --json -o l.vtu --trace l.obt", 3);
    assert_eq!(v["outcome"], "stopped");
    assert!(v["stop_reason"].as_str().unwrap().contains("30"));
    expect(&f, "verify l.obt", 0);
    expect(&f, "check l.vtu", 0);
    let v = json(&f, "mesh LAKE --max-seconds 0 --json --mirror", 3);
    assert_eq!((&v["outcome"], &v["mirror"]["verdict"]), (&"stopped".into(), &"identical".into()));
}

#[cfg(unix)]
#[test]
fn an_interrupt_stops_a_run_with_its_files() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;
    let f = folder("interrupt");
    let mut child = Command::new(env!("CARGO_BIN_EXE_orthoball"))
        .args(["mesh", LAKE, "--kernel", "exact", "--max-area", "1e-4", "-o", "l.vtu", "--trace", "l.obt"])
        .current_dir(&f)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut talk = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    // The promise is told when the run has begun.
    while !line.starts_with("promise") {
        line.clear();
        assert!(talk.read_line(&mut line).unwrap() > 0, "the run did not begin");
    }
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    std::io::copy(&mut talk, &mut std::io::sink()).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(3));
    assert_eq!(names(&f), ["l.obt", "l.vtu"]);
    expect(&f, "verify l.obt", 0);
    expect(&f, "check l.vtu", 0);
}

#[test]
fn a_seed_outside_is_refused_with_the_list_of_doctor() {
    let f = folder("seeds");
    let square = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n";
    fs::write(f.join("s.poly"), format!("{square}2\n1 7 7\n2 0.5 0\n0\n")).unwrap();
    let mesh = json(&f, "mesh s.poly --json -o s.vtu", 2);
    let doctor = json(&f, "doctor s.poly --json", 1);
    assert_eq!(mesh["findings"], doctor["findings"]);
    let kinds: Vec<&str> = mesh["findings"].as_array().unwrap().iter().map(|f| f["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["seed-on-segment", "seed-outside"]);
    assert_eq!(names(&f), ["s.poly"]);
}

#[test]
fn refused_inputs_leave_no_file() {
    let square = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n";
    let sides = "1 1 2\n2 2 3\n3 3 4\n4 4 1\n";
    let cases = [
        ("empty", String::new()),
        ("truncated", format!("{square}4 0\n1 1 2\n")),
        ("nan", "3 2 0 0\n1 nan 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n".into()),
        ("huge", "3 2 0 0\n1 1e400 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n".into()),
        ("negative", "-3 2 0 0\n".into()),
        ("count", "4000000000 2 0 0\n1 0 0\n".into()),
        ("index", format!("{square}1 0\n1 1 9\n0\n")),
        ("repeated", format!("5 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n5 1 1\n4 0\n{sides}0\n")),
        ("crossing", format!("{square}6 0\n{sides}5 1 3\n6 2 4\n0\n")),
        ("open", format!("{square}2 0\n1 1 2\n2 2 3\n0\n")),
        ("garbage", "\u{0}\u{1}%PDF".into()),
    ];
    for (name, content) in cases {
        let f = folder(&format!("refused_{name}"));
        fs::write(f.join("in.poly"), content).unwrap();
        let out = expect(&f, "mesh in.poly -o out.vtu -o out.ele --trace out.obt", 2);
        assert!(text(&out.stderr).contains("in.poly"), "{name}: {}", text(&out.stderr));
        assert_eq!(names(&f), ["in.poly"], "{name}");
        let v = json(&f, "doctor in.poly --json", 1);
        assert!(v["errors"].as_u64().unwrap() > 0, "{name}");
        assert!(v["findings"][0]["message"].is_string() && v["findings"][0]["severity"] == "error", "{name}");
    }
}

#[test]
fn refusals_are_located() {
    let f = folder("located");
    let content = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n# sides\n6 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 1 3\n6 2 4\n0\n";
    fs::write(f.join("x.poly"), content).unwrap();
    let v = json(&f, "mesh x.poly --json", 2);
    assert_eq!(v["outcome"], "refused");
    let crossing = &v["findings"][0];
    assert_eq!(crossing["kind"], "crossing");
    assert_eq!(crossing["coordinates"][0], serde_json::json!([0.5, 0.5]));
    assert_eq!(crossing["lines"], serde_json::json!([12, 13]));
    let v = json(&f, "doctor LAKE --json", 0);
    assert_eq!((&v["errors"], &v["verdict"]), (&0.into(), &"sound".into()));
}

#[test]
fn wrong_usage() {
    let f = folder("usage");
    for arguments in [
        "",
        "mesh",
        "mesh missing.poly",
        "mesh LAKE --choice nonsense",
        "mesh LAKE --choice center --choice-a random",
        "mesh LAKE -o lake.txt",
        "mesh LAKE --trace lake.vtu",
        "mesh LAKE --max-seconds nan",
        "mesh LAKE -o no/such/folder/lake.vtu",
        "triangulate LAKE --weights",
        "verify missing.obt",
        "verify LAKE --claims",
        "check LAKE",
        "reproduce gcdr-table-9",
        "convert LAKE lake.obt",
        "view LAKE -o page.html",
    ] {
        let out = expect(&f, arguments, 2);
        assert!(!out.stderr.is_empty(), "{arguments}: no sentence");
    }
    assert!(names(&f).is_empty());
    expect(&f, "--help", 0);
    expect(&f, "--version", 0);
}

#[test]
fn the_input_is_spared() {
    let f = folder("spared");
    fs::copy(LAKE, f.join("lake.poly")).unwrap();
    let out = expect(&f, "mesh lake.poly -o ./lake.poly", 2);
    assert!(text(&out.stderr).contains("belongs to the input"));
    assert_eq!(fs::read(f.join("lake.poly")).unwrap(), fs::read(LAKE).unwrap());
    // Its vertices are its own, so that .node and .ele of the same name are free, again and again.
    expect(&f, "mesh lake.poly -o lake.ele", 0);
    expect(&f, "mesh lake.poly -o lake.ele", 0);
    assert_eq!(names(&f), ["lake.ele", "lake.node", "lake.poly"]);
    // A graph whose vertices stand in the .node file needs them.
    expect(&f, "mesh lake.poly -o part.poly", 0);
    expect(&f, "mesh part.poly -o part.ele", 2);
}

/// Errors quote files. A quoted escape sequence once reached the terminal.
#[test]
fn what_a_terminal_obeys_is_escaped() {
    let f = folder("escapes");
    expect(&f, "mesh LAKE --trace a.jsonl", 0);
    let whole = fs::read_to_string(f.join("a.jsonl")).unwrap();
    for (c, escaped) in [("\u{7f}", "\\u007f"), ("\u{9b}31m", "\\u009b31m")] {
        fs::write(f.join("b.jsonl"), whole.replacen("\"seeds\"", &format!("\"see{c}ds\""), 1)).unwrap();
        let out = expect(&f, "diff a.jsonl b.jsonl", 2);
        assert!(text(&out.stderr).contains(&format!("`see{escaped}ds`")), "{}", text(&out.stderr));
        let v = json(&f, "verify b.jsonl --json", 1);
        assert!(v["found"].as_str().unwrap().contains(&format!("see{c}ds")), "{v}");
        assert!(!text(&expect(&f, "verify b.jsonl --json", 1).stdout).contains(c));
    }
}

#[test]
fn both_forms_of_a_trace() {
    let f = folder("forms");
    expect(&f, "mesh LAKE --trace a.obt", 0);
    expect(&f, "mesh LAKE --trace b.jsonl", 0);
    expect(&f, "convert a.obt a.jsonl", 0);
    expect(&f, "convert b.jsonl b.obt", 0);
    assert_eq!(fs::read(f.join("a.jsonl")).unwrap(), fs::read(f.join("b.jsonl")).unwrap());
    assert_eq!(fs::read(f.join("a.obt")).unwrap(), fs::read(f.join("b.obt")).unwrap());
    expect(&f, "verify a.jsonl --strict", 0);
    assert_eq!(json(&f, "diff a.obt b.jsonl --json", 0)["verdict"], "equal");
    expect(&f, "mesh LAKE --min-angle 24 --trace c.obt", 0);
    let v = json(&f, "diff a.obt c.obt --json", 1);
    assert_eq!((&v["record"], &v["field"]), (&0.into(), &"parameters.kappa".into()));
    assert!(v["meaning"].as_str().unwrap().contains("asked for different things"));
}

#[test]
fn tampering_is_seen() {
    let f = folder("tampering");
    expect(&f, "mesh LAKE --trace a.jsonl", 0);
    let whole = fs::read_to_string(f.join("a.jsonl")).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    let first = lines.iter().position(|l| l.starts_with("{\"i\":0,")).unwrap();
    let write = |lines: &[&str]| {
        fs::write(f.join("t.jsonl"), lines.iter().map(|l| format!("{l}\n")).collect::<String>()).unwrap()
    };
    // The end is missing.
    write(&lines[..lines.len() - 1]);
    let v = json(&f, "verify t.jsonl --json", 1);
    assert_eq!((&v["verdict"], &v["rule"]), (&"rejected".into(), &"Truncated".into()));
    expect(&f, "convert t.jsonl t.obt", 2);
    assert!(!f.join("t.obt").exists());
    // A marker, which nothing but the digest binds.
    let marker = lines[1].replace("\"marker\":1", "\"marker\":2");
    let mut changed = lines.clone();
    changed[1] = &marker;
    write(&changed);
    assert_eq!(json(&f, "verify t.jsonl --json", 1)["rule"], "Digest");
    expect(&f, "verify t.jsonl --no-digest", 0);
    assert_eq!(json(&f, "verify t.jsonl --no-digest --input LAKE --json", 1)["rule"], "Input");
    expect(&f, "convert t.jsonl t.obt", 2);
    // An event dropped: its number is missed.
    let mut dropped = lines.clone();
    dropped.remove(first);
    write(&dropped);
    assert_eq!(json(&f, "verify t.jsonl --no-digest --json", 1)["event"], 0);
}

#[test]
fn replay_ends_in_the_mesh() {
    let f = folder("replay");
    let v = json(&f, "mesh LAKE --trace a.obt -o whole.poly --json", 0);
    let last = v["counts"]["events"].as_u64().unwrap() - 1;
    expect(&f, &format!("replay a.obt --to {last} -o again.poly"), 0);
    for part in ["node", "ele", "poly"] {
        let [whole, again] = ["whole", "again"].map(|n| fs::read_to_string(f.join(format!("{n}.{part}"))).unwrap());
        assert!(whole == again, "{part}");
    }
    expect(&f, "replay a.obt --to 10 -o early.vtu", 0);
    expect(&f, "check early.vtu", 0);
    expect(&f, &format!("replay a.obt --to {} -o late.vtu", last + 1), 2);
    assert!(!f.join("late.vtu").exists());
}

#[test]
fn triangulations() {
    let f = folder("triangulate");
    let mut nodes = String::from("49 2 0 0\n");
    (0..49).for_each(|i| nodes.push_str(&format!("{} {} {}\n", i + 1, i % 7, i / 7)));
    fs::write(f.join("grid.node"), nodes).unwrap();
    let v = json(&f, "triangulate grid.node --mirror --json -o grid.off --trace grid.obt", 0);
    assert_eq!(v["counts"]["triangles"], 72);
    assert_eq!(v["mirror"]["verdict"], "identical");
    expect(&f, "verify grid.obt", 0);
    expect(&f, "check grid.off --claims valid,delaunay,canonical", 0);
    // Against its input as one of the hull, all of it and without its last triangle.
    let conforming = "check grid.off --input grid.node --convex --claims conforming";
    expect(&f, conforming, 0);
    let whole = fs::read_to_string(f.join("grid.off")).unwrap();
    let (rest, _) = whole.trim_end().rsplit_once('\n').unwrap();
    fs::write(f.join("grid.off"), rest.replacen(" 72 ", " 71 ", 1)).unwrap();
    expect(&f, conforming, 1);
    expect(&f, "mesh LAKE --convex -o lake.vtu", 0);
    expect(&f, "check lake.vtu --input LAKE --convex", 0);
    expect(&f, "check lake.vtu --input LAKE", 1);
}

#[test]
fn checks_say_no() {
    let f = folder("check");
    // Two triangles over the square's wrong diagonal: not Delaunay, and one of them clockwise.
    fs::write(f.join("bad.off"), "OFF\n4 2 0\n0 0 0\n2 0 0\n3 3 0\n0 2 0\n3 0 1 2\n3 0 3 2\n").unwrap();
    let v = json(&f, "check bad.off --claims orientation,delaunay --json", 1);
    assert_eq!(v["verdict"], "violated");
    assert_eq!(v["claims"][0]["claim"], "orientation");
    assert!(!v["claims"][0]["witnesses"].as_array().unwrap().is_empty());
    expect(&f, "check bad.off --claims beauty", 2);
}
