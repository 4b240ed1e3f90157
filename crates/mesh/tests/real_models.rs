//! Counts of scanned and modelled meshes, held against `real/topology.json` of the folder `PELAGE_MODELS`.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

use std::path::PathBuf;

use glam::DVec3;
use pelage_mesh::{Mesh, Summary, Topology, Vertex, read_obj};
use serde_json::Value;

/// The folder of models, or nothing where none is given.
fn models() -> Option<PathBuf> {
    let folder = std::env::var_os("PELAGE_MODELS").map(PathBuf::from);
    if folder.is_none() {
        println!("PELAGE_MODELS is not set: the real models are not looked at");
    }
    folder
}

fn topology_json() -> Option<(PathBuf, serde_json::Map<String, Value>)> {
    let real = models()?.join("real");
    let text = std::fs::read_to_string(real.join("topology.json")).unwrap();
    Some((real, serde_json::from_str(&text).unwrap()))
}

/// An oriented manifold: nothing to repair.
fn is_clean(model: &Value) -> bool {
    let faults = ["nm_edges", "flip_edges", "nm_verts", "dup_faces", "degen"];
    faults.iter().all(|&fault| model[fault] == 0) && model["genus"].as_f64().is_some_and(|genus| genus.fract() == 0.0)
}

fn clean_models() -> Vec<(String, Value, Mesh)> {
    let Some((real, models)) = topology_json() else { return Vec::new() };
    let clean = models.into_iter().filter(|(_, model)| is_clean(model));
    let read = |(name, model): (String, Value)| {
        let mesh = read_obj(&real.join(format!("{name}.obj"))).unwrap().mesh;
        (name, model, mesh)
    };
    let read: Vec<_> = clean.map(read).collect();
    assert!(read.len() >= 12, "only {} clean models in {}", read.len(), real.display());
    read
}

#[test]
fn counts_are_those_of_topology_json() {
    for (name, model, mesh) in clean_models() {
        assert_eq!(mesh.topology().check(), Ok(()), "{name}");
        let summary = Summary::of(&mesh);
        let counts = [
            ("V", summary.vertices + summary.unreferenced_vertices),
            ("unref", summary.unreferenced_vertices),
            ("E", summary.edges),
            ("F", summary.faces),
            ("bnd_edges", summary.boundary_edges),
            ("bnd_loops", summary.boundary_loops),
            ("comps", summary.components),
        ];
        for (key, count) in counts {
            assert_eq!(model[key].as_u64(), Some(count as u64), "{key} of {name}");
        }
        assert_eq!(model["chi"].as_i64(), Some(summary.euler_characteristic), "{name}");
        assert_eq!(model["genus"].as_f64(), Some(summary.genus as f64), "{name}");
        let diagonal = model["bbox_diag"].as_f64().unwrap();
        // Some files print fewer digits than the diagonal was worked out with.
        assert!((summary.diameter - diagonal).abs() < 1e-7 * diagonal, "{name}: {} for {diagonal}", summary.diameter);
        assert_eq!(summary.faces_without_area, 0, "{name}");
        println!("{name}: {summary:?}");
    }
}

#[test]
fn a_strip_with_one_side_is_cut_into_a_disc() {
    let Some((real, models)) = topology_json() else { return };
    let other: Vec<_> = models.iter().filter(|(_, model)| !is_clean(model)).map(|(name, _)| name.as_str()).collect();
    assert_eq!(other, ["moebius"]);
    let import = read_obj(&real.join("moebius.obj")).unwrap();
    assert_eq!(import.mesh.topology().check(), Ok(()));
    let summary = Summary::of(&import.mesh);
    assert_eq!((summary.components, summary.boundary_loops, summary.genus, summary.euler_characteristic), (1, 1, 0, 1));
    assert!(import.repairs.edges_cut > 0, "{}", import.repairs);
}

#[test]
fn every_half_edge_is_reached_and_corner_angles_add_up() {
    for (name, _, mesh) in clean_models() {
        let topology = mesh.topology();
        let around: usize = topology.vertices().map(Vertex::face_count).sum();
        assert_eq!(around, topology.half_edge_count(), "{name}");
        for face in mesh.faces() {
            let sum: f64 = face.angles().iter().sum();
            assert!((sum - std::f64::consts::PI).abs() < 1e-9, "{name}: face {face:?}");
        }
    }
}

#[test]
fn geometry_does_not_depend_on_scale_or_place() {
    for (name, _, mesh) in clean_models() {
        let (normals, area) = (mesh.vertex_normals(), mesh.area());
        for scale in [1e-30, 1e-15, 1e15, 1e30] {
            let scaled = mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap();
            for (a, b) in normals.iter().zip(scaled.vertex_normals()) {
                assert!(a.distance(b) < 1e-9, "{name} at {scale}: {a} became {b}");
            }
            let ratio = scaled.area() / area / scale / scale;
            assert!((ratio - 1.0).abs() < 1e-9, "{name} at {scale}: area {ratio}");
        }
        let offset = 1e7 * mesh.diameter() * DVec3::new(1.0, -1.0, 0.5);
        let moved = mesh.with_positions(mesh.positions().iter().map(|&p| p + offset).collect()).unwrap();
        let ratio = Summary::of(&moved).area / area;
        assert!((ratio - 1.0).abs() < 1e-5, "{name}: area {ratio} when moved");
    }
}

#[test]
fn the_topology_of_the_triangles_is_the_same_again() {
    for (name, _, mesh) in clean_models() {
        let triangles: Vec<_> = mesh.topology().triangles().collect();
        let again = Topology::from_triangles(mesh.topology().vertex_count(), &triangles).unwrap();
        assert_eq!(&again, mesh.topology().as_ref(), "{name}");
    }
}
