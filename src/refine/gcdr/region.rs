//! Selection regions of stored points, and users' choices in them. Source: \[GCDR\] Definitions 3.1-3.3.

use super::Refiner;
use crate::arith::scale::by_power_of_two;
use crate::arith::{Dyadic, Kernel};
use crate::model::{Choice, DiskChoice, Point2, Triangle, VertexId};
use crate::refine::{DiskRequest, IntervalRequest, RunError};
use crate::trace::SplitKind;

/// Relative slack within which a rounded point still counts for a level: 2^-20.
const SLACK: f64 = 1.0 / (1u64 << 20) as f64;

/// How far stored points stray from their regions: not, by rounding, or further.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stray {
    Exact,
    Rounded,
    Outside,
}

impl<K: Kernel> Refiner<'_, '_, K> {
    pub(super) fn note_disk(&mut self, corners: [Point2; 3], a: Point2) {
        let d2 = self.params.d2;
        self.note(|delta| K::in_selection_disk(corners, delta, a), d2);
    }

    pub(super) fn note_interval(&mut self, s: [VertexId; 2], kind: SplitKind, p: Point2) {
        let delta = if kind == SplitKind::B { self.params.d1 } else { self.params.mu };
        let [u, v] = s.map(|v| self.cdt.point(v));
        self.note(|delta| K::in_selection_interval(u, v, delta, p), delta);
    }

    fn note(&mut self, holds: impl Fn(f64) -> bool, delta: f64) {
        if self.stray == Stray::Outside || holds(delta) {
            return;
        }
        self.stray = if holds(slackened(delta)) { Stray::Rounded } else { Stray::Outside };
    }

    pub(super) fn user_disk(
        &mut self,
        ids: Triangle,
        corners: [Point2; 3],
        center: Point2,
    ) -> Result<Point2, RunError> {
        if self.params.choice_a != DiskChoice::User {
            return Ok(center);
        }
        let chooser = self.options.chooser.as_mut().ok_or(RunError::MissingFunction)?;
        let request = DiskRequest {
            corners: corners.map(|p| self.scale.to_input(p)),
            ids,
            center: self.scale.to_input(center),
            d2: self.params.d2,
        };
        let point = chooser.in_disk(&request);
        self.storable(point)
            .filter(|&p| K::in_selection_disk(corners, slackened(self.params.d2), p))
            .ok_or_else(|| RunError::RegionViolation { point, place: format!("triangle {ids:?}") })
    }

    pub(super) fn user_interval(
        &mut self,
        choice: Choice,
        ids: [VertexId; 2],
        delta: f64,
        chosen: Point2,
    ) -> Result<Point2, RunError> {
        if choice != Choice::User {
            return Ok(chosen);
        }
        let chooser = self.options.chooser.as_mut().ok_or(RunError::MissingFunction)?;
        let [u, v] = ids.map(|v| self.cdt.point(v));
        let request = IntervalRequest { ends: [u, v].map(|p| self.scale.to_input(p)), ids, delta };
        let point = chooser.in_interval(&request);
        self.storable(point)
            .filter(|&p| K::in_selection_interval(u, v, slackened(delta), p) && is_near_line(u, v, p))
            .ok_or_else(|| RunError::RegionViolation { point, place: format!("subsegment {ids:?}") })
    }

    /// A user's point in normalised units, if a trace can hold it: coordinates +0 or of 2^-142 to 2^200. (-0 is 0.)
    fn storable(&self, point: Point2) -> Option<Point2> {
        let point = Point2::new(point.x + 0.0, point.y + 0.0);
        let normal = self.scale.to_normal(point);
        let fits = [normal.x, normal.y].iter().all(|c| {
            let least = by_power_of_two(1.0, -142);
            *c == 0.0 || (least..=by_power_of_two(1.0, 200)).contains(&c.abs())
        });
        (point.is_finite() && fits && self.scale.to_input(normal) == point).then_some(normal)
    }
}

/// Whether p is on the line uv up to a user's roundings: 2^-50 of the largest coordinate of u and v (a unit in the last place is 2^-52 of it at
/// most) and 2^-140 in each coordinate. The checker asks the same of every split point.
fn is_near_line(u: Point2, v: Point2, p: Point2) -> bool {
    let of = |x: f64| Dyadic::from_f64(x).unwrap_or_else(|| Dyadic::integer(0));
    let minus = |a: f64, b: f64| &of(a) - &of(b);
    let size = [u.x, u.y, v.x, v.y].map(f64::abs).into_iter().fold(0.0, f64::max);
    let tolerance = size * by_power_of_two(1.0, -50) + by_power_of_two(1.0, -140);
    let cross = &(&minus(v.x, u.x) * &minus(p.y, u.y)) - &(&minus(v.y, u.y) * &minus(p.x, u.x));
    let extent = &minus(u.x.max(v.x), u.x.min(v.x)) + &minus(u.y.max(v.y), u.y.min(v.y));
    let reach = &of(tolerance) * &extent;
    cross <= reach && &of(0.0) - &reach <= cross
}

/// delta (1 - 2^-20), rounded down.
pub(super) fn slackened(delta: f64) -> f64 {
    let exact = |x: f64| Dyadic::from_f64(x).unwrap_or_else(|| Dyadic::integer(0));
    let rounded = delta * (1.0 - SLACK);
    if exact(rounded) > &exact(delta) * &exact(1.0 - SLACK) { rounded.next_down() } else { rounded }
}
