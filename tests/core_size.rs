//! The core of the checker stays readable in one sitting.

use std::{fs, path::Path};

/// The files to read, in order; `src/check/mod.rs` says the same.
const CORE: [&str; 5] = ["value", "predicates", "complex", "surgery", "replay"];

#[test]
fn the_core_of_the_checker_is_under_a_thousand_lines() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let head = fs::read_to_string(root.join("src/check/mod.rs")).expect("the module exists");
    let rows: Vec<_> = CORE.map(|name| head.find(&format!("//! | `{name}` |"))).to_vec();
    assert!(rows.iter().all(Option::is_some) && rows.is_sorted(), "the head of the module names another core");
    let mut total = 0;
    for name in CORE {
        let file = root.join(format!("src/check/{name}.rs"));
        let lines = fs::read_to_string(file).expect("a file of the core").lines().count();
        println!("{lines:5} {name}");
        total += lines;
    }
    assert!(total <= 1000, "{total} lines");
}
