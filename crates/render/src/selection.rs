//! Picking what is drawn, on the device: the faces that can be seen (K18) and the edges with a fin (L11, N1), packed in their order.

use std::sync::OnceLock;

use bytemuck::{Pod, Zeroable};
use wgpu::{
    BindGroup, BindGroupLayout, BindGroupLayoutDescriptor, Buffer, BufferUsages, ComputePass, ComputePipeline, Device, Queue, ShaderStages,
};

use crate::bindings::bind;
use crate::buffers::{array, room};
use crate::compute::compute_pipeline;
use crate::pipelines::{entry, storage, uniform};
use crate::pyramid::no_pyramid;
use crate::shader::assemble;
use crate::{GpuCoat, Target};

/// Items that one group of the compute shaders looks at.
pub(crate) const GROUP: u32 = 256;

/// What is picked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Faces,
    Fins,
}

/// The compute pipelines for both kinds, each made when something is first picked with it.
#[derive(Debug)]
pub(crate) struct Selectors {
    device: Device,
    reversed_depth: bool,
    scene_layout: BindGroupLayout,
    pick_layout: BindGroupLayout,
    pack_layout: BindGroupLayout,
    sum: OnceLock<ComputePipeline>,
    faces: OnceLock<ComputePipeline>,
    /// Picks faces by what hides them, too.
    unhidden: OnceLock<ComputePipeline>,
    fins: OnceLock<ComputePipeline>,
    pack_faces: OnceLock<ComputePipeline>,
    pack_fins: OnceLock<ComputePipeline>,
    /// Bound where nothing hides anything.
    no_pyramid: Buffer,
}

/// What all selections are compiled with.
const SHARED: [&str; 2] = [include_str!("shaders/selection.wgsl"), include_str!("shaders/common.wgsl")];

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct SelectionUniform {
    items: u32,
    groups: u32,
    unused: [u32; 2],
}

impl Selectors {
    pub(crate) fn new(device: &Device, target: Target) -> Self {
        let layout = |label, types: &[wgpu::BindingType]| {
            let entries: Vec<_> = types.iter().zip(0..).map(|(&ty, binding)| entry(binding, ShaderStages::COMPUTE, ty)).collect();
            device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
        };
        let (read, written) = (storage(true), storage(false));
        let scene_layout = layout("scene of a selection", &[uniform(), read, read, read, read, read]);
        let pick_layout = layout("picking", &[written, written, read, uniform()]);
        let pack_layout = layout("packing", &[read, written, read, read, written, written, uniform()]);
        Self {
            device: device.clone(),
            reversed_depth: target.reversed_depth,
            sum: OnceLock::new(),
            faces: OnceLock::new(),
            unhidden: OnceLock::new(),
            fins: OnceLock::new(),
            pack_faces: OnceLock::new(),
            pack_fins: OnceLock::new(),
            no_pyramid: no_pyramid(device),
            scene_layout,
            pick_layout,
            pack_layout,
        }
    }

    /// Marks what is kept.
    fn pick(&self, kind: Kind) -> &ComputePipeline {
        match kind {
            Kind::Faces => self.faces.get_or_init(|| self.picking(include_str!("shaders/select_faces.wgsl"), &[])),
            Kind::Fins => self.fins.get_or_init(|| self.picking(include_str!("shaders/select_fins.wgsl"), &[])),
        }
    }

    /// Marks faces that are kept and that nothing hides.
    fn pick_unhidden(&self) -> &ComputePipeline {
        let flags: &[&str] = if self.reversed_depth { &["HIDDEN", "REVERSED"] } else { &["HIDDEN"] };
        self.unhidden.get_or_init(|| self.picking(include_str!("shaders/select_faces.wgsl"), flags))
    }

    fn sum(&self) -> &ComputePipeline {
        self.sum.get_or_init(|| self.packing(&[], "sum_groups"))
    }

    fn pack(&self, kind: Kind) -> &ComputePipeline {
        match kind {
            Kind::Faces => self.pack_faces.get_or_init(|| self.packing(&["FACES"], "pack")),
            Kind::Fins => self.pack_fins.get_or_init(|| self.packing(&[], "pack")),
        }
    }

    fn picking(&self, source: &str, flags: &[&str]) -> ComputePipeline {
        let files = [SHARED[0], SHARED[1], source, include_str!("shaders/pick.wgsl")];
        compute_pipeline(&self.device, assemble(&files, flags), "pick", &[&self.scene_layout, &self.pick_layout])
    }

