//! The `tolman` command; `tolman --help` describes it.

use std::process::ExitCode;

use tolman::{Build, Catalogue};

fn main() -> ExitCode {
    let build = Build::current(env!("TOLMAN_COMMIT"), env!("TOLMAN_COMPILER"));
    tolman::run(&Catalogue::tolman(), &build)
}
