//! Finding bad triangles and keeping them in order. Source: \[GCDR\] Algorithm 2, lines 2-4, 15.

use super::queue::{Bad, Badness};
use super::{Refiner, params::in_window};
use crate::arith::Kernel;
use crate::model::Point2;
use crate::refine::RunError;
use crate::triangulation::cdt2::TriId;

impl<K: Kernel> Refiner<'_, '_, K> {
    /// The current triangle while it lives, else the first skinny, else the first oversized one.
    pub(super) fn next_bad(&mut self) -> Option<Bad> {
        if let Some(bad) = self.current.take()
            && self.lives(&bad)
        {
            return Some(bad);
        }
        loop {
            let bad = match self.skinny.pop(&self.cdt) {
                Some(bad) => bad,
                None => self.oversized.pop(&self.cdt)?,
            };
            if self.lives(&bad) {
                return Some(bad);
            }
        }
    }

    pub(super) fn lives(&self, bad: &Bad) -> bool {
        self.cdt.is_live(bad.t) && self.cdt.birth(bad.t) == bad.birth
    }

    /// Queues the bad ones among the triangles created since the last call.
    pub(super) fn classify_fresh(&mut self) -> Result<(), RunError> {
        let mut fresh = std::mem::take(&mut self.fresh);
        for &(t, birth) in &fresh {
            if self.cdt.is_live(t) && self.cdt.birth(t) == birth {
                self.classify(t)?;
            }
        }
        fresh.clear();
        self.fresh = fresh;
        Ok(())
    }

    fn classify(&mut self, t: TriId) -> Result<(), RunError> {
        let corners = self.cdt.corners(t);
        if K::is_skinny(corners, self.params.rho2) {
            self.skinny.push(&self.cdt, t, Badness::Skinny, 0.0);
        }
        let bound = self.area_bounds[self.cdt.region(t) as usize];
        if let Some(bound) = bound.filter(|&bound| K::exceeds_area(corners, bound)) {
            self.oversized.push(&self.cdt, t, Badness::Area, bound);
        } else if let Some(h) = self.size_at(corners)?.filter(|&h| K::exceeds_radius(corners, h)) {
            self.oversized.push(&self.cdt, t, Badness::Size, h);
        }
        Ok(())
    }

    /// The size function at the rounded circumcenter, normalised; `None` where it bounds nothing, which huge values say too.
    fn size_at(&mut self, corners: [Point2; 3]) -> Result<Option<f64>, RunError> {
        let (true, Some(size)) = (self.params.size_function, self.options.size.as_mut()) else {
            return Ok(None);
        };
        let Ok(center) = K::circumcenter(corners) else {
            return Ok(None);
        };
        let at = self.scale.to_input(center);
        let value = size(at);
        match in_window(value, -self.scale.exponent).filter(|_| value > 0.0) {
            Some(h) => Ok(Some(h)),
            None if value > self.scale.to_input(Point2::ONE).x => Ok(None),
            None => Err(RunError::Size { at, value }),
        }
    }
}
