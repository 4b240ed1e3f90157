//! Textures of coats that become each other (L24): one after the other, the hair at evenly spaced places in the row, each a *mixture* of two coats or one alone.

use crate::{CoatError, Encoding, FinTexture, MipImage, ShellLayer, ShellTexture};

impl ShellTexture {
    /// Stacks of the same shells as the mixtures of one. Light is taken at the mean of the heights that they say.
    ///
    /// # Errors
    /// No stack, one that is not whole, or [`CoatError::Mixture`] where one is not made as the first is.
    pub fn joined(stacks: &[Self]) -> Result<Self, CoatError> {
        let first = stacks.first().ok_or(CoatError::EmptyTexture("shell"))?;
        for (mixture, stack) in stacks.iter().enumerate() {
            stack.check()?;
            first.alike(stack).map_or(Ok(()), |what| Err(CoatError::Mixture { mixture, what }))?;
        }
        let directions: Option<Vec<&[MipImage]>> = stacks.iter().map(|stack| stack.directions.as_deref()).collect();
        Ok(Self {
            mixtures: stacks.iter().map(|stack| stack.mixtures).sum(),
            images: stacks.iter().map(|stack| stack.images).sum(),
            mips: one_after_the_other(&stacks.iter().map(|stack| &stack.mips[..]).collect::<Vec<_>>()),
            levels: mean_levels(stacks),
            directions: directions.map(|maps| one_after_the_other(&maps)),
            encoding: first.encoding,
        })
    }

    /// The stack of one mixture, as it would be alone; `None` past the last.
    pub fn mixture(&self, mixture: u32) -> Option<Self> {
        if mixture >= self.mixtures {
            return None;
        }
        let images = self.images / self.mixtures;
        let part =
            |mips: &[MipImage], encoding: Encoding| mips.iter().map(|mip| images_of(mip, encoding, mixture * images, images)).collect();
        Some(Self {
            mixtures: 1,
            images,
            mips: part(&self.mips, self.encoding),
            levels: self.levels.clone(),
            directions: self.directions.as_ref().map(|map| part(map, Encoding::Rgba8)),
            encoding: self.encoding,
        })
    }

    /// What of another stack is not as it is in this one.
    fn alike(&self, other: &Self) -> Option<&'static str> {
        let sizes = |mips: &[MipImage]| mips.iter().map(|mip| (mip.width, mip.height)).collect::<Vec<_>>();
        let shells = |stack: &Self| -> Vec<Vec<[u32; 4]>> {
            let shell = |layer: &ShellLayer| [layer.height.to_bits(), layer.image, layer.opacity.to_bits(), layer.layers.to_bits()];
            stack.levels.iter().map(|level| level.iter().map(shell).collect()).collect()
        };
        let unlike = [
            (self.encoding != other.encoding, "its images are in another encoding"),
            (self.images / self.mixtures.max(1) != other.images / other.mixtures.max(1), "it has another number of images"),
            (sizes(&self.mips) != sizes(&other.mips), "its images are of another size"),
            (shells(self) != shells(other), "its shells stand elsewhere or show other images"),
            (self.directions.is_some() != other.directions.is_some(), "only one of the two has a direction map"),
        ];
        unlike.into_iter().find_map(|(unlike, what)| unlike.then_some(what))
    }
}

impl FinTexture {
    /// Fins of the same size as the mixtures of one.
    ///
    /// # Errors
    /// No fin, or [`CoatError::Mixture`] where one is not of the first one's size.
    pub fn joined(fins: &[Self]) -> Result<Self, CoatError> {
        let first = fins.first().ok_or(CoatError::EmptyTexture("fin"))?;
        let sizes = |fin: &Self| fin.mips.iter().map(|mip| (mip.width, mip.height)).collect::<Vec<_>>();
        for (mixture, fin) in fins.iter().enumerate() {
            fin.check()?;
            if sizes(fin) != sizes(first) || fin.tiles_across != first.tiles_across {
                return Err(CoatError::Mixture { mixture, what: "it is of another size" });
            }
        }
        Ok(Self {
            tiles_across: first.tiles_across,
            mixtures: fins.iter().map(|fin| fin.mixtures).sum(),
            mips: one_after_the_other(&fins.iter().map(|fin| &fin.mips[..]).collect::<Vec<_>>()),
        })
    }
}

/// The images of several stacks with equal mips, level by level.
fn one_after_the_other(stacks: &[&[MipImage]]) -> Vec<MipImage> {
    let Some(first) = stacks.first() else { return Vec::new() };
    let level = |level: usize| MipImage {
        texels: stacks.iter().flat_map(|stack| stack[level].texels.iter().copied()).collect(),
        width: first[level].width,
        height: first[level].height,
    };
    (0..first.len()).map(level).collect()
}

/// Some of the images of a level.
fn images_of(mip: &MipImage, encoding: Encoding, first: u32, count: u32) -> MipImage {
    let bytes = encoding.bytes(mip.width, mip.height);
    MipImage { texels: mip.texels[first as usize * bytes..(first + count) as usize * bytes].to_vec(), width: mip.width, height: mip.height }
}

/// The shells, lit at the mean of the heights that each stack says.
fn mean_levels(stacks: &[ShellTexture]) -> Vec<Vec<ShellLayer>> {
    let mut levels = stacks[0].levels.clone();
    for (level, shells) in levels.iter_mut().enumerate() {
        for (place, shell) in shells.iter_mut().enumerate() {
            let sum: f32 = stacks.iter().map(|stack| stack.levels[level][place].light_height * stack.mixtures as f32).sum();
            shell.light_height = sum / stacks.iter().map(|stack| stack.mixtures as f32).sum::<f32>();
        }
    }
    levels
}
