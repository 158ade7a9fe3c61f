//! The grading constants of \[GCDR\] section 5: the system (5.11)-(5.19), the printed solution, the least solution.
//!
//! Problem: Theorem 5.5 bounds the density D = lfs/R of every vertex by D_A, D_B or D_C, the solution of a system of
//! inequalities. The solution printed as (5.23) violates the system, and the conditions I-1..I-5 do not suffice for a
//! finite one (`docs/errata.md`, 1 and 2).
//! Idea: the system is monotone and max-affine, D_x >= B + D_y/C along the edges child x, parent y
//! A: A, B, C (C1); B: A (C2), B, C (C3); C: B, C (C4). It has a finite solution exactly if each cycle's product of C's exceeds one,
//! that is C1 > 1, C3 > 1, C4 > 1, C1 C2 > 1; the others (BCB, ABCA) are products of these. `least` is its least solution.
//! Numbers: conditions are decided in rationals, constants are intervals of rationals with 160 bits.
//! Source: \[GCDR\] Theorem 4.6, Lemma 5.4, Theorem 5.5; corrections in `docs/errata.md`.

use super::rational::Rational;
use super::scalar::{Enclosure, Scalar};
use std::fmt;

/// Parameters of the selection regions, exactly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection {
    /// rho squared.
    pub rho2: Rational,
    /// delta1.
    pub d1: Rational,
    /// delta2.
    pub d2: Rational,
    /// mu.
    pub mu: Rational,
    /// cos^2 of the smallest input angle; `None` where every angle is at least 90 degrees or no two segments meet.
    pub cos2: Option<Rational>,
}

/// The constant C2 of Case (2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum C2 {
    /// d1 sqrt(3)/2, as printed.
    Printed,
    /// d1 cos(theta), which the proof gives (4.8).
    Sharp,
}

/// The constant B2 of Case (2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum B2 {
    /// B2 = B3, as printed.
    Printed,
    /// (2 - d1)/d1: a Type-A parent strictly inside Diam(s) is that close.
    Refined,
}

/// The constants of Theorem 4.6 and Lemma 5.4.
#[derive(Clone, Debug)]
pub struct Constants {
    /// rho d2.
    pub c1: Enclosure,
    /// d1 sqrt(3)/2 or d1 cos(theta).
    pub c2: Enclosure,
    /// rho d1 sqrt(2 d2 - d2^2).
    pub c3: Enclosure,
    /// mu/(2 cos alpha_min); `None` is infinity.
    pub c4: Option<Enclosure>,
    /// mu/(2 - mu).
    pub c5: Enclosure,
    /// (2 - d2)/d2.
    pub b1: Enclosure,
    /// B3, or (2 - d1)/d1.
    pub b2: Enclosure,
    /// (1 + sqrt((2 - d2)/d2) - d1)/d1.
    pub b3: Enclosure,
    /// (2 - mu)/mu.
    pub b4: Enclosure,
    /// Whether C1 > 1, C3 > 1 and C4 > 1: (5.23) is defined.
    self_loops: bool,
    /// Whether C1 C2 > 1 also: a finite solution exists.
    finite: bool,
}

/// Bounds of the densities of Type-A, B and C vertices.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// D_A.
    pub a: Enclosure,
    /// D_B.
    pub b: Enclosure,
    /// D_C.
    pub c: Enclosure,
}

/// An inequality of the proof of Theorem 5.5.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Inequality {
    /// B1 + D_A/C1 <= D_A.
    I5_11,
    /// B1 + D_B/C1 <= D_A.
    I5_12,
    /// B1 + D_C/C1 <= D_A.
    I5_13,
    /// B2 + D_A/C2 <= D_B.
    I5_14,
    /// B3 + D_B/C3 <= D_B.
    I5_15,
    /// B3 + D_C/C3 <= D_B.
    I5_16,
    /// B4 + D_B/C4 <= D_C.
    I5_17,
    /// B4 + D_C/C4 <= D_C.
    I5_18,
    /// 1/C5 = B4 <= D_C.
    I5_19,
}

impl fmt::Display for Inequality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "5.{}", 11 + *self as u8)
    }
}

