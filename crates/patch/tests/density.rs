//! Hair is as dense on coarse triangles as on dense ones, whatever their texture coordinates (K20).
//!
//! A tile has its hairs; so many of it lie on a face as its image in the tile has area, and hairs a unit of surface are hairs a tile times that image's area over the face's own:
//! the determinant of the patch's Jacobian. At the wanted scale it is 1 over the tile's area on the surface.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use glam::{DVec2, DVec3};
use pelage_field::DirectionField;
use pelage_mesh::{Mesh, plane, rounded_die, sphere, subdivide, torus};
use pelage_patch::{PatchTiling, Settings, grow};

/// Of each face: its area, and its tiles a wanted tile's area, which should be 1.
fn densities(mesh: &Mesh, tiling: &PatchTiling) -> Vec<(f64, f64)> {
    let wanted = tiling.tile_side().powi(2);
    let faces = tiling.surface_faces().iter().zip(tiling.faces());
    let of_face = |(face, corners): (&pelage_mesh::FaceId, &[u32; 3])| {
        let [a, b, c]: [DVec2; 3] = corners.map(|corner| tiling.coordinates()[corner as usize]);
        let area = mesh.face(*face).area();
        (area, 0.5 * (b - a).perp_dot(c - a) * wanted / area)
    };
    faces.map(of_face).collect()
}

/// Over all faces that `chosen` says: tiles a wanted tile's area.
fn mean(mesh: &Mesh, tiling: &PatchTiling, chosen: impl Fn(DVec3) -> bool) -> f64 {
    let all = densities(mesh, tiling);
    let chosen = tiling.surface_faces().iter().zip(all).filter(|(face, _)| chosen(mesh.face(**face).centre()));
    let (area, tiles) = chosen.fold((0.0, 0.0), |(area, tiles), (_, (its, density))| (area + its, tiles + its * density));
    tiles / area
}

/// Which part of the surface is more than a tenth too dense or too thin.
fn uneven(mesh: &Mesh, tiling: &PatchTiling) -> f64 {
    let all = densities(mesh, tiling);
    let off: f64 = all.iter().filter(|(_, density)| !(0.9..1.0 / 0.9).contains(density)).map(|(area, _)| area).sum();
    off.abs() / mesh.area()
}

fn settings(mesh: &Mesh) -> Settings {
    Settings { tile_side: 0.1 * mesh.diameter(), ..Settings::for_mesh(mesh) }
}

/// One surface as coarse, middling and dense triangles.
fn families() -> Vec<(&'static str, Vec<Mesh>)> {
    let die = rounded_die(1.0, 0.5, 6).unwrap();
    vec![
        ("plane", [6, 24, 96].map(|cells| plane(1.0, 1.0, cells, cells).unwrap()).to_vec()),
        ("ball", [8, 20, 50].map(|cuts| sphere(1.0, cuts).unwrap()).to_vec()),
        ("ring", [(24, 10), (60, 24), (150, 60)].map(|(around, across)| torus(1.0, 0.4, around, across).unwrap()).to_vec()),
        ("die", [0, 1, 2].map(|levels| subdivide(&die, levels).unwrap()).to_vec()),
    ]
}

#[test]
fn coarse_and_dense_triangles_have_the_same_hair() {
    for (name, family) in families() {
        let mut all = Vec::new();
        for mesh in &family {
            let directions = DirectionField::toward(mesh, DVec3::new(0.3, -0.4, 1.0)).unwrap();
            for combed in [None, Some(&directions)] {
                let tiling = grow(mesh, combed, &settings(mesh)).unwrap();
                let (density, uneven) = (mean(mesh, &tiling, |_| true), uneven(mesh, &tiling));
                let how = if combed.is_some() { "combed" } else { "isotropic" };
                println!(
                    "reached: {name} of {} faces, {how}: {density:.3} of the wanted density; {:.1} % of it off by a tenth",
                    mesh.topology().face_count(),
                    100.0 * uneven
                );
                all.push(density);
            }
        }
        let (least, most) = all.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), &d| (least.min(d), most.max(d)));
        assert!(least > 0.98 && most < 1.02, "{name}: {all:?}");
    }
}

/// A sheet whose cells are six times as fine on the one side: hair is no denser there.
#[test]
fn triangles_of_very_different_size_in_one_mesh_have_the_same_hair() {
    let sheet = plane(1.0, 1.0, 56, 56).unwrap();
    // Columns and rows: 8 cells up to the middle, 48 beyond.
    let graded = |x: f64| {
        let cell = (56.0 * (x + 0.5)).round();
        if cell <= 8.0 { cell / 16.0 - 0.5 } else { (cell - 8.0) / 96.0 }
    };
    let sheet = sheet.with_positions(sheet.positions().iter().map(|p| DVec3::new(graded(p.x), 0.0, graded(p.z))).collect()).unwrap();
    let directions = DirectionField::toward(&sheet, DVec3::new(1.0, 0.0, 0.4)).unwrap();
    for combed in [None, Some(&directions)] {
        let tiling = grow(&sheet, combed, &settings(&sheet)).unwrap();
        let quarters = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
        let densities = quarters.map(|(x, z)| mean(&sheet, &tiling, |p| p.x * x > 0.0 && p.z * z > 0.0));
        println!("reached: quarters of 128 to 4,608 faces: {densities:.4?} of the wanted density");
        assert!(densities.iter().all(|d| (d - 1.0).abs() < 0.02), "{densities:?}");
    }
}

/// A tiling knows nothing of texture coordinates: with any it is the same bits.
#[test]
fn texture_coordinates_make_no_difference() {
    for (name, family) in families() {
        let mesh = &family[0];
        let without = Mesh::new(std::sync::Arc::clone(mesh.topology()), mesh.positions().to_vec()).unwrap();
        let stretched: Vec<DVec2> =
            mesh.half_edges().map(|h| DVec2::new(1000.0 * h.origin().position().x, 0.001 * h.index() as f64)).collect();
        let stretched = without.clone().with_texture_coordinates(stretched).unwrap();
        let folded = without.clone().with_texture_coordinates(vec![DVec2::ZERO; mesh.topology().half_edge_count()]).unwrap();
        let tilings = [&without, &stretched, &folded].map(|mesh| grow(mesh, None, &settings(mesh)).unwrap());
        assert!(tilings.iter().all(|tiling| *tiling == tilings[0]), "{name}");
    }
}
