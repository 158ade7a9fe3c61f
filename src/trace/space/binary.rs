//! The binary form of the records of space.

use super::grammar::{SPECIAL, State3};
use super::record::{Apex, Bits, Counts3, End3, Event3, Header3, Record3, apex_id};
use crate::model::{Point3, Tetrahedron, VertexId, WeightedPoint};
use crate::trace::binary::decode::{Cursor, Fault};
use crate::trace::binary::encode::{put, put_digest, put_f64, put_signed};

/// Tags of records of space; all are 50 or above, hexadecimal.
pub(in crate::trace) mod tag {
    pub const HEADER: u8 = 0x50;
    pub const VERTEX: u8 = 0x51;
    pub const WEIGHT: u8 = 0x52;
    pub const START: u8 = 0x53;
    pub const SIMPLEX: u8 = 0x54;
    pub const END: u8 = 0x55;
    pub const GONE: u8 = 0x56;
    pub const INSERT: u8 = 0x60;
    pub const HIDE: u8 = 0x61;
    pub const DUPLICATE: u8 = 0x62;
    pub const REMOVE: u8 = 0x63;
    pub const SUCCEED: u8 = 0x64;
    pub const RAISE: u8 = 0x65;
    pub const LOWER: u8 = 0x66;
}

/// Appends the binary form of a record that `state` admits, the header without what precedes its tag; of an end all but the digest of the trace.
pub(in crate::trace) fn encode(record: &Record3, state: &State3, out: &mut Vec<u8>) {
    match record {
        Record3::Header(h) => {
            out.extend([tag::HEADER, u8::from(h.weighted) | u8::from(h.permuted) << 1]);
            put_signed(out, h.scale);
        }
        Record3::Vertex { point, input } => {
            out.push(tag::VERTEX);
            point.at.to_array().iter().for_each(|x| put_f64(out, *x));
            if state.weighted {
                put_f64(out, point.weight);
            }
            input.iter().for_each(|k| put(out, u64::from(*k)));
        }
        Record3::Weight { id, weight } => {
            out.push(tag::WEIGHT);
            put_id(out, *id, state.cursor);
            put_f64(out, *weight);
        }
        Record3::Remove { id } => {
            out.push(tag::GONE);
            put_id(out, *id, state.cursor);
        }
        Record3::Start { apexes, simplices } => {
            out.push(tag::START);
            put_apexes(out, apexes);
            put(out, u64::from(*simplices));
        }
        Record3::Simplex(t) => {
            out.push(tag::SIMPLEX);
            // Each id as its distance up from one before it: from the a of the simplex before, from a, from b, from b.
            let mut base = [first_of(state), t[0].0, t[1].0, t[1].0];
            for (v, base) in t.iter().zip(&mut base).take(state.size) {
                put(out, u64::from(v.0 - *base));
            }
        }
        Record3::Event(event) => put_event(out, event, state.cursor),
        Record3::End(end) => {
            out.push(tag::END);
            let c = &end.counts;
            [c.vertices, c.hidden, c.duplicates, c.removed, c.simplices].iter().for_each(|n| put(out, u64::from(*n)));
            put_digest(out, &end.mesh);
        }
    }
}

fn put_event(out: &mut Vec<u8>, event: &Event3, cursor: u32) {
    let placed = |out: &mut Vec<u8>, tag: u8, id: &VertexId| {
        out.push(tag);
        put(out, u64::from(cursor - id.0));
    };
    match event {
        Event3::Insert { id, first, flood } => {
            placed(out, tag::INSERT, id);
            first.iter().for_each(|v| put_id(out, *v, cursor));
            put(out, u64::from(flood.len()));
            out.extend_from_slice(flood.bytes());
        }
        Event3::Hide { id, cell } => {
            placed(out, tag::HIDE, id);
            cell.iter().for_each(|v| put_id(out, *v, cursor));
        }
        Event3::Duplicate { id, of } => {
            placed(out, tag::DUPLICATE, id);
            put_id(out, *of, cursor);
        }
        Event3::Remove { id, created } => {
            out.push(tag::REMOVE);
            put_id(out, *id, cursor);
            put(out, created.len() as u64);
            created.iter().for_each(|v| put_id(out, *v, cursor));
        }
        Event3::Succeed { id, by } => {
            out.push(tag::SUCCEED);
            put_id(out, *id, cursor);
            put_id(out, *by, cursor);
        }
        Event3::Raise { id, apexes } => {
            placed(out, tag::RAISE, id);
            put_apexes(out, apexes);
        }
        Event3::Lower { id, apexes } => {
            out.push(tag::LOWER);
            put_id(out, *id, cursor);
            put_apexes(out, apexes);
        }
    }
}

/// 0 the infinite vertex, 1 to 3 the apexes, then the points from the last one down.
fn put_id(out: &mut Vec<u8>, id: VertexId, cursor: u32) {
    let code = if id.0 >= SPECIAL { u32::MAX - id.0 } else { 4 + (cursor - 1 - id.0) };
    put(out, u64::from(code));
}

