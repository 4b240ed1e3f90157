//! Self-shadow, facing and the whole formula.

use glam::DVec3;
use pelage_lighting::{DIFFUSIVITY, Facing, HairPoint, Illumination, SelfShadow, Shading};
use proptest::prelude::*;

fn sun() -> Illumination {
    Illumination {
        direction: DVec3::new(0.6, 0.8, 0.0),
        colour: DVec3::new(1.0, 0.9, 0.8),
        sky: DVec3::new(0.3, 0.4, 0.5),
        ground: DVec3::new(0.2, 0.1, 0.1),
    }
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
    let (sun, view) = (sun(), DVec3::Z);
    let point = |normal| HairPoint { direction: DVec3::Z, normal, height: 1.0 };
    let flat = Illumination { sky: DVec3::splat(0.3), ground: DVec3::splat(0.3), ..sun };
    let lit = shading.shade(&flat, view, &point(sun.direction));
    let away = shading.shade(&flat, view, &point(-sun.direction));
    assert!(lit.cmpgt(2.0 * away).all(), "{lit} {away}");
}

#[test]
fn shadow_and_facing_leave_the_ambient_alone() {
    let mut shading = Shading::default();
    shading.self_shadow.density = 0.0;
    let dark = Illumination { colour: DVec3::ZERO, ..sun() };
    let point = HairPoint { direction: DVec3::X, normal: -sun().direction, height: 0.0 };
    assert_eq!(shading.shade(&dark, DVec3::Z, &point), shading.hair.ambient * dark.hemisphere(point.normal));
}

#[test]
fn without_shadow_and_facing_it_is_the_papers_formula() {
    let shading = Shading {
        self_shadow: SelfShadow { density: 0.0, ..SelfShadow::default() },
        facing: Facing { strength: 0.0, ..Facing::default() },
        ..Shading::default()
    };
    let white = Illumination { colour: DVec3::ONE, sky: DVec3::ONE, ground: DVec3::ONE, ..sun() };
    let (view, t) = (DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.48, 0.6, 0.64));
    let half = (view + white.direction).normalize();
    let expected = shading.hair.evaluate(t.dot(white.direction), t.dot(half));
    let shade = shading.shade(&white, view, &HairPoint { direction: t, normal: DVec3::Y, height: 0.3 });
    assert!((shade - expected).abs().max_element() < 1e-15);
}

#[test]
fn skin_is_a_plain_diffuse() {
    let (shading, sun) = (Shading::default(), sun());
    let expected = shading.hair.ambient * sun.hemisphere(DVec3::Y) + shading.hair.diffuse * sun.colour * 0.8;
    assert!((shading.skin(&sun, DVec3::Y) - expected).abs().max_element() < 1e-15);
    assert_eq!(shading.skin(&sun, -DVec3::Y), shading.hair.ambient * sun.ground);
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
        let unit = |x: f64, y: f64| DVec3::new(x.cos() * y.cos(), x.sin() * y.cos(), y.sin());
        let point = HairPoint { direction: unit(a, b), normal: unit(b, c), height };
        let light = Shading::default().shade(&sun(), unit(c, a), &point);
        prop_assert!(light.is_finite() && light.cmpge(DVec3::ZERO).all());
        let turned = HairPoint { direction: -point.direction, ..point };
        prop_assert_eq!(Shading::default().shade(&sun(), unit(c, a), &turned), light);
    }
}
