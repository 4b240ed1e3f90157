//! Fragments are counted: all that are drawn, and each part apart.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use pelage_render::{Fragments, Options, ShellDepth};

use support::samples::{Style, coat, shapes};
use support::{SIZE, ball, hair, sampled, view};

fn fragments(options: Options) -> Fragments {
    sampled(&ball(), &view(options), 1).frame.fragments.unwrap()
}

#[test]
fn the_bare_skin_of_a_square_is_one_fragment_a_sample() {
    let square = coat(&shapes::square(4, 4.0), Style::default(), &hair(4));
    let bare = view(Options { fins: false, shells: false, ..Options::default() });
    let picture = sampled(&square, &bare, 1);
    let pixels = picture.coverage.iter().filter(|&&covered| covered > 0).count();
    assert_eq!(picture.frame.fragments.unwrap(), Fragments { surface: pixels as u64, fins: 0, shells: 0 });
    assert!(pixels > 500 && pixels < (SIZE.0 * SIZE.1) as usize, "the square is in the picture: {pixels}");
    let of_four = sampled(&square, &bare, 4).frame.fragments.unwrap().surface as f64 / pixels as f64;
    assert!((3.9..4.1).contains(&of_four), "{of_four}");
}

#[test]
fn shells_and_fins_are_counted_apart_and_the_more_there_are_the_more() {
    let tested = Options { shell_depth: ShellDepth::Tested, ..Options::default() };
    let all = fragments(tested);
    assert!(all.fins > 0 && all.shells > all.surface, "{all:?}");
    assert_eq!(all.total(), all.surface + all.fins + all.shells);
    let without = fragments(Options { fins: false, ..tested });
    assert_eq!(without, Fragments { fins: 0, ..all });
    let half = Options { layers: pelage_render::ShellRange { end: 4, ..tested.layers }, ..tested };
    let half = fragments(half);
    assert!(half.surface == all.surface && half.shells < all.shells, "{half:?} {all:?}");
    let bald = fragments(Options { length_scale: 0.0, ..tested });
    assert_eq!(bald, Fragments { surface: all.surface, fins: 0, shells: 0 });
}
