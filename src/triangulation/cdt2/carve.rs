//! What of the hull is kept: faces, holes, regions.
//!
//! A face is a set of triangles connected across unconstrained edges. Faces are numbered, then kept or dropped as a whole.

use super::Location;
use super::store::{Cdt2, Link, NONE, OUTSIDE};
use crate::arith::Kernel;
use crate::model::{Fill, Point2, VertexId};

/// A seed, by its position in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seed {
    /// A hole's.
    Hole(usize),
    /// A region's.
    Region(usize),
}

impl std::fmt::Display for Seed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Seed::Hole(i) => write!(f, "seed of hole {i}"),
            Seed::Region(i) => write!(f, "seed of region {i}"),
        }
    }
}

/// Why a domain cannot be carved out. Positions count from 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CarveError {
    /// A seed is a vertex or lies on a segment, so that it names no face.
    #[error("{0} lies on a segment or vertex")]
    OnSegment(Seed),
    /// A seed lies outside of what segments enclose, or a region's seed lies in a hole.
    #[error("{0} lies outside the domain")]
    Outside(Seed),
    /// Two region seeds lie in one face.
    #[error("seeds of regions {0} and {1} lie in one face")]
    OneFace(usize, usize),
    /// Under `Fill::Parity`, an odd number of toggling segments meet in a vertex: around it no side is left as it was entered.
    #[error("an odd number of toggling segments meet in vertex {}", .0.0)]
    OpenCycle(VertexId),
    /// No face is enclosed. (That holes take every enclosed face is no error: nothing is kept.)
    #[error("no region is closed by segments")]
    Nothing,
}

/// Faces of the triangulation and what becomes of each.
struct Faces {
    /// Face of each slot.
    of: Vec<u32>,
    kept: Vec<bool>,
    region: Vec<u32>,
}

impl<K: Kernel> Cdt2<K> {
    /// Drops what is not to be meshed and labels regions (`region` of a triangle: 1 + position of its seed, else 0).
    ///
    /// `toggles[s]` tells whether crossing segment s changes sides under `Fill::Parity`; it is read under no other.
    /// Under `Fill::Convex` the caller has made the hull's edges segments.
    /// Dropped triangles stay as filler that no reader sees: twins across to them are `None`. Nothing is changed on an error: the first of
    /// `carve_findings`.
    pub fn carve(
        &mut self,
        fill: Fill,
        toggles: &[bool],
        holes: &[Point2],
        regions: &[Point2],
    ) -> Result<(), CarveError> {
        let (faces, mut findings) = self.assess(fill, toggles, holes, regions);
        if !findings.is_empty() {
            return Err(findings.swap_remove(0));
        }
        self.label_faces(&faces);
        Ok(())
    }

    /// Everything that `carve` would refuse: open cycles, holes, then regions, each in order.
    pub fn carve_findings(
        &self,
        fill: Fill,
        toggles: &[bool],
        holes: &[Point2],
        regions: &[Point2],
    ) -> Vec<CarveError> {
        self.assess(fill, toggles, holes, regions).1
    }

    fn assess(&self, fill: Fill, toggles: &[bool], holes: &[Point2], regions: &[Point2]) -> (Faces, Vec<CarveError>) {
        let mut faces = self.faces();
        let inside = match fill {
            Fill::Seeds => self.enclosed(&faces),
            Fill::Parity => self.odd(&faces, toggles),
            Fill::Convex => vec![true; faces.kept.len()],
        };
        faces.kept.clone_from(&inside);
        let mut findings = if fill == Fill::Parity { self.open_cycles(toggles) } else { Vec::new() };
        for (i, &p) in holes.iter().enumerate() {
            match self.face_at(&faces, p) {
                Err(on) => findings.push(on.error(Seed::Hole(i))),
                Ok(face) if !inside[face] => findings.push(CarveError::Outside(Seed::Hole(i))),
                Ok(face) => faces.kept[face] = false,
            }
        }
        for (i, &p) in regions.iter().enumerate() {
            match self.face_at(&faces, p) {
                Err(on) => findings.push(on.error(Seed::Region(i))),
                Ok(face) if !faces.kept[face] => findings.push(CarveError::Outside(Seed::Region(i))),
                Ok(face) if faces.region[face] != 0 => {
                    findings.push(CarveError::OneFace(faces.region[face] as usize - 1, i));
                }
                // Seeds number fewer than 2^32, as does everything read from a file.
                Ok(face) => faces.region[face] = i as u32 + 1,
            }
        }
        if !inside.contains(&true) {
            findings.push(CarveError::Nothing);
        }
        (faces, findings)
    }

