//! Both forms of a trace: round trips, canonicity, malformed bytes, and one dump checked by hand.

use orthoball::model::*;
use orthoball::trace::*;
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::{Index, select};

fn write(records: &[Record], format: Format) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), format);
    records.iter().for_each(|r| writer.record(r).unwrap());
    writer.finish().unwrap()
}

fn read(bytes: &[u8]) -> Result<Vec<Record>, DecodeError> {
    Reader::new(bytes).collect()
}

/// Reads to the end and, as a checker does, compares the digest.
fn accepts(bytes: &[u8]) -> bool {
    let mut reader = Reader::new(bytes);
    let mut last = None;
    for record in reader.by_ref() {
        match record {
            Ok(record) => last = Some(record),
            Err(_) => return false,
        }
    }
    matches!(last, Some(Record::End(end)) if end.trace == reader.digest())
}

fn form(binary: bool) -> Format {
    if binary { Format::Binary } else { Format::Text }
}

fn float() -> impl Strategy<Value = f64> {
    let hard =
        vec![0.0, -0.0, 1e16, 1e15, 1e-4, 1e-5, 0.1, f64::MAX, f64::MIN_POSITIVE, 5e-324, 1e22, 9007199254740993.0];
    prop_oneof![any::<f64>().prop_filter("finite", |x| x.is_finite()), (-50i32..50).prop_map(f64::from), select(hard),]
}

fn point() -> impl Strategy<Value = Point2> {
    (float(), float()).prop_map(|(x, y)| Point2::new(x, y))
}

/// Three ids below `n`, the smallest first, either orientation.
fn triangle(n: u32) -> impl Strategy<Value = Triangle> {
    (0..n - 2, any::<Index>(), any::<Index>()).prop_map(move |(a, i, j)| {
        let above: Vec<u32> = (a + 1..n).collect();
        let b = above[i.index(above.len())];
        let rest: Vec<u32> = above.into_iter().filter(|&x| x != b).collect();
        [a, b, rest[j.index(rest.len())]].map(VertexId)
    })
}

/// Lists of triangles, some of which share edges as those of a cavity do, some longer than the window of shared edges.
fn triangles(n: u32) -> impl Strategy<Value = Vec<Triangle>> {
    let strip = (0..n - 2).prop_map(move |a| {
        let one = |i: u32| {
            if i.is_multiple_of(2) { [i, i + 1, i + 2] } else { [i, i + 2, i + 1] }
        };
        (a..(a + 6).min(n - 2)).map(|i| one(i).map(VertexId)).collect()
    });
    prop_oneof![vec(triangle(n), 0..6), strip, vec(triangle(n), 40..60)]
}

fn parameters() -> impl Strategy<Value = GcdrParameters> {
    use orthoball::model::{Choice as C, DiskChoice as D};
    let intervals = vec![C::Center, C::Extreme, C::Random, C::User];
    let choices = (
        select(vec![D::Center, D::Extreme, D::Random, D::Offcenter, D::ClampedOffcenter, D::User]),
        select(intervals.clone()),
        select(intervals),
        select(vec![QueueOrder::Fifo, QueueOrder::WorstFirst, QueueOrder::ShortestEdge]),
        select(vec![DeletionPolicy::Segment, DeletionPolicy::Point, DeletionPolicy::Disk]),
        select(vec![SmallAngles::Shells, SmallAngles::Off]),
    );
    let optional = (
        option::of(float()),
        option::of(select(vec![VertexOfTriangle::First, VertexOfTriangle::Newest, VertexOfTriangle::Seeded])),
        option::of(any::<u64>()),
        option::of(float()),
        any::<bool>(),
        option::of(any::<u32>()),
    );
    ([float(), float(), float(), float()], choices, optional).prop_map(|([rho2, d1, d2, mu], c, o)| GcdrParameters {
        rho2,
        d1,
        d2,
        mu,
        choice_a: c.0,
        choice_b: c.1,
        choice_c: c.2,
        order: c.3,
        deletion: c.4,
        small_angles: c.5,
        kappa: o.0,
        extreme: o.1,
        seed: o.2,
        max_area: o.3,
        size_function: o.4,
        max_splits: o.5,
    })
}

