//! What the first light reaches: a map that knows the skin's depth and how much hair stands before a place (Yuksel and Keyser 2008).

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use glam::{Mat4, Vec3, Vec4};
use wgpu::{
    BindGroup, BlendComponent, BlendFactor, BlendOperation, BlendState, Buffer, BufferUsages, Color, ColorTargetState, ColorWrites,
    CommandEncoder, CompareFunction, DepthStencilState, Device, Extent3d, Face, FragmentState, IndexFormat, LoadOp, Operations,
    PipelineCompilationOptions, PrimitiveState, Queue, RenderPass, RenderPassColorAttachment, RenderPassDepthStencilAttachment,
    RenderPassDescriptor, RenderPipeline, RenderPipelineDescriptor, ShaderModuleDescriptor, ShaderSource, StoreOp, TextureDescriptor,
    TextureDimension, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor, VertexState,
};

use crate::buffers::room;
use crate::pipelines::{PRELUDE, Pipelines, shell_buffers};
use crate::schedule::{MOST_SHELLS, Schedule};
use crate::shader::assemble;
use crate::{GpuCoat, View};

/// Most shells that cast; with more in the coat, each that casts stands for several.
const MOST_CASTING: u32 = 8;

/// The textures of a map.
#[derive(Debug)]
pub(crate) struct ShadowTargets {
    pub(crate) skin: TextureView,
    pub(crate) fronts: TextureView,
    pub(crate) slices: TextureView,
}

impl ShadowTargets {
    pub(crate) fn new(device: &Device, side: u32) -> Self {
        let texture = |label, format| {
            let texture = device.create_texture(&TextureDescriptor {
                label: Some(label),
                size: Extent3d { width: side, height: side, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: TextureDimension::D2,
                format,
                usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&TextureViewDescriptor::default())
        };
        Self {
            skin: texture("shadow of the skin", TextureFormat::Depth32Float),
            fronts: texture("first hair", TextureFormat::R16Float),
            slices: texture("shadow of the hair", TextureFormat::Rgba16Float),
        }
    }
}

/// The first light's view of a coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LightView {
    pub(crate) light_from_coat: Mat4,
    /// The fur's length in the view's depth.
    pub(crate) length: f32,
    /// How far, in diameters, a place is moved off what it lies on.
    pub(crate) bias: f32,
}

impl LightView {
    /// The view that a frame's shadows are cast in.
    pub(crate) fn new(coat: &GpuCoat, view: &View) -> Self {
        let direction = view.lights.directional.first().map_or(Vec3::Y, |light| light.direction);
        let (length, scale) = (coat.length, view.options.length_scale.max(0.0));
        let (centre, radius) = coat.ball;
        let side = view.options.shadows.map_or(16, |shadows| shadows.side.max(16));
        Self::of_ball(direction, centre, radius + (scale - 1.0).max(0.0) * length, length * scale, side)
    }

    /// The view of a ball, from the direction of the light, on a map with so many texels a side.
    fn of_ball(direction: Vec3, centre: Vec3, radius: f32, length: f32, side: u32) -> Self {
        let radius = radius.max(1e-6);
        let toward = direction.normalize_or(Vec3::Y);
        let (right, up) = toward.any_orthonormal_pair();
        let row = |axis: Vec3, scale: f32, at: f32| (axis * scale).extend(at - centre.dot(axis) * scale);
        let rows = [row(right, 1.0 / radius, 0.0), row(up, 1.0 / radius, 0.0), row(toward, -0.5 / radius, 0.5), Vec4::W];
        Self {
            light_from_coat: Mat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose(),
            length: length / (2.0 * radius),
            bias: 3.0 * radius / side as f32,
        }
    }
}

/// A view's map, and what it takes to draw it.
#[derive(Debug)]
pub(crate) struct ShadowMap {
    pub(crate) targets: ShadowTargets,
    casting: Buffer,
    casting_count: u32,
    /// Whether what it shows has changed since it was drawn.
    stale: AtomicBool,
}

impl ShadowMap {
    pub(crate) fn new(device: &Device, side: u32) -> Self {
        Self {
            targets: ShadowTargets::new(device, side),
            casting: room(device, "casting shells", BufferUsages::VERTEX, (MOST_SHELLS * size_of::<u32>()) as u64),
            casting_count: 0,
            stale: AtomicBool::new(true),
        }
    }

    /// Which shells cast from now on; the map is drawn anew.
    pub(crate) fn set(&mut self, queue: &Queue, schedule: &Schedule) {
        let casting = casters(schedule);
        queue.write_buffer(&self.casting, 0, bytemuck::cast_slice(&casting));
        self.casting_count = casting.len() as u32;
        self.redraw();
    }

    /// Whether the next frame draws it.
    pub(crate) fn is_stale(&self) -> bool {
        self.stale.load(Ordering::Relaxed)
    }

    /// Has it drawn anew with the next frame.
    pub(crate) fn redraw(&self) {
        self.stale.store(true, Ordering::Relaxed);
    }

