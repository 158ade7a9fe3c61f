//! The bounds of approximate values against rationals.

use super::*;

fn shape<N: Number>(a: f64, b: f64, c: f64, d: f64) -> N {
    N::of(a) * N::of(b) - N::of(c) * N::of(d)
}

#[test]
fn bounds_never_lie() {
    let mut state = 1u64;
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let (mut decided, mut open) = (0, 0);
    for n in 0..20_000 {
        let a = random();
        let near = power_of_two(-(n % 60));
        let (b, c) = (random(), random());
        let d = a * b / c + random() * near;
        match shape::<Approx>(a, b, c, d).sign() {
            Some(s) => {
                assert_eq!(s, exact_sign(&shape::<Exact>(a, b, c, d)));
                decided += 1;
            }
            None => open += 1,
        }
    }
    assert!(decided > 10_000 && open > 1_000, "{decided} decided, {open} open");
}

#[test]
fn small_integers_are_exact() {
    let zero = |a: f64, b: f64| (Approx::of(a) - Approx::of(b)).square() - (Approx::of(b) - Approx::of(a)).square();
    assert_eq!(zero(3.0, 8.0).sign(), Some(Sign::Zero));
    assert_eq!(zero(0.1, 0.3).sign(), None);
    assert_eq!(Approx::scaled(1.0, 2000).sign(), None);
    assert_eq!(Exact::scaled(1.0, 2000).sign(), Some(Sign::Positive));
}
