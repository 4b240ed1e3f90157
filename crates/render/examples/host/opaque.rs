//! The host's own opaque objects: boxes, lit by their own shader.

use glam::{Mat4, Vec3};
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, Buffer, BufferUsages, CompareFunction, DepthBiasState, DepthStencilState, Face,
    FragmentState, MultisampleState, PipelineCompilationOptions, PrimitiveState, RenderPass, RenderPipeline, RenderPipelineDescriptor,
    ShaderModuleDescriptor, ShaderSource, StencilState, VertexBufferLayout, VertexState, VertexStepMode, vertex_attr_array,
};

use super::{COLOUR, DEPTH, Host};

const SHADER: &str = "
struct Camera { clip_from_world: mat4x4f, sun: vec4f };
@group(0) @binding(0) var<uniform> camera: Camera;
struct V { @builtin(position) position: vec4f, @location(0) normal: vec3f, @location(1) colour: vec3f };
@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) colour: vec3f) -> V {
    return V(camera.clip_from_world * vec4f(position, 1.0), normal, colour);
}
@fragment fn fragment(v: V) -> @location(0) vec4f {
    let sky = mix(0.15, 0.4, 0.5 + 0.5 * v.normal.y);
    return vec4f(v.colour * (sky + 0.9 * max(dot(v.normal, camera.sun.xyz), 0.0)), 1.0);
}
";

/// A box along the axes.
pub struct Block {
    pub low: Vec3,
    pub high: Vec3,
    pub colour: Vec3,
}

/// Boxes on the device, and the camera they are seen by.
pub struct Opaque {
    pipeline: RenderPipeline,
    group: BindGroup,
    camera: Buffer,
    vertices: Buffer,
    count: u32,
}

impl Opaque {
    pub fn new(host: &Host, blocks: &[Block], sun: Vec3) -> Self {
        let device = &host.device;
        let vertices: Vec<[f32; 9]> = blocks.iter().flat_map(triangles).collect();
        let pipeline = pipeline(host);
        let buffer = |usage, contents: &[u8]| device.create_buffer_init(&BufferInitDescriptor { label: Some("host"), contents, usage });
        let mut uniform = [0.0_f32; 20];
        uniform[16..19].copy_from_slice(&sun.to_array());
        let camera = buffer(BufferUsages::UNIFORM | BufferUsages::COPY_DST, bytemuck::cast_slice(&uniform));
        let group = device.create_bind_group(&BindGroupDescriptor {
            label: Some("host"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[BindGroupEntry { binding: 0, resource: camera.as_entire_binding() }],
        });
        let count = vertices.len() as u32;
        Self { vertices: buffer(BufferUsages::VERTEX, bytemuck::cast_slice(&vertices)), pipeline, group, camera, count }
    }

    pub fn look(&self, host: &Host, clip_from_world: Mat4) {
        host.queue.write_buffer(&self.camera, 0, bytemuck::cast_slice(&clip_from_world.to_cols_array()));
    }

    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..self.count, 0..1);
    }
}

fn triangles(block: &Block) -> Vec<[f32; 9]> {
    let sides = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
    let (centre, half) = (0.5 * (block.low + block.high), 0.5 * (block.high - block.low));
    let side = |&out: &Vec3| {
        let right = if out.y.abs() > 0.5 { Vec3::X } else { Vec3::Y.cross(out) };
        let up = out.cross(right);
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
            let place = centre + half * (out + a * right + b * up);
            let mut vertex = [0.0; 9];
            for (part, v) in vertex.chunks_exact_mut(3).zip([place, out, block.colour]) {
                part.copy_from_slice(&v.to_array());
            }
            vertex
        })
    };
    sides.iter().flat_map(side).collect()
}

fn pipeline(host: &Host) -> RenderPipeline {
    let module =
        host.device.create_shader_module(ShaderModuleDescriptor { label: Some("host"), source: ShaderSource::Wgsl(SHADER.into()) });
    let attributes = vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3];
    host.device.create_render_pipeline(&RenderPipelineDescriptor {
        label: Some("host"),
        layout: None,
        vertex: VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: PipelineCompilationOptions::default(),
            buffers: &[Some(VertexBufferLayout { array_stride: 36, step_mode: VertexStepMode::Vertex, attributes: &attributes })],
        },
        primitive: PrimitiveState { cull_mode: Some(Face::Back), ..PrimitiveState::default() },
        depth_stencil: Some(DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(CompareFunction::Less),
            stencil: StencilState::default(),
            bias: DepthBiasState::default(),
        }),
        multisample: MultisampleState { count: host.samples, ..MultisampleState::default() },
        fragment: Some(FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: PipelineCompilationOptions::default(),
            targets: &[Some(COLOUR.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
