//! Meshes as files, by extension. What belongs together is written together.

use super::Failure;
use super::files::Staged;
use crate::io::{Format, write_mesh};
use crate::model::{Mesh2, Pslg};
use std::path::{Path, PathBuf};

/// The files of a mesh under one name: more than one where the format needs them. Errors: no mesh is written under such a name.
fn files(path: &Path) -> Result<&'static [Format], Failure> {
    match Format::of(path).map_or(&[][..], Format::files_of_mesh) {
        [] => Err(Failure::at(
            path,
            "meshes are written to .vtu, .msh, .off, .svg, .node, .ele, .poly, .edge",
        )),
        files => Ok(files),
    }
}

/// Refuses names that `stage` would refuse; to be asked before a long run.
pub fn check_names(paths: &[PathBuf]) -> Result<(), Failure> {
    paths.iter().try_for_each(|path| files(path).map(drop))
}

/// Writes a mesh under each name, and says which files that are.
pub fn stage(
    paths: &[PathBuf],
    mesh: &Mesh2,
    domain: Option<&Pslg>,
    staged: &mut Staged,
) -> Result<Vec<PathBuf>, Failure> {
    let mut places: Vec<(PathBuf, Format)> = Vec::new();
    for path in paths {
        for &format in files(path)? {
            let own = Format::of(path) == Some(format);
            places.push((
                if own {
                    path.clone()
                } else {
                    path.with_extension(format.extension())
                },
                format,
            ));
        }
    }
    places.sort();
    places.dedup();
    for (place, format) in &places {
        let bytes = write_mesh(mesh, *format, domain)
            .ok_or_else(|| Failure::at(place, "no format of meshes"))?;
        staged.write(place, &bytes)?;
    }
    Ok(places.into_iter().map(|(place, _)| place).collect())
}
