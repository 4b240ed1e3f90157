//! What a saved graph asks for and cannot have is said with the node that asked and what to ask for instead.

use pelage_tests::{Error, Scene};

/// `graphs/die.ron` with one input set, in a picture of few pixels.
fn die(set: (&str, &str)) -> Result<Scene, Error> {
    Scene::evaluate("die", &[("picture.size", "(32, 24)"), set])
}

#[test]
fn a_pixel_has_one_sample_or_four() -> Result<(), Error> {
    for samples in ["1", "4"] {
        die(("picture.samples", samples))?.picture()?;
    }
    for samples in ["2", "3"] {
        let refused = die(("picture.samples", samples)).err().ok_or("drawn all the same")?.to_string();
        for said in ["\"picture\"", samples, "1 or 4"] {
            assert!(refused.contains(said), "{refused:?} does not say {said}");
        }
    }
    for samples in ["0", "5"] {
        let refused = die(("picture.samples", samples)).err().ok_or("drawn all the same")?.to_string();
        assert!(refused.contains("1 to 4"), "{refused:?}");
    }
    Ok(())
}
