//! The shaders compute what `pelage_lighting` and `fin_opacity` say.

mod support;

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Camera, Coat, FinEdges, Irradiance, Light, Lights, MipImage, PatchMesh, ShellTexture, Surface};
use pelage_lighting::{Axis, DirectionalLight, Facing, HairLighting, HairPoint, Illumination, SelfShadow, Shading, TableLayout};
use pelage_render::{LightingMode, Options, ShellRange, View, fin_edges, fin_opacity};

use support::samples::hair::encode;
use support::samples::{Dice, Style, coat, shapes};
use support::{SIZE, bytes, flat_hair, middle, picture, sampled};

const ALBEDO: Vec3 = Vec3::new(0.5, 0.25, 0.75);
const LENGTH: f32 = 0.06;

fn shading() -> Shading {
    Shading {
        hair: HairLighting {
            ambient: DVec3::new(0.5, 0.6, 0.7),
            diffuse: DVec3::new(0.8, 0.6, 0.4),
            specular: DVec3::new(0.3, 0.4, 0.2),
            diffuse_power: 1.5,
            specular_power: 8.0,
        },
        self_shadow: SelfShadow { density: 1.1, minimum: 0.1, grazing: 0.3 },
        facing: Facing { strength: 0.8, dark_below: -0.3, full_above: 0.8 },
    }
}

fn light(direction: Vec3) -> Lights {
    Lights {
        directional: vec![Light { direction: direction.normalize(), colour: Vec3::new(0.9, 0.8, 0.7) }],
        ambient: Irradiance::hemisphere(Vec3::new(0.3, 0.35, 0.4), Vec3::new(0.2, 0.15, 0.1)),
    }
}

fn illumination(lights: &Lights) -> Illumination {
    let lit = |light: &Light| DirectionalLight { direction: light.direction.as_dvec3(), colour: light.colour.as_dvec3() };
    let ambient = pelage_lighting::Irradiance(lights.ambient.0.map(Vec3::as_dvec3));
    Illumination { lights: lights.directional.iter().map(lit).collect(), ambient }
}

fn near(seen: [u8; 3], light: DVec3, what: &str) {
    let expected = bytes(light * ALBEDO.as_dvec3());
    assert!(seen.iter().zip(expected).all(|(&a, b)| a.abs_diff(b) <= 2), "{what}: {seen:?} is not {expected:?}");
}

/// A square in the plane z = 0 whose hair leans, all of one colour; the middle pixel is a vertex.
fn square() -> Coat {
    let style = Style { length: LENGTH, slant: 0.9, toward: Vec3::new(1.0, -0.5, 0.0) };
    let mut coat = coat(&shapes::square(8, 1.0), style, &flat_hair(5, Vec3::ONE));
    coat.surface.colours.fill(ALBEDO);
    coat
}

fn front(lighting: LightingMode, light: Lights, options: Options) -> View {
    // Half a pixel off the middle of an even picture is nothing at this distance.
    let camera = Camera { eye: Vec3::new(0.1, 0.2, 3.0), target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.3, near: 0.1 };
    View { camera, lights: light, shading: shading(), options: Options { lighting, ..options } }
}

const LIGHTS: [Vec3; 5] =
    [Vec3::new(0.0, 0.3, 1.0), Vec3::new(1.0, 0.0, 0.2), Vec3::new(-0.8, -0.5, 0.4), Vec3::new(0.3, 0.9, -0.1), Vec3::new(0.0, 0.2, -1.0)];

