//! Rays from the eye, and the picture that they make.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use glam::DVec3;
use pelage_lighting::HairPoint;
use rayon::prelude::*;

use crate::clip;
use crate::cone::{self, Span};
use crate::eye::Eye;
use crate::ray::Ray;
use crate::sampler::{chance, pixel_seed, sample};
use crate::shade::{Lamps, Lit};
use crate::tree::{Hit, Met, Stack};
use crate::{Image, Progress, ReferenceError, Scene, Settings, View};

/// Pixels along a side of the squares that are worked on at once.
const BLOCK: u32 = 16;

/// Rays towards a light begin this far off the skin, in diameters.
const OFF_SKIN: f64 = 1e-6;

/// One picture on its way.
struct Picture<'a> {
    scene: &'a Scene<'a>,
    settings: &'a Settings,
    eye: Eye,
    lamps: Lamps,
}

/// One square of it.
struct Block {
    pixels: Vec<[f32; 4]>,
    shadow_rays: u64,
}

/// What a thread keeps from ray to ray.
#[derive(Default)]
struct Scratch {
    stack: Stack,
    shadow_rays: u64,
}

impl Scene<'_> {
    /// The picture: the mean over each pixel's square of what rays from the eye meet first, hair or skin, in linear light.
    ///
    /// The same bytes for any number of threads; another `seed` has other noise. Runs on the current `rayon` pool.
    ///
    /// # Errors
    /// Settings out of range, a camera that sees nothing, a light that is none, [`ReferenceError::Cancelled`] where `progress` says so.
    pub fn render(&self, view: &View, settings: &Settings, progress: Progress<'_>) -> Result<Image, ReferenceError> {
        settings.validate()?;
        let eye = Eye::new(&view.camera, settings.size)?;
        let lamps = Lamps::new(&view.lights, &view.shading, settings.shadows)?;
        let picture = Picture { scene: self, settings, eye, lamps };
        let blocks = picture.blocks(progress)?;
        Ok(picture.assembled(&blocks))
    }
}

