//! A crowd is drawn as its members are one by one, in a host's own frame with wgpu's default limits.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../examples/host/mod.rs"]
mod host;
#[path = "../samples/mod.rs"]
mod samples;

use glam::camera::rh::{proj::directx::perspective, view::look_at_mat4};
use glam::{Mat4, Vec3};
use pelage_coat::{Camera, Lights};
use pelage_render::{Detail, GpuCoat, LightingMode, March, Options, RenderError, Renderer, Target, View, Viewpoint};

use host::{COLOUR, DEPTH, Host};
use samples::hair::Recipe;
use samples::levels::with_levels;
use samples::{Style, coat, light, shapes};

const SIZE: (u32, u32) = (128, 96);
const EYE: Vec3 = Vec3::new(0.4, 0.9, 3.0);

fn setting() -> (Host, Renderer, GpuCoat) {
    let host = Host::new(SIZE, 1).unwrap();
    let target = Target { colour: COLOUR, depth: DEPTH, reversed_depth: false, samples: 1 };
    let renderer = Renderer::new(&host.device, &host.queue, target);
    let hair =
        with_levels(&Recipe { layers: 8, resolution: 32, guard_hairs: 60, under_hairs: 100, radius: 0.03, ..Recipe::default() }.grow());
    let ball = coat(&shapes::sphere(8, 4.0), Style { length: 0.05, ..Style::default() }, &hair);
    let coat = renderer.upload(&host.device, &host.queue, &ball).unwrap();
    (host, renderer, coat)
}

fn clip_from_world() -> Mat4 {
    perspective(0.6, SIZE.0 as f32 / SIZE.1 as f32, 0.1, 40.0) * look_at_mat4(EYE, Vec3::ZERO, Vec3::Y)
}

/// The near one before the far one, and one behind the eye.
fn places() -> Vec<Mat4> {
    let placed = |place, turn, size| Mat4::from_translation(place) * Mat4::from_rotation_y(turn) * Mat4::from_scale(Vec3::splat(size));
    vec![
        placed(Vec3::new(0.1, 0.1, 0.5), 0.7, 0.9),
        placed(Vec3::new(-0.3, 0.1, -0.9), 2.0, 1.9),
        placed(Vec3::new(0.0, 1.0, 5.0), 0.0, 1.0),
    ]
}

fn view(world_from_coat: Mat4, options: Options) -> View {
    let Lights { mut directional, ambient } = light(Vec3::new(0.5, 0.8, 0.6));
    for light in &mut directional {
        light.direction = world_from_coat.inverse().transform_vector3(light.direction).normalize();
    }
    let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.1 };
    View { options, ..View::new(camera, Lights { directional, ambient }) }
}

fn world() -> Viewpoint {
    Viewpoint::placed(clip_from_world(), EYE, Mat4::IDENTITY, SIZE)
}

fn together((host, renderer, coat): &(Host, Renderer, GpuCoat), options: Options) -> (Vec<u8>, Vec<u32>) {
    let view = view(Mat4::IDENTITY, options);
    let mut crowd = renderer.prepare_crowd(&host.device, &host.queue, coat, (&view, &world()), 3).unwrap();
    renderer.update_crowd(&host.device, &host.queue, &mut crowd, (&view, &world()), &places()).unwrap();
    let mut encoder = host.encoder();
    {
        let mut pass = host.pass(&mut encoder, true, true);
        renderer.draw_crowd_surface(&mut pass, &crowd);
        renderer.draw_crowd_shells(&mut pass, &crowd);
    }
    host.finish(encoder).unwrap();
    (host.pixels().unwrap(), crowd.seen_by_level())
}

fn one_by_one((host, renderer, coat): &(Host, Renderer, GpuCoat), options: Options) -> Vec<u8> {
    let options = Options { fins: false, culling: false, ..options };
    let far_first = [1, 0].map(|i| {
        let place = places()[i];
        let viewpoint = Viewpoint::placed(clip_from_world(), EYE, place, SIZE);
        renderer.prepare(&host.device, &host.queue, coat, &view(place, options), &viewpoint).unwrap()
    });
    let mut encoder = host.encoder();
    far_first.iter().for_each(|prepared| renderer.compute(&mut encoder, prepared));
    {
        let mut pass = host.pass(&mut encoder, true, true);
        far_first.iter().for_each(|prepared| renderer.draw_surface(&mut pass, prepared));
        far_first.iter().for_each(|prepared| renderer.draw_shells(&mut pass, prepared));
    }
    host.finish(encoder).unwrap();
    host.pixels().unwrap()
}

/// The mean difference, and the part of the bytes that differ by more than 2 of 255.
fn difference(a: &[u8], b: &[u8]) -> (f64, f64) {
    let each = a.iter().zip(b).map(|(&a, &b)| a.abs_diff(b));
    let count = a.len() as f64;
    (each.clone().map(f64::from).sum::<f64>() / count, each.filter(|&d| d > 2).count() as f64 / count)
}

