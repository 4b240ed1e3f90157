//! Bind groups whose bindings count up from 0.

use wgpu::{BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindingResource, Device};

/// Binds resources in the order of their bindings.
pub(crate) fn bind<'a>(
    device: &Device,
    label: &str,
    layout: &BindGroupLayout,
    resources: impl IntoIterator<Item = BindingResource<'a>>,
) -> BindGroup {
    let entries: Vec<_> = resources.into_iter().zip(0..).map(|(resource, binding)| BindGroupEntry { binding, resource }).collect();
    device.create_bind_group(&BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}
