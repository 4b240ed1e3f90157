//! What is drawn into.

use wgpu::{CompareFunction, DepthStencilState, MultisampleState, TextureFormat, TextureView};

/// The render pass that the pipelines are made for: a caller's, or [`crate::Offscreen`]'s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// Format of the colour attachment; sRGB or float, so that blending is linear. With plain `Unorm` colours come out too dark.
    pub colour: TextureFormat,
    /// Format of the depth attachment, which every pass tests.
    pub depth: TextureFormat,
    /// Depth 1 is near and 0 far, as [`pelage_coat::Camera`] projects; otherwise 0 is near.
    pub reversed_depth: bool,
    /// Samples a pixel.
    pub samples: u32,
}

/// What has been drawn so far, to look for what hides fur.
#[derive(Clone, Copy, Debug)]
pub struct DepthBuffer<'a> {
    /// The depth attachment, of which the whole is drawn into; its texture is made with `TEXTURE_BINDING`. Of a format with a stencil too, a view of
    /// [`wgpu::TextureAspect::DepthOnly`]. What it takes to look into it is kept until another view is given.
    pub view: &'a TextureView,
    /// Width and height, in pixels; at most 65,535 each.
    pub size: (u32, u32),
}

impl Target {
    /// A target with reversed `Depth32Float`.
    pub fn new(colour: TextureFormat, samples: u32) -> Self {
        Self { colour, depth: TextureFormat::Depth32Float, reversed_depth: true, samples }
    }

    /// What clears the depth attachment.
    pub fn clear_depth(&self) -> f32 {
        if self.reversed_depth { 0.0 } else { 1.0 }
    }

    pub(crate) fn depth_state(&self, write: bool) -> DepthStencilState {
        // "Or equal": a layer of little height may lie exactly on the skin.
        let compare = if self.reversed_depth { CompareFunction::GreaterEqual } else { CompareFunction::LessEqual };
        DepthStencilState {
            format: self.depth,
            depth_write_enabled: Some(write),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }
    }

    pub(crate) fn multisample_state(&self) -> MultisampleState {
        MultisampleState { count: self.samples, ..MultisampleState::default() }
    }
}
