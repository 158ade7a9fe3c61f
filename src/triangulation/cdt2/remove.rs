//! Deletion of a free vertex: its star is a polygon without constrained edges inside; fill it anew.

use super::polygon::Side;
use super::store::{Cdt2, Change, NONE, next, prev};
use crate::arith::Kernel;
use crate::model::VertexId;

impl<K: Kernel> Cdt2<K> {
    /// Deletes a vertex with no constrained edge, strictly interior. Its id stays given, its coordinates readable.
    ///
    /// `change.destroyed` is the star of v, `change.created` the triangles that fill it.
    pub fn remove(&mut self, v: VertexId, change: &mut Change) {
        change.clear();
        let start = self.hints[v.index()];
        assert!(start != NONE, "the vertex has triangles");
        let region = self.slots[(start >> 2) as usize].region;
        let mut polygon = std::mem::take(&mut self.scratch.polygon);
        polygon.reset();
        let mut e = start;
        loop {
            change.destroyed.push(self.slots[(e >> 2) as usize].canonical());
            let opposite = next(e);
            polygon.sides.push(Side { origin: self.origin_of(opposite), inner: opposite });
            let spoke = self.link(prev(e)).passage();
            assert!(spoke.is_some(), "a deleted vertex is interior and has no constrained edge");
            e = spoke.unwrap_or(start);
            if e == start {
                break;
            }
        }
        polygon.triangulate_around::<K>(&self.points, self.points[v.index()]);
        self.fill(&polygon, region, &mut change.created);
        for side in &polygon.sides {
            self.release_slot(side.inner >> 2);
        }
        self.scratch.polygon = polygon;
        self.write_hint(v.0, NONE);
    }
}
