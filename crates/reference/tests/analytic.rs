//! Scenes whose pictures are known by formula.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3};
use pelage_coat::{Camera, Irradiance, Light, Lights};
use pelage_lighting::{DirectionalLight, HairPoint, Illumination, SelfShadow, Shading};
use pelage_reference::{Laying, Placement, Scene, Settings, Shadows, SkinColours, View, quiet};
use pelage_strand::{Bands, GrowSettings, Opacity, Stop, StrandSource, Undercoat, grow};
use support::{above, area, covered, dark_skin, hair, hull_area, square, tile};

#[test]
fn one_hair_covers_the_hull_of_two_discs() {
    // Two tiles along the unit side: a tile is a half wide, and all but height is halved.
    let coat = square(4, 2.0);
    for (from, to, radii) in [
        ([0.5, 0.5, 0.0], [0.9, 0.8, 1.0], [0.06, 0.01]),
        ([0.3, 0.6, 0.0], [0.3, 0.2, 0.7], [0.02, 0.02]),
        ([0.5, 0.5, 0.0], [0.5, 0.5, 1.0], [0.05, 0.03]),
    ] {
        let tile = tile(&[hair(&[from, to], &radii)]);
        // Over the middle of the first tile alone.
        let seen = covered(&coat, &tile, &dark_skin(), above(Vec3::new(-0.25, -0.25, 0.0), 0.5), 160, 36);
        let run = 0.5 * ((to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2)).sqrt();
        let radii = radii.map(|radius| 0.5 * radius);
        let wanted = if run > 0.0 { hull_area(run, radii) } else { PI * radii[0] * radii[0] };
        // What of it is over the rim of the tile comes back in at the other side, since the hair of the next tile is there.
        assert!((area(&seen, 0.5) / wanted - 1.0).abs() < 2e-3, "{} of {wanted}", area(&seen, 0.5));
    }
}

#[test]
fn a_fan_covers_its_strips_less_where_they_meet() {
    let (count, radius, length) = (9, 0.02, 0.4);
    let strands: Vec<StrandSource> = (0..count)
        .map(|k| f64::from(k) * TAU / f64::from(count))
        .map(|angle| hair(&[[0.5, 0.5, 0.5], [0.5 + length * angle.cos(), 0.5 + length * angle.sin(), 0.5]], &[radius; 2]))
        .collect();
    let seen = covered(&square(3, 1.0), &tile(&strands), &dark_skin(), above(Vec3::ZERO, 1.0), 160, 36);
    // In its sector a strand is a strip and half a disc, without the two triangles that stick out into the neighbours' sectors.
    let wanted = f64::from(count) * (2.0 * radius * length - radius * radius / (PI / f64::from(count)).tan() + 0.5 * PI * radius * radius);
    assert!((area(&seen, 1.0) / wanted - 1.0).abs() < 2e-3, "{} of {wanted}", area(&seen, 1.0));
}

#[test]
fn a_grid_covers_a_disc_for_each_hair_however_large_the_tile() {
    let side = 5;
    let strands: Vec<StrandSource> = (0..side * side)
        .map(|k| [f64::from(k % side) + 0.47, f64::from(k / side) + 0.53].map(|c| c / f64::from(side)))
        .map(|[x, y]| hair(&[[x, y, 0.0], [x, y, 1.0]], &[0.06; 2]))
        .collect();
    for tiles in [1.0, 3.0] {
        let seen = covered(&square(4, tiles), &tile(&strands), &dark_skin(), above(Vec3::ZERO, 1.0), 160, 36);
        let wanted = f64::from(side * side) * PI * 0.06 * 0.06;
        assert!((area(&seen, 1.0) / wanted - 1.0).abs() < 2e-3, "{tiles} tiles: {} of {wanted}", area(&seen, 1.0));
    }
}

#[test]
fn grown_hair_lets_through_what_its_tile_says() {
    // Seen along the normal a hair is the union of its sections, by whoever's code.
    let white = [1.0; 3];
    let undercoat = Undercoat { count: 300, colour: white, ..Undercoat::default() };
    let settings =
        GrowSettings { count: 300, undercoat, root_colour: white, tip_colour: white, colour_variation: 0.0, ..GrowSettings::default() };
    let hair = grow(&settings).unwrap();
    let wanted = 1.0 - hair.transmittance([0.0, 0.0], 1024).unwrap();
    // 2 × 2 tiles in the middle of 4 × 4, so that hair leans in from all sides.
    let seen = covered(&square(5, 4.0), &hair, &Laying { tolerance: 0.02, ..dark_skin() }, above(Vec3::ZERO, 0.5), 160, 16);
    let got = area(&seen, 1.0);
    assert!((got - wanted).abs() < 2e-3, "{got} of {wanted}");
}

