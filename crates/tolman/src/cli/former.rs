//! Former names of verbs.

use anyhow::anyhow;

use super::Failure;

/// Arguments of a verb that has a new name.
#[derive(clap::Args)]
#[command(disable_help_flag = true)]
pub(super) struct Arguments {
    /// Arguments of the former verb, which are ignored.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<String>,
}

/// Returns the failure that names the verb's new name.
pub(super) fn refuse(former: &str, now: &str) -> Failure {
    Failure::BadInput(anyhow!(
        "`tolman {former}` is now called `tolman {now}`: see `tolman {now} --help`"
    ))
}

/// Returns the failure for a verb of `tolman cpm`.
pub(super) fn refuse_cpm(arguments: &Arguments) -> Failure {
    match arguments.rest.first().map(String::as_str) {
        Some("learn") => refuse("cpm learn", "learn --system cpm-better"),
        Some("solve") => refuse("cpm solve", "drive"),
        Some("distinct") => refuse("cpm distinct", "maze distinct"),
        _ => refuse("cpm", "learn --system cpm-better"),
    }
}
