//! The one place where an error becomes a message and an exit code.

use std::error::Error;
use std::fmt::Display;
use std::io::Write;
use std::process::ExitCode;

use pelage_graph::{EvaluateError, Faults, NodeFailure};
use pelage_nodes::RenderError;

/// Why the program ends without having done what it was asked.
pub(crate) enum Failure {
    /// The input or the graph is wrong, or evaluation failed.
    Input(String),
    /// The command line says something impossible.
    Usage(String),
    /// Nothing to draw with.
    NoAdapter(String),
}

impl Failure {
    /// A wrong input: what it is about, and the error with all its causes.
    pub(crate) fn input(about: impl Display, error: &dyn Error) -> Self {
        Self::Input(format!("{about}: {}", with_causes(error)))
    }

    /// What is said.
    pub(crate) fn message(&self) -> &str {
        match self {
            Self::Input(message) | Self::Usage(message) | Self::NoAdapter(message) => message,
        }
    }

    pub(crate) fn report(&self) -> ExitCode {
        let (message, code) = match self {
            Self::Input(message) => (message, 1),
            Self::Usage(message) => (message, 2),
            Self::NoAdapter(message) => (message, 3),
        };
        // Nothing is left to do if standard error is gone.
        let _ = writeln!(std::io::stderr(), "error: {message}");
        ExitCode::from(code)
    }
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Self::Input(faults.to_string())
    }
}

impl From<EvaluateError> for Failure {
    fn from(error: EvaluateError) -> Self {
        let EvaluateError::Nodes(failures) = &error else { return Self::Input(with_causes(&error)) };
        let message = failures.iter().map(|failure| with_causes(failure)).collect::<Vec<_>>().join("\n");
        // A wrong graph goes first: it can be mended here.
        let no_adapter = |failure: &NodeFailure| matches!(failure.cause::<RenderError>(), Some(RenderError::NoAdapter { .. }));
        if failures.iter().all(no_adapter) { Self::NoAdapter(message) } else { Self::Input(message) }
    }
}

/// An error and its causes on one line, each said once.
fn with_causes(error: &dyn Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let text = error.to_string();
        if !message.contains(&text) {
            message = format!("{message}: {text}");
        }
        cause = error.source();
    }
    message
}
