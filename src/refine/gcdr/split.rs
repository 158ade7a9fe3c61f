//! Splitting an encroached subsegment: its type, its point, what is deleted for it. Source: \[GCDR\] Algorithm 2, lines 6-14.

use super::choose::on_segment;
use super::{Kind, Refiner};
use crate::arith::Kernel;
use crate::model::{DeletionPolicy, Point2, SegmentId, VertexId};
use crate::trace::{Shell, SkipReason, SplitKind};
use crate::triangulation::cdt2::{Target, TriId};

/// A split that is to be made.
pub(super) struct Split {
    /// The subsegment, the smaller id first.
    pub s: [VertexId; 2],
    /// Its input segment.
    pub segment: SegmentId,
    /// Type-B or Type-C.
    pub kind: SplitKind,
    /// The new point.
    pub p: Point2,
    /// The shell it lies on.
    pub shell: Option<Shell>,
}

/// A disk by the ends of a diameter.
type Diameter = [Point2; 2];

/// How many points seen of a subsegment are asked for again.
const MOST_SEEN: usize = 8;

impl<K: Kernel> Refiner<'_, '_, K> {
    /// The non-free vertices strictly inside Diam(s) if one of them is seen, which makes the split Type-C; else none.
    ///
    /// Those not seen are in the list too: to ask for each costs the square of their number where many hide behind a constraint, and the
    /// parent is asked for by `parent` from the closest one on.
    pub(super) fn non_free_near(&mut self, s: [VertexId; 2]) -> Vec<VertexId> {
        if !self.an_apex_encroaches(s) {
            return Vec::new();
        }
        let diameter = s.map(|v| self.cdt.point(v));
        let mut found = self.vertices_near(s, &[diameter]);
        found.retain(|&w| self.kinds[w.index()] != Kind::Free);
        if !found.iter().any(|&w| self.cdt.sees(w, s, Target::Interior).is_some()) {
            found.clear();
        }
        found
    }

    /// Whether the apex of a triangle at s lies strictly inside Diam(s); if none does, no vertex seen from s does.
    fn an_apex_encroaches(&self, [u, v]: [VertexId; 2]) -> bool {
        let (pu, pv) = (self.cdt.point(u), self.cdt.point(v));
        [self.cdt.find_edge(u, v), self.cdt.find_edge(v, u)]
            .into_iter()
            .flatten()
            .any(|e| K::in_diametral_circle(pu, pv, self.cdt.point(self.cdt.apex(e))).is_positive())
    }

    /// The point of Type-B (delta1) or Type-C (mu), and its shell. Choice 1: concentric shells at apexes.
    pub(super) fn split_point(
        &mut self,
        s: [VertexId; 2],
        type_c: bool,
    ) -> Result<(Point2, Option<Shell>), super::RunError> {
        let ends = s.map(|v| self.cdt.point(v));
        match s.map(|v| self.is_apex(v)) {
            [true, true] => return Ok((K::midpoint(ends[0], ends[1]), None)),
            [false, false] => {}
            [at_u, _] => {
                let (apex, from, to) = if at_u { (s[0], ends[0], ends[1]) } else { (s[1], ends[1], ends[0]) };
                let k = K::shell_exponent(ends[0], ends[1]);
                return Ok((K::at_distance(from, to, k), Some(Shell { apex, k })));
            }
        }
        let (choice, delta) =
            if type_c { (self.params.choice_c, self.params.mu) } else { (self.params.choice_b, self.params.d1) };
        let chosen = on_segment::<K>(&self.params, choice, delta, ends, self.draws());
        let p = self.user_interval(choice, s, delta, chosen)?;
        Ok((p, None))
    }

    /// The free vertices that the split at p deletes, ascending.
    pub(super) fn doomed_by(&mut self, s: [VertexId; 2], p: Point2) -> Vec<VertexId> {
        let [u, v] = s.map(|v| self.cdt.point(v));
        let disks = [[u, v], [u, p], [p, v]];
        let mut found = match self.params.deletion {
            DeletionPolicy::Disk => self.all_in(&disks),
            // p exactly on s: the small disks lie in Diam(s), and no vertex is seen there unless an apex of s is
            _ if K::orient2d(u, v, p) == crate::model::Sign::Zero && !self.an_apex_encroaches(s) => Vec::new(),
            _ => self.vertices_near(s, &disks),
        };
        let mut seen = Vec::new();
        found.retain(|&w| {
            self.kinds[w.index()] == Kind::Free
                && match self.params.deletion {
                    DeletionPolicy::Segment => self.sees_interior(w, s, &mut seen),
                    DeletionPolicy::Point => self.cdt.sees(w, s, Target::Point(p)).is_some(),
                    DeletionPolicy::Disk => true,
                }
        });
        found.sort_unstable();
        found
    }

    /// Whether w sees an interior point of s. The points where others saw it are asked for first, the latest of them ahead: vertices side by side see much the
    /// same, and the cone of one may hold as many parts as there are vertices between it and s.
    fn sees_interior(&self, w: VertexId, s: [VertexId; 2], seen: &mut Vec<Point2>) -> bool {
        if let Some(k) = seen.iter().position(|&q| self.cdt.sees(w, s, Target::Point(q)).is_some()) {
            seen[..=k].rotate_right(1);
            return true;
        }
        let at = self.cdt.sees(w, s, Target::Interior);
        if let Some(q) = at {
            seen.insert(0, q);
            seen.truncate(MOST_SEEN);
        }
        at.is_some()
    }

