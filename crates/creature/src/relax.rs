//! Evener faces: vertices slide over the surface.

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Body;
use crate::skin::{Facet, Skin, Worst};

/// A place on the surface and its normal.
type Spot = (DVec3, DVec3);

/// Moves each vertex half way to the mean of its neighbours, along the tangent plane only, and back to the surface: the tangential smoothing of
/// Botsch and Kobbelt, "A remeshing approach to multiresolution modeling" (2004). A vertex stays where a face of it would turn over or become a sliver.
pub(crate) fn relax(skin: &mut Skin, body: &Body) {
    let vertices = (0..skin.vertex_count() as u32).into_par_iter();
    let moved: Vec<Spot> = vertices.clone().map(|vertex| relaxed(skin, body, vertex)).collect();
    let stays: Vec<bool> = vertices.map(|vertex| is_spoilt(skin, &moved, vertex)).collect();
    for (vertex, (position, normal)) in moved.into_iter().enumerate().filter(|&(vertex, _)| !stays[vertex]) {
        (skin.positions[vertex], skin.normals[vertex]) = (position, normal);
    }
}

fn relaxed(skin: &Skin, body: &Body, vertex: u32) -> Spot {
    let (here, normal) = (skin.positions[vertex as usize], skin.normals[vertex as usize]);
    let (sum, count) = skin.ring(vertex).fold((DVec3::ZERO, 0.0), |(sum, count), h| (sum + skin.at(skin.tip(h)), count + 1.0));
    if count == 0.0 {
        return (here, normal);
    }
    let step = 0.5 * (sum / count - here);
    let place = body.project(here + step - normal * normal.dot(step), step.length(), 2);
    (place, normal_at(body, place))
}

fn normal_at(body: &Body, place: DVec3) -> DVec3 {
    body.value_and_gradient(place).1.normalize_or_zero()
}

/// Whether the faces of the vertex would become bad and worse if all their corners moved, or if the vertex alone did.
fn is_spoilt(skin: &Skin, moved: &[Spot], vertex: u32) -> bool {
    let before = Worst::of(skin.facets(vertex));
    let all = skin.ring(vertex).map(|h| {
        let spots = skin.corners(h).map(|v| moved[v as usize]);
        Facet { corners: spots.map(|(place, _)| place), normals: spots.map(|(_, normal)| normal) }
    });
    let alone = skin.facets(vertex).map(|mut facet| {
        (facet.corners[0], facet.normals[0]) = moved[vertex as usize];
        facet
    });
    !(Worst::of(all).may_replace(before) && Worst::of(alone).may_replace(before))
}

/// Brings every vertex to the surface as exactly as Newton's method does.
pub(crate) fn settle(skin: &mut Skin, body: &Body, reach: f64) {
    let settled: Vec<Spot> = skin
        .positions
        .par_iter()
        .map(|&p| {
            let place = body.project(p, reach, 8);
            (place, normal_at(body, place))
        })
        .collect();
    (skin.positions, skin.normals) = settled.into_iter().unzip();
}
