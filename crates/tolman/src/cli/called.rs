//! How the command was called.

use tolman_experiment::shell::quoted;

/// The command line as it can be pasted again.
pub(super) fn command() -> String {
    let arguments = std::env::args_os().skip(1);
    let quoted = arguments.map(|argument| quoted(&argument.to_string_lossy()));
    ["tolman".to_owned()]
        .into_iter()
        .chain(quoted)
        .collect::<Vec<_>>()
        .join(" ")
}
