//! Writes Gmsh's `.msh`, versions 4.1 and 2.2, ASCII: all vertices, then the elements in ascending order of their dimension: in the plane the subsegments as
//! lines and the triangles; in space lines, triangles and tetrahedra, and the weights of the vertices as a view `weight`.
//!
//! Markers and regions are physical groups. A marker or attribute that is a whole number from 1 is the group's tag; another one gets the next
//! free tag. The group's name, `marker m` or `region r`, holds the number itself in either case. Triangles of the plane or tetrahedra without attribute are the group
//! `mesh`: every element is in a group, since Gmsh drops the others when it saves and meshio refuses a file with both. Each group is one
//! entity of the file. Element tags follow the order of the mesh, dimension by dimension.

use super::points::place;
use super::{end, field, float, text};
use crate::io::ForeignMesh3;
use crate::io::number::push_float;
use crate::model::{Mesh2, Point3, VertexId};
use std::collections::BTreeMap;

/// The layout of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MshVersion {
    /// 2.2, the one that most other programs read.
    V22,
    /// 4.1, Gmsh's own since 2019.
    V41,
}

/// The mesh as a `.msh` file.
pub fn msh(mesh: &Mesh2, version: MshVersion) -> Vec<u8> {
    let points: Vec<Point3> = mesh.points.iter().map(|p| p.extend(0.0)).collect();
    let markers = mesh.edges.iter().map(|e| f64::from(e.marker));
    let elements = [
        Elements::new(1, mesh.edges.iter().map(|e| &e.ends[..]), Groups::new("marker", markers)),
        Elements::new(
            2,
            mesh.triangles.iter().map(|t| &t[..]),
            Groups::regions(&mesh.triangle_attributes, mesh.triangles.len()),
        ),
    ];
    file(&points, &elements, version)
}

/// The mesh of space as a `.msh` file.
pub fn msh3(mesh: &ForeignMesh3, version: MshVersion) -> Vec<u8> {
    let edges = Groups::new("marker", mesh.edges.iter().map(|e| f64::from(e.marker)));
    let triangles = Groups::new("marker", mesh.triangles.iter().map(|t| f64::from(t.marker)));
    let elements = [
        Elements::new(1, mesh.edges.iter().map(|e| &e.ends[..]), edges),
        Elements::new(2, mesh.triangles.iter().map(|t| &t.corners[..]), triangles),
        Elements::new(
            3,
            mesh.tetrahedra.iter().map(|t| &t[..]),
            Groups::regions(&mesh.tetrahedron_attributes, mesh.tetrahedra.len()),
        ),
    ];
    let mut out = file(&mesh.points, &elements, version);
    if !mesh.weights.is_empty() {
        // One name, one time (0.0), and step 0, one component, so many nodes.
        text(&mut out, "$NodeData\n1\n\"weight\"\n1\n0\n3\n0\n1\n");
        end(field(&mut out, mesh.weights.len()));
        for (i, &w) in mesh.weights.iter().enumerate() {
            end(float(field(&mut out, i + 1), w));
        }
        text(&mut out, "$EndNodeData\n");
    }
    out
}

fn file(points: &[Point3], elements: &[Elements], version: MshVersion) -> Vec<u8> {
    let mut out = Vec::new();
    let number = if version == MshVersion::V41 { "4.1" } else { "2.2" };
    text(&mut out, &format!("$MeshFormat\n{number} 0 8\n$EndMeshFormat\n"));
    names(&mut out, elements);
    match version {
        MshVersion::V41 => {
            entities(&mut out, points, elements);
            nodes_41(&mut out, points, elements);
            elements_41(&mut out, elements);
        }
        MshVersion::V22 => {
            nodes_22(&mut out, points);
            elements_22(&mut out, elements);
        }
    }
    out
}

/// The elements of one dimension.
struct Elements<'a> {
    dimension: u8,
    corners: Vec<&'a [VertexId]>,
    groups: Groups,
}

impl<'a> Elements<'a> {
    fn new(dimension: u8, corners: impl Iterator<Item = &'a [VertexId]>, groups: Groups) -> Elements<'a> {
        Elements { dimension, corners: corners.collect(), groups }
    }

    /// Gmsh's number of the type.
    fn kind(&self) -> u8 {
        // Lines are 1, triangles 2, tetrahedra 4.
        1 << (self.dimension - 1)
    }
}

/// The physical groups of one dimension.
struct Groups {
    /// Name by tag; tags are positive.
    names: BTreeMap<i32, String>,
    /// Tag of each element in order.
    tags: Vec<i32>,
}

impl Groups {
    /// The elements by their region attributes; without any, all are in the group `mesh`.
    fn regions(attributes: &[f64], elements: usize) -> Groups {
        if !attributes.is_empty() {
            return Groups::new("region", attributes.iter().copied());
        }
        let names = if elements == 0 { BTreeMap::new() } else { BTreeMap::from([(1, "mesh".to_string())]) };
        Groups { names, tags: vec![1; elements] }
    }

