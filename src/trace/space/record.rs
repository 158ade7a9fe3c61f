//! What a trace says of a triangulation of space. `docs/trace-format.md` is the normative text.

use crate::model::{Point3, Tetrahedron, VertexId, WeightedPoint};

/// The infinite vertex in the tuples of a trace.
pub const INFINITE: VertexId = VertexId(u32::MAX);

/// The k-th apex (0 to 2) in the tuples of a trace.
pub const fn apex_id(k: u32) -> VertexId {
    VertexId(u32::MAX - 1 - k)
}

/// One record of a triangulation of space: header, vertices, start, its simplices, events, end. Vertices and weights may also come
/// between events.
#[derive(Clone, Debug, PartialEq)]
pub enum Record3 {
    /// The first record.
    Header(Header3),
    /// A point, in order of ids.
    Vertex {
        /// Place and weight in input units.
        point: WeightedPoint,
        /// Where it stood in the input, if the trace has another order.
        input: Option<u32>,
    },
    /// A point gets another weight; the events that follow take it out and put it in again.
    Weight {
        /// The point.
        id: VertexId,
        /// Its new weight, input units.
        weight: f64,
    },
    /// A point is to go; the events that follow take it out.
    Remove {
        /// The point.
        id: VertexId,
    },
    /// The initial triangulation: so many simplices of dimension 3 less the number of apexes follow.
    Start {
        /// The apexes that make tetrahedra of the simplices.
        apexes: Vec<Apex>,
        /// The number of `Simplex` records; 0 for a triangulation of nothing.
        simplices: u32,
    },
    /// A simplex of the initial triangulation with its apexes in order behind it; canonical, ascending.
    Simplex(Tetrahedron),
    /// A step. Events are numbered from 0 in the order they stand.
    Event(Event3),
    /// The last record.
    End(End3),
}

/// The head of a trace of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header3 {
    /// Whether vertices have weights; otherwise all are 0.
    pub weighted: bool,
    /// Whether vertices say where they stood in the input.
    pub permuted: bool,
    /// The run computed with coordinates divided by 2 to this power, and weights by its square.
    pub scale: i32,
}

/// An auxiliary point off the affine hull of a point set of lower dimension: +-4 on an axis, in scaled coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Apex {
    /// 0, 1 or 2 for x, y, z.
    pub axis: u8,
    /// Whether it is on the negative half.
    pub negative: bool,
}

impl Apex {
    /// All six, in the order of their numbers: +x, -x, +y, -y, +z, -z.
    pub const ALL: [Apex; 6] = {
        let mut all = [Apex { axis: 0, negative: false }; 6];
        let mut k = 0;
        while k < 6 {
            all[k] = Apex { axis: k as u8 / 2, negative: k % 2 == 1 };
            k += 1;
        }
        all
    };

    /// Its place, scaled coordinates.
    pub fn place(self) -> Point3 {
        let mut at = [0.0; 3];
        at[usize::from(self.axis % 3)] = if self.negative { -4.0 } else { 4.0 };
        Point3::from_array(at)
    }
}

/// A step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event3 {
    /// A point becomes a vertex. What it destroys is cut out, and every facet left open is joined to it.
    Insert {
        /// The point: the next one, or one that a removal has set free, or one whose weight has grown.
        id: VertexId,
        /// Of the destroyed cells the last in canonical order.
        first: Tetrahedron,
        /// The others, by flood.
        flood: Bits,
    },
    /// A point is hidden.
    Hide {
        /// The point.
        id: VertexId,
        /// Of the tetrahedra that contain it the last in canonical order.
        cell: Tetrahedron,
    },
    /// A point of the same place and weight stands for this one.
    Duplicate {
        /// The point.
        id: VertexId,
        /// The other one.
        of: VertexId,
    },
    /// A point is taken out. Of a vertex, the hole is filled; hidden points that lay in the tetrahedra destroyed or created are free until
    /// the events that follow have placed them. Otherwise nothing else changes.
    Remove {
        /// The point.
        id: VertexId,
        /// For a vertex, the apexes of the cells that fill the hole, in the order of the filling.
        created: Vec<VertexId>,
    },
    /// A vertex is taken out, and a duplicate takes its place.
    Succeed {
        /// The point taken out.
        id: VertexId,
        /// The duplicate of it with the smallest id.
        by: VertexId,
    },
    /// A point off the affine hull of the others becomes a vertex.
    Raise {
        /// The point.
        id: VertexId,
        /// The apexes that remain, places chosen anew.
        apexes: Vec<Apex>,
    },
    /// A vertex in all simplices is taken out.
    Lower {
        /// The vertex.
        id: VertexId,
        /// The apexes, one more than before, places chosen anew.
        apexes: Vec<Apex>,
    },
}

/// A run of bits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bits {
    bytes: Vec<u8>,
    length: u32,
}

impl Bits {
    /// Appends a bit.
    pub fn push(&mut self, bit: bool) {
        if self.length.is_multiple_of(8) {
            self.bytes.push(0);
        }
        // The last byte exists: one was pushed with its first bit.
        if let Some(last) = self.bytes.last_mut() {
            *last |= u8::from(bit) << (self.length % 8);
        }
        self.length += 1;
    }

    /// The k-th bit.
    #[inline]
    pub fn get(&self, k: u32) -> Option<bool> {
        let byte = *self.bytes.get((k / 8) as usize)?;
        (k < self.length).then_some(byte >> (k % 8) & 1 == 1)
    }

    /// At least nine bits from the k-th on, the first lowest; 0 beyond the end.
    #[inline]
    pub fn window(&self, k: u32) -> u32 {
        let byte = |k: u32| self.bytes.get(k as usize).map_or(0, |b| u32::from(*b));
        (byte(k / 8) | byte(k / 8 + 1) << 8) >> (k % 8)
    }

    /// How many there are.
    pub fn len(&self) -> u32 {
        self.length
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.length = 0;
    }

    /// Eight a byte, the first lowest; the rest of the last byte is 0.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// From the form of `bytes`; `None` if the number of bytes is another. Bits beyond the length are dropped.
    pub fn from_bytes(mut bytes: Vec<u8>, length: u32) -> Option<Bits> {
        if bytes.len() != length.div_ceil(8) as usize {
            return None;
        }
        if let (Some(last), rest @ 1..) = (bytes.last_mut(), length % 8) {
            *last &= (1 << rest) - 1;
        }
        Some(Bits { bytes, length })
    }
}

impl FromIterator<bool> for Bits {
    fn from_iter<I: IntoIterator<Item = bool>>(all: I) -> Bits {
        let mut bits = Bits::default();
        all.into_iter().for_each(|bit| bits.push(bit));
        bits
    }
}

/// The last record of a trace of space.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct End3 {
    /// Counts, each also derivable.
    pub counts: Counts3,
    /// blake3 of the canonical triangulation, in hexadecimal: `triangulation_digest`.
    pub mesh: String,
    /// As `End::trace`.
    pub trace: String,
}

/// Counts of a triangulation of space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts3 {
    /// Points that are vertices.
    pub vertices: u32,
    /// Hidden points, duplicates of them not counted.
    pub hidden: u32,
    /// Duplicates.
    pub duplicates: u32,
    /// Points removed.
    pub removed: u32,
    /// Simplices.
    pub simplices: u32,
}
