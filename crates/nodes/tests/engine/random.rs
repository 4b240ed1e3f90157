//! Random graphs.

use std::path::Path;

use pelage_graph::{Evaluator, Graph, State};

use super::{everything, generator, outcome, registry, with_threads};

/// A graph is refused with its faults, or fails with its nodes, or gives values; always the same, with any number of threads, and twice.
#[test]
fn no_graph_of_any_nodes_panics_and_all_give_the_same_on_one_and_three_threads() {
    let registry = registry();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs");
    let lone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let (mut refused, mut failed, mut made) = (0, 0, 0);
    for seed in 0..60 {
        let text = generator::graph(&registry, seed);
        let graph = Graph::parse(&text).unwrap().with_directory(&folder);
        assert_eq!(graph.to_ron(), text);
        let Ok(checked) = graph.check(&registry) else {
            refused += 1;
            continue;
        };
        let three = with_threads(&checked, 3);
        // On a pool of one, nodes and what they do with rayon alike run on the one worker.
        let mut evaluator = Evaluator::new(1 << 30);
        let one = lone.install(|| outcome(evaluator.run(&checked, &everything(&checked))));
        assert_eq!(three, one, "seed {seed}\n{text}");
        if one.is_err() {
            failed += 1;
            continue;
        }
        made += 1;
        let again = evaluator.run(&checked, &everything(&checked)).unwrap();
        assert!(again.trace().iter().all(|entry| entry.state == State::Hit), "seed {seed}: a second run is all hits");
        assert_eq!(outcome(Ok(again)), one, "seed {seed}");
    }
    // So that the generator is known to reach all three.
    assert!(refused >= 5 && failed >= 5 && made >= 10, "{refused} refused, {failed} failed, {made} made");
}
