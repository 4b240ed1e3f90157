//! Keys of values that nobody has made yet.

use crate::check::CheckedGraph;
use crate::evaluation::EvaluateError;
use crate::evaluator::asked;
use crate::key::Key;
use crate::plan::output_keys;
use crate::request::Request;

impl CheckedGraph {
    /// The keys of the outputs that a request asks for, of its main output if it names none, without making anything: of equal keys, equal values come. So a program can tell
    /// whether what it keeps of a graph is still what the graph says. Context counts as far as the request has it: without the name of an adapter, pictures have a key that is the same on
    /// all of them.
    ///
    /// # Errors
    /// [`EvaluateError`], if there is no such output, or files that nodes name cannot be read.
    ///
    /// # Example
    ///
    /// ```
    /// # use pelage_graph::{Context, Evaluate, Graph, Node, NodeError, Registry, Request};
    /// /// Twice a number.
    /// #[derive(Node)]
    /// #[node(category = "Numbers")]
    /// #[output(twice: f64, "The double.")]
    /// struct Double {
    ///     /// The number.
    ///     #[param(default = 1.0, range = 0.0..=9.0, unit = "1", effect = "larger: a larger double")]
    ///     number: f64,
    /// }
    /// # impl Evaluate for Double {
    /// #     fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> { Ok((2.0 * self.number).into()) }
    /// # }
    /// let registry = Registry::new().node::<Double>();
    /// let key = |text: &str| Ok::<_, Box<dyn std::error::Error>>(Graph::parse(text)?.check(&registry)?.keys_of(&Request::main())?);
    /// let one = key(r#"Graph(version: 1, output: "a.twice", nodes: { "a": Double() })"#)?;
    /// // By any name, written or by default; but of another number.
    /// assert_eq!(one, key(r#"Graph(version: 1, output: "b.twice", nodes: { "b": Double(number: 1.0) })"#)?);
    /// assert_ne!(one, key(r#"Graph(version: 1, output: "a.twice", nodes: { "a": Double(number: 2.0) })"#)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn keys_of(&self, request: &Request) -> Result<Vec<Key>, EvaluateError> {
        let asked = asked(self, request)?;
        let keys = output_keys(self, &asked, &mut |name| Ok(request.context.get(name).cloned())).map_err(EvaluateError::Nodes)?;
        Ok(asked.iter().filter_map(|asked| keys[asked.source.node][asked.source.port]).collect())
    }
}
