//! The program under random commands, options and files: whatever is typed, it answers.
//!
//! A case is a command with options, some of them nonsense, on a small file of some format, often damaged. Asserted: exit code 0 to 3 in good
//! time; no panic; JSON where it was asked for; after a refusal (2) one sentence, or the errors of the input each in its line, nothing on stdout but JSON, and a
//! folder as it was; else no file but those named. Whatever is meshed is verified, and no damaged trace is.
//!
//! `ORTHOBALL_CLI_CASES` sets the number of cases.

use proptest::prelude::*;
use proptest::sample::Index;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Cases of an ordinary run.
const CASES: u32 = 300;
/// Longer than any of these small runs takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

const POLY: &str = "8 2 1 1\n1 0 0 0.5 1\n2 4 0 1 1\n3 4 4 2 1\n4 0 4 3 1\n5 1 1 0 2\n6 3 1 0 2\n7 3 3 0 2\n8 1 3 0 2\n\
    8 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n5 5 6 2\n6 6 7 2\n7 7 8 2\n8 8 5 2\n1\n1 2 2\n1\n1 0.5 0.5 7 0.3\n";
const NODE: &str = "6 2 0 0\n1 0 0\n2 1 0\n3 2 1\n4 0 1\n5 1 1\n6 0.25 0.5\n";
const WKT: &str = "POLYGON((0 0, 4 0, 4 3, 0 3, 0 0), (1 1, 2 1, 2 2, 1 1))\nLINESTRING(3 1, 3.5 2)\nPOINT(0.5 0.5)\n";
const GEOJSON: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":1},"geometry":
    {"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3],[0,3],[0,0]],[[1,1],[1,2],[2,1],[1,1]]]}}]}"#;

const ATOMS: &str = "x,y,z,w\n0,0,0,1\n2,0,0,0.5\n0,2,0,0\n0,0,2,0.25\n1,1,1,1\n2,2,2,0\n0.5,0.25,1.5,0\n2,2,2,0.125\n";

/// What damage puts into a file.
const TOKENS: [&[u8]; 24] = [
    b"0",
    b"-1",
    b"1",
    b"2",
    b"7",
    b"nan",
    b"inf",
    b"1e400",
    b"1e300",
    b"1e-300",
    b"4294967296",
    b"18446744073709551616",
    b"0.1",
    b"\n",
    b" ",
    b"\0",
    b"\x1b[31m",
    b"\xff\xfe",
    b"#",
    b"}",
    b"]",
    b"<",
    b"\"",
    b",",
];

/// One change of a file.
#[derive(Clone, Debug)]
enum Edit {
    Flip(Index, u8),
    Truncate(Index),
    Delete(Index, usize),
    /// A token in the place of the word there.
    Word(Index, usize),
    Insert(Index, usize),
    /// A line once more, somewhere else.
    Line(Index, Index),
}

fn edit() -> impl Strategy<Value = Edit> {
    let at = any::<Index>;
    prop_oneof![
        2 => (at(), 0..8u8).prop_map(|(i, bit)| Edit::Flip(i, bit)),
        1 => at().prop_map(Edit::Truncate),
        1 => (at(), 1..40usize).prop_map(|(i, n)| Edit::Delete(i, n)),
        4 => (at(), 0..TOKENS.len()).prop_map(|(i, k)| Edit::Word(i, k)),
        2 => (at(), 0..TOKENS.len()).prop_map(|(i, k)| Edit::Insert(i, k)),
        1 => (at(), at()).prop_map(|(i, j)| Edit::Line(i, j)),
    ]
}

fn damaged(mut bytes: Vec<u8>, edits: &[Edit]) -> Vec<u8> {
    for edit in edits {
        let n = bytes.len();
        if n == 0 {
            break;
        }
        match edit {
            Edit::Flip(i, bit) => bytes[i.index(n)] ^= 1 << bit,
            Edit::Truncate(i) => bytes.truncate(i.index(n)),
            Edit::Delete(i, length) => drop(bytes.drain(i.index(n)..(i.index(n) + length).min(n))),
            Edit::Insert(i, k) => drop(bytes.splice(i.index(n)..i.index(n), TOKENS[*k].iter().copied())),
            Edit::Word(i, k) => {
                let part = |b: &u8| !b" \n,[](){}<>:\"".contains(b);
                let from = bytes[..i.index(n)].iter().rposition(|b| !part(b)).map_or(0, |p| p + 1);
                let to = from + bytes[from..].iter().position(|b| !part(b)).unwrap_or(n - from);
                bytes.splice(from..to, TOKENS[*k].iter().copied());
            }
            Edit::Line(i, j) => {
                let lines: Vec<&[u8]> = bytes.split_inclusive(|&b| b == b'\n').collect();
                let (from, to) = (i.index(lines.len()), j.index(lines.len()));
                bytes = [&lines[..to], &[lines[from]], &lines[to..]].concat().concat();
            }
        }
    }
    bytes
}

/// What follows an option.
#[derive(Clone, Copy)]
enum Takes {
    Nothing,
    /// A file that is there.
    Input,
    /// Values that are taken, and values that mostly are not.
    Value(&'static [&'static str], &'static [&'static str]),
}

