//! What can go wrong when drawing.

use pelage_coat::CoatError;
use pelage_lighting::TableError;

/// Why nothing was drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The machine has no graphics adapter that wgpu can use.
    #[error(
        "no graphics adapter found ({reason}); install a driver, or on Debian and Ubuntu the software one: apt-get install mesa-vulkan-drivers libvulkan1"
    )]
    NoAdapter {
        /// What wgpu says.
        reason: String,
    },
    /// The adapter does not hand out a device.
    #[error("the graphics adapter {adapter} gives no device: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// What wgpu says.
        reason: String,
    },
    /// The coat's arrays do not agree.
    #[error("this coat cannot be drawn: {0}")]
    Coat(#[from] CoatError),
    /// The lighting table cannot be made.
    #[error("this view cannot be lit: {0}")]
    Table(#[from] TableError),
    /// More of something than the device holds.
    #[error("{what}: {needed} are needed, but this graphics device takes at most {limit}")]
    Limit {
        /// What there is too much of, and how to have less.
        what: &'static str,
        /// How many are needed.
        needed: u64,
        /// How many it takes.
        limit: u64,
    },
    /// More lights than a frame has room for.
    #[error("{found} directional lights; a view takes at most {limit}, so leave some out or add them to the ambient light")]
    Lights {
        /// How many there are.
        found: usize,
        /// How many there can be.
        limit: usize,
    },
    /// Textures in a form that the device cannot read.
    #[error("the shell texture is {what}, which this graphics device does not read; {remedy}")]
    Encoding {
        /// In which form.
        what: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// A number of samples that a picture cannot have.
    #[error("{samples} samples a pixel are not possible on this adapter; ask for 1 or 4")]
    Samples {
        /// The number asked for.
        samples: u32,
    },
    /// A camera, light or shading that is no number, or a camera that looks nowhere.
    #[error(
        "the view cannot be drawn: {what} is not finite; check that the eye is not at the target, up not along the view, and near above 0"
    )]
    View {
        /// What.
        what: &'static str,
    },
    /// A matrix of negative determinant.
    #[error("place {place} of the crowd mirrors the coat, which would show its insides; mirror the mesh instead")]
    Mirrored {
        /// Which place.
        place: usize,
    },
    /// wgpu refused something: a mistake of this crate.
    #[error("the graphics device reported: {0}")]
    Validation(String),
    /// The device went away, or did not give the pixels back.
    #[error("the graphics device was lost: {0}; make a new one and upload again")]
    Lost(String),
}
