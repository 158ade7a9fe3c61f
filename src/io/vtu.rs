//! Reads VTK XML unstructured grids (`.vtu`) of one piece: triangles and lines in the plane, or tetrahedra, triangles and lines in space.
//!
//! Arrays may be ASCII, inline base64, or appended (raw or base64), plain or compressed by zlib (`block`). Of the data only what our
//! writers give is taken: `marker` and `attribute_k` of points, `weight` in space, `marker` and `region` of cells (`gmsh:physical` stands in for either).

use super::block::Blocks;
use super::flat::{FIX, Flat};
use super::foreign::{ForeignEdge, ForeignMesh};
use super::grid::{Arrays, Cells, STAND_INS, Value, mesh_of_space, weight_array};
use super::rows::{MOST_ELEMENTS, clipped, text};
use super::scalar::Scalar;
use super::xml::{Tag, TagKind, Tags};
use super::{AnyMesh, Column, ForeignMesh3, ReadError, error::shown, number};
use crate::model::Point2;

/// Reads a `.vtu` file as a planar mesh.
///
/// Errors: the first fault; cells other than vertices, lines and triangles and vertices off one plane z = constant are faults.
pub fn parse_vtu(bytes: &[u8]) -> Result<ForeignMesh, ReadError> {
    let file = File::scan(bytes)?;
    plane(&file, &read_cells(&file)?)
}

/// Reads a `.vtu` file as a mesh of space; `column` names the array of weights of the points (without it `weight`, if there is one).
///
/// Errors: the first fault; cells other than vertices, lines, triangles and tetrahedra are one.
pub fn parse_vtu3(bytes: &[u8], column: Option<&Column>) -> Result<ForeignMesh3, ReadError> {
    let file = File::scan(bytes)?;
    space(&file, &read_cells(&file)?, column)
}

/// Reads a `.vtu` file as a mesh of space if it has a tetrahedron or weights are asked for, and as a planar one otherwise.
pub(super) fn parse_any_vtu(bytes: &[u8], column: Option<&Column>) -> Result<AnyMesh, ReadError> {
    let file = File::scan(bytes)?;
    let cells = read_cells(&file)?;
    if cells.have_tetrahedra() || column.is_some() {
        return space(&file, &cells, column).map(AnyMesh::Space);
    }
    plane(&file, &cells).map(AnyMesh::Plane)
}

fn plane(file: &File, all: &Cells) -> Result<ForeignMesh, ReadError> {
    let mut mesh = ForeignMesh::default();
    points(file, &mut mesh)?;
    cells(file, all, &mut mesh)?;
    Ok(mesh)
}

fn space(file: &File, cells: &Cells, column: Option<&Column>) -> Result<ForeignMesh3, ReadError> {
    let points = file.values("Points", "", 3, Some(file.points))?;
    let arrays = Arrays {
        point_markers: file.perhaps("PointData", "marker", file.points)?,
        weights: file.perhaps("PointData", weight_array(".vtu", column)?, file.points)?,
        cell_markers: file.of_cells("marker")?,
        regions: file.of_cells("region")?,
    };
    mesh_of_space(".vtu", &points, cells, arrays, column)
}

/// The arrays of a file, not yet decoded.
struct File<'a> {
    arrays: Vec<(&'a str, Tag<'a>)>,
    /// The tag of the piece.
    piece: Tag<'a>,
    /// Bytes of the file.
    size: usize,
    points: usize,
    cells: usize,
    blocks: Blocks,
    /// Encoding of the appended data, and the bytes behind its underscore.
    appended: Option<(&'a str, &'a [u8])>,
}