    /// Records the three passes, if anything has changed. `groups` are the frame's bindings, without the map and with its first hairs.
    pub(crate) fn record(&self, encoder: &mut CommandEncoder, casters: &Casters, groups: [&BindGroup; 2], coat: &GpuCoat, furry: bool) {
        if !self.stale.swap(false, Ordering::Relaxed) {
            return;
        }
        {
            let mut pass = self.pass(encoder, "shadow of the skin", None, LoadOp::Clear(1.0));
            begin(&mut pass, &casters.skin, groups[0], coat);
            pass.set_index_buffer(coat.faces.slice(..), IndexFormat::Uint32);
            pass.draw_indexed(0..coat.corner_count, 0, 0..1);
        }
        let furry = furry && self.casting_count > 0;
        for (label, target, clear, pipeline, group) in [
            ("first hair", &self.targets.fronts, 1.0, &casters.fronts, groups[0]),
            ("shadow of the hair", &self.targets.slices, 0.0, &casters.slices, groups[1]),
        ] {
            let mut pass = self.pass(encoder, label, Some((target, clear)), LoadOp::Load);
            if furry {
                begin(&mut pass, pipeline, group, coat);
                pass.set_vertex_buffer(1, self.casting.slice(..));
                pass.set_index_buffer(coat.furred_faces.slice(..), IndexFormat::Uint32);
                pass.draw_indexed(0..3 * coat.furred_face_count(), 0, 0..self.casting_count);
            }
        }
    }

    fn pass<'e>(
        &self,
        encoder: &'e mut CommandEncoder,
        label: &str,
        colour: Option<(&TextureView, f64)>,
        depth: LoadOp<f32>,
    ) -> RenderPass<'e> {
        let colour = colour.map(|(view, clear)| RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations { load: LoadOp::Clear(Color { r: clear, g: clear, b: clear, a: clear }), store: StoreOp::Store },
        });
        let attachments = [colour];
        encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some(label),
            color_attachments: if attachments[0].is_some() { &attachments } else { &[] },
            depth_stencil_attachment: Some(RenderPassDepthStencilAttachment {
                view: &self.targets.skin,
                depth_ops: Some(Operations { load: depth, store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..RenderPassDescriptor::default()
        })
    }
}

/// How far apart the shells are that cast: with levels of detail a power of two, so that from one level to the next the same ones do.
fn stride(schedule: &Schedule) -> u32 {
    let steps = (schedule.shells.len() as u32).saturating_sub(1).div_ceil(MOST_CASTING).max(1);
    if schedule.of_several { steps.next_power_of_two() } else { steps }
}

/// Which shells cast: from the outermost down, or those that stay at the coarser levels, or all, of which some fade.
fn casters(schedule: &Schedule) -> Vec<u32> {
    let (shells, stride) = (schedule.shells.len() as u32, stride(schedule));
    let first = if schedule.of_several { 0 } else { shells.saturating_sub(1) % stride };
    (1..shells).filter(|k| k % stride == first).collect()
}

/// How many shells of its own image one that casts stands for: where others are left out, half as many as it blends into the composite of two.
pub(crate) fn shells_each(schedule: &Schedule) -> f32 {
    let stride = stride(schedule) as f32;
    if stride > 1.0 { stride * (1.0 - 0.5 * schedule.blend) } else { 1.0 }
}

fn begin(pass: &mut RenderPass<'_>, pipeline: &RenderPipeline, group: &BindGroup, coat: &GpuCoat) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.set_bind_group(1, &coat.bind_group, &[]);
    pass.set_vertex_buffer(0, coat.tiles.slice(..));
}

/// The pipelines of the three passes.
#[derive(Clone, Debug)]
pub(crate) struct Casters {
    skin: RenderPipeline,
    fronts: RenderPipeline,
    slices: RenderPipeline,
}

/// What their shaders are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Casting {
    /// Hair bends on its way.
    pub(crate) bent: bool,
    /// Hair is cut off somewhere.
    pub(crate) cut: bool,
    /// There are several mixtures of hair.
    pub(crate) mixed: bool,
    /// Shells are more or less than their image.
    pub(crate) thickened: bool,
    /// Two levels of detail are blended.
    pub(crate) levels: bool,
}

/// Those made so far.
#[derive(Debug, Default)]
pub(crate) struct CasterCache(Mutex<HashMap<Casting, Casters>>);

impl CasterCache {
    pub(crate) fn get(&self, device: &Device, pipelines: &Pipelines, casting: Casting) -> Casters {
        // A panic elsewhere leaves whole pipelines in the map.
        let mut made = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        made.entry(casting).or_insert_with(|| Casters::new(device, pipelines, casting)).clone()
    }
}

