//! A fin that somebody drew.

use pelage_coat::FinTexture;
use pelage_graph::{Context, Evaluate, FilePath, Node, NodeError};
use pelage_volume::Pixels;

use super::convert::fin_texture;
use crate::images::Pixels as ImageFile;

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
        let image = ImageFile::read(self.path.as_path())?.into_rgba8();
        let picture = Pixels { rgba: image.as_raw(), width: image.width(), height: image.height() };
        Ok(fin_texture(pelage_volume::fin_from_pixels(&picture, self.tiles_across)?).into())
    }
}