/// Half opaque, a hair covers half of its hull; two over each other three quarters; and where it fades from root to tip, its mean.
#[test]
fn translucent_hair_covers_its_part() {
    let coat = square(4, 1.0);
    let rod = |height: f64| hair(&[[0.2, 0.5, height], [0.8, 0.5, height]], &[0.05; 2]);
    let whole = hull_area(0.6, [0.05; 2]);
    for (rods, opacity, wanted) in [
        (vec![rod(0.5)], [0.5, 0.5], 0.5),
        (vec![rod(0.4), rod(0.8)], [0.5, 0.5], 0.75),
        (vec![rod(0.5)], [0.9, 0.1], 0.5),
        (vec![rod(0.5)], [0.0, 0.0], 0.0),
        (vec![rod(0.5)], [1.0, 1.0], 1.0),
    ] {
        let opacity = Opacity { root: opacity[0], tip: opacity[1], variation: 0.0 };
        let tile = tile(&rods).tinted(Bands::default(), &opacity).unwrap();
        let seen = covered(&coat, &tile, &dark_skin(), above(Vec3::ZERO, 1.0), 160, 64);
        assert!((area(&seen, 1.0) / whole - wanted).abs() < 5e-3, "{opacity:?}: {} of {wanted}", area(&seen, 1.0) / whole);
    }
}

#[test]
fn a_banded_hair_is_seen_in_its_bands() {
    let stop = |along: f32, grey: f32| Stop { along, colour: [grey; 3] };
    let bands = Bands::new(&[stop(0.0, 0.9), stop(0.4, 0.9), stop(0.4, 0.2), stop(0.7, 0.2), stop(0.7, 0.6)]).unwrap();
    let tile = tile(&[hair(&[[0.0, 0.5, 0.5], [1.0, 0.5, 0.5]], &[0.05; 2])]).tinted(bands, &Opacity::default()).unwrap();
    let seen = covered(&square(4, 1.0), &tile, &dark_skin(), above(Vec3::ZERO, 1.0), 100, 16);
    for x in 2..98 {
        let along = (x as f64 + 0.5) / 100.0;
        let wanted = f64::from(bands.at(along as f32)[0]);
        let near_edge = [0.4, 0.7].iter().any(|edge| (along - edge).abs() < 0.02);
        assert!(near_edge || (seen[50 * 100 + x] - wanted).abs() < 0.01, "{along}: {} of {wanted}", seen[50 * 100 + x]);
    }
}