impl Casters {
    fn new(device: &Device, pipelines: &Pipelines, casting: Casting) -> Self {
        let Casting { bent, cut, mixed, thickened, levels } = casting;
        let flags = [("BENT", bent), ("CUT", cut), ("MIXED", mixed), ("THICKENED", thickened), ("LEVELS", levels)];
        let flags: Vec<&str> = flags.iter().filter_map(|&(name, on)| on.then_some(name)).collect();
        let files =
            [PRELUDE[0], PRELUDE[1], PRELUDE[2], PRELUDE[3], include_str!("shaders/shadow.wgsl"), include_str!("shaders/shadow_cast.wgsl")];
        let module = device.create_shader_module(ShaderModuleDescriptor {
            label: Some("shadow"),
            source: ShaderSource::Wgsl(assemble(&files, &flags).into()),
        });
        let component = |operation| BlendComponent { src_factor: BlendFactor::One, dst_factor: BlendFactor::One, operation };
        let blend = |operation| Some(BlendState { color: component(operation), alpha: component(operation) });
        let shells = |fragment, format, operation| {
            let target = ColorTargetState { format, blend: blend(operation), write_mask: ColorWrites::ALL };
            pipeline(device, pipelines, &module, "shadow_shell_vertex", Some(&(fragment, target)))
        };
        Self {
            skin: pipeline(device, pipelines, &module, "shadow_skin_vertex", None),
            fronts: shells("shadow_front", TextureFormat::R16Float, BlendOperation::Min),
            slices: shells("shadow_opacity", TextureFormat::Rgba16Float, BlendOperation::Add),
        }
    }
}

fn pipeline(
    device: &Device,
    pipelines: &Pipelines,
    module: &wgpu::ShaderModule,
    vertex: &str,
    fragment: Option<&(&str, ColorTargetState)>,
) -> RenderPipeline {
    let targets = fragment.map(|(_, target)| Some(target.clone()));
    shell_buffers(|buffers| {
        device.create_render_pipeline(&RenderPipelineDescriptor {
            label: Some(vertex),
            layout: Some(pipelines.layout()),
            vertex: VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: PipelineCompilationOptions::default(),
                buffers: if fragment.is_some() { &buffers[..2] } else { &buffers[..1] },
            },
            // Hair that the light sees from behind stands behind skin.
            primitive: PrimitiveState { cull_mode: fragment.is_some().then_some(Face::Back), ..PrimitiveState::default() },
            depth_stencil: Some(DepthStencilState {
                format: TextureFormat::Depth32Float,
                depth_write_enabled: Some(fragment.is_none()),
                depth_compare: Some(CompareFunction::LessEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: fragment.map(|(entry, _)| FragmentState {
                module,
                entry_point: Some(entry),
                compilation_options: PipelineCompilationOptions::default(),
                targets: targets.as_slice(),
            }),
            multiview_mask: None,
            cache: None,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Detail, Options, Viewpoint};
    use pelage_coat::{Camera, ShellLayer};

    #[test]
    fn what_casts_stays_from_level_to_level() {
        let level = |shells: u32| (0..shells).map(|k| ShellLayer::plain(k as f32 / 32.0, k)).collect::<Vec<_>>();
        let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.01 };
        for shells in [2, 3, 8, 9, 12, 16, 17, 20, 31, 32, 128] {
            let levels = [level(shells), level(shells.div_ceil(2)), level(shells.div_ceil(4))];
            let at = |level_of_detail: f32| {
                let options = Options { detail: Detail::Level(level_of_detail), ..Options::default() };
                Schedule::new(&levels, &options, &Viewpoint::of(&camera, (64, 64)), 0.1)
            };
            for whole in [1.0, 2.0] {
                let (before, after) = (at(whole - 1e-6), at(whole));
                // Those that are left once the others have faded, in the coarser level's numbers.
                let left: Vec<u32> = casters(&before).iter().filter(|&k| k % 2 == 0).map(|k| k / 2).collect();
                assert_eq!(left, casters(&after), "{shells}, {whole}");
                assert!((shells_each(&before) - shells_each(&after)).abs() < 1e-3);
                // Nothing changes where the blend begins.
                assert_eq!(casters(&at(whole - 0.5)), casters(&at(whole - 0.4)));
                assert!(casters(&after).len() <= MOST_CASTING as usize);
            }
        }
    }

    #[test]
    fn the_lights_view_holds_the_ball() {
        let (centre, radius) = (Vec3::new(0.1, 0.2, -0.3), 0.5);
        for toward in [Vec3::Y, Vec3::new(0.3, -0.5, 0.8).normalize(), -Vec3::Z] {
            let view = LightView::of_ball(toward, centre, radius, 0.1, 1024);
            let at = |p: Vec3| view.light_from_coat.project_point3(p);
            assert!(at(centre).abs_diff_eq(Vec3::new(0.0, 0.0, 0.5), 1e-6));
            assert!((at(centre + radius * toward).z).abs() < 1e-6, "what is nearest to the light has depth 0");
            assert!((at(centre - radius * toward).z - 1.0).abs() < 1e-6);
            let aside = toward.any_orthonormal_vector();
            assert!((at(centre + radius * aside).truncate().length() - 1.0).abs() < 1e-5);
            assert!((view.length - 0.1).abs() < 1e-6);
        }
    }
}
