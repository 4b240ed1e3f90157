//! The exact visible set of the shells, to hold ours against: every triangle of a shell that faces the eye and has at least one sample before the skin.
//!
//! The skin alone decides, because nothing else is opaque: what stands behind hair shines through it. Leaving out a triangle of the set would change a pixel,
//! leaving out any other changes none, so no renderer of this geometry can submit fewer. Fragments are what the rasteriser makes of the triangles before the
//! depth test, one a sample's centre: that is what a triangle too many costs, even where the depth test then stops it.

use std::collections::HashSet;

use pelage_coat::Coat;
use pelage_render::{Headless, View};
use wgpu::{
    BindGroupDescriptor, BindGroupEntry, BindingResource, BufferDescriptor, BufferUsages, Color, CommandEncoderDescriptor, CompareFunction,
    Device, Extent3d, Face, FragmentState, LoadOp, MapMode, Operations, PipelineCompilationOptions, PollType, PrimitiveState,
    RenderPassColorAttachment, RenderPassDepthStencilAttachment, RenderPassDescriptor, RenderPipeline, RenderPipelineDescriptor,
    ShaderModuleDescriptor, ShaderSource, StoreOp, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages, TextureView,
    TextureViewDescriptor, VertexBufferLayout, VertexState, VertexStepMode, vertex_attr_array,
};

use super::floor::{buffer, frame_values};
use pelage_tests::SIZE;

const SHADER: &str = "
struct Frame { clip: mat4x4f, step: f32, unused: vec3f };
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var depth: texture_depth_2d;
@group(0) @binding(2) var<storage, read_write> found: array<atomic<u32>>;  // for each triangle: fragments, those of them before the skin
struct V { @builtin(position) @invariant p: vec4f, @location(0) @interpolate(flat) triangle: u32 };
@vertex fn shell(@location(0) p: vec3f, @location(1) offset: vec3f, @builtin(vertex_index) v: u32, @builtin(instance_index) i: u32) -> V {
    return V(frame.clip * vec4f(p + offset * (f32(i) * frame.step), 1.0), v / 3u + (i - 1u) * FACES);
}
@vertex fn skin(@location(0) p: vec3f, @location(1) offset: vec3f) -> V {
    return V(frame.clip * vec4f(p + offset * 0.0, 1.0), 0u);
}
@fragment fn count(v: V) -> @location(0) vec4f {
    atomicAdd(&found[2u * v.triangle], 1u);
    if v.p.z >= textureLoad(depth, vec2i(v.p.xy), 0) {
        atomicAdd(&found[2u * v.triangle + 1u], 1u);
    }
    return vec4f(0.0);
}
";

/// What a set of triangles is: how many, and how many fragments they make.
#[derive(Clone, Copy, Debug, Default)]
pub struct Size {
    pub triangles: u64,
    pub fragments: u64,
}

/// The set's size, and that of some faces submitted for every shell.
pub struct Comparison {
    pub exact: Size,
    pub submitted: Size,
    /// Triangles of the exact set that were not submitted.
    pub missed: u64,
}

/// Counts, for the coat's finest level and the view's camera.
pub fn compare(headless: &Headless, coat: &Coat, view: &View, faces: &[[u32; 3]]) -> Comparison {
    let found = count(headless, coat, view);
    let submitted: HashSet<[u32; 3]> = faces.iter().copied().collect();
    let mut comparison = Comparison { exact: Size::default(), submitted: Size::default(), missed: 0 };
    for (triangle, fragments) in found.chunks_exact(2).enumerate() {
        let [all, before] = [u64::from(fragments[0]), u64::from(fragments[1])];
        let is_submitted = submitted.contains(&coat.patches.faces[triangle % coat.patches.faces.len()]);
        let add = |size: &mut Size| {
            size.triangles += 1;
            size.fragments += all;
        };
        if before > 0 {
            add(&mut comparison.exact);
            comparison.missed += u64::from(!is_submitted);
        }
        if is_submitted {
            add(&mut comparison.submitted);
        }
    }
    comparison
}

