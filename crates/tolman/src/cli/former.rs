//! Verbs that have another name now.

use anyhow::anyhow;

use super::Failure;

/// Arguments of a verb that has another name now.
#[derive(clap::Args)]
#[command(disable_help_flag = true)]
pub(super) struct Arguments {
    /// Its words, which are ignored.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<String>,
}

/// Refuses a former verb by the name it has now.
pub(super) fn refuse(former: &str, now: &str) -> Failure {
    Failure::BadInput(anyhow!(
        "`tolman {former}` is `tolman {now}` now: see `tolman {now} --help`"
    ))
}

/// Refuses a verb of `tolman cpm`.
pub(super) fn refuse_cpm(arguments: &Arguments) -> Failure {
    match arguments.rest.first().map(String::as_str) {
        Some("learn") => refuse("cpm learn", "learn --system cpm"),
        Some("solve") => refuse("cpm solve", "drive"),
        Some("distinct") => refuse("cpm distinct", "maze distinct"),
        _ => refuse("cpm", "learn --system cpm"),
    }
}
