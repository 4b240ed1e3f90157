//! A slab of strands seen from its side (L9).

use pelage_strand::{Strand, StrandTile};
use rayon::prelude::*;

use crate::error::{VolumeError, power_of_two, within};
use crate::extent::check_extents;
use crate::footprint::{Footprint, Kind, Piece};
use crate::image::{FinTexture, Work};
use crate::mips::image_mips;
use crate::plane::Plane;

/// The tile's axis that runs along the fin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FinAcross {
    /// Along s, looking along t: hair that leans along t is seen from its front and leans neither left nor right, so the fin fits edges of any direction.
    #[default]
    S,
    /// Along t, looking along −s: leaning hair is seen in profile, leaning to the right.
    T,
}

/// How strands become a fin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinSettings {
    /// Texels across, a power of two from 1 to 8192.
    pub width: u32,
    /// Texels from the skin to the tips, a power of two from 1 to 2048.
    pub height: u32,
    /// Depth of the slab in tile sides: 0.001 to 1. Sets the fin's density; hairs are those with their roots inside.
    pub slab_width: f64,
    /// Tiles that the width shows: 1 to 64. Each shows another slab of the same hair, so they do not repeat.
    pub tiles_across: u32,
    /// The tile's axis that runs along the fin.
    pub across: FinAcross,
    /// Deviation of the filter beside the texel's own box, in texels: 0 to 8.
    pub sigma: f64,
}

impl Default for FinSettings {
    fn default() -> Self {
        Self { width: 512, height: 64, slab_width: 0.12, tiles_across: 3, across: FinAcross::S, sigma: 0.3 }
    }
}

impl FinSettings {
    /// Says what is wrong first, if anything is.
    ///
    /// # Errors
    /// A value outside the range that its field states, or a side that is no power of two.
    pub fn validate(&self) -> Result<(), VolumeError> {
        power_of_two("width", self.width, 8192)?;
        power_of_two("height", self.height, 2048)?;
        within("slab_width", self.slab_width, 1e-3, 1.0, "tile sides")?;
        within("tiles_across", f64::from(self.tiles_across), 1.0, 64.0, "tiles")?;
        within("sigma", self.sigma, 0.0, 8.0, "texels")
    }
}

/// Composites a slab of hair front to back into a fin with mips: the skin at the bottom row, the tips at the top.
///
/// # Errors
/// Settings out of range, a box without height, or a strand that runs on for too long.
pub fn sample_fin(tile: &StrandTile, settings: &FinSettings) -> Result<FinTexture, VolumeError> {
    settings.validate()?;
    let height = tile.height();
    if !(height.is_finite() && height > 0.0) {
        return Err(VolumeError::NoHeight { height });
    }
    let view = SideView::new(tile, settings);
    check_extents(tile, view.scale, [view.axes().0, 2])?;
    let hairs = view.hairs(tile);
    // Rows of hair are independent of each other only where they do not overlap, so one thread composites; cutting hair into pieces is shared out.
    let cut: Vec<(Vec<Piece>, f64)> = hairs.par_iter().map(|hair| view.pieces(hair)).collect();
    let mut footprint = Footprint::new(view.sigma as f32);
    let mut canvas = Canvas {
        width: settings.width as usize,
        height: settings.height as usize,
        open: Vec::new(),
        plane: Plane::new(settings.width as usize, settings.height as usize),
    };
    canvas.open = vec![1.0; canvas.width * canvas.height];
    let mut work = Work::default();
    for (hair, (pieces, mass)) in hairs.iter().zip(&cut) {
        if pieces.is_empty() {
            continue;
        }
        work.cuts += 1;
        footprint.open(pieces);
        pieces.iter().for_each(|piece| footprint.add(piece));
        let shade = view.shade(hair);
        footprint.close(*mass as f32, |x, y, covered, _| canvas.cover(x, y, covered, &shade));
    }
    work.pairs = footprint.pairs;
    Ok(FinTexture { tiles_across: settings.tiles_across, height, mips: image_mips(canvas.plane), work })
}

/// A hair of the slab.
struct Hair<'a> {
    strand: Strand<'a>,
    /// Which tile of the width shows it.
    tile: u32,
    /// From the slab's front to the root, tile sides.
    depth: f64,
}

/// A hair's colour and opacity by row of the picture.
struct Shade<'a> {
    strand: Strand<'a>,
    /// Rows from the bottom for the way from root to tip.
    rows: f32,
}

