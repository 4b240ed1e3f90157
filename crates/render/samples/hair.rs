//! Hair textures drawn strand by strand: discs in each layer, lines in the fin.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use pelage_coat::{FinTexture, MipImage, ShellLayer, ShellTexture};

use super::Dice;

/// Both textures of a kind of hair.
#[derive(Clone)]
pub struct Hair {
    pub shells: Arc<ShellTexture>,
    pub fin: Arc<FinTexture>,
}

/// A straight strand that leans a little and ends in a point.
struct Strand {
    root: Vec2,
    lean: Vec2,
    /// Of the full height.
    length: f32,
    /// At the root, in tiles.
    radius: f32,
    colour: Vec3,
}

/// What a kind of hair is made of.
#[derive(Clone, Copy)]
pub struct Recipe {
    pub layers: u32,
    pub resolution: u32,
    pub guard_hairs: u32,
    pub under_hairs: u32,
    /// Radius of a guard hair at its root, in tiles.
    pub radius: f32,
    pub seed: u64,
    /// Whether coarser and coarser shells of the same hair follow (L16).
    pub levels: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        Self { layers: 16, resolution: 128, guard_hairs: 420, under_hairs: 900, radius: 0.0115, seed: 3, levels: false }
    }
}

const SKIN: Vec3 = Vec3::new(0.16, 0.11, 0.08);

impl Recipe {
    pub fn grow(self) -> Hair {
        let mut dice = Dice::new(self.seed);
        let strands: Vec<Strand> = (0..self.guard_hairs + self.under_hairs).map(|i| self.strand(&mut dice, i < self.guard_hairs)).collect();
        Hair { shells: Arc::new(self.shells(&strands)), fin: Arc::new(self.fin(&mut dice)) }
    }

    fn strand(&self, dice: &mut Dice, guard: bool) -> Strand {
        let shade = dice.between(0.55, 1.0) * if dice.roll() < 0.06 { 1.35 } else { 1.0 };
        let warm = Vec3::new(0.78, 0.62, 0.45).lerp(Vec3::new(0.60, 0.45, 0.32), dice.roll());
        let turn = dice.roll() * std::f32::consts::TAU;
        let amount = dice.between(0.0, if guard { 0.06 } else { 0.03 });
        Strand {
            root: dice.place(),
            lean: amount * Vec2::from_angle(turn),
            length: if guard { dice.between(0.72, 1.0) } else { dice.between(0.3, 0.65) },
            radius: self.radius * if guard { dice.between(0.8, 1.2) } else { 0.8 },
            colour: (warm * shade * if guard { 1.0 } else { 0.8 }).min(Vec3::ONE),
        }
    }

    fn shells(&self, strands: &[Strand]) -> ShellTexture {
        let side = self.resolution as usize;
        let mut stack = Vec::new();
        for layer in 0..self.layers {
            let height = layer as f32 / (self.layers - 1).max(1) as f32;
            // Premultiplied colour and alpha.
            let mut image = vec![[0.0_f32; 4]; side * side];
            if layer == 0 {
                image.fill(SKIN.extend(1.0).to_array());
            }
            for strand in strands.iter().filter(|s| s.length >= height) {
                let radius = strand.radius * taper(height / strand.length) * side as f32;
                let centre = (strand.root + strand.lean * height) * side as f32;
                disc(&mut image, side, centre, radius, tint(strand.colour, height));
            }
            stack.push(image);
        }
        let mut levels = ShellTexture::stack(self.layers, Vec::new()).levels;
        while self.levels && levels[levels.len() - 1].len() > 1 {
            let pairs = levels[levels.len() - 1].chunks(2).map(<[ShellLayer]>::to_vec).collect::<Vec<_>>();
            levels.push(pairs.iter().map(|pair| composite(&mut stack, pair)).collect());
        }
        ShellTexture { levels, ..ShellTexture::stack(stack.len() as u32, mips(stack, side, side)) }
    }

    fn fin(&self, dice: &mut Dice) -> FinTexture {
        let (width, height, tiles) = (512_usize, 64_usize, 4.0_f32);
        let texel = tiles / width as f32;
        let mut image = vec![[0.0_f32; 4]; width * height];
        // A slab a twelfth of a tile thick.
        let count = ((self.guard_hairs + self.under_hairs) as f32 * tiles / 12.0) as u32;
        let share = self.guard_hairs as f32 / (self.guard_hairs + self.under_hairs).max(1) as f32;
        for _ in 0..count {
            let guard = dice.roll() < share;
            let strand = self.strand(dice, guard);
            let root = dice.roll() * tiles;
            for row in 0..height {
                let up = 1.0 - (row as f32 + 0.5) / height as f32;
                if up > strand.length {
                    continue;
                }
                let (x, radius) = ((root + strand.lean.x * up) / texel, strand.radius * taper(up / strand.length) / texel);
                let reach = radius.ceil() as i64 + 1;
                for column in x as i64 - reach..=x as i64 + reach {
                    let alpha = (radius + 0.5 - (column as f32 + 0.5 - x).abs()).clamp(0.0, 1.0).min(2.0 * radius);
                    over(&mut image[row * width + column.rem_euclid(width as i64) as usize], tint(strand.colour, up), alpha);
                }
            }
        }
        FinTexture { tiles_across: tiles, mixtures: 1, mips: mips(vec![image], width, height) }
    }
}

