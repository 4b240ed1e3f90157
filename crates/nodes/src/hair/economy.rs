//! Shells made fewer, smaller or coarser: what goes between sampling and the coat.

use std::sync::Arc;

use pelage_coat::{Encoding, ShellTexture};
use pelage_graph::{Context, Evaluate, Needs, Node, NodeError, Param, Params, Part, Wanted};
use pelage_volume::{OneLayerFit, Spacing};

use super::convert::{compressed_texture, shell_stack, shell_texture};
use super::row::each_mixture;
use super::sample::ShellSpacing;
use crate::parts::{DIRECTIONS, LAYERS, LEVELS};

/// The wanted parts, but for coarser levels of detail: what is read by a node that makes its own, or leaves them out.
fn finest(wanted: &Wanted<'_>) -> impl Iterator<Item = Part> {
    wanted.parts().filter(|&part| part != LEVELS)
}

/// Coarser shells of the same hair for the distance: pairs composited again and again, down to one (L16).
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(shells: ShellTexture, "The same shells, and every coarser level of detail; 2 N - 1 images for N.", parts = [LAYERS, LEVELS, DIRECTIONS])]
pub struct LevelsOfDetail {
    /// The shells; their finest level is what the others are made of.
    #[input]
    pub shells: Arc<ShellTexture>,
}

impl Evaluate for LevelsOfDetail {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        match (cx.wants_part("shells", LEVELS), self.shells.encoding) {
            (true, _) => Ok(each_mixture(&self.shells, |shells| Ok(shell_texture(shell_stack(shells)?.with_levels()?)))?.into()),
            // Blocks are decoded, as they are with levels.
            (false, Encoding::Bc3) => Ok(each_mixture(&self.shells, |shells| Ok(shell_texture(shell_stack(shells)?)))?.into()),
            (false, Encoding::Rgba8) => Ok(Arc::clone(&self.shells).into()),
        }
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        let needs = Needs::all();
        if !wanted.part(LEVELS) {
            return needs.parts("shells", finest(wanted));
        }
        // The coarsest is all layers in one.
        needs.parts("shells", finest(wanted).chain([LAYERS])).present(LAYERS)
    }
}

/// The same images shown by another number of shells (K5), at other heights (K4).
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(shells: ShellTexture, "The shells, and those images that one of them shows. One level of detail.", parts = [LAYERS, DIRECTIONS])]
pub struct ShareImages {
    /// The shells that have the images.
    #[input]
    pub shells: Arc<ShellTexture>,
    /// How many shells show them, the skin included.
    #[param(default = 60, range = 1..=256, unit = "shells", effect = "more: smoother fur at a slant; fragments are linear in it, memory is not")]
    pub count: u32,
    /// Where they stand.
    #[param(default = ShellSpacing::Even)]
    pub spacing: ShellSpacing,
    /// Whether hair stays as dense as it was, by shells that are the more transparent the more of them show an image. Without, each shows it whole.
    #[param(default = true)]
    pub keep_density: bool,
}

impl Evaluate for ShareImages {
    fn evaluate(&self, cx: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        // The first is the skin, whatever shares the others.
        let count = if cx.wants_part("shells", LAYERS) { self.count } else { 1 };
        let shells = each_mixture(&self.shells, |shells| {
            let shared = shell_stack(shells)?.shared(count, Spacing::from(&self.spacing))?;
            Ok(shell_texture(if self.keep_density { shared } else { shared.repeated() }))
        })?;
        Ok(shells.into())
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        Needs::all().parts("shells", finest(wanted))
    }
}

/// What becomes of hair that one image cannot stand for.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum NotStraight {
    /// The shells stay as they are.
    Keep,
    /// The node fails, and says by how much.
    Refuse,
}

/// How far shells are from one image tapered by an alpha ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneLayerReport {
    /// Whether the image stands for them.
    pub kept: bool,
    /// Error of alpha over alpha, root mean squares both.
    pub unlikeness: f64,
    /// Root mean square of alpha's error.
    pub alpha_rms: f64,
    /// Alpha's largest error.
    pub alpha_largest: f64,
    /// Root mean square of linear colour's error.
    pub colour_rms: f64,
    /// Colour's largest error.
    pub colour_largest: f64,
}

