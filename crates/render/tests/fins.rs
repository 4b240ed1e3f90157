//! Which fins stand (L11, N1), and what they follow.
#![allow(clippy::expect_used, reason = "a test may panic")]

mod support;

use std::sync::Arc;

use glam::{Vec2, Vec3};
use pelage_coat::{Camera, Coat, FinEdges, FinTexture, MipImage, PatchMesh, Surface};
use pelage_render::{FinEdge, FinRule, Options, View, fin_edges, fin_opacity};

use support::samples::hair::encode;
use support::samples::{Dice, Style, coat, light, shapes};
use support::stage::Stage;
use support::{SIZE, ball, difference, flat_hair, hair, headless, picture};

const EYES: [Vec3; 5] = [
    Vec3::new(0.9, 0.31, 0.77),
    Vec3::new(-1.3, 0.42, 0.13),
    Vec3::new(0.11, -1.1, 0.37),
    Vec3::new(0.21, 0.13, 0.43),
    Vec3::new(0.03, 0.05, -4.0),
];

fn seen_from(eye: Vec3, options: Options) -> View {
    let camera = Camera { eye, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.6, near: 0.01 };
    View { options, ..View::new(camera, light(Vec3::new(0.5, 0.8, 0.6))) }
}

fn fins_only(fin_rule: FinRule) -> Options {
    Options { surface: false, shells: false, fin_rule, ..Options::default() }
}

/// So many edges of random pose, length and neighbours, one in eight at a boundary.
fn random_edges(count: u32) -> Coat {
    let mut dice = Dice::new(29);
    let mut unit = || (2.0 * Vec3::new(dice.roll(), dice.roll(), dice.roll()) - 1.0).normalize_or(Vec3::X);
    let vertices = 600;
    let mut surface = Surface::default();
    for _ in 0..vertices {
        surface.positions.push(0.3 * unit());
        surface.normals.push(unit());
        surface.offsets.push(0.05 * unit());
        surface.directions.push(unit());
    }
    surface.bends = vec![Vec3::ZERO; vertices];
    surface.ends = vec![1.0; vertices];
    surface.mixes = vec![0.0; vertices];
    surface.colours = vec![Vec3::ONE; vertices];
    let mut edges = FinEdges::default();
    for i in 0..count {
        let [a, b] = [i % 600, (i * 7 + i / 600 + 1) % 600];
        edges.vertices.push([a, b]);
        edges.intervals.push([0.0, 0.5]);
        edges.face_normals.push(if i % 8 == 0 { [unit(), Vec3::ZERO] } else { [unit(), unit()] });
        edges.curvatures.push((i % 13) as f32);
    }
    let patches = PatchMesh {
        vertices: vec![0, 1, 2],
        coordinates: vec![Vec2::ZERO; 3],
        faces: vec![[0, 1, 2]],
        patch_ends: vec![1],
        opacities: Vec::new(),
    };
    Coat { surface, patches, edges, ..ball() }
}

/// What the device picked, in its order.
fn picked(stage: &Stage, coat: &Coat, view: &View) -> Vec<(u32, f32)> {
    let uploaded = stage.upload(coat);
    let prepared = stage.prepare(&uploaded, view);
    stage.frame(&prepared);
    prepared.read_fins(&stage.device, &stage.queue).expect("fins")
}

/// The picked are those of which the processor says so, each as strong and in its place.
fn agree(picked: &[(u32, f32)], edges: &[FinEdge], opacity: impl Fn(&FinEdge) -> f32) -> usize {
    assert!(picked.windows(2).all(|pair| pair[0].0 < pair[1].0), "in the edges' order, none twice");
    let mut seen = vec![0.0; edges.len()];
    picked.iter().for_each(|&(edge, opacity)| seen[edge as usize] = opacity);
    let mut drawn = 0;
    for (i, (edge, seen)) in edges.iter().zip(seen).enumerate() {
        let expected = opacity(edge);
        drawn += usize::from(expected > 0.0);
        assert!((seen - expected).abs() < 2e-4, "edge {i}: {seen} is not {expected}");
    }
    drawn
}

