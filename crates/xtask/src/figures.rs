//! The figures: what is measured and printed beside its floor, and asserted nowhere, since machines are noisy and limits of time are not tests.
//!
//! Limits that do not depend on the machine are tests; those of speed are ratios to a floor of the same run, for a person to read.

use crate::failure::Result;
use crate::place::Place;
use crate::process::CommandLine;
use crate::vulkan;

/// A program that prints figures.
struct Figure {
    /// What it measures, beside what.
    what: &'static str,
    /// What cargo is told; after `--`, what the program is told.
    cargo: &'static str,
}

/// In the order in which data flows.
const FIGURES: &[Figure] = &[
    Figure { what: "half-edges beside a sort of the same keys", cargo: "bench -p pelage-mesh --bench build" },
    Figure {
        what: "half-edges and walks beside those of the crates that people would use instead",
        cargo: "bench --manifest-path tests/rivals/Cargo.toml",
    },
    Figure { what: "import beside the parser alone, repair beside a sort", cargo: "bench -p pelage-mesh --bench import" },
    Figure {
        what: "walks beside plain arrays, geodesic distance beside Dijkstra's, rays beside obvhs alone and all faces",
        cargo: "bench -p pelage-mesh --bench surface",
    },
    Figure { what: "animals by their number of faces", cargo: "bench -p pelage-creature --bench mesh" },
    Figure { what: "direction fields from 5,000 to 1,000,000 faces", cargo: "bench -p pelage-field --bench direction" },
    Figure {
        what: "a stroke of a comb that touches 2,000 vertices, on meshes of 10,000 to 1,000,000",
        cargo: "bench -p pelage-field --bench comb",
    },
    Figure { what: "noise, strokes and blur from 5,000 to 1,000,000 faces", cargo: "bench -p pelage-field --bench values" },
    Figure { what: "patches from 1,000 to 1,000,000 faces, and the 5,000-face bunny", cargo: "bench -p pelage-patch --bench grow" },
    Figure { what: "strands grown a second", cargo: "bench -p pelage-strand --bench grow" },
    Figure { what: "strands sampled a second, and the cost of a pair of piece and texel", cargo: "bench -p pelage-volume --bench sample" },
    Figure {
        what: "the error of each layer against many samples, mips, transmittance over the layer count",
        cargo: "run --release -p pelage-volume --example coverage_error",
    },
    Figure { what: "lighting tables: sizes, indexings, errors", cargo: "run --release -p pelage-lighting --example table_error" },
    Figure { what: "lighting by formula and by table", cargo: "bench -p pelage-lighting --bench lighting" },
    Figure {
        what: "frames of two bunnies beside the same draw, a plain renderer and the exact visible set; by shells, by distance, by option",
        cargo: "bench -p pelage-tests --bench spine -- 2",
    },
    Figure {
        what: "rays a second through hair, beside triangles of the same number in obvhs alone",
        cargo: "run --release -p pelage-reference --example rays",
    },
    Figure {
        what: "how far true pictures are from each other: with other noise, and with strands that no patch cuts",
        cargo: "run --release -p pelage-tests --example truth -- 8",
    },
    Figure { what: "the graph engine: parsing, checking, running, saving", cargo: "bench -p pelage-graph --bench graph" },
];

/// Prints every figure. Fails only where a program does.
pub(crate) fn print(place: &Place) -> Result<()> {
    vulkan::make_sure()?;
    FIGURES.iter().try_for_each(|figure| {
        println!("\n{}", figure.what);
        command(place, figure).run()
    })
}

fn command(place: &Place, figure: &Figure) -> CommandLine {
    let (cargo, program) = figure.cargo.split_once(" -- ").unwrap_or((figure.cargo, ""));
    let line = CommandLine::cargo().with(cargo.split_whitespace()).with(["--quiet", "--locked"]).within(place.root());
    if program.is_empty() { line } else { line.with(["--"]).with(program.split_whitespace()) }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use cargo_metadata::MetadataCommand;

    use super::*;

    /// Those that take minutes, and are printed by hand.
    const LONG: &[&str] = &["bench -p pelage-accuracy --bench compare"];

    #[test]
    fn what_the_program_is_told_comes_last() {
        let figure = Figure { what: "", cargo: "bench -p x -- 3 far" };
        let line = command(&Place::find().unwrap(), &figure).to_string();
        assert!(line.contains("bench -p x --quiet --locked -- 3 far"), "{line}");
    }

    #[test]
    fn every_benchmark_of_the_workspace_is_printed_or_named_as_left_out() {
        let metadata = MetadataCommand::new().manifest_path(Place::find().unwrap().at("Cargo.toml")).no_deps().exec().unwrap();
        let benches = metadata.packages.iter().flat_map(|package| {
            let benches = package.targets.iter().filter(|target| target.is_bench());
            benches.map(move |bench| format!("bench -p {} --bench {}", package.name, bench.name))
        });
        let there: BTreeSet<String> = benches.collect();
        let printed = FIGURES
            .iter()
            .filter_map(|figure| figure.cargo.split(" -- ").next())
            .chain(LONG.iter().copied())
            .filter(|line| line.starts_with("bench -p "));
        assert_eq!(there, printed.map(str::to_owned).collect());
    }
}
