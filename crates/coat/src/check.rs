//! A coat whose arrays agree.

use crate::{Coat, Encoding, FinTexture, MipImage, ShellTexture};

/// What is wrong with a coat's arrays.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CoatError {
    /// Arrays that go together differ in length.
    #[error("{array} has {length} entries where {expected} are needed")]
    Length {
        /// The array.
        array: &'static str,
        /// Its length.
        length: usize,
        /// The length of those it goes with.
        expected: usize,
    },
    /// An index points past the end.
    #[error("{array}[{at}] is {index}, but only {count} exist")]
    Index {
        /// The array.
        array: &'static str,
        /// Which entry.
        at: usize,
        /// What it says.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// An entry is less than the one before where they must not fall.
    #[error("{array}[{at}] is less than the entry before it")]
    Order {
        /// The array.
        array: &'static str,
        /// Which entry.
        at: usize,
    },
    /// A number is NaN or infinite.
    #[error("{array}[{at}] is not finite")]
    NotFinite {
        /// The array.
        array: &'static str,
        /// Which entry.
        at: usize,
    },
    /// A texture's bytes do not fit its size.
    #[error("level {level} of the {texture} texture: {width} × {height} × {layers} texels need {expected} bytes, not {length}")]
    Texture {
        /// Shell or fin.
        texture: &'static str,
        /// Level of detail.
        level: usize,
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
        /// Layers.
        layers: u32,
        /// Bytes needed.
        expected: usize,
        /// Bytes there.
        length: usize,
    },
    /// A level of a texture is not half of the one before, or there are more levels than halvings.
    #[error(
        "level {level} of the {texture} texture is {width} × {height}, but half of the level before, at least one texel, is {expected_width} × {expected_height}"
    )]
    MipChain {
        /// Shell or fin.
        texture: &'static str,
        /// Level of detail.
        level: usize,
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
        /// Texels across that are needed.
        expected_width: u32,
        /// Texels down that are needed.
        expected_height: u32,
    },
    /// The frame does not lead back to the model.
    #[error("the frame's diameter must be finite and positive, and its centre finite")]
    Frame,
    /// A shell that is not one.
    #[error("shell {shell} of level {level}: {what}")]
    Shell {
        /// Level of detail.
        level: usize,
        /// Which of its shells.
        shell: usize,
        /// What is wrong, and what is needed.
        what: &'static str,
    },
    /// Levels of detail that do not halve.
    #[error("level {level} has {found} shells; half of the level before, rounded up, is {expected}")]
    Level {
        /// Level of detail.
        level: usize,
        /// Its shells.
        found: usize,
        /// As many as it must have.
        expected: usize,
    },
    /// Images that do not part into mixtures.
    #[error("{images} images cannot be shared out to {mixtures} mixtures of hair: give each as many, and one mixture at least")]
    Mixtures {
        /// The mixtures.
        mixtures: u32,
        /// The images of all of them.
        images: u32,
    },
    /// Fin and shells do not go together.
    #[error(
        "the fin has {fin} mixtures of hair, the shells have {shells}: make both of the same hair with as many mixtures, or the fin with one"
    )]
    FinMixtures {
        /// Those of the shells.
        shells: u32,
        /// Those of the fin.
        fin: u32,
    },
    /// A mixture that is not made as the first is.
    #[error("mixture {mixture} is not as the first: {what}; make all of them with the same settings")]
    Mixture {
        /// Which.
        mixture: usize,
        /// What differs.
        what: &'static str,
    },
    /// A texture without layers, levels or texels.
    #[error("the {0} texture is empty; give it at least one layer, level and texel")]
    EmptyTexture(&'static str),
}

