//! Legs, upright and sprawling.

use glam::DVec3;

use crate::Part;
use crate::anatomy::Anatomy;
use crate::cone::Cone;

/// Degrees from ahead at which the first and the last of sprawling legs stand.
const FAN: (f64, f64) = (38.0, 135.0);

/// Legs under the body. Fore legs bend their elbows back; the last pair bends its knees forward and its hocks back.
pub(crate) fn add_upright(anatomy: &mut Anatomy) {
    let pairs = anatomy.plan.leg_pairs;
    for pair in 0..pairs {
        let place = if pairs == 1 { 0.5 } else { f64::from(pair) / f64::from(pairs - 1) };
        let spacing = 1.0 / f64::from(pairs.max(2) - 1);
        for side in [1.0, -1.0] {
            add_leg(anatomy, place, pair + 1 == pairs, spacing, side);
        }
    }
}

fn add_leg(anatomy: &mut Anatomy, place: f64, hind: bool, spacing: f64, side: f64) {
    let (legs, trunk) = (anatomy.plan.legs, anatomy.plan.trunk);
    let along = |chest: f64, belly: f64, rump: f64| {
        if place <= 0.5 { chest + 2.0 * place * (belly - chest) } else { belly + (2.0 * place - 1.0) * (rump - belly) }
    };
    let height = along(anatomy.chest.y, anatomy.belly.y, anatomy.rump.y);
    let girth = trunk.width * along(trunk.chest, trunk.belly, trunk.rump);
    let z = 0.5 - place;
    // Of a short leg most is hidden in the trunk: a bend would come out of it and go in again.
    let clear = along(legs.fore, 0.5 * (legs.fore + legs.hind), legs.hind);
    let bend = legs.bend * spacing * (2.0 * clear / height).min(1.0);
    let thigh = legs.thigh * if hind { 1.25 } else { 1.0 };
    let foot_x = 0.5 * legs.gap + legs.paw.max(legs.ankle);
    let joint = DVec3::new(side * (0.9 * girth - 0.7 * thigh).max(0.2 * girth).min(foot_x.max(0.5 * girth)), height - 0.1 * girth, z);
    let at = |up: f64, forward: f64, out: f64| {
        DVec3::new(joint.x + (side * foot_x - joint.x) * out, legs.paw + (joint.y - legs.paw) * up, z + forward * bend)
    };
    let (knee, hock) = if hind { (at(0.5, 0.8, 0.5), at(0.24, -0.8, 0.9)) } else { (at(0.52, -0.55, 0.6), at(0.18, 0.05, 1.0)) };
    let foot = DVec3::new(side * foot_x, legs.paw, z + if hind { -0.3 } else { 0.1 } * bend);
    let knee_radius = 0.42 * thigh + 0.58 * legs.ankle.min(thigh);
    let down = DVec3::NEG_Y;
    anatomy.add(Part::Legs, Cone::new((joint, thigh), (knee, knee_radius), down), 0.7 * thigh);
    anatomy.add(Part::Legs, Cone::new((knee, knee_radius), (hock, legs.ankle), down), 0.8 * knee_radius);
    anatomy.add(Part::Legs, Cone::new((hock, legs.ankle), (foot, legs.ankle.min(legs.paw)), down), 0.8 * legs.ankle);
    let heel = (foot, legs.paw);
    let toe = (foot + DVec3::Z * (legs.toes * legs.paw), legs.paw);
    anatomy.add(Part::Paws, Cone::new(heel, toe, DVec3::Z), 0.8 * legs.paw.min(legs.ankle));
}

/// Legs in a fan around the chest, with knees above it.
pub(crate) fn add_sprawling(anatomy: &mut Anatomy) {
    let pairs = anatomy.plan.leg_pairs;
    for pair in 0..pairs {
        let place = if pairs == 1 { 0.5 } else { f64::from(pair) / f64::from(pairs - 1) };
        let (sine, cosine) = libm::sincos((FAN.0 + place * (FAN.1 - FAN.0)).to_radians());
        for side in [1.0, -1.0] {
            add_sprawling_leg(anatomy, DVec3::new(side * sine, 0.0, cosine));
        }
    }
}

fn add_sprawling_leg(anatomy: &mut Anatomy, out: DVec3) {
    let (legs, trunk, chest) = (anatomy.plan.legs, anatomy.plan.trunk, anatomy.chest);
    let at = |reach: f64, height: f64| (chest + out * (reach * legs.reach)).with_y(height);
    let foot_radius = 0.7 * legs.ankle;
    let hip = chest + out * (0.6 * trunk.width * trunk.chest);
    let knee = at(0.45, chest.y + legs.bend * legs.reach);
    let ankle = at(0.82, (0.45 * chest.y).max(legs.ankle + 0.02));
    let foot = at(1.0, foot_radius);
    let thigh = legs.thigh.max(legs.ankle);
    let middle = 0.5 * (thigh + legs.ankle);
    anatomy.add(Part::Legs, Cone::new((hip, 0.8 * thigh), (knee, middle), out), 0.8 * thigh);
    anatomy.add(Part::Legs, Cone::new((knee, middle), (ankle, legs.ankle), out), 0.8 * legs.ankle);
    anatomy.add(Part::Paws, Cone::new((ankle, legs.ankle), (foot, foot_radius), out), 0.8 * legs.ankle);
}