    /// Numbers the faces.
    fn faces(&self) -> Faces {
        let mut of = vec![NONE; self.slots.len()];
        let mut count = 0;
        let mut stack = Vec::new();
        for root in self.triangles() {
            if of[root.0 as usize] != NONE {
                continue;
            }
            of[root.0 as usize] = count;
            stack.push(root.0);
            while let Some(t) = stack.pop() {
                for f in self.slots[t as usize].link.iter().filter_map(|l| l.passage()) {
                    let beyond = &mut of[(f >> 2) as usize];
                    if *beyond == NONE {
                        *beyond = count;
                        stack.push(f >> 2);
                    }
                }
            }
            count += 1;
        }
        Faces { of, kept: vec![true; count as usize], region: vec![0; count as usize] }
    }

    /// Which faces do not reach the hull across an unconstrained edge.
    fn enclosed(&self, faces: &Faces) -> Vec<bool> {
        let mut inside = vec![true; faces.kept.len()];
        for t in self.triangles() {
            if self.slots[t.0 as usize].link.contains(&Link::BORDER) {
                inside[faces.of[t.0 as usize] as usize] = false;
            }
        }
        inside
    }

    /// Whether a half-edge is of a toggling segment.
    fn is_toggling(&self, e: u32, toggles: &[bool]) -> bool {
        self.link(e).is_constrained() && toggles.get(self.label(e) as usize) == Some(&true)
    }

    /// The vertices in which an odd number of toggling segments meet. Without any, each face has one answer to `odd`.
    fn open_cycles(&self, toggles: &[bool]) -> Vec<CarveError> {
        let mut odd = vec![false; self.vertex_count()];
        for e in self.triangles().flat_map(|t| self.edges(t)) {
            let once = self.link(e.0).twin().is_none_or(|f| e.0 < f);
            if once && self.is_toggling(e.0, toggles) {
                odd[self.origin(e).index()] ^= true;
                odd[self.destination(e).index()] ^= true;
            }
        }
        (0u32..).zip(odd).filter(|v| v.1).map(|v| CarveError::OpenCycle(VertexId(v.0))).collect()
    }

    /// Which faces are reached from outside across an odd number of toggling segments.
    fn odd(&self, faces: &Faces, toggles: &[bool]) -> Vec<bool> {
        let toggled = |e: u32| self.is_toggling(e, toggles);
        // (face, face beyond or NONE outside, whether the passage toggles)
        let mut passages: Vec<(u32, u32, bool)> = Vec::new();
        for e in self.triangles().flat_map(|t| self.edges(t)) {
            let face = faces.of[(e.0 >> 2) as usize];
            match self.link(e.0).twin() {
                Some(f) if faces.of[(f >> 2) as usize] == face => {}
                Some(f) => passages.push((face, faces.of[(f >> 2) as usize], toggled(e.0))),
                None => passages.push((NONE, face, toggled(e.0))),
            }
        }
        passages.sort_unstable();
        passages.dedup();
        let mut inside: Vec<Option<bool>> = vec![None; faces.kept.len()];
        let mut queue = std::collections::VecDeque::from([(NONE, false)]);
        while let Some((face, odd)) = queue.pop_front() {
            let start = passages.partition_point(|p| p.0 < face);
            for &(_, beyond, toggles) in passages[start..].iter().take_while(|p| p.0 == face) {
                let place = &mut inside[beyond as usize];
                if place.is_none() {
                    *place = Some(odd ^ toggles);
                    queue.push_back((beyond, odd ^ toggles));
                }
            }
        }
        inside.into_iter().map(|odd| odd == Some(true)).collect()
    }

    fn face_at(&self, faces: &Faces, p: Point2) -> Result<usize, NoFace> {
        let Some(start) = self.triangles().next() else {
            return Err(NoFace::Outside);
        };
        let t = match self.locate(start, p) {
            Location::Triangle(t) => t,
            Location::Edge(e) if !self.is_constrained(e) => self.triangle_of(e),
            Location::Edge(_) | Location::Vertex(_) => return Err(NoFace::OnSegment),
            Location::Outside => return Err(NoFace::Outside),
        };
        Ok(faces.of[t.0 as usize] as usize)
    }

    /// Labels the triangles; those of faces not kept become `OUTSIDE`.
    fn label_faces(&mut self, faces: &Faces) {
        for (t, slot) in self.slots.iter_mut().enumerate().filter(|(_, s)| s.is_inside()) {
            let face = faces.of[t] as usize;
            slot.region = if faces.kept[face] { faces.region[face] } else { OUTSIDE };
            self.outside += usize::from(!faces.kept[face]);
        }
        self.commit();
    }
}

/// Why a seed names no face.
#[derive(Clone, Copy)]
enum NoFace {
    OnSegment,
    Outside,
}

impl NoFace {
    fn error(self, seed: Seed) -> CarveError {
        match self {
            NoFace::OnSegment => CarveError::OnSegment(seed),
            NoFace::Outside => CarveError::Outside(seed),
        }
    }
}
