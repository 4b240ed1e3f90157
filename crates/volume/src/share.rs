//! More shells than images, or fewer (K5).

use crate::error::{VolumeError, within};
use crate::heights::Spacing;
use crate::image::ShellStack;
use crate::shell::Shell;
use crate::shells::MOST_LAYERS;

impl ShellStack {
    /// The same images drawn by another number of shells, at other heights (Kenwright 2014: 20 textures shared by 60 shells).
    ///
    /// Every shell above the skin shows the image whose own shell is nearest. *m* shells that share one image stand for 1/*m* of its layer each, so that together they
    /// cover what it does: 1 − Π(1 − αₖ) with αₖ = 1 − (1 − α)^(1/m). An image that no shell shows gives its layer to the shell nearest to it, so that as many layers' worth of hair is left
    /// as there was: exact where layers cover alike, as layers of noise do.
    ///
    /// Nothing here knows the strands. Hair that leans is the truer for being sampled anew at those heights ([`crate::ShellSettings::spacing`]), and must not go through this as well: its
    /// shells stand for one layer each as they are. Coarser levels are left out, as are images that no shell shows.
    ///
    /// # Errors
    /// A number of shells outside 1 to 256, a spacing out of range, no shells to share, or only a skin where more is wanted.
    pub fn shared(&self, shells: u32, spacing: Spacing) -> Result<Self, VolumeError> {
        within("shells", f64::from(shells), 1.0, f64::from(MOST_LAYERS), "shells")?;
        spacing.validate()?;
        let source = self.levels.first().map_or(&[][..], Vec::as_slice);
        let Some((skin, hair)) = source.split_first() else { return Err(VolumeError::NoHairShells) };
        if hair.is_empty() && shells > 1 {
            return Err(VolumeError::NoHairShells);
        }
        let heights: Vec<f32> = spacing.heights(shells).into_iter().map(|height| height as f32).collect();
        let drawn: Vec<Shell> = [*skin].into_iter().chain(shared(hair, &heights[1..])).collect();
        Ok(Self { levels: vec![drawn], ..self.clone() }.finest())
    }

    /// The same shells, each showing its image whole, as programs without an opacity rule draw them: hair gets denser with the number of shells. What
    /// [`shared`](Self::shared) is measured against.
    #[must_use]
    pub fn repeated(mut self) -> Self {
        self.levels.iter_mut().flatten().for_each(|shell| shell.layers = 1.0);
        self
    }
}

/// The shells above the skin.
fn shared(hair: &[Shell], heights: &[f32]) -> Vec<Shell> {
    let shows: Vec<usize> = heights.iter().map(|&height| nearest(hair.iter().map(|shell| shell.height), height)).collect();
    let mut layers = vec![0.0f32; heights.len()];
    for (source, shell) in hair.iter().enumerate() {
        let sharers = shows.iter().filter(|&&shown| shown == source).count();
        if sharers > 0 {
            let share = shell.layers / sharers as f32;
            layers.iter_mut().zip(&shows).filter(|&(_, &shown)| shown == source).for_each(|(layers, _)| *layers += share);
        } else if let Some(layers) = layers.get_mut(nearest(heights.iter().copied(), shell.height)) {
            *layers += shell.layers;
        }
    }
    let drawn = heights.iter().zip(shows).zip(layers);
    drawn.map(|((&height, shows), layers)| Shell { height, light_height: height, layers, ..hair[shows] }).collect()
}

/// The number of the nearest height; of two as near, the lower.
fn nearest(heights: impl Iterator<Item = f32>, height: f32) -> usize {
    let apart = heights.map(|other| (other - height).abs()).enumerate();
    apart.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}
