//! How many samples pass the tests.

use wgpu::{Buffer, BufferDescriptor, BufferUsages, CommandEncoder, Device, QuerySet, QuerySetDescriptor, QueryType, RenderPass};

use crate::{RenderError, readback};

/// Samples that pass the depth test, all of a pixel's counted: what blending and writing go with.
///
/// They come from occlusion queries. An adapter may answer those with no more than whether there was any, 1 for many; Mesa's software ones count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fragments {
    /// Of the skin.
    pub surface: u64,
    /// Of the fins.
    pub fins: u64,
    /// Of the shells.
    pub shells: u64,
}

impl Fragments {
    /// All of them.
    pub fn total(&self) -> u64 {
        self.surface + self.fins + self.shells
    }
}

/// What is drawn, and counted, apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Surface,
    Fins,
    Shells,
}

impl Part {
    /// In the order in which they are drawn.
    pub(crate) const ALL: [Self; 3] = [Self::Surface, Self::Fins, Self::Shells];
}

const PARTS: u32 = Part::ALL.len() as u32;
const BYTES: u64 = 8 * PARTS as u64;

/// A query for each part of a frame.
#[derive(Debug)]
pub(crate) struct FragmentCounter {
    queries: QuerySet,
    resolved: Buffer,
    readable: Buffer,
}

impl FragmentCounter {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            queries: device.create_query_set(&QuerySetDescriptor { label: Some("fragments"), ty: QueryType::Occlusion, count: PARTS }),
            resolved: device.create_buffer(&BufferDescriptor {
                label: Some("fragments"),
                size: BYTES,
                usage: BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            readable: readback::readable(device, BYTES),
        }
    }

    /// What a pass that is counted begins with.
    pub(crate) fn queries(&self) -> &QuerySet {
        &self.queries
    }

    /// Records the way of the counts to where they can be read.
    pub(crate) fn resolve(&self, encoder: &mut CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..PARTS, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, BYTES);
    }

    /// Waits and reads.
    pub(crate) fn read(&self, device: &Device) -> Result<Fragments, RenderError> {
        readback::read(device, &self.readable, |bytes| {
            let counts: Vec<u64> = bytemuck::pod_collect_to_vec(bytes);
            Fragments { surface: counts[0], fins: counts[1], shells: counts[2] }
        })
    }
}

/// Draws a part of a frame, counted or not. The pass must have been begun with the counter's queries.
pub(crate) fn counted(counter: Option<&FragmentCounter>, part: Part, pass: &mut RenderPass<'_>, draw: impl FnOnce(&mut RenderPass<'_>)) {
    if counter.is_some() {
        pass.begin_occlusion_query(part as u32);
    }
    draw(pass);
    if counter.is_some() {
        pass.end_occlusion_query();
    }
}
