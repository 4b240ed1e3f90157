//! Graphs at random: any kinds, linked by type, any values, and now and then something that does not fit.

use pelage_graph::{Arity, Limits, ParamSpec, ParamType, Registry, Specification};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Whole numbers that cost decide how long a node takes: no more than this.
const CAPS: &[(&str, i128)] = &[
    ("subdivisions", 6),
    ("cells", 10),
    ("faces", 600),
    ("times", 2),
    ("count", 40),
    ("steps", 8),
    ("layers", 6),
    ("resolution", 32),
    ("size", 64),
    ("tiles_across", 3),
    ("undercoat", 0),
];

pub(crate) struct Generator<'r> {
    registry: &'r Registry,
    random: Pcg64,
    text: String,
    /// Every output so far: its name and type.
    outputs: Vec<(String, String)>,
}

/// The text of a graph: the same for the same seed.
pub(crate) fn graph(registry: &Registry, seed: u64) -> String {
    let mut generator = Generator { registry, random: Pcg64::seed_from_u64(seed), text: String::new(), outputs: Vec::new() };
    for (index, kind) in ["Sphere", "GrowStrands"].into_iter().enumerate() {
        generator.node(kind, index);
    }
    let kinds: Vec<&str> = registry
        .specifications()
        .map(|s| s.kind.as_str())
        .filter(|kind| !["RenderImage", "ReferenceImage", "StrandCurves", "ObjFile", "GltfFile"].contains(kind))
        .collect();
    for index in 2..generator.random.random_range(6..16) {
        let kind = kinds[generator.random.random_range(0..kinds.len())];
        generator.node(kind, index);
    }
    format!("Graph(version: 1, nodes: {{\n{}}})", generator.text)
}

impl Generator<'_> {
    fn chance(&mut self, of_thousand: u32) -> bool {
        self.random.random_range(0..1000) < of_thousand
    }

    /// A node, if there is something to link it to.
    fn node(&mut self, kind: &str, index: usize) {
        let Some(specification) = self.registry.specification(kind) else { return };
        let mut fields = Vec::new();
        for input in &specification.inputs {
            let fitting: Vec<usize> = (0..self.outputs.len()).filter(|&output| self.outputs[output].1 == input.ty.name).collect();
            if self.chance(3) {
                fields.push(format!("{}: \"n{}.mesh\"", input.name, self.random.random_range(0..20)));
            } else if !fitting.is_empty() && (input.arity == Arity::One || self.chance(600)) {
                let output = &self.outputs[fitting[self.random.random_range(0..fitting.len())]].0;
                fields.push(format!("{}: \"{output}\"", input.name));
            } else if input.arity == Arity::One {
                return;
            }
        }
        for param in &specification.params {
            if param.default.is_none() || self.cap(param).is_some() || self.chance(350) {
                fields.push(format!("{}: {}", param.name, self.value(param, &param.ty, param.range)));
            }
        }
        self.text += &format!("\"n{index}\": {kind}({}),\n", fields.join(", "));
        self.remember(specification, index);
    }

    fn remember(&mut self, specification: &Specification, index: usize) {
        let outputs = specification.outputs.iter().map(|output| (format!("n{index}.{}", output.name), output.ty.name.clone()));
        self.outputs.extend(outputs);
    }

    fn cap(&self, param: &ParamSpec) -> Option<i128> {
        CAPS.iter().find(|(name, _)| *name == param.name && holds_whole_numbers(&param.ty)).map(|(_, cap)| *cap)
    }

    fn value(&mut self, param: &ParamSpec, ty: &ParamType, range: Option<Limits>) -> String {
        match ty {
            ParamType::Bool => self.chance(500).to_string(),
            ParamType::Integer { min, max } => self.whole(param, (*min, *max), range),
            ParamType::Number { .. } => self.number(range),
            ParamType::Text => "\"text\"".to_owned(),
            ParamType::File => if self.chance(50) { "\"none.png\"" } else { "\"images/meadow.png\"" }.to_owned(),
            ParamType::Colour => {
                let within = Some(Limits { min: Some(0.0), max: Some(1.0), max_excluded: false });
                format!("({}, {}, {})", self.number(within), self.number(within), self.number(within))
            }
            ParamType::Tuple(types) => format!("({})", types.iter().map(|ty| self.value(param, ty, range)).collect::<Vec<_>>().join(", ")),
            ParamType::List(ty) => {
                let count = self.random.random_range(0..4);
                format!("[{}]", (0..count).map(|_| self.value(param, ty, range)).collect::<Vec<_>>().join(", "))
            }
            ParamType::Optional(ty) => {
                if self.chance(300) {
                    "None".to_owned()
                } else {
                    self.value(param, ty, range)
                }
            }
            ParamType::Choice(choice) => {
                let variant = &choice.variants[self.random.random_range(0..choice.variants.len())];
                format!("{}({})", variant.name, self.fields(&variant.fields))
            }
            ParamType::Record(record) => format!("({})", self.fields(&record.fields)),
        }
    }

    fn fields(&mut self, params: &[ParamSpec]) -> String {
        let mut fields = Vec::new();
        for param in params {
            if param.default.is_none() || self.cap(param).is_some() || self.chance(500) {
                fields.push(format!("{}: {}", param.name, self.value(param, &param.ty, param.range)));
            }
        }
        fields.join(", ")
    }

    fn whole(&mut self, param: &ParamSpec, of_type: (i128, i128), range: Option<Limits>) -> String {
        let min = range.and_then(|range| range.min).map_or(of_type.0, |min| min as i128);
        let most = range.and_then(|range| range.max).map_or(of_type.1, |max| max as i128);
        if self.chance(2) {
            return if self.chance(500) { min - 1 } else { most + 1 }.to_string();
        }
        let max = self.cap(param).map_or(most, |cap| cap.min(most));
        match self.random.random_range(0..4) {
            0 => min,
            1 => max,
            // Where powers of two are asked for, mostly one.
            2 if min > 0 => (1_i128 << self.random.random_range(0..7)).clamp(min, max),
            _ => min + (u128::from(self.random.next_u64()) % ((max - min) as u128 + 1)) as i128,
        }
        .to_string()
    }

    fn number(&mut self, range: Option<Limits>) -> String {
        let (min, max) = range.map_or((-10.0, 10.0), |range| (range.min.unwrap_or(-10.0), range.max.unwrap_or(10.0)));
        let value = match self.random.random_range(0..200) {
            0 => max + 1.0,
            1 => min - 1.0,
            2 => return ["NaN", "inf", "-inf"][self.random.random_range(0..3)].to_owned(),
            3..=40 => min,
            41..=80 => max,
            81..=100 => 0.0_f64.clamp(min, max),
            _ => min + (max - min) * self.random.random::<f64>(),
        };
        format!("{value:?}")
    }
}

fn holds_whole_numbers(ty: &ParamType) -> bool {
    match ty {
        ParamType::Integer { .. } => true,
        ParamType::Tuple(items) => items.iter().all(holds_whole_numbers),
        ParamType::Record(_) => true,
        _ => false,
    }
}
