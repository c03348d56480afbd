//! The command line of this process, for messages and reports.

use std::path::Path;
use std::sync::OnceLock;

use tolman_experiment::Program;
use tolman_experiment::shell::quoted;

static PROGRAM: OnceLock<&str> = OnceLock::new();

/// Sets the name of the program.
pub(super) fn set(program: &'static str) {
    // A second call in one process has the same name.
    let _ = PROGRAM.set(program);
}

fn program() -> &'static str {
    PROGRAM.get().copied().unwrap_or("tolman")
}

/// Returns the command line, quoted so that it can be pasted into a shell.
pub(super) fn command() -> String {
    behind(program(), given())
}

/// Returns the command line that continues the interrupted run saved in `file`.
pub(super) fn going_on(file: &Path) -> String {
    behind(program(), with_from(given(), &file.to_string_lossy()))
}

/// Returns `given` with `--from` set to `file`, in place of an earlier `--from`.
fn with_from(given: impl Iterator<Item = String>, file: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut skip = false;
    for word in given {
        if word == "--from" {
            skip = true;
        } else if skip {
            skip = false;
        } else if !word.starts_with("--from=") {
            words.push(word);
        }
    }
    words.extend(["--from".to_owned(), file.to_owned()]);
    words
}

/// Returns the [`command`] of an experiment, which `cargo xtask` may have started.
pub(super) fn experiment() -> String {
    behind(Program::current(program()).command(), given())
}

/// Returns the arguments of this process.
fn given() -> impl Iterator<Item = String> {
    let arguments = std::env::args_os().skip(1);
    arguments.map(|argument| argument.to_string_lossy().into_owned())
}

fn behind(program: &str, words: impl IntoIterator<Item = String>) -> String {
    let quoted = words.into_iter().map(|word| quoted(&word));
    let words: Vec<String> = [program.to_owned()].into_iter().chain(quoted).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_goes_on_from_one_file() {
        for given in [
            "learn -a --from b.json -c",
            "learn -a --from=b.json -c",
            "learn -a -c",
        ] {
            let words = with_from(given.split(' ').map(str::to_owned), "d");
            assert_eq!(words.join(" "), "learn -a -c --from d");
        }
    }
}