impl<'a> File<'a> {
    fn scan(bytes: &'a [u8]) -> Result<File<'a>, ReadError> {
        let mark = b"<AppendedData";
        let (head, tail) = match bytes.windows(mark.len()).position(|w| w == mark) {
            Some(at) => bytes.split_at(at),
            None => (bytes, &[][..]),
        };
        let mut tags = Tags::new(text(".vtu", head)?);
        let Some(root) = tags.next()?.filter(|t| t.name == "VTKFile") else {
            return Err(ReadError {
                part: ".vtu",
                line: 1,
                problem: "the file does not start with the tag VTKFile".into(),
                ..ReadError::default()
            });
        };
        if root.get("type") != Some("UnstructuredGrid") {
            return Err(root.fault(
                format!("the type is {}", shown(root.get("type").unwrap_or("missing"))),
                "only UnstructuredGrid is read here",
            ));
        }
        let blocks = Blocks::of(&root)?;
        let mut arrays = Vec::new();
        let mut piece: Option<Tag> = None;
        let mut section = "";
        while let Some(tag) = tags.next()? {
            match (tag.name, tag.kind) {
                ("Piece", TagKind::Open | TagKind::Empty) if piece.is_some() => {
                    return Err(tag.fault("a second piece", "merge the pieces into one"));
                }
                ("Piece", TagKind::Open | TagKind::Empty) => piece = Some(tag),
                ("PointData" | "CellData" | "Points" | "Cells", TagKind::Open) => section = tag.name,
                ("PointData" | "CellData" | "Points" | "Cells", _) => section = "",
                ("DataArray", TagKind::Open | TagKind::Empty) if !section.is_empty() => arrays.push((section, tag)),
                _ => {}
            }
        }
        let Some(piece) = piece else {
            return Err(root.fault("it holds no piece", "the file is truncated"));
        };
        let count = |name: &str| {
            let n = piece.get(name).and_then(|n| n.trim_ascii().parse::<u64>().ok());
            n.filter(|&n| n <= MOST_ELEMENTS).map(|n| n as usize).ok_or_else(|| {
                let said = piece.get(name).map_or("missing".into(), shown);
                let fix = format!("it must be a whole number of at most {MOST_ELEMENTS}");
                piece.fault(format!("{name} is {said}"), &fix)
            })
        };
        Ok(File {
            size: bytes.len(),
            points: count("NumberOfPoints")?,
            cells: count("NumberOfCells")?,
            blocks,
            appended: appended(tail)?,
            piece,
            arrays,
        })
    }

    fn array(&self, section: &str, name: &str) -> Option<&Tag<'a>> {
        self.arrays
            .iter()
            .find(|(s, tag)| *s == section && (name.is_empty() || tag.get("Name") == Some(name)))
            .map(|(_, tag)| tag)
    }

    /// The values of an array that must be there, `per` for each of `count` items; any number of them if `count` is not given.
    fn values(&self, section: &str, name: &str, per: usize, count: Option<usize>) -> Result<Vec<Value>, ReadError> {
        let missing =
            || self.piece.fault(format!("the array {section} {name} is missing"), "the file is truncated or no mesh");
        let tag = self.array(section, name).ok_or_else(missing)?;
        self.decode(tag, per, count)
    }

    /// The values of an array that may be missing.
    fn perhaps(&self, section: &str, name: &str, count: usize) -> Result<Option<Vec<Value>>, ReadError> {
        self.array(section, name).map(|tag| self.decode(tag, 1, Some(count))).transpose()
    }

    /// An array of the cells, or what stands in for it.
    fn of_cells(&self, name: &str) -> Result<Option<Vec<Value>>, ReadError> {
        let names = [&[name], &STAND_INS[..]].concat();
        let found = names.into_iter().find(|name| self.array("CellData", name).is_some());
        Ok(found.map(|name| self.perhaps("CellData", name, self.cells)).transpose()?.flatten())
    }

    fn decode(&self, tag: &Tag, per: usize, count: Option<usize>) -> Result<Vec<Value>, ReadError> {
        let components = tag.get("NumberOfComponents").unwrap_or("1");
        if components != per.to_string() {
            return Err(tag.fault(format!("NumberOfComponents is {}", shown(components)), &format!("it must be {per}")));
        }
        let values = match tag.get("format").unwrap_or("ascii") {
            "ascii" => ascii(tag)?,
            "binary" => self.numbers(tag, &self.blocks.in_base64(tag, tag.text.as_bytes())?)?,
            "appended" => {
                let missing = || tag.fault("its appended data is missing", "the file is truncated");
                let (encoding, data) = self.appended.ok_or_else(missing)?;
                let offset = tag.get("offset").and_then(|o| o.trim_ascii().parse::<usize>().ok());
                let data = offset.and_then(|o| data.get(o..)).ok_or_else(missing)?;
                match encoding {
                    "raw" => self.numbers(tag, &self.blocks.raw(tag, data)?)?,
                    _ => self.numbers(tag, &self.blocks.in_base64(tag, data)?)?,
                }
            }
            other => {
                return Err(
                    tag.fault(format!("the format is {}", shown(other)), "ascii, binary and appended are read here")
                );
            }
        };
        match count.map(|n| n * per) {
            Some(due) if due != values.len() => {
                Err(tag.fault(format!("it has {} numbers instead of {due}", values.len()), "the file is damaged"))
            }
            _ => Ok(values),
        }
    }

    fn numbers(&self, tag: &Tag, data: &[u8]) -> Result<Vec<Value>, ReadError> {
        let kind = tag.get("type").unwrap_or("");
        let scalar = match kind {
            "Int8" => Scalar::I8,
            "UInt8" => Scalar::U8,
            "Int16" => Scalar::I16,
            "UInt16" => Scalar::U16,
            "Int32" => Scalar::I32,
            "UInt32" => Scalar::U32,
            "Int64" => Scalar::I64,
            "UInt64" => Scalar::U64,
            "Float32" => Scalar::F32,
            "Float64" => Scalar::F64,
            other => return Err(tag.fault(format!("the type is {}", shown(other)), "")),
        };
        let items = data.chunks_exact(scalar.size());
        let values: Vec<Value> = items.map(|item| (scalar.value(item, self.blocks.big_endian), 0)).collect();
        match values.iter().position(|(x, _)| !x.is_finite()) {
            Some(i) => Err(tag.fault(format!("number {} is not finite", i + 1), "")),
            None => Ok(values),
        }
    }
}

