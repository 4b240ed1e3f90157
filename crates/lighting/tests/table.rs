//! The row "Lighting table" of the numbers at their extremes.
#![allow(clippy::expect_used, clippy::print_stdout, reason = "a test may panic, and says what it measured")]

use pelage_lighting::{Axis, FactorError, HairLighting, LightingTable, TableError, TableLayout};

fn lighting() -> HairLighting {
    HairLighting { diffuse_power: 1.0, specular_power: 64.0, ..HairLighting::default() }
}

fn error(size: usize, u: Axis, v: Axis) -> FactorError {
    LightingTable::new(&lighting(), TableLayout { size, u, v }).expect("a legal size").factor_error(&lighting())
}

fn near(measured: f64, expected: f64) {
    assert!((measured / expected - 1.0).abs() < 0.05, "{measured} is not {expected}");
}

#[test]
fn lighting_table_by_default_errs_under_a_hundredth() {
    let table = LightingTable::new(&lighting(), TableLayout::default()).expect("a legal size");
    let error = table.factor_error(&lighting());
    println!("reached: diffuse {:.1e}, specular {:.1e}", error.diffuse.largest, error.specular.largest);
    assert!(error.diffuse.largest < 0.01 && error.specular.largest < 0.01, "{error:?}");
    assert!(error.specular.largest > 1e-4, "a table of 64² is not exact: {error:?}");
}

#[test]
fn lighting_table_of_the_paper_errs_as_known() {
    let table = LightingTable::new(&lighting(), TableLayout::PAPER).expect("a legal size");
    let error = table.factor_error(&lighting());
    println!("reached: diffuse {:.3}, specular {:.3}", error.diffuse.largest, error.specular.largest);
    near(error.specular.largest, 0.033);
    // Pd = 1 has infinite slope at u = ±1: √(2h) / 4 for texels h apart.
    near(error.diffuse.largest, (2.0_f64 * 2.0 / 31.0).sqrt() / 4.0);
}

#[test]
fn lighting_table_wants_the_angle_for_diffuse_and_the_cosine_for_specular() {
    let diffuse = [Axis::Cosine, Axis::Angle].map(|axis| error(256, axis, Axis::Cosine).diffuse.largest);
    let specular = [Axis::Cosine, Axis::Angle].map(|axis| error(32, Axis::Angle, axis).specular.largest);
    println!("reached: diffuse {:.3} and {:.1e}, specular {:.3} and {:.3}", diffuse[0], diffuse[1], specular[0], specular[1]);
    near(error(256, Axis::Cosine, Axis::Cosine).diffuse.largest, 0.031);
    near(error(256, Axis::Angle, Axis::Cosine).diffuse.largest, 1.9e-5);
    near(error(32, Axis::Angle, Axis::Cosine).specular.largest, 0.033);
    near(error(32, Axis::Angle, Axis::Angle).specular.largest, 0.079);
}

/// Of each size and each way of indexing: what is stated is what a search of other places finds.
#[test]
fn lighting_table_of_any_layout_errs_as_it_states() {
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for size in [32, 64, 256] {
        for (u, v) in [Axis::Cosine, Axis::Angle].into_iter().flat_map(|u| [Axis::Cosine, Axis::Angle].map(|v| (u, v))) {
            let table = LightingTable::new(&lighting(), TableLayout { size, u, v }).expect("a legal size");
            let stated = table.factor_error(&lighting());
            // 97 places between two texels, none of them among the 64 that the statement looks at but for the middle.
            let steps = 97 * (size - 1);
            let found = (0..=steps).map(|i| i as f64 / steps as f64).fold([0.0_f64; 2], |found, position| {
                let (cosine_u, cosine_v) = (u.cosine(position), v.cosine(position));
                let (diffuse, specular) = table.look_up(cosine_u, cosine_v);
                let off = [diffuse - lighting().diffuse_factor(cosine_u), specular - lighting().specular_factor(cosine_v)];
                [found[0].max(off[0].abs()), found[1].max(off[1].abs())]
            });
            for (found, stated) in found.into_iter().zip([stated.diffuse.largest, stated.specular.largest]) {
                assert!((found / stated - 1.0).abs() < 0.01, "{size}², u by {u:?}, v by {v:?}: {found} is not {stated}");
                (least, most) = (least.min(found), most.max(found));
            }
        }
    }
    println!("reached: 12 tables, errors from {least:.1e} to {most:.3}");
}

