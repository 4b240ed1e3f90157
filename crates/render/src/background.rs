//! What is behind the model in a picture.

use pelage_coat::Background;
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages, ColorTargetState, ColorWrites, CompareFunction,
    DepthStencilState, Device, FragmentState, PipelineCompilationOptions, PrimitiveState, Queue, RenderPass, RenderPipeline,
    RenderPipelineDescriptor, ShaderModuleDescriptor, ShaderSource, VertexState,
};

use crate::{RenderError, Target};

/// Draws the ramp.
#[derive(Debug)]
pub(crate) struct BackgroundPass {
    pipeline: RenderPipeline,
    ramp: Buffer,
    bind_group: BindGroup,
}

impl BackgroundPass {
    pub(crate) fn new(device: &Device, target: Target) -> Self {
        let module = device.create_shader_module(ShaderModuleDescriptor {
            label: Some("background"),
            source: ShaderSource::Wgsl(include_str!("shaders/background.wgsl").into()),
        });
        let pipeline = device.create_render_pipeline(&RenderPipelineDescriptor {
            label: Some("background"),
            layout: None,
            vertex: VertexState {
                module: &module,
                entry_point: Some("background_vertex"),
                compilation_options: PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: PrimitiveState::default(),
            depth_stencil: Some(DepthStencilState { depth_compare: Some(CompareFunction::Always), ..target.depth_state(false) }),
            multisample: target.multisample_state(),
            fragment: Some(FragmentState {
                module: &module,
                entry_point: Some("background_fragment"),
                compilation_options: PipelineCompilationOptions::default(),
                targets: &[Some(ColorTargetState { format: target.colour, blend: None, write_mask: ColorWrites::ALL })],
            }),
            multiview_mask: None,
            cache: None,
        });
        let ramp = device.create_buffer(&BufferDescriptor {
            label: Some("background"),
            size: 32,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bind_group = device.create_bind_group(&BindGroupDescriptor {
            label: Some("background"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[BindGroupEntry { binding: 0, resource: ramp.as_entire_binding() }],
        });
        Self { pipeline, ramp, bind_group }
    }

    /// Sets the colours for the frames submitted from now on.
    pub(crate) fn set(&self, queue: &Queue, background: &Background) -> Result<(), RenderError> {
        if !(background.top.is_finite() && background.bottom.is_finite()) {
            return Err(RenderError::View { what: "the background" });
        }
        let colours = [background.top.extend(0.0).to_array(), background.bottom.extend(0.0).to_array()];
        queue.write_buffer(&self.ramp, 0, bytemuck::cast_slice(&colours));
        Ok(())
    }

    pub(crate) fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}