fn appended(tail: &[u8]) -> Result<Option<(&'static str, &[u8])>, ReadError> {
    if tail.is_empty() {
        return Ok(None);
    }
    let bad = |problem: &str| {
        Err(ReadError { part: ".vtu", element: "AppendedData".into(), problem: problem.into(), ..ReadError::default() })
    };
    let Some(end) = tail.iter().position(|&b| b == b'>') else {
        return bad("the file ends within the tag");
    };
    let tag = &tail[..end];
    let says = |word: &[u8]| tag.windows(word.len()).any(|w| w == word);
    let encoding = if says(b"base64") {
        "base64"
    } else if says(b"raw") {
        "raw"
    } else {
        return bad("the encoding is neither raw nor base64");
    };
    match tail[end..].iter().position(|&b| b == b'_') {
        Some(at) => Ok(Some((encoding, &tail[end + at + 1..]))),
        None => bad("the underscore that starts the data is missing"),
    }
}

fn ascii(tag: &Tag) -> Result<Vec<Value>, ReadError> {
    let mut values = Vec::new();
    for (line, row) in tag.text.split('\n').enumerate() {
        let line = tag.text_line.saturating_add(clipped(line));
        for field in row.split_ascii_whitespace() {
            let x = number::finite(field).map_err(|problem| ReadError { line, ..tag.fault(problem, "") })?;
            values.push((x, line));
        }
    }
    Ok(values)
}

fn points(file: &File, mesh: &mut ForeignMesh) -> Result<(), ReadError> {
    let mut flat = Flat::default();
    for (k, p) in file.values("Points", "", 3, Some(file.points))?.chunks_exact(3).enumerate() {
        let &[(x, line), (y, _), (z, _)] = p else {
            continue;
        };
        flat.check(z, line).map_err(|problem| {
            let element = format!("vertex {k}");
            ReadError { part: ".vtu", line, element, problem, fix: FIX.into(), ..ReadError::default() }
        })?;
        mesh.points.push(Point2::new(x, y));
        mesh.lines.points.push(line);
    }
    mesh.notes.extend(flat.note());
    if let Some(markers) = file.perhaps("PointData", "marker", file.points)? {
        mesh.point_markers = markers.into_iter().map(|(x, _)| x as i32).collect();
    }
    let mut columns = Vec::new();
    while let Some(column) = file.perhaps("PointData", &format!("attribute_{}", columns.len()), file.points)? {
        columns.push(column);
        // Honest columns take a byte a number, before they are compressed; appended ones could all name the same bytes.
        if columns.len().saturating_mul(file.points) > file.blocks.most(file.size) {
            return Err(file.piece.fault("the attributes are more than the file can hold", ""));
        }
    }
    mesh.attributes_per_point = columns.len();
    mesh.attributes = (0..file.points).flat_map(|i| columns.iter().map(move |c| c[i].0)).collect();
    Ok(())
}

fn read_cells(file: &File) -> Result<Cells, ReadError> {
    Ok(Cells {
        connectivity: file.values("Cells", "connectivity", 1, None)?,
        offsets: file.values("Cells", "offsets", 1, Some(file.cells))?,
        types: file.values("Cells", "types", 1, Some(file.cells))?,
    })
}

fn cells(file: &File, cells: &Cells, mesh: &mut ForeignMesh) -> Result<(), ReadError> {
    let markers = file.of_cells("marker")?;
    let regions = file.of_cells("region")?;
    let of = |values: &Option<Vec<Value>>, cell: usize| values.as_ref().map(|v| v[cell].0);
    let wanted = "only vertices (1), lines (3) and triangles (5) are read here";
    cells.each(".vtu", file.points, wanted, |cell| {
        match (cell.kind, cell.nodes) {
            (5, &[a, b, c]) => {
                mesh.triangles.push([a, b, c]);
                mesh.lines.triangles.push(cell.line);
                mesh.triangle_attributes.extend(of(&regions, cell.number));
            }
            (3, &[a, b]) => {
                let marker = of(&markers, cell.number).map_or(0, |x| x as i32);
                mesh.edges.push(ForeignEdge { ends: [a, b], marker });
                mesh.lines.edges.push(cell.line);
            }
            (1, [_]) => {}
            _ => return false,
        }
        true
    })
}
