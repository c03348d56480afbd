//! The command `tolman` with a system, a family of worlds and an experiment of one's own.

mod experiment;
mod system;
mod world;

use std::process::ExitCode;

use tolman::{Build, Catalogue};

fn main() -> ExitCode {
    let catalogue = Catalogue::tolman()
        .program("outside")
        .system(&system::PacesEntry)
        .family(world::COMB)
        .experiment(experiment::ENTRY);
    let commit = option_env!("OUTSIDE_COMMIT").unwrap_or("unknown");
    tolman::run(&catalogue, &Build::current(commit, "rustc"))
}