fn level() -> impl Strategy<Value = Option<Level>> {
    select(vec![None, Some(Level::Outside), Some(Level::Admissible), Some(Level::Graded)])
}

fn cause() -> impl Strategy<Value = Cause> {
    prop_oneof![Just(Cause::Skinny), Just(Cause::Area), float().prop_map(|h| Cause::Size { h })]
}

/// An event when `n` vertices are known, and `segments` segments.
fn event(n: u32, segments: u32) -> impl Strategy<Value = Event> {
    let id = || (0..n).prop_map(VertexId);
    let shell = option::of((id(), any::<i32>()).prop_map(|(apex, k)| Shell { apex, k }));
    let kind = prop_oneof![Just(SplitKind::B), id().prop_map(|parent| SplitKind::C { parent })];
    let s = (0..n - 1).prop_flat_map(move |u| (Just(VertexId(u)), (u + 1..n).prop_map(VertexId)));
    let split = (kind, s, triangle(n), cause(), point(), shell)
        .prop_map(|(kind, (u, v), t, cause, a, shell)| Why::Split { kind, s: [u, v], t, cause, a, shell });
    let why = prop_oneof![cause().prop_map(|cause| Why::Free { cause }), split];
    let reason = prop_oneof![
        Just(SkipReason::Resolution),
        id().prop_map(|apex| SkipReason::InputAngle { apex }),
        (0..segments).prop_map(|s| SkipReason::SplitLimit { segment: SegmentId(s) }),
    ];
    prop_oneof![
        (point(), why, triangles(n)).prop_map(|(p, why, destroyed)| Event::Insert { p, why, destroyed }),
        (id(), triangles(n)).prop_map(|(id, created)| Event::Remove { id, created }),
        (triangle(n), cause(), reason).prop_map(|(t, cause, reason)| Event::Skip { t, cause, reason }),
    ]
}

/// A domain, its start and some events, without geometric sense.
fn body() -> impl Strategy<Value = Vec<Record>> {
    (3..60u32, 0..3usize, 1..4u32).prop_flat_map(|(n, attributes, segments)| {
        let vertex = (point(), option::of(any::<i32>()), vec(float(), attributes))
            .prop_map(|(at, marker, attributes)| Record::Vertex { at, marker, attributes });
        let segment = (0..n, 0..n, any::<i32>(), any::<bool>()).prop_map(|(u, v, marker, toggles)| {
            Record::Segment(Segment { ends: [VertexId(u), VertexId(v)], marker, toggles })
        });
        let region = (point(), float(), option::of(float()))
            .prop_map(|(seed, attribute, max_area)| Record::Region(Region { seed, attribute, max_area }));
        let start = vec(triangle(n), 0..9).prop_map(|mut list| {
            list.sort_unstable();
            list.dedup();
            let head = Record::Start { triangles: list.len() as u32 };
            std::iter::once(head).chain(list.into_iter().map(Record::Triangle)).collect::<Vec<_>>()
        });
        let parts = (
            vec(vertex, n as usize),
            vec(segment, segments as usize),
            vec(point().prop_map(Record::Hole), 0..2),
            vec(region, 0..2),
            start,
            vec(event(n, segments).prop_map(Record::Event), 0..12),
        );
        parts.prop_map(|(a, b, c, d, e, f)| [a, b, c, d, e, f].concat())
    })
}

