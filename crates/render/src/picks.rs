//! What one view picks of its coat on the device.

use std::ops::Range;

use wgpu::{BindGroup, Buffer, CommandEncoder, ComputePass, ComputePassDescriptor, Device, Queue, TextureView};

use crate::pyramid::Pyramid;
use crate::selection::{Kind, Selection};
use crate::shared::Shared;
use crate::{DepthBuffer, GpuCoat};

/// The edges with a fin, the faces that can be seen, and what hides some of them.
#[derive(Debug)]
pub(crate) struct Picks {
    pub(crate) fins: Selection,
    pub(crate) faces: Selection,
    hidden: Option<Hidden>,
}

/// What hides faces: the squares of the last depth buffer that was asked about.
#[derive(Debug)]
struct Hidden {
    depth: TextureView,
    size: (u32, u32),
    pyramid: Pyramid,
    scene: BindGroup,
}

impl Picks {
    pub(crate) fn new(device: &Device, queue: &Queue, shared: &Shared, frame: &Buffer, coat: &GpuCoat) -> Self {
        let of = |kind| Selection::new(device, queue, &shared.selectors, kind, frame, coat);
        Self { fins: of(Kind::Fins), faces: of(Kind::Faces), hidden: None }
    }

    /// Says what is drawn of each pick: fins of so many quads, and for each run of faces a range of shells.
    pub(crate) fn set(&self, queue: &Queue, fin_segments: u32, draws: &[Range<u32>]) {
        queue.write_buffer(&self.fins.draws, 0, bytemuck::cast_slice(&[2 * (fin_segments + 1), 0, 0, 0]));
        let arguments: Vec<[u32; 5]> = draws.iter().map(|range| [0, range.end - range.start, 0, 0, 0]).collect();
        queue.write_buffer(&self.faces.draws, 0, bytemuck::cast_slice(&arguments));
    }

    /// Records the picking of what there is to pick.
    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, shared: &Shared, fins: bool, faces: bool) {
        if fins {
            self.fins.record(pass, &shared.selectors);
        }
        if faces {
            self.faces.record(pass, &shared.selectors);
        }
    }

    /// Records the picking of faces anew, by what hides them.
    pub(crate) fn record_unhidden(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        shared: &Shared,
        (frame, coat): (&Buffer, &GpuCoat),
        depth: DepthBuffer<'_>,
    ) {
        let DepthBuffer { view, size } = depth;
        if self.hidden.as_ref().is_none_or(|hidden| (&hidden.depth, hidden.size) != (view, size)) {
            let pyramid = Pyramid::new(device, queue, shared.pyramids(device), view, size);
            let scene = Selection::scene_before(device, &shared.selectors, frame, coat, &pyramid.furthest);
            self.hidden = Some(Hidden { depth: view.clone(), size, pyramid, scene });
        }
        if let Some(hidden) = &self.hidden {
            let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor { label: Some("hidden faces"), timestamp_writes: None });
            hidden.pyramid.record(&mut pass, shared.pyramids(device));
            self.faces.record_unhidden(&mut pass, &shared.selectors, &hidden.scene);
        }
    }
}
