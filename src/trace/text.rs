//! The text form: one JSON object a line. Normative text: `docs/trace-format.md`, "Text form".
//!
//! Written by hand, since keys have a fixed order and floats one spelling. Read through a JSON parser that forgives spacing, order and
//! spelling; the reader then writes what it understood and accepts only the same bytes.

use super::grammar::State;
use super::record::{Algorithm, Cause, Counts, End, Event, Header, Outcome, Record, Shell, SkipReason, SplitKind, Why};
use super::space;
use crate::model::{Edge, GcdrParameters, Point2, Region, Segment, SegmentId, Triangle, VertexId};
use serde::Serialize;
use serde_json::{Map, Value, ser::Formatter};
use std::fmt::Write as _;
use std::io;

/// Appends the line of a record, with its line feed.
pub(super) fn encode(record: &Record, state: &State, out: &mut String) {
    match record {
        Record::Header(header) => put_header(out, header),
        Record::Vertex { at, marker, attributes } => {
            out.push_str("{\"vertex\":");
            put_point(out, *at);
            if let Some(marker) = marker {
                put(out, format_args!(",\"marker\":{marker}"));
            }
            if !attributes.is_empty() {
                out.push_str(",\"attributes\":");
                put_list(out, attributes, |out, a| put_f64(out, *a));
            }
            out.push_str("}\n");
        }
        Record::Segment(Segment { ends, marker, toggles }) => {
            out.push_str("{\"segment\":");
            put_ids(out, ends);
            put(out, format_args!(",\"marker\":{marker},\"toggles\":{toggles}}}\n"));
        }
        Record::Hole(at) => {
            out.push_str("{\"hole\":");
            put_point(out, *at);
            out.push_str("}\n");
        }
        Record::Region(Region { seed, attribute, max_area }) => {
            out.push_str("{\"region\":");
            put_point(out, *seed);
            out.push_str(",\"attribute\":");
            put_f64(out, *attribute);
            if let Some(max_area) = max_area {
                out.push_str(",\"max_area\":");
                put_f64(out, *max_area);
            }
            out.push_str("}\n");
        }
        Record::Start { triangles } => put(out, format_args!("{{\"start\":{triangles}}}\n")),
        Record::Triangle(t) => {
            out.push_str("{\"triangle\":");
            put_ids(out, t);
            out.push_str("}\n");
        }
        Record::Event(event) => put_event(out, event, state.events),
        Record::End(end) => put_end(out, end),
        Record::Space(record) => {
            if let space::Record3::Header(_) = record {
                put_format(out);
            }
            space::text::encode(record, state.events, state.space.size, out);
        }
    }
}

/// The keys that every header starts with.
fn put_format(out: &mut String) {
    put(out, format_args!("{{\"format\":\"orthoball-trace\",\"version\":{}", super::binary::VERSION));
}

fn put_header(out: &mut String, header: &Header) {
    put_format(out);
    match &header.algorithm {
        Algorithm::Delaunay => out.push_str(",\"algorithm\":\"delaunay\""),
        Algorithm::Gcdr(parameters) => {
            out.push_str(",\"algorithm\":\"gcdr\",\"parameters\":");
            put_json(out, parameters);
        }
    }
    if let Some(level) = header.level {
        out.push_str(",\"level\":");
        put_json(out, &level);
    }
    out.push_str(",\"fill\":");
    put_json(out, &header.fill);
    out.push_str("}\n");
}

