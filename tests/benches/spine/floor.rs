//! What cannot be had for less: the same triangles with one fetch and no lighting, and the same fragments without triangles.

use std::sync::Arc;

use pelage_coat::{Coat, MipImage};
use pelage_render::{ShellDepth, Target, View, fin_edges, fin_opacity};
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};
use wgpu::{
    AddressMode, BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingResource, BindingType, BlendState, Buffer, BufferBindingType, BufferUsages, ColorTargetState, ColorWrites, CompareFunction,
    DepthBiasState, DepthStencilState, Device, Extent3d, Face, FilterMode, FragmentState, IndexFormat, MipmapFilterMode, MultisampleState,
    PipelineCompilationOptions, PipelineLayoutDescriptor, PrimitiveState, PrimitiveTopology, Queue, RenderPass, RenderPipeline,
    RenderPipelineDescriptor, SamplerBindingType, SamplerDescriptor, ShaderModule, ShaderModuleDescriptor, ShaderSource, ShaderStages,
    StencilState, TextureDescriptor, TextureDimension, TextureFormat, TextureSampleType, TextureUsages, TextureViewDescriptor,
    TextureViewDimension, VertexAttribute, VertexBufferLayout, VertexState, VertexStepMode, vertex_attr_array,
};

const SHADER: &str = "
struct Frame { clip: mat4x4f, step: f32, threshold: f32 };
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var layers: texture_2d_array<f32>;
@group(0) @binding(2) var linear: sampler;
struct V { @builtin(position) p: vec4f, @location(0) uv: vec2f, @location(1) @interpolate(flat) layer: u32 };
@vertex fn shell(@location(0) p: vec3f, @location(1) offset: vec3f, @location(2) uv: vec2f, @builtin(instance_index) i: u32) -> V {
    return V(frame.clip * vec4f(p + offset * (f32(i) * frame.step), 1.0), uv, i);
}
@vertex fn full(@builtin(vertex_index) i: u32, @builtin(instance_index) layer: u32) -> V {
    let q = vec2f(f32((i << 1u) & 2u), f32(i & 2u));
    return V(vec4f(q * 2.0 - 1.0, 0.5, 1.0), q * vec2f(5.0, 3.75), layer % textureNumLayers(layers));
}
@fragment fn blended(v: V) -> @location(0) vec4f { return textureSample(layers, linear, v.uv, v.layer); }
@fragment fn tested(v: V) -> @location(0) vec4f {
    let c = textureSample(layers, linear, v.uv, v.layer);
    if c.a < frame.threshold { discard; }
    return c;
}
struct F { @builtin(position) p: vec4f, @location(0) uv: vec2f, @location(1) opacity: f32 };
@vertex fn fin(@location(0) p: vec3f, @location(1) offset: vec3f, @location(2) uv: vec2f) -> F {
    return F(frame.clip * vec4f(p, 1.0), uv, offset.x);
}
@fragment fn fin_blended(f: F) -> @location(0) vec4f { return textureSample(layers, linear, f.uv, 0) * f.opacity; }
";

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    place: [f32; 3],
    offset: [f32; 3],
    uv: [f32; 2],
}

/// How a pipeline differs from the others.
#[derive(Clone, Copy)]
pub struct Kind<'a> {
    pub vertex: &'a str,
    pub fragment: &'a str,
    pub topology: PrimitiveTopology,
    pub cull: Option<Face>,
    pub write: bool,
    pub blend: Option<BlendState>,
    /// Of the one vertex buffer; none without attributes.
    pub attributes: &'a [VertexAttribute],
    pub stride: u64,
    pub step: VertexStepMode,
}

impl<'a> Kind<'a> {
    /// Opaque triangles, both sides, without a vertex buffer.
    pub fn opaque(vertex: &'a str, fragment: &'a str) -> Self {
        Self {
            vertex,
            fragment,
            topology: PrimitiveTopology::TriangleList,
            cull: None,
            write: true,
            blend: None,
            attributes: &[],
            stride: 0,
            step: VertexStepMode::Vertex,
        }
    }
}

pub struct Floor {
    surface: RenderPipeline,
    fins: RenderPipeline,
    shells: RenderPipeline,
    skin_bind: [BindGroup; 3],
    vertices: Buffer,
    indices: Buffer,
    shell_indices: Buffer,
    fin_vertices: Buffer,
    corner_count: u32,
    shell_corners: u32,
    fin_corners: u32,
    layers: u32,
}

