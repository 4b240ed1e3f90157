//! The pipelines of the drawing passes, made when first asked for.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use glam::Vec3;
use pelage_coat::Lights;
use wgpu::{
    BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, BlendState, BufferBindingType, ColorTargetState,
    ColorWrites, Device, Face, FragmentState, PipelineCompilationOptions, PipelineLayout, PipelineLayoutDescriptor, PrimitiveState,
    PrimitiveTopology, RenderPipeline, RenderPipelineDescriptor, SamplerBindingType, ShaderModule, ShaderModuleDescriptor, ShaderSource,
    ShaderStages, TextureSampleType, TextureViewDimension, VertexBufferLayout, VertexState, VertexStepMode, vertex_attr_array,
};

use crate::frame::Shown;
use crate::pack::TileVertex;
use crate::shader::assemble;
use crate::{LightingMode, ShellDepth, Target, View};

/// What all drawing passes begin with.
pub(crate) const PRELUDE: [&str; 6] = [
    include_str!("shaders/opacity.wgsl"),
    include_str!("shaders/common.wgsl"),
    include_str!("shaders/bindings.wgsl"),
    include_str!("shaders/hair.wgsl"),
    include_str!("shaders/lighting.wgsl"),
    include_str!("shaders/shadow.wgsl"),
];

/// What to draw with, for one view: nothing for a pass that it does not have.
#[derive(Clone, Debug, Default)]
pub(crate) struct PassPipelines {
    pub(crate) surface: Option<RenderPipeline>,
    pub(crate) fins: Option<RenderPipeline>,
    pub(crate) shells: Option<RenderPipeline>,
}

/// A pass that draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Drawing {
    Surface,
    Fins,
    Shells,
}

/// Everything that the shaders are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Variant {
    lighting: Lit,
    depth: Depth,
    /// The hair's direction comes from a map.
    map: bool,
    /// Hair bends on its way.
    bent: bool,
    /// Hair is cut off somewhere.
    cut: bool,
    /// One coat becomes another.
    mixed: bool,
    /// Patches overlap and fade.
    lapped: bool,
    /// Two levels of detail are blended.
    levels: bool,
    /// Shells are more or less than their image.
    thickened: bool,
    /// A hair shades what is under it.
    hair_shadow: bool,
    /// The first light is looked up on a map.
    shadow_map: bool,
    /// A shell shows more than its own layer.
    march: bool,
    /// Fur stands everywhere, so that no bare skin shows.
    grown: bool,
    /// Light from all around is that of a sky and a ground.
    sky: bool,
    /// Lights at infinity.
    lights: u32,
    /// Drawn at many places at once.
    instanced: bool,
}

/// Where the first light is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Lit {
    Patch,
    Vertex,
    Formula,
    Table,
}

/// [`ShellDepth`] without its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Depth {
    Written,
    Tested,
    Coverage,
}

/// What a coat has that a shader needs to know.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct CoatTraits {
    pub(crate) bent: bool,
    pub(crate) cut: bool,
    pub(crate) direction_map: bool,
    /// Several mixtures of hair, one coat becoming another.
    pub(crate) mixed: bool,
    /// Patches overlap and fade towards their outlines.
    pub(crate) lapped: bool,
}

impl Variant {
    /// For a view of a coat; `thickened` and `levels` as the schedule says, `grown` as the coat's shortest hair does.
    pub(crate) fn new(view: &View, coat: CoatTraits, [thickened, levels, grown]: [bool; 3]) -> Self {
        let options = &view.options;
        let lighting = match options.lighting {
            LightingMode::PerPatch => Lit::Patch,
            LightingMode::PerVertex => Lit::Vertex,
            LightingMode::Formula => Lit::Formula,
            LightingMode::Table(_) => Lit::Table,
        };
        let depth = match options.shell_depth {
            ShellDepth::Written { .. } => Depth::Written,
            ShellDepth::Tested => Depth::Tested,
            ShellDepth::Coverage { .. } => Depth::Coverage,
        };
        let per_pixel = matches!(lighting, Lit::Formula | Lit::Table);
        Self {
            lighting,
            depth,
            map: per_pixel && options.direction_map && coat.direction_map,
            bent: coat.bent,
            cut: coat.cut,
            mixed: coat.mixed,
            lapped: coat.lapped,
            levels,
            thickened,
            hair_shadow: options.hair_shadow > 0.0,
            shadow_map: options.shadows.is_some(),
            march: options.march.layers > 1 || options.march.steps > 1,
            grown,
            sky: view.lights.ambient.0[2..].iter().all(|&term| term == Vec3::ZERO),
            lights: view.lights.directional.len().min(Lights::MOST) as u32,
            instanced: false,
        }
    }

    /// The same for a crowd.
    pub(crate) fn instanced(self) -> Self {
        Self { instanced: true, ..self }
    }

