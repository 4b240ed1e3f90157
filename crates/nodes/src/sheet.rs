//! Pictures put together.

use std::sync::Arc;

use pelage_graph::{Context, Evaluate, Node, NodeError, Param};
use pelage_render::{FrameStats, Picture};

/// How two pictures are put together.
#[derive(Clone, Debug, PartialEq, Eq, Param)]
pub enum Arranged {
    /// The left one to the left, both of one height.
    Beside,
    /// The left one above, both of one width.
    Below,
}

/// Two pictures beside each other, or one below the other; in a chain, any number.
#[derive(Node)]
#[node(category = "Picture", version = 1)]
#[output(image: Picture, "Both.")]
pub struct SideBySide {
    /// The left one, or the upper.
    #[input]
    pub left: Arc<Picture>,
    /// The right one, or the lower.
    #[input]
    pub right: Arc<Picture>,
    /// Where the second goes.
    #[param(default = Arranged::Beside)]
    pub arranged: Arranged,
}

impl Evaluate for SideBySide {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let (left, right) = (&self.left, &self.right);
        Ok(match self.arranged {
            Arranged::Beside => beside(left, right)?,
            Arranged::Below => below(left, right)?,
        }
        .into())
    }
}

fn beside(left: &Picture, right: &Picture) -> Result<Picture, NodeError> {
    if left.height != right.height {
        return Err(
            format!("the left picture is {} pixels high, the right one {}; give both the same height", left.height, right.height).into()
        );
    }
    let (width, height) = (left.width + right.width, left.height);
    let joined = |left_bytes: &[u8], right_bytes: &[u8], each: usize| -> Vec<u8> {
        let (across, more) = (each * left.width as usize, each * right.width as usize);
        (0..height as usize).flat_map(|row| [row_of(left_bytes, row, across), row_of(right_bytes, row, more)].concat()).collect()
    };
    let rgba = joined(&left.rgba, &right.rgba, 4);
    let coverage = joined(&left.coverage, &right.coverage, 1);
    Ok(Picture { width, height, rgba, coverage, frame: FrameStats::default() })
}

fn below(upper: &Picture, lower: &Picture) -> Result<Picture, NodeError> {
    if upper.width != lower.width {
        return Err(
            format!("the upper picture is {} pixels wide, the lower one {}; give both the same width", upper.width, lower.width).into()
        );
    }
    let (width, height) = (upper.width, upper.height + lower.height);
    let rgba = [&upper.rgba[..], &lower.rgba[..]].concat();
    let coverage = [&upper.coverage[..], &lower.coverage[..]].concat();
    Ok(Picture { width, height, rgba, coverage, frame: FrameStats::default() })
}

fn row_of(bytes: &[u8], row: usize, across: usize) -> &[u8] {
    &bytes[row * across..(row + 1) * across]
}
