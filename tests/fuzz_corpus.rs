//! Replays the committed corpora of the fuzz targets: what fuzzing found worth keeping is an ordinary test.
#![cfg(all(feature = "exact", feature = "generators"))]

use arbitrary::{Arbitrary, Unstructured};
use orthoball::attack::readers::{self, Target};
use orthoball::attack::{CdtCase, GcdrCase, KernelCase, MutatedTraceCase};
use std::path::Path;

/// Fewer files than this, and the corpus is not the one that was committed.
const LEAST: usize = 20;

/// Runs every file of a corpus, in order of names.
fn replay(target: &str, run: impl Fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("fuzz/corpus")
        .join(target);
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| entry.expect("a readable folder").path())
        .collect();
    files.sort();
    assert!(
        files.len() >= LEAST,
        "{target} has {} files only",
        files.len()
    );
    for file in &files {
        let bytes = std::fs::read(file).expect("a readable file");
        // Shown if it panics.
        println!("{}", file.display());
        run(&bytes);
    }
}

/// As libfuzzer decodes it.
fn decoded<'a, C: Arbitrary<'a>>(bytes: &'a [u8]) -> Option<C> {
    C::arbitrary_take_rest(Unstructured::new(bytes)).ok()
}

#[test]
fn kernels() {
    replay("kernels", |bytes| {
        decoded::<KernelCase>(bytes)
            .iter()
            .for_each(KernelCase::run);
    });
}

#[test]
fn cdt() {
    replay("cdt", |bytes| {
        decoded::<CdtCase>(bytes).iter().for_each(CdtCase::run);
    });
}

#[test]
fn gcdr() {
    replay("gcdr", |bytes| {
        decoded::<GcdrCase>(bytes).iter().for_each(GcdrCase::run);
    });
}

#[test]
fn mutated_traces() {
    replay("mutated_traces", |bytes| {
        decoded::<MutatedTraceCase>(bytes)
            .iter()
            .for_each(MutatedTraceCase::run);
    });
}

#[test]
fn readers() {
    for (name, target) in [
        ("read_poly", Target::Poly),
        ("read_node_ele", Target::NodeEle),
        ("read_wkt", Target::Wkt),
        ("read_geojson", Target::GeoJson),
        ("read_off", Target::Off),
        ("read_vtu", Target::Vtu),
        ("read_msh", Target::Msh),
        ("read_trace_text", Target::TraceText),
        ("read_trace_binary", Target::TraceBinary),
    ] {
        replay(name, |bytes| readers::run(target, bytes));
    }
}
