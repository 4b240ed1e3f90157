//! The node kinds and value types a program knows, listed one by one.

use std::any::TypeId;
use std::collections::HashMap;
use std::sync::Arc;

use indexmap::IndexMap;

use crate::context::Context;
use crate::needs::{Needs, Wanted};
use crate::node::{Evaluate, Fields, Node, NodeError, Outputs, Params};
use crate::param_types::{Colour, FilePath};
use crate::spec::Specification;
use crate::value::{TypeEntry, Value};

/// What a node's `evaluate` gives, untyped.
pub(crate) type Ports = Vec<(&'static str, Option<Value>)>;

/// A node kind: what is known of it and how it runs.
pub(crate) struct Kind {
    pub(crate) specification: Specification,
    pub(crate) run: fn(&Fields<'_>, &mut Context<'_>) -> Result<Ports, NodeError>,
    pub(crate) needs: fn(&Wanted<'_>, &Params<'_>) -> Needs,
}

fn run<N: Evaluate>(fields: &Fields<'_>, cx: &mut Context<'_>) -> Result<Ports, NodeError> {
    N::fetch(fields)?.evaluate(cx).map(Outputs::into_values)
}

/// Every node kind and every type of value that may travel between them.
///
/// Nothing registers itself: what a program can do is what its one function that builds the registry lists.
pub struct Registry {
    kinds: IndexMap<String, Arc<Kind>>,
    types: HashMap<TypeId, Arc<TypeEntry>>,
    /// Present names of kinds by former ones.
    former: HashMap<String, String>,
    /// Kinds and type names that were registered twice, for [`validate`](Self::validate) to report.
    pub(crate) repeated: Vec<String>,
}

impl Default for Registry {
    fn default() -> Self {
        Self::new()
    }
}

impl Registry {
    /// No nodes, and the types of value that parameters are made of: `bool`, `i32` and the other numbers, `Text`, `FilePath`,
    /// `Colour`, and `Vector2` and `Vector3` for `[f64; 2]` and `[f64; 3]`.
    pub fn new() -> Self {
        Self { kinds: IndexMap::new(), types: HashMap::new(), former: HashMap::new(), repeated: Vec::new() }
            .value::<bool>("bool", size_of_val)
            .value::<i32>("i32", size_of_val)
            .value::<i64>("i64", size_of_val)
            .value::<u32>("u32", size_of_val)
            .value::<u64>("u64", size_of_val)
            .value::<f32>("f32", size_of_val)
            .value::<f64>("f64", size_of_val)
            .value::<String>("Text", String::len)
            .value::<FilePath>("FilePath", |path| path.as_path().as_os_str().len())
            .value::<Colour>("Colour", size_of_val)
            .value::<[f64; 2]>("Vector2", size_of_val)
            .value::<[f64; 3]>("Vector3", size_of_val)
    }

    /// With a type of value, its plain name, and a function that counts its bytes, heap included: the cache is bounded by it.
    #[must_use]
    pub fn value<T: Send + Sync + 'static>(mut self, name: &str, bytes: fn(&T) -> usize) -> Self {
        if self.types.values().any(|entry| *entry.name == *name) || self.types.contains_key(&TypeId::of::<T>()) {
            self.repeated.push(name.to_owned());
        }
        self.types.insert(TypeId::of::<T>(), Arc::new(TypeEntry::new(name, bytes)));
        let kinds = std::mem::take(&mut self.kinds);
        self.kinds = kinds.into_iter().map(|(name, kind)| (name, self.named(&kind))).collect();
        self
    }

    /// With a node kind. A second one of the same name is not taken, and [`validate`](Self::validate) says so.
    #[must_use]
    pub fn node<N: Evaluate>(mut self) -> Self {
        let kind = Kind { specification: <N as Node>::specification(), run: run::<N>, needs: N::needs };
        let name = kind.specification.kind.clone();
        if self.kinds.contains_key(&name) {
            self.repeated.push(name);
        } else {
            let kind = self.named(&kind);
            for was in &kind.specification.was {
                if self.former.insert(was.clone(), name.clone()).is_some() {
                    self.repeated.push(was.clone());
                }
            }
            self.kinds.insert(name, kind);
        }
        self
    }

    /// The kind with the plain names of its port types.
    fn named(&self, kind: &Kind) -> Arc<Kind> {
        let mut specification = kind.specification.clone();
        let inputs = specification.inputs.iter_mut().map(|input| &mut input.ty);
        for ty in inputs.chain(specification.outputs.iter_mut().map(|output| &mut output.ty)) {
            if let Some(entry) = self.types.get(&ty.id) {
                ty.name = entry.name.to_string();
            }
        }
        Arc::new(Kind { specification, run: kind.run, needs: kind.needs })
    }

    /// The specification of a kind, under its name or one that it had before.
    pub fn specification(&self, kind: &str) -> Option<&Specification> {
        self.kind(kind).map(|kind| &kind.specification)
    }

    /// All specifications, in the order of registration.
    pub fn specifications(&self) -> impl Iterator<Item = &Specification> + Clone {
        self.kinds.values().map(|kind| &kind.specification)
    }

    pub(crate) fn kind(&self, name: &str) -> Option<&Arc<Kind>> {
        self.kinds.get(name).or_else(|| self.former.get(name).and_then(|name| self.kinds.get(name)))
    }
    pub(crate) fn kinds(&self) -> impl Iterator<Item = &Arc<Kind>> {
        self.kinds.values()
    }
    pub(crate) fn kind_names(&self) -> impl Iterator<Item = &str> {
        self.kinds.keys().map(String::as_str)
    }
    pub(crate) fn type_entry(&self, id: TypeId) -> Option<&Arc<TypeEntry>> {
        self.types.get(&id)
    }
}

/// For types without a heap.
fn size_of_val<T>(_: &T) -> usize {
    size_of::<T>()
}
