//! The parts of shells and coats that are made only where a picture needs them.

use pelage_graph::Part;

/// The innermost shell's image, which the skin shows.
pub const SKIN: Part = Part { name: "skin", doc: "the innermost shell's image, which the skin shows" };
/// The shells above the skin.
pub const LAYERS: Part = Part { name: "layers", doc: "the shells above the skin" };
/// Coarser levels of detail.
pub const LEVELS: Part = Part { name: "levels", doc: "coarser levels of detail" };
/// The direction map.
pub const DIRECTIONS: Part = Part { name: "directions", doc: "the direction map" };
/// The fin, and the edges that fins stand on.
pub const FINS: Part = Part { name: "fins", doc: "the fin, and the edges that fins stand on" };
/// By what each place answers light: its colour, and the mean direction of its hair.
pub const LOOKS: Part = Part { name: "looks", doc: "the colour and the hair's mean direction at each place" };
