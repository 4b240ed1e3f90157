//! Numbers out of bytes.

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use super::beside::Buffers;
use super::error::GltfFault;

/// What numbers are used for, and what they may be.
struct Use {
    used_for: &'static str,
    wanted: &'static str,
    fits: fn(DataType, Dimensions, bool) -> bool,
}

const POSITIONS: Use = Use {
    used_for: "positions",
    wanted: "three 32-bit floats each",
    fits: |data, dimensions, _| data == DataType::F32 && dimensions == Dimensions::Vec3,
};

const TEXTURE_COORDINATES: Use = Use {
    used_for: "texture coordinates",
    wanted: "two numbers each, 32-bit floats or normalised bytes or 16-bit integers",
    fits: |data, dimensions, normalised| dimensions == Dimensions::Vec2 && is_fraction(data, normalised),
};

const COLOURS: Use = Use {
    used_for: "colours",
    wanted: "three or four numbers each, 32-bit floats or normalised bytes or 16-bit integers",
    fits: |data, dimensions, normalised| matches!(dimensions, Dimensions::Vec3 | Dimensions::Vec4) && is_fraction(data, normalised),
};

const INDICES: Use = Use {
    used_for: "indices",
    wanted: "single integers of 8, 16 or 32 bits without sign",
    fits: |data, dimensions, normalised| {
        dimensions == Dimensions::Scalar && matches!(data, DataType::U8 | DataType::U16 | DataType::U32) && !normalised
    },
};

fn is_fraction(data: DataType, normalised: bool) -> bool {
    data == DataType::F32 || (normalised && matches!(data, DataType::U8 | DataType::U16))
}

pub(super) fn positions(accessor: &Accessor<'_>, buffers: &mut Buffers<'_, '_>) -> Result<Vec<[f32; 3]>, GltfFault> {
    read(accessor, buffers, &POSITIONS, |numbers| [numbers(0), numbers(1), numbers(2)])
}

pub(super) fn texture_coordinates(accessor: &Accessor<'_>, buffers: &mut Buffers<'_, '_>) -> Result<Vec<[f32; 2]>, GltfFault> {
    read(accessor, buffers, &TEXTURE_COORDINATES, |numbers| [numbers(0), numbers(1)])
}

/// Red, green, blue and alpha; those without alpha are opaque.
pub(super) fn colours(accessor: &Accessor<'_>, buffers: &mut Buffers<'_, '_>) -> Result<Vec<[f32; 4]>, GltfFault> {
    let has_alpha = accessor.dimensions() == Dimensions::Vec4;
    read(accessor, buffers, &COLOURS, |numbers| [numbers(0), numbers(1), numbers(2), if has_alpha { numbers(3) } else { 1.0 }])
}

pub(super) fn indices(accessor: &Accessor<'_>, buffers: &mut Buffers<'_, '_>) -> Result<Vec<u32>, GltfFault> {
    each(accessor, buffers, &INDICES, |bytes| match *bytes {
        [a] => a.into(),
        [a, b] => u16::from_le_bytes([a, b]).into(),
        [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
        // No element that fits is of another size.
        _ => u32::MAX,
    })
}

/// Every element, made from its components by their place.
fn read<T>(
    accessor: &Accessor<'_>,
    buffers: &mut Buffers<'_, '_>,
    its_use: &Use,
    make: impl Fn(&dyn Fn(usize) -> f32) -> T,
) -> Result<Vec<T>, GltfFault> {
    let (data, size) = (accessor.data_type(), accessor.data_type().size());
    each(accessor, buffers, its_use, |bytes| make(&|k| component(data, &bytes[k * size..(k + 1) * size])))
}

/// A float as it is, an integer as a part of its greatest.
fn component(data: DataType, bytes: &[u8]) -> f32 {
    match (data, bytes) {
        (DataType::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
        (DataType::U16, &[a, b]) => f32::from(u16::from_le_bytes([a, b])) / 65535.0,
        (DataType::U8, &[a]) => f32::from(a) / 255.0,
        _ => f32::NAN,
    }
}

/// Goes through the elements as bytes; all of them are known to be there before the first is read.
fn each<T>(accessor: &Accessor<'_>, buffers: &mut Buffers<'_, '_>, its_use: &Use, make: impl Fn(&[u8]) -> T) -> Result<Vec<T>, GltfFault> {
    let index = accessor.index();
    if accessor.sparse().is_some() {
        return Err(GltfFault::Sparse { accessor: index });
    }
    let (data, dimensions) = (accessor.data_type(), accessor.dimensions());
    if !(its_use.fits)(data, dimensions, accessor.normalized()) {
        let found = format!("{dimensions:?} of {}{data:?}", if accessor.normalized() { "normalised " } else { "" });
        return Err(GltfFault::Kind { accessor: index, used_for: its_use.used_for, wanted: its_use.wanted, found });
    }
    let what = || format!("accessor {index}");
    let Some(view) = accessor.view() else {
        let (found, wanted) = ("no bytes at all".to_owned(), its_use.wanted);
        return Err(GltfFault::Kind { accessor: index, used_for: its_use.used_for, wanted, found });
    };
    let size = accessor.size();
    let (stride, offset, count) = (view.stride().unwrap_or(size).max(size), accessor.offset() as u64, accessor.count() as u64);
    let bytes = buffers.view(view.index(), what)?;
    let last = count.saturating_sub(1).checked_mul(stride as u64).and_then(|last| last.checked_add(offset));
    let end = last.map_or(u64::MAX, |last| last.saturating_add(size as u64));
    if count > 0 && end > bytes.len() as u64 {
        let (buffer, length) = (view.buffer().index(), bytes.len());
        return Err(GltfFault::OutOfBuffer { what: format!("accessor {index}, in its view,"), buffer, end, length });
    }
    let elements = (0..count as usize).map(|k| offset as usize + k * stride);
    Ok(elements.map(|start| make(&bytes[start..start + size])).collect())
}