/// A whole trace of sound form.
fn trace() -> impl Strategy<Value = Vec<Record>> {
    let algorithm = prop_oneof![Just(Algorithm::Delaunay), parameters().prop_map(Algorithm::Gcdr)];
    let head = (algorithm, level(), select(vec![Fill::Seeds, Fill::Parity, Fill::Convex]))
        .prop_map(|(algorithm, level, fill)| Record::Header(Header { algorithm, level, fill }));
    let outcome = select(vec![Outcome::Complete, Outcome::Holey, Outcome::Stopped]);
    let end = (outcome, option::of(".{0,9}"), level(), any::<[u32; 7]>()).prop_map(
        |(outcome, stop_reason, level_effective, c)| {
            let [vertices, triangles, type_a, type_b, type_c, removed, unmet] = c;
            let counts = Counts { vertices, triangles, type_a, type_b, type_c, removed, unmet };
            let mesh = blake3::hash(b"mesh").to_hex().to_string();
            Record::End(End { outcome, stop_reason, level_effective, counts, mesh, trace: String::new() })
        },
    );
    (head, body(), end).prop_map(|(head, body, end)| [vec![head], body, vec![end]].concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 192, ..ProptestConfig::default() })]

    #[test]
    fn what_is_written_is_read(records in trace()) {
        let [text, binary] = [Format::Text, Format::Binary].map(|f| write(&records, f));
        for bytes in [&text, &binary] {
            prop_assert!(accepts(bytes));
            let mut back = read(bytes).unwrap();
            if let Some(Record::End(end)) = back.last_mut() {
                end.trace.clear();
            }
            prop_assert_eq!(&back, &records);
        }
        prop_assert_eq!(&write(&read(&text).unwrap(), Format::Binary), &binary);
        prop_assert_eq!(&write(&read(&binary).unwrap(), Format::Text), &text);
    }

    #[test]
    fn a_changed_byte_is_refused(records in trace(), at in any::<Index>(), new in any::<u8>(), binary in any::<bool>()) {
        let mut bytes = write(&records, form(binary));
        let at = at.index(bytes.len());
        prop_assume!(bytes[at] != new);
        bytes[at] = new;
        prop_assert!(!accepts(&bytes));
    }

    #[test]
    fn what_is_read_is_canonical(
        records in trace(),
        edits in vec((any::<Index>(), any::<u8>(), 0..3u8), 1..4),
        binary in any::<bool>(),
    ) {
        let mut bytes = write(&records, form(binary));
        for (at, new, edit) in edits {
            let at = at.index(bytes.len());
            match edit {
                0 => bytes[at] = new,
                1 => bytes.insert(at, new),
                _ => drop(bytes.remove(at)),
            }
        }
        // Digests aside, all that is read must be what is written again.
        if let Ok(back) = read(&bytes) {
            let again = write(&back, form(binary));
            let digest = if binary { 32 } else { 64 + 3 };
            prop_assert_eq!(&again[..again.len() - digest], &bytes[..bytes.len() - digest]);
        }
    }

    #[test]
    fn any_bytes_are_survived(bytes in vec(any::<u8>(), 0..300), binary in any::<bool>()) {
        let head: &[u8] = if binary { b"\x89OBT\x01\x01\x00\x00\x00" } else { b"" };
        prop_assert!(!accepts(&[head, &bytes].concat()));
    }

    #[test]
    fn every_prefix_is_truncated(records in trace(), at in any::<Index>(), binary in any::<bool>()) {
        let bytes = write(&records, form(binary));
        let result = read(&bytes[..at.index(bytes.len())]);
        prop_assert!(matches!(result, Err(DecodeError::Truncated(_))), "{:?}", result);
    }

    #[test]
    fn the_first_difference_is_found(records in trace(), at in any::<Index>()) {
        let is_insertion = |r: &Record| matches!(r, Record::Event(Event::Insert { .. }));
        let insertions: Vec<usize> = (0..records.len()).filter(|&i| is_insertion(&records[i])).collect();
        prop_assume!(!insertions.is_empty());
        let place = insertions[at.index(insertions.len())];
        let mut other = records.clone();
        if let Record::Event(Event::Insert { p, .. }) = &mut other[place] {
            p.y = if p.y == 1.0 { 2.0 } else { 1.0 };
        }
        let [text, binary] = [write(&records, Format::Text), write(&other, Format::Binary)];
        let found = first_divergence(Reader::new(&text[..]), Reader::new(&binary[..])).unwrap().unwrap();
        prop_assert_eq!(found.record, place as u64);
        prop_assert_eq!(found.field.as_str(), "p[1]");
        let mut comparing = Comparing::new(Reader::new(&text[..]));
        let stopped = other.iter().position(|r| comparing.record(r).is_err());
        prop_assert_eq!(stopped, Some(place));
        prop_assert_eq!(comparing.divergence(), Some(&found));
        let mut same = Comparing::new(Reader::new(&text[..]));
        prop_assert!(records.iter().all(|r| same.record(r).is_ok()));
        prop_assert_eq!(same.records(), records.len() as u64);
    }
}

