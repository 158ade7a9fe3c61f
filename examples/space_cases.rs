//! Writes cases of space for the oracles, to stdout. Format: `oracle/README.md`, "Cases of space".
//!
//! ```text
//! space_cases small FIRST_SEED COUNT    every family of places with every family of weights, each with COUNT seeds, up to 200 points
//! space_cases single FIRST_SEED COUNT   the same, point by point in the order drawn
//! space_cases edits FIRST_SEED COUNT    the same with removals and changes of weight in between, up to 60 points
//! space_cases edited N                  one set of about N points of each family, then N / 4 removals and changes of weight, of each
//! space_cases tie-free                  some larger sets of the families without ties
//! space_cases large                     grids to 40^3, 10^6 random points, 10^5 weighted ones of which 10% are hidden, and their like
//! ```

use orthoball::generators::{Draw, Edit, SpaceFamily, SplitMix64, WeightFamily, edits, space_points, weighted_points};
use orthoball::model::{Point3, WeightedPoint};
use std::io::{Result, Write};

fn write_number(out: &mut impl Write, n: usize) -> Result<()> {
    let n = u32::try_from(n).map_err(std::io::Error::other)?;
    out.write_all(&n.to_le_bytes())
}

fn write_case(out: &mut impl Write, name: &str, points: &[WeightedPoint], edits: &[Edit]) -> Result<()> {
    write_number(out, name.len())?;
    out.write_all(name.as_bytes())?;
    write_number(out, points.len())?;
    for p in points {
        for x in [p.at.x, p.at.y, p.at.z, p.weight] {
            out.write_all(&x.to_le_bytes())?;
        }
    }
    write_number(out, edits.len())?;
    let mut next = 0;
    for edit in edits {
        let (kind, id, weight) = match *edit {
            Edit::Insert(_) => (0, next, 0.0),
            Edit::Remove(id) => (1, id, 0.0),
            Edit::SetWeight(id, weight) => (2, id, weight),
        };
        next += u32::from(kind == 0);
        write_number(out, kind)?;
        out.write_all(&id.to_le_bytes())?;
        out.write_all(&weight.to_le_bytes())?;
    }
    Ok(())
}

fn every_family(mut write: impl FnMut(SpaceFamily, WeightFamily) -> Result<()>) -> Result<()> {
    for family in SpaceFamily::ALL {
        for weights in WeightFamily::ALL {
            write(family, weights)?;
        }
    }
    Ok(())
}

/// How the points of a case come.
#[derive(Clone, Copy, PartialEq)]
enum Coming {
    AtOnce,
    Single,
    Edited,
}

fn small(out: &mut impl Write, first: u64, count: u64, coming: Coming) -> Result<()> {
    for seed in first..first + count {
        let mut draw = SplitMix64(seed);
        every_family(|family, weights| {
            let bound = if coming == Coming::Edited || family.is_quadratic() { 60 } else { 200 };
            let n = draw.below(bound) as usize;
            let points = weighted_points(family, weights, n, &mut draw);
            let drain = draw.below(8) == 0;
            let edits = match coming {
                Coming::AtOnce => Vec::new(),
                Coming::Single => edits(&points, 0, false, &mut draw),
                Coming::Edited => edits(&points, n, drain, &mut draw),
            };
            write_case(out, &format!("{family:?}+{weights:?}-{seed}"), &points, &edits)
        })?;
    }
    Ok(())
}

fn edited(out: &mut impl Write, n: usize) -> Result<()> {
    let mut draw = SplitMix64(n as u64);
    every_family(|family, weights| {
        let n = if family.is_quadratic() { n.min(100) } else { n };
        let points = weighted_points(family, weights, n, &mut draw);
        let edits = edits(&points, n / 4, false, &mut draw);
        write_case(out, &format!("{family:?}+{weights:?}-{n}"), &points, &edits)
    })
}

/// The k x k x k grid, z fastest.
fn grid(k: u32) -> Vec<Point3> {
    let coordinates = |i: u32| Point3::new(f64::from(i / (k * k)), f64::from(i / k % k), f64::from(i % k));
    (0..k * k * k).map(coordinates).collect()
}

fn large(out: &mut impl Write) -> Result<()> {
    let bare = |points: Vec<Point3>| points.into_iter().map(WeightedPoint::unweighted).collect::<Vec<_>>();
    for k in [2, 3, 4, 5, 6, 8, 10, 13, 16, 20, 25, 32, 40] {
        write_case(out, &format!("grid-{k}"), &bare(grid(k)), &[])?;
    }
    let mut draw = SplitMix64(2026);
    for k in [6, 12, 24] {
        let weigh = |at| WeightedPoint { at, weight: f64::from(draw.integer(-1, 1)) };
        write_case(
            out,
            &format!("integer weights on the grid-{k}"),
            &grid(k).into_iter().map(weigh).collect::<Vec<_>>(),
            &[],
        )?;
        let lift = |at: Point3| WeightedPoint { at, weight: at.length_squared() };
        write_case(out, &format!("lifted grid-{k}"), &grid(k).into_iter().map(lift).collect::<Vec<_>>(), &[])?;
    }
    for family in SpaceFamily::ALL {
        let n = if family.is_quadratic() { 600 } else { 50_000 };
        let points = bare(space_points(family, n, &mut draw));
        write_case(out, &format!("large {family:?}-{}", points.len()), &points, &[])?;
    }
    for weights in WeightFamily::ALL {
        for family in [SpaceFamily::Random, SpaceFamily::Cospherical, SpaceFamily::Clusters] {
            let points = weighted_points(family, weights, 20_000, &mut draw);
            write_case(out, &format!("large {family:?} {weights:?}-{}", points.len()), &points, &[])?;
        }
    }
    let hidden = weighted_points(SpaceFamily::Random, WeightFamily::Hidden, 100_000, &mut draw);
    write_case(out, "weighted-100000", &hidden, &[])?;
    let random = bare(space_points(SpaceFamily::Random, 1_000_000, &mut draw));
    write_case(out, "random-1000000", &random, &[])
}

fn tie_free(out: &mut impl Write) -> Result<()> {
    let mut draw = SplitMix64(77);
    for family in [SpaceFamily::Random, SpaceFamily::Clusters, SpaceFamily::Offset, SpaceFamily::RoundedSphere] {
        for n in [1_000, 10_000] {
            let points = weighted_points(family, WeightFamily::Zero, n, &mut draw);
            write_case(out, &format!("{family:?}-{n}"), &points, &[])?;
        }
    }
    Ok(())
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut out = std::io::BufWriter::new(std::io::stdout());
    match words[..] {
        ["small", first, count] => small(&mut out, first.parse()?, count.parse()?, Coming::AtOnce)?,
        ["single", first, count] => small(&mut out, first.parse()?, count.parse()?, Coming::Single)?,
        ["edits", first, count] => small(&mut out, first.parse()?, count.parse()?, Coming::Edited)?,
        ["edited", n] => edited(&mut out, n.parse()?)?,
        ["tie-free"] => tie_free(&mut out)?,
        ["large"] => large(&mut out)?,
        _ => return Err("see the head of examples/space_cases.rs".into()),
    }
    Ok(out.flush()?)
}
