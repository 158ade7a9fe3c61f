//! Answers of kernels, named and comparable bit for bit.

use crate::arith::OutOfRange;
use crate::arith::space::ConstructionError;
use crate::model::{Point2, Point3, Sign};
use std::cmp::Ordering;
use std::fmt::Debug;

/// One answer of a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Answer {
    Sign(Sign),
    Yes(bool),
    Order(Ordering),
    Exponent(i32),
    Bits(u64),
    Point([u64; 2]),
    Place([u64; 3]),
    Places([Option<[u64; 3]>; 2]),
    Degenerate,
    OutOfRange,
}

/// The answers of a kernel, named.
pub(super) type Answers = Vec<(&'static str, Answer)>;

/// Asserts that two kernels answer a case alike.
pub(super) fn assert_equal(fast: &Answers, exact: &Answers, case: &impl Debug) {
    for (f, e) in fast.iter().zip(exact) {
        assert_eq!(f, e, "{case:?}");
    }
    assert_eq!(fast.len(), exact.len(), "{case:?}");
}

impl From<Sign> for Answer {
    fn from(value: Sign) -> Answer {
        Answer::Sign(value)
    }
}

impl From<bool> for Answer {
    fn from(value: bool) -> Answer {
        Answer::Yes(value)
    }
}

impl From<Ordering> for Answer {
    fn from(value: Ordering) -> Answer {
        Answer::Order(value)
    }
}

impl From<i32> for Answer {
    fn from(value: i32) -> Answer {
        Answer::Exponent(value)
    }
}

impl From<f64> for Answer {
    fn from(value: f64) -> Answer {
        Answer::Bits(value.to_bits())
    }
}

impl From<Point2> for Answer {
    fn from(value: Point2) -> Answer {
        Answer::Point(value.to_array().map(f64::to_bits))
    }
}

impl From<Point3> for Answer {
    fn from(value: Point3) -> Answer {
        Answer::Place(value.to_array().map(f64::to_bits))
    }
}

impl From<[Option<Point3>; 2]> for Answer {
    fn from(value: [Option<Point3>; 2]) -> Answer {
        Answer::Places(value.map(|p| p.map(|p| p.to_array().map(f64::to_bits))))
    }
}

impl<T: Into<Answer>> From<Result<T, OutOfRange>> for Answer {
    fn from(value: Result<T, OutOfRange>) -> Answer {
        value.map_or(Answer::OutOfRange, T::into)
    }
}

impl<T: Into<Answer>> From<Result<T, ConstructionError>> for Answer {
    fn from(value: Result<T, ConstructionError>) -> Answer {
        value.map_or_else(
            |e| match e {
                ConstructionError::Degenerate => Answer::Degenerate,
                ConstructionError::OutOfRange => Answer::OutOfRange,
            },
            T::into,
        )
    }
}
