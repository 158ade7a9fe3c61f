//! Records to bytes.

use super::*;
use crate::model::{GcdrParameters, Point2, Region, Segment, Triangle, VertexId};
use crate::trace::record::{Algorithm, Cause, End, Event, Header, Record, Shell, SkipReason, SplitKind, Why};
use crate::trace::space;

/// Appends the binary form of a record that `state` admits; of an end, all but the digest of the trace.
pub(in crate::trace) fn encode(record: &Record, state: &State, out: &mut Vec<u8>) {
    match record {
        Record::Header(header) => put_header(out, header),
        Record::Vertex { at, marker, attributes } => {
            out.push(if marker.is_some() { tag::VERTEX_MARKED } else { tag::VERTEX });
            put_point(out, *at);
            if let Some(marker) = marker {
                put_signed(out, *marker);
            }
            put(out, attributes.len() as u64);
            attributes.iter().for_each(|a| put_f64(out, *a));
        }
        Record::Segment(Segment { ends, marker, toggles }) => {
            out.push(if *toggles { tag::SEGMENT_TOGGLES } else { tag::SEGMENT });
            ends.iter().for_each(|v| put(out, u64::from(v.0)));
            put_signed(out, *marker);
        }
        Record::Hole(at) => {
            out.push(tag::HOLE);
            put_point(out, *at);
        }
        Record::Region(Region { seed, attribute, max_area }) => {
            out.push(if max_area.is_some() { tag::REGION_BOUNDED } else { tag::REGION });
            put_point(out, *seed);
            put_f64(out, *attribute);
            max_area.iter().for_each(|a| put_f64(out, *a));
        }
        Record::Start { triangles } => {
            out.push(tag::START);
            put(out, u64::from(*triangles));
        }
        Record::Triangle([a, b, c]) => {
            out.push(tag::TRIANGLE);
            put(out, u64::from(a.0 - first_of(state)));
            put(out, u64::from(b.0 - a.0));
            put(out, u64::from(c.0 - a.0));
        }
        Record::Event(event) => put_event(out, event, state.next),
        Record::End(end) => put_end(out, end),
        Record::Space(record) => {
            if let space::Record3::Header(_) = record {
                out.extend_from_slice(&MAGIC);
                out.push(VERSION);
            }
            space::binary::encode(record, &state.space, out);
        }
    }
}

fn put_event(out: &mut Vec<u8>, event: &Event, next: u32) {
    match event {
        Event::Insert { p, why: Why::Free { cause }, destroyed } => {
            put_cause(out, tag::FREE, cause);
            put_point(out, *p);
            put_triangles(out, destroyed, next);
        }
        Event::Insert { p, why: Why::Split { kind, s, t, cause, a, shell }, destroyed } => {
            let c = if let SplitKind::C { .. } = kind { tag::TYPE_C } else { 0 };
            let on_shell = if shell.is_some() { tag::SHELL } else { 0 };
            put_cause(out, tag::SPLIT | c | on_shell, cause);
            put_point(out, *p);
            s.iter().for_each(|v| put_id(out, *v, next));
            put_triangle(out, *t, next);
            put_point(out, *a);
            if let SplitKind::C { parent } = kind {
                put_id(out, *parent, next);
            }
            if let Some(Shell { apex, k }) = shell {
                put_id(out, *apex, next);
                put_signed(out, *k);
            }
            put_triangles(out, destroyed, next);
        }
        Event::Remove { id, created } => {
            out.push(tag::REMOVE);
            put_id(out, *id, next);
            put_triangles(out, created, next);
        }
        Event::Skip { t, cause, reason } => {
            let number = match reason {
                SkipReason::Resolution => 0,
                SkipReason::InputAngle { .. } => 1,
                SkipReason::SplitLimit { .. } => 2,
            };
            put_cause(out, tag::SKIP | number << 2, cause);
            put_triangle(out, *t, next);
            match reason {
                SkipReason::Resolution => {}
                SkipReason::InputAngle { apex } => put_id(out, *apex, next),
                SkipReason::SplitLimit { segment } => put(out, u64::from(segment.0)),
            }
        }
    }
}

fn put_cause(out: &mut Vec<u8>, tag: u8, cause: &Cause) {
    match cause {
        Cause::Skinny => out.push(tag),
        Cause::Area => out.push(tag | 1),
        Cause::Size { h } => {
            out.push(tag | 2);
            put_f64(out, *h);
        }
    }
}

fn put_triangles(out: &mut Vec<u8>, triangles: &[Triangle], next: u32) {
    put(out, triangles.len() as u64);
    for (i, t) in triangles.iter().enumerate() {
        match triangles[..i]
            .iter()
            .rev()
            .take(LOOKBACK)
            .zip(0u8..)
            .find_map(|(earlier, back)| shared(*earlier, *t).map(|s| (back, s)))
        {
            // 1 + 3 * 41 + 2 = 126 at most.
            Some((back, (edge, apex))) => {
                out.push(1 + 3 * back + edge);
                put_id(out, apex, next);
            }
            None => {
                if i > 0 {
                    out.push(0);
                }
                put_triangle(out, *t, next);
            }
        }
    }
}