const WRONG: &[&str] = &["0", "-1", "90", "nan", "inf", "1e308", "1e-300", "", "x", "18446744073709551615"];
const MESH: Takes = Takes::Value(
    &["out.vtu", "out.off", "out.svg", "out.ele", "out.node", "out.poly", "out.edge", "out.msh", "out.msh2"],
    &["out", "out.txt", ".", "no/out.vtu", ""],
);
const TRACE: Takes = Takes::Value(&["out.obt", "out.jsonl"], &["out.vtu", "no/out.obt"]);
const DISK: Takes = Takes::Value(&["center", "extreme", "random", "offcenter", "clamped-offcenter"], WRONG);
const INTERVAL: Takes = Takes::Value(&["center", "extreme", "random"], &["offcenter"]);
const ANGLE: Takes = Takes::Value(&["0.5", "20", "25", "33"], WRONG);
const COUNT: Takes = Takes::Value(&["0", "1", "7", "40"], WRONG);
const FRACTION: Takes = Takes::Value(&["1", "0.5", "0.9"], WRONG);

/// A command, how many files it is given, and its options.
type Spec = (&'static str, usize, &'static [(&'static str, Takes)]);

const COMMANDS: [Spec; 9] = [
    (
        "mesh",
        1,
        &[
            ("-o", MESH),
            ("-o", MESH),
            ("--trace", TRACE),
            ("--trace", TRACE),
            ("--json", Takes::Nothing),
            ("--min-angle", ANGLE),
            ("--rho2", Takes::Value(&["1", "1.5", "2"], WRONG)),
            ("--max-area", Takes::Value(&["0.1", "0.01", "1e300"], WRONG)),
            ("--promise", Takes::Value(&["graded", "admissible"], &["outside"])),
            ("--max-splits", COUNT),
            ("--choice", DISK),
            ("--choice-a", DISK),
            ("--choice-b", INTERVAL),
            ("--choice-c", INTERVAL),
            ("--d1", FRACTION),
            ("--d2", FRACTION),
            ("--mu", FRACTION),
            ("--extreme", Takes::Value(&["first", "newest", "seeded"], WRONG)),
            ("--seed", COUNT),
            ("--order", Takes::Value(&["fifo", "worst-first", "shortest-edge"], WRONG)),
            ("--deletion", Takes::Value(&["segment", "point", "disk"], WRONG)),
            ("--small-angles", Takes::Value(&["shells", "off"], WRONG)),
            ("--convex", Takes::Nothing),
            ("--kernel", Takes::Value(&["fast", "exact"], &["plain"])),
            ("--mirror", Takes::Nothing),
            ("--max-seconds", Takes::Value(&["5", "inf"], WRONG)),
        ],
    ),
    (
        "verify",
        1,
        &[
            ("--input", Takes::Input),
            ("--strict", Takes::Nothing),
            ("--spacing", Takes::Nothing),
            ("--no-digest", Takes::Nothing),
            ("--json", Takes::Nothing),
        ],
    ),
    (
        "check",
        1,
        &[
            ("--input", Takes::Input),
            ("--convex", Takes::Nothing),
            ("--claims", Takes::Value(&["valid", "delaunay,canonical", "conforming,topology"], &["", "x", "valid,,"])),
            ("--within", FRACTION),
            ("--min-angle", ANGLE),
            ("--json", Takes::Nothing),
        ],
    ),
    ("doctor", 1, &[("--convex", Takes::Nothing), ("--json", Takes::Nothing)]),
    (
        "triangulate",
        1,
        &[
            ("-o", MESH),
            ("--trace", TRACE),
            ("--json", Takes::Nothing),
            ("--weights", Takes::Value(&["w", "4"], &["x", "0", "9", ""])),
            ("--radii", Takes::Value(&["w", "4"], &["x", "0", "9", ""])),
            ("--threads", Takes::Value(&["1", "2"], WRONG)),
            ("--steps", Takes::Nothing),
            ("--max-steps", COUNT),
            ("--mirror", Takes::Nothing),
            ("--kernel", Takes::Value(&["fast", "exact"], &["plain"])),
        ],
    ),
    ("diff", 2, &[("--json", Takes::Nothing)]),
    ("replay", 1, &[("--to", COUNT), ("--to", COUNT), ("-o", MESH), ("-o", MESH)]),
    ("convert", 1, &[]),
    ("nonsense", 1, &[("--json", Takes::Nothing), ("-o", MESH)]),
];

/// What is typed, and on which files.
#[derive(Clone, Debug)]
struct Case {
    command: usize,
    /// Each a sound file, and what is done to it.
    files: [(Index, Vec<Edit>); 2],
    /// Mostly of the command's own formats.
    any_file: bool,
    /// Which option, which of its values, and whether of those that are wrong.
    options: Vec<(Index, Index, bool)>,
    max_steps: u16,
    /// Where a conversion goes.
    to: Index,
}

fn case() -> impl Strategy<Value = Case> {
    // Two files of three are whole.
    let edits = || prop_oneof![2 => Just(Vec::new()), 1 => prop::collection::vec(edit(), 1..4)];
    let option = (any::<Index>(), any::<Index>(), prop::bool::weighted(0.08));
    let file = || (any::<Index>(), edits());
    let options = prop::collection::vec(option, 0..6);
    let any_file = prop::bool::weighted(0.1);
    (0..COMMANDS.len() + 4, [file(), file()], any_file, options, 0..100u16, any::<Index>()).prop_map(
        // `mesh` has the most options.
        |(command, files, any_file, options, max_steps, to)| Case {
            command: if command < COMMANDS.len() { command } else { 0 },
            files,
            any_file,
            options,
            max_steps,
            to,
        },
    )
}

/// Of this process alone.
fn root() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cli_fuzz_{}", std::process::id()))
}

fn folder(name: &str) -> PathBuf {
    let path = root().join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("a folder of its own");
    path
}

/// Files by name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry"));
    let name = |e: &fs::DirEntry| e.file_name().to_string_lossy().into_owned();
    entries.map(|e| (name(&e), fs::read(e.path()).expect("a file"))).collect()
}

struct Answer {
    code: i32,
    stdout: String,
    stderr: String,
}

/// Runs the program in a folder. What it says is kept beside the folder, so that a full pipe holds up nobody.
fn run(folder: &Path, arguments: &[String]) -> Answer {
    let said = ["stdout", "stderr"].map(|name| folder.with_extension(name));
    let [stdout, stderr] = [0, 1].map(|i| Stdio::from(File::create(&said[i]).expect("a file")));
    let mut command = Command::new(env!("CARGO_BIN_EXE_orthoball"));
    let command = command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(stdout).stderr(stderr);
    let mut child = command.spawn().expect("the program");
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        if begun.elapsed() > PATIENCE {
            child.kill().expect("a child");
            panic!("{arguments:?} does not end");
        }
        std::thread::sleep(Duration::from_millis(1));
    };
    let [stdout, stderr] =
        said.map(|path| String::from_utf8(fs::read(path).expect("a file")).expect("what is said is UTF-8"));
    Answer { code: status.code().unwrap_or(-1), stdout, stderr }
}

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_string).collect()
}

