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

/// Returns the command line, quoted so that it can be pasted into a shell.
pub(super) fn command() -> String {
    let program = PROGRAM.get().copied().unwrap_or("tolman");
    behind(program)
}

/// Returns the command line that continues the interrupted run saved in `file`.
pub(super) fn going_on(file: &Path) -> String {
    let program = PROGRAM.get().copied().unwrap_or("tolman");
    let arguments = std::env::args_os().skip(1);
    let given = arguments.map(|argument| argument.to_string_lossy().into_owned());
    let file = file.to_string_lossy();
    let words = with_from(given, &file);
    let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
    format!("{program} {}", words.join(" "))
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
    let program = PROGRAM.get().copied().unwrap_or("tolman");
    behind(Program::current(program).command())
}

fn behind(program: &str) -> String {
    let arguments = std::env::args_os().skip(1);
    let quoted = arguments.map(|argument| quoted(&argument.to_string_lossy()));
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
