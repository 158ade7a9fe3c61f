//! The ball seen from a vertex says what the definition does.

use super::ball::{Ball, Row, near_side};
use super::predicates::{Corners, exact_side, orient};
use super::view::View;
use crate::model::{Point3, Sign, WeightedPoint};

/// Numbers of a linear congruence (Knuth's MMIX).
struct Lcg(u64);

impl Lcg {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }

    /// A place on a grid of three by three by three, perhaps off it by multiples of a tiny step, perhaps with a weight.
    fn point(&mut self, step: f64, weighted: bool) -> WeightedPoint {
        let mut coordinate = || self.below(3) as f64 / 8.0 + step * self.below(64) as f64;
        let at = Point3::new(coordinate(), coordinate(), coordinate());
        let weight = if weighted { self.below(2) as f64 / 64.0 + step } else { 0.0 };
        WeightedPoint { at, weight }
    }
}

#[test]
fn balls_say_what_the_definition_does() {
    let mut draw = Lcg(7);
    let (mut certain, mut ties, mut all) = (0u32, 0u32, 0u32);
    for step in [0.0, 2f64.powi(-8), 2f64.powi(-30), 2f64.powi(-50), 0.1, 1e-9] {
        for weighted in [false, true] {
            for _ in 0..2000 {
                let five = [(); 5].map(|()| draw.point(step, weighted));
                let mut t: Corners = [five[0], five[1], five[2], five[3]];
                match orient(t[0].at, t[1].at, t[2].at, t[3].at) {
                    Sign::Positive => {}
                    Sign::Negative => t.swap(0, 1),
                    Sign::Zero => continue,
                }
                let [u, v, w] = [0, 1, 2].map(|k: usize| Row::new(t[3], t[k]));
                let ball = Ball::new(&u, &v, &w);
                let (own, truth) = (ball.side(&Row::new(t[3], five[4])), exact_side(&t, &five[4]));
                assert!(own.is_none_or(|own| own == truth), "{t:?} {:?}", five[4]);
                assert_eq!(near_side(&t, &five[4]), truth, "{t:?} {:?}", five[4]);
                assert!(ball.orientation().is_none_or(|o| o.is_positive()));
                certain += u32::from(own.is_some());
                ties += u32::from(truth == Sign::Zero);
                all += 1;
            }
        }
    }
    assert!(all > 15_000 && 2 * certain > all && ties > 100, "{certain} certain and {ties} ties of {all}");
}

/// What an insertion sees: near points among which one far away makes the common bound useless.
#[test]
fn views_say_what_the_definition_does() {
    let mut draw = Lcg(11);
    let mut view = View::default();
    let (mut certain, mut all) = (0u32, 0u32);
    for step in [0.0, 2f64.powi(-8), 2f64.powi(-30), 2f64.powi(-50), 0.1, 1e-9] {
        for weighted in [false, true] {
            for case in 0..2000 {
                let [u, v, w, q, p] = [(); 5].map(|()| draw.point(step, weighted));
                let far = WeightedPoint::unweighted(Point3::splat(if case % 2 == 0 { 1e6 } else { 1.5 }));
                let mut corners = [0, 1, 2];
                match orient(u.at, v.at, w.at, p.at) {
                    Sign::Positive => {}
                    Sign::Negative => corners.swap(0, 1),
                    Sign::Zero => continue,
                }
                let points = [u, v, w, q, far];
                view.look(p, points.into_iter().map(Some), -60);
                let sphere = view.sphere(corners);
                let [a, b, c] = corners.map(|k| points[k as usize]);
                for k in [3, 4] {
                    let (own, truth) = (view.side(&sphere, corners, k), exact_side(&[a, b, c, p], &points[k as usize]));
                    assert!(own.is_none_or(|own| own == truth), "{step} {points:?} {p:?}");
                    certain += u32::from(own.is_some());
                    all += 1;
                }
            }
        }
    }
    assert!(all > 30_000 && 3 * certain > 2 * all, "{certain} certain of {all}");
}
