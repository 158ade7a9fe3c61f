//! The binary form: one tagged record after another. Normative text: `docs/trace-format.md`, "Binary form".
//!
//! Idea: an event costs its coordinates and a few bytes more. Ids are written as distances down from the next id, since refinement
//! works near what it made last; of the triangles of a cavity each but the first has an edge in common with an earlier one, so that its
//! third vertex says all. Decoding is lenient where it can be (a number in too many bytes, a shared edge that is not the first): the
//! reader encodes what it decoded and accepts only the same bytes, which makes the form canonical without a rule told twice.

pub(super) mod decode;
pub(super) mod encode;

pub(in crate::trace) use decode::{Fault, decode};
pub(in crate::trace) use encode::{encode, put_digest};

use super::grammar::State;
use super::record::Outcome;
use crate::model::{Choice, DeletionPolicy, DiskChoice, Fill, Level, QueueOrder, SmallAngles, VertexOfTriangle};

/// The first four bytes; the first is no ASCII character, so that no text file starts with it.
pub(super) const MAGIC: [u8; 4] = *b"\x89OBT";
/// The version of both forms.
pub(super) const VERSION: u8 = 1;
/// How many earlier triangles of a list are looked at for a shared edge: the most for which the code stays in seven bits.
const LOOKBACK: usize = 42;

const DISK_CHOICES: [DiskChoice; 6] = [
    DiskChoice::Center,
    DiskChoice::Extreme,
    DiskChoice::Random,
    DiskChoice::Offcenter,
    DiskChoice::ClampedOffcenter,
    DiskChoice::User,
];
const CHOICES: [Choice; 4] = [Choice::Center, Choice::Extreme, Choice::Random, Choice::User];
const ORDERS: [QueueOrder; 3] = [QueueOrder::Fifo, QueueOrder::WorstFirst, QueueOrder::ShortestEdge];
const DELETIONS: [DeletionPolicy; 3] = [DeletionPolicy::Segment, DeletionPolicy::Point, DeletionPolicy::Disk];
const SMALL_ANGLES: [SmallAngles; 2] = [SmallAngles::Shells, SmallAngles::Off];
const VERTICES: [VertexOfTriangle; 3] = [VertexOfTriangle::First, VertexOfTriangle::Newest, VertexOfTriangle::Seeded];
const LEVELS: [Option<Level>; 4] = [None, Some(Level::Outside), Some(Level::Admissible), Some(Level::Graded)];
const FILLS: [Fill; 3] = [Fill::Seeds, Fill::Parity, Fill::Convex];
const OUTCOMES: [Outcome; 3] = [Outcome::Complete, Outcome::Holey, Outcome::Stopped];

mod tag {
    pub const HEADER: u8 = 0x01;
    pub const VERTEX: u8 = 0x02;
    pub const VERTEX_MARKED: u8 = 0x03;
    pub const SEGMENT: u8 = 0x04;
    pub const SEGMENT_TOGGLES: u8 = 0x05;
    pub const HOLE: u8 = 0x06;
    pub const REGION: u8 = 0x07;
    pub const REGION_BOUNDED: u8 = 0x08;
    pub const START: u8 = 0x09;
    pub const TRIANGLE: u8 = 0x0a;
    pub const END: u8 = 0x0b;
    /// High half of an event's tag; the low half holds the cause (bits 0, 1) and what is said of each kind below.
    pub const FREE: u8 = 0x10;
    /// Bit 2: Type-C. Bit 3: on a shell.
    pub const SPLIT: u8 = 0x20;
    pub const REMOVE: u8 = 0x30;
    /// Bits 2, 3: the reason.
    pub const SKIP: u8 = 0x40;
    pub const TYPE_C: u8 = 4;
    pub const SHELL: u8 = 8;
}

/// The smallest id that the next triangle of `start` can have first.
fn first_of(state: &State) -> u32 {
    state.previous.map_or(0, |t| t[0].0)
}