/// Sound files of all formats, by name.
fn sound() -> &'static BTreeMap<String, Vec<u8>> {
    static FILES: OnceLock<BTreeMap<String, Vec<u8>>> = OnceLock::new();
    FILES.get_or_init(|| {
        let f = folder("sound");
        for (name, text) in [
            ("graph.poly", POLY),
            ("points.node", NODE),
            ("land.wkt", WKT),
            ("land.geojson", GEOJSON),
            ("atoms.csv", ATOMS),
        ] {
            fs::write(f.join(name), text).expect("a file");
        }
        for arguments in [
            "mesh graph.poly -o m.vtu -o m.off -o m.msh -o m.ele --trace run.obt",
            "mesh land.wkt --min-angle 30 -o n.msh2 --trace wkt.jsonl",
            "triangulate points.node -o t.off --trace t.jsonl",
            "convert run.obt run.jsonl",
            "triangulate atoms.csv --weights w -o cells.vtu -o cells.mesh --trace cells.obt",
            "triangulate atoms.csv --weights w --steps --trace steps.jsonl",
        ] {
            assert_eq!(run(&f, &words(arguments)).code, 0, "{arguments}");
        }
        // Written by Gmsh as .msh, too.
        fs::rename(f.join("n.msh2"), f.join("n.msh")).expect("a file");
        files(&f)
    })
}

