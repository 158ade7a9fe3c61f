//! Reads legacy VTK files (`.vtk`) of unstructured grids, ASCII and binary (VTK file formats, "simple legacy formats"; cells as in versions 1 to 4 and as in 5).
//!
//! Layout: `# vtk DataFile Version x`, a title, `ASCII` or `BINARY`, `DATASET UNSTRUCTURED_GRID`; then `POINTS n type`, `CELLS`, `CELL_TYPES n` and arrays of points
//! and cells. Binary numbers are big-endian. Of the arrays only what our writer gives is taken: `weight` and `marker` of points, `marker` and
//! `region` of cells (`CellEntityIds` of Gmsh stands in for either); the others are passed over.

use super::grid::{Arrays, Cells, STAND_INS, Value, mesh_of_space, weight_array};
use super::number::decimal;
use super::rows::{MOST_ELEMENTS, clipped};
use super::scalar::{Scalar, index};
use super::{Column, ForeignMesh3, ReadError, error::shown, number};

/// Reads a `.vtk` file as a mesh of space; `column` names the array of weights of the points (without it `weight`, if there is one).
///
/// Errors: the first fault; data sets other than unstructured grids and cells other than vertices, lines, triangles and tetrahedra are faults.
pub fn parse_vtk(bytes: &[u8], column: Option<&Column>) -> Result<ForeignMesh3, ReadError> {
    let mut file = File { bytes, at: 0, line: 1, binary: false, element: String::new() };
    file.head()?;
    let weight = weight_array(".vtk", column)?;
    let mut grid = Grid::default();
    while let Some(word) = file.next() {
        match word.to_ascii_uppercase().as_str() {
            "POINTS" if grid.points.is_none() => {
                let count = file.count("the number of points")?;
                let scalar = file.scalar()?;
                grid.points = Some(file.numbers("POINTS", scalar, count, 3)?);
            }
            "CELLS" if grid.cells.is_none() => grid.cells = Some(file.cells()?),
            "CELL_TYPES" if grid.types.is_none() => {
                let count = file.count("the number of types")?;
                grid.types = Some(file.numbers("CELL_TYPES", Scalar::I32, count, 1)?);
            }
            "POINT_DATA" => grid.of_points = Some((true, file.count("the number of points")?)),
            "CELL_DATA" => grid.of_points = Some((false, file.count("the number of cells")?)),
            "METADATA" => file.metadata(),
            "FIELD" => file.field(&mut grid, weight)?,
            other => file.attribute(other, &mut grid, weight)?,
        }
    }
    file.element.clear();
    let missing = |what: &str| file.fault(format!("the file ends before {what}"), "the file is truncated or no mesh");
    let points = grid.points.ok_or_else(|| missing("POINTS"))?;
    let (connectivity, offsets) = grid.cells.ok_or_else(|| missing("CELLS"))?;
    let types = grid.types.ok_or_else(|| missing("CELL_TYPES"))?;
    let (vertices, cells) = (points.len() / 3, offsets.len());
    if types.len() != cells {
        let problem = format!("there are {cells} cells, but {} types", types.len());
        return Err(file.fault(problem, "correct the counts"));
    }
    for (what, array, due) in [
        ("weights", &grid.arrays.weights, vertices),
        ("markers", &grid.arrays.point_markers, vertices),
        ("markers", &grid.arrays.cell_markers, cells),
        ("regions", &grid.arrays.regions, cells),
    ] {
        if let Some(n) = array.as_ref().map(Vec::len).filter(|&n| n != due) {
            return Err(file.fault(format!("there are {n} {what} instead of {due}"), "correct the counts"));
        }
    }
    mesh_of_space(".vtk", &points, &Cells { connectivity, offsets, types }, grid.arrays, column)
}

/// What is read so far.
#[derive(Default)]
struct Grid {
    points: Option<Vec<Value>>,
    /// Connectivity and offsets.
    cells: Option<(Vec<Value>, Vec<Value>)>,
    types: Option<Vec<Value>>,
    /// Whether arrays belong to points or to cells, and of how many.
    of_points: Option<(bool, usize)>,
    arrays: Arrays,
    /// The name that each of the arrays of cells was taken from: marker, region.
    stand_ins: [bool; 2],
}

