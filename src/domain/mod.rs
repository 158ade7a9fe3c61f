//! Floor 2: the statement of a domain and its conditions.
