//! Reads Gmsh's `.msh`, versions 2.2 and 4.1, ASCII (Gmsh reference manual, section "MSH file format").
//!
//! Lines of the file's mesh become constrained edges, their physical tag the marker; the physical tag of a triangle becomes its region
//! attribute. A physical name `marker m` or `region r`, as our writer gives it, takes the place of its tag, and `mesh` is no region. Elements come in ascending order of
//! their tags. Choice 1: sections that say nothing about the mesh are skipped. Choice 2: elements other than points, lines and triangles
//! are refused.

use super::flat::Flat;
use super::foreign::{ForeignEdge, ForeignMesh};
use super::rows::{Element, Row, Rows};
use super::{ReadError, error::shown};
use crate::model::{Point2, VertexId};
use std::collections::BTreeMap;

/// Reads a `.msh` file as a planar mesh.
///
/// Errors: the first fault; binary files, other versions, elements of higher order and vertices off one plane z = constant are faults.
pub fn parse_msh(bytes: &[u8]) -> Result<ForeignMesh, ReadError> {
    // The second line of a binary file is still text; what follows is not, and would be blamed for the wrong reason.
    if let Some(e) = refuse_binary(bytes) {
        return Err(e);
    }
    let mut rows = Rows::new(".msh", bytes)?.without_comments();
    let mut head = rows.expect(Element::The("header"))?;
    if head.word("$MeshFormat")? != "$MeshFormat" {
        return Err(head.fault(
            "the file does not start with $MeshFormat",
            "only Gmsh's .msh is read here; other programs use the same extension",
        ));
    }
    let mut format = rows.expect(Element::The("format"))?;
    let version = match format.word("the version")? {
        "2.2" | "2.1" | "2" => Version::Two,
        "4.1" => Version::Four,
        other => {
            return Err(format.fault(format!("the version is {}", shown(other)), "save it as version 4.1 or 2.2"));
        }
    };
    let mut file = File::new(rows, version);
    file.section_end("MeshFormat")?;
    let mut seen = [false; 2];
    while let Some(mut row) = file.rows.next(Element::The("section")) {
        let name = row.word("a section")?;
        match name.strip_prefix('$') {
            Some("PhysicalNames") => file.names()?,
            Some("Entities") if version == Version::Four => file.entities()?,
            Some("Nodes") if !seen[0] => {
                seen[0] = true;
                file.nodes()?;
            }
            Some("Elements") if seen[0] && !seen[1] => {
                seen[1] = true;
                file.elements()?;
            }
            Some("Nodes" | "Elements") => {
                return Err(
                    row.fault(format!("{name} stands out of order or twice"), "one $Nodes comes before one $Elements")
                );
            }
            Some(other) if !other.starts_with("End") => file.skip(other)?,
            _ => {
                return Err(row.fault(format!("`{}` stands where a section is due", shown(name)), ""));
            }
        }
    }
    if !seen[1] {
        return Err(file.rows.fault(
            Element::The("$Elements"),
            "the file ends before it",
            "the file is truncated or holds no mesh",
        ));
    }
    Ok(file.finish())
}

fn refuse_binary(bytes: &[u8]) -> Option<ReadError> {
    let start = &bytes[..bytes.len().min(64)];
    let mut lines = start.split(|&b| b == b'\n').map(<[u8]>::trim_ascii);
    let binary = lines.next() == Some(b"$MeshFormat") && lines.next()?.split(|&b| b == b' ').nth(1) == Some(b"1");
    binary.then(|| ReadError {
        part: ".msh",
        line: 2,
        element: "format".into(),
        problem: "the encoding is binary".into(),
        fix: "save it as ASCII".into(),
        ..ReadError::default()
    })
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Version {
    Two,
    Four,
}

/// A file being read.
struct File<'a> {
    rows: Rows<'a>,
    version: Version,
    mesh: ForeignMesh,
    flat: Flat,
    /// Names of physical groups, by dimension and tag.
    names: BTreeMap<(i64, i64), &'a str>,
    /// First physical group of an entity, by dimension and tag (version 4).
    physical: BTreeMap<(i64, i64), i64>,
    /// Vertices by tag, sorted.
    ids: Vec<(i64, VertexId)>,
    lines: Vec<Item<2>>,
    triangles: Vec<Item<3>>,
}

/// A line or a triangle.
struct Item<const N: usize> {
    tag: i64,
    physical: i64,
    corners: [VertexId; N],
    line: u32,
}

