//! One coat at many places at once.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec4};
use wgpu::{Buffer, BufferUsages, Device, IndexFormat, Queue, RenderPass};

use crate::buffers::room;
use crate::frame::Frame;
use crate::frame_groups::FrameBuffers;
use crate::shared::Shared;
use crate::{Detail, GpuCoat, Options, RenderError, View, Viewpoint, schedule};

/// One coat at many places at once: a draw for each run of places with the same level of detail, in place of a view, its buffers and its draws for each.
/// It is for coats small on the screen. They have no fins, no shadow map, levels of detail that change at once ([`Detail::Whole`]), and all faces are
/// submitted; places out of view are left out. What comes near is better off with a [`crate::PreparedView`] of its own.
#[derive(Debug)]
pub struct Crowd {
    coat: GpuCoat,
    /// A view of the world for each level of detail.
    levels: Vec<Frame>,
    places: Buffer,
    most: u32,
    /// For each instance of a draw, its place and its shell: eight bits of shell at the bottom.
    skins: Buffer,
    shells: Buffer,
    skin_runs: Vec<Run>,
    shell_runs: Vec<Run>,
}

/// Most places: what an instance's word has room for beside the shell.
const MOST_PLACES: u32 = 1 << 24;

/// Instances of one level.
#[derive(Clone, Debug, PartialEq)]
struct Run {
    level: usize,
    instances: Range<u32>,
}

/// Mirrors `struct Place` of common.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Place([[f32; 4]; 3]);

/// What is seen of a crowd.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    number: u32,
    level: usize,
    distance: f32,
}

impl Crowd {
    pub(crate) fn new(
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        coat: &GpuCoat,
        (view, world): (&View, &Viewpoint),
        most: u32,
    ) -> Result<Self, RenderError> {
        let level_count = coat.textures.levels.len();
        let bytes = size_of::<Place>() as u64 * u64::from(most);
        let words = 4 * u64::from(most) * u64::from(coat.layers().max(1));
        let limits = device.limits();
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if most > MOST_PLACES {
            let (needed, limit) = (most.into(), MOST_PLACES.into());
            return Err(RenderError::Limit { what: "places of a crowd, so draw several", needed, limit });
        }
        if bytes.max(words) > limit {
            return Err(RenderError::Limit { what: "bytes of places of a crowd, so draw several", needed: bytes.max(words), limit });
        }
        let places = room(device, "places", BufferUsages::STORAGE, bytes);
        let prepare = |level: usize| {
            let target = (FrameBuffers::new(device), &places, true);
            Frame::new(device, queue, shared, coat, (&of_level(view, level), world), target)
        };
        Ok(Self {
            coat: coat.clone(),
            levels: (0..level_count).map(prepare).collect::<Result<_, _>>()?,
            most,
            skins: room(device, "skins of a crowd", BufferUsages::VERTEX, 4 * u64::from(most)),
            shells: room(device, "shells of a crowd", BufferUsages::VERTEX, words),
            skin_runs: Vec::new(),
            shell_runs: Vec::new(),
            places,
        })
    }

    pub(crate) fn update(
        &mut self,
        device: &Device,
        queue: &Queue,
        shared: &Shared,
        (view, world): (&View, &Viewpoint),
        places: &[Mat4],
    ) -> Result<(), RenderError> {
        if places.len() > self.most as usize {
            let (needed, limit) = (places.len() as u64, u64::from(self.most));
            return Err(RenderError::Limit { what: "places, so prepare the crowd for more", needed, limit });
        }
        if places.iter().any(|place| !place.is_finite()) {
            return Err(RenderError::View { what: "a place of the crowd" });
        }
        if let Some(place) = places.iter().position(|place| place.determinant() < 0.0) {
            return Err(RenderError::Mirrored { place });
        }
        for (level, prepared) in self.levels.iter_mut().enumerate() {
            prepared.update(device, queue, shared, (&of_level(view, level), world))?;
        }
        let rows: Vec<Place> = places.iter().map(|m| Place([m.row(0), m.row(1), m.row(2)].map(|row| row.to_array()))).collect();
        queue.write_buffer(&self.places, 0, bytemuck::cast_slice(&rows));
        let seen = seen(&self.coat, view, world, places);
        // The near before the far: what it hides fails the depth test.
        let skins = seen.iter().rev().map(|seen| (seen.level, seen.number << 8));
        self.skin_runs = write(queue, &self.skins, skins);
        let drawn = |level: usize| self.levels.get(level).map_or(&[][..], |level| &level.schedule.drawn);
        let shells = seen.iter().flat_map(|seen| drawn(seen.level).iter().map(|shell| (seen.level, seen.number << 8 | shell)));
        self.shell_runs = write(queue, &self.shells, shells);
        Ok(())
    }

    pub(crate) fn draw_surface(&self, pass: &mut RenderPass<'_>) {
        for Run { level, instances } in &self.skin_runs {
            self.levels[*level].draw_surface(pass, Some(&self.skins), instances.clone());
        }
    }

