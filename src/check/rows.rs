//! The inequalities of the theory at each event, `docs/gcdr.md` rows A2 to C4'. They are claimed at the admissible and graded levels.
//!
//! Parameters are the nominal ones where the stored point lies in its nominal region, those with slack where it lies in theirs, and the row is off
//! where it lies in neither (the effective level at the end then is `outside`). A row between lengths that fails as printed may use up to the
//! distances of its segment vertices to their input segments: `delta`, bounded from above; the other side is then bounded from below.

use super::complex::Kind;
use super::condition::{
    compare_lengths, distance2, in_diametral_disk, in_selection_disk, in_selection_interval, shortest_edge,
};
use super::predicates::{Corners, area2, center, cross, dot, vector};
use super::replay::Replay;
use super::scale::power_of_two;
use super::sight::exit_edge;
use super::split::Split;
use super::value::{Approx, Exact, Number, exact_sign};
use super::verdict::{Checked, Rule, ensure};
use crate::model::{DeletionPolicy, GcdrParameters, Level, Point2};
use crate::trace::{Cause, SplitKind};

/// d1, d2, mu.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deltas {
    /// Shortens the interval of Type-B.
    pub d1: f64,
    /// Shrinks the disk of Type-A.
    pub d2: f64,
    /// Shortens the interval of Type-C.
    pub mu: f64,
}

/// The selection regions of a run, and which of them its points have needed so far.
#[derive(Clone, Copy, Debug)]
pub struct Regions {
    /// Whether the level claims the rows.
    pub claimed: bool,
    /// As in the header.
    pub nominal: Deltas,
    /// Times 1 - 2^-20, rounded down.
    pub slack: Deltas,
    /// Some point left its nominal region.
    pub left_nominal: bool,
    /// Some point left its region with slack.
    pub left_slack: bool,
}

impl Regions {
    /// The regions of a run.
    pub fn new(parameters: &GcdrParameters, level: Level) -> Regions {
        let nominal = Deltas { d1: parameters.d1, d2: parameters.d2, mu: parameters.mu };
        let slack = Deltas { d1: loosened(nominal.d1), d2: loosened(nominal.d2), mu: loosened(nominal.mu) };
        Regions { claimed: level != Level::Outside, nominal, slack, left_nominal: false, left_slack: false }
    }

    /// The parameters whose disk of t holds the Type-A point a.
    pub fn disk(&mut self, t: Corners, a: Point2) -> Option<Deltas> {
        let found = self.disk_of_rejected(t, a);
        self.note(found)
    }

    /// The parameters whose disk of t holds the rejected point a: it is no vertex, so the effective level does not ask for it.
    pub fn disk_of_rejected(&self, t: Corners, a: Point2) -> Option<Deltas> {
        self.smallest(|d| in_selection_disk(t, d.d2, a))
    }

    /// The parameters whose interval of uv holds p.
    pub fn interval(&mut self, kind: SplitKind, [u, v]: [Point2; 2], p: Point2) -> Option<Deltas> {
        let found = self.smallest(|d| {
            let delta = if kind == SplitKind::B { d.d1 } else { d.mu };
            in_selection_interval(u, v, delta, p)
        });
        self.note(found)
    }

    fn smallest(&self, holds: impl Fn(Deltas) -> bool) -> Option<Deltas> {
        if !self.claimed {
            return None;
        }
        [self.nominal, self.slack].into_iter().find(|&d| holds(d))
    }

    fn note(&mut self, found: Option<Deltas>) -> Option<Deltas> {
        self.left_nominal |= found != Some(self.nominal);
        self.left_slack |= found.is_none();
        found
    }
}

/// x (1 - 2^-20), rounded down.
pub fn loosened(x: f64) -> f64 {
    let factor = 1.0 - power_of_two(-20);
    let rounded = x * factor;
    let excess = Exact::of(rounded) - Exact::of(x) * Exact::of(factor);
    if exact_sign(&excess).is_positive() { rounded.next_down() } else { rounded }
}

/// The smaller of each.
fn weaker(a: Deltas, b: Deltas) -> Deltas {
    Deltas { d1: a.d1.min(b.d1), d2: a.d2.min(b.d2), mu: a.mu.min(b.mu) }
}

/// What the rows speak of. A distance is a pair of points; R and R' are those of p and of its parent.
#[derive(Clone, Copy, Debug)]
struct Case {
    rho2: f64,
    deltas: Deltas,
    /// The bad triangle.
    t: Corners,
    /// Its shortest edge.
    l: [Point2; 2],
    /// The separator: the edge of t that the way to its Steiner point leaves through.
    separator: [Point2; 2],
    /// The subsegment.
    s: [Point2; 2],
    p: Point2,
    /// p and its nearest vertex.
    r: [Point2; 2],
    parent: Point2,
    /// The parent and its nearest vertex.
    r_parent: [Point2; 2],
    /// Common end of two incident input segments, and their far ends.
    incident: [Point2; 3],
}

