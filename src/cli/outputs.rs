//! Meshes as files, by extension. What belongs together is written together.

use super::Failure;
use super::files::Staged;
use crate::io::{ForeignMesh3, Format, poly_wants_node, write_mesh, write_mesh3};
use crate::model::{Mesh2, Pslg};
use std::fs;
use std::path::{Path, PathBuf};

/// The files of a mesh under one name: more than one where the format needs them. Errors: no mesh is written under such a name.
fn files(path: &Path) -> Result<&'static [Format], Failure> {
    match Format::of(path).map_or(&[][..], Format::files_of_mesh) {
        [] => Err(Failure::at(path, "meshes are written to .vtu, .msh, .off, .svg, .node, .ele, .poly, .edge")),
        files => Ok(files),
    }
}

/// Refuses names that `stage` would refuse; to be asked before a long run.
pub fn check_names(paths: &[PathBuf]) -> Result<(), Failure> {
    places(paths).map(drop)
}

/// Refuses to write over the file that is read, or over the vertices that go with it.
pub fn spare_input(paths: &[PathBuf], input: &Path) -> Result<(), Failure> {
    let borrows = Format::of(input) == Some(Format::Poly) && fs::read(input).is_ok_and(|bytes| poly_wants_node(&bytes));
    let own = [Some(input.to_path_buf()), borrows.then(|| input.with_extension("node"))];
    // Files that do not exist are not in danger.
    let own: Vec<PathBuf> = own.into_iter().flatten().filter_map(|path| path.canonicalize().ok()).collect();
    for (place, _) in places(paths)? {
        if place.canonicalize().is_ok_and(|place| own.contains(&place)) {
            return Err(Failure::at(&place, "would be written over, and belongs to the input; give another name"));
        }
    }
    Ok(())
}

/// Every file to be written, once.
fn places(paths: &[PathBuf]) -> Result<Vec<(PathBuf, Format)>, Failure> {
    let mut places = Vec::new();
    for path in paths {
        for &format in files(path)? {
            let own = Format::of(path) == Some(format);
            places.push((if own { path.clone() } else { path.with_extension(format.extension()) }, format));
        }
    }
    places.sort();
    places.dedup();
    Ok(places)
}

/// Writes a mesh under each name, and says which files that are.
pub fn stage(
    paths: &[PathBuf],
    mesh: &Mesh2,
    domain: Option<&Pslg>,
    staged: &mut Staged,
) -> Result<Vec<PathBuf>, Failure> {
    let places = places(paths)?;
    for (place, format) in &places {
        let bytes = write_mesh(mesh, *format, domain).ok_or_else(|| Failure::at(place, "no format of meshes"))?;
        staged.write(place, &bytes)?;
    }
    Ok(places.into_iter().map(|(place, _)| place).collect())
}

/// Every file of a mesh of space to be written, once.
fn places3(paths: &[PathBuf], mesh: &ForeignMesh3) -> Result<Vec<(PathBuf, Format)>, Failure> {
    let mut places = Vec::new();
    for path in paths {
        let formats = Format::of(path).map(|f| f.files_of_mesh3(mesh)).unwrap_or_default();
        if formats.is_empty() {
            return Err(Failure::at(path, "meshes of space are written to .vtu, .vtk, .msh, .mesh, .node, .ele"));
        }
        for format in formats {
            let own = Format::of(path) == Some(format);
            places.push((if own { path.clone() } else { path.with_extension(format.extension()) }, format));
        }
    }
    places.sort();
    places.dedup();
    Ok(places)
}

/// Refuses names that `stage3` would refuse, and to write over the points that are read.
pub fn spare_input3(paths: &[PathBuf], input: &Path) -> Result<(), Failure> {
    let own = input.canonicalize().ok();
    for (place, _) in places3(paths, &ForeignMesh3::default())? {
        if own.is_some() && place.canonicalize().ok() == own {
            return Err(Failure::at(&place, "would be written over, and is the input; give another name"));
        }
    }
    Ok(())
}

/// Writes a mesh of space under each name, and says which files that are.
pub fn stage3(paths: &[PathBuf], mesh: &ForeignMesh3, staged: &mut Staged) -> Result<Vec<PathBuf>, Failure> {
    let places = places3(paths, mesh)?;
    for (place, format) in &places {
        let bytes = write_mesh3(mesh, *format).ok_or_else(|| Failure::at(place, "no format of meshes of space"))?;
        staged.write(place, &bytes)?;
    }
    Ok(places.into_iter().map(|(place, _)| place).collect())
}
