//! What a picture's `culling` and `hidden` leave out of a saved graph is counted, and no pixel changes by it (K18).
#![allow(clippy::print_stdout, reason = "how much is left out")]

use pelage_tests::{Error, Scene};

#[test]
fn what_is_left_out_of_the_bear_is_counted_and_not_seen() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut drawn = |culling: &str, hidden: &str| {
        let set = [("picture.size", "(320, 240)"), ("picture.culling", culling), ("picture.hidden", hidden)];
        Scene::evaluate_with(&mut evaluator, "bear", &set)?.picture()
    };
    let (all, facing, seen) = (drawn("false", "false")?, drawn("true", "false")?, drawn("true", "true")?);
    let [every, some, fewer] = [&all, &facing, &seen].map(|picture| picture.frame.faces_drawn);
    println!("{every} faces with fur, {some} that face the eye, {fewer} that nothing hides");
    assert!(fewer < some && some < every, "{every} {some} {fewer}");
    assert!(facing.frame.patches_drawn < all.frame.patches_drawn);
    assert!(facing.rgba == all.rgba && seen.rgba == all.rgba);
    Ok(())
}
