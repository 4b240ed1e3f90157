//! Fragments are counted: all that are drawn, and each part apart.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use pelage_render::{Fragments, Options, ShellDepth};

use support::{SIZE, ball, sampled, view};

fn fragments(options: Options, samples: u32) -> (Fragments, usize) {
    let picture = sampled(&ball(), &view(options), samples);
    (picture.frame.fragments.unwrap(), picture.coverage.iter().filter(|&&covered| covered > 0).count())
}

#[test]
fn the_bare_skin_of_a_ball_is_one_fragment_a_sample() {
    let bare = Options { fins: false, shells: false, ..Options::default() };
    let (one, pixels) = fragments(bare, 1);
    assert_eq!(one, Fragments { surface: pixels as u64, fins: 0, shells: 0 });
    assert!(pixels > 500 && pixels < (SIZE.0 * SIZE.1) as usize, "the ball is in the picture");
    let (four, _) = fragments(bare, 4);
    let ratio = four.surface as f64 / one.surface as f64;
    assert!((3.95..4.05).contains(&ratio), "{ratio}");
}

#[test]
fn shells_and_fins_are_counted_apart_and_the_more_there_are_the_more() {
    let tested = Options { shell_depth: ShellDepth::Tested, ..Options::default() };
    let (all, _) = fragments(tested, 1);
    assert!(all.fins > 0 && all.shells > all.surface, "{all:?}");
    assert_eq!(all.total(), all.surface + all.fins + all.shells);
    let (without, _) = fragments(Options { fins: false, ..tested }, 1);
    assert_eq!(without, Fragments { fins: 0, ..all });
    let half = Options { layers: pelage_render::ShellRange { end: 4, ..tested.layers }, ..tested };
    let (half, _) = fragments(half, 1);
    assert!(half.surface == all.surface && half.shells < all.shells, "{half:?} {all:?}");
    let (bald, _) = fragments(Options { length_scale: 0.0, ..tested }, 1);
    assert_eq!(bald, Fragments { surface: all.surface, fins: 0, shells: 0 });
}
