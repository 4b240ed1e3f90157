//! What the tests share.
#![allow(dead_code, reason = "each test file uses its own part")]

pub(crate) mod surfaces;

use std::path::Path;

use glam::DVec3;
use pelage_field::DirectionField;
use pelage_mesh::{Mesh, plane, read_obj, rounded_die, sphere, torus};

/// The clean models of the folder `PELAGE_MODELS`, and our own.
pub(crate) fn models() -> Vec<(String, Mesh)> {
    let bunny = read_obj(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/models/bunny.obj")).unwrap().mesh;
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let tetrahedron = Mesh::from_triangles(corners, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap();
    let mut models = vec![
        ("tetrahedron".to_owned(), tetrahedron),
        ("bunny".to_owned(), bunny),
        ("sphere".to_owned(), sphere(1.0, 14).unwrap()),
        // So coarse that each face is a great part of the whole curvature.
        ("icosahedron".to_owned(), sphere(1.0, 1).unwrap()),
        ("coarse torus".to_owned(), torus(1.0, 0.4, 4, 3).unwrap()),
        ("torus".to_owned(), torus(1.0, 0.4, 40, 24).unwrap()),
        ("die".to_owned(), rounded_die(1.0, 0.3, 20).unwrap()),
        ("plane".to_owned(), plane(1.0, 1.0, 12, 12).unwrap()),
    ];
    let Some(folder) = std::env::var_os("PELAGE_MODELS") else {
        println!("PELAGE_MODELS is not set: the real models are not looked at");
        return models;
    };
    let real = Path::new(&folder).join("real");
    let topology: serde_json::Map<String, serde_json::Value> =
        serde_json::from_str(&std::fs::read_to_string(real.join("topology.json")).unwrap()).unwrap();
    let is_clean = |model: &serde_json::Value| {
        let faults = ["nm_edges", "flip_edges", "nm_verts", "dup_faces", "degen"];
        faults.iter().all(|&fault| model[fault] == 0) && model["genus"].as_f64().is_some_and(|genus| genus.fract() == 0.0)
    };
    let clean = topology.into_iter().filter(|(_, model)| is_clean(model));
    let read: Vec<_> = clean.map(|(name, _)| (name.clone(), read_obj(&real.join(format!("{name}.obj"))).unwrap().mesh)).collect();
    assert!(read.len() >= 12);
    models.extend(read);
    models
}

/// Gives by how much a vector is not unit or not tangent at most.
pub(crate) fn assert_unit_and_tangent(name: &str, mesh: &Mesh, field: &DirectionField) -> f64 {
    let mut worst = 0.0_f64;
    for ((vertex, v), n) in mesh.vertices().zip(field.vectors()).zip(mesh.vertex_normals()) {
        if vertex.is_referenced() && n != DVec3::ZERO {
            assert!((v.length() - 1.0).abs() < 1e-9, "{name}: {vertex:?} has {v}");
            assert!(v.dot(n).abs() < 1e-9, "{name}: {vertex:?} leaves its plane by {}", v.dot(n));
            worst = worst.max((v.length() - 1.0).abs()).max(v.dot(n).abs());
        } else {
            assert_eq!(*v, DVec3::ZERO, "{name}: {vertex:?}");
        }
    }
    worst
}