/// Two triangles, a free insertion, its removal.
fn small() -> Vec<Record> {
    let id = |t: [u32; 3]| t.map(VertexId);
    let vertex = |x: f64, y: f64| Record::Vertex { at: Point2::new(x, y), marker: None, attributes: vec![] };
    vec![
        Record::Header(Header { algorithm: Algorithm::Delaunay, level: None, fill: Fill::Seeds }),
        vertex(0.0, 0.0),
        vertex(1.0, 0.0),
        vertex(1.0, 1.0),
        vertex(0.0, 1.0),
        Record::Segment(Segment { ends: [VertexId(1), VertexId(0)], marker: -1, toggles: false }),
        Record::Start { triangles: 2 },
        Record::Triangle(id([0, 1, 2])),
        Record::Triangle(id([0, 2, 3])),
        Record::Event(Event::Insert {
            p: Point2::new(0.5, 0.5),
            why: Why::Free { cause: Cause::Area },
            destroyed: vec![id([0, 2, 3]), id([0, 1, 2])],
        }),
        Record::Event(Event::Remove { id: VertexId(4), created: vec![id([0, 1, 2])] }),
        Record::End(End {
            outcome: Outcome::Complete,
            stop_reason: None,
            level_effective: None,
            counts: Counts { vertices: 5, triangles: 4, type_a: 1, type_b: 0, type_c: 0, removed: 1, unmet: 300 },
            mesh: "0f".repeat(32),
            trace: String::new(),
        }),
    ]
}

/// Where the insertion of `small` starts in the binary form: header, four vertices, segment, start, two triangles.
const INSERTION: usize = 9 + 4 * 18 + 4 + 2 + 2 * 4;
/// Where its list of triangles starts: after tag and point.
const LIST: usize = INSERTION + 17;

#[test]
fn a_dump_checked_by_hand() {
    let bytes = write(&small(), Format::Binary);
    let zero = "00 00 00 00 00 00 00 00 ";
    let one = "00 00 00 00 00 00 f0 3f ";
    let half = "00 00 00 00 00 00 e0 3f ";
    let vertex = |x: &str, y: &str| format!("02 {x}{y}00 ");
    let expected = [
        "89 4f 42 54 01 01 00 00 00 ".to_string(), // magic, version, header: no level, seeds, delaunay
        vertex(zero, zero),
        vertex(one, zero),
        vertex(one, one),
        vertex(zero, one),
        "04 01 00 01 ".into(),                         // segment 1 0; marker -1 is 1 in zigzag
        "09 02 ".into(),                               // start, two triangles
        "0a 00 01 02 0a 00 02 03 ".into(), // distances up: from the last first corner, then from the own first corner
        format!("11 {half}{half}"),        // free, cause area; the point
        "02 03 01 00 01 02 ".into(),       // two: 0 2 3 as distances down from 3; its edge 0 is shared, apex 1
        "30 00 01 04 03 02 ".into(),       // remove 4, the last id of five; one triangle
        "0b 00 00 00 05 04 01 00 00 01 ac 02 ".into(), // end: complete, no level, no reason; counts, 300 in two bytes
        "0f ".repeat(32),
    ]
    .concat();
    let hex = |bytes: &[u8]| bytes.iter().map(|b| format!("{b:02x} ")).collect::<String>();
    let head = bytes.len() - 32;
    assert_eq!(hex(&bytes[..head]), expected);
    assert_eq!(hex(&bytes[head..]), hex(blake3::hash(&bytes[..head]).as_bytes()));
}

