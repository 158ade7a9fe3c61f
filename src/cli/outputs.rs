//! Meshes as files, by extension. What belongs together is written together.

use super::files::Staged;
use super::{Failure, talk};
use crate::io::{ForeignMesh3, Format, poly_wants_node, write_mesh, write_mesh3};
use crate::model::{Mesh2, Pslg};
use std::fs;
use std::path::{Path, PathBuf};

/// The files that are one mesh of Triangle: who reads one reads those of the others that stand beside it.
const TRIANGLE: [Format; 4] = [Format::Node, Format::Ele, Format::Poly, Format::Edge];

/// The same of TetGen.
const TETGEN: [Format; 4] = [Format::Node, Format::Ele, Format::Face, Format::Edge];

/// A file to be written.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    path: PathBuf,
    /// It is of an earlier mesh, nobody asked for it, and it would be read with the new files.
    stale: bool,
    format: Format,
}

/// Refuses names that `stage` would refuse; to be asked before a long run.
pub fn check_names(paths: &[PathBuf]) -> Result<(), Failure> {
    places(paths).map(drop)
}

/// Refuses to write a file over itself.
pub fn spare_file(path: &Path, input: &Path) -> Result<(), Failure> {
    let own = input.canonicalize().ok();
    if own.is_some() && path.canonicalize().ok() == own {
        return Err(Failure::at(path, "would be written over, and is the input; give another name"));
    }
    Ok(())
}

/// Refuses to write over the file that is read, or over the vertices that go with it.
pub fn spare_input(paths: &[PathBuf], input: &Path) -> Result<(), Failure> {
    let own = [Some(input.to_path_buf()), borrows(input).then(|| input.with_extension("node"))];
    // Files that do not exist are not in danger.
    let own: Vec<PathBuf> = own.into_iter().flatten().filter_map(|path| path.canonicalize().ok()).collect();
    for Place { path, .. } in places(paths)? {
        if path.canonicalize().is_ok_and(|path| own.contains(&path)) {
            return Err(Failure::at(&path, "would be written over, and belongs to the input; give another name"));
        }
    }
    Ok(())
}

/// Whether a `.poly` file has its vertices in the `.node` file beside it.
fn borrows(path: &Path) -> bool {
    Format::of(path) == Some(Format::Poly) && fs::read(path).is_ok_and(|bytes| poly_wants_node(&bytes))
}

/// Every file to be written, once. `files`: those that a mesh in a format consists of. Errors: no mesh is written under such a name, which `known` says.
fn all_places(
    paths: &[PathBuf],
    family: &[Format],
    files: impl Fn(Format) -> Vec<Format>,
    known: &str,
) -> Result<Vec<Place>, Failure> {
    let mut places = Vec::new();
    for path in paths {
        let named = Format::of(path);
        let formats = named.map(&files).unwrap_or_default();
        if formats.is_empty() {
            return Err(Failure::at(path, known));
        }
        let at = |format: Format| {
            if named == Some(format) { path.clone() } else { path.with_extension(format.extension()) }
        };
        let joins = |&format: &Format| {
            let path = at(format);
            // A .poly file with vertices of its own is an input, and no part of a mesh.
            !formats.contains(&format) && path.exists() && (format != Format::Poly || borrows(&path))
        };
        let beside = if named.is_some_and(|f| family.contains(&f)) { family } else { &[] };
        let stale = beside.iter().copied().filter(joins).map(|f| Place { path: at(f), stale: true, format: f });
        places.extend(stale);
        places.extend(formats.iter().map(|&f| Place { path: at(f), stale: false, format: f }));
    }
    // What is asked for under another name is not stale.
    places.sort();
    places.dedup_by(|later, first| later.path == first.path);
    Ok(places)
}

fn places(paths: &[PathBuf]) -> Result<Vec<Place>, Failure> {
    let known = "meshes are written to .vtu, .msh, .msh2, .off, .svg, .node, .ele, .poly, .edge";
    all_places(paths, &TRIANGLE, |f| f.files_of_mesh().to_vec(), known)
}

/// Says which files of an earlier mesh are written anew.
fn tell_stale(places: &[Place]) {
    for Place { path, .. } in places.iter().filter(|place| place.stale) {
        let name = path.display();
        talk(format_args!("note: {name} of an earlier mesh is replaced, since it would be read with the new files"));
    }
}

/// Writes a mesh under each name, and says which files that are.
pub fn stage(
    paths: &[PathBuf],
    mesh: &Mesh2,
    domain: Option<&Pslg>,
    staged: &mut Staged,
) -> Result<Vec<PathBuf>, Failure> {
    let places = places(paths)?;
    tell_stale(&places);
    for Place { path, format, .. } in &places {
        let bytes = write_mesh(mesh, *format, domain).ok_or_else(|| Failure::at(path, "no format of meshes"))?;
        staged.write(path, &bytes)?;
    }
    Ok(places.into_iter().map(|place| place.path).collect())
}

/// Every file of a mesh of space to be written, once.
fn places3(paths: &[PathBuf], mesh: &ForeignMesh3) -> Result<Vec<Place>, Failure> {
    let known = "meshes of space are written to .vtu, .vtk, .msh, .msh2, .mesh, .off (triangles only), .node, .ele, .face, .edge";
    all_places(paths, &TETGEN, |f| f.files_of_mesh3(mesh), known)
}

/// Refuses names that `stage3` would refuse, and to write over the file that is read or over one that goes with it.
pub fn spare_input3(paths: &[PathBuf], input: &Path) -> Result<(), Failure> {
    // The files that exist are places of any mesh.
    places3(paths, &ForeignMesh3::default())?.iter().try_for_each(|place| spare_file(&place.path, input))
}

/// Writes a mesh of space under each name, and says which files that are and what they have no place for.
pub fn stage3(paths: &[PathBuf], mesh: &ForeignMesh3, staged: &mut Staged) -> Result<Vec<PathBuf>, Failure> {
    let places = places3(paths, mesh)?;
    tell_stale(&places);
    for Place { path, format, .. } in &places {
        if format.loses_weights() && mesh.weights.iter().any(|&w| w != 0.0) {
            tell_lost(path, "weights");
        }
        let bytes = write_mesh3(mesh, *format).ok_or_else(|| Failure::at(path, "no format of meshes of space"))?;
        staged.write(path, &bytes)?;
    }
    Ok(places.into_iter().map(|place| place.path).collect())
}

/// Says that a file has no place for something.
pub fn tell_lost(path: &Path, what: &str) {
    talk(format_args!("note: {} has no place for {what}, which are left out", path.display()));
}

/// Refuses a `.node` file of points where it would be read with the elements of a mesh.
pub fn check_alone(path: &Path) -> Result<(), Failure> {
    if Format::of(path) != Some(Format::Node) {
        return Ok(());
    }
    let beside = TETGEN[1..].iter().map(|f| path.with_extension(f.extension())).find(|p| p.exists());
    beside.map_or(Ok(()), |other| {
        let problem =
            format_args!("is there and would be read with {}; remove it or give another name", path.display());
        Err(Failure::at(&other, problem))
    })
}
