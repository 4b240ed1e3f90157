//! The laws of the architecture, checked against what the crates' manifests say.
//!
//! Data goes one way (book/src/architecture.md): a crate may know those on its left and nothing on its right. The table below *is*
//! the law; a crate that it does not name is a fault, so that nobody adds one without saying where it stands.

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand};

use crate::failure::{Failure, Result};
use crate::place::Place;

/// What one crate of ours may know.
struct Law {
    /// Its folder, from the root; its package is `pelage-` and the folder's name.
    folder: &'static str,
    /// The crates of ours it may depend on, by short name.
    knows: &'static [&'static str],
    /// What more it may know for its tests, examples and benchmarks.
    tests: Tests,
}

#[derive(PartialEq)]
enum Tests {
    /// Any crate that is not above all the others.
    Wide,
    /// None: what it must not know, its tests must not know either.
    Strict,
    /// Every crate.
    All,
}

const fn law(folder: &'static str, knows: &'static [&'static str]) -> Law {
    Law { folder, knows, tests: Tests::Wide }
}

/// The rooms, in the order of the architecture's table; `dynamics`, `dynamics-gpu` and `editor` may not exist yet.
const LAWS: &[Law] = &[
    law("crates/mesh", &[]),
    law("crates/field", &["mesh"]),
    law("crates/patch", &["mesh", "field"]),
    law("crates/creature", &["mesh"]),
    law("crates/strand", &[]),
    law("crates/volume", &["strand"]),
    law("crates/lighting", &[]),
    law("crates/dynamics", &[]),
    law("crates/dynamics-gpu", &["dynamics"]),
    law("crates/coat", &[]),
    law("crates/render", &["coat", "lighting"]),
    law("crates/reference", &["coat", "strand", "lighting"]),
    law("crates/accuracy", &[]),
    Law { folder: "crates/graph", knows: &["graph-derive"], tests: Tests::Strict },
    Law { folder: "crates/graph-derive", knows: &[], tests: Tests::Strict },
    law(
        "crates/nodes",
        &[
            "mesh",
            "field",
            "patch",
            "creature",
            "strand",
            "volume",
            "lighting",
            "dynamics",
            "dynamics-gpu",
            "coat",
            "render",
            "reference",
            "accuracy",
            "graph",
        ],
    ),
    law("crates/cli", &["nodes", "graph", "mesh", "accuracy"]),
    law("crates/xtask", &[]),
    law("editor", &["nodes", "graph", "render", "coat", "mesh"]),
    Law { folder: "tests", knows: &[], tests: Tests::All },
    Law { folder: "tests/fuzz", knows: &[], tests: Tests::All },
];

/// Above all the others: nobody's tests may reach up to them.
const TOP: &[&str] = &["nodes", "cli", "xtask", "editor", "tests", "fuzz"];

/// The only crates under `crates/` that may name wgpu.
const MAY_DRAW: &[&str] = &["crates/render", "crates/dynamics-gpu"];

/// The only folder that may name egui.
const MAY_SHOW: &str = "editor";

/// A workspace member, as far as the laws go.
#[derive(Debug, Clone)]
struct Member {
    package: String,
    folder: String,
    dependencies: Vec<Dependency>,
}

#[derive(Debug, Clone)]
struct Dependency {
    package: String,
    for_tests: bool,
    optional: bool,
}

/// Reads the manifests of the workspace and checks them.
pub(crate) fn check(place: &Place) -> Result<()> {
    let metadata = MetadataCommand::new()
        .manifest_path(place.at("Cargo.toml"))
        .no_deps()
        .exec()
        .map_err(|cause| Failure::caused("cargo metadata", cause))?;
    let members = members(&metadata);
    let faults = faults(&members);
    if !faults.is_empty() {
        return Err(Failure::faults("a crate knows what it must not", &faults)
            .remedy("the laws are in book/src/architecture.md, the table in crates/xtask/src/layering.rs"));
    }
    println!("{} crates keep to the table", members.len());
    Ok(())
}

fn members(metadata: &Metadata) -> Vec<Member> {
    let relative = |manifest: &cargo_metadata::camino::Utf8Path| {
        let folder = manifest.parent().unwrap_or(manifest);
        folder.strip_prefix(&metadata.workspace_root).unwrap_or(folder).as_str().replace('\\', "/")
    };
    let dependency = |dependency: &cargo_metadata::Dependency| Dependency {
        package: dependency.name.clone(),
        for_tests: dependency.kind == DependencyKind::Development,
        optional: dependency.optional,
    };
    let member = |package: &&cargo_metadata::Package| Member {
        package: package.name.to_string(),
        folder: relative(&package.manifest_path),
        dependencies: package.dependencies.iter().map(dependency).collect(),
    };
    metadata.workspace_packages().iter().map(member).collect()
}

/// Every breach of a law, in the order of the members.
fn faults(members: &[Member]) -> Vec<String> {
    members.iter().flat_map(faults_of).collect()
}

fn faults_of(member: &Member) -> Vec<String> {
    let Some(law) = LAWS.iter().find(|law| law.folder == member.folder) else {
        return vec![format!("{}: no law says what it may know: give it a row", member.folder)];
    };
    let mut faults = Vec::new();
    let expected = format!("pelage-{}", short(law.folder));
    if member.package != expected {
        faults.push(format!("{}: its package is called {}, not {expected}", member.folder, member.package));
    }
    for dependency in &member.dependencies {
        faults.extend(breach(law, dependency).map(|breach| format!("{}: {breach}", member.folder)));
    }
    faults
}

/// The folder's own name: `mesh` of `crates/mesh`.
fn short(folder: &str) -> &str {
    folder.rsplit('/').next().unwrap_or(folder)
}

/// What is wrong with a dependency, if anything.
fn breach(law: &Law, dependency: &Dependency) -> Option<String> {
    let package = dependency.package.as_str();
    let kind = if dependency.for_tests { " for its tests" } else { "" };
    if let Some(name) = package.strip_prefix("pelage-") {
        let needless = law.folder == "crates/nodes" && name == "render" && !dependency.for_tests && !dependency.optional;
        return if !may_know(law, name, dependency.for_tests) {
            Some(format!("may not know {package}{kind}"))
        } else if needless {
            Some(format!("may know {package} only as an option, so that all but drawing evaluates without a graphics library"))
        } else {
            None
        };
    }
    let draws = package == "wgpu" || package == "naga" || package.starts_with("wgpu-");
    if draws && law.folder.starts_with("crates/") && !MAY_DRAW.contains(&law.folder) {
        return Some(format!("may not name {package}{kind}: only {} may", MAY_DRAW.join(" and ")));
    }
    let shows = package == "eframe" || package == "egui" || package.starts_with("egui-") || package.starts_with("egui_");
    (shows && law.folder != MAY_SHOW).then(|| format!("may not name {package}{kind}: only {MAY_SHOW} may"))
}

fn may_know(law: &Law, name: &str, for_tests: bool) -> bool {
    let for_its_tests = for_tests && law.tests == Tests::Wide && !TOP.contains(&name);
    law.tests == Tests::All || law.knows.contains(&name) || for_its_tests
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(folder: &str, dependencies: &[&str]) -> Member {
        let plain = |package: &&str| Dependency { package: (*package).to_owned(), for_tests: false, optional: false };
        Member {
            package: format!("pelage-{}", short(folder)),
            folder: folder.to_owned(),
            dependencies: dependencies.iter().map(plain).collect(),
        }
    }

    fn for_tests(mut member: Member) -> Member {
        member.dependencies.iter_mut().for_each(|dependency| dependency.for_tests = true);
        member
    }

    fn optional(mut member: Member) -> Member {
        member.dependencies.iter_mut().for_each(|dependency| dependency.optional = true);
        member
    }

    fn only_fault(member: Member) -> String {
        let mut found = faults(&[member]);
        assert_eq!(found.len(), 1, "{found:?}");
        found.remove(0)
    }

    #[test]
    fn what_the_table_allows_passes() {
        let members = [
            member("crates/mesh", &["glam", "tobj"]),
            member("crates/patch", &["pelage-mesh", "pelage-field", "faer"]),
            member("crates/render", &["pelage-coat", "pelage-lighting", "wgpu"]),
            member("crates/graph", &["pelage-graph-derive", "ron"]),
            optional(member("crates/nodes", &["pelage-render"])),
            member("crates/cli", &["pelage-nodes"]),
            for_tests(member("crates/patch", &["pelage-coat", "pelage-volume"])),
            for_tests(member("tests", &["pelage-nodes", "pelage-cli", "pelage-accuracy", "wgpu"])),
            member("editor", &["pelage-nodes", "eframe", "egui", "egui-wgpu", "wgpu"]),
        ];
        assert_eq!(faults(&members), Vec::<String>::new());
    }

    #[test]
    fn an_arrow_to_the_right_fails() {
        for (folder, package) in [
            ("crates/mesh", "pelage-field"),
            ("crates/field", "pelage-patch"),
            ("crates/patch", "pelage-coat"),
            ("crates/creature", "pelage-field"),
            ("crates/volume", "pelage-render"),
            ("crates/render", "pelage-mesh"),
            ("crates/reference", "pelage-volume"),
            ("crates/cli", "pelage-render"),
        ] {
            let fault = only_fault(member(folder, &[package]));
            assert_eq!(fault, format!("{folder}: may not know {package}"));
        }
    }

    #[test]
    fn coat_strand_lighting_dynamics_and_accuracy_know_none_of_ours() {
        for folder in ["crates/coat", "crates/strand", "crates/lighting", "crates/dynamics", "crates/accuracy"] {
            for package in ["pelage-mesh", "pelage-coat", "pelage-graph", "pelage-volume"] {
                if !package.ends_with(short(folder)) {
                    only_fault(member(folder, &[package]));
                }
            }
        }
    }

    #[test]
    fn the_graph_knows_no_fur_even_in_its_tests() {
        only_fault(member("crates/graph", &["pelage-coat"]));
        only_fault(for_tests(member("crates/graph", &["pelage-mesh"])));
        only_fault(for_tests(member("crates/graph-derive", &["pelage-mesh"])));
        only_fault(member("crates/graph", &["wgpu"]));
    }

    #[test]
    fn tests_may_look_aside_but_not_up() {
        for top in ["pelage-nodes", "pelage-cli", "pelage-xtask", "pelage-editor"] {
            let fault = only_fault(for_tests(member("crates/mesh", &[top])));
            assert_eq!(fault, format!("crates/mesh: may not know {top} for its tests"));
        }
    }

    #[test]
    fn only_render_draws_and_only_the_editor_shows() {
        for package in ["wgpu", "wgpu-core", "naga"] {
            only_fault(member("crates/coat", &[package]));
            only_fault(for_tests(member("crates/nodes", &[package])));
        }
        for package in ["egui", "eframe", "egui-wgpu", "egui_kittest"] {
            only_fault(member("crates/cli", &[package]));
            only_fault(member("tests", &[package]));
        }
    }

    #[test]
    fn nodes_draw_only_as_an_option() {
        assert!(only_fault(member("crates/nodes", &["pelage-render"])).contains("only as an option"));
    }

    #[test]
    fn a_crate_without_a_row_fails() {
        assert!(only_fault(member("crates/comb", &[])).contains("no law"));
        assert!(only_fault(member("tools", &[])).contains("no law"));
    }

    #[test]
    fn a_misnamed_package_fails() {
        let renamed = Member { package: "pelage-meshes".to_owned(), ..member("crates/mesh", &[]) };
        assert!(only_fault(renamed).contains("not pelage-mesh"));
    }

    #[test]
    fn the_table_itself_only_points_left() {
        for (row, law) in LAWS.iter().enumerate() {
            for known in law.knows {
                let other = LAWS.iter().position(|law| short(law.folder) == *known).expect("a row for what is known");
                let derive = law.folder == "crates/graph"; // a derive is written below what it serves
                assert!(other < row || derive, "{} knows {known}", law.folder);
            }
        }
    }

    #[test]
    fn the_workspace_is_read() {
        let place = Place::find().unwrap();
        let metadata = MetadataCommand::new().manifest_path(place.at("Cargo.toml")).no_deps().exec().unwrap();
        let members = members(&metadata);
        let patch = members.iter().find(|member| member.folder == "crates/patch").expect("crates/patch is a member");
        assert!(patch.dependencies.iter().any(|dependency| dependency.package == "pelage-mesh" && !dependency.for_tests));
        assert!(patch.dependencies.iter().any(|dependency| dependency.package == "proptest" && dependency.for_tests));
        assert_eq!(faults(&members), Vec::<String>::new());
    }
}
