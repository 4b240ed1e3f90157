//! Shaders leave out what a view does not need: the picture is the one that they make with it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use glam::Vec3;
use pelage_coat::Coat;
use pelage_render::{LightingMode, Options, Picture};

use support::{ball, difference, picture, view};

/// With a vertex that nothing shows, which has no fur: the shaders reckon with bare skin.
fn with_a_bare_vertex(mut coat: Coat) -> Coat {
    let surface = &mut coat.surface;
    surface.positions.push(Vec3::ZERO);
    surface.normals.push(Vec3::Y);
    surface.offsets.push(Vec3::ZERO);
    surface.bends.push(Vec3::ZERO);
    surface.ends.push(1.0);
    surface.mixes.push(0.0);
    surface.directions.push(Vec3::Y);
    surface.colours.push(Vec3::ONE);
    coat
}

fn pictures(change: impl Fn(&mut Options)) -> [Picture; 2] {
    let mut options = Options::default();
    change(&mut options);
    [ball(), with_a_bare_vertex(ball())].map(|coat| picture(&coat, &view(options)))
}

#[test]
fn fur_everywhere_is_drawn_as_if_skin_could_be_bare() {
    for lighting in [LightingMode::PerVertex, LightingMode::Formula] {
        let [grown, bare] = pictures(|options| options.lighting = lighting);
        assert_eq!(difference(&grown, &bare), (0.0, 0));
    }
    // Half of the thousandth of a diameter over which fur comes in.
    let [short, bare] = pictures(|options| options.length_scale = 0.01);
    assert_eq!(difference(&short, &bare), (0.0, 0));
}

#[test]
fn a_sky_is_the_polynomial_of_its_two_terms() {
    let sky = view(Options::default());
    let mut nearly = sky.clone();
    nearly.lights.ambient.0[5] = Vec3::splat(1e-30);
    assert_eq!(difference(&picture(&ball(), &sky), &picture(&ball(), &nearly)), (0.0, 0));
}
