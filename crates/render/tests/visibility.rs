//! Only what is seen is drawn (K18), and no picture changes by what is left out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use glam::Vec3;
use pelage_coat::{Camera, Coat};
use pelage_render::{March, Options, Picture, ShellDepth, Target, View};

use support::samples::{Style, coat, light, shapes};
use support::stage::Stage;
use support::{SIZE, ball, hair, headless, picture, sampled, twice, view};

/// The ball with hair that bends, and is cut ever shorter towards one side.
fn bent_and_cut() -> Coat {
    let mut bent = coat(&shapes::sphere(8, 4.0), Style { length: 0.08, slant: 0.9, ..Style::default() }, &hair(8));
    let surface = &mut bent.surface;
    for i in 0..surface.positions.len() {
        surface.bends[i] = 0.3 * (surface.offsets[i] - surface.normals[i] * surface.offsets[i].length());
        surface.ends[i] = (0.5 + 1.2 * surface.positions[i].x).clamp(0.0, 1.0);
    }
    bent
}

/// A small furry ball behind the other, to be hidden by it.
fn one_behind_the_other() -> Coat {
    twice(&ball(), |p| 0.3 * p - 2.0 * Vec3::Z)
}

/// From before, from near, from within the fur, from the skin, and past the ball.
fn cameras() -> Vec<Camera> {
    let at = |eye: Vec3, target: Vec3, near: f32| Camera { eye, target, up: Vec3::Y, field_of_view: 0.9, near };
    vec![
        at(1.2 * Vec3::Z, Vec3::ZERO, 0.01),
        at(Vec3::new(0.5, 0.3, 0.2), Vec3::ZERO, 0.01),
        at(Vec3::new(0.0, 0.1, 0.305), Vec3::new(0.3, 0.4, 0.1), 1e-3),
        at(0.289 * Vec3::Z, Vec3::new(0.2, 0.1, 0.5), 1e-4),
        at(Vec3::new(0.9, 0.0, 0.4), Vec3::new(0.9, 0.1, -1.0), 0.01),
        at(Vec3::ZERO, Vec3::X, 1e-3),
    ]
}

fn seen(coat: &Coat, camera: Camera, options: Options) -> Picture {
    picture(coat, &View { options, ..View::new(camera, light(Vec3::new(0.5, 0.8, 0.6))) })
}

#[test]
fn what_is_left_out_changes_no_pixel() {
    let mut bald_in_places = ball();
    for (offset, position) in bald_in_places.surface.offsets.iter_mut().zip(&bald_in_places.surface.positions) {
        if position.y > 0.1 {
            *offset = Vec3::ZERO;
        }
    }
    let everything = Options { culling: false, ..Options::default() };
    let hidden = Options { hidden: true, ..Options::default() };
    for (name, coat) in [("ball", ball()), ("bent", bent_and_cut()), ("bald", bald_in_places), ("pair", one_behind_the_other())] {
        for (i, camera) in cameras().into_iter().enumerate() {
            let all = seen(&coat, camera, everything);
            for options in [Options::default(), hidden] {
                let some = seen(&coat, camera, options);
                assert!(some.rgba == all.rgba && some.coverage == all.coverage, "{name}, camera {i}, hidden {}", options.hidden);
                assert!(some.frame.faces_drawn <= all.frame.faces_drawn);
            }
        }
    }
}

#[test]
fn what_is_left_out_changes_no_pixel_whatever_the_options() {
    let depths = [ShellDepth::default(), ShellDepth::Tested, ShellDepth::Coverage { threshold: 0.02 }];
    let marches = [March::default(), March { layers: 4, steps: 1 }, March { layers: 1, steps: 3 }];
    for (name, coat) in [("bent", bent_and_cut()), ("pair", one_behind_the_other())] {
        for camera in [cameras()[0], cameras()[2]] {
            for (shell_depth, march) in depths.into_iter().flat_map(|depth| marches.map(|march| (depth, march))) {
                let options = Options { shell_depth, march, ..Options::default() };
                let of = |options| sampled(&coat, &View { options, ..View::new(camera, light(Vec3::new(0.5, 0.8, 0.6))) }, 1);
                let all = of(Options { culling: false, ..options });
                for hidden in [false, true] {
                    let some = of(Options { hidden, ..options });
                    assert!(some.rgba == all.rgba && some.coverage == all.coverage, "{name}, {shell_depth:?}, {march:?}, hidden {hidden}");
                    assert!(some.frame.faces_drawn < all.frame.faces_drawn);
                }
            }
        }
    }
}

