//! Formats by the extension of a file's name, and what each of them can hold.

use super::msh::parse_any_msh;
use super::triangle::node_is_spatial;
use super::vtu::parse_any_vtu;
use super::{Column, ForeignMesh, ForeignMesh3, Input, Input3, ReadError, TetgenFiles, TriangleFiles, write};
use super::{parse_csv, parse_medit, parse_msh3, parse_node3, parse_npy, parse_off3, parse_ply, parse_tetgen};
use super::{parse_geojson, parse_msh, parse_node, parse_node_ele, parse_off, parse_poly, parse_vtu, parse_wkt};
use super::{parse_vtk, parse_vtu3, parse_xyz};
use crate::model::{Mesh2, PointSet3, Pslg, Triangulation3};
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
    /// TetGen's triangles in space.
    Face,
    /// Points of space, white space between.
    Xyz,
    /// Points of space, with commas, semicolons or tabs.
    Csv,
    /// NumPy arrays of points.
    Npy,
    /// Stanford polygons, of which the vertices are read.
    Ply,
    /// Medit, text.
    Medit,
    /// Legacy VTK.
    Vtk,
    /// A picture.
    Svg,
}

/// Every format with its extensions, the usual one first.
const EXTENSIONS: [(Format, &[&str]); 18] = [
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
    (Format::Face, &["face"]),
    (Format::Xyz, &["xyz"]),
    (Format::Csv, &["csv", "tsv"]),
    (Format::Npy, &["npy"]),
    (Format::Ply, &["ply"]),
    (Format::Medit, &["mesh"]),
    (Format::Vtk, &["vtk"]),
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

    /// Whether points of space are read from it.
    pub fn reads_points3(self) -> bool {
        matches!(self, Format::Node | Format::Xyz | Format::Off | Format::Ply | Format::Csv | Format::Npy)
    }

    /// Whether planar meshes are read from it. `.node`, `.ele`, `.poly` and `.edge` name a mesh together.
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

    /// Whether meshes of space are read from it. `.node`, `.ele`, `.face` and `.edge` name a mesh together.
    pub fn reads_mesh3(self) -> bool {
        matches!(
            self,
            Format::Node
                | Format::Ele
                | Format::Face
                | Format::Edge
                | Format::Medit
                | Format::Vtk
                | Format::Vtu
                | Format::Msh
                | Format::Msh2
        )
    }

    /// Whether points of space are written to it.
    pub fn holds_points3(self) -> bool {
        self.reads_points3()
    }

    /// Whether points written to it lose their weights.
    pub fn loses_weights(self) -> bool {
        matches!(self, Format::Medit | Format::Off)
    }

    /// The files that a mesh of space in this format consists of, by format, itself among them; empty if the format holds no such mesh. `.face` and `.edge`
    /// stand beside `.ele` only where there are triangles or edges, and `.ele` only where there are tetrahedra or neither of them.
    pub fn files_of_mesh3(self, mesh: &ForeignMesh3) -> Vec<Format> {
        match self {
            Format::Node | Format::Ele | Format::Face | Format::Edge => {
                let (faces, edges) = (!mesh.triangles.is_empty(), !mesh.edges.is_empty());
                let mut files = vec![Format::Node];
                let cells = !mesh.tetrahedra.is_empty() || !(faces || edges);
                files.extend((cells || self == Format::Ele).then_some(Format::Ele));
                files.extend((faces || self == Format::Face).then_some(Format::Face));
                files.extend((edges || self == Format::Edge).then_some(Format::Edge));
                files
            }
            Format::Medit | Format::Msh | Format::Msh2 | Format::Vtu | Format::Vtk | Format::Off => vec![self],
            _ => Vec::new(),
        }
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
            _ => &[],
        }
    }
}

/// The bytes of points of space as a file; nothing if the format holds none. `.off` has no place for weights, and only `.node`, `.csv` and `.ply` have one for markers.
pub fn write_points3(set: &PointSet3, format: Format) -> Option<Vec<u8>> {
    Some(match format {
        Format::Node => write::points::node3(set),
        Format::Xyz => write::points::xyz(set),
        Format::Csv => write::points::csv(set),
        Format::Npy => write::points::npy(set),
        Format::Ply => write::points::ply(set),
        Format::Off => write::points::off3(&set.points, [].iter()),
        _ => return None,
    })
}

/// The bytes of one file of a mesh of space; nothing if the format holds none.
///
/// `.off` and `.face` hold triangles only: those of the mesh, or the boundary of its tetrahedra if it lists none. `.mesh` has no place for weights, `.off` for nothing but coordinates and triangles.
pub fn write_mesh3(mesh: &ForeignMesh3, format: Format) -> Option<Vec<u8>> {
    Some(match format {
        Format::Node => write::points::node3(&mesh.point_set()),
        Format::Ele => write::tetgen::ele3(mesh),
        Format::Face if mesh.triangles.is_empty() => write::tetgen::face(&mesh.boundary(), |_| 0),
        Format::Face => {
            let corners: Vec<_> = mesh.triangles.iter().map(|t| t.corners).collect();
            write::tetgen::face(&corners, |i| mesh.triangles[i].marker)
        }
        Format::Edge => write::tetgen::edge3(mesh),
        Format::Medit => write::medit(mesh),
        Format::Msh => write::msh3(mesh, write::MshVersion::V41),
        Format::Msh2 => write::msh3(mesh, write::MshVersion::V22),
        Format::Vtu => write::vtu3(mesh),
        Format::Vtk => write::vtk(mesh),
        Format::Off if mesh.triangles.is_empty() => write::points::off3(&mesh.points, mesh.boundary().iter()),
        Format::Off => write::points::off3(&mesh.points, mesh.triangles.iter().map(|t| &t.corners)),
        _ => return None,
    })
}

