//! Why a chore failed, and what to do about it.

use std::fmt;

/// A chore's result.
pub(crate) type Result<T> = std::result::Result<T, Failure>;

/// What failed, with its remedy: reported once, in `main`.
#[derive(Debug)]
pub(crate) struct Failure {
    message: String,
    remedy: Option<String>,
    code: u8,
}

impl Failure {
    /// A failure with exit code 1.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), remedy: None, code: 1 }
    }

    /// `what` failed because of `cause`.
    pub(crate) fn caused(what: impl fmt::Display, cause: impl fmt::Display) -> Self {
        Self::new(format!("{what}: {cause}"))
    }

    /// Several faults of one kind, a line each.
    #[cfg(feature = "checks")]
    pub(crate) fn faults(what: &str, faults: &[String]) -> Self {
        Self::new(format!("{what}:\n  {}", faults.join("\n  ")))
    }

    /// The same with what to do about it.
    pub(crate) fn remedy(self, remedy: impl Into<String>) -> Self {
        Self { remedy: Some(remedy.into()), ..self }
    }

    /// The same with the exit code of the program that failed.
    pub(crate) fn with_code(self, code: Option<i32>) -> Self {
        let code = code.and_then(|code| u8::try_from(code).ok()).filter(|&code| code > 0);
        Self { code: code.unwrap_or(self.code), ..self }
    }

    /// The exit code to end with.
    pub(crate) fn code(&self) -> u8 {
        self.code
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(&self.message)?;
        match &self.remedy {
            Some(remedy) => write!(formatter, "\n{remedy}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_never_exits_with_success() {
        for code in [None, Some(0), Some(256), Some(-1)] {
            assert_eq!(Failure::new("it").with_code(code).code(), 1);
        }
        assert_eq!(Failure::new("it").with_code(Some(3)).code(), 3);
    }
}