fn put_event(out: &mut String, event: &Event, number: u64) {
    match event {
        Event::Insert { p, why, destroyed } => {
            put(out, format_args!("{{\"i\":{number},\"event\":\"insert\",\"why\":"));
            put_why(out, why);
            out.push_str(",\"p\":");
            put_point(out, *p);
            out.push_str(",\"destroyed\":");
            put_list(out, destroyed, |out, t| put_ids(out, t));
        }
        Event::Remove { id, created } => {
            put(out, format_args!("{{\"i\":{number},\"event\":\"remove\",\"id\":{},\"created\":", id.0));
            put_list(out, created, |out, t| put_ids(out, t));
        }
        Event::Skip { t, cause, reason } => {
            put(out, format_args!("{{\"i\":{number},\"event\":\"skip\",\"t\":"));
            put_ids(out, t);
            put_cause(out, cause);
            match reason {
                SkipReason::Resolution => out.push_str(",\"reason\":\"resolution\""),
                SkipReason::InputAngle { apex } => {
                    put(out, format_args!(",\"reason\":\"input-angle\",\"apex\":{}", apex.0))
                }
                SkipReason::SplitLimit { segment } => {
                    put(out, format_args!(",\"reason\":\"split-limit\",\"segment\":{}", segment.0))
                }
            }
        }
    }
    out.push_str("}\n");
}

fn put_why(out: &mut String, why: &Why) {
    match why {
        Why::Free { cause } => {
            out.push_str("{\"type\":\"A\"");
            put_cause(out, cause);
        }
        Why::Split { kind, s, t, cause, a, shell } => {
            match kind {
                SplitKind::B => out.push_str("{\"type\":\"B\",\"s\":"),
                SplitKind::C { parent } => put(out, format_args!("{{\"type\":\"C\",\"parent\":{},\"s\":", parent.0)),
            }
            put_ids(out, s);
            out.push_str(",\"t\":");
            put_ids(out, t);
            put_cause(out, cause);
            out.push_str(",\"a\":");
            put_point(out, *a);
            if let Some(Shell { apex, k }) = shell {
                put(out, format_args!(",\"shell\":{{\"apex\":{},\"k\":{k}}}", apex.0));
            }
        }
    }
    out.push('}');
}

fn put_cause(out: &mut String, cause: &Cause) {
    match cause {
        Cause::Skinny => out.push_str(",\"cause\":\"skinny\""),
        Cause::Area => out.push_str(",\"cause\":\"area\""),
        Cause::Size { h } => {
            out.push_str(",\"cause\":\"size\",\"h\":");
            put_f64(out, *h);
        }
    }
}

fn put_end(out: &mut String, end: &End) {
    put(out, format_args!("{{\"event\":\"end\",\"outcome\":\"{}\"", outcome_name(end.outcome)));
    if let Some(reason) = &end.stop_reason {
        out.push_str(",\"stop_reason\":");
        put_json(out, reason);
    }
    if let Some(level) = &end.level_effective {
        out.push_str(",\"level_effective\":");
        put_json(out, level);
    }
    let Counts { vertices, triangles, type_a, type_b, type_c, removed, unmet } = end.counts;
    put(out, format_args!(",\"counts\":{{\"vertices\":{vertices},\"triangles\":{triangles},\"type_a\":{type_a}"));
    put(out, format_args!(",\"type_b\":{type_b},\"type_c\":{type_c},\"removed\":{removed},\"unmet\":{unmet}}}"));
    put(out, format_args!(",\"mesh\":\"{}\",\"trace\":\"{}\"}}\n", end.mesh, end.trace));
}

/// The name of an outcome in traces and reports.
pub(super) fn outcome_name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Complete => "complete",
        Outcome::Holey => "holey",
        Outcome::Stopped => "stopped",
    }
}

fn put_point(out: &mut String, p: Point2) {
    out.push('[');
    put_f64(out, p.x);
    out.push(',');
    put_f64(out, p.y);
    out.push(']');
}

fn put_ids(out: &mut String, ids: &[VertexId]) {
    put_list(out, ids, |out, v| put(out, format_args!("{}", v.0)));
}

pub(super) fn put_list<T>(out: &mut String, list: &[T], mut one: impl FnMut(&mut String, &T)) {
    out.push('[');
    for (i, x) in list.iter().enumerate() {
        if i > 0 {
            out.push(',');
        }
        one(out, x);
    }
    out.push(']');
}