#[test]
fn hair_and_skin_are_lit_by_the_formula() {
    let mut coat = square(2, 1.0);
    for (k, colour) in coat.surface.colours.iter_mut().enumerate() {
        // Linear over the square, so that interpolation is exact.
        let at = Vec2::new((k % 3) as f32, (k / 3) as f32) / 2.0;
        *colour = Vec3::new(0.2 + 0.5 * at.x, 0.9 - 0.3 * at.y, 0.5);
    }
    coat.surface.directions = vec![Vec3::new(0.3, 0.4, 0.5); 9];
    coat.surface.normals = vec![Vec3::new(0.0, 0.6, 0.8); 9];
    let strand = StrandSource {
        points: vec![[0.5, 0.5, 0.0], [0.8, 0.7, 1.0]],
        radii: vec![1e-4; 2],
        root_colour: [0.1, 0.2, 0.3],
        tip_colour: [0.9, 0.6, 0.5],
    };
    let tile = tile(&[strand]);
    let skin = SkinColours { under_fur: DVec3::new(0.4, 0.3, 0.2), bare: DVec3::new(0.8, 0.7, 0.1) };
    let laying = Laying { skin, ..Laying::default() };
    let lights = lights();
    let shading = Shading { self_shadow: SelfShadow { density: 1.3, ..SelfShadow::default() }, ..Shading::default() };
    let illumination = illumination(&lights);
    let look = |coat: &pelage_coat::Coat, target: DVec3| {
        let camera = Camera { eye: Vec3::new(0.1, 0.3, 4.0), target: target.as_vec3(), up: Vec3::Y, field_of_view: 1e-5, near: 0.1 };
        let view = View { camera, lights: lights.clone(), shading };
        let scene = Scene::new(coat, &tile, &laying).unwrap();
        let image = scene.render(&view, &Settings { size: (1, 1), samples: 1, ..Settings::default() }, &quiet).unwrap();
        (DVec3::from(image.pixels[0].map(f64::from).first_chunk::<3>().copied().unwrap()), (camera.eye.as_dvec3() - target).normalize())
    };
    let normal = DVec3::new(0.0, 0.6, 0.8);
    // The hair leans over 0.3 and 0.2 while it rises by 0.1.
    let direction = DVec3::new(0.3, 0.2, 0.1).normalize();
    for height in [0.15, 0.5, 0.9] {
        let axis = DVec3::new(0.3 * height, 0.2 * height, 0.1 * height);
        let (seen, view) = look(&coat, axis);
        let along = DVec3::new(0.1, 0.2, 0.3).lerp(DVec3::new(0.9, 0.6, 0.5), height);
        let at = axis + 0.5;
        let colour = DVec3::new(0.2 + 0.5 * at.x, 0.9 - 0.3 * at.y, 0.5);
        let wanted = colour * along * shading.shade(&illumination, view, &HairPoint { direction, normal, height });
        // The line to the axis meets the hair its width before it.
        assert!((seen / wanted - 1.0).abs().max_element() < 2e-3, "hair at {height}: {seen} for {wanted}");
    }
    let place = DVec3::new(-0.3, -0.2, 0.0);
    let colour = DVec3::new(0.2 + 0.5 * 0.2, 0.9 - 0.3 * 0.3, 0.5);
    let (seen, view) = look(&coat, place);
    let roots = HairPoint { direction: DVec3::new(0.3, 0.4, 0.5), normal, height: 0.0 };
    let wanted = colour * skin.under_fur * shading.shade(&illumination, view, &roots);
    assert!(seen.abs_diff_eq(wanted, 1e-5), "skin under fur: {seen} for {wanted}");
    // Fur of half a thousandth: half of it is there.
    coat.surface.offsets = vec![0.0005 * Vec3::Z; 9];
    let (seen, _) = look(&coat, place);
    let wanted = 0.5 * (wanted + colour * skin.bare * shading.skin(&illumination, normal));
    assert!(seen.abs_diff_eq(wanted, 1e-5), "short fur: {seen} for {wanted}");
    coat.surface.offsets = vec![Vec3::ZERO; 9];
    let (seen, _) = look(&coat, place);
    assert!(seen.abs_diff_eq(colour * skin.bare * shading.skin(&illumination, normal), 1e-5), "bare skin");
}

#[test]
fn light_gets_to_the_side_of_a_hair_that_is_seen() {
    let (coat, shading) = (square(2, 1.0), Shading::default());
    // Level at half of a fur a tenth long, and a fiftieth thick: its upper side is at 0.7 of the fur.
    let tile = tile(&[hair(&[[0.2, 0.5, 0.5], [0.8, 0.5, 0.5]], &[0.02; 2])]);
    let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
    let view = View { camera: above(Vec3::ZERO, 1e-4), lights: lights(), shading };
    let image = scene.render(&view, &Settings { size: (1, 1), samples: 1, ..Settings::default() }, &quiet).unwrap();
    let point = HairPoint { direction: DVec3::X, normal: DVec3::Z, height: 0.7 };
    let wanted = shading.shade(&illumination(&lights()), DVec3::Z, &point);
    for channel in 0..3 {
        assert!((f64::from(image.pixels[0][channel]) - wanted[channel]).abs() < 1e-4, "{:?} for {wanted}", image.pixels[0]);
    }
}

#[test]
fn hair_too_short_to_count_is_there_in_part() {
    let tile = tile(&[hair(&[[0.5, 0.5, 0.0], [0.5, 0.5, 1.0]], &[0.3; 2])]);
    for part in [0.25f32, 0.7] {
        let mut coat = square(2, 1.0);
        coat.surface.offsets = vec![part * 1e-3 * Vec3::Z; 9];
        let seen = covered(&coat, &tile, &dark_skin(), above(Vec3::ZERO, 1.0), 64, 64);
        let wanted = f64::from(part) * PI * 0.09;
        assert!((area(&seen, 1.0) - wanted).abs() < 3e-3, "{} of {wanted}", area(&seen, 1.0));
    }
}

