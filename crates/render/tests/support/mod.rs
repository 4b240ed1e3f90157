//! What the picture tests share: one device, small pictures, simple measures.
#![allow(dead_code, unreachable_pub, reason = "shared by several tests, each of which uses a part")]
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test may panic")]

pub mod stage;

#[path = "../../samples/mod.rs"]
pub mod samples;

use std::sync::{Arc, LazyLock};

use glam::{DVec3, Vec3};
use pelage_coat::{Camera, Coat, FinTexture, MipImage, ShellTexture};
use pelage_render::{Headless, Offscreen, Options, Picture, RenderError, View};

use samples::hair::{Hair, Recipe, encode};
use samples::{Style, background, coat, light, shapes};

pub const SIZE: (u32, u32) = (96, 72);

/// One device for all tests of a program. Without an adapter they fail with the line to install.
pub fn headless() -> &'static Headless {
    static HEADLESS: LazyLock<Result<Headless, RenderError>> = LazyLock::new(Headless::new);
    HEADLESS.as_ref().unwrap_or_else(|error| panic!("{error}"))
}

/// Hair coarse enough for small pictures.
pub fn hair(layers: u32) -> Hair {
    Recipe { layers, resolution: 32, guard_hairs: 60, under_hairs: 100, radius: 0.03, ..Recipe::default() }.grow()
}

/// A furry ball of 768 faces.
pub fn ball() -> Coat {
    coat(&shapes::sphere(8, 4.0), Style { length: 0.05, ..Style::default() }, &hair(8))
}

pub fn camera() -> Camera {
    Camera::framing(Vec3::ZERO, 0.36, 0.5, 0.2, 0.6, SIZE.0 as f32 / SIZE.1 as f32, 1.0)
}

pub fn view(options: Options) -> View {
    View { options, ..View::new(camera(), light(Vec3::new(0.5, 0.8, 0.6))) }
}

/// A picture, with no validation error behind it.
pub fn picture(coat: &Coat, view: &View) -> Picture {
    sampled(coat, view, 4)
}

/// One target for all tests of a program, of 1 or 4 samples a pixel: what its pipelines take to compile is spent once.
pub fn offscreen(samples: u32) -> &'static Offscreen {
    static OFFSCREENS: LazyLock<[Offscreen; 2]> =
        LazyLock::new(|| [1, 4].map(|samples| Offscreen::new(headless(), SIZE, samples).unwrap_or_else(|error| panic!("{error}"))));
    &OFFSCREENS[usize::from(samples == 4)]
}

pub fn sampled(coat: &Coat, view: &View, samples: u32) -> Picture {
    let offscreen = offscreen(samples);
    let uploaded = offscreen.upload(coat).unwrap_or_else(|error| panic!("{error}"));
    let picture =
        offscreen.render(&uploaded, view, &background()).unwrap_or_else(|error| panic!("{error}: {:?}", headless().take_errors()));
    assert_eq!(headless().take_errors(), Vec::<String>::new());
    assert_eq!(picture.rgba.len(), 4 * picture.coverage.len());
    picture
}

/// The mean of the covered pixels' brightness, 0 to 255, over pixels that `wanted` picks by column and row.
pub fn brightness(picture: &Picture, wanted: impl Fn(u32, u32) -> bool) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (i, pixel) in picture.rgba.chunks_exact(4).enumerate() {
        let (x, y) = (i as u32 % picture.width, i as u32 / picture.width);
        if picture.coverage[i] == 255 && wanted(x, y) {
            sum += pixel[..3].iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
            count += 1.0;
        }
    }
    assert!(count > 20.0, "there is something to measure");
    sum / count
}

pub fn mean_coverage(picture: &Picture) -> f64 {
    picture.coverage.iter().map(|&c| f64::from(c)).sum::<f64>() / picture.coverage.len() as f64 / 255.0
}