/// A row: its two sides, as squares of lengths.
#[derive(Clone, Copy, Debug)]
enum Row {
    /// R >= d2 r
    A3,
    /// l >= R'
    A4,
    /// R >= rho d2 R'
    A5,
    /// (1 - d2) r >= h, if h > 0
    S1Height,
    /// |separator| > l
    S1Longer,
    /// R >= |p x|; p stands on both sides, nearer to its nearest vertex and further from x by its deviation
    Nearest(Point2),
    /// 2 R >= d1 S
    B1,
    /// S >= l sqrt(4 - 1/rho2)
    B2,
    /// R >= d1 sqrt(1 - 1/(4 rho2)) R'
    B3,
    /// (1 - d2) r >= dist(o, line s)
    B4Line,
    /// S/2 >= r sqrt(q2)
    B4Chord,
    /// R >= rho d1 sqrt(q2) R'
    B4Parent,
    /// (2 - d1) S > 2 |p p'|
    B5Inside,
    /// 2 R >= mu S
    C1,
    /// 2 R cos(alpha) >= mu R', or without mu
    C2 { nearest: bool },
    /// S cos(alpha) >= |p' v|
    C2End,
    /// (2 - mu) S > 2 |p p'|
    C4,
}

/// Both sides of a row, squared and multiplied by a common factor, which comes third: greater, lesser, factor.
fn sides<N: Number>(row: Row, c: &Case) -> [N; 3] {
    let one = || N::of(1.0);
    let length2 = |[a, b]: [Point2; 2]| distance2::<N>(a, b);
    let rho2 = || N::of(c.rho2);
    let d1_2 = || N::of(c.deltas.d1).square();
    let d2_2 = || N::of(c.deltas.d2).square();
    let mu_2 = || N::of(c.deltas.mu).square();
    // q2 = 2 d2 - d2^2
    let q2 = || N::of(c.deltas.d2) * (N::of(2.0) - N::of(c.deltas.d2));
    // r^2 = |C|^2 / (4 D^2)
    let circle = || {
        let (c, d) = center::<N>(c.t);
        (super::predicates::norm2(&c), N::of(4.0) * d.square())
    };
    // cos^2(alpha) = (x.y)^2 / (x^2 y^2)
    let angle = || {
        let [v, x, y] = c.incident;
        let (x, y) = (vector::<N>(v, x), vector::<N>(v, y));
        (dot(&x, &y).square(), super::predicates::norm2(&x) * super::predicates::norm2(&y))
    };
    match row {
        Row::A3 => {
            let (r2, unit) = circle();
            [length2(c.r) * unit.clone(), d2_2() * r2, unit]
        }
        Row::A4 => [length2(c.l), length2(c.r_parent), one()],
        Row::A5 => [length2(c.r), rho2() * d2_2() * length2(c.r_parent), one()],
        Row::S1Height => {
            let (r2, unit) = circle();
            let h = height::<N>(c);
            let e2 = length2(c.separator);
            [(one() - N::of(c.deltas.d2)).square() * r2 * e2.clone(), h.square(), unit * e2]
        }
        Row::S1Longer => [length2(c.separator), length2(c.l), one()],
        Row::Nearest(x) => [length2(c.r), length2([c.p, x]), one()],
        Row::B1 => [N::of(4.0) * length2(c.r), d1_2() * length2(c.s), N::of(4.0)],
        Row::B2 => [rho2() * length2(c.s), (N::of(4.0) * rho2() - one()) * length2(c.l), rho2()],
        Row::B3 => {
            let unit = N::of(4.0) * rho2();
            [unit.clone() * length2(c.r), d1_2() * (unit.clone() - one()) * length2(c.r_parent), unit]
        }
        Row::B4Line => {
            let (r2, unit) = circle();
            let h = height_over::<N>(c, c.s);
            let s2 = length2(c.s);
            [(one() - N::of(c.deltas.d2)).square() * r2 * s2.clone(), h.square(), unit * s2]
        }
        Row::B4Chord => {
            let (r2, unit) = circle();
            let unit = N::of(4.0) * unit;
            [unit.clone() * length2(c.s), N::of(16.0) * q2() * r2, N::of(4.0) * unit]
        }
        Row::B4Parent => [length2(c.r), rho2() * d1_2() * q2() * length2(c.r_parent), one()],
        Row::B5Inside => {
            let k = (N::of(2.0) - N::of(c.deltas.d1)).square();
            [k * length2(c.s), N::of(4.0) * length2([c.p, c.parent]), N::of(4.0)]
        }
        Row::C1 => [N::of(4.0) * length2(c.r), mu_2() * length2(c.s), N::of(4.0)],
        Row::C2 { nearest } => {
            let (cosine, unit) = angle();
            let k = if nearest { one() } else { mu_2() };
            [N::of(4.0) * length2(c.r) * cosine, k * unit.clone() * length2(c.r_parent), unit]
        }
        Row::C2End => {
            let (cosine, unit) = angle();
            [length2(c.s) * cosine, unit.clone() * length2([c.parent, c.incident[0]]), unit]
        }
        Row::C4 => {
            let k = (N::of(2.0) - N::of(c.deltas.mu)).square();
            [k * length2(c.s), N::of(4.0) * length2([c.p, c.parent]), N::of(4.0)]
        }
    }
}