/// What a command reads, by extension.
fn reads(command: &str) -> &'static [&'static str] {
    match command {
        "verify" | "diff" | "replay" => &["obt", "jsonl"],
        "check" => &["vtu", "off", "msh", "ele", "node", "mesh"],
        "triangulate" => &["poly", "node", "wkt", "geojson", "csv"],
        "convert" | "nonsense" => &[],
        _ => &["poly", "node", "wkt", "geojson"],
    }
}

fn extension(name: &str) -> &str {
    name.rsplit_once('.').map_or("", |(_, e)| e)
}

impl Case {
    /// Writes the files; their names, and whether each is as it was.
    fn files(&self, folder: &Path) -> Vec<(String, bool)> {
        let (command, count, _) = COMMANDS[self.command];
        let wanted = reads(command);
        // One for the command, one more for it or for `--input`.
        let kinds = [wanted, if count == 2 { wanted } else { reads("mesh") }];
        let written = self.files.iter().zip(kinds).zip(["in", "other"]).map(|(((index, edits), kinds), stem)| {
            let fits = |name: &&String| self.any_file || kinds.is_empty() || kinds.contains(&extension(name));
            let names: Vec<&String> = sound().keys().filter(fits).collect();
            let name = *index.get(&names);
            let content = damaged(sound()[name].clone(), edits);
            let whole = sound().values().any(|v| *v == content);
            let own = format!("{stem}.{}", extension(name));
            fs::write(folder.join(&own), content).expect("a file");
            if extension(name) == "ele" {
                fs::write(folder.join(format!("{stem}.node")), &sound()["m.node"]).expect("a file");
            }
            (own, whole)
        });
        written.collect()
    }

    /// What is typed after the name of the program.
    fn arguments(&self, files: &[(String, bool)]) -> Vec<String> {
        let (command, count, options) = COMMANDS[self.command];
        let mut typed = vec![command.to_string()];
        typed.extend(files.iter().take(count).map(|f| f.0.clone()));
        for (option, value, wrong) in self.options.iter().filter(|_| !options.is_empty()) {
            let (name, takes) = *option.get(options);
            if name != "-o" && typed.iter().any(|t| t == name) {
                continue;
            }
            typed.push(name.to_string());
            match takes {
                Takes::Nothing => {}
                Takes::Input => typed.push(files[1].0.clone()),
                Takes::Value(right, not) => typed.push(value.get(if *wrong { not } else { right }).to_string()),
            }
        }
        match command {
            "convert" => {
                let trace = ["obt", "jsonl"].contains(&extension(&files[0].0));
                let Takes::Value(right, _) = (if trace != self.any_file { TRACE } else { MESH }) else {
                    unreachable!()
                };
                typed.push(self.to.get(right).to_string());
            }
            "replay" => {
                for needed in [["--to", "3"], ["-o", "out.off"]] {
                    if !typed.iter().any(|t| t == needed[0]) {
                        typed.extend(needed.map(str::to_string));
                    }
                }
            }
            "mesh" => {
                // Else areas of 1e-300 take all the steps there are.
                typed.extend(["--max-steps".to_string(), self.max_steps.to_string()]);
                // Points enclose nothing.
                if extension(&files[0].0) == "node" && !typed.iter().any(|t| t == "--convex") {
                    typed.push("--convex".to_string());
                }
            }
            _ => {}
        }
        typed
    }

