//! `doctor`: every finding in an input at once.

use super::args::DoctorArgs;
use super::input::{load_examined, require_points};
use super::{Answer, Status, data, space};
use crate::domain::Severity;
use crate::model::Fill;
use crate::model::words::counted;
use serde_json::json;

/// Lists all findings, errors first. Exit code 1 if there is an error among them.
pub fn run(args: &DoctorArgs) -> Answer {
    require_points(&args.input)?;
    let entries = if space::is_spatial(&args.input)? {
        space::examined(&args.input, args.column.column().as_ref())?
    } else {
        load_examined(&args.input, args.convex.then_some(Fill::Convex))?.entries
    };
    let count = |severity| entries.iter().filter(|e| e.severity == severity).count();
    let [errors, repairs, notes] = [Severity::Error, Severity::Repair, Severity::Note].map(count);
    if args.json {
        data(json!({
            "verdict": if errors == 0 { "sound" } else { "refused" },
            "errors": errors, "repairs": repairs, "notes": notes,
            "findings": entries.iter().map(|e| &e.json).collect::<Vec<_>>(),
        }))?;
    } else {
        for entry in &entries {
            data(&entry.text)?;
        }
        let [errors, repairs, notes] =
            [(errors, "error"), (repairs, "repair"), (notes, "note")].map(|(n, noun)| counted(n, noun));
        data(format_args!("{errors}, {repairs}, {notes}"))?;
    }
    Ok(if errors == 0 { Status::Well } else { Status::No })
}
