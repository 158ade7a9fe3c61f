//! WKT and GeoJSON.

use super::{refuses, survives};
use crate::io::{Input, NoteKind, parse_geojson, parse_wkt};
use crate::model::{Fill, Point2};

/// Ends and toggling of the segments, and the notes.
fn summary(input: &Input) -> (Vec<(u32, u32, bool)>, Vec<&str>) {
    let segments = input.pslg.segments.iter().map(|s| (s.ends[0].0, s.ends[1].0, s.toggles)).collect();
    (segments, input.notes.iter().map(|n| &*n.text).collect())
}

/// Whether a point lies inside by the even-odd rule over the toggling segments: a ray to the right, in small whole numbers.
fn inside(input: &Input, p: Point2) -> bool {
    let graph = &input.pslg;
    assert_eq!(graph.fill, Fill::Parity);
    let crossings = graph.segments.iter().filter(|s| s.toggles).filter(|s| {
        let [a, b] = s.ends.map(|v| graph.points[v.index()]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossings.count() % 2 == 1
}

#[test]
fn neighbours_stay_filled_and_holes_are_holes() {
    let wkt = "MULTIPOLYGON(((0 0,2 0,2 2,0 2,0 0)), ((2 0,4 0,4 2,2 2,2 0), (2.5 .5,3.5 .5,3.5 1.5,2.5 .5)))";
    let json = r#"{"type":"MultiPolygon","coordinates":[[[[0,0],[2,0],[2,2],[0,2],[0,0]]],
        [[[2,0],[4,0],[4,2],[2,2],[2,0]],[[2.5,0.5],[3.5,0.5],[3.5,1.5],[2.5,0.5]]]]}"#;
    let input = parse_wkt(wkt.as_bytes()).unwrap();
    assert_eq!(parse_geojson(json.as_bytes()).unwrap().pslg, input.pslg);
    let (segments, notes) = summary(&input);
    assert_eq!((segments[1], segments.len()), ((1, 2, false), 10));
    assert_eq!(segments.iter().filter(|s| s.2).count(), 9);
    assert_eq!(notes, ["points merged with an earlier equal one: 2", "segments merged with an earlier equal one: 1"]);
    let at = |x, y| inside(&input, Point2::new(x, y));
    assert!(at(1.0, 1.25) && at(3.0, 1.25) && !at(3.25, 0.75) && !at(5.0, 1.25));
}

#[test]
fn island_that_fills_its_lake_is_filled() {
    let wkt = b"POLYGON((0 0,9 0,9 9,0 9,0 0),(3 3,6 3,6 6,3 6,3 3))\nPOLYGON((3 3,3 6,6 6,6 3,3 3))";
    let input = parse_wkt(wkt).unwrap();
    assert!(inside(&input, Point2::new(4.5, 4.0)) && inside(&input, Point2::new(1.0, 1.5)));
    assert_eq!(input.pslg.segments.len(), 8);
}

#[test]
fn every_kind_of_wkt() {
    let text = b"SRID=4326;GEOMETRYCOLLECTION Z (point(1 2 3), LINESTRING M(0 0 7,-0 1 7,1 2 7),\n MULTIPOINT((5 5),(5 6)), MULTIPOINT(5 5, 7 7),
        MULTILINESTRING EMPTY, MULTILINESTRING((8 8,9 9),EMPTY), MULTIPOLYGON(EMPTY), POLYGON EMPTY);";
    let input = parse_wkt(text).unwrap();
    assert_eq!(input.pslg.points.len(), 8);
    assert_eq!(input.pslg.points[2].x.to_bits(), 0);
    assert_eq!(input.pslg.fill, Fill::Seeds);
    let (segments, notes) = summary(&input);
    assert_eq!(segments, [(1, 2, false), (2, 0, false), (6, 7, false)]);
    assert_eq!(
        notes,
        [
            "points merged with an earlier equal one: 2",
            "positions with more than two coordinates, of which x and y are used: 4",
            "the reference system 4326 is not interpreted"
        ]
    );
    assert_eq!(input.lines.points, [1, 1, 1, 2, 2, 2, 3, 3]);
    survives(parse_wkt, text);
}

