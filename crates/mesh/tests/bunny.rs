//! The model that the project ships.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

use std::path::Path;

use pelage_mesh::{Summary, read_obj};

#[test]
fn the_shipped_bunny_is_closed_and_wound_outwards() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/models/bunny.obj");
    let import = read_obj(&path).unwrap();
    assert!(import.repairs.is_none() && import.notes.is_empty(), "{import:?}");
    let mesh = import.mesh;
    assert_eq!(mesh.topology().check(), Ok(()));
    let summary = Summary::of(&mesh);
    assert_eq!((summary.vertices, summary.faces, summary.unreferenced_vertices), (1839, 3674, 0));
    assert!(summary.is_closed() && summary.signed_volume > 0.0, "{summary:?}");
    assert_eq!((summary.genus, summary.components, summary.euler_characteristic), (0, 1, 2));
    assert_eq!(summary.faces_without_area, 0);
    // Up is y: the ears are the highest, far above the middle.
    let (low, high) = mesh.bounds().unwrap();
    let centre = mesh.positions().iter().sum::<glam::DVec3>() / mesh.positions().len() as f64;
    assert!(centre.y < 0.5 * (low.y + high.y));
}
