//! Programs that are run, and how to say which.

use std::env;
use std::ffi::OsString;
use std::fmt;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};

use crate::failure::{Failure, Result};

/// A program with its arguments, that can be run and be shown as a line to type.
#[derive(Clone)]
pub(crate) struct CommandLine {
    program: OsString,
    shown_as: String,
    arguments: Vec<OsString>,
    environment: Vec<(String, String)>,
    directory: Option<OsString>,
}

impl CommandLine {
    /// A program found on the path.
    pub(crate) fn new(program: &str) -> Self {
        Self { program: program.into(), shown_as: program.to_owned(), arguments: Vec::new(), environment: Vec::new(), directory: None }
    }

    /// The cargo that runs us, so that the toolchain stays the same.
    pub(crate) fn cargo() -> Self {
        let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        Self { program, ..Self::new("cargo") }
    }

    /// The same with more arguments.
    pub(crate) fn with<A: Into<OsString>>(mut self, arguments: impl IntoIterator<Item = A>) -> Self {
        self.arguments.extend(arguments.into_iter().map(Into::into));
        self
    }

    /// The same with an environment variable set.
    #[cfg(any(feature = "checks", test))]
    pub(crate) fn with_variable(mut self, name: &str, value: &str) -> Self {
        self.environment.push((name.to_owned(), value.to_owned()));
        self
    }

    /// The same, run in `directory`.
    #[cfg(feature = "checks")]
    pub(crate) fn within(mut self, directory: &Path) -> Self {
        self.directory = Some(directory.into());
        self
    }

    /// For `std`: standard input closed, as no chore asks anything.
    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.args(&self.arguments).envs(self.environment.iter().map(|(name, value)| (name, value))).stdin(Stdio::null());
        if let Some(directory) = &self.directory {
            command.current_dir(Path::new(directory));
        }
        command
    }

    /// Runs it, its output to ours.
    pub(crate) fn status(&self) -> Result<ExitStatus> {
        self.command().status().map_err(|cause| Failure::caused(format_args!("`{self}` could not be started"), cause))
    }

    /// Runs it, its output to ours. Fails unless it succeeds.
    pub(crate) fn run(&self) -> Result<()> {
        self.judge(self.status()?)
    }

    /// Runs it and returns its standard output. Fails unless it succeeds.
    #[cfg(feature = "checks")]
    pub(crate) fn output(&self) -> Result<String> {
        let started = self.command().stderr(Stdio::inherit()).output();
        let output = started.map_err(|cause| Failure::caused(format_args!("`{self}` could not be started"), cause))?;
        self.judge(output.status)?;
        String::from_utf8(output.stdout).map_err(|cause| Failure::caused(format_args!("`{self}` did not print UTF-8"), cause))
    }

    /// Nothing if `status` is success, else a failure with the line to repeat and the program's exit code.
    pub(crate) fn judge(&self, status: ExitStatus) -> Result<()> {
        if status.success() {
            return Ok(());
        }
        Err(Failure::new(format!("failed with {status}")).remedy(format!("to repeat: {self}")).with_code(status.code()))
    }
}

impl fmt::Display for CommandLine {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        for (name, value) in &self.environment {
            write!(formatter, "{name}={} ", quoted(value))?;
        }
        formatter.write_str(&self.shown_as)?;
        self.arguments.iter().try_for_each(|argument| write!(formatter, " {}", quoted(&argument.to_string_lossy())))
    }
}

/// `word` as a shell takes it for one word.
fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=:,+@%".contains(letter);
    if !word.is_empty() && word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_as_it_is_typed() {
        let line = CommandLine::cargo().with(["doc", "--no-deps", "it's"]).with_variable("RUSTDOCFLAGS", "-D warnings");
        assert_eq!(line.to_string(), r"RUSTDOCFLAGS='-D warnings' cargo doc --no-deps 'it'\''s'");
    }

    #[test]
    fn a_program_that_is_not_there_is_named() {
        let failure = CommandLine::new("no-such-program-of-pelage").run().unwrap_err();
        assert!(failure.to_string().contains("`no-such-program-of-pelage` could not be started"), "{failure}");
    }

    #[cfg(unix)]
    #[test]
    fn a_failure_keeps_the_exit_code() {
        let line = CommandLine::new("sh").with(["-c", "exit 3"]);
        let failure = line.run().unwrap_err();
        assert_eq!(failure.code(), 3);
        assert!(failure.to_string().ends_with("to repeat: sh -c 'exit 3'"), "{failure}");
        assert!(CommandLine::new("true").run().is_ok());
    }
}
