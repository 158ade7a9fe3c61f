//! The pieces are put together.
//!
//! Inner cells are copied, piece after piece, all threads at each; those of the first piece stay where they are. Slots between them are free. Mixed cells come
//! once, in the order of their ids; of their neighbors each thread knows some. What links are still open are on the boundary of holes, which the
//! triangulation of the torn points fills.

use super::super::fill::{Key, cells_within, key};
use super::super::star::Rim;
use super::super::store::{Cell, FACET, FIRST, NONE, Regular3, Site, Status};
use super::piece::{INNER, Piece};
use crate::arith::space::Kernel3;
use crate::model::{Point3, Sign, WeightedPoint};
use rayon::prelude::*;

/// How many hidden points are searched from the same cell, one after the other: enough that the way to the first one does not matter.
const STRETCH: usize = 1 << 10;

impl<K: Kernel3> Regular3<K> {
    /// Puts the pieces together and fills what they leave open; `None` if they do not fit.
    pub(super) fn assemble(points: &[WeightedPoint], pieces: Vec<Piece>) -> Option<Self> {
        let mut torn: Vec<u32> = pieces.iter().flat_map(|p| &p.torn).copied().collect();
        torn.sort_unstable();
        torn.dedup();
        let filling = || Self::build_alone(&torn.iter().map(|&id| points[id as usize]).collect::<Vec<_>>());
        let (filling, (mut t, mixed)) =
            rayon::join(filling, || rayon::join(|| Self::of_pieces(points, &pieces), || mixed_of_all(&pieces)));
        let first_mixed: u32 = pieces.iter().map(|p| p.cells.len() as u32).sum();
        let links = links_of_mixed(&pieces, &mixed, first_mixed);
        let mut open = Vec::new();
        let mut first_place = FIRST;
        for mut piece in pieces {
            let first_cell = t.cells.len() as u32;
            open.extend(piece.open.iter().map(|&link| link + 4 * first_cell));
            t.free.extend(piece.free.iter().map(|&c| c + first_cell));
            let mut cells = std::mem::take(&mut piece.cells);
            if first_cell == 0 {
                cells.par_iter_mut().zip(&piece.kinds).for_each(|(c, &kind)| *c = piece.moved(c, kind, first_place, 0));
                t.cells = cells;
            } else {
                let moved = |(c, &kind): (&Cell, &u8)| piece.moved(c, kind, first_place, first_cell);
                t.cells.par_extend(cells.par_iter().zip(&piece.kinds).map(moved));
                // To give the memory back takes as long as some thousand points.
                rayon::spawn(move || drop(cells));
            }
            first_place += piece.order.len() as u32;
        }
        let places = &t.places;
        t.cells.par_extend(mixed.par_iter().map(|ids| Cell { v: ids.map(|id| places[id as usize]), n: [NONE; 4] }));
        t.link_mixed(links.iter().flatten())?;
        for c in first_mixed..t.cells.len() as u32 {
            open.extend((4 * c..4 * c + 4).filter(|&link| t.cells[c as usize].n[(link & 3) as usize] == NONE));
        }
        let mut seams = Vec::new();
        let facets = open.iter().map(|&link| (key(t.facet(link)), link)).collect();
        let rim = t.glue_facets(facets, &mut seams);
        torn.iter_mut().for_each(|id| *id = t.places[*id as usize]);
        t.close(&rim, &filling, &torn, &mut seams)?;
        t.marks = vec![0; t.cells.len()];
        t.last = seams.first()?[0] >> 2;
        t.set_hints_from(first_mixed);
        let hidden = t.homeless();
        let cells: Vec<u32> = hidden.par_chunks(STRETCH).flat_map_iter(|stretch| t.cells_of(stretch)).collect();
        t.lodge_together(&hidden, &cells);
        (t.fits(&seams) && t.covers_once(first_mixed as usize)).then_some(t)
    }

