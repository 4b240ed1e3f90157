//! The faces on which shells stand, those with the longest hair first.

use glam::Vec3;
use pelage_coat::Coat;

/// Into how many classes cut hair is sorted by where it ends.
const CLASSES: usize = 8;

/// The faces of which a corner has fur, in runs that each are drawn from the first face to the run's end: hair that is cut off lower stands in later
/// runs, and shells above it are drawn without them. Where no hair is cut there is one run, in the order of the coat.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FurredFaces {
    /// Patch vertices.
    pub(crate) faces: Vec<[u32; 3]>,
    /// The run of each face.
    pub(crate) run_of: Vec<u32>,
    /// The runs.
    pub(crate) runs: Vec<Run>,
}

/// Faces whose hair ends alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    /// How many faces there are up to its end.
    pub(crate) faces: u32,
    /// No hair of it ends above.
    pub(crate) top: f32,
}

impl FurredFaces {
    /// Of a coat that has passed its own check.
    pub(crate) fn of(coat: &Coat) -> Self {
        let vertex = |corner: u32| coat.patches.vertices[corner as usize] as usize;
        let end = |face: &[u32; 3]| face.iter().map(|&c| coat.surface.ends[vertex(c)]).fold(0.0, f32::max);
        let furred = |face: &&[u32; 3]| end(face) > 0.0 && face.iter().any(|&c| coat.surface.offsets[vertex(c)] != Vec3::ZERO);
        let mut classes: [Vec<[u32; 3]>; CLASSES] = Default::default();
        for face in coat.patches.faces.iter().filter(furred) {
            let class = (end(face) * CLASSES as f32).ceil() as usize;
            classes[class.clamp(1, CLASSES) - 1].push(*face);
        }
        let mut furred = Self::default();
        for (class, faces) in classes.iter().enumerate().rev().filter(|(_, faces)| !faces.is_empty()) {
            furred.run_of.extend(std::iter::repeat_n(furred.runs.len() as u32, faces.len()));
            furred.faces.extend(faces);
            furred.runs.push(Run { faces: furred.faces.len() as u32, top: (class + 1) as f32 / CLASSES as f32 });
        }
        furred
    }
}

/// The last run that a shell at `height` is drawn for, where hair fades over `spacing` beyond its end; `None` above all hair.
pub(crate) fn last_run(runs: &[Run], height: f32, spacing: f32) -> Option<usize> {
    runs.iter().rposition(|run| run.top >= 1.0 || run.top + spacing > height)
}
