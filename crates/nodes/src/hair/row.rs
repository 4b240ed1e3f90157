//! Coats in a row: one tile that becomes another from place to place (L24).

use std::sync::Arc;

use pelage_coat::{CoatError, ShellTexture};
use pelage_graph::{Context, Evaluate, Node, NodeError};
use pelage_strand::StrandTile;

/// Coats in a row, of which each becomes the next: all hair of the first at 0, of the second at 1, and so on; between them some hairs of either, each whole, as many as keep the density.
///
/// Where on the creature which coat stands is for `LayFur` to say. A row can be part of a row. Boxes of hair are stretched to the highest; the coat's lengths say how long each is.
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(strands: StrandTile, "The hair of all coats.")]
pub struct CoatsInARow {
    /// The first coat's hair.
    #[input]
    pub first: Arc<StrandTile>,
    /// The second coat's.
    #[input]
    pub second: Arc<StrandTile>,
    /// The third coat's.
    #[input]
    pub third: Option<Arc<StrandTile>>,
    /// The fourth coat's.
    #[input]
    pub fourth: Option<Arc<StrandTile>>,
}

impl Evaluate for CoatsInARow {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let tiles: Vec<&StrandTile> = [Some(&self.first), Some(&self.second), self.third.as_ref(), self.fourth.as_ref()]
            .into_iter()
            .flatten()
            .map(AsRef::as_ref)
            .collect();
        Ok(StrandTile::row(&tiles)?.into())
    }
}

/// What is made of the hair at evenly spaced places in a row of coats, `steps` from each to the next; of one coat, of all its hair.
pub(super) fn mixtures<T>(
    strands: &StrandTile,
    steps: u32,
    sample: impl Fn(&StrandTile) -> Result<T, NodeError>,
) -> Result<Vec<T>, NodeError> {
    if strands.coats() == 1 {
        return Ok(vec![sample(strands)?]);
    }
    (0..=(strands.coats() - 1) * steps).map(|step| sample(&strands.at(f64::from(step) / f64::from(steps)))).collect()
}

/// One that holds all of them; of one itself.
pub(super) fn joined<T>(mixtures: Vec<T>, join: impl Fn(&[T]) -> Result<T, CoatError>) -> Result<T, NodeError> {
    match <[T; 1]>::try_from(mixtures) {
        Ok([one]) => Ok(one),
        Err(all) => Ok(join(&all)?),
    }
}

/// The shells with each mixture's changed for itself.
pub(super) fn each_mixture(
    shells: &ShellTexture,
    change: impl Fn(&ShellTexture) -> Result<ShellTexture, NodeError>,
) -> Result<ShellTexture, NodeError> {
    shells.check()?;
    if shells.mixtures == 1 {
        return change(shells);
    }
    let changed: Vec<ShellTexture> =
        (0..shells.mixtures).filter_map(|mixture| shells.mixture(mixture)).map(|one| change(&one)).collect::<Result<_, _>>()?;
    Ok(ShellTexture::joined(&changed)?)
}
