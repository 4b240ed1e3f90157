//! Strands sampled into shell layers (L8).

use pelage_strand::{Strand, StrandTile};
use rayon::prelude::*;

use crate::blur::blur;
use crate::directions::direction_mips;
use crate::error::{VolumeError, within};
use crate::extent::check_extents;
use crate::footprint::Footprint;
use crate::heights::Spacing;
use crate::image::{ShellStack, Work};
use crate::mips::{MipRule, shell_mips};
use crate::plane::Plane;
use crate::shell::Shell;
use crate::slab::{Cut, Slab};
use crate::stack::StackSettings;

/// Most layers × resolution² sampled at once (16 bytes each while working: 512 MiB).
pub const MAX_TEXELS: u64 = 1 << 25;

/// Most layers of a stack.
pub(crate) const MOST_LAYERS: u32 = 256;

/// Widest filter that is laid over hair by hair; what is wider is done to the whole layer at the end.
const WIDEST_FOOTPRINT: f64 = 1.0;

/// How strands become layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellSettings {
    /// Layers, the skin and the tips included: 1 to 256. Cost and memory are linear in it.
    pub layers: u32,
    /// Where they stand. Uneven layers are sampled anew at their own heights, each with a filter that reaches half way to its neighbours.
    pub spacing: Spacing,
    /// Texels along a tile side, a power of two from 1 to 2048. Memory goes with its square.
    pub resolution: u32,
    /// Lateral deviation of the filter beside the texel's own box, in texels: 0 to 1024. Larger is softer; below 0.5 aliases a little, 0 is the box alone.
    pub lateral_sigma: f64,
    /// How far above and below a layer hair still covers fully, in layer spacings: 0 to 8. At the default, a half, one layer takes over where the next ends, so
    /// that slanted hair is whole seen along the normal, whatever the spacing; smaller leaves it dotted.
    pub vertical_core: f64,
    /// Deviation of the tall Gaussian beyond the core, in layer spacings: 0.05 to 8. Larger draws slanted hair longer in each layer.
    pub vertical_sigma: f64,
    /// Linear RGB of the skin under the innermost layer's hair, each 0 to 1.
    pub skin_colour: [f32; 3],
    /// What mips keep.
    pub mip_rule: MipRule,
    /// Whether the hair's mean direction is sampled, too (L15), and what heights are scaled by before it is taken: how long the fur stands on the surface over
    /// the box's height laid on it, 1e-3 to 1e3. `None`: not sampled. Costs as much memory again.
    pub directions: Option<f64>,
}

impl Default for ShellSettings {
    fn default() -> Self {
        Self {
            layers: 16,
            spacing: Spacing::Even,
            resolution: 128,
            lateral_sigma: 0.35,
            vertical_core: 0.5,
            vertical_sigma: 0.2,
            skin_colour: [0.11, 0.075, 0.055],
            mip_rule: MipRule::default(),
            directions: None,
        }
    }
}

impl ShellSettings {
    /// Says what is wrong first, if anything is.
    ///
    /// # Errors
    /// A value outside the range that its field states, a resolution that is no power of two, too many texels.
    pub fn validate(&self) -> Result<(), VolumeError> {
        self.stack().validate()?;
        self.directions.map_or(Ok(()), |stretch| within("directions", stretch, 1e-3, 1e3, "(stretch)"))?;
        within("lateral_sigma", self.lateral_sigma, 0.0, 1024.0, "texels")?;
        within("vertical_core", self.vertical_core, 0.0, 8.0, "layer spacings")?;
        within("vertical_sigma", self.vertical_sigma, 0.05, 8.0, "layer spacings")
    }

    /// What they have in common with stacks that no strands are sampled into.
    fn stack(&self) -> StackSettings {
        let &Self { layers, spacing, resolution, skin_colour, mip_rule, .. } = self;
        StackSettings { layers, spacing, resolution, skin_colour, mip_rule }
    }
}

/// Samples a tile of hair into shell layers with mips.
///
/// The alpha of a texel is the fraction of its footprint (box and lateral Gaussian) that the layer's hair is expected to cover, seen along z; hairs count
/// as independent, 1 − Π(1 − a); a hair that lets light through counts as so much less. Layer 0 is opaque: hair over skin. The same bytes come out whatever the number of threads.
///
/// # Errors
/// Settings out of range, a box without height, or a strand that runs on for too long.
pub fn sample_shells(tile: &StrandTile, settings: &ShellSettings) -> Result<ShellStack, VolumeError> {
    sample_innermost(tile, settings, usize::MAX)
}

