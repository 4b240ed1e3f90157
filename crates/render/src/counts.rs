//! What the device picked for a frame, brought back to be counted.

use wgpu::{Buffer, CommandEncoder, CommandEncoderDescriptor, Device, Queue};

use crate::{FrameStats, PreparedView, RenderError, readback};

impl PreparedView {
    /// What the last [`crate::Renderer::compute`] or [`crate::Renderer::find_hidden`] that was submitted has the device draw; without times. Waits for
    /// the device.
    ///
    /// # Errors
    /// A lost device.
    pub fn frame_stats(&self, device: &Device, queue: &Queue) -> Result<FrameStats, RenderError> {
        self.counts(device, queue).read(device, self)
    }

    /// The faces, as patch vertices, of which it has the device draw the shells: to inspect, and to measure by. Waits for the device.
    ///
    /// # Errors
    /// A lost device.
    pub fn shell_faces(&self, device: &Device, queue: &Queue) -> Result<Vec<[u32; 3]>, RenderError> {
        let counts = self.counts(device, queue);
        let drawn = counts.read(device, self)?.faces_drawn;
        let corners: Vec<u32> = if self.frame.shown.culling {
            readback::read(device, &counts.survivors, bytemuck::pod_collect_to_vec)?
        } else {
            let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor { label: Some("shell faces") });
            let all = copy(device, &mut encoder, &self.frame.coat.furred_faces);
            queue.submit([encoder.finish()]);
            readback::read(device, &all, bytemuck::pod_collect_to_vec)?
        };
        Ok(corners.chunks_exact(3).take(drawn as usize).map(|face| [face[0], face[1], face[2]]).collect())
    }

    fn counts(&self, device: &Device, queue: &Queue) -> Counts {
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor { label: Some("counts") });
        let counts = Counts::record(device, &mut encoder, self);
        queue.submit([encoder.finish()]);
        counts
    }
}

fn copy(device: &Device, encoder: &mut CommandEncoder, from: &Buffer) -> Buffer {
    let to = readback::readable(device, from.size());
    encoder.copy_buffer_to_buffer(from, 0, &to, 0, from.size());
    to
}

/// Copies of the draws' arguments and of the faces that were picked.
#[derive(Debug)]
pub(crate) struct Counts {
    fins: Buffer,
    faces: Buffer,
    survivors: Buffer,
}

impl Counts {
    /// Records the copies, after what picks.
    pub(crate) fn record(device: &Device, encoder: &mut CommandEncoder, view: &PreparedView) -> Self {
        let mut copy = |from: &Buffer| copy(device, encoder, from);
        Self { fins: copy(&view.picks.fins.draws), faces: copy(&view.picks.faces.draws), survivors: copy(&view.picks.faces.survivors) }
    }

    /// Waits for the device and counts.
    pub(crate) fn read(&self, device: &Device, view: &PreparedView) -> Result<FrameStats, RenderError> {
        let coat = &view.frame.coat;
        let words = |buffer| readback::read(device, buffer, bytemuck::pod_collect_to_vec::<u8, u32>);
        let fins = if view.frame.shown.fins { words(&self.fins)?[1] } else { 0 };
        let corners = words(&self.survivors)?;
        let arguments = words(&self.faces)?;
        let faces_up_to = |run: usize| if view.frame.shown.culling { arguments[5 * run] / 3 } else { coat.runs[run].faces };
        let (mut shell_faces, mut faces_drawn) = (0, 0);
        for (run, range) in view.draws.iter().enumerate().filter(|(_, range)| view.frame.shown.shells && range.start < range.end) {
            shell_faces += u64::from(range.end - range.start) * u64::from(faces_up_to(run));
            faces_drawn = faces_drawn.max(faces_up_to(run));
        }
        let mut drawn = vec![false; coat.patch_count as usize];
        if view.frame.shown.culling {
            for &corner in &corners[..3 * faces_drawn as usize] {
                drawn[coat.patch_of[corner as usize] as usize] = true;
            }
        }
        let skin = if view.frame.shown.surface { u64::from(coat.corner_count / 3) } else { 0 };
        let patches_drawn = if view.frame.shown.culling { drawn.iter().filter(|&&drawn| drawn).count() as u32 } else { coat.patch_count };
        Ok(FrameStats {
            shells_drawn: view.shell_count(),
            faces_drawn,
            faces_furred: coat.furred_face_count(),
            patches_drawn: if faces_drawn > 0 { patches_drawn } else { 0 },
            patches: coat.patch_count,
            level: view.level(),
            fins_drawn: fins,
            fins_considered: view.fins_considered(),
            triangles: skin + 2 * u64::from(view.frame.shown.fin_segments) * u64::from(fins) + shell_faces,
            fragments: None,
            passes: None,
        })
    }
}

impl PreparedView {
    /// The edges that the last frame put a fin on, in the order in which they are drawn, and how strongly each shows, 0 to 1. Waits for the device: to look
    /// at, not for every frame.
    ///
    /// # Errors
    /// A lost device.
    pub fn read_fins(&self, device: &Device, queue: &Queue) -> Result<Vec<(u32, f32)>, RenderError> {
        if !self.frame.shown.fins {
            return Ok(Vec::new());
        }
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor { label: Some("fins") });
        let [draws, survivors] = [&self.picks.fins.draws, &self.picks.fins.survivors].map(|from| copy(device, &mut encoder, from));
        queue.submit([encoder.finish()]);
        let words = |buffer| readback::read(device, buffer, bytemuck::pod_collect_to_vec::<u8, u32>);
        let count = words(&draws)?[1] as usize;
        Ok(words(&survivors)?.chunks_exact(2).take(count).map(|fin| (fin[0], f32::from_bits(fin[1]))).collect())
    }
}