    /// The names that the shaders' conditions ask for.
    fn flags(&self) -> Vec<&'static str> {
        let per_pixel = matches!(self.lighting, Lit::Formula | Lit::Table);
        let flags = [
            ("PATCH", self.lighting == Lit::Patch),
            ("PIXEL", per_pixel),
            ("TABLE", self.lighting == Lit::Table),
            ("MAP", self.map),
            ("BENT", self.bent),
            ("CUT", self.cut),
            ("MIXED", self.mixed),
            ("LAPPED", self.lapped),
            ("LEVELS", self.levels),
            ("THICKENED", self.thickened),
            ("HAIR_SHADOW", self.hair_shadow),
            ("GROWN", self.grown),
            ("KEPT", self.cut || !self.grown),
            ("SKY", self.sky),
            ("INSTANCED", self.instanced),
            ("MARCH", self.march),
            ("SHADOW_MAP", self.shadow_map),
            ("SPLIT", per_pixel || self.hair_shadow || self.shadow_map),
            ("AXES", self.map || self.march || self.hair_shadow),
        ];
        flags.into_iter().filter_map(|(name, on)| on.then_some(name)).collect()
    }

    fn source(&self, pass: &str, samples: u32) -> String {
        format!(
            "const LIGHTS: u32 = {}u;\nconst SAMPLES: u32 = {samples}u;\n{}",
            self.lights,
            assemble(&[PRELUDE[0], PRELUDE[1], PRELUDE[2], PRELUDE[3], PRELUDE[4], PRELUDE[5], pass], &self.flags())
        )
    }
}

/// Layouts, and the pipelines made so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    target: Target,
    pub(crate) frame_layout: BindGroupLayout,
    pub(crate) coat_layout: BindGroupLayout,
    layout: PipelineLayout,
    made: Mutex<HashMap<(Drawing, Variant), RenderPipeline>>,
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
        Self { target, frame_layout, coat_layout, layout, made: Mutex::default() }
    }

    /// The pipelines for a variant, of the passes that are shown.
    pub(crate) fn get(&self, device: &Device, variant: Variant, shown: Shown) -> PassPipelines {
        // A panic elsewhere leaves whole pipelines in the map.
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let mut of = |drawing: Drawing| {
            made.entry((drawing, variant)).or_insert_with(|| self.pipeline(device, &drawing.pass(&variant), variant)).clone()
        };
        PassPipelines {
            surface: shown.surface.then(|| of(Drawing::Surface)),
            fins: shown.fins.then(|| of(Drawing::Fins)),
            shells: shown.shells.then(|| of(Drawing::Shells)),
        }
    }

    fn pipeline(&self, device: &Device, pass: &Pass, variant: Variant) -> RenderPipeline {
        let module = self.module(device, pass, variant);
        shell_buffers(|buffers| {
            device.create_render_pipeline(&RenderPipelineDescriptor {
                label: Some(pass.vertex),
                layout: Some(&self.layout),
                vertex: VertexState {
                    module: &module,
                    entry_point: Some(pass.vertex),
                    compilation_options: PipelineCompilationOptions::default(),
                    buffers: &buffers[..pass.buffers],
                },
                primitive: pass.primitive,
                depth_stencil: Some(self.target.depth_state(pass.write_depth)),
                multisample: self.target.multisample_state(),
                fragment: Some(FragmentState {
                    module: &module,
                    entry_point: Some(pass.fragment),
                    compilation_options: PipelineCompilationOptions::default(),
                    targets: &[Some(ColorTargetState { format: self.target.colour, blend: pass.blend, write_mask: ColorWrites::ALL })],
                }),
                multiview_mask: None,
                cache: None,
            })
        })
    }

    /// What all drawing pipelines are given.
    pub(crate) fn layout(&self) -> &PipelineLayout {
        &self.layout
    }

    fn module(&self, device: &Device, pass: &Pass, variant: Variant) -> ShaderModule {
        device.create_shader_module(ShaderModuleDescriptor {
            label: Some(pass.vertex),
            source: ShaderSource::Wgsl(variant.source(pass.source, self.target.samples).into()),
        })
    }
}

impl Drawing {
    fn pass(self, variant: &Variant) -> Pass {
        let blend = Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        match self {
            Self::Surface => Pass {
                source: include_str!("shaders/surface.wgsl"),
                vertex: "surface_vertex",
                fragment: "surface_fragment",
                buffers: if variant.instanced { 2 } else { 1 },
                // Where an open surface shows its back, it is skin all the same.
                primitive: PrimitiveState::default(),
                write_depth: true,
                blend: None,
            },
            Self::Fins => Pass {
                source: include_str!("shaders/fins.wgsl"),
                vertex: "fin_vertex",
                fragment: "fin_fragment",
                buffers: 0,
                primitive: PrimitiveState { topology: PrimitiveTopology::TriangleStrip, ..PrimitiveState::default() },
                write_depth: false,
                blend,
            },
            Self::Shells => Pass {
                source: include_str!("shaders/shells.wgsl"),
                vertex: "shell_vertex",
                fragment: match variant.depth {
                    Depth::Written => "shell_tested",
                    Depth::Tested => "shell_blended",
                    Depth::Coverage => "shell_covering",
                },
                buffers: if variant.lapped { 3 } else { 2 },
                primitive: PrimitiveState { cull_mode: Some(Face::Back), ..PrimitiveState::default() },
                write_depth: variant.depth != Depth::Tested,
                // A sample that is drawn is replaced.
                blend: blend.filter(|_| variant.depth != Depth::Coverage),
            },
        }
    }
}