impl Grid {
    /// Whether an array of one component is wanted, and takes it then.
    fn take(&mut self, name: &str, weight: &str, values: Vec<Value>) {
        match self.of_points {
            Some((true, _)) => {
                if name == weight {
                    self.arrays.weights = Some(values);
                } else if name == "marker" {
                    self.arrays.point_markers = Some(values);
                }
            }
            Some((false, _)) if name == "marker" => {
                (self.arrays.cell_markers, self.stand_ins[0]) = (Some(values), true);
            }
            Some((false, _)) if name == "region" => {
                (self.arrays.regions, self.stand_ins[1]) = (Some(values), true);
            }
            Some((false, _)) if STAND_INS.contains(&name) => {
                if !self.stand_ins[0] {
                    self.arrays.cell_markers = Some(values.clone());
                }
                if !self.stand_ins[1] {
                    self.arrays.regions = Some(values);
                }
            }
            _ => {}
        }
    }

    fn wants(&self, name: &str, weight: &str) -> bool {
        match self.of_points {
            Some((true, _)) => name == weight || name == "marker",
            Some((false, _)) => ["marker", "region"].contains(&name) || STAND_INS.contains(&name),
            None => false,
        }
    }
}

/// A file and how far it is read.
struct File<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The current line; it means nothing once binary numbers are passed.
    line: usize,
    binary: bool,
    /// The section being read, for messages.
    element: String,
}

impl<'a> File<'a> {
    fn fault(&self, problem: impl Into<String>, fix: &str) -> ReadError {
        let line = if self.binary { 0 } else { clipped(self.line) };
        let mut problem = problem.into();
        if self.binary {
            problem += &format!(" (byte {})", self.at);
        }
        ReadError {
            part: ".vtk",
            line,
            element: self.element.clone(),
            problem,
            fix: fix.into(),
            ..ReadError::default()
        }
    }

