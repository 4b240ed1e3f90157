//! Counts of scanned and modelled meshes, held against `real/topology.json` of the folder `PELAGE_MODELS`.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use glam::DVec3;
use pelage_mesh::{Import, Mesh, Quality, RepairReport, Summary, Topology, Vertex, parse_obj, read_obj};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;
use serde_json::{Value, json};

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

/// Every model, with what `topology.json` says of it.
fn models_read() -> Vec<(String, Value, Import)> {
    let Some((real, models)) = topology_json() else { return Vec::new() };
    let in_folder =
        std::fs::read_dir(&real).unwrap().filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|e| e == "obj"));
    assert_eq!(in_folder.count(), models.len(), "models and entries of topology.json");
    assert!(models.len() >= 13, "only {} models in {}", models.len(), real.display());
    let read = |(name, model): (String, Value)| {
        let import = read_obj(&real.join(format!("{name}.obj"))).unwrap();
        (name, model, import)
    };
    models.into_iter().map(read).collect()
}

/// Those that are oriented manifolds as they come: all but the strip with one side.
fn clean_models() -> Vec<(String, Value, Mesh)> {
    let clean = models_read().into_iter().filter(|(name, ..)| name != "moebius");
    clean.map(|(name, model, import)| (name, model, import.mesh)).collect()
}

/// Everything that `topology.json` says of a file, worked out from the mesh and the repairs that led to it.
fn as_topology_json(import: &Import) -> serde_json::Map<String, Value> {
    let (summary, quality, repairs) = (Summary::of(&import.mesh), Quality::of(&import.mesh), &import.repairs);
    // Cutting an edge makes two boundary edges of it, and copies of its ends.
    let (cut, added) = (repairs.edges_cut, repairs.vertices_added - repairs.vertices_split);
    let one_sided = cut > 0;
    let loops_without_the_cut = if one_sided { boundary_loops_uncut(&import.mesh) } else { summary.boundary_loops };
    let value = json!({
        "V": summary.vertices - repairs.vertices_added + repairs.vertices_unreferenced + repairs.vertices_welded,
        "F": summary.faces + repairs.faces_duplicated + repairs.faces_without_area + repairs.faces_collapsed,
        "unref": repairs.vertices_unreferenced,
        "E": summary.edges - cut,
        "bnd_edges": summary.boundary_edges - 2 * cut,
        "nm_edges": repairs.edges_split,
        // With no face turned, windings clashed where the surface was cut.
        "flip_edges": if repairs.faces_turned == 0 { Some(cut) } else { None },
        "comps": summary.components,
        "nm_verts": repairs.vertices_split,
        "bnd_loops": loops_without_the_cut,
        "chi": summary.euler_characteristic - added as i64 + cut as i64,
        "genus": if one_sided { None } else { Some(summary.genus as f64) },
        "bbox_diag": summary.diameter,
        "degen": repairs.faces_without_area + repairs.faces_collapsed,
        "q50": quality.aspect_p50,
        "q99": quality.aspect_p99,
        "qmax": quality.aspect_max,
        "minang": quality.angle_min_deg,
        "maxang": quality.angle_max_deg,
        "dup_faces": repairs.faces_duplicated,
        "dup_verts": repairs.vertices_welded,
        "edge_ratio": quality.edge_ratio,
        "val": valences_uncut(&import.mesh),
    });
    value.as_object().unwrap().clone()
}

/// Groups the boundary's edges by place, as if copies of a vertex were one: those along a cut go in pairs and are none, the others form loops.
fn boundary_loops_uncut(mesh: &Mesh) -> usize {
    let place = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut edges: BTreeMap<_, usize> = BTreeMap::new();
    for edge in mesh.edges().filter(|edge| edge.is_boundary()) {
        let mut ends = edge.vertices().map(|v| place(v.position()));
        ends.sort_unstable();
        *edges.entry(ends).or_default() += 1;
    }
    let mut open: Vec<_> = edges.into_iter().filter(|&(_, count)| count == 1).map(|(ends, _)| ends).collect();
    let mut loops = 0;
    while let Some([start, mut here]) = open.pop() {
        while here != start {
            let next = open.iter().position(|ends| ends.contains(&here)).unwrap();
            let [a, b] = open.swap_remove(next);
            here = if a == here { b } else { a };
        }
        loops += 1;
    }
    loops
}

/// The fewest and most edges at a place.
fn valences_uncut(mesh: &Mesh) -> [usize; 2] {
    let place = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut around: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
    for half_edge in mesh.half_edges() {
        let (a, b) = (place(half_edge.origin().position()), place(half_edge.tip().position()));
        around.entry(a).or_default().insert(b);
        around.entry(b).or_default().insert(a);
    }
    let counts = || around.values().map(BTreeSet::len);
    [counts().min().unwrap(), counts().max().unwrap()]
}

