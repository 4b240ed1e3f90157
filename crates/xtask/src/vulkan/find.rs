//! Looks for the Vulkan loader and for drivers, as the loader itself does.

use std::env;
use std::ffi::OsString;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

/// What was found.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Found {
    /// Is `libvulkan.so.1` there?
    pub(crate) loader: bool,
    /// The drivers' manifests, sorted.
    pub(crate) drivers: Vec<PathBuf>,
}

impl Found {
    /// Is there a loader and something for it to load?
    pub(crate) fn is_complete(&self) -> bool {
        self.loader && !self.drivers.is_empty()
    }
}

impl fmt::Display for Found {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(if self.loader { "loader found, " } else { "no loader (libvulkan.so.1), " })?;
        let name = |path: &PathBuf| path.file_stem().map(|name| name.to_string_lossy().into_owned());
        let names: Vec<String> = self.drivers.iter().filter_map(name).collect();
        if names.is_empty() { formatter.write_str("no driver") } else { write!(formatter, "drivers {}", names.join(", ")) }
    }
}

/// Looks below `root` (`/` but in tests) with the environment that `variable` gives.
pub(crate) fn look(root: &Path, variable: impl Fn(&str) -> Option<OsString>) -> Found {
    let mut drivers = drivers(root, &variable);
    drivers.sort();
    Found { loader: loader(root, &variable), drivers }
}

/// Where the loader's shared library may lie: the search path of the environment, the linker's usual folders with Debian's one
/// for each architecture, or anywhere that the linker's cache knows.
fn loader(root: &Path, variable: &impl Fn(&str) -> Option<OsString>) -> bool {
    const LIBRARY: &str = "libvulkan.so.1";
    let mut folders: Vec<PathBuf> = variable("LD_LIBRARY_PATH").map(|value| env::split_paths(&value).collect()).unwrap_or_default();
    for usual in ["lib", "lib64", "usr/lib", "usr/lib64", "usr/local/lib"] {
        let folder = root.join(usual);
        folders.extend(entries(&folder).filter(|entry| entry.to_string_lossy().contains("-linux-")));
        folders.push(folder);
    }
    let in_cache = || fs::read(root.join("etc/ld.so.cache")).is_ok_and(|cache| holds(&cache, LIBRARY.as_bytes()));
    folders.iter().any(|folder| folder.join(LIBRARY).exists()) || in_cache()
}

fn holds(bytes: &[u8], wanted: &[u8]) -> bool {
    bytes.windows(wanted.len()).any(|window| window == wanted)
}

/// The drivers' manifests. `VK_DRIVER_FILES`, or the older `VK_ICD_FILENAMES`, replaces the search; `VK_ADD_DRIVER_FILES` widens it
/// (Khronos, "Vulkan Loader: Driver Discovery").
fn drivers(root: &Path, variable: &impl Fn(&str) -> Option<OsString>) -> Vec<PathBuf> {
    let named = |name: &str| variable(name).filter(|value| !value.is_empty()).map(|value| env::split_paths(&value).collect::<Vec<_>>());
    if let Some(places) = named("VK_DRIVER_FILES").or_else(|| named("VK_ICD_FILENAMES")) {
        return places.iter().flat_map(|place| manifests(place)).collect();
    }
    let mut folders = named("VK_ADD_DRIVER_FILES").unwrap_or_default();
    for usual in ["usr/local/etc", "usr/local/share", "etc", "usr/share"] {
        folders.push(root.join(usual).join("vulkan/icd.d"));
    }
    for (name, below_home) in [("XDG_CONFIG_HOME", ".config"), ("XDG_DATA_HOME", ".local/share")] {
        let own = variable(name).map(PathBuf::from).or_else(|| Some(PathBuf::from(variable("HOME")?).join(below_home)));
        folders.extend(own.map(|folder| folder.join("vulkan/icd.d")));
    }
    folders.iter().flat_map(|place| manifests(place)).collect()
}

