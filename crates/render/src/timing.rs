//! How long frames take.

use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoder, ComputePassTimestampWrites, Device, Features, QuerySet, QuerySetDescriptor,
    QueryType, Queue, RenderPassTimestampWrites,
};

use crate::{RenderError, readback};

/// Milliseconds of each pass on the graphics device, none of one that there was not. The last one's are also those of resolving the samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassTimes {
    /// What is worked out ahead: which fins and which faces; not what the skin hides, nor the shadow map, which is drawn only when it is stale.
    pub compute: Option<f64>,
    /// Background and skin.
    pub surface: Option<f64>,
    /// Fins.
    pub fins: Option<f64>,
    /// Shells.
    pub shells: Option<f64>,
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
        let of_passes = |pick: fn(&PassTimes) -> Option<f64>| {
            let mut times: Vec<f64> = passes.iter().filter_map(pick).collect();
            (!times.is_empty()).then(|| median(&mut times))
        };
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

/// A pass that is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Timed {
    Compute,
    Surface,
    Fins,
    Shells,
}

/// The passes that a frame timed, in the order of their stamps.
#[derive(Debug, Default)]
pub(crate) struct Stamps(Vec<Timed>);

impl Stamps {
    /// The stamps before and after the next pass.
    fn next(&mut self, pass: Timed) -> (Option<u32>, Option<u32>) {
        let first = 2 * self.0.len() as u32;
        self.0.push(pass);
        (Some(first), Some(first + 1))
    }

    /// What they say of each pass, in milliseconds.
    fn times(&self, ms: impl Fn(usize) -> f64) -> PassTimes {
        let of = |pass: Timed| self.0.iter().position(|&timed| timed == pass).map(&ms);
        PassTimes { compute: of(Timed::Compute), surface: of(Timed::Surface), fins: of(Timed::Fins), shells: of(Timed::Shells) }
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

    /// The next two stamps, of a compute pass.
    pub(crate) fn compute_writes(&self, stamps: &mut Stamps) -> ComputePassTimestampWrites<'_> {
        let (beginning_of_pass_write_index, end_of_pass_write_index) = stamps.next(Timed::Compute);
        ComputePassTimestampWrites { query_set: &self.queries, beginning_of_pass_write_index, end_of_pass_write_index }
    }

    /// The next two stamps, of a pass that draws.
    pub(crate) fn writes(&self, stamps: &mut Stamps, pass: Timed) -> RenderPassTimestampWrites<'_> {
        let (beginning_of_pass_write_index, end_of_pass_write_index) = stamps.next(pass);
        RenderPassTimestampWrites { query_set: &self.queries, beginning_of_pass_write_index, end_of_pass_write_index }
    }

    /// Records the way of the stamps to where they can be read: of those that were written, as a device may wait for the others.
    pub(crate) fn resolve(&self, encoder: &mut CommandEncoder, stamps: &Stamps) {
        encoder.resolve_query_set(&self.queries, 0..2 * stamps.0.len() as u32, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, BYTES);
    }

    /// Waits and reads.
    pub(crate) fn read(&self, device: &Device, queue: &Queue, stamps: &Stamps) -> Result<PassTimes, RenderError> {
        let period = f64::from(queue.get_timestamp_period()) * 1e-6;
        readback::read(device, &self.readable, |bytes| {
            let written: Vec<u64> = bytemuck::pod_collect_to_vec(bytes);
            stamps.times(|pass| written[2 * pass + 1].saturating_sub(written[2 * pass]) as f64 * period)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_and_extremes() {
        let pass = |shells| PassTimes { compute: Some(0.5), surface: Some(1.0), fins: None, shells: Some(shells) };
        let times = FrameTimes::of(vec![3.0, 1.0, 9.0], &[pass(5.0), pass(4.0), pass(8.0)]);
        assert_eq!((times.frames, times.ms_min, times.ms_median, times.ms_max), (3, 1.0, 3.0, 9.0));
        assert_eq!(times.passes, Some(pass(5.0)));
        assert_eq!(FrameTimes::of(vec![], &[]), FrameTimes::default());
    }

    #[test]
    fn a_pass_that_there_was_not_has_no_time() {
        let mut stamps = Stamps::default();
        let pairs = [Timed::Surface, Timed::Shells].map(|pass| stamps.next(pass));
        assert_eq!(pairs, [(Some(0), Some(1)), (Some(2), Some(3))]);
        let expected = PassTimes { surface: Some(0.0), shells: Some(1.0), ..PassTimes::default() };
        assert_eq!(stamps.times(|pass| pass as f64), expected);
    }
}
