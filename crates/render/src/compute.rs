//! Compute pipelines.

use wgpu::{
    BindGroupLayout, ComputePipeline, ComputePipelineDescriptor, Device, PipelineCompilationOptions, PipelineLayoutDescriptor,
    ShaderModuleDescriptor, ShaderSource,
};

/// The pipeline of a shader's entry point, with the layouts of its bind groups in their order.
pub(crate) fn compute_pipeline(device: &Device, source: String, entry: &str, layouts: &[&BindGroupLayout]) -> ComputePipeline {
    let module = device.create_shader_module(ShaderModuleDescriptor { label: Some(entry), source: ShaderSource::Wgsl(source.into()) });
    let layouts: Vec<Option<&BindGroupLayout>> = layouts.iter().copied().map(Some).collect();
    let layout =
        device.create_pipeline_layout(&PipelineLayoutDescriptor { label: Some(entry), bind_group_layouts: &layouts, immediate_size: 0 });
    device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(&layout),
        module: &module,
        entry_point: Some(entry),
        compilation_options: PipelineCompilationOptions::default(),
        cache: None,
    })
}