#[test]
fn every_figure_is_that_of_topology_json() {
    let (mut models, mut figures, mut worst) = (0, 0, 0.0_f64);
    for (name, model, import) in models_read() {
        assert_eq!(import.mesh.topology().check(), Ok(()), "{name}");
        let found = as_topology_json(&import);
        for (key, expected) in model.as_object().unwrap().iter().filter(|(key, _)| !["name", "note"].contains(&key.as_str())) {
            let found = found.get(key).unwrap_or_else(|| panic!("{key} of {name} is not looked at"));
            match (expected.as_f64(), found.as_f64()) {
                // Some files print fewer digits than the figures were worked out with; a needle's angles and aspect feel it most.
                (Some(a), Some(b)) if a.fract() != 0.0 => {
                    worst = worst.max((a - b).abs() / a);
                    assert!((a - b).abs() < 1e-5 * a, "{key} of {name}: {b} for {a}");
                }
                (Some(a), Some(b)) => assert_eq!(a, b, "{key} of {name}"),
                _ => assert_eq!(expected, found, "{key} of {name}"),
            }
            figures += 1;
        }
        models += 1;
        let quality = Quality::of(&import.mesh);
        if name != "moebius" {
            assert_eq!(valences_uncut(&import.mesh), [quality.valence_min, quality.valence_max], "{name}");
            assert!(import.repairs.is_none() && import.notes.is_empty(), "{name}: {}", import.repairs);
        }
    }
    println!("reached: {figures} figures of {models} models, whole ones equal, others within {worst:.0e}");
}

#[test]
fn a_strip_with_one_side_is_cut_into_a_disc_where_its_windings_clash() {
    let Some((real, _)) = topology_json() else { return };
    let import = read_obj(&real.join("moebius.obj")).unwrap();
    let summary = Summary::of(&import.mesh);
    assert_eq!((summary.components, summary.boundary_loops, summary.genus, summary.euler_characteristic), (1, 1, 0, 1));
    assert_eq!(import.repairs, RepairReport { edges_cut: 4, vertices_added: 5, ..RepairReport::default() });
}

/// The same file with its vertices and faces in another order, and every face started at another corner.
fn shuffled(text: &str, seed: u64) -> String {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut vertices: Vec<&str> = text.lines().filter(|line| line.starts_with("v ")).collect();
    let mut names: Vec<usize> = (0..vertices.len()).collect();
    names.shuffle(&mut random);
    let mut renamed = vec![""; vertices.len()];
    for (old, &new) in names.iter().enumerate() {
        renamed[new] = vertices[old];
    }
    vertices = renamed;
    let face = |line: &str| {
        let corners = line.split_whitespace().skip(1).map(|corner| corner.split('/').next().unwrap().parse::<usize>().unwrap());
        corners.map(|vertex| names[vertex - 1] + 1).collect::<Vec<_>>()
    };
    let mut faces: Vec<Vec<usize>> = text.lines().filter(|line| line.starts_with("f ")).map(face).collect();
    faces.shuffle(&mut random);
    for (turn, face) in faces.iter_mut().enumerate() {
        let corners = face.len();
        face.rotate_left(turn % corners);
    }
    let faces = faces.iter().map(|face| format!("f {}\n", face.iter().map(usize::to_string).collect::<Vec<_>>().join(" ")));
    vertices.iter().map(|line| format!("{line}\n")).chain(faces).collect()
}

#[test]
fn the_order_of_faces_and_vertices_changes_no_count() {
    let Some((real, models)) = topology_json() else { return };
    let mut worst = 0.0_f64;
    for name in models.keys() {
        let text = std::fs::read_to_string(real.join(format!("{name}.obj"))).unwrap();
        let as_given = parse_obj(text.as_bytes()).unwrap();
        for seed in [1, 2] {
            let other = parse_obj(shuffled(&text, seed).as_bytes()).unwrap();
            assert_eq!(other.mesh.topology().check(), Ok(()));
            assert_eq!(as_given.repairs, other.repairs, "{name}");
            let (a, b) = (Summary::of(&as_given.mesh), Summary::of(&other.mesh));
            let counts = |s: &Summary| (s.vertices, s.edges, s.boundary_edges, s.faces, s.boundary_loops, s.components, s.genus);
            assert_eq!(counts(&a), counts(&b), "{name}");
            assert!((a.area - b.area).abs() < 1e-12 * a.area && (a.diameter - b.diameter).abs() < 1e-15 * a.diameter, "{name}");
            worst = worst.max((a.area - b.area).abs() / a.area);
        }
    }
    println!("reached: counts equal, areas within {worst:.0e}");
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
    let (mut turned, mut grown, mut moved_off) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (name, _, mesh) in clean_models() {
        let (normals, area) = (mesh.vertex_normals(), mesh.area());
        for scale in [1e-30, 1e-15, 1e15, 1e30] {
            let scaled = mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap();
            for (a, b) in normals.iter().zip(scaled.vertex_normals()) {
                assert!(a.distance(b) < 1e-9, "{name} at {scale}: {a} became {b}");
                turned = turned.max(a.distance(b));
            }
            let ratio = scaled.area() / area / scale / scale;
            assert!((ratio - 1.0).abs() < 1e-9, "{name} at {scale}: area {ratio}");
            grown = grown.max((ratio - 1.0).abs());
        }
        let offset = 1e7 * mesh.diameter() * DVec3::new(1.0, -1.0, 0.5);
        let moved = mesh.with_positions(mesh.positions().iter().map(|&p| p + offset).collect()).unwrap();
        let ratio = Summary::of(&moved).area / area;
        assert!((ratio - 1.0).abs() < 1e-8, "{name}: area {ratio} when moved");
        moved_off = moved_off.max((ratio - 1.0).abs());
    }
    println!("reached: scaled, normals within {turned:.0e} and areas within {grown:.0e}; moved, areas within {moved_off:.0e}");
}

#[test]
fn the_topology_of_the_triangles_is_the_same_again() {
    for (name, _, mesh) in clean_models() {
        let triangles: Vec<_> = mesh.topology().triangles().collect();
        let again = Topology::from_triangles(mesh.topology().vertex_count(), &triangles).unwrap();
        assert_eq!(&again, mesh.topology().as_ref(), "{name}");
    }
}
