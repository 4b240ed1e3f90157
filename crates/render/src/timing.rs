//! How long frames take.

use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoder, ComputePassTimestampWrites, Device, Features, QuerySet, QuerySetDescriptor,
    QueryType, Queue, RenderPassTimestampWrites,
};

use crate::{RenderError, readback};

/// Milliseconds of each pass on the graphics device.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassTimes {
    /// What is worked out ahead: which fins and which faces; not what the skin hides, nor the shadow map, which is drawn only when it is stale.
    pub compute: f64,
    /// Background and skin.
    pub surface: f64,
    /// Fins.
    pub fins: f64,
    /// Shells, and resolving the samples.
    pub shells: f64,
}

/// Times of a frame drawn again and again, in milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameTimes {
    /// Frames that were timed, the warm-up not counted.
    pub frames: u32,
    /// The shortest, from submission until the device is done.
    pub ms_min: f64,
    /// The median.
    pub ms_median: f64,
    /// The longest.
    pub ms_max: f64,
    /// The medians of the passes, where the device has timestamps; from frames of their own, as passes that are timed apart cannot overlap.
    pub passes: Option<PassTimes>,
}

/// The median of some times; 0 of none.
pub(crate) fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}

impl FrameTimes {
    pub(crate) fn of(mut frames: Vec<f64>, passes: &[PassTimes]) -> Self {
        let ms_median = median(&mut frames);
        let of_passes = |pick: fn(&PassTimes) -> f64| median(&mut passes.iter().map(pick).collect::<Vec<_>>());
        Self {
            frames: frames.len() as u32,
            ms_min: frames.first().copied().unwrap_or(0.0),
            ms_median,
            ms_max: frames.last().copied().unwrap_or(0.0),
            passes: (!passes.is_empty()).then(|| PassTimes {
                compute: of_passes(|p| p.compute),
                surface: of_passes(|p| p.surface),
                fins: of_passes(|p| p.fins),
                shells: of_passes(|p| p.shells),
            }),
        }
    }
}

/// Timestamps before and after each pass.
#[derive(Debug)]
pub(crate) struct PassTimer {
    queries: QuerySet,
    resolved: Buffer,
    readable: Buffer,
}

const STAMPS: u32 = 8;
const BYTES: u64 = 8 * STAMPS as u64;

impl PassTimer {
    /// A timer, if the device has timestamps.
    pub(crate) fn new(device: &Device) -> Option<Self> {
        device.features().contains(Features::TIMESTAMP_QUERY).then(|| Self {
            queries: device.create_query_set(&QuerySetDescriptor { label: Some("pass times"), ty: QueryType::Timestamp, count: STAMPS }),
            resolved: device.create_buffer(&BufferDescriptor {
                label: Some("pass times"),
                size: BYTES,
                usage: BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            readable: readback::readable(device, BYTES),
        })
    }

    /// The two stamps of the compute pass.
    pub(crate) fn compute_writes(&self) -> ComputePassTimestampWrites<'_> {
        ComputePassTimestampWrites { query_set: &self.queries, beginning_of_pass_write_index: Some(0), end_of_pass_write_index: Some(1) }
    }

    /// The two stamps of drawing pass 0 to 2.
    pub(crate) fn writes(&self, pass: u32) -> RenderPassTimestampWrites<'_> {
        RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * pass + 2),
            end_of_pass_write_index: Some(2 * pass + 3),
        }
    }

    /// Records the way of the stamps to where they can be read.
    pub(crate) fn resolve(&self, encoder: &mut CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..STAMPS, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, BYTES);
    }

    /// Waits and reads.
    pub(crate) fn read(&self, device: &Device, queue: &Queue) -> Result<PassTimes, RenderError> {
        let period = f64::from(queue.get_timestamp_period()) * 1e-6;
        readback::read(device, &self.readable, |bytes| {
            let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(bytes);
            let ms = |pass: usize| stamps[2 * pass + 1].saturating_sub(stamps[2 * pass]) as f64 * period;
            PassTimes { compute: ms(0), surface: ms(1), fins: ms(2), shells: ms(3) }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_extremes() {
        let pass = |shells| PassTimes { compute: 0.5, surface: 1.0, fins: 2.0, shells };
        let times = FrameTimes::of(vec![3.0, 1.0, 9.0], &[pass(5.0), pass(4.0), pass(8.0)]);
        assert_eq!((times.frames, times.ms_min, times.ms_median, times.ms_max), (3, 1.0, 3.0, 9.0));
        assert_eq!(times.passes, Some(pass(5.0)));
        assert_eq!(FrameTimes::of(vec![], &[]), FrameTimes::default());
    }
}
