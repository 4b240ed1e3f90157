//! The bounds of the golden pictures are right when they fail under each of six seeded defects.
//!
//! "T flipped" is the hair direction mirrored in the tangent plane, hair lying the wrong way: exact −T is no defect, since the lighting formula is even in T, and a
//! test says so.
#![allow(clippy::print_stdout, reason = "the distance of each defect, to choose bounds by")]

use glam::{Vec2, Vec3};
use pelage_coat::{Background, Coat};
use pelage_nodes::Picture;
use pelage_render::{Offscreen, ShellRange, View};
use pelage_tests::{Bounds, Error, Golden, Scene, gpu};

const GRAPH: &str = "bunny";

/// What the graph's last node is given: the coat and the view, to be spoilt.
fn parts() -> Result<(Scene, Coat, View, Background), Error> {
    let scene = Scene::evaluate(GRAPH, &[])?;
    let coat = scene.coat()?.as_ref().clone();
    let (view, background) = scene.view(&coat)?;
    Ok((scene, coat, view, background))
}

fn draw(coat: &Coat, view: &View, background: &Background, size: (u32, u32)) -> Result<Picture, Error> {
    let offscreen = Offscreen::new(gpu()?.headless(), size, 1)?;
    Ok(offscreen.render(&offscreen.upload(coat)?, view, background)?)
}

/// Draws the graph with a defect and says whether the golden noticed.
fn noticed(name: &str, spoil: impl FnOnce(&mut Coat, &mut View)) -> Result<(), Error> {
    let (scene, mut coat, mut view, background) = parts()?;
    let size = {
        let picture = scene.picture()?;
        (picture.width, picture.height)
    };
    spoil(&mut coat, &mut view);
    let comparison = Golden::read(GRAPH)?.compare(&draw(&coat, &view, &background, size)?)?;
    println!("{name}: FLIP mean {:.5}, 99th percentile {:.5}", comparison.mean, comparison.p99);
    if comparison.within(Bounds::KEPT) {
        Err(format!("{name}: {comparison:?} is within {:?}: the bound is too wide", Bounds::KEPT).into())
    } else {
        Ok(())
    }
}

#[test]
fn without_a_defect_the_picture_is_the_graphs_own() -> Result<(), Error> {
    let (scene, coat, view, background) = parts()?;
    let picture = scene.picture()?;
    let drawn = draw(&coat, &view, &background, (picture.width, picture.height))?;
    assert!(drawn.rgba == picture.rgba, "the parts do not make the graph's picture");
    Ok(())
}

#[test]
fn no_fins() -> Result<(), Error> {
    noticed("no fins", |_, view| view.options.fins = false)
}

#[test]
fn one_shell_left_out() -> Result<(), Error> {
    noticed("one shell left out", |_, view| view.options.layers = ShellRange { left_out: Some(9), ..view.options.layers })
}

#[test]
fn hair_direction_mirrored() -> Result<(), Error> {
    noticed("T flipped", |coat, _| {
        for (direction, normal) in coat.surface.directions.iter_mut().zip(&coat.surface.normals) {
            *direction = 2.0 * direction.dot(*normal) * *normal - *direction;
        }
    })
}

#[test]
fn lighting_off() -> Result<(), Error> {
    noticed("lighting off", |_, view| {
        view.shading.hair.diffuse = glam::DVec3::ZERO;
        view.shading.hair.specular = glam::DVec3::ZERO;
    })
}

#[test]
fn patch_coordinates_offset() -> Result<(), Error> {
    noticed("patch coordinates offset", |coat, _| coat.patches.coordinates.iter_mut().for_each(|c| *c += Vec2::new(0.37, 0.21)))
}

#[test]
fn a_tenth_too_long() -> Result<(), Error> {
    noticed("length × 1.1", |coat, _| coat.surface.offsets.iter_mut().for_each(|offset| *offset *= 1.1))
}

#[test]
fn the_formula_is_even_so_exact_minus_t_is_no_defect() -> Result<(), Error> {
    let (scene, mut coat, view, background) = parts()?;
    let picture = scene.picture()?;
    coat.surface.directions.iter_mut().for_each(|direction: &mut Vec3| *direction = -*direction);
    let drawn = draw(&coat, &view, &background, (picture.width, picture.height))?;
    let worst = drawn.rgba.iter().zip(&picture.rgba).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(worst <= Some(1), "−T changed a pixel by {worst:?}");
    Ok(())
}