impl Coat {
    /// Checks that lengths agree, indices exist, numbers are finite and textures are whole; who draws calls it first.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn check(&self) -> Result<(), CoatError> {
        if !(self.frame.centre.is_finite() && self.frame.diameter.is_finite() && self.frame.diameter > 0.0) {
            return Err(CoatError::Frame);
        }
        self.check_surface()?;
        self.check_patches()?;
        self.check_edges()?;
        self.shells.check()?;
        let Some(fin) = &self.fin else { return Ok(()) };
        fin.check()?;
        // One fin serves all; and a bare skin has one mixture, whatever the fins have.
        let alike = fin.mixtures == 1 || fin.mixtures == self.shells.mixtures || self.shells.layers() == 1;
        if alike { Ok(()) } else { Err(CoatError::FinMixtures { shells: self.shells.mixtures, fin: fin.mixtures }) }
    }

    fn check_surface(&self) -> Result<(), CoatError> {
        let surface = &self.surface;
        let arrays = [
            ("surface.positions", &surface.positions),
            ("surface.normals", &surface.normals),
            ("surface.offsets", &surface.offsets),
            ("surface.bends", &surface.bends),
            ("surface.directions", &surface.directions),
            ("surface.colours", &surface.colours),
        ];
        for (name, array) in arrays {
            check_length(name, array.len(), surface.positions.len())?;
            check_finite(name, array.iter().map(|v| v.is_finite()))?;
        }
        for (name, array) in [("surface.ends", &surface.ends), ("surface.mixes", &surface.mixes)] {
            check_length(name, array.len(), surface.positions.len())?;
            check_finite(name, array.iter().map(|number| number.is_finite()))?;
        }
        Ok(())
    }

    fn check_patches(&self) -> Result<(), CoatError> {
        let patches = &self.patches;
        check_length("patches.coordinates", patches.coordinates.len(), patches.vertices.len())?;
        check_finite("patches.coordinates", patches.coordinates.iter().map(|c| c.is_finite()))?;
        if !patches.opacities.is_empty() {
            check_length("patches.opacities", patches.opacities.len(), patches.vertices.len())?;
            check_finite("patches.opacities", patches.opacities.iter().map(|opacity| opacity.is_finite()))?;
        }
        check_indices("patches.vertices", patches.vertices.iter().copied(), self.surface.positions.len())?;
        check_indices("patches.faces", patches.faces.iter().flatten().copied(), patches.vertices.len())?;
        check_indices("patches.patch_ends", patches.patch_ends.iter().copied(), patches.faces.len() + 1)?;
        if let Some(at) = patches.patch_ends.windows(2).position(|ends| ends[1] < ends[0]) {
            return Err(CoatError::Order { array: "patches.patch_ends", at: at + 1 });
        }
        check_length("patches.faces", patches.faces.len(), patches.patch_ends.last().map_or(0, |&end| end as usize))
    }

    fn check_edges(&self) -> Result<(), CoatError> {
        let edges = &self.edges;
        let count = edges.vertices.len();
        check_length("edges.intervals", edges.intervals.len(), count)?;
        check_length("edges.face_normals", edges.face_normals.len(), count)?;
        check_length("edges.curvatures", edges.curvatures.len(), count)?;
        check_indices("edges.vertices", edges.vertices.iter().flatten().copied(), self.surface.positions.len())?;
        check_finite("edges.intervals", edges.intervals.iter().map(|i| i[0].is_finite() && i[1].is_finite()))?;
        check_finite("edges.face_normals", edges.face_normals.iter().map(|n| n[0].is_finite() && n[1].is_finite()))?;
        check_finite("edges.curvatures", edges.curvatures.iter().map(|c| c.is_finite()))
    }
}

