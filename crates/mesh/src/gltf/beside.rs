//! Bytes that a model names: in its binary part, in its text, in files beside it.

use std::io;
use std::path::{Component, Path};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::Document;

use super::error::GltfFault;

/// Gives the bytes of a file that a model names, by its path relative to the model.
pub type Beside<'a> = dyn FnMut(&str) -> io::Result<Vec<u8>> + 'a;

/// The buffers of a model, each fetched when it is first asked for.
pub(super) struct Buffers<'a, 'b> {
    document: &'a Document,
    blob: Option<Vec<u8>>,
    fetched: Vec<Option<Vec<u8>>>,
    beside: &'a mut Beside<'b>,
}

/// What a URI leads to.
enum Found {
    Bytes(Vec<u8>),
    /// A path beside the model.
    File(String),
}

impl<'a, 'b> Buffers<'a, 'b> {
    pub(super) fn new(document: &'a Document, blob: Option<Vec<u8>>, beside: &'a mut Beside<'b>) -> Self {
        Self { document, blob, fetched: vec![None; document.as_json().buffers.len()], beside }
    }

    /// The bytes of a view, named as `what` in errors.
    pub(super) fn view(&mut self, view: usize, what: impl Fn() -> String) -> Result<&[u8], GltfFault> {
        let json = &self.document.as_json().buffer_views[view];
        let (buffer, start) = (json.buffer.value(), json.byte_offset.map_or(0, |offset| offset.0));
        let end = start.saturating_add(json.byte_length.0);
        let bytes = self.buffer(buffer)?;
        let length = bytes.len();
        let range = usize::try_from(start).ok().zip(usize::try_from(end).ok());
        range.and_then(|(start, end)| bytes.get(start..end)).ok_or_else(|| GltfFault::OutOfBuffer { what: what(), buffer, end, length })
    }

    fn buffer(&mut self, buffer: usize) -> Result<&[u8], GltfFault> {
        if self.fetched[buffer].is_none() {
            let bytes = match &self.document.as_json().buffers[buffer].uri {
                None => self.blob.clone().filter(|_| buffer == 0).ok_or(GltfFault::NoBinary { buffer })?,
                Some(uri) => match resolve(uri, || format!("buffer {buffer}"))? {
                    Found::Bytes(bytes) => bytes,
                    Found::File(file) => (self.beside)(&file).map_err(|cause| GltfFault::Buffer { buffer, file, cause })?,
                },
            };
            self.fetched[buffer] = Some(bytes);
        }
        Ok(self.fetched[buffer].as_deref().unwrap_or_default())
    }

    /// The bytes of an image file, and a name for it.
    pub(super) fn image(&mut self, image: usize) -> Result<(Vec<u8>, String), GltfFault> {
        let json = &self.document.as_json().images[image];
        let what = || format!("image {image}");
        if let Some(view) = json.buffer_view {
            return Ok((self.view(view.value(), what)?.to_vec(), what()));
        }
        let uri = json.uri.as_ref().ok_or(GltfFault::NoImage { image })?;
        match resolve(uri, what)? {
            Found::Bytes(bytes) => Ok((bytes, what())),
            Found::File(file) => match (self.beside)(&file) {
                Ok(bytes) => Ok((bytes, file)),
                Err(cause) => Err(GltfFault::Image { image, file, cause }),
            },
        }
    }
}

/// Data in the text itself, or a path in the model's folder or below.
fn resolve(uri: &str, what: impl Fn() -> String) -> Result<Found, GltfFault> {
    if let Some(data) = uri.strip_prefix("data:") {
        let encoded = data.split_once(";base64,").map(|(_, encoded)| encoded);
        let decoded = encoded.and_then(|encoded| STANDARD.decode(encoded).ok());
        return decoded.map(Found::Bytes).ok_or_else(|| GltfFault::Data { what: what() });
    }
    let path = percent_encoding::percent_decode_str(uri).decode_utf8().ok();
    let stays = |path: &str| {
        let inside = Path::new(path).components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        inside && !path.is_empty() && !path.contains([':', '\\', '\0'])
    };
    let path = path.filter(|path| stays(path)).ok_or_else(|| GltfFault::Elsewhere { what: what(), uri: legible(uri) })?;
    Ok(Found::File(path.into_owned()))
}

/// As much of a URI as may be shown: short, and without anything that a terminal might obey.
fn legible(uri: &str) -> String {
    uri.chars().take(64).map(|c| if c.is_ascii_graphic() { c } else { '?' }).collect()
}
