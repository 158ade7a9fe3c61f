//! `diff`: where two traces first differ.

use super::args::DiffArgs;
use super::files::open;
use super::{Answer, Failure, Status, data};
use crate::trace::{DecodeError, Reader, first_divergence};

/// Prints the first difference. Exit code 1 if there is one, 2 if either trace cannot be read to it.
pub fn run(args: &DiffArgs) -> Answer {
    let (first, second) = (Reader::new(open(&args.first)?), Reader::new(open(&args.second)?));
    let divergence = first_divergence(first, second)
        .map_err(|(which, e): (usize, DecodeError)| Failure::at([&args.first, &args.second][which], e))?;
    if args.json {
        let value = match &divergence {
            None => serde_json::json!({"verdict": "equal"}),
            Some(d) => serde_json::json!({
                "verdict": "diverged", "record": d.record, "event": d.event, "field": d.field, "first": d.first, "second": d.second, "meaning": d.meaning(),
            }),
        };
        data(value)?;
    } else {
        match &divergence {
            None => data("the traces have the same content")?,
            Some(d) => {
                data(d)?;
                data(format_args!("that is: {}", d.meaning()))?;
                for (name, line) in ["first", "second"].iter().zip(&d.lines).filter(|(_, line)| !line.is_empty()) {
                    data(format_args!("{name:<6} {line}"))?;
                }
            }
        }
    }
    Ok(if divergence.is_none() { Status::Well } else { Status::No })
}
