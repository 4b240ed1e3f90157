//! The figures of an evaluation, as `pelage render --stats` writes them; the keys are a promise to scripts.

use pelage_coat::{Coat, Encoding, FinTexture, ShellTexture};
use pelage_field::DirectionField;
use pelage_graph::{Evaluation, Part, PortParts, State};
use pelage_mesh::{Mesh, RepairReport, Summary};
use pelage_patch::PatchTiling;
#[cfg(feature = "gpu")]
use pelage_render::Fragments;
use serde_json::{Map, Value, json};

/// The figures of an evaluation: only what applies is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Stats(Map<String, Value>);

impl Stats {
    /// Collects what the values of an evaluation say about themselves.
    pub fn of(evaluation: &Evaluation) -> Self {
        let mut stats = Map::new();
        stats.insert("pelage".into(), env!("CARGO_PKG_VERSION").into());
        stats.insert("nodes".into(), trace(evaluation));
        let found = Found::among(evaluation);
        if let Some(mesh) = &found.mesh {
            stats.insert("model".into(), model(&Summary::of(mesh), found.repairs.as_deref()));
        }
        if let (Some(mesh), Some(tiling)) = (&found.mesh, &found.tiling) {
            stats.insert("patches".into(), patches(mesh, tiling, found.directions.as_deref()));
        }
        if found.shells.is_some() || found.fin.is_some() {
            stats.insert("textures".into(), textures(found.shells.as_deref(), found.fin.as_deref()));
        }
        if let Some(curls) = found.curls.as_deref().filter(|curls| curls.share > 0.0) {
            let crate::CurlReport { share, texels, layers } = *curls;
            stats.insert("curls".into(), json!({ "share": share, "texels": texels, "layers_a_turn": layers, "warning": curls.warning() }));
        }
        #[cfg(feature = "gpu")]
        let budgets = budgets(evaluation);
        #[cfg(feature = "gpu")]
        if !budgets.is_empty() {
            stats.insert("budgets".into(), Value::Object(budgets));
        }
        Self(stats)
    }

    /// Adds what drawing took.
    #[cfg(feature = "gpu")]
    pub fn insert_frame(&mut self, report: &crate::FrameReport) {
        let adapter = &report.adapter;
        self.insert("adapter", json!({ "name": adapter.name, "backend": adapter.backend, "software": adapter.software }));
        self.insert("frame", frame(report));
    }

    /// Adds what the program knows: the graph's name, a hash.
    pub fn insert(&mut self, key: &str, value: Value) {
        self.0.insert(key.into(), value);
    }

    /// A figure by its JSON pointer, `/frame/ms_median` say; none where it does not apply.
    pub fn figure(&self, pointer: &str) -> Option<&Value> {
        let (key, rest) = pointer.strip_prefix('/').map(|path| path.split_at(path.find('/').unwrap_or(path.len())))?;
        self.0.get(key)?.pointer(rest)
    }

    /// As JSON, indented.
    pub fn to_json(&self) -> String {
        format!("{:#}\n", Value::Object(self.0.clone()))
    }
}

/// The last value of each kind that the evaluation made: a graph usually has one.
#[derive(Default)]
struct Found {
    mesh: Option<std::sync::Arc<Mesh>>,
    repairs: Option<std::sync::Arc<RepairReport>>,
    directions: Option<std::sync::Arc<DirectionField>>,
    tiling: Option<std::sync::Arc<PatchTiling>>,
    shells: Option<std::sync::Arc<ShellTexture>>,
    fin: Option<std::sync::Arc<FinTexture>>,
    curls: Option<std::sync::Arc<crate::CurlReport>>,
}

impl Found {
    fn among(evaluation: &Evaluation) -> Self {
        let mut found = Self::default();
        for (_, _, value) in evaluation.values() {
            found.mesh = value.downcast::<Mesh>().or(found.mesh);
            found.repairs = value.downcast::<RepairReport>().or(found.repairs);
            found.directions = value.downcast::<DirectionField>().or(found.directions);
            found.tiling = value.downcast::<PatchTiling>().or(found.tiling);
            found.curls = value.downcast::<crate::CurlReport>().or(found.curls);
            if let Some(coat) = value.downcast::<Coat>() {
                found.shells = Some(coat.shells.clone()).filter(|shells| **shells != ShellTexture::bare());
                found.fin.clone_from(&coat.fin);
            }
        }
        found
    }
}

/// What the nodes of an evaluation found wanting, though they did what they were asked: the node and how to mend it.
pub fn warnings(evaluation: &Evaluation) -> Vec<String> {
    let curls = evaluation.values().filter_map(|(node, _, value)| Some((node, value.downcast::<crate::CurlReport>()?.warning()?)));
    curls.map(|(node, warning)| format!("{node}: {warning}")).collect()
}

#[cfg(feature = "gpu")]
/// By node, the row of its table that a budget draws by.
fn budgets(evaluation: &Evaluation) -> Map<String, Value> {
    let row = |(node, _, value): (&pelage_graph::NodeId, &str, &pelage_graph::Value)| {
        let row = value.downcast::<crate::Quality>()?.row?;
        Some((
            node.to_string(),
            json!({ "line": row.line, "margin": row.margin, "cost": row.cost, "flip_mean": row.error, "shells": row.shells }),
        ))
    };
    evaluation.values().filter_map(row).collect()
}