impl Selection {
    /// Parameters as they stand in a header, with every input angle at least 90 degrees.
    pub fn of(rho2: f64, d1: f64, d2: f64, mu: f64) -> Self {
        let [rho2, d1, d2, mu] = [rho2, d1, d2, mu].map(Rational::of);
        Selection { rho2, d1, d2, mu, cos2: None }
    }

    /// Whether C1 > 1: rho2 d2^2 > 1.
    pub fn c1_above_one(&self) -> bool {
        &self.rho2 * &self.d2.squared() > one()
    }

    /// Whether C3 > 1: rho2 d1^2 (2 d2 - d2^2) > 1.
    pub fn c3_above_one(&self) -> bool {
        &(&self.rho2 * &self.d1.squared()) * &self.q2() > one()
    }

    /// Whether C4 > 1: mu^2 > 4 cos^2(alpha_min).
    pub fn c4_above_one(&self) -> bool {
        self.cos2.as_ref().is_none_or(|cos2| self.mu.squared() > &Rational::of(4.0) * cos2)
    }

    /// Whether C1 C2 > 1: d1^2 d2^2 3 rho2 / 4 > 1 as printed, d1^2 d2^2 (rho2 - 1/4) > 1 sharp.
    pub fn c1c2_above_one(&self, c2: C2) -> bool {
        let cos2_theta_rho2 = match c2 {
            C2::Printed => &self.rho2 * &Rational::ratio(3, 4),
            C2::Sharp => &self.rho2 - &Rational::ratio(1, 4),
        };
        &(&self.d1.squared() * &self.d2.squared()) * &cos2_theta_rho2 > one()
    }

    /// q^2 = 2 d2 - d2^2.
    fn q2(&self) -> Rational {
        &self.d2 * &(&Rational::of(2.0) - &self.d2)
    }
}

impl Constants {
    /// The constants of a run. d1, d2, mu are positive and at most 1, rho2 is above 1/4.
    pub fn new(selection: &Selection, c2: C2, b2: B2) -> Self {
        let exact = |x: &Rational| Enclosure::exact(x.clone());
        let two = || Enclosure::of(2.0);
        let (d1, d2, mu) = (exact(&selection.d1), exact(&selection.d2), exact(&selection.mu));
        let rho = exact(&selection.rho2).root();
        let c2_value = match c2 {
            C2::Printed => Enclosure::exact(Rational::ratio(3, 4)).root(),
            C2::Sharp => (Enclosure::of(1.0) - Enclosure::of(0.25) / exact(&selection.rho2)).root(),
        };
        let b3 = (Enclosure::of(1.0) + ((two() - d2.clone()) / d2.clone()).root() - d1.clone()) / d1.clone();
        let self_loops = selection.c1_above_one() && selection.c3_above_one() && selection.c4_above_one();
        Constants {
            c1: rho.clone() * d2.clone(),
            c2: d1.clone() * c2_value,
            c3: rho * d1.clone() * exact(&selection.q2()).root(),
            c4: selection.cos2.as_ref().map(|cos2| mu.clone() / (two() * exact(cos2).root())),
            c5: mu.clone() / (two() - mu.clone()),
            b1: (two() - d2.clone()) / d2,
            b2: match b2 {
                B2::Printed => b3.clone(),
                B2::Refined => (two() - d1.clone()) / d1,
            },
            b3,
            b4: (two() - mu.clone()) / mu,
            self_loops,
            finite: self_loops && selection.c1c2_above_one(c2),
        }
    }

    /// x/C4, zero where C4 is infinite.
    fn over_c4(&self, x: &Enclosure) -> Enclosure {
        self.c4.as_ref().map_or_else(|| Enclosure::of(0.0), |c4| x.clone() / c4.clone())
    }