#[test]
fn shells_are_lit_as_the_formula_says() {
    for lighting in [LightingMode::PerVertex, LightingMode::Formula, LightingMode::Table(TableLayout::default())] {
        for direction in LIGHTS {
            for layer in [1, 2, 4] {
                let layers = ShellRange { first: layer, end: layer + 1, left_out: None };
                let view = front(lighting, light(direction), Options { surface: false, fins: false, layers, ..Options::default() });
                let coat = square();
                let (normal, height) = (DVec3::Z, f64::from(layer) / 4.0);
                let hair = HairPoint { direction: coat.surface.directions[40].as_dvec3().normalize(), normal, height };
                // Above the middle pixel the layer is at its own height over the square.
                let place = Vec3::new(0.0, 0.0, coat.surface.offsets[40].z * height as f32);
                let toward = (view.camera.eye - place).as_dvec3().normalize();
                let expected = view.shading.shade(&illumination(&view.lights), toward, &hair);
                near(middle(&picture(&coat, &view)), expected, &format!("{lighting:?}, light {direction}, layer {layer}"));
            }
        }
    }
}

#[test]
fn the_skin_under_fur_is_lit_at_full_depth_and_bare_skin_plainly() {
    for direction in LIGHTS {
        let view = front(LightingMode::Formula, light(direction), Options { shells: false, fins: false, ..Options::default() });
        let coat = square();
        let hair = HairPoint { direction: coat.surface.directions[40].as_dvec3().normalize(), normal: DVec3::Z, height: 0.0 };
        let expected = view.shading.shade(&illumination(&view.lights), view.camera.eye.as_dvec3().normalize(), &hair);
        near(middle(&picture(&coat, &view)), expected, &format!("under fur, light {direction}"));
        let bare = View { options: Options { length_scale: 0.0, ..view.options }, ..view.clone() };
        near(middle(&picture(&coat, &bare)), bare.shading.skin(&illumination(&bare.lights), DVec3::Z), &format!("bare, light {direction}"));
    }
}

/// Four lights round the square and light from all around that no hemisphere is.
fn many_lights() -> Lights {
    let light = |direction: Vec3, colour: Vec3| Light { direction: direction.normalize(), colour };
    let mut dice = Dice::new(41);
    let mut ambient = Irradiance::hemisphere(Vec3::new(0.3, 0.35, 0.4), Vec3::new(0.2, 0.15, 0.1));
    for term in &mut ambient.0[1..] {
        *term += 0.06 * (2.0 * Vec3::new(dice.roll(), dice.roll(), dice.roll()) - 1.0);
    }
    let directional = vec![
        light(Vec3::new(0.3, 0.5, 1.0), Vec3::new(0.5, 0.2, 0.1)),
        light(Vec3::new(-1.0, 0.2, 0.6), Vec3::new(0.1, 0.5, 0.2)),
        light(Vec3::new(0.4, -0.9, 0.1), Vec3::new(0.2, 0.1, 0.5)),
        light(Vec3::new(0.1, 0.3, -1.0), Vec3::new(0.3, 0.3, 0.3)),
    ];
    Lights { directional, ambient }
}

const MODES: [LightingMode; 4] = [
    LightingMode::PerPatch,
    LightingMode::PerVertex,
    LightingMode::Formula,
    LightingMode::Table(TableLayout { size: 64, u: Axis::Angle, v: Axis::Cosine }),
];

#[test]
fn several_lights_and_light_from_all_around_add_up() {
    let mut coat = square();
    // A normal along no axis, for all terms of the light from all around to count.
    let normal = Vec3::new(0.3, -0.4, 1.0).normalize();
    coat.surface.normals.fill(normal);
    for lighting in MODES {
        for lights in 0..=4 {
            let mut light = many_lights();
            light.directional.truncate(lights);
            for layer in [1, 3] {
                let layers = ShellRange { first: layer, end: layer + 1, left_out: None };
                let view = front(lighting, light.clone(), Options { surface: false, fins: false, layers, ..Options::default() });
                let height = f64::from(layer) / 4.0;
                let hair = HairPoint { direction: coat.surface.directions[40].as_dvec3(), normal: normal.as_dvec3(), height };
                let toward = (view.camera.eye - coat.surface.offsets[40] * height as f32).as_dvec3().normalize();
                let expected = view.shading.shade(&illumination(&view.lights), toward, &hair);
                near(middle(&picture(&coat, &view)), expected, &format!("{lighting:?}, {lights} lights, layer {layer}"));
            }
            let skin = front(lighting, light, Options { length_scale: 0.0, ..Options::default() });
            near(
                middle(&picture(&coat, &skin)),
                skin.shading.skin(&illumination(&skin.lights), normal.as_dvec3()),
                &format!("{lights} lights, skin"),
            );
        }
    }
}

