//! Where the repository is.

use std::env;
use std::path::{Path, PathBuf};

use crate::failure::{Failure, Result};

/// The repository this program was started from.
pub(crate) struct Place {
    root: PathBuf,
}

impl Place {
    /// The repository that holds this crate: cargo says at run time where that is, so that a moved checkout still works.
    pub(crate) fn find() -> Result<Self> {
        let manifest = env::var_os("CARGO_MANIFEST_DIR").map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
        let root = manifest.join("../..");
        let root = root.canonicalize().map_err(|cause| {
            Failure::caused(format_args!("the repository was looked for at {}", root.display()), cause)
                .remedy("run this by its alias from inside the repository, such as `cargo verify`")
        })?;
        Ok(Self { root })
    }

    /// A path in the repository, from its root.
    pub(crate) fn at(&self, relative: impl AsRef<Path>) -> PathBuf {
        self.root.join(relative)
    }

    /// The root itself.
    #[cfg(feature = "checks")]
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }
}
