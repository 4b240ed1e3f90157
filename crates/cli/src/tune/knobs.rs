//! What a graph has to turn: the inputs that trade error for cost, and the values to try.

use indexmap::IndexMap;
use pelage_graph::{CheckedGraph, Graph, Literal, Param, Registry};
use pelage_nodes::{LightingAt, ShellDetail};

use crate::render::node_of;

/// Values that are tried, in the order from the cheapest; those that are more than twice what the graph has now are not, but for the first few.
const LAYERS: [u32; 13] = [4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256];
const RESOLUTIONS: [u32; 7] = [32, 64, 128, 256, 512, 1024, 2048];

/// Up to here they are always tried.
const ENOUGH_LAYERS: u32 = 32;
const ENOUGH_TEXELS: u32 = 128;

/// More shells than these have more images in all levels of detail than a graphics card takes.
const MOST_LAYERS_WITH_LEVELS: u32 = 128;

const LIGHTING: [&str; 4] = ["Patches", "Vertices", "Table(size: 64)", "Pixels"];

/// Pixels between shells, where there are levels of detail.
const SPACINGS: [f64; 5] = [2.0, 1.0, 0.5, 0.25, 0.0];

/// The inputs behind an output that are worth turning, each with the values to try, the finest last; among them is what the graph has now. An input that is linked is left alone.
pub(super) fn of(graph: &Graph, checked: &CheckedGraph, registry: &Registry, output: &str) -> IndexMap<String, Vec<String>> {
    let behind: Vec<(&str, &str)> = checked
        .behind(output)
        .filter_map(|id| Some((id.as_str(), graph.nodes.get(id).map(|node| node.kind.as_str())?)))
        .map(|(id, kind)| (id, registry.specification(kind).map_or(kind, |specification| &specification.kind)))
        .collect();
    let has = |kind: &str| behind.iter().any(|(_, other)| *other == kind);
    let makes = |ty: &str| {
        let outputs = |kind: &str| registry.specification(kind).is_some_and(|kind| kind.outputs.iter().any(|output| output.ty.name == ty));
        behind.iter().any(|(_, kind)| outputs(kind))
    };
    let levels = has("LevelsOfDetail");
    let now = Now { graph, registry };
    let mut knobs = IndexMap::new();
    let mut add = |node: &str, input: &str, values: Option<Vec<String>>| {
        if let Some(values) = values {
            knobs.insert(format!("{node}.{input}"), values);
        }
    };
    for (node, _) in behind.iter().filter(|(_, kind)| *kind == "SampleShells") {
        let most = if levels { MOST_LAYERS_WITH_LEVELS } else { u32::MAX };
        add(node, "layers", now.value::<u32>(node, "layers").map(|now| ladder(&LAYERS, ENOUGH_LAYERS, most, now)));
        add(node, "resolution", now.value::<u32>(node, "resolution").map(|now| ladder(&RESOLUTIONS, ENOUGH_TEXELS, u32::MAX, now)));
    }
    let picture = node_of(output);
    // What a budget decides is not for the node to say.
    if now.literal(picture, "budget").is_some() {
        return knobs;
    }
    if makes("FinTexture") {
        add(picture, "fins", now.value::<bool>(picture, "fins").map(|_| vec!["false".into(), "true".into()]));
    }
    add(picture, "lighting", now.value(picture, "lighting").map(|lighting| places_of_light(&now, picture, &lighting)));
    if levels {
        add(picture, "detail", now.value(picture, "detail").map(|detail| spacings(&detail)));
    }
    knobs
}

/// What the inputs of a graph have now.
struct Now<'a> {
    graph: &'a Graph,
    registry: &'a Registry,
}

impl Now<'_> {
    /// What is written.
    fn literal(&self, node: &str, input: &str) -> Option<&Literal> {
        self.graph.nodes.get(node).and_then(|node| node.fields.get(input))
    }

    /// The value of a parameter, written or by default; none if it is linked.
    fn value<P: Param>(&self, node: &str, input: &str) -> Option<P> {
        let kind = &self.graph.nodes.get(node)?.kind;
        let param = self.registry.specification(kind)?.param(input)?;
        let literal = self.literal(node, input).or(param.default.as_ref())?;
        self.read(node, input, &literal.to_string())
    }

    /// A value of a parameter.
    fn read<P: Param>(&self, node: &str, input: &str, text: &str) -> Option<P> {
        let kind = &self.graph.nodes.get(node)?.kind;
        self.registry.specification(kind)?.param(input)?.read(text).ok()
    }
}

/// The rungs up to twice what there is now, and what there is now.
fn ladder(rungs: &[u32], enough: u32, most: u32, now: u32) -> Vec<String> {
    let end = now.saturating_mul(2).max(enough).min(most);
    let mut values: Vec<u32> = rungs.iter().copied().filter(|&rung| rung <= end).chain([now]).collect();
    values.sort_unstable();
    values.dedup();
    values.iter().map(u32::to_string).collect()
}