/// NVIDIA's test: one face looks to the eye and the other away, or one is nearly along the view; nothing without area.
fn is_silhouette(edge: &FinEdge, eye: Vec3, threshold: f32) -> f32 {
    let toward = (eye - 0.5 * (edge.ends[0] + edge.ends[1])).normalize();
    let [near, beyond] = edge.face_normals.map(|n| n.dot(toward));
    let stands = near * beyond <= 0.0 || near.abs().min(beyond.abs()) < threshold;
    if stands && has_area(edge) { 1.0 } else { 0.0 }
}

fn has_area(edge: &FinEdge) -> bool {
    let along = edge.ends[1] - edge.ends[0];
    along.cross(edge.offset).length() > 1e-4 * along.length() * edge.offset.length()
}

#[test]
fn the_device_picks_the_fins_that_the_papers_rule_names() {
    let stage = Stage::plain();
    let mut short = ball();
    short.surface.offsets.iter_mut().zip(&short.surface.positions).filter(|(_, p)| p.x > 0.0).for_each(|(c, _)| *c *= 0.01);
    for coat in [short, random_edges(3000)] {
        for eye in EYES {
            for length_scale in [1.0, 2.5] {
                let view = seen_from(eye, Options { length_scale, ..fins_only(FinRule::Faded) });
                let edges = fin_edges(&coat);
                let drawn = agree(&picked(&stage, &coat, &view), &edges, |edge| fin_opacity(edge, view.camera.toward_eye(), length_scale));
                assert!(drawn > edges.len() / 20 && drawn < edges.len() * 9 / 10, "{drawn} of {}", edges.len());
            }
        }
    }
}

#[test]
fn nvidias_rule_takes_silhouettes_and_what_is_nearly_one() {
    let stage = Stage::plain();
    for coat in [ball(), random_edges(3000)] {
        let mut most = 0;
        for threshold in [0.0, 0.1, 0.4] {
            let mut sum = 0;
            for eye in EYES {
                let view = seen_from(eye, fins_only(FinRule::Silhouette { threshold }));
                sum += agree(&picked(&stage, &coat, &view), &fin_edges(&coat), |edge| is_silhouette(edge, eye, threshold));
            }
            assert!(sum > most, "a wider threshold takes more: {sum}, {most}");
            most = sum;
        }
    }
}

#[test]
fn nvidias_rule_always_takes_boundaries() {
    let stage = Stage::plain();
    let open = coat(&shapes::square(6, 3.0), Style::default(), &hair(4));
    let boundary: Vec<u32> = (0..).zip(&open.edges.face_normals).filter(|(_, n)| n[1] == Vec3::ZERO).map(|(edge, _)| edge).collect();
    assert_eq!(boundary.len(), 24);
    for eye in [Vec3::new(0.2, 0.1, 2.0), Vec3::new(-0.4, 0.3, -1.5)] {
        for threshold in [0.0, 0.05] {
            let fins = picked(&stage, &open, &seen_from(eye, fins_only(FinRule::Silhouette { threshold })));
            assert_eq!(fins.iter().map(|fin| fin.0).collect::<Vec<_>>(), boundary, "from {eye}, threshold {threshold}");
        }
    }
    // By the paper's rule a boundary is an edge like others: from behind none stands.
    let behind = seen_from(Vec3::new(-0.4, 0.3, -1.5), fins_only(FinRule::Faded));
    agree(&picked(&stage, &open, &behind), &fin_edges(&open), |edge| fin_opacity(edge, behind.camera.toward_eye(), 1.0));
}

