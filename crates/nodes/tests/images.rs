//! Image files of every kind: known texels, or one clear error.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::path::{Path, PathBuf};

use glam::Vec3;
use image::{DynamicImage, ImageBuffer, Luma, LumaA, Pixel, Rgb, Rgba};
use pelage_field::{ColourField, ScalarField};
use pelage_graph::{Evaluator, Graph, Request};

/// Colour and length at the vertex of a plane of 4 × 4 cells that is nearest to a place of the texture, by the node.
fn looked_up(file: &Path, places: &[(f64, f64)]) -> Result<Vec<(Vec3, f32)>, String> {
    let nodes =
        format!("\"sheet\": Plane(cells: (4, 4)), \"map\": ImageField(mesh: \"sheet.mesh\", path: {:?})", file.display().to_string());
    let graph = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})")).unwrap();
    let checked = graph.check(&pelage_nodes::registry()).unwrap();
    let request = Request::output("map.colours").and_output("map.lengths").and_output("sheet.mesh");
    let evaluation = Evaluator::new(1 << 20).run(&checked, &request).map_err(|error| error.to_string())?;
    let mesh = evaluation.get::<pelage_mesh::Mesh>("sheet.mesh").unwrap();
    let (colours, lengths) = (evaluation.get::<ColourField>("map.colours").unwrap(), evaluation.get::<ScalarField>("map.lengths").unwrap());
    let at = |&(u, v): &(f64, f64)| {
        let vertex = mesh.positions().iter().position(|p| (p.x + 0.5 - u).abs() < 1e-9 && (0.5 - p.z - v).abs() < 1e-9).unwrap();
        (colours.values()[vertex], lengths.values()[vertex])
    };
    Ok(places.iter().map(at).collect())
}

/// A picture of two halves, saved under a name that says its format.
fn halves<P: Pixel>(folder: &Path, name: &str, left: P, right: P) -> PathBuf
where
    DynamicImage: From<ImageBuffer<P, Vec<P::Subpixel>>>,
{
    let path = folder.join(name);
    DynamicImage::from(ImageBuffer::from_fn(16, 16, |x, _| if x < 8 { left } else { right })).save(&path).unwrap();
    path
}

/// Where the halves are seen, far from their edges.
const LEFT_AND_RIGHT: [(f64, f64); 2] = [(0.25, 0.5), (0.75, 0.5)];

fn linear(channel: f64) -> f32 {
    pelage_mesh::srgb_to_linear(channel) as f32
}

#[test]
fn grey_and_colour_of_8_and_16_bits_with_and_without_alpha() {
    let folder = tempfile::tempdir().unwrap();
    let seen = |path: PathBuf| looked_up(&path, &LEFT_AND_RIGHT).unwrap();
    let grey = seen(halves(folder.path(), "grey.png", Luma([51_u8]), Luma([204_u8])));
    assert!(grey[0].0.distance(Vec3::splat(linear(0.2))) < 1e-6 && grey[1].0.distance(Vec3::splat(linear(0.8))) < 1e-6 && grey[0].1 == 1.0);
    let alpha = seen(halves(folder.path(), "alpha.png", LumaA([51_u8, 51]), LumaA([204_u8, 255])));
    assert!((alpha[0].1 - 0.2).abs() < 1e-6);
    // 1000 and 1100 of 65,535 are 4 of 255 both.
    let deep = seen(halves(folder.path(), "deep.png", Luma([1000_u16]), Luma([1100_u16])));
    for (texel, number) in deep.iter().zip([1000.0, 1100.0]) {
        assert!(texel.0.distance(Vec3::splat(linear(number / 65535.0))) < 1e-8 && texel.1 == 1.0, "{texel:?}");
    }
    let colour = seen(halves(folder.path(), "colour.png", Rgb([255_u8, 128, 0]), Rgb([0_u8, 0, 255])));
    assert!(colour[0].0.distance(Vec3::new(1.0, linear(128.0 / 255.0), 0.0)) < 1e-6 && colour[1].0.distance(Vec3::Z) < 1e-6);
    let whole = seen(halves(folder.path(), "whole.png", Rgba([65535_u16, 0, 0, 32768]), Rgba([0_u16, 0, 0, 65535])));
    assert!((whole[0].1 - 32768.0 / 65535.0).abs() < 1e-7 && whole[0].0.distance(Vec3::X) < 1e-6);
    // A JPEG under a PNG's name is what it is.
    let lossy = halves(folder.path(), "lossy.jpg", Rgb([200_u8, 100, 50]), Rgb([50_u8, 100, 200]));
    std::fs::rename(&lossy, folder.path().join("lossy.png")).unwrap();
    let lossy = seen(folder.path().join("lossy.png"));
    assert!(lossy[0].0.distance(Vec3::from([200.0, 100.0, 50.0].map(|c| linear(c / 255.0)))) < 0.03, "{lossy:?}");
}

