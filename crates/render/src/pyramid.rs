//! What can be seen furthest, in ever larger squares of the screen: behind it, fur is hidden (K18).

use bytemuck::{Pod, Zeroable};
use wgpu::{
    BindGroup, BindGroupLayout, BindGroupLayoutDescriptor, BindingResource, BindingType, Buffer, BufferUsages, ComputePass,
    ComputePipeline, Device, Queue, ShaderStages, TextureSampleType, TextureView, TextureViewDimension,
};

use crate::Target;
use crate::bindings::bind;
use crate::buffers::{array, room};
use crate::compute::compute_pipeline;
use crate::pipelines::{entry, storage, uniform};
use crate::shader::assemble;

/// Pixels along a side of the finest squares, and squares along a side of what one group of the shader makes.
const SQUARE: u32 = 8;

/// Words before the first level: the finest level's size, how many levels there are, and width and height in pixels, of 16 bits each.
const HEADER: u32 = 4;

/// The compute pipelines: from depth to the finest squares, and from squares to larger ones.
#[derive(Debug)]
pub(crate) struct PyramidBuilder {
    layouts: [BindGroupLayout; 2],
    pipelines: [ComputePipeline; 2],
}

/// Mirrors `struct Level` of pyramid.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Level {
    read: [u32; 2],
    written: [u32; 2],
    finer: u32,
    place: u32,
    unused: [u32; 2],
}

impl PyramidBuilder {
    pub(crate) fn new(device: &Device, target: Target) -> Self {
        let depth = BindingType::Texture {
            sample_type: TextureSampleType::Depth,
            view_dimension: TextureViewDimension::D2,
            multisampled: target.samples > 1,
        };
        let compute = ShaderStages::COMPUTE;
        let entries = [entry(0, compute, uniform()), entry(1, compute, storage(false)), entry(2, compute, depth)];
        let layouts = [&entries[..], &entries[..2]]
            .map(|entries| device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some("pyramid"), entries }));
        let flags = [("REVERSED", target.reversed_depth), ("FIRST", true), ("SAMPLES", target.samples > 1)];
        let flags: Vec<&str> = flags.iter().filter_map(|&(name, on)| on.then_some(name)).collect();
        let later = &flags[..usize::from(target.reversed_depth)];
        let pipelines = [pipeline(device, &layouts[0], &flags), pipeline(device, &layouts[1], later)];
        Self { layouts, pipelines }
    }
}

fn pipeline(device: &Device, layout: &BindGroupLayout, flags: &[&str]) -> ComputePipeline {
    compute_pipeline(device, assemble(&[include_str!("shaders/pyramid.wgsl")], flags), "reduce", &[layout])
}

/// The squares of one depth buffer.
#[derive(Debug)]
pub(crate) struct Pyramid {
    /// The header, then level by level, row by row.
    pub(crate) furthest: Buffer,
    levels: Vec<(BindGroup, [u32; 2])>,
}

impl Pyramid {
    /// For a depth buffer of `size` pixels, which is read anew whenever this is recorded.
    pub(crate) fn new(device: &Device, queue: &Queue, builder: &PyramidBuilder, depth: &TextureView, size: (u32, u32)) -> Self {
        let levels = levels(size);
        let words = levels.last().map_or(HEADER, |last| last.place + last.written[0] * last.written[1]);
        let furthest = room(device, "pyramid", BufferUsages::STORAGE, 4 * u64::from(words));
        let header = [levels[0].written[0], levels[0].written[1], levels.len() as u32, size.0 | size.1 << 16];
        queue.write_buffer(&furthest, 0, bytemuck::cast_slice(&header));
        let groups = levels.iter().enumerate().map(|(k, level)| {
            let level_buffer = array(device, queue, "level of a pyramid", BufferUsages::UNIFORM, &[*level]);
            let mut resources = vec![level_buffer.as_entire_binding(), furthest.as_entire_binding()];
            if k == 0 {
                resources.push(BindingResource::TextureView(depth));
            }
            let layout = &builder.layouts[k.min(1)];
            let group = bind(device, "pyramid", layout, resources);
            (group, level.written)
        });
        Self { levels: groups.collect(), furthest }
    }

    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, builder: &PyramidBuilder) {
        for (k, (group, size)) in self.levels.iter().enumerate() {
            pass.set_pipeline(&builder.pipelines[k.min(1)]);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(size[0].div_ceil(SQUARE), size[1].div_ceil(SQUARE), 1);
        }
    }
}

/// What stands in for a pyramid where nothing hides anything.
pub(crate) fn no_pyramid(device: &Device) -> Buffer {
    room(device, "no pyramid", BufferUsages::STORAGE, 4 * u64::from(HEADER))
}

/// The levels over so many pixels, halved (rounded up) until there is one square.
fn levels(size: (u32, u32)) -> Vec<Level> {
    let halved = |[width, height]: [u32; 2]| [width.div_ceil(2), height.div_ceil(2)];
    let finest = [size.0.div_ceil(SQUARE).max(1), size.1.div_ceil(SQUARE).max(1)];
    let mut levels = vec![Level { read: [size.0, size.1], written: finest, finer: 0, place: HEADER, unused: [0; 2] }];
    let mut last = levels[0];
    while last.written != [1, 1] {
        let place = last.place + last.written[0] * last.written[1];
        last = Level { read: last.written, written: halved(last.written), finer: last.place, place, unused: [0; 2] };
        levels.push(last);
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_halve_to_one_square() {
        let sizes = |size| levels(size).iter().map(|level| level.written).collect::<Vec<_>>();
        assert_eq!(sizes((96, 72)), [[12, 9], [6, 5], [3, 3], [2, 2], [1, 1]]);
        assert_eq!(sizes((1, 1)), [[1, 1]]);
        let of = levels((96, 72));
        assert_eq!((of[1].finer, of[1].place, of[2].finer), (4, 4 + 108, 112));
    }
}
