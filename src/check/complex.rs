//! The checker's own triangle complex: flat arrays, links by index, no maps.
//!
//! A half-edge is `4 * triangle + k`: from corner k to corner k + 1 of a counterclockwise triangle. Slots of destroyed
//! triangles are used again, so the arrays stay as long as the largest mesh was.

use super::predicates::Corners;
use crate::model::{Point2, Triangle, VertexId};

/// No half-edge, no segment, no label.
pub const NONE: u32 = u32::MAX;

/// What a vertex is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A vertex of the input.
    Input,
    /// Type-A.
    Free,
    /// Type-B, on the input segment of this number.
    B(u32),
    /// Type-C, on the input segment of this number.
    C(u32),
    /// A free vertex that was deleted.
    Deleted,
}

/// A vertex. Records of deleted vertices stay.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// Scaled coordinates.
    pub at: Point2,
    /// What it is.
    pub kind: Kind,
    /// The vertex at distance R, frozen at insertion; the vertex itself if it sees none (R infinite).
    pub nearest: u32,
    /// A half-edge from it, or `NONE`.
    star: u32,
}

impl Vertex {
    /// Whether it is free and not deleted.
    pub fn is_free(&self) -> bool {
        self.kind == Kind::Free
    }

    /// The input segment it lies on.
    pub fn segment(&self) -> Option<u32> {
        match self.kind {
            Kind::B(s) | Kind::C(s) => Some(s),
            _ => None,
        }
    }
}

/// What stands in a triangle's slot.
#[derive(Clone, Copy, Debug)]
struct Slot {
    corner: [u32; 3],
    /// The half-edge on the other side of each edge.
    beyond: [u32; 3],
    /// The input segment of each edge.
    segment: [u32; 3],
}

/// Facts of a triangle besides its place.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// 0 at the start, else 1 + the number of the event that created it.
    pub birth: u32,
    /// Region seed that labels it.
    pub region: u32,
    /// Not in the region: it takes no part, but keeps the stars of its vertices together.
    pub outside: bool,
    /// Skipped as skinny.
    pub skipped_skinny: bool,
    /// Skipped as oversized.
    pub skipped_oversized: bool,
}

/// A planar triangulation with marks on its constrained edges.
#[derive(Clone, Debug, Default)]
pub struct Complex {
    /// Every vertex ever.
    pub vertices: Vec<Vertex>,
    slots: Vec<Slot>,
    facts: Vec<Facts>,
    vacant: Vec<u32>,
}

/// The next half-edge of the same triangle, counterclockwise.
pub fn next(e: u32) -> u32 {
    if e & 3 == 2 { e - 2 } else { e + 1 }
}

/// The half-edge before.
pub fn previous(e: u32) -> u32 {
    if e & 3 == 0 { e + 2 } else { e - 1 }
}

/// The triangle of a half-edge.
pub fn triangle_of(e: u32) -> u32 {
    e >> 2
}