/// How the box of hair is looked at.
struct SideView<'a> {
    settings: &'a FinSettings,
    /// Texels for each tile side, across and up.
    scale: [f64; 2],
    sigma: f64,
}

impl<'a> SideView<'a> {
    fn new(tile: &StrandTile, settings: &'a FinSettings) -> Self {
        let scale = [f64::from(settings.width) / f64::from(settings.tiles_across), f64::from(settings.height) / tile.height()];
        Self { settings, scale, sigma: (settings.sigma * settings.sigma + 1.0 / 12.0).sqrt() }
    }

    /// Which coordinate runs across, which into the picture.
    fn axes(&self) -> (usize, usize) {
        match self.settings.across {
            FinAcross::S => (0, 1),
            FinAcross::T => (1, 0),
        }
    }

    /// The hairs of all slabs, front to back.
    fn hairs<'t>(&self, tile: &'t StrandTile) -> Vec<Hair<'t>> {
        let (_, into) = self.axes();
        let tiles = self.settings.tiles_across;
        let mut hairs = Vec::new();
        for shown in 0..tiles {
            let front = f64::from(shown) / f64::from(tiles);
            for strand in tile.strands() {
                let depth = f64::from(strand.points[0][into]) - front;
                let depth = depth - depth.floor();
                if depth < self.settings.slab_width {
                    hairs.push(Hair { strand, tile: shown, depth });
                }
            }
        }
        // Stable: hairs as deep as each other stay in order.
        hairs.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        hairs
    }

    /// Height stands for the way along the hair.
    fn shade<'t>(&self, hair: &Hair<'t>) -> Shade<'t> {
        let top = hair.strand.points.iter().fold(0.0f32, |top, p| top.max(p[2]));
        Shade { strand: hair.strand, rows: (f64::from(top) * self.scale[1]).max(1e-6) as f32 }
    }

    /// The strips of a hair and their area, in texels, rows counted from the top.
    fn pieces(&self, hair: &Hair<'_>) -> (Vec<Piece>, f64) {
        let (across, _) = self.axes();
        let rows = f64::from(self.settings.height);
        let place = |p: &[f32; 3]| [(f64::from(p[across]) + f64::from(hair.tile)) * self.scale[0], rows - f64::from(p[2]) * self.scale[1]];
        let mut mass = 0.0;
        let mut pieces = Vec::with_capacity(hair.strand.points.len() - 1);
        for (pair, radii) in hair.strand.points.windows(2).zip(hair.strand.radii.windows(2)) {
            let (a, b) = (place(&pair[0]), place(&pair[1]));
            let step = [b[0] - a[0], b[1] - a[1]];
            let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
            if length < 1e-6 {
                continue;
            }
            // An affine map scales areas by its determinant, so the strip's width follows from its length before and after.
            let seen = ((step[0] / self.scale[0]).powi(2) + (step[1] / self.scale[1]).powi(2)).sqrt();
            let radius = 0.5 * f64::from(radii[0] + radii[1]) * self.scale[0] * self.scale[1] * seen / length;
            mass += 2.0 * radius * length;
            pieces.push(Piece {
                from: a.map(|c| c as f32),
                along: step.map(|c| (c / length) as f32),
                length: length as f32,
                radius: radius as f32,
                taper: 0.0,
                kind: Kind::Strip { height: 0.0, rise: 0.0, beside: 0.0 },
                toward: [0.0; 3],
            });
        }
        (pieces, mass)
    }
}

/// The picture while hairs are put behind it.
struct Canvas {
    width: usize,
    height: usize,
    /// What nearer hairs left open.
    open: Vec<f32>,
    plane: Plane,
}

impl Canvas {
    fn cover(&mut self, x: i32, y: i32, covered: f32, shade: &Shade<'_>) {
        if y < 0 || y as usize >= self.height {
            return;
        }
        let index = y as usize * self.width + (x as usize & (self.width - 1));
        let up = ((self.height as f32 - y as f32 - 0.5) / shade.rows).min(1.0);
        let seen = covered * shade.strand.opacity_at(up) * self.open[index];
        self.open[index] -= seen;
        let texel = &mut self.plane.texels[index];
        for (sum, colour) in texel.iter_mut().zip(shade.strand.colour_at(up)) {
            *sum += seen * colour;
        }
        texel[3] += seen;
    }
}
