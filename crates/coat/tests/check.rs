//! Coats whose arrays do not agree are named as such; those that do are let through.

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};
use pelage_coat::{Coat, CoatError, Encoding, FinEdges, FinTexture, Frame, MipImage, PatchMesh, ShellLayer, ShellTexture, Surface};
use proptest::prelude::*;

fn image(width: u32, height: u32, layers: u32) -> MipImage {
    MipImage { width, height, texels: vec![0; 4 * (width * height * layers) as usize] }
}

fn coat() -> Coat {
    Coat {
        frame: Frame { centre: DVec3::new(1.0, 2.0, 3.0), diameter: 4.0 },
        surface: Surface {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE],
            normals: vec![Vec3::Z; 4],
            offsets: vec![0.1 * Vec3::Z; 4],
            bends: vec![Vec3::ZERO; 4],
            ends: vec![1.0; 4],
            mixes: vec![0.0; 4],
            directions: vec![Vec3::Z; 4],
            colours: vec![Vec3::ONE; 4],
        },
        patches: PatchMesh {
            vertices: vec![0, 1, 2, 2, 1, 3],
            coordinates: vec![Vec2::ZERO; 6],
            faces: vec![[0, 1, 2], [3, 4, 5]],
            patch_ends: vec![1, 2],
            opacities: Vec::new(),
        },
        edges: FinEdges { vertices: vec![[1, 2]], intervals: vec![[0.2, 0.4]], face_normals: vec![[Vec3::Z; 2]], curvatures: vec![0.5] },
        shells: Arc::new(ShellTexture::stack(3, vec![image(4, 4, 3), image(2, 2, 3), image(1, 1, 3)])),
        fin: Some(Arc::new(FinTexture { tiles_across: 2.0, mixtures: 1, mips: vec![image(4, 2, 1), image(2, 1, 1), image(1, 1, 1)] })),
    }
}

#[test]
fn a_whole_coat_passes() {
    assert_eq!(coat().check(), Ok(()));
}

#[test]
fn a_coat_without_textures_passes() {
    let bare = Coat { shells: Arc::new(ShellTexture::bare()), fin: None, edges: FinEdges::default(), ..coat() };
    assert_eq!(bare.check(), Ok(()));
    assert_eq!((bare.shells.layers(), &bare.shells.mips[0].texels[..]), (1, &[255; 4][..]));
}

#[test]
fn an_empty_coat_passes() {
    let empty = Coat { surface: Surface::default(), patches: PatchMesh::default(), edges: FinEdges::default(), fin: None, ..coat() };
    assert_eq!(empty.check(), Ok(()));
    assert_eq!(empty.bounds(), (Vec3::ZERO, Vec3::ZERO));
}

/// What is done to a coat, and what must be said of it.
type Fault = (fn(&mut Coat), CoatError);

#[test]
fn every_fault_is_named() {
    let faults: Vec<Fault> = vec![
        (
            |c| c.surface.normals.truncate(c.surface.normals.len() - 1),
            CoatError::Length { array: "surface.normals", length: 3, expected: 4 },
        ),
        (
            |c| c.surface.colours.truncate(c.surface.colours.len() - 1),
            CoatError::Length { array: "surface.colours", length: 3, expected: 4 },
        ),
        (|c| c.surface.offsets[2].y = f32::NAN, CoatError::NotFinite { array: "surface.offsets", at: 2 }),
        (|c| c.patches.vertices[1] = 4, CoatError::Index { array: "patches.vertices", at: 1, index: 4, count: 4 }),
        (
            |c| c.patches.coordinates.truncate(c.patches.coordinates.len() - 1),
            CoatError::Length { array: "patches.coordinates", length: 5, expected: 6 },
        ),
        (|c| c.patches.coordinates[5].x = f32::INFINITY, CoatError::NotFinite { array: "patches.coordinates", at: 5 }),
        (|c| c.patches.faces[1][1] = 6, CoatError::Index { array: "patches.faces", at: 4, index: 6, count: 6 }),
        (|c| c.patches.patch_ends[1] = 1, CoatError::Length { array: "patches.faces", length: 2, expected: 1 }),
        (|c| c.patches.patch_ends = vec![2, 1, 2], CoatError::Order { array: "patches.patch_ends", at: 1 }),
        (|c| c.edges.vertices[0][1] = 9, CoatError::Index { array: "edges.vertices", at: 1, index: 9, count: 4 }),
        (|c| c.edges.intervals.clear(), CoatError::Length { array: "edges.intervals", length: 0, expected: 1 }),
        (|c| c.edges.face_normals[0][0].x = f32::NAN, CoatError::NotFinite { array: "edges.face_normals", at: 0 }),
        (|c| c.edges.curvatures[0] = f32::NEG_INFINITY, CoatError::NotFinite { array: "edges.curvatures", at: 0 }),
        (|c| c.frame.diameter = 0.0, CoatError::Frame),
        (|c| c.frame.centre.z = f64::NAN, CoatError::Frame),
        (|c| c.shells = Arc::new(ShellTexture::stack(0, vec![image(1, 1, 1)])), CoatError::EmptyTexture("shell")),
        (|c| c.shells = Arc::new(ShellTexture::stack(1, vec![])), CoatError::EmptyTexture("shell")),
        (|c| c.shells = Arc::new(ShellTexture::stack(1, vec![image(0, 4, 1)])), CoatError::EmptyTexture("shell")),
        (
            |c| c.shells = Arc::new(ShellTexture::stack(2, vec![image(2, 2, 1)])),
            CoatError::Texture { texture: "shell", level: 0, width: 2, height: 2, layers: 2, expected: 32, length: 16 },
        ),
        (
            |c| c.shells = Arc::new(ShellTexture::stack(1, vec![image(4, 4, 1), image(3, 2, 1)])),
            CoatError::MipChain { texture: "shell", level: 1, width: 3, height: 2, expected_width: 2, expected_height: 2 },
        ),
        (
            |c| c.fin = Some(Arc::new(FinTexture { tiles_across: 1.0, mixtures: 1, mips: vec![image(1, 1, 1), image(1, 1, 1)] })),
            CoatError::MipChain { texture: "fin", level: 1, width: 1, height: 1, expected_width: 1, expected_height: 1 },
        ),
    ];
    check(faults);
}

