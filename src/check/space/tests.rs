//! The ball seen from a vertex says what the definition does.

use super::ball::{Ball, Row, near_side};
use super::predicates::{Corners, exact_side, orient};
use crate::generators::{SpaceFamily, SplitMix64, WeightFamily, weighted_points};

#[test]
fn balls_say_what_the_definition_does() {
    let (mut certain, mut ties, mut all) = (0u32, 0u32, 0u32);
    for family in SpaceFamily::ALL {
        for weights in WeightFamily::ALL {
            let points = weighted_points(family, weights, 40, &mut SplitMix64(3));
            let set = crate::model::PointSet3 {
                points: points.iter().map(|p| p.at).collect(),
                weights: points.iter().map(|p| p.weight).collect(),
                ..Default::default()
            };
            let Ok((points, _)) = crate::domain::normalise3(&set) else { continue };
            for five in points.windows(5) {
                let mut t: Corners = [five[0], five[1], five[2], five[3]];
                match orient(t[0].at, t[1].at, t[2].at, t[3].at) {
                    crate::model::Sign::Positive => {}
                    crate::model::Sign::Negative => t.swap(0, 1),
                    crate::model::Sign::Zero => continue,
                }
                let [u, v, w] = [0, 1, 2].map(|k: usize| Row::new(t[3], t[k]));
                let ball = Ball::new(&u, &v, &w);
                let (own, truth) = (ball.side(&Row::new(t[3], five[4])), exact_side(&t, &five[4]));
                assert!(own.is_none_or(|own| own == truth), "{family:?} {weights:?}: {t:?} {:?}", five[4]);
                assert_eq!(near_side(&ball, &t, &five[4]), truth, "{family:?} {weights:?}: {t:?} {:?}", five[4]);
                assert!(ball.orientation().is_none_or(|o| o.is_positive()));
                certain += u32::from(own.is_some());
                ties += u32::from(truth == crate::model::Sign::Zero);
                all += 1;
            }
        }
    }
    assert!(all > 1500 && 2 * certain > all && ties > 50, "{certain} certain and {ties} ties of {all}");
}
