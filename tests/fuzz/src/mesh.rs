//! Import and repair of meshes.

use glam::{DVec2, DVec3};
use pelage_mesh::{GltfImport, Import, Mesh, RepairSettings, Soup, parse_gltf, parse_obj};

/// Any bytes are an OBJ file or not; if they are, its mesh is sound, and the same bits the next time.
pub fn obj(bytes: &[u8]) {
    let Ok(import) = parse_obj(bytes) else { return };
    check(&import.mesh);
    assert_eq!(import.face_lines.len(), import.mesh.topology().face_count());
    let again = parse_obj(bytes).is_ok_and(|again: Import| again == import);
    assert!(again, "another result the second time");
}

/// Any bytes are a glTF file or not; if they are, its mesh is sound, and the same bits the next time. Whatever file it names beside itself has a few numbers in it.
pub fn gltf(bytes: &[u8]) {
    let parse = || {
        let numbers = [0.0_f32, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 2.0, f32::NAN];
        parse_gltf(bytes, &mut |_| Ok(numbers.iter().flat_map(|number| number.to_le_bytes()).collect()))
    };
    let Ok(import) = parse() else { return };
    check(&import.mesh);
    assert_eq!(import.material_of_face.len(), import.mesh.topology().face_count());
    assert!(
        import.materials.iter().all(|material| material.image.is_none_or(|image| image < import.images.len())),
        "an image that is none"
    );
    assert!(import.material_of_face.iter().all(|&material| (material as usize) < import.materials.len()), "a material that is none");
    let again = parse().is_ok_and(|again: GltfImport| again == import);
    assert!(again, "another result the second time");
}

/// Any polygons give a sound mesh or an error, the same bits the next time, and a mesh once repaired has nothing left to mend.
///
/// Bytes are read as places on a small grid, so that faces without area, coincident vertices and crowded edges are the rule.
pub fn repair(bytes: &[u8]) {
    let Some(soup) = soup(bytes) else { return };
    let settings = RepairSettings::default();
    let Ok(repaired) = pelage_mesh::repair(soup.clone(), &settings) else { return };
    check(&repaired.mesh);
    assert_eq!(repaired.polygons.len(), repaired.mesh.topology().face_count());
    let again = pelage_mesh::repair(soup, &settings).is_ok_and(|again| again == repaired);
    assert!(again, "another result the second time");
}

/// The first byte says how many vertices there are, and whether they have texture coordinates; three bytes give each a place; of the rest the high ones end
/// polygons, the others are corners.
fn soup(bytes: &[u8]) -> Option<Soup> {
    let (&first, rest) = bytes.split_first()?;
    let count = usize::from(first >> 1).max(1);
    let (places, corners) = rest.split_at_checked(3 * count)?;
    let place = |b: &[u8]| DVec3::from_slice(&b.iter().map(|&b| f64::from(b % 5)).collect::<Vec<_>>());
    let mut soup = Soup { positions: places.chunks_exact(3).map(place).collect(), ..Soup::default() };
    for &byte in corners {
        if byte >= 192 {
            soup.ends.push(soup.corners.len() as u32);
        } else {
            soup.corners.push(u32::from(byte) % count as u32);
        }
    }
    soup.ends.push(soup.corners.len() as u32);
    if first & 1 == 1 {
        soup.texture_coordinates = soup.positions.iter().map(|p| DVec2::new(p.x, p.y)).collect();
        soup.corner_coordinates.clone_from(&soup.corners);
    }
    Some(soup)
}

fn check(mesh: &Mesh) {
    assert_eq!(mesh.topology().check(), Ok(()));
    assert!(mesh.positions().iter().all(|p| p.is_finite()), "a place that is none");
    assert!(mesh.texture_coordinates().is_none_or(|all| all.iter().all(|c| c.is_finite())), "texture coordinates that are none");
    assert!(mesh.colours().is_none_or(|all| all.iter().all(|c| c.is_finite())), "a colour that is none");
    assert!(mesh.topology().face_count() > 0 && mesh.topology().referenced_vertex_count() == mesh.topology().vertex_count());
    assert!(mesh.vertex_normals().iter().all(|n| n.is_finite()), "a normal that is none");
}
