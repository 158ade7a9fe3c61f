//! Bytes to records, without trust in any of them.

use super::*;
use crate::model::{Edge, GcdrParameters, Point2, Region, Segment, SegmentId, Triangle, VertexId, canonical_triangle};
use crate::trace::record::{Algorithm, Cause, Counts, End, Event, Header, Record, Shell, SkipReason, SplitKind, Why};
use crate::trace::space::{self, Record3};

/// Why no record could be decoded.
#[derive(Debug, PartialEq, Eq)]
pub(in crate::trace) enum Fault {
    /// The bytes end within a record.
    Short,
    /// The bytes are no record: how far in, and why.
    Bad(usize, String),
}

/// Decodes the record at the head of `bytes`; also says how many bytes it took.
pub(in crate::trace) fn decode(bytes: &[u8], state: &State) -> Result<(Record, usize), Fault> {
    let mut cursor = Cursor { bytes, at: 0 };
    let record = cursor.record(state)?;
    Ok((record, cursor.at))
}

pub(in crate::trace) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Cursor<'_> {
    fn record(&mut self, state: &State) -> Result<Record, Fault> {
        if self.bytes.first() == Some(&MAGIC[0]) {
            return self.header();
        }
        let kind = self.byte()?;
        if !state.space.is_fresh() {
            return space::binary::decode(kind, self, &state.space).map(Record::Space);
        }
        Ok(match kind {
            tag::VERTEX | tag::VERTEX_MARKED => {
                let at = self.point()?;
                let marker = if kind == tag::VERTEX_MARKED { Some(self.signed()?) } else { None };
                Record::Vertex { at, marker, attributes: self.list(8, Self::f64)? }
            }
            tag::SEGMENT | tag::SEGMENT_TOGGLES => {
                let ends = [VertexId(self.u32()?), VertexId(self.u32()?)];
                Record::Segment(Segment { ends, marker: self.signed()?, toggles: kind == tag::SEGMENT_TOGGLES })
            }
            tag::HOLE => Record::Hole(self.point()?),
            tag::REGION | tag::REGION_BOUNDED => {
                let (seed, attribute) = (self.point()?, self.f64()?);
                let max_area = if kind == tag::REGION_BOUNDED { Some(self.f64()?) } else { None };
                Record::Region(Region { seed, attribute, max_area })
            }
            tag::START => Record::Start { triangles: self.u32()? },
            tag::TRIANGLE => {
                let a = self.above(first_of(state))?;
                Record::Triangle([a, self.above(a.0)?, self.above(a.0)?])
            }
            tag::END => Record::End(self.end()?),
            _ => Record::Event(self.event(kind, state.next)?),
        })
    }

    fn event(&mut self, tag: u8, next: u32) -> Result<Event, Fault> {
        let (kind, flags) = (tag & 0xf0, tag & 0x0f);
        match kind {
            tag::FREE if flags < 4 => {
                let cause = self.cause(flags)?;
                let p = self.point()?;
                Ok(Event::Insert { p, why: Why::Free { cause }, destroyed: self.triangles(next)? })
            }
            tag::SPLIT => {
                let cause = self.cause(flags)?;
                let p = self.point()?;
                let s: Edge = [self.id(next)?, self.id(next)?];
                let t = self.triangle(next)?;
                let a = self.point()?;
                let kind =
                    if flags & tag::TYPE_C != 0 { SplitKind::C { parent: self.id(next)? } } else { SplitKind::B };
                let shell = if flags & tag::SHELL != 0 {
                    Some(Shell { apex: self.id(next)?, k: self.signed()? })
                } else {
                    None
                };
                Ok(Event::Insert {
                    p,
                    why: Why::Split { kind, s, t, cause, a, shell },
                    destroyed: self.triangles(next)?,
                })
            }
            tag::REMOVE if flags == 0 => Ok(Event::Remove { id: self.id(next)?, created: self.triangles(next)? }),
            tag::SKIP => {
                let cause = self.cause(flags)?;
                let t = self.triangle(next)?;
                let reason = match flags >> 2 {
                    0 => SkipReason::Resolution,
                    1 => SkipReason::InputAngle { apex: self.id(next)? },
                    2 => SkipReason::SplitLimit { segment: SegmentId(self.u32()?) },
                    _ => return self.bad("no reason of a skip has this number"),
                };
                Ok(Event::Skip { t, cause, reason })
            }
            _ => self.bad("no record starts with this byte"),
        }
    }

    fn cause(&mut self, flags: u8) -> Result<Cause, Fault> {
        match flags & 3 {
            0 => Ok(Cause::Skinny),
            1 => Ok(Cause::Area),
            2 => Ok(Cause::Size { h: self.f64()? }),
            _ => self.bad("no cause has this number"),
        }
    }

    fn triangles(&mut self, next: u32) -> Result<Vec<Triangle>, Fault> {
        let count = self.count(2)?;
        let mut list: Vec<Triangle> = Vec::with_capacity(count);
        for i in 0..count {
            let code = if i == 0 { 0 } else { usize::from(self.byte()?) };
            if code == 0 {
                list.push(self.triangle(next)?);
                continue;
            }
            let (back, edge) = ((code - 1) / 3, (code - 1) % 3);
            if back >= i {
                return self.bad("an edge of a triangle that was not named");
            }
            let earlier = list[i - 1 - back];
            let apex = self.id(next)?;
            list.push(canonical_triangle([earlier[(edge + 1) % 3], earlier[edge], apex]));
        }
        Ok(list)
    }

    fn triangle(&mut self, next: u32) -> Result<Triangle, Fault> {
        Ok([self.id(next)?, self.id(next)?, self.id(next)?])
    }

    /// An id written as the distance down from the last one.
    fn id(&mut self, next: u32) -> Result<VertexId, Fault> {
        let down = self.u32()?;
        match next.checked_sub(1).and_then(|last| last.checked_sub(down)) {
            Some(id) => Ok(VertexId(id)),
            None => self.bad("a vertex id below zero"),
        }
    }

    /// An id written as the distance up from `base`.
    pub(in crate::trace) fn above(&mut self, base: u32) -> Result<VertexId, Fault> {
        let up = self.u32()?;
        match base.checked_add(up) {
            Some(id) => Ok(VertexId(id)),
            None => self.bad("a vertex id beyond 32 bits"),
        }
    }

    fn header(&mut self) -> Result<Record, Fault> {
        if self.take(MAGIC.len())? != MAGIC {
            return self.bad("not a trace: the first four bytes are not 89 4f 42 54");
        }
        let version = self.byte()?;
        if version != VERSION {
            return self.bad(format!("version {version} of the format; this program reads version {VERSION}"));
        }
        match self.byte()? {
            tag::HEADER => {}
            space::binary::tag::HEADER => {
                return space::binary::header(self).map(|h| Record::Space(Record3::Header(h)));
            }
            _ => return self.bad("the header is missing"),
        }
        let level = self.choice(&LEVELS)?;
        let fill = self.choice(&FILLS)?;
        let algorithm = match self.byte()? {
            0 => Algorithm::Delaunay,
            1 => Algorithm::Gcdr(self.parameters()?),
            _ => return self.bad("no algorithm has this number"),
        };
        Ok(Record::Header(Header { algorithm, level, fill }))
    }

    fn parameters(&mut self) -> Result<GcdrParameters, Fault> {
        let (rho2, d1, d2, mu) = (self.f64()?, self.f64()?, self.f64()?, self.f64()?);
        let choice_a = self.choice(&DISK_CHOICES)?;
        let (choice_b, choice_c) = (self.choice(&CHOICES)?, self.choice(&CHOICES)?);
        let (order, deletion) = (self.choice(&ORDERS)?, self.choice(&DELETIONS)?);
        let small_angles = self.choice(&SMALL_ANGLES)?;
        let present = self.byte()?;
        let has = |bit: u8| present >> bit & 1 == 1;
        Ok(GcdrParameters {
            rho2,
            d1,
            d2,
            mu,
            choice_a,
            choice_b,
            choice_c,
            order,
            deletion,
            small_angles,
            kappa: if has(0) { Some(self.f64()?) } else { None },
            extreme: if has(1) { Some(self.choice(&VERTICES)?) } else { None },
            seed: if has(2) { Some(self.u64()?) } else { None },
            max_area: if has(3) { Some(self.f64()?) } else { None },
            size_function: has(4),
            max_splits: if has(5) { Some(self.u32()?) } else { None },
        })
    }

    fn end(&mut self) -> Result<End, Fault> {
        let outcome = self.choice(&OUTCOMES)?;
        let level_effective = self.choice(&LEVELS)?;
        let stop_reason = match self.byte()? {
            0 => None,
            1 => {
                let count = self.count(1)?;
                match String::from_utf8(self.take(count)?.to_vec()) {
                    Ok(reason) => Some(reason),
                    Err(_) => return self.bad("the stop reason is not UTF-8"),
                }
            }
            _ => return self.bad("neither 0 nor 1 before the stop reason"),
        };
        let counts = Counts {
            vertices: self.u32()?,
            triangles: self.u32()?,
            type_a: self.u32()?,
            type_b: self.u32()?,
            type_c: self.u32()?,
            removed: self.u32()?,
            unmet: self.u32()?,
        };
        Ok(End { outcome, stop_reason, level_effective, counts, mesh: self.digest()?, trace: self.digest()? })
    }

    pub(in crate::trace) fn digest(&mut self) -> Result<String, Fault> {
        let digit = |v: u8| char::from(if v < 10 { b'0' + v } else { b'a' + v - 10 });
        Ok(self.take(32)?.iter().flat_map(|b| [digit(b >> 4), digit(b & 15)]).collect())
    }

    pub(in crate::trace) fn choice<T: Copy>(&mut self, all: &[T]) -> Result<T, Fault> {
        match all.get(usize::from(self.byte()?)) {
            Some(one) => Ok(*one),
            None => self.bad("no variant has this number"),
        }
    }

    pub(in crate::trace) fn list<T>(
        &mut self,
        least: usize,
        one: impl Fn(&mut Self) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let count = self.count(least)?;
        let mut list = Vec::with_capacity(count);
        for _ in 0..count {
            list.push(one(self)?);
        }
        Ok(list)
    }

    /// A count of things of at least `least` bytes each. More than the bytes at hand can hold is `Short`: nothing is allocated on a
    /// count's word alone.
    fn count(&mut self, least: usize) -> Result<usize, Fault> {
        let count = usize::try_from(self.u64()?).map_err(|_| Fault::Short)?;
        if count > (self.bytes.len() - self.at) / least { Err(Fault::Short) } else { Ok(count) }
    }

    fn point(&mut self) -> Result<Point2, Fault> {
        Ok(Point2::new(self.f64()?, self.f64()?))
    }

    pub(in crate::trace) fn f64(&mut self) -> Result<f64, Fault> {
        let mut bits = [0; 8];
        bits.copy_from_slice(self.take(8)?);
        let x = f64::from_bits(u64::from_le_bytes(bits));
        if x.is_finite() { Ok(x) } else { self.bad("a number that is not finite") }
    }

    pub(in crate::trace) fn signed(&mut self) -> Result<i32, Fault> {
        let x = self.u32()?;
        Ok((x >> 1) as i32 ^ -((x & 1) as i32))
    }

    pub(in crate::trace) fn u32(&mut self) -> Result<u32, Fault> {
        match u32::try_from(self.u64()?) {
            Ok(x) => Ok(x),
            Err(_) => self.bad("a number beyond 32 bits"),
        }
    }

    fn u64(&mut self) -> Result<u64, Fault> {
        let mut x = 0u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let part = u64::from(byte & 0x7f);
            if part << shift >> shift != part {
                break;
            }
            x |= part << shift;
            if byte < 0x80 {
                return Ok(x);
            }
        }
        self.bad("a number beyond 64 bits")
    }

    pub(in crate::trace) fn byte(&mut self) -> Result<u8, Fault> {
        Ok(self.take(1)?[0])
    }

    pub(in crate::trace) fn take(&mut self, n: usize) -> Result<&[u8], Fault> {
        let rest = &self.bytes[self.at..];
        if rest.len() < n {
            return Err(Fault::Short);
        }
        self.at += n;
        Ok(&rest[..n])
    }

    pub(in crate::trace) fn bad<T>(&self, why: impl Into<String>) -> Result<T, Fault> {
        Err(Fault::Bad(self.at, why.into()))
    }
}
