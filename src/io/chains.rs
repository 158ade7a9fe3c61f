//! Builds a planar straight line graph from rings and polylines whose points are repeated: the common ground of WKT and GeoJSON.
//!
//! Equal points become one vertex, numbered by first appearance; equal edges become one segment. Interiors follow the even-odd rule:
//! an edge toggles between inside and outside if it occurs an odd number of times among all rings. So holes are holes, a polygon in a hole is
//! filled, and polygons that share an edge are both filled with the edge between them kept as a segment. Polygons that overlap cancel where they do.
//! Without any ring there is no inside to toggle, and the graph is filled as a `.poly` would be.

use super::rows::{MOST_ELEMENTS, text};
use super::{Input, Note, NoteKind, ReadError};
use crate::model::words::counted;
use crate::model::{Fill, Point2, Segment, VertexId};
use std::collections::BTreeMap;

/// A point of a chain and the line where it stood.
#[derive(Clone, Copy)]
pub(super) struct Position {
    pub(super) point: Point2,
    pub(super) line: u32,
}

/// How a run of positions is meant.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Chain {
    /// An open or closed polyline that bounds nothing.
    Line,
    /// The border of a polygon or of a hole; the last position equals the first.
    Ring,
}

/// A graph in the making.
#[derive(Default)]
pub(super) struct Chains {
    input: Input,
    ids: BTreeMap<[u64; 2], VertexId>,
    segments: BTreeMap<[VertexId; 2], usize>,
    merged: Tally,
    doubled: Tally,
    zero: Tally,
    flattened: Tally,
}

/// How often something happened and where first.
#[derive(Default)]
struct Tally {
    count: u64,
    line: u32,
}

impl Tally {
    fn add(&mut self, line: u32) {
        if self.count == 0 {
            self.line = line;
        }
        self.count += 1;
    }
}

/// The text of a file of nested lists. A point takes at least 4 bytes, so that the largest file allowed has fewer than 2^31 points.
pub(super) fn text_of_chains<'a>(part: &'static str, bytes: &'a [u8]) -> Result<&'a str, ReadError> {
    if bytes.len() as u64 > 4 * MOST_ELEMENTS {
        let problem = format!("the file has {}", counted(bytes.len(), "byte"));
        return Err(ReadError {
            part,
            problem,
            fix: format!("the limit is {}", 4 * MOST_ELEMENTS),
            ..ReadError::default()
        });
    }
    text(part, bytes)
}

/// Whether two points are the same. Readers leave no minus zero, so that equal coordinates are equal bits.
pub(super) fn same(a: Point2, b: Point2) -> bool {
    bits(a) == bits(b)
}

fn bits(p: Point2) -> [u64; 2] {
    [p.x.to_bits(), p.y.to_bits()]
}

impl Chains {
    /// A point of its own.
    pub(super) fn point(&mut self, at: Position) {
        let known = self.input.pslg.points.len();
        if self.vertex(at).index() < known {
            self.merged.add(at.line);
        }
    }

    /// That a position had more than two coordinates.
    pub(super) fn flattened(&mut self, line: u32) {
        self.flattened.add(line);
    }

    /// A run of positions joined by segments.
    pub(super) fn chain(&mut self, positions: &[Position], chain: Chain) {
        if chain == Chain::Ring {
            self.input.pslg.fill = Fill::Parity;
        }
        let mut last = None;
        for (k, &at) in positions.iter().enumerate() {
            let known = self.input.pslg.points.len();
            let id = self.vertex(at);
            let closes = k > 0 && k + 1 == positions.len() && same(at.point, positions[0].point);
            if id.index() < known && !closes && last != Some(id) {
                self.merged.add(at.line);
            }
            if let Some(from) = last {
                self.segment(from, id, chain, at.line);
            }
            last = Some(id);
        }
    }

    fn vertex(&mut self, at: Position) -> VertexId {
        let points = &mut self.input.pslg.points;
        // `text_of_chains` keeps the number of points below 2^31.
        let next = VertexId(points.len() as u32);
        let id = *self.ids.entry(bits(at.point)).or_insert(next);
        if id == next {
            points.push(at.point);
            self.input.lines.points.push(at.line);
        }
        id
    }

    fn segment(&mut self, a: VertexId, b: VertexId, chain: Chain, line: u32) {
        if a == b {
            self.zero.add(line);
            return;
        }
        let segments = &mut self.input.pslg.segments;
        let next = segments.len();
        let at = *self.segments.entry([a.min(b), a.max(b)]).or_insert(next);
        if at == next {
            segments.push(Segment { ends: [a, b], marker: 0, toggles: false });
            self.input.lines.segments.push(line);
        } else {
            self.doubled.add(line);
        }
        segments[at].toggles ^= chain == Chain::Ring;
    }

    /// The graph, with notes on what was merged.
    pub(super) fn finish(mut self) -> Input {
        let tallies = [
            (NoteKind::Repair, self.merged, "points merged with an earlier equal one"),
            (NoteKind::Repair, self.doubled, "segments merged with an earlier equal one"),
            (NoteKind::Repair, self.zero, "segments with equal ends, dropped"),
            (NoteKind::Note, self.flattened, "positions with more than two coordinates, of which x and y are used"),
        ];
        for (kind, tally, what) in tallies {
            if tally.count > 0 {
                self.input.notes.push(Note { kind, line: tally.line, text: format!("{what}: {}", tally.count) });
            }
        }
        self.input
    }
}
