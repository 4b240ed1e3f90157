//! Whether every registered node says what a user has to know.

use crate::conform::conform;
use crate::needs::{Needs, PartSet, Reading, Wanted};
use crate::node::{Fetched, Fields, Params};
use crate::registry::{Kind, Registry};
use crate::spec::{OutputSpec, ParamSpec, ParamType, Specification};

/// Something a specification leaves out or contradicts.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct SpecificationFault {
    /// Kind, or `kind.field`.
    pub place: String,
    /// What is wrong.
    pub message: String,
}

/// All faults of a registry. Never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpecificationFaults(
    /// Each fault.
    pub Vec<SpecificationFault>,
);

/// One line for each fault.
impl std::fmt::Display for SpecificationFaults {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let lines: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for SpecificationFaults {}

impl Registry {
    /// Visits every specification; for the test that each program with nodes of its own should have.
    ///
    /// Everything documented, categories given, names unique, field names in `snake_case`, port types registered; numbers with a unit, and those that stand alone
    /// with a range and an effect besides (a seed, whose unit is `seed`, needs no range); defaults that fit their own type
    /// and range; needs that name inputs and parts that there are.
    ///
    /// # Errors
    /// All that is wrong.
    pub fn validate(&self) -> Result<(), SpecificationFaults> {
        let mut faults = Vec::new();
        for name in &self.repeated {
            faults.push(SpecificationFault { place: name.clone(), message: "registered twice".to_owned() });
        }
        for kind in self.kinds() {
            let mut visit = Visit { registry: self, place: kind.specification.kind.clone(), faults: &mut faults };
            visit.node(&kind.specification);
            visit.needs(kind);
        }
        // What a node says twice, of two ways in which it is wanted, is one fault.
        faults.dedup();
        if faults.is_empty() { Ok(()) } else { Err(SpecificationFaults(faults)) }
    }
}

struct Visit<'v> {
    registry: &'v Registry,
    place: String,
    faults: &'v mut Vec<SpecificationFault>,
}

