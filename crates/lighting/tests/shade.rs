//! Self-shadow, facing and the whole formula.

use glam::DVec3;
use pelage_lighting::{DIFFUSIVITY, DirectionalLight, Facing, HairPoint, Illumination, Irradiance, SelfShadow, Shading, half_vector};
use proptest::prelude::*;

const SKY: DVec3 = DVec3::new(0.3, 0.4, 0.5);
const GROUND: DVec3 = DVec3::new(0.2, 0.1, 0.1);
const SUN: DirectionalLight = DirectionalLight { direction: DVec3::new(0.6, 0.8, 0.0), colour: DVec3::new(1.0, 0.9, 0.8) };

fn sun() -> Illumination {
    Illumination { lights: vec![SUN], ambient: Irradiance::hemisphere(SKY, GROUND) }
}

fn unit(x: f64, y: f64) -> DVec3 {
    DVec3::new(x.cos() * y.cos(), x.sin() * y.cos(), y.sin())
}

#[test]
fn the_curve_is_the_stated_one() {
    let shadow = SelfShadow { density: 2.0, minimum: 0.1, grazing: 0.25 };
    assert_eq!(shadow.transmittance(0.0, 0.5), 1.0);
    assert!((shadow.transmittance(0.5, 0.8) - (0.1 + 0.9 * (-1.25_f64).exp())).abs() < 1e-15);
    assert!((shadow.transmittance(1.0, 0.1) - (0.1 + 0.9 * (-8.0_f64).exp())).abs() < 1e-15, "ε bounds the slant");
    assert!((shadow.sky_transmittance(0.6) - (0.1 + 0.9 * (-2.0_f64).exp())).abs() < 1e-15);
}

#[test]
fn the_sky_path_follows_the_exponential_integral() {
    // 2 E₃(τ) = 2 ∫₀¹ μ exp(−τ/μ) dμ, by the midpoint rule.
    for tau in [0.1, 0.5, 1.0, 2.0, 4.0] {
        let n = 200_000;
        let exact: f64 =
            (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n)).map(|mu| 2.0 * mu * (-tau / mu).exp()).sum::<f64>() / f64::from(n);
        assert!(((-DIFFUSIVITY * tau).exp() - exact).abs() < 0.035, "τ = {tau}: {exact}");
    }
}

#[test]
fn extremes_of_the_parameters_stay_in_range() {
    for density in [-1.0, 0.0, 1e30] {
        for minimum in [-1.0, 0.0, 2.0] {
            for grazing in [-1.0, 0.0, 5.0] {
                let shadow = SelfShadow { density, minimum, grazing };
                for (depth, n_dot_l) in [(0.0, 0.0), (1.0, -1.0), (5.0, 1.0), (-2.0, 0.0)] {
                    assert!((0.0..=1.0).contains(&shadow.transmittance(depth, n_dot_l)));
                    assert!((0.0..=1.0).contains(&shadow.sky_transmittance(depth)));
                }
            }
        }
    }
    assert_eq!(Facing { strength: 1.0, dark_below: 0.2, full_above: 0.2 }.factor(0.1), 0.0);
    assert_eq!(Facing { strength: 1.0, dark_below: 0.2, full_above: 0.2 }.factor(0.3), 1.0);
}

#[test]
fn facing_is_goldmans() {
    let facing = Facing { strength: 0.5, dark_below: -0.5, full_above: 0.5 };
    assert_eq!(facing.factor(-0.5), 0.5);
    assert_eq!(facing.factor(0.0), 0.75);
    assert_eq!(facing.factor(0.5), 1.0);
    assert_eq!(Facing { strength: 0.0, ..facing }.factor(-1.0), 1.0);
}

#[test]
fn the_side_away_is_darker() {
    let shading = Shading::default();
    let view = DVec3::Z;
    let point = |normal| HairPoint { direction: DVec3::Z, normal, height: 1.0 };
    let flat = Illumination { ambient: Irradiance::hemisphere(DVec3::splat(0.3), DVec3::splat(0.3)), ..sun() };
    let lit = shading.shade(&flat, view, &point(SUN.direction));
    let away = shading.shade(&flat, view, &point(-SUN.direction));
    assert!(lit.cmpgt(2.0 * away).all(), "{lit} {away}");
}

#[test]
fn shadow_and_facing_leave_the_ambient_alone() {
    let mut shading = Shading::default();
    shading.self_shadow.density = 0.0;
    let dark = Illumination { lights: vec![DirectionalLight { colour: DVec3::ZERO, ..SUN }], ..sun() };
    let point = HairPoint { direction: DVec3::X, normal: -SUN.direction, height: 0.0 };
    assert_eq!(shading.shade(&dark, DVec3::Z, &point), shading.hair.ambient * dark.ambient.at(point.normal));
}