/// Two shells as one that stands where the lower does; its image is added to the stack. An odd one is left as it is.
fn composite(stack: &mut Vec<Vec<[f32; 4]>>, pair: &[ShellLayer]) -> ShellLayer {
    let &[lower, upper] = pair else { return pair[0] };
    let (mut seen, mut height) = (0.0, 0.0);
    let below = &stack[lower.image as usize];
    let both = below.iter().zip(&stack[upper.image as usize]).map(|(below, above)| {
        let through = 1.0 - above[3];
        // As most of a coat is seen, at N·V = 2/3.
        let aslant = |alpha: f32| 1.0 - (1.0 - alpha).max(0.0).powf(1.5);
        let (near, far) = (aslant(above[3]), (1.0 - aslant(above[3])) * aslant(below[3]));
        seen += near + far;
        height += near * upper.light_height + far * lower.light_height;
        std::array::from_fn(|c| above[c] + through * below[c])
    });
    let image = both.collect();
    stack.push(image);
    let light_height = if seen > 0.0 { (height / seen).clamp(0.0, 1.0) } else { lower.height };
    ShellLayer { light_height, ..ShellLayer::plain(lower.height, stack.len() as u32 - 1) }
}

/// Full at the root, a point at the tip.
fn taper(along: f32) -> f32 {
    (1.0 - along * along).max(0.0).sqrt() * 0.75 + 0.25 * (1.0 - along)
}

/// Roots are darker than tips.
fn tint(colour: Vec3, height: f32) -> Vec3 {
    colour * (0.55 + 0.45 * height)
}

fn disc(image: &mut [[f32; 4]], side: usize, centre: Vec2, radius: f32, colour: Vec3) {
    let reach = radius.ceil() as i64 + 1;
    let (cx, cy) = (centre.x.floor() as i64, centre.y.floor() as i64);
    for y in cy - reach..=cy + reach {
        for x in cx - reach..=cx + reach {
            let distance = (Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - centre).length();
            // A disc smaller than a texel covers its area of it.
            let alpha = (radius + 0.5 - distance).clamp(0.0, 1.0).min(4.0 * radius * radius);
            let at = y.rem_euclid(side as i64) as usize * side + x.rem_euclid(side as i64) as usize;
            over(&mut image[at], colour, alpha);
        }
    }
}

fn over(below: &mut [f32; 4], colour: Vec3, alpha: f32) {
    let source = (colour * alpha).extend(alpha).to_array();
    for (b, s) in below.iter_mut().zip(source) {
        *b = s + *b * (1.0 - alpha);
    }
}

/// Halved by means of four, down to one texel; layer after layer in each level.
pub fn mips(mut stack: Vec<Vec<[f32; 4]>>, mut width: usize, mut height: usize) -> Vec<MipImage> {
    let mut levels = Vec::new();
    loop {
        let texels = stack.iter().flatten().flat_map(|texel| encode(*texel)).collect();
        levels.push(MipImage { width: width as u32, height: height as u32, texels });
        if width == 1 && height == 1 {
            return levels;
        }
        let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
        for image in &mut stack {
            *image = (0..half_width * half_height)
                .map(|i| {
                    let (x, y) = (i % half_width, i / half_width);
                    let at = |dx: usize, dy: usize| image[(2 * y + dy).min(height - 1) * width + (2 * x + dx).min(width - 1)];
                    let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
                    std::array::from_fn(|c| four.iter().map(|texel| texel[c]).sum::<f32>() / 4.0)
                })
                .collect();
        }
        (width, height) = (half_width, half_height);
    }
}

/// Premultiplied linear colour to sRGB bytes, alpha linear.
pub fn encode(texel: [f32; 4]) -> [u8; 4] {
    let srgb = |x: f32| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    let byte = |x: f32| (255.0 * x.clamp(0.0, 1.0)).round() as u8;
    [byte(srgb(texel[0])), byte(srgb(texel[1])), byte(srgb(texel[2])), byte(texel[3])]
}

/// The way back.
pub fn decode(texel: [u8; 4]) -> [f32; 4] {
    let linear = |x: f32| if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
    let [r, g, b, a] = texel.map(|byte| f32::from(byte) / 255.0);
    [linear(r), linear(g), linear(b), a]
}
