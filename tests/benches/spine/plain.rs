//! What a plain renderer does: submit every face for every shell and every edge as a fin, whichever way they face, lit as ours by one light and a sky.

use pelage_coat::Coat;
use pelage_lighting::DIFFUSIVITY;
use pelage_render::{Target, View};
use wgpu::{
    AddressMode, BindGroup, BindGroupDescriptor, BindGroupEntry, BlendState, Buffer, BufferUsages, Device, IndexFormat, PrimitiveTopology,
    Queue, RenderPass, RenderPipeline, ShaderModuleDescriptor, ShaderSource, VertexStepMode, vertex_attr_array,
};

use super::floor::{Kind, bind, buffer, frame_values, pipeline};

const SHADER: &str = "
struct Frame {
    clip: mat4x4f, step: f32, threshold: f32, edges: f32, unused: f32,
    eye: vec4f, toward_eye: vec4f, light: vec4f, light_colour: vec4f, sky: vec4f, sky_slope: vec4f,
    ambient: vec4f, diffuse: vec4f, specular: vec4f, shadow: vec4f, facing: vec4f
};
struct S { p: vec4f, offset: vec4f, normal: vec4f, direction: vec4f, colour: vec4f };
struct E { ends: vec2u, along: vec2f, first: vec4f, second: vec4f };  // w of the first normal: curvature
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var layers: texture_2d_array<f32>;
@group(0) @binding(2) var linear: sampler;
@group(1) @binding(0) var<storage, read> surface: array<S>;
@group(1) @binding(1) var<storage, read> edges: array<E>;

fn powered(c: f32, half: f32) -> f32 { return pow(max(1.0 - c * c, 1e-30), half); }
fn reach(density: f32, depth: f32) -> f32 { return frame.shadow.y + (1.0 - frame.shadow.y) * exp(-density * depth); }
fn lit(s: S, place: vec3f, height: f32) -> vec3f {
    let v = normalize(frame.eye.xyz - place);
    let h = normalize(v + frame.light.xyz);
    let n_dot_l = dot(s.normal.xyz, frame.light.xyz);
    let t = clamp((n_dot_l - frame.facing.y) * frame.facing.z, 0.0, 1.0);
    let facing = 1.0 + frame.facing.x * (t * t * (3.0 - 2.0 * t) - 1.0);
    let hair = frame.diffuse.xyz * powered(dot(s.direction.xyz, frame.light.xyz), frame.diffuse.w)
        + frame.specular.xyz * powered(dot(s.direction.xyz, h), frame.specular.w);
    let sky = frame.ambient.xyz * (frame.sky.xyz + frame.sky_slope.xyz * s.normal.y) * reach(frame.shadow.w, 1.0 - height);
    return s.colour.xyz
        * (sky + hair * frame.light_colour.xyz * facing * reach(frame.shadow.x / max(n_dot_l, frame.shadow.z), 1.0 - height));
}
struct V { @builtin(position) p: vec4f, @location(0) uv: vec2f, @location(1) @interpolate(flat) layer: u32, @location(2) light: vec3f };
@vertex fn shell(@location(0) index: u32, @location(1) uv: vec2f, @builtin(instance_index) i: u32) -> V {
    let s = surface[index];
    let height = f32(i) * frame.step;
    let place = s.p.xyz + s.offset.xyz * height;
    return V(frame.clip * vec4f(place, 1.0), uv, i, lit(s, place, height));
}
@fragment fn skin(v: V) -> @location(0) vec4f {
    return vec4f(textureSample(layers, linear, v.uv, v.layer).rgb * v.light, 1.0);
}
@fragment fn shells(v: V) -> @location(0) vec4f {
    let c = textureSample(layers, linear, v.uv, v.layer);
    if c.a < frame.threshold { discard; }
    return vec4f(c.rgb * v.light, c.a);
}
struct F { @builtin(position) p: vec4f, @location(0) uv: vec2f, @location(1) opacity: f32, @location(2) light: vec3f };
@vertex fn fin(@builtin(vertex_index) corner: u32, @builtin(instance_index) i: u32) -> F {
    let e = edges[i];
    let a = surface[e.ends.x];
    let b = surface[e.ends.y];
    let offset = 0.5 * (a.offset.xyz + b.offset.xyz);
    let v = frame.toward_eye.xyz;
    let over = dot(normalize(e.first.xyz + e.second.xyz), v);
    let near = max(dot(e.first.xyz, v), dot(e.second.xyz, v)) > 0.0 || over > -e.first.w * length(offset);
    let square = abs(dot(normalize(cross(b.p.xyz - a.p.xyz, offset)), v));
    let opacity = select(0.0, max(0.0, 2.0 * square - 1.0), near);
    var s = a;
    var along = e.along.x;
    if (corner & 1u) == 1u { s = b; along = e.along.y; }
    let height = f32(corner >> 1u);
    let place = s.p.xyz + s.offset.xyz * height;
    // A fin that is not seen is a quad without area.
    let clip = frame.clip * vec4f(place, 1.0) * select(0.0, 1.0, opacity > 0.0);
    return F(clip, vec2f(along, 1.0 - height), opacity, lit(s, place, height));
}
@fragment fn fins(f: F) -> @location(0) vec4f {
    let c = textureSample(layers, linear, f.uv, 0) * f.opacity;
    return vec4f(c.rgb * f.light, c.a);
}
";