/// Samples the innermost of those layers alone: the skin, byte for byte as [`sample_shells`] makes it, for who draws no shells.
///
/// # Errors
/// Those of [`sample_shells`].
pub fn sample_skin(tile: &StrandTile, settings: &ShellSettings) -> Result<ShellStack, VolumeError> {
    sample_innermost(tile, settings, 1)
}

/// So many of the layers, from the skin.
fn sample_innermost(tile: &StrandTile, settings: &ShellSettings, count: usize) -> Result<ShellStack, VolumeError> {
    settings.validate()?;
    let height = tile.height();
    if !(height.is_finite() && height > 0.0) {
        return Err(VolumeError::NoHeight { height });
    }
    check_extents(tile, [f64::from(settings.resolution); 2], [0, 1])?;
    let spans: Vec<(f32, f32)> = tile.strands().map(|strand| span(&strand)).collect();
    let heights = settings.spacing.heights(settings.layers);
    let sampled: Vec<Sampled> = (0..heights.len().min(count))
        .into_par_iter()
        .map(|layer| sample_layer(tile, &spans, settings, &slab(tile, settings, &heights, layer)))
        .collect();
    let work = sampled.iter().fold(Work::default(), |sum, layer| sum.plus(layer.work));
    let (planes, directions): (Vec<Plane>, Vec<Option<Plane>>) = sampled.into_iter().map(|layer| (layer.plane, layer.directions)).unzip();
    let directions = settings.directions.map(|_| direction_mips(directions.into_iter().flatten().collect()));
    let shells = (0u32..).zip(heights.iter().take(count)).map(|(image, &height)| Shell::plain(height as f32, image)).collect();
    Ok(ShellStack { height, mips: shell_mips(planes, settings.mip_rule), levels: vec![shells], directions, work })
}

/// Lowest and highest point of a strand.
fn span(strand: &Strand<'_>) -> (f32, f32) {
    strand.points.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), p| (low.min(p[2]), high.max(p[2])))
}

/// One layer as it was sampled.
struct Sampled {
    plane: Plane,
    /// The hair's mean direction times what it covers, and that.
    directions: Option<Plane>,
    work: Work,
}

/// Where a layer stands, and how far it reaches: to either side by the spacing there, at the ends by the only one there is.
fn slab(tile: &StrandTile, settings: &ShellSettings, heights: &[f64], layer: usize) -> Slab {
    let gap = |below: usize| heights.get(below + 1).map(|above| tile.height() * (above - heights[below]));
    let (above, below) = (gap(layer), layer.checked_sub(1).and_then(gap));
    let spacing = above.or(below).unwrap_or(tile.height());
    // Even but for rounding is even.
    let spacing_below = below.filter(|below| (below - spacing).abs() > 1e-9 * spacing).unwrap_or(spacing);
    Slab {
        height: tile.height() * heights[layer],
        sigma: settings.vertical_sigma * spacing,
        sigma_below: settings.vertical_sigma * spacing_below,
        core: settings.vertical_core / settings.vertical_sigma,
        resolution: f64::from(settings.resolution),
        lateral: lateral(settings).min(WIDEST_FOOTPRINT),
        stretch: settings.directions.unwrap_or(1.0),
    }
}

/// The lateral deviation. The box of a texel enters by its variance.
fn lateral(settings: &ShellSettings) -> f64 {
    (settings.lateral_sigma * settings.lateral_sigma + 1.0 / 12.0).sqrt()
}

