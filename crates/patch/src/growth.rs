//! One patch: grown face by face, solved, and cut back until every face keeps the bounds.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;
use pelage_mesh::{Face, FaceId, Topology, Vertex, VertexId};

use crate::disc::{Contact, Disc};
use crate::distortion::Bounds;
use crate::frame::conjugate;
use crate::shape::FaceShape;
use crate::solve::{Patchwork, Unsolved, Wish, solve};
use crate::splotch::Splotch;

/// No patch.
pub(crate) const UNCOVERED: u32 = u32::MAX;
/// A patch is first solved at this many faces, then whenever it has doubled, so that tentative places do not drift and all solves together
/// cost little more than the last.
const FIRST_SOLVE: usize = 16;
/// So often are only the offending faces dropped; after that half of the patch, so that a patch of *n* faces takes O(log *n*) solves.
const GENTLE_ROUNDS: usize = 6;
/// A face with two sides on the patch may lie this much further out than one with a single side: it shortens the outline.
const WEDGE_REACH: f64 = 1.2;

/// The faces of a patch in the order in which they came, and its vertices with their places, in tiles from the middle of the first face.
#[derive(Clone, Debug)]
pub(crate) struct Draft {
    pub(crate) faces: Vec<FaceId>,
    pub(crate) vertices: Vec<VertexId>,
    pub(crate) places: Vec<DVec2>,
    pub(crate) splotch: Splotch,
}

/// What growing a patch needs to know, and the arrays it works in.
pub(crate) struct Grower<'a> {
    pub(crate) topology: &'a Topology,
    pub(crate) shapes: &'a [FaceShape],
    /// The wanted rotation of each face; none where the tiling is isotropic.
    pub(crate) rotations: Option<&'a [DVec2]>,
    /// Faces that need not follow the field.
    pub(crate) let_off: Vec<bool>,
    /// See [`Wish::alignment`].
    pub(crate) alignment: f64,
    pub(crate) bounds: Bounds,
    /// The patch of each face, or `UNCOVERED`.
    pub(crate) owners: Vec<u32>,
    disc: Disc,
    frontier: BinaryHeap<Reverse<(u64, u32)>>,
    /// Faces that the present patch has dropped bear the present number.
    bans: Vec<u32>,
    ban: u32,
    /// The place of each face in the order being replayed; `u32::MAX` between replays.
    ranks: Vec<u32>,
}

impl<'a> Grower<'a> {
    pub(crate) fn new(topology: &'a Topology, shapes: &'a [FaceShape], wish: Wish<'a>, bounds: Bounds) -> Self {
        let faces = topology.face_count();
        Self {
            topology,
            shapes,
            rotations: wish.rotations,
            let_off: vec![false; faces],
            alignment: wish.alignment,
            bounds,
            owners: vec![UNCOVERED; faces],
            disc: Disc::new(topology),
            frontier: BinaryHeap::new(),
            bans: vec![0; faces],
            ban: 0,
            ranks: vec![u32::MAX; faces],
        }
    }

    /// A patch of one face, placed exactly: without a field, turned by `orientation`.
    pub(crate) fn single(&self, seed: FaceId, splotch: Splotch, orientation: DVec2) -> Draft {
        let shape = &self.shapes[seed.index()];
        let rotation = self.rotations.map_or(orientation, |r| r[seed.index()]);
        let places = shape.corners.map(|p| rotation.rotate(p - shape.centre()));
        Draft {
            faces: vec![seed],
            vertices: self.topology.face(seed).vertices().map(Vertex::id).to_vec(),
            places: places.to_vec(),
            splotch,
        }
    }

    /// Grows a patch over uncovered faces inside its splotch times `swelling`. What it held it keeps, within the bounds.
    pub(crate) fn grow(&mut self, core: &Draft, swelling: f64) -> Draft {
        self.next_ban();
        self.load(core);
        self.queue_border();
        let mut next_solve = FIRST_SOLVE.max(2 * core.faces.len());
        let mut settled = true;
        while let Some(Reverse((_, face))) = self.frontier.pop() {
            let face = FaceId(face);
            let Some(places) = self.tentative(face) else { continue };
            if !self.reaches(core, face, places, swelling) || !self.keeps_bounds(face, places) {
                continue;
            }
            self.disc.push(self.topology, face, places);
            settled = false;
            if self.disc.faces.len() >= next_solve {
                self.settle(core);
                settled = true;
                next_solve = FIRST_SOLVE.max(2 * self.disc.faces.len());
                self.queue_border();
            } else {
                self.queue_neighbours(face);
            }
        }
        if !settled {
            self.settle(core);
        }
        Draft {
            faces: self.disc.faces.clone(),
            vertices: self.disc.vertices.clone(),
            places: self.disc.places.clone(),
            splotch: core.splotch,
        }
    }

