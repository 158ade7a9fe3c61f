//! Reads Gmsh's `.msh`, versions 2.2 and 4.1, ASCII and (by way of `msh_binary`) binary (Gmsh reference manual, section "MSH file format"), as a mesh of the plane or of space.
//!
//! In the plane, lines become constrained edges, their physical tag the marker; the physical tag of a triangle becomes its region
//! attribute. In space, lines and triangles carry markers and tetrahedra regions. A physical name `marker m` or `region r`, as our writers give it, takes
//! the place of its tag, and `mesh` is no region. Elements come in ascending order of their tags.
//! Choice 1: sections that say nothing about the mesh are skipped; of `$NodeData` only weights are taken. Choice 2: other elements than points, lines, triangles
//! and (in space) tetrahedra are refused, of those of second order the corners are taken (in space).

use super::flat::{FIX, Flat};
use super::foreign::{ForeignEdge, ForeignMesh};
use super::grid::{Value, take_weights, weight_array};
use super::msh_binary::Text;
use super::rows::{Element, Row, Rows};
use super::{AnyMesh, Column, ForeignMesh3, ForeignTriangle, ReadError, error::shown};
use crate::model::{Point3, VertexId};
use std::collections::BTreeMap;

/// Reads a `.msh` file as a planar mesh.
///
/// Errors: the first fault; other versions, elements of higher order and vertices off one plane z = constant are faults.
pub fn parse_msh(bytes: &[u8]) -> Result<ForeignMesh, ReadError> {
    read(&Text::of(bytes)?, "", Want::Plane)?.into_plane()
}

/// Reads a `.msh` file as a mesh of space; `column` names the view of weights of the nodes (without it `weight`, if there is one).
///
/// Errors: the first fault; other versions and elements other than points, lines, triangles and tetrahedra are faults.
pub fn parse_msh3(bytes: &[u8], column: Option<&Column>) -> Result<ForeignMesh3, ReadError> {
    read(&Text::of(bytes)?, weight_array(".msh", column)?, Want::Space)?.into_space(column)
}

/// Reads a `.msh` file as a mesh of space if it has a tetrahedron or weights are asked for, and as a planar one otherwise.
pub(super) fn parse_any_msh(bytes: &[u8], column: Option<&Column>) -> Result<AnyMesh, ReadError> {
    let text = Text::of(bytes)?;
    let file = read(&text, weight_array(".msh", column)?, Want::Space)?;
    if !file.tetrahedra.is_empty() || column.is_some() {
        return file.into_space(column).map(AnyMesh::Space);
    }
    if file.second_order {
        // Refused there, with its place.
        return read(&text, "", Want::Plane)?.into_plane().map(AnyMesh::Plane);
    }
    file.into_plane().map(AnyMesh::Plane)
}

/// Which elements are taken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Want {
    Plane,
    Space,
}

/// Reads a file; `weights` is the name of the view that holds them.
fn read<'a>(text: &'a Text, weights: &str, want: Want) -> Result<File<'a>, ReadError> {
    let mut rows = text.rows()?;
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
    let mut file = File::new(rows, version, want);
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
            Some("NodeData") if seen[0] => file.node_data(weights)?,
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
    Ok(file)
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
    want: Want,
    points: Vec<Point3>,
    point_lines: Vec<u32>,
    /// Names of physical groups, by dimension and tag.
    names: BTreeMap<(i64, i64), &'a str>,
    /// First physical group of an entity, by dimension and tag (version 4).
    physical: BTreeMap<(i64, i64), i64>,
    /// Vertices by tag, sorted.
    ids: Vec<(i64, VertexId)>,
    lines: Vec<Item<2>>,
    triangles: Vec<Item<3>>,
    tetrahedra: Vec<Item<4>>,
    /// Nodes between corners, and whether there are any.
    middle: Vec<VertexId>,
    second_order: bool,
    /// Weights by vertex, as far as given.
    weights: Option<Vec<Value>>,
}

/// A line or a triangle.
struct Item<const N: usize> {
    tag: i64,
    physical: i64,
    corners: [VertexId; N],
    line: u32,
}