fn trace(evaluation: &Evaluation) -> Value {
    let nodes = evaluation.trace().iter().map(|entry| {
        let state = match entry.state {
            State::Computed => "computed",
            State::Hit => "cached",
            State::NotNeeded => "not needed",
        };
        let mut node = json!({ "kind": entry.kind, "state": state, "ms": entry.ms });
        if !entry.parts.is_empty() {
            node["parts"] = Value::Object(entry.parts.iter().map(parts).collect());
        }
        (entry.node.to_string(), node)
    });
    Value::Object(nodes.collect())
}

/// An output, and which of its parts there are and which nobody wants.
fn parts(output: &PortParts) -> (String, Value) {
    let names = |parts: &[Part]| parts.iter().map(|part| part.name).collect::<Vec<_>>();
    (output.port.clone(), json!({ "made": names(&output.made), "left_out": names(&output.left_out) }))
}

fn model(summary: &Summary, repairs: Option<&RepairReport>) -> Value {
    let mut model = json!({
        "vertices": summary.vertices, "edges": summary.edges, "faces": summary.faces,
        "boundary_loops": summary.boundary_loops, "components": summary.components, "genus": summary.genus,
    });
    if let Some(repairs) = repairs {
        model["repairs"] = repair_counts(repairs);
    }
    model
}

/// What was mended, by the names of the report; all of them, so that a script need not know which are there.
pub fn repair_counts(repairs: &RepairReport) -> Value {
    Value::Object(repairs.counts().map(|(name, _, count)| (name.to_owned(), count.into())).into_iter().collect())
}

fn patches(mesh: &Mesh, tiling: &PatchTiling, directions: Option<&DirectionField>) -> Value {
    let quality = tiling.quality(mesh, directions);
    let mut patches = json!({
        "count": quality.patch_count, "faces_covered": quality.faces_covered, "faces_flipped": quality.faces_flipped, "discs": quality.all_discs,
        "faces_per_patch_p50": quality.faces_per_patch_p50, "stretch_p50": quality.stretch_p50, "stretch_p99": quality.stretch_p99,
        "seam_length": quality.seam_length,
        "tile_repeats_p50": quality.tile_repeats_p50, "tile_repeats_max": quality.tile_repeats_max,
    });
    // A key that does not apply is absent.
    if let Some(degrees) = quality.misalignment_deg_mean {
        patches["misalignment_deg_mean"] = json!(degrees);
    }
    if let Some(degrees) = quality.misalignment_deg_mean_far {
        patches["misalignment_deg_mean_far"] = json!(degrees);
    }
    patches
}

#[cfg(feature = "gpu")]
fn frame(report: &crate::FrameReport) -> Value {
    let stats = &report.stats;
    let mut frame = json!({
        "width": report.size.0, "height": report.size.1, "shells_drawn": stats.shells_drawn,
        "faces_drawn": stats.faces_drawn, "faces_furred": stats.faces_furred, "patches_drawn": stats.patches_drawn, "level": stats.level,
        "fins_drawn": stats.fins_drawn, "fins_considered": stats.fins_considered, "triangles": stats.triangles,
    });
    if let Some(fragments) = &stats.fragments {
        let Fragments { surface, fins, shells } = *fragments;
        frame["fragments"] = json!({ "surface": surface, "fins": fins, "shells": shells, "total": fragments.total() });
    }
    if let Some(times) = &report.times {
        frame["frames"] = json!(times.frames);
        frame["ms_min"] = json!(times.ms_min);
        frame["ms_median"] = json!(times.ms_median);
        frame["ms_max"] = json!(times.ms_max);
    }
    if let Some(passes) = report.times.as_ref().and_then(|times| times.passes).or(stats.passes) {
        let named = [("compute", passes.compute), ("surface", passes.surface), ("fins", passes.fins), ("shells", passes.shells)];
        frame["pass_ms"] = Value::Object(named.into_iter().filter_map(|(name, ms)| Some((name.to_owned(), json!(ms?)))).collect());
    }
    frame
}

fn textures(shells: Option<&ShellTexture>, fin: Option<&FinTexture>) -> Value {
    let (shell_bytes, direction_bytes) = (shells.map_or(0, ShellTexture::byte_size), shells.map_or(0, ShellTexture::direction_bytes));
    let fin_bytes = fin.map_or(0, FinTexture::byte_size);
    let mut textures = json!({
        "shell_bytes": shell_bytes, "fin_bytes": fin_bytes, "direction_bytes": direction_bytes,
        "total_bytes": shell_bytes + fin_bytes + direction_bytes,
    });
    if let Some(shells) = shells {
        textures["layers"] = json!(shells.layers());
        textures["resolution"] = json!(shells.resolution());
        textures["images"] = json!(shells.images);
        textures["encoding"] = json!(match shells.encoding {
            Encoding::Rgba8 => "rgba8",
            Encoding::Bc3 => "bc3",
        });
    }
    textures
}
