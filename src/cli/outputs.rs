//! Meshes as files, by extension. What belongs together is written together.

use super::Failure;
use super::files::{Staged, extension};
use crate::io::write;
use crate::model::{Mesh2, Pslg};
use std::path::{Path, PathBuf};

/// The extensions that `stage` knows, for messages.
pub const OUTPUTS: &str = ".vtu, .node, .ele, .poly, .edge";

/// Refuses names that `stage` would refuse; to be asked before a long run.
pub fn check_names(paths: &[PathBuf]) -> Result<(), Failure> {
    paths
        .iter()
        .try_for_each(|path| match extension(path).as_str() {
            "node" | "ele" | "poly" | "edge" | "vtu" => Ok(()),
            other => Err(Failure::at(
                path,
                format_args!("meshes end in {OUTPUTS}, not in .{other}"),
            )),
        })
}

/// Writes a mesh under each name. Of Triangle's files, `.node` and `.ele` are written with any of them.
pub fn stage(
    paths: &[PathBuf],
    mesh: &Mesh2,
    domain: Option<&Pslg>,
    staged: &mut Staged,
) -> Result<Vec<PathBuf>, Failure> {
    let mut places: Vec<PathBuf> = Vec::new();
    for path in paths {
        if matches!(extension(path).as_str(), "node" | "ele" | "poly" | "edge") {
            places.extend([path.with_extension("node"), path.with_extension("ele")]);
        }
        places.push(path.clone());
    }
    places.sort();
    places.dedup();
    for place in &places {
        staged.write(place, &bytes(place, mesh, domain)?)?;
    }
    Ok(places)
}

fn bytes(path: &Path, mesh: &Mesh2, domain: Option<&Pslg>) -> Result<Vec<u8>, Failure> {
    Ok(match extension(path).as_str() {
        "node" => write::triangle::node(mesh),
        "ele" => write::triangle::ele(mesh),
        "poly" => write::triangle::poly(mesh, domain),
        "edge" => write::triangle::edge(mesh),
        "vtu" => write::vtu(mesh),
        other => {
            return Err(Failure::at(
                path,
                format_args!("meshes end in {OUTPUTS}, not in .{other}"),
            ));
        }
    })
}