impl<'a> File<'a> {
    fn new(rows: Rows<'a>, version: Version, want: Want) -> File<'a> {
        File {
            rows,
            version,
            want,
            points: Vec::new(),
            point_lines: Vec::new(),
            names: BTreeMap::new(),
            physical: BTreeMap::new(),
            ids: Vec::new(),
            lines: Vec::new(),
            triangles: Vec::new(),
            tetrahedra: Vec::new(),
            middle: Vec::new(),
            second_order: false,
            weights: None,
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
        let id = u32::try_from(self.points.len()).map_err(|_| row.fault("too many nodes", ""))?;
        self.ids.push((tag, VertexId(id)));
        self.points.push(Point3::new(row.float("x")?, row.float("y")?, row.float("z")?));
        self.point_lines.push(row.line);
        Ok(())
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
                let corners = self.corners(&mut row)?;
                self.lines.push(Item { tag, physical, corners, line });
            }
            2 => {
                let corners = self.corners(&mut row)?;
                self.triangles.push(Item { tag, physical, corners, line });
            }
            15 => {
                self.id(&mut row)?;
            }
            _ if self.want == Want::Plane => {
                return Err(row.fault(type_named(kind), "only points (15), lines (1) and triangles (2) are read here"));
            }
            8 => {
                let corners = self.corners(&mut row)?;
                self.lines.push(Item { tag, physical, corners, line });
                self.between::<1>(&mut row)?;
            }
            9 => {
                let corners = self.corners(&mut row)?;
                self.triangles.push(Item { tag, physical, corners, line });
                self.between::<3>(&mut row)?;
            }
            4 | 11 => {
                let corners = self.corners(&mut row)?;
                self.tetrahedra.push(Item { tag, physical, corners, line });
                if kind == 11 {
                    self.between::<6>(&mut row)?;
                }
            }
            _ => {
                return Err(row.fault(
                    type_named(kind),
                    "only points (15), lines (1, 8), triangles (2, 9) and tetrahedra (4, 11) are read here",
                ));
            }
        }
        row.end()
    }

    fn corners<const N: usize>(&self, row: &mut Row) -> Result<[VertexId; N], ReadError> {
        let mut ids = [VertexId(0); N];
        for id in &mut ids {
            *id = self.id(row)?;
        }
        Ok(ids)
    }

    fn between<const N: usize>(&mut self, row: &mut Row) -> Result<(), ReadError> {
        let ids = self.corners::<N>(row)?;
        self.middle.extend(ids);
        self.second_order = true;
        Ok(())
    }

    fn id(&self, row: &mut Row) -> Result<VertexId, ReadError> {
        let tag = row.integer("a node")?;
        let at = |i: usize| self.ids.get(i).filter(|(t, _)| *t == tag);
        // Mostly the tags are consecutive.
        let first = self.ids.first().map_or(0, |&(first, _)| first);
        let near = usize::try_from(tag.saturating_sub(first)).ok().and_then(at);
        let found = near.or_else(|| self.ids.binary_search_by_key(&tag, |&(t, _)| t).ok().and_then(at));
        found
            .map(|&(_, id)| id)
            .ok_or_else(|| row.fault(format!("there is no node {tag}"), "correct the element or add the node"))
    }

    /// A view of the nodes: string, real and integer tags, each after its number, of which the first string is the name and the second and third
    /// integers are the numbers of components and of nodes; then `node value...`.
    fn node_data(&mut self, weights: &str) -> Result<(), ReadError> {
        let mut name = "";
        let mut integers = [0i64; 3];
        for (k, what) in ["string tags", "real tags", "integer tags"].into_iter().enumerate() {
            let mut head = self.rows.expect(Element::The(what))?;
            let count = head.count("their number", 2, &self.rows)?;
            for i in 0..count {
                let mut row = self.rows.expect(Element::The(what))?;
                match (k, integers.get_mut(i)) {
                    (0, _) if i == 0 => name = row.remainder().trim_matches('"'),
                    (2, Some(integer)) => *integer = row.integer("an integer tag")?,
                    _ => {}
                }
            }
        }
        if name != weights || integers[1] != 1 {
            return self.skip("NodeData");
        }
        if self.weights.is_some() {
            let problem = "a second view of this name";
            return Err(self.rows.fault(Element::The("weights"), problem, "keep one of them"));
        }
        let mut given: Vec<Option<Value>> = vec![None; self.points.len()];
        for _ in 0..integers[2] {
            let mut row = self.rows.expect(Element::The("weights"))?;
            let id = self.id(&mut row)?;
            given[id.index()] = Some((row.float("the weight")?, row.line));
            row.end()?;
        }
        let found: Option<Vec<Value>> = given.iter().copied().collect();
        if found.is_none() {
            let problem = format!("only {} of {} nodes have one", given.iter().flatten().count(), given.len());
            return Err(self.rows.fault(Element::The("weights"), &problem, "give every node its weight"));
        }
        self.weights = found;
        self.section_end("NodeData")
    }

