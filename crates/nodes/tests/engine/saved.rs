//! The saved graphs.

use std::path::Path;

use pelage_graph::Graph;

use super::{registry, with_threads};

/// The graphs, their textures smaller so that the test is quick.
fn graphs() -> Vec<(String, Graph)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> = files.filter(|path| path.extension().is_some_and(|extension| extension == "ron")).collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| {
        let mut graph = Graph::read(path).unwrap();
        let nodes: Vec<(String, String)> = graph.nodes.iter().map(|(id, node)| (id.to_string(), node.kind.clone())).collect();
        for (id, kind) in nodes {
            let settings: &[(&str, &str)] = match kind.as_str() {
                "Creature" => &[("faces", "600")],
                "GrowStrands" => &[("count", "80"), ("undercoat.count", "80")],
                "SampleShells" => &[("layers", "4"), ("resolution", "32")],
                "SampleFin" => &[("size", "(64, 16)")],
                _ => &[],
            };
            for (field, value) in settings {
                graph.set(&registry(), &format!("{id}.{field}"), value, Path::new(".")).unwrap();
            }
        }
        (path.file_stem().unwrap().to_string_lossy().into_owned(), graph)
    };
    paths.iter().map(read).collect()
}

#[test]
fn one_two_and_eight_threads_give_the_same_bytes() {
    let graphs = graphs();
    assert!(graphs.len() >= 5);
    for (name, graph) in graphs {
        let checked = graph.check(&registry()).unwrap();
        let one = with_threads(&checked, 1);
        assert!(one.as_ref().is_ok_and(|values| values.len() >= 7), "{name}: {one:?}");
        assert_eq!(with_threads(&checked, 2), one, "{name}");
        assert_eq!(with_threads(&checked, 8), one, "{name}");
    }
}

/// The keys and hashes of a graph's values, whatever its nodes are called and in whatever order they stand.
fn values(graph: &Graph) -> Vec<(String, u64)> {
    let named = with_threads(&graph.check(&registry()).unwrap(), 2).unwrap();
    let mut values: Vec<_> = named.into_iter().map(|(name, hash)| (name.split_once(' ').unwrap().1.to_owned(), hash)).collect();
    values.sort();
    values
}

#[test]
fn moving_renaming_and_reordering_nodes_changes_no_byte() {
    for (name, mut graph) in graphs().into_iter().step_by(3) {
        let before = values(&graph);
        let nodes: Vec<String> = graph.nodes.keys().map(ToString::to_string).collect();
        for (k, node) in nodes.iter().enumerate() {
            graph.rename(&registry(), node, &format!("other{k}")).unwrap();
            graph.move_to(&format!("other{k}"), 40.0 * k as f64, -7.5).unwrap();
        }
        graph.nodes.reverse();
        assert_eq!(values(&graph), before, "{name}");
    }
}

#[test]
fn opening_and_saving_a_saved_graph_changes_no_byte() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "ron") {
            let text = std::fs::read_to_string(&path).unwrap();
            let mut graph = Graph::read(&path).unwrap();
            assert_eq!(graph.to_ron(), text);
            // And one setting changes one value.
            graph.set(&registry(), "camera.azimuth", "123.5", Path::new(".")).unwrap();
            let camera = text.lines().position(|line| line.contains("\"camera\":")).unwrap();
            let saved = graph.to_ron();
            let changed: Vec<usize> =
                text.lines().zip(saved.lines()).enumerate().filter(|(_, (a, b))| a != b).map(|(line, _)| line).collect();
            assert_eq!((changed, text.lines().count()), (vec![camera], saved.lines().count()), "{}", path.display());
        }
    }
}