/// Straight hair noticed: one image of it kept, which all shells show, tapered by an alpha ramp (L22).
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(
    shells: ShellTexture,
    "A skin and one image, if they will do, with one level of detail; else the shells as they were.",
    parts = [LAYERS, LEVELS, DIRECTIONS]
)]
#[output(report: OneLayerReport, "How far the shells are from one image.")]
pub struct OneLayer {
    /// The shells.
    #[input]
    pub shells: Arc<ShellTexture>,
    /// How unlike one image they may be: the error of alpha over alpha, root mean squares both.
    #[param(default = 0.25, range = 0.0..=1.0, unit = "fraction", effect = "larger: more coats in an eighth of the memory, leaning hair stands up and taper is a fade")]
    pub tolerance: f64,
    /// What becomes of hair that is less straight.
    #[param(default = NotStraight::Keep)]
    pub otherwise: NotStraight,
}

impl Evaluate for OneLayer {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        // Coats that become each other have no one ramp: they are judged by the first and stay as they are.
        let first = self.shells.mixture(0).ok_or("the shells have no images; sample some hair")?;
        let stack = shell_stack(&first)?;
        let fit = OneLayerFit::of(&stack)?;
        let kept = fit.unlikeness <= self.tolerance && self.shells.mixtures == 1;
        if !kept && self.otherwise == NotStraight::Refuse {
            return Err(format!(
                "the shells are unlike one image by {:.3} of their coverage, more than the tolerance of {:.3}: keep them, let the hair stand straighter, or allow more",
                fit.unlikeness, self.tolerance
            )
            .into());
        }
        let report = OneLayerReport {
            kept,
            unlikeness: fit.unlikeness,
            alpha_rms: fit.alpha_rms,
            alpha_largest: fit.alpha_largest,
            colour_rms: fit.colour_rms,
            colour_largest: fit.colour_largest,
        };
        let shells = if kept { Arc::new(shell_texture(fit.stack(&stack))) } else { Arc::clone(&self.shells) };
        Ok(OneLayerOutputs { shells: Some(shells), report: Some(Arc::new(report)) })
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        // By the layers it decides what it hands on.
        Needs::all().parts("shells", wanted.parts().chain([LAYERS]))
    }
}

/// How compressed images are handed on.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum BlockForm {
    /// As blocks: a quarter of the memory. Needs a graphics adapter with block compression (BC).
    Blocks,
    /// Decoded to texels again: the same picture on any adapter, and no memory saved.
    Texels,
}

/// Images compressed in blocks (BC3), each as dense as it was (L22).
#[derive(Node)]
#[node(category = "Hair", version = 1)]
#[output(shells: ShellTexture, "The shells with their images in blocks; a direction map stays as it is.", parts = [LAYERS, LEVELS, DIRECTIONS])]
pub struct CompressShells {
    /// The shells, with all levels of detail that they are to have.
    #[input]
    pub shells: Arc<ShellTexture>,
    /// How they are handed on.
    #[param(default = BlockForm::Blocks)]
    pub form: BlockForm,
}

impl Evaluate for CompressShells {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let shells = each_mixture(&self.shells, |shells| {
            let stack = shell_stack(shells)?;
            Ok(match (&self.form, shells.encoding) {
                // Compressed once, it is what it is.
                (BlockForm::Blocks, Encoding::Bc3) => shells.clone(),
                (BlockForm::Texels, Encoding::Bc3) => shell_texture(stack),
                (BlockForm::Blocks, Encoding::Rgba8) => compressed_texture(stack.compressed()),
                (BlockForm::Texels, Encoding::Rgba8) => shell_texture(stack.compressed().decoded()),
            })
        })?;
        Ok(shells.into())
    }

    fn needs(wanted: &Wanted<'_>, _: &Params<'_>) -> Needs {
        Needs::all().parts("shells", wanted.parts())
    }
}