#[test]
fn rays_to_the_light_take_it_away_and_leave_the_sky() {
    let coat = square(2, 1.0);
    // A wall of hair; light comes in low from +x, so its shadow falls towards −x.
    let wall: Vec<StrandSource> =
        (0..40).map(|k| hair(&[[0.5, 0.3 + 0.01 * f64::from(k), 0.0], [0.5, 0.3 + 0.01 * f64::from(k), 1.0]], &[0.01; 2])).collect();
    let tile = tile(&wall);
    let low = Light { direction: Vec3::new(0.9, 0.0, 0.435_889_9), colour: Vec3::new(1.0, 0.5, 0.25) };
    let lights = Lights { directional: vec![low], ambient: Irradiance::hemisphere(Vec3::splat(0.3), Vec3::splat(0.2)) };
    let shading = Shading::default();
    let laying = Laying { skin: SkinColours { under_fur: DVec3::ONE, bare: DVec3::ONE }, ..Laying::default() };
    let scene = Scene::new(&coat, &tile, &laying).unwrap();
    let look = |x: f32, shadows: Shadows| {
        let camera = Camera { eye: Vec3::new(x, 0.0, 5.0), target: Vec3::new(x, 0.0, 0.0), up: Vec3::Y, field_of_view: 1e-4, near: 0.1 };
        let view = View { camera, lights: lights.clone(), shading };
        let image = scene.render(&view, &Settings { size: (1, 1), samples: 4, shadows, ..Settings::default() }, &quiet).unwrap();
        (DVec3::from(image.pixels[0].map(f64::from).first_chunk::<3>().copied().unwrap()), image.shadow_rays)
    };
    let mut illumination = illumination(&lights);
    let roots = HairPoint { direction: DVec3::Z, normal: DVec3::Z, height: 0.0 };
    // The shadow of a wall 0.1 high is 0.206 long.
    let unshadowed = Shading { self_shadow: SelfShadow { density: 0.0, ..shading.self_shadow }, ..shading };
    let sky = shading.shade(&Illumination { lights: Vec::new(), ..illumination.clone() }, DVec3::Z, &roots);
    let (dark, rays) = look(-0.1, Shadows::Rays);
    assert!(dark.abs_diff_eq(sky, 1e-6) && rays == 4, "{dark} for {sky}, {rays} rays");
    illumination.ambient = pelage_lighting::Irradiance::default();
    let lit = sky + unshadowed.shade(&illumination, DVec3::Z, &roots);
    for x in [-0.3, 0.1] {
        let (seen, _) = look(x, Shadows::Rays);
        assert!(seen.abs_diff_eq(lit, 1e-4), "{x}: {seen} for {lit}");
    }
    assert_eq!(look(-0.1, Shadows::Formula), look(0.1, Shadows::Formula), "depth knows no wall");
}

#[test]
fn no_hair_shades_itself() {
    let (coat, shading) = (square(2, 1.0), Shading::default());
    // Seen from above and lit from below the level hair, through it.
    let tile = tile(&[hair(&[[0.2, 0.5, 0.9], [0.8, 0.5, 0.9]], &[0.02; 2])]);
    let mut lights = lights();
    lights.directional = vec![Light { direction: Vec3::new(0.0, 0.995, 0.1).normalize(), colour: Vec3::ONE }];
    let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
    let view = View { camera: above(Vec3::ZERO, 1e-4), lights: lights.clone(), shading };
    let settings = Settings { size: (1, 1), samples: 1, shadows: Shadows::Rays, ..Settings::default() };
    let image = scene.render(&view, &settings, &quiet).unwrap();
    let point = HairPoint { direction: DVec3::X, normal: DVec3::Z, height: 1.0 };
    // At the tips depth shades nothing, so that formula and rays agree.
    let wanted = shading.shade(&illumination(&lights), DVec3::Z, &point);
    assert_eq!(image.shadow_rays, 1);
    for channel in 0..3 {
        assert!((f64::from(image.pixels[0][channel]) - wanted[channel]).abs() < 1e-4, "{:?} for {wanted}", image.pixels[0]);
    }
}