fn sample_layer(tile: &StrandTile, spans: &[(f32, f32)], settings: &ShellSettings, slab: &Slab) -> Sampled {
    let directed = settings.directions.is_some();
    let mut gathered = Gathered::new(settings.resolution as usize, directed);
    let mut footprint = Footprint::new(slab.lateral as f32).directed(directed);
    let mut cut = Cut::default();
    let mut work = Work::default();
    let (low, high) = slab.reach();
    for (strand, &(bottom, top)) in tile.strands().zip(spans) {
        if top < low || bottom > high {
            continue;
        }
        slab.cut(&strand, &mut cut);
        if cut.pieces.is_empty() {
            continue;
        }
        work.cuts += 1;
        footprint.open(&cut.pieces);
        cut.pieces.iter().for_each(|piece| footprint.add(piece));
        let (colour, opacity) = look(&strand, &cut);
        footprint.close(cut.mass as f32, |x, y, covered, toward| gathered.cover(x, y, covered * opacity, colour, toward));
    }
    work.pairs = footprint.pairs;
    let (mut plane, mut directions) = gathered.finish();
    let wider = (lateral(settings).powi(2) - slab.lateral.powi(2)).max(0.0).sqrt();
    blur(&mut plane, wider);
    if let Some(directions) = &mut directions {
        blur(directions, wider);
    }
    if slab.height == 0.0 {
        lay_on_skin(&mut plane, settings.skin_colour);
    }
    Sampled { plane, directions, work }
}

/// What colour a hair has in a layer, and how opaque it is: bands are averaged over the layer, as they may be narrower than it.
fn look(strand: &Strand<'_>, cut: &Cut) -> ([f32; 3], f32) {
    let [from, to] = if strand.bands.is_some() { cut.within } else { [cut.along; 2] };
    (strand.mean_colour(from, to), strand.opacity_at(cut.along))
}

/// One layer while hairs are added to it.
struct Gathered {
    side: usize,
    /// What is covered: 1 − Π(1 − a), kept as itself, so that hair thinner than the rounding of 1 counts.
    covered: Vec<f32>,
    /// Σ a·colour and Σ a.
    sums: Vec<[f32; 4]>,
    /// Σ a·direction; empty unless asked for.
    toward: Vec<[f32; 3]>,
}

impl Gathered {
    fn new(side: usize, directed: bool) -> Self {
        let toward = if directed { vec![[0.0; 3]; side * side] } else { Vec::new() };
        Self { side, covered: vec![0.0; side * side], sums: vec![[0.0; 4]; side * side], toward }
    }

    /// Covers a fraction of a texel, wrapped on the torus.
    fn cover(&mut self, x: i32, y: i32, covered: f32, colour: [f32; 3], toward: [f32; 3]) {
        // Sides are powers of two.
        let mask = self.side - 1;
        let index = (y as usize & mask) * self.side + (x as usize & mask);
        self.covered[index] += covered * (1.0 - self.covered[index]);
        let sum = &mut self.sums[index];
        for channel in 0..3 {
            sum[channel] += covered * colour[channel];
        }
        sum[3] += covered;
        if let Some(sum) = self.toward.get_mut(index) {
            *sum = [0, 1, 2].map(|axis| sum[axis] + covered * toward[axis]);
        }
    }

    /// Colour is the mean of the hairs' colours weighted by what they cover, and so is direction.
    fn finish(self) -> (Plane, Option<Plane>) {
        let mut plane = Plane::new(self.side, self.side);
        let mut directions = (!self.toward.is_empty()).then(|| Plane::new(self.side, self.side));
        for (index, (texel, &alpha)) in plane.texels.iter_mut().zip(&self.covered).enumerate() {
            let sum = self.sums[index];
            let share = if sum[3] > 0.0 { alpha / sum[3] } else { 0.0 };
            *texel = [sum[0] * share, sum[1] * share, sum[2] * share, alpha];
            if let Some(directions) = &mut directions {
                let [x, y, z] = self.toward[index].map(|d| d * share);
                directions.texels[index] = [x, y, z, alpha];
            }
        }
        (plane, directions)
    }
}