#[test]
fn all_edges_with_area_stand_where_all_are_asked_for() {
    let stage = Stage::plain();
    let mut coat = random_edges(700);
    // No area: along the fur, without fur, without length.
    coat.surface.offsets[0] = Vec3::ZERO;
    coat.surface.offsets[1] = Vec3::ZERO;
    coat.edges.vertices[3] = [0, 1];
    coat.edges.vertices[5] = [7, 7];
    let along = coat.surface.positions[21] - coat.surface.positions[20];
    coat.surface.offsets[20] = 0.1 * along;
    coat.surface.offsets[21] = 0.1 * along;
    coat.edges.vertices[600] = [20, 21];
    let drawn = agree(&picked(&stage, &coat, &seen_from(EYES[0], fins_only(FinRule::All))), &fin_edges(&coat), |edge| {
        f32::from(u8::from(has_area(edge)))
    });
    // Vertices 0 and 1 are the ends of edge 0, too.
    let flat = |i: &usize| !has_area(&fin_edges(&coat)[*i]);
    assert_eq!((0..700).filter(flat).collect::<Vec<_>>(), [0, 3, 5, 600]);
    assert_eq!(drawn, 696);
}

#[test]
fn more_edges_than_groups_can_be_summed_at_once_stay_in_order() {
    let stage = Stage::plain();
    // 586 groups of 256, themselves summed in three goes.
    let many = random_edges(150_000);
    let edges = fin_edges(&many);
    for rule in [FinRule::Faded, FinRule::Silhouette { threshold: 0.05 }] {
        let view = seen_from(EYES[0], fins_only(rule));
        let fins = picked(&stage, &many, &view);
        let drawn = agree(&fins, &edges, |edge| match rule {
            FinRule::Faded => fin_opacity(edge, view.camera.toward_eye(), 1.0),
            _ => is_silhouette(edge, view.camera.eye, 0.05),
        });
        assert!(fins.len() > 40_000 && fins.len().abs_diff(drawn) < 20, "{} {drawn}", fins.len());
        assert!(fins.last().is_some_and(|last| last.0 > 149_900));
    }
}

#[test]
fn frames_repeat_bit_for_bit_and_come_back_after_the_camera_has_been_away() {
    let stage = Stage::plain();
    let uploaded = stage.upload(&ball());
    let [here, there] = [EYES[0], EYES[1]].map(|eye| seen_from(eye, Options::default()));
    let mut prepared = stage.prepare(&uploaded, &here);
    let first = stage.frame(&prepared);
    for _ in 0..3 {
        assert!(stage.frame(&prepared) == first);
    }
    for step in 1..=4 {
        let eye = EYES[0].lerp(EYES[1], step as f32 / 4.0);
        stage.update(&mut prepared, &seen_from(eye, Options::default()));
        assert!(stage.frame(&prepared) != first);
    }
    assert!(stage.frame(&prepared) == stage.frame(&stage.prepare(&uploaded, &there)));
    stage.update(&mut prepared, &here);
    assert!(stage.frame(&prepared) == first);
    assert_eq!(headless().take_errors(), Vec::<String>::new());
}

/// Fins as wide as this and as high as that, side by side in the plane z = 0, of a striped texture, seen squarely so that a unit is a hundred pixels.
fn standing(fins: &[(Vec3, Vec3)]) -> Coat {
    let mut surface = Surface::default();
    let mut edges = FinEdges::default();
    for (i, &(root, offset)) in (0..).zip(fins) {
        for end in [-0.15, 0.15] {
            surface.positions.push(root + end * Vec3::X);
            surface.offsets.push(offset);
        }
        edges.vertices.push([2 * i, 2 * i + 1]);
        edges.intervals.push([0.1 + 0.4 * i as f32, 0.9 + 0.4 * i as f32]);
        edges.face_normals.push([Vec3::Y, Vec3::Z]);
        edges.curvatures.push(1.0);
    }
    let count = surface.positions.len();
    surface.normals = vec![Vec3::Z; count];
    surface.directions = vec![Vec3::Y; count];
    surface.bends = vec![Vec3::ZERO; count];
    surface.ends = vec![1.0; count];
    surface.mixes = vec![0.0; count];
    surface.colours = vec![Vec3::ONE; count];
    let patches = PatchMesh {
        vertices: vec![0, 1, 1],
        coordinates: vec![Vec2::ZERO; 3],
        faces: vec![[0, 1, 2]],
        patch_ends: vec![1],
        opacities: Vec::new(),
    };
    Coat { surface, patches, edges, ..coat(&shapes::square(1, 1.0), Style::default(), &flat_hair(9, Vec3::ONE)) }
}