#[test]
fn repeated_positions_make_no_segment() {
    let input = parse_wkt(b"POLYGON((0 0,1 0,1 0,1 1,0 0))").unwrap();
    assert_eq!(summary(&input).0.len(), 3);
    assert_eq!(
        (input.notes[0].kind, &*input.notes[0].text),
        (NoteKind::Repair, "segments with equal ends, dropped: 1")
    );
}

#[test]
fn bad_wkt() {
    refuses(
        parse_wkt,
        &[
            (
                b"",
                "WKT line 1 column 1: geometry 1: the file ends where a geometry such as POLYGON is due; the geometries read here are POINT, LINESTRING, POLYGON, MULTIPOINT, MULTILINESTRING, MULTIPOLYGON, GEOMETRYCOLLECTION",
            ),
            (
                b"\n CIRCLE(0 0)",
                "WKT line 2 column 2: geometry 1: `CIRCLE(0` stands where a geometry such as POLYGON is due; the geometries read here are POINT, LINESTRING, POLYGON, MULTIPOINT, MULTILINESTRING, MULTIPOLYGON, GEOMETRYCOLLECTION",
            ),
            (b"POINT(1)", "WKT line 1 column 8: geometry 1, POINT: `)` stands where a number is due"),
            (
                b"POINT(1 nan)",
                "WKT line 1 column 9: geometry 1, POINT: `nan` is not a finite number; write a decimal number such as -1.5e3",
            ),
            (
                b"POINT(1\n 1e400)",
                "WKT line 2 column 2: geometry 1, POINT: `1e400` is not a finite number; write a decimal number such as -1.5e3",
            ),
            (b"POINT(1 2 3 4 5)", "WKT line 1 column 15: geometry 1, POINT: `5)` stands where `,` or `)` is due"),
            (
                b"LINESTRING(0 0)",
                "WKT line 1 column 16: geometry 1, LINESTRING: the polyline that ends here has fewer than 2 positions; give it at least 2",
            ),
            (
                b"POLYGON((0 0,1 0,1 1))",
                "WKT line 1 column 22: geometry 1, POLYGON: the ring that ends here is not closed; repeat its first position at its end",
            ),
            (
                b"POLYGON((0 0,1 0,0 0))",
                "WKT line 1 column 22: geometry 1, POLYGON: the ring that ends here has fewer than 4 positions; give it at least 3 corners and repeat the first",
            ),
            (
                b"POLYGON((0 0,1 0,1 1,0 0)",
                "WKT line 1 column 26: geometry 1, POLYGON: the file ends where `,` or `)` is due; the file is truncated",
            ),
            (
                b"POINT(0 0) POLYGON",
                "WKT line 1 column 19: geometry 2, POLYGON: the file ends where `(` is due; the file is truncated",
            ),
            (
                b"POINT(0 0) 7",
                "WKT line 1 column 12: geometry 2: `7` stands where a geometry such as POLYGON is due; the geometries read here are POINT, LINESTRING, POLYGON, MULTIPOINT, MULTILINESTRING, MULTIPOLYGON, GEOMETRYCOLLECTION",
            ),
            (b"POINT(0 \xff)", "WKT line 1 column 9: a byte that is not UTF-8; save the file as plain text in UTF-8"),
        ],
    );
    let deep = "GEOMETRYCOLLECTION(".repeat(100_000);
    assert!(parse_wkt(deep.as_bytes()).unwrap_err().problem.contains("too deeply"));
}