#[test]
fn the_first_light_is_lit_at_pixels_and_the_others_at_vertices() {
    // One large face a side: at pixels, a highlight in its middle is seen; at vertices it is not. The light that makes it is the first or the second.
    let style = Style { length: LENGTH, slant: 0.3, toward: Vec3::X };
    let mut coat = coat(&shapes::square(1, 1.0), style, &flat_hair(3, Vec3::ONE));
    coat.surface.colours.fill(Vec3::ONE);
    for (direction, turn) in coat.surface.directions.iter_mut().zip([-0.8, 0.8, -0.8, 0.8]) {
        *direction = Vec3::new(0.2, turn, 0.5).normalize();
    }
    let layers = ShellRange { first: 2, end: 3, left_out: None };
    let (bright, dark) = (Vec3::splat(0.4), Vec3::ZERO);
    let toward = Vec3::new(0.0, 0.6, 1.0).normalize();
    let at = |lighting, colours: [Vec3; 2]| {
        let directional = colours.map(|colour| Light { direction: toward, colour }).to_vec();
        let lights = Lights { directional, ambient: Irradiance::default() };
        middle(&picture(&coat, &front(lighting, lights, Options { surface: false, fins: false, layers, ..Options::default() })))
    };
    let vertex = at(LightingMode::PerVertex, [bright, dark]);
    let pixel = at(LightingMode::Formula, [bright, dark]);
    assert!(vertex.iter().zip(pixel).any(|(&a, b)| a.abs_diff(b) > 5), "{vertex:?} {pixel:?}");
    let second = at(LightingMode::Formula, [dark, bright]);
    assert!(second.iter().zip(vertex).all(|(&a, b)| a.abs_diff(b) <= 1), "{second:?} {vertex:?}");
}

#[test]
fn a_patch_is_lit_as_its_middle_is() {
    // A ball of six patches, each of its own vertices; no other layer, no blending, so that a pixel is of one patch.
    let style = Style { length: 0.02, slant: 0.4, toward: Vec3::new(0.3, -1.0, 0.2) };
    let mut coat = coat(&shapes::sphere(8, 3.0), style, &flat_hair(3, Vec3::ONE));
    coat.surface.colours.fill(ALBEDO);
    let layers = ShellRange { first: 2, end: 3, left_out: None };
    let options = Options { surface: false, fins: false, layers, ..Options::default() };
    let camera = Camera { eye: Vec3::new(1.1, 0.9, 1.3), target: Vec3::ZERO, up: Vec3::Y, field_of_view: 0.34, near: 0.1 };
    let view = View { camera, lights: many_lights(), shading: shading(), options: Options { lighting: LightingMode::PerPatch, ..options } };
    let seen = sampled(&coat, &view, 1);
    let whole = seen.rgba.chunks_exact(4).zip(&seen.coverage).filter(|(_, covered)| **covered == 255);
    let mut colours: Vec<([u8; 3], usize)> = Vec::new();
    for (pixel, _) in whole {
        match colours.iter_mut().find(|(colour, _)| colour.iter().zip(pixel).all(|(&a, &b)| a.abs_diff(b) <= 1)) {
            Some((_, count)) => *count += 1,
            None => colours.push(([pixel[0], pixel[1], pixel[2]], 1)),
        }
    }
    // Three sides are seen, and a little of those behind the outline.
    assert!(colours.len() <= 6 && colours.iter().filter(|(_, count)| *count > 100).count() == 3, "{colours:?}");
    for out in [Vec3::X, Vec3::Y, Vec3::Z] {
        let nearest = |&a: &usize, &b: &usize| coat.surface.normals[a].dot(out).total_cmp(&coat.surface.normals[b].dot(out));
        let vertex = (0..coat.surface.normals.len()).max_by(nearest).unwrap_or(0);
        let hair = HairPoint { direction: coat.surface.directions[vertex].as_dvec3(), normal: out.as_dvec3(), height: 1.0 };
        let toward = (camera.eye - coat.surface.positions[vertex] - coat.surface.offsets[vertex]).as_dvec3().normalize();
        let expected = bytes(view.shading.shade(&illumination(&view.lights), toward, &hair) * ALBEDO.as_dvec3());
        let found = colours.iter().find(|(colour, _)| colour.iter().zip(expected).all(|(&a, b)| a.abs_diff(b) <= 2));
        assert!(found.is_some_and(|(_, count)| *count > 100), "{out}: {expected:?} is not among {colours:?}");
    }
    // At vertices there are many.
    let vertices = sampled(&coat, &View { options: Options { lighting: LightingMode::PerVertex, ..options }, ..view }, 1);
    let distinct: std::collections::BTreeSet<&[u8]> = vertices.rgba.chunks_exact(4).collect();
    assert!(distinct.len() > 100);
}

