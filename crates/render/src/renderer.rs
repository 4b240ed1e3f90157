//! Draws coats into a render pass of the caller's.

use glam::Mat4;
use pelage_coat::{Coat, Encoding};
use wgpu::{CommandEncoder, ComputePassDescriptor, ComputePassTimestampWrites, Device, Features, Queue, RenderPass};

use crate::crowd::Crowd;
use crate::shared::Shared;
use crate::{DepthBuffer, GpuCoat, GpuTextures, PreparedView, RenderError, Target, View, Viewpoint, limits};

/// Pipelines for one kind of target.
#[derive(Debug)]
pub struct Renderer {
    target: Target,
    shared: Shared,
}

impl Renderer {
    /// A renderer for passes with this kind of target.
    ///
    /// The device's limits must be wgpu's defaults at least (five storage buffers in the vertex stage, eight in compute shaders are used); no features are
    /// needed, but for textures in blocks `TEXTURE_COMPRESSION_BC`.
    pub fn new(device: &Device, queue: &Queue, target: Target) -> Self {
        Self { target, shared: Shared::new(device, queue, target) }
    }

    /// What it draws into.
    pub fn target(&self) -> Target {
        self.target
    }

    /// Checks a coat and brings it onto the device.
    ///
    /// # Errors
    /// What [`Coat::check`] finds; more of something than the device's limits allow; textures in blocks on a device that does not read them.
    pub fn upload(&self, device: &Device, queue: &Queue, coat: &Coat) -> Result<GpuCoat, RenderError> {
        check(device, coat)?;
        let textures = GpuTextures::new(device, queue, &coat.shells, coat.fin.as_deref());
        Ok(GpuCoat::new(device, queue, &self.shared.pipelines.coat_layout, coat, textures))
    }

    /// As [`Renderer::upload`], with textures that are on the device already in place of the coat's own.
    ///
    /// # Errors
    /// As there.
    pub fn upload_sharing(&self, device: &Device, queue: &Queue, coat: &Coat, textures: &GpuTextures) -> Result<GpuCoat, RenderError> {
        check(device, coat)?;
        Ok(GpuCoat::new(device, queue, &self.shared.pipelines.coat_layout, coat, textures.clone()))
    }

    /// Makes a view of a coat from `viewpoint`, the view's own camera or another. What it allocates serves for all frames that [`Renderer::update`]
    /// moves it to.
    ///
    /// # Errors
    /// Numbers that are not finite; a lighting table of impossible size; too many lights.
    pub fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        coat: &GpuCoat,
        view: &View,
        viewpoint: &Viewpoint,
    ) -> Result<PreparedView, RenderError> {
        PreparedView::new(device, queue, &self.shared, coat, (view, viewpoint))
    }

    /// Moves a view to the next frame's: a few kilobytes are written, pipelines are made where options are used for the first
    /// time, or a view comes between two levels of detail.
    ///
    /// # Errors
    /// Those of [`Renderer::prepare`]; the view is then as it was.
    pub fn update(
        &self,
        device: &Device,
        queue: &Queue,
        prepared: &mut PreparedView,
        view: &View,
        viewpoint: &Viewpoint,
    ) -> Result<(), RenderError> {
        prepared.update(device, queue, &self.shared, (view, viewpoint))
    }

    /// Records what comes ahead of the pass that draws: which fins and which faces, and the shadow map where it is stale. Once a frame; the map
    /// counts as drawn from here on, so that whoever throws the encoder away calls [`PreparedView::redraw_shadows`].
    pub fn compute(&self, encoder: &mut CommandEncoder, view: &PreparedView) {
        self.compute_timed(encoder, view, None);
    }

    pub(crate) fn compute_timed(&self, encoder: &mut CommandEncoder, view: &PreparedView, times: Option<ComputePassTimestampWrites<'_>>) {
        if view.picks() {
            let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("pelage"), timestamp_writes: times });
            view.record(&mut pass, &self.shared);
        }
        view.frame.record_shadows(encoder);
    }

    /// Leaves out the shells of faces that what has been drawn so far hides (K18): between the pass that draws the surface and all else that is opaque, and the
    /// one that draws fins and shells. It pays where much fur stands behind something; without it such fur costs its vertices and fails the depth test.
    pub fn find_hidden(
        &self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        view: &mut PreparedView,
        depth: DepthBuffer<'_>,
    ) {
        view.record_hidden(device, queue, encoder, &self.shared, depth);
    }

    /// Makes room for one coat at `most` places at once, drawn together; see [`Crowd`]. The frame is the world's: camera and lights are not carried over.
    ///
    /// # Errors
    /// Those of [`Renderer::prepare`]; more places than the device has room for.
    pub fn prepare_crowd(
        &self,
        device: &Device,
        queue: &Queue,
        coat: &GpuCoat,
        (view, world): (&View, &Viewpoint),
        most: u32,
    ) -> Result<Crowd, RenderError> {
        Crowd::new(device, queue, &self.shared, coat, (view, world), most)
    }

    /// Moves a crowd to the next frame: `places` are the matrices from the coat to the world, which turn, move and scale evenly and do not mirror; `world` is the camera with
    /// [`Viewpoint::clip_from_coat`] from the world to clip space and the eye in the world.
    ///
    /// # Errors
    /// Those of [`Renderer::prepare`]; more places than there is room for.
    pub fn update_crowd(
        &self,
        device: &Device,
        queue: &Queue,
        crowd: &mut Crowd,
        (view, world): (&View, &Viewpoint),
        places: &[Mat4],
    ) -> Result<(), RenderError> {
        crowd.update(device, queue, &self.shared, (view, world), places)
    }

    /// The opaque skin of a crowd; nothing is to be computed ahead.
    pub fn draw_crowd_surface(&self, pass: &mut RenderPass<'_>, crowd: &Crowd) {
        crowd.draw_surface(pass);
    }

    /// The shells of a crowd, after the skin of everything.
    pub fn draw_crowd_shells(&self, pass: &mut RenderPass<'_>, crowd: &Crowd) {
        crowd.draw_shells(pass);
    }

    /// Records surface, fins and shells into a pass of this renderer's [`Target`], after [`Renderer::compute`].
    pub fn draw(&self, pass: &mut RenderPass<'_>, view: &PreparedView) {
        self.draw_surface(pass, view);
        self.draw_fins(pass, view);
        self.draw_shells(pass, view);
    }

    /// The opaque skin alone (L10).
    pub fn draw_surface(&self, pass: &mut RenderPass<'_>, view: &PreparedView) {
        view.draw_surface(pass);
    }

    /// The fins alone (L11); the skin's depth should be there.
    pub fn draw_fins(&self, pass: &mut RenderPass<'_>, view: &PreparedView) {
        view.draw_fins(pass);
    }

    /// The layers alone (L12, L17), innermost first.
    pub fn draw_shells(&self, pass: &mut RenderPass<'_>, view: &PreparedView) {
        view.draw_shells(pass);
    }
}

fn check(device: &Device, coat: &Coat) -> Result<(), RenderError> {
    coat.check()?;
    limits::check_coat(&device.limits(), coat)?;
    if coat.shells.encoding == Encoding::Rgba8 {
        return Ok(());
    }
    if !device.features().contains(Features::TEXTURE_COMPRESSION_BC) {
        return Err(RenderError::Encoding { what: "in blocks (BC3)", remedy: "leave it uncompressed" });
    }
    if !coat.shells.resolution().is_multiple_of(4) {
        return Err(RenderError::Encoding { what: "in blocks of 4 × 4 that do not fill it", remedy: "sample at least 4 × 4 texels" });
    }
    Ok(())
}