    /// The number that stands for a physical group: in its name if our writer gave it, else its tag.
    fn value(&self, dimension: i64, prefix: &str, tag: i64) -> f64 {
        let name = self.names.get(&(dimension, tag)).and_then(|name| name.strip_prefix(prefix));
        name.and_then(|number| super::number::finite(number).ok()).unwrap_or(tag as f64)
    }

    fn edges(&mut self) -> (Vec<ForeignEdge>, Vec<u32>) {
        self.lines.sort_by_key(|item| item.tag);
        let edge = |item: &Item<2>| {
            // A float-to-integer cast saturates; physical tags and markers have 32 bits in any case.
            let marker = self.value(1, "marker ", item.physical) as i32;
            (ForeignEdge { ends: item.corners, marker }, item.line)
        };
        self.lines.iter().map(edge).unzip()
    }

    /// The region attributes of the elements of a dimension, given their physical tags; none if all are in no group or in `mesh`.
    fn regions(&self, dimension: i64, physical: impl Iterator<Item = i64> + Clone) -> Vec<f64> {
        let mesh_only = |tag| self.names.get(&(dimension, tag)) == Some(&"mesh");
        if physical.clone().all(|tag| tag == 0 || mesh_only(tag)) {
            return Vec::new();
        }
        physical.map(|tag| self.value(dimension, "region ", tag)).collect()
    }

    /// The tag of a vertex.
    fn tag(&self, id: usize) -> i64 {
        self.ids.iter().find(|(_, v)| v.index() == id).map_or(0, |&(tag, _)| tag)
    }

    fn into_plane(mut self) -> Result<ForeignMesh, ReadError> {
        let mut mesh = ForeignMesh::default();
        let mut flat = Flat::default();
        for (id, (p, &line)) in self.points.iter().zip(&self.point_lines).enumerate() {
            flat.check(p.z, line).map_err(|problem| {
                let element = format!("node {}", self.tag(id));
                ReadError { part: ".msh", line, element, problem, fix: FIX.into(), ..ReadError::default() }
            })?;
            mesh.points.push(p.truncate());
        }
        mesh.notes.extend(flat.note());
        (mesh.edges, mesh.lines.edges) = self.edges();
        self.triangles.sort_by_key(|item| item.tag);
        mesh.triangle_attributes = self.regions(2, self.triangles.iter().map(|item| item.physical));
        (mesh.triangles, mesh.lines.triangles) = self.triangles.iter().map(|item| (item.corners, item.line)).unzip();
        mesh.lines.points = self.point_lines;
        Ok(mesh)
    }

    fn into_space(mut self, column: Option<&Column>) -> Result<ForeignMesh3, ReadError> {
        let mut mesh = ForeignMesh3::default();
        take_weights(".msh", self.weights.take(), column, &mut mesh)?;
        (mesh.edges, mesh.lines.edges) = self.edges();
        self.triangles.sort_by_key(|item| item.tag);
        let triangle = |item: &Item<3>| {
            let marker = self.value(2, "marker ", item.physical) as i32;
            (ForeignTriangle { corners: item.corners, marker }, item.line)
        };
        (mesh.triangles, mesh.lines.triangles) = self.triangles.iter().map(triangle).unzip();
        self.tetrahedra.sort_by_key(|item| item.tag);
        mesh.tetrahedron_attributes = self.regions(3, self.tetrahedra.iter().map(|item| item.physical));
        (mesh.tetrahedra, mesh.lines.tetrahedra) = self.tetrahedra.iter().map(|item| (item.corners, item.line)).unzip();
        mesh.points = self.points;
        mesh.lines.points = self.point_lines;
        mesh.drop_middle_nodes(&self.middle);
        Ok(mesh)
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

/// What an element that is not read here is, for messages.
pub(super) fn type_named(kind: i64) -> String {
    match kind {
        3 => "it is a quadrilateral".into(),
        5 => "it is a hexahedron".into(),
        6 => "it is a prism".into(),
        7 => "it is a pyramid".into(),
        _ => format!("the type of the element is {kind}"),
    }
}
