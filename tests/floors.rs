//! The architecture as a test: who imports whom, and what may not occur where. Reads the sources under `src/` as text.
//!
//! `docs/architecture.md` draws the floors; `FLOORS` below is the same table for the machine, and `WORDS` are its absences. Each rule has its
//! reason. The scanner itself is tested on samples that break every rule: a scanner that finds nothing proves nothing.

use std::fs;
use std::path::{Path, PathBuf};

/// What a folder (or single file) of `src/` may import, besides itself; `None`: anything. And why no more.
type Floor = (&'static str, Option<&'static [&'static str]>, &'static str);

const FLOORS: &[Floor] = &[
    ("model", Some(&[]), "plain data that both the producer and its checker read: nothing may hide in it"),
    ("arith", Some(&["model"]), "a kernel answers questions about points and knows no mesh"),
    ("trace", Some(&["model"]), "moves numbers; a trace format that computes could not be checked by another program"),
    ("domain", Some(&["model", "arith"]), "the conditions of an input are the same for every algorithm"),
    ("triangulation", Some(&["model", "arith"]), "does not know why a point is inserted and writes no events"),
    (
        "io",
        Some(&["model", "domain"]),
        "readers turn bytes into data; no algorithm depends on a format, no format on an algorithm",
    ),
    (
        "refine",
        Some(&["model", "arith", "trace", "domain", "triangulation"]),
        "algorithms know neither files nor who will check them",
    ),
    (
        "check",
        Some(&["model", "trace"]),
        "shares no arithmetic, triangulation or algorithm with the program it does not trust",
    ),
    (
        "audit",
        Some(&["model", "check"]),
        "judges meshes of any program, so of this one too: of the checker it takes number types, of the producer nothing",
    ),
    (
        "generators",
        Some(&["model"]),
        "decides the validity of what it makes by itself: a bug of the library must not shape its own test data",
    ),
    ("doctor", Some(&["model", "arith", "domain", "triangulation"]), "an examination refines nothing"),
    (
        "reproduce",
        Some(&["model", "arith", "trace", "refine", "check"]),
        "tables come from the library, not from the command line",
    ),
    (
        "attack",
        Some(&["model", "arith", "trace", "domain", "triangulation", "io", "refine", "check", "audit", "generators"]),
        "tests the library below the command line",
    ),
    ("cli", None, "the wiring"),
    ("main", Some(&["cli"]), "the program is the library's command line"),
    ("lib", None, "names the floors"),
];

/// Words that may not occur in a folder's code (tests apart), but in the files named; and why.
struct Words {
    words: &'static [&'static str],
    /// Whether only calls count, variables having any name.
    calls: bool,
    except_folders: &'static [&'static str],
    except_files: &'static [(&'static str, &'static str)],
    reason: &'static str,
}

/// Folders where no number decides anything but what a person sees, or what a test is fed with.
const TALK: &[&str] = &["cli", "generators", "reproduce", "attack"];

const WORDS: &[Words] = &[
    Words {
        words: &["HashMap", "HashSet", "RandomState"],
        calls: false,
        except_folders: &["cli"],
        except_files: &[],
        reason: "their order differs from run to run and would reach a queue, a tie or a trace",
    },
    Words {
        words: &[
            "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sin_cos", "sinh", "cosh", "tanh", "exp", "exp2",
            "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "powi", "cbrt", "hypot",
        ],
        calls: true,
        except_folders: TALK,
        except_files: &[
            ("domain/angles.rs", "degrees in a note; which angles are small is decided by the kernel"),
            ("audit/figures.rs", "degrees in a report"),
            ("audit/space/figures.rs", "degrees in a report"),
        ],
        reason: "libm rounds differently on different machines; sqrt and the four operations do not",
    },
    Words {
        words: &["mul_add"],
        calls: false,
        except_folders: &[],
        except_files: &[],
        reason: "fused where the machine can and slow where it cannot; error bounds are derived without it",
    },
    Words {
        words: &["f32"],
        calls: false,
        except_folders: &[],
        except_files: &[("io/scalar.rs", "single precision in foreign files")],
        reason: "coordinates are doubles",
    },
    Words {
        words: &["unsafe", "static mut"],
        calls: false,
        except_folders: &[],
        except_files: &[],
        reason: "any bytes may come as input",
    },
    Words {
        words: &["Instant", "SystemTime", "thread", "rayon"],
        calls: false,
        except_folders: &["cli"],
        except_files: &[
            ("triangulation/regular3/threads/mod.rs", "what the threads build is unique, whichever ends first"),
            ("triangulation/regular3/threads/assemble.rs", "puts it together"),
        ],
        reason: "no clock and no scheduler reaches a decision; budgets in seconds are the command line's",
    },
    Words {
        words: &["fs", "env", "println", "eprintln", "print", "dbg"],
        calls: false,
        except_folders: &["cli"],
        except_files: &[("main.rs", "hands the arguments on")],
        reason: "below the command line nothing touches files, the environment or the terminal",
    },
    Words {
        words: &["todo !", "unimplemented !"],
        calls: false,
        except_folders: &[],
        except_files: &[],
        reason: "what is not there is not offered",
    },
];

