//! A fin that somebody drew.

use pelage_coat::FinTexture;
use pelage_graph::{Context, Evaluate, FilePath, Node, NodeError};

use super::convert::fin_texture;

/// An artist's image as the fin (L9): the skin at its bottom, the tips at its top, repeating across.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(fin: FinTexture, "The fin.")]
pub struct FinImage {
    /// A PNG or JPEG file. Sides that are no powers of two become the next larger.
    #[param]
    pub path: FilePath,
    /// How many tiles of hair its width shows.
    #[param(default = 3, range = 1..=64, unit = "tiles", effect = "more: narrower hair on the fins, which repeat less; none on cost")]
    pub tiles_across: u32,
}

impl Evaluate for FinImage {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let path = self.path.as_path();
        let image = image::open(path).map_err(|error| format!("{}: {error}", path.display()))?.into_rgba8();
        let fin = pelage_volume::fin_from_pixels(image.as_raw(), image.width(), image.height(), self.tiles_across)?;
        Ok(fin_texture(fin).into())
    }
}
