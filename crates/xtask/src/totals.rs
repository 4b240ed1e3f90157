//! What `cargo test` said, shown as it came and added up.

use std::fmt;
use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;

use crate::failure::{Failure, Result};
use crate::process::CommandLine;

/// The sums over every `test result:` line.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Totals {
    passed: u64,
    failed: u64,
    ignored: u64,
}

impl fmt::Display for Totals {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{} passed, {} failed", self.passed, self.failed)?;
        if self.ignored > 0 { write!(formatter, ", {} skipped", self.ignored) } else { Ok(()) }
    }
}

/// Runs a `cargo test`, passes every line of it on to `to`, and adds up its results. Fails if it fails, and if it ran no test at all.
pub(crate) fn run(line: &CommandLine, to: impl Write) -> Result<Totals> {
    let failed = |cause| Failure::caused(format_args!("`{line}`"), cause);
    let mut child = line.command().stdout(Stdio::piped()).spawn().map_err(failed)?;
    let mut totals = Totals::default();
    if let Some(output) = child.stdout.take() {
        pass_on(BufReader::new(output), to, &mut totals).map_err(failed)?;
    }
    line.judge(child.wait().map_err(failed)?)?;
    if totals.passed == 0 {
        return Err(Failure::new("cargo test succeeded, but ran no test"));
    }
    Ok(totals)
}

/// Copies bytes as they are, a line at a time, and counts the results among them.
fn pass_on(mut from: impl BufRead, mut to: impl Write, totals: &mut Totals) -> std::io::Result<()> {
    let mut line = Vec::new();
    while from.read_until(b'\n', &mut line)? > 0 {
        to.write_all(&line)?;
        to.flush()?;
        totals.add(&String::from_utf8_lossy(&line));
        line.clear();
    }
    Ok(())
}

impl Totals {
    /// Adds a line such as `test result: ok. 21 passed; 0 failed; 1 ignored; 0 measured; …`.
    fn add(&mut self, line: &str) {
        let Some((_, counts)) = line.strip_prefix("test result: ").and_then(|rest| rest.split_once(". ")) else { return };
        for count in counts.split("; ") {
            let Some((number, what)) = count.split_once(' ') else { continue };
            let number = number.parse().unwrap_or(0);
            match what.trim() {
                "passed" => self.passed += number,
                "failed" => self.failed += number,
                "ignored" => self.ignored += number,
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_added_up_and_every_byte_is_passed_on() {
        let text: &[u8] = b"running 3 tests\ntest a ... ok\n\
            test result: ok. 21 passed; 0 failed; 1 ignored; 0 measured; 4 filtered out; finished in 0.02s\n\xff torn \r\n\
            test result: FAILED. 2 passed; 3 failed; 0 ignored; 0 measured; 0 filtered out; finished in 1s\nlast";
        let mut shown = Vec::new();
        let mut totals = Totals::default();
        pass_on(text, &mut shown, &mut totals).unwrap();
        assert_eq!(shown, text);
        assert_eq!(totals, Totals { passed: 23, failed: 3, ignored: 1 });
        assert_eq!(totals.to_string(), "23 passed, 3 failed, 1 skipped");
        assert_eq!(Totals { passed: 5, ..Totals::default() }.to_string(), "5 passed, 0 failed");
    }

    #[cfg(unix)]
    #[test]
    fn running_no_test_is_a_failure() {
        let shell = |script: &str| run(&CommandLine::new("sh").with(["-c", script]), std::io::sink());
        let result = |passed: u64| format!("echo 'test result: ok. {passed} passed; 0 failed; 0 ignored; 0 measured'");
        assert_eq!(shell(&result(2)).unwrap().passed, 2);
        assert!(shell(&result(0)).is_err());
        assert!(shell("true").is_err());
        assert_eq!(shell(&format!("{}; exit 101", result(2))).unwrap_err().code(), 101);
    }
}
