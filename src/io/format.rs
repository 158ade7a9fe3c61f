//! Formats by the extension of a file's name, and what each of them can hold.

use super::{ForeignMesh, Input, ReadError, TriangleFiles, write};
use super::{parse_geojson, parse_msh, parse_node, parse_node_ele, parse_off, parse_poly, parse_vtu, parse_wkt};
use crate::model::{Mesh2, Pslg};
use std::path::Path;

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// Triangle's planar straight line graphs, or the subsegments of a mesh.
    Poly,
    /// Triangle's vertices.
    Node,
    /// Triangle's triangles.
    Ele,
    /// Triangle's edges.
    Edge,
    /// Well-known text.
    Wkt,
    /// GeoJSON.
    GeoJson,
    /// Object File Format.
    Off,
    /// VTK XML unstructured grid.
    Vtu,
    /// Gmsh; written as 4.1, read as 4.1 or 2.2.
    Msh,
    /// Gmsh, written as 2.2.
    Msh2,
    /// A picture.
    Svg,
}

/// Every format with its extensions, the usual one first.
const EXTENSIONS: [(Format, &[&str]); 11] = [
    (Format::Poly, &["poly"]),
    (Format::Node, &["node"]),
    (Format::Ele, &["ele"]),
    (Format::Edge, &["edge"]),
    (Format::Wkt, &["wkt"]),
    (Format::GeoJson, &["geojson", "json"]),
    (Format::Off, &["off"]),
    (Format::Vtu, &["vtu"]),
    (Format::Msh, &["msh", "msh4"]),
    (Format::Msh2, &["msh2"]),
    (Format::Svg, &["svg"]),
];

impl Format {
    /// The format of a file by its extension, whatever its case.
    pub fn of(path: &Path) -> Option<Format> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        EXTENSIONS.iter().find(|(_, names)| names.contains(&extension.as_str())).map(|&(format, _)| format)
    }

    /// The usual extension, without the dot.
    pub fn extension(self) -> &'static str {
        EXTENSIONS.iter().find(|(f, _)| *f == self).map_or("", |(_, names)| names[0])
    }

    /// Whether planar straight line graphs (or points) are read from it.
    pub fn reads_pslg(self) -> bool {
        matches!(self, Format::Poly | Format::Node | Format::Wkt | Format::GeoJson)
    }

    /// Whether meshes are read from it. `.node`, `.ele`, `.poly` and `.edge` name a mesh together.
    pub fn reads_mesh(self) -> bool {
        matches!(
            self,
            Format::Poly
                | Format::Node
                | Format::Ele
                | Format::Edge
                | Format::Off
                | Format::Vtu
                | Format::Msh
                | Format::Msh2
        )
    }

    /// The files that a mesh in this format consists of, by format; empty if the format holds no mesh.
    ///
    /// Vertices, triangles and subsegments of Triangle stand in files of their own, so that `.node` alone would be no mesh.
    pub fn files_of_mesh(self) -> &'static [Format] {
        match self {
            Format::Node | Format::Ele => &[Format::Node, Format::Ele],
            Format::Poly => &[Format::Node, Format::Ele, Format::Poly],
            Format::Edge => &[Format::Node, Format::Ele, Format::Edge],
            Format::Off => &[Format::Off],
            Format::Vtu => &[Format::Vtu],
            Format::Msh => &[Format::Msh],
            Format::Msh2 => &[Format::Msh2],
            Format::Svg => &[Format::Svg],
            Format::Wkt | Format::GeoJson => &[],
        }
    }
}

/// The bytes of one file of a mesh; nothing if the format holds no mesh. Holes and regions of the domain go into `.poly`.
pub fn write_mesh(mesh: &Mesh2, format: Format, domain: Option<&Pslg>) -> Option<Vec<u8>> {
    Some(match format {
        Format::Node => write::triangle::node(mesh),
        Format::Ele => write::triangle::ele(mesh),
        Format::Poly => write::triangle::poly(mesh, domain),
        Format::Edge => write::triangle::edge(mesh),
        Format::Off => write::off(mesh),
        Format::Vtu => write::vtu(mesh),
        Format::Msh => write::msh(mesh, write::MshVersion::V41),
        Format::Msh2 => write::msh(mesh, write::MshVersion::V22),
        Format::Svg => write::svg(mesh),
        Format::Wkt | Format::GeoJson => return None,
    })
}

/// Reads a planar straight line graph.
///
/// `companion(format)` gives the bytes of the file of the same name in another format, if it exists; it is asked only for what is needed
/// (the `.node` of a `.poly` without vertices). Result: nothing if the format holds no graph.
pub fn read_pslg(
    format: Format,
    bytes: &[u8],
    mut companion: impl FnMut(Format) -> Option<Vec<u8>>,
) -> Option<Result<Input, ReadError>> {
    Some(match format {
        Format::Poly if super::poly_wants_node(bytes) => parse_poly(bytes, companion(Format::Node).as_deref()),
        Format::Poly => parse_poly(bytes, None),
        Format::Node => parse_node(bytes),
        Format::Wkt => parse_wkt(bytes),
        Format::GeoJson => parse_geojson(bytes),
        _ => return None,
    })
}

/// Reads a mesh.
///
/// `companion` as for `read_pslg`: the other files of a mesh of Triangle. Result: nothing if the format holds no mesh.
pub fn read_mesh(
    format: Format,
    bytes: &[u8],
    mut companion: impl FnMut(Format) -> Option<Vec<u8>>,
) -> Option<Result<ForeignMesh, ReadError>> {
    Some(match format {
        Format::Poly | Format::Node | Format::Ele | Format::Edge => {
            let mut part = |f: Format| {
                if f == format { Some(bytes.to_vec()) } else { companion(f) }
            };
            let (node, ele) = (part(Format::Node), part(Format::Ele));
            let (poly, edge) = (part(Format::Poly), part(Format::Edge));
            match (node, ele) {
                (Some(node), Some(ele)) => parse_node_ele(TriangleFiles {
                    node: &node,
                    ele: &ele,
                    poly: poly.as_deref(),
                    edge: edge.as_deref(),
                }),
                (node, _) => Err(ReadError {
                    part: if node.is_none() { ".node" } else { ".ele" },
                    problem: "the file is missing".into(),
                    fix: "a mesh of Triangle is a .node and an .ele file of the same name".into(),
                    ..ReadError::default()
                }),
            }
        }
        Format::Off => parse_off(bytes),
        Format::Vtu => parse_vtu(bytes),
        Format::Msh | Format::Msh2 => parse_msh(bytes),
        _ => return None,
    })
}
