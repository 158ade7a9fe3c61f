//! Numbers in sentences.

use std::fmt::Display;

/// `1 note`, `2 notes`, `0 vertices`.
pub fn counted<N: Display + PartialEq + From<u8>>(n: N, noun: &str) -> String {
    format!("{n} {}", of(&n, noun))
}

/// The noun alone, as its number wants it: for numbers that are written in another way.
pub fn of<N: PartialEq + From<u8>>(n: &N, noun: &str) -> String {
    if *n == N::from(1) { noun.into() } else { plural(noun) }
}

/// `line 3`, `lines 3, 5`, at most `most` of them: `lines 3, 5, ...`; empty for none.
pub fn listed(noun: &str, numbers: &[u32], most: usize) -> String {
    let shown: Vec<String> = numbers.iter().take(most).map(u32::to_string).collect();
    let rest = if numbers.len() > most { ", ..." } else { "" };
    match numbers.len() {
        0 => String::new(),
        1 => format!("{noun} {}", shown.concat()),
        _ => format!("{} {}{rest}", plural(noun), shown.join(", ")),
    }
}

fn plural(noun: &str) -> String {
    match (noun.strip_suffix("ex"), noun.strip_suffix("hedron")) {
        (Some(stem), _) => format!("{stem}ices"),
        (_, Some(stem)) => format!("{stem}hedra"),
        _ => format!("{noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_and_many() {
        assert_eq!([0u32, 1, 2].map(|n| counted(n, "vertex")), ["0 vertices", "1 vertex", "2 vertices"]);
        assert_eq!([1u32, 2].map(|n| counted(n, "tetrahedron")), ["1 tetrahedron", "2 tetrahedra"]);
        assert_eq!(counted(1u64, "hole seed"), "1 hole seed");
        let list = |n: usize| listed("line", &[3, 5, 8, 9][..n], 3);
        assert_eq!(
            [list(0), list(1), list(2), list(3), list(4)],
            ["", "line 3", "lines 3, 5", "lines 3, 5, 8", "lines 3, 5, 8, ..."]
        );
    }
}
