//! Pictures put together.

use std::sync::Arc;

use pelage_graph::{Context, Evaluate, Node, NodeError};
use pelage_render::{FrameStats, Picture};

/// Two pictures of one height beside each other; in a chain, any number.
#[derive(Node)]
#[node(category = "Picture", version = 1)]
#[output(image: Picture, "Both.")]
pub struct SideBySide {
    /// The left one.
    #[input]
    pub left: Arc<Picture>,
    /// The right one.
    #[input]
    pub right: Arc<Picture>,
}

impl Evaluate for SideBySide {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let (left, right) = (&self.left, &self.right);
        if left.height != right.height {
            return Err(format!(
                "the left picture is {} pixels high, the right one {}; give both the same height",
                left.height, right.height
            )
            .into());
        }
        let (width, height) = (left.width + right.width, left.height);
        let joined = |left_bytes: &[u8], right_bytes: &[u8], each: usize| -> Vec<u8> {
            let (across, more) = (each * left.width as usize, each * right.width as usize);
            (0..height as usize).flat_map(|row| [row_of(left_bytes, row, across), row_of(right_bytes, row, more)].concat()).collect()
        };
        let rgba = joined(&left.rgba, &right.rgba, 4);
        let coverage = joined(&left.coverage, &right.coverage, 1);
        Ok(Picture { width, height, rgba, coverage, frame: FrameStats::default() }.into())
    }
}

fn row_of(bytes: &[u8], row: usize, across: usize) -> &[u8] {
    &bytes[row * across..(row + 1) * across]
}
