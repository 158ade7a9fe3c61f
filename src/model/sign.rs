//! The sign of an exact value.

/// Sign of an exact expression; the only thing a predicate may answer besides yes, no and an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sign {
    /// Below zero.
    Negative = -1,
    /// Exactly zero.
    Zero = 0,
    /// Above zero.
    Positive = 1,
}

impl Sign {
    /// The sign of the negated value.
    #[must_use]
    pub fn reversed(self) -> Sign {
        match self {
            Sign::Negative => Sign::Positive,
            Sign::Zero => Sign::Zero,
            Sign::Positive => Sign::Negative,
        }
    }

    /// Strictly above zero.
    pub fn is_positive(self) -> bool {
        self == Sign::Positive
    }

    /// Strictly below zero.
    pub fn is_negative(self) -> bool {
        self == Sign::Negative
    }
}