impl Picture<'_> {
    fn columns(&self) -> usize {
        self.settings.size.0.div_ceil(BLOCK) as usize
    }

    fn blocks(&self, progress: Progress<'_>) -> Result<Vec<Block>, ReferenceError> {
        let count = self.columns() * self.settings.size.1.div_ceil(BLOCK) as usize;
        let (done, stopped) = (AtomicUsize::new(0), AtomicBool::new(progress(0.0).is_break()));
        let one = |scratch: &mut Scratch, number: usize| {
            if stopped.load(Ordering::Relaxed) {
                return Err(ReferenceError::Cancelled);
            }
            let block = self.block(number, scratch);
            let fraction = (done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / count as f64;
            if progress(fraction).is_break() {
                stopped.store(true, Ordering::Relaxed);
            }
            Ok(block)
        };
        let blocks: Vec<Block> = (0..count).into_par_iter().map_init(Scratch::default, one).collect::<Result<_, _>>()?;
        // The last block may have been told to stop, and no block there to hear it.
        if stopped.into_inner() { Err(ReferenceError::Cancelled) } else { Ok(blocks) }
    }

    fn corner(&self, number: usize) -> [u32; 2] {
        [number % self.columns(), number / self.columns()].map(|place| place as u32 * BLOCK)
    }

    /// The picture's pixels inside a block, row by row.
    fn pixels_of(&self, number: usize) -> impl Iterator<Item = [u32; 2]> {
        let [left, top] = self.corner(number);
        let (right, bottom) = ((left + BLOCK).min(self.settings.size.0), (top + BLOCK).min(self.settings.size.1));
        (top..bottom).flat_map(move |y| (left..right).map(move |x| [x, y]))
    }

    fn block(&self, number: usize, scratch: &mut Scratch) -> Block {
        scratch.shadow_rays = 0;
        let pixels = self.pixels_of(number).map(|pixel| self.pixel(pixel, scratch)).collect();
        Block { pixels, shadow_rays: scratch.shadow_rays }
    }

    fn assembled(&self, blocks: &[Block]) -> Image {
        let (width, height) = self.settings.size;
        let mut pixels = vec![[0.0; 4]; width as usize * height as usize];
        for (number, block) in blocks.iter().enumerate() {
            for ([x, y], &pixel) in self.pixels_of(number).zip(&block.pixels) {
                pixels[y as usize * width as usize + x as usize] = pixel;
            }
        }
        let camera_rays = pixels.len() as u64 * u64::from(self.settings.samples);
        Image { width, height, pixels, camera_rays, shadow_rays: blocks.iter().map(|block| block.shadow_rays).sum() }
    }

    /// The mean over a pixel: premultiplied colour and coverage.
    fn pixel(&self, [x, y]: [u32; 2], scratch: &mut Scratch) -> [f32; 4] {
        let seed = pixel_seed(self.settings.seed, x, y);
        let (mut light, mut met) = (DVec3::ZERO, 0u32);
        for index in 0..self.settings.samples {
            let [across, down] = sample(seed, index);
            let ray = self.eye.ray(f64::from(x) + across, f64::from(y) + down);
            let shown = |segment, span| self.shown(&ray, segment, span, (seed, index));
            if let Some(hit) = self.scene.tree.first(&ray, &mut scratch.stack, shown) {
                light += self.light(&ray, &hit, (seed, index), scratch);
                met += 1;
            }
        }
        let samples = f64::from(self.settings.samples);
        let mean = light / samples;
        [mean.x as f32, mean.y as f32, mean.z as f32, (f64::from(met) / samples) as f32]
    }

    /// What of a ray's way through a segment is met: what is in the face's part of shell space; where coats become each other, what stands there; and of hair that is there in part or lets
    /// light through, by chance all or nothing, the same for all of a strand at one sample.
    fn shown(&self, ray: &Ray, number: usize, span: Span, (seed, index): (u32, u32)) -> Option<Span> {
        let scene = self.scene;
        let origin = &scene.origins[number];
        let segment = &scene.tree.segments[number];
        let span = if origin.is_clipped { clip::inside(&scene.skin, ray, segment, origin, span)? } else { span };
        if !scene.is_thin && scene.tile.coats() == 1 {
            return Some(span);
        }
        let part = cone::part_at(ray.at(span.enter), segment.axis(), segment.radii.map(f64::from));
        let (face, beta) = (origin.face as usize, origin.beta_at(part));
        if !scene.stands(origin.strand, scene.skin.mix(face, beta)) {
            return None;
        }
        let opaque = scene.skin.growth(face, beta) * scene.opacity(origin.strand, origin.along_at(part));
        (opaque >= 1.0 || chance(seed, index, origin.copy) < opaque).then_some(span)
    }

    fn light(&self, ray: &Ray, hit: &Hit, sample: (u32, u32), scratch: &mut Scratch) -> DVec3 {
        match hit.met {
            Met::Hair { segment, part } => self.hair_light(ray, hit.distance, (segment, part), sample, scratch),
            Met::Skin { face, beta } => self.skin_light(ray, hit.distance, (face, beta), sample, scratch),
        }
    }

    fn hair_light(&self, ray: &Ray, distance: f64, (number, part): (usize, f64), sample: (u32, u32), scratch: &mut Scratch) -> DVec3 {
        let (origin, segment) = (&self.scene.origins[number], &self.scene.tree.segments[number]);
        let (face, beta) = (origin.face as usize, origin.beta_at(part));
        let skin = self.scene.skin.point(face, beta);
        let [from, to] = segment.axis();
        let axis = from.lerp(to, part);
        // The light that gets to the place that is seen, as the shell through it has it, not to the middle of the hair.
        let height = self.scene.skin.height_beside(face, beta, origin.height_at(part), ray.at(distance) - axis);
        let hair = HairPoint { direction: segment.direction(), normal: skin.normal, height };
        let light =
            self.lamps.light(&Lit::Hair(hair), -ray.direction, |toward| self.is_dark(axis, toward, Some(origin.copy), sample, scratch));
        light * skin.colour * self.scene.hair_colour(origin.strand, origin.along_at(part))
    }

    fn skin_light(&self, ray: &Ray, distance: f64, (face, beta): (usize, DVec3), sample: (u32, u32), scratch: &mut Scratch) -> DVec3 {
        let skin = self.scene.skin.point(face, beta);
        let place = ray.at(distance);
        let colours = &self.scene.laying.skin;
        let mut lit = |lit: Lit| self.lamps.light(&lit, -ray.direction, |toward| self.is_dark(place, toward, None, sample, scratch));
        let bare = if skin.growth < 1.0 { lit(Lit::Bare(skin.normal)) * colours.bare } else { DVec3::ZERO };
        let roots = HairPoint { direction: skin.direction, normal: skin.normal, height: 0.0 };
        let under = if skin.growth > 0.0 { lit(Lit::Hair(roots)) * colours.under_fur } else { DVec3::ZERO };
        skin.colour * bare.lerp(under, skin.growth)
    }

    /// Whether something stands in the way to a light. A hair's own copy does not: it has no near and far side.
    fn is_dark(&self, place: DVec3, toward: DVec3, own: Option<u32>, sample: (u32, u32), scratch: &mut Scratch) -> bool {
        scratch.shadow_rays += 1;
        let ray = Ray { origin: place, direction: toward, from: OFF_SKIN, to: f64::INFINITY };
        self.scene.tree.is_blocked(&ray, &mut scratch.stack, |segment, span| {
            let is_own = own == Some(self.scene.origins[segment].copy);
            if is_own { None } else { self.shown(&ray, segment, span, sample) }
        })
    }
}

impl Scene<'_> {
    /// Whether a strand stands where the coats are mixed so, from the first at 0 to the last at 1.
    pub(crate) fn stands(&self, strand: u32, mix: f64) -> bool {
        let place = mix * f64::from(self.tile.coats() - 1);
        self.tile.strand(strand as usize).is_none_or(|strand| strand.stands_at(place))
    }

    /// The hair's own colour a part of the way along its strand.
    fn hair_colour(&self, strand: u32, along: f64) -> DVec3 {
        let Some(strand) = self.tile.strand(strand as usize) else { return DVec3::ONE };
        glam::Vec3::from(strand.colour_at(along as f32)).as_dvec3()
    }

    /// How much of the light that meets a hair a part of the way along its strand does not get through.
    fn opacity(&self, strand: u32, along: f64) -> f64 {
        self.tile.strand(strand as usize).map_or(1.0, |strand| f64::from(strand.opacity_at(along as f32)))
    }
}
