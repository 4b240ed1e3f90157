//! Installs Mesa's software Vulkan driver on Debian and its kin, or says what to do.

use std::fs;
use std::path::Path;

use crate::failure::{Failure, Result};
use crate::process::CommandLine;

/// Mesa's drivers, the software one (lavapipe) among them, and the loader.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// Which system this is, as far as its packages go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum System {
    /// Debian, Ubuntu and what is made of them: apt.
    Debian,
    /// Fedora and its kin: dnf.
    Fedora,
    /// Arch and its kin: pacman.
    Arch,
    /// Anything else.
    Other,
}

impl System {
    /// From `etc/os-release` below `root`.
    pub(crate) fn of(root: &Path) -> Self {
        Self::named(&fs::read_to_string(root.join("etc/os-release")).unwrap_or_default())
    }

    /// From the `ID` and `ID_LIKE` lines of an os-release file.
    fn named(release: &str) -> Self {
        let fields = release.lines().filter_map(|line| line.strip_prefix("ID=").or_else(|| line.strip_prefix("ID_LIKE=")));
        for name in fields.flat_map(|value| value.trim_matches(['"', '\'']).split_whitespace()) {
            match name {
                "debian" | "ubuntu" => return Self::Debian,
                "fedora" | "rhel" => return Self::Fedora,
                "arch" => return Self::Arch,
                _ => {}
            }
        }
        Self::Other
    }

    /// What a person types to install a loader and a software driver.
    fn remedy(self) -> String {
        match self {
            Self::Debian => format!("install them: sudo apt-get update && sudo apt-get install -y {}", PACKAGES.join(" ")),
            Self::Fedora => "install them: sudo dnf install -y mesa-vulkan-drivers vulkan-loader".to_owned(),
            Self::Arch => "install them: sudo pacman -S --needed vulkan-swrast vulkan-icd-loader".to_owned(),
            Self::Other => {
                "install your system's Vulkan loader (libvulkan.so.1) and a driver: the card's own, or Mesa's software one, lavapipe"
                    .to_owned()
            }
        }
    }
}

/// Installs the packages on Debian and its kin as root or with a sudo that does not ask; fails with the line to type elsewhere.
pub(crate) fn install(system: &System) -> Result<()> {
    let missing = || Failure::new("there is no Vulkan loader or no driver to draw with").remedy(system.remedy());
    if *system != System::Debian {
        return Err(missing());
    }
    let apt_get = privileged().ok_or_else(missing)?;
    println!("installing {}…", PACKAGES.join(" and "));
    // One source of several may be out of reach; whether the packages can be had is for the install to say.
    let updated = apt_get.clone().with(["update"]).status()?;
    if !updated.success() {
        println!("apt-get update ended with {updated}; trying to install all the same");
    }
    apt_get.with(["install", "-y", "--no-install-recommends"]).with(PACKAGES).run()
}

/// `apt-get` with the rights to install, if they can be had without asking.
fn privileged() -> Option<CommandLine> {
    let quietly = |line: CommandLine| line.command().output().ok().filter(|output| output.status.success());
    let is_root = quietly(CommandLine::new("id").with(["-u"])).is_some_and(|output| output.stdout.trim_ascii() == b"0");
    // `env`, as sudo drops variables; the lock is waited for, as a fresh machine may be at its first upgrade.
    let apt_get = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-o", "DPkg::Lock::Timeout=300"];
    if is_root {
        return Some(CommandLine::new(apt_get[0]).with(&apt_get[1..]));
    }
    quietly(CommandLine::new("sudo").with(["-n", "true"]))?;
    Some(CommandLine::new("sudo").with(["-n"]).with(apt_get))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_are_told_by_their_names() {
        for (release, system) in [
            ("PRETTY_NAME=\"Debian GNU/Linux 12\"\nID=debian\n", System::Debian),
            ("ID=linuxmint\nID_LIKE=\"ubuntu debian\"\n", System::Debian),
            ("ID=pop\nID_LIKE=\"ubuntu debian\"", System::Debian),
            ("ID=\"rocky\"\nID_LIKE=\"rhel centos fedora\"\n", System::Fedora),
            ("ID=arch\n", System::Arch),
            ("ID=nixos\nVARIANT_ID=debian\n", System::Other),
            ("", System::Other),
        ] {
            assert_eq!(System::named(release), system, "{release}");
        }
    }

    #[test]
    fn other_systems_are_told_what_to_do() {
        for (system, hint) in [(System::Fedora, "dnf"), (System::Arch, "pacman"), (System::Other, "libvulkan.so.1")] {
            let failure = install(&system).unwrap_err();
            assert!(failure.to_string().contains(hint) && failure.code() == 1, "{failure}");
        }
    }
}