    /// A triangulation without cells as yet: points have their places, and those of inner cells their hints.
    fn of_pieces(points: &[WeightedPoint], pieces: &[Piece]) -> Self {
        let mut t = Self::with_capacity(points.len());
        t.dimension = Some(3);
        let (sites, ids, hints, places) = (&mut t.sites, &mut t.ids, &mut t.hints, &mut t.places);
        let order = || pieces.iter().flat_map(|p| &p.order);
        let fill_sites = || {
            pieces.iter().for_each(|p| sites.par_extend(p.order.par_iter().map(|&id| Site::of(points[id as usize]))));
        };
        let fill_names = || {
            ids.extend(order());
            places.resize(points.len(), NONE);
            (FIRST..).zip(order()).for_each(|(place, &id)| places[id as usize] = place);
        };
        let fill_hints = || {
            let mut first_cell = 0;
            for piece in pieces {
                let hint = |&cell: &u32| if cell == NONE { NONE } else { cell + first_cell };
                hints.extend(piece.hints.iter().map(hint));
                first_cell += piece.cells.len() as u32;
            }
        };
        rayon::join(fill_sites, || rayon::join(fill_names, fill_hints));
        t.status.resize(t.sites.len(), Status::Vertex);
        for piece in pieces {
            t.has_weights |= piece.has_weights;
            if piece.unit < t.unit {
                (t.unit, t.exact_below) = (piece.unit, piece.exact_below);
            }
        }
        for [twin, of] in pieces.iter().flat_map(|p| &p.twins) {
            let (twin, of) = (t.places[*twin as usize], t.places[*of as usize]);
            t.make_twin(twin, of);
        }
        t
    }

    /// Links mixed cells with the neighbors that the threads know: pairs of a link and what is to be found there. `None` if two threads contradict each other.
    fn link_mixed<'a>(&mut self, known: impl Iterator<Item = &'a [u32; 2]>) -> Option<()> {
        for &[from, to] in known {
            let link = &mut self.cells[(from >> 2) as usize].n[(from & 3) as usize];
            if *link != NONE && *link != to {
                return None;
            }
            *link = to;
        }
        Some(())
    }

    /// The facet that a link names, seen from inside of its cell.
    fn facet(&self, link: u32) -> [u32; 3] {
        let v = self.cells[(link >> 2) as usize].v;
        FACET[(link & 3) as usize].map(|k| v[k])
    }

    /// Links facets that occur twice, and lists those links; returns the others, seen from outside of the cells.
    fn glue_facets(&mut self, mut facets: Vec<(Key, u32)>, seams: &mut Vec<[u32; 2]>) -> Vec<Rim> {
        facets.sort_unstable();
        let mut rim = Vec::new();
        for same in facets.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, one), (_, other)] = *same {
                self.link(one, other);
                seams.push([one, other]);
                continue;
            }
            for &(_, link) in same {
                let [x, y, z] = self.facet(link);
                rim.push(Rim { v: [x, z, y], outer: link });
            }
        }
        rim
    }

    /// Fills what is open from the triangulation of the points with places `torn`; `None` if that leaves anything open.
    fn close(&mut self, rim: &[Rim], subset: &Self, torn: &[u32], seams: &mut Vec<[u32; 2]>) -> Option<()> {
        if subset.dimension != Some(3) {
            return None;
        }
        let mut facets: Vec<(Key, u32)> = rim.iter().map(|f| (key(f.v), f.outer)).collect();
        for v in cells_within(subset, torn, rim) {
            let c = self.cells.len() as u32;
            facets.extend((0u32..).zip(FACET).map(|(i, f)| (key(f.map(|k| v[k])), 4 * c + i)));
            self.cells.push(Cell { v, n: [NONE; 4] });
        }
        self.glue_facets(facets, seams).is_empty().then_some(())
    }

    /// Whether the complex is regular across the seams and hidden points are.
    fn fits(&self, seams: &[[u32; 2]]) -> bool {
        let regular = |from: u32, to: u32| {
            let cell = &self.cells[(from >> 2) as usize];
            let opposite = self.cells[(to >> 2) as usize].v[(to & 3) as usize];
            opposite < FIRST || !self.in_conflict(cell, self.site(opposite))
        };
        let hidden = |(&c, places): (&u32, &Vec<u32>)| {
            let cell = &self.cells[c as usize];
            !cell.is_ghost() && places.iter().all(|&place| !self.in_conflict(cell, self.site(place)))
        };
        seams.par_iter().all(|&[one, other]| regular(one, other) && regular(other, one))
            && self.lodgers.of_cell.par_iter().all(hidden)
    }

    /// Whether some point lies strictly inside of the planes of all facets of the hull, and in one cell, not on its border. The cells before slot
    /// `mixed` are inner ones.
    ///
    /// Lemma: then no point lies inside of two cells. Proof: cells are positive and the complex is closed, so the facets of the hull cover each direction, as seen
    /// from that point, equally often: as often as cells cover the point, once. So they bound a star-shaped region, which the cells cover once.
    ///
    /// The point is taken inside of the first inner cell. No other inner cell has it: those of the same box are of the same triangulation, those of other
    /// boxes, which are convex, lie there.
    pub(super) fn covers_once(&self, mixed: usize) -> bool {
        let (inner, others) = self.cells.split_at(mixed);
        let Some(first) = inner.iter().find(|c| !c.is_free()) else {
            return false;
        };
        let point = self.corners(first).iter().map(|p| p.at).sum::<Point3>() / 4.0;
        let side = |facet: [u32; 3]| {
            let [a, b, c] = facet.map(|v| self.site(v).at);
            K::orient3d(a, b, c, point)
        };
        // Of each cell, how often it covers the point; `None` if the point is on its border or beyond the hull.
        let covers = |cell: &Cell| {
            if cell.is_ghost() {
                let [a, b, c, _] = cell.v;
                return (side([a, b, c]) == Sign::Negative).then_some(0);
            }
            let [p, q, r, s] = self.corners(cell).map(|p| p.at);
            let near = p.min(q).min(r.min(s)).cmple(point).all() && p.max(q).max(r.max(s)).cmpge(point).all();
            let sides = || FACET.map(|facet| side(facet.map(|k| cell.v[k])));
            match near.then(sides) {
                Some(sides) if sides.contains(&Sign::Negative) => Some(0),
                Some(sides) if sides.contains(&Sign::Zero) => None,
                Some(_) => Some(1),
                None => Some(0),
            }
        };
        let sum = others.par_iter().filter(|c| !c.is_free()).map(covers).try_reduce(|| 0u32, |a, b| Some(a + b));
        covers(first) == Some(1) && sum == Some(0)
    }
}

