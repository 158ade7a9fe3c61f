//! Files: read whole; written whole or not at all, several together.

use super::Failure;
use crate::io::{self, AnyMesh, Column, Format};
use std::fs::{self, File, OpenOptions};
use std::io::{BufReader, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The bytes of a file.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|e| Failure::at(path, e))
}

/// A file to be read bit by bit.
pub fn open(path: &Path) -> Result<BufReader<File>, Failure> {
    File::open(path).map(|file| BufReader::with_capacity(1 << 16, file)).map_err(|e| Failure::at(path, e))
}

/// The extension of a path in lower case; empty if it has none.
pub fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// Reads files of the same name in other formats, where they exist.
pub fn companion(path: &Path) -> impl FnMut(Format) -> Option<Vec<u8>> {
    move |format| fs::read(path.with_extension(format.extension())).ok()
}

/// Reads a mesh of the plane or of space by its extension and content. `column`: where the weights of points of space stand.
pub fn read_any_mesh(path: &Path, column: Option<&Column>) -> Result<AnyMesh, Failure> {
    let known = || match extension(path).as_str() {
        "meshb" => Failure::at(path, "binary .meshb is not read here; save the mesh as .mesh, which is text"),
        _ => Failure::at(path, "meshes are read from .vtu, .vtk, .msh, .mesh, .off, .node, .ele, .face, .edge, .poly"),
    };
    let format = Format::of(path).filter(|f| f.reads_mesh() || f.reads_mesh3()).ok_or_else(known)?;
    let bytes = read(path)?;
    let mesh = io::read_any_mesh(format, &bytes, column, companion(path)).ok_or_else(known)?;
    mesh.map_err(|e| Failure::at(path, e))
}

/// Files on their way. Each is written beside its place under another name; `commit` renames all. Dropped before that, they are gone.
#[derive(Debug, Default)]
pub struct Staged {
    /// Place and present name.
    files: Vec<(PathBuf, PathBuf)>,
}

impl Staged {
    /// Begins a file that is to appear at `path`.
    pub fn create(&mut self, path: &Path) -> Result<BufWriter<File>, Failure> {
        let Some(name) = path.file_name() else {
            return Err(Failure::at(path, "names no file"));
        };
        if path.is_dir() {
            return Err(Failure::at(path, "is a folder"));
        }
        if self.files.iter().any(|(place, _)| place == path) {
            return Err(Failure::at(path, "is named twice"));
        }
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}", std::process::id()));
        let present = path.with_file_name(hidden);
        let file = OpenOptions::new().write(true).create_new(true).open(&present).map_err(|e| match e.kind() {
            ErrorKind::NotFound => Failure::at(path, "its folder does not exist; make it first"),
            _ => Failure::at(path, e),
        })?;
        self.files.push((path.to_path_buf(), present));
        Ok(BufWriter::with_capacity(1 << 16, file))
    }

    /// Writes a whole file that is to appear at `path`.
    pub fn write(&mut self, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
        let mut file = self.create(path)?;
        file.write_all(bytes).and_then(|()| file.flush()).map_err(|e| Failure::at(path, e))
    }

    /// Where the file that is to appear at `path` is now.
    pub fn present(&self, path: &Path) -> Option<&Path> {
        let found = self.files.iter().find(|(place, _)| place == path);
        found.map(|(_, present)| present.as_path())
    }

    /// Lets all files appear. If one cannot, those that already did are taken away again.
    pub fn commit(mut self) -> Result<(), Failure> {
        for (i, (place, present)) in self.files.iter().enumerate() {
            if let Err(e) = fs::rename(present, place) {
                let failure = Failure::at(place, e);
                for (place, _) in self.files.drain(..i) {
                    let _ = fs::remove_file(place);
                }
                return Err(failure);
            }
        }
        self.files.clear();
        Ok(())
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        for (_, present) in &self.files {
            let _ = fs::remove_file(present);
        }
    }
}
