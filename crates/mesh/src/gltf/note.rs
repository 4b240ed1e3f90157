//! What a reader of a file should know, though nothing had to be mended.

use std::fmt;

use gltf::Document;

/// Something of a glTF file that was left out.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GltfNote {
    /// Points and lines.
    NotTriangles {
        /// Primitives that are.
        primitives: usize,
    },
    /// Meshes that hang on a skin stand as they were bound.
    Skins {
        /// How many.
        meshes: usize,
    },
    /// Other shapes of a mesh.
    MorphTargets {
        /// Primitives that have some.
        primitives: usize,
    },
    /// Animations.
    Animations {
        /// How many.
        count: usize,
    },
    /// Extensions that the file uses and can do without.
    Extensions {
        /// Their names.
        names: String,
    },
}

/// What of the document as a whole is left out.
pub(super) fn of_document(document: &Document) -> impl Iterator<Item = GltfNote> {
    let (count, used) = (document.animations().len(), &document.as_json().extensions_used);
    let names = used.iter().take(10).map(|name| legible(name)).collect::<Vec<String>>().join(", ");
    let animations = (count > 0).then_some(GltfNote::Animations { count });
    animations.into_iter().chain((!used.is_empty()).then_some(GltfNote::Extensions { names }))
}

/// A name of the file that may be shown: short, and without anything that a terminal might obey.
pub(super) fn legible(name: &str) -> String {
    name.chars().filter(char::is_ascii_graphic).take(40).collect()
}

impl fmt::Display for GltfNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotTriangles { primitives } => write!(f, "primitives of points or lines passed over: {primitives}"),
            Self::Skins { meshes } => write!(f, "meshes on a skin: {meshes}; they stand as they were bound"),
            Self::MorphTargets { primitives } => write!(f, "primitives with other shapes: {primitives}; they keep their first"),
            Self::Animations { count } => write!(f, "animations passed over: {count}"),
            Self::Extensions { names } => write!(f, "extensions passed over: {names}"),
        }
    }
}