impl Floor {
    /// The shells of `faces` alone, those that ours draws; all of the skin; the fins that ours draws.
    pub fn new(device: &Device, queue: &Queue, target: Target, coat: &Coat, view: &View, faces: &[[u32; 3]]) -> Self {
        let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source: ShaderSource::Wgsl(SHADER.into()) });
        let attributes = vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2];
        let surface = Kind { attributes: &attributes, stride: size_of::<Vertex>() as u64, ..Kind::opaque("shell", "blended") };
        let blend = Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let fins = Kind { vertex: "fin", fragment: "fin_blended", write: false, blend, ..surface };
        let written = matches!(view.options.shell_depth, ShellDepth::Written { .. });
        let fragment = if written { "tested" } else { "blended" };
        let shells = Kind { fragment, cull: Some(Face::Back), write: written, blend, ..surface };
        let [surface, fins, shells] = [surface, fins, shells].map(|kind| pipeline(device, &module, target, &kind, false));
        let uniform = frame_values(coat, view);
        let shell_texture = (coat.shells.layers(), &coat.shells.mips[..]);
        let fin = Arc::clone(coat.fin.as_ref().expect("a fin"));
        let skin_bind = [
            bind(device, queue, &surface, &uniform, shell_texture, AddressMode::Repeat),
            bind(device, queue, &fins, &uniform, (1, &fin.mips), AddressMode::ClampToEdge),
            bind(device, queue, &shells, &uniform, shell_texture, AddressMode::Repeat),
        ];
        let patches = &coat.patches;
        let vertices: Vec<Vertex> = (0..patches.vertices.len())
            .map(|i| {
                let v = patches.vertices[i] as usize;
                Vertex {
                    place: coat.surface.positions[v].to_array(),
                    offset: coat.surface.offsets[v].to_array(),
                    uv: patches.coordinates[i].to_array(),
                }
            })
            .collect();
        let fin_vertices = fin_triangles(coat, view);
        Self {
            surface,
            fins,
            shells,
            skin_bind,
            vertices: buffer(device, BufferUsages::VERTEX, bytemuck::cast_slice(&vertices)),
            indices: buffer(device, BufferUsages::INDEX, bytemuck::cast_slice(&patches.faces)),
            shell_indices: buffer(device, BufferUsages::INDEX, bytemuck::cast_slice(faces)),
            corner_count: 3 * patches.faces.len() as u32,
            shell_corners: 3 * faces.len() as u32,
            fin_corners: fin_vertices.len() as u32,
            fin_vertices: buffer(device, BufferUsages::VERTEX, bytemuck::cast_slice(&fin_vertices)),
            layers: coat.shells.layers(),
        }
    }

    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.surface);
        pass.set_bind_group(0, &self.skin_bind[0], &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..self.corner_count, 0, 0..1);
        pass.set_pipeline(&self.fins);
        pass.set_bind_group(0, &self.skin_bind[1], &[]);
        pass.set_vertex_buffer(0, self.fin_vertices.slice(..));
        pass.draw(0..self.fin_corners, 0..1);
        pass.set_pipeline(&self.shells);
        pass.set_bind_group(0, &self.skin_bind[2], &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.shell_indices.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..self.shell_corners, 0, 1..self.layers);
    }
}

/// The fins that are drawn, as triangles; the opacity is the offset's x.
fn fin_triangles(coat: &Coat, view: &View) -> Vec<Vertex> {
    let mut triangles = Vec::new();
    for (edge, (ends, interval)) in fin_edges(coat).iter().zip(coat.edges.vertices.iter().zip(&coat.edges.intervals)) {
        let opacity = fin_opacity(edge, view.camera.toward_eye(), view.options.length_scale);
        if opacity <= 0.0 {
            continue;
        }
        let corner = |end: usize, height: f32| {
            let v = ends[end] as usize;
            let place = coat.surface.positions[v] + height * coat.surface.offsets[v];
            Vertex { place: place.to_array(), offset: [opacity, 0.0, 0.0], uv: [interval[end], 1.0 - height] }
        };
        let [a, b, c, d] = [corner(0, 0.0), corner(1, 0.0), corner(0, 1.0), corner(1, 1.0)];
        triangles.extend([a, b, c, c, b, d]);
    }
    triangles
}

/// As many fragments, without triangles.
pub struct FullScreen {
    pipeline: RenderPipeline,
    bind: BindGroup,
    count: u32,
}

impl FullScreen {
    pub fn new(device: &Device, queue: &Queue, target: Target, coat: &Coat, count: u32) -> Self {
        let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source: ShaderSource::Wgsl(SHADER.into()) });
        let blend = Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let pipeline = pipeline(device, &module, target, &Kind { write: false, blend, ..Kind::opaque("full", "blended") }, false);
        let uniform = [0.0; 20];
        let bind = bind(device, queue, &pipeline, &uniform, (coat.shells.layers(), &coat.shells.mips), AddressMode::Repeat);
        Self { pipeline, bind, count }
    }

    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind, &[]);
        pass.draw(0..3, 0..self.count);
    }
}

