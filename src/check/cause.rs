//! Why a triangle is split or skipped: it is skinny, too large, or of too large a circumradius.

use super::condition::{exceeds_area, exceeds_radius, is_skinny};
use super::replay::Replay;
use super::verdict::{Checked, Rule, ensure};
use crate::model::{SegmentId, Triangle};
use crate::trace::{Cause, SkipReason};

impl Replay {
    /// The area bound of a triangle, input units.
    pub fn area_bound(&self, t: u32) -> Option<f64> {
        let region = self.mesh.facts(t).region;
        let of_region = self.ledger.region_bounds.get(region as usize).copied().flatten();
        match (self.ledger.parameters.max_area, of_region) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// Whether the area of t exceeds its bound.
    pub fn is_too_large(&self, t: u32) -> bool {
        self.area_bound(t).is_some_and(|b| exceeds_area(self.mesh.places(t), b, -2 * self.scale.exponent))
    }

    /// That t is bad for the cause named, and was not skipped for it.
    pub fn check_cause(&self, t: u32, cause: Cause) -> Checked {
        let corners = self.mesh.places(t);
        let facts = self.mesh.facts(t);
        let (bad, skipped) = match cause {
            Cause::Skinny => (is_skinny(corners, self.ledger.parameters.rho2), facts.skipped_skinny),
            Cause::Area => (self.is_too_large(t), facts.skipped_oversized),
            Cause::Size { h } => {
                ensure(self.ledger.parameters.size_function && h.is_finite() && h > 0.0, Rule::Cause, || {
                    ("a positive size, of a run with a size function", format!("{h:?}"))
                })?;
                let bad = exceeds_radius(corners, h, -self.scale.exponent) && !self.is_too_large(t);
                (bad, facts.skipped_oversized)
            }
        };
        ensure(bad && !skipped, Rule::Cause, || {
            let found = if skipped { "one that was skipped for it" } else { "one that is not" };
            (format!("a triangle bad for {cause:?}"), format!("{found}: {:?}", self.mesh.corners(t)))
        })
    }

    pub(super) fn skip(&mut self, t: Triangle, cause: Cause, reason: SkipReason) -> Checked {
        let t = self.triangle(t)?;
        self.check_cause(t, cause)?;
        match reason {
            SkipReason::Resolution => {}
            SkipReason::InputAngle { apex } => {
                ensure(cause == Cause::Skinny && self.excuses(t, apex.0), Rule::Skip, || {
                    (
                        format!("a triangle made skinny by the angle at {}", apex.0),
                        format!("{:?}", self.mesh.corners(t)),
                    )
                })?;
            }
            SkipReason::SplitLimit { segment: SegmentId(segment) } => {
                let used = self.ledger.splits.get(segment as usize).copied();
                ensure(used.is_some() && used == self.ledger.parameters.max_splits, Rule::Skip, || {
                    (format!("a segment split {:?} times", self.ledger.parameters.max_splits), format!("{used:?}"))
                })?;
            }
        }
        let facts = self.mesh.facts_mut(t);
        match cause {
            Cause::Skinny => facts.skipped_skinny = true,
            Cause::Area | Cause::Size { .. } => facts.skipped_oversized = true,
        }
        Ok(())
    }
}
