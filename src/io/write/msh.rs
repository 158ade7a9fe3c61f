//! Writes Gmsh's `.msh`, versions 4.1 and 2.2, ASCII: all vertices, the subsegments as lines, the triangles.
//!
//! Markers and regions are physical groups. A marker or attribute that is a whole number from 1 is the group's tag; another one gets the next
//! free tag. The group's name, `marker m` or `region r`, holds the number itself in either case. Triangles without attribute are the group
//! `mesh`: every element is in a group, since Gmsh drops the others when it saves and meshio refuses a file with both. Each group is one
//! entity of the file. Element tags follow the order of the mesh: subsegments, then triangles.

use super::{end, field, float, text};
use crate::io::number::push_float;
use crate::model::{Mesh2, Point2, VertexId};
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
    let mut out = Vec::new();
    let markers = mesh.edges.iter().map(|e| f64::from(e.marker));
    let groups = [
        Groups::new("marker", 1, markers),
        if mesh.triangle_attributes.is_empty() {
            Groups::one("mesh", 2, mesh.triangles.len())
        } else {
            Groups::new("region", 2, mesh.triangle_attributes.iter().copied())
        },
    ];
    let number = if version == MshVersion::V41 { "4.1" } else { "2.2" };
    text(&mut out, &format!("$MeshFormat\n{number} 0 8\n$EndMeshFormat\n"));
    names(&mut out, &groups);
    match version {
        MshVersion::V41 => {
            entities(&mut out, mesh, &groups);
            nodes_41(&mut out, mesh, groups[1].names.keys().next().copied());
            elements_41(&mut out, mesh, &groups);
        }
        MshVersion::V22 => {
            nodes_22(&mut out, mesh);
            elements_22(&mut out, mesh, &groups);
        }
    }
    out
}

/// The physical groups of one dimension.
struct Groups {
    dimension: u8,
    /// Name by tag; tags are positive.
    names: BTreeMap<i32, String>,
    /// Tag of each element in order.
    tags: Vec<i32>,
}

impl Groups {
    /// All elements in one group.
    fn one(name: &str, dimension: u8, elements: usize) -> Groups {
        let names = if elements == 0 { BTreeMap::new() } else { BTreeMap::from([(1, name.to_string())]) };
        Groups { dimension, names, tags: vec![1; elements] }
    }

    /// The elements by their numbers.
    fn new(name: &str, dimension: u8, numbers: impl Iterator<Item = f64> + Clone) -> Groups {
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
        Groups { dimension, names, tags }
    }
}

fn names(out: &mut Vec<u8>, groups: &[Groups; 2]) {
    text(out, "$PhysicalNames\n");
    end(field(out, groups[0].names.len() + groups[1].names.len()));
    for g in groups {
        for (tag, name) in &g.names {
            field(field(out, g.dimension), tag);
            text(out, &format!(" \"{name}\"\n"));
        }
    }
    text(out, "$EndPhysicalNames\n");
}

/// One entity per group, with its group's tag and the bounding box of the mesh for its own.
fn entities(out: &mut Vec<u8>, mesh: &Mesh2, groups: &[Groups; 2]) {
    text(out, "$Entities\n");
    end(field(field(field(field(out, 0), groups[0].names.len()), groups[1].names.len()), 0));
    let low = mesh.points.iter().copied().reduce(Point2::min).unwrap_or_default();
    let high = mesh.points.iter().copied().reduce(Point2::max).unwrap_or_default();
    for g in groups {
        for tag in g.names.keys() {
            field(out, tag);
            for p in [low, high] {
                field(float(float(out, p.x), p.y), 0);
            }
            end(field(field(field(out, 1), tag), 0));
        }
    }
    text(out, "$EndEntities\n");
}

fn nodes_41(out: &mut Vec<u8>, mesh: &Mesh2, surface: Option<i32>) {
    let n = mesh.points.len();
    text(out, "$Nodes\n");
    end(field(field(field(field(out, 1), n), n.min(1)), n));
    // All nodes are ascribed to the first surface of the file.
    let (dimension, entity) = surface.map_or((0, 1), |tag| (2, tag));
    end(field(field(field(field(out, dimension), entity), 0), n));
    for i in 1..=n {
        end(field(out, i));
    }
    for p in &mesh.points {
        end(field(float(float(out, p.x), p.y), 0));
    }
    text(out, "$EndNodes\n");
}

fn elements_41(out: &mut Vec<u8>, mesh: &Mesh2, groups: &[Groups; 2]) {
    // Blocks by dimension and entity, elements within in order.
    let mut blocks: BTreeMap<(u8, i32), Vec<usize>> = BTreeMap::new();
    for (g, count) in groups.iter().zip([mesh.edges.len(), mesh.triangles.len()]) {
        for i in 0..count {
            blocks.entry((g.dimension, g.tags[i])).or_default().push(i);
        }
    }
    let total = mesh.edges.len() + mesh.triangles.len();
    text(out, "$Elements\n");
    end(field(field(field(field(out, blocks.len()), total), total.min(1)), total));
    for ((dimension, entity), elements) in blocks {
        // Gmsh's numbers of the two element types are their dimensions.
        end(field(field(field(field(out, dimension), entity), dimension), elements.len()));
        for i in elements {
            let (tag, corners) = element(mesh, dimension, i);
            field(out, tag);
            for VertexId(v) in corners {
                field(out, v + 1);
            }
            end(out);
        }
    }
    text(out, "$EndElements\n");
}

/// Tag and corners of the i-th element of a dimension.
fn element(mesh: &Mesh2, dimension: u8, i: usize) -> (usize, &[VertexId]) {
    if dimension == 1 { (i + 1, &mesh.edges[i].ends) } else { (mesh.edges.len() + i + 1, &mesh.triangles[i]) }
}

fn nodes_22(out: &mut Vec<u8>, mesh: &Mesh2) {
    text(out, "$Nodes\n");
    end(field(out, mesh.points.len()));
    for (i, p) in mesh.points.iter().enumerate() {
        end(field(float(float(field(out, i + 1), p.x), p.y), 0));
    }
    text(out, "$EndNodes\n");
}

fn elements_22(out: &mut Vec<u8>, mesh: &Mesh2, groups: &[Groups; 2]) {
    text(out, "$Elements\n");
    end(field(out, mesh.edges.len() + mesh.triangles.len()));
    for (g, count) in groups.iter().zip([mesh.edges.len(), mesh.triangles.len()]) {
        for i in 0..count {
            let (tag, corners) = element(mesh, g.dimension, i);
            field(field(field(field(field(out, tag), g.dimension), 2), g.tags[i]), g.tags[i]);
            for VertexId(v) in corners {
                field(out, v + 1);
            }
            end(out);
        }
    }
    text(out, "$EndElements\n");
}
