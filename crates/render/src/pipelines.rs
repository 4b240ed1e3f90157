//! The pipelines of the three passes, made when first asked for.

use std::sync::OnceLock;

use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, BlendState, BufferBindingType, ColorTargetState,
    ColorWrites, Device, Face, FragmentState, PipelineCompilationOptions, PipelineLayout, PipelineLayoutDescriptor, PrimitiveState,
    PrimitiveTopology, RenderPipeline, RenderPipelineDescriptor, SamplerBindingType, ShaderModule, ShaderModuleDescriptor, ShaderSource,
    ShaderStages, TextureSampleType, TextureViewDimension, VertexBufferLayout, VertexState, VertexStepMode, vertex_attr_array,
};

use crate::pack::TileVertex;
use crate::{LightingMode, ShellDepth, Target};

/// A pass's file after the shared ones; WGSL has no includes.
macro_rules! shader {
    ($pass:literal) => {
        concat!(include_str!("shaders/common.wgsl"), include_str!("shaders/lighting.wgsl"), include_str!(concat!("shaders/", $pass)))
    };
}

/// What to draw with, for one view.
#[derive(Clone, Debug)]
pub(crate) struct PassPipelines {
    pub(crate) surface: RenderPipeline,
    pub(crate) fins: RenderPipeline,
    pub(crate) shells: RenderPipeline,
}

/// Layouts, shaders and the pipelines made so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    target: Target,
    pub(crate) frame_layout: BindGroupLayout,
    pub(crate) coat_layout: BindGroupLayout,
    layout: PipelineLayout,
    surface: ShaderModule,
    fins: ShaderModule,
    shells: ShaderModule,
    /// By lighting mode, then by shell depth.
    made: [[OnceLock<PassPipelines>; 2]; 3],
}

impl Pipelines {
    pub(crate) fn new(device: &Device, target: Target) -> Self {
        let frame_layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some("frame"), entries: &frame_entries() });
        let coat_layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some("coat"), entries: &coat_entries() });
        let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
            label: Some("fur"),
            bind_group_layouts: &[Some(&frame_layout), Some(&coat_layout)],
            immediate_size: 0,
        });
        let module = |label, source: &str| {
            device.create_shader_module(ShaderModuleDescriptor { label: Some(label), source: ShaderSource::Wgsl(source.into()) })
        };
        Self {
            target,
            frame_layout,
            coat_layout,
            layout,
            surface: module("surface", shader!("surface.wgsl")),
            fins: module("fins", shader!("fins.wgsl")),
            shells: module("shells", shader!("shells.wgsl")),
            made: Default::default(),
        }
    }

    /// The pipelines for a view's options.
    pub(crate) fn get(&self, device: &Device, lighting: LightingMode, depth: ShellDepth) -> PassPipelines {
        let lighting = match lighting {
            LightingMode::PerVertex => 0,
            LightingMode::Formula => 1,
            LightingMode::Table(_) => 2,
        };
        let written = matches!(depth, ShellDepth::Written { .. });
        self.made[lighting][usize::from(written)].get_or_init(|| self.make(device, lighting, written)).clone()
    }

    fn make(&self, device: &Device, lighting: usize, shells_write: bool) -> PassPipelines {
        let surface = Pass {
            module: &self.surface,
            vertex: "surface_vertex",
            fragment: "surface_fragment",
            tiles: true,
            // Where an open surface shows its back, it is skin all the same.
            primitive: PrimitiveState::default(),
            write_depth: true,
            blend: None,
        };
        let fins = Pass {
            module: &self.fins,
            vertex: "fin_vertex",
            fragment: "fin_fragment",
            tiles: false,
            primitive: PrimitiveState { topology: PrimitiveTopology::TriangleStrip, ..PrimitiveState::default() },
            write_depth: false,
            blend: Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
        };
        let shells = Pass {
            module: &self.shells,
            vertex: "shell_vertex",
            fragment: if shells_write { "shell_tested" } else { "shell_blended" },
            tiles: true,
            primitive: PrimitiveState { cull_mode: Some(Face::Back), ..PrimitiveState::default() },
            write_depth: shells_write,
            blend: Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
        };
        PassPipelines {
            surface: self.pipeline(device, &surface, lighting),
            fins: self.pipeline(device, &fins, lighting),
            shells: self.pipeline(device, &shells, lighting),
        }
    }

    fn pipeline(&self, device: &Device, pass: &Pass<'_>, lighting: usize) -> RenderPipeline {
        let constants = [("LIGHTING", lighting as f64)];
        let options = PipelineCompilationOptions { constants: &constants, ..PipelineCompilationOptions::default() };
        let attributes = vertex_attr_array![0 => Uint32, 1 => Float32x2];
        let tiles = [Some(VertexBufferLayout {
            array_stride: size_of::<TileVertex>() as u64,
            step_mode: VertexStepMode::Vertex,
            attributes: &attributes,
        })];
        device.create_render_pipeline(&RenderPipelineDescriptor {
            label: Some(pass.vertex),
            layout: Some(&self.layout),
            vertex: VertexState {
                module: pass.module,
                entry_point: Some(pass.vertex),
                compilation_options: options.clone(),
                buffers: if pass.tiles { &tiles } else { &[] },
            },
            primitive: pass.primitive,
            depth_stencil: Some(self.target.depth_state(pass.write_depth)),
            multisample: self.target.multisample_state(),
            fragment: Some(FragmentState {
                module: pass.module,
                entry_point: Some(pass.fragment),
                compilation_options: options,
                targets: &[Some(ColorTargetState { format: self.target.colour, blend: pass.blend, write_mask: ColorWrites::ALL })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// What differs between the passes.
struct Pass<'a> {
    module: &'a ShaderModule,
    vertex: &'a str,
    fragment: &'a str,
    tiles: bool,
    primitive: PrimitiveState,
    write_depth: bool,
    blend: Option<BlendState>,
}

fn entry(binding: u32, visibility: ShaderStages, ty: BindingType) -> BindGroupLayoutEntry {
    BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

fn texture(dimension: TextureViewDimension) -> BindingType {
    BindingType::Texture { sample_type: TextureSampleType::Float { filterable: true }, view_dimension: dimension, multisampled: false }
}

fn frame_entries() -> [BindGroupLayoutEntry; 5] {
    let both = ShaderStages::VERTEX_FRAGMENT;
    let uniform = BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let sampler = BindingType::Sampler(SamplerBindingType::Filtering);
    [
        entry(0, both, uniform),
        entry(1, both, texture(TextureViewDimension::D2)),
        entry(2, both, sampler),
        entry(3, both, sampler),
        entry(4, ShaderStages::FRAGMENT, sampler),
    ]
}

fn coat_entries() -> [BindGroupLayoutEntry; 6] {
    let storage =
        BindingType::Buffer { ty: BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: None };
    [
        entry(0, ShaderStages::VERTEX, storage),
        entry(1, ShaderStages::VERTEX, storage),
        entry(2, ShaderStages::VERTEX, storage),
        entry(3, ShaderStages::VERTEX, storage),
        entry(4, ShaderStages::VERTEX_FRAGMENT, texture(TextureViewDimension::D2Array)),
        entry(5, ShaderStages::FRAGMENT, texture(TextureViewDimension::D2)),
    ]
}
