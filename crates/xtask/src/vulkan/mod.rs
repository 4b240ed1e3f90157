//! Is there something to draw with? Where not, Mesa's software driver is installed if that can be done without asking.

mod find;
mod install;

use std::env;
use std::path::Path;

use crate::failure::{Failure, Result};
use find::Found;

/// Makes sure of a Vulkan loader and at least one driver on Linux; macOS draws with Metal and Windows with DirectX 12, which need
/// nothing of us.
///
/// What is looked at is files, not devices: a driver for a card that is not there passes, and drawing then says so (exit code 3).
pub(crate) fn make_sure() -> Result<()> {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    let look = || find::look(Path::new("/"), |name| env::var_os(name));
    let found = look();
    if found.is_complete() {
        println!("Vulkan: {found}");
        return Ok(());
    }
    println!("Vulkan: {found}");
    install::install(&install::System::of(Path::new("/")))?;
    let found = look();
    if found.is_complete() { Ok(()) } else { Err(still_missing(&found)) }
}

fn still_missing(found: &Found) -> Failure {
    Failure::new(format!("the packages were installed, but still: {found}"))
        .remedy("see that VK_DRIVER_FILES and VK_ICD_FILENAMES, if set, name manifests that exist")
}
