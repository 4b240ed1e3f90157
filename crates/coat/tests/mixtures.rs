//! Stacks that become one, and come apart again.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::sync::Arc;

use pelage_coat::{Coat, CoatError, FinTexture, MipImage, ShellTexture};

/// Two layers of 2², each byte its own.
fn stack(first: u8) -> ShellTexture {
    let mip = |side: u32, from: u8| MipImage {
        width: side,
        height: side,
        texels: (0..2 * side * side * 4).map(|byte| from.wrapping_add(byte as u8)).collect(),
    };
    let mut stack = ShellTexture::stack(2, vec![mip(2, first), mip(1, first.wrapping_add(100))]);
    stack.directions = Some(vec![mip(2, first.wrapping_add(50)), mip(1, first)]);
    stack.levels[0][1].light_height = f32::from(first) / 255.0;
    stack
}

fn fin(width: u32) -> FinTexture {
    let mip = MipImage { width, height: 1, texels: vec![7; 4 * width as usize] };
    FinTexture { tiles_across: 1.0, mixtures: 1, mips: vec![mip] }
}

#[test]
fn what_is_joined_comes_apart_as_it_was_but_for_where_it_is_lit() {
    let stacks = [stack(0), stack(60), stack(150)];
    let joined = ShellTexture::joined(&stacks).unwrap();
    assert_eq!((joined.mixtures, joined.images, joined.check()), (3, 6, Ok(())));
    assert!((joined.levels[0][1].light_height - 70.0 / 255.0).abs() < 1e-6, "the mean of three");
    for (mixture, stack) in stacks.iter().enumerate() {
        let part = joined.mixture(mixture as u32).unwrap();
        assert_eq!(part, ShellTexture { levels: joined.levels.clone(), ..stack.clone() });
    }
    assert_eq!(joined.mixture(3), None);
    assert_eq!(joined.byte_size(), stacks.iter().map(ShellTexture::byte_size).sum::<usize>());
    assert_eq!(ShellTexture::joined(&[ShellTexture::joined(&stacks[..2]).unwrap(), stack(150)]).map(|all| all.mips), Ok(joined.mips));
}

#[test]
fn what_does_not_go_together_is_refused() {
    let why = |other: ShellTexture| match ShellTexture::joined(&[stack(0), other]) {
        Err(CoatError::Mixture { mixture: 1, what }) => what,
        other => unreachable!("{other:?}"),
    };
    let one = |change: &dyn Fn(&mut ShellTexture)| {
        let mut other = stack(9);
        change(&mut other);
        why(other)
    };
    assert!(one(&|other| other.levels[0][1].height = 0.5).contains("stand elsewhere"));
    assert!(one(&|other| other.directions = None).contains("direction map"));
    let map = |count: u32| MipImage { width: 1, height: 1, texels: vec![0; 4 * count as usize] };
    let three = ShellTexture { directions: Some(vec![map(3)]), ..ShellTexture::stack(3, vec![map(3)]) };
    assert!(why(three).contains("number of images"));
    assert_eq!(ShellTexture::joined(&[]), Err(CoatError::EmptyTexture("shell")));
    assert_eq!(FinTexture::joined(&[]), Err(CoatError::EmptyTexture("fin")));
    assert_eq!(FinTexture::joined(&[fin(2), fin(4)]), Err(CoatError::Mixture { mixture: 1, what: "it is of another size" }));
    let broken = ShellTexture { images: 5, ..stack(0) };
    assert!(ShellTexture::joined(&[stack(0), broken]).is_err());
}

#[test]
fn a_coat_whose_mixtures_do_not_agree_is_refused() {
    let three = ShellTexture::joined(&[stack(0), stack(1), stack(2)]).unwrap();
    assert_eq!(ShellTexture { mixtures: 0, ..three.clone() }.check(), Err(CoatError::Mixtures { mixtures: 0, images: 6 }));
    assert_eq!(ShellTexture { mixtures: 4, ..three.clone() }.check(), Err(CoatError::Mixtures { mixtures: 4, images: 6 }));
    let mut past = three.clone();
    past.levels[0][1].image = 2;
    assert!(matches!(past.check(), Err(CoatError::Shell { level: 0, shell: 1, .. })), "each mixture has two images");
    let coat = |fin: FinTexture| Coat {
        frame: pelage_coat::Frame { centre: glam::DVec3::ZERO, diameter: 1.0 },
        surface: pelage_coat::Surface::default(),
        patches: pelage_coat::PatchMesh::default(),
        edges: pelage_coat::FinEdges::default(),
        shells: Arc::new(three.clone()),
        fin: Some(Arc::new(fin)),
    };
    assert_eq!(coat(fin(2)).check(), Ok(()), "one serves all");
    assert_eq!(coat(FinTexture::joined(&[fin(2), fin(2), fin(2)]).unwrap()).check(), Ok(()));
    assert_eq!(coat(FinTexture::joined(&[fin(2), fin(2)]).unwrap()).check(), Err(CoatError::FinMixtures { shells: 3, fin: 2 }));
    let mut mixes = coat(fin(2));
    mixes.surface.mixes.push(0.0);
    assert!(matches!(mixes.check(), Err(CoatError::Length { array: "surface.mixes", .. })));
}
