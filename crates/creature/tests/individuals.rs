//! Seeds, threads and resolutions.

use std::error::Error;

use glam::DVec3;
use pelage_creature::{Creature, CreatureError, Part, Plan, Species, Stance};
use pelage_mesh::Summary;

fn positions(plan: &Plan, faces: u32) -> Result<Vec<DVec3>, CreatureError> {
    Ok(Creature::new(plan, faces)?.mesh().positions().to_vec())
}

#[test]
fn a_seed_is_an_individual() -> Result<(), Box<dyn Error>> {
    let plan = Species::Cat.plan();
    let [a, again, b] = [1, 1, 2].map(|seed| plan.individual(seed, 0.1));
    let (a, again, b) = (a?, again?, b?);
    assert_eq!(a, again);
    assert_ne!(a, b);
    assert_eq!(plan.individual(9, 0.0)?, plan);
    // No length further from the plan's than the variation, and all of them moved.
    let (mut of_plan, mut of_a) = (plan, a);
    for (mine, theirs) in of_a.proportions().iter().zip(of_plan.proportions()) {
        let is_angle = *mine.range.end() >= 10.0;
        let moved = if is_angle { (*mine.value - *theirs.value) / 40.0 } else { (*mine.value / theirs.value.max(1e-9)).max(1e-9).ln() };
        assert!(moved.abs() <= 0.1 + 1e-12 || *theirs.value == 0.0, "{} went from {} to {}", mine.name, theirs.value, mine.value);
        assert!(moved != 0.0 || *theirs.value == *mine.range.start() || *theirs.value == *mine.range.end(), "{} is the plan's", mine.name);
    }
    Ok(())
}

#[test]
fn the_same_bits_for_any_number_of_threads() -> Result<(), Box<dyn Error>> {
    let plan = Species::Fox.plan().individual(5, 0.1)?;
    let made = |threads| -> Result<Vec<[u64; 3]>, Box<dyn Error>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        Ok(pool.install(|| positions(&plan, 3_000))?.into_iter().map(|p| p.to_array().map(f64::to_bits)).collect())
    };
    let one = made(1)?;
    assert_eq!(one, made(2)?);
    assert_eq!(one, made(7)?);
    assert_eq!(one, made(8)?);
    Ok(())
}

