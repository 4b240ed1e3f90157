//! What the tests of repair share.
#![allow(dead_code, clippy::unwrap_used, reason = "a test may fail, and each test file uses its own part")]

use glam::DVec3;
use pelage_mesh::{Mesh, RepairReport, RepairSettings, Repaired, Soup, Summary, repair};

pub(crate) const NONE: RepairReport = RepairReport::NONE;

pub(crate) fn mend(soup: Soup) -> Repaired {
    let repaired = repair(soup, &RepairSettings::default()).unwrap();
    assert_eq!(repaired.mesh.topology().check(), Ok(()));
    assert_eq!(repaired.polygons.len(), repaired.mesh.topology().face_count());
    repaired
}

pub(crate) fn soup_of(mesh: &Mesh) -> Soup {
    Soup::from_polygons(mesh.positions().to_vec(), mesh.topology().triangles())
}

pub(crate) fn flat(points: &[(f64, f64)]) -> Vec<DVec3> {
    points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
}

pub(crate) fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.topology().triangles().collect()
}

/// Vertices, edges, boundary edges, faces, loops, components, genus.
pub(crate) fn counts(mesh: &Mesh) -> [usize; 7] {
    let s = Summary::of(mesh);
    [s.vertices, s.edges, s.boundary_edges, s.faces, s.boundary_loops, s.components, s.genus]
}