impl<'a> File<'a> {
    fn new(rows: Rows<'a>, version: Version) -> File<'a> {
        File {
            rows,
            version,
            mesh: ForeignMesh::default(),
            flat: Flat::default(),
            names: BTreeMap::new(),
            physical: BTreeMap::new(),
            ids: Vec::new(),
            lines: Vec::new(),
            triangles: Vec::new(),
        }
    }

    fn section_end(&mut self, name: &str) -> Result<(), ReadError> {
        let row = self.rows.expect(Element::The("end of the section"))?;
        let due = format!("$End{name}");
        if row.remainder() == due {
            return Ok(());
        }
        Err(row.fault(
            format!("`{}` stands where {due} is due", shown(row.remainder())),
            "correct the count of the section",
        ))
    }

    fn skip(&mut self, name: &str) -> Result<(), ReadError> {
        let due = format!("$End{name}");
        while self.rows.expect(Element::The("end of a section"))?.remainder() != due {}
        Ok(())
    }

    fn names(&mut self) -> Result<(), ReadError> {
        let mut head = self.rows.expect(Element::The("number of names"))?;
        let count = head.count("the number of names", 7, &self.rows)?;
        for k in 0..count as u64 {
            let mut row = self.rows.expect(Element::Nth("physical name", k + 1))?;
            let key = (row.integer("the dimension")?, row.integer("the tag")?);
            self.names.insert(key, row.remainder().trim_matches('"'));
        }
        self.section_end("PhysicalNames")
    }

    /// Version 4: which physical groups the entities are in. Points, curves, surfaces and volumes, in this order.
    fn entities(&mut self) -> Result<(), ReadError> {
        let mut head = self.rows.expect(Element::The("numbers of entities"))?;
        for dimension in 0..4 {
            let count = head.count("a number of entities", 10, &self.rows)?;
            for k in 0..count as u64 {
                let mut row = self.rows.expect(Element::Nth("entity", k + 1))?;
                let tag = row.integer("the tag")?;
                for _ in 0..(if dimension == 0 { 3 } else { 6 }) {
                    row.float("a bound")?;
                }
                if row.integer("the number of physical groups")? > 0 {
                    self.physical.insert((dimension, tag), row.integer("a physical group")?);
                }
            }
        }
        self.section_end("Entities")
    }

    fn nodes(&mut self) -> Result<(), ReadError> {
        let mut head = self.rows.expect(Element::The("numbers of nodes"))?;
        match self.version {
            Version::Two => {
                let count = head.count("the number of nodes", 8, &self.rows)?;
                for k in 0..count as u64 {
                    let mut row = self.rows.expect(Element::Nth("node", k + 1))?;
                    let tag = row.integer("the tag")?;
                    self.node(tag, &mut row)?;
                    row.end()?;
                }
            }
            Version::Four => {
                let blocks = head.count("the number of blocks", 8, &self.rows)?;
                let total = head.count("the number of nodes", 8, &self.rows)?;
                let mut sum = 0;
                for b in 0..blocks as u64 {
                    let mut block = self.rows.expect(Element::Nth("block of nodes", b + 1))?;
                    block.integer("the dimension")?;
                    block.integer("the entity")?;
                    block.integer("parametric")?;
                    let count = block.count("the number of nodes", 8, &self.rows)?;
                    sum += count;
                    let mut tags = Vec::with_capacity(count);
                    for k in 0..count as u64 {
                        tags.push(self.rows.expect(Element::Nth("tag of node", k + 1))?.integer("the tag")?);
                    }
                    for tag in tags {
                        // Tags are not negative, see `node`; parameters may follow the coordinates.
                        let mut row = self.rows.expect(Element::Nth("node", tag.max(0) as u64))?;
                        self.node(tag, &mut row)?;
                    }
                }
                equal_totals(&head, total, sum)?;
            }
        }
        self.ids.sort_unstable();
        if let Some(pair) = self.ids.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let node = Element::Nth("node", pair[0].0 as u64);
            return Err(self.rows.fault(node, "two nodes up to this line have this tag", "give every node its own"));
        }
        self.section_end("Nodes")
    }

    fn node(&mut self, tag: i64, row: &mut Row) -> Result<(), ReadError> {
        if tag <= 0 {
            return Err(row.fault(format!("the tag of the node is {tag}"), "tags are positive"));
        }
        // Fewer nodes than bytes, and `count` keeps each block below 2^31; a file with more blocks is refused here.
        let id = u32::try_from(self.mesh.points.len()).map_err(|_| row.fault("too many nodes", ""))?;
        self.ids.push((tag, VertexId(id)));
        self.mesh.points.push(Point2::new(row.float("x")?, row.float("y")?));
        self.mesh.lines.points.push(row.line);
        self.flat.z(row)
    }