/// For each triangle, shell after shell: fragments, and those before the skin.
fn count(headless: &Headless, coat: &Coat, view: &View) -> Vec<u32> {
    let device = headless.device();
    let (faces, shells) = (coat.patches.faces.len(), coat.shells.layers() - 1);
    let source = SHADER.replace("FACES", &format!("{faces}u"));
    let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source: ShaderSource::Wgsl(source.into()) });
    let [skin, shell] = [("skin", None), ("shell", Some("count"))].map(|(vertex, fragment)| pipeline(device, &module, vertex, fragment));
    let depth = texture(device, TextureFormat::Depth32Float, TextureUsages::TEXTURE_BINDING);
    let colour = texture(device, TextureFormat::R8Unorm, TextureUsages::empty());
    let size = 8 * faces as u64 * u64::from(shells);
    let make = |usage, size| device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let found = make(BufferUsages::STORAGE | BufferUsages::COPY_SRC, size);
    let readable = make(BufferUsages::MAP_READ | BufferUsages::COPY_DST, size);
    let uniform = buffer(device, BufferUsages::UNIFORM, bytemuck::cast_slice(&padded(frame_values(coat, view))));
    let entry = |binding, resource| BindGroupEntry { binding, resource };
    let group = |pipeline: &RenderPipeline, entries: &[BindGroupEntry<'_>]| {
        device.create_bind_group(&BindGroupDescriptor { label: None, layout: &pipeline.get_bind_group_layout(0), entries })
    };
    let skin_group = group(&skin, &[entry(0, uniform.as_entire_binding())]);
    let shell_group = group(
        &shell,
        &[entry(0, uniform.as_entire_binding()), entry(1, BindingResource::TextureView(&depth)), entry(2, found.as_entire_binding())],
    );
    let vertices = buffer(device, BufferUsages::VERTEX, bytemuck::cast_slice(&corners(coat)));
    let corner_count = 3 * faces as u32;
    let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(Operations { load: LoadOp::Clear(0.0), store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..RenderPassDescriptor::default()
        });
        pass.set_pipeline(&skin);
        pass.set_bind_group(0, &skin_group, &[]);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.draw(0..corner_count, 0..1);
    }
    {
        let ops = Operations { load: LoadOp::Clear(Color::BLACK), store: StoreOp::Discard };
        let attachment = RenderPassColorAttachment { view: &colour, depth_slice: None, resolve_target: None, ops };
        let mut pass =
            encoder.begin_render_pass(&RenderPassDescriptor { color_attachments: &[Some(attachment)], ..RenderPassDescriptor::default() });
        pass.set_pipeline(&shell);
        pass.set_bind_group(0, &shell_group, &[]);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.draw(0..corner_count, 1..shells + 1);
    }
    encoder.copy_buffer_to_buffer(&found, 0, &readable, 0, size);
    headless.queue().submit([encoder.finish()]);
    readable.slice(..).map_async(MapMode::Read, |_| ());
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    let view = readable.slice(..).get_mapped_range().expect("mapped");
    bytemuck::pod_collect_to_vec(&view)
}

/// Place and offset of each corner of each face: a triangle's number is its first corner's, by three.
fn corners(coat: &Coat) -> Vec<[f32; 6]> {
    let corner = |&corner: &u32| {
        let v = coat.patches.vertices[corner as usize] as usize;
        let (p, offset) = (coat.surface.positions[v], coat.surface.offsets[v]);
        [p.x, p.y, p.z, offset.x, offset.y, offset.z]
    };
    coat.patches.faces.iter().flatten().map(corner).collect()
}

/// To the size of the shader's struct.
fn padded(mut values: Vec<f32>) -> Vec<f32> {
    values.resize(24, 0.0);
    values
}

fn texture(device: &Device, format: TextureFormat, usage: TextureUsages) -> TextureView {
    let texture = device.create_texture(&TextureDescriptor {
        label: None,
        size: Extent3d { width: SIZE.0, height: SIZE.1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage: TextureUsages::RENDER_ATTACHMENT | usage,
        view_formats: &[],
    });
    texture.create_view(&TextureViewDescriptor::default())
}

fn pipeline(device: &Device, module: &wgpu::ShaderModule, vertex: &str, fragment: Option<&str>) -> RenderPipeline {
    let attributes = vertex_attr_array![0 => Float32x3, 1 => Float32x3];
    let layout = VertexBufferLayout { array_stride: 24, step_mode: VertexStepMode::Vertex, attributes: &attributes };
    device.create_render_pipeline(&RenderPipelineDescriptor {
        label: Some(vertex),
        layout: None,
        vertex: VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: PipelineCompilationOptions::default(),
            buffers: &[Some(layout)],
        },
        primitive: PrimitiveState { cull_mode: fragment.map(|_| Face::Back), ..PrimitiveState::default() },
        depth_stencil: fragment.is_none().then(|| wgpu::DepthStencilState {
            format: TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(CompareFunction::GreaterEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: fragment.map(|entry| FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: PipelineCompilationOptions::default(),
            targets: TARGETS,
        }),
        multiview_mask: None,
        cache: None,
    })
}

const TARGETS: &[Option<wgpu::ColorTargetState>] =
    &[Some(wgpu::ColorTargetState { format: TextureFormat::R8Unorm, blend: None, write_mask: wgpu::ColorWrites::empty() })];
