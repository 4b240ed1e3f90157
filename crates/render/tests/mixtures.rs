//! Coats that become each other (L24): where a mixture stands alone the picture is that of its own textures, whatever is switched on; between two it is of both, by their shares.
#![allow(clippy::print_stdout, reason = "how far pictures are from each other")]
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

mod support;

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Coat, FinTexture, MipImage, ShellTexture};
use pelage_render::{Detail, LightingMode, March, Options, Picture, ShadowOptions, ShellDepth};
use support::samples::hair::{Hair, Recipe};
use support::samples::{Style, coat, shapes};
use support::{bytes, difference, flat_hair, middle, picture, view};

/// Three kinds of hair that differ in everything that textures may differ in.
fn kinds() -> [Hair; 3] {
    [(1, 20, 0.05), (2, 45, 0.03), (3, 10, 0.08)].map(|(seed, guard_hairs, radius)| {
        let hair = Recipe { layers: 6, resolution: 16, guard_hairs, under_hairs: 30, radius, seed, levels: true }.grow();
        let mut shells = (*hair.shells).clone();
        let way = [110 + 10 * seed as u8, 120, 220, 0];
        let flat = |mip: &MipImage| MipImage { texels: way.repeat(mip.texels.len() / 4), ..mip.clone() };
        shells.directions = Some(shells.mips.iter().map(flat).collect());
        Hair { shells: Arc::new(shells), ..hair }
    })
}

fn ball(hair: &Hair) -> Coat {
    let mut ball = coat(&shapes::sphere(4, 4.0), Style { length: 0.06, ..Style::default() }, hair);
    // Hair is lit at the mean of what the three say.
    let mean = joined(&kinds());
    ball.shells = Arc::new(ShellTexture { levels: mean.shells.levels.clone(), ..(*hair.shells).clone() });
    ball
}

fn joined(kinds: &[Hair]) -> Hair {
    let shells: Vec<ShellTexture> = kinds.iter().map(|kind| (*kind.shells).clone()).collect();
    let fins: Vec<FinTexture> = kinds.iter().map(|kind| (*kind.fin).clone()).collect();
    Hair { shells: Arc::new(ShellTexture::joined(&shells).unwrap()), fin: Arc::new(FinTexture::joined(&fins).unwrap()) }
}

/// The ball with all three kinds, mixed the same everywhere.
fn mixed(mix: f32) -> Coat {
    let mut ball = ball(&joined(&kinds()));
    ball.surface.mixes.fill(mix);
    ball
}

fn seen(coat: &Coat, options: &Options) -> Picture {
    picture(coat, &view(*options))
}

#[test]
fn a_mixture_alone_is_drawn_as_its_own_textures_are() {
    let by_pixel = Options { lighting: LightingMode::Formula, ..Options::default() };
    let options = [
        Options::default(),
        by_pixel,
        Options { direction_map: false, ..by_pixel },
        Options { hair_shadow: 0.8, ..by_pixel },
        Options { march: March { layers: 3, steps: 2 }, ..Options::default() },
        Options { detail: Detail::Level(0.8), ..Options::default() },
        Options { detail: Detail::Level(2.0), ..Options::default() },
        Options { shadows: Some(ShadowOptions { side: 128 }), ..Options::default() },
        Options { shell_depth: ShellDepth::Coverage { threshold: 0.05 }, ..Options::default() },
    ];
    for options in &options {
        for (kind, hair) in kinds().iter().enumerate() {
            let (mean, most) = difference(&seen(&mixed(0.5 * kind as f32), options), &seen(&ball(hair), options));
            assert!(most <= 1, "kind {kind}, {options:?}: {mean} in the mean, {most} at most");
        }
        let (mean, _) = difference(&seen(&mixed(0.0), options), &seen(&mixed(1.0), options));
        assert!(mean > 1.0, "the kinds differ, {options:?}: {mean}");
    }
}

#[test]
fn beyond_its_ends_the_row_goes_on_as_at_them() {
    for (beyond, end) in [(-0.5, 0.0), (1.5, 1.0)] {
        let (_, most) = difference(&seen(&mixed(beyond), &Options::default()), &seen(&mixed(end), &Options::default()));
        assert!(most <= 1, "{beyond}: {most}");
    }
}

#[test]
fn between_two_mixtures_is_each_by_its_share() {
    let flat = |colour: Vec3| flat_hair(2, colour);
    let (red, blue) = (Vec3::new(0.8, 0.1, 0.1), Vec3::new(0.1, 0.2, 0.8));
    let hair = joined(&[flat(red), flat(blue)]);
    let mut ball = coat(&shapes::sphere(8, 4.0), Style { length: 0.05, ..Style::default() }, &hair);
    ball.surface.colours.fill(Vec3::ONE);
    // Light of nothing but the surroundings, the same from everywhere, so that a pixel is the hair's own colour times one number.
    let mut view = view(Options::default());
    view.lights.directional.clear();
    view.lights.ambient = pelage_coat::Irradiance::hemisphere(Vec3::ONE, Vec3::ONE);
    view.shading.hair.ambient = DVec3::ONE;
    view.shading.self_shadow.density = 0.0;
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        ball.surface.mixes.fill(share);
        let (found, wanted) = (middle(&picture(&ball, &view)), bytes(red.lerp(blue, share).as_dvec3()));
        assert!(found.iter().zip(wanted).all(|(&a, b)| a.abs_diff(b) <= 2), "{share}: {found:?} of {wanted:?}");
    }
}

#[test]
fn no_step_shows_where_one_mixture_takes_over_from_another() {
    // The whole row within the ball, and the same a hair's breadth further on: where the lower mixture of the two changes, nothing jumps.
    let row = |shift: f32| {
        let mut ball = mixed(0.0);
        let places = ball.surface.positions.clone();
        for (mix, place) in ball.surface.mixes.iter_mut().zip(places) {
            *mix = 0.5 + 1.4 * place.x + shift;
        }
        seen(&ball, &Options::default())
    };
    let (here, near, far) = (row(0.0), row(0.004), row(0.25));
    let ((near, most), (far, _)) = (difference(&here, &near), difference(&here, &far));
    println!("a step of 0.004: {near:.3} of 255 in the mean, {most} at most; of 0.25: {far:.3}");
    assert!(most <= 12 && near < 0.1 * far, "{near}, {most}, {far}");
}

#[test]
fn one_drawn_fin_serves_all_mixtures() {
    let hair = Hair { fin: kinds()[1].fin.clone(), ..joined(&kinds()) };
    let (all, one) = (ball(&hair), ball(&Hair { fin: kinds()[1].fin.clone(), ..kinds()[0].clone() }));
    // The skin is the first kind's in both.
    let fins = Options { shells: false, ..Options::default() };
    let (seen_of_all, seen_of_one) = (seen(&all, &fins), seen(&one, &fins));
    assert!(seen_of_all.frame.fins_drawn > 0 && difference(&seen_of_all, &seen_of_one).1 <= 1);
}
