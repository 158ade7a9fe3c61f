//! The text form of the records of space.

use super::grammar::SPECIAL;
use super::record::{Apex, Bits, Counts3, End3, Event3, Header3, Record3, apex_id};
use crate::model::{Point3, Tetrahedron, VertexId, WeightedPoint};
use crate::trace::text::{Object, Refusal, put, put_f64, put_list};

/// Appends the line of a record. The header's first keys are the caller's.
pub(in crate::trace) fn encode(record: &Record3, number: u64, size: usize, out: &mut String) {
    match record {
        Record3::Header(Header3 { weighted, permuted, scale }) => {
            put(out, format_args!(",\"algorithm\":\"regular\",\"weighted\":{weighted},\"permuted\":{permuted}"));
            put(out, format_args!(",\"scale\":{scale}}}\n"));
        }
        Record3::Vertex { point, input } => {
            out.push_str("{\"vertex\":");
            put_list(out, &point.at.to_array(), |out, x| put_f64(out, *x));
            if point.weight.to_bits() != 0 {
                out.push_str(",\"weight\":");
                put_f64(out, point.weight);
            }
            if let Some(k) = input {
                put(out, format_args!(",\"input\":{k}"));
            }
            out.push_str("}\n");
        }
        Record3::Weight { id, weight } => {
            out.push_str("{\"weight\":");
            put_f64(out, *weight);
            put(out, format_args!(",\"id\":{}}}\n", id.0));
        }
        Record3::Remove { id } => put(out, format_args!("{{\"remove\":{}}}\n", id.0)),
        Record3::Start { apexes, simplices } => {
            put(out, format_args!("{{\"start\":{simplices}"));
            if !apexes.is_empty() {
                out.push_str(",\"apexes\":");
                put_list(out, apexes, put_apex);
            }
            out.push_str("}\n");
        }
        Record3::Simplex(t) => {
            out.push_str("{\"simplex\":");
            put_ids(out, &t[..size]);
            out.push_str("}\n");
        }
        Record3::Event(event) => put_event(out, event, number),
        Record3::End(End3 { counts, mesh, trace }) => {
            let Counts3 { vertices, hidden, duplicates, removed, simplices } = counts;
            put(out, format_args!("{{\"event\":\"end\",\"counts\":{{\"vertices\":{vertices},\"hidden\":{hidden}"));
            put(out, format_args!(",\"duplicates\":{duplicates},\"removed\":{removed},\"simplices\":{simplices}}}"));
            put(out, format_args!(",\"mesh\":\"{mesh}\",\"trace\":\"{trace}\"}}\n"));
        }
    }
}

fn put_event(out: &mut String, event: &Event3, number: u64) {
    let mut head = |name: &str, id: VertexId| {
        put(out, format_args!("{{\"i\":{number},\"event\":\"{name}\",\"id\":{}", id.0));
    };
    match event {
        Event3::Insert { id, first, flood } => {
            head("insert", *id);
            out.push_str(",\"first\":");
            put_ids(out, first);
            out.push_str(",\"flood\":\"");
            (0..flood.len()).for_each(|k| out.push(if flood.get(k) == Some(true) { '1' } else { '0' }));
            out.push('"');
        }
        Event3::Hide { id, cell } => {
            head("hide", *id);
            out.push_str(",\"cell\":");
            put_ids(out, cell);
        }
        Event3::Duplicate { id, of } => {
            head("duplicate", *id);
            put(out, format_args!(",\"of\":{}", of.0));
        }
        Event3::Remove { id, created } => {
            head("remove", *id);
            out.push_str(",\"created\":");
            put_ids(out, created);
        }
        Event3::Succeed { id, by } => {
            head("succeed", *id);
            put(out, format_args!(",\"by\":{}", by.0));
        }
        Event3::Raise { id, apexes } => {
            head("raise", *id);
            out.push_str(",\"apexes\":");
            put_list(out, apexes, put_apex);
        }
        Event3::Lower { id, apexes } => {
            head("lower", *id);
            out.push_str(",\"apexes\":");
            put_list(out, apexes, put_apex);
        }
    }
    out.push_str("}\n");
}

/// Ids; -1 is the infinite vertex, -2 to -4 are the apexes.
fn put_ids(out: &mut String, ids: &[VertexId]) {
    put_list(out, ids, |out, v| put(out, format_args!("{}", v.0 as i32)));
}

fn put_apex(out: &mut String, apex: &Apex) {
    out.push_str(NAMES[Apex::ALL.iter().position(|a| a == apex).unwrap_or(0)]);
}

