//! The triangulation as plain data, in canonical form.

use super::store::{APEXES, FIRST, Regular3, Status};
use crate::arith::space::Kernel3;
use crate::model::{Triangulation3, VertexId, canonical_tetrahedron};

impl<K: Kernel3> Regular3<K> {
    /// The simplices of the dimension of the points, `dimension + 1` ids each, in the canonical form of `Triangulation3`.
    pub fn simplices(&self) -> Vec<VertexId> {
        let finite = self.cells.iter().filter(|c| !c.is_free() && !c.is_ghost());
        if self.dimension == Some(3) {
            let mut all: Vec<_> = finite.map(|c| canonical_tetrahedron(self.named(c))).collect();
            all.sort_unstable();
            return all.into_flattened();
        }
        let mut all: Vec<Vec<VertexId>> = finite
            .map(|c| {
                let points = c.v.into_iter().filter(|&v| v >= APEXES);
                let mut ids: Vec<_> = points.map(|v| VertexId(self.ids[v as usize])).collect();
                ids.sort_unstable();
                ids
            })
            .collect();
        all.sort_unstable();
        all.into_iter().flatten().collect()
    }

    /// Points, states and simplices. Coordinates are those that the triangulation was given.
    pub fn to_triangulation(&self) -> Triangulation3 {
        let ids = || (0..self.places.len() as u32).map(VertexId);
        Triangulation3 {
            points: ids().map(|v| self.point(v)).collect(),
            states: ids().map(|v| self.state(v)).collect(),
            dimension: self.dimension,
            simplices: self.simplices(),
        }
    }

    /// How many points are vertices.
    pub fn vertex_count(&self) -> usize {
        self.status[FIRST as usize..].iter().filter(|&&s| s == Status::Vertex).count()
    }
}
