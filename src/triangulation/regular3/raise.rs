//! The first point, and points off the affine hull of the others.
//!
//! Where every finite cell has the apexes among its vertices, the cells do not depend on where the apexes are, but for their
//! orientation. So a point off the hull takes the place of an apex t on whose side it lies. If it lies on the other side, reflect t first: the
//! cells with t and those with the infinite vertex change roles, in other words t becomes infinite and the infinite vertex becomes the point:
//!
//! ```text
//!            t                    INF                  the points span a line or plane, drawn as ----
//!          / | \                 / | \
//!        a - b - c   becomes   a - b - c               triangles above the line have t, ghosts below have INF
//!          \ | /                 \ | /
//!           INF                    p
//! ```

use super::star::turned;
use super::store::{APEXES, Cell, FACET, INF, Regular3, Site};
use crate::arith::space::Kernel3;
use crate::model::{Point3, Sign, WeightedPoint};

impl<K: Kernel3> Regular3<K> {
    /// The triangulation of one point: a cell of it and three apexes, and four ghosts.
    pub(super) fn raise_from_nothing(&mut self, p: u32) {
        let at = self.site(p).at;
        // A power of two far beyond the point; for normalised coordinates it is 4. Doubling ends in the range of coordinates.
        let mut reach = 4.0;
        while reach < 4.0 * at.abs().max_element() {
            reach *= 2.0;
        }
        // The point lies below the plane x + y + z = reach, so that it is no combination of the apexes.
        for (k, axis) in [Point3::Y, Point3::X, Point3::Z].into_iter().enumerate() {
            self.sites[k] = Site(WeightedPoint::unweighted(axis * reach));
        }
        let mut v = [p, 0, 1, 2];
        if K::orient3d(at, self.site(0).at, self.site(1).at, self.site(2).at).is_negative() {
            v.swap(1, 2);
        }
        let root = self.take_slot();
        self.cells[root as usize].v = v;
        let ghosts = FACET.map(|[a, b, c]| {
            let g = self.take_slot();
            self.cells[g as usize].v = [v[a], v[c], v[b], INF];
            g
        });
        for (i, &g) in ghosts.iter().enumerate() {
            self.link(4 * root + i as u32, 4 * g + 3);
            for (j, &h) in ghosts.iter().enumerate() {
                // The two ghosts meet in the facet of g opposite the vertex that h's facet lacks, which is v[j].
                if let Some(k) = self.cells[g as usize].v.iter().position(|&x| x == v[j]) {
                    self.cells[g as usize].n[k] =
                        4 * h + self.cells[h as usize].v.iter().position(|&x| x == v[i]).map_or(0, |k| k as u32);
                }
            }
        }
        for x in v.into_iter().chain([INF]) {
            self.hints[x as usize] = root;
        }
        self.hints[INF as usize] = ghosts[0];
        self.last = root;
        self.dimension = Some(0);
    }

    /// The apex in whose place p can stand, and the side of it (seen from the other vertices) where p lies; `None` if p
    /// lies in the affine hull of the points.
    pub(super) fn off_hull(&self, p: Point3) -> Option<(u32, Sign)> {
        if self.dimension == Some(3) {
            return None;
        }
        let cell = self.cells.iter().find(|c| !c.is_free() && !c.is_ghost())?;
        let corners = cell.v.map(|v| self.site(v).at);
        (0..4).filter(|&k| cell.v[k] < APEXES).find_map(|k| {
            let mut with = corners;
            with[k] = p;
            let side = K::orient3d(with[0], with[1], with[2], with[3]);
            (side != Sign::Zero).then_some((cell.v[k], side))
        })
    }

    /// Puts p, which lies on the given side, in the place of an apex.
    pub(super) fn raise(&mut self, p: u32, apex: u32, side: Sign) {
        let renamed = |v: u32| match side {
            Sign::Negative if v == apex => INF,
            Sign::Negative if v == INF => p,
            _ if v == apex => p,
            _ => v,
        };
        // How each cell must turn so that its infinite vertex comes last again.
        let turn = |cell: &Cell| (0u32..).zip(cell.v).find(|&(_, v)| renamed(v) == INF).map_or(0, |(k, _)| k ^ 3);
        let turns: Vec<u8> = self.cells.iter().map(|c| if c.is_free() { 0 } else { turn(c) as u8 }).collect();
        for (cell, &turn) in self.cells.iter_mut().zip(&turns).filter(|(c, _)| !c.is_free()) {
            let v = cell.v.map(renamed);
            let n = cell.n.map(|link| link ^ u32::from(turns[(link >> 2) as usize]));
            *cell = turned(Cell { v, n }, u32::from(turn));
        }
        self.hints[p as usize] = match side {
            Sign::Negative => self.hints[INF as usize],
            _ => self.hints[apex as usize],
        };
        if side.is_negative() {
            self.hints[INF as usize] = self.hints[apex as usize];
        }
        self.dimension = self.dimension.map(|d| d + 1);
        self.move_all_lodgers();
    }
}
