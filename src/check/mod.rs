//! Beside the floors: the checker. It shares plain data with the producer, no arithmetic and no algorithm.

pub mod grading;
pub mod rational;
pub mod scalar;
pub mod spacing;
