//! Writes cases of the generators for the oracles: `oracle_cases FIRST_SEED COUNT` gives COUNT seeds of every family.
//!
//! Each graph appears three times: as drawn, and with vertices and segments in two shuffled orders under their old labels, so that one
//! answer is right for all three. Format: `oracle/README.md`.

use orthoball::generators::{Draw, PointFamily, PslgFamily, SplitMix64, points, pslg};
use orthoball::model::Pslg;
use std::io::Write;

/// A random permutation (Fisher and Yates).
fn shuffled(n: usize, draw: &mut SplitMix64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, draw.below(i as u32 + 1) as usize);
    }
    order
}

fn write_case(out: &mut impl Write, name: &str, g: &Pslg, order: &[usize], segments: &[usize]) -> std::io::Result<()> {
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    writeln!(out, "case {name} {} {} 0", order.len(), segments.len())?;
    for &v in order {
        writeln!(out, "{v} {:?} {:?}", g.points[v].x, g.points[v].y)?;
    }
    for &s in segments {
        let [u, v] = g.segments[s].ends.map(|v| place[v.index()]);
        writeln!(out, "{u} {v}")?;
    }
    Ok(())
}

fn write_graph(out: &mut impl Write, name: &str, g: &Pslg, draw: &mut SplitMix64) -> std::io::Result<()> {
    let (n, m) = (g.points.len(), g.segments.len());
    write_case(out, name, g, &(0..n).collect::<Vec<_>>(), &(0..m).collect::<Vec<_>>())?;
    for _ in 0..2 {
        let (order, segments) = (shuffled(n, draw), shuffled(m, draw));
        write_case(out, name, g, &order, &segments)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let numbers: Vec<u64> = std::env::args().skip(1).map(|a| a.parse()).collect::<Result<_, _>>()?;
    let &[first, count] = &numbers[..] else {
        return Err("usage: oracle_cases FIRST_SEED COUNT".into());
    };
    let mut out = std::io::BufWriter::new(std::io::stdout());
    for seed in first..first + count {
        let mut draw = SplitMix64(seed);
        let n = 3 + draw.below(120) as usize;
        for family in PointFamily::ALL {
            let g = Pslg { points: points(family, n, &mut draw), ..Pslg::default() };
            write_graph(&mut out, &format!("{family:?}-{seed}"), &g, &mut draw)?;
        }
        for family in PslgFamily::all() {
            let g = pslg(family, n, &mut draw);
            write_graph(&mut out, &format!("{family:?}-{seed}").replace(['(', ')'], "."), &g, &mut draw)?;
        }
    }
    Ok(out.flush()?)
}