impl ShellTexture {
    /// Checks that images are whole and shells show images that exist; [`Coat::check`] does it too.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn check(&self) -> Result<(), CoatError> {
        check_texture("shell", self.encoding, self.images, &self.mips)?;
        check_mixtures(self.mixtures, self.images)?;
        if let Some(directions) = &self.directions {
            check_texture("direction", Encoding::Rgba8, self.images, directions)?;
            check_length("directions", directions.len(), self.mips.len())?;
            if (directions[0].width, directions[0].height) != (self.mips[0].width, self.mips[0].height) {
                return Err(CoatError::MipChain {
                    texture: "direction",
                    level: 0,
                    width: directions[0].width,
                    height: directions[0].height,
                    expected_width: self.mips[0].width,
                    expected_height: self.mips[0].height,
                });
            }
        }
        if self.layers() == 0 {
            return Err(CoatError::EmptyTexture("shell"));
        }
        let mut expected = self.layers() as usize;
        for (level, shells) in self.levels.iter().enumerate() {
            if shells.len() != expected {
                return Err(CoatError::Level { level, found: shells.len(), expected });
            }
            expected = expected.div_ceil(2);
            self.check_level(level)?;
        }
        Ok(())
    }

    fn check_level(&self, level: usize) -> Result<(), CoatError> {
        let within = |x: f32| (0.0..=1.0).contains(&x);
        for (shell, layer) in self.levels[level].iter().enumerate() {
            let before = shell.checked_sub(1).map_or(0.0, |before| self.levels[level][before].height);
            let faults = [
                (!within(layer.height) || !within(layer.light_height), "its heights must be 0 to 1"),
                (layer.height < before, "it must not stand below the shell before it"),
                (shell == 0 && layer.height != 0.0, "the innermost must stand on the skin, at height 0"),
                (layer.image >= self.images / self.mixtures, "it shows an image past the end of the stack"),
                (!within(layer.opacity), "its opacity must be 0 to 1"),
                (!(layer.layers.is_finite() && layer.layers >= 0.0), "its number of layers must be finite and not negative"),
                (
                    level > 0 && self.levels[level - 1].get(2 * shell).is_none_or(|finer| finer.height != layer.height),
                    "it must stand where every second shell of the finer level does",
                ),
            ];
            if let Some(&(_, what)) = faults.iter().find(|(wrong, _)| *wrong) {
                return Err(CoatError::Shell { level, shell, what });
            }
        }
        Ok(())
    }
}

impl FinTexture {
    /// Checks that images are whole; [`Coat::check`] does it too.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn check(&self) -> Result<(), CoatError> {
        check_texture("fin", Encoding::Rgba8, self.mixtures, &self.mips)
    }
}

/// Each mixture has as many images.
fn check_mixtures(mixtures: u32, images: u32) -> Result<(), CoatError> {
    if mixtures > 0 && images.is_multiple_of(mixtures) { Ok(()) } else { Err(CoatError::Mixtures { mixtures, images }) }
}

fn check_length(array: &'static str, length: usize, expected: usize) -> Result<(), CoatError> {
    if length == expected { Ok(()) } else { Err(CoatError::Length { array, length, expected }) }
}

fn check_finite(array: &'static str, mut finite: impl Iterator<Item = bool>) -> Result<(), CoatError> {
    finite.position(|finite| !finite).map_or(Ok(()), |at| Err(CoatError::NotFinite { array, at }))
}

fn check_indices(array: &'static str, indices: impl Iterator<Item = u32>, count: usize) -> Result<(), CoatError> {
    for (at, index) in indices.enumerate() {
        if index as usize >= count {
            return Err(CoatError::Index { array, at, index, count });
        }
    }
    Ok(())
}

fn check_texture(texture: &'static str, encoding: Encoding, layers: u32, mips: &[MipImage]) -> Result<(), CoatError> {
    if layers == 0 || mips.is_empty() {
        return Err(CoatError::EmptyTexture(texture));
    }
    let (mut expected_width, mut expected_height) = (mips[0].width, mips[0].height);
    for (level, mip) in mips.iter().enumerate() {
        let (width, height) = (mip.width, mip.height);
        if width == 0 || height == 0 {
            return Err(CoatError::EmptyTexture(texture));
        }
        // Past one texel there is nothing left to halve.
        let spent = level > 0 && mips[level - 1].width == 1 && mips[level - 1].height == 1;
        if spent || (width, height) != (expected_width, expected_height) {
            return Err(CoatError::MipChain { texture, level, width, height, expected_width, expected_height });
        }
        (expected_width, expected_height) = ((width / 2).max(1), (height / 2).max(1));
        let (expected, length) = (encoding.bytes(width, height).saturating_mul(layers as usize), mip.texels.len());
        if length != expected {
            return Err(CoatError::Texture { texture, level, width, height, layers, expected, length });
        }
    }
    Ok(())
}
