//! What the tests share.
#![allow(dead_code, reason = "each test file uses its own part")]

#[path = "../../../field/tests/common/surfaces.rs"]
pub(crate) mod surfaces;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use pelage_field::DirectionField;
use pelage_mesh::{Mesh, Topology, TopologyError, read_obj};
use pelage_patch::{PatchTiling, Quality, Settings, grow};

/// Grows a tiling and checks everything that holds by construction.
pub(crate) fn tile(mesh: &Mesh, directions: Option<&DirectionField>, settings: &Settings) -> PatchTiling {
    let tiling = grow(mesh, directions, settings).unwrap();
    check(mesh, directions, settings, &tiling);
    tiling
}

/// Every face in one patch, every patch a disc, nothing flipped, every bound kept but by the few faces that are let off, and the arrays in step.
pub(crate) fn check(mesh: &Mesh, directions: Option<&DirectionField>, settings: &Settings, tiling: &PatchTiling) -> Quality {
    check_arrays(mesh, tiling);
    let quality = tiling.quality(mesh, directions);
    assert_eq!(quality.faces_covered, mesh.topology().face_count());
    assert!(quality.all_discs);
    assert_eq!(quality.faces_flipped, 0);
    assert!(quality.stretch_max <= settings.max_stretch * (1.0 + 1e-9), "{quality:?}");
    if let Some(field) = directions {
        let angles = tiling.misalignment_deg(mesh, field);
        let turned = angles.iter().zip(tiling.surface_faces()).filter(|(degrees, _)| **degrees > settings.max_turning.to_degrees() + 1e-6);
        for (degrees, face) in turned {
            assert!(tiling.let_off().binary_search(face).is_ok(), "{face:?} is turned by {degrees}°");
        }
    }
    quality
}

fn check_arrays(mesh: &Mesh, tiling: &PatchTiling) {
    assert_eq!(tiling.vertices().len(), tiling.coordinates().len());
    assert_eq!(tiling.faces().len(), tiling.surface_faces().len());
    assert!(tiling.coordinates().iter().all(|c| c.is_finite()));
    let (mut faces, mut vertices) = (0, 0);
    for (index, patch) in tiling.patches().iter().enumerate() {
        assert_eq!((patch.faces().start, patch.vertices().start), (faces, vertices), "patches are contiguous");
        (faces, vertices) = (patch.faces().end, patch.vertices().end);
        for row in patch.faces() {
            let surface = tiling.surface_faces()[row];
            assert_eq!(tiling.patch_of_face()[surface.index()] as usize, index);
            for (corner, under) in tiling.faces()[row].into_iter().zip(mesh.face(surface).vertices()) {
                assert!(patch.vertices().contains(&(corner as usize)));
                assert_eq!(tiling.vertices()[corner as usize], under.id());
            }
        }
        let mut under: Vec<_> = tiling.vertices()[patch.vertices()].to_vec();
        under.sort();
        under.dedup();
        assert_eq!(under.len(), patch.vertices().len(), "a surface vertex comes once in a patch");
    }
    assert_eq!((faces, vertices), (tiling.faces().len(), tiling.vertices().len()));
}

/// The mesh with every position mapped.
pub(crate) fn moved(mesh: &Mesh, map: impl Fn(DVec3) -> DVec3) -> Mesh {
    Mesh::new(Arc::clone(mesh.topology()), mesh.positions().iter().map(|&p| map(p)).collect()).unwrap()
}

/// A mesh of what is left of some triangles when vertices at which several fans touch have lost their faces.
pub(crate) fn manifold(positions: Vec<DVec3>, mut triangles: Vec<[u32; 3]>) -> Mesh {
    loop {
        match Topology::from_triangles(positions.len(), &triangles) {
            Ok(topology) => return Mesh::new(Arc::new(topology), positions).unwrap(),
            Err(TopologyError::NonManifoldVertex { vertex }) => triangles.retain(|t| !t.contains(&vertex)),
            Err(other) => panic!("{other}"),
        }
    }
}

/// A field towards −z and a little down, as a coat lies on an animal that looks along +z.
pub(crate) fn combed(mesh: &Mesh) -> DirectionField {
    DirectionField::toward(mesh, DVec3::new(0.0, -0.3, -1.0)).unwrap()
}

/// A model of the folder that `PELAGE_MODELS` names.
pub(crate) struct Model {
    pub(crate) name: String,
    pub(crate) mesh: Mesh,
    /// Whether every face has area and the file needed no repair that cut, split or dropped anything.
    pub(crate) clean: bool,
}

/// Every model there that gives a mesh, real and nasty; none where the variable is unset.
pub(crate) fn all_models() -> Vec<Model> {
    let Some(folder) = std::env::var_os("PELAGE_MODELS") else {
        println!("PELAGE_MODELS is not set: the real models are not tried");
        return Vec::new();
    };
    let mut models = Vec::new();
    for (part, least) in [("real", 13), ("nasty", 25)] {
        let entries = std::fs::read_dir(Path::new(&folder).join(part)).unwrap();
        let mut paths: Vec<PathBuf> =
            entries.map(|entry| entry.unwrap().path()).filter(|p| p.extension().is_some_and(|e| e == "obj")).collect();
        paths.sort();
        let before = models.len();
        for path in paths {
            let Ok(import) = read_obj(&path) else { continue };
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            let clean = part == "real" && name != "moebius";
            models.push(Model { name, mesh: import.mesh, clean });
        }
        assert!(models.len() - before >= least, "{} of the {part} models give a mesh", models.len() - before);
    }
    models
}

/// The clean ones of the real models, by name.
pub(crate) fn real_models() -> Vec<(String, Mesh)> {
    all_models().into_iter().filter(|model| model.clean).map(|model| (model.name, model.mesh)).collect()
}