impl Visit<'_> {
    fn expect(&mut self, holds: bool, message: &str) {
        if !holds {
            self.faults.push(SpecificationFault { place: self.place.clone(), message: message.to_owned() });
        }
    }

    fn within(&mut self, name: &str) -> Visit<'_> {
        Visit { registry: self.registry, place: format!("{}.{name}", self.place), faults: &mut *self.faults }
    }

    fn named(&mut self, name: &str, doc: &str) {
        self.expect(!doc.trim().is_empty(), "not documented");
        let snake = name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(|c| c == '_' || c.is_ascii_lowercase() || c.is_ascii_digit());
        self.expect(snake, "the name is not in snake_case");
    }

    fn node(&mut self, specification: &Specification) {
        self.expect(!specification.doc.trim().is_empty(), "not documented");
        self.expect(!specification.category.trim().is_empty(), "no category");
        self.expect(!specification.outputs.is_empty(), "no output");
        let former =
            specification.inputs.iter().flat_map(|input| &input.was).chain(specification.params.iter().flat_map(|param| &param.was));
        let names: Vec<&str> = specification.field_names().chain(former.map(String::as_str)).collect();
        for was in &specification.was {
            let taken = self.registry.specifications().any(|other| other.kind == *was);
            self.expect(!taken, &format!("its former name {was} is the name of a kind"));
        }
        for (index, name) in names.iter().enumerate() {
            self.expect(!names[..index].contains(name), &format!("two fields are called {name:?}"));
        }
        for input in &specification.inputs {
            let mut visit = self.within(&input.name);
            visit.named(&input.name, &input.doc);
            visit.port(input.ty.id, &input.ty.name);
        }
        for output in &specification.outputs {
            let mut visit = self.within(&output.name);
            visit.named(&output.name, &output.doc);
            visit.port(output.ty.id, &output.ty.name);
            visit.parts(output);
        }
        for param in &specification.params {
            self.within(&param.name).param(param);
        }
    }

    fn parts(&mut self, output: &OutputSpec) {
        for (index, part) in output.parts.iter().enumerate() {
            self.within(part.name).named(part.name, part.doc);
            let twice = output.parts[..index].iter().any(|other| other.name == part.name);
            self.expect(!twice, &format!("two parts are called {:?}", part.name));
        }
    }

    /// What the node says it needs where nothing is known yet but what is wanted: each output with all its parts, and with none.
    fn needs(&mut self, kind: &Kind) {
        let specification = &kind.specification;
        let fetched = specification.field_names().map(|_| Fetched::Pending).collect();
        let fields = Fields { specification, fetched };
        for output in &specification.outputs {
            for parts in [(0..output.parts.len()).collect(), PartSet::new()] {
                let needs = (kind.needs)(&Wanted { output, parts: &parts }, &Params { fields: &fields });
                self.within(&output.name).inputs(specification, &needs);
            }
        }
    }

    fn inputs(&mut self, specification: &Specification, needs: &Needs) {
        for (name, reading) in needs.inputs() {
            let Some(input) = specification.inputs.iter().find(|input| input.name == name) else {
                self.expect(false, &format!("its needs name an input {name:?} that the node does not have"));
                continue;
            };
            if *reading == Reading::Nothing {
                let message = format!("its needs leave {name:?} out, which is always read; make it Option<Arc<…>> and #[input(required)]");
                self.expect(!input.always, &message);
            }
            let Reading::Parts(parts) = reading else { continue };
            let others: Vec<&OutputSpec> =
                self.registry.specifications().flat_map(|other| &other.outputs).filter(|output| output.ty.id == input.ty.id).collect();
            for part in parts {
                let known = others.iter().any(|output| output.parts.contains(part));
                let message = format!("its needs name a part {:?} of {name:?} that no output of type {} has", part.name, input.ty.name);
                self.expect(known, &message);
            }
        }
    }

    fn port(&mut self, id: std::any::TypeId, name: &str) {
        let registered = self.registry.type_entry(id).is_some();
        self.expect(registered, &format!("its type {name} is not registered; add .value::<{name}>(…)"));
    }

    fn param(&mut self, param: &ParamSpec) {
        self.named(&param.name, &param.doc);
        let given = |text: &Option<String>| text.as_ref().is_some_and(|text| !text.trim().is_empty());
        self.expect(!param.ty.holds_numbers() || given(&param.unit), "a number without a unit");
        if param.ty.is_scalar_number() {
            let seed = param.unit.as_deref() == Some("seed");
            self.expect(seed || param.range.is_some(), "a number without a range");
            self.expect(given(&param.effect), "a number that does not say what turning it does: add effect = \"…\"");
        }
        if let Some(range) = param.range {
            let empty = matches!((range.min, range.max), (Some(min), Some(max)) if min > max || min == max && range.max_excluded);
            self.expect(!empty, "its range is empty");
        }
        if let Some(default) = &param.default {
            let mut misfits = Vec::new();
            conform(param, default, &mut misfits);
            for misfit in misfits {
                self.expect(false, &format!("its default does not fit{}: {}", misfit.path, misfit.kind));
            }
        }
        self.nested(&param.ty);
    }

    fn nested(&mut self, ty: &ParamType) {
        match ty {
            ParamType::Optional(inner) | ParamType::List(inner) => self.nested(inner),
            ParamType::Tuple(items) => items.iter().for_each(|item| self.nested(item)),
            ParamType::Record(record) => record.fields.iter().for_each(|field| self.within(&field.name).param(field)),
            ParamType::Choice(choice) => {
                for variant in &choice.variants {
                    let mut visit = self.within(&variant.name);
                    visit.expect(!variant.doc.trim().is_empty(), "not documented");
                    variant.fields.iter().for_each(|field| visit.within(&field.name).param(field));
                }
            }
            _ => {}
        }
    }
}