/// Both ways, as vertices of the one lie on the surface that the other approximates.
#[test]
fn the_resolution_does_not_change_the_individual() -> Result<(), Box<dyn Error>> {
    for species in [Species::Rabbit, Species::Spider] {
        let plan = species.plan().individual(11, 0.1)?;
        let (coarse, fine) = (Creature::new(&plan, 1_000)?, Creature::new(&plan, 8_000)?);
        let mesh = coarse.mesh();
        let longest = mesh.edges().map(pelage_mesh::Edge::length).fold(0.0, f64::max);
        let nearest = |from: &[DVec3], to: &[DVec3]| {
            let one = |p: &DVec3| to.iter().map(|q| p.distance_squared(*q)).fold(f64::INFINITY, f64::min).sqrt();
            from.iter().map(one).fold(0.0, f64::max)
        };
        let (there, back) = (nearest(mesh.positions(), fine.mesh().positions()), nearest(fine.mesh().positions(), mesh.positions()));
        assert!(there.max(back) < longest, "{}: {there} and {back}, longest edge {longest}", species.name());
        // The same surface, to rounding, and not only one within an edge of it.
        let off = mesh.positions().iter().map(|&p| fine.field(p).abs() / fine.gradient(p).length()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{}: the coarse one is {off} off the fine one's surface", species.name());
        let (a, b) = (Summary::of(mesh), Summary::of(fine.mesh()));
        assert!((a.signed_volume / b.signed_volume - 1.0).abs() < 0.2, "{} {}", a.signed_volume, b.signed_volume);
    }
    Ok(())
}

#[test]
fn creatures_stand_on_their_feet() -> Result<(), Box<dyn Error>> {
    for species in Species::ALL {
        let plan = species.plan();
        let creature = Creature::new(&plan, 6_000)?;
        let mesh = creature.mesh();
        let (low, high) = mesh.bounds().unwrap_or_default();
        assert!(low.y.abs() < 0.02, "{}: lowest at {}", species.name(), low.y);
        assert!((-high.x - low.x).abs() < 0.02 || plan.tail.sway != 0.0, "{} leans", species.name());
        let paws = creature.weights(Part::Paws, 0.02)?;
        // Each foot is a quarter of the compass away from the others, or of a sprawling stance an eighth.
        let mut feet = std::collections::BTreeMap::new();
        for (p, _) in mesh.positions().iter().zip(paws).filter(|(p, weight)| *weight > 0.9 && p.y < 0.1) {
            let sector = match plan.stance {
                Stance::Upright => i32::from(p.z > 0.0),
                Stance::Sprawling => ((p.x.abs().atan2(p.z - 0.5).to_degrees() - 38.0) / 32.33).round() as i32,
            };
            let lowest = feet.entry((p.x > 0.0, sector)).or_insert(f64::INFINITY);
            *lowest = p.y.min(*lowest);
        }
        assert_eq!(feet.len() as u32, 2 * plan.leg_pairs, "{}: {feet:?}", species.name());
        assert!(feet.values().all(|y| y.abs() < 0.03), "{}: {feet:?}", species.name());
        let volume = Summary::of(mesh).signed_volume;
        let barrel = std::f64::consts::PI * plan.trunk.belly * plan.trunk.belly * plan.trunk.width;
        assert!(
            (1.0..5.0).contains(&(volume / barrel)) || plan.stance == Stance::Sprawling,
            "{}: {volume} beside {barrel}",
            species.name()
        );
    }
    Ok(())
}

#[test]
fn weights_add_up_to_one_and_are_where_the_part_is() -> Result<(), Box<dyn Error>> {
    const PARTS: [Part; 11] = [
        Part::Trunk,
        Part::Neck,
        Part::Head,
        Part::Muzzle,
        Part::Nose,
        Part::Eyes,
        Part::Ears,
        Part::Legs,
        Part::Paws,
        Part::Tail,
        Part::TailTip,
    ];
    let creature = Creature::new(&Species::Fox.plan(), 4_000)?;
    let weights = PARTS.map(|part| creature.weights(part, 0.01)).into_iter().collect::<Result<Vec<_>, _>>()?;
    for (vertex, p) in creature.mesh().positions().iter().enumerate() {
        let all: Vec<f64> = weights.iter().map(|weights| weights[vertex]).collect();
        assert!((all.iter().sum::<f64>() - 1.0).abs() < 1e-12 && all.iter().all(|weight| (0.0..=1.0).contains(weight)), "{all:?}");
        let at = |part: Part| all[PARTS.iter().position(|&other| other == part).unwrap_or_default()];
        assert!(at(Part::TailTip) < 0.5 || p.z < -1.0, "the tail's tip is behind: {p}");
        assert!(at(Part::Nose) < 0.5 || p.z > 1.0, "the nose is in front: {p}");
        assert!(at(Part::Paws) < 0.5 || p.y < 0.2, "paws are down: {p}");
    }
    assert!(weights.iter().all(|weights| weights.iter().any(|&weight| weight > 0.9)), "a part has no place of its own");
    assert!(matches!(creature.weights(Part::Nose, 0.0), Err(CreatureError::OutOfRange { name: "softness", .. })));
    Ok(())
}

#[test]
fn fur_lies_from_the_nose_to_the_tail_and_down_the_legs() -> Result<(), Box<dyn Error>> {
    let creature = Creature::new(&Species::Cat.plan(), 4_000)?;
    let weights = |part| creature.weights(part, 0.02);
    let (head, muzzle, tail) = (weights(Part::Head)?, weights(Part::Muzzle)?, weights(Part::Tail)?);
    let (trunk, paws, ears, legs) = (weights(Part::Trunk)?, weights(Part::Paws)?, weights(Part::Ears)?, weights(Part::Legs)?);
    for (vertex, way) in creature.lie().into_iter().enumerate() {
        assert!(way.length() <= 1.0 + 1e-12);
        let p = creature.mesh().positions()[vertex];
        assert!(trunk[vertex] < 1.0 || way.z < 0.0, "the back at {p}: {way}");
        assert!(paws[vertex] < 1.0 || way.z > 0.0 || way.y < 0.0, "a paw at {p}: {way}");
        assert!(ears[vertex] < 1.0 || way.y > 0.0, "an ear at {p}: {way}");
        assert!(legs[vertex] < 1.0 || way.y < 0.0, "a leg at {p}: {way}");
        assert!(head[vertex] < 1.0 || way.z < 0.0, "the head at {p}: {way}");
        assert!(muzzle[vertex] < 1.0 || way.z < 0.0, "the muzzle at {p}: {way}");
        // A cat's tail is up.
        assert!(tail[vertex] < 1.0 || way.y > 0.0 || way.z < 0.0, "the tail at {p}: {way}");
    }
    Ok(())
}
