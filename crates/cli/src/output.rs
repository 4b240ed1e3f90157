//! Results: to standard output, or to a file that is whole or not there.

use std::io::{ErrorKind, Write};
use std::path::Path;

use crate::failure::Failure;

/// Prints; a reader that went away, as `head` does, is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::input("standard output", &error)),
        _ => Ok(()),
    }
}

/// Writes a file under a temporary name beside it and renames it, so that a failure leaves what was there before.
///
/// A link is followed, and what is no regular file (a pipe, a device) is written to: neither is replaced.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let special = target.metadata().is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir());
    if special {
        return std::fs::write(&target, bytes).map_err(|error| Failure::input(path.display(), &error));
    }
    replace_file(&target, bytes)
}

/// Writes several files into a folder. All are written whole beside it first, so that a failure leaves the folder as it was; other files in it stay.
pub(crate) fn write_files<N: AsRef<str>>(folder: &Path, files: &[(N, Vec<u8>)]) -> Result<(), Failure> {
    let parent = match folder.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let write = || -> std::io::Result<()> {
        std::fs::create_dir_all(parent)?;
        let whole = tempfile::Builder::new().prefix(".pelage-").tempdir_in(parent)?;
        for (name, bytes) in files {
            std::fs::write(whole.path().join(name.as_ref()), bytes)?;
        }
        std::fs::create_dir_all(folder)?;
        files.iter().try_for_each(|(name, _)| std::fs::rename(whole.path().join(name.as_ref()), folder.join(name.as_ref())))
    };
    write().map_err(|error| Failure::input(folder.display(), &error))
}

/// That files can be written into a folder: it is one, or is not there yet.
pub(crate) fn check_folder(folder: &Path) -> Result<(), Failure> {
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::Usage(format!("-o {}: that is a file; name a folder", folder.display())));
    }
    Ok(())
}

fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let write = || -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        let mut file = tempfile::Builder::new().prefix(".pelage-").tempfile_in(folder)?;
        file.write_all(bytes)?;
        make_readable(file.path())?;
        file.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|error| Failure::input(path.display(), &error))
}

/// A temporary file is its owner's alone; a result has the usual permissions.
#[cfg(unix)]
fn make_readable(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &Path) -> std::io::Result<()> {
    Ok(())
}