#[test]
fn the_colour_error_is_bounded_by_the_factors() {
    let table = LightingTable::new(&lighting(), TableLayout::PAPER).expect("a legal size");
    let (max, factors) = (table.colour_error(&lighting()).largest, table.factor_error(&lighting()));
    let lighting = lighting();
    assert!(max <= lighting.diffuse.x * factors.diffuse.largest + lighting.specular.x * factors.specular.largest + 1e-12);
    assert!(max >= lighting.diffuse.x * factors.diffuse.largest);
    let (mut seen, mut square) = (0.0_f64, 0.0_f64);
    for i in 0..=500 {
        for j in 0..=500 {
            let (u, v) = (f64::from(i) / 250.0 - 1.0, f64::from(j) / 250.0 - 1.0);
            let (diffuse, specular) = table.look_up(u, v);
            let error = lighting.combine(diffuse, specular) - lighting.evaluate(u, v);
            seen = seen.max(error.abs().max_element());
            square += error.length_squared() / (3.0 * 501.0 * 501.0);
        }
    }
    assert!(seen <= max && seen > 0.9 * max, "seen {seen}, stated {max}");
    near(square.sqrt(), table.colour_error(&lighting).rms);
}

#[test]
fn exact_at_texels_and_ends() {
    for layout in [TableLayout::default(), TableLayout::PAPER] {
        let table = LightingTable::new(&lighting(), layout).expect("a legal size");
        for i in 0..layout.size {
            let position = i as f64 / (layout.size - 1) as f64;
            let (u, v) = (layout.u.cosine(position), layout.v.cosine(position));
            let (diffuse, specular) = table.look_up(u, v);
            assert!((diffuse - lighting().diffuse_factor(u)).abs() < 1e-6);
            assert!((specular - lighting().specular_factor(v)).abs() < 1e-6);
        }
        for beyond in [-1.5, 1.5] {
            assert_eq!(table.look_up(beyond, beyond), (0.0, 0.0));
        }
    }
}

#[test]
fn the_texels_are_the_product_of_the_rows() {
    let layout = TableLayout { size: 8, ..TableLayout::default() };
    let table = LightingTable::new(&lighting(), layout).expect("a legal size");
    let texels = table.texels();
    assert_eq!(texels.len(), 64);
    let (u, v) = (layout.u.cosine(5.0 / 7.0), layout.v.cosine(2.0 / 7.0));
    let (diffuse, specular) = table.look_up(u, v);
    assert!((f64::from(texels[2 * 8 + 5][0]) - diffuse).abs() < 1e-6 && (f64::from(texels[2 * 8 + 5][1]) - specular).abs() < 1e-6);
}

#[test]
fn sizes_out_of_range_are_refused() {
    for size in [0, 1, 4097, usize::MAX] {
        assert_eq!(LightingTable::new(&lighting(), TableLayout { size, ..TableLayout::default() }), Err(TableError::Size { size }));
    }
}

#[test]
fn positions_and_cosines_are_inverse() {
    for axis in [Axis::Cosine, Axis::Angle] {
        for i in 0..=100 {
            let cosine = f64::from(i) / 50.0 - 1.0;
            assert!((axis.cosine(axis.position(cosine)) - cosine).abs() < 1e-12);
        }
    }
}

#[test]
fn lighting_table_states_the_mean_error_of_the_finished_light() {
    // Both factors err to one side here, so that their means add up in the light.
    let lighting = HairLighting { diffuse_power: 1.0, specular_power: 1.0, specular: glam::DVec3::ONE, ..lighting() };
    let layout = TableLayout { size: 8, u: Axis::Cosine, v: Axis::Cosine };
    let table = LightingTable::new(&lighting, layout).expect("a legal size");
    let cosine = |i: u32| (f64::from(i) + 0.5) / 400.0 - 1.0;
    let mut square = 0.0;
    for (i, j) in (0..800).flat_map(|i| (0..800).map(move |j| (i, j))) {
        let (diffuse, specular) = table.look_up(cosine(i), cosine(j));
        square += (lighting.combine(diffuse, specular) - lighting.evaluate(cosine(i), cosine(j))).length_squared() / (3.0 * 800.0 * 800.0);
    }
    let stated = table.colour_error(&lighting).rms;
    assert!((square.sqrt() / stated - 1.0).abs() < 0.01, "{} is not {stated}", square.sqrt());
}
