//! What keeps values from run to run.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;

use crate::cache::{Cache, CacheUse};
use crate::check::CheckedGraph;
use crate::demand::Asked;
use crate::evaluation::{EvaluateError, Evaluation};
use crate::fault::nearest;
use crate::literal::Literal;
use crate::node::NodeError;
use crate::plan::plan;
use crate::request::{AskedOutput, Request};
use crate::resources::Resources;
use crate::run::Run;

type MakeContext = Box<dyn Fn(&Resources) -> Result<Literal, NodeError> + Send + Sync>;

/// Evaluates graphs, and keeps values from run to run within a bound of bytes.
///
/// Only what is asked for runs, and only if no equal value is at hand; what does not depend on each other runs side by side. The result depends on
/// the graph, the files it names and the context alone: not on the ids or layout of the nodes, on earlier runs, on the number of threads
/// or on the order in which nodes run.
pub struct Evaluator {
    threads: usize,
    cache: Cache,
    resources: Resources,
    makers: BTreeMap<String, MakeContext>,
    made: BTreeMap<String, Literal>,
}

impl Evaluator {
    /// An evaluator whose cache keeps at most `budget` bytes, and that runs as many nodes at a time as the machine has cores.
    pub fn new(budget: usize) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        Self { threads, cache: Cache::new(budget), resources: Resources::default(), makers: BTreeMap::new(), made: BTreeMap::new() }
    }

    /// With so many nodes at most running at a time, each on a thread of its own; with 1, or 0, they run one after another on the
    /// caller's.
    ///
    /// What a node does with rayon is another matter: it goes to rayon's global pool, which is the program's to size. Where a
    /// rayon worker calls [`run`](Self::run), nodes run one after another on that worker, and theirs goes to its pool.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    /// With a resource that nodes get by [`Context::resource`](crate::Context::resource), made when the first asks for it.
    #[must_use]
    pub fn resource<R, E>(mut self, make: impl Fn() -> Result<R, E> + Send + Sync + 'static) -> Self
    where
        R: Send + Sync + 'static,
        E: Into<NodeError>,
    {
        self.resources.provide(make);
        self
    }

    /// With a context value that is made when a node that is asked for declares it, such as the name of the graphics adapter, without
    /// which no adapter need be looked for. A request's own value goes before it.
    #[must_use]
    pub fn context_value(mut self, name: &str, make: impl Fn(&Resources) -> Result<Literal, NodeError> + Send + Sync + 'static) -> Self {
        self.makers.insert(name.to_owned(), Box::new(make));
        self
    }

    /// The shared resources, for the program's own use.
    pub fn resources(&self) -> &Resources {
        &self.resources
    }

    /// How full the cache is.
    pub fn cache(&self) -> CacheUse {
        self.cache.usage()
    }

    /// Forgets all values.
    pub fn clear_cache(&mut self) {
        self.cache.clear();
    }

    /// Evaluates what `request` asks for.
    ///
    /// # Errors
    /// If there is no such output, nodes fail, or the run is cancelled. Nodes whose files or context cannot be had are found before any node
    /// runs, all of them at once. When a node fails while it runs, all that does not draw on it runs on, so that one run answers with
    /// every failure, the same for any number of threads. What was computed stays in the cache.
    pub fn run(&mut self, graph: &CheckedGraph, request: &Request) -> Result<Evaluation, EvaluateError> {
        let asked = asked(graph, request)?;
        let mut values = request.context.clone();
        let (makers, made, resources) = (&self.makers, &mut self.made, &self.resources);
        let mut context = |name: &str| -> Result<Option<Literal>, NodeError> {
            if let Some(value) = values.get(name) {
                return Ok(Some(value.clone()));
            }
            let Some(make) = makers.get(name) else { return Ok(None) };
            let value = match made.get(name) {
                Some(value) => value.clone(),
                None => made.entry(name.to_owned()).or_insert(make(resources)?).clone(),
            };
            values.insert(name.to_owned(), value.clone());
            Ok(Some(value))
        };
        let plan = plan(graph, &asked, &mut self.cache, &mut context).map_err(EvaluateError::Nodes)?;
        // A worker that waits would hold up the pool that the nodes it waits for need.
        let threads = if rayon::current_thread_index().is_some() { 1 } else { self.threads };
        let run = Run::new(graph, request, &asked, plan, &values, &self.resources, &mut self.cache);
        run.execute(threads)?;
        Ok(run.into_evaluation(main_name(graph, request)))
    }
}

/// The outputs asked for.
pub(crate) fn asked(graph: &CheckedGraph, request: &Request) -> Result<Vec<Asked>, EvaluateError> {
    if request.outputs.is_empty() {
        return graph.main.map(|source| vec![Asked { source, whole: true }]).ok_or(EvaluateError::NoMainOutput);
    }
    let find = |AskedOutput { name, whole }: &AskedOutput| match graph.source(name) {
        Some(source) => Ok(Asked { source, whole: *whole }),
        None => {
            let known: Vec<String> = graph.outputs().map(|(name, _)| name).collect();
            Err(EvaluateError::NoSuchOutput { output: name.clone(), nearest: nearest(name, known.iter().map(String::as_str)) })
        }
    };
    request.outputs.iter().map(find).collect()
}

/// The one output that [`Evaluation::main`] gives: the first asked for, or the graph's own.
fn main_name(graph: &CheckedGraph, request: &Request) -> Option<String> {
    request.outputs.first().map(|output| output.name.clone()).or_else(|| {
        let main = graph.main?;
        let node = &graph.nodes[main.node];
        Some(format!("{}.{}", node.id, node.kind.specification.outputs[main.port].name))
    })
}
