//! glTF 2.0 files, binary (`.glb`) and text (`.gltf`).
//!
//! The crate `gltf` reads the document and checks that its indices lead somewhere; [`accessor`] reads numbers out of the bytes it names, which it does not check;
//! [`scene`] walks the nodes; [`gather`] joins all primitives to polygons, which are [repaired](crate::repair) like those of any other file.

mod accessor;
mod beside;
mod error;
mod gather;
mod material;
mod note;
mod scene;

use std::path::Path;

use glam::Vec4;

use crate::{Mesh, RepairError, RepairReport, RepairSettings, repair};

pub use beside::Beside;
pub use error::{GltfError, GltfFault};
pub use material::{GltfImage, GltfMaterial};
pub use note::GltfNote;

use beside::Buffers;
use gather::Gathered;

/// A file whose nodes show more faces than this is refused: a mesh may be shown by many nodes, so that a small file can ask for any number.
pub const MOST_GLTF_FACES: usize = 16_000_000;

/// A scene read from a glTF file as one surface, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfImport {
    /// The surface, with texture coordinates if any primitive has them (u to the right, v up) and colours if any has them.
    pub mesh: Mesh,
    /// What was mended.
    pub repairs: RepairReport,
    /// What was left out.
    pub notes: Vec<GltfNote>,
    /// Every material that a face has.
    pub materials: Vec<GltfMaterial>,
    /// Which of [`GltfImport::materials`] each face has.
    pub material_of_face: Vec<u32>,
    /// The images that materials name, as they are in their files: PNG or JPEG.
    pub images: Vec<GltfImage>,
}

impl GltfImport {
    /// The material of a face, by its number.
    pub fn material(&self, face: usize) -> &GltfMaterial {
        &self.materials[self.material_of_face[face] as usize]
    }
}

/// Reads a glTF file and what it names beside itself; see [`parse_gltf`].
///
/// # Errors
/// Where a file cannot be read, lies outside the folder, says what is no glTF, or has no surface.
pub fn read_gltf(path: &Path) -> Result<GltfImport, GltfError> {
    let in_file = |error: GltfError| error.in_file(path);
    let bytes = std::fs::read(path).map_err(|error| in_file(GltfFault::Unreadable(error).into()))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    parse_gltf(&bytes, &mut |name| std::fs::read(folder.join(name))).map_err(in_file)
}

/// Reads the content of a glTF file; `beside` gives the bytes of files that it names, by their path relative to it.
///
/// All triangles of the default scene (the first, if none is said to be) are joined, each moved as its nodes say; wound the other way where that mirrors them. A primitive without
/// texture coordinates has (0, 0) where others have some, one without colours is white. Of a material its base colour is read. Skins, morph targets and animations are left out
/// with a note: a skinned mesh stands as it was bound. Normals, lines and points are passed over.
///
/// # Errors
/// Where the bytes are no glTF, ask for an extension, have sparse accessors, name bytes that are not there, show more than [`MOST_GLTF_FACES`], or give no surface.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [2, 2, 2]}],
///     "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
///     "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]}],
///     "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "corners.bin"}]}"#;
/// let corners = [0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// let import = pelage_mesh::parse_gltf(text.as_bytes(), &mut |_| Ok(corners.iter().flat_map(|x| x.to_le_bytes()).collect()))?;
/// assert_eq!(import.mesh.area(), 2.0);
/// # Ok(())
/// # }
/// ```
pub fn parse_gltf(bytes: &[u8], beside: &mut Beside<'_>) -> Result<GltfImport, GltfError> {
    check_header(bytes)?;
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(bytes).map_err(error::of_library)?;
    if let Some(needed) = document.extensions_required().next() {
        return Err(GltfFault::Extension(note::legible(needed)).into());
    }
    check_positions(document.as_json())?;
    let document = gltf::Document::from_json(document.into_json()).map_err(error::of_library)?;
    let mut buffers = Buffers::new(&document, blob, beside);
    let placed = scene::placed_meshes(&document)?;
    let Gathered { soup, primitives, materials, material_of_polygon, notes } = Gathered::from(&placed, &mut buffers)?;
    let (materials, images) = material::read(&document, &materials, &mut buffers)?;
    let repaired = repair(soup, &RepairSettings::default()).map_err(|error| primitives.locate(error))?;
    let material_of_face = repaired.polygons.iter().map(|&polygon| material_of_polygon[polygon as usize]).collect();
    let notes = notes.into_iter().chain(note::of_document(&document)).collect();
    Ok(GltfImport { mesh: repaired.mesh, repairs: repaired.report, notes, materials, material_of_face, images })
}

/// The library takes the length of a binary file to be at least that of its header.
fn check_header(bytes: &[u8]) -> Result<(), GltfError> {
    let length = bytes.get(8..12).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
    if bytes.starts_with(b"glTF") && length.is_none_or(|length| length < 12 || length as usize > bytes.len()) {
        return Err(GltfFault::CutShort { said: length.unwrap_or(0), there: bytes.len() }.into());
    }
    Ok(())
}

/// The library looks into the accessors of positions before it has checked that they are there.
fn check_positions(json: &gltf::json::Root) -> Result<(), GltfError> {
    let positions = gltf::json::validation::Checked::Valid(gltf::Semantic::Positions);
    let primitives =
        json.meshes.iter().enumerate().flat_map(|(mesh, its)| its.primitives.iter().enumerate().map(move |(k, its)| (mesh, k, its)));
    let count = json.accessors.len();
    for (mesh, primitive, its) in primitives {
        if let Some(accessor) = its.attributes.get(&positions).map(gltf::json::Index::value).filter(|&index| index >= count) {
            let said = format!("mesh {mesh}, primitive {primitive} names accessor {accessor}, but there are {count}");
            return Err(GltfFault::Broken(said).into());
        }
    }
    Ok(())
}

/// White and opaque: the colour of what has none.
const WHITE: Vec4 = Vec4::ONE;

impl From<RepairError> for GltfFault {
    fn from(error: RepairError) -> Self {
        Self::Repair(error)
    }
}
