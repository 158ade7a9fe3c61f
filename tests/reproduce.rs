//! What `reproduce` prints, against what the paper prints.

use orthoball::model::QueueOrder;
use orthoball::reproduce::published::{FIGURE_TRIANGLES, TABLE};
use orthoball::reproduce::{figure_7_1, table_7_1};

#[test]
fn table_7_1_agrees_with_the_paper() {
    let table = table_7_1(1, &mut |_| {}).expect("32 runs of each experiment");
    assert!(table.holds(), "{table}");
    assert_eq!(table.spacing[1], 0, "nothing is undecided");
    assert_eq!(table.rows.len(), 32);
    for (line, published) in table.rows.iter().zip(&TABLE) {
        let n = line.number;
        assert_eq!(line.regions, [published.d2, published.d1, published.mu]);
        // triangles of Experiment 1: within 5%
        let ratio = f64::from(line.extreme.triangles[0]) / f64::from(published.triangles);
        assert!((ratio - 1.0).abs() < 0.05, "row {n}: {ratio}");
        // columns 5-7, by (5.23)
        let formula = line.formula.expect("defined in every row");
        for (ours, printed) in formula.iter().zip(published.bounds) {
            assert_eq!(format!("{ours:.2}"), format!("{printed:.2}"), "row {n}");
        }
        assert!(!line.fails.is_empty());
        // Type-C: 1.00 as printed where mu is at least 0.8: half way between two squares a square is as near as the ends
        let [_, _, c] = line.extreme.ours;
        assert!(c > 0.995 && (published.mu < 0.7 || c < 1.005), "row {n}: {c}");
    }
    let finite = |f: fn(&orthoball::reproduce::Line) -> bool| table.rows.iter().filter(|line| f(line)).count();
    assert_eq!(finite(|line| line.corrected_printed_c2.is_some()), 12);
    assert_eq!(finite(|line| line.corrected.is_some()), 24);
    assert_eq!(finite(|line| line.refined.is_some()), 24);
    let text = table.to_string();
    assert!(text.contains("1583") && text.contains("0 undecided"));
}

#[test]
fn figure_7_1_ends_above_30_degrees() {
    let figure = figure_7_1().expect("three runs");
    assert_eq!(
        figure.meshes.iter().map(|m| m.order).collect::<Vec<_>>(),
        [QueueOrder::Fifo, QueueOrder::WorstFirst, QueueOrder::ShortestEdge]
    );
    for m in &figure.meshes {
        assert!(m.complete && m.smallest_angle > 30.0, "{:?}", m.order);
        let ratio = f64::from(m.triangles) / f64::from(FIGURE_TRIANGLES);
        assert!((0.9..1.1).contains(&ratio), "{:?}: {ratio}", m.order);
    }
    let count = |tag: &str| figure.svg.matches(tag).count();
    assert_eq!((count("<svg"), count("</svg>"), count("<g "), count("</g>")), (1, 1, 3, 3));
    // Euler: v - e + t = 1 in each mesh; each edge is drawn, subsegments and borders twice or once
    let vertices: u32 = figure.meshes.iter().map(|m| m.vertices - 20).sum();
    assert_eq!(count("<circle"), vertices as usize);
}
