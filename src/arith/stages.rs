//! The stages of the fast kernel: filter, double-double, exact integers, the same polynomial in each.
//!
//! A polynomial is named by its module and itself, `sign_of!(poly::cross(a, b, c))`: `poly` of the plane, `poly3` of space.

/// The exact stage, kept out of the callers' way.
#[cold]
#[inline(never)]
pub(super) fn rarely<T>(exact: impl FnOnce() -> T) -> T {
    #[cfg(test)]
    count(2);
    exact()
}

/// The sign of a polynomial, by the first stage that can tell.
macro_rules! sign_of {
    ($module:ident :: $polynomial:ident($($argument:expr),*)) => {
        match $module::$polynomial::<$crate::arith::filter::Bounded>($($argument),*).sign() {
            Some(sign) => {
                #[cfg(test)]
                $crate::arith::stages::count(0);
                sign
            }
            None => $crate::arith::stages::sign_without_filter!($module::$polynomial($($argument),*)),
        }
    };
}

/// The sign of a polynomial whose filter has declined.
macro_rules! sign_without_filter {
    ($module:ident :: $polynomial:ident($($argument:expr),*)) => {
        match $module::$polynomial::<$crate::arith::double_double::DoubleDouble>($($argument),*).sign() {
            Some(sign) => {
                #[cfg(test)]
                $crate::arith::stages::count(1);
                sign
            }
            None => $crate::arith::stages::rarely(|| {
                $module::$polynomial::<$crate::arith::Dyadic>($($argument),*).sign()
            }),
        }
    };
}

/// A fraction rounded once, by the first stage that can tell.
macro_rules! rounded_fraction {
    ($module:ident :: $fraction:ident($($argument:expr),*)) => {{
        let fraction = $module::$fraction::<$crate::arith::double_double::DoubleDouble>($($argument),*);
        fraction.num.over(&fraction.den).rounded().unwrap_or_else(|| {
            $crate::arith::stages::rarely(|| {
                let fraction = $module::$fraction::<$crate::arith::Dyadic>($($argument),*);
                $crate::arith::round::ratio(&fraction.num, &fraction.den)
            })
        })
    }};
}

/// Counts an answer by integers of fixed width.
#[inline]
pub(super) fn by_fixed_width<T>(answer: T) -> T {
    #[cfg(test)]
    count(3);
    answer
}

pub(super) use {rounded_fraction, sign_of, sign_without_filter};

#[cfg(test)]
use std::cell::Cell;

/// The running filter, double-double, exact integers, integers of fixed width.
#[cfg(test)]
pub(super) const STAGES: usize = 4;

#[cfg(test)]
thread_local! {
    static COUNTS: Cell<[u64; STAGES]> = const { Cell::new([0; STAGES]) };
}

/// Counts an answer of a stage, per thread; only tests count.
#[cfg(test)]
pub(super) fn count(stage: usize) {
    COUNTS.with(|c| {
        let mut counts = c.get();
        counts[stage] += 1;
        c.set(counts);
    });
}

/// The counts since the last call.
#[cfg(test)]
pub(super) fn take() -> [u64; STAGES] {
    COUNTS.take()
}