pub struct Plain {
    surface: RenderPipeline,
    fins: RenderPipeline,
    shells: RenderPipeline,
    frames: [BindGroup; 3],
    arrays: [BindGroup; 3],
    vertices: Buffer,
    indices: Buffer,
    corners: u32,
    edges: u32,
    layers: u32,
}

impl Plain {
    pub fn new(device: &Device, queue: &Queue, target: Target, coat: &Coat, view: &View) -> Self {
        let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source: ShaderSource::Wgsl(SHADER.into()) });
        let attributes = vertex_attr_array![0 => Uint32, 1 => Float32x2];
        let patch = Kind { attributes: &attributes, stride: 12, ..Kind::opaque("shell", "skin") };
        let blend = Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let edges = Kind {
            topology: PrimitiveTopology::TriangleStrip,
            blend,
            write: false,
            attributes: &[],
            step: VertexStepMode::Instance,
            ..Kind::opaque("fin", "fins")
        };
        let pipelines =
            [patch, edges, Kind { blend, fragment: "shells", ..patch }].map(|kind| pipeline(device, &module, target, &kind, true));
        let values = values(coat, view);
        let shells = (coat.shells.layers(), &coat.shells.mips[..]);
        let fin = coat.fin.as_ref().expect("a fin");
        let frames = [
            bind(device, queue, &pipelines[0], &values, shells, AddressMode::Repeat),
            bind(device, queue, &pipelines[1], &values, (1, &fin.mips), AddressMode::ClampToEdge),
            bind(device, queue, &pipelines[2], &values, shells, AddressMode::Repeat),
        ];
        let surface = buffer(device, BufferUsages::STORAGE, bytemuck::cast_slice(&surface_array(coat)));
        let edges = buffer(device, BufferUsages::STORAGE, bytemuck::cast_slice(&edge_array(coat)));
        let arrays = [0, 1, 2].map(|pass| {
            device.create_bind_group(&BindGroupDescriptor {
                label: None,
                layout: &pipelines[pass].get_bind_group_layout(1),
                entries: &[
                    BindGroupEntry { binding: 0, resource: surface.as_entire_binding() },
                    BindGroupEntry { binding: 1, resource: edges.as_entire_binding() },
                ],
            })
        });
        let patches = &coat.patches;
        let corner = |(&index, uv): (&u32, &glam::Vec2)| [index, uv.x.to_bits(), uv.y.to_bits()];
        let vertices: Vec<[u32; 3]> = patches.vertices.iter().zip(&patches.coordinates).map(corner).collect();
        let [surface, fins, shells] = pipelines;
        Self {
            surface,
            fins,
            shells,
            frames,
            arrays,
            vertices: buffer(device, BufferUsages::VERTEX, bytemuck::cast_slice(&vertices)),
            indices: buffer(device, BufferUsages::INDEX, bytemuck::cast_slice(&patches.faces)),
            corners: 3 * patches.faces.len() as u32,
            edges: coat.edges.vertices.len() as u32,
            layers: coat.shells.layers(),
        }
    }

    /// Triangles of skin, fins and shells.
    pub fn triangles(&self) -> u64 {
        u64::from(self.layers) * u64::from(self.corners / 3) + 2 * u64::from(self.edges)
    }

    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        let begin = |pass: &mut RenderPass<'_>, pipeline, which: usize| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.frames[which], &[]);
            pass.set_bind_group(1, &self.arrays[which], &[]);
        };
        pass.set_index_buffer(self.indices.slice(..), IndexFormat::Uint32);
        begin(pass, &self.surface, 0);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw_indexed(0..self.corners, 0, 0..1);
        begin(pass, &self.fins, 1);
        pass.draw(0..4, 0..self.edges);
        begin(pass, &self.shells, 2);
        pass.draw_indexed(0..self.corners, 0, 1..self.layers);
    }
}