#[test]
fn imports_keep_to_the_floors() {
    let mut found = Vec::new();
    for source in sources() {
        found.extend(foreign_imports(&source));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn forbidden_words_do_not_occur() {
    let mut found = Vec::new();
    for source in sources() {
        found.extend(forbidden_words(&source));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_crate_forbids_unsafe_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let lib = fs::read_to_string(root.join("src/lib.rs")).unwrap();
    assert!(lib.contains("#![forbid(unsafe_code)]"));
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    assert!(manifest.contains("unsafe_code = \"forbid\""));
}

#[test]
fn every_folder_has_a_floor_and_a_place_in_the_picture() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("docs/architecture.md")).unwrap();
    let mut folders: Vec<String> = sources().into_iter().map(|s| s.folder()).collect();
    folders.sort();
    folders.dedup();
    for folder in &folders {
        assert!(FLOORS.iter().any(|(name, ..)| name == folder), "src/{folder} is on no floor");
        assert!(
            folder == "main" || folder == "lib" || page.contains(&format!("| `{folder}` |")),
            "docs/architecture.md does not tell of {folder}"
        );
    }
    for (name, ..) in FLOORS {
        assert!(folders.iter().any(|f| f == name), "there is no src/{name}");
    }
    // The exceptions exist, so that none outlives its reason.
    for (file, _) in WORDS.iter().flat_map(|w| w.except_files) {
        assert!(root.join("src").join(file).is_file(), "{file}");
    }
}

#[test]
fn the_scanner_sees_what_breaks_a_rule() {
    let bad = [
        ("check/a.rs", "use crate::arith::Kernel;"),
        ("check/a.rs", "use crate::{\n    model::Point2,\n    refine::{Run, RunError},\n};"),
        ("check/a.rs", "use super::super::domain::Scale;"),
        ("check/mod.rs", "use super::triangulation::cdt2;"),
        ("check/strict/a.rs", "fn f() { super::super::super::io::read() }"),
        ("check/a.rs", "fn f() { crate::triangulation::cdt2::g() }"),
        ("check/a.rs", "fn f() { orthoball::arith::g() }"),
        ("check/a.rs", "#[cfg(test)]\nmod tests {\n    use crate::arith::Kernel;\n}"),
        ("io/a.rs", "pub use crate::refine as r;"),
        ("model/point.rs", "use crate::arith;"),
        ("audit/mod.rs", "use crate::domain::normalise;"),
    ];
    for (path, text) in bad {
        assert_eq!(foreign_imports(&source(path, text)).len(), 1, "{path}: {text}");
    }
    let good = [
        ("check/a.rs", "use crate::model::Point2; use super::value::Value; use crate::check::rational;"),
        ("check/strict/a.rs", "use super::super::value::Value;"),
        ("check/a.rs", "// use crate::arith::Kernel;\nfn f() -> &'static str { \"crate::arith\" }"),
        ("refine/gcdr/a.rs", "use crate::arith::{Kernel, scale}; use crate::refine::Run;"),
    ];
    for (path, text) in good {
        assert_eq!(foreign_imports(&source(path, text)), Vec::<String>::new());
    }
    let words = [
        ("refine/a.rs", "use std::collections::HashMap;"),
        ("check/a.rs", "let y = x.sin();"),
        ("check/a.rs", "let y = f64::powi(x, 2);"),
        ("arith/a.rs", "let y = x.mul_add(a, b);"),
        ("arith/a.rs", "let y = unsafe { g() };"),
        ("domain/a.rs", "let y = x as f32;"),
        ("refine/a.rs", "let t = std::time::Instant::now();"),
        ("io/a.rs", "let t = std::fs::read(path);"),
        ("cli/a.rs", "todo!()"),
        // A test module hides what is in it, not what comes after it.
        ("arith/a.rs", "#[cfg(test)]\nmod tests {\n    fn f() {}\n}\nfn g() { x.cos(); }"),
    ];
    for (path, text) in words {
        assert_eq!(forbidden_words(&source(path, text)).len(), 1, "{path}: {text}");
    }
    let fine = [
        ("cli/a.rs", "use std::collections::HashMap;"),
        (
            "arith/a.rs",
            "//! The sin of a HashMap.\nlet c = '\"'; let sine = x.sqrt(); /* unsafe */ let s = r#\"mul_add\"#;",
        ),
        ("arith/a.rs", "#[cfg(test)]\nmod tests {\n    fn f() { x.cos(); }\n}"),
        ("domain/angles.rs", "let a = y.atan2(x);"),
    ];
    for (path, text) in fine {
        assert_eq!(forbidden_words(&source(path, text)), Vec::<String>::new(), "{text}");
    }
}

/// A file of `src/`: its path from there, and its code with comments and literals blanked out.
struct Source {
    path: String,
    code: String,
    /// Whether it is compiled for tests alone.
    test: bool,
}

fn source(path: &str, text: &str) -> Source {
    Source { path: path.into(), code: code_of(text), test: false }
}

impl Source {
    /// The folder of `src/` it is in, or its own name if it is in none.
    fn folder(&self) -> String {
        let first = self.path.split('/').next().unwrap();
        first.trim_end_matches(".rs").to_string()
    }

    /// The names of the modules it is in, outermost first, its own last.
    fn module(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.path.trim_end_matches(".rs").split('/').collect();
        if names.last() == Some(&"mod") || self.path == "lib.rs" {
            names.pop();
        }
        names
    }
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    rust_files(&root, &mut paths);
    paths.sort();
    let texts: Vec<(PathBuf, String)> = paths
        .into_iter()
        .map(|p| {
            let text = fs::read_to_string(&p).unwrap();
            (p, text)
        })
        .collect();
    // `#[cfg(test)] mod x;` makes x.rs, or the folder x, a test; they stand beside mod.rs, and in the folder a of a.rs.
    let mut tests: Vec<PathBuf> = Vec::new();
    for (path, text) in &texts {
        let opens_a_folder = ["mod.rs", "lib.rs", "main.rs"].iter().any(|name| path.ends_with(name));
        let place = if opens_a_folder { path.with_file_name("") } else { path.with_extension("") };
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for pair in lines.windows(2) {
            let name = pair[1].strip_prefix("mod ").and_then(|n| n.strip_suffix(';'));
            if let (true, Some(name)) = (is_test_attribute(pair[0]), name) {
                tests.push(place.join(name));
            }
        }
    }
    let all: Vec<Source> = texts
        .iter()
        .map(|(path, text)| Source {
            // Files are under the root that was walked.
            path: path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/"),
            code: code_of(text),
            test: tests.iter().any(|t| path.with_extension("").starts_with(t)),
        })
        .collect();
    assert!(all.len() > 100, "the sources have moved: {}", root.display());
    assert!(all.iter().any(|s| s.test));
    all
}

fn rust_files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            into.push(path);
        }
    }
}