#[test]
fn without_shadow_and_facing_it_is_the_papers_formula() {
    let shading = Shading {
        self_shadow: SelfShadow { density: 0.0, ..SelfShadow::default() },
        facing: Facing { strength: 0.0, ..Facing::default() },
        ..Shading::default()
    };
    let light = DirectionalLight { colour: DVec3::ONE, ..SUN };
    let white = Illumination { lights: vec![light], ambient: Irradiance::hemisphere(DVec3::ONE, DVec3::ONE) };
    let (view, t) = (DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.48, 0.6, 0.64));
    let half = (view + light.direction).normalize();
    let expected = shading.hair.evaluate(t.dot(light.direction), t.dot(half));
    let shade = shading.shade(&white, view, &HairPoint { direction: t, normal: DVec3::Y, height: 0.3 });
    assert!((shade - expected).abs().max_element() < 1e-15);
}

#[test]
fn skin_is_a_plain_diffuse() {
    let (shading, sun) = (Shading::default(), sun());
    let expected = shading.hair.ambient * SKY + shading.hair.diffuse * SUN.colour * 0.8;
    assert!((shading.skin(&sun, DVec3::Y) - expected).abs().max_element() < 1e-15);
    assert!((shading.skin(&sun, -DVec3::Y) - shading.hair.ambient * GROUND).abs().max_element() < 1e-15);
}

/// The formula for one light over a sky and a ground, written out.
fn one_light(shading: &Shading, light: &DirectionalLight, view: DVec3, hair: &HairPoint) -> DVec3 {
    let half = half_vector(light.direction, view);
    let (depth, n_dot_l) = (1.0 - hair.height, hair.normal.dot(light.direction));
    let ambient = shading.hair.ambient * GROUND.lerp(SKY, 0.5 + 0.5 * hair.normal.y) * shading.self_shadow.sky_transmittance(depth);
    let diffuse = shading.hair.diffuse * shading.hair.diffuse_factor(hair.direction.dot(light.direction));
    let specular = shading.hair.specular * shading.hair.specular_factor(hair.direction.dot(half.direction)) * half.weight;
    ambient + (diffuse + specular) * light.colour * shading.self_shadow.transmittance(depth, n_dot_l) * shading.facing.factor(n_dot_l)
}

proptest! {
    #[test]
    fn transmittance_falls_with_depth_and_rises_with_facing(a in 0.0..1.0_f64, b in 0.0..1.0_f64, n in -1.0..1.0_f64, m in -1.0..1.0_f64) {
        let shadow = SelfShadow::default();
        prop_assert!(shadow.transmittance(a.min(b), n) >= shadow.transmittance(a.max(b), n));
        prop_assert!(shadow.transmittance(a, n.max(m)) >= shadow.transmittance(a, n.min(m)));
        prop_assert!(Facing::default().factor(n.max(m)) >= Facing::default().factor(n.min(m)));
    }

    #[test]
    fn light_is_finite_and_not_negative(a in -4.0..4.0_f64, b in -4.0..4.0_f64, c in -4.0..4.0_f64, height in -1.0..2.0_f64) {
        let point = HairPoint { direction: unit(a, b), normal: unit(b, c), height };
        let light = Shading::default().shade(&sun(), unit(c, a), &point);
        prop_assert!(light.is_finite() && light.cmpge(DVec3::ZERO).all());
        let turned = HairPoint { direction: -point.direction, ..point };
        prop_assert_eq!(Shading::default().shade(&sun(), unit(c, a), &turned), light);
    }

    #[test]
    fn one_light_is_the_formula_written_out_and_two_add_up(a in -4.0..4.0_f64, b in -4.0..4.0_f64, c in -4.0..4.0_f64, height in 0.0..1.0_f64) {
        let (shading, view) = (Shading::default(), unit(c, a));
        let point = HairPoint { direction: unit(a, b), normal: unit(b, c), height };
        let rim = DirectionalLight { direction: unit(a, c), colour: DVec3::new(0.2, 0.5, 1.5) };
        let one = |light: DirectionalLight| Illumination { lights: vec![light], ..sun() };
        let apart = |x: DVec3, y: DVec3| (x - y).abs().max_element();
        for light in [SUN, rim] {
            prop_assert!(apart(shading.shade(&one(light), view, &point), one_light(&shading, &light, view, &point)) < 2e-15);
        }
        // Both together are each alone, less the light from all around that was counted twice.
        let (none, both) = (Illumination { lights: Vec::new(), ..sun() }, Illumination { lights: vec![SUN, rim], ..sun() });
        let added = |of: &dyn Fn(&Illumination) -> DVec3| apart(of(&one(SUN)) + of(&one(rim)) - of(&none), of(&both));
        prop_assert!(added(&|light| shading.shade(light, view, &point)) < 2e-15);
        prop_assert!(added(&|light| shading.skin(light, point.normal)) < 2e-15);
    }
}