/// The bytes of one file of a triangulation of points in space: its simplices as elements of their dimension, as `write_mesh3` writes them.
///
/// The convex hull is what `.off` shows of tetrahedra. Which points are hidden or duplicates is not told: no simplex has them.
pub fn write_triangulation3(triangulation: &Triangulation3, format: Format) -> Option<Vec<u8>> {
    write_mesh3(&ForeignMesh3::from(triangulation), format)
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
        _ => return None,
    })
}

/// The dimension of the points of a file for `triangulate`: by the format, and of `.node` by its header.
///
/// Formats of graphs hold points of the plane; `.xyz`, `.off`, `.ply`, `.csv` and `.npy` hold points of space, whatever their z. A damaged `.node` file is planar,
/// and its reader will tell the fault. Result: nothing if the format holds no points.
pub fn point_dimension(format: Format, bytes: &[u8]) -> Option<u8> {
    match format {
        Format::Node => Some(if node_is_spatial(bytes) { 3 } else { 2 }),
        _ if format.reads_pslg() => Some(2),
        _ if format.reads_points3() => Some(3),
        _ => None,
    }
}

/// Reads points of space; `column` says where their weights stand, if they have any.
///
/// Result: nothing if the format holds no points of space.
pub fn read_points3(format: Format, bytes: &[u8], column: Option<&Column>) -> Option<Result<Input3, ReadError>> {
    Some(match format {
        Format::Node => parse_node3(bytes, column),
        Format::Xyz => parse_xyz(bytes, column),
        Format::Off => parse_off3(bytes, column),
        Format::Ply => parse_ply(bytes, column),
        Format::Csv => parse_csv(bytes, column),
        Format::Npy => parse_npy(bytes, column),
        _ => return None,
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

/// A mesh of the plane or of space.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyMesh {
    /// Triangles in the plane.
    Plane(ForeignMesh),
    /// Tetrahedra, or simplices of lower dimension in space.
    Space(ForeignMesh3),
}

/// Reads a mesh of space.
///
/// `column` names the weights: a column of `.node`, or an array of the points elsewhere, where an array `weight` is taken without being asked for. `companion` as for
/// `read_pslg`: the other files of a mesh of TetGen. Result: nothing if the format holds no such mesh.
pub fn read_mesh3(
    format: Format,
    bytes: &[u8],
    column: Option<&Column>,
    mut companion: impl FnMut(Format) -> Option<Vec<u8>>,
) -> Option<Result<ForeignMesh3, ReadError>> {
    Some(match format {
        Format::Node | Format::Ele | Format::Face | Format::Edge => {
            let mut part = |f: Format| {
                if f == format { Some(bytes.to_vec()) } else { companion(f) }
            };
            let [node, ele, face, edge] = [Format::Node, Format::Ele, Format::Face, Format::Edge].map(&mut part);
            let missing = |part: &'static str| {
                Err(ReadError {
                    part,
                    problem: "the file is missing".into(),
                    fix: "a mesh of TetGen is a .node and an .ele file of the same name (.face or .edge if it has no tetrahedra)".into(),
                    ..ReadError::default()
                })
            };
            match node {
                None => missing(".node"),
                Some(_) if ele.is_none() && face.is_none() && edge.is_none() => missing(".ele"),
                Some(node) => {
                    let files =
                        TetgenFiles { node: &node, ele: ele.as_deref(), face: face.as_deref(), edge: edge.as_deref() };
                    parse_tetgen(files, column)
                }
            }
        }
        Format::Medit => match column {
            None => parse_medit(bytes),
            Some(_) => Err(ReadError {
                part: ".mesh",
                problem: "the format has no weights".into(),
                fix: "use .vtu, .vtk, .msh or .node for weighted points".into(),
                ..ReadError::default()
            }),
        },
        Format::Vtk => parse_vtk(bytes, column),
        Format::Vtu => parse_vtu3(bytes, column),
        Format::Msh | Format::Msh2 => parse_msh3(bytes, column),
        _ => return None,
    })
}

/// Reads a mesh of either dimension, which the file tells: `.node` by its header; `.off` is planar; `.mesh` and `.vtk` are of space; `.msh` and `.vtu` are of
/// space if they hold a tetrahedron, or if `column` is given, and planar otherwise. Arguments as for `read_mesh3`.
pub fn read_any_mesh(
    format: Format,
    bytes: &[u8],
    column: Option<&Column>,
    mut companion: impl FnMut(Format) -> Option<Vec<u8>>,
) -> Option<Result<AnyMesh, ReadError>> {
    let spatial = match format {
        Format::Vtu => return Some(parse_any_vtu(bytes, column)),
        Format::Msh | Format::Msh2 => return Some(parse_any_msh(bytes, column)),
        Format::Node => node_is_spatial(bytes),
        Format::Ele | Format::Edge | Format::Face => companion(Format::Node).is_some_and(|node| node_is_spatial(&node)),
        _ => !format.reads_mesh(),
    };
    if spatial {
        return read_mesh3(format, bytes, column, companion).map(|read| read.map(AnyMesh::Space));
    }
    read_mesh(format, bytes, companion).map(|read| read.map(AnyMesh::Plane))
}