/// `cmyk.jpg`: cyan with a third of black on the left, yellow on the right, as most programs write it, with Adobe's marker and inverted.
#[test]
fn a_cmyk_jpeg_has_the_colours_that_it_prints() {
    let seen = looked_up(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/images/cmyk.jpg"), &LEFT_AND_RIGHT).unwrap();
    let expected = [Vec3::new(0.0, linear(2.0 / 3.0), linear(2.0 / 3.0)), Vec3::new(1.0, 1.0, 0.0)];
    for ((colour, length), expected) in seen.iter().zip(expected) {
        assert!(colour.distance(expected) < 0.03 && *length == 1.0, "{colour} for {expected}");
    }
}

#[test]
fn one_pixel_is_the_same_everywhere() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("one.png");
    ImageBuffer::from_pixel(1, 1, Rgba([255_u8, 0, 255, 51])).save(&path).unwrap();
    for (colour, length) in looked_up(&path, &[(0.0, 0.0), (0.5, 0.25), (1.0, 1.0)]).unwrap() {
        assert!(colour.distance(Vec3::new(1.0, 0.0, 1.0)) < 1e-6 && (length - 0.2).abs() < 1e-6);
    }
}

#[test]
fn what_cannot_be_read_is_said_with_the_files_name() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, bytes: &[u8], said: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let error = looked_up(&path, &LEFT_AND_RIGHT).unwrap_err();
        assert!(error.contains(name) && error.contains(said), "{error}");
    };
    refused("empty.png", b"", "PNG or JPEG");
    refused("text.png", b"no picture at all", "PNG or JPEG");
    refused("other.gif", b"GIF89a\x01\0\x01\0\0\0\0;", "PNG or JPEG");
    let mut whole = Vec::new();
    let noise = ImageBuffer::from_fn(64, 64, |x, y| Rgb([(x * 7 + y * 13) as u8, (x * y) as u8, (x ^ y) as u8]));
    DynamicImage::from(noise).write_to(&mut std::io::Cursor::new(&mut whole), image::ImageFormat::Png).unwrap();
    refused("cut.png", &whole[..whole.len() / 2], "PNG or JPEG");
    // A header that speaks of 100,000 by 100,000 pixels: refused before any of them is made room for.
    let mut huge = whole.clone();
    huge[16..20].copy_from_slice(&100_000_u32.to_be_bytes());
    huge[20..24].copy_from_slice(&100_000_u32.to_be_bytes());
    let mut sum = !0_u32;
    for byte in &huge[12..29] {
        sum ^= u32::from(*byte);
        (0..8).for_each(|_| sum = if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 });
    }
    huge[29..33].copy_from_slice(&(!sum).to_be_bytes());
    refused("huge.png", &huge, "larger than 16384");
    let missing = looked_up(&folder.path().join("missing.png"), &LEFT_AND_RIGHT).unwrap_err();
    assert!(missing.contains("missing.png"), "{missing}");
}