    /// The least solution of (5.11)-(5.19); `None` where no finite one exists.
    ///
    /// With bS = B3 C3/(C3 - 1), gS = B4 C4/(C4 - 1) (B4 for infinite C4) and
    /// M = max{bS, gS, (B1 + B2 C2) C1/(C1 C2 - 1)}: D_A = B1 + M/C1, D_B = max{B2 + D_A/C2, B3 + M/C3}, D_C = B4 + M/C4.
    pub fn least(&self) -> Option<Bounds> {
        if !self.finite {
            return None;
        }
        let c12 = self.c1.clone() * self.c2.clone();
        let around =
            (self.b1.clone() + self.b2.clone() * self.c2.clone()) * self.c1.clone() / (c12 - Enclosure::of(1.0));
        let m = self.loop_b().max(self.loop_c()).max(around);
        let a = self.b1.clone() + m.clone() / self.c1.clone();
        let through_a = self.b2.clone() + a.clone() / self.c2.clone();
        let b = through_a.max(self.b3.clone() + m.clone() / self.c3.clone());
        let c = self.b4.clone() + self.over_c4(&m);
        Some(Bounds { a, b, c })
    }

    /// The solution printed as (5.23), wrong; `None` where one of its denominators is not positive.
    pub fn printed(&self) -> Option<Bounds> {
        if !self.self_loops {
            return None;
        }
        let (b1, b2, b3, b4) = (self.b1.clone(), self.b2.clone(), self.b3.clone(), self.b4.clone());
        let loop_a = b1.clone() * self.c1.clone() / (self.c1.clone() - Enclosure::of(1.0));
        let (loop_b, loop_c) = (self.loop_b(), self.loop_c());
        // where C4 is infinite the entries with B4 C4/(C4 - 1) read B4, which the others dominate or equal
        let a = (loop_a.clone())
            .max(loop_b.clone() / self.c1.clone() + b1.clone())
            .max(loop_c.clone() / self.c1.clone() + b1);
        let b = (loop_b.clone()).max(loop_a / self.c2.clone() + b2).max(loop_c.clone() / self.c3.clone() + b3);
        let c = loop_c.max(self.over_c4(&loop_b) + b4.clone()).max(b4);
        Some(Bounds { a, b, c })
    }

    /// bS, the least D_B that the cycle B -> B allows.
    fn loop_b(&self) -> Enclosure {
        self.b3.clone() * self.c3.clone() / (self.c3.clone() - Enclosure::of(1.0))
    }

    /// gS, the least D_C that the cycle C -> C allows.
    fn loop_c(&self) -> Enclosure {
        match &self.c4 {
            Some(c4) => self.b4.clone() * c4.clone() / (c4.clone() - Enclosure::of(1.0)),
            None => self.b4.clone(),
        }
    }

    /// The system at given bounds: for each inequality whether it holds, `None` where both sides agree to 150 bits.
    pub fn system(&self, d: &Bounds) -> [(Inequality, Option<bool>); 9] {
        use Inequality::{I5_11, I5_12, I5_13, I5_14, I5_15, I5_16, I5_17, I5_18, I5_19};
        let affine = |b: &Enclosure, x: &Enclosure, c: &Enclosure| b.clone() + x.clone() / c.clone();
        let case4 = |x: &Enclosure| self.b4.clone() + self.over_c4(x);
        [
            (I5_11, affine(&self.b1, &d.a, &self.c1).at_most(&d.a)),
            (I5_12, affine(&self.b1, &d.b, &self.c1).at_most(&d.a)),
            (I5_13, affine(&self.b1, &d.c, &self.c1).at_most(&d.a)),
            (I5_14, affine(&self.b2, &d.a, &self.c2).at_most(&d.b)),
            (I5_15, affine(&self.b3, &d.b, &self.c3).at_most(&d.b)),
            (I5_16, affine(&self.b3, &d.c, &self.c3).at_most(&d.b)),
            (I5_17, case4(&d.b).at_most(&d.c)),
            (I5_18, case4(&d.c).at_most(&d.c)),
            (I5_19, self.b4.at_most(&d.c)),
        ]
    }

    /// The inequalities that are violated for certain.
    pub fn violated(&self, d: &Bounds) -> Vec<Inequality> {
        self.system(d).into_iter().filter(|(_, holds)| *holds == Some(false)).map(|(id, _)| id).collect()
    }
}

impl Bounds {
    /// The largest of the three.
    pub fn largest(&self) -> Enclosure {
        self.a.clone().max(self.b.clone()).max(self.c.clone())
    }
}

fn one() -> Rational {
    Rational::of(1.0)
}