    fn elements(&mut self) -> Result<(), ReadError> {
        let mut head = self.rows.expect(Element::The("numbers of elements"))?;
        match self.version {
            Version::Two => {
                let count = head.count("the number of elements", 10, &self.rows)?;
                for k in 0..count as u64 {
                    let mut row = self.rows.expect(Element::Nth("element", k + 1))?;
                    let (tag, kind) = (row.integer("the tag")?, row.integer("the type")?);
                    let mut physical = 0;
                    for i in 0..row.ranged("the number of tags", 0, 1_000_000)? {
                        let t = row.integer("a tag")?;
                        physical = if i == 0 { t } else { physical };
                    }
                    self.element(tag, kind, physical, row)?;
                }
            }
            Version::Four => {
                let blocks = head.count("the number of blocks", 8, &self.rows)?;
                let total = head.count("the number of elements", 4, &self.rows)?;
                let mut sum = 0;
                for b in 0..blocks as u64 {
                    let mut block = self.rows.expect(Element::Nth("block of elements", b + 1))?;
                    let entity = (block.integer("the dimension")?, block.integer("the entity")?);
                    let kind = block.integer("the type")?;
                    let count = block.count("the number of elements", 4, &self.rows)?;
                    sum += count;
                    let physical = self.physical.get(&entity).copied().unwrap_or(0);
                    for k in 0..count as u64 {
                        let mut row = self.rows.expect(Element::Nth("element", k + 1))?;
                        let tag = row.integer("the tag")?;
                        self.element(tag, kind, physical, row)?;
                    }
                }
                equal_totals(&head, total, sum)?;
            }
        }
        self.section_end("Elements")
    }

    fn element(&mut self, tag: i64, kind: i64, physical: i64, mut row: Row) -> Result<(), ReadError> {
        let line = row.line;
        match kind {
            1 => {
                let corners = [self.id(&mut row)?, self.id(&mut row)?];
                self.lines.push(Item { tag, physical, corners, line });
            }
            2 => {
                let corners = [self.id(&mut row)?, self.id(&mut row)?, self.id(&mut row)?];
                self.triangles.push(Item { tag, physical, corners, line });
            }
            15 => {
                self.id(&mut row)?;
            }
            _ => {
                return Err(row.fault(
                    format!("the type of the element is {kind}"),
                    "only points (15), lines (1) and triangles (2) are read here",
                ));
            }
        }
        row.end()
    }

    fn id(&self, row: &mut Row) -> Result<VertexId, ReadError> {
        let tag = row.integer("a node")?;
        let at = self.ids.binary_search_by_key(&tag, |&(t, _)| t);
        at.map(|i| self.ids[i].1)
            .map_err(|_| row.fault(format!("there is no node {tag}"), "correct the element or add the node"))
    }

    /// The number that stands for a physical group: in its name if our writer gave it, else its tag.
    fn value(&self, dimension: i64, prefix: &str, tag: i64) -> f64 {
        let name = self.names.get(&(dimension, tag)).and_then(|name| name.strip_prefix(prefix));
        name.and_then(|number| super::number::finite(number).ok()).unwrap_or(tag as f64)
    }

    fn finish(mut self) -> ForeignMesh {
        self.lines.sort_by_key(|item| item.tag);
        self.triangles.sort_by_key(|item| item.tag);
        let mut mesh = std::mem::take(&mut self.mesh);
        mesh.notes.extend(self.flat.note());
        for item in &self.lines {
            // A float-to-integer cast saturates; physical tags and markers have 32 bits in any case.
            let marker = self.value(1, "marker ", item.physical) as i32;
            mesh.edges.push(ForeignEdge { ends: item.corners, marker });
            mesh.lines.edges.push(item.line);
        }
        let mesh_only = |tag| self.names.get(&(2, tag)) == Some(&"mesh");
        let regions = self.triangles.iter().any(|item| item.physical != 0 && !mesh_only(item.physical));
        for item in &self.triangles {
            mesh.triangles.push(item.corners);
            mesh.lines.triangles.push(item.line);
            if regions {
                mesh.triangle_attributes.push(self.value(2, "region ", item.physical));
            }
        }
        mesh
    }
}

/// That the blocks of a section hold as many elements as its first row says.
fn equal_totals(head: &Row, total: usize, sum: usize) -> Result<(), ReadError> {
    if total == sum {
        return Ok(());
    }
    let problem = format!("the total is {total}, but the blocks hold {sum}");
    Err(head.fault(problem, "correct it; perhaps a part is missing"))
}