/// A coat whose direction map says the same everywhere: red along *s*, green along *t*, blue along *c_v*, each a byte.
fn mapped(coat: &Coat, direction: Vec3) -> Coat {
    let byte = |x: f32| (127.5 * (1.0 + x)).round() as u8;
    let texel = [byte(direction.x), byte(direction.y), byte(direction.z), 0];
    let map = MipImage { width: 1, height: 1, texels: texel.repeat(coat.shells.images as usize) };
    Coat { shells: Arc::new(ShellTexture { directions: Some(vec![map]), ..(*coat.shells).clone() }), ..coat.clone() }
}

#[test]
fn a_direction_map_is_read_along_the_tiles_axes_and_the_hair() {
    let (layers, plain) = (ShellRange { first: 3, end: 4, left_out: None }, Options { surface: false, fins: false, ..Options::default() });
    let options = Options { layers, ..plain };
    for turned in [false, true] {
        let mut coat = square();
        // The tile as it is laid, or a quarter turn on: s along y, t along −x.
        if turned {
            coat.patches.coordinates.iter_mut().for_each(|c| *c = glam::Vec2::new(c.y, -c.x));
        }
        let (s, t) = if turned { (Vec3::Y, -Vec3::X) } else { (Vec3::X, Vec3::Y) };
        let along = coat.surface.offsets[0].normalize();
        for direction in [Vec3::new(0.5, 0.1, 0.5), Vec3::new(-0.2, 0.6, 0.3), Vec3::new(0.0, 0.0, 0.9), Vec3::new(0.7, 0.0, 0.1)] {
            for toward in [Vec3::new(0.3, 0.5, 1.0), Vec3::new(-0.8, 0.3, 0.4)] {
                // Laid along a hair that leans, it is as long as the map says.
                let hair = (s * direction.x + t * direction.y + along * direction.z).normalize() * direction.length();
                let view = front(LightingMode::Formula, light(toward), options);
                let point = HairPoint { direction: hair.as_dvec3(), normal: DVec3::Z, height: 0.75 };
                let toward_eye = (view.camera.eye - 0.75 * coat.surface.offsets[40]).as_dvec3().normalize();
                let expected = bytes(view.shading.shade(&illumination(&view.lights), toward_eye, &point) * ALBEDO.as_dvec3());
                for lighting in [LightingMode::Formula, LightingMode::Table(TableLayout::default())] {
                    let view = View { options: Options { lighting, ..options }, ..view.clone() };
                    let seen = middle(&picture(&mapped(&coat, direction), &view));
                    let fits = seen.iter().zip(expected).all(|(&a, b)| a.abs_diff(b) <= 3);
                    assert!(fits, "turned {turned}, {direction}, light {toward}: {seen:?}, not {expected:?}");
                }
                // Switched off, the vertices' own direction is taken; at vertices, always.
                let own = picture(&coat, &view);
                let off = View { options: Options { direction_map: false, ..options }, ..view.clone() };
                assert!(
                    picture(
                        &mapped(&coat, direction),
                        &View { options: Options { lighting: LightingMode::Formula, ..off.options }, ..off }
                    )
                    .rgba
                        == own.rgba
                );
                let vertex = View { options: Options { lighting: LightingMode::PerVertex, ..options }, ..view };
                assert!(picture(&mapped(&coat, direction), &vertex).rgba == picture(&coat, &vertex).rgba);
            }
        }
    }
}