fn squarely(options: Options) -> View {
    let distance = 50.0;
    let camera =
        Camera { eye: distance * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 2.0 * (0.36_f32 / distance).atan(), near: 1.0 };
    View { options: Options { fin_rule: FinRule::All, ..options }, ..View::new(camera, light(Vec3::new(0.2, 0.3, 1.0))) }
}

/// The lowest and highest row that is more than half covered, and from where to where along a row so many pixels above the middle, all in hundredths.
fn extent(coat: &Coat, options: Options, above: i32) -> ((i32, i32), (i32, i32)) {
    let seen = picture(coat, &squarely(Options { surface: false, shells: false, ..options }));
    let (middle_x, middle_y) = (SIZE.0 as i32 / 2, SIZE.1 as i32 / 2);
    let full = |x: i32, y: i32| seen.coverage[(y * SIZE.0 as i32 + x) as usize] > 127;
    let rows: Vec<i32> = (0..SIZE.1 as i32).filter(|&y| (0..SIZE.0 as i32).any(|x| full(x, y))).map(|y| middle_y - y).collect();
    let row: Vec<i32> = (0..SIZE.0 as i32).filter(|&x| full(x, middle_y - above)).map(|x| x - middle_x).collect();
    let ends = |v: &[i32]| (v.iter().copied().min().unwrap_or(0), v.iter().copied().max().unwrap_or(0));
    (ends(&rows), ends(&row))
}

fn about(found: (i32, i32), low: i32, high: i32, what: &str) {
    assert!((found.0 - low).abs() <= 1 && (found.1 - high).abs() <= 1, "{what}: {found:?}, not {low} to {high}");
}

#[test]
fn fins_follow_comb_and_length() {
    let upright = standing(&[(Vec3::ZERO, 0.3 * Vec3::Y)]);
    let (rows, row) = extent(&upright, Options::default(), 20);
    about(rows, 1, 30, "upright, rows");
    about(row, -15, 14, "upright, across");
    let combed = standing(&[(Vec3::ZERO, Vec3::new(0.2, 0.3, 0.1))]);
    let (rows, row) = extent(&combed, Options::default(), 20);
    about(rows, 1, 30, "combed, rows");
    // Two thirds up: two thirds of 20 to the side.
    about(row, -15 + 13, 14 + 13, "combed, across");
    let (rows, row) = extent(&combed, Options { length_scale: 0.5, ..Options::default() }, 10);
    about(rows, 1, 15, "half as long, rows");
    about(row, -15 + 7, 14 + 7, "half as long, across");
}

#[test]
fn fins_end_where_hair_is_cut() {
    let mut cut = standing(&[(Vec3::ZERO, 0.3 * Vec3::Y)]);
    cut.surface.ends.fill(0.5);
    // Nine layers: it fades over an eighth, half of which is 2 pixels.
    about(extent(&cut, Options::default(), 5).0, 1, 17, "cut at a half");
    cut.surface.ends.fill(0.0);
    let seen = picture(&cut, &squarely(Options { surface: false, shells: false, ..Options::default() }));
    assert!(seen.coverage.iter().all(|&c| c == 0));
}

#[test]
fn fins_of_several_quads_bend_and_of_one_are_straight() {
    let straight = standing(&[(Vec3::ZERO, 0.3 * Vec3::Y)]);
    let mut bent = straight.clone();
    bent.surface.bends.fill(0.4 * Vec3::X);
    let bows = |fin_segments| extent(&bent, Options { fin_segments, ..Options::default() }, 15).1;
    // Half way up: b (h² − h) = −0.4 / 4.
    about(bows(8), -15 - 10, 14 - 10, "eight quads");
    about(bows(2), -15 - 10, 14 - 10, "two quads");
    about(bows(1), -15, 14, "one quad");
    // At the tip all meet.
    about(extent(&bent, Options { fin_segments: 8, ..Options::default() }, 29).1, -15 - 1, 14 - 1, "the tip");
    // More than there may be are as many as there may be.
    let coverage = |fin_segments| picture(&bent, &squarely(Options { fin_segments, ..Options::default() })).coverage;
    assert!(coverage(400) == coverage(16) && coverage(0) == coverage(1) && coverage(8) != coverage(16));
    let (one, many) = [1, 5]
        .map(|fin_segments| picture(&straight, &squarely(Options { surface: false, shells: false, fin_segments, ..Options::default() })))
        .into();
    assert!(difference(&one, &many).1 <= 1, "hair without a bend is the same however it is cut up");
    assert_eq!((one.frame.triangles, many.frame.triangles), (2, 10));
}