/// The first edge of `earlier` that `t` has reversed, and the corner of `t` off it.
fn shared(earlier: Triangle, t: Triangle) -> Option<(u8, VertexId)> {
    let [a, b, c] = earlier;
    for (edge, (x, y)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
        for (from, to, apex) in [(t[0], t[1], t[2]), (t[1], t[2], t[0]), (t[2], t[0], t[1])] {
            if from == y && to == x {
                return Some((edge as u8, apex));
            }
        }
    }
    None
}

fn put_triangle(out: &mut Vec<u8>, t: Triangle, next: u32) {
    t.iter().for_each(|v| put_id(out, *v, next));
}

fn put_id(out: &mut Vec<u8>, id: VertexId, next: u32) {
    put(out, u64::from(next - 1 - id.0));
}

fn put_header(out: &mut Vec<u8>, header: &Header) {
    out.extend_from_slice(&MAGIC);
    out.push(VERSION);
    out.push(tag::HEADER);
    put_choice(out, &LEVELS, header.level);
    put_choice(out, &FILLS, header.fill);
    match &header.algorithm {
        Algorithm::Delaunay => out.push(0),
        Algorithm::Gcdr(parameters) => {
            out.push(1);
            put_parameters(out, parameters);
        }
    }
}

fn put_parameters(out: &mut Vec<u8>, p: &GcdrParameters) {
    [p.rho2, p.d1, p.d2, p.mu].into_iter().for_each(|x| put_f64(out, x));
    put_choice(out, &DISK_CHOICES, p.choice_a);
    put_choice(out, &CHOICES, p.choice_b);
    put_choice(out, &CHOICES, p.choice_c);
    put_choice(out, &ORDERS, p.order);
    put_choice(out, &DELETIONS, p.deletion);
    put_choice(out, &SMALL_ANGLES, p.small_angles);
    let present = [
        p.kappa.is_some(),
        p.extreme.is_some(),
        p.seed.is_some(),
        p.max_area.is_some(),
        p.size_function,
        p.max_splits.is_some(),
    ];
    out.push(present.iter().rev().fold(0, |bits, &b| bits << 1 | u8::from(b)));
    p.kappa.iter().for_each(|x| put_f64(out, *x));
    p.extreme.iter().for_each(|x| put_choice(out, &VERTICES, *x));
    p.seed.iter().for_each(|x| put(out, *x));
    p.max_area.iter().for_each(|x| put_f64(out, *x));
    p.max_splits.iter().for_each(|x| put(out, u64::from(*x)));
}

fn put_end(out: &mut Vec<u8>, end: &End) {
    out.push(tag::END);
    put_choice(out, &OUTCOMES, end.outcome);
    put_choice(out, &LEVELS, end.level_effective);
    match &end.stop_reason {
        None => out.push(0),
        Some(reason) => {
            out.push(1);
            put(out, reason.len() as u64);
            out.extend_from_slice(reason.as_bytes());
        }
    }
    let c = &end.counts;
    [c.vertices, c.triangles, c.type_a, c.type_b, c.type_c, c.removed, c.unmet]
        .into_iter()
        .for_each(|n| put(out, u64::from(n)));
    put_digest(out, &end.mesh);
}

/// Appends the bytes of 64 hexadecimal digits.
pub(in crate::trace) fn put_digest(out: &mut Vec<u8>, hex: &str) {
    let value = |b: u8| {
        if b.is_ascii_digit() { b - b'0' } else { b - b'a' + 10 }
    };
    out.extend(hex.as_bytes().chunks_exact(2).map(|pair| value(pair[0]) << 4 | value(pair[1])));
}

fn put_choice<T: PartialEq>(out: &mut Vec<u8>, all: &[T], one: T) {
    // The tables above list every variant.
    let number = all.iter().position(|x| *x == one).expect("a variant missing from its table");
    out.push(number as u8);
}

fn put_point(out: &mut Vec<u8>, p: Point2) {
    put_f64(out, p.x);
    put_f64(out, p.y);
}

pub(in crate::trace) fn put_f64(out: &mut Vec<u8>, x: f64) {
    out.extend_from_slice(&x.to_bits().to_le_bytes());
}

pub(in crate::trace) fn put_signed(out: &mut Vec<u8>, x: i32) {
    put(out, u64::from((x << 1 ^ x >> 31) as u32));
}

pub(in crate::trace) fn put(out: &mut Vec<u8>, mut x: u64) {
    while x >= 0x80 {
        out.push(x as u8 | 0x80);
        x >>= 7;
    }
    out.push(x as u8);
}