fn lay_on_skin(plane: &mut Plane, skin: [f32; 3]) {
    for texel in &mut plane.texels {
        for channel in 0..3 {
            texel[channel] += skin[channel] * (1.0 - texel[3]);
        }
        texel[3] = 1.0;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use super::*;
    use pelage_strand::StrandSource;
    use std::f64::consts::{PI, TAU};

    /// What the tall Gaussian with its core weighs in all, in layer spacings.
    fn weight() -> f64 {
        let settings = ShellSettings::default();
        2.0 * settings.vertical_core + settings.vertical_sigma * TAU.sqrt()
    }

    /// What layer 5 of 11 covers of a 64 tile, in texel areas, of one hair.
    fn mass(points: Vec<[f64; 3]>, radii: Vec<f64>, lateral_sigma: f64) -> f64 {
        let source = StrandSource { radii, points, root_colour: [1.0; 3], tip_colour: [1.0; 3] };
        let tile = StrandTile::from_strands(1.0, &[source]).unwrap();
        let spans: Vec<(f32, f32)> = tile.strands().map(|strand| span(&strand)).collect();
        let settings = ShellSettings { layers: 11, resolution: 64, lateral_sigma, ..ShellSettings::default() };
        let slab = slab(&tile, &settings, &settings.spacing.heights(11), 5);
        sample_layer(&tile, &spans, &settings, &slab).plane.texels.iter().map(|texel| f64::from(texel[3])).sum()
    }

    #[test]
    fn gaussian_sampling_keeps_the_mass_within_one_percent() {
        // Upright hair covers its section; leaning hair, besides, a strip as long as it runs in the layer's Gaussian: spacing × slope × weight.
        let mut most = 0.0_f64;
        for radius in [1e-7, 1e-5, 0.0005, 0.004, 0.02] {
            for place in [0.3, 0.4951, 0.0, 0.999, -3.2] {
                for lateral in [0.0, 1e-6, 1e-3, 0.1, 0.3, 0.5, 1.0, 2.0, 16.0, 64.0] {
                    let section = PI * (radius * 64.0f64).powi(2);
                    let upright = mass(vec![[place, 0.47, 0.0], [place, 0.47, 1.0]], vec![radius; 2], lateral);
                    assert!((upright / section - 1.0).abs() < 0.01, "radius {radius} at {place}, σ {lateral}: {upright} of {section}");
                    let strip = section + 2.0 * radius * 64.0 * 0.1 * weight() * 0.5 * 64.0;
                    let leaning = mass(vec![[place, 0.47, 0.0], [place + 0.3, 0.87, 1.0]], vec![radius; 2], lateral);
                    assert!((leaning / strip - 1.0).abs() < 0.01, "radius {radius} at {place}, σ {lateral}: {leaning} of {strip}");
                    most = most.max((upright / section - 1.0).abs()).max((leaning / strip - 1.0).abs());
                }
            }
        }
        println!("reached: mass within {:.2} %", 100.0 * most);
    }

    #[test]
    fn tapering_hair_covers_what_its_thicker_part_below_does() {
        // A cone upright: a place at ρ from its axis is covered as far up as the cone is that wide.
        let settings = ShellSettings::default();
        let (core, sigma) = (0.1 * settings.vertical_core, 0.1 * settings.vertical_sigma);
        for (root, tip) in [(0.02, 0.0), (0.03, 0.015), (0.002, 0.0001), (0.01, 0.03)] {
            let covers = |rho: f64| {
                let height = 0.5 - (rho - root) / (tip - root);
                let inside = rho <= root + (tip - root) * 0.5;
                let beyond = if inside { 0.0 } else { (height.abs() - core).max(0.0) / sigma };
                (-0.5 * beyond * beyond).exp()
            };
            let widest = f64::max(root, tip);
            let step = widest / 20_000.0;
            let wanted: f64 =
                (0..20_000).map(|i| (f64::from(i) + 0.5) * step).map(|rho| TAU * rho * step * covers(rho)).sum::<f64>() * 4096.0;
            let got = mass(vec![[0.3, 0.47, 0.0], [0.3, 0.47, 1.0]], vec![root, tip], 0.35);
            assert!((got / wanted - 1.0).abs() < 0.01, "from {root} to {tip}: {got} of {wanted}");
        }
    }

    #[test]
    fn a_tip_below_a_layer_fades_as_the_gaussian() {
        // Layer 5 stands at 0.5.
        let settings = ShellSettings::default();
        let section = PI * (0.02 * 64.0f64).powi(2);
        for below in [0.0, 0.5, 1.0, 2.0] {
            let end = 0.5 - 0.1 * (settings.vertical_core + below * settings.vertical_sigma);
            let covered = mass(vec![[0.3, 0.47, 0.0], [0.3, 0.47, end]], vec![0.02; 2], 0.35);
            assert!((covered - section * (-0.5 * below * below).exp()).abs() < 0.01 * section, "{below} σ below: {covered} of {section}");
        }
    }
}