/// cross(e, o - e0) times 2 D for an edge e: the distance of o from its line, times |e| 2 D, positive on the left.
fn height_over<N: Number>(c: &Case, [a, b]: [Point2; 2]) -> N {
    let (to_center, d) = center::<N>(c.t);
    let e = vector::<N>(a, b);
    cross(&e, &to_center) + (d.clone() + d) * cross(&e, &vector(a, c.t[0]))
}

/// The signed distance of the separator from o, positive if o lies on the side of t.
fn height<N: Number>(c: &Case) -> N {
    height_over(c, c.separator)
}

fn difference<N: Number>(row: Row, c: &Case) -> N {
    let [greater, lesser, _] = sides::<N>(row, c);
    greater - lesser
}

/// Whether a row holds; `delta` is what it is allowed.
fn holds(row: Row, c: &Case, delta: f64) -> bool {
    let sign = super::value::sign_of!(difference(row, c));
    if sign.is_positive()
        || (sign == crate::model::Sign::Zero && !matches!(row, Row::S1Longer | Row::B5Inside | Row::C4))
    {
        return true;
    }
    delta > 0.0
        && (!super::value::sign_of!(excess(row, c, delta)).is_positive()
            || !super::value::sign_of!(room(row, c, delta)).is_negative())
}

/// sqrt(lesser) <= sqrt(greater) + delta sqrt(factor), squared: E = lesser - greater - delta^2 factor is at most 2 delta sqrt(greater factor), that
/// is E <= 0, or E^2 <= 4 delta^2 greater factor.
fn excess<N: Number>(row: Row, c: &Case, delta: f64) -> N {
    let [greater, lesser, factor] = sides::<N>(row, c);
    lesser - greater - N::of(delta).square() * factor
}

fn room<N: Number>(row: Row, c: &Case, delta: f64) -> N {
    let [greater, _, factor] = sides::<N>(row, c);
    N::of(4.0) * N::of(delta).square() * greater * factor - excess::<N>(row, c, delta).square()
}

fn require(rule: Rule, row: Row, c: &Case, delta: f64) -> Checked {
    ensure(holds(row, c, delta), rule, || {
        let [greater, lesser, factor] = sides::<Approx>(row, c).map(Approx::value);
        let (greater, lesser) = ((greater / factor).sqrt(), (lesser / factor).sqrt());
        (format!("{row:?}: {greater:e} + {delta:e} to reach {lesser:e} (scaled units)"), format!("{:?}", c.deltas))
    })
}

/// The newest vertex of the shortest edge of t, and that edge.
fn parent_and_edge(t: Corners, ids: [u32; 3]) -> (u32, [Point2; 2]) {
    let k = shortest_edge(t, ids);
    let l = (k + 1) % 3;
    (ids[k].max(ids[l]), [t[k], t[l]])
}

fn case(replay: &Replay, t: Corners, ids: [u32; 3], deltas: Deltas, p: u32) -> (Case, u32) {
    let (parent, l) = parent_and_edge(t, ids);
    let at = |v: u32| replay.mesh.at(v);
    let r = |v: u32| [at(v), at(replay.mesh.vertices[v as usize].nearest)];
    let case = Case {
        rho2: replay.ledger.parameters.rho2,
        deltas,
        t,
        l,
        separator: l,
        s: l,
        p: at(p),
        r: r(p),
        parent: at(parent),
        r_parent: r(parent),
        incident: [at(p); 3],
    };
    (case, parent)
}

