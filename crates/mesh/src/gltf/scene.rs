//! The nodes of a scene.

use glam::{DMat4, Mat4};
use gltf::{Document, Mesh, Node};

use super::error::GltfFault;

/// A mesh where a node shows it.
pub(super) struct Placed<'a> {
    pub(super) mesh: Mesh<'a>,
    /// From the mesh's coordinates to the scene's.
    pub(super) transform: DMat4,
    /// Whether the node hangs it on a skin.
    pub(super) skinned: bool,
}

/// Every mesh that the default scene shows, in the order of its nodes, parents first. Without a default it is the first scene; without any, all nodes that nobody holds.
pub(super) fn placed_meshes(document: &Document) -> Result<Vec<Placed<'_>>, GltfFault> {
    let mut seen = vec![false; document.nodes().len()];
    let mut placed = Vec::new();
    let mut open: Vec<(Node<'_>, DMat4)> = roots(document).into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    while let Some((node, above)) = open.pop() {
        let index = node.index();
        if std::mem::replace(&mut seen[index], true) {
            return Err(GltfFault::NodeTwice { node: index });
        }
        let transform = above * Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
        if !transform.is_finite() {
            return Err(GltfFault::Transform { node: index });
        }
        if let Some(mesh) = node.mesh() {
            let skinned = node.skin().is_some();
            // Of what hangs on a skin the joints alone say where it is; as it was bound it is where its own coordinates say.
            placed.push(Placed { mesh, transform: if skinned { DMat4::IDENTITY } else { transform }, skinned });
        }
        let children: Vec<Node<'_>> = node.children().collect();
        open.extend(children.into_iter().rev().map(|child| (child, transform)));
    }
    Ok(placed)
}

fn roots(document: &Document) -> Vec<Node<'_>> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        return scene.nodes().collect();
    }
    let mut held = vec![false; document.nodes().len()];
    document.nodes().flat_map(|node| node.children()).for_each(|child| held[child.index()] = true);
    document.nodes().filter(|node| !held[node.index()]).collect()
}