    /// The parent of a Type-C point: the closest to p of the vertices that see it, ties by id.
    pub(super) fn parent(&self, s: [VertexId; 2], p: Point2, mut near: Vec<VertexId>) -> Result<VertexId, SkipReason> {
        near.sort_by(|&a, &b| {
            let (pa, pb) = (self.cdt.point(a), self.cdt.point(b));
            K::compare_lengths(p, pa, p, pb).then(a.cmp(&b))
        });
        near.into_iter().find(|&w| self.cdt.sees(w, s, Target::Point(p)).is_some()).ok_or(SkipReason::Resolution)
    }

    /// Whether the split can be made: false where the rounded p lies further off s than the circles of its triangles bulge beyond it, or than
    /// what lies across a gap outside.
    pub(super) fn splits_properly(&self, [u, v]: [VertexId; 2], p: Point2) -> bool {
        let e = self.cdt.find_edge(u, v).or_else(|| self.cdt.find_edge(v, u));
        e.is_some_and(|e| self.cdt.may_split(e, p))
    }

    /// Vertices other than the ends of s, strictly inside one of the disks, found by flooding them from the triangles at s
    /// across unconstrained edges. Every vertex seen from s inside a disk is among them.
    fn vertices_near(&mut self, [u, v]: [VertexId; 2], disks: &[Diameter]) -> Vec<VertexId> {
        self.flood_number += 1;
        let mut found = Vec::new();
        let mut todo: Vec<TriId> = Vec::new();
        for e in [self.cdt.find_edge(u, v), self.cdt.find_edge(v, u)].into_iter().flatten() {
            todo.push(self.cdt.triangle_of(e));
        }
        while let Some(t) = todo.pop() {
            if !self.mark(t) {
                continue;
            }
            for e in self.cdt.edges(t) {
                let (a, b) = (self.cdt.origin(e), self.cdt.destination(e));
                let (pa, pb) = (self.cdt.point(a), self.cdt.point(b));
                if a != u && a != v && is_inside::<K>(pa, disks) {
                    found.push(a);
                }
                if self.cdt.segment(e).is_none()
                    && disks.iter().any(|&[c, d]| K::edge_meets_diametral_disk(c, d, pa, pb))
                    && let Some(twin) = self.cdt.twin(e)
                {
                    todo.push(self.cdt.triangle_of(twin));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Marks a triangle in the current flood; false if it was.
    fn mark(&mut self, t: TriId) -> bool {
        let k = t.0 as usize;
        if self.flood_marks.len() <= k {
            self.flood_marks.resize(k + 1, 0);
        }
        let fresh = self.flood_marks[k] != self.flood_number;
        self.flood_marks[k] = self.flood_number;
        fresh
    }

    /// All vertices of the mesh strictly inside one of the disks.
    fn all_in(&self, disks: &[Diameter]) -> Vec<VertexId> {
        (0..self.kinds.len() as u32)
            .map(VertexId)
            .filter(|&w| is_inside::<K>(self.cdt.point(w), disks) && self.cdt.edge_from(w).is_some())
            .collect()
    }
}

fn is_inside<K: Kernel>(w: Point2, disks: &[Diameter]) -> bool {
    disks.iter().any(|&[c, d]| K::in_diametral_circle(c, d, w).is_positive())
}

#[cfg(test)]
mod tests {
    use crate::arith::FastKernel;
    use crate::model::{Point2, Pslg, Segment, VertexId};
    use crate::refine::{Options, gcdr};
    use crate::trace::Recorder;
    use crate::triangulation::cdt2::CONES;

    /// Two legs of length 1 at 0.01 degrees in a box whose splits delete thousands of vertices beside the legs: each asked alone, they
    /// took 2978 cones an event instead of 161.
    #[test]
    fn vertices_side_by_side_share_what_they_see() {
        let box_and_legs = [
            (-2.0, -2.0),
            (3.0, -2.0),
            (3.0, 3.0),
            (-2.0, 3.0),
            (0.0, 0.0),
            (1.0, 0.0),
            (0.999_999_984_769_129_1, 0.000_174_532_924_313_336_8),
        ];
        let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [4, 6]];
        let pslg = Pslg {
            points: box_and_legs.map(|(x, y)| Point2::new(x, y)).to_vec(),
            segments: ends.map(|ends| Segment { ends: ends.map(VertexId), marker: 0, toggles: false }).to_vec(),
            ..Pslg::default()
        };
        let before = CONES.get();
        let parameters = gcdr::everyday(25.0).expect("an angle in range");
        let run = gcdr::run::<FastKernel>(&pslg, &parameters, &mut Options::default(), &mut Recorder::default());
        let events = run.expect("a run").events;
        let cones = CONES.get() - before;
        assert!(cones < 500 * events, "{events} events, {cones} cones");
    }
}