    fn packing(&self, flags: &[&str], entry: &str) -> ComputePipeline {
        compute_pipeline(&self.device, assemble(&[SHARED[0], include_str!("shaders/select.wgsl")], flags), entry, &[&self.pack_layout])
    }
}

/// What one view picks of one coat.
#[derive(Debug)]
pub(crate) struct Selection {
    kind: Kind,
    groups: u32,
    scene: BindGroup,
    pick: BindGroup,
    pack: BindGroup,
    /// Faces: three corners each; fins: edge and opacity.
    pub(crate) survivors: Buffer,
    /// The arguments of a draw for each run, five words.
    pub(crate) draws: Buffer,
}

impl Selection {
    /// A selection of `kind` for the frame whose uniform is given.
    pub(crate) fn new(device: &Device, queue: &Queue, selectors: &Selectors, kind: Kind, frame: &Buffer, coat: &GpuCoat) -> Self {
        let (items, runs, words) = match kind {
            Kind::Faces => (coat.furred_face_count(), coat.runs.len().max(1), 3),
            Kind::Fins => (coat.edge_count, 1, 2),
        };
        let groups = items.div_ceil(GROUP);
        let of_items = |words: u32| 4 * u64::from(words) * u64::from(items);
        let usage = BufferUsages::STORAGE;
        let picked = room(device, "picked", usage, of_items(1));
        let counts = room(device, "counts", usage, 4 * u64::from(groups));
        let readable = usage | BufferUsages::COPY_SRC;
        let survivors = room(device, "survivors", readable | BufferUsages::INDEX, of_items(words));
        let draws = room(device, "draws", readable | BufferUsages::INDIRECT, 20 * runs as u64);
        let number = SelectionUniform { items, groups, unused: [0; 2] };
        let number = array(device, queue, "selection", BufferUsages::UNIFORM, &[number]);
        let bind =
            |label, layout, buffers: &[&Buffer]| bind(device, label, layout, buffers.iter().map(|buffer| buffer.as_entire_binding()));
        Self {
            kind,
            groups,
            scene: scene(device, selectors, kind, frame, coat, &selectors.no_pyramid),
            pick: bind("picking", &selectors.pick_layout, &[&picked, &counts, &coat.furred_faces, &number]),
            pack: bind(
                "packing",
                &selectors.pack_layout,
                &[&picked, &counts, &coat.furred_faces, &coat.run_of, &survivors, &draws, &number],
            ),
            survivors,
            draws,
        }
    }

    /// Records the picking.
    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, selectors: &Selectors) {
        self.record_with(pass, selectors, Selectors::pick, &self.scene);
    }

    /// Records the picking of faces that nothing hides; `scene` is of [`Selection::scene_before`].
    pub(crate) fn record_unhidden(&self, pass: &mut ComputePass<'_>, selectors: &Selectors, scene: &BindGroup) {
        self.record_with(pass, selectors, |selectors, _| selectors.pick_unhidden(), scene);
    }

    /// What faces are picked from, behind what a pyramid shows.
    pub(crate) fn scene_before(device: &Device, selectors: &Selectors, frame: &Buffer, coat: &GpuCoat, pyramid: &Buffer) -> BindGroup {
        scene(device, selectors, Kind::Faces, frame, coat, pyramid)
    }

    fn record_with(
        &self,
        pass: &mut ComputePass<'_>,
        selectors: &Selectors,
        pick: impl for<'s> Fn(&'s Selectors, Kind) -> &'s ComputePipeline,
        scene: &BindGroup,
    ) {
        if self.groups == 0 {
            return;
        }
        pass.set_pipeline(pick(selectors, self.kind));
        pass.set_bind_group(0, scene, &[]);
        pass.set_bind_group(1, &self.pick, &[]);
        pass.dispatch_workgroups(self.groups, 1, 1);
        pass.set_pipeline(selectors.sum());
        pass.set_bind_group(0, &self.pack, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        pass.set_pipeline(selectors.pack(self.kind));
        pass.set_bind_group(0, &self.pack, &[]);
        pass.dispatch_workgroups(self.groups, 1, 1);
    }
}

fn scene(device: &Device, selectors: &Selectors, kind: Kind, frame: &Buffer, coat: &GpuCoat, pyramid: &Buffer) -> BindGroup {
    let last = if kind == Kind::Faces { &coat.tiles } else { &coat.edges };
    let resources = [frame, &coat.skin, &coat.fur, &coat.looks, last, pyramid].map(Buffer::as_entire_binding);
    bind(device, "scene of a selection", &selectors.scene_layout, resources)
}