    fn next_ban(&mut self) {
        if self.ban == u32::MAX {
            self.bans.fill(0);
            self.ban = 0;
        }
        self.ban += 1;
    }

    fn load(&mut self, draft: &Draft) {
        self.disc.clear();
        for &face in &draft.faces {
            self.disc.push(self.topology, face, [DVec2::ZERO; 3]);
        }
        self.disc.places.copy_from_slice(&draft.places);
    }

    /// Starts the frontier anew, as solving has moved everything.
    fn queue_border(&mut self) {
        self.frontier.clear();
        for index in 0..self.disc.faces.len() {
            self.queue_neighbours(self.disc.faces[index]);
        }
    }

    fn queue_neighbours(&mut self, face: FaceId) {
        for neighbour in self.topology.face(face).neighbours().map(Face::id) {
            if self.is_free(neighbour)
                && let Some(places) = self.tentative(neighbour)
            {
                self.frontier.push(Reverse((nearness(centre(places)), neighbour.0)));
            }
        }
    }

    /// Whether the present patch may take the face.
    fn is_free(&self, face: FaceId) -> bool {
        self.owners[face.index()] == UNCOVERED && self.bans[face.index()] != self.ban && !self.disc.contains(face)
    }

    /// Where the face's corners would lie; none where it is not free or would leave no disc.
    fn tentative(&self, face: FaceId) -> Option<[DVec2; 3]> {
        if !self.is_free(face) {
            return None;
        }
        let contact = self.disc.contact(self.topology, face);
        let places = self.topology.face(face).vertices().map(|v| self.disc.place(v.id()));
        match contact {
            Contact::Barred => None,
            Contact::Wedge => Some([places[0]?, places[1]?, places[2]?]),
            Contact::Side { side } => {
                let [from, to, opposite] = [side, (side + 1) % 3, (side + 2) % 3];
                let mut all = places.map(Option::unwrap_or_default);
                all[opposite] = self.unfold(face, side, [all[from], all[to]]);
                Some(all)
            }
        }
    }

    /// The ideal place of a face's third corner, given the other two, `side` and the next: turned as the face across that side, unfolded, and
    /// as the field wants it, weighted as in [`solve`].
    fn unfold(&self, face: FaceId, side: usize, [start, end]: [DVec2; 2]) -> DVec2 {
        let shape = &self.shapes[face.index()];
        let pull = self.alignment * self.wanted(face).unwrap_or(DVec2::ZERO);
        let rotation = (self.unfolded_rotation(face, side) + pull).try_normalize().unwrap_or(DVec2::X);
        let [from, to, opposite] = [side, (side + 1) % 3, (side + 2) % 3].map(|k| shape.corners[k]);
        0.5 * (start + end) + rotation.rotate(opposite - 0.5 * (from + to))
    }

    /// The rotation of the face across a side, carried over that side. It is taken from all sides of that face, for a short side's image says
    /// little: in a row of needles each error would be magnified by the next.
    fn unfolded_rotation(&self, face: FaceId, side: usize) -> DVec2 {
        let Some(twin) = self.topology.face(face).half_edges()[side].twin() else { return DVec2::ZERO };
        let across = twin.face();
        let shape = &self.shapes[across.index()];
        let places = across.vertices().map(|v| self.disc.place(v.id()).unwrap_or_default());
        let rotation = (0..3).fold(DVec2::ZERO, |sum, k| {
            let (flat, placed) = (shape.corners[(k + 1) % 3] - shape.corners[k], places[(k + 1) % 3] - places[k]);
            sum + DVec2::new(flat.dot(placed), flat.perp_dot(placed))
        });
        let there = -shape.side_direction(twin.index() % 3);
        let here = self.shapes[face.index()].side_direction(side);
        conjugate(here).rotate(there).rotate(rotation.normalize_or_zero())
    }

    fn keeps_bounds(&self, face: FaceId, places: [DVec2; 3]) -> bool {
        self.bounds.hold(&self.shapes[face.index()], places, self.wanted(face))
    }

    /// The rotation that the face should have; none without a field, or where it is let off following it.
    fn wanted(&self, face: FaceId) -> Option<DVec2> {
        self.rotations.filter(|_| !self.let_off[face.index()]).map(|r| r[face.index()])
    }