#[test]
fn bare_skin_is_of_the_mean_colour() {
    let mut coat = square();
    // Levels that differ, to tell which is looked at: the last is taken for the mean.
    let (dark, mean) = ([0, 0, 0, 255], encode([0.5, 0.5, 0.5, 1.0]));
    let mips = [(2, dark.repeat(4)), (1, mean.to_vec())];
    let mips = mips.into_iter().map(|(side, texels)| MipImage { width: side, height: side, texels }).collect();
    coat.shells = Arc::new(ShellTexture::stack(1, mips));
    let view = front(LightingMode::Formula, light(Vec3::Z), Options { length_scale: 0.0, ..Options::default() });
    near(middle(&picture(&coat, &view)), 0.5 * view.shading.skin(&illumination(&view.lights), DVec3::Z), "bare");
}

#[test]
fn fins_are_lit_as_the_formula_says() {
    // One wide fin across the view, so that its middle is the picture's.
    let mut coat = square();
    let direction = Vec3::new(0.1, 1.0, 0.2).normalize();
    let normal = Vec3::new(0.0, 0.8, 0.6);
    coat.patches = PatchMesh::default();
    coat.surface = Surface {
        positions: vec![Vec3::new(-0.5, -0.3, 0.0), Vec3::new(0.5, -0.3, 0.0)],
        normals: vec![normal; 2],
        offsets: vec![0.6 * Vec3::Y; 2],
        bends: vec![Vec3::ZERO; 2],
        ends: vec![1.0; 2],
        mixes: vec![0.0; 2],
        directions: vec![direction; 2],
        colours: vec![ALBEDO; 2],
    };
    coat.edges =
        FinEdges { vertices: vec![[0, 1]], intervals: vec![[0.0, 1.0]], face_normals: vec![[Vec3::Z, Vec3::Y]], curvatures: vec![1.0] };
    // Fins hang on shells' faces; this one has a bare face's vertices for company.
    coat.patches.vertices = vec![0, 1, 1];
    coat.patches.coordinates = vec![glam::Vec2::ZERO; 3];
    coat.patches.faces = vec![[0, 1, 2]];
    coat.patches.patch_ends = vec![1];
    for light in LIGHTS.map(light).into_iter().chain([many_lights()]) {
        let toward_light = light.directional[0].direction;
        let mut view = front(LightingMode::Formula, light, Options { surface: false, shells: false, ..Options::default() });
        view.camera.eye = 3.0 * Vec3::Z;
        let seen = picture(&coat, &view);
        assert_eq!(seen.frame.fins_drawn, 1);
        let hair = HairPoint { direction: direction.as_dvec3(), normal: normal.as_dvec3(), height: 0.5 };
        // The highlight is interpolated from the ends of the diagonal that cuts the fin in two.
        let corner = |x: f64, y: f64| {
            let toward = (DVec3::new(0.0, 0.0, 3.0) - DVec3::new(x, y, 0.0)).normalize();
            view.shading.shade(&illumination(&view.lights), toward, &hair)
        };
        let expected = 0.5 * (corner(0.5, -0.3) + corner(-0.5, 0.3));
        near(middle(&seen), expected, &format!("fin, light {toward_light}"));
    }
}

