//! The row "Hair lighting" of the numbers at their extremes.
#![allow(clippy::print_stdout, reason = "a test says what it measured")]

use glam::DVec3;
use pelage_lighting::{HALF_VECTOR_FADE, HairLighting, half_vector};
use proptest::prelude::*;

fn lighting(diffuse_power: f64, specular_power: f64) -> HairLighting {
    HairLighting {
        ambient: DVec3::new(0.1, 0.2, 0.3),
        diffuse: DVec3::new(0.5, 0.25, 0.125),
        specular: DVec3::new(0.75, 0.5, 0.0625),
        diffuse_power,
        specular_power,
    }
}

#[test]
fn analytic_values() {
    let l = lighting(2.0, 4.0);
    // sin² = 0.75 at u = ½, sin⁴ = (1 − 0.36)² at v = 0.6.
    let expected = l.ambient + l.diffuse * 0.75 + l.specular * 0.64 * 0.64;
    assert!((l.evaluate(0.5, 0.6) - expected).abs().max_element() < 1e-15);
    assert!((lighting(1.0, 1.0).evaluate(0.6, 0.8) - (l.ambient + l.diffuse * 0.8 + l.specular * 0.6)).abs().max_element() < 1e-15);
}

#[test]
fn along_the_hair_only_the_ambient_is_left() {
    let l = lighting(1.0, 64.0);
    for one in [1.0, -1.0, 1.0 + 1e-7, -1.0 - 1e-7, 1.5, -40.0] {
        assert_eq!(l.evaluate(one, one), l.ambient);
    }
}

#[test]
fn hair_lighting_of_exponent_zero_is_exactly_the_sum() {
    let l = lighting(0.0, 0.0);
    for c in [-1.0, -0.3, 0.0, 0.999_999, 1.0, 1.1] {
        assert_eq!(l.evaluate(c, c), l.ambient + l.diffuse + l.specular);
    }
}

#[test]
fn hair_lighting_of_exponents_from_one_to_1e30_stay_finite_and_in_range() {
    for power in [1.0, 1e4, 1e30, f64::MAX] {
        let l = lighting(power, power);
        for c in [-1.0, -0.5, -1e-20, 0.0, 1e-12, 0.5, 1.0] {
            let factor = l.diffuse_factor(c);
            assert!((0.0..=1.0).contains(&factor), "power {power}, cosine {c}: {factor}");
            assert!(l.evaluate(c, c).is_finite());
        }
        assert_eq!(l.diffuse_factor(0.0), 1.0, "across the hair all light is returned");
    }
}

#[test]
fn a_power_under_zero_counts_as_zero() {
    assert_eq!(lighting(-3.0, -1.0).evaluate(1.0, 1.0), lighting(0.0, 0.0).evaluate(1.0, 1.0));
}

#[test]
fn hair_lighting_of_f32_unit_vectors_beyond_one_are_clamped() {
    // Rounded to f32 and back, many unit vectors have t·t > 1.
    let (mut beyond, mut most) = (0, 0.0_f64);
    for i in 0..1000 {
        let (sin, cos) = (f64::from(i) * 0.61).sin_cos();
        let (sine, cosine) = (f64::from(i) * 0.37).sin_cos();
        let t = DVec3::new(cos * sine, sin * sine, cosine).as_vec3().as_dvec3();
        beyond += usize::from(t.length_squared() > 1.0);
        let factor = lighting(1.0, 1.0).diffuse_factor(t.dot(t));
        assert!(factor.is_finite() && factor < 1e-3, "{factor}");
        most = most.max(factor);
    }
    println!("reached: {} % of unit vectors beyond 1, factor {most:.0e} at most where it should be 0", beyond / 10);
    assert!(beyond > 100, "the test meets the case it is about: {beyond}");
}

#[test]
fn hair_lighting_of_a_million_samples_is_finite_and_in_range() {
    let mut samples = 0;
    for (diffuse_power, specular_power) in [(4.8, 64.0), (0.0, 0.0), (1.0, 1.0), (1e4, 1e4), (1e30, 1e30)] {
        let l = lighting(diffuse_power, specular_power);
        let most = l.ambient + l.diffuse + l.specular + DVec3::splat(1e-12);
        for i in 0..1_000_000_u32 {
            let u = f64::from(i) / 499_999.5 - 1.0 + 1e-7 * f64::from(i % 3);
            let v = (f64::from(i) * 0.618_033_988_7).fract() * 2.000_000_2 - 1.000_000_1;
            let light = l.evaluate(u, v);
            assert!(light.is_finite() && light.cmpge(l.ambient).all() && light.cmple(most).all(), "{u} {v} by {specular_power}: {light}");
            samples += 1;
        }
    }
    println!("reached: {samples} samples, from Ka to Ka + Kd + Ks");
}

#[test]
fn specular_fades_as_light_and_eye_oppose() {
    let light = DVec3::Z;
    let mut last = 1.0;
    for gap in [1e-1, 2e-3, 9e-4, 1e-4, 1e-8, 1e-150, 0.0] {
        let view = DVec3::new(gap, 0.0, -1.0).normalize();
        let half = half_vector(light, view);
        assert!(half.direction.is_finite() && half.weight.is_finite());
        assert!(half.weight <= last);
        if gap >= 2.0 * HALF_VECTOR_FADE {
            assert_eq!(half.weight, 1.0);
        }
        last = half.weight;
    }
    assert_eq!(last, 0.0);
    assert_eq!(half_vector(light, -light).weight, 0.0);
    let half = half_vector(light, DVec3::new(0.5 * HALF_VECTOR_FADE, 0.0, -1.0).normalize());
    assert!((half.weight - 0.5).abs() < 1e-6);
    println!("reached: finite to L = −V; the specular at {:.3} at a gap of {:.0e}", half.weight, 0.5 * HALF_VECTOR_FADE);
}

proptest! {
    #[test]
    fn even_in_both_cosines(u in -1.0..1.0_f64, v in -1.0..1.0_f64, pd in 0.0..10.0_f64, ps in 0.0..200.0_f64) {
        let l = lighting(pd, ps);
        prop_assert_eq!(l.evaluate(u, v), l.evaluate(-u, -v));
    }

    #[test]
    fn falls_towards_the_hair(a in 0.0..1.0_f64, b in 0.0..1.0_f64, power in 0.01..100.0_f64) {
        let l = lighting(power, power);
        prop_assert!(l.diffuse_factor(a.min(b)) >= l.diffuse_factor(a.max(b)));
    }

    #[test]
    fn the_half_vector_halves(a in -3.0..3.0_f64, b in -3.0..3.0_f64, c in -3.0..3.0_f64) {
        let (light, view) = (DVec3::new(a.cos(), a.sin(), 0.0), DVec3::new(b.cos() * c.cos(), b.sin() * c.cos(), c.sin()));
        let half = half_vector(light, view);
        prop_assume!((light + view).length() > 1e-2);
        prop_assert!((half.direction.dot(light) - half.direction.dot(view)).abs() < 1e-12);
        prop_assert!((half.direction.length() - 1.0).abs() < 1e-12);
    }
}