/// The shortest decimal that reads back as `x`; see the normative text for its spelling.
pub(super) fn put_f64(out: &mut String, x: f64) {
    put(out, format_args!("{x:?}"));
}

pub(super) fn put(out: &mut String, what: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    out.write_fmt(what).expect("a string takes all");
}

/// Appends plain data as JSON whose floats are spelled as ours.
fn put_json(out: &mut String, value: &impl Serialize) {
    struct Spelling;
    impl Formatter for Spelling {
        fn write_f64<W: ?Sized + io::Write>(&mut self, out: &mut W, x: f64) -> io::Result<()> {
            write!(out, "{x:?}")
        }
    }
    let mut bytes = Vec::new();
    // Plain structs, enums and strings have a JSON form, and a vector takes all.
    value.serialize(&mut serde_json::Serializer::with_formatter(&mut bytes, Spelling)).expect("plain data");
    // serde_json writes UTF-8 only.
    out.push_str(std::str::from_utf8(&bytes).expect("JSON is UTF-8"));
}

pub(super) type Refusal = String;

/// Decodes a line, its line feed taken off.
pub(super) fn decode(line: &[u8], state: &State) -> Result<Record, Refusal> {
    let value: Value = serde_json::from_slice(line).map_err(|e| format!("not JSON: {e}"))?;
    let Value::Object(object) = value else {
        return Err("not a JSON object".into());
    };
    let o = Object(object);
    if o.has("format") {
        return header(&o);
    }
    if !state.space.is_fresh() {
        return space::text::decode(&o).map(Record::Space);
    }
    if o.has("event") {
        return event(&o);
    }
    if o.has("vertex") {
        let marker = if o.has("marker") { Some(o.get("marker")?) } else { None };
        let attributes = if o.has("attributes") { o.get("attributes")? } else { Vec::new() };
        return Ok(Record::Vertex { at: o.point("vertex")?, marker, attributes });
    }
    if o.has("segment") {
        let ends: Edge = o.get("segment")?;
        return Ok(Record::Segment(Segment { ends, marker: o.get("marker")?, toggles: o.get("toggles")? }));
    }
    if o.has("hole") {
        return Ok(Record::Hole(o.point("hole")?));
    }
    if o.has("region") {
        let max_area = if o.has("max_area") { Some(o.get("max_area")?) } else { None };
        return Ok(Record::Region(Region { seed: o.point("region")?, attribute: o.get("attribute")?, max_area }));
    }
    if o.has("start") {
        return Ok(Record::Start { triangles: o.get("start")? });
    }
    if o.has("triangle") {
        return Ok(Record::Triangle(o.get("triangle")?));
    }
    Err("no record has these keys".into())
}

fn header(o: &Object) -> Result<Record, Refusal> {
    if o.get::<String>("format")? != "orthoball-trace" {
        return Err("not a trace: `format` is not \"orthoball-trace\"".into());
    }
    let version: u64 = o.get("version")?;
    if version != u64::from(super::binary::VERSION) {
        return Err(format!("version {version} of the format; this program reads version {}", super::binary::VERSION));
    }
    let algorithm = match o.get::<String>("algorithm")?.as_str() {
        "delaunay" => Algorithm::Delaunay,
        "gcdr" => Algorithm::Gcdr(o.get::<GcdrParameters>("parameters")?),
        "regular" => return Ok(Record::Space(space::Record3::Header(space::text::header(o)?))),
        other => return Err(format!("algorithm {other:?} is not known")),
    };
    let level = if o.has("level") { Some(o.get("level")?) } else { None };
    Ok(Record::Header(Header { algorithm, level, fill: o.get("fill")? }))
}