const NAMES: [&str; 6] = ["\"+x\"", "\"-x\"", "\"+y\"", "\"-y\"", "\"+z\"", "\"-z\""];

/// Decodes a header.
pub(in crate::trace) fn header(o: &Object) -> Result<Header3, Refusal> {
    Ok(Header3 { weighted: o.get("weighted")?, permuted: o.get("permuted")?, scale: o.get("scale")? })
}

/// Decodes a line other than the header.
pub(in crate::trace) fn decode(o: &Object) -> Result<Record3, Refusal> {
    if o.has("event") {
        return event(o);
    }
    if o.has("vertex") {
        let at = Point3::from_array(o.get("vertex")?);
        let weight = if o.has("weight") { o.get("weight")? } else { 0.0 };
        let input = if o.has("input") { Some(o.get("input")?) } else { None };
        return Ok(Record3::Vertex { point: WeightedPoint { at, weight }, input });
    }
    if o.has("weight") {
        return Ok(Record3::Weight { id: o.get("id")?, weight: o.get("weight")? });
    }
    if o.has("remove") {
        return Ok(Record3::Remove { id: o.get("remove")? });
    }
    if o.has("start") {
        let apexes = if o.has("apexes") { apexes(o)? } else { Vec::new() };
        return Ok(Record3::Start { apexes, simplices: o.get("start")? });
    }
    if o.has("simplex") {
        let ids = ids(o, "simplex")?;
        let mut t: Tetrahedron = [apex_id(0); 4];
        if ids.is_empty() || ids.len() > 4 {
            return Err("`simplex` has no id, or more than four".into());
        }
        t[..ids.len()].copy_from_slice(&ids);
        t[ids.len()..].iter_mut().zip(0..).for_each(|(v, k)| *v = apex_id(k));
        return Ok(Record3::Simplex(t));
    }
    Err("no record of space has these keys".into())
}

fn event(o: &Object) -> Result<Record3, Refusal> {
    let kind: String = o.get("event")?;
    if kind == "end" {
        let c = o.object("counts")?;
        let counts = Counts3 {
            vertices: c.get("vertices")?,
            hidden: c.get("hidden")?,
            duplicates: c.get("duplicates")?,
            removed: c.get("removed")?,
            simplices: c.get("simplices")?,
        };
        return Ok(Record3::End(End3 { counts, mesh: o.get("mesh")?, trace: o.get("trace")? }));
    }
    let id: VertexId = o.get("id")?;
    Ok(Record3::Event(match kind.as_str() {
        "insert" => {
            let bits: String = o.get("flood")?;
            if !bits.bytes().all(|b| matches!(b, b'0' | b'1')) || u32::try_from(bits.len()).is_err() {
                return Err("`flood` is not a run of 0 and 1".into());
            }
            Event3::Insert { id, first: cell(o, "first")?, flood: bits.bytes().map(|b| b == b'1').collect::<Bits>() }
        }
        "hide" => Event3::Hide { id, cell: cell(o, "cell")? },
        "duplicate" => Event3::Duplicate { id, of: o.get("of")? },
        "remove" => Event3::Remove { id, created: ids(o, "created")? },
        "succeed" => Event3::Succeed { id, by: o.get("by")? },
        "raise" => Event3::Raise { id, apexes: apexes(o)? },
        "lower" => Event3::Lower { id, apexes: apexes(o)? },
        other => return Err(format!("event {other:?} is not known in space")),
    }))
}

fn cell(o: &Object, key: &str) -> Result<Tetrahedron, Refusal> {
    ids(o, key)?.try_into().map_err(|_| format!("`{key}` has not four ids"))
}

fn ids(o: &Object, key: &str) -> Result<Vec<VertexId>, Refusal> {
    let numbers: Vec<i32> = o.get(key)?;
    let known = numbers.iter().all(|&n| n >= SPECIAL as i32);
    if known {
        Ok(numbers.into_iter().map(|n| VertexId(n as u32)).collect())
    } else {
        Err(format!("`{key}`: an id below -4"))
    }
}

fn apexes(o: &Object) -> Result<Vec<Apex>, Refusal> {
    let names: Vec<String> = o.get("apexes")?;
    let apex = |name: &String| NAMES.iter().position(|n| n.trim_matches('"') == name).map(|k| Apex::ALL[k]);
    names.iter().map(|name| apex(name).ok_or_else(|| format!("apex {name:?} is not known"))).collect()
}