#[test]
fn what_is_hidden_is_found_in_targets_of_any_kind_and_size() {
    let pair = one_behind_the_other();
    let camera = cameras()[0];
    let view = View::new(camera, light(Vec3::new(0.5, 0.8, 0.6)));
    let (device, queue) = (headless().device(), headless().queue());
    for (reversed_depth, samples) in [(true, 1), (true, 4), (false, 1), (false, 4)] {
        let target = Target { reversed_depth, ..Target::new(wgpu::TextureFormat::Rgba8UnormSrgb, samples) };
        let mut stage = Stage::on(device, queue, target);
        let coat = stage.upload(&pair);
        let mut prepared = stage.prepare(&coat, &view);
        for size in [SIZE, (48, 100), (33, 9), (128, 96), SIZE] {
            stage.size = size;
            stage.update(&mut prepared, &view);
            let whole = stage.frame(&prepared);
            let faces = prepared.frame_stats(device, queue).unwrap().faces_drawn;
            assert!(stage.unhidden_frame(&mut prepared) == whole, "{size:?}, {reversed_depth}, {samples}");
            let left = prepared.frame_stats(device, queue).unwrap().faces_drawn;
            // In squares of 8 pixels of so low a picture there is always something far.
            assert!(left < faces || size.1 < 16, "{size:?}, {reversed_depth}, {samples}: {left} of {faces}");
            // Anew, it is the same picture: nothing of the size before is left.
            assert!(stage.frame(&stage.prepare(&coat, &view)) == whole);
            // Into another depth buffer of the same size, from where the ball behind is seen.
            let beside = View { camera: Camera { eye: Vec3::new(1.6, 0.3, 0.6), ..camera }, ..view.clone() };
            stage.update(&mut prepared, &beside);
            assert!(stage.unhidden_frame(&mut prepared) == stage.frame(&prepared), "{size:?}, {reversed_depth}, {samples}");
        }
        // A target of another size than the viewpoint says, as where resolution follows the load.
        let viewpoint = stage.viewpoint(&view);
        stage.size = (192, 144);
        let mut prepared = stage.prepare_from(&coat, &view, &viewpoint);
        let whole = stage.frame(&prepared);
        let faces = prepared.frame_stats(device, queue).unwrap().faces_drawn;
        assert!(stage.unhidden_frame(&mut prepared) == whole);
        let left = prepared.frame_stats(device, queue).unwrap().faces_drawn;
        assert!(left < faces, "{reversed_depth}, {samples}: {left} of {faces}");
        assert_eq!(headless().take_errors(), Vec::<String>::new());
    }
}

#[test]
fn the_far_side_and_what_is_out_of_view_are_left_out() {
    let ball = ball();
    let from = |eye: Vec3, target: Vec3| {
        seen(&ball, Camera { eye, target, up: Vec3::Y, field_of_view: 0.6, near: 0.01 }, Options::default()).frame
    };
    let front = from(3.0 * Vec3::Z, Vec3::ZERO);
    // Less than half of it is before the horizon; fur shows a little beyond.
    assert!((0.4..0.6).contains(&(f64::from(front.faces_drawn) / f64::from(front.faces_furred))), "{front:?}");
    assert!(front.patches_drawn < front.patches, "{front:?}");
    let away = from(3.0 * Vec3::Z, 6.0 * Vec3::Z);
    assert_eq!((away.faces_drawn, away.patches_drawn), (0, 0));
    // The view's edge goes through the ball's middle.
    let half = from(Vec3::new(0.0, 0.0, 3.0), Vec3::new(1.28, 0.0, 0.0));
    assert!(half.faces_drawn < front.faces_drawn * 3 / 4, "{half:?}");
}

#[test]
fn what_the_skin_hides_is_left_out() {
    let pair = one_behind_the_other();
    let camera = Camera { eye: 1.2 * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.9, near: 0.01 };
    let facing = seen(&pair, camera, Options::default()).frame;
    let unhidden = seen(&pair, camera, Options { hidden: true, ..Options::default() }).frame;
    let alone = seen(&ball(), camera, Options { hidden: true, ..Options::default() }).frame;
    assert!(facing.faces_drawn > unhidden.faces_drawn, "{facing:?} {unhidden:?}");
    assert_eq!(unhidden.faces_drawn, alone.faces_drawn, "all of the small ball is behind the large one");
    assert!(alone.faces_drawn > alone.faces_furred / 3);
}

#[test]
fn hair_that_is_cut_ends_its_shells_there() {
    let mut cut = ball();
    cut.surface.ends.fill(0.5);
    let (whole, half) = (picture(&ball(), &view(Options::default())).frame, picture(&cut, &view(Options::default())).frame);
    // Eight layers: at 1/7 … 4/7 there is hair, beyond it fades by a layer.
    assert_eq!(whole.triangles - half.triangles, 3 * u64::from(whole.faces_drawn), "{whole:?} {half:?}");
    // Where some is long, only that is drawn further up.
    for (end, position) in cut.surface.ends.iter_mut().zip(&cut.surface.positions) {
        if position.x > 0.0 {
            *end = 1.0;
        }
    }
    let mixed = picture(&cut, &view(Options::default())).frame.triangles;
    assert!(half.triangles < mixed && mixed < whole.triangles);
    cut.surface.ends.fill(0.0);
    let bald = picture(&cut, &view(Options { fins: false, ..Options::default() }));
    assert_eq!((bald.frame.faces_furred, bald.frame.faces_drawn), (0, 0));
}

#[test]
fn the_same_faces_in_the_same_order_each_time() {
    let (coat, camera) = (bent_and_cut(), cameras()[1]);
    let first = seen(&coat, camera, Options::default());
    for _ in 0..3 {
        assert!(seen(&coat, camera, Options::default()).rgba == first.rgba);
    }
    assert_eq!(first.rgba.len() as u32, 4 * SIZE.0 * SIZE.1);
}
