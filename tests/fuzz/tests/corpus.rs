//! Every input of every corpus, without a fuzzer: what was found once is not found again.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::collections::BTreeSet;
use std::path::Path;

/// Takes bytes and asserts what must hold of them.
type Target = fn(&[u8]);

/// Every target, with the name of its corpus.
const TARGETS: [(&str, Target); 4] =
    [("gltf", pelage_fuzz::gltf), ("graph", pelage_fuzz::graph), ("obj", pelage_fuzz::obj), ("repair", pelage_fuzz::repair)];

fn names(folder: &str) -> BTreeSet<String> {
    let entries = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).unwrap();
    entries.map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned()).collect()
}

#[test]
fn every_target_is_tried() {
    let tried: BTreeSet<String> = TARGETS.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(tried, names("targets"));
    assert_eq!(tried, names("corpus"));
}

#[test]
fn every_input_holds() {
    for (name, target) in TARGETS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name);
        let mut inputs = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            target(&std::fs::read(entry.unwrap().path()).unwrap());
            inputs += 1;
        }
        assert!(inputs >= 5, "{name} has {inputs} inputs to start from");
    }
}