/// From once a patch to every pixel; another table than the one here goes before the formula.
fn places_of_light(now: &Now<'_>, picture: &str, lighting: &LightingAt) -> Vec<String> {
    let mut values: Vec<String> = LIGHTING.map(String::from).into();
    if !values.iter().any(|value| now.read::<LightingAt>(picture, "lighting", value).as_ref() == Some(lighting)) {
        values.insert(values.len() - 1, lighting.to_literal().to_string());
    }
    values
}

fn spacings(detail: &ShellDetail) -> Vec<String> {
    let mut pixels: Vec<f64> = SPACINGS.into();
    if let ShellDetail::Spacing { pixels: now } = detail {
        pixels.push(*now);
    }
    pixels.sort_by(|a, b| b.total_cmp(a));
    pixels.dedup();
    pixels.iter().map(|pixels| format!("Spacing(pixels: {pixels:?})")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The knobs of a graph whose coat is made with `shells`, and whose picture has `picture` set.
    fn knobs(shells: &str, coat: &str, picture: &str) -> IndexMap<String, Vec<String>> {
        let text = format!(
            r#"Graph(version: 1, nodes: {{
            "ball": Sphere(), "patches": GrowPatches(mesh: "ball.mesh"), "hair": GrowStrands(), "idle": SampleShells(strands: "hair.strands"), {shells}
            "fin": SampleFin(strands: "hair.strands"), "camera": Camera(), "light": Light(), "shading": HairLighting(),
            "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells"{coat}),
            "picture": RenderImage(fur: "coat.fur", camera: "camera.camera", light: "light.light", shading: "shading.shading"{picture}) }})"#
        );
        let (graph, registry) = (Graph::parse(&text).unwrap(), pelage_nodes::registry());
        of(&graph, &graph.check(&registry).unwrap(), &registry, "picture.image")
    }

    fn values(knobs: &IndexMap<String, Vec<String>>, name: &str) -> String {
        knobs.get(name).map(|values| values.join(" ")).unwrap_or_default()
    }

    #[test]
    fn only_what_the_picture_draws_on_is_turned() {
        let knobs = knobs(r#""shells": SampleShells(strands: "hair.strands", layers: 20),"#, "", "");
        assert_eq!(knobs.keys().collect::<Vec<_>>(), ["shells.layers", "shells.resolution", "picture.lighting"]);
        assert_eq!(values(&knobs, "shells.layers"), "4 6 8 12 16 20 24 32");
        assert_eq!(values(&knobs, "shells.resolution"), "32 64 128 256");
        assert_eq!(values(&knobs, "picture.lighting"), "Patches Vertices Table(size: 64) Pixels");
    }

    #[test]
    fn fins_and_levels_are_turned_where_there_are_some() {
        let shells = r#""sampled": SampleShells(strands: "hair.strands", layers: 100, resolution: 16), "shells": LevelsOfDetail(shells: "sampled.shells"),"#;
        let knobs = knobs(
            shells,
            r#", fin: "fin.fin""#,
            ", fins: false, detail: Spacing(pixels: 0.7), lighting: Table(size: 64, diffuse_by: Cosine)",
        );
        assert_eq!(values(&knobs, "sampled.layers"), "4 6 8 12 16 24 32 48 64 96 100 128");
        assert_eq!(values(&knobs, "sampled.resolution"), "16 32 64 128");
        assert_eq!(values(&knobs, "picture.fins"), "false true");
        assert_eq!(
            values(&knobs, "picture.lighting"),
            "Patches Vertices Table(size: 64) Table(size: 64, diffuse_by: Cosine, specular_by: Cosine) Pixels"
        );
        let spacings = [2.0, 1.0, 0.7, 0.5, 0.25, 0.0].map(|pixels| format!("Spacing(pixels: {pixels:?})")).join(" ");
        assert_eq!(values(&knobs, "picture.detail"), spacings);
    }

    #[test]
    fn a_link_is_left_alone() {
        let shells =
            r#""half": SampleShells(strands: "hair.strands"), "shells": SampleShells(strands: "hair.strands", layers: "half.shells"),"#;
        let text = format!(r#"Graph(version: 1, nodes: {{ "hair": GrowStrands(), {shells} }})"#);
        let (graph, registry) = (Graph::parse(&text).unwrap(), pelage_nodes::registry());
        assert_eq!(Now { graph: &graph, registry: &registry }.value::<u32>("shells", "layers"), None);
        assert_eq!(Now { graph: &graph, registry: &registry }.value::<u32>("half", "layers"), Some(16));
    }
}