#[test]
fn fins_are_faded_and_left_out_as_the_processor_says() {
    const COLUMNS: u32 = 8;
    const ROWS: u32 = 6;
    // A fin of random pose in each cell of a grid, of 12 pixels a side, seen from very far.
    let cell = SIZE.0 / COLUMNS;
    let mut coat = square();
    coat.shells = flat_hair(2, Vec3::ONE).shells;
    coat.surface = Surface::default();
    coat.edges = FinEdges::default();
    let mut dice = Dice::new(5);
    let mut unit = || (2.0 * Vec3::new(dice.roll(), dice.roll(), dice.roll()) - 1.0).normalize();
    for i in 0..COLUMNS * ROWS {
        let centre = Vec3::new((i % COLUMNS) as f32 + 0.5 - 4.0, 3.0 - (i / COLUMNS) as f32 - 0.5, 0.0) * 0.1;
        // Rather upright to the view, or hardly any would be drawn.
        let [along, offset] = [(); 2].map(|()| 0.05 * (unit() * Vec3::new(1.0, 1.0, 0.4)).normalize());
        // As wide as it can be in its cell.
        let offset = (offset - 0.6 * along * along.dot(offset) / along.length_squared()).normalize() * 0.05;
        for end in [-0.5, 0.5] {
            coat.surface.positions.push(centre - 0.5 * offset + end * along);
            coat.surface.normals.push(Vec3::Z);
            coat.surface.offsets.push(offset);
            coat.surface.bends.push(Vec3::ZERO);
            coat.surface.ends.push(1.0);
            coat.surface.mixes.push(0.0);
            coat.surface.directions.push(Vec3::Z);
            coat.surface.colours.push(Vec3::ONE);
        }
        coat.edges.vertices.push([2 * i, 2 * i + 1]);
        coat.edges.intervals.push([0.0, 0.5]);
        // In every other cell both faces look away, by more or less than the fur is long.
        let away = Vec3::new(0.8, 0.0, -0.6 * (i % 16) as f32 / 16.0).normalize();
        coat.edges.face_normals.push(if i % 2 == 0 { [away; 2] } else { [unit(), unit()] });
        coat.edges.curvatures.push(7.0);
    }
    coat.patches = PatchMesh {
        vertices: vec![0, 1, 2],
        coordinates: vec![glam::Vec2::ZERO; 3],
        faces: vec![[0, 1, 2]],
        patch_ends: vec![1],
        opacities: Vec::new(),
    };
    let distance = 100.0;
    let field_of_view = 2.0 * (0.3_f32 / distance).atan();
    let camera = Camera { eye: distance * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view, near: 1.0 };
    let options = Options { surface: false, shells: false, ..Options::default() };
    let seen = picture(&coat, &View { camera, lights: light(Vec3::Z), shading: shading(), options });
    let (mut drawn, mut left_out, mut beyond) = (0, 0, 0);
    for (i, edge) in fin_edges(&coat).iter().enumerate() {
        let (column, row) = (i as u32 % COLUMNS, i as u32 / COLUMNS);
        let pixels = (0..cell * cell).map(|p| (row * cell + p / cell) * SIZE.0 + column * cell + p % cell);
        let most = pixels.map(|p| seen.coverage[p as usize]).max().unwrap_or(0);
        let opacity = fin_opacity(edge, Vec3::Z, 1.0);
        beyond += u32::from(opacity > 0.0 && edge.face_normals.iter().all(|n| n.z < 0.0));
        (drawn, left_out) = if opacity > 0.0 { (drawn + 1, left_out) } else { (drawn, left_out + 1) };
        // Of a sliver no pixel may be whole: there it must only be less.
        let along = edge.ends[1] - edge.ends[0];
        if along.cross(edge.offset).z.abs() < 1e-3 && opacity > 0.0 {
            assert!(f32::from(most) <= 255.0 * opacity + 2.0, "fin {i}: {most} of 255 seen, opacity {opacity}");
            continue;
        }
        assert!((f32::from(most) - 255.0 * opacity).abs() <= 2.0, "fin {i}: {most} of 255 seen, opacity {opacity}");
    }
    assert!(drawn > 8 && left_out > 8 && beyond > 3, "{drawn} {left_out} {beyond}");
    assert_eq!(seen.frame.fins_drawn, drawn);
}
