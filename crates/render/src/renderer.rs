//! Draws coats into a render pass of the caller's.

use std::ops::Range;

use pelage_coat::Coat;
use pelage_lighting::LightingTable;
use wgpu::{
    AddressMode, BindGroup, BindGroupDescriptor, BindGroupEntry, BindingResource, BufferDescriptor, BufferUsages, Device, FilterMode,
    IndexFormat, MipmapFilterMode, Queue, RenderPass, Sampler, SamplerDescriptor, TextureView,
};

use crate::pipelines::{PassPipelines, Pipelines};
use crate::textures::{no_table, upload_table};
use crate::uniforms::FrameUniform;
use crate::{GpuCoat, GpuTextures, LightingMode, RenderError, Target, View, Viewpoint, fin_opacity, limits};

/// Pipelines for one kind of target.
#[derive(Debug)]
pub struct Renderer {
    target: Target,
    pipelines: Pipelines,
    /// Bound where no table is asked for.
    no_table: TextureView,
    table_sampler: Sampler,
}

/// A view of a coat, packed for the device.
#[derive(Debug)]
pub struct PreparedView {
    bind_group: BindGroup,
    pipelines: PassPipelines,
    surface: bool,
    fins: bool,
    runs: [Range<u32>; 2],
    viewpoint: Viewpoint,
    length_scale: f32,
}

impl Renderer {
    /// A renderer for passes with this kind of target.
    ///
    /// The device must allow four storage buffers in the vertex stage, as wgpu's default limits do; no features are needed.
    pub fn new(device: &Device, queue: &Queue, target: Target) -> Self {
        Self {
            target,
            pipelines: Pipelines::new(device, target),
            no_table: no_table(device, queue),
            table_sampler: sampler(device, "table", AddressMode::ClampToEdge, AddressMode::ClampToEdge, 1),
        }
    }

    /// What it draws into.
    pub fn target(&self) -> Target {
        self.target
    }

    /// Checks a coat and brings it onto the device.
    ///
    /// # Errors
    /// What [`Coat::check`] finds; more of something than the device's limits allow.
    pub fn upload(&self, device: &Device, queue: &Queue, coat: &Coat) -> Result<GpuCoat, RenderError> {
        coat.check()?;
        limits::check_coat(&device.limits(), coat)?;
        let textures = GpuTextures::new(device, queue, &coat.shells, coat.fin.as_deref());
        Ok(GpuCoat::new(device, queue, &self.pipelines.coat_layout, coat, textures))
    }

    /// As [`Renderer::upload`], with textures that are on the device already in place of the coat's own.
    ///
    /// # Errors
    /// As there.
    pub fn upload_sharing(&self, device: &Device, queue: &Queue, coat: &Coat, textures: &GpuTextures) -> Result<GpuCoat, RenderError> {
        coat.check()?;
        limits::check_coat(&device.limits(), coat)?;
        Ok(GpuCoat::new(device, queue, &self.pipelines.coat_layout, coat, textures.clone()))
    }

