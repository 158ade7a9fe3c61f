//! Small input angles: segments at an apex are split on shells of radius 2^k, and an angle that nothing can mend excuses its triangles.
//! Source: `docs/trace-format.md`, shells.

use super::complex::{NONE, next, previous};
use super::condition::{is_below_60, is_shell_exponent, shortest_edge};
use super::replay::Replay;
use super::split::Split;
use super::verdict::{Checked, Rule, ensure};
use crate::model::{Choice, SmallAngles};
use crate::trace::{Shell, SplitKind};

impl Replay {
    /// The rung of a split point: 2^k on shell k, halfway between rungs of one apex for a midpoint, else none.
    pub(super) fn rung(&self, split: &Split, shell: Option<Shell>) -> Option<(u32, f64)> {
        if let Some(Shell { apex, k }) = shell {
            // k was checked to be an exponent of lengths in the input, which are normal f64s
            return Some((apex.0, f64::from_bits(((k + 1023).clamp(1, 2046) as u64) << 52)));
        }
        let choice = match split.kind {
            SplitKind::B => self.ledger.parameters.choice_b,
            SplitKind::C { .. } => self.ledger.parameters.choice_c,
        };
        let [a, b] = split.ends.map(|v| self.ledger.rungs[v as usize]);
        let ((apex, c), (other, d)) = (a?, b?);
        (choice == Choice::Center && apex == other).then_some((apex, (c + d) / 2.0))
    }

    /// A shell names the one end of s that is an apex, and its exponent: |s|/3 < 2^k <= 2|s|/3.
    pub(super) fn check_shell(&self, split: &Split, shell: Option<Shell>) -> Checked {
        let apexes = split.ends.map(|v| {
            self.ledger.parameters.small_angles == SmallAngles::Shells
                && self.ledger.apexes.get(v as usize) == Some(&true)
        });
        let apex = match apexes {
            [true, false] => Some(split.ends[0]),
            [false, true] => Some(split.ends[1]),
            _ => None,
        };
        ensure(shell.map(|s| s.apex.0) == apex, Rule::Shell, || {
            (format!("a shell of apex {apex:?}"), format!("{shell:?}"))
        })?;
        let [u, v] = split.ends.map(|v| self.mesh.at(v));
        let fits = shell.is_none_or(|s| is_shell_exponent(u, v, s.k, self.scale.exponent));
        ensure(fits, Rule::Shell, || ("k with |s|/3 < 2^k <= 2|s|/3", format!("{shell:?}")))
    }

    /// Whether the small angle at `apex` excuses the skinny triangle t. Source: `docs/trace-format.md`, shells.
    pub fn excuses(&self, t: u32, apex: u32) -> bool {
        if self.ledger.parameters.small_angles == SmallAngles::Off
            || !self.ledger.apexes.get(apex as usize).is_some_and(|&a| a)
        {
            return false;
        }
        let k = shortest_edge(self.mesh.places(t), self.mesh.corners(t)) as u32;
        let e = 4 * t + k;
        let (x, y) = (self.mesh.origin(e), self.mesh.target(e));
        let rung = |v: u32| self.ledger.rungs[v as usize].filter(|r| r.0 == apex);
        let on = |v: u32| self.mesh.vertices[v as usize].segment();
        if let (Some(k), Some(l), Some(a), Some(b)) = (rung(x), rung(y), on(x), on(y))
            && k == l
            && a != b
            && self.angle_below_60(apex, a, b)
        {
            return true;
        }
        let sides = [next(e), previous(e)].map(|e| self.mesh.segment(e));
        self.mesh.apex(e) == apex && !sides.contains(&NONE) && sides[0] != sides[1]
    }

    pub(super) fn angle_below_60(&self, apex: u32, a: u32, b: u32) -> bool {
        let far = |s: u32| {
            let [u, v] = self.ledger.segments[s as usize].ends.map(|v| v.0);
            if u == apex { v } else { u }
        };
        let at = |v: u32| self.mesh.at(v);
        is_below_60(at(apex), at(far(a)), at(far(b)))
    }
}