    /// Whether the face lies within the swollen splotch, or else nothing but this patch could take it.
    fn reaches(&self, core: &Draft, face: FaceId, places: [DVec2; 3], swelling: f64) -> bool {
        let neighbours = || self.topology.face(face).neighbours().map(Face::id);
        let ours = neighbours().filter(|&n| self.disc.contains(n)).count();
        let alone = neighbours().all(|n| self.disc.contains(n) || self.owners[n.index()] != UNCOVERED);
        let reach = if ours > 1 { swelling * WEDGE_REACH } else { swelling };
        alone || core.splotch.contains(centre(places), reach)
    }

    /// Solves, drops the faces that break the bounds with all that hung on them, and so on until none does.
    fn settle(&mut self, core: &Draft) {
        for round in 0.. {
            let count = self.disc.faces.len();
            if count <= core.faces.len() {
                self.load(core);
                return;
            }
            let offenders = match self.solve() {
                Ok(()) => self.offenders(),
                Err(Unsolved) => vec![0],
            };
            match offenders.first() {
                None => return,
                Some(&first) if first >= core.faces.len() && round < GENTLE_ROUNDS => self.drop_and_replay(&offenders),
                Some(_) => self.truncate(core.faces.len() + (count - core.faces.len()) / 2),
            }
        }
    }

    fn solve(&mut self) -> Result<(), Unsolved> {
        let faces = &self.disc.faces;
        let shapes: Vec<FaceShape> = faces.iter().map(|f| self.shapes[f.index()]).collect();
        let rotations: Option<Vec<DVec2>> = self.rotations.map(|_| faces.iter().map(|&f| self.wanted(f).unwrap_or_default()).collect());
        let wish = Wish { rotations: rotations.as_deref(), alignment: self.alignment };
        solve(&Patchwork { corners: &self.disc.corners, shapes: &shapes }, wish, &mut self.disc.places)
    }

    /// Faces of the disc, by their number in it, that break the bounds; ascending.
    fn offenders(&self) -> Vec<usize> {
        let faces = self.disc.faces.iter().enumerate();
        faces.filter(|&(index, &face)| !self.keeps_bounds(face, self.disc.face_places(index))).map(|(index, _)| index).collect()
    }

    /// Keeps the first faces only, which were a disc when they were all there was.
    fn truncate(&mut self, keep: usize) {
        let kept: Vec<_> = (0..keep).map(|i| (self.disc.faces[i], self.disc.face_places(i))).collect();
        for face in &self.disc.faces[keep..] {
            self.bans[face.index()] = self.ban;
        }
        self.disc.clear();
        for (face, places) in kept {
            self.disc.push(self.topology, face, places);
        }
    }

    /// Bans faces and grows the disc anew from the others, in the same order as far as they still join.
    fn drop_and_replay(&mut self, dropped: &[usize]) {
        for &index in dropped {
            self.bans[self.disc.faces[index].index()] = self.ban;
        }
        let old: Vec<_> = self.disc.faces.iter().enumerate().map(|(i, &face)| (face, self.disc.face_places(i))).collect();
        for (rank, (face, _)) in old.iter().enumerate() {
            if self.bans[face.index()] != self.ban {
                self.ranks[face.index()] = rank as u32;
            }
        }
        self.disc.clear();
        self.frontier.clear();
        self.frontier.push(Reverse((0, old[0].0.0)));
        while let Some(Reverse((rank, face))) = self.frontier.pop() {
            let face = FaceId(face);
            let joins = self.disc.faces.is_empty() || self.disc.contact(self.topology, face) != Contact::Barred;
            if self.disc.contains(face) || !joins {
                continue;
            }
            self.disc.push(self.topology, face, old[rank as usize].1);
            for neighbour in self.topology.face(face).neighbours().map(Face::id) {
                let rank = self.ranks[neighbour.index()];
                if rank != u32::MAX {
                    self.frontier.push(Reverse((u64::from(rank), neighbour.0)));
                }
            }
        }
        for (face, _) in old {
            self.ranks[face.index()] = u32::MAX;
        }
    }
}

fn centre(places: [DVec2; 3]) -> DVec2 {
    (places[0] + places[1] + places[2]) / 3.0
}

/// The squared distance from the seed's centre as a whole number, so that places which are equally near but for rounding tie, and their face
/// numbers decide: else a regular mesh would be tiled otherwise when scaled, or far from the origin, where rounding moves it by 1e-8 tiles. The step, 1/16,384
/// square tile, is far above that and far under what shows; the offset keeps round distances off the steps between numbers.
fn nearness(place: DVec2) -> u64 {
    (place.length_squared() * f64::from(1 << 14) + 0.371_943) as u64
}
