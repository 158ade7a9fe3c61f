//! Reads well-known text (OGC 06-103r4, section 7): points, polylines, polygons, and collections of them.
//!
//! Choice 1: a file may hold several geometries, one after another or separated by `;`; they are taken together.
//! Choice 2: a leading `SRID=n;` is skipped; z and m coordinates are left out with a note.

use super::chains::{Chain, Chains, Position, same, text_of_chains};
use super::cursor::Cursor;
use super::{Input, Note, NoteKind, ReadError};
use crate::model::Point2;

/// Nesting of collections; real files have one or two levels.
const DEEPEST: u32 = 32;

const ROUND: (u8, u8) = (b'(', b')');

/// Reads well-known text.
///
/// Result: equal points are one vertex; polygons fill by the even-odd rule (`Fill::Parity`); without polygons `Fill::Seeds`.
/// Errors: the first fault. A file without a geometry is one.
pub fn parse_wkt(bytes: &[u8]) -> Result<Input, ReadError> {
    let text = text_of_chains("WKT", bytes)?;
    let mut reader = Reader { at: Cursor::new("WKT", text, 0), chains: Chains::default(), count: 0 };
    let mut notes = Vec::new();
    loop {
        geometry(&mut reader, 0, &mut notes)?;
        while reader.at.take(b';') {}
        if reader.at.peek().is_none() {
            break;
        }
    }
    let mut input = reader.chains.finish();
    input.notes.append(&mut notes);
    Ok(input)
}

struct Reader<'a> {
    at: Cursor<'a>,
    chains: Chains,
    /// Geometries seen, for messages.
    count: u32,
}

fn geometry(r: &mut Reader, depth: u32, notes: &mut Vec<Note>) -> Result<(), ReadError> {
    r.at.skip_space();
    r.at.element = format!("geometry {}", r.count + 1);
    let start = r.at.wanted("a geometry such as POLYGON");
    let mut word = r.at.run(|b| b.is_ascii_alphabetic()).to_ascii_uppercase();
    if word == "SRID" && r.at.take(b'=') {
        let number = r.at.run(|b| b.is_ascii_digit());
        r.at.expect(b';', "`;`")?;
        notes.push(Note {
            kind: NoteKind::Note,
            line: r.at.line(),
            text: format!("the reference system {number} is not interpreted"),
        });
        word = r.at.run(|b| b.is_ascii_alphabetic()).to_ascii_uppercase();
    }
    r.count = r.count.saturating_add(1);
    let base = ["ZM", "Z", "M"].iter().find_map(|s| word.strip_suffix(s)).filter(|w| NAMES.contains(w));
    let name = base.unwrap_or(&word);
    let Some(&name) = NAMES.iter().find(|&&n| n == name) else {
        return Err(ReadError { fix: format!("the geometries read here are {}", NAMES.join(", ")), ..start });
    };
    r.at.element = format!("geometry {}, {name}", r.count);
    if r.at.peek() != Some(b'(') {
        let mut tag = r.at.run(|b| b.is_ascii_alphabetic()).to_ascii_uppercase();
        if ["Z", "M", "ZM"].contains(&tag.as_str()) {
            tag = r.at.run(|b| b.is_ascii_alphabetic()).to_ascii_uppercase();
        }
        match tag.as_str() {
            "EMPTY" => return Ok(()),
            "" => {}
            other => {
                return Err(r.at.fault(format!("`{other}` stands where `(` or EMPTY is due"), ""));
            }
        }
    }
    body(r, name, depth, notes)
}

const NAMES: [&str; 7] =
    ["POINT", "LINESTRING", "POLYGON", "MULTIPOINT", "MULTILINESTRING", "MULTIPOLYGON", "GEOMETRYCOLLECTION"];

fn body(r: &mut Reader, name: &str, depth: u32, notes: &mut Vec<Note>) -> Result<(), ReadError> {
    let Reader { at, chains, .. } = r;
    match name {
        "POINT" | "MULTIPOINT" => at.list(ROUND, |at| {
            // A multipoint may have each point in its own parentheses.
            let nested = name == "MULTIPOINT" && at.take(b'(');
            let position = position(at, chains)?;
            chains.point(position);
            if nested { at.expect(b')', "`)`") } else { Ok(()) }
        }),
        "LINESTRING" => chain(at, chains, Chain::Line),
        "MULTILINESTRING" => at.list(ROUND, |at| chain(at, chains, Chain::Line)),
        "POLYGON" => at.list(ROUND, |at| chain(at, chains, Chain::Ring)),
        "MULTIPOLYGON" => {
            at.list(ROUND, |at| if empty(at)? { Ok(()) } else { at.list(ROUND, |at| chain(at, chains, Chain::Ring)) })
        }
        _ if depth == DEEPEST => Err(at.fault("the collections are nested too deeply", "flatten them")),
        _ => {
            at.expect(b'(', "`(`")?;
            loop {
                geometry(r, depth + 1, notes)?;
                if !r.at.take(b',') {
                    return r.at.expect(b')', "`,` or `)`");
                }
            }
        }
    }
}

/// Goes past the word EMPTY if it is next.
fn empty(at: &mut Cursor) -> Result<bool, ReadError> {
    if !at.peek().is_some_and(|b| b.is_ascii_alphabetic()) {
        return Ok(false);
    }
    let word = at.run(|b| b.is_ascii_alphabetic());
    if word.eq_ignore_ascii_case("EMPTY") { Ok(true) } else { Err(at.wanted("`(` or EMPTY")) }
}

fn chain(at: &mut Cursor, chains: &mut Chains, kind: Chain) -> Result<(), ReadError> {
    if empty(at)? {
        return Ok(());
    }
    let mut positions = Vec::new();
    at.list(ROUND, |at| {
        positions.push(position(at, chains)?);
        Ok(())
    })?;
    check_chain(&positions, kind).map_err(|(problem, fix)| at.fault(problem, fix))?;
    chains.chain(&positions, kind);
    Ok(())
}

/// That a chain has the number of positions that its kind needs and that a ring is closed; else problem and fix.
pub(super) fn check_chain(positions: &[Position], kind: Chain) -> Result<(), (&'static str, &'static str)> {
    match (kind, positions) {
        (Chain::Line, [] | [_]) => {
            Err(("the polyline that ends here has fewer than 2 positions", "give it at least 2"))
        }
        (Chain::Line, _) => Ok(()),
        (Chain::Ring, [first, .., last]) if !same(first.point, last.point) => {
            Err(("the ring that ends here is not closed", "repeat its first position at its end"))
        }
        (Chain::Ring, _) if positions.len() < 4 => Err((
            "the ring that ends here has fewer than 4 positions",
            "give it at least 3 corners and repeat the first",
        )),
        (Chain::Ring, _) => Ok(()),
    }
}

fn position(at: &mut Cursor, chains: &mut Chains) -> Result<Position, ReadError> {
    at.skip_space();
    let line = at.line();
    let point = Point2::new(at.number()?, at.number()?);
    let mut more = 0;
    while at.peek().is_some_and(|b| b != b',' && b != b')') {
        if more == 2 {
            return Err(at.wanted("`,` or `)`"));
        }
        at.number()?;
        more += 1;
    }
    if more > 0 {
        chains.flattened(line);
    }
    Ok(Position { point, line })
}
