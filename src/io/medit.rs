//! Reads Medit's `.mesh`, ASCII, of dimension 3 (P. Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253; the keywords of libMeshb).
//!
//! Layout: words between white space, `#` comments; a keyword, mostly a count, then that many rows of numbers. Read are `Vertices` (`x y z reference`),
//! `Edges`, `Triangles`, `Tetrahedra` (corners from 1, reference) and their kinds of second order (`EdgesP2`, ...); a reference is a marker, of a tetrahedron its region.
//! Where all references of a kind are 0 there are none. Choice 1: elements of other shapes are refused, unless there are none of them. Choice 2: other keywords (corners,
//! ridges, normals, ...) say nothing about the mesh, and are passed over with the numbers that follow them. The binary form (`.meshb`) is not read.

use super::rows::{Element, Rows, Tokens};
use super::{ForeignEdge, ForeignMesh3, ForeignTriangle, ReadError, error::shown};
use crate::model::{Point3, VertexId};

/// Reads a `.mesh` file as a mesh of space.
///
/// Errors: the first fault.
pub fn parse_medit(bytes: &[u8]) -> Result<ForeignMesh3, ReadError> {
    let mut file = File {
        tokens: Tokens::new(Rows::new(".mesh", bytes)?),
        mesh: ForeignMesh3::default(),
        middle: Vec::new(),
        seen: Vec::new(),
    };
    let first = file.tokens.word("MeshVersionFormatted")?;
    if first != "MeshVersionFormatted" {
        let problem = format!("the file starts with `{}`", shown(first));
        return Err(file.tokens.fault(&problem, "it must start with MeshVersionFormatted; binary files are not read"));
    }
    file.tokens.ranged("the version", 1, 4)?;
    while !file.tokens.at_end() {
        file.tokens.element = Element::The("keyword");
        let keyword = file.tokens.word("a keyword")?;
        if keyword == "End" {
            break;
        }
        file.section(keyword)?;
    }
    if !file.seen.contains(&"Vertices") {
        let fix = "the file is truncated or holds no mesh";
        return Err(file.tokens.fault("the file ends before the keyword Vertices", fix));
    }
    let mut mesh = file.mesh;
    if mesh.point_markers.iter().all(|&m| m == 0) {
        mesh.point_markers.clear();
    }
    if mesh.tetrahedron_attributes.iter().all(|a| a.to_bits() == 0) {
        mesh.tetrahedron_attributes.clear();
    }
    mesh.drop_middle_nodes(&file.middle);
    Ok(mesh)
}

/// A file being read.
struct File<'a> {
    tokens: Tokens<'a>,
    mesh: ForeignMesh3,
    /// Nodes between corners.
    middle: Vec<VertexId>,
    /// Keywords that may stand only once and have.
    seen: Vec<&'a str>,
}

impl<'a> File<'a> {
    fn section(&mut self, keyword: &'a str) -> Result<(), ReadError> {
        match keyword {
            "Dimension" => {
                self.tokens.ranged("the dimension", 3, 3)?;
            }
            "Vertices" | "Edges" | "EdgesP2" | "Triangles" | "TrianglesP2" | "Tetrahedra" | "TetrahedraP2" => {
                if self.seen.contains(&keyword) {
                    return Err(self.tokens.fault(&format!("a second {keyword}"), "put them all under one"));
                }
                self.seen.push(keyword);
                // A vertex is `0 0 0 0`, a line `1 2 0`, with what separates it from the next.
                let count = self.tokens.count("their number", if keyword == "Vertices" { 8 } else { 6 })?;
                self.elements(keyword, count)?;
            }
            "Quadrilaterals" | "Hexahedra" | "Prisms" | "Pyramids" | "QuadrilateralsQ2" | "HexahedraQ2" => {
                if self.tokens.count("their number", 0)? > 0 {
                    let fix = "only edges, triangles and tetrahedra are read here";
                    return Err(self.tokens.fault(&format!("there are {keyword}"), fix));
                }
            }
            other if other.starts_with(|c: char| c.is_ascii_alphabetic()) => self.pass_over()?,
            other => {
                let problem = format!("`{}` stands where a keyword is due", shown(other));
                return Err(self.tokens.fault(&problem, "correct the count of the elements before it"));
            }
        }
        Ok(())
    }

    fn elements(&mut self, keyword: &str, count: usize) -> Result<(), ReadError> {
        for k in 1..=count as u64 {
            match keyword {
                "Vertices" => {
                    let t = &mut self.tokens;
                    t.element = Element::Nth("vertex", k);
                    let p = Point3::new(t.float("x")?, t.float("y")?, t.float("z")?);
                    self.mesh.lines.points.push(t.line());
                    self.mesh.point_markers.push(t.marker()?);
                    self.mesh.points.push(p);
                }
                "Edges" | "EdgesP2" => {
                    self.tokens.element = Element::Nth("edge", k);
                    let (ends, line) = (self.corners()?, self.tokens.line());
                    if keyword == "EdgesP2" {
                        self.between::<1>()?;
                    }
                    let marker = self.tokens.marker()?;
                    self.mesh.edges.push(ForeignEdge { ends, marker });
                    self.mesh.lines.edges.push(line);
                }
                "Triangles" | "TrianglesP2" => {
                    self.tokens.element = Element::Nth("triangle", k);
                    let (corners, line) = (self.corners()?, self.tokens.line());
                    if keyword == "TrianglesP2" {
                        self.between::<3>()?;
                    }
                    let marker = self.tokens.marker()?;
                    self.mesh.triangles.push(ForeignTriangle { corners, marker });
                    self.mesh.lines.triangles.push(line);
                }
                _ => {
                    self.tokens.element = Element::Nth("tetrahedron", k);
                    let (corners, line) = (self.corners()?, self.tokens.line());
                    if keyword == "TetrahedraP2" {
                        self.between::<6>()?;
                    }
                    self.mesh.tetrahedron_attributes.push(f64::from(self.tokens.marker()?));
                    self.mesh.tetrahedra.push(corners);
                    self.mesh.lines.tetrahedra.push(line);
                }
            }
        }
        Ok(())
    }

    fn corners<const N: usize>(&mut self) -> Result<[VertexId; N], ReadError> {
        let mut ids = [VertexId(0); N];
        for id in &mut ids {
            let n = self.tokens.ranged("a corner", 1, self.mesh.points.len() as i64)?;
            // At most the number of points, which is below 2^31.
            *id = VertexId((n - 1) as u32);
        }
        Ok(ids)
    }

    fn between<const N: usize>(&mut self) -> Result<(), ReadError> {
        let ids = self.corners::<N>()?;
        self.middle.extend(ids);
        Ok(())
    }

    /// Goes past all that is not a word.
    fn pass_over(&mut self) -> Result<(), ReadError> {
        while self.tokens.peek().is_some_and(|field| !field.starts_with(|c: char| c.is_ascii_alphabetic())) {
            self.tokens.word("a number")?;
        }
        Ok(())
    }
}
