//! What a verb can end with, and how it is told.
//!
//! One rule for all verbs: 0 where all was done that was asked for, robots that were sent to a
//! place arrived, mice that were to solve a maze solved it; else the code of the [`Failure`], and a
//! message on stderr. What was found is written either way.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::builder::styling::{AnsiColor, Style};

use super::interrupt::INTERRUPTED;

/// Reason why a verb did not do what it was asked for.
#[derive(Debug)]
pub(super) enum Failure {
    /// Whoever called is to give something else.
    BadInput(anyhow::Error),
    /// The input was sound, but the machine was not, or the work came to nothing: a robot did not
    /// arrive, no way is known.
    Failed(anyhow::Error),
    /// All was done, but `--check` found a table to disagree with the paper.
    Disagrees(anyhow::Error),
    /// Ctrl-C was heard before all was done.
    Interrupted(anyhow::Error),
}

impl Failure {
    pub(super) fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Failed(_) => 1,
            Self::BadInput(_) => 2,
            Self::Disagrees(_) => 3,
            Self::Interrupted(_) => INTERRUPTED,
        })
    }

    /// Returns whether the reader of our output went away.
    pub(super) fn is_closed_pipe(&self) -> bool {
        let broken = |cause: &(dyn core::error::Error + 'static)| {
            let error = cause.downcast_ref::<io::Error>();
            error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
        };
        self.error().chain().any(broken)
    }

    /// Tells it on stderr, the causes behind it in one line.
    pub(super) fn complain(&self) {
        complain(self.error());
    }

    fn error(&self) -> &anyhow::Error {
        match self {
            Self::BadInput(error)
            | Self::Failed(error)
            | Self::Disagrees(error)
            | Self::Interrupted(error) => error,
        }
    }
}

/// Tells an error on stderr, in colour where colours are wanted.
pub(super) fn complain(error: &anyhow::Error) {
    let red = Style::new().bold().fg_color(Some(AnsiColor::Red.into()));
    let told = told(error);
    // Nobody is left to be told that stderr cannot be written.
    let _ = writeln!(anstream::stderr(), "{red}error:{red:#} {told}");
}

/// Tells something that is no error on stderr, such as what was skipped.
pub(super) fn note(what: &str) {
    // Nobody is left to be told that stderr cannot be written.
    let _ = writeln!(anstream::stderr(), "note: {what}");
}

/// Returns an error and the causes behind it in one line, each told once: some errors tell their
/// cause themselves.
fn told(error: &anyhow::Error) -> String {
    let mut told = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if told.is_empty() {
            told = cause;
        } else if !told.contains(&cause) {
            told = format!("{told}: {cause}");
        }
    }
    told
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

/// Marks an error as the caller's to mend.
pub(super) trait OrBadInput<T> {
    /// Exit code 2 instead of 1.
    fn or_bad_input(self) -> Result<T, Failure>;
}

impl<T, E: Into<anyhow::Error>> OrBadInput<T> for Result<T, E> {
    fn or_bad_input(self) -> Result<T, Failure> {
        self.map_err(|error| Failure::BadInput(error.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_told_once() {
        let cause = || anyhow::anyhow!("no such file");
        let error = |context: &'static str| cause().context(context).context("a.maze");
        assert_eq!(
            told(&error("cannot be read")),
            "a.maze: cannot be read: no such file"
        );
        assert_eq!(
            told(&error("no such file; name another")),
            "a.maze: no such file; name another"
        );
    }
}