    /// The command and its exit code.
    fn test(&self) -> (&'static str, i32) {
        let f = folder("case");
        let given = self.files(&f);
        let arguments = self.arguments(&given);
        let before = files(&f);
        let answer = run(&f, &arguments);
        let Answer { code, stdout, stderr } = &answer;
        let texts: Vec<_> = before.iter().map(|(name, b)| (name, String::from_utf8_lossy(b))).collect();
        let shown = format!("{arguments:?}: {code}\nstdout: {stdout}\nstderr: {stderr}\nfiles: {texts:?}");

        assert!((0..=3).contains(code), "a code of its own: {shown}");
        assert!(!stderr.contains("panicked") && !stdout.contains("panicked"), "{shown}");
        let unprintable = |c: char| c.is_control() && c != '\n' && c != '\t';
        assert!(!stderr.contains(unprintable) && !stdout.contains(unprintable), "a terminal would obey: {shown}");
        if arguments.iter().any(|a| a == "--json") && (*code != 2 || !stdout.is_empty()) {
            let value: Result<serde_json::Value, _> = serde_json::from_str(stdout);
            assert!(value.is_ok_and(|v| v.is_object()), "no JSON: {shown}");
        } else if *code == 2 {
            assert!(stdout.is_empty(), "data of a refusal: {shown}");
        }
        let after = files(&f);
        if *code == 2 {
            assert!(is_clear(stderr), "no clear sentence: {shown}");
            assert!(before == after, "files of a refusal: {:?}: {shown}", after.keys());
        }
        let changed = after.iter().filter(|(name, bytes)| before.get(*name) != Some(bytes)).map(|(name, _)| name);
        for name in changed {
            assert!(name.starts_with("out.") && !after[name].is_empty(), "{name}: {shown}");
        }
        assert!(before.keys().all(|name| after.contains_key(name)), "{:?}: {shown}", after.keys());

        let command = COMMANDS[self.command].0;
        let digests = !arguments.iter().any(|a| a == "--no-digest");
        if command == "verify" && *code == 0 && digests {
            assert!(given[0].1, "a damaged trace is accepted: {shown}");
        }
        for name in after.keys().filter(|n| !before.contains_key(*n) && ["obt", "jsonl"].contains(&extension(n))) {
            let verdict = run(&f, &words(&format!("verify {name} --strict")));
            let true_trace = command != "convert" || given[0].1;
            assert!(!true_trace || verdict.code == 0, "{}: {shown}", verdict.stdout);
        }
        (command, *code)
    }
}

/// What clap says of wrong usage; or one sentence of ours; or the errors of an input, one a line.
fn is_clear(stderr: &str) -> bool {
    if stderr.starts_with("error: ") {
        return stderr.contains("--help");
    }
    let ours = stderr.lines().filter(|l| l.starts_with("orthoball: ") && l.len() > 20).count();
    let of_input = stderr.lines().filter(|l| l.contains(": error: ")).count();
    ours == 1 && of_input == 0 || ours == 0 && of_input > 0
}

#[test]
fn whatever_is_typed_is_answered() {
    let cases = std::env::var("ORTHOBALL_CLI_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(CASES);
    let config =
        ProptestConfig { cases, failure_persistence: None, max_shrink_iters: 300, ..ProptestConfig::default() };
    let answers: RefCell<BTreeMap<(&str, i32), u32>> = RefCell::default();
    proptest!(config, |(case in case())| *answers.borrow_mut().entry(case.test()).or_default() += 1);
    println!("{answers:?}");
    let _ = fs::remove_dir_all(root());
    // Cases that are all refused would show little.
    let answers = answers.into_inner();
    for often in [("mesh", 0), ("mesh", 2)] {
        assert!(answers.contains_key(&often), "no {often:?}: {answers:?}");
    }
    assert!(answers.keys().any(|a| a.1 == 1), "{answers:?}");
}
