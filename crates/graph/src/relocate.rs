//! A graph that moves to another folder, while the files that it names stay.

use std::io;
use std::path::{Component, Path, PathBuf};

use crate::check::is_link;
use crate::files::{holds_files, with_paths};
use crate::graph::Graph;
use crate::registry::Registry;

/// Why a graph's paths could not be written from another folder.
#[derive(Debug, thiserror::Error)]
pub enum RelocateError {
    /// A folder cannot be looked at.
    #[error("{folder}: {source}", folder = folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The way from one folder to the other is no Unicode, so that no graph file could hold it.
    #[error("the way from {to} to {from} is no Unicode text; choose another folder", from = from.display(), to = to.display())]
    NotText {
        /// Where the paths began.
        from: PathBuf,
        /// Where they were to begin.
        to: PathBuf,
    },
}

impl Graph {
    /// Moves the graph to another folder: each relative path, written or default, becomes the one that leads to the same file from there. Absolute paths stay. The folder need not exist yet.
    ///
    /// # Errors
    /// If either folder cannot be looked at, or the way from one to the other cannot be written.
    pub fn relocate(&mut self, registry: &Registry, directory: &Path) -> Result<(), RelocateError> {
        let located = |folder: &Path| located(folder).map_err(|source| RelocateError::Folder { folder: folder.to_owned(), source });
        let (from, to) = (located(&self.directory)?, located(directory)?);
        let way = way(&from, &to).ok_or_else(|| RelocateError::NotText { from: from.clone(), to: to.clone() })?;
        directory.clone_into(&mut self.directory);
        if way.is_empty() {
            return Ok(());
        }
        for node in self.nodes.values_mut() {
            for param in registry.specification(&node.kind).into_iter().flat_map(|specification| &specification.params) {
                let given = node.field(&param.name, &param.was).or(param.default.as_ref());
                let Some(value) = given.filter(|given| holds_files(&param.ty) && !is_link(&param.ty, given)) else { continue };
                let moved = with_paths(&param.ty, value, &|path| joined(&way, path));
                if moved != *value {
                    node.give(&param.name, &param.was, moved);
                }
            }
        }
        Ok(())
    }
}

/// The folder without links and `..` in its path, as far as it exists.
fn located(folder: &Path) -> io::Result<PathBuf> {
    let absolute = std::path::absolute(if folder.as_os_str().is_empty() { Path::new(".") } else { folder })?;
    let mut ancestors = absolute.ancestors().filter_map(|ancestor| Some((ancestor, ancestor.canonicalize().ok()?)));
    let (existing, mut located) = ancestors.next().ok_or(io::ErrorKind::NotFound)?;
    for component in absolute.strip_prefix(existing).into_iter().flat_map(Path::components) {
        match component {
            Component::ParentDir => drop(located.pop()),
            other => located.push(other),
        }
    }
    Ok(located)
}

/// The steps from one folder to another: up, then down; those of a whole path where there is no way, as from one drive to another. None if they are no text.
fn way(from: &Path, to: &Path) -> Option<Vec<String>> {
    let shared = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return Some(vec![from.to_str()?.to_owned()]);
    }
    let up = to.components().skip(shared).map(|_| Some("..".to_owned()));
    let down = from.components().skip(shared).map(|component| component.as_os_str().to_str().map(str::to_owned));
    up.chain(down).collect()
}

/// A path that began where `way` leads to, from where that begins.
fn joined(way: &[String], path: &str) -> String {
    if Path::new(path).has_root() || Path::new(path).is_absolute() {
        return path.to_owned();
    }
    // The way leads through no links, so a step up takes back a step down; those of the path itself are left as they are.
    let (mut steps, mut rest) = (way.to_vec(), Path::new(path).components().peekable());
    while let Some(component) = rest.next_if(|component| matches!(component, Component::ParentDir | Component::CurDir)) {
        match (component, steps.last()) {
            (Component::CurDir, _) => {}
            (_, Some(last)) if last != ".." => drop(steps.pop()),
            _ => steps.push("..".to_owned()),
        }
    }
    steps.extend(rest.map(|component| component.as_os_str().to_string_lossy().into_owned()));
    steps.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_and_paths_are_joined() {
        let way = |from: &str, to: &str| way(Path::new(from), Path::new(to)).unwrap().join("/");
        assert_eq!(way("/a/b", "/a/b"), "");
        assert_eq!(way("/a/b", "/a/c/d"), "../../b");
        assert_eq!(way("/a", "/a/c"), "..");
        assert_eq!(way("/a/b", "/a"), "b");
        let joined = |way: &[&str], path: &str| joined(&way.iter().map(|&step| step.to_owned()).collect::<Vec<_>>(), path);
        assert_eq!(joined(&["..", "b"], "models/bunny.obj"), "../b/models/bunny.obj");
        assert_eq!(joined(&["..", "b"], "./../images/fin.png"), "../images/fin.png");
        assert_eq!(joined(&["b"], "../../x.obj"), "../x.obj");
        // Where a link may be on the way, nothing is taken back.
        assert_eq!(joined(&["b"], "link/../x.obj"), "b/link/../x.obj");
        assert_eq!(joined(&["b"], "/x.obj"), "/x.obj");
    }
}