fn surface_array(coat: &Coat) -> Vec<[f32; 20]> {
    let surface = &coat.surface;
    (0..surface.positions.len())
        .map(|i| {
            let mut vertex = [0.0; 20];
            let arrays = [&surface.positions, &surface.offsets, &surface.normals, &surface.directions, &surface.colours];
            vertex.chunks_exact_mut(4).zip(arrays).for_each(|(part, array)| part[..3].copy_from_slice(&array[i].to_array()));
            vertex
        })
        .collect()
}

fn edge_array(coat: &Coat) -> Vec<[u32; 12]> {
    let edges = &coat.edges;
    (0..edges.vertices.len())
        .map(|i| {
            let ([a, b], [u, v], [first, second]) = (edges.vertices[i], edges.intervals[i], edges.face_normals[i]);
            let [p, q] = [first.extend(edges.curvatures[i]), second.extend(0.0)].map(|n| n.to_array().map(f32::to_bits));
            [a, b, u.to_bits(), v.to_bits(), p[0], p[1], p[2], p[3], q[0], q[1], q[2], q[3]]
        })
        .collect()
}

fn values(coat: &Coat, view: &View) -> Vec<f32> {
    let (hair, shadow, facing) = (&view.shading.hair, &view.shading.self_shadow, &view.shading.facing);
    let light = view.lights.directional.first().expect("a light");
    let sky = &view.lights.ambient.0;
    let (density, minimum, grazing) = (shadow.density as f32, shadow.minimum as f32, shadow.grazing as f32);
    let scale = 1.0 / (facing.full_above - facing.dark_below) as f32;
    let rows = [
        view.camera.eye.extend(0.0),
        view.camera.toward_eye().extend(0.0),
        light.direction.extend(0.0),
        light.colour.extend(0.0),
        sky[0].extend(0.0),
        sky[1].extend(0.0),
        hair.ambient.as_vec3().extend(0.0),
        hair.diffuse.as_vec3().extend(0.5 * hair.diffuse_power as f32),
        hair.specular.as_vec3().extend(0.5 * hair.specular_power as f32),
        glam::Vec4::new(density, minimum, grazing, density * DIFFUSIVITY as f32),
        glam::Vec4::new(facing.strength as f32, facing.dark_below as f32, scale, 0.0),
    ];
    let mut values = frame_values(coat, view);
    values.extend(rows.iter().flat_map(glam::Vec4::to_array));
    values
}