/// The coat's shells, to be spoiled.
fn shells(coat: &mut Coat) -> &mut ShellTexture {
    Arc::make_mut(&mut coat.shells)
}

/// What a spoiled shell is said to be.
fn shell(level: usize, shell: usize, what: &'static str) -> CoatError {
    CoatError::Shell { level, shell, what }
}

#[test]
fn every_fault_of_shells_is_named() {
    check(vec![
        (|c| c.surface.ends.truncate(3), CoatError::Length { array: "surface.ends", length: 3, expected: 4 }),
        (|c| c.surface.ends[1] = f32::NAN, CoatError::NotFinite { array: "surface.ends", at: 1 }),
        (|c| c.surface.bends[1].x = f32::NAN, CoatError::NotFinite { array: "surface.bends", at: 1 }),
        (|c| shells(c).levels.clear(), CoatError::EmptyTexture("shell")),
        (|c| shells(c).levels[0][1].height = 1.5, shell(0, 1, "its heights must be 0 to 1")),
        (|c| shells(c).levels[0][2].light_height = f32::NAN, shell(0, 2, "its heights must be 0 to 1")),
        (|c| shells(c).levels[0][2].height = 0.1, shell(0, 2, "it must not stand below the shell before it")),
        (|c| shells(c).levels[0][0].height = 0.1, shell(0, 0, "the innermost must stand on the skin, at height 0")),
        (|c| shells(c).levels[0][2].image = 3, shell(0, 2, "it shows an image past the end of the stack")),
        (|c| shells(c).levels[0][2].opacity = -0.1, shell(0, 2, "its opacity must be 0 to 1")),
        (|c| shells(c).levels[0][2].layers = f32::INFINITY, shell(0, 2, "its number of layers must be finite and not negative")),
        (|c| shells(c).levels.push(vec![ShellLayer::plain(0.0, 0)]), CoatError::Level { level: 1, found: 1, expected: 2 }),
        (
            |c| shells(c).levels.push(vec![ShellLayer::plain(0.0, 0), ShellLayer::plain(0.5, 1)]),
            shell(1, 1, "it must stand where every second shell of the finer level does"),
        ),
        (
            |c| shells(c).encoding = Encoding::Bc3,
            CoatError::Texture { texture: "shell", level: 0, width: 4, height: 4, layers: 3, expected: 48, length: 192 },
        ),
        (|c| shells(c).directions = Some(vec![image(4, 4, 3)]), CoatError::Length { array: "directions", length: 1, expected: 3 }),
        (
            |c| shells(c).directions = Some(vec![image(2, 2, 3), image(1, 1, 3)]),
            CoatError::Length { array: "directions", length: 2, expected: 3 },
        ),
    ]);
}

/// Spoils a coat in each way and looks at what is said.
fn check(faults: Vec<Fault>) {
    for (spoil, expected) in faults {
        let mut coat = coat();
        spoil(&mut coat);
        assert_eq!(coat.check(), Err(expected));
    }
}

#[test]
fn absurd_texture_sizes_do_not_overflow() {
    let mut coat = coat();
    let vast = MipImage { width: u32::MAX, height: u32::MAX, texels: vec![] };
    coat.shells = Arc::new(ShellTexture { images: u32::MAX, ..ShellTexture::stack(1, vec![vast]) });
    assert!(matches!(coat.check(), Err(CoatError::Texture { texture: "shell", length: 0, .. })));
}

#[test]
fn bounds_hold_skin_and_fur() {
    let (least, greatest) = coat().bounds();
    assert_eq!((least, greatest), (Vec3::ZERO, Vec3::new(1.0, 1.0, 1.1)));
}

proptest! {
    #[test]
    fn nothing_panics(indices in prop::collection::vec(any::<u32>(), 0..9), values in prop::collection::vec(any::<f32>(), 0..9)) {
        let mut coat = coat();
        for (slot, &index) in coat.patches.vertices.iter_mut().zip(&indices) {
            *slot = index;
        }
        for (slot, &value) in coat.surface.positions.iter_mut().zip(&values) {
            slot.x = value;
        }
        let _ = (coat.check(), coat.bounds(), coat.byte_size());
    }
}
