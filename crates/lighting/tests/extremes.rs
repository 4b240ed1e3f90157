//! The rows "Hair lighting" and "Lighting table" of the numbers at their extremes that no other file holds: the same limits through the table, after rounding
//! to the half floats a renderer keeps, and what is no number.
#![allow(clippy::expect_used, clippy::print_stdout, reason = "a test may panic, and says what it measured")]

use glam::DVec3;
use pelage_lighting::{
    Axis, DirectionalLight, Facing, HairLighting, HairPoint, Illumination, Irradiance, LightingTable, SelfShadow, Shading, TableLayout,
    half_vector,
};

fn white(direction: DVec3) -> Illumination {
    let light = DirectionalLight { direction, colour: DVec3::ONE };
    Illumination { lights: vec![light], ambient: Irradiance::hemisphere(DVec3::ONE, DVec3::splat(0.5)) }
}

fn powers(diffuse_power: f64, specular_power: f64) -> HairLighting {
    HairLighting { diffuse_power, specular_power, ..HairLighting::default() }
}

fn layouts() -> impl Iterator<Item = TableLayout> {
    let axes = [Axis::Cosine, Axis::Angle];
    [32, 64, 256]
        .into_iter()
        .flat_map(move |size| axes.into_iter().flat_map(move |u| axes.into_iter().map(move |v| TableLayout { size, u, v })))
}

/// Rounded to 11 significant bits, or to 2⁻²⁴ below the half floats' normal range.
fn half(value: f64) -> f64 {
    let unit = libm::exp2((value.abs().max(2f64.powi(-14)).log2().floor()) - 10.0);
    (value / unit).round_ties_even() * unit
}

#[test]
fn lighting_table_of_any_exponent_is_finite_and_in_range_beyond_the_ends_too() {
    for power in [-1.0, 0.0, 1.0, 1e4, 1e30, f64::MAX, f64::INFINITY, f64::NAN] {
        for layout in layouts() {
            let table = LightingTable::new(&powers(power, power), layout).expect("a legal size");
            assert!(table.texels().iter().flatten().all(|factor| (0.0..=1.0).contains(factor)));
            for cosine in [-1e300, -1.000_001, -1.0, -0.3, 0.0, 1e-12, 1.0, 1.000_000_1, 7.0, f64::INFINITY, f64::NAN] {
                let (diffuse, specular) = table.look_up(cosine, cosine);
                assert!((0.0..=1.0).contains(&diffuse) && (0.0..=1.0).contains(&specular), "power {power}, {layout:?} at {cosine}");
                let zero = power.is_nan() || power <= 0.0;
                assert!(!zero || (diffuse == 1.0 && specular == 1.0), "exponent 0 is the sum of the colours: {diffuse} {specular}");
            }
        }
    }
}

#[test]
fn lighting_table_in_half_floats_errs_by_a_quarter_of_a_thousandth_more() {
    let lighting = powers(1.0, 64.0);
    let mut most = 0.0_f64;
    for layout in layouts() {
        let table = LightingTable::new(&lighting, layout).expect("a legal size");
        for factor in table.texels().iter().flatten().map(|&factor| f64::from(factor)) {
            let kept = half(factor);
            assert!((kept - factor).abs() <= 2.5e-4 && (0.0..=1.0).contains(&kept), "{factor} is kept as {kept}");
            most = most.max((kept - factor).abs());
        }
    }
    // Sum of both: the default stays under a hundredth in the renderer.
    let error = LightingTable::new(&lighting, TableLayout::default()).expect("a legal size").factor_error(&lighting);
    let whole = error.diffuse.largest.max(error.specular.largest) + most;
    println!("reached: {most:.1e} by rounding, {whole:.1e} in all by default");
    assert!(whole < 0.01);
}

#[test]
fn hair_lighting_of_no_number_is_finite() {
    let nan = DVec3::splat(f64::NAN);
    let lighting = powers(0.6, 20.0);
    assert_eq!(lighting.evaluate(f64::NAN, f64::NAN), lighting.ambient);
    assert!(powers(f64::NAN, f64::NAN).evaluate(0.3, 0.3).is_finite());
    let half = half_vector(nan, DVec3::Y);
    assert!(half.weight == 0.0 && half.direction == DVec3::ZERO);
    let light = white(DVec3::Y);
    let point = HairPoint { direction: DVec3::X, normal: DVec3::Y, height: 0.5 };
    let lost = SelfShadow { density: f64::NAN, minimum: f64::NAN, grazing: f64::NAN };
    let facing = Facing { strength: f64::NAN, dark_below: f64::NAN, full_above: f64::NAN };
    for shading in [Shading::default(), Shading { self_shadow: lost, facing, ..Shading::default() }] {
        for (light, view, point) in [
            (white(nan), DVec3::Y, point),
            (light.clone(), nan, point),
            (light.clone(), DVec3::Y, HairPoint { direction: nan, ..point }),
            (light.clone(), DVec3::Y, HairPoint { normal: nan, ..point }),
            (light.clone(), DVec3::Y, HairPoint { height: f64::NAN, ..point }),
        ] {
            let shade = shading.shade(&light, view, &point);
            assert!(shade.is_finite() && shade.cmpge(DVec3::ZERO).all(), "{light:?} {view} {point:?}: {shade}");
            assert!(shading.skin(&light, point.normal).is_finite());
        }
    }
}

#[test]
fn hair_lighting_fades_the_highlight_where_light_and_eye_oppose() {
    let shading = Shading {
        hair: HairLighting { ambient: DVec3::ZERO, diffuse: DVec3::ZERO, specular: DVec3::ONE, ..powers(1.0, 0.0) },
        ..Shading::default()
    };
    let light = white(DVec3::Y);
    let point = HairPoint { direction: DVec3::X, normal: DVec3::Y, height: 1.0 };
    let seen = |gap: f64| shading.shade(&light, DVec3::new(gap, -1.0, 0.0).normalize(), &point).x;
    assert_eq!(seen(0.0), 0.0);
    assert!((seen(5e-4) - 0.5).abs() < 1e-3 && (seen(2e-3) - 1.0).abs() < 1e-9, "{} {}", seen(5e-4), seen(2e-3));
}