fn put_apexes(out: &mut Vec<u8>, apexes: &[Apex]) {
    out.push(apexes.len() as u8);
    out.extend(apexes.iter().map(|a| 2 * a.axis + u8::from(a.negative)));
}

fn first_of(state: &State3) -> u32 {
    state.previous.map_or(0, |t| t[0].0)
}

/// Decodes a record whose tag, not that of a header, was read.
pub(in crate::trace) fn decode(tag: u8, cursor: &mut Cursor, state: &State3) -> Result<Record3, Fault> {
    Ok(match tag {
        tag::VERTEX => {
            let at = Point3::new(cursor.f64()?, cursor.f64()?, cursor.f64()?);
            let weight = if state.weighted { cursor.f64()? } else { 0.0 };
            let input = if state.permuted { Some(cursor.u32()?) } else { None };
            Record3::Vertex { point: WeightedPoint { at, weight }, input }
        }
        tag::WEIGHT => Record3::Weight { id: id(cursor, state)?, weight: cursor.f64()? },
        tag::GONE => Record3::Remove { id: id(cursor, state)? },
        tag::START => Record3::Start { apexes: apexes(cursor)?, simplices: cursor.u32()? },
        tag::SIMPLEX => {
            let mut t: Tetrahedron = [0, 1, 2, 3].map(|k| apex_id(3u32.wrapping_sub(k)));
            for (k, v) in t.iter_mut().skip(state.size).enumerate() {
                *v = apex_id(k as u32);
            }
            let mut base = first_of(state);
            for k in 0..state.size {
                t[k] = cursor.above(base)?;
                base = t[k.min(1)].0;
            }
            Record3::Simplex(t)
        }
        tag::END => {
            let counts = Counts3 {
                vertices: cursor.u32()?,
                hidden: cursor.u32()?,
                duplicates: cursor.u32()?,
                removed: cursor.u32()?,
                simplices: cursor.u32()?,
            };
            Record3::End(End3 { counts, mesh: cursor.digest()?, trace: cursor.digest()? })
        }
        _ => Record3::Event(event(tag, cursor, state)?),
    })
}

/// Decodes a header whose tag was read.
pub(in crate::trace) fn header(cursor: &mut Cursor) -> Result<Header3, Fault> {
    let flags = cursor.byte()?;
    Ok(Header3 { weighted: flags & 1 == 1, permuted: flags & 2 == 2, scale: cursor.signed()? })
}

fn event(tag: u8, cursor: &mut Cursor, state: &State3) -> Result<Event3, Fault> {
    Ok(match tag {
        tag::INSERT => {
            let (id, first) = (placed(cursor, state)?, cell(cursor, state)?);
            let length = cursor.u32()?;
            let bytes = cursor.take(length.div_ceil(8) as usize)?.to_vec();
            let Some(flood) = Bits::from_bytes(bytes, length) else {
                return cursor.bad("a run of bits of another length");
            };
            Event3::Insert { id, first, flood }
        }
        tag::HIDE => Event3::Hide { id: placed(cursor, state)?, cell: cell(cursor, state)? },
        tag::DUPLICATE => Event3::Duplicate { id: placed(cursor, state)?, of: id(cursor, state)? },
        tag::REMOVE => {
            let removed = id(cursor, state)?;
            Event3::Remove { id: removed, created: cursor.list(1, |cursor| id(cursor, state))? }
        }
        tag::SUCCEED => Event3::Succeed { id: id(cursor, state)?, by: id(cursor, state)? },
        tag::RAISE => Event3::Raise { id: placed(cursor, state)?, apexes: apexes(cursor)? },
        tag::LOWER => Event3::Lower { id: id(cursor, state)?, apexes: apexes(cursor)? },
        _ => return cursor.bad("no record of space starts with this byte"),
    })
}

fn cell(cursor: &mut Cursor, state: &State3) -> Result<Tetrahedron, Fault> {
    Ok([id(cursor, state)?, id(cursor, state)?, id(cursor, state)?, id(cursor, state)?])
}

fn placed(cursor: &mut Cursor, state: &State3) -> Result<VertexId, Fault> {
    let down = cursor.u32()?;
    match state.cursor.checked_sub(down) {
        Some(id) => Ok(VertexId(id)),
        None => cursor.bad("a vertex id below zero"),
    }
}

fn id(cursor: &mut Cursor, state: &State3) -> Result<VertexId, Fault> {
    let code = cursor.u32()?;
    if code < 4 {
        return Ok(VertexId(u32::MAX - code));
    }
    match state.cursor.checked_sub(code - 3) {
        Some(id) => Ok(VertexId(id)),
        None => cursor.bad("a vertex id below zero"),
    }
}

fn apexes(cursor: &mut Cursor) -> Result<Vec<Apex>, Fault> {
    let count = usize::from(cursor.byte()?);
    let mut list = Vec::new();
    for _ in 0..count {
        list.push(cursor.choice(&Apex::ALL)?);
    }
    Ok(list)
}