impl Piece {
    /// A cell as one of the whole, if it is an inner one, where the piece's points and slots start at those; else a free slot.
    #[inline(always)]
    fn moved(&self, cell: &Cell, kind: u8, first_place: u32, first_cell: u32) -> Cell {
        if kind != INNER {
            return Cell::FREE;
        }
        let link = |link: u32| if self.kinds[(link >> 2) as usize] == INNER { link + 4 * first_cell } else { NONE };
        Cell { v: cell.v.map(|v| self.rank[v as usize] + first_place), n: cell.n.map(link) }
    }
}

/// The mixed cells of all pieces, each once, ascending.
fn mixed_of_all(pieces: &[Piece]) -> Vec<[u32; 4]> {
    let mut all: Vec<[u32; 4]> = pieces.iter().flat_map(|p| p.mixed.iter().map(|m| m.ids)).collect();
    all.par_sort_unstable();
    all.dedup();
    all
}

/// For each piece what it knows of the neighbors of mixed cells, for `link_mixed`. Mixed cells have the slots from `first_mixed` on.
fn links_of_mixed(pieces: &[Piece], all: &[[u32; 4]], first_mixed: u32) -> Vec<Vec<[u32; 2]>> {
    let starts = pieces.iter().scan(0, |sum, p| Some(std::mem::replace(sum, *sum + p.cells.len() as u32)));
    let starts: Vec<u32> = starts.collect();
    let of_piece = |(piece, start): (&Piece, u32)| {
        // Per slot that of the whole, if it has a mixed cell. Both lists of those ascend.
        let mut slots = vec![0; piece.cells.len()];
        let mut of_all = (first_mixed..).zip(all);
        for m in &piece.mixed {
            if let Some((slot, _)) = of_all.find(|(_, ids)| **ids == m.ids) {
                slots[m.cell as usize] = slot;
            }
        }
        let mut known = Vec::with_capacity(4 * piece.mixed.len());
        for m in &piece.mixed {
            for (link, beyond) in (4 * slots[m.cell as usize]..).zip(piece.cells[m.cell as usize].n) {
                let (cell, corner) = (beyond >> 2, beyond & 3);
                if piece.kinds[cell as usize] == INNER {
                    let inner = 4 * (cell + start) + corner;
                    known.extend([[link, inner], [inner, link]]);
                } else if slots[cell as usize] != 0 {
                    known.push([link, 4 * slots[cell as usize] + corner]);
                }
            }
        }
        known
    };
    pieces.par_iter().zip(starts).map(of_piece).collect()
}