    pub(crate) fn draw_shells(&self, pass: &mut RenderPass<'_>) {
        for Run { level, instances } in &self.shell_runs {
            let frame = &self.levels[*level];
            let Some(pipeline) = &frame.pipelines.shells else { continue };
            frame.begin_tiles(pass, pipeline);
            pass.set_vertex_buffer(1, self.shells.slice(..));
            pass.set_index_buffer(self.coat.furred_faces.slice(..), IndexFormat::Uint32);
            pass.draw_indexed(0..3 * self.coat.furred_face_count(), 0, instances.clone());
        }
    }

    /// How many places are in view at each level of detail, the finest first.
    pub fn seen_by_level(&self) -> Vec<u32> {
        let mut counts = vec![0; self.levels.len()];
        for run in &self.skin_runs {
            counts[run.level] += run.instances.end - run.instances.start;
        }
        counts
    }

    /// How many draws a frame takes.
    pub fn draw_count(&self) -> usize {
        self.skin_runs.len() + self.shell_runs.len()
    }
}

/// A view of one level, without what crowds do without.
fn of_level(view: &View, level: usize) -> View {
    let detail = Detail::Level(level as f32);
    View { options: Options { detail, fins: false, culling: false, hidden: false, shadows: None, ..view.options }, ..view.clone() }
}

/// What is in view, the furthest first: near fur lets far fur through.
fn seen(coat: &GpuCoat, view: &View, world: &Viewpoint, places: &[Mat4]) -> Vec<Seen> {
    let scale = view.options.length_scale.max(0.0);
    let radius = coat.ball.1 + (scale - 1.0).max(0.0) * coat.length;
    let detail = match view.options.detail {
        Detail::Spacing(pixels) => Detail::Whole(pixels),
        Detail::Level(level) => Detail::Level(level.round()),
        whole @ Detail::Whole(_) => whole,
    };
    let mut seen: Vec<Seen> = (0..)
        .zip(places)
        .filter_map(|(number, place)| {
            let viewpoint = Viewpoint { clip_from_coat: world.clip_from_coat * *place, ..*world };
            if !is_in_view(&viewpoint.clip_from_coat, coat.ball.0.extend(1.0), radius) {
                return None;
            }
            let level = schedule::level(&coat.textures.levels, detail, &viewpoint, coat.length * scale) as usize;
            Some(Seen { number, level, distance: place.transform_point3(coat.ball.0).distance(world.eye) })
        })
        .collect();
    seen.sort_by(|a, b| b.distance.total_cmp(&a.distance).then(a.number.cmp(&b.number)));
    seen
}

/// Whether some of a ball may be on the inner side of all sides of the view.
fn is_in_view(clip_from_coat: &Mat4, centre: Vec4, radius: f32) -> bool {
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_coat.row(row));
    [w + x, w - x, w + y, w - y, z, w - z].iter().all(|side| side.dot(centre) >= -radius * side.truncate().length())
}

/// Writes instances, and says where each level's runs are.
fn write(queue: &Queue, buffer: &Buffer, instances: impl Iterator<Item = (usize, u32)>) -> Vec<Run> {
    let mut words = Vec::new();
    let mut runs: Vec<Run> = Vec::new();
    for (level, word) in instances {
        let place = words.len() as u32;
        match runs.last_mut().filter(|run| run.level == level) {
            Some(run) => run.instances.end = place + 1,
            None => runs.push(Run { level, instances: place..place + 1 }),
        }
        words.push(word);
    }
    queue.write_buffer(buffer, 0, bytemuck::cast_slice(&words));
    runs
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use pelage_coat::Camera;

    use super::*;

    #[test]
    fn balls_beside_behind_and_before_the_view_are_told() {
        let camera = Camera { eye: Vec3::new(0.0, 0.0, 5.0), target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.1 };
        let clip = camera.view_projection(1.0);
        let at = |place: Vec3, radius: f32| is_in_view(&(clip * Mat4::from_translation(place)), Vec4::W, radius);
        assert!(at(Vec3::ZERO, 0.1));
        assert!(!at(Vec3::new(0.0, 0.0, 6.0), 0.5), "behind the eye");
        assert!(!at(Vec3::new(4.0, 0.0, 0.0), 0.5) && at(Vec3::new(4.0, 0.0, 0.0), 2.0), "beside the view, and reaching into it");
        // The cone's half angle is half a radian: at distance 5 the side is 2.73 away, and 0.878 times what is beyond.
        let beyond = 5.0 * 0.5_f32.tan() + 0.5;
        assert!(
            !at(Vec3::new(beyond, 0.0, 0.0), 0.5 * 0.5_f32.cos() - 0.01) && at(Vec3::new(beyond, 0.0, 0.0), 0.5 * 0.5_f32.cos() + 0.01)
        );
    }
}