#[test]
fn a_crowd_looks_like_its_members_one_by_one() {
    let setting = setting();
    let of = |lighting, detail| Options { lighting, detail, ..Options::default() };
    for options in [
        of(LightingMode::PerVertex, Detail::Level(0.0)),
        of(LightingMode::Formula, Detail::Whole(0.6)),
        // Fur that comes in: its growth is a matter of the coat's lengths, not of the world's.
        Options { length_scale: 0.01, ..of(LightingMode::PerVertex, Detail::Level(0.0)) },
        // What looks along the tile's axes.
        Options { march: March { layers: 7, steps: 1 }, hair_shadow: 1.0, ..of(LightingMode::PerVertex, Detail::Level(0.0)) },
    ] {
        let (crowd, seen) = together(&setting, options);
        assert_eq!(seen.iter().sum::<u32>(), 2, "what is behind the eye is left out: {seen:?}");
        let (mean, unlike) = difference(&crowd, &one_by_one(&setting, options));
        // Places are rounded on another way: a texel here, a depth there.
        assert!(mean < 0.05 && unlike < 0.003, "{options:?}: {mean} {unlike}");
    }
}

#[test]
fn levels_differ_by_distance() {
    let (_, seen) = together(&setting(), Options { detail: Detail::Whole(1.27), ..Options::default() });
    assert!(seen.iter().filter(|&&count| count > 0).count() == 2, "{seen:?}");
}

#[test]
fn whole_levels_are_the_nearest() {
    let (host, renderer, coat) = setting();
    let level = |detail| {
        let view = view(Mat4::IDENTITY, Options { detail, ..Options::default() });
        renderer.prepare(&host.device, &host.queue, &coat, &view, &world()).unwrap().level()
    };
    for pixels in [0.5, 0.9, 1.3, 1.7] {
        let (spaced, whole) = (level(Detail::Spacing(pixels)), level(Detail::Whole(pixels)));
        assert_eq!(whole, spaced.round(), "at {pixels} pixels");
    }
    assert!(level(Detail::Spacing(0.9)).fract() > 0.0);
}

#[test]
fn the_faces_drawn_can_be_read_back() {
    let (host, renderer, coat) = setting();
    let faces = |culling| {
        let view = view(Mat4::IDENTITY, Options { culling, ..Options::default() });
        let prepared = renderer.prepare(&host.device, &host.queue, &coat, &view, &world()).unwrap();
        let mut encoder = host.encoder();
        renderer.compute(&mut encoder, &prepared);
        host.finish(encoder).unwrap();
        let stats = prepared.frame_stats(&host.device, &host.queue).unwrap();
        let faces = prepared.shell_faces(&host.device, &host.queue).unwrap();
        assert_eq!(faces.len(), stats.faces_drawn as usize);
        faces
    };
    let (picked, all) = (faces(true), faces(false));
    assert_eq!(all.len(), 768);
    assert!(picked.len() < 600 && picked.len() > 300, "about the half that faces the eye, and what fur adds: {}", picked.len());
    let mut rest = all.iter();
    assert!(picked.iter().all(|face| rest.any(|other| other == face)), "in their order, no face twice");
}

#[test]
fn a_place_of_no_size_shows_nothing() {
    let (host, renderer, coat) = setting();
    let view = view(Mat4::IDENTITY, Options::default());
    let with = |places: &[Mat4]| {
        let mut crowd = renderer.prepare_crowd(&host.device, &host.queue, &coat, (&view, &world()), 3).unwrap();
        renderer.update_crowd(&host.device, &host.queue, &mut crowd, (&view, &world()), places).unwrap();
        let mut encoder = host.encoder();
        {
            let mut pass = host.pass(&mut encoder, true, true);
            renderer.draw_crowd_surface(&mut pass, &crowd);
            renderer.draw_crowd_shells(&mut pass, &crowd);
        }
        host.finish(encoder).unwrap();
        host.pixels().unwrap()
    };
    let nowhere = Mat4::from_translation(Vec3::new(-0.2, 0.1, 0.4)) * Mat4::from_scale(Vec3::ZERO);
    assert!(with(&[places()[0], nowhere]) == with(&places()[..1]));
}

#[test]
fn a_crowd_says_what_it_cannot_hold() {
    let (host, renderer, coat) = setting();
    let view = view(Mat4::IDENTITY, Options::default());
    let mut crowd = renderer.prepare_crowd(&host.device, &host.queue, &coat, (&view, &world()), 2).unwrap();
    let mut update = |places: &[Mat4]| renderer.update_crowd(&host.device, &host.queue, &mut crowd, (&view, &world()), places);
    assert!(matches!(update(&places()), Err(RenderError::Limit { needed: 3, limit: 2, .. })));
    assert!(matches!(update(&[Mat4::from_translation(Vec3::NAN)]), Err(RenderError::View { .. })));
    assert!(matches!(update(&[Mat4::IDENTITY, Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0))]), Err(RenderError::Mirrored { place: 1 })));
    assert!(update(&[]).is_ok() && update(&places()[..2]).is_ok());
    assert!(matches!(
        renderer.prepare_crowd(&host.device, &host.queue, &coat, (&view, &world()), 1 << 25),
        Err(RenderError::Limit { needed: 0x200_0000, limit: 0x100_0000, .. })
    ));
}
