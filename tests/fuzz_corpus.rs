//! Replays the committed corpora of the fuzz targets: what fuzzing found worth keeping is an ordinary test.
#![cfg(all(feature = "exact", feature = "generators"))]

use arbitrary::{Arbitrary, Unstructured};
use orthoball::attack::readers::{self, Target};
use orthoball::attack::{
    CdtCase, EditCase3, GcdrCase, KernelCase, KernelCase3, MutatedMeshCase, MutatedTrace3Case, MutatedTraceCase,
    UserCase,
};
use orthoball::generators::SplitMix64;
use orthoball::trace::{Event, Record, SkipReason, SplitKind, Why};
use std::path::Path;

/// Fewer files than this, and the corpus is not the one that was committed.
const LEAST: usize = 20;

/// Runs every file of a corpus, in order of names.
fn replay(target: &str, mut run: impl FnMut(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| entry.expect("a readable folder").path())
        .collect();
    files.sort();
    assert!(files.len() >= LEAST, "{target} has {} files only", files.len());
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
        decoded::<KernelCase>(bytes).iter().for_each(KernelCase::run);
    });
}

#[test]
fn kernels3() {
    replay("kernels3", |bytes| {
        decoded::<KernelCase3>(bytes).iter().for_each(KernelCase3::run);
    });
}

#[test]
fn cdt() {
    replay("cdt", |bytes| {
        decoded::<CdtCase>(bytes).iter().for_each(CdtCase::run);
    });
}

#[test]
fn edits3() {
    replay("edits3", |bytes| {
        decoded::<EditCase3>(bytes).iter().for_each(EditCase3::run);
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
        decoded::<MutatedTraceCase>(bytes).iter().for_each(MutatedTraceCase::run);
    });
}

#[test]
fn mutated_traces3() {
    replay("mutated_traces3", |bytes| {
        decoded::<MutatedTrace3Case>(bytes).iter().for_each(MutatedTrace3Case::run);
    });
}

/// Random bytes, as a fuzzer begins with.
#[test]
fn random_changes_of_traces_of_space_are_found_out() {
    let cases = std::env::var("ORTHOBALL_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(2000);
    let mut draw = SplitMix64(77);
    for length in 0..cases {
        let bytes: Vec<u8> = (0..30 + length % 400).map(|_| draw.word() as u8).collect();
        decoded::<MutatedTrace3Case>(&bytes).iter().for_each(MutatedTrace3Case::run);
    }
}

#[test]
fn users() {
    replay("users", |bytes| {
        decoded::<UserCase>(bytes).iter().for_each(UserCase::run);
    });
}

#[test]
fn mutated_meshes() {
    replay("mutated_meshes", |bytes| {
        decoded::<MutatedMeshCase>(bytes).iter().for_each(MutatedMeshCase::run);
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
        ("read_node3", Target::Node3),
        ("read_xyz", Target::Xyz),
        ("read_off3", Target::Off3),
        ("read_ply", Target::Ply),
        ("read_csv", Target::Csv),
        ("read_npy", Target::Npy),
        ("read_tetgen", Target::Tetgen),
        ("read_medit", Target::Medit),
        ("read_msh3", Target::Msh3),
        ("read_vtu3", Target::Vtu3),
        ("read_vtk", Target::Vtk),
        ("read_trace_text", Target::TraceText),
        ("read_trace_binary", Target::TraceBinary),
    ] {
        replay(name, |bytes| readers::run(target, bytes));
    }
}

/// The corpus of runs is worth its name: everything that a trace can say is said by some file of it.
#[test]
fn the_corpus_reaches_every_event() {
    let mut said = std::collections::BTreeMap::<String, usize>::new();
    replay("gcdr", |bytes| {
        let trace = decoded::<GcdrCase>(bytes).and_then(|case| case.trace());
        for record in trace.into_iter().flatten() {
            let what = match record {
                Record::Event(Event::Insert { why, .. }) => match why {
                    Why::Free { cause } => format!("free {cause:?}"),
                    Why::Split { kind, shell, .. } => match (kind, shell) {
                        (_, Some(_)) => "shell".into(),
                        (SplitKind::B, _) => "B".into(),
                        (SplitKind::C { .. }, _) => "C".into(),
                    },
                },
                Record::Event(Event::Remove { .. }) => "remove".into(),
                Record::Event(Event::Skip { reason, .. }) => match reason {
                    SkipReason::Resolution => "resolution".into(),
                    SkipReason::InputAngle { .. } => "input angle".into(),
                    SkipReason::SplitLimit { .. } => "split limit".into(),
                },
                Record::End(end) => format!("{:?}", end.outcome),
                _ => continue,
            };
            *said.entry(what).or_default() += 1;
        }
    });
    println!("{said:?}");
    for what in [
        "free Skinny",
        "free Area",
        "B",
        "C",
        "shell",
        "remove",
        "resolution",
        "input angle",
        "split limit",
        "Complete",
        "Holey",
        "Stopped",
    ] {
        assert!(said.contains_key(what), "no {what} in {said:?}");
    }
}