fn is_test_attribute(line: &str) -> bool {
    line == "#[cfg(test)]" || line.starts_with("#[cfg(all(test,")
}

/// A text with comments, strings and characters turned into blanks; lines stay where they are.
fn code_of(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = bytes.to_vec();
    let mut i = 0;
    while i < bytes.len() {
        let end = literal_end(bytes, i);
        let blank_from = i;
        i = end.unwrap_or(i + 1);
        if end.is_some() {
            out[blank_from..i].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
        }
    }
    // Literals are blanked whole, so what is left is text as it was.
    String::from_utf8(out).unwrap()
}

/// Where the comment or literal ends that begins at `i`, if one does.
fn literal_end(b: &[u8], i: usize) -> Option<usize> {
    let find = |from: usize, what: &[u8]| {
        let at = b[from..].windows(what.len()).position(|w| w == what);
        at.map_or(b.len(), |at| from + at + what.len())
    };
    let rest = &b[i..];
    if rest.starts_with(b"//") {
        return Some(find(i, b"\n").min(b.len()));
    }
    if rest.starts_with(b"/*") {
        return Some(find(i + 2, b"*/"));
    }
    let word = i > 0 && (b[i - 1].is_ascii_alphanumeric() || b[i - 1] == b'_');
    if rest[0] == b'r' && !word {
        let hashes = rest[1..].iter().take_while(|c| **c == b'#').count();
        if rest.get(1 + hashes) == Some(&b'"') {
            let close = [b"\"".as_slice(), &b"#".repeat(hashes)].concat();
            return Some(find(i + 2 + hashes, &close));
        }
    }
    let quoted = |quote: u8| {
        let mut j = i + 1;
        while j < b.len() && b[j] != quote {
            j += if b[j] == b'\\' { 2 } else { 1 };
        }
        (j + 1).min(b.len())
    };
    match rest {
        [b'"', ..] => Some(quoted(b'"')),
        [b'\'', b'\\', ..] => Some(quoted(b'\'')),
        // A character, of up to four bytes; a lifetime has no closing quote.
        [b'\'', _, b'\'', ..] => Some(i + 3),
        [b'\'', c, ..] if !c.is_ascii() => Some(quoted(b'\'')),
        _ => None,
    }
}