/// The smallest corner first, orientation kept.
pub fn canonical([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The ids of a triangle as plain numbers.
pub fn numbers(t: Triangle) -> [u32; 3] {
    t.map(|VertexId(v)| v)
}

impl Complex {
    /// Adds a vertex that is in no triangle yet.
    pub fn add_vertex(&mut self, at: Point2, kind: Kind) -> u32 {
        // Ids fit: a trace of 2^32 vertices is refused by the caller.
        let id = self.vertices.len() as u32;
        self.vertices.push(Vertex { at, kind, nearest: id, star: NONE });
        id
    }

    /// Adds a triangle without links.
    pub fn add(&mut self, corner: [u32; 3], facts: Facts) -> u32 {
        let slot = Slot { corner, beyond: [NONE; 3], segment: [NONE; 3] };
        let t = match self.vacant.pop() {
            Some(t) => {
                self.slots[t as usize] = slot;
                self.facts[t as usize] = facts;
                t
            }
            None => {
                self.slots.push(slot);
                self.facts.push(facts);
                (self.slots.len() - 1) as u32
            }
        };
        for k in 0..3 {
            self.vertices[corner[k as usize] as usize].star = 4 * t + k;
        }
        t
    }

    /// Frees a slot. Each of its corners that stays must be a corner of a triangle added before anybody asks for its star.
    pub fn drop(&mut self, t: u32) {
        self.slots[t as usize].corner = [NONE; 3];
        self.vacant.push(t);
    }

    /// Joins two half-edges (or a half-edge to nothing) and gives both the segment's mark.
    pub fn join(&mut self, e: u32, other: u32, segment: u32) {
        for (e, other) in [(e, other), (other, e)] {
            if e != NONE {
                let slot = &mut self.slots[triangle_of(e) as usize];
                slot.beyond[(e & 3) as usize] = other;
                slot.segment[(e & 3) as usize] = segment;
            }
        }
    }

    /// Whether the slot holds a triangle.
    pub fn lives(&self, t: u32) -> bool {
        self.slots.get(t as usize).is_some_and(|s| s.corner[0] != NONE)
    }

    /// All triangles of the region.
    pub fn triangles(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.slots.len() as u32).filter(|&t| self.lives(t) && !self.facts(t).outside)
    }

    /// The triangle at a half-edge, if there is one in the region.
    pub fn inside(&self, e: u32) -> Option<u32> {
        (e != NONE && !self.facts(triangle_of(e)).outside).then(|| triangle_of(e))
    }

    /// Number of slots, a bound of every triangle's index.
    pub fn slot_count(&self) -> usize {
        self.slots.len()
    }

    /// Corner ids of a triangle, counterclockwise.
    pub fn corners(&self, t: u32) -> [u32; 3] {
        self.slots[t as usize].corner
    }

    /// Corner coordinates.
    pub fn places(&self, t: u32) -> Corners {
        self.corners(t).map(|v| self.at(v))
    }

    /// Coordinates of a vertex.
    pub fn at(&self, v: u32) -> Point2 {
        self.vertices[v as usize].at
    }

    /// Facts of a triangle.
    pub fn facts(&self, t: u32) -> &Facts {
        &self.facts[t as usize]
    }

    /// Facts of a triangle, to be changed.
    pub fn facts_mut(&mut self, t: u32) -> &mut Facts {
        &mut self.facts[t as usize]
    }

    /// Where a half-edge starts.
    pub fn origin(&self, e: u32) -> u32 {
        self.slots[triangle_of(e) as usize].corner[(e & 3) as usize]
    }

    /// Where it ends.
    pub fn target(&self, e: u32) -> u32 {
        self.origin(next(e))
    }

    /// The corner across.
    pub fn apex(&self, e: u32) -> u32 {
        self.origin(previous(e))
    }

    /// The half-edge on the other side, or `NONE`.
    pub fn beyond(&self, e: u32) -> u32 {
        self.slots[triangle_of(e) as usize].beyond[(e & 3) as usize]
    }

    /// The input segment of an edge, or `NONE`.
    pub fn segment(&self, e: u32) -> u32 {
        self.slots[triangle_of(e) as usize].segment[(e & 3) as usize]
    }

    /// The first half-edge from v, clockwise as far as the star goes, or `NONE`.
    pub fn first_from(&self, v: u32) -> u32 {
        let start = self.vertices.get(v as usize).map_or(NONE, |v| v.star);
        let mut e = start;
        while e != NONE {
            match self.beyond(e) {
                NONE => break,
                other => e = next(other),
            }
            if e == start {
                break;
            }
        }
        e
    }

    /// The half-edges from v, counterclockwise; a border ends them.
    pub fn star(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.first_from(v);
        let mut e = first;
        std::iter::from_fn(move || {
            if e == NONE {
                return None;
            }
            let this = e;
            let turned = self.beyond(previous(e));
            e = if turned == first { NONE } else { turned };
            Some(this)
        })
    }

    /// The half-edge from u to v, if some triangle has it on its boundary in this direction.
    pub fn find_edge(&self, u: u32, v: u32) -> Option<u32> {
        let start = self.vertices.get(u as usize)?.star;
        let mut e = start;
        while e != NONE {
            if self.target(e) == v {
                return Some(e);
            }
            e = self.beyond(previous(e));
            if e == start {
                return None;
            }
        }
        // A border was met: the rest of the star lies clockwise of the start.
        self.star(u).find(|&e| self.target(e) == v)
    }

    /// The triangle with these corners, counterclockwise.
    pub fn find_triangle(&self, [a, b, c]: [u32; 3]) -> Option<u32> {
        let e = self.find_edge(a, b)?;
        (self.apex(e) == c).then(|| triangle_of(e))
    }

    /// Marks a vertex as deleted; its triangles are gone.
    pub fn delete_vertex(&mut self, v: u32) {
        self.vertices[v as usize].kind = Kind::Deleted;
        self.vertices[v as usize].star = NONE;
    }
}
