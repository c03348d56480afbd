//! `tolman keep`: a process between a verb and a foreign program. It kills every process that the
//! program leaves behind.

use std::ffi::OsString;

use super::Result;

/// Runs a program for another process, and ends it when that process ends
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Process id of the caller
    parent: u32,
    /// The program and its arguments
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, required = true)]
    words: Vec<String>,
}

/// Returns the command that keeps a program, for [`Launch`](tolman_arena::foreign::Launch). It is
/// this very executable, even if its file has been replaced.
pub(super) fn keeper() -> Vec<OsString> {
    match cfg!(target_os = "linux") {
        true => vec!["/proc/self/exe".into(), "keep".into()],
        false => Vec::new(),
    }
}

#[cfg(target_os = "linux")]
pub(super) fn carry_out(arguments: &Arguments) -> Result {
    let code = tolman_arena::foreign::keep(arguments.parent, &arguments.words)?;
    std::process::exit(code.into())
}

#[cfg(not(target_os = "linux"))]
pub(super) fn carry_out(arguments: &Arguments) -> Result {
    let Arguments { parent, words } = arguments;
    Err(super::Failure::Failed(anyhow::anyhow!(
        "`tolman keep` needs Linux: cannot run {words:?} for process {parent}"
    )))
}
