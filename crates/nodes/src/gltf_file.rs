//! glTF models.

use std::io;
use std::sync::Arc;

use glam::Vec4;
use pelage_field::{ColourField, Image, ScalarField};
use pelage_graph::{Context, Evaluate, FilePath, Node, NodeError};
use pelage_mesh::{GltfImport, Mesh, RepairReport};

use crate::images::Pixels;

/// A model read from a glTF 2.0 file: all that its scene shows, as one surface (L1, L18).
#[derive(Node)]
#[node(category = "Models", version = 1)]
#[output(mesh: Mesh, "The surface, with the texture coordinates and colours of its vertices; what is no surface is mended.")]
#[output(repairs: RepairReport, "What it took to make it one, counted.")]
#[output(colours: ColourField, "The base colour of the materials, their image and the colour of the vertices, multiplied.")]
#[output(lengths: ScalarField, "Their alpha, multiplied: 1 is full length, 0 is bare.")]
pub struct GltfFile {
    /// The file, `.glb` or `.gltf`.
    #[param]
    pub path: FilePath,
    /// The files beside it that it names, buffers and images; a `.glb` mostly has none.
    #[param(default = Vec::new())]
    pub beside: Vec<FilePath>,
}

impl Evaluate for GltfFile {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let path = self.path.as_path();
        let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let import =
            pelage_mesh::parse_gltf(&bytes, &mut |name| self.read(name)).map_err(|error| format!("{}: {error}", path.display()))?;
        let (mut colours, mut lengths) = (None, None);
        if cx.wants("colours") || cx.wants("lengths") {
            let (colour, length) = base_colours(&import)?;
            (colours, lengths) = (Some(Arc::new(colour)), Some(Arc::new(length)));
        }
        Ok(GltfFileOutputs { mesh: Some(Arc::new(import.mesh)), repairs: Some(Arc::new(import.repairs)), colours, lengths })
    }
}

impl GltfFile {
    /// Only what the graph names is read, so that a change of any file is a change of the graph.
    fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        let named = self.beside.iter().find(|file| file.as_path().ends_with(name));
        let file = named.ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, format!("list it in `beside`, as \"{name}\"")))?;
        std::fs::read(file.as_path())
    }
}

/// At each vertex the mean over its corners of what their materials make of image and colour.
fn base_colours(import: &GltfImport) -> Result<(ColourField, ScalarField), NodeError> {
    let pixels = import.images.iter().map(|image| Pixels::decode(&image.bytes, &image.name)).collect::<Result<Vec<_>, _>>()?;
    let images: Vec<Image<'_>> = pixels.iter().map(Pixels::image).collect::<Result<_, _>>()?;
    let field = ColourField::from_corners(&import.mesh, |corner| {
        let material = import.material(corner.face().index());
        let image = material.image.zip(corner.texture_coordinates()).map_or(Vec4::ONE, |(image, place)| images[image].at(place));
        let own = import.mesh.colours().map_or(Vec4::ONE, |colours| colours[corner.origin().index()]);
        material.base_colour * image * own
    })?;
    Ok(field)
}