#[test]
fn fins_take_the_colour_of_the_skin_they_stand_on() {
    let mut coloured = standing(&[(Vec3::new(-0.2, 0.0, 0.0), 0.3 * Vec3::Y), (Vec3::new(0.2, 0.0, 0.0), 0.3 * Vec3::Y)]);
    coloured.surface.colours[..2].fill(Vec3::X);
    coloured.surface.colours[2..].fill(Vec3::Z);
    let seen = picture(&coloured, &squarely(Options { surface: false, shells: false, ..Options::default() }));
    let at = |x: u32| {
        let at = 4 * ((SIZE.1 / 2 - 15) * SIZE.0 + x) as usize;
        [seen.rgba[at], seen.rgba[at + 1], seen.rgba[at + 2]]
    };
    let (left, right) = (at(SIZE.0 / 2 - 20), at(SIZE.0 / 2 + 20));
    assert!(left[0] > 100 && left[1] == 0 && left[2] == 0, "{left:?}");
    assert!(right[2] > 100 && right[0] == 0 && right[1] == 0, "{right:?}");
}

/// Stripes of two brightnesses across.
fn stripes() -> Arc<FinTexture> {
    let texels = (0..64).flat_map(|i| encode([1.0, 1.0, 1.0, 1.0].map(|c| if i * 7 % 11 < 5 { c } else { 0.2 * c }))).collect();
    Arc::new(FinTexture { tiles_across: 1.0, mixtures: 1, mips: vec![MipImage { width: 64, height: 1, texels }] })
}

#[test]
fn a_fin_keeps_its_interval_of_the_texture_when_others_come_and_go() {
    let stage = Stage::plain();
    // The first is turned aside; the second faces the view.
    let mut pair = standing(&[(Vec3::new(-0.25, 0.0, 0.0), 0.3 * Vec3::Y), (Vec3::new(0.25, 0.0, 0.0), 0.3 * Vec3::Y)]);
    let root = Vec3::new(-0.25, 0.0, 0.0);
    pair.surface.positions[0] = root - 0.15 * Vec3::new(0.6, 0.0, -0.8);
    pair.surface.positions[1] = root + 0.15 * Vec3::new(0.6, 0.0, -0.8);
    pair.fin = Some(stripes());
    let uploaded = stage.upload(&pair);
    let mut view = squarely(Options { surface: false, shells: false, ..Options::default() });
    view.options.fin_rule = FinRule::Faded;
    // The picture's camera stays; only what the fins are faded by turns, and as much to one side as to the other.
    let frame = |aside: f32| {
        let mut viewpoint = stage.viewpoint(&view);
        viewpoint.toward_eye = Vec3::new(aside, 0.0, 1.0).normalize();
        let prepared = stage.prepare_from(&uploaded, &view, &viewpoint);
        let pixels = stage.frame(&prepared);
        let right: Vec<u8> = pixels.chunks_exact(4 * SIZE.0 as usize).flat_map(|row| row[2 * SIZE.0 as usize..].to_vec()).collect();
        (prepared.read_fins(&stage.device, &stage.queue).expect("fins").len(), right)
    };
    let (both, alone) = (frame(0.3), frame(-0.3));
    assert_eq!((both.0, alone.0), (2, 1));
    assert!(both.1 == alone.1, "the second fin shows the same");
    let levels: std::collections::BTreeSet<u8> = alone.1.chunks_exact(4).map(|pixel| pixel[3]).collect();
    assert!(levels.len() > 3, "there are stripes to tell apart: {levels:?}");
}
