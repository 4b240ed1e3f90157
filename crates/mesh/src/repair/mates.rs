//! Which two faces belong together at each edge.

use glam::DVec3;

use super::faces::Faces;
use super::flat::Places;
use super::sets::Sets;

/// No mate: a boundary.
pub(super) const NONE: u32 = u32::MAX;

/// At an edge with more faces than this all are taken apart: trying every pair goes with the square.
const MOST_PAGES: usize = 32;

/// The half-edge of the same edge that each is joined to, whichever way they run.
pub(super) struct Mates {
    /// For each half-edge, or [`NONE`].
    pub(super) across: Vec<u32>,
    /// Vertices at the ends of edges that were taken apart or cut.
    pub(super) torn: Vec<bool>,
    /// Edges with more than two faces.
    pub(super) edges_split: usize,
}

/// A half-edge under its edge: the lower end, the higher end, and its own number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Entry {
    edge: u64,
    pub(super) half_edge: u32,
}

impl Entry {
    fn lower(self) -> u32 {
        (self.edge >> 32) as u32
    }

    fn higher(self) -> u32 {
        self.edge as u32
    }
}

/// Where a half-edge starts and ends.
#[inline]
pub(super) fn ends(corners: &[[u32; 3]], half_edge: u32) -> (u32, u32) {
    let [a, b, c] = corners[half_edge as usize / 3];
    match half_edge % 3 {
        0 => (a, b),
        1 => (b, c),
        _ => (c, a),
    }
}

/// Every half-edge, sorted so that those of one edge are side by side.
pub(super) fn by_edge(corners: &[[u32; 3]]) -> Vec<Entry> {
    let entry = |half_edge| {
        let (from, to) = ends(corners, half_edge);
        Entry { edge: u64::from(from.min(to)) << 32 | u64::from(from.max(to)), half_edge }
    };
    let mut entries: Vec<Entry> = (0..3 * corners.len() as u32).map(entry).collect();
    entries.sort_unstable();
    entries
}

pub(super) fn edges(entries: &[Entry]) -> impl Iterator<Item = &[Entry]> {
    entries.chunk_by(|a, b| a.edge == b.edge)
}

impl Mates {
    /// Joins faces at edges that have two, and at edges with more the pairs that belong together best.
    pub(super) fn of(faces: &Faces, places: &Places<'_>) -> Self {
        let mut mates = Self { across: vec![NONE; 3 * faces.len()], torn: vec![false; places.positions.len()], edges_split: 0 };
        let entries = by_edge(&faces.corners);
        let mut pieces = Sets::new(faces.len());
        for edge in edges(&entries) {
            if let [a, b] = edge {
                mates.join(a.half_edge, b.half_edge);
                pieces.join(a.half_edge / 3, b.half_edge / 3);
            }
        }
        for edge in edges(&entries).filter(|edge| edge.len() > 2) {
            mates.edges_split += 1;
            mates.torn[edge[0].lower() as usize] = true;
            mates.torn[edge[0].higher() as usize] = true;
            if edge.len() <= MOST_PAGES {
                mates.join_pages(edge, faces, places, &mut pieces);
            }
        }
        mates
    }

    /// Joins the pages of an edge two by two: first those that hang together elsewhere, then those that run opposite ways, then the flattest pair.
    fn join_pages(&mut self, edge: &[Entry], faces: &Faces, places: &Places<'_>, pieces: &mut Sets) {
        let pages: Vec<Page> = edge.iter().map(|&entry| Page::of(entry, faces, places, pieces)).collect();
        let pairs = pages.iter().enumerate().flat_map(|(k, page)| pages[k + 1..].iter().map(move |other| (page, other)));
        let mut ranked: Vec<(&Page, &Page)> = pairs.collect();
        ranked.sort_by(|a, b| Page::rank(*a).partial_cmp(&Page::rank(*b)).unwrap_or(std::cmp::Ordering::Equal));
        for (a, b) in ranked {
            if self.across[a.half_edge as usize] == NONE && self.across[b.half_edge as usize] == NONE {
                self.join(a.half_edge, b.half_edge);
            }
        }
    }

    fn join(&mut self, a: u32, b: u32) {
        self.across[a as usize] = b;
        self.across[b as usize] = a;
    }

    /// Numbers half-edges anew after some faces were turned: the first corner stays, so that the first and the last side change places.
    pub(super) fn follow(&mut self, turned: &[bool]) {
        let name = |half_edge: u32| match half_edge {
            NONE => NONE,
            h if turned[h as usize / 3] => h - h % 3 + (2 - h % 3),
            h => h,
        };
        let mut across = vec![NONE; self.across.len()];
        for (half_edge, &mate) in (0..).zip(&self.across) {
            across[name(half_edge) as usize] = name(mate);
        }
        self.across = across;
    }

    /// Opens the edge: a boundary on both sides.
    pub(super) fn part(&mut self, half_edge: u32) {
        let mate = std::mem::replace(&mut self.across[half_edge as usize], NONE);
        if mate != NONE {
            self.across[mate as usize] = NONE;
        }
    }
}

/// A face at an edge that has several.
struct Page {
    half_edge: u32,
    piece: u32,
    upwards: bool,
    /// From the edge into the face.
    inwards: DVec3,
}

impl Page {
    fn of(entry: Entry, faces: &Faces, places: &Places<'_>, pieces: &mut Sets) -> Self {
        let (lower, higher, half_edge) = (entry.lower(), entry.higher(), entry.half_edge);
        let (from, _) = ends(&faces.corners, half_edge);
        let apex = ends(&faces.corners, half_edge - half_edge % 3 + (half_edge + 2) % 3).0;
        let [low, high, apex] = [lower, higher, apex].map(|v| places.positions[v as usize]);
        let along = crate::unit(places.scale.between(low, high));
        let side = places.scale.between(low, apex);
        let inwards = crate::unit(side - side.dot(along) * along);
        Self { half_edge, piece: pieces.lowest(half_edge / 3), upwards: from == lower, inwards }
    }

    /// The lower, the better they go together.
    fn rank((a, b): (&Self, &Self)) -> (bool, bool, f64) {
        (a.piece != b.piece, a.upwards == b.upwards, a.inwards.dot(b.inwards))
    }
}