/// Words and punctuation, each with its line.
fn tokens(code: &str) -> Vec<(usize, &str)> {
    let mut all = Vec::new();
    for (number, line) in code.lines().enumerate() {
        let mut rest = line;
        while let Some(first) = rest.chars().next() {
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            let length = if is_word(first) {
                rest.find(|c| !is_word(c)).unwrap_or(rest.len())
            } else if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            };
            if !first.is_whitespace() {
                all.push((number + 1, &rest[..length]));
            }
            rest = &rest[length..];
        }
    }
    all
}

/// Every path into another folder that the floor of this file does not allow.
fn foreign_imports(source: &Source) -> Vec<String> {
    let folder = source.folder();
    let floor = FLOORS.iter().find(|(name, ..)| *name == folder);
    let Some((_, allowed, reason)) = floor else {
        return vec![format!("src/{} is on no floor", source.path)];
    };
    let Some(allowed) = allowed else {
        return Vec::new();
    };
    let depth = source.module().len();
    let tokens = tokens(&source.code);
    let word = |i: usize| tokens.get(i).map_or("", |t| t.1);
    let mut named: Vec<(usize, &str)> = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        // How many modules the path leaves; a `super` of an inline module leaves less, which only makes this stricter.
        let mut up = 0;
        let from_root = match word(i) {
            "crate" | "orthoball" if word(i + 1) == "::" => {
                i += 2;
                true
            }
            "super" => {
                // `pub(super)` names no path.
                i += usize::from(word(i + 1) != "::");
                while word(i) == "super" && word(i + 1) == "::" {
                    up += 1;
                    i += 2;
                }
                up >= depth && up > 0
            }
            _ => {
                i += 1;
                continue;
            }
        };
        if from_root {
            heads(&tokens, &mut i, &mut named);
        }
    }
    let foreign = named
        .into_iter()
        .filter(|(_, name)| *name != folder && !allowed.contains(name))
        // What an inline module of a folder's root names through `super` is the folder's own.
        .filter(|(_, name)| FLOORS.iter().any(|(f, ..)| f == name));
    foreign.map(|(line, name)| format!("src/{}:{line}: {folder} imports {name}; {reason}", source.path)).collect()
}

/// The first name of a path, or of each path in a group `{a::.., b}`, from token `i` on.
fn heads<'a>(tokens: &[(usize, &'a str)], i: &mut usize, into: &mut Vec<(usize, &'a str)>) {
    let Some(&(line, first)) = tokens.get(*i) else {
        return;
    };
    if first != "{" {
        into.push((line, first));
        *i += 1;
        return;
    }
    let mut open = 0;
    let mut fresh = true;
    while let Some(&(line, word)) = tokens.get(*i) {
        match word {
            "{" => open += 1,
            "}" => open -= 1,
            "," => {}
            _ if fresh && open == 1 => into.push((line, word)),
            _ => {}
        }
        fresh = word == "," || word == "{";
        *i += 1;
        if open == 0 {
            break;
        }
    }
}

/// Every word that may not occur here, outside tests.
fn forbidden_words(source: &Source) -> Vec<String> {
    if source.test {
        return Vec::new();
    }
    let code = without_tests(&source.code);
    let tokens = tokens(&code);
    let mut found = Vec::new();
    for rule in WORDS {
        let folder = source.folder();
        let excepted =
            rule.except_folders.contains(&folder.as_str()) || rule.except_files.iter().any(|(f, _)| *f == source.path);
        if excepted {
            continue;
        }
        for (i, (line, word)) in tokens.iter().enumerate() {
            let two = tokens.get(i + 1).map(|next| format!("{word} {}", next.1));
            // Variables may have any name: a function of libm is called, or named by its path.
            let called = matches!(tokens.get(i + 1), Some((_, "("))) || matches!(tokens[i.max(1) - 1].1, "." | "::");
            let hit = rule.words.iter().find(|w| *w == word || Some(w.to_string()) == two);
            if let (Some(hit), true) = (hit, called || !rule.calls) {
                found.push(format!("src/{}:{line}: {hit}; {}", source.path, rule.reason));
            }
        }
    }
    found
}

/// Code without its inline test modules, which end, as formatted, with a brace in the first column.
fn without_tests(code: &str) -> String {
    let mut out = String::new();
    let mut inside = false;
    let lines: Vec<&str> = code.lines().collect();
    for (i, line) in lines.iter().enumerate() {
        let begins =
            is_test_attribute(line) && lines.get(i + 1).is_some_and(|l| l.contains("mod ") && l.ends_with('{'));
        inside |= begins;
        if !inside {
            out.push_str(line);
        }
        out.push('\n');
        inside &= *line != "}";
    }
    out
}
