//! How a verb can fail, and how failures are reported.
//!
//! All verbs follow one rule. The exit code is 0 if everything asked for was done: robots arrived,
//! and mice solved their mazes. Otherwise it is the code of the [`Failure`], with a message on
//! stderr. Results found so far are written in both cases.

use std::io::{self, Write};
use std::process::ExitCode;

use anyhow::anyhow;
use clap::builder::styling::{AnsiColor, Style};
use tolman_arena::BoxError;
use tolman_arena::registry::UnknownName;
use tolman_draw::visible;
use tolman_experiment::choices;

use super::interrupt::INTERRUPTED;

/// Result of a verb, or of a part of its work.
pub(super) type Result<T = (), E = Failure> = core::result::Result<T, E>;

/// Reason why a verb failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// The input is invalid: the caller has to give something else.
    BadInput(anyhow::Error),
    /// The input was valid, but the machine failed or the work had no result: a robot did not
    /// arrive, or no way is known.
    Failed(anyhow::Error),
    /// Everything was done, but `--check` found a table that disagrees with the paper.
    Disagrees(anyhow::Error),
    /// Ctrl-C came before everything was done.
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

    /// Returns whether the failure is that the reader of standard output has closed it.
    pub(super) fn is_closed_pipe(&self) -> bool {
        let broken = |cause: &(dyn core::error::Error + 'static)| {
            let error = cause.downcast_ref::<io::Error>();
            error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
        };
        self.error().chain().any(broken)
    }

    /// Prints the failure on stderr, with its causes in one line.
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

/// Returns the failure for a name that is not `known`; it says which known one is nearest.
pub(super) fn unknown<'a>(
    fault: &str,
    name: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Failure {
    Failure::BadInput(anyhow!("{fault}; {}", choices(name, known)))
}

/// Errors of the arena, which have no type.
pub(super) trait Unboxed<T> {
    /// Returns the value, or the error. An unknown name says which known one is nearest.
    fn unboxed(self) -> Result<T, anyhow::Error>;
}

impl<T> Unboxed<T> for Result<T, BoxError> {
    fn unboxed(self) -> Result<T, anyhow::Error> {
        self.map_err(|error| match error.downcast::<UnknownName>() {
            Ok(unknown) => {
                let known = unknown.known.iter().map(String::as_str);
                anyhow!("{}; {}", unknown.told, choices(&unknown.name, known))
            }
            Err(error) => anyhow::Error::from_boxed(error),
        })
    }
}

/// Prints an error on stderr, in colour if colours are wanted.
pub(super) fn complain(error: &anyhow::Error) {
    let red = Style::new().bold().fg_color(Some(AnsiColor::Red.into()));
    let told = told(error);
    let told = visible(&told);
    let told = shortened(&told);
    // If stderr cannot be written, there is no other place to report it.
    let _ = writeln!(anstream::stderr(), "{red}error:{red:#} {told}");
}

/// Maximum number of digits of a number in a message, those of 1e99.
const MOST_DIGITS: usize = 100;

/// Returns a message with an exponent in place of most digits of a longer number.
fn shortened(told: &str) -> String {
    let is_digit = |c: char| c.is_ascii_digit();
    let (mut shown, mut rest) = (String::new(), told);
    while let Some(at) = rest.find(is_digit) {
        let (before, number) = rest.split_at(at);
        let end = number.find(|c| !is_digit(c)).unwrap_or(number.len());
        let (digits, after) = number.split_at(end);
        shown += before;
        match digits.parse::<f64>() {
            Ok(value) if digits.len() > MOST_DIGITS => shown += &format!("{value:e}"),
            _ => shown += digits,
        }
        rest = after;
    }
    shown + rest
}

/// Prints a note on stderr, about something skipped for example.
pub(super) fn note(what: &str) {
    // If stderr cannot be written, there is no other place to report it.
    let _ = writeln!(anstream::stderr(), "note: {}", visible(what));
}

/// Returns an error and its causes in one line. A cause that the error's own text already contains
/// is left out.
pub(super) fn told(error: &anyhow::Error) -> String {
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

/// Marks an error as bad input.
pub(super) trait OrBadInput<T> {
    /// Returns the value, or a failure with exit code 2 instead of 1.
    fn or_bad_input(self) -> Result<T>;
}

impl<T, E: Into<anyhow::Error>> OrBadInput<T> for Result<T, E> {
    fn or_bad_input(self) -> Result<T> {
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