    /// The rest of the current line, without its end.
    fn whole_line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&b| b == b'\n');
        self.at += end.map_or(rest.len(), |end| end + 1);
        self.line += usize::from(end.is_some());
        rest[..end.unwrap_or(rest.len())].trim_ascii()
    }

    fn head(&mut self) -> Result<(), ReadError> {
        if !self.whole_line().starts_with(b"# vtk DataFile Version") {
            self.line = 1;
            return Err(self
                .fault("the file does not start with `# vtk DataFile Version`", "it is empty or no legacy VTK file"));
        }
        self.whole_line();
        let binary = match self.next().unwrap_or("") {
            word if word.eq_ignore_ascii_case("ascii") => false,
            word if word.eq_ignore_ascii_case("binary") => true,
            other => {
                return Err(self.fault(format!("the encoding is `{}`", shown(other)), "it is ASCII or BINARY"));
            }
        };
        for due in ["DATASET", "UNSTRUCTURED_GRID"] {
            let word = self.next().unwrap_or("");
            if !word.eq_ignore_ascii_case(due) {
                let problem = format!("`{}` stands where {due} is due", shown(word));
                return Err(self.fault(problem, "only unstructured grids are read here"));
            }
        }
        self.binary = binary;
        Ok(())
    }

    /// The next word; nothing at the end. Bytes that are no text are shown as such in the message that follows.
    fn next(&mut self) -> Option<&'a str> {
        while let Some(b) = self.bytes.get(self.at).filter(|b| b.is_ascii_whitespace()) {
            self.line += usize::from(*b == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += end;
        (end > 0).then(|| std::str::from_utf8(&rest[..end]).unwrap_or("\u{fffd}"))
    }

    fn word(&mut self, what: &str) -> Result<&'a str, ReadError> {
        let next = self.next();
        next.ok_or_else(|| self.fault(format!("the file ends before {what}"), "the file is truncated"))
    }

    fn count(&mut self, what: &str) -> Result<usize, ReadError> {
        let word = self.word(what)?;
        let count = word.parse::<u64>().ok().filter(|&n| n <= MOST_ELEMENTS);
        // Below 2^31.
        count.map(|n| n as usize).ok_or_else(|| {
            let fix = format!("it must be a whole number of at most {MOST_ELEMENTS}");
            self.fault(format!("{what} is `{}`", shown(word)), &fix)
        })
    }

    fn scalar(&mut self) -> Result<Scalar, ReadError> {
        let name = self.word("the type of the numbers")?;
        Ok(match name.to_ascii_lowercase().as_str() {
            "char" => Scalar::I8,
            "unsigned_char" => Scalar::U8,
            "short" => Scalar::I16,
            "unsigned_short" => Scalar::U16,
            "int" | "vtkidtype" => Scalar::I32,
            "unsigned_int" => Scalar::U32,
            "long" | "vtktypeint64" => Scalar::I64,
            "unsigned_long" | "vtktypeuint64" => Scalar::U64,
            "float" => Scalar::F32,
            "double" => Scalar::F64,
            _ => {
                return Err(self
                    .fault(format!("the type of the numbers is `{}`", shown(name)), "bits and strings are not read"));
            }
        })
    }

    /// `count` times `per` numbers.
    fn numbers(&mut self, name: &str, scalar: Scalar, count: usize, per: usize) -> Result<Vec<Value>, ReadError> {
        self.element = shown(name);
        let total = self.fits(scalar, count, per)?;
        let mut values = Vec::with_capacity(total);
        if !self.binary {
            for k in 0..total {
                let word = self.word("a number")?;
                let x = number::finite(word).map_err(|problem| {
                    self.fault(format!("number {}: {problem}", k + 1), "write a decimal number such as -1.5e3")
                })?;
                values.push((x, clipped(self.line)));
            }
            return Ok(values);
        }
        let data = self.block(scalar, total);
        values.extend(data.chunks_exact(scalar.size()).map(|item| (scalar.value(item, true), 0)));
        match values.iter().position(|(x, _)| !x.is_finite()) {
            Some(k) => Err(self.fault(format!("number {} is not finite", k + 1), "")),
            None => Ok(values),
        }
    }

    /// The number of numbers, which the rest of the file has room for: two bytes each as text.
    fn fits(&self, scalar: Scalar, count: usize, per: usize) -> Result<usize, ReadError> {
        let left = self.bytes.len() - self.at;
        let size = if self.binary { scalar.size() } else { 2 };
        // In text the last number may lack what separates it from the next.
        let room = left as u128 + u128::from(!self.binary);
        if count as u128 * per as u128 * size as u128 > room {
            let problem = format!("there are to be {count} times {per} numbers, but only {left} bytes follow");
            return Err(self.fault(problem, "correct the count, or the file is truncated"));
        }
        Ok(count * per)
    }

    /// The bytes of numbers that are known to be there, behind one line end.
    fn block(&mut self, scalar: Scalar, total: usize) -> &'a [u8] {
        if self.bytes.get(self.at) == Some(&b'\r') && self.bytes.get(self.at + 1) == Some(&b'\n') {
            self.at += 1;
        }
        self.at = (self.at + 1).min(self.bytes.len());
        let rest = &self.bytes[self.at..];
        let data = &rest[..rest.len().min(total * scalar.size())];
        self.at += data.len();
        data
    }

    /// Passes numbers over.
    fn pass(&mut self, scalar: Scalar, count: usize, per: usize) -> Result<(), ReadError> {
        let total = self.fits(scalar, count, per)?;
        if self.binary {
            self.block(scalar, total);
            return Ok(());
        }
        for _ in 0..total {
            self.word("a number")?;
        }
        Ok(())
    }

    /// Connectivity and offsets: `CELLS n size` and each cell after its number of corners, or `CELLS n size` and the arrays `OFFSETS` (with a zero ahead) and `CONNECTIVITY`.
    fn cells(&mut self) -> Result<(Vec<Value>, Vec<Value>), ReadError> {
        self.element = "CELLS".into();
        let count = self.count("the number of cells")?;
        let size = self.count("the size of the list")?;
        let before = (self.at, self.line);
        if self.next().is_some_and(|word| word.eq_ignore_ascii_case("OFFSETS")) {
            let scalar = self.scalar()?;
            let mut offsets = self.numbers("OFFSETS", scalar, count, 1)?;
            if !offsets.is_empty() {
                offsets.remove(0);
            }
            if !self.word("CONNECTIVITY")?.eq_ignore_ascii_case("CONNECTIVITY") {
                return Err(self.fault("CONNECTIVITY is due here", "correct the number of offsets"));
            }
            let scalar = self.scalar()?;
            return Ok((self.numbers("CONNECTIVITY", scalar, size, 1)?, offsets));
        }
        (self.at, self.line) = before;
        let list = self.numbers("CELLS", Scalar::I32, size, 1)?;
        let mut connectivity = Vec::with_capacity(list.len());
        let mut offsets = Vec::new();
        let mut rest = &list[..];
        while let Some((&(n, line), after)) = rest.split_first() {
            let corners = index(n, after.len() + 1).map(|n| after.split_at(n));
            let (corners, after) = corners.ok_or_else(|| {
                let problem =
                    format!("cell {} has {} corners, which is more than the list holds", offsets.len(), decimal(n));
                let line = if self.binary { 0 } else { line };
                ReadError { line, ..self.fault(problem, "correct the size of the list") }
            })?;
            connectivity.extend_from_slice(corners);
            offsets.push((connectivity.len() as f64, line));
            rest = after;
        }
        if offsets.len() != count {
            let problem = format!("the list holds {} cells instead of {count}", offsets.len());
            return Err(self.fault(problem, "correct the counts"));
        }
        Ok((connectivity, offsets))
    }

    /// Lines up to an empty one.
    fn metadata(&mut self) {
        self.whole_line();
        while self.at < self.bytes.len() && !self.whole_line().is_empty() {}
    }

    /// `FIELD name arrays`, then each `name components tuples type` and its numbers.
    fn field(&mut self, grid: &mut Grid, weight: &str) -> Result<(), ReadError> {
        self.word("the name of the field")?;
        for _ in 0..self.count("the number of arrays")? {
            let mut name = self.word("the name of an array")?;
            if name.eq_ignore_ascii_case("METADATA") {
                self.metadata();
                name = self.word("the name of an array")?;
            }
            self.element = shown(name);
            let per = self.count("the number of components")?;
            let count = self.count("the number of tuples")?;
            let scalar = self.scalar()?;
            self.array(grid, weight, (name, scalar), count, per)?;
        }
        Ok(())
    }

    fn array(
        &mut self,
        grid: &mut Grid,
        weight: &str,
        (name, scalar): (&str, Scalar),
        count: usize,
        per: usize,
    ) -> Result<(), ReadError> {
        if per == 1 && grid.wants(name, weight) {
            let values = self.numbers(name, scalar, count, 1)?;
            grid.take(name, weight, values);
            return Ok(());
        }
        self.pass(scalar, count, per)
    }

    /// One of the attributes that are no field.
    fn attribute(&mut self, keyword: &str, grid: &mut Grid, weight: &str) -> Result<(), ReadError> {
        self.element = shown(keyword);
        let Some((_, count)) = grid.of_points else {
            let problem = format!("`{}` stands where a section is due", shown(keyword));
            return Err(self.fault(problem, "correct the counts of the section before it"));
        };
        let known = ["SCALARS", "LOOKUP_TABLE", "VECTORS", "NORMALS", "TENSORS", "TENSORS6", "TEXTURE_COORDINATES"];
        let known = known.contains(&keyword) || ["COLOR_SCALARS", "GLOBAL_IDS", "PEDIGREE_IDS"].contains(&keyword);
        if !known {
            let problem = format!("`{}` stands where an array is due", shown(keyword));
            return Err(self.fault(problem, "correct the count of the numbers before it"));
        }
        let name = self.word("the name of the array")?;
        // Colours are bytes in binary files, and numbers in text.
        match keyword {
            "LOOKUP_TABLE" => {
                let size = self.count("the size of the table")?;
                self.pass(Scalar::U8, size, 4)
            }
            "COLOR_SCALARS" => {
                let per = self.count("the number of components")?;
                self.pass(Scalar::U8, count, per)
            }
            "TEXTURE_COORDINATES" => {
                let per = self.count("the number of components")?;
                let scalar = self.scalar()?;
                self.pass(scalar, count, per)
            }
            "SCALARS" => {
                let scalar = self.scalar()?;
                let per = self.scalars_head()?;
                self.array(grid, weight, (name, scalar), count, per)
            }
            _ => {
                let scalar = self.scalar()?;
                let per = match keyword {
                    "VECTORS" | "NORMALS" => 3,
                    "TENSORS" => 9,
                    "TENSORS6" => 6,
                    _ => 1,
                };
                self.pass(scalar, count, per)
            }
        }
    }

    /// The components of a scalar array, 1 if not given, and its table of colours, if given.
    fn scalars_head(&mut self) -> Result<usize, ReadError> {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        let per = if rest[..end].trim_ascii().is_empty() { 1 } else { self.count("the number of components")? };
        let before = (self.at, self.line);
        if self.next() == Some("LOOKUP_TABLE") {
            self.word("the name of the table")?;
        } else {
            (self.at, self.line) = before;
        }
        Ok(per)
    }
}
