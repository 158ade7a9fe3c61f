//! Every planar input of the data set: what is found in it, and that exactly four are refused.

use orthoball::arith::FastKernel;
use orthoball::doctor::examine;
use orthoball::domain::{Kind, Severity};
use orthoball::io::parse_poly;
use std::path::PathBuf;

fn corpus() -> Option<Vec<PathBuf>> {
    let data = std::env::var("ORTHOBALL_DATA")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data").into());
    let entries = std::fs::read_dir(PathBuf::from(data).join("pslg/as_poly")).ok()?;
    let mut files: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    files.sort();
    Some(files)
}

#[test]
fn four_of_the_corpus_are_refused() {
    let Some(files) = corpus() else {
        println!("skipped: the data set is absent");
        return;
    };
    assert_eq!(files.len(), 158);
    let mut refused = Vec::new();
    for file in &files {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = std::fs::read(file).expect("a readable file");
        let input = parse_poly(&bytes, None).expect("a .poly file");
        let start = std::time::Instant::now();
        let prepared = examine::<FastKernel>(&input.pslg, &input.lines);
        let seconds = start.elapsed().as_secs_f64();
        let count = |s| prepared.findings.iter().filter(|f| f.severity() == s).count();
        let counts = [Severity::Error, Severity::Repair, Severity::Note].map(count);
        println!("{name:60} {:7} segments {counts:?} {seconds:.3} s", input.pslg.segments.len());
        for f in &prepared.findings {
            assert!(f.elements.is_empty() || !f.lines.is_empty(), "{name}: {f} has no line");
        }
        if prepared.has_errors() {
            let errors: Vec<_> = prepared.findings.iter().filter(|f| f.severity() == Severity::Error).collect();
            errors.iter().take(3).for_each(|f| println!("    {f}"));
            refused.push((name, errors[0].kind));
        }
    }
    let kinds = refused.iter().map(|r| r.1);
    assert_eq!(refused.len(), 4, "{refused:?}");
    assert_eq!(kinds.clone().filter(|k| *k == Kind::Crossing).count(), 1, "{refused:?}");
    assert_eq!(kinds.filter(|k| *k == Kind::NoClosedRegion).count(), 3, "{refused:?}");
}
