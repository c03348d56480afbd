//! The `tolman` command: `tolman --help`.

extern crate alloc;

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
