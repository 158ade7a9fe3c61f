//! `doctor`: every finding in an input at once.

use super::args::DoctorArgs;
use super::input::load_examined;
use super::{Answer, Status, data};
use crate::domain::Severity;
use crate::model::Fill;
use crate::model::words::counted;
use serde_json::json;

/// Lists all findings, errors first. Exit code 1 if there is an error among them.
pub fn run(args: &DoctorArgs) -> Answer {
    let loaded = load_examined(&args.input, args.convex.then_some(Fill::Convex))?;
    let [errors, repairs, notes] = [Severity::Error, Severity::Repair, Severity::Note].map(|s| loaded.count(s));
    if args.json {
        data(json!({
            "verdict": if errors == 0 { "sound" } else { "refused" },
            "errors": errors, "repairs": repairs, "notes": notes,
            "findings": loaded.json(),
        }))?;
    } else {
        for entry in &loaded.entries {
            data(&entry.text)?;
        }
        let [errors, repairs, notes] =
            [(errors, "error"), (repairs, "repair"), (notes, "note")].map(|(n, noun)| counted(n, noun));
        data(format_args!("{errors}, {repairs}, {notes}"))?;
    }
    Ok(if errors == 0 { Status::Well } else { Status::No })
}