/// What differs between the passes.
struct Pass {
    source: &'static str,
    vertex: &'static str,
    fragment: &'static str,
    /// Vertex buffers: patch vertices, then which shell, of a crowd also which place, then how opaque patches are that overlap.
    buffers: usize,
    primitive: PrimitiveState,
    write_depth: bool,
    blend: Option<BlendState>,
}

/// The vertex buffers of shells: patch vertices, and which shell; where patches overlap, how opaque they are.
pub(crate) fn shell_buffers<T>(with: impl FnOnce(&[Option<VertexBufferLayout<'_>>]) -> T) -> T {
    let tile = vertex_attr_array![0 => Uint32, 1 => Float32x2, 2 => Uint32, 3 => Float32, 4 => Uint32];
    let shell = vertex_attr_array![5 => Uint32];
    let opacity = vertex_attr_array![6 => Float32];
    let layout = |stride: usize, step_mode, attributes| Some(VertexBufferLayout { array_stride: stride as u64, step_mode, attributes });
    with(&[
        layout(size_of::<TileVertex>(), VertexStepMode::Vertex, &tile[..]),
        layout(size_of::<u32>(), VertexStepMode::Instance, &shell[..]),
        layout(size_of::<f32>(), VertexStepMode::Vertex, &opacity[..]),
    ])
}

pub(crate) fn entry(binding: u32, visibility: ShaderStages, ty: BindingType) -> BindGroupLayoutEntry {
    BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

pub(crate) fn uniform() -> BindingType {
    BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None }
}

pub(crate) fn storage(read_only: bool) -> BindingType {
    BindingType::Buffer { ty: BufferBindingType::Storage { read_only }, has_dynamic_offset: false, min_binding_size: None }
}

pub(crate) fn texture(dimension: TextureViewDimension) -> BindingType {
    BindingType::Texture { sample_type: TextureSampleType::Float { filterable: true }, view_dimension: dimension, multisampled: false }
}

fn frame_entries() -> [BindGroupLayoutEntry; 14] {
    let both = ShaderStages::VERTEX_FRAGMENT;
    let sampler = BindingType::Sampler(SamplerBindingType::Filtering);
    let depth =
        BindingType::Texture { sample_type: TextureSampleType::Depth, view_dimension: TextureViewDimension::D2, multisampled: false };
    [
        entry(0, both, uniform()),
        entry(1, both, uniform()),
        entry(2, ShaderStages::VERTEX, storage(true)),
        entry(3, both, texture(TextureViewDimension::D2)),
        entry(4, both, sampler),
        entry(5, both, sampler),
        entry(6, ShaderStages::FRAGMENT, sampler),
        entry(7, both, texture(TextureViewDimension::D2Array)),
        entry(8, ShaderStages::FRAGMENT, texture(TextureViewDimension::D2Array)),
        entry(9, ShaderStages::FRAGMENT, depth),
        entry(10, ShaderStages::FRAGMENT, texture(TextureViewDimension::D2)),
        entry(11, ShaderStages::FRAGMENT, texture(TextureViewDimension::D2)),
        entry(12, ShaderStages::FRAGMENT, BindingType::Sampler(SamplerBindingType::Comparison)),
        entry(13, ShaderStages::VERTEX, texture(TextureViewDimension::D2)),
    ]
}

fn coat_entries() -> [BindGroupLayoutEntry; 5] {
    let vertex = ShaderStages::VERTEX;
    [
        entry(0, vertex, storage(true)),
        entry(1, vertex, storage(true)),
        entry(2, vertex, storage(true)),
        entry(3, vertex, storage(true)),
        entry(4, ShaderStages::FRAGMENT, texture(TextureViewDimension::D2Array)),
    ]
}

#[cfg(test)]
mod tests {
    use pelage_coat::{Camera, Irradiance};

    use super::*;

    #[test]
    fn what_a_view_does_not_ask_for_is_not_compiled() {
        let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.1 };
        let lights = Lights { directional: vec![], ambient: Irradiance::hemisphere(Vec3::ONE, Vec3::ZERO) };
        let mut view = View::new(camera, lights);
        assert_eq!(Variant::new(&view, CoatTraits::default(), [false, false, true]).flags(), ["GROWN", "SKY"]);
        view.options.lighting = LightingMode::Formula;
        view.lights.ambient.0[4] = Vec3::X;
        let all = CoatTraits { bent: true, cut: true, direction_map: true, mixed: true, lapped: true };
        assert_eq!(
            Variant::new(&view, all, [true, true, false]).flags(),
            ["PIXEL", "MAP", "BENT", "CUT", "MIXED", "LAPPED", "LEVELS", "THICKENED", "KEPT", "SPLIT", "AXES"]
        );
        view.options.direction_map = false;
        assert_eq!(
            Variant::new(&view, all, [false, false, true]).flags(),
            ["PIXEL", "BENT", "CUT", "MIXED", "LAPPED", "GROWN", "KEPT", "SPLIT"]
        );
    }
}