#[test]
fn outlines_cut_hair_in_shell_space_and_free_hair_goes_on() {
    // Two patches side by side; on the right one the tile is elsewhere and has no hair near the outline.
    let mut coat = square(2, 1.0);
    let (left, right): (Vec<[u32; 3]>, Vec<[u32; 3]>) = coat.patches.faces.iter().partition(|face| face.iter().all(|&v| v % 3 < 2));
    assert_eq!((left.len(), right.len()), (4, 4));
    coat.patches.vertices = (0..9).chain(0..9).collect();
    coat.patches.coordinates =
        coat.patches.coordinates.iter().copied().chain(coat.patches.coordinates.iter().map(|c| *c + Vec2::new(0.0, 0.5))).collect();
    coat.patches.faces = left.iter().copied().chain(right.iter().map(|face| face.map(|v| v + 9))).collect();
    coat.patches.patch_ends = vec![4, 8];
    // From 0.3 to 0.7 along s, across the outline at 0.5.
    let tile = tile(&[hair(&[[0.3, 0.25, 0.0], [0.7, 0.25, 1.0]], &[0.02; 2])]);
    let seen = |placement| {
        area(&covered(&coat, &tile, &Laying { placement, ..dark_skin() }, above(Vec3::new(0.0, -0.25, 0.0), 0.5), 160, 36), 0.5)
    };
    // Cut straight at the outline.
    let (cut, whole) = (0.2 * 0.04 + 0.5 * PI * 0.02 * 0.02, hull_area(0.4, [0.02; 2]));
    assert!((seen(Placement::Shell) / cut - 1.0).abs() < 2e-3, "{} of {cut}", seen(Placement::Shell));
    assert!((seen(Placement::Free) / whole - 1.0).abs() < 2e-3, "{} of {whole}", seen(Placement::Free));
    // The right patch has the half of the hair that is over it, and no root.
    let other = above(Vec3::new(0.0, 0.25, 0.0), 0.5);
    let on_right = |placement| area(&covered(&coat, &tile, &Laying { placement, ..dark_skin() }, other, 160, 36), 0.5);
    assert!((on_right(Placement::Shell) / cut - 1.0).abs() < 2e-3);
    assert_eq!(on_right(Placement::Free), 0.0);
}

#[test]
fn a_cut_is_level_and_bends_are_followed() {
    let (radius, tile) = (0.01, tile(&[hair(&[[0.5, 0.5, 0.0], [0.5, 0.5, 1.0]], &[0.01; 2])]));
    let mut coat = square(2, 1.0);
    let seen = |coat: &pelage_coat::Coat| area(&covered(coat, &tile, &dark_skin(), above(Vec3::ZERO, 1.0), 200, 36), 1.0);
    coat.surface.offsets = vec![Vec3::new(0.3, 0.0, 0.1); 9];
    // Along the shell of its end: half an ellipse, as much longer as the hair leans. Whole hair ends round.
    for (end, lengthened) in [(1.0, 1.0), (0.5, 10f64.sqrt()), (0.2, 10f64.sqrt())] {
        coat.surface.ends = vec![end as f32; 9];
        let wanted = 2.0 * radius * 0.3 * end + 0.5 * PI * radius * radius * (1.0 + lengthened);
        assert!((seen(&coat) / wanted - 1.0).abs() < 5e-3, "cut at {end}: {} of {wanted}", seen(&coat));
    }
    // c h + b (h² − h) with c along x and b along y: a parabola in the plane of the picture, and a bent strip is as large as a straight one.
    coat.surface.ends = vec![1.0; 9];
    coat.surface.bends = vec![Vec3::new(0.0, 0.4, 0.0); 9];
    let steps = 10_000;
    let speed = |h: f64| (0.09 + (0.4 * (2.0 * h - 1.0)).powi(2)).sqrt();
    let length = (0..steps).map(|k| speed((f64::from(k) + 0.5) / f64::from(steps))).sum::<f64>() / f64::from(steps);
    let wanted = 2.0 * radius * length + PI * radius * radius;
    assert!((seen(&coat) / wanted - 1.0).abs() < 5e-3, "bent: {} of {wanted}", seen(&coat));
}

fn lights() -> Lights {
    let light = |direction: Vec3, colour| Light { direction: direction.normalize(), colour };
    let directional =
        vec![light(Vec3::new(0.4, 0.7, 0.6), Vec3::new(1.5, 1.2, 0.9)), light(Vec3::new(-0.8, 0.1, 0.3), Vec3::new(0.2, 0.3, 0.6))];
    Lights { directional, ambient: Irradiance::hemisphere(Vec3::new(0.3, 0.4, 0.6), Vec3::new(0.2, 0.15, 0.1)) }
}

fn illumination(lights: &Lights) -> Illumination {
    let lamp = |light: &Light| DirectionalLight { direction: light.direction.as_dvec3().normalize(), colour: light.colour.as_dvec3() };
    Illumination {
        lights: lights.directional.iter().map(lamp).collect(),
        ambient: pelage_lighting::Irradiance(lights.ambient.0.map(Vec3::as_dvec3)),
    }
}
