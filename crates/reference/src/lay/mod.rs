//! Strands laid on the surface as straight tapered segments.

mod free;
mod shell;
mod track;

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use glam::{DVec2, DVec3};
use pelage_coat::Coat;
use pelage_strand::StrandTile;
use rayon::prelude::*;

use crate::error::{FARTHEST, MOST_SEGMENTS, MOST_TILES, within};
use crate::face::{FaceMap, Skin};
use crate::hair::Hair;
use crate::segment::{Origin, Segment};
use crate::{Laying, Placement, ReferenceError};

/// A curve is cut into so many straight segments at most.
const MOST_CUTS: f64 = 4096.0;

/// All hair of a scene: two arrays of one length.
#[derive(Debug, Default)]
pub(crate) struct Laid {
    pub(crate) segments: Vec<Segment>,
    pub(crate) origins: Vec<Origin>,
    /// Pieces left out since they would end further away than [`FARTHEST`]: free hair on needle-thin faces.
    pub(crate) dropped: usize,
}

/// What laying a face takes.
struct Layer<'a> {
    skin: Skin<'a>,
    hair: &'a Hair,
    tolerance: f64,
    edges: Edges,
}

/// Which hair a face of shell space is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edges {
    /// All that reaches in, for rays, which meet what is inside.
    Bodies,
    /// Where the axis is inside, for curves, each in one face only.
    Axes,
}

/// Lays all hair of a coat, faces side by side; in the order of the faces, whatever the number of threads.
pub(crate) fn lay(coat: &Coat, tile: &StrandTile, laying: &Laying, edges: Edges) -> Result<Laid, ReferenceError> {
    let skin = checked(coat, tile, laying)?;
    let hair = Hair::of(tile, laying.tolerance)?;
    let layer = Layer { skin, hair: &hair, tolerance: laying.tolerance, edges };
    let (count, full) = (AtomicUsize::new(0), AtomicBool::new(false));
    let one = |face: usize| -> Result<Laid, ReferenceError> {
        let mut laid = Laid::default();
        let Some(map) = skin.map(face).filter(FaceMap::is_furred) else { return Ok(laid) };
        if full.load(Ordering::Relaxed) {
            return Err(ReferenceError::TooManySegments { limit: MOST_SEGMENTS });
        }
        let (low, high) = map.bounds();
        let tiles = (high - low + DVec2::ONE).element_product();
        if tiles > MOST_TILES {
            return Err(ReferenceError::TooManyTiles { face, tiles });
        }
        // Nothing more is laid once there is too much, in the middle of a large face too.
        let room = Room { before: count.load(Ordering::Relaxed) };
        match laying.placement {
            Placement::Shell => layer.shell(face, &map, &mut laid, &room),
            Placement::Free => layer.free(face, &map, &mut laid, &room),
        }
        if count.fetch_add(laid.segments.len(), Ordering::Relaxed) + laid.segments.len() > MOST_SEGMENTS {
            full.store(true, Ordering::Relaxed);
            return Err(ReferenceError::TooManySegments { limit: MOST_SEGMENTS });
        }
        Ok(laid)
    };
    let faces: Vec<Laid> = (0..coat.patches.faces.len()).into_par_iter().map(one).collect::<Result<_, _>>()?;
    Ok(joined(faces))
}

/// How much more hair there may be.
struct Room {
    before: usize,
}

impl Room {
    fn is_left(&self, laid: &Laid) -> bool {
        self.before + laid.segments.len() <= MOST_SEGMENTS
    }
}

fn joined(faces: Vec<Laid>) -> Laid {
    let count = faces.iter().map(|laid| laid.segments.len()).sum();
    let mut all = Laid { segments: Vec::with_capacity(count), origins: Vec::with_capacity(count), dropped: 0 };
    for mut laid in faces {
        all.segments.append(&mut laid.segments);
        all.origins.append(&mut laid.origins);
        all.dropped += laid.dropped;
    }
    all
}

/// Refuses what cannot be laid.
fn checked<'a>(coat: &'a Coat, tile: &StrandTile, laying: &Laying) -> Result<Skin<'a>, ReferenceError> {
    coat.check()?;
    within("length_scale", laying.length_scale, 0.0, 1e3, "(ratio)")?;
    within("tolerance", laying.tolerance, 1e-4, 1.0, "radii")?;
    let height = tile.height();
    if !(height.is_finite() && height > 0.0) {
        return Err(ReferenceError::NoHeight { height });
    }
    let surface = &coat.surface;
    let reach = |v: usize| {
        let fur = surface.offsets[v].as_dvec3().length() + surface.bends[v].as_dvec3().length();
        surface.positions[v].as_dvec3().length() + fur * laying.length_scale.max(1.0)
    };
    match (0..surface.positions.len()).find(|&v| reach(v) >= FARTHEST) {
        Some(vertex) => Err(ReferenceError::TooFar { vertex }),
        None => Ok(Skin { coat, length_scale: laying.length_scale }),
    }
}

/// A number for a copy of a strand on a patch.
fn copy_of(patch: u32, strand: u32, tiles: [i64; 2]) -> u32 {
    let low = tiles.map(|tile| tile as u32);
    [strand, low[0], low[1]].into_iter().fold(crate::sampler::hash(patch), |hash, next| crate::sampler::hash(hash ^ next))
}

impl Layer<'_> {
    fn patch_of(&self, face: usize) -> u32 {
        self.skin.coat.patches.patch_ends.partition_point(|&end| end as usize <= face) as u32
    }
}

/// A tile place moved by whole tiles.
fn moved(place: DVec2, tiles: [i64; 2]) -> DVec2 {
    place + DVec2::new(tiles[0] as f64, tiles[1] as f64)
}

/// A linear function's values at both ends: the part of the way on which it is not negative.
fn not_negative(ends: [f64; 2]) -> [f64; 2] {
    match ends.map(|value| value >= 0.0) {
        [true, true] => [0.0, 1.0],
        [false, false] => [1.0, 0.0],
        [true, false] => [0.0, ends[0] / (ends[0] - ends[1])],
        [false, true] => [ends[0] / (ends[0] - ends[1]), 1.0],
    }
}

fn lerp(ends: [f64; 2], part: f64) -> f64 {
    ends[0] + (ends[1] - ends[0]) * part
}

fn first_two(beta: DVec3) -> [f32; 2] {
    [beta.x as f32, beta.y as f32]
}
