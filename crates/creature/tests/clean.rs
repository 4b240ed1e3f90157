//! What is promised of a mesh, over all species, individuals and numbers of faces.

use std::error::Error;

use pelage_creature::{Creature, Species};
use pelage_mesh::{Face, Mesh, Summary};

/// The least angle of any face, in degrees.
const LEAST_ANGLE: f64 = 20.0;

/// The longest side of a face over its shortest.
const GREATEST_RATIO: f64 = 3.0;

fn individual(species: Species, seed: u64, faces: u32) -> Result<Creature, Box<dyn Error>> {
    let variation = if seed == 0 { 0.0 } else { 0.15 };
    Ok(Creature::new(&species.plan().individual(seed, variation)?, faces)?)
}

fn least_angle(face: Face<'_, Mesh>) -> f64 {
    face.angles().into_iter().fold(f64::INFINITY, f64::min).to_degrees()
}

fn sides_ratio(face: Face<'_, Mesh>) -> f64 {
    let sides = face.half_edges().map(pelage_mesh::HalfEdge::length);
    sides.into_iter().fold(0.0, f64::max) / sides.into_iter().fold(f64::INFINITY, f64::min)
}

fn expect_clean(creature: &Creature, faces: u32, what: &str) {
    let mesh = creature.mesh();
    let summary = Summary::of(mesh);
    assert_eq!(summary.faces, faces as usize, "{what}");
    assert_eq!((summary.components, summary.genus, summary.unreferenced_vertices), (1, 0, 0), "{what}");
    assert!(summary.is_closed() && summary.signed_volume > 0.0, "{what}: {summary:?}");
    assert_eq!(mesh.topology().check(), Ok(()), "{what}");
    let gradients: Vec<_> = mesh.positions().iter().map(|&p| creature.gradient(p)).collect();
    for face in mesh.faces() {
        let (angle, ratio) = (least_angle(face), sides_ratio(face));
        assert!(angle > LEAST_ANGLE && ratio < GREATEST_RATIO, "{what}: {:?} has an angle of {angle} and a ratio of {ratio}", face.id());
        let outwards: glam::DVec3 = face.vertices().map(|v| gradients[v.index()]).into_iter().sum();
        let agreement = face.normal().dot(outwards.normalize());
        assert!(agreement > 0.0, "{what}: {:?} at {} looks away: {agreement}", face.id(), face.centre());
    }
    let off = mesh.positions().iter().zip(&gradients).map(|(&p, gradient)| creature.field(p).abs() / gradient.length());
    assert!(off.fold(0.0, f64::max) < 1e-12, "{what}: a vertex is off the surface");
}

#[test]
fn every_species_is_closed_clean_and_of_the_faces_asked_for() -> Result<(), Box<dyn Error>> {
    for species in Species::ALL {
        // A spider has eight thin legs, and clefts between them.
        let fewest = if species == Species::Spider { 2_000 } else { 500 };
        for (seed, faces) in [(0, fewest), (1, fewest), (2, 3_000), (3, 5_000)] {
            expect_clean(&individual(species, seed, faces)?, faces, &format!("{} {seed} of {faces} faces", species.name()));
        }
    }
    Ok(())
}

#[test]
fn many_faces_are_as_clean() -> Result<(), Box<dyn Error>> {
    expect_clean(&individual(Species::Mouse, 4, 60_000)?, 60_000, "a mouse of 60,000 faces");
    Ok(())
}

/// Marching cubes made a knot in this one, vertices so close that collapses between them were refused: an angle of 0.04° was left.
#[test]
fn a_knot_of_the_raw_mesh_is_undone() -> Result<(), Box<dyn Error>> {
    expect_clean(&individual(Species::Spider, 1, 200_000)?, 200_000, "a spider of 200,000 faces");
    Ok(())
}

/// The two angles across an edge add up to at most π, so their cotangents to at least 0.
#[test]
fn every_edge_is_delaunay() -> Result<(), Box<dyn Error>> {
    for (species, faces) in [(Species::Cat, 3_000), (Species::Spider, 5_000), (Species::Bear, 20_000)] {
        let creature = individual(species, 1, faces)?;
        let cotangents = creature.mesh().edges().map(|edge| edge.half_edges().map(pelage_mesh::HalfEdge::opposite_cotangent).sum::<f64>());
        let wrong = cotangents.filter(|&sum| sum < -1e-6).count();
        assert_eq!(wrong, 0, "{} of {faces} faces", species.name());
    }
    Ok(())
}

#[test]
fn an_odd_number_of_faces_is_met_by_one_less() -> Result<(), Box<dyn Error>> {
    assert_eq!(individual(Species::Bear, 0, 2_001)?.mesh().topology().face_count(), 2_000);
    Ok(())
}

#[test]
fn the_field_never_grows_faster_than_the_distance() -> Result<(), Box<dyn Error>> {
    let creature = individual(Species::Dog, 1, 500)?;
    let (low, high) = creature.mesh().bounds().unwrap_or_default();
    let at = |k: u32| low + (high - low) * glam::DVec3::new(0.618, 0.755, 0.57) * f64::from(k) % (high - low);
    let places: Vec<_> = (1..4000).map(at).collect();
    for pair in places.windows(2) {
        let grown = (creature.field(pair[0]) - creature.field(pair[1])).abs();
        assert!(grown <= pair[0].distance(pair[1]) * (1.0 + 1e-12), "{} to {}", pair[0], pair[1]);
        assert!(creature.gradient(pair[0]).length() <= 1.0 + 1e-12);
    }
    Ok(())
}
