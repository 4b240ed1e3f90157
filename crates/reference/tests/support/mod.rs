//! Small coats, cameras and lights whose pictures are known.
#![allow(dead_code, reason = "no test uses all of it")]

#[path = "../../src/fixture.rs"]
mod fixture;

pub(crate) use fixture::square;

use glam::{DVec3, Vec3};
use pelage_coat::{Camera, Coat, Irradiance, Lights};
use pelage_lighting::{Facing, HairLighting, SelfShadow, Shading};
use pelage_reference::{Image, Laying, Scene, Settings, SkinColours, View, quiet};
use pelage_strand::{StrandSource, StrandTile};

/// From straight above, so far away that all rays are parallel to a ten-thousandth; the picture shows `window` of the plane z = 0 from top to bottom.
pub(crate) fn above(centre: Vec3, window: f32) -> Camera {
    let distance = 2000.0;
    let field_of_view = 2.0 * (0.5 * window / distance).atan();
    Camera { eye: centre + distance * Vec3::Z, target: centre, up: Vec3::Y, field_of_view, near: 1.0 }
}

/// A light from all around in which everything is as bright as it is white.
pub(crate) fn glow() -> (Lights, Shading) {
    let lights = Lights { directional: Vec::new(), ambient: Irradiance::hemisphere(Vec3::ONE, Vec3::ONE) };
    let hair = HairLighting { ambient: DVec3::ONE, ..HairLighting::default() };
    (lights, Shading { hair, self_shadow: SelfShadow { density: 0.0, ..SelfShadow::default() }, facing: Facing::default() })
}

/// Skin that sends back nothing.
pub(crate) fn dark_skin() -> Laying {
    Laying { skin: SkinColours { under_fur: DVec3::ZERO, bare: DVec3::ZERO }, tolerance: 1e-3, ..Laying::default() }
}

/// A white hair.
pub(crate) fn hair(points: &[[f64; 3]], radii: &[f64]) -> StrandSource {
    StrandSource { points: points.to_vec(), radii: radii.to_vec(), root_colour: [1.0; 3], tip_colour: [1.0; 3] }
}

/// A box one high with some hair.
pub(crate) fn tile(strands: &[StrandSource]) -> StrandTile {
    StrandTile::from_strands(1.0, strands).unwrap()
}

/// The picture of white hair over black skin in even light: what of each pixel hair covers.
pub(crate) fn covered(coat: &Coat, tile: &StrandTile, laying: &Laying, camera: Camera, size: u32, samples: u32) -> Vec<f64> {
    let (lights, shading) = glow();
    let scene = Scene::new(coat, tile, laying).unwrap();
    let image =
        scene.render(&View { camera, lights, shading }, &Settings { size: (size, size), samples, ..Settings::default() }, &quiet).unwrap();
    image.pixels.iter().map(|pixel| f64::from(pixel[0])).collect()
}

/// The area that hair covers of a square picture `window` wide.
pub(crate) fn area(covered: &[f64], window: f64) -> f64 {
    covered.iter().sum::<f64>() / covered.len() as f64 * window * window
}

/// The area of the hull of two discs a distance apart.
pub(crate) fn hull_area(distance: f64, radii: [f64; 2]) -> f64 {
    let angle = ((radii[0] - radii[1]) / distance).acos();
    (radii[0] + radii[1]) * distance * angle.sin() + (std::f64::consts::PI - angle) * radii[0] * radii[0] + angle * radii[1] * radii[1]
}

/// The root of the mean square difference of all channels.
pub(crate) fn rmse(a: &Image, b: &Image) -> f64 {
    let squares = a.pixels.iter().zip(&b.pixels).flat_map(|(a, b)| (0..4).map(|c| f64::from(a[c] - b[c]).powi(2)));
    (squares.sum::<f64>() / (4 * a.pixels.len()) as f64).sqrt()
}