fn event(o: &Object) -> Result<Record, Refusal> {
    let event = match o.get::<String>("event")?.as_str() {
        "insert" => {
            let Some(Value::Object(why_object)) = o.0.get("why") else {
                return Err("`why` is not an object".into());
            };
            let destroyed: Vec<Triangle> = o.get("destroyed")?;
            Event::Insert { p: o.point("p")?, why: why(&Object(why_object.clone()))?, destroyed }
        }
        "remove" => Event::Remove { id: o.get("id")?, created: o.get("created")? },
        "skip" => {
            let reason = match o.get::<String>("reason")?.as_str() {
                "resolution" => SkipReason::Resolution,
                "input-angle" => SkipReason::InputAngle { apex: o.get("apex")? },
                "split-limit" => SkipReason::SplitLimit { segment: SegmentId(o.get("segment")?) },
                other => return Err(format!("reason {other:?} is not known")),
            };
            Event::Skip { t: o.get("t")?, cause: cause(o)?, reason }
        }
        "end" => return end(o).map(Record::End),
        other => return Err(format!("event {other:?} is not known")),
    };
    Ok(Record::Event(event))
}

fn why(o: &Object) -> Result<Why, Refusal> {
    let kind = match o.get::<String>("type")?.as_str() {
        "A" => return Ok(Why::Free { cause: cause(o)? }),
        "B" => SplitKind::B,
        "C" => SplitKind::C { parent: o.get("parent")? },
        other => return Err(format!("type {other:?} is not known")),
    };
    let shell = match o.0.get("shell") {
        None => None,
        Some(Value::Object(shell)) => {
            let shell = Object(shell.clone());
            Some(Shell { apex: shell.get("apex")?, k: shell.get("k")? })
        }
        Some(_) => return Err("`shell` is not an object".into()),
    };
    Ok(Why::Split { kind, s: o.get("s")?, t: o.get("t")?, cause: cause(o)?, a: o.point("a")?, shell })
}

fn cause(o: &Object) -> Result<Cause, Refusal> {
    match o.get::<String>("cause")?.as_str() {
        "skinny" => Ok(Cause::Skinny),
        "area" => Ok(Cause::Area),
        "size" => Ok(Cause::Size { h: o.get("h")? }),
        other => Err(format!("cause {other:?} is not known")),
    }
}

fn end(o: &Object) -> Result<End, Refusal> {
    let outcome = match o.get::<String>("outcome")?.as_str() {
        "complete" => Outcome::Complete,
        "holey" => Outcome::Holey,
        "stopped" => Outcome::Stopped,
        other => return Err(format!("outcome {other:?} is not known")),
    };
    let Some(Value::Object(counts)) = o.0.get("counts") else {
        return Err("`counts` is not an object".into());
    };
    let c = Object(counts.clone());
    Ok(End {
        outcome,
        stop_reason: if o.has("stop_reason") { Some(o.get("stop_reason")?) } else { None },
        level_effective: if o.has("level_effective") { Some(o.get("level_effective")?) } else { None },
        counts: Counts {
            vertices: c.get("vertices")?,
            triangles: c.get("triangles")?,
            type_a: c.get("type_a")?,
            type_b: c.get("type_b")?,
            type_c: c.get("type_c")?,
            removed: c.get("removed")?,
            unmet: c.get("unmet")?,
        },
        mesh: o.get("mesh")?,
        trace: o.get("trace")?,
    })
}

/// A JSON object with typed look-up.
pub(super) struct Object(Map<String, Value>);

impl Object {
    pub(super) fn has(&self, key: &str) -> bool {
        self.0.contains_key(key)
    }

    pub(super) fn get<T: serde::de::DeserializeOwned>(&self, key: &str) -> Result<T, Refusal> {
        let value = self.0.get(key).ok_or_else(|| format!("`{key}` is missing"))?;
        T::deserialize(value).map_err(|e| format!("`{key}`: {e}"))
    }

    /// The object under a key.
    pub(super) fn object(&self, key: &str) -> Result<Object, Refusal> {
        match self.0.get(key) {
            Some(Value::Object(o)) => Ok(Object(o.clone())),
            _ => Err(format!("`{key}` is not an object")),
        }
    }

    fn point(&self, key: &str) -> Result<Point2, Refusal> {
        self.get::<[f64; 2]>(key).map(Point2::from_array)
    }
}