    /// Packs a view of a coat from `viewpoint`, the view's own camera or another; [`Renderer::draw`] then needs no device.
    ///
    /// # Errors
    /// Numbers that are not finite; a lighting table of impossible size.
    pub fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        coat: &GpuCoat,
        view: &View,
        viewpoint: &Viewpoint,
    ) -> Result<PreparedView, RenderError> {
        let uniform = FrameUniform::new(view, viewpoint, coat.layers())?;
        let buffer = device.create_buffer(&BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameUniform>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        queue.write_buffer(&buffer, 0, bytemuck::bytes_of(&uniform));
        let table = match view.options.lighting {
            LightingMode::Table(layout) => upload_table(device, queue, &LightingTable::new(&view.shading.hair, layout)?),
            LightingMode::PerVertex | LightingMode::Formula => self.no_table.clone(),
        };
        let anisotropy = view.options.anisotropy.clamp(1, 16);
        let resources = [
            buffer.as_entire_binding(),
            BindingResource::TextureView(&table),
            BindingResource::Sampler(&self.table_sampler),
            BindingResource::Sampler(&sampler(device, "tile", AddressMode::Repeat, AddressMode::Repeat, anisotropy)),
            // Toroidal along the skin, not from tips to roots.
            BindingResource::Sampler(&sampler(device, "fin", AddressMode::Repeat, AddressMode::ClampToEdge, anisotropy)),
        ];
        let entries = resources.into_iter().zip(0..).map(|(resource, binding)| BindGroupEntry { binding, resource }).collect::<Vec<_>>();
        let bind_group = device.create_bind_group(&BindGroupDescriptor {
            label: Some("frame"),
            layout: &self.pipelines.frame_layout,
            entries: &entries,
        });
        let options = &view.options;
        // Without length there is no fur to draw: the bald picture, exactly.
        let furry = options.length_scale > 0.0 && coat.furred_corner_count > 0;
        Ok(PreparedView {
            bind_group,
            pipelines: self.pipelines.get(device, options.lighting, options.shell_depth),
            surface: options.surface,
            fins: options.fins && furry,
            runs: if options.shells && furry { options.layers.runs(coat.layers()) } else { [0..0, 0..0] },
            viewpoint: *viewpoint,
            length_scale: options.length_scale,
        })
    }

    /// Records surface, fins and shells into a pass of this renderer's [`Target`].
    pub fn draw(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, view: &PreparedView) {
        self.draw_surface(pass, coat, view);
        self.draw_fins(pass, coat, view);
        self.draw_shells(pass, coat, view);
    }

    /// The opaque skin alone (L10).
    pub fn draw_surface(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, view: &PreparedView) {
        if !view.surface || coat.corner_count == 0 {
            return;
        }
        pass.set_pipeline(&view.pipelines.surface);
        bind(pass, coat, view);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        pass.set_index_buffer(coat.faces.slice(..), IndexFormat::Uint32);
        pass.draw_indexed(0..coat.corner_count, 0, 0..1);
    }

    /// The fins alone (L11); the skin's depth should be there.
    pub fn draw_fins(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, view: &PreparedView) {
        if !view.fins || coat.edge_count == 0 {
            return;
        }
        pass.set_pipeline(&view.pipelines.fins);
        bind(pass, coat, view);
        pass.draw(0..4, 0..coat.edge_count);
    }

    /// The layers alone (L12, L17), innermost first.
    pub fn draw_shells(&self, pass: &mut RenderPass<'_>, coat: &GpuCoat, view: &PreparedView) {
        if view.shell_count() == 0 || coat.furred_corner_count == 0 {
            return;
        }
        pass.set_pipeline(&view.pipelines.shells);
        bind(pass, coat, view);
        pass.set_vertex_buffer(0, coat.tiles.slice(..));
        pass.set_index_buffer(coat.furred_faces.slice(..), IndexFormat::Uint32);
        for run in view.runs.iter().filter(|run| !run.is_empty()) {
            pass.draw_indexed(0..coat.furred_corner_count, 0, run.clone());
        }
    }
}

impl PreparedView {
    /// How many layers are drawn as shells; the skin is not among them.
    pub fn shell_count(&self) -> u32 {
        self.runs.iter().map(|run| run.end - run.start).sum()
    }

    /// How many fins are drawn, by the shader's own formula on the processor.
    pub fn fin_count(&self, coat: &GpuCoat) -> u32 {
        if !self.fins {
            return 0;
        }
        let drawn = |edge| fin_opacity(edge, self.viewpoint.toward_eye, self.length_scale) > 0.0;
        coat.fin_edges.iter().filter(|edge| drawn(edge)).count() as u32
    }

    /// How many triangles that makes, skin, fins and shells.
    pub fn triangle_count(&self, coat: &GpuCoat) -> u64 {
        let skin = if self.surface { u64::from(coat.corner_count / 3) } else { 0 };
        skin + 2 * u64::from(self.fin_count(coat)) + u64::from(self.shell_count()) * u64::from(coat.furred_corner_count / 3)
    }

    /// How many edges are looked at for fins.
    pub fn fins_considered(&self, coat: &GpuCoat) -> u32 {
        if self.fins { coat.edge_count } else { 0 }
    }
}

fn bind(pass: &mut RenderPass<'_>, coat: &GpuCoat, view: &PreparedView) {
    pass.set_bind_group(0, &view.bind_group, &[]);
    pass.set_bind_group(1, &coat.bind_group, &[]);
}

fn sampler(device: &Device, label: &str, u: AddressMode, v: AddressMode, anisotropy: u16) -> Sampler {
    device.create_sampler(&SamplerDescriptor {
        label: Some(label),
        address_mode_u: u,
        address_mode_v: v,
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        mipmap_filter: MipmapFilterMode::Linear,
        anisotropy_clamp: anisotropy,
        ..SamplerDescriptor::default()
    })
}