#[test]
fn a_text_checked_by_hand() {
    let text = String::from_utf8(write(&small(), Format::Text)).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], r#"{"format":"orthoball-trace","version":1,"algorithm":"delaunay","fill":"seeds"}"#);
    assert_eq!(lines[2], r#"{"vertex":[1.0,0.0]}"#);
    assert_eq!(lines[5], r#"{"segment":[1,0],"marker":-1,"toggles":false}"#);
    assert_eq!(lines[6], r#"{"start":2}"#);
    assert_eq!(lines[7], r#"{"triangle":[0,1,2]}"#);
    assert_eq!(
        lines[9],
        r#"{"i":0,"event":"insert","why":{"type":"A","cause":"area"},"p":[0.5,0.5],"destroyed":[[0,2,3],[0,1,2]]}"#
    );
    assert_eq!(lines[10], r#"{"i":1,"event":"remove","id":4,"created":[[0,1,2]]}"#);
    assert!(lines[11].starts_with(r#"{"event":"end","outcome":"complete","counts":{"vertices":5,"#), "{}", lines[11]);
}

/// The error after an edit of the bytes of `small`.
fn refused(format: Format, edit: impl Fn(&mut Vec<u8>)) -> DecodeError {
    let mut bytes = write(&small(), format);
    edit(&mut bytes);
    read(&bytes).expect_err("accepted")
}

/// The error after a replacement in the text of `small`.
fn refused_text(from: &str, to: &str) -> DecodeError {
    refused(Format::Text, |b| {
        let text = String::from_utf8(b.clone()).unwrap();
        assert!(text.contains(from), "{from}");
        *b = text.replacen(from, to, 1).into_bytes();
    })
}

#[test]
fn other_spellings_are_refused() {
    // The count 2 in two bytes.
    let e = refused(Format::Binary, |b| drop(b.splice(LIST..=LIST, [0x82, 0x00])));
    assert!(matches!(e, DecodeError::NotCanonical(Place::Byte(at)) if at == INSERTION as u64), "{e}");
    // The second triangle spelled out (code 0, three ids) though it shares an edge.
    let e = refused(Format::Binary, |b| drop(b.splice(LIST + 4..LIST + 6, [0, 3, 2, 1])));
    assert!(matches!(e, DecodeError::NotCanonical(_)), "{e}");
    for (from, to) in [
        ("[0.5,0.5]", "[5e-1,0.5]"),
        ("[0.5,0.5]", "[0.50,0.5]"),
        ("[0.5,0.5]", "[0.5, 0.5]"),
        ("\"i\":0", "\"i\":1"),
        ("\"start\":2", "\"start\":2,\"start\":2"),
        ("\"marker\":-1,\"toggles\":false", "\"toggles\":false,\"marker\":-1"),
        ("\"event\":\"remove\"", "\"event\":\"\\u0072emove\""),
        ("{\"start\":2}\n", "{\"start\":2}\r\n"),
        ("{\"start\":2}", "{\"start\":2,\"more\":0}"),
    ] {
        let e = refused_text(from, to);
        assert!(matches!(e, DecodeError::NotCanonical(Place::Line(_))), "{from} -> {to}: {e}");
    }
}

#[test]
fn what_no_trace_may_say_is_refused_with_its_place() {
    for (from, to, message) in [
        ("[0,1,2]}", "[1,2,0]}", "line 8: a triangle does not name its smallest id first, or names one twice"),
        ("[0,2,3]}", "[0,2,7]}", "line 9: no vertex has this id yet"),
        ("[0,2,3]}", "[0,1,2]}", "line 9: triangles of `start` are not in ascending order"),
        ("{\"start\":2}", "{\"start\":3}", "line 10: fewer triangles than `start` announced"),
        ("{\"start\":2}\n", "", "line 7: a triangle beyond those announced by `start`"),
        ("\"version\":1", "\"version\":2", "line 1: version 2 of the format; this program reads version 1"),
        ("{\"vertex\":[1.0,0.0]}", "{\"hole\":[1.0,0.0]}", "line 4: records are out of order"),
    ] {
        let e = refused_text(from, to).to_string();
        assert!(e.starts_with(message), "{e}");
    }
    assert!(refused_text("[0.5,0.5]", "[1e999,0.5]").to_string().starts_with("line 10: "));
    let length = write(&small(), Format::Binary).len();
    let binary = |edit: fn(&mut Vec<u8>)| refused(Format::Binary, edit).to_string();
    assert_eq!(binary(|b| b[4] = 9), "byte 5: version 9 of the format; this program reads version 1");
    assert_eq!(binary(|b| b.push(0)), format!("byte {length}: more follows the end record"));
    assert_eq!(binary(|b| b[9] = 0x77), "byte 10: no record starts with this byte");
    assert_eq!(binary(|b| b[10..18].fill(0xff)), "byte 18: a number that is not finite");
}

#[test]
fn a_count_beyond_the_file_allocates_nothing() {
    let mut bytes = write(&small(), Format::Binary);
    bytes.splice(LIST..=LIST, [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]);
    assert!(matches!(read(&bytes), Err(DecodeError::Truncated(_))));
}

#[test]
fn writers_refuse_what_the_format_cannot_say() {
    let mut writer = Writer::new(Vec::new(), Format::Binary);
    assert!(writer.record(&small()[1]).is_err(), "a vertex before the header");
    let mut records = small();
    records.pop();
    let mut writer = Writer::new(Vec::new(), Format::Binary);
    records.iter().for_each(|r| writer.record(r).unwrap());
    let nan =
        Event::Insert { p: Point2::new(f64::NAN, 0.0), why: Why::Free { cause: Cause::Skinny }, destroyed: vec![] };
    assert!(writer.record(&Record::Event(nan)).is_err());
    assert_eq!(writer.finish().unwrap_err().kind(), std::io::ErrorKind::UnexpectedEof);
}

#[test]
fn long_traces_pass_through_the_buffers() {
    let mut records = small();
    let end = records.pop().unwrap();
    for i in 0..40_000u32 {
        let p = Point2::new(f64::from(i), 0.1);
        let destroyed = vec![[i / 2, i + 2, i + 4].map(VertexId), [i + 1, i + 4, i + 2].map(VertexId)];
        let destroyed = destroyed.into_iter().map(canonical_triangle).collect();
        records.push(Record::Event(Event::Insert { p, why: Why::Free { cause: Cause::Skinny }, destroyed }));
    }
    records.push(end);
    for format in [Format::Text, Format::Binary] {
        let bytes = write(&records, format);
        assert!(bytes.len() > 10 << 16, "{}", bytes.len());
        assert!(accepts(&bytes));
        assert_eq!(read(&bytes).unwrap()[..records.len() - 1], records[..records.len() - 1]);
    }
}

#[test]
fn mesh_digest_is_that_of_the_written_definition() {
    let mesh = Mesh2 {
        points: vec![Point2::new(0.0, 0.0), Point2::new(2.0, 0.0), Point2::new(0.0, -0.0)],
        triangles: vec![[0, 1, 2].map(VertexId)],
        edges: vec![MeshEdge { ends: [VertexId(0), VertexId(1)], marker: 7, segment: SegmentId(3) }],
        ..Mesh2::default()
    };
    let mut bytes = 3u64.to_le_bytes().to_vec();
    [0.0, 0.0, 2.0, 0.0, 0.0, -0.0f64].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    bytes.extend(1u64.to_le_bytes());
    [0u32, 1, 2].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    bytes.extend(1u64.to_le_bytes());
    [0u32, 1, 3].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    assert_eq!(mesh_digest(&mesh), blake3::hash(&bytes).to_hex().to_string());
    // Large enough for several buffers.
    let large = Mesh2 { points: vec![Point2::new(1.0, 2.0); 30_000], ..Mesh2::default() };
    let mut bytes = 30_000u64.to_le_bytes().to_vec();
    large.points.iter().for_each(|p| p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes())));
    bytes.extend([0; 16]);
    assert_eq!(mesh_digest(&large), blake3::hash(&bytes).to_hex().to_string());
}