/// The mean and the largest difference of two pictures' channels, of 255.
pub fn difference(a: &Picture, b: &Picture) -> (f64, u8) {
    let each = a.rgba.iter().zip(&b.rgba).map(|(&a, &b)| a.abs_diff(b));
    (each.clone().map(f64::from).sum::<f64>() / a.rgba.len() as f64, each.max().unwrap_or(0))
}

/// Every layer and the fin one flat opaque colour.
pub fn flat_hair(layers: u32, colour: Vec3) -> Hair {
    let texel = encode([colour.x, colour.y, colour.z, 1.0]);
    let mip = |layers: u32| MipImage { width: 1, height: 1, texels: texel.repeat(layers as usize) };
    Hair {
        shells: Arc::new(ShellTexture::stack(layers, vec![mip(layers)])),
        fin: Arc::new(FinTexture { tiles_across: 1.0, mixtures: 1, mips: vec![mip(1)] }),
    }
}

/// A linear colour as the picture's bytes.
pub fn bytes(colour: DVec3) -> [u8; 3] {
    let c = colour.as_vec3();
    let [r, g, b, _] = encode([c.x, c.y, c.z, 1.0]);
    [r, g, b]
}

/// The middle pixel.
pub fn middle(picture: &Picture) -> [u8; 3] {
    let at = 4 * ((picture.height / 2) * picture.width + picture.width / 2) as usize;
    picture.rgba[at..at + 3].try_into().unwrap()
}

/// What [`encode`] makes, back again.
pub fn decode(texel: [u8; 4]) -> [f32; 4] {
    let linear = |byte: u8| {
        let x = f32::from(byte) / 255.0;
        if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    };
    [linear(texel[0]), linear(texel[1]), linear(texel[2]), f32::from(texel[3]) / 255.0]
}

/// A ball with a direction map, levels of detail, and hair that bends and is cut, or without these.
pub fn furry(bent: bool, cut: bool, map: bool, levels: bool) -> Coat {
    let hair = Recipe { layers: 6, resolution: 16, guard_hairs: 30, under_hairs: 30, radius: 0.05, levels, ..Recipe::default() }.grow();
    let mut furry = coat(&shapes::sphere(4, 4.0), Style { length: 0.06, ..Style::default() }, &hair);
    for i in 0..furry.surface.positions.len() {
        let position = furry.surface.positions[i];
        if bent {
            furry.surface.bends[i] = 0.02 * position;
        }
        if cut {
            furry.surface.ends[i] = (0.5 + 2.0 * position.x).clamp(0.0, 1.0);
        }
    }
    if map {
        let mut shells = (*furry.shells).clone();
        let flat = |mip: &MipImage| MipImage { texels: [140, 120, 220, 0].repeat(mip.texels.len() / 4), ..mip.clone() };
        shells.directions = Some(shells.mips.iter().map(flat).collect());
        furry.shells = Arc::new(shells);
    }
    furry
}

/// A coat and the same once more somewhere else, in patches of its own behind the first's.
pub fn twice(coat: &Coat, place: impl Fn(Vec3) -> Vec3) -> Coat {
    let mut pair = coat.clone();
    let surface = &mut pair.surface;
    surface.positions.extend(coat.surface.positions.iter().map(|&p| place(p)));
    for array in [&mut surface.normals, &mut surface.offsets, &mut surface.bends, &mut surface.directions, &mut surface.colours] {
        array.extend_from_within(..);
    }
    surface.ends.extend_from_within(..);
    surface.mixes.extend_from_within(..);
    let (vertices, corners, faces) =
        (coat.surface.positions.len() as u32, coat.patches.vertices.len() as u32, coat.patches.faces.len() as u32);
    let patches = &mut pair.patches;
    patches.vertices.extend(coat.patches.vertices.iter().map(|vertex| vertex + vertices));
    patches.coordinates.extend_from_within(..);
    patches.faces.extend(coat.patches.faces.iter().map(|face| face.map(|corner| corner + corners)));
    patches.patch_ends.extend(coat.patches.patch_ends.iter().map(|end| end + faces));
    pair
}
