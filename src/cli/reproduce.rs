//! `reproduce`: a table or figure of a paper, published beside ours.

use super::args::ReproduceArgs;
use super::files::{Staged, extension};
use super::{Answer, Failure, Status, data, talk};
use crate::reproduce::{figure_7_1, table_7_1};
use std::io::{IsTerminal, stderr};

/// Prints it. Exit code 1 if a row of spacing fails, a density exceeds its bound, or a mesh is not finished.
pub fn run(args: &ReproduceArgs) -> Answer {
    match args.name.as_str() {
        "gcdr-table-7.1" => table(args),
        "gcdr-figure-7.1" => figure(args),
        other => Err(Failure::new(format_args!("{other}: known are gcdr-table-7.1 and gcdr-figure-7.1"))),
    }
}

fn table(args: &ReproduceArgs) -> Answer {
    if args.output.is_some() {
        return Err(Failure::new("a table is printed, not drawn: --output is for the figure"));
    }
    let mut progress = |rows: usize| {
        if stderr().is_terminal() {
            talk(format_args!("row {rows} of 32"));
        }
    };
    let table = table_7_1(args.seeds, &mut progress).map_err(Failure::new)?;
    if args.json {
        data(serde_json::to_value(&table).map_err(Failure::new)?)?
    } else {
        data(&table)?
    }
    Ok(if table.holds() { Status::Well } else { Status::No })
}

fn figure(args: &ReproduceArgs) -> Answer {
    let figure = figure_7_1().map_err(Failure::new)?;
    if let Some(path) = &args.output {
        if extension(path) != "svg" {
            return Err(Failure::at(path, "the figure is drawn as .svg"));
        }
        let mut files = Staged::default();
        files.write(path, figure.svg.as_bytes())?;
        files.commit()?;
    }
    if args.json {
        data(serde_json::to_value(&figure).map_err(Failure::new)?)?
    } else {
        data(&figure)?
    }
    Ok(if figure.meshes.iter().all(|m| m.complete) { Status::Well } else { Status::No })
}