/// Rows A3 to A5, after the insertion of p for t.
pub fn type_a(replay: &Replay, p: u32, t: Corners, ids: [u32; 3], cause: Cause, deltas: Option<Deltas>) -> Checked {
    let Some(deltas) = deltas else { return Ok(()) };
    let (case, _) = case(replay, t, ids, deltas, p);
    require(Rule::A3, Row::A3, &case, 0.0)?;
    if cause == Cause::Skinny {
        require(Rule::A4, Row::A4, &case, 0.0)?;
        require(Rule::A5, Row::A5, &case, 0.0)?;
    }
    Ok(())
}

/// Row S1, before anything is changed.
pub fn before_split(replay: &Replay, split: &Split) -> Checked {
    let (Some(deltas), Some(e)) = (split.deltas, exit_edge(&replay.mesh, split.t, split.a)) else {
        return Ok(());
    };
    let (t, ids) = (replay.mesh.places(split.t), replay.mesh.corners(split.t));
    let (mut case, _) = case(replay, t, ids, deltas, ids[0]);
    case.separator = [replay.mesh.origin(e), replay.mesh.target(e)].map(|v| replay.mesh.at(v));
    if super::value::sign_of!(height(&case)).is_positive() {
        require(Rule::S1, Row::S1Height, &case, 0.0)?;
    }
    if split.cause == Cause::Skinny {
        require(Rule::S1, Row::S1Longer, &case, 0.0)?;
    }
    Ok(())
}

/// Rows B1' to B6' or C1' to C4', after the insertion of p on s for t.
pub fn after_split(
    replay: &Replay,
    split: &Split,
    p: u32,
    (t, ids): (Corners, [u32; 3]),
    interval: Option<Deltas>,
) -> Checked {
    let (Some(a), Some(b)) = (split.deltas, interval) else {
        return Ok(());
    };
    let (mut case, parent) = case(replay, t, ids, weaker(a, b), p);
    case.s = split.ends.map(|v| replay.mesh.at(v));
    match split.kind {
        SplitKind::B => type_b(replay, split, &case, parent, p),
        SplitKind::C { parent } => {
            case.parent = replay.mesh.at(parent.0);
            case.r_parent = [case.parent, replay.mesh.at(replay.mesh.vertices[parent.0 as usize].nearest)];
            type_c(replay, split, &mut case, parent.0, p)
        }
    }
}

fn type_b(replay: &Replay, split: &Split, case: &Case, parent: u32, p: u32) -> Checked {
    let delta = [p, split.ends[0], split.ends[1], parent].iter().map(|&v| deviation(replay, v)).sum();
    if !holds(Row::Nearest(case.s[0]), case, 2.0 * delta) {
        require(Rule::B1, Row::Nearest(case.s[1]), case, 2.0 * delta)?;
    }
    require(Rule::B1, Row::B1, case, delta)?;
    if split.cause != Cause::Skinny {
        return Ok(());
    }
    require(Rule::B2, Row::B2, case, delta)?;
    require(Rule::B2, Row::A4, case, delta)?;
    require(Rule::B3, Row::B3, case, delta)?;
    if in_diametral_disk(case.s[0], case.s[1], case.parent) {
        require(Rule::B5, Row::B5Inside, case, delta)?;
        // For tiny angles the lemma behind B6' is open (erratum 8).
        let kind = replay.mesh.vertices[parent as usize].kind;
        let free =
            kind == Kind::Deleted || (kind == Kind::Free && replay.ledger.parameters.deletion == DeletionPolicy::Point);
        ensure(free || case.rho2 > 25.0, Rule::B6, || {
            ("a free parent, deleted in this step", format!("vertex {parent}, {kind:?}"))
        })
    } else {
        require(Rule::B4, Row::B4Line, case, delta)?;
        require(Rule::B4, Row::B4Chord, case, delta)?;
        require(Rule::B4, Row::B4Parent, case, delta)?;
        ensure(external_parent_is_near(case, delta), Rule::B5, || {
            ("2 |p p'| <= (1 + sqrt((2 - d2)/d2) - d1) S", format!("vertex {parent}"))
        })
    }
}

