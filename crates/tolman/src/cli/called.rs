//! How the command was called.

use std::sync::OnceLock;

use tolman_experiment::Program;
use tolman_experiment::shell::quoted;

static PROGRAM: OnceLock<&str> = OnceLock::new();

/// Says what the program is called.
pub(super) fn set(program: &'static str) {
    // Whoever runs the command twice has one program.
    let _ = PROGRAM.set(program);
}

/// Returns the command line as it can be pasted again.
pub(super) fn command() -> String {
    let program = PROGRAM.get().copied().unwrap_or("tolman");
    behind(program)
}

/// [`command`] of an experiment, which `cargo xtask` may have started.
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
