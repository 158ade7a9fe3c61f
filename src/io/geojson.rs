//! Reads GeoJSON (RFC 7946): geometries, features, collections.
//!
//! The objects are read by serde_json; the coordinates by a cursor of our own over the same text, so that every fault and every vertex
//! knows its line. Longitude and latitude are taken as x and y of a plane, without projection.

use super::chains::{Chain, Chains, Position, text_of_chains};
use super::cursor::Cursor;
use super::rows::clipped;
use super::wkt::check_chain;
use super::{Input, ReadError};
use crate::model::Point2;
use serde::Deserialize;
use serde_json::value::RawValue;
use std::borrow::Cow;

/// Nesting of objects; real files have three or four levels.
const DEEPEST: u32 = 32;

const SQUARE: (u8, u8) = (b'[', b']');

/// The members that matter of any GeoJSON object. Others are ignored, as the RFC asks.
#[derive(Deserialize)]
struct Object<'a> {
    #[serde(rename = "type", borrow)]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    coordinates: Option<&'a RawValue>,
    #[serde(borrow)]
    geometry: Option<&'a RawValue>,
    #[serde(borrow)]
    geometries: Option<Vec<&'a RawValue>>,
    #[serde(borrow)]
    features: Option<Vec<&'a RawValue>>,
}

/// Reads GeoJSON.
///
/// Result: equal points are one vertex; polygons fill by the even-odd rule (`Fill::Parity`); without polygons `Fill::Seeds`.
/// Errors: the first fault.
pub fn parse_geojson(bytes: &[u8]) -> Result<Input, ReadError> {
    let text = text_of_chains("GeoJSON", bytes)?;
    let mut reader = Reader { text, chains: Chains::default(), feature: 0 };
    reader.object(text, 0)?;
    Ok(reader.chains.finish())
}

struct Reader<'a> {
    text: &'a str,
    chains: Chains,
    /// Features begun, for messages.
    feature: u32,
}

impl<'a> Reader<'a> {
    /// A cursor at the start of a part of the text.
    fn cursor(&self, part: &str) -> Cursor<'a> {
        let at = part.as_ptr() as usize - self.text.as_ptr() as usize;
        let mut cursor = Cursor::new("GeoJSON", self.text, at);
        cursor.element = self.element();
        cursor
    }

    fn element(&self) -> String {
        if self.feature > 0 { format!("feature {}", self.feature) } else { String::new() }
    }

    fn object(&mut self, part: &'a str, depth: u32) -> Result<(), ReadError> {
        if depth == DEEPEST {
            return Err(self.cursor(part).fault("the objects are nested too deeply", "flatten them"));
        }
        let mut start = self.cursor(part);
        // A derived reader would take an array of the members' values too.
        if start.peek() != Some(b'{') {
            return Err(start.wanted("an object"));
        }
        let object: Object = serde_json::from_str(part).map_err(|e| self.fault(part, &e))?;
        let missing = |name: &str| self.cursor(part).fault(format!("a {} without \"{name}\"", object.kind), "");
        match &*object.kind {
            "FeatureCollection" => {
                for feature in object.features.ok_or_else(|| missing("features"))? {
                    self.object(feature.get(), depth + 1)?;
                }
                Ok(())
            }
            "Feature" => {
                self.feature = self.feature.saturating_add(1);
                // A feature may lack a place: its geometry is null then.
                object.geometry.map_or(Ok(()), |g| self.object(g.get(), depth + 1))
            }
            "GeometryCollection" => {
                for geometry in object.geometries.ok_or_else(|| missing("geometries"))? {
                    self.object(geometry.get(), depth + 1)?;
                }
                Ok(())
            }
            kind => match Shape::of(kind) {
                Some(shape) => {
                    let coordinates = object.coordinates.ok_or_else(|| missing("coordinates"))?;
                    let mut cursor = self.cursor(coordinates.get());
                    shape.read(&mut cursor, &mut self.chains)
                }
                None => Err(self.cursor(part).fault(
                    format!("the type `{}` is unknown", super::error::shown(kind)),
                    "GeoJSON has FeatureCollection, Feature, GeometryCollection, Point, LineString, Polygon and their Multi forms",
                )),
            },
        }
    }

    /// An error of serde_json within a part of the text, at its place in the whole.
    fn fault(&self, part: &str, e: &serde_json::Error) -> ReadError {
        let start = self.cursor(part).fault("", "");
        let sentence = e.to_string();
        let problem = sentence.split(" at line ").next().unwrap_or(&sentence).to_string();
        let column = clipped(e.column());
        ReadError {
            line: start.line.saturating_add(clipped(e.line().saturating_sub(1))),
            column: if e.line() <= 1 { (start.column - 1).saturating_add(column) } else { column },
            problem,
            ..start
        }
    }
}

/// The shapes that have coordinates.
#[derive(Clone, Copy)]
enum Shape {
    Point,
    Points,
    Chain(Chain),
    Chains(Chain),
    Polygons,
}

impl Shape {
    fn of(kind: &str) -> Option<Shape> {
        Some(match kind {
            "Point" => Shape::Point,
            "MultiPoint" => Shape::Points,
            "LineString" => Shape::Chain(Chain::Line),
            "MultiLineString" => Shape::Chains(Chain::Line),
            "Polygon" => Shape::Chains(Chain::Ring),
            "MultiPolygon" => Shape::Polygons,
            _ => return None,
        })
    }

    fn read(self, at: &mut Cursor, chains: &mut Chains) -> Result<(), ReadError> {
        match self {
            Shape::Point if vacant(at) => Ok(()),
            Shape::Point => {
                let position = position(at, chains)?;
                chains.point(position);
                Ok(())
            }
            Shape::Points => list(at, |at| Shape::Point.read(at, chains)),
            Shape::Chains(kind) => list(at, |at| Shape::Chain(kind).read(at, chains)),
            Shape::Polygons => list(at, |at| Shape::Chains(Chain::Ring).read(at, chains)),
            Shape::Chain(kind) => {
                let mut positions = Vec::new();
                list(at, |at| {
                    positions.push(position(at, chains)?);
                    Ok(())
                })?;
                if positions.is_empty() {
                    return Ok(());
                }
                check_chain(&positions, kind).map_err(|(problem, fix)| at.fault(problem, fix))?;
                chains.chain(&positions, kind);
                Ok(())
            }
        }
    }
}

/// Whether an empty list is next; goes past it.
fn vacant(at: &mut Cursor) -> bool {
    at.take_both(SQUARE)
}

fn list(at: &mut Cursor, item: impl FnMut(&mut Cursor) -> Result<(), ReadError>) -> Result<(), ReadError> {
    if vacant(at) { Ok(()) } else { at.list(SQUARE, item) }
}

fn position(at: &mut Cursor, chains: &mut Chains) -> Result<Position, ReadError> {
    at.skip_space();
    let line = at.line();
    let mut numbers = [0.0; 2];
    let mut count = 0;
    at.list(SQUARE, |at| {
        let x = at.number()?;
        if let Some(slot) = numbers.get_mut(count) {
            *slot = x;
        }
        count += 1;
        Ok(())
    })?;
    match count {
        0 | 1 => Err(at.fault("the position that ends here has fewer than 2 numbers", "give x and y")),
        _ => {
            if count > 2 {
                chains.flattened(line);
            }
            Ok(Position { point: Point2::new(numbers[0], numbers[1]), line })
        }
    }
}