/// `place` itself if it is a file, else the manifests in the folder that it is.
fn manifests(place: &Path) -> Vec<PathBuf> {
    if place.is_file() {
        return vec![place.to_owned()];
    }
    entries(place).filter(|entry| entry.extension().is_some_and(|extension| extension == "json")).collect()
}

/// What a folder holds; nothing if it is not there.
fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> {
    fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A machine whose files are as named.
    fn machine(files: &[&str]) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        for file in files {
            let path = root.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "x").unwrap();
        }
        root
    }

    fn nothing(_: &str) -> Option<OsString> {
        None
    }

    #[test]
    fn a_bare_machine_has_neither() {
        let root = machine(&["usr/lib/libc.so.6", "usr/share/vulkan/icd.d/readme.txt", "usr/lib/libvulkan.so"]);
        let found = look(root.path(), nothing);
        assert_eq!(found, Found { loader: false, drivers: vec![] });
        assert_eq!(found.to_string(), "no loader (libvulkan.so.1), no driver");
    }

    #[test]
    fn the_loader_is_found_where_linkers_look() {
        for file in ["usr/lib/libvulkan.so.1", "usr/lib/x86_64-linux-gnu/libvulkan.so.1", "lib/aarch64-linux-gnu/libvulkan.so.1"] {
            assert!(look(machine(&[file]).path(), nothing).loader, "{file}");
        }
        assert!(!look(machine(&["opt/vulkan/libvulkan.so.1"]).path(), nothing).loader);
        let elsewhere = machine(&["opt/vulkan/libvulkan.so.1"]);
        let path = elsewhere.path().join("opt/vulkan");
        assert!(look(elsewhere.path(), |name| (name == "LD_LIBRARY_PATH").then(|| path.clone().into())).loader);
        let cached = machine(&[]);
        fs::create_dir(cached.path().join("etc")).unwrap();
        fs::write(cached.path().join("etc/ld.so.cache"), b"glibc\0libvulkan.so.1\0/opt/x/libvulkan.so.1\0").unwrap();
        assert!(look(cached.path(), nothing).loader);
    }

    #[test]
    fn a_loader_without_a_driver_is_not_enough() {
        let root = machine(&["usr/lib/libvulkan.so.1"]);
        assert!(!look(root.path(), nothing).is_complete());
        let root = machine(&["usr/share/vulkan/icd.d/lvp_icd.x86_64.json"]);
        assert!(!look(root.path(), nothing).is_complete());
        let root = machine(&["usr/lib/libvulkan.so.1", "etc/vulkan/icd.d/nvidia_icd.json"]);
        let found = look(root.path(), nothing);
        assert!(found.is_complete());
        assert_eq!(found.to_string(), "loader found, drivers nvidia_icd");
    }

    #[test]
    fn the_environment_replaces_or_widens_the_search() {
        let root = machine(&["usr/share/vulkan/icd.d/lvp.json", "opt/own.json", "home/me/.local/share/vulkan/icd.d/mine.json"]);
        let path = |relative: &str| root.path().join(relative);
        let with =
            |name: &'static str, value: PathBuf| look(root.path(), move |asked| (asked == name).then(|| value.clone().into())).drivers;
        assert_eq!(with("VK_DRIVER_FILES", path("opt/own.json")), [path("opt/own.json")]);
        assert_eq!(with("VK_ICD_FILENAMES", path("opt")), [path("opt/own.json")]);
        assert_eq!(with("VK_ICD_FILENAMES", path("nowhere.json")), Vec::<PathBuf>::new());
        assert_eq!(with("VK_DRIVER_FILES", PathBuf::new()), [path("usr/share/vulkan/icd.d/lvp.json")]);
        assert_eq!(with("VK_ADD_DRIVER_FILES", path("opt/own.json")).len(), 2);
        assert_eq!(with("HOME", path("home/me")).len(), 2);
    }
}
