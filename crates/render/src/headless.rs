//! A graphics device without a window.

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{Adapter, Device, DeviceDescriptor, Features, Instance, InstanceDescriptor, PollType, Queue, RequestAdapterOptions};

use crate::RenderError;

/// Which adapter draws.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterSummary {
    /// Its name, as the driver gives it.
    pub name: String,
    /// Vulkan, Metal, Dx12 …
    pub backend: String,
    /// Whether it is a program rather than a graphics processor.
    pub software: bool,
}

/// What happened on the device that nobody asked about.
#[derive(Debug, Default)]
struct Reports {
    errors: Vec<String>,
    lost: Option<String>,
}

/// An adapter, its device and queue, and the place where the device's complaints are kept. Clones are the same device.
#[derive(Clone, Debug)]
pub struct Headless {
    adapter: Adapter,
    device: Device,
    queue: Queue,
    summary: AdapterSummary,
    reports: Arc<Mutex<Reports>>,
}

impl Headless {
    /// The best adapter there is, with all its limits, and with timestamps and textures in blocks where it has them.
    ///
    /// The environment variables of wgpu (`WGPU_BACKEND`, …) choose among several.
    ///
    /// # Errors
    /// No adapter (the message says what to install), or none that gives a device.
    pub fn new() -> Result<Self, RenderError> {
        let instance = Instance::new(InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pollster::block_on(instance.request_adapter(&RequestAdapterOptions::default()))
            .map_err(|error| RenderError::NoAdapter { reason: error.to_string() })?;
        let info = adapter.get_info();
        let summary = AdapterSummary {
            name: info.name.clone(),
            backend: info.backend.to_string(),
            software: info.device_type == wgpu::DeviceType::Cpu,
        };
        let descriptor = DeviceDescriptor {
            label: Some("pelage"),
            required_features: adapter.features() & (Features::TIMESTAMP_QUERY | Features::TEXTURE_COMPRESSION_BC),
            required_limits: adapter.limits(),
            ..DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| RenderError::NoDevice { adapter: info.name, reason: error.to_string() })?;
        let reports = Arc::new(Mutex::new(Reports::default()));
        let on_error = Arc::clone(&reports);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| lock(&on_error).errors.push(error.to_string())));
        let on_loss = Arc::clone(&reports);
        // Destroyed on purpose it is lost all the same to whoever still draws with it.
        device.set_device_lost_callback(move |reason, message| lock(&on_loss).lost = Some(format!("{reason:?}: {message}")));
        Ok(Self { adapter, device, queue, summary, reports })
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Its queue.
    pub fn queue(&self) -> &Queue {
        &self.queue
    }

    /// The adapter it came from.
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// Name, backend and kind of the adapter.
    pub fn summary(&self) -> &AdapterSummary {
        &self.summary
    }

    /// Takes the errors that the device reported outside any error scope since the last call: none, if all is well.
    pub fn take_errors(&self) -> Vec<String> {
        std::mem::take(&mut lock(&self.reports).errors)
    }

    /// Whether all is well: the first of the reported errors, or the loss of the device, as an error.
    ///
    /// # Errors
    /// [`RenderError::Lost`] from the loss on; [`RenderError::Validation`] once for what was reported since it was last asked.
    pub fn check(&self) -> Result<(), RenderError> {
        // A loss is told when the device is asked; nothing else is waited for. If it answers with an error, that is kept with the others.
        if let Err(error) = self.device.poll(PollType::Poll) {
            lock(&self.reports).errors.push(error.to_string());
        }
        let mut reports = lock(&self.reports);
        if let Some(lost) = &reports.lost {
            return Err(RenderError::Lost(lost.clone()));
        }
        match std::mem::take(&mut reports.errors).into_iter().next() {
            Some(error) => Err(RenderError::Validation(error)),
            None => Ok(()),
        }
    }
}

/// A panic elsewhere leaves a list of strings whole.
fn lock(reports: &Mutex<Reports>) -> std::sync::MutexGuard<'_, Reports> {
    reports.lock().unwrap_or_else(PoisonError::into_inner)
}