#[test]
fn geojson_features() {
    let text = br#"{"type": "FeatureCollection", "name": "x", "features": [
      {"type": "Feature", "properties": {"type": 3}, "geometry": null},
      {"type": "Feature", "geometry": {"coordinates": [1.5, -0, 9], "type": "Point"}},
      {"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
        {"type": "LineString", "coordinates": [[0, 0],
           [1, 1]]},
        {"type": "MultiPoint", "coordinates": []}, {"type": "Point", "coordinates": [ ]}]}}]}"#;
    let input = parse_geojson(text).unwrap();
    assert_eq!(input.pslg.points, [Point2::new(1.5, 0.0), Point2::new(0.0, 0.0), Point2::new(1.0, 1.0)]);
    assert_eq!(input.lines.points, [3, 5, 6]);
    assert_eq!(input.pslg.segments.len(), 1);
    assert_eq!(input.pslg.fill, Fill::Seeds);
    survives(parse_geojson, text);
}

#[test]
fn bad_geojson() {
    refuses(
        parse_geojson,
        &[
            (b"", "GeoJSON line 1 column 1: the file ends where an object is due; the file is truncated"),
            (b"[1, 2]", "GeoJSON line 1 column 1: `[1,` stands where an object is due"),
            (b"{\"type\": \"Point\"}", "GeoJSON line 1 column 1: a Point without \"coordinates\""),
            (
                b"{\"type\": \"Topology\"}",
                "GeoJSON line 1 column 1: the type `Topology` is unknown; GeoJSON has FeatureCollection, Feature, GeometryCollection, Point, LineString, Polygon and their Multi forms",
            ),
            (
                b"{\"type\": \"Point\", \"coordinates\": [1, \"x\"]}",
                "GeoJSON line 1 column 38: `\"x\"]}` stands where a number is due",
            ),
            (
                b"{\"type\": \"Point\", \"coordinates\": [1,\n1e400]}",
                "GeoJSON line 2 column 1: `1e400` is not a finite number; write a decimal number such as -1.5e3",
            ),
            (
                b"{\"type\": \"Point\", \"coordinates\": [1]}",
                "GeoJSON line 1 column 37: the position that ends here has fewer than 2 numbers; give x and y",
            ),
            (b"{\"type\": \"Point\", \"coordinates\": [1, NaN]}", "GeoJSON line 1 column 38: expected value"),
            (b"{\"type\": \"Point\", \"coordinates\": [1, 2]} x", "GeoJSON line 1 column 42: trailing characters"),
            (
                b"{\"type\": \"Feature\",\n\"geometry\": {\"type\": 7}}",
                "GeoJSON line 2 column 22: feature 1: invalid type: integer `7`, expected a string",
            ),
            (
                b"{\"type\": \"Polygon\", \"coordinates\": [[[0,0],[1,0],[1,1],[0,1]]]}",
                "GeoJSON line 1 column 62: the ring that ends here is not closed; repeat its first position at its end",
            ),
        ],
    );
    let deep = "[".repeat(100_000);
    assert!(parse_geojson(format!("{{\"type\":\"Point\",\"coordinates\":{deep}").as_bytes()).is_err());
    let deep = "{\"type\":\"Feature\",\"geometry\":".repeat(100);
    let closed = format!("{deep}null{}", "}".repeat(100));
    assert!(parse_geojson(closed.as_bytes()).unwrap_err().problem.contains("too deeply"));
}

/// The corpus has the same graphs as WKT and as `.poly`.
#[test]
fn corpus() {
    let Some(data) = super::data() else { return };
    for (wkt, poly) in [
        ("cgal/bee", "cgal__bee"),
        ("geo/east_baton_rouge", "geo__east_baton_rouge"),
        ("geo/nl_plots", "geo__nl_plots"),
        ("geo/shell", "geo__shell"),
    ] {
        let read = |name: String| std::fs::read(data.join("pslg").join(name)).unwrap();
        let a = parse_wkt(&read(format!("{wkt}.wkt"))).unwrap();
        let b = crate::io::parse_poly(&read(format!("as_poly/{poly}.poly")), None).unwrap();
        assert_eq!(a.pslg.points, b.pslg.points, "{wkt}");
        assert_eq!(a.pslg.segments.len(), b.pslg.segments.len(), "{wkt}");
    }
}
