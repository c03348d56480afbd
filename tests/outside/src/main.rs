//! The command `tolman` with a system, a robot, a family of worlds and an experiment of one's own.

mod experiment;
mod robot;
mod system;
mod world;

use std::process::ExitCode;

use tolman::{Build, Catalogue};

fn main() -> ExitCode {
    let catalogue = Catalogue::tolman()
        .program("outside")
        .system(&system::ENTRY)
        .robot(robot::TANK)
        .family(world::TEETH)
        .experiment(experiment::ENTRY);
    let commit = option_env!("OUTSIDE_COMMIT").unwrap_or("unknown");
    tolman::run(&catalogue, &Build::current(commit, "rustc"))
}
