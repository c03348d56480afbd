//! `tolman completions`: scripts with which a shell completes our command lines.

use std::io::Write;

use clap::CommandFactory;
use clap_complete::Shell;

use super::Result;

/// Writes a completion script for a shell
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  tolman completions bash > tolman.bash")]
pub(super) struct Arguments {
    /// Shell to write the script for
    shell: Shell,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    // The generator panics if it cannot write, so it writes to memory.
    let mut script = Vec::new();
    let mut command = super::Arguments::command();
    clap_complete::generate(arguments.shell, &mut command, "tolman", &mut script);
    Ok(out.write_all(&script)?)
}
