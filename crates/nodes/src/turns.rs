//! Frames timed in turn, so that a busy machine is unfair to all alike.

use std::sync::Arc;

use pelage_coat::Coat;
use pelage_graph::{EvaluateError, Evaluation, Graph, Registry};
use pelage_render::{GpuCoat, Offscreen, RenderError, TimedFrame};

use crate::{FrameReport, Gpu};

/// A picture that was drawn, ready to be drawn again.
#[derive(Clone, Debug)]
pub struct Contender {
    coat: Arc<Coat>,
    report: Arc<FrameReport>,
}

/// The output that the node of a picture draws, `coat.fur` say; none if the node has no fur linked. To be asked for
/// [on the way](pelage_graph::Request::and_on_the_way) to the picture by who wants a [`Contender`].
pub fn fur_of(graph: &Graph, registry: &Registry, picture: &str) -> Option<String> {
    graph.links(registry).into_iter().find(|link| link.node.as_str() == picture && link.field == "fur").map(|link| link.from)
}

impl Contender {
    /// From a run that kept the coat, an output of [`fur_of`], and the `frame` of the picture's node.
    ///
    /// # Errors
    /// If it did not keep them.
    pub fn of(evaluation: &Evaluation, fur: &str, frame: &str) -> Result<Self, EvaluateError> {
        Ok(Self { coat: evaluation.get(fur)?, report: evaluation.get(frame)? })
    }

    /// How it was drawn.
    pub fn report(&self) -> &FrameReport {
        &self.report
    }

    /// Bytes of the coat's textures, all mips: shells, directions and fin.
    pub fn texture_bytes(&self) -> usize {
        let shells = &self.coat.shells;
        shells.byte_size() + shells.direction_bytes() + self.coat.fin.as_ref().map_or(0, |fin| fin.byte_size())
    }

    /// Whether it is drawn on such a target.
    fn fits(&self, size: (u32, u32), samples: u32) -> bool {
        (self.report.size, self.report.samples) == (size, samples)
    }
}

/// Milliseconds of each contender's frame, round by round: in each round one frame of all, one after the other. All are warmed up before.
///
/// A load that comes and goes slows all frames of a round alike, so the ratio of two within a round is steadier than either; and the least of the rounds is that of the quietest.
/// Every coat is on the device at once.
///
/// # Errors
/// Those of drawing.
pub fn time_in_turn(gpu: &Gpu, contenders: &[Contender], rounds: u32) -> Result<Vec<Vec<f64>>, RenderError> {
    // One target for all pictures of a size: what is compiled is compiled once.
    let mut targets: Vec<((u32, u32), u32, Offscreen)> = Vec::new();
    for Contender { report, .. } in contenders {
        if !targets.iter().any(|(size, samples, _)| (report.size, report.samples) == (*size, *samples)) {
            targets.push((report.size, report.samples, Offscreen::new(gpu.headless(), report.size, report.samples)?));
        }
    }
    let mut frames: Vec<TimedFrame<'_>> = Vec::new();
    for contender in contenders {
        for (_, _, target) in targets.iter().filter(|(size, samples, _)| contender.fits(*size, *samples)) {
            let coat: GpuCoat = target.upload(&contender.coat)?;
            frames.push(target.timed_frame(&coat, &contender.report.view, &contender.report.background)?);
        }
    }
    (0..rounds).map(|_| frames.iter_mut().map(TimedFrame::draw).collect()).collect()
}