/// B5', external: 2 |p p'| <= (1 - d1 + sqrt((2 - d2)/d2)) S. With E = d2 4 |pp'|^2 - (d2 (1-d1)^2 + 2 - d2) S^2 that is E <= 0 or
/// E^2 <= 4 (1-d1)^2 d2 (2-d2) S^4.
fn external_parent_is_near(case: &Case, delta: f64) -> bool {
    if delta > 0.0 {
        // Both square roots in floating point, each side moved against the row by more than its roundings.
        let [u, v] = case.s;
        let k = 1.0 - case.deltas.d1 + ((2.0 - case.deltas.d2) / case.deltas.d2).sqrt();
        let reach = k * distance2::<Approx>(u, v).bounds().0.max(0.0).sqrt() * (1.0 - 1e-14);
        let needed = 2.0 * distance2::<Approx>(case.p, case.parent).bounds().1.sqrt() * (1.0 + 1e-14);
        if reach + delta * (1.0 - 1e-15) >= needed {
            return true;
        }
    }
    fn excess<N: Number>(c: &Case) -> N {
        let (d1, d2, two) = (N::of(c.deltas.d1), N::of(c.deltas.d2), N::of(2.0));
        let k = d2.clone() * (N::of(1.0) - d1).square() + two - d2.clone();
        N::of(4.0) * d2 * distance2(c.p, c.parent) - k * distance2(c.s[0], c.s[1])
    }
    fn rest<N: Number>(c: &Case) -> N {
        let (d1, d2) = (N::of(c.deltas.d1), N::of(c.deltas.d2));
        let k = N::of(4.0) * (N::of(1.0) - d1).square() * d2.clone() * (N::of(2.0) - d2);
        k * distance2::<N>(c.s[0], c.s[1]).square() - excess::<N>(c).square()
    }
    !super::value::sign_of!(excess(case)).is_positive() || !super::value::sign_of!(rest(case)).is_negative()
}

fn type_c(replay: &Replay, split: &Split, case: &mut Case, parent: u32, p: u32) -> Checked {
    let delta = [p, split.ends[0], split.ends[1], parent].iter().map(|&v| deviation(replay, v)).sum();
    let candidates = [case.parent, case.s[0], case.s[1]];
    let Some(nearest) = candidates.iter().position(|&x| holds(Row::Nearest(x), case, 2.0 * delta)) else {
        return require(Rule::C1, Row::Nearest(case.parent), case, 2.0 * delta);
    };
    if nearest != 0 {
        require(Rule::C1, Row::C1, case, delta)?;
    }
    require(Rule::C4, Row::C4, case, delta)?;
    if let Some(incident) = incident(replay, p, parent) {
        case.incident = incident;
        let [v, x, y] = incident;
        let acute = super::value::sign_of!(cosine(v, x, y)).is_positive();
        ensure(acute, Rule::C2, || ("an acute angle between incident segments", format!("parent {parent}")))?;
        require(Rule::C2, Row::C2 { nearest: nearest == 0 }, case, delta)?;
        require(Rule::C2, Row::C2End, case, delta)?;
    }
    Ok(())
}

fn cosine<N: Number>(v: Point2, x: Point2, y: Point2) -> N {
    dot(&vector::<N>(v, x), &vector(v, y))
}

/// The common end of the input segments of the parent and of s, and their far ends; `None` if they have none.
fn incident(replay: &Replay, p: u32, parent: u32) -> Option<[Point2; 3]> {
    let a = replay.mesh.vertices[parent as usize].segment()?;
    let b = replay.mesh.vertices[p as usize].segment()?;
    let [a, b] = [a, b].map(|s| replay.ledger.segments[s as usize].ends.map(|v| v.0));
    let shared = a.into_iter().find(|v| b.contains(v))?;
    let far = |s: [u32; 2]| if s[0] == shared { s[1] } else { s[0] };
    Some([shared, far(a), far(b)].map(|v| replay.mesh.at(v)))
}

/// An upper bound of the distance of a segment vertex to the line of its input segment; 0 for others.
fn deviation(replay: &Replay, v: u32) -> f64 {
    let vertex = &replay.mesh.vertices[v as usize];
    let Some(s) = vertex.segment() else {
        return 0.0;
    };
    let [a, b] = replay.ledger.segments[s as usize].ends.map(|v| replay.mesh.at(v.0));
    let off = area2::<Approx>(a, b, vertex.at).bounds();
    let off = off.0.abs().max(off.1.abs());
    let length = distance2::<Approx>(a, b).bounds().0.max(0.0).sqrt();
    if length > 0.0 && off > 0.0 { (off / length) * (1.0 + 1e-14) } else { 0.0 }
}

impl Replay {
    /// Freezes R of a new vertex: the nearest vertex on the rim just left.
    pub(super) fn measure(&mut self, p: u32) {
        let at = self.mesh.at(p);
        let mut nearest = p;
        for w in self.rim.iter().flat_map(|r| [r.from, r.to]) {
            if w != nearest
                && (nearest == p || compare_lengths(at, self.mesh.at(w), at, self.mesh.at(nearest)).is_negative())
            {
                nearest = w;
            }
        }
        self.mesh.vertices[p as usize].nearest = nearest;
    }
}
