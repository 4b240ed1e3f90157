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

    /// The names, sorted and without their ending, of the RON files in a folder.
    #[cfg(feature = "checks")]
    pub(crate) fn ron_names(&self, relative: &str) -> Result<Vec<String>> {
        let folder = self.at(relative);
        let failed = |cause| Failure::caused(folder.display(), cause);
        let mut names = Vec::new();
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.extension().is_some_and(|extension| extension == "ron") {
                names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
            }
        }
        names.sort();
        Ok(names)
    }

    /// The root itself.
    #[cfg(feature = "checks")]
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }
}