    /// The elements by their numbers.
    fn new(name: &str, numbers: impl Iterator<Item = f64> + Clone) -> Groups {
        let whole = |x: f64| Some(x as i32).filter(|&t| t > 0 && f64::from(t).to_bits() == x.to_bits());
        let named = |x: f64| {
            let mut text = format!("{name} ").into_bytes();
            push_float(&mut text, x);
            String::from_utf8_lossy(&text).into_owned()
        };
        let mut tags: BTreeMap<u64, i32> = BTreeMap::new();
        let mut names = BTreeMap::new();
        for x in numbers.clone() {
            if let Some(tag) = whole(x) {
                tags.insert(x.to_bits(), tag);
                names.entry(tag).or_insert_with(|| named(x));
            }
        }
        let mut next = 1;
        for x in numbers.clone() {
            tags.entry(x.to_bits()).or_insert_with(|| {
                // There are fewer groups than elements, so that a free tag exists.
                while names.contains_key(&next) {
                    next += 1;
                }
                names.insert(next, named(x));
                next
            });
        }
        let tags = numbers.map(|x| tags[&x.to_bits()]).collect();
        Groups { names, tags }
    }
}

fn names(out: &mut Vec<u8>, elements: &[Elements]) {
    text(out, "$PhysicalNames\n");
    end(field(out, elements.iter().map(|e| e.groups.names.len()).sum::<usize>()));
    for e in elements {
        for (tag, name) in &e.groups.names {
            field(field(out, e.dimension), tag);
            text(out, &format!(" \"{name}\"\n"));
        }
    }
    text(out, "$EndPhysicalNames\n");
}

/// One entity per group, with its group's tag and the bounding box of the mesh for its own.
fn entities(out: &mut Vec<u8>, points: &[Point3], elements: &[Elements]) {
    text(out, "$Entities\n");
    let count = |dimension: u8| elements.iter().find(|e| e.dimension == dimension).map_or(0, |e| e.groups.names.len());
    end((0..4).fold(&mut *out, |out, dimension| field(out, count(dimension))));
    let low = points.iter().copied().reduce(Point3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(Point3::max).unwrap_or_default();
    for e in elements {
        for tag in e.groups.names.keys() {
            place(place(field(out, tag), &low), &high);
            end(field(field(field(out, 1), tag), 0));
        }
    }
    text(out, "$EndEntities\n");
}

fn nodes_41(out: &mut Vec<u8>, points: &[Point3], elements: &[Elements]) {
    let n = points.len();
    text(out, "$Nodes\n");
    end(field(field(field(field(out, 1), n), n.min(1)), n));
    // All nodes are ascribed to the first entity of the highest dimension of the file.
    let last = elements.iter().rev().find_map(|e| Some((e.dimension, *e.groups.names.keys().next()?)));
    let (dimension, entity) = last.unwrap_or((0, 1));
    end(field(field(field(field(out, dimension), entity), 0), n));
    for i in 1..=n {
        end(field(out, i));
    }
    for p in points {
        end(place(out, p));
    }
    text(out, "$EndNodes\n");
}

fn elements_41(out: &mut Vec<u8>, elements: &[Elements]) {
    // Blocks by dimension and entity, elements within in order.
    let mut blocks: BTreeMap<(usize, i32), Vec<usize>> = BTreeMap::new();
    let mut before = vec![0];
    for (d, e) in elements.iter().enumerate() {
        for (i, &tag) in e.groups.tags.iter().enumerate() {
            blocks.entry((d, tag)).or_default().push(i);
        }
        before.push(before[d] + e.corners.len());
    }
    let total = before[elements.len()];
    text(out, "$Elements\n");
    end(field(field(field(field(out, blocks.len()), total), total.min(1)), total));
    for ((d, entity), members) in blocks {
        let e = &elements[d];
        end(field(field(field(field(out, e.dimension), entity), e.kind()), members.len()));
        for i in members {
            field(out, before[d] + i + 1);
            for VertexId(v) in e.corners[i] {
                field(out, v + 1);
            }
            end(out);
        }
    }
    text(out, "$EndElements\n");
}

fn nodes_22(out: &mut Vec<u8>, points: &[Point3]) {
    text(out, "$Nodes\n");
    end(field(out, points.len()));
    for (i, p) in points.iter().enumerate() {
        end(place(field(out, i + 1), p));
    }
    text(out, "$EndNodes\n");
}

fn elements_22(out: &mut Vec<u8>, elements: &[Elements]) {
    text(out, "$Elements\n");
    end(field(out, elements.iter().map(|e| e.corners.len()).sum::<usize>()));
    let mut number = 0;
    for e in elements {
        for (corners, tag) in e.corners.iter().zip(&e.groups.tags) {
            number += 1;
            field(field(field(field(field(out, number), e.kind()), 2), tag), tag);
            for VertexId(v) in *corners {
                field(out, v + 1);
            }
            end(out);
        }
    }
    text(out, "$EndElements\n");
}