/// The projection, the step from shell to shell, the threshold of opacity, and room to a multiple of four.
pub fn frame_values(coat: &Coat, view: &View) -> Vec<f32> {
    let aspect = pelage_tests::SIZE.0 as f32 / pelage_tests::SIZE.1 as f32;
    let mut values = vec![0.0; 20];
    values[..16].copy_from_slice(&view.camera.view_projection(aspect).to_cols_array());
    values[16] = 1.0 / (coat.shells.layers() - 1) as f32;
    if let ShellDepth::Written { threshold } = view.options.shell_depth {
        values[17] = threshold;
    }
    values
}

pub fn buffer(device: &Device, usage: BufferUsages, contents: &[u8]) -> Buffer {
    device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
}

pub fn bind(
    device: &Device,
    queue: &Queue,
    pipeline: &RenderPipeline,
    uniform: &[f32],
    (layers, mips): (u32, &[MipImage]),
    address_mode_v: AddressMode,
) -> BindGroup {
    let descriptor = TextureDescriptor {
        label: None,
        size: Extent3d { width: mips[0].width, height: mips[0].height, depth_or_array_layers: layers },
        mip_level_count: mips.len() as u32,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format: TextureFormat::Rgba8UnormSrgb,
        usage: TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let bytes: Vec<u8> = mips.iter().flat_map(|mip| &mip.texels).copied().collect();
    let texture = device.create_texture_with_data(queue, &descriptor, TextureDataOrder::MipMajor, &bytes);
    let view = texture.create_view(&TextureViewDescriptor { dimension: Some(TextureViewDimension::D2Array), ..Default::default() });
    let sampler = device.create_sampler(&SamplerDescriptor {
        address_mode_u: AddressMode::Repeat,
        address_mode_v,
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        mipmap_filter: MipmapFilterMode::Linear,
        ..SamplerDescriptor::default()
    });
    let uniform = buffer(device, BufferUsages::UNIFORM, bytemuck::cast_slice(uniform));
    device.create_bind_group(&BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
            BindGroupEntry { binding: 1, resource: BindingResource::TextureView(&view) },
            BindGroupEntry { binding: 2, resource: BindingResource::Sampler(&sampler) },
        ],
    })
}

/// Explicit, as a layout made from the shader has only what that entry point reads.
fn layout(device: &Device) -> BindGroupLayout {
    let entry = |binding, visibility, ty| BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let uniform = BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let texture = BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: true },
        view_dimension: TextureViewDimension::D2Array,
        multisampled: false,
    };
    device.create_bind_group_layout(&BindGroupLayoutDescriptor {
        label: None,
        entries: &[
            entry(0, ShaderStages::VERTEX_FRAGMENT, uniform),
            entry(1, ShaderStages::VERTEX_FRAGMENT, texture),
            entry(2, ShaderStages::FRAGMENT, BindingType::Sampler(SamplerBindingType::Filtering)),
        ],
    })
}

fn array_layout(device: &Device) -> BindGroupLayout {
    let ty = BindingType::Buffer { ty: BufferBindingType::Storage { read_only: true }, has_dynamic_offset: false, min_binding_size: None };
    let entry = |binding| BindGroupLayoutEntry { binding, visibility: ShaderStages::VERTEX, ty, count: None };
    device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: None, entries: &[entry(0), entry(1)] })
}

/// `arrays`: with two storage buffers for the vertex stage in a second group.
pub fn pipeline(device: &Device, module: &ShaderModule, target: Target, kind: &Kind<'_>, arrays: bool) -> RenderPipeline {
    let buffers = [Some(VertexBufferLayout { array_stride: kind.stride, step_mode: kind.step, attributes: kind.attributes })];
    let groups = [Some(&layout(device)), Some(&array_layout(device))];
    let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: if arrays { &groups } else { &groups[..1] },
        immediate_size: 0,
    });
    device.create_render_pipeline(&RenderPipelineDescriptor {
        label: Some(kind.vertex),
        layout: Some(&layout),
        vertex: VertexState {
            module,
            entry_point: Some(kind.vertex),
            compilation_options: PipelineCompilationOptions::default(),
            buffers: if kind.attributes.is_empty() { &[] } else { &buffers },
        },
        primitive: PrimitiveState { topology: kind.topology, cull_mode: kind.cull, ..PrimitiveState::default() },
        depth_stencil: Some(DepthStencilState {
            format: target.depth,
            depth_write_enabled: Some(kind.write),
            depth_compare: Some(CompareFunction::GreaterEqual),
            stencil: StencilState::default(),
            bias: DepthBiasState::default(),
        }),
        multisample: MultisampleState { count: target.samples, ..MultisampleState::default() },
        fragment: Some(FragmentState {
            module,
            entry_point: Some(kind.fragment),
            compilation_options: PipelineCompilationOptions::default(),
            targets: &[Some(ColorTargetState { format: target.colour, blend: kind.blend, write_mask: ColorWrites::ALL })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
